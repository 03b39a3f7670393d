"""Checks of mounts against recorded motion; they run on request, as they take seconds."""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import as_seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.doctor.check import checks_of
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.frames.calibration.calibrate import (
    ANGLES,
    AXES,
    Interval,
    Trio,
    calibrate,
    difference,
)
from tftool.frames.calibration.motion import poses_of
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.geometry.rigid_arrays import unit
from tftool.recordings.contract import Edge

check = checks_of(Area.VALUES)

_LEAST = 100
"""Poses of a chain below which its motion is not compared."""

_MOST_WINDOWS = 8
"""Windows of one recording: each takes half a second."""


@check(
    "mount-contradicts-motion",
    Severity.WARNING,
    rule="with --mounts: two chains move one body, and a published or described mount differs from "
    "their motion by more than {metres:g} m or {degrees:g}°, and by more than {widths:g} times the "
    "half-width of the 95 % interval, along an axis that the motion shows",
    headline="the mount of {child} on {parent} contradicts its motion",
    detail="{apart}",
    consequence="what this sensor sees is placed wrongly, by more the farther it is away",
    fixes=(
        Fix(
            "measure the mount: `tftool calibrate RECORDING --moving FIXED:MOVING --moving TOPIC "
            "-o FILE` writes it"
        ),
    ),
    causes=(
        "the mount was measured with a ruler",
        "a tripod or a bracket was moved",
        "the odometry's child_frame_id names another frame than the one it moves",
    ),
    limits={"metres": 0.005, "degrees": 0.3, "widths": 2.0},
    needs=("mounts",),
)
def mount_contradicts_motion(model: Model, limits: Limits) -> Iterator[Hit]:
    """A mount contradicts the motions of the two frames that it joins."""
    for first, second, mount in _pairs(model):
        try:
            found = calibrate(first, second, published=mount, inverted=(False, False))
        except InputError:
            continue
        if found.mount is None or found.interval95 is None:
            continue
        shift, turn = difference(found.mount, mount)
        apart = _apart(shift, turn, found.interval95, limits)
        if apart:
            parent, child = first.child_frame_id, second.child_frame_id
            yield Hit(
                edges=((parent, child),),
                frames=(child,),
                confidence=Confidence.LIKELY,
                facts={"parent": parent, "child": child, "apart": "; ".join(apart)},
                alone=True,
            )


@check(
    "mount-changed",
    Severity.WARNING,
    rule="with --mounts: the mount by the motion of a window of {window:g} s or more differs from "
    "that of the window before by more than {metres:g} m or {degrees:g}°, and by more than "
    "{widths:g} times the half-widths of both",
    headline="the mount of {child} on {parent} changed while it was recorded",
    detail="about {when:.0f} s after the start: {apart}",
    consequence="no transform is right before and after it",
    fixes=(Fix("look at its screws and bracket, fix it, and calibrate again: `tftool calibrate`"),),
    causes=("a tripod or a bracket was moved", "a screw is loose", "the odometry slipped once"),
    limits={"metres": 0.01, "degrees": 0.5, "widths": 2.0, "window": 20.0},
    needs=("mounts",),
)
def mount_changed(model: Model, limits: Limits) -> Iterator[Hit]:
    """A mount is not the same over the whole recording."""
    for first, second, mount in _pairs(model):
        begin, end = int(first.stamps[0]), int(first.stamps[-1])
        count = min(_MOST_WINDOWS, int(as_seconds(end - begin) / limits["window"]))
        if count < 2:
            continue
        edges = np.linspace(begin, end, count + 1).astype(np.int64)
        before: tuple[Transform, Interval] | None = None
        for window, (start, stop) in enumerate(pairwise(edges.tolist())):
            parts = [one[(one.stamps >= start) & (one.stamps <= stop)] for one in (first, second)]
            try:
                found = calibrate(*parts, published=mount, inverted=(False, False))
            except InputError:
                continue
            if found.mount is None or found.interval95 is None:
                continue
            apart = []
            if before is not None:
                both = _joined(before[1], found.interval95)
                apart = _apart(*difference(found.mount, before[0]), both, limits)
            if apart:
                parent, child = first.child_frame_id, second.child_frame_id
                when = as_seconds(int(edges[window]) - begin)
                yield Hit(
                    edges=((parent, child),),
                    frames=(child,),
                    confidence=Confidence.LIKELY,
                    facts={
                        "parent": parent,
                        "child": child,
                        "when": when,
                        "apart": "; ".join(apart),
                    },
                    alone=True,
                )
                break
            before = found.mount, found.interval95


def _apart(shift: list[float], turn: list[float], interval: Interval, limits: Limits) -> list[str]:
    """Name the axes along which two mounts differ by more than the limits and the intervals."""
    apart = []
    for names, values, widths, least, unit_name, factor in (
        (AXES, shift, interval.translation, limits["metres"], " mm", 1e3),
        (ANGLES, turn, interval.rotation_deg, limits["degrees"], "°", 1.0),
    ):
        for name, value, width in zip(names, values, widths, strict=True):
            if width is not None and abs(value) > max(limits["widths"] * width, least):
                apart.append(
                    f"{name} differs by {value * factor:.1f}{unit_name} "
                    f"± {width * factor:.1f}{unit_name}"
                )
    return apart


def _joined(one: Interval, other: Interval) -> Interval:
    """Return the interval of a difference of two mounts."""

    def widths(a: Trio, b: Trio) -> Trio:
        x, y, z = (
            None if p is None or q is None else math.hypot(p, q) for p, q in zip(a, b, strict=True)
        )
        return x, y, z

    return Interval(
        widths(one.translation, other.translation), widths(one.rotation_deg, other.rotation_deg)
    )


def _pairs(model: Model) -> Iterator[tuple[TransformArray, TransformArray, Transform]]:
    """Yield two motions of one body that were measured apart, and the mount between them."""
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
    """Climb static links; return the frame above them, and the first frame's pose in it."""
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
    """Return all frames above one."""
    parents = {one.child: one.parent for one in edges}
    above: set[str] = set()
    while frame in parents and parents[frame] not in above:
        frame = parents[frame]
        above.add(frame)
    return above
