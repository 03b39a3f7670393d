"""Arrays of a terminal's cells: braille dots, letters and colours, converted to rich's lines.

A colour is packed in one number, red in the highest byte. `NONE` is the terminal's default colour.
"""

from collections.abc import Iterable, Iterator, Sequence
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

DASH: Final = 3
"""Length in cells of a dash, where several curves coincide and alternate."""

Stroke: TypeAlias = tuple[float, float, float, float, Color, int]
"""Straight piece of a trail: x and y of both ends in metres, colour, width in pixels."""

_BITS: Final = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])


def _stroke(mask: int) -> str:
    """Return the ASCII character that looks most like the dots of a cell."""
    across, down = [], []
    for (row, column), bit in np.ndenumerate(_BITS):
        if mask & bit:
            across.append(column)
            down.append(row)
    if not across:
        return " "
    left, right = ([y for x, y in zip(across, down, strict=True) if x == side] for side in (0, 1))
    middle = sum(down) / len(down)
    if max(down) - min(down) < 2:
        is_level = bool(left) and bool(right)
        if middle < 1.0 or (middle < 2.0 and not is_level):
            return "'"
        return "-" if middle <= 2.0 and is_level else "_" if middle == 3.0 and is_level else "."
    if not left or not right:
        return "|"
    slope = sum(right) / len(right) - sum(left) / len(left)
    return "|" if abs(slope) < 1.0 else "\\" if slope > 0 else "/"


_SIGNS: Final = {
    False: np.array([chr(0x2800 + mask) for mask in range(256)], "<U4"),
    True: np.array([_stroke(mask) for mask in range(256)], "<U4"),
}
"""Character of a cell for each mask of dots, in braille (False) and in ASCII (True)."""


class Cell(NamedTuple):
    """Character and colours of one cell; a `ground` of None does not change the background."""

    text: str
    ink: Color | None = None
    ground: Color | None = None
    bold: bool = False


def packed(color: Color | None) -> int:
    """Return a colour as one number, 0xRRGGBB; NONE for no colour."""
    return NONE if color is None else (color.r << 16) + (color.g << 8) + color.b


def blended(colors: Numbers, end: Color, share: float | Points) -> Numbers:
    """Mix colours, packed as numbers, with `end`; `share` is the fraction of `end`, 0 to 1."""
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
    """Yield (offset, text) of each cell of a text; the second cell of a wide letter is empty."""
    offset = 0
    shown: list[tuple[int, str]] = []
    for sign in text:
        width = cell_len(sign)
        if width == 0:
            # A combining mark belongs to the character before it; without one it is dropped.
            if shown:
                start, before = shown[-1]
                shown[-1] = start, before + sign
            continue
        shown.append((offset, sign))
        shown.extend((offset + more, "") for more in range(1, width))
        offset += width
    yield from shown


