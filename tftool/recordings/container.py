"""Interface of recording files (containers): their streams, and messages in batches."""

import os
import zlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.messages.transform_rows import Bytes
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.contract import Progress, Stamps
from tftool.recordings.decompression import LARGEST

MOST_STREAMS: Final = 65_536
"""Maximum number of streams read from one recording; further streams are left out."""

LARGEST_DESCRIPTION: Final = 1 << 26
"""Maximum size of a record that describes a stream, bytes, because the record is copied."""


def check_description_size(count: int) -> None:
    """Check the size of a record that describes a channel or a message type.

    Args:
        count: Size of the record, bytes.

    Raises:
        InputError: If the size is above `LARGEST_DESCRIPTION`.
    """
    if count > LARGEST_DESCRIPTION:
        raise InputError(
            f"a record about a topic has {count} bytes, but the limit is {LARGEST_DESCRIPTION}"
        )


class Taken(NamedTuple):
    """One message with all fields that the recording stores.

    Attributes:
        channel: Number of the channel in its file.
        log_time: Time of reception, nanoseconds.
        payload: Bytes of the message.
        publish_time: Time of publication, nanoseconds; `log_time` if not recorded.
        sequence: Publisher's sequence number; 0 if not recorded.
    """

    channel: int
    log_time: Stamp
    payload: bytes
    publish_time: Stamp
    sequence: int


class MessageHead(NamedTuple):
    """Header of a message's record, with the offsets of its payload.

    Attributes:
        channel: Number of the channel.
        log_time: Time of reception, nanoseconds.
        first: Offset of the payload.
        last: Offset of the payload's end.
        publish_time: Time of publication, nanoseconds.
        sequence: Publisher's sequence number.
    """

    channel: int
    log_time: int
    first: int
    last: int
    publish_time: int
    sequence: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class MessageTable:
    """Messages as columns with one row per message, usually the messages of one chunk.

    Attributes:
        data: Bytes that contain the payloads.
        channels: Number of each message's channel, shape (n,).
        log_times: Times of reception, nanoseconds, shape (n,).
        publish_times: Times of publication, nanoseconds, shape (n,).
        sequences: Publishers' sequence numbers, shape (n,).
        starts: Offset of each payload in `data`, shape (n,).
        lengths: Length of each payload, bytes, shape (n,).
    """

    data: Bytes
    channels: Stamps
    log_times: Stamps
    publish_times: Stamps
    sequences: Stamps
    starts: Stamps
    lengths: Stamps

    def __len__(self) -> int:
        return len(self.starts)

    @property
    def owners(self) -> list[int]:
        """Numbers of the channels with messages in the table, in order of first appearance."""
        channels, firsts = np.unique(self.channels, return_index=True)
        found: list[int] = channels[np.argsort(firsts)].tolist()
        return found

    def payload(self, number: int) -> bytes:
        """Return the bytes of one message, by its index."""
        start = int(self.starts[number])
        return self.data[start : start + int(self.lengths[number])].tobytes()

    def message(self, number: int) -> Taken:
        """Return the message at an index, with all fields that the file stores."""
        return Taken(
            int(self.channels[number]),
            int(self.log_times[number]),
            self.payload(number),
            int(self.publish_times[number]),
            int(self.sequences[number]),
        )

    @classmethod
    def of(cls, data: bytes, heads: Sequence[MessageHead]) -> "MessageTable":
        """Build a table from message headers, whose offsets refer to the bytes `data`."""
        rows = zip(*heads, strict=True) if heads else [()] * 6
        channels, log_times, firsts, lasts, publish_times, sequences = rows
        starts = np.array(firsts, dtype=np.int64)
        return cls(
            np.frombuffer(data, dtype=np.uint8),
            np.array(channels, dtype=np.int64),
            np.array([min(one, LAST_STAMP) for one in log_times], dtype=np.int64),
            np.array(publish_times, dtype=np.uint64),
            np.array(sequences, dtype=np.int64),
            starts,
            np.array(lasts, dtype=np.int64) - starts,
        )

    def chosen(self, indices: Stamps) -> "MessageTable":
        """Return a table of the messages at some indices."""
        columns = (self.channels, self.log_times, self.publish_times, self.sequences)
        rest = (self.starts, self.lengths)
        return MessageTable(self.data, *(one[indices] for one in (*columns, *rest)))

    def with_headers(self, heads: npt.NDArray[Any]) -> tuple[Bytes, Stamps]:
        """Return records that each consist of a new header and the payload of one message.

        Args:
            heads: The new headers, as items of one size, shape (n,).

        Returns:
            The bytes of all records, and the offset of each record, shape (n,).
        """
        size = heads.dtype.itemsize
        ends = np.cumsum(self.lengths + size)
        places: Stamps = ends - self.lengths - size
        found = np.empty(int(ends[-1]), dtype=np.uint8)
        _items(found, size)[places] = heads.view(f"V{size}")
        order = np.argsort(self.lengths, kind="stable")
        cuts = np.flatnonzero(np.diff(self.lengths[order])) + 1
        for which in np.split(order, cuts):
            length = int(self.lengths[which[0]])
            if length:
                # Treat each payload as one large item, which numpy copies in one step.
                rows = _items(self.data, length)[self.starts[which]]
                _items(found, length)[places[which] + size] = rows
        return found, places


