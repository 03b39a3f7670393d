"""What FROM names, and join or host: the one place that decides where a command's frames come from.

FROM is a word that names a scenario (a built-in one, or a file), a recording (a file, a
folder, a glob) or a robot description; what a file is its content says. What is named is
always hosted. Without a word, the session that runs on this machine is joined; if none
runs, the command hosts one, and others join it. Processes that only look are no session:
they wait, and share what is hosted next. While one world is hosted another keeps to
itself, so that the two never mix.

A command uses it in one of two ways. To ask about one moment, with all that is known of
the frames by then (``tree``, ``explain``, ``doctor``)::

    def depth(
        connection: Connection,
        target: Annotated[str, typer.Argument(metavar="TARGET", help="...")],
        place: From = None,
        at: AtOption = None,
    ) -> ExitStatus:
        from tftool.cli.hosting import observe

        seen = observe(connection, place, at)
        seen.buffer.lookup_transform(target, "map", seen.moment)
        ...
        return ExitStatus.DONE

To work in a world while it lives (``echo``, ``monitor``, ``view``)::

        session = open_session(connection, place)
        session.run(work(session.world))

`From` and `AtOption` are in `cli.options`. A command that takes recordings only asks
`named(word).kind.is_recording`; one that plays scenarios only, `scenario_named(word)`.
"""

import asyncio
import sys
from collections.abc import Awaitable, Callable, Coroutine, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from tftool.cli.connection import Connection, Mode
from tftool.cli.described import RobotAtRest
from tftool.cli.notices import notice, tell_news
from tftool.cli.options import At
from tftool.cli.rivals import twins
from tftool.errors import InputError, LinkError, UsageError
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.runtime.clock import Clock, FollowedClock, Phase, SimClock, pace_of, run
from tftool.runtime.supervisor import beside, live
from tftool.runtime.world import World
from tftool.sources.find import Found, Kind, find, names_a_path
from tftool.stamps import CACHE_TIME, LATEST, Duration, Stamp, as_seconds, seconds
from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.frames.buffer import Buffer
    from tftool.frames.sample import Snapshot
    from tftool.link.session import Link
    from tftool.scenario.schema import NodeEntry, Scenario
    from tftool.sources.recording import Recording
    from tftool.sources.robot import Robot

T = TypeVar("T")

HOME = "turtles"
"""The scenario a command hosts when nothing runs and none was named."""

NO_SESSION = "No session is running here"
A_MOMENT = "A chosen moment is always simulated"
"""Why a world that was not named is hosted."""

HEAD_START = seconds(3)
"""How long a hosted world has lived when its command first looks: both turtles are there."""

LISTEN = seconds(5)
"""How long a scenario is played before it is observed, as view_frames listens."""

LISTEN_LIVE = seconds(2)
"""How long a session that runs is listened to: enough for a rate."""

TOLD = seconds(2)
"""How long a joined world waits for the first that `/clock` says, where it is published."""

STATICS = seconds(8)
"""How much longer for static transforms of publishers that are there: DDS repeats what was lost."""

AHEAD = seconds(1)
"""How long past the moment asked about a scenario is played, for what comes late."""


# What FROM names


def named(word: str) -> Found:
    """What a word on the command line names.

    A built-in scenario's name wins; `./turtles` and `turtles.yaml` are paths.

    Raises:
        InputError: If it names nothing, or nothing we read.
    """
    from tftool.scenario import builtin

    path = builtin.path_of(word)
    if path is not None:
        return Found(word, Kind.SCENARIO, (path,))
    if builtin.is_like_a_name(word) and not names_a_path(word):
        raise InputError(builtin.unknown(word))
    return find(word)


def scenario_named(word: str, arguments: Mapping[str, str] | None = None) -> "Scenario":
    """The scenario a word names, read.

    Args:
        word: A built-in scenario's name, or a file.
        arguments: Values for arguments it declares.

    Raises:
        InputError: If there is none, or it cannot be read.
        UsageError: If the word names something else, or an argument is not declared.
    """
    from tftool.scenario.load import load

    found = named(word)
    if found.kind is not Kind.SCENARIO:
        raise UsageError(f"'{visible(word)}' is {kind_in_words(found)}: a scenario is needed here.")
    return load(found.paths[0], arguments or {})


def kind_in_words(found: Found) -> str:
    """What FROM names, with its article."""
    if found.kind is Kind.SEVERAL:
        return "several recordings"
    article = "an" if found.kind is Kind.MCAP else "a"
    return f"{article} {found.kind.value}" + (" recording" if found.kind.is_recording else "")


