"""Tests of `echo` over time, in a world on simulated time."""

import json

import pytest

from tftool.base.errors import BackwardExtrapolationException, LookupException, TransformException
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.commands.echo.command import Printer
from tftool.commands.echo.echo_loop import Echo, LivePrinter
from tftool.commands.shared.pairs import FramePair
from tftool.geometry.rigid import Transform
from tftool.world.clock import SimClock
from tftool.world.link.session_world import Session
from tftool.world.node import Node
from tftool.world.supervisor import live
from tftool.world.world import World


class Mover(Node):
    """Node that moves a frame along x by a metre per second, from one moment to another."""

    def __init__(self, world, child, parent="world", *, start=0.0, end=1e6, name="mover"):
        super().__init__(world, f"{name} of {child}")
        self.child, self.parent = child, parent
        self.start, self.end = seconds(start), seconds(end)

    async def run(self):
        async for now in self.every(seconds(0.1), immediately=True):
            passed = now - self.clock.epoch
            if self.start <= passed <= self.end:
                pose = Transform((passed / 1e9, 0.0, 0.0))
                self.broadcast(TransformStamped(now, self.parent, self.child, pose))


@pytest.fixture
def world():
    return World(SimClock())


def echoed(world, capsys, target="world", source="a", *, printer=None, **options):
    """Run an echo; return its output and its exception."""

    async def alive(until):
        await live(world, until=until)

    at, offset = options.pop("at", 0), options.pop("offset", 0)
    pair = FramePair(target, source, at, offset, options.pop("fixed_frame", None))
    options = {"period": seconds(1), "count": 1, **options}
    echo = Echo(world, pair, printer or Printer(), **options)
    raised = None
    try:
        Session(world, True, "test", alive).run(echo.run())
    except TransformException as error:
        raised = error
    captured = capsys.readouterr()
    return captured.out, captured.err, raised


def places(out):
    return [
        line.partition("[")[2].partition(",")[0]
        for line in out.split("\n")
        if line.startswith("- Translation")
    ]


def test_it_waits_and_says_why_once_for_each_reason(world, capsys):
    Mover(world, "a", start=5)

    out, err, _ = echoed(world, capsys)

    assert err == (
        'Waiting for a in world: Invalid frame ID "world" passed to canTransform argument '
        "target_frame - frame does not exist\n"
    )
    assert out.startswith("At time 1005.0\n")


def test_the_second_reason_is_told_when_it_comes(world, capsys):
    Mover(world, "a", "map", start=1)
    Mover(world, "b", "world", start=2)
    Mover(world, "map", start=5)

    _, err, _ = echoed(world, capsys, "b", "a")

    reasons = [line for line in err.split("\n") if line.startswith("Waiting")]
    assert len(reasons) == 2
    assert '"b" passed to canTransform argument target_frame' in reasons[0]
    assert "not part of the same tree" in reasons[1]


def test_a_frame_nobody_has_heard_of_is_hinted_at_once_there_are_others(world, capsys):
    Mover(world, "a", start=0.5)
    Mover(world, "c", start=5)

    _, err, _ = echoed(world, capsys, "a", "c")

    assert err.split("\n") == [
        'Waiting for c in a: Invalid frame ID "c" passed to canTransform argument source_frame'
        " - frame does not exist",
        "Existing frames so far: a, world. --timeout SECONDS ends the wait.",
        "",
    ]


def test_a_wait_with_a_timeout_does_not_suggest_the_timeout_option(world, capsys):
    Mover(world, "a")

    _, err, raised = echoed(world, capsys, source="c", patience=seconds(3))

    assert err.endswith("\nExisting frames so far: a, world.\n")
    assert isinstance(raised, LookupException)


def test_a_frame_that_arrives_within_half_a_second_is_awaited_without_a_message(world, capsys):
    Mover(world, "a", start=0.5)

    out, err, _ = echoed(world, capsys)

    assert err == ""
    assert places(out) == ["0.500"]


