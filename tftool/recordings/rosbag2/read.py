"""Reader of rosbag2's sqlite files, without lock or journal files in the folder.

Messages are read in bulk, directly from the pages of the file. Only plain pages are read in this
way. At the first unexpected page or row the reader stops, and sqlite itself continues after the
last row read.

Source: the SQLite database file format, sections 1.3 to 1.6 and 2.1.
"""

import itertools
import shutil
import sqlite3
import struct
import tempfile
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any, Final, TypeAlias
from urllib.parse import quote

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError, UsageError
from tftool.messages.transform_rows import SCAN, Bytes
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch, words_at
from tftool.recordings.container import MOST_STREAMS, Extras, File, MessageTable
from tftool.recordings.containers import ZSTD_MAGIC
from tftool.recordings.contract import Progress, Stamps
from tftool.recordings.decompression import LARGEST, unpack_beginning

Pages: TypeAlias = npt.NDArray[np.int64]
"""Numbers of pages, from 1, shape (n,)."""

_HEAD: Final = 100
_INTERIOR: Final = 0x05
_LEAF: Final = 0x0D
_DEEPEST: Final = 20
_AT_ONCE: Final = 256  # pages read in one step
_MOST_APART: Final = 2  # maximum ratio of pages read to pages needed, to read them with one call
_LEAST_ROW: Final = 8  # minimum size of a row, bytes
_MOST_SPILLED: Final = 64 << 20  # bytes in one batch of messages that continue on other pages


class _Odd(Exception):
    """Exception for unusual pages or rows, which must be read by sqlite instead."""


def read_pages(path: Path, root: int, streams: dict[int, int]) -> Iterator[tuple[Batch, int]]:
    """Yield the messages of some topics in batches, in the order of rows.

    Args:
        path: Path of the file.
        root: Number of the root page of the message table; 0 reads nothing.
        streams: Index of the stream of each topic, by the id of the topic in the file.

    Returns:
        Batches, each with the id of its last row; rows after the last batch must be read by sqlite.
    """
    if root < 2:
        return
    try:
        file = File(path)
    except OSError:
        return
    try:
        yield from _Table(file).batches(root, streams)
    except (_Odd, InputError, struct.error, OSError):
        return
    finally:
        file.close()


