"""Links of a child to its parent over time: static or moving.

Memory layout of the samples of a moving link, which batch lookups and `Buffer.samples` read too:

- `records` is one flat array of 64-bit words, oldest sample first, WORDS words per sample: the
  stamp in nanoseconds, then the bits of the doubles x, y, z and of the quaternion x, y, z, w. Stamp
  and pose are neighbours because long histories do not fit into a processor's cache.
- Records before `start` are pruned or free; pruned records are removed in bulk later. Records from
  `count` on are free space for new samples.
- While a batch reads the records, the array must not grow. A change that needs more space is made
  to a copy (`_resizable`); the batch keeps reading the old array.
- An *origin* is the parent and the authority of a sample in one integer: the parent's number in the
  low 32 bits, the authority's number in the high bits. While all samples have the same origin, only
  `origin` is stored. After a sample with another origin, `origins` contains one integer per record.
- After the first query, the two newest samples are cached as tuples. Most queries need only these
  tuples, and do not read the array.
"""

import struct
from array import array
from math import inf, nan
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias, cast

from tftool.base.native import PAGE, large_pages
from tftool.base.stamps import LAST_STAMP, Duration, Stamp
from tftool.buffer.native_kernel import IS_NATIVE
from tftool.geometry import poses, quaternions

Sample: TypeAlias = tuple[float, float, float, float, float, float, float]
"""A pose: x, y, z in metres and a unit quaternion x, y, z, w with the sign that tf2 chooses."""

IDENTITY: Sample = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)

NO_POSE: Sample = (nan, nan, nan, nan, nan, nan, nan)
"""Result without a pose: all numbers are NaN, and so is every product with it."""

Refusal: TypeAlias = tuple[int, Stamp]
"""Reason why a link has no pose at a time (NO_DATA, FORWARD or BACKWARD), and its nearest stamp."""

Columns: TypeAlias = "tuple[memoryview[int], array[int] | None, int]"
"""View of the records, oldest first; an origin per record, or None if all equal; newest origin."""

Words: TypeAlias = "array[int] | memoryview[int]"
"""Records in one flat array."""

MOST_ALIKE: Final = 32
"""Maximum number of samples with equal stamps that a new sample is compared with."""

NO_PARENT: Final = -1
"""Number that means "no parent" or "no origin"."""

WORDS: Final = 8
"""Number of 64-bit words in a record."""

RECORD: Final = 8 * WORDS
"""Size of a record, bytes."""

AUTHORITY_SHIFT: Final = 32
"""Number of the lowest bit of the authority's number in an origin."""

PARENT_MASK: Final = (1 << AUTHORITY_SHIFT) - 1
"""Bits of an origin that contain the parent's number."""

# Reasons why a link has no pose at a time.
NO_DATA: Final = 1
FORWARD: Final = 2
BACKWARD: Final = 3

# Results of an insertion.
TOO_OLD: Final = 0
KNOWN: Final = 1
STORED: Final = 2
PARENT_CHANGED: Final = 3
NEEDS_CHECK: Final = 4


_pack: Final = struct.Struct("q7d").pack
_unpack_pose: Final = struct.Struct("7d").unpack_from
_unpack_pair: Final = struct.Struct("q7dq7d").unpack_from

# At most an eighth of the records are pruned samples, or free space before the oldest sample.
_SLACK: Final = 3
_LEAST_SLACK: Final = 32

# Free space after the newest sample: three times as many records as there are samples, within the
# first two limits, or if that is more, 1/16 of all (a shift by the third number). Making space may
# copy all records, and costs as much as ten inserts, so it must be rare.
_LEAST_ROOM: Final = 8
_MOST_ROOM: Final = 512
_ROOM: Final = 4
_EMPTY: Final = array("q", bytes(RECORD))

# Number of records that fit into two large pages of memory.
_MANY: Final = 2 * PAGE // RECORD

# A quaternion whose squared length is between these has unit length except for rounding.
SHORTEST: Final = 1.0 - quaternions.ROUNDING
LONGEST: Final = 1.0 + quaternions.ROUNDING


