"""Reader of transforms, headers, clock readings and messages of an open recording, as columns."""

import re
import struct
from array import array
from collections.abc import Collection, Iterator, Mapping
from typing import Final

import numpy as np

from tftool.base.errors import InputError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.messages import definitions
from tftool.messages.layouts import CDR, ROS1, Layout
from tftool.messages.transform_rows import LONGEST_NAME
from tftool.recordings.channel import TRANSIENT_LOCAL, Channel
from tftool.recordings.columns import Batch, Table
from tftool.recordings.container import Container
from tftool.recordings.containers import ZSTD_MAGIC
from tftool.recordings.contract import (
    Headers,
    Progress,
    Publisher,
    RawMessage,
    RecordedTopic,
    Stamps,
    Transforms,
)
from tftool.recordings.decompression import LARGEST, keep_freed_memory, unpack_beginning
from tftool.recordings.find import Found, Kind, container_in
from tftool.recordings.foreign_transforms import FOREIGN, decoder_of
from tftool.recordings.message_cutter import AnyCutter, Cutter, Decoding, cutter

TRANSFORM_TYPES: Final = ("tf2_msgs/TFMessage", "tf/tfMessage")
"""Types of messages that are lists of transforms, in short form."""

MOST_UNPACKED: Final = 1 << 26
"""Maximum size, bytes, of decompressed messages held at once, where rosbag2 compressed each message
by itself; the last message may exceed the limit.
"""

CLOCK_TYPE: Final = "rosgraph_msgs/Clock"

LAYOUTS: Final[Mapping[str, Layout]] = {"cdr": CDR, "ros1": ROS1}
"""Byte layout of messages, by the encoding of their topic."""

_HEAD_BYTES = 16 + LONGEST_NAME
_COMMENT = re.compile(r"#.*")
_HEADER_FIELD = re.compile(r"(std_msgs/(msg/)?|roslib/)?Header\s+\w+\s*$")

# Types of sensor_msgs that begin with a header, for recordings without definitions, such as
# rosbag2's sqlite files before 2023.
_SENSORS = """BatteryState CameraInfo CompressedImage FluidPressure Illuminance Image Imu JointState
Joy LaserScan MagneticField MultiDOFJointState MultiEchoLaserScan NavSatFix PointCloud PointCloud2
Range RelativeHumidity Temperature TimeReference"""
_WITH_HEADER = frozenset(f"sensor_msgs/{name}" for name in _SENSORS.split()) | {
    "diagnostic_msgs/DiagnosticArray",
    "nav_msgs/GridCells",
    "nav_msgs/OccupancyGrid",
    "nav_msgs/Odometry",
    "nav_msgs/Path",
    "stereo_msgs/DisparityImage",
    "visualization_msgs/Marker",
}


def short_type(name: str) -> str:
    """Shorten the name of a message type: "std_msgs/msg/String" becomes "std_msgs/String"."""
    package, middle, last = name.partition("/msg/")
    return f"{package}/{last}" if middle else name


