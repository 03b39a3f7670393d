"""Tests of the checks, each on a small robot that triggers it and on one that must not."""

import math
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import LASTS, MOUNT, NO_TURN, START, Robot, drives, robot, stands
from tftool.base.stamps import seconds
from tftool.doctor.findings import Confidence, Severity
from tftool.doctor.judge import CHECKS
from tftool.doctor.model import Settings
from tftool.doctor.shape_checks import loop


def test_a_healthy_robot_has_nothing():
    assert ids(robot(), notes=True) == []


def test_two_parents_by_turns_are_a_fight_and_one_change_is_a_switch():
    made = robot()
    made.moving("visual_odom", "base_link", hz=20)
    found_here = found(made, "two-parents")
    assert found_here.edges == (("odom", "base_link"), ("visual_odom", "base_link"))
    assert ids(made) == ["two-parents"]
    assert found(made, "split-tree").because_of == "two-parents"

    picked = robot()
    picked.moving("table", "cup", end=4.0)
    picked.moving("base_link", "cup", begin=4.0)
    picked.moving("odom", "table", pose=stands)
    assert found(picked, "parent-switch").severity is Severity.NOTE
    assert ids(picked) == []


def test_two_statics_with_different_parents_are_a_fight_too():
    made = robot()
    made.static("base_link", "camera")
    made.static("laser", "camera", at=0.5)
    alone = found(made, "two-parents")
    assert set(alone.edges) == {("base_link", "camera"), ("laser", "camera")}
    # Both parents are on the robot, so that a lookup finds a way through either.
    assert alone.severity is Severity.WARNING
    made.static("tripod", "camera", at=0.6)
    assert found(made, "two-parents").severity is Severity.ERROR


def away(t: float) -> tuple[float, ...]:
    return (0.5 * t + 1.0, 0.3, 0.0, *NO_TURN)


def test_two_known_publishers_of_different_opinion_are_named():
    made = robot(odometry=False)
    made.moving("odom", "base_link", node="/gazebo")
    made.moving("odom", "base_link", pose=away, hz=30, node="/ekf")
    conflict = found(made, "publisher-conflict")
    assert conflict.publishers == ("/gazebo", "/ekf")
    assert conflict.confidence.value == "certain"
    # The two positions are 1 m and 0.3 m apart along the axes.
    assert conflict.facts["apart"] == pytest.approx(math.hypot(1.0, 0.3), abs=0.02)


def test_two_unknown_publishers_are_seen_from_the_values():
    made = robot(odometry=False)
    made.moving("odom", "base_link")
    made.moving("odom", "base_link", pose=away, hz=30)
    conflict = found(made, "publisher-conflict")
    assert conflict.confidence.value == "likely"
    assert conflict.edges == (("odom", "base_link"),)
    assert "teleport" not in ids(made)


@pytest.mark.parametrize("jitter", [0.0, 0.004])
@pytest.mark.parametrize("speed", [3.0, 14.0, 40.0, -25.0])
def test_a_fast_wheel_has_one_publisher(speed, jitter):
    # Speeds are in radians per second: at 51 ms, up to a third of a turn between two samples.
    made = robot()
    noise = np.random.default_rng(3)
    for tick in range(150):
        at = tick * 0.051 + float(noise.uniform(-jitter, jitter))
        made.sent("base_link", "wheel", at, (0.0, 0.1, 0.0, *turned(speed * at, 1)))
    assert ids(made) == []


@pytest.mark.parametrize("speed", [0.0, 2.0, 14.0])
def test_two_publishers_of_a_wheel_at_equal_rates_half_a_period_apart(speed):
    made = robot()
    for tick in range(150):
        for begin, angle in ((0.0, 0.0), (0.025, 1.5)):
            at = tick * 0.05 + begin
            made.sent("base_link", "wheel", at, (0.0, 0.1, 0.0, *turned(speed * at + angle, 1)))
    conflict = found(made, "publisher-conflict")
    assert conflict.edges == (("base_link", "wheel"),)
    # The poses are 1.5 rad apart, plus the turn during half a period.
    assert conflict.facts["turned"] == pytest.approx(1.5, abs=0.026 * speed + 1e-6)
    assert "85.9°" in conflict.evidence[0] or speed


