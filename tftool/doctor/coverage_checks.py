"""Checks for missing or late data: static transforms, waits for transforms, short caches."""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from tftool.base.plain_text import count
from tftool.base.stamps import NANOSECONDS
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.gap_checks import gap, holes
from tftool.doctor.missing_joins import (
    base_of,
    has_base,
    is_mount,
    is_world,
    own_base,
    start_of_publisher,
    static_publisher,
)
from tftool.doctor.model import WARM_UP, Limits, Model
from tftool.doctor.stamp_checks import stands_still
from tftool.doctor.stamp_stream import BASES, NEVER, PLACED, Heard, Track, last_part
from tftool.doctor.wording import ALIKE, arrival, is_ros1, least_rate, rounded_up, several, span
from tftool.recordings.contract import Stamps, percentile

check = checks_of(Area.COVERAGE)


@check(
    "static-missing",
    Severity.ERROR,
    rule="no topic for static transforms has a message, and messages are in frames that no "
    "transform contains. These frames are mounts, judged by the description or by a name such as "
    "laser_link; if tf has no part of the robot below its base, the frames of all sensors count. "
    "A warning if the recording has no such topic, if none of these messages is a "
    "scan, a point cloud or a range, or if tf has no base frame. Not reported if the "
    "recording has no such topic and constants other than odometry are sent on /tf, as in early "
    "ROS 1",
    headline="no transform names {frames}: {why}",
    detail="in these frames: {used}",
    consequence="these messages cannot be placed",
    causes=(
        "robot_state_publisher was not started",
        "the second part of a split recording",
        "/tf_static not in the recorder's list",
        "the recorder's QoS for /tf_static",
    ),
    links=threads("ros/geometry2#181", "ros/ros_comm#706"),
    needs=("headers",),
    because_of=(("anything", "namespaced-topic"),),
)
def static_missing(model: Model, limits: Limits) -> Iterator[Hit]:
    """The recording has no static transforms, and frames of sensors are not in tf."""
    if not model.lacks_statics:
        return
    every = {
        heard: heard.frame.removeprefix("/")
        for heard in model.heard
        if heard.is_spatial and heard.frame.removeprefix("/") not in model.frames | {""}
    }
    unknown = [heard for heard, frame in every.items() if is_mount(model, frame)]
    if not unknown:
        return
    if not _has_parts(model):
        # All parts of the robot lack for one reason, also those with unusual names.
        unknown = [
            heard
            for heard, frame in every.items()
            if heard in unknown or (heard.type.startswith("sensor_msgs/") and not is_world(frame))
        ]
    static = [topic for topic in model.evidence.topics if topic.static]
    names = sorted({heard.frame.removeprefix("/") for heard in unknown})
    why = "the recording has no /tf_static"
    if static:
        why = f"{static[0].name} has no message"
    cure = (
        "check whether the robot sends static transforms: `{publishers} /tf_static`; if so, "
        "{record}"
    )
    if model.lacks_state_publisher:
        why = "joint states arrived, but no transform of a joint (no robot_state_publisher?)"
        cure = start_of_publisher(model, names)
    fixes = [Fix(cure)]
    if not model.lacks_state_publisher:
        parent = own_base(model, names[0]) or "PARENT"
        command = static_publisher(parent, names[0], ros1=is_ros1(model.evidence))
        each = " for each of the frames" if len(names) > 1 else ""
        fixes.append(Fix(f"if nothing sends them, publish the mount{each}:", command))
    slashed = sorted({heard.topic for heard in unknown if heard.frame.startswith("/")})
    if slashed:
        text = f"and set the frame_id of {several(slashed, 3)} without its leading slash"
        fixes.append(Fix(f"{text}: no frame of tf2 begins with a slash"))
    yield Hit(
        frames=tuple(sorted({heard.frame for heard in unknown})),
        topics=tuple(sorted({heard.topic for heard in unknown})),
        count=sum(len(heard.stamps) for heard in unknown),
        facts={
            "frames": names,
            "why": why,
            "used": [f"{one.topic} ({count(len(one.stamps), 'message')})" for one in unknown],
        },
        severity=None
        if static and has_base(model) and any(last_part(heard.type) in PLACED for heard in unknown)
        else Severity.WARNING,
        fixes=tuple(fixes),
        alone=True,
    )


