"""MCAP from front to back, chunk by chunk, with everything that stands between."""

import struct
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError
from tftool.base.stamps import LAST_STAMP, Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.container import ChunkedFile, check_told
from tftool.recordings.decompression import unpack, unpack_beginning
from tftool.recordings.edit.pieces import Piece
from tftool.recordings.edit.tape import Extras, Taken, described
from tftool.recordings.find import MCAP_MAGIC
from tftool.recordings.mcap import write as format
from tftool.recordings.mcap.format import AS_IT_IS, reason_of, strings_at, text_at
from tftool.recordings.mcap.write import ChunkEntry, CopiedAttachment

_U16, _U32, _U64 = struct.Struct("<H"), struct.Struct("<I"), struct.Struct("<Q")
_MESSAGE_HEAD = struct.Struct("<HIQQ")
_FOOTER_SIZE: Final = 37
_DATA_END_SIZE: Final = 13
_MOST_HELD: Final = 4096  # messages outside of chunks that are given at once

MOST_BYTES_HELD: Final = 1 << 26
"""Bytes of messages outside of chunks that are given at once, but for the last one."""


class McapTape:
    """An MCAP file; see `Tape`.

    Attributes:
        file: Itself.
        schemas: Its schemas by their numbers: name, encoding, data.
        schema_of: The schema of each channel.
    """

    container = "mcap"

    def __init__(self, path: Path) -> None:
        """Open it, and take what its summary tells of its channels.

        Raises:
            InputError: If it is no MCAP file.
            OSError: If it cannot be opened.
        """
        self.file = ChunkedFile(path)
        self.size = self.file.size
        self.channels: dict[int, Channel] = {}
        self.schemas: dict[int, tuple[str, str, bytes]] = {}
        self._used_schemas: set[int] = set()
        self.schema_of: dict[int, int] = {}
        self.is_indexed = False
        self.extras = Extras()
        self.damage = self.file.damage
        self.style: dict[str, Any] = {
            "profile": "",
            "library": "",
            "compression": "",
            "chunked": False,
            "with_crc": False,
            "with_chunk_crc": False,
            "chunk_size": 0,
        }
        if self.file.up_to(0, len(MCAP_MAGIC)) != MCAP_MAGIC:
            self.close()
            raise InputError(f"'{path}' is no MCAP file.")
        self._read_style()
        try:
            self.is_indexed = self._read_summary()
        except (InputError, struct.error) as error:
            self.is_indexed = False
            self.damage.append(f"Its summary cannot be read ({error}).")

    def close(self) -> None:
        """Close the file."""
        self.file.close()

    def _read_style(self) -> None:
        """Find out by its first records how it is written."""
        position = len(MCAP_MAGIC)
        try:
            while position + 9 <= self.size:
                code, length = format.RECORD.unpack(self.file.at(position, 9))
                if code == format.HEADER:
                    head = self.file.at(position + 9, length)
                    self.style["profile"], place = text_at(head, 0, errors=AS_IT_IS)
                    self.style["library"], _ = text_at(head, place, errors=AS_IT_IS)
                elif code == format.CHUNK:
                    McapChunk(self, position, min(position + 9 + length, self.size), False)
                    return
                elif code in (0, format.MESSAGE, format.DATA_END, format.FOOTER):
                    return
                position += 9 + length
        except (InputError, struct.error):
            return

    def _read_summary(self) -> bool:
        size = self.size
        tail = self.file.at(max(0, size - _FOOTER_SIZE), min(size, _FOOTER_SIZE))
        if not tail.endswith(MCAP_MAGIC) or tail[0] != format.FOOTER:
            self.damage.append("The recording was not closed.")
            return False
        (begin,) = _U64.unpack_from(tail, 9)
        (crc,) = _U32.unpack_from(tail, 25)
        if not begin:
            return False
        if not len(MCAP_MAGIC) <= begin <= size - _FOOTER_SIZE:
            raise InputError(f"it should begin at byte {begin}")
        summary = self.file.at(begin, size - _FOOTER_SIZE - begin)
        if crc and zlib.crc32(summary + tail[:25]) != crc:
            raise InputError("its CRC is wrong")
        for code, first, last in _records(summary):
            self.learn(code, summary[first:last])
        data_end = self.file.at(begin - _DATA_END_SIZE, _DATA_END_SIZE)
        if data_end[0] == format.DATA_END:
            self.style["with_crc"] = data_end[9:] != bytes(4)
        return True

    def learn(self, code: int, body: bytes) -> None:
        """Take what a record tells of schemas and channels."""
        if code in (format.SCHEMA, format.CHANNEL):
            check_told(len(body))
        if code == format.SCHEMA:
            (number,) = _U16.unpack_from(body)
            name, place = text_at(body, 2, errors=AS_IT_IS)
            encoding, place = text_at(body, place, errors=AS_IT_IS)
            (length,) = _U32.unpack_from(body, place)
            # As in `mcap.read`: the last definition counts, until a channel names it.
            if number not in self._used_schemas:
                self.schemas[number] = (name, encoding, body[place + 4 : place + 4 + length])
        elif code == format.CHANNEL:
            number, schema = struct.unpack_from("<HH", body)
            if number in self.channels:
                return
            topic, place = text_at(body, 4, errors=AS_IT_IS)
            encoding, place = text_at(body, place, errors=AS_IT_IS)
            metadata = strings_at(body, place, AS_IT_IS)
            if schema not in self.schemas:
                schema = 0  # Of none: what tells of it is damaged.
            name, kind, data = self.schemas.get(schema, ("", "", b""))
            self.schema_of[number] = schema
            self._used_schemas.add(schema)
            self.channels[number] = Channel(
                topic, name, encoding, kind, data, tuple(metadata.items())
            )

    # From front to back

    def blocks(self) -> "Iterator[McapChunk | _Loose]":
        """Its chunks, and the messages between them."""
        position, size = len(MCAP_MAGIC), self.size
        loose: list[Taken] = []
        held = 0
        ended = False
        while position + 9 <= size:
            code, length = format.RECORD.unpack(self.file.at(position, 9))
            body, end = position + 9, position + 9 + length
            if code in (format.DATA_END, format.FOOTER):
                ended = True
                break
            if code == 0 or (end > size and code != format.CHUNK):
                break
            try:
                if code == format.CHUNK:
                    if loose:
                        yield _Loose(loose)
                        loose, held = [], 0
                    chunk = McapChunk(self, position, min(end, size), end > size)
                    position = chunk.behind
                    yield chunk
                    continue
                if code == format.MESSAGE:
                    message = _message(self.file.at(body, length), 0, length)
                    loose += described([message], self.channels, self.file)
                    held += length
                    if len(loose) >= _MOST_HELD or held >= MOST_BYTES_HELD:
                        yield _Loose(loose)
                        loose, held = [], 0
                elif code in (format.SCHEMA, format.CHANNEL):
                    self.learn(code, self.file.at(body, length))
                elif code == format.ATTACHMENT:
                    self._attachment(position, length)
                elif code == format.METADATA:
                    self.extras.metadata.append(self.file.at(body, length))
            except (InputError, struct.error) as error:
                self.file.note(f"A record at byte {position} cannot be read ({reason_of(error)}).")
            if end > size:
                break
            position = end
        if loose:
            yield _Loose(loose)
        if not ended:
            self.file.note(f"The recording breaks off at byte {position}.")

    def _attachment(self, position: int, length: int) -> None:
        """Note where an attachment lies, which may be larger than memory."""
        file, body = self.file, position + 9
        place = body + 16
        for _ in range(2):
            (size,) = _U32.unpack(file.at(place, 4))
            place += 4 + size
        end = body + length - 4
        if place + 8 > end:
            raise InputError("it is too short for an attachment")
        names = file.at(body + 16, place - body - 16)
        (size,) = _U64.unpack(file.at(place, 8))
        (crc,) = _U32.unpack(file.at(end, 4))
        if crc and Piece(file.fileno(), body, length - 4).crc() != crc:
            file.note(f"The CRC of the attachment at byte {position} is wrong: it is left out.")
            return
        whole = Piece(file.fileno(), position, 9 + length)
        self.extras.attachments.append(CopiedAttachment(whole, file.at(body, 16), names, size))


