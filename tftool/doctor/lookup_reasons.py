"""Reasons for failed lookups, derived from the edges of the path, with remedies."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

import numpy as np

from tftool.base.stamps import LATEST, NANOSECONDS, SIMULATED_BELOW, Duration, Stamp
from tftool.doctor.clock_checks import COUNTS_FROM_0, cure_of_offset
from tftool.doctor.coverage_checks import Waits, waits_of
from tftool.doctor.heard_names import alike_frames, is_navsat_output
from tftool.doctor.missing_joins import is_world, mount_command, proposed_frame, proposed_join
from tftool.doctor.model import Model
from tftool.doctor.name_checks import wrong_type
from tftool.doctor.shape_checks import nothing_says
from tftool.doctor.stamp_stream import Heard, Track, last_part
from tftool.doctor.stop_checks import edge_stopped
from tftool.doctor.trace import LinkVerdict, LookupTrace, TracedLink
from tftool.doctor.value_checks import bad_quaternion
from tftool.doctor.wording import (
    dated,
    in_words,
    is_ros1,
    least_rate,
    moment,
    rounded_up,
    several,
    span,
)

if TYPE_CHECKING:
    pass

USUAL_WAIT = 0.1
"""Time that most programs wait for a transform, seconds."""


class Cause(Enum):
    """Cause of a lookup's failure; WORKS for a lookup that succeeds."""

    LATE = "late"
    CLOCK_OFFSET = "clock-offset"
    CLOCK_MIXTURE = "clock-mixture"
    STOPPED = "stopped"
    GAP = "gap"
    BEFORE_START = "before-start"
    AFTER_END = "after-end"
    CACHE = "cache"
    UNKNOWN_FRAME = "unknown-frame"
    SPLIT = "split"
    SINGLE = "single"
    NAME = "name"
    LOOP = "loop"
    UNREAD = "wrong-type"
    WORKS = "works"


@dataclass(frozen=True, slots=True)
class Remedy:
    """Remedy for a failed lookup.

    Attributes:
        kind: "timeout", "rate", "cache", "skip", "name", "join", "publisher" or "clock".
        text: The remedy as a sentence.
        command: Shell command of the remedy; empty for a remedy without a command.
        least: Minimum timeout or cache time, or maximum period, nanoseconds; None for other kinds.
        advised: Recommended value instead of `least`, nanoseconds.
        possible: Whether the remedy can make the lookup succeed.
    """

    kind: str
    text: str
    command: str = ""
    least: Duration | None = None
    advised: Duration | None = None
    possible: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class TraceResult:
    """Result of a traced lookup, from which the reason for a failure is derived.

    Attributes:
        trace: The lookup.
        way: Edges of the path from source to target; None without a path.
        links: State of each edge in the buffer.
        refusing: Index of the failing edge; None if no edge fails.
        begin: First log time at which the lookup succeeds; None for never.
        end: Last log time at which the lookup succeeds; None if it never succeeds, or for ever.
        available: Whether the lookup succeeds at the trace's log time.
    """

    trace: LookupTrace
    way: list[Track] | None
    links: tuple[TracedLink, ...]
    refusing: int | None
    begin: Stamp | None
    end: Stamp | None
    available: bool


@dataclass(frozen=True, slots=True)
class Reason:
    """Reason for a lookup's success or failure.

    Attributes:
        cause: Kind of the reason.
        why: The reason in sentences.
        remedies: Remedies, the smallest first.
        useless: Sentences about common attempts that do not help.
    """

    cause: Cause
    why: tuple[str, ...]
    remedies: tuple[Remedy, ...] = ()
    useless: tuple[str, ...] = ()


def misnamed(trace: LookupTrace) -> Reason | None:
    """Return the reason if tf lacks the target or the source frame; None if tf has both frames."""
    model = trace.model
    for name in (trace.question.target, trace.question.source):
        if name.startswith("/") or not name:
            bare = name.lstrip("/")
            known = f"; tf knows {bare}" if bare in model.frames else ""
            users = sorted({heard.topic for heard in model.heard if heard.frame == name})
            where = f" in the publisher of {', '.join(users)}" if users else ""
            why = "the name is empty" if not name else f"{name} has ROS 1's leading slash{known}"
            return Reason(Cause.NAME, (why,), (Remedy("name", f'frame_id "{bare}"{where}'),))
        if name not in model.frames:
            return _unknown(trace, name)
    return None


