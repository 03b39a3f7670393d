"""The colours in which frames are drawn on a ground."""

from typing import Final, NamedTuple

from tftool.base.color import Color
from tftool.drawing import theme


class PaperColors(NamedTuple):
    """What is drawn on a ground: its colours for all that is no frame's own."""

    ground: Color
    grid: Color
    link: Color
    x_axis: Color
    y_axis: Color
    z_axis: Color
    accent: Color


_BRIGHT: Final = (Color(255, 85, 85), Color(80, 230, 120), Color(110, 170, 255))
_DEEP: Final = (Color(205, 20, 30), Color(0, 135, 50), Color(20, 90, 230))

LINK, X_AXIS, Y_AXIS, Z_AXIS, PAIR = (Color(-1, -1, -1 - number) for number in range(5))
"""Stand for colours that depend on the ground below; no real colour is negative."""

ROLES: Final = {LINK: 2, X_AXIS: 3, Y_AXIS: 4, Z_AXIS: 5, PAIR: 6}
"""Which of `PaperColors` each of them stands for."""


def paper(palette: theme.Palette) -> PaperColors:
    """The colours on a screen's own ground."""
    red, green, blue = _DEEP if palette is theme.LIGHT else _BRIGHT
    return PaperColors(
        palette.panel,
        theme.blend(palette.panel, palette.dim, 0.25),
        theme.blend(palette.panel, palette.dim, 0.85),
        red,
        green,
        blue,
        palette.accent,
    )


def on_field(ground: Color) -> PaperColors:
    """The colours on the turtles' field, turtlesim's blue unless it is repainted."""
    return PaperColors(
        ground,
        theme.blend(ground, theme.WHITE, 0.13),
        theme.blend(ground, theme.WHITE, 0.45),
        Color(255, 110, 110),
        Color(95, 255, 135),
        Color(170, 205, 255),
        theme.DARK.accent,
    )
