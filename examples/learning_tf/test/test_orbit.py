"""Without ROS: pytest --ros-free. With it: colcon test."""

import math

import pytest
import rclpy
from learning_tf.moving_carrot import MovingCarrot
from rclpy.executors import SingleThreadedExecutor
from tf2_msgs.msg import TFMessage


def test_the_carrot_circles_at_two_metres():
    rclpy.init()
    asking = rclpy.create_node("asking")
    heard = []
    asking.create_subscription(TFMessage, "/tf", lambda m: heard.extend(m.transforms), 10)
    executor = SingleThreadedExecutor()
    executor.add_node(asking)
    executor.add_node(MovingCarrot())

    for _ in range(100):
        executor.spin_once(timeout_sec=0.1)
        if len(heard) >= 10:
            break

    places = [(t.transform.translation.x, t.transform.translation.y) for t in heard]
    assert len(places) >= 10
    assert [math.hypot(x, y) for x, y in places] == pytest.approx([2.0] * len(places))
    assert places[0] != places[-1]
    rclpy.shutdown()
