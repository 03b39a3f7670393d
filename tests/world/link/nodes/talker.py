"""Talker that says hello five times a second."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.count = 0
        self.create_timer(0.2, self.say)

    def say(self):
        self.count += 1
        self.publisher.publish(String(data=f"Hello {self.count}"))


rclpy.init()
rclpy.spin(Talker())