class Recorded:
    """An open recording, whose messages are read on demand.

    Reading raises `InputError` only if nothing can be read. The property `damage` describes any
    other damage.

    Attributes:
        name: Name as given by the user.
    """

    def __init__(self, name: str, container: Container) -> None:
        """Examine the streams of a container.

        Args:
            name: Name of the recording, as the user gave it.
            container: Files of the recording.
        """
        self.name = name
        self._container = container
        self._notes: list[str] = []
        self._senders = tuple(
            Publisher(one.topic, one.node, offers.durability, offers.reliability, offers.count)
            for one in container.streams
            for offers in [one.offers]
        )

    @property
    def kind(self) -> str:
        """Name of the file format in messages to the user."""
        return self._container.kind

    @property
    def size(self) -> int:
        """Size of all files of the recording, bytes."""
        return self._container.size

    @property
    def start(self) -> Stamp:
        """Log time of the first message, nanoseconds; 0 without messages."""
        return self._container.start

    @property
    def end(self) -> Stamp:
        """Log time of the last message, nanoseconds; 0 without messages."""
        return self._container.end

    @property
    def damage(self) -> tuple[str, ...]:
        """Return sentences about damage of the files."""
        return (*self._container.damage, *self._notes)

    @property
    def oddities(self) -> list[str]:
        """Return sentences about unusual rows that are used; only pose files have such rows."""
        return list(getattr(self._container, "oddities", ()))

    def _note(self, damage: str) -> None:
        if damage not in self._notes:
            self._notes.append(damage)

    @property
    def names(self) -> frozenset[str]:
        """Return the names of all topics, faster than `topics`, which also counts messages."""
        return frozenset(stream.topic for stream in self._container.streams)

    @property
    def topics(self) -> tuple[RecordedTopic, ...]:
        """Return all topics, sorted by name."""
        first: dict[str, Channel] = {}
        counts: dict[str, int] = {}
        static: dict[str, bool] = {}
        for stream, count in zip(self._container.streams, self._container.counts, strict=True):
            first.setdefault(stream.topic, stream)
            counts[stream.topic] = counts.get(stream.topic, 0) + count
            static[stream.topic] = static.get(stream.topic, False) or is_static(stream)
        return tuple(
            RecordedTopic(
                name,
                short_type(stream.type),
                stream.encoding,
                counts[name],
                stream.text,
                has_transforms(stream),
                has_transforms(stream) and static[name],
            )
            for name, stream in sorted(first.items())
        )

    @property
    def single_topics(self) -> frozenset[str]:
        """Names of the topics whose messages are single transforms (TransformStamped)."""
        kind = "geometry_msgs/TransformStamped"
        return frozenset(s.topic for s in self._container.streams if short_type(s.type) == kind)

    @property
    def publishers(self) -> tuple[Publisher, ...]:
        """Return all publishers (streams of messages), sorted by topic and node."""
        return tuple(sorted(set(self._senders), key=lambda one: (one.topic, one.node)))

    def transforms(
        self, topics: Collection[str] | None = None, progress: Progress | None = None
    ) -> Transforms:
        """Return the transforms on some topics; None selects all topics with transforms.

        Odometry and PoseStamped messages are read as transforms if their topics are in `topics`.
        """
        streams = self._container.streams
        chosen = [
            number
            for number, stream in enumerate(streams)
            if (has_transforms(stream) if topics is None else stream.topic in topics)
        ]
        table = Table(self._container.expected(chosen))
        cutters: dict[tuple[Layout, bool], Cutter] = {}
        of_stream: dict[int, AnyCutter] = {}
        for number in chosen:
            stream = streams[number]
            static = is_static(stream)
            if _is_tf(stream):
                key = LAYOUTS[stream.encoding], static
                if key not in cutters:
                    cutters[key] = cutter(table, *key)
                of_stream[number] = cutters[key]
            else:
                kind = short_type(stream.type)
                try:
                    decode = decoder_of(kind, stream.encoding, stream.text, stream.topic)
                except InputError as error:
                    self._note(f"'{stream.topic}' is left out: {error}")
                    continue
                if decode is not None:
                    of_stream[number] = Decoding(table, decode, static)
        takers = set(of_stream.values())
        for batch in self._batches(of_stream.keys(), progress):
            first = table.note(batch.log_times, batch.senders)
            numbers = np.arange(first, first + len(batch), dtype=np.int32)
            if len(takers) == 1:
                next(iter(takers)).add(batch, numbers)
                continue
            for taker, which in _by_cutter(batch, of_stream):
                taker.add(batch.chosen(which), numbers[which])
        for one in cutters.values():
            one.flush()
        return table.finished(self._senders)

    def headers(
        self, topics: Collection[str] | None = None, progress: Progress | None = None
    ) -> dict[str, Headers]:
        """Return the headers of messages by topic; None selects all topics that have headers.

        Messages of an unknown type without a definition have headers if their bytes look like ones.
        """
        found: dict[str, _Heads] = {}
        of_stream: dict[int, _Heads] = {}
        for number, stream in enumerate(self._container.streams):
            if topics is not None and stream.topic not in topics:
                continue
            if begins_with_header(stream):
                of_stream[number] = found.setdefault(stream.topic, _Heads(stream))
            elif _is_unknown(stream):
                of_stream[number] = found.setdefault(stream.topic, _UncertainHeads(stream))
        for batch in self._batches(of_stream.keys(), progress, _HEAD_BYTES):
            for number in range(len(batch)):
                start = int(batch.starts[number])
                end = start + min(int(batch.lengths[number]), _HEAD_BYTES)
                head = batch.buffer[start:end].tobytes()
                log_time = int(batch.log_times[number])
                of_stream[int(batch.senders[number])].append(head, log_time)
        return {
            topic: heads.finished() for topic, heads in sorted(found.items()) if heads.are_plausible
        }

    def clock(self) -> tuple[Stamps, Stamps]:
        """Return the times in `/clock` messages, and their log times, nanoseconds, shape (n,)."""
        read, received = array("q"), array("q")
        numbers = {
            number: stream
            for number, stream in enumerate(self._container.streams)
            if short_type(stream.type) == CLOCK_TYPE and stream.encoding in LAYOUTS
        }
        for batch in self._batches(numbers.keys(), None, 12):
            for number in range(len(batch)):
                stream = numbers[int(batch.senders[number])]
                payload = batch.payload(number)
                begin = 4 if stream.encoding == "cdr" else 0
                if len(payload) >= begin + 8:
                    read.append(_stamp(payload, begin))
                    received.append(int(batch.log_times[number]))
        return np.frombuffer(read, dtype=np.int64), np.frombuffer(received, dtype=np.int64)

    def messages(self, topics: Collection[str]) -> Iterator[RawMessage]:
        """Yield the messages of some topics, in the recording's order."""
        numbers = {n for n, one in enumerate(self._container.streams) if one.topic in topics}
        for batch in self._batches(numbers):
            for number in range(len(batch)):
                yield RawMessage(
                    int(batch.log_times[number]),
                    self._senders[int(batch.senders[number])],
                    batch.payload(number),
                )

    def _batches(
        self, wanted: Collection[int], progress: Progress | None = None, head: int | None = None
    ) -> Iterator[Batch]:
        """Yield batches of some streams, decompressed if rosbag2 compressed message by message."""
        keep_freed_memory()
        for batch in self._container.batches(wanted, progress, head):
            start = int(batch.starts[0])
            if batch.buffer[start : start + 4].tobytes() == ZSTD_MAGIC:
                yield from _unpacked(batch)
            else:
                yield batch

    def close(self) -> None:
        """Close the recording's files."""
        self._container.close()


