"""Position in a recording that is being played, and the doctor's finding nearest to it."""

from collections.abc import Sequence
from dataclasses import dataclass

from rich.text import Text

from tftool.base.color import Color
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, as_seconds
from tftool.drawing import theme
from tftool.drawing.table_columns import fitted

KEYS = (
    ("space", "pause"),
    ("n N", "findings"),
    ("→", "next"),
    ("[ ]", "1 s"),
    ("{ }", "10 s"),
    ("↑↓", "rate"),
    ("0", "start"),
    ("q", "quit"),
)
"""Keys of the player with their meanings, the most important first."""

_ASCII = {"→": "right", "↑↓": "up/down"}
_SHORTEST_BAR, _LONGEST_BAR = 8, 120


@dataclass(frozen=True, slots=True)
class PlaybackMark:
    """Finding of the doctor, marked in the bar of a playback line.

    Attributes:
        since: Begin of the finding, nanoseconds from the recording's start.
        until: End of the finding, nanoseconds from the recording's start.
        message: Text of the finding, one line.
        is_error: Whether the finding is an error, not a warning.
    """

    since: Duration
    until: Duration
    message: str
    is_error: bool = False


@dataclass(frozen=True, slots=True)
class Playback:
    """State of a player of a recording.

    Attributes:
        done: Position in the recording, nanoseconds from its start.
        total: Duration of the recording, nanoseconds.
        rate: Seconds of the recording per real second.
        is_paused: Whether the player is paused.
        laps: Number of restarts.
        marks: Findings of the doctor, the worst first.
    """

    done: Duration
    total: Duration
    rate: float = 1.0
    is_paused: bool = False
    laps: int = 0
    marks: Sequence[PlaybackMark] = ()


def line(
    playback: Playback,
    width: int,
    *,
    ascii_only: bool = False,
    palette: theme.Palette = theme.DARK,
) -> Text:
    """Return the position as a line of at most `width` cells: state, seconds, rate, bar.

    Args:
        playback: State of the player.
        width: Longest line in cells.
        ascii_only: Whether to draw in ASCII.
        palette: Colours of the screen, for the findings.
    """
    state = ("||" if playback.is_paused else "> ") if ascii_only else "⏸▶"[not playback.is_paused]
    seconds, total = as_seconds(playback.done), as_seconds(playback.total)
    count = len(f"{total:.2f}")
    words = f"{state} {seconds:{count}.2f} / {total:.2f} s"
    words += f"  {'x' if ascii_only else '×'}{playback.rate:.3g}"
    if playback.laps:
        words += f"  lap {playback.laps + 1}"
    room = min(width - len(words) - 2, _LONGEST_BAR)
    text = Text(words, no_wrap=True, overflow="crop")
    if room >= _SHORTEST_BAR:
        text.append("  ").append_text(_bar(playback, room, ascii_only, palette))
    text.truncate(max(width, 0))
    return text


def keys(playback: Playback, *, ascii_only: bool = False) -> list[tuple[str, str]]:
    """Return the keys of the player with their meanings, the most important first."""
    # Without findings, the keys that jump between findings would have no effect.
    shown = [(key, does) for key, does in KEYS if playback.marks or key != "n N"]
    return [(_ASCII.get(key, key) if ascii_only else key, does) for key, does in shown]


def _bar(playback: Playback, room: int, ascii_only: bool, palette: theme.Palette) -> Text:
    """Return the timeline: findings as coloured spans, and the position drawn over the spans."""
    share = playback.done / playback.total if playback.total > 0 else 1.0
    full = round(room * min(max(share, 0.0), 1.0))
    solid, empty = ("#", ".") if ascii_only else ("━", "─")
    bar = [*[(solid, "")] * full, *[(empty, "dim")] * (room - full)]
    for mark in reversed(playback.marks):
        first, last = (
            min(room - 1, max(0, int(room * moment / max(1, playback.total))))
            for moment in (mark.since, mark.until)
        )
        style = theme.hexadecimal(_color(mark, palette))
        bar[first : last + 1] = [("=" if ascii_only else "═", style)] * (last + 1 - first)
        # One finding may fill the whole bar, so its begin has a sign of its own.
        bar[first] = ("?!" if ascii_only else "▓█")[mark.is_error], style
    if playback.marks:
        bar[min(room - 1, full)] = "|" if ascii_only else "●", "bold"
    return Text.assemble(*bar)


def _color(mark: PlaybackMark, palette: theme.Palette) -> Color:
    return palette.error if mark.is_error else palette.warning


def finding_line(
    playback: Playback,
    width: int,
    *,
    ascii_only: bool = False,
    palette: theme.Palette = theme.DARK,
) -> Text:
    """Return number, time and text of the finding nearest to the position; empty if none.

    Args:
        playback: State of the player.
        width: Longest line in cells.
        ascii_only: Whether to draw in ASCII.
        palette: Colours of the findings.
    """
    marks = sorted(playback.marks, key=lambda one: one.since)
    if not marks:
        return Text()
    head = playback.done

    def distance(mark: PlaybackMark) -> tuple[Duration, Duration, bool]:
        away = max(mark.since - head, head - max(mark.since, mark.until), 0)
        return away, abs(head - mark.since), not mark.is_error

    nearest = min(marks, key=distance)
    span = f"{as_seconds(nearest.since):.2f}"
    if nearest.until > nearest.since:
        span += f"{'-' if ascii_only else '–'}{as_seconds(nearest.until):.2f}"
    kind = "error" if nearest.is_error else "warning"
    style = theme.hexadecimal(_color(nearest, palette))
    place = f"{marks.index(nearest) + 1}/{len(marks)}"
    text = Text.assemble((f"{place} {kind}", f"bold {style}"), f"  {span} s  ")
    text.append(visible(nearest.message), style)
    more = "~" if ascii_only else "…"
    return text if text.cell_len <= width else Text(fitted(text.plain, width, more=more), style)


def passed(marks: Sequence[PlaybackMark], before: Duration, now: Duration) -> list[PlaybackMark]:
    """Return the marks that begin after `before` and up to `now`."""
    return [one for one in marks if before < one.since <= now]


def after(marks: Sequence[PlaybackMark], now: Duration) -> Duration | None:
    """Return the begin of the next mark after a position; None if there is no such mark."""
    return min((one.since for one in marks if one.since > now), default=None)


def before(marks: Sequence[PlaybackMark], now: Duration) -> Duration | None:
    """Return the begin of the last mark before a position; None if there is no such mark."""
    return max((one.since for one in marks if one.since < now), default=None)
