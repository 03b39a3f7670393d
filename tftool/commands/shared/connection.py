"""Connection of a command to a session: joined or hosted, on this machine or on others.

Every command that may share a session has a `Connection` as its first parameter. `declaration.py`
creates the connection, and at the end closes every file and session that the connection has opened.
`open_from` opens FROM (the source of the frames) with the command's options, and shows a progress
bar and notes on stderr.
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
"""Name of the scenario that is used if no session runs and no source was named."""


class Mode(Enum):
    """Choice between joining the running session and hosting a new one; AUTO prefers to join."""

    AUTO = auto()
    JOIN = auto()
    HOST = auto()


class Providers:
    """Functions that create a command's clock and connections to other processes.

    Tests replace these functions by passing an object of a derived class to `app.main`.
    """

    def wall_clock(self, rate: float = 1.0, *, head_start: Duration = 0) -> "Clock":
        """Create a clock for a world that other processes may share; see `WallClock`."""
        from tftool.world.clock import WallClock

        return WallClock(rate, head_start=head_start)

    def still_clock(self, epoch: "Stamp", now: "Stamp") -> "Clock":
        """Create a clock that always shows the end of a recording or other complete source.

        Args:
            epoch: Time at which the source begins.
            now: Time that the clock shows.
        """
        from tftool.world.clock import FollowedClock

        return FollowedClock(now, epoch=epoch)

    def joined_clock(self) -> "Clock":
        """Create a clock for a world that joins a session: real time, or the time of `/clock`."""
        from tftool.world.clock import FollowedClock

        return FollowedClock()

    def link(self, options: "Options") -> "Link | None":
        """Connect to the other processes of a session; return None for no connection.

        Raises:
            LinkError: If the link cannot be opened.
        """
        from tftool.world.link.session import Link

        return Link(options)


class FileOptions(TypedDict):
    """Options for reading files, as parameters of `open_frames`."""

    joints: Mapping[str, float]
    arguments: Mapping[str, str]
    urdf: Path | None
    with_odometry: bool
    no_cache: bool
    tf_topics: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Connection:
    """Connection of a command to a session, according to the command's options.

    Use a `Connection` in a `with` block, whose end closes every opened session and file.

    Attributes:
        command: Name of the command.
        kind: Kind of the command, which decides its options.
        mode: Whether to join a session, to host one, or to do whichever is possible.
        domain: Number of the ROS domain.
        reach: Middleware, and its options for reaching other machines.
        read_only: Whether --read-only was given: nothing is published.
        robot: Joint positions, xacro arguments, and a description for a recording.
        recording: Options for reading a recording.
        providers: Functions that create clocks and connections to other processes.
        context: Context of the command line in typer.
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
        """Whether an option, such as --join, requires a connection to other processes."""
        return self.mode is Mode.JOIN or self.read_only or self.reach.is_asked

    @property
    def only_observes(self) -> bool:
        """Whether the command only observes; the world of such a command is not shared."""
        return self.reach.awaits_others(hosts=self.kind.hosts_turtles)

    @property
    def place(self) -> str:
        """Description of where the other processes of the session are; empty for this machine."""
        return self.reach.place(self.domain)

    def options(self) -> Options:
        """Return the session options that this process uses to join a session."""
        # Among a robot's nodes, a command that only observes must not publish.
        read_only = self.read_only or (self.reach.is_robots and self.kind.looks_only)
        return Options(self.command, self.domain, self.reach, read_only)

    def open_link(self) -> "Link | None":
        """Connect to the other processes of a session until this `Connection` is closed.

        Return None if `Providers.link` returns None.

        Raises:
            LinkError: If no connection is possible.
        """
        link = self.providers.link(self.options())
        if link is not None:
            self.keep(link)
            for sentence in link.middleware.notices:
                notice(sentence)
        return link

    @property
    def file_options(self) -> "FileOptions":
        """Options for reading files, as parameters of `open_frames`."""
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
        """Whether the command joins no session; decided without connecting to any process."""
        if self.mode is Mode.HOST:
            return True
        if self.needs_link:
            return False
        return not REACHES[0].has_members(self.domain)

    def keep(self, opened: "Link | Frames") -> None:
        """Register a session or opened frames to be closed together with this `Connection`."""
        self._opened.append(opened)

    def refuse_to_share(self, source: str | None) -> None:
        """Raise UsageError for options such as --join if `source` is not a running session.

        Files, and scenarios on simulated time, cannot be shared with other processes.
        """
        if source is None and self.reach.only_reads:
            raise UsageError(
                f"{self.place} is a running session, which does not store the past: leave out the "
                "time, or record the session first ('tftool record')."
            )
        self.refuse_to_join(source)
        if self.needs_link:
            flags = ", ".join(flag for reach in REACHES for flag in reach.FLAGS)
            raise UsageError(
                f"'{visible(source or HOME)}' is played on simulated time, which other "
                f"processes cannot share: leave out --join, {flags} and --read-only."
            )

    def refuse_to_join(self, source: str | None) -> None:
        """Raise UsageError for --join or a robot's address if `source` is a scenario to host."""
        if source is not None and self.reach.only_reads:
            raise UsageError(
                f"'{visible(source)}' and {self.place} are two sources: leave one out."
            )
        if source is not None and self.mode is Mode.JOIN:
            raise UsageError(
                f"'{visible(source)}' is a scenario, which cannot be joined: leave out --join, or "
                "leave out the scenario to join the running session."
            )

    def refuse_read_only(self, purpose: str) -> None:
        """Raise UsageError if --read-only was given; `purpose` is a verb such as "drive"."""
        if self.read_only:
            raise UsageError(
                f"--read-only publishes nothing, but the only purpose of {self.command} is to "
                f"{purpose}: leave out --read-only."
            )

    def tell_read_only(self) -> None:
        """Print a notice on how --read-only affects the nodes that the command runs."""
        if self.read_only:
            notice(
                "--read-only: other processes receive no messages and no answers from the nodes "
                "here."
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
    """Create a connection from the values of a command's options.

    `reach` has the options of the middlewares; `address` is FROM, if FROM is a session's address.

    Raises:
        UsageError: If options contradict each other.
        InputError: If a file that an option names is missing, or of the wrong kind.
    """
    if join and host:
        raise UsageError("--join and --host contradict each other: choose one.")
    if host and read_only:
        raise UsageError(
            "--read-only publishes nothing, but a session with --host must publish: leave one out."
        )
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
            dict(map(_joint, joint or ())),
            dict(map(_argument, argument or ())),
            urdf,
        ),
        RecordingOptions(no_cache, with_odometry, tuple(tf_topic or ())),
        (invocation and invocation.providers) or Providers(),
        context,
    )


