"""Options of a screen, abilities of its terminal, and the layout of its panels."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from tftool.base.stamps import Stamp
from tftool.drawing import theme


@dataclass(frozen=True, slots=True)
class Setting:
    """Options of a screen, and abilities of its terminal.

    Attributes:
        title: Title for the top line.
        pair: Initial target and source; in `tftool teleop`, the source is the driven turtle.
        ascii_only: Whether to draw with ASCII only.
        colors: Whether colours may be used.
        light: Whether the terminal's background is light.
        drive_only: Whether to show only the field, for `tftool teleop`.
        at: Past time to show first; None for the present.
        scenarios: Function that returns name and description of the scenarios to choose from; None
            if no scenario can be chosen.
    """

    title: str = "tftool"
    pair: tuple[str, str] = ("turtle2", "turtle1")
    ascii_only: bool = False
    colors: bool = True
    light: bool = False
    drive_only: bool = False
    at: Stamp | None = None
    scenarios: Callable[[], Sequence[tuple[str, str]]] | None = None


def setting_from(environment: Mapping[str, str], encoding: str, requested: Setting) -> Setting:
    """Return the requested options, without those that the terminal cannot show.

    Args:
        environment: Environment variables; TERM, NO_COLOR, COLORFGBG and LC_ALL are used.
        encoding: Encoding of the terminal's text.
        requested: Options that the user requested.
    """
    terminal = environment.get("TERM", "")
    ascii_only = (
        not encoding.lower().replace("-", "").startswith("utf")
        or environment.get("LC_ALL") in {"C", "POSIX"}
        # Its font has neither braille nor quadrant blocks.
        or terminal in {"linux", "vt100", "vt220", "dumb"}
    )
    return replace(
        requested,
        ascii_only=requested.ascii_only or ascii_only,
        colors=requested.colors and not environment.get("NO_COLOR"),
        light=requested.light or theme.prefers_light(environment),
    )


SMALLEST = (30, 10)
"""Smallest columns and rows of a screen with panels; below, a sentence is shown."""

WITH_PANELS = 56
"""Smallest number of columns with panels beside the field."""

PAIR_LINES = 6
"""Lines of the pair's panel in its short form."""

BLOCK_LINES = 11
"""Lines of the pair's panel with the rotation in radians and as a matrix."""

LEAST_PLOT = 6
"""Smallest number of lines of the plots, with their border."""

SCALE = 5
"""Columns at the left of the picture for its scale in metres."""


@dataclass(frozen=True, slots=True)
class ScreenLayout:
    """Widths and heights of panels with their borders, in cells; 0 for the remaining space.

    Attributes:
        small: Whether the terminal is too small for any panel.
        alone: Whether the picture fills the screen, without panels.
        portrait: Whether the panels are below the picture.
        field: Width and height of the picture.
        tree: Height of the tree.
        pair: Height of the pair's panel.
        log: Height of the open log.
    """

    small: bool = False
    alone: bool = False
    portrait: bool = False
    field: tuple[int, int] = (0, 0)
    tree: int = 0
    pair: int = 0
    log: int = 0


def arranged(width: int, height: int, frames: int) -> ScreenLayout:
    """Return sizes of the panels for a terminal of `width` by `height` cells.

    Args:
        width: Columns of the terminal.
        height: Rows of the terminal.
        frames: Lines that the whole tree needs.
    """
    if width < SMALLEST[0] or height < SMALLEST[1]:
        return ScreenLayout(small=True)
    # Without the top line, the log's line and the line of keys.
    room = height - 3
    log = max(4, min(12, room // 3))
    if width < WITH_PANELS:
        return ScreenLayout(alone=True, log=log)
    beside = min(room - 2, (width - (28 if width < 84 else 38)) // 2)
    pair = PAIR_LINES + 2
    tree = max(4, frames + 3)
    under = min((width - 2) // 2, room - 2 - pair - LEAST_PLOT - min(tree, 7))
    if under > 1.15 * beside:
        left = room - under - 2 - pair - LEAST_PLOT
        return ScreenLayout(
            portrait=True, field=(0, under + 2), tree=min(tree, left), pair=pair, log=log
        )
    if room >= 36:
        pair = BLOCK_LINES + 2
    # Rather one line less for the plots than a frame that is not listed.
    plot = LEAST_PLOT - 1 if tree == room - pair - LEAST_PLOT + 1 else LEAST_PLOT
    tree = min(tree, max(5, room - pair - max(plot, room // 4)))
    across = 2 * beside + 2
    if width - across - SCALE >= 38:
        across += SCALE
    return ScreenLayout(field=(across, 0), tree=tree, pair=pair, log=log)
