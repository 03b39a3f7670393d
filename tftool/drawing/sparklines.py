"""Small curves (sparklines) of the rate and delay of each frame over the last seconds."""

from collections import deque
from collections.abc import Iterable, Sequence
from typing import Final, NamedTuple

from tftool.base.plain_text import three_digits
from tftool.base.stamps import Stamp, as_seconds
from tftool.buffer.traffic import Traffic
from tftool.drawing.table_columns import GAP, TableColumn

LOOKS: Final = 240
"""Number of moments that are stored per frame."""

CELLS: Final = 60
LEAST_CELLS: Final = 13
"""Cells of the longest curve beside a tree, and of the shortest, which has room for its heading."""

NUMBER: Final = 6
"""Cells of the maximum of a curve."""

# The full block is not used, because curves of neighbouring rows would merge.
_SIGNS: Final = {True: "_.-=+*#@", False: "▁▂▃▄▅▆▇"}


def sparkline(values: Iterable[float | None], width: int, *, ascii_only: bool = False) -> str:
    """Draw values from zero to their maximum in one line, the newest at the right.

    Args:
        values: Values, oldest first; None for an unknown value.
        width: Width in cells; a cell with several values shows the largest.
        ascii_only: Whether to draw with ASCII characters only.
    """
    kept = list(values)
    if all(one is None for one in kept):
        return ""
    shown = []
    for cell in range(width):
        first, last = (place * len(kept) // width for place in (cell, cell + 1))
        # The largest of several values; else a short peak would appear and disappear.
        part = [one for one in kept[first : max(first + 1, last)] if one is not None]
        shown.append(max(part, default=None))
    highest = max((one for one in shown if one is not None), default=0.0)
    signs = _SIGNS[ascii_only]
    return "".join(
        " " if one is None else signs[round(max(0.0, one) / (highest or 1.0) * (len(signs) - 1))]
        for one in shown
    )


def _scaled(values: Sequence[float | None], width: int, factor: float, ascii_only: bool) -> str:
    """Draw values in `width` cells, followed by the maximum of the values times `factor`."""
    curve = sparkline(values, width - NUMBER, ascii_only=ascii_only)
    highest = max((one for one in values if one is not None), default=0.0)
    return curve and f"{curve}{three_digits(factor * highest):>{NUMBER}}"


class TrafficLook(NamedTuple):
    """Rate (Hz) and delay (s) of a frame at one moment; None if unknown."""

    moment: Stamp
    rate: float | None
    delay: float | None


class TrafficHistory:
    """Rates and delays of every moving frame at the last calls of the method `look`."""

    def __init__(self) -> None:
        self._counts: dict[str, deque[tuple[Stamp, int]]] = {}
        self._looks: dict[str, deque[TrafficLook]] = {}

    def look(self, now: Stamp, traffic: Traffic, *, over: int = 4) -> None:
        """Store every frame's present rate, and its greatest delay since the last call.

        Args:
            now: Current time of the clock in nanoseconds.
            traffic: Statistics of the received messages.
            over: Number of calls over which messages are counted for a rate. A smaller number gives
                a rate that jumps with each message.
        """
        for name, link in traffic.links.items():
            if link.is_static:
                continue
            counts = self._counts.setdefault(name, deque(maxlen=over))
            since = counts[-1][0] if counts else 0
            counts.append((now, link.series.total))
            (first, before), (last, total) = counts[0], counts[-1]
            rate = (total - before) / as_seconds(last - first) if last > first else None
            # An edge that is silent has no current delay, only its last one.
            delay = None if rate == 0.0 else link.series.worst_delay_since(since)
            looks = self._looks.setdefault(name, deque(maxlen=LOOKS))
            looks.append(TrafficLook(now, rate, delay))

    def looks(self, frame: str) -> Sequence[TrafficLook]:
        """Return the stored rates and delays of a frame, oldest first."""
        return tuple(self._looks.get(frame, ()))

    def columns(
        self, frames: Iterable[str], width: int, *, ascii_only: bool = False
    ) -> list[TableColumn]:
        """Return two columns, of rates and of delays, that fit beside a table.

        Args:
            frames: The frame of each row.
            width: Free cells beside the table; if there is room for one column only, the rates are
                shown.
            ascii_only: Whether to draw with ASCII characters only.
        """
        count = 2 if width >= 2 * (LEAST_CELLS + GAP) else 1
        cells = min(CELLS, width // count - GAP)
        if cells < LEAST_CELLS:
            return []
        kept = [self.looks(name) for name in frames]
        return [
            TableColumn(
                heading,
                [
                    (_scaled([one[part] for one in looks], cells, factor, ascii_only), style)
                    for looks in kept
                ],
                # The heading is at the right, above the newest value.
                align_right=True,
            )
            for heading, part, factor, style in (
                ("rate, max Hz", 1, 1.0, "green"),
                ("delay, max ms", 2, 1e3, "yellow"),
            )[:count]
        ]


NO_HISTORY: Final = TrafficHistory()
"""Empty history, whose columns are left out."""
