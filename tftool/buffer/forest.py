"""Frames by name and number, each with the link to its parent; the parent may change over time.

This module finds the links between two frames at a time, and the latest time at which all of these
links have data. The module `solver` computes poses.

As in tf2, an insertion removes one leading slash of a frame name, because old publishers still send
the slash. A lookup refuses the slash as a mistake in the calling program.
"""

from collections.abc import Iterable
from typing import TypeAlias

from tftool.base.stamps import Duration, Stamp
from tftool.buffer.history import AUTHORITY_SHIFT, NO_PARENT, History, Link, StaticLink

NO_PARENT_NAME = "NO_PARENT"
"""The name that tf2 reserves for the parent of a root."""

EMPTY = "in tf2 frame_ids cannot be empty"
SLASHED = "in tf2 frame_ids cannot start with a '/'"

MAX_DEPTH = 1000
"""Maximum number of links on one side of a walk; for a longer walk tf2 reports a loop."""

# Outcomes of a walk.
ARRIVED = 0
UNCONNECTED = 1
REFUSED = 2
LOOP = 3


MAX_AUTHORITIES = 65_536
"""Maximum number of stored authorities; samples of further authorities have no sender's name."""


def stripped(name: str) -> str:
    """Return a frame name as the buffer stores it: a plain `str` without one leading slash.

    Raises:
        TypeError: If the name is not a string.
    """
    name = plain(name)
    return name[1:] if name.startswith("/") else name


def plain(name: str) -> str:
    """Return a frame name as an object of exactly the class `str`.

    A subclass of `str` may define its own `__eq__` and `__hash__`. If a dictionary key were of this
    subclass, each lookup would run these methods, which could change the data being read.

    Raises:
        TypeError: If the name is not a string.
    """
    if name.__class__ is str:
        return name
    require_text(name)
    return str.__str__(name)


def fault(name: str) -> str:
    """Return tf2's sentence why a frame name is invalid; "" if the name is valid.

    Raises:
        TypeError: If the name is not a string.
    """
    name = plain(name)
    if not name:
        return EMPTY
    if name.startswith("/"):
        return SLASHED
    return ""


def require_text(*names: object) -> None:
    """Raise an error unless all given frame names are strings.

    Raises:
        TypeError: If a name is not a string.
    """
    for name in names:
        if not isinstance(name, str):
            raise TypeError(f"a frame's name is a string, not {name!r}")


class Frame:
    """One named frame and its link to its parent.

    Attributes:
        name: Name of the frame.
        number: Index of the frame in `FrameTree.frames`.
        link: Link to the parent, with the samples; None if no sample was ever set.
        authority: Sender of the newest sample; None if no sample was ever set.
    """

    __slots__ = ("authority", "link", "name", "number")

    def __init__(self, name: str, number: int) -> None:
        self.name = name
        self.number = number
        self.link: Link | None = None
        self.authority: str | None = None


Sender: TypeAlias = tuple[str, str | None, int, History]
"""Parent, authority, origin and history of the newest sample of a moving link.

The next sample usually has the same parent and authority, and needs no search. The value is a plain
tuple, because a named tuple takes twice the time to unpack. The native kernel also reads the tuple.
"""


class Walk:
    """Path between two frames, found by following links from child to parent.

    Attributes:
        ended: Outcome of the search: ARRIVED, UNCONNECTED, REFUSED (missing data) or LOOP.
        up: Child frames of the links from the source up to the common ancestor.
        down: Child frames of the links from the target up to the common ancestor.
        top: Last frame reached by going up from the source.
        end: Last frame reached by going up from the target.
        refused: Frame without data at that time, if the outcome is REFUSED.
        timeless: Whether the path is the same at every time: every visited frame had data, and
            always has the same parent.
        above: Visited frames above the common ancestor, if the outcome is ARRIVED.
    """

    __slots__ = ("above", "down", "end", "ended", "refused", "timeless", "top", "up")

    def __init__(self, source: int, target: int) -> None:
        self.ended = UNCONNECTED
        self.up: list[int] = []
        self.down: list[int] = []
        self.top = source
        self.end = target
        self.refused = NO_PARENT
        self.timeless = True
        self.above: list[int] = []

    def close(self, ended: int) -> "Walk":
        """Finish the search with an outcome; move frames above the common ancestor to `above`."""
        self.ended = ended
        if ended == ARRIVED:
            up, down = self.up, self.down
            while up and down and up[-1] == down[-1]:
                self.above.append(up.pop())
                down.pop()
        return self

    def visited(self) -> list[int]:
        """Return the numbers of all visited frames except frames above the common ancestor."""
        return [*self.up, *self.down, self.top, self.end]


