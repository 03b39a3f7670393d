"""Times, durations, clocks and rates of rclpy, based on tftool's clock."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from functools import partial, total_ordering
from typing import Any

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.ros.host import program, values
from tftool.ros.host.locks import StateMonitor
from tftool.ros.rclpy.exceptions import NotInitializedException, ROSInterruptException

S_TO_NS = NANOSECONDS

_RANGE = 2**63

_FOR_EVER = 10**18
"""Nanoseconds of a sleep without end, longer than any run."""


class ClockType(IntEnum):
    """Type of a clock, with ROS 2's numbers."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3


@total_ordering
class Duration:
    """Length of time in whole nanoseconds."""

    __slots__ = ("_nanoseconds",)

    def __init__(self, *, seconds: float = 0, nanoseconds: float = 0) -> None:
        self._nanoseconds = int(seconds * S_TO_NS) + int(nanoseconds)
        if not -_RANGE <= self._nanoseconds < _RANGE:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")

    @property
    def nanoseconds(self) -> int:
        """Length of the duration in nanoseconds."""
        return self._nanoseconds

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self._nanoseconds})"

    def __str__(self) -> str:
        return "Infinite" if self._nanoseconds == _RANGE - 1 else f"{self._nanoseconds} nanoseconds"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self._nanoseconds == other._nanoseconds

    def __hash__(self) -> int:
        return hash(self._nanoseconds)

    def __lt__(self, other: "Duration") -> bool:
        return self._nanoseconds < _length(other)

    def __add__(self, other: Any) -> "Duration":
        if isinstance(other, Time):
            return NotImplemented
        return Duration(nanoseconds=self._nanoseconds + _length(other))

    def __sub__(self, other: "Duration") -> "Duration":
        return Duration(nanoseconds=self._nanoseconds - _length(other))

    def __mul__(self, factor: float) -> "Duration":
        if isinstance(factor, float) and not math.isfinite(factor):
            if factor > 0:
                return Infinite
            raise ValueError(f"Can't multiply duration with {factor}")
        return Duration(nanoseconds=self._nanoseconds * factor)

    def to_msg(self) -> Any:
        """Return the duration as a builtin_interfaces Duration message."""
        return values.time_message(self._nanoseconds, "Duration")

    @classmethod
    def from_msg(cls, msg: Any) -> "Duration":
        """Convert a builtin_interfaces Duration message to a Duration."""
        return cls(nanoseconds=values.stamp_of(msg))


def _length(other: object) -> int:
    if not isinstance(other, Duration):
        raise TypeError("Can't compare duration with object of type: ", type(other))
    return other._nanoseconds


Infinite = Duration(nanoseconds=_RANGE - 1)