class _Heads:
    """Headers of one topic's messages, collected while reading."""

    def __init__(self, stream: Channel) -> None:
        self._topic = stream.topic
        self._type = short_type(stream.type)
        self._is_cdr = stream.encoding == "cdr"
        self._stamps = array("q")
        self._log_times = array("q")
        self._frames = array("i")
        self._names: dict[str, int] = {}
        self._known: dict[bytes, int] = {}

    def append(self, head: bytes, log_time: int) -> None:
        """Append the header in the first bytes of a message; ignore a message that is too short."""
        begin = 4  # after CDR's header, or after ROS 1's sequence number
        order = ">" if self._is_cdr and head[:2] == b"\x00\x00" else "<"
        if len(head) < begin + 12:
            return
        (length,) = struct.unpack_from(f"{order}I", head, begin + 8)
        name = head[begin + 12 : begin + 12 + length]
        if len(name) < length:
            return
        place = self._known.get(name)
        if place is None:
            text = (name.removesuffix(b"\x00") if self._is_cdr else name).decode(
                "utf-8", "backslashreplace"
            )
            place = self._names.setdefault(text, len(self._names))
            if len(self._known) < 4096:
                self._known[name] = place
        self._stamps.append(_stamp(head, begin, order))
        self._log_times.append(log_time)
        self._frames.append(place)

    @property
    def are_plausible(self) -> bool:
        """Whether the messages have headers."""
        return True

    def finished(self) -> Headers:
        """Return the collected headers as columns."""
        return Headers(
            self._topic,
            self._type,
            np.frombuffer(self._stamps, dtype=np.int64),
            np.frombuffer(self._log_times, dtype=np.int64),
            tuple(self._names),
            np.frombuffer(self._frames, dtype=np.int32),
        )


class _UncertainHeads(_Heads):
    """Beginnings of one topic's messages that may be headers; the definition is not recorded."""

    def __init__(self, stream: Channel) -> None:
        super().__init__(stream)
        self._messages = 0

    def append(self, head: bytes, log_time: int) -> None:
        """Append the first bytes of a message if they look like a header."""
        self._messages += 1
        order = ">" if head[:2] == b"\x00\x00" else "<"
        if len(head) < 16:
            return
        sec, nanosec, length = struct.unpack_from(f"{order}iII", head, 4)
        name = head[16 : 16 + length]
        is_name = 1 < length == len(name) and name[-1] == 0 and name[:-1].isascii()
        if sec >= 0 and nanosec < NANOSECONDS and is_name and name[:-1].decode().isprintable():
            super().append(head, log_time)

    @property
    def are_plausible(self) -> bool:
        """Whether the messages look like headers whose stamps run like a clock."""
        stamps = np.frombuffer(self._stamps, dtype=np.int64)
        if len(stamps) < max(3, 0.95 * self._messages) or np.mean(np.diff(stamps) >= 0) < 0.95:
            return False
        lasts, real = int(stamps[-1] - stamps[0]), self._log_times[-1] - self._log_times[0]
        return 0.1 * real <= lasts <= 10 * real and lasts > 0


