"""Tests of robot_state_publisher and joint_state_publisher in launch files and `tftool run`."""

import pytest

from tests.ros.tutorial import launch, start
from tests.world.nodes.test_joints import FIXED
from tftool.base.errors import InputError, UsageError

LAUNCH = """
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description():
    text = {text}
    return LaunchDescription([
        Node(
            package="robot_state_publisher", executable="robot_state_publisher",
            parameters=[{{"robot_description": text, "frame_prefix": "left/"}}],
        ),
        Node(
            package="joint_state_publisher", executable="joint_state_publisher",
            parameters=[{{"rate": 20, "zeros": {{"turn": 0.5}}}}],
        ),
        Node(executable={program!r}, name="asker"),
    ])
"""

ASKER = """
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from tf2_ros import Buffer, TransformListener


class Asker(Node):
    def __init__(self):
        super().__init__("asker")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, "robot_description", self.hear, latched)
        self.create_timer(1.0, self.ask)

    def hear(self, message):
        self.get_logger().info(f"described: {len(message.data)}")

    def ask(self):
        for source in ("boom", "plate"):
            found = self.buffer.lookup_transform("left/base", f"left/{source}", rclpy.time.Time())
            turn, place = found.transform.rotation, found.transform.translation
            self.get_logger().info(f"{source}: {place.z:.1f} {turn.z:.4f}")


rclpy.init()
rclpy.spin(Asker())
"""


@pytest.fixture
def launched(tmp_path):
    """Launch both nodes with the given description, and a node that looks frames up."""

    def run(text):
        program = tmp_path / "asker.py"
        program.write_text(ASKER)
        file = tmp_path / "robot.launch.py"
        file.write_text(LAUNCH.format(text=text, program=str(program)))
        return launch(file, seconds=1.5, start=tmp_path)

    return run


def test_a_launch_file_brings_a_robot_up(launched):
    done = launched(repr(FIXED))

    assert done.failed == []
    assert done.texts("asker") == [
        f"described: {len(FIXED)}",
        "boom: 2.0 0.2474",
        "plate: 3.0 0.0000",
    ]


def test_a_launch_file_expands_xacro_without_ros(launched, tmp_path):
    pytest.importorskip("xacrodoc")
    path = tmp_path / "crane.urdf.xacro"
    path.write_text(
        FIXED.replace(
            '<robot name="crane">',
            '<robot name="crane" xmlns:xacro="http://www.ros.org/wiki/xacro">'
            '<xacro:arg name="height" default="3"/>',
        ).replace("1 2 3", "1 2 $(arg height)")
    )

    done = launched(
        f'ParameterValue(Command(["xacro ", {str(path)!r}, " height:=4"]), value_type=str)'
    )

    assert done.failed == []
    assert done.texts("asker")[1:] == ["boom: 2.0 0.2474", "plate: 4.0 0.0000"]


def begin(runtime, package, *words):
    return runtime.ask(lambda: start(runtime.world, package, *words, package=package))


def test_a_file_may_be_the_argument(ros_runtime, tmp_path):
    path = tmp_path / "crane.urdf"
    path.write_text(FIXED)
    begin(ros_runtime, "robot_state_publisher", path.as_posix())
    ros_runtime.sleep(0.1)

    found = ros_runtime.world.buffer.lookup_transform("base", "plate")
    assert found.transform.translation == (1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ("package", "words", "error", "told"),
    [
        ("robot_state_publisher", [], UsageError, "needs the parameter robot_description"),
        ("robot_state_publisher", ["none.urdf"], InputError, "cannot read 'none.urdf'"),
        (
            "robot_state_publisher",
            ["--ros-args", "-p", "robot_description:=<robot/>"],
            InputError,
            "robot_description of robot_state_publisher:1:1",
        ),
        (
            "joint_state_publisher",
            ["--ros-args", "-p", "rate:=fast"],
            UsageError,
            "parameter 'rate' must be a number, not 'fast'",
        ),
        ("joint_state_publisher", ["--ros-args", "-p", "rate:=0"], UsageError, "above 0"),
        (
            "joint_state_publisher",
            ["--ros-args", "-p", "source_list:=hand"],
            UsageError,
            "must be a list of topics",
        ),
    ],
)
def test_invalid_arguments_of_robot_nodes_are_refused(ros_runtime, package, words, error, told):
    with pytest.raises(error, match=told):
        begin(ros_runtime, package, *words)


def test_the_gui_is_a_command_of_ours(ros_runtime):
    with pytest.raises(UsageError, match="run 'tftool robot FILE' in another"):
        begin(ros_runtime, "joint_state_publisher_gui")
