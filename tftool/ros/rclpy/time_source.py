"""Class TimeSource of rclpy.time_source, which sets clocks to the times on the topic `/clock`.

The parameter `use_sim_time` of the attached node switches the `TimeSource` on. Every node has a
`TimeSource` for its clock, except in a world that has its own time.
"""

from functools import partial
from typing import Any

from tftool.messages.classes import INTERFACES
from tftool.ros.host.program import warn_without_clock
from tftool.ros.rclpy.node_parameters import set_result
from tftool.ros.rclpy.node_state import state_of
from tftool.ros.rclpy.parameter import Parameter
from tftool.ros.rclpy.qos import QoSProfile, ReliabilityPolicy
from tftool.ros.rclpy.time import ClockType, ROSClock, Time

CLOCK_TOPIC = "/clock"
USE_SIM_TIME_NAME = "use_sim_time"


class TimeSource:
    """Source that sets clocks to the times on `/clock` while its node's `use_sim_time` is true."""

    def __init__(self, *, node: Any = None) -> None:
        self._node: Any = None
        self._clock_sub: Any = None
        self._clocks: list[ROSClock] = []
        self._last_time_set = Time(clock_type=ClockType.ROS_TIME)
        self._ros_time_is_active = False
        if node is not None:
            self.attach_node(node)

    @property
    def ros_time_is_active(self) -> bool:
        """Whether the attached clocks show the times on `/clock`."""
        return self._ros_time_is_active

    @ros_time_is_active.setter
    def ros_time_is_active(self, enabled: bool) -> None:
        if enabled is self._ros_time_is_active:
            return
        self._ros_time_is_active = enabled
        for clock in self._clocks:
            clock._set_ros_time_is_active(enabled)
        if enabled:
            self._subscribe()
        else:
            self._unsubscribe()

    def _subscribe(self) -> None:
        if self._node is not None and self._clock_sub is None:
            qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
            kind = INTERFACES.message("rosgraph_msgs/Clock")
            self._clock_sub = self._node.create_subscription(
                kind, CLOCK_TOPIC, self.clock_callback, qos
            )
            state = state_of(self._node)
            say = partial(state.program.say, "WARN", state.authority)
            state.program.ask(partial(warn_without_clock, state.world, say))

    def _unsubscribe(self) -> None:
        if self._node is not None and self._clock_sub is not None:
            self._node.destroy_subscription(self._clock_sub)
        self._clock_sub = None

    def attach_node(self, node: Any) -> None:
        """Attach a node whose parameter `use_sim_time` switches this source on and off.

        Raises:
            TypeError: If the object is not a node.
        """
        state_of(node)
        if self._node is not None:
            self.detach_node()
        self._node = node
        if not node.has_parameter(USE_SIM_TIME_NAME):
            node.declare_parameter(USE_SIM_TIME_NAME, False)
        parameter = node.get_parameter(USE_SIM_TIME_NAME)
        if parameter.type_ is Parameter.Type.BOOL:
            self.ros_time_is_active = parameter.value
            if self.ros_time_is_active:
                self._subscribe()
        elif parameter.type_ is not Parameter.Type.NOT_SET:
            node.get_logger().error(
                f"Invalid type for parameter '{USE_SIM_TIME_NAME}' {parameter.type_!r} "
                "should be bool"
            )
        node.add_on_set_parameters_callback(self._on_parameters)

    def detach_node(self) -> None:
        """Detach the node, if there is one, and unsubscribe from `/clock`."""
        if self._node is not None:
            self._node.remove_on_set_parameters_callback(self._on_parameters)
        self._unsubscribe()
        self._node = None

    def attach_clock(self, clock: Any) -> None:
        """Add a clock that this time source sets.

        Raises:
            ValueError: If the clock is not a clock of ROS time.
        """
        if not isinstance(clock, ROSClock):
            raise ValueError("Only clocks with type ROS_TIME can be attached.")
        clock.set_ros_time_override(self._last_time_set)
        clock._set_ros_time_is_active(self._ros_time_is_active)
        if clock not in self._clocks:
            self._clocks.append(clock)

    def clock_callback(self, message: Any) -> None:
        """Set the attached clocks to the time in a `/clock` message."""
        self._last_time_set = Time.from_msg(message.clock)
        for clock in self._clocks:
            clock.set_ros_time_override(self._last_time_set)

    def _on_parameters(self, parameters: list[Parameter]) -> Any:
        for parameter in parameters:
            if parameter.name != USE_SIM_TIME_NAME:
                continue
            if parameter.type_ is not Parameter.Type.BOOL:
                return set_result(False, f"{USE_SIM_TIME_NAME} parameter set to no bool")
            self.ros_time_is_active = parameter.value
        return set_result(True, "")
