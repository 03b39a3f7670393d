"""Pictures of a turtle at any size: a body if there is room, else an arrow.

A body is drawn with quadrant blocks: four pixels and two colours per cell.
"""

import math
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from tftool.base.color import Color
from tftool.drawing import theme
from tftool.drawing.cells import Cell

ARROWS = "→↗↑↖←↙↓↘"
ASCII_ARROWS = ">7^F<LvJ"
"""Arrow for each octant, east first, counter-clockwise; 7, F, L and J point with their corners."""

_QUADRANTS = " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█"
"""Block characters by mask: 1 upper left, 2 upper right, 4 lower left, 8 lower right."""

BODY_FROM = 2.4
"""Smallest number of rows per metre at which a body is drawn; below, an arrow is clearer."""

BADGE_FROM = 0.9
"""Smallest number of rows per metre at which an arrow has a badge, about a metre wide."""


def octant(theta: float) -> int:
    """Return the nearest of eight headings: 0 is east, 2 is north, counter-clockwise."""
    # Reduced to one turn first, because a heading near the largest float would overflow.
    return round(math.remainder(theta, math.tau) / (math.pi / 4.0)) % 8


# Parts of a turtle, nose along +u, in metres: centre, half axes, colour index.
# A point belongs to the first part that contains it.
_HEAD, _SHELL, _PLATE, _LEG = range(4)
_PARTS = (
    (0.66, 0.0, 0.27, 0.20, _HEAD),
    (-0.04, 0.0, 0.24, 0.20, _PLATE),
    (0.0, 0.0, 0.48, 0.40, _SHELL),
    (0.30, 0.42, 0.14, 0.12, _LEG),
    (0.30, -0.42, 0.14, 0.12, _LEG),
    (-0.34, 0.40, 0.12, 0.11, _LEG),
    (-0.34, -0.40, 0.12, 0.11, _LEG),
    (-0.58, 0.0, 0.14, 0.05, _LEG),
)
_REACH = 0.94
_NOTHING = -1


def body(
    x: float, y: float, theta: float, color: Color, per_metre: float
) -> Iterator[tuple[int, int, Cell]]:
    """Draw the body of a turtle, about a metre wide.

    Args:
        x: Column of the turtle's centre, from the left edge, in cells.
        y: Row of the turtle's centre, from the top edge, in cells.
        theta: Heading in radians, counter-clockwise.
        color: Colour of the skin; the shell is darker.
        per_metre: Rows per metre; columns per metre are twice as many.

    Yields:
        (column, row, cell), also for cells outside the screen, which the caller must clip.
    """
    shades = {
        _HEAD: color,
        _LEG: theme.blend(color, theme.INK, 0.25),
        _SHELL: theme.blend(color, theme.INK, 0.7),
        _PLATE: theme.blend(color, theme.INK, 0.45),
    }
    cosine, sine = math.cos(theta), math.sin(theta)
    reach = _REACH * per_metre
    top, left = math.floor(y - reach), math.floor(x - 2.0 * reach)
    down, across = math.ceil(y + reach) - top, math.ceil(x + 2.0 * reach) - left
    right = (left + 0.25 + 0.5 * np.arange(2 * across) - x) / (2.0 * per_metre)
    up = -(top + 0.25 + 0.5 * np.arange(2 * down)[:, None] - y) / per_metre
    u, v = cosine * right + sine * up, cosine * up - sine * right
    parts = np.full(u.shape, _NOTHING)
    for centre_u, centre_v, half_u, half_v, part in reversed(_PARTS):
        parts[((v - centre_v) / half_v) ** 2 + ((u - centre_u) / half_u) ** 2 <= 1.0] = part
    # The four quadrants of each cell, in a row.
    cells = parts.reshape(down, 2, across, 2).swapaxes(1, 2).reshape(down, across, 4)
    for row, column in np.argwhere((cells != _NOTHING).any(2)).tolist():
        sign, ink, ground = _quadrants(tuple(cells[row, column].tolist()))
        yield left + column, top + row, Cell(sign, shades.get(ink), shades.get(ground))


@lru_cache
def _quadrants(parts: tuple[int, ...]) -> tuple[str, int, int]:
    """Return the block character for a cell of four pixels, and its foreground and background."""
    seen = Counter(part for part in parts if part != _NOTHING).most_common()
    first = seen[0][0]
    is_edge = _NOTHING in parts
    if len(seen) == 1 and not is_edge:
        # By the background colour, not a full block: blocks leave gaps between spaced lines.
        return " ", _NOTHING, first
    mask = sum(
        1 << corner
        for corner, part in enumerate(parts)
        if part == first or (part != _NOTHING and is_edge)
    )
    return _QUADRANTS[mask], first, _NOTHING if is_edge else seen[1][0]


def badge(
    x: float, y: float, theta: float, color: Color, per_metre: float, *, blocks: bool = True
) -> Iterator[tuple[int, int, Cell]]:
    """Draw a turtle as an arrow, with a coloured background if there are enough rows per metre.

    Arguments and results are those of `body`; without `blocks`, the arrow is an ASCII character.
    """
    column, row = math.floor(x), math.floor(y)
    if not blocks:
        yield column, row, Cell(ASCII_ARROWS[octant(theta)], color, None, True)
        return
    arrow = ARROWS[octant(theta)]
    if per_metre < BADGE_FROM:
        yield column, row, Cell(arrow, color, None, True)
        return
    yield column - 1, row, Cell("▐", color)
    yield column, row, Cell(arrow, theme.INK, color, True)
    yield column + 1, row, Cell("▌", color)
