"""Pace of snapshots, so that many of them leave time for everything else."""

from tftool.base.stamps import Duration, Stamp, seconds

FORGIVEN = seconds(1)
"""Turns that came later than this in all are not made up for."""


class Cadence:
    """Turns at a steady rate, each at the earliest as long after the last as that took.

    A turn that comes late moves none of those after it, as long as all of them are short: the
    average rate stays the requested one.
    """

    def __init__(self, period: Duration, start: Stamp) -> None:
        """Begin at `start`, with a turn every `period`."""
        self._period = period
        self._due = start

    def after(self, began: Stamp, ended: Stamp) -> Stamp:
        """The moment of the next turn, when one began and ended at these moments."""
        self._due += self._period
        # Thousands of frames may take longer than a period: never more than half the time.
        earliest = ended + (ended - began)
        if earliest - self._due > FORGIVEN:
            self._due = earliest
        return max(self._due, earliest)
