"""Checks of publishers: several parents or publishers of a frame, and empty messages."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.doctor.check import checks_of, threads
from tftool.doctor.conflicts import (
    fed_twice,
    find_publishers,
    follows,
    is_corrected,
    is_revolute,
    named_conflict,
    severity_of,
    unnamed_conflict,
    values_at_one_stamp,
    with_doubled,
    with_senders,
)
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.pose_checks import with_placeholders
from tftool.doctor.stamp_stream import JOINT_STATES, Track, rate

check = checks_of(Area.PUBLISHERS)


@check(
    "two-parents",
    Severity.ERROR,
    rule="a frame has two parents among the statics, or changes its parent more than {switches:g} "
    "times and keeps each parent for less than {stay:g} s on average. A warning if both "
    "parents are below one root",
    headline="{child} changes between the parents {parents}",
    detail="{sources}; changes {switches:times}, first at {first:moment}",
    consequence="a lookup of {lost} goes through the parent that was sent last before its time; a "
    "lookup that needs the other parent {so}",
    causes=(
        "visual odometry or SLAM publishes odom to base_link beside the robot description",
        "a driver's base frame is a link below the root",
        "a calibration is published with parent and child exchanged",
    ),
    links=threads(
        "stereolabs/zed-ros-wrapper#447",
        "TixiaoShan/LIO-SAM#519",
        "kobuki-base/kobuki_ros#49",
        "introlab/rtabmap_ros#822",
    ),
    limits={"switches": 4, "stay": 1.0},
    why="a hand-over changes the parent once; two competing publishers change the parent at the "
    "rate of their messages",
)
def two_parents(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame changes between two parents."""
    for child, tracks in by_child(model.dynamic).items():
        switches, stay, first = _switching(tracks)
        if switches > limits["switches"] and stay < limits["stay"]:
            yield _fight(model, child, tracks, switches, first)
    for child, tracks in by_child(model.statics).items():
        yield _fight(model, child, tracks, len(tracks) - 1, int(tracks[1].logs[0]))


def _fight(model: Model, child: str, tracks: Sequence[Track], switches: int, first: int) -> Hit:
    roots = [_root(model, track.parent, child) for track in tracks]
    return Hit(
        edges=tuple(track.edge for track in tracks),
        frames=(child,),
        publishers=tuple(sorted({node for track in tracks for node in track.nodes})),
        since=first,
        count=switches,
        facts={
            "child": child,
            "parents": [track.parent for track in tracks],
            "first": first,
            "sources": [_source(track) for track in tracks],
            "switches": switches,
            "lost": sorted(model.below(child)),
            "root": roots[0] if roots[0] != child else tracks[0].parent,
            "so": "fails meanwhile"
            if len(set(roots)) > 1
            else "gets another path, and perhaps another pose",
        },
        severity=None if len(set(roots)) > 1 else Severity.WARNING,
        fixes=(find_publishers(tracks),),
        alone=True,
    )


