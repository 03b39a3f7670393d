import sys

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from turtlesim.action import RotateAbsolute


class Rotate(Node):
    """Turn turtle1 to a heading; log the success, or cancel the turn if it takes too long."""

    def __init__(self, patience=None):
        super().__init__('rotate')
        self.patience = patience
        self._action_client = ActionClient(self, RotateAbsolute, '/turtle1/rotate_absolute')
        self.feedbacks = 0

    def send_goal(self, theta):
        goal_msg = RotateAbsolute.Goal()
        goal_msg.theta = theta
        self._action_client.wait_for_server()
        self._send_goal_future = self._action_client.send_goal_async(
            goal_msg, feedback_callback=self.feedback_callback)
        self._send_goal_future.add_done_callback(self.goal_response_callback)

    def goal_response_callback(self, future):
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().info('Goal rejected')
            return
        self.goal_handle = goal_handle
        self.get_logger().info('Goal accepted')
        self._get_result_future = goal_handle.get_result_async()
        self._get_result_future.add_done_callback(self.get_result_callback)

    def feedback_callback(self, feedback_msg):
        self.feedbacks += 1
        self.remaining = feedback_msg.feedback.remaining
        if self.feedbacks == self.patience:
            self.goal_handle.cancel_goal_async()

    def get_result_callback(self, future):
        result = future.result().result
        self.get_logger().info(f'Result: {result.delta:.4f} after {self.feedbacks} feedbacks')
        rclpy.shutdown()


def main(args=None):
    rclpy.init(args=args)
    words = rclpy.utilities.remove_ros_args(sys.argv)
    node = Rotate(int(words[2]) if len(words) > 2 else None)
    node.send_goal(float(words[1]))
    rclpy.spin(node)
