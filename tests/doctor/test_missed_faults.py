"""Tests of faults in public recordings that a reader of the data found before the doctor did."""

import numpy as np
import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, START, Pose, Robot, drives, robot, stands
from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity
from tftool.doctor.model import Model


@pytest.mark.parametrize(("speed", "told"), [(4.5, ["gap"]), (1.0, [])])
def test_a_short_gap_of_motion_capture_across_a_large_turn_is_told(speed, told):
    made = Robot()
    made.moving(
        "world", "drone", 60.0, lambda t: (0.5 * t, 0.0, 1.0, *turned(speed * t)), without=(3, 3.3)
    )
    assert ids(made) == told
    if told:
        # The gap is from 2.983 s to 3.3 s.
        assert "across the gap: 81.6° and 0.16 m" in found(made, "gap").evidence[0]


@pytest.mark.parametrize(("begin", "told"), [(0.4, ["gap"]), (0.1, [])])
def test_a_gap_in_the_first_second_is_told_after_ten_samples(begin, told):
    def turns(t: float) -> Pose:
        return (0.5 * t, 0.0, 1.0, *turned(4.5 * t))

    made = Robot()
    made.moving("world", "drone", 60.0, turns, without=(begin, begin + 0.3))
    assert ids(made) == told
    # A log that pauses is no evidence of a gap.
    made.hears("/rosout", "", 20.0, "rosgraph_msgs/Log", end=8.0)
    made.hears("/rosout", "", 20.0, "rosgraph_msgs/Log", begin=8.3, end=12.0)
    # The second gap is from 8 s to 8.3 s.
    made.moving("world", "drone", 60.0, turns, begin=8.3, end=12.0)
    assert found(made, "gap").evidence[0].endswith("; one of 2 gaps above 250 ms, 633 ms in all")


@pytest.mark.parametrize(
    ("speed", "severity"), [(3.0, Severity.WARNING), (0.3, Severity.WARNING), (0.1, Severity.NOTE)]
)
def test_samples_that_are_missing_one_by_one_are_counted(speed, severity):
    made = Robot()
    for tick in range(200):
        if tick % 10 and tick not in (101, 102):
            pose = (0.0, 0.0, 0.0, *turned(speed * 0.2 * tick))
            made.sent("imu", "sonar", 0.2 * tick, pose)
    finding = found(made, "gap")
    assert finding.severity is severity
    # The first sample is missing before the recording: 21 of 199.
    assert finding.message.endswith(": 10.6 % of its samples are missing, up to 3 in a row")


def test_the_share_of_missing_samples_counts_the_first_sample():
    made = Robot()
    for tick in range(120):
        if tick % 5 or not tick:
            made.sent("imu", "sonar", 0.2 * tick, (0.0, 0.0, 0.0, *turned(0.6 * tick)))
    # 23 of 120 are 19.17 %.
    assert ": 19.2 % of its samples are missing" in found(made, "gap").message


def test_a_robot_far_from_the_origin_of_odom_does_not_move_when_odom_turns_about_it():
    made = Robot()
    made.moving("odom", "base_link", 50.0, lambda t: (100.0, 0.0, 0.0, *NO_TURN), end=40.0)
    for tick in range(200):
        if tick % 9:
            angle = 0.05 * tick
            turn = (100.0 * (1.0 - np.cos(angle)), -100.0 * np.sin(angle), 0.0, *turned(angle))
            made.sent("map", "odom", 0.2 * tick, turn)
    assert "across the gap: 5.73° and 0 mm" in found(made, "gap").evidence[0]


@pytest.mark.parametrize("number", [0, 5, 40])
def test_commands_that_go_on_show_that_all_transforms_stopped_too_early(number):
    made = robot()
    made.hears("/log", "", kind="rosgraph_msgs/Log", end=12.0)
    made.commands["/cmd_vel"] = [made.log(0.1 * tick) for tick in range(80 + number)]
    assert ids(made, notes=True) == ["edge-stopped"] * (number == 40)
    if number == 40:
        told = found(made, "edge-stopped")
        assert told.severity is Severity.WARNING
        assert "; /cmd_vel goes on for 3.92 s (40 messages)" in told.evidence[0]


