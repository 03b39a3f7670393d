"""Command line in tests: the results of a run, and worlds on simulated time."""

from dataclasses import dataclass

from tftool.commands.shared.connection import Providers
from tftool.world.clock import SimClock


@dataclass(frozen=True)
class Result:
    status: int
    out: str
    err: str


class Simulated(Providers):
    """Worlds without a session, on simulated time that begins after their head start."""

    def wall_clock(self, rate=1.0, *, head_start=0):
        return SimClock()

    def still_clock(self, epoch, now):
        return SimClock(epoch)

    def link(self, options):
        return None
