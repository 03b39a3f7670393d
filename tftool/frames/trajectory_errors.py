"""Absolute and relative errors of one trajectory, compared with another after alignment."""

import re
from dataclasses import dataclass, replace
from typing import Final, Literal, TypeAlias

import numpy as np

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import Duration
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import Buffer
from tftool.frames.pair_samples import Stamps, only_chain, sample
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.conversions import quaternion_from_matrix

Floats = batch.Floats
Fit: TypeAlias = Literal["none", "first", "se3", "sim3"]
Match: TypeAlias = Literal["nearest", "interpolate"]
Pair: TypeAlias = tuple[str, str]

NEAREST: Final[Duration] = 10_000_000
"""Maximum difference between the stamps of two matched poses, nanoseconds."""

_STEP: Final = re.compile(r"(\d+(?:\.\d+)?)(m|deg)?")


@dataclass(frozen=True, slots=True)
class PieceLength:
    """Length of the parts into which a trajectory is divided for the relative error.

    Attributes:
        size: Length, in `unit`.
        unit: "frames" (poses), "m" or "deg".
    """

    size: float = 1.0
    unit: Literal["frames", "m", "deg"] = "frames"

    @classmethod
    def read(cls, text: str) -> "PieceLength":
        """Parse a length such as "1" (one pose), "10m" or "5deg".

        Raises:
            UsageError: If the text is not such a length.
        """
        found = _STEP.fullmatch(text)
        unit = "frames" if found is None or found[2] is None else found[2]
        size = float(found[1]) if found is not None else 0.0
        if size <= 0.0 or (unit == "frames" and size != int(size)):
            raise UsageError(
                "--per must be a number of poses, metres or degrees, such as 1, 10m or 5deg, "
                f"not '{text}'."
            )
        return cls(size, unit)  # type: ignore[arg-type]

    def __str__(self) -> str:
        return f"{self.size:g} {'frame' if self.unit == 'frames' and self.size == 1 else self.unit}"


@dataclass(frozen=True, slots=True, eq=False)
class ErrorColumn:
    """Errors of one kind and unit over time.

    Attributes:
        name: Kind of error: "ape" (absolute) or "rpe" (relative).
        unit: Unit of the errors: "m" or "deg".
        stamps: Times of the errors on the clock of the reference trajectory, nanoseconds, shape
            (n,).
        values: Errors in the unit, shape (n,).
    """

    name: str
    unit: str
    stamps: Stamps
    values: Floats

    def statistics(self) -> dict[str, float]:
        """Return root mean square, mean, median, standard deviation, minimum and maximum errors."""
        values = self.values
        return {
            "rmse": float(np.sqrt(np.mean(values * values))),
            "mean": float(np.mean(values)),
            "median": float(np.median(values)),
            "std": float(np.std(values)),
            "min": float(np.min(values)),
            "max": float(np.max(values)),
        }


@dataclass(frozen=True, slots=True, eq=False)
class TrajectoryErrors:
    """Errors of trajectory B relative to trajectory A.

    Attributes:
        pairs: Target and source in A, and in B.
        matched: Number of poses of B that were compared with a pose of A.
        counts: Number of poses of A, and of B.
        scale: Factor by which the alignment scaled B; 1 except for "sim3".
        fit: Alignment of B with A before the errors were computed.
        match: Rule by which poses of A and B were matched by time.
        step: Length of the parts for the relative error.
        columns: The errors, by kind and unit.
    """

    pairs: tuple[Pair, Pair]
    matched: int
    counts: tuple[int, int]
    scale: float
    fit: Fit
    match: Match
    step: PieceLength
    columns: tuple[ErrorColumn, ...]


def trajectory_errors(
    reference: Buffer,
    estimate: Buffer,
    pairs: tuple[Pair | None, Pair | None] = (None, None),
    *,
    kinds: tuple[str, ...] = ("ape", "rpe"),
    fit: Fit = "none",
    match: Match = "nearest",
    step: PieceLength | None = None,
) -> TrajectoryErrors:
    """Compute the errors of trajectory B, the estimate, relative to trajectory A, the reference.

    Args:
        reference: Frames of A.
        estimate: Frames of B.
        pairs: Target and source frame in A and in B; None if the frames form a single chain.
        kinds: Kinds of error: "ape", "rpe", or both.
        fit: Alignment of B with A before the comparison: none, by the first pose, rigid, or rigid
            with scale.
        match: Whether to compare poses nearest in time, or to interpolate A at the stamps of B.
        step: Length of the parts for the relative error; None for parts of one pose.

    Raises:
        InputError: If A or B has several chains, or too few poses match.
        TransformException: If a pair cannot be looked up.
    """
    step = step or PieceLength()
    first, second = (
        only_chain(side) if pair is None else pair
        for side, pair in zip((reference, estimate), pairs, strict=True)
    )
    a = sample(reference, *first).answered()
    b = sample(estimate, *second).answered()
    counts = len(a), len(b)
    if match == "interpolate":
        found = reference.lookup_transforms(*first, b.stamps, missing="nan")
        b, a = b[found.valid], found[found.valid]
    else:
        a, b = _nearest(a, b)
    if len(a) < 2:
        raise InputError(
            f"Only {len(a)} of {counts[1]} poses of B can be matched with a pose of A in time: "
            "check that A and B use the same clock. 'tftool diff A B --clock-offset' measures "
            "the offset."
        )
    b, scale = fitted(a, b, fit)
    columns: list[ErrorColumn] = []
    if "ape" in kinds:
        columns += _columns("ape", a.stamps, a, b)
    if "rpe" in kinds:
        begins, ends = _pieces(b, step)
        columns += _columns(
            "rpe", a.stamps[ends], _motion(a, begins, ends), _motion(b, begins, ends)
        )
    return TrajectoryErrors(
        (first, second), len(a), counts, scale, fit, match, step, tuple(columns)
    )