def test_other_messages_that_go_on_after_all_transforms_are_counted():
    made = robot()
    made.hears("/points", "base_link", kind="sensor_msgs/PointCloud2", end=12.0)
    told = found(made, "edge-stopped")
    assert told.severity is Severity.WARNING
    assert "; /points goes on for 3.93 s (40 messages)" in told.evidence[0]


@pytest.mark.parametrize("ends", [1.9, 8.0])
def test_commands_that_end_with_all_transforms_show_that_the_robot_stopped(ends):
    made = Robot()
    made.moving("odom", "base_link", end=2.0)
    made.hears("/imu", "imu", 50.0, "sensor_msgs/Imu", end=60.0)
    made.commands["/cmd_vel"] = [made.log(0.1 * tick) for tick in range(round(10 * ends) + 1)]
    finding = found(made, "edge-stopped")
    is_robot = ends < 2.0
    assert finding.evidence[0].endswith("; /cmd_vel ends at the same time") is is_robot
    assert ("its connection" in finding.fixes[0].text) is is_robot


@pytest.mark.parametrize(
    ("later", "severity"),
    [
        ("constants", Severity.NOTE),
        ("commands", Severity.WARNING),
        ("scans", Severity.ERROR),
    ],
)
def test_a_robot_that_was_shut_down_before_its_recorder_is_a_note(later, severity):
    made = robot()
    made.moving("base_link", "arm", 10.0, stands, end=12.0)
    if later == "commands":
        made.commands["/cmd_vel"] = [made.log(0.1 * tick) for tick in range(120)]
    if later == "scans":
        made.hears("/scan", "laser", begin=8.0, end=12.0)
    assert found(made, "edge-stopped").severity is severity


def test_all_gaps_of_a_robots_pose_are_counted():
    made = robot(odometry=False)
    for begin, end in ((0.0, 2.0), (3.5, 5.0), (7.0, 8.0)):
        made.moving("odom", "base_link", begin=begin, end=end)
    finding = found(made, "gap")
    assert finding.count == 2
    assert "the longest of 2 gaps above 500 ms, 3.54 s in all" in finding.evidence[0]
    assert finding.fixes


@pytest.mark.parametrize(("number", "every", "told"), [(5, 0.5, 1), (4, 0.5, 0), (5, 0.8, 0)])
def test_short_gaps_that_take_up_most_of_some_seconds_are_told(number, every, told):
    made = Robot()
    made.moving("odom", "base_link", end=5.0)
    for gap in range(number):
        # The last sample is 0.02 s before 5 s. Each gap of 0.3 s ends with some samples.
        begin = 4.98 + every * gap + 0.3
        made.moving("odom", "base_link", begin=begin, end=begin + every - 0.28)
    assert ids(made) == ["gap"] * told
    if told:
        evidence = found(made, "gap").evidence[0]
        assert f"the longest of {number} gaps above 200 ms, 1.50 s in all" in evidence


def test_irregular_samples_are_not_counted_as_missing():
    made = Robot()
    at, random = 0.0, np.random.default_rng(1)
    for tick in range(200):
        at += float(random.uniform(0.1, 0.3))
        made.sent("imu", "sonar", at, (0.0, 0.0, 0.0, *turned(0.5 * tick)))
    assert "gap" not in ids(made, notes=True)


def test_two_publishers_are_given_with_the_rates_of_all_their_samples():
    made = robot()
    made.moving("leg", "foot", 20.0, stands, node="/slow")
    made.moving("leg", "foot", 100.0, lambda t: (0.5, 0.0, 0.0, *NO_TURN), node="/fast")
    finding = found(made, "publisher-conflict")
    assert finding.message == ("foot in leg has two sources with different values: /slow and /fast")
    assert "20 and 100 Hz" in finding.evidence[0]


