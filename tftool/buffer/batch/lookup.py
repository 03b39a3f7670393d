"""Batch lookup of transforms, native or in numpy, for `Buffer.lookup_transforms`."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import numpy.typing as npt

from tftool.base.errors import TransformException
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.buffer.batch import chain_arithmetic as kernel
from tftool.buffer.batch.edge_columns import Column, Columns, Indices, Stamps, stamps_of
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.forest import ARRIVED, FrameTree
from tftool.buffer.history import History, Link, Sample, StaticLink
from tftool.buffer.native_kernel import IS_NATIVE
from tftool.buffer.solver import Path, Solver, path_of
from tftool.geometry.rigid_arrays import Floats

if IS_NATIVE:
    from tftool.buffer import _kernel

CHUNK = 1 << 16
"""Rows per chunk; a batch's temporary memory grows with it."""

SECTION = 1 << 18
"""Rows per chunk for long histories, for which unsorted times are sorted first."""

# With shorter blocks, threads mostly wait for each other.
_LEAST_BLOCK = 1 << 11

# With fewer rows, a second thread costs more time than it saves.
_WORTH_A_THREAD = CHUNK

# Rows of a lookup with two times whose halves are in memory at the same time.
_TOGETHER = CHUNK


def lookup_transforms(
    tree: FrameTree,
    solver: Solver,
    target: str,
    source: str,
    times: npt.ArrayLike,
    missing: str = "raise",
    threads: int | None = None,
) -> TransformArray:
    """Return the poses of source in target at many times; see `Buffer.lookup_transforms`."""
    if missing not in ("raise", "nan"):
        raise ValueError(f"missing must be 'raise' or 'nan', not {missing!r}")
    workers = _workers(threads)
    stamps = stamps_of(times, "times")
    # Like tf2: the identity, with the requested stamp.
    if target == source:
        return _identities(tree, target, stamps)
    numbers = (
        solver.number(target, "target_frame", "lookupTransform", target, source),
        solver.number(source, "source_frame", "lookupTransform", target, source),
    )
    batch = _Batch(tree, numbers, stamps, lambda time: solver.pose(target, source, time))
    batch.run(missing == "raise", workers if len(stamps) >= _WORTH_A_THREAD else 1)
    return TransformArray(
        target, source, batch.stamps, batch.translations, batch.rotations, batch.valid
    )


def lookup_transforms_full(
    tree: FrameTree,
    solver: Solver,
    target: str,
    target_times: npt.ArrayLike,
    source: str,
    source_times: npt.ArrayLike,
    fixed: str,
    missing: str = "raise",
    threads: int | None = None,
) -> TransformArray:
    """Return poses computed through a fixed frame; see `Buffer.lookup_transforms_full`."""
    if missing not in ("raise", "nan"):
        raise ValueError(f"missing must be 'raise' or 'nan', not {missing!r}")
    for frame, argument in (
        (target, "target_frame"),
        (source, "source_frame"),
        (fixed, "fixed_frame"),
    ):
        solver.number(frame, argument, "lookupTransform", target, source)
    theirs, ours = _paired(target_times, source_times)
    n = len(theirs)
    found = TransformArray(
        target,
        source,
        np.empty(n, dtype=np.int64),
        np.empty((n, 3)),
        np.empty((n, 4)),
        np.empty(n, dtype=np.bool_),
    )
    for start in range(0, n, _TOGETHER):
        rows = slice(start, start + _TOGETHER)
        fixed_from_source = lookup_transforms(
            tree, solver, fixed, source, ours[rows], "nan", threads
        )
        # Each half has its own stamps; the fixed frame joins the halves.
        target_from_fixed = lookup_transforms(
            tree, solver, target, fixed, theirs[rows], "nan", threads
        )
        some = target_from_fixed @ fixed_from_source
        found.stamps[rows] = some.stamps
        found.translations[rows] = some.translations
        found.rotations[rows] = some.rotations
        found.valid[rows] = some.valid
        if missing == "raise":
            for row in (start + np.flatnonzero(~some.valid)).tolist():
                # One of these two single lookups fails, and raises the error in tf2's words.
                solver.pose(fixed, source, int(ours[row]))
                solver.pose(target, fixed, int(theirs[row]))
    return found


