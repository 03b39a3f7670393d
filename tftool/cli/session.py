"""Join or host: the one place that decides where a command's world comes from.

A source named on the command line is always hosted. Without one, a session that
runs on this machine would be joined; as there is no link between processes yet,
every command hosts its own.
"""

import asyncio
import sys
from collections.abc import Awaitable, Callable, Coroutine
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.errors import UsageError
from tftool.runtime.clock import Clock, Phase, WallClock, run
from tftool.runtime.supervisor import live
from tftool.runtime.world import World
from tftool.stamps import Duration, Stamp, as_seconds, seconds
from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.scenario.schema import NodeEntry, Scenario

T = TypeVar("T")

HOME = "turtles"
"""The scenario a command hosts when nothing runs and none was named."""

HEAD_START = seconds(3)
"""How long a hosted world has lived when its command first looks: both turtles are there."""


@dataclass(frozen=True, slots=True)
class Session:
    """A world to work in, and what keeps it alive.

    Attributes:
        world: Its frames and topics.
        is_hosted: Whether this process runs it.
        name: What it is called, in sentences: "scenario 'turtles'".
        live: Lives the world through, for ever or until a moment.
        head_start: How much of it is lived through before work begins.
        duration: How long its scenario lasts; None where nothing says so.
    """

    world: World
    is_hosted: bool
    name: str
    live: Callable[[Stamp | None], Awaitable[None]]
    head_start: Duration = 0
    duration: Duration | None = None

    def run(self, work: Coroutine[Any, Any, T]) -> T:
        """Do some work while the world lives, on the world's clock.

        Returns:
            What the work returns; the world ends with it.

        Raises:
            NodeFailed: If a node of the world raised first.
            KeyboardInterrupt: If a signal ended it.
        """
        return run(self.world.clock, self.along(work))

    def moment(self, after: Duration) -> Stamp:
        """The moment so long after the world began.

        Raises:
            UsageError: If its scenario is over by then.
        """
        if self.duration is not None and after > self.duration:
            raise UsageError(
                f"{self.name} lasts {as_seconds(self.duration):g} s: "
                f"{as_seconds(after):g} s is after its end."
            )
        return self.world.clock.epoch + after

    def live_until(self, moment: Stamp) -> None:
        """Live the world through, its own instant included, with nothing beside it.

        Raises:
            NodeFailed: If a node of the world raised.
        """

        async def lived() -> None:
            await self.live(moment)

        run(self.world.clock, lived())

    async def along(self, work: Coroutine[Any, Any, T]) -> T:
        """The same inside a running loop, for those who bring their own."""
        living = asyncio.ensure_future(self.live(None))
        working = asyncio.ensure_future(self._after_head_start(work))
        both = {living, working}
        try:
            await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            if not working.done():
                # A world that failed ends the work; one that merely ended does not.
                living.result()
            return await working
        finally:
            for task in both:
                task.cancel()
            await asyncio.gather(*both, return_exceptions=True)

    async def lasting(self, duration: Duration | None) -> None:
        """Do nothing for so long, in nanoseconds; for ever if None."""
        if duration is None:
            await asyncio.get_running_loop().create_future()
        else:
            await self.world.clock.sleep(duration, Phase.WATCH)

    async def _after_head_start(self, work: Coroutine[Any, Any, T]) -> T:
        clock = self.world.clock
        if self.head_start:
            await clock.sleep_until(clock.epoch + self.head_start, Phase.WATCH)
        return await work


def open_session(
    source: str | None = None,
    *,
    clock: Clock | None = None,
    head_start: Duration = HEAD_START,
    cache_time: Duration | None = None,
    without: Callable[["NodeEntry"], bool] | None = None,
) -> Session:
    """Give the world a command works in, and say so on stderr when it had to be made.

    Args:
        source: A scenario, by its built-in name or its file; None for the session that runs.
        clock: What a hosted world lives by, from its beginning on; None for the wall clock.
        head_start: How much of a hosted world on the wall clock is lived through at once.
        cache_time: How far back a hosted world's buffer remembers, in place of the
            scenario's own.
        without: Says which of a hosted scenario's nodes to leave out.

    Raises:
        InputError: If there is no such scenario, or it cannot be read.
    """
    from tftool.scenario.builtin import find
    from tftool.scenario.load import load
    from tftool.scenario.play import build

    scenario = _lived_in(load(find(source or HOME)), cache_time, without)
    if source is None:
        notice(f"No session is running here: hosting scenario '{HOME}'.")
    if clock is None:
        clock = WallClock(head_start=head_start)
    else:
        head_start = 0
    play = build(scenario, clock)

    async def alive(until: Stamp | None) -> None:
        # People look for as long as they like, whatever the scenario's duration.
        await play.live(until, endless=until is None)

    name = f"scenario '{visible(scenario.name)}'"
    return Session(play.world, True, name, alive, head_start, scenario.duration)


def open_empty_session(clock: Clock | None = None) -> Session:
    """Give a world with nothing in it to whoever brings all there is to it."""
    world = World(clock or WallClock())

    async def alive(until: Stamp | None) -> None:
        await live(world, until=until)

    return Session(world, True, "an empty world", alive)


def notice(sentence: str) -> None:
    """Tell the user something that is no result."""
    sys.stderr.write(sentence + "\n")
    sys.stderr.flush()


def _lived_in(
    scenario: "Scenario", cache_time: Duration | None, without: Callable[["NodeEntry"], bool] | None
) -> "Scenario":
    """The scenario as a world to look at: nobody judges what happens in it."""
    nodes = scenario.nodes
    if without is not None:
        nodes = tuple(node for node in nodes if not without(node))
    return replace(scenario, nodes=nodes, expect=(), cache_time=cache_time or scenario.cache_time)
