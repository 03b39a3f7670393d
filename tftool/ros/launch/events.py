"""Events of ROS's launch, their handlers, and the queue in which they are processed."""

import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from tftool.base.errors import UsageError


class Event:
    """Base class of the events that event handlers of a launch react to."""

    name = "launch.Event"


class Shutdown(Event):
    """Event that the launch is ending."""

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.reason = reason
        self.due_to_sigint = due_to_sigint


class RunningProcessEvent(Event):
    """Base class of events about a process.

    Attributes:
        action: Action that started the process.
        process_name: Name of the process in log lines.
        cmd: Command line; empty for a program that runs inside tftool.
        cwd: Working directory; None for the working directory of the launch.
        env: Environment variables; None for the environment of the launch.
        pid: Process id; 0 for a program without a process of its own.
    """

    def __init__(
        self,
        *,
        action: Any,
        name: str,
        cmd: Sequence[str] = (),
        cwd: str | None = None,
        env: Mapping[str, str] | None = None,
        pid: int = 0,
    ) -> None:
        self.action = action
        self.process_name = name
        self.cmd = list(cmd)
        self.cwd = cwd
        self.env = None if env is None else dict(env)
        self.pid = pid


class ProcessStarted(RunningProcessEvent):
    """Event that a process has started."""

    name = "launch.events.process.ProcessStarted"


class ProcessExited(RunningProcessEvent):
    """Event that a process has ended with the exit status `returncode`."""

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **process: Any) -> None:
        super().__init__(**process)
        self.returncode = returncode


class ProcessIO(RunningProcessEvent):
    """Event that a process has written a line.

    Attributes:
        text: The line, as bytes.
        from_stdin: Whether the line went to the process's standard input.
        from_stdout: Whether the line came from the process's standard output.
        from_stderr: Whether the line came from the process's standard error.
    """

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **process: Any) -> None:
        super().__init__(**process)
        self.text = text
        self.from_stdin, self.from_stdout, self.from_stderr = (fd == one for one in range(3))


class ShutdownProcess(Event):
    """Request to end the processes that a matcher function selects."""

    name = "launch.events.process.ShutdownProcess"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.process_matcher = process_matcher


class SignalProcess(ShutdownProcess):
    """Request to send the signal `signal` to the processes that a matcher function selects."""

    name = "launch.events.process.SignalProcess"

    def __init__(self, *, signal_number: Any, process_matcher: Callable[[Any], bool]) -> None:
        super().__init__(process_matcher=process_matcher)
        is_name = isinstance(signal_number, str)
        self.signal = signal.Signals[signal_number] if is_name else signal.Signals(signal_number)

    @property
    def signal_name(self) -> str:
        """Name of the signal, such as "SIGINT"."""
        return self.signal.name


def matches_action(target_action: Any) -> Callable[[Any], bool]:
    """Return a function that returns whether its argument is `target_action`."""
    return lambda action: action is target_action


class ExecutionComplete(Event):
    """Event that an action is complete."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: Any) -> None:
        self.action = action


def _entities(given: Any, event: Event, context: Any) -> Any:
    if callable(given):
        return given(event, context)
    return [given] if hasattr(given, "visit") else given


def _as_list(entities: Any) -> list[Any]:
    """Return an event handler's actions as a list; [] for a function that computes the actions."""
    if entities is None or callable(entities):
        return []
    return list(entities) if isinstance(entities, Iterable) else [entities]


