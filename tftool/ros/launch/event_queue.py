"""A launch's events, told in the order in which they came."""

from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tftool.base.errors import UsageError
from tftool.ros.launch.events import Event

MOST_EVENTS = 1000
"""How many events may follow from one another at once."""


class EventQueue:
    """Holds events back while something is carried out.

    A handler may stand further down in the file than the action whose event it handles.
    """

    def __init__(self, tell: Callable[[Event], object]) -> None:
        """`tell` hands an event to the handlers that wait for it."""
        self._tell = tell
        self._waiting: deque[Event] = deque()
        self._is_held = False

    def add(self, event: Event) -> None:
        """Have an event told, at once where nothing is carried out."""
        with self.held():
            self._waiting.append(event)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Tell what happens inside this block after it, and what follows from that.

        Raises:
            UsageError: If there is no end to what follows.
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
                    raise UsageError("event handlers set each other off without end: name targets")
                self._tell(self._waiting.popleft())
        finally:
            self._is_held = False
