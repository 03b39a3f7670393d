"""Checks of stamps: two clocks, time that goes back, stamps that stand still."""

from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, Duration, seconds
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import STALE_AFTER, Area, Confidence, Fact, Fix, Hit, Severity
from tftool.doctor.missing_joins import quoted
from tftool.doctor.model import Limits, Model
from tftool.doctor.ros_words import is_ros1
from tftool.doctor.stamp_stream import JOINT_STATES, Heard, Track, unsorted_share
from tftool.doctor.wording import several, span
from tftool.recordings.contract import Stamps

check = checks_of(Area.CLOCKS)

_SYNCHRONISE = (
    Fix(
        "synchronise the clocks: chrony with one computer as server, PTP for lidars, or "
        "the driver's timestamp mode"
    ),
    Fix("a larger timeout does not help against a constant offset"),
)
_SET_CLOCK = Fix(
    "set the clock of the computer that is off (chronyc tracking shows it): give it NTP or chrony"
)
_PLAY_AGAIN = Fix(
    "a recording was probably played beside nodes that run on the present time: {play_again}"
)
_BOTH = 0.05
"""Fraction of an edge's samples on another clock above which they come from a second source."""
_PLAYED = seconds(3600)
"""Offset of stamps from which old data is likelier than two clocks."""
_COMPARE = (
    Fix(
        "compare the clocks of the two computers (chronyc tracking); if they agree, or both "
        "are one computer, the node needs that time: wait for it"
    ),
)

_ONE_CLOCK = seconds(0.05)
"""Maximum difference between two offsets, nanoseconds, that belong to one clock."""

CONSTANTS_AHEAD = seconds(1)
"""Maximum time by which ROS 1 may stamp static frames ahead; robot_state_publisher uses 0.5 s."""


