"""Checks of clocks: several clocks, offsets between clocks, future stamps and stray stamps."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, Duration, as_seconds, seconds
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Fact, Fix, Hit, Severity
from tftool.doctor.gap_checks import REPORTS
from tftool.doctor.missing_joins import own_trees
from tftool.doctor.model import SHIFT, Limits, Model, Shift
from tftool.doctor.stamp_checks import COMPARE_CLOCKS
from tftool.doctor.stamp_stream import BASES, JOINT_STATES, Heard, Track, last_part
from tftool.doctor.wording import is_ros1, several, span
from tftool.recordings.contract import percentile

check = checks_of(Area.CLOCKS)

_LOOKS_THE_SAME = Fix(
    f"{COMPARE_CLOCKS.text}; an older recording that is played again looks the same"
)
_BESIDE_PLAYER = Fix("for nodes beside the player of the recording: {play_again}")
_PLAY_AGAIN = Fix("a recording was played beside nodes that run on the present time: {play_again}")
_BOTH = 0.05
"""Fraction of an edge's samples on another clock above which they come from a second source."""

_NEAR = seconds(0.1)
"""Maximum difference from the shift of a clock, nanoseconds, that is a usual delay."""

_JITTER = seconds(1)
"""Maximum difference of a message's latency from the median latency of its clock, nanoseconds."""

_MOST = 0.75
"""Fraction of a stream's messages above which their latency is that of the stream."""

_ONE_CLOCK = seconds(0.05)
"""Maximum difference between two offsets, nanoseconds, that belong to one clock."""

COUNTS_FROM_0 = "a clock that counts from 0 (a simulation, or a computer whose clock was never set)"
"""Name of a clock with small stamps, if no /clock was recorded."""

CONSTANTS_AHEAD = seconds(1)
"""Maximum time by which ROS 1 may stamp static frames ahead; robot_state_publisher uses 0.5 s."""


