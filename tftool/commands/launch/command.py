"""Implementation of `tftool launch`: run launch files without ROS."""

import sys
from pathlib import Path

from tftool.base.errors import NodeFailed, TftoolError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible, visible_lines
from tftool.commands.launch import LaunchOptions
from tftool.commands.shared.connection import NO_SESSION, Connection, Mode
from tftool.commands.shared.hosting import open_empty_session, open_own_session, tell_where_to_look
from tftool.commands.shared.notices import notice, tell_log
from tftool.commands.shared.options import refuse_long_simulation
from tftool.ros import running
from tftool.ros.host.importing import ros_free
from tftool.ros.host.workspace import Workspace, use_workspace
from tftool.ros.launch.arguments import find_launch_file, parse_arguments, show_arguments
from tftool.ros.launch.engine import Launch


def run(connection: Connection, options: LaunchOptions) -> ExitStatus:
    """Run `tftool launch`: start the nodes of a launch file, or print its arguments."""
    if options.simulated and options.run_for is None and not options.show_args:
        raise UsageError("--simulated needs a duration: add --for SECONDS")
    if options.simulated:
        refuse_long_simulation(options.run_for)
    workspace = Workspace(Path.cwd(), Path(options.words[0]))
    for skipped in workspace.skipped if options.verbose else ():
        notice(visible_lines(skipped))
    with ros_free(force=options.force, simulated=options.simulated):
        use_workspace(workspace)
        path, rest = find_launch_file(workspace, options.words)
        if unfound := running.reason_not_found(workspace, path):
            notice(visible(unfound))
        arguments = parse_arguments(rest)
        if options.show_args:
            sys.stdout.write(visible_lines(show_arguments(path, workspace)) + "\n")
            return ExitStatus.DONE
        if connection.mode is Mode.JOIN and not options.simulated:
            session = open_own_session(connection, simulated=False, because=NO_SESSION)
        else:
            # A launch starts all nodes it needs: its world is empty at first, but still shared.
            session = open_empty_session(connection, simulated=options.simulated)
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
            work = running.until(world, started.ended, options.run_for)
            session.run(work, on_interrupt=started.interrupt)
            for sentence in running.advice(world) if options.simulated else ():
                notice(visible(sentence))
        except NodeFailed as failure:
            # An error of the launch itself is not reported as a failed node.
            if failure.node == started.name and isinstance(failure.__cause__, TftoolError):
                raise failure.__cause__ from None
            raise
        return ExitStatus.FAILED if started.failed else ExitStatus.DONE