class StoredFrames(Protocol):
    """Frames that are all there: those of a recording, or of a robot description."""

    @property
    def name(self) -> str:
        """What it is called: "run.mcap"."""

    @property
    def start(self) -> Stamp:
        """The moment from which `--at` counts."""

    @property
    def end(self) -> Stamp:
        """The last moment there is data of."""

    @property
    def buffer(self) -> "Buffer":
        """All of it."""

    def close(self) -> None:
        """Close its files."""


# A world a command works in


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
        from tftool.screens.beginning import first_moment

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
        return _checked(at, self.name, self.world.clock.epoch, self.duration)

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
        """Do nothing for so long, in nanoseconds; for ever if None."""
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
        """Listen for so long, and to robots over DDS until their static transforms have come."""
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
            from tftool.link.following import is_clock_shown

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
    from tftool.link.following import ClockFollower
    from tftool.link.graph import Role

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


# Join or host


@dataclass(frozen=True, slots=True)
class Company:
    """What a command finds when it looks for others to share a world with.

    Attributes:
        session: The session it has joined; None where it has to host.
        link: By which a host lets others in; None where it keeps to itself.
        alone: Why it does, as a sentence.
    """

    session: Session | None = None
    link: "Link | None" = None
    alone: str = ""


def look_around(
    connection: Connection,
    word: str | None,
    *,
    needs_turtles: bool = False,
    cache_time: Duration | None = None,
) -> Company:
    """Join what runs here, else become the one to host; no other process decides meanwhile.

    Args:
        connection: What the command's options say.
        word: What was named, which is hosted; None for the session that runs.
        needs_turtles: Whether only a session with a turtle simulator will do.
        cache_time: How far back the buffer of a joined world remembers.

    Raises:
        LinkError: If a session was asked for and there is none, or no link.
        UsageError: If --join was given: what is named is hosted.
    """
    _refuse_to_join(connection, word)
    link, alone = _open_link(connection)
    if link is None:
        return Company(alone=alone)
    there = link.graph.has_sources
    if word is None and connection.mode is not Mode.HOST:
        # --connect means what is at the other end, or comes there; turtles of our own have no
        # place among a robot's frames.
        if connection.looks or (there and (not needs_turtles or _has_host(link))):
            world = World(connection.providers.joined_clock(), cache_time=cache_time or CACHE_TIME)
            name = _name_of(connection, link)
            notice(f"Joined {name}.")
            return Company(Session(world, False, name, lived(world, link, "guest"), link=link))
        if link.unanswering and not there:
            # It may host: a second world of the same names would mix with it later.
            link.close()
            raise LinkError(
                f"{link.unanswering} Or leave it be: --domain N makes a session of its own, "
                "--host a world that keeps to itself."
            )
        if connection.mode is Mode.JOIN or connection.read_only:
            link.close()
            what = "session with turtles" if there else "session"
            raise LinkError(
                f"No {what} is running in domain {connection.domain}: start one with "
                "'tftool demo', or leave out the option to host one here."
            )
    elif link.unanswering and not _has_host(link):
        link.close()
        alone = f"This world keeps to itself. {link.unanswering}"
        notice(alone)
        return Company(alone=alone)
    elif _has_host(link):
        link.close()
        alone = (
            f"A session is running here, {_name_of(connection, link)}; this world keeps to itself "
            "(--domain N would give it a session of its own)."
        )
        notice(alone)
        return Company(alone=alone)
    return Company(link=link)