def _nearest(a: TransformArray, b: TransformArray) -> tuple[TransformArray, TransformArray]:
    """Match each pose of the shorter trajectory with the longer trajectory's pose nearest in time.

    Returns:
        Poses of `a` and poses of `b`, row by row; pairs that are too far apart in time are left
        out.
    """
    if len(a) > len(b):
        second, first = _nearest(b, a)
        return first, second
    above = np.clip(np.searchsorted(b.stamps, a.stamps), 1, max(1, len(b) - 1))
    below = above - 1
    above = np.minimum(above, len(b) - 1)
    is_above = b.stamps[above] - a.stamps < a.stamps - b.stamps[below]
    nearest = np.where(is_above, above, below)
    near = np.abs(b.stamps[nearest] - a.stamps) <= NEAREST
    return a[near], b[nearest[near]]


def fitted(a: TransformArray, b: TransformArray, fit: Fit) -> tuple[TransformArray, float]:
    """Align trajectory `b` with trajectory `a`; row i of `b` matches row i of `a`.

    Returns:
        The aligned trajectory `b`, and the factor by which it was scaled.

    Raises:
        InputError: If all positions are on one line, so that the rotation is undetermined.

    Source:
        Umeyama, "Least-squares estimation of transformation parameters between two point
        patterns", 1991.
    """
    if fit == "none":
        return b, 1.0
    if fit == "first":
        turn = batch.multiply(a.rotations[:1], batch.conjugate(b.rotations[:1]))
        shift = a.translations[:1] - batch.rotate(turn, b.translations[:1])
        return _moved(b, turn, shift, 1.0), 1.0
    target, source = a.translations, b.translations
    centre_a, centre_b = target.mean(axis=0), source.mean(axis=0)
    spread = source - centre_b
    covariance = (target - centre_a).T @ spread / len(source)
    u, singular, v = np.linalg.svd(covariance)
    if singular[1] <= 1e-12 * max(singular[0], 1e-300):
        raise InputError(
            "All positions are on one line or in one point, so the rotation cannot be "
            "determined: use '--fit first', which fits the first poses only."
        )
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(v))])
    matrix = u @ np.diag(signs) @ v
    scale = 1.0
    if fit == "sim3":
        scale = float((singular * signs).sum() / (spread * spread).sum(axis=1).mean())
    turn = np.array(quaternion_from_matrix(matrix.tolist()))
    shift = centre_a - scale * matrix @ centre_b
    return _moved(b, turn[None, :], shift[None, :], scale), scale


def _moved(path: TransformArray, turn: Floats, shift: Floats, scale: float) -> TransformArray:
    turns = np.broadcast_to(turn, path.rotations.shape)
    return replace(
        path,
        translations=scale * batch.rotate(turns, path.translations) + shift,
        rotations=batch.multiply(turns, path.rotations),
    )


def _motion(path: TransformArray, begins: "np.ndarray", ends: "np.ndarray") -> TransformArray:
    """Return the poses at the indices `ends` relative to the poses at the indices `begins`."""
    back = batch.conjugate(path.rotations[begins])
    moved = batch.rotate(back, path.translations[ends] - path.translations[begins])
    turned = batch.multiply(back, path.rotations[ends])
    return replace(path[ends], translations=moved, rotations=turned)


def _pieces(path: TransformArray, step: PieceLength) -> tuple["np.ndarray", "np.ndarray"]:
    """Divide a trajectory into parts of the length `step`.

    Returns:
        Index of the first pose and index of the last pose of each part.

    Raises:
        InputError: If the trajectory is shorter than one part.
    """
    if step.unit == "frames":
        places = np.arange(0, len(path), int(step.size))
    else:
        moved = np.linalg.norm(np.diff(path.translations, axis=0), axis=1)
        if step.unit == "deg":
            moved = np.degrees(_angles(path.rotations[:-1], path.rotations[1:]))
        places = np.array(_marks(moved.tolist(), step.size), dtype=np.intp)
    if len(places) < 2:
        raise InputError(f"The trajectory is shorter than {step}: give --per a smaller length.")
    return places[:-1], places[1:]


def _marks(moved: list[float], size: float) -> list[int]:
    """Return the indices that divide a path into parts, each at least `size` long.

    Args:
        moved: Distance (or angle) from each pose to the next.
        size: Smallest length of a part.
    """
    marks, gone = [0], 0.0
    for place, one in enumerate(moved, 1):
        gone += one
        if gone >= size:
            marks.append(place)
            gone = 0.0
    return marks


def _columns(
    name: str, stamps: Stamps, a: TransformArray, b: TransformArray
) -> tuple[ErrorColumn, ErrorColumn]:
    distances = np.linalg.norm(b.translations - a.translations, axis=1)
    angles = np.degrees(_angles(a.rotations, b.rotations))
    return ErrorColumn(name, "m", stamps, distances), ErrorColumn(name, "deg", stamps, angles)


def _angles(a: Floats, b: Floats) -> Floats:
    return np.asarray(batch.angles_between(a, b))
