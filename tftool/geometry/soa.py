"""Arithmetic of many poses at once in arrays with a row per component and a column per pose.

Batch lookups reuse arrays, so no function here allocates memory. A vector array has the rows x, y,
z, x, y, so that a cross product is three operations on three rows each. A quaternion array has a
row w before these rows. A single column is broadcast to all columns of another array.
"""

from typing import NamedTuple

import numpy as np
from numpy import add, multiply, subtract

from tftool.geometry.rigid_arrays import Floats

# tan(x)/x = 1 + x²/3 + 2x⁴/15 + …
_SERIES = (
    1.0,
    1.0 / 3.0,
    2.0 / 15.0,
    17.0 / 315.0,
    62.0 / 2835.0,
    1382.0 / 155925.0,
    21844.0 / 6081075.0,
    929569.0 / 638512875.0,
)

# Terms of the series below this are left out.
_NEGLIGIBLE = 2e-17


class Arcs(NamedTuple):
    """Shorter arcs from quaternions A to other quaternions, at constant angular speed.

    At the fraction f, the rotation is the quaternion A + s·C with s = f·tan(fθ)/(fθ); its length is
    √(1 + s²θ²). `tan_ratio` computes tan(fθ)/(fθ).

    Attributes:
        directions: The vectors C, which are perpendicular to A and have the length θ, shape (n, 4).
        half_angle_squared: θ², where θ is half the rotation angle from start to end, radians, shape
            (n,).
        terms: Number of terms of the series of tan(x)/x that the largest θ needs; 0 if θ is too
            large for the series.
    """

    directions: Floats
    half_angle_squared: Floats
    terms: int


def arcs(starts: Floats, ends: Floats) -> Arcs:
    """Compute the arcs between unit quaternions, shapes (n, 4), in any order of components.

    Source:
        Shoemake, "Animating Rotation with Quaternion Curves", SIGGRAPH 1985. For the angle θ of an
        arc and a fraction f of the arc, this code uses Shoemake's formula divided by cos(fθ). The
        interpolated quaternions therefore do not have unit length; the caller normalises them.
    """
    ends = np.where(_dot(starts, ends) < 0.0, -ends, ends)
    apart = ends - starts
    square = _dot(apart, apart)
    # The chord is 2·sin(θ/2), and θ is at most a right angle: no digits are lost, unlike
    # with the arc cosine.
    chord = np.sqrt(square)
    theta = 2.0 * np.arcsin(np.minimum(0.5 * chord, 1.0))
    sine = chord * np.sqrt(np.maximum(1.0 - 0.25 * square, 0.0))
    tiny = theta < 1e-9
    stretch = np.where(tiny, 1.0, theta / np.where(tiny, 1.0, sine))
    # This is ends − cos θ · starts, computed without cancellation.
    directions = (apart + 0.5 * square * starts) * stretch
    half_angle_squared = theta[:, 0] * theta[:, 0]
    return Arcs(directions, half_angle_squared, _terms(float(half_angle_squared.max(initial=0.0))))


def _dot(first: Floats, second: Floats) -> Floats:
    product: Floats = np.einsum("ij,ij->i", first, second)[:, None]
    return product


def _terms(square: float) -> int:
    """Return how many terms of the series of tan(x)/x are needed while x² is at most `square`."""
    power = 1.0
    for count, coefficient in enumerate(_SERIES):
        if coefficient * power < _NEGLIGIBLE:
            return count
        power *= square
    return 0 if _SERIES[-1] * power > _NEGLIGIBLE else len(_SERIES)


def tan_ratio(squares: Floats, out: Floats, terms: int) -> None:
    """Write tan(x)/x into `out`, for given x².

    Args:
        squares: The values of x².
        out: Output, of the same shape.
        terms: Number of terms of the series to use; 0 to compute the tangent itself.
    """
    if terms == 0:
        angles = np.sqrt(squares)
        np.tan(angles, out)
        # At angle 0 any finite value will do: it is multiplied by 0.
        np.divide(out, angles, out, where=angles > 0.0)
        return
    out.fill(_SERIES[terms - 1])
    for term in range(terms - 2, -1, -1):
        multiply(out, squares, out)
        add(out, _SERIES[term], out)


class VectorRows:
    """Many vectors as rows x, y, z, x, y of an array, with views for cross products."""

    __slots__ = ("first", "repeat", "xyz", "yzx", "zxy")

    def __init__(self, rows: Floats) -> None:
        """Store an array with five rows; call `close` to copy the rows x and y to the end."""
        self.xyz, self.yzx, self.zxy = rows[:3], rows[1:4], rows[2:5]
        self.first, self.repeat = rows[:2], rows[3:]

    def close(self) -> None:
        """Copy x and y into the last two rows, after x, y and z were written."""
        np.copyto(self.repeat, self.first)


class QuaternionRows:
    """Many quaternions of any length as rows w, x, y, z, x, y of an array, and views of rows."""

    __slots__ = ("first", "repeat", "rows", "w", "wxyz", "xyz", "yzx", "zxy")

    def __init__(self, rows: Floats) -> None:
        """Store an array with six rows; call `close` to copy the rows x and y to the end."""
        self.rows = rows
        self.w, self.wxyz = rows[0], rows[:4]
        self.xyz, self.yzx, self.zxy = rows[1:4], rows[2:5], rows[3:6]
        self.first, self.repeat = rows[1:3], rows[4:]

    def close(self) -> None:
        """Copy x and y into the last two rows, after w, x, y and z were written."""
        np.copyto(self.repeat, self.first)

    def conjugate(self) -> None:
        """Invert the rotations in place."""
        vector = self.rows[1:]
        np.negative(vector, vector)


def rotate(
    quaternions: QuaternionRows,
    factor: "Floats | float",
    vectors: VectorRows,
    cross: VectorRows,
    spare: Floats,
) -> None:
    """Rotate vectors in place, without updating the copies of x and y in the last two rows.

    Args:
        quaternions: Rotations to apply.
        factor: 2 divided by the quaternions' squared lengths.
        vectors: Vectors to rotate.
        cross: Work rows, overwritten.
        spare: Three work rows, overwritten.
    """
    multiply(quaternions.yzx, vectors.zxy, cross.xyz)
    multiply(quaternions.zxy, vectors.yzx, spare)
    subtract(cross.xyz, spare, cross.xyz)
    multiply(cross.xyz, factor, cross.xyz)
    cross.close()
    xyz = vectors.xyz
    multiply(cross.xyz, quaternions.w, spare)
    add(xyz, spare, xyz)
    multiply(quaternions.yzx, cross.zxy, spare)
    add(xyz, spare, xyz)
    multiply(quaternions.zxy, cross.yzx, spare)
    subtract(xyz, spare, xyz)


def chain(
    first: QuaternionRows, second: QuaternionRows, out: QuaternionRows, spare: Floats
) -> None:
    """Write the products of quaternions into `out`; `second` is applied first.

    `spare` is an array of three rows for intermediate results.
    """
    xyz, w = out.xyz, out.w
    # Add in the order of `poses.compose`, to get the same last bit without rotation.
    multiply(second.xyz, first.w, xyz)
    multiply(first.xyz, second.w, spare)
    add(xyz, spare, xyz)
    multiply(first.yzx, second.zxy, spare)
    add(xyz, spare, xyz)
    multiply(first.zxy, second.yzx, spare)
    subtract(xyz, spare, xyz)
    out.close()
    multiply(first.xyz, second.xyz, spare)
    multiply(first.w, second.w, w)
    subtract(w, spare[0], w)
    subtract(w, spare[1], w)
    subtract(w, spare[2], w)
