"""A ROS 1 bag from front to back, chunk by chunk."""

import struct
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from tftool.base.errors import InputError
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.container import ChunkedFile, check_told
from tftool.recordings.decompression import unpack, unpack_beginning
from tftool.recordings.edit.pieces import Piece
from tftool.recordings.edit.tape import Extras, Taken, described
from tftool.recordings.find import ROS1_MAGIC
from tftool.recordings.rosbag1.format import (
    BAG,
    CHUNK,
    CHUNK_INFO,
    CONNECTION,
    INDEX,
    MESSAGE,
    U32,
    ChunkInfo,
    chunk_info,
    fields_of,
    index_of,
    reason_of,
    record_head,
    records_in,
    time_of,
)


class Rosbag1Tape:
    """A ROS 1 bag; see `Tape`.

    Attributes:
        file: Itself.
        headers: Of each connection the topic and the header of its publisher, as recorded.
    """

    container = "bag"

    def __init__(self, path: Path) -> None:
        """Open it, and take what its index tells of its connections.

        Raises:
            InputError: If it is no ROS 1 bag.
            OSError: If it cannot be opened.
        """
        self.file = ChunkedFile(path)
        self.size = self.file.size
        self.channels: dict[int, Channel] = {}
        self.headers: dict[int, tuple[bytes, bytes]] = {}
        self.extras = Extras()
        self.damage = self.file.damage
        self.style: dict[str, Any] = {"compression": "none", "chunk_size": 0}
        self._infos: dict[int, ChunkInfo] = {}
        if self.file.up_to(0, len(ROS1_MAGIC)) != ROS1_MAGIC:
            self.close()
            raise InputError(f"'{path}' is no ROS 1 bag.")
        try:
            self._read_index()
        except (InputError, struct.error, KeyError) as error:
            self._infos.clear()
            self.damage.append(f"Its index cannot be read ({reason_of(error)}).")

    def close(self) -> None:
        """Close the file."""
        self.file.close()

    def _read_index(self) -> None:
        _, place, data = index_of(self.file)
        if place == 0:
            self.damage.append("The recording was not closed.")
            return
        for header, first, last in records_in(data):
            code = header.get(b"op")
            if code == CONNECTION:
                self.learn(header, data[first:last])
            elif code == CHUNK_INFO:
                info = chunk_info(header, data[first:last])
                self._infos[info.position] = info
        if self._infos:
            # How it is written shows in its first chunk.
            position = min(self._infos)
            header, place, size = record_head(self.file, position)
            Rosbag1Chunk(self, position, header, place, min(place + size, self.size))

    def learn(self, header: Mapping[bytes, bytes], data: bytes) -> None:
        """Take what a record tells of a connection."""
        (number,) = U32.unpack(header[b"conn"])
        if number in self.channels:
            return
        check_told(len(data))
        fields = fields_of(data)

        def text(name: bytes) -> str:
            return fields.get(name, b"").decode("utf-8", "surrogateescape")

        topic = header.get(b"topic", fields.get(b"topic", b""))
        self.headers[number] = topic, data
        keys = (b"callerid", b"latching", b"md5sum")
        self.channels[number] = Channel(
            topic.decode("utf-8", "surrogateescape"),
            text(b"type"),
            "ros1",
            "ros1msg",
            fields.get(b"message_definition", b""),
            tuple((key.decode(), text(key)) for key in keys if key in fields),
        )

    def blocks(self) -> "Iterator[Rosbag1Chunk]":
        """Its chunks."""
        position, ended = len(ROS1_MAGIC), False
        while position < self.size:
            try:
                header, data, length = record_head(self.file, position)
            except (InputError, struct.error):
                break
            code = header.get(b"op")
            end = data + length
            if code == CHUNK:
                try:
                    chunk = Rosbag1Chunk(self, position, header, data, min(end, self.size))
                except (InputError, struct.error, KeyError) as error:
                    self.file.note(
                        f"A chunk at byte {position} cannot be read ({reason_of(error)})."
                    )
                    break
                chunk.cut = end > self.size
                position = end if chunk.cut else self._behind_index(chunk, end)
                if chunk.cut:
                    chunk.whole = False
                yield chunk
                continue
            if code not in (BAG, INDEX, CHUNK_INFO, CONNECTION):
                break
            if end > self.size:
                break
            if code == CONNECTION:
                try:
                    self.learn(header, self.file.at(data, length))
                except (InputError, struct.error, KeyError) as error:
                    self.file.note(
                        f"A record at byte {position} cannot be read ({reason_of(error)})."
                    )
            ended = ended or code == CHUNK_INFO
            position = end
        if position != self.size and not (ended and position > self.size):
            self.file.note(f"The recording breaks off at byte {min(position, self.size)}.")

    def _behind_index(self, chunk: "Rosbag1Chunk", position: int) -> int:
        """Step over the index behind a chunk; where it ends."""
        counts: dict[int, int] = {}
        while position < self.size:
            try:
                header, data, length = record_head(self.file, position)
                if header.get(b"op") != INDEX or data + length > self.size:
                    break
                (number,) = U32.unpack(header[b"conn"])
            except (InputError, struct.error, KeyError):
                break
            counts[number] = counts.get(number, 0) + length // 12
            position = data + length
        chunk.behind = position
        info = self._infos.get(chunk.position)
        known = counts.keys() <= self.channels.keys()
        if info is not None and known and info.counts == counts:
            chunk.start, chunk.end, chunk.channels = info.start, info.end, counts
            chunk.whole = True
        return position


