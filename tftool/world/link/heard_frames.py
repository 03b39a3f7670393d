"""Frames of a running session, recorded for a while."""

import asyncio
from collections.abc import Callable

from tftool.base.errors import LinkError
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.frames.frames import Frames
from tftool.frames.transform_log import TransformLog
from tftool.world.clock import FollowedClock, Phase, pace_of
from tftool.world.frame_listener import heard_in, run_apart
from tftool.world.link.link_options import REACHES, Options, domain_here
from tftool.world.link.reach import Reach
from tftool.world.link.session import Link
from tftool.world.link.session_world import Session, joined_session, twins
from tftool.world.supervisor import beside
from tftool.world.world import World

_GLANCES = seconds(0.1)
"""Time from the end of one look at what was heard so far to the next."""

NOTHING_RUNS = "No session is running here: start one with 'tftool demo'."


def join_to_listen(domain: int | None, reach: Reach) -> Session:
    """Join the running session as a listener.

    Raises:
        LinkError: If none runs.
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
    """Listen to a joined session; see `open_frames`."""
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
    """Call `glance` again and again with what was heard so far, and for how long."""
    pace = pace_of(session.world.clock)
    began = pace.now()
    while True:
        span = start, session.world.clock.now()
        heard = Frames("session", session.name, span=span, log=log.copy())
        # In a thread: what arrives meanwhile is dated by this loop, and must not wait.
        await asyncio.to_thread(glance, heard, pace.now() - began)
        await pace.sleep(_GLANCES, Phase.WATCH)
