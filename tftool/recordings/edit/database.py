"""Editing of rosbag2's sqlite files: the file is copied, and changed rows are updated.

Unchanged rows keep their bytes, numbers and order. Other tables and the schema version do not
change. Edits that cut, join or split recordings, or add messages at the start, do not use this
module.
"""

import os
import sqlite3
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing
from pathlib import Path
from typing import Final
from urllib.parse import quote

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.container import MessageTable, Piece
from tftool.recordings.edit.outputs import digest_table
from tftool.recordings.rosbag2.read import LOWEST_ROW, Sqlite, batch_of_rows, rows_query
from tftool.recordings.rosbag2.write import translated

_ROWS: Final = 2048  # rows that are read and then written in one step

Change = Callable[[MessageTable, Mapping[int, Channel]], MessageTable]


class Unsound(Exception):
    """Exception for a damaged copy of a database; another reader must read the rows one by one."""


class EditedDatabase:
    """Copy of a `.db3` file in which only changed rows are updated.

    Attributes:
        path: Path of the written file.
        container: "db3".
        channels: Topics, by number.
        counts: Number of messages by topic, after the edit.
        start: Log time of the first message, after the edit.
        end: Log time of the last message, after the edit.
    """

    container = "db3"

    def __init__(self, path: Path, reader: Sqlite) -> None:
        """Copy the input file to `path`, and verify the copy.

        Raises:
            InputError: If the copy differs from the input file.
            OSError: If the file cannot be written.
        """
        self.path = path
        self.channels = reader.channels
        self.counts: Counter[int] = Counter()
        self.start: Stamp = 0
        self.end: Stamp = 0
        self._reader = reader
        self._wanted: dict[tuple[str, str], int] = {}
        self._touched: list[int] = []
        with reader.path.open("rb") as source, path.open("wb+") as out:
            whole = Piece(source.fileno(), 0, os.fstat(source.fileno()).st_size)
            whole.copy_to(out.fileno(), 0)
        self._base = sqlite3.connect(path, isolation_level=None)

    def change(self, change: Change, touched: list[int]) -> None:
        """Change the messages of some topics in one transaction.

        Args:
            change: Function that changes messages.
            touched: Numbers of the topics whose messages can change.

        Raises:
            InputError: If the file cannot be written.
            Unsound: If the database is damaged.
        """
        try:
            # No journal is needed: an incomplete file never gets its final name.
            self._touched = touched
            self._base.execute("pragma journal_mode = off").fetchall()
            self._base.execute("pragma synchronous = off")
            # Overwrite deleted data, so that it cannot be recovered from the file.
            self._base.execute("pragma secure_delete = on").fetchall()
            with translated(self.path):
                self._base.execute("begin")
                self._change(change, touched)
                self._base.execute("commit")
            if self._base.execute("pragma quick_check(1)").fetchone() != ("ok",):
                raise Unsound
            self._sum_up()
        except sqlite3.DatabaseError as error:
            raise Unsound from error
        except InputError as error:
            if _is_damage(error.__cause__):
                raise Unsound from error
            raise

    def _change(self, change: Change, touched: list[int]) -> None:
        changed: list[tuple[int, bytes, int]] = []
        dropped: list[tuple[int]] = []
        for ids, table in self._rows(self._base, touched):
            after = change(table, self.channels)
            digest_table(self._wanted, after, self.channels, self.container)
            # For each remaining message: its old index in the part, and its new index.
            left = dict(zip(after.sequences.tolist(), range(len(after)), strict=True))
            same = np.zeros(len(table), dtype=np.bool_)
            same[after.sequences] = after.starts == table.starts[after.sequences]
            for place in np.flatnonzero(~same).tolist():
                if place in left:
                    moment = int(table.log_times[place])
                    changed.append((moment, after.payload(left[place]), ids[place]))
                else:
                    dropped.append((ids[place],))
                if len(changed) + len(dropped) >= _ROWS:
                    self._put(changed, dropped)
        self._put(changed, dropped)

    def _put(self, changed: list[tuple[int, bytes, int]], dropped: list[tuple[int]]) -> None:
        self._base.executemany("update messages set timestamp = ?, data = ? where id = ?", changed)
        self._base.executemany("delete from messages where id = ?", dropped)
        changed.clear()
        dropped.clear()

    def _rows(
        self, base: sqlite3.Connection, numbers: list[int]
    ) -> Iterator[tuple[list[int], MessageTable]]:
        """Yield row numbers in the database, with a table of the messages in these rows.

        Args:
            base: Connection to the database.
            numbers: Numbers of the topics.

        Raises:
            Unsound: If a timestamp is not a whole number.
        """
        streams = {self._reader.topic_ids[number]: number for number in numbers}
        asked = rows_query(streams, most=_ROWS)
        last = LOWEST_ROW
        # Read each part completely, so that no row changes while a query is open.
        while streams and (rows := base.execute(asked, (last,)).fetchall()):
            if any(type(row[-2]) is not int for row in rows):
                raise Unsound
            batch = batch_of_rows(rows, streams)
            yield (
                [row[0] for row in rows],
                MessageTable(
                    batch.buffer,
                    batch.senders.astype(np.int64),
                    batch.log_times,
                    batch.log_times,
                    np.arange(len(rows)),
                    batch.starts,
                    batch.lengths,
                ),
            )
            last = rows[-1][0]

    def _sum_up(self) -> None:
        numbers = {topic: number for number, topic in enumerate(self._reader.topic_ids)}
        asked = "select topic_id, count(*), min(timestamp), max(timestamp) from messages "
        found = self._base.execute(asked + "group by topic_id").fetchall()
        self.counts = Counter(
            {numbers[topic]: count for topic, count, _, _ in found if topic in numbers}
        )
        self.start = min((low for _, _, low, _ in found), default=0)
        self.end = max((high for _, _, _, high in found), default=0)

    def compare(self) -> None:
        """Read the changed rows back from the file, and compare them with the rows to write.

        Raises:
            InputError: If a row differs from the intended row.
        """
        found: dict[tuple[str, str], int] = {}
        address = f"file:{quote(str(self.path))}?mode=ro&immutable=1"
        with translated(self.path), closing(sqlite3.connect(address, uri=True)) as base:
            for _, table in self._rows(base, self._touched):
                digest_table(found, table, self.channels, self.container)
        if found != self._wanted:
            raise InputError(
                f"'{self.path}' was not written correctly: some rows have the wrong content."
            )

    def finish(self) -> None:
        """Close the database; all changes are already written."""
        self._base.close()

    def abandon(self) -> None:
        """Close the database without completing the edit."""
        self._base.close()


def _is_damage(error: BaseException | None) -> bool:
    """Whether an sqlite error means that the file is damaged, rather than a problem of the disk."""
    return isinstance(error, sqlite3.DatabaseError) and error.sqlite_errorcode in (
        sqlite3.SQLITE_CORRUPT,
        sqlite3.SQLITE_NOTADB,
        sqlite3.SQLITE_ERROR,
    )
