"""Insertion of many samples of one child frame in numpy, for `Buffer.set_transforms`."""

from array import array
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.buffer import refusals
from tftool.buffer.batch.edge_columns import Column, Indices, Stamps, stamps_of
from tftool.buffer.forest import FrameTree, stripped
from tftool.buffer.history import (
    LONGEST,
    MOST_ALIKE,
    PARENT_MASK,
    SHORTEST,
    WORDS,
    History,
    Sample,
)
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.rigid_arrays import Floats

Flags: TypeAlias = npt.NDArray[np.bool_]
"""Mask with one boolean for each row, shape (n,)."""

MOST_LINES = 10
"""Number of rejected rows that are logged with their reasons; the others are only counted."""

_LEAST = -(2**63)

_BLOCK = 8192  # rows per chunk; a chunk fits into the processor's cache


@dataclass(frozen=True, slots=True, eq=False)
class Insertion:
    """Result of a bulk insertion, with the truth value True if every sample was accepted.

    Attributes:
        accepted: Whether each row was accepted, shape (n,). A row equal to a stored sample counts
            as accepted, as in `set_transform`.
        reasons: Indices of the rejected rows, by tf2's code for the reason (TF_NAN_INPUT,
            TF_OLD_DATA, …).
    """

    accepted: Flags
    reasons: dict[str, npt.NDArray[np.intp]]

    def __bool__(self) -> bool:
        return bool(self.accepted.all())

    def __len__(self) -> int:
        return len(self.accepted)

    @property
    def refused(self) -> npt.NDArray[np.intp]:
        """Return the indices of the rejected rows, in order."""
        return np.flatnonzero(~self.accepted)


class CheckedRows:
    """Samples of a bulk insertion, with the result of each row's check.

    Attributes:
        stamps: Nanoseconds, shape (n,).
        samples: Position and canonical unit quaternion, shape (n, 7).
        reasons: Mask of the rows with a fault, by tf2's code for the fault.
        validated: Mask of the valid rows.
    """

    def __init__(
        self,
        stamps: npt.ArrayLike,
        translations: npt.ArrayLike,
        rotations: npt.ArrayLike,
        names: tuple[str, str, str],
    ) -> None:
        """Check the rows of a bulk insertion.

        Args:
            stamps: Whole nanoseconds, shape (n,).
            translations: Metres, shape (n, 3).
            rotations: Quaternions in xyzw order, shape (n, 4).
            names: Names of child frame, parent frame and sender.
        """
        self.stamps = stamps_of(stamps, "stamps")
        n = len(self.stamps)
        self.samples: Floats = np.empty((n, 7))
        self.samples[:, :3] = _shaped(translations, "translations", (n, 3))
        turns = batch.unit(_shaped(rotations, "rotations", (n, 4)))
        self.samples[:, 3:] = batch.canonical(turns)
        self._names = names
        every = np.ones(n, dtype=np.bool_)
        whole = self._names[:2]
        codes = refusals.objections(*whole, 0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), "")
        # Names are checked once, by the rules for single samples; array tests check the rows.
        self.reasons = {
            **{line.partition(":")[0]: every for line in codes},
            "TF_NAN_INPUT": np.isnan(self.samples).any(axis=1),
            "TF_DENORMALIZED_QUATERNION": np.isnan(self.samples[:, 6]),
        }
        self.validated: Flags = ~np.any(list(self.reasons.values()), axis=0)

    def taken(self, accepted: Flags) -> Iterator[tuple[int, Sample]]:
        """Yield stamp and pose of the accepted rows, in the order of insertion."""
        for row in np.flatnonzero(accepted).tolist():
            x, y, z, qx, qy, qz, qw = self.samples[row].tolist()
            yield int(self.stamps[row]), (x, y, z, qx, qy, qz, qw)

    def lines(self, row: int) -> list[str]:
        """Return the log lines that explain why a row is rejected."""
        child, parent, authority = self._names
        x, y, z, qx, qy, qz, qw = self.samples[row].tolist()
        stamp = int(self.stamps[row])
        return refusals.objections(child, parent, stamp, (x, y, z), (qx, qy, qz, qw), authority)


