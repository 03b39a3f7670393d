"""Picture of frames relative to a fixed frame, from lookups: positions and trails."""

from collections.abc import Callable, Iterable, Mapping
from itertools import islice
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from tftool.base.color import Color
from tftool.base.errors import TransformException
from tftool.base.stamps import Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing import theme
from tftool.drawing.cells import blended, packed
from tftool.drawing.plane import FARTHEST, ColoredLines, PlaneFrame, PlanePicture
from tftool.geometry.rigid import Transform

Lookup = Callable[[str, str], Transform | None]
"""Function that returns the pose of the second frame in the first; None if unknown."""


def natural_fixed(snapshot: Snapshot, pair: tuple[str, str]) -> str:
    """Return the default fixed frame of a picture; "" if there are no frames.

    The default is the root of the tree that contains both frames of `pair`, or the root of the
    largest tree if the frames are in different trees.
    """
    if pair[0] in snapshot and pair[1] in snapshot:
        roots = {snapshot.frame(name).root for name in pair}
        (root, *others) = roots
        if root is not None and not others:
            return root
    sizes: dict[str, int] = {}
    for info in snapshot.frames:
        if info.root is not None:
            sizes[info.root] = sizes.get(info.root, 0) + 1
    return max(sizes, key=lambda root: sizes[root], default="")


def in_snapshot(snapshot: Snapshot) -> Lookup:
    """Return a function that looks up poses in `snapshot`."""

    def lookup(target: str, source: str) -> Transform | None:
        if target not in snapshot or source not in snapshot:
            return None
        to, of = snapshot.frame(target), snapshot.frame(source)
        if to.root is None or to.root != of.root or not to.root_from_frame:
            return None
        if of.root_from_frame is None:
            return None
        if target == to.root:
            return of.root_from_frame
        return to.root_from_frame.inverse() @ of.root_from_frame

    return lookup


def moving(snapshot: Snapshot, fixed: str) -> list[str]:
    """Return frames that may move relative to `fixed`; of rigidly connected frames, only one."""
    moves: dict[str, bool] = {}
    for info in snapshot.frames:
        chain: list[FrameInfo] = []
        one: FrameInfo | None = info
        while one is not None and one.frame not in moves and len(chain) <= len(snapshot.frames):
            chain.append(one)
            above = one.parent or ""
            one = snapshot.frame(above) if above in snapshot else None
        known = one is not None and moves.get(one.frame, False)
        for link in reversed(chain):
            known = known or (link.parent is not None and not link.is_static)
            moves[link.frame] = known
    all_move = moves.get(fixed, False)
    root = snapshot.frame(fixed).root if fixed in snapshot else None
    return [
        info.frame
        for info in snapshot.frames
        if info.frame != fixed
        and info.root == root
        and (all_move or moves[info.frame])
        and not (info.is_static and moves.get(info.parent or "", False))
    ]


def pictured(
    snapshot: Snapshot,
    fixed: str,
    lookup: Lookup,
    ages: Mapping[str, float],
    turtles: frozenset[str] = frozenset(),
) -> PlanePicture:
    """Return the picture of the tree that contains `fixed`, with insets of the other trees.

    Args:
        snapshot: Snapshot of the frames.
        fixed: Fixed frame of the picture.
        lookup: Function that returns the frames' poses.
        ages: Seconds since each frame's newest transform.
        turtles: Names of the frames that are drawn as turtles.
    """
    root = snapshot.frame(fixed).root if fixed in snapshot else None
    frames, nowhere = [], []
    for info in snapshot.frames:
        if info.root != root or root is None:
            continue
        pose = lookup(fixed, info.frame)
        if pose is None or not abs(pose.translation.x) + abs(pose.translation.y) <= FARTHEST:
            nowhere.append(info.frame)
            continue
        frames.append(_seen(info, pose, lookup(fixed, info.parent) if info.parent else None,
                            ages.get(info.frame, 0.0), info.frame in turtles))  # fmt: skip
    nowhere += snapshot.loops()
    others = [one for one in snapshot.roots() if one != root]
    inside = in_snapshot(snapshot)
    apart = tuple(_apart(snapshot, one, inside, ages) for one in others)
    return PlanePicture(fixed, tuple(frames), apart=apart, nowhere=tuple(nowhere))


def _apart(
    snapshot: Snapshot, root: str, lookup: Lookup, ages: Mapping[str, float]
) -> PlanePicture:
    frames = []
    for info in snapshot.frames:
        pose = lookup(root, info.frame) if info.root == root else None
        if pose is not None and abs(pose.translation.x) + abs(pose.translation.y) <= FARTHEST:
            parent = lookup(root, info.parent) if info.parent else None
            frames.append(_seen(info, pose, parent, ages.get(info.frame, 0.0), False))
    return PlanePicture(root, tuple(frames))


def _seen(
    info: FrameInfo, pose: Transform, parent: Transform | None, age: float, is_turtle: bool
) -> PlaneFrame:
    place = pose.translation
    axes = tuple(pose.rotate(axis)[:2] for axis in _AXES)
    return PlaneFrame(
        info.frame,
        place.x,
        place.y,
        axes,
        None if parent is None else (parent.translation.x, parent.translation.y),
        age,
        is_turtle,
    )


_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


PERIOD = seconds(0.1)
"""Nanoseconds between two lookups of a frame."""

