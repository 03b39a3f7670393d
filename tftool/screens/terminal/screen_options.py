"""What a screen is asked to be, and what its terminal can show."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from tftool.base.stamps import Stamp
from tftool.drawing import theme


@dataclass(frozen=True, slots=True)
class Setting:
    """What the terminal can show, and what is asked for.

    Attributes:
        title: What runs, for the top line.
        pair: Target and source to begin with.
        ascii_only: Draw with ASCII alone.
        colors: Whether colours may be used.
        light: Whether the terminal's ground is light.
        drive_only: Whether the field has the screen to itself, as in teleop.
        banner: Lines to show above the field.
        at: The moment to begin with, at rest; the present if None.
        scenarios: Gives what can be shown instead, name and what it is about; None where
            something else is no choice.
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
    """Complete `wanted` by what the environment says of the terminal.

    Args:
        environment: Its TERM, NO_COLOR, COLORFGBG and LC_ALL count.
        encoding: What the terminal's text is encoded in.
        wanted: What was asked for; it is only ever restricted.
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
