"""Output files of `tftool edit`."""

import zlib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError, MalformedMessage, TftoolError
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.messages.schema import full_name
from tftool.messages.transform_rows import walk
from tftool.recordings.channel import TRANSIENT_LOCAL, Channel, offers_of, offers_text
from tftool.recordings.chunked import Chunk, ChunkedReader
from tftool.recordings.container import Block, ContainerReader, MessageTable
from tftool.recordings.container_reader import LAYOUTS
from tftool.recordings.containers import container_named
from tftool.recordings.contract import Stamps
from tftool.recordings.decompression import compressor
from tftool.recordings.edit.changes import carries_transforms
from tftool.recordings.edit.tables import Kinds, Result, TableChange
from tftool.recordings.message_conversion import (
    Conversion,
    as_ros1,
    as_ros2,
    known_hash,
    ros2_definition,
)

_HEADS = np.dtype([("log_time", "<i8"), ("publish_time", "<u8"), ("sequence", "<u8")])

_UNREAD: Final = "is left out where a message cannot be read"


class EditedFile:
    """One output file of an edit, with counts and checksums to verify the written file.

    Attributes:
        path: Path of the written file.
        container: "mcap", "db3" or "bag".
        counts: Number of written messages by channel.
        digests: Checksum of the written messages, by topic and type.
        copied: Size of each copied chunk, bytes, by its offset in the file.
        start: Log time of the first message.
        end: Log time of the last message.
        refused: Sentence about each topic that cannot be converted, by topic: "is left out: …".
    """

    def __init__(
        self,
        path: Path,
        container: str,
        reader: ContainerReader,
        *,
        ros2: bool,
        packs: bool = False,
        latched: "frozenset[str]" = frozenset(),
        first_free: int = 1,
    ) -> None:
        """Prepare an output file, which is created at the first message.

        Args:
            path: Path of the written file.
            container: "mcap", "db3" or "bag".
            reader: Reader of the first input file; its `style` is used if both files have the same
                format.
            ros2: Whether ROS 1 messages are converted to ROS 2.
            packs: Whether each message is compressed separately, as in rosbag2's mode "message".
            latched: Topics that must offer their last message to late subscribers.
            first_free: Smallest number above the numbers of all channels and schemas of the inputs.
        """
        self.path = path
        self.container = container
        self._ros2 = ros2
        self._pack = compressor("zstd") if packs else None
        self._latched = latched
        self._conversions: dict[tuple[int, int], Conversion | None] = {}
        self._numbers: dict[tuple[int, int], int] = {}
        self._compatible: dict[int, bool] = {}
        self._extra: dict[Channel, int] = {}
        self.channels: dict[int, Channel] = {}
        self.counts: Counter[int] = Counter()
        self.digests: dict[tuple[str, str], int] = {}
        self.copied: dict[int, int] = {}
        self.start: Stamp = LAST_STAMP
        self.end: Stamp = 0
        self.refused: dict[str, str] = {}
        self._kinds: dict[Channel, Kinds] = {}
        self._format = container_named(container)
        self.writer = self._opened(reader)
        # Only a writer of chunks can copy chunks; a database is written row by row.
        self._chunks = self.writer if hasattr(self.writer, "copy_chunk") else None
        if self._chunks is not None:
            self._chunks.first_free = first_free

    def _opened(self, reader: ContainerReader) -> Any:
        """Create the file, and return its writer; use the style of an input of the same format."""
        is_same = reader.container == self._format.name
        style: dict[str, Any] = dict(reader.style) if is_same else {}
        if not getattr(reader, "is_indexed", True) and not style.get("chunked", True):
            del style["chunked"]
        if self._ros2:
            style.pop("profile", None)
        is_ros1 = container_named(reader.container).encoding == "ros1" and not self._ros2
        return self._format.create_like(self.path, style, profile="ros1" if is_ros1 else "ros2")

    # Channels

    def _conversion(
        self, input_number: int, number: int, channel: Channel, reader: ContainerReader
    ) -> Conversion | None:
        """Return the conversion of an input's channel for this file.

        Return None if the channel's messages cannot be converted, and must be left out.
        """
        key = input_number, number
        if key not in self._conversions:
            try:
                self._conversions[key] = self._converted(channel, reader)
            except TftoolError as error:
                keeps = not self._format.encoding
                self._conversions[key] = Conversion(channel, bytes) if keeps else None
                fate = "keeps its encoding" if keeps else "is left out"
                self._note_refusal(channel.topic, fate, error)
        return self._conversions[key]

    def _note_refusal(self, topic: str, fate: str, error: TftoolError) -> None:
        self.refused.setdefault(topic, f"{fate}: {str(error).rstrip('.')}.")

    def _converted(self, channel: Channel, reader: ContainerReader) -> Conversion:
        if self._format.encoding == "ros1":
            return as_ros1(channel)
        if channel.encoding == "ros1":
            return as_ros2(channel) if self._ros2 else Conversion(channel, bytes)
        if self._format.encoding:
            if channel.encoding != self._format.encoding:
                raise InputError(
                    f"messages have the encoding '{channel.encoding}', which "
                    f"{self._format.words} cannot contain"
                )
            channel = replace(channel, type=full_name(channel.type))
        # An MCAP input without definitions stays unchanged; other containers cannot store them.
        if channel.encoding == "cdr" and not channel.definition and reader.container != "mcap":
            channel = _defined(channel)
        return Conversion(channel, bytes)

    def _register(
        self, input_number: int, number: int, channel: Channel, reader: ContainerReader
    ) -> int | None:
        """Return the number of an input's channel in this file; None for an omitted channel."""
        key = input_number, number
        found = self._numbers.get(key)
        if found is not None:
            return found
        conversion = self._conversion(input_number, number, channel, reader)
        if conversion is None:
            return None
        written = conversion.channel
        if channel.topic in self._latched:
            written = _latching(written)
        same = written == channel
        if same and self._fits(input_number, reader) and number not in self.channels:
            assert self._chunks is not None
            assert isinstance(reader, ChunkedReader)
            self._chunks.adopt(written, number, reader.origin(number))
            self._numbers[key] = number
            self.channels[number] = written
            return number
        found = self.channel(written)
        self._numbers[key] = found
        return found

    def channel(self, channel: Channel) -> int:
        """Register a channel that no input has, and return the channel's number."""
        found = self._extra.get(channel)
        if found is None:
            found = self._extra[channel] = self.writer.channel(channel)
            self.channels[found] = channel
        return found

    def _fits(self, input_number: int, reader: ContainerReader) -> bool:
        """Whether an input's chunks can be copied: its channels have the same numbers here."""
        found = self._compatible.get(input_number)
        if found is None:
            found = reader.container == self.container and (
                not self._compatible or self._agrees(reader)
            )
            self._compatible[input_number] = found
        return found and self._chunks is not None

    def _agrees(self, reader: ContainerReader) -> bool:
        """Whether an input's channel numbers are free in this file, or mean the same channels."""
        if self._chunks is None or self._extra or not isinstance(reader, ChunkedReader):
            return False
        channels = reader.channels.items()
        same = all(self.channels.get(number, channel) == channel for number, channel in channels)
        return same and reader.is_indexed and self._chunks.agrees(reader.schemas)

    # Messages

    def write(self, input_number: int, table: MessageTable, reader: ContainerReader) -> bool:
        """Append messages of an input; return whether at least one message was written."""
        numbers = np.full(len(table), -1, dtype=np.int64)
        change = TableChange(table)
        for own in table.owners:
            number = self._register(input_number, own, reader.channels[own], reader)
            which = np.flatnonzero(table.channels == own)
            if number is None:
                change.keep[which] = False
                continue
            numbers[which] = number
            conversion = self._conversions[input_number, own]
            assert conversion is not None
            if conversion.payload is not bytes:
                self._convert(change, which, reader.channels[own], conversion)
        change.table = replace(change.table, channels=numbers)
        table = change.finished()
        if not len(table):
            return False
        self.append(table)
        return True

    def _convert(
        self, change: TableChange, indices: Stamps, channel: Channel, conversion: Conversion
    ) -> None:
        """Write messages of one channel in the encoding of the output, in bulk if possible."""
        if carries_transforms(channel):
            kinds = self._kinds.get(channel)
            if kinds is None:
                layout = LAYOUTS[conversion.channel.encoding]

                def learned(payload: bytes) -> "tuple[Result, Counter[str]]":
                    count = len(walk(LAYOUTS[channel.encoding], payload).places)
                    return Result(conversion.payload(payload), layout, range(count)), Counter()

                kinds = self._kinds[channel] = Kinds(LAYOUTS[channel.encoding], learned)
            found, indices = kinds.groups(change.table, indices)
            others = [indices]
            for kind, numbers, rows in found:
                # Seconds are signed in ROS 2's layout, and unsigned in ROS 1's.
                fit = np.ones(len(rows), dtype=np.bool_)
                for number in range(len(kind.places)):
                    fit &= kind.stamps(rows, number) >= 0
                others.append(numbers[~fit])
                if fit.any():
                    length = int(change.table.lengths[numbers[0]])
                    change.put(numbers[fit], kind.changed(rows[fit], length))
            indices = np.concatenate(others)
        for row in indices.tolist():
            try:
                change.put_one(row, conversion.payload(change.table.payload(row)))
            except MalformedMessage as error:
                self._note_refusal(channel.topic, _UNREAD, error)
                change.keep[row] = False

    def append(self, table: MessageTable) -> None:
        """Append messages unchanged, and update the checksums."""
        for number, count in Counter(table.channels.tolist()).items():
            self.counts[number] += count
        digest_table(self.digests, table, self.channels, self.container)
        self.start = min(self.start, int(table.log_times.min()))
        self.end = max(self.end, int(table.log_times.max()))
        if self._pack is None and self._chunks is not None and self._chunks.write_table(table):
            return
        for row in range(len(table)):
            number, log_time, payload, publish_time, sequence = table.message(row)
            packed = payload if self._pack is None else self._pack(payload)
            self.writer.write(number, log_time, packed, publish_time, sequence)

    def can_copy(self, input_number: int, block: Block, reader: ContainerReader) -> bool:
        """Whether a block of messages of an input can be copied unchanged."""
        if not (block.whole and isinstance(block, Chunk) and self._fits(input_number, reader)):
            return False
        for number in block.counts or ():
            channel = reader.channels[number]
            if self._register(input_number, number, channel, reader) != number:
                return False
            if self.channels[number] != channel:
                return False
        # A copied chunk may describe its channels: it must not contradict a changed channel.
        return not any(
            channel.topic in self._latched and _latching(channel) != channel
            for channel in reader.channels.values()
        )

    def copy(self, chunk: Chunk) -> None:
        """Append a chunk of an input unchanged."""
        assert self._chunks is not None
        self._chunks.flush()
        self.copied[self._chunks.position] = chunk.raw().length
        self._chunks.copy_chunk(chunk)
        if chunk.counts:
            self.counts.update(chunk.counts)
            self.start = min(self.start, chunk.start)
            self.end = max(self.end, chunk.end)

    def closed_block(self, block: Block) -> None:
        """Write the current chunk with the compression of `block`, which the chunk replaces."""
        if (
            self._chunks is not None
            and isinstance(block, Chunk)
            and block.reader.container == self.container
        ):
            self._chunks.end_block(block)

    def finish(self, readers: Sequence[ContainerReader]) -> None:
        """Write the inputs' attachments and metadata, and close the file."""
        if self._chunks is not None:
            for number, reader in enumerate(readers):
                if isinstance(reader, ChunkedReader) and self._fits(number, reader):
                    self._chunks.copy_extras(reader.extras, reader.schemas)
                else:
                    self._chunks.copy_extras(reader.extras, {})
        self.writer.finish()


