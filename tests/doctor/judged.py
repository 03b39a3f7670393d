"""Findings of the doctor on a small robot."""

import math

from tests.doctor.robots import Robot
from tftool.doctor.findings import Finding, Severity
from tftool.doctor.model import Settings


def found(made: Robot, name: str, settings: Settings | None = None) -> Finding:
    findings = [one for one in made.judged(settings).findings if one.id == name]
    assert findings, f"{name} is not among {[one.id for one in made.judged(settings).findings]}"
    return findings[0]


def ids(made: Robot, *, notes: bool = False) -> list[str]:
    return [
        one.id
        for one in made.judged().findings
        if one.because_of is None and (notes or one.severity is not Severity.NOTE)
    ]


def turned(angle: float, axis: int = 2) -> tuple[float, float, float, float]:
    rotation = [0.0, 0.0, 0.0, math.cos(angle / 2)]
    rotation[axis] = math.sin(angle / 2)
    return (rotation[0], rotation[1], rotation[2], rotation[3])
