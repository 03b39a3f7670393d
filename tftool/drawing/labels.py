"""Placement of labels beside frames, so that no label covers another."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from rich.cells import cell_len

from tftool.drawing import theme
from tftool.drawing.table_columns import fitted

FARTHEST_ROWS = 7
"""Largest distance in rows between a label and its frame."""


SMALL = 2
"""Largest reach of a symbol near which another frame's label may be."""


@dataclass(frozen=True, slots=True)
class Label:
    """Label to place beside a frame.

    Attributes:
        name: Name of the frame.
        text: Text of the label.
        column: Column of the frame.
        row: Row of the frame.
        reach: Cells that the frame's symbol takes to either side.
    """

    name: str
    text: str
    column: int
    row: int
    reach: int


@dataclass(frozen=True, slots=True)
class PlacedLabel:
    """Label with its first cell, and whether it is so far that a line must lead to its frame."""

    label: Label
    column: int
    row: int
    is_far: bool


def label_text(name: str, age: float, columns: int, least: int, *, ascii_only: bool) -> str:
    """Return the text beside a frame: its name, shortened, and the age of a stale frame.

    Args:
        name: Name to show.
        age: Seconds since the frame's newest transform.
        columns: Width of the picture in cells.
        least: Cells that a name may take in any case.
        ascii_only: Whether to write in ASCII only.
    """
    more = "~" if ascii_only else "…"
    text = fitted(name, max(least, columns // 3), more=more)
    if theme.is_stale(age):
        text = f"{text} {age:.1f} s ago"
    text = fitted(text, columns, more=more)
    return text.encode("ascii", "replace").decode("ascii") if ascii_only else text


class Placer:
    """Placer of labels, which keeps good positions from one picture to the next.

    Args:
        columns: Width of the picture in cells.
        rows: Height of the picture in cells.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.columns, self.rows = columns, rows
        self._before: dict[str, tuple[int, int]] = {}

    def placed(
        self,
        labels: list[Label],
        hard: set[tuple[int, int]],
        soft: set[tuple[int, int]],
        solid: set[tuple[int, int]] | frozenset[tuple[int, int]] = frozenset(),
    ) -> list[PlacedLabel]:
        """Place every label; omit a label that has no room near its frame.

        Args:
            labels: Labels, the most important first.
            hard: Cells (row, column) that no label may cover; the placed labels' cells are added.
            soft: Cells that a label covers only if it must.
            solid: Cells that a label covers only if there is no room around them.
        """
        found = []
        for label in labels:
            width = cell_len(label.text)
            large = [one for one in labels if one.reach > SMALL and one is not label]
            best: tuple[float, int, int] | None = None
            for cost, column, row in self._places(label, width):
                if best is not None and cost >= best[0]:
                    continue
                cells = [(row, column + offset) for offset in range(width)]
                if not hard.isdisjoint(cells):
                    continue
                cost += 0.4 * len(soft.intersection(cells))
                cost += 4.0 * len(solid.intersection(cells))
                # Directly beside another label, the two would read as one word.
                cost += 3.0 * ((row, column - 1) in hard and column - 1 != label.column)
                own = _apart(label, column, row, width)
                cost += 5.0 * any(_apart(one, column, row, width) <= own for one in large)
                if best is None or cost < best[0]:
                    best = cost, column, row
            if best is None:
                continue
            _, column, row = best
            self._before[label.name] = column - label.column, row - label.row
            hard.update((row, column + offset) for offset in range(-1, width + 1))
            found.append(PlacedLabel(label, column, row, abs(row - label.row) > 2))
        return found

    def _places(self, label: Label, width: int) -> Iterator[tuple[float, int, int]]:
        column, row, reach = label.column, label.row, label.reach
        right, left = column + reach + 1, column - reach - width
        middle = column - width // 2
        before = self._before.get(label.name)
        least = max(1, (reach + 1) // 2)
        for down in range(FARTHEST_ROWS + 1):
            for line in (row,) if down == 0 else (row + down, row - down):
                if not 0 <= line < self.rows:
                    continue
                starts = (right, left) if down < least else (right, left, middle)
                for place, start in enumerate(starts):
                    if start < 0 or start + width > self.columns:
                        continue
                    cost = 1.5 * down + (0.0, 0.6, 0.3)[place]
                    if before == (start - column, line - row):
                        cost -= 1.2
                    yield cost, start, line


def _apart(label: Label, column: int, row: int, width: int) -> tuple[float, float]:
    """Return a label's distance from its frame's symbol and from the symbol's centre, in rows."""
    nearest = min(max(label.column, column), column + width - 1)
    across, down = abs(nearest - label.column), abs(row - label.row)
    # A cell is twice as high as wide.
    edge = max(0, across - label.reach), max(0.0, down - 0.5 * label.reach)
    return math.hypot(0.5 * edge[0], edge[1]), math.hypot(0.5 * across, down)
