"""Recorded messages in, transforms out: columns per edge that grow as a file is read."""

import struct
from array import array
from collections import Counter
from dataclasses import dataclass
from typing import Final

import numpy as np

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
_RECORD: Final = struct.Struct("<q7d")


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


class _Growing:
    """One edge while it is read: arrays that grow in place, which numpy's do not."""

    __slots__ = ("child", "messages", "ordered", "parent", "records", "slashed", "static")

    def __init__(self, parent: str, child: str, static: bool) -> None:
        self.parent = parent
        self.child = child
        self.static = static
        self.slashed = 0
        self.records = array("q")
        self.messages = array("i")
        self.ordered = True

    def append(self, records: Records, messages: Indexes) -> None:
        """Append transforms, and the message each came in."""
        if self.ordered and self.messages and self.messages[-1] > messages[0]:
            self.ordered = False
        self.records.frombytes(records.view(np.uint8).data)
        self.messages.frombytes(np.ascontiguousarray(messages).view(np.uint8).data)

    def finished(self) -> Edge:
        """As a value, in the order of the messages."""
        records: Records = np.frombuffer(self.records, dtype=np.int64).reshape(-1, 8)
        messages: Indexes = np.frombuffer(self.messages, dtype=np.int32)
        if not self.ordered:
            # Stable: one message may bring an edge twice.
            order = np.argsort(messages, kind="stable")
            records, messages = records[order], messages[order]
        return Edge(self.parent, self.child, self.static, self.slashed, records, messages)


class Table:
    """All edges of a source while it is read, and the messages they came in."""

    def __init__(self) -> None:
        self._edges: dict[tuple[str, str, bool], _Growing] = {}
        self._log_times = array("q")
        self._senders = array("i")
        self._left_out = 0
        self.refused: Counter[str] = Counter()
        """How many messages were refused, by the reason."""

    def note(self, log_times: Stamps, senders: Indexes) -> int:
        """Number messages; the number of the first."""
        first = len(self._log_times)
        self._log_times.frombytes(np.ascontiguousarray(log_times).view(np.uint8).data)
        self._senders.frombytes(np.ascontiguousarray(senders).view(np.uint8).data)
        return first

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
        if edge.ordered and edge.messages and edge.messages[-1] > message:
            edge.ordered = False
        edge.records.frombytes(_RECORD.pack(stamp, *seven))
        edge.messages.append(message)

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
            np.frombuffer(self._log_times, dtype=np.int64),
            np.frombuffer(self._senders, dtype=np.int32),
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
        starts = batch.starts + begin
        if width < 72 or int(starts.min()) < 0:
            self._walk(batch, numbers)
            return
        if self._layout is CDR:
            heads = words_at(batch.buffer, batch.starts, "<u4")
            odd = np.flatnonzero(heads != _LITTLE_HEADER)
            if len(odd):
                self._walk(batch.chosen(odd), numbers[odd])
                plain = np.flatnonzero(heads == _LITTLE_HEADER)
                batch, numbers, starts = batch.chosen(plain), numbers[plain], starts[plain]
                if not len(plain):
                    return
        rows = rows_of(batch.buffer, starts, width)
        templates = self._templates.setdefault(length, [])
        tried = 0
        while len(rows):
            if tried == len(templates) and (
                tried >= _PER_LENGTH or not self._learn(batch.payload(0), length)
            ):
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
        self._templates[length].append(Template(self._layout, payload, walked))
        return True

    def _append(self, template: Template, rows: Words, numbers: Indexes) -> None:
        for place in template.places:
            edge = self._table.edge(place.parent, place.child, self._static, len(rows))
            if edge is not None:
                edge.append(template.cut(rows, place), numbers)

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
