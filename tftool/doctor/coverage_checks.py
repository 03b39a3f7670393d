"""Checks of data that is needed and missing: holes, statics, waits, caches."""

import math
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.clock_checks import stands_still
from tftool.doctor.findings import STOPPED_AFTER, STOPPED_PERIODS, Area, Fix, Hit, Severity
from tftool.doctor.model import WARM_UP, Limits, Model
from tftool.doctor.ros_words import is_ros1
from tftool.doctor.stamp_stream import NEVER, Heard, Track, last_part, rate
from tftool.doctor.wording import ALIKE, arrival, several, span
from tftool.recordings.contract import Stamps

check = checks_of(Area.COVERAGE)


def _least_gap(track: Track, limits: Limits) -> float:
    return max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)


def holes(track: Track, limits: Limits) -> list[tuple[int, int]]:
    """Return the gaps that are too long for an edge's period, as pairs of stamps."""
    # A stamp that is wrong by years does not make a gap.
    stamps = track.sorted_stamps
    if track.wild.any():
        stamps = stamps[~track.wild[track.by_stamp]]
    if len(stamps) < limits["samples"] or not track.period:
        return []
    if len(track.steps) < 0.5 * (len(stamps) - 1):
        return []  # its stamps do not change, which is another fault
    wide = stamps[1:] - stamps[:-1] > _least_gap(track, limits)
    places = wide.nonzero()[0].tolist()
    return [(int(stamps[place]), int(stamps[place + 1])) for place in places]


