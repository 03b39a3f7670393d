"""Checks of poses: NaN, invalid rotations, jumps, wrong axes and wrong units."""

import math
from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, Stamp, seconds
from tftool.doctor.check import REP103, REP105, checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Edge, Fix, Hit, Severity
from tftool.doctor.gap_checks import is_detection
from tftool.doctor.missing_joins import base_of, is_world, quoted
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import BASES, ZERO_QUATERNION, Places, Track, last_part
from tftool.doctor.wording import is_ros1, metres, moment, several, span
from tftool.geometry.quaternions import IDENTITY, Triple, angle_between, multiply, rotate
from tftool.geometry.rigid_arrays import Floats, rotation_vectors, unit
from tftool.geometry.rigid_arrays import rotate as rotate_all
from tftool.recordings.contract import Stamps, percentile

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
    "teleport",
    Severity.WARNING,
    rule="a step is above {metres:g} m at more than {speed:g} m/s (or above {radians:g} rad at "
    "more than {turning:g} rad/s), and its speed is {times:g} times the 95 % quantile of all "
    "speeds. Such steps are at most a share of {share:g} of all steps ({triggered:g} if each "
    "step comes within 50 ms after a position message) or at most {few:g} steps, among {samples:g} "
    "samples or more of one publisher. A note for a part of a robot if no sensor message is "
    "in its frame. A localiser is reported for {corrections:g} steps or more that move the "
    "robot by {corrected:g} m, not counting the step to an initial pose. An object that a "
    "camera detects is reported for {corrections:g} steps or more of {detected:g} m and 2 m/s "
    "within 1 s",
    headline="{named}",
    detail="{edge}: {jump:m} and {turn:deg} at {at:moment}, {count:times}{others}{usual}{after}",
    consequence="things placed before and after the jump do not fit together{also}",
    causes=(
        "encoder overflow",
        "a reset of the filter",
        "wheel slip",
        "a satellite receiver in the filter of the odometry",
        "a localiser that is lost",
    ),
    links=(
        *threads("ROBOTIS-GIT/turtlebot3#926"),
        REP105,
    ),
    limits={
        "metres": 0.25,
        "speed": 5.0,
        "radians": 0.5,
        "turning": 20.0,
        "times": 8.0,
        "share": 0.02,
        "triggered": 0.05,
        "few": 3,
        "samples": 10,
        "corrections": 3,
        "corrected": 0.5,
        "detected": 1.0,
    },
    why="steady motion has a usual speed, which a jump exceeds. More jumps than the rule allows "
    "are noise, or come from two publishers",
    because_of=(
        ("anything", "time-jump-back"),
        ("mixed", "publisher-conflict two-parents"),
        ("edge", "placeholder-pose frozen-pose outlier"),
    ),
)
def teleport(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame jumps faster than it can move."""
    is_named = model.has_named_publishers
    for track in model.dynamic:
        if track.is_localisation:
            corrected = _corrections(model, track, limits)
            if corrected is not None:
                yield corrected
            continue
        senders = track.senders[track.by_stamp] if is_named and len(track.nodes) > 1 else None
        for number in (0,) if senders is None else np.unique(senders).tolist():
            places = track.by_stamp if senders is None else track.by_stamp[senders == number]
            hit = _jump(model, track, places, limits) if len(places) >= limits["samples"] else None
            hit = hit or _poor_detections(model, track, limits)
            if hit is not None:
                yield hit


def _jump(model: Model, track: Track, places: Places, limits: Limits) -> Hit | None:
    """Return a hit about jumps in one publisher's samples of an edge; None without jumps.

    Args:
        model: Model of the evidence.
        track: The edge.
        places: Indices of the publisher's samples, sorted by stamp, shape (n,).
        limits: Thresholds of `teleport`.
    """
    some, others = places[:-1], places[1:]
    is_whole = len(places) == len(track.by_stamp)
    apart = track.strides if is_whole else track.apart(some, others)
    spins = track.has_turns(some, others, limits["radians"])
    if not spins and not (apart > limits["metres"]).any():
        return None
    stamps = track.sorted_stamps if is_whole else track.stamps[places]
    gaps = np.diff(stamps) / NANOSECONDS
    later = gaps > 0.0
    gaps = np.where(later, gaps, 1.0)
    turned = track.turned(some, others)
    moved = _jumps(apart, gaps, limits["metres"], limits["speed"], limits["times"])
    spun = _jumps(turned, gaps, limits["radians"], limits["turning"], limits["times"])
    jumps = np.flatnonzero((moved | spun) & later)
    topic, after = _trigger(model, track.logs[others[jumps]])
    share = limits["triggered"] if topic else limits["share"]
    if not len(jumps) or len(jumps) > max(limits["few"], share * len(gaps)):
        return None
    worst = int(jumps[np.argmax(apart[jumps])])
    if not moved[worst]:
        worst = int(jumps[np.argmax(turned[jumps])])
    is_odometry = last_part(track.parent).startswith("odom")
    usual = float(np.median(apart[later] / gaps[later]))
    far = metres(float(apart[worst])) if moved[worst] else f"{np.degrees(turned[worst]):.3g}°"
    how = f" within {span(gaps[worst] * NANOSECONDS)}"
    return hit_of(
        track,
        {
            "jump": float(apart[worst]),
            "turn": float(turned[worst]),
            "far": far,
            "named": f"{track.name} jumps {far}{how}",
            "within": int(gaps[worst] * NANOSECONDS),
            "how": how,
            "at": int(track.stamps[others[worst]]),
            "others": _others(track, others[jumps], int(others[worst])),
            "usual": f"; usual {usual:.2g} m/s" if usual else "",
            "after": f"; each at most {span(after)} after a message of {topic}" if topic else "",
            "count": len(jumps),
            "also": "; REP-105 wants this transform continuous" if is_odometry else "",
            "mixed": is_whole,
        },
        since=int(track.logs[others[jumps[0]]]),
        until=int(track.logs[others[jumps[-1]]]),
        count=len(jumps),
        severity=Severity.NOTE if model.is_minor(track) else None,
        fixes=_look(
            model, track.edge, int(track.stamps[some[worst]]), int(track.stamps[others[worst]])
        ),
    )


def _look(model: Model, edge: Edge, before: Stamp, after: Stamp) -> tuple[Fix, ...]:
    """Return remedies with the commands that print the pose before a jump and the pose after it."""
    echo = f"tftool echo {quoted(edge[0])} {quoted(edge[1])} RECORDING --at"
    # A small number is seconds since the start of the recording, not a stamp.
    begin = model.epoch if after < SIMULATED_BELOW else 0
    first, then = (
        f"{(one - begin) // NANOSECONDS}.{(one - begin) % NANOSECONDS:09}".rstrip("0").rstrip(".")
        for one in (before, after)
    )
    return (
        Fix("compare the jump with the sensors; before it:", f"{echo} {first}"),
        Fix("after it:", f"{echo} {then}"),
    )


def _others(track: Track, places: Places, worst: int) -> str:
    """Return the stamps of all jumps except the worst jump, as a clause of a sentence."""
    others = [moment(int(track.stamps[place])) for place in places.tolist() if place != worst]
    return f"; also at {several(others)}" if others else ""


def _corrections(model: Model, track: Track, limits: Limits) -> Hit | None:
    """Return a hit if a localiser corrects the robot's pose again and again; else None.

    A first step that is also the largest step is the initial pose, and does not count.
    """
    places = track.by_stamp
    if len(places) < limits["samples"] or last_part(track.parent).startswith("odom"):
        return None
    some, others = places[:-1], places[1:]
    robot, shown = np.zeros((len(others), 3)), track.edge
    for below in model.dynamic:
        if below.parent == track.child and last_part(below.child) in BASES and len(below.by_stamp):
            near = np.searchsorted(below.sorted_stamps, track.stamps[others])
            robot = below.translations[below.by_stamp[near.clip(max=len(below.by_stamp) - 1)]]
            shown = track.parent, below.child
    # A turn of odom moves the robot by its distance from the origin of odom.
    before, after = (
        track.translations[one] + rotate_all(unit(track.rotations[one]), robot)
        for one in (some, others)
    )
    moved = np.linalg.norm(after - before, axis=1)
    steps = np.flatnonzero(moved > limits["corrected"])
    if len(steps) and moved[steps[0]] > 0.999 * moved.max():
        steps = steps[1:]
    if len(steps) < limits["corrections"]:
        return None
    how = f"{limits['corrected']:g} m: its localiser corrects it again and again"
    also = "; the localiser may be lost"
    words = how, f", measured at {shown[1]}", also
    return _repeated_jumps(model, track, steps, moved, words, shown)


def _poor_detections(model: Model, track: Track, limits: Limits) -> Hit | None:
    """Return a hit if a detected object jumps by metres from detection to detection; else None."""
    if is_world(track.parent) or len(track.by_stamp) < 2 or not is_detection(model, track):
        return None
    gaps = np.diff(track.sorted_stamps) / NANOSECONDS
    steps = np.flatnonzero(
        (track.strides > limits["detected"]) & (track.strides > 2.0 * gaps) & (gaps < 1.0)
    )
    if len(steps) < limits["corrections"]:
        return None
    away = np.linalg.norm(track.translations[track.by_stamp], axis=1)
    after = f"; seen at {away.min():.3g} m to {metres(float(away.max()))}"
    words = f"{limits['detected']:g} m within 1 s", after, ""
    return _repeated_jumps(model, track, steps, track.strides, words, track.edge)


def _repeated_jumps(
    model: Model,
    track: Track,
    steps: Places,
    moved: Floats,
    words: tuple[str, str, str],
    shown: Edge,
) -> Hit:
    """Return a hit about several steps of an edge.

    Args:
        model: Model of the evidence.
        track: The edge.
        steps: Indices of the reported steps in `moved`, shape (m,).
        moved: Lengths of all steps, sorted by stamp, metres, shape (n,).
        words: Clauses about the size of the steps, the longest step, and the consequence.
        shown: Target and source of the lookup that shows the steps.
    """
    places = track.by_stamp
    worst = int(steps[moved[steps].argmax()])
    far = f"by up to {metres(float(moved[worst]))}"
    how = f", {len(steps)} times by more than {words[0]}"
    return hit_of(
        track,
        {
            "jump": float(moved[worst]),
            "turn": float(track.turned(places[[worst]], places[[worst + 1]])[0]),
            "far": far,
            "how": how,
            "named": f"{track.name} jumps {far}{how}",
            "at": int(track.stamps[places[worst + 1]]),
            "others": _others(track, places[steps + 1], int(places[worst + 1])),
            "usual": "",
            "after": words[1],
            "count": len(steps),
            "also": words[2],
            "mixed": True,
        },
        since=int(track.logs[places[steps[0] + 1]]),
        until=int(track.logs[places[steps[-1] + 1]]),
        count=len(steps),
        fixes=_look(model, shown, *track.stamps[places[[worst, worst + 1]]].tolist()),
    )


def _trigger(model: Model, jumps: Stamps) -> tuple[str, int]:
    """Find the position topic of low rate, such as GPS, whose messages trigger all jumps.

    Args:
        model: Model of the evidence.
        jumps: Log times of the jumps, nanoseconds, shape (n,).

    Returns:
        The topic, empty if there is none, and the longest delay from a message to its jump,
        nanoseconds.
    """
    best = "", _SOON
    for heard in model.heard:
        if last_part(heard.type) not in ("NavSatFix", "Odometry") or len(jumps) < 3:
            continue
        before = np.searchsorted(heard.logs, jumps, side="right") - 1
        delays = jumps - heard.logs[before]
        lasts = int(heard.logs[-1] - heard.logs[0])
        is_rare = 2 * len(heard.logs) * _SOON < lasts
        if is_rare and before.min() >= 0 and delays.max() < best[1]:
            best = heard.topic, int(delays.max())
    return best


_SOON = seconds(0.05)
"""Maximum time, nanoseconds, from a message to the jump that it triggers."""


def _jumps(
    steps: "np.ndarray[tuple[int], np.dtype[np.float64]]",
    gaps: "np.ndarray[tuple[int], np.dtype[np.float64]]",
    least: float,
    speed: float,
    times: float,
) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    speeds = steps / gaps
    limit = max(speed, times * percentile(speeds, 95))
    found: np.ndarray[tuple[int], np.dtype[np.bool_]] = (steps > least) & (speeds > limit)
    return found


@check(
    "optical-convention",
    Severity.WARNING,
    rule="the rotation of an optical frame in its body frame differs by more than {degrees:g}° "
    "from optical axes (z forward, x right). The two frames share a name, or are within "
    "{metres:g} m. A note if no message of a sensor is in the optical frame",
    headline="{where} {concerned:does|do} not have optical axes",
    detail="{edge}: {off:.3g}° off",
    consequence="images and clouds in it are rotated, if the name is right",
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
                "axes": ", whose z looks up as a body's does" if is_body else "",
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
    detail="{edge}: a half turn about x, or no turn written w first",
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
