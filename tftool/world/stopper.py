"""Stopper of a run, which works even while a node blocks the event loop.

A separate thread receives the signals and watches the loop, because a node that never awaits blocks
the loop. The first signal cancels the run. Code that does not end within two seconds is named on
stderr. The second signal ends the process. If a node blocks the loop beyond the end of the run, the
run is cancelled in the same way.
"""

import asyncio
import contextlib
import os
import signal
import socket
import sys
import threading
import weakref
from collections.abc import Callable, Iterable
from types import FrameType
from typing import Any, Final

from tftool.base.errors import is_users_file
from tftool.buffer.callbacks import Listeners

if sys.platform != "win32":
    import termios

PATIENCE: Final = 2.0
"""Real seconds that a node may take to end after it was cancelled."""

STANDSTILL: Final = 70.0
"""Real seconds for which a node may block simulated time, if the run ends at a simulated time.

More than the time that a user's program may take for an import.
"""

INTERRUPTED: Final = 130
FAILED: Final = 1
"""Exit status of a process that is ended while a node still runs."""

_SIGNALS: Final = (signal.SIGINT, signal.SIGTERM)
_MOST_NAMED = 3
_LEAVE_SCREEN = (
    b"\x1b[<u\x1b[?1000l\x1b[?1003l\x1b[?1015l\x1b[?1006l\x1b[?1004l\x1b[?2004l\x1b[?1049l\x1b[?25h"
)


class Overdue(BaseException):
    """Exception raised inside a node that blocks the event loop for too long.

    The base class is `BaseException`, because a node could catch every `Exception`.
    """


