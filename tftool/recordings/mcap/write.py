"""Writer of MCAP files: chunks with message indexes, CRCs, attachments, and the summary.

Source: the MCAP format specification, version 0.
"""

import io
import struct
import zlib
from array import array
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.chunked import Chunk
from tftool.recordings.chunked_writer import NOTHING_YET, ChunkedWriter
from tftool.recordings.container import CopiedAttachment, Extras, MessageTable
from tftool.recordings.containers import MCAP_MAGIC, library_name
from tftool.recordings.decompression import best_compression, compressor
from tftool.recordings.mcap.format import (
    ATTACHMENT_INDEX,
    CHANNEL,
    CHUNK,
    CHUNK_HEAD,
    CHUNK_INDEX,
    DATA_END,
    FOOTER,
    HEADER,
    MESSAGE,
    MESSAGE_RECORD,
    METADATA,
    METADATA_INDEX,
    RECORD,
    SCHEMA,
    STATISTICS,
    SUMMARY_OFFSET,
    U16,
    U32,
    U64,
    IndexEntry,
    entries,
    message_index,
    record,
    strings,
    text,
)

COMPRESSIONS: Final = ("zstd", "lz4", "none")

CHUNK_SIZE: Final = 1 << 20
"""Default size of a chunk's uncompressed messages, bytes."""

LARGEST_CHUNK: Final = 1 << 26
"""Maximum size of a chunk's uncompressed messages in an edit, where it replaces another chunk."""

MOST_CHANNELS: Final = 65_535

_HEADS = np.dtype(
    [
        ("code", "u1"),
        ("length", "<u8"),
        ("channel", "<u2"),
        ("sequence", "<u4"),
        ("log_time", "<u8"),
        ("publish_time", "<u8"),
    ]
)
"""numpy's type of a message's record before the payload, as `MESSAGE_RECORD`."""

_UNCHUNKED: Final = 1 << 16  # bytes written at a time in a file without chunks