def twice(apart: float, speed: float = 0.0, copies: int = 2) -> Robot:
    """Return a robot whose software runs twice, with odometry that differs by some metres."""
    made = robot(odometry=False)
    for tick in range(80):
        for copy in range(2):
            at = 0.1 * tick + 0.04 * copy
            x = speed * at + 0.0001 * (tick % 3)
            made.sent("odom", "base_link", at, (x + apart * copy, 0.0, 0.0, *NO_TURN))
        for _ in range(copies):
            made.sent("base_link", "arm", 0.1 * tick, (0.0, 0.0, 0.3, *turned(0.01 * tick)))
    return made


@pytest.mark.parametrize(
    ("apart", "speed", "told"), [(0.03, 0.0, 1), (0.004, 0.0, 0), (0.03, 0.5, 0)]
)
def test_two_tracks_of_a_robot_that_rests_may_be_near_each_other(apart, speed, told):
    assert ids(twice(apart, speed)) == ["publisher-conflict"] * told


@pytest.mark.parametrize("copies", [1, 2])
def test_other_transforms_that_are_sent_twice_suggest_a_second_start(copies):
    finding = found(twice(0.03, copies=copies), "publisher-conflict")
    assert finding.message == "base_link in odom has two different values, which alternate"
    is_told = "arm in base_link: sent twice, with equal values" in finding.evidence[0]
    assert is_told is (copies == 2)
    assert ("started twice" in finding.fixes[-1].text) is (copies == 2)


def test_two_nodes_with_two_constant_poses_of_a_frame_are_told():
    for apart, told in ((0.0025, ["publisher-conflict"]), (0.0002, [])):
        made = robot()

        def poses(z: float):
            def pose(_t: float) -> Pose:
                return (0.0, 0.0, z, *NO_TURN)

            return pose

        made.moving("leg", "foot", pose=poses(-0.069), offset=0.486, node="/state_publisher")
        made.moving("leg", "foot", pose=poses(-0.069 + apart), node="/bridge")
        made.moving("odom", "leg", node="/bridge")
        assert ids(made) == told
        if told:
            finding = found(made, "publisher-conflict")
            assert finding.severity is Severity.WARNING
            assert "latencies -481 ms and 5 ms, 2.5 mm and 0° apart" in finding.evidence[0]


def test_poses_that_come_late_in_bursts_are_a_warning_beside_data_in_time():
    for late, told in ((1.0, ["stale-stamp"]), (0.1, [])):
        made = robot()
        for topic, longer in (("/robot_1", 0.0), ("/robot_2", 0.05)):
            for begin, end, latency in ((0, 4, 0.009), (4, 4.6, late + longer), (4.6, 8, 0.009)):
                kind = "geometry_msgs/PoseStamped"
                made.hears(topic, "odom", 50.0, kind, begin=begin, end=end, latency=latency)
        assert ids(made) == told
        if told:
            finding = found(made, "stale-stamp")
            assert finding.message == (
                "/robot_2, /robot_1 are dated up to 1.05 s before their arrival"
            )
            assert "arrived in time" in finding.fixes[0].text


@pytest.mark.parametrize(("wait", "told"), [(0.094, ["sensor-outruns-tf"]), (0.084, [])])
def test_scans_that_all_wait_for_a_listeners_usual_timeout_are_a_warning(wait, told):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", latency=0.015 + wait)
    made.hears("/scan", "laser")
    assert ids(made) == told


def test_constants_that_ros_1_dates_ahead_do_not_tell_a_shifted_clock():
    made = Robot(log_from=START + 7e7, kind="ROS 1 bag")
    for child in ("odom", "laser", "camera"):
        made.moving("map", child, 20.0, stands, offset=0.05, latency=0.0)
    made.moving("odom", "base_link", latency=0.5)
    made.hears("/odom", "odom", 50.0, "nav_msgs/Odometry", latency=0.002)
    shift = Model(made.evidence()).shift
    assert shift is not None
    assert shift.by == seconds(7e7) + seconds(0.002)


