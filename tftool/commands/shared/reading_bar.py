"""A bar on stderr while a large file is read or written."""

import os
import signal
import sys
import threading
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from tftool.base.stamps import seconds
from tftool.world.clock import WallClock

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    from rich.progress import Progress, TaskID

PATIENCE = seconds(0.5)
"""How long reading goes on before a bar shows."""

_REDRAWN = seconds(0.1)


class Bar:
    """Progress bar on stderr, if that is a terminal, shown after half a second."""

    def __init__(self, what: str) -> None:
        """Start without a bar.

        Args:
            what: Text in front of the bar, fit for a terminal.
        """
        self._what = what
        self._clock = WallClock()
        self._since = self._drawn = self._clock.now()
        self._progress: Progress | None = None
        self._task: TaskID | None = None
        self._handlers: dict[int, Any] = {}

    def __call__(self, done: int, total: int) -> None:
        """Show the progress: bytes, rate, time left."""
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
        from rich.console import Console
        from rich.markup import escape
        from rich.progress import (
            BarColumn,
            DownloadColumn,
            Progress,
            TextColumn,
            TimeRemainingColumn,
            TransferSpeedColumn,
        )

        self._progress = Progress(
            TextColumn(escape(self._what)),
            BarColumn(),
            DownloadColumn(),
            TransferSpeedColumn(),
            TimeRemainingColumn(),
            console=Console(stderr=True),
            transient=True,
            auto_refresh=False,
            # Nothing else is printed meanwhile.
            redirect_stdout=False,
            redirect_stderr=False,
        )
        # Drawn as it starts, and shown until the next round: with how far it is by now.
        self._task = self._progress.add_task("", completed=done, total=total)
        self._progress.start()
        # A signal ends the process at once: what it leaves behind must be as it was.
        self._progress.console.show_cursor(True)
        self._erase_when_killed()

    def _erase_when_killed(self) -> None:
        """Erase the bar before a signal ends the process."""
        if threading.current_thread() is not threading.main_thread():
            return
        for number in (signal.SIGINT, signal.SIGTERM):
            before = signal.getsignal(number)
            if not callable(before):
                continue

            def leave(
                number: int,
                frame: "FrameType | None",
                before: "Callable[[int, FrameType | None], object]" = before,
            ) -> None:
                # Past Python's own buffer, which the signal may have met in the middle of a write.
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
