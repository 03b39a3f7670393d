"""Errors between two trajectories, as a table, as JSON, and as panels of a figure."""

from typing import Final

import numpy as np

from tftool.base.plain_text import visible
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.drawing.recording_view import table, wrapped
from tftool.frames.pair_series import PlotCurve, PlotPanel
from tftool.frames.trajectory_errors import ErrorColumn, TrajectoryErrors

_FITS: Final = {
    "none": "not aligned",
    "first": "B aligned by its first pose",
    "se3": "B aligned (SE(3))",
    "sim3": "B aligned and scaled (Sim(3))",
}
_MATCHES: Final = {
    "nearest": "nearest stamps within 10 ms",
    "interpolate": "A interpolated at the stamps of B",
}
_FIGURES: Final = ("rmse", "mean", "median", "std", "min", "max")


def lines(found: TrajectoryErrors, names: tuple[str, str], width: int | None = None) -> str:
    """Return the errors as text: both trajectories, their matching, and a line per kind of error.

    Args:
        found: The errors.
        names: Names of trajectories A and B.
        width: Longest line in cells; None for no limit.
    """
    text = [
        f"{side} {visible(name)}: {visible(source)} in {visible(target)}, {total} poses"
        for side, name, (target, source), total in zip(
            "AB", names, found.pairs, found.counts, strict=True
        )
    ]
    rows = []
    for one in found.columns:
        figures = one.statistics()
        label = one.name + (f" per {found.step}" if one.name == "rpe" else "")
        rows.append((label, one.unit, *(f"{figures[name]:.6g}" for name in _FIGURES)))
    text += ["", *table(("error", "unit", *_FIGURES), rows, right=_FIGURES), ""]
    scale = f", scale {found.scale:.6g}" if found.fit == "sim3" else ""
    text += wrapped(
        f"{found.matched} poses matched: {_MATCHES[found.match]}; {_FITS[found.fit]}{scale}.", width
    )
    return "".join(f"{line.rstrip()}\n" for line in text)


def as_object(found: TrajectoryErrors, names: tuple[str, str]) -> dict[str, object]:
    """Return the errors between two trajectories as a mapping, for --json."""
    kinds = dict.fromkeys(one.name for one in found.columns)
    return {
        "a": names[0],
        "b": names[1],
        "pairs": [{"target": target, "source": source} for target, source in found.pairs],
        "poses": list(found.counts),
        "matched": found.matched,
        "match": found.match,
        "fit": found.fit,
        "scale": found.scale,
        "per": {"size": found.step.size, "unit": found.step.unit},
        **{
            kind: {one.unit: one.statistics() for one in found.columns if one.name == kind}
            for kind in kinds
        },
    }


def panels(found: TrajectoryErrors) -> list[PlotPanel]:
    """Return a panel for each kind of error, over the seconds since the first matched pose."""
    start = min(int(one.stamps[0]) for one in found.columns)
    return [
        PlotPanel(one.name.upper(), one.unit.replace("deg", "°"), (_curve(one, start),))
        for one in found.columns
    ]


def _curve(one: ErrorColumn, start: Stamp) -> PlotCurve:
    times = np.asarray((one.stamps - start) / NANOSECONDS, dtype=np.float64)
    return PlotCurve(one.name.upper(), 0, times, one.values)
