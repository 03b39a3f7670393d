"""What an edited recording is written into: a file of each container, or a folder of files."""

import struct
import zlib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError, TftoolError
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.messages.schema import full_name
from tftool.recordings.channel import Channel
from tftool.recordings.compression import best_compression, compressor
from tftool.recordings.container import TRANSIENT_LOCAL, offers_of
from tftool.recordings.edit.mcap_tape import McapChunk, McapTape
from tftool.recordings.edit.rosbag1_tape import Rosbag1Chunk, Rosbag1Tape
from tftool.recordings.edit.tape import Block, Taken, Tape
from tftool.recordings.mcap.write import CHUNK_SIZE, McapWriter
from tftool.recordings.message_conversion import Conversion, as_ros1, as_ros2
from tftool.recordings.recording_writer import library_name
from tftool.recordings.rosbag1.write import CHUNK_SIZE as BAG_CHUNK_SIZE
from tftool.recordings.rosbag1.write import Rosbag1Writer
from tftool.recordings.rosbag2.offered_qos import offers_text
from tftool.recordings.rosbag2.write import SqliteWriter
from tftool.recordings.schema_text import known_hash, ros2_definition

_LARGEST_CHUNK: Final = 1 << 26
_HEAD = struct.Struct("<qQQ")


@dataclass(slots=True)
class Copied:
    """A chunk that was copied as it lay.

    Attributes:
        chunk: Where it came from.
        place: Where it lies in the output.
    """

    chunk: McapChunk | Rosbag1Chunk
    place: int


