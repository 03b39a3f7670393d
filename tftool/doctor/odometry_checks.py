"""Checks of Odometry messages: differences from tf, negative variances, repeated poses."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp, seconds
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.gap_checks import is_detection
from tftool.doctor.missing_joins import is_world
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import BASES, ROUNDED, Places, Track, are_same, last_part
from tftool.doctor.wording import metres, several, span
from tftool.geometry.rigid_arrays import Floats, angles_between, rotate, unit
from tftool.recordings.contract import median, percentile

check = checks_of(Area.VALUES)


@check(
    "odometry-tf-mismatch",
    Severity.NOTE,
    rule="an Odometry message and the transform with the same two frames and the same stamp differ "
    "by more than {metres:g} m or {degrees:g}°, in a share above {share:g} of such pairs; or "
    "tf has no transform between these frames. A warning if a position in the message and "
    "one in tf, from any publisher and within {near:g} s, differ by more than {far:g} m and "
    "by more than the robot moved. A warning also if {poses:g} poses or more, with |y| above "
    "{aside:g} m, are equal except for the sign of y, and no such pose has the same sign. A note "
    "also if the positions at equal times differ by {mean:g} m or more (mean), and a constant "
    "delay of {least:g} to {most:g} s removes {removed:%} of the difference, and a constant "
    "distance less",
    headline="{topic} {differs} {edge}",
    detail="{found}",
    consequence="programs that use the message and programs that use tf may see the robot in "
    "different places",
    causes=(
        "the message has the pose of the wheels, the transform that of a filter",
        "the filter's publish_tf is off and another node sends the transform",
    ),
    limits={
        "metres": 0.05,
        "degrees": 2.0,
        "share": 0.5,
        "near": 0.5,
        "far": 10.0,
        "poses": 10,
        "aside": 0.005,
        "mean": 0.02,
        "least": 0.02,
        "most": 0.9,
        "removed": 0.8,
    },
    needs=("odometry",),
    because_of=(
        ("frame", "rep105-shape"),
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
        track = tracks.get(told.edge) or _base_below(model, told)
        topic = ", ".join(told.topics)
        if track is None:
            if {edge.parent, edge.child} <= model.frames and not _is_same_base(model, told):
                yield _no_such_transform(model, told, topic)
            continue
        hit = None
        if not track.static and len(track.by_stamp):
            hit = _far_apart(track, told, topic, limits)
            hit = hit or _mirrored(track, told, topic, limits)
            hit = hit or _delayed(track, told, topic, limits)
            hit = hit or _disagreement(track, told, topic, model.end, limits)
        if hit is not None:
            yield hit


def _is_same_base(model: Model, odometry: Track) -> bool:
    """Whether an Odometry edge connects two base frames of a robot, such as base_footprint.

    All frames in tf between these two frames must be base frames too.
    """
    above = model.above(odometry.child)
    parents = [track.parent for track in above]
    if odometry.parent not in parents:
        return odometry.parent == odometry.child
    between = {odometry.child, *parents[: parents.index(odometry.parent)]}
    return {last_part(name) for name in between} <= set(BASES)


def _no_such_transform(model: Model, odometry: Track, topic: str) -> Hit:
    above = model.parents.get(odometry.child)
    held = f"the parent {above.parent}" if above else "no parent"
    return hit_of(
        odometry,
        {
            "topic": topic,
            "differs": "and tf connect other frames:",
            "found": f"{topic} says {odometry.name}; in tf, {odometry.child} has {held}",
        },
        since=None,
        frames=odometry.edge,
        topics=odometry.topics,
        alone=True,
    )


def _base_below(model: Model, odometry: Track) -> Track | None:
    """Return the tf edge from the parent in an Odometry message to the robot's base.

    Return None if the message names another child frame, or if tf has no such edge. tf may have a
    prefix before the child frame of the message.
    """
    bases = [
        track
        for track in model.dynamic
        if track.parent == odometry.parent
        and last_part(track.child) in BASES
        and odometry.child in ("", last_part(track.child))
    ]
    return bases[0] if bases else None


def _delayed(track: Track, odometry: Track, topic: str, limits: Limits) -> Hit | None:
    """Return a hit if an edge in tf and Odometry have the same poses with a constant delay.

    The positions in Odometry are interpolated. Return None if no delay explains the difference.
    """
    told = odometry.sorted_stamps
    if len(told) < _FEWEST or len(odometry.topics) > 1:
        return None  # the poses of two topics, mixed, are no motion
    margin = seconds(limits["most"]) + _STEP
    inside = (track.sorted_stamps > told[0] + margin) & (track.sorted_stamps < told[-1] - margin)
    rows = np.flatnonzero(inside)
    if len(rows) < _FEWEST:
        return None
    rows = rows[:: len(rows) // _MOST_COMPARED + 1]
    stamps = track.sorted_stamps[rows]
    mine, theirs = (
        track.translations[track.by_stamp[rows]],
        odometry.translations[odometry.by_stamp],
    )

    def away(delay: int) -> Floats:
        columns = [np.interp(stamps - told[0] - delay, told - told[0], one) for one in theirs.T]
        return np.stack(columns, axis=1) - mine

    now = away(0)
    apart, scattered = _mean_length(now), _mean_length(now - now.mean(axis=0))
    if apart < limits["mean"]:
        return None
    delays = range(-margin, margin + _STEP, _STEP)
    rest, delay = min((_mean_length(away(one)), one) for one in delays)
    is_inner = seconds(limits["least"]) <= abs(delay) < margin
    if not is_inner or rest > min((1.0 - limits["removed"]) * apart, 0.5 * scattered):
        return None
    side = "later" if delay > 0 else "earlier"
    return Hit(
        edges=(track.edge,),
        topics=odometry.topics,
        publishers=track.nodes,
        since=int(track.logs.min()),
        count=len(track.stamps),
        facts={
            "topic": topic,
            "edge": track.name,
            "differs": "and tf have different stamps for",
            "apart": apart,
            "turned": 0.0,
            "delay": delay,
            "found": f"tf is {span(abs(delay))} {side} than the odometry: at equal times, the "
            f"positions are {metres(apart)} apart, and {metres(rest)} without this delay (means)",
        },
        fixes=(Fix("look at where the publishers of the two take their stamps from"),),
        alone=True,
    )


def _mean_length(vectors: Floats) -> float:
    return float(np.sqrt(np.einsum("ij,ij->i", vectors, vectors)).mean())


_STEP = seconds(0.005)
"""Difference between two delays that are compared, nanoseconds."""

_FEWEST = 20
"""Minimum number of samples, and of messages, from which a delay is computed."""

_MOST_COMPARED = 2000
"""Maximum number of samples of a transform that are compared."""


def _disagreement(
    track: Track, odometry: Track, topic: str, end: Stamp, limits: Limits
) -> "Hit | None":
    """Return a hit if an edge in tf and an Odometry topic often have different poses at one stamp.

    Args:
        track: The edge in tf.
        odometry: The poses in the Odometry messages.
        topic: Name of the Odometry topic.
        end: Log time after which Odometry messages are ignored.
        limits: The thresholds.

    Returns:
        The hit; None if few poses differ, or if no stamps are equal.
    """
    places = odometry.by_stamp[odometry.logs[odometry.by_stamp] <= end]
    _, mine, theirs = np.intersect1d(
        track.sorted_stamps, odometry.stamps[places], return_indices=True
    )
    if not len(mine):
        return None
    some, others = track.by_stamp[mine], places[theirs]
    away = track.translations[some] - odometry.translations[others]
    apart = np.sqrt(np.einsum("ij,ij->i", away, away))
    turned = angles_between(unit(track.rotations[some]), unit(odometry.rotations[others]))
    wrong = (apart > limits["metres"]) | (turned > np.radians(limits["degrees"]))
    count = int(np.count_nonzero(wrong))
    if count <= limits["share"] * len(wrong) or not odometry.child:
        return None
    return Hit(
        edges=(track.edge,),
        topics=odometry.topics,
        publishers=tuple(dict.fromkeys((*track.nodes, *odometry.nodes))),
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
        fixes=(Fix(f"look which nodes publish the two: `{{publishers}} {track.topics[0]}`"),),
        alone=True,
    )


def _mirrored(track: Track, odometry: Track, topic: str, limits: Limits) -> Hit | None:
    """Return a hit if poses in tf and in Odometry are equal except for the sign of y; else None.

    The stamps may differ: a pose is compared with the samples of tf that arrived before and after.
    """
    if not len(track.stamps):
        return None
    after = np.searchsorted(track.logs, odometry.logs)
    near = [np.clip(after + step, 0, len(track.logs) - 1) for step in (-1, 0)]
    own = np.arange(len(odometry.logs))
    aside = np.abs(odometry.translations[:, 1]) > limits["aside"]
    y = odometry.translations[:, 1]
    same, other = np.zeros(len(own), dtype=np.bool_), np.zeros(len(own), dtype=np.bool_)
    for rows in near:
        equal = aside & are_same(track, rows, odometry, own)
        away = np.abs(track.translations[rows] - odometry.translations)
        equal &= away[:, [0, 2]].max(axis=1) < ROUNDED
        opposite = y * track.translations[rows, 1] < 0.0
        same |= equal & ~opposite
        other |= equal & opposite
    poses = len(np.unique(odometry.translations[other], axis=0))
    if same.any() or poses < limits["poses"] or 2 * np.count_nonzero(other) < aside.sum():
        return None
    first, last = np.flatnonzero(other)[[0, -1]].tolist()
    # A robot with wheels moves in the direction of its x axis, not of its y axis.
    mine, theirs = _sideways(track), _sideways(odometry)
    wrong = track.name if mine > _PROVED * theirs else ""
    wrong = topic if theirs > _PROVED * mine else wrong
    right = {"": "", topic: "tf"}.get(wrong, topic)
    fits = f"; its motion fits its yaw only in {right}" if wrong else ""
    cure = f"look at the sign of y in the publisher of {wrong}"
    if not wrong:
        cure = "drive forward at a yaw of 90°: y must increase in tf and in the message"
    return Hit(
        edges=(track.edge,),
        topics=odometry.topics,
        publishers=tuple(dict.fromkeys((*track.nodes, *odometry.nodes))),
        since=int(odometry.logs[first]),
        count=int(np.count_nonzero(other)),
        facts={
            "topic": topic,
            "edge": track.name,
            "differs": "and tf have y of opposite signs for",
            "apart": 2.0 * float(np.median(np.abs(y[other]))),
            "turned": 0.0,
            "found": f"{np.count_nonzero(other)} of {np.count_nonzero(aside)} messages with |y| "
            f"above {metres(limits['aside'])}: x and rotation are equal; in the last one, y is "
            f"{metres(float(y[last]))}, and {metres(-float(y[last]))} in tf{fits}",
        },
        severity=Severity.WARNING,
        fixes=(Fix(cure),),
        alone=True,
    )


_PROVED = 3.0
"""Ratio of motions along the robot's y axis from which the larger one has the wrong sign of y."""


