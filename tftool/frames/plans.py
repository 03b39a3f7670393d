"""The way from one frame to another, worked out once and walked many times.

A plan holds while no link changes whom it leads to. Where a link has nothing for a
moment, a plan answers nothing: the forest's walk then says why, or finds a way that a
plan cannot know.
"""

from collections.abc import Iterable
from typing import Final

from tftool.frames.chains import chained
from tftool.frames.forest import Forest, Walk
from tftool.frames.links import Constant, Link
from tftool.geometry import quaternions
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.stamps import Stamp

# So many pairs of frames are remembered; a program that asks for more than this in turn
# pays for each plan anew rather than with memory.
MOST_PLANS: Final = 20_000

_new: Final = tuple.__new__


class Plan:
    """The links from source up to where the two sides meet, and from target up to there.

    Attributes:
        up: Links from the source upward.
        down: Links from the target upward.
        moving: Those of them that are no constants.
    """

    __slots__ = ("down", "moving", "up")

    def __init__(self, up: Iterable[Link], down: Iterable[Link]) -> None:
        self.up = folded(up)
        self.down = folded(down)
        self.moving = tuple([link for link in self.up + self.down if not link.is_static])

    def latest(self) -> Stamp:
        """The newest moment for which every link has data; 0 if none of them moves."""
        latest = 0
        for link in self.moving:
            stamp = link.newest_stamp
            if stamp != 0 and (stamp < latest or latest == 0):
                latest = stamp
        return latest

    def covers(self, time: Stamp) -> bool:
        """Whether every link has data at that moment."""
        for link in self.moving:
            if time != link.newest_stamp and (
                not link.oldest_stamp <= time < link.newest_stamp and time != 0
            ):
                return False
        return True

    def solve(self, time: Stamp) -> Transform | None:
        """The pose of source in target at that moment, or None if a link has none for it."""
        x, y, z, qx, qy, qz, qw = chained(self.up, time)
        if self.down:
            ux, uy, uz, vx, vy, vz, vw = chained(self.down, time)
            # The inverse of the target's side. The difference is turned, not the two ends:
            # where they are equal, the answer is zero to the last bit.
            x -= ux
            y -= uy
            z -= uz
            cx = 2.0 * (vz * y - vy * z)
            cy = 2.0 * (vx * z - vz * x)
            cz = 2.0 * (vy * x - vx * y)
            x += vw * cx - vy * cz + vz * cy
            y += vw * cy - vz * cx + vx * cz
            z += vw * cz - vx * cy + vy * cx
            qx, qy, qz, qw = (
                vw * qx - vx * qw - vy * qz + vz * qy,
                vw * qy - vy * qw - vz * qx + vx * qz,
                vw * qz - vz * qw - vx * qy + vy * qx,
                vw * qw + vx * qx + vy * qy + vz * qz,
            )

        # quaternions.canonical, written out for the usual case.
        if qw * qw > 0.25:
            if qw < 0.0:
                qx, qy, qz, qw = -qx, -qy, -qz, -qw
        elif qw != qw:
            return None
        else:
            qx, qy, qz, qw = quaternions.canonical((qx, qy, qz, qw))
        return _new(Transform, (_new(Vector3, (x, y, z)), _new(Quaternion, (qx, qy, qz, qw))))


def folded(links: Iterable[Link]) -> tuple[Link, ...]:
    """The same links with each run of constants made one."""
    result: list[Link] = []
    run: list[Link] = []
    for link in links:
        if link.is_static:
            run.append(link)
            continue
        if run:
            result.append(_one(run))
            run = []
        result.append(link)
    if run:
        result.append(_one(run))
    return tuple(result)


def _one(run: list[Link]) -> Link:
    if len(run) == 1:
        return run[0]
    constant = Constant()
    whole = chained(tuple(run), 0)
    constant.newest = None if whole[6] != whole[6] else whole
    return constant


def plan_of(forest: Forest, walk: Walk) -> Plan:
    """The plan for a walk that arrived."""
    frames = forest.frames
    up = [frames[number].link for number in walk.up]
    down = [frames[number].link for number in walk.down]
    return Plan(
        [link for link in up if link is not None], [link for link in down if link is not None]
    )
