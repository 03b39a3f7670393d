"""The ways of frames that move, as seen from a fixed one: looked up, not remembered by a pen."""

from bisect import bisect_right
from collections import deque
from collections.abc import Iterable
from itertools import islice

from tftool.base.errors import TransformException
from tftool.base.stamps import Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.drawing import theme
from tftool.drawing.cells import Stroke
from tftool.drawing.plane import FARTHEST, Box, Drawn, Point

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

GAP = seconds(1.0)
"""Two moments farther apart are not joined by a line."""


class FrameTrails:
    """Follows frames in one fixed frame by looking them up.

    Args:
        buffer: Whose frames.

    Attributes:
        fixed: What they are followed in.
    """

    def __init__(self, buffer: Buffer) -> None:
        self._buffer = buffer
        self.fixed = ""
        self._edition = 0
        self._ends: dict[str, tuple[Stamp, Point]] = {}
        self._until: dict[str, Stamp] = {}
        self._strokes: deque[Stroke] = deque()
        self._stamps: deque[Stamp] = deque()
        self._box: Box | None = None
        self._next: Stamp = 0

    def follow(self, fixed: str, frames: Iterable[str], now: Stamp) -> Drawn:
        """Look the frames up since the last time, and give all of their trails up to now.

        Args:
            fixed: What they are looked up in; another one starts all trails again.
            frames: Which; only the first `MOST_FRAMES` are followed.
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
        return Drawn(self._strokes, 0, self._edition, self._box)

    def until(self, fixed: str, frames: Iterable[str], at: Stamp) -> Drawn:
        """All trails up to an earlier moment, looked up as far back as the buffer reaches."""
        start = at - REACH
        found: list[tuple[Stamp, Stroke]] = []
        for frame in islice(frames, MOST_FRAMES):
            found += self._between(frame, fixed, start, at, None)[0]
        if found and fixed == self.fixed:
            start = min(stamp for stamp, _ in found) - PERIOD
        elif fixed == self.fixed:
            start = at
        strokes = [stroke for _, stroke in sorted(found, key=lambda one: one[0])]
        if fixed == self.fixed:
            older = bisect_right(self._stamps, start)
            strokes = [*islice(self._strokes, older), *strokes]
        # Another drawing at every moment: at rest it is drawn once.
        return Drawn(strokes, 0, -1 - at, _around(None, strokes))

    def _begin(self, fixed: str) -> None:
        self.fixed, self._edition, self._next = fixed, self._edition + 1, 0
        self._ends.clear()
        self._until.clear()
        self._strokes.clear()
        self._stamps.clear()
        self._box = None

    def _forget(self, before: Stamp) -> None:
        """Drop what is old; the rest is another drawing."""
        while self._stamps and self._stamps[0] < before:
            self._stamps.popleft()
            self._strokes.popleft()
        self._edition += 1
        self._box = _around(None, self._strokes)

    def _grow(self, frame: str, now: Stamp) -> None:
        start = max(self._until.get(frame, 0), now - REACH)
        found, end = self._between(frame, self.fixed, start, now, self._ends.get(frame))
        if end is None:
            return
        self._ends[frame] = end
        self._until[frame] = end[0] // PERIOD * PERIOD
        for stamp, stroke in found:
            self._strokes.append(stroke)
            # One frame's lookups may lag behind another's: in the order in which they were drawn.
            self._stamps.append(max(stamp, self._stamps[-1]) if self._stamps else stamp)
        self._box = _around(self._box, [stroke for _, stroke in found])

    def _between(
        self, frame: str, fixed: str, start: Stamp, end: Stamp, before: tuple[Stamp, Point] | None
    ) -> tuple[list[tuple[Stamp, Stroke]], tuple[Stamp, Point] | None]:
        """The strokes of one frame after `start`, and the last moment and place there was."""
        import numpy as np

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
        found: list[tuple[Stamp, Stroke]] = []
        last = before
        moments, places = stamps[holds].tolist(), path.translations[holds].tolist()
        latest = last
        for stamp, (x, y, _) in zip(moments, places, strict=True):
            latest = stamp, (x, y)
            if last is not None:
                (x0, y0), joined = last[1], stamp - last[0] <= GAP
                if abs(x - x0) + abs(y - y0) < LEAST:
                    # It stays: the next stroke begins where this one stands, and now.
                    last = stamp, last[1]
                    continue
                if joined:
                    found.append((stamp, (x0, y0, x, y, color, 0)))
            last = stamp, (x, y)
        if latest is None or last is None:
            return found, last
        return found, (latest[0], last[1])


def _around(box: Box | None, strokes: Iterable[Stroke]) -> Box | None:
    for x0, y0, x1, y1, _, _ in strokes:
        if box is None:
            box = min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)
        else:
            left, bottom, right, top = box
            box = min(left, x0, x1), min(bottom, y0, y1), max(right, x0, x1), max(top, y0, y1)
    return box
