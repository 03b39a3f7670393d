"""Picture of frames as coloured text lines, at any size.

Trails, axes and lines to parents are drawn in braille (eight dots to a cell), turtles in blocks or
as arrows. Scales account for cells that are twice as high as wide. The drawing is a frozen
`PlanePicture`, independent of buffers and simulators.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from rich.segment import Segment

from tftool.base.color import Color
from tftool.base.fixed_width import fitted
from tftool.drawing import sprites, theme
from tftool.drawing.cells import (
    Cell,
    Ink,
    Line,
    LooseInk,
    Stroke,
    cells_of,
    line_of,
    sign_of,
    style_of,
)
from tftool.drawing.labels import Label, PlacedLabel, Placer
from tftool.drawing.plane import (
    FARTHEST,
    Drawn,
    PlaneFrame,
    PlanePicture,
    Point,
    TurtleField,
    Viewport,
    grid_step,
)
from tftool.drawing.theme import (
    LINK,
    ROLES,
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    PaperColors,
    on_field,
    paper,
)
from tftool.geometry.motion.unicycle import FIELD

_Overlay: TypeAlias = dict[int, dict[int, Cell]]

MOST_NAMED: Final = 80
"""Of more frames, only the first have their names beside them."""

MOST_TURNING: Final = 1500
"""How many strokes of a moving drawing are drawn: each of them is redrawn at every look."""

WITH_SCALE: Final = (26, 9)
"""Columns and rows from which the grid's metres stand at its sides."""


THICK_FROM: Final = 26
"""Rows from which axes are two dots wide."""


@dataclass(frozen=True, slots=True)
class _Pens:
    """Cells of a drawing by pen, with the drawn length of each stroke."""

    key: object = None
    done: int = 0
    is_new: bool = False
    is_cut: bool = False


@dataclass(slots=True)
class _KeptRow:
    """Static cells of a row, what they were made from, and their line."""

    state: object
    cells: list[Cell]
    line: Line | None = None


