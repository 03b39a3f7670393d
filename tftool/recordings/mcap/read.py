"""MCAP, by its index where there is one, else from front to back up to the damage.

Source: the MCAP format specification, version 0.
"""

import itertools
import struct
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP
from tftool.recordings.columns import Batch, in_order, words_at
from tftool.recordings.container import (
    MOST_STREAMS,
    ChunkedFile,
    MessageStream,
    Offers,
    check_told,
    offers_of,
)
from tftool.recordings.contract import Indexes, Progress, Stamps
from tftool.recordings.decompression import Ahead
from tftool.recordings.find import MCAP_MAGIC
from tftool.recordings.mcap.format import (
    IN_CHUNK,
    MESSAGE,
    U32,
    IndexedChunk,
    SingleMessages,
    WalkedMessages,
    chunk_of_index,
    entries_at,
    indexed,
    reason_of,
    records_in,
    strings_at,
    text_at,
)

_FOOTER: Final = 0x02
_SCHEMA: Final = 0x03
_CHANNEL: Final = 0x04
_TELLING: Final = (_SCHEMA, _CHANNEL)
_CHUNK: Final = 0x06
_MESSAGE_INDEX: Final = 0x07
_CHUNK_INDEX: Final = 0x08
_STATISTICS: Final = 0x0B
_DATA_END: Final = 0x0F

_RECORD = struct.Struct("<BQ")
_INDEX_HEAD = struct.Struct("<BQHI")
_CHUNK_HEAD = struct.Struct("<QQQII")
_MESSAGE_HEAD = struct.Struct("<HIQQ")
_U16, _U64 = struct.Struct("<H"), struct.Struct("<Q")

_FOOTER_SIZE = 37
_SPARSE = 4096  # bytes that one message more is worth when reading them singly
_BLOCK = 1 << 18
_INDEX_AT_ONCE = 128


