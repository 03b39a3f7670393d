"""Evidence for a diagnosis, collected from a recording, a buffer or a session."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
import numpy.typing as npt

from tftool.base.errors import DescriptionError, InputError, UsageError, without_frames
from tftool.base.stamps import SIMULATED_BELOW, Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer
from tftool.doctor.stamp_stream import last_part
from tftool.frames.frames import Frames
from tftool.frames.transform_log import TransformLog
from tftool.recordings.container_reader import Recorded
from tftool.recordings.contract import (
    Edge,
    Floats,
    Headers,
    Publisher,
    RecordedTopic,
    Stamps,
    Transforms,
)
from tftool.recordings.description_frames import (
    description_topics,
    joint_state_topics,
    read_description,
    read_joint_states,
)
from tftool.recordings.tf_topics import superfluous, transforms_on
from tftool.robots.robot_model import Robot, load_urdf

if TYPE_CHECKING:
    from tftool.doctor.measured_mounts import MeasuredMount
    from tftool.recordings.recording import Recording

ODOMETRY = "nav_msgs/Odometry"

LIVE = "live session"
"""Kind of evidence from a running session (processes that share frames)."""

Records = npt.NDArray[np.int64]
Places = npt.NDArray[np.int32]


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """Evidence about frames: the complete input of the doctor's checks.

    Attributes:
        name: Name of the source, for messages.
        kind: Kind of source, such as "MCAP" or "scenario".
        transforms: All transforms as columns, with log times.
        headers: Headers of messages, by topic.
        clock: Times in the messages on `/clock`, and their log times, nanoseconds.
        topics: All topics.
        publishers: All publishers (streams of messages).
        damage: Sentences about unreadable parts of the source.
        start: Log time of the first message, nanoseconds.
        end: Log time of the last message, nanoseconds.
        timed: Whether log times are known; False for a buffer.
        recorded: Whether the source is a recording.
        joints: Joint names in all joint states; None if none were recorded.
        robot: Robot model from the given or recorded description; None if no description can be
            read.
        mistakes: Mistakes in the description, as sentences.
        odometry: Odometry messages as transforms; None without odometry.
        negative: For each Odometry topic with negative variances: number of messages with negative
            variances, number of all messages, and least variance.
        mounts: Sensors' mounts (static poses) measured from motion; None if not requested.
        commands: For each topic of commands without headers, such as cmd_vel: log times of the
            commands to move, nanoseconds; empty unless all moving transforms end early.
        played: Topic on which a player such as `ros2 bag play` wrote a log or declared a parameter;
            empty without one, or if no stamps are long before their reception.
        attitudes: Orientations in Imu messages, by their frame, for frames that a moving transform
            turns without moving them.
    """

    name: str
    kind: str
    transforms: Transforms
    headers: Mapping[str, Headers] = field(default_factory=dict)
    clock: tuple[Stamps, Stamps] = field(
        default_factory=lambda: (np.zeros(0, np.int64), np.zeros(0, np.int64))
    )
    topics: tuple[RecordedTopic, ...] = ()
    publishers: tuple[Publisher, ...] = ()
    damage: tuple[str, ...] = ()
    start: Stamp = 0
    end: Stamp = 0
    timed: bool = True
    recorded: bool = True
    joints: frozenset[str] | None = None
    robot: Robot | None = None
    mistakes: tuple[str, ...] = ()
    odometry: Transforms | None = None
    negative: Mapping[str, tuple[int, int, float]] = field(default_factory=dict)
    mounts: "tuple[MeasuredMount, ...] | None" = None
    commands: Mapping[str, Stamps] = field(default_factory=dict)
    played: str = ""
    attitudes: Mapping[str, "Attitudes"] = field(default_factory=dict)

    @property
    def is_generated(self) -> bool:
        """Whether log times are artificial: ten or more topics, all of the same exact period."""
        periods = {
            step
            for headers in self.headers.values()
            for step in np.diff(np.sort(headers.log_times)).tolist()
        }
        many = [headers for headers in self.headers.values() if len(headers.log_times) > 1]
        return len(periods) == 1 and len(many) >= _GENERATED

    @property
    def lacks_clock(self) -> bool:
        """Whether the source is a recording without `/clock`, so small stamps may be real."""
        return self.recorded and not len(self.clock[0])


@dataclass(frozen=True, slots=True, eq=False)
class Attitudes:
    """Orientations in the Imu messages of one topic.

    Attributes:
        topic: Name of the topic.
        log_times: Times of reception, nanoseconds, shape (n,).
        rotations: Quaternions x y z w as recorded, shape (n, 4).
    """

    topic: str
    log_times: Stamps
    rotations: Floats


# Evidence of a recording


@dataclass(frozen=True, slots=True)
class Described:
    """Result of the search for a robot description.

    Attributes:
        robot: The described robot; None if no description can be read.
        mistakes: Mistakes in the description, as sentences.
        namespace: Namespace of the description's topic: "/arm" for the topic
            "/arm/robot_description".
    """

    robot: Robot | None = None
    mistakes: tuple[str, ...] = ()
    namespace: str = ""


def described_by(path: str | Path) -> Described:
    """Return the robot of a URDF or xacro file, or the mistakes in the file.

    Raises:
        InputError: If the file cannot be read.
        UsageError: If the description needs xacro, and xacro is not installed.
    """
    try:
        return Described(load_urdf(path))
    except DescriptionError as error:
        return Described(mistakes=_mistakes(error))


def _recorded_description(source: Recorded) -> Described:
    for topic in description_topics(source.topics):
        namespace = topic.name.rpartition("/")[0]
        try:
            robot = read_description(source, topic)
        except DescriptionError as error:
            return Described(mistakes=_mistakes(error), namespace=namespace)
        except InputError as error:
            return Described(mistakes=(str(error),), namespace=namespace)
        if robot is not None:
            return Described(robot, namespace=namespace)
    return Described()


def _mistakes(error: DescriptionError) -> tuple[str, ...]:
    """Return each mistake in a description as "file:line:column: text"."""
    return tuple(
        f"{mistake.file}:{mistake.line}:{mistake.column}: {mistake.text}"
        for mistake in error.mistakes[: error.MOST]
    )


class Moment(Protocol):
    """A time as given by the user: seconds since the start, or a stamp."""

    def stamp(self, epoch: Stamp) -> Stamp:
        """Return the time as a stamp in nanoseconds; `epoch` is the first stamp of the source."""

    def meant(self, epoch: Stamp, end: Stamp) -> str:
        """Return a hint if the time was probably meant as a stamp, else "".

        The hint begins with a space, because it follows another sentence.
        """


@dataclass(frozen=True, slots=True)
class Scope:
    """Part of a recording to examine; by default the whole recording.

    Attributes:
        described: The robot's description; None for the recorded description, if any.
        tf_topics: Topics of moving transforms to read, such as /tf; the static topic of each is
            read too. Empty for all topics.
        begin: Time at which the part begins; None for the recording's start.
        end: Time at which the part ends; None for the recording's end.
    """

    described: Described | None = None
    tf_topics: tuple[str, ...] = ()
    begin: Moment | None = None
    end: Moment | None = None


def evidence_of_recording(recording: "Recording", scope: Scope | None = None) -> Evidence:
    """Return the evidence in a recording.

    Args:
        recording: The recording.
        scope: Part of the recording, and a description; None for the whole recording.

    Raises:
        InputError: If the file cannot be read, a topic is missing, or the part is empty.
    """
    source, scope = recording.source, scope or Scope()
    if scope.tf_topics:
        transforms, names = transforms_on(source, scope.tf_topics)
        evidence = _evidence_of_source(source, transforms, scope.described)
        headers = {
            topic: replace(one, names=tuple(names.named(topic, frame) for frame in one.names))
            for topic, one in evidence.headers.items()
        }
        evidence = replace(evidence, headers=headers)
    else:
        evidence = _evidence_of_source(source, recording.transforms, scope.described)
    if scope.begin is None and scope.end is None:
        return evidence
    begin = evidence.start if scope.begin is None else scope.begin.stamp(evidence.start)
    end = evidence.end if scope.end is None else scope.end.stamp(evidence.start)
    if begin > end and scope.begin is not None and scope.end is not None:
        raise UsageError("--to is before --from: exchange the two times.")
    if begin > evidence.end or end < evidence.start or begin >= end:
        length = as_seconds(evidence.end - evidence.start)
        # Log times and stamps may be times of two clocks; a user may mean either.
        spans = (evidence.start, evidence.end), (recording.start or 0, recording.end or 0)
        meant = [] if scope.begin is None else [scope.begin.meant(*span) for span in spans]
        raise InputError(
            f"'{source.name}' has no data between --from and --to: choose times from 0 to "
            f"{length:.3f} s, the length of the recording.{next(filter(None, meant), '')}"
        )
    return within(evidence, max(begin, evidence.start), min(end, evidence.end))


def _evidence_of_source(
    source: Recorded, transforms: Transforms, described: Described | None
) -> Evidence:
    described = described or _recorded_description(source)
    odometry = [topic.name for topic in source.topics if topic.type == ODOMETRY and topic.count]
    joints = None
    if described.robot is not None:
        names = joint_state_topics(source.topics, described.namespace)
        if names:
            states = read_joint_states(source, names).states
            joints = frozenset(name for one in states for name in one.names)
    headers = source.headers()
    return Evidence(
        joints=joints,
        robot=described.robot,
        mistakes=described.mistakes,
        odometry=source.transforms(odometry) if odometry else None,
        negative=_negative_variances(source, odometry),
        name=source.name,
        kind=source.kind,
        transforms=transforms,
        headers=headers,
        clock=source.clock(),
        topics=source.topics,
        publishers=source.publishers,
        damage=tuple(dict.fromkeys((*source.damage, *transforms.damage))),
        start=source.start,
        end=source.end,
        commands=_commands(source, transforms),
        played=_player_topic(source, headers.values(), transforms),
        attitudes=_attitudes(source, headers, transforms),
    )


def _attitudes(
    source: Recorded, headers: Mapping[str, Headers], transforms: Transforms
) -> dict[str, Attitudes]:
    """Return the orientations in Imu messages; see the attribute `attitudes` of `Evidence`."""
    turning = {
        edge.child
        for edge in transforms.edges
        if not edge.static
        and not (edge.translations != edge.translations[:1]).any()
        and (edge.rotations != edge.rotations[:1]).any()
    }
    frames = {
        topic: one.names[0].removeprefix("/")
        for topic, one in headers.items()
        if one.type == "sensor_msgs/Imu" and len(one.names) == 1
    }
    frames = {topic: frame for topic, frame in frames.items() if frame in turning}
    rows: dict[str, list[tuple[Stamp, bytes]]] = {}
    for message in source.messages(frames) if frames else ():
        # A message ends with the orientation, its covariance, and two vectors with covariances.
        turn = message.payload[-_IMU_TAIL : 32 - _IMU_TAIL]
        if len(turn) == 32:
            rows.setdefault(message.sender.topic, []).append((message.log_time, turn))
    return {
        frames[topic]: Attitudes(
            topic,
            np.array([log for log, _ in found], dtype=np.int64),
            np.frombuffer(b"".join(turn for _, turn in found), dtype="<f8").reshape(-1, 4),
        )
        for topic, found in rows.items()
    }


_IMU_TAIL = 8 * (4 + 9 + 3 + 9 + 3 + 9)
"""Bytes of an Imu message after its header."""


def _player_topic(source: Recorded, heard: Iterable[Headers], transforms: Transforms) -> str:
    """Return the first topic that names a player; see the attribute `played` of `Evidence`."""
    pairs = [(one.stamps, one.log_times) for one in heard]
    pairs += [(one.stamps, transforms.log_times_of(one)) for one in transforms.edges]
    is_late = any(
        len(stamps) and stamps.min() > SIMULATED_BELOW and np.median(logs - stamps) > _LATE
        for stamps, logs in pairs
    )
    topics = [topic.name for topic in source.topics if topic.type in _BY_NODES and topic.count]
    for message in source.messages(topics) if topics and is_late else ():
        if _PLAYER_NAME.search(message.payload):
            return message.sender.topic
    return ""


_LATE = seconds(2)
"""Median time from stamp to reception from which a recording may have been played again."""

_BY_NODES = frozenset({"rcl_interfaces/Log", "rcl_interfaces/ParameterEvent", "rosgraph_msgs/Log"})
"""Types of messages with the name of the node that sends them."""

_PLAYER = r"play_\d{15,}|rosbag2_player"
"""Pattern of the names of the nodes of `rosbag play` and `ros2 bag play`."""

_PLAYER_NAME = re.compile(rb"(?<![\w-])(?:" + _PLAYER.encode() + rb")(?![\w-])")


def _commands(source: Recorded, transforms: Transforms) -> dict[str, Stamps]:
    """Return the log times of commands to move; see the attribute `commands` of `Evidence`."""
    moving = [
        edge for edge in transforms.edges if (edge.records[:, 1:] != edge.records[:1, 1:]).any()
    ]
    last = max((int(transforms.log_times_of(edge).max()) for edge in moving), default=source.end)
    topics = [
        topic.name
        for topic in source.topics
        if topic.type in _COMMANDS and topic.count and topic.encoding in ("cdr", "ros1")
    ]
    if source.end - last < seconds(1) or not topics:
        return {}
    times: dict[str, list[int]] = {}
    for message in source.messages(topics):
        # A Twist has six numbers of 8 bytes, an AckermannDrive five of 4 bytes.
        size, kind = (48, "<f8") if len(message.payload) >= 48 else (20, "<f4")
        payload = message.payload[-size:]
        if len(payload) == size and np.frombuffer(payload, kind).any():
            times.setdefault(message.sender.topic, []).append(message.log_time)
    return {topic: np.sort(np.array(found, dtype=np.int64)) for topic, found in times.items()}


_COMMANDS = frozenset({"geometry_msgs/Twist", "ackermann_msgs/AckermannDrive"})
"""Types of commands to move, which have no header."""


def _negative_variances(
    source: Recorded, topics: Sequence[str]
) -> dict[str, tuple[int, int, float]]:
    """Count messages with a negative variance; see the attribute `negative` of `Evidence`."""
    least: dict[str, list[float]] = {}
    for message in source.messages(topics) if topics else ():
        # A message ends with a pose, its covariance, a twist, and its covariance.
        if len(message.payload) >= _ODOMETRY_TAIL:
            tail = np.frombuffer(message.payload[-_ODOMETRY_TAIL:], dtype="<f8")
            least.setdefault(message.sender.topic, []).append(float(tail[7:43:7].min()))
    found = {}
    for topic, values in least.items():
        wrong = [value for value in values if value < 0.0 and value != -1.0]
        if wrong:
            found[topic] = (len(wrong), len(values), min(wrong))
    return found


_GENERATED = 10
"""Minimum number of topics with one exact period that proves invented log times."""

_ODOMETRY_TAIL = 8 * (7 + 36 + 6 + 36)
"""Bytes of an Odometry message after its names."""


def within(evidence: Evidence, begin: Stamp, end: Stamp) -> Evidence:
    """Cut the evidence to the data between two log times, and keep earlier static transforms."""
    read_clock, received = evidence.clock
    ticks = (received >= begin) & (received <= end)
    return replace(
        evidence,
        transforms=_cut(evidence.transforms, begin, end),
        headers={
            topic: _cut_headers(headers, begin, end) for topic, headers in evidence.headers.items()
        },
        # If there are no readings in between, use all readings of the clock.
        clock=(read_clock[ticks], received[ticks]) if ticks.any() else evidence.clock,
        odometry=None if evidence.odometry is None else _cut(evidence.odometry, begin, end),
        start=begin,
        end=end,
        commands={
            topic: times[(times >= begin) & (times <= end)]
            for topic, times in evidence.commands.items()
        },
    )


def _cut(transforms: Transforms, begin: Stamp, end: Stamp) -> Transforms:
    edges = []
    for edge in transforms.edges:
        logs = transforms.log_times_of(edge)
        inside = (logs <= end) & (edge.static | (logs >= begin))
        if inside.any():
            edges.append(
                Edge(
                    edge.parent,
                    edge.child,
                    edge.static,
                    min(edge.slashed, int(np.count_nonzero(inside))),
                    edge.records[inside],
                    edge.messages[inside],
                )
            )
    return replace(transforms, edges=tuple(edges))


def _cut_headers(headers: Headers, begin: Stamp, end: Stamp) -> Headers:
    inside = (headers.log_times >= begin) & (headers.log_times <= end)
    return replace(
        headers,
        stamps=headers.stamps[inside],
        log_times=headers.log_times[inside],
        frames=headers.frames[inside],
    )


def without_doubtful_names(transforms: Transforms) -> Transforms:
    """Return transforms without node names, if the names are not those of the real publishers.

    Two cases are found. `rosbag filter` and similar programs write one connection for each topic,
    with the name of the first node. If a player is the only node, all transforms come from another
    recording.
    """
    publishers = transforms.publishers
    named = {one.node for one in publishers if one.node}
    if not named or not transforms.edges:
        return transforms
    if all(map(is_player, named)) or _has_merged_nodes(transforms):
        publishers = tuple(replace(one, node="") for one in publishers)
        return replace(transforms, publishers=publishers)
    return transforms


def _has_merged_nodes(transforms: Transforms) -> bool:
    """Whether a static_transform_publisher of ROS 1 seems to send other transforms as well.

    A real static_transform_publisher sends one constant transform, with a stamp one period in the
    future. A node of a simulator stamps all its transforms alike, so the result is True only if
    one of the other transforms has a stamp in the past.
    """
    moving = [edge for edge in transforms.edges if not edge.static and len(edge) >= _REPEATS]
    ahead = [float(np.median(edge.stamps - transforms.log_times_of(edge))) for edge in moving]
    late: set[int] = set()
    for edge, by in zip(moving, ahead, strict=True):
        if by < 0.0:
            late.update(np.unique(transforms.senders_of(edge)).tolist())
    if not late:
        return False
    messages = np.concatenate([edge.messages for edge in transforms.edges])
    sizes = np.bincount(messages, minlength=len(transforms.log_times))
    for edge, by in zip(moving, ahead, strict=True):
        senders = transforms.senders_of(edge)
        sender = int(senders[0])
        if by <= 0.0 or sender not in late or not transforms.publishers[sender].node:
            continue
        if (senders != sender).any() or (sizes[edge.messages] > 1).any():
            continue
        period = float(np.median(np.diff(edge.stamps)))
        is_constant = not (edge.records[:, 1:] != edge.records[0, 1:]).any()
        if is_constant and abs(by - period) < 0.1 * period:
            return True
    return False


_REPEATS = 10
"""Minimum number of samples that show how a transform is dated."""


def without_copies(evidence: Evidence) -> tuple[tuple[Edge, ...], dict[str, int]]:
    """Leave out transforms on other topics than /tf that a listener does not need beside /tf.

    Such transforms are on a topic of type TransformStamped, if a list of transforms (TFMessage) has
    the child frame too. Or they are on another topic than /tf, and half of their stamps or more are
    stamps of the same edge on /tf.

    Args:
        evidence: Evidence of any source.

    Returns:
        The edges with the other transforms, and the number of left-out transforms of each topic.
    """
    transforms, copies = evidence.transforms, Counter[str]()
    topics = [one.topic for one in transforms.publishers]
    single = {one.name for one in evidence.topics if last_part(one.type) == "TransformStamped"}
    usual = np.array(
        [topic not in single and topic.strip("/") in ("tf", "tf_static") for topic in topics]
    )
    if usual.all():
        return transforms.edges, copies
    edges = []
    for edge, left in zip(transforms.edges, superfluous(transforms, single), strict=True):
        senders = transforms.senders_of(edge)
        heard = usual[senders]
        for number in np.unique(senders[~heard & ~left]).tolist() if heard.any() else ():
            own = senders == number
            left |= own & (np.isin(edge.stamps[own], edge.stamps[heard]).mean() >= _COPIED)
        if left.any():
            for number in senders[left].tolist():
                copies[topics[number]] += 1
            edge = edge.chosen(~left)
        if len(edge):
            edges.append(edge)
    return tuple(edges), copies


_COPIED = 0.5
"""Minimum fraction of equal stamps, for a topic that repeats the transforms of /tf."""


def is_player(node: str) -> bool:
    """Whether a node has the name of `rosbag play` or `ros2 bag play`."""
    return re.fullmatch(_PLAYER, last_part(node)) is not None


# Evidence of a buffer


def evidence_of_buffer(buffer: Buffer, name: str = "buffer") -> Evidence:
    """Return the evidence in a buffer; the stamps of the samples also serve as log times."""
    parts: dict[tuple[str, str, bool], list[tuple[Records, Places]]] = {}
    logs: list[Stamps] = []
    senders: list[npt.NDArray[np.int32]] = []
    known: dict[Publisher, int] = {}
    count = 0
    for child in buffer.frames():
        held = buffer.samples(child)
        topic = "/tf_static" if held.is_static else "/tf"
        records = np.empty((len(held.stamps), 8), dtype=np.int64)
        records[:, 0] = held.stamps
        records.view(np.float64)[:, 1:] = held.poses
        places = np.arange(count, count + len(records), dtype=np.int32)
        count += len(records)
        logs.append(records[:, 0])
        for one in _runs(held.parents):
            key = (str(held.parents[one[0]]), child, held.is_static)
            parts.setdefault(key, []).append((records[one], places[one]))
        sender = np.zeros(len(records), dtype=np.int32)
        for one in _runs(held.authorities):
            publisher = Publisher(topic, str(held.authorities[one[0]]))
            sender[one] = known.setdefault(publisher, len(known))
        senders.append(sender)
    log_times = np.concatenate(logs) if logs else np.zeros(0, dtype=np.int64)
    moving = log_times[log_times != 0]
    edges = tuple(
        Edge(*key, 0, np.concatenate([r for r, _ in of]), np.concatenate([p for _, p in of]))
        for key, of in parts.items()
    )
    sent_by = np.concatenate(senders) if senders else np.zeros(0, dtype=np.int32)
    transforms = Transforms(edges, log_times, sent_by, tuple(known))
    return Evidence(
        name=name,
        kind="buffer",
        transforms=transforms,
        publishers=tuple(known),
        start=int(moving.min()) if len(moving) else 0,
        end=int(moving.max()) if len(moving) else 0,
        timed=False,
        recorded=False,
    )


def _runs(names: npt.NDArray[np.object_]) -> list[Places]:
    """Return, for each distinct name, the array of its indices in `names`."""
    if not len(names) or bool((names == names[0]).all()):
        return [np.arange(len(names), dtype=np.int32)] if len(names) else []
    found: dict[str, list[int]] = {}
    for place, name in enumerate(names.tolist()):
        found.setdefault(name, []).append(place)
    return [np.array(places, dtype=np.int32) for places in found.values()]


# Evidence of a session


def evidence_of_log(log: TransformLog, name: str, kind: str, start: Stamp, end: Stamp) -> Evidence:
    """Return the evidence in a log of received transforms.

    Args:
        log: The received transforms.
        name: Name of the source, for messages.
        kind: Kind of the source.
        start: Time at which listening began, nanoseconds.
        end: Time at which listening ended, nanoseconds.
    """
    transforms = log.transforms()
    publishers = transforms.publishers
    counts = np.bincount(transforms.senders, minlength=len(publishers)).tolist()
    topics = tuple(
        RecordedTopic(
            topic,
            "tf2_msgs/TFMessage",
            count=sum(n for p, n in zip(publishers, counts, strict=True) if p.topic == topic),
            transforms=True,
            static=topic == "/tf_static",
        )
        for topic in sorted({publisher.topic for publisher in publishers})
    )
    return Evidence(
        name=name,
        kind=kind,
        transforms=transforms,
        topics=topics,
        publishers=publishers,
        start=start,
        end=end,
        recorded=False,
    )


def evidence_of_frames(frames: Frames, scope: Scope | None = None) -> Evidence:
    """Return the evidence in opened frames of any source.

    Args:
        frames: The frames of a recording, a scenario, a session or a description.
        scope: Part of a recording, and a description; None for the whole recording.

    Raises:
        InputError: If a recording cannot be read, a topic is missing, or the part is empty.
    """
    if frames.recording is not None:
        return evidence_of_recording(frames.recording, scope)
    described = None if scope is None else scope.described
    if frames.log is None:
        return _beside(evidence_of_buffer(frames.buffer, frames.title), described)
    kind = LIVE if frames.kind == "session" else frames.kind
    return _beside(evidence_of_log(frames.log, frames.title, kind, *frames.span), described)


def evidence_of(
    given: "Recording | Buffer | Frames", described: Described | None = None
) -> Evidence:
    """Return the evidence in a recording, a buffer or opened frames.

    Args:
        given: The recording, the buffer or the frames.
        described: The robot's description; None for the recorded description, if any.

    Raises:
        InputError: If the recording cannot be read.
        TypeError: If `given` is not a recording, a buffer or frames.
    """
    if isinstance(given, Frames):
        return evidence_of_frames(given, Scope(described))
    if not isinstance(given, Buffer):
        if not hasattr(given, "source"):
            raise without_frames(given)
        return evidence_of_recording(given, Scope(described))
    return _beside(evidence_of_buffer(given), described)


def _beside(evidence: Evidence, described: Described | None) -> Evidence:
    """Replace the robot in the evidence by the robot of a description; None changes nothing."""
    if described is None:
        return evidence
    return replace(evidence, robot=described.robot, mistakes=described.mistakes)
