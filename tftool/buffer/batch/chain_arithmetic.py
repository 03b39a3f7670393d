"""Arithmetic of a batch lookup: products of the poses along one chain of frames at many times.

The arithmetic works on blocks of a few thousand times. Its arrays are allocated once and stay in
the processor's cache.
"""

from collections.abc import Iterator, Sequence
from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt
from numpy import add, copyto, divide, multiply, subtract

from tftool.buffer.batch.edge_columns import (
    Buckets,
    Column,
    Indices,
    Stamps,
    find_sorted,
    settle_oldest,
)
from tftool.buffer.history import Sample
from tftool.geometry import soa
from tftool.geometry.quaternions import ROUNDING
from tftool.geometry.rigid_arrays import Floats
from tftool.geometry.soa import QuaternionRows, VectorRows, chain, rotate, tan_ratio

BLOCK = 1 << 15
"""Number of times in a block, which are solved together. Larger blocks do not fit into the
processor's cache; with smaller blocks threads wait for each other, because only one can run Python
between two operations.
"""

GROUP = 6
"""Number of edges whose fractions are computed together, in fewer and longer operations."""

# Histories up to this length get one table of all intervals, which needs 136 bytes each.
MOST_INTERVALS = 1 << 16


T = TypeVar("T", np.int64, np.float64)

# Columns of w, x, y and z in a sample.
_WXYZ = [6, 3, 4, 5]


class Intervals:
    """Intervals between neighbouring samples of one frame, with precomputed numbers to interpolate
    its poses.

    At the fraction f of an interval the position is P + f·D, and the rotation is computed as in
    `soa.Arcs`. Quaternions are in wxyz order. Each row has four numbers because loading 32 bytes
    costs as much as loading 8.

    Attributes:
        stamps: Start of each interval, nanoseconds, int64, shape (k,).
        lengths: Length of each interval, nanoseconds, shape (k,); infinite where the older sample
            is used unchanged, such as after the last sample.
        half_angle_squared: θ² of the arcs, shape (k,).
        places: P in metres, shape (k, 4); column 3 is unused.
        paths: D in metres, shape (k, 4); column 3 is unused.
        starts: A of the arcs, shape (k, 4).
        directions: C of the arcs, shape (k, 4).
        endless: Whether the position of some sample contains an infinite number.
        row_by_row: Whether there is one interval per requested time, in the same order.
        terms: Number of terms of the series of tan(x)/x for the largest θ; 0 if the series would be
            too long.
    """

    __slots__ = (
        "directions",
        "endless",
        "half_angle_squared",
        "lengths",
        "paths",
        "places",
        "row_by_row",
        "stamps",
        "starts",
        "terms",
    )

    def __init__(self, column: Column, first: npt.NDArray[np.intp] | slice) -> None:
        """Compute the intervals that begin at some samples of an edge.

        Args:
            column: The samples of the edge.
            first: Row of the first sample of each interval. An infinite interval follows the last
                sample.
        """
        last = len(column.stamps) - 1
        self.row_by_row = not isinstance(first, slice)
        if isinstance(first, slice):
            # All intervals of the column: computed once, then gathered by index for each time.
            first = np.arange(first.start, first.stop)
        second = np.minimum(first + 1, last)
        begin, end = column.samples.take(first, axis=0), column.samples.take(second, axis=0)
        self.stamps: Stamps = column.stamps[first]
        length = (column.stamps[second] - self.stamps).astype(np.float64)
        still = length == 0.0
        if column.parents is not None:
            # Samples with different parents are not interpolated: the older one is valid.
            still |= column.parents[first] != column.parents[second]
        k = len(first)
        self.places: Floats = np.zeros((k, 4))
        self.paths: Floats = np.zeros((k, 4))
        self.places[:, :3] = begin[:, :3]
        # An infinite length makes every fraction 0, which returns the older sample itself.
        self.lengths: Floats = np.where(still, np.inf, length)
        np.subtract(end[:, :3], begin[:, :3], out=self.paths[:, :3])
        self.paths[still] = 0.0
        self.endless = not np.isfinite(self.paths[:, :3]).all()
        self.starts: Floats = begin[:, _WXYZ]
        arcs = soa.arcs(self.starts, end[:, _WXYZ])
        self.directions = arcs.directions
        self.half_angle_squared = arcs.half_angle_squared
        self.terms = arcs.terms

    def fetch(
        self, table: npt.NDArray[T], index: npt.NDArray[np.intp], out: npt.NDArray[T]
    ) -> None:
        """Copy, for each time, the row of `table` for the time's interval into `out`.

        Args:
            table: Array with one row per interval, shape (k,) or (k, 4).
            index: The interval of each time, shape (n,).
            out: Output, shape (n,) or (n, 4).
        """
        if self.row_by_row:
            np.copyto(out, table)
        else:
            table.take(index, 0, out, "clip")


