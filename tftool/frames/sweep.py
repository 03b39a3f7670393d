"""All frames at one moment, in one sweep."""

from typing import TypeAlias

from tftool.frames.chains import joined
from tftool.frames.forest import Forest
from tftool.frames.frame import Frame
from tftool.frames.links import IDENTITY, NO_PARENT, Link, Sample
from tftool.frames.sample import FrameInfo, Snapshot
from tftool.geometry import quaternions, rigid
from tftool.geometry.rigid import Transform
from tftool.stamps import Duration, Stamp

# tf2 divides by no less than this when it tells a rate.
_SHORTEST: Duration = 100_000

_Place: TypeAlias = tuple[int, Sample | None, Sample | None]
"""A root's number (below 0: a loop), the pose in the parent, and the pose in the root."""


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
        self.places: dict[Stamp, dict[int, _Place]] = {}
        self.latest: dict[int, tuple[Stamp, int]] = {}

    def info(self, frame: Frame, now: Stamp) -> FrameInfo:
        number, at = frame.number, self.at
        if at == 0:
            latest, newest_root = self.latest_of(number)
            root, _, pose = self.place(number, latest)
            if root != newest_root:
                # At the latest moment of the whole chain it still hung from another tree.
                root, pose = newest_root, None
            own = None if frame.link is None else frame.link.newest
        else:
            root, own, pose = self.place(number, at)
        root_name = None if root < 0 else self.frames[root].name
        root_from_frame = None if pose is None else _transform(pose)
        parent = self.parent(number, at)
        link = frame.link
        if link is None or parent < 0:
            # By place, which takes a third of the time that names take.
            return FrameInfo(
                frame.name, None, False, frame.authority,
                0, 0.0, 0, 0, 0, 0,
                rigid.IDENTITY, root_name, root_from_frame,
            )  # fmt: skip
        is_static, oldest, newest = link.is_static, link.oldest_stamp, link.newest_stamp
        age = 0 if is_static else now - newest
        return FrameInfo(
            frame.name, self.frames[parent].name, is_static, frame.authority,
            len(link), rate(link), oldest, newest, newest - oldest, age,
            None if own is None else _transform(own), root_name, root_from_frame,
        )  # fmt: skip

    def parent(self, number: int, time: Stamp) -> int:
        """The parent at that moment, or the newest one where the history does not reach."""
        link = self.frames[number].link
        if link is None or link.newest is None:
            return NO_PARENT
        if not link.mixed:
            return link.parent
        parent = link.parent_at(time)
        return link.parent if parent < 0 else parent

    def latest_of(self, number: int) -> tuple[Stamp, int]:
        """The newest moment the whole chain has data for, and its root, by newest parents."""
        chain: list[int] = []
        while True:
            known = self.latest.get(number)
            if known is not None:
                break
            if len(chain) > len(self.frames):
                known = (0, -1)
                break
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

    def place(self, number: int, time: Stamp) -> _Place:
        """Where a frame is at that moment."""
        places = self.places.get(time)
        if places is None:
            places = self.places[time] = {}
        known = places.get(number)
        if known is not None:
            return known
        chain: list[int] = []
        while known is None:
            parent = self.parent(number, time)
            if parent < 0:
                known = places[number] = (number, None, IDENTITY)
                break
            if len(chain) > len(self.frames):
                known = (-1, None, None)
                break
            chain.append(number)
            number = parent
            known = places.get(number)
        root, _, pose = known
        for number in reversed(chain):
            link = self.frames[number].link
            own = None if link is None else link.at(time)
            pose = None if own is None or pose is None else joined(pose, own)
            known = places[number] = (root, own, pose)
        return known


def _transform(sample: Sample) -> Transform:
    x, y, z, qx, qy, qz, qw = sample
    if not qw > 0.5:
        qx, qy, qz, qw = quaternions.canonical((qx, qy, qz, qw))
    return rigid.transform((x, y, z), (qx, qy, qz, qw))
