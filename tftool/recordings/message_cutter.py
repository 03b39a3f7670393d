"""Decoders of recorded messages into columns of transforms, in C where built, else in numpy."""

from typing import Final, TypeAlias

import numpy as np

from tftool.base.errors import MalformedMessage, TftoolError
from tftool.messages.layouts import CDR, Layout
from tftool.messages.transform_rows import (
    SCAN,
    SMALLEST,
    Template,
    Words,
    row_span,
    rows_of,
    sample,
    walk,
)
from tftool.recordings.columns import Batch, Growing, Table
from tftool.recordings.contract import Indexes
from tftool.recordings.foreign_transforms import Decoder

_PER_LENGTH: Final = (
    16  # layouts per message length; messages of further layouts are parsed one by one
)
_TEMPLATE_BYTES: Final = 16_000_000
_FEW: Final = 256  # messages to collect: an array operation costs a microsecond at least
_LITTLE_HEADER: Final = 0x00000100
_MOST_SCANNED: Final = 1 << 32  # size of a buffer whose offsets fit into 32 bits

MOST_WAITING: Final = 1 << 26
"""Maximum size of the collected messages, bytes; the last message may exceed it."""


class Cutter:
    """Base class of decoders, which append transforms from messages of one byte layout to a table.

    Messages are collected until there are enough for array operations. Unusual messages are parsed
    one by one.
    """

    def __init__(self, table: Table, layout: Layout, static: bool) -> None:
        self._table = table
        self._layout = layout
        self._static = static
        self._waiting: list[tuple[Batch, Indexes]] = []
        # Number and size of the collected messages; both are limited.
        self._count = self._held = 0

    def add(self, batch: Batch, numbers: Indexes) -> None:
        """Decode a large batch at once; collect the messages of small batches to decode later.

        Args:
            batch: The messages.
            numbers: Number of each message in the table, shape (n,).
        """
        # Decode collected messages first: columns are in the order of the recording.
        if len(batch) >= _FEW:
            self.flush()
            self._cut_first(batch, numbers)
        elif len(batch):
            # Copy the messages' bytes, so that the whole chunk can be freed.
            self._waiting.append((_compacted(batch), numbers))
            self._count += len(batch)
            self._held += int(batch.lengths.sum())
            if self._count >= _FEW or self._held >= MOST_WAITING:
                self.flush()

    def flush(self) -> None:
        """Decode all collected messages."""
        if not self._waiting:
            return
        waiting, self._waiting = self._waiting, []
        self._count = self._held = 0
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
        self._cut_first(joined, np.concatenate([numbers for _, numbers in waiting]))

    def _cut_first(self, batch: Batch, numbers: Indexes) -> None:
        """Decode messages; if the table cannot have all edges, use the edges that appear first."""
        # Even with transforms of minimum size, there cannot be too many new edges.
        if int(batch.lengths.sum()) // SMALLEST <= self._table.spare:
            self._cut(batch, numbers)
            return
        # Maximum number of transforms up to each message.
        most = np.cumsum(batch.lengths // SMALLEST)
        begin = done = 0
        while begin < len(batch):
            # These messages cannot have too many new edges, in any order.
            end = max(int(np.searchsorted(most, done + self._table.spare, "right")), begin + 1)
            self._cut(batch.chosen(slice(begin, end)), numbers[begin:end])
            begin, done = end, int(most[end - 1])

    def _cut(self, batch: Batch, numbers: Indexes) -> None:
        """Decode messages by the fast method of the subclass."""
        raise NotImplementedError

    def _walk(self, batch: Batch, numbers: Indexes) -> None:
        """Decode messages one by one, including unusual messages."""
        for number in range(len(batch)):
            payload = batch.payload(number)
            try:
                walked = walk(self._layout, payload)
            except MalformedMessage as error:
                self._table.refused[str(error)] += 1
                continue
            message = int(numbers[number])
            for rank, place in enumerate(walked.places):
                stamp, seven = sample(payload, walked.order, place)
                self._table.append(
                    place.parent, place.child, self._static, (message, rank), stamp, seven
                )


class TemplateCutter(Cutter):
    """Decoder in numpy, which treats messages of equal length as rows of one array."""

    def __init__(self, table: Table, layout: Layout, static: bool) -> None:
        super().__init__(table, layout, static)
        self._templates: dict[int, list[Template]] = {}
        self._bytes = 0

    def _cut(self, batch: Batch, numbers: Indexes) -> None:
        lengths = batch.lengths
        # Parsing a single message costs less than making a template of it.
        if len(batch) == 1:
            self._walk(batch, numbers)
            return
        if (lengths == lengths[0]).all():
            self._cut_equal(batch, numbers, int(lengths[0]))
            return
        for length in np.unique(lengths).tolist():
            which = np.flatnonzero(lengths == length)
            self._cut_equal(batch.chosen(which), numbers[which], length)

    def _cut_equal(self, batch: Batch, numbers: Indexes, length: int) -> None:
        """Decode messages of equal length, as rows of one array."""
        # Each row has whole words around a message, so that numpy compares 8 bytes at a time.
        begin, width = row_span(self._layout, length)
        if width < SMALLEST:
            self._walk(batch, numbers)
            return
        # A row may begin before its message: the buffer needs bytes before its first message.
        if int(batch.starts.min()) + begin < 0:
            buffer = np.concatenate([np.zeros(8, dtype=np.uint8), batch.buffer])
            batch = Batch(buffer, batch.starts + 8, batch.lengths, batch.log_times, batch.senders)
        templates = self._templates.setdefault(length, [])
        rows = rows_of(batch.buffer, batch.starts + begin, width)
        tried = 0
        while len(rows):
            if tried == len(templates):
                if self._layout is CDR and int(rows[0, 0]) >> 32 != _LITTLE_HEADER:
                    # Big-endian CDR or an unknown header is rare: parse these messages one by one.
                    odd = rows[:, 0] >> np.uint64(32) != _LITTLE_HEADER
                    self._walk(batch.chosen(np.flatnonzero(odd)), numbers[odd])
                    rest = np.flatnonzero(~odd)
                    rows, numbers, batch = rows[rest], numbers[rest], batch.chosen(rest)
                    continue
                # If names change with every message, templates do not help.
                if tried >= _PER_LENGTH or not self._learn(batch.payload(0), length):
                    self._walk(batch, numbers)
                    return
            template = templates[tried]
            fits = template.fits(rows)
            if fits is None:
                self._append(template, rows, numbers)
                # Try the last matching template first next time.
                templates.insert(0, templates.pop(tried))
                return
            if fits.any():
                self._append(template, rows[fits], numbers[fits])
                rest = np.flatnonzero(~fits)
                rows, numbers, batch = rows[rest], numbers[rest], batch.chosen(rest)
            tried += 1

    def _learn(self, payload: bytes, length: int) -> bool:
        """Make a template from a message; return False if the message is malformed."""
        try:
            walked = walk(self._layout, payload)
        except MalformedMessage:
            return False
        # Limit the memory of templates: a hostile file may have a new layout in each message.
        self._bytes += 4 * length
        if self._bytes > _TEMPLATE_BYTES:
            self._bytes = 0
            self._templates = {length: self._templates[length]}
        self._templates[length].append(Template(self._layout, payload, walked))
        return True

    def _append(self, template: Template, rows: Words, numbers: Indexes) -> None:
        for rank, place in enumerate(template.places):
            edge = self._table.edge(place.parent, place.child, self._static, len(rows))
            if edge is not None:
                last = int(numbers[-1])
                share = self._table.share(last + 1)
                records, messages = edge.room((int(numbers[0]), rank), last, len(rows), share)
                template.cut(rows, place, records)
                messages[:] = numbers


class ScanCutter(Cutter):
    """Decoder in C for frequent cases; unusual messages are decoded in Python."""

    def __init__(self, table: Table, layout: Layout, static: bool) -> None:
        super().__init__(table, layout, static)
        self._pairs = SCAN.Pairs()
        self._edges: list[Growing] = []
        self._numbers: dict[Growing, int] = {}
        self._of_pair: dict[int, int] = {}

    def _cut(self, batch: Batch, numbers: Indexes) -> None:
        if len(batch.buffer) >= _MOST_SCANNED:
            self._walk(batch, numbers)
            return
        columns = map(np.ascontiguousarray, (batch.starts, batch.lengths, numbers))
        is_cdr = self._layout is CDR
        # C decodes plain messages and returns the indices of others; it calls `_aim` for each
        # new pair of names.
        left_out, odd = self._pairs.take(batch.buffer, *columns, is_cdr, self._aim)
        self._table.leave_out(left_out)
        if odd:
            which = np.frombuffer(odd, dtype=np.uint32).astype(np.int64)
            self._walk(batch.chosen(which), numbers[which])

    def _aim(self, pair: int, message: int, rank: int) -> None:
        """Provide rows for further transforms of a pair of frames; called by the C code.

        Args:
            pair: Number of the pair.
            message: Number of the message with the pair's next transform.
            rank: Index of the transform in the message.
        """
        number = self._of_pair.get(pair)
        if number is not None:
            self._give_room(number, message)
            return
        names = self._named(pair)
        edge = self._table.edge(*names, self._static, 0)
        if edge is None:
            # There are too many edges: count and drop the transforms of this pair.
            self._pairs.lead(pair, -1, False)
            return
        edge.first = min(edge.first, (message, rank))
        # Names with and without a leading slash belong to the same edge.
        number = self._numbers.setdefault(edge, len(self._edges))
        if number == len(self._edges):
            self._edges.append(edge)
        self._of_pair[pair] = number
        self._give_room(number, message)
        self._pairs.lead(pair, number, names != (edge.parent, edge.child))

    def _give_room(self, number: int, message: int) -> None:
        edge = self._edges[number]
        self._table.make_room(edge, message)
        self._pairs.aim(number, edge.records, edge.messages, edge.state)

    def _named(self, pair: int) -> tuple[str, str]:
        """Return the frame names of a pair as text: parent, child."""
        raw = self._pairs.names(pair)
        if self._layout is CDR:
            # In CDR a string's bytes include the final zero.
            raw = tuple(name.removesuffix(b"\x00") for name in raw)
        parent, child = (name.decode("utf-8", "backslashreplace") for name in raw)
        return parent, child


AnyCutter: TypeAlias = "Cutter | Decoding"
"""Decoder of a topic's messages into a table."""


def cutter(table: Table, layout: Layout, static: bool) -> Cutter:
    """Return the fastest available decoder of TFMessages in one byte layout."""
    kind = TemplateCutter if SCAN is None else ScanCutter
    return kind(table, layout, static)


class Decoding:
    """Decoder that appends transforms to a table, for messages of types other than TFMessage."""

    def __init__(self, table: Table, decode: Decoder, static: bool) -> None:
        self._table = table
        self._decode = decode
        self._static = static

    def add(self, batch: Batch, numbers: Indexes) -> None:
        """Decode messages; see `Cutter.add`."""
        for number in range(len(batch)):
            message = int(numbers[number])
            try:
                for rank, one in enumerate(self._decode(batch.payload(number))):
                    stamp, parent, child, seven = one
                    self._table.append(parent, child, self._static, (message, rank), stamp, seven)
            except TftoolError as error:
                self._table.refused[str(error)] += 1

    def flush(self) -> None:
        """Do nothing, because `add` decodes every message immediately."""


def _compacted(batch: Batch) -> Batch:
    """Copy messages to a new buffer, with 8 bytes of padding before each message."""
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
