"""A world that a command works in, and what keeps it alive and shares it."""

import asyncio
from collections.abc import Awaitable, Callable, Coroutine, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.base.errors import UsageError
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.shared.notices import tell_news
from tftool.commands.shared.options import At
from tftool.world.clock import FollowedClock, Phase, pace_of, run
from tftool.world.supervisor import beside, live
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot
    from tftool.world.link.session import Link

T = TypeVar("T")

TOLD = seconds(2)
"""How long a joined world waits for the first that `/clock` says, where it is published."""

STATICS = seconds(8)
"""How much longer for static transforms of publishers that are there: DDS repeats what was lost."""


@dataclass(frozen=True, slots=True)
class Session:
    """A world to work in, and what keeps it alive.

    Attributes:
        world: Its frames and topics.
        is_hosted: Whether this process runs it.
        name: What it is called, in sentences: "scenario 'turtles'".
        live: Lives the world through, for ever or until a moment.
        head_start: How much of it is lived through before work begins.
        duration: How long its scenario or recording lasts; None where nothing says so.
        link: What joins it to other processes; None for a world on its own.
        is_recorded: Whether all of its frames are there from the beginning, and none come.
        robot: The robot in a recording, by its description.
        is_played: Whether a recording's messages arrive in it, which are over at its end.
        recording: The recording whose frames these are.
    """

    world: World
    is_hosted: bool
    name: str
    live: Callable[[Stamp | None], Awaitable[None]]
    head_start: Duration = 0
    duration: Duration | None = None
    link: "Link | None" = None
    is_recorded: bool = False
    robot: "Robot | None" = None
    is_played: bool = False
    recording: "Recording | None" = None

    def first_look(self) -> Stamp | None:
        """Where to begin to look at what is recorded; None to look at the present."""
        if not self.is_recorded or not self.duration:
            return None
        from tftool.screens.first_moment import first_moment

        clock = self.world.clock
        end = min(clock.epoch + self.duration, clock.now())
        return first_moment(self.world.buffer, clock.epoch, end) or clock.epoch

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

    def moment(self, at: At) -> Stamp:
        """The stamp of a moment that was asked for.

        Raises:
            UsageError: If the scenario or recording has not begun then, or is over.
        """
        return checked_moment(at, self.name, self.world.clock.epoch, self.duration)

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
        """The same as `run`, inside a loop that runs."""
        stop_telling = self.world.log.listen(tell_news, "console")
        try:
            return await beside(self._after_head_start(work), self._living(), on_interrupt)
        finally:
            stop_telling()

    async def _living(self) -> None:
        await self.live(None)

    async def lasting(self, duration: Duration | None) -> None:
        """Do nothing for `duration` nanoseconds; for ever if None."""
        if duration is None:
            await asyncio.get_running_loop().create_future()
        else:
            clock = pace_of(self.world.clock)
            # A node that holds up the loop would keep this from ever being over.
            clock.limit(clock.now() + duration)
            try:
                await clock.sleep(duration, Phase.WATCH)
            finally:
                clock.limit(None)

    async def listened(self, duration: Duration) -> None:
        """Listen for `duration` nanoseconds, over DDS until the static transforms have come."""
        await self.lasting(duration)
        if self.link is None or self.link.options.middleware != "dds":
            return
        clock = pace_of(self.world.clock)
        end = clock.now() + STATICS
        while self.link.awaits_statics and clock.now() < end:
            await clock.sleep(seconds(0.02), Phase.WATCH)

    async def _after_head_start(self, work: Coroutine[Any, Any, T]) -> T:
        clock = self.world.clock
        if self.head_start:
            await clock.sleep_until(clock.epoch + self.head_start, Phase.WATCH)
        if isinstance(clock, FollowedClock) and self.link is not None:
            from tftool.world.link.clock_follower import is_clock_shown

            if is_clock_shown(self.link.graph):
                await clock.told_once(TOLD)
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
    from tftool.world.link.clock_follower import ClockFollower
    from tftool.world.link.graph import Role

    follower: ClockFollower | None = None
    try:
        link.attach(world, role=Role(role))
        if isinstance(world.clock, FollowedClock) and role == Role.GUEST:
            follower = ClockFollower(world, world.clock)
        yield
    finally:
        if follower is not None:
            follower.close()
        link.close()


def lived(
    world: World, link: "Link | None", role: str
) -> Callable[[Stamp | None], Awaitable[None]]:
    """What lives a world through, for ever or until a moment, shared all along."""

    async def alive(until: Stamp | None) -> None:
        with shared(link, world, role):
            await live(world, until=until)

    return alive


def checked_moment(at: At, name: str, epoch: Stamp, duration: Duration | None) -> Stamp:
    """The stamp of a moment, which lies between the beginning and the end.

    Raises:
        UsageError: If it does not.
    """
    stamp = at.stamp(epoch)
    if duration is not None and stamp > epoch + duration:
        if at.is_stamp:
            end = At(epoch + duration, is_stamp=True)
            raise UsageError(f"{name} ends at {end}: {at} is after that.")
        raise UsageError(f"{name} lasts {as_seconds(duration):g} s: {at} is after its end.")
    if stamp < epoch:
        raise UsageError(f"{name} begins at {At(epoch, is_stamp=True)}: {at} is before that.")
    return stamp
