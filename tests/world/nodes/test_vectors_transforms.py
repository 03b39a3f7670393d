import itertools
import math

import pytest

from tests.world.nodes.vectors import VECTORS
from tftool.base.errors import BackwardExtrapolationException, ForwardExtrapolationException
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry import motion
from tftool.geometry.conversions import quaternion_from_rpy, rpy_from_quaternion
from tftool.geometry.motion import Twist2D, float32
from tftool.geometry.rigid import Transform, heading, transform_from_pose

STAMP = seconds(1000)


def turtles(turtle1, turtle2):
    buffer = Buffer()
    for name, pose in (("turtle1", turtle1), ("turtle2", turtle2)):
        buffer.set_transform(
            TransformStamped(STAMP, "world", name, transform_from_pose(*pose)), "test"
        )
    return buffer


def same_rotation(found, expected):
    return math.isclose(
        abs(sum(a * b for a, b in zip(found, expected, strict=True))), 1.0, abs_tol=1e-8
    )


@pytest.mark.parametrize("case", VECTORS["control_law"], ids=lambda case: str(case["turtle1"]))
def test_one_look_at_the_leader_gives_the_command_of_the_reference(case):
    buffer = turtles(case["turtle1"], case["turtle2"])
    seen = buffer.lookup_transform("turtle2", "turtle1").transform
    command, _ = motion.steer(motion.Law(), motion.AT_REST, *seen.translation[:2], 1.0)

    assert seen.translation[:2] == pytest.approx(case["relative_xy"], abs=2e-8)
    turned = math.remainder(heading(seen) - case["relative_yaw"], math.tau)
    # The reference normalises angles with turtlesim's π, which is off by a few nanoradians.
    assert turned == pytest.approx(0.0, abs=1e-7)
    assert same_rotation(seen.rotation, case["quaternion"])
    assert command.linear_x == pytest.approx(case["linear"], abs=1e-8)
    # The target is straight behind, so both directions are equally short.
    angular = abs(command.angular_z) if case["angular"] > 3.14159 else command.angular_z
    assert angular == pytest.approx(case["angular"], abs=1e-8)


def test_turtles_at_one_place_ask_for_no_motion_whatever_their_headings():
    case = VECTORS["coincidence"]
    headings = [pose[2] for pose in case["poses"]]
    for (x, y, _), one, two in itertools.product(case["poses"], headings, headings):
        x, y = float32(x), float32(y)
        buffer = turtles((x, y, float32(one)), (x, y, float32(two)))
        seen = buffer.lookup_transform("turtle2", "turtle1").transform
        command, _ = motion.steer(motion.Law(), motion.AT_REST, *seen.translation[:2], 1.0)

        assert seen.translation[:2] == (0.0, 0.0)
        assert command == Twist2D(*case["expect_cmd"])


@pytest.mark.parametrize(
    "case", VECTORS["full_lookup"]["cases"], ids=lambda c: str(c["source_time"])
)
def test_looking_through_a_fixed_frame_joins_two_moments(case):
    buffer = Buffer()
    for second in range(1, 11):
        stamp = STAMP + seconds(second)
        for name, pose in (
            ("turtle1", (second, 0.0, 0.1 * second)),
            ("turtle2", (5.0, 5.0, math.pi / 2)),
        ):
            buffer.set_transform(
                TransformStamped(stamp, "world", name, transform_from_pose(*pose)), "test"
            )
    question = (
        case["target"],
        STAMP + seconds(case["target_time"]),
        case["source"],
        STAMP + seconds(case["source_time"]),
        case["fixed"],
    )

    if "error" in case:
        kind = {
            "extrapolation into the past": BackwardExtrapolationException,
            "extrapolation into the future": ForwardExtrapolationException,
        }[case["error"]]
        with pytest.raises(kind, match=case["error"]):
            buffer.lookup_transform_full(*question)
    else:
        found = buffer.lookup_transform_full(*question).transform
        assert found.translation == pytest.approx(case["xyz"], abs=1e-8)
        assert heading(found) == pytest.approx(case["yaw"], abs=1e-8)