class _Table:
    """Reader of the pages of one table in a file."""

    def __init__(self, file: File) -> None:
        head = file.at(0, _HEAD)
        (size,) = struct.unpack_from(">H", head, 16)
        self._file = file
        self._size = 65_536 if size == 1 else size
        self._usable = self._size - head[20]
        self._last = -(2**63)
        if self._size < 512 or self._size & (self._size - 1) or self._usable < 480:
            raise _Odd
        room = _AT_ONCE * (self._size // _LEAST_ROW)
        # Reused for every batch, because new memory is slower.
        self._pages = np.empty(_MOST_APART * _AT_ONCE * self._size, dtype=np.uint8)
        self._senders = np.empty(room, dtype=np.int32)
        self._columns = [np.empty(room, dtype=np.int64) for _ in range(3)]

    def _page(self, number: int) -> bytes:
        if number < 2:
            raise _Odd
        return self._file.at((number - 1) * self._size, self._size)

    def batches(self, root: int, streams: dict[int, int]) -> Iterator[tuple[Batch, int]]:
        """Yield batches of messages with the id of the last row; see `read_pages`."""
        numbered = sorted(one for one in streams.items() if -(2**63) <= one[0] < 2**63)
        wanted = np.array(numbered, dtype=np.int64)
        for pages in self._leaves(root):
            for begin in range(0, len(pages), _AT_ONCE):
                yield self._batch(*self._read(pages[begin : begin + _AT_ONCE]), wanted)

    def _read(self, pages: Pages) -> tuple[Bytes, Pages]:
        """Read pages; return the bytes, and the offset of each page in the bytes."""
        first, apart = int(pages.min()), pages - pages.min()
        span = int(apart.max()) + 1
        if span <= _MOST_APART * len(pages):
            # Reading the pages between them (usually an index) costs less than another call.
            found = self._pages[: span * self._size]
            self._file.into((first - 1) * self._size, found.data)
            return found, apart * self._size
        found = self._pages[: len(pages) * self._size]
        # Begin and end of each run of consecutive pages.
        runs = np.flatnonzero(np.diff(pages, prepend=-1) != 1).tolist()
        for run, end in itertools.pairwise([*runs, len(pages)]):
            room = found.data[run * self._size : end * self._size]
            self._file.into((int(pages[run]) - 1) * self._size, room)
        return found, np.arange(0, len(found), self._size, dtype=np.int64)

    def _leaves(self, root: int) -> Iterator[Pages]:
        """Yield the numbers of the table's leaf pages in order of rows, in groups."""
        page = self._page(root)
        if page[0] == _LEAF:
            yield np.array([root])
            return
        # Pages to visit with their depth; the next page is last.
        waiting, seen = [(root, 0)], 0
        while waiting:
            number, depth = waiting.pop()
            page = self._page(number)
            seen += 1
            if page[0] != _INTERIOR or depth > _DEEPEST or seen > self._file.size // self._size:
                raise _Odd
            children = self._children(page)
            if self._page(int(children[0]))[0] == _LEAF:
                yield children
            else:
                waiting += [(one, depth + 1) for one in reversed(children.tolist())]

    def _children(self, page: bytes) -> Pages:
        (count,) = struct.unpack_from(">H", page, 3)
        if 12 + 2 * count > self._usable:
            raise _Odd
        cells = np.frombuffer(page, dtype=">u2", count=count, offset=12).astype(np.int64)
        if count and int(cells.max()) > self._usable - 4:
            raise _Odd
        found = np.empty(count + 1, dtype=np.int64)
        found[:count] = words_at(np.frombuffer(page, dtype=np.uint8), cells, ">u4")
        (found[count],) = struct.unpack_from(">I", page, 8)
        if int(found.min()) < 2:
            raise _Odd
        return found

    def _batch(self, pages: Bytes, places: Pages, wanted: Stamps) -> tuple[Batch, int]:
        """Return the messages of some leaf pages, and the id of their last row."""
        columns = self._senders, *self._columns
        found = SCAN.rows(pages, places, wanted, *columns, self._size, self._usable, self._last)
        if found is None:
            raise _Odd
        rows, self._last = found
        senders = self._senders[:rows].copy()
        times, starts, lengths = (one[:rows].copy() for one in self._columns)
        apart = np.flatnonzero(starts < 0)
        if len(apart):
            if int(lengths[apart].sum()) > _MOST_SPILLED:
                raise _Odd
            raw = pages.tobytes()
            pieces, end = [raw], len(raw)
            for row in apart.tolist():
                pieces.append(self._joined(raw, -1 - int(starts[row]), int(lengths[row])))
                starts[row] = end
                end += len(pieces[-1])
            pages = np.frombuffer(b"".join(pieces), dtype=np.uint8)
        return Batch(pages, starts, lengths, times, senders), self._last

    def _joined(self, raw: bytes, cell: int, length: int) -> bytes:
        """Return the message of a row that continues on other pages."""
        size, place = _varint(raw, cell)
        _, place = _varint(raw, place)
        usable = self._usable
        least = (usable - 12) * 32 // 255 - 23
        here = least + (size - least) % (usable - 4)
        if here > usable - 35:
            here = least
        end = cell // self._size * self._size + usable
        if place + here + 4 > end or size > self._file.size:
            raise _Odd
        parts = [raw[place : place + here]]
        (number,) = struct.unpack_from(">I", raw, place + here)
        left = size - here
        while left > 0:
            page = self._page(number)
            parts.append(page[4 : 4 + min(left, usable - 4)])
            left -= len(parts[-1])
            (number,) = struct.unpack_from(">I", page)
        if number:
            raise _Odd
        # The data is the last column.
        return b"".join(parts)[-length:] if length else b""


def _varint(data: bytes, place: int) -> tuple[int, int]:
    """Parse a variable-length integer of sqlite; return the integer and the offset after it."""
    found = 0
    for end in range(place, place + 8):
        found = found << 7 | data[end] & 0x7F
        if data[end] < 0x80:
            return found, end + 1
    return found << 8 | data[place + 8], place + 9


_ROWS: Final = 2048  # rows fetched in one step
_ROOM: Final = bytes(8)
_MOST_BYTES: Final = 1 << 26  # bytes of these rows; the last row may exceed it
_MOST_COPIED: Final = 1 << 30
_LARGEST_VALUE: Final = 1 << 28  # bytes of one value
_MOST_DEFINED: Final = 1 << 26  # characters of all definitions
_MOST_GAPS: Final = 40
_LEAST_HEAD: Final = 4096

LOWEST_ROW: Final = -(2**63)
"""Number that is lower than the number of any row."""

# Name, type and position in the primary key of each column.
_COLUMNS: Final = [
    ("id", "INTEGER", 1),
    ("topic_id", "INTEGER", 0),
    ("timestamp", "INTEGER", 0),
    ("data", "BLOB", 0),
]

_NAMES: Final = {name for name, _, _ in _COLUMNS}
_DEFINITION: Final = "encoded_message_definition"

# sqlite's message about a damaged file may contain bytes that are not text.
_FAULTS: Final = (sqlite3.Error, UnicodeDecodeError)


class Sqlite:
    """Reader of a `.db3` file; see `ContainerReader`.

    Attributes:
        path: Path of the file.
        unpacks: Whether `blocks` decompresses messages, if rosbag2 compressed message by message.
        topic_ids: Id of each stream's topic in the file.
    """

    kind = "rosbag2 (sqlite3)"
    container = "db3"

    def __init__(self, path: Path, *, by_index: bool = True) -> None:
        """Open the file, and find its topics.

        Args:
            path: Path of the file.
            by_index: Ignored: rows are always read in their order.

        Raises:
            InputError: If the file is damaged, or not a recording.
            OSError: If the file cannot be opened.
        """
        self.path = path
        self.unpacks = False
        self.size = path.stat().st_size
        self.damage: list[str] = []
        self._copy: tempfile.TemporaryDirectory[str] | None = None
        self._base = self._open(path)
        self.topic_ids: list[int] = []
        self.streams: list[Channel] = []
        self.channels: dict[int, Channel] = {}
        self.extras = Extras()
        self.style: dict[str, Any] = {}
        try:
            self._read_topics()
            self.start, self.end = self._span()
        except BaseException as error:
            self.close()
            if not isinstance(error, _FAULTS):
                raise
            raise InputError(f"'{path}' cannot be read as a rosbag2 recording: {error}.") from error

    def _open(self, path: Path) -> sqlite3.Connection:
        log = path.with_name(path.name + "-wal")
        if log.exists() and log.stat().st_size:
            # The last messages are only in the log. sqlite must write to read them, so use a copy.
            if path.stat().st_size + log.stat().st_size <= _MOST_COPIED:
                self._copy = tempfile.TemporaryDirectory(prefix="tftool-")
                copied = Path(self._copy.name) / "recording.db3"
                shutil.copyfile(path, copied)
                shutil.copyfile(log, copied.with_name("recording.db3-wal"))
                self.damage.append("The recording was not closed: its write-ahead log is read too.")
                return _connected(f"file:{quote(str(copied))}?mode=rw")
            self.damage.append(
                "The recording was not closed: its last messages are in a write-ahead log, and are "
                f"left out. 'sqlite3 {path.name} .recover' on a copy restores these messages."
            )
        # With immutable, sqlite creates no lock or journal beside the file.
        return _connected(f"file:{quote(str(path))}?mode=ro&immutable=1")

    def close(self) -> None:
        """Close the file."""
        self._base.close()
        if self._copy is not None:
            self._copy.cleanup()

    def _read_topics(self) -> None:
        names = self._columns("topics")
        if not ({"id", "name", "type"} <= names and self._columns("messages") >= _NAMES):
            raise InputError(f"'{self.path}' is a database, but not a recording of rosbag2.")
        columns = ["id", "name", "type"]
        for name, without in (
            ("serialization_format", "'cdr'"),
            ("offered_qos_profiles", "''"),
            ("type_description_hash", "''"),
        ):
            columns.append(name if name in names else without)
        definitions = self._definitions()
        asked = f"select {', '.join(columns)} from topics order by id"
        for number, *texts in self._base.execute(asked):
            if len(self.streams) >= MOST_STREAMS:
                self.damage.append(f"Only the first {MOST_STREAMS} topics are read.")
                break
            topic, kind, encoding, offers, kind_hash = map(str, texts)
            form, definition = definitions.get(kind, ("", ""))
            channel = Channel(
                topic,
                kind,
                encoding,
                form,
                definition.encode("utf-8", "surrogateescape"),
                (("offered_qos_profiles", offers), ("topic_type_hash", kind_hash)),
            )
            shown = channel.readable()
            if not isinstance(number, int):
                self._tell(f"Topic '{shown.topic}' is left out: its id is not a whole number.")
                continue
            self.channels[len(self.streams)] = channel
            self.topic_ids.append(number)
            self.streams.append(shown)

    def _columns(self, table: str) -> set[str]:
        """Return the column names of a table; empty for a view, whose rows may be endless."""
        asked = "select count(*) from sqlite_master where lower(name) = ? and type = 'table'"
        if self._base.execute(asked, (table,)).fetchone() != (1,):
            return set()
        return {row[1] for row in self._base.execute(f"pragma table_info({table})")}

    def _definitions(self) -> dict[str, tuple[str, str]]:
        """Return encoding and definition of each message type that the file describes."""
        found: dict[str, tuple[str, str]] = {}
        names = self._columns("message_definitions")
        if not names >= {"topic_type", _DEFINITION}:
            return found
        left = _MOST_DEFINED
        form = "encoding" if "encoding" in names else "'ros2msg'"
        asked = f"select topic_type, {form}, {_DEFINITION} from message_definitions"
        for row in self._base.execute(asked):
            kind, encoding, text = map(str, row)
            left -= len(text)
            if left < 0:
                self.damage.append("The definitions of types are too long: some are left out.")
                break
            if text:
                found[kind] = encoding, text
        return found

    def _span(self) -> tuple[int, int]:
        # Usually an index gives the result at once; if a timestamp is text, search all rows.
        for where in ("", " where typeof(timestamp) = 'integer'"):
            ends = (f"(select {end}(timestamp) from messages{where})" for end in ("min", "max"))
            low, high = self._base.execute(f"select {', '.join(ends)}").fetchone()
            if isinstance(low, int) and isinstance(high, int):
                return low, high
        return 0, 0

    @cached_property
    def counts(self) -> list[int]:
        """Return the number of messages of each stream."""
        found: dict[int, int] = {}
        try:
            found.update(
                self._base.execute("select topic_id, count(*) from messages group by topic_id")
            )
        except sqlite3.ProgrammingError as error:
            raise UsageError(
                "The recording is closed: read the recording inside the 'with' block that opened "
                "it."
            ) from error
        except _FAULTS as error:
            self._note(error)
        return [found.get(number, 0) for number in self.topic_ids]

    def blocks(self) -> "Iterator[Rows]":
        """Yield the messages in blocks, in the order of recording."""
        for batch in self.batches(list(self.channels)):
            if len(batch):
                # Copy, because the next batch reuses the memory. Times before 1970 become 0, as
                # other containers cannot store them.
                kept, moments = batch.buffer.copy(), np.maximum(batch.log_times, 0)
                yield Rows(replace(batch, buffer=kept, log_times=moments), self.unpacks)

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield the messages of some streams in batches; see `Container`."""
        if not wanted:
            return
        streams = {self.topic_ids[number]: number for number in wanted}
        # A compressed message needs more bytes than its beginning.
        data = "data" if head is None else f"substr(data, 1, {max(head, _LEAST_HEAD)})"
        asked = rows_query(streams, data)
        last, gap, gaps = LOWEST_ROW, 1, 0
        top = self._last_row() if progress is not None else 0
        if SCAN is not None and self._copy is None:
            for batch, last in read_pages(self.path, self._table(), streams):
                if len(batch):
                    yield batch
                if progress is not None:
                    progress(self.size * last // max(top, 1), self.size)
        while True:
            rows: list[Any] = []
            try:
                cursor = self._base.execute(asked, (last,))
                while rows := _some(cursor):
                    # A column may contain values of any type.
                    sound = [row for row in rows if type(row[0]) is type(row[-2]) is int]
                    if len(sound) < len(rows):
                        self._note("an id or a timestamp is not a whole number")
                    if not sound:
                        continue
                    yield batch_of_rows(sound, streams)
                    last, gap = sound[-1][0], 1
                    if progress is not None:
                        progress(self.size * last // max(top, 1), self.size)
                return
            except _FAULTS as error:
                # Pages after a damaged one may be readable: skip rows, more each time.
                self._note(error)
                gaps += 1
                if gaps > _MOST_GAPS:
                    return
                last, gap = min(max(last, 0) + gap, 2**63 - 1), gap * 2

    def _table(self) -> int:
        """Return the root page of the message table; 0 if the table has unusual columns."""
        try:
            told = self._base.execute("pragma table_info(messages)")
            columns = [(name, kind, key) for _, name, kind, _, _, key in told]
            asked = "select rootpage, sql from sqlite_master where name = 'messages'"
            ((root, text),) = self._base.execute(asked).fetchall()
        except (*_FAULTS, ValueError):
            return 0
        # In such tables the primary key is not the row id.
        other = any(words in str(text).lower() for words in ("without rowid", "desc"))
        return int(root) if columns == _COLUMNS and not other else 0

    def expected(self, wanted: Collection[int]) -> int:
        """Return the approximate number of messages, because counting takes as long as reading."""
        return self._last_row()

    def _last_row(self) -> int:
        try:
            (last,) = self._base.execute("select max(id) from messages").fetchone()
        except _FAULTS:
            return 0
        return last if isinstance(last, int) else 0

    def _note(self, reason: object) -> None:
        self._tell(f"A part of the messages cannot be read ({reason}).")

    def _tell(self, damage: str) -> None:
        if damage not in self.damage:
            self.damage.append(damage)


class Rows:
    """Block of consecutive rows of a database; see `Block`."""

    whole = False
    counts: Mapping[int, int] | None = None

    def __init__(self, batch: Batch, unpacks: bool) -> None:
        """Create a block; `unpacks` says whether compressed messages are decompressed."""
        self._batch = batch
        self._unpacks = unpacks
        self.start = int(batch.log_times.min())
        self.end = int(batch.log_times.max())

    def sound(self) -> bool:
        """Return True, because there are no checksums."""
        return True

    def table(self) -> MessageTable:
        """Return the messages of the rows."""
        batch, moments = self._batch, self._batch.log_times
        data, starts, lengths = batch.buffer, batch.starts, batch.lengths
        if self._unpacks:
            pieces = [batch.payload(number) for number in range(len(batch))]
            pieces = [
                unpack_beginning("zstd", one, LARGEST) if one.startswith(ZSTD_MAGIC) else one
                for one in pieces
            ]
            lengths = np.fromiter(map(len, pieces), dtype=np.int64, count=len(pieces))
            data, starts = np.frombuffer(b"".join(pieces), np.uint8), np.cumsum(lengths) - lengths
        none = np.zeros(len(batch), dtype=np.int64)
        channels = batch.senders.astype(np.int64)
        return MessageTable(data, channels, moments, moments, none, starts, lengths)


def _connected(uri: str) -> sqlite3.Connection:
    try:
        base = sqlite3.connect(uri, uri=True, check_same_thread=False)
    except _FAULTS as error:
        raise InputError(f"The database cannot be opened: {error}.") from error
    base.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, _LARGEST_VALUE)
    # Text columns may contain bytes that are not UTF-8.
    base.text_factory = lambda raw: raw.decode("utf-8", "surrogateescape")
    return base


def _some(cursor: sqlite3.Cursor) -> list[Any]:
    """Return the next rows of a query, up to a limit of bytes in the last column."""
    rows, held = [], 0
    for row in cursor:
        rows.append(row)
        held += len(row[-1]) if isinstance(row[-1], bytes) else 0
        if len(rows) >= _ROWS or held >= _MOST_BYTES:
            break
    return rows


def rows_query(streams: Mapping[int, int], data: str = "data", most: int = -1) -> str:
    """Return the SQL query for messages of some topics after a row id; see `batch_of_rows`.

    Args:
        streams: Number of the stream of each topic, by the topic's number in the file.
        data: Expression for the bytes of a message.
        most: Maximum number of rows; negative for all rows.
    """
    # With a single topic, its id is not queried, which saves time for every row.
    which = "" if len(streams) == 1 else "topic_id, "
    # The query contains only numbers, no text from the file.
    return (
        f"select id, {which}timestamp, {data} from messages where id > ? "
        f"and topic_id in ({','.join(map(str, streams))}) order by id limit {most}"
    )


def batch_of_rows(rows: list[Any], streams: Mapping[int, int]) -> Batch:
    """Return the messages in rows that the query of `rows_query` returned."""
    *owners, times, blobs = zip(*rows, strict=True)
    if set(map(type, blobs)) != {bytes}:
        blobs = tuple(bytes(blob) if isinstance(blob, bytes) else b"" for blob in blobs)
    lengths = np.fromiter(map(len, blobs), dtype=np.int64, count=len(rows))
    # With space before the first message, because `rows_of` begins before it.
    buffer = np.frombuffer(b"".join((_ROOM, *blobs)), dtype=np.uint8)
    starts = np.cumsum(lengths) - lengths + len(_ROOM)
    if len(streams) == 1:
        senders = np.full(len(rows), next(iter(streams.values())), dtype=np.int32)
    else:
        topics = map(streams.__getitem__, owners[1])
        senders = np.fromiter(topics, dtype=np.int32, count=len(rows))
    return Batch(buffer, starts, lengths, np.array(times, dtype=np.int64), senders)
