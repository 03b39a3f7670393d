"""One transform in every notation, or in words, as text lines and as JSON."""

import math
from collections.abc import Sequence
from typing import Final

from tftool.base.plain_text import visible
from tftool.geometry.conversions import axis_angle_from_quaternion, matrix_from_quaternion
from tftool.geometry.notation.notations import (
    EULER,
    NAMED_FORMS,
    NOTATIONS,
    Notation,
    exact,
    notation_of,
    publisher_words,
    urdf_origin,
)
from tftool.geometry.rigid import Transform, Vector3

POSE_FORMS: Final = ("matrix4", "urdf", "static")
"""Notations that include the translation."""

TARGETS: Final = (*NAMED_FORMS, *POSE_FORMS, *EULER)
"""Notations that can be printed alone."""

_WIDTH: Final = 18
_POLE: Final = 1.0 - 1e-9


def as_object(transform: Transform) -> dict[str, object]:
    """Return a transform in every notation as a mapping, for --json; names end in the unit."""
    turn = transform.rotation
    found: dict[str, object] = {"translation": list(transform.translation)}
    for notation in NOTATIONS.values():
        found |= notation.as_object(notation.write(turn))
    return found | {
        "matrix": [list(row) for row in matrix_from_quaternion(turn)],
        "matrix4": [list(row) for row in _matrix4(transform)],
        "euler_rad": {axes: list(one.write(turn)) for axes, one in EULER.items()},
    }


def alone(transform: Transform, form: str, *, degrees: bool = False) -> str:
    """Return a transform in one notation with full precision; a matrix has a line per row.

    Args:
        transform: Transform to write.
        form: Notation, one of `TARGETS`.
        degrees: Whether to write angles in degrees.
    """
    turn = transform.rotation
    if form == "matrix":
        return _rows(matrix_from_quaternion(turn))
    if form == "matrix4":
        return _rows(_matrix4(transform))
    if form == "urdf":
        return urdf_origin(transform)
    if form == "static":
        return " ".join(publisher_words(transform))
    notation = notation_of(form)
    numbers = notation.write(turn)
    return " ".join(map(exact, notation.scaled(numbers, math.degrees) if degrees else numbers))


def lines(
    transform: Transform, *, with_translation: bool, precision: int = 6, all_orders: bool = False
) -> str:
    """Return a transform in every notation; a notation takes one or a few lines.

    Args:
        transform: Transform to write.
        with_translation: Whether to write the translation as well.
        precision: Number of decimals.
        all_orders: Whether to add all 24 orders of Euler angles.
    """
    turn = transform.rotation

    def shown(numbers: Sequence[float]) -> str:
        return " ".join(rounded(one, precision) for one in numbers)

    def angles(numbers: Sequence[float]) -> str:
        degrees = [math.degrees(one) for one in numbers]
        return f"{shown(numbers)} rad · {shown(degrees)} deg"

    def row_of(notation: Notation) -> tuple[str, str]:
        numbers = notation.write(turn)
        plain, turned = numbers[: notation.plain], numbers[notation.plain :]
        parts = [shown(plain)] if plain else []
        return notation.title, ", ".join([*parts, *([angles(turned)] if turned else [])])

    matrix = _matrix4(transform) if with_translation else matrix_from_quaternion(turn)
    texts = [[rounded(one, precision) for one in row] for row in matrix]
    wide = max(len(one) for row in texts for one in row)
    rows = [" ".join(one.rjust(wide) for one in row) for row in texts]
    table = [
        *([("translation", shown(transform.translation))] if with_translation else []),
        *map(row_of, NOTATIONS.values()),
        *(("matrix" if number == 0 else "", row) for number, row in enumerate(rows)),
        ("URDF", urdf_origin(transform)),
        ("static publisher", " ".join(publisher_words(transform))),
    ]
    if all_orders:
        table += map(row_of, EULER.values())
    return "".join(f"{name:<{_WIDTH}}  {text}\n" for name, text in table)


def at_a_pole(transform: Transform) -> bool:
    """Whether the pitch is ±90°, so that only the sum of roll and yaw is determined."""
    return abs(matrix_from_quaternion(transform.rotation)[2][0]) > _POLE


def rounded(number: float, precision: int) -> str:
    """Format a number with at most `precision` decimals, without trailing zeros or "-0"."""
    text = f"{number:.{precision}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _matrix4(transform: Transform) -> tuple[tuple[float, ...], ...]:
    rows = matrix_from_quaternion(transform.rotation)
    moved = zip(rows, transform.translation, strict=True)
    return (*((*row, place) for row, place in moved), (0.0, 0.0, 0.0, 1.0))


def _rows(matrix: Sequence[Sequence[float]]) -> str:
    return "\n".join(" ".join(map(exact, row)) for row in matrix)


AXES = ("x", "y", "z")

# Smaller numbers are left out of the sentence.
NOTHING = 5e-7


def static_lines(parent: str, child: str, pose: Transform) -> str:
    """Return the pose of `child` in `parent` in static_transform_publisher's form and in words."""
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
