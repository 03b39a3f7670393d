from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
import rclpy
from rclpy.node import Node


class Tunable(Node):
    """Drive turtle1 at a speed given by a parameter with limits, which may change meanwhile."""

    def __init__(self):
        super().__init__('tunable')
        self.declare_parameter('speed', 1.0)
        self.speed = self.get_parameter('speed').value
        self.add_on_set_parameters_callback(self.on_set)
        self.pub = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.create_timer(0.5, self.drive)

    def on_set(self, params):
        for param in params:
            if param.name == 'speed':
                if not 0.0 <= param.value <= 2.0:
                    return SetParametersResult(successful=False, reason='too fast')
                self.speed = param.value
        return SetParametersResult(successful=True)

    def drive(self):
        msg = Twist()
        msg.linear.x = self.speed
        self.pub.publish(msg)


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Tunable())
    rclpy.shutdown()
