"""Insertion of a recorded robot description's frames into a buffer of recorded transforms."""

import re
import struct
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Final

import numpy as np

from tftool.base.errors import DescriptionError, InputError
from tftool.base.stamps import NANOSECONDS
from tftool.buffer.buffer import Buffer
from tftool.messages.classes import INTERFACES
from tftool.messages.codec import Codec
from tftool.messages.layouts import CDR, ROS1
from tftool.recordings.container_reader import Recorded, short_type
from tftool.recordings.contract import RecordedTopic
from tftool.robots.joint_motion import JointStates
from tftool.robots.robot_model import Robot, parse_robot, set_still
from tftool.robots.urdf import LARGEST

JOINT_STATE: Final = "sensor_msgs/JointState"

MOST_JOINTS: Final = 10_000
"""Maximum number of joint names in a message."""


@dataclass(frozen=True, slots=True, eq=False)
class RecordedJoints:
    """Joint states of a recording, with counts of messages that were ignored.

    Attributes:
        states: Joint states, one item for each different list of joint names in the messages.
        ignored: Number of ignored messages, by the reason as a sentence.
    """

    states: tuple[JointStates, ...] = ()
    ignored: Mapping[str, int] = field(default_factory=dict)


def joint_state_topics(topics: Iterable[RecordedTopic], namespace: str = "") -> tuple[str, ...]:
    """Return the topics that robot_state_publisher would subscribe to.

    Args:
        topics: Topics of a recording.
        namespace: Namespace of the robot's description: `/arm` for `/arm/robot_description`.

    Returns:
        The topic `joint_states` of that namespace if recorded, else the topics `joint_states` of
        all namespaces.
    """
    named = [
        topic.name
        for topic in topics
        if short_type(topic.type) == JOINT_STATE
        and topic.encoding in ("cdr", "ros1")
        and topic.name.rpartition("/")[2] == "joint_states"
    ]
    own = [name for name in named if name.rpartition("/")[0].strip("/") == namespace.strip("/")]
    return tuple(own or named)


def read_joint_states(source: Recorded, topics: Sequence[str]) -> RecordedJoints:
    """Return the joint states in the JointState messages of some topics.

    As in robot_state_publisher, a message with different numbers of names and positions is ignored.

    Args:
        source: The recording.
        topics: Names of topics in the recording.
    """
    encodings = {topic.name: topic.encoding for topic in source.topics}
    groups: dict[tuple[tuple[str, ...], str], list[tuple[bytes, bytes]]] = {}
    ignored: Counter[str] = Counter()
    last: dict[str, _Template] = {}
    for message in source.messages(topics):
        payload, topic = message.payload, message.sender.topic
        template = last.get(topic)
        if template is None or not template.fits(payload):
            try:
                template = _template(payload, is_cdr=encodings[topic] != "ros1")
            except (struct.error, ValueError):
                ignored[f"'{topic}' has a message that is not a JointState"] += 1
                continue
            if template.problem:
                ignored[f"'{topic}' has a message {template.problem}"] += 1
                continue
            last[topic] = template
        stamp, positions = payload[4:12], payload[template.begin : template.end]
        groups.setdefault((template.names, template.order), []).append((stamp, positions))
    return RecordedJoints(tuple(_columns(*key, rows) for key, rows in groups.items()), ignored)


@dataclass(frozen=True, slots=True)
class _Template:
    """Byte offsets in all JointState messages with the same frame and joint names.

    Attributes:
        order: Byte order, "<" or ">".
        head: Bytes between the stamp and the positions: frame, names, number of positions.
        begin: Offset of the positions.
        end: Offset of the end of the positions.
        names: Names of the joints.
        problem: Reason why the message has no valid positions; else empty.
    """

    order: str
    head: bytes
    begin: int
    end: int
    names: tuple[str, ...]
    problem: str = ""

    def fits(self, payload: bytes) -> bool:
        """Whether a JointState message has the frame and the joint names of this template."""
        return len(payload) >= self.end and payload.startswith(self.head, 12)


def _template(payload: bytes, *, is_cdr: bool) -> _Template:
    """Parse a JointState message up to its positions.

    Raises:
        struct.error: If the message is cut off.
        ValueError: If the message is not a JointState.
    """
    # The stamp is after CDR's header, which has the byte order, or after ROS 1's sequence number.
    order = "<" if not is_cdr or payload[1:2] in (b"\1", b"\3") else ">"
    number = struct.Struct(f"{order}I")
    place = 12

    def align(size: int) -> int:
        return place + (4 - place) % size if is_cdr else place

    def text() -> tuple[bytes, int]:
        begin = align(4) + 4
        (length,) = number.unpack_from(payload, begin - 4)
        if begin + length > len(payload):
            raise ValueError("cut off")
        return payload[begin : begin + length].rstrip(b"\0"), begin + length

    _, place = text()
    place = align(4)
    (count,) = number.unpack_from(payload, place)
    if count > MOST_JOINTS:
        raise ValueError("too many names")
    place += 4
    names = []
    for _ in range(count):
        name, place = text()
        names.append(name.decode("utf-8"))
    place = align(4)
    (positions,) = number.unpack_from(payload, place)
    place += 4
    begin = align(8)
    end = begin + 8 * positions
    problem = ""
    if positions != count:
        problem = f"with {count} names and {positions} positions: the message is ignored"
    elif not count:
        problem = "without a joint"
    elif len(set(names)) != count:
        problem = "that names a joint twice"
    elif end > len(payload):
        raise ValueError("cut off")
    return _Template(order, payload[12:begin], begin, end, tuple(names), problem)


