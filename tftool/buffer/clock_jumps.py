"""Backward jumps of a clock, after which a buffer's samples are obsolete."""

from collections.abc import Callable

from tftool.base.stamps import NANOSECONDS, Duration, Stamp

LEAST_FALL: Duration = NANOSECONDS
"""How far a clock must fall before a buffer is cleared: tf2's rule in Python.

Its C++ buffer clears at the first nanosecond.
"""

FELL_BACK = "Detected jump back in time. Clearing tf buffer."


def must_clear(
    change: Duration, *, source_changed: bool = False, least_fall: Duration = LEAST_FALL
) -> bool:
    """Whether a jump of the clock makes all moving samples obsolete.

    Args:
        change: Size of the jump, nanoseconds; negative for a jump backward. A jump forward never
            clears.
        source_changed: Whether the source of time changed; this always clears.
        least_fall: Smallest jump backward that clears, nanoseconds.
    """
    return source_changed or change <= -least_fall


class Watch:
    """Watcher of a clock's readings that clears a buffer when they jump back.

    A buffer has no clock. Code that fills a buffer from a recording or simulation, which may
    restart, first passes each new time to this class.
    """

    def __init__(
        self,
        clear: Callable[[], object],
        log: Callable[[str, str], object] | None = None,
        *,
        least_fall: Duration = LEAST_FALL,
    ) -> None:
        self._clear = clear
        self._log = log
        self._least_fall = least_fall
        self._last: Stamp | None = None

    def read(self, now: Stamp) -> bool:
        """Check a clock reading; return whether the buffer was cleared."""
        last, self._last = self._last, now
        if last is None or not must_clear(now - last, least_fall=self._least_fall):
            return False
        if self._log is not None:
            self._log("WARN", FELL_BACK)
        self._clear()
        return True
