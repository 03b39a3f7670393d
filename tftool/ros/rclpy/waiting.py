"""rclpy.wait_for_message."""

from typing import Any

from tftool.ros.rclpy.executors import wait_for
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.qos import QoSProfile
from tftool.ros.rclpy.seat import seat_of


def wait_for_message(
    msg_type: Any,
    node: Any,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Block until a message arrives.

    Args:
        msg_type: The topic's type.
        node: Listening node.
        topic: The topic's name.
        qos_profile: How to listen.
        time_to_wait: Seconds to wait at most; negative for no limit.

    Returns:
        (True, the message), or (False, None) if there was none in time, or everything ended.
    """
    arrived = Future()

    def keep(message: Any) -> None:
        if not arrived.done():
            arrived.set_result(message)

    subscription = node.create_subscription(msg_type, topic, keep, qos_profile)
    # The callback that waits may keep the node's other callbacks from running.
    subscription.passes_busy_group = True
    try:
        wait_for(seat_of(node), arrived, None if time_to_wait < 0 else time_to_wait)
    finally:
        node.destroy_subscription(subscription)
    return arrived.done(), arrived.result()
