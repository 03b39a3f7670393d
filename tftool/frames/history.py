"""One link over time: insert, forget, interpolate, refuse to extrapolate.

Samples lie in flat arrays, oldest first, 64 bytes each, behind a window that slides as old
ones are forgotten; the last two are kept as tuples too, so that most questions touch no
array.
"""

import struct
from array import array
from bisect import bisect_left, bisect_right
from typing import Any, Final, TypeAlias

from tftool.frames.chains import chained
from tftool.frames.links import (
    BACKWARD,
    FORWARD,
    KNOWN,
    NO_DATA,
    NO_PARENT,
    RESHAPED,
    STORED,
    TOO_OLD,
    Link,
    Refusal,
    Sample,
)
from tftool.stamps import Duration, Stamp

Columns: TypeAlias = "tuple[array[int], array[float], array[int] | None]"
"""Stamps, samples flat, and parents (None where there is but one), oldest first."""

_pack: Final = struct.Struct("7d").pack
_unpack_one: Final = struct.Struct("7d").unpack_from
_WIDTH: Final = 56

# Forgotten samples, and room in front for ones that arrive backwards, take at most
# one part in sixteen, like the room that `array` keeps at its end.
_SLACK: Final = 4
_LEAST_SLACK: Final = 32


class History(Link):
    """A link that moves: its samples of the last `limit` nanoseconds, as tf2 keeps them.

    Forgetting is lazy: only an insert forgets, and before it adds. Among equal stamps
    the last one inserted is the newest.
    """

    __slots__ = ("_full", "_limit", "_parents", "_run", "_start")

    def __init__(self, limit: Duration) -> None:
        super().__init__(False)
        self._limit = limit
        # One parent serves all, until samples disagree: then one number for each sample.
        self._parents: array[int] | None = None
        self._start = 0
        # So many forgotten samples are too many to leave where they are.
        self._full = _LEAST_SLACK
        # Where the newest samples that share a parent begin; of use while mixed.
        self._run = 0

    def __len__(self) -> int:
        return len(self.stamps) - self._start

    # Remembering

    def insert(self, stamp: Stamp, parent: int, sample: Any) -> int:
        """Forget what is too old by now, then remember a sample.

        Returns:
            TOO_OLD if it lies further back than the limit, KNOWN if that very sample is
            there, RESHAPED if it changes who the newest parent is or makes the parents
            mixed, else STORED.

        Raises:
            OverflowError: If the stamp does not fit 64 bits.
        """
        # A `Sample`; but declared as one, compiled code would take it apart and make it anew.
        newest = self.newest_stamp
        if stamp <= newest or self.newest is None:
            return self._insert_late(stamp, parent, sample)
        stamps = self.stamps
        oldest_kept = newest - self._limit
        if self.oldest_stamp < oldest_kept:
            # As a rule every sample that comes lets one go.
            start = self._start + 1
            oldest = stamps[start]
            if oldest < oldest_kept or self.mixed or start >= self._full:
                self._forget(oldest_kept)
            else:
                self._start = start
                self.oldest_stamp = oldest
        stamps.append(stamp)
        self.samples.frombytes(_pack(*sample))
        self.previous_stamp = newest
        self.previous = self.newest
        self.newest_stamp = stamp
        self.newest = sample
        if parent != self.parent or self.mixed:
            return self._append_parent(parent)
        return STORED

    def clear(self) -> None:
        """Forget everything; afterwards any stamp is taken again."""
        self.stamps = array("q")
        self.samples = array("d")
        self._parents = None
        self._start = self._run = 0
        self._full = _LEAST_SLACK
        self.newest_stamp = self.oldest_stamp = self.previous_stamp = 0
        self.newest = self.previous = None
        self.parent = NO_PARENT
        self.mixed = False

    @property
    def limit(self) -> Duration:
        """How far it remembers back from its newest sample."""
        return self._limit

    def extend(self, stamps: "array[int]", samples: "array[float]", oldest_kept: Stamp) -> None:
        """Append samples, each newer than the one before, and forget those before a stamp.

        They have the parent that all samples have; one there is already, and they reach
        beyond what is forgotten.
        """
        if self.newest_stamp < oldest_kept:
            self.replace(stamps, samples, array("i", [self.parent]) * len(stamps))
            return
        self.stamps.extend(stamps)
        self.samples.extend(samples)
        self._note_newest()
        if self.oldest_stamp < oldest_kept:
            self._forget(oldest_kept)

    def replace(self, stamps: "array[int]", samples: "array[float]", parents: "array[int]") -> None:
        """Remember these instead: not none, oldest first, of equal stamps the newest last."""
        self.stamps, self.samples, self._start = stamps, samples, 0
        self._full = max(_LEAST_SLACK, len(stamps) >> _SLACK)
        self.oldest_stamp = stamps[0]
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
        count = len(self.stamps)
        self.newest_stamp, self.newest = self.stamps[-1], self._sample(count - 1)
        self.previous_stamp, self.previous = 0, None
        if count - self._start > 1:
            self.previous_stamp, self.previous = self.stamps[-2], self._sample(count - 2)

    def _forget(self, oldest_kept: Stamp) -> None:
        """Let go of samples before that stamp."""
        stamps = self.stamps
        start = self._start + 1
        if stamps[start] < oldest_kept:
            start = bisect_left(stamps, oldest_kept, start)
        self.oldest_stamp = stamps[start]
        if self.mixed and start >= self._run:
            self._parents = None
            self.mixed = False
        if start >= self._full:
            self._full = max(_LEAST_SLACK, (len(stamps) - start) >> _SLACK)
            del stamps[:start]
            del self.samples[: 7 * start]
            if self._parents is not None:
                del self._parents[:start]
            self._run -= start
            start = 0
        self._start = start

    def _append_parent(self, parent: int) -> int:
        """Note the parent of the sample just appended."""
        count = len(self.stamps)
        parents = self._parents
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
        self._run = self._start
        return parents

    def _insert_late(self, stamp: Stamp, parent: int, sample: Sample) -> int:
        """Insert the first sample, or one that is not newer than all others."""
        stamps = self.stamps
        newest = self.newest_stamp
        if self.newest is None:
            stamps.append(stamp)
            self.samples.frombytes(_pack(*sample))
            self.oldest_stamp = self.newest_stamp = stamp
            self.newest = sample
            self.parent = parent
            return RESHAPED
        if self.oldest_stamp + self._limit < newest:
            self._forget(newest - self._limit)
        if stamp < newest - self._limit:
            return TOO_OLD
        place = bisect_right(stamps, stamp, self._start)
        behind = place - 1
        while behind >= self._start and stamps[behind] == stamp:
            if self._sample(behind) == sample and self._parent(behind) == parent:
                return KNOWN
            behind -= 1

        was_mixed = self.mixed
        if parent != self.parent and not was_mixed:
            self._mix(len(stamps))
        if place == self._start:
            place = self._make_room_in_front()
            stamps[place] = stamp
            self.samples[7 * place : 7 * place + 7] = array("d", sample)
            if self._parents is not None:
                self._parents[place] = parent
            self._start = place
        else:
            stamps.insert(place, stamp)
            self.samples[7 * place : 7 * place] = array("d", sample)
            if self._parents is not None:
                self._parents.insert(place, parent)
            if place < self._run:
                self._run += 1
        self.oldest_stamp = stamps[self._start]
        if place >= len(stamps) - 2:
            self.previous_stamp = stamps[-2]
            self.previous = sample if place == len(stamps) - 2 else self._sample(len(stamps) - 2)
        if place == len(stamps) - 1:
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
        if self._start == 0:
            room = max(_LEAST_SLACK, len(self.stamps) >> _SLACK)
            self.stamps[0:0] = array("q", bytes(8 * room))
            self.samples[0:0] = array("d", bytes(_WIDTH * room))
            if self._parents is not None:
                self._parents[0:0] = array("i", [self.parent]) * room
            self._start = room
            self._run += room
        return self._start - 1

    # Answering

    def at(self, time: Stamp) -> Sample | None:
        """The pose at that moment: met exactly, or on the way between its two neighbours.

        Between two samples with different parents it is the older one, as it is.
        """
        found = chained((self,), time)
        return None if found[6] != found[6] else found

    def parent_at(self, time: Stamp) -> int:
        """Number of the parent at that moment: the older neighbour's."""
        if time == self.newest_stamp or time == 0:
            return self.parent
        if self.newest is None or not self.oldest_stamp <= time < self.newest_stamp:
            return NO_PARENT
        if self._parents is None:
            return self.parent
        if time == self.oldest_stamp:
            return self._parents[self._start]
        return self._parents[self.index(time)]

    def refusal(self, time: Stamp) -> Refusal:
        """Which kind of nothing it has for that moment, and the stamp nearest to it."""
        if len(self) <= 1:
            return NO_DATA, self.newest_stamp
        if time > self.newest_stamp:
            return FORWARD, self.newest_stamp
        return BACKWARD, self.oldest_stamp

    def stamp_at(self, time: Stamp) -> Stamp:
        """Stamp of the sample that answers for that moment, the older of the two."""
        if time == self.newest_stamp or time == 0:
            return self.newest_stamp
        return self.stamps[self.index(time)] if time > self.oldest_stamp else self.oldest_stamp

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Every sample remembered, newest first: stamp, parent's number, pose."""
        return [
            (self.stamps[index], self._parent(index), self._sample(index))
            for index in range(len(self.stamps) - 1, self._start - 1, -1)
        ]

    def columns(self) -> "Columns":
        """Stamps, samples (seven numbers each) and parents, oldest first: copies.

        They are of one moment, even if another thread inserts or forgets meanwhile: what
        was copied is held against what is remembered, and copied again where they differ.
        """
        while True:
            start, newest, parents = self._start, self.newest_stamp, self._parents
            stamps, samples = self.stamps[start:], self.samples[7 * start :]
            if parents is not None:
                parents = parents[start:]
            if (
                len(samples) == 7 * len(stamps)
                and (parents is None or len(parents) == len(stamps))
                and (start, newest) == (self._start, self.newest_stamp)
                and (not stamps or (stamps[0], stamps[-1]) == (self.oldest_stamp, newest))
            ):
                return stamps, samples, parents

    def parts(self, time: Stamp) -> bool:
        """Whether the two samples that enclose a moment have different parents."""
        index = self.index(time)
        parents = self._parents
        return parents is not None and parents[index] != parents[index + 1]

    def _sample(self, index: int) -> Sample:
        sample: Sample = _unpack_one(self.samples, _WIDTH * index)
        return sample

    def _parent(self, index: int) -> int:
        return self.parent if self._parents is None else self._parents[index]

    def index(self, time: Stamp) -> int:
        """Where the last sample at or before `time` lies; oldest < time < newest.

        Guess by the mean rate, correct the guess once, and search only when that fails.
        """
        stamps = self.stamps
        start = self._start
        last = len(stamps) - 1
        pace = self.pace = (last - start) / (self.newest_stamp - self.oldest_stamp)
        guess = start + int((time - self.oldest_stamp) * pace)
        there = stamps[guess]
        if there <= time:
            if time < stamps[guess + 1]:
                return guess
            low, high = guess + 1, last
            guess = min(guess + int((time - there) * pace), last - 1)
        else:
            low, high = start, guess
            guess = max(guess - int((there - time) * pace) - 1, start)
        if stamps[guess] <= time < stamps[guess + 1]:
            return guess
        return bisect_right(stamps, time, low, high) - 1

    def exactly(self, time: Stamp) -> Sample | None:
        """The pose at one of the two ends of the history; outside it, none."""
        if time == self.newest_stamp:
            return self.newest
        if time != self.oldest_stamp or self.newest is None:
            return None
        return self._sample(self._start)