class Rosbag1Chunk:
    """One chunk with its index; see `Block`."""

    def __init__(
        self, tape: Rosbag1Tape, position: int, header: Mapping[bytes, bytes], data: int, end: int
    ) -> None:
        self._tape = tape
        self.position = position
        self._data, self._packed = data, end - data
        self._method = header[b"compression"].decode("ascii", "replace")
        (self._size,) = U32.unpack(header[b"size"])
        tape.style["compression"] = self._method
        tape.style["chunk_size"] = max(tape.style["chunk_size"], self._size)
        self.behind = end
        self.cut = False
        self.whole = False
        self.start: Stamp = 0
        self.end: Stamp = 0
        self.channels: Mapping[int, int] | None = None
        self._found: list[Taken] | None = None
        self._is_examined = False

    def raw(self) -> Piece:
        """Its record and those of its index."""
        return Piece(self._tape.file.fileno(), self.position, self.behind - self.position)

    def messages(self) -> list[Taken]:
        """Its messages, those up to the damage where there is any."""
        if self._found is not None:
            return self._found
        found: list[Taken] = []
        data = self._unpacked()
        try:
            for header, first, last in records_in(data):
                code = header.get(b"op")
                if code == MESSAGE:
                    (number,) = U32.unpack(header[b"conn"])
                    log_time = time_of(header[b"time"])
                    found.append(Taken(number, log_time, data[first:last], log_time, 0))
                elif code == CONNECTION:
                    self._tape.learn(header, data[first:last])
        except (InputError, struct.error, KeyError) as error:
            if not self.cut:
                self._tape.file.note(
                    f"The chunk at byte {self.position} is damaged ({reason_of(error)})."
                )
            self.whole = False
        self._found = found = described(found, self._tape.channels, self._tape.file)
        counts: dict[int, int] = {}
        for one in found:
            counts[one.channel] = counts.get(one.channel, 0) + 1
        if counts != self.channels:
            self.whole = False
        self.channels = counts
        self.start = min((one.log_time for one in found), default=0)
        self.end = max((one.log_time for one in found), default=0)
        return found

    def sound(self) -> bool:
        """Whether it can be unpacked; found out once."""
        if self._found is None and not self._is_examined and self._method != "none":
            self._whole(self._tape.file.at(self._data, self._packed))
        self._is_examined = True
        return self.whole

    def _unpacked(self) -> bytes:
        packed = self._tape.file.at(self._data, self._packed)
        whole = None if self.cut else self._whole(packed)
        return unpack_beginning(self._method, packed, self._size) if whole is None else whole

    def _whole(self, packed: bytes) -> bytes | None:
        """All that it holds; None where it is damaged, which is noted."""
        try:
            return unpack(self._method, packed, self._size)
        except InputError as error:
            self._tape.file.note(f"The chunk at byte {self.position} is damaged ({error}).")
            self.whole = False
        return None
