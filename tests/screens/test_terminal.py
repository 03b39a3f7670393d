"""Tests of the turtles' screen: its contents and its keys."""

import asyncio
import math
import re

import pytest
from rich.cells import cell_len
from rich.text import Text

from tests.screens.visiting import screen, settled, shown, told, visit
from tests.world.nodes.vectors import VECTORS
from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.drawing import theme
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Kill
from tftool.screens.terminal import turtle_app
from tftool.screens.terminal.screen_options import Setting, setting_from
from tftool.screens.terminal.turtle_app import TurtleApp
from tftool.screens.terminal.world_app import Panel, input_events
from tftool.world.node import Node
from tftool.world.nodes.turtle_drivers import IdleDrawing


@pytest.mark.parametrize(
    "size", [(60, 20), (80, 24), (100, 30), (120, 30), (200, 60), (90, 60), (60, 60), (300, 80)]
)
def test_everything_is_on_the_screen_at_any_usual_size(danced, size):
    lines = shown(danced, size)

    text = "\n".join(lines)
    for there in (
        "Frames in world",
        "Tree",
        "Echo",
        "Plot",
        "L log",
        "live",
        "turtle1 in turtle2",
        "62.6",
        "q quit",
    ):
        assert there in text
    assert [cell_len(line) for line in lines] == [size[0]] * size[1]


@pytest.mark.parametrize("size", [(30, 10), (45, 15), (55, 50)])
def test_with_little_room_there_is_the_field_alone(danced, size):
    text = "\n".join(shown(danced, size))

    assert "Frames in world" in text
    assert "turtle1" in text
    assert "Tree" not in text


@pytest.mark.parametrize("size", [(20, 5), (29, 40), (200, 9)])
def test_with_no_room_there_is_one_sentence(danced, size):
    words = " ".join(" ".join(shown(danced, size)).split())

    assert words == f"This terminal is {size[0]}x{size[1]}; tftool needs 30x10 or more."


@pytest.mark.parametrize("size", [(1, 1), (2, 1), (3, 2)])
def test_no_terminal_is_too_small_to_say_so_without_breaking(danced, size):
    assert len(shown(danced, size)) == size[1]


def test_a_resized_terminal_is_filled_again(danced):
    async def steps(app, pilot):
        for size in ((20, 5), (60, 20), (200, 60)):
            await pilot.resize_terminal(*size)
            await settled(pilot)
        assert "Echo" in "\n".join(screen(app))
        assert [cell_len(line) for line in screen(app)] == [200] * 60

    visit(danced, (100, 30), steps)


def test_keys_drive_as_in_teleop(danced):
    pressed = []

    shown(
        danced,
        keys=("up", "down", "left", "right", *"gtredcvbf", *"GTREDCVB"),
        press=pressed.append,
    )

    assert pressed == ["up", "down", "left", "right", *"gtredcvbf", *"gtredcvb"]


def test_in_teleop_f_gives_a_turn_up_in_either_case(danced):
    pressed = []

    shown(danced, keys=("f", "F"), press=pressed.append, drive_only=True)

    assert pressed == ["f", "f"]


def test_where_nothing_can_be_driven_keys_do_nothing(danced):
    assert "drive" not in "\n".join(shown(danced, keys=("up", "g")))


def test_a_key_that_is_refused_is_told_in_the_log(turtles):
    def refuse(key):
        raise UsageError(f"no {key} today")

    assert "screen: no up today" in "\n".join(shown(turtles(2.0, ()), keys=("up",), press=refuse))


def test_the_echo_says_what_a_lookup_says(danced):
    x, y, z = danced.world.buffer.lookup_transform("turtle2", "turtle1").transform.translation

    assert f"xyz   {x:7.3f} {y:7.3f} {z:7.3f}" in "\n".join(shown(danced))


def test_tab_picks_the_panel(danced):
    async def steps(app, pilot):
        order = [app.focused.id]
        for _ in range(4):
            await pilot.press("tab")
            order.append(app.focused.id)
        await pilot.press("shift+tab")
        assert order == ["field", "tree", "pair", "log", "field"]
        assert app.focused.id == "log"

    visit(danced, (100, 30), steps)


