"""Screen of `tftool play`: timeline, findings, topics and frames of a recording being played."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.content import Content

from tftool.base.plain_text import count, visible
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.sample import FrameInfo
from tftool.doctor.findings import Severity
from tftool.drawing.playback_line import (
    Playback,
    PlaybackMark,
    PlayedTopic,
    after,
    before,
    finding_lines,
    keys,
    lines,
    topic_lines,
)
from tftool.screens.terminal.panel_text import Hint, bar, footer
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.space_panel import SPACE_KEYS, SpacePanel
from tftool.screens.terminal.tree_app import TreeWatch
from tftool.screens.terminal.world_app import FRAME_CSS, Panel
from tftool.world.nodes.player import Player

REDRAW: Final = 0.1
"""Seconds between two updates of the timeline."""

FASTER: Final = 1.1
"""Factor by which an arrow key changes the rate, as in rosbag2."""

NEAR, FAR = seconds(1), seconds(10)

AT: Final = seconds(0.5)
"""Nanoseconds after a finding's start within which the key "N" seeks to the one before it."""

TIMELINE: Final = 6
"""Lines of the timeline, with its border."""

MOST_LISTED: Final = 8
"""Largest number of findings in the list; it scrolls with the position."""

TOPICS: Final = 40
"""Width in cells of the list of topics, with its border."""

WITH_LISTS: Final = 12
"""Smallest number of rows of a screen with more than the timeline."""

WITH_TOPICS: Final = 70
"""Smallest number of columns of a screen with the list of topics."""

_SEEKS: Final[Mapping[str, Duration]] = {
    "[": -NEAR,
    "]": NEAR,
    "{": -FAR,
    "}": FAR,
}

KEYS = f"""\
 Space        pause, or continue
 Right        pause, and send the next message
 [ ]          back and forward by 1 s (also Left)
 {{ }}          by 10 s
 n N          next finding, previous finding
 Up, Down     faster, slower
 r            play again from the start
 0            go to the start

 j, k         scroll the frames (also PgUp, PgDn, the wheel)
 s            sort the frames
 /            only frames with the letters typed; Esc: all of them

{SPACE_KEYS}
 m            light or dark
 ? or Esc     close these keys
 q            quit
"""


