"""Sparklines of rate and delay of each frame over the last seconds."""

from collections import deque
from collections.abc import Iterable
from typing import Final

from tftool.base.stamps import Stamp, as_seconds
from tftool.buffer.traffic import Traffic
from tftool.drawing.table_columns import TableColumn

LOOKS: Final = 60
"""Looks that are remembered."""

# No full block: curves of neighbouring rows would merge.
_SIGNS: Final = {True: "_.-=+*#@", False: "▁▂▃▄▅▆▇"}


def sparkline(values: Iterable[float | None], width: int, *, ascii_only: bool = False) -> str:
    """Draw values from zero to their maximum, the newest on the right.

    Args:
        values: The values, oldest first; None where there is none.
        width: Cells across; older values are left out.
        ascii_only: Draw with ASCII characters alone.
    """
    shown = list(values)[-width:]
    highest = max((one for one in shown if one is not None), default=0.0)
    signs = _SIGNS[ascii_only]
    cells = [
        " " if one is None else signs[round(max(0.0, one) / (highest or 1.0) * (len(signs) - 1))]
        for one in shown
    ]
    return "".join(cells).rjust(width) if any(one is not None for one in shown) else ""


class TrafficHistory:
    """Rate and delay of every repeated frame over the last looks."""

    def __init__(self) -> None:
        self._counts: dict[str, deque[tuple[Stamp, int]]] = {}
        self._rates: dict[str, deque[float | None]] = {}
        self._delays: dict[str, deque[float | None]] = {}

    def look(self, now: Stamp, traffic: Traffic) -> None:
        """Record how many messages arrived since the last look, and the newest delay."""
        for name, link in traffic.links.items():
            if link.is_static:
                continue
            # A rate over one look alone would jump by a whole message.
            counts = self._counts.setdefault(name, deque(maxlen=4))
            counts.append((now, link.series.total))
            (first, before), (last, total) = counts[0], counts[-1]
            rates = self._rates.setdefault(name, deque(maxlen=LOOKS))
            rates.append((total - before) / as_seconds(last - first) if last > first else None)
            delays = self._delays.setdefault(name, deque(maxlen=LOOKS))
            delays.append(link.series.latest_delay)

    def columns(
        self, frames: Iterable[str], width: int, *, ascii_only: bool = False
    ) -> list[TableColumn]:
        """Return a column of rates and one of delays, if a table of this width has room.

        Args:
            frames: The frame of each row.
            width: Cells of the table.
            ascii_only: Draw with ASCII characters alone.
        """
        cells = max(12, min(LOOKS, (width - 100) // 2))
        names = list(frames)
        return [
            TableColumn(
                heading,
                [(sparkline(kept.get(name, ()), cells, ascii_only=ascii_only), style)
                 for name in names],
                # The heading stands above the newest value.
                stands_right=True,
                # They leave before any number does.
                goes=goes,
            )
            for heading, kept, style, goes in (
                ("rate, lately", self._rates, "green", -1),
                ("delay, lately", self._delays, "yellow", -2),
            )
        ]  # fmt: skip


NO_HISTORY: Final = TrafficHistory()
"""The history of nothing: its columns are empty, and left out."""