def _described(model: Model, name: str) -> str | None:
    """Explain in a sentence why tf lacks a frame that the robot description defines.

    Return None if the description does not define the frame.
    """
    robot, states = model.evidence.robot, model.evidence.joints
    if robot is None or name not in robot.links or name == robot.root:
        return None
    joint = robot.joint_above(name)
    told = f"the robot description defines it by joint '{joint.name}' of {joint.parent}"
    if joint.type == "floating":
        return f"{told}, which is floating: robot_state_publisher skips it"
    if not joint.moves:
        return f"{told}, which is fixed: no transform of robot_state_publisher arrived"
    leader = robot.leader(joint.name, states or ())
    if states is None or leader not in states:
        return f"{told}, whose position is unknown: no joint state contains '{leader}'"
    return (
        f"{told}, and joint states have its position: no transform of robot_state_publisher arrived"
    )


def _unknown(trace: LookupTrace, name: str) -> Reason:
    model = trace.model
    says = [heard for heard in model.heard if heard.frame.removeprefix("/") == name]
    slashed = [heard for heard in says if heard.frame != name]
    why = [f"no transform contains the frame {name}"]
    why += [f"{heard.topic} names {heard.frame}, {len(heard.stamps):,} times" for heard in says]
    both = {trace.question.target, trace.question.source} - {name} - model.frames
    why += [f"no transform contains {other} either" for other in both]
    described = _described(model, name)
    if described is not None:
        return Reason(Cause.UNKNOWN_FRAME, (*why, described))
    alike = alike_frames(model, name)
    remedies = []
    if alike:
        why.append(f"tf has {' and '.join(alike)}, with a similar name")
        mistyped = "" if says else f"look up {alike[0]}, or "
        remedies.append(Remedy("name", f"{mistyped}set frame_id of the driver to {alike[0]}"))
    elif len(model.trees) == 1 and last_part(name) in ("map", "odom", "world"):
        why.append(f"the root of all frames in tf is {model.trees[0].root}")
    join = proposed_frame(model, name, [h.type for h in says if not is_navsat_output(h)])
    if join is not None:
        remedies.append(Remedy("join", join.fix.text, join.fix.command))
        why += [join.why] if join.why else []
    if not remedies:
        where = "this recording" if model.evidence.recorded else f"this {model.evidence.kind}"
        text = f"nothing in {where} publishes {name}: start its publisher, and record /tf"
        remedies.append(Remedy("publisher", text))
    if slashed:
        text = f'and set frame_id to "{name}": no frame of tf2 begins with a slash'
        remedies.append(Remedy("name", text))
    return Reason(
        Cause.UNKNOWN_FRAME, tuple(why), tuple(remedies), ("a timeout: nothing publishes it",)
    )


def no_join(known: TraceResult) -> Reason:
    """Return the reason why two known frames are not connected."""
    model, question = known.trace.model, known.trace.question
    ours, theirs = model.tree_of[question.source], model.tree_of[question.target]
    lesser, main = (ours, theirs) if len(ours.frames) <= len(theirs.frames) else (theirs, ours)
    if is_world(lesser.root) and not is_world(main.root):
        lesser, main = main, lesser  # the root of a map needs no parent
    used = sorted({h.topic for h in model.heard if h.frame in lesser.frames})
    by = f" (used by {', '.join(used)})" if used else ""
    join = proposed_join(model, main, lesser)
    mount = mount_command(model, main, lesser.root)
    fix = nothing_says(model, lesser.root, mount) if join is None else join.fix
    why = [
        f"{lesser.root} has no parent; its tree: {', '.join(sorted(lesser.frames))}{by}",
        f"the tree of {main.root}: {', '.join(sorted(main.frames))}",
        "a transform between the trees is missing"
        + (f"; {join.why}" if join is not None and join.why else ""),
    ]
    remedy = Remedy("join", fix.text, fix.command)
    return Reason(Cause.SPLIT, tuple(why), (remedy,), ("a timeout: nothing publishes it",))


def works(known: TraceResult) -> Reason:
    """Return the reason for a success, or a fault with which another listener's lookup may fail."""
    model, question = known.trace.model, known.trace.question
    for frame in (question.source, question.target):
        tree = model.tree_of.get(frame)
        if tree is not None and tree.is_circle:
            return Reason(
                Cause.LOOP,
                (
                    "the lookup works, but the frames form a loop: code that searches the root "
                    "fails, and the other way around the loop may give another pose",
                ),
                (Remedy("publisher", "publish one direction only"),),
            )
    if (unread := _unread(known) or _dropped_by_ros1(known)) is not None:
        return unread
    return Reason(
        Cause.WORKS,
        (
            "this lookup works. If it fails in your node, check: does the node have a "
            "TransformListener, does the waiting callback block the executor, did the buffer have "
            "time to fill?",
        ),
    )


