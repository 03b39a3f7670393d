"""Checks of numbers: NaN, invalid rotations, jumps, axes."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.doctor.check import REP103, REP105, checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.missing_joins import BASES, base_of
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import ZERO_QUATERNION, Track, last_part
from tftool.doctor.wording import metres
from tftool.geometry.quaternions import IDENTITY, Triple, angle_between, multiply, rotate
from tftool.geometry.rigid_arrays import angles_between, unit

check = checks_of(Area.VALUES)

_OPTICAL = (-0.5, 0.5, -0.5, 0.5)
_ENDINGS = ("_optical_frame", "_optical_link", "_optical")
_PICTURES = ("sensor_msgs/Image", "sensor_msgs/CameraInfo", "sensor_msgs/CompressedImage")


@check(
    "nan-transform",
    Severity.ERROR,
    rule="a number of a transform is NaN or infinite",
    headline="{where} {concerned:has|have} numbers that are none",
    detail="{edge}: {count} of {of} samples, first at {first:moment}: {numbers}; {fate}",
    consequence="the frame stops or disappears; things placed through it have no position",
    fixes=(
        Fix("check the source: a division by zero, a filter that diverged, a joint without state"),
    ),
    causes=(
        "an estimator or simulation that diverged",
        "a NaN joint command",
        "a message that was never filled",
    ),
    links=threads("moveit/moveit2#298", "NVIDIA-ISAAC-ROS/isaac_ros_nvblox#16"),
)
def nan_transform(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform holds NaN or infinity."""
    for track in model.tracks:
        bad = np.flatnonzero(~track.finite)
        if len(bad):
            numbers = (*track.translations[bad[0]].tolist(), *track.rotations[bad[0]].tolist())
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
            )


