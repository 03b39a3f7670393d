"""Checks of stamps: zero, frozen, repeated, old and late stamps, and a wrong order."""

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, seconds
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import Area, Fact, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import Heard, Places, Track, unsorted_share
from tftool.doctor.wording import is_ros1, metres
from tftool.recordings.contract import Stamps, percentile
from tftool.recordings.description_frames import description_topics

check = checks_of(Area.CLOCKS)

COMPARE_CLOCKS = Fix("compare the clocks of the computers (`date`, `chronyc tracking`)")
"""Remedy if the stamps of a computer differ from the clock of another computer."""


@check(
    "zero-stamp",
    Severity.WARNING,
    rule="a transform on a dynamic topic has stamp 0, or all messages of a sensor, {messages:g} or "
    "more. A note for a sensor whose frame is in no transform",
    headline="{where} {concerned:has|have} stamp 0",
    detail="{what}: {count} of {of} {kind}",
    consequence="{so}; in a lookup, 0 means the latest time",
    fixes=(Fix("{find_unset}"),),
    causes=(
        "the stamp is never set",
        "use_sim_time without /clock",
    ),
    limits={"messages": 10},
)
def zero_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """A moving frame has stamp 0."""
    for track in model.dynamic:
        zeros = np.flatnonzero(track.stamps == 0)
        if len(zeros):
            so = "lookups do not use these samples"
            if len(zeros) == len(track.stamps):
                so = "lookups at any other time fail"
            yield hit_of(
                track,
                {
                    "what": track.name,
                    "count": len(zeros),
                    "of": len(track.stamps),
                    "kind": "samples",
                    "so": so,
                },
                since=int(track.logs[zeros[0]]),
                count=len(zeros),
                group=so,
            )
    for heard in model.heard:
        count = len(heard.stamps)
        is_sensor = heard.type.startswith("sensor_msgs/") and heard.is_spatial
        if is_sensor and count >= limits["messages"] and not heard.stamps.any():
            so = "the latest transform places each message, whatever its age"
            facts: dict[str, Fact] = {"what": heard.topic, "tf_topic": heard.topic, "so": so}
            yield hit_of(
                heard,
                {**facts, "count": count, "of": count, "kind": "messages"},
                count=count,
                severity=None if heard.frame in model.frames else Severity.NOTE,
                group=so,
            )


