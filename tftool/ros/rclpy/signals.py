"""rclpy.signals: Ctrl-C is handled by the runtime, whatever is asked for."""

from enum import IntEnum

from tftool.ros.host import program
from tftool.ros.rclpy.context import context_of


class SignalHandlerOptions(IntEnum):
    """Signals that rclpy would handle."""

    NO = 0
    ALL = 1
    SIGINT = 2
    SIGTERM = 3


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return the signals that are handled: ROS 2's answer, all while the context is started."""
    started = context_of(program.current()).ok()
    return SignalHandlerOptions.ALL if started else SignalHandlerOptions.NO
