"""Checks of mounts against recorded motion; those with --mounts take seconds."""

from collections.abc import Iterator

import numpy as np

from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Confidence, Fact, Fix, Hit, Severity
from tftool.doctor.measured_mounts import MeasuredMount
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import BASES, Track, last_part
from tftool.doctor.wording import dated, several
from tftool.frames.calibration.body_motion import ANGLES, AXES, Floats, difference
from tftool.geometry.rigid_arrays import angles_between, unit

check = checks_of(Area.VALUES)

_MEASURE = Fix(
    "measure the mount: `tftool calibrate RECORDING --moving FIXED:MOVING --moving TOPIC -o FILE` "
    "writes it"
)


@check(
    "mount-contradicts-motion",
    Severity.WARNING,
    rule="with --mounts: two chains of transforms move one body, and a published or described "
    "mount differs from the mount that their motion gives. The difference is more than "
    "{metres:g} m or {degrees:g}°, and more than {widths:g} times the half-width of the 95 % "
    "interval, along an axis that the motion determines",
    headline="the mount of {child} on {parent} contradicts its motion",
    detail="{apart}",
    consequence="data of this sensor is placed wrongly, with an error that grows with the distance",
    fixes=(_MEASURE,),
    causes=(
        "the mount was measured with a ruler",
        "a tripod or a bracket was moved",
        "the odometry's child_frame_id names another frame than the one it moves",
    ),
    limits={"metres": 0.005, "degrees": 0.3, "widths": 2.0},
    needs=("mounts",),
)
def mount_contradicts_motion(model: Model, limits: Limits) -> Iterator[Hit]:
    """A sensor's mount contradicts the motions of the sensor and of the robot."""
    for one in model.evidence.mounts or ():
        outside = _outside(one.shift, limits["widths"] * one.widths, one.widths, limits)
        if outside:
            yield _hit(one, Confidence.LIKELY, apart="; ".join(outside))


@check(
    "mount-changed",
    Severity.WARNING,
    rule="with --mounts: the mount that the motion gives differs between two parts of a recording, "
    "or between the recording and the one named before it on the command line. The "
    "difference is more than {metres:g} m or {degrees:g}°, and more than {widths:g} times the "
    "half-width of its 95 % interval",
    headline="{child} moved on {parent}{when}",
    detail="{apart}",
    consequence="one mount cannot be right before and after: a map or a taught pose from before "
    "does not fit afterwards",
    fixes=(Fix("fasten the sensor again, then measure its mount with `tftool calibrate`"),),
    causes=("a tripod or a bracket was moved", "a screw came loose", "the robot hit something"),
    limits={"metres": 0.005, "degrees": 0.3, "widths": 2.0},
    needs=("mounts",),
)
def mount_changed(model: Model, limits: Limits) -> Iterator[Hit]:
    """A sensor moved on its robot, during the recording or since the previous recording."""
    for one in model.evidence.mounts or ():
        best: tuple[float, int, list[str]] | None = None
        for split in range(1, len(one.windows)):
            shift, widths = _step(one, split)
            outside = _outside(shift, limits["widths"] * widths, widths, limits)
            size = float(np.nanmax(np.abs(shift) / widths))
            if outside and (best is None or size > best[0]):
                best = size, split, outside
        if best is not None:
            when = one.windows[best[1]].begin
            told = f" about {dated(when)}"
            yield _hit(one, Confidence.LIKELY, since=when, when=told, apart="; ".join(best[2]))
        earlier = one.earlier
        if earlier is None:
            continue
        shift = difference(one.mount, earlier.mount)
        widths = np.hypot(one.widths, earlier.widths)
        outside = _outside(shift, limits["widths"] * widths, widths, limits)
        if outside:
            days = [f"{found.name} ({dated(found.begin)})" for found in (earlier, one)]
            told = f" between {days[0]} and {days[1]}"
            yield _hit(one, Confidence.LIKELY, when=told, apart="; ".join(outside))


