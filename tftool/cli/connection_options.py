"""The options by which commands share sessions and read sources, as their help has them."""

import functools
import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from tftool.cli.connection import Providers

LARGEST_DOMAIN = 232
"""ROS 2's own limit."""

FLAGS = ("join", "host", "read_only", "dds", "with_odometry", "no_cache")

SESSION_OPTIONS: dict[str, Any] = {
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
            help="Let other machines in, at tcp/0.0.0.0:7448 for example. All who reach "
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
    "dds": Annotated[
        bool,
        typer.Option(
            "--dds",
            help="A ROS 2 robot over DDS, not zenoh: what is sent stays on this machine's loopback "
            "(DDS receives on 0.0.0.0 all the same).",
        ),
    ],
    "dds_on": Annotated[
        list[str] | None,
        typer.Option(
            "--dds-on",
            metavar="PLACE",
            help="The same on an interface (eth0), or with a machine (192.168.1.5); again for "
            "more. DDS here has no TLS: all of that network can read and write.",
        ),
    ],
}


ROBOT = "Robot descriptions"
"""Heading of the help under which their options are listed."""

ROBOT_OPTIONS: dict[str, Any] = {
    "joint": Annotated[
        list[str] | None,
        typer.Option(
            "--joint",
            metavar="NAME=VALUE",
            rich_help_panel=ROBOT,
            help="Position of a joint in rad or m (30deg too); again for more.",
        ),
    ],
    "argument": Annotated[
        list[str] | None,
        typer.Option(
            "--argument",
            metavar="NAME:=VALUE",
            rich_help_panel=ROBOT,
            help="A xacro argument; NAME:=VALUE alone does too. xacro evaluates expressions of the "
            "file: expand none from strangers.",
        ),
    ],
}
"""What every command takes whose FROM may be a robot description."""

RECORDING = "Recordings"
"""Heading of the help under which their options are listed."""

RECORDING_OPTIONS: dict[str, Any] = {
    "with_odometry": Annotated[
        bool,
        typer.Option(
            "--with-odometry",
            rich_help_panel=RECORDING,
            help="Take Odometry and PoseStamped for transforms, of frames that tf lacks.",
        ),
    ],
    "no_cache": Annotated[
        bool,
        typer.Option(
            "--no-cache",
            rich_help_panel=RECORDING,
            help="Read all of it anew, and keep no columns for the next question.",
        ),
    ],
}
"""What every command takes whose FROM may be a recording."""

URDF_OPTION: dict[str, Any] = {
    "urdf": Annotated[
        Path | None,
        typer.Option(
            "--urdf",
            metavar="FILE",
            rich_help_panel=ROBOT,
            help="Description of the robot in a recording that has none inside.",
        ),
    ],
}


def with_connection(
    command: Callable[..., Any],
    providers: "Providers | None" = None,
    source_options: Mapping[str, Any] = MappingProxyType({}),
) -> Callable[..., Any]:
    """Give a command its connection, and its command line the options for that.

    Args:
        command: Takes a `Connection` first; then its own options.
        providers: Where clocks and links come from; the real ones when None.
        source_options: Which options about robot descriptions and recordings it takes.
    """
    added_options = {**source_options, **SESSION_OPTIONS}
    signature = inspect.signature(command)
    _, *own = signature.parameters.values()
    added = [
        inspect.Parameter(
            name,
            inspect.Parameter.KEYWORD_ONLY,
            default=False if name in FLAGS else None,
            annotation=annotation,
        )
        for name, annotation in added_options.items()
    ]

    @functools.wraps(command)
    def connected(*args: Any, **words: Any) -> Any:
        from tftool.cli.connection import Providers, read

        given = {name: words.pop(name) for name in added_options if name in words}
        with read(command.__name__, providers or Providers(), **given) as connection:
            return command(connection, *args, **words)

    connected.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=[*own, *added]
    )
    annotations = {**command.__annotations__, **added_options}
    annotations.pop(next(iter(signature.parameters)), None)
    connected.__annotations__ = annotations
    return connected
