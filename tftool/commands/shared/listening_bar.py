"""A bar on stderr while a session is listened to, above what shows so far."""

import threading
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Self, TypeAlias

from rich.console import Console, Group
from rich.live import Live
from rich.progress import BarColumn, Progress, TextColumn
from rich.text import Text

from tftool.base.short_numbers import count
from tftool.base.stamps import Duration, as_seconds
from tftool.world.clock import WallClock

if TYPE_CHECKING:
    from tftool.frames.frames import Frames

Look: TypeAlias = "Callable[[Frames], Sequence[Text]]"

_SHARE = 4
"""How many times as long as a look took the next one is put off."""


class ListeningBar:
    """Progress bar of a session, with lines below it; erased at the end.

    It is called in another thread than the one that waits for its end.
    """

    def __init__(self, lasting: float, look: "Look | None") -> None:
        """Start without a bar.

        Args:
            lasting: How long the session is listened to, seconds.
            look: Returns lines about the findings so far.
        """
        self._lasting = lasting
        self._look = look
        self._lines: Sequence[Text] = ()
        self._clock = WallClock()
        self._next = self._clock.now()
        self._console = Console(stderr=True)
        self._progress = Progress(
            TextColumn("Listening"),
            BarColumn(),
            TextColumn("{task.completed:.1f} of {task.total:g} s"),
            TextColumn("{task.description}"),
            console=self._console,
            auto_refresh=False,
        )
        self._task = self._progress.add_task("", total=lasting)
        self._live = Live(
            console=self._console,
            transient=True,
            auto_refresh=False,
            redirect_stdout=False,
            redirect_stderr=False,
        )
        self._lock = threading.Lock()
        self._is_over = False

    def __enter__(self) -> Self:
        self._live.start()
        # A signal may end the process at once: the cursor must be there then.
        self._console.show_cursor(True)
        self._draw()
        return self

    def __exit__(self, *error: object) -> None:
        # A look may be under way in its thread.
        with self._lock:
            self._is_over = True
            self._live.stop()

    def __call__(self, frames: "Frames", since: Duration) -> None:
        """Show how far it is, and look at what was heard."""
        transforms = 0 if frames.log is None else len(frames.log)
        self._progress.update(
            self._task,
            completed=min(as_seconds(since), self._lasting),
            description=count(transforms, "transform"),
        )
        began = self._clock.now()
        if self._look is not None and transforms and began >= self._next:
            self._lines = self._look(frames)
            now = self._clock.now()
            self._next = now + _SHARE * (now - began)
        self._draw()

    def _draw(self) -> None:
        # Lines that do not fit would scroll, and could not be erased.
        room = max(self._console.height - 3, 0)
        shown = [*self._lines[:room]]
        if len(self._lines) > room:
            shown[-1:] = [Text(f"… and {len(self._lines) - room + 1} more", "dim")]
        for line in shown:
            line.no_wrap, line.overflow = True, "ellipsis"
        with self._lock:
            if not self._is_over:
                self._live.update(Group(self._progress, *shown), refresh=True)
