"""A robot from its description: joint positions to frames, as robot_state_publisher gives them."""

import difflib
import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.errors import UsageError
from tftool.frames.buffer import NO_LIMIT, Buffer
from tftool.frames.sample import TransformStamped
from tftool.geometry import batch
from tftool.geometry.conversions import quaternion_from_axis_angle
from tftool.geometry.rigid import Transform
from tftool.sources.urdf import RobotDescription, RobotJoint, RobotLink, load_description
from tftool.stamps import Stamp

Floats: TypeAlias = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class JointColumns:
    """The poses of one joint's child in its parent, many at once.

    Attributes:
        joint: The joint.
        translations: Metres, shape (n, 3).
        rotations: Unit quaternions x y z w, shape (n, 4).
    """

    joint: RobotJoint
    translations: Floats
    rotations: Floats


class Robot:
    """A robot description that answers where its links are.

    A joint that was given no position is at zero where its limits allow that, else in the
    middle of them, as joint_state_publisher has it. A joint that mimics another follows
    it, however long the chain, unless a position of its own is given. A planar joint
    stays at its origin; a floating joint gives no frame, as robot_state_publisher skips it.
    """

    def __init__(self, description: RobotDescription) -> None:
        self.description = description

    @property
    def name(self) -> str:
        """The robot's name."""
        return self.description.name

    @property
    def root(self) -> str:
        """The link that is no joint's child."""
        return self.description.root

    @property
    def links(self) -> Mapping[str, RobotLink]:
        """Every link by its name."""
        return self.description.links

    @property
    def joints(self) -> Mapping[str, RobotJoint]:
        """Every joint by its name."""
        return self.description.joints

    @property
    def notes(self) -> tuple[str, ...]:
        """What is odd about the description, as sentences."""
        return self.description.notes

    def positions(self, given: Mapping[str, float] | None = None) -> dict[str, float]:
        """The position of every joint that moves, in radians or metres.

        Args:
            given: Positions by joint; they are taken as they are, beyond limits too.

        Raises:
            UsageError: If a joint is unknown or does not move, or a position is not finite.
        """
        given = given or {}
        for name, position in given.items():
            self._check_joint(name)
            if not math.isfinite(position):
                raise UsageError(f"the position of joint '{name}' is {position}; give a number")
        positions: dict[str, float] = {}
        for name, joint in self.joints.items():
            if joint.moves:
                leader, factor, offset = self._leader(joint, frozenset(given))
                known = given[leader.name] if leader.name in given else _rest(leader)
                positions[name] = factor * known + offset
        return positions

    def transforms(
        self, given: Mapping[str, float] | None = None, stamp: Stamp = 0
    ) -> tuple[TransformStamped, ...]:
        """The pose of every link in its parent, in the order of the description's joints.

        Args:
            given: Positions by joint, see `positions`.
            stamp: What to stamp them with, nanoseconds.

        Raises:
            UsageError: See `positions`.
        """
        positions = self.positions(given)
        return tuple(
            TransformStamped(
                stamp, joint.parent, joint.child, _pose(joint, positions.get(name, 0.0))
            )
            for name, joint in self.joints.items()
            if joint.type != "floating"
        )

    def batch(self, names: Sequence[str], positions: npt.ArrayLike) -> tuple[JointColumns, ...]:
        """The poses of the joints that moved, for many joint states at once.

        Joints that follow a given one by `mimic` are included; others are not, as in
        robot_state_publisher.

        Args:
            names: The joints, in the order of the columns.
            positions: Radians or metres, shape (n, len(names)).

        Raises:
            UsageError: If a joint is unknown or does not move.
            ValueError: If the shape does not fit.
        """
        columns = np.asarray(positions, dtype=np.float64)
        if columns.ndim != 2 or columns.shape[1] != len(names):
            raise ValueError(
                f"positions has shape {columns.shape}; {len(names)} joints need (n, {len(names)})"
            )
        for name in names:
            self._check_joint(name)
        given = {name: columns[:, place] for place, name in enumerate(names)}
        moved = []
        for joint in self.joints.values():
            if joint.moves:
                leader, factor, offset = self._leader(joint, frozenset(given))
                if leader.name in given:
                    moved.append(_poses(joint, factor * given[leader.name] + offset))
        return tuple(moved)

    def buffer(self, given: Mapping[str, float] | None = None) -> Buffer:
        """A buffer in which every frame holds at all times, at one set of positions.

        Raises:
            UsageError: See `positions`.
        """
        buffer = Buffer(NO_LIMIT)
        positions = self.positions(given)
        for joint in self.joints.values():
            if joint.type != "floating":
                position = positions.get(joint.name, 0.0)
                pose = TransformStamped(0, joint.parent, joint.child, _pose(joint, position))
                buffer.set_transform_static(pose, joint_in_words(joint, position))
        return buffer

    def leader(self, name: str, given: Collection[str] = ()) -> str:
        """The joint whose position decides a joint's: its own name, unless it mimics another.

        Args:
            name: The joint.
            given: Joints that have a position of their own, which wins.
        """
        return self._leader(self.joints[name], frozenset(given))[0].name

    def _check_joint(self, name: str) -> None:
        joint = self.joints.get(name)
        if joint is None:
            near = difflib.get_close_matches(name[:100], list(self.joints), n=1)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            raise UsageError(f"robot '{self.name}' has no joint '{name[:100]}'{hint}")
        if not joint.moves:
            raise UsageError(f"joint '{name}' is {joint.type}: it takes no position")

    def _leader(self, joint: RobotJoint, given: frozenset[str]) -> tuple[RobotJoint, float, float]:
        """The joint whose position decides, and the factor and offset that lead to this one's."""
        factor, offset = 1.0, 0.0
        leader, seen = joint, {joint.name}
        while leader.name not in given and leader.mimic is not None:
            after = self.joints.get(leader.mimic.joint)
            if after is None or not after.moves:
                break  # a mimic of nothing is a joint of its own
            if after.name in seen:
                return joint, 1.0, 0.0  # so is one that mimics itself
            offset += factor * leader.mimic.offset
            factor *= leader.mimic.multiplier
            seen.add(after.name)
            leader = after
        return leader, factor, offset