def open_session(
    connection: Connection,
    word: str | None = None,
    *,
    simulated: bool = False,
    head_start: Duration = HEAD_START,
    cache_time: Duration | None = None,
    without: Callable[["NodeEntry"], bool] | None = None,
    needs_turtles: bool = False,
    needs_messages: bool = False,
    plays: bool = False,
    because: str = NO_SESSION,
    by_hand: bool = False,
) -> Session:
    """Give the world a command works in, and say so on stderr when it had to be made.

    Args:
        connection: What the command's options say.
        word: What FROM names, which is hosted; None for the session that runs.
        simulated: Whether a hosted world lives on simulated time, from its beginning on.
        head_start: How much of a hosted scenario on the wall clock is lived through at once.
        cache_time: How far back the world's buffer remembers, in place of the scenario's own.
        without: Says which of a hosted scenario's nodes to leave out.
        needs_turtles: Whether only a session with a turtle simulator will do.
        needs_messages: Whether messages have to arrive: those of a recording have.
        plays: Whether those of a recording are to arrive again, as fast as can be simulated.
        because: Why a world that was not named is hosted, for people.
        by_hand: Whether a person drives in it, in place of the scenario's own script.

    Raises:
        InputError: If the word names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If sharing was asked for where time is simulated.
    """
    found = None if word is None else named(word)
    if found is not None and found.kind is not Kind.SCENARIO:
        if needs_messages and not plays:
            raise _without_messages(found)
        refuse_to_share(connection, word)
        if plays:
            return _played(connection, found, cache_time)
        return _recorded(connection, found, simulated=simulated)
    _refuse_options_of_files(connection, word)
    link = None
    if simulated:
        refuse_to_share(connection, word)
    else:
        company = look_around(connection, word, needs_turtles=needs_turtles, cache_time=cache_time)
        if company.session is not None:
            return company.session
        link = company.link
    try:
        scenario = scenario_named(word or HOME)
        if without is not None:
            kept = tuple(node for node in scenario.nodes if not without(node))
            scenario = replace(scenario, nodes=kept)
        if word is None:
            # For a program of the user's, nothing of the scenario moves.
            alone = [node.kind for node in scenario.nodes] == ["turtlesim"]
            hosted = "a turtlesim alone" if alone else f"scenario '{HOME}'"
            notice(f"{because}: hosting {hosted}.")
        if by_hand:
            scenario = left_to_a_person(scenario)
        # Nothing judges what happens in it.
        scenario = replace(scenario, expect=(), cache_time=cache_time or scenario.cache_time)
        if simulated:
            return _hosted(scenario, SimClock(), 0, None)
        clock = connection.providers.wall_clock(head_start=head_start)
        return _hosted(scenario, clock, head_start, link)
    except BaseException:
        if link is not None:
            link.close()
        raise


@dataclass(frozen=True, slots=True)
class Observed:
    """Frames up to a moment: no more of them come.

    Attributes:
        name: Where they are from, in sentences: "scenario 'turtles'".
        buffer: All that is known of them.
        epoch: The moment from which `--at` counts.
        now: The moment at which they are observed; ages are told against it.
        moment: The stamp that was asked for; 0, which means the latest, if none was.
        moving: Of a robot description, the frames whose joint moves; None for other frames.
    """

    name: str
    buffer: "Buffer"
    epoch: Stamp
    now: Stamp
    moment: Stamp = LATEST
    moving: frozenset[str] | None = None

    def snapshot(self) -> "Snapshot":
        """All frames as they were then, each at the latest moment of its chain."""
        return self.buffer.snapshot(self.now)

    def marks(self) -> dict[str, tuple[str, ...]]:
        """The frames that something is wrong with, and the ids of the doctor's checks."""
        if self.moving is not None:
            return {}  # a description at rest sends nothing
        from tftool.diagnostics.asking import marks

        return marks(self.buffer)


def observe(
    connection: Connection,
    word: str | None = None,
    at: At | None = None,
    *,
    whole: bool = False,
    cache_time: Duration | None = None,
) -> Observed:
    """Give what is known of the frames of FROM at a moment.

    A recording is read up to that moment, to its end when none is given; a scenario is played
    on simulated time, for `LISTEN` when none is given; a session that runs is listened to for
    `LISTEN_LIVE`. A moment is never one of a session that runs.

    Args:
        connection: What the command's options say.
        word: What FROM names; None for the session that runs, else the turtle world.
        at: The moment; None for the latest.
        whole: Whether to read on past the moment: to the end of a recording, for `AHEAD` in
            what is simulated. A lookup between two samples needs the second one.
        cache_time: How far back a simulated world's or session's buffer remembers.

    Raises:
        InputError: If the word names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If the moment lies before the beginning or after the end.
    """
    found = None if word is None else named(word)
    if found is not None and found.kind is not Kind.SCENARIO:
        refuse_to_share(connection, word)
        stored = connection.open_stored(found)
        name, start = f"{_kind_word(found)} '{visible(stored.name)}'", stored.start
        moment = LATEST if at is None else _checked(at, name, start, stored.end - start)
        buffer = stored.buffer if whole or not moment else _up_to(stored.buffer, moment)
        moving = stored.moving if isinstance(stored, RobotAtRest) else None
        return Observed(name, buffer, start, moment or stored.end, moment, moving)
    _refuse_options_of_files(connection, word)
    if word is None and at is None:
        joined = join_session(connection, cache_time=cache_time)
        if joined is not None:
            joined.run(joined.listened(LISTEN_LIVE))
            for sentence in twins(joined.world):
                notice(sentence)
            clock = joined.world.clock
            return Observed(joined.name, joined.world.buffer, clock.epoch, clock.now())
    session = open_session(
        connection,
        word,
        simulated=True,
        cache_time=cache_time,
        because=NO_SESSION if at is None else A_MOMENT,
    )
    end = session.moment(at or At(LISTEN))
    session.live_until(end + AHEAD if whole else end)
    world = session.world
    return Observed(
        session.name, world.buffer, world.clock.epoch, end, LATEST if at is None else end
    )


