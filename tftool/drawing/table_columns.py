"""Columns of a table that fit a terminal's width, and text in a fixed number of cells."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from rich.cells import cell_len
from rich.text import Text

from tftool.base.plain_text import visible

GAP = 2
"""Cells between two columns."""

Cell: TypeAlias = tuple[str, str]
"""Text of a cell, and its style."""


@dataclass(frozen=True, slots=True)
class TableColumn:
    """One column of a table.

    Attributes:
        heading: Text above the cells.
        cells: Text and style of the cell in each row.
        align_right: Whether to align the cells to the right, as for numbers.
        caps: Maximum widths, from wide to narrow, to which the column shrinks before it is dropped.
        drop_order: Rank, from 1, in which a narrow table drops the column; 0 for never.
    """

    heading: str
    cells: Sequence[Cell]
    align_right: bool = False
    caps: tuple[int, ...] = ()
    drop_order: int = 0

    @property
    def width(self) -> int:
        """Width of the column in cells, at most the first of `caps`."""
        longest = max(map(cell_len, [self.heading, *(text for text, _ in self.cells)]))
        return min([longest, *self.caps[:1]])

    def written(self, text: str, width: int, more: str) -> str:
        """Cut or pad a text to exactly `width` cells."""
        shown = middle_cut(text, width, more=more)
        room = " " * (width - cell_len(shown))
        return room + shown if self.align_right else shown + room


@dataclass(frozen=True, slots=True)
class FittedColumns:
    """Columns of a table that fit a width, to the right of a first column.

    Attributes:
        columns: Columns from left to right.
        widths: Width of each column in cells.
        first_width: Width of the first column in cells.
        more: Sign that replaces omitted text.
    """

    columns: tuple[TableColumn, ...]
    widths: tuple[int, ...]
    first_width: int
    more: str = "…"

    @property
    def width(self) -> int:
        """Width of the longest line in cells."""
        return self.first_width + sum(GAP + width for width in self.widths)

    def heading(self, first: str) -> Text:
        """Return the line of headings; `first` is the first column's heading."""
        shown = middle_cut(first, self.first_width, more=self.more)
        line = shown + " " * (self.first_width - cell_len(shown))
        for one, width in zip(self.columns, self.widths, strict=True):
            line += " " * GAP + one.written(one.heading, width, self.more)
        return Text(line.rstrip(), style="dim")

    def row(self, index: int, first: Text) -> Text:
        """Return the line of the row `index`; `first` is the first column's text."""
        line = Text(no_wrap=True, overflow="crop").append_text(first)
        line.append(" " * (self.first_width - first.cell_len))
        for one, width in zip(self.columns, self.widths, strict=True):
            text, style = one.cells[index]
            line.append(" " * GAP).append(one.written(text, width, self.more), style=style)
        line.rstrip()
        return line


def fit(
    columns: Sequence[TableColumn], width: int, *, reserved: int, longest: int, more: str = "…"
) -> FittedColumns:
    """Narrow or drop columns until at least `reserved` cells are left for the first column.

    Args:
        columns: Columns from left to right; a column without text is left out.
        width: Width of the table in cells.
        reserved: Cells to reserve for the first column.
        longest: Maximum number of cells that the first column can use.
        more: Sign that replaces omitted text.
    """
    kept = [one for one in columns if any(text for text, _ in one.cells)]
    while True:
        room = width - sum(one.width + GAP for one in kept)
        going = [one for one in kept if one.drop_order]
        if room >= reserved or not going:
            widths = tuple(one.width for one in kept)
            return FittedColumns(tuple(kept), widths, min(max(1, room), longest), more)
        column = min(going, key=lambda one: one.drop_order)
        place = kept.index(column)
        tighter = tuple(cap for cap in column.caps if cap < column.width)
        kept[place : place + 1] = [replace(column, caps=tighter)] if tighter else []


# Joiners and variation selectors, which change a character's width in some terminals only.
# Without them the computed width is right on every terminal.
_SWITCHES = dict.fromkeys((0x200C, 0x200D, *range(0xFE00, 0xFE10)))


def plain(text: str) -> str:
    """Escape a text to one line whose width in cells is the same on every terminal."""
    if text.isascii() and text.isprintable():
        return text
    return visible(text).translate(_SWITCHES)


def fitted(text: str, width: int, *, more: str = "…") -> str:
    """Return a text as one line of at most `width` cells; `more` replaces the omitted end."""
    # Measure only the beginning of a long text.
    shown = plain(text[: 4 * max(0, width) + 4])
    if cell_len(shown) <= width:
        return shown
    room = width - cell_len(more)
    if room < 0:
        return ""
    kept, used = 0, 0
    for sign in shown:
        used += cell_len(sign)
        if used > room:
            break
        kept += 1
    return shown[:kept] + more


def middle_cut(text: str, width: int, *, more: str = "…") -> str:
    """Return a text as one line of at most `width` cells; `more` replaces an omitted middle."""
    shown = plain(text)
    if cell_len(shown) <= width:
        return shown
    room = width - cell_len(more)
    if room < 0:
        return ""
    end = _within(reversed(shown), room // 2)
    start = _within(shown, room - sum(map(cell_len, end)))
    return "".join(start) + more + "".join(reversed(end))


def _within(signs: Iterable[str], width: int) -> list[str]:
    """Return as many characters from the beginning of `signs` as fit into `width` cells."""
    kept = []
    for sign in signs:
        width -= cell_len(sign)
        if width < 0:
            break
        kept.append(sign)
    return kept


def wrap_words(sentence: str, width: int) -> list[str]:
    """Wrap a sentence at spaces only, into lines of at most `width` cells.

    A word longer than a line gets a line of its own, uncut.
    """
    lines = [""]
    for word in sentence.split(" "):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if lines[-1] and cell_len(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def rest_of_list(below: int, above: int, *, ascii_only: bool) -> str:
    """Return how many rows of a list are hidden below and above, as text; "" if none."""
    up, down = ("^", "v") if ascii_only else ("↑", "↓")
    words = [f"{down} {below} more"] if below else []
    return "   ".join(words + ([f"{up} {above} above"] if above else []))


def padded(text: str, width: int, *, more: str = "…") -> str:
    """Return a text as one line of exactly `width` cells, cut or padded with spaces."""
    shown = fitted(text, width, more=more)
    return shown + " " * (width - cell_len(shown))
