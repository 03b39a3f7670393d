"""Cells of a terminal as arrays: braille dots, letters, and colours, converted to rich's lines.

Colours are packed in one number each, red first; `NONE` stands for the terminal's own.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style

from tftool.base.color import Color

Line: TypeAlias = list[Segment]
Numbers: TypeAlias = npt.NDArray[np.int64]
Points: TypeAlias = npt.NDArray[np.floating]
Mask: TypeAlias = npt.NDArray[np.bool_]

NONE: Final = -1

Stroke: TypeAlias = tuple[float, float, float, float, Color, int]
"""A straight piece of trail: x and y of both ends in metres, colour, width in pixels."""

_BITS: Final = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
_UPPER: Final = 0x01 | 0x02 | 0x08 | 0x10
_SIGNS: Final = {
    False: np.array([chr(0x2800 + mask) for mask in range(256)], "<U4"),
    True: np.array(
        [
            ":" if mask & _UPPER and mask & ~_UPPER else "'" if mask & _UPPER else "."
            for mask in range(256)
        ],
        "<U4",
    ),
}
"""The sign of a cell's dots, in braille or in ASCII."""


class Cell(NamedTuple):
    """Content of one cell. No ground colour: that of the cell below."""

    text: str
    ink: Color | None = None
    ground: Color | None = None
    bold: bool = False


def packed(color: Color | None) -> int:
    """Return a colour as one number."""
    return NONE if color is None else (color.r << 16) + (color.g << 8) + color.b


def blended(colors: Numbers, end: Color, share: float | Points) -> Numbers:
    """Mix packed colours with another one, as `theme.blend` does; with one share, or one each."""
    parts = np.stack([colors >> 16, colors >> 8 & 255, colors & 255], -1)
    mixed = np.rint(parts + np.asarray(share)[..., None] * (np.array(end) - parts)).astype(np.int64)
    return np.where(colors < 0, NONE, mixed @ np.array([1 << 16, 1 << 8, 1]))


@lru_cache(maxsize=4096)
def _style(ink: int, ground: int, bold: bool) -> Style:
    return Style(
        color=None if ink < 0 else f"#{ink:06x}",
        bgcolor=None if ground < 0 else f"#{ground:06x}",
        bold=bold or None,
    )


def cells_of(text: str) -> Iterator[tuple[int, str]]:
    """Split a text into cells; the cell after a wide character is empty."""
    offset = 0
    shown: list[tuple[int, str]] = []
    for sign in text:
        width = cell_len(sign)
        if width == 0:
            # A mark stands on the sign before it; one with nothing to stand on has no cell.
            if shown:
                start, before = shown[-1]
                shown[-1] = start, before + sign
            continue
        shown.append((offset, sign))
        shown.extend((offset + more, "") for more in range(1, width))
        offset += width
    yield from shown


def dots_of(ends: Points, width: int, height: int) -> tuple[Numbers, Numbers, Points, Numbers]:
    """Return the dots of straight lines within a picture; NaN ends draw nothing.

    Args:
        ends: Both ends of each line, to the right and down from the upper left corner in dots,
            perhaps with a depth, shape (n, 2, 2 or 3).
        width: Dots across.
        height: Dots down.

    Returns:
        Columns, rows, positions, and the index of the line of each dot.

    Source:
        Liang and Barsky, "A New Concept and Method for Line Clipping", 1984.
    """
    size = np.array([width, height])
    with np.errstate(all="ignore"):
        start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
        to_low, to_high = -start[:, :2] / way[:, :2], (size - start[:, :2]) / way[:, :2]
        flat = way[:, :2] == 0.0
        inside = (start[:, :2] >= 0.0) & (start[:, :2] <= size)
        enter = np.where(flat, np.where(inside, -np.inf, np.inf), np.minimum(to_low, to_high))
        leave = np.where(flat, np.where(inside, np.inf, -np.inf), np.maximum(to_low, to_high))
        first = np.clip(enter.max(1, initial=0.0), 0.0, None)
        last = np.clip(leave.min(1, initial=1.0), None, 1.0)
        (kept,) = np.nonzero((first <= last) & np.isfinite(start).all(1) & np.isfinite(way).all(1))
    start, way, first, last = start[kept], way[kept], first[kept], last[kept]
    counts = np.ceil((last - first) * np.abs(way[:, :2]).max(1, initial=0.0)).astype(int) + 1
    one = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(one)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = first[one] + (last - first)[one] * place / np.maximum(counts - 1, 1)[one]
    points = start[one] + share[:, None] * way[one]
    # The far edges belong to the picture: their dots are the last ones inside.
    across, down = np.clip(points[:, :2].astype(np.int64), 0, size - 1).T
    return across, down, points, kept[one]


