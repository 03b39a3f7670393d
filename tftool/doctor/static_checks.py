"""Checks of static transforms: static and moving, changed, or constant although sent as moving."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from tftool.base.plain_text import count
from tftool.base.stamps import NANOSECONDS, as_seconds
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.conflicts import find_publishers
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.missing_joins import ends_at_the_root
from tftool.doctor.model import Limits, Model
from tftool.doctor.publisher_checks import by_child
from tftool.doctor.stamp_stream import JOINT_STATES, Track, family, rate
from tftool.doctor.wording import is_ros1, metres, several, span

check = checks_of(Area.PUBLISHERS)


@check(
    "static-and-dynamic",
    Severity.ERROR,
    rule="a frame is the child of a static transform and of a moving transform. A warning if the "
    "kind changes once, if no sensor message is in the frame or below it, and in ROS 1, which "
    "keeps the first kind",
    headline="{named} {many:is|are} sent on /tf and on /tf_static",
    detail="{moving}; {static}{apart}{changes}",
    consequence="{so}",
    causes=(
        "SLAM beside the robot description, with other parents",
        "an old tf static publisher beside a new one",
        "the default of use_tf_static changed between two versions",
    ),
    links=threads("TixiaoShan/LIO-SAM#521"),
)
def static_and_dynamic(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame is sent on /tf and on /tf_static, and its history is cleared each time."""
    moving = by_child(model.dynamic, least=1)
    for child, statics in by_child(model.statics, least=1).items():
        if child not in moving:
            continue
        tracks = [*moving[child], *statics]
        kinds = np.concatenate([np.full(len(t.logs), t.static) for t in tracks])
        logs = np.concatenate([t.logs for t in tracks])
        order = np.argsort(logs, kind="stable")
        turns = np.flatnonzero(np.diff(kinds[order].astype(np.int8)))
        bounds = np.concatenate((logs[order][:1], logs[order][turns + 1], logs[order][-1:]))
        # Each static clears the buffer, so only the stamps between two statics are kept.
        starts = np.concatenate(([0], turns + 1))
        stamps = np.concatenate([t.stamps for t in tracks])[order]
        kept = np.maximum.reduceat(stamps, starts) - np.minimum.reduceat(stamps, starts)
        history = int(kept[~kinds[order][starts]].max(initial=0))
        is_one_edge = len({track.edge for track in tracks}) == 1
        fix = ends_at_the_root(model, moving[child], statics)
        if fix is None:
            fix = find_publishers(tracks)
        if is_one_edge and any(track.moves for track in moving[child]):
            fix = Fix(f"{child} moves on /tf, which a static transform cannot follow: {fix.text}")
        is_mild = len(turns) < 2 or is_ros1(model.evidence) or not model.has_sensor(child)
        so = _mixed_kinds(model, child, tracks, len(turns))
        yield Hit(
            edges=tuple(dict.fromkeys(track.edge for track in tracks)),
            frames=(child,),
            publishers=tuple(sorted({node for track in tracks for node in track.nodes})),
            since=int(bounds[1]) if len(turns) else int(bounds[0]),
            count=len(turns),
            facts={
                "child": child,
                "named": child,
                "moving": [f"{t.name} on {', '.join(t.topics)}" for t in moving[child]],
                "static": [f"{t.name} on {', '.join(t.topics)}" for t in statics],
                "turns": len(turns),
                "history": history,
                "changes": _changes(model, len(turns), history),
                "apart": _two_mounts(moving[child][0], statics[0]) if is_one_edge else "",
                "so": so,
            },
            severity=Severity.WARNING if is_mild else None,
            fixes=(fix,),
            group=f"{so} {fix.line}",
        )


