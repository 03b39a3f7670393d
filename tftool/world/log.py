"""Log lines of nodes, kept for screens and passed to listeners."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal, get_args

from tftool.base.listeners import Listeners, Report
from tftool.base.stamps import NANOSECONDS, Stamp

Level = Literal["DEBUG", "INFO", "WARN", "ERROR", "FATAL"]

LEVELS: tuple[Level, ...] = get_args(Level)
"""From what hardly matters to what ends everything."""

PROBLEMS: tuple[Level, ...] = ("WARN", "ERROR", "FATAL")
"""Levels that a user should see, from any node."""


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One line of a log.

    Attributes:
        stamp: Time of the record, by the world's clock.
        level: Severity of the record.
        node: Node that logged it.
        text: The logged text. It may hold strangers' names: escape it where it is shown.
        program: Program of the node, if there are several: two of them may
            have nodes of one name.
    """

    stamp: Stamp
    level: Level
    node: str
    text: str
    program: str = ""

    def __str__(self) -> str:
        """Return the line in the form of ROS 2's console; a logger's name has dots for slashes."""
        second, rest = divmod(self.stamp, NANOSECONDS)
        logger = self.node.replace("/", ".")
        return f"[{self.level}] [{second}.{rest:09d}] [{logger}]: {self.text}"


MOST_KINDS: Final = 20
"""How many kinds of line of one origin are told apart; further ones are counted together."""


class Repeats:
    """Counter of similar lines: the first is logged, then the 10th, the 100th and so on."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}

    def said(self, kind: str, text: str) -> str:
        """Count a line; return the text to log, "" if it is only counted.

        Args:
            kind: The common part of similar lines.
            text: The line.
        """
        others = kind not in self._counts and len(self._counts) >= MOST_KINDS
        if others:
            kind = ""
        count = self._counts[kind] = self._counts.get(kind, 0) + 1
        if math.log10(count) % 1:
            return ""
        if others:
            return (
                f"{text} ({count} more like it, of other names)"
                if count > 1
                else (f"{text} (others like it are counted)")
            )
        return text if count == 1 else f"{text} ({count} times so far)"


class Log:
    """The last thousand lines, and listeners for each new one."""

    def __init__(
        self, now: Callable[[], Stamp], keep: int = 1000, report: Report | None = None
    ) -> None:
        """Start empty.

        Args:
            now: Gives the stamp of a line.
            keep: Number of lines are kept.
            report: Called with an exception of a listener; see `Listeners`.
        """
        self.records: deque[LogRecord] = deque(maxlen=keep)
        self._now = now
        self._listeners: Listeners[LogRecord] = Listeners(report)

    def listen(
        self, callback: Callable[[LogRecord], object], owner: str = ""
    ) -> Callable[[], None]:
        """Call `callback` with every further line until the returned function is called.

        What it raises is reported under the name of its `owner`.
        """
        return self._listeners.add(callback, owner)

    def debug(self, node: str, text: str) -> None:
        """Log a line for debugging."""
        self.add("DEBUG", node, text)

    def info(self, node: str, text: str) -> None:
        """Log information."""
        self.add("INFO", node, text)

    def warn(self, node: str, text: str) -> None:
        """Log a warning."""
        self.add("WARN", node, text)

    def error(self, node: str, text: str) -> None:
        """Log an error."""
        self.add("ERROR", node, text)

    def add(self, level: Level, node: str, text: str, *, program: str = "") -> None:
        """Store a line and pass it on."""
        record = LogRecord(self._now(), level, node, text, program)
        self.records.append(record)
        self._listeners.call(record)
