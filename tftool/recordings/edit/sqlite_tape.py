"""A rosbag2 sqlite file, in pieces of many rows."""

import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

import numpy as np

from tftool.base.errors import InputError
from tftool.recordings.channel import Channel
from tftool.recordings.columns import Batch
from tftool.recordings.decompression import LARGEST, unpack_beginning
from tftool.recordings.edit.tape import Extras, Taken
from tftool.recordings.find import ZSTD_MAGIC
from tftool.recordings.rosbag2.read import Sqlite

_SMALLEST: Final = len(ZSTD_MAGIC)


class SqliteTape:
    """A `.db3` file; see `Tape`. Messages that rosbag2 compressed each by itself are unpacked.

    Attributes:
        path: Where it is.
        topic_ids: The numbers its own rows have for its channels.
    """

    container = "db3"

    def __init__(self, path: Path, *, unpacks: bool = False) -> None:
        """Open it.

        Args:
            path: Where it is.
            unpacks: Whether its messages are compressed, each by itself.

        Raises:
            InputError: If it cannot be read as a recording.
            OSError: If it cannot be opened.
        """
        self.path = path
        self._base = Sqlite(path)
        self.topic_ids = self._base.topic_ids
        self._unpacks = unpacks
        self.size = self._base.size
        self.extras = Extras()
        self.style: dict[str, Any] = {}
        told = _told(path)
        self.channels: dict[int, Channel] = {}
        for number, stream in enumerate(self._base.streams):
            offers, kind_hash, form = told.get(stream.topic, ("", "", "ros2msg"))
            metadata = (("offered_qos_profiles", offers), ("topic_type_hash", kind_hash))
            self.channels[number] = Channel(
                stream.topic,
                stream.type,
                stream.encoding,
                form if stream.definition else "",
                stream.definition.encode("utf-8", "surrogateescape"),
                metadata,
            )

    @property
    def damage(self) -> list[str]:
        """What is wrong with it, as sentences."""
        return self._base.damage

    def close(self) -> None:
        """Close the file."""
        self._base.close()

    def blocks(self) -> "Iterator[_Rows]":
        """Its rows, in the order they were recorded."""
        for batch in self._base.batches(list(self.channels)):
            if len(batch):
                # Kept while further ones are read, into the same memory.
                # No other container has moments before 1970.
                yield _Rows(
                    replace(
                        batch,
                        buffer=batch.buffer.copy(),
                        log_times=np.maximum(batch.log_times, 0),
                    ),
                    self._unpacks,
                )


class _Rows:
    """Some rows; see `Block`."""

    whole = False

    def __init__(self, batch: Batch, unpacks: bool) -> None:
        self._batch = batch
        self._unpacks = unpacks
        self.start = int(batch.log_times.min())
        self.end = int(batch.log_times.max())
        self.channels: Mapping[int, int] | None = None

    def sound(self) -> bool:
        """Whether it is; there is no proof of that."""
        return True

    def messages(self) -> list[Taken]:
        """Its messages."""
        batch = self._batch
        found = []
        for number in range(len(batch)):
            payload = batch.payload(number)
            if self._unpacks and payload[:_SMALLEST] == ZSTD_MAGIC:
                payload = unpack_beginning("zstd", payload, LARGEST)
            log_time = int(batch.log_times[number])
            found.append(Taken(int(batch.senders[number]), log_time, payload, log_time, 0))
        return found


def _told(path: Path) -> dict[str, tuple[str, str, str]]:
    """Offers, hash of the type and form of the definition of each topic, as they are recorded."""
    found: dict[str, tuple[str, str, str]] = {}
    # What cannot be read here has been told by the reader.
    with suppress(sqlite3.Error, InputError):
        base = sqlite3.connect(f"file:{quote(str(path))}?mode=ro&immutable=1", uri=True)
        base.text_factory = lambda raw: raw.decode("utf-8", "surrogateescape")
        try:
            columns = {row[1] for row in base.execute("pragma table_info(topics)")}
            offers = "offered_qos_profiles" if "offered_qos_profiles" in columns else "''"
            kind = "type_description_hash" if "type_description_hash" in columns else "''"
            forms: dict[str, str] = {}
            asked = "select type from sqlite_master where lower(name) = 'message_definitions'"
            # Of a view there may be no end.
            if base.execute(asked).fetchone() == ("table",):
                with suppress(sqlite3.Error):
                    asked = "select topic_type, encoding from message_definitions"
                    forms = dict(base.execute(asked))
            for topic, name, text, kind_hash in base.execute(
                f"select name, type, {offers}, {kind} from topics"
            ):
                found[topic] = (str(text), str(kind_hash), forms.get(name, "ros2msg"))
        finally:
            base.close()
    return found
