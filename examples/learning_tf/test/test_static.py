"""Without ROS: pytest --ros-free. With it: colcon test."""

import rclpy
from learning_tf.static_frame import StaticFrame
from rclpy.executors import SingleThreadedExecutor
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener


def test_the_shelf_stands_above_the_corner():
    rclpy.init()
    asking = rclpy.create_node("asking")
    buffer = Buffer()
    TransformListener(buffer, asking)
    executor = SingleThreadedExecutor()
    executor.add_node(asking)
    executor.add_node(StaticFrame())

    for _ in range(50):
        executor.spin_once(timeout_sec=0.1)
        if buffer.can_transform("world", "shelf", Time()):
            break

    found = buffer.lookup_transform("world", "shelf", Time()).transform
    assert (found.translation.x, found.translation.y, found.translation.z) == (0.0, 0.0, 1.0)
    rclpy.shutdown()
