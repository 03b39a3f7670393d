"""Executables of ROS packages that tftool can start: users' Python programs and built-in nodes."""

import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.base.color import BACKGROUND, Color
from tftool.base.errors import UsageError
from tftool.base.plain_text import did_you_mean
from tftool.buffer.sample import TransformStamped
from tftool.geometry.notation import static_arguments
from tftool.messages.classes import INTERFACES
from tftool.ros.host import importing, user_code, values
from tftool.ros.host.error_text import undeclared
from tftool.ros.host.names import RosOptions, expand, join, named_twice
from tftool.ros.host.program import Program, warn_without_clock
from tftool.ros.host.workspace import Workspace, missing_package
from tftool.world.clock import FollowedClock
from tftool.world.link.link_options import REACHES
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import (
    Broadcaster,
    DynamicCarrot,
    FixedCarrot,
    StaticBroadcaster,
    static_turtle,
)
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.joints import (
    DESCRIPTION,
    JOINT_STATES,
    JointStatePublisher,
    RobotStatePublisher,
)
from tftool.world.nodes.points import MessageBroadcaster, PointDrawer
from tftool.world.nodes.turtle_drivers import DrawSquare, Mimic
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.robots.robot_model import Robot


T = TypeVar("T")


class HasItsOwnCommand(UsageError):
    """Error for an executable that needs a separate terminal.

    The error's text contains the tftool command to run in that terminal.
    """


@dataclass(frozen=True, slots=True)
class NodeRequest:
    """Request to start one of tftool's built-in nodes as `ros2 run` would start the ROS node.

    Attributes:
        world: World that the node joins.
        name: Full name of the node.
        namespace: Namespace of the node.
        arguments: The program's arguments, without the part after `--ros-args`.
        parameters: Values of the node's parameters, by name. The methods below remove a value
            when they return it.
        options: All options after `--ros-args`.
    """

    world: World
    name: str
    namespace: str
    arguments: Sequence[str]
    parameters: dict[str, Any]
    options: RosOptions

    def text(self, name: str, default: str) -> str:
        """Remove a text parameter from `parameters` and return its value; see `take`."""
        return str(self.parameters.pop(name, default))

    def take(self, name: str, default: T, is_valid: Callable[[Any], bool], description: str) -> T:
        """Remove a parameter from `parameters`; return its value, or `default` if it was not set.

        Args:
            name: Name of the parameter.
            default: Value of a parameter that was not set.
            is_valid: Function that returns whether a value is valid.
            description: Description of valid values for the error's text, such as "a number".

        Raises:
            UsageError: If `is_valid` rejects the value.
        """
        value: T = self.parameters.pop(name, default)
        if isinstance(value, bool) is not isinstance(default, bool) or not is_valid(value):
            raise UsageError(f"parameter '{name}' must be {description}, not {value!r}")
        return value

    def flag(self, name: str, default: bool) -> bool:
        """Remove a boolean parameter from `parameters` and return its value; see `take`."""
        return self.take(name, default, lambda _: True, "true or false")

    def number(self, name: str, default: float) -> float:
        """Remove a numeric parameter from `parameters` and return its finite value; see `take`."""

        def fits(value: Any) -> bool:
            return isinstance(value, int | float) and isfinite(value)

        return float(self.take(name, default, fits, "a number"))

    def channel(self, name: str, default: int) -> int:
        """Remove a colour channel, 0 to 255, from `parameters` and return its value; see `take`."""

        def fits(value: Any) -> bool:
            return isinstance(value, int) and 0 <= value <= 255

        return self.take(name, default, fits, "a whole number from 0 to 255")

    def remapped(self, *names: str) -> list[str]:
        """Return the full names of topics after applying the node's remapping rules."""
        return [
            self.options.remapped(expand(one, self.name, self.namespace), self.name, self.namespace)
            for one in names
        ]


def _turtlesim(request: NodeRequest) -> Node:
    background = Color(
        request.channel("background_r", BACKGROUND.r),
        request.channel("background_g", BACKGROUND.g),
        request.channel("background_b", BACKGROUND.b),
    )
    return Turtlesim(
        request.world,
        request.name,
        holonomic=request.flag("holonomic", False),
        background=background,
        namespace=request.namespace,
    )


