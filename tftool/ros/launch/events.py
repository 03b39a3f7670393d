"""launch's events and who handles them."""

from collections.abc import Callable
from typing import Any


class Event:
    """Something that happened."""

    name = "Event"


class Shutdown(Event):
    """The launch ends."""

    name = "Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.reason = reason
        self.due_to_sigint = due_to_sigint


class ProcessStarted(Event):
    """A process began."""

    name = "ProcessStarted"

    def __init__(self, *, action: Any, process_name: str) -> None:
        self.action = action
        self.process_name = process_name


class ProcessExited(Event):
    """A process ended.

    Attributes:
        returncode: Its exit status.
    """

    name = "ProcessExited"

    def __init__(self, *, action: Any, process_name: str, returncode: int) -> None:
        self.action = action
        self.process_name = process_name
        self.returncode = returncode


class ProcessIO(Event):
    """A process has written a line.

    Attributes:
        text: The line, as bytes.
        from_stdout: Whether it came from its standard output.
        from_stderr: Whether it came from its standard error.
    """

    name = "ProcessIO"
    from_stdin = False

    def __init__(self, *, action: Any, process_name: str, text: bytes, from_stdout: bool) -> None:
        self.action = action
        self.process_name = process_name
        self.text = text
        self.from_stdout = from_stdout
        self.from_stderr = not from_stdout


class ShutdownProcess(Event):
    """Processes are to end."""

    name = "ShutdownProcess"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.process_matcher = process_matcher


def matches_action(target_action: Any) -> Callable[[Any], bool]:
    """What says whether an action is a certain one."""
    return lambda action: action is target_action


class ExecutionComplete(Event):
    """An action is done."""

    name = "ExecutionComplete"

    def __init__(self, *, action: Any) -> None:
        self.action = action


def _entities(given: Any, event: Event, context: Any) -> Any:
    return given(event, context) if callable(given) else given


class EventHandler:
    """Does something when an event fits."""

    def __init__(
        self,
        *,
        matcher: Callable[[Event], bool],
        entities: Any = None,
        handle_once: bool = False,
    ) -> None:
        self._matcher = matcher
        self._given = entities
        self.handle_once = handle_once

    def matches(self, event: Event) -> bool:
        """Whether it is meant."""
        return self._matcher(event)

    def handle(self, event: Event, context: Any) -> Any:
        """What is to be done."""
        return _entities(self._given, event, context)


def _targets(action: Any, target: Any) -> bool:
    if target is None:
        return True
    if callable(target) and not hasattr(target, "execute"):
        return bool(target(action))
    return action is target


class OnProcessExit(EventHandler):
    """When a process has ended."""

    def __init__(self, *, target_action: Any = None, on_exit: Any, **kwargs: Any) -> None:
        super().__init__(
            matcher=lambda e: isinstance(e, ProcessExited) and _targets(e.action, target_action),
            entities=on_exit,
            **kwargs,
        )


class OnProcessStart(EventHandler):
    """When a process has begun."""

    def __init__(self, *, target_action: Any = None, on_start: Any, **kwargs: Any) -> None:
        super().__init__(
            matcher=lambda e: isinstance(e, ProcessStarted) and _targets(e.action, target_action),
            entities=on_start,
            **kwargs,
        )


class OnProcessIO(EventHandler):
    """When a process has written a line."""

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: Any = None,
        on_stdout: Any = None,
        on_stderr: Any = None,
        **kwargs: Any,
    ) -> None:
        def written(event: Event, context: Any) -> Any:
            given = on_stdout if isinstance(event, ProcessIO) and event.from_stdout else on_stderr
            return given(event) if callable(given) else given

        super().__init__(
            matcher=lambda e: isinstance(e, ProcessIO) and _targets(e.action, target_action),
            entities=written,
            **kwargs,
        )


class OnExecutionComplete(EventHandler):
    """When an action is done: what it starts has ended, and is not started again.

    Attributes:
        target: The action, something that says whether one is meant, or None for any.
    """

    def __init__(self, *, target_action: Any = None, on_completion: Any, **kwargs: Any) -> None:
        self.target = target_action
        super().__init__(
            matcher=lambda e: (
                isinstance(e, ExecutionComplete) and _targets(e.action, target_action)
            ),
            entities=on_completion,
            **kwargs,
        )


class OnShutdown(EventHandler):
    """When the launch ends."""

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=lambda e: isinstance(e, Shutdown), entities=on_shutdown, **kwargs)
