"""Path between two frames: found once, then evaluated at many times.

A path is valid while no link of it changes its parent. If a link has no data at a time, the path
has no result; a walk through the tree then finds the reason, or another path.
"""

from collections.abc import Iterable
from typing import Final, NamedTuple

from tftool.base.stamps import Stamp
from tftool.buffer.forest import FrameTree, Walk
from tftool.buffer.history import IDENTITY, LONGEST, SHORTEST, History, Link, Sample, StaticLink
from tftool.geometry import poses, quaternions
from tftool.geometry.rigid import Quaternion, Transform, Vector3

_new: Final = tuple.__new__


class Path(NamedTuple):
    """Links from the source and from the target up to their common ancestor.

    It is a tuple because the native kernel reads it by index.

    Attributes:
        up: Links from the source upward.
        down: Links from the target upward.
        moving: The links that are not static.
    """

    up: tuple[Link, ...]
    down: tuple[Link, ...]
    moving: tuple[History, ...]

    def latest(self) -> Stamp:
        """Return the newest time for which every link has data; 0 if all links are static."""
        # The minimum of the links' newest stamps; a link with stamp 0 has no sample yet.
        latest = 0
        for link in self.moving:
            stamp = link.newest_stamp
            if stamp != 0 and (stamp < latest or latest == 0):
                latest = stamp
        return latest

    def covers(self, time: Stamp) -> bool:
        """Whether every link of the path has data at a time; 0 is the newest sample."""
        for link in self.moving:
            # Most lookups request the newest stamp, so it is compared first.
            if time != link.newest_stamp and (
                not link.oldest_stamp <= time < link.newest_stamp and time != 0
            ):
                return False
        return True

    def solve(self, time: Stamp) -> Transform | None:
        """Return the pose of source in target at a time; None if a link has no data."""
        pose = chain(self.up, time)
        if self.down:
            pose = poses.between(chain(self.down, time), pose)
        x, y, z, qx, qy, qz, qw = pose
        # Usually neither function is needed: calling them each time costs 10 % of a lookup.
        if not (qw > 0.5 and SHORTEST < qx * qx + qy * qy + qz * qz + qw * qw < LONGEST):
            if qw != qw:
                return None
            # Scale to unit length, because rounding adds up over several rotating links.
            qx, qy, qz, qw = quaternions.canonical(quaternions.unit((qx, qy, qz, qw)))
        return _new(Transform, (_new(Vector3, (x, y, z)), _new(Quaternion, (qx, qy, qz, qw))))


def chain(links: tuple[Link, ...], time: Stamp) -> Sample:
    """Multiply the poses of several links, lowest first; NO_POSE if a link has no pose.

    Args:
        links: Links in order; the parent of each link is the child of the next link.
        time: Nanoseconds; 0 for each link's newest sample.

    Returns:
        The pose of the first link's child in the last link's parent.
    """
    pose: Sample | None = None
    for link in links:
        # NO_POSE is all NaN, and so is every product with it.
        pose = link.at(time) if pose is None else poses.compose(link.at(time), pose)
    return IDENTITY if pose is None else pose


def folded(links: Iterable[Link]) -> tuple[Link, ...]:
    """Merge each run of consecutive static links into one static link."""
    result: list[Link] = []
    run: list[Link] = []
    for link in links:
        if link.is_static:
            run.append(link)
            continue
        if run:
            result += _folded_run(run)
            run = []
        result.append(link)
    return tuple(result + _folded_run(run)) if run else tuple(result)


def _folded_run(run: list[Link]) -> list[Link]:
    return [StaticLink(chain(tuple(run), 0))] if len(run) > 1 else run


def path_of(tree: FrameTree, walk: Walk) -> Path:
    """Return the path found by a walk that reached a common ancestor."""
    frames = tree.frames
    up = folded([link for number in walk.up if (link := frames[number].link) is not None])
    down = folded([link for number in walk.down if (link := frames[number].link) is not None])
    return Path(up, down, tuple([link for link in up + down if isinstance(link, History)]))