@check(
    "clock-mixture",
    Severity.ERROR,
    rule="stamps below and above 10⁸ s occur together in transforms, joint states and "
    "messages with a position; the wrong ones are those that differ from /clock, or "
    "else the smaller group",
    headline="{where} {concerned:is|are} stamped with {odd_clock}, all others with {usual_clock}",
    detail="for example {odd_stamp:dated} beside {usual_stamp:dated}",
    consequence="no lookup across the two clocks can succeed",
    causes=(
        "one node without use_sim_time",
        "simulated time set on a real robot",
        "a computer without a clock of its own, which counts from 1970",
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
    # Without /clock there is no simulation that the other nodes follow.
    is_unset = sim_is_odd and not len(read)
    setting = "false" if sim_is_odd else "true"
    odd_clock = "a clock that was never set" if is_unset else "the simulation's clock"
    yield Hit(
        edges=tuple(track.edge for track in tracks),
        topics=tuple(sorted({heard.topic for heard in heards})),
        publishers=tuple(sorted({node for track in tracks for node in track.nodes})),
        since=min(int(one.logs[0]) for one in odd),
        count=sum(one.families[0 if sim_is_odd else 1] for one in odd),
        facts={
            "odd": [one.name for one in odd],
            "odd_stamp": sample,
            "usual_stamp": usual,
            "odd_clock": odd_clock if sim_is_odd else "the wall clock",
            "usual_clock": "the wall clock" if sim_is_odd else "the simulation's",
            "setting": setting,
        },
        fixes=(_SET_CLOCK if is_unset else Fix(model.words["sim_time"].format(setting=setting)),),
        alone=True,
    )


def _placed(model: Model) -> list[Heard]:
    """Return the messages with a position, which are looked up, and joint states.

    Messages without a position, such as diagnostics and logs, are never looked up.
    """
    return [one for one in model.heard if one.is_spatial or one.type == JOINT_STATES]


def _stamps(group: "list[Track | Heard]", family: int) -> int:
    return sum(one.families[family] for one in group)


def _example(group: "list[Track | Heard]", simulated: bool) -> int:
    stamps = group[0].stamps
    mask = (stamps != 0) & ((stamps < SIMULATED_BELOW) == simulated)
    return int(stamps[mask][0])


@check(
    "shifted-clock",
    Severity.NOTE,
    rule="more than half of all streams are stamped by one constant of more than 2 s before "
    "or after their reception, to within 1 s",
    headline="{most} stamps are {by:span} {side} their reception, constant to {spread:span}",
    detail="{streams} of {of} streams; latencies and the cache are judged against the clock of the "
    "stamps",
    consequence="none for lookups within the recording; a live listener on another computer "
    "refuses all of it",
    fixes=(Fix("set the clock of the robot (chrony, NTP), if it was not played again on purpose"),),
    causes=(
        "the robot's clock was never set: it has no battery and no network",
        "the recording was played again and recorded anew",
    ),
    needs=("log times",),
    why="one constant for all streams is a wrong clock, not a fault of a publisher",
    because_of=(("anything", "time-jump-back"),),
)
def shifted_clock(model: Model, limits: Limits) -> Iterator[Hit]:
    """All stamps differ from their reception by one constant."""
    if model.shift is None or model.unshifted:
        return  # `clock-offset` tells of the two clocks
    yield Hit(
        since=model.start,
        count=model.shift.streams,
        facts={
            "by": abs(model.shift.by),
            "side": "before" if model.shift.by > 0 else "after",
            "spread": model.shift.spread,
            "streams": model.shift.streams,
            "of": model.shift.of,
            "most": "all" if model.shift.streams == model.shift.of else "most",
        },
        alone=True,
    )


@check(
    "future-stamp",
    Severity.WARNING,
    rule="the median latency of a transform is below -{seconds:g} s (for a transform from "
    "map to odometry: -{localisation:g} s); a note from -{note:g} s on. Not reported if"
    " it is ahead by its own period, or is a constant that is up to 1 s ahead",
    headline="{where} {concerned:is|are} dated {ahead:span} ahead of {concerned:its|their} arrival",
    detail="{edge}: {ahead:span} ahead (median){clock}",
    consequence="the latest common time is in the future: a lookup of the latest transform combines"
    " different moments",
    fixes=(
        Fix(
            "lower the tolerance that is added to its stamp (transform_tolerance, "
            "transform_time_offset), or set the publisher's clock"
        ),
    ),
    causes=(
        "a tolerance that is too large",
        "the publisher's clock is ahead",
    ),
    links=threads("ros-navigation/navigation2#3166"),
    limits={"seconds": 0.25, "localisation": 2.0, "note": 0.02},
    needs=("log times",),
    why="AMCL stamps its transform 1 s ahead, and offsets of 0.1 s are in use; ROS 1's "
    "static publishers and gmapping stamp theirs one period ahead, its "
    "robot_state_publisher fixed joints 0.5 s",
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
            yield _ahead(model, track, ahead, Severity.WARNING)
        elif not track.is_localisation and ahead > limits["note"] * NANOSECONDS:
            yield _ahead(model, track, ahead, Severity.NOTE)


def _by_design(track: Track, ahead: int) -> bool:
    """Whether a transform is stamped ahead on purpose: ROS 1 uses it until the next."""
    if ahead <= 1.2 * track.period:
        return True
    return not track.moves and ahead <= CONSTANTS_AHEAD


def _ahead(model: Model, track: Track, ahead: int, severity: Severity) -> Hit:
    # If a computer's clock is wrong, all its streams are ahead by the same amount.
    others: list[Track | Heard] = [h for h in model.heard if h.is_spatial]
    others += [t for t in model.dynamic if t.nodes and not set(t.nodes) & set(track.nodes)]
    also = [
        other.name
        for other in others
        if abs(-other.median_latency - ahead) < max(0.02e9, 0.1 * ahead)
    ]
    told = f"; so are {several(also)}: their computer's clock is ahead" if also else ""
    return hit_of(track, {"ahead": ahead, "also": also, "clock": told}, severity=severity)


@check(
    "wild-stamp",
    Severity.WARNING,
    rule="at most one stamp in a hundred, or a single one, differs by more than an hour from"
    " the stamps of the messages before and after",
    headline="{where} {concerned:has|have} a stamp that lies {off:span} {side} the others",
    detail="{what}: {count} of {of}, {stamp:dated}",
    consequence="after a transform stamped ahead, tf2 drops further ones until time reaches it; one"
    " stamped behind is dropped itself",
    fixes=(
        Fix(
            "check the source of the publisher's stamps; `tftool edit --from A --to B` "
            "removes everything stamped outside from a recording"
        ),
    ),
    causes=(
        "memory that was never set, or a number read with the wrong bytes",
        "one message stamped before the clock was set",
    ),
    needs=("log times",),
    why="for a late message or a slow clock the difference is seconds, and other messages "
    "have it too",
)
def wild_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Single stamps differ greatly from those before and after."""
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
        yield hit_of(one, facts, since=int(one.logs[place]), count=len(places))


@check(
    "stale-stamp",
    Severity.WARNING,
    rule="the median latency is above {transforms:g} s for a transform (an error above the "
    "cache time) or {messages:g} s for messages",
    headline="{where} {concerned:is|are} dated {late:span} before {concerned:its|their} arrival",
    detail="{what}: {late:span} late (median)",
    consequence="lookups at the present time refuse; in rviz the frame lags or disappears",
    causes=(
        "the stamp is copied from an old measurement",
        "the publisher's clock is behind",
        "a slow network",
    ),
    links=threads("cartographer-project/cartographer_ros#143"),
    limits={"transforms": STALE_AFTER, "messages": 2.0},
    needs=("log times",),
    because_of=(
        ("anything", "time-jump-back"),
        ("stream", "clock-mixture"),
        ("stream", "cache-short"),
        ("stream", "clock-offset"),
    ),
)
def stale_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms or messages are stamped long before they arrive."""
    cache = model.settings.cache_time
    for track in model.dynamic:
        least = limits["transforms"] * NANOSECONDS
        if track.is_localisation:
            least = max(least, track.period)
        if len(track.stamps) > 1 and track.median_latency > least and not stands_still(track):
            severity = Severity.ERROR if track.median_latency > cache else Severity.WARNING
            yield _late(model, track, track.name, severity)
    for heard in model.heard:
        # A latched message may be old, and without motion an old message is as good as a new one.
        if len(heard.stamps) < 3 or not heard.is_spatial or model.rests(heard.frame):
            continue
        if heard.median_latency > limits["messages"] * NANOSECONDS and not stands_still(heard):
            yield _late(model, heard, heard.topic, Severity.WARNING)


_STEADY = seconds(0.1)
"""Maximum variation, from 10 % to 90 % quantile, of a delay that no queue causes."""


def _late(model: Model, stream: "Track | Heard", name: str, severity: Severity) -> Hit:
    low, high = (int(one) for one in np.percentile(stream.latency, (10, 90)))
    cure = (
        "stamp each transform when it is made, not with the last measurement's stamp; compare the "
        "clocks (chronyc tracking)"
    )
    queues = f"the delay varies by {span(high - low)}" if high - low > _STEADY else ""
    for other in model.heard:
        # Nobody dates a transform by a message that has not come.
        soon = 4 * abs(other.median_latency) < stream.median_latency
        if soon and np.isin(stream.stamps, other.stamps).mean() > 0.5:
            queues = f"{other.topic} has the same stamps, {span(other.median_latency)} late"
    if queues:
        cure = (
            f"{queues}: these messages wait in a queue, and no clock is wrong; look for a slow "
            "network, a slow recorder or a busy computer; send less, or record on the robot"
        )
    facts = {"what": name, "late": stream.median_latency}
    return hit_of(stream, facts, severity=severity, fixes=(Fix(cure),))


@check(
    "clock-offset",
    Severity.WARNING,
    rule="the median latency of a sensor's messages is below -{seconds:g} s (for a laser "
    "scan: less one scan), or messages or transforms are on the recorder's clock in a recording "
    "that is shifted as a whole. A note if steady streams (95 % within {spread:g} s, "
    "{samples:g} messages), none ahead and each later than its own period, form groups "
    "more than {apart:g} s apart",
    headline="{topic} {found}",
    detail="{groups}{sources}",
    consequence="{so}",
    causes=(
        "robot base and single-board computer",
        "robot and desk computer",
        "a lidar in its own time",
    ),
    links=threads(
        "turtlebot/turtlebot4_robot#8", "DFKI-NI/mir_robot#7", "ROBOTIS-GIT/turtlebot3#618"
    ),
    limits={"seconds": 0.02, "spread": 0.02, "apart": 0.05, "samples": 20},
    needs=(
        "log times",
        "headers",
    ),
    why="a message cannot arrive before it is made; rounding of stamps is below 20 ms, and "
    "a scan may be stamped with its end",
    because_of=(("stream", "clock-mixture"),),
)
def clock_offset(model: Model, limits: Limits) -> Iterator[Hit]:
    """A sensor's stamps are in the future: two clocks differ."""
    alike: dict[int, list[Track | Heard]] = defaultdict(list)
    for track in model.unshifted:
        ahead = -track.median_latency
        near = max(_ONE_CLOCK, abs(ahead) // 10_000)
        same = next((one for one in alike if abs(one - ahead) < near), ahead)
        alike[same].append(track)
    for heard in model.heard:
        if len(heard.stamps) < 3 or not heard.is_spatial:
            continue
        allowed = limits["seconds"] * NANOSECONDS
        if heard.type == "sensor_msgs/LaserScan":
            # Some drivers stamp a scan with the time of its end, some with that of its start.
            steps = np.diff(np.sort(heard.stamps))
            allowed += float(np.median(steps)) if len(steps) else 0.0
        ahead = -heard.median_latency
        # In a recording with a shift, a stream with the right clock differs from all others.
        is_off = model.shift is not None and 2 * abs(ahead) > abs(model.shift.by)
        if ahead > allowed or is_off:
            same = next((one for one in alike if abs(one - ahead) < _ONE_CLOCK), ahead)
            alike[same].append(heard)
    groups = _offsets(model) if alike else []
    other = "the other clocks" if len(groups) > 1 else "the recorder's clock"
    for ahead, streams in alike.items():
        names = tuple(dict.fromkeys(one.name for one in streams))
        heards = [one for one in streams if isinstance(one, Heard)]
        told = ""
        if model.shift is not None and len(heards) < len(streams):
            told = f": {model.shift.streams} of {model.shift.of} streams are not on the recorder's"
        twice, sources = _on_both_clocks(model, streams)
        yield Hit(
            edges=tuple(one.edge for one in streams if isinstance(one, Track)),
            topics=tuple(dict.fromkeys(heard.topic for heard in heards)),
            frames=tuple(dict.fromkeys(heard.frame for heard in heards)),
            since=min(int(one.logs[0]) for one in streams),
            count=sum(len(one.stamps) for one in streams),
            facts={
                "topic": several(names),
                "ahead": ahead,
                "groups": groups,
                "sources": sources,
                "found": f"{'is' if len(names) == 1 else 'are'} {span(abs(ahead))} off {other}"
                + told,
                "so": "no lookup across the two clocks can succeed"
                if told
                else "each lookup at these stamps asks for what is not there"
                + (" yet, by the same amount for ever" if ahead > 0 else " any more"),
            },
            fixes=(*cures_of_offset(model, ahead), *twice),
            alone=True,
        )
    if not alike:
        yield from _groups_apart(model, limits)


def _on_both_clocks(model: Model, streams: Sequence[Track | Heard]) -> tuple[tuple[Fix, ...], str]:
    """Return remedies and evidence for edges that also have samples on the other streams' clock."""
    fixes, told = [], ""
    for track in streams:
        near = np.abs(4 * track.latency) < abs(0 if model.shift is None else model.shift.by)
        if isinstance(track, Track) and np.mean(near) > _BOTH:
            told += (
                f"; {track.name} has two sources, {np.count_nonzero(near):,} of its samples are "
                "on the clock of the others"
            )
            drop = quoted(f"{track.parent}:{track.child}")
            fixes.append(
                Fix(
                    f"stop one of the two; from a recording that is played, take {track.name} out:",
                    f"tftool edit RECORDING -o CLEAN --drop {drop}",
                )
            )
    return tuple(fixes), told


def cures_of_offset(model: Model, ahead: Duration) -> tuple[Fix, ...]:
    """Return the remedies for two clocks, or for old data if stamps are long before reception."""
    if abs(ahead) < _PLAYED:
        return _SYNCHRONISE
    # What was recorded before is stamped before its reception.
    is_old = model.shift is not None and model.shift.by > 0
    return (_PLAY_AGAIN if is_old else _SET_CLOCK,)


def _groups_apart(model: Model, limits: Limits) -> Iterator[Hit]:
    """Yield a hit if steady streams form groups whose clocks differ by a constant."""
    steady: list[tuple[int, str]] = []
    streams: list[Track | Heard] = [t for t in model.dynamic if not t.is_localisation]
    streams += [heard for heard in model.heard if heard.is_spatial]
    for one in streams:
        if len(one.stamps) < limits["samples"] or one.families[0]:
            continue  # a simulation has a single clock
        least, high = int(one.latency.min()), float(np.percentile(one.latency, 95))
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
                "so": "a delay is waited for; a clock that is off stays off",
            },
            fixes=_COMPARE,
            alone=True,
        )


def _is_one_period(stream: "Track | Heard") -> bool:
    """Whether a stream arrives about one of its periods after its stamps."""
    if isinstance(stream, Track):
        period = float(stream.period)
    else:
        steps = np.diff(np.sort(stream.stamps))
        period = float(np.median(steps)) if len(steps) else 0.0
    return 0.5 * period < stream.median_latency < 1.2 * period


def _offsets(model: Model) -> list[str]:
    """Return sentences about groups of streams with similar latency, in steps of 20 ms."""
    grouped: dict[int, list[str]] = defaultdict(list)
    streams: list[Track | Heard] = [*model.dynamic, *model.heard]
    for one in streams:
        if len(one.stamps) > 2:
            grouped[round(one.median_latency / seconds(0.02))].append(one.name)
    return [
        f"{', '.join(dict.fromkeys(names[:4]))}: {span(step * 20_000_000)}"
        for step, names in sorted(grouped.items())
    ]


@check(
    "zero-stamp",
    Severity.WARNING,
    rule="a transform on a dynamic topic has stamp 0",
    headline="{where} {concerned:has|have} stamp 0",
    detail="{edge}: {count} of {of} samples",
    consequence="lookups at any other time refuse; in a query, 0 means the latest time",
    fixes=(Fix("stamp it: t.header.stamp = {now}, inside the loop"),),
    causes=(
        "the stamp is never set",
        "use_sim_time without /clock",
    ),
)
def zero_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """A moving frame with stamp 0."""
    for track in model.dynamic:
        zeros = np.flatnonzero(track.stamps == 0)
        if len(zeros):
            yield hit_of(
                track,
                {"count": len(zeros), "of": len(track.stamps)},
                since=int(track.logs[zeros[0]]),
                count=len(zeros),
            )


@check(
    "frozen-stamp",
    Severity.WARNING,
    rule="one stamp is sent {times:g} times or more, while the clock of the stamps goes on by "
    "more than {seconds:g} s; messages only if a moving transform places them",
    headline="{where} {concerned:repeats|repeat} one stamp",
    detail="{what}: {stamp:moment} {count:times}, for {lasted:span}",
    consequence="{so}",
    causes=(
        "the stamp is set once, before the loop: set it inside",
        "a localiser that has had no scan since: find out why, and do not stamp it anew",
    ),
    limits={"times": 10, "seconds": 1.0},
    needs=("log times",),
    why="while a slow simulation's clock stands still, stamps repeat as they should",
    because_of=(("edge", "zero-stamp"),),
)
def frozen_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """A stamp is repeated without change."""
    streams: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    for one in streams:
        frozen = _frozen(one, limits)
        if frozen is None:
            continue
        stamp, count, lasted = frozen
        facts: dict[str, Fact] = {
            "what": one.name,
            "count": count,
            "stamp": stamp,
            "lasted": lasted,
        }
        if isinstance(one, Track):
            facts["so"] = "lookups at any other time refuse: the buffer holds only that stamp"
        elif one.frame not in model.frames or model.rests(one.frame):
            continue
        else:
            facts["so"] = (
                "each is placed where its frame was at that time, and refused once the cache has "
                "forgotten it"
            )
        # A localiser has another remedy.
        alone = isinstance(one, Heard) or one.is_localisation
        yield hit_of(one, facts, count=count, alone=alone, fixes=(_unfreeze(model, one),))


def _unfreeze(model: Model, stream: "Track | Heard") -> Fix:
    """Return the remedy for a stamp that does not change."""
    if isinstance(stream, Track) and stream.is_localisation:
        # A localiser's stamp is that of its last scan: a newer stamp would be wrong.
        return Fix(
            "look at the scan topic and its transforms: a localiser repeats the stamp of the last "
            "scan it could use, so find out why its scans stopped; do not stamp it anew"
        )
    name = "t" if isinstance(stream, Track) else "message"
    return Fix(f"set the stamp inside the loop: {name}.header.stamp = {{now}}")


def stands_still(stream: "Track | Heard") -> bool:
    """Whether `frozen-stamp` reports a stream, so that advice about clocks and caches is wrong."""
    return _frozen(stream, _FROZEN) is not None


def _frozen(stream: "Track | Heard", limits: Limits) -> tuple[int, int, int] | None:
    """Return a repeated stamp, its count, and its duration on the clock of the stamps; or None."""
    stamps = stream.stamps
    if limits["times"] > 1 and not (stamps[1:] == stamps[:-1]).any():
        return None
    stamped = stamps != 0
    if np.count_nonzero(stamped) < max(limits["times"], 1):
        return None
    values, counts = np.unique(stamps[stamped], return_counts=True)
    most = int(np.argmax(counts))
    if counts[most] < limits["times"]:
        return None
    arrivals = stream.arrivals[stamps == values[most]]
    lasted = int(arrivals.max() - arrivals.min())
    if lasted <= limits["seconds"] * NANOSECONDS:
        return None
    return int(values[most]), int(counts[most]), lasted


_FROZEN = {"times": 10, "seconds": 1.0}


@check(
    "repeated-stamp",
    Severity.WARNING,
    rule="more than {samples:g} samples, and a share above {share:g}, repeat a stamp with "
    "any value. In ROS 2 only samples with another value count, and no transform from map to "
    "odometry is reported",
    headline="{where} {concerned:repeats|repeat} stamps",
    detail="{edge}: {count} of {of} samples repeat a stamp",
    consequence="{repeats}",
    fixes=(
        Fix("send a transform only when its stamp is newer than the last one's"),
        Fix(
            "where two nodes send it (a simulator's wheels and robot_state_publisher), switch one "
            "off: `{publishers} /tf` lists them"
        ),
    ),
    causes=(
        "a filter publishes faster than its data",
        "the same pose is sent once per sensor",
        "two nodes with one frame",
    ),
    links=threads("at-wat/neonavigation#612", "uf-mil/mil#1097"),
    limits={"samples": 2, "share": 0.05},
    because_of=(
        ("anything", "time-jump-back"),
        ("child", "publisher-conflict two-parents"),
    ),
)
def repeated_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Stamps are sent twice: TF_REPEATED_DATA in ROS 1."""
    is_old = is_ros1(model.evidence)
    for track in model.dynamic:
        places = track.by_stamp
        if track.is_orderly or (track.is_localisation and not is_old):
            continue  # a localiser of ROS 2 repeats the pose of the last scan on purpose
        again = np.flatnonzero(np.diff(track.sorted_stamps) == 0)
        if len(again) <= limits["samples"] or stands_still(track):
            continue
        some, others = places[again], places[again + 1]
        differ = (track.apart(some, others) > 1e-6) | (track.turned(some, others) > 1e-4)
        told = differ | is_old  # ROS 2 ignores equal ones
        count = int(np.count_nonzero(told))
        if count > limits["samples"] and count > limits["share"] * len(places):
            yield hit_of(
                track,
                {"count": count, "of": len(places)},
                since=int(track.logs[some[told]].min()),
                count=count,
            )


@check(
    "time-jump-back",
    Severity.ERROR,
    rule="within 1 s, at least two streams and half of all step back by more than 1 s",
    headline="time went back by {back:span}, {count:times}",
    detail="at log time {moment:moment}: from {before:moment} to {after:moment}, {streams} "
    "streams; all that follows is about what came before",
    consequence="{jumped_back}",
    fixes=(Fix("{play_again}"),),
    causes=(
        "play --loop",
        "a simulation was reset",
        "NTP set the clock back while running",
    ),
    links=threads("ros2/geometry2#606", "ros/geometry2#43"),
    needs=("log times",),
    why="a looped recording would trigger forty other checks, so all of them use only the "
    "first pass",
)
def time_jump_back(model: Model, limits: Limits) -> Iterator[Hit]:
    """Time went back: a looped bag, a reset simulation."""
    if not model.laps:
        return
    first = model.laps[0]
    yield Hit(
        since=first.log,
        until=model.laps[-1].log,
        count=len(model.laps),
        facts={
            "moment": first.log,
            "before": first.before,
            "after": first.after,
            "back": first.before - first.after,
            "streams": first.streams,
            "count": len(model.laps),
        },
        alone=True,
    )


@check(
    "old-data",
    Severity.WARNING,
    rule="a sample is older than the newest of its frame by more than the cache (--cache-time)",
    headline="{where} {concerned:sends|send} samples that are too old to be kept",
    detail="{edge}: {count:times}, up to {behind:span} behind",
    consequence="tf2 drops them and warns TF_OLD_DATA",
    fixes=(Fix("restart the publisher that still has the old clock; or clear the buffer"),),
    causes=(
        "a restarted publisher or simulation",
        "a replayed recording beside the live robot",
    ),
    links=threads("ros/geometry2#43"),
    because_of=(
        ("anything", "time-jump-back"),
        ("child", "publisher-conflict two-parents"),
        ("edge", "wild-stamp clock-offset"),
    ),
)
def old_data(model: Model, limits: Limits) -> Iterator[Hit]:
    """Samples are older than the cache allows: TF_OLD_DATA."""
    by_child: dict[str, list[Track]] = defaultdict(list)
    for track in model.dynamic:
        by_child[track.child].append(track)
    for tracks in by_child.values():
        if len(tracks) == 1 and tracks[0].is_orderly:
            continue
        stamps, newest = _newest_before(tracks)
        old = (stamps < newest - model.settings.cache_time) & (stamps != 0)
        if old.any():
            logs = np.sort(np.concatenate([track.logs for track in tracks]), kind="stable")
            behind = int((newest - stamps)[old].max())
            count = int(np.count_nonzero(old))
            yield Hit(
                edges=tuple(track.edge for track in tracks),
                publishers=tuple(sorted({n for track in tracks for n in track.nodes})),
                since=int(logs[np.flatnonzero(old)[0]]),
                count=count,
                facts={"edge": tracks[0].name, "count": count, "behind": behind},
            )


def _newest_before(tracks: "list[Track]") -> tuple[Stamps, Stamps]:
    """Return stamps in order of arrival, and the newest stamp of the same clock up to each."""
    stamps = np.concatenate([track.stamps for track in tracks])
    if len(tracks) > 1:
        logs = np.concatenate([track.logs for track in tracks])
        stamps = stamps[np.argsort(logs, kind="stable")]
    is_sim = stamps < SIMULATED_BELOW
    # Compare stamps of each clock separately: a mixture of clocks is another fault.
    low = np.iinfo(np.int64).min // 2
    of_sim = np.maximum.accumulate(np.where(is_sim, stamps, low))
    of_wall = np.maximum.accumulate(np.where(is_sim, low, stamps))
    return stamps, np.where(is_sim, of_sim, of_wall)


@check(
    "out-of-order",
    Severity.NOTE,
    rule="more than {samples:g} samples, and a share above {share:g}, are older than an "
    "earlier one",
    headline="{where} {concerned:arrives|arrive} out of order",
    detail="{edge}: {count} of {of} samples",
    consequence="harmless to tf2; a sign of threads, a second publisher, a lossy network, or a "
    "message filter that released many scans at once",
    limits={"samples": 2, "share": 0.01},
    because_of=(
        ("anything", "time-jump-back"),
        ("stream", "clock-mixture"),
        ("child", "publisher-conflict two-parents"),
        ("edge", "wild-stamp clock-offset repeated-stamp"),
        ("frame", "sensor-outruns-tf"),
    ),
)
def out_of_order(model: Model, limits: Limits) -> Iterator[Hit]:
    """Samples arrive in another order than their stamps, within the cache time."""
    for track in model.dynamic:
        count = unsorted_share(track.stamps)
        if count > limits["samples"] and count > limits["share"] * len(track.stamps):
            # A localiser sends late what it could place late.
            waited = (track.child,) if track.is_localisation else ()
            facts = {"count": count, "of": len(track.stamps)}
            yield hit_of(track, facts, since=None, count=count, frames=waited)