def _two_mounts(track: Track, static: Track) -> str:
    """Return the different poses of two constant transforms of one edge, as a clause."""
    if track.moves:
        return ""
    poses = [one.translations[-1] for one in (track, static)]
    apart = float(np.linalg.norm(poses[0] - poses[1]))
    if apart <= _SAME_MOUNT:
        return ", with equal translations"
    moving, fixed = (" ".join(f"{n:.4g}" for n in pose) for pose in poses)
    return f", with poses {metres(apart)} apart: moving {moving}, static {fixed}"


_SAME_MOUNT = 5e-4
"""Maximum distance between two values of one mount, metres."""


def _changes(model: Model, turns: int, history: int) -> str:
    """Return a clause about changes between static and moving; empty in ROS 1, which ignores them.

    Args:
        model: Model of the evidence.
        turns: Number of changes.
        history: Longest span of stamps between two statics, nanoseconds.
    """
    if is_ros1(model.evidence):
        return ""
    if turns == 1:
        return "; the kind changes once"
    kept = f"at most {span(history)} of history are kept" if history else "no history is kept"
    return f"; the kind changes {turns} times, {kept}"


def _mixed_kinds(model: Model, child: str, tracks: Sequence[Track], turns: int) -> str:
    """Return the consequence of a frame that is sent as static and as moving.

    Args:
        model: Model of the evidence.
        child: The frame.
        tracks: All transforms of the frame.
        turns: Number of changes of kind.
    """
    if not is_ros1(model.evidence):
        last = max(tracks, key=lambda track: int(track.logs.max()))
        lost = [track.parent for track in tracks if track.parent != last.parent]
        if turns == 1 and lost:
            return (
                f"after the change {child} has only the parent {last.parent}: lookups through "
                f"{several(lost)} fail"
            )
        if turns == 1 and last.static:
            return f"after the change every lookup of {child} gets the static pose, at any time"
        if turns == 1:
            return (
                f"the change clears the history of {child}: later lookups of the time before fail"
            )
        return "each change of kind clears the history of the frame: lookups in the past fail"
    first = model.first_of(child)
    at = f"{as_seconds(int(first.logs[0]) - model.start):.2f} s"
    kind = "static" if first.static else "moving"
    so = (
        f"every lookup of {child} gets the newest pose, whatever its time"
        if first.static
        else f"the static pose of {child} counts as one sample, which expires"
    )
    return f"tf2 of ROS 1 keeps the kind that reaches it first, here the {kind} one (at {at}): {so}"


@check(
    "dynamic-on-static",
    Severity.WARNING,
    rule="a static has {values:g} different values or more (apart by {metres:g} m or "
    "{radians:g} rad). A note if all are within {slight:g} m and {slight_turn:g} rad",
    headline="{where} {concerned:moves, and is|move, and are} published as static",
    detail="{edge}: {values} values, up to {moved:m} and {turned:deg} apart",
    consequence="statics have no history: every lookup in the past returns the newest value, "
    "without an error",
    fixes=(Fix("find its publisher: `{publishers} /tf_static`"),),
    causes=("a calibration or a detector publishes its result with a static broadcaster",),
    limits={"values": 4, "metres": 1e-6, "radians": 1e-4, "slight": 5e-4, "slight_turn": 1e-3},
    why="a recalibration changes the value of a static once or twice",
)
def dynamic_on_static(model: Model, limits: Limits) -> Iterator[Hit]:
    """A moving frame is published as static."""
    for values, moved, turned, hit in _values_of_statics(model, limits):
        if values >= limits["values"]:
            is_slight = moved <= limits["slight"] and turned <= limits["slight_turn"]
            yield replace(hit, severity=Severity.NOTE) if is_slight else hit


@check(
    "static-changed",
    Severity.WARNING,
    rule="a static has 2 to {values:g} different values (apart by {metres:g} m or {radians:g} rad)",
    headline="{where} {concerned:was|were} published again with another value",
    detail="{edge}: {values} values, {moved:m} and {turned:deg} apart: {shown}",
    consequence="{so}",
    fixes=(Fix("find its publishers: `{publishers} /tf_static` lists them"),),
    causes=(
        "two launch files",
        "a recalibration while recording",
    ),
    limits={"values": 3, "metres": 5e-4, "radians": 1e-3},
)
def static_changed(model: Model, limits: Limits) -> Iterator[Hit]:
    """A static transform was published again with another value."""
    for values, _, _, hit in _values_of_statics(model, limits):
        if 2 <= values <= limits["values"]:
            yield hit


