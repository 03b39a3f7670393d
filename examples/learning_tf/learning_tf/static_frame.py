"""Publish a static frame once: a shelf, one metre above the world's corner."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster


class StaticFrame(Node):
    def __init__(self):
        super().__init__("static_frame")
        self.broadcaster = StaticTransformBroadcaster(self)

        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = "shelf"
        t.transform.translation.z = 1.0
        # A rotation is a quaternion; with w = 1 and x = y = z = 0 there is no rotation.
        t.transform.rotation.w = 1.0
        self.broadcaster.sendTransform(t)


def main():
    rclpy.init()
    node = StaticFrame()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
