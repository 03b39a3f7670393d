"""What a transform does to each kind of thing: points, directions, poses, covariances, forces.

Everything goes in as plain numbers given in the transform's child and comes out given in
its parent; nothing that goes in is changed. A rotation of all zeros stands for none, as it
does in tf2's own conversions.
"""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from tftool.geometry import quaternions
from tftool.geometry.rigid import Quaternion, Transform, Vector3

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

Covariance: TypeAlias = tuple[float, ...]
"""36 numbers, 6×6 row by row, in the order x, y, z, rotation about x, about y, about z."""

# Below this, the square of a quaternion's length is taken for no rotation at all.
_NOTHING = 2.2e-16


class PoseWithCovariance(NamedTuple):
    """A pose and how sure one is of it."""

    pose: Transform
    covariance: Covariance


class Wrench(NamedTuple):
    """A force and a torque, newtons and newton metres."""

    force: Vector3
    torque: Vector3


class Twist(NamedTuple):
    """A linear and an angular velocity, metres and radians per second."""

    linear: Vector3
    angular: Vector3


def point(transform: Transform, xyz: Iterable[float]) -> Vector3:
    """A place: turned and moved."""
    return _usable(transform).apply(xyz)


def vector(transform: Transform, xyz: Iterable[float]) -> Vector3:
    """A direction: turned, not moved."""
    return _usable(transform).rotate(xyz)


def quaternion(transform: Transform, xyzw: Iterable[float]) -> Quaternion:
    """An orientation: turned; the product as it comes, neither scaled nor of a chosen sign."""
    x, y, z, w = xyzw
    turn = quaternions.unit(_usable(transform).rotation)
    return Quaternion(*quaternions.multiply(turn, (x, y, z, w)))


def pose(transform: Transform, pose: Transform) -> Transform:
    """A pose: its place as a point, its orientation turned, with w not negative."""
    moved = _usable(transform) @ _usable(pose)
    x, y, z, w = moved.rotation
    return Transform(moved.translation, (-x, -y, -z, -w) if w < 0.0 else moved.rotation)


def covariance(transform: Transform, covariance: Sequence[float]) -> Covariance:
    """A 6×6 covariance: each of its four 3×3 blocks B becomes R·B·Rᵀ.

    Raises:
        ValueError: If there are not 36 numbers.
    """
    if len(covariance) != 36:
        raise ValueError(f"a covariance is 36 numbers, not {len(covariance)}")
    turn = quaternions.matrix(_usable(transform).rotation)
    result = [0.0] * 36
    for top in (0, 3):
        for left in (0, 3):
            block = [
                [float(covariance[6 * (top + i) + left + j]) for j in range(3)] for i in range(3)
            ]
            half = [
                [sum(turn[i][k] * block[k][j] for k in range(3)) for j in range(3)]
                for i in range(3)
            ]
            for i in range(3):
                for j in range(3):
                    value = sum(half[i][k] * turn[j][k] for k in range(3))
                    result[6 * (top + i) + left + j] = value
    return tuple(result)


def pose_with_covariance(transform: Transform, given: PoseWithCovariance) -> PoseWithCovariance:
    """A pose and its covariance."""
    return PoseWithCovariance(pose(transform, given.pose), covariance(transform, given.covariance))


def wrench(transform: Transform, given: Wrench) -> Wrench:
    """A force turned; a torque turned, and what the force makes of the distance on top."""
    force = vector(transform, given.force)
    torque = vector(transform, given.torque)
    return Wrench(force, _plus(torque, _cross(transform.translation, force)))


def twist(transform: Transform, given: Twist) -> Twist:
    """A velocity of a rigid body, told at the origin of either frame."""
    angular = vector(transform, given.angular)
    linear = vector(transform, given.linear)
    return Twist(_plus(linear, _cross(transform.translation, angular)), angular)


def polygon(transform: Transform, points: Iterable[Iterable[float]]) -> tuple[Vector3, ...]:
    """Corners, each as a point."""
    usable = _usable(transform)
    return tuple(usable.apply(corner) for corner in points)


def points(transform: Transform, xyz: "npt.ArrayLike") -> "npt.NDArray[np.float64]":
    """Many points at once, in numpy.

    Args:
        transform: Moves them.
        xyz: Shape (n, 3).

    Returns:
        Shape (n, 3), new.

    Raises:
        ValueError: If the shape is another.
    """
    import numpy as np

    given = np.asarray(xyz, dtype=np.float64)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"points have the shape (n, 3), not {given.shape}")
    usable = _usable(transform)
    turn = np.array(quaternions.matrix(usable.rotation))
    moved: npt.NDArray[np.float64] = given @ turn.T + np.array(usable.translation)
    return moved


def _usable(transform: Transform) -> Transform:
    if sum(number * number for number in transform.rotation) < _NOTHING:
        return Transform(transform.translation)
    return transform


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


def _plus(a: Vector3, b: Vector3) -> Vector3:
    return Vector3(a.x + b.x, a.y + b.y, a.z + b.z)
