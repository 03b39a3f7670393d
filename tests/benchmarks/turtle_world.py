"""How fast the turtle world plays: simulated time over real time, on one core."""

import statistics
import time

from tftool.messages import Color
from tftool.nodes.broadcasters import Broadcaster
from tftool.nodes.follower import Follower
from tftool.nodes.squares import DrawSquare
from tftool.nodes.turtlesim import Turtlesim
from tftool.runtime.clock import SimClock, run
from tftool.runtime.supervisor import live
from tftool.runtime.world import World
from tftool.stamps import seconds

SIMULATED = 60.0
"""Seconds that each round lives through."""

WANTED = 100.0
"""Times real time that must be reached with the leader at rest."""


def rounds(*, square: bool, color: bool = False, count: int = 7) -> list[float]:
    """Play turtlesim, two broadcasters and the follower; give each round's ratio to real time.

    Args:
        square: Whether the leader draws squares; otherwise it rests.
        color: Whether somebody listens to the colour sensors.
        count: How many rounds.
    """
    ratios = []
    for _ in range(count):
        world = World(SimClock())
        Turtlesim(world)
        for number in (1, 2):
            Broadcaster(world, f"broadcaster{number}", turtle=f"turtle{number}")
        Follower(world, "listener")
        if square:
            DrawSquare(world, reset=False)
        if color:
            for number in (1, 2):
                world.topic(f"turtle{number}/color_sensor", Color).subscribe(lambda _: None)
        started = time.perf_counter()
        run(world.clock, live(world, until=world.clock.epoch + seconds(SIMULATED)))
        ratios.append(SIMULATED / (time.perf_counter() - started))
    return ratios


def report() -> str:
    """Measure, and say it in a few lines."""
    lines = [f"turtle world, {SIMULATED:g} simulated seconds, times real time (median of 7)"]
    for what, options in (
        ("leader at rest", {"square": False}),
        ("leader drawing squares", {"square": True}),
        ("and colour sensors read", {"square": True, "color": True}),
    ):
        found = rounds(**options)
        lines.append(
            f"  {what:<26}{statistics.median(found):7.0f}   "
            f"({min(found):.0f} to {max(found):.0f}; wanted: {WANTED:g} at least)"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