def test_a_wheel_that_is_zero_every_other_time_has_joint_states_of_two_sources():
    made = robot()
    for tick in range(100):
        at = tick * 0.05
        made.sent("base_link", "wheel", at, (0.0, 0.1, 0.0, *turned(2.0 * at, 1)))
        made.sent("base_link", "wheel", at + 0.02 * (tick % 5 > 0), (0.0, 0.1, 0.0, *NO_TURN))
    assert ids(made) == ["publisher-conflict"]
    conflict = found(made, "publisher-conflict")
    assert conflict.severity is Severity.WARNING
    assert "one value 101 times, others 99 times, alternating" in conflict.evidence[0]
    assert conflict.fixes[0].text.startswith("find who publishes joint states")


def test_a_mount_with_two_values_that_hardly_differ_is_no_error():
    for apart, severity in ((0.01, Severity.WARNING), (0.3, Severity.ERROR)):
        made = robot(laser=False)
        made.moving("base_link", "laser", pose=stands, node="/stageros")
        lower = (*MOUNT[:2], MOUNT[2] - apart, *NO_TURN)
        made.moving("base_link", "laser", pose=lambda _, lower=lower: lower, node="/rsp")
        assert found(made, "publisher-conflict").severity is severity


def test_two_values_at_one_stamp_are_two_publishers_however_near():
    made = robot(odometry=False)
    for tick in range(80):
        made.sent("odom", "base_link", tick * 0.1, drives(tick * 0.1))
        if tick % 8 == 0:
            x = 0.05 * tick + 0.04
            made.sent("odom", "base_link", tick * 0.1, (x, 0.0, 0.0, *NO_TURN))
    conflict = found(made, "publisher-conflict")
    assert conflict.facts["apart"] == pytest.approx(0.04)
    assert conflict.confidence is Confidence.LIKELY
    assert conflict.message.endswith("two different values, which alternate")
    assert conflict.evidence[0].startswith("base_link in odom: A and B, 10 stamps carry two values")
    # Without names of publishers, the values are no proof.
    assert conflict.severity is Severity.WARNING

    few = robot()
    for at in (2.0, 5.0):
        few.sent("odom", "base_link", at, (0.5 * at + 0.04, 0.0, 0.0, *NO_TURN))
    conflict = found(few, "publisher-conflict")
    assert (conflict.severity, conflict.confidence) == (Severity.NOTE, Confidence.POSSIBLE)
    assert [fix.text.split(":")[0] for fix in conflict.fixes] == ["find its publishers"]
    assert "ros2 topic info --verbose /tf" in conflict.fixes[0].text


def test_publishers_of_odometry_are_looked_for_on_its_topic():
    made = robot()
    made.odometry = Robot()
    made.odometry.moving("odom", "base_link", topic="/odom")
    for at in (2.0, 5.0):
        shifted = (0.5 * at + 0.04, 0.0, 0.0, *NO_TURN)
        made.odometry.sent("odom", "base_link", at, shifted, topic="/odom")

    conflict = found(made, "publisher-conflict")

    assert "ros2 topic info --verbose /odom" in conflict.fixes[0].text


def test_one_node_with_two_values_on_tf_and_in_its_odometry_is_one_finding():
    made = robot()
    made.odometry = Robot()
    made.odometry.moving("odom", "base_link", topic="/odom")
    for at in (2.0, 5.0):
        shifted = (0.5 * at + 0.04, 0.0, 0.0, *NO_TURN)
        made.sent("odom", "base_link", at, shifted)
        made.odometry.sent("odom", "base_link", at, shifted, topic="/odom")

    assert ids(made, notes=True) == ["publisher-conflict"]
    conflict = found(made, "publisher-conflict")
    assert conflict.topics == ("/odom",)
    assert "2 stamps carry two values (and on /odom)" in conflict.evidence[0]
    assert re.search(r"two different values at 2 of \d+ stamps", conflict.message)
    assert conflict.consequence.startswith("the frame jumps at these stamps")


