"""`tftool ros2`: the words of ROS 2's own command line, over our sessions."""

from typing import TYPE_CHECKING, Annotated

import typer

from tftool.commands.shared.options import RunFor, option

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from tftool.commands.shared.connection import Connection

_ELSEWHERE = {
    "run": "run",
    "launch": "launch",
    "bag info": "info",
    "bag play": "play",
    "bag record": "record",
    "bag convert": "edit",
    "doctor": "doctor",
    "wtf": "doctor",
    "pkg create": "new",
}
"""Words of ROS 2's command line that are commands of their own."""


def ros2(
    connection: "Connection",
    words: Annotated[
        list[str],
        typer.Argument(metavar="COMMAND VERB …", help="What stands behind ros2 with ROS."),
    ],
    place: Annotated[
        str | None, option("World to host: a scenario's name or file.", "--in", metavar="SCENARIO")
    ] = None,
    run_for: RunFor = None,
) -> int:
    """Ask a session in the words of ROS 2's command line, without ROS.

    topic list, echo, hz, info, type, pub; service list, type, call; param list, get, set, dump;
    node list, info; action list, send_goal; interface show; pkg list. The options of each are
    those of ROS 2. Options of this command go before COMMAND.

    tftool ros2 topic list
    tftool ros2 service call /spawn turtlesim/srv/Spawn "{x: 2, y: 2, theta: 0.2, name: ''}"
    tftool ros2 topic pub /turtle1/cmd_vel geometry_msgs/msg/Twist "{linear: {x: 2.0}}"
    """
    from pathlib import Path

    from tftool.base.errors import NodeFailed, TftoolError, UsageError
    from tftool.commands.shared.hosting import NO_SESSION, open_session
    from tftool.commands.shared.notices import tell_record
    from tftool.ros import ros2 as ros2_command
    from tftool.ros import running
    from tftool.ros.host import user_code
    from tftool.ros.host.program import Program
    from tftool.ros.host.workspace import Workspace

    for length in (2, 1):
        asked = " ".join(words[:length])
        if asked in _ELSEWHERE:
            raise UsageError(f"'ros2 {asked}' is 'tftool {_ELSEWHERE[asked]}' here.")
    workspace = Workspace(Path.cwd())
    body = ros2_command.body(words, workspace, typer.echo)
    if words[0] in ("interface", "pkg"):
        body()
        return 0
    session = open_session(connection, place, needs_messages=True, because=NO_SESSION)
    world = session.world
    world.log.listen(
        lambda record: tell_record(record) if record.level in ("WARN", "ERROR") else None, "console"
    )
    ending = running.Ending(world)

    async def work() -> None:
        Program(world, world.free_name("ros2"), user_code.whole(body), argv=words, on_exit=ending)
        await running.until(world, ending.over, run_for)

    session.run(work())
    try:
        return ending.judge()
    except NodeFailed as failed:
        # No program of the user's has failed: what was named is not there.
        if isinstance(failed.__cause__, UsageError):
            raise TftoolError(str(failed.__cause__)) from failed
        raise


def verbs_of(words: "Sequence[str]") -> "Collection[str]":
    """What there is of ROS 2's commands; behind one of them, its verbs."""
    from tftool.ros.host import ros2_words

    verbs = ros2_words.verbs()
    return verbs.get(words[0], []) if words else verbs
