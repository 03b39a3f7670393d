import pytest

from tests.world.nodes.harness import After, Before, log_texts, new_world, play
from tests.world.nodes.loop import BEARING_COUNTS_ABOVE, HEAD_START, Loop
from tests.world.nodes.vectors import STRICT, VECTORS, ids, rows
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Kill, Spawn
from tftool.world.clock import SimClock
from tftool.world.nodes.broadcasters import Broadcaster, FixedCarrot
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.turtle_drivers import DrawSquare
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.world import World


def stage(last, period, *, square=False, carrot=False, follow=None, times=()):
    """Create a world in which, at t = 0, turtle2 is at (4, 2) and gets its first command."""
    world = World(SimClock(), Buffer(cache_time=seconds(10)))
    loop = Loop(world)

    def begin():
        for number in (1, 2):
            Broadcaster(world, f"broadcaster{number}", turtle=f"turtle{number}")
        if square:
            DrawSquare(world, reset=False)

    def begin_following():
        Follower(world, "listener", period=seconds(period), spawn=None, **(follow or {}))

    # These steps run before the simulator's tick of the same instant.
    steps = [(HEAD_START - period, begin_following), (HEAD_START, begin)]
    if carrot:
        steps.append((HEAD_START - 0.1, lambda: FixedCarrot(world, "fixed_broadcaster")))
    Before(world, *sorted(steps, key=lambda step: step[0]), name="stage")
    loop.sim = Turtlesim(world, turtles=[build(Spawn.Request, 4.0, 2.0, 0.0, "turtle2")])
    loop.sample_at(sorted({*times, *range(int(last) + 1)}))
    return world, loop


@pytest.mark.parametrize("case", VECTORS["follower"], ids=ids(VECTORS["follower"]))
def test_the_follower_steers_as_the_reference_does(case):
    assert case["first_fire_t"] == 0.0
    expected = rows(case)
    last = expected[-1]["t"]
    leader = case["leader"]
    carrot = "carrot1" in leader
    world, loop = stage(
        last,
        case["period"],
        square="draw_square" in leader,
        carrot=carrot,
        follow={"leader": "carrot1"} if carrot else None,
        times=[row["t"] for row in expected],
    )
    play(world, HEAD_START + last)

    assert loop.errors(expected) == {}


@pytest.mark.parametrize("case", VECTORS["time_travel"], ids=ids(VECTORS["time_travel"]))
def test_the_follower_of_the_past_steers_as_the_reference_does(case):
    expected = rows(case)
    wrong_question = "wrong question" in case["query"]
    follow = {"delay": seconds(case["delay"])}
    if wrong_question:
        follow["fixed_frame"] = None
    last = expected[-1]["t"]
    world, loop = stage(last, case["period"], square=True, follow=follow)
    play(world, HEAD_START + last)

    assert loop.errors(expected) == {}
    assert min(loop.commands) == case["delay"]


def test_a_lost_leader_is_followed_blindly_until_the_cache_forgets():
    case = VECTORS["leader_lost"]
    assert case["cache"] == 10.0
    expected = rows(case)
    last = expected[-1]["t"]
    world, loop = stage(last, case["period"])
    After(
        world,
        (HEAD_START + 2.1, lambda: world.call("kill", build(Kill.Request, "turtle1"))),
        name="killer",
    )
    play(world, HEAD_START + last)

    assert loop.errors(expected) == {}
    refusals = [text for text in log_texts(world, "listener") if text.startswith("Could not")]
    assert len(refusals) == 4
    assert all("extrapolation into the past" in text for text in refusals)


@pytest.mark.parametrize("case", VECTORS["launch_timeline"], ids=ids(VECTORS["launch_timeline"]))
def test_the_demo_starts_up_and_steers_as_the_reference_does(case):
    expected = rows(case)
    last = expected[-1]["t"]
    world = new_world()
    loop = Loop(world, head_start=0.0)
    loop.sim = Turtlesim(world)
    for number in (1, 2):
        Broadcaster(world, f"broadcaster{number}", turtle=f"turtle{number}")
    Follower(world, "listener", period=seconds(case["period"]))
    loop.sample_at(row["t"] for row in expected)
    play(world, last)

    assert loop.errors(expected) == {}
    said = {
        (round((one.stamp - world.clock.epoch) / 1e9, 6), one.text) for one in world.log.records
    }
    for event in case["events"]:
        for key in ("log", "log_sim", "log_expected_behaviour"):
            if event.get(key) is not None:
                assert (event["t"], event[key]) in said
    assert not any(text == "Service is not ready" for _, text in said)
    assert min(loop.commands) == pytest.approx(case["events"][-1]["t"])


def test_headings_are_left_out_only_near_the_goal():
    note = VECTORS["tolerances"]["strict"]["note"]

    assert f"> {BEARING_COUNTS_ABOVE}" in note
    assert STRICT["distance"] == 2e-6
