import asyncio
import re

import pytest
from rich.cells import cell_len

from tests.robots.test_robot import TEXT
from tests.world.nodes.harness import new_world
from tftool.drawing.solids import solids_of
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.screens.terminal.robot_app import KEYS, RobotApp
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.sliders import Sliders, tip_of


class Mover:
    """Joints that move to their positions at once, as JointStatePublisher's do."""

    def __init__(self, robot):
        self.robot = robot
        self.given = {}

    @property
    def positions(self):
        return self.robot.positions(self.given)

    def move(self, joint, position):
        self.robot.positions({joint: position})
        self.given[joint] = position


@pytest.fixture
def robot():
    return Robot(parse_description(TEXT))


@pytest.fixture
def mover(robot):
    return Mover(robot)


@pytest.fixture
def shown(robot, mover):
    """Return the screen after some keys."""

    def show(*keys, size=(80, 24), resized=None, mover=mover, heard=None, **setting):
        world = new_world()
        for one in robot.transforms({"turn": 0.5}, stamp=1):
            world.broadcast([one], "me", static=True)
        sliders = Sliders(robot, mover, seed=1)
        sliders.hear(heard or {})
        app = RobotApp(world, sliders, setting=Setting(title="tftool robot", **setting))
        lines = []

        async def main():
            async with app.run_test(size=size) as pilot:
                await pilot.pause()
                await pilot.press(*keys)
                await pilot.pause()
                if resized is not None:
                    await pilot.resize_terminal(*resized)
                    await pilot.pause()
                app.redraw()
                await pilot.pause()
                strips = app.screen._compositor.render_strips(app.size)
                lines.extend(strip.text for strip in strips)

        asyncio.run(main())
        assert app.failure is None
        return lines

    return show


def row(lines, name):
    (found,) = [line for line in lines if f" {name} " in line and "rad" in line + "rad"][:1]
    return found


def test_every_joint_is_a_slider_and_the_tip_has_its_pose(shown):
    lines = shown("p")

    text = "\n".join(lines)
    assert "▸ turn" in text
    assert "no limits" in row(lines, "turn")
    assert "3.0000 m" in row(lines, "reach")
    assert "1 … 5" in row(lines, "reach")
    assert "follows reach" in row(lines, "grip")
    assert "eye in base" in text
    assert [cell_len(line) for line in lines] == [80] * 24


@pytest.mark.parametrize("size", [(40, 8), (60, 20), (200, 60), (20, 5)])
def test_it_fits_into_any_terminal(shown, size):
    assert [cell_len(line) for line in shown(size=size)] == [size[0]] * size[1]


def test_arrows_slide_the_chosen_joint_between_its_limits(shown, mover):
    shown("down", "right", "right", "left")
    assert mover.given == {"reach": pytest.approx(3.0 + 4.0 / 50)}

    shown("down", *["right"] * 60)
    assert mover.given["reach"] == 5.0


def test_a_bar_grows_by_half_a_cell(shown):
    bars = [row(shown("c", "down", *["right"] * steps), "reach") for steps in range(3)]

    assert len(set(bars)) == 3
    assert {"╾" in bar for bar in bars} == {True, False}


def test_small_steps_are_a_tenth(shown, mover):
    shown("down", ".", ".", ",")

    assert mover.given["reach"] == pytest.approx(3.0 + 4.0 / 500)


def test_a_number_is_typed_and_taken_by_enter(shown, mover):
    assert "1.5_" in row(shown("1", ".", "5"), "turn")
    assert mover.given == {}

    shown("minus", "1", ".", "7", "5", "backspace", "enter")
    assert mover.given == {"turn": -1.7}


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        (("down", "9", "enter"), "9 is beyond the limits, 1 to 5"),
        (("1", "minus", "enter"), "'1-' is not a number"),
        (("1", "e", "9", "9", "9", "enter"), "inf"),
    ],
)
def test_an_invalid_joint_position_is_reported_and_moves_nothing(shown, mover, keys, told):
    lines = shown(*keys)

    assert told in lines[-1]
    assert mover.given == {}


def test_escape_types_nothing_after_all(shown, mover):
    shown("1", "escape", "enter")

    assert mover.given == {}


def test_all_joints_go_to_zero_to_the_centre_or_anywhere(shown, mover):
    shown("down", "right", "z")
    assert mover.given == {"turn": 0.0, "reach": 1.0}

    shown("c")
    assert mover.given == {"turn": 0.0, "reach": 3.0}

    shown("r")
    assert -3.15 < mover.given["turn"] < 3.15
    assert 1.0 <= mover.given["reach"] <= 5.0
    assert mover.given["reach"] != 3.0


def test_capitals_mean_the_chosen_joint_alone(shown, mover):
    shown("down", "Z")

    assert mover.given == {"reach": 1.0}


