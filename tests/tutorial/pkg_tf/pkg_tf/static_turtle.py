import sys

from geometry_msgs.msg import TransformStamped
import rclpy
from rclpy.node import Node
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster
import tf_transformations


class StaticTurtle(Node):

    def __init__(self, words):
        super().__init__('static_turtle')
        self.tf_static_broadcaster = StaticTransformBroadcaster(self)

        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = 'world'
        t.child_frame_id = words[1]
        t.transform.translation.x = float(words[2])
        t.transform.translation.y = float(words[3])
        t.transform.translation.z = float(words[4])
        quat = tf_transformations.quaternion_from_euler(
            float(words[5]), float(words[6]), float(words[7]))
        t.transform.rotation.x = quat[0]
        t.transform.rotation.y = quat[1]
        t.transform.rotation.z = quat[2]
        t.transform.rotation.w = quat[3]

        self.tf_static_broadcaster.sendTransform(t)


def main():
    logger = rclpy.logging.get_logger('logger')

    if len(sys.argv) != 8:
        logger.info('Usage: static_turtle child_frame_name x y z roll pitch yaw')
        sys.exit(1)
    if sys.argv[1] == 'world':
        logger.info('Your static turtle name cannot be "world"')
        sys.exit(2)

    rclpy.init()
    node = StaticTurtle(sys.argv)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass

    rclpy.shutdown()
