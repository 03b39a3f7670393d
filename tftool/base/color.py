"""Colours with 8-bit channels, for screens and for turtles' pens."""

from typing import Final, NamedTuple


class Color(NamedTuple):
    """A colour; red, green and blue from 0 to 255."""

    r: int
    g: int
    b: int


BACKGROUND: Final = Color(69, 86, 255)
"""Default colour of the turtles' field."""
