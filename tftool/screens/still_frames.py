"""Frames of a recording or file for screens, and the time to show first."""

from dataclasses import dataclass
from typing import Final, Protocol

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.frames.frames import Frames
from tftool.world.clock import Clock
from tftool.world.log import Log

SETTLING: Final[Duration] = seconds(3)
"""Nanoseconds within which all frames are expected to appear, as a scenario's turtles do."""


class ShownFrames(Protocol):
    """Protocol of frames that a screen can show; implemented by `World` and `StillFrames`."""

    @property
    def clock(self) -> Clock:
        """Clock on which the frames' stamps are measured."""

    @property
    def buffer(self) -> Buffer:
        """Transform buffer with the frames."""

    @property
    def log(self) -> Log:
        """Log whose messages the screen shows."""


@dataclass(frozen=True, slots=True)
class StillFrames:
    """Frames of a recording or file, which do not change.

    Attributes:
        clock: Clock that always shows the last time of the frames.
        buffer: Transform buffer with the frames.
        log: Log for messages of the screen itself.
    """

    clock: Clock
    buffer: Buffer
    log: Log


def first_look(frames: Frames) -> Stamp | None:
    """Return the time that a screen shows first; None if all transforms are static."""
    start, end = frames.span
    if start == end:
        return None
    start = max(start, 1)
    return first_moment(frames.buffer, start, end) or start


def first_moment(buffer: Buffer, begin: Stamp, end: Stamp) -> Stamp | None:
    """Return the earliest time at which all frames that appear early have a sample.

    Frames that appear more than `SETTLING` nanoseconds after `begin` are ignored.

    Args:
        buffer: Transform buffer with the frames.
        begin: First time of the recording.
        end: Last time of the recording.

    Returns:
        The time; None if all transforms are static.
    """
    frames = buffer.snapshot(end).frames
    first = [info.oldest for info in frames if info.samples and not info.is_static]
    soon = [stamp for stamp in first if stamp <= min(begin + SETTLING, end)]
    return max([begin, *soon]) if first else None
