"""Other ways to write a rotation: roll pitch yaw, matrix, axis and angle, w first.

Euler angles are turns about fixed axes: x by roll, then y by pitch, then z by yaw. The
few that transforms3d has better go through here and nowhere else; it brings numpy, so it
is loaded when one of them is called.
"""

import math
from collections.abc import Iterable, Sequence

from tftool.geometry import quaternions
from tftool.geometry.quaternions import Quad, Rows
from tftool.geometry.rigid import Quaternion, Vector3

# Nearer than this to the pole, roll and yaw turn about one axis and only their sum is told.
_POLE = 1.0 - 1e-12


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """The rotation that turns about fixed x, then y, then z; radians, sign as computed."""
    sr, cr = math.sin(0.5 * roll), math.cos(0.5 * roll)
    sp, cp = math.sin(0.5 * pitch), math.cos(0.5 * pitch)
    sy, cy = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
    return Quaternion(
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def rpy_from_quaternion(quaternion: Iterable[float]) -> tuple[float, float, float]:
    """Roll, pitch, yaw in radians, pitch within a quarter turn.

    At the poles (pitch of a quarter turn) yaw is 0 and roll holds the whole of what the
    two share, so that the angles always mean the same rotation as the quaternion. NaN
    for a zero quaternion.
    """
    m = matrix_from_quaternion(quaternion)
    m20 = m[2][0]
    if m20 <= -_POLE:
        return math.atan2(m[0][1], m[0][2]), 0.5 * math.pi, 0.0
    if m20 >= _POLE:
        return math.atan2(-m[0][1], -m[0][2]), -0.5 * math.pi, 0.0
    # asin of +0 is negated to -0, as tf2 prints it.
    return math.atan2(m[2][1], m[2][2]), -math.asin(m20), math.atan2(m[1][0], m[0][0])


def second_rpy_from_quaternion(quaternion: Iterable[float]) -> tuple[float, float, float]:
    """The other roll, pitch, yaw of the same rotation: pitch beyond a quarter turn."""
    m = matrix_from_quaternion(quaternion)
    if not abs(m[2][0]) < _POLE:
        return rpy_from_quaternion(quaternion)
    return (
        math.atan2(-m[2][1], -m[2][2]),
        math.pi + math.asin(m[2][0]),
        math.atan2(-m[1][0], -m[0][0]),
    )


def matrix_from_quaternion(quaternion: Iterable[float]) -> Rows:
    """The 3×3 rotation matrix, row by row.

    Any finite quaternion but zero gives a proper rotation; zero gives NaN.
    """
    return quaternions.matrix(_quad(quaternion))


def quaternion_from_matrix(matrix: Sequence[Sequence[float]]) -> Quaternion:
    """The rotation of a 3×3 matrix (of a 4×4 one, its upper left), with tf2's sign.

    Raises:
        ValueError: If it is no proper rotation (within 1e-6).
    """
    try:
        (a, b, c), (d, e, f), (g, h, i) = (
            tuple(float(number) for number in row[:3]) for row in matrix[:3]
        )
    except (TypeError, ValueError) as error:
        raise ValueError(
            f"a rotation matrix is three rows of three numbers, not {matrix!r}"
        ) from error
    rows: Rows = ((a, b, c), (d, e, f), (g, h, i))
    for j, row in enumerate(rows):
        for k, other in enumerate(rows):
            dot = sum(x * y for x, y in zip(row, other, strict=True))
            # Asked this way round, NaN is refused as well.
            if not abs(dot - (j == k)) < 1e-6:
                raise ValueError(
                    "the matrix is no rotation: its rows are not of length 1 and square"
                )
    if a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0:
        raise ValueError("the matrix is no rotation: it mirrors")
    return Quaternion(*quaternions.unit(quaternions.from_matrix(rows)))


def axis_angle_from_quaternion(quaternion: Iterable[float]) -> tuple[Vector3, float]:
    """The axis of length 1 and the angle from 0 to π about it; x where nothing turns."""
    x, y, z, w = quaternions.unit(_quad(quaternion))
    if w < 0.0:
        x, y, z, w = -x, -y, -z, -w
    sine = math.sqrt(x * x + y * y + z * z)
    if sine == 0.0:
        return Vector3(1.0, 0.0, 0.0), 0.0
    return Vector3(x / sine, y / sine, z / sine), 2.0 * math.atan2(sine, w)


def quaternion_from_axis_angle(axis: Iterable[float], angle: float) -> Quaternion:
    """The turn by `angle` radians about an axis of any length.

    Raises:
        ValueError: If the axis is zero or not finite.
    """
    x, y, z = axis
    length = math.hypot(x, y, z)
    if not 0.0 < length < math.inf:
        raise ValueError(f"({x}, {y}, {z}) is no axis")
    part = math.sin(0.5 * angle) / length
    return Quaternion(x * part, y * part, z * part, math.cos(0.5 * angle))


def wxyz_from_xyzw(quaternion: Iterable[float]) -> tuple[float, float, float, float]:
    """The same numbers, w first, as transforms3d and others have them."""
    x, y, z, w = quaternion
    return w, x, y, z


def xyzw_from_wxyz(quaternion: Iterable[float]) -> Quaternion:
    """The same numbers, w last, as ROS and we have them."""
    w, x, y, z = quaternion
    return Quaternion(x, y, z, w)


def quaternion_from_euler(angles: Sequence[float], axes: str) -> Quaternion:
    """A rotation from Euler angles of any convention.

    Args:
        angles: Three angles in radians.
        axes: Four letters as transforms3d has them: "s" for static (fixed) or "r" for
            rotating axes, then the three axes in order: "sxyz" is roll, pitch, yaw.

    Raises:
        ValueError: If `axes` is no such convention.
    """
    from transforms3d.euler import euler2quat

    first, second, third = angles
    try:
        turned = euler2quat(first, second, third, axes)
    except (KeyError, AttributeError) as error:
        raise ValueError(f"{axes!r} names no order of axes; one is 'sxyz'") from error
    return xyzw_from_wxyz(float(number) for number in turned)


def euler_from_quaternion(quaternion: Iterable[float], axes: str) -> tuple[float, float, float]:
    """Euler angles, in radians, of any convention; see `quaternion_from_euler`.

    Raises:
        ValueError: If `axes` is no such convention.
    """
    from transforms3d.euler import quat2euler

    try:
        first, second, third = quat2euler(wxyz_from_xyzw(quaternion), axes)
    except (KeyError, AttributeError) as error:
        raise ValueError(f"{axes!r} names no order of axes; one is 'sxyz'") from error
    return float(first), float(second), float(third)


def _quad(quaternion: Iterable[float]) -> Quad:
    x, y, z, w = quaternion
    return x, y, z, w