@total_ordering
class Time:
    """Point in time in whole nanoseconds; a transform lookup takes 0 as the latest time."""

    __slots__ = ("_clock_type", "_nanoseconds")

    def __init__(
        self,
        *,
        seconds: float = 0,
        nanoseconds: float = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        if seconds < 0:
            raise ValueError("Seconds value must not be negative")
        if nanoseconds < 0:
            raise ValueError("Nanoseconds value must not be negative")
        self._nanoseconds = int(seconds * S_TO_NS) + int(nanoseconds)
        self._clock_type = clock_type
        if self._nanoseconds >= _RANGE:
            raise OverflowError("Total nanoseconds value is too large to store in C time point.")

    @property
    def nanoseconds(self) -> int:
        """Nanoseconds since time 0 of the clock."""
        return self._nanoseconds

    @property
    def clock_type(self) -> ClockType:
        """Type of the clock on which the time was measured."""
        return self._clock_type

    def seconds_nanoseconds(self) -> tuple[int, int]:
        """Return the time as (whole seconds, remaining nanoseconds)."""
        return self._nanoseconds // S_TO_NS, self._nanoseconds % S_TO_NS

    def __repr__(self) -> str:
        return f"Time(nanoseconds={self._nanoseconds}, clock_type={self._clock_type.name})"

    def __add__(self, other: object) -> "Time":
        if not isinstance(other, Duration):
            return NotImplemented
        return Time(nanoseconds=self._nanoseconds + other.nanoseconds, clock_type=self._clock_type)

    __radd__ = __add__

    def __sub__(self, other: object) -> Any:
        if isinstance(other, Time):
            self._alike(other, "subtract")
            return Duration(nanoseconds=self._nanoseconds - other._nanoseconds)
        if isinstance(other, Duration):
            return Time(
                nanoseconds=self._nanoseconds - other.nanoseconds, clock_type=self._clock_type
            )
        return NotImplemented

    def _alike(self, other: object, verb: str = "compare") -> int:
        if not isinstance(other, Time):
            raise TypeError(f"Can't {verb} time with object of type: ", type(other))
        if self._clock_type != other._clock_type:
            raise TypeError(f"Can't {verb} times with different clock types")
        return other._nanoseconds

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Time) and self._nanoseconds == self._alike(other)

    def __hash__(self) -> int:
        return hash(self._nanoseconds)

    def __lt__(self, other: object) -> bool:
        return self._nanoseconds < self._alike(other)

    def to_msg(self) -> Any:
        """Return the time as a builtin_interfaces Time message."""
        return values.time_message(self._nanoseconds)

    @classmethod
    def from_msg(cls, msg: Any, clock_type: ClockType = ClockType.ROS_TIME) -> "Time":
        """Convert a builtin_interfaces Time message to a Time."""
        return cls(nanoseconds=values.stamp_of(msg), clock_type=clock_type)


