"""Conversions between quaternions and roll pitch yaw, matrices, axis and angle, Euler angles.

Roll, pitch, yaw are rotations about fixed axes: x, then y, then z. Conversions of roll, pitch, yaw,
and of axis and angle, use plain floats, because commands need these conversions and importing
transforms3d takes 120 ms. transforms3d computes all other Euler angles, and quaternions from
matrices. The library is imported at the first call. Only this module uses the quaternion order of
transforms3d, w first.
"""

import math
from collections.abc import Iterable, Sequence

from tftool.geometry import quaternions
from tftool.geometry.quaternions import Matrix3, Quad
from tftool.geometry.rigid import Quaternion, Vector3

AXES = tuple(
    f"{frame}{first}{second}{third}"
    for frame in "sr"
    for first in "xyz"
    for second in "xyz"
    for third in "xyz"
    if first != second != third
)
"""All orders of Euler angles: "s" for static (fixed) or "r" for rotating axes, then three axes."""

# A sum of components of a unit quaternion below this is rounding; as in `rigid_arrays`.
NOISE = 1e-13


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Return the quaternion of turns in radians about the fixed axes x, then y, then z."""
    return Quaternion(*quaternions.from_rpy(roll, pitch, yaw))


def rpy_from_quaternion(quaternion: Iterable[float]) -> tuple[float, float, float]:
    """Return roll, pitch, yaw of a rotation in radians, pitch within a quarter turn.

    At the poles (pitch of ±π/2) yaw is 0 and roll contains the whole turn. The angles then still
    mean the same rotation as the quaternion. All three angles of a zero quaternion are NaN.
    """
    return quaternions.rpy(_quad(quaternion))


def precise_rpy_from_quaternion(quaternion: Iterable[float]) -> tuple[float, float, float]:
    """Return roll, pitch, yaw that reproduce a rotation to 1e-12, also at the poles.

    `rpy_from_quaternion` uses tf2's formulas, which lose half of the digits at the poles.
    Files for other programs are written with this function.

    Source:
        Bernardes and Viollet, "Quaternion to Euler angles conversion: a direct, general and
        computationally efficient method", PLoS ONE 2022.
    """
    x, y, z, w = quaternions.unit(_quad(quaternion))
    a, b, c, d = w - y, x + z, y + w, z - x
    near, far = math.hypot(a, b), math.hypot(c, d)
    pitch = 2.0 * math.atan2(far, near) - 0.5 * math.pi
    # At a pole one of the two is pure rounding, and is ignored.
    half_sum = math.atan2(b, a) if near > NOISE else math.nan
    half_difference = math.atan2(d, c) if far > NOISE else math.nan
    if math.isnan(half_sum):
        return _wrapped(-2.0 * half_difference), pitch, 0.0
    if math.isnan(half_difference):
        return _wrapped(2.0 * half_sum), pitch, 0.0
    return _wrapped(half_sum - half_difference), pitch, _wrapped(half_sum + half_difference)


def _wrapped(angle: float) -> float:
    """Wrap an angle to the range from −π to π."""
    return math.remainder(angle, 2.0 * math.pi) if abs(angle) > math.pi else angle + 0.0


def second_rpy_from_quaternion(quaternion: Iterable[float]) -> tuple[float, float, float]:
    """Return the second solution of roll, pitch, yaw for a rotation, with |pitch| above π/2."""
    m = matrix_from_quaternion(quaternion)
    if not abs(m[2][0]) < quaternions.POLE:
        return rpy_from_quaternion(quaternion)
    return (
        math.atan2(-m[2][1], -m[2][2]),
        math.pi + math.asin(m[2][0]),
        math.atan2(-m[1][0], -m[0][0]),
    )


def matrix_from_quaternion(quaternion: Iterable[float]) -> Matrix3:
    """Return the 3×3 rotation matrix of a quaternion, row by row.

    Any finite quaternion except zero gives a proper rotation; zero gives NaN.
    """
    return quaternions.matrix(_quad(quaternion))


def quaternion_from_matrix(matrix: Sequence[Sequence[float]]) -> Quaternion:
    """Return the quaternion of a 3×3 matrix, or of the upper left of a 4×4 matrix.

    The quaternion has the sign that tf2 computes; see `quaternions.canonical`.

    Raises:
        ValueError: If the matrix is not a proper rotation (within 1e-6).
    """
    try:
        (a, b, c), (d, e, f), (g, h, i) = (
            tuple(float(number) for number in row[:3]) for row in matrix[:3]
        )
    except (TypeError, ValueError) as error:
        raise ValueError(
            f"a rotation matrix must be three rows of three numbers, not {matrix!r}"
        ) from error
    rows: Matrix3 = ((a, b, c), (d, e, f), (g, h, i))
    for j, row in enumerate(rows):
        for k, other in enumerate(rows):
            dot = sum(x * y for x, y in zip(row, other, strict=True))
            # Written with `not`, so that NaN is refused too.
            if not abs(dot - (j == k)) < 1e-6:
                raise ValueError(
                    "the matrix is not a rotation: its rows are not perpendicular unit vectors"
                )
    if a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0:
        raise ValueError(
            "the matrix is not a rotation: its determinant is negative, so the matrix mirrors"
        )
    import numpy as np
    from transforms3d.quaternions import mat2quat

    turn = tuple(float(number) for number in xyzw_from_wxyz(mat2quat(np.array(rows))))
    return Quaternion(*quaternions.canonical(quaternions.unit(_quad(turn))))


def nearest_rotation(matrix: Sequence[Sequence[float]]) -> tuple[Matrix3, float]:
    """Return the proper rotation nearest to a 3×3 matrix, and its difference from the matrix.

    Returns:
        The rotation, and the largest difference between an entry of the rotation and the same entry
        of the matrix. The difference is infinite if the matrix is singular or a reflection.

    Source:
        Higham, "Computing the polar decomposition", SIAM J. Sci. Stat. Comput. 1986; computed here
        by a singular value decomposition.
    """
    import numpy as np

    given = np.asarray(matrix, dtype=np.float64)
    identity = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    if given.shape != (3, 3) or not np.isfinite(given).all():
        return identity, math.inf
    left, values, right = np.linalg.svd(given)
    found = left @ right
    if values[2] < 1e-9 or np.linalg.det(found) < 0.0:
        return identity, math.inf
    (a, b, c), (d, e, f), (g, h, i) = found.tolist()
    return ((a, b, c), (d, e, f), (g, h, i)), float(np.abs(found - given).max())


def axis_angle_from_quaternion(quaternion: Iterable[float]) -> tuple[Vector3, float]:
    """Return a rotation's unit axis and angle, radians from 0 to π; the x axis for angle 0."""
    x, y, z, w = quaternions.unit(_quad(quaternion))
    if w < 0.0:
        x, y, z, w = -x, -y, -z, -w
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0.0:
        return Vector3(1.0, 0.0, 0.0), 0.0
    # Divided first: the squares of a tiny turn would vanish or lose most of their digits.
    x, y, z = x / largest, y / largest, z / largest
    length = math.hypot(x, y, z)
    angle = 2.0 * math.atan2(length * largest, w)
    return Vector3(x / length, y / length, z / length), angle


