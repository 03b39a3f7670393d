"""Spinning of nodes in tests."""


def spin(node, seconds):
    """Spin a node for a number of seconds."""
    import rclpy
    from rclpy.task import Future

    rclpy.spin_until_future_complete(node, Future(), timeout_sec=seconds)
