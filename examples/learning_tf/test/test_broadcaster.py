"""Without ROS: pytest --ros-free. With it: colcon test."""

import math

import pytest
import rclpy
from learning_tf.turtle_broadcaster import TurtleBroadcaster
from rclpy.executors import SingleThreadedExecutor
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener
from turtlesim.msg import Pose


def test_a_pose_becomes_a_frame():
    rclpy.init()
    simulator = rclpy.create_node("simulator")
    poses = simulator.create_publisher(Pose, "turtle1/pose", 1)
    buffer = Buffer()
    TransformListener(buffer, simulator)
    executor = SingleThreadedExecutor()
    executor.add_node(simulator)
    executor.add_node(TurtleBroadcaster())

    for _ in range(50):
        poses.publish(Pose(x=3.0, y=1.0, theta=math.pi / 2))
        executor.spin_once(timeout_sec=0.1)
        if buffer.can_transform("world", "turtle1", Time()):
            break

    found = buffer.lookup_transform("world", "turtle1", Time()).transform
    assert (found.translation.x, found.translation.y) == (3.0, 1.0)
    # A quarter of a turn about z.
    assert found.rotation.z == pytest.approx(math.sqrt(0.5))
    assert found.rotation.w == pytest.approx(math.sqrt(0.5))
    rclpy.shutdown()
