"""Tests of the checks of names, each on a small robot."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.doctor.judged import found, ids
from tests.doctor.robots import Robot, robot
from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.doctor.name_checks import distance
from tftool.recordings.contract import Publisher


def test_a_frame_that_no_transform_names_is_told_with_what_fits():
    made = robot(scans=False)
    made.hears("/scan", "laser_frame")
    finding = found(made, "unknown-frame")
    assert (finding.frames, finding.topics) == (("laser_frame",), ("/scan",))
    assert finding.fixes[0].text == "if laser is the frame of this sensor, /scan should name it"


def test_a_slash_in_a_header_has_its_own_check():
    made = robot(scans=False)
    made.hears("/scan", "/laser")
    assert ids(made) == ["slash-twins"]
    assert found(made, "slash-twins").topics == ("/scan",)
    # A message filter removes the slash, so that its lookup succeeds.
    assert "direct tf2 lookup" in found(made, "slash-twins").consequence
    assert found(made, "slash-twins").severity is Severity.ERROR
    made.hears("/goal", "/laser", kind="geometry_msgs/PoseStamped")
    (of_pose,) = [one for one in made.judged().findings if one.topics == ("/goal",)]
    assert of_pose.severity is Severity.WARNING

    # A transform of the frame has the slash too.
    made.slashed["base_link", "laser", True] = 1
    assert found(made, "slash-twins").severity is Severity.NOTE
    assert "names /laser, as transforms do" in found(made, "slash-twins").message
    made.slashed.clear()

    # ROS 1's own tf removes the slash: such a robot works, and its transforms have slashes.
    made.kind = "ROS 1 bag"
    made.slashed["odom", "base_link", False] = 7
    assert found(made, "slash-twins").severity is Severity.WARNING
    assert ids(made, notes=True) == ["slash-twins"]


def test_no_cure_names_a_frame_with_a_slash():
    made = robot()
    made.hears("/camera/info", "/camera_frame", kind="sensor_msgs/CameraInfo")
    fixes = found(made, "unknown-frame").fixes
    # Without the slash, the frame is still unknown.
    assert fixes[0].command.endswith("--child-frame-id camera_frame")
    assert fixes[1].text.startswith('and set frame_id to "camera_frame"')
    assert not any("/camera_frame" in fix.text + fix.command for fix in fixes)


def test_an_unknown_frame_of_what_no_map_needs_is_a_warning():
    made = robot()
    made.hears("/gps/fix", "navsat", kind="sensor_msgs/NavSatFix")
    assert found(made, "unknown-frame").severity is Severity.WARNING
    made.hears("/points", "navsat", kind="sensor_msgs/PointCloud2")
    assert found(made, "unknown-frame").severity is Severity.ERROR


@pytest.mark.parametrize("name", ["navsat_link", "utm_link"])
def test_a_frame_is_not_near_because_it_is_a_link_too(name):
    made = robot()
    made.static("base_link", "arm_link")
    made.hears("/gps/fix", name, kind="sensor_msgs/NavSatFix")
    finding = found(made, "unknown-frame")
    assert "near" not in finding.evidence[0]
    # A frame that is fixed to the world is not a mount.
    assert bool(finding.fixes[0].command) == (name == "navsat_link")


def test_a_mount_is_proposed_for_a_sensor_of_a_device_without_a_base():
    made = Robot(kind="ROS 1 bag")
    made.moving("tilt_base", "tilt_axis")
    made.static("tilt_axis", "laser")
    made.hears("/imu", "/base_imu", kind="sensor_msgs/Imu")
    (mount, slash) = found(made, "unknown-frame").fixes
    assert mount.command.endswith("X Y Z YAW PITCH ROLL PARENT base_imu")
    assert slash.text.startswith('and set frame_id to "base_imu"')


def test_an_unknown_frame_of_two_robots_is_not_in_their_namespaced_transforms_either():
    made = Robot()
    made.moving("odom", "base_link", topic="/r1/tf")
    made.sent("base_link", "imu", 0.0, topic="/r1/tf_static")
    for robot_name in ("r1", "r2"):
        made.hears(f"/{robot_name}/gps/fix", "navsat_link", kind="sensor_msgs/NavSatFix")
    finding = found(made, "unknown-frame")
    assert finding.severity is Severity.WARNING
    assert finding.because_of is None
    assert finding.evidence[0].endswith("; 2 robots use this name: r1, r2")


def test_unknown_frames_with_one_cure_are_one_finding():
    made = robot()
    for name in ("utm", "wgs84"):
        made.hears(f"/{name}", name, kind="sensor_msgs/NavSatFix")
    assert ids(made, notes=True) == ["unknown-frame"]
    finding = found(made, "unknown-frame")
    assert finding.severity is Severity.NOTE
    assert finding.message == "no transform names utm, wgs84"
    assert [line.split(" (")[0] for line in finding.evidence] == ["utm: /utm", "wgs84: /wgs84"]


def test_slashes_in_transforms_are_a_note_and_two_of_them_an_error():
    made = robot()
    made.slashed["odom", "base_link", False] = 7
    made.static("base_link", "/camera")
    severities = {
        one.edges: one.severity for one in made.judged().findings if one.id == "leading-slash"
    }
    assert severities == {
        (("odom", "base_link"),): Severity.NOTE,
        (("base_link", "/camera"),): Severity.ERROR,
    }


def test_names_that_differ_in_case_hide_the_frame_that_is_unknown():
    made = robot(scans=False)
    made.hears("/scan", "Laser")
    assert ids(made) == ["case-twins"]
    assert set(found(made, "case-twins").frames) == {"Laser", "laser"}
    made.static("laser", "Laser")
    assert found(made, "case-twins").severity is Severity.NOTE


def test_a_typo_is_one_but_left_and_right_and_numbers_are_a_family():
    made = robot(scans=False)
    made.hears("/scan", "lasre")
    assert ids(made) == ["typo-twins"]

    family = robot()
    for name in ("camera1", "camera2", "left_wheel", "right_wheel"):
        family.static("base_link", name)
    family.hears("/image", "camera3", kind="sensor_msgs/Image")
    assert "typo-twins" not in ids(family)


def test_a_prefix_that_half_of_the_frames_carry():
    made = robot(scans=False)
    made.moving("robot1/odom", "robot1/base_link")
    finding = found(made, "namespace-twins")
    assert finding.facts["prefix"] == "robot1/"
    assert ids(made) == ["namespace-twins"]


def test_a_prefixed_twin_of_a_name_that_only_messages_use():
    made = Robot()
    made.moving("world", "vicon/auk")
    made.hears("/imu", "auk", kind="sensor_msgs/Imu")
    finding = found(made, "namespace-twins")
    assert finding.consequence == "no transform names auk: nothing can place /imu"
    assert finding.fixes[0].text.endswith("the messages on /imu should name the one in tf")


def test_transforms_on_a_namespaced_topic():
    made = Robot()
    made.moving("odom", "base_link", topic="/r1/tf")
    assert found(made, "namespaced-topic").evidence == ("nothing moves on /tf",)

    beside = robot()
    beside.moving("other", "thing", topic="/r1/tf")
    assert found(beside, "namespaced-topic").evidence == ("/tf has transforms too",)


def test_a_note_does_not_hide_an_error():
    made = robot(scans=False)
    made.moving("other", "thing", topic="/r1/tf")
    made.hears("/scan", "nowhere")
    assert found(made, "namespaced-topic").severity is Severity.NOTE
    assert ids(made) == ["unknown-frame"]


@pytest.mark.parametrize("name", ["on", "1", "null", "laser ", "~laser", "a\nb", "x" * 120])
def test_names_that_tools_stumble_over(name):
    made = robot()
    made.static("base_link", name)
    assert found(made, "awkward-name").frames == (name,)


def by_definition(one, other):
    """Return the distance by its recursive definition: the best of all first steps."""
    if not one or not other:
        return len(one) + len(other)
    ways = [
        by_definition(one[1:], other) + 1,
        by_definition(one, other[1:]) + 1,
        by_definition(one[1:], other[1:]) + (one[0] != other[0]),
    ]
    if len(one) > 1 and one[0] == other[1:2] and one[1] == other[0]:
        ways.append(by_definition(one[2:], other[2:]) + 1)
    return min(ways)


@given(st.text("ab_", max_size=6), st.text("ab_", max_size=6), st.integers(0, 3))
def test_the_distance_of_two_names_is_that_of_its_definition_up_to_what_is_asked(one, other, most):
    right = by_definition(one, other)

    measured = distance(one, other, most)

    assert measured == right if right <= most else measured > most
    assert distance(f"robot/{one}_link", f"robot/{other}_link", 12) == right


def test_a_frame_that_only_the_filtered_position_names_is_not_missed():
    made = robot()
    made.hears("/gps/filtered", "gps", kind="sensor_msgs/NavSatFix")
    assert ids(made, notes=True) == []
    made.hears("/gps/fix", "antenna", kind="sensor_msgs/NavSatFix")
    assert ids(made) == ["unknown-frame"]


def test_transforms_of_a_type_that_tf2_does_not_read_are_told():
    made = robot(scans=False)
    evidence = made.evidence()
    for kind, told in (("geometry_msgs/TransformStamped", ["wrong-type"]), ("tf/tfMessage", [])):
        topics = tuple(replace(topic, type=kind) for topic in evidence.topics)
        findings = judge(replace(evidence, topics=topics)).findings
        assert [one.id for one in findings] == told
    topics = tuple(
        replace(topic, name=topic.name[1:], type="geometry_msgs/TransformStamped")
        for topic in evidence.topics
    )
    (finding,) = judge(replace(evidence, topics=topics)).findings
    assert finding.fixes[0].text.startswith("let the program that wrote the recording")


def test_a_slash_on_messages_that_are_older_than_their_frame_says_so():
    for begin, told in ((3.0, True), (0.0, False)):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", begin=begin)
        made.hears("/cloud", "/laser", kind="sensor_msgs/PointCloud2", end=1.0, latency=4.0)
        finding = found(made, "slash-twins")
        aged = "/cloud is dated 2.10 s or more before the first sample of base_link in odom, and"
        assert finding.message.startswith(aged) is told
        assert finding.fixes[0].text.startswith("first find out why /cloud arrives 4.00 s") is told


def test_clouds_that_are_all_older_than_the_transforms_are_a_warning():
    for end, severity in ((1.0, Severity.WARNING), (6.0, Severity.NOTE)):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", begin=3.0)
        made.hears("/cloud", "laser", kind="sensor_msgs/PointCloud2", end=end, latency=4.0)
        finding = found(made, "late-start")
        assert finding.severity is severity
        assert "4.00 s late on arrival" in finding.evidence[0]


def test_raw_input_of_a_localiser_beside_no_robot_is_a_note():
    for child, node, severity in (
        ("arrow", "/bridge", Severity.NOTE),
        ("arrow", "/imu", Severity.WARNING),
        ("base_link", "/bridge", Severity.WARNING),
    ):
        made = Robot()
        made.moving("optitrack", child)
        made.hears("/light", "LHR-1", kind="hive/ViveLight")
        made.hears("/imu", "LHR-1", kind="sensor_msgs/Imu")
        evidence = made.evidence()
        nodes = (Publisher("/light", "/bridge"), Publisher("/imu", node))
        told = judge(replace(evidence, publishers=(*evidence.publishers, *nodes))).findings
        finding = next(one for one in told if one.id == "unknown-frame")
        assert finding.severity is severity
        if severity is Severity.NOTE:
            assert finding.fixes[0].text.startswith("/bridge sends them")
            assert "/light (hive/ViveLight, 80 messages)" in finding.evidence[0]


def test_messages_without_a_frame_name_are_counted_and_name_their_node():
    made = robot()
    made.hears("/points", "", kind="sensor_msgs/PointCloud2")
    assert found(made, "empty-frame").message == "no frame name in 80 messages on /points"
    evidence = made.evidence()
    known = (*evidence.publishers, Publisher("/points", "/lidar"))
    (finding,) = judge(replace(evidence, publishers=known)).findings
    assert finding.fixes[0].text == "set header.frame_id in /lidar, which publishes /points"


def test_all_measurements_without_a_frame_name_are_one_finding():
    made = robot()
    for topic, kind in (
        ("/depth", "geometry_msgs/PoseWithCovarianceStamped"),
        ("/dvl", "geometry_msgs/TwistWithCovarianceStamped"),
        ("/command", "geometry_msgs/TwistStamped"),
    ):
        made.hears(topic, "", kind=kind)
    told = [one for one in made.judged().findings if one.id == "empty-frame"]
    assert [(one.severity, one.topics) for one in told] == [
        (Severity.WARNING, ("/depth", "/dvl")),
    ]
    (fix,) = told[0].fixes
    assert fix.text.startswith("find the publisher of each topic, and set header.frame_id there: ")
    assert fix.text.count("topic info --verbose") == 2
    evidence = made.evidence()
    known = tuple(Publisher(topic, "/auv") for topic in ("/depth", "/dvl"))
    evidence = replace(evidence, publishers=(*evidence.publishers, *known))
    finding = next(one for one in judge(evidence).findings if one.id == "empty-frame")
    (fix,) = finding.fixes
    assert fix.text == "set header.frame_id in /auv, which publishes /depth, /dvl"


def test_messages_without_a_stamp_and_a_frame_were_not_meant_for_tf():
    made = robot()
    made.hears("/sent", "", kind="geometry_msgs/PointStamped")
    kind, rows = made.heard["/sent"]
    made.heard["/sent"] = (kind, [(0, log, frame) for _, log, frame in rows])
    assert found(made, "empty-frame").severity is Severity.NOTE


@pytest.mark.parametrize(
    ("node", "severity"),
    [("/vicon", Severity.WARNING), ("/robot_state_publisher", Severity.NOTE)],
)
def test_a_publisher_whose_messages_are_all_empty_is_told(node, severity):
    made = robot()
    evidence = made.evidence()
    transforms = evidence.transforms
    logs = np.arange(100, dtype=np.int64) * seconds(0.05) + evidence.start
    sender = np.full(100, len(transforms.publishers), dtype=np.int32)
    known = (*transforms.publishers, Publisher("/tf", node))
    more = replace(
        transforms,
        log_times=np.concatenate([transforms.log_times, logs]),
        senders=np.concatenate([transforms.senders, sender]),
        publishers=known,
    )
    (finding,) = judge(replace(evidence, transforms=more)).findings
    assert (finding.id, finding.severity) == ("empty-message", severity)
    assert finding.evidence[0] == f"/tf: all 100 messages of {node}"
    assert finding.consequence == "frames that its publisher does not see are not in the recording"
