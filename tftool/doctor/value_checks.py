"""Checks of the numbers: NaN, rotations that are none, jumps, axes."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.doctor.findings import Confidence, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.shape_checks import base_of
from tftool.doctor.stamp_stream import ZERO_QUATERNION, Track, last_part
from tftool.doctor.wording import metres
from tftool.geometry.quaternions import angle_between
from tftool.geometry.rigid_arrays import angles_between, unit

_OPTICAL = (-0.5, 0.5, -0.5, 0.5)
_ENDINGS = ("_optical_frame", "_optical_link", "_optical")
_PICTURES = ("sensor_msgs/Image", "sensor_msgs/CameraInfo", "sensor_msgs/CompressedImage")


def nan_transform(model: Model, limits: Limits) -> Iterator[Hit]:
    """NaN or infinity in a transform."""
    for track in model.tracks:
        bad = np.flatnonzero(~track.finite)
        if len(bad):
            numbers = (*track.translations[bad[0]].tolist(), *track.rotations[bad[0]].tolist())
            has_nan = any(number != number for number in numbers)
            yield Hit(
                edges=(track.edge,),
                publishers=track.nodes,
                since=int(track.logs[bad[0]]),
                until=int(track.logs[bad[-1]]),
                count=len(bad),
                facts={
                    "edge": track.name,
                    "count": len(bad),
                    "of": len(track.stamps),
                    "first": int(track.stamps[bad[0]]),
                    "numbers": " ".join(f"{number:g}" for number in numbers),
                    "fate": "tf2 drops them" if has_nan else "tf2 takes them",
                },
            )


def bad_quaternion(model: Model, limits: Limits) -> Iterator[Hit]:
    """A rotation of length zero, or of a length that is off."""
    for track in model.tracks:
        squares = track.squares
        off = np.abs(squares - 1.0)
        if len(off) and off.max() <= min(limits["length"], 0.5):
            continue
        zero = np.flatnonzero(track.finite & (squares < ZERO_QUATERNION))
        loose = np.flatnonzero(
            track.finite & (squares >= ZERO_QUATERNION) & (off > limits["length"])
        )
        for bad, severity in ((zero, Severity.ERROR), (loose, Severity.WARNING)):
            if len(bad):
                numbers = " ".join(f"{number:g}" for number in track.rotations[bad[0]].tolist())
                yield Hit(
                    edges=(track.edge,),
                    publishers=track.nodes,
                    since=int(track.logs[bad[0]]),
                    until=int(track.logs[bad[-1]]),
                    count=len(bad),
                    severity=severity,
                    facts={
                        "edge": track.name,
                        "count": len(bad),
                        "of": len(track.stamps),
                        "numbers": numbers,
                        "length": float(np.sqrt(squares[bad[0]])),
                        "fate": "both tf2s drop them"
                        if severity is Severity.ERROR
                        else "ROS 1 drops them, ROS 2 normalises them",
                    },
                )


def teleport(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame jumps faster than anything moves."""
    for track in model.dynamic:
        places = track.by_stamp
        if track.is_localisation or len(places) < limits["samples"]:
            continue
        some, others = places[:-1], places[1:]
        apart = track.strides
        spins = track.has_turns(some, others, limits["radians"])
        if not spins and not (apart > limits["metres"]).any():
            continue
        gaps = np.diff(track.sorted_stamps) / NANOSECONDS
        later = gaps > 0.0
        gaps = np.where(later, gaps, 1.0)
        turned = track.turned(some, others)
        moved = _jumps(apart, gaps, limits["metres"], limits["speed"], limits["times"])
        spun = _jumps(turned, gaps, limits["radians"], limits["turning"], limits["times"])
        jumps = np.flatnonzero((moved | spun) & later)
        if not len(jumps) or len(jumps) > max(limits["few"], limits["share"] * len(gaps)):
            continue
        worst = int(jumps[np.argmax(apart[jumps])])
        if not moved[worst]:
            worst = int(jumps[np.argmax(turned[jumps])])
        is_odometry = last_part(track.parent).startswith("odom")
        yield Hit(
            edges=(track.edge,),
            publishers=track.nodes,
            since=int(track.logs[others[jumps[0]]]),
            until=int(track.logs[others[jumps[-1]]]),
            count=len(jumps),
            facts={
                "edge": track.name,
                "jump": float(apart[worst]),
                "turn": float(turned[worst]),
                "within": int(gaps[worst] * NANOSECONDS),
                "at": int(track.stamps[others[worst]]),
                "usual": float(np.median(apart / gaps)),
                "count": len(jumps),
                "also": "; REP-105 wants this transform continuous" if is_odometry else "",
            },
        )


def _jumps(
    steps: "np.ndarray[tuple[int], np.dtype[np.float64]]",
    gaps: "np.ndarray[tuple[int], np.dtype[np.float64]]",
    least: float,
    speed: float,
    times: float,
) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    speeds = steps / gaps
    limit = max(speed, times * float(np.percentile(speeds, 95)))
    found: np.ndarray[tuple[int], np.dtype[np.bool_]] = (steps > least) & (speeds > limit)
    return found