def insert(
    tree: FrameTree,
    log: Callable[[str, str], None],
    max_frames: int,
    link: tuple[str, str, str],
    stamps: npt.ArrayLike,
    translations: npt.ArrayLike,
    rotations: npt.ArrayLike,
) -> tuple[Insertion, CheckedRows]:
    """Insert many samples of one child frame into a tree, after a check of each sample.

    Args:
        tree: The tree to insert into.
        log: Function called with a sentence about each rejected sample.
        max_frames: Maximum number of frame names in the tree.
        link: Parent frame, child frame and authority (name of the sender).
        stamps: Nanoseconds, shape (n,).
        translations: Metres, shape (n, 3).
        rotations: Quaternions in xyzw order, shape (n, 4).

    Returns:
        The result with the accepted and the rejected rows, and the checked rows.
    """
    parent, child, authority = stripped(link[0]), stripped(link[1]), link[2]
    rows = CheckedRows(stamps, translations, rotations, (child, parent, authority))
    accepted, reasons = rows.validated.copy(), dict(rows.reasons)
    long = refusals.long_name(child, parent, authority, tree.max_name)
    if long:
        reasons = {"TF_LONG_NAME": np.ones(len(accepted), dtype=np.bool_)}
        accepted[:] = False
        log("ERROR", long)
    # A new name needs room for itself and for its parent's.
    if accepted.any() and not tree.has_room(child, parent, max_frames):
        full = refusals.too_many_frames(child, authority, len(tree.frames))
        reasons["TF_TOO_MANY_FRAMES"] = accepted.copy()
        accepted[:] = False
        log("ERROR", full)
    if accepted.any():
        # From here on the tree changes: every check that can reject rows comes before.
        frame, history, _ = tree.hang(child, parent, False)
        assert isinstance(history, History)
        origin = tree.origin(parent, authority)
        # Usually all rows are accepted; a slice avoids a copy.
        chosen = slice(None) if accepted.all() else np.flatnonzero(accepted)
        old = merge(history, origin, rows.stamps[chosen], rows.samples[chosen])
        if old.any():
            # `old` is a mask of the accepted rows; convert it to a mask of all rows.
            late: Flags = np.zeros(len(accepted), dtype=np.bool_)
            late[np.flatnonzero(accepted)[old]] = True
            reasons["TF_OLD_DATA"] = late
            accepted &= ~late
        if not old.all():
            tree.note(frame, parent, authority, origin)
    # A name that is too long is logged once, not for each row.
    refused = [] if long else np.flatnonzero(~accepted).tolist()
    if "TF_TOO_MANY_FRAMES" in reasons:
        refused = np.flatnonzero(~rows.validated).tolist()
    for row in refused[:MOST_LINES]:
        for line in rows.lines(row):
            log("ERROR", line)
        if rows.validated[row]:
            log("WARN", refusals.old_data(child, int(rows.stamps[row]), authority))
    if len(refused) > MOST_LINES:
        log("WARN", refusals.and_more(child, len(refused) - MOST_LINES, authority))
    found = {code: np.flatnonzero(flags) for code, flags in reasons.items() if flags.any()}
    return Insertion(accepted, found), rows


def adopt(
    tree: FrameTree,
    max_frames: int,
    link: tuple[str, str, str],
    records: npt.NDArray[np.int64],
    checked: int = 0,
) -> bool:
    """Insert samples of a new child frame without copying them: the tree uses the array `records`.

    Args:
        tree: The tree to insert into.
        max_frames: Maximum number of frame names in the tree.
        link: Parent frame, child frame and authority (name of the sender).
        records: Samples in the memory layout of `History`, shape (n, 8): stamps and seven doubles.
        checked: Number of leading records that need no check: their stamps increase and their
            quaternions have unit length and the sign that tf2 computes.

    Returns:
        Whether all records were accepted. If not, nothing was changed, and `insert` must check them
        row by row.

    Raises:
        TypeError: If the records are not rows of eight whole numbers.
    """
    if records.dtype != np.int64 or records.ndim != 2 or records.shape[1] != WORDS:
        raise TypeError(
            f"records must be an int64 array of shape (n, {WORDS}), not {records.dtype} "
            f"of shape {records.shape}"
        )
    parent, child, authority = stripped(link[0]), stripped(link[1]), link[2]
    objections = refusals.objections(child, parent, 0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), "")
    there = tree.numbers.get(child)
    if refusals.long_name(child, parent, link[2], tree.max_name):
        return False
    if objections or not len(records) or not tree.has_room(child, parent, max_frames):
        return False
    # A known child may have samples already: `merge` handles that case.
    if there is not None and tree.frames[there].link is not None:
        return False
    # The records span more than the buffer's limit: some would have to be pruned.
    if int(records[-1, 0]) - int(records[0, 0]) > tree.limit:
        return False
    # Borrowed, not copied: a recording of a million rows is inserted in microseconds.
    lent = words = _flat_words(records)
    for begin in range(checked, len(records), _BLOCK):
        # Begin one row earlier to compare stamps; both checks read rows in the cache.
        stamps = records[max(begin - 1, 0) : begin + _BLOCK, 0]
        samples = records[begin : begin + _BLOCK].view(np.float64)[:, 1:]
        if not (stamps[1:] > stamps[:-1]).all() or not np.isfinite(samples).all():
            return False
        if _is_canonical(samples[:, 3:]):
            continue
        turns = batch.canonical(batch.unit(samples[:, 3:]))
        if np.isnan(turns).any():
            return False
        # Copy at the first row whose quaternion must change: the caller's array stays
        # unchanged.
        if words is lent:
            words = _words(records)
        changed = np.frombuffer(words, dtype=np.float64).reshape(-1, WORDS)
        changed[begin : begin + _BLOCK, 4:] = turns
    frame, history, _ = tree.hang(child, parent, False)
    assert isinstance(history, History)
    origin = tree.origin(parent, authority)
    history.borrow(words, origin)
    tree.note(frame, parent, authority, origin)
    return True