class Mcap:
    """An MCAP file; see `Container`."""

    kind = "MCAP"

    def __init__(self, path: Path) -> None:
        """Open it and find out what is in it.

        Raises:
            InputError: If nothing of it can be read.
            OSError: If the file cannot be opened.
        """
        self._file = ChunkedFile(path)
        self.size = self._file.size
        self.start = self.end = 0
        self.streams: list[MessageStream] = []
        self.counts: list[int] = []
        self.damage = self._file.damage
        self.profile = ""
        self._schemas: dict[int, tuple[str, str, bytes]] = {}
        self._used_schemas: set[int] = set()
        self._numbers: dict[int, int] = {}  # of a channel: its stream
        self._chunks: list[IndexedChunk] = []
        self._loose = WalkedMessages()
        self._index_sizes: dict[int, int] = {}  # of a channel: bytes that one takes, about
        try:
            self._open(path)
        except BaseException:
            self.close()
            raise

    def _open(self, path: Path) -> None:
        """Find out what is in it, by its index or without."""
        if self._file.up_to(0, len(MCAP_MAGIC)) != MCAP_MAGIC:
            raise InputError(f"'{path}' is no MCAP file.")
        try:
            complete = self._read_summary()
        except (InputError, struct.error, UnicodeDecodeError) as error:
            complete = False
            self.damage.append(f"Its summary cannot be read ({reason_of(error)}).")
        if not complete:
            self._scan()

    @property
    def bytes_read(self) -> int:
        """Return the bytes of the file that have been read so far."""
        return self._file.read

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    # What is in it

    def _read_summary(self) -> bool:
        """Take what the summary tells; whether that is all there is to know."""
        size = self.size
        if size < len(MCAP_MAGIC) + _FOOTER_SIZE:
            return False
        tail = self._file.at(size - _FOOTER_SIZE, _FOOTER_SIZE)
        if not tail.endswith(MCAP_MAGIC) or tail[0] != _FOOTER:
            self.damage.append("The recording was not closed.")
            return False
        (begin,) = _U64.unpack_from(tail, 9)
        if begin == 0:
            return False
        end = size - _FOOTER_SIZE
        if not len(MCAP_MAGIC) <= begin <= end:
            raise InputError(f"it should begin at byte {begin}")
        summary = self._file.at(begin, end - begin)
        chunks: list[IndexedChunk] = []
        counts: dict[int, int] = {}
        total, span = 0, (0, 0)
        has_statistics = False
        for code, first, last in records_in(summary):
            if code in _TELLING:
                self._learn(code, summary, first, last)
            elif code == _CHUNK_INDEX:
                chunks.append(chunk_of_index(summary, first, last, size))
            elif code == _STATISTICS:
                has_statistics = True
                (total,) = _U64.unpack_from(summary, first)
                span = struct.unpack_from("<QQ", summary, first + 26)
                counts = entries_at(summary, first + 42, last)
        if not chunks and (total or not has_statistics):
            # Messages outside chunks stand in no index.
            self._forget()
            return False
        for channel, count in counts.items():
            if channel in self._numbers:
                self.counts[self._numbers[channel]] += count
        if not has_statistics:
            span = min(one.start for one in chunks), max(one.end for one in chunks)
        self.start, self.end = (min(moment, LAST_STAMP) for moment in span)
        self._chunks = sorted(chunks, key=lambda one: one.place)
        if not has_statistics:
            for chunk in chunks:
                self._count(chunk)
        return True

    def _forget(self) -> None:
        self.streams.clear()
        self.counts.clear()
        self._numbers.clear()

    def _learn(self, code: int, data: bytes, first: int, last: int) -> None:
        """Take what a record tells of a schema or a channel; its body lies there."""
        check_told(last - first)
        (self._take_schema if code == _SCHEMA else self._take_channel)(data[first:last])

    def _take_schema(self, body: bytes) -> None:
        (number,) = _U16.unpack_from(body)
        name, place = text_at(body, 2)
        encoding, place = text_at(body, place)
        (length,) = U32.unpack_from(body, place)
        # Some writers repeat a schema: the last definition counts, until a channel names it.
        if len(self._schemas) < MOST_STREAMS and number not in self._used_schemas:
            self._schemas[number] = (name, encoding, body[place + 4 : place + 4 + length])

    def _take_channel(self, body: bytes) -> None:
        channel, schema = struct.unpack_from("<HH", body)
        if channel in self._numbers:
            return
        topic, place = text_at(body, 4)
        encoding, place = text_at(body, place)
        metadata = strings_at(body, place)
        name, kind, data = self._schemas.get(schema, ("", "", b""))
        self._used_schemas.add(schema)
        definition = ""
        if kind in ("ros2msg", "ros2idl", "ros1msg", "jsonschema"):
            definition = data.decode("utf-8", "backslashreplace")
        node = metadata.get("callerid", "")
        offers = offers_of(metadata.get("offered_qos_profiles", ""))
        if metadata.get("latching") == "1":
            offers = Offers("transient_local", "", 1)
        self._numbers[channel] = len(self.streams)
        self.streams.append(MessageStream(topic, name, encoding, definition, node, offers))
        self.counts.append(0)

    def _count(self, chunk: IndexedChunk) -> None:
        """Count a chunk's messages by its message indexes' lengths."""
        for channel, place in chunk.indexes.items():
            number = self._numbers.get(channel)
            if number is None:
                continue
            try:
                self.counts[number] += len(self._pairs(channel, place))
            except InputError as error:
                self._file.note(f"A message index cannot be read ({error}).")

    # From front to back

    def _scan(self) -> None:
        """Find out what is in a file without an index, up to its end or its damage."""
        self._forget()
        self._schemas.clear()
        self._used_schemas.clear()
        position, ended = self._find_records()
        self._count_found()
        found = sum(self.counts)
        if not ended:
            self.damage.append(
                f"The recording breaks off at byte {position} of {self.size}: "
                f"{found} messages were read up to there."
            )
        if not found and not self.streams and not ended:
            raise InputError(
                f"'{self._file.path}' is damaged: no message could be read ({self.damage[-1]})"
            )

    def _find_records(self) -> tuple[int, bool]:
        """Take in chunks, messages and what tells of them, record by record.

        Returns:
            Where the last whole record ends, and whether the file says that it ends there.
        """
        file, size = self._file, self.size
        position, block, base = len(MCAP_MAGIC), b"", 0
        while position + 9 <= size:
            if not base <= position <= base + len(block) - 64:
                base, block = position, file.up_to(position, _BLOCK)
            code, length = _RECORD.unpack_from(block, position - base)
            body = position + 9
            whole = body + length <= size
            if code == 0 or (not whole and code not in (_CHUNK, MESSAGE)):
                break
            if code in (_FOOTER, _DATA_END):
                return position, True
            try:
                if code == _CHUNK:
                    self._take_chunk(body, min(length, size - body), not whole)
                elif code == MESSAGE and whole:
                    _check_length(length)
                    if body - base + 22 > len(block):
                        base, block = position, file.up_to(position, _BLOCK)
                    channel, _, log_time, _ = _MESSAGE_HEAD.unpack_from(block, body - base)
                    self._loose.append(channel, log_time, position)
                elif code == _MESSAGE_INDEX and self._chunks and length >= 6:
                    (channel,) = _U16.unpack(file.at(body, 2))
                    self._chunks[-1].indexes[channel] = position
                elif code in _TELLING:
                    check_told(length)
                    self._learn(code, file.at(body, length), 0, length)
            except (InputError, struct.error) as error:
                self._file.note(f"A record at byte {position} cannot be read ({reason_of(error)}).")
            if not whole:
                break
            position = body + length
        return position, False

    def _count_found(self) -> None:
        """Count the messages of what was found, and see when they begin and end."""
        for chunk in self._chunks:
            # A chunk's own records tell of channels that have not come up before.
            if not chunk.indexes or not chunk.indexes.keys() <= self._numbers.keys():
                self._walk(chunk, learns=True)
            else:
                self._count(chunk)
        for channel in self._loose.channels:
            if channel in self._numbers:
                self.counts[self._numbers[channel]] += 1
        moments = [moment for one in self._chunks for moment in (one.start, one.end) if moment]
        moments += [f(self._loose.log_times) for f in (min, max) if self._loose.log_times]
        if moments:
            self.start = min(min(moments), LAST_STAMP)
            self.end = min(max(moments), LAST_STAMP)

    def _take_chunk(self, body: int, length: int, cut: bool) -> None:
        head = self._file.up_to(body, min(length, 256))
        start, end, size, _, name = _CHUNK_HEAD.unpack_from(head)
        if name > 64:
            raise InputError(f"a compression's name announces {name} bytes")
        method = head[32 : 32 + name].decode("utf-8", "backslashreplace")
        (packed,) = _U64.unpack_from(head, 32 + name)
        place = body + 40 + name
        there = min(packed, body + length - place)
        self._chunks.append(
            IndexedChunk(place, there, size, method, start, end, cut=cut or there < packed)
        )

    def _walk(self, chunk: IndexedChunk, *, learns: bool) -> None:
        """Walk through a chunk's records and learn where its messages are.

        Args:
            chunk: The chunk.
            learns: Whether to count them, and to learn of channels: those that were found when
                the file was opened stay as they are.
        """
        found = chunk.walked = WalkedMessages()
        numbers, counts = self._numbers, self.counts
        low, high = LAST_STAMP, 0
        try:
            data = bytes(self._file.unpacked(chunk))
            for code, first, last in records_in(data):
                if code == MESSAGE:
                    _check_length(last - first)
                    channel, _, log_time, _ = _MESSAGE_HEAD.unpack_from(data, first)
                    found.append(channel, log_time, first - 9)
                    low, high = min(low, log_time), max(high, log_time)
                    number = numbers.get(channel)
                    if learns and number is not None:
                        counts[number] += 1
                elif learns and code in _TELLING:
                    self._learn(code, data, first, last)
        except (InputError, struct.error) as error:
            if not chunk.cut:
                self._file.note_chunk(chunk, reason_of(error))
        if chunk.cut or len(found.places):
            # What is announced may not have been reached.
            chunk.start, chunk.end = (low, high) if len(found.places) else (0, 0)

    # Messages

    def expected(self, wanted: Collection[int]) -> int:
        """Return the messages of some streams, as the file counts them."""
        return sum(self.counts[number] for number in wanted)

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """The messages of some streams; see `Container`."""
        channels = np.full(65_536, -1, dtype=np.int32)
        for channel, number in self._numbers.items():
            if number in wanted:
                channels[channel] = number
        chosen = {channel for channel, number in self._numbers.items() if number in wanted}
        read = [
            chunk.walked is not None or not chunk.indexes.keys().isdisjoint(chosen)
            for chunk in self._chunks
        ]
        # Those that were walked are unpacked then and there; the others in order.
        with Ahead(itertools.compress(self._chunks, read), self._file.packed) as ahead:
            yield from self._chunk_batches(read, chosen, channels, ahead, progress, head)
        yield from self._loose_batches(channels, progress, head)

    def _chunk_batches(
        self,
        read: list[bool],
        chosen: set[int],
        channels: Indexes,
        ahead: Ahead,
        progress: Progress | None,
        head: int | None,
    ) -> Iterator[Batch]:
        singly = SingleMessages(self._file, channels, head)
        for chunk, is_read in zip(self._chunks, read, strict=True):
            batch = None
            if is_read:
                try:
                    batch = self._batch(chunk, chosen, channels, singly, ahead)
                except (InputError, struct.error) as error:
                    self._file.note_chunk(chunk, reason_of(error))
                    try:
                        batch = self._rest_of(chunk, channels)
                    except (InputError, struct.error) as worse:
                        self._file.note(
                            f"A chunk at byte {chunk.place} is lost ({reason_of(worse)})."
                        )
            # What was read singly before it comes before it.
            if singly.is_full or (batch is not None and len(singly)):
                yield singly.taken()
            if batch is not None and len(batch):
                yield batch
            if progress is not None:
                progress(chunk.place + chunk.packed, self.size)
        if len(singly):
            yield singly.taken()

    def _batch(
        self,
        chunk: IndexedChunk,
        chosen: set[int],
        channels: Indexes,
        singly: SingleMessages,
        ahead: Ahead,
    ) -> Batch | None:
        """A chunk's messages; None where there are none, or they were read singly."""
        if chunk.walked is not None:
            return self._rest_of(chunk, channels, ahead)
        parts = []
        for channel, place in chunk.indexes.items():
            if channel in chosen:
                pairs = self._pairs(channel, place)
                if len(pairs):
                    parts.append((pairs, channel))
        if not parts:
            return None
        count = sum(len(pairs) for pairs, _ in parts)
        if chunk.method in ("", "none") and count * _SPARSE < chunk.packed:
            places = sorted(place for pairs, _ in parts for place in pairs[:, 1].tolist())
            singly.read(places, chunk.place, chunk.place + chunk.packed)
            return None
        data = np.frombuffer(self._file.unpacked(chunk, ahead), dtype=np.uint8)
        return in_order(
            [
                Batch(data, *indexed(data, pairs, channel), np.full(len(pairs), channels[channel]))
                for pairs, channel in parts
            ]
        )

    def _rest_of(
        self, chunk: IndexedChunk, channels: Indexes, ahead: Ahead | None = None
    ) -> Batch | None:
        """What walking finds in a chunk, whatever its index says."""
        if chunk.walked is None:
            self._walk(chunk, learns=False)
        walked = chunk.walked
        assert walked is not None
        if not len(walked.places):
            return None
        owners = np.frombuffer(walked.channels, dtype=np.uint16)
        which = np.flatnonzero(channels[owners] >= 0)
        if not len(which):
            return None
        data = np.frombuffer(self._file.unpacked(chunk, ahead), dtype=np.uint8)
        places = np.frombuffer(walked.places, dtype=np.int64)[which]
        return Batch(
            data,
            places + IN_CHUNK,
            words_at(data, places + 1, "<i8") - 22,
            np.frombuffer(walked.log_times, dtype=np.int64)[which],
            channels[owners[which]],
        )

    def _loose_batches(
        self, channels: Indexes, progress: Progress | None, head: int | None
    ) -> Iterator[Batch]:
        """Messages outside chunks."""
        if not len(self._loose.channels):
            return
        owners = np.frombuffer(self._loose.channels, dtype=np.uint16)
        places = np.frombuffer(self._loose.places, dtype=np.int64)[channels[owners] >= 0]
        singly = SingleMessages(self._file, channels, head)
        for place in places.tolist():
            try:
                singly.read([place], 0, self.size)
            except InputError as error:
                self._file.note(f"A message at byte {place} cannot be read ({error}).")
            if singly.is_full:
                yield singly.taken()
                if progress is not None:
                    progress(place, self.size)
        if len(singly):
            yield singly.taken()

    def _pairs(self, channel: int, place: int) -> Stamps:
        """Log time and place of each message that a message index tells, shape (n, 2)."""
        # As a rule all of one at once: that of the chunk before was about as long.
        guess = self._index_sizes.get(channel, _INDEX_AT_ONCE)
        head = self._file.up_to(place, guess)
        code, length, told, count = _INDEX_HEAD.unpack_from(head)
        if code != _MESSAGE_INDEX or told != channel or count > length - 6 or count % 16:
            raise InputError(f"no message index of its is at byte {place}")
        if 15 + count > len(head):
            head = self._file.at(place, 15 + count)
        self._index_sizes[channel] = max(15 + count * 17 // 16, _INDEX_AT_ONCE)
        pairs = np.frombuffer(head, dtype=np.int64, count=count // 8, offset=15)
        return pairs.reshape(-1, 2)


def _check_length(length: int) -> None:
    if length < _MESSAGE_HEAD.size:
        raise InputError(f"a message's record announces {length} bytes")
