"""Picture of frames relative to a fixed one, computed by lookups: positions and trails."""

from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from itertools import islice

import numpy as np

from tftool.base.color import Color
from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing import theme
from tftool.drawing.cells import Stroke
from tftool.drawing.plane import FARTHEST, Box, Drawn, PlaneFrame, PlanePicture
from tftool.geometry.rigid import Transform

Point3 = tuple[float, float, float]
Heights = tuple[float, float]

Lookup = Callable[[str, str], Transform | None]
"""The pose of the second frame in the first, or None where there is none."""


def natural_fixed(snapshot: Snapshot, pair: tuple[str, str]) -> str:
    """Return the default fixed frame of a picture.

    It is the root of the tree with both frames of the pair, or else of the largest tree. Empty
    without frames.
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
    """Return a lookup limited to the snapshot."""

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
    """Return the frames that may move relative to `fixed`, one of each rigid group."""
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
    """Draw the tree of `fixed` by looking up every frame in it; other trees separately.

    Args:
        snapshot: Snapshot of the frames.
        fixed: Fixed frame of the picture.
        lookup: Gives their poses.
        ages: Seconds since there was news of each.
        turtles: The frames drawn as turtles.
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
"""How far apart the moments are at which frames are looked up."""

REACH = seconds(30.0)
"""How far back a trail that is drawn from scratch reaches, where the buffer does."""

KEPT = seconds(60.0)
"""How long a trail is kept that was seen as it came."""

MOST_FRAMES = 24
"""So many frames have trails."""

LEAST = 0.004
"""Metres under which a frame stays where it is."""

FADE_EVERY = seconds(1.0)
"""How often the colours of a trail follow its age; trails of many strokes fade less often."""

FADED = Color(112, 116, 130)
"""Colour of marks as old as `REACH`; on a light ground and on a dark one it is faint."""

GAP = seconds(1.0)
"""Two moments farther apart are not joined by a line."""