@check(
    "edge-stopped",
    Severity.ERROR,
    rule="the last sample arrives more than {periods:g} periods and {seconds:g} s, and a "
    "share of {share:g}, before the recording's end, while other streams continue; of "
    "{samples:g} samples or more, except detections of a camera that have no children",
    headline="{where} {concerned:stops|stop} before the end",
    detail="{edge}: last at {last:moment}, {before:span} before the end; came every {period:span}",
    consequence="lookups through it refuse from then on",
    fixes=(Fix("check the node that publishes it: it crashed or hangs"),),
    causes=(
        "a node that crashed",
        "a lost sensor",
    ),
    limits={"periods": STOPPED_PERIODS, "seconds": STOPPED_AFTER, "share": 0.05, "samples": 5},
    needs=("log times",),
    because_of=(
        ("stream", "clock-mixture"),
        ("child", "publisher-conflict two-parents"),
        ("edge", "parent-switch"),
    ),
)
def edge_stopped(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform ends long before the recording does."""
    length = model.end - model.start
    alive: list[Track | Heard] = [*model.dynamic, *model.heard]
    latest = max((int(one.logs[-1]) for one in alive if len(one.logs)), default=model.start)
    for track in model.dynamic:
        if len(track.stamps) < limits["samples"]:
            continue
        last = int(track.logs[-1])
        before = model.end - last
        least = max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)
        if before <= least or before <= limits["share"] * length:
            continue
        above = model.parents.get(track.child)
        if above is not None and above.parent != track.parent:
            continue
        if _is_detection(model, track):
            continue
        # If all links end at once, as when a session's host exits, it is not the fault of one link.
        if latest - last <= least:
            continue
        yield hit_of(
            track,
            {
                "last": int(track.stamps.max()),
                "before": before,
                "period": track.period,
                "below": sorted(model.below(track.child)),
            },
            since=last,
            until=model.end,
            count=1,
        )


_SEEN = re.compile(
    r"tag|marker|aruco|fiducial|charuco|obj|detect|person|people|target|ball|box|obstacle|goal|yolo"
)


def _is_detection(model: Model, track: Track) -> bool:
    """Whether an edge is a camera's detection: a leaf with such a name or rate."""
    if len(model.below(track.child)) > 1 or any(h.frame == track.child for h in model.heard):
        return False
    steps = track.steps
    is_irregular = len(steps) > 1 and float(steps.std()) > float(steps.mean())
    return is_irregular or _SEEN.search(last_part(track.child).lower()) is not None


@check(
    "gap",
    Severity.WARNING,
    rule="the largest step is above {periods:g} periods and {seconds:g} s, of {samples:g} "
    "samples or more; a note for transforms that are published on change (variation "
    "above {variation:g})",
    headline="{where} {concerned:has a gap|have gaps}",
    detail="{edge}: nothing from {begin:moment} to {end:moment} ({length:span}; usually every "
    "{period:span}){why}{beside}",
    consequence="lookups inside it interpolate across the gap, or refuse during it",
    fixes=(
        Fix("check what stopped then: if all edges stop together, the recorder or the network"),
    ),
    causes=(
        "load",
        "a network that drops",
        "a publisher that hung",
    ),
    limits={"periods": 5, "seconds": 0.5, "samples": 10, "variation": 1.0},
    why="four messages lost in a row are no accident on a reliable topic; the usual "
    "timeouts of consumers cover shorter gaps",
    because_of=(
        ("child", "publisher-conflict two-parents"),
        ("edge", "edge-stopped nan-transform clock-offset outage"),
    ),
)
def gap(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform has a gap."""
    known = {track.edge: holes(track, limits) for track in model.dynamic}
    for track in model.dynamic:
        found = known[track.edge]
        if not found:
            continue
        begin, end = max(found, key=lambda hole: hole[1] - hole[0])
        also = [
            other.name
            for other in model.dynamic
            if other is not track
            and any(low < end and begin < high for low, high in known[other.edge])
        ]
        steps = track.steps
        regular = steps[steps <= _least_gap(track, limits)] if len(found) <= 3 else steps
        mean = float(regular.mean()) if len(regular) else 0.0
        on_change = bool(mean) and float(regular.std()) / mean > limits["variation"]
        stamps = track.stamps
        missing = int(np.count_nonzero((stamps > begin) & (stamps < end)))
        yield hit_of(
            track,
            {
                "begin": begin,
                "end": end,
                "length": end - begin,
                "period": track.period,
                "also": also,
                "beside": f"; at the same time: {several(also)}" if also else "",
                "unusable": missing,
                "why": f"; {missing} samples in it are unusable (NaN)" if missing else "",
            },
            since=begin,
            until=end,
            count=len(found),
            severity=Severity.NOTE if on_change else Severity.WARNING,
        )


@check(
    "outage",
    Severity.WARNING,
    rule="nothing arrives for more than {seconds:g} s and {periods:g} periods on half or more of "
    "the streams that come at {hz:g} Hz or more, a topic of messages and a transform among them, "
    "and they go on afterwards",
    headline="nothing arrived for {length:span} on {streams} of {of} streams",
    detail="from {begin:moment} to {end:moment} (log times): {names}; {lost}",
    consequence="whatever was stamped then came late, in a burst, or never",
    fixes=(
        Fix(
            "look for what they share: the network, the computer or the recorder; record on the "
            "robot"
        ),
    ),
    causes=(
        "a network that was gone",
        "a recorder or a disk that hung",
    ),
    limits={"seconds": 2.0, "periods": 10, "hz": 1.0},
    needs=("log times",),
)
def outage(model: Model, limits: Limits) -> Iterator[Hit]:
    """Most streams stop arriving at once for a time, and go on."""
    silent: list[tuple[Track | Heard, int, int]] = []
    count = 0
    streams: list[Track | Heard] = [*model.dynamic, *(h for h in model.heard if h.is_spatial)]
    for stream in streams:
        steps = np.diff(stream.logs)
        if len(steps) < 10 or (usual := int(np.median(steps))) * limits["hz"] > NANOSECONDS:
            continue
        count += 1
        place = int(steps.argmax())
        if steps[place] > max(limits["seconds"] * NANOSECONDS, limits["periods"] * usual):
            silent.append((stream, int(stream.logs[place]), int(stream.logs[place + 1])))
    begin = max((begin for _, begin, _ in silent), default=0)
    end = min((end for _, _, end in silent), default=0)
    kinds = {type(stream) for stream, _, _ in silent}
    if len(kinds) < 2 or 2 * len(silent) < count or end - begin < limits["seconds"] * NANOSECONDS:
        return
    missed = sum(
        _is_hole(stream, begin, end, limits["seconds"] * NANOSECONDS) for stream, _, _ in silent
    )
    lost = "all of it came afterwards"
    if missed:
        lost = f"on {missed} of them data of that time never came"
    gone = [one.name for one in streams if begin - NANOSECONDS < one.logs[-1] < end]
    yield Hit(
        edges=tuple(stream.edge for stream, _, _ in silent if isinstance(stream, Track)),
        topics=tuple(stream.topic for stream, _, _ in silent if isinstance(stream, Heard)),
        since=begin,
        until=end,
        facts={
            "begin": begin,
            "end": end,
            "length": end - begin,
            "streams": len(silent),
            "of": count,
            "names": [stream.name for stream, _, _ in silent],
            "lost": f"{lost}; {several(gone)} never came back" if gone else lost,
        },
        alone=True,
    )


def _is_hole(stream: Track | Heard, begin: int, end: int, least: float) -> bool:
    """Whether a stream has a gap of stamps about a time when nothing arrived."""
    stamps = np.sort(stream.stamps)
    steps = np.diff(stamps)
    delay = stream.arrivals - stream.logs
    near = int(delay[0]) if len(delay) else 0
    wide = (steps > least) & (stamps[1:] > begin + near) & (stamps[:-1] < end + near)
    return bool(wide.any())


@check(
    "single-sample",
    Severity.WARNING,
    rule="a transform on a dynamic topic was sent once",
    headline="{where} {concerned:was|were} sent once, on /tf",
    detail="{edge}: at {stamp:moment}",
    consequence="one sample answers only for its own stamp, and only while the cache keeps it",
    fixes=(Fix("send a mount with a StaticTransformBroadcaster (on /tf_static)"),),
    causes=("a mount sent with a TransformBroadcaster",),
    why="tf2 interpolates between two samples and never extrapolates from one",
    because_of=(
        ("child", "static-and-dynamic"),
        ("edge", "zero-stamp"),
    ),
)
def single_sample(model: Model, limits: Limits) -> Iterator[Hit]:
    """A moving frame with one sample only."""
    for track in model.dynamic:
        if len(track.stamps) == 1 and len(track.by_stamp) == 1:
            yield hit_of(track, {"stamp": int(track.stamps[0])}, topics=track.topics, count=1)


@check(
    "no-transforms",
    Severity.ERROR,
    rule="no topic carries a transform",
    headline="there are no transforms",
    consequence="nothing can be placed in another frame",
    fixes=(Fix("record /tf and /tf_static too"),),
    causes=("/tf and /tf_static were not in the recorder's list",),
    because_of=(("anything", "namespaced-topic"),),
)
def no_transforms(model: Model, limits: Limits) -> Iterator[Hit]:
    """The recording has no transforms."""
    if not model.tracks and not model.nameless:
        yield Hit(topics=tuple(t.name for t in model.evidence.topics if t.transforms))


@check(
    "static-missing",
    Severity.ERROR,
    rule="no static topic has a message, and messages are in frames that tf does not know. "
    "Not reported if there is no static topic and constants are sent on /tf, as in "
    "early ROS 1",
    headline="the statics are missing: {why}",
    detail="messages are in {frames}, which no transform names",
    consequence="these sensors cannot be placed",
    fixes=(
        Fix(
            "take the statics from another recording of the robot, or from its description:",
            "tftool edit RECORDING -o WHOLE --statics-from OTHER",
        ),
    ),
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
    """The recording has no statics, and sensors have no transforms."""
    if not model.lacks_statics:
        return
    unknown = [
        heard
        for heard in model.heard
        if heard.is_spatial and heard.frame and heard.frame.removeprefix("/") not in model.frames
    ]
    if not unknown:
        return
    static = [topic for topic in model.evidence.topics if topic.static]
    why = "there is no /tf_static in it"
    if static:
        why = f"{static[0].name} is there and has no message"
    cure = model.words["record"]
    if model.lacks_state_publisher:
        why = "robot_state_publisher did not run (joint states came, but no transform of a joint)"
        cure = "start robot_state_publisher with the robot's description"
    names = sorted({heard.frame for heard in unknown})
    yield Hit(
        frames=tuple(names),
        topics=tuple(sorted({heard.topic for heard in unknown})),
        count=sum(len(heard.stamps) for heard in unknown),
        facts={"frames": names, "why": why},
        fixes=(Fix(cure),),
        alone=True,
    )


@check(
    "static-not-latched",
    Severity.ERROR,
    rule="a publisher offers a static topic with durability volatile",
    headline="{topic} is offered {volatile} by {by}",
    consequence="a listener that starts later never gets these statics",
    fixes=(Fix("publish it {latched} (a StaticTransformBroadcaster does)"),),
    causes=("a relay or bridge with default QoS",),
    links=threads("ros2/geometry2#585", "realsenseai/realsense-ros#141"),
    needs=("durability",),
)
def static_not_latched(model: Model, limits: Limits) -> Iterator[Hit]:
    """/tf_static is offered volatile: late listeners never get it."""
    static = {topic.name for topic in model.evidence.topics if topic.static}
    for publisher in model.evidence.publishers:
        if publisher.topic in static and publisher.durability == "volatile":
            edges = [t.edge for t in model.statics if publisher.topic in t.topics]
            yield Hit(
                edges=tuple(edges),
                topics=(publisher.topic,),
                publishers=(publisher.node,) if publisher.node else (),
                facts={"topic": publisher.topic, "by": publisher.authority},
            )


@check(
    "static-late",
    Severity.WARNING,
    rule="a static first arrives more than {seconds:g} s after the first message in a frame "
    "below it, and is not dated before that message: then only the recorder heard it late",
    headline="{where} {concerned:arrives|arrive} later than messages that need {concerned:it|them}",
    detail="{edge}: {late:span} late; before it: {missed}",
    consequence="a listener that ran from the start could not place these messages, although the "
    "recording can",
    fixes=(Fix("start the publisher of the statics before the sensors"),),
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
    """Statics arrive later than messages that need them."""
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
    rule="the last static message of a publisher lacks some children; in rosbag2, which knows no "
    "publishers, the last {kept:g} messages do",
    headline="statics are in {messages} messages",
    detail="{told} {lost}",
    consequence="a player keeps only so many for late listeners",
    fixes=(
        Fix("start listeners before playing"),
        Fix("for new recordings: send a node's statics in one call of one broadcaster"),
    ),
    causes=("several static publishers",),
    links=threads("ros/ros_comm#706", "ros2/geometry2#585"),
    limits={"kept": 10},
    needs=("recording",),
    why="rosbag latches the last message of each publisher, and rosbag2 keeps the last ten",
)
def latched_overwrite(model: Model, limits: Limits) -> Iterator[Hit]:
    """Statics are in several messages, and playback keeps only the last."""
    transforms = model.evidence.transforms
    kept = 1 if is_ros1(model.evidence) else int(limits["kept"])
    held: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
    for edge in transforms.edges:
        for message in np.unique(edge.messages).tolist() if edge.static else ():
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
    """Waiting times of a topic's messages, until each can be placed in a frame.

    Attributes:
        stamps: The messages' stamps, shape (n,).
        waits: Time from arrival until the message can be placed, nanoseconds, shape (n,); or NEVER.
        link: The edge that delays lookups most.
        links: The moving edges on the path.
    """

    stamps: Stamps
    waits: Stamps
    link: Track
    links: tuple[Track, ...]

    @property
    def served(self) -> Stamps:
        """Return the waits of the messages that can be placed at some time."""
        served: Stamps = self.waits[self.waits != NEVER]
        return served

    def serves(self, percent: float) -> int:
        """Return the timeout, nanoseconds, that is enough for a percentage of `served`."""
        return int(np.percentile(self.served, percent, method="higher"))


def waits_of(model: Model, heard: Heard, fixed: str, *, warm: bool = True) -> Waits | None:
    """Return the waits of a topic's messages to be placed in a frame; None if the chain is static.

    Args:
        model: The evidence, prepared.
        heard: The headers of the messages.
        fixed: Frame in which messages are placed.
        warm: Whether the first and the last second of the recording are left out.
    """
    path = model.path(heard.frame, fixed)
    links = [track for track in path or () if not track.static and len(track.by_stamp)]
    if not links or any(not t.static and not len(t.by_stamp) for t in path or ()):
        return None
    low, high = model.warm if warm else (model.start, model.end)
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
    return Waits(stamps, waits, links[int(blame.argmax())], tuple(links))


@check(
    "sensor-outruns-tf",
    Severity.WARNING,
    rule="the 95 % quantile of the waits for the last transform that a message on the robot needs "
    "is {seconds:g} s or more, or a share above {never:g} never gets it. A note if a share"
    " above {refused:g} has to wait and the quantile is {note:g} s or more. At least "
    "{messages:g} messages, which are not markers or those of an IMU, a compass or a "
    "satellite receiver",
    headline="{topics} {topics:arrives|arrive} before the transforms {topics:it needs|they need}",
    detail="{refused:%} refused at arrival (in {fixed}); wait {p50:span} (median), {p95:span} "
    "(95 %), {worst:span} (worst); {never:%} never served; held up by {link}, which comes every "
    "{period:span}, {arrives}",
    consequence='"extrapolation into the future", or a message filter that drops messages because '
    "its queue is full",
    causes=(
        "odometry is slower or later than the sensor",
        "the clocks of two computers",
        "a constant on /tf at 10 Hz",
        "load",
    ),
    links=threads(
        "SteveMacenski/slam_toolbox#516",
        "SteveMacenski/slam_toolbox#576",
        "ApolloAuto/apollo#12088",
    ),
    limits={"seconds": 0.1, "never": 0.05, "refused": 0.5, "note": 0.05, "messages": 5},
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
            "edge-stopped stale-stamp clock-offset zero-stamp frozen-stamp single-sample "
            "nan-transform future-stamp loop",
        ),
        ("gap", "gap"),
        ("frame", "loop"),
    ),
)
def sensor_outruns_tf(model: Model, limits: Limits) -> Iterator[Hit]:
    """Lookups at the sensor's stamps refuse, because transforms arrive later."""
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
    """Yield the topics whose messages are looked up one by one, with their waits."""
    fixed = model.sensor_frame
    around = {track.parent for track in model.above(fixed)}
    for heard in model.heard:
        if not heard.is_spatial or len(heard.stamps) < limits["messages"]:
            continue
        if last_part(heard.type) in _NOT_PLACED:
            continue
        if heard.frame in around or last_part(heard.frame) in _WORLDS:
            continue  # it is placed in the world without the robot's pose
        waits = waits_of(model, heard, fixed)
        if waits is not None:
            yield heard, waits


def _is_relay(first: tuple[Heard, Waits], other: tuple[Heard, Waits]) -> bool:
    """Whether two topics in one frame wait for the same link, for as long and as often."""
    (heard, waits), (also, its) = first, other
    if heard.frame != also.frame or waits.link is not its.link:
        return False
    if not len(waits.served) or not len(its.served):
        return len(waits.served) == len(its.served)
    near = [abs(waits.serves(share) - its.serves(share)) for share in (50, 95)]
    often = abs(float((waits.waits > 0).mean() - (its.waits > 0).mean()))
    return max(near) <= max(_RELAYED, ALIKE * waits.serves(95)) and often <= ALIKE


def _outrun(model: Model, group: list[tuple[Heard, Waits]], limits: Limits) -> Hit | None:
    """Return the hit about topics that wait alike; None if all waits are short."""
    heard, waits = max(group, key=lambda one: int(one[1].served.max(initial=0)))
    served = waits.served
    never = 1.0 - len(served) / len(waits.waits)
    p50, p95, worst = (
        (waits.serves(50), waits.serves(95), int(served.max())) if len(served) else (0, 0, 0)
    )
    refused = float(np.count_nonzero(waits.waits > 0)) / len(waits.waits)
    if p95 > limits["seconds"] * NANOSECONDS or never > limits["never"]:
        severity = Severity.WARNING
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
            "arrives": arrival(link.median_latency),
            "path": [list(track.edge) for track in waits.links],
            "gap": _only_in_holes(waits, limits["seconds"]),
        },
        since=min(int(one.logs[0]) for one, _ in group),
        frames=(heard.frame, model.sensor_frame),
        topics=topics,
        count=sum(int(np.count_nonzero(its.waits > 0)) for _, its in group),
        severity=severity,
        fixes=_cures(heard, waits, limits["seconds"]),
        alone=True,
    )


