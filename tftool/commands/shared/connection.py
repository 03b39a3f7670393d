"""A command's connection: whether it joins or hosts, and which machines it reaches.

Every command that may share a session has a `Connection` as its first parameter; its declaration
makes it (`declaration.py`), and closes everything it opened. `open_from` opens FROM with its
options, with a progress bar and notes on stderr.
"""

import math
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum, auto
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypedDict

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, as_seconds
from tftool.commands.shared.declaration import CommandKind, Invocation
from tftool.commands.shared.notices import notice
from tftool.frames.frames import Frames
from tftool.frames.source_options import At, DescriptionOptions, RecordingOptions
from tftool.opener import (
    LISTEN_FOR,
    named,
    open_frames,
    refuse_beside_address,
    refuse_options_of_files,
)
from tftool.recordings.find import Kind
from tftool.world.link.link_options import REACHES, Options, domain_here, reach_at, read_reach
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from typer import Context

    from tftool.base.stamps import Stamp
    from tftool.commands.shared.progress_bars import Bar, ListeningBar, Look
    from tftool.world.clock import Clock
    from tftool.world.link.session import Link
    from tftool.world.world import World


HOME = "turtles"
"""The scenario that stands in for the session, where none runs and none was named."""


class Mode(Enum):
    """A command's role in the running session."""

    AUTO = auto()
    JOIN = auto()
    HOST = auto()


class Providers:
    """Sources of a command's clock and of its links to other processes; tests replace them.

    Tests derive from it, and pass their own to `app.main`.
    """

    def wall_clock(self, rate: float = 1.0, *, head_start: Duration = 0) -> "Clock":
        """Make a clock for a world that others may share; see `WallClock`."""
        from tftool.world.clock import WallClock

        return WallClock(rate, head_start=head_start)

    def still_clock(self, epoch: "Stamp", now: "Stamp") -> "Clock":
        """Make a clock that stands still at the end of a complete source.

        Args:
            epoch: Time at which the clock began.
            now: Time at which the clock stays.
        """
        from tftool.world.clock import FollowedClock

        return FollowedClock(now, epoch=epoch)

    def joined_clock(self) -> "Clock":
        """Make a clock for a world that joins a session: real time, or the time of `/clock`."""
        from tftool.world.clock import FollowedClock

        return FollowedClock()

    def link(self, options: "Options") -> "Link | None":
        """Open a link; None if no world is shared.

        Raises:
            LinkError: If the link cannot be opened.
        """
        from tftool.world.link.session import Link

        return Link(options)


