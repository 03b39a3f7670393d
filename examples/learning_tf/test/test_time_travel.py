"""Without ROS: pytest --ros-free. With it: colcon test."""

import pytest
import rclpy
from geometry_msgs.msg import TransformStamped, Twist
from learning_tf.time_traveller import TimeTraveller
from rclpy.executors import SingleThreadedExecutor
from tf2_ros import TransformBroadcaster
from turtlesim.srv import Spawn


def test_it_goes_where_the_other_was():
    rclpy.init()
    simulator = rclpy.create_node("simulator")
    simulator.create_service(Spawn, "spawn", lambda request, answer: answer)
    heard = []
    simulator.create_subscription(Twist, "turtle2/cmd_vel", heard.append, 1)
    broadcaster = TransformBroadcaster(simulator)
    begun = simulator.get_clock().now()

    def place(child, x):
        t = TransformStamped()
        t.header.stamp = simulator.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = child
        t.transform.translation.x = x
        t.transform.rotation.w = 1.0
        broadcaster.sendTransform(t)

    def move():
        # turtle1 drives ahead at 1 m/s; turtle2 does not move.
        place("turtle1", (simulator.get_clock().now() - begun).nanoseconds / 1e9)
        place("turtle2", 0.0)

    simulator.create_timer(0.02, move)
    executor = SingleThreadedExecutor()
    executor.add_node(simulator)
    executor.add_node(TimeTraveller())

    for _ in range(2000):
        executor.spin_once(timeout_sec=0.1)
        if heard:
            break
    ran = (simulator.get_clock().now() - begun).nanoseconds / 1e9

    # Half of the position 3.1 s ago, not half of the present position.
    assert heard[0].linear.x == pytest.approx(0.5 * (ran - 3.1), abs=0.05)
    rclpy.shutdown()
