"""The turtles' field as coloured lines of text, at any size.

Trails are drawn in braille (eight dots to a cell), turtles in blocks or as
arrows, so that a metre is as long across as it is up on cells twice as high as
wide. What is drawn is a frozen `FieldPicture`; nothing here knows a simulator.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderResult
from rich.segment import Segment
from rich.style import Style

from tftool.messages import Color
from tftool.views import sprites, theme
from tftool.views.braille_trail import Ink, Stroke
from tftool.views.fixed_width import fitted
from tftool.views.sprites import Cell

EDGE = 11.088889122009277
"""Metres along one side of turtlesim's field."""

Line: TypeAlias = list[Segment]
_Overlay: TypeAlias = dict[int, dict[int, Cell]]


@dataclass(frozen=True, slots=True)
class DrawnTurtle:
    """A turtle to draw: metres, radians; its colour comes from its name."""

    name: str
    x: float
    y: float
    theta: float


@dataclass(frozen=True, slots=True)
class Mark:
    """A frame that is no turtle, seen from above: a carrot, a laser.

    Metres, radians, and seconds since its last sample: it fades as `theme` says.
    """

    name: str
    x: float
    y: float
    theta: float = 0.0
    age: float = 0.0


@dataclass(frozen=True, slots=True)
class FieldPicture:
    """What there is to see at one moment.

    Attributes:
        turtles: In the order they are drawn, later ones on top.
        marks: Other frames, drawn under the turtles.
        strokes: The trail, oldest first.
        forgotten: How many strokes of this trail were there before the first of `strokes`.
        wipes: How often the trail was wiped so far: strokes of another wipe are another trail.
        background: Colour of the field.
        walls: The sides a turtle just ran into: "left", "right", "bottom", "top".
        left: Where the field begins, metres.
        bottom: Where the field begins, metres.
        size: How long its sides are, metres.
    """

    turtles: tuple[DrawnTurtle, ...] = ()
    marks: tuple[Mark, ...] = ()
    strokes: Sequence[Stroke] = ()
    forgotten: int = 0
    wipes: int = 0
    background: Color = theme.BACKGROUND
    walls: frozenset[str] = frozenset()
    left: float = 0.0
    bottom: float = 0.0
    size: float = EDGE


