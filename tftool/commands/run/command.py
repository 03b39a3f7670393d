"""Implementation of `tftool run`: run a user's node without ROS."""

import itertools
import shlex
from collections.abc import Sequence
from pathlib import Path

from typer.models import Context

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible, visible_lines
from tftool.commands.run import RunOptions
from tftool.commands.shared.connection import NO_SESSION, Connection
from tftool.commands.shared.declaration import Invocation
from tftool.commands.shared.hosting import (
    open_empty_session,
    open_own_session,
    open_session,
    tell_where_to_look,
)
from tftool.commands.shared.notices import notice, tell_log
from tftool.commands.shared.options import refuse_long_simulation
from tftool.commands.teleop import TeleopOptions
from tftool.commands.teleop.command import run as drive
from tftool.ros import running
from tftool.ros.host import executables
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace, is_file, use_workspace

ROBOTS = ("robot_state_publisher", "joint_state_publisher")
"""Packages whose nodes publish a robot."""


KEYBOARD = ("turtlesim", "turtle_teleop_key")
"""Package and executable of ROS that `tftool teleop` replaces."""


SIMULATED = "Simulated time cannot be shared in a session"


def _check_words(connection: Connection, target: str, words: Sequence[str]) -> None:
    """Print hints about words after FILE that look like options of `tftool run` or of ROS 2.

    Args:
        connection: Connection of the command.
        target: File or package on the command line.
        words: Words after FILE, which are passed to the node.

    Raises:
        UsageError: If --simulated or --for is after FILE, where tftool would ignore the option. If
            the program's text contains the option, the option is meant for the program.
    """
    own_words, file = _own_words(words), Path(target)
    given = [word for word in ("--simulated", "--for") if word in own_words]
    text = file.read_text(encoding="utf-8", errors="replace") if given and file.is_file() else None
    if text is not None and not any(f"{q}{word}{q}" in text for word in given for q in "'\""):
        raise UsageError(
            f"put {' and '.join(given)} before FILE: words after FILE are passed to the program. "
            "To pass these words to the program, write 'tftool run FILE -- WORDS'."
        )
    params = _context(connection).command.params
    options = {name for option in params for name in option.opts if name.startswith("--")}
    for before, word in itertools.pairwise(["", *own_words]):
        option = word.partition("=")[0]
        if option in options:
            notice(
                f"'{visible(option)}' after FILE is passed to the node: "
                "write tftool's own options before FILE."
            )
        elif before in ("-p", "-r", "--param", "--remap") and ":=" in word:
            notice(
                f"'{before} {visible(word)}' is passed to the node unchanged: "
                "write ROS 2's arguments after --ros-args."
            )


def _own_words(words: Sequence[str]) -> list[str]:
    """Return the words before `--ros-args` or `--`."""
    return list(itertools.takewhile(lambda word: word not in ("--ros-args", "--"), words))


def _run_other(
    connection: Connection, target: str, words: list[str], *, refused: bool
) -> int | None:
    """Run the tftool command that replaces a ROS program; return its exit status.

    Args:
        connection: Connection of the command.
        target: File or package on the command line.
        words: Words after the file or package.
        refused: Whether options were given that only nodes accept.

    Returns:
        The exit status; None if no command replaces this program.

    Raises:
        UsageError: If a command replaces the program, but options that only nodes accept were
            given.
    """
    if (target, *words[:1]) == KEYBOARD:
        if refused:
            raise UsageError(
                "'turtlesim turtle_teleop_key' reads keys until q is pressed, not for a set "
                "time: leave out --in, --for and --simulated, which are only allowed for nodes"
            )
        return drive(connection, TeleopOptions(turtle=running.driven_turtle(words[1:])))
    command = executables.COMMANDS.get((target, "".join(words[:1])))
    if command is None:
        return None
    if refused:
        raise UsageError(
            f"'{target} {words[0]}' is replaced by 'tftool {shlex.join(command)}': leave out --in, "
            "--for and --simulated, which are only allowed for nodes"
        )
    return _run_command(connection, [*command, *_own_words(words[1:])])


def _run_command(connection: Connection, words: list[str]) -> int:
    """Print and run another tftool command, in the same session.

    Raises:
        UsageError: If options for a connection to other machines were given; the error text says to
            give these options to the other command.
    """
    if connection.reach.is_asked:
        raise UsageError(
            "tftool run does not pass on options of the session: give these options to 'tftool "
            f"{shlex.join(words)}'"
        )
    if connection.domain:
        words += ["--domain", str(connection.domain)]
    notice(f"Without ROS this is 'tftool {visible(shlex.join(words))}'.")
    invocation: Invocation = _context(connection).obj
    return invocation.run(words)


def _context(connection: Connection) -> Context:
    assert connection.context is not None
    return connection.context


def run(connection: Connection, options: RunOptions) -> int:
    """Run `tftool run`: run a user's node, and return its exit status."""
    if options.simulated and options.run_for is None:
        raise UsageError("--simulated needs a duration: add --for SECONDS")
    if options.simulated:
        refuse_long_simulation(options.run_for)
    words = list(options.rest or [])
    if words:
        _check_words(connection, options.target, words)
    workspace = Workspace(Path.cwd(), Path(options.target))
    for skipped in workspace.skipped if options.verbose else ():
        notice(visible_lines(skipped))
    is_of_nodes = options.place is not None or options.simulated or options.run_for is not None
    if not is_file(options.target) and options.target not in workspace.packages:
        status = _run_other(connection, options.target, words, refused=is_of_nodes)
        if status is not None:
            return status
    # These nodes need an empty world, without the turtles of a default one.
    simulator = (options.target, *words[:1]) == ("turtlesim", "turtlesim_node")
    alone = simulator or (options.target in ROBOTS and options.place is None)
    with ros_free(force=options.force, simulated=options.simulated) as finder:
        use_workspace(workspace)
        found = running.find_program(workspace, options.target, words)
        file = found.executable.file if found.package is not None else None
        if file is not None and (unfound := running.reason_not_found(workspace, file)):
            notice(visible(unfound))
        if alone:
            session = open_empty_session(connection, simulated=options.simulated)
        elif options.place is not None:
            simulated = options.simulated
            session = open_session(connection, options.place, simulated=simulated, head_start=0)
        else:
            because = SIMULATED if options.simulated else NO_SESSION
            session = open_own_session(connection, simulated=options.simulated, because=because)
        connection.tell_read_only()
        tell_where_to_look(connection, session)
        world = session.world
        tell_log(world)
        turtles = running.TurtlesOnDemand(world)
        on_demand = options.place is None and not alone and not connection.only_observes
        if on_demand:
            finder.on_import |= dict.fromkeys(running.TURTLE_PACKAGES, turtles.host_from_program)
            if session.is_hosted:
                world.watch(turtles.host_for_topics)
        ending = running.Ending()

        async def work() -> None:
            if on_demand and options.target in running.TURTLE_PACKAGES:
                turtles.host()
            running.start_program(world, found, on_exit=ending)
            await running.until(world, ending.over, options.run_for)

        session.run(work())
        for sentence in running.advice(world) if options.simulated else ():
            notice(visible(sentence))
        return running.status_of(ending.program)
