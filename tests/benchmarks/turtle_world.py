"""Speed of the turtle world: simulated time per second of one core."""

import statistics
import time

from tftool.base.stamps import as_seconds, seconds
from tftool.messages.turtle_messages import ColorMessage
from tftool.scenario import builtin, load
from tftool.scenario.play import run_scenario
from tftool.world.clock import SimClock, run
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import Broadcaster
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.turtle_drivers import DrawSquare
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World

SIMULATED = 60.0
"""Simulated seconds in each round."""

WANTED = 100.0
"""Required simulated seconds per second of computation, with the leader at rest."""

WANTED_OF_SCENARIO = 200.0
"""Required simulated seconds per second of computation for the demo as a judged scenario."""


def rounds(*, square: bool, color: bool = False, count: int = 7) -> list[float]:
    """Run turtlesim, two broadcasters and the follower; return the ratio of each round.

    Args:
        square: Whether the leader draws squares; otherwise it does not move.
        color: Whether a node subscribes to the colour sensors.
        count: Number of rounds.
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
                world.topic(f"turtle{number}/color_sensor", ColorMessage).subscribe(lambda _: None)
        started = time.process_time()
        run(world.clock, live(world, until=world.clock.epoch + seconds(SIMULATED)))
        ratios.append(SIMULATED / (time.process_time() - started))
    return ratios


def scenario(count: int = 7) -> list[float]:
    """Run the scenario `turtles` with script and expectations; return the ratio of each round."""
    turtles = load.load(builtin.path_of("turtles"))
    ratios = []
    for _ in range(count):
        started = time.process_time()
        verdict = run_scenario(turtles)
        ratios.append(as_seconds(turtles.duration) / (time.process_time() - started))
        assert verdict.ok
    return ratios


def wakeups(nodes: int = 100, count: int = 7) -> list[float]:
    """Return the wake-ups per second of work of nodes that wake ten times a simulated second."""
    rates = []
    for _ in range(count):
        world = World(SimClock())
        for number in range(nodes):
            _Ticking(world, f"node{number}")
        started = time.process_time()
        run(world.clock, live(world, until=world.clock.epoch + seconds(20)))
        rates.append(nodes * 200 / (time.process_time() - started))
    return rates


class _Ticking(Node):
    """Node that wakes periodically and does nothing."""

    async def run(self) -> None:
        async for _ in self.every(seconds(0.1)):
            pass


def report() -> str:
    """Measure, and print a few lines."""
    lines = [
        f"turtle world, {SIMULATED:g} simulated seconds over processor time (median of 7 rounds)"
    ]
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
    found = scenario()
    lines.append(
        f"  {'the scenario turtles':<26}{statistics.median(found):7.0f}   "
        f"({min(found):.0f} to {max(found):.0f}; wanted: {WANTED_OF_SCENARIO:g} at least)"
    )
    found = wakeups()
    lines.append(f"  a hundred nodes wake {statistics.median(found):,.0f} times a second together")
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