def _sideways(track: Track) -> float:
    """Return the root of the sum of squares of a robot's motions along its own y axis, metres."""
    turns = unit(track.rotations)
    moved = np.diff(track.translations, axis=0)
    # The mean of two near rotations; q and -q are the same rotation.
    signs = np.where(np.einsum("ij,ij->i", turns[1:], turns[:-1]) < 0.0, -1.0, 1.0)
    middle = unit(turns[1:] * signs[:, None] + turns[:-1])
    middle[:, :3] *= -1.0
    return float(np.linalg.norm(rotate(middle, moved)[:, 1]))


def _far_apart(track: Track, odometry: Track, topic: str, limits: Limits) -> Hit | None:
    """Return a hit if a robot's poses in tf and in Odometry are always far apart; else None.

    Far apart means farther than the threshold "far" plus the distance that the robot moved.
    """
    places = track.by_stamp
    near = np.searchsorted(track.sorted_stamps, odometry.stamps).clip(max=len(places) - 1)
    some = places[near]
    is_near = np.abs(track.stamps[some] - odometry.stamps) < limits["near"] * NANOSECONDS
    if np.count_nonzero(is_near) < 3:
        return None
    some, others = some[is_near], np.flatnonzero(is_near)
    away = track.translations[some] - odometry.translations[others]
    apart = np.sqrt(np.einsum("ij,ij->i", away, away))
    moved = max(
        float(np.ptp(one, axis=0).max())
        for one in (odometry.translations, track.translations[some])
    )
    if not apart.min() > limits["far"] + moved:
        return None
    axis = int(np.abs(away).mean(axis=0).argmax())
    mine, theirs = track.translations[some[0], axis], odometry.translations[others[0], axis]
    # Of several publishers, those whose samples are near in time.
    named = dict(zip(np.unique(track.senders).tolist(), track.publishers, strict=True))
    nodes = {named[number].node for number in np.unique(track.senders[some]).tolist()}
    sender = f"the publisher of {track.name}"
    if all(nodes) and len(track.nodes) > 1:
        sender = f"{several(sorted(nodes))}, which sends {track.name},"
    return Hit(
        edges=(track.edge,),
        topics=odometry.topics,
        publishers=tuple(dict.fromkeys((*track.nodes, *odometry.nodes))),
        since=int(odometry.logs[others[0]]),
        count=len(others),
        facts={
            "topic": topic,
            "edge": track.name,
            "differs": "and tf have positions far apart for",
            "apart": float(np.median(apart)),
            "turned": 0.0,
            "found": f"{metres(float(np.median(apart)))} apart (median of {len(others):,}); "
            f"{'xyz'[axis]} of the first is {metres(float(mine))} in tf, {metres(float(theirs))} "
            "in the message",
        },
        severity=Severity.WARNING,
        fixes=(Fix(f"look at what {sender} uses for {'xyz'[axis]}"),),
        alone=True,
    )


