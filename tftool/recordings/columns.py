"""Columns of transforms for each edge (pair of frames), filled while a recording is read."""

from array import array
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.base.native import PAGE, large_pages
from tftool.base.stamps import Stamp
from tftool.messages.transform_rows import (
    Bytes,
    Records,
)
from tftool.recordings.contract import Edge, Indexes, Publisher, Stamps, Transforms

MOST_EDGES: Final = 100_000
"""Maximum number of edges of a recording; transforms of further edges are only counted."""

_NEVER: Final = 2**62, 0
_FEWEST: Final = 16
_MOST_AHEAD: Final = 16  # maximum ratio of allocated rows to rows read so far
_UNESTIMATED: Final = 1 << 22  # rows of all edges that may be allocated regardless of that ratio
_RECORD: Final = 64  # bytes of a transform's record


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """Some messages of a recording, whose bytes are in one buffer.

    Attributes:
        buffer: The bytes.
        starts: Offset of each message in the buffer, shape (n,).
        lengths: Length of each message, bytes, shape (n,).
        log_times: Times of reception, nanoseconds, shape (n,).
        senders: Stream of each message, as an index into `Container.streams`, shape (n,).
    """

    buffer: Bytes
    starts: Stamps
    lengths: Stamps
    log_times: Stamps
    senders: Indexes

    def __len__(self) -> int:
        return len(self.starts)

    def payload(self, number: int) -> bytes:
        """Return the bytes of one message, by its index in the batch."""
        start = int(self.starts[number])
        return self.buffer[start : start + int(self.lengths[number])].tobytes()

    def chosen(self, which: "Stamps | slice") -> "Batch":
        """Return a batch of the messages at some indices."""
        return Batch(
            self.buffer,
            self.starts[which],
            self.lengths[which],
            self.log_times[which],
            self.senders[which],
        )


def in_order(batches: Sequence[Batch]) -> Batch:
    """Merge batches that share one buffer; sort the messages by their offset in the buffer."""
    if len(batches) == 1:
        return batches[0]
    starts, lengths, log_times, senders = (
        np.concatenate([getattr(one, name) for one in batches])
        for name in ("starts", "lengths", "log_times", "senders")
    )
    order = np.argsort(starts, kind="stable")
    return Batch(batches[0].buffer, starts, lengths, log_times, senders).chosen(order)


class _Column:
    """An array to which rows can be appended, with free rows at its end.

    Attributes:
        count: Number of rows in use.
    """

    __slots__ = ("_rows", "count")

    def __init__(self, kind: type) -> None:
        self._rows: npt.NDArray[Any] = np.empty(0, dtype=kind)
        self.count = 0

    def room(self, count: int, share: float = 1.0) -> npt.NDArray[Any]:
        """Append uninitialized rows, and return a view of these rows for the caller to fill.

        Args:
            count: Number of rows.
            share: Fraction of the recording read so far, 0 to 1.
        """
        first = self.count
        self.count = needed = first + count
        if needed > len(self._rows):
            kind, before = self._rows.dtype, self._rows
            rows = _wanted(needed, share, _UNESTIMATED)
            self._rows = _room(rows * kind.itemsize).view(kind)
            self._rows[:first] = before[:first]
        return self._rows[first:needed]

    def all(self) -> npt.NDArray[Any]:
        """Return all rows in use."""
        return self._rows[: self.count]


