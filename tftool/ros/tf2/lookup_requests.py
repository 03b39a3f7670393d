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
    """Lookup of source in target at one time, or between two.

    Attributes:
        target: Frame the answer is expressed in.
        source: Frame whose pose is asked for.
        time: The moment, that of the source.
        target_time: The moment of the target, with a fixed frame.
        fixed: Frame that connects two moments; None for one.
    """

    target: str
    source: str
    time: Stamp
    target_time: Stamp = 0
    fixed: str | None = None

    def answer(self, frames: Frames) -> TransformStamped:
        """Return the transform, or raise."""
        if self.fixed is None:
            return frames.lookup_transform(self.target, self.source, self.time)
        return frames.lookup_transform_full(*self._full)

    def why_not(self, frames: Frames) -> str:
        """Return why it fails; "" if it succeeds."""
        if self.fixed is None:
            return frames.why_not(self.target, self.source, self.time)
        return frames.why_not_full(*self._full)

    async def wait(self, frames: Frames, clock: Clock) -> None:
        """Return as soon as it succeeds; raise as soon as it never can."""
        if self.fixed is None:
            await waiting.wait_for_transform(frames, clock, self.target, self.source, self.time)
        else:
            await waiting.wait_for_transform_full(frames, clock, *self._full)

    @property
    def _full(self) -> tuple[str, Stamp, str, Stamp, str]:
        return self.target, self.target_time, self.source, self.time, self.fixed or ""


def question(target_frame: str, source_frame: str, time: Any) -> LookupRequest:
    """Return the lookup requested by a user's code.

    Raises:
        TypeError: If a frame is not a string, or the time no time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame)
    return LookupRequest(target_frame, source_frame, stamp(time))


def full_question(
    target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
) -> LookupRequest:
    """Return the lookup between two times requested by a user's code.

    Raises:
        TypeError: If a frame is not a string, or a time no time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame, fixed_frame=fixed_frame)
    return LookupRequest(
        target_frame, source_frame, stamp(source_time), stamp(target_time), fixed_frame
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
