import pytest

from tests.world.nodes.harness import At, log_texts, new_world, play
from tests.world.nodes.vectors import STRICT, VECTORS, close, ids, mismatch, rows
from tftool.base.color import Color
from tftool.geometry.motion import CENTRE
from tftool.messages.classes import build
from tftool.messages.turtle_messages import (
    Empty,
    Kill,
    Pose,
    RotateAbsolute,
    SetPen,
    Spawn,
    TeleportAbsolute,
    TeleportRelative,
    Twist,
    twist,
)
from tftool.world.nodes.turtle_drivers import Teleop
from tftool.world.nodes.turtlesim import Turtlesim

TICK = 0.016
PROBE = "probe"


class Ticks:
    """Turtle's state after every update, and functions to call after a tick."""

    def __init__(self, world, sim, name=PROBE):
        self.states = {}
        world.topic(f"{name}/pose", Pose).subscribe(self._keep)
        self._turtle = lambda: sim.turtles[name]

    def _keep(self, pose):
        turtle = self._turtle()
        self.states[len(self.states)] = {
            "x": turtle.place.x,
            "y": turtle.place.y,
            "theta": turtle.place.theta,
            "linear_velocity": pose.linear_velocity,
            "angular_velocity": pose.angular_velocity,
            "wall_hits": turtle.wall_hits,
        }


def world_with_probe(start, **options):
    world = new_world()
    spawn = build(Spawn.Request, start[0], start[1], start[2], PROBE)
    sim = Turtlesim(world, turtles=[spawn], **options)
    return world, sim


@pytest.mark.parametrize("case", VECTORS["open_loop"], ids=ids(VECTORS["open_loop"]))
def test_a_turtle_driven_blindly_goes_where_the_reference_goes(case):
    world, sim = world_with_probe(case["start"], holonomic=case.get("holonomic", False))
    ticks = Ticks(world, sim)
    command = twist(**case["cmd"])
    last = case["rows"][-1][0]
    times = range(last) if case["mode"] == "hold" else [0]
    At(
        world,
        *(
            (k * TICK, lambda: world.topic(f"{PROBE}/cmd_vel", Twist).publish(command))
            for k in times
        ),
    )
    play(world, last * TICK)

    missed = {
        row["update"]: found
        for row in rows(case)
        if (found := mismatch(ticks.states[row["update"]], row))
    }
    assert missed == {}
    if "wall" in case:
        wall = case["wall"]
        hits = [ticks.states[k]["wall_hits"] for k in range(last + 1)]
        assert hits.index(1) == wall["first_update"]
        assert hits[last] == wall["warnings_by_last_row"]
        assert next(t for t in log_texts(world) if t.startswith("Oh no")) == wall["first_warning"]


def test_a_new_key_replaces_the_whole_command():
    case = VECTORS["teleop_sequence"]
    world, sim = world_with_probe((CENTRE, CENTRE, 0.0))
    ticks = Ticks(world, sim)
    teleop = Teleop(world, turtle=PROBE)
    At(world, (0.0, lambda: teleop.press("up")), (19 * TICK, lambda: teleop.press("left")))
    play(world, 100 * TICK)

    for row in rows(case):
        assert mismatch(ticks.states[row["update"]], row) == ""


@pytest.mark.parametrize("case", VECTORS["teleport"], ids=ids(VECTORS["teleport"]))
def test_teleports_come_first_in_the_next_update(case):
    world, sim = world_with_probe(case["start"])
    ticks = Ticks(world, sim)
    kinds = {
        "absolute": ("teleport_absolute", TeleportAbsolute.Request),
        "relative": ("teleport_relative", TeleportRelative.Request),
    }
    # All requests are sent before a response arrives, because the tick sends the responses.
    for number, request in enumerate(case["requests"]):
        service, kind = kinds[request["kind"]]
        wish = build(kind, **{name: value for name, value in request.items() if name != "kind"})
        At(
            world,
            (0.0, lambda s=service, w=wish: world.call(f"{PROBE}/{s}", w)),
            name=f"hand{number}",
        )
    At(
        world,
        (0.0, lambda: world.topic(f"{PROBE}/cmd_vel", Twist).publish(twist(**case["cmd"]))),
    )
    play(world, TICK)

    x, y, theta = case["expect"]
    assert mismatch(ticks.states[1], {"x": x, "y": y, "theta": theta}) == ""
    warnings = [one.text for one in world.log.records if one.level == "WARN"]
    assert warnings == ([] if case["warning"] is None else [case["warning"]])


