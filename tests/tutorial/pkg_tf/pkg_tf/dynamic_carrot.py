import math

from geometry_msgs.msg import TransformStamped
import rclpy
from rclpy.node import Node
from tf2_ros import TransformBroadcaster


class DynamicCarrot(Node):

    def __init__(self):
        super().__init__('dynamic_carrot')
        self.tf_broadcaster = TransformBroadcaster(self)
        self.timer = self.create_timer(0.1, self.send)

    def send(self):
        # Whole seconds, so that the carrot jumps from side to side
        seconds, _ = self.get_clock().now().seconds_nanoseconds()
        x = seconds * math.pi

        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = 'turtle1'
        t.child_frame_id = 'carrot1'
        t.transform.translation.x = 10 * math.sin(x)
        t.transform.translation.y = 10 * math.cos(x)
        self.tf_broadcaster.sendTransform(t)


def main():
    rclpy.init()
    node = DynamicCarrot()
    rclpy.spin(node)
    rclpy.shutdown()
