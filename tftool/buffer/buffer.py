"""Buffer of transforms over time, which looks up the pose of any frame in any other."""

import struct
from collections.abc import Callable, Iterable
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, TypeAlias

from tftool.base.errors import TransformException
from tftool.base.stamps import CACHE_TIME, Duration, Stamp, as_seconds, whole
from tftool.buffer import forest as tree
from tftool.buffer import refusals, snapshot, solver
from tftool.buffer.callbacks import NEVER, Callback, Listeners, Report, Requests, listener_text
from tftool.buffer.forest import FrameTree
from tftool.buffer.history import (
    AUTHORITY_SHIFT,
    NEEDS_CHECK,
    PARENT_CHANGED,
    RECORD,
    STORED,
    TOO_OLD,
    History,
    Sample,
)
from tftool.buffer.native_kernel import Door, native_first
from tftool.buffer.sample import FrameInfo, Snapshot, TransformStamped
from tftool.buffer.solver import Path, Solver
from tftool.geometry import poses, quaternions, rigid
from tftool.geometry.rigid import Transform

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from tftool.buffer.batch.insert import Insertion
    from tftool.buffer.batch.transform_array import SampleColumns, TransformArray

__all__ = ["NEVER", "NO_LIMIT", "Buffer"]

NO_LIMIT: Final[Duration] = 2**63 - 1
"""A cache time with which nothing is ever pruned; used for recordings."""

MAX_FRAMES = 16_384
"""Default maximum number of frame names in a buffer."""

MAX_NAME = 4_096
"""Default maximum length of a frame name, bytes in UTF-8; tf2 has no limit."""

Listener: TypeAlias = Callable[[TransformStamped, bool, str], object]
"""Function called with each accepted sample, whether the sample is static, and its authority."""

# A cache time below this many nanoseconds was probably meant in seconds.
_LIKELY_SECONDS: Final = 1_000_000

# The fast insertion raises these if a frame is new or an argument unusual. `_set_slowly` follows.
_NOT_PLAIN: Final = (KeyError, TypeError, ValueError, AttributeError, struct.error)

# Number of the newest samples that `rivals` searches for alternating senders.
_TURNS: Final = 4096

_NO_PATHS: dict[str, Path] = {}
_new: Final = tuple.__new__


class Shortened(NamedTuple):
    """Record of a child frame whose oldest samples were dropped to save memory.

    Attributes:
        child: The child frame.
        authority: Sender of the newest sample of the frame.
        samples: Number of samples of the frame before dropping.
        kept: Number of samples of the frame after dropping.
    """

    child: str
    authority: str
    samples: int
    kept: int


