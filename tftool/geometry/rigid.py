"""One rigid transform in plain floats: compose, invert, apply, interpolate.

A transform `a_from_b` is the pose of b in a, and moves points given in b into a:
`a_from_c == a_from_b @ b_from_c`, `point_in_a == a_from_b.apply(point_in_b)`.
"""

import math
from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

from tftool.geometry import quaternions

Matrix: TypeAlias = tuple[tuple[float, float, float, float], ...]
"""A 4×4 matrix, row by row."""


class Vector3(NamedTuple):
    """A point or a vector, in metres unless said otherwise."""

    x: float
    y: float
    z: float


class Quaternion(NamedTuple):
    """A rotation; xyzw order as in ROS messages, unit length unless a stranger made it."""

    x: float
    y: float
    z: float
    w: float


# Named tuples, made in half the time a frozen dataclass takes; a lookup makes four.
class _Parts(NamedTuple):
    translation: Vector3
    rotation: Quaternion


class Transform(_Parts):
    """A rotation and then a translation; a value: frozen, hashable, equal when its numbers are.

    The quaternion is kept as it is given. Wherever it is used, any finite one but
    zero stands for the rotation in its direction; zero makes every result NaN.

    Attributes:
        translation: `Vector3`, metres.
        rotation: `Quaternion`, xyzw.
    """

    __slots__ = ()

    def __new__(
        cls,
        translation: Iterable[float] = (0.0, 0.0, 0.0),
        rotation: Iterable[float] = (0.0, 0.0, 0.0, 1.0),
    ) -> "Transform":
        """Build a transform from three and four numbers.

        Raises:
            ValueError: If there are not three and four of them, or one is no number.
        """
        return tuple.__new__(
            cls,
            (
                Vector3(*_floats(translation, 3, "translation")),
                Quaternion(*_floats(rotation, 4, "rotation")),
            ),
        )

    @classmethod
    def identity(cls) -> "Transform":
        """The transform that moves nothing."""
        return IDENTITY

    def __matmul__(self, other: "Transform") -> "Transform":
        """Chain: `a_from_b @ b_from_c` is `a_from_c`."""
        return compose(self, other)

    def inverse(self) -> "Transform":
        """The transform the other way round: `b_from_a` of `a_from_b`."""
        return invert(self)

    def apply(self, point: Iterable[float]) -> Vector3:
        """Move a point: given in b, it comes out in a."""
        return apply(self, point)

    def rotate(self, vector: Iterable[float]) -> Vector3:
        """Turn a direction, a velocity, an axis: the rotation without the translation."""
        x, y, z = vector
        return Vector3(*quaternions.rotate(quaternions.unit(self.rotation), (x, y, z)))

    def matrix(self) -> Matrix:
        """The same as a homogeneous 4×4 matrix, row by row."""
        first, second, third = quaternions.matrix(self.rotation)
        x, y, z = self.translation
        return ((*first, x), (*second, y), (*third, z), (0.0, 0.0, 0.0, 1.0))


def _floats(numbers: Iterable[float], count: int, what: str) -> tuple[float, ...]:
    try:
        floats = tuple(float(number) for number in numbers)
    except (TypeError, ValueError) as error:
        raise ValueError(f"a {what} is {count} numbers, not {numbers!r}") from error
    if len(floats) != count:
        raise ValueError(f"a {what} is {count} numbers, not {len(floats)}: {numbers!r}")
    return floats


def transform(translation: quaternions.Triple, rotation: quaternions.Quad) -> Transform:
    """Wrap seven floats, unchecked: for numbers that come from arithmetic."""
    new = tuple.__new__
    return new(Transform, (new(Vector3, translation), new(Quaternion, rotation)))


IDENTITY = Transform()


def compose(first: Transform, second: Transform) -> Transform:
    """`a_from_c` from `a_from_b` and `b_from_c`; the quaternions' product keeps its sign."""
    turn = quaternions.unit(first.rotation)
    x, y, z = quaternions.rotate(turn, second.translation)
    tx, ty, tz = first.translation
    return transform(
        (x + tx, y + ty, z + tz),
        quaternions.multiply(turn, quaternions.unit(second.rotation)),
    )


def invert(a_from_b: Transform) -> Transform:
    """`b_from_a` from `a_from_b`."""
    back = quaternions.conjugate(quaternions.unit(a_from_b.rotation))
    x, y, z = quaternions.rotate(back, a_from_b.translation)
    return transform((-x, -y, -z), back)


def apply(a_from_b: Transform, point: Iterable[float]) -> Vector3:
    """Move a point: given in b, it comes out in a."""
    x, y, z = point
    x, y, z = quaternions.rotate(quaternions.unit(a_from_b.rotation), (x, y, z))
    tx, ty, tz = a_from_b.translation
    return Vector3(x + tx, y + ty, z + tz)


def canonical(pose: Transform) -> Transform:
    """The same pose with a unit quaternion of the sign tf2 gives (NaN for a zero one)."""
    return transform(pose.translation, quaternions.canonical(quaternions.unit(pose.rotation)))


def slerp(start: Iterable[float], end: Iterable[float], fraction: float) -> Quaternion:
    """Turn from `start` to `end` along the shorter arc, at constant speed.

    Raises:
        ValueError: If the fraction is outside [0, 1] or NaN: like tf2, we interpolate
            and never extrapolate.
    """
    _check_fraction(fraction)
    ax, ay, az, aw = start
    bx, by, bz, bw = end
    turned = quaternions.slerp(
        quaternions.unit((ax, ay, az, aw)), quaternions.unit((bx, by, bz, bw)), fraction
    )
    return Quaternion(*turned)


def interpolate(start: Transform, end: Transform, fraction: float) -> Transform:
    """The pose on the way: straight line for the translation, shorter arc for the rotation.

    Raises:
        ValueError: If the fraction is outside [0, 1] or NaN.
    """
    _check_fraction(fraction)
    ax, ay, az = start.translation
    bx, by, bz = end.translation
    return transform(
        (
            ax + fraction * (bx - ax),
            ay + fraction * (by - ay),
            az + fraction * (bz - az),
        ),
        slerp(start.rotation, end.rotation, fraction),
    )


def distance(pose: Transform) -> float:
    """How far apart the two origins are, in metres."""
    return math.hypot(*pose.translation)


def _check_fraction(fraction: float) -> None:
    # Asked this way round, NaN is refused as well.
    if not 0.0 <= fraction <= 1.0:
        raise ValueError(f"the fraction must lie in [0, 1], not {fraction!r}")
