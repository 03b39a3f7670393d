"""The log as a person wants to read it."""

import re
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

from rich.text import Text

from tftool.runtime.log import PROBLEMS, LogRecord
from tftool.screens.look import Look, wrapped
from tftool.stamps import Stamp, as_seconds


@dataclass(slots=True)
class _Entry:
    first: LogRecord
    last: LogRecord
    kind: str
    times: int = 1


class Journal:
    """The log as a person wants it: what repeats is one line with a count."""

    KEPT = 300
    # What a node warns of again and again differs in its numbers.
    _NUMBERS = re.compile(r"-?\d+(\.\d+)?")

    def __init__(self, records: Iterable[LogRecord] = ()) -> None:
        self.revision = 0
        self._entries: deque[_Entry] = deque(maxlen=self.KEPT)
        for record in records:
            self.add(record)

    def add(self, record: LogRecord) -> None:
        """Take in a line of the world's log."""
        self.revision += 1
        warns = record.level in PROBLEMS
        text = self._NUMBERS.sub("#", record.text) if warns else record.text
        kind = f"{record.level}\n{record.node}\n{text}"
        # Those that repeat themselves take turns: the last few lines are looked at.
        for entry in list(self._entries)[-4:]:
            if entry.kind == kind:
                entry.last = record
                entry.times += 1
                return
        self._entries.append(_Entry(record, record, kind))

    def lines(
        self, until: Stamp, start: Stamp, width: int, height: int, look: Look, *, back: int = 0
    ) -> list[Text]:
        """Show the newest lines up to a moment, the newest at the bottom.

        Args:
            until: The moment shown.
            start: The moment that counts as 0.
            width: Cells across.
            height: Lines.
            look: How to paint.
            back: How many of the newest lines to leave out.
        """
        told = [entry for entry in self._entries if entry.first.stamp <= until]
        told = told[: max(len(told) - back, 1)]
        if not told:
            return [Text("Nothing was said yet.", look.ink(look.palette.dim))]
        shown: list[Text] = []
        for entry in reversed(told):
            lines = self._entry(entry, start, width, look)
            shown[:0] = lines[: max(0, height - len(shown))]
            if len(shown) >= height:
                break
        return shown

    def _entry(self, entry: _Entry, start: Stamp, width: int, look: Look) -> list[Text]:
        palette = look.palette
        colors = {"WARN": palette.warning, "ERROR": palette.error, "FATAL": palette.error}
        color = colors.get(entry.last.level, palette.text)
        when = f"{as_seconds(entry.last.stamp - start):.1f} "
        indent = 2 if width < 40 else 7
        when = when.rjust(indent)
        times = f" {'x' if look.ascii_only else '×'}{entry.times}" if entry.times > 1 else ""
        words = f"{entry.last.node}: {entry.last.text}"
        # The first line shares its place with the time, the others stand a little in.
        lines = wrapped(
            words, max(8, width - indent), look.ink(color), first=max(8, width - len(when))
        )
        lines[0] = Text.assemble((when, look.ink(palette.dim)), lines[0])
        lines[1:] = [Text.assemble(" " * indent, line) for line in lines[1:3]]
        if times:
            lines[-1].truncate(max(0, width - len(times)))
            lines[-1].append(times, look.ink(palette.accent, bold=True))
        return lines
