"""Functions of tf_transformations for Euler angles, quaternions (x, y, z, w) and 4×4 matrices.

The argument `axes` is "s" (fixed axes) or "r" (rotating axes), followed by three axes: "sxyz" means
roll, pitch, yaw. `tftool.geometry` computes the results.
"""

import math
import sys
from collections.abc import Sequence
from types import FrameType
from typing import Any

import numpy as np

from tftool.geometry import conversions, quaternions
from tftool.geometry.quaternions import Quad
from tftool.ros.host.fibers import user_line
from tftool.ros.host.locks import running_program

TRANSLATION_IDENTITY = [0.0, 0.0, 0.0]
ROTATION_IDENTITY = [0.0, 0.0, 0.0, 1.0]

# A quaternion whose squared length is below this limit means no rotation.
_EPSILON = 4 * float(np.finfo(float).eps)


def _quad(quaternion: Sequence[float]) -> Quad:
    x, y, z, w = (float(part) for part in quaternion)
    return (x, y, z, w)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Quad:
    """Return the quaternion for three Euler angles in radians."""
    made = _quad(conversions.quaternion_from_euler((ai, aj, ak), axes))
    if (owner := running_program()) is not None:
        _look_for_degrees(owner, sys._getframe(1), (ai, aj, ak))
    return made


def _look_for_degrees(owner: Any, frame: FrameType, angles: tuple[float, float, float]) -> None:
    """Log a warning, once per line of a program, for Euler angles that are probably degrees.

    Only the first call of a line is checked, because an angle in radians may grow from call to
    call. Multiples of 0.5 up to 360 count as degrees, because 90.0 is an unlikely angle in radians.
    """
    line = (frame.f_code, frame.f_lineno)
    if line in owner.lines_with_angles:
        return
    owner.lines_with_angles.add(line)
    odd = next(
        (one for one in angles if 2 * math.pi < abs(one) <= 360.0 and 2 * one % 1 == 0), None
    )
    place = None if odd is None else user_line(frame)
    if odd is not None and place is not None:
        told = (
            f"{place.file}:{place.line}: quaternion_from_euler takes radians, and {odd:g} looks "
            f"like degrees: math.radians({odd:g})"
        )
        owner.ask(lambda: owner.say("WARN", owner.label, told))


def euler_from_quaternion(
    quaternion: Sequence[float], axes: str = "sxyz"
) -> tuple[float, float, float]:
    """Return the three Euler angles, in radians, for a quaternion."""
    return conversions.euler_from_quaternion(quaternion, axes)


def euler_from_matrix(matrix: Any, axes: str = "sxyz") -> tuple[float, float, float]:
    """Return the three Euler angles, in radians, for a rotation matrix.

    If several sets of angles describe the rotation (gimbal lock), the last angle is 0.
    """
    return conversions.euler_from_matrix(matrix, axes)


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Any:
    """Return the 4×4 rotation matrix for three Euler angles in radians."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def quaternion_matrix(quaternion: Sequence[float]) -> Any:
    """Return the 4×4 rotation matrix for a quaternion; the identity for a quaternion of zeros."""
    matrix = np.eye(4)
    turn = _quad(quaternion)
    if sum(part * part for part in turn) > _EPSILON:
        matrix[:3, :3] = quaternions.matrix(turn)
    return matrix


def quaternion_from_matrix(matrix: Any) -> Quad:
    """Return the quaternion, with w ≥ 0, for the rotation in a 4×4 matrix."""
    x, y, z, w = conversions.quaternion_from_matrix(np.asarray(matrix, dtype=float).tolist())
    return (-x, -y, -z, -w) if w < 0.0 else (x, y, z, w)


def quaternion_about_axis(angle: float, axis: Sequence[float]) -> Quad:
    """Return the quaternion for a rotation by an angle, in radians, about an axis."""
    return _quad(conversions.quaternion_from_axis_angle(axis, angle))


def quaternion_multiply(quaternion1: Sequence[float], quaternion0: Sequence[float]) -> Quad:
    """Return the product `quaternion1` · `quaternion0`."""
    return quaternions.multiply(_quad(quaternion1), _quad(quaternion0))


def quaternion_conjugate(quaternion: Sequence[float]) -> Quad:
    """Return the conjugate of a quaternion."""
    return quaternions.conjugate(_quad(quaternion))


def quaternion_inverse(quaternion: Sequence[float]) -> Quad:
    """Return the inverse of a quaternion."""
    q = _quad(quaternion)
    norm = sum(part * part for part in q)
    x, y, z, w = quaternions.conjugate(q)
    return (x / norm, y / norm, z / norm, w / norm)


def quaternion_slerp(quat0: Sequence[float], quat1: Sequence[float], fraction: float) -> Quad:
    """Interpolate between two quaternions along the shorter arc; `fraction` is 0 to 1."""
    start, end = quaternions.unit(_quad(quat0)), quaternions.unit(_quad(quat1))
    return quaternions.slerp(start, end, fraction)


def identity_matrix() -> Any:
    """Return the 4×4 identity matrix."""
    return np.identity(4)


def translation_matrix(direction: Sequence[float]) -> Any:
    """Return the 4×4 matrix for a translation."""
    matrix = np.identity(4)
    matrix[:3, 3] = direction[:3]
    return matrix


def translation_from_matrix(matrix: Any) -> Any:
    """Return the translation in a 4×4 matrix, shape (3,)."""
    return np.array(matrix, dtype=float)[:3, 3].copy()


def inverse_matrix(matrix: Any) -> Any:
    """Return the inverse of a 4×4 matrix."""
    return np.linalg.inv(matrix)


def concatenate_matrices(*matrices: Any) -> Any:
    """Return the product of 4×4 matrices, in the order of the arguments."""
    product = np.identity(4)
    for matrix in matrices:
        product = product @ np.asarray(matrix)
    return product


def compose_matrix(
    scale: Any = None,
    shear: Any = None,
    angles: Any = None,
    translate: Any = None,
    perspective: Any = None,
) -> Any:
    """Return the 4×4 matrix for `angles` (roll, pitch, yaw in radians) and `translate`.

    The other arguments are not supported and raise NotImplementedError.
    """
    if scale is not None or shear is not None or perspective is not None:
        raise NotImplementedError(
            "tftool's compose_matrix supports only the arguments angles and translate"
        )
    matrix = np.identity(4) if angles is None else euler_matrix(*angles)
    if translate is not None:
        matrix[:3, 3] = translate
    return matrix


def vector_norm(data: Any) -> float:
    """Return the length of a vector."""
    return float(np.linalg.norm(data))


def unit_vector(data: Any) -> Any:
    """Return a vector scaled to length 1."""
    array = np.array(data, dtype=float)
    return array / np.linalg.norm(array)