def test_a_pair_is_picked_by_moving_through_the_tree(danced):
    pressed = []

    up = "\n".join(shown(danced, keys=("tab", "up"), press=pressed.append))
    down = "\n".join(shown(danced, keys=("tab", "down"), press=pressed.append))
    measured = "\n".join(shown(danced, keys=("tab", "up", "enter", "down"), press=pressed.append))

    assert "world in turtle2" in up
    assert "turtle2 in turtle2" in down
    assert "turtle1 in world" in measured
    assert pressed == []


def test_letters_move_through_the_tree_while_arrows_drive(danced):
    pressed = []

    text = "\n".join(shown(danced, keys=("k", "k", "k", "up"), press=pressed.append))

    assert "world in turtle2" in text
    assert pressed == ["up"]


def test_x_asks_the_other_way_round(danced):
    assert "turtle2 in turtle1" in "\n".join(shown(danced, keys=("x",)))


def test_left_and_right_do_nothing_in_the_tree(danced):
    pressed = []

    shown(danced, keys=("tab", "left", "right"), press=pressed.append)

    assert pressed == []


def test_the_log_scrolls_with_the_arrows(danced):
    newest = shown(danced, (80, 24), keys=("tab", "tab", "tab"))
    older = shown(danced, (80, 24), keys=("tab", "tab", "tab", "up", "up"))
    back = shown(danced, (80, 24), keys=("tab", "tab", "tab", "up", "up", "down", "down"))

    assert "Successfully" in "\n".join(newest)
    assert "Successfully" not in "\n".join(older)
    assert back == newest


def test_the_log_is_a_strip_that_opens_and_closes(danced):
    first = "turtlesim: Starting turtlesim"
    strip = shown(danced)
    opened = "\n".join(shown(danced, keys=("L",)))

    assert "follower: Successfully spawned turtle2" in strip[-2]
    assert first not in "\n".join(strip)
    assert first in opened
    assert "Log ─" in opened
    assert first not in "\n".join(shown(danced, keys=("L", "L")))
    assert first not in "\n".join(shown(danced, keys=("L", "escape")))


@pytest.mark.parametrize("size", [(60, 60), (80, 24), (120, 40), (60, 20)])
def test_names_are_whole_at_every_usual_size(danced, size):
    text = "\n".join(shown(danced, size))

    assert text.count("turtle1") >= 3
    assert "tur…" not in text
    assert "turt…" not in text


OFFERED = (("carrot", "turtle2 follows carrot1."), ("robot", "A robot."))


def test_another_scenario_is_chosen_from_a_list(danced):
    async def steps(app, pilot):
        await pilot.press("o")
        await settled(pilot)
        assert "A robot." in "\n".join(screen(app))
        await pilot.press("down")
        await pilot.press("enter")
        await pilot.pause()

    app = visit(danced, (100, 30), steps, scenarios=lambda: OFFERED)

    assert app.chosen == "robot"
    assert app.return_code == 0


def test_the_list_of_scenarios_goes_away_unused(danced):
    pressed = []
    plain = told(shown(danced, scenarios=lambda: OFFERED))

    for keys in (("o", "o"), ("o", "down", "escape")):
        assert told(shown(danced, keys=keys, press=pressed.append, scenarios=lambda: OFFERED)) == (
            plain
        )
    assert "robot" not in "\n".join(shown(danced, keys=("o",)))
    assert pressed == []


def test_the_key_help_says_how_it_closes(danced):
    assert "? or Esc closes them" in "\n".join(shown(danced, keys=("?",)))


def test_the_key_help_names_no_key_that_does_nothing(danced):
    """Check a recording: nothing can be driven, and no other scenario chosen."""
    quiet = "\n".join(shown(danced, keys=("?",), press=None))
    full = "\n".join(shown(danced, keys=("?",), press=lambda key: None, scenarios=lambda: OFFERED))

    for words in ("drive turtle1", "cancel the turn", "another scenario"):
        assert words not in quiet
        assert words in full
    assert "next panel" in quiet
    assert "quit" in quiet


