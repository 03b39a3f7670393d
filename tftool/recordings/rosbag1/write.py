"""Writer of ROS 1 bags of version 2.0: chunks with indexes, connections, and the bag's index.

Source: wiki.ros.org/Bags/Format/2.0.
"""

import os
import struct
from array import array
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.chunked import Chunk
from tftool.recordings.chunked_writer import ChunkedWriter
from tftool.recordings.container import MessageTable
from tftool.recordings.containers import ROS1_MAGIC
from tftool.recordings.message_conversion import as_ros1
from tftool.recordings.rosbag1.format import (
    BAG,
    CHUNK,
    CHUNK_INFO,
    CONNECTION,
    INDEX,
    U32,
    U64,
    records_in,
)

COMPRESSIONS: Final = ("none", "bz2", "lz4")

CHUNK_SIZE: Final = 768 * 1024
"""Default size of a chunk's uncompressed messages, bytes, as in ROS 1."""

_INDEX_FIELDS: Final = ("op", "ver", "conn", "count")
_HEADER_SIZE: Final = 4096  # bytes of the bag's header record, which is written again at the end
_BEFORE: Final = b"\x26\x00\x00\x00\x04\x00\x00\x00op=\x02\x09\x00\x00\x00conn="
_BETWEEN: Final = b"\x0d\x00\x00\x00time="
_HEADS = np.dtype(
    [
        ("before", f"V{len(_BEFORE)}"),
        ("connection", "<u4"),
        ("between", f"V{len(_BETWEEN)}"),
        ("sec", "<u4"),
        ("nanosec", "<u4"),
        ("length", "<u4"),
    ]
)
"""numpy's type of a message's record before the payload: fields of 4, 9 and 13 bytes, a length."""

_LATEST: Final = 2**32 * NANOSECONDS