class Clock:
    """Clock of rclpy; in tftool, clocks of all types show the same time."""

    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> "Clock":
        """Create a clock of the type `clock_type`; for ROS time, a `ROSClock`."""
        return super().__new__(ROSClock if clock_type is ClockType.ROS_TIME else cls)

    def __init__(self, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        self._clock_type = clock_type
        self._program = program.current()
        self.is_overridden = False
        """Whether a `TimeSource` sets the time, which then only advances with messages."""
        self.timers: list[Any] = []
        """Timers that count time on this clock."""
        self._jump_handles: list[JumpHandle] = []
        self._state = StateMonitor()
        """State whose change wakes sleeping threads to check whether their sleep is over."""

    @property
    def clock_type(self) -> ClockType:
        """Type of the clock."""
        return self._clock_type

    @property
    def ros_time_is_active(self) -> bool:
        """Whether this clock shows simulated time."""
        return self._program.strict

    def now(self) -> Time:
        """Return the present time."""
        return Time(nanoseconds=self._program.now(), clock_type=self._clock_type)

    def reading(self) -> Stamp:
        """Return the present time in nanoseconds, for timers.

        Unlike calls of `now`, these calls are not counted as polling by the program.
        """
        return self._program.clock.now()

    def sleep_until(self, until: Time, context: Any = None) -> bool:
        """Block until a time on this clock; return False if the program or context ends earlier."""
        if until.clock_type != self._clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        return self._sleep(until.nanoseconds - self.now().nanoseconds, self._chosen(context))

    def sleep_for(self, rel_time: Duration, context: Any = None) -> bool:
        """Block for a duration; return False if the program or context ends earlier."""
        return self._sleep(rel_time.nanoseconds, self._chosen(context))

    def _chosen(self, context: Any) -> Any:
        """Return `context`; if it is None, return the program's default context.

        Return None if the program has not created its default context yet.
        """
        return context or self._program.context

    def _sleep(self, duration: int, context: Any) -> bool:
        """Sleep `duration` nanoseconds on this clock; return False if the sleep ends earlier."""
        _require_started(context)
        return self._block(duration, context)

    def _block(
        self, duration: int, context: Any, is_over: Callable[[], bool] = lambda: False
    ) -> bool:
        """Block for `duration` nanoseconds of tftool's clock, or until `is_over` returns True.

        Return False if the program or the context ends earlier.
        """

        def has_ended() -> bool:
            return context is not None and not context.ok()

        stop = None if context is None else context.on_change(self._state.wake)
        try:
            self._state.sleep(self._program, duration, lambda: is_over() or has_ended())
        finally:
            if stop is not None:
                stop()
        return not (self._program.interrupted or has_ended())

    def create_jump_callback(
        self,
        threshold: "JumpThreshold",
        *,
        pre_callback: Callable[[], object] | None = None,
        post_callback: "Callable[[TimeJump], object] | None" = None,
    ) -> "JumpHandle":
        """Register callbacks for jumps of this clock; only a clock set by a `TimeSource` jumps.

        Raises:
            ValueError: If both callbacks are None.
        """
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        return JumpHandle(self._jump_handles, threshold, pre_callback, post_callback)

    def __repr__(self) -> str:
        return f"Clock(clock_type={self._clock_type.name})"


def _require_started(context: Any) -> None:
    """Raise NotInitializedException if the context is given but not initialised."""
    if context is not None and not context.ok():
        raise NotInitializedException


class ROSClock(Clock):
    """Clock of ROS time, which every node has; a `TimeSource` can set the clock."""

    def __init__(self, *, clock_type: ClockType = ClockType.ROS_TIME) -> None:
        super().__init__(clock_type=ClockType.ROS_TIME)
        self._has_source = False
        self._override = Time(clock_type=ClockType.ROS_TIME)

    @property
    def ros_time_is_active(self) -> bool:
        """Whether this clock shows simulated time, or a time set by a `TimeSource`."""
        return self.is_overridden if self._has_source else super().ros_time_is_active

    def now(self) -> Time:
        """Return the present time; while a `TimeSource` is active, the time that it set last."""
        return self._override if self.is_overridden else super().now()

    def reading(self) -> Stamp:
        """Return the present time in nanoseconds, for timers.

        Unlike calls of `now`, these calls are not counted as polling by the program.
        """
        return self._override.nanoseconds if self.is_overridden else super().reading()

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Show the time set by a `TimeSource` if `enabled` is true, else tftool's time."""
        self._has_source = True
        if enabled is self.is_overridden:
            return
        change = ClockChange.ROS_TIME_ACTIVATED if enabled else ClockChange.ROS_TIME_DEACTIVATED
        self._jump(TimeJump(change, Duration()), enabled, self._override)

    def set_ros_time_override(self, time: Time) -> None:
        """Set the time that the clock shows while a `TimeSource` is active.

        Raises:
            TypeError: If the argument is not a Time.
        """
        if not isinstance(time, Time):
            raise TypeError(
                f"Time must be specified as rclpy.time.Time. Received type: {type(time)}"
            )
        override = Time(nanoseconds=time.nanoseconds, clock_type=ClockType.ROS_TIME)
        if not self.is_overridden:
            self._override = override
            return
        delta = Duration(nanoseconds=override.nanoseconds - self._override.nanoseconds)
        self._jump(TimeJump(ClockChange.ROS_TIME_NO_CHANGE, delta), True, override)

    def _sleep(self, duration: int, context: Any) -> bool:
        """Sleep `duration` nanoseconds on this clock; return False if the sleep ends earlier.

        Switching a `TimeSource` on or off ends the sleep.
        """
        _require_started(context)
        until, is_changed = super().now().nanoseconds + duration, False
        if self.is_overridden:
            until = self._override.nanoseconds + duration

        def is_over() -> bool:
            reached = self.is_overridden and self._override.nanoseconds >= until
            return bool(is_changed or reached)

        def on_jump(jump: TimeJump) -> None:
            nonlocal is_changed
            is_changed = is_changed or jump.clock_change is not ClockChange.ROS_TIME_NO_CHANGE
            if is_over():
                self._state.wake()

        threshold = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=None)
        with self.create_jump_callback(threshold, post_callback=on_jump):
            # Only a jump ends a sleep while a time source gives the time.
            length = _FOR_EVER if self.is_overridden else duration
            return self._block(length, context, is_over) and not is_changed

    def _jump(self, jump: "TimeJump", enabled: bool, override: Time) -> None:
        """Set the time and its source; call the registered callbacks before and after."""
        handles = [one for one in self._jump_handles if one.concerns(jump)]
        for handle in handles:
            handle.call_before()
        self._program.ask(partial(self._set, jump, enabled, override))
        for handle in handles:
            handle.call_after(jump)

    def _set(self, jump: "TimeJump", enabled: bool, override: Time) -> None:
        # In the event loop's thread, which also reads the times of timers.
        before = self.reading()
        self.is_overridden, self._override = enabled, override
        for timer in self.timers:
            timer.clock_jumped(before, jump.clock_change is not ClockChange.ROS_TIME_NO_CHANGE)


