"""Tests of the tutorial's unmodified files against the reference's vectors, on simulated time."""

import math

import pytest

from tests.ros.tutorial import TUTORIAL, start
from tests.world.nodes.harness import After, At, Before, log_texts, new_world, play
from tests.world.nodes.loop import Loop
from tests.world.nodes.vectors import VECTORS, close, ids, rows
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Kill, Spawn, TeleportAbsolute, Twist, twist
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace, use_workspace
from tftool.ros.launch.engine import Launch
from tftool.world.nodes.turtle_drivers import DrawSquare
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.world import TransformMessage

HEAD_START = 8.0
"""Seconds that pass before t = 0: 500 ticks, more than three periods of the slowest follower."""

ELSEWHERE = {
    "constants": "numbers of the simulator and of our own nodes",
    "normalize_angle": "the simulator's",
    "open_loop": "the simulator's",
    "teleop_sequence": "the simulator's and teleop's",
    "teleport": "the simulator's",
    "spawn_sequence": "the simulator's",
    "pen_sequence": "the simulator's",
    "teleop_keys": "teleop's",
    "teleop_banner": "teleop's",
    "mimic": "a program of turtlesim's, not of the tutorial's",
    "draw_square": "a program of turtlesim's, not of the tutorial's",
    "coincidence": "headings in one place, asked of the buffer",
    "full_lookup": "single questions to the buffer; time_travel asks them in a loop",
    "pid": "gains the tutorial's follower does not have",
    "static_A_B": "static_transform_publisher's",
    "robot_chain": "no turtles",
    "tree_statistics": "the viewers'",
    "stale_fade": "the viewers'",
}
"""Sections that test no file of the tutorial, and what each tests; see tests/world/nodes."""

HERE = {
    "launch_timeline",
    "follower",
    "time_travel",
    "leader_lost",
    "control_law",
    "carrot",
    "static_turtle_cli",
    "rotate_absolute",
    "euler_to_quaternion",
}


def test_no_section_is_left_out_in_silence():
    assert HERE | set(ELSEWHERE) == set(VECTORS) - {"format", "tolerances"}


@pytest.fixture(autouse=True)
def without_ros():
    with ros_free():
        use_workspace(Workspace(TUTORIAL))
        yield


@pytest.mark.parametrize("case", VECTORS["launch_timeline"], ids=ids(VECTORS["launch_timeline"]))
def test_the_launch_file_starts_up_and_steers_as_the_reference_does(case, tmp_path):
    expected = rows(case)
    file = tmp_path / "faster.launch.xml"
    file.write_text(
        f'<launch><set_parameter name="period" value="{case["period"]}"/>'
        '<include file="$(find-pkg-share pkg_tf)/launch/turtle_following.launch.py"/></launch>'
    )
    world = new_world()
    loop = Loop(world, head_start=0.0)
    Launch(world, file, workspace=Workspace(TUTORIAL))
    After(world, (0.0, lambda: setattr(loop, "sim", world.node("turtlesim"))), name="finder")
    loop.sample_at(row["t"] for row in expected)
    play(world, expected[-1]["t"])

    assert loop.errors(expected) == {}
    said = {
        (round((one.stamp - world.clock.epoch) / 1e9, 6), one.text) for one in world.log.records
    }
    for event in case["events"]:
        for key in ("log", "log_sim", "log_expected_behaviour"):
            if event.get(key) is not None:
                assert (event["t"], event[key]) in said
    assert min(loop.commands) == pytest.approx(case["events"][-1]["t"])


def stage(last, steps, *, turtles=(), square=False, times=()):
    """Create a world with broadcasters from t = 0, and programs that start at other times."""
    world = new_world()
    loop = Loop(world, HEAD_START)

    def begin():
        for number in (1, 2):
            start(
                world,
                "turtle_tf_broadcaster",
                *("--ros-args", "-r", f"__node:=broadcaster{number}"),
                *("-p", f"turtlename:=turtle{number}"),
            )
        if square:
            DrawSquare(world, reset=False)

    # These steps run before the simulator's tick of the same instant.
    begun = [(HEAD_START + t, lambda words=words: start(world, *words)) for t, words in steps]
    Before(world, *sorted([*begun, (HEAD_START, begin)], key=lambda step: step[0]), name="stage")
    loop.sim = Turtlesim(world, turtles=turtles)
    loop.sample_at(sorted({*times, *range(int(last) + 1)}))
    return world, loop


def listener(period, source_frame="turtle1"):
    """Return the tutorial's listener, and its start time for a first lookup at t = 0."""
    words = ("turtle_following", "--ros-args", "-r", "__node:=listener", "-p", f"period:={period}")
    return -3 * period, (*words, "-p", f"source_frame:={source_frame}")


@pytest.mark.parametrize("case", VECTORS["follower"], ids=ids(VECTORS["follower"]))
def test_the_listener_steers_as_the_reference_does(case):
    expected = rows(case)
    last = expected[-1]["t"]
    carrot = "carrot1" in case["leader"]
    world, loop = stage(
        last,
        [
            listener(case["period"], "carrot1" if carrot else "turtle1"),
            *([(-0.1, ("fixed_carrot",))] if carrot else []),
        ],
        square="draw_square" in case["leader"],
        times=[row["t"] for row in expected],
    )
    play(world, HEAD_START + last)

    assert loop.errors(expected) == {}


