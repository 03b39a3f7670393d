"""Session of a command: its world (nodes, topics, frames), and a connection to other processes."""

import asyncio
from collections import Counter
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.base.errors import LinkError
from tftool.base.plain_text import visible
from tftool.base.stamps import CACHE_TIME, Duration, Stamp, seconds
from tftool.frames.frames import Frames
from tftool.frames.transform_log import TransformLog
from tftool.world.clock import Clock, FollowedClock, Phase, pace_of, run
from tftool.world.endpoints import PUBLISHER
from tftool.world.frame_listener import heard_in, run_apart
from tftool.world.link.graph import NODE, Role, hosts
from tftool.world.link.link_options import REACHES, Options, domain_here
from tftool.world.link.reach import Reach
from tftool.world.link.session import Link
from tftool.world.link.topic_bridges import ClockFollower, is_clock_shown
from tftool.world.supervisor import beside, live
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.world.link.session import Link
    from tftool.world.log import LogRecord


T = TypeVar("T")

TOLD = seconds(2)
"""Longest wait in nanoseconds of a joined world for the first message on `/clock`."""

STATICS = seconds(8)
"""Nanoseconds to wait longer for static transforms of known publishers."""


def _keep_silent(record: "LogRecord") -> None:
    """Drop a log message."""


@dataclass(frozen=True, slots=True)
class Session:
    """World (nodes, topics, frames) of a command, with the function that runs the world.

    Attributes:
        world: The world, with its frames and topics.
        is_hosted: Whether this process hosts the session.
        name: Name for messages to the user, such as "scenario 'turtles'".
        live: Coroutine function that runs the world until a time, or for ever.
        head_start: Nanoseconds to simulate before the command's work begins.
        duration: Duration of the scenario in nanoseconds; None if unlimited.
        link: Connection to other processes; None without a connection.
        tell: Function called with every log message while the world runs.
    """

    world: World
    is_hosted: bool
    name: str
    live: Callable[[Stamp | None], Coroutine[Any, Any, None]]
    head_start: Duration = 0
    duration: Duration | None = None
    link: "Link | None" = None
    tell: "Callable[[LogRecord], object]" = _keep_silent

    def departures(self) -> int:
        """Return the number of processes that published transforms and have left the session."""
        return 0 if self.link is None else self.link.departures

    def abandon(self) -> None:
        """Leave a session that was joined but will not be used."""
        if self.link is not None:
            self.link.close()

    def run(
        self, work: Coroutine[Any, Any, T], *, on_interrupt: Callable[[], object] | None = None
    ) -> T:
        """Await `work` while the world runs, on the world's clock; the world ends with `work`.

        Args:
            work: Coroutine with the work of the command.
            on_interrupt: Function called when a signal ends `work`, before the world ends.

        Returns:
            Result of `work`.

        Raises:
            NodeFailed: If a node of the world failed first.
            KeyboardInterrupt: If a signal ended the session.
        """
        return run(self.world.clock, self.along(work, on_interrupt))

    async def along(
        self, work: Coroutine[Any, Any, T], on_interrupt: Callable[[], object] | None = None
    ) -> T:
        """Await `work` while the world runs, inside a running event loop; see `run`."""
        stop_telling = self.world.log.listen(self.tell, "console")
        try:
            return await beside(self._after_head_start(work), self.live(None), on_interrupt)
        finally:
            stop_telling()

    async def lasting(self, duration: Duration | None) -> None:
        """Wait for a duration in nanoseconds; wait for ever if `duration` is None."""
        await lasting(self.world.clock, duration)

    async def listened(self, duration: Duration) -> None:
        """Wait for a duration; in a robot's session, wait a little longer for static transforms."""
        await self.lasting(duration)
        if self.link is None or not self.link.options.reach.is_robots:
            return
        clock = pace_of(self.world.clock)
        end = clock.now() + STATICS
        while self.link.awaits_statics and clock.now() < end:
            await clock.sleep(seconds(0.02), Phase.WATCH)

    async def _after_head_start(self, work: Coroutine[Any, Any, T]) -> T:
        clock = self.world.clock
        if self.head_start:
            await clock.sleep_until(clock.epoch + self.head_start, Phase.WATCH)
        link = self.link
        if isinstance(clock, FollowedClock) and link is not None and is_clock_shown(link.graph):
            await clock.wait_until_told(TOLD)
        return await work


async def lasting(clock: Clock, duration: Duration | None) -> None:
    """Wait for a duration on the clock `pace_of(clock)`; if `duration` is None, for ever."""
    if duration is None:
        await asyncio.get_running_loop().create_future()
        return
    pace = pace_of(clock)
    # Without a limit, a node that blocks the event loop would prevent the end.
    pace.limit(pace.now() + duration)
    try:
        await pace.sleep(duration, Phase.WATCH)
    finally:
        pace.limit(None)