@check(
    "publisher-conflict",
    Severity.ERROR,
    rule="two publishers with at least {least:g} samples each send a transform at the same time, "
    "and their values differ by more than {metres:g} m (or {degrees:g}°) plus the usual step "
    "between two samples. If each publisher has one pose, {mounts:g} m (or {mount_degrees:g}°) "
    "are enough. If the publishers are unknown, one of two patterns counts. First, {stamps:g} "
    "stamps or more have two values that differ so much, and one of the values interrupts the "
    "motion of the other. Second, the samples alternate between two tracks; a sample belongs to a "
    "track within {reach:g} m + {speed:g} m/s, where a radian counts as half a metre. Each track "
    "needs {samples:g} samples and a share of {share:g}, the track must change {changes:g} times "
    "or more, and one motion at constant velocity must fit all samples {worse:g} times worse than "
    "two motions fit the two tracks. Tracks of a frame that hardly moves may be nearer: half of "
    "the steps and {near_changes:g} or more are {near:g} m or longer, each track has a share of "
    "{near_share:g}, and the tracks are {near_times:g} times as far apart as 95 % of the steps in "
    "them. If samples jump {near_changes:g} times or more, each time within 1 s of the last jump, "
    "and come at 1.5 times the usual rate meanwhile, this time is also judged alone. A conflict of "
    "the edge above is part of the finding if both edges together move a tenth as far. A note for "
    "one of three or more objects of one publisher that come and go, and for a frame that only "
    "turns, unless one value returns again and again. A warning if the publishers are unknown, if "
    "no frame is below this frame and no message is in it, or for a mount whose two values differ "
    "by less than {slight:g} m and {slight_degrees:g}°",
    headline="{named} {many:has|have} two {two:sources with |}different values{seen}",
    detail="{edge}: {first} and {second}, {told}, {apart:m} and {turned:deg} apart (median), "
    "{worst:m} and {most_turned:deg} at most{also}",
    consequence="{so}",
    causes=(
        "joint_state_publisher sends zeros beside the real source of joint states",
        "a controller or simulator plug-in and a filter publish the odometry",
        "two localisers, or a recorded map to odom replayed beside a live one",
        "two drivers, or two robot_state_publishers",
    ),
    links=threads(
        "ros-simulation/gazebo_ros_pkgs#692",
        "ros-controls/ros_controllers#118",
        "introlab/rtabmap_ros#645",
        "iRobotEducation/create3_docs#144",
        "abizovnuralem/go2_ros2_sdk#28",
    ),
    limits={
        "least": 3,
        "metres": 0.01,
        "degrees": 1.0,
        "reach": 0.05,
        "speed": 3.0,
        "samples": 5,
        "stamps": 2,
        "share": 0.1,
        "changes": 6,
        "worse": 2.0,
        "slight": 0.05,
        "slight_degrees": 2.0,
        "near": 0.005,
        "near_changes": 20,
        "near_share": 0.4,
        "near_times": 5.0,
        "mounts": 0.0005,
        "mount_degrees": 0.06,
    },
    why="a moving frame continues from its last pose, while the values of two publishers "
    "alternate. The speed limit separates two publishers from fast robots and "
    "relocalisations. A fast wheel turns by a large but constant angle between two samples",
)
def publisher_conflict(model: Model, limits: Limits) -> Iterator[Hit]:
    """Two sources publish the same transform with different values."""
    told_of: dict[tuple[str, str], Hit] = {}
    apart: list[Track] = []
    invalid = {track.edge for tracks in with_placeholders(model) for track in tracks}
    for track in model.dynamic:
        if track.edge in invalid:
            continue
        hit = named_conflict(model, track, limits) if model.has_named_publishers else None
        hit = hit or values_at_one_stamp(track, limits)
        is_open = hit is None or hit.confidence is Confidence.POSSIBLE
        if is_open and not is_corrected(track, limits):
            hit = unnamed_conflict(track, limits) or hit
        if hit is None:
            continue
        fed = fed_twice(track, hit, limits)
        if fed is None and is_revolute(track) and hit.confidence is not Confidence.CERTAIN:
            # A fast wheel looks the same if it turns more than once between two samples.
            hit = None if _has_one_source(model) else replace(hit, confidence=Confidence.POSSIBLE)
        hit = fed or hit
        if hit is None:
            continue
        if hit.confidence is not Confidence.CERTAIN:
            hit = with_senders(model, track, hit)
        hit = replace(hit, severity=severity_of(model, track, hit, limits))
        # Edges in the same messages have the same publishing nodes.
        like = (t for t in apart if np.isin(track.messages, t.messages).mean() > 0.5)
        sent_with = next(like, track)
        if sent_with is track:
            apart.append(track)
        group = f"{sent_with.name} {hit.facts['first']}"
        if (
            hit.confidence is not Confidence.CERTAIN
            and len(track.publishers) == len(track.nodes) == 1
        ):
            group = f"{track.parent} {track.nodes[0]}"
        told_of[track.edge] = replace(with_doubled(model, track, hit), alone=False, group=group)
    told_of = _folded(_without_followers(told_of, model.dynamic))
    odometry = model.evidence.odometry
    for told in () if odometry is None else [Track(edge, odometry) for edge in odometry.edges]:
        told.arrivals = told.logs
        # Odometry of two topics may differ: wheels and a filter.
        hit = values_at_one_stamp(told, limits) if len(told.topics) == 1 else None
        if hit is None:
            continue
        if told.edge in told_of:  # one cause: the node that sends both
            first = told_of[told.edge]
            also = f"{first.facts['told']} (and on {told.topics[0]})"
            hit = replace(first, topics=told.topics, facts={**first.facts, "told": also})
        else:
            seen = f" at one stamp, on {told.topics[0]}"
            hit = replace(hit, topics=told.topics, facts={**hit.facts, "seen": seen})
        told_of[told.edge] = hit
    yield from told_of.values()


