"""Placement of labels beside frames, so that no label covers another."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt
from rich.cells import cell_len

from tftool.drawing import theme
from tftool.drawing.table_columns import fitted

Floats: TypeAlias = npt.NDArray[np.floating]

FARTHEST_ROWS: Final = 7
"""Largest distance in rows between a label and its frame."""

SMALL: Final = 2
"""Largest reach of a small symbol, near which another frame's label may be if there is no room."""

ON_LINE: Final = 0.4
"""Cost of a cell with a line."""

ON_AXIS: Final = 1.6
"""Cost of a cell with an axis of a frame."""

TAKEN: Final = 1e6
"""Cost of a cell that no label may cover."""

SOLID: Final = 1e3
"""Cost of a cell that only the first label may cover, if it has no other place."""


@dataclass(frozen=True, slots=True)
class Label:
    """Label to place beside a frame.

    Attributes:
        name: Name of the frame.
        text: Text of the label.
        column: Column of the frame.
        row: Row of the frame.
        reach: Number of cells that the frame's symbol covers on each side of its centre.
    """

    name: str
    text: str
    column: int
    row: int
    reach: int


@dataclass(frozen=True, slots=True)
class PlacedLabel:
    """Label with the position of its first cell; `is_far` asks for a line to the frame."""

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
        least: Width in cells that a shortened name has at least.
        ascii_only: Whether to write in ASCII only.
    """
    more = "~" if ascii_only else "…"
    text = fitted(name, max(least, columns // 3), more=more)
    if theme.is_stale(age):
        text = f"{text} {theme.age_words(age)} ago"
    text = fitted(text, columns, more=more)
    return text.encode("ascii", "replace").decode("ascii") if ascii_only else text


class Placer:
    """Placer of labels, which keeps good positions from one picture to the next.

    Args:
        columns: Width of the picture in cells.
        rows: Height of the picture in cells.
        asides: Distances in columns that a label may have from its frame's symbol.
    """

    def __init__(self, columns: int, rows: int, asides: tuple[int, ...] = (0,)) -> None:
        self.columns, self.rows = columns, rows
        self._asides = asides
        self._before: dict[str, tuple[int, int]] = {}

    def placed(self, labels: Sequence[Label], costs: Floats) -> list[PlacedLabel]:
        """Place every label; omit a label that has no room near its frame.

        Args:
            labels: Labels, the most important first.
            costs: Cost of each cell for a label that covers it, shape (rows, columns); the cells
                of placed labels become `TAKEN`.
        """
        found = []
        spots = np.array([(one.column, one.row, one.reach) for one in labels]).reshape(-1, 3)
        weights = np.where(spots[:, 2] > SMALL, 5.0, 2.0)
        sums = np.pad(np.cumsum(costs, 1), ((0, 0), (1, 0)))
        for place, label in enumerate(labels):
            width = cell_len(label.text)
            columns, rows, cost = self._places(label, width)
            if not len(cost):
                continue
            cost = cost + sums[rows, columns + width] - sums[rows, columns]
            # Directly beside another label, the two would read as one word.
            beside = columns - 1
            is_joined = (beside >= 0) & (beside != label.column) & (costs[rows, beside] >= TAKEN)
            cost += 3.0 * is_joined
            edge, centre = _apart(spots, columns, rows, width)
            own = edge[place], centre[place]
            is_closer = (edge < own[0]) | ((edge == own[0]) & (centre <= own[1]))
            is_same = (spots[:, 0] == label.column) & (spots[:, 1] == label.row)
            cost += (is_closer * np.where(is_same, 0.0, weights)[:, None]).max(0)
            best = int(cost.argmin())
            if cost[best] >= (TAKEN if label is labels[0] else SOLID):
                continue
            column, row = int(columns[best]), int(rows[best])
            self._before[label.name] = column - label.column, row - label.row
            costs[row, max(0, column - 1) : column + width + 1] = TAKEN
            sums[row, 1:] = np.cumsum(costs[row])
            away = max(column - label.column, label.column - column - width)
            is_far = abs(row - label.row) > 2 or away > label.reach + 2
            found.append(PlacedLabel(label, column, row, is_far))
        return found

    def _places(
        self, label: Label, width: int
    ) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], Floats]:
        """Return column, row and cost of each possible position of a label, from near to far."""
        aside, down, cost = _around(label.reach, width, self._asides).T
        before = self._before.get(label.name)
        if before is not None:
            cost = cost - 1.2 * ((aside == before[0]) & (down == before[1]))
        columns, rows = (aside + label.column).astype(int), (down + label.row).astype(int)
        is_inside = (columns >= 0) & (columns + width <= self.columns)
        is_inside &= (rows >= 0) & (rows < self.rows)
        return columns[is_inside], rows[is_inside], cost[is_inside]


@lru_cache(maxsize=512)
def _around(reach: int, width: int, asides: tuple[int, ...]) -> Floats:
    """Return possible positions of a label around a symbol, shape (n, 3).

    Each row has the columns to the right of the symbol, the rows below the symbol, and the cost.

    Args:
        reach: Number of cells that the symbol covers on each side of its centre.
        width: Width of the label in cells.
        asides: Distances in columns that the label may have from the symbol.
    """
    found = []
    for away in range(FARTHEST_ROWS + 1):
        for down in (away, -away)[: 1 + (away > 0)]:
            for aside in asides:
                cost = 1.5 * away + 0.25 * aside
                found.append((reach + 1 + aside, down, cost))
                found.append((-reach - width - aside, down, cost + 0.6))
            if away >= max(1, (reach + 1) // 2):
                found.append((-(width // 2), down, 1.5 * away + 0.3))
    return np.array(found, float)


def _apart(
    spots: npt.NDArray[np.int64],
    columns: npt.NDArray[np.int64],
    rows: npt.NDArray[np.int64],
    width: int,
) -> tuple[Floats, Floats]:
    """Return squared distances between texts and symbols, in units of the height of a row.

    Args:
        spots: Column, row and reach of each symbol, shape (m, 3).
        columns: First column of each text, shape (n,).
        rows: Row of each text, shape (n,).
        width: Width of the texts in cells.

    Returns:
        Squared distances from the texts to the edges of the symbols, and to the centres of the
        symbols, each of shape (m, n).
    """
    column, row, reach = spots.T[:, :, None]
    across = np.abs(np.clip(column, columns, columns + width - 1) - column)
    down = np.abs(rows - row)
    # A cell is twice as high as wide.
    edge = 0.5 * np.maximum(0, across - reach), np.maximum(0.0, down - 0.5 * reach)
    return edge[0] ** 2 + edge[1] ** 2, 0.25 * across**2 + down**2
