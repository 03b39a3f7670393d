"""Lookups as values: at one time, or between two."""

from dataclasses import dataclass
from typing import Any

from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer as Frames
from tftool.buffer.sample import TransformStamped
from tftool.ros.host import values
from tftool.ros.rclpy.time import Duration, Time
from tftool.world import transform_wait as waiting
from tftool.world.clock import Clock


@dataclass(frozen=True, slots=True)
class LookupRequest:
    """Lookup of source in target at one time."""

    target: str
    source: str
    time: Stamp

    def answer(self, frames: Frames) -> TransformStamped:
        """Return the transform, or raise."""
        return frames.lookup_transform(self.target, self.source, self.time)

    def why_not(self, frames: Frames) -> str:
        """Return why it fails; "" if it succeeds."""
        return frames.why_not(self.target, self.source, self.time)

    async def wait(self, frames: Frames, clock: Clock) -> None:
        """Return as soon as it succeeds; raise as soon as it never can."""
        await waiting.wait_for_transform(frames, clock, self.target, self.source, self.time)


@dataclass(frozen=True, slots=True)
class FullLookupRequest:
    """Lookup of source at one time in target at another, through a fixed frame."""

    target: str
    target_time: Stamp
    source: str
    source_time: Stamp
    fixed: str

    def answer(self, frames: Frames) -> TransformStamped:
        """Return the transform, or raise."""
        return frames.lookup_transform_full(*self._asked)

    def why_not(self, frames: Frames) -> str:
        """Return why it fails; "" if it succeeds."""
        return frames.why_not_full(*self._asked)

    async def wait(self, frames: Frames, clock: Clock) -> None:
        """Return as soon as it succeeds; raise as soon as it never can."""
        await waiting.wait_for_transform_full(frames, clock, *self._asked)

    @property
    def _asked(self) -> tuple[str, Stamp, str, Stamp, str]:
        return self.target, self.target_time, self.source, self.source_time, self.fixed


def question(target_frame: str, source_frame: str, time: Any) -> LookupRequest:
    """Return the lookup requested by a user's code.

    Raises:
        TypeError: If a frame is no text, or the time no time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame)
    return LookupRequest(target_frame, source_frame, stamp(time))


def full_question(
    target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
) -> FullLookupRequest:
    """Return the lookup between two times requested by a user's code.

    Raises:
        TypeError: If a frame is no text, or a time no time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame, fixed_frame=fixed_frame)
    return FullLookupRequest(
        target_frame, stamp(target_time), source_frame, stamp(source_time), fixed_frame
    )


def _require_names(**frames: object) -> None:
    for argument, frame in frames.items():
        if not isinstance(frame, str):
            raise TypeError(f"{argument} must be a frame's name, not {type(frame).__name__}")


def stamp(time: Any) -> Stamp:
    """Return the nanoseconds of an rclpy or builtin_interfaces Time.

    Raises:
        TypeError: If it is neither.
    """
    if isinstance(time, Time):
        return time.nanoseconds
    if hasattr(time, "sec") and hasattr(time, "nanosec"):
        return values.stamp_of(time)
    raise TypeError(
        f"a lookup's time must be an rclpy.time.Time (Time() means the latest), "
        f"not {type(time).__name__}"
    )


def length(timeout: Any) -> int:
    """Return the nanoseconds of a Duration.

    Raises:
        TypeError: If it is none.
    """
    if isinstance(timeout, Duration):
        return timeout.nanoseconds
    raise TypeError(
        f"a timeout must be an rclpy.duration.Duration, not {type(timeout).__name__}: "
        "write Duration(seconds=1.0)"
    )
