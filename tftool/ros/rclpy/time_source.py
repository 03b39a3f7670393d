"""rclpy.time_source: whose time a node goes by. Here there is one time, the world's."""

from typing import Any

from tftool.ros.rclpy.time import ROSClock

CLOCK_TOPIC = "/clock"
USE_SIM_TIME_NAME = "use_sim_time"


class TimeSource:
    """Gives its clocks a node's time: all clocks of a world have the same one."""

    def __init__(self, *, node: Any = None) -> None:
        self._node = node
        self._clocks: list[ROSClock] = []

    def attach_node(self, node: Any) -> None:
        """Go by a node's time."""
        self._node = node

    def detach_node(self) -> None:
        """Go by no node's time.

        Raises:
            RuntimeError: If it goes by none.
        """
        if self._node is None:
            raise RuntimeError("Unable to detach node from time source")
        self._node = None

    def attach_clock(self, clock: Any) -> None:
        """Give a clock the time.

        Raises:
            ValueError: If it is none of ROS time.
        """
        if not isinstance(clock, ROSClock):
            raise ValueError("Only clocks with type ROS_TIME can be attached.")
        self._clocks.append(clock)