def _columns(names: tuple[str, ...], order: str, rows: list[tuple[bytes, bytes]]) -> JointStates:
    """Return the joint states from pairs of bytes: the stamp, and the positions of all joints."""
    stamps, positions = (b"".join(column) for column in zip(*rows, strict=True))
    times = np.frombuffer(stamps, dtype=f"{order}u4").reshape(-1, 2).astype(np.int64)
    found = np.frombuffer(positions, dtype=f"{order}f8").astype(np.float64)
    moments = times[:, 0] * NANOSECONDS + times[:, 1]
    return JointStates(names, moments, found.reshape(len(rows), len(names)))


STRING: Final = "std_msgs/String"
DESCRIPTION: Final = "robot_description"
_PLACEHOLDER: Final = re.compile(r'<robot name=""><link name=""\s*/></robot>')
_MOST_DESCRIPTIONS: Final = 8


@dataclass(frozen=True, slots=True)
class DescribedFrames:
    """Names of the frames that were added from a robot description, or could not be added.

    Attributes:
        still: Frames that were added with a static transform.
        moving: Frames that were added with poses from joint states.
        gaps: Frames without a pose, because joint states are missing.
        prefix: Prefix of the frame names, before the names of the robot's links.
    """

    still: tuple[str, ...] = ()
    moving: tuple[str, ...] = ()
    gaps: tuple[str, ...] = ()
    prefix: str = ""


def description_topics(topics: Iterable[RecordedTopic]) -> list[RecordedTopic]:
    """Return the topics that contain a robot description."""
    return [
        topic
        for topic in topics
        if short_type(topic.type) == STRING
        and topic.name.rpartition("/")[2] == DESCRIPTION
        and topic.encoding in ("cdr", "ros1")
        and topic.count
    ]


def read_description(source: Recorded, topic: RecordedTopic) -> Robot | None:
    """Return the first valid description on a topic.

    Returns:
        The robot; None if there are only placeholders, as some simulators send.

    Raises:
        InputError: If the message is not a string.
        DescriptionError: If all descriptions have mistakes; the error lists the mistakes of the
            first description.
    """
    kind = INTERFACES.message("std_msgs/msg/String")
    codec = Codec(kind, ROS1 if topic.encoding == "ros1" else CDR)
    first: DescriptionError | None = None
    # A description is latched, and so among the first messages: do not read the whole recording.
    for message in islice(source.messages([topic.name]), _MOST_DESCRIPTIONS):
        if len(message.payload) > LARGEST:
            raise InputError(f"no message on '{topic.name}' contains a readable description")
        text = codec.decode(message.payload).data
        if _PLACEHOLDER.fullmatch(text.strip()):
            continue
        try:
            return parse_robot(text, f"{source.name}:{topic.name}")
        except DescriptionError as error:
            first = first or error
    if first is not None:
        raise first
    return None


def prefix_of(robot: Robot, frames: Collection[str]) -> str:
    """Guess robot_state_publisher's `frame_prefix` from frame names; "" if no prefix fits."""
    known = frozenset(frames)
    if not known or any(link in known for link in robot.links):
        return ""
    counted: Counter[str] = Counter()
    links = frozenset(robot.links)
    for frame in known:
        match = re.fullmatch(r"(.*/)([^/]+)", frame)
        if match and match[2] in links:
            counted[match[1]] += 1
    return counted.most_common(1)[0][0] if counted else ""


def missing_motion(robot: Robot, frames: Collection[str], prefix: str) -> list[str]:
    """Return the names of the movable joints whose child frames are missing in `frames`."""
    return [
        joint.name
        for joint in robot.joints.values()
        if joint.moves and prefix + joint.child not in frames
    ]


def add_described(
    buffer: Buffer,
    robot: Robot,
    joints: RecordedJoints,
    frames: Collection[str],
    prefix: str = "",
) -> DescribedFrames:
    """Insert into a buffer the frames of a robot description that are missing in `frames`.

    Args:
        buffer: Buffer with the recorded transforms.
        robot: The description.
        joints: The joint states of the same recording.
        frames: Child frames in the recorded transforms. Their transforms stay unchanged.
        prefix: Prefix of the frame names, before the names of the robot's links.

    Returns:
        Names of the added frames, and of the frames that are still missing.
    """
    still = []
    lacking = {joint.child for joint in robot.joints.values() if prefix + joint.child not in frames}
    for joint in robot.joints.values():
        if joint.child in lacking and not joint.moves and joint.type != "floating":
            set_still(buffer, joint, prefix=prefix)
            still.append(prefix + joint.child)
    moved = set()
    for states in joints.states:
        for joint, records in robot.motion(states, lambda joint: joint.child in lacking):
            records = records[records[:, 0] != 0]
            if len(records):
                parent, child = prefix + joint.parent, prefix + joint.child
                buffer.set_records(parent, child, records, f"joint {joint.name}")
                moved.add(child)
    moving = [
        prefix + joint.child for joint in robot.joints.values() if prefix + joint.child in moved
    ]
    there = {*still, *moving}
    gaps = [
        prefix + joint.child
        for joint in robot.joints.values()
        if joint.child in lacking and prefix + joint.child not in there
    ]
    return DescribedFrames(tuple(still), tuple(moving), tuple(gaps), prefix)
