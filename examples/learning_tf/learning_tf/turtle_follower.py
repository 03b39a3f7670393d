"""Spawn turtle2, and steer it to a frame by looking up the frame relative to turtle2."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener
from turtlesim.srv import Spawn


class TurtleFollower(Node):
    def __init__(self):
        super().__init__("turtle_follower")
        self.goal = self.declare_parameter("goal", "turtle1").value
        # The listener puts every transform into the buffer, which keeps ten seconds of them.
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)

        self.commands = self.create_publisher(Twist, "turtle2/cmd_vel", 1)
        self.spawning = None
        self.spawner = self.create_client(Spawn, "spawn")
        self.create_timer(0.5, self.steer)

    def steer(self):
        if self.spawning is None:
            if self.spawner.service_is_ready():
                self.spawning = self.spawner.call_async(Spawn.Request(name="turtle2", x=4.0, y=2.0))
            return

        try:
            # Target first, source second. Time() means the latest time at which both frames are known.
            found = self.buffer.lookup_transform("turtle2", self.goal, Time())
        except TransformException as refused:
            self.get_logger().info(f"waiting: {refused}")
            return

        ahead = found.transform.translation.x
        left = found.transform.translation.y
        command = Twist()
        command.linear.x = 0.5 * math.hypot(ahead, left)
        command.angular.z = math.atan2(left, ahead)
        self.commands.publish(command)


def main():
    rclpy.init()
    node = TurtleFollower()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
