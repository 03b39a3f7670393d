"""Without ROS: pytest --ros-free. With it: colcon test."""

import math

import pytest
import rclpy
from geometry_msgs.msg import TransformStamped, Twist
from learning_tf.turtle_follower import TurtleFollower
from rclpy.executors import SingleThreadedExecutor
from tf2_ros import StaticTransformBroadcaster
from turtlesim.srv import Spawn


def place(child, x, y):
    t = TransformStamped()
    t.header.frame_id = "world"
    t.child_frame_id = child
    t.transform.translation.x = x
    t.transform.translation.y = y
    t.transform.rotation.w = 1.0
    return t


def test_it_turns_to_the_goal_and_drives_faster_the_farther_it_is():
    rclpy.init()
    simulator = rclpy.create_node("simulator")
    simulator.create_service(Spawn, "spawn", lambda request, answer: answer)
    heard = []
    simulator.create_subscription(Twist, "turtle2/cmd_vel", heard.append, 1)
    # turtle1 is four metres from turtle2, to its left.
    StaticTransformBroadcaster(simulator).sendTransform(
        [place("turtle1", 2.0, 5.0), place("turtle2", 2.0, 1.0)]
    )
    executor = SingleThreadedExecutor()
    executor.add_node(simulator)
    executor.add_node(TurtleFollower())

    for _ in range(100):
        executor.spin_once(timeout_sec=0.1)
        if heard:
            break

    assert heard[0].linear.x == pytest.approx(2.0)
    assert heard[0].angular.z == pytest.approx(math.pi / 2)
    rclpy.shutdown()
