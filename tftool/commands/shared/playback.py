"""Display of a recording's playback, and its keys."""

import os
import shutil
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from tftool.base.escaping import visible
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.commands.shared.notices import is_news, notice, tell_record
from tftool.drawing.playback_line import Playback, PlaybackMark, after, line, passed
from tftool.world.clock import Clock, Phase

if TYPE_CHECKING:
    from tftool.world.log import LogRecord
    from tftool.world.nodes.player import Player

REDRAW: Final = seconds(0.1)
FASTER: Final = 1.1
"""What a press of an arrow makes of the rate; rosbag2's own figure."""

NEAR, FAR = seconds(1), seconds(10)

_ERASE = "\r\x1b[2K"


def press(player: "Player", key: str, marks: Sequence[PlaybackMark] = ()) -> None:
    """Handle a key: pause, next message, seek, rate, quit; ignore other keys.

    Args:
        player: The player.
        key: The key.
        marks: Findings that "n" goes to, one after the other.
    """
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
    elif key == "n":
        to = after(marks, player.position - player.start)
        if to is not None:
            player.seek(player.start + to)
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


class Display:
    """Line on stderr, if that is a terminal, with the position of the playback."""

    def __init__(self, player: "Player", clock: Clock, marks: Sequence[PlaybackMark] = ()) -> None:
        """Start without a line.

        Args:
            player: The player.
            clock: When to draw.
            marks: Findings of the doctor.
        """
        self._marks = marks
        self._done: Duration = -1
        self._player = player
        self._clock = clock
        self._is_shown = False
        self.has_keys = False
        self._is_terminal = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
        encoding = (getattr(sys.stderr, "encoding", "") or "ascii").lower()
        self._ascii_only = not encoding.startswith("utf")

    def tell(self, record: "LogRecord") -> None:
        """Print messages of the link and the player."""
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
            self._marks,
        )
        for mark in passed(self._marks, self._done, now.done):
            self.clear()
            notice(f"{as_seconds(mark.since):.2f} s: {visible(mark.message)}")
        self._done = now.done
        # The last column stays free: some terminals wrap there.
        width = shutil.get_terminal_size().columns - 1
        text = line(now, width, with_keys=self.has_keys, ascii_only=self._ascii_only)
        sys.stderr.write(_ERASE + text)
        sys.stderr.flush()
        self._is_shown = True

    def clear(self) -> None:
        """Erase the line."""
        if self._is_shown:
            sys.stderr.write(_ERASE)
            sys.stderr.flush()
            self._is_shown = False

    async def keep(self) -> None:
        """Redraw the line for as long as this runs."""
        while True:
            self.draw()
            await self._clock.sleep(REDRAW, Phase.WATCH)
