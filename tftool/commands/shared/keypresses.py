"""Key presses in the terminal, for commands without a full-screen app."""

import asyncio
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tftool.commands.shared.suspend import left_while_stopped

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
    """Return the names of the keys with these bytes; unknown bytes are ignored."""
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
                break  # another key that sends several bytes
            if char == b" ":
                found.append("space")
            elif 0x20 < char[0] < 0x7F:
                found.append(char.decode("ascii"))
            typed = typed[1:]
    return found


@contextmanager
def keyboard(pressed: Callable[[str], object]) -> Iterator[bool]:
    """Call back for every key pressed in the terminal, in a running loop.

    Yields:
        Whether keys are taken: there has to be a terminal, and this in its foreground.
    """
    try:
        import termios
        import tty

        number = sys.stdin.fileno()
        before = termios.tcgetattr(number)
        # In the background, to change the terminal would stop the process.
        is_ours = os.tcgetpgrp(number) == os.getpgrp()
    except (ImportError, OSError, ValueError, AttributeError, termios_error()):
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


def termios_error() -> type[BaseException]:
    """Return the exception type of terminal settings; on systems without them, one never raised."""
    try:
        import termios
    except ImportError:
        return OSError
    return termios.error