@pytest.mark.parametrize("speed", [15.0, 40.0])
def test_a_fast_robot_with_one_publisher_has_no_findings(speed):
    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=lambda t: (speed * t, 0.0, 0.0, *NO_TURN))
    assert ids(made) == []


def test_two_publishers_of_equal_values_only_repeat_stamps():
    made = robot()
    made.moving("odom", "base_link")
    assert ids(made, notes=True) == ["sent-twice"]
    assert ids(made) == []  # ROS 2 ignores equal samples
    made.kind = "ROS 1 bag"
    assert ids(made) == ["repeated-stamp"]


def test_repeated_stamps_of_a_rewritten_bag_name_the_size_of_the_step_but_no_node():
    made = robot(odometry=False)
    made.kind = "ROS 1 bag"
    for tick in range(160):
        for shift in (0.0, 0.08 if tick % 2 else 0.0):
            pose = (0.05 * tick + shift, 0.0, 0.0, *NO_TURN)
            made.sent("map", "odom", 0.05 * tick, pose, node="/camera_mount")
    assert "of 320 samples repeat a stamp" in (told := found(made, "repeated-stamp").evidence[0])
    assert "at most 80 mm" in told
    assert "sent by /camera_mount" in told
    made.moving("base_link", "camera", 10.0, stands, offset=0.1, node="/camera_mount")
    assert "sent by" not in found(made, "repeated-stamp").evidence[0]


@pytest.mark.parametrize("kind", ["ROS 1 bag", "rosbag2"])
def test_a_node_that_repeats_its_newest_pose_under_an_old_stamp_is_no_conflict(kind):
    made = robot(odometry=False)
    made.kind = kind
    for tick in range(160):
        # Each pose is sent twice, the second time with the stamp of the next pose.
        for stamp in (tick, tick + 1):
            pose = (0.05 * tick, 0.0, 0.0, *NO_TURN)
            made.sent("odom", "base_link", 0.05 * stamp, pose, node="/camera")
    assert ids(made) == ["repeated-stamp"]


def test_a_frame_that_is_static_and_moves():
    made = robot()
    made.static("map", "base_link", at=3.0)
    assert found(made, "static-and-dynamic").frames == ("base_link",)
    assert found(made, "static-and-dynamic").severity is Severity.ERROR


def test_wheels_that_are_static_and_moving_are_one_warning():
    made = robot()
    for name in ("left_wheel", "right_wheel"):
        made.moving("base_link", name, 10.0, stands)
        for second in range(8):
            made.static("base_link", name, at=second + 0.05)
    assert ids(made) == ["static-and-dynamic"]
    finding = found(made, "static-and-dynamic")
    assert finding.message == "left_wheel, right_wheel are sent on /tf and on /tf_static"
    assert finding.severity is Severity.WARNING
    # Between two statics, ten samples with stamps 0.1 s apart arrive.
    assert all("at most 900 ms of history" in line for line in finding.evidence)
    made.hears("/camera", "left_wheel", kind="sensor_msgs/Image")
    assert found(made, "static-and-dynamic").severity is Severity.ERROR
    assert found(made, "static-and-dynamic").frames == ("left_wheel",)


def test_a_static_that_changes_and_one_that_moves():
    changed = robot()
    changed.static("base_link", "laser", (0.3, 0.0, 0.2, *NO_TURN), at=4.0)
    finding = found(changed, "static-changed")
    assert finding.facts["moved"] == pytest.approx(0.2)
    assert "again" not in finding.evidence[0]
    changed.static("base_link", "laser", at=6.0)
    assert "at the end the first again" in found(changed, "static-changed").evidence[0]

    moves = robot()
    for tick in range(6):
        moves.static("base_link", "arm", (0.1 * tick, 0.0, 0.0, *NO_TURN), at=float(tick))
    assert found(moves, "dynamic-on-static").edges == (("base_link", "arm"),)


