"""Differences of two frame trees, and errors of a trajectory, as text and as JSON."""

from typing import Final

import numpy as np
from rich.cells import cell_len

from tftool.base.plain_text import visible
from tftool.base.stamps import NANOSECONDS, Stamp, as_seconds
from tftool.drawing.recording_view import table, wrapped
from tftool.frames.differences import (
    Change,
    Differences,
    Displacement,
    LinkDifference,
    LinkState,
)
from tftool.frames.pair_series import PlotCurve, PlotPanel
from tftool.frames.trajectory_errors import ErrorColumn, TrajectoryErrors

HEAD: Final = ("link", "change", "mm", "degrees", "")


def lines(differences: Differences, width: int | None = None, *, everything: bool = False) -> str:
    """Return differences as text: a line for each frame whose transform differs, and a summary.

    Args:
        differences: The differences.
        width: Maximum length of a line in cells; None for no limit. Text that does not fit is
            written below the line of its frame.
        everything: Whether to include the frames whose transforms are equal in A and B.
    """
    told = differences.links if everything else differences.changed
    text = [f"A {visible(differences.first)}", f"B {visible(differences.second)}"]
    if told:
        text += ["", *_table([_row(one, differences.start) for one in told], width), ""]
    text += wrapped(summary(differences), width)
    return "".join(f"{line.rstrip()}\n" for line in text)


def _table(rows: list[tuple[str, ...]], width: int | None) -> list[str]:
    numbers = ("mm", "degrees")
    whole = table(HEAD, rows, right=numbers)
    if width is None or max(map(cell_len, whole)) <= width:
        return whole
    heading, *shown = table(
        HEAD[:-1], [row[:-1] for row in rows], width, optional=("change",), right=numbers
    )
    below = [wrapped(row[-1], width, "      ") if row[-1] else [] for row in rows]
    return [
        heading,
        *(one for line, more in zip(shown, below, strict=True) for one in (line, *more)),
    ]


def summary(differences: Differences) -> str:
    """Return a sentence with the number of transforms that differ between A and B."""
    unknown = sum(Change.unknown in one.changes for one in differences.links)
    unsure = unknown + sum(one.displacement is None and one.is_same for one in differences.links)
    count, total = len(differences.changed) - unknown, len(differences.links)
    limit = differences.tolerance
    measures = [f"{limit.millimetres:g} mm", f"{limit.degrees:g}°"]
    if limit.rate_percent is not None:
        measures.append(f"{limit.rate_percent:g} % of the rate")
    links = "link" if total == 1 else "links"
    if not count:
        compared = f"{total - unsure} of {total} {links} compared" if unsure else f"{total} {links}"
        same = f", the same within {' and '.join(measures)}" if unsure < total else ""
        return f"{compared}{same}."
    beside = f", {unsure} not measured" if unsure else ""
    differ = "differs" if count == 1 else "differ"
    return f"{count} of {total} {links} {differ} by more than {' or '.join(measures)}{beside}."


def as_object(differences: Differences) -> dict[str, object]:
    """Return differences as a mapping, for --json."""
    limit = differences.tolerance
    return {
        "a": differences.first,
        "b": differences.second,
        "differs": bool(differences),
        "tolerance": {
            "mm": limit.millimetres,
            "deg": limit.degrees,
            "rate_percent": limit.rate_percent,
        },
        "shift_ns": differences.shift,
        "notes": list(differences.notes),
        "links": [_link(one) for one in differences.links],
    }


def as_markdown(differences: Differences) -> str:
    """Return differences as a Markdown table in which all names are escaped."""
    rows = [_row(one, differences.start) for one in differences.changed]
    text = [f"**tftool diff** {_code(differences.first)} {_code(differences.second)}", ""]
    if rows:
        text += ["| link | change | mm | degrees | |", "| --- | --- | --: | --: | --- |"]
        text += ["| " + " | ".join(_code(cell) for cell in row) + " |" for row in rows]
        text.append("")
    text.append(summary(differences))
    return "\n".join(text) + "\n"


def _code(text: str) -> str:
    """Format a text as Markdown code in which no character has a special meaning."""
    shown = visible(text).replace("|", "¦").replace("`", "ˋ")
    return f"`{shown}`" if shown.strip() else ""


def _row(one: LinkDifference, start: Stamp) -> tuple[str, str, str, str, str]:
    apart = one.displacement
    return (
        visible(f"{one.child} in {one.parent}"),
        visible(_changes(one)),
        "-" if apart is None else _number(apart.millimetres),
        "-" if apart is None else _number(apart.degrees),
        _detail(one, start),
    )


def _changes(one: LinkDifference) -> str:
    words = []
    for change in one.changes:
        if change is Change.reparented and one.after is not None:
            words.append(f"new parent {one.after.parent}")
        elif change is Change.kind and one.before is not None and one.after is not None:
            words.append(f"{one.before.kind} → {one.after.kind}")
        elif change is Change.pose:
            words.append("moved")
        else:
            words.append(str(change))
    return ", ".join(words)


