"""Records of an MCAP file, the chunks in its index, and their messages.

Source: the MCAP format specification, version 0.
"""

import struct
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP
from tftool.messages.native_scan import SCAN
from tftool.messages.transform_rows import Bytes, rows_of
from tftool.recordings.columns import Batch
from tftool.recordings.container import File
from tftool.recordings.contract import Indexes, Stamps

MESSAGE: Final = 0x05
"""The code of a message's record."""

IN_CHUNK: Final = 31
"""Bytes before a message's payload: 9 of the record, 22 of the message."""

U32: Final = struct.Struct("<I")

_RECORD = struct.Struct("<BQ")
_MESSAGE_RECORD = struct.Struct("<BQHIQ")
_CHUNK_INDEX_HEAD = struct.Struct("<QQQQI")
_SIZES = struct.Struct("<QQ")
_ENTRY = struct.Struct("<HQ")

_MOST_SINGLY = 4096  # messages that are read singly before they are taken
_LARGEST_BATCH = 1 << 22  # and bytes of them


@dataclass(slots=True, eq=False)
class IndexedChunk:
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
    walked: "WalkedMessages | None" = None
    cut: bool = False

    @property
    def position(self) -> int:
        """Where it is said to be."""
        return self.place


class WalkedMessages:
    """Messages that were found by walking, as columns."""

    __slots__ = ("channels", "log_times", "places")

    def __init__(self) -> None:
        self.channels = array("H")
        self.log_times = array("q")
        self.places = array("q")

    def append(self, channel: int, log_time: int, place: int) -> None:
        """Take one: its channel, when it was received, and where its record begins."""
        self.channels.append(channel)
        self.log_times.append(min(log_time, LAST_STAMP))
        self.places.append(place)


class SingleMessages:
    """Messages read one by one from where they lie in the file, until there are some."""

    def __init__(self, file: File, channels: Indexes, head: int | None) -> None:
        """Begin with none.

        Args:
            file: Where they lie.
            channels: Of a channel the number of its stream.
            head: How many bytes of each message are needed; all if None.
        """
        self._file = file
        self._channels = channels
        self._most = 1 << 62 if head is None else head + IN_CHUNK
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
        return len(self) >= _MOST_SINGLY or self._bytes >= _LARGEST_BATCH

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
        if code != MESSAGE or length < 22 or place + whole > end:
            raise InputError("its message index points at something else")
        whole = min(whole, self._most)
        if whole > len(piece):
            piece += self._file.at(place + len(piece), whole - len(piece))
            self._guess = min(max(self._guess, whole + 64), 65_536)
        self._log_times.append(min(log_time, LAST_STAMP))
        self._owners.append(channel)
        self._pieces.append(piece[:whole])
        self._bytes += whole

    def taken(self) -> Batch:
        """Those that were read since the last time."""
        sizes = np.fromiter(map(len, self._pieces), dtype=np.int64, count=len(self))
        ends = np.cumsum(sizes)
        batch = Batch(
            np.frombuffer(b"".join(self._pieces), dtype=np.uint8),
            ends - sizes + IN_CHUNK,
            sizes - IN_CHUNK,
            np.frombuffer(self._log_times, dtype=np.int64),
            self._channels[np.frombuffer(self._owners, dtype=np.uint16)],
        )
        self._begin()
        return batch


def indexed(data: Bytes, pairs: Stamps, channel: int) -> tuple[Stamps, Stamps, Stamps]:
    """Offsets, lengths and log times of the payloads of a channel's messages.

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
    if len(data) < IN_CHUNK or places.min() < 0 or places.max() > len(data) - IN_CHUNK:
        raise InputError("its message index points outside of it")
    # Of every record the code, the length in 8 bytes and the channel in 2, all at once.
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
        raise InputError("its message index points at something else")
    return starts, lengths, pairs[:, 0]


def records_in(data: bytes) -> Iterator[tuple[int, int, int]]:
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
        if not code:
            raise InputError("a record has the code 0, which is none")
        if position > size:
            raise InputError(f"a record announces {length} bytes and {size - first} are there")
        yield code, first, position


def chunk_of_index(summary: bytes, first: int, last: int, size: int) -> IndexedChunk:
    """The chunk of which a chunk index tells, which lies there in the summary."""
    start, end, place, length, entries = _CHUNK_INDEX_HEAD.unpack_from(summary, first)
    indexes = entries_at(summary, first + 32, last)
    text = first + 44 + entries
    method, position = text_at(summary, text, last)
    if position + 16 > last:
        raise InputError("a chunk's index is cut")
    packed, unpacked = _SIZES.unpack_from(summary, position)
    # Before them lie 45 bytes, and the name of the compression as it stands here.
    records = place + 45 + position - text
    if records + packed > size or place + length > size:
        raise InputError(f"a chunk at byte {place} lies beyond the file's end")
    return IndexedChunk(records, packed, unpacked, method, start, end, indexes)


def entries_at(body: bytes, place: int, end: int) -> dict[int, int]:
    """A map of channels to numbers."""
    (length,) = U32.unpack_from(body, place)
    place += 4
    if place + length > end:
        raise InputError("a map goes on behind its record")
    return dict(_ENTRY.iter_unpack(body[place : place + length // 10 * 10]))


READABLE: Final = "backslashreplace"
"""How a text is read that is shown."""

AS_IT_IS: Final = "surrogateescape"
"""How a text is read that is written again, byte for byte."""


def strings_at(body: bytes, place: int, errors: str = READABLE) -> dict[str, str]:
    """A map of texts; `errors` as of `text_at`."""
    (length,) = U32.unpack_from(body, place)
    place += 4
    end = place + length
    found: dict[str, str] = {}
    while place < end and len(found) < 1000:
        key, place = text_at(body, place, errors=errors)
        found[key], place = text_at(body, place, errors=errors)
    return found


def text_at(
    body: bytes, place: int, last: int | None = None, errors: str = READABLE
) -> tuple[str, int]:
    """A text, and where it ends; not behind `last`, if that is said.

    Args:
        body: The record.
        place: Where it begins.
        last: Where it ends at the latest.
        errors: How bytes that are not UTF-8 are read: to be shown, or to be written again.
    """
    (length,) = U32.unpack_from(body, place)
    end = place + 4 + length
    if end > (len(body) if last is None else last):
        raise InputError(f"a text announces {length} bytes")
    return body[place + 4 : end].decode("utf-8", errors), end


def reason_of(error: Exception) -> str:
    """Return why a record cannot be read."""
    return "a record is cut" if isinstance(error, struct.error) else str(error)
