"""Codes, limits, packing and parsing of the records of an MCAP file.

Source: the MCAP format specification, version 0.
"""

import struct
from array import array
from collections.abc import Iterator, Mapping
from typing import Final, NamedTuple

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP
from tftool.messages.transform_rows import SCAN, Bytes, rows_of
from tftool.recordings.chunked import numbers_of
from tftool.recordings.columns import Batch
from tftool.recordings.container import File
from tftool.recordings.contract import Stamps

HEADER: Final = 0x01
FOOTER: Final = 0x02
SCHEMA: Final = 0x03
CHANNEL: Final = 0x04
MESSAGE: Final = 0x05
CHUNK: Final = 0x06
MESSAGE_INDEX: Final = 0x07
CHUNK_INDEX: Final = 0x08
ATTACHMENT: Final = 0x09
ATTACHMENT_INDEX: Final = 0x0A
STATISTICS: Final = 0x0B
METADATA: Final = 0x0C
METADATA_INDEX: Final = 0x0D
SUMMARY_OFFSET: Final = 0x0E
DATA_END: Final = 0x0F

RECORD: Final = struct.Struct("<BQ")
"""Beginning of a record: its code and the length of its body."""

CHUNK_HEAD: Final = struct.Struct("<QQQI")
"""Beginning of a chunk's body: first and last log time, uncompressed size, CRC."""

MESSAGE_HEAD: Final = struct.Struct("<HIQQ")
"""Body of a message before the payload: channel, sequence number, log time, publish time."""

MESSAGE_RECORD: Final = struct.Struct("<BQHIQQ")
"""Record of a message before the payload: `RECORD`, then `MESSAGE_HEAD`."""

INDEX_HEAD: Final = struct.Struct("<BQHI")
"""Beginning of a message index's record: code, length, channel, size of the entries in bytes."""

IN_CHUNK: Final = 31
"""Number of bytes of a message's record before the payload: `RECORD` 9, `MESSAGE_HEAD` 22."""

FOOTER_SIZE: Final = 37
"""Size of the footer and the magic bytes after it."""

DATA_END_SIZE: Final = 13

LONGEST_METHOD: Final = 64
"""Maximum length of a compression's name, bytes."""

U16, U32, U64 = struct.Struct("<H"), struct.Struct("<I"), struct.Struct("<Q")

_CHUNK_INDEX_HEAD = struct.Struct("<QQQQI")
_SIZES = struct.Struct("<QQ")
_ENTRY = struct.Struct("<HQ")

_MOST_SINGLY = 4096  # messages in one batch that are read one by one
_LARGEST_BATCH = 1 << 22  # bytes in one such batch