class _Batch:
    """A batch lookup in progress: its inputs and the results so far."""

    def __init__(
        self,
        tree: FrameTree,
        numbers: tuple[int, int],
        times: Stamps,
        ask: Callable[[Stamp], tuple[Stamp, Sample]],
    ) -> None:
        self.tree = tree
        self.target, self.source = numbers
        self.times = times
        self.ask = ask
        self.columns = Columns()
        # If no link of the chain ever changes its parent, one path is valid at every time.
        self.path = _steady_path(tree, self.target, self.source)
        # The span in which every link of the path has data; narrowed below.
        self.first, self.last = -(2**63), 2**63 - 1
        # Whether unsorted times are sorted first: long histories do not fit into a cache.
        self.sorts = False
        for link in self.path.moving if self.path else ():
            column = self.columns.of(link)
            assert isinstance(column, Column)
            self.first = max(self.first, column.oldest)
            self.last = min(self.last, column.newest)
            if len(column) > kernel.MOST_INTERVALS:
                self.sorts = True
        self.rows_at_once = SECTION if self.sorts else CHUNK
        # For sorted times the intervals are computed for each block, which needs memory too.
        self.block = kernel.BLOCK // 2 if self.sorts else kernel.BLOCK
        # By the link's id: a link that is on both sides is prepared once.
        self.ready: dict[int, kernel.Edge] = {}
        self.rooms: list[Floats] = []
        self.latest: tuple[Stamp, Sample] | TransformException | None = None
        n = len(times)
        self.stamps = np.empty(n, dtype=np.int64)
        self.translations = np.empty((n, 3))
        self.rotations = np.empty((n, 4))
        self.valid = np.empty(n, dtype=np.bool_)

    def run(self, complete: bool, workers: int) -> None:
        """Look up all times; if `complete`, raise the error of the first time without a result."""
        n = len(self.times)
        # More than two threads share the memory that two threads use.
        crowd = max(workers / 2, 1)
        self.block = max(int(self.block / crowd), _LEAST_BLOCK)
        most = max(int(self.rows_at_once / crowd), self.block)
        # Chunks of equal size, so that all threads have the same amount of work.
        pieces = -(-n // (most * workers)) * workers
        self.rows_at_once = -(-n // pieces) if pieces else 1
        starts = range(0, n, self.rows_at_once)
        if workers == 1:
            for start in starts:
                self.fill(start, complete)
            return
        # Chunks write to disjoint rows, so the threads share no lock. numpy and the kernel drop the
        # GIL.
        with ThreadPoolExecutor(workers) as pool:
            try:
                for _ in pool.map(lambda start: self.fill(start, complete), starts):
                    pass
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise

    def fill(self, start: int, complete: bool) -> None:
        """Look up one chunk of times, beginning with row `start`; for `complete`, see `run`."""
        rows = slice(start, start + self.rows_at_once)
        times = self.times[rows]
        self.stamps[rows] = times
        missing = None
        if IS_NATIVE and self.path is not None and self.first <= self.last:
            missing = self.solve_natively(self.path, times, rows)
        if missing is not None:
            # Every row has a result: the usual case.
            if missing == 0:
                return
            # Rows with time 0 request the latest common time, which is not a time on the path.
            rest = np.flatnonzero(~self.valid[rows] & (times != 0))
        else:
            if self.path is not None and self.has_all(times):
                self.solve(self.path, rows)
                return
            rest = self.begin(times, start)
        if len(rest):
            moments = times[rest]
            # The tree had other shapes at these times: each shape has its own path.
            for path, chosen in _paths_by_moment(
                self.tree, self.columns, self.target, self.source, moments
            ):
                held = _covered(path, self.columns, moments[chosen])
                self.solve(path, start + rest[chosen[held]])
        self.fill_latest(start + np.flatnonzero(times == 0))
        if complete:
            for row in (start + np.flatnonzero(~self.valid[rows])).tolist():
                # The single lookup raises an error in tf2's words; if it succeeds after all, its
                # result is used.
                self.put(row, self.ask(int(self.times[row])))

    def begin(self, times: Stamps, start: int) -> Indices:
        """Solve the rows for which `self.path` has data; return the indices of the other rows."""
        rows = slice(start, start + len(times))
        usable = (times >= self.first) & (times <= self.last) & (times != 0)
        self.valid[rows] = False
        self.translations[rows] = np.nan
        self.rotations[rows] = np.nan
        rest = np.flatnonzero(times != 0)
        if self.path is not None:
            self.solve(self.path, start + np.flatnonzero(usable))
            rest = np.flatnonzero(~usable & (times != 0))
        return rest

    def has_all(self, times: Stamps) -> bool:
        """Whether `self.path` has data at all these times, and no time is 0 (latest)."""
        least, most = int(times.min()), int(times.max())
        return self.first <= least and most <= self.last and (least > 0 or bool(times.all()))

    def solve(self, path: Path, rows: "slice | Indices") -> None:
        """Solve rows with a path that has data at the times of all these rows."""
        times = self.times[rows]
        if not len(times):
            return
        if IS_NATIVE and self.solve_natively(path, times, rows) is not None:
            return
        up, down = self.edges(path.up), self.edges(path.down)
        in_order = bool(np.all(times[1:] >= times[:-1]))
        if self.sorts and not in_order:
            # Consecutive times then use neighbouring samples, which are in the cache.
            order = np.argsort(times)
            rows = order + rows.start if isinstance(rows, slice) else rows[order]
            times, in_order = times[order], True
        room = self.room()
        arrays = None
        for part in kernel.blocks(len(times), self.block):
            block = times[part]
            if arrays is None or arrays.count != len(block):
                arrays = kernel.BlockArrays(room, len(block))
            if isinstance(rows, slice):
                here = slice(rows.start + part.start, rows.start + part.stop)
                translations, rotations = self.translations[here], self.rotations[here]
                arrays.solve(up, down, block, in_order, translations, rotations)
            else:
                # Scattered rows are solved together, then written to their places.
                translations, rotations = np.empty((len(block), 3)), np.empty((len(block), 4))
                arrays.solve(up, down, block, in_order, translations, rotations)
                self.translations[rows[part]] = translations
                self.rotations[rows[part]] = rotations
        self.valid[rows] = True
        self.rooms.append(room)

    def solve_natively(self, path: Path, times: Stamps, rows: "slice | Indices") -> int | None:
        """Solve rows with one path in the C kernel; rows without data become NaN.

        Returns:
            Number of rows without data; None if the kernel cannot solve this path at all.
        """
        up, down = self.held(path.up), self.held(path.down)
        if isinstance(rows, slice):
            place, turn, valid = self.translations[rows], self.rotations[rows], self.valid[rows]
            return _kernel.solve(up, down, times, place, turn, valid)
        n = len(times)
        place, turn, valid = np.empty((n, 3)), np.empty((n, 4)), np.empty(n, dtype=np.bool_)
        missing = _kernel.solve(up, down, np.ascontiguousarray(times), place, turn, valid)
        if missing is not None:
            self.translations[rows], self.rotations[rows], self.valid[rows] = place, turn, valid
        return missing

    def held(self, links: Iterable[Link]) -> tuple[Link, ...]:
        """Return copies of links; the samples of the copies stay unchanged until the batch ends."""
        found: list[Link] = []
        for link in links:
            held = self.columns.of(link)
            if isinstance(held, Column):
                # The kernel reads this copy; the live history may grow or be pruned meanwhile.
                copy = History(LAST_STAMP)
                copy.borrow(held.records.reshape(-1).data, held.origin)
                copy.mixed = held.parents is not None
                found.append(copy)
            else:
                assert held is not None
                x, y, z, qx, qy, qz, qw = map(float, held)
                found.append(StaticLink((x, y, z, qx, qy, qz, qw)))
        return tuple(found)

    def room(self) -> Floats:
        """Return work arrays that no other thread is using."""
        try:
            # `pop` of a list is atomic: no two threads get the same arrays.
            return self.rooms.pop()
        except IndexError:
            return kernel.room(min(len(self.times), self.block))

    def edges(self, links: Iterable[Link]) -> list[kernel.Edge]:
        """Return the links with precomputed tables for the arithmetic in numpy."""
        ready: list[kernel.Edge] = []
        for link in links:
            edge = self.ready.get(id(link))
            if edge is None:
                held = self.columns.of(link)
                assert held is not None
                edge = (
                    kernel.MovingEdge(held, len(self.times))
                    if isinstance(held, Column)
                    else kernel.StaticEdge(held)
                )
                self.ready[id(link)] = edge
            ready.append(edge)
        return ready

    def fill_latest(self, rows: Indices) -> None:
        """Write the latest pose into the rows `rows`, whose time is 0."""
        if not len(rows):
            return
        if self.latest is None:
            try:
                self.latest = self.ask(0)
            except TransformException as refused:
                self.latest = refused
        if not isinstance(self.latest, TransformException):
            self.put(rows, self.latest)

    def put(self, rows: "Indices | int", answer: tuple[Stamp, Sample]) -> None:
        """Write one result (time and pose) into one or more rows of the output."""
        stamp, sample = answer
        self.stamps[rows] = stamp
        self.translations[rows] = sample[:3]
        self.rotations[rows] = sample[3:]
        self.valid[rows] = True


def _steady_path(tree: FrameTree, target: int, source: int) -> Path | None:
    """Return the path between two frames; None if the path depends on the time."""
    walk = tree.walk(target, source, 0)
    if walk.ended != ARRIVED or not tree.is_steady(walk):
        return None
    return path_of(tree, walk)


def _paths_by_moment(
    tree: FrameTree, columns: Columns, target: int, source: int, times: Stamps
) -> Iterator[tuple[Path, Indices]]:
    """Yield the paths that are valid at some of the times, each with the indices of these times.

    A path changes when the samples of a frame begin, end, or get another parent. All times between
    two changes share one path. Times without a path are left out.
    """
    # Between two marks no link changes, so one walk finds the path for all times there.
    marks = _marks(tree, columns, (target, source))
    # Odd numbers are marks; even numbers are the spans between two marks.
    interval = np.searchsorted(marks, times, "left") + np.searchsorted(marks, times, "right")
    found, first, member = np.unique(interval, return_index=True, return_inverse=True)
    paths: dict[tuple[tuple[int, ...], tuple[int, ...]], Path] = {}
    serves = np.full(len(found), -1)
    for at, row in enumerate(first.tolist()):
        walk = tree.walk(target, source, int(times[row]))
        if walk.ended != ARRIVED:
            continue
        key = (tuple(walk.up), tuple(walk.down))
        if key not in paths:
            paths[key] = path_of(tree, walk)
        serves[at] = list(paths).index(key)
    serving = serves[member]
    for at, path in enumerate(paths.values()):
        yield path, np.flatnonzero(serving == at)


def _covered(path: Path, columns: Columns, times: Stamps) -> npt.NDArray[np.bool_]:
    """Return a mask of the times at which every edge of a path has data."""
    result = np.ones(len(times), dtype=np.bool_)
    for link in path.moving:
        column = columns.of(link)
        assert isinstance(column, Column)
        result &= (times >= column.oldest) & (times <= column.newest)
    return result


def _marks(tree: FrameTree, columns: Columns, frames: tuple[int, ...]) -> Stamps:
    """Return all stamps at which the path from one of the frames up to its root can change."""
    marks: list[Stamps] = [np.zeros(0, dtype=np.int64)]
    waiting, seen = list(frames), set(frames)
    while waiting:
        link = tree.frames[waiting.pop()].link
        if link is None:
            continue
        column = columns.of(link)
        above = {link.parent}
        if isinstance(column, Column):
            marks.append(column.changes())
            # A link with several parents leads to several frames, and each may add marks.
            if column.parents is not None:
                above.update(np.unique(column.parents).tolist())
        above -= seen
        seen |= above
        waiting.extend(number for number in above if number >= 0)
    return np.unique(np.concatenate(marks))


def _identities(tree: FrameTree, frame: str, times: Stamps) -> TransformArray:
    """Return the pose of a frame (even an unknown one) in itself for each time: the identity."""
    number = tree.numbers.get(frame)
    newest = 0 if number is None else tree.newest_stamp(number)
    n = len(times)
    rotations = np.zeros((n, 4))
    rotations[:, 3] = 1.0
    return TransformArray(
        frame,
        frame,
        np.where(times == 0, newest, times),
        np.zeros((n, 3)),
        rotations,
        np.ones(n, dtype=np.bool_),
    )


def _paired(target_times: npt.ArrayLike, source_times: npt.ArrayLike) -> tuple[Stamps, Stamps]:
    """Return both arrays of times with equal lengths: a single time is repeated for all rows."""
    theirs, ours = np.asarray(target_times), np.asarray(source_times)
    if theirs.ndim == 0 and ours.ndim == 1:
        theirs = np.broadcast_to(theirs, ours.shape)
    elif ours.ndim == 0 and theirs.ndim == 1:
        ours = np.broadcast_to(ours, theirs.shape)
    target_stamps = stamps_of(theirs, "target_times")
    source_stamps = stamps_of(ours, "source_times")
    if len(target_stamps) != len(source_stamps):
        raise ValueError(
            f"there are {len(target_stamps)} target_times, but {len(source_stamps)} source_times: "
            "give equal numbers of both, or a single time"
        )
    return target_stamps, source_stamps


def _workers(threads: int | None) -> int:
    """Return `threads`, or the number of available processor cores if `threads` is None."""
    if threads is None:
        # The number of cores that this process may use, if known; the machine may have more.
        allowed = getattr(os, "sched_getaffinity", None)
        return len(allowed(0)) if allowed else os.cpu_count() or 1
    if threads < 1:
        raise ValueError(f"threads must be 1 or more, not {threads}")
    return threads