class FileOptions(TypedDict):
    """Options for reading files, as `open_frames` takes them."""

    joints: Mapping[str, float]
    arguments: Mapping[str, str]
    urdf: Path | None
    with_odometry: bool
    no_cache: bool
    tf_topics: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Connection:
    """A command's part in a session, according to its options.

    Use it in a `with`, whose end closes every link and file that it opened.

    Attributes:
        command: The command's name.
        kind: What kind of command it is.
        mode: Join, host, or whichever fits.
        domain: Number of the ROS domain.
        reach: Middleware, and reach beyond this machine's own processes.
        read_only: Whether to look only.
        robot: Joint positions, xacro arguments, a description for a recording.
        recording: Options for reading a recording.
        providers: Sources of its clocks and links.
        context: typer's context of the command line.
    """

    command: str = "tftool"
    kind: CommandKind = field(default_factory=CommandKind)
    mode: Mode = Mode.AUTO
    domain: int = 0
    reach: Reach = field(default_factory=REACHES[0])
    read_only: bool = False
    robot: DescriptionOptions = field(default_factory=DescriptionOptions)
    recording: RecordingOptions = field(default_factory=RecordingOptions)
    providers: Providers = field(default_factory=Providers, compare=False, repr=False)
    context: "Context | None" = field(default=None, compare=False, repr=False)
    _opened: "list[Link | Frames]" = field(default_factory=list, compare=False, repr=False)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        while self._opened:
            self._opened.pop().close()

    @property
    def needs_link(self) -> bool:
        """Whether an option requires a link."""
        return self.mode is Mode.JOIN or self.read_only or self.reach.is_asked

    @property
    def looks(self) -> bool:
        """Whether the command only observes, so that its own world stays invisible to others."""
        return self.reach.awaits_others(hosts=self.kind.hosts_turtles)

    @property
    def place(self) -> str:
        """Describe where the session's other processes are; empty for this machine."""
        return self.reach.place(self.domain)

    def options(self) -> Options:
        """Return the options in the link's form."""
        # Among a robot's nodes, what only looks has nothing to write.
        read_only = self.read_only or (self.reach.is_robots and self.kind.looks_only)
        return Options(self.command, self.domain, self.reach, read_only)

    def open_link(self) -> "Link | None":
        """Open a link; it is closed together with this connection.

        Raises:
            LinkError: If the link cannot be opened.
        """
        link = self.providers.link(self.options())
        if link is not None:
            self.keep(link)
            for sentence in link.middleware.notices:
                notice(sentence)
        return link

    @property
    def file_options(self) -> "FileOptions":
        """Return the options for reading files, as `open_frames` takes them."""
        return {
            "joints": self.robot.joints,
            "arguments": self.robot.arguments,
            "urdf": self.robot.urdf,
            "with_odometry": self.recording.with_odometry,
            "no_cache": self.recording.no_cache,
            "tf_topics": self.recording.tf_topics,
        }

    @property
    def hosts_alone(self) -> bool:
        """Whether there is no session to join, checked without opening a link."""
        if self.mode is Mode.HOST:
            return True
        if self.needs_link:
            return False
        return not REACHES[0].has_members(self.domain)

    def keep(self, opened: "Link | Frames") -> None:
        """Register something to be closed together with this connection."""
        self._opened.append(opened)

    def refuse_to_share(self, word: str | None) -> None:
        """Refuse the options of sharing for files and for scenarios on simulated time.

        Raises:
            UsageError: If one was given.
        """
        if word is None and self.reach.only_reads:
            raise UsageError(
                f"{self.place} is a running session, which keeps no past: leave out the "
                "moment, or record it first ('tftool record')."
            )
        self.refuse_to_join(word)
        if self.needs_link:
            flags = ", ".join(flag for reach in REACHES for flag in reach.FLAGS)
            raise UsageError(
                f"'{visible(word or HOME)}' is played on simulated time here, which cannot be "
                f"shared: leave out --join, {flags} and --read-only."
            )

    def refuse_to_join(self, word: str | None) -> None:
        """Refuse --join, and a robot's address, beside a named world, which is always hosted.

        Raises:
            UsageError: If one was given.
        """
        if word is not None and self.reach.only_reads:
            raise UsageError(
                f"'{visible(word)}' and {self.place} are two sources: name one at a time."
            )
        if word is not None and self.mode is Mode.JOIN:
            raise UsageError(
                f"'{visible(word)}' is always hosted: leave out --join, or the name of the "
                "scenario."
            )

    def refuse_read_only(self, purpose: str) -> None:
        """Refuse --read-only for a command whose whole purpose is to publish.

        Raises:
            UsageError: If --read-only was given.
        """
        if self.read_only:
            raise UsageError(
                f"--read-only publishes nothing, and to {purpose} is all {self.command} does."
            )

    def tell_read_only(self) -> None:
        """Explain what --read-only means for nodes that are run."""
        if self.read_only:
            notice(
                "--read-only: other processes get nothing that nodes here publish, broadcast "
                "or serve."
            )


def read(
    command: str,
    kind: CommandKind,
    context: "Context | None" = None,
    *,
    join: bool = False,
    host: bool = False,
    domain: int | None = None,
    read_only: bool = False,
    joint: list[str] | None = None,
    argument: list[str] | None = None,
    urdf: Path | None = None,
    with_odometry: bool = False,
    no_cache: bool = False,
    tf_topic: list[str] | None = None,
    address: str | None = None,
    **reach: Any,
) -> Connection:
    """Build the connection; `reach` has the middlewares' options, FROM may be an `address`.

    Raises:
        UsageError: If options contradict each other.
        InputError: If a file is missing, or not of the stated kind.
    """
    if join and host:
        raise UsageError("--join and --host contradict each other: choose one.")
    if host and read_only:
        raise UsageError("--read-only publishes nothing, so it cannot --host a session.")
    far = None
    if address is not None:
        far = reach_at(address)
        refuse_beside_address(address, domain, {**reach, "host": host})
    invocation: Invocation | None = None if context is None else context.obj
    return Connection(
        command,
        kind,
        Mode.JOIN if join else Mode.HOST if host else Mode.AUTO,
        domain_here() if domain is None else domain,
        far or read_reach(reach),
        read_only,
        DescriptionOptions(
            dict(_joint(word) for word in joint or ()),
            dict(_argument(word) for word in argument or ()),
            urdf,
        ),
        RecordingOptions(no_cache, with_odometry, tuple(tf_topic or ())),
        (invocation and invocation.providers) or Providers(),
        context,
    )


def _joint(word: str) -> tuple[str, float]:
    name, equals, text = word.rpartition("=")
    factor = math.radians(1.0) if text.endswith("deg") else 1.0
    try:
        position = float(text.removesuffix("deg")) * factor
    except ValueError:
        position = math.nan
    if not name or not equals or not math.isfinite(position):
        raise UsageError(
            f"'--joint {word}' sets no joint: write NAME=VALUE, such as "
            "--joint elbow=0.5 or --joint elbow=30deg."
        )
    return name, position


def _argument(word: str) -> tuple[str, str]:
    name, assigned, value = word.partition(":=")
    if not name or not assigned:
        raise UsageError(f"'{word}' is no xacro argument: write NAME:=VALUE.")
    return name, value


