"""Rigid transforms in plain floats: composition, inverse, application to points.

A transform `a_from_b` is the pose of b in a, and maps points from b to a: `a_from_c == a_from_b @
b_from_c`, `point_in_a == a_from_b.apply(point_in_b)`.
"""

import math
import operator
from collections.abc import Iterable
from typing import NamedTuple, NoReturn, TypeAlias, TypeVar

from tftool.geometry import quaternions

Matrix: TypeAlias = tuple[tuple[float, float, float, float], ...]
"""A 4×4 matrix, row by row."""


T = TypeVar("T")


def refuses_arithmetic(kind: type[T]) -> type[T]:
    """Decorate a tuple class so that + and * raise an error instead of working as for lists."""

    def refuse(self: object, other: object) -> NoReturn:
        raise TypeError(
            f"a {kind.__name__} does not support + and *: use its fields, "
            f"chain transforms with @, or convert the {kind.__name__} with list(…)"
        )

    for name in ("__add__", "__radd__", "__mul__", "__rmul__"):
        setattr(kind, name, refuse)
    return kind


class Vector3(NamedTuple):
    """A point or vector, in metres unless stated otherwise.

    The operators +, -, * and / work as for vectors, not as for tuples.
    """

    x: float
    y: float
    z: float

    def __add__(self, other: object) -> "Vector3":
        if not isinstance(other, tuple):
            return NotImplemented
        x, y, z = _three(other)
        return Vector3(self.x + x, self.y + y, self.z + z)

    def __radd__(self, other: object) -> "Vector3":
        return self + other

    def __sub__(self, other: object) -> "Vector3":
        if not isinstance(other, tuple):
            return NotImplemented
        x, y, z = _three(other)
        return Vector3(self.x - x, self.y - y, self.z - z)

    def __rsub__(self, other: object) -> "Vector3":
        return -self + other

    def __neg__(self) -> "Vector3":
        return Vector3(-self.x, -self.y, -self.z)

    def __mul__(self, factor: object) -> "Vector3":
        if not isinstance(factor, int | float):
            return NotImplemented
        return Vector3(self.x * factor, self.y * factor, self.z * factor)

    def __rmul__(self, factor: object) -> "Vector3":
        return self * factor

    def __truediv__(self, divisor: float) -> "Vector3":
        return Vector3(self.x / divisor, self.y / divisor, self.z / divisor)

    def cross(self, other: "Vector3") -> "Vector3":
        """Return the cross product with another vector."""
        ax, ay, az = self
        bx, by, bz = other
        return Vector3(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)

    def norm(self) -> float:
        """Return the length of the vector."""
        return math.hypot(*self)


def _three(numbers: tuple[object, ...]) -> tuple[float, float, float]:
    if len(numbers) != 3:
        raise TypeError(f"a vector can be added to three numbers, not to {numbers!r}")
    x, y, z = numbers
    return x, y, z  # type: ignore[return-value]


@refuses_arithmetic
class Quaternion(NamedTuple):
    """Rotation as a quaternion in xyzw order; of unit length, except if taken from a message."""

    x: float
    y: float
    z: float
    w: float

    @classmethod
    def from_rpy(cls, roll: float, pitch: float, yaw: float) -> "Quaternion":
        """Return the quaternion of turns in radians about the fixed axes x, then y, then z."""
        return cls(*quaternions.from_rpy(roll, pitch, yaw))

    def rpy(self) -> quaternions.Triple:
        """Return roll, pitch and yaw in radians; see `conversions.rpy_from_quaternion`."""
        return quaternions.rpy(self)

    def __matmul__(self, other: "Quaternion") -> "Quaternion":
        """Return the product of two rotations: `a_from_b @ b_from_c` is `a_from_c`."""
        if not isinstance(other, Quaternion):
            return NotImplemented
        return Quaternion(*quaternions.multiply(quaternions.unit(self), quaternions.unit(other)))

    def inverse(self) -> "Quaternion":
        """Return the inverse of the rotation, of unit length."""
        return Quaternion(*quaternions.conjugate(quaternions.unit(self)))


# Named tuples are created in half the time of frozen dataclasses; a lookup creates four.
class _Parts(NamedTuple):
    translation: Vector3
    rotation: Quaternion