def quaternion_from_axis_angle(axis: Iterable[float], angle: float) -> Quaternion:
    """Return the quaternion of a rotation by `angle` radians about an axis of any length.

    Raises:
        ValueError: If the axis is zero or not finite.
    """
    x, y, z = axis
    length = math.hypot(x, y, z)
    if not 0.0 < length < math.inf:
        raise ValueError(
            f"({x}, {y}, {z}) is not an axis: the numbers must be finite and not all zero"
        )
    sine = math.sin(angle / 2.0)
    return Quaternion(
        x / length * sine, y / length * sine, z / length * sine, math.cos(angle / 2.0)
    )


def wxyz_from_xyzw(quaternion: Iterable[float]) -> tuple[float, float, float, float]:
    """Reorder a quaternion from xyzw to wxyz, the order of transforms3d and other libraries."""
    x, y, z, w = quaternion
    return w, x, y, z


def xyzw_from_wxyz(quaternion: Iterable[float]) -> Quaternion:
    """Reorder a quaternion from wxyz to xyzw, as in ROS and tftool."""
    w, x, y, z = quaternion
    return Quaternion(x, y, z, w)


def quaternion_from_euler(angles: Sequence[float], axes: str = "sxyz") -> Quaternion:
    """Return the quaternion of Euler angles in any order of axes.

    Args:
        angles: Three angles in radians.
        axes: One of `AXES`; "sxyz" is roll, pitch, yaw.

    Raises:
        ValueError: If `axes` is not one of `AXES`.
    """
    from transforms3d.euler import euler2quat

    first, second, third = angles
    turned = euler2quat(first, second, third, _checked(axes))
    return xyzw_from_wxyz(float(number) for number in turned)


def euler_from_quaternion(
    quaternion: Iterable[float], axes: str = "sxyz"
) -> tuple[float, float, float]:
    """Return Euler angles of a rotation, radians, in any order of axes.

    Raises:
        ValueError: If `axes` is not one of `AXES`.
    """
    from transforms3d.euler import quat2euler

    first, second, third = quat2euler(wxyz_from_xyzw(quaternion), _checked(axes))
    return float(first), float(second), float(third)


def euler_from_matrix(
    matrix: Sequence[Sequence[float]], axes: str = "sxyz"
) -> tuple[float, float, float]:
    """Return Euler angles, radians, of a 3×3 matrix or of the upper left of a 4×4 matrix.

    At gimbal lock, where infinitely many sets of angles fit, the last angle is 0.

    Raises:
        ValueError: If `axes` is not one of `AXES`.
    """
    # Convert here: transforms3d would call numpy with copy=False, which numpy 2 often refuses.
    import numpy as np
    from transforms3d.euler import mat2euler

    first, second, third = mat2euler(np.asarray(matrix, dtype=np.float64), _checked(axes))
    return float(first), float(second), float(third)


def _checked(axes: str) -> str:
    if axes not in AXES:
        raise ValueError(
            f"{axes!r} is not an order of axes: write 's' (fixed axes) or 'r' (rotating axes) "
            "and three of x, y, z, such as 'sxyz'"
        )
    return axes


def _quad(quaternion: Iterable[float]) -> Quad:
    x, y, z, w = quaternion
    return x, y, z, w
