"""Rates and delays of received transforms as curves that fill a screen."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from rich.cells import cell_len
from rich.style import Style
from rich.text import Text

from tftool.base.color import Color
from tftool.base.plain_text import short_duration, three_digits, visible
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.buffer.traffic import FrameTraffic, Series, Traffic
from tftool.drawing import theme
from tftool.drawing.cells import Dots, blended, packed
from tftool.drawing.sparklines import TrafficHistory, TrafficLook, sparkline
from tftool.drawing.table_columns import fitted, padded, rest_of_list
from tftool.drawing.traffic_view import (
    bar,
    delay_digits,
    is_silent,
    late_style,
    milliseconds,
    present_rate,
    rate_words,
    silence,
)
from tftool.geometry.rigid_arrays import Floats

LONGEST: Final = seconds(60)
SHORTEST: Final = seconds(1)
"""Shortest time in nanoseconds that the curves show; the time grows to a minute."""

NUMBER: Final = 10
"""Width in cells of a number with its unit."""

GUTTER: Final = 8
"""Cells at the left of a curve for its scale."""

WITH_SCALE: Final = 3
"""Smallest number of lines of a curve with a scale."""

WITH_MIDDLE: Final = 5
"""Smallest number of lines of a curve whose scale has a label in the middle."""

SPIKE: Final = 4.0
"""A curve's rare values are cut if they are more than this many times its usual values."""

_STEPS: Final = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


@dataclass(frozen=True, slots=True)
class TrafficLayout:
    """Size and style of the curves.

    Attributes:
        width: Width in cells.
        height: Height in lines.
        palette: Colours of the screen.
        ascii_only: Whether to draw with ASCII only.
        first: Index of the first row to show.
        fills: Whether the area below curves is filled; False for a screen without colours.
        names: Width in cells of the column of names.
    """

    width: int
    height: int
    palette: theme.Palette = theme.DARK
    ascii_only: bool = False
    first: int = 0
    fills: bool = True
    names: int = 30

    @property
    def more(self) -> str:
        """Sign that replaces omitted text."""
        return "~" if self.ascii_only else "…"

    @property
    def curve(self) -> int:
        """Width of the rate curve, and of the delay curve, in cells; 0 if there is no room."""
        left = self.width - self.names - 2 * NUMBER - 2
        return left // 2 if left >= 2 * (GUTTER + 6) else 0

    def ink(self, color: Color, *, bold: bool = False) -> Style:
        """Return the style of text in a colour."""
        return theme.ink(color, bold=bold)

    def state(self, late: str) -> Color:
        """Return the colour of a frame's numbers for `late`, the result of `late_style`."""
        palette = self.palette
        return {"yellow": palette.warning, "red": palette.error}.get(late, palette.text)


