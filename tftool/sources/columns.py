"""Recorded messages in, transforms out: columns per edge that grow as a file is read."""

from array import array
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.errors import MalformedMessage, TftoolError
from tftool.sources.contract import Edge, Indexes, Publisher, Stamps, Transforms
from tftool.sources.foreign import Decoder
from tftool.stamps import Stamp
from tftool.wire.layouts import CDR, Layout
from tftool.wire.rows import (
    Bytes,
    Records,
    Template,
    Words,
    row_span,
    rows_of,
    sample,
    walk,
)

MOST_EDGES: Final = 100_000
"""Edges of one recording; of what goes beyond, only the number is told."""

_PER_LENGTH: Final = 16  # layouts of one length that are tried before messages are walked singly
_TEMPLATE_BYTES: Final = 16_000_000
_WORTH_A_TEMPLATE: Final = 4
_FEW: Final = 256  # messages that wait for others: an array operation costs a microsecond
_LITTLE_HEADER: Final = 0x00000100
_MOST_AHEAD: Final = 16  # times as many rows as have come, at most, are made room for


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """Some messages of a recording, where they lie in a piece of its bytes.

    Attributes:
        buffer: The bytes.
        starts: Where each message begins, shape (n,).
        lengths: Bytes of each, shape (n,); all of them lie in the buffer.
        log_times: When each was received, shape (n,).
        senders: Each one's publisher, a number of the reader's, shape (n,).
    """

    buffer: Bytes
    starts: Stamps
    lengths: Stamps
    log_times: Stamps
    senders: Indexes

    def __len__(self) -> int:
        return len(self.starts)

    def payload(self, number: int) -> bytes:
        """The bytes of one message."""
        start = int(self.starts[number])
        return self.buffer[start : start + int(self.lengths[number])].tobytes()

    def chosen(self, which: "Stamps | slice") -> "Batch":
        """Some of them."""
        return Batch(
            self.buffer,
            self.starts[which],
            self.lengths[which],
            self.log_times[which],
            self.senders[which],
        )


