"""Interface of containers: streams of messages, in pieces of their bytes."""

import os
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final, Protocol

from tftool.base.errors import InputError
from tftool.base.stamps import Stamp
from tftool.recordings.columns import Batch
from tftool.recordings.contract import Progress
from tftool.recordings.decompression import LARGEST, Ahead, Packed, unpack, unpack_beginning

MOST_STREAMS: Final = 65_536
"""Streams of one recording; those beyond are left out, and that is told."""

TRANSIENT_LOCAL: Final = "transient_local"

LARGEST_TOLD: Final = 1 << 26
"""Bytes of the largest record that tells of a stream: of it copies are made."""

_MOST_NOTED = 20

_OFFER = re.compile(r"(durability|reliability):\s*([\w\"']+)")
_LONGEST_OFFERS = 100_000
_WORDS = {
    "durability": {"1": TRANSIENT_LOCAL, "2": "volatile"},
    "reliability": {"1": "reliable", "2": "best_effort"},
}


@dataclass(frozen=True, slots=True)
class Offers:
    """What publishers of a topic offered, as rosbag2 writes it beside a topic.

    Attributes:
        durability: "transient_local" if any offers it, "volatile", or empty if unknown.
        reliability: "reliable" if any offers it, "best_effort", or empty.
        count: How many offers were noted.
    """

    durability: str = ""
    reliability: str = ""
    count: int = 0


def check_told(count: int) -> None:
    """Refuse a record that tells of a stream and is too long for that.

    Raises:
        InputError: If it is.
    """
    if count > LARGEST_TOLD:
        raise InputError(
            f"a record that tells of a topic has {count} bytes, and may have {LARGEST_TOLD}"
        )


def offers_of(text: str) -> Offers:
    """Parse a text of QoS profiles: in numbers up to rosbag2's version 8, then in words."""
    found: dict[str, list[str]] = {"durability": [], "reliability": []}
    for policy, word in _OFFER.findall(text[:_LONGEST_OFFERS]):
        plain = word.strip("\"'")
        found[policy].append(_WORDS[policy].get(plain, plain))

    def best(policy: str, wanted: str, other: str) -> str:
        words = found[policy]
        return wanted if wanted in words else other if other in words else ""

    return Offers(
        best("durability", TRANSIENT_LOCAL, "volatile"),
        best("reliability", "reliable", "best_effort"),
        len(found["durability"]),
    )


@dataclass(frozen=True, slots=True)
class MessageStream:
    """One stream of messages: a channel, a row of `topics`, a connection.

    Attributes:
        topic: As recorded.
        type: As recorded.
        encoding: How its messages are written: "cdr", "ros1", "json", "protobuf".
        definition: The type's definition as text; empty where there is none.
        node: Who publishes; empty where that is not recorded.
        offers: What was offered to subscribers.
    """

    topic: str
    type: str
    encoding: str
    definition: str = ""
    node: str = ""
    offers: Offers = Offers()


class Container(Protocol):
    """One file of a recording, or several read as one.

    Attributes:
        kind: In words.
        size: Bytes.
        start: Log time of the first message; 0 where there is none.
        end: Of the last.
        streams: Its streams; their numbers in a batch are places in it.
    """

    kind: str
    size: int
    start: Stamp
    end: Stamp
    streams: list[MessageStream]

    @property
    def counts(self) -> list[int]:
        """How many messages each stream has."""

    def expected(self, wanted: Collection[int]) -> int:
        """About how many messages some streams have; 0 where that is not known."""

    @property
    def damage(self) -> list[str]:
        """Return its damage, as sentences; reading may add to them."""

    def batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """The messages of some streams, in the order of the recording.

        A batch's buffer holds until the next one is asked for: its memory is used again.

        Args:
            wanted: Numbers of streams.
            progress: Is told how far it has come.
            head: How many bytes of each message are needed, all if None; more may come.
        """

    def close(self) -> None:
        """Close the file."""