class SingleMessages:
    """Collector of messages that are read from the file one by one, and returned in batches."""

    def __init__(self, file: File, chosen: Mapping[int, int], head: int | None) -> None:
        """Create an empty collector of messages of chosen channels.

        Args:
            file: The file.
            chosen: Position of each chosen channel in the list of streams, by the channel's id.
            head: Number of bytes needed from each message; None for all bytes.
        """
        self._file = file
        self._chosen = chosen
        self._most = 1 << 62 if head is None else head + IN_CHUNK
        self._guess = 512
        self._begin()

    def _begin(self) -> None:
        self._pieces: list[bytes] = []
        self._bytes = 0
        self._log_times = array("q")
        self._owners = array("I")

    def __len__(self) -> int:
        return len(self._pieces)

    @property
    def is_full(self) -> bool:
        """Whether the batch is large enough to be processed."""
        return len(self) >= _MOST_SINGLY or self._bytes >= _LARGEST_BATCH

    def read(self, places: list[int], offset: int, end: int) -> None:
        """Read the messages at some offsets of the file, and add them to this collection.

        Args:
            places: Offset of each message's record, relative to `offset`.
            offset: Offset in the file that is added to `places`.
            end: Offset in the file that no message may extend beyond.

        Raises:
            InputError: If there is no message at an offset. The collection is then unchanged.
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
        # Read as many bytes as the last messages had, so that one read is usually enough.
        piece = self._file.at(place, min(self._guess, end - place))
        code, length, channel, _, log_time, _ = MESSAGE_RECORD.unpack_from(piece)
        whole = length + 9
        if code != MESSAGE or length < 22 or place + whole > end:
            raise InputError("a message index points at something other than its messages")
        whole = min(whole, self._most)
        if whole > len(piece):
            piece += self._file.at(place + len(piece), whole - len(piece))
            self._guess = min(max(self._guess, whole + 64), 65_536)
        self._log_times.append(min(log_time, LAST_STAMP))
        self._owners.append(channel)
        self._pieces.append(piece[:whole])
        self._bytes += whole

    def taken(self) -> Batch:
        """Return a batch of the messages read since the last call of this method."""
        sizes = np.fromiter(map(len, self._pieces), dtype=np.int64, count=len(self))
        ends = np.cumsum(sizes)
        batch = Batch(
            np.frombuffer(b"".join(self._pieces), dtype=np.uint8),
            ends - sizes + IN_CHUNK,
            sizes - IN_CHUNK,
            np.frombuffer(self._log_times, dtype=np.int64),
            numbers_of(self._owners, self._chosen),
        )
        self._begin()
        return batch


def indexed(data: Bytes, pairs: Stamps, channel: int) -> tuple[Stamps, Stamps, Stamps]:
    """Return offsets and lengths of the payloads of a channel's messages, and their log times.

    Args:
        data: Bytes of a chunk's records.
        pairs: Log time and offset of each message, from the channel's message index.
        channel: Number of the channel.

    Raises:
        InputError: If the index points to something other than these messages.
    """
    # The C code checks the same; at the first difference the code below raises the error.
    if SCAN is not None:
        found = tuple(np.empty(len(pairs), dtype=np.int64) for _ in range(3))
        if SCAN.indexed(data, np.ascontiguousarray(pairs), *found, channel):
            starts, lengths, log_times = found
            return starts, lengths, log_times
    places = pairs[:, 1]
    if len(data) < IN_CHUNK or places.min() < 0 or places.max() > len(data) - IN_CHUNK:
        raise InputError("a message index points outside of the chunk")
    # Read the code (1 byte), length (8) and channel (2) of all records at once.
    heads = rows_of(data, places, 16)
    lengths = (heads[:, 0] >> np.uint64(8)).view(np.int64)
    lengths -= 22
    starts = places + IN_CHUNK
    if (
        ((heads[:, 0] & np.uint64(0xFF)) != MESSAGE).any()
        or ((heads[:, 1] & np.uint64(0xFFFFFF)) != np.uint64(channel << 8)).any()
        or int(lengths.min()) < 0
        or int((starts + lengths).max()) > len(data)
    ):
        raise InputError("a message index points at something other than its messages")
    return starts, lengths, pairs[:, 0]


def records_in(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield the code of every record, and the start and end of its body.

    Raises:
        InputError: If a record extends beyond the data.
    """
    position, size = 0, len(data)
    unpack_from = RECORD.unpack_from
    while position + 9 <= size:
        code, length = unpack_from(data, position)
        first = position + 9
        position = first + length
        # Zeros at the end of a file: its blocks were never written.
        if not code:
            raise InputError("a record has the invalid code 0")
        if position > size:
            raise InputError(f"a record announces {length} bytes, but only {size - first} follow")
        yield code, first, position


class IndexEntry(NamedTuple):
    """Chunk index record, which describes a chunk in the summary at the end of a file.

    Attributes:
        start: Log time of the chunk's first message.
        end: Log time of the chunk's last message.
        position: Offset of the chunk's record.
        length: Size of the chunk's record, bytes.
        indexes: Offset of each channel's message index.
        indexes_length: Size of the message indexes, bytes.
        method: Compression of the messages.
        packed: Size of the compressed messages, bytes.
        size: Size of the uncompressed messages, bytes.
    """

    start: int
    end: int
    position: int
    length: int
    indexes: Mapping[int, int]
    indexes_length: int
    method: str
    packed: int
    size: int

    @property
    def place(self) -> int:
        """Offset of the chunk's compressed messages, after header and compression name."""
        return self.position + 49 + len(self.method.encode("utf-8", "surrogateescape"))

    def record(self) -> bytes:
        """Return the bytes of this entry as a record of the summary."""
        head = struct.pack("<QQQQ", self.start, self.end, self.position, self.length)
        sizes = text(self.method) + _SIZES.pack(self.packed, self.size)
        body = head + entries(self.indexes) + U64.pack(self.indexes_length) + sizes
        return record(CHUNK_INDEX, body)