class Rosbag1Writer(ChunkedWriter):
    """Writer of a ROS 1 bag; its channels are connections."""

    @staticmethod
    def in_style(path: Path, style: Mapping[str, Any], *, profile: str) -> "Rosbag1Writer":
        """Create an output file of an edit; see `ContainerFormat.create_like`."""
        del profile
        size = style.get("chunk_size") or CHUNK_SIZE
        return Rosbag1Writer(
            path,
            compression=style.get("compression", "none"),
            chunk_size=min(max(size, 1 << 12), 1 << 24),
        )

    def __init__(
        self, path: Path, *, compression: str = "none", chunk_size: int = CHUNK_SIZE
    ) -> None:
        """Create the file; replace an existing file.

        Args:
            path: Path of the file.
            compression: Compression of each chunk: "none", "bz2" or "lz4".
            chunk_size: Size of a chunk's uncompressed messages, bytes.

        Raises:
            UsageError: If the compression is not known, or not installed.
            OSError: If the file cannot be written.
        """
        if compression not in COMPRESSIONS:
            raise UsageError(
                f"'{compression}' is not a compression of ROS 1 bags: use "
                f"{', '.join(COMPRESSIONS)}."
            )
        super().__init__(path, compression)
        self._chunk_size = chunk_size
        self._infos: list[bytes] = []
        self._put(ROS1_MAGIC + self._head(0))

    def channel(self, channel: Channel, number: int | None = None) -> int:
        """Register a connection, and return the number that `write` needs."""
        known = self._known.get(channel)
        if known is not None and number in (None, known):
            return known
        fields = {
            "topic": channel.topic.encode("utf-8", "surrogateescape"),
            "type": channel.type.encode(),
            "md5sum": (channel.extra("md5sum") or "*").encode(),
            "message_definition": channel.definition,
        }
        for key in ("callerid", "latching"):
            if channel.extra(key):
                fields[key] = channel.extra(key).encode("utf-8", "surrogateescape")
        if number is None:
            number = max(len(self._channel_records), self.first_free)
            while number in self._channel_records:
                number += 1
        self._known[channel] = number
        self._add_connection(number, fields["topic"], packed_fields(fields))
        return number

    def _add_connection(self, number: int, topic: bytes, header: bytes) -> None:
        """Register a connection, given its topic and the publisher's connection header."""
        head = {"op": CONNECTION, "conn": U32.pack(number), "topic": topic}
        self._channel_records[number] = record(head, header)

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append one message; `publish_time` and `sequence` are not stored."""
        if channel not in self._defined:
            self._defined.add(channel)
            self._keep(self._channel_records[channel])
        if not 0 <= log_time < _LATEST:
            raise InputError(f"A log time of {log_time} ns does not fit into ROS 1's seconds.")
        sec, nanosec = divmod(log_time, NANOSECONDS)
        index = self._indexes.get(channel)
        if index is None:
            index = self._indexes[channel] = array("I")
        index.extend((sec, nanosec, self._length))
        self._keep(_message(channel, sec, nanosec, len(payload)))
        self._keep(payload)
        self._chunk_low, self._chunk_high = (
            min(self._chunk_low, log_time),
            max(self._chunk_high, log_time),
        )
        if self._length >= self._chunk_size:
            self.flush()

    def write_table(self, table: MessageTable) -> bool:
        """Append messages in bulk, and return True; return False if `write` must append them."""
        logs = table.log_times
        known = self._defined.issuperset(table.owners)
        if not known or not 0 <= int(logs.min()) <= int(logs.max()) < _LATEST:
            return False
        heads = np.zeros(len(table), dtype=_HEADS)
        heads["before"], heads["between"] = np.void(_BEFORE), np.void(_BETWEEN)
        heads["connection"] = table.channels
        heads["sec"], heads["nanosec"] = np.divmod(logs, NANOSECONDS)
        heads["length"] = table.lengths
        data, places = table.with_headers(heads)
        ends = np.append(places[1:], len(data))
        begin = 0
        while begin < len(table):
            # Append up to the message that fills the chunk.
            moved = self._length - int(places[begin])
            full = int(np.searchsorted(ends, self._chunk_size - moved))
            end = min(full + 1, len(table))
            which = slice(begin, end)
            columns = [heads["sec"][which], heads["nanosec"][which], places[which] + moved]
            entries = np.stack(columns, axis=1).astype(np.uint32)
            owners = table.channels[which]
            for channel in dict.fromkeys(owners.tolist()):
                index = self._indexes.setdefault(channel, array("I"))
                index.frombytes(entries[owners == channel].tobytes())
            self._chunk_low = min(self._chunk_low, int(logs[which].min()))
            self._chunk_high = max(self._chunk_high, int(logs[which].max()))
            self._keep(data[places[begin] : ends[end - 1]].tobytes())
            if self._length >= self._chunk_size:
                self.flush()
            begin = end
        return True

    def flush(self) -> None:
        """Write the buffered messages as a chunk."""
        if not self._length:
            return
        data = b"".join(self._pieces)
        indexes, low, high = self._indexes, self._chunk_low, self._chunk_high
        self._new_chunk()
        head = {"op": CHUNK, "compression": self.method.encode(), "size": U32.pack(len(data))}
        parts = [record(head, self._pack(data))]
        counts = {}
        for number, index in indexes.items():
            counts[number] = len(index) // 3
            values = INDEX, U32.pack(1), U32.pack(number), U32.pack(counts[number])
            described = dict(zip(_INDEX_FIELDS, values, strict=True))
            parts.append(record(described, index.tobytes()))
        self._note_chunk(low if counts else 0, high, counts)
        self._put(b"".join(parts))

    def agrees(self, schemas: Mapping[int, object]) -> bool:
        """Return True, because bags have no schema numbers that could conflict."""
        return True

    def adopt(self, channel: Channel, number: int, origin: tuple[bytes, bytes]) -> None:
        """Register a connection of another bag under the same number.

        Args:
            channel: The connection.
            number: Number of the connection in both bags.
            origin: Topic and connection header of the connection; see `Rosbag1.origin`.
        """
        self._add_connection(number, *origin)

    def end_block(self, chunk: Chunk) -> None:
        """Do nothing, because a chunk of a bag ends only when it is full."""

    def copy_chunk(self, chunk: Chunk) -> None:
        """Copy a chunk and its index from another bag.

        The headers of the index are written anew: readers such as rosbags expect the fields of all
        indexes of a bag in one order.
        """
        self.flush()
        self._note_chunk(chunk.start, chunk.end, chunk.counts or {})
        whole = chunk.raw()
        self._copy(replace(whole, length=chunk.length))
        indexes = chunk.reader.at(whole.place + chunk.length, whole.length - chunk.length)
        for fields, first, last in records_in(indexes):
            named = {name.decode("latin-1"): value for name, value in fields.items()}
            usual = {name: named.pop(name) for name in _INDEX_FIELDS if name in named}
            self._put(record(usual | named, indexes[first:last]))

    def _note_chunk(self, start: Stamp, end: Stamp, counts: Mapping[int, int]) -> None:
        for number, count in counts.items():
            self.counts[number] = self.counts.get(number, 0) + count
        described = {
            "op": CHUNK_INFO,
            "ver": U32.pack(1),
            "chunk_pos": U64.pack(self.position),
            "start_time": struct.pack("<II", *divmod(start, NANOSECONDS)),
            "end_time": struct.pack("<II", *divmod(end, NANOSECONDS)),
            "count": U32.pack(len(counts)),
        }
        data = b"".join(struct.pack("<II", *pair) for pair in counts.items())
        self._infos.append(record(described, data))

    def finish(self) -> None:
        """Write buffered messages and the index, and close the file."""
        try:
            self.flush()
            place = self.position
            self._put(b"".join([*self._channel_records.values(), *self._infos]))
            os.lseek(self._file.fileno(), len(ROS1_MAGIC), os.SEEK_SET)
            self._put(self._head(place))
        finally:
            self._file.close()

    def _head(self, place: int) -> bytes:
        """Return the bag's header record, padded to its fixed size; the index begins at `place`."""
        fields = packed_fields(
            {
                "op": BAG,
                "index_pos": U64.pack(place),
                "conn_count": U32.pack(len(self._channel_records)),
                "chunk_count": U32.pack(len(self._infos)),
            }
        )
        filling = b" " * (_HEADER_SIZE - 8 - len(fields))
        return U32.pack(len(fields)) + fields + U32.pack(len(filling)) + filling