def _has_parts(model: Model) -> bool:
    """Whether tf has frames other than those of the base below a robot's base frame."""
    bases = {base_of(tree) for tree in model.trees} - {""}
    below = frozenset[str]().union(*(model.below(base) for base in bases))
    return any(last_part(frame) not in BASES for frame in below) or not bases


@check(
    "static-not-latched",
    Severity.ERROR,
    rule="a publisher offers a topic for static transforms with the durability volatile. A warning "
    "in ROS 1 if each static is sent {often:g} times or more",
    headline="{topic} is offered {volatile} by {by}",
    consequence="{so}",
    fixes=(Fix("publish it {latched} (a StaticTransformBroadcaster does)"),),
    causes=("a relay or bridge with default QoS",),
    links=threads("ros2/geometry2#585", "realsenseai/realsense-ros#141"),
    limits={"often": 3},
    needs=("durability",),
)
def static_not_latched(model: Model, limits: Limits) -> Iterator[Hit]:
    """/tf_static has volatile durability, so late subscribers never receive it."""
    static = {topic.name for topic in model.evidence.topics if topic.static}
    for publisher in model.evidence.publishers:
        if publisher.topic in static and publisher.durability == "volatile":
            tracks = [t for t in model.statics if publisher.topic in t.topics]
            is_old = is_ros1(model.evidence)
            is_repeated = is_old and all(len(t.stamps) >= limits["often"] for t in tracks)
            so = "tf2's listeners ask for transient_local, so they get no message of this publisher"
            if is_old:
                again = (
                    "waits for the next repetition" if is_repeated else "never gets these statics"
                )
                so = f"a listener that starts later {again}"
            yield Hit(
                edges=tuple(t.edge for t in tracks),
                topics=(publisher.topic,),
                publishers=(publisher.node,) if publisher.node else (),
                facts={"topic": publisher.topic, "by": publisher.authority, "so": so},
                severity=Severity.WARNING if is_repeated else None,
            )


@check(
    "static-late",
    Severity.NOTE,
    rule="a static first arrives more than {seconds:g} s after the first message in a frame below "
    "it. Not reported if the static's stamp is before that message, because then only the "
    "recorder received the static late",
    headline="{where} {concerned:arrives|arrive} later than messages that need {concerned:it|them}",
    detail="{edge}: {late:span} late; before it: {missed}",
    consequence="a listener that ran from the start could not place these messages, although a "
    "reader of the whole recording can",
    causes=("a driver that publishes its mount when it is ready",),
    links=threads("ros/geometry2#181"),
    limits={"seconds": 1.0},
    needs=(
        "log times",
        "headers",
    ),
    because_of=(("child", "static-and-dynamic"),),
)
def static_late(model: Model, limits: Limits) -> Iterator[Hit]:
    """Static transforms arrive later than messages that need them."""
    spatial = [heard for heard in model.heard if heard.is_spatial and len(heard.logs)]
    earliest = min((int(heard.logs[0]) for heard in spatial), default=NEVER)
    for track in model.statics:
        if not len(track.logs) or track.logs[0] <= earliest:
            continue
        first = int(track.logs[0])
        below = model.below(track.child)
        missed = [
            (heard, int(np.count_nonzero(heard.logs < first)))
            for heard in spatial
            if heard.frame in below
        ]
        missed = [(heard, count) for heard, count in missed if count]
        late = max((first - int(heard.logs[0]) for heard, _ in missed), default=0)
        if late > limits["seconds"] * NANOSECONDS:
            if track.stamps[0] != 0 and track.latency[0] > late:
                continue  # it was sent before, and only the recorder heard it late
            yield hit_of(
                track,
                {
                    "late": late,
                    "missed": [f"{heard.topic} ({count} messages)" for heard, count in missed],
                },
                since=first,
                topics=tuple(sorted({heard.topic for heard, _ in missed})),
                count=sum(count for _, count in missed),
            )


