"""Times and durations: whole nanoseconds, as in tf2.

A stamp is an `int`. As an argument of a lookup, 0 means the latest time with data.
"""

import math
from typing import SupportsIndex, TypeAlias

Stamp: TypeAlias = int
"""A time in nanoseconds since the clock's epoch; in a lookup 0 means the latest."""

Duration: TypeAlias = int
"""A duration in nanoseconds."""

LATEST: Stamp = 0
"""In a lookup: the latest time at which all frames between two frames have data."""

LAST_STAMP: Stamp = 2**63 - 1
"""The largest stamp: stamps have 64 bits."""

NANOSECONDS = 1_000_000_000
"""Nanoseconds in a second."""

SIMULATED_BELOW: Stamp = 10**8 * NANOSECONDS
"""Limit of simulated stamps: smaller stamps count from a simulation's start, larger from 1970."""

CACHE_TIME: Duration = 10 * NANOSECONDS
"""Default time for which a buffer stores samples, as in tf2."""

FRAME_TIMEOUT = 15.0
"""Seconds without a new sample after which a frame counts as dead, as in rviz."""


def seconds(value: float) -> int:
    """Convert seconds to nanoseconds, rounding half away from zero as tf2 does.

    Args:
        value: Seconds, finite.

    Returns:
        Whole nanoseconds.

    Raises:
        TypeError: If `value` is not a number, for example an array.
        ValueError: If `value` is NaN or infinite.
    """
    try:
        is_finite = math.isfinite(value)
    except TypeError as error:
        # For an array, the original error does not name the remedy.
        if not hasattr(value, "__array__"):
            raise
        raise TypeError(
            "seconds() converts one number, not an array: for an array use np.rint(times * "
            "1e9).astype(np.int64)"
        ) from error
    if not is_finite:
        raise ValueError(f"{value!r} is not a finite number of seconds")
    whole = math.floor(value)
    # The fraction is not negative, so rounding half up is rounding half away from zero.
    return whole * NANOSECONDS + math.floor((value - whole) * 1e9 + 0.5)


def whole(stamp: object) -> Stamp:
    """Return a time or duration as an `int`, from any type of integer.

    Raises:
        TypeError: If the value is a float or another object that is not an integer.
    """
    # Nearly all stamps are ints; before Python 3.12 a check of a protocol takes microseconds.
    if type(stamp) is int:
        return stamp
    if isinstance(stamp, SupportsIndex):
        return stamp.__index__()
    raise TypeError(
        f"stamps are whole nanoseconds, not {stamp!r}: write seconds(2.5) for 2.5 seconds"
    )


def as_seconds(stamp: int) -> float:
    """Convert nanoseconds to float seconds, rounded as in tf2."""
    whole, rest = divmod(abs(stamp), NANOSECONDS)
    value = float(whole) + 1e-9 * float(rest)
    return -value if stamp < 0 else value


def time_of_day(stamp: int) -> str:
    """Format a stamp as time of day in UTC; a stamp below `SIMULATED_BELOW` as seconds."""
    if stamp < SIMULATED_BELOW:
        return f"{as_seconds(stamp):.3f}"
    minutes, milliseconds = divmod(stamp // 1_000_000, 60_000)
    hours, minutes = divmod(minutes % 1440, 60)
    return f"{hours:02}:{minutes:02}:{milliseconds / 1000:06.3f}"


def display(stamp: int) -> str:
    """Format a stamp as tf2's messages do: seconds with six decimals."""
    return f"{as_seconds(stamp):.6f}"
