"""Client of rclpy for the parameters of another node, and handler of parameter events."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from tftool.messages.classes import INTERFACES
from tftool.ros.host import names
from tftool.ros.host.import_table import snake_case
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node_parameters import PARAMETER_EVENTS
from tftool.ros.rclpy.node_state import state_of
from tftool.ros.rclpy.parameter import Parameter, parameter_dict_from_yaml_file
from tftool.ros.rclpy.qos import (
    QoSProfile,
    qos_profile_parameter_events,
    qos_profile_services_default,
)

Callback = Callable[[Future], object]


class AsyncParameterClient:
    """Client of another node's parameter services; its methods return futures."""

    def __init__(
        self,
        node: Any,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: Any = None,
    ) -> None:
        self.node = node
        self.remote_node_name = remote_node_name
        self._clients = {
            kind: node.create_client(
                INTERFACES.find("rcl_interfaces", "srv", kind),
                f"{remote_node_name}/{snake_case(kind)}",
                qos_profile=qos_profile,
                callback_group=callback_group,
            )
            for kind in (
                "GetParameters",
                "ListParameters",
                "SetParameters",
                "GetParameterTypes",
                "DescribeParameters",
                "SetParametersAtomically",
            )
        }

    def services_are_ready(self) -> bool:
        """Return whether the other node's parameter services exist."""
        return all(client.service_is_ready() for client in self._clients.values())

    def wait_for_services(self, timeout_sec: float | None = None) -> bool:
        """Block until the other node's parameter services exist; return False at the timeout."""
        state = state_of(self.node)
        # Wait for all services together, so that the timeout applies to all of them.
        names = [client.full for client in self._clients.values()]
        return state.wait_until(lambda: all(map(state.world.has_service, names)), timeout_sec)

    def _ask(self, kind: str, callback: Callback | None, **fields: Any) -> Future:
        client = self._clients[kind]
        future: Future = client.call_async(client.srv_type.Request(**fields))
        if callback is not None:
            future.add_done_callback(callback)
        return future

    def list_parameters(
        self,
        prefixes: list[str] | None = None,
        depth: int | None = None,
        callback: Callback | None = None,
    ) -> Future:
        """Request the names of the parameters below one of the prefixes; by default all names."""
        return self._ask("ListParameters", callback, prefixes=prefixes or [], depth=depth or 0)

    def get_parameters(self, names: list[str], callback: Callback | None = None) -> Future:
        """Request the values of several parameters."""
        return self._ask("GetParameters", callback, names=names)

    def get_parameter_types(self, names: list[str], callback: Callback | None = None) -> Future:
        """Request the types of several parameters."""
        return self._ask("GetParameterTypes", callback, names=names)

    def describe_parameters(self, names: list[str], callback: Callback | None = None) -> Future:
        """Request the descriptors of several parameters."""
        return self._ask("DescribeParameters", callback, names=names)

    def set_parameters(self, parameters: Sequence[Any], callback: Callback | None = None) -> Future:
        """Request to set parameters, which the other node accepts or rejects one by one.

        The parameters are `Parameter` objects or Parameter messages.
        """
        return self._ask("SetParameters", callback, parameters=_messages(parameters))

    def set_parameters_atomically(
        self, parameters: Sequence[Any], callback: Callback | None = None
    ) -> Future:
        """Request to set all given parameters, or none of them if one is rejected."""
        return self._ask("SetParametersAtomically", callback, parameters=_messages(parameters))

    def delete_parameters(self, names: list[str], callback: Callback | None = None) -> Future:
        """Request to delete parameters, which must have been declared with dynamic typing."""
        return self.set_parameters([Parameter(name) for name in names], callback)

    def load_parameter_file(
        self, parameter_file: str, use_wildcard: bool = False, callback: Callback | None = None
    ) -> Future:
        """Request to set a file's parameters; the node accepts or rejects each parameter."""
        return self.set_parameters(_of_file(parameter_file, use_wildcard), callback)

    def load_parameter_file_atomically(
        self, parameter_file: str, use_wildcard: bool = False, callback: Callback | None = None
    ) -> Future:
        """Request to set all parameters of a file, or none of them if one is rejected."""
        return self.set_parameters_atomically(_of_file(parameter_file, use_wildcard), callback)

    def on_parameter_event(
        self,
        callback: Callable[..., Any],
        qos_profile: QoSProfile = qos_profile_parameter_events,
        **options: Any,
    ) -> Any:
        """Subscribe to the parameter events of all nodes; return the subscription."""
        kind = INTERFACES.message("rcl_interfaces/ParameterEvent")
        return self.node.create_subscription(
            kind, PARAMETER_EVENTS, callback, qos_profile, **options
        )


def _of_file(file: str, use_wildcard: bool) -> list[Any]:
    return list(parameter_dict_from_yaml_file(file, use_wildcard).values())


def _messages(parameters: Sequence[Any]) -> list[Any]:
    return [one.to_parameter_msg() if isinstance(one, Parameter) else one for one in parameters]


@dataclass(eq=False, slots=True)
class ParameterEventCallbackHandle:
    """Handle of a callback that is registered for all parameter events."""

    callback: Callable[[Any], object]


@dataclass(eq=False, slots=True)
class ParameterCallbackHandle(ParameterEventCallbackHandle):
    """Handle of a callback that is registered for one parameter of one node."""

    parameter_name: str
    node_name: str


class ParameterEventHandler:
    """Handler that calls registered callbacks when nodes change their parameters."""

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
        """Unsubscribe from parameter events, so that no callback is called any more."""
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
        """Return a node's parameter in an event, as a Parameter message; None if not contained."""
        if event.node != node_name:
            return None
        told = ParameterEventHandler.get_parameters_from_event(event)
        return next((one for one in told if one.name == parameter_name), None)

    @staticmethod
    def get_parameters_from_event(event: Any) -> Iterator[Any]:
        """Yield the Parameter messages of new and changed parameters in an event."""
        yield from event.new_parameters
        yield from event.changed_parameters

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[Any], object]
    ) -> ParameterCallbackHandle:
        """Call `callback` with the Parameter message each time one parameter of one node is set."""
        handle = ParameterCallbackHandle(callback, parameter_name, self._resolve_path(node_name))
        # As in ROS 2, the callback registered last is called first.
        self._of_one.insert(0, handle)
        return handle

    def add_parameter_event_callback(
        self, callback: Callable[[Any], object]
    ) -> ParameterEventCallbackHandle:
        """Call `callback` with each parameter event of any node; return a handle for removal."""
        handle = ParameterEventCallbackHandle(callback)
        self._of_all.insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Remove a callback registered with `add_parameter_callback`.

        Raises:
            RuntimeError: If the callback was not registered.
        """
        _remove(self._of_one, handle)

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Remove a callback registered with `add_parameter_event_callback`.

        Raises:
            RuntimeError: If the callback was not registered.
        """
        _remove(self._of_all, handle)

    def configure_nodes_filter(self, node_names: Iterable[str] | None = None) -> bool:
        """Return True without names; return False with names, which tftool ignores.

        This handler always gets the parameter events of all nodes.
        """
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
