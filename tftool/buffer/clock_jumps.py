"""Backward jumps of a clock, after which a buffer's samples are obsolete."""

from collections.abc import Callable

from tftool.base.stamps import NANOSECONDS, Duration, Stamp

LEAST_FALL: Duration = NANOSECONDS
"""Smallest backward jump of a clock that clears a buffer, as in tf2's Python code.

tf2's C++ buffer is cleared after a jump of one nanosecond.
"""

FELL_BACK = "Detected jump back in time. Clearing tf buffer."


def must_clear(
    change: Duration, *, source_changed: bool = False, least_fall: Duration = LEAST_FALL
) -> bool:
    """Whether a jump of the clock makes all moving samples in a buffer obsolete.

    Args:
        change: Size of the jump, nanoseconds; negative for a jump backward. A jump forward makes
            nothing obsolete.
        source_changed: Whether the source of time changed; then samples are always obsolete.
        least_fall: Smallest jump backward that makes samples obsolete, nanoseconds.
    """
    return source_changed or change <= -least_fall


class Watch:
    """Watcher of clock readings that clears a buffer when the clock jumps back.

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
        """Check a clock reading, and clear the buffer if it jumped back; return whether it did."""
        last, self._last = self._last, now
        if last is None or not must_clear(now - last, least_fall=self._least_fall):
            return False
        if self._log is not None:
            self._log("WARN", FELL_BACK)
        self._clear()
        return True
