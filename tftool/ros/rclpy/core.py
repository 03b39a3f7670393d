"""Functions of rclpy itself, and of the modules rclpy.utilities, rclpy.signals and others."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, List, Optional  # noqa: UP035

from tftool.ros.host import names, program
from tftool.ros.rclpy import logging
from tftool.ros.rclpy.context import Context, context_of
from tftool.ros.rclpy.exceptions import NoTypeSupportImportedException
from tftool.ros.rclpy.executors import (
    Executor,
    SingleThreadedExecutor,
    executor_of,
    serving,
    wait_for,
)
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.node_parameters import warn_of_unused
from tftool.ros.rclpy.node_state import state_of
from tftool.ros.rclpy.qos import QoSProfile
from tftool.ros.rclpy.time import S_TO_NS, Duration, Time

# Some programs import what rclpy's own module imports from typing.
__all__ = [
    "S_TO_NS",
    "TYPE_CHECKING",
    "Context",
    "Duration",
    "Executor",
    "Future",
    "List",
    "Node",
    "Optional",
    "SingleThreadedExecutor",
    "Time",
    "logging",
]


@dataclass(eq=False)
class InitContextManager:
    """Context manager that `rclpy.init` returns; the end of the `with` block shuts rclpy down."""

    context: Context

    def __enter__(self) -> "InitContextManager":
        return self

    def __exit__(self, *args: object) -> None:
        self.context.try_shutdown()


def init(
    *,
    args: Sequence[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: Any = None,
) -> InitContextManager:
    """Initialise rclpy in the calling program; return a context manager that shuts rclpy down.

    Raises:
        RuntimeError: If rclpy is initialised already.
    """
    owner = program.current()
    chosen = context or context_of(owner)
    if context is None and not chosen.ok() and owner.context is chosen and not owner.interrupted:
        # As in ROS 2, after a shutdown the default context may be started again.
        owner.executor = None
    chosen.init(args, domain_id=domain_id)
    return InitContextManager(chosen)


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut rclpy down in the calling program, which ends all functions that spin."""
    (context or context_of(program.current())).shutdown()


def try_shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut rclpy down in the calling program; do nothing if rclpy is shut down already."""
    (context or context_of(program.current())).try_shutdown()


def ok(*, context: Context | None = None) -> bool:
    """Return whether rclpy is initialised and not shut down."""
    return (context or context_of(program.current())).ok()


def create_node(node_name: str, **kwargs: Any) -> Node:
    """Return a new `Node` with the given name; `kwargs` are further arguments of `Node`."""
    return Node(node_name, **kwargs)


def get_global_executor() -> Executor:
    """Return the executor that `spin` uses by default."""
    return executor_of(program.current())


def get_default_context() -> Context:
    """Return the default context of the calling program."""
    return context_of(program.current())


def spin(node: Node, executor: Executor | None = None) -> None:
    """Execute a node's callbacks until rclpy is shut down."""
    chosen = executor or get_global_executor()
    with serving(chosen, node):
        warn_of_unused(node)
        chosen.spin()


def spin_once(
    node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Wait until one callback of a node is ready, and execute the callback."""
    chosen = executor or get_global_executor()
    with serving(chosen, node):
        chosen.spin_once(timeout_sec)


def spin_until_future_complete(
    node: Node, future: Future, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Execute a node's callbacks until a future is done or the timeout has passed.

    Unlike in ROS 2, a callback may call this function.
    """
    chosen = executor or node.executor or get_global_executor()
    with serving(chosen, node):
        chosen.spin_until_future_complete(future, timeout_sec)


def wait_for_message(
    msg_type: Any,
    node: Any,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Block until a topic's next message arrives.

    Args:
        msg_type: Message type of the topic.
        node: Node that subscribes to the topic.
        topic: Name of the topic.
        qos_profile: Quality of service of the subscription, or its depth.
        time_to_wait: Longest wait in seconds; negative for no limit.

    Returns:
        (True, the message); (False, None) at the timeout or if rclpy was shut down.
    """
    arrived = Future()

    def keep(message: Any) -> None:
        if not arrived.done():
            arrived.set_result(message)

    subscription = node.create_subscription(msg_type, topic, keep, qos_profile)
    # The waiting callback may prevent the node's other callbacks from running.
    subscription.passes_busy_group = True
    try:
        wait_for(state_of(node), arrived, None if time_to_wait < 0 else time_to_wait)
    finally:
        node.destroy_subscription(subscription)
    return arrived.done(), arrived.result()


class SignalHandlerOptions(IntEnum):
    """Signals that rclpy handles, as an option of `init`."""

    NO = 0
    ALL = 1
    SIGINT = 2
    SIGTERM = 3


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return ALL while the default context is initialised, otherwise NO."""
    started = context_of(program.current()).ok()
    return SignalHandlerOptions.ALL if started else SignalHandlerOptions.NO


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """Return a command line, by default `sys.argv`, without the parts after `--ros-args`."""
    return names.parse(list(sys.argv if args is None else args))[1]


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Convert a timeout from seconds to nanoseconds; return -1 for None or a negative timeout."""
    if timeout_sec is None or timeout_sec < 0:
        return -1
    return int(float(timeout_sec) * 1e9)


def get_rmw_implementation_identifier() -> str:
    """Return "tftool" instead of the name of a ROS 2 middleware, because none is used."""
    return "tftool"


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Check that a class is a message, service or action type.

    Raises:
        AttributeError: If the class is not generated from an interface definition.
        NoTypeSupportImportedException: If tftool does not know the definition.
    """
    if _is_message(msg_or_srv_type) or _has(msg_or_srv_type, "Request", "Goal"):
        return
    _ = type(msg_or_srv_type)._TYPE_SUPPORT
    raise NoTypeSupportImportedException


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Check that a class is a message type.

    Raises:
        RuntimeError: If the class is not a message type.
    """
    if not _is_message(msg_type):
        raise RuntimeError(f"The message type provided is not valid ({msg_type})")


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Check that a class is a service type.

    Raises:
        RuntimeError: If the class is not a service type.
    """
    if not _has(srv_type, "Request"):
        raise RuntimeError(f"The service type provided is not valid ({srv_type})")


def _is_message(kind: Any) -> bool:
    return isinstance(kind, type) and hasattr(kind, "get_fields_and_field_types")


def _has(kind: Any, *parts: str) -> bool:
    return isinstance(kind, type) and any(_is_message(getattr(kind, part, None)) for part in parts)
