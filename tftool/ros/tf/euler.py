"""tf_transformations: Euler angles, quaternions (x, y, z, w) and 4×4 matrices.

`axes` is "s" (about fixed axes) or "r" (about axes that turn along) and three letters;
"sxyz" is roll, pitch, yaw.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from tftool.geometry import quaternions
from tftool.geometry.quaternions import Quad

_EPSILON = 4 * float(np.finfo(float).eps)
_LETTERS = "xyz"

TRANSLATION_IDENTITY = [0.0, 0.0, 0.0]
ROTATION_IDENTITY = [0.0, 0.0, 0.0, 1.0]


def _parsed(axes: str) -> tuple[bool, tuple[int, int, int]]:
    letters = axes[1:] if isinstance(axes, str) else ""
    fits = len(letters) == 3 and set(letters) <= set(_LETTERS) and axes[0] in "sr"
    if not fits or letters[0] == letters[1] or letters[1] == letters[2]:
        raise ValueError(f"axes are 's' or 'r' and three of x, y, z such as 'sxyz', not {axes!r}")
    first, second, third = (_LETTERS.index(letter) for letter in letters)
    return axes[0] == "s", (first, second, third)


def _about(axis: int, angle: float) -> Quad:
    parts = [0.0, 0.0, 0.0, math.cos(angle / 2)]
    parts[axis] = math.sin(angle / 2)
    return (parts[0], parts[1], parts[2], parts[3])


def _quad(quaternion: Sequence[float]) -> Quad:
    x, y, z, w = (float(part) for part in quaternion)
    return (x, y, z, w)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Quad:
    """The quaternion of three turns, one after the other."""
    fixed, (first, second, third) = _parsed(axes)
    one, two, three = _about(first, ai), _about(second, aj), _about(third, ak)
    if fixed:
        return quaternions.multiply(three, quaternions.multiply(two, one))
    return quaternions.multiply(one, quaternions.multiply(two, three))


def euler_from_quaternion(
    quaternion: Sequence[float], axes: str = "sxyz"
) -> tuple[float, float, float]:
    """The three turns that a quaternion is made of."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def euler_from_matrix(matrix: Any, axes: str = "sxyz") -> tuple[float, float, float]:
    """The three turns of a rotation matrix; where they are not unique, the last is 0."""
    fixed, (first, second, third) = _parsed(axes)
    rotation = np.asarray(matrix, dtype=float)[:3, :3]
    if not fixed:
        # Turns about turning axes are the same turns about fixed ones in reverse order.
        three, two, one = _fixed(rotation, (third, second, first))
        return (one, two, three)
    return _fixed(rotation, (first, second, third))


