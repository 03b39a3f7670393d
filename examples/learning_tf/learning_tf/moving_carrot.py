"""Add a frame that moves: carrot1 circles turtle1 at two metres, once in about six seconds."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster


class MovingCarrot(Node):
    def __init__(self):
        super().__init__("moving_carrot")
        self.broadcaster = TransformBroadcaster(self)
        self.create_timer(0.1, self.broadcast)

    def broadcast(self):
        now = self.get_clock().now()
        angle = now.nanoseconds / 1e9 % (2 * math.pi)
        t = TransformStamped()
        t.header.stamp = now.to_msg()
        t.header.frame_id = "turtle1"
        t.child_frame_id = "carrot1"
        t.transform.translation.x = 2.0 * math.cos(angle)
        t.transform.translation.y = 2.0 * math.sin(angle)
        t.transform.rotation.w = 1.0
        self.broadcaster.sendTransform(t)


def main():
    rclpy.init()
    node = MovingCarrot()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
