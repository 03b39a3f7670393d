"""The command line in tests: what a run gives, and worlds on simulated time."""

from dataclasses import dataclass

from tftool.commands.shared.connection import Providers
from tftool.world.clock import SimClock


@dataclass(frozen=True)
class Result:
    status: int
    out: str
    err: str


class Simulated(Providers):
    """Worlds live on simulated time, from the end of their head start on, and unshared."""

    def wall_clock(self, rate=1.0, *, head_start=0):
        return SimClock()

    def still_clock(self, epoch, now):
        return SimClock(epoch)

    def link(self, options):
        return None