def joined_session(
    link: "Link",
    clock: Clock,
    place: str,
    *,
    cache_time: Duration | None = None,
    tell: "Callable[[LogRecord], object]" = _keep_silent,
) -> Session:
    """Return a `Session` whose world receives the frames of a running session.

    Args:
        link: Connection to the session.
        clock: Clock of the world.
        place: Description of the network, used as a name if no process or node is known yet.
        cache_time: Cache time of the world's buffer, nanoseconds; None for the default.
        tell: Function called with every log message.
    """
    world = World(clock, cache_time=cache_time or CACHE_TIME)
    alive = partial(live_shared, world, link, "guest")
    return Session(world, False, session_name(link, place), alive, link=link, tell=tell)


def session_name(link: "Link", place: str) -> str:
    """Return a session's name for messages: the host's name, else a node's name, else `place`."""
    if link.options.reach.only_reads:
        return visible(place)
    processes = link.graph.processes()
    sources = [one for one in processes if one.role is not Role.GUEST]
    first = next(iter(hosts(processes) or sources), None)
    if first is not None:
        return f"the session of {visible(str(first))}"
    nodes = sorted({one.node for one in link.graph.entities(NODE)})
    if nodes:
        return f"the session of ROS node '{visible(nodes[0])}'"
    others = sorted({one.node for one in link.graph.entities()})
    if others:
        return f"'{visible(others[0])}' at {visible(place)}"
    return f"the session at {visible(place)}, where nothing has answered yet"


def twins(world: World) -> list[str]:
    """Return a warning for each node name under which several nodes publish transforms."""
    names = Counter(end.node for end in world.endpoints.of("tf", PUBLISHER))
    return [
        f"{count} nodes called '{visible(name)}' send transforms: was the node started twice?"
        for name, count in sorted(names.items())
        if count > 1
    ]


@contextmanager
def shared(link: "Link | None", world: World, role: str = "host") -> Iterator[None]:
    """Share a world with other processes while this block runs, inside the world's event loop.

    Args:
        link: Connection to the other processes; None to share nothing.
        world: World to share.
        role: Role of this process, a value of `link.graph.Role`.
    """
    if link is None:
        yield
        return
    follower: ClockFollower | None = None
    try:
        link.attach(world, role=Role(role))
        # A player sets its own clock, which shows the recording's time from the start.
        is_player = isinstance(world.clock, FollowedClock) and world.clock.is_told
        if not (is_player or world.has_own_time):
            follower = ClockFollower(world)
        yield
    finally:
        if follower is not None:
            follower.close()
        link.close()


async def live_shared(
    world: World, link: "Link | None", role: str, until: Stamp | None = None
) -> None:
    """Share and run a world until the time `until`, or for ever; see `shared` and `live`."""
    with shared(link, world, role):
        await live(world, until=until)


_GLANCES = seconds(0.1)
"""Nanoseconds between two calls of `glance`."""

NOTHING_RUNS = "No session is running here: start one with 'tftool demo'."


def join_to_listen(domain: int | None, reach: Reach) -> Session:
    """Join the running session (processes that share frames) in order to listen only.

    Raises:
        LinkError: If no session is running.
    """
    domain = domain_here() if domain is None else domain
    reaches_out = reach.awaits_others(hosts=False)
    if not reaches_out and not REACHES[0].has_members(domain):
        raise LinkError(NOTHING_RUNS)
    link = Link(Options("open", domain, reach, read_only=True))
    if not reaches_out and not link.graph.has_sources:
        link.close()
        raise LinkError(NOTHING_RUNS)
    return joined_session(link, FollowedClock(), reach.place(domain))


def listened(
    session: Session,
    lasting: Duration,
    cache_time: Duration | None,
    watch: Callable[[World], object] | None,
    glance: Callable[[Frames, Duration], object] | None = None,
) -> Frames:
    """Record the frames of a joined session.

    Args:
        session: The joined session.
        lasting: Duration of the recording, nanoseconds.
        cache_time: Time for which samples are kept, nanoseconds; None for all samples.
        watch: Function called once with the world, before the recording.
        glance: Function called in another thread during the recording, again and again, with a
            copy of the frames and the time since the start.
    """
    world = session.world
    if watch is not None:
        watch(world)
    start = world.clock.epoch if session.is_hosted else world.clock.now()
    with heard_in(world, cache_time) as (buffer, log):
        listening = session.listened(lasting)
        if glance is not None:
            listening = beside(listening, _glances(session, start, log, glance))
        run_apart(world.clock, session.along(listening))
    span = start, world.clock.now()
    notes = tuple(twins(world))
    return Frames("session", session.name, buffer=buffer, span=span, log=log, notes=notes)


async def _glances(
    session: Session,
    start: Stamp,
    log: TransformLog,
    glance: Callable[[Frames, Duration], object],
) -> None:
    """Call `glance` repeatedly with the frames recorded so far and the elapsed duration."""
    pace = pace_of(session.world.clock)
    began = pace.now()
    while True:
        span = start, session.world.clock.now()
        heard = Frames("session", session.name, span=span, log=log.copy())
        # In a thread, because the loop must continue to stamp the messages that arrive.
        await asyncio.to_thread(glance, heard, pace.now() - began)
        await pace.sleep(_GLANCES, Phase.WATCH)