def curves(
    now: Stamp, links: Sequence[FrameTraffic], history: TrafficHistory, layout: TrafficLayout
) -> list[Text]:
    """Draw each frame's rate and delay over the last minute, in equally many lines per frame.

    Args:
        now: Current time of the clock in nanoseconds.
        links: Frames with their parents, from top to bottom.
        history: Earlier rates and delays of each frame.
        layout: Size and style.
    """
    dim = layout.ink(layout.palette.dim)
    if not links:
        return [Text("No transforms yet.", dim)]
    longest = max(cell_len(word) for one in links for word in _names(one, layout)) + 1
    layout = replace(layout, names=max(10, min(30, layout.width // 4, longest)))
    window = _window(now, links, history)
    digits = delay_digits(one.series for one in links if not one.is_static)
    lines = [_heading(as_seconds(window), layout)][: layout.height - 1]
    room = layout.height - len(lines)
    shown = links[layout.first :]
    if len(links) > room:
        shown = shown[: max(1, room - 1)]
    repeated = sum(not one.is_static for one in shown)
    spare = max(0, room - len(shown))
    for link in shown:
        extra = 0
        if not link.is_static and len(links) <= room:
            extra = -(-spare // repeated)
            spare, repeated = spare - extra, repeated - 1
        looks = history.looks(link.frame)
        lines += _block(now, link, looks, window, 1 + extra, digits, layout)
    if len(shown) < len(links):
        left = len(links) - len(shown) - layout.first
        words = rest_of_list(left, layout.first, ascii_only=layout.ascii_only)
        lines.append(Text(words, layout.ink(layout.palette.accent, bold=True)))
    return lines


def senders(now: Stamp, traffic: Traffic, layout: TrafficLayout) -> list[Text]:
    """Return a line per publisher: the rate as a bar and as a number, and the delays.

    Args:
        now: Current time of the clock in nanoseconds.
        traffic: Statistics of the received messages.
        layout: Size and style.
    """
    palette = layout.palette
    dim = layout.ink(palette.dim)
    found = sorted(traffic.senders.items())
    rates = {name: present_rate(now, one) or 0.0 for name, one in found}
    fastest = max(rates.values(), default=0.0)
    longest = max([cell_len(visible(name)) for name, _ in found], default=0)
    names = max(len("broadcaster"), min(longest, layout.width // 3))
    cells = layout.width - names - 3 * NUMBER - 4
    numbers = f"{'rate':>{NUMBER}}{'mean delay':>{NUMBER + 1}}{'max':>{NUMBER}}"
    top, digits = _above(fastest), delay_digits(traffic.senders.values())
    scale = f"  0{_short(top, 'Hz'):>{cells - 1}}" if cells >= 8 else ""
    words = padded("broadcaster", names) + numbers + scale
    lines = [Text(fitted(words, layout.width, more=""), dim)]
    room = layout.height - 1
    for name, one in found if len(found) <= room else found[: max(1, room - 1)]:
        late = late_style(now, one, False)
        line = Text.assemble(
            (padded(visible(name), names, more=layout.more), dim),
            (f"{rate_words(now, one):>{NUMBER}}", layout.ink(layout.state(late))),
            (
                f"{milliseconds(one.average_delay, digits):>{NUMBER + 1}}",
                layout.ink(layout.state(late)),
            ),
            (f"{milliseconds(one.maximum_delay, digits):>{NUMBER}}", dim),
        )
        if cells >= 8:
            drawn = bar(rates[name], top, cells, ascii_only=layout.ascii_only).replace("▇", "━")
            ink = layout.state(late) if late else _rate_color(palette)
            line.append("  " + drawn, layout.ink(ink))
        line.truncate(layout.width)
        lines.append(line)
    if len(found) > len(lines) - 1:
        words = f"{len(found) - len(lines) + 1} more"
        lines.append(Text(words, layout.ink(palette.accent, bold=True)))
    return lines


def _window(now: Stamp, links: Sequence[FrameTraffic], history: TrafficHistory) -> Duration:
    known = [look for one in links for look in history.looks(one.frame) if look.rate is not None]
    begun = min([one.moment for one in known], default=now)
    return max(SHORTEST, min(LONGEST, now - begun))


def _rate_color(palette: theme.Palette) -> Color:
    return Color(0, 120, 50) if palette is theme.LIGHT else Color(110, 230, 130)


def _delay_color(palette: theme.Palette) -> Color:
    return Color(0, 110, 160) if palette is theme.LIGHT else Color(110, 200, 255)


def _heading(span: float, layout: TrafficLayout) -> Text:
    past = f"last {span:.0f} s"
    wide = layout.curve
    words = padded("frame", layout.names)
    # The curve of delays shows maxima, beside the mean.
    for word, over in (("rate", past), ("mean delay", f"max, {past}")):
        over = over if len(over) < wide else past
        words += f"{word:>{NUMBER}} " + (f"{over:<{wide - 1}} " if wide else "")
    return Text(fitted(words, layout.width, more=""), layout.ink(layout.palette.dim))


def _block(
    now: Stamp,
    link: FrameTraffic,
    looks: Sequence[TrafficLook],
    window: Duration,
    height: int,
    digits: int,
    layout: TrafficLayout,
) -> list[Text]:
    """Return the lines of one frame: its name, and both curves beside their numbers."""
    palette = layout.palette
    dim = layout.ink(palette.dim)
    late = late_style(now, link.series, link.is_static)
    state = layout.ink(layout.state(late))
    color = theme.readable(theme.of_name(link.frame), palette)
    name = layout.ink(layout.state(late) if late else color, bold=True)
    # A blank line below keeps tall curves of neighbours apart.
    tall = height - 1 if height > WITH_SCALE else height
    rates, delays = _numbers(now, link, tall, digits)
    words = _names(link, layout, is_late=bool(late))
    healthy = layout.ink(layout.state(late) if late else _rate_color(palette))
    drawn = [
        _curve(looks, part, now, window, (layout.curve, tall), ink, layout)
        for part, color in ((1, _rate_color(palette)), (2, _delay_color(palette)))
        for ink in [layout.state(late) if late else color]
    ]
    lines = []
    for row in range(tall):
        word = words[row] if row < len(words) else ""
        line = Text(no_wrap=True, overflow="crop")
        line.append(padded(word, layout.names, more=layout.more), dim if row else name)
        if not row:
            line.stylize(healthy, 0, 1)
        for texts, cells in zip((rates, delays), drawn, strict=True):
            text = texts[row] if row < len(texts) else ""
            is_dim = row > 0 or link.is_static
            line.append(f"{text:>{NUMBER}} ", dim if is_dim else state)
            line.append_text(cells[row] if cells else Text())
        line.truncate(layout.width)
        lines.append(line)
    if tall < height:
        begin, wide = f"{as_seconds(window):.0f} s", max(0, layout.curve - GUTTER - 1)
        axis = f"{'':{NUMBER + 1 + GUTTER}}{begin}{'now':>{max(4, wide - len(begin))}} "
        has_curve = layout.curve > 0 and not link.is_static
        lines.append(Text(f"{'':{layout.names}}{axis * 2}" if has_curve else "", dim))
    return lines


def _names(link: FrameTraffic, layout: TrafficLayout, *, is_late: bool = False) -> list[str]:
    """Return three texts: a sign (on time or late) with the frame, the parent, the publisher."""
    sign = ("!" if is_late else "+") if layout.ascii_only else "●"
    return [
        f"{' ' if link.is_static else sign} {visible(link.frame)}",
        f"  in {visible(link.parent)}",
        f"  from {visible(link.sender)}",
    ]


def _numbers(now: Stamp, link: FrameTraffic, tall: int, digits: int) -> tuple[list[str], list[str]]:
    """Return the texts at the left of the rate curve, and the texts at the left of the delay curve.

    Args:
        now: Current time of the clock in nanoseconds.
        link: Frame with its parent.
        tall: Height of the curves in lines.
        digits: Number of decimals of delays.
    """
    series: Series = link.series
    if link.is_static:
        return ["static"], []
    rates = [rate_words(now, series)]
    if is_silent(now, series, link.is_static):
        since = f"{short_duration(silence(now, series))} ago"
        rates = [*rates, since] if tall > 1 else [since]
    most = series.maximum_delay
    words = "" if most is None else f"max {most * 1e3:.{digits}f}"
    return rates, [milliseconds(series.average_delay, digits), words]


def _curve(
    looks: Sequence[TrafficLook],
    part: int,
    now: Stamp,
    window: Duration,
    size: tuple[int, int],
    color: Color,
    layout: TrafficLayout,
) -> list[Text]:
    """Draw one filled curve, from 0 to a round number above its maximum; one line per row."""
    columns, rows = size
    if not columns or not looks:
        return [Text(" " * columns)] * rows
    columns -= 1
    palette = layout.palette
    found = [one for one in looks if one.moment >= now - window]
    values: list[float | None] = [one[part] for one in found]
    if rows < WITH_SCALE:
        # The maximum of a small curve is written after the curve.
        most = max((one for one in values if one is not None), default=None)
        unit = "ms" if part == 2 else "Hz"
        told = "" if most is None else _short(most * (1e3 if part == 2 else 1.0), unit)
        shown = sparkline(values, max(0, columns - GUTTER), ascii_only=layout.ascii_only)
        last = Text(f"{shown:{max(0, columns - GUTTER)}}", layout.ink(color))
        last.append(f"{told:>{min(columns, GUTTER)}} ", layout.ink(palette.dim))
        return [*[Text(" " * (columns + 1))] * (rows - 1), last]
    columns -= GUTTER
    highest = _highest([one for one in values if one is not None])
    # A scale of a few microseconds would only magnify jitter.
    top = max(1e-3, _above(highest))
    heights = _heights(found, values, now, window, 2 * columns) / top
    cut = np.unique(np.flatnonzero(heights > 1.0) // 2).tolist()
    shown_top = top * (1e3 if part == 2 else 1.0)
    scale = {0: _short(shown_top, "ms" if part == 2 else "Hz"), rows - 1: "0"}
    if rows >= WITH_MIDDLE and rows % 2:
        scale[rows // 2] = _short(0.5 * shown_top)
    lines = []
    for row, cells in enumerate(_filled(heights, columns, rows, color, layout)):
        for column in cut if not row else ():
            cells[column] = "^" if layout.ascii_only else "▲", cells[column][1]
        line = Text(f"{scale.get(row, ''):>{GUTTER - 1}} ", layout.ink(palette.dim))
        lines.append(line.append_text(Text.assemble(*cells)).append(" "))
    return lines


def _highest(values: list[float]) -> float:
    """Return the largest value that a curve should show, without rare spikes."""
    if not values:
        return 0.0
    usual = float(np.quantile(values, 0.85))
    return min(max(values), 1.5 * usual) if max(values) > SPIKE * usual > 0.0 else max(values)


def _heights(
    looks: Sequence[TrafficLook],
    values: Iterable[float | None],
    now: Stamp,
    window: Duration,
    count: int,
) -> Floats:
    """Return the values of a curve at `count` equidistant times, shape (count,).

    Args:
        looks: Measurements, whose times are used.
        values: Value of each measurement; None if unknown.
        now: Current time of the clock in nanoseconds, the last of the times.
        window: Time from the first to the last of the times, nanoseconds.
        count: Number of times, one per column of dots.

    Returns:
        Interpolated values; NaN before the first measurement.
    """
    moments = np.array([as_seconds(one.moment - now + window) for one in looks])
    known = np.array([math.nan if one is None else one for one in values])
    at = np.linspace(0.0, as_seconds(window), count)
    drawn: Floats = np.interp(at, moments, known, left=math.nan)
    return drawn


def _filled(
    heights: Floats,
    columns: int,
    rows: int,
    color: Color,
    layout: TrafficLayout,
) -> list[list[tuple[str, str]]]:
    """Return the cells of a curve: bright dots above a fill that fades towards the bottom."""
    dots = Dots(columns, rows)
    last = 4 * rows - 1
    known = np.flatnonzero(np.isfinite(heights))
    tops = last - np.rint(np.clip(heights[known], 0.0, 1.0) * last).astype(np.int64)
    if layout.fills and not layout.ascii_only:
        counts = last + 1 - tops
        across = np.repeat(known, counts)
        down = last - (np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts))
        # A faint fill, so that the curve itself is what the eye follows.
        shares = 0.14 * (1.0 - down // 4 / max(1, rows)) + 0.06
        ground = np.full(len(down), packed(layout.palette.panel), np.int64)
        dots.mark(across, down, blended(ground, color, shares))
    points = np.stack([known + 0.5, tops + 0.5], 1)
    near = np.flatnonzero(np.diff(known) == 1)
    dots.draw(np.stack([points[near], points[near + 1]], 1), packed(color))
    return dots.rows(ascii_only=layout.ascii_only)


def _above(value: float) -> float:
    """Return a round number a little above a value."""
    if value <= 0.0:
        return 1.0
    wanted = 1.08 * value
    power = 10.0 ** math.floor(math.log10(wanted))
    return next((power * step for step in _STEPS if power * step >= wanted), 10.0 * power)


def _short(value: float, unit: str = "") -> str:
    if value >= 1e3 and unit:
        value, unit = 1e-3 * value, {"ms": "s", "Hz": "kHz"}[unit]
    return f"{three_digits(value)} {unit}".rstrip()
