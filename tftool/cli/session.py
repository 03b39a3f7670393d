"""Join or host: the one place that decides where a command's world comes from.

A source named on the command line is always hosted. Without one, the session that
runs on this machine is joined; if none runs, the command hosts one, and others join
it. Those who only look are no session: they wait, and share whatever is hosted next.
While one world is hosted another keeps to itself, so that the two never mix.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from tftool.cli.lifetime import Session, lived, shared
from tftool.cli.notices import notice
from tftool.cli.sharing import Choice, Mode, choice, open_link
from tftool.errors import LinkError, UsageError
from tftool.runtime.clock import Clock, WallClock
from tftool.runtime.world import World
from tftool.stamps import Duration, Stamp, seconds
from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.link.session import Link
    from tftool.scenario.schema import NodeEntry, Scenario

HOME = "turtles"
"""The scenario a command hosts when nothing runs and none was named."""

NO_SESSION = "No session is running here"
A_MOMENT = "A chosen moment is always simulated"
"""Why a world that nobody named is hosted."""

HEAD_START = seconds(3)
"""How long a hosted world has lived when its command first looks: both turtles are there."""

CACHE_TIME = seconds(10)
"""How far back the buffer of a joined world remembers; tf2's own figure."""


@dataclass(frozen=True, slots=True)
class Found:
    """What a command finds when it looks whom it could share a world with.

    Attributes:
        session: The session it has joined; None where it has to host.
        link: By which a host lets others in; None where it keeps to itself.
        alone: Why it does, as a sentence.
    """

    session: Session | None = None
    link: "Link | None" = None
    alone: str = ""


def look_around(
    source: str | None, *, needs_turtles: bool = False, cache_time: Duration | None = None
) -> Found:
    """Join what runs here, else become the one to host; nobody else decides meanwhile.

    Args:
        source: The scenario that was named, which is hosted; None for the session that runs.
        needs_turtles: Whether only a session with a turtle simulator will do.
        cache_time: How far back the buffer of a joined world remembers.

    Raises:
        LinkError: If a session was asked for and there is none, or no link.
        UsageError: If it was told to join: what is named is hosted.
    """
    chosen = choice()
    _refuse_to_join(source, chosen)
    link, alone = _open_link(chosen)
    if link is None:
        return Found(alone=alone)
    there = link.graph.has_sources
    if source is None and chosen.mode is not Mode.HOST:
        # Who names the other end means what is there, or comes there; nobody wants turtles
        # of his own among a robot's frames.
        if chosen.connect or (there and (not needs_turtles or _has_host(link))):
            world = World(WallClock(), cache_time=cache_time or CACHE_TIME)
            name = _name_of(link)
            notice(f"Joined {name}.")
            return Found(Session(world, False, name, lived(world, link, "guest"), link=link))
        if chosen.mode is Mode.JOIN or chosen.read_only:
            link.close()
            what = "session with turtles" if there else "session"
            raise LinkError(
                f"No {what} is running in domain {chosen.domain}: start one with 'tftool demo', "
                "or leave out the option to host one here."
            )
    elif _has_host(link):
        link.close()
        alone = (
            f"A session is running here, {_name_of(link)}; this world keeps to itself "
            "(--domain N would give it a session of its own)."
        )
        notice(alone)
        return Found(alone=alone)
    return Found(link=link)


def open_session(
    source: str | None = None,
    *,
    clock: Clock | None = None,
    head_start: Duration = HEAD_START,
    cache_time: Duration | None = None,
    without: Callable[["NodeEntry"], bool] | None = None,
    needs_turtles: bool = False,
    because: str = NO_SESSION,
    by_hand: bool = False,
) -> Session:
    """Give the world a command works in, and say so on stderr when it had to be made.

    Args:
        source: A scenario, by its built-in name or its file; None for the session that runs.
        clock: What a hosted world lives by, from its beginning on; None for the wall clock.
        head_start: How much of a hosted world on the wall clock is lived through at once.
        cache_time: How far back the world's buffer remembers, in place of the scenario's own.
        without: Says which of a hosted scenario's nodes to leave out.
        needs_turtles: Whether only a session with a turtle simulator will do.
        because: Why a world that nobody named is hosted, for people.
        by_hand: Whether somebody drives in it, in place of the scenario's own script.

    Raises:
        InputError: If there is no such scenario, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If sharing was asked for where time is simulated.
    """
    link = None
    if clock is None:
        found = look_around(source, needs_turtles=needs_turtles, cache_time=cache_time)
        if found.session is not None:
            return found.session
        link = found.link
    else:
        _refuse_to_share(source)
    try:
        scenario = _chosen(source, because)
        if by_hand:
            scenario = left_to_a_person(scenario)
        if without is not None:
            kept = tuple(node for node in scenario.nodes if not without(node))
            scenario = replace(scenario, nodes=kept)
        cache_time = cache_time or scenario.cache_time
        return _hosted(replace(scenario, cache_time=cache_time), clock, head_start, link)
    except BaseException:
        if link is not None:
            link.close()
        raise


