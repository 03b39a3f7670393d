"""Least-squares fit of a mount: A(t + d) · X = Y · B(t), with robust weights.

A and B are two motions: poses over time of two frames on one rigid body, each in its own fixed
frame. X is the mount: the pose of B's moving frame in A's moving frame. Y is the pose of B's fixed
frame in A's fixed frame, and d is the clock offset. If one motion drifts, as odometry does, time is
divided into segments, and each segment has a pose Y of its own. The poses Y are eliminated (Schur
complement), so that each iteration solves one small linear system.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from tftool.frames.calibration.body_motion import BodyMotion, Floats
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.conversions import quaternion_from_matrix

ROUNDS: Final = 12
_CLIP: Final = 5.0
"""Number of standard deviations at which a residual has a quarter of the full weight."""

MOUNT, SHIFT, DRIFT, SCALE, JOIN = slice(0, 6), 6, 7, 8, slice(9, 15)
"""Indices of the parameters: mount, clock offset, its drift, scale, pose Y of the fixed frames."""


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """State of the fit of A(t + d) · X = Y · B(t): estimated parameters, and statistics.

    Attributes:
        turn: Rotation of the mount X, quaternion.
        shift: Translation of the mount X, metres.
        offset: Clock offset d minus its first estimate, at the time `Problem.middle`, seconds.
        drift: Change of the clock offset d per second.
        scale: Factor of the translations of motion A.
        joins: Rotation of the pose Y between the fixed frames, one per time segment, shape (k, 4).
        places: Translation of the pose Y in metres, one per time segment, shape (k, 3).
        noise: Standard deviation of one residual along one axis: radians, metres.
        cost: Mean robust loss of the residuals; 1 if the residuals are Gaussian.
        blocks: Normal equations of each time block: matrices and right sides.
    """

    turn: Floats
    shift: Floats
    offset: float
    drift: float = 0.0
    scale: float = 1.0
    joins: Floats = field(default_factory=lambda: np.zeros((0, 4)))
    places: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    noise: tuple[float, float] = (1.0, 1.0)
    blocks: tuple[Floats, Floats] = field(default_factory=lambda: (np.zeros(0), np.zeros(0)))


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """Inputs of the fit: two motions, A and B, on one time axis.

    Attributes:
        a: Motion A, which is interpolated.
        times: Times of B's poses on A's time axis, by the first estimate of the clock offset,
            seconds, shape (n,).
        positions: Positions of B, shape (n, 3).
        rotations: Rotations of B, shape (n, 4).
        middle: Time at which the clock offset is estimated, seconds.
    """

    a: BodyMotion
    times: Floats
    positions: Floats
    rotations: Floats
    middle: float

    def between(self, begin: float, end: float) -> "Problem":
        """Return the same problem with only the poses of motion B between two times."""
        kept = (self.times >= begin) & (self.times < end)
        return replace(
            self,
            times=self.times[kept],
            positions=self.positions[kept],
            rotations=self.rotations[kept],
        )


def matrices(quaternions: Floats) -> Floats:
    """Convert quaternions, shape (n, 4), to rotation matrices, shape (n, 3, 3)."""
    return batch.matrices(np.zeros((len(quaternions), 3)), quaternions)[:, :3, :3]


def turned_by(vector: Floats) -> Floats:
    """Convert a rotation vector, or an array of shape (..., 3), to quaternions, shape (..., 4)."""
    half = 0.5 * np.linalg.norm(vector, axis=-1, keepdims=True)
    return batch.unit(np.concatenate([vector * 0.5 * np.sinc(half / np.pi), np.cos(half)], axis=-1))


def cross(vectors: Floats) -> Floats:
    """Return the matrices whose products are cross products with the vectors, shape (n, 3, 3)."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)