class _Column:
    """An array that grows in place: room that is not written yet costs no memory.

    Attributes:
        count: Rows that are in it.
    """

    __slots__ = ("_rows", "count")

    def __init__(self, kind: type, *width: int) -> None:
        self._rows: npt.NDArray[Any] = np.empty((0, *width), dtype=kind)
        self.count = 0

    def room(self, count: int, share: float = 1.0) -> npt.NDArray[Any]:
        """So many rows more, to be written.

        Args:
            count: How many.
            share: How much of all has come with them, from 0 to 1.
        """
        first = self.count
        self.count = needed = first + count
        if needed > len(self._rows):
            # What is there to come is known roughly; to copy what has come costs more than
            # addresses that are never used.
            most = needed * _MOST_AHEAD
            likely = int(needed / share * 1.02) if share * most > needed else most
            before = self._rows
            rows = self._made(max(likely, needed * 3 // 2, 16))
            rows[:first] = before[:first]
            self._rows = rows
        return self._rows[first:needed]

    def _made(self, count: int) -> npt.NDArray[Any]:
        return np.empty((count, *self._rows.shape[1:]), dtype=self._rows.dtype)

    def all(self) -> npt.NDArray[Any]:
        """What is in it."""
        return self._rows[: self.count]


class _RecordColumn(_Column):
    """The same of records, as the buffer's histories keep them: they take them uncopied."""

    __slots__ = ("_words",)

    def __init__(self) -> None:
        super().__init__(np.int64, 8)
        self._words = array("q")

    def _made(self, count: int) -> npt.NDArray[Any]:
        self._words = array("q", [0]) * (count * 8)
        return np.frombuffer(self._words, dtype=np.int64).reshape(-1, 8)

    def all(self) -> npt.NDArray[Any]:
        """What is in it; nothing is written behind it any more."""
        self._rows = np.empty((0, 8), dtype=np.int64)
        try:
            del self._words[self.count * 8 :]
        except BufferError:  # something still looks at the room that is left
            self._words = self._words[: self.count * 8]
        return np.frombuffer(self._words, dtype=np.int64).reshape(-1, 8)


class _Growing:
    """One edge while it is read."""

    __slots__ = ("child", "last", "messages", "ordered", "parent", "records", "slashed", "static")

    def __init__(self, parent: str, child: str, static: bool) -> None:
        self.parent = parent
        self.child = child
        self.static = static
        self.slashed = 0
        self.records = _RecordColumn()
        self.messages = _Column(np.int32)
        self.ordered = True
        self.last = -1

    def room(self, messages: Indexes, share: float) -> Records:
        """Where to write a transform of each of some messages."""
        if self.last > int(messages[0]):
            self.ordered = False
        self.last = int(messages[-1])
        self.messages.room(len(messages), share)[:] = messages
        found: Records = self.records.room(len(messages), share)
        return found

    def finished(self) -> Edge:
        """As a value, in the order of the messages."""
        records, messages = self.records.all(), self.messages.all()
        if not self.ordered:
            # Stable: one message may bring an edge twice.
            order = np.argsort(messages, kind="stable")
            records, messages = records[order], messages[order]
        return Edge(self.parent, self.child, self.static, self.slashed, records, messages)


class Table:
    """All edges of a source while it is read, and the messages they came in."""

    def __init__(self, expected: int = 0) -> None:
        """Begin with none.

        Args:
            expected: About how many messages are to come.
        """
        self._edges: dict[tuple[str, str, bool], _Growing] = {}
        self._expected = expected
        self._log_times = _Column(np.int64)
        self._senders = _Column(np.int32)
        self._left_out = 0
        self.refused: Counter[str] = Counter()
        """How many messages were refused, by the reason."""

    def note(self, log_times: Stamps, senders: Indexes) -> int:
        """Number messages; the number of the first."""
        first = self._log_times.count
        share = self.share(first + len(log_times))
        self._log_times.room(len(log_times), share)[:] = log_times
        self._senders.room(len(senders), share)[:] = senders
        return first

    def share(self, messages: int) -> float:
        """How much of all has come with so many messages."""
        return min(messages / self._expected, 1.0) if self._expected else 1.0

    def edge(self, parent: str, child: str, static: bool, count: int) -> "_Growing | None":
        """The edge to which to append so many transforms; None where there are too many."""
        plain = parent.removeprefix("/"), child.removeprefix("/")
        key = (*plain, static)
        edge = self._edges.get(key)
        if edge is None:
            if len(self._edges) >= MOST_EDGES:
                self._left_out += count
                return None
            edge = self._edges[key] = _Growing(*key)
        if plain != (parent, child):
            edge.slashed += count
        return edge

    def append(
        self,
        parent: str,
        child: str,
        static: bool,
        message: int,
        stamp: Stamp,
        seven: tuple[float, ...],
    ) -> None:
        """Append one transform of a message."""
        edge = self.edge(parent, child, static, 1)
        if edge is None:
            return
        if edge.last > message:
            edge.ordered = False
        edge.last = message
        edge.messages.room(1)[0] = message
        record = edge.records.room(1)[0]
        record[0] = stamp
        record.view(np.float64)[1:] = seven

    def finished(self, publishers: tuple[Publisher, ...]) -> Transforms:
        """Everything as columns."""
        damage = [
            f"{count} {'message was' if count == 1 else 'messages were'} left out: {reason}"
            for reason, count in self.refused.most_common()
        ]
        if self._left_out:
            damage.append(
                f"{self._left_out} transforms were left out: there are more than "
                f"{MOST_EDGES} pairs of frames."
            )
        return Transforms(
            tuple(edge.finished() for edge in self._edges.values()),
            self._log_times.all(),
            self._senders.all(),
            publishers,
            tuple(damage),
        )


class Cutter:
    """Cuts messages with transforms of one layout and kind into a table."""

    def __init__(self, table: Table, layout: Layout, static: bool) -> None:
        self._table = table
        self._layout = layout
        self._static = static
        self._templates: dict[int, list[Template]] = {}
        # Of a length: for how many layouts, which word tells them apart, and which part of it.
        self._told: dict[int, tuple[int, int, int]] = {}
        self._bytes = 0
        self._waiting: list[tuple[Batch, Indexes]] = []
        self._count = 0

    def add(self, batch: Batch, numbers: Indexes) -> None:
        """Cut messages, or keep them until there are some more.

        Args:
            batch: The messages.
            numbers: Their numbers in the table, shape (n,).
        """
        if len(batch) >= _FEW:
            self.flush()
            self._cut(batch, numbers)
        elif len(batch):
            # Only their bytes are kept, not the whole chunk they lie in.
            self._waiting.append((_compacted(batch), numbers))
            self._count += len(batch)
            if self._count >= _FEW:
                self.flush()

    def flush(self) -> None:
        """Cut what waits."""
        if not self._waiting:
            return
        waiting, self._waiting, self._count = self._waiting, [], 0
        offset = 0
        starts = []
        for batch, _ in waiting:
            starts.append(batch.starts + offset)
            offset += len(batch.buffer)
        joined = Batch(
            np.concatenate([batch.buffer for batch, _ in waiting]),
            np.concatenate(starts),
            np.concatenate([batch.lengths for batch, _ in waiting]),
            np.concatenate([batch.log_times for batch, _ in waiting]),
            np.concatenate([batch.senders for batch, _ in waiting]),
        )
        self._cut(joined, np.concatenate([numbers for _, numbers in waiting]))

    def _cut(self, batch: Batch, numbers: Indexes) -> None:
        lengths = batch.lengths
        if (lengths == lengths[0]).all():
            self._cut_equal(batch, numbers, int(lengths[0]))
            return
        for length in np.unique(lengths).tolist():
            which = np.flatnonzero(lengths == length)
            self._cut_equal(batch.chosen(which), numbers[which], length)

    def _cut_equal(self, batch: Batch, numbers: Indexes, length: int) -> None:
        """Cut messages that are equally long."""
        begin, width = row_span(self._layout, length)
        if width < 72:
            self._walk(batch, numbers)
            return
        if int(batch.starts.min()) + begin < 0:
            buffer = np.concatenate([np.zeros(8, dtype=np.uint8), batch.buffer])
            batch = Batch(buffer, batch.starts + 8, batch.lengths, batch.log_times, batch.senders)
        templates = self._templates.setdefault(length, [])
        if len(templates) > 1:
            batch, numbers = self._cut_told(batch, numbers, length)
            if not len(batch):
                return
        rows = rows_of(batch.buffer, batch.starts + begin, width)
        tried = 0
        while len(rows):
            if tried == len(templates):
                if self._layout is CDR and int(rows[0, 0]) >> 32 != _LITTLE_HEADER:
                    odd = rows[:, 0] >> np.uint64(32) != _LITTLE_HEADER
                    self._walk(batch.chosen(np.flatnonzero(odd)), numbers[odd])
                    rest = np.flatnonzero(~odd)
                    rows, numbers, batch = rows[rest], numbers[rest], batch.chosen(rest)
                    continue
                if tried >= _PER_LENGTH or not self._learn(batch.payload(0), length):
                    self._walk(batch, numbers)
                    return
            template = templates[tried]
            fits = template.fits(rows)
            if fits is None:
                self._append(template, rows, numbers)
                # What came last is likely to come next.
                templates.insert(0, templates.pop(tried))
                return
            if fits.any():
                self._append(template, rows[fits], numbers[fits])
                rest = np.flatnonzero(~fits)
                rows, numbers, batch = rows[rest], numbers[rest], batch.chosen(rest)
            tried += 1

    def _cut_told(self, batch: Batch, numbers: Indexes, length: int) -> tuple[Batch, Indexes]:
        """Cut messages of layouts that one word tells apart: each row is copied only once.

        Returns:
            What is left, of layouts that are not known yet, in a batch and its numbers.
        """
        templates = self._templates[length]
        told = self._told.get(length)
        if told is None or told[0] != len(templates):
            told = self._told[length] = (len(templates), *telling_word(templates))
        _, word, mask = told
        if not mask:
            return batch, numbers
        begin, width = row_span(self._layout, length)
        starts = batch.starts + begin
        found = words_at(batch.buffer, starts + 8 * word, "<u8")
        found &= np.uint64(mask)
        left = np.ones(len(batch), dtype=np.bool_)
        for template in templates:
            which = np.flatnonzero(found == np.uint64(template.value(word, mask)))
            if not len(which):
                continue
            rows = rows_of(batch.buffer, starts[which], width)
            fits = template.fits(rows)
            if fits is not None:
                which, rows = which[fits], rows[fits]
            if len(which):
                self._append(template, rows, numbers[which])
                left[which] = False
        rest = np.flatnonzero(left)
        return batch.chosen(rest), numbers[rest]

    def _learn(self, payload: bytes, length: int) -> bool:
        """Make a template of a message; whether it could be one."""
        try:
            walked = walk(self._layout, payload)
        except MalformedMessage:
            return False
        self._bytes += 4 * length
        if self._bytes > _TEMPLATE_BYTES:
            self._bytes = 0
            self._templates = {length: self._templates[length]}
            self._told.clear()
        self._templates[length].append(Template(self._layout, payload, walked))
        return True

    def _append(self, template: Template, rows: Words, numbers: Indexes) -> None:
        for place in template.places:
            edge = self._table.edge(place.parent, place.child, self._static, len(rows))
            if edge is not None:
                share = self._table.share(int(numbers[-1]) + 1)
                template.cut(rows, place, edge.room(numbers, share))

    def _walk(self, batch: Batch, numbers: Indexes) -> None:
        """Read messages one by one, whatever is odd about them."""
        for number in range(len(batch)):
            payload = batch.payload(number)
            try:
                walked = walk(self._layout, payload)
            except MalformedMessage as error:
                self._table.refused[str(error)] += 1
                continue
            message = int(numbers[number])
            for place in walked.places:
                stamp, seven = sample(payload, walked.order, place)
                self._table.append(place.parent, place.child, self._static, message, stamp, seven)


class Decoding:
    """Takes messages with transforms in other shapes, one by one, into a table."""

    def __init__(self, table: Table, decode: Decoder, static: bool) -> None:
        self._table = table
        self._decode = decode
        self._static = static

    def add(self, batch: Batch, numbers: Indexes) -> None:
        """Decode messages; see `Cutter.add`."""
        for number in range(len(batch)):
            message = int(numbers[number])
            try:
                for stamp, parent, child, seven in self._decode(batch.payload(number)):
                    self._table.append(parent, child, self._static, message, stamp, seven)
            except TftoolError as error:
                self._table.refused[str(error)] += 1

    def flush(self) -> None:
        """Nothing waits."""


def telling_word(templates: Sequence[Template]) -> tuple[int, int]:
    """A word that differs between all of some templates, and which part of it; 0 for none."""
    for word, mask in templates[0].constants():
        values = [template.value(word, mask) for template in templates]
        if -1 not in values and len(set(values)) == len(values):
            return word, mask
    return 0, 0


def words_at(buffer: Bytes, places: Stamps, kind: str) -> Stamps:
    """The number that begins at each of some bytes, wherever they lie.

    Args:
        buffer: The bytes.
        places: Where each number begins, shape (n,); all of it lies in the buffer.
        kind: Its type, "<u4".
    """
    size = np.dtype(kind).itemsize
    words: Stamps = np.ndarray(
        (len(buffer) - size + 1,), dtype=kind, buffer=buffer.data, strides=(1,)
    )
    return words[places]


def _compacted(batch: Batch) -> Batch:
    """The same messages in a buffer of their own, with room before each for a row."""
    pieces = []
    starts = np.empty(len(batch), dtype=np.int64)
    position = 0
    for number, (start, length) in enumerate(
        zip(batch.starts.tolist(), batch.lengths.tolist(), strict=True)
    ):
        pieces += [bytes(8), batch.buffer[start : start + length].tobytes()]
        starts[number] = position + 8
        position += 8 + length
    buffer = np.frombuffer(b"".join(pieces), dtype=np.uint8)
    return Batch(buffer, starts, batch.lengths, batch.log_times, batch.senders)
