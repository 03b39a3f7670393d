"""Rotating and chaining many poses in place: numbers in rows, a pose in each column.

The fast half of `batch`, for arrays that are used again and again: nothing is allocated.
Vectors lie as rows x, y, z, x, y, so that a cross product is three operations on three
rows each; a quaternion has its w before them. What has one column stands for all.
"""

import numpy as np
from numpy import add, multiply, subtract

from tftool.geometry.batch import Floats


class Place:
    """Vectors: rows x, y, z, x, y, and views of them."""

    __slots__ = ("first", "repeat", "xyz", "yzx", "zxy")

    def __init__(self, rows: Floats) -> None:
        """Take five rows; the last two repeat the first two once `close` was called."""
        self.xyz, self.yzx, self.zxy = rows[:3], rows[1:4], rows[2:5]
        self.first, self.repeat = rows[:2], rows[3:]

    def close(self) -> None:
        """Repeat x and y, after x, y and z were written."""
        np.copyto(self.repeat, self.first)


class Turn:
    """Quaternions of any length: rows w, x, y, z, x, y, and views of them."""

    __slots__ = ("first", "repeat", "rows", "w", "wxyz", "xyz", "yzx", "zxy")

    def __init__(self, rows: Floats) -> None:
        """Take six rows; the last two repeat x and y once `close` was called."""
        self.rows = rows
        self.w, self.wxyz = rows[0], rows[:4]
        self.xyz, self.yzx, self.zxy = rows[1:4], rows[2:5], rows[3:6]
        self.first, self.repeat = rows[1:3], rows[4:]

    def close(self) -> None:
        """Repeat x and y, after w, x, y and z were written."""
        np.copyto(self.repeat, self.first)

    def conjugate(self) -> None:
        """Turn the other way."""
        vector = self.rows[1:]
        np.negative(vector, vector)


def rotate(turn: Turn, factor: "Floats | float", place: Place, cross: Place, spare: Floats) -> None:
    """Turn vectors in place; x and y are not repeated.

    Args:
        turn: By what.
        factor: 2 over the square of the quaternions' lengths.
        place: What is turned.
        cross: Is overwritten.
        spare: Three rows that are overwritten.
    """
    multiply(turn.yzx, place.zxy, cross.xyz)
    multiply(turn.zxy, place.yzx, spare)
    subtract(cross.xyz, spare, cross.xyz)
    multiply(cross.xyz, factor, cross.xyz)
    cross.close()
    xyz = place.xyz
    multiply(cross.xyz, turn.w, spare)
    add(xyz, spare, xyz)
    multiply(turn.yzx, cross.zxy, spare)
    add(xyz, spare, xyz)
    multiply(turn.zxy, cross.yzx, spare)
    subtract(xyz, spare, xyz)


def chain(first: Turn, second: Turn, out: Turn, spare: Floats) -> None:
    """Multiply quaternions: `second` is applied first; `spare` is three rows to overwrite."""
    xyz, w = out.xyz, out.w
    multiply(first.yzx, second.zxy, xyz)
    multiply(first.zxy, second.yzx, spare)
    subtract(xyz, spare, xyz)
    multiply(second.xyz, first.w, spare)
    add(xyz, spare, xyz)
    multiply(first.xyz, second.w, spare)
    add(xyz, spare, xyz)
    out.close()
    multiply(first.xyz, second.xyz, spare)
    multiply(first.w, second.w, w)
    subtract(w, spare[0], w)
    subtract(w, spare[1], w)
    subtract(w, spare[2], w)
