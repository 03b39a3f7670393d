"""Decision whether a command joins or hosts a session, the same for all commands.

A named scenario is always hosted. Without a name, the command joins the running session of this
machine, or hosts a session that other processes can join. Processes that only watch do not form a
session, but wait for the next host. If a session is hosted already, a named scenario is not shared,
so that the two worlds never mix.

A command that works in a running world (``echo``, ``monitor``, ``view``) opens a session::

        session = open_session(connection, place)
        session.run(work(session.world))

`open_from` is for files, and for commands that need the frames once.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from tftool.base.errors import LinkError, UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.commands.shared.connection import HOME, NO_SESSION, Connection, Mode
from tftool.commands.shared.notices import notice, tell_news
from tftool.opener import named, refuse_options_of_files, scenario_named
from tftool.recordings.find import Kind
from tftool.world.clock import SimClock
from tftool.world.link.graph import SERVER, hosts
from tftool.world.link.session_world import (
    Session,
    joined_session,
    live_shared,
    session_name,
    shared,
)
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.scenario.play import Play
    from tftool.scenario.scenario import NodeEntry, Scenario
    from tftool.world.link.session import Link

HEAD_START = seconds(3)
"""Nanoseconds simulated before a hosted world is first shown, so that both turtles exist."""


@dataclass(frozen=True, slots=True)
class JoinDecision:
    """Result of the search for a session to join.

    Attributes:
        session: Joined session; None if the command must host a session.
        link: Connection through which other processes join; None if the hosted world is not shared.
        not_shared: Sentence on why the hosted world is not shared; empty if the world is shared.
    """

    session: Session | None = None
    link: "Link | None" = None
    not_shared: str = ""


def join_or_host(
    connection: Connection,
    word: str | None,
    *,
    needs_turtles: bool = False,
    cache_time: Duration | None = None,
    follows: bool = True,
) -> JoinDecision:
    """Join the running session, or return the connection through which to share a new session.

    Args:
        connection: Connection of the command.
        word: Name of a scenario to host; None to join the running session if there is one.
        needs_turtles: Whether to join only a session with a turtle simulator.
        cache_time: Cache time of a joined world's buffer, nanoseconds.
        follows: Whether a joined world has the time of `/clock` if another process publishes it.

    Raises:
        LinkError: If an option such as --join requires a session, but none runs, or no
            connection is possible.
        UsageError: If --join was given with a named scenario.
    """
    connection.refuse_to_join(word)
    link, alone = _open_link(connection)
    if link is None:
        return JoinDecision(not_shared=alone)
    there = link.graph.has_sources
    if word is None and connection.mode is not Mode.HOST:
        # With --connect, the user wants the world on the other machine, even if it starts later;
        # hosted turtles would mix with a robot's frames.
        if connection.only_observes or (there and (not needs_turtles or _has_host(link))):
            given = connection.providers
            session = joined_session(
                link,
                given.joined_clock() if follows else given.wall_clock(),
                connection.place,
                cache_time=cache_time,
                tell=tell_news,
            )
            notice(f"Joined {session.name}.")
            return JoinDecision(session)
        if link.unanswering and not there:
            # The silent process may be a host: a second world of equal names would mix with it.
            link.close()
            raise LinkError(
                f"{link.unanswering} Or start another session: --domain N starts a session in "
                "another domain, --host a session that no other command joins."
            )
        if connection.mode is Mode.JOIN or connection.read_only:
            link.close()
            what = "session with turtles" if there else "session"
            looks = (
                " 'tftool view' and 'tftool tree --watch' show the frames of the running session."
                if there
                else ""
            )
            raise LinkError(
                f"No {what} is running in domain {connection.domain}: start one with 'tftool "
                "demo', or leave out --join and --read-only, so that this command starts "
                f"one.{looks}"
            )
    elif alone := _why_not_shared(connection, link):
        link.close()
        notice(alone)
        return JoinDecision(not_shared=alone)
    return JoinDecision(link=link)


def _why_not_shared(connection: Connection, link: "Link") -> str:
    """Return a sentence on why a hosted world cannot be shared; "" if sharing is possible."""
    if _has_host(link):
        name = session_name(link, connection.place)
        return (
            f"A session is running here, {name}; this world is not shared (--domain N would start "
            "a separate session)."
        )
    return f"This world is not shared. {link.unanswering}" if link.unanswering else ""


def open_session(
    connection: Connection,
    word: str | None = None,
    *,
    simulated: bool = False,
    head_start: Duration = HEAD_START,
    cache_time: Duration | None = None,
    without: Callable[["NodeEntry"], bool] | None = None,
    needs_turtles: bool = False,
    because: str = NO_SESSION,
    by_hand: bool = False,
) -> Session:
    """Join the running session, or host a scenario; print a notice about a hosted scenario.

    Args:
        connection: Connection of the command.
        word: FROM as typed: the name of the scenario to host; None to join the running session, or
            to host the scenario `turtles` if there is no session.
        simulated: Whether a hosted world uses simulated time, from its beginning on.
        head_start: Nanoseconds of a scenario that are simulated before the wall clock starts.
        cache_time: Cache time of the world's buffer, in place of the scenario's.
        without: Function that decides whether a node of a hosted scenario is omitted.
        needs_turtles: Whether to join only a session with a turtle simulator.
        because: Reason to print if the scenario `turtles` is hosted for lack of a session.
        by_hand: Whether a person drives, in place of the scenario's script.

    Raises:
        InputError: If the word names no scenario, or the scenario cannot be read.
        LinkError: If an option such as --join requires a running session, but none runs.
        UsageError: If options such as --join are given with simulated time, which cannot be shared.
    """
    _refuse_files(word)
    refuse_options_of_files(connection.robot, connection.recording, word)
    link = None
    if simulated:
        connection.refuse_to_share(word)
    else:
        joined = join_or_host(connection, word, needs_turtles=needs_turtles, cache_time=cache_time)
        if joined.session is not None:
            return joined.session
        link = joined.link
    try:
        # Imported here, because a session that is joined needs no scenario.
        from tftool.scenario.play import build, left_to_a_person

        scenario = _scenario_to_host(word, without, because)
        if by_hand:
            scenario = left_to_a_person(scenario)
        if cache_time:
            scenario = replace(scenario, cache_time=cache_time)
        if simulated:
            return _hosted(build(scenario, SimClock()), 0, None)
        clock = connection.providers.wall_clock(head_start=head_start)
        return _hosted(build(scenario, clock), head_start, link)
    except BaseException:
        if link is not None:
            link.close()
        raise


def _scenario_to_host(
    word: str | None, without: Callable[["NodeEntry"], bool] | None, because: str
) -> "Scenario":
    """Return the scenario to host, without its expectations.

    Args:
        word: Name or file of the scenario; None for the default, whose name is then printed.
        without: Function that decides whether a node is omitted; None to keep all nodes.
        because: Reason to print if the default scenario is hosted.
    """
    scenario = scenario_named(word or HOME, expects=False)
    if without is not None:
        kept = tuple(node for node in scenario.nodes if not without(node))
        scenario = replace(scenario, nodes=kept)
    if word is None:
        notice(f"{because}: hosting scenario '{HOME}'.")
    return replace(scenario, expect=())


def _refuse_files(source: str | None) -> None:
    """Raise UsageError if `source` is a recording or description: only scenarios can be hosted."""
    found = None if source is None else named(source)
    if found is not None and found.kind is not Kind.SCENARIO:
        shown = visible(found.name)
        raise UsageError(
            f"'{shown}' is {found.kind.in_words}, which sends no messages: "
            f"'tftool tree {shown}' shows its frames."
        )


def join_session(
    connection: Connection, *, needs_turtles: bool = False, cache_time: Duration | None = None
) -> Session | None:
    """Join the running session; return None if no session runs and none was requested.

    Commands call this before they host a world on simulated time, which cannot be shared.

    Raises:
        LinkError: If a session was requested (`--join`) and none runs.
    """
    if connection.hosts_alone:
        return None
    joined = join_or_host(connection, None, needs_turtles=needs_turtles, cache_time=cache_time)
    if joined.link is not None:
        joined.link.close()
    return joined.session


def refuse_moment(connection: Connection) -> None:
    """Raise UsageError if a session runs that the command can join.

    Called when a past time is requested, because a session does not store the past.
    """
    link = None if connection.hosts_alone else _open_link(connection)[0]
    if link is None:
        return
    try:
        if link.graph.has_sources:
            running = session_name(link, connection.place)
            raise UsageError(
                f"A session is running, {running}, and a session does not store the past. Name a "
                f"scenario ('{HOME} --at 5') or a recording ('tftool record -o run.mcap', then "
                f"'run.mcap --at 5'); --host hosts '{HOME}' in any case."
            )
    finally:
        link.close()


def open_own_session(connection: Connection, *, simulated: bool, because: str) -> Session:
    """Join the running session, or host an empty world for a user's program.

    The world has the time of the machine: users' nodes with `use_sim_time` follow `/clock`.

    Args:
        connection: Connection of the command.
        simulated: Whether a hosted world uses simulated time.
        because: Reason to print if a world is hosted.

    Raises:
        LinkError: If an option such as --join requires a running session, but none runs.
        UsageError: If options such as --join are given with simulated time, which cannot be shared.
    """
    link = None
    if simulated:
        connection.refuse_to_share(None)
        world = World(SimClock())
    else:
        joined = join_or_host(connection, None, follows=False)
        if joined.session is not None:
            return joined.session
        link = joined.link
        world = World(connection.providers.wall_clock())
    notice(f"{because}: hosting a separate world.")
    alive = partial(live_shared, world, link, "source")
    return Session(world, True, "a world of its own", alive, link=link, tell=tell_news)


def open_empty_session(
    connection: Connection, *, simulated: bool = False, follows: bool = False
) -> Session:
    """Host an empty world, to which the command adds nodes and which other processes can join.

    Args:
        connection: Connection of the command.
        simulated: Whether the world uses simulated time, and is not shared.
        follows: Whether the world has the time of `/clock` if another process publishes it.
    """
    if simulated:
        world, link = World(SimClock()), None
    else:
        given = connection.providers
        world = World(given.joined_clock() if follows else given.wall_clock())
        link = _open_link(connection)[0]
    alive = partial(live_shared, world, link, "source")
    return Session(world, True, "an empty world", alive, link=link, tell=tell_news)


def tell_where_to_look(connection: Connection, session: Session) -> None:
    """Print a command that shows the new session in another terminal, if stderr is a terminal."""
    if session.link is None or not sys.stderr.isatty():
        return
    domain = f" --domain {connection.domain}" if connection.domain else ""
    notice(
        f"Show this session from another terminal: tftool demo --join{domain} · tftool view{domain}"
    )


def _hosted(play: "Play", head_start: Duration, link: "Link | None") -> Session:
    """Return a session that hosts a scenario, and that continues after the scenario's duration."""

    async def alive(until: Stamp | None) -> None:
        with shared(link, play.world):
            # A person may watch longer than the scenario's duration.
            await play.live(until, endless=until is None)

    name, duration = f"scenario '{visible(play.scenario.name)}'", play.scenario.duration
    return Session(play.world, True, name, alive, head_start, duration, link, tell_news)


def _open_link(connection: Connection) -> tuple["Link | None", str]:
    """Join the session of other processes.

    Returns:
        The connection and "", or None and the reason why no connection is possible.

    Raises:
        LinkError: If no connection is possible, but an option such as --join needs a connection.
    """
    try:
        return connection.open_link(), ""
    except LinkError as error:
        if connection.needs_link:
            raise
        alone = f"No other process can join this world: {visible(str(error))}."
        notice(alone)
        return None, alone


def _has_host(link: "Link") -> bool:
    """Return whether the session has a tftool process as host, or a turtle simulator of ROS."""
    # A host that has just started has no turtles yet, but will have some.
    return bool(hosts(link.graph.processes()) or link.graph.entities(SERVER, name="spawn"))
