"""Report of a calibration: one HTML page with curves, without scripts."""

from html import escape
from typing import Final

import numpy as np

from tftool.base.escaping import visible
from tftool.base.stamps import NANOSECONDS
from tftool.buffer.batch.transform_array import TransformArray
from tftool.drawing import calibration_view
from tftool.frames.calibration.calibrate import Calibration
from tftool.frames.calibration.motion import BodyMotion, Floats
from tftool.geometry import rigid_arrays as batch

_WIDTH, _HEIGHT, _EDGE = 900.0, 240.0, 56.0
_MOST_POINTS: Final = 1500
_INKS: Final = ("#2452c9", "#c0392b", "#1e8449")
_STYLE: Final = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 940px; margin: 2em auto; padding: 0 1em; }
pre { background: #8882; padding: 1em; overflow-x: auto; }
svg { width: 100%; height: auto; } svg text { font-size: 12px; fill: currentColor; }
:root { color-scheme: light dark; }
"""

Curve = tuple[str, Floats, Floats]
"""Name, abscissas, ordinates."""


def page(found: Calibration, a: TransformArray, b: TransformArray) -> str:
    """Return the page: result, trajectories before and after, residuals, correlation, axes."""
    parts = [f"<pre>{escape(calibration_view.lines(found))}</pre>"]
    first, second = BodyMotion.of(a), BodyMotion.of(b)
    if found.inverted[1]:
        second = second.inverted()
    if found.clock is not None:
        curve = found.clock.lags, found.clock.curve
        parts.append(_figure("Correlation of the rotations", "offset, s", "", [("", *curve)]))
    if found.mount is not None and found.fixed_mount is not None:
        parts += _aligned(found, first, second)
    title = visible(f"{found.moving[1]} on {found.moving[0]}")
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{_STYLE}</style><h1>Calibration: {escape(title)}</h1>{''.join(parts)}</html>\n"
    )


def _aligned(found: Calibration, a: BodyMotion, b: BodyMotion) -> list[str]:
    """Draw the two aligned trajectories, A · X and Y · B, whose difference the fit minimises."""
    assert found.mount is not None
    assert found.fixed_mount is not None
    assert found.clock_offset is not None
    times = b.times + (found.clock_offset - (a.start - b.start) / NANOSECONDS)
    places, turns, valid = a.at(times)
    places, turns, times = places[valid], turns[valid], times[valid]
    count = len(times)

    def all_rows(values: tuple[float, ...]) -> Floats:
        return np.broadcast_to(np.array(values), (count, len(values)))

    mounted = places + batch.rotate(turns, all_rows(found.mount.translation))
    turned = batch.multiply(turns, all_rows(found.mount.rotation))
    join = all_rows(found.fixed_mount.rotation)
    seen = b.positions[valid]
    reached = batch.rotate(join, seen) + np.array(found.fixed_mount.translation)
    reached_turns = batch.multiply(join, b.rotations[valid])
    distances = np.linalg.norm(mounted - reached, axis=1) * 1e3
    angles = np.degrees(batch.angles_between(turned, reached_turns))
    spins = batch.rotation_vectors(batch.multiply(batch.conjugate(turns[:-10]), turns[10:]))
    degrees = np.degrees(spins)
    return [
        _figure("Before, from above", "x, m", "y, m", [
            ("A", places[:, 0], places[:, 1]), ("B", seen[:, 0], seen[:, 1]),
        ]),
        _figure("After: A · X and Y · B, from above", "x, m", "y, m", [
            ("A · X", mounted[:, 0], mounted[:, 1]), ("Y · B", reached[:, 0], reached[:, 1]),
        ]),
        _figure("Distance between them", "time, s", "mm", [("", times, distances)]),
        _figure("Angle between them", "time, s", "°", [("", times, angles)]),
        _figure("Turns about the axes of A, over ten poses of B", "time, s", "°", [
            (name, times[:-10], degrees[:, place]) for place, name in enumerate("xyz")
        ]),
    ]  # fmt: skip


def _figure(title: str, across: str, up: str, curves: list[Curve]) -> str:
    xs, ys = (np.concatenate([one[axis][np.isfinite(one[2])] for one in curves]) for axis in (1, 2))
    if not len(xs):
        return ""
    (left, right), (low, high) = _ends(xs), _ends(ys)

    def place(x: Floats, y: Floats) -> tuple[Floats, Floats]:
        return (
            _EDGE + (x - left) / (right - left) * (_WIDTH - 2 * _EDGE),
            _HEIGHT - 30.0 - (y - low) / (high - low) * (_HEIGHT - 50.0),
        )

    drawn = []
    for number, (name, x, y) in enumerate(curves):
        step = -(-len(x) // _MOST_POINTS)
        kept = np.isfinite(y[::step])
        h, v = place(x[::step][kept], y[::step][kept])
        points = " ".join(f"{one:.1f},{two:.1f}" for one, two in zip(h, v, strict=True))
        ink = _INKS[number % 3]
        drawn.append(f'<polyline points="{points}" fill="none" stroke="{ink}" stroke-width="1.3"/>')
        drawn.append(f'<text x="{_WIDTH - 70:.0f}" y="{30 + 16 * number}" fill="{ink}" '
                     f'style="fill: {ink}">{escape(name)}</text>')  # fmt: skip
    for value, column, row in (
        (left, _EDGE, _HEIGHT - 10),
        (right, _WIDTH - _EDGE, _HEIGHT - 10),
        (low, 4.0, _HEIGHT - 30),
        (high, 4.0, 26.0),
    ):
        drawn.append(f'<text x="{column:.0f}" y="{row:.0f}">{value:.4g}</text>')
    middle = _WIDTH / 2
    drawn.append(f'<text x="{middle:.0f}" y="{_HEIGHT - 10:.0f}">{escape(across)}</text>')
    drawn.append(f'<text x="4" y="{_HEIGHT / 2:.0f}">{escape(up)}</text>')
    return (
        f'<h2>{escape(title)}</h2><svg viewBox="0 0 {_WIDTH:.0f} {_HEIGHT:.0f}" role="img" '
        f'aria-label="{escape(title)}">{"".join(drawn)}</svg>'
    )


def _ends(values: Floats) -> tuple[float, float]:
    low, high = float(values.min()), float(values.max())
    return (low, high) if high > low else (low - 0.5, high + 0.5)
