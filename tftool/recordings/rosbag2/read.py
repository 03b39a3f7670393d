"""Reader of rosbag2's sqlite files, which writes no other file beside them."""

import shutil
import sqlite3
import tempfile
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

import numpy as np

from tftool.base.errors import InputError, UsageError
from tftool.messages.native_scan import SCAN
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.container import MOST_STREAMS, Extras, MessageTable
from tftool.recordings.containers import ZSTD_MAGIC
from tftool.recordings.contract import Progress
from tftool.recordings.decompression import LARGEST, unpack_beginning
from tftool.recordings.rosbag2.format import read_pages

_ROWS: Final = 2048  # rows fetched in one step
_ROOM: Final = bytes(8)
_MOST_BYTES: Final = 1 << 26  # bytes of these rows; the last row may exceed it
_MOST_COPIED: Final = 1 << 30
_LARGEST_VALUE: Final = 1 << 28  # bytes of one value
_MOST_DEFINED: Final = 1 << 26  # characters of all definitions
_MOST_GAPS: Final = 40
_LEAST_HEAD: Final = 4096

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
        unpacks: Whether `blocks` decompresses messages that rosbag2 compressed one by one.
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
                "The recording was not closed, and its end, in a write-ahead log, is left out: "
                f"'sqlite3 {path.name} .recover' on a copy brings it in."
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
                self._tell(f"Topic '{shown.topic}' is left out: its id is no whole number.")
                continue
            self.channels[len(self.streams)] = channel
            self.topic_ids.append(number)
            self.streams.append(shown)

    def _columns(self, table: str) -> set[str]:
        """Return the names of a table's columns; empty for a view, which may be endless."""
        asked = "select count(*) from sqlite_master where lower(name) = ? and type = 'table'"
        if self._base.execute(asked, (table,)).fetchone() != (1,):
            return set()
        return {row[1] for row in self._base.execute(f"pragma table_info({table})")}

    def _definitions(self) -> dict[str, tuple[str, str]]:
        """Return the encoding and the definition of each type, if recorded."""
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
                self.damage.append("The definitions of its types are too long: some are left out.")
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
                "The recording is closed: read it while it is open, inside its with block."
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
        # The query contains only numbers, no text from the file.
        topics = ",".join(map(str, streams))
        # A compressed message needs more bytes than its beginning.
        data = "data" if head is None else f"substr(data, 1, {max(head, _LEAST_HEAD)})"
        # With a single topic, its id is not queried, which saves time for every row.
        which = "" if len(streams) == 1 else "topic_id, "
        asked = (
            f"select id, {which}timestamp, {data} from messages "
            f"where id > ? and topic_id in ({topics}) order by id"
        )
        last, gap, gaps = -(2**63), 1, 0
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
                        self._note("an id or a timestamp is no whole number")
                    if not sound:
                        continue
                    yield _batch(sound, streams)
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
        """Return the root page of the message table; 0 if the table has another form."""
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
        self._tell(f"A part of its messages cannot be read ({reason}).")

    def _tell(self, damage: str) -> None:
        if damage not in self.damage:
            self.damage.append(damage)


class Rows:
    """Block of consecutive rows of a database; see `Block`."""

    whole = False
    counts: Mapping[int, int] | None = None

    def __init__(self, batch: Batch, unpacks: bool) -> None:
        """Wrap a batch; `unpacks` tells whether its messages are compressed one by one."""
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
    """Return the next rows of a query, limited by memory; the data is the last column."""
    rows, held = [], 0
    for row in cursor:
        rows.append(row)
        held += len(row[-1]) if isinstance(row[-1], bytes) else 0
        if len(rows) >= _ROWS or held >= _MOST_BYTES:
            break
    return rows


def _batch(rows: list[Any], streams: dict[int, int]) -> Batch:
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