def index_entry(summary: bytes, first: int, last: int, size: int) -> IndexEntry:
    """Parse the chunk index record from `first` to `last` in the summary of a file of `size` bytes.

    Raises:
        InputError: If the record is cut off, or the chunk extends beyond the end of the file.
    """
    start, end, position, length, count = _CHUNK_INDEX_HEAD.unpack_from(summary, first)
    indexes = entries_at(summary, first + 32, last)
    (indexes_length,) = U64.unpack_from(summary, first + 36 + count)
    method, place = text_at(summary, first + 44 + count, last)
    if place + 16 > last:
        raise InputError("the index of a chunk ends too early")
    packed, unpacked = _SIZES.unpack_from(summary, place)
    found = IndexEntry(
        start, end, position, length, indexes, indexes_length, method, packed, unpacked
    )
    if found.place + packed > size or position + length > size:
        raise InputError(f"a chunk at byte {position} is beyond the file's end")
    return found


def entries_at(body: bytes, place: int, end: int) -> dict[int, int]:
    """Parse a map from channel numbers to integers."""
    (length,) = U32.unpack_from(body, place)
    place += 4
    if place + length > end:
        raise InputError("a map extends beyond its record")
    return dict(_ENTRY.iter_unpack(body[place : place + length // 10 * 10]))


def strings_at(body: bytes, place: int) -> dict[str, str]:
    """Parse a map from strings to strings."""
    (length,) = U32.unpack_from(body, place)
    place += 4
    end = place + length
    found: dict[str, str] = {}
    while place < end and len(found) < 1000:
        key, place = text_at(body, place)
        found[key], place = text_at(body, place)
    return found


def text_at(body: bytes, place: int, last: int | None = None) -> tuple[str, int]:
    """Parse a string that is stored after its length.

    Args:
        body: Body of the record.
        place: Offset of the string's length.
        last: Offset before which the string must end.

    Returns:
        The string, in which bytes that are not UTF-8 become surrogates, and the offset after the
        string.
    """
    (length,) = U32.unpack_from(body, place)
    end = place + 4 + length
    if end > (len(body) if last is None else last):
        raise InputError(f"a string announces {length} bytes, more than the record has")
    return body[place + 4 : end].decode("utf-8", "surrogateescape"), end


def record(code: int, body: bytes) -> bytes:
    """Return the bytes of a record."""
    return RECORD.pack(code, len(body)) + body


def text(words: str) -> bytes:
    """Return the bytes of a string, with its length in front."""
    raw = words.encode("utf-8", "surrogateescape")
    return U32.pack(len(raw)) + raw


def strings(values: Mapping[str, str]) -> bytes:
    """Return the bytes of a map from strings to strings, with its length in front."""
    packed = b"".join(text(key) + text(value) for key, value in values.items())
    return U32.pack(len(packed)) + packed


def entries(values: Mapping[int, int]) -> bytes:
    """Return the bytes of a map from channel numbers to integers, with its length in front."""
    packed = b"".join(struct.pack("<HQ", key, value) for key, value in values.items())
    return U32.pack(len(packed)) + packed


def message_index(channel: int, index: "array[int]") -> bytes:
    """Return the bytes of a message index record; `index` alternates log times and offsets."""
    pairs = index.tobytes()
    return (
        RECORD.pack(MESSAGE_INDEX, 6 + len(pairs)) + struct.pack("<HI", channel, len(pairs)) + pairs
    )
