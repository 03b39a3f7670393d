"""rclpy.signals: Ctrl-C is handled by the runtime, whatever is asked for."""

from enum import IntEnum


class SignalHandlerOptions(IntEnum):
    """Which signals rclpy would handle."""

    NO = 0
    ALL = 1
    SIGINT = 2
    SIGTERM = 3