class EventHandler:
    """Handler that executes actions when a matching event occurs.

    Attributes:
        entities: Actions to execute; empty if a function computes the actions for each event.
    """

    def __init__(
        self, *, matcher: Callable[[Event], bool], entities: Any = None, handle_once: bool = False
    ) -> None:
        self._matcher = matcher
        self._entities = entities
        self.entities = _as_list(entities)
        self.handle_once = handle_once

    def matches(self, event: Event) -> bool:
        """Return whether the handler reacts to an event."""
        return self._matcher(event)

    def handle(self, event: Event, context: Any) -> Any:
        """Return the actions for an event; first remove the handler if `handle_once` is set."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return _entities(self._entities, event, context)


def _targets(action: Any, target: Any) -> bool:
    if target is None:
        return True
    if callable(target):
        return bool(target(action))
    return action is target


class TargetHandler(EventHandler):
    """Base class of handlers for one class of events, about one action or about all actions.

    Attributes:
        event: Class of the events.
        target: Action that the event must be about, or a function that returns whether it
            accepts an action; None for all actions.
    """

    event: type[Any]

    def __init__(self, target: Any, entities: Any, **kwargs: Any) -> None:
        """Create a handler for the events about a target.

        Raises:
            TypeError: If the target is neither an action nor a function that accepts actions.
        """
        if not (target is None or callable(target) or hasattr(target, "visit")):
            raise TypeError(
                f"the target_action of {type(self).__name__} must be an action, or a function that "
                f"selects actions, not {target!r}"
            )
        self.target = target
        super().__init__(matcher=self._is_meant, entities=entities, **kwargs)

    def _is_meant(self, event: Any) -> bool:
        return isinstance(event, self.event) and _targets(event.action, self.target)


class OnProcessExit(TargetHandler):
    """Handler of the event that a process has ended."""

    event = ProcessExited

    def __init__(self, *, target_action: Any = None, on_exit: Any, **kwargs: Any) -> None:
        super().__init__(target_action, on_exit, **kwargs)


class OnProcessStart(TargetHandler):
    """Handler of the event that a process has started."""

    event = ProcessStarted

    def __init__(self, *, target_action: Any = None, on_start: Any, **kwargs: Any) -> None:
        super().__init__(target_action, on_start, **kwargs)


class OnProcessIO(TargetHandler):
    """Handler of the event that a process has written a line."""

    event = ProcessIO

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: Any = None,
        on_stdout: Any = None,
        on_stderr: Any = None,
        **kwargs: Any,
    ) -> None:
        def written(event: Any, context: Any) -> Any:
            given = on_stderr
            if not event.from_stderr:
                given = on_stdout if event.from_stdout else on_stdin
            return given(event) if callable(given) else given

        super().__init__(target_action, written, **kwargs)
        self.entities = [*_as_list(on_stdout), *_as_list(on_stderr)]


class OnExecutionComplete(TargetHandler):
    """Handler of the event that an action is complete (for a process: after its last restart)."""

    event = ExecutionComplete

    def __init__(self, *, target_action: Any = None, on_completion: Any, **kwargs: Any) -> None:
        super().__init__(target_action, on_completion, **kwargs)


class OnShutdown(EventHandler):
    """Handler of the event that the launch is ending."""

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=lambda e: isinstance(e, Shutdown), entities=on_shutdown, **kwargs)


MOST_EVENTS = 1000
"""Largest number of events handled one after the other before the launch ends with an error."""


class EventQueue:
    """Queue that delays events until the current action has been executed.

    In the launch file, a handler can therefore come after the action whose events it handles.
    """

    def __init__(self, handle: Callable[[Event], object]) -> None:
        """Create a queue that passes each event to the function `handle`."""
        self._handle = handle
        self._waiting: deque[Event] = deque()
        self._is_delayed = False

    def add(self, event: Event) -> None:
        """Add an event, which is handled at once unless an action is being executed."""
        with self.delayed():
            self._waiting.append(event)

    @contextmanager
    def delayed(self) -> Iterator[None]:
        """Delay events until the end of the `with` block, then handle all delayed events.

        Raises:
            UsageError: If the handlers' actions emit further events without end.
        """
        if self._is_delayed:
            yield
            return
        self._is_delayed = True
        try:
            yield
            count = 0
            while self._waiting:
                count += 1
                if count > MOST_EVENTS:
                    raise UsageError(
                        "event handlers trigger each other without end: give each handler a "
                        "target_action"
                    )
                self._handle(self._waiting.popleft())
        finally:
            self._is_delayed = False