def _without_followers(
    conflicts: dict[tuple[str, str], Hit], tracks: Sequence[Track]
) -> dict[tuple[str, str], Hit]:
    """Merge a conflict that only makes up for a conflict of the edge below into the latter.

    A localiser computes map to odom from odom to base_link; if the latter alternates, both do.
    """
    by_edge = {track.edge: track for track in tracks}
    kept = dict(conflicts)
    for upper in conflicts:
        for lower, cause in list(kept.items()):
            if lower[0] == upper[1] and follows(by_edge[upper], by_edge[lower]):
                also = (
                    f"{cause.facts['also']}; {by_edge[upper].name} makes up for it, and jumps too"
                )
                edges = (*cause.edges, upper)
                kept[lower] = replace(cause, edges=edges, facts={**cause.facts, "also": also})
                kept.pop(upper, None)
    return kept


def _folded(conflicts: dict[tuple[str, str], Hit]) -> dict[tuple[str, str], Hit]:
    """Merge each conflict into the conflict that causes it; other conflicts do not change.

    If a node computes a transform from a transform with two publishers, both transforms alternate.

    Args:
        conflicts: Conflicts by edge.
    """
    sure = {edge[0]: hit for edge, hit in conflicts.items() if hit.confidence is Confidence.CERTAIN}
    kept = {}
    for edge, hit in conflicts.items():
        cause = sure.get(edge[0])
        if cause is None or cause is hit or len(hit.publishers) != 1:
            kept[edge] = hit
            continue
        also = f"{cause.facts['told']}; {hit.facts['edge']}, which {hit.publishers[0]} sends, "
        first = next(iter(cause.edges))
        kept[first] = replace(cause, facts={**cause.facts, "told": f"{also}follows"})
    return kept


def _has_one_source(model: Model) -> bool:
    """Whether a single node, whose name is known, sends all joint states."""
    topics = {one.topic for one in model.evidence.headers.values() if one.type == JOINT_STATES}
    nodes = [one.node for one in model.evidence.publishers if one.topic in topics]
    return len(nodes) == 1 and bool(nodes[0])