def test_a_static_that_is_repeated_is_fine():
    made = robot()
    for tick in range(1, 8):
        made.static("base_link", "laser", at=float(tick))
    assert ids(made, notes=True) == []


def long_drive(child: str = "gps_link", parent: str = "base_link") -> Robot:
    """Return a drive of a minute with a frame that never moves but is sent on /tf."""
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=10, end=61.0)
    made.moving(parent, child, hz=10, pose=stands, end=61.0)
    return made


def test_a_constant_on_tf_for_a_minute_is_possibly_a_mount():
    finding = found(long_drive(), "static-on-tf")
    assert finding.edges == (("base_link", "gps_link"),)
    assert finding.confidence is Confidence.POSSIBLE

    rests = robot(odometry=False)
    rests.moving("odom", "base_link", pose=stands, end=61.0)
    assert ids(rests, notes=True) == []


def test_a_short_recording_does_not_tell_a_mount_from_what_rests():
    made = robot()
    made.moving("base_link", "camera", hz=10, pose=stands)
    assert ids(made, notes=True) == []


@pytest.mark.parametrize("case", ["sparse", "dense", "ahead", "other sensor"])
def test_a_mount_that_comes_rarely_while_its_sensor_needs_it_is_shown(case):
    made = robot()
    ahead = 2.0 if case == "ahead" else 0.0
    for at in range(0, 80, 5 if case == "dense" else 15):
        made.sent("base_link", "imu_link", at / 10 + ahead, latency=0.002 - ahead, node="/radio")
    made.hears("/imu", "laser" if case == "other sensor" else "imu_link", 25.0, "sensor_msgs/Imu")
    if case != "sparse":
        assert "static-on-tf" not in ids(made)
        return
    finding = found(made, "static-on-tf")
    assert finding.severity is Severity.WARNING
    assert "of 200 sensor messages in its 5 gaps above 1 s, of up to 1.50 s" in finding.evidence[0]
    assert finding.fixes[0].text == "if it is a mount, send it on /tf_static"


def test_a_resting_frame_that_could_move_is_not_reported_as_static_on_tf():
    # Another wheel moves.
    wheels = long_drive("wheel_left")
    wheels.moving("base_link", "wheel_right", hz=10, pose=drives, end=61.0)
    # The odometry contains the frame.
    named = long_drive()
    told = Robot()
    told.moving("base_link", "gps_link", topic="/odom", hz=10, end=1.0)
    named.odometry = told
    # The stamps are those of joint states.
    states = long_drive()
    states.hears("/joint_states", "", 10.0, "sensor_msgs/JointState", end=61.0)
    # The frame is in one message with moving frames.
    together = long_drive()
    (key, mount), (_, base) = list(together.records.items())[::-1][:2]
    together.records[key] = [
        (stamp, pose, message)
        for (stamp, pose, _), (_, _, message) in zip(mount, base, strict=True)
    ]
    # The frame is above all moving frames.
    lowest = long_drive("dock", parent="hall")
    # A robot description has fixed joints, and one of them is mounted on the frame.
    arm = long_drive("arm")
    arm.static("base_link", "imu")
    arm.static("arm", "gripper")
    place = arm.records["base_link", "imu", True][0][2]
    arm.records["arm", "gripper", True] = [(seconds(START), stands(0.0), place)]
    # The samples end long before the end of the recording.
    brief = robot(odometry=False, scans=False)
    brief.moving("odom", "base_link", hz=10, end=61.0)
    brief.moving("base_link", "gps_link", hz=10, pose=stands, end=50.0)
    for made in (wheels, named, states, together, lowest, arm, brief):
        assert "static-on-tf" not in ids(made, notes=True)