class EditedFile:
    """One file that is written, and what is known of it for the comparison in the end.

    Attributes:
        path: Where it is written.
        container: "mcap", "db3" or "bag".
        counts: Messages by channel as written.
        digests: Of each topic a checksum over its messages, in order.
        copied: Chunks that were copied, by their places in the file.
        start: Log time of the first message.
        end: Of the last.
        left_out: Topics that the container cannot hold, and why.
    """

    def __init__(
        self,
        path: Path,
        container: str,
        tape: Tape,
        *,
        ros2: bool,
        packs: bool = False,
        latched: "frozenset[str]" = frozenset(),
        first_free: int = 1,
    ) -> None:
        """Begin it.

        Args:
            path: Where it is written.
            container: "mcap", "db3" or "bag".
            tape: What it is made from first: its style is kept where the container is the same.
            ros2: Whether messages of ROS 1 become those of ROS 2.
            packs: Whether each message is compressed by itself, as rosbag2 does.
            latched: Topics that are made to offer their last message to late subscribers.
            first_free: The first number that no tape uses for a channel or a schema.
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
        self.copied: dict[int, Copied] = {}
        self.start: Stamp = LAST_STAMP
        self.end: Stamp = 0
        self.left_out: dict[str, str] = {}
        self._mcap: McapWriter | None = None
        self._bag: Rosbag1Writer | None = None
        self._open(tape)
        for writer in (self._mcap, self._bag):
            if writer is not None:
                writer.first_free = first_free

    def _open(self, tape: Tape) -> None:
        style: dict[str, Any] = tape.style if tape.container == self.container else {}
        self.writer: McapWriter | Rosbag1Writer | SqliteWriter
        if self.container == "mcap":
            chunked = style.get("chunked", True) or not getattr(tape, "is_indexed", True)
            before = style.get("library", "")
            library = library_name() + (f"; was: {before}" if before else "")
            # Chunks of an MCAP file that are changed become one chunk each: `closed_block`.
            size = _LARGEST_CHUNK if style.get("chunked") else CHUNK_SIZE
            profile = "ros1" if tape.container == "bag" and not self._ros2 else "ros2"
            self.writer = self._mcap = McapWriter(
                self.path,
                profile=style.get("profile", profile),
                library=library,
                compression=style.get("compression") or best_compression(),
                chunk_size=size if chunked else 0,
                with_crc=style.get("with_crc", True),
            )
        elif self.container == "bag":
            size = style.get("chunk_size") or BAG_CHUNK_SIZE
            self.writer = self._bag = Rosbag1Writer(
                self.path,
                compression=style.get("compression", "none"),
                chunk_size=min(max(size, 1 << 12), 1 << 24),
            )
        else:
            self.writer = SqliteWriter(self.path)

    # Channels

    def _conversion(
        self, source: int, number: int, channel: Channel, tape: Tape
    ) -> Conversion | None:
        """Return the channel as it is written here; None where it cannot be."""
        key = source, number
        if key not in self._conversions:
            try:
                self._conversions[key] = self._converted(channel, tape)
            except TftoolError as error:
                self._conversions[key] = None
                self.left_out.setdefault(channel.topic, str(error).rstrip("."))
        return self._conversions[key]

    def _converted(self, channel: Channel, tape: Tape) -> Conversion:
        if self.container == "bag":
            return as_ros1(channel)
        if channel.encoding == "ros1":
            return as_ros2(channel) if self._ros2 else Conversion(channel, bytes)
        if self.container == "db3":
            if channel.encoding != "cdr":
                raise InputError(
                    f"its messages are written as '{channel.encoding}', for which rosbag2's "
                    "sqlite files have no place"
                )
            channel = _with(channel, kind=full_name(channel.type))
        # An MCAP file stays as it is, with what it does not say; others have no place for it.
        if channel.encoding == "cdr" and not channel.definition and tape.container != "mcap":
            channel = _defined(channel)
        return Conversion(channel, bytes)

    def _register(self, source: int, number: int, channel: Channel, tape: Tape) -> int | None:
        """The number of a channel here."""
        key = source, number
        found = self._numbers.get(key)
        if found is not None:
            return found
        conversion = self._conversion(source, number, channel, tape)
        if conversion is None:
            return None
        written = conversion.channel
        if channel.topic in self._latched:
            written = _latching(written)
        same = written == channel
        if same and self._fits(source, tape) and number not in self.channels:
            if isinstance(tape, McapTape) and self._mcap is not None:
                schema = tape.schema_of[number]
                if schema:
                    self._mcap.schema(*tape.schemas[schema], number=schema)
                self._mcap.channel(written, number, schema)
                self._numbers[key] = number
                self.channels[number] = written
                return number
            if isinstance(tape, Rosbag1Tape) and self._bag is not None:
                self._bag.add_connection(number, *tape.headers[number])
                self._numbers[key] = number
                self.channels[number] = written
                return number
        found = self.channel(written)
        self._numbers[key] = found
        return found

    def channel(self, channel: Channel) -> int:
        """Make a channel known that is not one of a tape's."""
        found = self._extra.get(channel)
        if found is None:
            found = self._extra[channel] = self.writer.channel(channel)
            self.channels[found] = channel
        return found

    def _fits(self, source: int, tape: Tape) -> bool:
        """Whether a tape's numbers mean here what they mean there, so that chunks may be copied."""
        found = self._compatible.get(source)
        if found is None:
            found = tape.container == self.container and not self._compatible
            # Of those that are joined to the first, all numbers must be free or the same.
            if tape.container == self.container and self._compatible and not self._extra:
                found = all(
                    self.channels.get(number, channel) == channel
                    for number, channel in tape.channels.items()
                )
                if isinstance(tape, McapTape) and self._mcap is not None:
                    found = found and tape.is_indexed and self._mcap.agrees(tape.schemas)
            self._compatible[source] = found
        return found

    # Messages

    def write(self, source: int, message: Taken, channel: Channel, tape: Tape) -> bool:
        """Append a message of a tape's; whether the container takes it."""
        number = self._register(source, message.channel, channel, tape)
        if number is None:
            return False
        conversion = self._conversions[source, message.channel]
        assert conversion is not None
        payload = conversion.payload(message.payload)
        self.append(number, message._replace(payload=payload))
        return True

    def append(self, number: int, message: Taken) -> None:
        """Append a message as it is."""
        self.note(number, message)
        payload = message.payload if self._pack is None else self._pack(message.payload)
        self.writer.write(number, message.log_time, payload, message.publish_time, message.sequence)

    def note(self, number: int, message: Taken) -> None:
        """Note what a message holds, for the comparison."""
        channel = self.channels[number]
        key = channel.topic, channel.type
        self.counts[number] += 1
        self.digests[key] = digest(self.digests.get(key, 0), message, self.container)
        self.start = min(self.start, message.log_time)
        self.end = max(self.end, message.log_time)

    def can_copy(self, source: int, block: Block, tape: Tape) -> bool:
        """Whether a block may be copied as it lies."""
        if not (block.whole and isinstance(block, McapChunk | Rosbag1Chunk)):
            return False
        if tape.container != self.container or not self._fits(source, tape):
            return False
        for number in block.channels or ():
            channel = tape.channels[number]
            if self._register(source, number, channel, tape) != number:
                return False
            if self.channels[number] != channel:
                return False
        # A chunk's own record of a channel must not contradict the changed one.
        return not any(
            channel.topic in self._latched and _latching(channel) != channel
            for channel in tape.channels.values()
        )

    def copy(self, block: Block) -> None:
        """Append a block as it lies."""
        assert isinstance(block, McapChunk | Rosbag1Chunk)
        counts = dict(block.channels or {})
        if isinstance(block, McapChunk):
            assert self._mcap is not None
            self._mcap.flush()
            self.copied[self._mcap.position] = Copied(block, self._mcap.position)
            self._mcap.copy_chunk(block.raw(), block.entry, counts)
        else:
            assert self._bag is not None
            self._bag.flush()
            self.copied[self._bag.position] = Copied(block, self._bag.position)
            self._bag.copy_chunk(block.raw(), block.start, block.end, counts)
        self.counts.update(counts)
        if counts:
            self.start = min(self.start, block.start)
            self.end = max(self.end, block.end)

    def closed_block(self, block: Block) -> None:
        """Close the chunk that a changed one has become, packed as that was."""
        if self._mcap is not None and isinstance(block, McapChunk):
            self._mcap.flush_as(block.method, with_crc=block.has_crc)

    def finish(self, tapes: "list[Tape]") -> None:
        """Write what stands beside messages, and close the file."""
        if self._mcap is not None:
            for tape in tapes:
                for attachment in tape.extras.attachments:
                    self._mcap.copy_attachment(attachment)
                for body in tape.extras.metadata:
                    self._mcap.copy_metadata(body)
                if isinstance(tape, McapTape) and self._fits(tapes.index(tape), tape):
                    # Those without a message belong to the recording as well.
                    for number, schema in tape.schemas.items():
                        self._mcap.schema(*schema, number=number)
        self.writer.finish()


