"""Tests of faults that readers found in findings about values, frames and publishers."""

import math
from dataclasses import replace

import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, START, Robot, drives, robot, stands
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.drawing.finding_view import areas
from tftool.recordings.contract import Publisher, RecordedTopic


def test_a_real_sensor_beside_a_simulated_robot_is_one_warning():
    made = robot(start=136.0, log_from=START)
    made.start = START
    made.moving("imu_link", "sonar", hz=10)
    made.hears("/distance", "sonar", kind="sensor_msgs/Range")
    assert ids(made) == ["clock-mixture"]
    assert found(made, "clock-mixture").severity is Severity.WARNING
    assert found(made, "split-tree").because_of == "clock-mixture"


def test_a_robot_that_tf_does_not_know_is_not_a_missing_static():
    for frames, unknown in ((("map", "odom"), "scan"), (("world", "drone"), "cf1/base_link")):
        made = Robot()
        made.moving(*frames)
        made.hears("/scan", unknown)
        assert ids(made) == ["unknown-frame"]
        fixes = found(made, "unknown-frame").fixes
        assert not any("static" in fix.text + fix.command for fix in fixes)


def test_a_wheel_that_turns_more_than_once_per_sample_has_one_source():
    made = robot()
    angle = 0.0
    for tick in range(160):
        angle += 1.5 if tick % 2 else 2.0 * math.pi - 1.4
        made.sent("base_link", "wheel", tick * 0.05, (0.0, 0.2, 0.0, *turned(angle, 1)))
    # Without the name of the source of joint states, this may be two sources or one fast wheel.
    assert found(made, "publisher-conflict").severity is Severity.NOTE
    made.hears("/joint_states", "", kind="sensor_msgs/JointState")
    evidence = made.evidence()
    known = (*evidence.publishers, Publisher("/joint_states", "/gazebo"))
    told = judge(replace(evidence, publishers=known)).findings
    assert "publisher-conflict" not in [one.id for one in told]


def test_resting_odometry_is_never_offered_as_a_mount():
    for parent, child, offered in (("odom", "base_link", False), ("base_link", "laser", True)):
        made = robot(odometry=parent != "odom", laser=child != "laser", scans=False)
        made.moving(parent, child, 5.0, stands, latency=0.1)
        made.hears("/scan", "laser")
        texts = [fix.text for fix in found(made, "sensor-outruns-tf").fixes]
        assert any("mount" in text for text in texts) is offered


def test_a_topic_that_tf2_can_read_is_offered():
    made = robot(odometry=False, laser=False, scans=False)
    made.moving("odom", "base_link", topic="/a/transform")
    made.moving("base_link", "arm", topic="/b/tf")
    evidence = made.evidence()
    kinds = {"/a/transform": "geometry_msgs/TransformStamped"}
    topics = tuple(replace(t, type=kinds.get(t.name, t.type)) for t in evidence.topics)
    told = judge(replace(evidence, topics=topics)).findings
    finding = next(one for one in told if one.id == "namespaced-topic")
    assert "/tf:=/b/tf" in finding.fixes[0].command
    assert "--tf-topic /b/tf" in finding.fixes[1].text


def test_tags_out_of_view_are_a_note():
    made = Robot()
    made.moving("camera", "tag_2", 30.0, without=(2.0, 5.0))
    assert found(made, "gap").severity is Severity.NOTE


def test_a_frame_computed_from_a_conflict_is_no_conflict_of_its_own():
    made = robot(odometry=False)
    for tick in range(160):
        at = tick * 0.05
        apart = 3.0 * (tick % 3 == 0)
        node = "/filter" if apart else "/driver"
        made.sent("odom", "base_link", at, (apart, 0.0, 0.0, *NO_TURN), node=node)
        made.sent("odom", "star", at, (2.0 * apart, 0.0, 0.0, *NO_TURN), node="/star")
    assert ids(made) == ["publisher-conflict"]
    finding = found(made, "publisher-conflict")
    assert finding.edges == (("odom", "base_link"),)
    assert "star in odom, which /star sends, follows" in finding.evidence[0]


