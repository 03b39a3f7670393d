"""Lifecycle nodes of rclpy, whose state is changed by method calls or by services."""

from collections.abc import Callable, Iterable
from enum import IntEnum
from functools import partial, wraps
from typing import Any, NamedTuple, TypeVar

from tftool.messages.classes import INTERFACES
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.topics import Publisher
from tftool.world.node_parameters import answered


class TransitionCallbackReturn(IntEnum):
    """Value that the callback of a lifecycle transition returns."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        """Return the name of the transition that follows when a callback returns this value."""
        return f"transition_{self.name.lower()}"


class LifecycleState(NamedTuple):
    """Name and number of a lifecycle state."""

    label: str
    state_id: int


class Transition(NamedTuple):
    """Lifecycle transition: number, name, state in which it starts, and state to which it leads."""

    number: int
    label: str
    start: str
    goal: str


STATES = {
    "unknown": 0,
    "unconfigured": 1,
    "inactive": 2,
    "active": 3,
    "finalized": 4,
    "configuring": 10,
    "cleaningup": 11,
    "shuttingdown": 12,
    "activating": 13,
    "deactivating": 14,
    "errorprocessing": 15,
}

CALLBACKS = {
    "configuring": "on_configure",
    "cleaningup": "on_cleanup",
    "activating": "on_activate",
    "deactivating": "on_deactivate",
    "shuttingdown": "on_shutdown",
    "errorprocessing": "on_error",
}
"""Name of the callback that runs in each transition state."""

_REQUESTS = (
    Transition(1, "configure", "unconfigured", "configuring"),
    Transition(2, "cleanup", "inactive", "cleaningup"),
    Transition(3, "activate", "inactive", "activating"),
    Transition(4, "deactivate", "active", "deactivating"),
    Transition(5, "shutdown", "unconfigured", "shuttingdown"),
    Transition(6, "shutdown", "inactive", "shuttingdown"),
    Transition(7, "shutdown", "active", "shuttingdown"),
)

# Goal states of success, failure and error, in the order of their numbers
_OUTCOMES = {
    "configuring": ("inactive", "unconfigured", "errorprocessing"),
    "cleaningup": ("unconfigured", "inactive", "errorprocessing"),
    "activating": ("active", "inactive", "errorprocessing"),
    "deactivating": ("inactive", "active", "errorprocessing"),
    "shuttingdown": ("finalized", "finalized", "errorprocessing"),
    "errorprocessing": ("unconfigured", "finalized", "finalized"),
}

GRAPH = _REQUESTS + tuple(
    Transition(10 * tens + ones, result.to_label(), start, goal)
    for tens, (start, goals) in enumerate(_OUTCOMES.items(), 1)
    for ones, (result, goal) in enumerate(zip(TransitionCallbackReturn, goals, strict=True))
)
"""All transitions between lifecycle states."""


class StateMachine:
    """State machine with the current state of a lifecycle node."""

    def __init__(self) -> None:
        self.state = LifecycleState("unconfigured", STATES["unconfigured"])

    @property
    def current_state(self) -> tuple[int, str]:
        """Number and name of the current state."""
        return self.state.state_id, self.state.label

    @property
    def available_transitions(self) -> list[Transition]:
        """Transitions that start in the current state."""
        return [one for one in GRAPH if one.start == self.state.label]

    def take(self, transition: str | int) -> Transition:
        """Change to the state that a transition leads to; return the transition.

        The transition is a name or a number.

        Raises:
            RuntimeError: If the transition does not start in the current state.
        """
        for one in self.available_transitions:
            if transition in (one.label, one.number):
                self.state = LifecycleState(one.goal, STATES[one.goal])
                return one
        possible = ", ".join(one.label for one in self.available_transitions) or "none"
        raise RuntimeError(
            f"state '{self.state.label}' has no transition '{transition}' (it has {possible})"
        )


F = TypeVar("F", bound=Callable[..., Any])

SUCCESS = TransitionCallbackReturn.SUCCESS


class ManagedEntity:
    """Object whose callbacks a lifecycle node calls at every transition of the node."""

    def _succeed(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Return SUCCESS, as the default callback of every transition."""
        return SUCCESS

    on_configure = on_cleanup = on_shutdown = on_activate = on_deactivate = on_error = _succeed


