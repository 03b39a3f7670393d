"""What nodes have to say, kept for screens and handed to whoever listens."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

from tftool.stamps import NANOSECONDS, Stamp

Level = Literal["DEBUG", "INFO", "WARN", "ERROR", "FATAL"]

LEVELS: tuple[Level, ...] = get_args(Level)
"""From what hardly matters to what ends everything."""

PROBLEMS: tuple[Level, ...] = ("WARN", "ERROR", "FATAL")
"""The levels of what a user should hear of, whoever says it."""


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One line of a log.

    Attributes:
        stamp: When it was said, by the world's clock.
        level: How much it matters.
        node: Who said it.
        text: What was said. It may hold strangers' names: escape it where it is shown.
        program: The program whose node it is, where several are told apart: two of them may
            have nodes of one name.
    """

    stamp: Stamp
    level: Level
    node: str
    text: str
    program: str = ""

    def __str__(self) -> str:
        """The line as ROS 2's console shows it; a logger's name has dots for a node's slashes."""
        second, rest = divmod(self.stamp, NANOSECONDS)
        logger = self.node.replace("/", ".")
        return f"[{self.level}] [{second}.{rest:09d}] [{logger}]: {self.text}"


class Log:
    """The last thousand lines, and those who want each as it comes."""

    def __init__(self, now: Callable[[], Stamp], keep: int = 1000) -> None:
        self.records: deque[LogRecord] = deque(maxlen=keep)
        self._now = now
        self._listeners: tuple[Callable[[LogRecord], object], ...] = ()

    def listen(self, callback: Callable[[LogRecord], object]) -> Callable[[], None]:
        """Have `callback` called with every line to come; call what is returned to stop."""
        self._listeners = (*self._listeners, callback)

        def stop() -> None:
            self._listeners = tuple(one for one in self._listeners if one is not callback)

        return stop

    def debug(self, node: str, text: str) -> None:
        """Say something for whoever looks for a fault."""
        self.add("DEBUG", node, text)

    def info(self, node: str, text: str) -> None:
        """Say what happens."""
        self.add("INFO", node, text)

    def warn(self, node: str, text: str) -> None:
        """Say what is odd."""
        self.add("WARN", node, text)

    def error(self, node: str, text: str) -> None:
        """Say what went wrong."""
        self.add("ERROR", node, text)

    def add(self, level: Level, node: str, text: str, *, program: str = "") -> None:
        """Keep a line and hand it on."""
        record = LogRecord(self._now(), level, node, text, program)
        self.records.append(record)
        for listener in self._listeners:
            listener(record)