def test_only_topics_with_messages_before_and_after_a_gap_have_the_same_gap():
    made = Robot()
    made.moving("world", "drone", without=(3.0, 4.5))
    made.moving("world", "drone", begin=8.0, end=12.0)
    for topic, begins, ends in (
        ("/pose", (0.0, 4.5), (3.0, 8.0)),
        ("/state", (0.1,), (0.2,)),
        ("/ended", (0.0,), (3.0,)),
    ):
        for begin, end in zip(begins, ends, strict=True):
            made.hears(topic, "world", 10.0, "geometry_msgs/PoseStamped", begin=begin, end=end)
    assert found(made, "gap").evidence[0].endswith("; at the same time: /pose")


@pytest.mark.parametrize(
    ("hz", "end", "told"),
    [
        (5.0, 60.0, "; /nmea goes on for 19.81 s (100 messages)"),
        (0.5, 60.0, ""),
        (0.5, 50.0, ""),
    ],
)
def test_a_source_that_stops_with_its_transform_is_named(hz, end, told):
    made = robot(odometry=False, laser=False, scans=False)
    made.moving("world", "gps", hz=1.0, end=41.0)
    made.hears("/fix", "gps", 1.0, "sensor_msgs/NavSatFix", end=41.0 if end == 60.0 else 50.0)
    made.hears("/nmea", "gps", 5.0, "nmea_msgs/Sentence", end=40.0)
    made.hears("/nmea", "gps", hz, "nmea_msgs/Sentence", begin=40.0, end=60.0)
    made.hears("/time", "gps", 0.2, "sensor_msgs/TimeReference", end=60.0)
    finding = found(made, "edge-stopped")
    assert ("/fix, which has the same stamps" in finding.fixes[0].text) is (end == 60.0)
    assert finding.evidence[0].endswith(f"came every 1.00 s{told}")


@pytest.mark.parametrize(("hz", "told"), [(50.0, True), (5.0, False)])
def test_empty_messages_in_a_gap_show_that_the_publisher_went_on(hz, told):
    made = Robot()
    made.moving("world", "drone", without=(3.0, 4.5), node="/vicon")
    for tick in range(round(1.4 * hz)):
        made.messages.append((made.log(3.05 + tick / hz), 0))
    finding = found(made, "gap")
    assert ("; its publisher sent 70 messages without a transform" in finding.evidence[0]) is told
    assert ("continued without a pose" in finding.fixes[0].text) is told


@pytest.mark.parametrize(
    ("sent", "late", "missing", "told"),
    [
        (
            False,
            False,
            False,
            "arm in base_link, leg in base_link continued: look at the publisher",
        ),
        (True, False, False, "the samples were lost on the way"),
        (False, True, False, "look at the load, at the network"),
        (False, False, True, "look at the load, at the network"),
    ],
)
def test_a_publisher_is_named_only_if_nothing_else_can_have_lost_its_samples(
    sent, late, missing, told
):
    made = robot(scans=False)
    made.records[("odom", "base_link", False)].clear()
    for tick in range(400):
        at = 0.02 * tick
        is_out = 3.0 <= at < 4.5
        is_held_up = late and 4.5 <= at < 4.6
        for child in () if missing and is_out and tick % 3 == 0 else ("arm", "leg"):
            made.sent("base_link", child, at, drives(at))
        if not is_out:
            latency = 0.3 if is_held_up else 0.005
            made.sent("odom", "base_link", at, drives(at), latency=latency)
    if sent:
        made.odometry = Robot()
        made.odometry.moving("odom", "base_link", topic="/odom")
    finding = found(made, "gap")
    assert finding.fixes[0].text.startswith(told)
    assert ("/odom, which has the same stamps, has 75 messages" in finding.evidence[0]) is sent
    assert ("295 ms later than usual" in finding.evidence[0]) is late
    assert ("samples of arm in base_link, leg in base_link are" in finding.evidence[0]) is missing


