"""Run of `tftool play`: play a recording as a live session."""

import asyncio
import os
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rich.console import Console
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, visible
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.play import PlayOptions
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.hosting import join_or_host
from tftool.commands.shared.notices import is_news, notice, tell_record
from tftool.commands.shared.terminal import keyboard
from tftool.doctor.evidence import evidence_of_recording
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.drawing import theme
from tftool.drawing.playback_line import (
    Playback,
    PlaybackMark,
    after,
    before,
    finding_line,
    keys,
    line,
    passed,
)
from tftool.frames.source_options import At
from tftool.opener import named
from tftool.recordings.recording import Recording
from tftool.recordings.timeline import Timeline
from tftool.screens.terminal.panel_text import Hint, bar, footer
from tftool.screens.terminal.text_style import Look
from tftool.world.clock import Clock, FollowedClock, Phase
from tftool.world.clock import run as run_loop
from tftool.world.endpoints import PUBLISHER
from tftool.world.link.feed import TopicFeed
from tftool.world.link.session import Link
from tftool.world.link.session_world import shared
from tftool.world.nodes.player import Player
from tftool.world.supervisor import beside, live
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.world.log import LogRecord
    from tftool.world.nodes.player import Player


REDRAW: Final = seconds(0.1)
FASTER: Final = 1.1
"""Factor by which an arrow key changes the rate, as in rosbag2."""

NEAR, FAR = seconds(1), seconds(10)

AT: Final = seconds(0.5)
"""Nanoseconds after a finding's start within which the key "N" seeks to the one before it."""

_ERASE = "\r\x1b[2K"
_ERASE_ABOVE = "\x1b[1A\x1b[2K"


def press(player: "Player", key: str, marks: Sequence[PlaybackMark] = ()) -> None:
    """Handle a key: pause, next message, seek, rate, quit; ignore other keys.

    Args:
        player: Player to control.
        key: Name of the key.
        marks: Findings to seek to with the keys "n" (next finding) and "N" (previous finding).
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
    elif key in ("n", "N"):
        now = player.position - player.start
        # During playback, shortly after a finding still counts as being at the finding.
        to = after(marks, now) if key == "n" else before(marks, now - AT)
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
    """Title, position, finding and keys of the playback on stderr, if stderr is a terminal."""

    def __init__(
        self, player: "Player", clock: Clock, title: str, marks: Sequence[PlaybackMark] = ()
    ) -> None:
        """Start without drawing.

        Args:
            player: Player whose position is shown.
            clock: Clock that times the drawing.
            title: Title above the position.
            marks: Findings of the doctor.
        """
        self._title = title
        self._marks = marks
        self._done: Duration = -1
        self._player = player
        self._clock = clock
        self._erase = ""
        self._console = Console(stderr=True)
        self._palette = theme.LIGHT if theme.prefers_light(os.environ) else theme.DARK
        self.has_keys = False
        self._is_terminal = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
        encoding = (getattr(sys.stderr, "encoding", "") or "ascii").lower()
        self._ascii_only = not encoding.startswith("utf")

    def tell(self, record: "LogRecord") -> None:
        """Print log messages of the player and of the session connection."""
        if is_news(record):
            self.clear()
            notice(visible(record.text))
        elif record.node == self._player.name:
            self.clear()
            tell_record(record)

    def draw(self) -> None:
        """Redraw the lines with the playback's position and a finding."""
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
        # The last column stays empty, because some terminals wrap there.
        width = shutil.get_terminal_size().columns - 1
        style: Any = {"ascii_only": self._ascii_only, "palette": self._palette}
        look = Look(self._palette, self._ascii_only)
        found = count(len(now.marks), "finding") if now.marks else ""
        state = (
            ("paused", look.palette.warning) if now.is_paused else ("playing", look.palette.accent)
        )
        lines = [bar(self._title, found, state, width, look), line(now, width, **style)]
        if now.marks:
            lines.append(finding_line(now, width, **style))
        if self.has_keys:
            hints = [Hint(*one) for one in keys(now, ascii_only=self._ascii_only)]
            lines.append(footer(hints, width, look))
        with self._console.capture() as captured:
            self._console.print(Text("\n").join(lines), end="", soft_wrap=True, highlight=False)
        sys.stderr.write(self._erase + captured.get())
        sys.stderr.flush()
        self._erase = _ERASE + _ERASE_ABOVE * (len(lines) - 1)

    def clear(self) -> None:
        """Erase the lines with the playback's position and a finding."""
        if self._erase:
            sys.stderr.write(self._erase)
            sys.stderr.flush()
            self._erase = ""

    async def keep(self) -> None:
        """Redraw the lines repeatedly until cancelled."""
        while True:
            self.draw()
            await self._clock.sleep(REDRAW, Phase.WATCH)


MOST_JUDGED = 1_000_000
"""Most transforms of a recording that the doctor examines before playback, for about a second."""