def test_a_turtle_that_draws_by_itself_is_said_and_a_key_stops_it(turtles):
    drawing = []

    def leave_alone(world):
        drawing.append(IdleDrawing(world))

    scene = turtles(9.0, (), followed=False, extra=leave_alone)
    (idle,) = drawing
    assert idle.is_drawing
    app = TurtleApp(scene, lambda key: None, Setting(), idle)
    shown_before, shown_after = [], []

    async def main():
        async with app.run_test(size=(100, 30)) as pilot:
            await settled(pilot)
            shown_before.extend(screen(app))
            await pilot.press("j")
            await settled(pilot)
            shown_after.extend(screen(app))

    asyncio.run(main())
    assert "turtle1 draws by itself; a key stops it" in "\n".join(shown_before)
    assert "by itself;" not in "\n".join(shown_after)
    assert not idle.is_drawing


def test_a_removed_turtle_is_not_said_to_draw(turtles):
    drawing = []

    class Script(Node):
        async def run(self):
            await self.clock.sleep(seconds(7.0))
            await self.world.call("kill", build(Kill.Request, "turtle1"))

    def remove(world):
        drawing.append(IdleDrawing(world))
        Script(world, "script")

    scene = turtles(9.0, (), followed=False, extra=remove)
    (idle,) = drawing

    lines = []

    async def main():
        app = TurtleApp(scene, lambda key: None, Setting(), idle)
        async with app.run_test(size=(100, 30)) as pilot:
            await settled(pilot)
            lines.extend(screen(app))

    asyncio.run(main())
    assert idle.is_drawing
    assert "turtle1 draws by itself;" not in "\n".join(lines)


def test_the_key_help_comes_and_goes(danced):
    plain = shown(danced)

    assert "swap the two frames" in "\n".join(shown(danced, keys=("?",)))
    assert told(shown(danced, keys=("?", "?"))) == told(plain)
    assert told(shown(danced, keys=("?", "escape"))) == told(plain)


def test_a_panel_shows_text_it_was_given_before_it_had_a_size(danced):
    lines = []

    async def steps(app, pilot):
        panel = app.panel("keys")
        panel.show([Text("given early")])
        panel.display = True
        panel.styles.width, panel.styles.height = 30, 5
        await settled(pilot)
        lines.extend(screen(app))

    visit(danced, (100, 30), steps)

    assert "given early" in "\n".join(lines)


@pytest.mark.parametrize("case", VECTORS["teleop_keys"], ids=lambda case: case["key"])
def test_the_bytes_that_a_terminal_sends_for_a_key_drive_or_quit(danced, case):
    final = chr(int(case["final_byte"], 16))
    sent = final if len(case["key"]) == 1 else f"\x1b[{final}"
    pressed = []

    async def steps(app, pilot):
        # The bytes pass through the terminal's driver.
        for event in input_events(sent):
            app.post_message(event)
        await settled(pilot)

    app = visit(danced, (100, 30), steps, pressed.append)

    if case["action"] == "quit":
        assert app.return_code == 0
        assert not pressed
    else:
        assert pressed == [case["key"].removeprefix("arrow_")]


def test_light_and_dark_change_places(danced):
    grounds = []

    async def steps(app, pilot):
        for _ in range(3):
            strips = app.screen._compositor.render_strips(app.size)
            grounds.append(next(s.style.bgcolor.triplet.hex for s in strips[0]))
            await pilot.press("m")
            await settled(pilot)

    visit(danced, (80, 24), steps)

    dark, light = (theme.hexadecimal(one.ground) for one in (theme.DARK, theme.LIGHT))
    assert grounds == [dark, light, dark]


def test_in_plain_characters_the_whole_screen_is(danced):
    for keys in ((), ("?",), ("tab",), ("{",)):
        assert "\n".join(shown(danced, keys=keys, ascii_only=True)).isascii()


def test_without_colours_turtles_are_arrows(danced):
    text = "\n".join(shown(danced, colors=False))

    assert any(f"▐{arrow}▌" in text for arrow in "→↗↑↖←↙↓↘")


def test_for_teleop_the_field_fills_the_screen(danced):
    text = "\n".join(shown(danced, (100, 40), drive_only=True))

    assert "3-D" not in text
    assert "L log" in text
    assert "Tree" not in text
    pose = danced.simulator.turtles["turtle1"].pose
    assert f"x {pose.x:.2f}  y {pose.y:.2f}  {math.degrees(pose.theta):z.0f}°" in text
    small = shown(danced, (80, 24), drive_only=True)
    # Title, log and keys have a row each; the picture has all other rows, with its border.
    assert sum(line.startswith("│") for line in small) == 19