@pytest.mark.parametrize("case", VECTORS["time_travel"], ids=ids(VECTORS["time_travel"]))
def test_travelling_in_time_steers_as_the_reference_does(case):
    expected = rows(case)
    last, period = expected[-1]["t"], case["period"]
    program = "first_time_travel" if "wrong question" in case["query"] else "time_travel"
    world, loop = stage(
        last,
        [(-period, (program, "--ros-args", "-p", f"period:={period}"))],
        turtles=[build(Spawn.Request, 4.0, 2.0, 0.0, "turtle2")],
        square=True,
    )
    play(world, HEAD_START + last)

    assert loop.errors(expected) == {}
    assert min(loop.commands) == case["delay"]
    assert any("extrapolation into the past" in text for text in log_texts(world, program))


def test_a_lost_leader_is_followed_blindly_until_the_cache_forgets():
    case = VECTORS["leader_lost"]
    expected = rows(case)
    last = expected[-1]["t"]
    world, loop = stage(last, [listener(case["period"])])
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


@pytest.mark.parametrize("case", VECTORS["control_law"], ids=lambda case: str(case["turtle1"]))
def test_one_look_at_the_leader_gives_the_command_of_the_reference(case):
    world, loop = stage(0, [listener(1.0)])
    # Only the relative position counts, and the field has no negative positions.
    aside = max(0.0, -min(case["turtle1"][:2]))

    async def place():
        for name in ("turtle1", "turtle2"):
            x, y, theta = case[name]
            request = build(TeleportAbsolute.Request, x + aside, y + aside, theta)
            await world.call(f"{name}/teleport_absolute", request)

    At(world, (HEAD_START - 0.5, place))
    play(world, HEAD_START)
    command = loop.commands[0.0]

    assert close(command.linear.x, case["linear"], "linear")
    # The target is straight behind, so both directions are equally short.
    angular = abs(command.angular.z) if case["angular"] > 3.14159 else command.angular.z
    assert close(angular, case["angular"], "angular")


def sent_by(executable, until):
    world = new_world()
    sent = []
    world.topic("tf", TransformMessage).subscribe(lambda message: sent.extend(message.transforms))
    start(world, executable)
    play(world, until)
    return sent


def test_the_fixed_carrot_hangs_where_the_reference_says():
    case = VECTORS["carrot"]["fixed"]
    sent = sent_by("fixed_carrot", 1.0)

    assert len(sent) == case["rate_hz"]
    assert {(one.frame_id, one.child_frame_id) for one in sent} == {(case["parent"], case["child"])}
    for one in sent:
        assert one.transform.translation == tuple(case["xyz"])
        assert one.transform.rotation == tuple(case["quaternion"])


def test_the_dynamic_carrot_jumps_as_the_reference_says():
    case = VECTORS["carrot"]["dynamic"]
    sent = {round(one.stamp / 1e9 - 1000, 6): one for one in sent_by("dynamic_carrot", 3.0)}
    # The clock starts at an even second, and the carrot is sent ten times a second.
    told = [row for row in rows(case) if row["clock_seconds"] in sent]

    assert len(sent) == 3 * case["rate_hz"]
    assert len(told) == 8
    for row in told:
        found = sent[row["clock_seconds"]].transform.translation
        wanted = (row["whole_second_x"], row["whole_second_y"], 0.0)
        assert found == pytest.approx(wanted, abs=1e-8)


@pytest.mark.parametrize("case", VECTORS["static_turtle_cli"], ids=lambda case: str(case["args"]))
def test_the_static_turtles_arguments_mean_what_the_reference_says(case):
    world = new_world()
    ended = []
    start(world, "static_turtle", *case["args"], on_exit=ended.append)
    play(world, 1.0)

    if "exit" in case:
        assert [program.status for program in ended] == [case["exit"]]
        return
    found = world.buffer.lookup_transform(case["frame"], case["child"]).transform
    assert found.translation == pytest.approx(case["xyz"])
    assert found.rotation == pytest.approx(case["xyzw"], abs=1e-9)


@pytest.mark.parametrize("case", VECTORS["rotate_absolute"], ids=ids(VECTORS["rotate_absolute"]))
def test_the_action_client_hears_of_a_rotation_what_the_reference_says(case):
    world = new_world()
    probe = build(Spawn.Request, 5.5, 5.5, case["start_theta"], "probe")
    sim = Turtlesim(world, turtles=[probe])
    patience = ["10"] if case["outcome"] == "canceled" else []
    start(
        world,
        "rotate",
        *(str(case["goal_theta"]), *patience),
        *("--ros-args", "-r", "/turtle1/rotate_absolute:=/probe/rotate_absolute"),
    )
    if case["outcome"] == "aborted":
        stop = world.topic("probe/cmd_vel", Twist)
        At(world, (0.16, lambda: stop.publish(twist())))
    play(world, 4.0)

    delta, count = f"{case['result_delta']:.4f}", case["feedback_count"]
    assert log_texts(world, "rotate") == [
        "Goal accepted",
        f"Result: {delta} after {count} feedbacks",
    ]
    assert close(sim.turtles["probe"].place.theta, case["final_theta"], "theta")


@pytest.mark.parametrize("case", VECTORS["euler_to_quaternion"], ids=lambda case: str(case["rpy"]))
def test_euler_angles_turn_as_the_reference_says(case):
    from tf_transformations import quaternion_from_euler

    found = quaternion_from_euler(*case["rpy"])

    # Both signs are the same rotation.
    assert abs(sum(a * b for a, b in zip(found, case["xyzw"], strict=True))) == pytest.approx(
        1.0, abs=1e-8
    )
    assert math.hypot(*found) == pytest.approx(1.0)
