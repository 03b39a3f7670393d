"""Mounts of sensors, measured from the motion in a whole recording and in windows."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.calibration.body_motion import Floats, difference, poses_of
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.geometry.rigid_arrays import unit
from tftool.recordings.contract import Edge

if TYPE_CHECKING:
    from tftool.doctor.model import Model
    from tftool.frames.calibration.calibrate import Calibration

_LEAST: Final = 100
"""Minimum number of poses of a chain whose motion is compared."""

_WINDOW: Final = 20.0
_MOST_WINDOWS: Final = 6
"""Maximum number of parts of a recording that are measured separately."""


@dataclass(frozen=True, slots=True, eq=False)
class MountWindow:
    """A mount measured over one window (part) of a recording.

    Attributes:
        begin: First stamp of the window.
        shift: Measured minus published mount, metres and degrees, shape (6,).
        widths: Half-widths of the shift's 95 % interval, shape (6,); NaN if undetermined.
    """

    begin: Stamp
    shift: Floats
    widths: Floats


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredMount:
    """A sensor's mount measured from motion, compared with the published mount.

    Attributes:
        parent: Frame on which the sensor is mounted.
        child: Frame of the sensor.
        name: Name of the recording.
        begin: First stamp of the measurement.
        mount: The measured mount (pose of `child` in `parent`).
        shift: Measured minus published mount, metres and degrees, shape (6,).
        widths: Half-widths of the shift's 95 % interval, shape (6,); NaN if undetermined.
        windows: Measurements in parts of the recording, in the order of time.
        earlier: The sensor's mount in the previous recording; None without a previous recording.
    """

    parent: str
    child: str
    name: str
    begin: Stamp
    mount: Transform
    shift: Floats
    widths: Floats
    windows: tuple[MountWindow, ...]
    earlier: "MeasuredMount | None" = None


def measured_mounts(
    model: "Model", before: Sequence[MeasuredMount] = ()
) -> tuple[MeasuredMount, ...]:
    """Measure the mounts of all sensors whose own motion was recorded, as by visual odometry.

    A mount is the constant pose of a sensor on the robot's body, computed from the recorded motions
    of the sensor and of the body.

    Args:
        model: The evidence of a recording.
        before: Mounts in earlier recordings, oldest first, for the attribute `earlier`.
    """
    found = []
    for first, second, published in _pairs(model):
        one = _measured(first, second, published, model.evidence.name)
        if one is not None:
            same = [old for old in before if (old.parent, old.child) == (one.parent, one.child)]
            found.append(replace(one, earlier=same[-1] if same else None))
    return tuple(found)


def _measured(
    first: TransformArray, second: TransformArray, published: Transform, name: str
) -> MeasuredMount | None:
    whole = _calibrated(first, second, published)
    if whole is None or whole.mount is None:
        return None
    late = round((whole.clock_offset or 0.0) * NANOSECONDS)
    begin = max(int(first.stamps[0]), int(second.stamps[0]) + late)
    end = min(int(first.stamps[-1]), int(second.stamps[-1]) + late)
    count = min(int((end - begin) / (_WINDOW * NANOSECONDS)), _MOST_WINDOWS)
    edges = np.linspace(begin, end, count + 1).astype(np.int64).tolist() if count > 1 else []
    windows = []
    for start, stop in pairwise(edges):
        later = _between(second, start - late, stop - late)
        part = _calibrated(_between(first, start, stop), later, published)
        if part is not None and part.mount is not None:
            windows.append(MountWindow(start, difference(part.mount, published), _widths(part)))
    return MeasuredMount(
        first.child_frame_id,
        second.child_frame_id,
        name,
        int(first.stamps[0]),
        whole.mount,
        difference(whole.mount, published),
        _widths(whole),
        tuple(windows),
    )


def _calibrated(
    first: TransformArray, second: TransformArray, published: Transform
) -> "Calibration | None":
    # Imported here because the solver is needed only if mounts are requested.
    from tftool.frames.calibration.calibrate import calibrate

    try:
        return calibrate(first, second, published=published, inverted=(False, False))
    except InputError:
        return None


def _widths(found: "Calibration") -> Floats:
    assert found.interval95 is not None
    widths = (*found.interval95.translation, *found.interval95.rotation_deg)
    return np.array([np.nan if one is None else one for one in widths])


def _between(path: TransformArray, begin: int, end: int) -> TransformArray:
    return path[(path.stamps >= begin) & (path.stamps < end)]


def _pairs(model: "Model") -> Iterator[tuple[TransformArray, TransformArray, Transform]]:
    """Yield (motion of the body, motion of the sensor, published mount) of each sensor.

    The two motions were recorded independently of each other.
    """
    edges = model.evidence.transforms.edges
    moving = {one.child: one for one in edges if not one.static and len(one) >= _LEAST}
    static = {one.child: one for one in edges if one.static and len(one)}
    odometry = model.evidence.odometry
    for one in () if odometry is None else odometry.edges:
        body, mount = _climbed(one.child, static)
        if one.child != body and body in moving and len(one) >= _LEAST:
            yield poses_of(moving[body]), poses_of(one), mount
    robot = model.evidence.robot
    if robot is None:
        return
    joint_of = {joint.child: joint for joint in robot.joints.values() if joint.type == "fixed"}
    for child, one in moving.items():
        link, mount = child.removeprefix(model.prefix), Transform.identity()
        while link in joint_of:
            mount = joint_of[link].origin @ mount
            link = joint_of[link].parent
            body = model.prefix + link
            if body in moving:
                if body not in _above(child, edges) and child not in _above(body, edges):
                    yield poses_of(moving[body]), poses_of(one), mount
                break


def _climbed(frame: str, static: dict[str, Edge]) -> tuple[str, Transform]:
    """Follow static edges up from a frame.

    Returns:
        The topmost frame reached, and the pose of `frame` in the topmost frame.
    """
    mount = Transform.identity()
    seen = {frame}
    while frame in static and static[frame].parent not in seen:
        edge = static[frame]
        turn = Quaternion(*unit(edge.rotations[-1]).tolist())
        mount = Transform(Vector3(*edge.translations[-1].tolist()), turn) @ mount
        frame = edge.parent
        seen.add(frame)
    return frame, mount


def _above(frame: str, edges: tuple[Edge, ...]) -> set[str]:
    """Return all ancestors of a frame."""
    parents = {one.child: one.parent for one in edges}
    above: set[str] = set()
    while frame in parents and parents[frame] not in above:
        frame = parents[frame]
        above.add(frame)
    return above