def test_a_circle_is_named_and_is_no_split_tree():
    made = Robot()
    made.moving("odom", "body")
    made.moving("body", "odom")
    assert ids(made) == ["loop"]
    assert set(found(made, "loop").frames) == {"odom", "body"}


def test_a_large_circle_is_named_once_and_what_hangs_from_it_is_not():
    names = [f"joint{n}" for n in range(70)]
    made = Robot()
    for parent, child in zip(names, names[1:] + names[:1], strict=True):
        made.moving(parent, child)
    made.moving("joint3", "tool")
    finding = found(made, "loop")
    assert set(finding.frames) == set(names)
    assert len(finding.edges) == len(names)


def test_looking_for_circles_takes_as_long_as_there_are_links():
    looked = []

    class Link:
        by_stamp = (1,)

        def __init__(self, number):
            self.child = f"link{number + 1}"
            self.number = number

        @property
        def parent(self):
            looked.append(self)
            return f"link{self.number}"

    chain = SimpleNamespace(tracks=[Link(number) for number in range(300)])

    assert list(loop(chain, {})) == []
    assert len(looked) < 3000


def test_edges_that_never_exist_together_form_no_circle():
    made = Robot()
    made.moving("a", "b", end=3.0)
    made.moving("b", "a", begin=5.0)
    assert "loop" not in ids(made)


def test_a_split_tree_is_worse_where_messages_are_in_it():
    made = robot()
    made.static("camera_link", "camera_optical")
    finding = found(made, "split-tree")
    assert finding.severity is Severity.NOTE
    # No data shows where the camera is mounted.
    assert finding.facts["join"] is None
    assert "nothing in the data says where to join camera_link" in finding.fixes[0].text
    assert "if it is mounted on the robot, measure where" in finding.fixes[0].text
    assert finding.fixes[0].command.endswith("--frame-id base_link --child-frame-id camera_link")

    bare = robot(laser=False, scans=False)
    bare.moving("turret", "gun")
    assert (
        "check whether the robot sends static transforms" in found(bare, "split-tree").fixes[0].text
    )
    assert "the statics are missing" not in finding.fixes[0].text

    made.hears("/image", "camera_optical", kind="sensor_msgs/Image")
    finding = found(made, "split-tree")
    assert (finding.severity, finding.topics) == (Severity.WARNING, ("/image",))
    made.hears("/points", "camera_optical", kind="sensor_msgs/PointCloud2")
    assert found(made, "split-tree").severity is Severity.ERROR


def test_a_constant_tree_without_messages_is_a_note():
    for child, pose, topic, frame, severity in (
        ("pad_imu", stands, "/scan", "laser", Severity.NOTE),
        ("pad_imu", drives, "/scan", "laser", Severity.WARNING),
        ("base_footprint", stands, "/scan", "laser", Severity.WARNING),
        ("pad_imu", stands, "/pad", "/pad_imu", Severity.WARNING),
    ):
        made = robot(scans=False)
        made.moving("pad", child, 1.0, pose)
        made.hears(topic, frame, kind="sensor_msgs/Image")
        (finding,) = [one for one in made.judged().findings if one.id == "split-tree"]
        assert finding.severity is severity
    # Without any recorded message, an empty tree says nothing.
    made = robot(scans=False)
    made.static("pad", "pad_imu")
    assert found(made, "split-tree").severity is Severity.WARNING


def test_trees_that_nothing_joins_are_one_finding():
    made = robot()
    made.moving("arm_left", "wheel_left")
    made.moving("arm_right", "wheel_right")
    assert ids(made) == ["split-tree"]
    finding = found(made, "split-tree")
    assert finding.message == "arm_left, arm_right are not joined to the tree of odom"
    assert len(finding.evidence) == 2
    assert finding.fixes[0].text == "nothing in the data says where to join arm_left, arm_right"