def join_session(
    connection: Connection, *, needs_turtles: bool = False, cache_time: Duration | None = None
) -> Session | None:
    """Give the world of the session that runs here; None where none does.

    For commands that host on simulated time: nothing is opened for others to join.

    Raises:
        LinkError: If a session was asked for and there is none.
    """
    if connection.mode is Mode.HOST or (
        not connection.needs_link and not _is_session_here(connection)
    ):
        return None
    company = look_around(connection, None, needs_turtles=needs_turtles, cache_time=cache_time)
    if company.link is not None:
        company.link.close()
    return company.session


def open_empty_session(connection: Connection, *, simulated: bool = False) -> Session:
    """Give a world with nothing in it to a command that brings its own nodes; others see it."""
    if simulated:
        world, link = World(SimClock()), None
    else:
        world, link = World(connection.providers.wall_clock()), _open_link(connection)[0]
    return Session(world, True, "an empty world", lived(world, link, "source"), link=link)


def tell_where_to_look(connection: Connection, session: Session) -> None:
    """Say, to a person, how another terminal shows what runs here from now on."""
    if session.link is None or not sys.stderr.isatty():
        return
    domain = f" --domain {connection.domain}" if connection.domain else ""
    notice(f"See it from another terminal: tftool demo --join{domain} · tftool view{domain}")


def refuse_to_share(connection: Connection, word: str | None) -> None:
    """Refuse the options of sharing for a world on simulated time."""
    _refuse_to_join(connection, word)
    if connection.needs_link:
        raise UsageError(
            f"'{visible(word or HOME)}' is played on simulated time here, which cannot be shared: "
            "leave out --join, --listen, --connect, --zenoh-config, --dds and --read-only."
        )


def _refuse_to_join(connection: Connection, word: str | None) -> None:
    if word is not None and connection.mode is Mode.JOIN:
        raise UsageError(f"'{visible(word)}' is always hosted: leave out --join, or the name.")


def _refuse_options_of_files(connection: Connection, word: str | None) -> None:
    what = "The session that runs" if word is None else f"'{visible(word)}'"
    connection.robot.refuse(f"{what} is no robot description and no recording")
    connection.recording.refuse(f"{what} is no recording")


def _checked(at: At, name: str, epoch: Stamp, duration: Duration | None) -> Stamp:
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


def _hosted(
    scenario: "Scenario", clock: Clock, head_start: Duration, link: "Link | None"
) -> Session:
    """Host a world to look at."""
    from tftool.scenario.play import build

    play = build(scenario, clock)

    async def alive(until: Stamp | None) -> None:
        with shared(link, play.world):
            # People look for as long as they like, whatever the scenario's duration.
            await play.live(until, endless=until is None)

    name = f"scenario '{visible(scenario.name)}'"
    return Session(play.world, True, name, alive, head_start, scenario.duration, link)


def _recorded(connection: Connection, found: Found, *, simulated: bool) -> Session:
    """A world in which all of a recording is known, at its end; its clock began with it."""
    stored = connection.open_stored(found)
    lasting = stored.end - stored.start
    # Where nothing was recorded both are 0, at which no clock can begin.
    start = max(stored.start, 1)
    clock: Clock = (
        SimClock(start) if simulated else connection.providers.still_clock(start, start + lasting)
    )
    world = World(clock, stored.buffer)

    async def alive(until: Stamp | None) -> None:
        if until is None:
            await asyncio.get_running_loop().create_future()
        else:
            await clock.sleep_until(until, Phase.END)

    name = f"{_kind_word(found)} '{visible(stored.name)}'"
    robot = getattr(stored, "robot", None)
    return Session(
        world,
        True,
        name,
        alive,
        lasting,
        lasting,
        is_recorded=True,
        robot=robot,
        recording=recording_of(stored) if found.kind.is_recording else None,
    )