NO_SESSION = "No session is running here"
A_MOMENT = "A chosen moment is always simulated"
"""Why a scenario that was not named is played."""

WHOLE = math.inf
"""All of a scenario."""

_MOST_NOTES = 8
_LONGEST_NAME = 24


def open_from(
    connection: Connection,
    place: str | None,
    lasting: Duration | None = None,
    *,
    until: At | float | None = None,
    margin: float = 1.0,
    cache_time: Duration | None = None,
    tells: bool = True,
    shares: bool = False,
    watch: "Callable[[World], object] | None" = None,
    look: "Look | None" = None,
) -> Frames:
    """Open the frames of FROM; they are closed together with the connection.

    Without FROM the running session is heard; if there is none, the turtle world is played. A
    running session keeps no past: a moment is refused.

    Args:
        connection: The command's options.
        place: FROM; None for the session that runs.
        lasting: Value of --for: how long to listen or to play.
        until: Time up to which a scenario is played, without --for; see `open_frames`.
        margin: Seconds to play on after that.
        cache_time: Cache time of the buffer of a scenario or a session.
        tells: Whether to print oddities of the frames.
        shares: Whether the options of sharing are for another of several sources.
        watch: Called with the world of a scenario or a session before it lives.
        look: Returns lines to show below the progress bar about a session's frames so far.

    Raises:
        InputError: If FROM names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If options do not fit the kind of FROM.
    """
    if lasting is not None:
        until, margin = as_seconds(lasting), 0.0
    if place is None and not isinstance(until, At):
        frames = listen_from(connection, lasting, cache_time=cache_time, watch=watch, look=look)
        if frames is not None:
            return frames
    if place is None and isinstance(until, At) and not connection.reach.only_reads:
        from tftool.commands.shared.hosting import refuse_moment

        refuse_moment(connection)
    if not shares:
        if lasting is not None and place is not None and named(place).kind is not Kind.SCENARIO:
            raise UsageError("--for is for live sources: for a recording use --to.")
        connection.refuse_to_share(place)
    if place is None:
        refuse_options_of_files(connection.robot, connection.recording, None)
        because = A_MOMENT if isinstance(until, At) else NO_SESSION
        notice(f"{because}: hosting scenario '{HOME}'.")
        place = HOME
    with _bar(place) as bar:
        frames = open_frames(
            place,
            **connection.file_options,
            until=until,
            margin=margin,
            cache_time=cache_time,
            watch=watch,
            progress=bar,
        )
    connection.keep(frames)
    _tell(frames, notes=tells)
    return frames


def listen_from(
    connection: Connection,
    lasting: Duration | None = None,
    *,
    cache_time: Duration | None = None,
    watch: "Callable[[World], object] | None" = None,
    look: "Look | None" = None,
) -> Frames | None:
    """Listen to the running session; return None if there is none. See `open_from`.

    Raises:
        LinkError: If a session was asked for and there is none.
    """
    if connection.hosts_alone:
        return None
    from tftool.commands.shared.hosting import join_session

    session = join_session(connection, cache_time=cache_time)
    if session is None:
        return None
    listen_for = LISTEN_FOR if lasting is None else as_seconds(lasting)
    with _listening_bar(listen_for, look) as glance:
        return open_frames(
            **connection.file_options,
            listen_for=listen_for,
            cache_time=cache_time,
            session=session,
            watch=watch,
            glance=glance,
        )


@contextmanager
def _listening_bar(listen_for: float, look: "Look | None") -> "Iterator[ListeningBar | None]":
    """Return a progress bar if a person waits, and print how long it takes if none does."""
    if not sys.stderr.isatty():
        notice(f"Listening for {listen_for:g} s ...")
        yield None
        return
    from tftool.commands.shared.progress_bars import ListeningBar

    with ListeningBar(listen_for, look) as bar:
        yield bar


@contextmanager
def _bar(place: str) -> "Iterator[Bar | None]":
    """Return a progress bar if a person waits."""
    if not sys.stderr.isatty():
        yield None
        return
    from tftool.commands.shared.progress_bars import Bar

    # The end of a path is what tells files apart, and all of it would not fit beside the bar.
    short = place.rstrip("/").rpartition("/")[2][-_LONGEST_NAME:]
    bar = Bar(f"Reading {visible(short)}")
    try:
        yield bar
    finally:
        bar.stop()


def _tell(frames: Frames, *, notes: bool) -> None:
    """Print the skipped files and notes about the frames."""
    for text in () if frames.found is None else frames.found.told():
        notice(visible(text))
    if notes:
        _tell_notes(frames)


def _tell_notes(frames: Frames) -> None:
    notes = frames.notes
    most = _MOST_NOTES if frames.recording is not None else len(notes)
    for text in notes[:most]:
        notice(visible(text))
    if len(notes) > most:
        notice(f"... and {len(notes) - most} more: 'tftool info {visible(frames.name)}'.")
