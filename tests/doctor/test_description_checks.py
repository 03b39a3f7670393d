"""Tests of the checks that need a description or odometry, each on a small robot."""

import math

import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, START, Robot, drives, robot, stands
from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity


def urdf(*joints: str) -> str:
    """Return a URDF with joints written as "wheel: continuous base_link wheel_link"."""
    links: dict[str, None] = {}
    text = ""
    for joint in joints:
        name, _, rest = joint.partition(": ")
        kind, parent, child, *more = rest.split()
        links |= dict.fromkeys((parent, child))
        limit = '<limit effort="1" velocity="1" lower="-1" upper="1"/>' * (kind == "revolute")
        text += (
            f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            f"{limit}{' '.join(more)}</joint>"
        )
    return f'<robot name="r">{"".join(f"<link name={n!r}/>" for n in links)}{text}</robot>'


LASER_JOINT = "laser_joint: fixed base_link laser <origin xyz='0.1 0 0.2'/>"


def test_a_robot_that_is_as_its_description_says_has_nothing():
    made = robot()
    made.urdf = urdf(LASER_JOINT)
    made.joints = frozenset()
    assert ids(made, notes=True) == []
    assert not [one for one in made.judged().skipped if one.id.startswith(("urdf", "joint"))]


def test_a_joint_without_state_explains_the_links_below_it():
    made = robot()
    made.urdf = urdf(
        LASER_JOINT,
        "caster: continuous base_link caster_link",
        "roller: fixed caster_link roller_link",
        "twin: continuous base_link twin_link <mimic joint='caster'/>",
    )
    made.joints = frozenset({"wheel"})
    finding = found(made, "joint-without-state")
    assert finding.message == "caster has no state, so caster_link has no frame"
    assert finding.frames == ("caster_link", "roller_link", "twin_link")
    assert ids(made) == ["joint-without-state"]
    assert found(made, "urdf-frame-unpublished").because_of == "joint-without-state"

    made.joints = frozenset({"caster"})
    assert "joint-without-state" not in ids(made)
    # No program converted the joint states to transforms: robot_state_publisher did not run.
    assert found(made, "urdf-frame-unpublished").because_of is None


def test_the_topic_of_joint_states_is_named_as_it_was_recorded():
    made = robot()
    made.urdf = urdf(LASER_JOINT, "caster: continuous base_link caster_link")
    made.joints = frozenset()
    made.hears("/car/joint_states", "", hz=0.0, kind="sensor_msgs/JointState")
    finding = found(made, "joint-without-state")
    assert finding.evidence[0].endswith("; /car/joint_states has no message")
    assert finding.fixes[0].text.endswith("/car/joint_states`")

    made.hears("/car/joint_states", "", kind="sensor_msgs/JointState")
    assert "no message" not in found(made, "joint-without-state").evidence[0]


def test_a_joint_whose_frame_another_node_publishes_needs_no_state():
    made = robot()
    made.urdf = urdf(LASER_JOINT, "caster: continuous base_link caster_link")
    made.joints = frozenset()
    made.moving("base_link", "caster_link")
    assert ids(made) == []


def test_links_that_tf_lacks_are_told_with_the_reason_of_their_joint():
    made = robot()
    made.urdf = urdf(LASER_JOINT, "cam: fixed base_link camera", "arm: revolute base_link arm_link")
    finding = found(made, "urdf-frame-unpublished")
    assert finding.frames == ("camera", "arm_link")
    assert finding.evidence == (
        "camera: fixed to base_link: no static transform names it",
        "arm_link: moved by arm (revolute): no joint state has its position",
    )
    # A frame of the description is not an unknown frame, even if messages use it.
    made.hears("/image", "camera", kind="sensor_msgs/CompressedImage")
    assert ids(made) == ["urdf-frame-unpublished"]


def test_a_prefix_of_all_frames_is_not_a_difference():
    made = Robot()
    made.moving("r1/odom", "r1/base_link")
    made.static("r1/base_link", "r1/laser")
    made.urdf = urdf(LASER_JOINT)
    assert ids(made) == []


@pytest.mark.parametrize(
    ("pose", "differs"),
    [
        ((0.1, 0.0, 0.2009, *NO_TURN), False),
        ((0.1, 0.0, 0.202, *NO_TURN), True),
        ((0.1, 0.0, 0.2, *turned(math.radians(0.09))), False),
        ((0.1, 0.0, 0.2, *turned(math.radians(0.2))), True),
    ],
)
def test_a_mount_that_differs_from_its_fixed_joint(pose, differs):
    made = robot(laser=False)
    made.static("base_link", "laser", pose)
    made.urdf = urdf(LASER_JOINT)
    assert ("urdf-tf-mismatch" in ids(made)) is differs


