"""Jumps of a chain of frames that its own motion before and after does not explain."""

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

SIGMAS = 5.0
"""A change beyond what the velocity explains is a step from so many times the edge's noise on."""

LEAST_MOVED = 0.005
"""Metres that a step has at least, unless it turns."""

LEAST_TURNED = float(np.radians(0.3))
"""Radians that a step has at least, unless it moves."""

FEWEST = 6
"""Samples from which on an edge has a velocity before and after a change, and a noise."""


@dataclass(frozen=True, slots=True)
class LocalisationStep:
    """One jump of one edge.

    Attributes:
        edge: Parent and child of the edge.
        stamp: First stamp after the step.
        within: The time from the sample before, nanoseconds.
        moved: Metres that the velocity does not explain.
        turned: Radians that the velocity does not explain.
        drift_moved: Metres that the edge moved between the step before (or its start) and this.
        drift_turned: Radians likewise.
    """

    edge: Edge
    stamp: Stamp
    within: Duration
    moved: float
    turned: float
    drift_moved: float
    drift_turned: float


def steps_of(model: Model, target: str = "", source: str = "") -> tuple[LocalisationStep, ...]:
    """Find the jumps of every moving edge between two frames, in the order of their stamps.

    Args:
        model: Knowledge of the frames.
        target: One end of the chain; without both, the edges that place odometry in a map are
            looked at, else those from the robot's base up.
        source: The other end.

    Raises:
        LookupException: If a frame is unknown, or nothing joins the two.
    """
    found = [step for track in _chain(model, target, source) for step in _steps(track)]
    return tuple(sorted(found, key=lambda step: (step.stamp, step.edge)))


def _chain(model: Model, target: str, source: str) -> list[Track]:
    """Return the moving edges of the chain."""
    localisation = [track for track in model.dynamic if track.is_localisation]
    if not target and not source and localisation:
        return localisation
    base = next((one for tree in model.trees if (one := base_of(tree))), "")
    target, source = target or model.fixed_frame, source or base
    if not source:
        return list(model.dynamic)
    for name in (target, source):
        if name not in model.frames:
            raise LookupException(f"No transform names '{name}'.", frame=name)
    path = model.path(source, target)
    if path is None:
        raise LookupException(f"Nothing joins '{source}' and '{target}'.")
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
    """Return how far each change is from what the motion before and after explains, and the noise.

    Whatever lies between the velocities before and after is acceleration. Since stamps may be less
    regular than the motion, the same is tried with the change for each sample, and the better of
    the two counts.

    Args:
        changes: From sample to sample, shape (n, 3).
        gaps: Seconds they take, shape (n,).
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
    # Up to a quarter may be steps: the rest of a normal distribution is within 1.15 deviations.
    noise = float(np.percentile(np.minimum(*apart), 75)) / 1.15
    return np.minimum(*lengths), noise