REACH = seconds(30.0)
"""Nanoseconds that a trail drawn from scratch reaches back, if the buffer does."""

KEPT = seconds(60.0)
"""Nanoseconds of a trail that are stored while it is being watched."""

MOST_FRAMES = 24
"""Largest number of frames with trails."""

FADED = Color(112, 116, 130)
"""Colour of a trail as old as `REACH`, faint on light and dark backgrounds."""

STILL = 1e-6
"""Smallest motion in metres per period; below it a frame counts as still."""

GAP = seconds(1.0)
"""Longest time in nanoseconds between two positions that a line joins."""


class FrameTrails:
    """Trails of frames in one fixed frame.

    Positions are looked up in `buffer` periodically.

    Attributes:
        fixed: Fixed frame of the trails.
    """

    def __init__(self, buffer: Buffer) -> None:
        self._buffer = buffer
        self.fixed = ""
        self._paths: dict[str, FramePath] = {}
        self._next: Stamp = 0
        self._shown = ColoredLines()

    def follow(self, fixed: str, frames: Iterable[str], now: Stamp) -> ColoredLines:
        """Add the positions since the last call to the trails, and return all trails.

        Args:
            fixed: Fixed frame; if the fixed frame changes, all trails start again.
            frames: Frames with trails; only the first `MOST_FRAMES` are used.
            now: Time of the newest position to add, nanoseconds.
        """
        if fixed != self.fixed or now < self._next - 4 * PERIOD:
            self.fixed, self._paths, self._next = fixed, {}, 0
        if now >= self._next:
            self._next = now + 2 * PERIOD
            for frame in islice(frames, MOST_FRAMES):
                known = self._paths.get(frame, NOWHERE)
                start = int(known.stamps[-1]) if len(known.stamps) else 0
                new = self._path(frame, fixed, max(start, now - REACH), now)
                self._paths[frame] = known.followed_by(new)
            self._paths = {name: way.after(now - KEPT) for name, way in self._paths.items()}
            self._shown = _trails(self._paths, now)
        return self._shown

    def until(self, fixed: str, frames: Iterable[str], at: Stamp) -> ColoredLines:
        """Return the trails up to the past time `at`, from the buffer and from stored positions."""
        ways = {}
        for frame in islice(frames, MOST_FRAMES):
            way = self._path(frame, fixed, at - REACH, at)
            if fixed == self.fixed:
                # Positions that the buffer has pruned since.
                first = int(way.stamps[0]) if len(way.stamps) else at
                way = self._paths.get(frame, NOWHERE).before(first).followed_by(way)
            ways[frame] = way
        return _trails(ways, at)

    def _path(self, frame: str, fixed: str, start: Stamp, end: Stamp) -> "FramePath":
        """Look up a frame's positions in `fixed` after `start`, every `PERIOD` until `end`."""
        stamps = np.arange(start // PERIOD + 1, end // PERIOD + 1, dtype=np.int64) * PERIOD
        stamps = stamps[stamps > 0]
        if not len(stamps):
            return NOWHERE
        try:
            path = self._buffer.lookup_transforms(fixed, frame, stamps, missing="nan", threads=1)
        except TransformException:
            return NOWHERE
        holds = path.valid & (np.abs(path.translations).sum(axis=1) < FARTHEST)
        return FramePath(stamps[holds], path.translations[holds])


class FramePath(NamedTuple):
    """Path of a frame: stamps, shape (n,), and positions in metres, shape (n, 3)."""

    stamps: npt.NDArray[np.int64]
    places: npt.NDArray[np.float64]

    def followed_by(self, other: "FramePath") -> "FramePath":
        """Return this path with the path `other` appended."""
        stamps, places = zip(self, other, strict=True)
        return FramePath(np.concatenate(stamps), np.concatenate(places))

    def after(self, stamp: Stamp) -> "FramePath":
        """Return the points of the path at and after a time."""
        first = int(np.searchsorted(self.stamps, stamp))
        return FramePath(self.stamps[first:], self.places[first:])

    def before(self, stamp: Stamp) -> "FramePath":
        """Return the points of the path before a time."""
        end = int(np.searchsorted(self.stamps, stamp))
        return FramePath(self.stamps[:end], self.places[:end])


NOWHERE = FramePath(np.zeros(0, np.int64), np.zeros((0, 3)))


def _trails(paths: Mapping[str, FramePath], now: Stamp) -> ColoredLines:
    """Return the paths as coloured line segments, oldest first; older segments are fainter."""
    stamps, ends, colors = [NOWHERE.stamps], [np.zeros((0, 2, 3))], [NOWHERE.stamps]
    for name, (times, places) in paths.items():
        moves = np.abs(np.diff(places, axis=0)).sum(axis=1) > STILL
        (joined,) = np.nonzero(moves & (np.diff(times) <= GAP))
        stamps.append(times[joined + 1])
        ends.append(np.stack([places[joined], places[joined + 1]], 1))
        colors.append(np.full(len(joined), packed(theme.of_name(name))))
    order = np.argsort(np.concatenate(stamps), kind="stable")
    ages = np.clip((now - np.concatenate(stamps)[order]) / REACH, 0.0, 1.0)
    inks = blended(np.concatenate(colors)[order], FADED, 0.9 * ages)
    return ColoredLines(np.concatenate(ends)[order], inks)
