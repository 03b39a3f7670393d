"""Tests of remedies with the commands of the recording's ROS version."""

import re

import pytest

from tests.doctor.corpus import FAULTS, REENACTED, made_by
from tests.doctor.judged import found
from tests.doctor.robots import robot
from tftool.doctor.judge import judge
from tftool.doctor.missing_joins import static_publisher
from tftool.drawing import finding_view
from tftool.geometry.rigid import Transform

ROS2_ONLY = re.compile(
    r"ros2 |--ros-args|get_clock|rclpy|humble|--frame-id|lifecycle|QoS|transient_local|sim_time: "
    r"|Duration\(seconds"
)


@pytest.mark.parametrize("case", [*FAULTS, *REENACTED], ids=lambda case: case.name)
def test_remedies_for_a_bag_of_ros_1_name_nothing_of_ros_2(case):
    made = made_by(case, 1)
    made.kind = "ROS 1 bag"

    for finding in judge(made.evidence()).findings:
        told = [finding.message, finding.consequence]
        told += [f"{fix.text} {fix.command}" for fix in finding.fixes]
        assert not ROS2_ONLY.search(" ".join(told)), finding.id


def test_a_mount_is_published_by_the_command_of_the_recordings_ros():
    made = robot()
    made.static("base", "camera")
    made.hears("/imu", "imu", kind="sensor_msgs/Imu")
    commands = [fix.command for fix in found(made, "unknown-frame").fixes]
    assert commands[-1].startswith("ros2 run tf2_ros static_transform_publisher --x X")

    made.kind = "ROS 1 bag"
    commands = [fix.command for fix in found(made, "unknown-frame").fixes]
    assert commands[-1].endswith("static_transform_publisher X Y Z YAW PITCH ROLL base_link imu")
    assert commands[-1].startswith("rosrun tf2_ros ")

    pose = Transform((1.0, 2.0, -0.5), (0.0, 0.0, 0.6, 0.8))
    command = static_publisher("a", "b", pose, ros1=True)
    assert command == "rosrun tf2_ros static_transform_publisher 1 2 -0.5 0 0 0.6 0.8 a b"


def test_the_page_of_checks_tells_the_words_of_both():
    page = finding_view.as_page()
    assert "ros2 topic info --verbose (ROS 1: rostopic info)" in page.replace("\\", "")
