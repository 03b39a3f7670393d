"""Tests of worlds made from scenarios: equal in every run, with all actions of a script."""

import asyncio
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

import tftool
from tftool.base.errors import NodeFailed, TftoolError, UsageError
from tftool.base.stamps import seconds
from tftool.messages.turtle_messages import Pose
from tftool.scenario import builtin
from tftool.scenario.load import load, parse
from tftool.scenario.play import build, left_to_a_person, run_scenario
from tftool.world.clock import SimClock, run
from tftool.world.node import Node
from tftool.world.world import TransformMessage


def play(text, *, by_hand=False):
    """Run a scenario on simulated time."""
    clock = SimClock()
    scenario = parse(text, "s.yaml")
    played = build(left_to_a_person(scenario) if by_hand else scenario, clock)
    run(clock, played.live())
    return played


def logged(played):
    """Return the log messages, with their nodes."""
    return [(record.node, record.text) for record in played.world.log.records]


def history(name):
    """Return all transforms, messages and logs of a scenario, to the last bit."""
    clock = SimClock()
    played = build(load(builtin.path_of(name)), clock)
    heard = []
    listened = set()

    def hear_new_topics():
        for topic_name, topic in played.world.topics().items():
            if topic_name not in listened:
                listened.add(topic_name)
                topic.subscribe(heard.append)

    played.world.watch(hear_new_topics)
    hear_new_topics()
    played.world.log.listen(heard.append)
    run(clock, played.live())
    return heard, played.verdict()


@pytest.mark.parametrize("name", builtin.names())
def test_two_runs_are_equal_to_the_last_bit(name):
    first, first_verdict = history(name)
    second, second_verdict = history(name)

    assert len(first) >= (1 if name == "static" else 500)
    assert first == second
    assert repr(first) == repr(second)
    assert first_verdict == second_verdict


def test_it_lasts_as_long_as_it_says_its_last_instant_included():
    played = play("duration: 2.5 s\nexpect:\n  - {at: 2.5 s, trees: 0}\n")

    assert played.world.clock.now() == played.start + seconds(2.5)
    assert played.verdict().ok
    assert played.verdict().lasted == seconds(2.5)


def test_an_expectation_that_is_not_reached_is_reported_but_fails_no_verdict():
    clock = SimClock()
    text = "duration: 9 s\nexpect:\n  - {at: 1 s, trees: 0}\n  - {at: 8 s, trees: 7}\n"
    played = build(parse(text, "s.yaml"), clock)

    run(clock, played.live(until=clock.now() + seconds(2)))

    held, missed = played.verdict().outcomes
    assert held.ok
    assert (missed.ok, missed.reached, missed.found) == (False, False, "not reached")
    assert played.verdict().ok


def test_an_endless_play_ends_when_the_world_is_stopped():
    clock = SimClock()
    played = build(parse("duration: 1 s\nnodes: [turtlesim]\n", "s.yaml"), clock)

    class Stopper(Node):
        async def run(self):
            await self.clock.sleep(seconds(5))
            self.world.stop()

    Stopper(played.world, "stopper")
    run(clock, played.live(endless=True))

    assert clock.elapsed() == seconds(5)


ONE_SIMULATOR = "duration: 5 s\nnodes: [turtlesim]\nexpect:\n  - {at: 1 s, turtles: [turtle1]}\n"


class Failing(Node):
    """Node that fails at once."""

    async def run(self):
        raise TftoolError("its port is taken")


@contextmanager
def with_one_that_fails(world):
    """Create a scenario's world with a node that fails."""
    Failing(world, "second")
    yield


def test_a_node_that_fails_is_part_of_the_verdict():
    verdict = run_scenario(parse(ONE_SIMULATOR, "s.yaml"), watch=with_one_that_fails)

    assert verdict.failure.startswith("node 'second' failed: TftoolError: its port is taken (")
    assert verdict.lasted == 0
    assert [one.reached for one in verdict.outcomes] == [False]
    assert not verdict.ok


def test_a_node_that_fails_ends_the_play_with_its_name():
    clock = SimClock()
    played = build(parse(ONE_SIMULATOR, "s.yaml"), clock)
    Failing(played.world, "second")

    with pytest.raises(NodeFailed, match="node 'second' failed"):
        run(clock, played.live())


def test_arguments_change_the_world():
    scenario = load(builtin.path_of("turtles"))

    played = build(scenario, SimClock(), {"source_frame": "carrot1"})

    assert played.world.node("follower").leader == "carrot1"
    assert build(scenario, SimClock()).world.node("follower").leader == "turtle1"


def test_arguments_that_do_not_fit_are_refused():
    scenario = load(builtin.path_of("turtles"))

    with pytest.raises(UsageError, match="has no argument 'source'; did you mean 'source_frame'"):
        build(scenario, SimClock(), {"source": "carrot1"})
    with pytest.raises(UsageError, match="'turtle2' cannot follow itself"):
        build(scenario, SimClock(), {"source_frame": "turtle2"})