def test_joints_that_follow_are_passed_over(shown):
    assert "▸ turn" in "\n".join(shown("down", "down"))
    assert "▸ reach" in "\n".join(shown("up"))


def test_tab_shows_the_pose_of_another_link(shown):
    assert "base in base" in "\n".join(shown("tab"))
    assert "claw in base" in "\n".join(shown("shift+tab"))


def test_without_a_mover_others_move_the_joints(shown):
    lines = shown("right", mover=None, heard={"turn": 0.25, "nothing": 1.0})

    assert "0.2500 rad" in row(lines, "turn")
    assert "?" in row(lines, "reach")
    assert "slide" not in lines[-1]


def test_plain_characters_are_enough(shown):
    assert "\n".join(shown("question_mark", ascii_only=True)).isascii()


@pytest.mark.parametrize(("resized", "left"), [((101, 24), 12), ((40, 12), 0)])
def test_the_keys_stay_in_the_middle_of_a_window_that_changes(shown, resized, left):
    lines = shown("question_mark", resized=resized)

    edge = next(line for line in lines if "╭─ Keys" in line)
    assert edge.index("╭─ Keys") == left
    assert "╮" in edge


@pytest.mark.parametrize("size", [(80, 24), (60, 20), (40, 12)])
def test_all_keys_are_told_in_as_many_pages_as_fit(shown, size):
    told, pages = [], 0
    lines = shown("?", size=size)
    while tops := [number for number, line in enumerate(lines) if "╭─ Keys" in line]:
        left = lines[tops[0]].index("╭─ Keys")
        box = slice(left + 1, lines[tops[0]].index("╮", left))
        told += [line[box] for line in lines[tops[0] + 1 :] if line[left] == "│"]
        pages += 1
        lines = shown(*"?" * (pages + 1), size=size)
    whole = " ".join(" ".join(line for line in told if "more keys" not in line).split())

    assert all(" ".join(sentence.split()) in whole for sentence in KEYS.splitlines())
    assert sum("more keys" in line for line in told) == pages - 1


def test_a_robot_without_moving_joints_says_so():
    robot = Robot(parse_description('<robot name="stone"><link name="stone"/></robot>'))
    sliders = Sliders(robot, Mover(robot))
    sliders.step(1)
    sliders.zero()
    sliders.choose(1)

    assert sliders.sliders == []
    assert tip_of(robot) == "stone"


def test_the_link_beside_the_sliders_is_one_that_has_a_frame():
    joint = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/></joint>'
    robot = Robot(
        parse_description(
            '<robot name="r"><link name="base"/><link name="hand"/><link name="ball"/>'
            + joint.format("turn", "continuous", "base", "hand")
            + joint.format("thrown", "floating", "hand", "ball")
            + "</robot>"
        )
    )

    assert tip_of(robot) == "hand"


ARM = """<robot name="arm"><link name="base"/><link name="rod"><visual>
<origin xyz="0 0 0.5"/><geometry><box size="0.2 0.2 1"/></geometry>
<material name="red"><color rgba="1 0 0 1"/></material></visual></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="rod"/>
<axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>"""


def columns_of(lines, sign):
    return [column for line in lines for column, one in enumerate(line) if one == sign]


@pytest.fixture
def arm(shown):
    """Return the picture of a rod on the ground, after some keys."""
    described = Robot(parse_description(ARM))
    solids, _ = solids_of(described.links.values(), MeshFolders())

    def show(*keys, at=0.0, size=(100, 30), missing=(), **setting):
        world = new_world()
        for one in described.transforms({"turn": at}, stamp=1):
            world.broadcast([one], "me", static=True)
        mover = Mover(described)
        setting = Setting(title="tftool robot", **setting)
        sliders = Sliders(described, mover)
        app = RobotApp(world, sliders, setting=setting, solids=solids, missing=missing)
        lines = []

        async def main():
            async with app.run_test(size=size) as pilot:
                await pilot.pause()
                await pilot.press(*keys)
                await pilot.pause()
                app.redraw()
                await pilot.pause()
                lines.extend(strip.text for strip in app.screen._compositor.render_strips(app.size))

        asyncio.run(main())
        assert app.failure is None
        return lines

    return show


def test_missing_meshes_are_counted_in_a_narrow_panel_too(arm):
    lines = arm(size=(80, 24), missing=[f"no mesh {number}" for number in range(12)])

    assert any("simpler: 12 meshes not found" in line for line in lines)


@pytest.fixture
def long_names():
    """Return the screen of 80 × 24 cells for an arm with a joint name of 19 letters."""
    robot = Robot(parse_description(ARM.replace('"turn"', '"shoulder_lift_joint"')))
    return screen_of(RobotApp(new_world(), Sliders(robot, Mover(robot)), setting=Setting()))


