"""Bulk changes of the transforms in the messages of one chunk.

A publisher sends the same frames again and again. Messages with the same frames are of one *kind*.
One message of each kind is changed as an example. All other messages of the kind get the new bytes
of this example, with their own stamps and numbers.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from tftool.base.errors import TftoolError
from tftool.base.stamps import NANOSECONDS
from tftool.messages.layouts import CDR, Layout
from tftool.messages.transform_rows import Bytes, Place, Template, row_span, rows_of, walk
from tftool.recordings.container import MessageTable
from tftool.recordings.contract import Stamps

_MOST_KINDS = 16
"""Maximum number of kinds with one length; messages of further kinds are changed one by one."""


@dataclass(frozen=True, slots=True)
class Result:
    """Result of the edit for the example message of one kind (messages with the same frames).

    Attributes:
        payload: New bytes of the message; None if the message is dropped.
        layout: Byte layout of `payload`.
        kept: Indices of the transforms that remain in the message.
        given: Indices of the kept transforms whose poses an option sets.
    """

    payload: bytes | None
    layout: Layout
    kept: Sequence[int] = ()
    given: frozenset[int] = frozenset()


@dataclass(slots=True)
class MessageKind:
    """Group of messages that have the same frames, and differ only in stamps and numbers.

    Attributes:
        places: Byte offsets of the transforms.
        counts: Number of changes that the edit makes in each message, by name of the change.
    """

    places: tuple[Place, ...]
    template: Template
    begin: int
    result: Result
    copies: list[tuple[int, int, int]] = field(default_factory=list)
    counts: "Counter[str]" = field(default_factory=Counter)
    keeps_bytes: bool = False

    @property
    def changes(self) -> bool:
        """Whether the edit changes the bytes of messages of this kind."""
        return not self.keeps_bytes or bool(self.result.given)

    def stamps(self, rows: Bytes, number: int) -> Stamps:
        """Return the stamps of transform `number` in all messages, nanoseconds, shape (n,)."""
        first = self.places[number].stamp - self.begin
        times = np.ascontiguousarray(rows[:, first : first + 8]).view(np.int32)
        found: Stamps = times[:, 0].astype(np.int64) * NANOSECONDS
        return found + np.ascontiguousarray(times[:, 1]).view(np.uint32)

    def changed(self, rows: Bytes, length: int) -> Bytes:
        """Return the new bytes of messages of this kind, shape (n, new length)."""
        payload = self.result.payload
        assert payload is not None
        new = np.frombuffer(payload, np.uint8)
        if self.keeps_bytes:
            found = rows[:, -self.begin : length - self.begin].copy()
            for number in self.result.given:
                place = self.places[number].numbers
                found[:, place : place + 56] = new[place : place + 56]
            return found
        found = np.tile(new, (len(rows), 1))
        for source, target, size in self.copies:
            first = source - self.begin
            found[:, target : target + size] = rows[:, first : first + size]
        return found


class Kinds:
    """Kinds of messages in one channel; messages of one kind have the same frames."""

    def __init__(
        self, layout: Layout, learn: "Callable[[bytes], tuple[Result, Counter[str]]]"
    ) -> None:
        """Create an empty collection of kinds.

        Args:
            layout: Byte layout of the channel's messages.
            learn: Function that changes a message; returns the result, and counts of changes.
        """
        self._layout = layout
        self._learn = learn
        self._known: dict[int, list[MessageKind]] = {}

    def groups(
        self, table: MessageTable, indices: Stamps
    ) -> "tuple[list[tuple[MessageKind, Stamps, Bytes]], Stamps]":
        """Group messages by kind, that is, by the frames in them.

        Args:
            table: The messages.
            indices: Indices of the channel's messages.

        Returns:
            First, a list of kinds, each with the indices and the bytes (one row per message) of its
            messages. Second, the indices of all other messages, which must be changed one by one.
        """
        found, rest = [], []
        for length in np.unique(table.lengths[indices]).tolist():
            left = indices[table.lengths[indices] == length]
            begin, width = row_span(self._layout, length)
            if int(table.starts[left].min()) + begin < 0 or width < 8:
                rest.append(left)
                continue
            known = self._known.setdefault(length, [])
            number = 0
            while len(left):
                if number == len(known) and not self._add(known, table.payload(int(left[0]))):
                    rest.append(left)
                    break
                kind = known[number]
                words = rows_of(table.data, table.starts[left] + begin, width)
                fits = kind.template.fits(words)
                chosen = slice(None) if fits is None else fits
                if len(left[chosen]):
                    rows = words[chosen].view(np.uint8).reshape(-1, width)
                    found.append((kind, left[chosen], rows))
                left = left[:0] if fits is None else left[~fits]
                number += 1
        return found, np.concatenate(rest) if rest else indices[:0]

    def _add(self, known: list[MessageKind], payload: bytes) -> bool:
        """Add the kind of `payload` to `known`; return False if it cannot be changed in bulk."""
        if len(known) >= _MOST_KINDS:
            return False
        try:
            walked = walk(self._layout, payload)
            if walked.order != "<" or not walked.places:
                return False
            begin, width = row_span(self._layout, len(payload))
            ends = max(place.numbers + 56 for place in walked.places)
            if ends > begin + width:
                return False
            result, counts = self._learn(payload)
            kind = MessageKind(
                walked.places, Template(self._layout, payload, walked), begin, result, [], counts
            )
            if result.payload is not None:
                target = walk(result.layout, result.payload)
                names = [(one.parent, one.child) for one in walked.places]
                kind.keeps_bytes = (
                    result.layout is self._layout
                    and len(result.payload) == len(payload)
                    and [(one.parent, one.child) for one in target.places] == names
                )
                # In ROS 1, the header's sequence number is before the stamp.
                lead = 0 if CDR in (self._layout, result.layout) else 4
                for number, place in zip(result.kept, target.places, strict=True):
                    old = walked.places[number]
                    kind.copies.append((old.stamp - lead, place.stamp - lead, 8 + lead))
                    if number not in result.given:
                        kind.copies.append((old.numbers, place.numbers, 56))
        except TftoolError:
            return False
        known.append(kind)
        return True


class TableChange:
    """Table of messages while an edit changes or drops some of them."""

    def __init__(self, table: MessageTable) -> None:
        """Start with all messages of a table unchanged."""
        self.table = table
        self.keep: npt.NDArray[np.bool_] = np.ones(len(table), dtype=np.bool_)
        self._starts, self._lengths = table.starts.copy(), table.lengths.copy()
        self._pieces: list[Bytes] = [table.data]
        self._end = len(table.data)

    def put(self, indices: Stamps, payloads: Bytes) -> None:
        """Replace the bytes of some messages; `payloads` has the shape (n, length)."""
        length = payloads.shape[1]
        self._starts[indices] = self._end + np.arange(len(indices)) * length
        self._lengths[indices] = length
        self._pieces.append(payloads.ravel())
        self._end += payloads.size

    def put_one(self, number: int, payload: bytes) -> None:
        """Replace the bytes of one message, by its index."""
        self.put(np.array([number]), np.frombuffer(payload, np.uint8).reshape(1, -1))

    def finished(self) -> MessageTable:
        """Return the table after the changes; the same table if nothing changed."""
        if len(self._pieces) == 1 and self.keep.all():
            return self.table
        after = replace(
            self.table,
            data=np.concatenate(self._pieces),
            starts=self._starts,
            lengths=self._lengths,
        )
        return after if self.keep.all() else after.chosen(np.flatnonzero(self.keep))
