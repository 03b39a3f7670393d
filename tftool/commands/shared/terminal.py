"""Terminal of commands without a full-screen display: Ctrl-Z, keys, and redrawn pictures."""

import asyncio
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Self

from rich.console import Console, RenderableType
from rich.live import Live

from tftool.world.clock import Clock
from tftool.world.stopper import leave_screen

if sys.platform != "win32":
    import termios
    import tty

_layers: list[tuple[Callable[[], object], Callable[[], object]]] = []
"""Functions `leave` and `enter` of each open block of `left_while_stopped`, outermost first."""


@contextmanager
def left_while_stopped(leave: Callable[[], object], enter: Callable[[], object]) -> Iterator[None]:
    """Restore the terminal while Ctrl-Z stops the process; blocks may be nested.

    This has no effect outside the main thread, or where SIGTSTP is missing or ignored.

    Args:
        leave: Function that restores the terminal's original state.
        enter: Function called after the process continues, to set up the terminal again.
    """
    number = getattr(signal, "SIGTSTP", None)
    if number is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.getsignal(number)
    if before is signal.SIG_DFL:
        signal.signal(number, _stop_soon)
    _layers.append((leave, enter))
    try:
        yield
    finally:
        _layers.remove((leave, enter))
        if before is signal.SIG_DFL:
            signal.signal(number, before)


def _stop_soon(number: int, frame: FrameType | None) -> None:
    """Handle SIGTSTP (Ctrl-Z): stop the process, between two callbacks of the event loop."""
    try:
        loop = asyncio.get_running_loop()
    except RuntimeError:
        _stop()
    else:
        loop.call_soon_threadsafe(_stop)


def _stop() -> None:
    layers = list(_layers)
    for leave, _ in reversed(layers):
        leave()
    # Not SIGTSTP, which does not stop a process without a shell that controls its group.
    os.kill(os.getpid(), signal.SIGSTOP)  # returns when the process continues
    for _, enter in layers:
        enter()


_NAMES = {
    b"\x1b[A": "up",
    b"\x1b[B": "down",
    b"\x1b[C": "right",
    b"\x1b[D": "left",
    b"\x1bOA": "up",
    b"\x1bOB": "down",
    b"\x1bOC": "right",
    b"\x1bOD": "left",
    b"\x1b[H": "home",
    b"\x1b[1~": "home",
}
_LONGEST = max(map(len, _NAMES))


def keys_in(typed: bytes) -> list[str]:
    """Return the names of the keys that sent the bytes `typed`; unknown bytes are ignored."""
    found = []
    while typed:
        for length in range(min(_LONGEST, len(typed)), 1, -1):
            name = _NAMES.get(typed[:length])
            if name is not None:
                found.append(name)
                typed = typed[length:]
                break
        else:
            char = typed[:1]
            if char == b"\x1b":
                break  # an unknown key that sends several bytes
            if char == b" ":
                found.append("space")
            elif 0x20 < char[0] < 0x7F:
                found.append(char.decode("ascii"))
            typed = typed[1:]
    return found


@contextmanager
def keyboard(pressed: Callable[[str], object]) -> Iterator[bool]:
    """Call `pressed` with every key pressed in the terminal, in a running event loop.

    Yields:
        True if keys are read: if stdin is a terminal, and the process is in the foreground.
    """
    if sys.platform == "win32":
        yield False
        return
    try:
        number = sys.stdin.fileno()
        before = termios.tcgetattr(number)
        # A process in the background that changes the terminal's settings is stopped.
        is_ours = os.tcgetpgrp(number) == os.getpgrp()
    except (OSError, ValueError, AttributeError, termios.error):
        is_ours = False
    if not is_ours:
        yield False
        return

    def typed() -> None:
        try:
            text = os.read(number, 1024)
        except OSError:
            text = b""
        if not text:
            asyncio.get_running_loop().remove_reader(number)
        for key in keys_in(text):
            pressed(key)

    def take() -> None:
        tty.setcbreak(number, termios.TCSANOW)

    def give_back() -> None:
        termios.tcsetattr(number, termios.TCSANOW, before)

    loop = asyncio.get_running_loop()
    take()
    try:
        loop.add_reader(number, typed)
        with left_while_stopped(give_back, take):
            yield True
    finally:
        loop.remove_reader(number)
        give_back()


def can_redraw() -> bool:
    """Return whether stdout is a terminal with a movable cursor."""
    return sys.stdout.isatty() and os.environ.get("TERM") != "dumb"


class Redrawing:
    """Drawer that replaces the last picture on the terminal by the next picture.

    From the first picture on, text printed to a terminal's stderr appears above the picture.
    """

    def __init__(self, clock: Clock) -> None:
        """Prepare to draw.

        Args:
            clock: Clock of the world, which restores the cursor before a signal ends the process.
        """
        self.console: Console = Console()
        self._live: Live | None = None
        self._undo = clock.when_killed.add(leave_screen, "screen")
        self._stopping = left_while_stopped(self._leave, lambda: None)

    def show(self, picture: RenderableType) -> None:
        """Draw a picture in place of the last picture."""
        if self._live is None:
            # If stderr is a file, its lines still go to the file.
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
        """Keep the last picture on the terminal; the next picture is drawn below the last one."""
        if self._live is not None:
            self._live.stop()
            self._live = None