@check(
    "parent-switch",
    Severity.NOTE,
    rule="a frame changes its parent at most {switches:g} times, or keeps each for {stay:g} "
    "s or more",
    headline="{child} changed its parent: {parents}",
    detail="{child}: {switches:times}",
    consequence="normal for an object that was picked up, but not for a mount",
    causes=("an object that was picked up",),
    limits={"switches": 4, "stay": 1.0},
    because_of=(
        ("child", "publisher-conflict two-parents"),
        ("child", "static-and-dynamic"),
    ),
)
def parent_switch(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame got a new parent once."""
    for child, tracks in by_child(model.dynamic).items():
        switches, stay, first = _switching(tracks)
        if 0 < switches <= limits["switches"] or stay >= limits["stay"]:
            yield Hit(
                edges=tuple(track.edge for track in tracks),
                frames=(child,),
                since=first,
                count=switches,
                facts={
                    "child": child,
                    "parents": [track.parent for track in tracks],
                    "switches": switches,
                },
            )


def by_child(tracks: Sequence[Track], least: int = 2) -> dict[str, list[Track]]:
    """Return the edges to each child frame with at least `least` parents, by the child's name."""
    grouped: dict[str, list[Track]] = defaultdict(list)
    for track in tracks:
        if len(track.by_stamp):
            grouped[track.child].append(track)
    return {child: edges for child, edges in grouped.items() if len(edges) >= least}


def _switching(tracks: Sequence[Track]) -> tuple[int, float, int]:
    """Count the changes of a frame's parent.

    Args:
        tracks: The edges from the parents to the frame.

    Returns:
        Number of changes, mean time between them in seconds, and log time of the first change in
        nanoseconds (0 without a change).
    """
    stamps = np.concatenate([track.sorted_stamps for track in tracks])
    logs = np.concatenate([track.logs[track.by_stamp] for track in tracks])
    owner = np.repeat(np.arange(len(tracks)), [len(track.by_stamp) for track in tracks])
    order = np.argsort(stamps, kind="stable")
    turns = np.flatnonzero(np.diff(owner[order]))
    span = float(stamps[order[-1]] - stamps[order[0]]) / NANOSECONDS
    first = int(logs[order][turns[0] + 1]) if len(turns) else 0
    return len(turns), span / (len(turns) + 1), first


def _root(model: Model, frame: str, stop: str) -> str:
    """Return the topmost ancestor of a frame, without the ancestor `stop` and those above it."""
    for track in model.above(frame):
        if track.parent == stop:
            break
        frame = track.parent
    return frame


def _source(track: Track) -> str:
    by = f" by {', '.join(track.nodes)}" if track.nodes else ""
    return f"{track.name} at {rate(track):.3g} Hz{by}"


@check(
    "empty-message",
    Severity.NOTE,
    rule="a publisher sends {times:g} messages or more without a transform, which are a share of "
    "{share:g} or more of its messages. A warning if all its messages are empty, except for a "
    "state publisher",
    headline="{topic} has {empty} messages without a transform",
    detail="{topic}: {told} messages{sender}",
    consequence="frames that its publisher does not see are {missing:not in the recording|not "
    "updated meanwhile}",
    causes=("a motion capture system or a detector does not see its objects",),
    limits={"times": 10, "share": 0.1},
    needs=("log times",),
)
def empty_message(model: Model, limits: Limits) -> Iterator[Hit]:
    """A publisher sends messages without a transform."""
    transforms = model.evidence.transforms
    within = (transforms.log_times >= model.start) & (transforms.log_times <= model.end)
    empty = within & model.empty_messages
    for number, publisher in enumerate(transforms.publishers):
        own = transforms.senders == number
        of, without = int(np.count_nonzero(own & within)), int(np.count_nonzero(own & empty))
        if without >= max(1.0, limits["times"], limits["share"] * of):
            sender = f" of {publisher.node}" if publisher.node else ""
            # A state publisher without a moving joint has nothing to send.
            is_blind = without == of and "state_publisher" not in publisher.node
            yield Hit(
                topics=(publisher.topic,),
                publishers=(publisher.node,) if publisher.node else (),
                severity=Severity.WARNING if is_blind else None,
                fixes=(Fix("check whether its publisher saw an object at all"),)
                if is_blind
                else (),
                since=int(transforms.log_times[own & empty].min()),
                until=int(transforms.log_times[own & empty].max()),
                count=without,
                facts={
                    "topic": publisher.topic,
                    "empty": without,
                    "of": of,
                    "told": f"all {of:,}" if without == of else f"{without:,} of {of:,}",
                    "missing": 1 if without == of else 0,
                    "sender": sender,
                },
                alone=True,
            )
