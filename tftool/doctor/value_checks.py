"""Checks of values: NaN, invalid rotations, wrong axes and wrong units."""

import math
from collections.abc import Iterator

import numpy as np

from tftool.doctor.check import REP103, checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.missing_joins import base_of
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import BASES, ZERO_QUATERNION, Track, last_part
from tftool.doctor.wording import is_ros1
from tftool.geometry.quaternions import IDENTITY, Triple, angle_between, multiply, rotate
from tftool.geometry.rigid_arrays import rotation_vectors, unit

check = checks_of(Area.VALUES)

_OPTICAL = (-0.5, 0.5, -0.5, 0.5)
_ENDINGS = ("_optical_frame", "_optical_link", "_optical")
_PICTURES = ("sensor_msgs/Image", "sensor_msgs/CameraInfo", "sensor_msgs/CompressedImage")


@check(
    "nan-transform",
    Severity.ERROR,
    rule="a number of a transform is NaN or infinite. A warning if the share of such samples of a "
    "moving transform is below {share:g}",
    limits={"share": 0.01},
    headline="{where} {concerned:has|have} numbers that are NaN or infinite",
    detail="{edge}: {count} of {of} samples, first at {first:moment}: {numbers}; {fate}",
    consequence="a lookup at these stamps gets other samples, or no position",
    fixes=(Fix("look at what its publisher did at that time: `{publishers} {tf_topic}`"),),
    causes=(
        "an estimator or simulation that diverged",
        "a NaN joint command",
        "a message that was never filled",
    ),
    links=threads("moveit/moveit2#298", "NVIDIA-ISAAC-ROS/isaac_ros_nvblox#16"),
)
def nan_transform(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform contains NaN or infinity."""
    for track in model.tracks:
        bad = np.flatnonzero(~track.finite)
        if len(bad):
            numbers = (*track.translations[bad[0]].tolist(), *track.rotations[bad[0]].tolist())
            few = len(bad) < limits["share"] * len(track.stamps)
            has_nan = any(number != number for number in numbers)
            yield hit_of(
                track,
                {
                    "count": len(bad),
                    "of": len(track.stamps),
                    "first": int(track.stamps[bad[0]]),
                    "numbers": " ".join(f"{number:g}" for number in numbers),
                    "fate": "tf2 drops them" if has_nan else "tf2 takes them",
                },
                since=int(track.logs[bad[0]]),
                until=int(track.logs[bad[-1]]),
                count=len(bad),
                severity=Severity.WARNING if few and not track.static else None,
            )


@check(
    "bad-quaternion",
    Severity.ERROR,
    rule="a quaternion's squared length is below 10⁻¹² (an error), or differs from 1 by more "
    "than {length:g} (a warning). In ROS 2, a note if the length differs from 1 by {rounded:g} or "
    "less, as for numbers that were typed with two digits",
    headline="{where} {concerned:has a rotation of|have rotations of a wrong} length{concerned:|,} "
    "{concerned:|such as }{length:.4g} instead of 1",
    detail="{edge}: {count} of {of} samples, first {numbers} (length {length:.4g}); {fate}",
    consequence="{so}",
    fixes=(Fix("look at how its publisher computes the rotation: `{publishers} {tf_topic}`"),),
    causes=(
        "a message that was never filled (w = 0)",
        "decimals typed by hand",
        "zero extrinsics in a camera",
    ),
    links=threads(
        "robomechanics/quad-sdk#346", "introlab/rtabmap_ros#153", "CCNYRoboticsLab/imu_tools#67"
    ),
    limits={"length": 0.01, "rounded": 0.02},
    why="ROS 1 drops a transform with such a rotation, and ROS 2 normalises the rotation: the "
    "frame exists only in ROS 2",
)
def bad_quaternion(model: Model, limits: Limits) -> Iterator[Hit]:
    """A rotation has length zero, or a wrong length."""
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
                fate, so = _fate(model, track, int(bad[0]), severity)
                lengths = np.sqrt(squares[bad])
                is_rounded = bool((np.abs(lengths - 1.0) <= limits["rounded"]).all())
                if is_rounded and not is_ros1(model.evidence):
                    severity = Severity.NOTE
                yield hit_of(
                    track,
                    {
                        "count": len(bad),
                        "of": len(track.stamps),
                        "numbers": numbers,
                        "length": float(lengths[0]),
                        "fate": fate,
                        "so": so,
                    },
                    since=int(track.logs[bad[0]]),
                    until=int(track.logs[bad[-1]]),
                    count=len(bad),
                    severity=severity,
                )


def _fate(model: Model, track: Track, place: int, severity: Severity) -> tuple[str, str]:
    """Return two clauses on a quaternion of a wrong length: tf2's reaction, and the effect."""
    if severity is Severity.ERROR:
        return "tf2 drops them", "a lookup at these stamps gets other samples, or no frame"
    if is_ros1(model.evidence):
        return (
            "tf2 of ROS 1 drops them, ROS 2 normalises them",
            "tf2 of ROS 1 does not know the frame at these stamps",
        )
    x, y, z = rotation_vectors(unit(track.rotations[place])).tolist()
    angle = math.sqrt(x * x + y * y + z * z)
    axis = [round(one / angle, 2) + 0.0 if angle else 0.0 for one in (x, y, z)]
    about = f"({', '.join(f'{one:g}' for one in axis)})"
    for name, one in zip("xyz", axis, strict=True):
        if abs(one) == 1.0:
            about, angle = name, math.copysign(angle, one)
    return (
        f"ROS 2 normalises it to {math.degrees(angle):.1f}° about {about}",
        "ROS 2 uses the normalised rotation, which may not be the one that was meant; ROS 1 and "
        "programs that check the length refuse it",
    )


@check(
    "optical-convention",
    Severity.WARNING,
    rule="the rotation of an optical frame in its body frame differs by more than {degrees:g}° "
    "from optical axes (z forward, x right). The two frames share a name, or are within "
    "{metres:g} m. A note if no message of a sensor is in the optical frame",
    headline="{where} {concerned:does|do} not have optical axes",
    detail="{edge}: {off:.3g}° off",
    consequence="images and clouds in this frame are rotated, if the name is right",
    causes=("the optical frame was given the axes of the body",),
    links=(
        REP103,
        *threads("ros-simulation/gazebo_ros_pkgs#1329"),
    ),
    limits={"degrees": 30.0, "metres": 0.1},
    why="calibrated cameras differ from optical axes by up to 5°, and the transform may include a "
    "tilt of the camera",
)
def optical_convention(model: Model, limits: Limits) -> Iterator[Hit]:
    """An _optical frame does not have optical axes."""
    for track in model.parents.values():
        stem = _stem(track.child)
        parent = last_part(track.parent)
        if stem is None or "optical" in parent or not len(track.by_stamp):
            continue
        place = track.last
        x, y, z = track.translations[place].tolist()
        shares = parent in (stem, f"{stem}_link", f"{stem}_frame") or parent.startswith(stem)
        near = (x * x + y * y + z * z) ** 0.5 < limits["metres"]
        if not shares and (not near or "camera" in parent):
            continue
        qx, qy, qz, qw = unit(track.rotations[place]).tolist()
        off = float(np.degrees(angle_between((qx, qy, qz, qw), _OPTICAL)))
        if off > limits["degrees"]:
            yield hit_of(
                track,
                {"child": track.child, "off": off},
                since=None,
                frames=(track.child,),
                confidence=Confidence.LIKELY,
                count=1,
                severity=None
                if any(h.is_spatial and h.frame == track.child for h in model.heard)
                else Severity.NOTE,
            )


def _stem(name: str) -> str | None:
    """Return an optical frame's name without "_optical_frame"; None for other frames."""
    part = last_part(name)
    for ending in _ENDINGS:
        if part.endswith(ending):
            return part.removesuffix(ending).removesuffix("_link").removesuffix("_frame")
    return None


@check(
    "image-not-optical",
    Severity.NOTE,
    rule='the frame of an image has no "optical" in its name, and no optical axes (z forward, y '
    "down)",
    headline="{where} {concerned:is|are} not in an optical frame",
    detail="{topic} is in {frame}{axes}",
    consequence="a projection of pixels looks along the wrong axis",
    causes=("the driver has one frame for body and picture",),
    links=(
        REP103,
        *threads("usnistgov/ARIAC#345"),
    ),
    needs=("headers",),
    because_of=(
        ("frame", "unknown-frame"),
        ("anything", "no-transforms"),
    ),
)
def image_not_optical(model: Model, limits: Limits) -> Iterator[Hit]:
    """Images are in a body frame instead of an optical frame."""
    for heard in model.heard:
        if heard.type not in _PICTURES or not heard.frame or "optical" in heard.frame:
            continue
        axes = _axes_on_robot(model, heard.frame)
        if axes is not None and axes[0][2] < -_UPRIGHT:
            continue  # its y axis points down: an optical frame with another name
        is_body = axes is not None and axes[1][2] > _UPRIGHT
        yield hit_of(
            heard,
            {
                "frame": heard.frame,
                "axes": ", whose z axis points up, as in a body frame" if is_body else "",
            },
            since=None,
            confidence=Confidence.CERTAIN if is_body else Confidence.POSSIBLE,
            fixes=(Fix("check whether its z axis points out of the lens"),),
        )


_UPRIGHT = 0.7
"""Minimum vertical component of a unit axis that points up: at most 45° from vertical."""


def _axes_on_robot(model: Model, frame: str) -> tuple[Triple, Triple] | None:
    """Return a frame's y and z axes as vectors in the robot's base frame; None if unknown."""
    if frame not in model.frames:
        return None
    turn = IDENTITY
    for track in model.above(frame):
        if not len(track.by_stamp):
            return None
        x, y, z, w = unit(track.rotations[track.last]).tolist()
        turn = multiply((x, y, z, w), turn)
        if last_part(track.parent) in BASES:
            break
    return rotate(turn, (0.0, 1.0, 0.0)), rotate(turn, (0.0, 0.0, 1.0))


@check(
    "suspect-units",
    Severity.NOTE,
    rule="a static below a base frame has a translation longer than {metres:g} m",
    headline="{where} {concerned:is|are} far away for a mount",
    detail="{edge}: {away:m}",
    consequence="if the mount is in millimetres, all frames below are a thousand times too far "
    "away",
    fixes=(Fix("check whether it is in millimetres: tf uses metres"),),
    causes=("a CAD export in millimetres",),
    limits={"metres": 10.0},
)
def suspect_units(model: Model, limits: Limits) -> Iterator[Hit]:
    """A mount is so far from its base that its unit may be millimetres."""
    if not model.trees:
        return
    bases = {base_of(tree) for tree in model.trees} - {""}
    inside = (
        frozenset[str]().union(*(model.below(base) for base in bases)) if bases else frozenset()
    )
    for track in model.statics:
        if track.parent not in inside or not len(track.by_stamp):
            continue
        away = float(np.linalg.norm(track.translations[track.last]))
        if away > limits["metres"]:
            yield hit_of(track, {"away": away}, since=None, confidence=Confidence.POSSIBLE, count=1)


@check(
    "suspect-order",
    Severity.NOTE,
    rule="a static's rotation is exactly x = 1, y = z = w = 0",
    headline="{where} {concerned:is|are} turned over: (1, 0, 0, 0)",
    detail="{edge}: a half turn about x, or no rotation, written with w first",
    consequence="if no rotation was meant, the frame is upside down",
    causes=("a quaternion written w first",),
)
def suspect_order(model: Model, limits: Limits) -> Iterator[Hit]:
    """A static rotation is exactly (1, 0, 0, 0), perhaps because w was written first."""
    for track in model.statics:
        if any(word in track.child.lower() for word in ("imu", "flip", "optical")):
            continue
        if _is_half_turn(track):
            yield hit_of(track, {}, since=None, confidence=Confidence.POSSIBLE, count=1)


def _is_half_turn(track: Track) -> bool:
    return bool(len(track.by_stamp)) and bool(
        (track.rotations[track.last] == (1.0, 0.0, 0.0, 0.0)).all()
    )


@check(
    "utm-origin",
    Severity.WARNING,
    rule="a frame whose name begins with utm is {metres:g} m or less from the distance between its "
    "origin and latitude 0, longitude 0, in the other frame of its transform",
    headline="{where} {concerned:is|are} set from latitude 0, longitude 0",
    detail="{edge}: {away} m apart, as far as the place at latitude 0, longitude 0 is from the "
    "origin of its UTM zone",
    consequence="positions in utm, and those converted from GPS through it, are wrong by the "
    "distance of the robot from that place",
    fixes=(
        Fix(
            "look at the first position that its publisher used (a NavSatFix without a fix, or a "
            "datum of zeros), and restart it with a true one"
        ),
    ),
    limits={"metres": 1.0},
    causes=("navsat_transform_node got a first NavSatFix of zeros",),
)
def utm_origin(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame of UTM coordinates was set from latitude 0, longitude 0."""
    for track in model.tracks:
        if not len(track.by_stamp) or not any(_is_utm(name) for name in track.edge):
            continue
        x, y, _ = track.translations[track.last].tolist()
        away = math.hypot(x, y)
        if any(abs(away - math.hypot(_EAST, north)) <= limits["metres"] for north in (0.0, _NORTH)):
            yield hit_of(track, {"away": f"{away:.3f}"})


def _is_utm(name: str) -> bool:
    return last_part(name).lower().startswith("utm")


_EAST = 166_021.443
"""Easting of latitude 0, longitude 0 in UTM zone 31, metres."""

_NORTH = 10_000_000.0
"""Northing of the equator in the southern zones of UTM, metres."""