@check(
    "latched-overwrite",
    Severity.NOTE,
    rule="a publisher's last message with statics lacks some of the publisher's child frames. In "
    "rosbag2, which stores no publishers, the last {kept:g} messages together lack some",
    headline="statics are in {messages} messages",
    detail="{told} {lost}",
    consequence="a player of the recording keeps only the last messages for late listeners",
    fixes=(Fix("start listeners before playing"),),
    causes=("several static publishers",),
    links=threads("ros/ros_comm#706", "ros2/geometry2#585"),
    limits={"kept": 10},
    needs=("recording",),
    why="rosbag latches the last message of each publisher, and rosbag2 keeps the last ten",
)
def latched_overwrite(model: Model, limits: Limits) -> Iterator[Hit]:
    """Static transforms are in several messages, and playback latches only the last ones."""
    transforms = model.evidence.transforms
    kept = 1 if is_ros1(model.evidence) else int(limits["kept"])
    held: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
    for edge in transforms.edges:
        for message in dict.fromkeys(edge.messages.tolist()) if edge.static else ():
            # ROS 1's player latches one message for each recorded publisher.
            node = transforms.publishers[transforms.senders[message]].node
            held[node][message].add(edge.child)
    for node, messages in held.items():
        order = sorted(messages, key=lambda one: (int(transforms.log_times[one]), one))
        lasts = order[-1 if node else -kept :]
        lost = sorted(set().union(*messages.values()).difference(*(messages[n] for n in lasts)))
        if lost:
            yield Hit(
                frames=tuple(lost),
                publishers=(node,) if node else (),
                count=len(messages),
                facts={
                    "messages": len(messages),
                    "lost": lost,
                    "kept": sum(len(messages[number]) for number in lasts),
                    "told": "the last lacks" if len(lasts) == 1 else f"the last {len(lasts)} lack",
                },
                alone=True,
            )


@dataclass(frozen=True, slots=True, eq=False)
class Waits:
    """Waiting times of a topic's messages, from the arrival of a message until its lookup succeeds.

    Attributes:
        stamps: The messages' stamps, shape (n,).
        arrivals: Times of arrival, on the clock of the stamps, shape (n,).
        waits: Time from the arrival of each message until the lookup at its stamp succeeds,
            nanoseconds, shape (n,); NEVER if the lookup always fails.
        link: The edge that delays most lookups.
        links: The moving edges on the path between the message's frame and the fixed frame.
    """

    stamps: Stamps
    arrivals: Stamps
    waits: Stamps
    link: Track
    links: tuple[Track, ...]

    @property
    def served(self) -> Stamps:
        """Return the entries of `waits` other than NEVER."""
        served: Stamps = self.waits[self.waits != NEVER]
        return served

    def serves(self, percent: float) -> int:
        """Return the least timeout, nanoseconds, that is enough for `percent` % of `served`."""
        return int(np.percentile(self.served, percent, method="higher"))

    def is_short_without(self, links: Iterable[Track], wait: float) -> bool:
        """Whether 95 % of the messages wait less than `wait` seconds for edges not in `links`."""
        rest = [link.served_from(self.stamps) for link in self.links if link not in links]
        late = [int(percentile(served - self.arrivals, 95)) for served in rest]
        return max(late, default=0) < wait * NANOSECONDS


def waits_of(model: Model, heard: Heard, fixed: str, *, warm: bool = True) -> Waits | None:
    """Return the waiting times of a topic's messages until lookups of the messages' frame succeed.

    Return None if the frames are not connected, if all edges between them are static, or if there
    are no messages to check.

    Args:
        model: Model of the evidence.
        heard: The headers of the messages.
        fixed: Target frame of the lookups.
        warm: Whether to ignore the first second of the topic and of the edges, and the last second
            of the recording.
    """
    path = model.path(heard.frame, fixed)
    links = [track for track in path or () if not track.static and len(track.by_stamp)]
    if not links or any(not t.static and not len(t.by_stamp) for t in path or ()):
        return None
    low, high = model.start, model.end
    if warm:
        # Messages queued before the first subscription may arrive in one burst.
        low = max(int(one.logs[0]) for one in (heard, *links)) + WARM_UP
        high -= WARM_UP
    begin = max(int(track.sorted_stamps[0]) for track in links)
    # Waiting does not help a message older than the first transform: see `late_start`.
    inside = (heard.logs >= low) & (heard.logs <= high) & (heard.stamps >= begin)
    stamps, arrivals = heard.stamps[inside], heard.arrivals[inside]
    if not len(stamps):
        return None
    served = np.stack([track.served_from(stamps) for track in links])
    latest = served.max(axis=0)
    waits = np.where(latest == NEVER, NEVER, np.maximum(latest - arrivals, 0))
    blame = np.bincount(served.argmax(axis=0)[waits > 0], minlength=len(links))
    return Waits(stamps, arrivals, waits, links[int(blame.argmax())], tuple(links))