class Departures:
    """Stand-in for a session, with a list of times at which nodes leave."""

    def __init__(self, clock, *moments):
        self.clock, self.moments = clock, [seconds(moment) for moment in moments]

    def __call__(self):
        return sum(moment <= self.clock.elapsed() for moment in self.moments)


def test_a_frame_whose_publisher_left_is_awaited_until_another_publisher_sends_it(world, capsys):
    Mover(world, "a", end=3.05)
    Mover(world, "a", start=10, name="another mover")

    out, err, _ = echoed(world, capsys, count=5, departures=Departures(world.clock, 3.1))

    assert places(out) == ["0.000", "1.000", "2.000", "3.000", "10.000"]
    assert err == "Waiting for a in world: no new transform has arrived since the publisher left\n"


class Shown(list):
    """Stand-in for a screen that stores the first line of each picture."""

    def show(self, picture):
        self.append(picture.plain.partition("\n")[0])


def test_on_a_terminal_what_nobody_sends_any_more_grows_old(world, capsys):
    Mover(world, "a", end=3.05)
    Mover(world, "a", start=7.5, name="another mover")
    shown = Shown()

    echoed(
        world,
        capsys,
        printer=LivePrinter(shown, FramePair("world", "a"), 3, False),
        count=5,
        departures=Departures(world.clock, 3.1),
    )

    ages = [line.removeprefix("a in world  ") for line in shown]
    assert ages == ["0.00 s ago"] * 4 + ["2.0 s ago", "3.0 s ago", "4.0 s ago", "0.00 s ago"]


def test_echo_continues_when_a_publisher_leaves_and_transforms_still_arrive(world, capsys):
    Mover(world, "a")

    out, err, _ = echoed(world, capsys, count=5, departures=Departures(world.clock, 1.5, 2.5))

    assert places(out) == ["0.000", "1.000", "2.100", "3.200", "4.200"]
    assert err == ""


def test_a_static_answer_holds_when_its_sender_has_left(world, capsys):
    world.broadcast([TransformStamped(0, "world", "a", Transform())], "static", static=True)

    out, err, _ = echoed(world, capsys, count=3, departures=Departures(world.clock, 0.5))

    assert len(places(out)) == 3
    assert err == ""


def test_the_wait_for_a_publisher_that_left_ends_with_the_timeout(world, capsys):
    Mover(world, "a", end=3.05)

    out, _, raised = echoed(
        world, capsys, count=9, patience=seconds(2), departures=Departures(world.clock, 3.1)
    )

    assert len(places(out)) == 4
    assert str(raised) == "no new transform has arrived since the publisher left"
    assert world.clock.elapsed() == seconds(6)


def test_a_reason_that_only_counts_time_on_is_told_once(world, capsys):
    Mover(world, "a")

    out, err, _ = echoed(world, capsys, at=world.clock.epoch + seconds(7.05))

    assert err.count("extrapolation into the future") == 1
    assert places(out) == ["7.050"]


def test_it_prints_at_its_rate_until_it_has_printed_enough(world, capsys):
    Mover(world, "a")

    out, err, _ = echoed(world, capsys, period=seconds(0.5), count=4)

    assert places(out) == ["0.000", "0.500", "1.000", "1.500"]
    assert err == ""


def test_when_a_lookup_fails_later_it_says_so_and_goes_on(world, capsys):
    Mover(world, "a", end=2)

    class Cleaner(Node):
        async def run(self):
            await self.clock.sleep(seconds(2.95))
            self.buffer.clear()
            await self.clock.sleep(seconds(1))
            Mover(self.world, "a", name="another")

    Cleaner(world, "cleaner")

    out, _, _ = echoed(world, capsys, count=4)

    assert places(out) == ["0.000", "1.000", "2.000", "3.950"]
    assert out.count("Failure at 1003.000\nException thrown:") == 1
    assert "The current list of frames is:\nFrame a exists with parent NO_PARENT.\n" in out