@check(
    "negative-variance",
    Severity.WARNING,
    rule="a variance of the position or rotation in an Odometry message is negative. Not reported "
    "for -1, which some drivers send if the variance is unknown",
    headline="{where} {concerned:has|have} negative variances",
    detail="{topic}: {count} of {of} messages, {least:.3g} at least",
    consequence="a variance cannot be negative: a filter that uses these messages may diverge",
    fixes=(Fix("look at how its publisher computes the covariance: `{publishers} {topic}`"),),
    needs=("odometry",),
)
def negative_variance(model: Model, limits: Limits) -> Iterator[Hit]:
    """An odometry message has a negative variance."""
    for topic, (count, of, least) in model.evidence.negative.items():
        facts = {"topic": topic, "count": count, "of": of, "least": least}
        yield Hit(topics=(topic,), count=count, facts=facts)


@check(
    "repeated-pose",
    Severity.NOTE,
    rule="while a robot moves, a share of {share:g} or more of the samples of its odometry, or "
    "{placed:g} or more of its pose in map or world, repeats the previous pose with a new stamp, "
    "among {samples:g} changes of the pose or more. A warning if the median change is {metres:g} m "
    "or {degrees:g}° or more",
    headline="{where} {concerned:moves|move} in steps: while the robot moves, {repeated:%} of the "
    "samples repeat the previous pose",
    detail="{edge}: {moved:,} new poses in {samples:,} samples; by the stamps, a new pose every "
    "{every:span}, {jump:m} and {turn:deg} further (medians; 5 % turn by {far:deg} or more)",
    consequence="between two samples, the robot seems to stand or to move too fast: sensor data is "
    "placed up to one step off",
    causes=("a node that sends its last measurement at a higher rate than that of the sensor",),
    fixes=(
        Fix("check how often its publisher gets a new pose, and stamp a pose when it was measured"),
    ),
    limits={"share": 0.6, "placed": 0.45, "samples": 20, "metres": 0.01, "degrees": 2.0},
    because_of=(("edge", "frozen-stamp repeated-stamp publisher-conflict"),),
)
def repeated_pose(model: Model, limits: Limits) -> Iterator[Hit]:
    """Odometry repeats its poses with new stamps."""
    for track in model.dynamic:
        if len(track.by_stamp) < 2 or not _is_pose_of_robot(model, track):
            continue
        is_new = np.append(True, np.diff(track.sorted_stamps) > 0)
        places, stamps = track.by_stamp[is_new], track.sorted_stamps[is_new]
        turned = track.turned(places[1:], places[:-1])
        strides = track.apart(places[1:], places[:-1])
        changes = np.flatnonzero((strides > 1e-6) | (turned > 1e-6))
        if len(changes) <= limits["samples"]:
            continue
        # The period of the samples says nothing: two streams of a transform may alternate.
        between = np.diff(stamps[changes + 1])
        every = int(median(between))
        moving = between <= min(3 * every, _STANDS)
        new, samples = int(np.count_nonzero(moving)), int(np.diff(changes)[moving].sum())
        least = limits["share" if track.is_odometry else "placed"]
        if new < limits["samples"] or 1.0 - new / samples < least:
            continue
        changes = changes[1:][moving]
        far, wide = float(np.median(strides[changes])), float(np.median(turned[changes]))
        is_coarse = far > limits["metres"] or wide > np.radians(limits["degrees"])
        facts = {
            "repeated": 1.0 - new / samples,
            "moved": new,
            "samples": samples,
            "period": track.period,
            "every": int(median(between[moving])),
            "jump": far,
            "turn": wide,
            "far": percentile(turned[changes], 95),
        }
        yield hit_of(track, facts, severity=Severity.WARNING if is_coarse else None)


