"""Placement of labels beside their frames without overlaps."""

from collections.abc import Iterator
from dataclasses import dataclass

from rich.cells import cell_len

from tftool.base.fixed_width import fitted
from tftool.drawing import theme

FARTHEST_ROWS = 7
"""How many rows away from its frame a label may stand; then a line leads to it."""


@dataclass(frozen=True, slots=True)
class Label:
    """A label to place.

    Attributes:
        name: Name of the frame.
        text: The written text.
        column: Column of the labelled frame.
        row: Row of the labelled frame.
        reach: Number of cells that the frame's sign takes to either side.
    """

    name: str
    text: str
    column: int
    row: int
    reach: int


@dataclass(frozen=True, slots=True)
class PlacedLabel:
    """A label's first cell, and whether it is far from its frame."""

    label: Label
    column: int
    row: int
    is_far: bool


def label_text(name: str, age: float, columns: int, least: int, *, ascii_only: bool) -> str:
    """Return the text beside a frame: its name, cut, and how long a silent one is silent.

    Args:
        name: What to call it.
        age: Seconds without news.
        columns: Cells across of the picture.
        least: Cells that a name gets in a narrow one.
        ascii_only: Write in ASCII alone.
    """
    more = "~" if ascii_only else "…"
    text = fitted(name, max(least, columns // 3), more=more)
    if theme.is_stale(age):
        text = f"{text} {age:.1f} s ago"
    text = fitted(text, columns, more=more)
    return text.encode("ascii", "replace").decode("ascii") if ascii_only else text


class Placer:
    """Placer of labels that keeps good positions between pictures.

    Args:
        columns: Cells across.
        rows: Cells down.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.columns, self.rows = columns, rows
        self._before: dict[str, tuple[int, int]] = {}

    def placed(
        self, labels: list[Label], hard: set[tuple[int, int]], soft: set[tuple[int, int]]
    ) -> list[PlacedLabel]:
        """Place every label; omit one for which there is no room nearby.

        Args:
            labels: The most important ones first.
            hard: Cells (row, column) that no text may cover; those of the labels are added.
            soft: Cells it had better not cover.
        """
        found = []
        for label in labels:
            width = cell_len(label.text)
            best: tuple[float, int, int] | None = None
            for cost, column, row in self._places(label, width):
                if best is not None and cost >= best[0]:
                    continue
                cells = [(row, column + offset) for offset in range(width)]
                if any(cell in hard for cell in cells):
                    continue
                cost += 0.4 * sum(cell in soft for cell in cells)
                # Beside a neighbour of the same line it would read as one word with it.
                cost += 3.0 * ((row, column - 1) in hard and column - 1 != label.column)
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
