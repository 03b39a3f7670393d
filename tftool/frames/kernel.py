"""The arithmetic of a batch: one plan, many moments."""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from tftool.frames.columns import Column, Stamps
from tftool.frames.history import Sample
from tftool.geometry import batch
from tftool.geometry.batch import Floats

Edge: TypeAlias = "Column | Sample | None"
"""A link that moves, or the one sample of one that does not."""


def solve(
    up: Sequence[Edge],
    down: Sequence[Edge],
    times: Stamps,
    translations: Floats,
    rotations: Floats,
) -> None:
    """Write the pose of source in target at each moment.

    Args:
        up: From the source to where both sides meet.
        down: From the target to there.
        times: Moments for which every link has data, shape (n,).
        translations: Is written to, shape (n, 3).
        rotations: Is written to, shape (n, 4).
    """
    x, q = _side(up, times)
    u, v = _side(down, times)
    back = batch.conjugate(v)
    translations[:] = batch.rotate(back, x - u)
    rotations[:] = batch.canonical(batch.unit(batch.multiply(back, q)))


def _side(edges: Sequence[Edge], times: Stamps) -> tuple[Floats, Floats]:
    n = len(times)
    x, q = np.zeros((n, 3)), np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), (n, 4))
    for edge in edges:
        if isinstance(edge, Column):
            t, r = _poses(edge, times)
        else:
            assert edge is not None
            t, r = np.array(edge[:3]), np.array(edge[3:])
        x = batch.rotate(np.broadcast_to(r, (n, 4)), x) + t
        q = batch.multiply(np.broadcast_to(r, (n, 4)), q)
    return x, q


def _poses(column: Column, times: Stamps) -> tuple[Floats, Floats]:
    stamps, last = column.stamps, len(column.stamps) - 1
    index = np.searchsorted(stamps, times, "right") - 1
    if stamps[0] != stamps[last]:
        # Of several oldest samples, the first that came.
        index[times == stamps[0]] = 0
    after = np.minimum(index + 1, last)
    gap = stamps[after] - stamps[index]
    ratio = (times - stamps[index]) / np.where(gap == 0, 1, gap)
    if column.parents is not None:
        ratio[column.parents[after] != column.parents[index]] = 0.0
    first, second = column.samples[index], column.samples[after]
    t = first[:, :3] + ratio[:, None] * (second[:, :3] - first[:, :3])
    q = np.where(
        (ratio == 0.0)[:, None],
        first[:, 3:],
        batch.slerp(first[:, 3:], second[:, 3:], ratio),
    )
    return t, q
