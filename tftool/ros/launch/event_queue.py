"""A launch's events, handled in order of arrival."""

from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tftool.base.errors import UsageError
from tftool.ros.launch.events import Event

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