def _values_of_statics(model: Model, limits: Limits) -> Iterator[tuple[int, float, float, Hit]]:
    """Yield, for each static with several values, their number, how far they differ, and a hit."""
    for track in model.statics:
        places = np.flatnonzero(track.usable)
        if len(places) < 2:
            continue
        # Poses that differ by less than the limit count as one.
        kept = [int(places[0])]
        changes: list[int] = []
        last = kept[0]
        # A node that repeats a static sends mostly the same numbers, which need no comparison.
        poses = np.hstack((track.translations, track.rotations))[places]
        for place in places[1:][(poses[1:] != poses[:-1]).any(axis=1)].tolist():
            if _same(track, place, last, limits):
                continue
            changes.append(place)
            last = place
            if len(kept) < 50 and not any(_same(track, place, one, limits) for one in kept):
                kept.append(place)
            if len(changes) > 1000:
                break
        if not changes:
            continue
        first = np.full(len(kept), kept[0])
        moved = float(track.apart(np.array(kept), first).max())
        turned = float(track.turned(np.array(kept), first).max())
        is_sudden = track.logs[changes[-1]] - track.logs[kept[0]] < NANOSECONDS
        again = ", and at the end the first again" if _same(track, last, kept[0], limits) else ""
        yield (
            len(kept),
            moved,
            turned,
            hit_of(
                track,
                {
                    "values": len(kept),
                    "moved": moved,
                    "turned": turned,
                    "shown": ", then ".join(
                        " ".join(f"{n:.4g}" for n in track.translations[one]) for one in kept[:3]
                    )
                    + again,
                    "so": "each listener keeps the value that reaches it last"
                    if is_sudden
                    else "when the new value arrives, all data placed with the old value "
                    "moves, also past data",
                },
                since=int(track.logs[changes[0]]),
                until=int(track.logs[changes[-1]]),
                count=len(changes),
            ),
        )


def _same(track: Track, one: int, other: int, limits: Limits) -> bool:
    some, others = np.array([one]), np.array([other])
    moved = float(track.apart(some, others)[0])
    turned = float(track.turned(some, others)[0])
    return moved <= limits["metres"] and turned <= limits["radians"]