@check(
    "sensor-outruns-tf",
    Severity.WARNING,
    rule="a scan, a point cloud or a range on the robot waits for the last transform that a lookup "
    "at its stamp needs. A share of the messages above {some:g} has to wait. The 95 % quantile of "
    "these waits is {seconds:g} s or more, or a share of the messages above {never:g} never gets "
    "the transform. If a share above {all:g} has to wait, the quantile is rounded up to "
    "10 ms. A note for other messages, and if a share above {refused:g} has to "
    "wait and the quantile is {note:g} s or more. The topic has at least {messages:g} "
    "messages. Not reported for markers, odometry, paths, maps, and messages of an IMU, a "
    "compass or a satellite receiver",
    headline="{topics} {topics:arrives|arrive} before the transforms {topics:it needs|they need}",
    detail="lookups in {fixed} fail for {refused:%} of the messages at arrival, for {never:%} "
    "always; wait {p50:span} (median), {p95:span} (95 %), {worst:span} (worst); the last transform "
    "to arrive is {link}, which comes every {period:span}, {arrives}",
    consequence='lookups without a timeout fail with "extrapolation into the future"; a message '
    "filter delays these messages, and drops some if its queue is full",
    causes=(
        "odometry is slower or later than the sensor",
        "the clocks of two computers differ",
        "a constant on /tf at 10 Hz",
        "load",
    ),
    links=threads(
        "SteveMacenski/slam_toolbox#516",
        "SteveMacenski/slam_toolbox#576",
        "ApolloAuto/apollo#12088",
    ),
    limits={
        "seconds": 0.1,
        "never": 0.05,
        "refused": 0.5,
        "all": 0.95,
        "some": 0.1,
        "note": 0.06,
        "messages": 20,
    },
    needs=(
        "log times",
        "headers",
    ),
    why="0.1 s is the usual tolerance of consumers, and a healthy robot at 50 Hz needs 20 "
    "ms for some scans; the samples of an IMU or of GNSS are filtered, not placed one by one",
    because_of=(
        ("stream", "clock-mixture"),
        (
            "path",
            "edge-stopped stale-stamp zero-stamp frozen-stamp single-sample nan-transform "
            "future-stamp loop",
        ),
        ("skew", "clock-offset"),
        ("gap", "gap"),
        ("frame", "loop"),
    ),
)
def sensor_outruns_tf(model: Model, limits: Limits) -> Iterator[Hit]:
    """Lookups at a sensor's stamps fail, because the transforms arrive later."""
    groups: list[list[tuple[Heard, Waits]]] = []
    for heard, waits in _waiting(model, limits):
        for group in groups:
            if _is_relay(group[0], (heard, waits)):
                group.append((heard, waits))
                break
        else:
            groups.append([(heard, waits)])
    for group in groups:
        hit = _outrun(model, group, limits)
        if hit is not None:
            yield hit


def _waiting(model: Model, limits: Limits) -> Iterator[tuple[Heard, Waits]]:
    """Yield each topic whose messages all need a lookup, with the waiting times of the messages."""
    fixed = model.sensor_frame
    around = {track.parent for track in model.above(fixed)}
    for heard in model.heard:
        if not heard.is_spatial or len(heard.stamps) < limits["messages"]:
            continue
        if last_part(heard.type) in _NOT_PLACED or heard.type.startswith("nav_msgs/"):
            continue
        if heard.frame in around or last_part(heard.frame) in _WORLDS:
            continue  # a frame beside the robot, or of the world, does not need the robot's pose
        waits = waits_of(model, heard, fixed)
        if waits is not None and len(waits.waits) < limits["messages"]:
            continue
        if waits is not None and not _is_result(model, heard, waits.link):
            yield heard, waits