class MovingEdge:
    """A moving edge (frame and its parent), with precomputed tables for a batch lookup."""

    __slots__ = ("_buckets", "column", "intervals")

    def __init__(self, column: Column, count: int) -> None:
        """Precompute the tables that make a lookup at `count` stamps faster."""
        self.column = column
        k = len(column.stamps)
        self.intervals = (
            Intervals(column, slice(0, k)) if 0 < k <= min(count, MOST_INTERVALS) else None
        )
        self._buckets: Buckets | None = None

    @property
    def buckets(self) -> Buckets:
        """Index to find samples by stamp, built when a block of unsorted times first occurs."""
        if self._buckets is None:
            self._buckets = Buckets(self.column.stamps)
        return self._buckets


class StaticEdge:
    """A static edge for a batch lookup: one pose as a column, valid at every time."""

    __slots__ = ("place", "turn")

    def __init__(self, sample: Sample) -> None:
        x, y, z, qx, qy, qz, qw = sample
        self.place: Floats = np.array([[x], [y], [z]])
        self.turn = QuaternionRows(np.array([[qw], [qx], [qy], [qz], [qx], [qy]]))


Edge: TypeAlias = "MovingEdge | StaticEdge"


class _RowAllocator:
    """Allocator that returns consecutive rows of one array of working memory."""

    def __init__(self, room: Floats, count: int) -> None:
        self._rows = room[: ROWS * count].reshape(ROWS, count)
        self._taken = 0

    def __call__(self, number: int) -> Floats:
        """Return the next `number` unused rows, with one column for each time."""
        self._taken += number
        return self._rows[self._taken - number : self._taken]


class _Side:
    """Product of the poses on one side of a chain: from source or target to their ancestor."""

    __slots__ = ("empty", "place", "turn", "unused")

    def __init__(self, rows: _RowAllocator) -> None:
        self.empty = True
        self.place = VectorRows(rows(5))
        # Quaternions that are not scaled to unit length yet.
        self.turn, self.unused = QuaternionRows(rows(6)), QuaternionRows(rows(6))


ROWS = 54 + 4 * GROUP
"""Number of doubles of working memory for each time of a block."""


# Doubles in one cache line of the processor.
_LINE = 8


