"""All frames at one moment, in one sweep."""

from tftool.frames.chains import joined
from tftool.frames.forest import Forest
from tftool.frames.frame import Frame
from tftool.frames.links import IDENTITY, Link, Sample
from tftool.frames.sample import FrameInfo, Snapshot
from tftool.geometry import rigid
from tftool.geometry.rigid import Transform
from tftool.stamps import Duration, Stamp

# tf2 divides by no less than this when it tells a rate.
_SHORTEST: Duration = 100_000


def snapshot(forest: Forest, now: Stamp, at: Stamp) -> Snapshot:
    """Every frame at one moment; 0 for each at the latest moment its chain has data for."""
    sweep = _Sweep(forest, at)
    return Snapshot(now, at, tuple(sweep.info(frame, now) for frame in forest.frames))


def rate(link: Link) -> float:
    """Samples per second by tf2's formula, in hertz: 10000 for a single one and for constants."""
    span = max(link.newest_stamp - link.oldest_stamp, _SHORTEST)
    return len(link) * 1e9 / span


class _Sweep:
    """The poses found so far; each chain is walked once for each moment it is needed at."""

    def __init__(self, forest: Forest, at: Stamp) -> None:
        self.frames = forest.frames
        self.at = at
        self.poses: dict[tuple[int, Stamp], tuple[int, Sample | None]] = {}
        self.latest: dict[int, tuple[Stamp, int]] = {}

    def info(self, frame: Frame, now: Stamp) -> FrameInfo:
        link = frame.link
        parent = self.parent(frame.number, self.at)
        latest, newest_root = self.latest_of(frame.number)
        root, pose = self.pose(frame.number, self.at or latest)
        if self.at == 0 and root != newest_root:
            # At the latest moment of the whole chain it still hung from another tree.
            root, pose = newest_root, None
        root_name = None if root < 0 else self.frames[root].name
        root_from_frame = None if pose is None else _transform(pose)
        if link is None or link.newest is None:
            return FrameInfo(
                frame=frame.name,
                parent=None,
                is_static=False,
                authority=frame.authority,
                samples=0,
                rate=0.0,
                oldest=0,
                newest=0,
                buffer_length=0,
                age=0,
                transform=rigid.IDENTITY,
                root=root_name,
                root_from_frame=root_from_frame,
            )
        own = link.at(self.at)
        return FrameInfo(
            frame=frame.name,
            parent=self.frames[parent].name,
            is_static=link.is_static,
            authority=frame.authority,
            samples=len(link),
            rate=rate(link),
            oldest=link.oldest_stamp,
            newest=link.newest_stamp,
            buffer_length=link.newest_stamp - link.oldest_stamp,
            age=0 if link.is_static else now - link.newest_stamp,
            transform=None if own is None else _transform(own),
            root=root_name,
            root_from_frame=root_from_frame,
        )

    def parent(self, number: int, time: Stamp) -> int:
        """The parent at that moment, or the newest one where the history does not reach."""
        link = self.frames[number].link
        if link is None or link.newest is None:
            return -1
        parent = link.parent_at(time)
        return link.parent if parent < 0 else parent

    def latest_of(self, number: int) -> tuple[Stamp, int]:
        """The newest moment the whole chain has data for, and its root, by newest parents."""
        chain: list[int] = []
        seen: set[int] = set()
        while True:
            known = self.latest.get(number)
            if known is not None:
                break
            if number in seen:
                known = (0, -1)
                break
            seen.add(number)
            parent = self.parent(number, 0)
            if parent < 0:
                known = self.latest[number] = (0, number)
                break
            chain.append(number)
            number = parent
        latest, root = known
        for number in reversed(chain):
            link = self.frames[number].link
            stamp = 0 if link is None else link.newest_stamp
            if stamp != 0 and (latest == 0 or stamp < latest):
                latest = stamp
            self.latest[number] = (latest, root)
        return latest, root

    def pose(self, number: int, time: Stamp) -> tuple[int, Sample | None]:
        """The root at that moment (below 0: a loop), and the pose in it if it is known."""
        chain: list[int] = []
        seen: set[int] = set()
        while True:
            known = self.poses.get((number, time))
            if known is not None:
                break
            if number in seen:
                known = (-1, None)
                break
            parent = self.parent(number, time)
            if parent < 0:
                known = self.poses[number, time] = (number, IDENTITY)
                break
            seen.add(number)
            chain.append(number)
            number = parent
        root, pose = known
        for number in reversed(chain):
            link = self.frames[number].link
            own = None if link is None else link.at(time)
            pose = None if own is None or pose is None else joined(pose, own)
            self.poses[number, time] = (root, pose)
        return root, pose


def _transform(sample: Sample) -> Transform:
    x, y, z, qx, qy, qz, qw = sample
    return rigid.canonical(rigid.transform((x, y, z), (qx, qy, qz, qw)))