class Canvas:
    """Picture of a given size that keeps the trails drawn so far.

    Args:
        columns: Cells across, with those of the scale.
        rows: Cells down, with that of the scale.
        ascii_only: Draw with ASCII characters alone.
        mono: Whether there are no colours: then axes bear their letters, turtles are arrows.
        palette: The screen's own colours.
        scaled: Whether metres stand at the left and below, where there is room.

    Attributes:
        asked: The cells that were asked for, across and down.
        columns: Cells across of the picture itself.
        rows: Cells down of the picture itself.
        gutter: Cells at its left, for the scale.
    """

    def __init__(
        self,
        columns: int,
        rows: int,
        *,
        ascii_only: bool = False,
        mono: bool = False,
        palette: theme.Palette = theme.DARK,
        scaled: bool = True,
    ) -> None:
        self.asked = columns, rows
        with_scale = scaled and columns >= WITH_SCALE[0] and rows >= WITH_SCALE[1]
        self.gutter, self._footer = (5, 1) if with_scale else (0, 0)
        self.columns = max(0, columns - self.gutter)
        self.rows = max(0, rows - self._footer)
        self._ascii = ascii_only
        self._plain = ascii_only or mono
        self._palette = palette
        self._paper = paper(palette)
        self._field_colors: PaperColors | None = None
        # Equal to no view, so that the first one starts from scratch.
        self._view = Viewport(0.0, 0.0, 0.0)
        self._placer = Placer(self.columns, self.rows)

    def lines(self, picture: PlanePicture, view: Viewport) -> list[Line]:
        """Draw a picture of exactly the requested lines and cells."""
        if not self.columns or not self.rows:
            return [[] for _ in range(self.rows)]
        if view != self._view:
            self._fresh(view)
        field = picture.field
        self._field_colors = None if field is None else on_field(field.color)
        self._stand(field)
        self._follow(picture)
        loose = self._loose(picture)
        signs = self._signs(picture, loose)
        step = grid_step(view.per_row)
        drawn = []
        for row in range(self.rows):
            dots, over = loose.marks.get(row), signs.get(row)
            if dots is None and over is None:
                line = self._still(row)
            else:
                line = self._joined(row, dots or {}, over or {})
            drawn.append([*self._left_of(row, step), *line] if self.gutter else line)
        return [*drawn, self._below(step)] if self._footer else drawn

    # What stays from look to look

    def _fresh(self, view: Viewport) -> None:
        """Start again with another part of the plane."""
        self._view = view
        self._wide, self._high = 0.5 * view.per_row * self.columns, view.per_row * self.rows
        self._pen, self._pen_ink = _Pens(), self._new_ink()
        self._trails, self._trail_ink = _Pens(), self._new_ink()
        self._grid = self._gridded()
        self._standing: object = None
        self._inside: list[tuple[int, int]] = [(0, 0)] * self.rows
        self._kept: list[_KeptRow | None] = [None] * self.rows
        self._field_colors = None

    def _new_ink(self) -> Ink:
        view = self._view
        return Ink(self.columns, self.rows, view.left, view.bottom, self._wide, self._high)

    def _gridded(self) -> Ink:
        """Draw faint lines at every step; without colours, dots at their crossings."""
        ink, view = self._new_ink(), self._view
        step = grid_step(view.per_row)
        xs = list(_multiples(view.left, view.left + self._wide, step))
        ys = list(_multiples(view.bottom, view.bottom + self._high, step))
        color = self._paper.grid
        if self._plain:
            for x in xs:
                for y in ys:
                    ink.draw((x, y, x, y, color, 0))
            return ink
        for x in xs:
            ink.draw((x, view.bottom, x, view.bottom + self._high, color, 0))
        for y in ys:
            ink.draw((view.left, y, view.left + self._wide, y, color, 0))
        return ink

    def _stand(self, field: TurtleField | None) -> None:
        """Determine which cells are on the field."""
        where = None if field is None else (field.x, field.y, field.theta)
        if where == self._standing:
            return
        self._standing = where
        self._inside = [(0, 0)] * self.rows
        if field is None:
            return
        corners = [self.place(*corner) for corner in field.corners()]
        for row in range(self.rows):
            ends = _crossings(corners, row + 0.5)
            if ends is not None:
                first = max(0, math.ceil(ends[0] - 0.5))
                self._inside[row] = first, min(self.columns, math.floor(ends[1] + 0.5))

    def _follow(self, picture: PlanePicture) -> None:
        """Draw new ends of the trails; start again if they changed or became shorter."""
        field = picture.field
        if field is not None:
            moved = (field.x, field.y, field.theta)
            self._pen, self._pen_ink = self._grown(
                picture.pen, (moved, picture.pen.edition), self._pen, self._pen_ink, field
            )
        self._trails, self._trail_ink = self._grown(
            picture.trails, (picture.fixed, picture.trails.edition), self._trails, self._trail_ink
        )

    def _grown(
        self, drawn: Drawn, key: object, pens: _Pens, ink: Ink, field: TurtleField | None = None
    ) -> tuple[_Pens, Ink]:
        total = drawn.forgotten + len(drawn.strokes)
        first = max(0, pens.done - drawn.forgotten)
        moves, is_cut = key != pens.key, pens.is_cut
        if moves or total < pens.done or is_cut:
            ink, first = self._new_ink(), 0
            self._kept = [None] * self.rows
            # On a sheet that moves from look to look everything is redrawn every time.
            is_cut = moves and pens.is_new and len(drawn.strokes) > MOST_TURNING
            first = len(drawn.strokes) - MOST_TURNING if is_cut else 0
        turned = field is not None and (field.x, field.y, field.theta) != (0.0, 0.0, 0.0)
        for index in range(first, len(drawn.strokes)):
            stroke = drawn.strokes[index]
            ink.draw(_carried(stroke, field) if turned and field is not None else stroke)
        return _Pens(key, total, moves, is_cut), ink

    # Drawn at every look

    def _loose(self, picture: PlanePicture) -> LooseInk:
        """Draw the lines to parents, the pair's line, walls and axes."""
        view = self._view
        ink = LooseInk(self.columns, self.rows, view.left, view.bottom, self._wide, self._high)
        for one in picture.frames:
            if one.parent is not None:
                for ends in _dashes((one.x, one.y), one.parent, 0.25 * view.per_row):
                    ink.draw((*ends, LINK, 0))
        if picture.field is not None:
            # Without a colour of its own the field has an edge.
            for ends in _edges(picture.field, _SIDES) if self._plain else ():
                ink.draw((*ends, LINK, 0))
            for ends in _edges(picture.field, picture.field.walls):
                ink.draw((*ends, theme.WALL, 0))
        length = axis_length(view, self.rows)
        for one in picture.frames:
            if not one.is_frame:
                continue
            for (along, up), color in zip(one.axes, (X_AXIS, Y_AXIS, Z_AXIS), strict=False):
                if math.hypot(along, up) > 0.05:
                    end = one.x + length * along, one.y + length * up
                    ink.draw((one.x, one.y, *end, color, 0))
                    if self.rows >= THICK_FROM:
                        # A dot beside it, so that the axis is two dots wide.
                        aside = 0.25 * view.per_row / math.hypot(along, up)
                        x, y = one.x - aside * up, one.y + aside * along
                        ink.draw((x, y, end[0] - aside * up, end[1] + aside * along, color, 0))
        return ink

    def _signs(self, picture: PlanePicture, loose: LooseInk) -> _Overlay:
        """Draw turtles, origins and names above the dots."""
        signs: _Overlay = {}
        hard: set[tuple[int, int]] = set()
        labels: list[Label] = []
        per_metre = 1.0 / self._view.per_row
        bodies = per_metre >= sprites.BODY_FROM and not self._plain
        # Turtles below frames that stand on them; and of turtles, the first one on top.
        below = [one for one in picture.frames if one.is_turtle][::-1]
        if not bodies:
            below.reverse()
        above = [one for one in picture.frames if not one.is_turtle]
        reaches: dict[str, int] = {}
        for one in (*below, *above):
            place = self.place(one.x, one.y)
            if not self._is_near(place):
                continue
            color = self._ink_of(one, place)
            cells = self._sprite(one, place, color, per_metre, bodies, hard)
            for column, row, cell in cells:
                if 0 <= column < self.columns and 0 <= row < self.rows:
                    signs.setdefault(row, {})[column] = cell
                    hard.add((row, column))
            reaches[one.name] = (
                math.ceil(1.6 * per_metre) if one.is_turtle and bodies else 1 if self._plain else 2
            )
        for one in _by_weight(picture):
            place = self.place(one.x, one.y)
            if self._is_near(place) and len(labels) < MOST_NAMED:
                labels.append(self._label(one, place, reaches[one.name]))
        # Lines and axes had better stay in sight.
        soft = {(row, column) for row, cells in loose.marks.items() for column in cells}
        named = {one.name: one for one in picture.frames}
        for placed in self._placer.placed(labels, hard, soft):
            self._write(signs, placed, named[placed.label.name])
        return signs

    def _sprite(
        self,
        one: PlaneFrame,
        place: Point,
        color: Color,
        per_metre: float,
        bodies: bool,
        taken: set[tuple[int, int]],
    ) -> Iterable[tuple[int, int, Cell]]:
        column, row = math.floor(place[0]), math.floor(place[1])
        if not one.is_turtle:
            return [(column, row, Cell("o" if self._ascii else "●", color, None, True))]
        if bodies:
            return sprites.body(*place, one.theta, color, per_metre)
        if (row, column) in taken:
            # Another turtle stands there: this one is seen beside it, and small.
            free = next(
                (
                    column + aside
                    for aside in (2, -2, 1, -1, 3, -3)
                    if (row, column + aside) not in taken and 0 <= column + aside < self.columns
                ),
                column,
            )
            arrows = sprites.ASCII_ARROWS if self._ascii else sprites.ARROWS
            return [(free, row, Cell(arrows[sprites.octant(one.theta)], color, None, True))]
        return sprites.badge(*place, one.theta, color, per_metre, blocks=not self._ascii)

    def _label(self, one: PlaneFrame, place: Point, reach: int) -> Label:
        more = "~" if self._ascii else "…"
        text = fitted(one.name, max(10, self.columns // 3), more=more)
        if not one.is_frame:
            text = f"{text} (no frame)"
        if theme.is_stale(one.age):
            text = f"{text} {one.age:.1f} s ago"
        text = fitted(text, self.columns, more=more)
        if self._ascii:
            text = text.encode("ascii", "replace").decode("ascii")
        row = min(self.rows - 1, max(0, math.floor(place[1])))
        return Label(one.name, text, math.floor(place[0]), row, reach)

    def _ink_of(self, one: PlaneFrame, place: Point) -> Color:
        """Return a frame's colour on its ground; amber or red if it is stale."""
        palette = theme.DARK if self._on_field(place) else self._palette
        return theme.of_age(theme.readable(theme.of_name(one.name), palette), one.age, palette)

    def _write(self, signs: _Overlay, placed: PlacedLabel, one: PlaneFrame) -> None:
        """Write a name, each letter in a colour readable on its ground."""
        cells = signs.setdefault(placed.row, {})
        inks: dict[bool, Color] = {}
        for offset, sign in cells_of(placed.label.text):
            place = placed.column + offset, placed.row
            on_field = self._on_field(place)
            if on_field not in inks:
                ink = self._ink_of(one, place)
                brightens = on_field and not theme.is_stale(one.age)
                inks[on_field] = theme.blend(ink, theme.WHITE, 0.4) if brightens else ink
            cells[place[0]] = Cell(sign, inks[on_field])

    # Cells to lines

    def _still(self, row: int) -> Line:
        """Return a line without moving parts, cached until a trail changes there."""
        kept = self._base(row)
        if kept.line is None:
            kept.line = line_of(kept.cells)
        return kept.line

    def _base(self, row: int) -> "_KeptRow":
        """Return a row of all static parts, composed again only after a trail grew."""
        ground = None if self._field_colors is None else self._field_colors.ground
        state = (
            self._pen_ink.revisions[row],
            self._trail_ink.revisions[row],
            self._inside[row],
            ground,
        )
        kept = self._kept[row]
        if kept is None or kept.state != state:
            kept = self._kept[row] = _KeptRow(state, self._cells(row))
        return kept

    def _joined(self, row: int, dots: dict[int, tuple[int, Color]], signs: dict[int, Cell]) -> Line:
        cells = list(self._base(row).cells)
        for column, (mask, color) in dots.items():
            colors = self._colors(row, column)
            role = ROLES.get(color)
            ink = color if role is None else colors[role]
            cells[column] = Cell(sign_of(mask, ascii_only=self._ascii), ink, cells[column].ground)
        for column, cell in signs.items():
            ground = cell.ground or cells[column].ground
            cells[column] = Cell(cell.text, cell.ink, ground, cell.bold)
        return line_of(cells)

    def _cells(self, row: int) -> list[Cell]:
        """Return a row of grid, pens and trails, each cell with its ground."""
        ascii_only = self._ascii
        grid = self._grid.cells(row, ascii_only=ascii_only)
        cells = list(grid)
        first, end = self._inside[row]
        field = self._field_colors
        if field is not None and first < end:
            for column in range(first, end):
                below = cells[column]
                cells[column] = Cell(
                    below.text, field.grid if below.ink is not None else None, field.ground
                )
            for column, cell in enumerate(self._pen_ink.cells(row, ascii_only=ascii_only)):
                if cell.ink is not None:
                    cells[column] = Cell(cell.text, cell.ink, cells[column].ground)
        for column, cell in enumerate(self._trail_ink.cells(row, ascii_only=ascii_only)):
            if cell.ink is not None:
                ink = self._faint(cell.ink, cells[column].ground)
                cells[column] = Cell(cell.text, ink, cells[column].ground)
        return cells

    def _faint(self, color: Color, ground: Color | None) -> Color:
        """Return the paler colour of a frame's trail."""
        if ground is not None:
            return theme.blend(color, ground, 0.1)
        return theme.blend(theme.readable(color, self._palette), self._palette.panel, 0.3)

    def _colors(self, row: int, column: int) -> PaperColors:
        first, end = self._inside[row]
        if self._field_colors is not None and first <= column < end:
            return self._field_colors
        return self._paper

    def _on_field(self, place: Point) -> bool:
        row = math.floor(place[1])
        if self._field_colors is None or not 0 <= row < self.rows:
            return False
        first, end = self._inside[row]
        return first <= math.floor(place[0]) < end

    def place(self, x: float, y: float) -> Point:
        """Return the column and row of a point of the plane."""
        view = self._view
        if not abs(x) + abs(y) <= FARTHEST:
            return math.inf, math.inf
        column = (x - view.left) / view.per_row * 2.0
        row = self.rows - (y - view.bottom) / view.per_row
        # The far edges belong to the picture.
        if column == self.columns:
            column -= 0.01
        if row == self.rows:
            row -= 0.01
        return column, row

    def _is_near(self, place: Point) -> bool:
        return -2.0 <= place[0] < self.columns + 2.0 and -2.0 <= place[1] < self.rows + 2.0

    # The scale

    def _left_of(self, row: int, step: float) -> Line:
        view = self._view
        text = ""
        for y in _multiples(view.bottom, view.bottom + self._high, step):
            if math.floor(self.place(0.0, y)[1]) == row:
                text = metres(y, step)
        style = style_of(theme.blend(self._palette.panel, self._palette.dim, 0.9), None, False)
        return [Segment(f"{text[: self.gutter - 1]:>{self.gutter - 1}} ", style)]

    def _below(self, step: float) -> Line:
        view = self._view
        signs = [" "] * (self.columns + self.gutter)
        signs[self.gutter - 4] = "m"
        free = self.gutter - 1
        for x in _multiples(view.left, view.left + self._wide, step):
            text = metres(x, step)
            column = self.gutter + math.floor(self.place(x, 0.0)[0])
            start = column - (len(text) - 1) // 2 - (text[0] == "-")
            if free <= start and start + len(text) <= len(signs):
                signs[start : start + len(text)] = text
                free = start + len(text) + 1
        style = style_of(theme.blend(self._palette.panel, self._palette.dim, 0.9), None, False)
        return [Segment("".join(signs), style)]


def axis_length(view: Viewport, rows: int) -> float:
    """Return the length of drawn axes, metres: about a tenth of the picture, never a mere dot."""
    return view.per_row * min(4.0, max(1.6, rows / 10.0))


def metres(value: float, step: float) -> str:
    """Format a number of a scale with as many digits as its steps need."""
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:.{digits}f}"
    return "0" if not text.strip("-0.") else text


def _by_weight(picture: PlanePicture) -> list[PlaneFrame]:
    """Sort frames by the importance of their names: the pair, then turtles, then others."""
    return sorted(
        picture.frames,
        key=lambda one: (one.name not in picture.pair, not one.is_turtle, one.parent is None),
    )


def _multiples(first: float, last: float, step: float) -> Iterator[float]:
    for number in range(math.ceil(first / step - 1e-9), math.floor(last / step + 1e-9) + 1):
        yield number * step


def _crossings(corners: Sequence[Point], row: float) -> tuple[float, float] | None:
    """Return where a row enters and leaves a convex shape; None if it misses it."""
    found = []
    for (x0, y0), (x1, y1) in zip(corners, (*corners[1:], corners[0]), strict=True):
        if min(y0, y1) <= row < max(y0, y1):
            found.append(x0 + (row - y0) / (y1 - y0) * (x1 - x0))
    return (min(found), max(found)) if len(found) > 1 else None


def _edges(field: TurtleField, sides: Iterable[str]) -> Iterator[tuple[float, float, float, float]]:
    for side in sorted(sides):
        (x0, y0), (x1, y1) = _SIDES[side]
        yield (*field.place(x0, y0), *field.place(x1, y1))


_SIDES: Final = {
    "bottom": ((0.0, 0.0), (FIELD, 0.0)),
    "right": ((FIELD, 0.0), (FIELD, FIELD)),
    "top": ((FIELD, FIELD), (0.0, FIELD)),
    "left": ((0.0, FIELD), (0.0, 0.0)),
}


def _dashes(start: Point, end: Point, dot: float) -> Iterator[tuple[float, float, float, float]]:
    """Return every other pair of dots of a line, to distinguish it from a trail; fewer of a long
    one.
    """
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    if not dot < length <= FARTHEST:
        return
    count = max(1, round(length / (5.0 * dot)))
    if count > 400:
        yield (*start, *end)
        return
    along, up = (end[0] - start[0]) / count, (end[1] - start[1]) / count
    for number in range(count):
        x, y = start[0] + number * along, start[1] + number * up
        yield x + 0.4 * along, y + 0.4 * up, x + 0.8 * along, y + 0.8 * up


def _carried(stroke: Stroke, field: TurtleField) -> Stroke:
    x0, y0, x1, y1, color, width = stroke
    return (*field.place(x0, y0), *field.place(x1, y1), color, width)
