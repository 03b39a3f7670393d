"""ROS 1 bags of version 2.0, by their index, else chunk by chunk up to the damage.

Source: wiki.ros.org/Bags/Format/2.0.
"""

import itertools
import struct
from array import array
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.errors import InputError
from tftool.sources.columns import Batch, in_order, words_at
from tftool.sources.compressed import Ahead, Packed
from tftool.sources.container import (
    MOST_STREAMS,
    TRANSIENT_LOCAL,
    ChunkedFile,
    MessageStream,
    Offers,
)
from tftool.sources.contract import Progress, Stamps
from tftool.sources.find import ROS1_MAGIC
from tftool.stamps import NANOSECONDS
from tftool.wire.native import SCAN
from tftool.wire.rows import Bytes

Entries: TypeAlias = npt.NDArray[np.uint32]
"""Of each message seconds, nanoseconds, and where its record begins, shape (n, 3)."""

_MESSAGE: Final = b"\x02"
_BAG: Final = b"\x03"
_INDEX: Final = b"\x04"
_CHUNK: Final = b"\x05"
_CHUNK_INFO: Final = b"\x06"
_CONNECTION: Final = b"\x07"

_U32, _U64 = struct.Struct("<I"), struct.Struct("<Q")
_TIME = struct.Struct("<II")
_LARGEST_HEADER = 1 << 20
_LARGEST_INDEX = 1 << 30
_HEAD = 4096


@dataclass(slots=True, eq=False)
class _Chunk:
    """One chunk, and where its messages lie.

    Attributes:
        position: Where its record begins in the file.
        counts: How many messages each connection has in it.
        place: Where its data begins in the file, packed; 0 while not looked at.
        packed: Bytes of it.
        size: Bytes unpacked.
        method: How it is packed.
        cut: Whether the file ends within it.
        walked: What walking found: connection, log time, and place of each message.
    """

    position: int
    counts: dict[int, int] = field(default_factory=dict)
    place: int = 0
    packed: int = 0
    size: int = 0
    method: str = ""
    cut: bool = False
    walked: "tuple[array[int], array[int], array[int]] | None" = None