class PlayerScreen(TreeWatch, inherit_bindings=False):
    """Screen of `tftool play`.

    Args:
        player: Player of the recording; the player's world has the frames.
        moments: Times of the transforms, nanoseconds since the start of the recording.
        marks: Findings of the doctor.
        topics: Topics of the recording, in the order of the list.
        setting: Options of the screen.
    """

    keys_help = KEYS

    CSS = f"""{FRAME_CSS}
    #timeline {{ height: {TIMELINE}; }}
    #topics {{ width: {TOPICS}; height: 1fr; }}
    #rows, #space {{ height: 1fr; }}
    #rows {{ width: 1fr; }}
    .tiny #rows, .tiny #timeline {{ border: none; }}
    """

    def __init__(
        self,
        player: Player,
        moments: npt.NDArray[np.int64],
        marks: Sequence[PlaybackMark],
        topics: Sequence[PlayedTopic],
        setting: Setting | None = None,
    ) -> None:
        super().__init__(player.world, lambda _: {}, setting)
        self._player = player
        self._findings = marks
        self._topics = topics
        self._moments = moments

    def compose(self) -> ComposeResult:
        """Create the panels of this screen."""
        yield Panel("header", can_focus=False)
        yield Panel("timeline", "Timeline", can_focus=False)
        yield Panel("findings", "Findings of the doctor", can_focus=False)
        with Horizontal(id="lists"):
            yield Panel("topics", "Topics", can_focus=False)
            yield Panel("rows", "Frames", can_focus=False)
        yield SpacePanel("space", "In space", can_focus=False)
        yield Panel("footer", can_focus=False)
        yield Panel("keys", "Keys: ? or Esc closes them", can_focus=False)

    def on_mount(self) -> None:
        """Start the regular updates of the timeline."""
        self.set_interval(REDRAW, lambda: self._shown(self._draw_playback))

    def _rows_above(self) -> int:
        listed = min(len(self._findings), MOST_LISTED, max(1, (self.size.height - 16) // 3))
        return TIMELINE + (listed + 2 if self._findings else 0)

    def _arrange(self) -> None:
        """Show those panels that fit into the terminal."""
        width, height = self.size
        findings, topics = self.panel("findings"), self.panel("topics")
        findings.display = bool(self._findings) and height >= 18
        findings.styles.height = self._rows_above() - TIMELINE
        topics.display = bool(self._topics) and width >= WITH_TOPICS
        super()._arrange()
        # Both lists are as high as the tree, and the picture takes the whole width below.
        lists, rows = self.query_one("#lists"), self.panel("rows")
        lists.display = rows.display and height >= WITH_LISTS
        lists.styles.height = rows.styles.height
        rows.styles.height = "1fr"

    def _present(self, now: Stamp, info: FrameInfo) -> FrameInfo:
        """Return a frame's facts; the rate is left out until a second was played."""
        # Between n samples are n - 1 periods.
        is_short = info.buffer_length * info.samples < NEAR * (info.samples - 1)
        present = super()._present(now, info)
        return present._replace(samples=1) if is_short and info.samples > 1 else present

    def _tree_needs(self) -> int:
        return max(super()._tree_needs(), len(self._topics) + 2)

    def _playback(self) -> Playback:
        player = self._player
        return Playback(
            player.position - player.start,
            player.end - player.start,
            player.rate,
            player.is_paused,
            player.laps,
            self._findings,
        )

    def _draw(self) -> None:
        super()._draw()
        seen = {info.frame for info in self._seen[0].frames} if self._seen else set()
        missing = sorted(self._player.frames - seen)
        later = f"not yet: {visible(missing[0])}" if missing else ""
        later += f" +{len(missing) - 1}" if len(missing) > 1 else ""
        self.panel("rows").border_subtitle = Content(later)
        self._draw_playback()

    def _draw_playback(self) -> None:
        """Draw the timeline, the findings near the shown time, the topics and the header."""
        now, look = self._playback(), self.look
        style: Any = {"ascii_only": look.ascii_only, "palette": look.palette}
        timeline, findings, topics = map(self.panel, ("timeline", "findings", "topics"))
        timeline.show(lines(now, self._moments, timeline.size.width, **style))
        findings.show(finding_lines(now, *findings.size, **style))
        unlisted = len(now.marks) - findings.size.height
        findings.border_subtitle = Content(f"{unlisted} more" if unlisted > 0 else "")
        topics.show(topic_lines(self._topics, now, *topics.size, **style))
        state = ("playing", look.palette.accent)
        if now.is_paused:
            state = ("end" if now.is_over else "paused", look.palette.warning)
        kinds = Counter(one.severity for one in now.marks)
        found = ", ".join(count(kinds[one], one.value) for one in Severity if kinds[one])
        self.panel("header").show([bar(self.title, found, state, self.size.width, look)])

    def _footer(self, width: int) -> Text:
        if self._types or self.news or self._is_alone:
            return super()._footer(width)
        look = self.look
        hints = [Hint(*one) for one in keys(self._playback(), ascii_only=look.ascii_only)]
        return footer(hints, width, look)

    # Keys

    def on_key(self, event: events.Key) -> None:
        """Handle a key that controls the player; other keys are handled by the tree."""
        if self._types or not self._press(event.character or event.key, event.key):
            return  # textual calls the handler of the base class next
        event.prevent_default()
        event.stop()
        self.news = ""
        self.redraw()

    def _press(self, sign: str, key: str) -> bool:
        """Control the player with a key; return False if the key does not control the player."""
        player = self._player
        if key == "space":
            (player.resume if player.is_paused else player.pause)()
        elif key == "right":
            player.step()
        elif key in ("up", "down"):
            player.set_rate(player.rate * (FASTER if key == "up" else 1.0 / FASTER))
        elif key == "left" or sign in _SEEKS:
            self._seek(player.position + _SEEKS.get(sign, -NEAR))
        elif sign in ("n", "N"):
            now = player.position - player.start
            # During playback, shortly after a finding still counts as being at the finding.
            to = after(self._findings, now) if sign == "n" else before(self._findings, now - AT)
            if to is not None:
                self._seek(player.start + to)
        elif sign in ("0", "r") or key == "home":
            player.seek(player.start)
            if sign == "r":
                player.resume()
        else:
            return False
        return True

    def _seek(self, moment: Stamp) -> None:
        # Rates and ages are of the time that was played: not of the time that was skipped.
        if moment > self._player.position:
            self.world.buffer.clear()
        self._player.seek(moment)
