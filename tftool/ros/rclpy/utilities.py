"""rclpy.utilities."""

import sys
from collections.abc import Sequence

from tftool.ros.host import names
from tftool.ros.rclpy.core import get_default_context, ok, shutdown, try_shutdown

__all__ = [
    "get_default_context",
    "get_rmw_implementation_identifier",
    "ok",
    "remove_ros_args",
    "shutdown",
    "timeout_sec_to_nsec",
    "try_shutdown",
]


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """Return the arguments without ROS 2's."""
    return names.parse(list(sys.argv if args is None else args))[1]


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Return nanoseconds; -1 for no limit."""
    if timeout_sec is None or timeout_sec < 0:
        return -1
    return int(float(timeout_sec) * 1e9)


def get_rmw_implementation_identifier() -> str:
    """Return the middleware's name: messages stay in this process."""
    return "tftool"