class Rosbag1:
    """A ROS 1 bag; see `Container`."""

    kind = "ROS 1 bag"

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
        self._numbers: dict[int, int] = {}  # of a connection: its stream
        self._chunks: list[_Chunk] = []
        try:
            self._open(path)
        except BaseException:
            self.close()
            raise

    def _open(self, path: Path) -> None:
        """Find out what is in it, by its index or without."""
        if self._file.up_to(0, len(ROS1_MAGIC)) != ROS1_MAGIC:
            raise InputError(f"'{path}' is no ROS 1 bag.")
        try:
            complete = self._read_index()
        except (InputError, struct.error, KeyError) as error:
            complete = False
            self.damage.append(f"Its index cannot be read ({_reason(error)}).")
        if not complete:
            self._scan()

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    # What is in it

    def _read_index(self) -> bool:
        """Take what the index at the end tells; whether there is one."""
        header, _, _ = self._record_head(len(ROS1_MAGIC))
        if header.get(b"op") != _BAG:
            raise InputError("the bag's own header is missing")
        (place,) = _U64.unpack(header[b"index_pos"])
        (chunks,) = _U32.unpack(header[b"chunk_count"])
        if place == 0:
            self.damage.append("The recording was not closed.")
            return False
        if place > self.size or self.size - place > _LARGEST_INDEX:
            raise InputError(f"it should begin at byte {place} of {self.size}")
        data = self._file.at(place, self.size - place)
        low, high = 2**62, 0
        for header, first, last in _records(data):
            code = header.get(b"op")
            if code == _CONNECTION:
                self._take_connection(header, data[first:last])
            elif code == _CHUNK_INFO:
                (position,) = _U64.unpack(header[b"chunk_pos"])
                pairs = struct.iter_unpack("<II", data[first : first + (last - first) // 8 * 8])
                chunk = _Chunk(position, dict(pairs))
                self._chunks.append(chunk)
                if chunk.counts:
                    low = min(low, _time(header[b"start_time"]))
                    high = max(high, _time(header[b"end_time"]))
        if len(self._chunks) != chunks:
            raise InputError(f"it names {len(self._chunks)} chunks of {chunks}")
        if any(chunk.position >= place for chunk in self._chunks):
            raise InputError("a chunk lies beyond it")
        if high:
            self.start, self.end = low, high
        self._chunks.sort(key=lambda one: one.position)
        for chunk in self._chunks:
            for connection, count in chunk.counts.items():
                if connection in self._numbers:
                    self.counts[self._numbers[connection]] += count
        return True

    def _take_connection(self, header: dict[bytes, bytes], data: bytes) -> None:
        (connection,) = _U32.unpack(header[b"conn"])
        if connection in self._numbers or len(self.streams) >= MOST_STREAMS:
            return
        fields = _fields(data)

        def text(name: bytes) -> str:
            return fields.get(name, b"").decode("utf-8", "backslashreplace")

        topic = header.get(b"topic", b"").decode("utf-8", "backslashreplace") or text(b"topic")
        offers = Offers(TRANSIENT_LOCAL, "", 1) if text(b"latching") == "1" else Offers()
        self._numbers[connection] = len(self.streams)
        self.streams.append(
            MessageStream(
                topic, text(b"type"), "ros1", text(b"message_definition"), text(b"callerid"), offers
            )
        )
        self.counts.append(0)

    def _record_head(self, position: int) -> tuple[dict[bytes, bytes], int, int]:
        """A record's header, where its data begins, and how long that is."""
        block = self._file.up_to(position, _HEAD)
        (length,) = _U32.unpack_from(block)
        if length > _LARGEST_HEADER:
            raise InputError(f"a record at byte {position} announces a header of {length} bytes")
        if length + 8 > len(block):
            block = self._file.at(position, length + 8)
        (size,) = _U32.unpack_from(block, 4 + length)
        return _fields(block[4 : 4 + length]), position + 8 + length, size

    # From front to back

    def _scan(self) -> None:
        """Find chunks record by record, up to the end or the damage, and walk through them."""
        self.streams.clear()
        self.counts.clear()
        self._numbers.clear()
        self._chunks.clear()
        position = len(ROS1_MAGIC)
        while position < self.size:
            try:
                header, data, length = self._record_head(position)
                code = header.get(b"op")
                cut = data + length > self.size
                if code == _CHUNK:
                    chunk = _Chunk(position)
                    self._look_at(chunk, header, data, min(length, self.size - data), cut)
                    self._chunks.append(chunk)
                    self._walk(chunk)
                elif code == _CONNECTION and not cut:
                    self._take_connection(header, self._file.at(data, length))
                elif code not in (_BAG, _INDEX, _CHUNK_INFO, _CONNECTION):
                    break
                if cut:
                    break
            except (InputError, struct.error, KeyError):
                break
            position = data + length
        found = sum(self.counts)
        if position < self.size:
            self.damage.append(
                f"The recording breaks off at byte {position} of {self.size}: "
                f"{found} messages were read up to there."
            )
            if not found and not self.streams:
                raise InputError(
                    f"'{self._file.path}' is damaged: no message could be read ({self.damage[-1]})"
                )
        times = [one.walked[1] for one in self._chunks if one.walked and one.walked[1]]
        if times:
            self.start = min(min(one) for one in times)
            self.end = max(max(one) for one in times)

    def _look_at(
        self, chunk: _Chunk, header: dict[bytes, bytes], place: int, packed: int, cut: bool
    ) -> None:
        if header.get(b"op") != _CHUNK:
            raise InputError(f"no chunk is at byte {chunk.position}")
        chunk.place, chunk.packed, chunk.cut = place, packed, cut
        chunk.method = header[b"compression"].decode("ascii", "replace")
        (chunk.size,) = _U32.unpack(header[b"size"])

    def _walk(self, chunk: _Chunk) -> None:
        """Walk through a chunk's records; learn its connections, and where its messages are."""
        walked = chunk.walked = array("q"), array("q"), array("q")
        connections, log_times, places = walked
        data = bytes(self._file.unpacked(chunk))
        try:
            for header, first, last in _records(data):
                code = header.get(b"op")
                if code == _MESSAGE:
                    (connection,) = _U32.unpack(header[b"conn"])
                    log_times.append(_time(header[b"time"]))
                    connections.append(connection)
                    places.append(first)
                    number = self._numbers.get(connection)
                    if number is not None:
                        self.counts[number] += 1
                elif code == _CONNECTION:
                    self._take_connection(header, data[first:last])
        except (InputError, struct.error, KeyError) as error:
            if not chunk.cut:
                self._file.note_chunk(chunk, _reason(error))

    # Messages

    def expected(self, wanted: Collection[int]) -> int:
        """How many messages some streams have, by what the file tells."""
        return sum(self.counts[number] for number in wanted)

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """The messages of some streams; see `Container`."""
        chosen = {
            connection: number for connection, number in self._numbers.items() if number in wanted
        }
        read = [
            chunk.walked is not None or not chunk.counts.keys().isdisjoint(chosen)
            for chunk in self._chunks
        ]
        with Ahead(itertools.compress(self._chunks, read), self._packed) as ahead:
            yield from self._chunk_batches(read, chosen, ahead, progress)

    def _chunk_batches(
        self, read: list[bool], chosen: dict[int, int], ahead: Ahead, progress: Progress | None
    ) -> Iterator[Batch]:
        for chunk, is_read in zip(self._chunks, read, strict=True):
            if is_read:
                try:
                    batch = self._batch(chunk, chosen, ahead)
                except (InputError, struct.error, KeyError) as error:
                    self._file.note_chunk(chunk, _reason(error))
                    batch = self._rest_of(chunk, chosen)
                if batch is not None and len(batch):
                    yield batch
            if progress is not None:
                progress(chunk.position, self.size)

    def _batch(self, chunk: _Chunk, chosen: dict[int, int], ahead: Ahead) -> Batch | None:
        if chunk.walked is not None:
            return self._rest_of(chunk, chosen, ahead)
        self._locate(chunk)
        parts = self._indexes(chunk, chosen)
        if not parts:
            return None
        data = np.frombuffer(self._file.unpacked(chunk, ahead), dtype=np.uint8)
        return in_order(
            [
                Batch(data, *_indexed(data, entries, connection), senders)
                for connection, entries in parts
                for senders in [np.full(len(entries), chosen[connection], dtype=np.int32)]
            ]
        )

    def _locate(self, chunk: _Chunk) -> None:
        """Find out where a chunk's data lies, if that is not known."""
        if not chunk.place:
            header, place, packed = self._record_head(chunk.position)
            self._look_at(chunk, header, place, packed, False)

    def _indexes(self, chunk: _Chunk, chosen: dict[int, int]) -> list[tuple[int, Entries]]:
        """The index records behind a chunk: chosen connections with messages, and what is told."""
        position = chunk.place + chunk.packed
        expected = len(chunk.counts) * 64 + 12 * sum(chunk.counts.values()) + 64
        data = self._file.up_to(position, min(expected, _LARGEST_INDEX))
        found = []
        missing = set(chunk.counts)
        for header, first, last in _records(data, partial=True):
            if header.get(b"op") != _INDEX:
                break
            (connection,) = _U32.unpack(header[b"conn"])
            missing.discard(connection)
            if connection in chosen:
                count = (last - first) // 12
                if not count:
                    continue
                table = np.frombuffer(data, dtype="<u4", count=3 * count, offset=first)
                found.append((connection, table.reshape(-1, 3)))
        if not missing.isdisjoint(chosen):
            raise InputError("its index is incomplete")
        return found

    def _rest_of(
        self, chunk: _Chunk, chosen: dict[int, int], ahead: Ahead | None = None
    ) -> Batch | None:
        """What walking finds in a chunk, whatever its index says."""
        if chunk.walked is None:
            if not chunk.place:
                return None
            counts = list(self.counts)
            self._walk(chunk)
            self.counts[:] = counts
        assert chunk.walked is not None
        connections, log_times, places = chunk.walked
        which = [row for row, connection in enumerate(connections) if connection in chosen]
        if not which:
            return None
        data = np.frombuffer(self._file.unpacked(chunk, ahead), dtype=np.uint8)
        starts = np.frombuffer(places, dtype=np.int64)[which]
        return Batch(
            data,
            starts,
            words_at(data, starts - 4, "<u4").astype(np.int64),
            np.frombuffer(log_times, dtype=np.int64)[which],
            np.array([chosen[connections[row]] for row in which], dtype=np.int32),
        )

    def _packed(self, chunk: _Chunk) -> Packed | None:
        """What of a chunk is unpacked ahead; None of one that is read in another way."""
        try:
            self._locate(chunk)
        except (InputError, struct.error, KeyError):
            return None
        return self._file.packed(chunk)


def _indexed(data: Bytes, entries: Entries, connection: int) -> tuple[Stamps, Stamps, Stamps]:
    """Where a connection's messages begin, their lengths, and their log times.

    Args:
        data: A chunk's records.
        entries: What its index tells of each message.
        connection: Whose messages they are.

    Raises:
        InputError: If the index points at something else.
    """
    first = int(entries[0, 2])
    if first > len(data) - 4:
        raise InputError("its index points outside of it")
    (head,) = _U32.unpack_from(data.data, first)
    header = data[first + 4 : first + 4 + min(head, _LARGEST_HEADER)].tobytes()
    code, owner = header.find(b"op=") + 3, header.find(b"conn=") + 5
    if code < 3 or owner < 5 or not code < len(header) >= owner + 4 or len(header) != head:
        raise InputError("its index points at something else")
    if SCAN is not None:
        found = tuple(np.empty(len(entries), dtype=np.int64) for _ in range(3))
        if SCAN.pointed(data, np.ascontiguousarray(entries), *found, connection, code, owner):
            starts, lengths, log_times = found
            return starts, lengths, log_times
    places = entries[:, 2].astype(np.int64)
    heads = _within(places, data)
    bodies = places + 4 + heads
    lengths = _within(bodies, data)
    starts = bodies + 4
    if (heads > _LARGEST_HEADER).any() or (starts + lengths > len(data)).any():
        raise InputError("its index points outside of it")
    if (
        (heads != head).any()
        or (data[places + 4 + code] != _MESSAGE[0]).any()
        or (words_at(data, places + 4 + owner, "<u4") != connection).any()
    ):
        raise InputError("its index points at something else")
    return starts, lengths, entries[:, 0].astype(np.int64) * NANOSECONDS + entries[:, 1]


def _within(places: Stamps, data: Bytes) -> Stamps:
    """The numbers of four bytes at some places.

    Raises:
        InputError: If one lies outside.
    """
    if len(data) < 4 or int(places.max()) > len(data) - 4:
        raise InputError("its index points outside of it")
    return words_at(data, places, "<u4").astype(np.int64)


def _records(data: bytes, partial: bool = False) -> Iterator[tuple[dict[bytes, bytes], int, int]]:
    """Every record's header, and where its data begins and ends.

    Args:
        data: Records.
        partial: Whether the last one may be cut.

    Raises:
        InputError: At one that goes on behind the end.
    """
    position, size = 0, len(data)
    while position + 8 <= size:
        (length,) = _U32.unpack_from(data, position)
        first = position + 8 + length
        if length > _LARGEST_HEADER or first > size:
            if partial:
                return
            raise InputError(f"a record announces a header of {length} bytes")
        (count,) = _U32.unpack_from(data, first - 4)
        last = first + count
        if last > size:
            if partial:
                return
            raise InputError(f"a record announces {count} bytes and {size - first} are there")
        yield _fields(data[position + 4 : first - 4]), first, last
        position = last


def _fields(header: bytes) -> dict[bytes, bytes]:
    """The fields of a header, by name."""
    found = {}
    position, size = 0, len(header)
    while position + 4 <= size:
        (length,) = _U32.unpack_from(header, position)
        position += 4
        if position + length > size:
            raise InputError(f"a field announces {length} bytes")
        name, _, value = header[position : position + length].partition(b"=")
        found[name] = value
        position += length
    return found


def _time(raw: bytes) -> int:
    sec, nanosec = _TIME.unpack(raw)
    return int(sec) * NANOSECONDS + int(nanosec)


def _reason(error: Exception) -> str:
    if isinstance(error, KeyError):
        return f"a record lacks its field {error.args[0].decode('ascii', 'replace')!r}"
    return "a record is cut" if isinstance(error, struct.error) else str(error)