def digest_table(
    digests: dict[tuple[str, str], int],
    table: MessageTable,
    channels: Mapping[int, Channel],
    container: str,
) -> None:
    """Update each topic's checksum with messages, and with the times that `container` stores."""
    numbers: dict[tuple[str, str], list[int]] = {}
    for number in table.owners:
        channel = channels[number]
        numbers.setdefault((channel.topic, channel.type), []).append(number)
    for key, own in numbers.items():
        some = table.chosen(np.flatnonzero(np.isin(table.channels, own)))
        heads = np.zeros(len(some), dtype=_HEADS)
        heads["log_time"] = some.log_times
        if container_named(container).keeps_sequences:
            heads["publish_time"], heads["sequence"] = some.publish_times, some.sequences
        digests[key] = zlib.crc32(some.with_headers(heads)[0].data, digests.get(key, 0))


def _defined(channel: Channel) -> Channel:
    """Return a ROS 2 channel with tftool's definition of its type, if tftool has one."""
    try:
        text = ros2_definition(channel.type)
    except TftoolError:
        return channel
    metadata = dict(channel.metadata)
    if not metadata.get("topic_type_hash"):
        metadata["topic_type_hash"] = known_hash(channel.type)
    return replace(
        channel,
        schema_encoding="ros2msg",
        definition=text.encode(),
        metadata=tuple(metadata.items()),
    )


def _latching(channel: Channel) -> Channel:
    """Return a channel with a QoS that lets late subscribers receive the last message."""
    metadata = dict(channel.metadata)
    if channel.encoding == "ros1":
        if metadata.get("latching") == "1":
            return channel
        metadata["latching"] = "1"
    else:
        offers = metadata.get("offered_qos_profiles", "")
        if offers_of(offers).durability == TRANSIENT_LOCAL:
            return channel
        metadata["offered_qos_profiles"] = offers_text(static=True)
    return replace(channel, metadata=tuple(metadata.items()))