_RELAYED = 5_000_000
"""Maximum difference between the waits of a topic and of its relayed copy, nanoseconds."""

_NOT_PLACED = frozenset({"Imu", "MagneticField", "NavSatFix", "Marker"})
"""Types of messages that filters use on arrival, or that are only drawn."""

_WORLDS = frozenset({"map", "world", "earth"})


def _only_in_holes(waits: Waits, wait: float) -> bool:
    """Whether nearly all messages that wait too long are stamped in a gap of a link."""
    late = waits.waits > wait * NANOSECONDS
    for link in waits.links:
        for begin, end in holes(link, gap.limits):
            late &= (waits.stamps <= begin) | (waits.stamps > end)
    return float(np.count_nonzero(late)) <= 0.05 * len(late)


def _cures(heard: Heard, waits: Waits, wait: float) -> tuple[Fix, ...]:
    """Return remedies: a timeout that is enough for all messages in `served`, if waiting helps."""
    worst = int(waits.served.max(initial=0))
    if worst < 10_000_000:
        return ()
    usual = waits.serves(95)
    later = waits.link.median_latency - heard.median_latency
    often = least_rate(waits.link.name, waits.link.period, later, wait)
    depth = max(1, math.ceil((usual if worst > 3 * usual else worst) / NANOSECONDS * rate(heard)))
    ahead = Fix(
        f"or date {waits.link.name} {math.ceil(worst / 1e6)} ms further ahead (transform_tolerance)"
    )
    mount = Fix(f"or, if {waits.link.name} is a mount, as it never moved: send it on /tf_static")
    wait_for = (
        f"wait for it: a timeout of {rounded_up(worst) // 10**6} ms is enough for all that can "
        f"ever be placed ({math.ceil(usual / 1e6)} ms for 95 %)"
    )
    if worst > 3 * usual:  # a stall, and no wait to plan for
        wait_for = (
            f"wait for it: a timeout of {max(10, rounded_up(usual) // 10**6)} ms is enough for "
            f"95 %; the longest wait, {span(worst)}, is a stall"
        )
    return (
        Fix(wait_for),
        *((Fix(f"or {often}") if later < wait * NANOSECONDS else Fix(often),) if often else ()),
        *((ahead,) if waits.link.is_localisation else ()),
        *((mount,) if not waits.link.moves else ()),
        *((Fix(f"let the message filter's queue hold {depth} messages"),) if depth > 1 else ()),
    )