def _flat_words(records: npt.NDArray[np.int64]) -> "array[int] | memoryview[int]":
    """Return the records as a flat array of 64-bit words: a view if contiguous, else a copy."""
    if not records.flags.c_contiguous:
        return _words(records)
    return records.data.cast("B").cast("q")


def _is_canonical(turns: Floats) -> bool:
    """Whether all quaternions have unit length and the sign that tf2 computes."""
    x, y, z, w = np.moveaxis(turns, -1, 0)
    # Add in the order of the scalar code, so that the last bit is the same.
    with np.errstate(over="ignore", under="ignore"):
        square = x * x + y * y + z * z + w * w
    if square.min() <= SHORTEST or square.max() >= LONGEST:
        return False
    # Compare all four numbers: at half a turn w is 0, and 0 equals -0.
    return bool(w.min() > 0.5 or (batch.canonical(turns) == turns).all())


def merge(history: History, origin: int, stamps: Stamps, samples: Floats) -> Flags:
    """Insert validated samples in their order; return a mask of the samples that were too old."""
    n = len(stamps)
    limit = min(history.limit, 2**63 - 1)
    # The newest stamp before each row decides if the row is too old, and which samples are pruned.
    before = np.empty(n, dtype=np.int64)
    before[0] = history.newest_stamp if len(history) else _LEAST
    np.maximum(before[0], np.maximum.accumulate(stamps[:-1]), out=before[1:])
    # If the subtraction would overflow, no row is too old.
    floors = np.where(before < _LEAST + limit, _LEAST, before - limit)
    old: Flags = stamps < floors
    floor = int(floors[-1])
    # The common case: the rows are newer than all samples, and in order. Append them.
    in_order = bool(np.all(stamps[1:] > stamps[:-1]))
    if in_order and (not len(history) or int(stamps[0]) > history.newest_stamp):
        kept = slice(int(np.searchsorted(stamps, floor)), n)
        records = _records(stamps[kept], samples[kept])
        if not len(history):
            history.replace(records, array("q", [origin]) * (len(records) // WORDS))
            return old
        if history.origins is None and history.origin == origin:
            history.extend(records, floor)
            return old

    # Out of order: sort old and new samples together, and replace the history.
    column = Column(history)
    there = column.origins
    if there is None:
        there = np.full(len(column.stamps), column.origin, dtype=np.int64)
    came = stamps[~old]
    all_stamps = np.concatenate((column.stamps, came))
    all_samples = np.concatenate((column.samples, samples[~old]))
    all_origins = np.concatenate((there, np.full(len(came), origin, dtype=np.int64)))
    # Stable: samples with equal stamps keep the order of insertion.
    order = np.argsort(all_stamps, kind="stable")
    order = order[all_stamps[order] >= floor]
    order = order[_not_repeated(all_stamps, all_samples, all_origins & PARENT_MASK, order)]
    history.replace(_records(all_stamps[order], all_samples[order]), _words(all_origins[order]))
    return old


def _not_repeated(
    stamps: Stamps, samples: Floats, parents: npt.NDArray[np.int64], order: Indices
) -> Flags:
    """Return a mask of the rows with the numbers `order`: False for a repetition.

    A row is a repetition if an earlier row has the same stamp, parent and values.
    """
    # tf2 ignores a sample equal to a stored one with its stamp: check runs of equal stamps only.
    keep = np.ones(len(order), dtype=np.bool_)
    ordered = stamps[order]
    equal = np.flatnonzero(ordered[1:] == ordered[:-1])
    seen: deque[tuple[float, ...]] = deque(maxlen=MOST_ALIKE)
    last = -2
    for place in equal.tolist():
        if place != last + 1:
            seen.clear()
            seen.append(_kind(samples, parents, int(order[place])))
        last = place
        kind = _kind(samples, parents, int(order[place + 1]))
        if kind in seen:
            keep[place + 1] = False
        else:
            seen.append(kind)
    return keep


def _kind(samples: Floats, parents: npt.NDArray[np.int64], row: int) -> tuple[float, ...]:
    return (*samples[row].tolist(), float(parents[row]))


def _shaped(numbers: npt.ArrayLike, name: str, shape: tuple[int, int]) -> Floats:
    given = np.asarray(numbers)
    if given.size == 0 and shape[0] == 0 and given.ndim == 1:
        return np.empty(shape)
    if given.shape != shape:
        raise ValueError(
            f"{name} for {shape[0]} stamps must have the shape {shape}, not {given.shape}"
        )
    if given.dtype.kind not in "fiub":
        raise TypeError(f"{name} must be an array of real numbers, not of {given.dtype}")
    return np.asarray(given, dtype=np.float64)


def _records(stamps: Stamps, samples: Floats) -> "array[int]":
    records = np.empty((len(stamps), WORDS), dtype=np.int64)
    records[:, 0] = stamps
    records.view(np.float64)[:, 1:] = samples
    return _words(records.reshape(-1))


def _words(values: npt.NDArray[np.int64]) -> "array[int]":
    result: array[int] = array("q")
    result.frombytes(np.ascontiguousarray(values).data.cast("B"))
    return result
