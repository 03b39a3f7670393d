"""Reader of MCAP files, by index or sequentially up to any damage.

Source: the MCAP format specification, version 0.
"""

import struct
import zlib
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP
from tftool.messages.transform_rows import Bytes
from tftool.recordings.channel import Channel
from tftool.recordings.chunked import (
    Chunk,
    ChunkedReader,
    WalkedMessages,
    reason_of,
)
from tftool.recordings.columns import Batch, in_order, words_at
from tftool.recordings.container import (
    MOST_STREAMS,
    CopiedAttachment,
    MessageHead,
    MessageTable,
    Piece,
    check_description_size,
)
from tftool.recordings.containers import MCAP_MAGIC
from tftool.recordings.contract import Progress, Stamps
from tftool.recordings.decompression import Ahead
from tftool.recordings.mcap.format import (
    ATTACHMENT,
    CHANNEL,
    CHUNK,
    CHUNK_HEAD,
    CHUNK_INDEX,
    DATA_END,
    DATA_END_SIZE,
    FOOTER,
    FOOTER_SIZE,
    HEADER,
    IN_CHUNK,
    INDEX_HEAD,
    LONGEST_METHOD,
    MESSAGE,
    MESSAGE_HEAD,
    MESSAGE_INDEX,
    METADATA,
    RECORD,
    SCHEMA,
    STATISTICS,
    U32,
    U64,
    SingleMessages,
    entries_at,
    index_entry,
    indexed,
    records_in,
    strings_at,
    text_at,
)

_TELLING: Final = (SCHEMA, CHANNEL)
_SPARSE = 4096  # bytes that may be read in vain for each message that is read one by one
_BLOCK = 1 << 18
_INDEX_AT_ONCE = 128
_MOST_HELD: Final = 4096  # messages outside chunks in one batch

MOST_BYTES_HELD: Final = 1 << 26
"""Maximum size of messages outside chunks in one batch, bytes; the last message may exceed it."""