@pytest.mark.parametrize("size", [(60, 20), (200, 60)])
def test_no_name_breaks_the_screen(frames, size):
    names = ["[bold]x[/]", "\x1b[31mred", "a\nb", "x" * 500, "שלום", "🐢🐢", "\u202eevil", "[/", ""]
    links = {name: ("map", 1.0, 2.0) for name in names if name}
    scene = frames({**links, "b\x07": ("x" * 500, 1.0, 0.0)})

    async def steps(app, pilot):
        for key in ("tab", *["up"] * 10, "enter", "down", "x", "tab", "tab"):
            await pilot.press(key)
            await settled(pilot)
            lines = screen(app)
            assert all(line.isprintable() for line in lines)
            assert [cell_len(line) for line in lines] == [size[0]] * size[1]

    visit(scene, size, steps)


def test_a_world_without_turtles_shows_its_frames_and_a_pair_of_them(frames):
    scene = frames({"base": ("map", 1.0, 2.0), "laser": ("base", 0.5, 0.0)})

    text = "\n".join(shown(scene))

    assert "laser in map" in text
    assert "Frames in map" in text
    # The name is in the picture, in the tree and in the echo.
    assert text.count("laser") == 3


def test_a_pair_whose_frames_never_come_gives_way_to_one_that_is_there(turtles):
    early = turtles(2.0, (), followed=False)
    late = turtles(5.0, (), followed=False)

    assert "turtle1 in turtle2" in "\n".join(shown(early))
    assert "turtle1 in world" in "\n".join(shown(late))
    assert "world in turtle2" in "\n".join(shown(early, keys=("k",)))


def test_a_pair_whose_frames_come_late_is_shown_after_all(frames):
    scene = frames({"a": ("map", 1.0, 1.0)})

    async def steps(app, pilot):
        assert "a in map" in "\n".join(screen(app))
        link = TransformStamped(seconds(1000), "map", "turtle1", Transform())
        other = TransformStamped(seconds(1000), "map", "turtle2", Transform())
        scene.world.broadcast([link, other], "me", static=True)
        await settled(pilot)
        assert "turtle1 in turtle2" in "\n".join(screen(app))

    visit(scene, (100, 30), steps)


def test_an_empty_world_says_so(frames):
    text = "\n".join(shown(frames({})))

    assert "No frames yet." in text
    assert "there are no frames yet" in text
    assert "turtle1 in turtle2" not in text
    assert "Log messages appear here." in text


def test_five_thousand_frames_are_shown(frames):
    scene = frames({f"f{n}": (f"f{n // 3}", 0.1, 1.0) for n in range(1, 5000)})

    assert "f4999 in f0" in "\n".join(shown(scene))


def test_nothing_is_painted_while_nothing_changes(danced, monkeypatch):
    painted = []
    refresh = Panel.refresh

    def noting(self, *regions, **how):
        if regions:
            painted.append((self.id, regions))
        return refresh(self, *regions, **how)

    async def steps(app, pilot):
        monkeypatch.setattr(Panel, "refresh", noting)
        for _ in range(6):
            app.look_again()
        app.redraw()

    visit(danced, (100, 30), steps)

    assert painted == []


def test_only_lines_that_changed_are_painted(turtles, monkeypatch):
    scene = turtles(2.0, ())
    painted = []

    async def steps(app, pilot):
        monkeypatch.setattr(
            Panel, "refresh", lambda self, *regions, **how: painted.extend(r.y for r in regions)
        )
        app.panel("field").show([*app.panel("field")._strips[:3]])
        # The recording of drawn rows ends before the app's next update draws the field again.
        monkeypatch.undo()

    visit(scene, (100, 30), steps)

    assert painted == list(range(3, 25))


