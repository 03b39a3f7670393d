"""Poses of one frame in another at many times, with the reasons of failed lookups."""

from dataclasses import dataclass, replace
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import Duration, Stamp, as_seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import Buffer
from tftool.geometry import rigid_arrays as batch

Stamps: TypeAlias = npt.NDArray[np.int64]

MOST_MOMENTS: Final = 20_000_000
"""Maximum number of lookups for one pair: 1.3 GB of poses, or days at 100 Hz."""

MOST_REASONS: Final = 200
"""Maximum number of runs of failed lookups whose reason is determined."""


@dataclass(frozen=True, slots=True)
class RefusedRun:
    """Consecutive times at which a lookup fails.

    Attributes:
        first: First time without a pose, nanoseconds.
        last: Last time without a pose, nanoseconds.
        count: Number of failed lookups.
        reason: tf2's error message for the first failed lookup.
    """

    first: Stamp
    last: Stamp
    count: int
    reason: str


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """Poses of one frame in another over time.

    Attributes:
        path: One pose for each time; NaN if the lookup failed. The signs of the quaternions do not
            jump.
        refusals: Runs of failed lookups, in the order of time.
        moments: Description of the times, such as "at the stamps of 'odom'".
    """

    path: TransformArray
    refusals: tuple[RefusedRun, ...]
    moments: str

    @property
    def target(self) -> str:
        """Name of the frame in which the poses are expressed."""
        return self.path.frame_id

    @property
    def source(self) -> str:
        """Name of the frame whose poses are given."""
        return self.path.child_frame_id

    @property
    def refused(self) -> int:
        """Number of times at which the lookup failed."""
        return len(self.path) - int(np.count_nonzero(self.path.valid))

    def answered(self) -> TransformArray:
        """Return the rows of `path` with a pose, without the failed lookups."""
        return self.path if self.path.valid.all() else self.path[self.path.valid]


@dataclass(frozen=True, slots=True, eq=False)
class Moments:
    """Times at which a pair of frames is looked up.

    Attributes:
        start: First time, nanoseconds; None for the first stamp.
        end: Last time, nanoseconds; None for the last stamp.
        period: Time between lookups, nanoseconds; None for the stamps of the frame with the highest
            rate.
        stamps: Times to use instead of `start`, `end` and `period`, nanoseconds, shape (n,).
        words: Description of `stamps` for error messages.
    """

    start: Stamp | None = None
    end: Stamp | None = None
    period: Duration | None = None
    stamps: Stamps | None = None
    words: str = "at given stamps"


def sample(buffer: Buffer, target: str, source: str, moments: Moments | None = None) -> Trajectory:
    """Look up the pose of one frame in another at many times.

    Args:
        buffer: Source of the frames.
        target: Frame in which the results are expressed.
        source: Frame to look up.
        moments: Times of the lookups; None for the stamps of the frame with the highest rate.

    Raises:
        TransformException: If a name is unknown, the frames are not connected, or no lookup
            succeeds.
        UsageError: If there are no times, or more than `MOST_MOMENTS`.
    """
    moments = moments or Moments()
    asked, words = _asked(buffer, target, source, moments)
    path = buffer.lookup_transforms(target, source, asked, missing="nan")
    if not len(asked):
        raise UsageError(
            f"The requested time span contains no time to look up: {words}. Choose a longer span."
        )
    if not path.valid.any():
        # Raises the error of the first failed lookup.
        buffer.lookup_transform(target, source, int(asked[0]))
    path = replace(path, rotations=continuous(path.rotations, path.valid))
    return Trajectory(path, _refusals(buffer, path), words)


def only_chain(buffer: Buffer) -> tuple[str, str]:
    """Return the root and the last frame of a buffer whose frames form a single chain.

    Raises:
        InputError: If the frames form several chains.
    """
    frames = buffer.frames()
    parents = {frame: buffer.parent(frame) for frame in frames}
    roots = [frame for frame in frames if parents[frame] is None]
    leaves = sorted(set(frames) - set(parents.values()))
    if len(roots) != 1 or len(leaves) != 1 or len(frames) < 2:
        raise InputError(
            f"The frames form {len(leaves)} chains, with the last frames "
            f"{', '.join(leaves[:5])}{' …' if len(leaves) > 5 else ''}: name a pair of frames with "
            "--pair TARGET:SOURCE."
        )
    return roots[0], leaves[0]


def trajectory_of(path: TransformArray) -> Trajectory:
    """Return poses as a trajectory, without reasons for rows without a pose."""
    turned = replace(path, rotations=continuous(path.rotations, path.valid))
    runs = tuple(
        RefusedRun(int(path.stamps[first]), int(path.stamps[end - 1]), end - first, "")
        for first, end in _runs(~path.valid)
    )
    return Trajectory(turned, runs, "at given stamps")


def links_between(buffer: Buffer, target: str, source: str) -> list[str]:
    """Return the frames on the path between two frames, without their common ancestor.

    For a frame with several parents, the path uses the newest parent.

    Raises:
        TransformException: If a name is unknown, or the frames are in different trees.
    """
    above = [_ancestors(buffer, frame) for frame in (target, source)]
    shared = next((frame for frame in above[0] if frame in above[1]), None)
    if shared is None or not all(map(buffer.frame_exists, (target, source))):
        # Raises an error with the reason.
        buffer.lookup_transform(target, source)
        return []
    return [frame for side in above for frame in side[: side.index(shared)]]


