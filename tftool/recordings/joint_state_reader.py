"""Reading of joint positions from recorded messages in bulk."""

import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS
from tftool.recordings.container_reader import short_type
from tftool.recordings.contract import Floats, RecordedTopic, Source, Stamps
from tftool.robots.joint_states import JointStates

JOINT_STATE: Final = "sensor_msgs/JointState"

MOST_JOINTS: Final = 10_000
"""Names one message may have."""

Words: TypeAlias = npt.NDArray[np.uint32]


@dataclass(frozen=True, slots=True, eq=False)
class RecordedJoints:
    """Joint states of a recording.

    Attributes:
        states: Joint states grouped by the list of joint names in the messages, in the order in
            which the lists were first seen.
        ignored: Number of messages without positions, by the reason as a sentence.
    """

    states: tuple[JointStates, ...] = ()
    ignored: dict[str, int] = field(default_factory=dict)


def joint_state_topics(topics: Iterable[RecordedTopic], namespace: str = "") -> tuple[str, ...]:
    """Return the topics that robot_state_publisher would subscribe to.

    Args:
        topics: Topics of a recording.
        namespace: Namespace of the robot's description: `/arm` for `/arm/robot_description`.

    Returns:
        `joint_states` of that namespace; where there is none, of all namespaces.
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


def read_joint_states(source: Source, topics: Sequence[str]) -> RecordedJoints:
    """Read the JointState messages of some topics.

    As in robot_state_publisher, a message with different numbers of names and positions is ignored.

    Args:
        source: The recording.
        topics: Names of topics it has.
    """
    layouts = {
        topic.name: _Ros1() if topic.encoding == "ros1" else _Cdr()
        for topic in source.topics
        if topic.name in topics
    }
    groups: dict[tuple[str, ...], _NameGroup] = {}
    ignored: dict[str, int] = {}
    last: dict[str, _Template] = {}
    known: dict[tuple[str, bytes], _Template] = {}
    for message in source.messages(topics):
        payload = message.payload
        topic = message.sender.topic
        template = last.get(topic)
        if template is None or not template.fits(payload):
            layout = layouts[topic]
            try:
                template = layout.template(payload)
            except (struct.error, ValueError, UnicodeDecodeError):
                text = f"'{topic}' has a message that is no JointState"
                ignored[text] = ignored.get(text, 0) + 1
                continue
            if template.problem:
                text = f"'{topic}' has a message {template.problem}"
                ignored[text] = ignored.get(text, 0) + 1
                continue
            template = known.setdefault((topic, template.head), template)
            last[topic] = template
        group = groups.get(template.names)
        if group is None:
            group = groups[template.names] = _NameGroup(template.names)
        group.add(template, payload)
    return RecordedJoints(tuple(group.columns() for group in groups.values()), ignored)


@dataclass(frozen=True, slots=True)
class _Template:
    """Offsets in a message, and the bytes that identify messages of the same layout.

    Attributes:
        order: "<" or ">".
        stamp: Offset of the stamp.
        head: The bytes from `after` to the positions: frame, names, number of positions.
        after: Offset of `head`.
        begin: Offset of the positions.
        end: Offset of their end.
        names: The joints.
        problem: Reason why it holds no positions; empty if it does.
    """

    order: str
    stamp: int
    head: bytes
    after: int
    begin: int
    end: int
    names: tuple[str, ...]
    problem: str = ""

    def fits(self, payload: bytes) -> bool:
        """Whether another message has the same offsets."""
        return len(payload) >= self.end and payload.startswith(self.head, self.after)


class _Layout:
    """Byte layout of a JointState: after a prefix, with or without alignment."""

    origin = 0
    stamp = 0
    aligned = False

    def order(self, payload: bytes) -> str:
        return "<"

    def template(self, payload: bytes) -> _Template:
        """Parse one message up to its positions.

        Raises:
            struct.error: If it is cut off.
            ValueError: If it is not a JointState.
        """
        order = self.order(payload)
        number = struct.Struct(f"{order}I")
        place = after = self.stamp + 8

        def align(place: int, size: int) -> int:
            return place + (self.origin - place) % size if self.aligned else place

        def text(place: int) -> tuple[bytes, int]:
            place = align(place, 4)
            (length,) = number.unpack_from(payload, place)
            end = place + 4 + length
            if end > len(payload):
                raise ValueError("cut off")
            return payload[place + 4 : end].rstrip(b"\0"), end

        _, place = text(place)
        place = align(place, 4)
        (count,) = number.unpack_from(payload, place)
        if count > MOST_JOINTS:
            raise ValueError("too many names")
        place += 4
        names = []
        for _ in range(count):
            name, place = text(place)
            names.append(name.decode("utf-8"))
        place = align(place, 4)
        (positions,) = number.unpack_from(payload, place)
        begin = align(place + 4, 8)
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
        head = payload[after:begin]
        return _Template(order, self.stamp, head, after, begin, end, tuple(names), problem)


class _Cdr(_Layout):
    """ROS 2's layout: four bytes with the byte order, then aligned data."""

    origin = 4
    stamp = 4
    aligned = True

    def order(self, payload: bytes) -> str:
        """Return the byte order, given in the second byte."""
        return "<" if payload[1:2] in (b"\1", b"\3") else ">"


class _Ros1(_Layout):
    """ROS 1's layout: a sequence number first, and no alignment."""

    stamp = 4


class _NameGroup:
    """Messages with the same joint names."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names = names
        self._stamps: list[bytes] = []
        self._positions: list[bytes] = []
        self._runs: list[tuple[str, int]] = []

    def add(self, template: _Template, payload: bytes) -> None:
        """Append a message's stamp and positions."""
        self._stamps.append(payload[template.stamp : template.stamp + 8])
        self._positions.append(payload[template.begin : template.end])
        if not self._runs or self._runs[-1][0] != template.order:
            self._runs.append((template.order, len(self._stamps) - 1))

    def columns(self) -> JointStates:
        """Return all of them."""
        ends = [start for _, start in self._runs[1:]] + [len(self._stamps)]
        stamps: list[Stamps] = []
        positions: list[Floats] = []
        for (order, first), last in zip(self._runs, ends, strict=True):
            words = np.frombuffer(b"".join(self._stamps[first:last]), dtype=f"{order}u4")
            whole: Words = words.reshape(-1, 2)
            stamps.append(whole[:, 0].astype(np.int64) * NANOSECONDS + whole[:, 1])
            raw = np.frombuffer(b"".join(self._positions[first:last]), dtype=f"{order}f8")
            positions.append(raw.astype(np.float64).reshape(last - first, len(self.names)))
        return JointStates(self.names, np.concatenate(stamps), np.concatenate(positions))
