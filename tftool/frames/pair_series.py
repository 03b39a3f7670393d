"""Curves of trajectories over time for plots, grouped in panels, with gaps for missing data.

Times are seconds since the start of the source, as for the options `--from` and `--at`.
"""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from tftool.base.errors import UsageError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.pair_samples import RefusedRun, Trajectory
from tftool.geometry import rigid_arrays as batch

Floats = batch.Floats

MOST_TOLD: Final = 3
"""Maximum number of spans without poses whose reason is printed."""

_OUTSIDE: Final = re.compile(
    r"extrapolation into the (past|future)\..* from frame \[(.+)\] to frame \[(.+)\]"
)
_BEYOND: Final = {"past": "begins later", "future": "ends earlier"}
"""Short form of tf2's message on a time outside the data, for each side."""

LONG_SILENCE: Final = 10.0
"""Number of median periods without a sample that count as a gap."""


@dataclass(frozen=True, slots=True, eq=False)
class PlotCurve:
    """One curve over time in a panel of a plot.

    Attributes:
        label: Label of the curve: "x", or "laser in map" in a plot of several pairs of frames.
        place: Index of the pair of frames, from 0.
        times: Times in seconds, shape (n,).
        values: Values in the panel's unit, shape (n,); NaN in gaps.
    """

    label: str
    place: int
    times: Floats
    values: Floats


LEAST_SPAN: Final = {"m": 0.01, "°": 1.0, "m/s": 0.01, "°/s": 1.0}
"""Smallest span of an axis by unit; a smaller span would only magnify noise."""


@dataclass(frozen=True, slots=True, eq=False)
class PlotPanel:
    """Curves of a plot with a common axis.

    Attributes:
        title: Title of the panel, such as "position".
        unit: Unit of the values: "m", "°", "m/s" or "°/s".
        curves: The curves, in order.
    """

    title: str
    unit: str
    curves: tuple[PlotCurve, ...]

    def limits(self) -> tuple[float, float]:
        """Return limits of an axis for all curves; the limits differ by at least `LEAST_SPAN`."""
        values = np.concatenate([one.values for one in self.curves] or [np.zeros(1)])
        values = values[np.isfinite(values)]
        low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
        least = max(LEAST_SPAN.get(self.unit, 1e-6), 1e-6 * max(abs(low), abs(high)))
        apart = max(0.0, 0.5 * (least - (high - low)))
        return low - apart, high + apart


@dataclass(frozen=True, slots=True)
class RefusedSpan:
    """A time span, in seconds, in which the lookup of a pair fails, and the reason."""

    first: float
    last: float
    reason: str


def _position(path: TransformArray) -> Floats:
    return path.translations


def _angles(path: TransformArray) -> Floats:
    return np.asarray(np.degrees(batch.roll_pitch_yaw(path.rotations)))


def _distance(path: TransformArray) -> Floats:
    return np.asarray(np.linalg.norm(path.translations, axis=1))[:, np.newaxis]


def _speed(path: TransformArray) -> Floats:
    return np.asarray(np.linalg.norm(path.velocities().linear, axis=1))[:, np.newaxis]


def _turn_rate(path: TransformArray) -> Floats:
    turning = np.linalg.norm(path.velocities().angular, axis=1)
    return np.asarray(np.degrees(turning))[:, np.newaxis]


_GROUPS: Final[dict[str, tuple[str, tuple[str, ...], Callable[[TransformArray], Floats]]]] = {
    "position": ("m", ("x", "y", "z"), _position),
    "rotation": ("°", ("roll", "pitch", "yaw"), _angles),
    "distance": ("m", ("distance",), _distance),
    "speed": ("m/s", ("speed",), _speed),
    "turn rate": ("°/s", ("turn rate",), _turn_rate),
}

QUANTITIES: Final = tuple(name for _, names, _ in _GROUPS.values() for name in names)
"""Names of all quantities that can be drawn over time."""


def chosen(words: Sequence[str]) -> tuple[str, ...]:
    """Return the quantities for some names: names of quantities, or titles of panels of a plot.

    The title of a panel stands for all quantities in the panel.

    Raises:
        UsageError: If a word is neither a quantity nor a panel.
    """
    found: list[str] = []
    for word in words:
        name = word.strip().lower().replace("-", " ").replace("_", " ")
        if name in _GROUPS:
            found += _GROUPS[name][1]
        elif name in QUANTITIES:
            found.append(name)
        else:
            listed = ", ".join(dict.fromkeys((*_GROUPS, *QUANTITIES)))
            raise UsageError(f"'{word}' cannot be plotted: use {listed}.")
    return tuple(dict.fromkeys(found)) or QUANTITIES


def panels(
    found: Sequence[Trajectory], start: Stamp, quantities: Sequence[str] = QUANTITIES
) -> list[PlotPanel]:
    """Return panels with curves over time; several pairs get one panel per quantity.

    Args:
        found: Trajectories of the pairs.
        start: Stamp that is 0 on the time axis, nanoseconds.
        quantities: Quantities to draw, some of `QUANTITIES`.
    """
    several = len(found) > 1
    made: list[PlotPanel] = []
    for title, (unit, names, measure) in _GROUPS.items():
        wanted = [name for name in names if name in quantities]
        if not wanted:
            continue
        curves: dict[str, list[PlotCurve]] = {name: [] for name in wanted}
        for place, one in enumerate(found):
            times, columns, broken = _columns(one, start, measure)
            for name in wanted:
                values = columns[:, names.index(name)]
                gaps = broken | _jumps(values) if unit == "°" else broken
                label = f"{one.source} in {one.target}" if several else name
                curves[name].append(PlotCurve(label, place, *_with_gaps(times, values, gaps)))
        if several:
            made += [PlotPanel(name, unit, tuple(lines)) for name, lines in curves.items()]
        else:
            every = tuple(curve for lines in curves.values() for curve in lines)
            made.append(PlotPanel(title, unit, every))
    return made


