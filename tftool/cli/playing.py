"""What a person sees of a recording that plays, and the keys that steer it."""

import asyncio
import os
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from tftool.cli.notices import is_news, notice, tell_record
from tftool.runtime.clock import Clock, Phase
from tftool.stamps import Duration, seconds
from tftool.views.escaping import visible
from tftool.views.playback import Playback, line

if TYPE_CHECKING:
    from tftool.nodes.player import Player
    from tftool.runtime.log import LogRecord

REDRAW: Final = seconds(0.1)
FASTER: Final = 1.1
"""What a press of an arrow makes of the rate; rosbag2's own figure."""

NEAR, FAR = seconds(1), seconds(10)

_ERASE = "\r\x1b[2K"
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


def press(player: "Player", key: str) -> None:
    """Do what a key says: pause, next message, seek, rate, quit. Any other does nothing."""
    if key == "space":
        if player.is_paused:
            player.resume()
        else:
            player.pause()
    elif key in ("right", "s"):
        player.step()
    elif key in ("up", "down"):
        player.set_rate(player.rate * (FASTER if key == "up" else 1.0 / FASTER))
    elif key in _SEEKS:
        player.seek(player.position + _SEEKS[key])
    elif key in ("0", "home"):
        player.seek(player.start)
    elif key in ("q", "Q"):
        player.world.stop()


_SEEKS: Final[dict[str, Duration]] = {
    "[": -NEAR,
    "]": NEAR,
    "left": -NEAR,
    "{": -FAR,
    "}": FAR,
}


def keys_in(typed: bytes) -> list[str]:
    """The names of the keys whose bytes these are; what is none is left out."""
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
    """Have every key that is pressed on the terminal told, one by one; inside a running loop.

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

    loop = asyncio.get_running_loop()
    tty.setcbreak(number, termios.TCSANOW)
    try:
        loop.add_reader(number, typed)
        yield True
    finally:
        loop.remove_reader(number)
        termios.tcsetattr(number, termios.TCSANOW, before)


def termios_error() -> type[BaseException]:
    """What a terminal's settings raise; nothing that ever comes where there are none."""
    try:
        import termios
    except ImportError:
        return OSError
    return termios.error


class Display:
    """A line on stderr that says where a player stands, if that is a terminal."""

    def __init__(self, player: "Player", clock: Clock) -> None:
        """Show nothing yet.

        Args:
            player: Who plays.
            clock: When to draw.
        """
        self._player = player
        self._clock = clock
        self._is_shown = False
        self.has_keys = False
        self._is_terminal = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
        encoding = (getattr(sys.stderr, "encoding", "") or "ascii").lower()
        self._ascii_only = not encoding.startswith("utf")

    def tell(self, record: "LogRecord") -> None:
        """Say what the link and the player have to say."""
        if is_news(record):
            self.clear()
            notice(visible(record.text))
        elif record.node == self._player.name:
            self.clear()
            tell_record(record)

    def draw(self) -> None:
        """Redraw the line."""
        if not self._is_terminal:
            return
        player = self._player
        now = Playback(
            player.position - player.start,
            player.end - player.start,
            player.rate,
            player.is_paused,
            player.laps,
        )
        # The last column stays free: some terminals wrap there.
        width = shutil.get_terminal_size().columns - 1
        text = line(now, width, with_keys=self.has_keys, ascii_only=self._ascii_only)
        sys.stderr.write(_ERASE + text)
        sys.stderr.flush()
        self._is_shown = True

    def clear(self) -> None:
        """Take the line away."""
        if self._is_shown:
            sys.stderr.write(_ERASE)
            sys.stderr.flush()
            self._is_shown = False

    async def keep(self) -> None:
        """Draw for as long as this runs."""
        while True:
            self.draw()
            await self._clock.sleep(REDRAW, Phase.WATCH)
