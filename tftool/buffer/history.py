"""Links of a child to its parent over time: static or moving.

Memory layout of the samples of a moving link; batch lookups and `Buffer.samples` read it too:

- `records` is one flat array of 64-bit words, oldest sample first, WORDS words per sample: the
  stamp in nanoseconds, then the bits of the doubles x, y, z and of the quaternion x, y, z, w. Stamp
  and pose are neighbours because long histories do not fit into a processor's cache.
- Records before `start` are pruned or free; pruned records are removed in bulk later. Records from
  `count` on are free space for new samples.
- While a batch reads the records, the array must not grow. A change that needs more space is made
  to a copy (`_resizable`); the batch keeps reading the old array.
- An *origin* is the parent and the authority of a sample in one word: the parent's number in the
  low 32 bits, the authority's number in the high bits. While all samples have the same origin, only
  `origin` is stored; after a sample with another origin, `origins` holds one word per record.
- After the first query the newest sample, and the newest two, are also kept as tuples, so that most
  queries do not read the array.
"""

import struct
from array import array
from math import inf, nan
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias, cast

from tftool.base.large_pages import PAGE, large_pages
from tftool.base.stamps import LAST_STAMP, Duration, Stamp
from tftool.buffer.native_kernel import IS_NATIVE
from tftool.geometry import poses, quaternions

Sample: TypeAlias = tuple[float, float, float, float, float, float, float]
"""A pose: x, y, z in metres and a unit quaternion x, y, z, w of tf2's sign."""

IDENTITY: Sample = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)

NO_POSE: Sample = (nan, nan, nan, nan, nan, nan, nan)
"""Stands for "no pose": NaN throughout, and so is every product with it."""

Refusal: TypeAlias = tuple[int, Stamp]
"""Why a link has no pose at a moment: NO_DATA, FORWARD or BACKWARD, and the stamp it does have."""

Columns: TypeAlias = "tuple[memoryview[int], array[int] | None, int]"
"""A view of the records, oldest first; an origin for each (None: all alike); the newest origin."""

Words: TypeAlias = "array[int] | memoryview[int]"
"""Records, one behind the other."""

MOST_ALIKE: Final = 32
"""How many samples of equal stamp are compared with a new one to find a duplicate."""

NO_PARENT: Final = -1
"""Stands for "no parent" or "no origin"."""

WORDS: Final = 8
"""How many 64-bit words a record takes."""

RECORD: Final = 8 * WORDS
"""How many bytes that is."""

AUTHORITY_SHIFT: Final = 32
"""Where the authority's number begins in an origin."""

PARENT_MASK: Final = (1 << AUTHORITY_SHIFT) - 1
"""The bits of an origin that are the parent's number."""

# Why a link has no pose at some moment.
NO_DATA: Final = 1
FORWARD: Final = 2
BACKWARD: Final = 3

# What became of an insert.
TOO_OLD: Final = 0
KNOWN: Final = 1
STORED: Final = 2
PARENT_CHANGED: Final = 3
NEEDS_CHECK: Final = 4


_pack: Final = struct.Struct("q7d").pack
_unpack_pose: Final = struct.Struct("7d").unpack_from
_unpack_pair: Final = struct.Struct("q7dq7d").unpack_from

# Pruned samples, and room in front for ones that arrive backwards, take at most one part in eight.
_SLACK: Final = 3
_LEAST_SLACK: Final = 32

# Room for samples to come is as much again as there is, at least so much, and so much at most or
# that part of all (a shift to the right): each time it is made, everything may have to be copied.
_LEAST_ROOM: Final = 8
_MOST_ROOM: Final = 256
_ROOM: Final = 4

# So many records lie in two large pages of memory.
_MANY: Final = 2 * PAGE // RECORD

# A quaternion whose square lies between these is of length one but for rounding.
SHORTEST: Final = 1.0 - quaternions.ROUNDING
LONGEST: Final = 1.0 + quaternions.ROUNDING


if TYPE_CHECKING or not IS_NATIVE:

    class Fields:
        """Fields shared by both kinds of link; a native base class where the kernel is built."""

        __slots__ = (
            "_newest",
            "_newest_pair",
            "count",
            "limit",
            "mixed",
            "newest_stamp",
            "oldest_stamp",
            "origin",
            "origins",
            "records",
            "start",
        )

else:
    from tftool.buffer._kernel import Fields


