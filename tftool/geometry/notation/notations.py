"""Table of the notations of a rotation, with functions that read and write each notation.

A new notation needs one line in `NOTATIONS`.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final, TypeAlias

from tftool.geometry.conversions import (
    AXES,
    axis_angle_from_quaternion,
    euler_from_quaternion,
    precise_rpy_from_quaternion,
    quaternion_from_axis_angle,
    quaternion_from_euler,
    quaternion_from_rpy,
    wxyz_from_xyzw,
    xyzw_from_wxyz,
)
from tftool.geometry.rigid import Quaternion, Transform

Numbers: TypeAlias = Sequence[float]


@dataclass(frozen=True, slots=True)
class Notation:
    """One notation of a rotation, such as a quaternion or roll, pitch and yaw; angles in radians.

    Attributes:
        title: Title that is printed beside the numbers.
        count: Number of values in the notation.
        plain: Number of values before the first angle.
        read: Function that converts the values to a quaternion in xyzw order.
        write: Function that converts a unit quaternion to the values.
        as_object: Function that returns the values by name for JSON; {} if the JSON of another
            notation contains these values.
        read_as: Name of the notation in messages about a text that was read; "" for the title.
        aliases: Other words that name the notation in a text.
        wraps: Whether an angle of more than a full turn is probably a mistake.
    """

    title: str
    count: int
    plain: int
    read: Callable[[Numbers], Numbers]
    write: Callable[[Quaternion], Numbers]
    as_object: Callable[[Numbers], dict[str, object]]
    read_as: str = ""
    aliases: tuple[str, ...] = ()
    wraps: bool = False

    @property
    def is_quaternion(self) -> bool:
        """Whether the notation is a quaternion, that is, has no angles."""
        return self.plain == self.count

    def scaled(self, numbers: Numbers, scale: Callable[[float], float]) -> list[float]:
        """Return the values of a rotation with every angle converted to another unit by `scale`."""
        return [*numbers[: self.plain], *map(scale, numbers[self.plain :])]


def _axis_angle(turn: Quaternion) -> Numbers:
    axis, angle = axis_angle_from_quaternion(turn)
    return (*axis, angle)


def _rotation_vector(turn: Quaternion) -> Numbers:
    axis, angle = axis_angle_from_quaternion(turn)
    return [angle * one for one in axis]


def _of_rotation_vector(vector: Numbers) -> Numbers:
    length = math.hypot(*vector)
    return quaternion_from_axis_angle(vector, length) if length else (0.0, 0.0, 0.0, 1.0)


def _degrees(numbers: Numbers) -> list[float]:
    return [math.degrees(one) for one in numbers]


def _euler(axes: str) -> Notation:
    return Notation(
        f"Euler {axes}",
        3,
        0,
        lambda angles: quaternion_from_euler((angles[0], angles[1], angles[2]), axes),
        lambda turn: euler_from_quaternion(turn, axes),
        lambda _: {},
        read_as=f"Euler angles {axes}",
        wraps=True,
    )


NOTATIONS: Final[Mapping[str, Notation]] = MappingProxyType(
    {
        "xyzw": Notation(
            "quaternion x y z w",
            4,
            4,
            lambda numbers: numbers,
            lambda turn: turn,
            lambda numbers: {"quaternion_xyzw": list(numbers)},
        ),
        "wxyz": Notation(
            "quaternion w x y z",
            4,
            4,
            xyzw_from_wxyz,
            wxyz_from_xyzw,
            lambda numbers: {"quaternion_wxyz": list(numbers)},
        ),
        "rpy": Notation(
            "roll pitch yaw",
            3,
            0,
            lambda angles: quaternion_from_rpy(*angles),
            precise_rpy_from_quaternion,
            lambda angles: {"rpy_rad": list(angles), "rpy_deg": _degrees(angles)},
            wraps=True,
        ),
        "ypr": Notation(
            "yaw pitch roll",
            3,
            0,
            lambda angles: quaternion_from_rpy(*angles[::-1]),
            lambda turn: precise_rpy_from_quaternion(turn)[::-1],
            lambda _: {},
            wraps=True,
        ),
        "axis-angle": Notation(
            "axis, angle",
            4,
            3,
            lambda numbers: quaternion_from_axis_angle(numbers[:3], numbers[3]),
            _axis_angle,
            lambda numbers: {
                "axis": list(numbers[:3]),
                "angle_rad": numbers[3],
                "angle_deg": math.degrees(numbers[3]),
            },
            read_as="axis and angle",
            aliases=("axisangle", "axis"),
        ),
        "rotvec": Notation(
            "rotation vector",
            3,
            0,
            _of_rotation_vector,
            _rotation_vector,
            lambda vector: {"rotation_vector": list(vector)},
        ),
    }
)
"""Notations by the word that names them in `--as` and `--into`."""

EULER: Final[Mapping[str, Notation]] = MappingProxyType({axes: _euler(axes) for axes in AXES})
"""Notations of the 24 orders of Euler angles, by their axes."""

FORMS: Final = (*NOTATIONS, "matrix", *EULER)
"""All words that name the notation of bare numbers."""

NAMED_FORMS: Final = (*NOTATIONS, "matrix")
"""The words of `FORMS` that are listed in help: all but the orders of axes."""


def notation_of(form: str) -> Notation:
    """Return the notation called `form`, a name in `FORMS` other than "matrix"."""
    return NOTATIONS.get(form) or EULER[form]


def exact(number: float) -> str:
    """Format a number with the fewest digits that identify it; -0 becomes "0"."""
    text = repr(float(number) + 0.0)
    return text.removesuffix(".0")


def urdf_origin(transform: Transform) -> str:
    """Return URDF's `<origin>` element of a transform, exact to 1e-12."""
    xyz = " ".join(map(exact, transform.translation))
    rpy = " ".join(map(exact, precise_rpy_from_quaternion(transform.rotation)))
    return f'<origin xyz="{xyz}" rpy="{rpy}"/>'


def publisher_words(transform: Transform) -> list[str]:
    """Return static_transform_publisher's options for a transform, with the exact quaternion."""
    names = ("x", "y", "z", "qx", "qy", "qz", "qw")
    numbers = (*transform.translation, *transform.rotation)
    return [
        word
        for name, number in zip(names, numbers, strict=True)
        for word in (f"--{name}", exact(number))
    ]
