"""Motion of one frame: poses over time, without outliers, and their interpolation."""

from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import TftoolError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.batch.transform_array import TransformArray
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.rigid import Transform
from tftool.recordings.contract import Edge

Floats = batch.Floats
Flags: TypeAlias = npt.NDArray[np.bool_]

LONGEST_GAP: Final = 0.3
"""Time without a sample, seconds, that is not interpolated; for slow streams, 3 periods."""

_LEAST_POSES: Final = 20

AXES: Final = ("x", "y", "z")
ANGLES: Final = ("roll", "pitch", "yaw")


class CalibrationRefused(TftoolError):
    """Error for motions from which no result can be computed.

    Attributes:
        next_motion: Motion to record instead, as an instruction; "" if no motion would help.
    """

    def __init__(self, text: str, next_motion: str = "") -> None:
        """Create the error from its text and from the motion to record instead."""
        super().__init__(text)
        self.next_motion = next_motion


def difference(mount: Transform, other: Transform) -> Floats:
    """Return `mount` minus `other` (two poses of one frame on one parent), shape (6,).

    The numbers are metres along the parent's axes, then degrees about the child's axes.
    """
    shift = np.subtract(mount.translation, other.translation)
    first, second = np.array([mount.rotation]), np.array([other.rotation])
    (turn,) = batch.rotation_vectors(batch.multiply(batch.conjugate(second), first))
    return np.concatenate([shift, np.degrees(turn)])


@dataclass(frozen=True, slots=True, eq=False)
class BodyMotion:
    """Poses of one moving frame in order of time.

    Attributes:
        name: Name of the motion, such as "base_link in odom".
        start: Stamp of time 0, nanoseconds.
        times: Time of each pose, seconds, shape (n,), strictly increasing.
        positions: Metres, shape (n, 3).
        rotations: Unit quaternions x y z w without jumps of sign, shape (n, 4).
    """

    name: str
    start: Stamp
    times: Floats
    positions: Floats
    rotations: Floats

    @classmethod
    def of(cls, path: TransformArray) -> "BodyMotion":
        """Return the motion of `path`, sorted by stamp, without NaN, outliers and repeated stamps.

        Raises:
            CalibrationRefused: If fewer than twenty poses remain.
        """
        path = path if path.valid.all() else path[path.valid]
        stamps, first = np.unique(path.stamps, return_index=True)
        name = f"{path.child_frame_id} in {path.frame_id}"
        if len(stamps) < _LEAST_POSES:
            raise CalibrationRefused(
                f"{name} has too few poses: {len(stamps)} with different stamps, and "
                f"{_LEAST_POSES} are needed.",
                "move for half a minute, turning about two axes",
            )
        turns = batch.unit(path.rotations[first])
        kept = _steady(path.translations[first], turns)
        stamps, first, turns = stamps[kept], first[kept], turns[kept]
        same = np.einsum("ij,ij->i", turns[1:], turns[:-1]) >= 0.0
        signs = np.cumprod(np.concatenate([[1.0], np.where(same, 1.0, -1.0)]))
        times = (stamps - stamps[0]) / NANOSECONDS
        return cls(name, int(stamps[0]), times, path.translations[first], turns * signs[:, None])

    @property
    def duration(self) -> float:
        """Time from the first to the last pose, seconds."""
        return float(self.times[-1])

    @property
    def period(self) -> float:
        """Median time between poses, seconds."""
        return float(np.median(np.diff(self.times)))

    def inverted(self) -> "BodyMotion":
        """Return the inverse motion: the poses of the fixed frame in the moving frame."""
        back = batch.conjugate(self.rotations)
        target, _, source = self.name.partition(" in ")
        places = -batch.rotate(back, self.positions)
        return BodyMotion(f"{source} in {target}", self.start, self.times, places, back)

    def is_planar(self) -> bool:
        """Whether the poses have only x, y and yaw, as planar odometry has."""
        return bool(
            np.ptp(self.positions[:, 2]) < 1e-6 and np.abs(self.rotations[:, :2]).max() < 1e-6
        )

    def at(self, times: Floats) -> tuple[Floats, Floats, Flags]:
        """Interpolate poses: positions linearly, rotations along the shorter arc.

        Args:
            times: Times to interpolate at, seconds on the motion's time axis, shape (m,).

        Returns:
            Positions, shape (m, 3); quaternions, shape (m, 4); and a mask of the times that are
            within the motion and not in a gap, shape (m,).
        """
        above = np.clip(np.searchsorted(self.times, times), 1, len(self.times) - 1)
        low, high = self.times[above - 1], self.times[above]
        longest = max(LONGEST_GAP, 3.0 * self.period)
        valid = (times >= self.times[0]) & (times <= self.times[-1]) & (high - low <= longest)
        share = np.clip((times - low) / (high - low), 0.0, 1.0)[:, None]
        positions = (1.0 - share) * self.positions[above - 1] + share * self.positions[above]
        # Between neighbouring samples, the normalised chord differs from the arc by a microradian.
        turns = (1.0 - share) * self.rotations[above - 1] + share * self.rotations[above]
        return positions, batch.unit(turns), valid

    def velocities(self, times: Floats) -> tuple[Floats, Floats]:
        """Return velocities and angular velocities at some times.

        Velocities are differences of poses over at least a tenth of a second, to reduce the noise.

        Args:
            times: Times on the motion's time axis, seconds, shape (m,).

        Returns:
            Velocities along the axes of the fixed frame, metres per second, and angular velocities
            about the axes of the moving frame, radians per second, each of shape (m, 3).
        """
        half = max(0.05, self.period)
        before, first, _ = self.at(times - half)
        after, last, _ = self.at(times + half)
        turned = batch.rotation_vectors(batch.multiply(batch.conjugate(first), last))
        return (after - before) / (2.0 * half), turned / (2.0 * half)