def fit(width: int, height: int) -> tuple[int, int]:
    """Give (columns, rows) of the largest square field in `width` by `height` cells."""
    rows = max(0, min(height, width // 2))
    return 2 * rows, rows


class Canvas:
    """A field of a given size that remembers what it has drawn of a trail.

    Args:
        columns: Cells across.
        rows: Cells down; half of `columns` makes a square field.
        ascii_only: Draw with ASCII characters alone.
        arrows: Show turtles as arrows however much room there is; without colour a
            drawn body is a blot.
    """

    def __init__(
        self, columns: int, rows: int, *, ascii_only: bool = False, arrows: bool = False
    ) -> None:
        self.columns = max(0, columns)
        self.rows = max(0, rows)
        self._ascii = ascii_only
        self._arrows = ascii_only or arrows
        self._wipes = 0
        self._drawn = 0
        self._ink = Ink(self.columns, self.rows, 0.0, 0.0, EDGE)
        self._kept: list[tuple[tuple[int, Color], Line] | None] = [None] * self.rows

    def lines(self, picture: FieldPicture) -> list[Line]:
        """Draw `picture`: `rows` lines, each exactly `columns` cells wide."""
        if not self.columns or not self.rows:
            return [[] for _ in range(self.rows)]
        self._follow_trail(picture)
        overlay = self._overlay(picture)
        return [
            self._over(row, overlay[row], picture.background)
            if row in overlay
            else self._under(row, picture.background)
            for row in range(self.rows)
        ]

    def _follow_trail(self, picture: FieldPicture) -> None:
        """Draw what the trail has grown by; begin anew when it is another one, or shorter."""
        ink, total = self._ink, picture.forgotten + len(picture.strokes)
        view = picture.left, picture.bottom, picture.size
        if (
            view != (ink.left, ink.bottom, ink.size)
            or picture.wipes != self._wipes
            or total < self._drawn
        ):
            ink = self._ink = Ink(self.columns, self.rows, *view)
            self._wipes, self._drawn = picture.wipes, 0
            self._kept = [None] * self.rows
        for stroke in picture.strokes[max(0, self._drawn - picture.forgotten) :]:
            ink.draw(stroke)
        self._drawn = total

    def _under(self, row: int, ground: Color) -> Line:
        """Give a line with nothing but trail on it, kept until the trail changes there."""
        kept, state = self._kept[row], (self._ink.revisions[row], ground)
        if kept is None or kept[0] != state:
            kept = state, _line(self._ink.cells(row, ascii_only=self._ascii), ground)
            self._kept[row] = kept
        return kept[1]

    def _over(self, row: int, cells: dict[int, Cell], ground: Color) -> Line:
        line = self._ink.cells(row, ascii_only=self._ascii)
        for column, cell in cells.items():
            line[column] = cell
        return _line(line, ground)

    def _overlay(self, picture: FieldPicture) -> _Overlay:
        overlay: _Overlay = {}
        for column, row, cell in self._walls(picture.walls):
            overlay.setdefault(row, {})[column] = cell
        names: list[tuple[str, int, int, int, Color]] = []
        per_metre = self.rows / picture.size
        everything: tuple[Mark | DrawnTurtle, ...] = (*picture.marks, *picture.turtles)
        for shown in everything:
            place = self._place(shown.x, shown.y)
            if place is None:
                continue
            color = theme.of_name(shown.name)
            if isinstance(shown, Mark):
                faded = theme.faded(color, shown.age, picture.background)
                if faded is None:
                    continue
                color = faded
                arrows = sprites.ASCII_ARROWS if self._ascii else sprites.ARROWS
                sign = arrows[sprites.octant(shown.theta)]
                cells: Iterable[tuple[int, int, Cell]] = (
                    (int(place[0]), int(place[1]), Cell(sign, color, None, True)),
                )
                reach = 1
            elif per_metre >= sprites.BODY_FROM and not self._arrows:
                cells = sprites.body(*place, shown.theta, color, per_metre)
                reach = math.ceil(1.9 * per_metre)
            else:
                cells = sprites.badge(*place, shown.theta, color, per_metre, blocks=not self._ascii)
                reach = 1 if self._ascii else 2
            for column, row, cell in cells:
                if 0 <= column < self.columns and 0 <= row < self.rows:
                    overlay.setdefault(row, {})[column] = cell
            names.append((shown.name, int(place[0]), int(place[1]), reach, color))
        for name, column, row, reach, color in reversed(names):
            self._name(overlay, name, column, row, reach, color)
        return overlay

    def _place(self, x: float, y: float) -> tuple[float, float] | None:
        """Give the (column, row) of a point, or None for what lies far off or nowhere."""
        ink = self._ink
        across, up = (x - ink.left) / ink.size, (y - ink.bottom) / ink.size
        # Asked this way round, NaN is nowhere.
        if not (-0.1 <= across <= 1.1 and -0.1 <= up <= 1.1):
            return None
        # The far edges belong to the field.
        column = across * self.columns if across != 1.0 else self.columns - 0.01
        row = (1.0 - up) * self.rows if up != 0.0 else self.rows - 0.01
        return column, row

    def _walls(self, sides: frozenset[str]) -> Iterator[tuple[int, int, Cell]]:
        last_column, last_row = self.columns - 1, self.rows - 1
        top, bottom, left, right = "####" if self._ascii else "▀▄▌▐"
        if "top" in sides:
            yield from ((column, 0, Cell(top, theme.WALL)) for column in range(self.columns))
        if "bottom" in sides:
            yield from (
                (column, last_row, Cell(bottom, theme.WALL)) for column in range(self.columns)
            )
        if "left" in sides:
            yield from ((0, row, Cell(left, theme.WALL)) for row in range(self.rows))
        if "right" in sides:
            yield from ((last_column, row, Cell(right, theme.WALL)) for row in range(self.rows))

    def _name(
        self, overlay: _Overlay, name: str, column: int, row: int, reach: int, color: Color
    ) -> None:
        """Write a name beside its turtle: right, left, below or above, where it hides nothing."""
        more = "~" if self._ascii else "…"
        text = fitted(name, min(self.columns - 2 * reach - 2, max(8, self.columns // 3)), more=more)
        if self._ascii:
            text = text.encode("ascii", "replace").decode("ascii")
        width = cell_len(text)
        if not width:
            return
        below = max(1, (reach + 1) // 2)
        middle = min(max(0, column - width // 2), self.columns - width)
        places = (
            (column + reach + 1, row),
            (column - reach - width, row),
            (middle, row + below),
            (middle, row - below),
            (column + reach + 1, row + 1),
            (column + reach + 1, row - 1),
        )
        for start, line in places:
            inside = 0 <= line < self.rows and start >= 0 and start + width <= self.columns
            taken = overlay.get(line, {})
            if inside and not any(start + offset in taken for offset in range(width)):
                cells = overlay.setdefault(line, {})
                for offset, sign in _cells(text):
                    cells[start + offset] = Cell(sign, theme.blend(color, theme.WHITE, 0.4))
                return


def framed(lines: list[Line], *, ascii_only: bool = False) -> list[Line]:
    """Put a box around a field, for where its ground has no colour to end with."""
    width = sum(segment.cell_length for segment in lines[0]) if lines else 0
    across, down, corners = ("-", "|", "++++") if ascii_only else ("─", "│", "┌┐└┘")
    side = Segment(down)
    return [
        [Segment(corners[0] + across * width + corners[1])],
        *([side, *line, side] for line in lines),
        [Segment(corners[2] + across * width + corners[3])],
    ]


def _cells(text: str) -> Iterator[tuple[int, str]]:
    """Share a text out over cells; the cell after a wide sign holds nothing."""
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


def _line(cells: list[Cell], ground: Color) -> Line:
    """Join cells that look the same into segments."""
    line: Line = []
    text: list[str] = []
    look: tuple[Color | None, Color, bool] = (None, ground, False)
    for cell in cells:
        mine = cell.ink, cell.ground or ground, cell.bold
        if mine != look and cell.text:
            if text:
                line.append(Segment("".join(text), _style(*look)))
            text, look = [], mine
        text.append(cell.text)
    if text:
        line.append(Segment("".join(text), _style(*look)))
    return line


@lru_cache(maxsize=4096)
def _style(ink: Color | None, ground: Color, bold: bool) -> Style:
    return Style(
        color=None if ink is None else theme.hexadecimal(ink),
        bgcolor=theme.hexadecimal(ground),
        bold=bold or None,
    )


@dataclass(frozen=True, slots=True)
class FieldView:
    """A `FieldPicture` as a rich renderable: the largest square field there is room for."""

    picture: FieldPicture
    ascii_only: bool = False

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw the field, one line of text after another."""
        columns, rows = fit(options.max_width, options.height or options.max_height)
        ascii_only = self.ascii_only or options.ascii_only
        for line in Canvas(columns, rows, ascii_only=ascii_only).lines(self.picture):
            yield from line
            yield Segment.line()