def test_without_its_script_a_person_drives_and_the_world_goes_on():
    played = play(
        "duration: 5 s\nnodes: [turtlesim]\nscript:\n"
        "  - {at: 0 s, keys: up}\n"
        "  - {at: 1 s, drive: {linear: 1 m/s}, for: 1 s}\n"
        "  - {at: 2 s, spawn: bob}\n"
        "expect: [{at: 1 s, turtles: []}]\n",
        by_hand=True,
    )

    assert [node.name for node in played.world.nodes] == ["turtlesim", "script"]
    assert list(played.world.node("turtlesim").turtles) == ["bob", "turtle1"]
    assert pose(played).x == pytest.approx(5.544445, abs=1e-6)
    assert played.verdict().outcomes == ()


def test_a_scenario_whose_script_only_drives_has_none_without_it():
    played = play(
        "duration: 1 s\nnodes: [turtlesim]\nscript: [{at: 0 s, keys: up}]\n", by_hand=True
    )

    assert [node.name for node in played.world.nodes] == ["turtlesim"]


# The script.

FIELD = "duration: 5 s\nnodes:\n  - turtlesim\n  - broadcaster: {turtle: turtle1}\nscript:\n"


def pose(played, turtle="turtle1"):
    """Return the final pose of a turtle."""
    return played.world.topic(f"{turtle}/pose", Pose).latest


def test_a_drive_moves_for_its_time_and_stops():
    # 2 m/s for a second is 62 or 63 ticks of 16 ms; from 1 s to 2 s there are 62.
    played = play(FIELD + "  - {at: 1.008 s, drive: {linear: 2 m/s}, for: 992 ms}\n")

    assert pose(played).x == pytest.approx(5.544445 + 62 * 0.032, abs=1e-5)
    assert pose(played).linear_velocity == 0.0


def test_keys_reach_the_turtle_through_teleop():
    played = play(FIELD + "  - {at: 1 s, keys: up left, every: 2 s}\n")

    # One key moves the turtle for 63 ticks, so by 2.016 m, and turns it by 2.016 rad.
    assert pose(played).x == pytest.approx(5.544445 + 2.016, abs=1e-5)
    assert pose(played).theta == pytest.approx(2.016, abs=1e-5)
    assert "teleop" in [node.name for node in played.world.nodes]


def test_a_teleop_of_the_scenario_takes_the_keys():
    played = play(
        "duration: 3 s\nnodes:\n  - turtlesim\n  - teleop: {scale_linear: 1 m/s}\n"
        "script:\n  - {at: 1 s, keys: up}\n"
    )

    assert pose(played).x == pytest.approx(5.544445 + 1.008, abs=1e-5)


def test_services_are_called():
    played = play(
        FIELD
        + """\
  - {at: 0.5 s, spawn: {name: bob, x: 1 m, y: 2 m, theta: 90 deg}}
  - {at: 0.5 s, spawn: }
  - {at: 1 s, teleport: {x: 3 m, y: 4 m, theta: 1 rad}}
  - {at: 2 s, hop: {turtle: bob, linear: 1 m, angular: -90 deg}}
  - {at: 3 s, kill: turtle2}
  - {at: 3 s, set_pen: {r: 1, g: 2, b: 3, width: 9}}
"""
    )

    turtles = played.world.node("turtlesim").turtles
    assert list(turtles) == ["bob", "turtle1"]
    assert (pose(played).x, pose(played).y) == (3.0, 4.0)
    assert pose(played).theta == pytest.approx(1.0, abs=1e-6)
    assert pose(played, "bob").x == pytest.approx(2.0, abs=1e-6)
    assert pose(played, "bob").y == pytest.approx(2.0, abs=1e-6)
    assert turtles["turtle1"].width == 9


@pytest.mark.parametrize(
    ("step", "found"),
    [
        ("spawn: turtle1", "the simulator refused a turtle named 'turtle1'"),
        ("kill: bob", "there is no turtle 'bob'"),
        ("teleport: {turtle: bob, x: 1, y: 1}", "no node serves 'bob/teleport_absolute'"),
        ("rotate: {turtle: bob, theta: 1}", "no node serves the action 'bob/rotate_absolute'"),
        ("drive: {turtle: bob, linear: 1}, for: 1 s", "nothing subscribes to 'bob/cmd_vel'"),
        (
            "broadcast: {parent: a, child: a}",
            "the buffer rejected the transform: see the log for the reason",
        ),
        (
            "static: {parent: a, child: a}",
            "the buffer rejected the transform: see the log for the reason",
        ),
    ],
)
def test_a_refused_step_fails_the_scenario_unless_it_is_to_fail(step, found):
    played = play(FIELD + f"  - {{at: 1 s, {step}}}\n  - {{at: 2 s, say: on it goes}}\n")
    expected = play(FIELD + f"  - {{at: 1 s, {step}, fails: yes}}\n")
    kind = step.partition(":")[0]

    (outcome,) = played.verdict().outcomes
    assert not played.verdict().ok
    assert (outcome.line, outcome.found) == (6, f"refused: {found}")
    assert f"{outcome.when}: {outcome.expectation}" == f"at 1 s: step '{kind}'"
    assert ("script", f"Step '{kind}' in line 6 failed: {found}") in logged(played)
    assert ("script", "on it goes") in logged(played)
    assert expected.verdict().ok
    assert len(expected.verdict().outcomes) == 1


