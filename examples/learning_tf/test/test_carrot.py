"""Without ROS: pytest --ros-free. With it: colcon test."""

import rclpy
from learning_tf.fixed_carrot import FixedCarrot
from rclpy.executors import SingleThreadedExecutor
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener


def test_the_carrot_is_two_metres_to_the_left():
    rclpy.init()
    asking = rclpy.create_node("asking")
    buffer = Buffer()
    TransformListener(buffer, asking)
    executor = SingleThreadedExecutor()
    executor.add_node(asking)
    executor.add_node(FixedCarrot())

    for _ in range(50):
        executor.spin_once(timeout_sec=0.1)
        if buffer.can_transform("turtle1", "carrot1", Time()):
            break

    found = buffer.lookup_transform("turtle1", "carrot1", Time()).transform
    assert (found.translation.x, found.translation.y, found.translation.z) == (0.0, 2.0, 0.0)
    rclpy.shutdown()
