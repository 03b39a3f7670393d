"""Options of a screen, abilities of its terminal, and its layout."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from tftool.base.stamps import Stamp
from tftool.drawing import theme


@dataclass(frozen=True, slots=True)
class Setting:
    """Abilities of the terminal, and options of the screen.

    Attributes:
        title: Title of the running session, for the top line.
        pair: Target and source to begin with.
        ascii_only: Draw with ASCII alone.
        colors: Whether colours may be used.
        light: Whether the terminal's ground is light.
        drive_only: Whether the field has the screen to itself, as in teleop.
        banner: Lines to show above the field.
        at: The moment to begin with, at rest; the present if None.
        scenarios: Returns the scenarios to choose from, name and subject; None where
            there is no choice.
    """

    title: str = "tftool"
    pair: tuple[str, str] = ("turtle2", "turtle1")
    ascii_only: bool = False
    colors: bool = True
    light: bool = False
    drive_only: bool = False
    banner: tuple[str, ...] = ()
    at: Stamp | None = None
    scenarios: Callable[[], Sequence[tuple[str, str]]] | None = None


def setting_from(environment: Mapping[str, str], encoding: str, wanted: Setting) -> Setting:
    """Complete `wanted` with what the environment says about the terminal.

    Args:
        environment: TERM, NO_COLOR, COLORFGBG and LC_ALL count.
        encoding: Encoding of the terminal's text.
        wanted: The wish; it is only ever restricted.
    """
    terminal = environment.get("TERM", "")
    ascii_only = (
        not encoding.lower().replace("-", "").startswith("utf")
        or environment.get("LC_ALL") in {"C", "POSIX"}
        # Its font has neither braille nor quadrant blocks.
        or terminal in {"linux", "vt100", "vt220", "dumb"}
    )
    return replace(
        wanted,
        ascii_only=wanted.ascii_only or ascii_only,
        colors=wanted.colors and not environment.get("NO_COLOR"),
        light=wanted.light or theme.prefers_light(environment),
    )


SMALLEST = (30, 10)
"""Columns and rows below which there is nothing but a sentence."""

WITH_PANELS = 56
"""Columns from which the field gets company."""

PAIR_LINES = 6
"""Lines the echo needs to say everything shortly."""

BLOCK_LINES = 11
"""Lines in which it says the rotation as radians and as a matrix, too."""

LEAST_PLOT = 6
"""Lines of the plots, with their border."""

WITH_BANNER = 36
"""Rows from which there is room for lines above the picture."""

SCALE = 5
"""Columns left of the picture for its metres."""


@dataclass(frozen=True, slots=True)
class ScreenLayout:
    """Sizes with borders, in cells; 0 for the remaining space.

    Attributes:
        small: Whether there is room for nothing.
        alone: Whether the picture fills the screen, without panels.
        portrait: Whether the panels are below the picture.
        field: The picture's width and height.
        tree: The tree's height.
        pair: The echo's height.
        log: Height of the open log.
    """

    small: bool = False
    alone: bool = False
    portrait: bool = False
    field: tuple[int, int] = (0, 0)
    tree: int = 0
    pair: int = 0
    log: int = 0


def arranged(width: int, height: int, banner: int, frames: int) -> ScreenLayout:
    """Divide a screen among its panels.

    Args:
        width: Columns.
        height: Rows.
        banner: Number of rows of a banner.
        frames: Number of lines the tree would like.
    """
    if width < SMALLEST[0] or height < SMALLEST[1]:
        return ScreenLayout(small=True)
    # A top line, the log's strip and a line of keys; and every panel has a border.
    room = height - 3 - banner
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
    # A line less of the plots is better than a frame that is not listed.
    plot = LEAST_PLOT - 1 if tree == room - pair - LEAST_PLOT + 1 else LEAST_PLOT
    tree = min(tree, max(5, room - pair - max(plot, room // 4)))
    across = 2 * beside + 2
    if width - across - SCALE >= 38:
        across += SCALE
    return ScreenLayout(field=(across, 0), tree=tree, pair=pair, log=log)