if TYPE_CHECKING or not IS_NATIVE:

    class Fields:
        """Fields of `StaticLink` and `History`; the C kernel, if built, defines this class."""

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
    """A static link to a parent, with one sample, which the next sample overwrites.

    Attributes:
        is_static: Always true.
        newest_stamp: Always 0, as in tf2.
        oldest_stamp: Always 0.
        parent: Number of the parent; NO_PARENT before the first sample.
        origin: Numbers of parent and authority in one integer; see the docstring of this module.
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
        """The only sample; None if there is no sample."""
        return self._newest

    def at(self, time: Stamp) -> Sample:
        """Return the link's pose, the same for every time; NO_POSE if there is no sample."""
        return self._newest or NO_POSE

    def parent_at(self, time: Stamp) -> int:
        """Return the parent's number, the same for every time."""
        return self.parent

    def insert(self, stamp: Stamp, origin: int, pose: Any, validated: bool = True) -> int:
        """Replace the sample; return KNOWN if an equal sample was stored, else PARENT_CHANGED."""
        parent = origin & PARENT_MASK
        sample = (*pose[0], *pose[1])
        known = parent == self.parent and sample == self._newest
        self.origin = origin
        self.parent = parent
        self._newest = sample
        return KNOWN if known else PARENT_CHANGED

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Return the only sample, with stamp 0, as (stamp, parent's number, pose) in a list."""
        return [] if self._newest is None else [(0, self.parent, self._newest)]


class History(Fields):
    """A moving link: its samples of the last `limit` nanoseconds, as in tf2.

    Old samples are removed (pruned) only by an insertion, before the new sample is stored. Of
    samples with equal stamps, the sample inserted last is the newest.

    Attributes:
        is_static: Always false.
        limit: Age up to which samples are kept, relative to the newest sample, nanoseconds.
        newest_stamp: Stamp of the newest sample; 0 without samples.
        oldest_stamp: Stamp of the oldest sample; 0 without samples.
        parent: Number of the newest sample's parent; NO_PARENT without samples.
        origin: Origin of the newest sample; see the docstring of this module.
        origins: Origin of each record; None while all records have the same origin.
        mixed: Whether the stored samples have different parents.
        records: The samples; see the docstring of this module.
        start: Index of the first record that is not pruned.
        count: Number of records up to the newest sample, including pruned records.
        period: Last measured time between samples, nanoseconds, used to guess the index of a stamp.
        large_from: Number of records from which `use_large_pages` is called.
    """

    __slots__ = ("_compact_at", "_newest_parent_start", "large_from", "parent", "period")

    is_static: Literal[False] = False

    def __init__(self, limit: Duration) -> None:
        # A limit above the last stamp has the same effect as the last stamp.
        self.limit: Duration = min(limit, LAST_STAMP)
        self.period: Duration = 1
        self.clear()

    def clear(self) -> None:
        """Drop all samples; afterwards samples with any stamp are accepted."""
        self.records: array[int] = array("q")
        self.start: int = 0
        self.count: int = 0
        self.newest_stamp: Stamp = 0
        self.oldest_stamp: Stamp = 0
        # The newest sample; read from `records` when first needed.
        self._newest: Sample | None = None
        # The last two samples as in `records`; read when first needed.
        self._newest_pair: poses.Pair | None = None
        self.parent: int = NO_PARENT
        self.origin: int = NO_PARENT
        self.origins: array[int] | None = None
        self.mixed: bool = False
        # The array is compacted when this many records are pruned.
        self._compact_at: int = _LEAST_SLACK
        # Index of the first of the newest samples that share a parent; used only while `mixed`.
        self._newest_parent_start: int = 0
        self.large_from: int = _MANY

    def __len__(self) -> int:
        return self.count - self.start

    # Queries

    @property
    def newest(self) -> Sample | None:
        """The newest sample; None if there is no sample."""
        if self._newest is None and self.count:
            self._newest = self._sample(self.count - 1)
        return self._newest

    def at(self, time: Stamp) -> Sample:
        """Return the interpolated pose at a time, or NO_POSE if there is no data at that time.

        For time 0, return the newest pose.

        Between two samples with different parents, return the pose of the older sample unchanged.
        """
        newest = self.newest_stamp
        if not self.oldest_stamp < time < newest:
            if time == newest or time == 0:
                return self._newest or self.newest or NO_POSE
            if time == self.oldest_stamp and self.count:
                return self._sample(self.start)
            return NO_POSE
        # Most lookups are between the last two samples. Without this cached pair, latest and
        # recent lookups are an eighth slower.
        pair = self._newest_pair
        if pair is None:
            pair = self._newest_pair = _unpack_pair(self.records, RECORD * (self.count - 2))
        if time < pair[0]:
            # Samples arrive almost periodically: guess the index, and search if the guess is wrong.
            try:
                guess = self.start + (time - self.oldest_stamp) // self.period
                pair = _unpack_pair(self.records, RECORD * guess)
            except (struct.error, OverflowError):
                # The guess is after the last record, where records are missing or free (stamp 0).
                pair = _unpack_pair(self.records, RECORD * self.index(time))
            if not pair[0] <= time < pair[8]:
                pair = _unpack_pair(self.records, RECORD * self.index(time))
        if self.mixed and self.parent_changes_after(time):
            return pair[1:8]
        return poses.interpolate(pair, time)

    def parent_at(self, time: Stamp) -> int:
        """Return the number of the parent at a time; NO_PARENT without data.

        The last sample at or before the time has this parent. For time 0, return the newest parent.
        """
        if time == self.newest_stamp or time == 0:
            return self.parent
        if not self.count or not self.oldest_stamp <= time < self.newest_stamp:
            return NO_PARENT
        if not self.mixed:
            return self.parent
        return self._parent(self.start if time == self.oldest_stamp else self.index(time))

    def stamp_at(self, time: Stamp) -> Stamp:
        """Return the stamp of the older of the two samples that are interpolated at a time."""
        if time == self.newest_stamp or time == 0:
            return self.newest_stamp
        return self._stamp(self.index(time)) if time > self.oldest_stamp else self.oldest_stamp

    def refusal(self, time: Stamp) -> Refusal:
        """Return the reason why there is no pose at a time, with the nearest stamp."""
        if len(self) <= 1:
            return NO_DATA, self.newest_stamp
        if time > self.newest_stamp:
            return FORWARD, self.newest_stamp
        return BACKWARD, self.oldest_stamp

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Return every sample, newest first, as (stamp, parent's number, pose)."""
        return [
            (self._stamp(index), self._parent(index), self._sample(index))
            for index in range(self.count - 1, self.start - 1, -1)
        ]

    def columns(self) -> "Columns":
        """Return the records and origins of all samples, oldest first; see `Columns`.

        The records are a view, not a copy. While the view exists, an insertion writes into a copy
        of the array. If another thread inserts or prunes during the call, the function notices
        changed fields after taking the view, and tries again.
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
        """Return the numbers of all parents in the stored samples."""
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
        """Return the index of the last sample at or before `time`.

        `time` must be before the newest, but not before the oldest stamp. The index is guessed from
        the mean rate and corrected once. Only a wrong guess needs a search.
        """
        records = self.records
        # The stamp at `low` is not after the time; the stamp at `high` is after it.
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

    # Insertion

    def insert(self, stamp: Stamp, origin: int, pose: Any, validated: bool = False) -> int:
        """Prune the samples that are older than the limit, and insert one sample.

        Args:
            stamp: Nanoseconds.
            origin: Numbers of the parent and the authority in one integer.
            pose: Position and quaternion in xyzw order, as received: the quaternion may have any
                length and either sign.
            validated: Whether the caller has checked stamp and numbers, and scaled the quaternion
                to unit length, with the sign that tf2 computes.

        Returns:
            TOO_OLD if the sample is older than the limit; KNOWN if an equal sample is stored;
            PARENT_CHANGED if the sample is the first, or has another parent than the newest sample;
            else STORED. NEEDS_CHECK, with nothing changed, if the stamp is not an `int` or the pose
            contains NaN or cannot be scaled.

        Raises:
            struct.error: If the stamp does not fit into 64 bits; nothing was changed.
        """
        (x, y, z), (qx, qy, qz, qw) = pose
        if not validated:
            # Comparisons with NaN are false, so this also excludes NaN and sums that overflow.
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
            # Usually each new sample prunes one old sample.
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
                # The array cannot grow: it is borrowed, or a batch reads it.
                self._splice(self.count, self.count, array("q", record))
        self.count += 1
        self.newest_stamp = stamp
        self._newest = self._newest_pair = None
        if origin is self.origin and self.origins is None:
            return STORED
        return self._append_origin(origin)

    def _insert_scaled(self, stamp: Any, origin: int, pose: Any) -> int:
        """Scale the quaternion of a sample to unit length, and insert the sample; see `insert`."""
        (x, y, z), turn = pose
        turn = quaternions.canonical(quaternions.unit(turn))
        if type(stamp) is not int or x + y + z != x + y + z or turn[3] != turn[3]:
            return NEEDS_CHECK
        return self.insert(stamp, origin, ((x, y, z), turn), True)

    def _append_origin(self, origin: int) -> int:
        """Record the origin of the last appended sample; return PARENT_CHANGED or STORED."""
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
        """Return the array `origins`; if it is None, create it with `count` equal entries."""
        origins = self.origins
        if origins is None:
            origins = self.origins = array("q", [self.origin]) * count
        return origins

    def _insert_late(self, stamp: Stamp, origin: int, record: "array[int]") -> int:
        """Insert the link's first sample, or a sample that is not newer than the newest sample."""
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
        # Limited: else, if a publisher never sets stamps, each insertion would scan all samples.
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
            # Among samples with the newest stamp, the one inserted last is the newest.
            self._newest = sample
            self.origin = origin
            if changes:
                self.parent = parent
                self._newest_parent_start = place
        elif changes and place >= self._newest_parent_start:
            self._newest_parent_start = place + 1
        return PARENT_CHANGED if changes else STORED

    def _make_room_in_front(self) -> int:
        """Return the index of a free record before the oldest sample, to insert an older sample."""
        if self.start == 0:
            room = max(_LEAST_SLACK, self.count >> _SLACK)
            self._splice(0, 0, array("q", bytes(RECORD * room)))
            if self.origins is not None:
                self.origins[0:0] = array("q", [self.origin]) * room
            self.start = room
            self.count += room
            self._newest_parent_start += room
        elif self._is_read():
            # A batch may still read the record there: a sample pruned after the batch began.
            self.records = _copied(self.records, 0, len(self.records) // WORDS)
        return self.start - 1

    def _splice(self, start: int, stop: int, words: "array[int]") -> None:
        """Replace the records from `start` up to, not including, `stop` by the records `words`."""
        where = slice(WORDS * start, WORDS * stop)
        try:
            self.records[where] = words
        except (BufferError, TypeError, ValueError):
            # A batch reads the records, or they are borrowed: change a copy. Releasing the old
            # array may run another thread, which may move the new array to large pages.
            copy = _copied(self.records, 0, len(self.records) // WORDS)
            copy[where] = words
            self.records = copy

    def _is_read(self) -> bool:
        """Whether the array of records is borrowed or read by a batch, and must not be resized."""
        try:
            self.records.append(0)
            self.records.pop()
        except (AttributeError, BufferError):
            return True
        return False

    def _have_room(self) -> None:
        """Reserve space after the newest sample, for samples that the C module inserts."""
        if self.count == len(self.records) // WORDS:
            room = max(_LEAST_ROOM, min(3 * self.count, _MOST_ROOM), self.count >> _ROOM)
            self._splice(self.count, self.count, _EMPTY * room)

    # Insertion of many samples

    def extend(self, records: "array[int]", oldest_kept: Stamp) -> None:
        """Append records with increasing stamps, and prune records before `oldest_kept`.

        All records have the same origin (parent and authority) as the existing samples. There must
        be at least one sample, and the last record must be newer than `oldest_kept`.
        """
        if self.newest_stamp < oldest_kept:
            self.replace(records, array("q", [self.origin]) * (len(records) // WORDS))
            return
        # The new records replace the free space after the newest sample.
        self._splice(self.count, len(self.records) // WORDS, records)
        self.count += len(records) // WORDS
        self._note_newest()
        if self.oldest_stamp < oldest_kept:
            self._prune(oldest_kept)

    def replace(self, records: "Words", origins: "array[int]") -> None:
        """Replace all samples by the samples in `records` (at least one), oldest first.

        Samples with equal stamps are in the order of insertion.
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
        """Use samples in another owner's array; stamps increase, and all samples have one origin.

        The array is copied only at the first insertion or pruning. Until then `records` is a
        read-only view of the array.
        """
        self.replace(memoryview(records).toreadonly(), array("q", [origin]))

    def lend(self, other: "History", origin: int, until: Stamp) -> bool:
        """Let another history use the samples up to a stamp, without a copy.

        Args:
            other: An empty history.
            origin: Origin (parent and authority) of the samples in the other history.
            until: The last stamp to share, nanoseconds.

        Returns:
            Whether the samples could be shared. False without samples, after pruning, or if the
            samples have different parents or authorities.
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
            # Both histories share the array: neither may write into it.
            shared = memoryview(self.records).toreadonly()
            self.records = cast("array[int]", shared[: WORDS * self.count])
            other.borrow(shared[: WORDS * first], origin)
        return True

    def _find_newest_parent_start(self) -> int:
        """Return the lowest index from which on all samples have the same parent."""
        if self.origins is None:
            return self.start
        first = self.count - 1
        while first > self.start and self._parent(first - 1) == self.parent:
            first -= 1
        return first

    def _note_newest(self) -> None:
        """Update the newest stamp, and drop the cached newest samples."""
        last = self.count - 1
        self.newest_stamp = self._stamp(last)
        self._newest = self._newest_pair = None

    def use_large_pages(self) -> None:
        """Move many samples into large memory pages, if the system has large pages.

        Random lookups over five links of 100 000 samples take a quarter less time. When these pages
        are full, the array grows on ordinary pages; it moves to large pages again only when it is
        twice as long.
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
            # While a view of the array exists, no other thread can resize it, but one may have
            # replaced it. From here on nothing is called or allocated that could run the garbage
            # collector, so no other thread can interrupt.
            if records is self.records:
                words[every] = view
                self.records = words

    # Pruning

    def keep_last(self, number: int) -> None:
        """Drop the oldest samples until `number` samples remain, but never fewer than two."""
        if len(self) > (number := max(2, number)):
            self._let_go(self.count - number)

    def _prune(self, oldest_kept: Stamp) -> None:
        """Drop the samples before a stamp; the newest sample always stays."""
        start = self.start + 1
        if self._stamp(start) < oldest_kept:
            # All samples with the oldest kept stamp stay.
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
                # Copy only the samples that stay.
                self.records = _copied(self.records, start, self.count)
            self.count -= start
            if self.origins is not None:
                del self.origins[:start]
                if self.origins.count(self.origin) == len(self.origins):
                    self.origins = None
            self._compact_at = max(_LEAST_SLACK, self.count >> _SLACK)
            if IS_NATIVE:
                # The space of pruned samples is used for as many new ones.
                room = array("q", bytes(RECORD * min(start, self._compact_at)))
                self._splice(self.count, len(self.records) // WORDS, room)
            self._newest_parent_start -= start
            start = 0
        self._begin(start)

    def _begin(self, start: int) -> None:
        """Make the record with index `start` the oldest sample."""
        self.start = start
        self.oldest_stamp = self._stamp(start)


def _copied(records: Words, start: int, stop: int) -> "array[int]":
    """Copy the records from `start` up to, but not including, `stop` into a new array."""
    words = records[WORDS * start : WORDS * stop]
    if isinstance(words, array):
        return words
    copy = array("q")
    copy.frombytes(words.cast("B"))
    return copy


Link: TypeAlias = StaticLink | History
"""Link of a child to its parent."""