def digest(before: int, message: Taken, container: str) -> int:
    """A checksum over messages, one more; of what the container keeps of them."""
    kept = container == "mcap"
    head = _HEAD.pack(
        message.log_time, message.publish_time if kept else 0, message.sequence if kept else 0
    )
    return zlib.crc32(message.payload, zlib.crc32(head, before))


def _with(channel: Channel, *, kind: str) -> Channel:
    return Channel(
        channel.topic,
        kind,
        channel.encoding,
        channel.schema_encoding,
        channel.definition,
        channel.metadata,
    )


def _defined(channel: Channel) -> Channel:
    """A channel of ROS 2 with its definition, where the recording brings none and we know it."""
    try:
        text = ros2_definition(channel.type)
    except TftoolError:
        return channel
    metadata = dict(channel.metadata)
    if not metadata.get("topic_type_hash"):
        metadata["topic_type_hash"] = known_hash(channel.type)
    return Channel(
        channel.topic,
        channel.type,
        channel.encoding,
        "ros2msg",
        text.encode(),
        tuple(metadata.items()),
    )


def _latching(channel: Channel) -> Channel:
    """A channel that offers its last message to late subscribers."""
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
    return Channel(
        channel.topic,
        channel.type,
        channel.encoding,
        channel.schema_encoding,
        channel.definition,
        tuple(metadata.items()),
    )
