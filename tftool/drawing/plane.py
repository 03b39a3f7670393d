"""Data of a 2-D picture of frames, seen along the z axis of one fixed frame.

Units are metres and radians in the fixed frame. `drawing/canvas.py` draws the picture.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.color import BACKGROUND, Color
from tftool.drawing.cells import Stroke
from tftool.geometry.motion import FIELD

_APART: Final = 3.4
"""Smallest distance of two grid lines, in rows of the terminal."""

FARTHEST: Final = 1e9
"""Metres from the fixed frame beyond which nothing is drawn."""

Point: TypeAlias = tuple[float, float]

Box: TypeAlias = tuple[float, float, float, float]
"""Left, bottom, right and top of a rectangle, metres."""


@dataclass(frozen=True, slots=True)
class PlaneFrame:
    """One frame of the picture.

    Attributes:
        name: Name, which determines the colour.
        x: Coordinate of the origin, metres.
        y: Coordinate of the origin, metres.
        axes: Ends of the unit x, y and z axes, from the origin, projected on the plane.
        parent: Origin of the parent; None for a root.
        age: Seconds since the frame's newest transform; 0 for static frames.
        is_turtle: Whether the frame is drawn as a turtle.
        is_frame: Whether the frame is broadcast and has axes; a turtle may have no frame.
    """

    name: str
    x: float
    y: float
    axes: tuple[Point, ...] = ((1.0, 0.0), (0.0, 1.0))
    parent: Point | None = None
    age: float = 0.0
    is_turtle: bool = False
    is_frame: bool = True

    @property
    def theta(self) -> float:
        """Angle from the fixed frame's x axis to the x axis of this frame in the plane, radians."""
        return math.atan2(self.axes[0][1], self.axes[0][0])


@dataclass(frozen=True, slots=True)
class TurtleField:
    """The turtles' square field, placed in the plane of the picture.

    Attributes:
        x: Coordinate of the lower left corner, metres.
        y: Coordinate of the lower left corner, metres.
        theta: Angle from the x axis of the plane to the x axis of the field, radians.
        color: Background colour.
        walls: Sides that a turtle just hit: "left", "right", "bottom", "top".
    """

    x: float = 0.0
    y: float = 0.0
    theta: float = 0.0
    color: Color = BACKGROUND
    walls: frozenset[str] = frozenset()

    def place(self, x: float, y: float) -> Point:
        """Convert a point from coordinates of the field to coordinates of the plane."""
        cosine, sine = math.cos(self.theta), math.sin(self.theta)
        return self.x + cosine * x - sine * y, self.y + sine * x + cosine * y

    def placed(self, lines: npt.NDArray[np.floating]) -> npt.NDArray[np.floating]:
        """Convert lines, shape (n, 4), from coordinates of the field to those of the plane."""
        cosine, sine = math.cos(self.theta), math.sin(self.theta)
        x, y = lines.T.reshape(2, 2, -1).swapaxes(0, 1)
        with np.errstate(invalid="ignore", over="ignore"):
            placed = self.x + cosine * x - sine * y, self.y + sine * x + cosine * y
        return np.stack(placed, 1).reshape(4, -1).T

    def corners(self) -> tuple[Point, ...]:
        """Return the corners: lower left, lower right, upper right, upper left."""
        return tuple(self.place(x, y) for x, y in ((0, 0), (FIELD, 0), (FIELD, FIELD), (0, FIELD)))


@dataclass(frozen=True, slots=True)
class Drawn:
    """Strokes of one drawing: new strokes are appended, until another drawing replaces all strokes.

    Attributes:
        strokes: The newest strokes, oldest first.
        forgotten: Number of strokes dropped before the first of `strokes`.
        edition: Number that changes when the drawing is replaced.
    """

    strokes: Sequence[Stroke] = ()
    forgotten: int = 0
    edition: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class ColoredLines:
    """Straight lines, each with its colour.

    Attributes:
        ends: Both ends of each line, metres, shape (n, 2, 3).
        colors: Colour (0xRRGGBB) of each line, shape (n,).
    """

    ends: npt.NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 2, 3)))
    colors: npt.NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, np.int64))


@dataclass(frozen=True, slots=True)
class PlanePicture:
    """Data of a picture of frames on a plane, at one time, in one fixed frame.

    Attributes:
        fixed: Name of the fixed frame; empty if there are no frames.
        frames: All frames of the fixed frame's tree, in order of registration.
        field: Field on which the turtles draw; None without a field, or without its pose.
        pen: Lines of the turtles' pens, in metres of the field.
        trails: Paths of moving frames, in metres of the fixed frame, oldest first.
        pair: Target and source of the shown pair, which a line connects.
        apart: Pictures of the other trees, each in the frame of the tree's root.
        nowhere: Frames of the fixed frame's tree that have no pose at this time.
    """

    fixed: str = ""
    frames: tuple[PlaneFrame, ...] = ()
    field: TurtleField | None = None
    pen: Drawn = Drawn()
    trails: ColoredLines = ColoredLines()
    pair: tuple[str, str] = ("", "")
    apart: tuple["PlanePicture", ...] = ()
    nowhere: tuple[str, ...] = ()

    def bounds(self) -> Box:
        """Return the box around the field, frames and trails, with a margin around outer frames."""
        field = None if self.field is None else _box(self.field.corners())
        points = [(one.x, one.y) for one in self.frames]
        if len(self.trails.ends):
            ends = self.trails.ends[..., :2]
            points += [tuple(ends.min((0, 1)).tolist()), tuple(ends.max((0, 1)).tolist())]
        if field is not None:
            points = [point for point in points if not _holds(field, point)]
            if not points:
                return field
        if not points:
            return -1.0, -1.0, 1.0, 1.0
        left, bottom, right, top = _box(points)
        room = max(0.08 * max(right - left, top - bottom), 0.5)
        wide = [(left - room, bottom - room), (right + room, top + room)]
        return _box(wide if field is None else [*wide, field[:2], field[2:]])


class Viewport(NamedTuple):
    """Visible part of a plane: lower left corner in metres, and metres per row of cells."""

    left: float
    bottom: float
    per_row: float


def fitted_view(box: Box, columns: int, rows: int) -> Viewport:
    """Return the viewport that shows a whole box in its centre; cells are twice as high as wide."""
    left, bottom, right, top = box
    per_row = max((right - left) / max(1, columns) * 2.0, (top - bottom) / max(1, rows), 1e-9)
    middle_x, middle_y = 0.5 * (left + right), 0.5 * (bottom + top)
    return Viewport(middle_x - 0.25 * columns * per_row, middle_y - 0.5 * rows * per_row, per_row)


def grid_step(per_row: float) -> float:
    """Return the step of a grid in metres, 1, 2 or 5 times a power of ten.

    Args:
        per_row: Metres per row of cells.
    """
    wanted = _APART * per_row
    power = 10.0 ** math.floor(math.log10(wanted))
    return next(power * step for step in (1.0, 2.0, 5.0, 10.0) if power * step >= wanted * 0.999)


def _box(points: Iterable[Point]) -> Box:
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _holds(box: Box, point: Point) -> bool:
    left, bottom, right, top = box
    slack = 1e-6
    return left - slack <= point[0] <= right + slack and bottom - slack <= point[1] <= top + slack
