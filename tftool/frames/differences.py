"""Differences of two sets of frames, A and B: frames added, removed, reattached or displaced."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import SIMULATED_BELOW, Duration, Stamp
from tftool.buffer.batch.transform_array import SampleColumns
from tftool.buffer.buffer import Buffer
from tftool.frames.frames import Frames
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.geometry.rigid import Transform
from tftool.recordings.contract import usual_rate
from tftool.recordings.find import Kind, find
from tftool.recordings.recording import Recording, open_recording
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot, load_urdf
from tftool.robots.static_publishers import StaticFrames, load_statics

Stamps: TypeAlias = npt.NDArray[np.int64]

MOST_MOMENTS: Final = 2_000_000
"""Maximum number of times at which a link is compared; of more times, every n-th is used."""


class Behaviour(StrEnum):
    """Kind of a frame: static, moving, or depending on a joint of a robot description."""

    static = "static"
    moving = "moving"
    joint = "joint"
    """Joint of a robot description, whose position is unknown."""


class Change(StrEnum):
    """Kind of change of a frame from the first set of frames to the second."""

    added = "added"
    gone = "gone"
    reparented = "re-parented"
    kind = "kind"
    """Static in one set, moving in the other."""

    pose = "pose"
    """Pose differs by more than the tolerance."""

    joint = "other joint"
    """Type, axis or mimic rule of the joint differs between two descriptions."""

    rate = "rate"
    unknown = "not compared"
    """Moves, and the poses of the two sets cannot be compared at any time."""

    same = "same"


@dataclass(frozen=True, slots=True)
class Allowance:
    """Tolerance of a comparison: the largest differences that are ignored.

    Attributes:
        millimetres: Tolerance of positions.
        degrees: Tolerance of rotations.
        rate_percent: Tolerance of rates; None to ignore rates.
    """

    millimetres: float = 1.0
    degrees: float = 0.1
    rate_percent: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Side:
    """One of the two sets of frames in a comparison.

    Attributes:
        name: Name of the set in messages.
        buffer: The frames.
        start: First stamp, nanoseconds.
        joints: Movable joints of a description, by the frame whose pose depends on the joint.
    """

    name: str
    buffer: Buffer
    start: Stamp = 0
    joints: Mapping[str, RobotJoint] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LinkState:
    """State of one frame in one of the two compared sets of frames.

    Attributes:
        parent: Parent in the last sample.
        kind: Static, moving, or depending on a joint.
        count: Number of samples.
        rate: Mean rate in hertz without gaps; None if static.
        pose: Pose of the child in the parent, if static, or at position zero of its joint; else
            None.
    """

    parent: str
    kind: Behaviour
    count: int
    rate: float | None
    pose: Transform | None


@dataclass(frozen=True, slots=True)
class Displacement:
    """Difference between the poses of a frame in the two compared sets of frames, A and B.

    Attributes:
        millimetres: Distance; for a moving frame, the root mean square of the distances.
        degrees: Angle of rotation; for a moving frame, the root mean square of the angles.
        worst_millimetres: Largest distance.
        worst_degrees: Largest angle.
        worst_at: Stamp in A of the largest difference relative to the tolerance; None if static.
        moments: Number of times at which the poses were compared.
        moved_mm: Displacement x y z along the parent axes in A; None if the frame moves in a set.
        turned_deg: Rotation from A to B as roll pitch yaw; None if the frame moves in a set.
    """

    millimetres: float
    degrees: float
    worst_millimetres: float
    worst_degrees: float
    worst_at: Stamp | None = None
    moments: int = 1
    moved_mm: tuple[float, float, float] | None = None
    turned_deg: tuple[float, float, float] | None = None


@dataclass(frozen=True, slots=True)
class LinkDifference:
    """Differences of one frame between two sets of frames, A and B.

    Attributes:
        child: Name of the frame.
        changes: The changes; only `Change.same` if both sets agree within the tolerance.
        before: State of the frame in A; None if the frame is not in A.
        after: State of the frame in B; None if the frame is not in B.
        displacement: Difference of the poses; None if unknown.
        note: Reason why the displacement is unknown; "" if it is known or no reason is needed.
    """

    child: str
    changes: tuple[Change, ...]
    before: LinkState | None
    after: LinkState | None
    displacement: Displacement | None = None
    note: str = ""

    @property
    def is_same(self) -> bool:
        """Whether all differences of the frame are within the tolerance."""
        return self.changes == (Change.same,)

    @property
    def parent(self) -> str:
        """Return the parent in A, or for a new frame the parent in B."""
        state = self.before or self.after
        return "" if state is None else state.parent


@dataclass(frozen=True, slots=True, eq=False)
class Differences:
    """Result of a comparison of two sets of frames, A and B.

    Attributes:
        first: Name of A.
        second: Name of B.
        tolerance: Tolerance of the comparison.
        links: All frames that have a parent: the frames of A in order, then the frames only in B.
        start: First stamp of A, from which printed times are counted, nanoseconds.
        shift: Nanoseconds to add to a stamp of A to get the stamp of the same moment in B.
        notes: Sentences about assumptions of the comparison.
    """

    first: str
    second: str
    tolerance: Allowance
    links: tuple[LinkDifference, ...]
    start: Stamp = 0
    shift: Duration = 0
    notes: tuple[str, ...] = ()

    @property
    def changed(self) -> tuple[LinkDifference, ...]:
        """Return the frames that differ by more than the tolerance, or could not be compared."""
        return tuple(one for one in self.links if not one.is_same)

    def __bool__(self) -> bool:
        """Whether any frame differs by more than the tolerance, or could not be compared."""
        return bool(self.changed)


def compare(
    first: Side,
    second: Side,
    tolerance: Allowance | None = None,
    *,
    align_starts: bool = False,
) -> Differences:
    """Compare two sets of frames, frame by frame.

    Static poses are compared directly, and movable joints of two descriptions by their origins and
    axes. Frames that move in both sets are compared at common stamps.
    Without common stamps, the second set is interpolated at the stamps of the first set. If one set
    has stamps since 1970 and the other has simulation times, times count from each set's start.

    Args:
        first: The first set of frames, called A in the result.
        second: The second set of frames, called B in the result.
        tolerance: Tolerated difference; None for the default.
        align_starts: Whether times always count from each set's start.

    Raises:
        InputError: If a set has no frames.
    """
    tolerance = tolerance or Allowance()
    for side in (first, second):
        if not side.buffer.frames():
            raise InputError(f"{side.name} has no frames to compare: choose another source.")
    held = [_held(side) for side in (first, second)]
    notes = []
    shift = 0
    both_move = all(any(not one.is_static for one in side.values()) for side in held)
    if align_starts:
        shift = second.start - first.start
    elif both_move and (first.start < SIMULATED_BELOW) != (second.start < SIMULATED_BELOW):
        shift = second.start - first.start
        notes.append(
            "A and B use different clocks: times are counted from the start of A and of B."
        )
    children = list(dict.fromkeys([*held[0], *held[1]]))
    # An overflowing distance becomes infinite, without a warning.
    with np.errstate(over="ignore", invalid="ignore"):
        links = [_compared(child, first, second, held, shift, tolerance) for child in children]
    if any(one.note == APART for one in links):
        notes.append("Moving links without a common time were not compared: try --align start.")
    return Differences(
        first.name, second.name, tolerance, tuple(links), first.start, shift, tuple(notes)
    )


APART: Final = "no time in common"

Held = dict[str, SampleColumns]


def _held(side: Side) -> Held:
    columns = {frame: side.buffer.samples(frame) for frame in side.buffer.frames()}
    return {frame: one for frame, one in columns.items() if len(one)}


def _compared(
    child: str,
    first: Side,
    second: Side,
    held: list[Held],
    shift: Duration,
    tolerance: Allowance,
) -> LinkDifference:
    before, after = (
        _state(side, found[child]) if child in found else None
        for side, found in zip((first, second), held, strict=True)
    )
    if before is None or after is None:
        change = Change.added if before is None else Change.gone
        return LinkDifference(child, (change,), before, after)
    changes = []
    offset, note = None, ""
    old_joint, new_joint = first.joints.get(child), second.joints.get(child)
    if before.parent != after.parent:
        changes.append(Change.reparented)
    if Behaviour.static in (before.kind, after.kind) and before.kind is not after.kind:
        changes.append(Change.kind)
    if old_joint is not None and new_joint is not None:
        note = _joint_changes(old_joint, new_joint, tolerance)
        if note:
            changes.append(Change.joint)
        if before.parent == after.parent:
            offset = _static_offset(second.buffer, child, before, after)
    elif before.kind is Behaviour.static and after.kind is Behaviour.static:
        offset = _static_offset(second.buffer, child, before, after)
    elif Behaviour.joint in (before.kind, after.kind):
        note = "the pose depends on a joint position, which is unknown"
    else:
        offset, note = _moving_offset(child, first, second, held, shift, before.parent, tolerance)
        if offset is None and not changes:
            changes.append(Change.unknown)
    if offset is not None and (
        # Written with `not`, so that NaN is a difference.
        not offset.worst_millimetres <= tolerance.millimetres
        or not offset.worst_degrees <= tolerance.degrees
    ):
        changes.append(Change.pose)
    if (
        tolerance.rate_percent is not None
        and before.rate
        and after.rate
        and abs(after.rate / before.rate - 1.0) * 100.0 > tolerance.rate_percent
    ):
        changes.append(Change.rate)
    return LinkDifference(child, tuple(changes) or (Change.same,), before, after, offset, note)


def _state(side: Side, held: SampleColumns) -> LinkState:
    parent = str(held.parents[-1])
    if held.is_static:
        joint = side.joints.get(held.frame)
        if joint is not None:
            return LinkState(parent, Behaviour.joint, len(held), None, joint.origin)
        row = held.poses[-1].tolist()
        return LinkState(parent, Behaviour.static, len(held), None, Transform(row[:3], row[3:]))
    return LinkState(parent, Behaviour.moving, len(held), usual_rate(held.stamps), None)


def _joint_changes(old: RobotJoint, new: RobotJoint, tolerance: Allowance) -> str:
    """Return what differs between two joints besides their origins; "" if nothing does."""
    words = []
    if old.type != new.type:
        words.append(f"{old.type} → {new.type}")
    cross, dot = np.linalg.norm(np.cross(old.axis, new.axis)), np.dot(old.axis, new.axis)
    degrees = float(np.degrees(np.arctan2(cross, dot)))
    if degrees > tolerance.degrees:
        words.append(f"the axis is turned by {degrees:.4g}°")
    if old.mimic != new.mimic:
        words.append(f"{_mimic(old)} → {_mimic(new)}")
    return "; ".join(words)


def _mimic(joint: RobotJoint) -> str:
    rule = joint.mimic
    if rule is None:
        return "independent"
    return f"{rule.multiplier:g} times {rule.joint} {rule.offset:+g}"


def _static_offset(
    second: Buffer, child: str, before: LinkState, after: LinkState
) -> Displacement | None:
    """Return the displacement of a static frame from the first to the second set of frames.

    The displacement is expressed in the parent that the frame has in the first set. Return None if
    the second set, `second`, does not connect this parent with the frame.
    """
    old, new = before.pose, after.pose
    assert old is not None
    if before.parent != after.parent:
        if not second.can_transform(before.parent, child):
            return None
        new = second.lookup_transform(before.parent, child).transform
    assert new is not None
    moved = [1000.0 * (b - a) for a, b in zip(old.translation, new.translation, strict=True)]
    turn = (old.inverse() @ new).rotation
    distance = float(np.linalg.norm(moved))
    degrees = float(
        np.degrees(batch.angles_between(np.array(old.rotation), np.array(new.rotation)))
    )
    roll, pitch, yaw = np.degrees(rpy_from_quaternion(turn)).tolist()
    return Displacement(
        distance,
        degrees,
        distance,
        degrees,
        moved_mm=(moved[0], moved[1], moved[2]),
        turned_deg=(roll, pitch, yaw),
    )


def _moving_offset(
    child: str,
    first: Side,
    second: Side,
    samples: list[Held],
    shift: Duration,
    parent: str,
    tolerance: Allowance,
) -> tuple[Displacement | None, str]:
    """Return the displacement of a moving frame from the first to the second set.

    Args:
        child: The moving frame.
        first: The first set of frames.
        second: The second set of frames.
        samples: Samples of each frame in the first and in the second set, by frame name.
        shift: Nanoseconds to add to a stamp of the first set to get a stamp of the second.
        parent: Frame in which the displacement is expressed.
        tolerance: Tolerance; the largest difference is the largest in units of the tolerance.

    Returns:
        The displacement in the frame `parent`, and an empty text; or None, and the reason why the
        displacement is unknown.
    """
    stamps = _common(samples[0][child], samples[1][child], shift)
    if not len(stamps):
        return None, APART
    stamps = stamps[:: -(-len(stamps) // MOST_MOMENTS)]
    if not (first.buffer.frame_exists(parent) and second.buffer.frame_exists(parent)):
        return None, f"B has no frame '{parent}'"
    old = first.buffer.lookup_transforms(parent, child, stamps, missing="nan")
    new = second.buffer.lookup_transforms(parent, child, stamps + shift, missing="nan")
    both = old.valid & new.valid
    if not both.any():
        return None, f"A and B never connect the frame with '{parent}' at the same time"
    old, new, stamps = old[both], new[both], stamps[both]
    millimetres = 1000.0 * np.linalg.norm(new.translations - old.translations, axis=1)
    degrees = np.degrees(batch.angles_between(old.rotations, new.rotations))
    # In units of the tolerances, so that distance and angle are comparable.
    badness = np.maximum(
        millimetres / max(tolerance.millimetres, 1e-9), degrees / max(tolerance.degrees, 1e-9)
    )
    worst = int(np.argmax(badness))
    return (
        Displacement(
            _root_mean_square(millimetres),
            _root_mean_square(degrees),
            float(millimetres.max()),
            float(degrees.max()),
            int(stamps[worst]),
            len(stamps),
        ),
        "",
    )


def _common(old: SampleColumns, new: SampleColumns, shift: Duration) -> Stamps:
    """Return the times at which two frames are compared, on the clock of `old`.

    These are the common stamps, or else the stamps of `old` at which `new` has data.

    Args:
        old: Samples of the frame in the first set.
        new: Samples of the frame in the second set.
        shift: Nanoseconds to add to a stamp of `old` to get the stamp of that moment in `new`.
    """
    if old.is_static or new.is_static:
        return np.unique(new.stamps - shift if old.is_static else old.stamps)
    shared: Stamps = np.intersect1d(old.stamps, new.stamps - shift)
    if len(shared) > 1:
        return shared
    low, high = int(new.stamps[0]) - shift, int(new.stamps[-1]) - shift
    own = np.unique(old.stamps)
    return own[(own >= low) & (own <= high)]


def _root_mean_square(values: batch.Floats) -> float:
    return float(np.sqrt(np.mean(values * values)))


Comparable = Frames | Recording | Robot | Buffer | StaticFrames | str | os.PathLike[str]
"""Source of frames to compare; a path must name a recording, a description or a launch file."""


def diff(
    a: Comparable,
    b: Comparable,
    *,
    mm: float = 1.0,
    deg: float = 0.1,
    rate_percent: float | None = None,
    align_starts: bool = False,
) -> Differences:
    """Compare two sets of frames, frame by frame; see `differences.compare`::

        for one in tftool.diff("monday.mcap", "robot.urdf").changed:
            print(one.child, *one.changes)

    Args:
        a: The first set: frames, or the path of a file with frames.
        b: The second set: frames, or the path of a file with frames.
        mm: Tolerated displacement of a frame, millimetres.
        deg: Tolerated rotation of a frame, degrees.
        rate_percent: Tolerated difference of rates, percent; None to ignore rates.
        align_starts: Whether times always count from each set's start.

    Returns:
        All frames with their changes. The truth value of the result is False if nothing changed
        and every moving frame could be compared.

    Raises:
        InputError: If a path cannot be read, or a set has no frames.
        UsageError: If a path names a scenario, which must be played first.
    """
    allowance = Allowance(mm, deg, rate_percent)
    return compare(side_of(a, "A"), side_of(b, "B"), allowance, align_starts=align_starts)


def side_of(frames: Comparable, name: str) -> Side:
    """Return frames as one of the two sets of a comparison.

    Args:
        frames: Source of the frames.
        name: Name of the set if the source has no name: "A" or "B".

    Raises:
        InputError: If a path cannot be read.
        UsageError: If a path names a scenario.
    """
    if isinstance(frames, str | os.PathLike):
        return _opened(os.fspath(frames))
    if isinstance(frames, Frames):
        joints = joints_of(frames.robot) if frames.moving and frames.robot else {}
        return Side(frames.label, frames.buffer, frames.span[0], joints)
    if isinstance(frames, Buffer):
        stamps = [int(one.stamps[0]) for one in map(frames.samples, frames.frames()) if len(one)]
        return Side(name, frames, min((one for one in stamps if one), default=0))
    if isinstance(frames, Robot):
        return Side(frames.name, frames.buffer(), 0, joints_of(frames))
    return Side(frames.name, frames.buffer, frames.start)


def joints_of(robot: Robot) -> dict[str, RobotJoint]:
    """Return a robot's movable joints, by the link whose pose depends on the joint."""
    return {one.child: one for one in robot.joints.values() if one.moves}


def _opened(path: str) -> Side:
    found = find(path)
    if found.kind is Kind.SCENARIO:
        raise UsageError(
            f"'{path}' is a scenario, which must be played first: use 'tftool diff', or give "
            "the buffer of a world."
        )
    if found.kind is Kind.STATICS:
        return side_of(load_statics(found.paths[0], path), path)
    if found.kind is Kind.DESCRIPTION:
        return side_of(load_urdf(found.paths[0]), path)
    with open_recording(path) as recording:
        return side_of(recording, path)
