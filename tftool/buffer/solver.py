"""Solver of lookups: walks the trees, caches paths for the next lookup, computes velocities."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds, whole
from tftool.buffer import forest as tree
from tftool.buffer import refusals, snapshot
from tftool.buffer.callbacks import AVAILABLE, EXPIRED, PENDING, Lookup
from tftool.buffer.forest import ARRIVED, LOOP, REFUSED, FrameTree, Walk
from tftool.buffer.history import IDENTITY, LONGEST, SHORTEST, History, Link, Sample, StaticLink
from tftool.geometry import conversions, poses, quaternions
from tftool.geometry.quaternions import Triple
from tftool.geometry.rigid import Quaternion, Transform, Vector3

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer


_new: Final = tuple.__new__


class Path(NamedTuple):
    """Path between two frames: the links (each frame's pose in its parent) to the common ancestor.

    A path is a tuple because the native kernel reads its fields by index.

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
        """Whether every link of the path has data at a time; always true for time 0 (newest)."""
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
    """Replace consecutive static links by one static link with the product of their poses."""
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


@dataclass(frozen=True, slots=True)
class Velocity:
    """Linear and angular velocity of one frame relative to another.

    Attributes:
        stamp: Middle of the averaging interval, nanoseconds.
        frame: The frame in which both vectors are expressed.
        body: The frame that moves.
        linear: Metres per second.
        angular: Radians per second.
    """

    stamp: Stamp
    frame: str
    body: str
    linear: Vector3
    angular: Vector3


def full(
    buffer: "Buffer",
    tracking: str,
    observation: str,
    reference: str,
    point: Triple,
    point_frame: str,
    time: Stamp,
    interval: Duration,
) -> Velocity:
    """Return the velocity that tf2's `lookup_velocity_full` computes, including tf2's mistakes.

    The result is a spatial twist if the reference does not rotate relative to the tracked frame.
    Otherwise tf2 applies the wrong rotation to the vectors, and moves the reference point with an
    element-wise product instead of a cross product. `twist` makes neither mistake.

    Raises:
        TransformException: If one of the lookups fails.
        TypeError: If the time or the interval is not a whole number.
    """
    # As in tf2, times are converted to float seconds, which rounds them.
    at, over = as_seconds(whole(time)), as_seconds(whole(interval))
    end = min(at + over * 0.5, as_seconds(buffer.newest_common(observation, tracking)))
    start = max(0.00001 + over, end) - over
    duration = end - start
    first = buffer.lookup_transform(observation, tracking, seconds(start)).transform
    last = buffer.lookup_transform(observation, tracking, seconds(end)).transform
    v, w = _difference(first, last, duration)

    reference_from_body = buffer.lookup_transform(reference, tracking, time).transform
    origin = reference_from_body.translation
    w = reference_from_body.rotate(w)
    v = reference_from_body.rotate(v) + origin.cross(w)
    place = buffer.lookup_transform(reference, point_frame, time).transform.apply(point)
    shift = place - origin
    v += Vector3(w.x * shift.x, w.y * shift.y, w.z * shift.z)
    return Velocity(seconds(start + over * 0.5), reference, tracking, v, w)


def twist(
    buffer: "Buffer", tracking: str, observation: str, time: Stamp, interval: Duration
) -> Velocity:
    """Return the velocity of `tracking` relative to `observation`, in the axes of `observation`.

    The result is the mean over `interval` around `time`, or over the part of the interval for which
    the buffer has data.

    Raises:
        TransformException: If a lookup at an end of the interval fails.
        TypeError: If the time or the interval is not a whole number.
        ValueError: If the interval is not positive.
    """
    time, interval = whole(time), whole(interval)
    if interval <= 0:
        raise ValueError(f"a velocity needs a positive interval, not {interval} ns")
    newest = buffer.newest_common(observation, tracking)
    middle = time or newest
    end = min(middle + interval // 2, newest) if newest else middle + interval // 2
    start = max(1, end - interval)
    first = buffer.lookup_transform(observation, tracking, start).transform
    last = buffer.lookup_transform(observation, tracking, end).transform
    v, w = _difference(first, last, as_seconds(end - start))
    return Velocity((start + end) // 2, observation, tracking, v, w)


def _difference(first: Transform, last: Transform, duration: float) -> tuple[Vector3, Vector3]:
    """Return the mean velocities between two poses in one parent, `duration` seconds apart."""
    if duration == 0.0:
        unknown = Vector3(math.nan, math.nan, math.nan)
        return unknown, unknown
    turn = quaternions.multiply(quaternions.conjugate(first.rotation), last.rotation)
    axis, angle = conversions.axis_angle_from_quaternion(turn)
    return (
        (last.translation - first.translation) / duration,
        first.rotate(axis) * (angle / duration),
    )


MOST_PATHS: Final = 20_000
"""Maximum number of cached paths, which limits memory; with more pairs of frames in turn, each
path is computed again.
"""

_LOOKUP = "lookupTransform"

_HERE: Final = Path((), (), ())


class Solver:
    """Solver of lookups between two frames of one tree, with a cache of paths.

    Attributes:
        paths: Cached paths by target and then by source; cleared when a frame gets another parent.
    """

    __slots__ = ("_cache_time", "_kept", "_tree", "paths")

    def __init__(self, tree: FrameTree, cache_time: Duration) -> None:
        self._tree = tree
        self._cache_time = cache_time
        self.paths: dict[str, dict[str, Path]] = {}
        self._kept = 0

    def pose(self, target: str, source: str, time: Stamp) -> tuple[Stamp, Sample]:
        """Search the path; return the time of the result, and the pose of source in target.

        Raises:
            TransformException: As in `Buffer.lookup_transform`.
        """
        time, path, _ = self.find_path(target, source, time)
        pose = path.solve(time)
        assert pose is not None, "a link with a parent at a time has a pose at that time"
        return time, (*pose.translation, *pose.rotation)

    def find_path(self, target: str, source: str, time: Stamp) -> tuple[Stamp, Path, bool]:
        """Return the path from source to target at a time; 0 means the latest common time.

        Returns:
            The time of the lookup, the path, and whether the path is now in the cache.

        Raises:
            TransformException: As in `Buffer.lookup_transform`.
        """
        trees = self._tree
        if target == source:
            if time == 0:
                number = trees.numbers.get(target)
                time = 0 if number is None else trees.newest_stamp(number)
            return time, _HERE, False
        target_number = self.number(target, "target_frame", _LOOKUP, target, source)
        source_number = self.number(source, "source_frame", _LOOKUP, target, source)
        # 0 means the latest time at which the whole chain has data.
        time = time or self.latest_common(target_number, source_number)
        walk = trees.walk(target_number, source_number, time)
        if walk.ended != ARRIVED:
            raise self._refusal(walk, time, target, source)
        path = path_of(trees, walk)
        return time, path, self._remember(target_number, source_number, walk, path)

    def latest_common(self, target: int, source: int) -> Stamp:
        """Return the newest time with data for all links between two frames; 0 if all are static.

        Raises:
            TransformException: If no chain joins the frames, or a chain contains a loop.
        """
        # Like tf2, find the latest common time before the walk: its errors come first.
        ended, latest = self._tree.latest_common(target, source)
        if ended == ARRIVED:
            return latest
        frames = self._tree.frames
        target_name, source_name = frames[target].name, frames[source].name
        if ended == LOOP:
            raise self._looped(target_name, source_name)
        raise refusals.unconnected(target_name, source_name)

    def why_not(self, target: str, source: str, time: Stamp) -> str | TransformException | None:
        """Return tf2's reason why a lookup would fail; None if the lookup would succeed."""
        if target == source:
            return None
        for frame, argument in ((target, "target_frame"), (source, "source_frame")):
            if why := self.fault(frame):
                return refusals.invalid_frame(frame, argument, why)
        numbers = self._tree.numbers
        target_number, source_number = numbers[target], numbers[source]
        try:
            time = time or self.latest_common(target_number, source_number)
        except TransformException as refused:
            return refused
        walk = self._tree.walk(target_number, source_number, time)
        if walk.ended == ARRIVED:
            self._remember(target_number, source_number, walk, path_of(self._tree, walk))
            return None
        return self._refusal(walk, time, target, source)

    def chain(self, target: str, source: str, time: Stamp) -> list[str]:
        """Return the frame names from source to target, inclusive; [] if both names are equal."""
        if target == source:
            return []
        time, _, _ = self.find_path(target, source, time)
        trees = self._tree
        walk = trees.walk(trees.numbers[target], trees.numbers[source], time)
        # The two sides meet in the parent of the last link of each side.
        link = trees.frames[(walk.up or walk.down)[-1]].link
        meeting = -1 if link is None else link.parent_at(time)
        return [trees.frames[number].name for number in (*walk.up, meeting, *walk.down[::-1])]

    def examine(self, lookup: Lookup, first: bool) -> tuple[int, tuple[str, ...]]:
        """Return the state of a lookup (AVAILABLE, EXPIRED or PENDING), and the frames to watch.

        Args:
            lookup: Target, source and time.
            first: Whether the lookup was not examined before.

        Returns:
            The state, and the names of frames whose change may end the state PENDING.
        """
        target, source, time = lookup
        if target == source:
            return AVAILABLE, ()
        trees = self._tree
        for name in (target, source):
            if name not in trees.numbers:
                # The lookup cannot succeed before a frame with this name appears.
                return PENDING, (name,)
        target_number, source_number = trees.numbers[target], trees.numbers[source]
        # A request fails finally only when the chain's data is newer by more than the cache time.
        ended, latest = trees.latest_common(target_number, source_number)
        # A request for the latest transform never becomes too old.
        expired = latest != 0 and time != 0 and time + self._cache_time < latest
        if expired and not first:
            return EXPIRED, ()
        walk = trees.walk(target_number, source_number, time or latest)
        if walk.ended == ARRIVED and (time != 0 or ended == ARRIVED):
            return AVAILABLE, ()
        if expired:
            return EXPIRED, ()
        # Watch both paths, because the frame without data may have another parent at the newest
        # time.
        newest = trees.walk(target_number, source_number, 0)
        seen = dict.fromkeys([*walk.visited(), *newest.visited()])
        return PENDING, tuple(trees.frames[number].name for number in seen)

    def number(self, frame: str, argument: str, call: str, target: str, source: str) -> int:
        """Return the number of a frame in the tree.

        Raises:
            TransformException: If the frame name is invalid, or unknown.
        """
        if why := tree.fault(frame):
            raise refusals.invalid(frame, argument, call, why, target=target, source=source)
        number = self._tree.numbers.get(frame)
        if number is None:
            raise refusals.unknown(
                frame, argument, call, self._tree.numbers.keys(), target=target, source=source
            )
        return number

    def fault(self, frame: str) -> str:
        """Return `can_transform`'s sentence about an invalid or unknown frame name; else ""."""
        if why := tree.fault(frame):
            return why
        return "" if frame in self._tree.numbers else "frame does not exist"

    def drop_paths(self) -> None:
        """Remove every path from the cache."""
        # Called at every change of the tree, usually with an empty cache.
        if self._kept:
            self.paths.clear()
            self._kept = 0

    def _remember(self, target: int, source: int, walk: Walk, path: Path) -> bool:
        """Cache a path for later lookups, if no frame on the path ever has another parent.

        Returns:
            Whether the path was cached.
        """
        trees = self._tree
        if not walk.timeless:
            # Links with other parents or without data may be above the common ancestor.
            walk = trees.walk(target, source, 0)
            if walk.ended != ARRIVED or not trees.is_steady(walk):
                return False
            path = path_of(trees, walk)
        for link in path.moving:
            # A pair of frames that was looked up once will probably be looked up again.
            if link.count >= link.large_from:
                link.use_large_pages()
        # Drop all paths at once: finding the least used one would cost more than it saves.
        if self._kept >= MOST_PATHS:
            self.drop_paths()
        self.paths.setdefault(trees.frames[target].name, {})[trees.frames[source].name] = path
        self._kept += 1
        return True

    def _refusal(self, walk: Walk, time: Stamp, target: str, source: str) -> TransformException:
        """Return the exception that explains why a walk found no path from source to target."""
        if walk.ended == LOOP:
            return self._looped(target, source)
        if walk.ended == REFUSED:
            frame = self._tree.frames[walk.refused]
            assert isinstance(frame.link, History), "a static link refuses nothing"
            return refusals.extrapolation(
                frame.link.refusal(time), frame.name, time, target, source
            )
        return refusals.unconnected(target, source)

    def _looped(self, target: str, source: str) -> TransformException:
        frames = snapshot.as_string(snapshot.snapshot(self._tree, 0, 0).frames)
        return refusals.loop(frames, target, source)
