"""Times and durations: whole nanoseconds, as in tf2.

A stamp is an `int`. In a query 0 is not a time: it means "latest".
"""

import math
from typing import SupportsIndex, TypeAlias

Stamp: TypeAlias = int
"""A moment in nanoseconds since the clock's epoch; 0 in a question means latest."""

Duration: TypeAlias = int
"""A length of time in nanoseconds."""

LATEST: Stamp = 0
"""In a question: the latest time for which every link of the chain has data."""

LAST_STAMP: Stamp = 2**63 - 1
"""The last moment there is: stamps have 64 bits."""

NANOSECONDS = 1_000_000_000
"""Nanoseconds in a second."""

SIMULATED_BELOW: Stamp = 10**8 * NANOSECONDS
"""Stamps below this count from a simulation's start, others from 1970."""

CACHE_TIME: Duration = 10 * NANOSECONDS
"""How far back a buffer remembers unless it is told otherwise; tf2's own figure."""

FRAME_TIMEOUT = 15.0
"""Seconds without news after which a frame counts as dead (rviz's default)."""


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
        # What it says of an array speaks of dimensions, not of the remedy.
        if not hasattr(value, "__array__"):
            raise
        raise TypeError(
            "seconds takes one number, not an array: "
            "np.rint(times * 1e9).astype(np.int64) makes stamps of many seconds"
        ) from error
    if not is_finite:
        raise ValueError(f"{value!r} is not a finite number of seconds")
    whole = math.floor(value)
    # The fraction is never negative, so half away from zero is half up.
    return whole * NANOSECONDS + math.floor((value - whole) * 1e9 + 0.5)


def whole(stamp: object) -> Stamp:
    """Return a time or duration as an `int`, from any type of integer.

    Raises:
        TypeError: If the stamp is a float, or not an integer.
    """
    # Nearly always it is one, and to ask for a protocol takes microseconds before Python 3.12.
    if type(stamp) is int:
        return stamp
    if isinstance(stamp, SupportsIndex):
        return stamp.__index__()
    raise TypeError(
        f"stamps are whole nanoseconds, not {stamp!r}: seconds(2.5) makes one of 2.5 seconds"
    )


def as_seconds(stamp: int) -> float:
    """Convert nanoseconds to seconds, split toward zero as tf2 does before adding."""
    whole, rest = divmod(abs(stamp), NANOSECONDS)
    value = float(whole) + 1e-9 * float(rest)
    return -value if stamp < 0 else value


def display(stamp: int) -> str:
    """Format a stamp as tf2's messages do: seconds with six decimals."""
    return f"{as_seconds(stamp):.6f}"
