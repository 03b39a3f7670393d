"""Parsing of the records of a ROS 1 bag, and of the index of a chunk.

Source: wiki.ros.org/Bags/Format/2.0.
"""

import struct
from collections.abc import Iterator
from typing import Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.messages.transform_rows import SCAN, Bytes
from tftool.recordings.columns import words_at
from tftool.recordings.container import File
from tftool.recordings.containers import ROS1_MAGIC
from tftool.recordings.contract import Stamps

Entries: TypeAlias = npt.NDArray[np.uint32]
"""Index entries: seconds, nanoseconds and offset of each message's record, shape (n, 3)."""

MESSAGE: Final = b"\x02"
BAG: Final = b"\x03"
INDEX: Final = b"\x04"
CHUNK: Final = b"\x05"
CHUNK_INFO: Final = b"\x06"
CONNECTION: Final = b"\x07"

U32: Final = struct.Struct("<I")
U64: Final = struct.Struct("<Q")

_TIME = struct.Struct("<II")
_LARGEST_HEADER = 1 << 20  # bytes; a longer header means damage
_HEAD = 4096  # bytes that contain nearly every header, so that one read is enough


def record_head(file: File, position: int) -> tuple[dict[bytes, bytes], int, int]:
    """Return the header of a record, and the offset and length of the record's data.

    Raises:
        InputError: If the record is too long, or longer than the file.
        struct.error: If the header is cut off.
    """
    block = file.up_to(position, _HEAD)
    (length,) = U32.unpack_from(block)
    if length > _LARGEST_HEADER:
        raise InputError(
            f"the record at byte {position} is damaged: its header would have {length} bytes"
        )
    if length + 8 > len(block):
        block = file.at(position, length + 8)
    (size,) = U32.unpack_from(block, 4 + length)
    return fields_of(block[4 : 4 + length]), position + 8 + length, size


class ChunkInfo(NamedTuple):
    """Chunk info record of a bag's index: offset, times, and messages per connection."""

    position: int
    start: Stamp
    end: Stamp
    counts: dict[int, int]


def index_of(file: File) -> tuple[dict[bytes, bytes], int, bytes]:
    """Return a bag's header, and the offset (0 if none) and bytes of its index.

    Raises:
        InputError: If the header is missing, or the index would begin after the file's end.
        KeyError: If the header lacks a field.
        struct.error: If a field is cut.
    """
    header, _, _ = record_head(file, len(ROS1_MAGIC))
    if header.get(b"op") != BAG:
        raise InputError("the bag's header is missing")
    (place,) = U64.unpack(header[b"index_pos"])
    if place == 0:
        return header, 0, b""
    if place > file.size:
        raise InputError(f"no index can begin at byte {place} of {file.size}")
    return header, place, file.at(place, file.size - place)


def chunk_info(header: dict[bytes, bytes], data: bytes) -> ChunkInfo:
    """Parse a chunk info record.

    Raises:
        KeyError: If the header lacks a field.
        struct.error: If a field is cut.
    """
    (position,) = U64.unpack(header[b"chunk_pos"])
    start, end = time_of(header[b"start_time"]), time_of(header[b"end_time"])
    pairs = struct.iter_unpack("<II", data[: len(data) // 8 * 8])
    return ChunkInfo(position, start, end, dict(pairs))


def indexed(data: Bytes, entries: Entries, connection: int) -> tuple[Stamps, Stamps, Stamps]:
    """Return offsets and lengths of the payloads of a connection's messages, and their log times.

    Args:
        data: Bytes of a chunk's records.
        entries: Index entries of the messages.
        connection: Number of the connection.

    Raises:
        InputError: If the index points to something other than these messages.
    """
    # All messages of a connection have headers with the same layout: find the fields in the first
    # header, and compare the bytes of all others at the same offsets.
    first = int(entries[0, 2])
    if first > len(data) - 4:
        raise InputError("the index points outside of the chunk")
    (head,) = U32.unpack_from(data.data, first)
    header = data[first + 4 : first + 4 + min(head, _LARGEST_HEADER)].tobytes()
    code, owner = header.find(b"op=") + 3, header.find(b"conn=") + 5
    if code < 3 or owner < 5 or not code < len(header) >= owner + 4 or len(header) != head:
        raise InputError("the index points at something other than its messages")
    # The C code checks the same; at the first difference the code below raises the error.
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
        raise InputError("the index points outside of the chunk")
    if (
        (heads != head).any()
        or (data[places + 4 + code] != MESSAGE[0]).any()
        or (words_at(data, places + 4 + owner, "<u4") != connection).any()
    ):
        raise InputError("the index points at something other than its messages")
    return starts, lengths, entries[:, 0].astype(np.int64) * NANOSECONDS + entries[:, 1]


def _within(places: Stamps, data: Bytes) -> Stamps:
    """Return the four-byte numbers at some offsets in a chunk's data.

    Raises:
        InputError: If an offset is outside the data.
    """
    if len(data) < 4 or int(places.max()) > len(data) - 4:
        raise InputError("the index points outside of the chunk")
    return words_at(data, places, "<u4").astype(np.int64)


def records_in(data: bytes, partial: bool = False) -> Iterator[tuple[dict[bytes, bytes], int, int]]:
    """Yield the header of every record, and the start and end of the record's data.

    Args:
        data: Bytes of the records.
        partial: Whether to ignore a last record that is cut off.

    Raises:
        InputError: If a record extends beyond the data.
    """
    position, size = 0, len(data)
    while position + 8 <= size:
        (length,) = U32.unpack_from(data, position)
        # Every length is checked before it is used: the bytes are untrusted.
        first = position + 8 + length
        if not 0 < length <= _LARGEST_HEADER or first > size:
            if partial:
                return
            raise InputError(f"a record is damaged: its header would have {length} bytes")
        (count,) = U32.unpack_from(data, first - 4)
        last = first + count
        if last > size:
            if partial:
                return
            raise InputError(f"a record announces {count} bytes, but only {size - first} follow")
        yield fields_of(data[position + 4 : first - 4]), first, last
        position = last


def fields_of(header: bytes) -> dict[bytes, bytes]:
    """Return the fields of a record's header, by name."""
    found = {}
    position, size = 0, len(header)
    while position + 4 <= size:
        (length,) = U32.unpack_from(header, position)
        position += 4
        if position + length > size:
            raise InputError(f"a field announces {length} bytes, more than the header has")
        name, _, value = header[position : position + length].partition(b"=")
        found[name] = value
        position += length
    return found


def time_of(raw: bytes) -> Stamp:
    """Decode the eight bytes of a time in a header; return nanoseconds."""
    sec, nanosec = _TIME.unpack(raw)
    return int(sec) * NANOSECONDS + int(nanosec)
