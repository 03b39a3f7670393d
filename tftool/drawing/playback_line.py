"""Timeline, findings and topics of a recording during playback."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from rich.text import Text

from tftool.base.color import Color
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.doctor.findings import Severity
from tftool.drawing import theme
from tftool.drawing.line_plot import axis_labels
from tftool.drawing.sparklines import sparkline
from tftool.drawing.table_columns import fitted, padded

KEYS = (
    ("space", "pause"),
    ("n N", "findings"),
    ("[ ]", "1 s"),
    ("{ }", "10 s"),
    ("↑↓", "rate"),
    ("?", "keys"),
    ("r", "replay"),
    ("→", "next message"),
    ("q", "quit"),
)
"""Keys of the player with their meanings, the most important first."""

_ASCII = {"→": "right", "↑↓": "up/down"}

NEAR = seconds(0.5)
"""Distance from the position, nanoseconds, within which a finding is highlighted."""

JUST_NOW = seconds(0.2)
"""Real time, nanoseconds, for which a topic is highlighted after a message."""


@dataclass(frozen=True, slots=True)
class PlaybackMark:
    """Finding of the doctor, marked in the bar of a playback line.

    Attributes:
        since: Start of the finding, nanoseconds from the recording's start.
        until: End of the finding, nanoseconds from the recording's start.
        message: Text of the finding, one line.
        severity: Severity of the finding.
        is_timed: Whether the finding has a time; a finding without a time is not in the bar.
    """

    since: Duration
    until: Duration
    message: str
    severity: Severity = Severity.WARNING
    is_timed: bool = True


@dataclass(frozen=True, slots=True)
class Playback:
    """State of a player of a recording.

    Attributes:
        done: Position in the recording, nanoseconds from its start.
        total: Duration of the recording, nanoseconds.
        rate: Seconds of the recording per real second.
        is_paused: Whether the player is paused.
        laps: Number of restarts from the beginning.
        marks: Findings of the doctor, the worst first.
    """

    done: Duration
    total: Duration
    rate: float = 1.0
    is_paused: bool = False
    laps: int = 0
    marks: Sequence[PlaybackMark] = ()

    @property
    def is_over(self) -> bool:
        """Whether the player waits at the end of the recording."""
        return self.is_paused and self.done >= self.total


@dataclass(frozen=True, slots=True, eq=False)
class PlayedTopic:
    """Topic of a recording, with the times of its messages.

    Attributes:
        name: Name of the topic.
        count: Number of messages on the topic.
        moments: Times of the messages, nanoseconds from the recording's start, ascending; None if
            the times are unknown.
    """

    name: str
    count: int
    moments: npt.NDArray[np.int64] | None = None


def lines(
    playback: Playback,
    moments: npt.NDArray[np.int64],
    width: int,
    *,
    ascii_only: bool = False,
    palette: theme.Palette = theme.DARK,
) -> list[Text]:
    """Return four lines: position and rate, density of transforms, findings, and time axis.

    Args:
        playback: State of the player.
        moments: Times of the transforms, nanoseconds from the recording's start, ascending.
        width: Width in cells.
        ascii_only: Whether to draw in ASCII.
        palette: Colours of the screen.
    """
    state = ("||" if playback.is_paused else "> ") if ascii_only else "‖▶"[not playback.is_paused]
    total = as_seconds(playback.total)
    count = len(f"{total:.2f}")
    words = f"{state} {as_seconds(playback.done):{count}.2f} / {total:.2f} s"
    words += f"  {'x' if ascii_only else '×'}{playback.rate:.3g}"
    if playback.laps:
        words += f"  lap {playback.laps + 1}"
    color, dim = theme.ink(palette.accent), theme.ink(palette.dim)
    text = Text(words, theme.ink(palette.text, bold=True), no_wrap=True, overflow="crop")
    if playback.is_over:
        text.append("  end: ", theme.ink(palette.text))
        text.append("r", theme.ink(palette.accent, bold=True)).append(" replays, ", dim)
        text.append("q", theme.ink(palette.accent, bold=True)).append(" quits", dim)
    text.truncate(width)
    width = max(1, width)
    # A search for the limits of the cells: a histogram would read all moments for each picture.
    limits = np.arange(width + 1) * max(1, playback.total) // width
    limits[-1] += 1
    counts = np.diff(np.searchsorted(moments, limits))
    curve = Text(sparkline(counts.tolist(), width, ascii_only=ascii_only), dim)
    curve.stylize(color, 0, width if playback.is_over else _place(playback.done, playback, width))
    axis = axis_labels(0.0, total, width) if total > 0 else ""
    return [text, curve, _bar(playback, width, ascii_only, palette), Text(axis, dim)]


def keys(playback: Playback, *, ascii_only: bool = False) -> list[tuple[str, str]]:
    """Return the keys of the player with their meanings, the most important first."""
    # Without findings, the keys that jump between findings would have no effect.
    shown = [(key, does) for key, does in KEYS if playback.marks or key != "n N"]
    if playback.is_paused:
        shown[0] = ("space", "play")
    return [(_ASCII.get(key, key) if ascii_only else key, does) for key, does in shown]


def _bar(playback: Playback, width: int, ascii_only: bool, palette: theme.Palette) -> Text:
    """Return the bar of the timeline: findings as coloured spans, and the position on top."""
    full = _place(playback.done, playback, width)
    solid, empty = ("#", ".") if ascii_only else ("━", "─")
    played, dim = theme.hexadecimal(palette.accent), theme.hexadecimal(palette.dim)
    bar = [*[(solid, played)] * full, *[(empty, dim)] * (width - full)]
    for mark in reversed([one for one in playback.marks if one.is_timed]):
        first, last = (_place(moment, playback, width) for moment in (mark.since, mark.until))
        style = theme.hexadecimal(_color(mark, palette))
        bar[first : last + 1] = [("=" if ascii_only else "═", style)] * (last + 1 - first)
        # One finding may fill the whole bar, so its begin has a sign of its own.
        bar[first] = ("?!" if ascii_only else "▓█")[mark.severity is Severity.ERROR], style
    bar[full] = "|" if ascii_only else "●", f"bold {theme.hexadecimal(palette.text)}"
    return Text.assemble(*bar)


def _place(moment: Duration, playback: Playback, width: int) -> int:
    """Return the column of the position `moment`, nanoseconds, on a timeline of `width` cells."""
    share = moment / playback.total if playback.total > 0 else 1.0
    return max(0, min(width - 1, int(width * share)))


def _color(mark: PlaybackMark, palette: theme.Palette) -> Color:
    if mark.severity is Severity.NOTE:
        return palette.text
    return palette.error if mark.severity is Severity.ERROR else palette.warning


def finding_lines(
    playback: Playback,
    width: int,
    height: int,
    *,
    ascii_only: bool = False,
    palette: theme.Palette = theme.DARK,
) -> list[Text]:
    """Return one line per finding in order of time; the finding nearest to the position is bright.

    Args:
        playback: State of the player.
        width: Maximum length of a line in cells.
        height: Maximum number of lines; the nearest finding is always shown.
        ascii_only: Whether to draw in ASCII.
        palette: Colours of the findings.
    """
    marks = sorted(playback.marks, key=lambda one: one.since)
    if not marks:
        return []
    head = playback.done

    def distance(mark: PlaybackMark) -> tuple[bool, Duration, Duration, int]:
        away = max(mark.since - head, head - max(mark.since, mark.until), 0)
        return not mark.is_timed, away, abs(head - mark.since), mark.severity.rank

    nearest = marks.index(min(marks, key=distance))
    first = max(0, min(nearest - height // 2, len(marks) - height))
    shown = []
    for place, mark in enumerate(marks[first : first + height], first):
        until = f"{'-' if ascii_only else '–'}{as_seconds(mark.until):.2f}"
        span = f"{as_seconds(mark.since):.2f}{until if mark.until > mark.since else ''} s"
        is_lit = place == nearest and mark.is_timed and distance(mark)[1] <= NEAR
        arrow = (">" if ascii_only else "▸") if is_lit else " "
        kind = mark.severity.value
        number = f"{place + 1:>{len(str(len(marks)))}}/{len(marks)}"
        words = f"{arrow}{number} {kind:7}  {span if mark.is_timed else 'throughout':>15}  "
        words = fitted(words + visible(mark.message), width, more="~" if ascii_only else "…")
        line = Text(words, theme.ink(palette.text if is_lit else palette.dim, bold=is_lit))
        sign = words.find(kind)
        line.stylize(theme.ink(_color(mark, palette), bold=is_lit), sign, sign + len(kind))
        shown.append(line)
    return shown


def topic_lines(
    topics: Sequence[PlayedTopic],
    playback: Playback,
    width: int,
    height: int,
    *,
    ascii_only: bool = False,
    palette: theme.Palette = theme.DARK,
) -> list[Text]:
    """Return one line per topic with the rate; a bright sign shows that a message just came.

    Args:
        topics: Topics of the recording.
        playback: State of the player.
        width: Width in cells.
        height: Maximum number of lines; the last line counts topics that do not fit.
        ascii_only: Whether to draw in ASCII.
        palette: Colours of the screen.
    """
    more = "~" if ascii_only else "…"
    room = height if len(topics) <= height else height - 1
    lit, unlit = ("*", ".") if ascii_only else ("●", "·")
    since = playback.done - max(1, round(JUST_NOW * playback.rate))
    shown = []
    for topic in topics[: max(0, room)]:
        moments = topic.moments
        now = 0
        if moments is not None:
            now = int(np.diff(np.searchsorted(moments, (since, playback.done), side="right"))[0])
        rate = topic.count / max(1e-9, as_seconds(playback.total))
        facts = f"{rate:7.1f} Hz" if topic.count > 1 else f"{topic.count:>7} msg"
        color = palette.accent if now else palette.dim
        shown.append(
            Text.assemble(
                ((lit if now else unlit) + " ", theme.ink(color, bold=bool(now))),
                (
                    padded(visible(topic.name), max(1, width - 13), more=more),
                    theme.ink(palette.text if now else palette.dim),
                ),
                (facts, theme.ink(palette.text if now else palette.dim)),
            )
        )
    if room < len(topics):
        shown.append(Text(f"  {len(topics) - len(shown)} more", theme.ink(palette.accent)))
    return shown


def after(marks: Sequence[PlaybackMark], now: Duration) -> Duration | None:
    """Return the start of the next finding that begins after `now`; None without a finding."""
    return min((one.since for one in marks if one.is_timed and one.since > now), default=None)


def before(marks: Sequence[PlaybackMark], now: Duration) -> Duration | None:
    """Return the start of the last finding that begins before `now`; None without a finding."""
    return max((one.since for one in marks if one.is_timed and one.since < now), default=None)