def _items(data: Bytes, size: int) -> npt.NDArray[np.void]:
    """Return an overlapping view of the data: item i has the `size` bytes from offset i on."""
    return np.ndarray((len(data) - size + 1,), f"V{size}", buffer=data.data, strides=(1,))


class Block(Protocol):
    """Consecutive messages: a chunk, database rows, or MCAP messages outside chunks."""

    @property
    def start(self) -> Stamp:
        """Log time of the block's first message, nanoseconds."""

    @property
    def end(self) -> Stamp:
        """Log time of the block's last message, nanoseconds."""

    @property
    def counts(self) -> Mapping[int, int] | None:
        """Return the number of messages of each channel; None if counting requires parsing."""

    @property
    def whole(self) -> bool:
        """Whether the block can be copied unchanged."""

    def sound(self) -> bool:
        """Whether the block's content is undamaged, as far as a checksum can show."""

    def table(self) -> MessageTable:
        """Return the block's messages; in a damaged block, only the messages before the damage."""


_STEP: Final = 1 << 19
"""Bytes copied in one step: few enough to stay in the processor's cache until read again."""

_one, _other = bytearray(_STEP), bytearray(_STEP)


@dataclass(frozen=True, slots=True)
class Piece:
    """Byte range of an open file that will be copied.

    Attributes:
        file: Descriptor of the file.
        place: Offset of the first byte.
        length: Number of bytes.
    """

    file: int
    place: int
    length: int

    def copy_to(self, file: int, place: int, crc: int | None = None) -> int:
        """Copy the bytes to another file, and read the copy back to verify the bytes.

        For 2 GB, this took 1.1 times as long as `copy_file_range`. That function is not used
        because it is slow if source and destination begin at different offsets within a memory
        page.

        Args:
            file: Descriptor of the other file, open for writing and reading.
            place: Offset in the other file at which to write.
            crc: CRC of the preceding bytes; None if no CRC is needed.

        Returns:
            CRC of the preceding and the copied bytes; 0 if `crc` is None.

        Raises:
            InputError: If the file has become shorter, or the copy differs from the original.
            OSError: If the bytes cannot be written.
        """
        done = 0
        while done < self.length:
            # End at a multiple of the step in the other file: whole pages are written faster.
            count = min(_STEP - (place + done) % _STEP, self.length - done)
            read = memoryview(_one)[:count]
            count = os.preadv(self.file, [read], self.place + done)
            if not count:
                raise self._shortened(done)
            count = os.pwrite(file, read[:count], place + done)
            again = os.preadv(file, [memoryview(_other)[:count]], place + done)
            if again != count or not _begin_alike(count):
                raise InputError(
                    f"the copy on the disk differs from the original from byte {place + done} on"
                )
            if crc is not None:
                crc = zlib.crc32(read[:count], crc)
            done += count
        return crc or 0

    def crc(self) -> int:
        """Return the CRC of the bytes, computed in steps.

        Raises:
            InputError: If the file has become shorter.
        """
        found, done, room = 0, 0, memoryview(bytearray(min(_STEP, self.length)))
        while done < self.length:
            count = os.preadv(self.file, [room[: self.length - done]], self.place + done)
            if not count:
                raise self._shortened(done)
            found = zlib.crc32(room[:count], found)
            done += count
        return found

    def _shortened(self, done: int) -> InputError:
        return InputError(
            f"a recording was shortened to {self.place + done} bytes while it was read: "
            "try again when no other program writes to this recording"
        )


def _begin_alike(count: int) -> bool:
    """Whether the first `count` bytes of `_one` (written) and `_other` (read back) are equal."""
    # Compare whole buffers if possible, which makes no copy.
    return _one == _other if count == _STEP else _one[:count] == _other[:count]