def blocks(count: int, most: int) -> Iterator[slice]:
    """Yield slices that divide `count` times into equal blocks of at most `most` times."""
    # Equal blocks, because a short last block costs as many numpy calls as a full one.
    size = -(-count // -(-count // most))
    # Rows of whole cache lines: loads that cross two lines are slower.
    size += -size % _LINE
    for start in range(0, count, size):
        yield slice(start, min(start + size, count))


def room(count: int) -> Floats:
    """Allocate working memory for blocks of at most `count` times.

    The memory is one array, because the system puts a large array on large pages, which are faster.
    """
    numbers = np.empty(ROWS * (count + _LINE) + _LINE)
    address: int = numbers.__array_interface__["data"][0]
    return numbers[-address // 8 % _LINE :]


class BlockArrays:
    """Work arrays for one block of times, and the arithmetic of a chain on these arrays."""

    def __init__(self, room: Floats, count: int) -> None:
        """Divide the memory `room` into arrays for blocks of exactly `count` times."""
        self.count = count
        rows = _RowAllocator(room, count)
        self._flags = rows(1)[0].view(np.bool_)[:count]
        # For each edge of a group: the interval, and the fractions of translation and rotation.
        self._index = rows(GROUP).view(np.intp)[:, :count]
        self._shares, self._ratios = rows(GROUP), rows(GROUP)
        # First the square of half the rotation angle, then the factor for `rotate`.
        self._squares = rows(GROUP)
        self._whole: Stamps = self._squares.view(np.int64)
        # All edges share these rows: an edge's fetched samples are used before the next edge's.
        shared = rows(8)
        self._some, self._more = shared.reshape(2, count, 4)
        self._spare, self._cross = shared[:3], VectorRows(shared[3:])
        self._place, self._turn = VectorRows(rows(5)), QuaternionRows(rows(6))
        self._up, self._down = _Side(rows), _Side(rows)

    def solve(
        self,
        up: Sequence[Edge],
        down: Sequence[Edge],
        times: Stamps,
        in_order: bool,
        translations: Floats,
        rotations: Floats,
    ) -> None:
        """Write the pose of source in target for each time.

        Args:
            up: Edges from the source up to the common ancestor.
            down: Edges from the target up to the common ancestor.
            times: Nanoseconds at which every edge has data, shape (n,); n is the allocated number.
            in_order: Whether the times never decrease.
            translations: Output in metres, shape (n, 3).
            rotations: Output, unit quaternions in xyzw order, shape (n, 4).
        """
        # NaN and infinity are valid results here: each affects only the rows of its own times.
        with np.errstate(all="ignore"):
            self._climb(self._up, up, times, in_order)
            self._climb(self._down, down, times, in_order)
            self._join(translations, rotations)

    def _climb(self, side: _Side, edges: Sequence[Edge], times: Stamps, in_order: bool) -> None:
        """Write the product of the poses of `edges` at each time into the arrays of `side`."""
        side.empty = not edges
        # In groups: one numpy call serves several edges, as long as the arrays fit into the
        # cache.
        for start in range(0, len(edges), GROUP):
            group = edges[start : start + GROUP]
            moving = [edge for edge in group if isinstance(edge, MovingEdge)]
            prepared = iter(self._prepare(moving, times, in_order))
            for number, edge in enumerate(group, start):
                place, turn = (self._place, self._turn) if number else (side.place, side.turn)
                factor: Floats | float = 2.0
                if isinstance(edge, MovingEdge):
                    intervals, index, share, ratio, factor = next(prepared)
                    self._interpolate(intervals, index, share, ratio, place, turn)
                else:
                    copyto(place.xyz, edge.place)
                    copyto(turn.rows, edge.turn.rows)
                if number:
                    rotate(turn, factor, side.place, self._cross, self._spare)
                    add(side.place.xyz, place.xyz, side.place.xyz)
                    chain(turn, side.turn, side.unused, self._spare)
                    # Two arrays alternate, so that no product overwrites its own factor.
                    side.turn, side.unused = side.unused, side.turn
                side.place.close()

    def _prepare(
        self, edges: Sequence[MovingEdge], times: Stamps, in_order: bool
    ) -> list[tuple[Intervals, Indices, Floats, Floats, Floats]]:
        """Find the interval of each time in each edge, and the fractions for interpolation.

        Returns:
            For each edge, the intervals and four arrays with one item per time: index of the
            interval, fraction of the translation, fraction of the rotation, and factor for
            `rotate`.
        """
        count = len(edges)
        if not count:
            return []
        whole, shares = self._whole[:count], self._shares[:count]
        ratios, squares = self._ratios[:count], self._squares[:count]
        found = [
            self._find(edge, times, in_order, index)
            for edge, index in zip(edges, self._index, strict=False)
        ]
        for intervals, index, row in zip(found, self._index, whole, strict=False):
            intervals.fetch(intervals.stamps, index, row)
        subtract(times, whole, whole)
        copyto(shares, whole)
        for intervals, index, row in zip(found, self._index, squares, strict=False):
            intervals.fetch(intervals.lengths, index, row)
        divide(shares, squares, shares)
        for intervals, index, row in zip(found, self._index, squares, strict=False):
            intervals.fetch(intervals.half_angle_squared, index, row)
        multiply(squares, shares, squares)
        multiply(squares, shares, squares)
        terms = [intervals.terms for intervals in found]
        tan_ratio(squares, ratios, min(terms) and max(terms))
        # The squared lengths of quaternions whose vector part has the tangent as its length.
        multiply(squares, ratios, squares)
        multiply(squares, ratios, squares)
        add(squares, 1.0, squares)
        multiply(ratios, shares, ratios)
        divide(2.0, squares, squares)
        return list(zip(found, self._index, shares, ratios, squares, strict=False))

    def _find(self, edge: MovingEdge, times: Stamps, in_order: bool, index: Indices) -> Intervals:
        """Write the index of each time's interval into `index`; return the edge's intervals."""
        column = edge.column
        if in_order:
            find_sorted(column.stamps, times, index)
        else:
            edge.buckets.find(times, index, self._whole[0], self._flags)
        settle_oldest(column, times, index)
        if edge.intervals is not None:
            return edge.intervals
        if in_order:
            first, last = int(index[0]), int(index[-1])
            if last - first < len(index):
                subtract(index, first, index)
                return Intervals(column, slice(first, last + 1))
        return Intervals(column, index)

    def _interpolate(
        self,
        intervals: Intervals,
        index: Indices,
        fraction: Floats,
        turn_factor: Floats,
        place: VectorRows,
        turn: QuaternionRows,
    ) -> None:
        """Write the interpolated poses of an edge at all times into `place` and `turn`."""
        some, more = self._some, self._more
        intervals.fetch(intervals.places, index, some)
        intervals.fetch(intervals.paths, index, more)
        multiply(fraction, more.T[:3], place.xyz)
        add(place.xyz, some.T[:3], place.xyz)
        if intervals.endless:
            # Interpolation with infinity gives NaN, but at its own stamp a sample is valid.
            met = np.flatnonzero(fraction == 0.0)
            place.xyz[:, met] = some[met, :3].T
        intervals.fetch(intervals.starts, index, some)
        intervals.fetch(intervals.directions, index, more)
        multiply(turn_factor, more.T, turn.wxyz)
        add(turn.wxyz, some.T, turn.wxyz)
        turn.close()

    def _join(self, translations: Floats, rotations: Floats) -> None:
        """Combine the two sides of the chain, and write the poses into the output arrays."""
        up, down, scale = self._up, self._down, self._squares[0]
        place, turn = up.place, up.turn
        if not down.empty:
            back = down.turn
            back.conjugate()
            divide(2.0, self._square(back), scale)
            if up.empty:
                place, turn = down.place, back
                np.negative(place.xyz, place.xyz)
                place.close()
            else:
                # Rotate the difference of the two positions, not each position: where they
                # are equal, the result is exactly zero.
                subtract(place.xyz, down.place.xyz, place.xyz)
                place.close()
                chain(back, turn, up.unused, self._spare)
                turn = up.unused
            rotate(back, scale, place, self._cross, self._spare)
        copyto(translations.T, place.xyz)
        divide(1.0, np.sqrt(self._square(turn), scale), scale)
        multiply(turn.wxyz, scale, turn.wxyz)
        np.copysign(1.0, self._lead(turn), scale)
        multiply(turn.xyz, scale, rotations.T[:3])
        multiply(turn.w, scale, rotations.T[3])

    def _square(self, turn: QuaternionRows) -> Floats:
        """Return the squared lengths of quaternions, rounded to 1 if nearly 1."""
        square: Floats = self._shares[0]
        off, spare, near = self._ratios[0], self._spare, self._flags
        multiply(turn.xyz, turn.xyz, spare)
        multiply(turn.w, turn.w, off)
        # Add in the order of `quaternions.unit`, so that both skip the same quaternions.
        for part in (spare[1], spare[2], off):
            add(spare[0], part, spare[0])
        copyto(square, spare[0])
        subtract(square, 1.0, off)
        np.less(np.abs(off, off), ROUNDING, near)
        copyto(square, 1.0, where=near)
        return square

    def _lead(self, turn: QuaternionRows) -> Floats:
        """Return the component of each quaternion that must be positive in tf2's convention."""
        small, large, size = self._ratios[0], self._flags, self._spare
        lead: Floats = self._shares[0]
        multiply(turn.w, turn.w, small)
        np.less_equal(small, 0.25, large)
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