class Ros1Messages(Rosbag1Writer):
    """Writer that converts ROS 2 messages and writes a ROS 1 bag; see `ContainerWriter`."""

    def __init__(self, path: Path, *, compression: str | None = None) -> None:
        """Create the file; see `Rosbag1Writer`."""
        super().__init__(path, compression=compression or "none")
        self._payloads: dict[int, Callable[[bytes], bytes]] = {}

    def channel(self, channel: Channel, number: int | None = None) -> int:
        """Register a ROS 2 channel as a connection, and return the connection's number.

        Raises:
            InputError: If ROS 1 has no equivalent type.
        """
        conversion = as_ros1(channel)
        number = super().channel(conversion.channel, number)
        self._payloads[number] = conversion.payload
        return number

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Convert and append one message."""
        super().write(channel, log_time, self._payloads[channel](payload))


def packed_fields(fields: Mapping[str, bytes]) -> bytes:
    """Return the bytes of a header's fields: "name=value", each with its length in front."""
    pairs = [name.encode() + b"=" + value for name, value in fields.items()]
    return b"".join(U32.pack(len(pair)) + pair for pair in pairs)


def record(fields: Mapping[str, bytes], data: bytes) -> bytes:
    """Return the bytes of a record with header and data."""
    head = packed_fields(fields)
    return U32.pack(len(head)) + head + U32.pack(len(data)) + data


def _message(number: int, sec: int, nanosec: int, length: int) -> bytes:
    """Return the bytes of a message's record without its payload."""
    # Not by `record`, which is slower, because each message needs one.
    return b"".join(
        (
            _BEFORE,
            U32.pack(number),
            _BETWEEN,
            struct.pack("<III", sec, nanosec, length),
        )
    )
