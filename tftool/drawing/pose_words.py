"""Static pose described in words, which makes a wrong order of arguments visible."""

import math

from tftool.base.plain_text import visible
from tftool.geometry.conversions import axis_angle_from_quaternion
from tftool.geometry.rigid import Transform, Vector3

AXES = ("x", "y", "z")

# Smaller numbers are left out of the sentence.
NOTHING = 5e-7


def lines(parent: str, child: str, pose: Transform) -> str:
    """Return a pose as static_transform_publisher prints it, and in a sentence."""
    x, y, z = pose.translation
    qx, qy, qz, qw = pose.rotation
    return (
        f"translation: ('{x:f}', '{y:f}', '{z:f}')\n"
        f"rotation: ('{qx:f}', '{qy:f}', '{qz:f}', '{qw:f}')\n"
        f"from '{visible(parent)}' to '{visible(child)}'\n"
        f"{in_words(parent, child, pose)}\n"
    )


def in_words(parent: str, child: str, pose: Transform) -> str:
    """Describe the position of `child` in `parent`, and its rotation by axis and angle."""
    return f"{visible(child)} in {visible(parent)}: {_place(pose.translation)}, {_turn(pose)}."


def _place(translation: Vector3) -> str:
    parts = [
        f"{value:g} m along {axis}"
        for axis, value in zip(AXES, translation, strict=True)
        if abs(value) > NOTHING
    ]
    return " and ".join(parts) or "at the same place"


def _turn(pose: Transform) -> str:
    axis, angle = axis_angle_from_quaternion(pose.rotation)
    if abs(angle) < NOTHING:
        return "not turned"
    for name, part in zip(AXES, axis, strict=True):
        if abs(part) > 1.0 - NOTHING:
            degrees = math.copysign(math.degrees(angle), part)
            return f"turned {degrees:.3f}° about its {name} axis"
    x, y, z = axis
    return f"turned {math.degrees(angle):.3f}° about the axis ({x:.3f}, {y:.3f}, {z:.3f})"
