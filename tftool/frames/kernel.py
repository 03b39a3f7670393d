"""The arithmetic of a batch: one chain of links, many moments.

Everything happens in blocks of a few thousand moments, in arrays made once that stay in
the processor's cache.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy import add, copyto, multiply, subtract, take

from tftool.frames.columns import Column, Stamps
from tftool.frames.intervals import SERIES, Intervals
from tftool.frames.links import Sample
from tftool.frames.search import Buckets, find_sorted, settle_oldest
from tftool.geometry.batch import Floats
from tftool.geometry.lanes import Place, Turn, chain, rotate

BLOCK = 1 << 14
"""Moments worked on together."""

# The intervals of so long a history are still worked out as one: 136 bytes each.
MOST_INTERVALS = 1 << 16


class Moving:
    """A link that moves, made ready for a batch."""

    __slots__ = ("_buckets", "column", "intervals")

    def __init__(self, column: Column, count: int) -> None:
        """Make a link ready for so many moments."""
        self.column = column
        k = len(column.stamps)
        self.intervals = (
            Intervals(column, slice(0, k)) if 0 < k <= min(count, MOST_INTERVALS) else None
        )
        self._buckets: Buckets | None = None

    @property
    def buckets(self) -> Buckets:
        """Made when moments first come in no order."""
        if self._buckets is None:
            self._buckets = Buckets(self.column.stamps)
        return self._buckets


class Fixed:
    """A link that does not move: one column that stands for all."""

    __slots__ = ("place", "turn")

    def __init__(self, sample: Sample) -> None:
        x, y, z, qx, qy, qz, qw = sample
        self.place: Floats = np.array([[x], [y], [z]])
        self.turn = Turn(np.array([[qw], [qx], [qy], [qz], [qx], [qy]]))


Edge: TypeAlias = "Moving | Fixed"


class _Side:
    """What came together on the way up from the source, or from the target."""

    __slots__ = ("empty", "place", "square", "turn", "unused")

    def __init__(self, count: int) -> None:
        self.empty = True
        self.place = Place(np.empty((5, count)))
        self.turn, self.unused = Turn(np.empty((6, count))), Turn(np.empty((6, count)))
        # The quaternions are as long as they come out; this is their length squared.
        self.square: Floats = np.empty(count)


class Workspace:
    """The arrays in which a block of moments is worked on, and what is done in them."""

    def __init__(self, count: int) -> None:
        """Make room for blocks of exactly so many moments."""
        self._index = np.empty(count, dtype=np.intp)
        self._whole = np.empty(count, dtype=np.int64)
        self._flags = np.empty(count, dtype=np.bool_)
        self._some, self._more = np.empty((2, count, 4))
        self._share, self._bend, self._factor, self._square = np.empty((4, count))
        self._spare: Floats = np.empty((3, count))
        self._cross, self._place = Place(np.empty((5, count))), Place(np.empty((5, count)))
        self._turn = Turn(np.empty((6, count)))
        self._up, self._down = _Side(count), _Side(count)

    def solve(
        self,
        up: Sequence[Edge],
        down: Sequence[Edge],
        times: Stamps,
        in_order: bool,
        translations: Floats,
        rotations: Floats,
    ) -> None:
        """Write the pose of source in target at each moment.

        Args:
            up: Links from the source to where both sides meet.
            down: Links from the target to there.
            times: Moments for which every link has data, shape (n,), n as made room for.
            in_order: Whether no moment is earlier than the one before.
            translations: Is written to, shape (n, 3).
            rotations: Is written to, shape (n, 4).
        """
        with np.errstate(all="ignore"):
            self._climb(self._up, up, times, in_order)
            self._climb(self._down, down, times, in_order)
            self._join(translations, rotations)

    def _climb(self, side: _Side, edges: Sequence[Edge], times: Stamps, in_order: bool) -> None:
        """Chain the links of one side."""
        side.empty = not edges
        factor: Floats | float
        for number, edge in enumerate(edges):
            if number == 0:
                if isinstance(edge, Moving):
                    self._interpolate(edge, times, in_order, side.place, side.turn, side.square)
                else:
                    copyto(side.place.xyz, edge.place)
                    copyto(side.turn.rows, edge.turn.rows)
                    side.square.fill(1.0)
                side.place.close()
                continue
            if isinstance(edge, Moving):
                step, turn, factor = self._place.xyz, self._turn, self._factor
                self._interpolate(edge, times, in_order, self._place, turn, self._square)
                multiply(side.square, self._square, side.square)
                np.divide(2.0, self._square, factor)
            else:
                step, turn, factor = edge.place, edge.turn, 2.0
            rotate(turn, factor, side.place, self._cross, self._spare)
            add(side.place.xyz, step, side.place.xyz)
            side.place.close()
            chain(turn, side.turn, side.unused, self._spare)
            side.turn, side.unused = side.unused, side.turn

    def _interpolate(
        self,
        edge: Moving,
        times: Stamps,
        in_order: bool,
        place: Place,
        turn: Turn,
        square: Floats,
    ) -> None:
        """Write a link's pose at each moment, and the square of its quaternion's length."""
        index, whole, share = self._index, self._whole, self._share
        intervals = self._find(edge, times, in_order)
        row_by_row = intervals.row_by_row
        if row_by_row:
            # Worked out row by row: nothing to be fetched.
            begun, some, more = intervals.stamps, intervals.places, intervals.paths
        else:
            begun = take(intervals.stamps, index, None, whole, "clip")
            some = take(intervals.places, index, 0, self._some, "clip")
            more = take(intervals.paths, index, 0, self._more, "clip")
        subtract(times, begun, whole)
        copyto(share, whole)
        multiply(share, some[:, 3], share)
        multiply(share, more.T[:3], place.xyz)
        add(place.xyz, some.T[:3], place.xyz)
        if intervals.endless:
            # No way leads from or to infinity, but a sample is met as it is.
            met = np.flatnonzero(share == 0.0)
            place.xyz[:, met] = some[met, :3].T
        self._bow(share, more[:, 3], intervals.terms, square)
        if row_by_row:
            some, more = intervals.starts, intervals.turns
        else:
            some = take(intervals.starts, index, 0, self._some, "clip")
            more = take(intervals.turns, index, 0, self._more, "clip")
        multiply(share, more.T, turn.wxyz)
        add(turn.wxyz, some.T, turn.wxyz)
        turn.close()

    def _find(self, edge: Moving, times: Stamps, in_order: bool) -> Intervals:
        """The intervals to use, with each moment's number in `_index`."""
        index, column = self._index, edge.column
        if in_order:
            find_sorted(column.stamps, times, index)
        else:
            edge.buckets.find(times, index, self._whole, self._flags)
        settle_oldest(column, times, index)
        if edge.intervals is not None:
            return edge.intervals
        if in_order:
            first, last = int(index[0]), int(index[-1])
            if last - first < len(index):
                subtract(index, first, index)
                return Intervals(column, slice(first, last + 1))
        return Intervals(column, index)

    def _bow(self, share: Floats, theta_squared: Floats, terms: int, square: Floats) -> None:
        """Turn shares of the arc into shares of its tangent, in place; give 1 + their square."""
        bend = self._bend
        if terms == 0:
            np.sqrt(theta_squared, bend)
            multiply(share, bend, square)
            np.tan(square, square)
            # Where there is no turn at all, the share itself will do.
            np.divide(square, bend, share, where=bend > 0.0)
            multiply(square, square, square)
            add(square, 1.0, square)
            return
        if terms > 1:
            multiply(share, share, bend)
            multiply(bend, theta_squared, bend)
            multiply(bend, SERIES[terms - 1], square)
            for term in range(terms - 2, 0, -1):
                add(square, SERIES[term], square)
                multiply(square, bend, square)
            add(square, 1.0, square)
            multiply(share, square, share)
        multiply(share, share, square)
        multiply(square, theta_squared, square)
        add(square, 1.0, square)

    def _join(self, translations: Floats, rotations: Floats) -> None:
        """Put the two sides together, and write the answers."""
        up, down, scale = self._up, self._down, self._factor
        place, turn, square = up.place, up.turn, up.square
        if not down.empty:
            np.divide(2.0, down.square, scale)
            back = down.turn
            back.conjugate()
            if up.empty:
                place, turn, square = down.place, back, down.square
                np.negative(place.xyz, place.xyz)
                place.close()
            else:
                # The difference is turned, not the two ends: where they are equal, the
                # answer is zero to the last bit.
                subtract(place.xyz, down.place.xyz, place.xyz)
                place.close()
                chain(back, turn, up.unused, self._spare)
                turn = up.unused
                multiply(square, down.square, square)
            rotate(back, scale, place, self._cross, self._spare)
        copyto(translations.T, place.xyz)
        np.sqrt(square, scale)
        np.divide(1.0, scale, scale)
        np.copysign(scale, self._lead(turn, square), scale)
        multiply(turn.xyz, scale, rotations.T[:3])
        multiply(turn.w, scale, rotations.T[3])

    def _lead(self, turn: Turn, square: Floats) -> Floats:
        """The numbers whose sign tf2 makes positive; see `quaternions.canonical`."""
        small, large, lead, size = self._bend, self._flags, self._share, self._spare
        multiply(turn.w, turn.w, small)
        multiply(square, 0.25, square)
        np.less_equal(small, square, large)
        if not large.any():
            w: Floats = turn.w
            return w
        copyto(lead, turn.w)
        x, y, z = turn.xyz
        np.abs(turn.xyz, size)
        copyto(lead, x, where=large)
        second = size[1] > size[0]
        np.maximum(size[0], size[1], out=size[0])
        third = size[2] > size[0]
        copyto(lead, y, where=np.logical_and(large, second, second))
        copyto(lead, z, where=np.logical_and(large, third, third))
        return lead