class SimpleManagedEntity(ManagedEntity):
    """Managed entity that is enabled while its lifecycle node is active."""

    _enabled = False

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Enable the entity, because the node becomes active."""
        self._enabled = True
        return SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Disable the entity, because the node becomes inactive."""
        self._enabled = False
        return SUCCESS

    @property
    def is_activated(self) -> bool:
        """Whether the entity is enabled."""
        return self._enabled

    @staticmethod
    def when_enabled(
        wrapped: F | None = None, *, when_not_enabled: Callable[[], object] | None = None
    ) -> Any:
        """Return a decorator that lets a method run only while the entity is enabled.

        Args:
            wrapped: Method to decorate; None if the decorator is used with arguments.
            when_not_enabled: Function called instead of the method while the entity is disabled.
        """

        def decorate(method: F) -> Any:
            @wraps(method)
            def guarded(self: SimpleManagedEntity, *args: Any, **kwargs: Any) -> Any:
                if self._enabled:
                    return method(self, *args, **kwargs)
                return None if when_not_enabled is None else when_not_enabled()

            return guarded

        return decorate if wrapped is None else decorate(wrapped)


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """Publisher that sends messages only while its lifecycle node is active."""

    def publish(self, msg: Any) -> None:
        """Send a message if the node is active; otherwise drop the message."""
        if self._enabled:
            super().publish(msg)


def _notifying_method(callback: str) -> Any:
    """Return the default method for a transition's callback, such as "on_activate".

    The method calls the same callback of each managed entity.
    """

    def tell(self: "LifecycleNodeMixin", state: LifecycleState) -> TransitionCallbackReturn:
        for entity in list(self._managed_entities):
            result: TransitionCallbackReturn = getattr(entity, callback)(state)
            if result is not SUCCESS:
                return result
        return SUCCESS

    tell.__name__ = callback
    tell.__doc__ = "Notify the managed entities; return the first result that is not SUCCESS."
    return tell


def _trigger_method(transition: str, change_of_state: str) -> Any:
    """Return a method of lifecycle nodes such as `trigger_activate`, which runs a transition.

    The docstring of the method contains `change_of_state`, such as "inactive to active".
    """

    def trigger(self: "LifecycleNodeMixin") -> TransitionCallbackReturn:
        return change(self, transition)

    trigger.__name__ = f"trigger_{transition}"
    trigger.__doc__ = f"Change from {change_of_state}; return the result of the callback."
    return trigger


class LifecycleNodeMixin(ManagedEntity):
    """Methods and services that make a node a lifecycle node."""

    on_configure = _notifying_method("on_configure")
    on_cleanup = _notifying_method("on_cleanup")
    on_shutdown = _notifying_method("on_shutdown")
    on_activate = _notifying_method("on_activate")
    on_deactivate = _notifying_method("on_deactivate")
    on_error = _notifying_method("on_error")

    def __init__(
        self, *, enable_communication_interface: bool = True, callback_group: Any = None
    ) -> None:
        if not isinstance(enable_communication_interface, bool):
            raise TypeError("enable_communication_interface must be True or False")
        self._state_machine = StateMachine()
        self._managed_entities: list[ManagedEntity] = []
        self._transition_events: Publisher | None = None
        if enable_communication_interface:
            _serve(self, callback_group)

    trigger_configure = _trigger_method("configure", "unconfigured to inactive")
    trigger_cleanup = _trigger_method("cleanup", "inactive to unconfigured")
    trigger_activate = _trigger_method("activate", "inactive to active")
    trigger_deactivate = _trigger_method("deactivate", "active to inactive")
    trigger_shutdown = _trigger_method("shutdown", "any state to finalized")

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Add an entity whose callbacks this node calls at every transition."""
        self._managed_entities.append(entity)

    def create_lifecycle_publisher(self, *args: Any, **kwargs: Any) -> LifecyclePublisher:
        """Create a publisher that sends messages only while this node is active."""
        node: Any = self
        publisher: LifecyclePublisher = node.create_publisher(
            *args, publisher_class=LifecyclePublisher, **kwargs
        )
        self.add_managed_entity(publisher)
        return publisher

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Destroy a lifecycle publisher; return whether the publisher belonged to this node."""
        if publisher in self._managed_entities:
            self._managed_entities.remove(publisher)
        node: Any = self
        return bool(node.destroy_publisher(publisher))


