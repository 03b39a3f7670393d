"""The options by which every command says whether it joins or hosts, and how far it reaches."""

import functools
import inspect
import os
from collections.abc import Callable
from contextvars import ContextVar
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from tftool.cli.notices import notice
from tftool.errors import InputError, UsageError

if TYPE_CHECKING:
    from tftool.link.membership import Options
    from tftool.link.session import Link

LARGEST_DOMAIN = 232
"""ROS 2's own limit."""


class Mode(Enum):
    """What a command was told to do about the session that may run here."""

    AUTO = auto()
    JOIN = auto()
    HOST = auto()


@dataclass(frozen=True, slots=True)
class Choice:
    """What the options of a command say.

    Attributes:
        command: The command's name.
        mode: Join, host, or whatever fits.
        domain: Number of the ROS domain.
        listen: Endpoints to open for other machines.
        connect: Endpoints to go to.
        tls: Certificate, key and authority, where given.
        config: A zenoh configuration to take as it is.
        read_only: Whether to look only.
    """

    command: str = "tftool"
    mode: Mode = Mode.AUTO
    domain: int = 0
    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    tls: tuple[Path, Path, Path] | None = None
    config: Path | None = None
    read_only: bool = False

    @property
    def is_asked_for(self) -> bool:
        """Whether something was said that only a link can give."""
        return bool(
            self.mode is Mode.JOIN
            or self.listen
            or self.connect
            or self.config is not None
            or self.read_only
        )

    def options(self) -> "Options":
        """The same as the link takes it."""
        from tftool.link.membership import Options
        from tftool.link.reach import Certificates, Reach

        certificates = None if self.tls is None else Certificates(*self.tls)
        reach = Reach(self.listen, self.connect, certificates, self.config)
        return Options(self.command, self.domain, reach, self.read_only)


def refuse_read_only(command: str, purpose: str) -> None:
    """Say so to whoever wants to look only with a command that does more.

    Raises:
        UsageError: If that was asked for.
    """
    if choice().read_only:
        raise UsageError(f"--read-only publishes nothing, and to {purpose} is all {command} does.")


def tell_read_only() -> None:
    """Say to whoever runs nodes that only look what comes of what they send."""
    if choice().read_only:
        notice("--read-only: what nodes here publish, broadcast and serve, nobody else gets.")


_choice: ContextVar[Choice | None] = ContextVar("choice", default=None)
_open: list["Link"] = []


def choice() -> Choice:
    """What the running command was told."""
    return _choice.get() or Choice()


def open_link() -> "Link":
    """Open the link of the running command; it is closed when the command ends.

    Raises:
        LinkError: If it cannot be opened.
    """
    from tftool.link.session import Link

    link = Link(choice().options())
    _open.append(link)
    return link


_OPTIONS: dict[str, Any] = {
    "join": Annotated[
        bool, typer.Option("--join", help="Join the session that runs here; fail if none does.")
    ],
    "host": Annotated[
        bool, typer.Option("--host", help="Host a world of its own, whatever runs here.")
    ],
    "domain": Annotated[
        int | None,
        typer.Option(
            "--domain",
            min=0,
            max=LARGEST_DOMAIN,
            metavar="N",
            help="Session to share; ROS_DOMAIN_ID, else 0, if not said.",
        ),
    ],
    "listen": Annotated[
        list[str] | None,
        typer.Option(
            "--listen",
            metavar="ENDPOINT",
            help="Let other machines in, at tcp/0.0.0.0:7448 for example. Whoever reaches "
            "that port can see and drive everything: use tls/ in a network you share.",
        ),
    ],
    "connect": Annotated[
        list[str] | None,
        typer.Option(
            "--connect",
            metavar="ENDPOINT",
            help="Join another machine's session, or ROS 2's zenoh router: tcp/localhost:7447.",
        ),
    ],
    "tls_cert": Annotated[
        Path | None, typer.Option("--tls-cert", metavar="FILE", help="Our certificate, for tls/.")
    ],
    "tls_key": Annotated[
        Path | None, typer.Option("--tls-key", metavar="FILE", help="Its private key.")
    ],
    "tls_ca": Annotated[
        Path | None,
        typer.Option("--tls-ca", metavar="FILE", help="Who signed the other side's certificate."),
    ],
    "zenoh_config": Annotated[
        Path | None,
        typer.Option("--zenoh-config", metavar="FILE", help="A zenoh configuration, as it is."),
    ],
    "read_only": Annotated[
        bool, typer.Option("--read-only", help="Only look: publish nothing, serve nothing.")
    ],
}


def shares(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the options of sharing, beside its own."""
    signature = inspect.signature(command)
    added = [
        inspect.Parameter(
            name,
            inspect.Parameter.KEYWORD_ONLY,
            default=False if name in ("join", "host", "read_only") else None,
            annotation=annotation,
        )
        for name, annotation in _OPTIONS.items()
    ]

    @functools.wraps(command)
    def sharing(*args: Any, **words: Any) -> Any:
        own = {name: words.pop(name) for name in _OPTIONS if name in words}
        token = _choice.set(_read(command.__name__, **own))
        try:
            return command(*args, **words)
        finally:
            _choice.reset(token)
            while _open:
                _open.pop().close()

    sharing.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=[*signature.parameters.values(), *added]
    )
    sharing.__annotations__ = {**command.__annotations__, **_OPTIONS}
    return sharing


def _read(
    command: str,
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
) -> Choice:
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
    files = [tls_cert, tls_key, tls_ca]
    given = [file for file in (*files, zenoh_config) if file is not None]
    for file in given:
        if not file.is_file():
            raise InputError(f"There is no file '{file}'.")
    if any(files) and not all(files):
        raise UsageError("TLS here is mutual: give --tls-cert, --tls-key and --tls-ca together.")
    endpoints = [*(listen or ()), *(connect or ())]
    for endpoint in endpoints:
        _check_endpoint(endpoint, has_files=all(files))
    tls = (tls_cert, tls_key, tls_ca) if tls_cert and tls_key and tls_ca else None
    if tls is not None:
        from tftool.link.reach import Certificates

        Certificates(*tls).check()
    return Choice(
        command,
        Mode.JOIN if join else Mode.HOST if host else Mode.AUTO,
        _domain() if domain is None else domain,
        tuple(listen or ()),
        tuple(connect or ()),
        tls,
        zenoh_config,
        read_only,
    )


def _check_endpoint(endpoint: str, *, has_files: bool) -> None:
    from tftool.link.reach import PROTOCOLS, SECURED, has_port

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


def _domain() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "")
    if not text:
        return 0
    if not (text.isascii() and text.isdigit() and int(text[:9]) <= LARGEST_DOMAIN):
        raise UsageError(f"ROS_DOMAIN_ID is '{text}', not a number from 0 to {LARGEST_DOMAIN}.")
    return int(text)
