"""Functions that transform points, vectors, poses, covariances and wrenches.

Arguments are plain numbers in frame b of the transform `a_from_b`; results are in frame a. No
argument is changed. A quaternion of zeros means the identity, as in tf2's own conversions.
"""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, TypeAlias

from tftool.geometry import quaternions
from tftool.geometry.rigid import Transform, Vector3, transform

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

Covariance: TypeAlias = tuple[float, ...]
"""36 numbers, 6×6 row by row, in the order x, y, z, rotation about x, about y, about z."""

# A quaternion whose squared length is below this counts as zero.
_NO_ROTATION = 2.2e-16


def point(a_from_b: Transform, xyz: Iterable[float]) -> Vector3:
    """Transform a point from frame b to frame a: rotate the point, then add the translation."""
    return _usable(a_from_b).apply(xyz)


def vector(a_from_b: Transform, xyz: Iterable[float]) -> Vector3:
    """Rotate a vector from frame b to frame a; the translation has no effect on vectors."""
    return _usable(a_from_b).rotate(xyz)


def pose(a_from_b: Transform, pose: Transform) -> Transform:
    """Transform a pose from frame b to frame a; the resulting quaternion has w ≥ 0."""
    moved = _usable(a_from_b) @ _usable(pose)
    x, y, z, w = moved.rotation
    return transform(moved.translation, (-x, -y, -z, -w)) if w < 0.0 else moved


def covariance(a_from_b: Transform, covariance: Sequence[float]) -> Covariance:
    """Rotate a 6×6 covariance from frame b to frame a.

    Each of its 3×3 blocks B becomes R·B·Rᵀ for the rotation R of `a_from_b`.

    Raises:
        ValueError: If `covariance` does not have 36 numbers.
    """
    if len(covariance) != 36:
        raise ValueError(f"a covariance must be 36 numbers, not {len(covariance)}")
    turn = quaternions.matrix(_usable(a_from_b).rotation)
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


def wrench(a_from_b: Transform, force: Vector3, torque: Vector3) -> tuple[Vector3, Vector3]:
    """Transform (force, torque) to frame a; the torque includes the moment of the moved force."""
    force, torque = vector(a_from_b, force), vector(a_from_b, torque)
    return force, torque + a_from_b.translation.cross(force)


def points(a_from_b: Transform, xyz: "npt.ArrayLike") -> "npt.NDArray[np.float64]":
    """Transform many points, as a numpy array.

    Args:
        a_from_b: The transform to apply.
        xyz: Points in b, metres, shape (n, 3).

    Returns:
        A new array of points in a, shape (n, 3).

    Raises:
        ValueError: If `xyz` has another shape.
    """
    import numpy as np

    given = np.asarray(xyz, dtype=np.float64)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"points must have the shape (n, 3), not {given.shape}")
    usable = _usable(a_from_b)
    turn = np.array(quaternions.matrix(usable.rotation))
    moved: npt.NDArray[np.float64] = given @ turn.T + np.array(usable.translation)
    return moved


def _usable(given: Transform) -> Transform:
    if sum(number * number for number in given.rotation) < _NO_ROTATION:
        return Transform(given.translation)
    return given
