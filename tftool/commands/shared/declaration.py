"""Declaration of a command: its own options, and its kind, which adds options.

A command kind adds the options of sessions, of recordings, or of robot descriptions.
`tftool/commands/NAME/__init__.py` declares a command. The function `run` in
`tftool/commands/NAME/command.py` is imported only when the command is called, because help and
completion need only the options. A small command is a single file.
"""

import inspect
import pkgutil
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import (
    TYPE_CHECKING,
    Any,
    ClassVar,
    NamedTuple,
)

import typer
from typer.models import ParameterInfo

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible
from tftool.commands.shared.options import ROBOT, flag, option
from tftool.world.link.link_options import LARGEST_DOMAIN, REACHES, reach_at
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers

if TYPE_CHECKING:
    pass


def options_in(home: type) -> dict[str, tuple[Any, Any]]:
    """Return each option field of a class by name, as a pair: type and declaration."""
    found = {}
    for name, kind in inspect.get_annotations(home).items():
        value = getattr(home, name, inspect.Parameter.empty)
        if kind is bool and isinstance(value, ParameterInfo) and not value.param_decls:
            # By default, typer would also add the opposite flag, --no-NAME.
            value.param_decls = (f"--{name.replace('_', '-')}",)
        found[name] = kind, value
    return found


def _declared(reach: type[Reach]) -> dict[str, Any]:
    """Return each option of a middleware by name, as a pair: type and declaration."""
    return {
        name: (
            one.kind,
            option(
                one.text, one.flag, default=False if one.kind is bool else None, metavar=one.metavar
            ),
        )
        for name, one in reach.OPTIONS.items()
    }


SESSION_OPTIONS: dict[str, Any] = {
    "join": (bool, flag("Join the running session; fail if no session is running.", "--join")),
    "host": (bool, flag("Host a new session, even if a session is running.", "--host")),
    "domain": (
        int | None,
        option(
            "Domain of the session, a number; if not given, ROS_DOMAIN_ID, else 0.",
            "--domain",
            min=0,
            max=LARGEST_DOMAIN,
            metavar="N",
        ),
    ),
    **_declared(REACHES[0]),
    "read_only": (bool, flag("Publish nothing, and offer no services.", "--read-only")),
    **{name: kind for reach in REACHES[1:] for name, kind in _declared(reach).items()},
}


class _OfRobots:
    """Options of commands whose FROM may be a robot description."""

    joint: list[str] | None = option(
        "Position of a joint in rad or m, or of a turning joint as 30deg. Repeat the option for "
        "more joints.",
        metavar="NAME=VALUE",
        panel=ROBOT,
    )
    argument: list[str] | None = option(
        "Argument for xacro; the option's name can be left out. xacro evaluates Python "
        "expressions of the file: use only files that you trust.",
        metavar="NAME:=VALUE",
        panel=ROBOT,
    )


ROBOT_OPTIONS = options_in(_OfRobots)

RECORDING = "Recordings"
"""Heading in the help above the options of recordings."""


class _OfRecordings:
    """Options of commands whose FROM may be a recording."""

    with_odometry: bool = flag(
        "Also take messages of Odometry and PoseStamped as transforms, for frames that are not "
        "in tf.",
        panel=RECORDING,
    )
    tf_topic: list[str] | None = option(
        "Read only the transforms of this topic, such as /r1/tf. Repeat the option for more "
        "robots; names of frames that several robots use then get a prefix, the namespace.",
        metavar="TOPIC",
        panel=RECORDING,
    )
    no_cache: bool = flag(
        "Read the whole recording, without the cache, and write no cache.",
        panel=RECORDING,
    )


RECORDING_OPTIONS = options_in(_OfRecordings)


class _OfUndescribed:
    """Option --urdf, for commands whose FROM may be a recording without a robot description."""

    urdf: Path | None = option(
        "Robot description for a recording that contains no description.",
        metavar="FILE",
        panel=ROBOT,
    )


URDF_OPTION = options_in(_OfUndescribed)


POSES = "Pose files"
"""Heading in the help above the options of pose files."""


class _OfPoseFiles:
    """Options of commands whose FROM may be a pose file; each applies to the file before it."""

    frames: str | None = option(
        "Names of parent and child in a pose file. Each option of this group applies to the pose "
        "file before it.",
        metavar="PARENT:CHILD",
        panel=POSES,
    )
    pose_rate: float | None = option(
        "Poses per second, for a file without stamps.", metavar="HZ", panel=POSES
    )
    pose_format: str | None = option(
        "Format of the file, if its content fits several.", metavar="NAME", panel=POSES
    )
    inverted: bool = flag("Invert each pose of the file.", panel=POSES)
    axes: str | None = option("Axes of the cameras: opencv or opengl.", metavar="NAME", panel=POSES)


POSE_OPTIONS = options_in(_OfPoseFiles)