class FrameTree:
    """All frames by name and by number, in any number of trees.

    Attributes:
        frames: Frames in the order of their first registration.
        numbers: Index in `frames` of each frame name.
        senders: Parent, sender and origin of the newest sample, and the history, by name of the
            moving child frame. Most insertions need no other data.
        authorities: Names of senders (authorities); the index of a name is its number.
        limit: Age up to which samples are kept, relative to the newest sample, nanoseconds.
        max_name: Maximum length of a name, bytes.
    """

    __slots__ = (
        "_authority_numbers",
        "authorities",
        "frames",
        "limit",
        "max_name",
        "numbers",
        "senders",
    )

    def __init__(self, limit: Duration, max_name: int) -> None:
        self.limit = limit
        self.max_name = max_name
        self.frames: list[Frame] = []
        self.numbers: dict[str, int] = {}
        self.senders: dict[str, Sender] = {}
        self.authorities: list[str] = [""]
        self._authority_numbers: dict[str, int] = {"": 0}

    # Frames and links are added

    def register(self, name: str) -> Frame:
        """Return the frame named `name`; create the frame if the name is new."""
        # A frame is never removed, so that its number stays valid, also in a cached path.
        number = self.numbers.get(name)
        if number is not None:
            return self.frames[number]
        frame = Frame(name, len(self.frames))
        self.numbers[name] = frame.number
        self.frames.append(frame)
        return frame

    def has_room(self, child: str, parent: str, limit: int) -> bool:
        """Whether both frame names exist, or can be added without exceeding `limit` names."""
        new = (child not in self.numbers) + (parent not in self.numbers)
        return new == 0 or len(self.frames) + new <= limit

    def hang(self, child: str, parent: str, static: bool) -> tuple[Frame, Link, bool]:
        """Register both frame names, and return the child's link, static or moving as requested.

        If the child has a moving link but a static link is requested, or the reverse, an empty
        link replaces the existing link.

        Returns:
            The child frame, its link, and whether the link is new.
        """
        frame = self.register(child)
        link = frame.link
        fresh = link is None or link.is_static != static
        if link is None or fresh:
            if static:
                link = StaticLink()
                # Else the next sample would be inserted into the history that was just replaced.
                self.senders.pop(child, None)
            else:
                link = History(self.limit)
                # No sample has this sender, so the first sample goes through all checks.
                self.senders[child] = ("", None, NO_PARENT, link)
            frame.link = link
        self.register(parent)
        return frame, link, fresh

    def note(self, frame: Frame, parent: str, authority: str, origin: int) -> None:
        """Record the parent and authority of a sample that was accepted for this frame."""
        frame.authority = authority
        if isinstance(frame.link, History):
            self.senders[frame.name] = (parent, authority, origin, frame.link)

    def origin(self, parent: str, authority: str) -> int:
        """Return the numbers of parent and authority in one integer (origin); see `history`."""
        number = self._authority_numbers.get(authority)
        if number is None:
            number = 0
            # Beyond the limit, samples are stored without the name of their sender (number 0).
            if len(self.authorities) < MAX_AUTHORITIES:
                number = self._authority_numbers[authority] = len(self.authorities)
                self.authorities.append(authority)
        return number << AUTHORITY_SHIFT | self.numbers[parent]

    # Queries

    def newest_stamp(self, number: int) -> Stamp:
        """Return the stamp of a frame's newest sample; 0 without samples or for a static link."""
        link = self.frames[number].link
        return 0 if link is None else link.newest_stamp

    def walk(self, target: int, source: int, time: Stamp) -> Walk:
        """Find the path from source to target at one time; 0 uses the newest parent of each frame.

        As in tf2, the search first goes from the source up to the target, to the root, or to a
        frame without data at that time. Then the search goes from the target up to the frame where
        the first part ended, or to the source. Missing data above the common ancestor does not
        matter.
        """
        walk = Walk(source, target)
        frames, up, down = self.frames, walk.up, walk.down
        refused = NO_PARENT
        frame = source
        # Up from the source. `walk` in `_kernel.c` does the same where every link has data.
        while True:
            link = frames[frame].link
            if link is None:
                break
            parent = link.parent
            # The newest parent holds for the whole span, unless the link has changed it (`mixed`):
            # then the path depends on the time, and must not be cached.
            if link.mixed or not (link.oldest_stamp <= time <= link.newest_stamp or time == 0):
                parent = link.parent_at(time)
                walk.timeless = walk.timeless and not link.mixed
            if parent < 0:
                # No error yet: the target may be below a frame that was passed before this one.
                refused = frame
                walk.timeless = False
                break
            if frame == target:
                walk.top = frame
                return walk.close(ARRIVED)
            up.append(frame)
            frame = parent
            if len(up) > MAX_DEPTH:
                walk.top = frame
                return walk.close(LOOP)
        walk.top = top = frame

        frame = target
        # Up from the target: here every link is below the common ancestor, and needs data.
        while frame != top:
            link = frames[frame].link
            if link is None:
                break
            parent = link.parent
            if link.mixed or not (link.oldest_stamp <= time <= link.newest_stamp or time == 0):
                parent = link.parent_at(time)
                walk.timeless = walk.timeless and not link.mixed
            if parent < 0:
                walk.end = walk.refused = frame
                return walk.close(REFUSED)
            if frame == source:
                # The source is the common ancestor: links passed above it do not matter.
                walk.above = up[:]
                up.clear()
                walk.end = frame
                return walk.close(ARRIVED)
            down.append(frame)
            frame = parent
            if len(down) > MAX_DEPTH:
                walk.end = frame
                return walk.close(LOOP)
        walk.end = frame
        if frame == walk.top:
            return walk.close(ARRIVED)
        # The sides did not meet because data was missing above the source.
        if refused >= 0:
            walk.refused = refused
            return walk.close(REFUSED)
        return walk.close(UNCONNECTED)

    def is_steady(self, walk: Walk) -> bool:
        """Whether the path that `walk` found is valid at every time with data.

        Frames above the common ancestor may change their parents. The path is still valid if no
        path through these frames can form a loop or become too long.
        """
        frames = self.frames
        for number in (*walk.up, *walk.down):
            link = frames[number].link
            if link is not None and link.mixed:
                return False
        reached: dict[int, None] = dict.fromkeys((*walk.above, walk.top))
        # If the walk up from the source met the target, nothing above the target was used.
        if not walk.down or not any(self.parents(number)[1:] for number in reached):
            return True
        # Every frame that a path may pass above, at any time.
        waiting = list(reached)
        while waiting:
            for parent in self.parents(waiting.pop()):
                if parent not in reached:
                    reached[parent] = None
                    waiting.append(parent)
        # The number of frames is a safe limit for the longest path: a loop must not be cached.
        if len(reached) + len(walk.up) + len(walk.down) > MAX_DEPTH:
            return False
        return not self._may_circle(reached)

    def parents(self, number: int) -> list[int]:
        """Return the numbers of all parents that a frame has in its stored samples."""
        link = self.frames[number].link
        if link is None:
            return []
        if link.mixed and not link.is_static:
            return list(link.parents())
        return [] if link.parent < 0 else [link.parent]

    def _may_circle(self, numbers: Iterable[int]) -> bool:
        """Whether these frames can form a loop, if each frame may have any of its parents."""
        above = {number: self.parents(number) for number in numbers}
        while above:
            # Frames without a remaining parent are on no cycle: remove them, again and again.
            ends = [number for number, up in above.items() if not any(p in above for p in up)]
            if not ends:
                return True
            for number in ends:
                del above[number]
        return False

    def latest_common(self, target: int, source: int) -> tuple[int, Stamp]:
        """Return the newest time at which every link between two frames has data.

        Links with stamp 0 (static links, for example) are always valid and are ignored.

        Returns:
            The outcome (ARRIVED, UNCONNECTED or LOOP), and the stamp; 0 if no link has a stamp.
        """
        if target == source:
            return ARRIVED, self.newest_stamp(target)
        frames = self.frames
        # Up from the source by newest parents: collect each link's newest stamp and its parent.
        stamps: list[Stamp] = []
        parents: dict[int, int] = {}
        frame = source
        while True:
            link = frames[frame].link
            if link is None or link.parent < 0:
                break
            stamps.append(link.newest_stamp)
            frame = link.parent
            if frame == target:
                return ARRIVED, _oldest(stamps)
            if len(stamps) > MAX_DEPTH:
                return LOOP, 0
            # Number of links below this frame: only these count if the target's side joins here.
            parents[frame] = len(stamps)
        # Then up from the target, until a frame that was passed from the source.
        ours: list[Stamp] = []
        frame = target
        while True:
            link = frames[frame].link
            if link is None or link.parent < 0:
                return UNCONNECTED, 0
            ours.append(link.newest_stamp)
            frame = link.parent
            if frame in parents:
                return ARRIVED, _oldest(ours + stamps[: parents[frame]])
            if frame == source:
                return ARRIVED, _oldest(ours)
            if len(ours) > MAX_DEPTH:
                return LOOP, 0


def _oldest(stamps: list[Stamp]) -> Stamp:
    # 0 is the stamp of links that are valid at all times, not the oldest time.
    return min((stamp for stamp in stamps if stamp), default=0)
