"""Frames by name and number, and what each hangs by: a forest that changes over time."""

from tftool.frames.frame import Frame
from tftool.frames.history import History
from tftool.frames.links import NO_PARENT, Constant
from tftool.stamps import Duration, Stamp

MAX_DEPTH = 1000
"""How many links one side of a walk may have; beyond it, tf2 takes the tree for a loop."""

# How a walk ended.
ARRIVED = 0
UNCONNECTED = 1
REFUSED = 2
LOOP = 3


class Walk:
    """How a question about two frames went, by parents alone.

    Attributes:
        ended: ARRIVED, UNCONNECTED, REFUSED or LOOP.
        up: Frames whose links lead from the source toward the meeting point.
        down: The same from the target.
        top: Where the source's side ended.
        end: Where the target's side ended.
        refused: The frame whose link has nothing for the moment, if REFUSED.
        timeless: Whether it would go the same way at any moment: nothing was refused, and
            no link that was passed leads elsewhere at times.
    """

    __slots__ = ("down", "end", "ended", "refused", "timeless", "top", "up")

    def __init__(self, source: int, target: int) -> None:
        self.ended = UNCONNECTED
        self.up: list[int] = []
        self.down: list[int] = []
        self.top = source
        self.end = target
        self.refused = NO_PARENT
        self.timeless = True

    def close(self, ended: int) -> "Walk":
        """Note how it ended; where both sides share their upper part, let go of that."""
        self.ended = ended
        if ended == ARRIVED:
            up, down = self.up, self.down
            while up and down and up[-1] == down[-1]:
                del up[-1], down[-1]
        return self

    def visited(self) -> list[int]:
        """Every frame that was looked at."""
        return [*self.up, *self.down, self.top, self.end]


class Forest:
    """All frames, by name and by number.

    Attributes:
        frames: In the order in which they were first registered.
        numbers: Each frame's place in that order.
        moving: The frames whose link moves, by name, for those who send them again.
    """

    __slots__ = ("_limit", "frames", "moving", "numbers")

    def __init__(self, limit: Duration) -> None:
        self._limit = limit
        self.frames: list[Frame] = []
        self.numbers: dict[str, int] = {}
        self.moving: dict[str, Frame] = {}

    # Growing

    def register(self, name: str) -> Frame:
        """The frame of that name, made when it first comes up."""
        number = self.numbers.get(name)
        if number is not None:
            return self.frames[number]
        frame = Frame(name, len(self.frames))
        self.numbers[name] = frame.number
        self.frames.append(frame)
        return frame

    def has_room(self, child: str, parent: str, limit: int) -> bool:
        """Whether both names are known, or fit in without there being more than `limit`."""
        new = (child not in self.numbers) + (parent not in self.numbers)
        return new == 0 or len(self.frames) + new <= limit

    def hang(self, child: str, parent: str, static: bool) -> bool:
        """Make sure that a child has a link of this kind, and note whom it hangs from.

        A link of the other kind is replaced by an empty one, and all it held is gone.

        Returns:
            Whether the link is a new one.
        """
        frame = self.register(child)
        link = frame.link
        fresh = link is None or link.is_static != static
        if fresh and static:
            frame.link = Constant()
            self.moving.pop(child, None)
        elif fresh:
            frame.link = frame.history = History(self._limit)
            self.moving[child] = frame
        above = self.register(parent)
        frame.parent_name = above.name
        frame.parent_number = above.number
        return fresh

    # Asking

    def newest_stamp(self, number: int) -> Stamp:
        """Stamp of a frame's newest sample; 0 if it has none, or holds at all times."""
        link = self.frames[number].link
        return 0 if link is None else link.newest_stamp

    def walk(self, target: int, source: int, time: Stamp) -> Walk:
        """Look for the way from source to target at one moment (0: by each newest sample).

        As tf2 does it: up from the source, to the root unless it meets the target or a
        link that has nothing for the moment; then up from the target until it meets
        where the source's side ended, or the source itself. Missing data above the
        meeting point does not matter.
        """
        walk = Walk(source, target)
        frames, up, down = self.frames, walk.up, walk.down
        refused = NO_PARENT
        frame = source
        while True:
            link = frames[frame].link
            if link is None:
                break
            parent = link.parent
            if link.mixed or not (link.oldest_stamp <= time <= link.newest_stamp or time == 0):
                parent = link.parent_at(time)
                walk.timeless = walk.timeless and not link.mixed
            if parent < 0:
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
        if refused >= 0:
            walk.refused = refused
            return walk.close(REFUSED)
        return walk.close(UNCONNECTED)

    def latest_common(self, target: int, source: int) -> tuple[int, Stamp]:
        """The newest moment for which every link between two frames has data.

        Stamps of 0 do not count: that is how links that hold at all times drop out.

        Returns:
            How it ended (ARRIVED, UNCONNECTED or LOOP), and the stamp; 0 where no link
            has one.
        """
        if target == source:
            return ARRIVED, self.newest_stamp(target)
        frames = self.frames
        # Up from the source, by each newest sample: stamps, and where each link leads.
        stamps: list[Stamp] = []
        parents: dict[int, int] = {}
        frame = source
        while True:
            link = frames[frame].link
            if link is None or link.newest is None:
                break
            stamps.append(link.newest_stamp)
            frame = link.parent
            if frame == target:
                return ARRIVED, _oldest(stamps)
            if len(stamps) > MAX_DEPTH:
                return LOOP, 0
            parents[frame] = len(stamps)
        # Then up from the target, until something the source hangs from.
        ours: list[Stamp] = []
        frame = target
        while True:
            link = frames[frame].link
            if link is None or link.newest is None:
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
    return min((stamp for stamp in stamps if stamp), default=0)
