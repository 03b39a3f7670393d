import pytest

from tests.world.nodes.harness import At, new_world, play
from tests.world.nodes.vectors import VECTORS, close, rows
from tftool.base.errors import NodeArgumentsError
from tftool.base.stamps import seconds
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Pose, RotateAbsolute, Twist, twist
from tftool.world.nodes.broadcasters import DynamicCarrot, FixedCarrot, carrot_offset, static_turtle
from tftool.world.nodes.turtle_drivers import BANNER, KEYS, DrawSquare, Mimic, State, Teleop
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.world import TransformMessage


@pytest.mark.parametrize("case", VECTORS["teleop_keys"], ids=lambda case: case["key"])
def test_each_key_does_what_the_reference_says(case):
    key = case["key"].removeprefix("arrow_")
    world = new_world()
    twists, goals = [], []
    world.topic("turtle1/cmd_vel", Twist).subscribe(twists.append)
    world.serve_action("turtle1/rotate_absolute", goals.append)
    teleop = Teleop(world)
    hands = At(world, (0.5, lambda: teleop.press(key)))
    play(world, 1.0)

    assert hands.answers == [case["action"]]
    wanted_twists = [twist(**case["value"])] if case["action"] == "cmd_vel" else []
    assert twists == wanted_twists
    wanted = [build(RotateAbsolute.Goal, case["value"])] if case["action"] == "rotate" else []
    assert [one.request for one in goals] == wanted


def test_no_key_is_there_that_the_reference_does_not_know():
    assert set(KEYS) == {one["key"].removeprefix("arrow_") for one in VECTORS["teleop_keys"]}


def test_the_banner_is_the_newer_versions_because_small_letters_work():
    assert list(BANNER) == VECTORS["teleop_banner"]["jazzy_and_later"]
    older = [line.lower() for line in VECTORS["teleop_banner"]["humble_iron"]]
    assert [line.lower() for line in BANNER] == older


@pytest.mark.parametrize("case", VECTORS["mimic"])
def test_a_copy_drives_by_the_leaders_pose(case):
    world = new_world()
    found = []
    world.topic("turtle2/cmd_vel", Twist).subscribe(found.append)
    Mimic(world)
    pose = build(Pose, 1.0, 2.0, 3.0, **case["pose"])
    At(world, (0.1, lambda: world.topic("turtle1/pose", Pose).publish(pose)))
    play(world, 0.2)

    assert found == [twist(**case["cmd"])]


@pytest.mark.parametrize("case", VECTORS["static_turtle_cli"], ids=lambda case: str(case["args"]))
def test_the_static_turtles_arguments_mean_what_the_reference_says(case):
    if "exit" in case:
        with pytest.raises(NodeArgumentsError) as refused:
            static_turtle(case["args"])
        assert refused.value.status == case["exit"]
        return
    stamped = static_turtle(case["args"])
    assert (stamped.frame_id, stamped.child_frame_id) == (case["frame"], case["child"])
    assert stamped.transform.translation == pytest.approx(case["xyz"])
    assert stamped.transform.rotation == pytest.approx(case["xyzw"], abs=1e-9)


def test_squares_are_drawn_tick_for_tick_as_in_the_reference():
    case = VECTORS["draw_square"]
    expected = rows(case)
    world = new_world()
    sim = Turtlesim(world)
    square = DrawSquare(world, reset=False)
    events = []

    class Watcher(At):
        async def run(self):
            known = None
            async for now in self.every(seconds(0.016), immediately=True):
                state = (square.state, square.goal)
                if state != known:
                    tick = (now - self.clock.epoch) // seconds(0.016)
                    events.append((tick, *state, sim.turtles["turtle1"].pose))
                    known = state

    Watcher(world)
    play(world, expected[-1]["t"])

    kinds = {
        "first_goal": State.FORWARD,
        "new_forward_goal": State.FORWARD,
        "reached_position": State.STOP_FORWARD,
        "new_turn_goal": State.TURN,
        "reached_heading": State.STOP_TURN,
    }
    assert [(tick, state) for tick, state, _, _ in events] == [
        (row["tick"], kinds[row["event"]]) for row in expected
    ]
    for (_, _, goal, pose), row in zip(events, expected, strict=True):
        assert row["t"] == pytest.approx(row["tick"] * 0.016)
        for name, kind in (("x", "xy"), ("y", "xy"), ("theta", "theta")):
            assert close(getattr(goal, name), row[f"goal_{name}"], kind)
            assert close(getattr(pose, name), row[name], kind)
    ticks = [row["tick"] for row in expected]
    assert ticks[1] - ticks[0] == case["forward_updates_per_side"]
    # One tick publishes the turn, and the turn takes 244 ticks.
    assert ticks[3] - ticks[2] - 1 == case["turn_updates_per_corner"]
    assert ticks[5] - ticks[1] == case["ticks_per_side_and_corner"]


def test_the_fixed_carrot_hangs_where_the_reference_says():
    case = VECTORS["carrot"]["fixed"]
    world = new_world()
    sent = []
    world.topic("tf", TransformMessage).subscribe(lambda message: sent.extend(message.transforms))
    FixedCarrot(world, "fixed_broadcaster")
    play(world, 1.0)

    assert len(sent) == case["rate_hz"]
    assert {(one.frame_id, one.child_frame_id) for one in sent} == {(case["parent"], case["child"])}
    assert {one.transform for one in sent} == {Transform(case["xyz"], case["quaternion"])}


def test_the_dynamic_carrot_is_where_the_reference_says():
    case = VECTORS["carrot"]["dynamic"]
    for row in rows(case):
        stamp = seconds(row["clock_seconds"])
        assert carrot_offset(stamp, case["radius"]) == pytest.approx(
            (row["continuous_x"], row["continuous_y"]), abs=1e-8
        )
        assert carrot_offset(stamp, case["radius"], whole_seconds=True) == pytest.approx(
            (row["whole_second_x"], row["whole_second_y"]), abs=1e-8
        )


@pytest.mark.parametrize("whole_seconds", [False, True])
def test_the_dynamic_carrot_is_broadcast_as_it_is_computed(whole_seconds):
    case = VECTORS["carrot"]["dynamic"]
    world = new_world()
    sent = []
    world.topic("tf", TransformMessage).subscribe(lambda message: sent.extend(message.transforms))
    DynamicCarrot(world, "dynamic_broadcaster", whole_seconds=whole_seconds)
    play(world, 2.0)

    assert len(sent) == 2 * case["rate_hz"]
    for one in sent:
        assert (one.frame_id, one.child_frame_id) == (case["parent"], case["child"])
        offset = carrot_offset(one.stamp, case["radius"], whole_seconds=whole_seconds)
        assert one.transform == Transform((*offset, 0.0))


@pytest.mark.parametrize("number", ["one", "nan", "1e999", ""])
def test_a_static_turtle_whose_number_is_none_is_refused(number):
    with pytest.raises(NodeArgumentsError, match="is not a finite number") as refused:
        static_turtle(["shelf", number, "0", "0", "0", "0", "0"])

    assert refused.value.status == 2
