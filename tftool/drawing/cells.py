"""Cells of a terminal: braille dots, and their conversion to rich's lines."""

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple, TypeAlias

from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style

from tftool.base.color import Color
from tftool.drawing import theme

Line: TypeAlias = list[Segment]


class Cell(NamedTuple):
    """Content of one cell. No ground colour: the field's own."""

    text: str
    ink: Color | None = None
    ground: Color | None = None
    bold: bool = False


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


def line_of(cells: list[Cell]) -> Line:
    """Join cells of equal style into segments."""
    line: Line = []
    text: list[str] = []
    look: tuple[Color | None, Color | None, bool] = (None, None, False)
    for cell in cells:
        mine = cell.ink, cell.ground, cell.bold
        if cell.text == " " and text and cell.ground == look[1]:
            # A blank has no ink: it needs no segment, and a terminal no code, of its own.
            mine = look
        if mine != look and cell.text:
            if text:
                line.append(Segment("".join(text), style_of(*look)))
            text, look = [], mine
        text.append(cell.text)
    if text:
        line.append(Segment("".join(text), style_of(*look)))
    return line


@lru_cache(maxsize=4096)
def style_of(ink: Color | None, ground: Color | None, bold: bool) -> Style:
    """Return rich's style for a cell: None for a colour that the terminal chooses."""
    return Style(
        color=None if ink is None else theme.hexadecimal(ink),
        bgcolor=None if ground is None else theme.hexadecimal(ground),
        bold=bold or None,
    )


PIXELS_PER_METRE = 45.0

Stroke: TypeAlias = tuple[float, float, float, float, Color, int]
"""A straight piece of trail: x and y of both ends in metres, colour, width in pixels."""


class Ink:
    """Permanent dots on a rectangle of the world, shown by columns × rows of cells.

    Args:
        columns: Cells across.
        rows: Cells down.
        left: Left or lower edge of the rectangle, metres.
        bottom: Left or lower edge of the rectangle, metres.
        size: How wide it is, metres.
        height: How high it is, metres; a square if None.

    Attributes:
        revisions: For each row a number that changes when something is drawn there.
    """

    def __init__(
        self,
        columns: int,
        rows: int,
        left: float,
        bottom: float,
        size: float,
        height: float | None = None,
    ) -> None:
        self.columns, self.rows = columns, rows
        self.left, self.bottom, self.size = left, bottom, size
        self.height = size if height is None else height
        self.revisions = [0] * rows
        self._dots = [bytearray(columns) for _ in range(rows)]
        self._colors: list[list[Color | None]] = [[None] * columns for _ in range(rows)]

    def draw(self, stroke: Stroke) -> None:
        """Draw the part of a stroke within the square; NaN ends draw nothing."""
        x0, y0, x1, y1, color, width = stroke
        clipped = _clip(
            (x0 - self.left) / self.size,
            (y0 - self.bottom) / self.height,
            (x1 - self.left) / self.size,
            (y1 - self.bottom) / self.height,
        )
        if clipped is None:
            return
        across, down = 2 * self.columns, 4 * self.rows
        x0, y0, x1, y1 = clipped
        x0, x1 = x0 * across, x1 * across
        y0, y1 = (1.0 - y0) * down, (1.0 - y1) * down
        steps = max(1, math.ceil(max(abs(x1 - x0), abs(y1 - y0))))
        # Dots leave gaps between them, so a trail needs a few more to look as wide as it is.
        wide = max(1, round(1.3 * width / PIXELS_PER_METRE * across / self.size))
        before = (wide - 1) // 2
        seen = None
        for step in range(steps + 1):
            share = step / steps
            dot = int(x0 + share * (x1 - x0)), int(y0 + share * (y1 - y0))
            if dot == seen:
                continue
            seen = dot
            for x in range(dot[0] - before, dot[0] - before + wide):
                for y in range(dot[1] - before, dot[1] - before + wide):
                    self._dot(x, y, color)

    def cells(self, row: int, *, ascii_only: bool = False) -> list[Cell]:
        """Return one row of the square."""
        signs = _ASCII if ascii_only else _BRAILLE
        return [
            Cell(signs[mask], color) if mask else _BLANK
            for mask, color in zip(self._dots[row], self._colors[row], strict=True)
        ]

    def _dot(self, x: int, y: int, color: Color) -> None:
        # The far edges belong to the field: their dots are the last ones inside.
        x, y = min(x, 2 * self.columns - 1), min(y, 4 * self.rows - 1)
        if x < 0 or y < 0:
            return
        self._mark(x >> 1, y >> 2, _BITS[x & 1][y & 3], color)

    def _mark(self, column: int, row: int, bit: int, color: Color) -> None:
        dots, colors = self._dots[row], self._colors[row]
        if not dots[column] & bit or colors[column] != color:
            dots[column] |= bit
            colors[column] = color
            self.revisions[row] += 1


class LooseInk(Ink):
    """Temporary dots, drawn anew each time: only cells with dots are stored.

    Attributes:
        marks: Dots and last colour of each cell, by row and column.
    """

    def __init__(
        self, columns: int, rows: int, left: float, bottom: float, size: float, height: float
    ) -> None:
        self.columns, self.rows = columns, rows
        self.left, self.bottom, self.size, self.height = left, bottom, size, height
        self.marks: dict[int, dict[int, tuple[int, Color]]] = {}

    def _mark(self, column: int, row: int, bit: int, color: Color) -> None:
        cells = self.marks.setdefault(row, {})
        before = cells.get(column)
        # The dots of another colour make way: a cell has but one.
        kept = before[0] if before is not None and before[1] == color else 0
        cells[column] = kept | bit, color


def sign_of(dots: int, *, ascii_only: bool = False) -> str:
    """Return the character with these dots, numbered as in `LooseInk.marks`."""
    return (_ASCII if ascii_only else _BRAILLE)[dots]


def _clip(x0: float, y0: float, x1: float, y1: float) -> tuple[float, float, float, float] | None:
    """Clip a line to the unit square (Liang and Barsky); None if nothing remains."""
    first, last = 0.0, 1.0
    along, up = x1 - x0, y1 - y0
    if not math.isfinite(along + up + x0 + y0):
        return None
    for speed, room in ((-along, x0), (along, 1.0 - x0), (-up, y0), (up, 1.0 - y0)):
        if speed == 0.0:
            if room < 0.0:
                return None
        elif speed < 0.0:
            first = max(first, room / speed)
        else:
            last = min(last, room / speed)
    if first > last:
        return None
    return x0 + first * along, y0 + first * up, x0 + last * along, y0 + last * up


_BLANK = Cell(" ")
_BITS = ((0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80))
_BRAILLE = [chr(0x2800 + mask) for mask in range(256)]
_UPPER, _LOWER = 0x01 | 0x02 | 0x08 | 0x10, 0x04 | 0x40 | 0x20 | 0x80
_ASCII = [
    ":" if mask & _UPPER and mask & _LOWER else "'" if mask & _UPPER else "." for mask in range(256)
]