class Mcap(ChunkedReader):
    """Reader of an MCAP file; see `ContainerReader`."""

    kind = "MCAP"
    container = "mcap"
    magic = MCAP_MAGIC

    def __init__(self, path: Path, *, by_index: bool = True) -> None:
        """Open the file, and find its channels and chunks.

        Args:
            path: Path of the file.
            by_index: True to read messages by the index with `batches`; a missing index is built.
                False to read messages in the order of the file with `blocks`.

        Raises:
            InputError: If nothing of the file can be read.
            OSError: If the file cannot be opened.
        """
        style = {
            "profile": "",
            "library": "",
            "compression": "",
            "chunked": False,
            "with_crc": False,
            "with_chunk_crc": False,
            "chunk_size": 0,
        }
        super().__init__(path, style)
        self.is_indexed = False
        self._used_schemas: set[int] = set()
        self._schema_of: dict[int, int] = {}
        self._by_index = by_index
        self._loose = WalkedMessages()
        self._index_sizes: dict[int, int] = {}  # approximate size of a channel's message index
        self._ended_at, self._ended = 0, False
        try:
            self._open()
        except BaseException:
            self.close()
            raise

    def _open(self) -> None:
        """Find the channels and chunks by the summary; without a summary, read the whole file."""
        if not self._by_index:
            self._read_style()
        complete = False
        try:
            complete = self._read_summary()
        except (InputError, struct.error) as error:
            # Half a summary may have described wrong channels: forget them.
            self._forget()
            self.damage.append(f"The summary cannot be read ({reason_of(error)}).")
        if self._by_index and not complete:
            self._forget()
            self._index()

    def origin(self, number: int) -> tuple[int, tuple[str, str, bytes] | None]:
        """Return the number and the contents of a channel's schema; see `McapWriter.adopt`."""
        schema = self._schema_of[number]
        return schema, self.schemas[schema] if schema else None

    # Index

    def _read_style(self) -> None:
        """Detect from the first records how the file was written: profile, library, compression."""
        position = len(MCAP_MAGIC)
        try:
            # The header is the first record. Compression is a property of chunks.
            while position + 9 <= self.size:
                code, length = RECORD.unpack(self.at(position, 9))
                if code == HEADER:
                    head = self.at(position + 9, length)
                    self.style["profile"], place = text_at(head, 0)
                    self.style["library"], _ = text_at(head, place)
                elif code == CHUNK:
                    self._chunk_at(position, position + 9 + length)
                    return
                elif code in (0, MESSAGE, DATA_END, FOOTER):
                    return
                position += 9 + length
        except (InputError, struct.error):
            return

    def _read_summary(self) -> bool:
        """Read the summary at the end of the file, and return whether the summary is complete.

        Raises:
            InputError: If the summary is damaged.
            struct.error: If a record of the summary is cut.
        """
        size = self.size
        # The footer has a fixed size, so it can be found from the end of the file.
        tail = self.at(max(0, size - FOOTER_SIZE), min(size, FOOTER_SIZE))
        if not tail.endswith(MCAP_MAGIC) or tail[0] != FOOTER:
            self.damage.append("The recording was not closed.")
            return False
        (begin,) = U64.unpack_from(tail, 9)
        (crc,) = U32.unpack_from(tail, 25)
        # An offset of 0 means that the writer left the summary out.
        if not begin:
            return False
        if not len(MCAP_MAGIC) <= begin <= size - FOOTER_SIZE:
            raise InputError(f"the footer is damaged: no summary can begin at byte {begin}")
        summary = self.at(begin, size - FOOTER_SIZE - begin)
        # The CRC covers the summary, and the footer up to the CRC itself; 0 means none.
        if crc and zlib.crc32(tail[:25], zlib.crc32(summary)) != crc:
            raise InputError("the CRC is wrong")
        counts: dict[int, int] = {}
        total, span = 0, (0, 0)
        has_statistics = False
        for code, first, last in records_in(summary):
            if code in _TELLING:
                self._describe(code, summary[first:last])
            elif code == CHUNK_INDEX and self._by_index:
                self._take_entry(summary, first, last)
            elif code == STATISTICS:
                # Between total (8 bytes) and times are the numbers of other records (18 bytes).
                has_statistics = True
                (total,) = U64.unpack_from(summary, first)
                span = struct.unpack_from("<QQ", summary, first + 26)
                counts = entries_at(summary, first + 42, last)
        self.is_indexed = True
        if not self._by_index:
            data_end = self.at(begin - DATA_END_SIZE, DATA_END_SIZE)
            # Write a CRC of the data only if the input has one.
            if data_end[0] == DATA_END:
                self.style["with_crc"] = data_end[9:] != bytes(4)
            return True
        if not self._chunks and (total or not has_statistics):
            # No index contains messages outside chunks.
            return False
        # A writer may order the summary differently from the file.
        self._chunks.sort(key=lambda one: one.position)
        if has_statistics:
            self._count(counts)
        else:
            span = min(one.start for one in self._chunks), max(one.end for one in self._chunks)
            for chunk in self._chunks:
                self._count_indexed(chunk)
        self.start, self.end = (min(moment, LAST_STAMP) for moment in span)
        return True

    def _take_entry(self, summary: bytes, first: int, last: int) -> None:
        """Register a chunk from its entry in the summary."""
        entry = index_entry(summary, first, last, self.size)
        self._chunks.append(
            Chunk(
                self,
                entry.position,
                entry.place,
                entry.packed,
                entry.size,
                entry.method,
                entry.start,
                entry.end,
                indexes=dict(entry.indexes),
            )
        )

    def _forget(self) -> None:
        """Drop channels, schemas and chunks found so far, before the file is read sequentially."""
        super()._forget()
        self.is_indexed = False
        self.schemas.clear()
        self._used_schemas.clear()
        self._schema_of.clear()

    def _describe(self, code: int, body: bytes) -> None:
        """Register the schema or channel in a record; ignore a channel registered before."""
        check_description_size(len(body))
        number, schema = struct.unpack_from("<HH", body)
        if code == SCHEMA:
            name, place = text_at(body, 2)
            encoding, place = text_at(body, place)
            (length,) = U32.unpack_from(body, place)
            # Some writers repeat a schema: use the last definition before its first channel.
            if len(self.schemas) < MOST_STREAMS and number not in self._used_schemas:
                self.schemas[number] = (name, encoding, body[place + 4 : place + 4 + length])
            return
        if number in self.channels:
            return
        topic, place = text_at(body, 4)
        encoding, place = text_at(body, place)
        metadata = strings_at(body, place)
        if schema not in self.schemas:
            schema = 0  # No schema: the record that describes it is damaged.
        name, kind, data = self.schemas.get(schema, ("", "", b""))
        self._used_schemas.add(schema)
        self._schema_of[number] = schema
        self._learn(number, Channel(topic, name, encoding, kind, data, tuple(metadata.items())))

    def _count_indexed(self, chunk: Chunk) -> None:
        """Count a chunk's messages by the lengths of its message indexes."""
        for channel, place in chunk.indexes.items():
            if channel in self._numbers:
                try:
                    self._count({channel: len(self._pairs(channel, place))})
                except InputError as error:
                    self.note(f"A message index cannot be read ({error}).")

    # Sequential reading

    def _index(self) -> None:
        """Build the index of a file without an index, up to the end or first damage.

        Raises:
            InputError: If nothing of the file can be read.
        """
        self._scan(self._found_chunks())
        self._count(Counter(self._loose.channels))
        if not self._ended:
            self._note_end(self._ended_at)
        moments = [moment for one in self._chunks for moment in (one.start, one.end) if moment]
        moments += [moment for moment in self._loose.span if moment]
        if moments:
            self.start, self.end = min(min(moments), LAST_STAMP), min(max(moments), LAST_STAMP)

    def _found_chunks(self) -> Iterator[Chunk]:
        """Yield the chunks; store the messages outside chunks in `_loose`."""
        for block in self._pieces():
            if isinstance(block, Chunk):
                yield block
            else:
                self._loose.extend(block.found)

    def blocks(self) -> "Iterator[Chunk | Loose]":
        """Yield chunks, and blocks of messages between chunks; store other records in `extras`."""
        yield from self._pieces()
        if not self._ended:
            self.note(f"The recording breaks off at byte {self._ended_at}.")

    def _pieces(self) -> "Iterator[Chunk | Loose]":
        """Yield chunks, and blocks of messages outside chunks, reading record by record."""
        position, size = len(MCAP_MAGIC), self.size
        block, base, code = b"", 0, 0
        loose = Loose(self)
        self._ended = False
        while position + 9 <= size:
            if not base <= position <= base + len(block) - 64:
                # Small records follow each other, so read a block; a chunk follows a chunk.
                base, block = position, self.up_to(position, 64 if code == CHUNK else _BLOCK)
            code, length = RECORD.unpack_from(block, position - base)
            body, end = position + 9, position + 9 + length
            # After these records comes the summary, which repeats schemas and channels.
            if code in (DATA_END, FOOTER):
                self._ended = True
                break
            # The file ends within this record; only the beginning of a chunk is worth reading.
            if code == 0 or (end > size and code != CHUNK):
                break
            try:
                # Yield messages before the next chunk, to keep the order of the file.
                if len(loose) and (code not in (MESSAGE, *_TELLING) or loose.is_full(end)):
                    yield loose
                    loose = Loose(self)
                if code == CHUNK:
                    chunk = self._chunk_at(position, end)
                    yield chunk
                    if end > size:
                        break
                    end = chunk.behind
                elif code == MESSAGE:
                    check_length(length)
                    channel, _, log_time, _ = MESSAGE_HEAD.unpack_from(block, body - base)
                    loose.found.append(channel, log_time, position + IN_CHUNK, length - 22)
                elif code in _TELLING:
                    check_description_size(length)
                    self._describe(code, self.at(body, length))
                elif not self._by_index:
                    self._take_extra(code, position, length)
            except (InputError, struct.error) as error:
                # The length of the record is known, so reading continues after it.
                self.note(f"A record at byte {position} cannot be read ({reason_of(error)}).")
                if end > size:
                    break
            position = end
        self._ended_at = position
        if len(loose):
            yield loose

    def _chunk_at(self, position: int, end: int) -> Chunk:
        """Parse the header of a chunk record, and the message indexes after the chunk."""
        stop = min(end, self.size)
        # The head is short: RECORD 9, CHUNK_HEAD 28, name of the compression, size 8.
        head = self.at(position, min(stop - position, 256))
        low, high, size, crc = CHUNK_HEAD.unpack_from(head, 9)
        (length,) = U32.unpack_from(head, 37)
        if length > LONGEST_METHOD:
            raise InputError(
                f"the name of a chunk's compression has {length} bytes, and at most "
                f"{LONGEST_METHOD} are allowed"
            )
        method = head[41 : 41 + length].decode("utf-8", "surrogateescape")
        (packed,) = U64.unpack_from(head, 41 + length)
        place = position + 49 + length
        # A recorder that was killed leaves a chunk with fewer bytes than stated.
        there = min(packed, stop - place)
        chunk = Chunk(
            self,
            position,
            place,
            there,
            size,
            method,
            min(low, LAST_STAMP),
            min(high, LAST_STAMP),
            crc,
            end > self.size or there < packed,
            stop - position,
            stop,
        )
        style = self.style
        style["chunked"] = True
        style["compression"] = method or "none"
        style["with_chunk_crc"] = bool(crc)
        style["chunk_size"] = max(style["chunk_size"], size)
        if not chunk.cut:
            self._read_indexes(chunk)
        known = chunk.counts is not None and chunk.counts.keys() <= self.channels.keys()
        # Without a summary, records in the chunk may be the only description of later channels.
        chunk.whole = known and self.is_indexed
        return chunk

    def _read_indexes(self, chunk: Chunk) -> None:
        """Read the message indexes after a chunk into the chunk's fields."""
        counts: dict[int, int] = {}
        position = chunk.behind
        while position + 15 <= self.size:
            code, length, channel, entries = INDEX_HEAD.unpack(self.at(position, 15))
            end = position + 9 + length
            if code != MESSAGE_INDEX or end > self.size:
                break
            if entries != length - 6 or entries % 16:
                # One message index is damaged, so the others are incomplete.
                chunk.indexes.clear()
                return
            if entries:
                counts[channel] = counts.get(channel, 0) + entries // 16
            chunk.indexes[channel] = position
            position = end
        chunk.behind = position
        if chunk.indexes:
            chunk.counts = counts

    def _take_extra(self, code: int, position: int, length: int) -> None:
        """Add an attachment or metadata record to `extras`; ignore other records."""
        if code == ATTACHMENT:
            self._take_attachment(position, length)
        elif code == METADATA:
            self.extras.metadata.append(self.at(position + 9, length))

    def _take_attachment(self, position: int, length: int) -> None:
        """Add an attachment to `extras` as a byte range: its bytes may not fit into memory."""
        body = position + 9
        # Two times of 8 bytes, then name and media type, then the size of the data.
        place = body + 16
        for _ in range(2):
            (size,) = U32.unpack(self.at(place, 4))
            place += 4 + size
        end = body + length - 4
        if place + 8 > end:
            raise InputError("the record is too short for an attachment")
        names = self.at(body + 16, place - body - 16)
        (size,) = U64.unpack(self.at(place, 8))
        (crc,) = U32.unpack(self.at(end, 4))
        if crc and Piece(self.fileno(), body, length - 4).crc() != crc:
            self.note(f"The CRC of the attachment at byte {position} is wrong: it is left out.")
            return
        whole = Piece(self.fileno(), position, 9 + length)
        self.extras.attachments.append(CopiedAttachment(whole, self.at(body, 16), names, size))

    def _heads(self, data: bytes, *, learns: bool) -> Iterator[MessageHead]:
        """Yield the headers of the messages in some records; see `ChunkedReader`."""
        for code, first, last in records_in(data):
            if code == MESSAGE:
                check_length(last - first)
                channel, sequence, log_time, publish_time = MESSAGE_HEAD.unpack_from(data, first)
                yield MessageHead(channel, log_time, first + 22, last, publish_time, sequence)
            elif learns and code in _TELLING:
                self._describe(code, data[first:last])

    def _parts(self, chunk: Chunk, data: Bytes) -> Iterator[tuple[int, Stamps, Stamps, Stamps]]:
        """Yield the offsets of the messages in a chunk; see `ChunkedReader`."""
        for channel, place in chunk.indexes.items():
            pairs = self._pairs(channel, place)
            if len(pairs):
                starts, lengths, _ = indexed(data, pairs, channel)
                yield channel, pairs[:, 1], starts, lengths

    def _moments(self, data: Bytes, starts: Stamps) -> tuple[Stamps, Stamps, Stamps]:
        """Return log times, publish times and sequence numbers; see `ChunkedReader`."""
        # Before the payload: sequence number 4, log time 8, publish time 8.
        log_times = np.minimum(words_at(data, starts - 16, "<u8"), LAST_STAMP).astype(np.int64)
        return log_times, words_at(data, starts - 8, "<u8"), words_at(data, starts - 20, "<u4")

    # Messages

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams in batches; see `Container`."""
        chosen = self._chosen(wanted)
        singly = SingleMessages(self, chosen, head)

        def batch_of(chunk: Chunk, ahead: Ahead) -> Batch | None:
            return self._batch(chunk, chosen, singly, ahead)

        for chunk, batch in self._chunk_batches(chosen, batch_of):
            # Messages read one by one before this batch must be yielded first.
            if singly.is_full or (batch is not None and len(singly)):
                yield singly.taken()
            if batch is not None:
                yield batch
            if progress is not None:
                progress(chunk.place + chunk.packed, self.size)
        if len(singly):
            yield singly.taken()
        yield from self._loose_batches(chosen, progress, head)

    def _batch(
        self, chunk: Chunk, chosen: Mapping[int, int], singly: SingleMessages, ahead: Ahead
    ) -> Batch | None:
        """Return a chunk's messages on chosen channels as a batch.

        Return None if there are no such messages. Return None also if there are few messages in
        a large chunk: then `singly` reads these messages.
        """
        parts = []
        for channel, place in chunk.indexes.items():
            if channel in chosen:
                pairs = self._pairs(channel, place)
                if len(pairs):
                    parts.append((pairs, channel))
        if not parts:
            return None
        count = sum(len(pairs) for pairs, _ in parts)
        # Few transforms between large images: read them alone, not the whole chunk.
        if not chunk.is_packed and count * _SPARSE < chunk.packed:
            places = sorted(place for pairs, _ in parts for place in pairs[:, 1].tolist())
            singly.read(places, chunk.place, chunk.place + chunk.packed)
            return None
        data = np.frombuffer(self.unpacked(chunk, ahead), dtype=np.uint8)
        return in_order(
            [
                Batch(data, *indexed(data, pairs, channel), senders)
                for pairs, channel in parts
                for senders in [np.full(len(pairs), chosen[channel], dtype=np.int32)]
            ]
        )

    def _loose_batches(
        self, chosen: Mapping[int, int], progress: Progress | None, head: int | None
    ) -> Iterator[Batch]:
        """Yield the messages outside chunks in batches."""
        singly = SingleMessages(self, chosen, head)
        for channel, start in zip(self._loose.channels, self._loose.starts, strict=True):
            if channel not in chosen:
                continue
            # Only offsets were stored while the file was scanned.
            place = start - IN_CHUNK
            try:
                singly.read([place], 0, self.size)
            except InputError as error:
                self.note(f"A message at byte {place} cannot be read ({error}).")
            if singly.is_full:
                yield singly.taken()
                if progress is not None:
                    progress(place, self.size)
        if len(singly):
            yield singly.taken()

    def _pairs(self, channel: int, place: int) -> Stamps:
        """Return log time and offset of each message in a message index, shape (n, 2)."""
        # Usually one read is enough: the channel's last message index was about as long.
        guess = self._index_sizes.get(channel, _INDEX_AT_ONCE)
        head = self.up_to(place, guess)
        code, length, told, count = INDEX_HEAD.unpack_from(head)
        # A wrong count must not make this read more than the record has.
        if code != MESSAGE_INDEX or told != channel or count > length - 6 or count % 16:
            raise InputError(f"no message index is at byte {place}")
        if 15 + count > len(head):
            head = self.at(place, 15 + count)
        self._index_sizes[channel] = max(15 + count * 17 // 16, _INDEX_AT_ONCE)
        pairs = np.frombuffer(head, dtype=np.int64, count=count // 8, offset=15)
        return pairs.reshape(-1, 2)


class Loose:
    """Consecutive messages outside chunks; see `Block`."""

    whole = False
    counts: Mapping[int, int] | None = None

    def __init__(self, reader: Mcap) -> None:
        """Create an empty block."""
        self.found = WalkedMessages()
        self._reader = reader

    def __len__(self) -> int:
        return len(self.found)

    @property
    def start(self) -> int:
        """Log time of the block's first message, nanoseconds."""
        return self.found.span[0]

    @property
    def end(self) -> int:
        """Log time of the block's last message, nanoseconds."""
        return self.found.span[1]

    def is_full(self, end: int) -> bool:
        """Whether a further message that ends at `end` would make the block too large."""
        too_long = end - self.found.starts[0] > MOST_BYTES_HELD
        return too_long or len(self) >= _MOST_HELD

    def sound(self) -> bool:
        """Return True, because there are no checksums outside chunks."""
        return True

    def table(self) -> MessageTable:
        """Read the block's messages, and return a table of the messages."""
        reader, found = self._reader, self.found
        begin = found.starts[0] - IN_CHUNK
        # One read for all messages, with the few small records between them.
        try:
            data = reader.at(begin, found.starts[-1] + found.lengths[-1] - begin)
        except InputError as error:
            reader.note(f"A record at byte {begin} cannot be read ({error}).")
            return MessageTable.of(b"", [])
        heads = []
        for start, length in zip(found.starts, found.lengths, strict=True):
            first = start - begin
            channel, sequence, log_time, publish_time = MESSAGE_HEAD.unpack_from(data, first - 22)
            last = first + length
            heads.append(MessageHead(channel, log_time, first, last, publish_time, sequence))
        return reader.known(MessageTable.of(data, heads))


def check_length(length: int) -> None:
    """Check the length of a message record.

    Raises:
        InputError: If the record is shorter than the header of a message.
    """
    if length < MESSAGE_HEAD.size:
        raise InputError(f"a message record has only {length} bytes")