def dots_of(ends: Points, width: int, height: int) -> tuple[Numbers, Numbers, Points, Numbers]:
    """Return the dots of straight lines that are inside a picture; lines with NaN have none.

    Args:
        ends: Both ends of each line in dots, right and down from the upper left corner, with or
            without a depth, shape (n, 2, 2 or 3).
        width: Width of the picture in dots.
        height: Height of the picture in dots.

    Returns:
        For each dot: its column, its row, its exact position, and the index of its line.

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
    # Points exactly on the right and lower edges belong to the last dots inside.
    across, down = np.clip(points[:, :2].astype(np.int64), 0, size - 1).T
    return across, down, points, kept[one]


class Dots:
    """Braille dots of columns × rows of cells; a cell is two dots wide and four dots high.

    Attributes:
        masks: Dots of each cell, as the bits of Unicode's braille characters.
        colors: Colour (0xRRGGBB) of each cell: the colour of the last dot drawn there.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.masks: Numbers = np.zeros((rows, columns), np.int64)
        self.colors: Numbers = np.full((rows, columns), NONE, np.int64)

    def draw(self, ends: Points, colors: Numbers | int, wide: int = 1) -> None:
        """Draw straight lines.

        Args:
            ends: Both ends of each line in dots, right and down, shape (n, 2, 2).
            colors: Colour (0xRRGGBB) of each line, or one colour for all lines.
            wide: Width of the lines in dots.
        """
        rows, columns = self.masks.shape
        across, down, _, which = dots_of(ends, 2 * columns, 4 * rows)
        inks = colors if isinstance(colors, int) else colors[which]
        for aside in range(wide * wide):
            x = np.clip(across + aside % wide - (wide - 1) // 2, 0, 2 * columns - 1)
            y = np.clip(down + aside // wide - (wide - 1) // 2, 0, 4 * rows - 1)
            self.mark(x, y, inks)

    def mark(self, across: Numbers, down: Numbers, colors: Numbers | int) -> None:
        """Set single dots at the columns `across` and the rows `down`."""
        cells = down // 4, across // 2
        np.bitwise_or.at(self.masks, cells, _BITS[down % 4, across % 2])
        self.colors[cells] = colors

    def cover(self, above: "Dots") -> None:
        """Copy all cells that have dots from `above`, with their colours."""
        marked = above.masks > 0
        self.masks[marked], self.colors[marked] = above.masks[marked], above.colors[marked]

    def rows(self, *, ascii_only: bool = False) -> list[list[tuple[str, str]]]:
        """Return (character, style) of every cell; a cell without dots is a blank without style."""
        signs = np.where(self.masks > 0, _SIGNS[ascii_only][self.masks], " ").tolist()
        return [
            [
                (sign, f"#{color:06x}" if color >= 0 else "")
                for sign, color in zip(*row, strict=True)
            ]
            for row in zip(signs, self.colors.tolist(), strict=True)
        ]


def runs(cells: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Join neighbouring cells with equal style; a blank cell without style joins any neighbour."""
    found: list[tuple[str, str]] = []
    for sign, style in cells:
        text, last = found[-1] if found else ("", "")
        if found and (style == last or (sign == " " and not style)):
            found[-1] = text + sign, last
        elif found and not last and text.isspace():
            found[-1] = text + sign, style
        else:
            found.append((sign, style))
    return found


def merged(layers: Sequence[Dots]) -> Dots:
    """Merge several curves into one picture.

    A cell with several curves has the colour of one of these curves. Sloping curves come before
    horizontal curves. Among several sloping curves, the curve with the fewest cells of its own
    comes first. This order is the same in all cells, so the colour does not alternate. Where only
    horizontal curves coincide, dashes in alternating colours show all of them.

    Args:
        layers: The dots of each curve, all of one size; at least one.
    """
    found = Dots(*layers[0].masks.shape[::-1])
    found.masks = np.bitwise_or.reduce([one.masks for one in layers])
    owners = owners_of(layers)[None]
    found.colors = np.take_along_axis(np.stack([one.colors for one in layers]), owners, 0)[0]
    return found


def owners_of(layers: Sequence[Dots]) -> Numbers:
    """Return the index of the curve whose colour `merged` shows in each cell."""
    masks = np.stack([one.masks for one in layers])
    has = masks > 0
    is_level = has.any(2).sum(1) <= 1
    own = (has & (has.sum(0) == 1)).sum((1, 2))
    order = np.lexsort((own, is_level))
    owners: Numbers = order[has[order].argmax(0)]
    rows = ((masks[..., None] & _BITS.sum(1)) > 0).sum(-1)
    count = has.sum(0)
    turn = np.arange(masks.shape[2]) // DASH % np.maximum(count, 1)
    in_turn = (np.cumsum(has, 0) == turn + 1).argmax(0)
    return np.where(rows.max(0) == 1, in_turn, owners)


class CellSheet:
    """Characters and colours of columns × rows of cells.

    Attributes:
        texts: Character of each cell; empty behind a wide character.
        inks: Colour (0xRRGGBB) of each character.
        grounds: Packed background colour of each cell.
        bold: Whether each character is bold.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.texts: npt.NDArray[np.str_] = np.full((rows, columns), " ", "<U4")
        self.inks: Numbers = np.full((rows, columns), NONE, np.int64)
        self.grounds = self.inks.copy()
        self.bold: Mask = np.zeros((rows, columns), bool)
        self._keys = self._shown = self.inks
        self._lines: list[Line] = []

    def lay(self, dots: Dots, colors: Numbers | int | None = None, *, ascii_only: bool) -> Mask:
        """Write dots into the sheet as characters; return a mask of the cells that have dots.

        Args:
            dots: The dots.
            colors: Colour (0xRRGGBB) of each cell, or one for all cells; None for the colours in
                `dots`.
            ascii_only: Whether to write ASCII characters instead of braille.
        """
        marked = dots.masks > 0
        self.texts[marked] = _SIGNS[ascii_only][dots.masks[marked]]
        inks = dots.colors if colors is None else np.broadcast_to(colors, marked.shape)
        self.inks[marked] = inks[marked]
        return marked

    def put(self, column: int, row: int, cell: Cell) -> None:
        """Write the content of one cell."""
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
        """Write a text in one colour, or in one colour per cell.

        Args:
            column: Column of the first cell.
            row: Row of the cells.
            text: Text, which must fit into the row.
            inks: Colour (0xRRGGBB), or one colour per cell.
            bold: Whether to write in bold.
            clears: Whether to reset the background to the terminal's default.
        """
        for offset, sign in cells_of(text):
            place = row, column + offset
            self.texts[place], self.bold[place] = sign, bold
            self.inks[place] = inks if isinstance(inks, int) else inks[offset]
            if clears:
                self.grounds[place] = NONE

    def lines(self, before: "CellSheet | None" = None) -> list[Line]:
        """Return the sheet as lines of rich's segments, one segment per run of equal style.

        Args:
            before: Previous sheet of the same size, whose unchanged lines are reused.
        """
        # The colour of a blank is invisible, so a blank takes the colour of the cell before it, and
        # begins no segment. The demo at 120×40 then draws in 13 % less processor time.
        inked = np.where(self.texts == " ", 0, np.arange(self.texts.shape[1]))
        self._shown = np.take_along_axis(self.inks, np.maximum.accumulate(inked, 1), 1)
        self._keys = (self._shown << 26) + (self.grounds << 1) + self.bold
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
            cells[row].tolist() for cells in (self.texts, self._shown, self.grounds, self.bold)
        )
        starts = [0, *(np.flatnonzero(np.diff(self._keys[row])) + 1).tolist(), len(texts)]
        return [
            Segment("".join(texts[start:end]), _style(inks[start], grounds[start], bold[start]))
            for start, end in pairwise(starts)
            if start < end
        ]
