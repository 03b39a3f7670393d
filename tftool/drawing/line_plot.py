"""Plots in braille dots for a terminal: curves over time, and paths seen from above."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from rich.text import Text

from tftool.base.color import Color
from tftool.base.plain_text import visible
from tftool.base.stamps import Stamp, as_seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.drawing import theme
from tftool.drawing.cells import Dots, merged, owners_of, packed, runs
from tftool.drawing.table_columns import fitted
from tftool.frames.pair_samples import Trajectory, trajectory_of
from tftool.frames.pair_series import (
    PlotPanel,
    RefusedSpan,
    axis_number,
    panels,
    path_curves,
    reasons,
    round_ticks,
    shades,
    thinned,
    tick_labels,
)
from tftool.geometry.rigid_arrays import Floats

LABELS: Final = 10
"""Cells at the left of a panel for the labels of its axis."""

MARK_EVERY: Final = 12
"""Cells of a curve from one of its signs to the next."""

_SIGNS: Final = "0123456789abcdefghijklmnopqrstuvwxyz"

NO_ROOM: Final = "  (a taller window shows the curve, or the key i)"
"""Note beside the title of a panel without room."""

NOISE: Final = 1e-6
"""Fraction of a panel's largest value below which a value is shown as 0."""

LAST_DIGIT: Final = 0.001
"""Last digit of a value with three decimals."""

LEAST_ROWS: Final = 3
ROWS: Final = 7
"""Lines of a panel if the height of the plot is not given."""

_DARK: Final = (Color(255, 110, 110), Color(110, 230, 110), Color(120, 165, 255),
                Color(255, 215, 80), Color(255, 130, 255), Color(80, 240, 240),
                Color(255, 160, 60), Color(190, 190, 190), Color(180, 130, 255))  # fmt: skip
_LIGHT: Final = (Color(175, 0, 0), Color(0, 115, 0), Color(0, 0, 215),
                 Color(135, 95, 0), Color(150, 0, 150), Color(0, 115, 135),
                 Color(190, 80, 0), Color(90, 90, 90), Color(90, 40, 190))  # fmt: skip


@dataclass(frozen=True, slots=True)
class PlotLook:
    """Size and style of a plot.

    Attributes:
        width: Width in cells.
        height: Height in lines; None for a height that suits the panels.
        ascii_only: Whether to draw with ASCII characters.
        light: Whether the background is light.
        numbered: Whether to show each curve's number, which is the key to press to hide the curve.
        hidden: Numbers of the curves that are hidden.
        marked: Whether to write each curve's number on the curve, in addition to its colour.
    """

    width: int = 80
    height: int | None = None
    ascii_only: bool = False
    light: bool = False
    numbered: bool = False
    hidden: frozenset[int] = frozenset()
    marked: bool = False

    @property
    def colors(self) -> tuple[Color, ...]:
        """Colours of the curves, in order."""
        return _LIGHT if self.light else _DARK

    def color(self, number: int) -> Color:
        """Return the colour of curve `number`; numbers count from 1 through all panels."""
        return self.colors[(number - 1) % len(self.colors)]

    @property
    def bar(self) -> str:
        """Character between the axis labels and a panel."""
        return "|" if self.ascii_only else "│"