@pytest.mark.parametrize("case", VECTORS["rotate_absolute"], ids=ids(VECTORS["rotate_absolute"]))
def test_the_rotate_action_turns_as_the_reference_does(case):
    world, sim = world_with_probe((CENTRE, CENTRE, case["start_theta"]))
    ticks = Ticks(world, sim)
    feedback, ended = [], []

    async def ask():
        handle = world.send_goal(
            f"{PROBE}/rotate_absolute",
            build(RotateAbsolute.Goal, case["goal_theta"]),
            feedback.append,
        )
        hands.handle = handle
        result = await handle.result()
        ended.append((round((world.clock.elapsed()) / 16e6), result))

    hands = At(world, (0.0, ask))
    if case["id"] == "cancel_before_update_11":
        At(world, (10 * TICK, lambda: hands.handle.cancel()), name="second")
    if case["id"] == "cmd_vel_before_update_11":
        stop = twist()
        At(
            world,
            (10 * TICK, lambda: world.topic(f"{PROBE}/cmd_vel", Twist).publish(stop)),
            name="second",
        )
    play(world, 200 * TICK)

    [(end, result)] = ended
    moving = [one["angular_velocity"] for one in ticks.states.values() if one["angular_velocity"]]
    remaining = [one.remaining for one in feedback]
    assert result.status == case["outcome"]
    assert end == case["ends_at_update"]
    assert len(moving) == case["moving_updates"]
    assert set(moving) == ({float(case["direction"])} if moving else set())
    assert len(remaining) == case["feedback_count"]
    assert close(remaining[0], case["first_feedback"], "theta")
    assert close(remaining[-1], case["last_feedback"], "theta")
    assert close(result.value.delta, case["result_delta"], "theta")
    assert close(ticks.states[200]["theta"], case["final_theta"], "theta")


def test_turtles_come_and_go_under_the_names_of_the_reference():
    world = new_world()
    sim = Turtlesim(world)
    failures = []

    async def walk_through():
        for number, step in enumerate(VECTORS["spawn_sequence"]):
            before = len(world.log.records)
            operation = step["op"]
            if operation == "spawn":
                answer = await world.call(
                    "spawn",
                    build(
                        Spawn.Request, step["x"], step["y"], step.get("theta", 0.0), step["name"]
                    ),
                )
                if answer.name != step["response"]:
                    failures.append((number, answer))
            elif operation == "kill":
                await world.call("kill", build(Kill.Request, step["name"]))
            elif operation == "clear":
                await world.call("clear", Empty.Request())
            elif operation == "reset":
                await world.call("reset", Empty.Request())
            else:
                assert operation == "start"
                before = 0
            new = list(world.log.records)[before:]
            if "log" in step and [one.text for one in new] != step["log"]:
                failures.append((number, new))
            if "level" in step and {one.level for one in new} != {step["level"]}:
                failures.append((number, new))
            if "expect_names" in step and list(sim.turtles) != step["expect_names"]:
                failures.append((number, list(sim.turtles)))

    At(world, (0.0, walk_through))
    play(world, 1.0)

    assert failures == []
    assert list(sim.turtles) == ["turtle1", "turtle2"]


def test_the_pen_changes_as_the_reference_says():
    world = new_world()
    sim = Turtlesim(world)
    found = []

    async def walk_through():
        for step in VECTORS["pen_sequence"]:
            if step["op"] == "set_pen":
                await world.call(
                    "turtle1/set_pen",
                    build(
                        SetPen.Request,
                        *step["request_rgb"],
                        step["request_width"],
                        step["request_off"],
                    ),
                )
            turtle = sim.turtles["turtle1"]
            found.append((turtle.pen_on, turtle.color, turtle.width))

    At(world, (0.0, walk_through))
    play(world, 1.0)

    assert found == [
        (step["pen_on"], Color(*step["rgb"]), step["width_after"])
        for step in VECTORS["pen_sequence"]
    ]


def test_the_strict_tolerance_is_the_one_that_is_used():
    assert not close(STRICT["xy"] * 1.01, 0.0, "xy")
    assert close(STRICT["xy"] * 0.99, 0.0, "xy")
