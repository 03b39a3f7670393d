"""Values and columns of recorded frames.

A recording is finite and complete. Moments are whole nanoseconds; *stamps* are those in headers,
*log times* are the times of reception by the recorder. Columns hold values exactly as recorded,
including not-a-number, zero quaternions, stamps of 0 and leading slashes.
"""

from dataclasses import dataclass
from typing import Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import Stamp

Stamps: TypeAlias = npt.NDArray[np.int64]
"""Nanoseconds, shape (n,)."""

Floats: TypeAlias = npt.NDArray[np.float64]
"""Numbers."""

Indexes: TypeAlias = npt.NDArray[np.int32]
"""Places in another column or list, shape (n,)."""


@dataclass(frozen=True, slots=True)
class RecordedTopic:
    """One topic of a recording.

    Attributes:
        name: Name as recorded; some ROS 2 recordings have `tf` without a slash.
        type: Name of the message type as ROS 2 writes it short: "tf2_msgs/TFMessage". As
            recorded where it is not a ROS type: "foxglove.FrameTransform".
        encoding: "cdr", "ros1", "json", "protobuf", or whatever else is recorded.
        count: Number of messages, up to the damage if there is any.
        definition: The text of the message definition; empty where the recording has none.
        transforms: Whether the type carries transforms.
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
    """One stream of messages on a topic: a connection of ROS 1, a channel of MCAP.

    Attributes:
        topic: Name of the topic.
        node: Name of its node, "/robot_state_publisher"; empty where it is not recorded
            (ROS 2 records it nowhere).
        durability: Offer to late subscribers: "transient_local" (ROS 1's
            latching too), "volatile", or empty where that is not recorded.
        reliability: "reliable", "best_effort", or empty.
        offers: Number of publishers' QoS offers that the recorder noted for the topic.
    """

    topic: str
    node: str = ""
    durability: str = ""
    reliability: str = ""
    offers: int = 0

    @property
    def authority(self) -> str:
        """Return the publisher's name in buffers and views: the node, else the topic."""
        return self.node or self.topic


@dataclass(frozen=True, slots=True, eq=False)
class Edge:
    """All transforms of one parent, child and kind, in the recording's order.

    Attributes:
        parent: Name as recorded, without the one leading slash it may have.
        child: Child frame.
        static: Whether the samples came on a static topic.
        slashed: Number of transforms with a leading slash in a name.
        records: One row a transform, int64, shape (n, 8): the stamp, and bit by bit the
            seven doubles x y z (metres) and x y z w (quaternion).
        messages: The message each came in: a place in `Transforms.log_times`.
        kept: Number of rows from the first on are known to be as a buffer keeps them: each newer
            than the one before, finite, and with a unit quaternion of tf2's sign.
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

    @property
    def stamps(self) -> Stamps:
        """Stamps in nanoseconds, shape (n,); a view."""
        return self.records[:, 0]

    @property
    def translations(self) -> Floats:
        """Translations in metres, shape (n, 3); a view."""
        return self.records.view(np.float64)[:, 1:4]

    @property
    def rotations(self) -> Floats:
        """Quaternions x y z w as recorded, shape (n, 4); a view."""
        return self.records.view(np.float64)[:, 4:]


@dataclass(frozen=True, slots=True, eq=False)
class Transforms:
    """All transforms of a source in columns per edge, and the messages they came in.

    Attributes:
        edges: One for each parent, child and kind, in the order they first came up.
        log_times: When each message was received, nanoseconds, shape (m,), in the order
            of the recording (which need not be that of time).
        senders: The publisher of each message: a place in `publishers`, shape (m,).
        publishers: Publishers of transforms.
        damage: Unreadable parts of them, as sentences.
    """

    edges: tuple[Edge, ...]
    log_times: Stamps
    senders: Indexes
    publishers: tuple[Publisher, ...]
    damage: tuple[str, ...] = ()

    def __len__(self) -> int:
        return sum(len(edge) for edge in self.edges)

    def log_times_of(self, edge: Edge) -> Stamps:
        """Return the log time of each transform of an edge, nanoseconds, shape (n,)."""
        return self.log_times[edge.messages]

    def senders_of(self, edge: Edge) -> Indexes:
        """Return the publishers of an edge's transforms: indices into `publishers`, shape (n,)."""
        return self.senders[edge.messages]


def median(column: Stamps) -> float:
    """Return numpy's median of at least one whole number, three times as fast for few."""
    half = len(column) // 2
    if len(column) % 2:
        return float(np.partition(column, half)[half])
    middle = np.partition(column, (half - 1, half))
    return (float(middle[half - 1]) + float(middle[half])) / 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Headers:
    """Headers of a topic's messages, in the recording's order.

    Attributes:
        topic: Name of the topic.
        type: Type.
        stamps: Nanoseconds, shape (n,).
        log_times: Times of reception, nanoseconds, shape (n,).
        names: The frame names that occur, as recorded (slashes included).
        frames: Frame of each message: a place in `names`, shape (n,).
    """

    topic: str
    type: str
    stamps: Stamps
    log_times: Stamps
    names: tuple[str, ...]
    frames: Indexes

    def __len__(self) -> int:
        return len(self.stamps)

    @property
    def frame_ids(self) -> npt.NDArray[np.object_]:
        """Return the frame name of each message, shape (n,)."""
        return np.array(self.names, dtype=object)[self.frames]


@dataclass(frozen=True, slots=True)
class RawMessage:
    """One message as recorded.

    Attributes:
        log_time: Time of reception, nanoseconds.
        sender: Publisher.
        payload: Bytes, in the topic's encoding.
    """

    log_time: Stamp
    sender: Publisher
    payload: bytes


class Progress(Protocol):
    """Callback for the progress of reading."""

    def __call__(self, done: int, total: int) -> None:
        """Report that `done` of `total` bytes are read."""
