"""Log messages of nodes, stored for screens and passed to listeners."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal, get_args

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.callbacks import Listeners, Report

Level = Literal["DEBUG", "INFO", "WARN", "ERROR", "FATAL"]

LEVELS: tuple[Level, ...] = get_args(Level)
"""Severities of log messages, in ascending order."""

PROBLEMS: tuple[Level, ...] = ("WARN", "ERROR", "FATAL")
"""Severities that a user should see, from any node."""


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One log message.

    Attributes:
        stamp: Time of the message on the world's clock, nanoseconds.
        level: Severity.
        node: Name of the node that logged the message.
        text: Text of the message. It can contain names from other processes, so escape the text for
            display.
        program: Name of the node's program; two programs can have nodes of the same name.
    """

    stamp: Stamp
    level: Level
    node: str
    text: str
    program: str = ""

    def __str__(self) -> str:
        """Return the message in the format of ROS 2's console, with dots for slashes in names."""
        second, rest = divmod(self.stamp, NANOSECONDS)
        logger = self.node.replace("/", ".")
        return f"[{self.level}] [{second}.{rest:09d}] [{logger}]: {self.text}"


MOST_KINDS: Final = 20
"""Number of kinds of messages that are counted separately; further kinds are counted together."""


class Repeats:
    """Counter of similar log messages: the 1st, 10th, 100th and so on are logged."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}

    def said(self, kind: str, text: str) -> str:
        """Count a message; return the text if the message should be logged, else "".

        Args:
            kind: Part that similar messages have in common.
            text: Text of the message.
        """
        others = kind not in self._counts and len(self._counts) >= MOST_KINDS
        if others:
            kind = ""
        count = self._counts[kind] = self._counts.get(kind, 0) + 1
        if math.log10(count) % 1:
            return ""
        if others:
            return (
                f"{text} ({count} similar messages with other names)"
                if count > 1
                else (f"{text} (similar messages are counted)")
            )
        return text if count == 1 else f"{text} ({count} times so far)"


class Log:
    """Store of the last log messages, which passes each new message to listeners."""

    def __init__(
        self, now: Callable[[], Stamp], keep: int = 1000, report: Report | None = None
    ) -> None:
        """Create an empty log.

        Args:
            now: Function that returns the time of a new message.
            keep: Number of messages to store.
            report: Function called with an exception of a listener; see `Listeners`.
        """
        self.records: deque[LogRecord] = deque(maxlen=keep)
        self._now = now
        self._listeners: Listeners[LogRecord] = Listeners(report)

    def listen(
        self, callback: Callable[[LogRecord], object], owner: str = ""
    ) -> Callable[[], None]:
        """Call `callback` with every further message; return a function that ends the calls.

        Exceptions of the callback are reported under the name `owner`.
        """
        return self._listeners.add(callback, owner)

    def debug(self, node: str, text: str) -> None:
        """Log a message of a node with level DEBUG."""
        self.add("DEBUG", node, text)

    def info(self, node: str, text: str) -> None:
        """Log a message of a node with level INFO."""
        self.add("INFO", node, text)

    def warn(self, node: str, text: str) -> None:
        """Log a message of a node with level WARN."""
        self.add("WARN", node, text)

    def error(self, node: str, text: str) -> None:
        """Log a message of a node with level ERROR."""
        self.add("ERROR", node, text)

    def add(self, level: Level, node: str, text: str, *, program: str = "") -> None:
        """Store a message, and pass the message to the listeners."""
        record = LogRecord(self._now(), level, node, text, program)
        self.records.append(record)
        self._listeners.call(record)