def _unread(known: TraceResult) -> Reason | None:
    """Return a reason if the topic of a transform on the path has a wrong type; else None.

    No listener subscribes to such a topic; see the check `wrong-type`.
    """
    for hit in wrong_type(known.trace.model):
        unread = [one for one in known.way or () if set(one.topics) <= set(hit.topics)]
        if unread:
            topics = sorted({topic for track in unread for topic in track.topics})
            why = (
                f"a listener does not receive {several([track.name for track in unread])}: "
                f"{', '.join(topics)} {'has' if len(topics) == 1 else 'have'} the type "
                f"{hit.facts['type']}, and tf2 reads tf2_msgs/TFMessage only"
            )
            cure = "send them with a TransformBroadcaster"
            return Reason(Cause.UNREAD, (why,), (Remedy("publisher", cure),))
    return None


def _dropped_by_ros1(known: TraceResult) -> Reason | None:
    """Return the reason if ROS 1 drops a transform of the path, else None.

    ROS 1 drops rotations with a wrong length: see the check `bad-quaternion`.
    """
    for track in known.way or () if is_ros1(known.trace.model.evidence) else ():
        squares = track.squares[track.usable]
        if len(squares) and np.abs(squares - 1.0).min() > bad_quaternion.limits["length"]:
            why = (
                f"the lookup works in ROS 2, but ROS 1 drops {track.name}: its rotation has the "
                f"length {math.sqrt(squares[0]):.4g} instead of 1"
            )
            cure = "let its publisher normalise the rotation"
            return Reason(Cause.WORKS, (why,), (Remedy("publisher", cure),))
    return None


def refusing_link(known: TraceResult) -> Reason:
    """Return the reason why an edge of the path has no data at the lookup's time."""
    trace = known.trace
    if known.refusing is None or known.way is None:
        return Reason(Cause.LATE, ("tf2 refuses the lookup, although every link has data",))
    link, track = known.links[known.refusing], known.way[known.refusing]
    if track.static:
        late = int(track.logs[0]) - trace.asked
        return Reason(
            Cause.LATE,
            (f"the static transform {link.name} arrives {span(late)} after the lookup",),
            (_timeout(known, None),),
        )
    if _is_simulated(trace.moment) != _is_simulated(int(track.sorted_stamps[-1])):
        return _two_clocks(link, track, trace)
    if (apart := _on_another_clock(trace.model, known.way)) is not None:
        return apart
    if len(track.by_stamp) == 1:
        at = int(track.sorted_stamps[0])
        return Reason(
            Cause.SINGLE,
            (f"{link.name} was sent once, at {moment(at)}: lookups at other times fail",),
            (Remedy("publisher", "send it with a StaticTransformBroadcaster (on /tf_static)"),),
            ("a timeout: no second sample will arrive",),
        )
    if trace.stamp == LATEST and (ended := _ended(known)) is not None:
        return ended
    if link.verdict is LinkVerdict.PRUNED:
        return _pruned(known, link, track)
    first, last = int(track.sorted_stamps[0]), int(track.sorted_stamps[-1])
    if trace.moment < first:
        return _before_start(known, link, track, first)
    if trace.moment > last:
        if _goes_on(trace, track):
            return _after_end(link, trace, last)
        return _stopped(link, trace, last)
    return _late(known, link, track)


def _is_simulated(stamp: Stamp) -> bool:
    return stamp < SIMULATED_BELOW


def _two_clocks(link: TracedLink, track: Track, trace: LookupTrace) -> Reason:
    stamp = int(track.sorted_stamps[-1])
    names = ["the simulation's clock", "the wall clock"]
    setting = "false" if _is_simulated(stamp) else "true"
    text = trace.model.words["sim_time_of"].format(setting=setting, edge=link.name)
    if trace.model.evidence.lacks_clock:
        names[0] = COUNTS_FROM_0
        text = f"no /clock was recorded; {trace.model.words['which_clock']}"
    clock, other = names if _is_simulated(stamp) else names[::-1]
    return Reason(
        Cause.CLOCK_MIXTURE,
        (
            f"{link.name} is stamped with {clock}: {dated(stamp)}",
            f"the requested time is on {other}: {dated(trace.moment)}",
        ),
        (Remedy("clock", text),),
        ("a timeout, a larger cache: stamps of two clocks never match",),
    )


