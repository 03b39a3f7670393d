"""rclpy.parameter_event_handler: callbacks for parameters that change."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from tftool.messages.classes import INTERFACES
from tftool.ros.host import names
from tftool.ros.rclpy.node_parameters import PARAMETER_EVENTS
from tftool.ros.rclpy.qos import QoSProfile, qos_profile_parameter_events


@dataclass(eq=False, slots=True)
class ParameterCallbackHandle:
    """Handle of a callback for one parameter of one node."""

    parameter_name: str
    node_name: str
    callback: Callable[[Any], object]


@dataclass(eq=False, slots=True)
class ParameterEventCallbackHandle:
    """Handle of a callback for every event."""

    callback: Callable[[Any], object]


class ParameterEventHandler:
    """Calls back when parameters of this or another node change."""

    def __init__(
        self,
        node: Any,
        qos_profile: QoSProfile = qos_profile_parameter_events,
        callback_group: Any = None,
        **options: Any,
    ) -> None:
        self.node = node
        self._of_one: list[ParameterCallbackHandle] = []
        self._of_all: list[ParameterEventCallbackHandle] = []
        self.parameter_event_subscription = node.create_subscription(
            INTERFACES.message("rcl_interfaces/ParameterEvent"),
            PARAMETER_EVENTS,
            self._arrived,
            qos_profile,
            callback_group=callback_group,
            **options,
        )

    def destroy(self) -> None:
        """Unsubscribe."""
        self.node.destroy_subscription(self.parameter_event_subscription)

    def _arrived(self, event: Any) -> None:
        for one in list(self._of_one):
            found = self.get_parameter_from_event(event, one.parameter_name, one.node_name)
            if found is not None:
                one.callback(found)
        for every in list(self._of_all):
            every.callback(event)

    @staticmethod
    def get_parameter_from_event(event: Any, parameter_name: str, node_name: str) -> Any:
        """Return one node's parameter in an event; None if the event is about another."""
        if event.node != node_name:
            return None
        told = ParameterEventHandler.get_parameters_from_event(event)
        return next((one for one in told if one.name == parameter_name), None)

    @staticmethod
    def get_parameters_from_event(event: Any) -> Iterator[Any]:
        """Return the new and changed parameters of an event."""
        yield from event.new_parameters
        yield from event.changed_parameters

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[Any], object]
    ) -> ParameterCallbackHandle:
        """Call `callback` with a parameter's message whenever it is set."""
        handle = ParameterCallbackHandle(parameter_name, self._resolve_path(node_name), callback)
        # As in ROS 2, who came last is told first.
        self._of_one.insert(0, handle)
        return handle

    def add_parameter_event_callback(
        self, callback: Callable[[Any], object]
    ) -> ParameterEventCallbackHandle:
        """Call `callback` with every event."""
        handle = ParameterEventCallbackHandle(callback)
        self._of_all.insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Remove the callback.

        Raises:
            RuntimeError: If it was not registered.
        """
        _remove(self._of_one, handle)

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Remove the callback.

        Raises:
            RuntimeError: If it was not registered.
        """
        _remove(self._of_all, handle)

    def configure_nodes_filter(self, node_names: Iterable[str] | None = None) -> bool:
        """Return whether events can be filtered before arrival, which only works for no events."""
        return not node_names

    def _resolve_path(self, node_name: str = "") -> str:
        if not node_name:
            return str(self.node.get_fully_qualified_name())
        if node_name.startswith("/"):
            return node_name
        return f"/{names.join(self.node.get_namespace(), node_name)}"


def _remove(handles: list[Any], handle: Any) -> None:
    if handle not in handles:
        raise RuntimeError("Callback doesn't exist")
    handles.remove(handle)