def _is_result(model: Model, heard: Heard, link: Track) -> bool:
    """Whether a topic contains results of a node that also sends the edge `link`.

    Such a result, for example the pose of a localiser, needs no lookup.
    """
    nodes = {one.node for one in model.evidence.publishers if one.topic == heard.topic}
    is_own = heard.frame == link.child and not heard.type.startswith("sensor_msgs/")
    return is_own and bool(nodes & set(link.nodes))


def _is_relay(first: tuple[Heard, Waits], other: tuple[Heard, Waits]) -> bool:
    """Whether two topics have the same frame, the same delaying edge and similar waiting times."""
    (heard, waits), (also, its) = first, other
    if heard.frame != also.frame or waits.link is not its.link:
        return False
    if not len(waits.served) or not len(its.served):
        return len(waits.served) == len(its.served)
    near = [abs(waits.serves(share) - its.serves(share)) for share in (50, 95)]
    often = abs(float((waits.waits > 0).mean() - (its.waits > 0).mean()))
    return max(near) <= max(_RELAYED, ALIKE * waits.serves(95)) and often <= ALIKE


def _outrun(model: Model, group: list[tuple[Heard, Waits]], limits: Limits) -> Hit | None:
    """Return a hit about topics whose messages wait equally long for a transform.

    Return None if the waiting times are short.
    """
    heard, waits = max(group, key=lambda one: int(one[1].served.max(initial=0)))
    served = waits.served
    never = 1.0 - len(served) / len(waits.waits)
    p50, p95 = (waits.serves(50), waits.serves(95)) if len(served) else (0, 0)
    # The rates do not count the first and the last second; the longest wait does.
    every = (waits_of(model, one, model.sensor_frame, warm=False) for one, _ in group)
    worst = max(int(one.served.max(initial=0)) for one in every if one is not None)
    refused = float(np.count_nonzero(waits.waits > 0)) / len(waits.waits)
    # tf2 tries again every 10 ms: if all messages wait, so does a listener.
    wait = rounded_up(p95) if refused > limits["all"] else p95 - 1
    if refused > limits["some"] and (
        wait >= limits["seconds"] * NANOSECONDS or never > limits["never"]
    ):
        severity = None if last_part(heard.type) in PLACED else Severity.NOTE
    elif refused > limits["refused"] and p95 > limits["note"] * NANOSECONDS:
        severity = Severity.NOTE
    else:
        return None
    link = waits.link
    topics = tuple(sorted(one.topic for one, _ in group))
    return hit_of(
        link,
        {
            "topic": heard.topic,
            "topics": list(topics),
            "fixed": model.sensor_frame,
            "refused": refused,
            "never": never,
            "p50": p50,
            "p95": p95,
            "worst": worst,
            "timeout": rounded_up(worst),
            "link": link.name,
            "period": link.period,
            "latency": link.median_latency,
            "arrives": _arrives(heard, link),
            "path": [list(track.edge) for track in waits.links],
            "gap": _only_in_holes(waits, limits["seconds"]),
            "skew": abs(link.median_latency - heard.median_latency) > _ONE_CLOCK,
        },
        since=min(int(one.logs[0]) for one, _ in group),
        frames=(heard.frame, model.sensor_frame),
        topics=topics,
        count=sum(int(np.count_nonzero(its.waits > 0)) for _, its in group),
        severity=severity,
        fixes=_cures(heard, waits, worst, limits["seconds"]),
        alone=True,
    )


def _arrives(heard: Heard, link: Track) -> str:
    """Return a clause about an edge's latency, relative to the topic's if stamps are far ahead."""
    if link.median_latency > -NANOSECONDS:
        return arrival(link.median_latency)
    later = link.median_latency - heard.median_latency
    side = "later" if later > 0 else "sooner"
    return f"{span(abs(later))} {side} (from stamp to arrival) than {heard.topic}"