class FrameTrails:
    """Trails of frames in one fixed frame, by repeated lookups.

    Args:
        buffer: Source of the frames.

    Attributes:
        fixed: Fixed frame of the trails.
    """

    def __init__(self, buffer: Buffer) -> None:
        self._buffer = buffer
        self.fixed = ""
        self._edition = 0
        self._ends: dict[str, tuple[Stamp, Point3]] = {}
        self._until: dict[str, Stamp] = {}
        self._strokes: deque[Stroke] = deque()
        self._heights: deque[Heights] = deque()
        self._stamps: deque[Stamp] = deque()
        self._box: Box | None = None
        self._next: Stamp = 0
        self._faded: Stamp = 0
        self._shown: list[Stroke] = []
        self._shown_heights: list[Heights] = []

    def follow(self, fixed: str, frames: Iterable[str], now: Stamp) -> Drawn:
        """Look the frames up since the last time, and return all trails up to now.

        Args:
            fixed: Fixed frame; a change starts all trails again.
            frames: Frames; only the first `MOST_FRAMES` are followed.
            now: The last moment.
        """
        if fixed != self.fixed or now < self._next - 4 * PERIOD:
            self._begin(fixed)
        if now >= self._next:
            self._next = now + 2 * PERIOD
            for frame in islice(frames, MOST_FRAMES):
                self._grow(frame, now)
            if self._stamps and now - self._stamps[0] > KEPT * 5 // 4:
                self._forget(now - KEPT)
            if now - self._faded >= FADE_EVERY * (1 + len(self._strokes) // 1000):
                self._fade(now)
            self._shown_heights.extend(islice(self._heights, len(self._shown), None))
            self._shown.extend(islice(self._strokes, len(self._shown), None))
        return Drawn(self._shown, 0, self._edition, self._box, self._shown_heights)

    def _fade(self, now: Stamp) -> None:
        """Recolour every part by its age, as a new drawing."""
        self._shown = [
            _of_age(stroke, now - stamp)
            for stamp, stroke in zip(self._stamps, self._strokes, strict=True)
        ]
        self._shown_heights = [*self._heights]
        self._edition += 1
        self._faded = now

    def until(self, fixed: str, frames: Iterable[str], at: Stamp) -> Drawn:
        """Return all trails up to an earlier time, as far back as the buffer reaches."""
        start = at - REACH
        found: list[tuple[Stamp, Stroke, Heights]] = []
        for frame in islice(frames, MOST_FRAMES):
            found += self._between(frame, fixed, start, at, None)[0]
        if found and fixed == self.fixed:
            start = min(stamp for stamp, _, _ in found) - PERIOD
        elif fixed == self.fixed:
            start = at
        found.sort(key=lambda one: one[0])
        if fixed == self.fixed:
            older = bisect_right(self._stamps, start)
            before = zip(self._stamps, self._strokes, self._heights, strict=True)
            found = [*islice(before, older), *found]
        strokes = [_of_age(stroke, at - stamp) for stamp, stroke, _ in found]
        # Another drawing at every moment: at rest it is drawn once.
        heights = [one for _, _, one in found]
        return Drawn(strokes, 0, -1 - at, _around(None, strokes), heights)

    def _begin(self, fixed: str) -> None:
        self.fixed, self._edition, self._next = fixed, self._edition + 1, 0
        self._ends.clear()
        self._until.clear()
        self._strokes.clear()
        self._heights.clear()
        self._stamps.clear()
        self._shown, self._shown_heights, self._faded = [], [], 0
        self._box = None

    def _forget(self, before: Stamp) -> None:
        """Drop old parts; the rest is a new drawing."""
        while self._stamps and self._stamps[0] < before:
            self._stamps.popleft()
            self._strokes.popleft()
            self._heights.popleft()
        self._box = _around(None, self._strokes)
        self._faded, self._shown, self._shown_heights = 0, [], []

    def _grow(self, frame: str, now: Stamp) -> None:
        start = max(self._until.get(frame, 0), now - REACH)
        found, end = self._between(frame, self.fixed, start, now, self._ends.get(frame))
        if end is None:
            return
        self._ends[frame] = end
        self._until[frame] = end[0] // PERIOD * PERIOD
        for stamp, stroke, heights in found:
            self._strokes.append(stroke)
            self._heights.append(heights)
            # One frame's lookups may lag behind another's: in the order in which they were drawn.
            self._stamps.append(max(stamp, self._stamps[-1]) if self._stamps else stamp)
        self._box = _around(self._box, [stroke for _, stroke, _ in found])

    def _between(
        self, frame: str, fixed: str, start: Stamp, end: Stamp, before: tuple[Stamp, Point3] | None
    ) -> tuple[list[tuple[Stamp, Stroke, Heights]], tuple[Stamp, Point3] | None]:
        """Return the strokes of one frame after `start`, and its last known time and position."""
        stamps = np.arange(start // PERIOD + 1, end // PERIOD + 1, dtype=np.int64) * PERIOD
        stamps = stamps[stamps > 0]
        if not len(stamps):
            return [], before
        try:
            path = self._buffer.lookup_transforms(fixed, frame, stamps, missing="nan", threads=1)
        except TransformException:
            return [], before
        holds = path.valid & (np.abs(path.translations).sum(axis=1) < FARTHEST)
        color = theme.of_name(frame)
        found: list[tuple[Stamp, Stroke, Heights]] = []
        last = before
        moments, places = stamps[holds].tolist(), path.translations[holds].tolist()
        latest = last
        for stamp, (x, y, z) in zip(moments, places, strict=True):
            latest = stamp, (x, y, z)
            if last is not None:
                (x0, y0, z0), joined = last[1], stamp - last[0] <= GAP
                if abs(x - x0) + abs(y - y0) + abs(z - z0) < LEAST:
                    # It stays: the next stroke begins where this one stands, and now.
                    last = stamp, last[1]
                    continue
                if joined:
                    found.append((stamp, (x0, y0, x, y, color, 0), (z0, z)))
            last = stamp, (x, y, z)
        if latest is None or last is None:
            return found, last
        return found, (latest[0], last[1])


def _of_age(stroke: Stroke, age: Duration) -> Stroke:
    """Return a part of a trail in the colour of its age."""
    x0, y0, x1, y1, color, width = stroke
    share = min(1.0, max(0.0, age / REACH))
    return x0, y0, x1, y1, theme.blend(color, FADED, 0.9 * share), width


def _around(box: Box | None, strokes: Iterable[Stroke]) -> Box | None:
    for x0, y0, x1, y1, _, _ in strokes:
        if box is None:
            box = min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)
        else:
            left, bottom, right, top = box
            box = min(left, x0, x1), min(bottom, y0, y1), max(right, x0, x1), max(top, y0, y1)
    return box
