"""Tests of faults that a reader found in the doctor's findings on public recordings."""

import math
from dataclasses import replace

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, START, Robot, robot
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.recordings.contract import Publisher


def test_a_real_sensor_beside_a_simulated_robot_is_one_warning():
    made = robot(start=136.0, log_from=START)
    made.start = START
    made.moving("imu_link", "sonar", hz=10)
    made.hears("/distance", "sonar", kind="sensor_msgs/Range")
    assert ids(made) == ["clock-mixture"]
    assert found(made, "clock-mixture").severity is Severity.WARNING
    assert found(made, "split-tree").because_of == "clock-mixture"


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


def test_a_robot_that_tf_does_not_know_is_not_a_missing_static():
    for frames, unknown in ((("map", "odom"), "scan"), (("world", "drone"), "cf1/base_link")):
        made = Robot()
        made.moving(*frames)
        made.hears("/scan", unknown)
        assert ids(made) == ["unknown-frame"]
        fixes = found(made, "unknown-frame").fixes
        assert not any("static" in fix.text + fix.command for fix in fixes)


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


def test_a_wheel_that_turns_more_than_once_per_sample_has_one_source():
    made = robot()
    angle = 0.0
    for tick in range(160):
        angle += 1.5 if tick % 2 else 2.0 * math.pi - 1.4
        made.sent("base_link", "wheel", tick * 0.05, (0.0, 0.2, 0.0, *turned(angle, 1)))
    assert "publisher-conflict" in ids(made)
    made.hears("/joint_states", "", kind="sensor_msgs/JointState")
    evidence = made.evidence()
    known = (*evidence.publishers, Publisher("/joint_states", "/gazebo"))
    told = judge(replace(evidence, publishers=known)).findings
    assert "publisher-conflict" not in [one.id for one in told]
