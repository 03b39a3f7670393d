"""Trails of the turtles' pens: strokes to draw, the colour at a point, a service for strokes.

turtlesim's topics contain neither pens nor earlier strokes. tftool's simulator therefore has a
hidden service, `<node>/_drawing`: as in ROS 2, lists of services omit names that begin with an
underscore.
"""

import math
from array import array
from collections import deque
from itertools import islice
from typing import Any, Final, NamedTuple

from tftool.base.color import Color
from tftool.geometry.motion import FIELD, PIXELS_PER_METRE, WINDOW
from tftool.messages.classes import INTERFACES
from tftool.world.node import Node

BLANK = Color(255, 255, 255)
"""Colour that the sensor reads where nothing was drawn: the layer is transparent white."""

KEPT_SEGMENTS = 20_000
"""Number of strokes stored for drawing; the colour sensor sees all."""


class Segment(NamedTuple):
    """Straight stroke of a pen: x and y of both ends in metres, colour, width in pixels."""

    x0: float
    y0: float
    x1: float
    y1: float
    color: Color
    width: int


class Trail:
    """Strokes of all turtles' pens, which are drawn below the turtles.

    Pixels are painted only when a colour is read, which most worlds never do.

    Attributes:
        segments: The newest strokes, oldest first.
        drawn: Number of strokes since the trail was last erased.
        wipes: Number of times that the trail was erased.
    """

    def __init__(self) -> None:
        self.segments: deque[Segment] = deque(maxlen=KEPT_SEGMENTS)
        self.drawn = 0
        self.wipes = 0
        self._unpainted: deque[Segment] = deque()
        self._pixels = _Pixels()

    def draw(self, segment: Segment) -> None:
        """Add a stroke to the trail."""
        self.segments.append(segment)
        self.drawn += 1
        self._unpainted.append(segment)
        # Unpainted strokes are limited, too: beyond it, one old stroke is painted per new one.
        if len(self._unpainted) > KEPT_SEGMENTS:
            self._pixels.paint(self._unpainted.popleft())

    def wipe(self) -> None:
        """Erase all strokes."""
        self.segments.clear()
        self._unpainted.clear()
        self._pixels = _Pixels()
        self.drawn = 0
        self.wipes += 1

    def color_at(self, x: float, y: float) -> Color:
        """Return the colour of the pixel nearest to a point, in metres."""
        while self._unpainted:
            self._pixels.paint(self._unpainted.popleft())
        return self._pixels.color_at(x, y)


class _Pixels:
    """Image of 500 rows of palette indices; a row is created when first painted."""

    def __init__(self) -> None:
        self._rows: list[array[int] | None] = [None] * WINDOW
        self._palette: list[Color] = [BLANK]
        self._numbers: dict[Color, int] = {BLANK: 0}

    def color_at(self, x: float, y: float) -> Color:
        column, row = _nearest(x * PIXELS_PER_METRE), _nearest((FIELD - y) * PIXELS_PER_METRE)
        if not (0 <= column < WINDOW and 0 <= row < WINDOW):
            return BLANK
        pixels = self._rows[row]
        return BLANK if pixels is None else self._palette[pixels[column]]

    def paint(self, segment: Segment) -> None:
        """Colour every pixel whose centre is on the stroke; a stroke has square ends.

        A stroke is a rectangle that exceeds both ends by half the stroke's width. The pixels
        nearest to the ends always belong to the stroke, even to a very thin stroke.
        """
        number = self._number(segment.color)
        x0, y0 = segment.x0 * PIXELS_PER_METRE, (FIELD - segment.y0) * PIXELS_PER_METRE
        x1, y1 = segment.x1 * PIXELS_PER_METRE, (FIELD - segment.y1) * PIXELS_PER_METRE
        length = math.hypot(x1 - x0, y1 - y0)
        along_x, along_y = ((x1 - x0) / length, (y1 - y0) / length) if length > 0.0 else (1.0, 0.0)
        half = segment.width / 2
        reach = half * (abs(along_x) + abs(along_y))

        for row in range(
            max(0, math.ceil(max(min(y0, y1) - reach, 0.0))),
            math.floor(min(max(y0, y1) + reach, WINDOW - 1.0)) + 1,
        ):
            down = row - y0
            # Along the stroke from -half to length + half, across it from -half to half.
            first, last = _between(along_x, down * along_y, -half, length + half)
            left, right = _between(-along_y, down * along_x, -half, half)
            self._fill(row, x0 + max(first, left), x0 + min(last, right), number)
        for x, y in ((x0, y0), (x1, y1)):
            # Far outside nothing is painted; checked first, because infinity has no pixel.
            if -1.0 < y < WINDOW:
                self._fill(_nearest(y), _nearest(x), _nearest(x), number)

    def _fill(self, row: int, left: float, right: float, number: int) -> None:
        # Limited to the layer first, because an empty range is (inf, -inf).
        first = math.ceil(min(max(left, 0.0), float(WINDOW)))
        last = math.floor(max(min(right, WINDOW - 1.0), -1.0))
        if first > last or not 0 <= row < WINDOW:
            return
        pixels = self._rows[row]
        if pixels is None:
            pixels = self._rows[row] = array("I", bytes(4 * WINDOW))
        count = last - first + 1
        pixels[first : last + 1] = array("I", (number,)) * count

    def _number(self, color: Color) -> int:
        number = self._numbers.get(color)
        if number is None:
            number = self._numbers[color] = len(self._palette)
            self._palette.append(color)
        return number