@dataclass(frozen=True, slots=True)
class CommandKind:
    """Properties of a command that decide which options it has.

    Attributes:
        shares: Whether the command joins or hosts a session. If so, the first parameter of the
            command's `run` is a `Connection`.
        looks_only: Whether the command publishes nothing, so that FROM may be a robot's address.
        hosts_turtles: Whether the command hosts the turtle world if no robot is found; other
            commands wait for a robot.
        recordings: Whether FROM may be a recording.
        descriptions: Whether FROM may be a robot description.
        urdf: Whether the command has the option --urdf, which gives the robot description for a
            recording that contains none.
        poses: Whether FROM may be a pose file, for a command that reads no recordings.
        settings: Settings of click's parser that differ from the defaults.
    """

    shares: bool = True
    looks_only: bool = False
    hosts_turtles: bool = False
    recordings: bool = False
    descriptions: bool = False
    urdf: bool = False
    poses: bool = False
    settings: Mapping[str, Any] = field(default_factory=dict)

    def options(self) -> dict[str, Any]:
        """Return the options of this kind of command by name, as pairs: type and declaration."""
        return {
            **(POSE_OPTIONS if self.poses or self.recordings or self.urdf else {}),
            **(ROBOT_OPTIONS if self.descriptions else {}),
            **(URDF_OPTION if self.urdf else {}),
            **(RECORDING_OPTIONS if self.recordings else {}),
            **(SESSION_OPTIONS if self.shares else {}),
        }


class Invocation(NamedTuple):
    """Data passed from `main` to a command, as the `obj` of click's context.

    Attributes:
        providers: Functions that create clocks and connections to processes; None except in tests.
        run: Function that runs another command line of tftool, and returns its exit status.
    """

    providers: "Providers | None"
    run: Callable[[Sequence[str]], int]


class Command:
    """Base class of commands: a derived class has options as fields, and the help as docstring.

    A field's value or type contains the option's declaration (`option`, `flag` or `argument`).

    Class keywords set attributes of `CommandKind`: `class EchoOptions(Command, looks_only=True)`.
    An instance has the parsed values as attributes, and is passed to the function `run` of the
    command.
    """

    kind: ClassVar[CommandKind]

    def __init_subclass__(cls, **kind: Any) -> None:
        cls.kind = CommandKind(**kind)

    def __init__(self, **given: Any) -> None:
        for name, value in vars(type(self)).items():
            if isinstance(value, ParameterInfo):
                given.setdefault(name, value.default)
        vars(self).update(given)


def typer_function(command: type[Command]) -> Callable[..., Any]:
    """Return the function that typer calls to run a command; the result is the exit status."""
    home = command.__module__
    name = home.rpartition(".")[2]
    added = command.kind.options()
    own = options_in(command)

    def called(context: typer.Context, **words: Any) -> Any:
        if hasattr(sys.modules[home], "__path__"):
            run = import_module(f"{home}.command").run
        else:
            run = sys.modules[home].run
        given = {name: words.pop(name) for name in added}
        if not command.kind.shares:
            return run(command(**words))
        from tftool.commands.shared.connection import read

        for pose_option in POSE_OPTIONS:
            given.pop(pose_option, None)
        address = _take_address(name, command, words)
        with read(name, command.kind, context, address=address, **given) as connection:
            return run(connection, command(**words))

    keyword = inspect.Parameter.KEYWORD_ONLY
    parameters = [inspect.Parameter("context", keyword, annotation=typer.Context)]
    for field_name, (kind, value) in {**own, **added}.items():
        parameters.append(inspect.Parameter(field_name, keyword, default=value, annotation=kind))
    called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    called.__annotations__ = {one.name: one.annotation for one in parameters}
    called.__doc__ = command.__doc__
    return called


def _take_address(name: str, command: type[Command], words: dict[str, Any]) -> str | None:
    """Remove a session's address from a command's words and return it; None if there is none.

    Args:
        name: Name of the command.
        command: Class of the command.
        words: Values of arguments and options by name; changed.

    Raises:
        UsageError: If the command does not read sessions, or the address is not given as FROM.
    """
    for parameter, value in words.items():
        several = value if isinstance(value, list) else [value]
        found = [one for one in several if isinstance(one, str) and reach_at(one) is not None]
        if not found:
            continue
        if not command.kind.looks_only:
            raise UsageError(
                f"'{visible(found[0])}' is a robot's address, which is read-only: 'tftool {name}' "
                f"cannot use it, only {_looking_commands()} can."
            )
        is_required = getattr(getattr(command, parameter, None), "default", None) is ...
        if len(found) > 1 or is_required or not hasattr(command, parameter):
            raise UsageError(
                f"'{visible(found[0])}' is the address of a session: give one such address only, "
                "as the last word."
            )
        words[parameter] = (
            [one for one in several if one not in found] if several is value else None
        )
        return found[0]
    return None


def _looking_commands() -> str:
    """Return the names of the commands whose FROM may be an address, joined as text."""
    names = []
    for room in pkgutil.iter_modules(import_module("tftool.commands").__path__):
        module = import_module(f"tftool.commands.{room.name}")
        command = getattr(module, f"{room.name.capitalize()}Options", None)
        if command is not None and command.kind.looks_only:
            names.append(room.name)
    return f"{', '.join(names[:-1])} and {names[-1]}"
