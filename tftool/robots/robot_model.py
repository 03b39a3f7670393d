"""Poses of a robot's links from joint positions, computed as in robot_state_publisher."""

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.plain_text import did_you_mean, visible
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_axis_angle
from tftool.geometry.rigid import Transform
from tftool.robots.description import JointPosition, RobotDescription, RobotJoint, RobotLink
from tftool.robots.urdf import load_description, parse_description

if TYPE_CHECKING:
    # Numpy, which one pose does not need, takes longer to import than all of this.
    import numpy.typing as npt

    from tftool.robots.joint_motion import Floats, JointColumns, JointStates, Records

MOST_NAMED = 12
"""Maximum number of joints that an error message lists."""


class Robot:
    """A robot description that computes the poses of its links.

    A joint without a given position is at zero if its limits allow zero, else in the middle of its
    limits, as in joint_state_publisher. A mimic joint without a given position follows the joint
    that it mimics. A planar joint stays at its origin. The child of a floating joint gets no pose,
    as in robot_state_publisher.
    """

    def __init__(self, description: RobotDescription) -> None:
        self.description = description
        self._above = {joint.child: joint for joint in description.joints.values()}

    def __repr__(self) -> str:
        return f"<Robot {self.name!r}: {len(self.links)} links, {len(self.joints)} joints>"

    @property
    def name(self) -> str:
        """The robot's name."""
        return self.description.name

    @property
    def root(self) -> str:
        """The name of the root link, which is not a joint's child."""
        return self.description.root

    @property
    def links(self) -> Mapping[str, RobotLink]:
        """All links of the robot, by name."""
        return self.description.links

    @property
    def joints(self) -> Mapping[str, RobotJoint]:
        """All joints of the robot, by name."""
        return self.description.joints

    @property
    def notes(self) -> tuple[str, ...]:
        """Return sentences about faults in the description that do not prevent reading."""
        return self.description.notes

    def positions(self, given: Mapping[str, float] | None = None) -> dict[str, float]:
        """Return the position of every movable joint, radians or metres, by the joint's name.

        Args:
            given: Positions by joint's name; limits are not enforced.

        Raises:
            UsageError: If a joint is unknown or does not move, or a position is not finite or has
                another unit than the joint.
        """
        given = given or {}
        for name, position in given.items():
            self._check_joint(name)
            if not math.isfinite(position):
                raise UsageError(
                    f"the position of joint '{name}' is {position}: give a finite number"
                )
            unit = self.joints[name].unit
            if isinstance(position, JointPosition) and position.unit != unit:
                wanted, given_as = (
                    ("a length in metres", "an angle")
                    if unit == "m"
                    else ("an angle in radians or degrees", "a length")
                )
                raise UsageError(
                    f"joint '{name}' is {self.joints[name].type}, so its position is {wanted}, "
                    f"not {given_as}"
                )
        positions: dict[str, float] = {}
        for name, joint in self.joints.items():
            if joint.moves:
                leader, factor, offset = self._leader(joint, frozenset(given))
                known = given[leader.name] if leader.name in given else _rest(leader)
                positions[name] = factor * known + offset
        return positions

    def beyond_limits(self, given: Mapping[str, float]) -> Iterator[str]:
        """Yield a sentence about each given position beyond the limits of the joint.

        Args:
            given: Positions of joints, radians or metres, by joint name.
        """
        for name, position in given.items():
            joint = self.joints.get(name)
            if joint is None or joint.limits is None:
                continue
            lower, upper = joint.limits
            if not lower <= position <= upper:
                yield (
                    f"Joint '{visible(name)}' at {position:.4g} {joint.unit} is beyond its limits, "
                    f"{lower:.4g} to {upper:.4g}."
                )

    def transforms(
        self, given: Mapping[str, float] | None = None, stamp: Stamp = 0
    ) -> tuple[TransformStamped, ...]:
        """Return each link's pose in its parent link, in the order of the description's joints.

        Args:
            given: Positions by joint; see `positions`.
            stamp: Stamp, nanoseconds.

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

    def joint_above(self, link: str) -> RobotJoint:
        """Return the joint whose child is the given link.

        Raises:
            KeyError: If the link is the root, or unknown.
        """
        return self._above[link]

    def takes(self, name: str) -> bool:
        """Whether the robot has a movable joint with this name."""
        joint = self.joints.get(name)
        return joint is not None and joint.moves

    def moved(self, given: Mapping[str, float], stamp: Stamp = 0) -> tuple[TransformStamped, ...]:
        """Return the poses of the links that a joint state moves, each pose in the link's parent.

        As in robot_state_publisher, unknown names, fixed joints and positions that are not finite
        are ignored. A mimic joint without a position in `given` follows the joint that it mimics.

        Args:
            given: Positions by joint.
            stamp: Stamp, nanoseconds.
        """
        known = {
            name: position
            for name, position in given.items()
            if self.takes(name) and math.isfinite(position)
        }
        chosen = frozenset(known)
        poses = []
        for joint in self.joints.values():
            if joint.moves:
                leader, factor, offset = self._leader(joint, chosen)
                if leader.name in known:
                    pose = _pose(joint, factor * known[leader.name] + offset)
                    poses.append(TransformStamped(stamp, joint.parent, joint.child, pose))
        return tuple(poses)

    def batch(self, names: Sequence[str], positions: "npt.ArrayLike") -> "tuple[JointColumns, ...]":
        """Return the poses of the children of moved joints, for many joint states.

        As in robot_state_publisher, joints that mimic one of the joints `names` are included.

        Args:
            names: Names of the joints, in the order of the columns.
            positions: Radians or metres, shape (n, len(names)).

        Raises:
            UsageError: If a joint is unknown or does not move.
            ValueError: If the shape does not fit.
        """
        from tftool.robots.joint_motion import joint_columns, position_columns

        columns = position_columns(names, positions)
        for name in names:
            self._check_joint(name)
        return joint_columns(self._moved(names, columns))

    def motion(
        self, states: "JointStates", wanted: Callable[[RobotJoint], bool] | None = None
    ) -> "Iterator[tuple[RobotJoint, Records]]":
        """Yield the poses of moved joints' children over time, in the memory layout of a buffer.

        As in robot_state_publisher, unknown names and fixed joints are ignored, and a mimic joint
        without positions follows the joint that it mimics. A position that is not finite gives no
        sample.

        Args:
            states: Positions over time.
            wanted: Function that chooses the joints; None for all.

        Returns:
            For each joint its samples, one per row, shape (n, 8), as for `Buffer.set_records`.
        """
        from tftool.robots.joint_motion import joint_records

        places = [
            place
            for place, name in enumerate(states.names)
            if name in self.joints and self.joints[name].moves
        ]
        moved = self._moved([states.names[place] for place in places], states.positions[:, places])
        return joint_records(
            states.stamps, (one for one in moved if wanted is None or wanted(one[0]))
        )

    def _moved(
        self, names: Sequence[str], columns: "Floats"
    ) -> "Iterator[tuple[RobotJoint, Floats]]":
        """Yield the joints in `names` and the joints that mimic these, each with its positions."""
        given = {name: columns[:, place] for place, name in enumerate(names)}
        chosen = frozenset(given)
        for joint in self.joints.values():
            if joint.moves:
                leader, factor, offset = self._leader(joint, chosen)
                if leader is joint and joint.name in given:
                    yield joint, given[joint.name]
                elif leader.name in given:
                    yield joint, factor * given[leader.name] + offset

    def buffer(
        self, given: "Mapping[str, float] | JointStates | Iterable[JointStates] | None" = None
    ) -> Buffer:
        """Return a buffer with the frames of all links.

        Args:
            given: Positions by joint (see `positions`), or None for default positions: all poses
                are static. With joint states, moved links have samples at the stamps of the
                states, and links of other movable joints have no samples.

        Raises:
            UsageError: See `positions`.
        """
        buffer = Buffer(NO_LIMIT)
        if given is None or isinstance(given, Mapping):
            positions = self.positions(given)
            for joint in self.joints.values():
                if joint.type != "floating":
                    set_still(buffer, joint, positions.get(joint.name, 0.0))
            return buffer
        for joint in self.joints.values():
            if not joint.moves and joint.type != "floating":
                set_still(buffer, joint)
        for states in given if isinstance(given, Iterable) else [given]:
            for joint, records in self.motion(states):
                buffer.set_records(joint.parent, joint.child, records, joint.name)
        return buffer

    def leader(self, name: str, given: Collection[str] = ()) -> str:
        """Return the joint that a chain of mimic joints leads to; `name` itself if it mimics none.

        Args:
            name: The joint at which the chain begins.
            given: Joints with a given position, which therefore do not mimic another joint.
        """
        return self._leader(self.joints[name], frozenset(given))[0].name

    def drive(self, name: str) -> tuple[str, float, float]:
        """Return the joint that a chain of mimic joints leads to, with a factor and an offset.

        Args:
            name: The joint at which the chain begins.

        Returns:
            Name of the mimicked joint (`name` itself if none), factor and offset: the position of
            `name` is the position of that joint times the factor, plus the offset.
        """
        leader, factor, offset = self._leader(self.joints[name], frozenset())
        return leader.name, factor, offset

    def _check_joint(self, name: str) -> None:
        joint = self.joints.get(name)
        if joint is None:
            moving = [one.name for one in self.joints.values() if one.moves]
            hint = did_you_mean(name, self.joints)
            if moving and not hint:
                more = ", ..." if len(moving) > MOST_NAMED else ""
                hint = f"; the movable joints are {', '.join(moving[:MOST_NAMED])}{more}"
            raise UsageError(f"robot '{self.name}' has no joint '{name[:100]}'{hint}")
        if not joint.moves:
            raise UsageError(f"joint '{name}' is {joint.type}, so it has no position")

    def _leader(self, joint: RobotJoint, given: frozenset[str]) -> tuple[RobotJoint, float, float]:
        """Return the joint that `joint` mimics, also through other joints; see `drive`."""
        factor, offset = 1.0, 0.0
        leader, seen = joint, {joint.name}
        while leader.name not in given and leader.mimic is not None:
            after = self.joints.get(leader.mimic.joint)
            if after is None or not after.moves:
                break  # the joint to mimic does not exist, so this joint has its own position
            if after.name in seen:
                return joint, 1.0, 0.0  # mimic joints in a loop have their own positions
            offset += factor * leader.mimic.offset
            factor *= leader.mimic.multiplier
            seen.add(after.name)
            leader = after
        return leader, factor, offset


def parse_robot(text: str, name: str = "robot_description") -> Robot:
    """Return the robot that the text of a URDF describes; `name` is for messages.

    Raises:
        DescriptionError: If the description has mistakes.
        UnexpandedXacro: If the text has elements of xacro.
    """
    return Robot(parse_description(text, name))


def load_urdf(path: str | Path, arguments: Mapping[str, str] | None = None) -> Robot:
    """Read a robot description: URDF, or xacro if the extra `xacro` is installed.

    Args:
        path: The file.
        arguments: Values of xacro arguments. A xacro file can evaluate Python expressions:
            do not expand files from strangers.

    Raises:
        InputError: If the file cannot be read, or contains xacro and is not named .xacro.
        DescriptionError: If the description has mistakes; the error lists all mistakes with line
            and column.
        UsageError: If the file contains xacro and the extra `xacro` is not installed, or if
            arguments are given to a file without xacro.
    """
    return Robot(load_description(path, arguments))


def set_still(buffer: Buffer, joint: RobotJoint, position: float = 0.0, prefix: str = "") -> None:
    """Insert the pose of a joint's child in its parent into a buffer, as a static transform.

    Args:
        buffer: The buffer.
        joint: The joint; its text (see `joint_in_words`) is the sender of the transform.
        position: Position of the joint, radians or metres.
        prefix: Prefix of both frame names.
    """
    parent, child = prefix + joint.parent, prefix + joint.child
    pose = TransformStamped(0, parent, child, _pose(joint, position))
    buffer.set_transform_static(pose, joint_in_words(joint, position))


def joint_in_words(joint: RobotJoint, position: float) -> str:
    """Return a joint with its type and position as text: "elbow (revolute, 0.5 rad)"."""
    if not joint.moves:
        return f"{joint.name} ({joint.type})"
    return f"{joint.name} ({joint.type}, {position:.4g} {joint.unit})"


def _rest(joint: RobotJoint) -> float:
    limits = joint.limits
    if limits is None or limits[0] <= 0.0 <= limits[1]:
        return 0.0
    return (limits[0] + limits[1]) / 2.0


def _pose(joint: RobotJoint, position: float) -> Transform:
    """Return the pose of a joint's child link in its parent link, at a position of the joint."""
    if joint.type in ("revolute", "continuous"):
        return joint.origin @ Transform(rotation=quaternion_from_axis_angle(joint.axis, position))
    if joint.type == "prismatic":
        x, y, z = joint.axis
        return joint.origin @ Transform((x * position, y * position, z * position))
    return joint.origin