def _wanted(needed: int, share: float, unestimated: int) -> int:
    """Return the number of rows to allocate for a growing column.

    Args:
        needed: Minimum number of rows.
        share: Fraction of the recording read so far, 0 to 1, from which the final number of rows is
            estimated.
        unestimated: Number of rows that may be allocated without an estimate.
    """
    # Extrapolate from the fraction read: copying rows later costs more than memory that is
    # allocated but never used.
    most = max(needed * _MOST_AHEAD, unestimated)
    likely = int(needed / share * 1.02) if share * most > needed else needed * _MOST_AHEAD
    return max(likely, needed * 3 // 2, _FEWEST)


def _room(size: int) -> Bytes:
    """Return an uninitialized array of `size` bytes, in large memory pages if possible."""
    # The first write to a small page costs as much as a hundred transforms.
    pages = large_pages(size + PAGE, size + PAGE) if size >= PAGE else None
    if pages is None:
        return np.empty(size, dtype=np.uint8)
    whole = np.frombuffer(pages, dtype=np.uint8)
    # Start at the first whole large page: the system aligns them to their size.
    first = -whole.ctypes.data % PAGE
    return whole[first : first + size]


# Indices in `Growing.state`; the native scan uses the same.
_COUNT, _LAST, _ORDERED, _KEPT, _SLASHED, _MOVED = range(6)


class Growing:
    """Growing columns of one edge, filled while a recording is read.

    Attributes:
        parent: Parent frame, as in `Edge`.
        child: Child frame, as in `Edge`.
        static: Whether the transforms are static, as in `Edge`.
        records: Samples in the layout of `History`, which uses the array without a copy. Rows after
            the last sample are free.
        messages: Number of the message of each sample. Rows after the last sample are free.
        state: Six numbers, shared with the native scan: number of rows; number of the last message;
            whether the messages came in order; number of rows at the beginning that `History` can
            use without a check; number of transforms whose leading slash was removed; and how often
            the columns were moved in memory.
        first: Position of the edge's first transform in the recording: number of the message, and
            a number that increases from transform to transform within the message.
    """

    __slots__ = ("child", "first", "messages", "parent", "records", "state", "static")

    def __init__(self, parent: str, child: str, static: bool) -> None:
        self.parent = parent
        self.child = child
        self.static = static
        self.records: Records = np.empty((0, 8), dtype=np.int64)
        self.messages: Indexes = np.empty(0, dtype=np.int32)
        self.state = array("q", (0, -1, 1, 0, 0, 0))
        self.first = _NEVER

    def make_room(self, count: int, share: float = 1.0, unestimated: int = 0) -> int:
        """Enlarge the columns of the edge, if `count` more rows do not fit.

        Args:
            count: Number of rows that must be free.
            share: Fraction of the recording read so far, 0 to 1, from which the final number of
                rows is estimated.
            unestimated: Number of rows that may be allocated without an estimate.

        Returns:
            Number of rows that were allocated, 0 if `count` rows were free.
        """
        there, before = self.state[_COUNT], len(self.messages)
        needed = there + count
        if needed <= before:
            return 0
        # An edge with one transform may never get a second.
        rows = _wanted(needed, share, unestimated if there else 0)
        # Both columns are in one piece of memory, so that only its end is unused.
        split = rows * _RECORD
        room = _room(split + rows * self.messages.itemsize)
        records, self.records = self.records, room[:split].view(np.int64).reshape(rows, 8)
        messages, self.messages = self.messages, room[split:].view(np.int32)
        # Copy only rows in use: other memory is never written, and costs nothing.
        self.records[:there] = records[:there]
        self.messages[:there] = messages[:there]
        # The native scan caches the addresses, and reads them again when this number changes.
        self.state[_MOVED] += 1
        return rows - before

    def room(
        self, first: tuple[int, int], last: int, count: int, share: float = 1.0
    ) -> tuple[Records, Indexes]:
        """Append rows for transforms, and return views of the rows for the caller to fill.

        Args:
            first: Number of the first message, and index of the first transform in this message.
            last: Number of the last message.
            count: Number of transforms.
            share: Fraction of the recording read so far, 0 to 1.

        Returns:
            The new rows of `records`, and the new rows of `messages`.
        """
        state = self.state
        # Threads may deliver batches out of order; such an edge is sorted at the end.
        if state[_LAST] > first[0]:
            state[_ORDERED] = 0
        self.first = min(self.first, first)
        state[_LAST] = last
        self.make_room(count, share)
        begin = state[_COUNT]
        state[_COUNT] = end = begin + count
        return self.records[begin:end], self.messages[begin:end]

    def add_slashed(self, count: int) -> None:
        """Count transforms whose leading slash was removed."""
        self.state[_SLASHED] += count

    def finished(self) -> Edge:
        """Return the edge's columns as an `Edge`, in the order of the messages."""
        count, _, ordered, kept, slashed, _ = self.state
        records, messages = self.records[:count], self.messages[:count]
        if not ordered:
            # Stable, because one message may have two transforms of an edge.
            order = np.argsort(messages, kind="stable")
            records, messages, kept = records[order], messages[order], 0
        return Edge(self.parent, self.child, self.static, slashed, records, messages, kept)


class Table:
    """Growing columns of all edges, and of the messages that contain the transforms."""

    def __init__(self, expected: int = 0) -> None:
        """Create an empty table of edges.

        Args:
            expected: Approximate number of messages in the recording; 0 if unknown.
        """
        self._edges: dict[tuple[str, str, bool], Growing] = {}
        self._expected = expected
        self._log_times = _Column(np.int64)
        self._senders = _Column(np.int32)
        self._left_out = 0
        self._unestimated = _UNESTIMATED
        self.refused: Counter[str] = Counter()
        """Number of refused messages, by reason."""

    def note(self, log_times: Stamps, senders: Indexes) -> int:
        """Append messages' log times and senders; return the first message's number."""
        first = self._log_times.count
        share = self.share(first + len(log_times))
        self._log_times.room(len(log_times), share)[:] = log_times
        self._senders.room(len(senders), share)[:] = senders
        return first

    def share(self, messages: int) -> float:
        """Return the fraction of the recording that is read after `messages` messages, 0 to 1."""
        return min(messages / self._expected, 1.0) if self._expected else 1.0

    def edge(self, parent: str, child: str, static: bool, count: int) -> "Growing | None":
        """Return the columns of an edge; None for a new edge if there are `MOST_EDGES` edges.

        The next `count` transforms of the edge will be appended, or are counted as left out.
        """
        plain = parent.removeprefix("/"), child.removeprefix("/")
        key = (*plain, static)
        edge = self._edges.get(key)
        if edge is None:
            if self.spare <= 0:
                self.leave_out(count)
                return None
            edge = self._edges[key] = Growing(*key)
        if plain != (parent, child):
            edge.add_slashed(count)
        return edge

    @property
    def spare(self) -> int:
        """Return the number of edges that can still be added to the table."""
        return MOST_EDGES - len(self._edges)

    def make_room(self, edge: Growing, message: int) -> None:
        """Ensure that an edge has a free row for its next transform, from message `message`."""
        self._unestimated -= edge.make_room(1, self.share(message + 1), max(self._unestimated, 0))

    def leave_out(self, count: int) -> None:
        """Add to the number of transforms that are left out because there are too many edges."""
        self._left_out += count

    def append(
        self,
        parent: str,
        child: str,
        static: bool,
        message: tuple[int, int],
        stamp: Stamp,
        seven: tuple[float, ...],
    ) -> None:
        """Append one transform to the columns of an edge.

        Args:
            parent: Parent frame.
            child: Child frame.
            static: Whether the transform is static.
            message: Number of the message, and index of the transform in the message.
            stamp: Stamp of the transform, nanoseconds.
            seven: Translation x y z (metres), and quaternion x y z w.
        """
        edge = self.edge(parent, child, static, 1)
        if edge is None:
            return
        records, messages = edge.room(message, message[0], 1)
        messages[0] = message[0]
        records[0, 0] = stamp
        records.view(np.float64)[0, 1:] = seven

    def finished(self, publishers: tuple[Publisher, ...]) -> Transforms:
        """Return the columns of all edges and messages."""
        damage = [
            f"{count} {'message was' if count == 1 else 'messages were'} left out: {reason}"
            for reason, count in sorted(self.refused.items(), key=lambda one: (-one[1], one[0]))
        ]
        if self._left_out:
            damage.append(
                f"{self._left_out} transforms were left out: there are more than "
                f"{MOST_EDGES} pairs of frames."
            )
        # Order edges by first appearance: the result must not depend on threads.
        edges = sorted(self._edges.values(), key=lambda edge: edge.first)
        return Transforms(
            tuple(edge.finished() for edge in edges),
            self._log_times.all(),
            self._senders.all(),
            publishers,
            tuple(damage),
        )


def words_at(buffer: Bytes, places: Stamps, kind: str) -> Stamps:
    """Read numbers at byte offsets in a buffer; the offsets need not be aligned.

    Args:
        buffer: The bytes.
        places: Byte offset of each number, shape (n,); every number must end within the buffer.
        kind: numpy's name of the numbers' type, for example "<u4".
    """
    size = np.dtype(kind).itemsize
    # Overlapping views with a stride of one byte: unaligned words without a copy.
    words: Stamps = np.ndarray(
        (len(buffer) - size + 1,), dtype=kind, buffer=buffer.data, strides=(1,)
    )
    return words[places]
