"""Time of an insert while many requests wait for other frames."""

import statistics
import time

from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

WAITING = 10_000
"""Number of pending requests."""

WANTED = 50.0
"""Maximum microseconds that all pending requests together may add to one insert."""

ROUNDS = 500


def microseconds(waiting: int, name: str) -> float:
    """Return the median time of an insert while requests wait for siblings of the child.

    Args:
        waiting: Number of pending requests, each for a different frame.
        name: Name of the inserted child; with a placeholder for a number, a new child each time.
    """
    buffer = Buffer()
    buffer.set_transform(TransformStamped(1, "world", "known", Transform()), "benchmark")
    for number in range(waiting):
        sister = TransformStamped(1, "world", f"sister{number}", Transform())
        buffer.set_transform(sister, "benchmark")
        buffer.request(lambda handle, available: None, "world", f"sister{number}", 10**9)
    taken = []
    for stamp in range(2, 2 + ROUNDS):
        sample = TransformStamped(stamp, "world", name.format(stamp), Transform())
        started = time.perf_counter_ns()
        buffer.set_transform(sample, "benchmark")
        taken.append(time.perf_counter_ns() - started)
    return statistics.median(taken) / 1e3


def report() -> str:
    """Measure, and print a few lines."""
    lines = [f"one set while {WAITING} requests wait for other frames, microseconds (median)"]
    for what, name in (("of a known child", "known"), ("of a new child", "new{}")):
        alone, beside = microseconds(0, name), microseconds(WAITING, name)
        lines.append(
            f"  {what:<20}{beside:7.1f}   {beside - alone:+.1f} against none that wait "
            f"(wanted: +{WANTED:g} at most)"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