@check(
    "bad-quaternion",
    Severity.ERROR,
    rule="a quaternion's squared length is below 10⁻¹² (an error), or differs from 1 by more"
    " than {length:g} (a warning)",
    headline="{where} {concerned:has|have} rotations that are none",
    detail="{edge}: {count} of {of} samples, first {numbers} (length {length:.4g}); {fate}",
    consequence="the frame exists for one listener and not for another",
    fixes=(Fix("fill the rotation (w = 1 for none), and normalise it before sending"),),
    causes=(
        "a message that was never filled (w = 0)",
        "decimals typed by hand",
        "zero extrinsics in a camera",
    ),
    links=threads(
        "robomechanics/quad-sdk#346", "introlab/rtabmap_ros#153", "CCNYRoboticsLab/imu_tools#67"
    ),
    limits={"length": 0.01},
    why="ROS 1 drops such a transform and ROS 2 normalises it: the frame exists in one and "
    "not in the other",
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
                yield hit_of(
                    track,
                    {
                        "count": len(bad),
                        "of": len(track.stamps),
                        "numbers": numbers,
                        "length": float(np.sqrt(squares[bad[0]])),
                        "fate": "both tf2s drop them"
                        if severity is Severity.ERROR
                        else "ROS 1 drops them, ROS 2 normalises them",
                    },
                    since=int(track.logs[bad[0]]),
                    until=int(track.logs[bad[-1]]),
                    count=len(bad),
                    severity=severity,
                )


@check(
    "teleport",
    Severity.WARNING,
    rule="a step above {metres:g} m at more than {speed:g} m/s (or above {radians:g} rad at "
    "more than {turning:g} rad/s) and at {times:g} times the 95 % quantile of the "
    "speed, in a share of at most {share:g} of the steps or {few:g} of them; of "
    "{samples:g} samples or more",
    headline="{where} {concerned:jumps|jump} {far} within {within:span}",
    detail="{edge}: {jump:m} and {turn:deg} at {at:moment}, {count:times}; usual {usual:.2g} m/s",
    consequence="things placed before and after the jump do not fit together{also}",
    fixes=(
        Fix(
            "check the source at that moment: encoder overflow, a reset of the filter, wheel "
            "slip, a tracker that mistook the body"
        ),
    ),
    causes=(
        "encoder overflow",
        "a reset of the filter",
        "wheel slip",
    ),
    links=(
        *threads("ROBOTIS-GIT/turtlebot3#926"),
        REP105,
    ),
    limits={
        "metres": 0.25,
        "speed": 10.0,
        "radians": 0.5,
        "turning": 20.0,
        "times": 8.0,
        "share": 0.02,
        "few": 3,
        "samples": 10,
    },
    why="steady motion has a usual speed; more jumps than that are noise, or two publishers",
    because_of=(
        ("anything", "time-jump-back"),
        ("child", "publisher-conflict two-parents"),
    ),
)
def teleport(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame jumps faster than it can move."""
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
        yield hit_of(
            track,
            {
                "jump": float(apart[worst]),
                "turn": float(turned[worst]),
                "far": metres(float(apart[worst]))
                if moved[worst]
                else f"{np.degrees(turned[worst]):.3g}°",
                "within": int(gaps[worst] * NANOSECONDS),
                "at": int(track.stamps[others[worst]]),
                "usual": float(np.median(apart / gaps)),
                "count": len(jumps),
                "also": "; REP-105 wants this transform continuous" if is_odometry else "",
            },
            since=int(track.logs[others[jumps[0]]]),
            until=int(track.logs[others[jumps[-1]]]),
            count=len(jumps),
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


@check(
    "optical-convention",
    Severity.WARNING,
    rule="the rotation of an optical frame in its body frame is more than {degrees:g}° off "
    "optical axes (z forward, x right), if both share a name or are within {metres:g} m",
    headline="{where} {concerned:does|do} not have optical axes",
    detail="{edge}: {off:.3g}° off",
    consequence="images and clouds in it are rotated",
    fixes=(Fix('make it a fixed joint with rpy="-1.5708 0 -1.5708", and name it in the driver'),),
    causes=("the optical frame was given the axes of the body",),
    links=(
        REP103,
        *threads("ros-simulation/gazebo_ros_pkgs#1329"),
    ),
    limits={"degrees": 5.0, "metres": 0.1},
    why="calibrated cameras are off by up to 5°",
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
            )


def _stem(name: str) -> str | None:
    """Return an optical frame's name without its optical suffix; None for other frames."""
    part = last_part(name)
    for ending in _ENDINGS:
        if part.endswith(ending):
            return part.removesuffix(ending).removesuffix("_link").removesuffix("_frame")
    return None


@check(
    "image-not-optical",
    Severity.NOTE,
    rule='an image\'s frame has no "optical" in its name, and no optical axes (z forward, y down)',
    headline="{where} {concerned:is|are} not in an optical frame",
    detail="{topic} is in {frame}{axes}",
    consequence="a projection of its pixels looks along the wrong axis",
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
    """Images are stamped in a body frame."""
    for heard in model.heard:
        if heard.type not in _PICTURES or not heard.frame or "optical" in heard.frame:
            continue
        axes = _axes_on_robot(model, heard.frame)
        if axes is not None and axes[0][2] < -_UPRIGHT:
            continue  # its y axis points down: an optical frame with another name
        is_body = axes is not None and axes[1][2] > _UPRIGHT
        joint = 'add a fixed joint with rpy="-1.5708 0 -1.5708", and name its frame in the driver'
        yield hit_of(
            heard,
            {
                "frame": heard.frame,
                "axes": ", whose z looks up as a body's does" if is_body else "",
            },
            since=None,
            confidence=Confidence.CERTAIN if is_body else Confidence.POSSIBLE,
            fixes=(
                Fix(
                    joint
                    if is_body
                    else f"check whether its z axis points out of the lens; if not, {joint}"
                ),
            ),
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
    "odometry-tf-mismatch",
    Severity.WARNING,
    rule="an Odometry message and the transform of the same two frames and the same stamp "
    "differ by more than {metres:g} m or {degrees:g}°, in a share above {share:g} of "
    "such pairs; a note if tf has no transform of these frames",
    headline="{topic} {differs} {edge}",
    detail="{found}",
    consequence="programs that use the message and programs that use tf may see the robot in "
    "different places",
    causes=(
        "the message is the wheels', the transform a filter's",
        "the filter's publish_tf is off and another node sends the transform",
    ),
    limits={"metres": 0.05, "degrees": 2.0, "share": 0.5},
    needs=("odometry",),
    because_of=(
        ("frame", "split-tree"),
        ("child", "static-and-dynamic"),
    ),
)
def odometry_tf_mismatch(model: Model, limits: Limits) -> Iterator[Hit]:
    """An odometry message and the transform of the same frames disagree."""
    odometry = model.evidence.odometry
    if odometry is None:
        return
    tracks = {track.edge: track for track in model.tracks}
    for edge in odometry.edges:
        told = Track(edge, odometry)
        track = tracks.get(told.edge)
        topic = ", ".join(told.topics)
        if track is None:
            if {edge.parent, edge.child} <= model.frames and not _is_same_base(model, told):
                yield _no_such_transform(model, told, topic)
            continue
        hit = _disagreement(track, told, topic, model.end, limits)
        if hit is not None:
            yield hit


def _is_same_base(model: Model, told: Track) -> bool:
    """Whether a message's child and parent are both frames of the robot's base.

    All frames between them in tf must be base frames too, such as base_footprint.
    """
    above = model.above(told.child)
    parents = [track.parent for track in above]
    if told.parent not in parents:
        return told.parent == told.child
    between = {told.child, *parents[: parents.index(told.parent)]}
    return {last_part(name) for name in between} <= set(BASES)


def _no_such_transform(model: Model, told: Track, topic: str) -> Hit:
    above = model.parents.get(told.child)
    hangs = f"in tf {told.child} hangs from {above.parent}" if above else "in tf it has no parent"
    return hit_of(
        told,
        {
            "topic": topic,
            "differs": "and tf connect other frames:",
            "found": f"{topic} says {told.name}; {hangs}",
        },
        since=None,
        frames=told.edge,
        topics=told.topics,
        severity=Severity.NOTE,
        fixes=(
            Fix(
                "compare the child_frame_id of the messages with the base frame of tf: one "
                "of the two is probably the wrong frame"
            ),
        ),
        alone=True,
    )


def _disagreement(
    track: Track, told: Track, topic: str, end: Stamp, limits: Limits
) -> "Hit | None":
    """Return a hit if an edge and an odometry topic often have different poses at one stamp.

    Args:
        track: The edge in tf.
        told: The poses in the odometry messages.
        topic: Name of the odometry topic.
        end: Log time after which messages are ignored.
        limits: The thresholds.

    Returns:
        The hit; None if few poses differ, or the edge is static.
    """
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
            "differs": "and tf disagree about",
            "apart": float(np.median(apart)),
            "turned": float(np.median(turned)),
            "found": f"{count:,} of {len(wrong):,} pairs of one stamp, usually "
            f"{metres(float(np.median(apart)))} and {np.degrees(np.median(turned)):.3g}° apart",
        },
        fixes=(Fix("let one node publish both, from one estimate"),),
        alone=True,
    )


@check(
    "suspect-units",
    Severity.NOTE,
    rule="a static below a base frame is longer than {metres:g} m",
    headline="{where} {concerned:is|are} far away for a mount",
    detail="{edge}: {away:m}",
    consequence="if it is in millimetres, everything below is a thousand times too far away",
    fixes=(Fix("check whether it is in millimetres: tf uses metres"),),
    causes=("a CAD export in millimetres",),
    limits={"metres": 10.0},
)
def suspect_units(model: Model, limits: Limits) -> Iterator[Hit]:
    """A mount is far from its parent inside one robot: millimetres?"""
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
    detail="{edge}: a half turn about x, or no turn written w first",
    consequence="if no rotation was meant, the frame is upside down",
    fixes=(Fix("write quaternions as x y z w: no rotation is 0 0 0 1"),),
    causes=("a quaternion written w first",),
)
def suspect_order(model: Model, limits: Limits) -> Iterator[Hit]:
    """A static is exactly (1, 0, 0, 0): w first by mistake?"""
    for track in model.statics:
        if any(word in track.child.lower() for word in ("imu", "flip", "optical")):
            continue
        if _is_half_turn(track):
            yield hit_of(track, {}, since=None, confidence=Confidence.POSSIBLE, count=1)


def _is_half_turn(track: Track) -> bool:
    return bool(len(track.by_stamp)) and bool(
        (track.rotations[track.last] == (1.0, 0.0, 0.0, 0.0)).all()
    )
