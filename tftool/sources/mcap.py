"""MCAP, by its index where there is one, else from front to back up to the damage.

Source: the MCAP format specification, version 0.
"""

import itertools
import struct
from array import array
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np

from tftool.errors import InputError
from tftool.sources.columns import Batch, in_order, words_at
from tftool.sources.compressed import Ahead
from tftool.sources.container import (
    LATEST_STAMP,
    MOST_STREAMS,
    File,
    MessageStream,
    Offers,
    offers_of,
    packed_piece,
    unpacked_piece,
)
from tftool.sources.contract import Indexes, Progress, Stamps
from tftool.sources.find import MCAP_MAGIC
from tftool.wire.native import SCAN
from tftool.wire.rows import Bytes, rows_of

_FOOTER: Final = 0x02
_SCHEMA: Final = 0x03
_CHANNEL: Final = 0x04
_MESSAGE: Final = 0x05
_CHUNK: Final = 0x06
_MESSAGE_INDEX: Final = 0x07
_CHUNK_INDEX: Final = 0x08
_STATISTICS: Final = 0x0B
_DATA_END: Final = 0x0F

_RECORD = struct.Struct("<BQ")
_INDEX_HEAD = struct.Struct("<BQHI")
_CHUNK_HEAD = struct.Struct("<QQQII")
_MESSAGE_HEAD = struct.Struct("<HIQQ")
_MESSAGE_RECORD = struct.Struct("<BQHIQ")
_CHUNK_INDEX_HEAD = struct.Struct("<QQQQI")
_SIZES = struct.Struct("<QQ")
_U16, _U32, _U64 = struct.Struct("<H"), struct.Struct("<I"), struct.Struct("<Q")
_ENTRY = struct.Struct("<HQ")

_IN_CHUNK = 31  # what lies before a message's payload: 9 of the record, 22 of the message
_FOOTER_SIZE = 37
_LARGEST_SUMMARY = 1 << 30
_SPARSE = 4096  # bytes that one message more is worth when reading them singly
_BLOCK = 1 << 18
_INDEX_AT_ONCE = 512
_LARGEST_BATCH = 1 << 22  # bytes of messages that are read singly


@dataclass(slots=True, eq=False)
class _Chunk:
    """One chunk, and where its messages lie.

    Attributes:
        place: Where its records begin in the file, packed.
        packed: Bytes of them there.
        size: Bytes of them unpacked.
        method: How they are packed.
        start: Log time of its first message.
        end: Of its last.
        indexes: For each channel where its message index lies in the file.
        walked: In their place, where there is none: channel, log time and place of each
            message, found by walking.
        cut: Whether the file ends within it.
    """

    place: int
    packed: int
    size: int
    method: str
    start: int
    end: int
    indexes: dict[int, int] = field(default_factory=dict)
    walked: "_Messages | None" = None
    cut: bool = False


class _Messages:
    """Messages that were found by walking, as columns."""

    __slots__ = ("channels", "log_times", "places")

    def __init__(self) -> None:
        self.channels = array("H")
        self.log_times = array("q")
        self.places = array("q")

    def append(self, channel: int, log_time: int, place: int) -> None:
        self.channels.append(channel)
        self.log_times.append(min(log_time, LATEST_STAMP))
        self.places.append(place)