def _most_per_frame(sizes: list[int], limit: int) -> int:
    """Return how many samples each frame may keep, at least 2, for `limit` samples in total."""
    left = len(sizes)
    for size in sorted(sizes):
        if size * left > limit:
            return max(2, limit // left)
        limit -= size
        left -= 1
    return max(sizes)


class Buffer(Door):
    """Transforms of named frames over time, with tf2's semantics.

    A link is the pose of a child frame in its parent: static, or moving with many samples. A buffer
    has no clock and never waits. Times are arguments in nanoseconds; in a lookup, 0 means the
    latest.

    Threads: a buffer belongs to one thread, usually the thread of the event loop. Most methods
    must be called in this thread only. Other threads can call `lookup_transforms`,
    `lookup_transforms_full` and `samples` at any time: these methods copy the samples frame by
    frame, and compute on the copies. Each copy is a frame's state at some time during the call.
    """

    def __init__(
        self,
        cache_time: Duration = CACHE_TIME,
        *,
        log: refusals.Log | None = None,
        max_frames: int = MAX_FRAMES,
        max_name: int = MAX_NAME,
        report: Report | None = None,
    ) -> None:
        """Create an empty buffer.

        Args:
            cache_time: Age up to which samples of a frame are kept, relative to the newest sample
                of the same frame, nanoseconds; NO_LIMIT keeps all samples.
            log: Function called with a level ("WARN", "ERROR") and a sentence when a sample is
                refused. None logs to Python's `logging`.
            max_frames: Maximum number of frame names, because a sender may invent names endlessly.
            max_name: Maximum length of a frame name, bytes.
            report: Function called with the exception of a listener or of a request's callback, and
                with the owner's name. None logs the exception as an error.

        Raises:
            TypeError: If `cache_time` is not a whole number.
            ValueError: If `cache_time` is negative.
        """
        cache_time = whole(cache_time)
        if cache_time < 0:
            raise ValueError(f"cache_time must not be negative, but is {cache_time} ns")
        self.cache_time = cache_time
        self.max_frames = max_frames
        self.max_name = max_name
        self._log = log or refusals.log_to_logging
        if 0 < cache_time < _LIKELY_SECONDS:
            self._log("WARN", refusals.short_cache(cache_time))
        self._tree = FrameTree(cache_time, max_name)
        self._senders = self._tree.senders
        self._numbers = self._tree.numbers
        self._frames = self._tree.frames
        self._solver = Solver(self._tree, cache_time)
        self._paths = self._solver.paths
        self._requests = Requests(self._solver.examine)
        self._pending = self._requests.pending
        # Not a method: the buffer would refer to itself, and its memory would be freed late.
        self._report = report or partial(_log_failure, self._log)
        self._listeners: Listeners[TransformStamped, bool, str] = Listeners(self._report)
        self._listening = self._listeners.registered

    # Inserting samples

    def __repr__(self) -> str:
        kept = "all" if self.cache_time == NO_LIMIT else f"{as_seconds(self.cache_time):g} s"
        return f"<Buffer: {len(self.frames())} frames, keeps {kept}>"

    @native_first
    def set_transform(self, transform: TransformStamped, authority: str = "") -> bool:
        """Insert one sample of a moving frame: the pose of a child frame in its parent at one time.

        Args:
            transform: The pose of a child in its parent. One leading slash is removed from either
                name; a finite quaternion other than zero is scaled to unit length.
            authority: Sender of the transform.

        Returns:
            Whether the sample was accepted. If not, the log has the reason, and the stored samples
            are unchanged.

        Raises:
            TypeError: If the stamp is not a whole number.
        """
        try:
            stamp, parent, child, pose = transform
            if not (child.__class__ is parent.__class__ is authority.__class__ is str):
                return self._set_slowly(transform, authority, False)
            known_parent, known_authority, origin, history = self._senders[child]
            outcome = (
                history.insert(stamp, origin, pose)
                if parent == known_parent
                and authority == known_authority
                and pose.__class__ is Transform
                else NEEDS_CHECK
            )
        except _NOT_PLAIN:
            return self._set_slowly(transform, authority, False)
        if outcome != STORED:
            if outcome == NEEDS_CHECK:
                return self._set_slowly(transform, authority, False)
            if outcome == TOO_OLD:
                self._log("WARN", refusals.old_data(child, stamp, authority))
                return False
            if outcome == PARENT_CHANGED:
                self._solver.drop_paths()
        if self._listening or self._pending:
            self._tell_of(transform, authority)
        return True

    def _tell_of(self, transform: TransformStamped, authority: str) -> None:
        """Call the listeners with a sample as stored: a unit quaternion with the sign as in tf2."""
        stamp, parent, child, pose = transform
        kept: tuple[TransformStamped, ...] = ()
        if self._listening:
            kept = (TransformStamped(stamp, parent, child, rigid.canonical(pose)),)
        self._tell(kept, False, authority, (child,))

    def set_transform_static(self, transform: TransformStamped, authority: str = "") -> bool:
        """Set a static transform, valid at all times, which replaces all samples of the child.

        Returns:
            Whether the transform was accepted. If not, the log has the reason, and the stored
            samples are unchanged.

        Raises:
            TypeError: If the stamp is not a whole number.
        """
        return self._set_slowly(transform, authority, True)

    def _set_slowly(self, transform: TransformStamped, authority: str, static: bool) -> bool:
        """Insert a static sample, or a sample that the fast path refused, with all checks."""
        stamp, parent, child, pose = _parts(transform)
        stamp = whole(stamp)
        parent, child = tree.stripped(parent), tree.stripped(child)
        if isinstance(authority, str):
            authority = tree.plain(authority)
        rotation = quaternions.canonical(quaternions.unit(pose.rotation))
        errors = refusals.objections(child, parent, stamp, pose.translation, rotation, authority)
        trees = self._tree
        if too_long := refusals.long_name(child, parent, authority, trees.max_name):
            errors = [too_long]
        if not errors and not trees.has_room(child, parent, self.max_frames):
            errors = [refusals.too_many_frames(child, authority, len(trees.frames))]
        if errors:
            for error in errors:
                self._log("ERROR", error)
            return False

        known = len(trees.frames)
        frame, link, fresh = trees.hang(child, parent, static)
        pose = rigid.transform(pose.translation, rotation)
        origin = trees.origin(parent, authority)
        outcome = link.insert(stamp, origin, pose, True)
        # A new name wakes the requests that wait for it, even if the sample is refused. A parent
        # that was known wakes none: else each new child would wake all requests below its parent.
        named = [new.name for new in trees.frames[known:]]
        if outcome == TOO_OLD:
            self._log("WARN", refusals.old_data(child, stamp, authority))
            self._tell((), static, authority, named)
            return False
        trees.note(frame, parent, authority, origin)
        if fresh or outcome == PARENT_CHANGED:
            self._solver.drop_paths()
        if self._listening or self._pending:
            kept = TransformStamped(stamp, parent, child, pose)
            self._tell((kept,), static, authority, (child, *named))
        return True

    def _tell(
        self,
        samples: Iterable[TransformStamped],
        static: bool,
        authority: str,
        changed: Iterable[str],
    ) -> None:
        """Call the listeners with each sample, then retry the requests for changed frames."""
        for sample in samples:
            self._listeners.call(sample, static, authority)
        if self._pending:
            for failure in self._requests.changed(*changed):
                self._report("", failure)

    def set_transforms(
        self,
        parent: str,
        child: str,
        stamps: "npt.ArrayLike",
        translations: "npt.ArrayLike",
        rotations: "npt.ArrayLike",
        authority: str = "",
    ) -> "Insertion":
        """Insert many samples of one moving child, as repeated calls of `set_transform` would.

        After all samples are stored, each listener is called with each sample, and pending requests
        are tried again.

        Args:
            parent: The frame in which the poses are expressed.
            child: Frame whose poses are given.
            stamps: Whole nanoseconds, shape (n,), in any order.
            translations: Metres, shape (n, 3).
            rotations: Quaternions in xyzw order, shape (n, 4), finite and not zero.
            authority: Sender of the samples.

        Returns:
            The accepted rows, and the reasons for the rejected rows; true if all rows were
            accepted. The first ten rejected rows are logged.

        Raises:
            TypeError: If the stamps are not whole numbers.
            ValueError: If a shape does not fit.
        """
        from tftool.buffer.batch import insert

        known = len(self._tree.frames)
        link = (parent, child, authority)
        report, rows = insert.insert(
            self._tree, self._log, self.max_frames, link, stamps, translations, rotations
        )
        self._solver.drop_paths()
        if report.accepted.any():
            parent, child = tree.stripped(parent), tree.stripped(child)
            taken = (
                _stamped(parent, child, stamp, sample)
                for stamp, sample in rows.taken(report.accepted)
            )
            grown = len(self._tree.frames) > known
            news = (child, parent) if grown else (child,)
            self._tell(taken if self._listening else (), False, authority, news)
        return report

    def set_records(
        self, parent: str, child: str, records: "npt.NDArray[np.int64]", authority: str = ""
    ) -> "Insertion | None":
        """Insert samples that are already in the buffer's own memory layout.

        If possible the buffer uses the array `records` itself, and copies the array only before an
        insertion or pruning of samples.

        Args:
            parent: The frame in which the poses are expressed.
            child: Frame whose poses are given.
            records: One row per sample, int64, shape (n, 8): the stamp in nanoseconds, then the
                bits of the seven doubles x y z and x y z w.
            authority: Sender of the samples.

        Returns:
            The accepted rows, and the reasons for the rejected rows. None if all rows were
            accepted.

        Raises:
            TypeError: If the records are not rows of eight whole numbers.
        """
        if adopt_records(self, parent, child, records, authority):
            return None
        numbers = records.view("f8")
        return self.set_transforms(
            parent, child, records[:, 0], numbers[:, 1:4], numbers[:, 4:], authority
        )

    def shorten(self, limit: int) -> "list[Shortened]":
        """Drop old samples of the frames with most samples, until all samples fit into `limit`.

        The newest two samples of a frame always stay. If samples must be dropped, a quarter more
        than necessary is dropped, so that the next calls need not drop any.

        Args:
            limit: Maximum size of all samples, bytes.

        Returns:
            A record of each frame whose samples were dropped.
        """
        links = [
            (frame, frame.link)
            for frame in self._tree.frames
            if isinstance(frame.link, History) and frame.link
        ]
        sizes = [len(link) for _, link in links]
        room = limit // RECORD
        if sum(sizes) <= room:
            return []
        most = _most_per_frame(sizes, room - room // 4)
        cut = []
        for (frame, link), size in zip(links, sizes, strict=True):
            if size > most:
                link.keep_last(most)
                cut.append(Shortened(frame.name, frame.authority or "", size, len(link)))
        return cut

    def clear(self) -> None:
        """Drop all moving transforms; keep names, static transforms and pending requests."""
        for frame in self._tree.frames:
            if frame.link is not None and not frame.link.is_static:
                frame.link.clear()
        self._solver.drop_paths()

    def listen(self, callback: Listener, owner: str = "") -> Callable[[], None]:
        """Call `callback` with each sample accepted from now on, until the returned function is
        called.

        Exceptions of the callback are reported under the name `owner`. The sample stays stored, and
        the code that inserts the sample continues.
        """
        withdraw = self._listeners.add(callback, owner)
        self._listening = self._listeners.registered

        def stop() -> None:
            withdraw()
            self._listening = self._listeners.registered

        return stop

    # Lookups

    @native_first
    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Stamp = 0
    ) -> TransformStamped:
        """Return the pose of the source frame in the target frame at one time.

        The returned transform maps points from the source frame to the target frame.

        Args:
            target_frame: Frame in which the result is expressed.
            source_frame: Frame to look up.
            time: Nanoseconds; 0 for the newest time at which the whole chain has data.

        Returns:
            The transform. Its stamp is the time of the lookup, or 0 if all of the path is static.

        Raises:
            InvalidArgumentException: If a name is empty or starts with a slash.
            LookupException: If a frame name was never received, or the frames form a loop.
            ConnectivityException: If the two frames are in different trees.
            ExtrapolationException: If a frame between the two frames has no data at that time.
            TypeError: If `time` is not a whole number.
        """
        if type(time) is not int:
            time = whole(time)
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        pose: Transform | None = None
        known = True
        try:
            path = self._paths[target_frame][source_frame]
        except KeyError:
            known = False
        else:
            moment = time or path.latest()
            pose = path.solve(moment)
        if pose is None:
            moment, path, kept = self._solver.find_path(target_frame, source_frame, time)
            if kept and not known:
                # The path is cached now, and with it the native kernel takes half the time.
                return Buffer.lookup_transform(self, target_frame, source_frame, moment)
            pose = path.solve(moment)
            assert pose is not None, "a link with a parent at a time has a pose at that time"
        return _new(TransformStamped, (moment, target_frame, source_frame, pose))

    @native_first
    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> TransformStamped:
        """Return the pose of source at `source_time` in target at `target_time`, via a fixed frame.

        Both poses are looked up relative to `fixed_frame`, which is assumed not to move between the
        two times.

        Raises:
            TransformException: As `lookup_transform`; the frame names are always checked, even if
                they are equal.
        """
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        fixed_frame = tree.plain(fixed_frame)
        paths = self._paths
        if not (
            # Names of cached paths were checked before.
            source_frame in paths.get(fixed_frame, _NO_PATHS)
            and fixed_frame in paths.get(target_frame, _NO_PATHS)
        ):
            for frame, argument in (
                (target_frame, "target_frame"),
                (source_frame, "source_frame"),
                (fixed_frame, "fixed_frame"),
            ):
                self._solver.number(frame, argument, "lookupTransform", target_frame, source_frame)
        inner = self.lookup_transform(fixed_frame, source_frame, source_time).transform
        stamp, _, _, outer = self.lookup_transform(target_frame, fixed_frame, target_time)
        found = poses.compose(
            (*outer.translation, *outer.rotation), (*inner.translation, *inner.rotation)
        )
        turn = quaternions.canonical(quaternions.unit(found[3:]))
        pose = rigid.transform(found[:3], turn)
        return _new(TransformStamped, (stamp, target_frame, source_frame, pose))

    def lookup_transforms(
        self,
        target_frame: str,
        source_frame: str,
        times: "npt.ArrayLike",
        *,
        missing: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
    ) -> "TransformArray":
        """Return the results of `lookup_transform` for many times at once, in numpy arrays.

        Args:
            target_frame: Frame in which the results are expressed.
            source_frame: Frame to look up.
            times: Whole nanoseconds, shape (n,), in any order; 0 for the latest.
            missing: What to do for a time without a pose: "raise" raises an error, "nan" returns a
                row of NaN with `valid` false. An unknown frame raises an error in either case.
            threads: Number of threads; None for one per core where that is faster.

        Raises:
            TransformException: As `lookup_transform`, for the first row without a pose.
            TypeError: If the times are not whole numbers.
            ValueError: If the shape is not (n,).
        """
        # Imported here because single lookups need no numpy.
        from tftool.buffer.batch import lookup

        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        return lookup.lookup_transforms(
            self._tree, self._solver, target_frame, source_frame, times, missing, threads
        )

    def lookup_transforms_full(
        self,
        target_frame: str,
        target_times: "npt.ArrayLike",
        source_frame: str,
        source_times: "npt.ArrayLike",
        fixed_frame: str,
        *,
        missing: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
    ) -> "TransformArray":
        """Return the results of `lookup_transform_full` for many times at once, in numpy arrays.

        Either `target_times` or `source_times` may be a single number; see `lookup_transforms`.

        Raises:
            TransformException: As `lookup_transform_full`, for the first row without a pose.
            TypeError: If the times are not whole numbers.
            ValueError: If the two arrays have different lengths.
        """
        from tftool.buffer.batch import lookup

        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        fixed_frame = tree.plain(fixed_frame)
        return lookup.lookup_transforms_full(
            self._tree,
            self._solver,
            target_frame,
            target_times,
            source_frame,
            source_times,
            fixed_frame,
            missing,
            threads,
        )

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Stamp:
        """Return the newest time with data for all frames between two frames; 0 if all are static.

        Raises:
            TransformException: If a name is unknown or invalid, or the two frames are in different
                trees.
        """
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        path = self._paths.get(target_frame, _NO_PATHS).get(source_frame)
        if path is not None:
            return path.latest()
        call = "get_latest_common_time"
        number = self._solver.number
        return self._solver.latest_common(
            number(target_frame, "target_frame", call, target_frame, source_frame),
            number(source_frame, "source_frame", call, target_frame, source_frame),
        )

    def newest_common(self, target_frame: str, source_frame: str) -> Stamp:
        """Return the result of `get_latest_common_time`; 0 if that method raises an error."""
        try:
            return self.get_latest_common_time(target_frame, source_frame)
        except TransformException:
            return 0

    def lookup_velocity(
        self, tracking_frame: str, observation_frame: str, time: Stamp, interval: Duration
    ) -> solver.Velocity:
        """Return the velocity of `tracking_frame` in `observation_frame`, by tf2's formula.

        `solver.full` describes the mistakes in tf2's formula, which `lookup_twist` avoids.
        """
        return solver.full(
            self,
            tracking_frame,
            observation_frame,
            observation_frame,
            (0.0, 0.0, 0.0),
            tracking_frame,
            time,
            interval,
        )

    def lookup_velocity_full(
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        reference_point: tuple[float, float, float],
        reference_point_frame: str,
        time: Stamp,
        interval: Duration,
    ) -> solver.Velocity:
        """Return `tracking_frame`'s velocity in `observation_frame`, expressed in
        `reference_frame`.

        The formula is exactly tf2's; see `solver.full`.
        """
        return solver.full(
            self,
            tracking_frame,
            observation_frame,
            reference_frame,
            reference_point,
            reference_point_frame,
            time,
            interval,
        )

    def lookup_twist(
        self, tracking_frame: str, observation_frame: str, time: Stamp, interval: Duration
    ) -> solver.Velocity:
        """Return the velocity of `tracking_frame` in `observation_frame`, averaged over `interval`.

        Raises:
            TransformException: As `lookup_transform`.
            TypeError: If the time or the interval is not a whole number.
            ValueError: If the interval is not positive.
        """
        return solver.twist(self, tracking_frame, observation_frame, time, interval)

    # Whether a lookup would succeed

    @native_first
    def can_transform(self, target_frame: str, source_frame: str, time: Stamp = 0) -> bool:
        """Whether `lookup_transform` would succeed; false for an unknown frame or missing data."""
        if type(time) is not int:
            time = whole(time)
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        path = self._paths.get(target_frame, _NO_PATHS).get(source_frame)
        if path is not None and path.covers(time or path.latest()):
            return True
        return self._solver.why_not(target_frame, source_frame, time) is None

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> bool:
        """Whether `lookup_transform_full` would succeed."""
        return not self.why_not_full(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )

    def why_not(self, target_frame: str, source_frame: str, time: Stamp = 0) -> str:
        """Return tf2's reason why `can_transform` returns false; "" if the lookup would succeed."""
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        reason = self._solver.why_not(target_frame, source_frame, whole(time))
        return "" if reason is None else str(reason)

    def why_not_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> str:
        """Return tf2's reason why `can_transform_full` returns false; "" if it returns true."""
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        fixed_frame = tree.plain(fixed_frame)
        for frame, argument in (
            (target_frame, "target_frame"),
            (source_frame, "source_frame"),
            (fixed_frame, "fixed_frame"),
        ):
            if why := self._solver.fault(frame):
                return refusals.invalid_frame(frame, argument, why)
        # tf2 checks the target's half first here, but the source's half first in the lookup.
        return self.why_not(target_frame, fixed_frame, target_time) or self.why_not(
            fixed_frame, source_frame, source_time
        )

    # Requests

    def request(
        self, callback: Callback, target_frame: str, source_frame: str, time: Stamp = 0
    ) -> int:
        """Call `callback` once the transform can be looked up.

        Args:
            callback: Function called with the request's handle and True once the transform is
                available, or with False once the time is older than the stored samples. Callbacks
                are called by the method that inserts the decisive sample, in the order of the
                requests. An exception of a callback is reported like an exception of a listener;
                see `listen`.
            target_frame: As in `lookup_transform`.
            source_frame: As in `lookup_transform`.
            time: As in `lookup_transform`; a request for time 0 never gets False.

        Returns:
            0 if the transform is available now, NEVER if it cannot become available any more, else
            a handle for `cancel`. With 0 and NEVER, `callback` is never called.
        """
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        return self._requests.add(callback, (target_frame, source_frame, whole(time)))

    def cancel(self, handle: int) -> None:
        """Cancel a request; its callback is not called any more."""
        self._requests.cancel(handle)

    # All frames

    def snapshot(self, now: Stamp, at: Stamp = 0) -> Snapshot:
        """Return the poses of all frames at one time, with counts and ages of their samples.

        Args:
            now: The clock's time, from which ages are computed, nanoseconds.
            at: The time to show, nanoseconds; 0 for the latest time of each frame's chain.
        """
        return snapshot.snapshot(self._tree, whole(now), whole(at))

    def samples(self, child: str) -> "SampleColumns":
        """Return a copy of all samples of one child frame, oldest first, in numpy.

        Args:
            child: The child frame. A root frame has no parent, and so no samples.

        Raises:
            InvalidArgumentException: If the name is empty or starts with a slash.
            LookupException: If the name was never received.
        """
        from tftool.buffer.batch import edge_columns as columns

        child = tree.plain(child)
        number = self._solver.number(child, "child", "samples", child, child)
        return columns.samples(self._tree, self._tree.frames[number])

    def frames(self) -> list[str]:
        """Return all frame names ever received, in order of arrival."""
        return [frame.name for frame in self._tree.frames]

    def frame_exists(self, frame: str) -> bool:
        """Whether a frame name was ever received; always true for tf2's reserved name NO_PARENT."""
        frame = tree.plain(frame)
        return frame in self._tree.numbers or frame == tree.NO_PARENT_NAME

    def parent(self, frame: str, time: Stamp = 0) -> str | None:
        """Return the parent of a frame at a time; None for a root, or without data at that time.

        Raises:
            TypeError: If the time is not a whole number, or the name not a string.
        """
        time = whole(time)
        frame = tree.plain(frame)
        number = self._tree.numbers.get(frame)
        if number is None:
            return None
        link = self._tree.frames[number].link
        above = -1 if link is None else link.parent_at(time)
        return None if above < 0 else self._tree.frames[above].name

    def parents(self, frame: str) -> set[str]:
        """Return all parents that a frame has in its stored samples; empty for a root."""
        frame = tree.plain(frame)
        number = self._tree.numbers.get(frame)
        above = () if number is None else self._tree.parents(number)
        return {self._tree.frames[one].name for one in above}

    def rivals(self, frame: str) -> tuple[str, ...]:
        """Return the publishers that publish a frame in turns; empty for a single publisher.

        The result is also empty if one publisher replaced another publisher only once.
        """
        frame = tree.plain(frame)
        number = self._tree.numbers.get(frame)
        link = None if number is None else self._tree.frames[number].link
        if not isinstance(link, History):
            return ()
        origins = link.columns()[1]
        if origins is None:
            return ()
        turns = [origin >> AUTHORITY_SHIFT for origin in origins[-_TURNS:]]
        if sum(one != other for one, other in pairwise(turns)) < 3:
            return ()
        return tuple(self._tree.authorities[one] for one in dict.fromkeys(turns))

    def chain(self, target_frame: str, source_frame: str, time: Stamp = 0) -> list[str]:
        """Return the frame names from source to target, inclusive; [] if both names are equal.

        Raises:
            TransformException: As `lookup_transform`.
        """
        target_frame, source_frame = tree.plain(target_frame), tree.plain(source_frame)
        return self._solver.chain(target_frame, source_frame, whole(time))

    def all_frames_as_yaml(self, current_time: Stamp = 0) -> str:
        """Return all frames as text, in tf2's YAML form; see `snapshot.as_yaml`."""
        return snapshot.as_yaml(self._infos(), current_time)

    def all_frames_as_string(self) -> str:
        """Return all frames as text, in tf2's sentences; see `snapshot.as_string`."""
        return snapshot.as_string(self._infos())

    def all_frames_as_dot(self, current_time: Stamp = 0) -> str:
        """Return all frames as text, in tf2's form for Graphviz; see `snapshot.as_dot`."""
        return snapshot.as_dot(self._infos(), current_time)

    def _infos(self) -> tuple[FrameInfo, ...]:
        return snapshot.snapshot(self._tree, 0, 0).frames


def _parts(transform: TransformStamped) -> tuple[Stamp, str, str, Transform]:
    """Return the stamp, parent, child and pose of a `TransformStamped` given by a user.

    Raises:
        TypeError: If the argument is not a stamped transform.
    """
    try:
        stamp, parent, child, pose = transform
    except (TypeError, ValueError):
        pose = None
    if not isinstance(pose, Transform):
        raise TypeError(
            "expected a TransformStamped(stamp, frame_id, child_frame_id, Transform(…)), "
            f"not {transform!r:.200}"
        )
    return stamp, parent, child, pose


def _stamped(target: str, source: str, stamp: Stamp, sample: Sample) -> TransformStamped:
    x, y, z, qx, qy, qz, qw = sample
    return TransformStamped(stamp, target, source, rigid.transform((x, y, z), (qx, qy, qz, qw)))


def adopt_records(
    buffer: Buffer,
    parent: str,
    child: str,
    records: "npt.NDArray[np.int64]",
    authority: str = "",
    checked: int = 0,
) -> bool:
    """Insert records as `Buffer.set_records` does, if their stamps increase.

    Args:
        buffer: The buffer to insert into.
        parent: As in `Buffer.set_records`.
        child: As in `Buffer.set_records`.
        records: As in `Buffer.set_records`.
        authority: As in `Buffer.set_records`.
        checked: Number of leading records that need no check: their stamps increase, they are
            finite, and their quaternions have unit length and the sign that tf2 computes.

    Returns:
        Whether all records were accepted. If not, nothing was changed.

    Raises:
        TypeError: As in `Buffer.set_records`.
    """
    from tftool.buffer.batch import insert

    known = len(buffer._tree.frames)
    if buffer._listening or not insert.adopt(
        buffer._tree, buffer.max_frames, (parent, child, authority), records, checked
    ):
        return False
    buffer._solver.drop_paths()
    named = [frame.name for frame in buffer._tree.frames[known:]]
    buffer._tell((), False, authority, (tree.stripped(child), *named))
    return True


def lend(buffer: Buffer, child: str, other: Buffer, until: Stamp) -> bool:
    """Let another buffer use the samples of one frame up to a stamp, without a copy.

    Args:
        buffer: The buffer whose samples are shared.
        child: The child frame.
        other: A buffer without samples of this frame.
        until: The last stamp to share, nanoseconds.

    Returns:
        Whether the samples could be shared. If not, nothing was changed; `Buffer.samples` returns a
        copy instead.
    """
    frame = buffer._tree.frames[buffer._tree.numbers[child]]
    link = frame.link
    if not isinstance(link, History) or link.parent < 0 or frame.authority is None:
        return False
    if not link or link.oldest_stamp > until:
        return True
    if link.origins is not None or link.start:
        return False
    parent = buffer._tree.frames[link.parent].name
    there, history, _ = other._tree.hang(child, parent, False)
    assert isinstance(history, History)
    origin = other._tree.origin(parent, frame.authority)
    link.lend(history, origin, until)
    other._tree.note(there, parent, frame.authority, origin)
    other._solver.drop_paths()
    return True


def _log_failure(log: Callable[[str, str], None], owner: str, failure: Exception) -> None:
    """Log the exception of a listener as an error, with the name of the listener's owner."""
    log("ERROR", listener_text(owner, failure))