def load_urdf(path: str | Path, arguments: Mapping[str, str] | None = None) -> Robot:
    """Read a robot description: URDF, or xacro with the extra of that name.

    Args:
        path: The file.
        arguments: Values of xacro arguments. A xacro file can evaluate Python expressions:
            do not expand files from strangers.

    Raises:
        InputError: If it cannot be read.
        DescriptionError: If it has mistakes; all of them, with line and column.
        UsageError: If it contains xacro and the extra `xacro` is not installed.
    """
    return Robot(load_description(path, arguments))


def joint_in_words(joint: RobotJoint, position: float) -> str:
    """A joint and where it is: "elbow (revolute, 0.5 rad)"."""
    if not joint.moves:
        return f"{joint.name} ({joint.type})"
    return f"{joint.name} ({joint.type}, {position:.4g} {joint.unit})"


def _rest(joint: RobotJoint) -> float:
    limits = joint.limits
    if limits is None or limits[0] <= 0.0 <= limits[1]:
        return 0.0
    return (limits[0] + limits[1]) / 2.0


def _pose(joint: RobotJoint, position: float) -> Transform:
    """The child's pose in the parent."""
    if joint.type in ("revolute", "continuous"):
        return joint.origin @ Transform(rotation=quaternion_from_axis_angle(joint.axis, position))
    if joint.type == "prismatic":
        x, y, z = joint.axis
        return joint.origin @ Transform((x * position, y * position, z * position))
    return joint.origin


def _poses(joint: RobotJoint, positions: Floats) -> JointColumns:
    """The same for many positions, shape (n,)."""
    count = len(positions)
    axis = np.array(joint.axis)
    translations = np.broadcast_to(np.array(joint.origin.translation), (count, 3))
    rotations = np.broadcast_to(np.array(joint.origin.rotation), (count, 4))
    if joint.type == "prismatic":
        along = batch.rotate(rotations[:1], axis[np.newaxis])
        return JointColumns(
            joint, translations + positions[:, np.newaxis] * along, rotations.copy()
        )
    turns = np.empty((count, 4))
    turns[:, :3] = np.sin(0.5 * positions)[:, np.newaxis] * axis
    turns[:, 3] = np.cos(0.5 * positions)
    return JointColumns(joint, translations.copy(), batch.multiply(rotations, turns))
