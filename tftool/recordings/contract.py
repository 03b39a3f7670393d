"""Values and columns of recorded frames, topics and messages.

A recording is finite and complete. Times are whole nanoseconds: *stamps* are the times in headers,
*log times* are the times of reception by the recorder. Columns contain values exactly as recorded,
including NaN, zero quaternions, stamps of 0 and leading slashes.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import Stamp

Stamps: TypeAlias = npt.NDArray[np.int64]
"""Nanoseconds, shape (n,)."""

Floats: TypeAlias = npt.NDArray[np.float64]
"""Floating-point numbers of any shape."""

Indexes: TypeAlias = npt.NDArray[np.int32]
"""Indices in another column or list, shape (n,)."""

Row: TypeAlias = tuple[float, ...]
"""Place for a stamp, then x y z (metres) and x y z w (quaternion)."""


@dataclass(frozen=True, slots=True)
class RecordedTopic:
    """One topic of a recording, with its type and number of messages.

    Attributes:
        name: Name as recorded; some ROS 2 recordings have `tf` without a slash.
        type: Message type in short form: "tf2_msgs/TFMessage". A type that is not ROS's is
            unchanged: "foxglove.FrameTransform".
        encoding: "cdr", "ros1", "json", "protobuf", or another recorded encoding.
        count: Number of messages; in a damaged recording, number of messages before the damage.
        definition: Text of the message definition; empty if not recorded.
        transforms: Whether messages of this type contain transforms.
        static: Whether the transforms are static.
    """

    name: str
    type: str
    encoding: str = ""
    count: int = 0
    definition: str = ""
    transforms: bool = False
    static: bool = False


@dataclass(frozen=True, slots=True)
class Publisher:
    """One stream of messages on a topic: a connection in ROS 1, a channel in MCAP.

    Attributes:
        topic: Name of the topic.
        node: Name of the publishing node, such as "/robot_state_publisher"; "" if not recorded. ROS
            2 never records node names.
        durability: "transient_local" (ROS 1: latched) or "volatile"; "" if not recorded. With
            "transient_local", late subscribers get the last messages.
        reliability: "reliable" or "best_effort"; "" if not recorded.
        offers: Number of publishers whose QoS was recorded for the topic.
    """

    topic: str
    node: str = ""
    durability: str = ""
    reliability: str = ""
    offers: int = 0

    @property
    def authority(self) -> str:
        """Return the name of the publisher in a buffer: the node if recorded, else the topic."""
        return self.node or self.topic


@dataclass(frozen=True, slots=True, eq=False)
class Edge:
    """All static or all moving transforms of one pair of parent and child, in recorded order.

    Attributes:
        parent: Parent frame, as recorded but without a leading slash.
        child: Child frame, without a leading slash.
        static: Whether the transforms came on a static topic.
        slashed: Number of transforms with a leading slash in a name.
        records: One row per transform, int64, shape (n, 8): the stamp, and the bits of the seven
            doubles x y z (metres) and x y z w (quaternion).
        messages: Message of each transform: an index into `Transforms.log_times`.
        kept: Number of leading rows that a buffer can accept without a check, because they have
            increasing stamps, finite numbers, and unit quaternions with the sign that tf2 computes.
    """

    parent: str
    child: str
    static: bool
    slashed: int
    records: npt.NDArray[np.int64]
    messages: Indexes
    kept: int = 0

    def __len__(self) -> int:
        return len(self.messages)

    def __repr__(self) -> str:
        kind = "static" if self.static else "dynamic"
        return f"<Edge: {len(self)} {kind} transforms of {self.child!r} in {self.parent!r}>"

    def chosen(self, mask: npt.NDArray[np.bool_]) -> "Edge":
        """Return the edge with some of its transforms.

        Args:
            mask: Whether to keep each transform, shape (n,).
        """
        slashed = min(self.slashed, int(np.count_nonzero(mask)))
        records, messages = self.records[mask], self.messages[mask]
        return Edge(self.parent, self.child, self.static, slashed, records, messages)

    @property
    def stamps(self) -> Stamps:
        """Stamps of all transforms, nanoseconds, shape (n,); a view."""
        return self.records[:, 0]

    @property
    def translations(self) -> Floats:
        """Translations of all transforms, metres, shape (n, 3); a view."""
        return self.records.view(np.float64)[:, 1:4]

    @property
    def rotations(self) -> Floats:
        """Quaternions x y z w of all transforms as recorded, shape (n, 4); a view."""
        return self.records.view(np.float64)[:, 4:]


@dataclass(frozen=True, slots=True, eq=False)
class Transforms:
    """All transforms of a recording as columns of each edge, and columns of their messages.

    Attributes:
        edges: All edges, in the order of their first transform.
        log_times: Time of reception of each message, nanoseconds, shape (m,), in the order of
            the recording, which may differ from the order of time.
        senders: Publisher of each message: an index into `publishers`, shape (m,).
        publishers: Publishers of transforms.
        damage: Sentences about parts that could not be read.
    """

    edges: tuple[Edge, ...]
    log_times: Stamps
    senders: Indexes
    publishers: tuple[Publisher, ...]
    damage: tuple[str, ...] = ()

    @classmethod
    def of_lists(
        cls,
        edges: Iterable[tuple[tuple[str, str, bool], Sequence[Row], Sequence[int], Sequence[int]]],
        log_times: Sequence[int],
        senders: Sequence[int],
        publishers: Iterable[tuple[str, str]],
    ) -> "Transforms":
        """Create columns from lists.

        Args:
            edges: For each edge (parent, child, static), its rows, stamps and messages.
            log_times: Time of reception of each message, nanoseconds.
            senders: Publisher of each message.
            publishers: Topic and node of each publisher.
        """
        made = []
        for key, rows, stamps, messages in edges:
            records = np.array(rows, dtype=np.float64).view(np.int64)
            records[:, 0] = stamps
            made.append(Edge(*key, 0, records, np.array(messages, dtype=np.int32)))
        return cls(
            tuple(made),
            np.array(log_times, dtype=np.int64),
            np.array(senders, dtype=np.int32),
            tuple(Publisher(*one) for one in publishers),
        )

    def __len__(self) -> int:
        return sum(len(edge) for edge in self.edges)

    def log_times_of(self, edge: Edge) -> Stamps:
        """Return the log time of each transform of an edge, nanoseconds, shape (n,)."""
        return self.log_times[edge.messages]

    def senders_of(self, edge: Edge) -> Indexes:
        """Return the publishers of an edge's transforms: indices into `publishers`, shape (n,)."""
        return self.senders[edge.messages]