def mean_pose(turns: Floats, places: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """Return the weighted means of rotations (method of Markley, 2007) and of positions."""
    _, vectors = np.linalg.eigh((turns * weights[:, None]).T @ turns)
    return vectors[:, -1], (places * weights[:, None]).sum(axis=0) / weights.sum()


def refine(
    problem: Problem,
    start: Fit,
    free: Sequence[Floats],
    segments: npt.NDArray[np.intp],
    rounds: int = ROUNDS,
) -> Fit:
    """Improve a fit by Gauss-Newton steps with robust weights.

    Args:
        problem: The two motions.
        start: Initial state. The poses Y between the fixed frames are computed anew if there are
            more or fewer segments.
        free: Directions along which the fit may move, among the 9 parameters without the poses Y.
        segments: Time segment of each pose of motion B, numbered from 0 without gaps, shape (n,).
        rounds: Number of iterations.
    """
    count = int(segments[-1]) + 1
    fit = start
    basis = np.array(free).T
    for _ in range(rounds):
        rows = _Residuals(problem, fit, segments, count)
        if not rows.valid.any():
            return fit
        fit = rows.fit
        normal, right = rows.normal(basis)
        fit = _moved(fit, rows, basis, normal, right)
    rows = _Residuals(problem, fit, segments, count)
    return replace(rows.fit, noise=rows.noise, blocks=rows.blocks(basis))


class _Residuals:
    """Residuals of a fit, with derivatives and weights: six rows per pose of the second motion."""

    def __init__(
        self, problem: Problem, fit: Fit, segments: npt.NDArray[np.intp], count: int
    ) -> None:
        aside = problem.times - problem.middle
        times = problem.times + fit.offset + fit.drift * aside
        positions, turns, self.valid = problem.a.at(times)
        speeds, rates = problem.a.velocities(times)
        self.segments, self.count = segments, count
        turns_m = batch.multiply(turns, np.broadcast_to(fit.turn, turns.shape))
        arms = batch.rotate(turns, np.broadcast_to(fit.shift, positions.shape))
        places_m = fit.scale * positions + arms
        self.fit = fit = self._with_joins(problem, fit, turns_m, places_m)
        joins = fit.joins[segments]
        turns_n = batch.multiply(joins, problem.rotations)
        reached = batch.rotate(joins, problem.positions)
        error_r = batch.rotation_vectors(batch.multiply(batch.conjugate(turns_n), turns_m))
        error_t = places_m - reached - fit.places[segments]
        self.errors = np.concatenate([error_r, error_t], axis=1)
        of_a, of_x = matrices(turns), matrices(fit.turn[None])[0]
        jacobian = np.zeros((len(times), 6, 15))
        jacobian[:, :3, :3] = np.eye(3)
        jacobian[:, 3:, 3:6] = of_a
        jacobian[:, :3, SHIFT] = rates @ of_x
        swing = np.cross(rates, fit.shift)
        jacobian[:, 3:, SHIFT] = fit.scale * speeds + np.einsum("nij,nj->ni", of_a, swing)
        jacobian[:, :, DRIFT] = jacobian[:, :, SHIFT] * aside[:, None]
        jacobian[:, 3:, SCALE] = positions
        jacobian[:, :3, 9:12] = -matrices(problem.rotations).transpose(0, 2, 1)
        jacobian[:, 3:, 9:12] = matrices(joins) @ cross(problem.positions)
        jacobian[:, 3:, 12:15] = -np.eye(3)
        self.jacobian = jacobian
        self._separate(of_a, of_x)
        self._weigh()

    def _separate(self, of_a: Floats, of_x: Floats) -> None:
        """Subtract the part of the translation residuals that follows from the rotation residuals.

        An error in the rotation of the first motion appears twice: in the rotation residual, and
        through the lever arm between the two frames in the translation residual. Half of a rotation
        residual is expected to come from the first motion. Without this common part the rows are
        independent, as least squares assumes.

        Args:
            of_a: Rotation matrices of the first motion, shape (n, 3, 3).
            of_x: Rotation matrix of the mount, shape (3, 3).
        """
        lever = of_a @ (-0.5 * cross(self.fit.shift[None])[0] @ of_x)
        self.errors[:, 3:] -= np.einsum("nij,nj->ni", lever, self.errors[:, :3])
        self.jacobian[:, 3:] -= lever @ self.jacobian[:, :3]

    def _with_joins(self, problem: Problem, fit: Fit, turns: Floats, places: Floats) -> Fit:
        """Return the fit, with new poses Y if the number of time segments changed."""
        if len(fit.joins) == self.count:
            return fit
        back = batch.conjugate(problem.rotations)
        joins = batch.multiply(turns, back)
        origins = places - batch.rotate(joins, problem.positions)
        found = np.zeros((self.count, 4)), np.zeros((self.count, 3))
        found[0][:, 3] = 1.0
        for number in range(self.count):
            chosen = (self.segments == number) & self.valid
            if not chosen.any():
                continue
            weights = np.ones(int(chosen.sum()))
            for _ in range(5):
                turn, _place = mean_pose(joins[chosen], origins[chosen], weights)
                angles = batch.angles_between(
                    joins[chosen], np.broadcast_to(turn, (len(weights), 4))
                )
                weights = 1.0 / (1.0 + (angles / max(np.median(angles), 1e-9)) ** 2)
            reached = batch.rotate(
                np.broadcast_to(turn, (len(weights), 4)), problem.positions[chosen]
            )
            found[0][number], found[1][number] = turn, np.median(places[chosen] - reached, axis=0)
        return replace(fit, joins=found[0], places=found[1])

    def _weigh(self) -> None:
        turned = np.linalg.norm(self.errors[:, :3], axis=1)
        moved = np.linalg.norm(self.errors[:, 3:], axis=1)
        # The median length of a vector of three Gaussian numbers is 1.538 standard deviations.
        radians, metres = (
            max(float(np.median(one[self.valid])) / 1.538, 1e-7) for one in (turned, moved)
        )
        self.noise = radians, metres
        sigma = np.repeat(self.noise, 3)
        squared = ((self.errors / sigma) ** 2).sum(axis=1) / 6.0
        self.weights = np.where(self.valid, (1.0 + squared / _CLIP**2) ** -2, 0.0)
        scaled = np.sqrt(self.weights)[:, None] / sigma
        self.errors_w = self.errors * scaled
        self.jacobian_w = self.jacobian * scaled[:, :, None]

    def sums(self, starts: npt.NDArray[np.intp]) -> tuple[Floats, Floats]:
        """Return the normal equations of each block of poses; a block begins at each start."""
        square = np.einsum("nij,nik->njk", self.jacobian_w, self.jacobian_w, optimize=True)
        right = np.einsum("nij,ni->nj", self.jacobian_w, self.errors_w)
        return np.add.reduceat(square, starts), np.add.reduceat(right, starts)

    def by_segment(self, basis: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Eliminate the poses Y from the normal equations of each time segment.

        Returns:
            Matrices and right sides of the reduced equations along `basis`, and the matrices and
            vectors from which the poses Y follow.
        """
        starts = np.flatnonzero(np.diff(self.segments, prepend=-1))
        square, right = self.sums(starts)
        inner = square[:, JOIN, JOIN] + 1e-9 * np.eye(6)
        mixed = basis.T @ square[:, :9, JOIN]
        back = np.linalg.solve(
            inner, np.concatenate([mixed.transpose(0, 2, 1), right[:, JOIN, None]], axis=2)
        )
        solved, rest = back[:, :, :-1], back[:, :, -1]
        reduced = basis.T @ square[:, :9, :9] @ basis - mixed @ solved
        gradient = right[:, :9] @ basis - np.einsum("kij,kj->ki", mixed, rest)
        return reduced, gradient, solved, rest

    def normal(self, basis: Floats) -> tuple[Floats, Floats]:
        reduced, gradient, self.solved, self.rest = self.by_segment(basis)
        return reduced.sum(axis=0), gradient.sum(axis=0)

    def blocks(self, basis: Floats) -> tuple[Floats, Floats]:
        """Return matrices and right sides of each time block's normal equations, for a bootstrap.

        With several segments, each segment is a block. With one segment, the segment is divided
        into blocks, and the equations include the parameters of Y.
        """
        if self.count > 1:
            reduced, gradient, _, _ = self.by_segment(basis)
            return reduced, gradient
        starts = np.unique(np.linspace(0, len(self.segments), _BLOCKS, endpoint=False).astype(int))
        square, right = self.sums(starts)
        whole = np.zeros((15, basis.shape[1] + 6))
        whole[:9, :-6], whole[JOIN, -6:] = basis, np.eye(6)
        return whole.T @ square @ whole, right @ whole


_BLOCKS: Final = 24


def _moved(fit: Fit, rows: _Residuals, basis: Floats, normal: Floats, right: Floats) -> Fit:
    damped = normal + 1e-9 * np.diag(np.maximum(np.diag(normal), 1e-12))
    step = -np.linalg.solve(damped, right)
    joined = -(rows.rest + rows.solved @ step)
    change = basis @ step
    change[:3] = np.clip(change[:3], -0.5, 0.5)
    change[SHIFT] = np.clip(change[SHIFT], -0.1, 0.1)
    return replace(
        fit,
        turn=batch.unit(batch.multiply(fit.turn[None], turned_by(change[None, :3])))[0],
        shift=fit.shift + change[3:6],
        offset=fit.offset + float(change[SHIFT]),
        drift=fit.drift + float(change[DRIFT]),
        scale=fit.scale + float(change[SCALE]),
        joins=batch.unit(batch.multiply(fit.joins, turned_by(joined[:, :3]))),
        places=fit.places + joined[:, 3:],
    )


def spread(fit: Fit, draws: int = 200, seed: int = 0) -> Floats:
    """Return the standard deviations of the free parameters, by block bootstrap.

    For each resampling of the blocks, the fit is moved by one linear step.

    Returns:
        Standard deviations along the free directions, then of the pose between the fixed frames if
        there is only one segment, shape (p,).
    """
    square, right = fit.blocks
    count = len(square)
    dice = np.random.default_rng(seed)
    times = dice.multinomial(count, np.full(count, 1.0 / count), size=draws).astype(np.float64)
    squares = np.tensordot(times, square, axes=1)
    rights = times @ right
    ridge = (
        1e-9
        * np.eye(square.shape[1])
        * np.maximum(np.trace(squares, axis1=1, axis2=2), 1e-12)[:, None, None]
    )
    steps = np.linalg.solve(squares + ridge, rights[..., None])[..., 0]
    # Percentiles instead of the variance: a resampling without any turn is an outlier.
    low, high = np.percentile(steps, [15.87, 84.13], axis=0)
    few = np.sqrt(count / max(1.0, count - 1.0))
    return np.asarray(0.5 * (high - low) * few)


_PAIRS: Final = 4000
_LONGEST: Final = 10.0  # seconds between the poses of a pair
_SMALLEST, _LARGEST = np.radians(12.0), np.radians(150.0)
"""Limits of a pair's turn: smaller turns are mostly noise; near 180° the axis flips."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionPairs:
    """Motions of the two moving frames, A and B, over the same n pairs of times, one per row.

    Attributes:
        turns_a: Rotation vectors of A, radians about the axes of A, shape (n, 3).
        turns_b: Rotation vectors of B, radians about the axes of B, shape (n, 3).
        moves_a: Translations of A along the axes of A, metres, shape (n, 3).
        moves_b: Translations of B along the axes of B, metres, shape (n, 3).
        rotations_a: The rotations of `turns_a` as quaternions, shape (n, 4).
        largest: Largest angle that A turns by in ten seconds, radians.
    """

    turns_a: Floats
    turns_b: Floats
    moves_a: Floats
    moves_b: Floats
    rotations_a: Floats
    largest: float


def pairs_of(problem: Problem) -> MotionPairs:
    """Choose pairs of poses at most ten seconds apart; A turns at most 150° in between."""
    places, turns, valid = problem.a.at(problem.times)
    known = np.flatnonzero(valid)
    dice = np.random.default_rng(0)
    first = dice.choice(known, 3 * _PAIRS)
    later = problem.times[first] + dice.uniform(0.2, _LONGEST, len(first))
    second = np.minimum(np.searchsorted(problem.times, later), len(valid) - 1)
    kept = valid[second] & (problem.times[second] - problem.times[first] <= _LONGEST)
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
    """Return the quaternion that rotates `turns_b` to `turns_a`, and the weight of each pair."""
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
    """Return robust weights of errors: near 1 for a small error, 0.5 for twice the median error."""
    return np.asarray(1.0 / (1.0 + (off / max(2.0 * np.median(off), 1e-9)) ** 2))


def _solved(design: Floats, right: Floats, weights: Floats, ridge: float) -> tuple[Floats, Floats]:
    """Solve linear equations robustly, with three rows per pair of poses.

    Returns:
        The solution, and the error of each pair.
    """
    for _ in range(10):
        square = np.einsum("n,nij,nik->jk", weights, design, design)
        square += ridge * max(np.trace(square), 1e-9) * np.eye(len(square))
        found = np.linalg.solve(square, np.einsum("n,nij,ni->j", weights, design, right))
        off = np.linalg.norm(design @ found - right, axis=1)
        weights = _weights(off)
    return found, off


def lever(pairs: MotionPairs, turn: Floats, weights: Floats) -> tuple[Floats, float]:
    """Solve (R_A - I) t_X = R_X t_B - t_A robustly for the translation t_X of the mount.

    R and t are rotation and translation: of the first motion (A), the second motion (B), and the
    mount (X).

    Returns:
        The translation, and the median error, metres.
    """
    rows = matrices(pairs.rotations_a) - np.eye(3)
    moves = batch.rotate(np.broadcast_to(turn, pairs.rotations_a.shape), pairs.moves_b)
    right = moves - pairs.moves_a
    shift, off = _solved(rows, right, weights, 1e-6)
    return shift, float(np.median(off))


def about_one_axis(pairs: MotionPairs, axis: Floats, start: Floats) -> tuple[Floats, Floats, float]:
    """Compute the mount from motions about one axis, without the translation along the axis.

    The rotation vectors do not determine the mount's rotation about the axis. The translations
    determine this angle, because they depend linearly on the cosine and sine of the angle.

    Args:
        pairs: Motions that turn about one axis.
        axis: The axis in the moving frame of the first motion, a unit vector.
        start: Quaternion of a rotation that maps the axis in the second moving frame to `axis`.

    Returns:
        Rotation and translation of the mount (0 along the axis), and the median error, metres.
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
