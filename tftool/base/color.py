"""Colours as 8-bit channels, used by screens and turtles' pens."""

from typing import Final, NamedTuple


class Color(NamedTuple):
    """A colour, each channel from 0 to 255."""

    r: int
    g: int
    b: int


BACKGROUND: Final = Color(69, 86, 255)
"""The turtles' field, unless parameters say otherwise."""