def test_the_tree_lists_the_frames_that_the_picture_draws(frames, monkeypatch):
    # Only this test updates the screen, however long an update takes.
    monkeypatch.setattr(turtle_app, "LOOKS_PER_SECOND", 1e-6)
    monkeypatch.setattr(turtle_app, "REST", 0.0)
    scene = frames({})

    async def steps(app, pilot):
        for name in "abcde":
            link = TransformStamped(seconds(1000), "map", name, Transform())
            scene.world.broadcast([link], "me", static=True)
            app.look_again()
            await pilot.pause()
            beside = "\n".join(told(screen(app)))
            assert "No frames yet." not in beside
            assert f"{name} in map" in beside
            app.look_again()
            await pilot.pause()
            tree = [line.split() for line in told(screen(app)) if "static" in line]
            assert len(tree) == "abcde".index(name) + 1

    visit(scene, (200, 60), steps)


def test_the_numbers_beside_every_picture_belong_to_its_moment(frames, monkeypatch):
    monkeypatch.setattr(turtle_app, "LOOKS_PER_SECOND", 1e-6)
    monkeypatch.setattr(turtle_app, "REST", 0.0)
    scene = frames({})
    now = scene.world.clock.now()

    async def steps(app, pilot):
        for place in (1.0, 2.0, 3.0, 4.0):
            link = TransformStamped(now + seconds(place), "map", "base", Transform((place, 0, 0)))
            scene.world.broadcast([link], "me")
            app.look_again()
            await pilot.pause()
            beside = "\n".join(told(screen(app)))
            assert f"xyz   {place:7.3f}" in beside
            assert f"distance {place:.3f} m" in beside

    visit(scene, (120, 40), steps)


def test_frames_that_come_later_get_a_line_of_the_tree(frames):
    scene = frames({"a": ("map", 1.0, 1.0)})

    async def steps(app, pilot):
        before = app.panel("tree").size.height
        for name in "bcdef":
            link = TransformStamped(seconds(1000), "map", name, Transform())
            scene.world.broadcast([link], "me", static=True)
        app.redraw()
        await settled(pilot)
        assert app.panel("tree").size.height == before + 5

    visit(scene, (100, 40), steps)


@pytest.mark.parametrize(
    ("environment", "encoding", "expected"),
    [
        ({"TERM": "xterm-256color"}, "utf-8", Setting()),
        ({"TERM": "linux"}, "utf-8", Setting(ascii_only=True)),
        ({"TERM": "xterm"}, "iso-8859-1", Setting(ascii_only=True)),
        ({"LC_ALL": "C"}, "UTF-8", Setting(ascii_only=True)),
        ({"NO_COLOR": "1"}, "UTF8", Setting(colors=False)),
        ({"NO_COLOR": ""}, "UTF8", Setting()),
        ({"COLORFGBG": "0;15"}, "utf-8", Setting(light=True)),
    ],
)
def test_the_terminal_is_asked_what_it_can_show(environment, encoding, expected):
    assert setting_from(environment, encoding, Setting()) == expected


def test_the_help_for_the_keys_is_whole_on_a_screen_of_24_rows(danced):
    keys = {"press": lambda key: None, "scenarios": lambda: OFFERED}
    lines = "\n".join(shown(danced, size=(80, 24), keys=("?",), **keys))

    assert "drive turtle1" in lines
    assert "another scenario" in lines
    assert "close these keys" in lines
    assert re.search(r"q  +quit", lines)


def test_new_frames_are_listed_without_another_look(frames, monkeypatch):
    monkeypatch.setattr(turtle_app, "LOOKS_PER_SECOND", 1e-6)
    monkeypatch.setattr(turtle_app, "REST", 0.0)
    scene = frames({})

    async def steps(app, pilot):
        now = seconds(1000)
        links = [TransformStamped(now, "map", name, Transform()) for name in "abcdef"]
        scene.world.broadcast(links, "me", static=True)
        app.look_again()
        await pilot.pause()
        await pilot.pause()
        listed = [line.split() for line in told(screen(app)) if "static" in line]
        assert len(listed) == 6

    visit(scene, (120, 40), steps)


def test_a_world_whose_static_frames_arrive_first_is_shown_from_above(frames):
    scene = frames({})
    up = TransformStamped(seconds(1000), "base", "laser", Transform((0.0, 0.0, 3.0)))
    scene.world.broadcast([up], "me", static=True)

    async def steps(app, pilot):
        assert app.field.in_space
        now = scene.world.clock.now()
        scene.world.broadcast([TransformStamped(now, "map", "base", Transform())], "me")
        await settled(pilot)
        assert not app.field.in_space

    visit(scene, (80, 24), steps)
