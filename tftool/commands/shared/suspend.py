"""Ctrl-Z: the shell gets the terminal as it was, and `fg` restores the drawing."""

import asyncio
import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

_layers: list[tuple[Callable[[], object], Callable[[], object]]] = []
"""What leaves the terminal and what takes it again, outermost first."""


@contextmanager
def left_while_stopped(leave: Callable[[], object], enter: Callable[[], object]) -> Iterator[None]:
    """Restore the terminal while Ctrl-Z stops the process; may be nested.

    Without effect outside the main thread, where there is no SIGTSTP, and where it is ignored.

    Args:
        leave: Gives the terminal back as it was.
        enter: Takes it again.
    """
    number = getattr(signal, "SIGTSTP", None)
    if number is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.getsignal(number)
    if before is signal.SIG_DFL:
        signal.signal(number, _asked)
    _layers.append((leave, enter))
    try:
        yield
    finally:
        _layers.remove((leave, enter))
        if before is signal.SIG_DFL:
            signal.signal(number, before)


def _asked(number: int, frame: FrameType | None) -> None:
    """Stop between two callbacks of the loop, so never within a write."""
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
    # Not SIGTSTP: a process whose group no shell looks after would go on at once.
    os.kill(os.getpid(), signal.SIGSTOP)  # returns once the process goes on
    for _, enter in layers:
        enter()