def rounded_up(nanoseconds: int) -> int:
    """Round nanoseconds up to a multiple of 10 ms, the interval at which tf2 tries again."""
    return math.ceil(nanoseconds / 10_000_000) * 10_000_000


def least_rate(link: str, period: int, later: int, wait: float) -> str:
    """Return a sentence with the rate at which an edge is fast enough; empty if it already is.

    Args:
        link: Name of the link that delays a lookup.
        period: Period of the edge, nanoseconds; 0 if unknown.
        later: Latency of the edge minus that of the message, nanoseconds.
        wait: Time that the listener waits, seconds.
    """
    left = wait - later / NANOSECONDS
    told = f"a {wait * 1e3:g} ms wait"
    if left <= 0:
        return (
            f"no rate is enough for {told}: each transform arrives {later / 1e6:.0f} ms later "
            "after its stamp than the message"
        )
    needed = math.ceil(10 / left) / 10
    # A rate that is only a few percent higher changes nothing.
    if 0 < needed * period < 1.2 * NANOSECONDS:
        return ""
    return f"publish {link} at {needed:g} Hz or more, enough for {told}"


@check(
    "cache-short",
    Severity.WARNING,
    rule="95 % of a topic's messages arrive later than the cache time (10 s; --cache-time)",
    headline="{topic} arrives later than the cache keeps its moment",
    detail="{topic}: {late:span} after its stamp (median), {worst:span} at most; the buffer "
    "keeps {cache:span}",
    consequence='"extrapolation into the past": the transforms it needs were dropped',
    fixes=(
        Fix("{cache}", "{buffer}"),
        Fix("or look up when the measurement arrives, and keep the result"),
    ),
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
        if float(np.percentile(latency, 95)) > model.settings.cache_time and not stands_still(
            heard
        ):
            worst = int(latency.max())
            yield hit_of(
                heard,
                {
                    "late": int(np.median(latency)),
                    "worst": worst,
                    "cache": model.settings.cache_time,
                    "needed": math.ceil(worst / NANOSECONDS) + 1,
                },
                count=int(np.count_nonzero(latency > model.settings.cache_time)),
            )


@check(
    "late-start",
    Severity.NOTE,
    rule="messages are older than the first transform they need by more than {seconds:g} s, "
    "and arrive after the first second of the recording; if a localiser stamps that "
    "transform ahead by up to 2 s, the limit grows by as much",
    headline="{where} {concerned:begins|begin} later than messages that need {concerned:it|them}",
    detail="{edge} begins at {begin:moment}: {lost} messages of {topic} can never be placed "
    "in {fixed}",
    consequence="waiting does not help; skip these messages",
    causes=(
        "AMCL dates its first transform ahead (transform_tolerance)",
        "a node that starts later",
    ),
    limits={"seconds": 0.5},
    needs=(
        "log times",
        "headers",
    ),
    why="every recording needs its first second to start, and a localiser that stamps ahead"
    " always loses that time",
    because_of=(
        ("stream", "clock-mixture frozen-stamp"),
        ("edge", "wild-stamp clock-offset"),
    ),
)
def late_start(model: Model, limits: Limits) -> Iterator[Hit]:
    """Lookups cannot succeed at first: an edge begins late or is stamped ahead."""
    fixed = model.fixed_frame
    for heard in model.heard:
        if not heard.is_spatial or last_part(heard.type) == "NavSatFix":
            continue  # a satellite fix is placed by its numbers, not by its frame
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
            yield Hit(
                edges=(last.edge,),
                topics=(heard.topic,),
                since=int(heard.logs[0]),
                count=lost,
                facts={
                    "edge": last.name,
                    "begin": begin,
                    "lost": lost,
                    "topic": heard.topic,
                    "fixed": fixed,
                },
            )


@check(
    "truncated-recording",
    Severity.NOTE,
    rule="part of the recording could not be read",
    headline="part of the recording could not be read",
    detail="{damage}",
    consequence="data after the damage is not in this report",
    causes=(
        "the recorder was killed",
        "a full disk",
    ),
)
def truncated_recording(model: Model, limits: Limits) -> Iterator[Hit]:
    """The recorder was killed, or the file is damaged: only the first part was read."""
    if model.evidence.damage:
        yield Hit(facts={"damage": " ".join(model.evidence.damage)}, alone=True)
