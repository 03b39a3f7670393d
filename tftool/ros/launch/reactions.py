"""launch's actions that log, wait for events, or emit them."""

from typing import Any

from tftool.base.errors import UsageError
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import Action
from tftool.ros.launch.events import Event, EventHandler, OnExecutionComplete
from tftool.ros.launch.events import Shutdown as ShutdownEvent
from tftool.ros.launch.substitutions import perform


class LogInfo(Action):
    """Logs a message."""

    def __init__(self, *, msg: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.msg = msg

    def execute(self, context: LaunchContext) -> Any:
        """Log the message."""
        context.launch.info(perform(context, self.msg))


class RegisterEventHandler(Action):
    """Registers an event handler."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[Any]]]:
        """Return what the handler does, as far as it is known before."""
        return [(type(self.event_handler).__name__, getattr(self.event_handler, "entities", []))]

    def execute(self, context: LaunchContext) -> Any:
        """Register the handler."""
        context.launch.handlers.append(self.event_handler)
        handler = self.event_handler
        if isinstance(handler, OnExecutionComplete) and getattr(handler.target, "is_begun", False):
            context.launch.warn(
                "this OnExecutionComplete is never called, as in ROS 2: its "
                f"{_kind(handler.target)} was executed before. Register it above its "
                "target_action"
            )


def _kind(value: Any) -> str:
    return type(value).__name__


class UnregisterEventHandler(Action):
    """Removes an event handler."""

    def __init__(self, event_handler: EventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> Any:
        """Remove the handler."""
        if self.event_handler in context.launch.handlers:
            context.launch.handlers.remove(self.event_handler)


class EmitEvent(Action):
    """Emits an event."""

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event = event

    def execute(self, context: LaunchContext) -> Any:
        """Emit the event.

        Raises:
            UsageError: If it is none.
        """
        if not isinstance(self.event, Event):
            action = " of launch.actions" if isinstance(self.event, Action) else ""
            raise UsageError(f"EmitEvent needs an event, not a {_kind(self.event)}{action}")
        context.launch.emit(self.event)


class Shutdown(Action):
    """Ends the launch."""

    def __init__(self, *, reason: Any = "reason not given", **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.reason = reason

    def execute(self, context: LaunchContext) -> Any:
        """End the launch."""
        context.launch.emit(ShutdownEvent(reason=perform(context, self.reason)))