class CopiedAttachment(NamedTuple):
    """An attachment of an MCAP file, to be copied to another file.

    Attributes:
        piece: Byte range of the record.
        times: Log time and creation time, as bytes of the record.
        names: Name and media type, as bytes of the record.
        size: Size of the attachment, bytes.
    """

    piece: Piece
    times: bytes
    names: bytes
    size: int


@dataclass(slots=True)
class Extras:
    """Contents of an MCAP file other than messages.

    Attributes:
        attachments: Attachments, as byte ranges of the file.
        metadata: Bodies of the metadata records.
    """

    attachments: list[CopiedAttachment] = field(default_factory=list)
    metadata: list[bytes] = field(default_factory=list)


class Container(Protocol):
    """One recording file, or several recording files that are read as one.

    Attributes:
        kind: Name of the file format in messages to the user.
        size: Size of the files, bytes.
        start: Log time of the first message; 0 without messages.
        end: Log time of the last message.
        streams: All streams; a batch refers to a stream by its index in this list.
    """

    kind: str
    size: int
    start: Stamp
    end: Stamp
    streams: list[Channel]

    @property
    def counts(self) -> list[int]:
        """Return the number of messages of each stream."""

    def expected(self, wanted: Collection[int]) -> int:
        """Return the approximate number of messages in some streams; 0 if unknown."""

    @property
    def damage(self) -> list[str]:
        """Return sentences about the damage found so far; further reading may find more."""

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams in batches, in the order of the recording.

        A batch's buffer is valid until the next batch, which reuses its memory.

        Args:
            wanted: Indices in `streams` of the streams to read.
            progress: Function called with the number of bytes read.
            head: Number of bytes that the caller needs from each message; None for all bytes. A
                batch may contain more bytes.
        """

    def close(self) -> None:
        """Close the files of the recording."""


class ContainerReader(Container, Protocol):
    """Recording file that can also be read from beginning to end, for editing.

    Attributes:
        container: Name of the format: "mcap", "db3" or "bag".
        channels: Streams exactly as recorded, by number; further reading may find more.
        extras: Contents other than messages; complete once the whole file was read.
        style: Options, such as the compression, for a writer of a similar file.
    """

    container: str
    channels: dict[int, Channel]
    extras: Extras
    style: dict[str, Any]

    def blocks(self) -> Iterator[Block]:
        """Yield all messages in blocks, in the order of the file."""


class File:
    """File that is read at given offsets, up to the size that the file had when opened.

    Attributes:
        path: Path of the file.
        size: Size of the file when it was opened, bytes; a recorder may still append to it.
        read: Number of bytes read so far.
    """

    def __init__(self, path: Path) -> None:
        """Open the file.

        Raises:
            OSError: If the file cannot be opened.
        """
        self.path = path
        self._file = path.open("rb", buffering=0)
        self.size = os.fstat(self._file.fileno()).st_size
        self.read = 0

    def at(self, place: int, count: int) -> bytes:
        """Read `count` bytes from an offset.

        Raises:
            InputError: If the file ends before `place + count`, or `count` is above `LARGEST`.
        """
        if count < 0 or place < 0 or place + count > self.size:
            raise InputError(
                f"{count} bytes at byte {place} are beyond the file's end ({self.size})"
            )
        if count > LARGEST:
            raise InputError(
                f"{count} bytes at byte {place} exceed the limit of one read ({LARGEST})"
            )
        found = os.pread(self._file.fileno(), count, place)
        while len(found) < count:
            more = os.pread(self._file.fileno(), count - len(found), place + len(found))
            if not more:
                raise InputError(f"the file ends at byte {place + len(found)}: it was truncated")
            found += more
        self.read += count
        return found

    def into(self, place: int, room: memoryview) -> None:
        """Fill a buffer with the bytes from an offset.

        Raises:
            InputError: If the file ends before the buffer is full.
        """
        if hasattr(os, "preadv") and 0 <= place <= self.size - len(room):
            self.read += len(room)
            while room:
                found = os.preadv(self._file.fileno(), [room], place)
                if not found:
                    raise InputError(f"the file ends at byte {place}: it was truncated")
                room, place = room[found:], place + found
        else:
            room[:] = self.at(place, len(room))

    def fileno(self) -> int:
        """Return the file descriptor."""
        return self._file.fileno()

    def up_to(self, place: int, count: int) -> bytes:
        """Read at most `count` bytes from an offset; fewer at the end of the file."""
        return self.at(place, max(0, min(count, self.size - place, LARGEST)))

    def close(self) -> None:
        """Close the file."""
        self._file.close()
