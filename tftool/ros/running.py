"""Functions with which the commands `run` and `launch` run users' programs in a world."""

import asyncio
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tftool.base.errors import NodeFailed, UsageError
from tftool.base.stamps import Duration
from tftool.ros.host import executables, names, program
from tftool.ros.host.error_text import error_sentence
from tftool.ros.host.fibers import StuckError
from tftool.ros.host.installation import faults_about
from tftool.ros.host.program import Program
from tftool.ros.host.workspace import Workspace, file_of, is_file
from tftool.world.clock import Phase
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.world import World

KEYBOARD_NODE = "teleop_turtle"
"""Name of the node in which turtlesim's keyboard program runs."""

TURTLE_PACKAGES = ("turtlesim", "turtlesim_msgs", *executables.TURTLE_TF_PACKAGES)
"""Packages whose nodes and interfaces need a running turtlesim."""

TURTLE_TOPICS = frozenset(("turtle1/cmd_vel", "turtle1/pose", "turtle1/color_sensor"))
"""Topics of the first turtle: a program that uses one needs a turtlesim."""


@dataclass(frozen=True, slots=True)
class FoundProgram:
    """Program that a command line names, ready to be started.

    Attributes:
        package: Name of the package; None for a file.
        name: Name of the file without suffix, or of the executable.
        executable: The executable.
        argv: The program's `sys.argv`.
        arguments: The program's arguments, without the part after `--ros-args`.
        options: Options after `--ros-args`.
    """

    package: str | None
    name: str
    executable: executables.FoundExecutable
    argv: Sequence[str]
    arguments: Sequence[str]
    options: names.RosOptions


def find_program(workspace: Workspace, target: str, further_words: Sequence[str]) -> FoundProgram:
    """Find the Python file, or the executable of a package, that a command line names.

    Raises:
        UsageError: If no executable is given, if there is no such executable, or if the part
            after `--ros-args` is malformed.
        InputError: If the file cannot be read or is not valid Python.
    """
    if is_file(target):
        if ".launch." in Path(target).name:
            raise UsageError(f"'{target}' is a launch file: 'tftool launch {target}' runs it")
        path = file_of(workspace, target)
        found = executables.find(workspace, None, str(path))
        options, arguments = names.parse(further_words)
        return FoundProgram(None, path.stem, found, [target, *further_words], arguments, options)
    if not further_words or further_words[0].startswith("-"):
        package = workspace.packages.get(target)
        if package is None and Path(target).is_dir():
            raise UsageError(f"'{target}' is a folder: give a node's file, or PACKAGE EXECUTABLE")
        known = ", ".join(sorted(package.scripts)) if package is not None else ""
        hint = f" ({known})" if known else ""
        raise UsageError(
            f"write the name of an executable after package '{target}'.{hint} To run a file, give "
            "its path"
        )
    found = executables.find(workspace, target, further_words[0])
    options, arguments = names.parse(further_words[1:])
    return FoundProgram(target, further_words[0], found, further_words, arguments, options)


def start_program(
    world: World,
    found_program: FoundProgram,
    *,
    on_exit: Callable[[Program], object],
    name: str = "",
) -> None:
    """Start a Python file, or an executable of a package, as a program of a world.

    `on_exit` is called when a user's program has ended. If `name` is empty, the program and its
    node have the name of the file or the executable. An option `__node:=` after `--ros-args`
    renames the node.
    """
    found_program.options.name = found_program.options.name or name or None
    executables.start(
        world,
        found_program.executable,
        label=world.free_name(name or found_program.name),
        argv=found_program.argv,
        arguments=found_program.arguments,
        options=found_program.options,
        on_exit=on_exit,
    )


def reason_not_found(workspace: Workspace, file: Path) -> str:
    """Return a sentence with the first reason why ROS 2 would not find a node or launch file.

    Return "" if ROS 2 would find the file.
    """
    for name, package in workspace.packages.items():
        if file.is_relative_to(package.path):
            faults = faults_about(package, file, workspace.packages)
            more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
            told = f"ROS 2 would not find {file.name} or a part that it needs: "
            lists = f"; 'tftool check --as-ros {name}' lists all"
            return told + faults[0] + more + lists if faults else ""
    return ""


