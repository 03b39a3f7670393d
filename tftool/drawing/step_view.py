"""Jumps ("steps") in the pose of a localiser or odometry, for terminals and --json."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from tftool.base.plain_text import visible
from tftool.base.stamps import as_seconds
from tftool.doctor.localisation_steps import LocalisationStep
from tftool.doctor.model import Model
from tftool.doctor.wording import span

SCHEMA = "tftool.steps/1"


def render(model: Model, steps: Sequence[LocalisationStep]) -> RenderableType:
    """Return a table of jumps: time, frames, size, and the drift since the previous jump."""
    if not steps:
        return Text(visible(f"{model.evidence.name}: no steps"))
    table = Table(box=None, pad_edge=False, title_justify="left", title_style="bold")
    counted = "1 step" if len(steps) == 1 else f"{len(steps):,} steps"
    table.title = visible(f"{model.evidence.name}: {counted}")
    for name in ("at", "edge", "within", "step", "", "drift before it", ""):
        table.add_column(name, justify="left" if name == "edge" else "right", no_wrap=True)
    for step in steps:
        parent, child = step.edge
        table.add_row(
            f"{as_seconds(step.stamp - model.epoch):.3f} s",
            visible(f"{child} in {parent}"),
            span(step.within),
            *_both(step.moved, step.turned),
            *_both(step.drift_moved, step.drift_turned),
        )
    return table


def _both(metres: float, radians: float) -> tuple[str, str]:
    return f"{metres * 1e3:.1f} mm", f"{np.degrees(radians):.2f}°"


def as_object(model: Model, steps: Sequence[LocalisationStep]) -> dict[str, Any]:
    """Return jumps as a mapping, for --json: whole nanoseconds, metres and radians."""
    return {
        "schema": SCHEMA,
        "source": model.evidence.name,
        "steps": [
            {
                "parent": step.edge[0],
                "child": step.edge[1],
                "stamp": step.stamp,
                "within": step.within,
                "moved": step.moved,
                "turned": step.turned,
                "drift": {"moved": step.drift_moved, "turned": step.drift_turned},
            }
            for step in steps
        ],
    }