@check(
    "static-on-tf",
    Severity.NOTE,
    rule="{samples:g} samples or more of a moving transform, over {seconds:g} s or more, are all "
    "equal while the parent frame moves. Not reported if joint states, the robot description, "
    "odometry, another transform of the same messages, a moving frame of similar name, or a "
    "fixed joint of the robot below the frame shows that the frame can move. A warning, also for "
    "shorter times, if {gaps:g} steps between the samples or more are above {long:g} s, and a "
    "share of {share:g} of the messages of the sensors below the frame has stamps in these steps",
    headline="{where} never {concerned:changes and is|change and are} sent on /tf{rarely}",
    detail="{edge}: {rate:.3g} Hz, for {lasts:span}{needed}",
    consequence="if the transform is a mount, lookups wait for its next sample, unless the stamps "
    "are ahead",
    causes=("the static publisher of the old tf package",),
    links=threads("orbbec/ros_astra_camera#89"),
    limits={"samples": 20, "seconds": 60.0, "gaps": 3, "long": 1.0, "share": 0.25},
    needs=("recording",),
    why="a constant sent at 10 Hz on /tf makes every lookup wait for up to 100 ms, unless its "
    "stamps are ahead. A joint at rest looks like a constant, and a short recording cannot "
    "distinguish the two",
    because_of=(("child", "static-and-dynamic"),),
)
def static_on_tf(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform on /tf is constant and could be static."""
    moving = [track for track in model.dynamic if track.moves]
    if not moving:
        return
    carried = by_child(model.dynamic)
    families = {family(track.child) for track in moving}
    may_move = [*moving, *_joints_by_statics(model)]
    for track in model.dynamic:
        if track.is_localisation or track.moves or len(track.by_stamp) < 2:
            continue
        lasts = int(track.sorted_stamps[-1] - track.sorted_stamps[0])
        is_long = len(track.by_stamp) >= limits["samples"] and lasts >= (
            limits["seconds"] * NANOSECONDS
        )
        needed = _needed_in_gaps(model, track, limits)
        if not (is_long or needed):
            continue
        if track.child in carried or family(track.child) in families:
            continue  # it changes its parent, or similar frames move
        if any(np.isin(track.messages, other.messages).any() for other in may_move):
            continue  # it is sent in the same messages as moving frames
        if _could_move(model, track):
            continue
        if not any(above.moves for above in model.above(track.parent)):
            continue  # it may have stood still because the robot did
        yield hit_of(
            track,
            {
                "rate": rate(track),
                "period": track.period,
                "lasts": lasts,
                "needed": needed,
                "rarely": ", rarely" if needed else "",
            },
            since=None,
            severity=Severity.WARNING if needed else None,
            fixes=(Fix("if it is a mount, send it on /tf_static"),) if needed else (),
            confidence=Confidence.POSSIBLE,
        )


def _needed_in_gaps(model: Model, track: Track, limits: Limits) -> str:
    """Return a clause about sensor messages with stamps in long gaps of an edge; "" if few."""
    steps = np.diff(track.sorted_stamps)
    wide = np.flatnonzero(steps > limits["long"] * NANOSECONDS)
    if len(wide) < limits["gaps"] or track.median_latency < -limits["long"] * NANOSECONDS / 2:
        return ""  # or ROS 1 dates it ahead by its period
    below = model.below(track.child)
    stamps = [
        heard.stamps
        for heard in model.heard
        if heard.is_spatial
        and heard.type.startswith("sensor_msgs/")
        and heard.frame.removeprefix("/") in below
    ]
    every = np.concatenate([np.zeros(0, dtype=np.int64), *stamps])
    before = np.searchsorted(track.sorted_stamps, every) - 1
    inside = int(np.count_nonzero(np.isin(before, wide)))
    if not inside or inside < limits["share"] * len(every):
        return ""
    return (
        f"; {inside} of {count(len(every), 'sensor message')} in its {len(wide)} gaps above "
        f"{limits['long']:g} s, of up to {span(int(steps.max()))}"
    )


def _could_move(model: Model, track: Track) -> bool:
    """Whether the description, Odometry or joint states show that an edge can move."""
    joint = model.joint_above.get(track.child)
    if joint is not None:
        return joint.moves
    odometry = model.evidence.odometry
    if odometry is not None and track.edge in {(e.parent, e.child) for e in odometry.edges}:
        return True
    if any(name in track.child for name in model.evidence.joints or ()):
        return True
    # robot_state_publisher uses the stamps of joint states for the frames of movable joints.
    return any(
        bool(np.isin(track.stamps, headers.stamps).mean() > 0.5)
        for headers in model.evidence.headers.values()
        if headers.type == JOINT_STATES
    )


def _joints_by_statics(model: Model) -> list[Track]:
    """Return the moving edges that are joints of a robot, judged by the static messages.

    robot_state_publisher sends all fixed joints in one static message. So the parents in such a
    message are links of the robot, and a moving edge to such a parent is a joint.
    """
    counts = Counter(number for one in model.statics for number in one.messages.tolist())
    carriers = {
        one.parent
        for one in model.statics
        if any(counts[number] > 1 for number in one.messages.tolist())
    }
    return [track for track in model.dynamic if track.child in carriers]
