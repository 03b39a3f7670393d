"""Reader of ROS 1 bags of version 2.0: by index, else chunk by chunk up to any damage.

Source: wiki.ros.org/Bags/Format/2.0.
"""

from collections.abc import Collection, Container, Iterator, Mapping
from pathlib import Path

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import NANOSECONDS
from tftool.messages.transform_rows import Bytes
from tftool.recordings.channel import Channel
from tftool.recordings.chunked import FAULTS, Chunk, ChunkedReader, reason_of
from tftool.recordings.columns import Batch, in_order, words_at
from tftool.recordings.container import MessageHead, MessageTable, check_description_size
from tftool.recordings.containers import ROS1_MAGIC
from tftool.recordings.contract import Progress, Stamps
from tftool.recordings.decompression import Ahead, Packed
from tftool.recordings.rosbag1.format import (
    BAG,
    CHUNK,
    CHUNK_INFO,
    CONNECTION,
    INDEX,
    MESSAGE,
    U32,
    ChunkInfo,
    Entries,
    chunk_info,
    fields_of,
    index_of,
    indexed,
    record_head,
    records_in,
    time_of,
)

_BEFORE_TIME = int.from_bytes(b"ime=", "little")  # four bytes before the time in a header
_KEPT = (b"callerid", b"latching", b"md5sum")


