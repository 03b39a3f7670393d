"""Colours of turtlesim, of frames by their names, and of screens and backgrounds.

In the browser, frames without new samples fade: see `screens/browser/page/model.js`.
"""

import zlib
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

from rich.style import Style

from tftool.base.color import Color
from tftool.base.stamps import FRAME_TIMEOUT

WALL = Color(255, 92, 87)
INK = Color(16, 20, 48)
WHITE = Color(255, 255, 255)

# These colours stay distinct and readable on turtlesim's blue, even if a terminal
# rounds them to its 256 colours.
_PALETTE = (
    Color(135, 255, 135),
    Color(255, 215, 95),
    Color(255, 135, 175),
    Color(95, 255, 255),
    Color(255, 175, 95),
    Color(215, 255, 95),
    Color(255, 175, 255),
    Color(175, 255, 215),
    Color(255, 255, 175),
    Color(215, 215, 255),
)


_SALT = "371"


def blend(start: Color, end: Color, share: float) -> Color:
    """Mix two colours; a `share` of 0 gives `start`, a `share` of 1 gives `end`."""
    return Color(
        round(start.r + share * (end.r - start.r)),
        round(start.g + share * (end.g - start.g)),
        round(start.b + share * (end.b - start.b)),
    )


def of_name(name: str) -> Color:
    """Return a name's colour, the same in every run on every machine.

    Names that end in a number use successive colours: `turtle1` and `turtle2` never look alike.
    `_SALT` was chosen so that neighbours in map, odom, base_link, world have different colours.
    """
    stem = name.rstrip("0123456789")
    number = name[len(stem) :][-9:]
    if number.isascii() and number:
        start = 0 if stem == "turtle" else _hash(stem)
        return _PALETTE[(start + int(number) - 1) % len(_PALETTE)]
    return _PALETTE[_hash(name) % len(_PALETTE)]


def _hash(name: str) -> int:
    return zlib.crc32(f"{_SALT}{name}".encode("utf-8", "replace"))


def hexadecimal(color: Color) -> str:
    """Format a colour as `#rrggbb`."""
    return f"#{color.r:02x}{color.g:02x}{color.b:02x}"


def ink(color: Color, *, bold: bool = False) -> Style:
    """Return the style of text in a colour."""
    return Style(color=hexadecimal(color), bold=bold or None)


class Palette(NamedTuple):
    """Colours of a dark or a light screen; the turtles' field has other colours."""

    ground: Color
    panel: Color
    text: Color
    dim: Color
    accent: Color
    warning: Color
    error: Color


DARK = Palette(
    ground=Color(17, 19, 28),
    panel=Color(24, 27, 40),
    text=Color(222, 226, 240),
    dim=Color(126, 133, 160),
    accent=Color(255, 215, 95),
    warning=Color(255, 183, 77),
    error=Color(255, 110, 110),
)
LIGHT = Palette(
    ground=Color(238, 240, 247),
    panel=Color(250, 251, 254),
    text=Color(30, 34, 52),
    dim=Color(104, 110, 135),
    accent=Color(52, 66, 214),
    warning=Color(170, 95, 0),
    error=Color(190, 30, 40),
)


def is_stale(age: float) -> bool:
    """Whether the age of a frame, in seconds, is so high that screens show the age."""
    # With this comparison, an age that is NaN counts as stale.
    return not age <= FRAME_TIMEOUT / 3.0


def age_words(age: float) -> str:
    """Format a frame's age in seconds: with one decimal, or without if the frame is stale."""
    return f"{age // 1:.0f} s" if is_stale(age) else f"{age:.1f} s"


def of_age(color: Color, age: float, palette: Palette) -> Color:
    """Return `color`, or amber for a stale frame, or red for a frame that is silent for long.

    Args:
        color: Colour of the frame.
        age: Seconds since the frame's stamp last changed; 0 for static frames.
        palette: Colours of the screen.
    """
    if not is_stale(age):
        return color
    return palette.warning if age <= FRAME_TIMEOUT else palette.error


def readable(color: Color, palette: Palette) -> Color:
    """Return a frame's colour, made darker for a light screen."""
    return blend(color, INK, 0.55) if palette is LIGHT else color


def prefers_light(environment: Mapping[str, str] = MappingProxyType({})) -> bool:
    """Whether the environment variable COLORFGBG names a light background of the terminal."""
    ground = environment.get("COLORFGBG", "").rpartition(";")[2]
    return ground in {"7", "15"}


class PaperColors(NamedTuple):
    """Colours for one background, in order: background, grid, lines to parents, axes, accent."""

    ground: Color
    grid: Color
    link: Color
    x_axis: Color
    y_axis: Color
    z_axis: Color
    accent: Color


_BRIGHT: Final = (Color(255, 85, 85), Color(80, 230, 120), Color(110, 170, 255))
_DEEP: Final = (Color(205, 20, 30), Color(0, 135, 50), Color(20, 90, 230))


def paper(palette: Palette) -> PaperColors:
    """Return the colours for drawing on a screen's own background."""
    red, green, blue = _DEEP if palette is LIGHT else _BRIGHT
    return PaperColors(
        palette.panel,
        blend(palette.panel, palette.dim, 0.25),
        blend(palette.panel, palette.dim, 0.85),
        red,
        green,
        blue,
        palette.accent,
    )


def on_field(ground: Color) -> PaperColors:
    """Return the colours for drawing on the turtles' field, which has the colour `ground`."""
    return PaperColors(
        ground,
        blend(ground, WHITE, 0.13),
        blend(ground, WHITE, 0.45),
        Color(255, 110, 110),
        Color(95, 255, 135),
        Color(170, 205, 255),
        DARK.accent,
    )
