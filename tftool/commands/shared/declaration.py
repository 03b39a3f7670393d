"""Declaration of a command: its options, and its kind.

The kind decides its further options: of sessions, of recordings, of robot descriptions.
`tftool/commands/NAME/__init__.py` declares the command, and `run` in `command.py` beside it is
imported when it is called: help and completion need only the options.
"""

import functools
import inspect
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_args

import typer

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.commands.shared.options import ROBOT, option
from tftool.world.link.link_options import LARGEST_DOMAIN, REACHES, reach_at
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers


def _declared(reach: type[Reach]) -> dict[str, Any]:
    """Return a middleware's options in typer's form."""
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
"""Options of commands whose FROM may be a robot description."""

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
    "tf_topic": Annotated[
        list[str] | None,
        option(
            "Read these transforms alone, /r1/tf; again for more robots, whose equal frame names "
            "get the namespace as prefix.",
            "--tf-topic",
            metavar="TOPIC",
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
"""Options of commands whose FROM may be a recording."""

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
"""Option of commands whose FROM may be a recording that lacks the description of its robot."""


POSES = "Pose files"
"""Heading of the help under which their options are listed."""

POSE_OPTIONS: dict[str, Any] = {
    "frames": Annotated[
        str | None,
        option(
            "Names of parent and child in a pose file. Each of these options is for the file it "
            "follows.",
            "--frames",
            metavar="PARENT:CHILD",
            panel=POSES,
        ),
    ],
    "pose_rate": Annotated[
        float | None,
        option("Poses in a second, where they have no stamps.", metavar="HZ", panel=POSES),
    ],
    "pose_format": Annotated[
        str | None,
        option("Format of the file, where its content fits two.", metavar="NAME", panel=POSES),
    ],
    "inverted": Annotated[
        bool,
        option("Take the inverse of each pose that is written.", "--inverted", panel=POSES),
    ],
    "axes": Annotated[
        str | None,
        option("Axes of the cameras: opencv or opengl.", metavar="NAME", panel=POSES),
    ],
}
"""Options of commands whose FROM may be a pose file; `Command` puts them into effect."""


LOOKING = "doctor, echo, explain, export, monitor, plot, record, session, tree and view"
"""Commands that read a session by its address."""


@dataclass(frozen=True, slots=True)
class Declaration:
    """A command's own options and its kind.

    Attributes:
        declared: The function whose parameters are its options and whose docstring is its help.
        shares: Whether it joins or hosts a session. It takes a `Connection` first then.
        looks_only: Whether it writes to no topic of a robot.
        hosts_turtles: Whether it hosts turtles where it looks for a robot and finds none; other
            commands wait for one.
        recordings: Whether FROM may be a recording.
        descriptions: Whether FROM may be a robot description.
        urdf: Whether FROM may be a recording without the description of its robot.
        poses: Whether FROM may be a pose file, without being a command of sessions.
        settings: Differences from click's reading of a command line.
    """

    declared: Callable[..., Any]
    shares: bool = True
    looks_only: bool = False
    hosts_turtles: bool = False
    recordings: bool = False
    descriptions: bool = False
    urdf: bool = False
    poses: bool = False
    settings: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The command's name as it is typed."""
        return self.declared.__name__

    def with_options(self, providers: "Providers | None" = None) -> Callable[..., Any]:
        """Return the command with all of its options, ready to be called.

        Args:
            providers: Source of clocks and links; the real ones when None.
        """
        if not (self.shares or self.poses):
            # Not the bound method itself, which takes no attributes.
            return functools.wraps(self.declared)(functools.partial(self._run))
        added = {
            **(POSE_OPTIONS if self.poses or self.recordings or self.urdf else {}),
            **(ROBOT_OPTIONS if self.descriptions else {}),
            **(URDF_OPTION if self.urdf else {}),
            **(RECORDING_OPTIONS if self.recordings else {}),
            **(SESSION_OPTIONS if self.shares else {}),
        }

        @functools.wraps(self.declared)
        def connected(*args: Any, **words: Any) -> Any:
            from tftool.commands.shared.connection import Providers, read

            given = {name: words.pop(name) for name in added if name in words}
            for name in POSE_OPTIONS:
                given.pop(name, None)
            if not self.shares:
                return self._run(*args, **words)
            address = self._take_address(words)
            with read(
                self.name,
                providers or Providers(),
                looks_only=self.looks_only,
                hosts_turtles=self.hosts_turtles,
                address=address,
                **given,
            ) as connection:
                return self._run(connection, *args, **words)

        signature = inspect.signature(self.declared)
        own = list(signature.parameters.values())
        first = own.pop(0) if self.shares else None
        connected.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[*own, *(_parameter(*one) for one in added.items())]
        )
        connected.__annotations__ = {**self.declared.__annotations__, **added}
        if first is not None:
            connected.__annotations__.pop(first.name, None)
        return connected

    def _take_address(self, words: dict[str, Any]) -> str | None:
        """Remove a session's address from the command's words, where FROM may be one.

        Raises:
            UsageError: If the command does not read sessions, or the address is out of place.
        """
        parameters = inspect.signature(self.declared).parameters
        for name, value in words.items():
            several = value if isinstance(value, list) else [value]
            found = [one for one in several if isinstance(one, str) and reach_at(one) is not None]
            if not found:
                continue
            if not self.looks_only:
                raise UsageError(
                    f"'{visible(found[0])}' is a robot's server, which is read-only, and 'tftool "
                    f"{self.name}' publishes or reads files: {LOOKING} work with it."
                )
            is_from = parameters[name].default is not inspect.Parameter.empty
            if len(found) > 1 or not is_from:
                raise UsageError(
                    f"'{visible(found[0])}' is a FROM: give only one, as the last word."
                )
            words[name] = [one for one in several if one not in found] if several is value else None
            return found[0]
        return None

    def _run(self, *args: Any, **options: Any) -> Any:
        """Run the command's code: `command.py` of its folder, else the function itself."""
        home = self.declared.__module__
        if not hasattr(sys.modules[home], "__path__"):
            return self.declared(*args, **options)
        return import_module(f"{home}.command").run(*args, **options)


def _parameter(name: str, annotation: Any) -> inspect.Parameter:
    default = False if get_args(annotation)[0] is bool else None
    kind = inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(name, kind, default=default, annotation=annotation)


def declare(**kind: Any) -> Callable[[Callable[..., Any]], Declaration]:
    """Declare the decorated function as a command; `kind` gives attributes of `Declaration`."""
    return lambda declared: Declaration(declared, **kind)
