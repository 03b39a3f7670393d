"""Columns beside the first one, as many as fit a terminal."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from rich.cells import cell_len
from rich.text import Text

from tftool.base.fixed_width import middle_cut

GAP = 2
"""Cells between two columns."""

Cell: TypeAlias = tuple[str, str]
"""Its text, and its style."""


@dataclass(frozen=True, slots=True)
class TableColumn:
    """One column of cells.

    Attributes:
        heading: Text above them.
        cells: Texts, one for each row.
        stands_right: Whether the cells are aligned to the right, as numbers are.
        caps: Maximum widths, from wide to narrow: a column shrinks before it is dropped.
        goes: Order in which columns are dropped from a narrow table; 0 for one that stays.
    """

    heading: str
    cells: Sequence[Cell]
    stands_right: bool = False
    caps: tuple[int, ...] = ()
    goes: int = 0

    @property
    def width(self) -> int:
        """Return the column's width in cells, within its first limit."""
        longest = max(map(cell_len, [self.heading, *(text for text, _ in self.cells)]))
        return min([longest, *self.caps[:1]])

    def written(self, text: str, width: int, more: str) -> str:
        """Cut or pad `text` to exactly `width` cells."""
        shown = middle_cut(text, width, more=more)
        room = " " * (width - cell_len(shown))
        return room + shown if self.stands_right else shown + room


@dataclass(frozen=True, slots=True)
class FittedColumns:
    """The columns that fit.

    Attributes:
        columns: From left to right.
        widths: Width of each column.
        room: Cells that are left for the text before them.
        more: Sign for text that was left out.
    """

    columns: tuple[TableColumn, ...]
    widths: tuple[int, ...]
    room: int
    more: str = "…"

    @property
    def width(self) -> int:
        """Width of the longest line in cells."""
        return self.room + sum(GAP + width for width in self.widths)

    def heading(self, first: str) -> Text:
        """Return the heading line; `first` is the first column's heading."""
        shown = middle_cut(first, self.room, more=self.more)
        line = shown + " " * (self.room - cell_len(shown))
        for one, width in zip(self.columns, self.widths, strict=True):
            line += " " * GAP + one.written(one.heading, width, self.more)
        return Text(line.rstrip(), style="dim")

    def row(self, place: int, first: Text) -> Text:
        """Return one row, after the first column's text `first`."""
        line = Text(no_wrap=True, overflow="crop").append_text(first)
        line.append(" " * (self.room - first.cell_len))
        for one, width in zip(self.columns, self.widths, strict=True):
            text, style = one.cells[place]
            line.append(" " * GAP).append(one.written(text, width, self.more), style=style)
        line.rstrip()
        return line


def fit(
    columns: Sequence[TableColumn], width: int, *, wanted: int, longest: int, more: str = "…"
) -> FittedColumns:
    """Keep as many columns as leave `wanted` cells for the first one.

    Args:
        columns: Columns from left to right; empty ones are always left out.
        width: Cells there are.
        wanted: Cells wanted for the first.
        longest: Most cells that the first can use.
        more: Sign for text that is left out.
    """
    kept = [one for one in columns if any(text for text, _ in one.cells)]
    while True:
        room = width - sum(one.width + GAP for one in kept)
        going = [one for one in kept if one.goes]
        if room >= wanted or not going:
            widths = tuple(one.width for one in kept)
            return FittedColumns(tuple(kept), widths, min(max(1, room), longest), more)
        column = min(going, key=lambda one: one.goes)
        place = kept.index(column)
        tighter = tuple(cap for cap in column.caps if cap < column.width)
        kept[place : place + 1] = [replace(column, caps=tighter)] if tighter else []
