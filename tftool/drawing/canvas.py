"""Canvas that draws frames on a plane as coloured text lines, at any size.

Trails, axes and lines to parents are drawn in braille (eight dots to a cell), turtles in blocks or
as arrows. Scales account for cells that are twice as high as wide. The data to draw are a frozen
`PlanePicture`, independent of buffers and simulators.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import numpy as np
from rich.segment import Segment

from tftool.base.color import Color
from tftool.drawing import sprites, theme
from tftool.drawing.cells import (
    Cell,
    CellSheet,
    Dots,
    Line,
    Mask,
    Numbers,
    Points,
    blended,
    packed,
)
from tftool.drawing.labels import ON_AXIS, ON_LINE, TAKEN, Label, PlacedLabel, Placer, label_text
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
from tftool.geometry.motion import FIELD

MOST_NAMED: Final = 80
"""Largest number of frames whose names are written."""

PIXELS_PER_METRE: Final = 45.0
"""Pixels per metre in turtlesim, where the width of a pen is given in pixels."""

WITH_SCALE: Final = (26, 9)
"""Smallest columns and rows of a picture with a scale."""


THICK_FROM: Final = 26
"""Smallest number of rows of a picture whose axes are two dots wide."""


class _KeptDrawing:
    """Cache of a drawing: the dots of the strokes drawn so far, and the number of these strokes."""

    key: object = None
    done = 0
    dots = Dots(0, 0)


class Canvas:
    """Drawer of pictures of one size, with a cache of the trails for the next picture.

    Args:
        columns: Width of the picture in cells, including the scale.
        rows: Height of the picture in cells, including the scale.
        ascii_only: Whether to draw with ASCII characters only.
        mono: Whether to draw without colours: axes then have letters, turtles are arrows.
        palette: Colours of the screen.
        scaled: Whether to write scales in metres at the left and below, if there is room.

    Attributes:
        asked: Requested width and height in cells, including the scale.
        columns: Width in cells without the scale.
        rows: Height in cells without the scale.
        gutter: Width in cells of the scale at the left.
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
        self._paper = theme.paper(palette)
        # Not equal to any view, so that the first picture is drawn from scratch.
        self._view = Viewport(0.0, 0.0, 0.0)
        self._placer = Placer(self.columns, self.rows)
        self._sheet: CellSheet | None = None

    def lines(self, picture: PlanePicture, view: Viewport) -> list[Line]:
        """Draw a picture; return it as one line of text per row of the canvas."""
        if not self.columns or not self.rows:
            return [[] for _ in range(self.rows)]
        if view != self._view:
            self._view = view
            self._grid = self._gridded()
            self._pen, self._trails = _KeptDrawing(), _KeptDrawing()
        field = picture.field
        self._inside = self._cells_inside(field)
        sheet = CellSheet(self.columns, self.rows)
        sheet.lay(self._grid, self._ground_color("grid", field), ascii_only=self._ascii)
        if field is not None:
            sheet.grounds[self._inside] = packed(field.color)
            self._grow(self._pen, picture.pen, (field.x, field.y, field.theta), field)
            sheet.lay(self._pen.dots, ascii_only=self._ascii)
        trails, dots = picture.trails, self._trails.dots
        if self._trails.key is not trails:
            self._trails.key = trails
            dots = self._trails.dots = Dots(self.columns, self.rows)
            dots.draw(self._ends(trails.ends[..., :2]), trails.colors)
        sheet.lay(dots, self._faint(dots.colors, field), ascii_only=self._ascii)
        self._sign(sheet, picture, self._mark(sheet, picture))
        step = grid_step(view.per_row)
        drawn = sheet.lines(self._sheet)
        self._sheet = sheet
        if self.gutter:
            labels = self._labels_at_left(step)
            drawn = [[labels[row], *line] for row, line in enumerate(drawn)]
        return [*drawn, self._below(step)] if self._footer else drawn

    # The ground and what is drawn on it

    def _ends(self, lines: Points) -> Points:
        """Convert the ends of lines, shape (n, 4) or (n, 2, 2), from metres to dots, (n, 2, 2)."""
        view = self._view
        with np.errstate(all="ignore"):
            ends = (lines.reshape(-1, 2, 2) - (view.left, view.bottom)) * (4.0 / view.per_row)
        ends[..., 1] = 4.0 * self.rows - ends[..., 1]
        return ends

    def _gridded(self) -> Dots:
        """Return the dots of the grid: lines or, in a picture without colours, only crossings."""
        dots, view = Dots(self.columns, self.rows), self._view
        right = view.left + 0.5 * view.per_row * self.columns
        top, step = view.bottom + view.per_row * self.rows, grid_step(view.per_row)
        xs, ys = list(_multiples(view.left, right, step)), list(_multiples(view.bottom, top, step))
        if self._plain:
            lines = [(x, y, x, y) for x in xs for y in ys]
        else:
            lines = [(x, view.bottom, x, top) for x in xs]
            lines += [(view.left, y, right, y) for y in ys]
        dots.draw(self._ends(np.array(lines, float)), 0)
        return dots

    def _cells_inside(self, field: TurtleField | None) -> Mask:
        """Return a mask of the cells that are on the turtles' field."""
        inside = np.zeros((self.rows, self.columns), bool)
        if field is not None:
            corners = [self.place(*corner) for corner in field.corners()]
            for row in range(self.rows):
                ends = _crossings(corners, row + 0.5)
                if ends is not None:
                    first = max(0, math.ceil(ends[0] - 0.5))
                    inside[row, first : max(first, math.floor(ends[1] + 0.5))] = True
        return inside

    def _ground_color(self, role: str, field: TurtleField | None) -> Numbers | int:
        """Return the colour (0xRRGGBB) of a role such as "grid"; with a field, one for each cell.

        The roles are the names of colours in `PaperColors`.
        """
        beside = packed(getattr(self._paper, role))
        if field is None:
            return beside
        return np.where(self._inside, packed(getattr(theme.on_field(field.color), role)), beside)

    def _grow(
        self,
        cache: "_KeptDrawing",
        drawn: Drawn,
        position: object,
        field: TurtleField | None = None,
    ) -> None:
        """Draw the new strokes of `drawn` into a cache.

        All strokes are drawn again if the drawing has another `position`, or was replaced or
        shortened.
        """
        key, total = (position, drawn.edition), drawn.forgotten + len(drawn.strokes)
        if cache.key != key or total < cache.done:
            cache.key, cache.done = key, 0
            cache.dots = Dots(self.columns, self.rows)
        new = drawn.strokes[max(0, cache.done - drawn.forgotten) :]
        cache.done = total
        if not new:
            return
        lines = np.array([stroke[:4] for stroke in new])
        if field is not None:
            lines = field.placed(lines)
        colors = np.array([packed(stroke[4]) for stroke in new])
        # Dots have gaps between them, so a trail needs extra dots to look as wide as it is.
        per_pixel = 1.3 / PIXELS_PER_METRE * 4.0 / self._view.per_row
        wide = np.array([max(1, round(per_pixel * stroke[5])) for stroke in new])
        for one in np.unique(wide).tolist():
            some = wide == one
            cache.dots.draw(self._ends(lines[some]), colors[some], one)

    def _faint(self, colors: Numbers, field: TurtleField | None) -> Numbers:
        """Return paler versions of the colours (0xRRGGBB) of cells, for the trails."""
        beside = colors
        if self._palette is theme.LIGHT:
            beside = blended(beside, theme.INK, 0.55)
        beside = blended(beside, self._palette.panel, 0.3)
        if field is None:
            return beside
        return np.where(self._inside, blended(colors, field.color, 0.1), beside)

    # Drawn above it

    def _mark(self, sheet: CellSheet, picture: PlanePicture) -> Points:
        """Draw walls, axes and lines to parents.

        Returns:
            Cost of each cell for a label that covers the cell, shape (rows, columns).
        """
        view, field = self._view, picture.field
        links = [
            ends
            for one in picture.frames
            if one.parent is not None
            for ends in _dashes((one.x, one.y), one.parent, 0.25 * view.per_row)
        ]
        # If the field has no colour of its own, its edge is drawn.
        edges = [] if field is None or not self._plain else list(_edges(field, _SIDES))
        walls = [] if field is None else list(_edges(field, field.walls))
        link = self._ground_color("link", field)
        layers: list[tuple[list[tuple[float, float, float, float]], Numbers | int]]
        layers = [(links + edges, link), (walls, packed(theme.WALL))]
        length = axis_length(view, self.rows)
        for number, role in enumerate(("x_axis", "y_axis", "z_axis")):
            lines = []
            for one in picture.frames:
                along, up = one.axes[number] if one.is_frame and number < len(one.axes) else (0, 0)
                if (reach := math.hypot(along, up)) <= 0.05:
                    continue
                end = one.x + length * along, one.y + length * up
                lines.append((one.x, one.y, *end))
                if self.rows >= THICK_FROM:
                    # A second dot beside the first, so that the axis is two dots wide.
                    x, y = -0.25 * view.per_row * up / reach, 0.25 * view.per_row * along / reach
                    lines.append((one.x + x, one.y + y, end[0] + x, end[1] + y))
            layers.append((lines, self._ground_color(role, field)))
        costs = np.zeros(self._inside.shape)
        for number, (lines, color) in enumerate(layers):
            if lines:
                dots = Dots(self.columns, self.rows)
                dots.draw(self._ends(np.array(lines)), 0)
                costs[sheet.lay(dots, color, ascii_only=self._ascii)] = (
                    ON_LINE if number < 2 else ON_AXIS
                )
        return costs

    def _sign(self, sheet: CellSheet, picture: PlanePicture, costs: Points) -> None:
        """Draw turtles, origins and names over the lines and axes."""
        hard: set[tuple[int, int]] = set()
        labels: list[Label] = []
        per_metre = 1.0 / self._view.per_row
        bodies = per_metre >= sprites.BODY_FROM and not self._plain
        # Turtles are drawn below frames at the same place, and the first turtle on top.
        below = [one for one in picture.frames if one.is_turtle][::-1]
        if not bodies:
            below.reverse()
        above = [one for one in picture.frames if not one.is_turtle]
        for one in (*below, *above):
            place = self.place(one.x, one.y)
            if not self._is_near(place):
                continue
            cells = self._sprite(
                one,
                place,
                self._ink_of(one, on_field=self._on_field(place)),
                per_metre,
                bodies,
                hard,
            )
            for column, row, cell in cells:
                if 0 <= column < self.columns and 0 <= row < self.rows:
                    sheet.put(column, row, cell)
                    hard.add((row, column))
        for one in _by_weight(picture):
            place = self.place(one.x, one.y)
            if self._is_near(place) and len(labels) < MOST_NAMED:
                name = one.name if one.is_frame else f"{one.name} (no frame)"
                text = label_text(name, one.age, self.columns, 10, ascii_only=self._ascii)
                row = min(self.rows - 1, max(0, math.floor(place[1])))
                reach = 1 if self._plain else 2
                if one.is_turtle and bodies:
                    reach = math.ceil(1.6 * per_metre)
                labels.append(Label(one.name, text, math.floor(place[0]), row, reach))
        for taken in hard:
            costs[taken] = TAKEN
        named = {one.name: one for one in picture.frames}
        for placed in self._placer.placed(labels, costs):
            sheet.write(placed.column, placed.row, placed.label.text,
                        self._letter_inks(placed, named[placed.label.name]))  # fmt: skip

    def _letter_inks(self, placed: PlacedLabel, frame: PlaneFrame) -> list[int]:
        """Return a colour for each letter of a name, readable on the background of its cell."""
        inks = []
        for on_field in (False, True):
            ink = self._ink_of(frame, on_field=on_field)
            brightens = on_field and not theme.is_stale(frame.age)
            inks.append(packed(theme.blend(ink, theme.WHITE, 0.4) if brightens else ink))
        return [inks[on] for on in self._inside[placed.row, placed.column :].tolist()]

    def _sprite(
        self,
        frame: PlaneFrame,
        place: Point,
        color: Color,
        per_metre: float,
        bodies: bool,
        taken: set[tuple[int, int]],
    ) -> Iterable[tuple[int, int, Cell]]:
        column, row = math.floor(place[0]), math.floor(place[1])
        if not frame.is_turtle:
            return [(column, row, Cell("o" if self._ascii else "●", color, None, True))]
        if bodies:
            return sprites.body(*place, frame.theta, color, per_metre)
        if (row, column) in taken:
            # Another turtle is in this cell, so draw a small arrow beside that turtle.
            free = next(
                (
                    column + aside
                    for aside in (2, -2, 1, -1, 3, -3)
                    if (row, column + aside) not in taken and 0 <= column + aside < self.columns
                ),
                column,
            )
            arrows = sprites.ASCII_ARROWS if self._ascii else sprites.ARROWS
            return [(free, row, Cell(arrows[sprites.octant(frame.theta)], color, None, True))]
        return sprites.badge(*place, frame.theta, color, per_metre, blocks=not self._ascii)

    def _ink_of(self, frame: PlaneFrame, *, on_field: bool) -> Color:
        """Return a colour for a frame that is readable on its background; amber or red if stale."""
        palette = theme.DARK if on_field else self._palette
        return theme.of_age(theme.readable(theme.of_name(frame.name), palette), frame.age, palette)

    def _on_field(self, place: Point) -> bool:
        column, row = math.floor(place[0]), math.floor(place[1])
        is_seen = 0 <= row < self.rows and 0 <= column < self.columns
        return is_seen and bool(self._inside[row, column])

    def place(self, x: float, y: float) -> Point:
        """Return the column and row, in cells, of a point given in metres."""
        view = self._view
        # A corner of the visible part may be farther away than `FARTHEST`.
        if not abs(x) + abs(y) <= 1e3 * FARTHEST:
            return math.inf, math.inf
        column = (x - view.left) / view.per_row * 2.0
        row = self.rows - (y - view.bottom) / view.per_row
        # Points exactly on the right and lower edges belong to the picture.
        if column == self.columns:
            column -= 0.01
        if row == self.rows:
            row -= 0.01
        return column, row

    def _is_near(self, place: Point) -> bool:
        return -2.0 <= place[0] < self.columns + 2.0 and -2.0 <= place[1] < self.rows + 2.0

    # The scale

    def _labels_at_left(self, step: float) -> list[Segment]:
        view, width = self._view, self.gutter - 1
        texts = [""] * self.rows
        for y in _multiples(view.bottom, view.bottom + view.per_row * self.rows, step):
            row = math.floor(self.place(0.0, y)[1])
            if 0 <= row < self.rows:
                texts[row] = metres(y, step)
        style = theme.ink(theme.blend(self._palette.panel, self._palette.dim, 0.9))
        return [Segment(f"{text[:width]:>{width}} ", style) for text in texts]

    def _below(self, step: float) -> Line:
        view = self._view
        signs = [" "] * (self.columns + self.gutter)
        signs[self.gutter - 4] = "m"
        free = self.gutter - 1
        for x in _multiples(view.left, view.left + 0.5 * view.per_row * self.columns, step):
            text = metres(x, step)
            column = self.gutter + math.floor(self.place(x, 0.0)[0])
            start = column - (len(text) - 1) // 2 - (text[0] == "-")
            if free <= start and start + len(text) <= len(signs):
                signs[start : start + len(text)] = text
                free = start + len(text) + 1
        style = theme.ink(theme.blend(self._palette.panel, self._palette.dim, 0.9))
        return [Segment("".join(signs), style)]


def axis_length(view: Viewport, rows: int) -> float:
    """Return the length of the frames' axes in metres, about a tenth of the picture's height."""
    return view.per_row * min(4.0, max(1.6, rows / 10.0))


def metres(value: float, step: float) -> str:
    """Format the label of a tick; the distance `step` between ticks sets the number of decimals."""
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:.{digits}f}"
    return "0" if not text.strip("-0.") else text


def _by_weight(picture: PlanePicture) -> list[PlaneFrame]:
    """Sort frames by the importance of their labels: the chosen pair, turtles, other frames."""
    return sorted(
        picture.frames,
        key=lambda one: (one.name not in picture.pair, not one.is_turtle, one.parent is None),
    )


def _multiples(first: float, last: float, step: float) -> Iterator[float]:
    for number in range(math.ceil(first / step - 1e-9), math.floor(last / step + 1e-9) + 1):
        yield number * step


def _crossings(corners: Sequence[Point], row: float) -> tuple[float, float] | None:
    """Return the columns where a row enters and leaves a convex shape; None if the row misses."""
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
    """Yield the dashes (x1, y1, x2, y2) of a line; if there are over 400, yield the whole line."""
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