class Stopper:
    """Stopper of one run of an event loop.

    Attributes:
        interrupted: Whether a signal was received.
    """

    def __init__(
        self,
        loop: asyncio.AbstractEventLoop,
        task: "asyncio.Task[Any]",
        now: Callable[[], float],
        on_interrupt: Callable[[], object],
        when_killed: Listeners[()],
    ) -> None:
        """Install the signal handlers, if this is the main thread.

        Args:
            loop: Event loop that runs in the calling thread.
            task: Task that the first signal cancels.
            now: Function that returns real time in seconds.
            on_interrupt: Function called immediately at the first signal, in any thread.
            when_killed: Functions called before the stopper ends the process.
        """
        self.interrupted = False
        self._loop = loop
        self._task = task
        self._now = now
        self._on_interrupt = on_interrupt
        self._when_killed = when_killed
        self._loop_thread = threading.get_ident()
        self._over = False
        self._interrupted_at: float | None = None
        self._deadline: float | None = None
        self._standstill: float | None = None
        self._asked_at: float | None = None
        self._raised_at: float | None = None
        self._thread: threading.Thread | None = None
        # Python writes each signal's number to this socket, even while a node blocks the loop.
        self._inbox, self._outbox = socket.socketpair()
        self._outbox.setblocking(False)
        self._handlers: dict[signal.Signals, Any] = {}
        self._wakeup_fd = -1
        self._terminal = _terminal_settings()
        if threading.current_thread() is threading.main_thread():
            self._wakeup_fd = signal.set_wakeup_fd(self._outbox.fileno(), warn_on_full_buffer=False)
            for number in _SIGNALS:
                # Without a handler, the system's default would end the process at once.
                self._handlers[number] = signal.signal(number, _pass_over)
            self._begin()

    def limit(self, deadline: float | None, standstill: float | None = None) -> None:
        """Set the time at which the run must end; `limit(None)` removes all limits.

        Args:
            deadline: Real seconds from now until the end; None for no end in real time.
            standstill: Real seconds for which a node may block the loop; None for no limit.
        """
        self._deadline = None if deadline is None else self._now() + deadline
        self._standstill = standstill
        self._asked_at = self._raised_at = None
        if deadline is not None or standstill is not None:
            self._begin()
            self._poke()

    def close(self) -> None:
        """Stop the thread, and restore the former signal handlers."""
        # Set before the thread is woken, which then reads it.
        self._over = True
        for number, before in self._handlers.items():
            if before is not None:
                signal.signal(number, before)
        if self._handlers:
            signal.set_wakeup_fd(self._wakeup_fd)
        if self._thread is not None:
            self._poke()
            self._thread.join()
        self._inbox.close()
        self._outbox.close()

    def _begin(self) -> None:
        if self._thread is None:
            self._thread = threading.Thread(target=self._watch, name="stopper", daemon=True)
            self._thread.start()

    def _poke(self) -> None:
        with contextlib.suppress(BlockingIOError):
            # 0 is not a signal: it only wakes the thread, which then checks the deadlines.
            self._outbox.send(b"\0")

    # In the stopper's thread

    def _watch(self) -> None:
        while not self._over:
            self._inbox.settimeout(self._pause())
            try:
                received = self._inbox.recv(64)
            except TimeoutError:
                received = b""
            for number in received:
                if number in _SIGNALS:
                    self._caught()
                elif number:
                    # Another signal: its handler runs when the loop's thread wakes up.
                    self._ask(_nothing)
            if not self._over:
                self._look()

    def _pause(self) -> float | None:
        """Return the real seconds until the thread checks the limits if no signal arrives."""
        waits = []
        if self._interrupted_at is not None:
            waits.append(self._interrupted_at + PATIENCE - self._now())
        if self._deadline is not None:
            waits.append(self._deadline - self._now())
        if self._asked_at is not None or self._raised_at is not None:
            waits.append(PATIENCE / 4)
        if self._standstill is not None:
            waits.append(self._standstill / 4)
        waits = [wait for wait in waits if wait > 0.0]
        return min(waits) + 0.01 if waits else None

    def _caught(self) -> None:
        # The second signal: the process ends at once.
        if self.interrupted:
            self._kill(INTERRUPTED)
        self.interrupted = True
        self._interrupted_at = self._now()
        self._on_interrupt()
        # In the loop's thread, because tasks cannot be cancelled in another one.
        self._ask(self._task.cancel)

    def _look(self) -> None:
        now = self._now()
        if self._interrupted_at is not None and now >= self._interrupted_at + PATIENCE:
            self._interrupted_at = None
            for name in self._not_returned():
                _say(
                    f"{name} has not returned for {PATIENCE:g} s; a second Ctrl-C ends the process"
                )
        if self._raised_at is not None:
            if now >= self._raised_at + PATIENCE:
                for name in self._not_returned():
                    _say(f"{name} has not returned after the end of the run: ending the process")
                self._kill(FAILED)
            return
        # A call is sent to the loop: if the loop makes it, no node blocks the loop.
        due = self._deadline is not None and now >= self._deadline
        if self._asked_at is None:
            if due or self._standstill is not None:
                self._asked_at = now
                self._ask(self._answered)
            return
        # If not, a node blocks the loop: `Overdue` is raised in the code that it runs.
        patience = PATIENCE if due else self._standstill
        if patience is not None and now >= self._asked_at + patience:
            self._raised_at = now
            import ctypes  # as slow to import as the rest of this module

            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._loop_thread), ctypes.py_object(Overdue)
            )

    def _answered(self) -> None:
        """Record that the loop is not blocked; called in the loop's thread."""
        self._asked_at = self._raised_at = None

    def _ask(self, callback: Callable[[], object]) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has been closed
            self._loop.call_soon_threadsafe(callback)

    def _not_returned(self) -> list[str]:
        """Return the node that blocks the loop, else all running nodes, with lines of code."""
        current = asyncio.current_task(self._loop)
        if current is not None:
            frame = sys._current_frames().get(self._loop_thread)
            return [f"{_title(current)}{_in_brackets(_line(_stack(frame)))}"]
        try:
            tasks = [task for task in asyncio.all_tasks(self._loop) if _is_node(task)]
        except RuntimeError:  # tasks start and end while they are listed
            tasks = []
        names = sorted(f"{_title(task)}{_in_brackets(line_of_task(task))}" for task in tasks)
        return names[:_MOST_NAMED] or ["the run"]

    def _kill(self, status: int) -> None:
        """End the process at once, after restoring the terminal."""
        self._when_killed.call()
        if self._terminal is not None:
            with contextlib.suppress(termios.error):
                termios.tcsetattr(0, termios.TCSANOW, self._terminal)
        # Not `sys.exit`, because the `finally` blocks of a blocked node could block, too.
        os._exit(status)