def _unpacked(batch: Batch) -> Iterator[Batch]:
    """Yield batches of the decompressed messages; a damaged message may be shortened or empty."""
    pieces: list[bytes] = []
    first = held = 0
    for number in range(len(batch)):
        pieces.append(unpack_beginning("zstd", batch.payload(number), LARGEST))
        held += len(pieces[-1])
        if held < MOST_UNPACKED and number + 1 < len(batch):
            continue
        lengths = np.fromiter(map(len, pieces), dtype=np.int64, count=len(pieces))
        starts = np.cumsum(lengths) - lengths
        buffer = np.frombuffer(b"".join(pieces) or b"\0", dtype=np.uint8)
        which = slice(first, number + 1)
        yield Batch(buffer, starts, lengths, batch.log_times[which], batch.senders[which])
        pieces, first, held = [], number + 1, 0


def _by_cutter(
    batch: Batch, of_stream: dict[int, AnyCutter]
) -> "Iterator[tuple[AnyCutter, slice | Stamps]]":
    """Yield each decoder of transforms, with the indices of its messages in a batch."""
    first = int(batch.senders[0])
    if (batch.senders == first).all():
        yield of_stream[first], slice(None)
        return
    owners: dict[AnyCutter, list[int]] = {}
    # `np.unique` would import numpy.ma, a tenth of the start-up of a command.
    for number in np.flatnonzero(np.bincount(batch.senders)).tolist():
        owners.setdefault(of_stream[number], []).append(number)
    for taker, numbers in owners.items():
        yield taker, np.flatnonzero(np.isin(batch.senders, numbers))


def _stamp(payload: bytes, place: int, order: str = "<") -> Stamp:
    sec, nanosec = struct.unpack_from(f"{order}iI", payload, place)
    return int(sec) * NANOSECONDS + int(nanosec)


def _is_tf(stream: Channel) -> bool:
    return short_type(stream.type) in TRANSFORM_TYPES and stream.encoding in LAYOUTS


def has_transforms(stream: Channel) -> bool:
    """Whether the messages of a stream are transforms, of ROS or of other types."""
    return _is_tf(stream) or (short_type(stream.type), stream.encoding) in FOREIGN


def is_static(stream: Channel) -> bool:
    """Whether the transforms of a stream are static, according to topic name and latching."""
    last = stream.topic.rpartition("/")[2]
    if last == "tf_static":
        return True
    is_latched = stream.offers.durability == TRANSIENT_LOCAL
    return is_latched and (stream.encoding == "ros1" or "static" in stream.topic)


def begins_with_header(stream: Channel) -> bool:
    """Whether the messages of a stream begin with a std_msgs/Header that can be read."""
    if stream.encoding not in LAYOUTS:
        return False
    kind = short_type(stream.type)
    if not stream.message_text:
        return kind in _WITH_HEADER or (
            kind.startswith("geometry_msgs/") and kind.endswith("Stamped")
        )
    for line in stream.message_text.splitlines():
        field = _COMMENT.sub("", line).strip()
        if field and "=" not in field:
            return _HEADER_FIELD.fullmatch(field) is not None
    return False


def _is_unknown(stream: Channel) -> bool:
    """Whether a stream has messages of ROS 2 without a definition, of a type unknown to tftool."""
    package, _, _ = stream.type.partition("/")
    return (
        stream.encoding == "cdr" and not stream.message_text and package not in definitions.table()
    )


def open_found(found: Found) -> Container:
    """Open the files of a recording that `find` returned.

    Raises:
        InputError: If the file cannot be read, or is not a recording.
        OSError: If a file cannot be opened.
    """
    if not found.kind.is_recording:
        raise InputError(f"'{found.name}' is a {found.kind.value}, not a recording.")
    # Imported here because few recordings need these modules.
    if found.kind in (Kind.ROSBAG2, Kind.SEVERAL, Kind.ZSTD):
        from tftool.recordings.rosbag2.folder import open_parts

        return open_parts(found)
    if found.kind is Kind.POSES:
        from tftool.recordings.poses.pose_container import open_poses

        return open_poses(found)
    path = found.paths[0]
    return container_in(path, found.kind).open(path)