def recording_of(stored: StoredFrames) -> "Recording | None":
    """The recording that stored frames are; None where they are others."""
    from tftool.sources.recording import Recording

    return stored if isinstance(stored, Recording) else None


def _played(connection: Connection, found: Found, cache_time: Duration | None) -> Session:
    """A world in which a recording's messages arrive, as fast as they can be simulated.

    Raises:
        UsageError: If it is no recording.
    """
    from tftool.nodes.player import Player
    from tftool.sources.recording import Recording
    from tftool.sources.timeline import Timeline

    recording = connection.open_stored(found) if found.kind.is_recording else None
    if not isinstance(recording, Recording):
        raise _without_messages(found)
    timeline = Timeline(recording.source, recording.transforms)
    clock = SimClock(max(timeline.start, 1))
    world = World(clock, cache_time=cache_time or CACHE_TIME)
    Player(world, "player", timeline=timeline, pace=clock, is_silent=True)

    async def alive(until: Stamp | None) -> None:
        await live(world, until=until)

    name = f"recording '{visible(recording.name)}'"
    lasting = timeline.end - timeline.start
    return Session(world, True, name, alive, 0, lasting, is_played=True)


def _without_messages(found: Found) -> UsageError:
    return UsageError(
        f"'{visible(found.name)}' is {kind_in_words(found)}, from which no message "
        f"arrives: 'tftool tree {visible(found.name)}' shows its frames."
    )


def _kind_word(found: Found) -> str:
    return "recording" if found.kind.is_recording else found.kind.value


def _up_to(whole: "Buffer", moment: Stamp) -> "Buffer":
    """What of a buffer is stamped up to a moment; what holds at all times stays."""
    import numpy as np

    from tftool.frames.buffer import Buffer

    frames = whole.frames()
    found = Buffer(whole.cache_time, max_frames=max(1, len(frames)))
    for frame in frames:
        # A recording of gigabytes need not be copied for one moment.
        if whole.lend(frame, found, moment):
            continue
        samples = whole.samples(frame)
        count = (
            len(samples)
            if samples.is_static
            else int(np.searchsorted(samples.stamps, moment, "right"))
        )
        links = list(zip(samples.parents[:count], samples.authorities[:count], strict=True))
        # A run of samples of one parent and sender goes in at once.
        starts = [row for row in range(count) if row == 0 or links[row] != links[row - 1]]
        for first, last in pairwise([*starts, count]):
            parent, authority = links[first]
            run = slice(first, last)
            if samples.is_static:
                row = samples.poses[first].tolist()
                pose = Transform(row[:3], row[3:])
                found.set_transform_static(TransformStamped(0, parent, frame, pose), authority)
            else:
                found.set_transforms(
                    parent,
                    frame,
                    samples.stamps[run],
                    samples.translations[run],
                    samples.rotations[run],
                    authority,
                )
    return found


def _open_link(connection: Connection) -> tuple["Link | None", str]:
    """Open the link; a place that has none can still host, and says why it is alone.

    Raises:
        LinkError: If something was asked for that only a link can give.
    """
    try:
        return connection.open_link(), ""
    except LinkError as error:
        if connection.needs_link:
            raise
        alone = f"No other process can join this world: {visible(str(error))}."
        notice(alone)
        return None, alone


def _is_session_here(connection: Connection) -> bool:
    """Whether some process of this machine waits to be joined, without opening anything."""
    from tftool.link.zenoh.rendezvous import has_members

    return has_members(connection.domain)


def _has_host(link: "Link") -> bool:
    """Whether a world runs here: one of ours, or turtles of a launch file or of ROS."""
    from tftool.link.graph import SERVER, hosts

    # A host that has only just begun has no turtles yet, and will have some.
    return bool(hosts(link.graph.processes()) or link.graph.entities(SERVER, name="spawn"))


def _name_of(connection: Connection, link: "Link") -> str:
    from tftool.link.graph import NODE, Role, hosts

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
        return f"'{visible(others[0])}' at {visible(connection.place)}"
    return f"what is at {visible(connection.place)}, where nothing has answered yet"


def left_to_a_person(scenario: "Scenario") -> "Scenario":
    """The scenario without what a person at the keys does better, and without a judge."""
    from tftool.scenario.actions import Drive, Press

    script = tuple(step for step in scenario.script if not isinstance(step.action, Drive | Press))
    return replace(scenario, script=script, expect=())
