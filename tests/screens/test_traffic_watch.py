"""Tests of the screen of `tftool monitor`: curves of rates and delays."""

import asyncio
import re

import pytest
from rich.cells import cell_len

from tests.screens.visiting import screen
from tests.world.nodes.harness import new_world
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import NetDelay, Traffic
from tftool.drawing.sparklines import TrafficHistory
from tftool.drawing.traffic_curves import TrafficLayout, curves
from tftool.drawing.traffic_view import Chain
from tftool.geometry.rigid import Transform
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.traffic_app import TrafficWatch


def received(frames, now, later=0.0, plates=1):
    """Return five seconds of messages: the first frame at 10 Hz, the others at half of that.

    The first frame's messages end `later` seconds before the messages of the others.
    """
    traffic = Traffic()
    for place, name in enumerate(frames):
        for message in range(50 if place == 0 else 25):
            begin = now - seconds(5.0 if place else 5.0 + later)
            arrival = begin + seconds(message * (0.2 if place else 0.1))
            sample = TransformStamped(arrival - seconds(0.02), "map", name, Transform.identity())
            traffic.receive(arrival, [sample], f"node_{place}", is_static=False)
    for plate in ("plate", "plate_2")[:plates]:
        fixed = TransformStamped(now, "base", plate, Transform.identity())
        traffic.receive(now, [fixed], "static_node", is_static=True)
    return traffic


def shown(
    *keys, frames=("base", "odom"), size=(80, 24), chain=None, later=0.0, plates=1, **setting
):
    """Return the lines of the screen after some keys."""
    world = new_world()
    traffic = received(frames, world.clock.now(), later, plates)
    app = TrafficWatch(world, traffic, chain, Setting(title="tftool monitor", **setting))
    lines = []

    async def main():
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            app.look_again()
            await pilot.press(*keys)
            await pilot.pause()
            if app.is_running:
                lines.extend(screen(app))

    asyncio.run(main())
    assert app.failure is None
    assert [cell_len(line) for line in lines] == [size[0]] * len(lines)
    return lines


def line_of(lines, word):
    return next(place for place, line in enumerate(lines) if word in line)


def test_panels_take_all_rows_of_the_screen_between_title_and_keys():
    for size in ((80, 24), (200, 60)):
        lines = shown(size=size)

        assert "tftool monitor: 3 frames" in lines[0]
        assert "Frames" in lines[1]
        assert lines[-2].startswith("╰")
        assert lines[-1].rstrip().endswith("q quit")
        # Both curves use the rows of their panel.
        tall = line_of(lines, "● odom ") - line_of(lines, "● base ")
        assert tall >= (size[1] - 14) // 2


def test_numbers_and_origin_of_a_frame_are_beside_its_curves():
    text = "\n".join(shown())

    assert "10.00 Hz" in text
    assert "5.00 Hz" in text
    assert "20.0 ms" in text
    assert "in map" in text
    assert "from node_1" in text
    assert "static" in text


def test_the_curve_of_delays_is_said_to_show_maxima():
    (heading,) = (line for line in shown(size=(120, 40)) if "mean delay" in line)

    assert re.search(r"rate last \d+ s .*mean delay max, last \d+ s", heading)


def test_more_frames_than_rows_are_counted_and_scrolled():
    many = [f"link_{n:02}" for n in range(60)]

    lines = shown(frames=many)
    assert any("link_00" in line for line in lines)
    assert "more" in "".join(lines)
    moved = shown("down", "down", frames=many)
    assert not any("link_01" in line for line in moved)
    assert "2 above" in "".join(moved)


def test_frames_are_sorted_by_rate():
    frames = ("zebra", "ant")

    named = shown(frames=frames)
    assert line_of(named, "ant ") < line_of(named, "zebra ")
    rated = shown("s", frames=frames)
    assert line_of(rated, "zebra ") < line_of(rated, "ant ")
    assert "sort: rate" in rated[-1]


def test_a_silent_sender_has_no_rate_and_no_bar_and_is_sorted_last():
    # With two static frames of one publisher, the publishers have a panel of their own.
    lines = shown("s", later=11.0, size=(100, 30), plates=2)

    # The first node sent at 10 Hz until 11 s ago; the second node still sends at 5 Hz.
    first, second = line_of(lines, "│node_0 "), line_of(lines, "│node_1 ")
    assert "10.00 Hz" not in "".join(lines)
    assert "0.00 Hz" in lines[first]
    assert "━" not in lines[first]
    assert "━" in lines[second]
    assert "0.00 Hz" in lines[line_of(lines, "● base ")]
    assert line_of(lines, "● odom ") < line_of(lines, "● base ")


def test_a_chain_names_its_pair_and_its_delay():
    delay = NetDelay()
    delay.add(0.25)

    lines = shown(chain=Chain("odom", "base", ("base", "map", "odom"), delay), size=(120, 40))

    assert "base in odom, net delay 250.0 ms" in lines[0]
    assert "sort: chain" in lines[-1]
    assert not any("plate" in line for line in lines)


@pytest.mark.parametrize("size", [(20, 5), (40, 10), (80, 24), (200, 60)])
def test_ascii_and_small_terminals(size):
    lines = shown(size=size, ascii_only=True)

    assert "".join(lines).isascii()


def test_keys_are_told_and_q_ends_it():
    assert any("light or dark" in line for line in shown("question_mark"))
    assert shown("q") == []


def test_numbered_frames_are_sorted_by_their_numbers():
    lines = shown(frames=("link_10", "link_2", "link_1"))

    places = [line_of(lines, f"● {name} ") for name in ("link_1", "link_2", "link_10")]
    assert places == sorted(places)


def test_bars_have_a_scale_and_small_curves_their_maximum():
    lines = shown(frames=[f"link_{n:02}" for n in range(12)], size=(120, 24))

    # The fastest node sends at 10 Hz; the scale is a round number above its rate.
    heading = lines[line_of(lines, "broadcaster ")]
    assert heading.rstrip(" │").endswith("12 Hz")
    row = lines[line_of(lines, "● link_00 ")]
    assert row.count("20.0 ms") == 1
    assert row.rstrip(" │").endswith("20 ms")


def test_publishers_of_one_frame_each_have_no_panel_of_their_own():
    assert not any("Broadcasters" in line for line in shown())
    assert any("Broadcasters" in line for line in shown(plates=2))


def test_a_spike_at_the_start_is_cut_and_marked_and_its_scale_has_a_whole_unit():
    traffic, history = Traffic(), TrafficHistory()
    for place in range(60):
        now = seconds(1000 + 0.25 * place)
        late = 60.0 if place == 1 else 1.1
        sample = TransformStamped(now - seconds(late), "map", "base", Transform.identity())
        traffic.receive(now, [sample], "node")
        history.look(now, traffic)

    lines = curves(now, list(traffic.links.values()), history, TrafficLayout(120, 20))

    # The delay is 1.1 s nearly always; the next round numbers above it are 1.2 s to 2 s.
    top = lines[1].plain
    assert "▲" in top
    assert re.search(r"\b(1\.2|1\.5|2) s\b", top)
    assert re.search(r"\b1[45] s +now\b", lines[-1].plain)
