import math

from geometry_msgs.msg import Twist

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node

from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener


class FirstTimeTravel(Node):
    """Look up where turtle1 was five seconds ago, as turtle2 saw it then: a common mistake."""

    def __init__(self):
        super().__init__('first_time_travel')
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.publisher = self.create_publisher(Twist, 'turtle2/cmd_vel', 1)
        period = self.declare_parameter('period', 1.0).value
        self.create_timer(period, self.on_timer)

    def on_timer(self):
        try:
            when = self.get_clock().now() - Duration(seconds=5.0)
            trans = self.tf_buffer.lookup_transform(
                'turtle2',
                'turtle1',
                when,
                timeout=Duration(seconds=0.05))
        except TransformException as ex:
            self.get_logger().info(f'Could not transform: {ex}')
            return

        msg = Twist()
        x, y = trans.transform.translation.x, trans.transform.translation.y
        msg.angular.z = 1.0 * math.atan2(y, x)
        msg.linear.x = 0.5 * math.sqrt(x ** 2 + y ** 2)
        self.publisher.publish(msg)


def main():
    rclpy.init()
    node = FirstTimeTravel()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass

    rclpy.shutdown()
