"""Checks of odometry messages against the transforms of the same frames, and of their variances."""

from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import BASES, Track, last_part
from tftool.doctor.wording import metres
from tftool.geometry.rigid_arrays import angles_between, unit

check = checks_of(Area.VALUES)


@check(
    "odometry-tf-mismatch",
    Severity.NOTE,
    rule="an Odometry message and the transform of the same two frames and the same stamp "
    "differ by more than {metres:g} m or {degrees:g}°, in a share above {share:g} of "
    "such pairs, or tf has no transform of these frames. A warning if "
    "positions within {near:g} s, of any source, differ by more than {far:g} m and more than the "
    "robot moved",
    headline="{topic} {differs} {edge}",
    detail="{found}",
    consequence="programs that use the message and programs that use tf may see the robot in "
    "different places",
    causes=(
        "the message is the wheels', the transform a filter's",
        "the filter's publish_tf is off and another node sends the transform",
    ),
    limits={"metres": 0.05, "degrees": 2.0, "share": 0.5, "near": 0.5, "far": 10.0},
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
            hit = hit or _disagreement(track, told, topic, model.end, limits)
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
        alone=True,
    )


def _base_below(model: Model, told: Track) -> Track | None:
    """Return the edge from odometry's parent to the base, if the odometry names no child frame."""
    bases = [
        track
        for track in model.dynamic
        if track.parent == told.parent and last_part(track.child) in BASES and not told.child
    ]
    return bases[0] if bases else None


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
    if count <= limits["share"] * len(wrong) or not told.child:
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
        fixes=(Fix(f"look which nodes publish the two: `{{publishers}} {track.topics[0]}`"),),
        alone=True,
    )


def _far_apart(track: Track, told: Track, topic: str, limits: Limits) -> Hit | None:
    """Return a hit if tf and a message place the robot far apart, whatever the sources."""
    places = track.by_stamp
    near = np.searchsorted(track.sorted_stamps, told.stamps).clip(max=len(places) - 1)
    some = places[near]
    is_near = np.abs(track.stamps[some] - told.stamps) < limits["near"] * NANOSECONDS
    if np.count_nonzero(is_near) < 3:
        return None
    some, others = some[is_near], np.flatnonzero(is_near)
    away = track.translations[some] - told.translations[others]
    apart = np.sqrt(np.einsum("ij,ij->i", away, away))
    moved = max(
        float(np.ptp(one, axis=0).max()) for one in (told.translations, track.translations[some])
    )
    if not apart.min() > limits["far"] + moved:
        return None
    axis = int(np.abs(away).mean(axis=0).argmax())
    mine, theirs = track.translations[some[0], axis], told.translations[others[0], axis]
    return Hit(
        edges=(track.edge,),
        topics=told.topics,
        publishers=tuple(dict.fromkeys((*track.nodes, *told.nodes))),
        since=int(told.logs[others[0]]),
        count=len(others),
        facts={
            "topic": topic,
            "edge": track.name,
            "differs": "and tf are far apart about",
            "apart": float(np.median(apart)),
            "turned": 0.0,
            "found": f"{metres(float(np.median(apart)))} apart (median of {len(others):,}); "
            f"{'xyz'[axis]} is first {metres(float(mine))} in tf, {metres(float(theirs))} there",
        },
        severity=Severity.WARNING,
        fixes=(Fix(f"look at what the publisher of {track.name} uses for {'xyz'[axis]}"),),
        alone=True,
    )


@check(
    "negative-variance",
    Severity.WARNING,
    rule="a variance of the position or rotation in an Odometry message is negative, and not -1, "
    "which some drivers send for an unknown one",
    headline="{where} {concerned:has|have} negative variances",
    detail="{topic}: {count} of {of} messages, {least:.3g} at least",
    consequence="no variance is negative: a filter that uses these messages may diverge",
    fixes=(Fix("look at how its publisher computes the covariance: `{publishers} {topic}`"),),
    needs=("odometry",),
)
def negative_variance(model: Model, limits: Limits) -> Iterator[Hit]:
    """An odometry message has a negative variance."""
    for topic, (count, of, least) in model.evidence.negative.items():
        facts = {"topic": topic, "count": count, "of": of, "least": least}
        yield Hit(topics=(topic,), count=count, facts=facts)
