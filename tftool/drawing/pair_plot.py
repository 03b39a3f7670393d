"""How a pair of frames went: its distance and its yaw over the last seconds, in braille."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from rich.text import Text

from tftool.base.color import Color
from tftool.base.stamps import Stamp, as_seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.drawing import theme
from tftool.drawing.braille_trail import Ink
from tftool.drawing.line_plot import draw_curve
from tftool.frames.pair_samples import trajectory_of
from tftool.frames.pair_series import PlotPanel, axis_number, panels

LABELS: Final = 7
"""Cells left of a curve, for what its axis says."""

TITLED_FROM: Final = 4
"""Lines of one curve from which it has a title of its own."""


@dataclass(frozen=True, slots=True)
class PlotSpan:
    """Which seconds are drawn, and which moment is marked in them.

    Attributes:
        first: The first moment.
        last: The last one.
        start: The moment that is 0 on the axis.
        cursor: The moment shown, where that is not the last one.
    """

    first: Stamp
    last: Stamp
    start: Stamp
    cursor: Stamp | None = None


def pair_plot(
    path: TransformArray,
    span: PlotSpan,
    width: int,
    height: int,
    palette: theme.Palette = theme.DARK,
    *,
    ascii_only: bool = False,
) -> list[Text]:
    """Draw distance and yaw one under the other, each on a scale that does not breathe.

    Args:
        path: The poses, a row a moment, NaN where there is none.
        span: Which seconds.
        width: Cells across.
        height: Lines there are.
        palette: The screen's colours.
        ascii_only: Whether to draw with plain characters.
    """
    columns = width - LABELS - 1
    with_axis = height >= 2 * TITLED_FROM + 1
    rows = (height - with_axis) // 2
    if columns < 8 or rows < 1:
        return []
    found = {one.title: one for one in panels([trajectory_of(path)], span.start, _QUANTITIES)}
    lines: list[Text] = []
    for title, unit, color in (
        ("distance", "m", theme.blend(palette.accent, palette.text, 0.1)),
        ("rotation", "°", _yaw_color(palette)),
    ):
        lines += _curve(found[title], title, unit, color, span, columns, rows, palette, ascii_only)
    if with_axis:
        first, last = (f"{as_seconds(t - span.start):.1f}" for t in (span.first, span.last))
        words = f"{'':{LABELS + 1}}{first}{last + ' s':>{max(0, columns - len(first))}}"
        lines.append(Text(words, theme.ink(palette.dim), no_wrap=True))
    return lines


_QUANTITIES: Final = ("distance", "yaw")


def _yaw_color(palette: theme.Palette) -> Color:
    return Color(0, 110, 160) if palette is theme.LIGHT else Color(110, 200, 255)


def _curve(
    panel: PlotPanel,
    title: str,
    unit: str,
    color: Color,
    span: PlotSpan,
    columns: int,
    rows: int,
    palette: theme.Palette,
    ascii_only: bool,
) -> list[Text]:
    (curve,) = panel.curves
    title, unit = ("yaw", "d" if ascii_only else unit) if title == "rotation" else (title, unit)
    first, last = (as_seconds(one - span.start) for one in (span.first, span.last))
    value = _value_at(curve.times, curve.values, span)
    said = "" if value is None else f"{value:.1f}{unit}" if unit != "m" else f"{value:.3f} {unit}"
    dim, strong = theme.ink(palette.dim), theme.ink(color, bold=True)
    lines = []
    labels = [""] * rows
    if rows >= TITLED_FROM:
        lines.append(Text.assemble((f"{title} ", dim), (said, strong), no_wrap=True))
        rows -= 1
    low, high = _scale(title, curve.values)
    if lines:
        labels = [axis_number(high), *[""] * (rows - 2), axis_number(low)]
    else:
        labels = [title[:4], *[""] * (rows - 2), said.replace(" ", "")][:rows]
    ink = Ink(columns, rows, 0.0, 0.0, 1.0)
    draw_curve(
        ink, (curve.times - first) / (last - first), (curve.values - low) / (high - low), color
    )
    marked = None
    if span.cursor is not None:
        share = (span.cursor - span.first) / max(1, span.last - span.first)
        marked = min(columns - 1, math.floor(share * columns)) if 0.0 <= share <= 1.0 else None
    bar, cursor = ("|", "|") if ascii_only else ("│", "┃")
    for row in range(rows):
        line = Text(f"{labels[row][:LABELS]:>{LABELS}}", dim if lines else strong, no_wrap=True)
        line.append(bar, dim)
        for column, cell in enumerate(ink.cells(row, ascii_only=ascii_only)):
            if column == marked:
                line.append(cursor, theme.ink(palette.warning, bold=True))
            elif cell.ink is not None:
                line.append(cell.text, theme.ink(cell.ink))
            else:
                line.append(" ")
        lines.append(line)
    return lines


def _value_at(times: np.ndarray, values: np.ndarray, span: PlotSpan) -> float | None:
    """The last value up to the moment shown."""
    moment = as_seconds((span.last if span.cursor is None else span.cursor) - span.start)
    holds = np.flatnonzero(np.isfinite(values) & (times <= moment + 1e-9))
    return float(values[holds[-1]]) if len(holds) else None


def _scale(title: str, values: np.ndarray) -> tuple[float, float]:
    """From nothing to a round number above, or all there is round."""
    if title == "yaw":
        return -180.0, 180.0
    holds = values[np.isfinite(values)]
    highest = float(holds.max()) if len(holds) else 1.0
    power = 10.0 ** math.floor(math.log10(max(highest, 1e-3)))
    steps = (1.0, 2.0, 5.0, 10.0)
    return 0.0, next((power * one for one in steps if power * one >= highest), 10.0 * power)