def median(column: Stamps) -> float:
    """Return the median of whole numbers, faster than `numpy.median` for short columns."""
    half = len(column) // 2
    if len(column) % 2:
        return float(np.partition(column, half)[half])
    middle = np.partition(column, (half - 1, half))
    return (float(middle[half - 1]) + float(middle[half])) / 2.0


def usual_rate(stamps: Stamps) -> float | None:
    """Return the mean rate of samples in hertz, without gaps: periods of more than three medians.

    Args:
        stamps: Stamps of the samples in any order, nanoseconds, shape (n,).

    Returns:
        The rate; None without two different stamps.
    """
    periods = stamps[1:] - stamps[:-1]
    if len(periods) and periods.min() <= 0:
        ordered = np.sort(stamps)
        periods = ordered[1:] - ordered[:-1]
        periods = periods[periods > 0]
    if not len(periods):
        return None
    regular = periods[periods <= 3.0 * median(periods)]
    return len(regular) * 1e9 / float(regular.sum())


def percentile(values: npt.NDArray[np.int64] | npt.NDArray[np.float64], percent: float) -> float:
    """Return a percentile of one or more numbers, like `numpy.percentile`.

    numpy's function imports `numpy.ma`, which takes a tenth of the time of a short command.
    """
    place = percent / 100.0 * (len(values) - 1)
    low = int(place)
    high = min(low + 1, len(values) - 1)
    parted = np.partition(values, (low, high))
    first, second = parted[low].item(), parted[high].item()
    return float(first + (second - first) * (place - low))


@dataclass(frozen=True, slots=True, eq=False)
class Headers:
    """Headers of one topic's messages as columns, in the recording's order.

    Attributes:
        topic: Name of the topic.
        type: Type of the messages.
        stamps: Stamps in the headers, nanoseconds, shape (n,).
        log_times: Times of reception, nanoseconds, shape (n,).
        names: The different frame names as recorded; leading slashes are kept.
        frames: Frame of each message: an index into `names`, shape (n,).
    """

    topic: str
    type: str
    stamps: Stamps
    log_times: Stamps
    names: tuple[str, ...]
    frames: Indexes

    @classmethod
    def of_rows(cls, topic: str, type: str, rows: Iterable[tuple[int, int, str]]) -> "Headers":
        """Create columns from the stamp, the time of reception and the frame of each message."""
        stamps, log_times, frames = zip(*rows, strict=True)
        names = tuple(dict.fromkeys(frames))
        return cls(
            topic,
            type,
            np.array(stamps, dtype=np.int64),
            np.array(log_times, dtype=np.int64),
            names,
            np.array([names.index(frame) for frame in frames], dtype=np.int32),
        )

    def __len__(self) -> int:
        return len(self.stamps)

    @property
    def frame_ids(self) -> npt.NDArray[np.object_]:
        """Return the frame name of each message, shape (n,)."""
        return np.array(self.names, dtype=object)[self.frames]


@dataclass(frozen=True, slots=True)
class RawMessage:
    """One message as recorded, not decoded.

    Attributes:
        log_time: Time of reception, nanoseconds.
        sender: Publisher of the message.
        payload: Bytes of the message, in the topic's encoding.
    """

    log_time: Stamp
    sender: Publisher
    payload: bytes


class Progress(Protocol):
    """Function that is called with the progress of reading."""

    def __call__(self, done: int, total: int) -> None:
        """Report that `done` of `total` bytes are read."""