class PackedChunk(Protocol):
    """A chunk, as far as it matters for unpacking it.

    Attributes:
        place: Where its data begins in the file, packed.
        packed: Bytes of it there.
        size: Bytes of it unpacked.
        method: How it is packed.
        cut: Whether the file ends within it.
    """

    place: int
    packed: int
    size: int
    method: str
    cut: bool

    @property
    def position(self) -> int:
        """Where it is said to be."""


class File:
    """A file read at places, never beyond the end it had when it was opened.

    Attributes:
        path: Where it is.
        size: Bytes when it was opened; it may grow while it is read.
        read: Bytes read so far.
    """

    def __init__(self, path: Path) -> None:
        """Open it.

        Raises:
            OSError: If it cannot be.
        """
        self.path = path
        self._file = path.open("rb", buffering=0)
        self.size = os.fstat(self._file.fileno()).st_size
        self.read = 0

    def at(self, place: int, count: int) -> bytes:
        """Read `count` bytes from a place on.

        Raises:
            InputError: If the file does not have them, or they are too many to hold.
        """
        if count < 0 or place < 0 or place + count > self.size:
            raise InputError(
                f"{count} bytes at byte {place} lie beyond the file's end ({self.size})"
            )
        if count > LARGEST:
            raise InputError(
                f"{count} bytes at byte {place} are more than is read at once ({LARGEST})"
            )
        found = os.pread(self._file.fileno(), count, place)
        while len(found) < count:
            more = os.pread(self._file.fileno(), count - len(found), place + len(found))
            if not more:
                raise InputError(f"the file ends at byte {place + len(found)}: it was shortened")
            found += more
        self.read += count
        return found

    def into(self, place: int, room: memoryview) -> None:
        """The bytes from a place on, as many as there is room for, to be written there.

        Raises:
            InputError: If the file does not have them.
        """
        if hasattr(os, "preadv") and 0 <= place <= self.size - len(room):
            self.read += len(room)
            while room:
                found = os.preadv(self._file.fileno(), [room], place)
                if not found:
                    raise InputError(f"the file ends at byte {place}: it was shortened")
                room, place = room[found:], place + found
        else:
            room[:] = self.at(place, len(room))

    def fileno(self) -> int:
        """The number by which the operating system knows it."""
        return self._file.fileno()

    def up_to(self, place: int, count: int) -> bytes:
        """Read at most `count` bytes from a place on; fewer at the end of the file."""
        return self.at(place, max(0, min(count, self.size - place, LARGEST)))

    def close(self) -> None:
        """Close it."""
        self._file.close()


class ChunkedFile(File):
    """A file whose messages lie in chunks, and what turns out to be wrong with it.

    Attributes:
        damage: As sentences, each once; not more than tell enough.
    """

    def __init__(self, path: Path) -> None:
        """Open it; see `File`."""
        super().__init__(path)
        self.damage: list[str] = []
        self._damaged: set[PackedChunk] = set()

    def note(self, damage: str) -> None:
        """Note what is wrong."""
        if damage not in self.damage and len(self.damage) < _MOST_NOTED:
            self.damage.append(damage)

    def note_chunk(self, chunk: PackedChunk, reason: str) -> None:
        """Note what is wrong with a chunk, of each what is found first: the rest comes of it."""
        if chunk not in self._damaged:
            self._damaged.add(chunk)
            self.note(f"A chunk at byte {chunk.position} is damaged ({reason}).")

    def packed(self, chunk: PackedChunk) -> Packed | None:
        """What of a chunk is unpacked ahead; None of one that is read in another way."""
        if chunk.cut or chunk.method in ("", "none"):
            return None
        return chunk.method, partial(self.at, chunk.place, chunk.packed), chunk.size

    def unpacked(self, chunk: PackedChunk, ahead: Ahead | None = None) -> "bytes | memoryview":
        """A chunk's bytes, unpacked; as many as there are of one that is cut or damaged.

        Args:
            chunk: The chunk.
            ahead: Where it may be on its way.

        Raises:
            InputError: If not even its packed bytes can be read.
            UsageError: If what it takes is not installed.
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
            data = self.at(chunk.place, chunk.packed)
            self.note_chunk(chunk, str(error))
            return unpack_beginning(chunk.method, data, chunk.size)
