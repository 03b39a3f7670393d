"""Batch lookups of other libraries, with the same data and stamps as tftool's."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from tftool.buffer.batch.transform_array import TransformArray

Work = Callable[[], object]


@dataclass(frozen=True)
class Peer:
    """Library to compare with: preparation of its data, and comparison of its results."""

    name: str
    module: str
    depth: int
    count: int
    wanted: float
    ready: Callable[[np.ndarray, np.ndarray, np.ndarray], Work]
    compare: Callable[[object, TransformArray], None]
    orders: tuple[str, ...] = ("sorted", "random")


def _wxyz(samples: np.ndarray) -> np.ndarray:
    return samples[..., [6, 3, 4, 5]]


def _same_turns(rotations: np.ndarray, ours: TransformArray, tolerance: float) -> None:
    dots = np.abs(np.einsum("ij,ij->i", rotations, ours.rotations))
    np.testing.assert_allclose(dots, 1.0, rtol=0, atol=tolerance)


def transform_tree_plan(stamps: np.ndarray, samples: np.ndarray) -> Any:
    """Insert all samples into transform_tree (Rust) in one call, and compile its plan."""
    import tf_tree

    depth, count = stamps.shape
    pairs = [(f"f{link}", f"f{link + 1}") for link in range(depth)]
    tree = tf_tree.build(pairs, capacity=2 * count, interp="lerpslerp")
    for link, (parent, child) in enumerate(pairs):
        poses = np.concatenate((_wxyz(samples[link]), samples[link, :, :3]), axis=1)
        with tree.publisher(child, parent) as publisher:
            publisher.push_many(stamps[link], poses)
    return tree.plan("f0", f"f{depth}")


def transform_tree(stamps: np.ndarray, samples: np.ndarray, times: np.ndarray) -> Work:
    """Look up all stamps with the compiled plan in one call."""
    plan = transform_tree_plan(stamps, samples)
    return lambda: plan.at(times, layout="quat")


def compare_transform_tree(theirs: np.ndarray, ours: TransformArray) -> None:
    """Compare results in the layout w x y z and translation with tftool's results."""
    np.testing.assert_allclose(theirs[:, 4:], ours.translations, rtol=0, atol=1e-12)
    _same_turns(theirs[:, [1, 2, 3, 0]], ours, 1e-12)


def scipy(stamps: np.ndarray, samples: np.ndarray, times: np.ndarray) -> Work:
    """Interpolate each edge with scipy's Slerp and `interp`, and multiply scipy's rotations."""
    from scipy.spatial.transform import Rotation, Slerp

    origin = int(stamps.min())
    moments = (times - origin) * 1e-9
    links = [
        (
            Slerp((link - origin) * 1e-9, Rotation.from_quat(samples[number, :, 3:])),
            (link - origin) * 1e-9,
            samples[number, :, :3],
        )
        for number, link in enumerate(stamps)
    ]

    def work() -> tuple[np.ndarray, np.ndarray]:
        place, turn = np.zeros((len(moments), 3)), None
        for slerp, at, places in reversed(links):
            step = slerp(moments)
            moved = np.stack([np.interp(moments, at, places[:, axis]) for axis in range(3)], axis=1)
            place = moved if turn is None else step.apply(place) + moved
            turn = step if turn is None else step * turn
        assert turn is not None
        return place, turn.as_quat()

    return work


def compare_scipy(theirs: tuple[np.ndarray, np.ndarray], ours: TransformArray) -> None:
    """Compare scipy's results; seconds as floats lose a few digits."""
    np.testing.assert_allclose(theirs[0], ours.translations, rtol=0, atol=1e-6)
    _same_turns(theirs[1], ours, 1e-9)


def pytransform3d(stamps: np.ndarray, samples: np.ndarray, times: np.ndarray) -> Work:
    """Look up with pytransform3d's manager of moving transforms."""
    from pytransform3d.transform_manager import NumpyTimeseriesTransform, TemporalTransformManager

    origin = int(stamps.min())
    manager = TemporalTransformManager()
    for link, at in enumerate(stamps):
        poses = np.concatenate((samples[link, :, :3], _wxyz(samples[link])), axis=1)
        series = NumpyTimeseriesTransform((at - origin) * 1e-9, poses)
        manager.add_transform(f"f{link + 1}", f"f{link}", series)
    moments = (times - origin) * 1e-9
    source = f"f{len(stamps)}"
    return lambda: manager.get_transform_at_time(source, "f0", moments)


def compare_pytransform3d(theirs: np.ndarray, ours: TransformArray) -> None:
    """Compare only rotations: pytransform3d moves along a screw between two samples."""
    turned = ours.matrices()
    np.testing.assert_allclose(theirs[:, :3, :3], turned[:, :3, :3], rtol=0, atol=1e-6)
    np.testing.assert_allclose(theirs[:, :3, 3], turned[:, :3, 3], rtol=0, atol=1e-2)


def rigid_body_motion(stamps: np.ndarray, samples: np.ndarray, times: np.ndarray) -> Work:
    """Transform points with rigid_body_motion's registry of frames; the points give the pose."""
    import rigid_body_motion as rbm

    rbm.clear_registry() if hasattr(rbm, "clear_registry") else rbm.registry.clear()
    rbm.register_frame("f0", update=True)
    for link, at in enumerate(stamps):
        rbm.register_frame(
            f"f{link + 1}",
            parent=f"f{link}",
            translation=samples[link, :, :3],
            rotation=_wxyz(samples[link]),
            timestamps=at.astype("datetime64[ns]"),
            update=True,
        )
    points = np.broadcast_to(np.array([1.0, 2.0, 3.0]), (len(times), 3)).copy()
    moments = times.astype("datetime64[ns]")
    source = f"f{len(stamps)}"
    return lambda: rbm.transform_points(
        points, outof=source, into="f0", timestamps=moments, return_timestamps=True
    )


def compare_rigid_body_motion(theirs: tuple[np.ndarray, np.ndarray], ours: TransformArray) -> None:
    """Compare the transformed point (1, 2, 3), with a large tolerance.

    rigid_body_motion multiplies the edges at the stamps of one edge, and then interpolates between
    the products.
    """
    assert len(theirs[0]) == len(ours)
    np.testing.assert_allclose(theirs[0], ours.apply((1.0, 2.0, 3.0)), rtol=0, atol=0.1)


PEERS = (
    Peer("transform_tree", "tf_tree", 3, 1_000_000, 3.0, transform_tree, compare_transform_tree),
    Peer("pytransform3d", "pytransform3d", 5, 50_000, 15, pytransform3d, compare_pytransform3d),
    Peer("scipy", "scipy", 5, 100_000, 15, scipy, compare_scipy),
    Peer(
        "rigid-body-motion",
        "rigid_body_motion",
        5,
        100_000,
        6,
        rigid_body_motion,
        compare_rigid_body_motion,
        ("sorted",),  # needed: the library refuses other orders
    ),
)
