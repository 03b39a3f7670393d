"""Packages and log of users' programs, for the commands that run such programs."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.plain_text import visible_lines
from tftool.commands.shared.notices import notice, tell_record
from tftool.ros.host.workspace import Workspace

if TYPE_CHECKING:
    from tftool.world.log import LogRecord
    from tftool.world.world import World


def workspace_here(target: str, *, verbose: bool) -> Workspace:
    """Return the ROS packages below the current folder, or in the workspace around this folder.

    Args:
        target: File or package on the command line; packages near the file are preferred.
        verbose: Whether to print which folders are skipped, and why.
    """
    near = Path(target)
    workspace = Workspace(Path.cwd(), near if near.exists() else None)
    for skipped in workspace.skipped if verbose else ():
        notice(visible_lines(skipped))
    return workspace


def tell_log(world: "World", label_of: "Callable[[LogRecord], str] | None" = None) -> None:
    """Print a world's log messages from now on.

    Args:
        world: World whose log is printed.
        label_of: Function that returns the name of a message's program; None for a single program.
    """

    def tell(record: "LogRecord") -> None:
        # The session prints the connection's messages.
        if record.node != "link":
            tell_record(record, label="" if label_of is None else label_of(record))

    world.log.listen(tell, "console")
