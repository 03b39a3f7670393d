"""Broadcast a turtle's pose in the world each time the simulator publishes it."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtlesim.msg import Pose


class TurtleBroadcaster(Node):
    def __init__(self):
        super().__init__("turtle_broadcaster")
        self.turtle = self.declare_parameter("turtle", "turtle1").value
        self.broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"{self.turtle}/pose", self.broadcast, 1)

    def broadcast(self, pose):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = self.turtle
        t.transform.translation.x = pose.x
        t.transform.translation.y = pose.y
        # A turn by theta about the z axis, as a quaternion.
        t.transform.rotation.z = math.sin(pose.theta / 2)
        t.transform.rotation.w = math.cos(pose.theta / 2)
        self.broadcaster.sendTransform(t)


def main():
    rclpy.init()
    node = TurtleBroadcaster()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