@check(
    "clock-mixture",
    Severity.ERROR,
    rule="stamps below and above 10⁸ s occur together in transforms, joint states and messages "
    "with a position, or of a robot's own type in a frame of tf. The stamps that differ from "
    "/clock count as wrong; without /clock, those of the smaller group. An error only if the "
    "wrong stamps are those of moving transforms, or of sensors and odometry whose frames move. "
    "A warning for other messages, "
    "and if each clock has a tree of its own. A note for single messages, and for messages in "
    "frames that static transforms place",
    headline="{where}{once} {concerned:is|are} stamped with {odd_clock}, {others} with "
    "{usual_clock}",
    detail="for example {odd_stamp:dated} beside {usual_stamp:dated}",
    consequence="{so}",
    causes=(
        "one node without use_sim_time",
        "simulated time set on a real robot",
        "a computer without a clock of its own, which counts from 0",
        "a real sensor on a simulated robot",
    ),
    links=threads("ANYbotics/elevation_mapping#122", "iRobotEducation/create3_sim#203"),
)
def clock_mixture(model: Model, limits: Limits) -> Iterator[Hit]:
    """Some stamps count from the simulation's start, others from 1970."""
    streams: list[Track | Heard] = [*model.dynamic, *_placed(model)]
    simulated = [one for one in streams if one.families[0]]
    wall = [one for one in streams if one.families[1]]
    if not simulated or not wall:
        return
    read, _ = model.evidence.clock
    if len(read):
        sim_is_odd = bool(np.median(read) >= SIMULATED_BELOW)
    else:
        weights = [(len(group), _stamps(group, i)) for i, group in enumerate((simulated, wall))]
        sim_is_odd = weights[0] < weights[1]
    odd = simulated if sim_is_odd else wall
    others = wall if sim_is_odd else simulated
    tracks = [one for one in odd if isinstance(one, Track)]
    heards = [one for one in odd if isinstance(one, Heard)]
    sample, usual = _example(odd, sim_is_odd), _example(others, not sim_is_odd)
    setting = "false" if sim_is_odd else "true"
    names = ["the simulation's clock", "the wall clock"]
    fix = Fix(model.words["sim_time"].format(setting=setting))
    if model.evidence.lacks_clock:
        names[0] = COUNTS_FROM_0
        fix = Fix("no /clock was recorded; {which_clock}")
    odd_clock, usual_clock = names if sim_is_odd else names[::-1]
    so, severity = "no lookup across the two clocks can succeed", None
    harmless = [one for one in heards if _is_single(one) or model.rests(one.frame)]
    if not any(_is_placed_by_stamp(model, one) for one in odd):
        severity = Severity.WARNING
    apart = own_trees(model, odd, others)
    if len(harmless) == len(odd):
        severity = Severity.NOTE
        so = "none while programs use only its frame and not its stamp, as for a map"
        if all(model.rests(one.frame) for one in harmless):
            so = "none while only static transforms, which hold at any time, place its frame"
    elif apart:
        so = "lookups within each tree succeed; data of one tree cannot be placed in the other"
        severity = Severity.WARNING
        if any(last_part(track.parent) in BASES for track in tracks):
            pass  # the robot's own node sends them
        elif not any(track.child in model.joint_above for track in tracks):
            fix = Fix("if it is a real device beside a simulated robot, nothing needs to change")
        elif copied := [topic for topic in model.joint_topics if _are_copies(model, tracks, topic)]:
            # robot_state_publisher gives transforms the stamps of the joint states.
            words = model.words["sim_time_of"].format(setting=setting, edge=several(copied))
            fix = Fix(f"these stamps are those of {several(copied)}: {words}")
    yield Hit(
        frames=apart,
        severity=severity,
        edges=tuple(track.edge for track in tracks),
        topics=tuple(sorted({heard.topic for heard in heards})),
        publishers=tuple(sorted({node for track in tracks for node in track.nodes})),
        since=min(int(one.logs[0]) for one in odd),
        count=sum(one.families[0 if sim_is_odd else 1] for one in odd),
        facts={
            "odd": [one.name for one in odd],
            "odd_stamp": sample,
            "usual_stamp": usual,
            "odd_clock": odd_clock,
            "usual_clock": usual_clock,
            "others": _others(model, odd, 0 if sim_is_odd else 1),
            "once": " (latched, once)" if all(_is_single(one) for one in odd) else "",
            "setting": setting,
            "so": so,
        },
        fixes=(fix,),
        alone=True,
    )


def _are_copies(model: Model, tracks: list[Track], topic: str) -> bool:
    """Whether nearly all samples of some edges have the stamp of a message on a topic."""
    told = model.evidence.headers[topic].stamps
    return all(float(np.mean(np.isin(track.stamps, told))) > 0.9 for track in tracks)


def _placed(model: Model) -> list[Heard]:
    """Return the topics whose stamps are used in lookups: joint states, messages with positions.

    Programs look up the frames of messages with a position, but not those of diagnostics or logs.
    Messages of a robot's own types may have positions in the frames of tf; commands have none.
    """
    return [
        one
        for one in model.heard
        if one.is_spatial
        or one.type == JOINT_STATES
        or (
            one.has_own_type
            and one.frame.removeprefix("/") in model.frames
            and not _COMMAND.search(f"{one.topic} {one.type}".lower())
        )
    ]


_COMMAND = re.compile("cmd|command|control|drive|twist")
"""Words in the topics and types of commands."""


def _is_single(stream: "Track | Heard") -> bool:
    """Whether the stream is a topic with a single message, such as a latched map."""
    return isinstance(stream, Heard) and len(stream.all_stamps) == 1


def _is_placed_by_stamp(model: Model, stream: "Track | Heard") -> bool:
    """Whether a wrong stamp in the stream makes lookups fail.

    This holds for all transforms, and for sensor messages in a frame that moves.
    """
    if isinstance(stream, Track):
        return True
    is_sensor = stream.type.startswith("sensor_msgs/") or stream.type == "nav_msgs/Odometry"
    # Lookups of a frame that is not in tf fail at any stamp.
    path = model.path(stream.frame.removeprefix("/"), model.fixed_frame) or ()
    return is_sensor and not _is_single(stream) and not all(track.static for track in path)