def _nearest(coordinate: float) -> int:
    """Return the index of the pixel nearest to a coordinate; halves are rounded up."""
    return math.floor(coordinate + 0.5)


def _between(slope: float, offset: float, low: float, high: float) -> tuple[float, float]:
    """Return the range of t for which low <= slope * t + offset <= high; (inf, -inf) if empty."""
    if slope == 0.0:
        return (-math.inf, math.inf) if low <= offset <= high else (math.inf, -math.inf)
    first, last = (low - offset) / slope, (high - offset) / slope
    return (first, last) if slope > 0.0 else (last, first)


SERVICE: Final = "_drawing"

MOST_STROKES: Final = 2000
"""Largest number of strokes in one response; the next response continues there."""

INTERFACES.add(
    "tftool_interfaces",
    {
        ("srv", "Drawing"): "int64 began\nuint64 wipes\nuint64 drawn\n---\n"
        "int64 began\nuint64 wipes\nuint64 first\nuint64 drawn\nfloat32[] ends\nuint8[] pens\n"
    },
)

KIND: Final[Any] = INTERFACES.find("tftool_interfaces", "srv", "Drawing")
"""Type of the service for strokes.

Request: the sheet that the client has (when its simulator started, and how often it was cleared),
and the number of its strokes. Response: the present sheet, its strokes from `first` on (for each,
four numbers for its ends, then red, green, blue and width), and their total number."""


class DrawingService:
    """Service that returns the strokes of a trail that a client has not received yet."""

    def __init__(self, node: Node, trail: Trail) -> None:
        """Serve the strokes of a trail until the node ends."""
        self._trail = trail
        self._began = node.clock.now()
        node.serve(f"{node.name}/{SERVICE}", self._answer, KIND)

    def _answer(self, request: Any) -> Any:
        trail = self._trail
        is_same = (request.began, request.wipes) == (self._began, trail.wipes)
        forgotten = trail.drawn - len(trail.segments)
        first = max(forgotten, request.drawn if is_same and request.drawn <= trail.drawn else 0)
        told = KIND.Response(began=self._began, wipes=trail.wipes, first=first, drawn=trail.drawn)
        start = first - forgotten
        for stroke in islice(trail.segments, start, start + MOST_STROKES):
            told.ends.extend(stroke[:4])
            told.pens.extend(
                (stroke.color.r, stroke.color.g, stroke.color.b, min(stroke.width, 255))
            )
        return told


class FarDrawing:
    """Copy of the trail of a simulator in another process, filled with the received strokes.

    Attributes:
        is_whole: Whether the copy was complete after the last response.
    """

    def __init__(self, trail: Trail) -> None:
        """Copy the received strokes into `trail`."""
        self.is_whole = False
        self._trail = trail
        self._began = -1
        self._wipes = self._drawn = 0

    def request(self) -> Any:
        """Return a request for the strokes that have not been received yet."""
        return KIND.Request(began=self._began, wipes=self._wipes, drawn=self._drawn)

    def take(self, response: Any) -> bool:
        """Draw the strokes in a response; return whether the trail has changed."""
        is_new = (response.began, response.wipes) != (
            self._began,
            self._wipes,
        ) or response.first < self._drawn
        if is_new:
            self._trail.wipe()
            self._began, self._wipes = response.began, response.wipes
        strokes = min(len(response.ends) // 4, len(response.pens) // 4)
        for one in range(0, 4 * strokes, 4):
            r, g, b, width = response.pens[one : one + 4]
            x0, y0, x1, y1 = response.ends[one : one + 4]
            self._trail.draw(Segment(x0, y0, x1, y1, Color(r, g, b), width))
        self._drawn = response.first + strokes
        self.is_whole = self._drawn >= response.drawn or not strokes
        return is_new or strokes > 0
