import asyncio
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.world.nodes.harness import After, At, Before, log_texts, new_world, play
from tftool.base.color import BACKGROUND, Color
from tftool.base.errors import TftoolError, UsageError
from tftool.base.stamps import seconds
from tftool.geometry.motion import CENTRE, FIELD, Placement, Twist2D, float32
from tftool.messages.classes import build
from tftool.messages.turtle_messages import (
    ColorMessage,
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
from tftool.world.clock import SimClock, WallClock, run
from tftool.world.nodes import turtlesim as turtlesim_module
from tftool.world.nodes.trail import BLANK
from tftool.world.nodes.turtle import MOST_WAITING, PEN_COLOR, Turtle
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World

TICK = 0.016
twists = st.builds(twist, st.floats(-9, 9), st.floats(-9, 9), st.floats(-9, 9))


def drive(world, twist, turtle="turtle1"):
    return lambda: world.topic(f"{turtle}/cmd_vel", Twist).publish(twist)


def refusal(call):
    """Return a function that calls another and stores its error, for a step of `At`."""

    async def ask():
        try:
            await call()
        except TftoolError as error:
            return error
        return None

    return ask


def test_a_command_moves_nothing_in_the_instant_it_is_given():
    world = new_world()
    Turtlesim(world)
    poses = []
    world.topic("turtle1/pose", Pose).subscribe(lambda pose: poses.append(pose.x))
    At(world, (2 * TICK, drive(world, twist(1.0))))
    play(world, 4 * TICK)

    still = float32(CENTRE)
    assert poses == [still, still, still, float32(CENTRE + 0.016), float32(CENTRE + 0.032)]


def test_a_command_given_in_a_ticks_instant_waits_for_the_next_tick_whoever_is_first():
    world = new_world()
    Before(world, (2 * TICK, drive(world, twist(1.0))))
    Turtlesim(world)
    poses = []
    world.topic("turtle1/pose", Pose).subscribe(lambda pose: poses.append(pose.x))
    play(world, 3 * TICK)

    still = float32(CENTRE)
    assert poses == [still, still, still, float32(CENTRE + 0.016)]


@pytest.mark.parametrize(("age", "speed"), [(seconds(1), 1.0), (seconds(1) + 1, 0.0)])
def test_a_command_lives_for_exactly_one_second(age, speed):
    turtle = Turtle("turtle1", Placement(1.0, 1.0, 0.0), seconds(5))
    quiet = [].append
    turtle.command(Twist2D(1.0), False, seconds(10), lambda level, text: quiet(text))
    turtle.update(seconds(10) + age, lambda level, text: quiet(text), quiet)

    assert turtle.pose.linear_velocity == speed


@settings(max_examples=25)
@given(st.lists(st.tuples(st.integers(0, 60), twists), max_size=8), st.booleans())
def test_a_turtle_stays_in_the_field_under_any_commands(commands, holonomic):
    world = new_world()
    Turtlesim(world, holonomic=holonomic)
    poses = []
    world.topic("turtle1/pose", Pose).subscribe(poses.append)
    steps = [(tick * TICK, drive(world, twist)) for tick, twist in sorted(commands, key=str)]
    At(world, *sorted(steps, key=lambda step: step[0]))
    play(world, 80 * TICK)

    assert len(poses) == 81
    for pose in poses:
        assert 0.0 <= pose.x <= FIELD
        assert 0.0 <= pose.y <= FIELD
        assert -math.pi <= pose.theta < math.pi
        assert pose.linear_velocity >= 0.0


@settings(max_examples=10)
@given(st.lists(st.tuples(st.floats(0, 2), twists), max_size=5))
def test_two_runs_are_equal_to_the_last_bit(commands):
    def lived():
        world = new_world()
        sim = Turtlesim(world, turtles=[build(Spawn.Request, 1.0, 1.0, 1.0, "other")])
        poses = []
        for name in ("turtle1", "other"):
            world.topic(f"{name}/pose", Pose).subscribe(poses.append)
            steps = sorted(((at, drive(world, twist, name)) for at, twist in commands), key=_when)
            At(world, *steps, name=f"{name}'s hands")
        play(world, 2.5)
        return poses, list(sim.trail.segments), list(world.log.records)

    assert lived() == lived()


def test_turtles_are_updated_in_the_order_of_their_names():
    world = new_world()
    Turtlesim(
        world,
        turtles=[
            build(Spawn.Request, 1, 1, 0, "turtle2"),
            build(Spawn.Request, 2, 2, 0, "turtle10"),
        ],
    )
    heard = []
    for name in ("turtle1", "turtle2", "turtle10"):
        world.topic(f"{name}/pose", Pose).subscribe(lambda _, name=name: heard.append(name))
    play(world, TICK)

    assert heard[3:] == ["turtle1", "turtle10", "turtle2"]


def test_a_sideways_speed_outlives_a_command_that_may_not_set_it():
    world = new_world()
    sim = Turtlesim(world, holonomic=True)
    At(
        world,
        (0.0, drive(world, twist(1.0, 0.0, 1.0))),
        (0.1, lambda: sim.set_parameter("holonomic", False)),
        (0.1, drive(world, twist(2.0, 0.0, 5.0))),
    )
    play(world, 0.5)

    turtle = sim.turtles["turtle1"]
    assert (turtle.forward, turtle.sideways) == (2.0, 1.0)


def test_a_push_against_the_wall_is_told_once_a_second_and_counted_every_time():
    world = new_world()
    sim = Turtlesim(world, turtles=[build(Spawn.Request, FIELD, 5.0, 0.0, "probe")])
    push = drive(world, twist(1.0), "probe")
    At(world, *((0.5 * half, push) for half in range(6)))
    play(world, 3.0)

    told = [text for text in log_texts(world) if text.startswith("Oh no!")]
    assert sim.turtles["probe"].wall_hits == 187
    assert len(told) == 3


@settings(max_examples=25)
@given(st.floats(0.001, 0.015), st.floats(0.001, 0.015), twists)
def test_when_within_a_tick_a_command_comes_does_not_matter(early, late, twist):
    def lived(moment):
        world = new_world()
        sim = Turtlesim(world)
        At(world, (0.1 * TICK + moment * 0.9, drive(world, twist)))
        play(world, 1.5)
        return sim.turtles["turtle1"].place

    assert lived(early) == lived(late)


@settings(max_examples=50)
@given(
    st.lists(
        st.one_of(
            st.tuples(st.just("spawn"), st.sampled_from(["", "turtle1", "turtle3", "a b", "zoe"])),
            st.tuples(st.just("kill"), st.sampled_from(["turtle1", "turtle2", "zoe", "nobody"])),
            st.tuples(st.just("reset"), st.just("")),
        ),
        max_size=12,
    )
)
def test_names_are_given_taken_and_counted_as_a_naive_model_says(operations):
    world = new_world()
    sim = Turtlesim(world)
    names, counter, answers = {"turtle1"}, 1, []

    async def walk_through():
        nonlocal names, counter
        for operation, name in operations:
            if operation == "kill":
                await world.call("kill", build(Kill.Request, name))
                names.discard(name)
            elif operation == "reset":
                await world.call("reset", Empty.Request())
                names, counter = {"turtle1"}, 1
            else:
                wanted = name
                while not wanted:
                    counter += 1
                    if f"turtle{counter}" not in names:
                        wanted = f"turtle{counter}"
                given_name = "" if wanted in names or " " in wanted else wanted
                names |= {given_name} - {""}
                answers.append(
                    (await world.call("spawn", build(Spawn.Request, 1, 1, 0, name)), given_name)
                )

    At(world, (0.0, walk_through))
    play(world, 1.0)

    assert list(sim.turtles) == sorted(names)
    assert all(answer.name == expected for answer, expected in answers)
    assert {name.partition("/")[0] for name in world.services() if "/" in name} == set()


# The colour sensor


def test_the_sensor_reads_blank_ground_and_then_the_fresh_trail():
    world = new_world()
    Turtlesim(world)
    colors = []
    world.topic("turtle1/color_sensor", ColorMessage).subscribe(
        lambda one: colors.append(Color(one.r, one.g, one.b))
    )
    At(world, (TICK, drive(world, twist(1.0))))
    play(world, 4 * TICK)

    # The sensor is read before the line of the same update is drawn.
    assert colors == [BLANK, BLANK, PEN_COLOR, PEN_COLOR]


def test_the_sensor_reads_nothing_of_a_lifted_pen():
    world = new_world()
    sim = Turtlesim(world)
    world.topic("turtle1/color_sensor", ColorMessage).subscribe(lambda _: None)
    At(
        world,
        (0.0, lambda: world.call("turtle1/set_pen", build(SetPen.Request, off=1))),
        (0.1, drive(world, twist(2.0))),
    )
    play(world, 1.0)

    assert world.topic("turtle1/color_sensor", ColorMessage).latest == build(ColorMessage, *BLANK)
    assert sim.trail.drawn == 0


def test_nobody_asking_for_colours_costs_no_message_and_asking_later_tells_the_same():
    world = new_world()
    sim = Turtlesim(world)
    At(world, (0.0, drive(world, twist(1.0, 0.5))))
    play(world, 2.0)

    assert world.topics()["turtle1/color_sensor"].count == 0
    assert sim.color_under("turtle1") == PEN_COLOR


def test_a_teleport_draws_a_straight_stroke_and_the_trail_outlives_its_turtle():
    world = new_world()
    sim = Turtlesim(world)
    At(
        world,
        (
            0.0,
            lambda: world.call(
                "turtle1/teleport_absolute", build(TeleportAbsolute.Request, 1.0, 1.0)
            ),
        ),
        (0.1, lambda: world.call("kill", build(Kill.Request, "turtle1"))),
    )
    play(world, 0.2)

    [segment] = sim.trail.segments
    assert segment[:4] == (CENTRE, CENTRE, 1.0, 1.0)
    assert sim.trail.color_at(3.0, 3.0) == PEN_COLOR


def test_clear_wipes_trails_and_reset_brings_the_start_back():
    world = new_world()
    sim = Turtlesim(world, turtles=[build(Spawn.Request, 1, 1, 0, "other")])
    At(
        world,
        (0.0, drive(world, twist(2.0, 1.0))),
        (0.5, lambda: world.call("clear", Empty.Request())),
        (0.6, lambda: sim.trail.wipes),
        (0.6, lambda: world.call("reset", Empty.Request())),
    )
    play(world, 1.0)

    assert list(sim.turtles) == ["turtle1"]
    assert sim.turtles["turtle1"].place == (CENTRE, CENTRE, 0.0)
    assert sim.trail.drawn == 0
    assert sim.trail.wipes == 2


def test_a_broadcaster_goes_on_when_its_turtle_is_reset():
    world = new_world()
    Turtlesim(world)
    heard = []
    world.topic("turtle1/pose", Pose).subscribe(heard.append)
    At(world, (0.5, lambda: world.call("reset", Empty.Request())))
    play(world, 1.008)

    assert len(heard) == 64


def test_the_topics_of_a_killed_turtle_go_unless_somebody_listens():
    world = new_world()
    Turtlesim(world)
    world.topic("turtle1/pose", Pose).subscribe(lambda _: None)
    At(world, (0.1, lambda: world.call("kill", build(Kill.Request, "turtle1"))))
    play(world, 0.2)

    assert {name for name in world.topics() if name.startswith("turtle1")} == {"turtle1/pose"}
    assert "turtle1/set_pen" not in world.services()


# The rotate action


def test_a_second_goal_aborts_the_first():
    world = new_world()
    Turtlesim(world)
    results = []

    def turn(theta):
        async def ask():
            goal = world.send_goal("turtle1/rotate_absolute", build(RotateAbsolute.Goal, theta))
            results.append((theta, (await goal.result()).status))

        return ask

    At(world, (0.0, turn(1.0)), name="first")
    At(world, (0.1, turn(-1.0)), name="second")
    play(world, 3.0)

    assert results == [(1.0, "aborted"), (-1.0, "succeeded")]
    assert (
        "Rotation goal received before a previous goal finished. Aborting previous goal"
        in log_texts(world)
    )


@pytest.mark.parametrize("at", [0.005, 0.1])
def test_a_goal_ends_aborted_when_its_turtle_goes(at):
    world = new_world()
    Turtlesim(world)
    results = []

    async def ask():
        goal = world.send_goal("turtle1/rotate_absolute", build(RotateAbsolute.Goal, 1.0))
        results.append((await goal.result()).status)

    At(
        world,
        (0.0, lambda: world.call("kill", build(Kill.Request, "turtle1")) if at < 0.01 else None),
        name="a",
    )
    At(world, (0.0, ask), name="b")
    At(world, (at, lambda: world.call("kill", build(Kill.Request, "turtle1"))), name="c")
    play(world, 0.5)

    assert results == ["aborted"]


# Parameters and names


def test_the_background_changes_live_and_leaves_the_trail_alone():
    world = new_world()
    sim = Turtlesim(world)
    At(
        world,
        (0.0, drive(world, twist(2.0))),
        (0.5, lambda: sim.set_parameter("background_r", 1)),
    )
    play(world, 1.0)

    assert Turtlesim(new_world()).background == BACKGROUND
    assert sim.background == Color(1, 86, 255)
    assert sim.trail.drawn == 62


@pytest.mark.parametrize("value", [-1, 256])
def test_a_background_beyond_a_byte_is_refused(value):
    sim = Turtlesim(new_world())

    with pytest.raises(UsageError, match="background_g must be a whole number from 0 to 255"):
        sim.set_parameter("background_g", value)
    assert sim.background == BACKGROUND


def test_a_namespace_stands_before_everything_a_simulator_offers():
    world = new_world()
    Turtlesim(world, "sim", namespace="/turtlesim1/")
    Turtlesim(world, "sim2", namespace="turtlesim2")
    At(world, (0.0, lambda: world.call("turtlesim2/spawn", build(Spawn.Request, 1.0, 1.0))))
    play(world, 0.1)

    assert "turtlesim1/turtle1/pose" in world.topics()
    assert "turtlesim2/turtle2/pose" in world.topics()
    assert "turtlesim1/turtle2/pose" not in world.topics()
    assert log_texts(world)[0] == "Starting turtlesim with node name /turtlesim1/sim"


# Invalid input is refused with a sentence, and the simulator goes on


@pytest.mark.parametrize(
    "name", ["[bold]", "two words", "1st", "a/b", "\x1b[31mred", "turtle\n", "é", "x" * 80 + "!"]
)
def test_a_name_that_cannot_be_is_refused_in_one_readable_line(name):
    world = new_world()
    sim = Turtlesim(world)
    hands = At(world, (0.0, lambda: world.call("spawn", build(Spawn.Request, 1.0, 1.0, 0.0, name))))
    play(world, 0.1)

    assert hands.answers[0].name == ""
    assert list(sim.turtles) == ["turtle1"]
    last = world.log.records[-1]
    assert last.level == "ERROR"
    assert "use letters, digits and '_'" in last.text
    assert last.text.isprintable()
    assert len(last.text) < 200


def test_there_is_an_end_to_turtles(monkeypatch):
    monkeypatch.setattr(turtlesim_module, "MOST_TURTLES", 3)
    world = new_world()
    sim = Turtlesim(world)
    At(
        world,
        *(
            (0.1 * tenth, lambda: world.call("spawn", build(Spawn.Request, 1, 1)))
            for tenth in range(5)
        ),
    )
    play(world, 1.0)

    assert len(sim.turtles) == 3
    assert log_texts(world)[-1] == ("No turtle was spawned: there are 3 already, kill one first")


def test_killing_a_name_full_of_control_codes_is_told_in_one_readable_line():
    world = new_world()
    Turtlesim(world)
    At(world, (0.0, lambda: world.call("kill", build(Kill.Request, "\x1b[2J"))))
    play(world, 0.1)

    assert log_texts(world)[-1] == (r"Tried to kill turtle [\x1b[2J], which does not exist")


@pytest.mark.parametrize(
    ("service", "request_"),
    [
        ("spawn", build(Spawn.Request, math.nan, 1.0)),
        ("spawn", build(Spawn.Request, 1.0, 1e39)),
        ("turtle1/teleport_absolute", build(TeleportAbsolute.Request, 1.0, math.inf)),
        ("turtle1/teleport_relative", build(TeleportRelative.Request, math.nan)),
        ("turtle1/set_pen", build(SetPen.Request, r=256)),
        ("turtle1/set_pen", build(SetPen.Request, width=-1)),
        ("turtle1/set_pen", build(SetPen.Request, g=1.5)),
    ],
)
def test_a_request_with_an_impossible_number_is_refused_and_changes_nothing(service, request_):
    world = new_world()
    sim = Turtlesim(world)
    hands = At(world, (0.0, refusal(lambda: world.call(service, request_))))
    play(world, 0.1)

    assert "must be a" in str(hands.answers[0])
    assert list(sim.turtles) == ["turtle1"]
    assert sim.turtles["turtle1"].place == (CENTRE, CENTRE, 0.0)


def test_a_goal_that_is_no_number_is_refused():
    world = new_world()
    Turtlesim(world)
    goal = build(RotateAbsolute.Goal, math.nan)
    hands = At(world, (0.0, refusal(lambda: world.send_goal("turtle1/rotate_absolute", goal))))
    play(world, 0.1)

    assert "theta must be a finite number" in str(hands.answers[0])


@pytest.mark.parametrize(
    "twist",
    [twist(math.nan, 0.0), twist(0.0, math.inf), twist(0.0, 0.0, -math.inf)],
)
def test_a_command_that_is_not_finite_is_ignored_with_a_sentence_once_a_second(twist):
    world = new_world()
    sim = Turtlesim(world)
    At(world, *((0.1 * tenth, drive(world, twist)) for tenth in range(15)))
    play(world, 2.0)

    assert sim.turtles["turtle1"].place == (CENTRE, CENTRE, 0.0)
    told = [one for one in world.log.records if one.level == "WARN"]
    assert len(told) == 2
    assert "Ignoring a velocity command for [turtle1]" in told[0].text


def test_a_speed_beyond_all_bounds_ends_at_the_wall():
    world = new_world()
    sim = Turtlesim(world)
    At(world, (0.0, drive(world, twist(1e308, 1e308))))
    play(world, 0.1)

    x, y, theta = sim.turtles["turtle1"].place
    assert 0.0 <= x <= FIELD
    assert 0.0 <= y <= FIELD
    assert -math.pi <= theta < math.pi
    assert sim.turtles["turtle1"].pose.linear_velocity == math.inf


def test_a_simulator_may_be_sent_away_by_whoever_hears_a_pose():
    world = new_world()
    sim = Turtlesim(world, turtles=[build(Spawn.Request, 1, 1, 0, "turtle2")])
    heard = []

    def send_away(pose):
        heard.append(pose)
        if len(heard) == 10:
            world.remove(sim)

    world.topic("turtle1/pose", Pose).subscribe(send_away)
    play(world, 1.0)

    assert len(heard) == 10
    assert "spawn" not in world.services()


def test_a_parameter_that_was_forced_too_far_still_is_a_colour():
    sim = Turtlesim(new_world())
    sim.parameters.set("background_r", 999)

    assert sim.background == Color(255, 86, 255)


def test_a_pending_call_is_refused_when_the_simulator_leaves():
    world = new_world()
    sim = Turtlesim(world)
    hands = At(world, (0.0, refusal(lambda: world.call("spawn", build(Spawn.Request, 1.0, 1.0)))))
    At(world, (0.0, lambda: world.remove(sim)), name="remover")
    play(world, 0.5)

    assert str(hands.answers[0]) == "simulator 'turtlesim' has left"


def test_an_answer_nobody_waits_for_any_more_is_dropped():
    world = new_world()
    sim = Turtlesim(world)

    async def give_up():
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(world.call("spawn", build(Spawn.Request, 1.0, 1.0)), 0.001)

    At(world, (0.0, give_up))
    play(world, 0.1)

    assert list(sim.turtles) == ["turtle1", "turtle2"]


def test_a_world_can_be_lived_through_again():
    clock = SimClock()
    world = World(clock)
    sim = Turtlesim(world, turtles=[build(Spawn.Request, 1.0, 1.0, 0.0, "other")])
    play(world, 0.1)
    run(clock, live(world, until=clock.now() + seconds(0.1)))

    assert list(sim.turtles) == ["other", "turtle1"]
    assert not any(one.level == "ERROR" for one in world.log.records)


def test_on_the_wall_clock_a_late_tick_takes_all_that_came():
    world = World(WallClock(rate=50.0))
    sim = Turtlesim(world)
    poses = []

    def watch(pose):
        poses.append(pose)
        if pose.x > poses[0].x:
            world.stop()

    world.topic("turtle1/pose", Pose).subscribe(watch)
    At(world, (0.0, drive(world, twist(1.0))))
    # A busy machine may run no tick for seconds of the world's time.
    After(world, (3000.0, world.stop), name="end")
    run(world.clock, live(world))

    assert poses[-1].x > poses[0].x
    assert sim.turtles["turtle1"].place.y == CENTRE


def _when(step):
    return step[0]


def test_commands_of_a_publisher_that_never_pauses_are_bounded_until_the_next_tick():
    world = new_world()
    sim = Turtlesim(world)
    commands = world.topic("turtle1/cmd_vel", Twist)

    async def flood():
        for _ in range(MOST_WAITING + 5):
            commands.publish(twist(1.0, 0.0))
        try:
            await world.call("clear", Empty.Request())
        except TftoolError as refusal:
            return str(refusal)

    hands = At(world, (0.5, flood))
    play(world, 1.0)

    assert hands.answers == [f"{MOST_WAITING} requests wait for the next tick"]
    assert [text for text in log_texts(world) if "Ignoring" in text] == [
        f"Ignoring a velocity command for [turtle1]: {MOST_WAITING} wait for the next tick already"
    ]
    assert sim.turtles["turtle1"].place.x > 5.544445


def test_two_simulators_of_one_namespace_both_move_and_the_second_names_the_remedy():
    world = new_world()
    first, second = Turtlesim(world), Turtlesim(world, "sim_2")
    At(world, (2 * TICK, drive(world, twist(1.0))))
    play(world, 1.0)

    said = log_texts(world, "sim_2")
    assert [text for text in said if "a namespace of its own" in text] == [
        f"'{first.name}' already provides the services of turtlesim here: give this simulator "
        "a namespace of its own (-r __ns:=/sim2), otherwise both simulators share every topic"
    ]
    placed = [sim.turtles["turtle1"].place for sim in (first, second)]
    assert placed[0] == placed[1]
    assert placed[0].x > CENTRE + 0.5
