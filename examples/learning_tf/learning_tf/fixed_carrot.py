"""Add a frame: carrot1, two metres to the left of turtle1, wherever turtle1 goes."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster


class FixedCarrot(Node):
    def __init__(self):
        super().__init__("fixed_carrot")
        self.broadcaster = TransformBroadcaster(self)
        self.create_timer(0.1, self.broadcast)

    def broadcast(self):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "turtle1"
        t.child_frame_id = "carrot1"
        t.transform.translation.y = 2.0
        t.transform.rotation.w = 1.0
        self.broadcaster.sendTransform(t)


def main():
    rclpy.init()
    node = FixedCarrot()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