def _broadcaster(request: NodeRequest) -> Node:
    turtle = request.text("turtlename", "turtle")
    return Broadcaster(request.world, request.name, turtle=turtle)


def _follower(request: NodeRequest) -> Node:
    return Follower(request.world, request.name, leader=request.text("target_frame", "turtle1"))


def _static_turtle(request: NodeRequest) -> Node:
    return StaticBroadcaster(
        request.world, request.name, transforms=[static_turtle(request.arguments)]
    )


def _static_publisher(request: NodeRequest) -> Node:
    said = static_arguments.parse(request.arguments)
    if said is None:
        raise UsageError(
            "static_transform_publisher has no --help here: 'tftool static --help' describes the "
            "same arguments"
        )
    sample = TransformStamped(0, said.parent, said.child, said.transform)
    return StaticBroadcaster(request.world, request.name, transforms=[sample])


def _mimic(request: NodeRequest) -> Node:
    topics = {"input/pose": "turtle1/pose", "output/cmd_vel": "turtle2/cmd_vel"}
    leader, copy = (
        end.removesuffix(tail) if end.endswith(tail) else default.removesuffix(tail)
        for end, tail, default in zip(
            request.remapped(*topics), ("/pose", "/cmd_vel"), topics.values(), strict=True
        )
    )
    return Mimic(request.world, request.name, leader=leader, copy=copy)


def _robot_of(request: NodeRequest) -> "Robot | None":
    """Return the robot model for a node that publishes joint states or transforms of links.

    The model comes from the parameter robot_description, or from the URDF file whose path is the
    first argument. Return None without parameter and argument.

    Raises:
        UsageError: If the robot description is not valid; the text lists the mistakes.
    """
    # Imported here, because few programs need a robot, and reading XML takes 10 ms.
    from tftool.robots.robot_model import load_urdf, parse_robot

    text = request.text("robot_description", "")
    if text:
        return parse_robot(text, f"robot_description of {request.name}")
    if request.arguments:
        return load_urdf(request.arguments[0])
    return None


def _robot_state_publisher(request: NodeRequest) -> Node:
    robot = _robot_of(request)
    if robot is None:
        raise UsageError(
            "robot_state_publisher needs the parameter robot_description, the text of a URDF, "
            "or the name of a URDF file as its argument"
        )
    return RobotStatePublisher(
        request.world,
        request.name,
        robot=robot,
        frame_prefix=request.text("frame_prefix", ""),
        publish_frequency=request.number("publish_frequency", 20.0),
        ignore_timestamp=request.flag("ignore_timestamp", False),
        topics=request.remapped(JOINT_STATES, DESCRIPTION),
    )


def _joint_state_publisher(request: NodeRequest) -> Node:
    positions = {
        name.removeprefix("zeros."): request.number(name, 0.0)
        for name in list(request.parameters)
        if name.startswith("zeros.")
    }
    sources = request.parameters.pop("source_list", [])
    if not isinstance(sources, list) or not all(isinstance(one, str) for one in sources):
        raise UsageError(f"parameter 'source_list' must be a list of topics, not {sources!r}")
    return JointStatePublisher(
        request.world,
        request.name,
        robot=_robot_of(request),
        positions=positions,
        rate=request.number("rate", 10.0),
        sources=request.remapped(*sources),
        topics=request.remapped(JOINT_STATES, DESCRIPTION),
    )


TURTLE_TF_PACKAGES = ("turtle_tf2_py", "turtle_tf2_cpp")
"""Packages of ROS's tf2 tutorials with turtles."""


def _plain(kind: Callable[[World, str], Node]) -> Callable[[NodeRequest], Node]:
    return lambda request: kind(request.world, request.name)