@pytest.mark.parametrize("case", VECTORS["pid"], ids=lambda c: f"{c['kp']}-{c['ki']}-{c['kd']}")
def test_the_controller_answers_errors_as_the_reference_does(case):
    gains = motion.Gains(case["kp"], case["ki"], case["kd"])
    memory, found = motion.FRESH, []
    for error in case["errors"]:
        output, memory = motion.step(gains, memory, -error, case["dt"])
        found.append(output)

    assert found == pytest.approx(case["expect"], abs=1e-12)


def test_the_old_style_static_example_lies_on_its_back():
    case = VECTORS["static_A_B"]
    order = dict(zip(case["old_style_order"], case["argv"], strict=True))
    x, y, z, roll, pitch, yaw = (float(order[n]) for n in ("x", "y", "z", "roll", "pitch", "yaw"))
    rotation = quaternion_from_rpy(roll, pitch, yaw)

    assert (order["frame"], order["child"]) == ("A", "B")
    assert [x, y, z] == case["translation"]
    assert rotation == pytest.approx(case["quaternion_xyzw"], abs=1e-9)
    assert rpy_from_quaternion(rotation) == pytest.approx(case["rpy"], abs=1e-9)
    degrees = [math.degrees(angle) for angle in rpy_from_quaternion(rotation)]
    assert degrees == pytest.approx(case["rpy_degrees"], abs=1e-6)
    misread = quaternion_from_rpy(0.0, 0.0, roll)
    assert misread == pytest.approx(case["misread_as_yaw_quaternion"], abs=1e-9)


def test_the_robots_chain_adds_up_to_the_reference():
    case = VECTORS["robot_chain"]
    buffer = Buffer()
    for edge in case["edges"]:
        stamped = TransformStamped(
            STAMP,
            edge["parent"],
            edge["child"],
            Transform(edge["xyz"], quaternion_from_rpy(*edge["rpy"])),
        )
        if edge["kind"] == "static":
            buffer.set_transform_static(stamped, "test")
        else:
            buffer.set_transform(stamped, "test")

    for expected in case["expect"]:
        found = buffer.lookup_transform(expected["target"], expected["source"]).transform
        assert found.translation == pytest.approx(expected["xyz"], abs=1e-8)
        assert same_rotation(found.rotation, expected["quaternion_xyzw"])


@pytest.mark.parametrize("case", VECTORS["euler_to_quaternion"], ids=lambda case: str(case["rpy"]))
def test_roll_pitch_yaw_become_the_quaternions_of_the_reference(case):
    assert quaternion_from_rpy(*case["rpy"]) == pytest.approx(case["xyzw"], abs=1e-9)


@pytest.mark.parametrize("case", VECTORS["tree_statistics"], ids=lambda case: str(case["rate"]))
def test_links_are_counted_as_the_tree_viewers_count_them(case):
    buffer = Buffer()
    if case.get("static"):
        buffer.set_transform_static(
            TransformStamped(STAMP, "world", "turtle1", Transform()), "test"
        )
        base = 0
    else:
        base = STAMP
        span = seconds(case["latest"]) - seconds(case["oldest"])
        gaps = max(case["samples"] - 1, 1)
        for number in range(case["samples"]):
            stamp = base + seconds(case["oldest"]) + number * span // gaps
            buffer.set_transform(TransformStamped(stamp, "world", "turtle1", Transform()), "test")

    info = buffer.snapshot(now=STAMP + seconds(20)).frame("turtle1")
    assert info.rate == pytest.approx(case["rate"], abs=1e-3)
    assert round(info.buffer_length / 1e9, 3) == case["buffer_length"]
    assert info.oldest == base + seconds(case["oldest"])
    assert info.newest == base + seconds(case["latest"])
    if "samples" in case:
        assert info.samples == case["samples"]