def test_wheels_of_one_message_with_two_publishers_are_one_finding():
    made = robot()
    for tick in range(150):
        for begin, angle in ((0.0, 0.0), (0.025, 1.5)):
            at = tick * 0.05 + begin
            for name, factor in (("left", 1.0), ("right", 0.9)):
                wheel = (0.0, 0.1, 0.0, *turned(2.0 * at + factor * angle, 1))
                made.sent("base_link", name, at, wheel)
                row = made.records["base_link", name, False][-1]
                number = made.records["base_link", "left", False][-1][2]
                made.records["base_link", name, False][-1] = (row[0], row[1], number)
    made.moving("base_link", "head")
    made.moving("base_link", "head", pose=stands)
    conflicts = [one for one in made.judged().findings if one.id == "publisher-conflict"]
    assert [one.edges for one in conflicts] == [
        (("base_link", "head"),),
        (("base_link", "left"), ("base_link", "right")),
    ]
    # The publishers are unknown, so nothing proves two sources.
    assert conflicts[1].message == (
        "left in base_link, right in base_link have two different values, which alternate"
    )
    # Two wheels that only turn may as well be fast.
    assert [one.severity for one in conflicts] == [Severity.WARNING, Severity.NOTE]


def test_odometry_messages_say_which_transform_is_missing():
    made = robot(odometry=False)
    made.moving("map", "odom")
    made.hears("/wheels/odom", "odom", kind="nav_msgs/Odometry")
    made.odometry = Robot()
    made.odometry.moving("odom", "base_link", topic="/wheels/odom")
    finding = found(made, "split-tree")
    assert finding.facts["join"] == {"parent": "odom", "child": "base_link", "guess": False}
    assert "static_transform_publisher" not in finding.fixes[0].command
    assert "400 Odometry messages (/wheels/odom)" in finding.fixes[0].text

    unknown = robot(odometry=False)
    unknown.moving("base_link", "wheel")
    unknown.hears("/wheels/odom", "odom", kind="nav_msgs/Odometry")
    unknown.odometry = made.odometry
    (fix,) = found(unknown, "unknown-frame").fixes
    assert fix.command == "tftool echo odom base_link RECORDING --with-odometry"


def test_odometry_of_a_frame_with_a_parent_gives_it_no_second_parent():
    made = robot()
    made.hears("/ground_truth", "world", kind="nav_msgs/Odometry")
    made.odometry = Robot()
    made.odometry.moving("world", "base_link", topic="/ground_truth")
    (fix,) = found(made, "unknown-frame").fixes
    assert "base_link has the parent odom, so publish odom in world" in fix.text
    assert fix.command == "tftool echo world base_link RECORDING --with-odometry"


@pytest.mark.parametrize(
    ("main", "root", "edge"),
    [
        (("odom", "base_footprint"), "base_link", ("base_footprint", "base_link")),
        (("map", "base_link"), "odom", ("map", "odom")),
        (("base_link", "base_laser"), "laser", ("base_laser", "laser")),
        (("robot_0/odom", "robot_0/base_link"), "robot_1/odom", None),
        (("base_link", "turret"), "camera", None),
    ],
)
def test_a_join_is_proposed_only_on_evidence(main, root, edge):
    made = Robot()
    made.moving(*main)
    for child in ("extra1", "extra2", "extra3"):
        made.moving(main[1], child)
    made.moving(root, "robot_1/base_link" if root.startswith("robot_1") else "leaf")
    join = found(made, "split-tree").facts["join"]
    assert (None if join is None else (join["parent"], join["child"])) == edge


def test_two_whole_robots_are_two_trees_by_intention():
    made = Robot()
    for name in ("r1", "r2"):
        made.moving(f"{name}/odom", f"{name}/base_link")
        made.static(f"{name}/base_link", f"{name}/laser")
        made.hears(f"/{name}/scan", f"{name}/laser")
    assert ids(made) == []


