"""`tftool launch`: launch files without ROS."""

from typing import TYPE_CHECKING, Annotated

import typer

from tftool.cli.options import positive, simulated_seconds
from tftool.stamps import seconds

if TYPE_CHECKING:
    from tftool.runtime.log import LogRecord


def launch(
    words: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE|PACKAGE [FILE] [NAME:=VALUE]…",
            help="A launch file, or a package and its launch file; then arguments.",
        ),
    ],
    show_args: Annotated[
        bool,
        typer.Option("-s", "--show-args", "--show-arguments", help="Show what the file takes."),
    ] = False,
    insist: Annotated[
        bool, typer.Option("--ros-free", help="Also where a real ROS 2 is sourced.")
    ] = False,
    run_for: Annotated[
        float | None,
        typer.Option("--for", metavar="SECONDS", callback=positive, help="Stop after so long."),
    ] = None,
    simulated: Annotated[
        bool, typer.Option("--simulated", help="On simulated time: at once, the same every time.")
    ] = False,
) -> int:
    """Launch what a ROS 2 launch file says, without ROS (ros2 launch).

    The file may be Python, XML or YAML. Packages are looked for below this folder, or in
    the src it belongs to; nothing is built. turtlesim and turtle_tf2_py are tftool's own.

    tftool launch pkg_tf turtle_following.launch.py source_frame:=carrot1
    tftool launch turtle_tf2_py turtle_tf2_demo.launch.py --for 10
    tftool launch launch/turtle_following.launch.xml --show-args
    """
    import sys
    from pathlib import Path

    from tftool.cli import console_log
    from tftool.cli.notices import notice
    from tftool.cli.session import open_empty_session, open_session
    from tftool.cli.sharing import Mode, choice, tell_read_only
    from tftool.errors import NodeFailed, TftoolError, UsageError
    from tftool.ros import hosting
    from tftool.runtime.clock import SimClock
    from tftool.views.escaping import visible_lines

    if simulated and run_for is None and not show_args:
        raise UsageError("on simulated time a launch needs an end: --for SECONDS")
    if simulated:
        simulated_seconds(run_for)
    workspace = hosting.Workspace(Path.cwd())
    with hosting.ros_free(insist=insist):
        hosting.packages.use(workspace)
        path, rest = hosting.find_launch_file(workspace, words)
        arguments = hosting.arguments_of(rest)
        if show_args:
            sys.stdout.write(visible_lines(hosting.show_arguments(path, workspace)) + "\n")
            return 0
        if choice().mode is Mode.JOIN and not simulated:
            session = open_session(head_start=0)
        else:
            # It brings all there is to it, and shares a session that runs all the same.
            session = open_empty_session(SimClock() if simulated else None)
        tell_read_only()
        world = session.world

        def say(level: str, who: str, text: str) -> None:
            line = f"[{level}] [{who}]: {text}" if level else f"[{who}] {text}"
            notice(visible_lines(line))

        try:
            started = hosting.Launch(world, path, workspace=workspace, arguments=arguments, say=say)
        except BaseException:
            session.abandon()
            raise

        def tell(record: "LogRecord") -> None:
            # What the link has to say the session tells.
            if record.node != "link":
                console_log.tell(record, label=started.label_of(record))

        world.log.listen(tell)
        try:
            limit = None if run_for is None else seconds(run_for)
            work = hosting.until(world, started.ended, limit)
            session.run(work, on_interrupt=started.interrupt)
        except NodeFailed as failure:
            # What the launch itself could not do is no failed node.
            if failure.node == started.name and isinstance(failure.__cause__, TftoolError):
                raise failure.__cause__ from None
            raise
        return 1 if started.failed else 0