def test_equal_transforms_of_two_publishers_are_a_note_that_names_the_description():
    made = robot()
    for tick in range(80):
        for copy in range(2):
            pose = (0.0, 0.2, 0.0, *turned(0.1 * tick, 1))
            made.sent("base_link", "wheel", 0.1 * tick, pose, latency=0.004 + 0.0001 * copy)
    finding = found(made, "sent-twice")
    assert (finding.severity, finding.edges) == (Severity.NOTE, (("base_link", "wheel"),))
    assert "topic info --verbose /tf" in finding.fixes[0].text
    evidence = made.evidence()
    described = RecordedTopic("/robot_description", "std_msgs/String", encoding="cdr", count=2)
    evidence = replace(
        evidence,
        topics=(*evidence.topics, described),
        publishers=(*evidence.publishers, Publisher("/robot_description", offers=2)),
    )
    (told,) = [one for one in judge(evidence).findings if one.id == "sent-twice"]
    assert "topic info --verbose /robot_description" in told.fixes[0].text
    assert told.severity is Severity.NOTE


@pytest.mark.parametrize("copies", [1, 2])
def test_transforms_statics_and_descriptions_that_are_all_sent_twice_are_a_warning(copies):
    made = robot()
    for _ in range(copies):
        made.static("base_link", "camera")
    for tick in range(80):
        for copy in range(2):
            pose = (0.0, 0.2, 0.0, *turned(0.1 * tick, 1))
            made.sent("base_link", "wheel", 0.1 * tick, pose, latency=0.004 + 0.0001 * copy)
    evidence = made.evidence()
    described = RecordedTopic("/robot_description", "std_msgs/String", encoding="cdr", count=2)
    evidence = replace(evidence, topics=(*evidence.topics, described))
    (told,) = [one for one in judge(evidence).findings if one.id == "sent-twice"]
    assert told.severity is (Severity.WARNING if copies == 2 else Severity.NOTE)
    assert ("/robot_description and statics came more than once" in told.evidence[0]) is (
        copies == 2
    )


