"""Solver of lookups: walks the trees, and caches paths for the next lookup."""

from typing import Final

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, Stamp
from tftool.buffer import forest as tree
from tftool.buffer import refusals, snapshot
from tftool.buffer.forest import ARRIVED, LOOP, REFUSED, FrameTree, Walk
from tftool.buffer.history import History, Sample
from tftool.buffer.path import Path, path_of
from tftool.buffer.requests import AVAILABLE, EXPIRED, PENDING, Lookup

MOST_PATHS: Final = 20_000
"""Maximum number of cached paths, which limits memory; with more pairs of frames in turn, each
path is computed again.
"""

_LOOKUP = "lookupTransform"

_HERE: Final = Path((), (), ())


class Solver:
    """Solver of lookups between two frames of one tree; it caches the paths it finds.

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
        """Return the time of a lookup and the pose of source in target, by walking the trees.

        Raises:
            TransformException: As in `Buffer.lookup_transform`.
        """
        time, path, _ = self.way(target, source, time)
        pose = path.solve(time)
        assert pose is not None, "a link with a parent at a time has a pose at that time"
        return time, (*pose.translation, *pose.rotation)

    def way(self, target: str, source: str, time: Stamp) -> tuple[Stamp, Path, bool]:
        """Return the effective time and the path at that time, by walking the trees.

        The third value returned says whether the path was cached for the next lookup.

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
        """Return the newest time at which every link between two frames has data.

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
        """Return the names of the frames from source to target, both included; empty if equal."""
        if target == source:
            return []
        time, _, _ = self.way(target, source, time)
        trees = self._tree
        walk = trees.walk(trees.numbers[target], trees.numbers[source], time)
        # The two sides meet in the parent of the last link of each side.
        link = trees.frames[(walk.up or walk.down)[-1]].link
        meeting = -1 if link is None else link.parent_at(time)
        return [trees.frames[number].name for number in (*walk.up, meeting, *walk.down[::-1])]

    def examine(self, lookup: Lookup, first: bool) -> tuple[int, tuple[str, ...]]:
        """Return a request's state, and the frames that must change before it succeeds."""
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
        # Both walks, because the missing link may have another parent at the newest time.
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
        """Return `can_transform`'s sentence on what is wrong with a frame name; empty if valid."""
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
        """Cache the path of a successful walk if none of its links ever changes its parent.

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
