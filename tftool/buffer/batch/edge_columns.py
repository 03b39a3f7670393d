"""Samples of a frame as columns in numpy, and the search for times among their stamps."""

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import whole
from tftool.buffer import refusals
from tftool.buffer.batch.transform_array import SampleColumns
from tftool.buffer.forest import Frame, FrameTree
from tftool.buffer.history import AUTHORITY_SHIFT, PARENT_MASK, WORDS, History, Link, Sample
from tftool.geometry.rigid_arrays import Floats

Stamps = npt.NDArray[np.int64]
"""Nanoseconds, shape (n,)."""

Indices = npt.NDArray[np.intp]
"""Indices of samples or of rows, shape (n,)."""

# If a bucket has more samples than this, the stamps are searched by bisection instead.
_MOST_STEPS = 3


class Column:
    """Samples that a moving edge had when the lookup began, oldest first.

    While this object exists, the records do not change; see `History.columns`.

    Attributes:
        records: Samples in memory order, shape (k, 8); see `history`.
        stamps: Nanoseconds, shape (k,); a copy made at the first use.
        samples: x, y, z and a unit quaternion x, y, z, w, shape (k, 7); a copy made at the first
            use.
        origin: Parent and authority of the newest sample in one integer; see module `history`.
        origins: Parent and authority of each sample, one integer per sample, shape (k,). None if
            all samples have the same parent and authority.
        parents: Number of the parent frame of each sample; None if all samples have one parent.
    """

    __slots__ = ("_samples", "_stamps", "origin", "origins", "parents", "records")

    def __init__(self, history: History) -> None:
        # A snapshot: while this exists, the history copies its records before it changes them.
        flat, origins, self.origin = history.columns()
        self.records: npt.NDArray[np.int64] = np.frombuffer(flat, dtype=np.int64).reshape(-1, WORDS)
        self._stamps: Stamps | None = None
        self._samples: Floats | None = None
        self.origins = None if origins is None else np.frombuffer(origins, dtype=np.int64)
        self.parents: npt.NDArray[np.int32] | None = None
        if self.origins is not None:
            parents = (self.origins & PARENT_MASK).astype(np.int32)
            # Origins may differ only in the authority; only a change of the parent changes a path.
            if len(parents) and (parents != parents[-1]).any():
                self.parents = parents

    def __len__(self) -> int:
        return len(self.records)

    @property
    def stamps(self) -> Stamps:
        """Stamps of all samples, nanoseconds, shape (k,)."""
        if self._stamps is None:
            self._stamps = np.ascontiguousarray(self.records[:, 0])
        return self._stamps

    @property
    def samples(self) -> Floats:
        """Positions and unit quaternions of all samples, shape (k, 7)."""
        if self._samples is None:
            self._samples = np.ascontiguousarray(self.records.view(np.float64)[:, 1:])
        return self._samples

    @property
    def oldest(self) -> int:
        """Return the oldest stamp; without samples, a value later than every stamp."""
        return int(self.records[0, 0]) if len(self.records) else 2**63 - 1

    @property
    def newest(self) -> int:
        """Return the newest stamp; without samples, a value earlier than every stamp."""
        return int(self.records[-1, 0]) if len(self.records) else -(2**63)

    def changes(self) -> Stamps:
        """Return the oldest and the newest stamp, and the stamps at which the parent changes."""
        ends = self.stamps[[0, -1]] if len(self.stamps) else self.stamps
        if self.parents is None:
            return ends
        changed = np.flatnonzero(self.parents[1:] != self.parents[:-1]) + 1
        return np.concatenate((ends, self.stamps[changed]))


class Columns:
    """Samples of the edges that a batch lookup uses; each edge is copied once."""

    __slots__ = ("_held",)

    def __init__(self) -> None:
        # The edge is stored too: its `id` is unique only while the edge exists.
        self._held: dict[int, tuple[Link, Column | Sample | None]] = {}

    def of(self, link: Link) -> "Column | Sample | None":
        """Return the samples of a moving edge, or the only sample of a static edge."""
        held = self._held.get(id(link))
        if held is None:
            held = (link, Column(link) if isinstance(link, History) else link.newest)
            self._held[id(link)] = held
        return held[1]


def samples(tree: FrameTree, frame: Frame) -> SampleColumns:
    """Return all samples of one frame; see `Buffer.samples`."""
    link = frame.link
    is_static = link is not None and link.is_static
    stamps: Stamps = np.zeros(0, dtype=np.int64)
    poses: Floats = np.zeros((0, 7))
    origins: npt.NDArray[np.int64] = np.zeros(0, dtype=np.int64)
    if isinstance(link, History):
        column = Column(link)
        stamps, poses = column.stamps, column.samples
        if column.origins is None:
            origins = np.full(len(stamps), column.origin, dtype=np.int64)
        else:
            origins = column.origins
    elif link is not None and link.newest is not None:
        stamps, poses = np.zeros(1, dtype=np.int64), np.array([link.newest])
        origins = np.array([link.origin], dtype=np.int64)
    # Look up names once for each distinct sender, not for each sample.
    numbers, kind = np.unique(origins, return_inverse=True)
    parents = [tree.frames[number & PARENT_MASK].name for number in numbers.tolist()]
    authorities = [tree.authorities[number >> AUTHORITY_SHIFT] for number in numbers.tolist()]
    columns = (
        stamps,
        np.array(parents, dtype=np.object_)[kind],
        poses,
        np.array(authorities, dtype=np.object_)[kind],
    )
    for array in columns:
        # Users get read-only arrays, because writing into a copy would not change the buffer.
        array.flags.writeable = False
    return SampleColumns(frame.name, is_static, *columns)


