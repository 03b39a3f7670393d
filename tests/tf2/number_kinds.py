"""Vectors of kinds `math` and `time`: rotations, and seconds as nanoseconds and as text."""

import math
from collections.abc import Callable, Mapping
from typing import Any

from tests.tf2.loader import DEFAULT, Unknown, close, fields, negated
from tftool.base.stamps import as_seconds, display, seconds
from tftool.geometry import conversions, quaternions
from tftool.ros.tf2 import euler

Step = Mapping[str, Any]


def rows(numbers: list[float]) -> list[list[float]]:
    return [numbers[0:3], numbers[3:6], numbers[6:9]]


NUMBERS: dict[str, tuple[tuple[str, ...], Callable[[Step], Any]]] = {
    "quat_from_rpy": (("rpy",), lambda step: conversions.quaternion_from_rpy(*step["rpy"])),
    "rpy_from_quat": (("q",), lambda step: conversions.rpy_from_quaternion(step["q"])),
    "rpy_from_quat_2": (("q",), lambda step: conversions.second_rpy_from_quaternion(step["q"])),
    "slerp": (
        ("q1", "q2", "t"),
        lambda step: euler.quaternion_slerp(step["q1"], step["q2"], step["t"]),
    ),
    "multiply": (("q1", "q2"), lambda step: quaternions.multiply(step["q1"], step["q2"])),
    "rotate": (("q", "v"), lambda step: quaternions.rotate(step["q"], step["v"])),
    "matrix_from_quat": (("q",), lambda step: sum(quaternions.matrix(step["q"]), ())),
    "quat_from_matrix": (("m",), lambda step: conversions.quaternion_from_matrix(rows(step["m"]))),
    "roundtrip": (("q",), lambda step: quaternions.canonical(quaternions.unit(step["q"]))),
    "angle_half": (
        ("q1", "q2"),
        lambda step: [0.5 * quaternions.angle_between(step["q1"], step["q2"])],
    ),
    "angle_shortest": (
        ("q1", "q2"),
        lambda step: [quaternions.angle_between(step["q1"], step["q2"])],
    ),
}


def _values(step: Step) -> Step:
    """Convert the lists of a step to the tuples that a program uses."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in step.items()}


def same_rotation(found: Any, wanted: Any) -> bool:
    return close(found, wanted) or close(found, negated(wanted))


def rpy_roundtrip(step: Step) -> None:
    """Check angles at the poles, at which upstream's angles are a different rotation."""
    fields(step, "rpy", "want")
    turned = conversions.quaternion_from_rpy(*step["rpy"])
    angles = conversions.rpy_from_quaternion(turned)
    assert same_rotation(conversions.quaternion_from_rpy(*angles), turned)
    assert abs(abs(angles[1]) - math.pi / 2) < DEFAULT


def slerp_halves(step: Step) -> None:
    """Check that the middle rotation is equally far from start and end."""
    fields(step, "ypr", "want")
    yaw, pitch, roll = step["ypr"]
    end = conversions.quaternion_from_euler((yaw, pitch, roll), "ryxz")
    half = euler.quaternion_slerp(quaternions.IDENTITY, end, 0.5)
    to_half = quaternions.angle_between(quaternions.IDENTITY, half)
    assert abs(to_half - quaternions.angle_between(half, end)) < 1e-5
    assert to_half > 0.2


def run_math(case: Step) -> None:
    for step in case["steps"]:
        if step["op"] == "rpy_roundtrip":
            rpy_roundtrip(step)
        elif step["op"] == "slerp_halves":
            slerp_halves(step)
        elif step["op"] in NUMBERS:
            read, ask = NUMBERS[step["op"]]
            fields(step, *read, "want", "tol")
            want = step["want"] if isinstance(step["want"], list) else [step["want"]]
            assert close(ask(_values(step)), want, step.get("tol", DEFAULT)), step
        else:
            raise Unknown(f"operation {step['op']}")


TIMES: dict[str, Callable[[Any], Any]] = {
    "duration_from_sec": seconds,
    "duration_to_sec": as_seconds,
    "display_time": display,
}


def run_time(case: Step) -> None:
    for step in case["steps"]:
        fields(step, "value", "want")
        if step["op"] not in TIMES:
            raise Unknown(f"operation {step['op']}")
        assert TIMES[step["op"]](step["value"]) == step["want"], step