MOST_MARKS = 200
"""Most findings marked on the line, the worst ones."""


def _refuse_to_mix(link: Link) -> None:
    """Raise an error if another node publishes transforms, which would mix with the recording's.

    Raises:
        UsageError: If another node publishes transforms.
    """
    nodes = sorted({one.node for one in link.graph.entities(PUBLISHER, name="tf")})
    if nodes:
        some = ", ".join(f"'{visible(node)}'" for node in nodes[:3])
        raise UsageError(
            f"/tf has publishers here ({some}): their transforms would mix with the playback's, "
            "and a robot would act on both. Choose another --domain, or add --force."
        )


def _span(
    recording: Recording, timeline: Timeline, begin: At | None, until: At | None
) -> tuple[Stamp, Stamp]:
    """Return the start and the end of the playback.

    Raises:
        UsageError: If the recording has nothing between start and end.
    """
    # The last message is received after its stamp, so it is later than the last stamp.
    low, high = min(timeline.start, recording.start), max(timeline.end, recording.end)
    first = timeline.start if begin is None else begin.stamp(recording.start)
    last = timeline.end if until is None else until.stamp(recording.start)
    for asked, stamp in ((begin, first), (until, last)):
        if asked is not None and not low <= stamp <= high:
            lasts = f"{as_seconds(high - recording.start):g} s"
            raise UsageError(f"The recording lasts {lasts}: {asked} is outside of that.")
    if first > last:
        raise UsageError(f"--from {begin} is after --to {until}.")
    return first, last


async def _play(
    options: PlayOptions,
    recording: Recording,
    timeline: Timeline,
    span: tuple[Stamp, Stamp],
    marks: Sequence[PlaybackMark],
    pace: Clock,
    link: Link | None,
) -> None:
    """Play a recording and share it as a session."""
    is_restamped = options.restamp is not None
    world = World(pace if is_restamped else FollowedClock(max(span[0], 1)))
    with shared(link, world):
        player = Player(
            world,
            "player",
            timeline=timeline,
            pace=pace,
            span=span,
            rate=options.rate,
            is_paused=options.paused,
            is_looping=options.loop,
            is_restamped=is_restamped,
            feed=_feed(recording, timeline, link) if options.everything else None,
        )
        title = f"tftool play {visible(Path(options.file).name)}"
        display = Display(player, pace, title, marks)
        stop_telling = world.log.listen(display.tell, "console")
        try:
            with keyboard(lambda key: press(player, key, marks)) as display.has_keys:
                await beside(live(world), _until_over(world, pace, display, options.run_for))
        finally:
            display.clear()
            stop_telling()


def _feed(recording: Recording, timeline: Timeline, link: Link | None) -> TopicFeed | None:
    if link is None:
        notice("--all has no effect here: no other process can join this world.")
        return None
    feed = TopicFeed(link, recording.source, timeline.clock, "player")
    for sentence in feed.left_out:
        notice(visible(sentence))
    return feed


async def _until_over(
    world: World, pace: Clock, display: Display, duration: Duration | None
) -> None:
    """Show the position until the playback or the duration ends; then end the world."""
    showing = asyncio.ensure_future(display.keep())
    try:
        if duration is None:
            await showing
        else:
            await pace.sleep(duration)
            world.stop()
    finally:
        showing.cancel()


def _marks(recording: Recording, start: Stamp) -> list[PlaybackMark]:
    """Return the doctor's findings that have a time, if a terminal shows the timeline."""
    if not sys.stderr.isatty() or len(recording.transforms) > MOST_JUDGED:
        return []
    found = judge(evidence_of_recording(recording)).findings
    marks = [
        PlaybackMark(
            one.since - start,
            (one.until or one.since) - start,
            one.message,
            one.severity is Severity.ERROR,
        )
        for one in sorted(found, key=lambda one: one.severity.rank)
        if one.since is not None
    ]
    return marks[:MOST_MARKS]


def run(connection: Connection, options: PlayOptions) -> ExitStatus:
    """Run `tftool play`: play a recording until its end or a key."""
    connection.refuse_read_only("play")
    found = named(options.file)
    if not found.kind.is_recording:
        word = visible(options.file)
        raise UsageError(f"'{word}' is a {found.kind.value}: name a recording instead.")
    # `shares`: the options of sharing apply to the session that plays the recording.
    recording = open_from(connection, options.file, shares=True).recording
    assert isinstance(recording, Recording)
    timeline = Timeline(recording.source, recording.transforms)
    span = _span(recording, timeline, options.begin, options.until)
    marks = _marks(recording, span[0])
    # Last, because other processes wait until it is decided who hosts.
    link = join_or_host(connection, options.file).link
    if link is not None and connection.reach.is_robots and not options.force:
        _refuse_to_mix(link)
    pace = connection.providers.wall_clock()
    run_loop(pace, _play(options, recording, timeline, span, marks, pace, link))
    return ExitStatus.DONE