def over_time(
    trajectories: Sequence[Trajectory],
    start: Stamp,
    quantities: Sequence[str],
    look: PlotLook,
    *,
    span: tuple[float, float] | None = None,
) -> Text:
    """Draw panels below each other on one time axis; times without a pose are shaded.

    Args:
        trajectories: Trajectories of the pairs.
        start: Stamp that is 0 on the time axis, nanoseconds.
        quantities: Quantities to draw, of `pair_series.QUANTITIES`.
        look: Size and style of the plot.
        span: First and last second of the axis; None for the first and last second of the data.
    """
    drawn = panels(trajectories, start, quantities)
    shaded = shades(trajectories, start)
    low, high = span or _span(drawn, shaded)
    told = [visible(one) for one in reasons(shaded)]
    text = Text(no_wrap=True, overflow="crop")
    is_named = len(trajectories) == 1 and not look.numbered
    if is_named:
        # With several pairs, each curve has its own name; a live plot has a title bar.
        pair = visible(f"{trajectories[0].source} in {trajectories[0].target}")
        text.append(f"{fitted(pair, look.width)}\n", style="bold")
    numbers = [1 + sum(len(one.curves) for one in drawn[:place]) for place in range(len(drawn))]
    # A panel whose curves are all hidden is only a title, and leaves its lines to the others.
    seen = [
        place
        for place, (number, one) in enumerate(zip(numbers, drawn, strict=True))
        if not look.hidden.issuperset(range(number, number + len(one.curves)))
    ]
    tall, taller = ROWS, 0
    if look.height is not None:
        around = 2 + len(told) + is_named
        room = look.height - around - len(drawn)
        if look.numbered:
            seen = seen[: max(1, room // LEAST_ROWS)]
        tall = max(LEAST_ROWS, room // max(1, len(seen)))
        # With an odd number of lines, a tick in the middle line is exactly in the middle.
        tall -= 1 - tall % 2
        # The first panels share the lines that remain, in pairs.
        taller = max(0, room - tall * len(seen)) // 2
    for place, (number, panel) in enumerate(zip(numbers, drawn, strict=True)):
        # On a screen, a panel without room is a title: its values stay visible.
        hides = place not in seen and not look.hidden.issuperset(
            range(number, number + len(panel.curves))
        )
        text.append_text(_titled(panel, look, number, NO_ROOM if hides else ""))
        if place in seen:
            rows = tall + 2 * (seen.index(place) < taller)
            for line in _drawn(panel, (low, high), shaded, rows, look, number):
                text.append_text(line)
    columns = max(10, look.width - LABELS - 1)
    text.append(f"{'':>{LABELS + 1}}{axis_labels(low, high, columns)}\n")
    for reason in told:
        text.append(f"{fitted(reason, look.width)}\n", style="dim")
    return text


def from_above(trajectories: Sequence[Trajectory], look: PlotLook) -> Text:
    """Draw each pair's path in the x-y plane, at the same scale on both axes.

    Args:
        trajectories: Trajectories of the pairs.
        look: Size and style of the plot.
    """
    curves = path_curves(trajectories)
    colors = look.colors
    xs = np.concatenate([x for _, x, _ in curves])
    ys = np.concatenate([y for _, _, y in curves])
    left, right, bottom, top = np.nanmin(xs), np.nanmax(xs), np.nanmin(ys), np.nanmax(ys)
    room = max(10, look.width - LABELS - 1)
    rows = max(
        LEAST_ROWS, min(room // 2, 30 if look.height is None else look.height - 3 - len(curves))
    )
    columns = min(room, 4 * rows)
    # Metres per cell across and down: cells are twice as high as wide.
    per_cell = max((right - left) / columns, (top - bottom) / (2.0 * rows), 1e-9)
    wide, high = per_cell * columns, 2.0 * per_cell * rows
    middle_x, middle_y = 0.5 * (left + right), 0.5 * (bottom + top)
    left, bottom = middle_x - 0.5 * wide, middle_y - 0.5 * high
    layers = [Dots(columns, rows) for _ in curves]
    for place, (_, x, y) in enumerate(curves):
        color = colors[place % len(colors)]
        draw_curve(layers[place], (x - left) / wide, (y - bottom) / high, color)
    is_marked = look.marked and len(curves) > 1
    text = Text(no_wrap=True, overflow="crop")
    for place, (label, x, y) in enumerate(curves):
        holds = np.flatnonzero(np.isfinite(x))
        ends = ", ".join(
            f"{word} at {axis_number(float(x[at]))} {axis_number(float(y[at]))}"
            for word, at in (("begins", holds[0]), ("ends", holds[-1]))
        )
        sign = f"{_sign(1 + place)} " if is_marked else ""
        text.append(
            f"{fitted(f'{sign}{visible(label)} {ends}', look.width)}\n",
            _style(colors[place % len(colors)]),
        )
    ticks = round_ticks(bottom, bottom + high, max(2, rows // 4))
    places = [math.floor((bottom + high - tick) / high * rows) for tick in ticks]
    labels = dict(zip(places, tick_labels(ticks), strict=True))
    grid = merged(layers).rows(ascii_only=look.ascii_only)
    if is_marked:
        signs = [_sign(1 + place) for place in range(len(curves))]
        _mark(grid, layers, signs, ascii_only=look.ascii_only)
    for row, cells in enumerate(grid):
        text.append_text(_row(labels.get(row, ""), cells, look))
    edge = axis_labels(left, left + wide, columns, "m")
    text.append(f"{'y, x in m':>{LABELS}} {edge}\n")
    return text


def _span(drawn: Sequence[PlotPanel], shaded: Sequence[RefusedSpan]) -> tuple[float, float]:
    ends = [(float(one.times[0]), float(one.times[-1])) for p in drawn for one in p.curves]
    ends += [(one.first, one.last) for one in shaded]
    low, high = min(first for first, _ in ends), max(last for _, last in ends)
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _titled(panel: PlotPanel, look: PlotLook, number: int, note: str) -> Text:
    """Return a panel's title line, with the name and last value of each curve, and a note."""
    line = Text(f"{panel.title}, {panel.unit}", style="bold")
    is_alone = len(panel.curves) == 1 and panel.curves[0].label == panel.title
    for place, one in enumerate(panel.curves):
        holds = np.flatnonzero(np.isfinite(one.values))
        last = float(one.values[holds[-1]]) if len(holds) else math.nan
        value = "" if math.isnan(last) else _value(last, max(map(abs, panel.limits())))
        is_marked = look.marked and len(panel.curves) > 1
        is_key = look.numbered and number + place < 10
        label = "" if is_alone else visible(one.label)
        key = _sign(number + place) + ":" * (not label) if is_key or is_marked else ""
        is_hidden = number + place in look.hidden
        style = "dim strike" if is_hidden else _style(look.color(number + place))
        line.append("  ").append(" ".join(filter(None, (key, label, value))), style)
    line.append(note, "dim")
    line.truncate(look.width, overflow="ellipsis")
    line.append("\n")
    return line


def _value(last: float, largest: float) -> str:
    """Format the last value of a curve; a value that is tiny compared with `largest` becomes "0".

    Args:
        last: The last value.
        largest: Largest absolute value in the panel.
    """
    if abs(last) < NOISE * largest:
        return "0"
    # Beside values of a tenth and more, powers of ten would only show noise.
    is_small = 0.0 < abs(last) < LAST_DIGIT and largest >= 0.1
    return f"{round(last, 3) + 0.0:.3f}" if is_small else axis_number(last)


def _drawn(
    panel: PlotPanel,
    span: tuple[float, float],
    shaded: Sequence[RefusedSpan],
    rows: int,
    look: PlotLook,
    number: int = 1,
) -> Iterable[Text]:
    columns = max(10, look.width - LABELS - 1)
    seen = [place for place in range(len(panel.curves)) if number + place not in look.hidden]
    shown = replace(panel, curves=tuple(panel.curves[place] for place in seen))
    ticks = _ticks(shown.limits(), rows)
    low, high = ticks[0], ticks[-1]
    labels = [""] * rows
    labels[:: (rows - 1) // (len(ticks) - 1)] = reversed(tick_labels(ticks))
    first, last = span
    layers = [Dots(columns, rows)]
    signs = [" "]
    for place in seen:
        signs.append(_sign(number + place))
        one = panel.curves[place]
        times, values = thinned(one.times, one.values, 16 * columns)
        layers.append(Dots(columns, rows))
        draw_curve(
            layers[-1],
            (times - first) / (last - first),
            (values - low) / (high - low),
            look.color(number + place),
        )
    shade = [" "] * columns
    for refused in shaded:
        begin = math.floor((refused.first - first) / (last - first) * columns)
        end = math.ceil((refused.last - first) / (last - first) * columns)
        for column in range(
            max(0, min(begin, columns - 1)), max(0, min(max(end, begin + 1), columns))
        ):
            shade[column] = ":" if look.ascii_only else "░"
    grid = merged(layers).rows(ascii_only=look.ascii_only)
    if look.marked and len(panel.curves) > 1:
        _mark(grid, layers, signs, ascii_only=look.ascii_only)
    for label, cells in zip(labels, grid, strict=True):
        below = zip(cells, shade, strict=True)
        yield _row(label, [cell if cell[1] else (sign, "dim") for cell, sign in below], look)


def _sign(number: int) -> str:
    """Return the character that stands for a curve: its number, or a letter from the tenth on."""
    return _SIGNS[number % len(_SIGNS)]


def _mark(
    grid: list[list[tuple[str, str]]],
    layers: Sequence[Dots],
    signs: Sequence[str],
    *,
    ascii_only: bool,
) -> None:
    """Write each curve's character into some cells of the curve, a few cells apart.

    In ASCII, the other cells of curves have "-", or "=" for several curves in the cell.
    """
    counts = np.sum([one.masks > 0 for one in layers], axis=0)
    owners = np.where(counts > 0, owners_of(layers), -1).T
    if ascii_only:
        for column, row in np.argwhere(owners >= 0).tolist():
            grid[row][column] = "=" if counts[row, column] > 1 else "-", grid[row][column][1]
    every = MARK_EVERY
    for number, sign in enumerate(signs):
        shown = np.argwhere(owners == number)
        for column, row in shown[min(every, len(shown)) // 2 :: every].tolist():
            grid[row][column] = sign, grid[row][column][1]


def _ticks(limits: tuple[float, float], rows: int) -> list[float]:
    """Return ticks of a vertical axis, from the first to the last line of the panel.

    The distance of two ticks is a whole number of lines, so each label is exactly at its tick.
    """
    choices = (2,) if rows < 5 else (3,) if rows < 10 else (6, 5, 4, 3)
    found = (round_ticks(*limits, most) for most in choices)
    return next(ticks for ticks in found if (rows - 1) % (len(ticks) - 1) == 0)


def _row(label: str, cells: Iterable[tuple[str, str]], look: PlotLook) -> Text:
    text = Text.assemble(f"{label:>{LABELS}}{look.bar}", *runs(cells), no_wrap=True)
    text.rstrip()
    return text.append("\n")


def draw_curve(dots: Dots, across: Floats, up: Floats, color: Color) -> None:
    """Draw a curve in the unit square, with gaps at NaN; a single value is a dot."""
    rows, columns = dots.masks.shape
    points = np.stack([across * (2 * columns), (1.0 - up) * (4 * rows)], 1)
    ends = points if len(points) == 1 else points[:-1]
    dots.draw(np.stack([ends, points[-len(ends) :]], 1), packed(color))


def axis_labels(low: float, high: float, columns: int, unit: str = "s") -> str:
    """Format the labels of a horizontal axis: round numbers, and the unit at the end."""
    # A tick slightly outside the data is written at the edge.
    slack = 0.02 * (high - low)
    found = round_ticks(low, high, max(3, columns // 12))
    ticks = [tick for tick in found if low - slack <= tick <= high + slack]
    line = [" "] * columns
    end = 0
    for tick, label in zip(ticks, tick_labels(ticks), strict=True):
        place = round((tick - low) / (high - low) * (columns - 1)) - len(label) // 2
        place = max(0, min(place, columns - 2 - len(label)))
        if place >= end:
            line[place : place + len(label)] = label
            end = place + len(label) + 1
    line[-1] = unit
    return "".join(line)


def _style(color: Color) -> str:
    return theme.hexadecimal(color)


PAIR_LABELS: Final = 7
"""Cells at the left of a curve of `pair_plot` for the labels of its axis."""

LOWEST_SCALED: Final = 3
"""Smallest number of lines of a plot with a title line."""

SCALED_FROM: Final = 5
"""Smallest number of lines of a plot whose curves have scales."""

LABELLED_FROM: Final = 5
"""Smallest number of lines of a curve whose scale has a label in the middle."""

TITLED_FROM: Final = 3
"""Smallest number of lines of a curve with a title line of its own."""


@dataclass(frozen=True, slots=True)
class PlotSpan:
    """Span of time to draw, and the time to mark in it; all in nanoseconds.

    Attributes:
        first: First time.
        last: Last time.
        start: Time that is 0 on the time axis.
        cursor: Time to mark; None for `last`.
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
    note: str = "",
) -> list[Text]:
    """Draw the distance between two frames over time and, if there is room, their relative yaw.

    Args:
        path: Poses of the pair, NaN at times without a pose. The scale fits the whole path.
        span: Span of time to draw.
        width: Width in cells.
        height: Height in lines.
        palette: Colours of the screen.
        ascii_only: Whether to draw with ASCII characters.
        note: Text after the last values, such as "9 s old"; the values are then dim.
    """
    columns = width - PAIR_LABELS - 1
    # A low plot has only the distance: its title has the yaw, and the time if no line has it.
    is_low = LOWEST_SCALED <= height < 2 * TITLED_FROM + 1
    with_axis = height > LOWEST_SCALED and height != SCALED_FROM
    rows = height - with_axis - 1 if is_low else (height - with_axis) // 2
    if columns < 8 or rows < 1:
        return []
    found = {one.title: one for one in panels([trajectory_of(path)], span.start, _QUANTITIES)}
    lines: list[Text] = []
    titles: list[Text] = []
    for title, unit, color in (
        ("distance", "m", theme.blend(palette.accent, palette.text, 0.1)),
        ("rotation", "°", _yaw_color(palette)),
    ):
        curve = _curve(
            found[title], title, unit, color, span, columns, rows, palette, ascii_only, is_low
        )
        if is_low and lines:
            lines[0].append("  ").append_text(curve[0]).truncate(width)
            continue
        if is_low or rows >= TITLED_FROM:
            titles.append(curve[0])
        lines += curve
    for title_line in titles if note else ():
        title_line.stylize(theme.ink(palette.dim))
        title_line.append(f"  {note}", theme.ink(palette.warning))
        title_line.truncate(width)
    first, last = (f"{as_seconds(t - span.start):.1f}" for t in (span.first, span.last))
    if is_low and not with_axis:
        over = f"{float(first):.0f}{'-' if ascii_only else '–'}{float(last):.0f} s"
        room = width - lines[0].cell_len
        if room > len(over):
            lines[0].append(f"{over:>{room}}", theme.ink(palette.dim))
    if with_axis:
        words = f"{'':{PAIR_LABELS + 1}}{first}{last + ' s':>{max(0, columns - len(first))}}"
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
    is_low: bool,
) -> list[Text]:
    (curve,) = panel.curves
    title, unit = ("yaw", "d" if ascii_only else unit) if title == "rotation" else (title, unit)
    first, last = (as_seconds(one - span.start) for one in (span.first, span.last))
    value = _value_at(curve.times, curve.values, span)
    said = "" if value is None else f"{value:z.1f}{unit}" if unit != "m" else f"{value:.3f} {unit}"
    dim, strong = theme.ink(palette.dim), theme.ink(color, bold=True)
    lines = []
    labels = [""] * rows
    if is_low or rows >= TITLED_FROM:
        lines.append(Text.assemble((f"{title} ", dim), (said, strong), no_wrap=True))
        rows -= not is_low
    low, high = _scale(title, curve.values)
    if lines and rows > 1:
        labels = [f"{high:g}", *[""] * (rows - 2), f"{low:g}"]
        if rows >= LABELLED_FROM and rows % 2:
            labels[rows // 2] = f"{0.5 * (low + high):g}"
    elif lines:
        dash, both = ("-", "+-") if ascii_only else ("–", "±")
        labels = [f"{both}{high:g}" if low == -high else f"{low:g}{dash}{high:g}"]
    else:
        labels = [title[:4], *[""] * (rows - 2), said.replace(" ", "")][:rows]
    dots = Dots(columns, rows)
    draw_curve(
        dots, (curve.times - first) / (last - first), (curve.values - low) / (high - low), color
    )
    marked = None
    if span.cursor is not None:
        share = (span.cursor - span.first) / max(1, span.last - span.first)
        marked = min(columns - 1, math.floor(share * columns)) if 0.0 <= share <= 1.0 else None
    bar, cursor = ("|", "|") if ascii_only else ("│", "┃")
    for label, cells in zip(labels, dots.rows(ascii_only=ascii_only), strict=True):
        if marked is not None:
            cells[marked] = cursor, f"bold {theme.hexadecimal(palette.warning)}"
        shown = f"{label[:PAIR_LABELS]:>{PAIR_LABELS}}"
        style = dim if lines else strong
        lines.append(Text.assemble((shown, style), (bar, dim), *runs(cells), no_wrap=True))
    return lines


def _value_at(times: np.ndarray, values: np.ndarray, span: PlotSpan) -> float | None:
    """Return the last value at or before the marked time; None without such a value."""
    moment = as_seconds((span.last if span.cursor is None else span.cursor) - span.start)
    holds = np.flatnonzero(np.isfinite(values) & (times <= moment + 1e-9))
    return float(values[holds[-1]]) if len(holds) else None


def _scale(title: str, values: np.ndarray) -> tuple[float, float]:
    """Return the limits of a curve's axis: -180° to 180° for yaw, else 0 to a round number."""
    if title == "yaw":
        return -180.0, 180.0
    holds = values[np.isfinite(values)]
    highest = float(holds.max()) if len(holds) else 1.0
    power = 10.0 ** math.floor(math.log10(max(highest, 1e-3)))
    steps = (1.0, 2.0, 5.0, 10.0)
    return 0.0, next((power * one for one in steps if power * one >= highest), 10.0 * power)