def test_a_frame_in_two_conventions_that_nothing_uses_is_a_note():
    made = robot()
    made.static("map", "map_ned")
    assert found(made, "split-tree").severity is Severity.NOTE
    made.hears("/marker", "map_ned", kind="geometry_msgs/PoseStamped")
    assert found(made, "split-tree").severity is Severity.WARNING


def test_names_that_are_empty_or_equal():
    made = robot()
    made.sent("odom", "odom", 1.0)
    made.sent("", "camera", 1.0)
    made.hears("/points", "", kind="sensor_msgs/PointCloud2")
    made.hears("/joint_states", "", kind="sensor_msgs/JointState")
    assert found(made, "self-transform").frames == ("odom",)
    severities = [one.severity for one in made.judged().findings if one.id == "empty-frame"]
    assert severities == [Severity.ERROR, Severity.WARNING]
    topics = [one.topics for one in made.judged().findings if one.id == "empty-frame"]
    assert ("/points",) in topics
    assert found(made, "empty-frame").message == "no frame name in a transform on /tf"


def test_a_base_below_map_beside_odom_is_out_of_line():
    made = Robot()
    made.moving("map", "base_link")
    made.moving("map", "odom", pose=stands)
    assert found(made, "rep105-shape").edges == (("map", "base_link"),)
    # odom has no children, so only its name has a purpose.
    assert (
        "odom in map never moves, and odom has no children"
        in (found(made, "rep105-shape").evidence[0])
    )
    # Some stacks publish such a tree on purpose.
    assert found(made, "rep105-shape").severity is Severity.NOTE

    above = Robot()
    above.moving("odom", "map")
    above.moving("odom", "base_link", pose=stands)
    assert found(above, "rep105-shape").edges == (("odom", "map"),)

    below = Robot()
    below.moving("body", "odom")
    below.static("body", "laser")
    assert "rep105-shape" not in ids(below)


@pytest.mark.parametrize(
    ("rotation", "severity"),
    [((0.0, 0.0, 0.0, 0.0), Severity.ERROR), ((0.0, 0.0, 0.0, 1.1), Severity.WARNING)],
)
def test_rotations_that_are_none(rotation, severity):
    made = robot()
    made.static("base_link", "camera", (0.0, 0.0, 0.0, *rotation))
    assert found(made, "bad-quaternion").severity is severity


def test_a_jump_of_odometry_and_none_of_a_localiser():
    def jumps(t: float) -> tuple[float, ...]:
        return (0.5 * t + (2.5 if t > 5.0 else 0.0), 0.0, 0.0, *NO_TURN)

    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=jumps)
    finding = found(made, "teleport")
    assert finding.facts["jump"] == pytest.approx(2.5 + 0.5 / 50)
    assert finding.count == 1

    spins = robot(odometry=False)
    spins.moving(
        "odom", "base_link", pose=lambda t: (0.5 * t, 0.0, 0.0, *turned(2.0 if t > 5 else 0.0))
    )
    finding = found(spins, "teleport")
    assert finding.facts["turn"] == pytest.approx(2.0)
    assert "jumps 115° within 20 ms" in finding.message

    localised = robot()
    localised.moving("map", "odom", hz=20, pose=jumps)
    assert "teleport" not in ids(localised)


def test_an_optical_frame_with_the_axes_of_the_body():
    made = robot()
    made.static("base_link", "camera_link")
    made.static("camera_link", "camera_optical_frame", (0.0, 0.0, 0.0, *NO_TURN))
    # The rotation from body axes to optical axes is a third of a turn about a diagonal.
    assert found(made, "optical-convention").facts["off"] == pytest.approx(120.0)

    right = robot()
    right.static("base_link", "camera_link")
    right.static("camera_link", "camera_optical_frame", (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5))
    assert ids(right) == []


def test_pictures_in_a_body_frame_are_a_note():
    made = robot()
    made.hears("/image", "laser", kind="sensor_msgs/Image")
    assert found(made, "image-not-optical").severity is Severity.NOTE


