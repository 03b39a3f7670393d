"""`tftool launch`: launch files without ROS."""

from typing import Annotated

import typer

from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.connection import Connection, Mode
from tftool.commands.shared.options import (
    RosFree,
    RunFor,
    Simulated,
    SkippedFolders,
    option,
    refuse_long_simulation,
)


def launch(
    connection: Connection,
    words: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE|PACKAGE [FILE] [NAME:=VALUE]…",
            help="A launch file, or a package and its launch file; then arguments.",
        ),
    ],
    show_args: Annotated[
        bool, option("Show what the file takes.", "-s", "--show-args", "--show-arguments")
    ] = False,
    force: RosFree = False,
    run_for: RunFor = None,
    simulated: Simulated = False,
    verbose: SkippedFolders = False,
) -> ExitStatus:
    """Launch what a ROS 2 launch file says, without ROS (ros2 launch).

    The file may be Python, XML or YAML. Packages are looked for below this folder, or in
    the src it belongs to; nothing is built. turtlesim and turtle_tf2_py are tftool's own.

    tftool launch pkg_tf turtle_following.launch.py source_frame:=carrot1
    tftool launch turtle_tf2_py turtle_tf2_demo.launch.py --for 10
    tftool launch launch/turtle_following.launch.xml --show-args
    """
    import sys

    from tftool.base.errors import NodeFailed, TftoolError, UsageError
    from tftool.base.escaping import visible_lines
    from tftool.commands.shared.hosting import open_empty_session, open_session, tell_where_to_look
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.programs import tell_log, workspace_here
    from tftool.ros import running
    from tftool.ros.host.importing import ros_free
    from tftool.ros.launch import packages
    from tftool.ros.launch.engine import Launch

    if simulated and run_for is None and not show_args:
        raise UsageError("on simulated time a launch needs an end: --for SECONDS")
    if simulated:
        refuse_long_simulation(run_for)
    workspace = workspace_here(verbose=verbose)
    with ros_free(force=force):
        packages.use(workspace)
        path, rest = running.find_launch_file(workspace, words)
        arguments = running.arguments_of(rest)
        if show_args:
            sys.stdout.write(visible_lines(running.show_arguments(path, workspace)) + "\n")
            return ExitStatus.DONE
        if connection.mode is Mode.JOIN and not simulated:
            session = open_session(connection, head_start=0)
        else:
            # It brings all there is to it, and shares a session that runs all the same.
            session = open_empty_session(connection, simulated=simulated)
        connection.tell_read_only()
        world = session.world

        def say(level: str, who: str, text: str) -> None:
            line = f"[{level}] [{who}]: {text}" if level else f"[{who}] {text}"
            notice(visible_lines(line))

        try:
            started = Launch(world, path, workspace=workspace, arguments=arguments, say=say)
        except BaseException:
            session.abandon()
            raise
        tell_where_to_look(connection, session)
        tell_log(world, started.label_of)
        try:
            work = running.until(world, started.ended, run_for)
            session.run(work, on_interrupt=started.interrupt)
        except NodeFailed as failure:
            # What the launch itself could not do is no failed node.
            if failure.node == started.name and isinstance(failure.__cause__, TftoolError):
                raise failure.__cause__ from None
            raise
        return ExitStatus.FAILED if started.failed else ExitStatus.DONE