def poses_of(edge: Edge) -> TransformArray:
    """Return the recorded transforms between one parent and child as poses in order of time."""
    order = np.argsort(edge.stamps, kind="stable")
    poses = edge.translations[order], batch.unit(edge.rotations[order])
    valid = np.asarray(np.isfinite(np.concatenate(poses, axis=1)).all(axis=1))
    return TransformArray(edge.parent, edge.child, edge.stamps[order], *poses, valid)


_USUAL: Final = np.arange(-15, 16)
"""Offsets of the neighbours among which a pose's distance is compared."""


_DENSE: Final = 200
"""Minimum number of poses for which neighbours are close enough to detect spikes."""


def _steady(positions: Floats, turns: Floats) -> "npt.NDArray[np.intp]":
    """Return the indices of all poses except outliers, such as the flipped pose of a detected tag.

    An outlier has a far larger median distance (or angle) to six neighbours than nearby poses have.
    Of the other poses, those far from the midpoints of their neighbours are outliers too.
    """
    kept = np.arange(len(turns))
    if len(turns) < _DENSE:
        return kept
    for reaches, factor in (((-3, -2, -1, 1, 2, 3), 4.0), ((1, 2, 3), 6.0), ((1, 2, 3), 6.0)):
        places, quaternions = positions[kept], turns[kept]
        last = len(kept) - 1
        here = np.arange(len(kept))[:, None]
        near = np.clip(here + reaches, 0, last)
        around, turned = places[near], quaternions[near]
        if min(reaches) > 0:
            across = np.clip(here - reaches, 0, last)
            other = quaternions[across]
            facing = np.sign(np.sum(turned * other, axis=2, keepdims=True))
            around = 0.5 * (around + places[across])
            turned = batch.unit(turned + np.where(facing < 0.0, -other, other))
        away = np.linalg.norm(around - places[:, None], axis=2)
        angles = batch.angles_between(turned, quaternions[:, None])
        good = np.ones(len(kept), dtype=np.bool_)
        for each, least in ((away, 0.005), (angles, np.radians(0.5))):
            middle = np.median(each, axis=1)
            # Not the median, which may be wrong too if many poses are outliers.
            usual = np.quantile(middle[np.clip(here + _USUAL, 0, last)], 0.35, axis=1)
            good &= middle <= np.maximum(factor * usual, least)
        kept = kept[good]
    return kept
