"""Frames of a running session, recorded for a while."""

from collections.abc import Callable

from tftool.base.errors import LinkError
from tftool.base.stamps import Duration
from tftool.frames.frames import Frames
from tftool.world.clock import FollowedClock
from tftool.world.frame_listener import heard_in, run_apart
from tftool.world.link.link_options import REACHES, Options, domain_here
from tftool.world.link.reach import Reach
from tftool.world.link.session import Link
from tftool.world.link.session_world import Session, joined_session, twins
from tftool.world.world import World

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
) -> Frames:
    """Listen to a joined session."""
    world = session.world
    if watch is not None:
        watch(world)
    start = world.clock.epoch if session.is_hosted else world.clock.now()
    with heard_in(world, cache_time) as (buffer, log):
        run_apart(world.clock, session.along(session.listened(lasting)))
    span = start, world.clock.now()
    notes = tuple(twins(world))
    return Frames("session", session.name, buffer=buffer, span=span, log=log, notes=notes)