def driven_turtle(words: Sequence[str]) -> str:
    """Return the name of the turtle that turtle_teleop_key drives with the arguments `words`.

    turtle_teleop_key publishes on `turtle1/cmd_vel`, unless `--ros-args` remaps this topic.

    Raises:
        UsageError: If the arguments are malformed, or the topic is not the `cmd_vel` of a turtle.
    """
    options, _ = names.parse(words)
    namespace = (options.namespace or "").strip("/")
    given = names.expand("turtle1/cmd_vel", KEYBOARD_NODE, namespace)
    topic = options.remapped(given, options.name or KEYBOARD_NODE, namespace)
    turtle, _, last = topic.strip("/").rpartition("/")
    if last != "cmd_vel" or not turtle:
        raise UsageError(
            f"'{topic}' is not the cmd_vel topic of a turtle: write --remap "
            "turtle1/cmd_vel:=turtle2/cmd_vel"
        )
    return turtle


class TurtlesOnDemand:
    """Starter that adds a simulated turtlesim to a world when a program first needs turtles."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._is_asked = False

    def host_from_program(self) -> None:
        """Start turtlesim, unless the world already has one; call this in a program's thread."""
        program.current().ask(self.host)

    def host_for_topics(self) -> None:
        """Start turtlesim if a program uses a topic of the turtle `turtle1`."""
        if not self._is_asked and TURTLE_TOPICS & self._world.topics().keys():
            # Start turtlesim later, because the world is adding the topic at this moment.
            asyncio.get_running_loop().call_soon(self.host)

    def host(self) -> None:
        """Start turtlesim, unless the world has one; call this in the event loop's thread."""
        if self._is_asked:
            return
        self._is_asked = True
        if not self._world.has_service("spawn"):
            Turtlesim(self._world)


def advice(world: World) -> Iterator[str]:
    """Yield hints about the transform lookups of the programs in a world."""
    for one in world.nodes:
        if isinstance(one, Program):
            for sum_up in one.advice:
                if text := sum_up():
                    yield f"'{one.label}': {text}"


async def until(world: World, over: asyncio.Event, limit: Duration | None) -> None:
    """Wait until `over` is set, at most `limit` nanoseconds of the clock; None for no limit."""
    if limit is None:
        await over.wait()
        return
    end = world.clock.now() + limit
    world.clock.limit(end)
    waits: list[asyncio.Future[Any]] = [
        asyncio.ensure_future(over.wait()),
        world.clock.timer(end, Phase.WATCH),
    ]
    try:
        await asyncio.wait(waits, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for one in waits:
            one.cancel()


@dataclass
class Ending:
    """Callback for `on_exit`, which stores the ended program and sets the event `over`."""

    program: Program | None = None
    over: asyncio.Event = field(default_factory=asyncio.Event)

    def __call__(self, program: Program) -> None:
        """Store the program that has ended, and set the event `over`."""
        self.program = program
        self.over.set()


def status_of(program: Program | None) -> int:
    """Return the exit status of a program that has ended; 0 for None.

    Raises:
        NodeFailed: If the program raised an exception.
    """
    if program is None:
        return 0
    # A program that tftool asked to end has succeeded.
    is_stuck = isinstance(program.failure, StuckError)
    if not program.status or (program.fiber.interrupted and not is_stuck):
        return 0
    failure = program.failure
    if failure is None or isinstance(failure, SystemExit):
        return program.status
    raise ProgramFailed(program.label, failure) from failure


class ProgramFailed(NodeFailed):
    """Error for a program that raised an exception; the text has the line of the user's code."""

    def __init__(self, name: str, error: BaseException) -> None:
        super().__init__(name, error)
        self.args = (f"'{name}' failed: {error_sentence(error)}",)
