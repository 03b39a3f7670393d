"""A ROS 1 bag from front to back, chunk by chunk."""

import struct
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from tftool.errors import InputError
from tftool.sources.compressed import unpack, unpack_beginning
from tftool.sources.container import File
from tftool.sources.editing.pieces import Piece
from tftool.sources.editing.tape import Extras, Taken
from tftool.sources.find import ROS1_MAGIC
from tftool.sources.writing import rosbag1 as format
from tftool.sources.writing.channel import Channel
from tftool.stamps import NANOSECONDS, Stamp

_U32, _U64 = struct.Struct("<I"), struct.Struct("<Q")
_HEAD: Final = 4096
_LARGEST_HEADER: Final = 1 << 20
_LARGEST_INDEX: Final = 1 << 30


class Rosbag1Tape:
    """A ROS 1 bag; see `Tape`.

    Attributes:
        headers: Of each connection the topic and the header of its publisher, as recorded.
    """

    container = "bag"

    def __init__(self, path: Path) -> None:
        """Open it, and take what its index tells of its connections.

        Raises:
            InputError: If it is no ROS 1 bag.
            OSError: If it cannot be opened.
        """
        self._file = File(path)
        self.size = self._file.size
        self.channels: dict[int, Channel] = {}
        self.headers: dict[int, tuple[bytes, bytes]] = {}
        self.extras = Extras()
        self.damage: list[str] = []
        self.style: dict[str, Any] = {"compression": "none", "chunk_size": 0}
        self._infos: dict[int, tuple[int, int, dict[int, int]]] = {}
        if self._file.up_to(0, len(ROS1_MAGIC)) != ROS1_MAGIC:
            self.close()
            raise InputError(f"'{path}' is no ROS 1 bag.")
        try:
            self._read_index()
        except (InputError, struct.error, KeyError) as error:
            self._infos.clear()
            self.damage.append(f"Its index cannot be read ({_reason(error)}).")

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _read_index(self) -> None:
        header, _, _ = self._record_head(len(ROS1_MAGIC))
        if header.get(b"op") != format.BAG:
            raise InputError("the bag's own header is missing")
        (place,) = _U64.unpack(header[b"index_pos"])
        if not place:
            self.damage.append("The recording was not closed.")
            return
        if place > self.size or self.size - place > _LARGEST_INDEX:
            raise InputError(f"it should begin at byte {place} of {self.size}")
        data = self._file.at(place, self.size - place)
        for header, first, last in _records(data):
            code = header.get(b"op")
            if code == format.CONNECTION:
                self.learn(header, data[first:last])
            elif code == format.CHUNK_INFO:
                (position,) = _U64.unpack(header[b"chunk_pos"])
                pairs = struct.iter_unpack("<II", data[first : first + (last - first) // 8 * 8])
                times = _time(header[b"start_time"]), _time(header[b"end_time"])
                self._infos[position] = (*times, dict(pairs))
        if self._infos:
            # How it is written shows in its first chunk.
            position = min(self._infos)
            header, place, size = self._record_head(position)
            Rosbag1Chunk(self, position, header, place, min(place + size, self.size))

    def learn(self, header: Mapping[bytes, bytes], data: bytes) -> None:
        """Take what a record tells of a connection."""
        (number,) = _U32.unpack(header[b"conn"])
        if number in self.channels:
            return
        fields = _fields(data)

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

    def blocks(self) -> "Iterator[Rosbag1Chunk]":
        """Its chunks."""
        position, ended = len(ROS1_MAGIC), False
        while position < self.size:
            try:
                header, data, length = self._record_head(position)
            except (InputError, struct.error):
                break
            code = header.get(b"op")
            end = data + length
            if code == format.CHUNK:
                try:
                    chunk = Rosbag1Chunk(self, position, header, data, min(end, self.size))
                except (InputError, struct.error, KeyError) as error:
                    self.note(f"A chunk at byte {position} cannot be read ({_reason(error)}).")
                    break
                chunk.cut = end > self.size
                position = end if chunk.cut else self._behind_index(chunk, end)
                if chunk.cut:
                    chunk.whole = False
                yield chunk
                continue
            if code not in (format.BAG, format.INDEX, format.CHUNK_INFO, format.CONNECTION):
                break
            if end > self.size:
                break
            if code == format.CONNECTION:
                self.learn(header, self._file.at(data, length))
            ended = ended or code == format.CHUNK_INFO
            position = end
        if position != self.size and not (ended and position > self.size):
            self.note(f"The recording breaks off at byte {min(position, self.size)}.")

    def _behind_index(self, chunk: "Rosbag1Chunk", position: int) -> int:
        """Step over the index behind a chunk; where it ends."""
        counts: dict[int, int] = {}
        while position < self.size:
            try:
                header, data, length = self._record_head(position)
            except (InputError, struct.error):
                break
            if header.get(b"op") != format.INDEX or data + length > self.size:
                break
            (number,) = _U32.unpack(header[b"conn"])
            counts[number] = counts.get(number, 0) + length // 12
            position = data + length
        chunk.behind = position
        info = self._infos.get(chunk.position)
        known = counts.keys() <= self.channels.keys()
        if info is not None and known and info[2] == counts:
            chunk.start, chunk.end, chunk.channels = info
            chunk.whole = True
        return position

    def note(self, damage: str) -> None:
        """Tell what is wrong."""
        if damage not in self.damage and len(self.damage) < 20:
            self.damage.append(damage)

    def fileno(self) -> int:
        """The file's number."""
        return self._file.fileno()

    def bytes_at(self, place: int, count: int) -> bytes:
        """So many bytes of the file."""
        return self._file.at(place, count)


class Rosbag1Chunk:
    """One chunk with its index; see `Block`."""

    def __init__(
        self, tape: Rosbag1Tape, position: int, header: Mapping[bytes, bytes], data: int, end: int
    ) -> None:
        self._tape = tape
        self.position = position
        self._data, self._packed = data, end - data
        self._method = header[b"compression"].decode("ascii", "replace")
        (self._size,) = _U32.unpack(header[b"size"])
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
        return Piece(self._tape.fileno(), self.position, self.behind - self.position)

    def messages(self) -> list[Taken]:
        """Its messages, those up to the damage where there is any."""
        if self._found is not None:
            return self._found
        found: list[Taken] = []
        data = self._unpacked()
        try:
            for header, first, last in _records(data):
                code = header.get(b"op")
                if code == format.MESSAGE:
                    (number,) = _U32.unpack(header[b"conn"])
                    log_time = _time(header[b"time"])
                    found.append(Taken(number, log_time, data[first:last], log_time, 0))
                elif code == format.CONNECTION:
                    self._tape.learn(header, data[first:last])
        except (InputError, struct.error, KeyError) as error:
            if not self.cut:
                self._tape.note(f"The chunk at byte {self.position} is damaged ({_reason(error)}).")
            self.whole = False
        self._found = found
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
            self._unpacked()
        self._is_examined = True
        return self.whole

    def _unpacked(self) -> bytes:
        packed = self._tape.bytes_at(self._data, self._packed)
        if self.cut:
            return unpack_beginning(self._method, packed, self._size)
        try:
            return unpack(self._method, packed, self._size)
        except InputError as error:
            self._tape.note(f"The chunk at byte {self.position} is damaged ({error}).")
            self.whole = False
            return unpack_beginning(self._method, packed, self._size)


def _records(data: bytes) -> Iterator[tuple[dict[bytes, bytes], int, int]]:
    """Every record's header, and where its data begins and ends."""
    position, size = 0, len(data)
    while position + 4 <= size:
        (length,) = _U32.unpack_from(data, position)
        if position + 8 + length > size:
            raise InputError("it ends within a record")
        header = _fields(data[position + 4 : position + 4 + length])
        (count,) = _U32.unpack_from(data, position + 4 + length)
        first = position + 8 + length
        position = first + count
        if position > size:
            raise InputError("it ends within a record")
        yield header, first, position


def _fields(data: bytes) -> dict[bytes, bytes]:
    """Fields of a header by their names."""
    found: dict[bytes, bytes] = {}
    position, size = 0, len(data)
    while position + 4 <= size:
        (length,) = _U32.unpack_from(data, position)
        name, equals, value = data[position + 4 : position + 4 + length].partition(b"=")
        position += 4 + length
        if position > size or not equals:
            raise InputError("a header's field goes on behind it")
        found[name] = value
    return found


def _time(raw: bytes) -> Stamp:
    sec, nanosec = struct.unpack("<II", raw)
    return int(sec) * NANOSECONDS + int(nanosec)


def _reason(error: Exception) -> str:
    return str(error) if isinstance(error, InputError) else "a record is cut"