class Rosbag1(ChunkedReader):
    """Reader of a ROS 1 bag; see `ContainerReader`."""

    kind = "ROS 1 bag"
    container = "bag"
    magic = ROS1_MAGIC

    def __init__(self, path: Path, *, by_index: bool = True) -> None:
        """Open the file, and find its connections and chunks.

        Args:
            path: Path of the file.
            by_index: True to read messages by the index with `batches`; a missing index is built.
                False to read messages in the order of the file with `blocks`.

        Raises:
            InputError: If nothing of the file can be read.
            OSError: If the file cannot be opened.
        """
        super().__init__(path, {"compression": "none", "chunk_size": 0})
        self._headers: dict[int, tuple[bytes, bytes]] = {}
        self._infos: dict[int, ChunkInfo] = {}
        self._by_index = by_index
        self._ended_at, self._ended = 0, False
        try:
            self._open()
        except BaseException:
            self.close()
            raise

    def _open(self) -> None:
        """Find the connections and chunks by the index; without an index, read the whole file."""
        complete = False
        try:
            complete = self._read_index()
        except FAULTS as error:
            self._forget()
            self.damage.append(f"The index cannot be read ({reason_of(error)}).")
        if self._by_index and not complete:
            self._scan(self._pieces())
            if self._ended_at < self.size:
                self._note_end(self._ended_at)
            # Without an index, only the messages tell the time span.
            spans = [one.walked.span for one in self._chunks if one.walked and len(one.walked)]
            self.start = min((low for low, _ in spans), default=0)
            self.end = max((high for _, high in spans), default=0)

    def origin(self, number: int) -> tuple[bytes, bytes]:
        """Return the topic and the connection header of a connection, as recorded bytes."""
        return self._headers[number]

    # Index

    def _read_index(self) -> bool:
        """Read the index at the end of the file; return whether there is an index.

        Raises:
            InputError: If the index is damaged. All exceptions in `FAULTS` are possible.
        """
        bag, place, data = index_of(self)
        # rosbag writes the offset of the index when it closes the bag.
        if place == 0:
            self.damage.append("The recording was not closed.")
            return False
        for header, first, last in records_in(data):
            code = header.get(b"op")
            if code == CONNECTION:
                self._describe(header, data[first:last])
            elif code == CHUNK_INFO:
                info = chunk_info(header, data[first:last])
                self._infos[info.position] = info
        infos = sorted(self._infos.values())
        if not self._by_index:
            if infos:
                # Detect compression and size from the first chunk.
                self._chunk_at(infos[0].position, *record_head(self, infos[0].position))
            return True
        # An index that is cut off may lack its last chunks.
        (count,) = U32.unpack(bag[b"chunk_count"])
        if len(infos) != count:
            raise InputError(f"the index names {len(infos)} chunks instead of {count}")
        if any(info.position >= place for info in infos):
            raise InputError("a chunk is beyond the end of the file")
        # The header of a chunk is read by `_locate`, when its messages are needed.
        for info in infos:
            self._chunks.append(Chunk(self, info.position, counts=info.counts))
            self._count(info.counts)
        filled = [info for info in infos if info.counts]
        self.start = min((info.start for info in filled), default=0)
        self.end = max((info.end for info in filled), default=0)
        return True

    def _forget(self) -> None:
        """Drop connections and chunks found so far, before the file is read sequentially."""
        super()._forget()
        self._headers.clear()
        self._infos.clear()

    def _describe(self, header: Mapping[bytes, bytes], data: bytes) -> None:
        """Register the connection in a record; ignore a connection number in use."""
        check_description_size(len(data))
        (number,) = U32.unpack(header[b"conn"])
        if number in self.channels:
            return
        fields = fields_of(data)

        def text(name: bytes) -> str:
            return fields.get(name, b"").decode("utf-8", "surrogateescape")

        # The publisher's own header may have the name before remapping.
        topic = header.get(b"topic") or fields.get(b"topic", b"")
        self._headers[number] = topic, data
        metadata = tuple((key.decode(), text(key)) for key in _KEPT if key in fields)
        definition = fields.get(b"message_definition", b"")
        name = topic.decode("utf-8", "surrogateescape")
        self._learn(number, Channel(name, text(b"type"), "ros1", "ros1msg", definition, metadata))

    # Sequential reading

    def blocks(self) -> Iterator[Chunk]:
        """Yield the chunks of the bag."""
        yield from self._pieces()
        if not self._ended:
            self.note(f"The recording breaks off at byte {self._ended_at}.")

    def _pieces(self) -> Iterator[Chunk]:
        """Yield the chunks, reading record by record."""
        position, size = len(ROS1_MAGIC), self.size
        while position < size:
            try:
                header, data, length = record_head(self, position)
            except FAULTS:
                break
            code, end = header.get(b"op"), data + length
            # These bytes are not a record, so the next record cannot be found either.
            if code not in (BAG, INDEX, CHUNK, CHUNK_INFO, CONNECTION):
                break
            try:
                if code == CHUNK:
                    chunk = self._chunk_at(position, header, data, length)
                    if not chunk.cut:
                        self._read_indexes(chunk)
                    yield chunk
                    end = max(end, chunk.behind)
                elif code == CONNECTION and end <= size:
                    self._describe(header, self.at(data, length))
            except FAULTS as error:
                self.note(f"A record at byte {position} cannot be read ({reason_of(error)}).")
                # The end of a chunk depends on the index records after it.
                if code == CHUNK:
                    break
            if end > size:
                break
            position = end
        self._ended_at, self._ended = position, position >= size

    def _chunk_at(
        self, position: int, header: Mapping[bytes, bytes], data: int, length: int
    ) -> Chunk:
        """Return the chunk in a record, and store the chunk's compression and size in `style`."""
        chunk = Chunk(self, position)
        self._look_at(chunk, header, data, length)
        style = self.style
        style["compression"] = chunk.method
        style["chunk_size"] = max(style["chunk_size"], chunk.size)
        return chunk

    def _look_at(self, chunk: Chunk, header: Mapping[bytes, bytes], data: int, length: int) -> None:
        """Parse the header of a chunk record, and set the fields of `chunk`."""
        if header.get(b"op") != CHUNK:
            raise InputError(f"the record at byte {chunk.position} is not a chunk")
        (chunk.size,) = U32.unpack(header[b"size"])
        chunk.method = header[b"compression"].decode("ascii", "replace")
        is_open = not length and not chunk.size and not self._infos
        if is_open and chunk.method == "none":
            # rosbag writes the sizes when it closes a chunk: an open chunk extends to the end.
            length = chunk.size = self.size - data
        chunk.cut = is_open or data + length > self.size
        chunk.place, chunk.packed = data, min(length, self.size - data)
        chunk.behind = data + chunk.packed
        chunk.length = chunk.behind - chunk.position

    def _read_indexes(self, chunk: Chunk) -> None:
        """Read the index records after a chunk; ignore records that contradict the bag's index."""
        counts: dict[int, int] = {}
        while chunk.behind < self.size:
            try:
                header, data, length = record_head(self, chunk.behind)
                if header.get(b"op") != INDEX or data + length > self.size:
                    break
                (number,) = U32.unpack(header[b"conn"])
            except FAULTS:
                break
            # An entry has 12 bytes: seconds, nanoseconds, offset.
            counts[number] = counts.get(number, 0) + length // 12
            chunk.behind = data + length
        info = self._infos.get(chunk.position)
        if info is not None and info.counts == counts and counts.keys() <= self.channels.keys():
            chunk.start, chunk.end, chunk.counts = info.start, info.end, counts
            chunk.whole = True

    def _heads(self, data: bytes, *, learns: bool) -> Iterator[MessageHead]:
        """Yield the headers of the messages in some records; see `ChunkedReader`."""
        for header, first, last in records_in(data):
            code = header.get(b"op")
            if code == MESSAGE:
                (number,) = U32.unpack(header[b"conn"])
                log_time = time_of(header[b"time"])
                yield MessageHead(number, log_time, first, last, log_time)
            elif learns and code == CONNECTION:
                self._describe(header, data[first:last])

    def _parts(self, chunk: Chunk, data: Bytes) -> Iterator[tuple[int, Stamps, Stamps, Stamps]]:
        """Yield the offsets of the messages in a chunk; see `ChunkedReader`."""
        for connection, entries in self._entries(chunk, self.channels):
            starts, lengths, _ = indexed(data, entries, connection)
            begins = entries[:, 2].astype(np.int64)
            # Most writers put the time at the end of a message's header.
            times = np.stack([words_at(data, starts - n, "<u4") for n in (12, 8)], axis=1)
            marks = words_at(data, starts - 16, "<u4")
            if (times != entries[:, :2]).any() or (marks != _BEFORE_TIME).any():
                raise InputError("the times in the index differ from those of the messages")
            yield connection, begins, starts, lengths

    def _moments(self, data: Bytes, starts: Stamps) -> tuple[Stamps, Stamps, Stamps]:
        """Return the log times twice, as log and publish times, and sequence numbers of 0."""
        sec, nanosec = (words_at(data, starts - n, "<u4").astype(np.int64) for n in (12, 8))
        log_times = sec * NANOSECONDS + nanosec
        return log_times, log_times, np.zeros(len(starts), dtype=np.int64)

    def walked_table(self, chunk: Chunk) -> MessageTable:
        """Return a chunk's messages from its records, and set the chunk's start and end."""
        found = super().walked_table(chunk)
        chunk.start = int(found.log_times.min()) if len(found) else 0
        chunk.end = int(found.log_times.max()) if len(found) else 0
        return found

    # Messages

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams in batches; see `Container`."""
        chosen = self._chosen(wanted)

        def batch_of(chunk: Chunk, ahead: Ahead) -> Batch | None:
            return self._batch(chunk, chosen, ahead)

        for chunk, batch in self._chunk_batches(chosen, batch_of):
            if batch is not None:
                yield batch
            if progress is not None:
                progress(chunk.position, self.size)

    def _batch(self, chunk: Chunk, chosen: Mapping[int, int], ahead: Ahead) -> Batch | None:
        self._locate(chunk)
        parts = self._entries(chunk, chosen)
        if not parts:
            return None
        data = np.frombuffer(self.unpacked(chunk, ahead), dtype=np.uint8)
        return in_order(
            [
                Batch(data, *indexed(data, entries, connection), senders)
                for connection, entries in parts
                for senders in [np.full(len(entries), chosen[connection], dtype=np.int32)]
            ]
        )

    def _locate(self, chunk: Chunk) -> None:
        """Find the offset of a chunk's data, if the offset is unknown."""
        if not chunk.place:
            self._look_at(chunk, *record_head(self, chunk.position))

    def _entries(self, chunk: Chunk, chosen: Container[int]) -> list[tuple[int, Entries]]:
        """Return, for each chosen connection in a chunk, its number and its index entries."""
        counts = chunk.counts or {}
        # One read for all index records: 64 bytes for each header, 12 for each message.
        expected = len(counts) * 64 + 12 * sum(counts.values()) + 64
        data = self.up_to(chunk.place + chunk.packed, expected)
        found = []
        missing = set(counts)
        for header, first, last in records_in(data, partial=True):
            if header.get(b"op") != INDEX:
                break
            (connection,) = U32.unpack(header[b"conn"])
            missing.discard(connection)
            count = (last - first) // 12
            if connection in chosen and count:
                table = np.frombuffer(data, dtype="<u4", count=3 * count, offset=first)
                found.append((connection, table.reshape(-1, 3)))
        # Without this check, messages would be lost silently.
        if any(connection in chosen for connection in missing):
            raise InputError("the index of the chunk is incomplete")
        return found

    def _ahead(self, chunk: Chunk) -> Packed | None:
        """Return the data to decompress ahead of reading; None for a cut or uncompressed chunk."""
        try:
            self._locate(chunk)
        except FAULTS:
            return None
        return super()._ahead(chunk)
