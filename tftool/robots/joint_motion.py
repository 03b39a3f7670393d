"""Poses of a robot's joints at many times, in arrays."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.geometry import rigid_arrays as batch
from tftool.robots.description import RobotJoint

Floats: TypeAlias = npt.NDArray[np.float64]

Records: TypeAlias = npt.NDArray[np.int64]


Stamps: TypeAlias = npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class JointStates:
    """Positions of some joints at many times.

    Attributes:
        names: Names of the joints, in the order of the columns.
        stamps: Nanoseconds, shape (n,).
        positions: Radians or metres, shape (n, len(names)).
    """

    names: Sequence[str]
    stamps: Stamps
    positions: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(self.names))
        object.__setattr__(self, "stamps", np.asarray(self.stamps, dtype=np.int64))
        object.__setattr__(self, "positions", np.asarray(self.positions, dtype=np.float64))
        count = len(self.stamps) if self.stamps.ndim == 1 else -1
        if self.positions.shape != (count, len(self.names)):
            raise ValueError(
                f"stamps has shape {self.stamps.shape} and positions {self.positions.shape}, but "
                f"{len(self.names)} joints need (n,) and (n, {len(self.names)})"
            )
        if len(set(self.names)) != len(self.names):
            raise ValueError("a joint is named twice")

    def __len__(self) -> int:
        return len(self.stamps)


@dataclass(frozen=True, slots=True, eq=False)
class JointColumns:
    """Poses of one joint's child in its parent, for many joint states.

    Attributes:
        joint: The joint.
        translations: Metres, shape (n, 3).
        rotations: Unit quaternions x y z w, shape (n, 4).
    """

    joint: RobotJoint
    translations: Floats
    rotations: Floats


def position_columns(names: Sequence[str], positions: npt.ArrayLike) -> Floats:
    """Return joint positions as an array, one column per joint.

    Raises:
        ValueError: If the shape is not (n, len(names)).
    """
    columns = np.asarray(positions, dtype=np.float64)
    if columns.ndim != 2 or columns.shape[1] != len(names):
        raise ValueError(
            f"{len(names)} joints need positions of shape (n, {len(names)}), not {columns.shape}"
        )
    return columns


def joint_columns(moved: Iterable[tuple[RobotJoint, Floats]]) -> tuple[JointColumns, ...]:
    """Return the poses of each joint's child in its parent, from pairs of joint and positions."""
    return tuple(
        JointColumns(joint, poses[:, :3], poses[:, 3:])
        for joint, values in moved
        for poses in (_write_poses(joint, values, np.empty((len(values), 7))),)
    )


def joint_records(
    stamps: Stamps, moved: Iterable[tuple[RobotJoint, Floats]]
) -> Iterator[tuple[RobotJoint, Records]]:
    """Yield joints with the poses of their children, in the memory layout of a buffer.

    A position that is not finite gives no sample.

    Args:
        stamps: Nanoseconds, shape (n,).
        moved: Joints, each with its positions at the stamps, shape (n,).
    """
    for joint, values in moved:
        known = np.isfinite(values)
        records = np.empty((int(known.sum()), 8), dtype=np.int64)
        records[:, 0] = stamps[known]
        _write_poses(joint, values[known], records.view(np.float64)[:, 1:])
        yield joint, records


def _write_poses(joint: RobotJoint, positions: Floats, poses: Floats) -> Floats:
    """Write the poses of a joint's child into `poses`, shape (n, 7), and return `poses`."""
    poses[:, :3] = joint.origin.translation
    turn = np.array(joint.origin.rotation)
    if joint.type == "prismatic":
        along = batch.rotate(turn[np.newaxis], np.array([joint.axis]))[0]
        for place in range(3):
            poses[:, place] += positions * along[place]
        poses[:, 3:] = turn
        return poses
    # turn · (axis · sin, cos) is a sum of two products that are the same for all positions.
    quarter = batch.multiply(turn, np.array([*joint.axis, 0.0]))
    half = 0.5 * positions
    sine, cosine = np.sin(half), np.cos(half)
    for place in range(4):
        np.multiply(sine, quarter[place], out=poses[:, 3 + place])
        poses[:, 3 + place] += cosine * turn[place]
    return poses
