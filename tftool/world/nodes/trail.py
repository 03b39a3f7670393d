"""What the turtles' pens leave behind: segments to draw, and the colour under a point."""

import math
from array import array
from collections import deque
from typing import NamedTuple

from tftool.base.color import Color
from tftool.geometry.motion.unicycle import FIELD, PIXELS_PER_METRE, WINDOW

BLANK = Color(255, 255, 255)
"""What the colour sensor reads where nothing was drawn: the layer is transparent white."""

KEPT_SEGMENTS = 20_000
"""How many segments are kept for drawings; the colour sensor forgets none."""


class Segment(NamedTuple):
    """One straight stroke of a pen, ends in metres, width in pixels."""

    x0: float
    y0: float
    x1: float
    y1: float
    color: Color
    width: int


class Trail:
    """The drawing layer under all turtles.

    Pixels are painted only when a colour is asked for: most worlds never do that.

    Attributes:
        segments: The newest segments, oldest first.
        drawn: How many segments were drawn since the last wipe.
        wipes: How often the layer was wiped.
    """

    def __init__(self) -> None:
        self.segments: deque[Segment] = deque(maxlen=KEPT_SEGMENTS)
        self.drawn = 0
        self.wipes = 0
        self._unpainted: deque[Segment] = deque()
        self._pixels = _Pixels()

    def draw(self, segment: Segment) -> None:
        """Add a stroke."""
        self.segments.append(segment)
        self.drawn += 1
        self._unpainted.append(segment)
        # What waits is bounded too: beyond it one old stroke is painted per new one.
        if len(self._unpainted) > KEPT_SEGMENTS:
            self._pixels.paint(self._unpainted.popleft())

    def wipe(self) -> None:
        """Start over with a blank layer."""
        self.segments.clear()
        self._unpainted.clear()
        self._pixels = _Pixels()
        self.drawn = 0
        self.wipes += 1

    def color_at(self, x: float, y: float) -> Color:
        """The colour of the pixel nearest to a point, in metres."""
        while self._unpainted:
            self._pixels.paint(self._unpainted.popleft())
        return self._pixels.color_at(x, y)


class _Pixels:
    """500 rows of palette numbers, a row made when it is first painted."""

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
        """Set every pixel whose middle lies on the stroke, which has square ends.

        A stroke is a rectangle, `width` across, that reaches half a width beyond
        both ends. The pixels nearest to the ends belong to it however thin it is.
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
            # Far outside nothing is painted; asked first, as infinity has no pixel.
            if -1.0 < y < WINDOW:
                self._fill(_nearest(y), _nearest(x), _nearest(x), number)

    def _fill(self, row: int, left: float, right: float, number: int) -> None:
        # Held to the layer on both sides first: an empty range is (inf, -inf).
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
    """The pixel nearest to a coordinate; halves go up, on every side of the layer alike."""
    return math.floor(coordinate + 0.5)


def _between(slope: float, offset: float, low: float, high: float) -> tuple[float, float]:
    """The range of t for which low <= slope * t + offset <= high; empty as (inf, -inf)."""
    if slope == 0.0:
        return (-math.inf, math.inf) if low <= offset <= high else (math.inf, -math.inf)
    first, last = (low - offset) / slope, (high - offset) / slope
    return (first, last) if slope > 0.0 else (last, first)
