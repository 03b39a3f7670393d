"""Jumps of frames (localisation steps), as when a localiser corrects the pose of the robot."""

from dataclasses import dataclass

import numpy as np

from tftool.base.errors import LookupException
from tftool.base.stamps import NANOSECONDS, Duration, Stamp
from tftool.doctor.findings import Edge
from tftool.doctor.missing_joins import base_of
from tftool.doctor.model import Model
from tftool.doctor.stamp_stream import Track
from tftool.geometry.rigid_arrays import (
    Floats,
    conjugate,
    multiply,
    rotate,
    rotation_vectors,
    unit,
)
from tftool.recordings.contract import percentile

SIGMAS = 5.0
"""Number of standard deviations of an edge's noise from which an unexplained change is a step."""

LEAST_MOVED = 0.005
"""Minimum length of a step that does not turn, metres."""

LEAST_TURNED = float(np.radians(0.3))
"""Minimum angle of a step that does not move, radians."""

FEWEST = 6
"""Minimum number of samples to determine velocities around a change, and the noise."""


@dataclass(frozen=True, slots=True)
class LocalisationStep:
    """One jump of one edge.

    Attributes:
        edge: Parent and child of the edge.
        stamp: First stamp after the jump.
        within: Time since the previous sample, nanoseconds.
        moved: Part of the displacement that the velocity does not explain, metres.
        turned: Part of the rotation that the velocity does not explain, radians.
        drift_moved: Displacement from the previous jump (or the first sample) to this jump, metres.
        drift_turned: Rotation from the previous jump (or the first sample) to this jump, radians.
    """

    edge: Edge
    stamp: Stamp
    within: Duration
    moved: float
    turned: float
    drift_moved: float
    drift_turned: float


def steps_of(model: Model, target: str = "", source: str = "") -> tuple[LocalisationStep, ...]:
    """Return the jumps of all moving edges between two frames, in the order of stamps.

    Args:
        model: Model of the evidence.
        target: Frame at one end of the chain. If both frames are empty, the chain is the edges from
            map to odometry; without such edges, the edges from the robot's base up to the root.
        source: Frame at the other end of the chain.

    Raises:
        LookupException: If a frame is unknown, or no edges connect the frames.
    """
    found = [step for track in _chain(model, target, source) for step in _steps(track)]
    return tuple(sorted(found, key=lambda step: (step.stamp, step.edge)))


def _chain(model: Model, target: str, source: str) -> list[Track]:
    """Return the moving edges between two frames; see `steps_of`."""
    localisation = [track for track in model.dynamic if track.is_localisation]
    if not target and not source and localisation:
        return localisation
    base = next((one for tree in model.trees if (one := base_of(tree))), "")
    target, source = target or model.fixed_frame, source or base
    if not source:
        return list(model.dynamic)
    for name in (target, source):
        if name not in model.frames:
            raise LookupException(f"No transform contains the frame '{name}'.", frame=name)
    path = model.path(source, target)
    if path is None:
        raise LookupException(f"No transforms connect '{source}' and '{target}'.")
    return [track for track in path if not track.static]


def _steps(track: Track) -> list[LocalisationStep]:
    later = np.append(True, np.diff(track.sorted_stamps) > 0)
    places = track.by_stamp[later]
    if len(places) < FEWEST:
        return []
    stamps = track.stamps[places]
    gaps = np.diff(stamps) / NANOSECONDS
    where, turns = track.translations[places], unit(track.rotations[places])
    moved = np.diff(where, axis=0)
    turned = rotation_vectors(multiply(turns[1:], conjugate(turns[:-1])))
    off_moved, noise_moved = _unexplained(moved, gaps)
    off_turned, noise_turned = _unexplained(turned, gaps)
    is_step = (off_moved > max(LEAST_MOVED, SIGMAS * noise_moved)) | (
        off_turned > max(LEAST_TURNED, SIGMAS * noise_turned)
    )
    steps, begin = [], 0
    for at in np.flatnonzero(is_step).tolist():
        drift = conjugate(turns[begin])
        drift_turn = rotation_vectors(multiply(drift, turns[at]))
        steps.append(
            LocalisationStep(
                edge=track.edge,
                stamp=int(stamps[at + 1]),
                within=int(stamps[at + 1] - stamps[at]),
                moved=float(off_moved[at]),
                turned=float(off_turned[at]),
                drift_moved=float(np.linalg.norm(rotate(drift, where[at] - where[begin]))),
                drift_turned=float(np.linalg.norm(drift_turn)),
            )
        )
        begin = at + 1
    return steps


def _unexplained(changes: Floats, gaps: Floats) -> tuple[Floats, float]:
    """Compute the jump in each change of a pose, and the noise of the motion.

    A change whose velocity is between the velocities before and after is acceleration, not a jump.
    Velocities are computed per second and per sample, because stamps may be less regular than the
    motion. The smaller jump of these two computations is used.

    Args:
        changes: Translation or rotation vector from each sample to the next, shape (n, 3).
        gaps: Time between the samples, seconds, shape (n,).

    Returns:
        Lengths of the jumps, shape (n,), and standard deviation of the noise; metres or radians.
    """
    lengths, apart = [], []
    for scale in (gaps[:, None], np.ones((len(gaps), 1))):
        rates = changes / scale
        padded = np.vstack((rates[2:0:-1], rates, rates[-2:-4:-1]))
        beside = np.stack([padded[shift : shift + len(rates)] for shift in (0, 1, 3, 4)])
        usual = np.median(beside, axis=0) * scale
        before, after = beside[:2].mean(axis=0) * scale, beside[2:].mean(axis=0) * scale
        between = after - before
        squares = np.einsum("ij,ij->i", between, between)
        share = np.einsum("ij,ij->i", changes - before, between)
        share = np.clip(share / np.where(squares > 0.0, squares, 1.0), 0.0, 1.0)
        lengths.append(np.linalg.norm(changes - before - share[:, None] * between, axis=1))
        apart.append(np.linalg.norm(changes - usual, axis=1))
    # Up to a quarter may be steps. 75 % of a normal distribution are within 1.15 deviations.
    noise = percentile(np.minimum(*apart), 75) / 1.15
    return np.minimum(*lengths), noise