def _others(model: Model, reported: "list[Track | Heard]", family: int) -> str:
    """Return "other streams" if any stream outside `reported` is on a clock, else "all others".

    Args:
        model: Model of the evidence.
        reported: Streams of a finding.
        family: The clock: 0 for a simulation's clock, 1 for the wall clock.
    """
    streams: list[Track | Heard] = [*model.tracks, *model.heard]
    also = any(one.families[family] for one in streams if one not in reported)
    return "other streams" if also else "all others"


def _stamps(group: "list[Track | Heard]", family: int) -> int:
    return sum(one.families[family] for one in group)


def _example(group: "list[Track | Heard]", simulated: bool) -> int:
    stamps = group[0].stamps
    mask = (stamps != 0) & ((stamps < SIMULATED_BELOW) == simulated)
    return int(stamps[mask][0])


@check(
    "shifted-clock",
    Severity.NOTE,
    rule="more than half of all streams have stamps that differ from their reception by the same "
    "constant, more than 2 s and equal to within 1 s. If the stamps of all streams, three or more, "
    "are before their reception, and the differences agree to within 0.2 s, 0.5 s are enough. If "
    "all streams are ahead of their reception, only the half of the messages that waited least has "
    "to agree to within 1 s. Not reported if some transforms and messages with a position, such as "
    "those of a second robot, agree with the recorder's clock to within 1 s. A warning if the "
    "stamps are after the reception, because a recording that is played again cannot have such "
    "stamps. A warning also in ROS 1 if all streams have the shift, and no publisher has the name "
    "of a player. The evidence tells if a player such as `ros2 bag play` wrote a log or declared a "
    "parameter, and which streams differ by more than the spread and 0.1 s",
    headline="{most} stamps are {by:span} {side} their reception, constant to {spread:span}{told}",
    detail="{streams} of {of} streams{others}; latencies and the cache are judged against the "
    "clock of the stamps{player}",
    consequence="none for lookups within the recording; {live}",
    causes=(
        "the robot's clock was never set: it has no battery and no network",
        "the clock of the recorder's computer is wrong",
        "the recording was played again and recorded anew",
    ),
    needs=("log times",),
    why="one constant for all streams is a wrong clock or a recording that is played again, not a "
    "fault of a publisher",
    because_of=(("anything", "time-jump-back"),),
)
def shifted_clock(model: Model, limits: Limits) -> Iterator[Hit]:
    """Most stamps differ from the time of reception by the same constant."""
    if model.shift is None or model.unshifted:
        return  # `clock-offset` tells of the two clocks
    is_old, played = model.shift.by > model.end - model.start, model.evidence.played
    alike, others = _shifted_streams(model, model.shift)
    is_whole = model.shift.streams == model.shift.of
    nodes = [one.node for one in model.evidence.publishers]
    is_live = all(node and "play" not in node.lower() for node in nodes) and is_ros1(model.evidence)
    is_known = is_live and is_whole and not played and model.shift.by > 0
    is_shown = model.shift.by < 0 or is_known
    cure = _BESIDE_PLAYER if is_old and played else cure_of_offset(model)
    yield Hit(
        since=model.start,
        count=model.shift.streams,
        facts={
            "by": abs(model.shift.by),
            "side": "before" if model.shift.by > 0 else "after",
            "spread": model.shift.spread,
            "told": " in the half of the messages that waited least"
            if model.shift.has_bursts
            else " for 80 % of the messages",
            "streams": alike,
            "of": alike + len(others),
            "others": f", and {several(others)}" if others else "",
            "player": f"; {played} names a player: the data was replayed from another recording"
            if is_old and played
            else "; no publisher has the name of a player"
            if is_known
            else "",
            "most": "most" if others or _has_unshifted(model, model.shift) else "all",
            "live": "a node on the recorder's computer that looks up its present time gets data of "
            "another time, or none",
        },
        severity=Severity.WARNING if is_shown and not model.was_played else None,
        fixes=(COMPARE_CLOCKS if is_known else cure,),
        alone=True,
    )


