"""Pictures on the terminal that replace each other, between lines of output."""

import os
import sys
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.live import Live

    from tftool.world.clock import Clock


def can_redraw() -> bool:
    """Whether stdout is a terminal with a movable cursor."""
    return sys.stdout.isatty() and os.environ.get("TERM") != "dumb"


class Redrawing:
    """Drawer that replaces its last picture; lines on stderr go above it.

    Nothing is drawn, and the cursor is not moved, until the first picture.
    """

    def __init__(self, clock: "Clock") -> None:
        """Prepare to draw.

        Args:
            clock: When it is killed, the terminal gets its cursor back.
        """
        from rich.console import Console

        from tftool.commands.shared.suspend import left_while_stopped
        from tftool.world.stopper import leave_screen

        self.console: Console = Console()
        self._live: Live | None = None
        self._undo = clock.when_killed.add(leave_screen, "screen")
        self._stopping = left_while_stopped(self._leave, lambda: None)

    def show(self, picture: "RenderableType") -> None:
        """Draw in place of the last picture."""
        from rich.live import Live

        if self._live is None:
            # stderr that goes to a file goes on to the file.
            self._live = Live(
                console=self.console, auto_refresh=False, redirect_stderr=sys.stderr.isatty()
            )
            self._live.start()
        self._live.update(picture, refresh=True)

    def __enter__(self) -> Self:
        self._stopping.__enter__()
        return self

    def __exit__(self, *error: object) -> None:
        self._stopping.__exit__(None, None, None)
        self._leave()
        self._undo()

    def _leave(self) -> None:
        """Leave the last picture; the next one goes below it."""
        if self._live is not None:
            self._live.stop()
            self._live = None
