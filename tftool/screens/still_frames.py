"""Complete frames in the form that screens show, and the time to show first."""

from dataclasses import dataclass
from typing import Final, Protocol

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.frames.frames import Frames
from tftool.world.clock import Clock
from tftool.world.log import Log

SETTLING: Final[Duration] = seconds(3)
"""How long after the beginning all frames are expected to have come; a scenario's turtles have."""


class ShownFrames(Protocol):
    """Frames on a screen. Every `World` is one, and so are `StillFrames`."""

    @property
    def clock(self) -> Clock:
        """Clock of the frames."""

    @property
    def buffer(self) -> Buffer:
        """The frames."""

    @property
    def log(self) -> Log:
        """Empty log."""


@dataclass(frozen=True, slots=True)
class StillFrames:
    """Complete frames, at rest.

    Attributes:
        clock: Stands still at their end.
        buffer: The frames.
        log: Lines of the screen itself.
    """

    clock: Clock
    buffer: Buffer
    log: Log


def first_look(frames: Frames) -> Stamp | None:
    """Return the time to show first; None for static transforms."""
    start, end = frames.span
    if start == end:
        return None
    start = max(start, 1)
    return first_moment(frames.buffer, start, end) or start


def first_moment(buffer: Buffer, begin: Stamp, end: Stamp) -> Stamp | None:
    """Time to show first; None if nothing moves.

    It is the moment at which everything of the first `SETTLING` nanoseconds has arrived.

    Args:
        buffer: The frames.
        begin: The first moment there is.
        end: The last one.
    """
    frames = buffer.snapshot(end).frames
    first = [info.oldest for info in frames if info.samples and not info.is_static]
    soon = [stamp for stamp in first if stamp <= min(begin + SETTLING, end)]
    return max([begin, *soon]) if first else None