def leave_screen() -> None:
    """Restore the terminal of a full-screen app; registered in `Clock.when_killed`.

    The alternate screen and the reports of mouse, focus and pastes end; the cursor is shown.
    """
    for number in (2, 1):
        if os.isatty(number):
            with contextlib.suppress(OSError):
                os.write(number, _LEAVE_SCREEN)
            return


def abandon(task: "asyncio.Task[Any]") -> None:
    """Stop waiting for a task that ignores its cancellation."""
    _abandoned.add(task)
    # This prevents asyncio's error message when the loop is closed.
    task._log_destroy_pending = False  # type: ignore[attr-defined]


def leftovers(loop: asyncio.AbstractEventLoop) -> "set[asyncio.Task[Any]]":
    """Return the tasks of a loop that are neither done nor abandoned."""
    return {task for task in asyncio.all_tasks(loop) if task not in _abandoned}


_abandoned: "weakref.WeakSet[asyncio.Task[Any]]" = weakref.WeakSet()


def _is_node(task: "asyncio.Task[Any]") -> bool:
    return task.get_name().startswith("node '")


def _title(task: "asyncio.Task[Any]") -> str:
    return task.get_name() if _is_node(task) else "the run"


def _stack(frame: FrameType | None) -> Iterable[tuple[str, int]]:
    """Return the files and lines of a stack, innermost first."""
    while frame is not None:
        yield frame.f_code.co_filename, frame.f_lineno
        frame = frame.f_back


def line_of_task(task: "asyncio.Task[Any]") -> str:
    """Return the user's line of code at which a task waits, such as "busy.py:10"; "" if unknown."""
    return _line(_awaiting(task))


def _awaiting(task: "asyncio.Task[Any]") -> list[tuple[str, int]]:
    """Return the files and lines at which a task waits, innermost first."""
    found = []
    waiting: Any = task.get_coro()
    while waiting is not None:
        frame = getattr(waiting, "cr_frame", None) or getattr(waiting, "ag_frame", None)
        if frame is not None:
            found.append((frame.f_code.co_filename, frame.f_lineno))
        waiting = getattr(waiting, "cr_await", None) or getattr(waiting, "ag_await", None)
    return found[::-1]


def _line(lines: Iterable[tuple[str, int]]) -> str:
    """Return the innermost line in a user's file, such as "busy.py:10"; "" without such a line."""
    for file, line in lines:
        if is_users_file(file):
            return f"{os.path.basename(file)}:{line}"
    return ""


def _in_brackets(line: str) -> str:
    return f" ({line})" if line else ""


def _say(sentence: str) -> None:
    # Not through sys.stderr, because the blocked thread may be writing to it.
    text = "".join(one if one.isprintable() else "?" for one in sentence)
    with contextlib.suppress(OSError):
        os.write(2, f"tftool: {text}\n".encode(errors="backslashreplace"))


def _terminal_settings() -> Any:
    """Return the settings of the terminal on stdin; None if stdin is not a terminal."""
    if sys.platform == "win32":
        return None
    try:
        return termios.tcgetattr(0)
    except (OSError, ValueError, termios.error):
        return None


def _pass_over(number: int, frame: FrameType | None) -> None:
    """Do nothing, because the stopper's thread reads the signal from a socket."""


def _nothing() -> None:
    """Do nothing; the call only wakes the event loop."""
