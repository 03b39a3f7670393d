"""What lies between neighbouring samples, worked out once for all moments that fall there.

From one sample to the next, at the share f of the way,

    position = P + f·D        rotation ∝ A + s·C        s = f·tan(fθ)/(fθ)

where θ is half the turn between the two, A the first quaternion and C the direction
toward the second, at right angles to A and θ long. That is the shorter arc at constant
speed, but for its length, √(1 + s²θ²), which is divided out once at the end of a chain.
"""

from typing import TypeVar

import numpy as np
import numpy.typing as npt

from tftool.frames.columns import Column, Stamps
from tftool.geometry.batch import Floats

# tan(x)/x = 1 + x²/3 + 2x⁴/15 + …
SERIES = (
    1.0,
    1.0 / 3.0,
    2.0 / 15.0,
    17.0 / 315.0,
    62.0 / 2835.0,
    1382.0 / 155925.0,
    21844.0 / 6081075.0,
    929569.0 / 638512875.0,
)

T = TypeVar("T", np.int64, np.float64)

_WXYZ = [6, 3, 4, 5]

# What a left-out term may amount to.
_NOTHING = 2e-17


class Intervals:
    """The intervals of one link, or of some of its rows.

    Quaternions are in wxyz order here. Four numbers lie together in a row because
    fetching 32 bytes costs what fetching 8 does.

    Attributes:
        stamps: Where each interval begins, int64, shape (k,).
        rates: 1 over its length in nanoseconds, shape (k,).
        bends: θ², shape (k,).
        places: P, shape (k, 4); the last number is of no use, as in `paths`.
        paths: D, shape (k, 4).
        starts: A, shape (k, 4).
        turns: C, shape (k, 4).
        endless: Whether one of them begins or ends at infinity.
        row_by_row: Whether they were worked out for given samples, one for each moment.
        terms: How many terms of the series the largest turn needs; 0 if too many.
    """

    __slots__ = (
        "bends",
        "endless",
        "paths",
        "places",
        "rates",
        "row_by_row",
        "stamps",
        "starts",
        "terms",
        "turns",
    )

    def __init__(self, column: Column, first: npt.NDArray[np.intp] | slice) -> None:
        """Work out some intervals of a column.

        Args:
            column: The samples.
            first: The samples they begin with. After the last sample comes an empty one.
        """
        last = len(column.stamps) - 1
        self.row_by_row = not isinstance(first, slice)
        if isinstance(first, slice):
            first = np.arange(first.start, first.stop)
        second = np.minimum(first + 1, last)
        begin, end = column.samples.take(first, axis=0), column.samples.take(second, axis=0)
        self.stamps: Stamps = column.stamps[first]
        length = (column.stamps[second] - self.stamps).astype(np.float64)
        still = length == 0.0
        if column.parents is not None:
            # Between two parents there is no way: the older sample stays as it is.
            still |= column.parents[first] != column.parents[second]
        k = len(first)
        self.places: Floats = np.zeros((k, 4))
        self.paths: Floats = np.zeros((k, 4))
        self.turns: Floats = np.empty((k, 4))
        self.places[:, :3] = begin[:, :3]
        self.rates: Floats = np.where(still, 0.0, 1.0 / np.where(still, 1.0, length))
        np.subtract(end[:, :3], begin[:, :3], out=self.paths[:, :3])
        self.paths[still] = 0.0
        self.endless = not np.isfinite(self.paths[:, :3]).all()
        self.starts: Floats = begin[:, _WXYZ]
        ahead = end[:, _WXYZ]
        ahead = np.where(_dot(self.starts, ahead) < 0.0, -ahead, ahead)
        apart = ahead - self.starts
        square = _dot(apart, apart)
        # The chord is 2·sin(θ/2), and θ at most a right angle: no digits are lost, as they
        # would be by the arc cosine.
        chord = np.sqrt(square)
        theta = 2.0 * np.arcsin(np.minimum(0.5 * chord, 1.0))
        sine = chord * np.sqrt(np.maximum(1.0 - 0.25 * square, 0.0))
        tiny = theta < 1e-9
        stretch = np.where(tiny, 1.0, theta / np.where(tiny, 1.0, sine))
        # ahead − cos θ · start, without the cancellation.
        np.multiply(apart + 0.5 * square * self.starts, stretch, out=self.turns)
        self.bends: Floats = theta[:, 0] * theta[:, 0]
        self.terms = _terms(float(self.bends.max(initial=0.0)))

    def fetch(
        self, table: npt.NDArray[T], index: npt.NDArray[np.intp], out: npt.NDArray[T]
    ) -> None:
        """Write what one of these tables has for each moment.

        Args:
            table: Shape (k,) or (k, 4).
            index: The interval of each moment, shape (n,).
            out: Is written to, shape (n,) or (n, 4).
        """
        if self.row_by_row:
            np.copyto(out, table)
        else:
            table.take(index, 0, out, "clip")


def _dot(first: Floats, second: Floats) -> Floats:
    product: Floats = np.einsum("ij,ij->i", first, second)[:, None]
    return product


def _terms(square: float) -> int:
    """How many terms of the series are needed up to an angle whose square this is."""
    power = 1.0
    for count, coefficient in enumerate(SERIES):
        if coefficient * power < _NOTHING:
            return count
        power *= square
    return 0 if SERIES[-1] * power > _NOTHING else len(SERIES)