@check(
    "frozen-stamp",
    Severity.WARNING,
    rule="one stamp is sent {times:g} times or more, while the newest stamp of all streams "
    "advances by more than {seconds:g} s. Messages are only reported if a moving transform "
    "places them. A note for messages that are not from a sensor",
    headline="{where} {concerned:repeats|repeat} one stamp",
    detail="{what}: {stamp:moment} {count:times}, for {lasted:span}",
    consequence="{so}",
    causes=(
        "the stamp is set once, before the loop",
        "a localiser that has had no scan since",
    ),
    limits={"times": 10, "seconds": 1.0},
    needs=("log times",),
    why="repeated stamps are correct while the clock of a slow simulation does not advance",
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
            facts["so"] = "lookups at later times fail while the stamp does not change"
            if count == len(one.stamps):
                facts["so"] = "lookups at any other time fail: the buffer holds only that stamp"
        elif one.frame not in model.frames or model.rests(one.frame):
            continue
        else:
            facts["so"] = (
                "each message is placed where its frame was at that stamp; its lookup fails once "
                "the cache has dropped this time"
            )
        # A result that is sent again is old on purpose, and a marker is only drawn.
        is_sensor = isinstance(one, Track) or one.type.startswith("sensor_msgs/")
        topic = one.topics[0] if isinstance(one, Track) else one.topic
        yield hit_of(
            one,
            facts,
            count=count,
            alone=isinstance(one, Heard) or one.is_localisation,
            severity=None if is_sensor else Severity.NOTE,
            fixes=(
                Fix(f"look at where its publisher takes its stamps from: `{{publishers}} {topic}`"),
            ),
            group=str(facts["so"]),
        )


def stands_still(stream: Track | Heard) -> bool:
    """Whether a stream repeats one stamp; the check `frozen-stamp` reports such a stream.

    Advice about clocks and caches would be wrong for such a stream.
    """
    return _frozen(stream, _FROZEN) is not None


def _frozen(stream: Track | Heard, limits: Limits) -> tuple[int, int, int] | None:
    """Find the stamp that a stream repeats most often.

    Returns:
        The stamp, the number of samples with this stamp, and the time from the first to the last of
        these samples, nanoseconds; None if no stamp is repeated for long.
    """
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
    rule="more than {samples:g} samples of a transform, and a share above {share:g}, repeat a "
    "stamp with a value that differs by {metres:g} m or {radians:g} rad. In ROS 1 noetic, "
    "whose tf2 prints a warning for each repeated stamp, any value counts. A note if all "
    "values are equal and the share is below {flood:g}. In ROS 2, transforms from map to "
    "odometry are not reported",
    headline="{where} {concerned:repeats|repeat} stamps",
    detail="{edge}: {count} of {of} samples repeat a stamp, {different} of them with a value that "
    "differs by more than {least:m} or {least_turn:deg} (at most {worst:m} and "
    "{most_turned:deg}){spikes}{by}",
    consequence="{so}",
    fixes=(
        Fix("look at how these stamps are made: `{publishers} {tf_topic}` lists the publishers"),
    ),
    causes=(
        "a filter publishes faster than its data",
        "the same pose is sent once per sensor",
        "two nodes with one frame",
    ),
    links=threads("at-wat/neonavigation#612", "uf-mil/mil#1097"),
    limits={"samples": 2, "share": 0.05, "flood": 0.25, "metres": 1e-3, "radians": 1e-3},
    because_of=(
        ("anything", "time-jump-back"),
        ("child", "publisher-conflict two-parents"),
    ),
)
def repeated_stamp(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms are sent twice with one stamp (TF_REPEATED_DATA in ROS 1)."""
    is_old = is_ros1(model.evidence)
    warns = is_old and model.evidence.end > _NOETIC
    for track in model.dynamic:
        places = track.by_stamp
        if track.is_orderly or (track.is_localisation and not is_old):
            continue  # a localiser of ROS 2 repeats the pose of the last scan on purpose
        again = np.flatnonzero(np.diff(track.sorted_stamps) == 0)
        if len(again) <= limits["samples"] or stands_still(track):
            continue
        some, others = places[again], places[again + 1]
        apart, turned = track.apart(some, others), track.turned(some, others)
        differ = (apart > limits["metres"]) | (turned > limits["radians"])
        told = differ | warns  # tf2 is silent about equal ones before noetic and in ROS 2
        different = int(np.count_nonzero(differ))
        is_silent = (
            is_old
            and different > limits["samples"]
            and np.count_nonzero(told) <= limits["share"] * len(places)
        )
        if is_silent:
            told = np.ones(len(again), dtype=np.bool_)
        count = int(np.count_nonzero(told))
        if count > limits["samples"] and count > limits["share"] * len(places):
            few = different <= limits["samples"] and count < limits["flood"] * len(places)
            so = "a lookup at such a stamp uses one of its poses"
            if is_silent:
                so = "tf2 keeps the first; from noetic on it prints TF_REPEATED_DATA for each"
            if warns:
                so = "tf2 drops them and prints TF_REPEATED_DATA for each"
            yield hit_of(
                track,
                {
                    "count": count,
                    "of": len(places),
                    "different": different,
                    "least": limits["metres"],
                    "least_turn": limits["radians"],
                    "worst": float(apart.max()),
                    "most_turned": float(turned.max()),
                    "spikes": _avoidable_spikes(track) if warns and different else "",
                    "so": so,
                    "by": f"; sent by {', '.join(track.nodes)}" if track.nodes else "",
                },
                since=int(track.logs[some[told]].min()),
                count=count,
                severity=Severity.NOTE if few or is_silent or model.is_minor(track) else None,
            )


def _avoidable_spikes(track: Track) -> str:
    """Return a clause about jumps out and back that vanish if the last sample of a stamp is kept.

    tf2 of ROS 1 noetic keeps the first of several samples with one stamp. The clause is empty if
    there are few such jumps.
    """
    is_new = np.diff(track.sorted_stamps) > 0
    first = _count_spikes(track, track.by_stamp[np.append(True, is_new)])
    last = _count_spikes(track, track.by_stamp[np.append(is_new, True)])
    if first < 3 or first < 2 * last:
        return ""
    return (
        f"; with the first sample of each stamp, which tf2 keeps, the frame jumps out and back by "
        f"{metres(_SPIKE)} or more {first} times, with the last one {last} times"
    )


def _count_spikes(track: Track, places: Places) -> int:
    """Count the samples that lie `_SPIKE` or more from both neighbours, which are near each other.

    Args:
        track: The edge's samples.
        places: Indices of the samples to compare, in order, shape (n,).
    """
    strides = track.apart(places[1:], places[:-1])
    least = np.minimum(strides[1:], strides[:-1])
    back = track.apart(places[2:], places[:-2])
    return int(np.count_nonzero((least >= _SPIKE) & (back < 0.5 * least)))


_SPIKE = 0.01
"""Minimum length of a step out and back, metres."""


@check(
    "sent-twice",
    Severity.WARNING,
    rule="a sensor or odometry sends {samples:g} messages or more in one frame, and {share:g} "
    "times as many messages as different stamps, or more. Or a transform is sent three times "
    "or more at once, with one stamp and value: the copies of a stamp arrive within {spread:g} of "
    "the step of the stamps (median). A note for a moving transform that is sent "
    "twice, unless the robot's description and statics came more than once too, and for messages "
    "other than laser scans, because their stamps may be those of a simulator's step or of a "
    "slower source",
    headline="{where} {concerned:sends|send} each message several times",
    detail="{topic}: {count} messages have {different} different stamps{also}",
    consequence="programs that use the topic process each message several times",
    limits={"share": 1.8, "samples": 20, "spread": 0.2},
    because_of=(
        ("anything", "time-jump-back"),
        ("stream", "frozen-stamp zero-stamp repeated-stamp"),
    ),
)
def sent_twice(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages of a sensor are sent more than once."""
    for heard in model.heard:
        is_sensor = heard.type.startswith("sensor_msgs/") or heard.type == "nav_msgs/Odometry"
        stamps = heard.stamps[heard.stamps != 0]
        if not is_sensor or len(stamps) < limits["samples"] or stands_still(heard):
            continue
        # Stamps are nearly in order, which makes sorting faster than a search for unique ones.
        different = 1 + int(np.count_nonzero(np.diff(np.sort(stamps, kind="stable"))))
        if len(stamps) >= limits["share"] * different:
            yield hit_of(
                heard,
                {"count": len(stamps), "different": different, "also": ""},
                severity=None if "LaserScan" in heard.type else Severity.NOTE,
                fixes=(Fix(f"count its publishers: `{{publishers}} {heard.topic}`"),),
            )
    for track in model.dynamic:
        stamps, different = track.sorted_stamps, 1 + len(track.steps)
        few = len(stamps) < limits["share"] * different or len(stamps) < limits["samples"]
        is_double = len(stamps) < (limits["share"] + 1.0) * different
        if few or not track.period or (is_double and not track.moves):
            continue
        again = np.flatnonzero(np.diff(stamps) == 0)
        some, others = track.by_stamp[again], track.by_stamp[again + 1]
        same = (track.apart(some, others) < 1e-6) & (track.turned(some, others) < 1e-4)
        logs, firsts = track.logs[track.by_stamp], np.append(0, np.flatnonzero(np.diff(stamps)) + 1)
        spans = np.maximum.reduceat(logs, firsts) - np.minimum.reduceat(logs, firsts)
        # One node that repeats its newest pose spreads the copies until the next stamp.
        is_repeated = np.diff(np.append(firsts, len(stamps))) > 1
        if not len(again) or same.mean() < 0.95:
            continue
        if np.median(spans[is_repeated]) > limits["spread"] * track.period:
            continue
        # Two robot_state_publishers are the usual cause, and both publish the description.
        descriptions = {one.name for one in description_topics(model.evidence.topics)}
        offered = {one.topic for one in model.evidence.publishers if one.offers > 1}
        doubled = [
            one.name
            for one in model.evidence.topics
            if one.name in descriptions and (one.name in offered or one.count > 1)
        ]
        topic = (*doubled, *track.topics)[0]
        fix = Fix(f"count its publishers: `{{publishers}} {topic}`")
        all_twice = bool(doubled) and any(len(one.stamps) > 1 for one in model.statics)
        facts: dict[str, Fact] = {
            "topic": track.name,
            "count": len(stamps),
            "different": different,
            "also": f"; {doubled[0]} and statics came more than once too" if all_twice else "",
        }
        severity = Severity.NOTE if is_double and not all_twice else None
        yield hit_of(track, facts, fixes=(fix,), severity=severity)


_NOETIC = seconds(1_590_000_000)
"""Time since which ROS 1 has a tf2 that prints TF_REPEATED_DATA: May 2020."""


@check(
    "old-data",
    Severity.WARNING,
    rule="a sample is older than the newest sample of its frame by more than the cache time "
    "(--cache-time). A note if the share of such samples is below {share:g}",
    headline="{where} {concerned:sends|send} samples that are too old to be kept",
    detail="{edge}: {count:times}, up to {behind:span} behind",
    consequence="tf2 drops these samples, with the warning TF_OLD_DATA",
    fixes=(
        Fix("find where these stamps come from: `{publishers} {tf_topic}` lists the publishers"),
    ),
    limits={"share": 0.01},
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
    """Transforms are older than the cache allows (TF_OLD_DATA)."""
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
                facts={
                    "edge": tracks[0].name,
                    "tf_topic": tracks[0].topics[0],
                    "count": count,
                    "behind": behind,
                },
                severity=Severity.NOTE if count < limits["share"] * len(old) else None,
            )


def _newest_before(tracks: list[Track]) -> tuple[Stamps, Stamps]:
    """Return all stamps in order of arrival, and for each arrival the newest stamp so far.

    Stamps of a simulation's clock and of the wall clock are compared separately.
    """
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
    rule="more than {samples:g} samples of a transform are older than a sample that arrived "
    "earlier, and they are more than a share of {share:g} of its samples",
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
        topics = np.array([one.topic for one in model.evidence.transforms.publishers])
        of_topic = (
            [track.stamps[topics[track.senders] == topic] for topic in track.topics]
            if len(track.topics) > 1
            else [track.stamps]
        )
        count = sum(map(unsorted_share, of_topic))
        if count > limits["samples"] and count > limits["share"] * len(track.stamps):
            # A localiser sends a pose late if it computes the pose late.
            waited = (track.child,) if track.is_localisation else ()
            facts = {"count": count, "of": len(track.stamps)}
            yield hit_of(track, facts, since=None, count=count, frames=waited)


@check(
    "bunched-stamps",
    Severity.NOTE,
    rule="a moving transform has {samples:g} samples or more. Half of the steps between its stamps "
    "are below {short:g} times the mean step, one in twenty is above {long:g} times the mean step, "
    "and the samples arrive within {seconds:g} s of their stamps. Or a share of {pairs:g} of the "
    "steps is below {at_once:g} times the mean step, and the frame moves at least half as far in "
    "these steps as in the others",
    headline="stamps of {where} come in bunches",
    detail="{edge}: {share:%} of the steps are below {short:span}, one in twenty is {long:span} or "
    "more; the mean is {mean:span}{moved}",
    consequence="the time of an interpolated pose is off by up to such a step",
    causes=("the publisher stamps its data on arrival, and sends it in bunches",),
    limits={
        "samples": 100,
        "short": 0.3,
        "long": 2.5,
        "seconds": 0.005,
        "pairs": 0.1,
        "at_once": 0.1,
    },
    needs=("log times",),
)
def bunched_stamps(model: Model, limits: Limits) -> Iterator[Hit]:
    """Several samples are stamped at nearly the same time, followed by a pause."""
    for track in model.dynamic:
        if len(track.stamps) < limits["samples"] or not track.moves:
            continue
        steps = np.diff(track.sorted_stamps)
        mean = float(steps.mean())
        short = int(limits["short"] * mean)
        share, long = float(np.mean(steps < short)), percentile(steps, 95)
        if percentile(np.abs(track.latency), 90) > limits["seconds"] * NANOSECONDS:
            continue
        moved = ""
        if share < 0.5 or long < limits["long"] * mean:
            # A copy of a sample, from a second source, does not move the frame.
            short = int(limits["at_once"] * mean)
            at_once = (steps < short) & (steps > 0)
            share, usual = float(np.mean(at_once)), float(np.median(track.strides[~at_once]))
            if share < max(limits["pairs"], 1.0 / len(steps)) or usual == 0.0:
                continue
            if np.median(track.strides[at_once]) < 0.5 * usual:
                continue
            moved = "; the frame moves as far in the short steps as in the others"
        yield hit_of(
            track,
            {
                "share": share,
                "short": short,
                "long": int(long),
                "mean": int(mean),
                "moved": moved,
            },
        )
