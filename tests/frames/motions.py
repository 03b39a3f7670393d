"""Simulated motions of one rigid body with a known mount, clock offset and noise."""

from dataclasses import dataclass

import numpy as np

from tftool import Quaternion, Transform, TransformArray, Vector3
from tftool.base.stamps import NANOSECONDS


@dataclass(frozen=True)
class World:
    """Two motions, and the true values."""

    a: TransformArray
    b: TransformArray
    mount: Transform
    fixed_mount: Transform
    offset: float


def quaternions(vectors):
    """Return the quaternions of rotation vectors, shape (n, 4)."""
    angles = np.linalg.norm(vectors, axis=1, keepdims=True)
    half = 0.5 * angles
    return np.concatenate([vectors * np.sinc(half / np.pi) * 0.5, np.cos(half)], axis=1)


def product(p, q):
    """Return the quaternion products, row by row."""
    v, w, x, y = p[:, :3], p[:, 3:], q[:, :3], q[:, 3:]
    vector = w * x + y * v + np.cross(v, x)
    return np.concatenate([vector, w * y - np.sum(v * x, axis=1, keepdims=True)], axis=1)


def turned(q, vectors):
    """Return vectors turned by quaternions, row by row."""
    twice = 2.0 * np.cross(q[:, :3], vectors)
    return vectors + q[:, 3:] * twice + np.cross(q[:, :3], twice)


def path(stamps, frame, child, positions, rotations):
    rows = np.ones(len(stamps), dtype=bool)
    return TransformArray(frame, child, stamps, positions, rotations, rows)


def world(
    seed=0,
    *,
    kind="3d",
    seconds=40.0,
    rates=(100.0, 30.0),
    noise=(0.003, 0.3),
    offset=0.37,
    outliers=0.0,
    ppm=0.0,
    scale=1.0,
    upside=False,
    drift=0.0,
    pace=1.0,
    flips=0.0,
):
    """Simulate a body that moves smoothly, and two chains that measure it.

    Args:
        seed: Seed of all random numbers.
        kind: "3d", "axis" (turns about z only), "planar" (x, y and yaw only), "still" (no turns),
            "rest" (no motion at all).
        seconds: Duration.
        rates: Poses per second of A and B.
        noise: Standard deviation of one pose per axis, metres and degrees.
        offset: Clock of A minus clock of B, seconds.
        outliers: Share of B's poses that are random.
        ppm: Drift of A's clock.
        scale: Factor by which A's translations are too long.
        upside: Whether B is given as the inverse.
        drift: Random walk of A, as a share of the distance after one metre and one radian.
        pace: Factor of the speed.
        flips: Share of B's poses that are turned by half a turn, as by an ambiguous tag.
    """
    dice = np.random.default_rng(seed)

    def waves(times, size):
        total = np.zeros((len(times), 3))
        for axis in range(3):
            for _ in range(6):
                frequency, phase = pace * dice.uniform(0.05, 0.4), dice.uniform(0.0, 6.28)
                total[:, axis] += dice.normal() * np.sin(6.2832 * frequency * times + phase)
        return size * total / np.sqrt(3.0)

    grids = [np.arange(0.0, seconds, 1.0 / rate) for rate in rates]
    everything = np.concatenate(grids)
    positions, vectors = waves(everything, 0.5), waves(everything, 0.6)
    if kind in ("axis", "planar"):
        vectors[:, :2] = 0.0
    if kind == "planar":
        positions[:, 2] = 0.0
    if kind in ("still", "rest"):
        vectors[:] = 0.0
    if kind == "rest":
        positions[:] = 0.0
    rotations = quaternions(vectors)
    split = len(grids[0])
    flat = kind == "planar"
    shift, turn = dice.normal(size=3) * 0.2, dice.normal(size=(1, 3)) * 0.8
    far, round_ = dice.normal(size=3) * 2.0, dice.normal(size=(1, 3))
    if flat:
        turn[:, :2] = round_[:, :2] = 0.0
        far[2] = 0.0
    mount_q, join_q = quaternions(turn), quaternions(round_)
    back_q = join_q * [-1.0, -1.0, -1.0, 1.0]
    rows = len(everything) - split

    def all_rows(values):
        return np.broadcast_to(values, (rows, np.shape(values)[-1]))

    mounted = positions[split:] + turned(rotations[split:], all_rows(shift))
    b_positions = turned(all_rows(back_q), mounted - far)
    b_rotations = product(all_rows(back_q), product(rotations[split:], all_rows(mount_q)))
    a_positions, a_rotations = scale * positions[:split], rotations[:split].copy()

    def noisy(places, turns):
        pushes = dice.normal(size=places.shape) * noise[0]
        twists = dice.normal(size=places.shape) * np.radians(noise[1])
        if flat:
            pushes[:, 2] = 0.0
            twists[:, :2] = 0.0
        return places + pushes, product(turns, quaternions(twists))

    if drift:
        free = np.array([0.0, 0.0, 1.0]) if flat else np.ones(3)
        angles = np.linalg.norm(np.diff(vectors[:split], axis=0), axis=1, keepdims=True)
        walk = np.cumsum(
            dice.normal(size=(len(angles), 3)) * drift * np.sqrt(angles) * free, axis=0
        )
        steps = turned(quaternions(walk), np.diff(a_positions, axis=0))
        sizes = np.sqrt(np.linalg.norm(steps, axis=1, keepdims=True))
        steps += dice.normal(size=steps.shape) * drift * sizes * (1.0 - free if flat else 1.0)
        a_positions[1:] = a_positions[0] + np.cumsum(steps, axis=0)
        a_rotations[1:] = product(quaternions(walk), a_rotations[1:])
    a_positions, a_rotations = noisy(a_positions, a_rotations)
    b_positions, b_rotations = noisy(b_positions, b_rotations)
    bad = dice.random(rows) < outliers
    b_positions[bad] += dice.normal(size=(bad.sum(), 3)) * 0.5
    b_rotations[bad] = product(
        b_rotations[bad], quaternions(dice.normal(size=(bad.sum(), 3)) * 1.5)
    )
    flipped = dice.random(rows) < flips
    b_rotations[flipped] = product(
        b_rotations[flipped], np.broadcast_to([1.0, 0.0, 0.0, 0.0], (flipped.sum(), 4))
    )
    names = ("world", "camera")
    if upside:
        b_rotations = b_rotations * [-1.0, -1.0, -1.0, 1.0]
        b_positions = -turned(b_rotations, b_positions)
        names = ("camera", "world")
    base = 1_700_000_000
    clock = grids[0] + offset + (grids[0] - seconds / 2) * ppm * 1e-6
    stamps = [
        base * NANOSECONDS + (one * NANOSECONDS).astype(np.int64) for one in (clock, grids[1])
    ]
    return World(
        path(stamps[0], "odom", "base_link", a_positions, a_rotations),
        path(stamps[1], *names, b_positions, b_rotations),
        Transform(Vector3(*shift), Quaternion(*mount_q[0])),
        Transform(Vector3(*far), Quaternion(*join_q[0])),
        offset,
    )


def errors(found, truth):
    """Return the errors of a mount: metres by axis, degrees about B's axes."""
    shift = np.subtract(found.translation, truth.translation)
    back = np.array([truth.rotation]) * [-1.0, -1.0, -1.0, 1.0]
    (off,) = product(back, np.array([found.rotation]))
    return shift, np.degrees(2.0 * off[:3] * np.sign(off[3]))
