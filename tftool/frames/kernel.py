"""The arithmetic of a batch: one chain of links, many moments.

Everything happens in blocks of a few thousand moments, in arrays made once that stay in
the processor's cache. Vectors lie as rows x, y, z, x, y, so that a cross product is
three operations on three rows each; a quaternion has its w before them.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from tftool.frames.columns import Column, Stamps
from tftool.frames.intervals import SERIES, Intervals
from tftool.frames.links import Sample
from tftool.frames.search import Buckets, find_sorted, settle_oldest
from tftool.geometry.batch import Floats

BLOCK = 1 << 13
"""Moments worked on together."""

# The intervals of so long a history are still worked out as one: 128 bytes each.
_MOST_INTERVALS = 1 << 16


class Moving:
    """A link that moves, made ready for a batch."""

    __slots__ = ("_buckets", "column", "intervals")

    def __init__(self, column: Column, count: int) -> None:
        """Make a link ready for so many moments."""
        self.column = column
        k = len(column.stamps)
        self.intervals = (
            Intervals(column, slice(0, k)) if 0 < k <= min(count, _MOST_INTERVALS) else None
        )
        self._buckets: Buckets | None = None

    @property
    def buckets(self) -> Buckets:
        """Made when moments first come in no order."""
        if self._buckets is None:
            self._buckets = Buckets(self.column.stamps)
        return self._buckets


class Fixed:
    """A link that does not move: arrays of one column, which broadcast."""

    __slots__ = ("place", "turn")

    def __init__(self, sample: Sample) -> None:
        x, y, z, qx, qy, qz, qw = sample
        self.place: Floats = np.array([[x], [y], [z]])
        self.turn: Floats = np.array([[qw], [qx], [qy], [qz], [qx], [qy]])


Edge: TypeAlias = "Moving | Fixed"


class _Side:
    """What came together on the way up from the source, or from the target."""

    __slots__ = ("empty", "place", "spare_turn", "square", "turn")

    def __init__(self) -> None:
        self.empty = True
        self.place: Floats = np.empty((5, BLOCK))
        self.turn, self.spare_turn = np.empty((2, 6, BLOCK))
        # The quaternions are as long as they come out; this is their length squared.
        self.square: Floats = np.empty(BLOCK)


class Workspace:
    """The arrays one thread works in, and what is done in them."""

    def __init__(self) -> None:
        self._index = np.empty(BLOCK, dtype=np.intp)
        self._whole = np.empty(BLOCK, dtype=np.int64)
        self._later = np.empty(BLOCK, dtype=np.bool_)
        self._rows = np.empty((4, BLOCK, 4))
        self._share, self._bend, self._factor, self._square = np.empty((4, BLOCK))
        self._turn: Floats = np.empty((6, BLOCK))
        self._place, self._spare = np.empty((2, 3, BLOCK))
        self._cross: Floats = np.empty((5, BLOCK))
        self._up, self._down = _Side(), _Side()

    def solve(
        self,
        up: Sequence[Edge],
        down: Sequence[Edge],
        times: Stamps,
        translations: Floats,
        rotations: Floats,
    ) -> None:
        """Write the pose of source in target at each moment.

        Args:
            up: Links from the source to where both sides meet.
            down: Links from the target to there.
            times: Moments for which every link has data, shape (n,).
            translations: Is written to, shape (n, 3).
            rotations: Is written to, shape (n, 4).
        """
        in_order = bool(np.all(times[1:] >= times[:-1]))
        with np.errstate(all="ignore"):
            for start in range(0, len(times), BLOCK):
                rows = slice(start, start + BLOCK)
                block = times[rows]
                self._climb(self._up, up, block, in_order)
                self._climb(self._down, down, block, in_order)
                self._join(translations[rows], rotations[rows])

    def _climb(self, side: _Side, edges: Sequence[Edge], times: Stamps, in_order: bool) -> None:
        """Chain the links of one side."""
        m = len(times)
        side.empty = not edges
        place, square = side.place[:, :m], side.square[:m]
        for number, edge in enumerate(edges):
            turn = side.turn[:, :m]
            if number == 0:
                if isinstance(edge, Moving):
                    self._interpolate(edge, times, in_order, place, turn, square)
                else:
                    place[:3], turn[:], square[:] = edge.place, edge.turn, 1.0
                place[3:] = place[:2]
                continue
            factor = self._factor[:m]
            if isinstance(edge, Moving):
                step, twist, extent = self._place[:, :m], self._turn[:, :m], self._square[:m]
                self._interpolate(edge, times, in_order, step, twist, extent)
                np.multiply(square, extent, out=square)
                np.divide(2.0, extent, out=factor)
            else:
                step, twist = edge.place, edge.turn
                factor[:] = 2.0
            self._rotate(twist, factor, place)
            place[:3] += step
            place[3:] = place[:2]
            self._chain(twist, turn, side.spare_turn[:, :m])
            side.turn, side.spare_turn = side.spare_turn, side.turn

    def _interpolate(
        self,
        edge: Moving,
        times: Stamps,
        in_order: bool,
        place: Floats,
        turn: Floats,
        square: Floats,
    ) -> None:
        """Write a link's pose at each moment, and the square of its quaternion's length."""
        m = len(times)
        index, whole = self._index[:m], self._whole[:m]
        column, intervals = edge.column, edge.intervals
        if in_order:
            find_sorted(column.stamps, times, index)
        else:
            edge.buckets.find(times, index, whole, self._later[:m])
        settle_oldest(column, times, index)
        if intervals is None and in_order:
            first, last = int(index[0]), int(index[-1])
            if last - first < m // 2:
                intervals = Intervals(column, slice(first, last + 1))
                index -= first
        if intervals is None:
            intervals = Intervals(column, index)
            begun = intervals.stamps
            places, paths, starts, turns = (
                intervals.places,
                intervals.paths,
                intervals.starts,
                intervals.turns,
            )
        else:
            rows = self._rows[:, :m]
            begun = np.take(intervals.stamps, index, out=whole, mode="clip")
            places = np.take(intervals.places, index, axis=0, out=rows[0], mode="clip")
            paths = np.take(intervals.paths, index, axis=0, out=rows[1], mode="clip")
            starts = np.take(intervals.starts, index, axis=0, out=rows[2], mode="clip")
            turns = np.take(intervals.turns, index, axis=0, out=rows[3], mode="clip")
        np.subtract(times, begun, out=whole)
        share = self._share[:m]
        np.copyto(share, whole)
        np.multiply(share, places[:, 3], out=share)
        np.multiply(share, paths.T[:3], out=place[:3])
        place[:3] += places.T[:3]
        if intervals.endless:
            # No way leads from or to infinity, but a sample is met as it is.
            met = np.flatnonzero(share == 0.0)
            place[:3, met] = places[met, :3].T
        self._bow(share, paths[:, 3], intervals.terms, square)
        np.multiply(share, turns.T, out=turn[:4])
        turn[:4] += starts.T
        turn[4:] = turn[1:3]

    def _bow(self, share: Floats, theta_squared: Floats, terms: int, square: Floats) -> None:
        """Turn shares of the arc into shares of its tangent, in place; give 1 + their square."""
        m = len(share)
        bend = self._bend[:m]
        if terms == 0:
            np.sqrt(theta_squared, out=bend)
            np.multiply(share, bend, out=square)
            np.tan(square, out=square)
            # Where there is no turn at all, the share itself will do.
            np.divide(square, bend, out=share, where=bend > 0.0)
            np.multiply(square, square, out=square)
            square += 1.0
            return
        if terms > 1:
            np.multiply(share, share, out=bend)
            np.multiply(bend, theta_squared, out=bend)
            np.multiply(bend, SERIES[terms - 1], out=square)
            for term in range(terms - 2, 0, -1):
                square += SERIES[term]
                square *= bend
            square += 1.0
            np.multiply(share, square, out=share)
        np.multiply(share, share, out=square)
        np.multiply(square, theta_squared, out=square)
        square += 1.0

    def _rotate(self, turn: Floats, factor: Floats, place: Floats) -> None:
        """Turn places in place; `factor` is 2 over the quaternion's length squared."""
        m = place.shape[1]
        cross, spare = self._cross[:, :m], self._spare[:, :m]
        _cross(turn[1:], place, cross[:3], spare)
        np.multiply(cross[:3], factor, out=cross[:3])
        cross[3:] = cross[:2]
        np.multiply(cross[:3], turn[0], out=spare)
        place[:3] += spare
        np.multiply(turn[2:5], cross[2:5], out=spare)
        place[:3] += spare
        np.multiply(turn[3:6], cross[1:4], out=spare)
        place[:3] -= spare

    def _chain(self, first: Floats, second: Floats, out: Floats) -> None:
        """Multiply quaternions: `second` is applied first."""
        spare = self._spare[:, : out.shape[1]]
        _cross(first[1:], second[1:], out[1:4], spare)
        np.multiply(second[1:4], first[0], out=spare)
        out[1:4] += spare
        np.multiply(first[1:4], second[0], out=spare)
        out[1:4] += spare
        out[4:] = out[1:3]
        np.multiply(first[1:4], second[1:4], out=spare)
        np.multiply(first[0], second[0], out=out[0])
        for row in spare:
            out[0] -= row

    def _join(self, translations: Floats, rotations: Floats) -> None:
        """Put the two sides together, and write the answers."""
        m = len(translations)
        up, down = self._up, self._down
        place, turn, square = up.place[:, :m], up.turn[:, :m], up.square[:m]
        if not down.empty:
            there, back = down.place[:, :m], down.turn[:, :m]
            factor = self._factor[:m]
            np.divide(2.0, down.square[:m], out=factor)
            np.negative(back[1:], out=back[1:])
            if up.empty:
                place, turn, square = there, back, down.square[:m]
                np.negative(place, out=place)
                self._rotate(back, factor, place)
            else:
                # The difference is turned, not the two ends: where they are equal, the
                # answer is zero to the last bit.
                np.subtract(place, there, out=place)
                self._rotate(back, factor, place)
                self._chain(back, turn, up.spare_turn[:, :m])
                turn = up.spare_turn[:, :m]
                np.multiply(square, down.square[:m], out=square)
        translations.T[:] = place[:3]
        scale = self._factor[:m]
        np.sqrt(square, out=scale)
        np.divide(1.0, scale, out=scale)
        np.copysign(scale, self._lead(turn, square), out=scale)
        np.multiply(turn[1:4], scale, out=rotations.T[:3])
        np.multiply(turn[0], scale, out=rotations.T[3])

    def _lead(self, turn: Floats, square: Floats) -> Floats:
        """The number whose sign tf2 makes positive; see `quaternions.canonical`."""
        m = len(square)
        mask, small = self._later[:m], self._bend[:m]
        np.multiply(turn[0], turn[0], out=small)
        np.multiply(square, 0.25, out=square)
        np.less_equal(small, square, out=mask)
        if not mask.any():
            w: Floats = turn[0]
            return w
        size, lead = self._spare[:, :m], self._share[:m]
        np.abs(turn[1:4], out=size)
        np.copyto(lead, turn[0])
        np.copyto(lead, turn[1], where=mask)
        second = size[1] > size[0]
        np.maximum(size[0], size[1], out=size[0])
        third = size[2] > size[0]
        np.copyto(lead, turn[2], where=mask & second)
        np.copyto(lead, turn[3], where=mask & third)
        return lead


def _cross(first: Floats, second: Floats, out: Floats, spare: Floats) -> None:
    """Write the cross products of two stacks of vectors."""
    np.multiply(first[1:4], second[2:5], out=out)
    np.multiply(first[2:5], second[1:4], out=spare)
    out -= spare
