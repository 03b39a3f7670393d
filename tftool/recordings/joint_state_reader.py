"""Reader of joint positions from recorded JointState messages, in bulk."""

import struct
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.recordings.container_reader import Recorded, short_type
from tftool.recordings.contract import RecordedTopic
from tftool.robots.robot_model import JointStates

JOINT_STATE: Final = "sensor_msgs/JointState"

MOST_JOINTS: Final = 10_000
"""Maximum number of joint names in a message."""


@dataclass(frozen=True, slots=True, eq=False)
class RecordedJoints:
    """Joint states of a recording, with counts of messages that were ignored.

    Attributes:
        states: Joint states grouped by the list of joint names in the messages, in the order in
            which the lists were first seen.
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
        `joint_states` of that namespace; if there is none, those of all namespaces.
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
                ignored[f"'{topic}' has a message that is no JointState"] += 1
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
    """Byte offsets in a JointState message, and the bytes that all messages of its layout share.

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
        """Whether another message has the same layout."""
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
        problem = f"with {count} names and {positions} positions, which is ignored"
    elif not count:
        problem = "without a joint"
    elif len(set(names)) != count:
        problem = "that names a joint twice"
    elif end > len(payload):
        raise ValueError("cut off")
    return _Template(order, payload[12:begin], begin, end, tuple(names), problem)


def _columns(names: tuple[str, ...], order: str, rows: list[tuple[bytes, bytes]]) -> JointStates:
    """Return joint states from the bytes of stamps and positions, all in one byte order."""
    stamps, positions = (b"".join(column) for column in zip(*rows, strict=True))
    times = np.frombuffer(stamps, dtype=f"{order}u4").reshape(-1, 2).astype(np.int64)
    found = np.frombuffer(positions, dtype=f"{order}f8").astype(np.float64)
    moments = times[:, 0] * NANOSECONDS + times[:, 1]
    return JointStates(names, moments, found.reshape(len(rows), len(names)))