def stamps_of(times: npt.ArrayLike, name: str) -> Stamps:
    """Return times as a contiguous, aligned int64 array, from any integer type.

    Args:
        times: Shape (n,).
        name: Name of the times in an error message.

    Raises:
        TypeError: If the times are not whole numbers.
        ValueError: If the shape is not (n,), or a time does not fit into 64 bits.
    """
    given = np.asarray(times)
    if given.ndim == 0:
        raise ValueError(
            f"{name} must have the shape (n,), not (): write a single time as a list, [{given}]"
        )
    if given.ndim != 1:
        raise ValueError(f"{name} must have the shape (n,), not {given.shape}")
    if given.size == 0:
        return np.zeros(0, dtype=np.int64)
    kind = given.dtype.kind
    if kind == "O":
        # Python integers of any size; `whole` refuses True and 1.5.
        wholes = [whole(time) for time in given]
        unfit = [time for time in wholes if not refusals.fits(time)]
        if unfit:
            raise ValueError(f"{name} contain {unfit[0]} ns, which does not fit 64 bits")
        return np.array(wholes, dtype=np.int64)
    if kind == "u" and given.max() >= 2**63:
        raise ValueError(f"{name} contain {given.max()} ns, which does not fit 64 bits")
    if kind not in "iu":
        remedy = {
            "f": f"np.rint({name} * 1e9).astype(np.int64) converts seconds",
            "M": f"{name}.astype('datetime64[ns]').astype(np.int64) converts dates",
        }.get(kind, "write seconds(2.5) for 2.5 seconds")
        raise TypeError(f"{name} must be whole nanoseconds (int64), not {given.dtype}: {remedy}")
    # Align the array too: rows in a file's bytes may begin at any address.
    return np.require(given, np.int64, ["C", "A"])


class Buckets:
    """Index that divides the time from the first to the last sample into short, equal buckets.

    For times in random order, two loads and a comparison per time replace a binary search. A
    bucket spans a power of two of nanoseconds and at most half the mean time between samples,
    so that one comparison is nearly always enough.
    """

    __slots__ = ("_before", "_next", "_oldest", "_shift", "_stamps", "_steps")

    def __init__(self, stamps: Stamps) -> None:
        self._stamps = stamps
        self._oldest = int(stamps[0])
        # A bucket spans a power of two, so that a shift finds it without a division.
        span = int(stamps[-1]) - self._oldest
        self._shift = max((span // (2 * len(stamps))).bit_length() - 1, 0)
        count = (span >> self._shift) + 1
        starts = self._oldest + (np.arange(count, dtype=np.int64) << self._shift)
        before = np.searchsorted(stamps, starts, "right") - 1
        self._before: Indices = before
        after = np.append(before[1:], len(stamps) - 1)
        self._steps = int((after - before).max())
        # For each sample the stamp of the next sample; the last has no next sample.
        self._next: Stamps = np.append(stamps[1:], np.int64(2**63 - 1))

    def find(
        self, times: Stamps, index: Indices, spare: Stamps, later: npt.NDArray[np.bool_]
    ) -> None:
        """Write the index of the last sample at or before each time into `index`.

        The times may be in any order. `spare` and `later` are work arrays of shape (n,).
        """
        # If samples come in bursts, some buckets are full, and a binary search is faster.
        if self._steps > _MOST_STEPS:
            index[:] = np.searchsorted(self._stamps, times, "right") - 1
            return
        np.subtract(times, self._oldest, out=spare)
        np.right_shift(spare, self._shift, out=spare)
        np.take(self._before, spare, out=index, mode="clip")
        for _ in range(self._steps):
            np.take(self._next, index, out=spare, mode="clip")
            np.less_equal(spare, times, out=later)
            np.add(index, later, out=index)


def find_sorted(stamps: Stamps, times: Stamps, index: Indices) -> None:
    """Write the index of the last sample at or before each time into `index`, for sorted times.

    With fewer samples than times, it is faster to search each sample's place among the times.
    """
    first, last = (stamps.searchsorted(times[[0, -1]], "right") - 1).tolist()
    if last - first > len(times):
        np.subtract(np.searchsorted(stamps[first : last + 1], times, "right"), 1 - first, out=index)
        return
    # Count the samples up to each time. `repeat` could do it, but would hold the GIL.
    index.fill(0)
    np.add.at(index, times.searchsorted(stamps[first + 1 : last + 1], "left"), 1)
    index[0] += first
    np.add.accumulate(index, 0, None, index)


def settle_oldest(column: Column, times: Stamps, index: Indices) -> None:
    """Correct `index` for times equal to the oldest stamp, as in tf2.

    Of several samples with the oldest stamp, tf2 uses the sample that was inserted first.
    """
    stamps = column.stamps
    if len(stamps) > 2 and stamps[0] == stamps[1] and stamps[0] != stamps[-1]:
        index[times == stamps[0]] = 0
