"""Steer turtle2 to the pose that turtle1 had three seconds ago."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.node import Node
from tf2_ros import Buffer, TransformException, TransformListener
from turtlesim.srv import Spawn


class TimeTraveller(Node):
    def __init__(self):
        super().__init__("time_traveller")
        self.delay = Duration(seconds=self.declare_parameter("delay", 3.0).value)
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
            # The newest transform may not have arrived, so "now" is a tenth of a second ago.
            now = self.get_clock().now() - Duration(seconds=0.1)
            found = self.buffer.lookup_transform_full(
                target_frame="turtle2",
                target_time=now,
                source_frame="turtle1",
                source_time=now - self.delay,
                # A lookup with two times needs a frame that does not move between them.
                fixed_frame="world",
            )
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
    node = TimeTraveller()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