def optical_convention(model: Model, limits: Limits) -> Iterator[Hit]:
    """An _optical frame without optical axes."""
    for track in model.parents.values():
        stem = _stem(track.child)
        parent = last_part(track.parent)
        if stem is None or "optical" in parent or not len(track.by_stamp):
            continue
        place = track.by_stamp[-1]
        x, y, z = track.translations[place].tolist()
        shares = parent in (stem, f"{stem}_link", f"{stem}_frame") or parent.startswith(stem)
        near = (x * x + y * y + z * z) ** 0.5 < limits["metres"]
        if not shares and (not near or "camera" in parent):
            continue
        qx, qy, qz, qw = unit(track.rotations[place]).tolist()
        off = float(np.degrees(angle_between((qx, qy, qz, qw), _OPTICAL)))
        if off > limits["degrees"]:
            yield Hit(
                edges=(track.edge,),
                frames=(track.child,),
                publishers=track.nodes,
                confidence=Confidence.LIKELY,
                facts={"edge": track.name, "child": track.child, "off": off},
            )


def _stem(name: str) -> str | None:
    """What an optical frame is called before it says that it is one."""
    part = last_part(name)
    for ending in _ENDINGS:
        if part.endswith(ending):
            return part.removesuffix(ending).removesuffix("_link").removesuffix("_frame")
    return None


def image_not_optical(model: Model, limits: Limits) -> Iterator[Hit]:
    """Images stamped in a body frame."""
    for heard in model.heard:
        if heard.type in _PICTURES and heard.frame and "optical" not in heard.frame:
            yield Hit(
                topics=(heard.topic,),
                frames=(heard.frame,),
                count=len(heard.stamps),
                facts={"topic": heard.topic, "frame": heard.frame},
            )


def odometry_tf_mismatch(model: Model, limits: Limits) -> Iterator[Hit]:
    """Odometry message and transform of one name disagree."""
    odometry = model.material.odometry
    if odometry is None:
        return
    tracks = {track.edge: track for track in model.tracks}
    for edge in odometry.edges:
        told = Track(edge, odometry)
        track = tracks.get(told.edge)
        topic = ", ".join(told.topics)
        if track is None:
            if {edge.parent, edge.child} <= model.frames and edge.parent != edge.child:
                yield _no_such_transform(model, told, topic)
            continue
        hit = _disagreement(track, told, topic, model.end, limits)
        if hit is not None:
            yield hit


def _no_such_transform(model: Model, told: Track, topic: str) -> Hit:
    above = model.parents.get(told.child)
    hangs = f"in tf {told.child} hangs from {above.parent}" if above else "in tf it has no parent"
    return Hit(
        edges=(told.edge,),
        topics=told.topics,
        publishers=told.nodes,
        count=len(told.stamps),
        severity=Severity.NOTE,
        facts={
            "topic": topic,
            "edge": told.name,
            "found": f"{topic} says {told.name}; {hangs}",
        },
        alone=True,
    )


def _disagreement(
    track: Track, told: Track, topic: str, end: Stamp, limits: Limits
) -> "Hit | None":
    """How far the two are apart where they are stamped alike, if that is too far too often."""
    if track.static:
        return None
    places = told.by_stamp[told.logs[told.by_stamp] <= end]
    _, mine, theirs = np.intersect1d(track.sorted_stamps, told.stamps[places], return_indices=True)
    if not len(mine):
        return None
    some, others = track.by_stamp[mine], places[theirs]
    away = track.translations[some] - told.translations[others]
    apart = np.sqrt(np.einsum("ij,ij->i", away, away))
    turned = angles_between(unit(track.rotations[some]), unit(told.rotations[others]))
    wrong = (apart > limits["metres"]) | (turned > np.radians(limits["degrees"]))
    count = int(np.count_nonzero(wrong))
    if count <= limits["share"] * len(wrong):
        return None
    return Hit(
        edges=(track.edge,),
        topics=told.topics,
        publishers=tuple(dict.fromkeys((*track.nodes, *told.nodes))),
        since=int(track.logs[some[wrong]].min()),
        count=count,
        facts={
            "topic": topic,
            "edge": track.name,
            "apart": float(np.median(apart)),
            "turned": float(np.median(turned)),
            "found": f"{count:,} of {len(wrong):,} pairs of one stamp, usually "
            f"{metres(float(np.median(apart)))} and {np.degrees(np.median(turned)):.3g}° apart",
        },
        alone=True,
    )


def suspect_units(model: Model, limits: Limits) -> Iterator[Hit]:
    """A mount far from its parent inside one robot: millimetres?"""
    if not model.trees:
        return
    bases = {base_of(tree) for tree in model.trees} - {""}
    inside = (
        frozenset[str]().union(*(model.below(base) for base in bases)) if bases else frozenset()
    )
    for track in model.statics:
        if track.parent not in inside or not len(track.by_stamp):
            continue
        away = float(np.linalg.norm(track.translations[track.by_stamp[-1]]))
        if away > limits["metres"]:
            yield Hit(
                edges=(track.edge,),
                publishers=track.nodes,
                confidence=Confidence.GUESS,
                facts={"edge": track.name, "away": away},
            )


def suspect_order(model: Model, limits: Limits) -> Iterator[Hit]:
    """A static of exactly (1, 0, 0, 0): w first by mistake?"""
    for track in model.statics:
        if any(word in track.child.lower() for word in ("imu", "flip", "optical")):
            continue
        if _is_half_turn(track):
            yield Hit(
                edges=(track.edge,),
                publishers=track.nodes,
                confidence=Confidence.GUESS,
                facts={"edge": track.name},
            )


def _is_half_turn(track: Track) -> bool:
    return bool(len(track.by_stamp)) and bool(
        (track.rotations[track.by_stamp[-1]] == (1.0, 0.0, 0.0, 0.0)).all()
    )