@check(
    "mount-is-attitude",
    Severity.WARNING,
    rule="below a base frame that moves, a transform only turns, by more than {moves:g}°. A share "
    "of {share:g} or more of its samples, {samples:g} or more, equal the orientation in an Imu "
    "message in its child frame, received at about the same time, to within {degrees:g}°. Not "
    "reported for the child of a movable joint of the robot description",
    headline="{edge} is the orientation that {topic} measures, and no mount",
    detail="{same:%} of {of} samples equal the orientation in a message; they turn by up to "
    "{turn:deg}, and the position is constant",
    consequence="in {parent}, the orientation of {topic} is constant: the transform removes what "
    "the sensor measured",
    fixes=(Fix("let {sender} publish the fixed mount of the sensor instead"),),
    causes=("a broadcaster for a display of the sensor, used on a robot",),
    limits={"moves": 1.0, "share": 0.95, "samples": 20, "degrees": 0.1},
    needs=("headers",),
)
def mount_is_attitude(model: Model, limits: Limits) -> Iterator[Hit]:
    """The mount of an IMU is the orientation that the IMU measures."""
    for track in model.dynamic:
        told = model.evidence.attitudes.get(track.child)
        base, joint = _moving_base(model, track), model.joint_above.get(track.child)
        if told is None or not base or (joint is not None and joint.type != "fixed"):
            continue
        places, valid = track.by_stamp, np.einsum("ij,ij->i", told.rotations, told.rotations) > 0.5
        if len(places) < limits["samples"] or not valid.any():
            continue
        turns, measured = unit(track.rotations[places]), unit(told.rotations[valid])
        after = np.searchsorted(told.log_times[valid], track.logs[places])
        near = (np.clip(after + step, 0, len(measured) - 1) for step in (-2, -1, 0, 1))
        apart = np.min([angles_between(turns, measured[rows]) for rows in near], axis=0)
        same = float(np.mean(apart <= np.radians(limits["degrees"])))
        turn = float(angles_between(turns[:1], turns).max())
        if same >= limits["share"] and turn > np.radians(limits["moves"]):
            facts: dict[str, Fact] = {
                "topic": told.topic,
                "parent": track.parent,
                "same": same,
                "of": len(places),
                "turn": turn,
                "sender": several(track.nodes) or "its publisher",
            }
            yield hit_of(track, facts, topics=(told.topic,), alone=True)


def _moving_base(model: Model, track: Track) -> str:
    """Return the base frame above an edge, if a moving transform is above this frame; else ""."""
    above = model.above(track.child)
    for place, one in enumerate(above):
        if last_part(one.parent) in BASES:
            return one.parent if any(other.moves for other in above[place + 1 :]) else ""
    return ""


def _step(one: MeasuredMount, split: int) -> tuple[Floats, Floats]:
    """Compute the change of a mount between two parts of a recording, with the uncertainty.

    Args:
        one: The mount, measured over several windows of the recording.
        split: Index of the first window after the change.

    Returns:
        Change, and half-widths of its 95 % interval, metres and degrees, shape (6,) each.
    """
    shifts = np.array([window.shift for window in one.windows])
    weights = np.array([window.widths for window in one.windows]) ** -2.0
    means, spreads = [], []
    for part in (slice(split), slice(split, None)):
        share = weights[part] / weights[part].sum(axis=0)
        mean = (share * shifts[part]).sum(axis=0)
        scatter = np.sqrt((share**2 * (2.0 * (shifts[part] - mean)) ** 2).sum(axis=0))
        means.append(mean)
        spreads.append(np.maximum(weights[part].sum(axis=0) ** -0.5, scatter))
    return means[1] - means[0], np.hypot(*spreads)


def _outside(shift: Floats, bounds: Floats, widths: Floats, limits: Limits) -> list[str]:
    """Return a clause for each axis on which the difference of two mounts exceeds its bound.

    Args:
        shift: Difference of the mounts, metres and degrees, shape (6,); NaN never exceeds a bound.
        bounds: Largest normal difference, shape (6,).
        widths: Half-widths of the difference's 95 % interval for the text, shape (6,).
        limits: Thresholds "metres" and "degrees", which replace smaller bounds.
    """
    said = []
    for place, name in enumerate((*AXES, *ANGLES)):
        is_length = place < len(AXES)
        least = limits["metres" if is_length else "degrees"]
        if abs(shift[place]) > max(bounds[place], least):
            unit, factor = (" mm", 1e3) if is_length else ("°", 1.0)
            said.append(
                f"{name} differs by {shift[place] * factor:.1f}{unit} "
                f"± {widths[place] * factor:.1f}{unit}"
            )
    return said


def _hit(one: MeasuredMount, confidence: Confidence, since: int | None = None, **facts: str) -> Hit:
    return Hit(
        edges=((one.parent, one.child),),
        frames=(one.child,),
        since=since,
        confidence=confidence,
        facts={"parent": one.parent, "child": one.child, **facts},
        alone=True,
    )