class LifecycleNode(LifecycleNodeMixin, Node):
    """Node that works only after it was configured and activated."""

    def __init__(
        self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any
    ) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(
            self, enable_communication_interface=enable_communication_interface
        )


def change(node: LifecycleNodeMixin, transition: str | int) -> TransitionCallbackReturn:
    """Run a lifecycle transition of a node; return the result of the transition's callback.

    The transition is a name or a number.

    Raises:
        RuntimeError: If the transition does not start in the node's current state.
    """
    machine = node._state_machine
    before = machine.state
    _announce(node, machine.take(transition))
    said = result = _ask(node, before)
    _announce(node, machine.take(result.to_label()))
    if said is TransitionCallbackReturn.ERROR:
        _announce(node, machine.take(_ask(node, before).to_label()))
    return said


def _ask(node: Any, before: LifecycleState) -> TransitionCallbackReturn:
    callback = CALLBACKS[node._state_machine.state.label]
    try:
        return TransitionCallbackReturn(getattr(node, callback)(before))
    except Exception as error:
        # As in ROS 2, the node goes on; ROS 2 logs nothing.
        node.get_logger().error(f"{callback} failed: {type(error).__name__}: {error}")
        return TransitionCallbackReturn.ERROR


def _announce(node: Any, taken: Transition) -> None:
    if node._transition_events is not None:
        event: Any = node._transition_events.msg_type(timestamp=node.get_clock().now().nanoseconds)
        _describe(event, taken)
        node._transition_events.publish(event)


def _describe(message: Any, transition: Transition) -> Any:
    message.transition.id, message.transition.label = transition.number, transition.label
    for state, label in (
        (message.start_state, transition.start),
        (message.goal_state, transition.goal),
    ):
        state.id, state.label = STATES[label], label
    return message


def _serve(node: Any, callback_group: Any) -> None:
    """Create the services that report and change a lifecycle node's state."""
    machine: StateMachine = node._state_machine
    described = INTERFACES.message("lifecycle_msgs/TransitionDescription")
    state_kind = INTERFACES.message("lifecycle_msgs/State")

    def change_state(asked: Any) -> bool:
        try:
            return change(node, asked.transition.label or asked.transition.id) is SUCCESS
        except RuntimeError as error:
            node.get_logger().warning(str(error))
            return False

    def state(label: str) -> Any:
        return state_kind(id=STATES[label], label=label)

    def shown(transitions: Iterable[Transition]) -> list[Any]:
        return [_describe(described(), one) for one in transitions]

    services = partial(
        answered,
        "lifecycle_msgs",
        ("change_state", "success", change_state),
        ("get_state", "current_state", lambda _: state(machine.state.label)),
        ("get_available_states", "available_states", lambda _: [state(one) for one in STATES]),
        (
            "get_available_transitions",
            "available_transitions",
            lambda _: shown(machine.available_transitions),
        ),
        (
            "get_transition_graph:GetAvailableTransitions",
            "available_transitions",
            lambda _: shown(GRAPH),
        ),
    )
    node._serve_own(services, callback_group)
    event = INTERFACES.message("lifecycle_msgs/TransitionEvent")
    node._transition_events = node.create_publisher(event, "~/transition_event", 1)
