"""The options by which commands share sessions and read sources, as their help has them."""

import functools
import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

import typer

from tftool.commands.shared.options import option
from tftool.world.link.link_options import LARGEST_DOMAIN

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers

FLAGS = ("join", "host", "read_only", "dds", "with_odometry", "no_cache")

SESSION_OPTIONS: dict[str, Any] = {
    "join": Annotated[
        bool, option("Join the session that runs here; fail if none does.", "--join")
    ],
    "host": Annotated[bool, option("Host a world of its own, whatever runs here.", "--host")],
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
        option(
            "Let other machines in, at tcp/0.0.0.0:7448 for example. All who reach "
            "that port can see and drive everything: use tls/ in a network you share.",
            "--listen",
            metavar="ENDPOINT",
        ),
    ],
    "connect": Annotated[
        list[str] | None,
        option(
            "Join another machine's session, or ROS 2's zenoh router: tcp/localhost:7447.",
            "--connect",
            metavar="ENDPOINT",
        ),
    ],
    "tls_cert": Annotated[
        Path | None, option("Our certificate, for tls/.", "--tls-cert", metavar="FILE")
    ],
    "tls_key": Annotated[Path | None, option("Its private key.", "--tls-key", metavar="FILE")],
    "tls_ca": Annotated[
        Path | None, option("Who signed the other side's certificate.", "--tls-ca", metavar="FILE")
    ],
    "zenoh_config": Annotated[
        Path | None, option("A zenoh configuration, as it is.", "--zenoh-config", metavar="FILE")
    ],
    "read_only": Annotated[
        bool, option("Only look: publish nothing, serve nothing.", "--read-only")
    ],
    "dds": Annotated[
        bool,
        option(
            "A ROS 2 robot over DDS, not zenoh: what is sent stays on this machine's loopback "
            "(DDS receives on 0.0.0.0 all the same).",
            "--dds",
        ),
    ],
    "dds_on": Annotated[
        list[str] | None,
        option(
            "The same on an interface (eth0), or with a machine (192.168.1.5); again for "
            "more. DDS here has no TLS: all of that network can read and write.",
            "--dds-on",
            metavar="PLACE",
        ),
    ],
}


ROBOT = "Robot descriptions"
"""Heading of the help under which their options are listed."""

ROBOT_OPTIONS: dict[str, Any] = {
    "joint": Annotated[
        list[str] | None,
        option(
            "Position of a joint in rad or m (30deg too); again for more.",
            "--joint",
            metavar="NAME=VALUE",
            panel=ROBOT,
        ),
    ],
    "argument": Annotated[
        list[str] | None,
        option(
            "A xacro argument; NAME:=VALUE alone does too. xacro evaluates expressions of the "
            "file: expand none from strangers.",
            "--argument",
            metavar="NAME:=VALUE",
            panel=ROBOT,
        ),
    ],
}
"""What every command takes whose FROM may be a robot description."""

RECORDING = "Recordings"
"""Heading of the help under which their options are listed."""

RECORDING_OPTIONS: dict[str, Any] = {
    "with_odometry": Annotated[
        bool,
        option(
            "Take Odometry and PoseStamped for transforms, of frames that tf lacks.",
            "--with-odometry",
            panel=RECORDING,
        ),
    ],
    "no_cache": Annotated[
        bool,
        option(
            "Read all of it anew, and keep no columns for the next question.",
            "--no-cache",
            panel=RECORDING,
        ),
    ],
}
"""What every command takes whose FROM may be a recording."""

URDF_OPTION: dict[str, Any] = {
    "urdf": Annotated[
        Path | None,
        option(
            "Description of the robot in a recording that has none inside.",
            "--urdf",
            metavar="FILE",
            panel=ROBOT,
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
        from tftool.commands.shared.connection import Providers, read

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
