"""Arithmetic of quaternions as tuples of plain floats, in xyzw order.

Single lookups are faster with tuples than with objects. A product of rotations applies the second
factor first.
"""

import math
from typing import TypeAlias

from tftool.geometry import poses

Triple: TypeAlias = tuple[float, float, float]
"""Three numbers: x, y, z."""

Quad: TypeAlias = tuple[float, float, float, float]
"""A quaternion: x, y, z, w."""

Matrix3: TypeAlias = tuple[Triple, Triple, Triple]
"""A 3×3 matrix, row by row."""

POLE = 1.0 - 1e-12
"""Sine of the pitch from which roll and yaw have the same axis, so that only their sum is known."""

IDENTITY: Quad = (0.0, 0.0, 0.0, 1.0)

NAN_QUAD: Quad = (math.nan, math.nan, math.nan, math.nan)

ROUNDING = 8e-16
"""Difference of a quaternion's squared length from 1 up to which `unit` returns it unchanged."""


def multiply(first: Quad, second: Quad) -> Quad:
    """Compose two rotations: `second` is applied first, then `first`."""
    ax, ay, az, aw = first
    bx, by, bz, bw = second
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by + ay * bw + az * bx - ax * bz,
        aw * bz + az * bw + ax * by - ay * bx,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(quaternion: Quad) -> Quad:
    """Return the inverse of a unit quaternion."""
    x, y, z, w = quaternion
    return (-x, -y, -z, w)


def rotate(quaternion: Quad, vector: Triple) -> Triple:
    """Rotate a vector by a unit quaternion."""
    qx, qy, qz, qw = quaternion
    x, y, z = vector
    cx = 2.0 * (qy * z - qz * y)
    cy = 2.0 * (qz * x - qx * z)
    cz = 2.0 * (qx * y - qy * x)
    return (
        x + qw * cx + qy * cz - qz * cy,
        y + qw * cy + qz * cx - qx * cz,
        z + qw * cz + qx * cy - qy * cx,
    )


def unit(quaternion: Quad) -> Quad:
    """Scale a quaternion to unit length; return four NaN if no scaling is possible.

    Scaling is impossible if the quaternion is zero, not finite, or so small that its square
    underflows.
    """
    x, y, z, w = quaternion
    square = x * x + y * y + z * z + w * w
    if -ROUNDING < square - 1.0 < ROUNDING:
        return quaternion
    if square == math.inf:
        # The squares of huge numbers overflow, although the direction is defined: scale first.
        largest = max(abs(x), abs(y), abs(z), abs(w))
        if largest == math.inf:
            return NAN_QUAD
        return unit((x / largest, y / largest, z / largest, w / largest))
    # As in tf2: below this, 2 / square is infinite. Written with `not`, so that NaN fails too.
    if not square > 2.0 / 1.7976931348623157e308:
        return NAN_QUAD
    scale = 1.0 / math.sqrt(square)
    return (x * scale, y * scale, z * scale, w * scale)


def canonical(quaternion: Quad) -> Quad:
    """Return a unit quaternion with the sign that tf2 would compute.

    tf2 computes quaternions from rotation matrices. So w is positive for turns below 120°. For
    larger turns the largest imaginary part is positive, and w can be negative.
    """
    x, y, z, w = quaternion
    return (-x, -y, -z, -w) if leading(x, y, z, w) < 0.0 else quaternion


def leading(x: float, y: float, z: float, w: float) -> float:
    """Return the component of a unit quaternion that tf2 makes positive; see `canonical`."""
    if w * w > 0.25:
        return w
    xx, yy, zz = x * x, y * y, z * z
    if xx < yy:
        return z if yy < zz else y
    return z if xx < zz else x


def slerp(start: Quad, end: Quad, fraction: float) -> Quad:
    """Interpolate between two rotations along the shorter arc, at constant angular speed.

    Args:
        start: Unit quaternion.
        end: Unit quaternion. Its negative, which is the same rotation, is used if the arc is then
            shorter.
        fraction: Position on the arc, from 0 (`start`) to 1 (`end`).

    Returns:
        A unit quaternion, `start` itself at fraction 0.
    """
    here = (0.0, 0.0, 0.0)
    return poses.interpolate((0, *here, *start, 1, *here, *end), fraction)[3:]


def angle_between(first: Quad, second: Quad) -> float:
    """Return the angle between two rotations, radians from 0 to π."""
    near = math.dist(first, second)
    x, y, z, w = second
    far = math.dist(first, (-x, -y, -z, -w))
    # acos of the dot product would lose half the digits of a small angle.
    return 4.0 * math.atan2(min(near, far), max(near, far))


def matrix(quaternion: Quad) -> Matrix3:
    """Return the 3×3 rotation matrix of a quaternion, row by row.

    Any finite quaternion except zero gives a proper rotation; zero gives NaN.
    """
    x, y, z, w = unit(quaternion)
    xx, yy, zz = x * x, y * y, z * z
    xy, xz, yz = x * y, x * z, y * z
    wx, wy, wz = w * x, w * y, w * z
    return (
        (1.0 - 2.0 * (yy + zz), 2.0 * (xy - wz), 2.0 * (xz + wy)),
        (2.0 * (xy + wz), 1.0 - 2.0 * (xx + zz), 2.0 * (yz - wx)),
        (2.0 * (xz - wy), 2.0 * (yz + wx), 1.0 - 2.0 * (xx + yy)),
    )


def from_rpy(roll: float, pitch: float, yaw: float) -> Quad:
    """Return the quaternion of turns in radians about the fixed axes x, then y, then z."""
    sr, cr = math.sin(0.5 * roll), math.cos(0.5 * roll)
    sp, cp = math.sin(0.5 * pitch), math.cos(0.5 * pitch)
    sy, cy = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def rpy(quaternion: Quad) -> Triple:
    """Return roll, pitch and yaw of a rotation, radians; see `conversions.rpy_from_quaternion`."""
    m = matrix(quaternion)
    m20 = m[2][0]
    if m20 <= -POLE:
        return math.atan2(m[0][1], m[0][2]), 0.5 * math.pi, 0.0
    if m20 >= POLE:
        return math.atan2(-m[0][1], -m[0][2]), -0.5 * math.pi, 0.0
    # For pitch 0 this gives -0, as tf2 does.
    return math.atan2(m[2][1], m[2][2]), -math.asin(m20), math.atan2(m[1][0], m[0][0])