_ONE_CLOCK = 50_000_000
"""Maximum difference between two latencies, nanoseconds, that belong to one clock."""

_RELAYED = 5_000_000
"""Maximum difference between the waits of a topic and of its relayed copy, nanoseconds."""

_NOT_PLACED = frozenset({"Imu", "MagneticField", "NavSatFix", "Marker"})
"""Types of messages that filters use on arrival, or that are only drawn."""

_WORLDS = frozenset({"map", "world", "earth"})


def _only_in_holes(waits: Waits, wait: float) -> bool:
    """Whether nearly all messages that wait longer than `wait` seconds are in a gap of an edge."""
    late = waits.waits > wait * NANOSECONDS
    for link in waits.links:
        for begin, end in holes(link, gap.limits):
            late &= (waits.stamps <= begin) | (waits.stamps > end)
    return float(np.count_nonzero(late)) <= 0.05 * len(late)


def _cures(heard: Heard, waits: Waits, worst: int, wait: float) -> tuple[Fix, ...]:
    """Return the remedies for messages that arrive before their transforms.

    Args:
        heard: Headers of the messages.
        waits: Waiting times of the messages.
        worst: Longest waiting time, nanoseconds, of all messages whose lookup succeeds.
        wait: Timeout of the listener, seconds.
    """
    if worst < 10_000_000:
        return ()
    usual = waits.serves(95)
    link = waits.link
    later = link.median_latency - heard.median_latency
    latest = int(percentile(link.latency, 95)) - heard.median_latency
    is_enough = later < wait * NANOSECONDS
    # No rate helps the messages whose transforms are on the way for longer than the timeout.
    often = least_rate(link.name, link.period, latest if is_enough else later, wait)
    often = "" if is_enough and latest >= wait * NANOSECONDS else often
    # A rate or a mount is a remedy only if no other transform is as late.
    often = often if waits.is_short_without([link], wait) else ""
    mounts = [one for one in waits.links if not one.moves and not _is_robot(one)]
    lasts = int(link.sorted_stamps[-1] - link.sorted_stamps[0])
    recorded = len(link.by_stamp) * link.period / max(1, lasts)
    is_lossy = recorded < _RECORDED
    mount = Fix(
        f"{'' if is_lossy else 'or '}send {several([m.name for m in mounts])} on /tf_static, if "
        "these transforms, which never moved, are mounts"
    )
    is_mount = link in mounts and waits.is_short_without(mounts, wait)
    wait_for = (
        f"use a timeout in the lookup: {rounded_up(worst) // 10**6} ms are enough for all messages "
        f"whose lookup can succeed ({math.ceil(usual / 1e6)} ms for 95 %)"
    )
    if worst > 3 * usual:  # no wait to plan for
        wait_for = (
            f"use a timeout in the lookup: {max(10, rounded_up(usual) // 10**6)} ms are enough for "
            f"95 % of the messages; the longest wait is {span(worst)}"
        )
    if is_lossy:
        often = ""
        wait_for = (
            f"the recording contains {100 * recorded:.0f} % of the samples that {link.name} has at "
            f"its usual period of {span(link.period)}: if the recorder lost the others, a listener "
            "on the robot waits less"
        )
    return (
        Fix(wait_for),
        *((Fix(f"or {often}") if is_enough else Fix(often),) if often else ()),
        *((mount,) if is_mount else ()),
    )


_RECORDED = 0.7
"""Minimum fraction of a transform's samples in a recording whose waiting times show a timeout."""


def _is_robot(link: Track) -> bool:
    """Whether an edge is the robot's pose in a world, map or odometry frame, and so not a mount."""
    around = last_part(link.parent)
    return link.is_localisation or around in _WORLDS or around.startswith("odom")


