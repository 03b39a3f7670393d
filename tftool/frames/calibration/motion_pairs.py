"""Initial solution of a calibration from pairs of poses, and what the motions determine."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tftool.frames.calibration.motion import Floats
from tftool.frames.calibration.mount_fit import Problem, matrices
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.conversions import quaternion_from_matrix

_PAIRS: Final = 4000
_SMALLEST, _LARGEST = np.radians(12.0), np.radians(150.0)
"""Limits of a pair's turn: smaller turns are mostly noise; near 180° the axis flips."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionPairs:
    """Motions of A and B between pairs of times.

    Attributes:
        turns_a: Rotation vectors of A, radians about the axes of moving_a, shape (n, 3).
        turns_b: Rotation vectors of B, about the axes of moving_b.
        moves_a: Translations of A in moving_a, metres, shape (n, 3).
        moves_b: Translations of B in moving_b.
        rotations_a: Rotations of A, quaternions, shape (n, 4).
        largest: Largest angle that A turns by in ten seconds, radians.
    """

    turns_a: Floats
    turns_b: Floats
    moves_a: Floats
    moves_b: Floats
    rotations_a: Floats
    largest: float


def pairs_of(problem: Problem, offset: float, longest: float = 10.0) -> MotionPairs:
    """Choose pairs of poses between which the body turned by 12° to 150° in `longest` seconds."""
    places, turns, valid = problem.a.at(problem.times + offset)
    known = np.flatnonzero(valid)
    dice = np.random.default_rng(0)
    first = dice.choice(known, 3 * _PAIRS)
    later = problem.times[first] + dice.uniform(0.2, longest, len(first))
    second = np.minimum(np.searchsorted(problem.times, later), len(valid) - 1)
    kept = valid[second] & (problem.times[second] - problem.times[first] <= longest)
    first, second = first[kept], second[kept]

    def moved(positions: Floats, rotations: Floats) -> tuple[Floats, Floats]:
        back = batch.conjugate(rotations[first])
        turned = batch.multiply(back, rotations[second])
        return turned, batch.rotate(back, positions[second] - positions[first])

    rotations_a, moves_a = moved(places, turns)
    rotations_b, moves_b = moved(problem.positions, problem.rotations)
    turns_a, turns_b = map(batch.rotation_vectors, (rotations_a, rotations_b))
    angles = np.linalg.norm(turns_a, axis=1)
    largest = float(np.quantile(angles, 0.98)) if len(angles) else 0.0
    least = min(_SMALLEST, 0.5 * largest)
    wide = np.flatnonzero((angles >= least) & (angles <= _LARGEST))[:_PAIRS]
    return MotionPairs(
        turns_a[wide], turns_b[wide], moves_a[wide], moves_b[wide], rotations_a[wide], largest
    )


def kabsch(pairs: MotionPairs) -> tuple[Floats, Floats]:
    """Return the quaternion that rotates B's rotation vectors to A's, and each pair's weight."""
    weights = np.ones(len(pairs.turns_a))
    for _ in range(10):
        matrix = _aligned(pairs.turns_a * weights[:, None], pairs.turns_b)
        off = np.linalg.norm(pairs.turns_a - pairs.turns_b @ matrix.T, axis=1)
        weights = _weights(off)
    return np.array(quaternion_from_matrix(matrix.tolist())), weights


def _aligned(target: Floats, source: Floats) -> Floats:
    u, _, v = np.linalg.svd(target.T @ source)
    signs = np.diag([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(v))])
    return np.asarray(u @ signs @ v)


def _weights(off: Floats) -> Floats:
    """Return weights: near 1 for small errors, 0.5 for twice the median error."""
    return np.asarray(1.0 / (1.0 + (off / max(2.0 * np.median(off), 1e-9)) ** 2))


def _solved(design: Floats, right: Floats, weights: Floats, ridge: float) -> tuple[Floats, Floats]:
    """Solve linear equations, three rows per pair, robustly; return the solution and each error."""
    for _ in range(10):
        square = np.einsum("n,nij,nik->jk", weights, design, design)
        square += ridge * max(np.trace(square), 1e-9) * np.eye(len(square))
        found = np.linalg.solve(square, np.einsum("n,nij,ni->j", weights, design, right))
        off = np.linalg.norm(design @ found - right, axis=1)
        weights = _weights(off)
    return found, off


def lever(pairs: MotionPairs, turn: Floats, weights: Floats) -> tuple[Floats, float]:
    """Solve (R_A - I) t_X = R_X t_B - t_A robustly for the translation t_X of the mount.

    Returns:
        The translation, and the median error, metres.
    """
    rows = matrices(pairs.rotations_a) - np.eye(3)
    moves = batch.rotate(np.broadcast_to(turn, pairs.rotations_a.shape), pairs.moves_b)
    right = moves - pairs.moves_a
    shift, off = _solved(rows, right, weights, 1e-6)
    return shift, float(np.median(off))


def about_one_axis(pairs: MotionPairs, axis: Floats, start: Floats) -> tuple[Floats, Floats, float]:
    """Solve for the mount's turn about the only axis of rotation, and its translation across it.

    The rotation vectors do not determine the turn about the axis; the translations do, linearly in
    its cosine and sine.

    Args:
        pairs: Motions that turn about one axis.
        axis: The axis in moving_a, a unit vector.
        start: Quaternion of a rotation from B's axis to A's.

    Returns:
        Rotation of the mount X, translation (0 along the axis), and median error.
    """
    moved = batch.rotate(np.broadcast_to(start, pairs.rotations_a.shape), pairs.moves_b)
    along = (moved @ axis)[:, None] * axis
    across = moved - along
    side = np.cross(axis, across)
    rows = matrices(pairs.rotations_a) - np.eye(3)
    plane = np.linalg.svd(axis[None])[2][1:]
    design = np.concatenate([rows @ plane.T, -across[:, :, None], -side[:, :, None]], axis=2)
    right = along - pairs.moves_a
    weights = np.ones(len(rows))
    found, _ = _solved(design, right, weights, 1e-9)
    angle = float(np.arctan2(found[3], found[2]))
    about = np.concatenate([axis * np.sin(angle / 2.0), [np.cos(angle / 2.0)]])
    turn = batch.multiply(about[None], start[None])[0]
    shift, error = lever(pairs, turn, weights)
    return turn, shift - (shift @ axis) * axis, error


def shortest_turn(source: Floats, target: Floats) -> Floats:
    """Return the quaternion of the smallest rotation from one unit vector to another."""
    half = np.concatenate([np.cross(source, target), [1.0 + source @ target]])
    if np.linalg.norm(half) < 1e-6:  # opposite vectors: turn about any perpendicular axis
        across = np.cross(source, np.eye(3)[int(np.argmin(np.abs(source)))])
        half = np.concatenate([across, [0.0]])
    return np.asarray(half / np.linalg.norm(half))