class ClockChange(IntEnum):
    """Kind of a clock's jump: a `TimeSource` was switched on or off, or has set another time."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


@dataclass(kw_only=True, eq=False)
class JumpThreshold:
    """Threshold for jumps of a clock; smaller jumps call no callback."""

    min_forward: Duration | None
    min_backward: Duration | None
    on_clock_change: bool = True

    def __post_init__(self) -> None:
        if self.min_forward is not None and self.min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if self.min_backward is not None and self.min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        if self.min_forward is None and self.min_backward is None and not self.on_clock_change:
            raise ValueError("At least one threshold must be enabled")


@dataclass(eq=False)
class TimeJump:
    """Jump of a clock: kind, and signed duration; the duration is 0 for a switched `TimeSource`."""

    clock_change: ClockChange
    delta: Duration


class JumpHandle:
    """Registration of callbacks for jumps of a clock; the oldest registration is called first."""

    def __init__(
        self,
        siblings: "list[JumpHandle]",
        threshold: JumpThreshold,
        before: Callable[[], object] | None,
        after: Callable[[TimeJump], object] | None,
    ) -> None:
        self._siblings, self._threshold = siblings, threshold
        self.call_before = before or (lambda: None)
        self.call_after = after or (lambda jump: None)
        siblings.append(self)

    def concerns(self, jump: TimeJump) -> bool:
        """Return whether a jump is large enough for this registration's threshold."""
        least, most = self._threshold.min_forward, self._threshold.min_backward
        changes = (ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED)
        return (
            (self._threshold.on_clock_change and jump.clock_change in changes)
            or (least is not None and jump.delta >= least)
            or (most is not None and jump.delta <= most)
        )

    def unregister(self) -> None:
        """Remove the registered callbacks."""
        if self in self._siblings:
            self._siblings.remove(self)

    def __enter__(self) -> "JumpHandle":
        return self

    def __exit__(self, *args: object) -> None:
        self.unregister()


class Rate:
    """Timer for a loop: its method `sleep` makes the loop run at a fixed rate."""

    def __init__(self, state: Any, timer: Any) -> None:
        self.timer = timer
        self._clock: Clock = timer.clock
        self._period: int = timer.timer_period_ns
        self._program = state.program
        self._due = self._clock.reading() + self._period
        self._context = state.context
        self._state = StateMonitor()
        self._stop = self._context.on_change(self._state.wake)
        self._over = False
        timer.on_jump, timer.on_end = self._state.wake, self._end

    def sleep(self) -> None:
        """Block until the next period begins.

        Raises:
            ROSInterruptException: If the context is shut down, before or during the sleep.
            RuntimeError: If the rate is destroyed.
        """
        if self._over:
            raise RuntimeError("the rate is destroyed, so it cannot sleep: create a new one")
        self._require_context()
        now = self._clock.reading()
        if self._due < now:
            self._due += -(-(now - self._due) // self._period) * self._period
        by_messages = self._clock.is_overridden

        def is_over() -> bool:
            now = self._clock.reading()
            # The clock may have jumped back.
            self._due = min(self._due, now + self._period)
            is_reached = by_messages and now >= self._due
            is_changed = self._clock.is_overridden is not by_messages
            return self._over or not self._context.ok() or is_reached or is_changed

        length = _FOR_EVER if by_messages else self._due - now
        self._state.sleep(self._program, length, is_over)
        if not self._over:
            self._require_context()
        self._due += self._period

    def _require_context(self) -> None:
        if not self._context.ok():
            raise ROSInterruptException

    def destroy(self) -> None:
        """Destroy the rate, and wake the threads that are blocked in `sleep`."""
        self.timer.destroy()

    def _end(self) -> None:
        self._over = True
        self._stop()
        self._state.wake()