class StaticLink(Fields):
    """A static link: one sample, overwritten by the next.

    Attributes:
        is_static: Always true.
        newest_stamp: Always 0, as in tf2.
        oldest_stamp: Always 0.
        parent: Number of the parent; NO_PARENT before there is one.
        origin: Numbers of the parent and the authority in one word.
        mixed: Always false: a static link has one parent.
    """

    __slots__ = ("parent",)

    is_static: Literal[True] = True

    def __init__(self, newest: Sample | None = None) -> None:
        self._newest: Sample | None = newest
        self.newest_stamp: Stamp = 0
        self.oldest_stamp: Stamp = 0
        self.parent: int = NO_PARENT
        self.origin: int = NO_PARENT
        self.mixed: bool = False

    def __len__(self) -> int:
        return 1

    @property
    def newest(self) -> Sample | None:
        """The newest sample; None if there is none."""
        return self._newest

    def at(self, time: Stamp) -> Sample:
        """Return the pose, the same for every time; NO_POSE if there is none."""
        return self._newest or NO_POSE

    def parent_at(self, time: Stamp) -> int:
        """Return the parent, the same for every time."""
        return self.parent

    def insert(self, stamp: Stamp, origin: int, pose: Any, validated: bool = True) -> int:
        """Replace the sample; return KNOWN or PARENT_CHANGED."""
        parent = origin & PARENT_MASK
        sample = (*pose[0], *pose[1])
        known = parent == self.parent and sample == self._newest
        self.origin = origin
        self.parent = parent
        self._newest = sample
        return KNOWN if known else PARENT_CHANGED

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Return the one sample at stamp 0: stamp, parent's number, pose."""
        return [] if self._newest is None else [(0, self.parent, self._newest)]


