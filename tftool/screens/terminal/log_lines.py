"""Log for a person: repeated messages are shown once, with a count."""

import re
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from rich.text import Text

from tftool.base.stamps import Stamp, as_seconds
from tftool.screens.terminal.text_style import Look, wrapped
from tftool.world.log import PROBLEMS, LogRecord

MOST_LINES = 4
"""Largest number of lines of one message."""

EMPTY = "Log messages appear here."
"""Text of a log without a message."""

_STAMP = re.compile(r"\b(\d+)\.(\d{6})\b")
"""Stamp in the error of a lookup, which differs each time."""

FAR = 3600.0
"""Seconds from the start beyond which a stamp may be of another clock, and is not replaced."""


@dataclass(slots=True)
class _Entry:
    """Log message with the times at which it was logged.

    The newest times are stored in `stamps`; `forgotten` is the number of older times.
    """

    record: LogRecord
    kind: str
    stamps: deque[Stamp]
    forgotten: int = 0

    def times(self, until: Stamp) -> int:
        """Return how often the message was logged up to a time."""
        later = sum(1 for stamp in self.stamps if stamp > until)
        return 0 if later == len(self.stamps) else self.forgotten + len(self.stamps) - later

    def last(self, until: Stamp) -> Stamp:
        """Return the last time, not after `until`, at which the message was logged; 0 for never."""
        return max((stamp for stamp in self.stamps if stamp <= until), default=0)


class Journal:
    """Log in which a repeated message appears once, with the number of repetitions."""

    KEPT = 300
    STAMPS = 400
    # Repeated warnings of a node differ only in their numbers.
    _NUMBERS = re.compile(r"-?\d+(\.\d+)?")

    def __init__(self, records: Iterable[LogRecord] = ()) -> None:
        self.revision = 0
        self._entries: deque[_Entry] = deque(maxlen=self.KEPT)
        for record in records:
            self.add(record)

    def add(self, record: LogRecord) -> None:
        """Add a message of the world's log."""
        self.revision += 1
        warns = record.level in PROBLEMS
        text = (self._NUMBERS if warns else _STAMP).sub("#", record.text)
        kind = f"{record.level}\n{record.node}\n{text}"
        # Several messages may repeat alternately, so the last few lines are compared.
        for entry in list(self._entries)[-4:]:
            if entry.kind == kind:
                entry.record = record
                if len(entry.stamps) == self.STAMPS:
                    entry.stamps.popleft()
                    entry.forgotten += 1
                entry.stamps.append(record.stamp)
                return
        self._entries.append(_Entry(record, kind, deque([record.stamp])))

    def lines(
        self, until: Stamp, start: Stamp, width: int, height: int, look: Look, *, back: int = 0
    ) -> list[Text]:
        """Return the newest messages up to a time as lines, the newest at the bottom.

        Args:
            until: Time that the screen shows.
            start: Time from which seconds are counted.
            width: Width in cells.
            height: Number of lines.
            look: Colours and characters to use.
            back: Number of newest messages to omit, after scrolling back.
        """
        told = self._logged(until)
        told = told[: max(len(told) - back, 1)]
        if not told:
            return [Text(EMPTY, look.ink(look.palette.dim))]
        shown: list[Text] = []
        for entry in reversed(told):
            lines = self._entry(entry, until, start, width, look)
            shown[:0] = lines[: max(0, height - len(shown))]
            if len(shown) >= height:
                break
        return shown

    def strip(
        self, until: Stamp, start: Stamp, width: int, look: Look, *, most: int = MOST_LINES
    ) -> list[Text]:
        """Return the newest message up to a time as wrapped lines, with a hint at the log key.

        If there is room, the previous message is shown above.

        Args:
            until: Time that the screen shows.
            start: Time from which seconds are counted.
            width: Width in cells.
            look: Colours and characters to use.
            most: Largest number of lines; further text is omitted.
        """
        told = self._logged(until)
        dim = look.ink(look.palette.dim)
        more = Text.assemble(("  L", look.ink(look.palette.accent, bold=True)), (" log ", dim))
        room = max(0, width - more.cell_len)
        lines = [Text(EMPTY, dim)]
        if told:
            lines = self._entry(told[-1], until, start, max(width - 2, 1), look, first=room - 1)
        shown = [Text.assemble(" ", line) for line in lines[:most]]
        if len(lines) > most:
            shown[-1].truncate(max(0, (room if most == 1 else width) - 1))
            shown[-1].append(look.more)
        elif len(lines) < most and len(told) > 1:
            older = self._entry(told[-2], until, start, max(width - 2, 1), look, first=room - 1)
            shown.insert(0, Text.assemble(" ", older[0], look.more if len(older) > 1 else ""))
        shown[0].append(" " * max(0, room - shown[0].cell_len))
        shown[0].append_text(more)
        for line in shown:
            line.truncate(width)
        return shown

    def _logged(self, until: Stamp) -> list[_Entry]:
        """Return the messages logged up to a time, sorted by the time of the last repetition."""
        told = [entry for entry in self._entries if entry.times(until)]
        return sorted(told, key=lambda entry: entry.last(until))

    def _entry(
        self,
        entry: _Entry,
        until: Stamp,
        start: Stamp,
        width: int,
        look: Look,
        *,
        first: int | None = None,
    ) -> list[Text]:
        palette, record = look.palette, entry.record
        colors = {"WARN": palette.warning, "ERROR": palette.error, "FATAL": palette.error}
        color = colors.get(record.level, palette.text)
        last = entry.last(until)
        # The session's clock may have changed since the screen started.
        when = f"{as_seconds(last - start):.1f} " if last >= start else "- "
        indent = 2 if width < 40 else 7
        when = when.rjust(indent)
        count = entry.times(until)
        times = f" {'x' if look.ascii_only else '×'}{count}" if count > 1 else ""
        words = f"{record.node}: {since_start(record.text, start)}"
        # The first line follows the time, the other lines are indented.
        room = max(8, (width if first is None else first) - len(when))
        lines = wrapped(words, max(8, width - indent), look.ink(color), first=room)
        lines[0] = Text.assemble((when, look.ink(palette.dim)), lines[0])
        is_cut = len(lines) > MOST_LINES
        lines[1:] = [Text.assemble(" " * indent, line) for line in lines[1:MOST_LINES]]
        if is_cut:
            lines[-1].truncate(max(0, width - len(times) - 1))
            lines[-1].append(look.more, look.ink(color))
        if times:
            lines[-1].truncate(max(0, width - len(times)))
            lines[-1].append(times, look.ink(palette.accent, bold=True))
        return lines


def since_start(text: str, start: Stamp) -> str:
    """Replace the stamps in a lookup's error by seconds since the start.

    Only stamps near `start` are replaced.
    """
    return _STAMP.sub(_seconds_since(start), text)


def _seconds_since(start: Stamp) -> Callable[[re.Match[str]], str]:
    """Return a replacement function for `re.sub` that converts a matched stamp to seconds.

    The seconds are counted from `start`; a stamp far from `start` stays unchanged.
    """

    def told(found: re.Match[str]) -> str:
        since = int(found[1]) + int(found[2]) / 1e6 - as_seconds(start)
        return f"{since:.2f} s" if abs(since) < FAR else found[0]

    return told
