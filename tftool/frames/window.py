"""The samples of one link that are remembered, and what is answered out of them."""

import struct
from array import array
from typing import Final, TypeAlias

from tftool.frames.chains import chained
from tftool.frames.links import (
    BACKWARD,
    FORWARD,
    NO_DATA,
    NO_PARENT,
    RECORD,
    WORDS,
    Link,
    Refusal,
    Sample,
)
from tftool.stamps import Stamp

Records: TypeAlias = "tuple[array[int], array[int] | None]"
"""Records, and a parent for each (None where there is but one), oldest first."""

_unpack_one: Final = struct.Struct("7d").unpack_from


class Window(Link):
    """A link that moves, as it is asked: `History` is what slides the window on.

    Samples lie as records in one flat array, oldest first, 64 bytes each, behind a window
    that begins at `start`; the last two are kept as tuples too, so that most questions touch
    no array.
    """

    __slots__ = ("_parents",)

    def __init__(self) -> None:
        super().__init__(False)
        # One parent serves all, until samples disagree: then one number for each sample.
        self._parents: array[int] | None = None

    def __len__(self) -> int:
        return len(self.records) // WORDS - self.start

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
            return self._parents[self.start]
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
        return self._stamp(self.index(time)) if time > self.oldest_stamp else self.oldest_stamp

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Every sample remembered, newest first: stamp, parent's number, pose."""
        return [
            (self._stamp(index), self._parent(index), self._sample(index))
            for index in range(self._count() - 1, self.start - 1, -1)
        ]

    def columns(self) -> "Records":
        """Records and parents, oldest first: copies.

        They are of one moment, even if another thread inserts or forgets meanwhile: what
        was copied is held against what is remembered, and copied again where they differ.
        """
        while True:
            start, newest, parents = self.start, self.newest_stamp, self._parents
            records = self.records[WORDS * start :]
            if parents is not None:
                parents = parents[start:]
            if (
                (parents is None or WORDS * len(parents) == len(records))
                and (start, newest) == (self.start, self.newest_stamp)
                and (not records or (records[0], records[-WORDS]) == (self.oldest_stamp, newest))
            ):
                return records, parents

    def parts(self, time: Stamp) -> bool:
        """Whether the two samples that enclose a moment have different parents."""
        index = self.index(time)
        parents = self._parents
        return parents is not None and parents[index] != parents[index + 1]

    def _count(self) -> int:
        """How many records there are, forgotten ones included."""
        return len(self.records) // WORDS

    def _stamp(self, index: int) -> Stamp:
        return self.records[WORDS * index]

    def _sample(self, index: int) -> Sample:
        sample: Sample = _unpack_one(self.records, RECORD * index + 8)
        return sample

    def _parent(self, index: int) -> int:
        return self.parent if self._parents is None else self._parents[index]

    def _later(self, time: Stamp) -> int:
        """Where the first sample after a moment lies; behind the last one if there is none."""
        if time < self.oldest_stamp:
            return self.start
        if time < self.newest_stamp:
            return self.index(time) + 1
        return self._count()

    def index(self, time: Stamp) -> int:
        """Where the last sample at or before `time` lies; oldest <= time < newest.

        Guess by the mean rate, correct the guess once, and search only when that fails.
        """
        records = self.records
        # The sample at `low` is not later than the moment, the one at `high` is.
        low, high = self.start, self._count() - 1
        self.period = period = max(1, (self.newest_stamp - self.oldest_stamp) // (high - low))
        guess = low + (time - self.oldest_stamp) // period
        for _ in range(2):
            guess = min(max(guess, low), high - 1)
            there = records[WORDS * guess]
            if there > time:
                high = guess
            elif time < records[WORDS * guess + WORDS]:
                return guess
            else:
                low = guess + 1
            guess += (time - there) // period
        while high - low > 1:
            guess = (low + high) >> 1
            if records[WORDS * guess] <= time:
                low = guess
            else:
                high = guess
        return low

    def exactly(self, time: Stamp) -> Sample | None:
        """The pose at one of the two ends of the history; outside it, none."""
        if time == self.newest_stamp:
            return self.newest
        if time != self.oldest_stamp or self.newest is None:
            return None
        return self._sample(self.start)
