"""What a buffer is told: samples come in, are kept by frame, and are told on."""

import struct
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Final, TypeAlias

from tftool.frames import names, refusals
from tftool.frames.forest import Forest
from tftool.frames.links import ODD, RESHAPED, STORED, TOO_OLD, Sample
from tftool.frames.lookups import Lookups
from tftool.frames.requests import Requests, attempt
from tftool.frames.sample import TransformStamped
from tftool.geometry import quaternions, rigid
from tftool.geometry.rigid import Transform
from tftool.stamps import Duration, Stamp, seconds, whole

if TYPE_CHECKING:
    import numpy.typing as npt

    from tftool.frames.bulk_insert import Insertion

Listener: TypeAlias = Callable[[TransformStamped, bool, str], object]
"""Is told each accepted sample, whether it is static, and who sent it."""

MAX_FRAMES = 16_384
"""How many names a buffer takes unless it is told to take more."""

# A memory shorter than this was hardly meant to be so many nanoseconds.
_LIKELY_SECONDS: Final = 1_000_000

# What a sample may raise that is none, is of a frame not known yet, or whose stamp is too long.
_NOT_PLAIN: Final = (KeyError, TypeError, ValueError, AttributeError, struct.error)


class Store:
    """The side of a buffer that is written to; `Buffer` is the whole."""

    def __init__(
        self,
        cache_time: Duration = seconds(10),
        *,
        log: refusals.Log | None = None,
        max_frames: int = MAX_FRAMES,
    ) -> None:
        """Make an empty buffer.

        Args:
            cache_time: How far each moving link remembers back from its newest sample.
            log: Is told why a sample is refused: level ("WARN", "ERROR") and sentence.
                Without one, Python's own `logging` is.
            max_frames: How many names it takes; strangers choose names.

        Raises:
            TypeError: If `cache_time` is not a whole number.
            ValueError: If `cache_time` is negative.
        """
        cache_time = whole(cache_time)
        if cache_time < 0:
            raise ValueError(f"cache_time must not be negative, but is {cache_time} ns")
        self.cache_time = cache_time
        self.max_frames = max_frames
        self._log = log or refusals.log_to_logging
        if 0 < cache_time < _LIKELY_SECONDS:
            self._log("WARN", refusals.short_cache(cache_time))
        self._forest = Forest(cache_time)
        self._moving = self._forest.moving
        self._lookups = Lookups(self._forest, cache_time)

        self._requests = Requests(self._lookups.examine)
        self._pending = self._requests.pending
        self._listeners: tuple[Listener, ...] = ()

    def set_transform(self, transform: TransformStamped, authority: str = "") -> bool:
        """Remember a sample of a link that moves.

        Args:
            transform: The pose of a child in its parent. One leading slash is taken off
                either name; any finite quaternion but zero is scaled to length one.
            authority: Who sent it.

        Returns:
            Whether it was taken. If not, the log was told why, and nothing is lost.

        Raises:
            TypeError: If the stamp is not a whole number.
        """
        try:
            stamp, parent, child, pose = transform
            frame = self._moving[child]
            outcome = ODD
            if parent == frame.parent_name:
                outcome = frame.history.insert(
                    stamp, frame.parent_number, pose.translation + pose.rotation
                )
        except _NOT_PLAIN:
            return self._set_slowly(transform, authority, False)
        if outcome != STORED:
            if outcome == ODD:
                return self._set_slowly(transform, authority, False)
            if outcome == TOO_OLD:
                self._log("WARN", refusals.old_data(child, stamp, authority))
                return False
            if outcome == RESHAPED:
                self._lookups.drop_plans()
        frame.authority = authority
        if self._listeners:
            kept = TransformStamped(stamp, parent, child, rigid.canonical(pose))
            self._tell((kept,), False, authority, (child,))
        elif self._pending:
            self._tell((), False, authority, (child,))
        return True

    def set_transform_static(self, transform: TransformStamped, authority: str = "") -> bool:
        """Set a link that holds at all times; it takes the place of all the child had before.

        Returns:
            Whether it was taken. If not, the log was told why, and nothing is lost.

        Raises:
            TypeError: If the stamp is not a whole number.
        """
        return self._set_slowly(transform, authority, True)

    def _set_slowly(self, transform: TransformStamped, authority: str, static: bool) -> bool:
        """Set what is new, odd or static: every check, each with its own line in the log."""
        stamp, parent, child, pose = _parts(transform)
        stamp = whole(stamp)
        parent, child = names.stripped(parent), names.stripped(child)
        rotation = quaternions.canonical(quaternions.unit(pose.rotation))
        errors = refusals.objections(child, parent, stamp, pose.translation, rotation, authority)
        forest = self._forest
        if not errors and not forest.has_room(child, parent, self.max_frames):
            errors = [refusals.too_many_frames(child, authority, len(forest.frames))]
        if errors:
            for error in errors:
                self._log("ERROR", error)
            return False

        known = len(forest.frames)
        fresh = forest.hang(child, parent, static)
        frame = forest.frames[forest.numbers[child]]
        assert frame.link is not None
        sample = pose.translation + rotation
        outcome = frame.link.insert(stamp, frame.parent_number, sample, True)
        # A name that comes up is news even if the sample is refused; a parent that was
        # known is none, or each new child would wake whoever waits for something below it.
        named = [new.name for new in forest.frames[known:]]
        if outcome == TOO_OLD:
            self._log("WARN", refusals.old_data(child, stamp, authority))
            self._tell((), static, authority, named)
            return False
        frame.authority = authority
        if fresh or outcome == RESHAPED:
            self._lookups.drop_plans()
        if self._listeners or self._pending:
            kept = _stamped(parent, child, stamp, sample)
            self._tell((kept,), static, authority, (child, *named))
        return True

    def _tell(
        self,
        samples: Iterable[TransformStamped],
        static: bool,
        authority: str,
        changed: Iterable[str],
    ) -> None:
        """Tell those who listen, then those who wait for one of these frames.

        One that raises keeps nobody else from being told.
        """
        failures: list[Exception] = []
        for sample in samples:
            for listener in self._listeners:
                attempt(failures, listener, sample, static, authority)
        if self._pending:
            failures += self._requests.changed(*changed)
        if len(failures) > 1:
            self._log("ERROR", refusals.also_failed(failures[1:]))
        if failures:
            raise failures[0]

    def set_transforms(
        self,
        parent: str,
        child: str,
        stamps: "npt.ArrayLike",
        translations: "npt.ArrayLike",
        rotations: "npt.ArrayLike",
        authority: str = "",
    ) -> "Insertion":
        """Remember many samples of one link that moves, as if set one by one in their order.

        Whoever listens is told each of them, and whoever waits is asked again, once all
        are in.

        Args:
            parent: The frame the poses are given in.
            child: The frame whose poses they are.
            stamps: Whole nanoseconds, shape (n,), in any order.
            translations: Metres, shape (n, 3).
            rotations: Quaternions in xyzw order, shape (n, 4); any finite one but zero.
            authority: Who sent them.

        Returns:
            Which rows were taken, and why the others were not; true if all were. The log
            is told of the first ten.

        Raises:
            TypeError: If the stamps are no whole numbers.
            ValueError: If a shape does not fit.
        """
        from tftool.frames import bulk_insert

        known = len(self._forest.frames)
        link = (parent, child, authority)
        report, rows = bulk_insert.insert(
            self._forest, self._log, self.max_frames, link, stamps, translations, rotations
        )
        self._lookups.drop_plans()
        if report.accepted.any():
            parent, child = names.stripped(parent), names.stripped(child)
            taken = (
                _stamped(parent, child, stamp, sample)
                for stamp, sample in rows.taken(report.accepted)
            )
            grown = len(self._forest.frames) > known
            news = (child, parent) if grown else (child,)
            self._tell(taken if self._listeners else (), False, authority, news)
        return report

    def clear(self) -> None:
        """Forget all that moves; names, statics and pending requests stay."""
        for frame in self._forest.frames:
            if frame.link is not None:
                frame.link.clear()
        self._lookups.drop_plans()

    def listen(self, callback: Listener) -> Callable[[], None]:
        """Have `callback` called after each accepted sample; call what is returned to stop.

        What it raises, whoever set the sample is given, once all others are told: the first
        such exception, while the log is told of the others. The sample stays.
        """
        self._listeners = (*self._listeners, callback)

        def stop() -> None:
            self._listeners = tuple(one for one in self._listeners if one is not callback)

        return stop


def _parts(transform: TransformStamped) -> tuple[Stamp, str, str, Transform]:
    """The four parts of a sample.

    Raises:
        TypeError: If it is none.
    """
    try:
        stamp, parent, child, pose = transform
    except (TypeError, ValueError):
        pose = None
    if not isinstance(pose, Transform):
        raise TypeError(
            "what is set is a TransformStamped(stamp, frame_id, child_frame_id, Transform(…)), "
            f"not {transform!r:.200}"
        )
    return stamp, parent, child, pose


def _stamped(target: str, source: str, stamp: Stamp, sample: Sample) -> TransformStamped:
    x, y, z, qx, qy, qz, qw = sample
    return TransformStamped(stamp, target, source, rigid.transform((x, y, z), (qx, qy, qz, qw)))