def _joint(word: str) -> tuple[str, float]:
    from tftool.robots.description import JointPosition

    name, equals, text = word.rpartition("=")
    try:
        position = float(text.removesuffix("deg"))
        if text.endswith("deg"):
            position = JointPosition(math.radians(position), "rad")
    except ValueError:
        position = math.nan
    if not name or not equals or not math.isfinite(position):
        raise UsageError(
            f"'--joint {word}' is not the position of a joint: write NAME=VALUE, such as --joint "
            "elbow=0.5 or --joint elbow=30deg."
        )
    return name, position


def _argument(word: str) -> tuple[str, str]:
    name, assigned, value = word.partition(":=")
    if not name or not assigned:
        raise UsageError(f"'{word}' is not a xacro argument: write NAME:=VALUE.")
    return name, value


NO_SESSION = "No session is running here"
A_MOMENT = "A requested time is always simulated"
"""Reason, as printed, for playing a scenario that the user did not name."""

WHOLE = math.inf
"""Value of `until` for all of a scenario."""

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
    """Open the frames of FROM, which are closed together with the connection.

    Without FROM, the command listens to the running session, or plays the scenario turtles if no
    session runs. A running session does not store the past, so that --at is not possible.

    Args:
        connection: Connection of the command.
        place: FROM; None for the running session.
        lasting: Value of --for: nanoseconds to listen or to play.
        until: Time up to which a scenario is played, without --for; see `open_frames`.
        margin: Further seconds to play after `until`.
        cache_time: Cache time of a scenario's or session's buffer.
        tells: Whether to print notes about unusual facts of the frames.
        shares: Whether to accept options such as --join although FROM is a file, because another
            source of the same command may be a session.
        watch: Function called with the world of a scenario or session before it runs.
        look: Function that returns lines about a session's frames, shown below the progress bar.

    Raises:
        InputError: If FROM names no source, or the source cannot be read.
        LinkError: If an option such as --join requires a session, but none runs.
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
            raise UsageError(
                "--for is only allowed for a running session: for a recording, use --to."
            )
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
    """Listen to the running session, as `open_from` does; return None if no session runs.

    Raises:
        LinkError: If an option such as --join requires a session, but none runs.
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
    """Yield a progress bar on a terminal; else print how long the command listens, yield None."""
    if not sys.stderr.isatty():
        notice(f"Listening for {listen_for:g} s ...")
        yield None
        return
    from tftool.commands.shared.progress_bars import ListeningBar

    with ListeningBar(listen_for, look) as bar:
        yield bar


@contextmanager
def _bar(source: str) -> "Iterator[Bar | None]":
    """Yield a progress bar for reading a file; yield None without a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    from tftool.commands.shared.progress_bars import Bar

    # The end of a path distinguishes files; the whole path would not fit beside the bar.
    short = source.rstrip("/").rpartition("/")[2][-_LONGEST_NAME:]
    bar = Bar(f"Reading {visible(short)}")
    try:
        yield bar
    finally:
        bar.stop()


def _tell(frames: Frames, *, notes: bool) -> None:
    """Print which files were skipped; with `notes`, also print notes about the frames."""
    for text in () if frames.found is None else frames.found.notices():
        notice(visible(text))
    told = frames.notes if notes else ()
    most = _MOST_NOTES if frames.recording is not None else len(told)
    for text in told[:most]:
        notice(visible(text))
    if len(told) > most:
        notice(f"... and {len(told) - most} more: 'tftool info {visible(frames.name)}'.")