def test_the_static_that_arrives_last_counts_whatever_its_stamp():
    made = robot(laser=False)
    made.static("base_link", "laser", (0.1, 0.0, 0.2, *NO_TURN), at=4.0)
    late = (0.4, 0.0, 0.2, *NO_TURN)
    # A static publisher that was started before the recorder is heard later.
    made.sent("base_link", "laser", 5.0, late, topic="/tf_static", stamp=seconds(START - 19.0))
    made.urdf = urdf(LASER_JOINT)
    assert found(made, "urdf-tf-mismatch").facts["apart"] == pytest.approx(0.3)


def test_a_description_with_mistakes_is_told_and_the_rest_is_skipped():
    made = robot()
    made.urdf = urdf("a: fixed one two", "b: fixed three four")
    assert ids(made) == ["urdf-invalid"]
    assert found(made, "urdf-invalid").severity is Severity.WARNING  # the robot has its frames
    reasons = {one.id: one.reason for one in made.judged().skipped}
    assert reasons["urdf-tf-mismatch"] == "the robot description has mistakes"


def test_the_description_knows_the_join_that_is_missing():
    made = robot()
    made.static("camera_link", "lens")
    made.urdf = urdf(
        LASER_JOINT,
        "mast: fixed laser camera_link <origin xyz='1 2 3'/>",
        "glass: fixed camera_link lens <origin xyz='0.1 0 0.2'/>",
    )
    finding = found(made, "split-tree")
    assert finding.facts["join"] == {"parent": "laser", "child": "camera_link", "guess": False}
    assert "--x 1 --y 2 --z 3 " in finding.fixes[0].command


def test_a_movable_joint_at_rest_is_no_constant():
    made = robot()
    made.moving("base_link", "door", hz=10, pose=stands)
    made.urdf = urdf(LASER_JOINT, "hinge: revolute base_link door")
    made.joints = frozenset({"hinge"})
    assert ids(made, notes=True) == []


def says(pose, latency=0.004, child="base_link"):
    """Return odometry messages with the given poses."""
    told = Robot()
    told.moving("odom", child, pose=pose, topic="/odom", latency=latency)
    return told


def test_odometry_and_transform_of_one_name_that_disagree():
    made = robot()
    made.odometry = says(drives)
    assert ids(made, notes=True) == []
    made.odometry = says(lambda t: (0.5 * t + 0.04, 0.0, 0.0, *NO_TURN))
    assert ids(made) == []
    made.odometry = says(lambda t: (0.5 * t + 0.06, 0.0, 0.0, *NO_TURN))
    finding = found(made, "odometry-tf-mismatch")
    assert (finding.severity, finding.topics, finding.edges, finding.count) == (
        Severity.NOTE, ("/odom",), (("odom", "base_link"),), 400,
    )  # fmt: skip
    made.odometry = says(lambda t: (0.5 * t, 0.0, 0.0, *turned(math.radians(3.0))))
    assert found(made, "odometry-tf-mismatch").facts["turned"] == pytest.approx(math.radians(3))
    # Some poses may differ; a finding needs more than half of them.
    made.odometry = says(lambda t: (0.5 * t + (1.0 if t > 4.5 else 0.0), 0.0, 0.0, *NO_TURN))
    assert ids(made) == []


def test_odometry_with_two_values_for_one_stamp_has_two_sources():
    made = robot()
    made.odometry = says(drives)
    for tick in range(11):
        x = 0.25 * tick + 0.04
        made.odometry.sent("odom", "base_link", 0.5 * tick, (x, 0, 0, *NO_TURN), topic="/odom")
    finding = found(made, "publisher-conflict")
    assert (finding.count, finding.topics) == (11, ("/odom",))
    assert finding.facts["apart"] == pytest.approx(0.04)


def test_odometry_of_a_pair_that_tf_does_not_join_is_a_note():
    made = robot()
    made.static("laser", "lens")
    made.odometry = says(drives, child="laser")
    finding = found(made, "odometry-tf-mismatch")
    assert (finding.severity, finding.edges) == (Severity.NOTE, (("odom", "laser"),))
    assert finding.evidence == ("/odom says laser in odom; in tf, laser has the parent base_link",)
    assert "disagree" not in finding.message

    # The message's child is another frame of the base, a parent or child of the frame in tf.
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_footprint")
    made.static("base_footprint", "base_link")
    made.odometry = says(drives, child="base_link")
    assert "odometry-tf-mismatch" not in ids(made, notes=True)

    # Frames that are not connected at all are one finding.
    made = robot(odometry=False)
    made.static("map", "odom")
    made.odometry = says(drives)
    assert ids(made, notes=True) == ["split-tree"]