class McapWriter(ChunkedWriter):
    """Writer of an MCAP file; new channels and schemas get numbers from `first_free` on."""

    @classmethod
    def in_style(cls, path: Path, style: Mapping[str, Any], *, profile: str) -> "McapWriter":
        """Create an output file of `tftool edit`; see `ContainerFormat.create_like`."""
        before = style.get("library", "")
        # Each changed chunk of an input becomes one chunk: `end_block` ends it.
        size = LARGEST_CHUNK if style.get("chunked") else CHUNK_SIZE
        return cls(
            path,
            profile=style.get("profile", profile),
            library=library_name() + (f"; was: {before}" if before else ""),
            compression=style.get("compression") or best_compression(),
            chunk_size=size if style.get("chunked", True) else 0,
            with_crc=style.get("with_crc", True),
        )

    def __init__(
        self,
        path: Path,
        *,
        profile: str = "ros2",
        library: str = "",
        compression: str | None = None,
        chunk_size: int = CHUNK_SIZE,
        with_crc: bool = True,
    ) -> None:
        """Create the file; replace an existing file.

        Args:
            path: Path of the file.
            profile: Profile of the channels: "ros2", "ros1", or "".
            library: Name of the program that writes the file.
            compression: Compression of each chunk: "zstd", "lz4" or "none"; None for "zstd".
            chunk_size: Size of a chunk's uncompressed messages, bytes; 0 for no chunks.
            with_crc: Whether to write CRCs of the chunks and of all data.

        Raises:
            UsageError: If the compression is not known, or not installed.
            OSError: If the file cannot be written.
        """
        compression = compression or "zstd"
        if compression not in COMPRESSIONS:
            raise UsageError(
                f"'{compression}' is not a compression of MCAP: use {', '.join(COMPRESSIONS)}."
            )
        super().__init__(path, "" if compression == "none" else compression, with_crc=with_crc)
        self.first_free = 1
        self._chunk_size = chunk_size
        self._limit = chunk_size or _UNCHUNKED
        self._with_chunk_crc = with_crc
        self._schemas: dict[tuple[str, str, bytes], int] = {}
        self._schema_records: dict[int, bytes] = {}
        self._schema_of: dict[int, int] = {}
        self._chunks: list[bytes] = []  # records of the chunks in the summary
        self._attachments: list[bytes] = []
        self._metadata: list[bytes] = []
        self._low, self._high = NOTHING_YET, 0
        self._put(MCAP_MAGIC + record(HEADER, text(profile) + text(library)))

    @property
    def span(self) -> tuple[Stamp, Stamp]:
        """First and last log time of the messages in the file; (0, 0) if the file has none."""
        return (0 if self._low == NOTHING_YET else self._low), self._high

    # Channels

    def channel(
        self, channel: Channel, number: int | None = None, schema: int | None = None
    ) -> int:
        """Register a channel, and return the number that identifies the channel in `write`.

        Args:
            channel: The channel; a channel that is registered already keeps its number.
            number: Number for the channel; None for any unused number.
            schema: Number of a registered schema; None to choose the schema by the channel's type.

        Raises:
            InputError: If there are too many channels or schemas.
        """
        known = self._known.get(channel)
        if known is not None and number in (None, known):
            return known
        if schema is None:
            schema = 0
        if not schema and (channel.type or channel.schema_encoding) and number is None:
            schema = self.schema(channel.type, channel.schema_encoding, channel.definition)
        number = self._free(self._channel_records, number)
        self._known[channel] = number
        self.add_channel(
            number, schema, channel.topic, channel.encoding, strings(dict(channel.metadata))
        )
        return number

    def schema(self, name: str, encoding: str, data: bytes, number: int | None = None) -> int:
        """Register a schema (a message type's definition), and return the schema's number."""
        key = name, encoding, data
        if number is None and key in self._schemas:
            return self._schemas[key]
        number = self._free(self._schema_records, number)
        self._schemas[key] = number
        self._schema_records[number] = record(
            SCHEMA, U16.pack(number) + text(name) + text(encoding) + U32.pack(len(data)) + data
        )
        return number

    def agrees(self, schemas: Mapping[int, tuple[str, str, bytes]]) -> bool:
        """Whether each schema number is unused in this file, or has the same schema here."""
        here = {number: key for key, number in self._schemas.items()}
        return all(
            here[number] == schema if number in here else number not in self._schema_records
            for number, schema in schemas.items()
        )

    def add_channel(
        self, number: int, schema: int, topic: str, encoding: str, metadata: bytes
    ) -> None:
        """Register a channel from the fields of a channel record, with `metadata` as bytes."""
        self._schema_of[number] = schema
        self._channel_records[number] = record(
            CHANNEL, struct.pack("<HH", number, schema) + text(topic) + text(encoding) + metadata
        )

    def _free(self, taken: Collection[int], wanted: int | None) -> int:
        if wanted is not None:
            return wanted
        number = max(len(taken) + 1, self.first_free)
        while number in taken:
            number += 1
        if number > MOST_CHANNELS:
            raise InputError(
                f"An MCAP file can contain at most {MOST_CHANNELS} channels and schemas."
            )
        return number

    def _define(self, channel: int) -> None:
        """Write the records of a channel and its schema, before the channel's first message."""
        self._defined.add(channel)
        schema = self._schema_of[channel]
        if schema:
            self._keep(self._schema_records[schema])
        self._keep(self._channel_records[channel])

    # Messages

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append a message to a channel."""
        if channel not in self._defined:
            self._define(channel)
        if log_time < 0:
            raise InputError(
                f"A log time of {log_time} ns is before 1970, which MCAP cannot store."
            )
        length = len(payload)
        head = MESSAGE_RECORD.pack(
            MESSAGE,
            length + 22,
            channel,
            sequence & 0xFFFFFFFF,
            log_time,
            log_time if publish_time is None else publish_time,
        )
        index = self._indexes.get(channel)
        if index is None:
            index = self._indexes[channel] = array("Q")
        index.append(log_time)
        index.append(self._length)
        self._pieces.append(head)
        self._pieces.append(payload)
        self._length += length + 31
        if log_time < self._chunk_low:
            self._chunk_low = log_time
        if log_time > self._chunk_high:
            self._chunk_high = log_time
        if self._length >= self._limit:
            self.flush()

    def write_table(self, table: MessageTable) -> bool:
        """Append messages in bulk, and return True; return False if `write` must append them."""
        channels = table.owners
        size = int(table.lengths.sum()) + 31 * len(table)
        known = self._defined.issuperset(channels)
        if self._length or not known or not self._chunk_size or size >= self._limit:
            return False
        heads = np.empty(len(table), dtype=_HEADS)
        heads["code"] = MESSAGE
        heads["length"] = table.lengths + 22
        heads["channel"] = table.channels
        heads["sequence"] = table.sequences
        heads["log_time"] = table.log_times
        heads["publish_time"] = table.publish_times
        data, places = table.with_headers(heads)
        self._keep(data.tobytes())
        pairs = np.stack([table.log_times, places], axis=1)
        for channel in channels:
            self._indexes[channel] = array("Q", pairs[table.channels == channel].tobytes())
        self._chunk_low, self._chunk_high = int(pairs[:, 0].min()), int(pairs[:, 0].max())
        return True

    def flush(self) -> None:
        """Write the buffered messages as a chunk."""
        if not self._length:
            return
        pieces, size = self._pieces, self._length
        indexes, low, high = self._indexes, self._chunk_low, self._chunk_high
        self._new_chunk()
        if not indexes:
            low = high = 0
        if not self._chunk_size:
            self._put(*pieces)
            self._count_all(indexes, low, high)
            return
        packed, crc = size, 0
        if self.method:
            records = b"".join(pieces)
            pieces = [self._pack(records)]
            packed = len(pieces[0])
            crc = zlib.crc32(records) if self._with_chunk_crc else 0
        elif self._with_chunk_crc:
            for piece in pieces:
                crc = zlib.crc32(piece, crc)
        head = CHUNK_HEAD.pack(low, high, size, crc) + text(self.method) + U64.pack(packed)
        place = self.position
        parts = [RECORD.pack(CHUNK, len(head) + packed), head, *pieces]
        begin = behind = place + 9 + len(head) + packed
        offsets = {}
        for channel, index in indexes.items():
            offsets[channel] = begin
            parts.append(message_index(channel, index))
            begin += len(parts[-1])
        self._put(*parts)
        self._count_all(indexes, low, high)
        entry = IndexEntry(
            low, high, place, behind - place, offsets, begin - behind, self.method, packed, size
        )
        self._chunks.append(entry.record())

    def end_block(self, chunk: Chunk) -> None:
        """Write the current chunk to replace `chunk`, with the same compression and CRC setting."""
        before = self.method, self._pack, self._with_chunk_crc
        try:
            if chunk.method != self.method:
                self.method, self._pack = chunk.method, compressor(chunk.method)
            self._with_chunk_crc = bool(chunk.crc)
            self.flush()
        finally:
            self.method, self._pack, self._with_chunk_crc = before

    def _count_all(self, indexes: "Mapping[int, array[int]]", low: int, high: int) -> None:
        for channel, index in indexes.items():
            self._count(channel, len(index) // 2, low, high)

    def _count(self, channel: int, count: int, low: int, high: int) -> None:
        self.counts[channel] = self.counts.get(channel, 0) + count
        if count:
            self._low, self._high = min(self._low, low), max(self._high, high)

    # Copies from other files

    def adopt(
        self, channel: Channel, number: int, origin: tuple[int, tuple[str, str, bytes] | None]
    ) -> None:
        """Register a channel of another file under the same number.

        Args:
            channel: The channel.
            number: Number of the channel in both files.
            origin: Number of the channel's schema in the other file, and the schema; see
                `Mcap.origin`.
        """
        schema, described = origin
        if described is not None:
            self.schema(*described, number=schema)
        self.channel(channel, number, schema)

    def copy_chunk(self, chunk: Chunk) -> None:
        """Copy a chunk and its message indexes from another file."""
        self.flush()
        moved = self.position - chunk.position
        counts = chunk.counts or {}
        for channel, count in counts.items():
            self._count(channel, count, chunk.start, chunk.end)
        self._defined.update(counts)
        self._copy(chunk.raw())
        entry = IndexEntry(
            chunk.start,
            chunk.end,
            chunk.position + moved,
            chunk.length,
            {channel: place + moved for channel, place in chunk.indexes.items()},
            chunk.behind - chunk.position - chunk.length,
            chunk.method,
            chunk.packed,
            chunk.size,
        )
        self._chunks.append(entry.record())

    def copy_extras(self, extras: Extras, schemas: Mapping[int, tuple[str, str, bytes]]) -> None:
        """Copy attachments, metadata and schemas of another file, including unused schemas."""
        for attachment in extras.attachments:
            self.copy_attachment(attachment)
        for body in extras.metadata:
            self.copy_metadata(body)
        for number, schema in schemas.items():
            self.schema(*schema, number=number)

    def copy_attachment(self, copied: CopiedAttachment) -> None:
        """Copy an attachment from another file."""
        self.flush()
        place = struct.pack("<QQ", self.position, copied.piece.length)
        self._copy(copied.piece)
        told = place + copied.times + U64.pack(copied.size) + copied.names
        self._attachments.append(record(ATTACHMENT_INDEX, told))

    def copy_metadata(self, body: bytes) -> None:
        """Copy the body of a metadata record from another file.

        Raises:
            struct.error: If the record is not metadata.
        """
        (length,) = U32.unpack_from(body)
        self.flush()
        begin = self.position
        piece = record(METADATA, body)
        self._put(piece)
        self._metadata.append(
            record(METADATA_INDEX, struct.pack("<QQ", begin, len(piece)) + body[: 4 + length])
        )

    # End of the file

    def finish(self) -> None:
        """Write buffered messages and the summary, and close the file."""
        try:
            self.flush()
            self._close()
        finally:
            self._file.close()

    def _close(self) -> None:
        end = record(DATA_END, U32.pack(self._crc if self._with_crc else 0))
        summary = self._summary(self.position + len(end))
        self._put(end + summary + MCAP_MAGIC)

    def rescue(self) -> bool:
        """Cut the file after the last whole chunk, write the summary if it fits, close the file.

        Returns:
            Whether there was space for the summary.
        """
        self._new_chunk()
        whole = self.position
        self._file.close()
        try:
            self._file = io.FileIO(self._path, "rb+")
            self._file.truncate(whole)
            self._file.seek(whole)
            self.finish()
        except OSError:
            with open(self._path, "rb+") as file:
                file.truncate(whole)
            return False
        return True

    def _summary(self, begin: int) -> bytes:
        low = 0 if self._low == NOTHING_YET else self._low
        statistics = struct.pack(
            "<QHIIIIQQ",
            sum(self.counts.values()),
            len(self._schema_records),
            len(self._channel_records),
            len(self._attachments),
            len(self._metadata),
            len(self._chunks),
            low,
            self._high,
        ) + entries(self.counts)
        groups = (
            (SCHEMA, list(self._schema_records.values())),
            (CHANNEL, list(self._channel_records.values())),
            (STATISTICS, [record(STATISTICS, statistics)]),
            (CHUNK_INDEX, self._chunks),
            (ATTACHMENT_INDEX, self._attachments),
            (METADATA_INDEX, self._metadata),
        )
        found, offsets, place = [], [], begin
        for code, records in groups:
            group = b"".join(records)
            if group:
                found.append(group)
                offsets.append(record(SUMMARY_OFFSET, struct.pack("<BQQ", code, place, len(group))))
                place += len(group)
        summary = b"".join(found) + b"".join(offsets)
        summary += RECORD.pack(FOOTER, 20) + struct.pack("<QQ", begin, place)
        return summary + U32.pack(zlib.crc32(summary))
