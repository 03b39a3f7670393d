"""Timers."""

import inspect
from collections.abc import Callable
from typing import Any

from tftool.ros.host.program import TICK
from tftool.ros.rclpy.entities import NodeEntity, Work
from tftool.ros.rclpy.seat import NodeSeat
from tftool.ros.rclpy.time import Clock, ClockType, Duration, Time


class TimerInfo:
    """Time at which a timer was due, and at which it was called."""

    def __init__(
        self,
        *,
        expected_call_time: int = 0,
        actual_call_time: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        """Take two times in nanoseconds of a clock."""
        self.expected_call_time = Time(nanoseconds=expected_call_time, clock_type=clock_type)
        self.actual_call_time = Time(nanoseconds=actual_call_time, clock_type=clock_type)


class Timer(NodeEntity):
    """Calls back at multiples of its period, first one period after its creation."""

    is_a_callback = True

    def __init__(
        self,
        seat: NodeSeat,
        callback: Callable[..., Any] | None,
        period_ns: int,
        group: Any,
        clock: Clock,
        autostart: bool = True,
    ) -> None:
        super().__init__(seat, group)
        self.callback: Callable[..., Any] | None = callback
        self.clock = clock
        self._period = period_ns
        self._last = seat.now()
        self.due = self._last + period_ns
        self._canceled = not autostart
        self._takes_info = callback is not None and not _takes_none(callback)

    @property
    def timer_period_ns(self) -> int:
        """Period in nanoseconds."""
        return self._period

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        def change() -> None:
            self._period = int(value)

        self.seat.program.ask(change)

    def ready(self) -> bool:
        """Return whether it is due."""
        return not self._canceled and self.due <= self.seat.now()

    def is_ready(self) -> bool:
        """Return whether it is due."""
        return self.ready()

    def take(self) -> Work:
        """Return the callback; the next call is at the next future multiple of the period."""
        now, due = self.seat.now(), self.due
        self._last = now
        # As fast as possible must not hold simulated time still.
        fastest = TICK if self.seat.program.strict else 0
        if not self._period:
            self.due = now + fastest
        else:
            self.due += self._period
            if self.due < now:
                self.due += -(-(now - self.due) // self._period) * self._period

        def work() -> Any:
            if self.callback is None:
                return None
            if self._takes_info:
                kind = self.clock.clock_type
                info = TimerInfo(expected_call_time=due, actual_call_time=now, clock_type=kind)
                return self.callback(info)
            return self.callback()

        return work

    def cancel(self) -> None:
        """Make no further call until `reset`."""
        self._canceled = True

    def is_canceled(self) -> bool:
        """Return whether it was cancelled."""
        return self._canceled

    def reset(self) -> None:
        """Start again: the next call is one period from now."""

        def restart() -> None:
            self._canceled = False
            self.due = self.seat.now() + self._period
            self.seat.wake()

        self.seat.program.ask(restart)

    def time_since_last_call(self) -> int:
        """Return nanoseconds since the last call."""
        return self.seat.now() - self._last

    def time_until_next_call(self) -> int | None:
        """Return nanoseconds until the next call; None if cancelled."""
        return None if self._canceled else self.due - self.seat.now()


class RateTimer(Timer):
    """Ends a `spin_once` at every period of a rate, as a rate's timer does in ROS."""

    only_ends_spin_once = True


def _takes_none(callback: Callable[..., Any]) -> bool:
    try:
        inspect.signature(callback).bind()
    except TypeError:
        return False
    except ValueError:
        return True
    return True


def period_of(seconds_or_duration: Any) -> int:
    """Return a timer's period in nanoseconds, from seconds or a Duration."""
    if isinstance(seconds_or_duration, Duration):
        return seconds_or_duration.nanoseconds
    return int(float(seconds_or_duration) * 1_000_000_000)