def fastest(buffer: Buffer, links: list[str]) -> tuple[str, Stamps] | None:
    """Return the frame with the shortest sample period, and its stamps; None if all are static."""
    found: tuple[float, int, str, Stamps] | None = None
    for frame in links:
        held = buffer.samples(frame)
        if held.is_static or not len(held):
            continue
        stamps = np.unique(held.stamps)
        period = float(np.median(np.diff(stamps))) if len(stamps) > 1 else np.inf
        if found is None or (period, -len(stamps)) < found[:2]:
            found = period, -len(stamps), frame, stamps
    return None if found is None else found[2:]


def moving_span(buffer: Buffer, links: list[str]) -> tuple[Stamp, Stamp]:
    """Return the first and the last stamp of moving frames; (0, 0) if all frames are static."""
    ends = []
    for frame in links:
        held = buffer.samples(frame)
        if not held.is_static and len(held):
            ends += [int(held.stamps[0]), int(held.stamps[-1])]
    return (min(ends), max(ends)) if ends else (0, 0)


def continuous(rotations: batch.Floats, valid: npt.NDArray[np.bool_] | None = None) -> batch.Floats:
    """Return rotations with the quaternions' signs changed to avoid jumps; NaN rows are skipped.

    Args:
        rotations: Unit quaternions x y z w, shape (n, 4).
        valid: Mask of the valid rotations, shape (n,); None if all are valid.
    """
    held = rotations if valid is None or valid.all() else rotations[valid]
    if len(held) < 2:
        return rotations
    turns_back = np.einsum("ij,ij->i", held[:-1], held[1:]) < 0.0
    if not turns_back.any():
        return rotations
    flipped = np.concatenate(([False], np.logical_xor.accumulate(turns_back)))
    held = np.where(flipped[:, np.newaxis], -held, held)
    if valid is None or valid.all():
        return held
    found = rotations.copy()
    found[valid] = held
    return found


def evenly(start: Stamp, end: Stamp, period: Duration) -> Stamps:
    """Return evenly spaced times from `start` to `end` without 0, the time that means "latest".

    Raises:
        UsageError: If there are more than `MOST_MOMENTS`.
    """
    count = max(0, end - start) // period + 1
    if count > MOST_MOMENTS:
        raise UsageError(
            f"Every {as_seconds(period):g} s over {as_seconds(end - start):,.0f} s would be "
            f"{count:,} times, but at most {MOST_MOMENTS:,} are possible: use a lower rate. If "
            "the recording is shorter, a stamp is wrong: 'tftool info' shows the first and the "
            "last stamp."
        )
    return max(start, 1) + period * np.arange(count, dtype=np.int64)


def _asked(buffer: Buffer, target: str, source: str, moments: Moments) -> tuple[Stamps, str]:
    if moments.stamps is not None:
        stamps = np.unique(np.asarray(moments.stamps, dtype=np.int64))
        return _within(stamps[stamps > 0], moments), moments.words
    links = links_between(buffer, target, source)
    if moments.period is not None:
        low, high = moving_span(buffer, links)
        start = low if moments.start is None else moments.start
        end = high if moments.end is None else moments.end
        return evenly(start, end, moments.period), f"every {as_seconds(moments.period):g} s"
    found = fastest(buffer, links)
    if found is None:
        # All edges are static, so use any time other than 0, which would mean the latest.
        alone = max(1, moments.start or moving_span(buffer, buffer.frames())[0])
        words = "at one moment, because nothing between the two frames moves in this source"
        return np.array([alone], dtype=np.int64), words
    return _within(found[1], moments), f"at the stamps of '{found[0]}'"


def _within(stamps: Stamps, moments: Moments) -> Stamps:
    first, last = 0, len(stamps)
    if moments.start is not None:
        first = int(np.searchsorted(stamps, moments.start, "left"))
    if moments.end is not None:
        last = int(np.searchsorted(stamps, moments.end, "right"))
    return stamps[first:last]


def _ancestors(buffer: Buffer, frame: str) -> list[str]:
    """Return a frame and all its ancestors, up to a root or once around a loop."""
    found = {frame: None}
    above = buffer.parent(frame)
    while above is not None and above not in found:
        found[above] = None
        above = buffer.parent(above)
    return list(found)


def _refusals(buffer: Buffer, path: TransformArray) -> tuple[RefusedRun, ...]:
    runs: list[RefusedRun] = []
    for first, end in _runs(~path.valid):
        stamp = int(path.stamps[first])
        reason = ""
        if len(runs) < MOST_REASONS:
            reason = buffer.why_not(path.frame_id, path.child_frame_id, stamp)
        runs.append(RefusedRun(stamp, int(path.stamps[end - 1]), end - first, reason))
    return tuple(runs)


def _runs(flags: npt.NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return (first index, last index + 1) of each run of true flags."""
    edges = np.diff(np.concatenate(([0], flags.astype(np.int8), [0])))
    firsts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return list(zip(firsts.tolist(), ends.tolist(), strict=True))
