"""The options by which commands share sessions and read sources, as their help has them."""

import functools
import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, get_args

import typer

from tftool.commands.shared.options import option
from tftool.world.link.link_options import LARGEST_DOMAIN, REACHES
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers


def _declared(reach: type[Reach]) -> dict[str, Any]:
    """Return a middleware's options, as typer takes them."""
    return {
        name: Annotated[one.kind, option(one.text, one.flag, metavar=one.metavar)]
        for name, one in reach.OPTIONS.items()
    }


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
    **_declared(REACHES[0]),
    "read_only": Annotated[
        bool, option("Only look: publish nothing, serve nothing.", "--read-only")
    ],
    **{name: kind for reach in REACHES[1:] for name, kind in _declared(reach).items()},
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
            default=False if get_args(annotation)[0] is bool else None,
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
