"""launch's events, their handlers, and the queue in which they are handled."""

import signal
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from tftool.base.errors import UsageError


class Event:
    """Something that happened."""

    name = "launch.Event"


class Shutdown(Event):
    """Event of the end of the launch."""

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.reason = reason
        self.due_to_sigint = due_to_sigint


class RunningProcessEvent(Event):
    """Event about a process.

    Attributes:
        action: Action that started it.
        process_name: Name in the log.
        cmd: Command line; empty for a program of the session.
        cwd: Folder, None for that of the launch.
        env: Environment, None for that of the launch.
        pid: Process number, 0 for a program without a process.
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
    """Event of a process's start."""

    name = "launch.events.process.ProcessStarted"


class ProcessExited(RunningProcessEvent):
    """Event of a process's end.

    Attributes:
        returncode: Exit status.
    """

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **process: Any) -> None:
        super().__init__(**process)
        self.returncode = returncode


class ProcessIO(RunningProcessEvent):
    """Event of a line written by a process.

    Attributes:
        text: The line, as bytes.
        from_stdin: Whether it went to its standard input.
        from_stdout: Whether the text came from the standard output.
        from_stderr: Whether the text came from the standard error.
    """

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **process: Any) -> None:
        super().__init__(**process)
        self.text = text
        self.from_stdin, self.from_stdout, self.from_stderr = (fd == one for one in range(3))


class ShutdownProcess(Event):
    """Event that asks processes to end."""

    name = "launch.events.process.ShutdownProcess"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.process_matcher = process_matcher


class SignalProcess(ShutdownProcess):
    """Event that sends a signal to processes.

    Attributes:
        signal: Number.
    """

    name = "launch.events.process.SignalProcess"

    def __init__(self, *, signal_number: Any, process_matcher: Callable[[Any], bool]) -> None:
        super().__init__(process_matcher=process_matcher)
        is_name = isinstance(signal_number, str)
        self.signal = signal.Signals[signal_number] if is_name else signal.Signals(signal_number)

    @property
    def signal_name(self) -> str:
        """Return the signal's name."""
        return self.signal.name


def matches_action(target_action: Any) -> Callable[[Any], bool]:
    """Return a matcher for one action."""
    return lambda action: action is target_action


class ExecutionComplete(Event):
    """Event of an action's completion."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: Any) -> None:
        self.action = action


def _entities(given: Any, event: Event, context: Any) -> Any:
    if callable(given):
        return given(event, context)
    return [given] if hasattr(given, "visit") else given


def _listed(given: Any) -> list[Any]:
    """Return the entities in what a handler was given; none of a function's."""
    found = [given] if hasattr(given, "visit") else given
    return [] if found is None or callable(found) else list(found)


class EventHandler:
    """Does something when a matching event occurs.

    Attributes:
        entities: Entities to execute then, as far as known before.
    """

    def __init__(
        self,
        *,
        matcher: Callable[[Event], bool],
        entities: Any = None,
        handle_once: bool = False,
    ) -> None:
        self._matcher = matcher
        self._given = entities
        self.entities = _listed(entities)
        self.handle_once = handle_once

    def matches(self, event: Event) -> bool:
        """Whether the handler reacts to this event."""
        return self._matcher(event)

    def handle(self, event: Event, context: Any) -> Any:
        """Return the next actions, which know the event; a handler for once is removed."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return _entities(self._given, event, context)


def _targets(action: Any, target: Any) -> bool:
    if target is None:
        return True
    if callable(target):
        return bool(target(action))
    return action is target


class TargetHandler(EventHandler):
    """Handler of events of one kind about an action.

    Attributes:
        event: The kind.
        target: The action, a function that says whether one is meant, or None for any.
    """

    event: type[Any]

    def __init__(self, target: Any, entities: Any, **kwargs: Any) -> None:
        """Handle the events of a target.

        Raises:
            TypeError: If that is neither an action nor a function that selects actions.
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
    """Handler of the end of a process."""

    event = ProcessExited

    def __init__(self, *, target_action: Any = None, on_exit: Any, **kwargs: Any) -> None:
        super().__init__(target_action, on_exit, **kwargs)


class OnProcessStart(TargetHandler):
    """Handler of the start of a process."""

    event = ProcessStarted

    def __init__(self, *, target_action: Any = None, on_start: Any, **kwargs: Any) -> None:
        super().__init__(target_action, on_start, **kwargs)


class OnProcessIO(TargetHandler):
    """Handler of a line written by a process."""

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
        self.entities = [*_listed(on_stdout), *_listed(on_stderr)]


class OnExecutionComplete(TargetHandler):
    """Handler of an action's end: what it started has ended, and is not started again."""

    event = ExecutionComplete

    def __init__(self, *, target_action: Any = None, on_completion: Any, **kwargs: Any) -> None:
        super().__init__(target_action, on_completion, **kwargs)


class OnShutdown(EventHandler):
    """Handler of the end of the launch."""

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=lambda e: isinstance(e, Shutdown), entities=on_shutdown, **kwargs)


MOST_EVENTS = 1000
"""How many events may follow from one another at once."""


class EventQueue:
    """Queue that delays events while an action is executed.

    A handler may stand further down in the file than the action whose event it handles.
    """

    def __init__(self, tell: Callable[[Event], object]) -> None:
        """Make a queue; `tell` passes an event to the matching handlers."""
        self._tell = tell
        self._waiting: deque[Event] = deque()
        self._is_held = False

    def add(self, event: Event) -> None:
        """Queue an event; without a running action it is handled at once."""
        with self.held():
            self._waiting.append(event)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Delay events from inside this block until after it.

        Raises:
            UsageError: If the events cause each other without end.
        """
        if self._is_held:
            yield
            return
        self._is_held = True
        try:
            yield
            told = 0
            while self._waiting:
                told += 1
                if told > MOST_EVENTS:
                    raise UsageError("event handlers trigger each other without end: name targets")
                self._tell(self._waiting.popleft())
        finally:
            self._is_held = False