@refuses_arithmetic
class Transform(_Parts):
    """A rotation followed by a translation, as an immutable, hashable value.

    The quaternion is stored unchanged. Calculations use the normalised quaternion, if the
    quaternion is finite and not zero. A zero quaternion, which a message can have, makes results
    NaN.

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
        """Create a transform from a translation (three numbers) and a quaternion (four numbers).

        Raises:
            ValueError: If the numbers are not three and four, or the quaternion is zero.
        """
        turn = _floats(rotation, 4, "rotation")
        if not any(turn):
            raise ValueError("a zero quaternion is not a rotation: the identity is (0, 0, 0, 1)")
        return tuple.__new__(
            cls, (Vector3(*_floats(translation, 3, "translation")), Quaternion(*turn))
        )

    @classmethod
    def from_matrix(cls, matrix: Iterable[Iterable[float]]) -> "Transform":
        """Create a transform from a homogeneous 4×4 matrix, the inverse of the method `matrix`.

        Args:
            matrix: Row by row, a numpy array or lists: the rotation at the upper left, the
                translation in the last column.

        Raises:
            ValueError: If the matrix is not 4×4, its last row is not 0 0 0 1, or its upper left is
                not a proper rotation (within 1e-6).
        """
        # Imported here because `conversions` imports this module.
        from tftool.geometry.conversions import quaternion_from_matrix

        try:
            rows = [_floats(row, 4, "row of a 4×4 matrix") for row in matrix]
        except TypeError as error:
            raise ValueError(f"a transform's matrix must be 4×4 numbers, not {matrix!r}") from error
        if len(rows) != 4:
            raise ValueError(f"a transform's matrix must be 4×4, not of {len(rows)} rows")
        if max(map(abs, map(operator.sub, rows[3], (0.0, 0.0, 0.0, 1.0)))) > 1e-6:
            raise ValueError(
                f"the last row of a transform's matrix must be (0, 0, 0, 1), not {rows[3]}: "
                "transpose the matrix if its last row has the translation"
            )
        return cls([row[3] for row in rows[:3]], quaternion_from_matrix(rows))

    @classmethod
    def identity(cls) -> "Transform":
        """Return the identity transform."""
        return IDENTITY

    def __matmul__(self, other: "Transform") -> "Transform":
        """Return the product of two transforms: `a_from_b @ b_from_c` is `a_from_c`."""
        return compose(self, other)

    def inverse(self) -> "Transform":
        """Return the inverse transform: `b_from_a` of `a_from_b`."""
        return invert(self)

    def apply(self, point: Iterable[float]) -> Vector3:
        """Transform a point from the child frame b to the parent frame a."""
        return apply(self, point)

    def rotate(self, vector: Iterable[float]) -> Vector3:
        """Rotate a direction, velocity or axis from the child frame b to the parent frame a.

        The translation is not added.
        """
        x, y, z = vector
        return Vector3(*quaternions.rotate(quaternions.unit(self.rotation), (x, y, z)))

    def matrix(self) -> Matrix:
        """Return the transform as a homogeneous 4×4 matrix, row by row."""
        first, second, third = quaternions.matrix(self.rotation)
        x, y, z = self.translation
        return ((*first, x), (*second, y), (*third, z), (0.0, 0.0, 0.0, 1.0))


def _floats(numbers: Iterable[float], count: int, what: str) -> tuple[float, ...]:
    try:
        floats = tuple(float(number) for number in numbers)
    except OverflowError as error:
        # The message leaves out the numbers: a large int may have thousands of digits.
        raise ValueError(f"a {what} has a number that is too large for a float") from error
    except (TypeError, ValueError) as error:
        raise ValueError(f"a {what} is {count} numbers, not {numbers!r}") from error
    if len(floats) != count:
        raise ValueError(f"a {what} is {count} numbers, not {len(floats)}: {numbers!r}")
    return floats


def transform(translation: quaternions.Triple, rotation: quaternions.Quad) -> Transform:
    """Create a transform from computed floats, without the checks of the class."""
    new = tuple.__new__
    return new(Transform, (new(Vector3, translation), new(Quaternion, rotation)))


IDENTITY = Transform()


def compose(first: Transform, second: Transform) -> Transform:
    """Return `a_from_c` for `a_from_b` and `b_from_c`; use `canonical` to get tf2's sign."""
    turn = quaternions.unit(first.rotation)
    x, y, z = quaternions.rotate(turn, second.translation)
    tx, ty, tz = first.translation
    return transform(
        (x + tx, y + ty, z + tz),
        quaternions.multiply(turn, quaternions.unit(second.rotation)),
    )


def invert(a_from_b: Transform) -> Transform:
    """Return the inverse transform: `b_from_a` of `a_from_b`."""
    back = quaternions.conjugate(quaternions.unit(a_from_b.rotation))
    x, y, z = quaternions.rotate(back, a_from_b.translation)
    return transform((-x, -y, -z), back)


def apply(a_from_b: Transform, point: Iterable[float]) -> Vector3:
    """Transform a point from the child frame b to the parent frame a."""
    x, y, z = point
    x, y, z = quaternions.rotate(quaternions.unit(a_from_b.rotation), (x, y, z))
    tx, ty, tz = a_from_b.translation
    return Vector3(x + tx, y + ty, z + tz)


def canonical(pose: Transform) -> Transform:
    """Return the pose with the unit quaternion that tf2 would return; NaN for a zero quaternion."""
    return transform(pose.translation, quaternions.canonical(quaternions.unit(pose.rotation)))


def distance(pose: Transform) -> float:
    """Return the distance between the origins of parent and child frame, metres."""
    return math.hypot(*pose.translation)


def transform_from_pose(x: float, y: float, heading: float) -> Transform:
    """Return `parent_from_child` for a pose in the plane; `heading` is in radians about z."""
    half = 0.5 * heading
    return transform((float(x), float(y), 0.0), (0.0, 0.0, math.sin(half), math.cos(half)))


def heading(transform: Transform) -> float:
    """Return the yaw of a transform's rotation, radians from −π to π.

    For a pose in the plane, the yaw is the direction of the child's x axis.
    """
    x, y, z, w = transform.rotation
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


def bearing(transform: Transform) -> float:
    """Return the yaw from the parent's x axis to the child's origin, radians; 0 at distance 0."""
    return math.atan2(transform.translation.y, transform.translation.x)


def wrap(angle: float) -> float:
    """Wrap an angle to the range [−π, π)."""
    # Adding 2π would round, so angles within the range are returned unchanged.
    if -math.pi <= angle < math.pi:
        return angle
    return (angle + math.pi) % math.tau - math.pi