def _detail(one: LinkDifference, start: Stamp) -> str:
    words = []
    apart = one.displacement
    if apart is not None and apart.moved_mm is not None and apart.turned_deg is not None:
        if not one.is_same and (Change.pose in one.changes or not one.note):
            place = " ".join(
                f"{axis} {_signed(value)}"
                for axis, value in zip("xyz", apart.moved_mm, strict=True)
            )
            turn = " ".join(
                f"{name} {_signed(value)}"
                for name, value in zip(("roll", "pitch", "yaw"), apart.turned_deg, strict=True)
            )
            words.append(f"{place} mm, {turn}°")
    elif apart is not None and apart.worst_at is not None:
        words.append(
            f"RMS of {apart.moments}; worst {_number(apart.worst_millimetres)} mm, "
            f"{_number(apart.worst_degrees)}° at {as_seconds(apart.worst_at - start):.3f} s"
        )
    before, after = one.before, one.after
    if before is not None and after is not None and before.rate and after.rate:
        percent = (after.rate / before.rate - 1.0) * 100.0
        if Change.rate in one.changes or abs(percent) >= 1.0:
            words.append(f"{before.rate:.1f} → {after.rate:.1f} Hz ({percent:+.0f} %)")
    if one.note:
        words.append(visible(one.note))
    state = before or after
    if (before is None or after is None) and state is not None:
        words.append(str(state.kind))
    return "; ".join(words)


def _number(value: float) -> str:
    """Format a number with three significant digits and at most four decimals."""
    size = abs(value)
    if size < 5e-5:
        return "<0.0001" if size > 1e-9 else "0"
    return (
        f"{value:.0f}" if size >= 100.0 else f"{float(f'{value:.3g}'):.4f}".rstrip("0").rstrip(".")
    )


def _signed(value: float) -> str:
    text = _number(value)
    return text if text[0] in "-<0" and value <= 5e-5 else f"+{text}"


def _link(one: LinkDifference) -> dict[str, object]:
    return {
        "child": one.child,
        "changes": [str(change) for change in one.changes if change is not Change.same],
        "a": _state(one.before),
        "b": _state(one.after),
        "apart": _apart(one.displacement),
        "note": one.note or None,
    }


def _state(state: LinkState | None) -> dict[str, object] | None:
    if state is None:
        return None
    return {
        "parent": state.parent,
        "kind": str(state.kind),
        "samples": state.count,
        "rate_hz": state.rate,
    }


def _apart(apart: Displacement | None) -> dict[str, object] | None:
    if apart is None:
        return None
    found: dict[str, object] = {
        "mm": apart.millimetres,
        "deg": apart.degrees,
        "worst_mm": apart.worst_millimetres,
        "worst_deg": apart.worst_degrees,
        "worst_at_ns": apart.worst_at,
        "moments": apart.moments,
    }
    if apart.moved_mm is not None and apart.turned_deg is not None:
        found["moved_mm"] = list(apart.moved_mm)
        found["turned_deg"] = list(apart.turned_deg)
    return found


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


def error_lines(errors: TrajectoryErrors, names: tuple[str, str], width: int | None = None) -> str:
    """Return errors as text: names, number of matched poses, and a line per kind of error.

    Args:
        errors: The errors.
        names: Names of the two compared trajectories.
        width: Maximum length of a line in cells; None for no limit.
    """
    text = [
        f"{side} {visible(name)}: {visible(source)} in {visible(target)}, {total} poses"
        for side, name, (target, source), total in zip(
            "AB", names, errors.pairs, errors.counts, strict=True
        )
    ]
    rows = []
    for one in errors.columns:
        figures = one.statistics()
        label = one.name + (f" per {errors.step}" if one.name == "rpe" else "")
        rows.append((label, one.unit, *(f"{figures[name]:.6g}" for name in _FIGURES)))
    text += ["", *table(("error", "unit", *_FIGURES), rows, right=_FIGURES), ""]
    scale = f", scale {errors.scale:.6g}" if errors.fit == "sim3" else ""
    text += wrapped(
        f"{errors.matched} poses matched: {_MATCHES[errors.match]}; {_FITS[errors.fit]}{scale}.",
        width,
    )
    return "".join(f"{line.rstrip()}\n" for line in text)


def errors_as_object(errors: TrajectoryErrors, names: tuple[str, str]) -> dict[str, object]:
    """Return the errors between two trajectories as a mapping, for --json."""
    kinds = dict.fromkeys(one.name for one in errors.columns)
    return {
        "a": names[0],
        "b": names[1],
        "pairs": [{"target": target, "source": source} for target, source in errors.pairs],
        "poses": list(errors.counts),
        "matched": errors.matched,
        "match": errors.match,
        "fit": errors.fit,
        "scale": errors.scale,
        "per": {"size": errors.step.size, "unit": errors.step.unit},
        **{
            kind: {one.unit: one.statistics() for one in errors.columns if one.name == kind}
            for kind in kinds
        },
    }


def panels(errors: TrajectoryErrors) -> list[PlotPanel]:
    """Return plot panels of the errors over time, in seconds since the first matched pose."""
    start = min(int(one.stamps[0]) for one in errors.columns)
    return [
        PlotPanel(one.name.upper(), one.unit.replace("deg", "°"), (_curve(one, start),))
        for one in errors.columns
    ]


def _curve(one: ErrorColumn, start: Stamp) -> PlotCurve:
    times = np.asarray((one.stamps - start) / NANOSECONDS, dtype=np.float64)
    return PlotCurve(one.name.upper(), 0, times, one.values)
