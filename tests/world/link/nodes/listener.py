"""Listener that logs the talker's messages, and the talker's pose in the world."""

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import String
from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener


class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.buffer = Buffer()
        self.transforms = TransformListener(self.buffer, self)
        self.create_subscription(String, "chatter", self.hear, 10)
        self.create_timer(0.2, self.look)

    def hear(self, message):
        self.get_logger().info(f"I heard: {message.data}")

    def look(self):
        try:
            found = self.buffer.lookup_transform("A", "B", Time())
        except TransformException:
            return
        self.get_logger().info(f"B is {found.transform.translation.z} above A", once=True)


rclpy.init()
rclpy.spin(Listener())
