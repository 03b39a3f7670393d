"""The connection of a command: whether it joins or hosts, and how far it reaches.

Every command that may share a session takes a `Connection` as its first parameter;
`with_connection` in `connection_options` gives it one, and closes what it opened.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, auto
from pathlib import Path
from typing import TYPE_CHECKING, Self, TypedDict

from tftool.base.errors import InputError, UsageError
from tftool.base.escaping import visible
from tftool.commands.shared.notices import notice
from tftool.frames.source_options import RecordingOptions, RobotOptions
from tftool.world.link.link_options import domain_here

if TYPE_CHECKING:
    from tftool.base.stamps import Duration, Stamp
    from tftool.frames.frames import Frames
    from tftool.world.clock import Clock
    from tftool.world.link.link_options import Options
    from tftool.world.link.session import Link


HOME = "turtles"
"""The scenario that stands in for the session, where none runs and none was named."""

LOOKING = frozenset(
    ["doctor", "echo", "explain", "export", "monitor", "plot", "record", "session", "tree", "view"]
)
"""Commands that over DDS write to no topic."""

HOSTING = frozenset(["demo", "teleop"])
"""Commands that host turtles over DDS too, where none are there; others wait for a robot."""


class Mode(Enum):
    """What a command was told to do about the session that may run here."""

    AUTO = auto()
    JOIN = auto()
    HOST = auto()


class Providers:
    """What gives commands their real time and their links to other processes.

    A test derives from it, and hands its own to `app.main`.
    """

    def wall_clock(self, rate: float = 1.0, *, head_start: "Duration" = 0) -> "Clock":
        """Make a clock for a world that others may share; see `WallClock`."""
        from tftool.world.clock import WallClock

        return WallClock(rate, head_start=head_start)

    def still_clock(self, epoch: "Stamp", now: "Stamp") -> "Clock":
        """Make a clock that stands still at the end of something that is all there.

        Args:
            epoch: When it began.
            now: Its end.
        """
        from tftool.world.clock import FollowedClock

        return FollowedClock(now, epoch=epoch)

    def joined_clock(self) -> "Clock":
        """Make a clock for a world that joins a session: real time, or what `/clock` says."""
        from tftool.world.clock import FollowedClock

        return FollowedClock()

    def link(self, options: "Options") -> "Link | None":
        """Open a link; None where every world keeps to itself.

        Raises:
            LinkError: If it cannot be opened.
        """
        from tftool.world.link.session import Link

        return Link(options)


class FileOptions(TypedDict):
    """How files are read, as `open_frames` takes it."""

    joints: Mapping[str, float]
    arguments: Mapping[str, str]
    urdf: Path | None
    with_odometry: bool
    no_cache: bool


@dataclass(frozen=True, slots=True)
class Connection:
    """How a command takes part in a session, as its options say.

    Use it in a `with`: at its end every link and file it opened is closed.

    Attributes:
        command: The command's name.
        mode: Join, host, or what fits.
        domain: Number of the ROS domain.
        listen: Endpoints to open for other machines.
        connect: Endpoints to go to.
        tls: Certificate, key and authority, where given.
        config: A zenoh configuration to take as it is.
        read_only: Whether to look only.
        dds: Where DDS goes, in place of zenoh: interfaces and addresses beyond the loopback,
            none for the loopback alone; None for zenoh.
        robot: Joint positions, xacro arguments, a description for a recording.
        recording: How a recording is read.
        providers: Where its clocks and links come from.
    """

    command: str = "tftool"
    mode: Mode = Mode.AUTO
    domain: int = 0
    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    tls: tuple[Path, Path, Path] | None = None
    config: Path | None = None
    read_only: bool = False
    dds: tuple[str, ...] | None = None
    robot: RobotOptions = field(default_factory=RobotOptions)
    recording: RecordingOptions = field(default_factory=RecordingOptions)
    providers: Providers = field(default_factory=Providers, compare=False, repr=False)
    _opened: "list[Link | Frames]" = field(default_factory=list, compare=False, repr=False)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        while self._opened:
            self._opened.pop().close()

    @property
    def needs_link(self) -> bool:
        """Whether something was asked for that only a link can give."""
        return bool(
            self.mode is Mode.JOIN
            or self.listen
            or self.connect
            or self.config is not None
            or self.read_only
            or self.dds is not None
        )

    @property
    def looks(self) -> bool:
        """Whether it is for what others bring, and its own world has no place among that."""
        return bool(self.connect or (self.dds is not None and self.command not in HOSTING))

    @property
    def place(self) -> str:
        """Where the others of its session are, in words, where that is not this machine."""
        if self.dds is None:
            return ", ".join(self.connect)
        return f"DDS domain {self.domain} on {', '.join(self.dds) or 'the loopback'}"

    def options(self) -> "Options":
        """The same as the link takes it."""
        from tftool.world.link.link_options import Certificates, Options, Reach

        certificates = None if self.tls is None else Certificates(*self.tls)
        reach = Reach(self.listen, self.connect, certificates, self.config, self.dds or ())
        if self.dds is None:
            return Options(self.command, self.domain, reach, self.read_only)
        # Among a robot's nodes, what only looks has nothing to write.
        read_only = self.read_only or self.command in LOOKING
        return Options(self.command, self.domain, reach, read_only, "dds")

    def open_link(self) -> "Link | None":
        """Open a link, which is closed with this connection at the latest.

        Raises:
            LinkError: If it cannot be opened.
        """
        link = self.providers.link(self.options())
        if link is not None:
            self.keep(link)
            for sentence in link.middleware.notices:
                notice(sentence)
        return link

    @property
    def file_options(self) -> "FileOptions":
        """How files are read, as `open_frames` takes it."""
        return {
            "joints": self.robot.joints,
            "arguments": self.robot.arguments,
            "urdf": self.robot.urdf,
            "with_odometry": self.recording.with_odometry,
            "no_cache": self.recording.no_cache,
        }

    @property
    def hosts_alone(self) -> bool:
        """Whether there is no session to join, without opening anything."""
        if self.mode is Mode.HOST:
            return True
        if self.needs_link:
            return False
        from tftool.world.link.zenoh.rendezvous import has_members

        return not has_members(self.domain)

    def keep(self, opened: "Link | Frames") -> None:
        """Close something with this connection, at the latest."""
        self._opened.append(opened)

    def refuse_to_share(self, word: str | None) -> None:
        """Refuse the options of sharing for what is read, or played on simulated time.

        Raises:
            UsageError: If one was given.
        """
        self.refuse_to_join(word)
        if self.needs_link:
            raise UsageError(
                f"'{visible(word or HOME)}' is played on simulated time here, which cannot be "
                "shared: leave out --join, --listen, --connect, --zenoh-config, --dds and "
                "--read-only."
            )

    def refuse_to_join(self, word: str | None) -> None:
        """Refuse --join for what is named, which is always hosted.

        Raises:
            UsageError: If it was given.
        """
        if word is not None and self.mode is Mode.JOIN:
            raise UsageError(f"'{visible(word)}' is always hosted: leave out --join, or the name.")

    def refuse_read_only(self, purpose: str) -> None:
        """Refuse --read-only for a command whose whole purpose is to publish.

        Raises:
            UsageError: If it was given.
        """
        if self.read_only:
            raise UsageError(
                f"--read-only publishes nothing, and to {purpose} is all {self.command} does."
            )

    def tell_read_only(self) -> None:
        """Say what --read-only means for nodes that are run."""
        if self.read_only:
            notice(
                "--read-only: what nodes here publish, broadcast and serve, no other process gets."
            )


def read(
    command: str,
    providers: Providers,
    *,
    join: bool = False,
    host: bool = False,
    domain: int | None = None,
    listen: list[str] | None = None,
    connect: list[str] | None = None,
    tls_cert: Path | None = None,
    tls_key: Path | None = None,
    tls_ca: Path | None = None,
    zenoh_config: Path | None = None,
    read_only: bool = False,
    dds: bool = False,
    dds_on: list[str] | None = None,
    joint: list[str] | None = None,
    argument: list[str] | None = None,
    urdf: Path | None = None,
    with_odometry: bool = False,
    no_cache: bool = False,
) -> Connection:
    """Put the options together.

    Raises:
        UsageError: If they contradict each other.
        InputError: If a file is not there, or not what it is given as.
    """
    if join and host:
        raise UsageError("--join and --host contradict each other: choose one.")
    if host and read_only:
        raise UsageError("--read-only looks at a session, so it cannot --host one.")
    if zenoh_config is not None and (listen or connect):
        raise UsageError("--zenoh-config says all endpoints: leave out --listen and --connect.")
    if (dds or dds_on) and (listen or connect or zenoh_config or tls_cert or tls_key or tls_ca):
        raise UsageError(
            "--dds goes by DDS: leave out --listen, --connect, --zenoh-config and --tls-*, which "
            "are zenoh's."
        )
    for file in (tls_cert, tls_key, tls_ca, zenoh_config):
        if file is not None and not file.is_file():
            raise InputError(f"There is no file '{file}'.")
    tls = _tls(tls_cert, tls_key, tls_ca)
    for endpoint in (*(listen or ()), *(connect or ())):
        _check_endpoint(endpoint, has_files=tls is not None)
    return Connection(
        command,
        Mode.JOIN if join else Mode.HOST if host else Mode.AUTO,
        domain_here() if domain is None else domain,
        tuple(listen or ()),
        tuple(connect or ()),
        tls,
        zenoh_config,
        read_only,
        tuple(dds_on or ()) if dds or dds_on else None,
        RobotOptions(
            dict(_joint(word) for word in joint or ()),
            dict(_argument(word) for word in argument or ()),
            urdf,
        ),
        RecordingOptions(no_cache, with_odometry),
        providers,
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
            f"'--joint {word}' is no joint and position: write NAME=VALUE, such as "
            "--joint elbow=0.5 or --joint elbow=30deg."
        )
    return name, position


def _argument(word: str) -> tuple[str, str]:
    name, assigned, value = word.partition(":=")
    if not name or not assigned:
        raise UsageError(f"'{word}' is no xacro argument: write NAME:=VALUE.")
    return name, value


def _tls(cert: Path | None, key: Path | None, ca: Path | None) -> tuple[Path, Path, Path] | None:
    """The three files of mutual TLS; None where none is given."""
    if cert is None or key is None or ca is None:
        if cert or key or ca:
            raise UsageError(
                "TLS here is mutual: give --tls-cert, --tls-key and --tls-ca together."
            )
        return None
    from tftool.world.link.link_options import Certificates

    Certificates(cert, key, ca).check()
    return cert, key, ca


def _check_endpoint(endpoint: str, *, has_files: bool) -> None:
    from tftool.world.link.zenoh.settings import PROTOCOLS, SECURED, has_port

    protocol, slash, address = endpoint.partition("/")
    if not slash or not address or protocol not in PROTOCOLS:
        raise UsageError(
            f"'{endpoint}' is no endpoint: write PROTOCOL/ADDRESS, such as tcp/192.168.1.5:7448, "
            f"with one of {', '.join(PROTOCOLS)}."
        )
    if not has_port(endpoint):
        raise UsageError(
            f"'{endpoint}' has no port: write {protocol}/HOST:PORT, such as "
            f"{protocol}/192.168.1.5:7448."
        )
    if protocol in SECURED and not has_files:
        raise UsageError(f"'{endpoint}' needs --tls-cert, --tls-key and --tls-ca.")