class _Loose:
    """Messages outside of chunks; see `Block`."""

    whole = False

    def __init__(self, messages: list[Taken]) -> None:
        self._messages = messages
        self.start = min(one.log_time for one in messages)
        self.end = max(one.log_time for one in messages)
        self.channels: Mapping[int, int] | None = None

    def sound(self) -> bool:
        """Whether it is; there is no proof of that."""
        return True

    def messages(self) -> list[Taken]:
        """Its messages."""
        return self._messages


class McapChunk:
    """One chunk with its message indexes; see `Block`.

    Attributes:
        position: Where its record begins.
        method: How it is compressed.
        behind: Where the record behind its message indexes begins.
    """

    def __init__(self, tape: McapTape, position: int, end: int, cut: bool) -> None:
        self._tape = tape
        self.position = position
        self._end = end
        self._cut = cut
        self._found: list[Taken] | None = None
        self._is_examined = False
        head = tape.file.at(position, min(end - position, 256))
        self._crc: int
        start, stop, self._size, self._crc, length = struct.unpack_from("<QQQII", head, 9)
        if length > 64:
            raise InputError(f"a compression's name announces {length} bytes")
        self.method = head[41 : 41 + length].decode("utf-8", "backslashreplace")
        (packed,) = _U64.unpack_from(head, 41 + length)
        self._data = position + 49 + length
        self._packed = min(packed, end - self._data)
        if packed != self._packed:
            self._cut = True
        self.start: Stamp = min(start, LAST_STAMP)
        self.end: Stamp = min(stop, LAST_STAMP)
        tape.style["chunked"] = True
        tape.style["compression"] = self.method or "none"
        tape.style["with_chunk_crc"] = bool(self._crc)
        tape.style["chunk_size"] = max(tape.style["chunk_size"], self._size)
        self._offsets: dict[int, int] = {}
        self.channels: Mapping[int, int] | None = None
        self.behind = end
        self._read_indexes()
        known = self.channels is not None and self.channels.keys() <= tape.channels.keys()
        # Without a summary its own records may be all that tells of channels behind it.
        self.whole = known and tape.is_indexed and not self._cut

    def _read_indexes(self) -> None:
        """Step over the message indexes behind it, and note what they tell."""
        tape, counts, length = self._tape, dict[int, int](), 0
        position = self._end
        while not self._cut and position + 15 <= tape.size:
            head = tape.file.at(position, 15)
            code, length = format.RECORD.unpack_from(head)
            if code != format.MESSAGE_INDEX or position + 9 + length > tape.size:
                break
            (channel,) = _U16.unpack_from(head, 9)
            (count,) = _U32.unpack_from(head, 11)
            if count != length - 6 or count % 16:
                break
            if count:
                counts[channel] = counts.get(channel, 0) + count // 16
            self._offsets[channel] = position
            position += 9 + length
        self.behind = position
        if self._offsets:
            self.channels = counts

    @property
    def has_crc(self) -> bool:
        """Whether it carries a CRC."""
        return bool(self._crc)

    @property
    def entry(self) -> ChunkEntry:
        """What the summary says of it."""
        return ChunkEntry(
            self.start,
            self.end,
            self.position,
            self._end - self.position,
            self._offsets,
            self.behind - self._end,
            self.method,
            self._packed,
            self._size,
        )

    def raw(self) -> Piece:
        """Its record and those of its message indexes."""
        return Piece(self._tape.file.fileno(), self.position, self.behind - self.position)

    def messages(self) -> list[Taken]:
        """Its messages, those up to the damage where there is any."""
        if self._found is not None:
            return self._found
        tape, found = self._tape, list[Taken]()
        data = self._unpacked()
        try:
            for code, first, last in _records(data):
                if code == format.MESSAGE:
                    found.append(_message(data, first, last))
                else:
                    tape.learn(code, data[first:last])
        except (InputError, struct.error) as error:
            if not self._cut:
                tape.file.note(
                    f"The chunk at byte {self.position} is damaged ({reason_of(error)})."
                )
            self.whole = False
        self._found = found = described(found, tape.channels, tape.file)
        counts: dict[int, int] = {}
        for one in found:
            counts[one.channel] = counts.get(one.channel, 0) + 1
        if counts != self.channels:
            self.whole = False
        self.channels = counts
        return found

    def sound(self) -> bool:
        """Whether what it holds is what was written, as far as it carries proof of that.

        Found out once, by whatever thread asks first; others may ask when it has answered.
        """
        if self._found is None and not self._is_examined:
            if self.method:
                self._whole(self._tape.file.at(self._data, self._packed))
            elif self._crc and not self._cut:
                self._check(Piece(self._tape.file.fileno(), self._data, self._packed).crc())
        self._is_examined = True
        return self.whole

    def _unpacked(self) -> bytes:
        packed = self._tape.file.at(self._data, self._packed)
        whole = None if self._cut else self._whole(packed)
        return unpack_beginning(self.method, packed, self._size) if whole is None else whole

    def _whole(self, packed: bytes) -> bytes | None:
        """All that it holds; None where it is damaged, which is noted as a wrong CRC is."""
        try:
            data = unpack(self.method, packed, self._size)
        except InputError as error:
            self._tape.file.note(f"The chunk at byte {self.position} is damaged ({error}).")
            self.whole = False
            return None
        if self._crc:
            self._check(zlib.crc32(data))
        return data

    def _check(self, crc: int) -> None:
        """Hold the CRC of what it holds against the one it carries."""
        if crc != self._crc:
            self._tape.file.note(
                f"The CRC of the chunk at byte {self.position} is wrong: its messages are "
                "copied as they are, and may not be what was recorded."
            )
            self.whole = False


def _message(data: bytes, first: int, last: int) -> Taken:
    """The message between two places; the payload is copied once, which is what takes long."""
    if last - first < _MESSAGE_HEAD.size:
        raise struct.error("a message's record is shorter than its head")
    channel, sequence, log_time, publish_time = _MESSAGE_HEAD.unpack_from(data, first)
    payload = data[first + _MESSAGE_HEAD.size : last]
    return Taken(channel, min(log_time, LAST_STAMP), payload, publish_time, sequence)


def _records(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Every record's code, and where its body begins and ends."""
    position, size = 0, len(data)
    while position + 9 <= size:
        code, length = format.RECORD.unpack_from(data, position)
        first = position + 9
        position = first + length
        if position > size:
            raise InputError("it ends within a record")
        yield code, first, position