def _shifted_streams(model: Model, shift: Shift) -> tuple[int, list[str]]:
    """Return the number of streams with the shift, and a clause about each other stream.

    Constant transforms that ROS 1 dates ahead on purpose are left out.
    """
    alike, others = 0, []
    streams: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    for one in streams:
        late = one.median_latency
        is_constant = isinstance(one, Track) and not one.moves and -CONSTANTS_AHEAD <= late < 0
        if len(one.stamps) < 3 or sum(one.families) != one.families[1] or not one.families[1]:
            continue
        # Compared with days, seconds are network delay.
        if abs(late) <= max(shift.spread, _NEAR, abs(shift.by) // 10_000):
            alike += 1
        elif not is_constant:
            more = "more" if (late > 0) == (shift.by > 0) else "less"
            others.append(f"{one.name} {span(abs(late))} {more}")
    return alike, others


def _has_unshifted(model: Model, shift: Shift) -> bool:
    """Whether a stream, a static transform or a latched message lacks the shift of most streams."""
    every: list[Track | Heard] = [*model.tracks, *model.heard]
    odd = (2 * abs(one.median_latency) > abs(shift.by) for one in every if one.families[1])
    return shift.streams < shift.of or any(odd)


@check(
    "future-stamp",
    Severity.NOTE,
    rule="the stamps of a transform are later than its arrival: by more than {seconds:g} s in the "
    "median (from map to odometry: {localisation:g} s). Not reported if the difference is the "
    "period of the transform, or a constant of up to 1 s",
    headline="{where} {concerned:is|are} dated {ahead:span} ahead of {concerned:its|their} arrival",
    detail="{edge}: {ahead:span} ahead (median){clock}",
    consequence="the latest common time is in the future: a lookup of the latest transform combines"
    " different moments",
    fixes=(COMPARE_CLOCKS,),
    causes=(
        "an offset that the publisher adds to its stamps (transform_tolerance)",
        "the publisher's clock is ahead",
    ),
    links=threads("ros-navigation/navigation2#3166"),
    limits={"seconds": 0.02, "localisation": 2.0},
    needs=("log times",),
    why="AMCL stamps its transform 1 s ahead, and offsets of 0.1 s are in use. ROS 1's static "
    "publishers and gmapping stamp their transforms one period ahead; ROS 1's "
    "robot_state_publisher stamps fixed joints 0.5 s ahead",
    because_of=(("stream", "clock-mixture clock-offset"),),
)
def future_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms are stamped later than they arrive."""
    for track in model.dynamic:
        if not len(track.stamps):
            continue
        ahead = -track.median_latency
        if _by_design(track, ahead):
            continue
        least = limits["localisation"] if track.is_localisation else limits["seconds"]
        if ahead > least * NANOSECONDS:
            yield _ahead(model, track, ahead)


def _by_design(track: Track, ahead: int) -> bool:
    """Whether a publisher gives a transform a stamp in the future on purpose.

    Some ROS 1 publishers do so, to keep the transform valid until the next sample.

    Args:
        track: Samples of the edge.
        ahead: Median time from reception to the stamp, nanoseconds.
    """
    if ahead <= 1.2 * track.period:
        return True
    return not track.moves and ahead <= CONSTANTS_AHEAD


def _ahead(model: Model, track: Track, ahead: int) -> Hit:
    # If a computer's clock is wrong, all its streams are ahead by the same amount.
    others: list[Track | Heard] = [h for h in model.heard if h.is_spatial]
    others += [t for t in model.dynamic if t.nodes and not set(t.nodes) & set(track.nodes)]
    also = [
        other.name
        for other in others
        if abs(-other.median_latency - ahead) < max(0.02e9, 0.1 * ahead)
    ]
    told = f"; so are {several(also)}" if also else ""
    return hit_of(track, {"ahead": ahead, "also": also, "clock": told})


@check(
    "wild-stamp",
    Severity.WARNING,
    rule="a few stamps of a stream (one in a hundred, but at least one) differ by more than an "
    "hour from the stamps of the messages before and after",
    headline="{where} {concerned:has|have} a stamp that lies {off:span} {side} the others",
    detail="{what}: {count} of {of}, {stamp:dated}",
    consequence="{so}",
    fixes=(Fix("look at where its publisher takes the stamps from"),),
    causes=(
        "memory that was never set, or a number read with the wrong bytes",
        "one message stamped before the clock was set",
    ),
    needs=("log times",),
    why="a late message or a slow clock causes a difference of seconds, and other messages have "
    "this difference too",
)
def wild_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Single stamps differ greatly from the stamps before and after."""
    streams: list[Track | Heard] = [*model.dynamic, *_placed(model)]
    for one in streams:
        places = np.flatnonzero(one.wild)
        if not len(places):
            continue
        # Compare the latency with that of the neighbouring stamp, which is normal.
        beside = np.where(places > 0, places - 1, places + 1)
        off = one.latency[beside] - one.latency[places]
        worst = int(np.abs(off).argmax())
        place = int(places[worst])
        facts: dict[str, Fact] = {
            "what": one.name,
            "count": len(places),
            "of": len(one.stamps),
            "stamp": int(one.stamps[place]),
            "off": abs(int(off[worst])),
            "side": "ahead of" if off[worst] > 0 else "behind",
        }
        if isinstance(one, Heard):
            facts["so"] = "a lookup at such a stamp fails"
        elif (off > 0).any():
            facts["so"] = "tf2 drops the transforms that follow, until their stamps reach this one"
        else:
            facts["so"] = "tf2 drops a transform that is so old"
        group = str(facts["so"])
        yield hit_of(one, facts, since=int(one.logs[place]), count=len(places), group=group)


@check(
    "clock-offset",
    Severity.WARNING,
    rule="the median latency of a sensor's messages is below -{seconds:g} s (for a laser scan, "
    "after the duration of one scan is added). Or messages or transforms are stamped by the "
    "recorder's clock in a recording whose other stamps are shifted as a whole. Or the latencies "
    "of a topic without positions are above {far:g} s, before or after reception, and equal to "
    "within 1 %, for {samples:g} messages or more. An error if a transform is off by more than the "
    "cache time. A note up to {certain:g} s. A note also if the latencies of steady streams (95 % "
    "within {spread:g} s, {samples:g} messages or more) form groups more than {apart:g} s apart; "
    "streams that are ahead, or late by about one period, are left out",
    headline="{topic} {found}",
    detail="{groups}{sources}",
    consequence="{so}",
    causes=(
        "the clocks of robot base and single-board computer differ",
        "the clocks of robot and desk computer differ",
        "a lidar has its own clock",
        "a recording is played while nodes run on the present time",
    ),
    links=threads(
        "turtlebot/turtlebot4_robot#8", "DFKI-NI/mir_robot#7", "ROBOTIS-GIT/turtlebot3#618"
    ),
    limits={
        "seconds": 0.02,
        "certain": 0.05,
        "spread": 0.02,
        "apart": 0.05,
        "samples": 20,
        "far": 60.0,
    },
    needs=(
        "log times",
        "headers",
    ),
    why="a message cannot arrive before its measurement; rounding of stamps is below 20 ms, and a "
    "scan may be stamped with its end",
    because_of=(("stream", "clock-mixture"),),
)
def clock_offset(model: Model, limits: Limits) -> Iterator[Hit]:
    """A sensor's stamps are in the future, or on another clock than most stamps."""
    alike: dict[int, list[Track | Heard]] = defaultdict(list)
    for track in model.unshifted:
        ahead = -track.median_latency
        alike[_same(alike, ahead)].append(track)
    for heard in model.heard:
        if not heard.is_spatial and _is_far_off(model, heard, limits):
            ahead = -heard.median_latency
            alike[_same(alike, ahead)].append(heard)
        if len(heard.stamps) < 3 or not heard.is_spatial:
            continue
        allowed = limits["seconds"] * NANOSECONDS
        if heard.type == "sensor_msgs/LaserScan":
            # Some drivers stamp a scan with the time of its end, some with that of its start.
            steps = np.diff(np.sort(heard.stamps))
            allowed += float(np.median(steps)) if len(steps) else 0.0
        ahead = -heard.median_latency
        if ahead > allowed or _is_unshifted(model, heard):
            alike[_same(alike, ahead)].append(heard)
    for track in model.dynamic if alike and model.shift is None else ():
        ahead = -track.median_latency
        if ahead > SHIFT and _same(alike, ahead) in alike:
            alike[_same(alike, ahead)].append(track)
    if _is_shared(model, list(alike)):
        return  # the recorder's clock is off, and all stamps agree
    groups = _offsets(model) if alike else []
    other = "the other clocks" if len(groups) > 1 else "the recorder's clock"
    for ahead, streams in alike.items():
        names = tuple(dict.fromkeys(one.name for one in streams))
        heards = [one for one in streams if isinstance(one, Heard)]
        offsets = sorted(abs(one.median_latency) for one in streams)
        by = span(offsets[0])
        if offsets[-1] - offsets[0] > _ONE_CLOCK and span(offsets[-1]) != by:
            by += f" to {span(offsets[-1])}"
        told = ""
        if model.shift is not None and len(heards) < len(streams):
            shift = model.shift
            told = f": {shift.streams} of {shift.of} streams are not on the recorder's clock"
        sources = _on_both_clocks(model, streams)
        so = "each lookup at these stamps that needs a moving transform asks for data that "
        so += "has not arrived yet" if ahead > 0 else "the buffer has already dropped"
        if 0 < ahead <= model.settings.cache_time:
            so = f"each lookup at these stamps has to wait {by} longer, or fails"
        side = "ahead of" if ahead > 0 else "behind"
        off = f"{side if model.shift is None else 'off'} {other}"
        is_far = abs(ahead) > model.settings.cache_time
        cached = f" with a cache of {as_seconds(model.settings.cache_time):g} s" if is_far else ""
        if told:
            so = f"no lookup across the two clocks can succeed{cached}"
        elif _is_of_transforms(model, ahead):
            off = f"{side} the recorder's clock"
            so = (
                "lookups among the robot's own data work; a node on the recorder's computer that "
                "looks up its present time gets data of another time"
            )
        elif len(heards) < len(streams) and is_far:
            so = f"no lookup across the two clocks can succeed{cached}"
        topic, found = several(names), f"{'is' if len(names) == 1 else 'are'} {by} {off}" + told
        if model.shift is not None and abs(model.shift.by - ahead) < _JITTER:
            # These streams are right: the others are not on the recorder's clock.
            agrees = f"{topic} {'agrees' if len(names) == 1 else 'agree'}"
            topic, verb = _shifted_names(model, model.shift, streams)
            side = "behind" if model.shift.by > 0 else "ahead of"
            by = span(abs(model.shift.by))
            found = f"{verb} {by} {side} the recorder's clock, with which {agrees}"
            if not told and is_far:
                so = "no lookup across the two clocks that needs a moving transform can succeed"
                so += cached
        yield Hit(
            edges=tuple(one.edge for one in streams if isinstance(one, Track)),
            topics=tuple(dict.fromkeys(heard.topic for heard in heards)),
            frames=tuple(dict.fromkeys(heard.frame for heard in heards)),
            since=min(int(one.logs[0]) for one in streams),
            count=sum(len(one.stamps) for one in streams),
            facts={
                "topic": topic,
                "ahead": ahead,
                "groups": groups,
                "sources": sources,
                "found": found,
                "so": so,
            },
            severity=Severity.ERROR
            if told and abs(ahead) > model.settings.cache_time
            else Severity.NOTE
            if abs(ahead) < limits["certain"] * NANOSECONDS
            else None,
            fixes=(cure_of_offset(model),),
            alone=True,
        )
    if not alike:
        yield from _groups_apart(model, limits)


def _is_far_off(model: Model, heard: Heard, limits: Limits) -> bool:
    """Whether all messages of a topic have a latency that no queue causes, equal to within 1 %."""
    is_judged = model.shift is None and not heard.families[0] and not heard.type.startswith(REPORTS)
    if not is_judged or len(heard.stamps) < limits["samples"]:
        return False
    low, high = (int(percentile(heard.latency, percent)) for percent in (5, 95))
    off = abs(heard.median_latency)
    return off > limits["far"] * NANOSECONDS and high - low < off // 100


def _same(known: Iterable[Duration], ahead: Duration) -> Duration:
    """Return the first of some offsets that is about equal to `ahead`, else `ahead`.

    Offsets of one clock differ by the streams' own delays: compared with days, seconds are such a
    delay.
    """
    near = max(_ONE_CLOCK, min(seconds(1), abs(ahead) // 100), abs(ahead) // 10_000)
    return next((one for one in known if abs(one - ahead) < near), ahead)


def _is_shared(model: Model, aheads: Sequence[Duration]) -> bool:
    """Whether all streams are ahead of reception by nearly the same time, on two or more topics.

    Args:
        model: Model of the evidence.
        aheads: Times by which the reported streams are ahead, nanoseconds.
    """
    streams: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    late = [one.median_latency for one in streams if len(one.stamps) > 2]
    topics = {one.topics if isinstance(one, Track) else one.topic for one in streams}
    return (
        len(aheads) == 1
        and aheads[0] > 0
        and len(topics) > 1
        and all(abs(one + aheads[0]) < seconds(0.01) for one in late)
    )


def _is_of_transforms(model: Model, ahead: Duration) -> bool:
    """Whether the stamps of all moving transforms are about `ahead` nanoseconds after reception."""
    moving = [one for one in model.dynamic if one.moves and not one.is_localisation]
    return bool(moving) and all(_same([ahead], -one.median_latency) == ahead for one in moving)


def _is_unshifted(model: Model, heard: Heard) -> bool:
    """Whether a topic is on the recorder's clock, while most stamps are shifted from that clock."""
    is_judged = len(heard.stamps) >= 3 and heard.is_spatial and model.shift is not None
    by = 0 if model.shift is None else model.shift.by
    return is_judged and 2 * abs(heard.median_latency) > abs(by)


def _shifted_names(model: Model, shift: Shift, others: Sequence[Track | Heard]) -> tuple[str, str]:
    """Return the names of the streams with the shift, and "is" or "are".

    Args:
        model: Model of the evidence.
        shift: The shift.
        others: Streams on the recorder's clock.
    """
    streams: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    near = max(_JITTER, abs(shift.by) // 10_000)
    names = dict.fromkeys(
        one.name
        for one in streams
        if one not in others and len(one.stamps) > 2 and abs(one.median_latency) < near
    )
    return several(tuple(names), 3), "is" if len(names) == 1 else "are"


def _on_both_clocks(model: Model, streams: Sequence[Track | Heard]) -> str:
    """Return a sentence for each edge whose samples come from two clocks; "" without such edges.

    One publisher of the edge uses the wrong clock, another the clock of the other streams.
    """
    told = ""
    for track in streams:
        near = np.abs(4 * track.latency) < abs(0 if model.shift is None else model.shift.by)
        if isinstance(track, Track) and np.mean(near) > _BOTH:
            told += (
                f"; {track.name} is on two clocks: {np.count_nonzero(near):,} of its samples are "
                "on the clock of the others"
            )
    return told


def cure_of_offset(model: Model) -> Fix:
    """Return the remedy for stamps that differ from the time of reception."""
    # Data that was recorded before is stamped before its reception, by at least its own length.
    is_old = model.shift is not None and model.shift.by > model.end - model.start
    if model.was_played or (is_old and model.evidence.played):
        return _PLAY_AGAIN
    return _LOOKS_THE_SAME if is_old else COMPARE_CLOCKS


def _groups_apart(model: Model, limits: Limits) -> Iterator[Hit]:
    """Yield a hit if steady streams form groups whose clocks differ by a constant."""
    steady: list[tuple[int, str]] = []
    streams: list[Track | Heard] = [t for t in model.dynamic if not t.is_localisation]
    streams += [heard for heard in model.heard if heard.is_spatial]
    for one in streams:
        if len(one.stamps) < limits["samples"] or one.families[0]:
            continue  # a simulation has a single clock
        least, high = int(one.latency.min()), percentile(one.latency, 95)
        # Stamping ahead is a choice; a scan stamped with its start arrives one period later.
        if least < -limits["spread"] * NANOSECONDS or _is_one_period(one):
            continue
        if high - least < limits["spread"] * NANOSECONDS:
            steady.append((least, one.name))
    steady.sort()
    groups: list[list[tuple[int, str]]] = []
    for item in steady:
        if not groups or item[0] - groups[-1][-1][0] > limits["apart"] * NANOSECONDS:
            groups.append([])
        groups[-1].append(item)
    if len(groups) > 1:
        lines = [f"{', '.join(name for _, name in g[:5])}: {span(g[0][0])}" for g in groups]
        yield Hit(
            topics=tuple(name for g in groups[1:] for _, name in g if name.startswith("/")),
            severity=Severity.NOTE,
            confidence=Confidence.LIKELY,
            facts={
                "topic": groups[-1][0][1],
                "ahead": groups[-1][0][0] - groups[0][0][0],
                "groups": lines,
                "sources": "",
                "found": f"arrives {span(groups[-1][0][0] - groups[0][0][0])} later than the "
                "others, steadily: a delay in its driver, or another clock",
                "so": "a timeout helps against a delay, but not against a wrong clock",
            },
            fixes=(COMPARE_CLOCKS,),
            alone=True,
        )


def _is_one_period(stream: "Track | Heard") -> bool:
    """Whether the median latency of a stream is about one period of the stream."""
    if isinstance(stream, Track):
        period = float(stream.period)
    else:
        steps = np.diff(np.sort(stream.stamps))
        period = float(np.median(steps)) if len(steps) else 0.0
    return 0.5 * period < stream.median_latency < 1.2 * period


def _offsets(model: Model) -> list[str]:
    """Return a line for each group of streams whose latency, rounded to 20 ms, is equal.

    The latencies are those against the recorder's clock. A topic without positions whose latencies
    differ, as if two computers sent it, is left out.
    """
    grouped: dict[int, list[str]] = defaultdict(list)
    streams: list[Track | Heard] = [*model.dynamic, *model.heard]
    for one in streams:
        near = abs(one.latency - one.median_latency) < max(_JITTER, abs(one.median_latency) // 100)
        has_one_clock = isinstance(one, Track) or one.is_spatial or np.mean(near) > _MOST
        if len(one.stamps) > 2 and has_one_clock:
            by = model.shift.by if model.shift is not None and one.families[1] else 0
            grouped[round((one.median_latency + by) / seconds(0.02))].append(one.name)
    # Hours that differ by milliseconds are printed alike.
    told: dict[str, list[str]] = defaultdict(list)
    for step, names in sorted(grouped.items()):
        told[span(step * 20_000_000)] += names
    return [f"{several(list(dict.fromkeys(names)), 4)}: {late}" for late, names in told.items()]