def shades(found: Sequence[Trajectory], start: Stamp) -> list[RefusedSpan]:
    """Return the time spans in which lookups of any pair fail, in order of time.

    Args:
        found: Trajectories of the pairs.
        start: Stamp that is 0 on the time axis, nanoseconds.
    """
    spans = [_shade(run, start) for one in found for run in one.refusals]
    return sorted(spans, key=lambda span: span.first)


def reasons(spans: Sequence[RefusedSpan]) -> list[str]:
    """Return a sentence with the reason for each of the first spans, and a count of the others."""
    told = []
    for one in spans[:MOST_TOLD]:
        when = f"from {axis_number(one.first)} s to {axis_number(one.last)} s"
        if one.first == one.last:
            when = f"at {axis_number(one.first)} s"
        why = " ".join(one.reason.split())
        if outside := _OUTSIDE.search(why):
            side, source, target = outside.groups()
            why = f"the data {_BEYOND[side]} ({source} in {target})."
        told.append(f"No pose {when}{f': {why}' if why else '.'}")
    if len(spans) > MOST_TOLD:
        told.append(f"... and in {len(spans) - MOST_TOLD} more spans.")
    return told


def axis_number(value: float) -> str:
    """Format a number for an axis: four significant digits, within the width of a label."""
    if value == 0.0 or not math.isfinite(value):
        return "0"
    size = abs(value)
    if size >= 1e6 or size < 1e-3:
        return f"{value:.2e}"
    return f"{value:.{max(0, 3 - max(0, math.floor(math.log10(size))))}f}"


def round_ticks(low: float, high: float, most: int) -> list[float]:
    """Return ticks that enclose a span: multiples of 1, 2 or 5 times a power of ten.

    Args:
        low: Lower end of the span.
        high: Upper end, above `low`.
        most: Maximum number of ticks; at least two are returned, or three if 0 is inside the span.
    """
    # Zero is a multiple of every step, so two ticks cannot enclose it.
    most = max(most, 3 if low < 0.0 < high else 2)
    power = 10.0 ** math.floor(math.log10((high - low) / (most - 1)))
    for step in (factor * power for factor in (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)):
        first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
        if last - first < most:
            break
    return [round(place * step, 12) for place in range(first, last + 1)]


def tick_labels(ticks: Sequence[float]) -> list[str]:
    """Format the ticks of an axis with enough digits to distinguish them."""
    step = min((after - before for before, after in pairwise(ticks)), default=1.0)
    if max(map(abs, ticks), default=0.0) >= 1e6 or step < 1e-6:
        return [axis_number(tick) for tick in ticks]
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    return [f"{tick + 0.0:.{digits}f}" for tick in ticks]


def path_curves(found: Sequence[Trajectory]) -> list[tuple[str, Floats, Floats]]:
    """Return (label, x, y) of each pair's path, metres, for a plot from above; NaN in gaps."""
    curves = []
    for one in found:
        times, columns, broken = _columns(one, 0, _position)
        _, x = _with_gaps(times, columns[:, 0], broken)
        _, y = _with_gaps(times, columns[:, 1], broken)
        curves.append((f"{one.source} in {one.target}", x, y))
    return curves


def thinned(times: Floats, values: Floats, most: int) -> tuple[Floats, Floats]:
    """Thin out a curve to the minimum and the maximum of each part of the curve.

    Args:
        times: Times of the points, shape (n,).
        values: Values of the points, shape (n,).
        most: Approximate number of points to return.
    """
    if len(values) <= most:
        return times, values
    size = -(-2 * len(values) // most)
    kept = []
    for first in range(0, len(values), size):
        part = values[first : first + size]
        holds = np.isfinite(part)
        if not holds.any():
            kept.append(first)
            continue
        low, high = first + int(np.nanargmin(part)), first + int(np.nanargmax(part))
        ends = {low, high} if holds.all() else {low, high, first + int(np.argmin(holds))}
        kept += sorted(ends)
    return times[kept], values[kept]


def _shade(run: RefusedRun, start: Stamp) -> RefusedSpan:
    return RefusedSpan(
        (run.first - start) / NANOSECONDS, (run.last - start) / NANOSECONDS, run.reason
    )


def _columns(
    trajectory: Trajectory, start: Stamp, measure: Callable[[TransformArray], Floats]
) -> "tuple[Floats, Floats, np.ndarray]":
    """Return the points of a curve, and a mask of its gaps.

    Args:
        trajectory: Trajectory of a pair of frames.
        start: Stamp that is 0 on the time axis, nanoseconds.
        measure: Function that computes the values of the curve from poses.

    Returns:
        Times in seconds, shape (n,); values, shape (n,); and whether there is a gap after each
        point except the last, shape (n - 1,).
    """
    times = (trajectory.path.stamps - start) / NANOSECONDS
    apart = np.diff(times)
    usual = float(np.median(apart)) if len(apart) else 0.0
    return times, measure(trajectory.path), apart > LONG_SILENCE * usual


def _jumps(angles: Floats) -> "np.ndarray":
    """Return a mask of the steps at which an angle, in degrees, wraps around at ±180°."""
    with np.errstate(invalid="ignore"):
        found: np.ndarray = np.abs(np.diff(angles)) > 180.0
    return found


def _with_gaps(times: Floats, values: Floats, broken: "np.ndarray") -> tuple[Floats, Floats]:
    places = np.flatnonzero(broken) + 1
    if not len(places):
        return times, values
    return np.insert(times, places, times[places]), np.insert(values, places, np.nan)
