"""ROS 1 bags of version 2.0, by their index, else chunk by chunk up to the damage.

Source: wiki.ros.org/Bags/Format/2.0.
"""

import itertools
import struct
from array import array
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tftool.base.errors import InputError
from tftool.recordings.columns import Batch, in_order, words_at
from tftool.recordings.container import (
    MOST_STREAMS,
    TRANSIENT_LOCAL,
    ChunkedFile,
    MessageStream,
    Offers,
    check_told,
)
from tftool.recordings.contract import Progress
from tftool.recordings.decompression import Ahead, Packed
from tftool.recordings.find import ROS1_MAGIC
from tftool.recordings.rosbag1.format import (
    BAG,
    CHUNK,
    CHUNK_INFO,
    CONNECTION,
    INDEX,
    MESSAGE,
    U32,
    Entries,
    chunk_info,
    fields_of,
    index_of,
    indexed,
    reason_of,
    record_head,
    records_in,
    time_of,
)


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
            self.damage.append(f"Its index cannot be read ({reason_of(error)}).")
        if not complete:
            self._scan()

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    # What is in it

    def _read_index(self) -> bool:
        """Take what the index at the end tells; whether there is one."""
        bag, place, data = index_of(self._file)
        (chunks,) = U32.unpack(bag[b"chunk_count"])
        if place == 0:
            self.damage.append("The recording was not closed.")
            return False
        low, high = 2**62, 0
        for header, first, last in records_in(data):
            code = header.get(b"op")
            if code == CONNECTION:
                check_told(last - first)
                self._take_connection(header, data[first:last])
            elif code == CHUNK_INFO:
                info = chunk_info(header, data[first:last])
                self._chunks.append(_Chunk(info.position, info.counts))
                if info.counts:
                    low, high = min(low, info.start), max(high, info.end)
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
        (connection,) = U32.unpack(header[b"conn"])
        if connection in self._numbers or len(self.streams) >= MOST_STREAMS:
            return
        fields = fields_of(data)

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
                header, data, length = record_head(self._file, position)
                code = header.get(b"op")
                cut = data + length > self.size
                if code == CHUNK:
                    chunk = _Chunk(position)
                    self._look_at(chunk, header, data, min(length, self.size - data), cut)
                    self._chunks.append(chunk)
                    self._walk(chunk, learns=True)
                elif code == CONNECTION and not cut:
                    check_told(length)
                    self._take_connection(header, self._file.at(data, length))
                elif code not in (BAG, INDEX, CHUNK_INFO, CONNECTION):
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
        if header.get(b"op") != CHUNK:
            raise InputError(f"no chunk is at byte {chunk.position}")
        chunk.place, chunk.packed, chunk.cut = place, packed, cut
        chunk.method = header[b"compression"].decode("ascii", "replace")
        (chunk.size,) = U32.unpack(header[b"size"])

    def _walk(self, chunk: _Chunk, *, learns: bool) -> None:
        """Walk through a chunk's records and learn where its messages are.

        Args:
            chunk: The chunk.
            learns: Whether to count them, and to learn of connections: those that were found
                when the file was opened stay as they are.
        """
        walked = chunk.walked = array("q"), array("q"), array("q")
        connections, log_times, places = walked
        try:
            data = bytes(self._file.unpacked(chunk))
            for header, first, last in records_in(data):
                code = header.get(b"op")
                if code == MESSAGE:
                    (connection,) = U32.unpack(header[b"conn"])
                    log_times.append(time_of(header[b"time"]))
                    connections.append(connection)
                    places.append(first)
                    number = self._numbers.get(connection)
                    if learns and number is not None:
                        self.counts[number] += 1
                elif learns and code == CONNECTION:
                    check_told(last - first)
                    self._take_connection(header, data[first:last])
        except (InputError, struct.error, KeyError) as error:
            if not chunk.cut:
                self._file.note_chunk(chunk, reason_of(error))

    # Messages

    def expected(self, wanted: Collection[int]) -> int:
        """Return the messages of some streams, as the file counts them."""
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
                    self._file.note_chunk(chunk, reason_of(error))
                    try:
                        batch = self._rest_of(chunk, chosen)
                    except InputError as worse:
                        batch = None
                        self._file.note(f"A chunk at byte {chunk.position} is lost ({worse}).")
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
                Batch(data, *indexed(data, entries, connection), senders)
                for connection, entries in parts
                for senders in [np.full(len(entries), chosen[connection], dtype=np.int32)]
            ]
        )

    def _locate(self, chunk: _Chunk) -> None:
        """Find out where a chunk's data lies, if that is not known."""
        if not chunk.place:
            header, place, packed = record_head(self._file, chunk.position)
            self._look_at(chunk, header, place, packed, False)

    def _indexes(self, chunk: _Chunk, chosen: dict[int, int]) -> list[tuple[int, Entries]]:
        """The index records behind a chunk: chosen connections with messages, and what is told."""
        position = chunk.place + chunk.packed
        expected = len(chunk.counts) * 64 + 12 * sum(chunk.counts.values()) + 64
        data = self._file.up_to(position, expected)
        found = []
        missing = set(chunk.counts)
        for header, first, last in records_in(data, partial=True):
            if header.get(b"op") != INDEX:
                break
            (connection,) = U32.unpack(header[b"conn"])
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
            self._walk(chunk, learns=False)
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
