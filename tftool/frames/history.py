"""One link over time: samples come in, in any order, and are forgotten when they are old."""

import struct
from array import array
from math import inf
from typing import Any, Final

from tftool.frames.links import (
    KNOWN,
    NO_PARENT,
    ODD,
    RECORD,
    RESHAPED,
    STORED,
    TOO_OLD,
    WORDS,
    Sample,
)
from tftool.frames.window import Window
from tftool.geometry import quaternions
from tftool.stamps import Duration, Stamp

_pack: Final = struct.Struct("q7d").pack

# Forgotten samples, and room in front for ones that arrive backwards, take at most
# one part in sixteen, like the room that `array` keeps behind its end.
_SLACK: Final = 4
_LEAST_SLACK: Final = 32

# A quaternion whose square lies between these is of length one but for rounding.
_SHORTEST: Final = 1.0 - 8e-16
_LONGEST: Final = 1.0 + 8e-16


class History(Window):
    """A link that moves: its samples of the last `limit` nanoseconds, as tf2 keeps them.

    Forgetting is lazy: only an insert forgets, and before it adds. Among equal stamps
    the last one inserted is the newest.
    """

    __slots__ = ("_due", "_full", "_limit", "_run")

    def __init__(self, limit: Duration) -> None:
        super().__init__()
        self._limit = limit
        # So many forgotten samples are too many to leave where they are.
        self._full = _LEAST_SLACK
        # A newest stamp beyond this means that the oldest sample is to be forgotten.
        self._due: Stamp = 0
        # Where the newest samples that share a parent begin; of use while mixed.
        self._run = 0

    def insert(self, stamp: Stamp, parent: int, sample: Any, sound: bool = False) -> int:
        """Forget what is too old by now, then remember a sample.

        Args:
            stamp: Nanoseconds.
            parent: Number of the parent.
            sample: Seven floats just as they came, the quaternion not always of length one
                or of tf2's sign.
            sound: Whether all that is settled already.

        Returns:
            TOO_OLD if it lies further back than the limit, KNOWN if that very sample is
            there, RESHAPED if it changes who the newest parent is or makes the parents
            mixed, else STORED. ODD, and nothing was done, if the stamp is no `int`, or a
            number is none.

        Raises:
            struct.error: If the stamp does not fit 64 bits; nothing was done.
        """
        # A `Sample`, which compiled code takes apart here alone: it is kept as it came.
        numbers: Sample = sample
        x, y, z, qx, qy, qz, qw = numbers
        if not sound:
            # NaN is not below anything; nor is a place so far off that it cannot be told from it.
            if not (
                isinstance(stamp, int)
                and _SHORTEST < qx * qx + qy * qy + qz * qz + qw * qw < _LONGEST
                and x + y + z < inf
            ):
                return self._insert_odd(stamp, parent, sample)
            if qw < -0.5 or (qw <= 0.5 and quaternions.leading(qx, qy, qz, qw) < 0.0):
                qx *= -1.0
                qy *= -1.0
                qz *= -1.0
                qw *= -1.0
                sample = (x, y, z, qx, qy, qz, qw)
        newest = self.newest_stamp
        record = _pack(stamp, x, y, z, qx, qy, qz, qw)
        if stamp <= newest:
            return self._insert_late(stamp, parent, sample, record)
        records = self.records
        if newest > self._due:
            # As a rule every sample that comes lets one go.
            start = self.start + 1
            oldest = records[WORDS * start]
            due = oldest + self._limit
            if newest > due or self.mixed or start >= self._full:
                self._forget(newest - self._limit)
            else:
                self.start = start
                self.oldest_stamp = oldest
                self._due = due
        records.frombytes(record)
        self.previous_stamp = newest
        self.previous = self.newest
        self.newest_stamp = stamp
        self.newest = sample
        if parent == self.parent and not self.mixed:
            return STORED
        return self._append_parent(parent)

    def _insert_odd(self, stamp: Any, parent: int, sample: Any) -> int:
        """Insert a sample whose quaternion is to be scaled, if nothing else is odd about it."""
        x, y, z, qx, qy, qz, qw = sample
        turn = quaternions.canonical(quaternions.unit((qx, qy, qz, qw)))
        if stamp.__class__ is not int or x + y + z != x + y + z or turn[3] != turn[3]:
            return ODD
        return self.insert(stamp, parent, (x, y, z, *turn), True)

    def clear(self) -> None:
        """Forget everything; afterwards any stamp is taken again."""
        self.records = array("q")
        self._parents = None
        self.start = self._run = 0
        self._full = _LEAST_SLACK
        self.newest_stamp = self.oldest_stamp = self.previous_stamp = self._due = 0
        self.newest = self.previous = None
        self.parent = NO_PARENT
        self.mixed = False

    @property
    def limit(self) -> Duration:
        """How far it remembers back from its newest sample."""
        return self._limit

    def extend(self, records: "array[int]", oldest_kept: Stamp) -> None:
        """Append records, each newer than the one before, and forget those before a stamp.

        They have the parent that all samples have; one there is already, and they reach
        beyond what is forgotten.
        """
        if self.newest_stamp < oldest_kept:
            self.replace(records, array("i", [self.parent]) * (len(records) // WORDS))
            return
        self.records.extend(records)
        self._note_newest()
        if self.oldest_stamp < oldest_kept:
            self._forget(oldest_kept)

    def replace(self, records: "array[int]", parents: "array[int]") -> None:
        """Remember these instead: not none, oldest first, of equal stamps the newest last."""
        self.records = records
        self._full = max(_LEAST_SLACK, len(parents) >> _SLACK)
        self._begin(0)
        self._note_newest()
        self.parent = parents[-1]
        self.mixed = parents.count(self.parent) != len(parents)
        self._parents = parents if self.mixed else None
        self._run = 0
        if self.mixed:
            run = len(parents) - 1
            while parents[run - 1] == self.parent:
                run -= 1
            self._run = run

    def _note_newest(self) -> None:
        """Keep the last two samples at hand."""
        last = self._count() - 1
        self.newest_stamp, self.newest = self._stamp(last), self._sample(last)
        self.previous_stamp, self.previous = 0, None
        if last > self.start:
            self.previous_stamp, self.previous = self._stamp(last - 1), self._sample(last - 1)

    def _forget(self, oldest_kept: Stamp) -> None:
        """Let go of samples before that stamp; the newest is not one of them."""
        start = self.start + 1
        if self._stamp(start) < oldest_kept:
            # Where equal stamps are the oldest, all of them stay.
            start = self._later(oldest_kept - 1)
        if self.mixed and start >= self._run:
            self._parents = None
            self.mixed = False
        if start >= self._full:
            del self.records[: WORDS * start]
            if self._parents is not None:
                del self._parents[:start]
            self._run -= start
            start = 0
            self._full = max(_LEAST_SLACK, self._count() >> _SLACK)
        self._begin(start)

    def _begin(self, start: int) -> None:
        """Have the window begin at a record."""
        self.start = start
        self.oldest_stamp = oldest = self._stamp(start)
        self._due = oldest + self._limit

    def _append_parent(self, parent: int) -> int:
        """Note the parent of the sample just appended."""
        count = self._count()
        parents = self._parents
        if self.parent == NO_PARENT:
            self.parent = parent
            self._begin(0)
            return RESHAPED
        if parents is None:
            parents = self._mix(count - 1)
        parents.append(parent)
        if parent == self.parent:
            return STORED
        self.parent = parent
        self._run = count - 1
        return RESHAPED

    def _mix(self, count: int) -> "array[int]":
        """Begin to note a parent for each of the first `count` samples."""
        parents = self._parents = array("i", [self.parent]) * count
        self.mixed = True
        self._run = self.start
        return parents

    def _insert_late(self, stamp: Stamp, parent: int, sample: Any, record: bytes) -> int:
        """Insert the first sample, or one that is not newer than all others."""
        records = self.records
        newest = self.newest_stamp
        if self.newest is None:
            records.frombytes(record)
            self._begin(0)
            self.newest_stamp = stamp
            self.newest = sample
            self.parent = parent
            return RESHAPED
        if newest > self._due:
            self._forget(newest - self._limit)
        if stamp < newest - self._limit:
            return TOO_OLD
        place = self._later(stamp)
        behind = place - 1
        while behind >= self.start and records[WORDS * behind] == stamp:
            if self._sample(behind) == sample and self._parent(behind) == parent:
                return KNOWN
            behind -= 1

        was_mixed = self.mixed
        if parent != self.parent and not was_mixed:
            self._mix(self._count())
        if place == self.start:
            place = self._make_room_in_front()
            records[WORDS * place : WORDS * (place + 1)] = array("q", record)
            if self._parents is not None:
                self._parents[place] = parent
            self._begin(place)
        else:
            records[WORDS * place : WORDS * place] = array("q", record)
            if self._parents is not None:
                self._parents.insert(place, parent)
            if place < self._run:
                self._run += 1
        last = len(records) // WORDS - 1
        if place >= last - 1:
            self.previous_stamp = self._stamp(last - 1)
            self.previous = sample if place == last - 1 else self._sample(last - 1)
        if place == last:
            # Equal to the newest stamp: the one that came last is in front.
            self.newest = sample
            if parent != self.parent:
                self.parent = parent
                self._run = place
                return RESHAPED
        elif parent != self.parent and (place >= self._run or not was_mixed):
            self._run = place + 1
        return RESHAPED if self.mixed != was_mixed else STORED

    def _make_room_in_front(self) -> int:
        """The free place before the oldest sample; samples that arrive backwards go there."""
        if self.start == 0:
            room = max(_LEAST_SLACK, self._count() >> _SLACK)
            self.records[0:0] = array("q", bytes(RECORD * room))
            if self._parents is not None:
                self._parents[0:0] = array("i", [self.parent]) * room
            self.start = room
            self._run += room
        return self.start - 1
