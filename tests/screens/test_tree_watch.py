"""Tests of the screen of `tftool tree --watch`: scrolled, sorted, filtered."""

import asyncio
import shutil

import pytest
from rich.cells import cell_len

from tests.terminals import Terminal
from tests.world.nodes.harness import new_world
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.drawing.solids import solids_of
from tftool.geometry.rigid import Transform
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.urdf import parse_description
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.tree_app import TreeWatch


def shown(*keys, frames=60, size=(80, 24), news="", framed=False, solids=None, **setting):
    """Return the rows and the footer after some keys; the tree is a fan below `world`.

    The size is that of both without their frame and the title bar, unless `framed`.
    """
    if not framed:
        size = size[0] + 2, size[1] + 3
    world = new_world()
    now = world.clock.now()
    for n in range(frames):
        pose = Transform((float(n), 0.0, 0.0))
        # The last frame has the highest rate and the newest sample.
        samples = [
            TransformStamped(
                now - seconds(0.1 * (frames - n) + step), "world", f"link_{n:02}", pose
            )
            for step in (2.0 * (frames - n) / frames, 0.0)
        ]
        for sample in samples:
            world.buffer.set_transform(sample, "me")
    app = TreeWatch(world, lambda _: {"link_01": ("two-parents",)}, setting=Setting(**setting))
    app.solids = solids
    lines = []

    async def main():
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            app.look_again()
            # A key may need a panel that only the next refresh shows.
            await pilot.pause()
            await pilot.press(*keys)
            if news:
                app.tell(news)
            await pilot.pause()
            if app.is_running:
                strips = app.screen._compositor.render_strips(app.size)
                lines.extend(strip.text for strip in strips)

    asyncio.run(main())
    assert app.failure is None
    assert [cell_len(line) for line in lines] == [size[0]] * len(lines)
    if lines and not framed:
        assert "live" in lines[0]
        lines = [*(line[1:-1] for line in lines[2:-2]), lines[-1]]
    return [line.rstrip() for line in lines]


def test_a_frame_that_stopped_has_rate_zero():
    # Edge n has a rate of 200 / (200 - n) Hz and an age of (200 - n) / 10 s.
    old = next(line for line in shown(frames=200, size=(120, 24)) if "link_00" in line)
    new = next(line for line in shown("G", frames=200, size=(120, 24)) if "link_198" in line)

    assert "0.00 Hz" in old
    assert "100.0 Hz" in new


def first_words(lines):
    return [line.split()[0] for line in lines if line]


def test_frames_that_do_not_fit_are_counted():
    lines = shown()

    assert lines[0].startswith("at 1000.000")
    assert lines[1] == "world"
    assert "link_20" not in "".join(lines)
    # There are 61 frames, and room for 21 between the heading and the two lines at the bottom.
    assert lines[-2] == "↓ 40 more"
    assert lines[-1].startswith(" s sort: tree  / filter")
    assert lines[-1].endswith("q quit")


def test_all_of_it_needs_no_count():
    lines = shown(size=(80, 63))

    assert "more" not in "".join(lines)
    assert "link_59" in lines[-2]


@pytest.mark.parametrize(
    ("keys", "top", "told"),
    [
        (["down"], "link_00", "↓ 39 more   ↑ 1 above"),
        (["j", "j", "k"], "link_00", "↓ 39 more   ↑ 1 above"),
        (["pagedown"], "link_19", "↓ 20 more   ↑ 20 above"),
        (["end"], "link_39", "↑ 40 above"),
        (["G", "up"], "link_38", "↓ 1 more   ↑ 39 above"),
        (["end", "home"], "world", "↓ 40 more"),
    ],
)
def test_keys_scroll(keys, top, told):
    lines = shown(*keys)

    assert top in lines[1]
    assert lines[-2] == told


def test_s_sorts_by_name_rate_age_and_broadcaster():
    assert "link_59" in shown("s", "s")[1]
    assert "link_00" in shown("s", "s", "s")[1]
    assert "sort: broadcaster" in shown("s", "s", "s", "s")[-1]
    assert shown("s", "s", "s", "s", "s")[1] == "world"


def test_letters_behind_a_slash_filter_and_escape_shows_all():
    lines = shown("slash", *"K_5")

    assert lines[-1] == " filter: K_5_"
    assert first_words(lines[:-1]) == ["at", "world", *["├──"] * 9, "└──"]
    assert all(f"link_5{n}" in line for n, line in enumerate(lines[2:12]))
    assert "filter: K_5  Esc all frames" in shown("slash", *"K_5", "enter")[-1]
    assert shown("slash", *"K_5", "enter", "escape")[-2] == "↓ 40 more"
    assert "link_03" in "".join(shown("slash", *"05", "backspace", "3"))


def test_q_in_a_filter_is_a_letter_and_else_the_end():
    assert "filter: q_" in shown("slash", "q")[-1]
    assert shown("q") == []


def test_a_frame_with_two_parents_is_marked_in_its_line():
    (line,) = [line for line in shown() if "link_01" in line]

    assert line.endswith("two-parents")


def test_news_are_told_in_place_of_the_keys_until_one_is_pressed():
    assert shown(news="the host \x1b[2J left")[-1] == "the host ␛[2J left"


@pytest.mark.parametrize("size", [(30, 5), (12, 2), (200, 60)])
@pytest.mark.parametrize("frames", [0, 3, 60])
def test_it_fits_into_any_terminal(size, frames):
    assert shown("down", size=size, frames=frames, framed=True, ascii_only=True)


@pytest.mark.skipif(shutil.which("tmux") is None, reason="needs tmux")
def test_in_a_terminal_it_takes_keys_and_leaves_it_as_it_was(tmp_path):
    # The terminal is so low that no picture with the names of all frames fits below the tree.
    terminal = Terminal(tmp_path, 80, 18, ("-m", "tftool", "tree", "robot", "--watch"), {})
    try:
        terminal.shows("laser_point")
        terminal.press("s")
        terminal.shows("sort: name")
        terminal.press("/", "o", "d", "Enter")
        terminal.until(lambda screen: "odom" in screen and "laser" not in screen, "only odom")
        terminal.press("q")
        terminal.ended(0)
    finally:
        terminal.tmux("kill-server")


def test_a_key_shows_the_frames_in_space_and_back():
    lines = shown("p", frames=3)

    assert "grid " in lines[-2]
    assert any("link_02" in line for line in lines)
    assert "broadcaster" in shown("p", "p", frames=3)[0]
    assert lines != shown("p", "w", frames=3)


def test_a_tree_that_leaves_rows_free_has_the_picture_below_it():
    lines = shown(frames=3)

    assert "broadcaster" in lines[0]
    assert "grid " in lines[-2]
    assert any("link_02" in line for line in lines[8:])
    assert lines != shown("w", frames=3)
    assert not any("grid " in line for line in shown(frames=60))


def test_keys_are_told_and_closed():
    told = shown("question_mark", framed=True)

    assert any("scroll by a page" in line for line in told)
    assert not any("scroll by a page" in line for line in shown("question_mark", "escape"))


def test_the_shapes_of_a_described_robot_are_drawn_in_space():
    link = '<link name="link_01"><visual><geometry><sphere radius="1"/></geometry></visual></link>'
    described = parse_description(f'<robot name="ball">{link}</robot>')
    solids, _ = solids_of(described.links.values(), MeshFolders())

    drawn = "".join(shown("p", frames=3, solids=solids))

    assert sum(drawn.count(sign) for sign in "░▒▓█") > 20
    assert not any(sign in "".join(shown("p", frames=3)) for sign in "▒▓")