def _fixed(m: Any, axes: tuple[int, int, int]) -> tuple[float, float, float]:
    i, j, last = axes
    k = 3 - i - j
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    if last == i:
        sine = math.hypot(m[i, j], m[i, k])
        if sine > _EPSILON:
            return (
                math.atan2(m[i, j], sign * m[i, k]),
                math.atan2(sine, m[i, i]),
                math.atan2(m[j, i], -sign * m[k, i]),
            )
        return (math.atan2(-sign * m[j, k], m[j, j]), math.atan2(sine, m[i, i]), 0.0)
    cosine = math.hypot(m[i, i], m[j, i])
    if cosine > _EPSILON:
        return (
            math.atan2(sign * m[k, j], m[k, k]),
            math.atan2(-sign * m[k, i], cosine),
            math.atan2(sign * m[j, i], m[i, i]),
        )
    return (math.atan2(-sign * m[j, k], m[j, j]), math.atan2(-sign * m[k, i], cosine), 0.0)


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Any:
    """The 4×4 matrix of three turns."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def quaternion_matrix(quaternion: Sequence[float]) -> Any:
    """The 4×4 matrix of a quaternion; zero stands for no turn."""
    x, y, z, w = _quad(quaternion)
    norm = x * x + y * y + z * z + w * w
    matrix = np.eye(4)
    if norm > _EPSILON:
        s = 2.0 / norm
        matrix[:3, :3] = [
            [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)],
        ]
    return matrix


def quaternion_from_matrix(matrix: Any) -> Quad:
    """The quaternion of a 4×4 matrix, w not negative."""
    m = np.asarray(matrix, dtype=float)[:3, :3]
    squares = [
        1 + m[0, 0] - m[1, 1] - m[2, 2],
        1 - m[0, 0] + m[1, 1] - m[2, 2],
        1 - m[0, 0] - m[1, 1] + m[2, 2],
        1 + m[0, 0] + m[1, 1] + m[2, 2],
    ]
    largest = int(np.argmax(squares))
    if largest == 3:
        parts = [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], squares[3]]
    else:
        i = largest
        j, k = (i + 1) % 3, (i + 2) % 3
        parts = [0.0, 0.0, 0.0, m[k, j] - m[j, k]]
        parts[i], parts[j], parts[k] = squares[i], m[j, i] + m[i, j], m[k, i] + m[i, k]
    length = math.sqrt(sum(part * part for part in parts))
    sign = -1.0 if parts[3] < 0 else 1.0
    return _quad([sign * part / length for part in parts])


def quaternion_about_axis(angle: float, axis: Sequence[float]) -> Quad:
    """The quaternion of a turn about an axis."""
    x, y, z = (float(part) for part in axis)
    length = math.sqrt(x * x + y * y + z * z)
    if length < _EPSILON:
        raise ValueError("an axis must not be zero")
    scale = math.sin(angle / 2) / length
    return (x * scale, y * scale, z * scale, math.cos(angle / 2))


def quaternion_multiply(quaternion1: Sequence[float], quaternion0: Sequence[float]) -> Quad:
    """First `quaternion0`, then `quaternion1`."""
    return quaternions.multiply(_quad(quaternion1), _quad(quaternion0))


def quaternion_conjugate(quaternion: Sequence[float]) -> Quad:
    """The quaternion with its vector part reversed."""
    return quaternions.conjugate(_quad(quaternion))


def quaternion_inverse(quaternion: Sequence[float]) -> Quad:
    """The quaternion that undoes one."""
    q = _quad(quaternion)
    norm = sum(part * part for part in q)
    x, y, z, w = quaternions.conjugate(q)
    return (x / norm, y / norm, z / norm, w / norm)


def quaternion_slerp(quat0: Sequence[float], quat1: Sequence[float], fraction: float) -> Quad:
    """A share of the way from one rotation to another, along the shorter arc."""
    start = np.array(quat0, dtype=float) / np.linalg.norm(quat0)
    end = np.array(quat1, dtype=float) / np.linalg.norm(quat1)
    if float(start @ end) < 0.0:
        end = -end
    angle = 2.0 * math.atan2(float(np.linalg.norm(end - start)), float(np.linalg.norm(end + start)))
    if angle < 1e-9:
        return _quad(start)
    keep, take = math.sin((1 - fraction) * angle), math.sin(fraction * angle)
    return _quad((keep * start + take * end) / math.sin(angle))


def identity_matrix() -> Any:
    """The 4×4 matrix that changes nothing."""
    return np.identity(4)


def translation_matrix(direction: Sequence[float]) -> Any:
    """The 4×4 matrix of a translation."""
    matrix = np.identity(4)
    matrix[:3, 3] = direction[:3]
    return matrix


def translation_from_matrix(matrix: Any) -> Any:
    """The translation of a 4×4 matrix."""
    return np.array(matrix, dtype=float)[:3, 3].copy()


def inverse_matrix(matrix: Any) -> Any:
    """The 4×4 matrix that undoes one."""
    return np.linalg.inv(matrix)


def concatenate_matrices(*matrices: Any) -> Any:
    """The product of 4×4 matrices."""
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
    """The 4×4 matrix of a translation after a turn by roll, pitch, yaw."""
    if scale is not None or shear is not None or perspective is not None:
        raise NotImplementedError("compose_matrix takes angles and translate here")
    matrix = np.identity(4) if angles is None else euler_matrix(*angles)
    if translate is not None:
        matrix[:3, 3] = translate
    return matrix


def vector_norm(data: Any) -> float:
    """The length of a vector."""
    return float(np.linalg.norm(data))


def unit_vector(data: Any) -> Any:
    """A vector scaled to length one."""
    array = np.array(data, dtype=float)
    return array / np.linalg.norm(array)
