"""Tests of faults that readers found in findings about stamps, clocks and arrivals."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, START, Robot, drives, robot, stands
from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.recordings.contract import Publisher


def test_a_sensor_on_the_robot_with_another_clock_is_an_error():
    made = robot(start=136.0, log_from=START)
    made.static("base_link", "imu_link")
    made.start = START
    made.moving("imu_link", "sonar", hz=10)
    made.hears("/distance", "sonar", kind="sensor_msgs/Range")
    assert found(made, "clock-mixture").severity is Severity.ERROR


def test_log_times_with_one_exact_period_on_many_topics_are_no_arrivals():
    made = Robot()
    for number in range(10):
        made.hears(f"/scan{number}", "laser", 0.5, begin=0.1 * number, latency=5.0 + 0.1 * number)
    made.moving("base_link", "laser", 1.0, latency=6.0)
    told = [one.id for one in made.judged().findings]
    assert "stale-stamp" not in told
    made.hears("/points", "laser", 0.7, "sensor_msgs/PointCloud2", latency=5.0)
    assert "stale-stamp" in [one.id for one in made.judged().findings]


def test_a_filter_that_corrects_a_sent_pose_repeats_stamps_without_a_conflict():
    made = robot(odometry=False)
    for tick in range(160):
        at = tick * 0.05
        values = {1: (0.03, 0.0), 3: (0.03, 0.0, 0.0)}.get(tick % 4, (0.0, 0.0))
        for step, value in enumerate(values):
            pose = (0.01 * at + value, 0.0, 0.0, *NO_TURN)
            stamp = made.log(at)
            made.sent("odom", "base_link", at + 0.01 * step, pose, node="/filter", stamp=stamp)
    assert ids(made) == ["repeated-stamp"]


def test_a_recorder_whose_clock_is_behind_all_streams_is_no_offset():
    made = Robot()
    made.moving("odom", "base_link", latency=-0.049)
    made.hears("/odom", "odom", 50.0, "nav_msgs/Odometry", latency=-0.049)
    assert "clock-offset" not in ids(made, notes=True)
    made.moving("map", "odom", 10.0)
    assert "clock-offset" in ids(made, notes=True)


def test_a_late_topic_made_from_one_in_time_names_the_node_between():
    made = robot()
    made.hears("/stable_scan", "laser", 9.0, latency=2.5)
    finding = found(made, "stale-stamp")
    assert "/scan arrives 15 ms after its stamp" in finding.fixes[0].text
    assert "look at the node that makes /stable_scan" in finding.fixes[0].text


def test_a_pause_after_the_first_sample_and_one_before_the_recording_are_no_gaps():
    started = Robot()
    started.sent("world", "drone", 0.0, latency=2.0)
    started.moving("world", "drone", begin=2.0)
    delivered = robot(odometry=False)
    delivered.sent("odom", "base_link", 0.0, latency=4.0)
    delivered.sent("odom", "base_link", 0.02, latency=4.0)
    delivered.moving("odom", "base_link", begin=3.0, without=(3.0, 3.0))
    delivered.heard.clear()
    delivered.messages = [(max(log, delivered.log(3.5)), who) for log, who in delivered.messages]
    for made in (started, delivered):
        assert "gap" not in ids(made)


def test_a_pose_and_its_transform_from_one_node_wait_for_nothing():
    made = robot(scans=False)
    made.moving("odom", "star", 5.0, node="/star")
    made.hears("/pose", "star", 9.0, "geometry_msgs/PoseStamped")
    assert "sensor-outruns-tf" in [one.id for one in made.judged().findings]
    evidence = made.evidence()
    known = (*evidence.publishers, Publisher("/pose", "/star"))
    told = judge(replace(evidence, publishers=known)).findings
    assert "sensor-outruns-tf" not in [one.id for one in told]


def test_repeated_stamps_before_noetic_are_a_note():
    made = Robot(start=1_537_000_000.0, kind="ROS 1 bag")
    for tick in range(160):
        at = 0.05 * (tick - tick % 2)
        x = 0.1 * (tick - tick % 2) + (0.02 if tick in (21, 41, 61, 81) else 0.0)
        made.sent("odom", "base_link", at, (x, 0.0, 0.0, *NO_TURN), latency=0.05 * (tick % 2))
    assert found(made, "repeated-stamp").severity is Severity.NOTE
    assert found(made, "repeated-stamp").count == 80


def test_three_publishers_of_equal_transforms_send_each_three_times():
    made = robot()
    for tick in range(80):
        for copy in range(3):
            pose = (0.0, 0.2, 0.0, *turned(0.1 * tick, 1))
            made.sent("base_link", "wheel", 0.1 * tick, pose, latency=0.004 + 0.0001 * copy)
    assert found(made, "sent-twice").edges == (("base_link", "wheel"),)


def test_transforms_that_end_at_the_very_start_are_told():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=10.0, end=0.6)
    evidence = made.evidence()
    told = judge(replace(evidence, end=evidence.start + 10_000_000_000)).findings
    assert [one.id for one in told] == ["edge-stopped"]


def test_stamps_repeated_with_the_noise_of_numbers_are_not_told():
    for noise, told in ((1e-5, []), (0.01, ["repeated-stamp"])):
        made = robot(odometry=False)
        for tick in range(160):
            at = 0.1 * (tick // 2)
            pose = (0.5 * at + noise * (tick % 2), 0.0, 0.0, *NO_TURN)
            made.sent("odom", "base_link", at, pose, latency=0.005 + 0.05 * (tick % 2))
        assert ids(made) == told


def test_a_frame_without_sensor_data_that_ends_is_no_error():
    for topic, severity in (("", Severity.WARNING), ("/scan", Severity.ERROR)):
        made = robot(scans=bool(topic), odometry=False)
        made.moving("odom", "base_link", end=4.0)
        made.moving("base_link", "arm")
        assert found(made, "edge-stopped").severity is severity


def test_poses_that_wait_for_odometry_are_a_note_and_scans_a_warning():
    for kind, severity in (
        ("geometry_msgs/PoseStamped", Severity.NOTE),
        ("sensor_msgs/LaserScan", Severity.WARNING),
    ):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", 2.0)
        made.hears("/seen", "laser", kind=kind)
        assert found(made, "sensor-outruns-tf").severity is severity


def test_a_small_offset_of_a_sensor_is_a_note():
    for latency, told in ((-0.04, []), (-0.2, ["clock-offset"])):
        made = robot(scans=False)
        made.hears("/imu", "laser", 100.0, "sensor_msgs/Imu", latency=latency)
        assert ids(made) == told
        assert "clock-offset" in ids(made, notes=True)


def test_trees_of_a_very_short_recording_are_a_note():
    for end, told in ((0.5, []), (8.0, ["split-tree"])):
        made = Robot()
        made.moving("odom", "base_link", end=end)
        made.moving("world", "beacon", end=end)
        assert ids(made) == told


def test_a_few_old_samples_are_a_note():
    for times, severity in ((1, Severity.NOTE), (20, Severity.WARNING)):
        made = robot()
        for number in range(times):
            made.sent("odom", "base_link", 5.0, stamp=made.log(-30.0 + 0.1 * number))
        assert found(made, "old-data").severity is severity


def test_nodes_that_end_just_before_the_recorder_did_not_stop():
    for end, told in ((6.5, []), (5.0, ["edge-stopped"])):
        made = robot(odometry=False)
        made.moving("odom", "base_link", end=end)
        assert [one for one in ids(made) if one == "edge-stopped"] == told


def simulated(*, moves: bool, messages: int) -> Robot:
    """Return a simulated robot with a map, and sonar ranges, by the wall clock."""
    made = robot(start=136.0, log_from=START)
    made.clock = [(seconds(136.0 + at), seconds(START + at)) for at in range(9)]
    if not moves:
        made.static("map", "odom")
    made.start = START
    frame = "laser" if moves else "map"
    kind = "sensor_msgs/Range" if moves else "nav_msgs/OccupancyGrid"
    made.hears("/told", frame, 1.0, kind, end=messages)
    return made


def test_a_latched_map_by_the_wall_clock_is_a_note():
    finding = found(simulated(moves=False, messages=1), "clock-mixture")
    assert finding.severity is Severity.NOTE
    assert finding.message == (
        "/told (latched, once) is stamped with the wall clock, all others with the simulation's "
        "clock"
    )
    assert "no lookup" not in finding.consequence


def test_a_sensor_that_moves_by_the_wall_clock_is_an_error_and_a_resting_map_is_none():
    for moves, severity in ((True, Severity.ERROR), (False, Severity.NOTE)):
        finding = found(simulated(moves=moves, messages=6), "clock-mixture")
        assert finding.severity is severity
        assert "latched" not in finding.message


def test_another_static_by_the_wall_clock_is_not_among_all_others():
    made = simulated(moves=True, messages=6)
    made.static("base_link", "camera")
    message = found(made, "clock-mixture").message
    assert "other streams with the simulation's clock" in message


def test_an_offset_that_transforms_share_says_that_the_robots_own_lookups_work():
    for ahead, works in ((0.217, True), (0.0, False)):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", latency=-ahead + 0.001)
        made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu", latency=-0.23)
        finding = found(made, "clock-offset")
        assert ("lookups among the robot's own data work" in finding.consequence) is works
        assert ("230 ms ahead of the recorder's clock" in finding.message) is works


def test_an_offset_that_transforms_share_explains_no_waits():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 4.0, latency=-0.22)
    made.hears("/scan", "laser", latency=-0.25)
    made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu", latency=-0.25)
    assert ids(made) == ["clock-offset", "sensor-outruns-tf"]


def test_the_messages_of_a_start_do_not_outrun_the_transforms():
    for end, told in ((2.8, []), (6.0, ["sensor-outruns-tf"])):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", 2.0)
        made.hears("/scan", "laser", begin=0.5, end=end)
        assert ids(made) == told


def weaves(t: float) -> tuple[float, ...]:
    """Return a pose that a robot has only once."""
    return (0.5 * t, 0.2 * math.sin(t), 0.0, *turned(0.1 * t))


def test_odometry_that_brings_the_poses_of_a_late_transform_in_time_names_its_node():
    for seconds_between, told in ((0.3, ["stale-stamp"]), (0.1, [])):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", 4.0, weaves, latency=seconds_between)
        late = next(rows for key, rows in made.records.items() if key[1] == "base_link")
        made.odometry = Robot()
        for (_, pose, _), at in zip(late, (tick / 4.0 for tick in range(32)), strict=True):
            moment = at + seconds_between
            made.odometry.sent("odom", "base_link", moment, pose, topic="/odom", latency=0.003)
        assert ids(made) == told
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 4.0, weaves, latency=0.3)
    assert ids(made) == []


def test_a_late_transform_with_odometry_in_time_does_not_blame_the_clocks():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 4.0, weaves, latency=0.6)
    made.odometry = Robot()
    for tick in range(32):
        at = 0.25 * tick
        made.odometry.sent("odom", "base_link", at + 0.6, weaves(at), topic="/odom", latency=0.003)
    cure = found(made, "stale-stamp").fixes[0].text
    assert "/odom has the same poses, stamped 600 ms later" in cure
    assert "clocks" not in cure
    # A driver that negates y in one of the two sends the same poses, too.
    for rows in made.odometry.records.values():
        rows[:] = [(stamp, (x, -y, *rest), number) for stamp, (x, y, *rest), number in rows]
    cure = found(made, "stale-stamp").fixes[0].text
    assert "/odom has the same poses (with another sign of y), stamped 600 ms later" in cure


def test_wheels_that_turned_and_then_stay_silent_for_minutes_are_a_warning():
    for end, severity in ((80.0, Severity.WARNING), (20.0, Severity.NOTE)):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", 5.0, end=end)
        made.hears("/scan", "laser", 5.0, end=end)
        for tick in range(50):
            pose = (0.0, 0.2, 0.0, *turned(0.1 * tick, 1))
            made.sent("base_link", "wheel", tick * 0.1, pose)
        assert found(made, "edge-stopped").severity is severity


def test_a_pose_that_stalls_again_and_again_is_a_warning_and_a_few_stalls_are_none():
    def stalls(*edges: tuple[str, str], every: float = 0.5) -> Robot:
        made = robot(odometry=False, scans=False)
        for tick in range(400):
            at = 0.02 * tick
            for edge in edges if at % every > 0.26 else ():
                made.sent(*edge, at, drives(at))
        return made

    pose, arm = ("odom", "base_link"), ("base_link", "arm")
    assert ids(stalls(pose)) == ["gap"]
    assert ids(stalls(pose, every=2.0)) == []
    assert ids(stalls(arm)) == []
    together = found(stalls(pose, arm), "gap")
    assert together.evidence[0].endswith("at the same time: arm in base_link")
    assert "source of all these streams" in together.fixes[0].text
    made = stalls(pose)
    made.moving("base_link", "arm")
    assert "arm in base_link continued" in found(made, "gap").fixes[0].text


def test_a_map_on_the_recorders_clock_is_not_among_all_shifted_stamps():
    for begin, told in ((0.0, "all stamps are"), (1_800_000.0, "most stamps are")):
        made = robot(log_from=START + 1_800_000.0)
        made.hears("/map", "map", 1.0, "nav_msgs/OccupancyGrid", begin=begin, end=begin + 1.0)
        kind, rows = made.heard["/map"]
        made.heard["/map"] = (kind, [(stamp, made.log(1.0), frame) for stamp, _, frame in rows])
        assert found(made, "shifted-clock").message.startswith(told)


def test_a_sensor_in_an_unknown_frame_by_the_wall_clock_is_no_error():
    made = simulated(moves=True, messages=6)
    kind, rows = made.heard["/told"]
    made.heard["/told"] = (kind, [(*row, "nowhere") for *row, _ in rows])
    assert found(made, "clock-mixture").severity is Severity.WARNING


def test_played_data_that_is_over_is_a_note():
    for node, severity in (("/odometry", Severity.WARNING), ("/play_1473819595216", Severity.NOTE)):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", end=0.6, node=node + "038503" * ("play" in node))
        made.hears("/scan", "laser", end=0.6)
        evidence = made.evidence()
        ended = replace(evidence, end=evidence.start + seconds(20.0))
        finding = next(one for one in judge(ended).findings if one.id == "edge-stopped")
        assert finding.severity is severity
        assert ("a player published it" in finding.fixes[0].text) is (severity is Severity.NOTE)
    # If /clock goes on, all other data should go on, too.
    ticks = evidence.start + np.arange(0, 20, dtype=np.int64) * seconds(1.0)
    (finding,) = judge(replace(ended, clock=(ticks, ticks))).findings
    assert (finding.id, finding.severity) == ("edge-stopped", Severity.WARNING)
    assert finding.fixes[0].text.startswith("all data but /clock ends at")


def test_a_transform_that_falls_behind_for_a_time_is_a_warning_beside_data_in_time():
    for late, told in ((0.6, ["stale-stamp"]), (0.2, [])):
        made = robot()
        made.moving("world", "block", end=3.0)
        made.moving("world", "block", begin=3.0, end=4.5, latency=late)
        made.moving("world", "block", begin=4.5)
        assert [one for one in ids(made) if one == "stale-stamp"] == told
        if told:
            finding = found(made, "stale-stamp")
            assert finding.message.startswith("block in world is dated up to 600 ms before")
            assert "/scan, base_link in odom arrived in time" in finding.fixes[0].text


def test_a_backlog_that_arrives_when_the_recorder_starts_is_not_late():
    made = robot()
    kind = "geometry_msgs/PoseStamped"
    made.hears("/pose", "odom", 30.0, kind, latency=0.001)
    assert "stale-stamp" not in ids(made, notes=True)
    for tick in range(26):
        # All messages of the second before the start arrive within 10 ms.
        at = -1.0 + tick / 30.0
        made.hears("/pose", "odom", 30.0, kind, begin=at, end=at + 0.03, latency=0.01 - at)
    assert "stale-stamp" not in ids(made, notes=True)


def test_two_values_of_a_static_that_arrive_together_are_kept_by_arrival():
    for apart, consequence in ((0.01, "reaches it last"), (3.0, "when the new value arrives")):
        made = robot()
        made.static("base_link", "camera")
        made.static("base_link", "camera", (0.2, 0.0, 0.2, *NO_TURN), at=apart)
        assert consequence in found(made, "static-changed").consequence


def corrections(ahead: float) -> Robot:
    """Return a robot whose localiser, with a clock that is ahead, turns odom four times by 10°.

    The robot drives along x for 4 s at 3 m/s, and back to the origin of odom.
    """
    made = robot(odometry=False)
    made.moving(
        "odom", "base_link", 50.0, lambda t: (12.0 - abs(12.0 - 3.0 * t), 0.0, 0.0, *NO_TURN)
    )
    for tick in range(80):
        pose = (0.0, 0.0, 0.0, *turned(0.1745 * min(tick // 19, 4)))
        made.sent("map", "odom", 0.1 * tick + ahead, pose, latency=0.01 - ahead)
    return made


def test_steps_of_a_localiser_are_measured_where_the_robot_is_when_they_arrive():
    for ahead in (0.0, 3.0):
        finding = found(corrections(ahead), "teleport")
        # 10° are 0.1745 rad; at 3.8 s the robot is 11.4 m from the origin.
        assert finding.facts["jump"] == pytest.approx(0.1745 * 11.4, abs=0.05)
        assert finding.count == 3


@pytest.mark.parametrize(
    ("at", "length", "pause", "asked", "told"),
    [
        (12.0, 2.5, 0.1, -1.0, True),
        (8.0, 2.5, 0.1, -1.0, False),  # too soon after the start
        (12.0, 1.9, 0.1, -1.0, False),
        (12.0, 2.5, 1.0, -1.0, False),  # after a gap
        (12.0, 2.5, 0.1, 11.0, False),  # a user sets the pose
        (12.0, 2.5, 0.1, 2.0, True),
    ],
)
def test_one_long_step_of_a_steady_localiser_is_a_teleport(at, length, pause, asked, told):
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=20.0)
    for tick in range(200):
        x = length if 0.1 * tick >= at else 0.2 * ((tick // 30 + 1) % 2)
        if not at - pause + 0.05 < 0.1 * tick < at - 0.05:
            made.sent("map", "odom", 0.1 * tick, (x, 0.0, 0.0, *NO_TURN))
    if asked > 0.0:
        kind = "geometry_msgs/PoseWithCovarianceStamped"
        made.hears("/initialpose", "map", 1.0, kind, begin=asked, end=asked + 1.0)
    assert ("teleport" in ids(made)) is told
    if told:
        finding = found(made, "teleport")
        assert finding.message == "odom in map jumps 2.50 m, after 11.90 s without a step of 0.5 m"


def test_a_change_between_two_clocks_is_no_step_of_a_localiser():
    made = robot()
    for tick in range(20):
        for ahead, x in ((0.0, 0.0), (-6e5, 9.0)):
            pose = (x, 0.0, 0.0, *NO_TURN)
            made.sent("map", "odom", 0.4 * tick + ahead, pose, latency=0.01 - ahead)
    assert "teleport" not in ids(made, notes=True)


def test_of_two_sources_whose_stamps_are_hours_apart_tf2_keeps_one():
    made = robot(odometry=False)
    for node, x, behind in (("/new", 0.0, 0.0), ("/old", 2.0, 20_000.0)):
        pose = (x, 0.0, 0.0, *NO_TURN)
        for tick in range(160):
            at = 0.05 * tick - behind
            made.sent("odom", "base_link", at, pose, latency=0.01 + behind, node=node)
    finding = found(made, "publisher-conflict")
    assert finding.consequence == (
        "tf2 keeps the samples of /new, and refuses the samples of /old as too old"
    )


def test_no_rate_is_offered_that_only_makes_up_for_late_transforms():
    for late, told in ((0.04, True), (0.095, False)):
        made = robot(odometry=False)
        made.moving("odom", "base_link", hz=8.0, latency=late)
        made.hears("/points", "laser", kind="sensor_msgs/PointCloud2", latency=0.0)
        texts = [fix.text for fix in found(made, "sensor-outruns-tf").fixes]
        assert any("Hz or more" in text for text in texts) is told


def test_no_rate_is_offered_if_the_network_holds_transforms_back():
    for held, told in ((0.0, True), (0.5, False)):
        made = robot(odometry=False)
        for tick in range(40):
            # The transform is sent at 5 Hz, and one message of ten is delayed.
            late = held if tick % 10 == 9 else 0.0
            at = 0.2 * tick
            made.sent("odom", "base_link", at, drives(at), latency=0.03 + late)
        texts = [fix.text for fix in found(made, "sensor-outruns-tf").fixes]
        assert any("Hz or more" in text for text in texts) is told


def test_a_rate_or_a_static_is_offered_only_if_no_other_transform_is_as_late():
    for is_odometry_late in (True, False):
        made = robot(odometry=not is_odometry_late, laser=False)
        if is_odometry_late:
            made.moving("odom", "base_link", 5.0, latency=0.1)
        made.moving("base_link", "laser", 5.0, stands, latency=0.05)
        fixes = [fix.text for fix in found(made, "sensor-outruns-tf").fixes]
        assert any("/tf_static" in fix for fix in fixes) is not is_odometry_late
        if is_odometry_late:
            # Both transforms are sent at 5 Hz, so a higher rate of one of them changes nothing.
            assert len(fixes) == 1


def test_a_single_sample_in_a_recording_of_less_than_a_second_is_a_note():
    for end, severity in ((0.5, Severity.NOTE), (8.0, Severity.WARNING)):
        made = Robot()
        made.moving("odom", "base_link", end=end)
        made.sent("base_link", "cube", 0.1)
        made.hears("/scan", "cube", end=end)
        assert found(made, "single-sample").severity is severity


def test_lost_samples_of_a_fast_transform_are_a_note():
    for hz, severity in ((500.0, Severity.NOTE), (20.0, Severity.WARNING)):
        made = Robot()
        for tick in range(600):
            # Every tenth sample and the next one are lost, while the robot turns by 5° a sample.
            if tick % 10 > 1:
                at = tick / hz
                pose = (0.0, 0.0, 0.0, *turned(math.radians(5.0 * tick)))
                made.sent("odom", "base_link", at, pose)
        assert found(made, "gap").severity is severity


def corrected_robot(node: str) -> Robot:
    """Return a robot of ROS 1 whose first pose for each stamp is wrong."""
    made = robot(odometry=False)
    made.kind = "ROS 1 bag"
    for tick in range(160):
        at = tick * 0.05
        for step, wrong in enumerate((0.04 if tick % 4 == 1 else 0.0, 0.0, 0.0)):
            pose = (0.01 * at + wrong, 0.0, 0.0, *NO_TURN)
            made.sent("odom", "base_link", at + 0.01 * step, pose, node=node, stamp=made.log(at))
    return made


def test_one_connection_for_the_transforms_of_several_nodes_names_no_publisher():
    for ahead, nodes in ((0.1, ()), (0.0, ("/first",))):
        made = corrected_robot("/first")
        made.moving("base_link", "camera", 10, stands, offset=ahead, node="/first")
        finding = found(made, "repeated-stamp")
        assert finding.publishers == nodes
        assert ("sent by" in finding.evidence[0]) is bool(nodes)


def test_a_played_recording_names_no_publisher():
    assert found(corrected_robot("/play_1700000000000000000"), "repeated-stamp").publishers == ()
    made = robot()
    made.hears("/points", "", kind="sensor_msgs/PointCloud2")
    for node, named in (("/driver", True), ("/play_1700000000000000000", False)):
        evidence = made.evidence()
        evidence = replace(evidence, publishers=(*evidence.publishers, Publisher("/points", node)))
        (empty,) = [one for one in judge(evidence).findings if one.id == "empty-frame"]
        assert (node in empty.fixes[0].text) is named


def test_repeated_stamps_tell_how_far_the_values_differ_and_which_jumps_they_cause():
    told = found(corrected_robot("/filter"), "repeated-stamp").evidence[0]
    assert "40 of them with a value that differs by more than 1 mm" in told
    assert "at most 40 mm" in told
    assert "out and back by 10 mm or more 40 times, with the last one 0 times" in told


def test_a_sensor_whose_messages_all_have_stamp_0_is_reported():
    made = robot()
    made.hears("/imu", "laser", kind="sensor_msgs/Imu")
    kind, rows = made.heard["/imu"]
    made.heard["/imu"] = (kind, [(0, *row) for _, *row in rows])
    finding = found(made, "zero-stamp")
    assert (finding.topics, finding.severity) == (("/imu",), Severity.WARNING)
    made.heard["/imu"] = (kind, [(0, log, "elsewhere") for _, log, _ in rows])
    assert found(made, "zero-stamp").severity is Severity.NOTE


def test_the_streams_that_agree_with_the_recorder_are_right_whatever_their_number():
    made = Robot(log_from=START + 1e6)
    made.moving("odom", "base_link")
    made.moving("base_link", "arm", pose=lambda t: (0.1 * t, 0.0, 0.0, *NO_TURN))
    made.static("base_link", "imu_link")
    made.hears("/joint", "arm", kind="sensor_msgs/Imu")
    made.start = START + 1e6
    made.hears("/imu", "imu_link", 50.0, "sensor_msgs/Imu")
    finding = found(made, "clock-offset")
    assert finding.message == (
        "base_link in odom, arm in base_link, /joint are 11.6 days behind the recorder's clock, "
        "with which /imu agrees"
    )
    assert "/imu: 20 ms, " in finding.evidence[0]
    assert "that needs a moving transform" in finding.consequence


def test_publishers_with_two_clocks_are_compared_with_the_recorders_clock():
    made = robot(odometry=False, scans=False)
    for node, ahead in (("/camera", 0.0), ("/filter", 3600.0)):
        pose = (ahead / 100, 0.0, 0.0, *NO_TURN)
        for tick in range(400):
            at = tick * 0.02
            made.sent("odom", "base_link", at + ahead, pose, latency=0.005 - ahead, node=node)
    for topic in ("/imu", "/fix", "/points"):
        made.hears(
            topic, "laser", 10.0, "sensor_msgs/Imu", begin=3600.0, end=3608.0, latency=-3600.0
        )
    evidence = found(made, "publisher-conflict").evidence[0]
    assert "arriving 5 ms after and 60 minutes before their stamps" in evidence
