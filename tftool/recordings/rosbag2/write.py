"""Writers of rosbag2's sqlite files, in schema version 4, and of folders with metadata.yaml."""

import sqlite3
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel, ContainerWriter
from tftool.recordings.rosbag2.format import FileFacts, metadata_text, write_metadata

_ROWS: Final = 2048  # rows inserted in one step
_SCHEMA: Final = """
create table schema(schema_version integer primary key, ros_distro text not null);
create table metadata(id integer primary key, metadata_version integer not null,
  metadata text not null);
create table topics(id integer primary key, name text not null, type text not null,
  serialization_format text not null, offered_qos_profiles text not null,
  type_description_hash text not null);
create table message_definitions(id integer primary key, topic_type text not null,
  encoding text not null, encoded_message_definition text not null,
  type_description_hash text not null);
create table messages(id integer primary key, topic_id integer not null,
  timestamp integer not null, data blob not null);
insert into schema values (4, '');
"""


class SqliteWriter:
    """Writer of a `.db3` file, whose channels are topics; see `ContainerWriter`.

    Attributes:
        counts: Number of messages by topic.
    """

    @classmethod
    def in_style(cls, path: Path, style: Mapping[str, Any], *, profile: str) -> "SqliteWriter":
        """Create an output file of an edit; see `ContainerFormat.create_like`."""
        del style, profile
        return cls(path)

    def __init__(self, path: Path, *, compression: str | None = None) -> None:
        """Create the file; replace an existing file.

        Args:
            path: Path of the file.
            compression: "none" or None, because the file has no compression.

        Raises:
            UsageError: If another compression is given.
            OSError: If the file cannot be written.
        """
        if compression not in (None, "none"):
            raise UsageError(f"rosbag2's sqlite files are not compressed with {compression}.")
        path.unlink(missing_ok=True)
        self._path = path
        self._rows: list[tuple[int, int, bytes]] = []
        self._bytes = 0
        self._topics: dict[tuple[str, str], int] = {}
        self._types: set[str] = set()
        self.counts: dict[int, int] = {}
        path.open("xb").close()
        # No journal is needed: an incomplete file never gets its final name.
        self._base = sqlite3.connect(path, isolation_level=None)
        with translated(path):
            self._base.execute("pragma journal_mode = off")
            self._base.execute("pragma synchronous = off")
            self._base.execute("begin")
            for statement in _SCHEMA.strip().split(";\n"):
                self._base.execute(statement.removesuffix(";"))

    @property
    def size(self) -> int:
        """Size of all messages so far, bytes."""
        return self._bytes

    def channel(self, channel: Channel, number: int | None = None) -> int:
        """Register a topic, and return the number that identifies the topic in `write`."""
        key = channel.topic, channel.type
        known = self._topics.get(key)
        offers = channel.extra("offered_qos_profiles")
        if known is not None:
            with translated(self._path):
                self._base.execute(
                    "update topics set offered_qos_profiles = offered_qos_profiles || ? "
                    "where id = ? and instr(offered_qos_profiles, ?) = 0",
                    (offers, known, offers),
                )
            return known
        number = self._topics[key] = len(self._topics) + 1
        kind_hash = channel.extra("topic_type_hash")
        with translated(self._path):
            self._base.execute(
                # In a damaged recording text may be any bytes, which are copied unchanged.
                f"insert into topics values (?{', cast(? as text)' * 5})",
                (
                    number,
                    *(
                        text.encode("utf-8", "surrogateescape")
                        for text in (
                            channel.topic,
                            channel.type,
                            channel.encoding,
                            offers,
                            kind_hash,
                        )
                    ),
                ),
            )
            if channel.definition and channel.type not in self._types:
                self._types.add(channel.type)
                text = channel.definition.decode("utf-8", "backslashreplace")
                self._base.execute(
                    "insert into message_definitions"
                    "(topic_type, encoding, encoded_message_definition, type_description_hash)"
                    " values (?, ?, ?, ?)",
                    (channel.type, channel.schema_encoding or "ros2msg", text, kind_hash),
                )
        return number

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append one message; `publish_time` and `sequence` are not stored."""
        self._rows.append((channel, log_time, payload))
        self._bytes += len(payload)
        self.counts[channel] = self.counts.get(channel, 0) + 1
        if len(self._rows) >= _ROWS:
            self.flush()

    def flush(self) -> None:
        """Insert the buffered messages into the database."""
        rows, self._rows = self._rows, []
        with translated(self._path):
            self._base.executemany(
                "insert into messages(topic_id, timestamp, data) values (?, ?, ?)", rows
            )

    def finish(self) -> None:
        """Write buffered messages and the index, and close the file."""
        try:
            self.flush()
            with translated(self._path):
                self._base.execute("create index timestamp_idx on messages (timestamp asc)")
                self._base.execute("commit")
        finally:
            self._base.close()

    def abandon(self) -> None:
        """Close the file without completing it."""
        self._base.close()


class translated:  # noqa: N801 -- used as a function in a `with`
    """Context manager that converts sqlite's exceptions to errors that name the written file."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if isinstance(error, sqlite3.Error):
            what = "the disk is full" if "full" in str(error) else str(error)
            raise InputError(f"'{self._path}' cannot be written: {what}.") from error


class FolderWriter:
    """Writer of a rosbag2 folder with one file and its metadata; see `ContainerWriter`."""

    def __init__(self, folder: Path, file: Path, storage: str, inner: ContainerWriter) -> None:
        """Create the writer of a folder from the writer of its only file.

        Args:
            folder: Path of the folder.
            file: Name of the file in the folder.
            storage: "mcap" or "sqlite3".
            inner: Writer of the file.
        """
        self._folder = folder
        self._file = file
        self._storage = storage
        self._inner = inner
        self._channels: dict[int, Channel] = {}
        self._counts: Counter[int] = Counter()
        self._low: Stamp = 2**63 - 1
        self._high: Stamp = 0

    @property
    def size(self) -> int:
        """Number of bytes written so far, including buffered bytes."""
        return self._inner.size

    def channel(self, channel: Channel) -> int:
        """Register a channel, and return the number that identifies the channel in `write`."""
        number = self._inner.channel(channel)
        self._channels.setdefault(number, channel)
        return number

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append a message to a channel."""
        self._inner.write(channel, log_time, payload, publish_time, sequence)
        self._counts[channel] += 1
        self._low, self._high = min(self._low, log_time), max(self._high, log_time)

    def finish(self) -> None:
        """Complete the file, and write the metadata."""
        self._inner.finish()
        count = sum(self._counts.values())
        facts = FileFacts(self._file.name, self._low if count else 0, self._high, count)
        topics = {channel: self._counts[number] for number, channel in self._channels.items()}
        write_metadata(self._folder, metadata_text(self._storage, [facts], topics))

    def abandon(self) -> None:
        """Close the incomplete file, and write no metadata."""
        self._inner.abandon()