@pytest.mark.parametrize("noise", [0.0, 0.02e-3, 0.1e-3, 0.15e-3, 0.3e-3])
def test_a_loop_that_repeats_its_newest_pose_until_the_next_one_sends_nothing_twice(noise):
    made = robot(scans=False)
    for tick in range(200):
        at = 0.2 * (tick // 10)
        pose = (0.01 * (tick // 10), 0.0, 0.0, *NO_TURN)
        late = 0.02 * (tick % 10) + noise * math.sin(7.0 * tick)
        made.sent("map", "odom", at + 0.2, pose, latency=late - 0.2)
    assert "sent-twice" not in ids(made, notes=True)


@pytest.mark.parametrize(("speed", "told"), [(0.5, ["rep105-shape"]), (0.001, [])])
def test_a_footprint_that_stays_behind_while_the_robot_drives_is_a_warning(speed, told):
    made = robot(odometry=False)
    made.moving("odom", "base_footprint", pose=stands)
    made.moving("base_footprint", "base_link", pose=lambda t: (speed * t, 0.0, 0.0, *NO_TURN))
    assert ids(made) == told
    if told:
        finding = found(made, "rep105-shape")
        assert "base_link in base_footprint moves by 3.99 m" in finding.evidence[0]
        assert "base_footprint as the robot's frame see a robot" in finding.consequence


def test_a_tree_that_two_parents_do_not_split_has_a_finding_of_its_own():
    made = robot(scans=False)
    made.moving("combined", "base_link", 20.0, drives)
    for number in range(4):
        made.moving("camera", f"tag_{number}", 20.0)
    assert set(ids(made)) == {"two-parents", "split-tree"}
    assert "camera is not joined" in next(
        one.message
        for one in made.judged().findings
        if one.id == "split-tree" and not one.because_of
    )


def test_a_filter_that_jumps_at_ten_metres_per_second_is_told():
    made = robot(odometry=False)
    step = 0.35
    made.moving(
        "odom",
        "base_link",
        28.0,
        lambda t: (0.05 * t + step * (t < 2.4), 0.0, 0.0, *NO_TURN),
    )
    assert ids(made) == ["teleport"]


def test_scans_in_an_unknown_frame_are_an_error_on_a_robot_only():
    for child, severity in (("base_link", Severity.ERROR), ("odom", Severity.WARNING)):
        made = Robot()
        made.moving("map", child)
        made.static(child, "camera")
        made.hears("/scan", "lidar")
        assert found(made, "unknown-frame").severity is severity


def test_messages_of_a_robots_own_type_in_an_unknown_frame_are_a_note():
    made = robot()
    made.hears("/lane", "camera", kind="lane_msgs/LaneState")
    assert found(made, "unknown-frame").severity is Severity.NOTE
    assert ids(made) == []


def test_results_in_an_unknown_frame_are_a_note():
    for kind, severity in (
        ("geometry_msgs/PoseStamped", Severity.NOTE),
        ("sensor_msgs/Imu", Severity.WARNING),
    ):
        made = robot()
        made.hears("/thing", "thing", kind=kind)
        assert found(made, "unknown-frame").severity is severity


def test_a_recording_without_transforms_and_sensors_is_no_error():
    made = Robot()
    made.hears("/joint_states", "base", kind="sensor_msgs/JointState")
    assert found(made, "no-transforms").severity is Severity.WARNING
    made.hears("/scan", "laser")
    assert found(made, "no-transforms").severity is Severity.ERROR


def test_a_recording_in_which_nothing_names_a_frame_needs_no_transforms():
    made = Robot()
    made.hears("/servos", "", kind="sensor_msgs/JointState")
    finding = found(made, "no-transforms")
    assert finding.severity is Severity.NOTE
    assert finding.message == "there are no transforms, and no message header names a frame"
    assert "fine" not in areas(made.judged())
    for more, severity in (
        (RecordedTopic("/boxes", "visualization_msgs/MarkerArray", count=4), Severity.WARNING),
        (RecordedTopic("/boxes", "my/Box", count=4, definition="{frame_id}"), Severity.WARNING),
        (RecordedTopic("/tf", "tf2_msgs/TFMessage", transforms=True), Severity.WARNING),
        (RecordedTopic("/level", "Level", "json", count=4), Severity.NOTE),
    ):
        evidence = made.evidence()
        told = judge(replace(evidence, topics=(*evidence.topics, more))).findings
        assert [one.severity for one in told if one.id == "no-transforms"] == [severity]


@pytest.mark.parametrize(
    ("encoding", "command"), [("cdr", "ros2 "), ("ros1", "rostopic "), ("json", "")]
)
def test_a_command_of_ros_is_only_given_for_recordings_of_ros(encoding, command):
    made = Robot()
    made.hears("/scan", "laser")
    evidence = made.evidence()
    topics = tuple(replace(one, encoding=encoding) for one in evidence.topics)
    (finding,) = judge(replace(evidence, topics=topics)).findings
    assert (f"`{command}" in finding.fixes[0].text) is bool(command)
    assert ("`" in finding.fixes[0].text) is bool(command)


def test_optical_axes_matter_if_data_is_in_the_frame():
    made = robot()
    made.static("base_link", "camera_link")
    made.static("camera_link", "camera_optical_frame")
    assert found(made, "optical-convention").severity is Severity.NOTE
    made.hears("/image", "camera_optical_frame", kind="sensor_msgs/Image")
    assert found(made, "optical-convention").severity is Severity.WARNING


def test_a_robot_of_its_own_is_no_lost_tree():
    made = robot()
    made.moving("r2/odom", "r2/base_link")
    made.hears("/r2/scan", "r2/base_link")
    assert found(made, "split-tree").severity is Severity.NOTE


def test_one_mount_with_two_roundings_was_not_changed():
    for shift, told in ((1e-5, []), (0.002, ["static-changed"])):
        made = robot()
        made.static("base_link", "laser", (0.1 + shift, 0.0, 0.2, *NO_TURN), at=1.0)
        assert ids(made) == told


def test_a_rotation_of_a_wrong_length_names_its_topic_and_its_effect():
    made = robot(scans=False)
    made.static("odom", "map", (1.0, 0.0, 0.0, 0.0, 0.0, 0.68, 0.72))
    finding = found(made, "bad-quaternion")
    assert finding.message == "map in odom has a rotation of length 0.9904 instead of 1"
    # 2 atan(0.68 / 0.72) is 86.7°.
    assert "ROS 2 normalises it to 86.7° about z" in finding.evidence[0]
    assert "--verbose /tf_static" in finding.fixes[0].text
    # The numbers of a valid rotation were typed with two digits.
    assert finding.severity is Severity.NOTE
    made.kind = "ROS 1 bag"
    old = found(made, "bad-quaternion")
    assert old.severity is Severity.WARNING
    assert "ROS 1 does not know the frame" in old.consequence
    assert "rostopic info /tf_static" in old.fixes[0].text


def test_a_command_names_the_topic_on_which_the_transform_was_sent():
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=4.0, topic="/robot/tf")
    made.hears("/imu", "base_link", kind="sensor_msgs/Imu")
    assert "--verbose /robot/tf`" in found(made, "edge-stopped").fixes[0].text


def test_a_robot_that_the_world_loses_for_seconds_is_a_warning():
    for child, parent, severity in (
        ("drone", "world", Severity.WARNING),
        ("tag_4", "world", Severity.NOTE),
        ("arm", "base_link", Severity.NOTE),
    ):
        made = Robot()
        made.moving(parent, child, without=(3.0, 6.0))
        finding = found(made, "gap")
        assert finding.severity is severity
        assert "continued" not in finding.fixes[0].text
    made.moving("odom", "base_link")
    assert "base_link in odom continued" in found(made, "gap").fixes[0].text


def test_a_localiser_that_corrects_the_robot_again_and_again_is_told():
    def localised(*jumps: float) -> Robot:
        made = robot()
        made.moving(
            "map",
            "odom",
            pose=lambda t: (sum(0.8 for jump in jumps if jump < t), 0.0, 0.0, *NO_TURN),
        )
        return made

    assert ids(localised(1.0)) == []
    assert ids(localised(1.0, 3.0, 5.0)) == []
    told = found(localised(1.0, 3.0, 5.0, 6.0), "teleport")
    assert told.message.startswith("odom in map jumps by up to 0.80 m, 3 times by more than 0.5 m")
    # The commands print the pose that the finding measured, before and after the jump.
    assert told.fixes[0].command.startswith("tftool echo map base_link RECORDING --at 17500000")
    assert "also at" in told.evidence[0]
    assert told.fixes[0].command != told.fixes[1].command
    # A command takes small numbers as seconds since the start, not as simulated stamps.
    made = robot(start=136.0, log_from=START, odometry=False)
    made.moving("odom", "base_link", pose=lambda t: (2.0 * (t > 4.0), 0.0, 0.0, *NO_TURN))
    assert found(made, "teleport").fixes[1].command.endswith("RECORDING --at 4.02")


def test_a_turn_of_odom_about_the_robot_corrects_nothing():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", pose=lambda _: (9.0, 0.0, 0.0, *NO_TURN))
    for tick in range(160):
        # Odom turns about the robot, and the origin of odom moves by metres.
        angle = 0.2 * (tick // 20 % 2)
        x, y = 9.0 - 9.0 * math.cos(angle), -9.0 * math.sin(angle)
        made.sent("map", "odom", 0.05 * tick, (x, y, 0.0, *turned(angle)))
    assert ids(made) == []


def test_a_fast_wheel_that_turns_one_way_has_one_source():
    for step, told in ((-1.0, True), (1.0, False)):
        made = robot()
        angle = 0.0
        for tick in range(160):
            angle += 2.2 if tick % 2 else step
            made.sent("base_link", "wheel", tick * 0.05, (0.0, 0.2, 0.0, *turned(angle, 1)))
        assert ("publisher-conflict" in ids(made, notes=True)) is told


def test_a_slash_that_the_transforms_of_an_old_robot_have_too_is_a_note():
    for slashed, severity in ((400, Severity.NOTE), (0, Severity.WARNING)):
        made = Robot(kind="ROS 1 bag")
        made.moving("odom", "base_link")
        made.slashed["odom", "base_link", False] = slashed
        made.hears("/odom", "/odom", kind="nav_msgs/Odometry")
        assert found(made, "slash-twins").severity is severity
    assert found(made, "slash-twins").message == "/odom names /odom, tf knows odom"


def test_a_slash_in_joint_states_is_a_note_because_nobody_places_them():
    made = Robot(kind="ROS 1 bag")
    made.moving("odom", "base_link")
    made.hears("/joint_states", "/base_link", kind="sensor_msgs/JointState")
    assert found(made, "slash-twins").severity is Severity.NOTE


def test_only_a_frame_with_the_name_of_a_mount_lacks_a_static_transform():
    for frame, told in (
        ("LHR-FD35", "unknown-frame"),
        ("camera_init", "unknown-frame"),
        ("imu_link", "static-missing"),
        ("camera", "static-missing"),
    ):
        made = Robot()
        made.moving("vive", "LHR-0A11")
        made.hears("/imu", frame, kind="sensor_msgs/Imu")
        assert ids(made) == [told]
        texts = [fix.text for fix in found(made, told).fixes]
        assert any("/tf_static" in text for text in texts) is (told == "static-missing")


def test_a_marker_seen_once_among_markers_seen_often_may_be_a_false_detection():
    made = Robot()
    made.hears("/image", "camera", kind="sensor_msgs/Image")
    made.moving("camera", "marker_0")
    made.sent("camera", "marker_367", 4.0)
    finding = found(made, "single-sample")
    assert finding.evidence[0].endswith("; marker_0 400 times")
    assert "false detection" in finding.fixes[0].text


def test_each_frame_that_jumps_has_a_length_of_its_own():
    made = robot()
    for child, far in (("arm", 1.0), ("hand", 3.0)):
        made.moving("base_link", child, pose=lambda t, f=far: (f * (t > 4.0), 0.0, 0.0, *NO_TURN))
        made.hears(f"/{child}/scan", child)
    assert found(made, "teleport").message == (
        "arm in base_link jumps 1.00 m within 20 ms, hand in base_link jumps 3.00 m within 20 ms"
    )


def test_replays_of_several_parts_among_live_data_are_no_loop():
    made = Robot()
    made.moving("odom", "base_link")
    made.moving("base_link", "arm")
    first = [(edge, list(rows)) for edge, rows in made.records.items()]
    # The first five seconds are repeated after 12 s, and the first two seconds after 18 s.
    for log, length in ((12.0, 5.0), (18.0, 2.0)):
        for edge, rows in first:
            for stamp, pose, _ in rows[: round(50 * length)]:
                at = (stamp - made.log(0.0)) / 1e9
                made.sent(*edge[:2], log + at, pose, stamp=stamp)
    finding = found(made, "time-jump-back")
    assert finding.message == (
        "time went back by 4.98 s to 7.98 s, 2 times: data was played again among live data"
    )
    assert finding.fixes[0].command.startswith("tftool edit RECORDING -o PART --record-time --to")


def test_a_tag_that_jumps_by_metres_between_detections_is_told():
    for parent, told in (("camera", ["teleport"]), ("world", [])):
        made = Robot()
        made.moving(
            parent, "tag0", 4.0, lambda t: (0.1 * t, 0.0, 5.0 + int(t) * 1.7 % 4.1, *NO_TURN)
        )
        assert ids(made) == told
        if told:
            finding = found(made, "teleport")
            assert "by up to 2.40 m, 7 times by more than 1 m within 1 s" in finding.message
            assert "seen at 5 m to 8.7" in finding.evidence[0]


@pytest.mark.parametrize(("speed", "told"), [(4.0, False), (0.5, True)])
def test_a_fast_tag_that_is_not_detected_for_a_while_has_only_moved_on(speed, told):
    made = Robot()
    for tick in range(400):
        t = 0.05 * tick
        if t % 4.0 < 3.4:  # 0.6 s without detections, in which a slow tag moves by 2.4 m, too
            z = speed * t + (0.0 if speed == 4.0 else 2.1 * int(t / 4.0))
            made.sent("camera", "tag0", t, (0.0, 0.0, 5.0 + z, *NO_TURN))
    assert ("teleport" in ids(made)) is told


def test_a_velocity_without_a_frame_is_a_note():
    for kind, severity in (
        ("geometry_msgs/TwistWithCovarianceStamped", Severity.NOTE),
        ("geometry_msgs/PoseStamped", Severity.WARNING),
    ):
        made = robot()
        made.hears("/estimate", "", kind=kind)
        assert found(made, "empty-frame").severity is severity


def test_a_localiser_that_stands_still_cancels_no_odometry():
    for moves, told in ((True, ["odometry-cancelled"]), (False, [])):
        made = robot()
        made.moving("map", "odom", 10.0, lambda t, m=moves: (-0.5 * t * m, 0.0, 0.0, *NO_TURN))
        assert [one for one in ids(made) if one == "odometry-cancelled"] == told


def test_the_distance_of_two_sources_of_odometry_is_no_way_that_is_cancelled():
    made = robot(odometry=False, scans=False)
    for node, x in (("/camera", 0.0), ("/filter", 50.0)):
        made.moving("odom", "base_link", 20.0, lambda _t, x=x: (x, 0.0, 0.0, *NO_TURN), node=node)
    made.moving("map", "odom", 20.0, lambda t: (-50.0 * (t % 0.1 > 0.04), 0.0, 0.0, *NO_TURN))
    assert "odometry-cancelled" not in ids(made, notes=True)


def test_a_kind_that_changes_once_is_a_warning_and_ros_1_keeps_the_first():
    for kind, begin, so in (
        ("rosbag2", -1.0, "the change clears the history of laser: later lookups of the time"),
        ("rosbag2", 9.0, "every lookup of laser gets the static pose, at any time"),
        ("ROS 1 bag", -1.0, "here the static one (at 0.00 s): every lookup of laser gets"),
        ("ROS 1 bag", 1.0, "here the moving one (at 0.00 s): the static pose of laser counts as"),
    ):
        made = robot(laser=False)
        made.kind = kind
        made.static("base_link", "laser", (0.1, 0.0, 0.2, *NO_TURN), at=begin)
        made.moving("base_link", "laser", 10.0, lambda _t: (0.1, 0.0, 0.5, *NO_TURN))
        finding = found(made, "static-and-dynamic")
        assert finding.severity is Severity.WARNING
        assert so in finding.consequence
        assert "0.30 m apart: moving 0.1 0 0.5, static 0.1 0 0.2" in finding.evidence[0]
        assert ("the kind changes once" in finding.evidence[0]) is (kind == "rosbag2")


def test_limbs_that_a_tracker_of_people_loses_are_no_jumps():
    for count, told in ((5, False), (2, True)):
        made = Robot()
        for number in range(count):
            for tick in range(240):
                far = 0.6 if number == 0 and tick in (100, 101, 102) else 0.0
                pose = (1.0 + 0.001 * tick + far, 0.3 * number, 2.0, *NO_TURN)
                made.sent("camera_depth_frame", f"limb_{number}", tick / 30.0, pose, node="/people")
        assert ("teleport" in ids(made, notes=True)) is told


def test_a_static_whose_values_hardly_differ_is_a_note():
    for step, severity in ((1e-4, Severity.NOTE), (1e-3, Severity.WARNING)):
        made = robot(laser=False)
        for number in range(4):
            pose = (0.1 + step * number, 0.0, 0.2, *NO_TURN)
            made.static("base_link", "laser", pose, at=float(number))
        assert found(made, "dynamic-on-static").severity is severity


def test_a_robot_that_stays_in_the_map_may_have_wrong_odometry():
    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=lambda t: (t, 0.0, 0.0, *NO_TURN))
    made.moving("map", "odom", pose=lambda t: (-t, 0.0, 0.0, *NO_TURN))
    assert "either the odometry or" in found(made, "odometry-cancelled").consequence


def test_topics_without_a_position_in_an_unknown_frame_are_named():
    made = Robot()
    made.moving("odom", "base_link")
    made.hears("/imu_data", "base_imu", kind="sensor_msgs/Imu")
    made.hears("/temperature", "base_imu", kind="sensor_msgs/Temperature")
    (finding,) = [one for one in made.judged().findings if one.id == "unknown-frame"]
    assert "also in this frame, without a position: /temperature" in finding.evidence[0]


def test_moving_joints_without_state_are_no_missing_statics_in_early_ros1():
    made = Robot()
    made.kind = "ROS 1 bag"
    made.moving("odom", "base_link", node="/driver")
    for name in ("laser", "sonar", "top", "swivel"):
        made.moving("base_link", name, pose=stands, node="/robot_state_publisher")
    made.moving("caster", "hubcap", pose=stands, node="/robot_state_publisher")
    assert "nothing in the data says" in found(made, "split-tree").fixes[0].text


def test_an_arm_without_recorded_statics_is_not_measured_first():
    made = robot(laser=False, scans=False)
    made.moving("base_link", "conveyor", pose=stands)
    made.moving("imu_link", "arm", pose=stands)
    (fix,) = found(made, "split-tree").fixes
    assert "check whether the robot sends static transforms" in fix.text
    assert fix.text.index("check whether") < fix.text.index("if nothing sends it, measure")


def with_type(made: Robot, topic: str, kind: str = "geometry_msgs/TransformStamped"):
    """Return the findings of a robot, one of whose topics has another type."""
    evidence = made.evidence()
    topics = tuple(replace(t, type=kind) if t.name == topic else t for t in evidence.topics)
    return judge(replace(evidence, topics=topics))


@pytest.mark.parametrize("parent", ["world", "observer/world"])
def test_single_transforms_beside_lists_of_transforms_are_no_second_source(parent):
    made = Robot()
    made.kind = "ROS 1 bag"
    made.moving("world", "drone", node="/vicon")
    made.moving(parent, "drone", node="/vicon", topic="/vicon/drone")
    found_there = with_type(made, "/vicon/drone")
    assert [one.id for one in found_there.findings] == ["namespaced-topic"]
    assert found_there.findings[0].topics == ("/vicon/drone",)


def test_a_namespaced_copy_of_tf_repeats_nothing():
    made = Robot()
    made.kind = "ROS 1 bag"
    made.moving("odom", "base_link")
    made.moving("odom", "base_link", topic="/r1/tf", latency=0.006)
    assert ids(made, notes=True) == ["namespaced-topic"]


def test_single_transforms_of_a_frame_that_tf_lacks_are_examined():
    made = robot()
    made.moving("world", "ball", end=3.0, topic="/vicon/ball")
    judged = with_type(made, "/vicon/ball")
    assert "ball" in judged.model.frames


def test_names_are_a_note_if_no_listener_of_tf_receives_the_transforms():
    made = Robot()
    made.moving("world", "vicon/auk", topic="/vicon/auk")
    made.hears("/imu", "auk", kind="sensor_msgs/Imu")
    made.hears("/range", "nose", kind="sensor_msgs/Range")
    for kind, shown in (("tf2_msgs/TFMessage", True), ("geometry_msgs/TransformStamped", False)):
        told = {one.id: one for one in with_type(made, "/vicon/auk", kind).findings}
        for name in ("namespace-twins", "unknown-frame"):
            assert (told[name].severity is Severity.NOTE) is not shown
