"""A world that a command works in, and what keeps it alive meanwhile."""

import asyncio
from collections.abc import Awaitable, Callable, Coroutine, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.cli.notices import tell_news
from tftool.errors import UsageError
from tftool.runtime.clock import Phase, run
from tftool.runtime.supervisor import live
from tftool.runtime.world import World
from tftool.stamps import Duration, Stamp, as_seconds

if TYPE_CHECKING:
    from tftool.link.session import Link

T = TypeVar("T")


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
        link: What joins it to other processes; None for a world on its own.
    """

    world: World
    is_hosted: bool
    name: str
    live: Callable[[Stamp | None], Awaitable[None]]
    head_start: Duration = 0
    duration: Duration | None = None
    link: "Link | None" = None

    def departures(self) -> int:
        """How many of the other processes have left by now that transforms came from."""
        return 0 if self.link is None else self.link.departures

    def abandon(self) -> None:
        """Let go of the other processes, where nothing comes of a session that was opened."""
        if self.link is not None:
            self.link.close()

    def run(
        self, work: Coroutine[Any, Any, T], *, on_interrupt: Callable[[], object] | None = None
    ) -> T:
        """Do some work while the world lives, on the world's clock.

        Args:
            work: What to do.
            on_interrupt: Called when a signal ends it, before anything of the world ends.

        Returns:
            What the work returns; the world ends with it.

        Raises:
            NodeFailed: If a node of the world raised first.
            KeyboardInterrupt: If a signal ended it.
        """
        return run(self.world.clock, self.along(work, on_interrupt))

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

    async def along(
        self, work: Coroutine[Any, Any, T], on_interrupt: Callable[[], object] | None = None
    ) -> T:
        """The same inside a running loop, for those who bring their own."""
        stop_telling = self.world.log.listen(tell_news)
        living = asyncio.ensure_future(self.live(None))
        working = asyncio.ensure_future(self._after_head_start(work))
        both = {living, working}
        try:
            await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            if not working.done():
                # A world that failed ends the work; one that merely ended does not.
                living.result()
            return await working
        except asyncio.CancelledError:
            if on_interrupt is not None:
                on_interrupt()
            raise
        finally:
            for task in both:
                task.cancel()
            await asyncio.gather(*both, return_exceptions=True)
            stop_telling()

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


@contextmanager
def shared(link: "Link | None", world: World, role: str = "host") -> Iterator[None]:
    """Let others share a world for as long as this lasts; call inside its loop.

    Args:
        link: What joins it to the others; None to keep to itself.
        world: What is shared.
        role: What this process is to the others, as `link.graph.Role` has it.
    """
    if link is None:
        yield
        return
    from tftool.link.graph import Role

    try:
        link.attach(world, role=Role(role))
        yield
    finally:
        link.close()


def lived(
    world: World, link: "Link | None", role: str
) -> Callable[[Stamp | None], Awaitable[None]]:
    """What lives a world through, for ever or until a moment, shared all along."""

    async def alive(until: Stamp | None) -> None:
        with shared(link, world, role):
            await live(world, until=until)

    return alive
