"""Functions of `rigid` and `quaternions` for arrays of shape (..., 3) and (..., 4).

Quaternions are in xyzw order, and leading axes broadcast. Each row of a result equals the result of
the function of the same name for plain floats.
"""

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.geometry.conversions import NOISE
from tftool.geometry.quaternions import ROUNDING

Floats: TypeAlias = npt.NDArray[np.float64]
"""Numbers in double precision, of any shape."""

_LEAST_SQUARE = 2.0 / 1.7976931348623157e308


def multiply(first: Floats, second: Floats) -> Floats:
    """Multiply quaternions, shape (..., 4): `second` is applied first."""
    ax, ay, az, aw = np.moveaxis(first, -1, 0)
    bx, by, bz, bw = np.moveaxis(second, -1, 0)
    return np.stack(
        (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx,
            aw * bw - ax * bx - ay * by - az * bz,
        ),
        axis=-1,
    )


def conjugate(quaternions: Floats) -> Floats:
    """Invert unit quaternions, shape (..., 4)."""
    undone: Floats = quaternions * np.array([-1.0, -1.0, -1.0, 1.0])
    return undone


def rotate(quaternions: Floats, vectors: Floats) -> Floats:
    """Rotate vectors, shape (..., 3), by unit quaternions, shape (..., 4)."""
    qx, qy, qz, qw = np.moveaxis(quaternions, -1, 0)
    x, y, z = np.moveaxis(vectors, -1, 0)
    cx = 2.0 * (qy * z - qz * y)
    cy = 2.0 * (qz * x - qx * z)
    cz = 2.0 * (qx * y - qy * x)
    return np.stack(
        (
            x + qw * cx + qy * cz - qz * cy,
            y + qw * cy + qz * cx - qx * cz,
            z + qw * cz + qx * cy - qy * cx,
        ),
        axis=-1,
    )


def unit(quaternions: Floats) -> Floats:
    """Scale quaternions to unit length, shape (..., 4); NaN for zero length."""
    with np.errstate(all="ignore"):
        x, y, z, w = np.moveaxis(quaternions, -1, 0)
        square = x * x + y * y + z * z + w * w
        # The squares of huge numbers overflow, although the direction is defined: scale first.
        if np.any(square == np.inf):
            largest = np.max(np.abs(quaternions), axis=-1)
            huge = (square == np.inf) & (largest < np.inf)
            smaller = np.where(huge[..., None], quaternions / largest[..., None], quaternions)
            again = unit(smaller) if np.any(huge) else quaternions
        else:
            huge, again = np.zeros(np.shape(square), dtype=bool), quaternions
        exact = np.abs(square - 1.0) < ROUNDING
        scale = np.where(exact, 1.0, 1.0 / np.sqrt(square))
        usable = (square > _LEAST_SQUARE) & (square < np.inf)
        scaled = np.where(usable[..., None], quaternions * scale[..., None], np.nan)
        return np.where(huge[..., None], again, scaled)


def canonical(quaternions: Floats) -> Floats:
    """Return unit quaternions, shape (..., 4), signed as in tf2; see `quaternions.canonical`."""
    x, y, z, w = np.moveaxis(quaternions, -1, 0)
    xx, yy, zz = x * x, y * y, z * z
    side = np.where(xx < yy, np.where(yy < zz, z, y), np.where(xx < zz, z, x))
    lead = np.where(w * w > 0.25, w, side)
    return np.where((lead < 0.0)[..., None], -quaternions, quaternions)


def matrices(translations: Floats, rotations: Floats) -> Floats:
    """Return the homogeneous 4×4 matrices of poses with unit quaternions, shape (..., 4, 4)."""
    x, y, z, w = np.moveaxis(rotations, -1, 0)
    result = np.zeros((*x.shape, 4, 4))
    result[..., 0, 0] = 1.0 - 2.0 * (y * y + z * z)
    result[..., 0, 1] = 2.0 * (x * y - w * z)
    result[..., 0, 2] = 2.0 * (x * z + w * y)
    result[..., 1, 0] = 2.0 * (x * y + w * z)
    result[..., 1, 1] = 1.0 - 2.0 * (x * x + z * z)
    result[..., 1, 2] = 2.0 * (y * z - w * x)
    result[..., 2, 0] = 2.0 * (x * z - w * y)
    result[..., 2, 1] = 2.0 * (y * z + w * x)
    result[..., 2, 2] = 1.0 - 2.0 * (x * x + y * y)
    result[..., :3, 3] = translations
    result[..., 3, 3] = 1.0
    return result


def roll_pitch_yaw(quaternions: Floats) -> Floats:
    """Return roll, pitch and yaw of unit quaternions, radians, shape (..., 3).

    The formulas are those of `conversions.precise_rpy_from_quaternion`.
    """
    x, y, z, w = np.moveaxis(quaternions, -1, 0)
    a, b, c, d = w - y, x + z, y + w, z - x
    near, far = np.hypot(a, b), np.hypot(c, d)
    half_sum, half_difference = np.arctan2(b, a), np.arctan2(d, c)
    # At a pole one of the two is pure rounding, and is ignored.
    level = (near > NOISE) & (far > NOISE)
    alone = np.where(near > NOISE, 2.0 * half_sum, -2.0 * half_difference)
    angles: Floats = np.stack(
        [
            _wrapped(np.where(level, half_sum - half_difference, alone)),
            2.0 * np.arctan2(far, near) - 0.5 * np.pi,
            _wrapped(np.where(level, half_sum + half_difference, 0.0)),
        ],
        axis=-1,
    )
    angles[np.isnan(w)] = np.nan
    return angles


def _wrapped(angles: Floats) -> Floats:
    """Wrap angles to the range from −π to π."""
    turned: Floats = np.where(
        np.abs(angles) > np.pi, angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi)), angles
    )
    return turned


def angles_between(first: Floats, second: Floats) -> Floats:
    """Return the angles between unit quaternions, radians from 0 to π; shapes (..., 4)."""
    dot = np.sum(first * second, axis=-1, keepdims=True)
    second = np.where(dot < 0.0, -second, second)
    # arccos of the dot product would lose half the digits of a small angle.
    angles: Floats = 4.0 * np.arctan2(_length(second - first), _length(second + first))
    return angles[..., 0]


def rotation_vectors(quaternions: Floats) -> Floats:
    """Return rotation vectors of unit quaternions, shape (..., 3): axis times angle, 0 to π."""
    signed = np.where(quaternions[..., 3:] < 0.0, -quaternions, quaternions)
    vector = signed[..., :3]
    sine = _length(vector)
    angle = 2.0 * np.arctan2(sine, signed[..., 3:])
    # For a tiny turn the vector part of the quaternion is half the rotation vector.
    tiny = sine < 1e-150
    turned: Floats = vector * np.where(tiny, 2.0, angle / np.where(tiny, 1.0, sine))
    return turned


def _length(vectors: Floats) -> Floats:
    length: Floats = np.sqrt(np.sum(vectors * vectors, axis=-1, keepdims=True))
    return length
