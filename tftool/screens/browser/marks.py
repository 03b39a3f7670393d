"""Marks on the page's timeline: times without data, and the doctor's findings."""

from math import degrees
from typing import Any, Final

from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer
from tftool.doctor.evidence import evidence_of_buffer
from tftool.doctor.gap_checks import gap, holes
from tftool.doctor.judge import judge
from tftool.doctor.localisation_steps import LocalisationStep, steps_of
from tftool.doctor.missing_joins import base_of
from tftool.doctor.model import Settings
from tftool.screens.browser.page_messages import answer
from tftool.screens.browser.protocol import since

MOST_GAPS: Final = 2000
"""Largest number of gaps in the message; the longest gaps are sent."""

MOST_FINDINGS: Final = 200
"""Largest number of findings in the message; the worst findings are sent."""


def marks_of(buffer: Buffer, epoch: Stamp) -> dict[str, Any]:
    """Return the message with the marks of the timeline: times without data, and findings.

    All times are seconds since the epoch.

    Args:
        buffer: Buffer that the doctor examines; checks that need times of reception do not run.
        epoch: Time that is 0 on the page, nanoseconds.
    """
    frames = buffer.snapshot(0).frames
    if not any(frame.samples > 1 and not frame.is_static for frame in frames):
        return answer("marks", {"gaps": [], "findings": []})
    diagnosis = judge(evidence_of_buffer(buffer), Settings())
    gaps = [
        (track.child, low, high)
        for track in diagnosis.model.dynamic
        for low, high in holes(track, gap.limits)
    ]
    gaps = sorted(gaps, key=lambda hole: hole[1] - hole[2])[:MOST_GAPS]
    # Jumps are only judged for robots: turtles, which have no base frame, turn sharply.
    robots = any(base_of(tree) for tree in diagnosis.model.trees)
    steps = steps_of(diagnosis.model) if robots else ()
    found = [one for one in diagnosis.findings if one.since is not None]
    found.sort(key=lambda one: one.severity.rank)
    return answer(
        "marks",
        {
            "gaps": [[frame, since(epoch, low), since(epoch, high)] for frame, low, high in gaps],
            "findings": [
                {
                    "id": one.id,
                    "severity": one.severity.value,
                    "message": one.message,
                    "since": since(epoch, one.since or 0),
                    "until": since(epoch, one.until or one.since or 0),
                }
                for one in found[:MOST_FINDINGS]
            ]
            + [_step(step, epoch) for step in steps[:MOST_FINDINGS]],
        },
    )


def _step(step: LocalisationStep, epoch: Stamp) -> dict[str, Any]:
    """Return a mark for a sudden jump of a robot's pose as estimated by a localiser."""
    parent, child = step.edge
    at = since(epoch, step.stamp)
    message = f"{child} in {parent} steps {step.moved * 1e3:.0f} mm, {degrees(step.turned):.1f}°"
    return {"id": "step", "severity": "note", "message": message, "since": at, "until": at}
