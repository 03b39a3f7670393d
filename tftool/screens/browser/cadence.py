"""Pacing of snapshots, which leaves time for everything else."""

from tftool.base.stamps import Duration, Stamp, seconds

FORGIVEN = seconds(1)
"""Turns that came later than this in all are not made up for."""


class Cadence:
    """Pace of a steady rate, with a pause after each turn at least as long as the turn.

    A turn that comes late moves none of those after it, as long as all of them are short: the
    average rate stays the requested one.
    """

    def __init__(self, period: Duration, start: Stamp) -> None:
        """Start at `start`, with a turn every `period`."""
        self._period = period
        self._due = start

    def after(self, began: Stamp, ended: Stamp) -> Stamp:
        """Return the time of the next turn after one with this start and end."""
        self._due += self._period
        # Thousands of frames may take longer than a period: never more than half the time.
        earliest = ended + (ended - began)
        if earliest - self._due > FORGIVEN:
            self._due = earliest
        return max(self._due, earliest)