def _on_another_clock(model: Model, path: Sequence[Track]) -> Reason | None:
    """Return the reason if the stamps on a lookup's path come from two clocks; else None.

    See the check `clock-offset`.
    """
    moving = [track for track in path if not track.static]
    off = [track for track in moving if track in model.unshifted]
    if not off or len(off) == len(moving):
        return None
    ahead = -off[0].median_latency
    is_or_are = "is" if len(off) == 1 else "are"
    return Reason(
        Cause.CLOCK_OFFSET,
        (
            f"{several([track.name for track in off])} {is_or_are} {span(abs(ahead))} off the "
            "other clocks: no lookup across the two clocks can succeed",
        ),
        (Remedy("clock", in_words(cure_of_offset(model).text, model.words)),),
        ("a timeout, a larger cache: stamps of two clocks never match",),
    )


def _pruned(known: TraceResult, link: TracedLink, track: Track) -> Reason:
    trace = known.trace
    newest = int(track.stamps[trace.arrived(track)].max())
    needed = newest - trace.moment
    # The sample at or before the time must not be pruned. ROS 2 prunes before it inserts the newest
    # sample, ROS 1 after: this cache time is enough for both.
    before = track.sorted_stamps[track.sorted_stamps <= trace.moment]
    least = newest - int(before[-1]) if len(before) else needed
    advised = math.ceil((least + NANOSECONDS) / NANOSECONDS)
    why = (
        f"the buffer keeps {span(trace.cache)}, and the newest sample of {link.name} is "
        f"{span(needed)} newer than the requested time"
    )
    if trace.heard is not None and trace.after is not None:
        why = (
            f"{trace.heard.topic} arrives {span(trace.after)} after its stamp; the buffer keeps "
            f"{span(trace.cache)}"
        )
    return Reason(
        Cause.CACHE,
        (why,),
        (
            Remedy(
                "cache",
                f"use a larger cache, at least {span(least)}:",
                trace.model.words["buffer"].format(needed=advised),
                least,
                advised * NANOSECONDS,
            ),
            Remedy(
                "skip",
                "or look up the transform when the measurement arrives, and store the result",
            ),
        ),
        ("a timeout: dropped samples do not arrive again",),
    )


def _before_start(known: TraceResult, link: TracedLink, track: Track, first: Stamp) -> Reason:
    trace = known.trace
    why = [
        f"{link.name} begins {span(first - trace.moment)} after the requested time, at "
        f"{moment(first)}"
    ]
    if track.median_latency < 0:
        why.append(
            f"its stamps are {span(-track.median_latency)} ahead (transform_tolerance): every "
            "lookup before its first stamp fails"
        )
    lost = ""
    if trace.heard is not None:
        count = int(np.count_nonzero(trace.heard.stamps < first))
        lost = f"; the first {count} messages of {trace.heard.topic} are lost"
    return Reason(
        Cause.BEFORE_START,
        tuple(why),
        (Remedy("skip", f"look up {moment(first)} or later{lost}"),),
        ("a timeout, a larger cache: no older data will arrive",),
    )


def _goes_on(trace: LookupTrace, track: Track) -> bool:
    """Whether an edge's samples continue to the end of the recording or scenario.

    The thresholds are those of the check `edge-stopped`.
    """
    evidence, limits = trace.model.evidence, edge_stopped.limits
    least = max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)
    ends = evidence.recorded or evidence.kind == "scenario"
    return ends and trace.model.end - int(track.logs[-1]) <= least


def _after_end(link: TracedLink, trace: LookupTrace, last: Stamp) -> Reason:
    evidence = trace.model.evidence
    ended = "recording" if evidence.recorded else evidence.kind
    return Reason(
        Cause.AFTER_END,
        (
            f"the last sample of {link.name} in the {ended} is at {moment(last)}, "
            f"{span(trace.moment - last)} before the requested time",
        ),
        (Remedy("skip", f"look up {moment(last)} or earlier"),),
        ("a timeout: no further sample will arrive",),
    )


def _stopped(link: TracedLink, trace: LookupTrace, last: Stamp) -> Reason:
    return Reason(
        Cause.STOPPED,
        (
            f"{link.name} ended at {moment(last)}, {span(trace.moment - last)} before the "
            "requested time, and no sample follows",
        ),
        (Remedy("publisher", "check whether its publisher still runs"),),
        ("a timeout: no further sample will arrive",),
    )


