"""rclpy.signals: the runtime always handles Ctrl-C itself."""

from enum import IntEnum

from tftool.ros.host import program
from tftool.ros.rclpy.context import context_of


class SignalHandlerOptions(IntEnum):
    """Signals that rclpy could handle."""

    NO = 0
    ALL = 1
    SIGINT = 2
    SIGTERM = 3


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return the handled signals: as in ROS 2 all, while the context is initialised."""
    started = context_of(program.current()).ok()
    return SignalHandlerOptions.ALL if started else SignalHandlerOptions.NO
