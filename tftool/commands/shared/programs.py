"""Parts shared by commands that run users' programs: their packages and their log."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.plain_text import visible_lines
from tftool.commands.shared.notices import notice, tell_record
from tftool.ros.host.workspace import Workspace

if TYPE_CHECKING:
    from tftool.world.log import LogRecord
    from tftool.world.world import World


def workspace_here(*, verbose: bool) -> Workspace:
    """Return the packages below this folder, or in the workspace's src that contains it.

    Args:
        verbose: Whether to tell of folders that are skipped, and why.
    """
    workspace = Workspace(Path.cwd())
    for skipped in workspace.skipped if verbose else ():
        notice(visible_lines(skipped))
    return workspace


def tell_log(world: "World", label_of: "Callable[[LogRecord], str] | None" = None) -> None:
    """Print a world's log from now on.

    Args:
        world: The world.
        label_of: Returns the name of a line's program, if there are several.
    """

    def tell(record: "LogRecord") -> None:
        # What the link has to say the session tells.
        if record.node != "link":
            tell_record(record, label="" if label_of is None else label_of(record))

    world.log.listen(tell, "console")
