"""Base class of readers of MCAP files and ROS 1 bags, which consist of chunks."""

import itertools
import struct
import zlib
from array import array
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.messages.transform_rows import Bytes
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.container import (
    MOST_STREAMS,
    Extras,
    File,
    MessageHead,
    MessageTable,
    Piece,
)
from tftool.recordings.contract import Indexes, Stamps
from tftool.recordings.decompression import Ahead, Packed, unpack, unpack_beginning

FAULTS: Final = (InputError, struct.error, KeyError)
"""Exceptions that damaged records raise."""

_MOST_NOTED: Final = 20  # sentences about damage: a hostile file may be damaged everywhere


def reason_of(error: Exception) -> str:
    """Describe an exception raised while reading a record: for example "a record is cut off"."""
    if isinstance(error, KeyError):
        return f"a record lacks its field {error.args[0].decode('ascii', 'replace')!r}"
    return "a record is cut off" if isinstance(error, struct.error) else str(error)


class WalkedMessages:
    """Columns of messages that were found by reading records one by one, without an index."""

    __slots__ = ("channels", "lengths", "log_times", "starts")

    def __init__(self) -> None:
        self.channels = array("I")
        self.log_times = array("q")
        self.starts = array("q")
        self.lengths = array("q")

    def __len__(self) -> int:
        return len(self.starts)

    def append(self, channel: int, log_time: int, start: int, length: int) -> None:
        """Append a message: channel, log time, and offset and length of the payload."""
        self.channels.append(channel)
        # MCAP's times are unsigned, and may be larger than any stamp.
        self.log_times.append(min(log_time, LAST_STAMP))
        self.starts.append(start)
        self.lengths.append(length)

    def extend(self, others: "WalkedMessages") -> None:
        """Append the messages of another object of this class."""
        for name in self.__slots__:
            getattr(self, name).extend(getattr(others, name))

    @property
    def span(self) -> tuple[Stamp, Stamp]:
        """Return the first and the last log time; (0, 0) without messages."""
        return min(self.log_times, default=0), max(self.log_times, default=0)


@dataclass(slots=True, eq=False)
class Chunk:
    """One chunk of a file, described by the file's index or the chunk's header; see `Block`.

    Attributes:
        reader: Reader of the file.
        position: Offset of the chunk's record.
        place: Offset of the compressed data; 0 before the header of the chunk was read.
        packed: Size of the compressed data, bytes.
        size: Size of the uncompressed data, bytes.
        method: Name of the compression; "" or "none" for uncompressed data.
        start: Log time of the first message.
        end: Log time of the last message.
        crc: CRC of the uncompressed data; 0 if the file has no CRC for the chunk.
        cut: Whether the file ends within the chunk.
        length: Size of the chunk's record, bytes.
        behind: Offset of the first record after the chunk and its message indexes.
        indexes: Offset of each channel's message index, in MCAP.
        counts: Number of messages of each channel, from the indexes; None if there are no indexes.
        whole: Whether the chunk can be copied unchanged.
        walked: Messages found by reading all records of the chunk; None if there is an index.
    """

    reader: "ChunkedReader"
    position: int
    place: int = 0
    packed: int = 0
    size: int = 0
    method: str = ""
    start: Stamp = 0
    end: Stamp = 0
    crc: int = 0
    cut: bool = False
    length: int = 0
    behind: int = 0
    indexes: dict[int, int] = field(default_factory=dict)
    counts: Mapping[int, int] | None = None
    whole: bool = False
    walked: WalkedMessages | None = None
    _is_examined: bool = False

    @property
    def is_packed(self) -> bool:
        """Whether the chunk is compressed."""
        return self.method not in ("", "none")

    @property
    def owners(self) -> Collection[int]:
        """Return the numbers of the channels that have messages in the chunk's indexes."""
        return self.indexes.keys() or (self.counts or {}).keys()

    def raw(self) -> Piece:
        """Return the byte range of the chunk's record and its message indexes."""
        return Piece(self.reader.fileno(), self.position, self.behind - self.position)

    def table(self) -> MessageTable:
        """Return the chunk's messages; in a damaged chunk, only the messages before the damage."""
        # The index of a damaged chunk may point into the damage, so its records are read in order.
        by_index = self.whole and self.counts and self.sound()
        found = self.reader.indexed_table(self) if by_index else None
        return self.reader.walked_table(self) if found is None else found

    def sound(self) -> bool:
        """Whether the chunk's content is undamaged, as far as a checksum can show.

        The first thread that reads this property computes the checksum; other threads wait
        meanwhile.
        """
        if not self._is_examined:
            if self.is_packed:
                self.reader.examined(self)
            elif self.crc and not self.cut:
                self.reader.check_crc(
                    self, Piece(self.reader.fileno(), self.place, self.packed).crc()
                )
        self._is_examined = True
        return self.whole