def test_a_topic_with_nearly_all_holes_of_an_edge_is_named():
    made = Robot()
    for tick in range(300):
        if tick % 11:
            made.sent("imu", "sonar", 0.1 * tick, (0.0, 0.0, 0.0, *turned(0.5 * tick)))
            made.hears(
                "/imu", "imu", kind="sensor_msgs/Imu", begin=0.1 * tick, end=0.1 * tick + 0.1
            )
    made.hears("/image", "imu", kind="sensor_msgs/Image", end=30.0)
    # A topic as slow as the holes are long has no messages in them by chance.
    made.hears("/status", "imu", 1.0, "sensor_msgs/Imu", begin=0.55, end=30.55)
    assert found(made, "gap").evidence[0].endswith("; at the same time: /imu")


def jumps_back_after(pause: float, *, resumes: bool = False) -> Robot:
    """Return a robot that is silent before its time jumps back, except for one message."""
    made = Robot()
    made.hears("/map", "odom", end=4.0)
    made.moving("odom", "base_link", end=4.0)
    made.hears("/map", "odom", begin=4.0 + pause, end=4.05 + pause)
    again = made.start
    for tick in range(200):
        at, stamp = 4.1 + pause + 0.02 * tick, seconds(again + 0.02 * tick)
        made.sent("odom", "base_link", at, stamp=stamp)
        made.heard["/map"][1].append((stamp, made.log(at), "odom"))
    if resumes:
        made.hears("/scan", "base_link", begin=0.0, end=4.0 + pause)
    return made


@pytest.mark.parametrize("resumes", [False, True])
def test_a_pause_of_everything_before_a_jump_is_no_end_of_a_transform(resumes):
    made = jumps_back_after(100.0, resumes=resumes)
    assert ("edge-stopped" in ids(made, notes=True)) is resumes
    made.static("odom", "dock", at=103.7)  # as from a player that begins
    told = "no moving transform and no message with a header arrived for 100.1"
    assert (told in found(made, "time-jump-back").evidence[0]) is not resumes


@pytest.mark.parametrize(("at", "told"), [(5.5, True), (3.0, False)])
def test_new_static_transforms_in_an_outage_show_that_programs_were_started_again(at, told):
    made = Robot()
    made.static("base_link", "laser")
    for begin, end in ((0.0, 4.0), (7.0, 12.0)):
        made.moving("odom", "base_link", begin=begin, end=end)
        made.hears("/scan", "laser", begin=begin, end=end)
    made.static("base_link", "laser", at=at)
    finding = found(made, "outage")
    assert ("/tf_static was sent again, with a new stamp" in finding.evidence[0]) is told
    assert ("network" in finding.fixes[0].text) is not told


@pytest.mark.parametrize(("hz", "told"), [(50.0, 1), (0.0, 0)])
def test_two_sources_for_a_short_time_are_told_if_more_samples_come(hz, told):
    made = Robot()
    made.static("base_link", "laser")
    for tick in range(3000):
        at = 0.02 * tick
        brief = 30.0 < at < 31.2
        # Without a second source, the pose of the one source flickers.
        x = 0.6 * (brief and not hz and tick % 2)
        made.sent("map", "base_link", at, (0.3 * at + x, 0.0, 0.0, *NO_TURN))
        if brief and hz:
            made.sent("map", "base_link", at + 0.008, (0.3 * at + 0.6, 0.4, 0.0, *NO_TURN))
    assert ids(made).count("publisher-conflict") == told
    if told:
        finding = found(made, "publisher-conflict")
        assert "only for 1.18 s from" in finding.evidence[0]
        assert "an earlier start" in finding.fixes[0].text