def test_programs_get_one_object_a_line_failures_included(world, capsys):
    Mover(world, "a")

    class Cleaner(Node):
        async def run(self):
            await self.clock.sleep(seconds(0.95))
            self.world.remove(self.world.node("mover of a"))
            self.buffer.clear()
            await self.clock.sleep(seconds(0.5))
            Mover(self.world, "a")

    Cleaner(world, "cleaner")

    out, _, _ = echoed(world, capsys, count=2, printer=Printer(for_programs=True))

    first, failure, second = map(json.loads, out.splitlines())
    assert first["target"] == "world"
    assert first["stamp_ns"] == world.clock.epoch
    assert failure["error"] == "ConnectivityException"
    assert failure["failed_at_ns"] == world.clock.epoch + seconds(1)
    assert second["stamp_ns"] > first["stamp_ns"]


def test_an_offset_beyond_what_is_remembered_names_the_cache(world, capsys):
    _, err, _ = echoed(world, capsys, offset=-seconds(15), patience=seconds(3))

    assert "only keeps 10 s" in err
    assert "--cache-time 20" in err


def test_the_past_is_asked_for_by_an_offset(world, capsys):
    Mover(world, "a")

    out, err, _ = echoed(world, capsys, offset=-seconds(3), count=2)

    assert places(out) == ["0.000", "1.000"]
    assert err.count("extrapolation into the past") == 1


def test_through_a_fixed_frame_only_the_source_is_of_the_past(world, capsys):
    Mover(world, "a")

    out, _, _ = echoed(world, capsys, "a", "a", offset=-seconds(3), fixed_frame="world", count=2)

    assert places(out) == ["-3.000", "-3.000"]


def test_patience_ends_with_the_refusal_that_stands_and_names_what_there_is(world, capsys):
    Mover(world, "turtle1")

    out, err, raised = echoed(world, capsys, "world", "turtel1", patience=seconds(3))

    assert isinstance(raised, LookupException)
    assert out == ""
    assert "Did you mean turtle1?" in err
    assert world.clock.elapsed() == seconds(3)


def test_a_moment_before_all_that_is_remembered_is_not_waited_for(world, capsys):
    Mover(world, "a", start=5)

    _, _, raised = echoed(world, capsys, at=world.clock.epoch + seconds(1))

    assert isinstance(raised, BackwardExtrapolationException)
    assert world.clock.elapsed() < seconds(6)


def test_a_frame_in_itself_is_the_identity_once_it_is_known(world, capsys):
    Mover(world, "a", start=2)

    out, err, _ = echoed(world, capsys, "a", "a")

    assert err == 'Waiting for a in a: Invalid frame ID "a" - frame does not exist\n'
    assert "At time 1002.0\n- Translation: [0.000, 0.000, 0.000]\n" in out


def test_many_frames_are_not_all_named(world, capsys):
    for number in range(20):
        Mover(world, f"f{number}")

    _, err, _ = echoed(world, capsys, "world", "nobody", patience=seconds(1))

    assert "and 9 more." in err


def test_a_wait_for_a_join_states_the_cause_and_that_no_data_shows_the_join(world, capsys):
    Mover(world, "a")
    Mover(world, "lens", "camera_link")

    _, err, raised = echoed(world, capsys, "world", "lens", patience=seconds(3))

    assert raised is not None
    (line,) = [line for line in err.split("\n") if line.startswith("Waiting")]
    assert "not part of the same tree" in line
    assert " Cause: camera_link has no parent" in line
    # No data shows where the camera is mounted, so no transform is proposed.
    assert "nothing in the data says where to join camera_link" in line
    assert "static_transform_publisher" not in line


def test_a_wait_across_two_clocks_says_which_node_has_the_wrong_one(world, capsys):
    Mover(world, "a")
    pose = TransformStamped(seconds(1_750_000_000), "a", "lens", Transform((1.0, 0.0, 0.0)))
    world.buffer.set_transform(pose, "camera")
    world.buffer.set_transform(pose._replace(stamp=pose.stamp + 1), "camera")

    _, err, raised = echoed(world, capsys, "world", "lens", patience=seconds(3))

    assert raised is not None
    assert "Cause: lens in a is stamped with the wall clock: 1750000000.000 (15 June 2025)." in err
    assert "Cure: use_sim_time: true for the node that publishes lens in a\n" in err