def _is_pose_of_robot(model: Model, track: Track) -> bool:
    """Whether an edge is odometry, or a robot's pose in a world frame, for example by a tracker."""
    if last_part(track.parent).startswith("odom"):
        return last_part(track.child) in BASES
    is_placed = is_world(track.parent) and not track.is_localisation
    return is_placed and not is_detection(model, track)


_STANDS = seconds(0.5)
"""Time, nanoseconds, without a new pose after which a robot stands."""


@check(
    "odometry-cancelled",
    Severity.WARNING,
    rule="in the odometry, a robot moves more than {metres:g} m away from its median position. In "
    "the map, a localiser that changes map to odom keeps the robot within a share of "
    "{share:g} of this distance, for 90 % of the time",
    headline="{child} stays within {stays:m} in {map}, although it goes {drives:m} in {odom}",
    detail="{edge} changes in the opposite direction of the odometry; {child} is that close to its "
    "median position for 90 % of the time",
    consequence="either the odometry or the pose in the map is wrong",
    fixes=(
        Fix(
            "check whether the robot drove; if so, which pose the localiser computes, and from what"
        ),
    ),
    limits={"metres": 1.5, "share": 0.05},
)
def odometry_cancelled(model: Model, limits: Limits) -> Iterator[Hit]:
    """A localiser cancels the motion that the odometry measures."""
    for track in model.dynamic:
        # A constant transform from map to odom cancels nothing.
        for below in model.dynamic if track.is_localisation and track.moves else ():
            if below.parent != track.child or last_part(below.child) not in BASES:
                continue
            if len(below.publishers) > 1:
                continue  # the distance between two sources is no motion
            newest = np.searchsorted(track.sorted_stamps, below.sorted_stamps, side="right") - 1
            known = newest >= 0
            rows = track.by_stamp[newest[known]]
            in_odom = below.translations[below.by_stamp[known]]
            in_map = track.translations[rows] + rotate(unit(track.rotations[rows]), in_odom)
            drives, stays = _reach(in_odom, 100), _reach(in_map, 90)
            if drives > limits["metres"] and stays < limits["share"] * drives:
                facts = {"child": below.child, "map": track.parent, "odom": below.parent}
                yield hit_of(track, {**facts, "stays": stays, "drives": drives}, alone=True)


