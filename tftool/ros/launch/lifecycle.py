"""Actions, events and event handlers of launch_ros for lifecycle nodes."""

import itertools
from collections.abc import Callable, Iterable
from typing import Any

from tftool.base.errors import UsageError
from tftool.messages.classes import INTERFACES
from tftool.ros.launch.actions import EmitEvent, RegisterEventHandler
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.events import Event, EventHandler
from tftool.ros.launch.nodes import Node
from tftool.ros.launch.processes import ExecuteProcess
from tftool.ros.launch.scope import make_namespace_absolute, namespace_in
from tftool.ros.launch.substitutions import perform

_TRANSITIONS = {
    "create": 0,
    "configure": 1,
    "cleanup": 2,
    "activate": 3,
    "deactivate": 4,
    "unconfigured_shutdown": 5,
    "inactive_shutdown": 6,
    "active_shutdown": 7,
    "destroy": 8,
}
"""Numbers of the lifecycle transitions in lifecycle_msgs, by label."""


class ChangeState(Event):
    """Request to change the state of the lifecycle nodes that a matcher function selects."""

    name = "launch_ros.events.lifecycle.ChangeState"

    def __init__(
        self, *, lifecycle_node_matcher: Callable[[Any], bool], transition_id: int
    ) -> None:
        self.lifecycle_node_matcher = lifecycle_node_matcher
        self.transition_id = transition_id


class StateTransition(Event):
    """Event that a lifecycle node has changed its state."""

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: Any, msg: Any) -> None:
        self.action = action
        self.msg = msg

    @property
    def start_state(self) -> str:
        """Label of the previous state."""
        return str(self.msg.start_state.label)

    @property
    def goal_state(self) -> str:
        """Label of the new state."""
        return str(self.msg.goal_state.label)


class OnStateTransition(EventHandler):
    """Handler of the event that a lifecycle node has changed its state."""

    def __init__(
        self,
        *,
        entities: Any,
        target_lifecycle_node: Any = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        **kwargs: Any,
    ) -> None:
        def matches(event: Event) -> bool:
            return (
                isinstance(event, StateTransition)
                and target_lifecycle_node in (None, event.action)
                and transition in (None, event.msg.transition.label)
                and start_state in (None, event.start_state)
                and goal_state in (None, event.goal_state)
            )

        super().__init__(matcher=matches, entities=entities, **kwargs)


class LifecycleNode(Node):
    """Action that starts a lifecycle node, and activates it if `autostart` is set."""

    def __init__(
        self, *, name: Any, namespace: Any, autostart: bool = False, **kwargs: Any
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.autostart = autostart

    def execute(self, context: LaunchContext) -> Any:
        """Start the node, and emit a StateTransition event for each change of its state."""
        self._perform_substitutions(context)
        context.launch.handlers.append(
            EventHandler(matcher=self._is_meant, entities=lambda event, _: [self._change(event)])
        )
        kind = INTERFACES.message("lifecycle_msgs/TransitionEvent")
        context.launch.watch_topic(
            f"{self.node_name.strip('/')}/transition_event",
            kind,
            lambda message: context.launch.emit(StateTransition(action=self, msg=message)),
        )
        super().execute(context)
        if not self.autostart:
            return None
        return LifecycleTransition(
            lifecycle_node_names=[self.node_name], transition_ids=[1, 3]
        ).execute(context)

    def _is_meant(self, event: Event) -> bool:
        return isinstance(event, ChangeState) and event.lifecycle_node_matcher(self)

    def _change(self, event: Any) -> ExecuteProcess:
        return change_state(self.node_name, event.transition_id)


def change_state(node: str, transition: int) -> ExecuteProcess:
    """Return an action that requests a transition of a lifecycle node by `ros2 service call`."""
    request = f"{{transition: {{id: {transition}}}}}"
    words = ["service", "call", f"{node}/change_state", "lifecycle_msgs/srv/ChangeState", request]
    return ExecuteProcess(cmd=["ros2", *words])


def matches_node_name(node_name: str) -> Callable[[Any], bool]:
    """Return a function that tests whether an action starts the node `node_name`."""
    full = make_namespace_absolute(node_name)
    return lambda action: getattr(action, "node_name", None) == full


class LifecycleTransition(Action):
    """Action that requests several transitions, one after the other, from lifecycle nodes."""

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[Any],
        transition_ids: Iterable[Any] | None = None,
        transition_labels: Iterable[Any] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.lifecycle_node_names = list(lifecycle_node_names)
        self.transition_ids = list(transition_ids or ())
        self.transition_labels = list(transition_labels or ())
        if not self.lifecycle_node_names or not (self.transition_ids or self.transition_labels):
            raise ValueError("a LifecycleTransition needs lifecycle_node_names and transitions")

    def execute(self, context: LaunchContext) -> Any:
        """Return actions that request each transition after the previous transition has ended."""
        numbers = [int(perform(context, one)) for one in self.transition_ids]
        for label in self.transition_labels:
            text = perform(context, label)
            if text not in _TRANSITIONS:
                known = ", ".join(_TRANSITIONS)
                raise UsageError(f"there is no transition '{text}': use one of {known}")
            numbers.append(_TRANSITIONS[text])
        following: list[Any] = []
        for node in self.lifecycle_node_names:
            full = namespace_in(context, node) or ""
            matcher = matches_node_name(full)
            for before, number in itertools.pairwise(numbers):
                change = ChangeState(lifecycle_node_matcher=matcher, transition_id=number)
                following.append(
                    RegisterEventHandler(_After(full, before, [EmitEvent(event=change)]))
                )
            first = ChangeState(lifecycle_node_matcher=matcher, transition_id=numbers[0])
            following.append(EmitEvent(event=first))
        return following


_REACHED = {1: "inactive", 2: "unconfigured", 3: "active", 4: "inactive"}
"""State that each lifecycle transition leads to, by the transition's number."""


class _After(EventHandler):
    """Handler that executes actions once, after a node has completed a transition."""

    def __init__(self, node: str, transition: int, entities: Any) -> None:
        def matches(event: Event) -> bool:
            return (
                isinstance(event, StateTransition)
                and event.action.node_name == node
                and event.goal_state == _REACHED.get(transition, "finalized")
            )

        super().__init__(matcher=matches, entities=entities, handle_once=True)