def screen_of(app):
    """Return the lines of a screen of 80 × 24 cells."""
    lines = []

    async def main():
        async with app.run_test(size=(80, 24)) as pilot:
            await pilot.pause()
            app.redraw()
            await pilot.pause()
            lines.extend(strip.text for strip in app.screen._compositor.render_strips(app.size))

    asyncio.run(main())
    return lines


def test_a_robot_of_one_link_is_drawn_without_any_transform():
    text = re.sub(r'<link name="base"/>|<joint.*</joint>', "", ARM, flags=re.DOTALL)
    robot = Robot(parse_description(text))
    solids, _ = solids_of(robot.links.values(), MeshFolders())
    app = RobotApp(new_world(), Sliders(robot, Mover(robot)), setting=Setting(), solids=solids)

    lines = screen_of(app)

    assert solid_cells(lines) > 40
    assert "no joint that moves" in "".join(lines)
    assert "↑↓" not in lines[-1]


def test_a_short_table_of_links_has_the_chosen_link_and_counts_the_others(shown):
    lines = shown("tab", size=(100, 17))

    (row,) = [line for line in lines if line.startswith("│base  ")]
    assert row.split("│")[1].split() == ["base", "0.000", "0.000", "0.000"]
    assert any("4 more" in line for line in lines)


def solid_cells(lines):
    return sum(line.count(sign) for line in lines for sign in "░▒▓█")


def test_the_robot_is_drawn_beside_its_joints(arm):
    assert solid_cells(arm()) > 40
    assert solid_cells(arm("p")) == 0


def test_rows_below_the_joints_say_where_every_link_is(arm):
    lines = arm(at=0.0)

    assert any("base" in line and line.count("0.000") == 3 for line in lines)
    (rod,) = [line for line in lines if "│rod  " in line]
    assert rod.split("│")[1].split() == ["rod", "0.000", "0.000", "0.000"]


def test_joints_have_their_whole_names_beside_the_picture(long_names):
    assert "shoulder_lift_joint ├" in "\n".join(long_names)


def test_long_names_of_joints_are_cut_in_the_middle_so_that_they_differ():
    links = '<link name="{0}"/><joint name="finger_middle_joint_{0}" type="continuous">'
    text = "".join(
        f'{links.format(n)}<parent link="base"/><child link="{n}"/></joint>' for n in "12"
    )
    robot = Robot(parse_description(f'<robot name="r"><link name="base"/>{text}</robot>'))

    shown = "\n".join(
        screen_of(RobotApp(new_world(), Sliders(robot, Mover(robot)), setting=Setting()))
    )

    assert "joint_1 " in shown
    assert "joint_2 " in shown


def test_a_small_terminal_has_joints_alone(arm):
    assert solid_cells(arm(size=(60, 20))) == 0
    assert solid_cells(arm(size=(60, 30))) > 10


def test_a_rod_is_tall_from_the_side_and_a_square_from_above(arm):
    def rows(lines):
        return sum(any(sign in line for sign in "░▒▓█") for line in lines)

    from_the_side = rows(arm("w", "w"))
    from_above = rows(arm("w", "a"))

    assert from_the_side > 15
    assert rows(arm("w", "w", "less_than_sign", "less_than_sign")) < from_the_side
    assert from_above > 15


def test_shift_and_arrows_turn_the_picture(arm):
    assert arm("shift+left", "shift+left") != arm() == arm("shift+left", "shift+right")
    assert arm("shift+up") != arm()


def test_plain_characters_and_no_colours_are_enough_for_a_solid(arm):
    plain = arm(ascii_only=True)

    assert "\n".join(plain).isascii()
    assert sum(line.count(sign) for line in plain for sign in "#%@*+") > 20
    assert sum(line.count(sign) for line in arm(colors=False) for sign in "░▒▓█") > 20


def test_all_joints_are_listed_again_where_the_window_grows(shown):
    lines = shown(*["down"] * 3, size=(80, 10), resized=(120, 40))

    assert all(row(lines, name) for name in ("turn", "reach", "grip", "look"))


def test_a_long_list_of_joints_counts_those_above_and_below():
    joints = "".join(
        f'<link name="l{n}"/><joint name="j{n}" type="continuous"><parent link="base"/>'
        f'<child link="l{n}"/></joint>'
        for n in range(17)
    )
    robot = Robot(parse_description(f'<robot name="comb"><link name="base"/>{joints}</robot>'))
    sliders = Sliders(robot, Mover(robot))
    app = RobotApp(new_world(), sliders, setting=Setting())

    first = screen_of(app)
    rows = [line for line in first if re.search(r"j\d+ .*rad", line)]
    assert rows
    assert any(f"↓ {17 - len(rows)} more" in line for line in first)
    sliders.choose(-1)
    last = screen_of(RobotApp(new_world(), sliders, setting=Setting()))
    assert any(f"↑ {17 - len(rows)} above" in line for line in last)
