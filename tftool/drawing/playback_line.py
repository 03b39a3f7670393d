"""Position in a playing recording, as one line."""

from collections.abc import Sequence
from dataclasses import dataclass

from tftool.base.stamps import Duration, as_seconds

KEYS = (
    ("space", "pause"),
    ("→", "next"),
    ("[ ]", "1 s"),
    ("{ }", "10 s"),
    ("↑↓", "rate"),
    ("n", "finding"),
    ("0", "start"),
    ("q", "quit"),
)
"""What the keys do, the most needed first; each with a word."""

_ASCII = {"→": "right", "↑↓": "up/down"}
_SHORTEST_BAR, _LONGEST_BAR = 8, 30
_LONGEST_TIMELINE = 120
"""Cells of a bar that shows findings: their places are to be told apart."""


@dataclass(frozen=True, slots=True)
class PlaybackMark:
    """Finding of the doctor on the bar.

    Attributes:
        since: Begin of the finding, nanoseconds from the start.
        until: End of the finding, nanoseconds from the start.
        message: The finding, in one line.
        is_error: Whether the finding is an error, not a warning.
    """

    since: Duration
    until: Duration
    message: str
    is_error: bool = False


@dataclass(frozen=True, slots=True)
class Playback:
    """Position of a player in its recording.

    Attributes:
        done: Played part, nanoseconds.
        total: Duration of the recording, nanoseconds.
        rate: Seconds of the recording for each real second.
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
    playback: Playback, width: int, *, with_keys: bool = True, ascii_only: bool = False
) -> str:
    """Return a line of at most `width` columns: state, seconds, rate, bar, and the keys that fit.

    Args:
        playback: State of the player.
        width: Columns.
        with_keys: Whether keys are taken.
        ascii_only: Whether to draw in ASCII.
    """
    state = ("||" if playback.is_paused else "> ") if ascii_only else "⏸▶"[not playback.is_paused]
    seconds, total = as_seconds(playback.done), as_seconds(playback.total)
    count = len(f"{total:.2f}")
    text = f"{state} {seconds:{count}.2f} / {total:.2f} s"
    text += f"  {'x' if ascii_only else '×'}{playback.rate:.3g}"
    if playback.laps:
        text += f"  lap {playback.laps + 1}"
    shortest = 3 * _SHORTEST_BAR if playback.marks else _SHORTEST_BAR
    keys = _keys(width - len(text) - shortest - 4, ascii_only) if with_keys else ""
    longest = _LONGEST_TIMELINE if playback.marks else _LONGEST_BAR
    room = min(width - len(text) - len(keys) - 4, longest)
    if room >= _SHORTEST_BAR:
        full = round(room * min(max(seconds / total, 0.0), 1.0)) if total > 0 else room
        solid, empty = ("#", ".") if ascii_only else ("━", "─")
        bar = list(solid * full + empty * (room - full))
        for mark in reversed(playback.marks):
            first, last = (
                min(room - 1, max(0, int(room * moment / max(1, playback.total))))
                for moment in (mark.since, mark.until)
            )
            sign = ("!", "?")[not mark.is_error] if ascii_only else "▲△"[not mark.is_error]
            bar[first : last + 1] = sign * (last + 1 - first)
        if playback.marks:
            # A finding may take all of the bar: where playback is, is seen above it.
            bar[min(room - 1, full)] = "|" if ascii_only else "●"
        text += f"  {''.join(bar)}"
    return f"{text}  {keys}".rstrip()[: max(width, 0)]


def passed(marks: Sequence[PlaybackMark], before: Duration, now: Duration) -> list[PlaybackMark]:
    """Return the marks between one time and another."""
    return [one for one in marks if before < one.since <= now]


def after(marks: Sequence[PlaybackMark], now: Duration) -> Duration | None:
    """Return where the next mark begins; None after the last."""
    return min((one.since for one in marks if one.since > now), default=None)


def _keys(room: int, ascii_only: bool) -> str:
    """Return as many keys with explanations as fit; `q` always, if there is room for one."""
    *first, last = [f"{_ASCII.get(key, key) if ascii_only else key} {word}" for key, word in KEYS]
    texts = ("  ".join([*first[:count], last]) for count in range(len(first), -1, -1))
    return next((text for text in texts if len(text) <= room), "")