_TURTLE_TF: dict[str, tuple[str, Callable[[NodeRequest], Node]]] = {
    "turtle_tf2_broadcaster": ("turtle_tf2_frame_publisher", _broadcaster),
    "turtle_tf2_listener": ("turtle_tf2_frame_listener", _follower),
    "fixed_frame_tf2_broadcaster": ("fixed_frame_tf2_broadcaster", _plain(FixedCarrot)),
    "dynamic_frame_tf2_broadcaster": ("dynamic_frame_tf2_broadcaster", _plain(DynamicCarrot)),
    "static_turtle_tf2_broadcaster": ("static_turtle_tf2_broadcaster", _static_turtle),
    "turtle_tf2_message_broadcaster": (
        "turtle_tf2_message_broadcaster",
        _plain(MessageBroadcaster),
    ),
    "turtle_tf2_message_filter": (
        "turtle_tf2_pose_drawer",
        lambda a: PointDrawer(a.world, a.name, target_frame=a.text("target_frame", "turtle1")),
    ),
}

# By package and executable: the node's default name, and the function that creates the node.
_OURS: dict[tuple[str, str], tuple[str, Callable[[NodeRequest], Node]]] = {
    ("turtlesim", "turtlesim_node"): ("turtlesim", _turtlesim),
    ("turtlesim", "draw_square"): ("draw_square", _plain(DrawSquare)),
    ("turtlesim", "mimic"): ("turtle_mimic", _mimic),
    ("robot_state_publisher", "robot_state_publisher"): (
        "robot_state_publisher",
        _robot_state_publisher,
    ),
    ("joint_state_publisher", "joint_state_publisher"): (
        "joint_state_publisher",
        _joint_state_publisher,
    ),
    ("tf2_ros", "static_transform_publisher"): ("static_transform_publisher", _static_publisher),
    **{(one, name): made for one in TURTLE_TF_PACKAGES for name, made in _TURTLE_TF.items()},
}

COMMANDS = {
    ("tf2_ros", "tf2_echo"): ("echo",),
    ("tf2_ros", "tf2_monitor"): ("monitor",),
    ("tf2_tools", "view_frames"): ("tree", "--format", "pdf", "-o", "frames.pdf", "--force"),
    ("rqt_tf_tree", "rqt_tf_tree"): ("tree", "--watch"),
    ("rviz2", "rviz2"): ("view",),
    ("launch_testing", "launch_test"): ("ros2", "test"),
}
"""ROS executables, as (package, name), that `tftool run` replaces by a command of tftool."""

# Executables that tftool replaces by a command that needs a terminal of its own
_ELSEWHERE = {
    ("turtlesim", "turtle_teleop_key"): "tftool teleop",
    **{names: shlex.join(("tftool", *words)) for names, words in COMMANDS.items()},
    ("joint_state_publisher_gui", "joint_state_publisher_gui"): "tftool robot FILE",
}

OUR_PACKAGES = tuple(sorted({package for package, _ in _OURS}))


def names(workspace: Workspace) -> dict[tuple[str, str], Path | None]:
    """Return a mapping from each (package, executable) that tftool can start to its Python file.

    The file is None for tftool's built-in nodes.
    """
    found: dict[tuple[str, str], Path | None] = dict.fromkeys(_OURS)
    for package in workspace.packages.values():
        found |= {(package.name, name): file for name, file in package.programs.items()}
        found |= {(package.name, name): package.path_of_script(name) for name in package.scripts}
    return found


@dataclass(frozen=True, slots=True)
class FoundExecutable:
    """Executable that `start` can start: a user's Python program, or one of tftool's nodes.

    Attributes:
        body: Function that runs the user's program; None for one of tftool's nodes.
        file: The user's Python file; None for one of tftool's nodes.
        ours: Default name of tftool's node, and the function that creates the node; None for a
            user's program.
    """

    body: Callable[[], None] | None = None
    file: Path | None = None
    ours: tuple[str, Callable[[NodeRequest], Node]] | None = None