class Dots:
    """Braille dots of columns × rows of cells, two across and four down in each.

    Attributes:
        masks: Dots of each cell, by the numbers of Unicode's braille.
        colors: Colour of each cell: that of its last dot.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.masks: Numbers = np.zeros((rows, columns), np.int64)
        self.colors: Numbers = np.full((rows, columns), NONE, np.int64)

    def draw(self, ends: Points, colors: Numbers | int, wide: int = 1) -> None:
        """Draw straight lines.

        Args:
            ends: Both ends of each, to the right and down in dots, shape (n, 2, 2).
            colors: Packed colour of each, or of all.
            wide: Dots that a line is wide.
        """
        rows, columns = self.masks.shape
        across, down, _, which = dots_of(ends, 2 * columns, 4 * rows)
        inks = colors if isinstance(colors, int) else colors[which]
        for aside in range(wide * wide):
            x = np.clip(across + aside % wide - (wide - 1) // 2, 0, 2 * columns - 1)
            y = np.clip(down + aside // wide - (wide - 1) // 2, 0, 4 * rows - 1)
            self.mark(x, y, inks)

    def mark(self, across: Numbers, down: Numbers, colors: Numbers | int) -> None:
        """Set single dots."""
        cells = down // 4, across // 2
        np.bitwise_or.at(self.masks, cells, _BITS[down % 4, across % 2])
        self.colors[cells] = colors

    def cover(self, above: "Dots", free: Mask | None = None) -> None:
        """Lay other dots above these; a cell shows only the upper ones.

        Args:
            above: The others.
            free: Cells they may take; all if None.
        """
        marked = above.masks > 0 if free is None else (above.masks > 0) & free
        self.masks[marked], self.colors[marked] = above.masks[marked], above.colors[marked]

    def rows(self, *, ascii_only: bool = False) -> list[list[tuple[str, str]]]:
        """Return sign and style of every cell; a blank without style where there is no dot."""
        signs = np.where(self.masks > 0, _SIGNS[ascii_only][self.masks], " ").tolist()
        return [
            [
                (sign, f"#{color:06x}" if color >= 0 else "")
                for sign, color in zip(*row, strict=True)
            ]
            for row in zip(signs, self.colors.tolist(), strict=True)
        ]


class CellSheet:
    """Signs and colours of columns × rows of cells.

    Attributes:
        texts: Sign of each cell; empty behind a wide one.
        inks: Packed colour of each sign.
        grounds: Packed colour behind it.
        bold: Whether it is bold.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.texts: npt.NDArray[np.str_] = np.full((rows, columns), " ", "<U4")
        self.inks: Numbers = np.full((rows, columns), NONE, np.int64)
        self.grounds = self.inks.copy()
        self.bold: Mask = np.zeros((rows, columns), bool)
        self._keys = self.inks
        self._lines: list[Line] = []

    def lay(self, dots: Dots, colors: Numbers | int | None = None, *, ascii_only: bool) -> Mask:
        """Show dots; return the cells that have some.

        Args:
            dots: The dots.
            colors: Colours by cell, or one for all; their own if None.
            ascii_only: Show them as ASCII signs.
        """
        marked = dots.masks > 0
        self.texts[marked] = _SIGNS[ascii_only][dots.masks[marked]]
        inks = dots.colors if colors is None else np.broadcast_to(colors, marked.shape)
        self.inks[marked] = inks[marked]
        return marked

    def put(self, column: int, row: int, cell: Cell) -> None:
        """Show one cell."""
        place = row, column
        self.texts[place], self.inks[place] = cell.text, packed(cell.ink)
        self.bold[place] = cell.bold
        if cell.ground is not None:
            self.grounds[place] = packed(cell.ground)

    def write(
        self,
        column: int,
        row: int,
        text: str,
        inks: Sequence[int] | int,
        *,
        bold: bool = False,
        clears: bool = False,
    ) -> None:
        """Write a text in one colour, or in one for each of its cells.

        Args:
            column: The first cell.
            row: Row.
            text: The text; it must fit.
            inks: Packed colours.
            bold: Whether it is bold.
            clears: Whether it stands on the terminal's own ground.
        """
        for offset, sign in cells_of(text):
            place = row, column + offset
            self.texts[place], self.bold[place] = sign, bold
            self.inks[place] = inks if isinstance(inks, int) else inks[offset]
            if clears:
                self.grounds[place] = NONE

    def lines(self, before: "CellSheet | None" = None) -> list[Line]:
        """Join cells of equal style into rich's segments.

        Args:
            before: The last sheet of this size; its lines are kept where nothing changed.
        """
        # The ink of a blank is not seen: no new segment for it.
        self._keys = (np.where(self.texts == " ", NONE, self.inks) << 26) + (self.grounds << 1)
        self._keys += self.bold
        kept = np.zeros(len(self._keys), bool)
        if before is not None:
            kept = ((self._keys == before._keys) & (self.texts == before.texts)).all(1)
        self._lines = [
            before._lines[row] if is_kept and before is not None else self._line(row)
            for row, is_kept in enumerate(kept.tolist())
        ]
        return self._lines

    def _line(self, row: int) -> Line:
        texts, inks, grounds, bold = (
            cells[row].tolist() for cells in (self.texts, self.inks, self.grounds, self.bold)
        )
        starts = [0, *(np.flatnonzero(np.diff(self._keys[row])) + 1).tolist(), len(texts)]
        return [
            Segment("".join(texts[start:end]), _style(inks[start], grounds[start], bold[start]))
            for start, end in pairwise(starts)
            if start < end
        ]