@check(
    "cache-short",
    Severity.WARNING,
    rule="95 % of a topic's messages are older than the cache time (10 s, or --cache-time) when "
    "they arrive. The delay of the transforms that these messages need is subtracted first. The "
    "finding is a note for messages other than scans, point clouds and ranges",
    headline="{topic} arrives later than the cache time",
    detail="{topic}: {late:span} after its stamp (median), {worst:span} at most; the buffer "
    "keeps {cache:span}",
    consequence='lookups fail with "extrapolation into the past": the buffer has dropped the '
    "transforms",
    causes=(
        "a slow detector",
        "a consumer that is behind",
    ),
    links=threads("intrinsic-dev/aic#218"),
    needs=(
        "log times",
        "headers",
    ),
    because_of=(("stream", "clock-mixture"),),
)
def cache_short(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages are older than the cache time when they arrive."""
    for heard in model.heard:
        if not heard.is_spatial or len(heard.stamps) < 3 or model.rests(heard.frame):
            continue
        if heard.frame not in model.frames or last_part(heard.type) in _NOT_PLACED:
            continue
        latency = heard.latency[heard.stamps != 0]
        if not len(latency):
            continue
        # Transforms that are as late as the messages are still in the buffer.
        path = model.path(heard.frame, model.fixed_frame) or ()
        fresh = min((track.median_latency for track in path if not track.static), default=0)
        least = model.settings.cache_time + max(0, fresh)
        if percentile(latency, 95) > least and not stands_still(heard):
            worst = int(latency.max())
            yield hit_of(
                heard,
                {
                    "late": int(np.median(latency)),
                    "worst": worst,
                    "cache": model.settings.cache_time,
                    "needed": math.ceil(worst / NANOSECONDS) + 1,
                },
                count=int(np.count_nonzero(latency > least)),
                severity=None if last_part(heard.type) in PLACED else Severity.NOTE,
            )


@check(
    "late-start",
    Severity.NOTE,
    rule="messages are older than the first transform that they need by more than {seconds:g} s, "
    "and arrive after the first second of the recording. If a localiser stamps that transform "
    "ahead by up to 2 s, the limit grows by the same time. A warning if this is true of all "
    "scans, point clouds or ranges of a topic",
    headline="{where} {concerned:begins|begin} later than messages that need {concerned:it|them}",
    detail="{edge} begins at {begin:moment}: {messages} of {topic} can never be placed "
    "in {fixed}{aged}",
    consequence="these lookups fail, however long a listener waits",
    causes=(
        "AMCL dates its first transform ahead (transform_tolerance)",
        "a node that starts later",
    ),
    limits={"seconds": 0.5},
    needs=(
        "log times",
        "headers",
    ),
    why="every recording needs its first second to start, and a localiser that stamps ahead "
    "always loses that time",
    because_of=(
        ("stream", "clock-mixture frozen-stamp"),
        ("edge", "wild-stamp clock-offset"),
    ),
)
def late_start(model: Model, limits: Limits) -> Iterator[Hit]:
    """The first lookups fail, because an edge begins late or is stamped ahead."""
    fixed = model.fixed_frame
    for heard in model.heard:
        if not heard.is_spatial or last_part(heard.type) == "NavSatFix":
            continue  # a satellite fix contains its own global position
        links = [
            t for t in model.path(heard.frame, fixed) or () if not t.static and len(t.by_stamp)
        ]
        if not links:
            continue
        last = max(links, key=lambda track: int(track.sorted_stamps[0]))
        begin = int(last.sorted_stamps[0])
        stamped = heard.stamps[heard.stamps != 0]
        lost = int(np.count_nonzero(stamped < begin))
        # A localiser that stamps transforms ahead has none for the first second of a recording.
        usual = WARM_UP
        if last.is_localisation:
            usual = max(usual, min(-last.median_latency, 2 * WARM_UP))
        if lost and begin - int(stamped.min()) > usual + limits["seconds"] * NANOSECONDS:
            is_all = lost == len(stamped) and last_part(heard.type) in PLACED
            aged = f"; usually {span(heard.median_latency)} late on arrival"
            yield Hit(
                edges=(last.edge,),
                topics=(heard.topic,),
                since=int(heard.logs[0]),
                count=lost,
                severity=Severity.WARNING if is_all else None,
                facts={
                    "edge": last.name,
                    "begin": begin,
                    "lost": lost,
                    "messages": count(lost, "message"),
                    "aged": aged if heard.median_latency > WARM_UP else "",
                    "topic": heard.topic,
                    "fixed": fixed,
                },
            )
