from geometry_msgs.msg import PointStamped
import rclpy
from rclpy.node import Node
from turtlesim.msg import Pose


class PointSender(Node):
    """Publish turtle1's position as a point in world."""

    def __init__(self):
        super().__init__('point_sender')
        self.pub = self.create_publisher(PointStamped, '/turtle1/turtle_point_stamped', 10)
        self.sub = self.create_subscription(Pose, '/turtle1/pose', self.handle_pose, 10)

    def handle_pose(self, msg):
        ps = PointStamped()
        ps.header.stamp = self.get_clock().now().to_msg()
        ps.header.frame_id = 'world'
        ps.point.x = msg.x
        ps.point.y = msg.y
        self.pub.publish(ps)


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(PointSender())
    rclpy.shutdown()