@check(
    "odometry-corrected",
    Severity.NOTE,
    rule="later than {warm:g} s after its first sample, a localiser turns odometry in the map by "
    "{degrees:g}° or more in one direction (80 % of all its turns), in {samples:g} corrections or "
    "more. This is a share of {share:g} or more of all turns of the robot in the odometry. A "
    "warning for {far:g}° or more; then a share of {far_share:g} is enough",
    headline="{edge} turns by {net:deg} in one direction, while {child} turns by {all:deg} in "
    "{odom}",
    detail="{edge}: {count} corrections, in {length:span}; the turns of {child} are added up "
    "without sign",
    consequence="the rotation in the odometry, or the pose in the map, is wrong",
    fixes=(Fix("turn the robot by a known angle, and compare the odometry with it"),),
    limits={
        "warm": 2.0,
        "degrees": 30.0,
        "samples": 10,
        "share": 0.3,
        "far": 180.0,
        "far_share": 0.15,
    },
    because_of=(("edge", "publisher-conflict clock-offset odometry-cancelled teleport"),),
)
def odometry_corrected(model: Model, limits: Limits) -> Iterator[Hit]:
    """A localiser turns the odometry in one direction."""
    for track in model.dynamic:
        for below in model.dynamic if track.is_localisation and track.moves else ():
            if below.parent != track.child or last_part(below.child) not in BASES:
                continue
            if len(below.publishers) > 1 or not len(track.by_stamp):
                continue
            begin = track.sorted_stamps[0] + int(limits["warm"] * NANOSECONDS)
            rows = track.by_stamp[track.sorted_stamps >= begin]
            steps = _yaw_steps(track, rows)
            number = int(np.count_nonzero(np.abs(steps) > _CORRECTS))
            net = abs(float(steps.sum()))
            every = float(np.abs(_yaw_steps(below, below.by_stamp)).sum())
            total = float(np.abs(steps).sum())
            is_sure = net >= np.radians(limits["far"])
            share = limits["far_share" if is_sure else "share"]
            is_far = net >= np.radians(limits["degrees"]) and net >= share * every
            # With steps in both directions, a pose that is uncertain comes and goes.
            if number >= limits["samples"] and is_far and net > 0.8 * total:
                facts = {"net": net, "all": every, "child": below.child, "odom": below.parent}
                length = int(np.ptp(track.stamps[rows]))
                yield hit_of(
                    track,
                    {**facts, "count": number, "length": length},
                    count=number,
                    alone=True,
                    severity=Severity.WARNING if is_sure else None,
                )


_CORRECTS = 1e-3
"""Minimum turn of a correction, radians."""


def _yaw_steps(track: Track, rows: Places) -> Floats:
    """Return the turns about z between consecutive samples, radians, shape (n - 1,)."""
    x, y, z, w = unit(track.rotations[rows]).T
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    steps: Floats = (np.diff(yaw) + np.pi) % (2.0 * np.pi) - np.pi
    return steps


def _reach(positions: Floats, percent: float) -> float:
    """Return a percentile of the distances from the median position, metres.

    Args:
        positions: Positions, metres, shape (n, 3); without positions, the result is 0.0.
        percent: The percentile, 0 to 100.
    """
    if not len(positions):
        return 0.0
    away = np.linalg.norm(positions - np.median(positions, axis=0), axis=1)
    return percentile(away, percent)
