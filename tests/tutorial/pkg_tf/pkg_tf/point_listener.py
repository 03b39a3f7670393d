from functools import partial

from geometry_msgs.msg import PointStamped
from message_filters import Subscriber
import rclpy
from rclpy.node import Node
from rclpy.time import Time
import tf2_geometry_msgs
from tf2_ros import Buffer, TransformException, TransformListener


class PointListener(Node):
    """Pass a point on as soon as its transform is available, like tf2's message filter."""

    def __init__(self):
        super().__init__('point_listener')
        self.target_frame = self.declare_parameter('target_frame', 'turtle1').value
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.point_sub = Subscriber(
            self, PointStamped, '/turtle1/turtle_point_stamped', qos_profile=10)
        self.point_sub.registerCallback(self.wait_for_frame)

    def wait_for_frame(self, point):
        future = self.tf_buffer.wait_for_transform_async(
            self.target_frame, point.header.frame_id, Time.from_msg(point.header.stamp))
        future.add_done_callback(partial(self.handle_point, point))

    def handle_point(self, point, future):
        try:
            out = tf2_geometry_msgs.do_transform_point(point, future.result())
        except TransformException as ex:
            self.get_logger().warn(f'Failure {ex}')
            return
        self.get_logger().info(
            f'Point in {out.header.frame_id}: '
            f'x:{out.point.x:.3f} y:{out.point.y:.3f} z:{out.point.z:.3f}',
            throttle_duration_sec=1.0)


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(PointListener())
    rclpy.shutdown()