def _ended(known: TraceResult) -> Reason | None:
    """Return the reason if a lookup of the latest time fails because an edge stopped; else None.

    The latest common time is then the stamp of the stopped edge's last sample. The caches of the
    other edges no longer reach back to this stamp.
    """
    trace = known.trace
    for track in known.way or ():
        if track.static or _goes_on(trace, track):
            continue
        since = trace.asked - int(track.logs[-1])
        if int(track.sorted_stamps[-1]) == trace.moment and since > trace.cache:
            why = (
                f"{track.name} ended at {moment(trace.moment)}, {span(since)} before the lookup; "
                "this is the latest time common to all links, but the other links have dropped it"
            )
            return Reason(
                Cause.STOPPED,
                (why,),
                (Remedy("publisher", "check whether its publisher still runs"),),
                (
                    "a timeout: no further sample will arrive",
                    "a larger cache: it keeps an old pose",
                ),
            )
    return None


def _late(known: TraceResult, link: TracedLink, track: Track) -> Reason:
    trace = known.trace
    stamps = track.sorted_stamps
    after = int(np.searchsorted(stamps, trace.moment, side="left"))
    step = int(stamps[after] - stamps[after - 1]) if after else 0
    heard = trace.heard
    is_gap = step > max(5 * track.period, NANOSECONDS // 2)
    why = f"{link.name} arrives every {span(track.period)}, {span(link.latency)} after its stamp"
    cause = Cause.LATE
    if is_gap:
        cause = Cause.GAP
        why = f"{link.name} has a gap of {span(step)} from {moment(int(stamps[after - 1]))} on"
    elif heard is not None and heard.median_latency < -20_000_000:
        cause = Cause.CLOCK_OFFSET
        why = (
            f"{heard.topic} is stamped {span(-heard.median_latency)} ahead of its arrival: its "
            "clock is ahead"
        )
    elif heard is not None:
        why += f"; {heard.topic} after {span(heard.median_latency)}"
    remedies = [_timeout(known, heard)]
    if cause is Cause.CLOCK_OFFSET:
        remedies.insert(0, Remedy("clock", "synchronise the clocks (chronyc tracking; PTP)"))
    elif cause is Cause.LATE:
        later = link.latency - (heard.median_latency if heard is not None else 0)
        left = USUAL_WAIT - later / NANOSECONDS
        often = least_rate(link.name, link.period, later, USUAL_WAIT)
        if often:
            remedies.append(
                Remedy(
                    "rate",
                    f"or {often}" if left > 0 else often,
                    least=None if left <= 0 else round(left * NANOSECONDS),
                    possible=left > 0,
                )
            )
    useless = [
        f"the latest time instead of the stamp: the pose of {trace.question.source} would be "
        f"{span(link.short_by)} old",
        "a larger cache: the missing sample has not arrived yet",
    ]
    return Reason(cause, (why,), tuple(remedies), tuple(useless))


def _waits(trace: LookupTrace, heard: Heard) -> Waits | None:
    return waits_of(trace.model, heard, trace.question.target, warm=False)


def _timeout(known: TraceResult, heard: Heard | None) -> Remedy:
    """Return a remedy of the kind "timeout", with the timeout that this lookup needs.

    Args:
        known: The traced lookup.
        heard: Topic whose messages need the transform; the text adds the timeouts that these
            messages need. None without a topic.
    """
    trace = known.trace
    if known.begin is None:
        text = "a timeout does not help: one side leaves the buffer before the other arrives"
        return Remedy("timeout", text, possible=False)
    least = max(0, known.begin - trace.asked)
    advised = rounded_up(least)
    text = f"a timeout of {advised // 10**6} ms (least: {least / 1e6:.1f})"
    waits = None if heard is None else _waits(trace, heard)
    if heard is not None and waits is not None and len(waits.served):
        p95, worst = waits.serves(95), int(waits.served.max())
        text += (
            f"; {p95 / 1e6:.1f} ms are enough for 95 % of {heard.topic}, {worst / 1e6:.1f} ms for "
            f"all {len(waits.served):,} messages whose lookup can succeed"
        )
    return Remedy("timeout", text, "", least, advised)


CHECK_OF = {
    Cause.LATE: "sensor-outruns-tf",
    Cause.CLOCK_OFFSET: "clock-offset",
    Cause.CLOCK_MIXTURE: "clock-mixture",
    Cause.STOPPED: "edge-stopped",
    Cause.GAP: "gap",
    Cause.BEFORE_START: "late-start",
    Cause.CACHE: "cache-short",
    Cause.UNKNOWN_FRAME: "unknown-frame",
    Cause.SPLIT: "split-tree",
    Cause.SINGLE: "single-sample",
    Cause.NAME: "slash-twins",
    Cause.LOOP: "loop",
    Cause.UNREAD: "wrong-type",
}
"""Id of the check that finds each cause."""
