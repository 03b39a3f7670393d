"""Short texts for counts, durations, rates and sizes, and numbers that are valid in JSON."""

import math

from tftool.base.stamps import Duration, as_seconds


def count(number: int, word: str) -> str:
    """Return a number with its noun, in singular or plural: "1 link", "2,104 links"."""
    return f"{number:,} {word}" if number == 1 else f"{number:,} {word}s"


def short_duration(duration: Duration) -> str:
    """Format a duration of nanoseconds as "0.02 s", "2.0 s", "3.5 min", "2.1 h" or "4.0 d"."""
    number = as_seconds(duration)
    size = abs(number)
    if size < 0.995:
        return f"{number if size >= 0.005 else 0.0:.2f} s"
    if size < 99.95:
        return f"{number:.1f} s"
    for most, unit, length in ((99.95 * 60, "min", 60), (47.95 * 3600, "h", 3600)):
        if size < most:
            return f"{number / length:.1f} {unit}"
    return f"{number / 86400:.1f} d"


def short_rate(rate: float) -> str:
    """Format a rate in hertz as "0.50 Hz", "62.7 Hz" or "1000 Hz"."""
    if rate < 0.995:
        return f"{rate:.2f} Hz"
    return f"{rate:.1f} Hz" if rate < 999.95 else f"{rate:.0f} Hz"


def short_size(size: int) -> str:
    """Format a number of bytes as "17 bytes", "1.2 KB", "4.7 MB" or "2.0 GB"."""
    for unit, many in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6), ("KB", 1e3)):
        if size >= many:
            return f"{size / many:.1f} {unit}"
    return f"{size} bytes"


def finite(number: float) -> float | None:
    """Return the number, or None (null in JSON) for NaN and infinities."""
    return number if math.isfinite(number) else None