class ChunkedReader(File):
    """Base class of readers of files with chunks; see `ContainerReader`.

    Attributes:
        damage: Sentences about damage of the file, without repetition, at most `_MOST_NOTED`.
        is_indexed: Whether the file has an index.
        schemas: Name, encoding and definition of each message type, by its number in an MCAP file.
    """

    kind = ""
    container = ""
    magic = b""

    def __init__(self, path: Path, style: dict[str, Any]) -> None:
        """Open the file, and check its first bytes.

        Raises:
            InputError: If the file does not begin with the magic bytes of this format.
            OSError: If the file cannot be opened.
        """
        super().__init__(path)
        self.damage: list[str] = []
        self.start = self.end = 0
        self.streams: list[Channel] = []
        self.counts: list[int] = []
        self.channels: dict[int, Channel] = {}
        self.extras = Extras()
        self.style = style
        self.is_indexed = True
        self.schemas: dict[int, tuple[str, str, bytes]] = {}
        self._numbers: dict[int, int] = {}  # index in `streams`, by the channel's number
        self._chunks: list[Chunk] = []
        self._damaged: set[Chunk] = set()
        try:
            if self.up_to(0, len(self.magic)) != self.magic:
                raise InputError(f"'{path}' is not a {self.kind}{' file' * (self.kind == 'MCAP')}.")
        except BaseException:
            self.close()
            raise

    # Damage

    def note(self, damage: str) -> None:
        """Append a sentence about damage of the file to `self.damage`; ignore a repetition."""
        if damage not in self.damage and len(self.damage) < _MOST_NOTED:
            self.damage.append(damage)

    def note_chunk(self, chunk: Chunk, reason: str) -> None:
        """Report damage of a chunk, unless damage of the same chunk was reported before."""
        chunk.whole = False
        if chunk not in self._damaged:
            self._damaged.add(chunk)
            self.note(f"A chunk at byte {chunk.position} is damaged ({reason}).")

    # Channels

    def _learn(self, number: int, channel: Channel) -> None:
        """Register a channel; only messages of the first `MOST_STREAMS` channels are read."""
        self.channels[number] = channel
        if len(self.streams) < MOST_STREAMS:
            self._numbers[number] = len(self.streams)
            self.streams.append(channel.readable())
            self.counts.append(0)

    def _forget(self) -> None:
        """Drop all channels and chunks found so far."""
        for one in (self.channels, self.streams, self.counts, self._numbers, self._chunks):
            one.clear()

    def _count(self, counts: Mapping[int, int]) -> None:
        for channel, count in counts.items():
            if channel in self._numbers:
                self.counts[self._numbers[channel]] += count

    def _scan(self, chunks: Iterator[Chunk]) -> None:
        """Collect channels and chunks of a file without an index, up to the end or first damage.

        The records of a chunk are read only if the chunk has no message indexes, or if these
        indexes contain an unregistered channel.

        Raises:
            InputError: If nothing of the file can be read.
        """
        for chunk in chunks:
            self._chunks.append(chunk)
            # Records inside a chunk may be the only description of its channels.
            if chunk.counts is None or not chunk.counts.keys() <= self.channels.keys():
                self._walk(chunk, learns=True)
            else:
                self._count(chunk.counts)

    def _note_end(self, position: int) -> None:
        """Report the offset at which the file is cut off or damaged.

        Raises:
            InputError: If there is no message and no channel before this offset.
        """
        found = sum(self.counts)
        self.damage.append(
            f"The recording breaks off at byte {position} of {self.size}: "
            f"{found} messages were read before this byte."
        )
        if not found and not self.streams:
            raise InputError(
                f"'{self.path}' is damaged: no message could be read ({self.damage[-1]})"
            )

    def origin(self, number: int) -> Any:
        """Return a channel's description, to pass to the method `adopt` of a writer."""
        raise NotImplementedError

    # A chunk's messages

    def _heads(self, data: bytes, *, learns: bool) -> Iterator[MessageHead]:
        """Yield the headers of the messages among the records of a chunk.

        Args:
            data: Bytes of the records.
            learns: Whether to register channels that records of the chunk describe.

        Raises:
            InputError: If a record is damaged. All exceptions in `FAULTS` are possible.
        """
        raise NotImplementedError

    def unpacked(self, chunk: Chunk, ahead: Ahead | None = None) -> "bytes | memoryview":
        """Decompress a chunk; if the chunk is cut off or damaged, return as many bytes as possible.

        Args:
            chunk: The chunk.
            ahead: Pool of threads that may have decompressed the chunk already.

        Raises:
            InputError: If not even the compressed bytes can be read.
            UsageError: If the package for decompression is not installed.
        """
        coming = None if ahead is None else ahead.take(chunk)
        try:
            if coming is not None:
                return coming.result()
            data = self.at(chunk.place, chunk.packed)
            if chunk.cut:
                return unpack_beginning(chunk.method, data, chunk.size)
            return unpack(chunk.method, data, chunk.size)
        except InputError as error:
            # Read the bytes again, because a thread may have read them before: decompress what
            # precedes the damage.
            data = self.at(chunk.place, chunk.packed)
            self.note_chunk(chunk, str(error))
            return unpack_beginning(chunk.method, data, chunk.size)

    def examined(self, chunk: Chunk) -> bytes | None:
        """Decompress a chunk and check its CRC; return None if the chunk is cut off or damaged."""
        if chunk.cut or chunk in self._damaged:
            return None
        try:
            data = unpack(chunk.method, self.at(chunk.place, chunk.packed), chunk.size)
        except InputError as error:
            self.note_chunk(chunk, str(error))
            return None
        if chunk.crc:
            self.check_crc(chunk, zlib.crc32(data))
        return data

    def check_crc(self, chunk: Chunk, crc: int) -> None:
        """Compare a chunk's computed CRC with the recorded CRC; report a difference as damage."""
        if crc != chunk.crc:
            self.note(
                f"The CRC of the chunk at byte {chunk.position} is wrong: its messages are "
                "copied unchanged, and may be damaged."
            )
            chunk.whole = False

    def walked_table(self, chunk: Chunk) -> MessageTable:
        """Return the messages in a chunk's records, and register channels in these records."""
        heads: list[MessageHead] = []
        data = self.examined(chunk)
        if data is None:
            packed = self.at(chunk.place, chunk.packed)
            data = unpack_beginning(chunk.method, packed, chunk.size)
        try:
            heads.extend(self._heads(data, learns=True))
        except FAULTS as error:
            if not chunk.cut:
                self.note_chunk(chunk, reason_of(error))
            chunk.whole = False
        found = self.known(MessageTable.of(data, heads))
        counts = Counter(found.channels.tolist())
        if counts != chunk.counts:
            chunk.whole = False
        chunk.counts = counts
        return found

    def indexed_table(self, chunk: Chunk) -> MessageTable | None:
        """Return the messages that a chunk's indexes list; None if an index is incomplete."""
        data = np.frombuffer(self.unpacked(chunk), dtype=np.uint8)
        try:
            parts = list(self._parts(chunk, data))
            owners = [np.full(len(begins), channel) for channel, begins, _, _ in parts]
            columns = zip(*(part[1:] for part in parts), strict=True)
            channels, begins, starts, lengths = map(np.concatenate, (owners, *columns))
            # Each channel has its own index: merge the channels in the order of the file.
            order = np.argsort(starts, kind="stable")
            starts, lengths, begins = starts[order], lengths[order], begins[order]
            ends = np.concatenate([[0], starts + lengths])
            begins = np.append(begins, len(data))
            # Records that overlap: an index is wrong.
            if (begins < ends).any():
                return None
            for gap in np.flatnonzero(begins > ends).tolist():
                # Other records between messages are known; a message means an incomplete index.
                between = data[ends[gap] : begins[gap]].tobytes()
                if any(True for _ in self._heads(between, learns=False)):
                    return None
            return MessageTable(
                data, channels[order], *self._moments(data, starts), starts, lengths
            )
        except (*FAULTS, ValueError):
            return None

    def _parts(self, chunk: Chunk, data: Bytes) -> Iterator[tuple[int, Stamps, Stamps, Stamps]]:
        """Yield the offsets of the messages in a chunk, from the chunk's indexes.

        Yields:
            The number of a channel, and three arrays with one item per message, shape (n,): the
            offset of the record, the offset of the payload, and the length of the payload.

        Raises:
            InputError: If an index does not point to messages; other `FAULTS` are possible.
        """
        raise NotImplementedError

    def _moments(self, data: Bytes, starts: Stamps) -> tuple[Stamps, Stamps, Stamps]:
        """Return log times, publish times and sequence numbers of the payloads at `starts`."""
        raise NotImplementedError

    def known(self, messages: MessageTable) -> MessageTable:
        """Return the messages whose channel the file describes; report other messages as damage."""
        is_known = np.isin(messages.channels, list(self.channels))
        if is_known.all():
            return messages
        self.note("Messages are left out: their topic is unknown.")
        return messages.chosen(np.flatnonzero(is_known))

    def _walk(self, chunk: Chunk, *, learns: bool) -> None:
        """Read a chunk's records one by one; store the messages' offsets in `chunk.walked`.

        Args:
            chunk: The chunk.
            learns: Whether to count the messages, and to register channels that are new.
        """
        found = chunk.walked = WalkedMessages()
        try:
            data = bytes(self.unpacked(chunk))
            for channel, log_time, first, last, _, _ in self._heads(data, learns=learns):
                found.append(channel, log_time, first, last - first)
        except FAULTS as error:
            if not chunk.cut:
                self.note_chunk(chunk, reason_of(error))
        # When the index is wrong, the messages were counted before.
        if learns:
            self._count(Counter(found.channels))
        if chunk.cut or len(found):
            # The chunk may end before the end stated in its record.
            chunk.start, chunk.end = found.span

    # Batches

    def expected(self, wanted: Collection[int]) -> int:
        """Return the number of messages in the streams `wanted`, without reading messages."""
        return sum(self.counts[number] for number in wanted)

    def _chosen(self, wanted: Collection[int]) -> dict[int, int]:
        """Return a map from the numbers of wanted channels to their indices in `streams`."""
        return {channel: number for channel, number in self._numbers.items() if number in wanted}

    def _chunk_batches(
        self, chosen: dict[int, int], batch_of: "Callable[[Chunk, Ahead], Batch | None]"
    ) -> Iterator[tuple[Chunk, Batch | None]]:
        """Yield every chunk, with a batch of the chunk's messages on chosen channels.

        The batch is None if the chunk has no message on a chosen channel.
        """
        # Chunks without a chosen channel are skipped: their bytes are not even read.
        read = [
            chunk.walked is not None or any(owner in chosen for owner in chunk.owners)
            for chunk in self._chunks
        ]
        with Ahead(itertools.compress(self._chunks, read), self._ahead) as ahead:
            for chunk, is_read in zip(self._chunks, read, strict=True):
                batch = None
                if is_read:
                    try:
                        if chunk.walked is not None:
                            batch = self._rest_of(chunk, chosen, ahead)
                        else:
                            batch = batch_of(chunk, ahead)
                    except FAULTS as error:
                        # The index of the chunk is wrong, but its records may be intact.
                        self.note_chunk(chunk, reason_of(error))
                        try:
                            batch = self._rest_of(chunk, chosen)
                        except FAULTS as worse:
                            reason = reason_of(worse)
                            self.note(f"A chunk at byte {chunk.position} is unreadable ({reason}).")
                yield chunk, batch if batch is not None and len(batch) else None

    def _ahead(self, chunk: Chunk) -> Packed | None:
        """Return a chunk's compression, compressed bytes and size, for decompression in a thread.

        Return None if the chunk is cut off or not compressed.
        """
        if chunk.cut or not chunk.is_packed:
            return None
        return chunk.method, partial(self.at, chunk.place, chunk.packed), chunk.size

    def _rest_of(
        self, chunk: Chunk, chosen: dict[int, int], ahead: Ahead | None = None
    ) -> Batch | None:
        """Return the messages of chosen channels in a chunk, found by reading every record.

        Return None if the chunk has no message of these channels, or cannot be read.
        """
        if chunk.walked is None:
            # The header of the chunk cannot be read, so the offset of its data is unknown.
            if not chunk.place:
                return None
            self._walk(chunk, learns=False)
        walked = chunk.walked
        assert walked is not None
        numbers = numbers_of(walked.channels, chosen)
        which = np.flatnonzero(numbers >= 0)
        if not len(which):
            return None
        data = np.frombuffer(self.unpacked(chunk, ahead), dtype=np.uint8)
        starts, lengths, log_times = (
            np.frombuffer(one, dtype=np.int64)[which]
            for one in (walked.starts, walked.lengths, walked.log_times)
        )
        return Batch(data, starts, lengths, log_times, numbers[which])


def numbers_of(channels: "array[int]", chosen: Mapping[int, int]) -> Indexes:
    """Return the stream number of each channel number; -1 for a channel that is not in `chosen`."""
    owners = np.frombuffer(channels, dtype=np.uint32)
    if not chosen:
        return np.full(len(owners), -1, dtype=np.int32)
    # One binary search for all messages, in place of a dictionary lookup for each.
    keys = np.array(sorted(chosen), dtype=np.uint32)
    numbers = np.array([chosen[key] for key in keys.tolist()], dtype=np.int32)
    places: Stamps = np.minimum(np.searchsorted(keys, owners), len(keys) - 1)
    return np.where(keys[places] == owners, numbers[places], np.int32(-1))