class Mcap:
    """An MCAP file; see `Container`."""

    kind = "MCAP"

    def __init__(self, path: Path) -> None:
        """Open it and find out what is in it.

        Raises:
            InputError: If nothing of it can be read.
            OSError: If the file cannot be opened.
        """
        self._file = File(path)
        self.size = self._file.size
        self.start = self.end = 0
        self.streams: list[MessageStream] = []
        self.counts: list[int] = []
        self.damage: list[str] = []
        self.profile = ""
        self._schemas: dict[int, tuple[str, str, bytes]] = {}
        self._numbers: dict[int, int] = {}  # of a channel: its stream
        self._chunks: list[_Chunk] = []
        self._loose = _Messages()
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
            self.damage.append(f"Its summary cannot be read ({_reason(error)}).")
        if not complete:
            self._scan()

    @property
    def bytes_read(self) -> int:
        """How many bytes of the file have been read so far."""
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
        if not len(MCAP_MAGIC) <= begin <= end or end - begin > _LARGEST_SUMMARY:
            raise InputError(f"it should begin at byte {begin}")
        summary = self._file.at(begin, end - begin)
        chunks: list[_Chunk] = []
        counts: dict[int, int] = {}
        total, span = 0, (0, 0)
        has_statistics = False
        for code, first, last in _records(summary):
            if code == _SCHEMA:
                self._take_schema(summary[first:last])
            elif code == _CHANNEL:
                self._take_channel(summary[first:last])
            elif code == _CHUNK_INDEX:
                chunks.append(_chunk_of_index(summary, first, last, size))
            elif code == _STATISTICS:
                has_statistics = True
                (total,) = _U64.unpack_from(summary, first)
                span = struct.unpack_from("<QQ", summary, first + 26)
                counts = _entries(summary, first + 42, last)
        if not chunks and (total or not has_statistics):
            # Messages outside chunks stand in no index.
            self._forget()
            return False
        for channel, count in counts.items():
            if channel in self._numbers:
                self.counts[self._numbers[channel]] += count
        if not has_statistics:
            span = min(one.start for one in chunks), max(one.end for one in chunks)
        self.start, self.end = (min(moment, LATEST_STAMP) for moment in span)
        self._chunks = sorted(chunks, key=lambda one: one.place)
        if not has_statistics:
            for chunk in chunks:
                self._count(chunk)
        return True

    def _forget(self) -> None:
        self.streams.clear()
        self.counts.clear()
        self._numbers.clear()

    def _take_schema(self, body: bytes) -> None:
        (number,) = _U16.unpack_from(body)
        name, place = _text(body, 2)
        encoding, place = _text(body, place)
        (length,) = _U32.unpack_from(body, place)
        if len(self._schemas) < MOST_STREAMS:
            self._schemas[number] = (name, encoding, body[place + 4 : place + 4 + length])

    def _take_channel(self, body: bytes) -> None:
        channel, schema = struct.unpack_from("<HH", body)
        if channel in self._numbers:
            return
        topic, place = _text(body, 4)
        encoding, place = _text(body, place)
        metadata = _strings(body, place)
        name, kind, data = self._schemas.get(schema, ("", "", b""))
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

    def _count(self, chunk: _Chunk) -> None:
        """Count a chunk's messages by its message indexes' lengths."""
        for channel, place in chunk.indexes.items():
            number = self._numbers.get(channel)
            if number is None:
                continue
            try:
                self.counts[number] += len(self._pairs(channel, place))
            except InputError as error:
                self._note(f"A message index cannot be read ({error}).")

    # From front to back

    def _scan(self) -> None:
        """Find chunks and messages record by record, up to the end or the damage."""
        self._forget()
        self._schemas.clear()
        file, size = self._file, self.size
        position, block, base = len(MCAP_MAGIC), b"", 0
        ended = False
        while position + 9 <= size:
            if not base <= position <= base + len(block) - 64:
                base, block = position, file.up_to(position, _BLOCK)
            code, length = _RECORD.unpack_from(block, position - base)
            body = position + 9
            whole = body + length <= size
            if code == 0 or (not whole and code not in (_CHUNK, _MESSAGE)):
                break
            if code in (_FOOTER, _DATA_END):
                ended = True
                break
            try:
                if code == _CHUNK:
                    self._take_chunk(body, min(length, size - body), not whole)
                elif code == _MESSAGE and whole:
                    if body - base + 22 > len(block):
                        base, block = position, file.up_to(position, _BLOCK)
                    channel, _, log_time, _ = _MESSAGE_HEAD.unpack_from(block, body - base)
                    self._loose.append(channel, log_time, position)
                elif code == _MESSAGE_INDEX and self._chunks and length >= 6:
                    (channel,) = _U16.unpack(file.at(body, 2))
                    self._chunks[-1].indexes[channel] = position
                elif code == _SCHEMA:
                    self._take_schema(file.at(body, length))
                elif code == _CHANNEL:
                    self._take_channel(file.at(body, length))
            except (InputError, struct.error) as error:
                self._note(f"A record at byte {position} cannot be read ({_reason(error)}).")
            if not whole:
                break
            position = body + length
        for chunk in self._chunks:
            # A chunk's own records tell of channels that have not come up before.
            if not chunk.indexes or not chunk.indexes.keys() <= self._numbers.keys():
                self._walk(chunk)
            else:
                self._count(chunk)
        for channel in self._loose.channels:
            if channel in self._numbers:
                self.counts[self._numbers[channel]] += 1
        found = sum(self.counts)
        if not ended:
            self.damage.append(
                f"The recording breaks off at byte {position} of {size}: "
                f"{found} messages were read up to there."
            )
        if not found and not self.streams and not ended:
            raise InputError(
                f"'{file.path}' is damaged: no message could be read ({self.damage[-1]})"
            )
        moments = [moment for one in self._chunks for moment in (one.start, one.end) if moment]
        moments += [f(self._loose.log_times) for f in (min, max) if self._loose.log_times]
        if moments:
            self.start = min(min(moments), LATEST_STAMP)
            self.end = min(max(moments), LATEST_STAMP)

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
            _Chunk(place, there, size, method, start, end, cut=cut or there < packed)
        )

    def _walk(self, chunk: _Chunk) -> None:
        """Walk through a chunk's records; learn its channels, and where its messages are."""
        found = chunk.walked = _Messages()
        data = bytes(unpacked_piece(self._file, chunk, self._note))
        numbers, counts = self._numbers, self.counts
        low, high = LATEST_STAMP, 0
        try:
            for code, first, last in _records(data):
                if code == _MESSAGE:
                    channel, _, log_time, _ = _MESSAGE_HEAD.unpack_from(data, first)
                    found.append(channel, log_time, first - 9)
                    low, high = min(low, log_time), max(high, log_time)
                    number = numbers.get(channel)
                    if number is not None:
                        counts[number] += 1
                elif code == _SCHEMA:
                    self._take_schema(data[first:last])
                elif code == _CHANNEL:
                    self._take_channel(data[first:last])
        except (InputError, struct.error) as error:
            if not chunk.cut:
                self._note(f"A chunk at byte {chunk.place} is damaged ({_reason(error)}).")
        if chunk.cut or len(found.places):
            # What is announced may not have been reached.
            chunk.start, chunk.end = (low, high) if len(found.places) else (0, 0)

    # Messages

    def expected(self, wanted: Collection[int]) -> int:
        """How many messages some streams have, by what the file tells."""
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
        ahead = Ahead(itertools.compress(self._chunks, read), partial(packed_piece, self._file))
        with ahead:
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
        singly = _Singly(self._file, channels, head)
        for chunk, is_read in zip(self._chunks, read, strict=True):
            batch = None
            if is_read:
                try:
                    batch = self._batch(chunk, chosen, channels, singly, ahead)
                except (InputError, struct.error) as error:
                    self._note(f"A chunk at byte {chunk.place} is damaged ({_reason(error)}).")
                    try:
                        batch = self._rest_of(chunk, channels)
                    except (InputError, struct.error) as worse:
                        self._note(f"A chunk at byte {chunk.place} is lost ({_reason(worse)}).")
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
        chunk: _Chunk,
        chosen: set[int],
        channels: Indexes,
        singly: "_Singly",
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
        data = np.frombuffer(unpacked_piece(self._file, chunk, self._note, ahead), dtype=np.uint8)
        return in_order(
            [
                Batch(data, *_indexed(data, pairs, channel), np.full(len(pairs), channels[channel]))
                for pairs, channel in parts
            ]
        )

    def _rest_of(
        self, chunk: _Chunk, channels: Indexes, ahead: Ahead | None = None
    ) -> Batch | None:
        """What walking finds in a chunk, whatever its index says."""
        if chunk.walked is None:
            counts = list(self.counts)
            self._walk(chunk)
            self.counts[:] = counts
        walked = chunk.walked
        assert walked is not None
        if not len(walked.places):
            return None
        owners = np.frombuffer(walked.channels, dtype=np.uint16)
        which = np.flatnonzero(channels[owners] >= 0)
        if not len(which):
            return None
        data = np.frombuffer(unpacked_piece(self._file, chunk, self._note, ahead), dtype=np.uint8)
        places = np.frombuffer(walked.places, dtype=np.int64)[which]
        return Batch(
            data,
            places + _IN_CHUNK,
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
        singly = _Singly(self._file, channels, head)
        for place in places.tolist():
            singly.read([place], 0, self.size)
            if singly.is_full:
                yield singly.taken()
                if progress is not None:
                    progress(place, self.size)
        if len(singly):
            yield singly.taken()

    def _pairs(self, channel: int, place: int) -> Stamps:
        """Log time and place of each message that a message index tells, shape (n, 2)."""
        # As a rule all of a short one at once.
        head = self._file.up_to(place, _INDEX_AT_ONCE)
        code, length, told, count = _INDEX_HEAD.unpack_from(head)
        if code != _MESSAGE_INDEX or told != channel or count > length - 6 or count % 16:
            raise InputError(f"no message index of its is at byte {place}")
        if 15 + count > len(head):
            head = head[:15] + self._file.at(place + 15, count)
        pairs = np.frombuffer(head, dtype=np.int64, count=count // 8, offset=15)
        return pairs.reshape(-1, 2)

    def _note(self, damage: str) -> None:
        if damage not in self.damage and len(self.damage) < 20:
            self.damage.append(damage)


class _Singly:
    """Messages read one by one from where they lie in the file, until there are some."""

    def __init__(self, file: File, channels: Indexes, head: int | None) -> None:
        """Begin with none.

        Args:
            file: Where they lie.
            channels: Of a channel the number of its stream.
            head: If only so many bytes of each matter.
        """
        self._file = file
        self._channels = channels
        self._most = 1 << 62 if head is None else head + _IN_CHUNK
        self._guess = 512
        self._begin()

    def _begin(self) -> None:
        self._pieces: list[bytes] = []
        self._bytes = 0
        self._log_times = array("q")
        self._owners = array("H")

    def __len__(self) -> int:
        return len(self._pieces)

    @property
    def is_full(self) -> bool:
        """Whether they are to be taken before more are read."""
        return len(self) >= _SPARSE or self._bytes >= _LARGEST_BATCH

    def read(self, places: list[int], offset: int, end: int) -> None:
        """Read messages.

        Args:
            places: Where they begin, counted from `offset`.
            offset: A place in the file.
            end: Another one, which none of them goes beyond.

        Raises:
            InputError: If something else is there; none of these is taken then.
        """
        before = len(self)
        try:
            for place in places:
                self._read(offset + place, end)
        except (InputError, struct.error):
            for column in (self._pieces, self._log_times, self._owners):
                del column[before:]
            self._bytes = sum(map(len, self._pieces))
            raise

    def _read(self, place: int, end: int) -> None:
        piece = self._file.at(place, min(self._guess, end - place))
        code, length, channel, _, log_time = _MESSAGE_RECORD.unpack_from(piece)
        whole = length + 9
        if code != _MESSAGE or length < 22 or place + whole > end:
            raise InputError("its message index points at something else")
        whole = min(whole, self._most)
        if whole > len(piece):
            piece += self._file.at(place + len(piece), whole - len(piece))
            self._guess = min(max(self._guess, whole + 64), 65_536)
        self._log_times.append(min(log_time, LATEST_STAMP))
        self._owners.append(channel)
        self._pieces.append(piece[:whole])
        self._bytes += whole

    def taken(self) -> Batch:
        """Those that were read since the last time."""
        sizes = np.fromiter(map(len, self._pieces), dtype=np.int64, count=len(self))
        ends = np.cumsum(sizes)
        batch = Batch(
            np.frombuffer(b"".join(self._pieces), dtype=np.uint8),
            ends - sizes + _IN_CHUNK,
            sizes - _IN_CHUNK,
            np.frombuffer(self._log_times, dtype=np.int64),
            self._channels[np.frombuffer(self._owners, dtype=np.uint16)],
        )
        self._begin()
        return batch


def _indexed(data: Bytes, pairs: Stamps, channel: int) -> tuple[Stamps, Stamps, Stamps]:
    """Where the payloads of a channel's messages begin, their lengths, and their log times.

    Args:
        data: A chunk's records.
        pairs: Log time and place of each message, as its message index tells them.
        channel: The channel.

    Raises:
        InputError: If the index points at something else.
    """
    if SCAN is not None:
        found = tuple(np.empty(len(pairs), dtype=np.int64) for _ in range(3))
        if SCAN.indexed(data, np.ascontiguousarray(pairs), *found, channel):
            starts, lengths, log_times = found
            return starts, lengths, log_times
    places = pairs[:, 1]
    if len(data) < _IN_CHUNK or places.min() < 0 or places.max() > len(data) - _IN_CHUNK:
        raise InputError("its message index points outside of it")
    # Of every record the code, the length in 8 bytes and the channel in 2, all at once.
    heads = rows_of(data, places, 16)
    lengths = (heads[:, 0] >> np.uint64(8)).view(np.int64)
    lengths -= 22
    starts = places + _IN_CHUNK
    if (
        ((heads[:, 0] & np.uint64(0xFF)) != _MESSAGE).any()
        or ((heads[:, 1] & np.uint64(0xFFFFFF)) != np.uint64(channel << 8)).any()
        or int(lengths.min()) < 0
        or int((starts + lengths).max()) > len(data)
    ):
        raise InputError("its message index points at something else")
    return starts, lengths, pairs[:, 0]


def _records(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Every record's code, and where its body begins and ends.

    Raises:
        InputError: At one that goes on behind the end.
    """
    position, size = 0, len(data)
    unpack_from = _RECORD.unpack_from
    while position + 9 <= size:
        code, length = unpack_from(data, position)
        first = position + 9
        position = first + length
        if position > size:
            raise InputError(f"a record announces {length} bytes and {size - first} are there")
        yield code, first, position


def _chunk_of_index(summary: bytes, first: int, last: int, size: int) -> _Chunk:
    """The chunk of which a chunk index tells, which lies there in the summary."""
    start, end, place, length, entries = _CHUNK_INDEX_HEAD.unpack_from(summary, first)
    indexes = _entries(summary, first + 32, last)
    text = first + 44 + entries
    method, position = _text(summary, text, last)
    if position + 16 > last:
        raise InputError("a chunk's index is cut")
    packed, unpacked = _SIZES.unpack_from(summary, position)
    # Before them lie 45 bytes, and the name of the compression as it stands here.
    records = place + 45 + position - text
    if records + packed > size or place + length > size:
        raise InputError(f"a chunk at byte {place} lies beyond the file's end")
    return _Chunk(records, packed, unpacked, method, start, end, indexes)


def _entries(body: bytes, place: int, end: int) -> dict[int, int]:
    """A map of channels to numbers."""
    (length,) = _U32.unpack_from(body, place)
    place += 4
    if place + length > end:
        raise InputError("a map goes on behind its record")
    return dict(_ENTRY.iter_unpack(body[place : place + length // 10 * 10]))


def _strings(body: bytes, place: int) -> dict[str, str]:
    """A map of texts."""
    (length,) = _U32.unpack_from(body, place)
    place += 4
    end = place + length
    found: dict[str, str] = {}
    while place < end and len(found) < 1000:
        key, place = _text(body, place)
        found[key], place = _text(body, place)
    return found


def _text(body: bytes, place: int, last: int | None = None) -> tuple[str, int]:
    """A text, and where it ends; not behind `last`, if that is said."""
    (length,) = _U32.unpack_from(body, place)
    end = place + 4 + length
    if end > (len(body) if last is None else last):
        raise InputError(f"a text announces {length} bytes")
    return body[place + 4 : end].decode("utf-8", "backslashreplace"), end


def _reason(error: Exception) -> str:
    return "a record is cut" if isinstance(error, struct.error) else str(error)