def find(workspace: Workspace, package: str | None, executable: str) -> FoundExecutable:
    """Find an executable; if the executable is a Python file, also compile the file.

    Args:
        workspace: Workspace of users' packages, searched first.
        package: Name of the package; None for a file.
        executable: Name of the program in the package, or path of the file.

    Raises:
        HasItsOwnCommand: If the program needs a terminal of its own.
        UsageError: If there is no such package or executable; the text has the nearest name.
        InputError: If the file cannot be read or is not valid Python.
    """
    # As in a sourced workspace, each package can import the others.
    importing.search_last(workspace.module_folders)
    if package is None:
        return FoundExecutable(user_code.file_body(Path(executable)), Path(executable))
    found = workspace.packages.get(package)
    if found is not None and executable in found.scripts:
        module, _, function = found.scripts[executable].partition(":")
        file = found.path.joinpath(*module.split(".")).with_suffix(".py")
        body = user_code.entry_point_body(module, function or "main", root=found.path)
        return FoundExecutable(body, file)
    if found is not None and (script := found.script_file(executable)) is not None:
        return FoundExecutable(user_code.file_body(script), script)
    if (package, executable) in _OURS:
        return FoundExecutable(ours=_OURS[package, executable])
    elsewhere = _ELSEWHERE.get((package, executable))
    if elsewhere is not None:
        raise HasItsOwnCommand(
            f"'{package} {executable}' needs a terminal of its own: run '{elsewhere}' in another "
            "terminal."
        )
    if found is not None and found.is_compiled(executable):
        options = " or ".join(flag for reach in REACHES if reach.is_robots for flag in reach.FLAGS)
        raise UsageError(
            f"'{package} {executable}' is compiled from C++, so tftool cannot run it: run it with "
            f"ROS 2, and connect to it by tftool's option {options}"
        )
    known = [name for one, name in _OURS if one == package]
    known += [*found.scripts, *found.programs] if found is not None else []
    if not known and found is None:
        raise UsageError(missing_package(package, workspace, OUR_PACKAGES))
    hint = did_you_mean(executable, known)
    raise UsageError(
        f"package '{package}' has no executable '{executable}'{hint} "
        f"(it has {', '.join(sorted(known)) or 'none'})"
    )


def start(
    world: World,
    executable: FoundExecutable,
    *,
    label: str,
    argv: Sequence[str],
    arguments: Sequence[str],
    options: RosOptions,
    on_exit: Callable[[Program], object] | None = None,
) -> Node:
    """Start an executable in a world.

    Args:
        world: World to join.
        executable: The executable.
        label: Name of the program in log lines, such as "listener-4".
        argv: The program's whole `sys.argv`.
        arguments: The program's arguments, without the part after `--ros-args`.
        options: Options of `--ros-args`.
        on_exit: Function called when a user's program has ended.

    Raises:
        UsageError: If one of tftool's nodes rejects its arguments or parameters.
    """
    if executable.ours is not None:
        return _start_ours(world, executable.ours, arguments, options)
    return Program(world, label, executable.body, argv=argv, options=options, on_exit=on_exit)


def _start_ours(
    world: World,
    ours: tuple[str, Callable[[NodeRequest], Node]],
    arguments: Sequence[str],
    options: RosOptions,
) -> Node:
    default, make = ours
    name = options.name or default
    namespace = (options.namespace or "").strip("/")
    full = world.free_name(join(namespace, name))
    parameters = options.parameters_for(name, namespace)
    declared = dict(parameters)
    node = make(NodeRequest(world, full, namespace, arguments, parameters, options))
    if full in world.far_nodes:
        node.warn(named_twice(full))
    if parameters.pop("use_sim_time", None) is True and not world.has_own_time:
        # Time 0 until the first message, as in ROS.
        clock = node.clock = FollowedClock(0)
        kind: Any = INTERFACES.message("rosgraph_msgs/Clock")
        node.subscribe("clock", kind, lambda message: clock.tell(values.stamp_of(message.clock)))
        warn_without_clock(world, node.warn)
    _warn_of_unused(node, parameters, declared)
    return node


def _warn_of_unused(node: Node, unused: Mapping[str, Any], given: Mapping[str, Any]) -> None:
    known = [*node.parameters.values(), *(set(given) - set(unused)), "turtlename", "target_frame"]
    for name in unused:
        node.warn(undeclared(name, known))
