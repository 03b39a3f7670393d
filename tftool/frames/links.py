"""What joins a child to its parent: what every such link can do, and one that never changes."""

from array import array
from math import nan
from typing import Any, Final, TypeAlias

from tftool.stamps import Duration, Stamp

Sample: TypeAlias = tuple[float, float, float, float, float, float, float]
"""A pose: x, y, z in metres and a unit quaternion x, y, z, w of tf2's sign."""

# Not Final: compiled, a tuple that is takes itself for missing in other modules.
IDENTITY: Sample = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)

NOWHERE: Sample = (nan, nan, nan, nan, nan, nan, nan)
"""In place of a pose: none. A tuple of floats like any other, so compiled code need not box it."""

Refusal: TypeAlias = tuple[int, Stamp]
"""Why a link has no pose at a moment: NO_DATA, FORWARD or BACKWARD, and the stamp it does have."""

NO_PARENT: Final = -1
"""In place of a parent's number: none."""

WORDS: Final = 8
"""How many 64-bit words a record takes."""

RECORD: Final = 8 * WORDS
"""How many bytes that is."""

# Why a link has no pose at some moment.
NO_DATA: Final = 1
FORWARD: Final = 2
BACKWARD: Final = 3

# What became of an insert.
TOO_OLD: Final = 0
KNOWN: Final = 1
STORED: Final = 2
RESHAPED: Final = 3
ODD: Final = 4


class Link:
    """What joins a child to its parent.

    Attributes:
        is_static: Whether it holds at all times.
        newest_stamp: Stamp of the newest sample; 0 for a constant, and when there is none.
        oldest_stamp: Stamp of the oldest sample; 0 likewise.
        newest: The newest sample itself; None when there is none.
        previous_stamp: Of a history with two samples or more, stamp of the last but one.
        previous: That sample itself.
        parent: Number of the newest sample's parent; NO_PARENT when there is none.
        mixed: Whether samples with different parents are remembered.
        records: Of a history, oldest first: WORDS words each, a stamp and the seven numbers
            of a sample bit by bit.
        start: Number of the first record that is not forgotten.
        period: Nanoseconds from sample to sample, as last measured; where to look is guessed
            from it.
    """

    __slots__ = (
        "is_static",
        "mixed",
        "newest",
        "newest_stamp",
        "oldest_stamp",
        "parent",
        "period",
        "previous",
        "previous_stamp",
        "records",
        "start",
    )

    def __init__(self, is_static: bool) -> None:
        self.is_static: bool = is_static
        self.newest_stamp: Stamp = 0
        self.oldest_stamp: Stamp = 0
        self.newest: Sample | None = None
        self.previous: Sample | None = None
        self.previous_stamp: Stamp = 0
        self.parent: int = NO_PARENT
        self.mixed: bool = False
        # One place to look at for a stamp and its sample: long histories do not fit a cache.
        self.records: array[int] = array("q")
        self.start: int = 0
        self.period: Duration = 1

    def __len__(self) -> int:
        raise NotImplementedError

    def at(self, time: Stamp) -> Sample | None:
        """The pose at that moment (0: the newest), interpolated; None if it is refused."""
        raise NotImplementedError

    def parent_at(self, time: Stamp) -> int:
        """Number of the parent at that moment (0: the newest's); NO_PARENT if refused."""
        raise NotImplementedError

    def refusal(self, time: Stamp) -> Refusal:
        """Why there is no pose at that moment; only asked when there is none."""
        raise NotImplementedError

    def insert(self, stamp: Stamp, parent: int, sample: Any, sound: bool = False) -> int:
        """Remember a sample; says TOO_OLD, KNOWN, STORED, or RESHAPED when the parent changed.

        One that was not found `sound` before is looked at first, and may turn out ODD.
        """
        raise NotImplementedError

    def clear(self) -> None:
        """Forget what moves."""
        raise NotImplementedError

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """Every sample remembered, newest first: stamp, parent's number, pose."""
        raise NotImplementedError

    def exactly(self, time: Stamp) -> Sample | None:
        """The pose at a moment that no two samples enclose."""
        raise NotImplementedError

    def index(self, time: Stamp) -> int:
        """Where the last sample at or before a moment lies that two samples enclose."""
        raise NotImplementedError

    def parts(self, time: Stamp) -> bool:
        """Whether the two samples that enclose a moment have different parents."""
        raise NotImplementedError


class Constant(Link):
    """A link that holds at all times: one slot, overwritten."""

    __slots__ = ()

    def __init__(self) -> None:
        super().__init__(True)

    def __len__(self) -> int:
        return 1

    def at(self, time: Stamp) -> Sample | None:
        """The one pose, whatever the moment."""
        return self.newest

    def parent_at(self, time: Stamp) -> int:
        """The one parent, whatever the moment."""
        return self.parent

    def refusal(self, time: Stamp) -> Refusal:
        """Never asked for: a constant refuses nothing."""
        return NO_DATA, 0

    def insert(self, stamp: Stamp, parent: int, sample: Any, sound: bool = True) -> int:
        """Put the sample in place of the one that was there."""
        if parent == self.parent and sample == self.newest:
            return KNOWN
        self.parent = parent
        self.newest = sample
        return RESHAPED

    def clear(self) -> None:
        """Nothing: what holds at all times is not forgotten."""

    def items(self) -> list[tuple[Stamp, int, Sample]]:
        """The one sample, at stamp 0."""
        return [] if self.newest is None else [(0, self.parent, self.newest)]

    def exactly(self, time: Stamp) -> Sample | None:
        """The one pose."""
        return self.newest
