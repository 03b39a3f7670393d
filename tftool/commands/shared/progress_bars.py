"""Progress bars on stderr for reading, writing and listening; and interruption by Ctrl-C."""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TYPE_CHECKING, Any, Self, TypeAlias

from rich.console import Console, Group
from rich.live import Live
from rich.markup import escape
from rich.progress import (
    BarColumn,
    DownloadColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
    TransferSpeedColumn,
)
from rich.text import Text

from tftool.base.plain_text import count
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.world.clock import WallClock

if TYPE_CHECKING:
    from tftool.frames.frames import Frames


PATIENCE = seconds(0.5)
"""Nanoseconds of reading before the bar is shown."""

_REDRAWN = seconds(0.1)


class Bar:
    """Progress bar on stderr; shown after half a second, and only on a terminal."""

    def __init__(self, title: str) -> None:
        """Prepare the bar without showing it.

        Args:
            title: Text in front of the bar, without control characters.
        """
        self._what = title
        self._clock = WallClock()
        self._since = self._drawn = self._clock.now()
        self._progress: Progress | None = None
        self._task: TaskID | None = None
        self._handlers: dict[int, Any] = {}

    def __call__(self, done: int, total: int) -> None:
        """Show `done` of `total` bytes, the rate and the remaining time."""
        now = self._clock.now()
        if now - self._since < PATIENCE or now - self._drawn < _REDRAWN or not sys.stderr.isatty():
            return
        self._drawn = now
        if self._progress is None:
            self._begin(done, total)
        assert self._progress is not None
        assert self._task is not None
        self._progress.update(self._task, completed=done, total=total)
        self._progress.refresh()

    def _begin(self, done: int, total: int) -> None:
        self._progress = Progress(
            TextColumn(escape(self._what)),
            BarColumn(),
            DownloadColumn(),
            TransferSpeedColumn(),
            TimeRemainingColumn(),
            console=Console(stderr=True),
            transient=True,
            auto_refresh=False,
            # Nothing else is printed while the bar is shown.
            redirect_stdout=False,
            redirect_stderr=False,
        )
        # Starting draws the bar, so the progress must be set before.
        self._task = self._progress.add_task("", completed=done, total=total)
        self._progress.start()
        # A signal may end the process at once, so the cursor must be visible.
        self._progress.console.show_cursor(True)
        self._erase_when_killed()

    def _erase_when_killed(self) -> None:
        """Install signal handlers that erase the bar before SIGINT or SIGTERM ends the process."""
        if threading.current_thread() is not threading.main_thread():
            return
        for number in (signal.SIGINT, signal.SIGTERM):
            before = signal.getsignal(number)
            if not callable(before):
                continue

            def leave(
                number: int,
                frame: FrameType | None,
                before: Callable[[int, FrameType | None], object] = before,
            ) -> None:
                # Not through Python's buffer: the signal may have interrupted a write to it.
                with suppress(OSError):
                    os.write(2, b"\r\x1b[2K")
                before(number, frame)

            signal.signal(number, leave)
            self._handlers[number] = before

    def stop(self) -> None:
        """Erase the bar."""
        while self._handlers:
            signal.signal(*self._handlers.popitem())
        if self._progress is not None:
            self._progress.stop()
            self._progress = None


Look: TypeAlias = "Callable[[Frames], Sequence[Text]]"

_SHARE = 4
"""Pause between two calls of `look`, in multiples of the last call's duration."""


class ListeningBar:
    """Progress bar for listening to a session, with lines of text below; erased at the end.

    `__call__` runs in another thread than the code that enters and leaves the `with` block.
    """

    def __init__(self, lasting: float, look: "Look | None") -> None:
        """Prepare the bar without showing it.

        Args:
            lasting: Seconds to listen to the session.
            look: Function that returns lines about the findings so far; None for no lines.
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
        # A signal may end the process at once, so the cursor must be visible.
        self._console.show_cursor(True)
        self._draw()
        return self

    def __exit__(self, *error: object) -> None:
        # `look` may still be running in its thread.
        with self._lock:
            self._is_over = True
            self._live.stop()

    def __call__(self, frames: "Frames", since: Duration) -> None:
        """Show the progress, and the lines about the frames received so far."""
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
        # Lines that do not fit would scroll the screen, and could not be erased.
        room = max(self._console.height - 3, 0)
        shown = [*self._lines[:room]]
        if len(self._lines) > room:
            shown[-1:] = [Text(f"… and {len(self._lines) - room + 1} more", "dim")]
        for line in shown:
            line.no_wrap, line.overflow = True, "ellipsis"
        with self._lock:
            if not self._is_over:
                self._live.update(Group(self._progress, *shown), refresh=True)


@contextmanager
def interruptible() -> Iterator[None]:
    """Let SIGINT and SIGTERM raise `KeyboardInterrupt` within this block.

    For use outside an event loop, which has its own handlers.
    """
    if sys.platform == "win32" or threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, interrupt) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)