@pytest.mark.parametrize(("at", "ok"), [("1 s", False), ("4.5 s", True)])
def test_a_service_that_never_answers_fails_its_step_unless_the_end_came_too_soon(at, ok):
    async def never(request):
        await asyncio.get_running_loop().create_future()

    clock = SimClock()
    text = f"duration: 5 s\nscript:\n  - {{at: {at}, spawn: bob}}\n"
    played = build(parse(text, "s.yaml"), clock)
    played.world.serve("spawn", never)
    run(clock, played.live())

    assert played.verdict().ok is ok
    if not ok:
        (outcome,) = played.verdict().outcomes
        assert outcome.found == "refused: 'spawn' did not answer in the last 4 s of the scenario"


def test_a_step_that_is_to_fail_and_does_not_fails_the_scenario():
    (outcome,) = play(FIELD + "  - {at: 1 s, spawn: bob, fails: yes}\n").verdict().outcomes

    assert (outcome.expected, outcome.found, outcome.ok) == ("fails", "done", False)


def test_a_drive_of_a_turtle_that_comes_while_it_lasts_is_done():
    played = play(
        FIELD
        + "  - {at: 1 s, drive: {turtle: bob, linear: 1}, for: 3 s}\n  - {at: 2 s, spawn: bob}\n"
    )

    assert played.verdict().outcomes == ()
    assert pose(played, "bob").x > 6


def test_clear_and_reset_are_called():
    played = play(FIELD + "  - {at: 1 s, clear: }\n  - {at: 2 s, reset: {}}\n")

    assert ("turtlesim", "Clearing turtlesim.") in logged(played)
    assert ("turtlesim", "Resetting turtlesim.") in logged(played)


def test_a_rotation_turns_the_turtle():
    played = play(FIELD + "  - {at: 1 s, rotate: {theta: 90 deg}}\n")

    # The rotation stops up to 0.02 rad before the goal.
    assert pose(played).theta == pytest.approx(1.552, abs=1e-4)


def test_a_transform_is_broadcast_once_or_for_a_time():
    played = play(
        "duration: 5 s\nscript:\n"
        "  - {at: 1 s, broadcast: {parent: a, child: b, x: 1 m, yaw: 90 deg}}\n"
        "  - {at: 1 s, broadcast: {parent: a, child: c, y: 1 m}, every: 0.5 s, for: 2 s}\n"
        "  - {at: 3 s, broadcast: {parent: a, child: d, stamp: 2 s}}\n"
        "  - {at: 3 s, broadcast: {parent: a, child: e, stamp: now - 1 s}}\n"
        "  - {at: 4 s, static: {parent: a, child: f, z: 1 m}}\n"
    )

    snapshot = played.world.buffer.snapshot(played.world.clock.now())
    samples = {info.frame: (info.samples, info.newest - played.start) for info in snapshot.frames}
    assert samples["b"] == (1, seconds(1))
    assert samples["c"] == (5, seconds(3))
    assert samples["d"] == (1, seconds(2))
    assert samples["e"] == (1, seconds(2))
    assert snapshot.frame("f").is_static
    assert snapshot.frame("b").authority == "script"


def test_a_stopped_node_says_no_more():
    text = (
        "duration: 5 s\nnodes:\n  - turtlesim\n  - broadcaster: {turtle: turtle1, name: b}\n"
        "script:\n  - {at: 2 s, stop: b}\n  - {at: 2 s, say: b is gone}\n"
    )
    clock = SimClock()
    played = build(parse(text, "s.yaml"), clock)
    heard = []
    played.world.topic("tf", TransformMessage).subscribe(heard.append)
    run(clock, played.live())

    # 2 s are 125 ticks after the first one at the start.
    assert [message.authority for message in heard] == ["b"] * 126
    assert ("script", "b is gone") in logged(played)


def test_a_node_is_stopped_once():
    played = play(
        "duration: 1 s\nnodes: [turtlesim]\nscript:\n" + "  - {at: 0 s, stop: turtlesim}\n" * 2
    )

    assert logged(played)[-1] == (
        "script",
        "No node is named 'turtlesim' now, so no node was stopped",
    )


def test_steps_of_one_instant_are_done_in_the_order_of_the_file():
    played = play(
        "duration: 1 s\nscript:\n"
        + "".join(
            f"  - {{at: {at} s, say: '{text}'}}\n" for at, text in [(1, "b"), (0, "a"), (1, "c")]
        )
    )

    assert [text for _, text in logged(played)] == ["a", "b", "c"]


def test_playing_a_scenario_loads_nothing_that_runs_programs_written_for_ros():
    code = (
        "import sys, tftool.scenario.play\n"
        "print([name for name in sys.modules if name.startswith('tftool.ros')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(tftool.__file__).parent.parent,
    )

    assert done.stdout == "[]\n"