def test_a_picture_in_optical_axes_is_fine_whatever_its_name():
    made = robot()
    made.static("base_link", "camera_frame", (0.1, 0.0, 0.2, -0.5, 0.5, -0.5, 0.5))
    made.hears("/image", "camera_frame", kind="sensor_msgs/Image")
    assert "image-not-optical" not in ids(made, notes=True)

    body = robot()
    body.static("base_link", "camera_frame")
    body.hears("/image", "camera_frame", kind="sensor_msgs/Image")
    assert found(body, "image-not-optical").confidence is Confidence.CERTAIN

    # The axes of a camera whose z axis points sideways are not checked.
    sideways = robot()
    sideways.static("base_link", "camera_frame", (0.1, 0.0, 0.2, *turned(math.pi / 2, axis=0)))
    sideways.hears("/image", "camera_frame", kind="sensor_msgs/Image")
    finding = found(sideways, "image-not-optical")
    assert finding.confidence is Confidence.POSSIBLE
    assert finding.fixes[0].text.startswith("check whether")


def test_odometry_to_a_link_below_the_root_of_the_mounts_is_one_finding():
    made = robot(scans=False)
    made.static("base_footprint", "base_link", at=-1.0)
    assert ids(made) == ["static-and-dynamic"]
    so = found(made, "static-and-dynamic").consequence
    assert "has only the parent odom: lookups through base_footprint fail" in so
    fix = found(made, "static-and-dynamic").fixes[0]
    assert fix.text.startswith("publish base_footprint, the root of the mounts, in odom")


def test_mounts_that_look_mistyped_are_notes():
    made = robot()
    made.static("base_link", "camera", (1200.0, 0.0, 0.0, *NO_TURN))
    made.static("base_link", "sonar", (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0))
    assert found(made, "suspect-units").edges == (("base_link", "camera"),)
    assert found(made, "suspect-order").edges == (("base_link", "sonar"),)
    assert ids(made) == []


def test_stamps_and_numbers_of_any_size_are_judged():
    made = robot()
    for stamp in (0, -1, 2**63 - 1, -(2**63), seconds(START)):
        for number in (0.0, 1e308, -1e308, math.inf):
            made.sent("base_link", "arm", 1.0, (number, number, 0.0, *NO_TURN), stamp=stamp)
            made.sent("odom", "base_link", 1.0, (number, 0.0, 0.0, *NO_TURN), stamp=stamp)
    assert {"nan-transform", "zero-stamp"} <= set(ids(made))


def test_data_that_first_came_after_time_went_back_is_left_out():
    made = robot()
    made.log_from = START + LASTS
    made.moving("odom", "base_link")
    made.hears("/scan", "laser")
    made.moving("base_link", "arm", pose=stands)
    made.hears("/late", "nowhere")
    assert ids(made) == ["time-jump-back"]


def test_a_threshold_can_be_changed_and_is_then_told():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", without=(3.0, 4.0))
    assert "gap" in ids(made, notes=True)
    wide = Settings(limits={"gap": {"seconds": 2.0}})
    assert "gap" not in [one.id for one in made.judged(wide).findings]
    narrow = Settings(limits={"gap": {"seconds": 0.7}})
    assert found(made, "gap", narrow).evidence[-1] == "with seconds = 0.7"


def test_a_threshold_may_be_nothing_where_there_is_nothing_to_judge():
    made = robot()
    for at in (1.0, 2.0):
        made.sent("base_link", "arm", at, stamp=0)
    for check in CHECKS.values():
        none = Settings(limits={check.id: dict.fromkeys(check.limits, 0.0)})
        assert "zero-stamp" in [one.id for one in made.judged(none).findings]


def test_every_check_of_the_catalogue_is_tripped_here():
    here = Path(__file__).parent
    source = "".join(one.read_text(encoding="utf-8") for one in here.glob("test_*checks.py"))
    assert [name for name in CHECKS if f'"{name}"' not in source] == []