class History(Fields):
    """A moving link: its samples of the last `limit` nanoseconds, as in tf2.

    Pruning is lazy: only an insertion prunes, before it adds. Among equal stamps the last inserted
    one is the newest.

    Attributes:
        is_static: Always false.
        limit: How far back from the newest sample samples are kept, nanoseconds.
        newest_stamp: Stamp of the newest sample; 0 without samples.
        oldest_stamp: Stamp of the oldest sample; 0 without samples.
        parent: Number of the newest sample's parent; NO_PARENT without samples.
        origin: The newest sample's origin; see the head of this module.
        origins: Origin of each record; None while all records have the same origin.
        mixed: Whether the stored samples have different parents.
        records: See the head of this module.
        start: Number of the first record that is not pruned.
        count: Number of records, including pruned ones.
        period: Last measured time between samples, nanoseconds; used to guess the place of a stamp.
        large_from: Number of records from which `use_large_pages` is called.
    """

    __slots__ = ("_compact_at", "_newest_parent_start", "large_from", "parent", "period")

    is_static: Literal[False] = False

    def __init__(self, limit: Duration) -> None:
        # More than any two stamps can be apart.
        self.limit: Duration = min(limit, LAST_STAMP)
        self.period: Duration = 1
        self.clear()

    def clear(self) -> None:
        """Drop all samples; afterwards any stamp is accepted again."""
        self.records: array[int] = array("q")
        self.start: int = 0
        self.count: int = 0
        self.newest_stamp: Stamp = 0
        self.oldest_stamp: Stamp = 0
        # The newest sample, read when it is first asked for.
        self._newest: Sample | None = None
        # The last two samples as they lie in `records`; read when they are first asked for.
        self._newest_pair: poses.Pair | None = None
        self.parent: int = NO_PARENT
        self.origin: int = NO_PARENT
        self.origins: array[int] | None = None
        self.mixed: bool = False
        # At this many pruned records the array is compacted.
        self._compact_at: int = _LEAST_SLACK
        # Where the newest samples that share a parent begin; of use while mixed.
        self._newest_parent_start: int = 0
        self.large_from: int = _MANY

    def __len__(self) -> int:
        return self.count - self.start

    # Asking

    @property
    def newest(self) -> Sample | None:
        """The newest sample; None if there is none."""
        if self._newest is None and self.count:
            self._newest = self._sample(self.count - 1)
        return self._newest

    def at(self, time: Stamp) -> Sample:
        """Return the pose at that time (0: the newest), interpolated; NO_POSE if there is none.

        Between two samples with different parents, return the older one unchanged.
        """
        newest = self.newest_stamp
        if not self.oldest_stamp < time < newest:
            if time == newest or time == 0:
                return self._newest or self.newest or NO_POSE
            if time == self.oldest_stamp and self.count:
                return self._sample(self.start)
            return NO_POSE
        # Most questions fall between the last two: without them at hand, latest and recent
        # lookups are an eighth slower.
        pair = self._newest_pair
        if pair is None:
            pair = self._newest_pair = _unpack_pair(self.records, RECORD * (self.count - 2))
        if time < pair[0]:
            # Samples come almost periodically: guess first, search if that is wrong.
            try:
                guess = self.start + (time - self.oldest_stamp) // self.period
                pair = _unpack_pair(self.records, RECORD * guess)
            except (struct.error, OverflowError):
                # Beyond the last record; there may be room behind it, whose stamps are 0.
                pair = _unpack_pair(self.records, RECORD * self.index(time))
            if not pair[0] <= time < pair[8]:
                pair = _unpack_pair(self.records, RECORD * self.index(time))
        if self.mixed and self.parent_changes_after(time):
            return pair[1:8]
        return poses.interpolate(pair, time)

    def parent_at(self, time: Stamp) -> int:
        """Return the parent's number at that time, from the older neighbour; NO_PARENT without
        data.

        For time 0, return the newest sample's parent.
        """
        if time == self.newest_stamp or time == 0:
            return self.parent
        if not self.count or not self.oldest_stamp <= time < self.newest_stamp:
            return NO_PARENT
        if not self.mixed:
            return self.parent
        return self._parent(self.start if time == self.oldest_stamp else self.index(time))

    def stamp_at(self, time: Stamp) -> Stamp:
        """Return the stamp of the older of the two samples used for that time."""
        if time == self.newest_stamp or time == 0:
            return self.newest_stamp
        return self._stamp(self.index(time)) if time > self.oldest_stamp else self.oldest_stamp

    def refusal(self, time: Stamp) -> Refusal:
        """Return why there is no pose at that time, and the stamp nearest to it."""
        if len(self) <= 1:
            return NO_DATA, self.newest_stamp
        if time > self.newest_stamp:
            return FORWARD, self.newest_stamp
        return BACKWARD, self.oldest_stamp

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Return every sample, newest first: stamp, parent's number, pose."""
        return [
            (self._stamp(index), self._parent(index), self._sample(index))
            for index in range(self.count - 1, self.start - 1, -1)
        ]

    def columns(self) -> "Columns":
        """Return records and origins, oldest first; see `Columns`.

        The records are not copied, and do not change while the view exists: the array grows only as
        a copy. The records show one state, even if another thread inserts or prunes meanwhile:
        after taking the view, the function compares the values it read before.
        """
        while True:
            records, start, count = self.records, self.start, self.count
            newest, origins, origin = self.newest_stamp, self.origins, self.origin
            view = memoryview(records)[WORDS * start : WORDS * count]
            if origins is not None:
                origins = origins[start:]
            if (
                len(view) == WORDS * (count - start)
                and (origins is None or len(origins) == count - start)
                and records is self.records
                and (start, count, newest, origin)
                == (self.start, self.count, self.newest_stamp, self.origin)
                and (not view or (view[0], view[-WORDS]) == (self.oldest_stamp, newest))
            ):
                return view, origins, origin

    def parents(self) -> set[int]:
        """Return the numbers of all parents in the samples."""
        if not self.mixed or self.origins is None:
            return {self.parent} if self.count else set()
        return {origin & PARENT_MASK for origin in set(self.origins[self.start :])}

    def parent_changes_after(self, time: Stamp) -> bool:
        """Whether the two samples around a time have different parents."""
        index = self.index(time)
        return self._parent(index) != self._parent(index + 1)

    def _stamp(self, index: int) -> Stamp:
        return self.records[WORDS * index]

    def _sample(self, index: int) -> Sample:
        sample: Sample = _unpack_pose(self.records, RECORD * index + 8)
        return sample

    def _parent(self, index: int) -> int:
        return self.parent if self.origins is None else self.origins[index] & PARENT_MASK

    def _after(self, time: Stamp) -> int:
        """Return the index of the first sample after a time; the end index if there is no such
        sample.
        """
        if time < self.oldest_stamp:
            return self.start
        if time < self.newest_stamp:
            return self.index(time) + 1
        return self.count

    def index(self, time: Stamp) -> int:
        """Return the index of the last sample at or before `time`; oldest <= time < newest.

        Guess by the mean rate, correct the guess once, and search only when that fails.
        """
        records = self.records
        # The sample at `low` is not later than the moment, the one at `high` is.
        low, high = self.start, self.count - 1
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

    # Inserting

    def insert(self, stamp: Stamp, origin: int, pose: Any, validated: bool = False) -> int:
        """Insert one sample, and prune those that are now too old.

        Args:
            stamp: Nanoseconds.
            origin: Numbers of the parent and the authority in one word.
            pose: Position and quaternion in xyzw order, as received: the quaternion may have any
                length and either sign.
            validated: Whether stamp and numbers are checked, and the quaternion has unit length and
                tf2's sign.

        Returns:
            TOO_OLD if the sample is older than the limit; KNOWN if an equal sample is stored;
            PARENT_CHANGED if the sample changes the set of the link's parents; else STORED.
            NEEDS_CHECK, with nothing changed, if the stamp is not an `int` or the pose has
            something other than numbers.

        Raises:
            struct.error: If the stamp does not fit into 64 bits; nothing was changed.
        """
        (x, y, z), (qx, qy, qz, qw) = pose
        if not validated:
            # NaN is not below anything; nor is a place so far off that it cannot be told from it.
            if not (
                type(stamp) is int
                and SHORTEST < qx * qx + qy * qy + qz * qz + qw * qw < LONGEST
                and x + y + z < inf
            ):
                return self._insert_scaled(stamp, origin, pose)
            if qw <= 0.5 and quaternions.leading(qx, qy, qz, qw) < 0.0:
                qx *= -1.0
                qy *= -1.0
                qz *= -1.0
                qw *= -1.0
        newest = self.newest_stamp
        if stamp <= newest:
            late = array("q", _pack(stamp, x, y, z, qx, qy, qz, qw))
            return self._insert_late(stamp, origin, late)
        record = _pack(stamp, x, y, z, qx, qy, qz, qw)
        oldest_kept = newest - self.limit
        if self.oldest_stamp < oldest_kept:
            # As a rule every sample that comes prunes one.
            start = self.start + 1
            oldest = self.records[WORDS * start]
            if oldest < oldest_kept or self.mixed or start >= self._compact_at:
                self._prune(oldest_kept)
            else:
                self.start = start
                self.oldest_stamp = oldest
        if IS_NATIVE:
            self._have_room()
            self.records[WORDS * self.count : WORDS * (self.count + 1)] = array("q", record)
        else:
            try:
                self.records.frombytes(record)
            except (AttributeError, BufferError):
                # Borrowed, or read by a batch.
                self._splice(self.count, self.count, array("q", record))
        self.count += 1
        self.newest_stamp = stamp
        self._newest = self._newest_pair = None
        if origin is self.origin and self.origins is None:
            return STORED
        return self._append_origin(origin)

    def _insert_scaled(self, stamp: Any, origin: int, pose: Any) -> int:
        """Insert a sample whose quaternion needs scaling, if no other check is needed."""
        (x, y, z), turn = pose
        turn = quaternions.canonical(quaternions.unit(turn))
        if type(stamp) is not int or x + y + z != x + y + z or turn[3] != turn[3]:
            return NEEDS_CHECK
        return self.insert(stamp, origin, ((x, y, z), turn), True)

    def _append_origin(self, origin: int) -> int:
        """Record the origin of the sample just appended."""
        if origin == self.origin and self.origins is None:
            return STORED
        count = self.count
        parent = origin & PARENT_MASK
        if self.parent == NO_PARENT:
            self.parent = parent
            self.origin = origin
            self._begin(0)
            return PARENT_CHANGED
        self._note_origins(count - 1).append(origin)
        self.origin = origin
        if parent == self.parent:
            return STORED
        if not self.mixed:
            self.mixed = True
        self.parent = parent
        self._newest_parent_start = count - 1
        return PARENT_CHANGED

    def _note_origins(self, count: int) -> "array[int]":
        """Return the origin of each record; the first `count` shared one until now."""
        origins = self.origins
        if origins is None:
            origins = self.origins = array("q", [self.origin]) * count
        return origins

    def _insert_late(self, stamp: Stamp, origin: int, record: "array[int]") -> int:
        """Insert the first sample, or one that is not newer than all others."""
        newest = self.newest_stamp
        parent = origin & PARENT_MASK
        if not self.count:
            self.records = record
            self.count = 1
            self._begin(0)
            self.newest_stamp = stamp
            self.parent = parent
            self.origin = origin
            return PARENT_CHANGED
        oldest_kept = newest - self.limit
        if self.oldest_stamp < oldest_kept:
            self._prune(oldest_kept)
        if IS_NATIVE:
            self._have_room()
        if stamp < oldest_kept:
            return TOO_OLD
        place = self._after(stamp)
        behind = place - 1
        sample = _unpack_pose(record, 8)
        # Bounded: a publisher that never sets a stamp would make every insert scan all before it.
        last = max(self.start, place - MOST_ALIKE)
        while behind >= last and self._stamp(behind) == stamp:
            if self._sample(behind) == sample and self._parent(behind) == parent:
                return KNOWN
            behind -= 1

        changes = parent != self.parent
        origins = self.origins
        if origin != self.origin:
            origins = self._note_origins(self.count)
        if changes and not self.mixed:
            self.mixed = True
            self._newest_parent_start = self.start
        if place == self.start:
            place = self._make_room_in_front()
            self.records[WORDS * place : WORDS * (place + 1)] = record
            if origins is not None:
                origins[place] = origin
            self._begin(place)
        else:
            self._splice(place, place, record)
            self.count += 1
            if origins is not None:
                origins.insert(place, origin)
            if place < self._newest_parent_start:
                self._newest_parent_start += 1
        self._newest_pair = None
        if place == self.count - 1:
            # Equal to the newest stamp: the one that came last is in front.
            self._newest = sample
            self.origin = origin
            if changes:
                self.parent = parent
                self._newest_parent_start = place
        elif changes and place >= self._newest_parent_start:
            self._newest_parent_start = place + 1
        return PARENT_CHANGED if changes else STORED

    def _make_room_in_front(self) -> int:
        """Return a free record before the oldest sample, for samples inserted in reverse order."""
        if self.start == 0:
            room = max(_LEAST_SLACK, self.count >> _SLACK)
            self._splice(0, 0, array("q", bytes(RECORD * room)))
            if self.origins is not None:
                self.origins[0:0] = array("q", [self.origin]) * room
            self.start = room
            self.count += room
            self._newest_parent_start += room
        elif self._is_read():
            # That place may hold a sample which was pruned after the batch began.
            self.records = _copied(self.records, 0, len(self.records) // WORDS)
        return self.start - 1

    def _splice(self, start: int, stop: int, words: "array[int]") -> None:
        """Replace the records from `start` up to, but not including, `stop`."""
        where = slice(WORDS * start, WORDS * stop)
        try:
            self.records[where] = words
        except (BufferError, TypeError, ValueError):
            # A batch reads them, which keeps the array as it is; or they are borrowed. To let go
            # of those may let another thread in, which has the new ones in large pages.
            copy = _copied(self.records, 0, len(self.records) // WORDS)
            copy[where] = words
            self.records = copy

    def _is_read(self) -> bool:
        """Whether the array must not change: a batch reads it, or it is borrowed."""
        try:
            self.records.append(0)
            self.records.pop()
        except (AttributeError, BufferError):
            return True
        return False

    def _have_room(self) -> None:
        """Reserve space after the newest sample, for samples that the kernel inserts."""
        if self.count == len(self.records) // WORDS:
            room = max(_LEAST_ROOM, min(self.count, _MOST_ROOM), self.count >> _ROOM)
            self._splice(self.count, self.count, array("q", bytes(RECORD * room)))

    # Many at once

    def extend(self, records: "array[int]", oldest_kept: Stamp) -> None:
        """Append records with increasing stamps, and prune those before a stamp.

        All records have the origin of the existing samples. There must be at least one sample, and
        the last record must be newer than `oldest_kept`.
        """
        if self.newest_stamp < oldest_kept:
            self.replace(records, array("q", [self.origin]) * (len(records) // WORDS))
            return
        # In place of the room behind the newest one.
        self._splice(self.count, len(self.records) // WORDS, records)
        self.count += len(records) // WORDS
        self._note_newest()
        if self.oldest_stamp < oldest_kept:
            self._prune(oldest_kept)

    def replace(self, records: "Words", origins: "array[int]") -> None:
        """Replace all samples by at least one sample, oldest first; of equal stamps the newest
        last.
        """
        # Borrowed records are only used in ways that a read-only view supports.
        self.records = cast("array[int]", records)
        self.count = len(records) // WORDS
        self._compact_at = max(_LEAST_SLACK, self.count >> _SLACK)
        self._begin(0)
        self._note_newest()
        self.origin = origins[-1]
        self.parent = self.origin & PARENT_MASK
        self.origins = None if origins.count(self.origin) == len(origins) else origins
        self._newest_parent_start = self._find_newest_parent_start()
        self.mixed = self._newest_parent_start > 0

    def borrow(self, records: "Words", origin: int) -> None:
        """Replace all samples by borrowed samples with increasing stamps and one origin.

        The borrowed samples are copied only at an insertion or pruning: until then they may be in
        foreign memory, and `records` is a read-only view.
        """
        self.replace(memoryview(records).toreadonly(), array("q", [origin]))

    def lend(self, other: "History", origin: int, until: Stamp) -> bool:
        """Share the samples up to a stamp with another history, without a copy.

        Args:
            other: An empty history.
            origin: Origin of the samples in the other history.
            until: The last stamp to share, nanoseconds.

        Returns:
            Whether the samples could be shared; false if some were pruned here, or have several
            origins.
        """
        if self.origins is not None or self.start or not self.count:
            return False
        first, last = 0, self.count
        while first < last:
            middle = (first + last) // 2
            if self._stamp(middle) <= until:
                first = middle + 1
            else:
                last = middle
        if first:
            # Neither may write into what both have.
            shared = memoryview(self.records).toreadonly()
            self.records = cast("array[int]", shared[: WORDS * self.count])
            other.borrow(shared[: WORDS * first], origin)
        return True

    def _find_newest_parent_start(self) -> int:
        """Return the index from which on all samples have the newest sample's parent."""
        if self.origins is None:
            return self.start
        first = self.count - 1
        while first > self.start and self._parent(first - 1) == self.parent:
            first -= 1
        return first

    def _note_newest(self) -> None:
        """Update the cached newest sample."""
        last = self.count - 1
        self.newest_stamp = self._stamp(last)
        self._newest = self._newest_pair = None

    def use_large_pages(self) -> None:
        """Move many samples into large pages, if the system has them.

        Random lookups over five links of 100 000 samples take a quarter less time. When the memory
        is full, the array grows on ordinary pages; it moves to large pages again only at twice the
        length.
        """
        self.large_from = 2 * self.count
        records = self.records
        if not IS_NATIVE or not isinstance(records, array):
            return
        size = len(records) * records.itemsize
        pages = large_pages(size, size & -PAGE)
        if pages is None:
            return
        words: Any = memoryview(pages)[:size].cast("q")
        every = slice(None)
        with memoryview(records) as view:
            if len(view) != len(words):
                return
            # While a view of it is held, no other thread has the array grow, but one may have put
            # another in its place. From here on nothing is called, nor is there an object made,
            # for which the collector might run: no thread comes in between.
            if records is self.records:
                words[every] = view
                self.records = words

    # Pruning

    def keep_last(self, number: int) -> None:
        """Drop the oldest samples until `number` remain, at least two."""
        if len(self) > (number := max(2, number)):
            self._let_go(self.count - number)

    def _prune(self, oldest_kept: Stamp) -> None:
        """Drop the samples before that stamp; the newest sample always stays."""
        start = self.start + 1
        if self._stamp(start) < oldest_kept:
            # Where equal stamps are the oldest, all of them stay.
            start = self._after(oldest_kept - 1)
        self._let_go(start)

    def _let_go(self, start: int) -> None:
        """Drop the samples before the record with index `start`."""
        if self.mixed and start >= self._newest_parent_start:
            self.mixed = False
        if start >= self._compact_at:
            if isinstance(self.records, array):
                self._splice(0, start, array("q"))
            else:
                # Released samples are not to be copied first.
                self.records = _copied(self.records, start, self.count)
            self.count -= start
            if self.origins is not None:
                del self.origins[:start]
                if self.origins.count(self.origin) == len(self.origins):
                    self.origins = None
            self._compact_at = max(_LEAST_SLACK, self.count >> _SLACK)
            if IS_NATIVE:
                # Pruned samples make room for as many, until as many are pruned again.
                room = array("q", bytes(RECORD * min(start, self._compact_at)))
                self._splice(self.count, len(self.records) // WORDS, room)
            self._newest_parent_start -= start
            start = 0
        self._begin(start)

    def _begin(self, start: int) -> None:
        """Make the samples begin at the record with index `start`."""
        self.start = start
        self.oldest_stamp = self._stamp(start)


def _copied(records: Words, start: int, stop: int) -> "array[int]":
    """Copy some of the records into a new array."""
    words = records[WORDS * start : WORDS * stop]
    if isinstance(words, array):
        return words
    copy = array("q")
    copy.frombytes(words.cast("B"))
    return copy


Link: TypeAlias = StaticLink | History
"""What joins a child to its parent."""