def join_session(
    *, needs_turtles: bool = False, cache_time: Duration | None = None
) -> Session | None:
    """Give the world of the session that runs here; None where none does.

    For commands that host on simulated time: nothing is opened for others to join.

    Raises:
        LinkError: If a session was asked for and there is none.
    """
    chosen = choice()
    if chosen.mode is Mode.HOST or (not chosen.is_asked_for and not _somebody_is_here(chosen)):
        return None
    found = look_around(None, needs_turtles=needs_turtles, cache_time=cache_time)
    if found.link is not None:
        found.link.close()
    return found.session


def open_empty_session(clock: Clock | None = None) -> Session:
    """Give a world with nothing in it to whoever brings all there is to it; others see it."""
    world = World(clock or WallClock())
    link = _open_link(choice())[0] if clock is None else None
    alive = lived(world, link, "source")
    return Session(world, True, "an empty world", alive, link=link)


def _refuse_to_share(source: str | None) -> None:
    """Say so to whoever wants to share a world on simulated time."""
    chosen = choice()
    _refuse_to_join(source, chosen)
    if chosen.is_asked_for:
        raise UsageError(
            f"'{source or HOME}' is played on simulated time here, which nobody can share: "
            "leave out --join, --listen, --connect, --zenoh-config and --read-only."
        )


def _refuse_to_join(source: str | None, chosen: Choice) -> None:
    if source is not None and chosen.mode is Mode.JOIN:
        raise UsageError(f"'{source}' is always hosted: leave out --join, or the name.")


def _chosen(source: str | None, because: str) -> "Scenario":
    """The scenario to host; said on stderr where none was named."""
    from tftool.scenario.builtin import find
    from tftool.scenario.load import load

    scenario = load(find(source or HOME))
    if source is None:
        notice(f"{because}: hosting scenario '{HOME}'.")
    return scenario


def _hosted(
    scenario: "Scenario", clock: Clock | None, head_start: Duration, link: "Link | None"
) -> Session:
    """Host a world to look at: nobody judges what happens in it."""
    from tftool.scenario.play import build

    if clock is None:
        clock = WallClock(head_start=head_start)
    else:
        head_start = 0
    play = build(replace(scenario, expect=()), clock)

    async def alive(until: Stamp | None) -> None:
        with shared(link, play.world):
            # People look for as long as they like, whatever the scenario's duration.
            await play.live(until, endless=until is None)

    name = f"scenario '{visible(scenario.name)}'"
    return Session(play.world, True, name, alive, head_start, scenario.duration, link)


def _open_link(chosen: Choice) -> tuple["Link | None", str]:
    """Open the link; a place that has none can still host, and says why it is alone.

    Raises:
        LinkError: If something was asked for that only a link can give.
    """
    try:
        return open_link(), ""
    except LinkError as error:
        if chosen.is_asked_for:
            raise
        alone = f"Nobody can join this world: {visible(str(error))}."
        notice(alone)
        return None, alone


def _somebody_is_here(chosen: Choice) -> bool:
    """Whether some process of this machine waits to be joined, without opening anything."""
    from tftool.link.rendezvous import is_anybody_there

    return is_anybody_there(chosen.domain)


def _has_host(link: "Link") -> bool:
    """Whether a world runs here: one of ours, or turtles of a launch file or of ROS."""
    from tftool.link.graph import hosts

    # A host that has only just begun has no turtles yet, and will have some.
    return bool(hosts(link.graph.processes()) or link.graph.entities("SS", name="spawn"))


def _name_of(link: "Link") -> str:
    from tftool.link.graph import Role, hosts

    processes = link.graph.processes()
    sources = [one for one in processes if one.role is not Role.GUEST]
    first = next(iter(hosts(processes) or sources), None)
    if first is not None:
        return f"the session of {visible(str(first))}"
    nodes = sorted({one.node for one in link.graph.entities("NN")})
    if nodes:
        return f"the session of ROS node '{visible(nodes[0])}'"
    return f"what is at {visible(', '.join(choice().connect))}, which is nobody yet"


def left_to_a_person(scenario: "Scenario") -> "Scenario":
    """The scenario without what somebody at the keys does better, and without a judge."""
    from tftool.scenario.actions import Drive, Press

    script = tuple(step for step in scenario.script if not isinstance(step.action, Drive | Press))
    return replace(scenario, script=script, expect=())
