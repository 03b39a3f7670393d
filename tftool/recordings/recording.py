"""A recording for lookups: one buffer with all frames over the whole recorded time."""

import os
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError, TftoolError, UsageError
from tftool.base.plain_text import near_names
from tftool.base.stamps import SIMULATED_BELOW, Stamp
from tftool.buffer.buffer import NO_LIMIT, Buffer, adopt_records
from tftool.buffer.forest import stripped
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import Interfaces, completed
from tftool.messages.codec import Codec, RecordedCodec
from tftool.messages.layouts import CDR, ROS1
from tftool.messages.schema import full_name
from tftool.recordings.column_cache import ColumnCache, KeptColumns
from tftool.recordings.container_reader import Recorded, open_found
from tftool.recordings.contract import (
    Edge,
    Floats,
    Headers,
    Indexes,
    Progress,
    Publisher,
    RawMessage,
    RecordedTopic,
    Stamps,
    Transforms,
)
from tftool.recordings.description_frames import (
    DESCRIPTION,
    DescribedFrames,
    RecordedJoints,
    add_described,
    description_topics,
    joint_state_topics,
    missing_motion,
    prefix_of,
    read_description,
    read_joint_states,
)
from tftool.recordings.find import Found, Kind, find
from tftool.recordings.tf_topics import implying, joined, transforms_on, without_single
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import UnexpandedXacro

MOST_FRAMES: Final = 1 << 18


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """All recorded transforms of one child, in order of stamps.

    Attributes:
        stamps: Stamp of each transform, nanoseconds, shape (n,).
        parents: Parent of each transform, shape (n,).
        translations: Metres, shape (n, 3).
        rotations: Quaternions x y z w as recorded, shape (n, 4).
        authorities: Publisher of each transform: the node if recorded, else the topic, shape (n,).
        log_times: Times of reception, nanoseconds, shape (n,).
        static: Whether each transform is static, shape (n,).
    """

    stamps: Stamps
    parents: npt.NDArray[np.object_]
    translations: Floats
    rotations: Floats
    authorities: npt.NDArray[np.object_]
    log_times: Stamps
    static: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.stamps)


class Recording:
    """An open recording, returned by `open_recording`; a context manager.

    Opening a recording reads the list of topics. Transforms are read when they are first needed.
    """

    def __init__(
        self,
        source: Recorded,
        progress: Progress | None = None,
        robot: Robot | None = None,
        kept: KeptColumns | None = None,
        with_odometry: bool = False,
        tf_topics: Sequence[str] = (),
    ) -> None:
        """Create a recording from opened files.

        Args:
            source: The opened files.
            progress: Function called with the progress of reading.
            robot: Description of the robot; None to use the recorded description.
            kept: Cache with the transforms of this recording; None for no cache.
            with_odometry: Whether messages with odometry and poses are used as transforms.
            tf_topics: Topics of transforms to read; empty for all.
        """
        self.source = source
        self._tf_topics = tf_topics
        self._with_odometry = with_odometry
        self._kept = kept
        self._robot = robot
        self._progress = progress
        self._oddities: Counter[str] = Counter()
        self._described: DescribedFrames | None = None
        self._closed = False

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Recording {self.source.name!r}, {self.source.kind}>"

    def __reduce__(self) -> str:
        raise UsageError(
            f"Recording '{self.name}' has open files, so it cannot be copied or sent to another "
            "process: call open_recording in that process."
        )

    def close(self) -> None:
        """Close the recording's files; data already read stays available."""
        self._closed = True
        self.source.close()

    @property
    def _readable(self) -> Recorded:
        self._require_open()
        return self.source

    def _require_open(self) -> None:
        # A closed database would look like an empty one.
        if self._closed:
            raise UsageError(
                f"Recording '{self.name}' is closed: read the recording inside the 'with' block "
                "that opened the recording."
            )

    # Content

    @property
    def name(self) -> str:
        """Name of the recording, as given by the user."""
        return self.source.name

    @property
    def topics(self) -> tuple[RecordedTopic, ...]:
        """Return all topics, sorted by name, with types and numbers of messages."""
        return self.source.topics

    @property
    def publishers(self) -> tuple[Publisher, ...]:
        """Return the publishers of all topics; only ROS 1 bags have the names of nodes."""
        return self.source.publishers

    @property
    def damage(self) -> tuple[str, ...]:
        """Return sentences about parts that could not be read; further reading may find more."""
        read = self.transforms.damage if "transforms" in self.__dict__ else ()
        return (*self.source.damage, *read)

    @cached_property
    def transforms(self) -> Transforms:
        """All transforms, as columns per edge (pair of parent and child)."""
        found = None if self._kept is None or self._tf_topics else self._kept.load()
        if self._tf_topics:
            found, names = transforms_on(self._readable, self._tf_topics, self._progress)
            if names.colliding:
                self._oddities[str(names)] += 1
        elif found is None:
            found = self._readable.transforms(progress=self._progress)
            # A damaged file is not cached, so that its damage is reported each time.
            if self._kept is not None and not self.source.damage and not found.damage:
                self._kept.store(found)
        odometry = [topic.name for topic in self.odometry]
        if not odometry:
            return found
        return joined(found, self._readable.transforms(odometry, self._progress))

    @cached_property
    def odometry(self) -> tuple[RecordedTopic, ...]:
        """Topics of odometry and poses used as transforms; empty unless `with_odometry`."""
        return implying(self.topics) if self._with_odometry else ()

    @property
    def edges(self) -> tuple[Edge, ...]:
        """All edges (pairs of parent and child), with their transforms as columns."""
        return self.transforms.edges

    @cached_property
    def span(self) -> tuple[Stamp, Stamp]:
        """First and last stamp of moving transforms, nanoseconds; log times if no transform moves.

        If stamps are on two clocks (wall and simulation), the clock with more transforms is used.
        """
        spans: dict[bool, tuple[int, int, int]] = {}
        for edge in self.edges:
            if edge.static:
                continue
            for chosen in _by_clock(edge.stamps):
                first, last = int(chosen.min()), int(chosen.max())
                simulated = first < SIMULATED_BELOW
                count, low, high = spans.get(simulated, (0, first, last))
                spans[simulated] = (count + len(chosen), min(low, first), max(high, last))
        if not spans and self.robot is not None:
            moved = [states.stamps for states in self.joint_states.states if len(states)]
            if moved:
                return min(int(one.min()) for one in moved), max(int(one.max()) for one in moved)
        if not spans:
            return self.source.start, self.source.end
        _, low, high = max(spans.values())
        return low, high

    @property
    def start(self) -> Stamp:
        """First stamp of moving transforms, nanoseconds; see `span`."""
        return self.span[0]

    @property
    def end(self) -> Stamp:
        """Last stamp of moving transforms, nanoseconds; see `span`."""
        return self.span[1]

    # Lookups

    @cached_property
    def buffer(self) -> Buffer:
        """Buffer with all transforms, in which lookups work at any recorded time.

        The last value of a static transform is valid at all times. Transforms that tf2 would
        refuse, and moving transforms with stamp 0, are left out; see `oddities`. Single transforms
        (TransformStamped) are left out for frames that tf topics have, too. A robot description and
        recorded joint states give the poses of further frames; see `described`.
        """
        oddities = self._oddities
        buffer = Buffer(NO_LIMIT, log=_silent, max_frames=MOST_FRAMES)
        transforms = self.transforms
        if not self._tf_topics:
            transforms = without_single(transforms, self.source.single_topics)
        moving: dict[str, list[Edge]] = {}
        static: dict[str, list[Edge]] = {}
        for edge in transforms.edges:
            (static if edge.static else moving).setdefault(edge.child, []).append(edge)
        for child in {**moving, **static}:
            kinds = [kind[child] for kind in (moving, static) if child in kind]
            if len(kinds) > 1:
                oddities[
                    f"'{child}' is sent both as static and as moving: the kind sent last is used"
                ] += 1
                # In tf2 a frame is static or moving: the kind received last removes the other.
                kinds.sort(key=lambda edges: max(map(_last, edges)))
            for edges in kinds:
                if edges[0].static:
                    _set_static(buffer, transforms, edges, oddities)
                    continue
                for edge in edges:
                    _set_moving(buffer, transforms, edge, oddities)
        if self.robot is not None:
            self._described = self._add_described(buffer, self.robot, {*moving, *static})
        return buffer

    def _add_described(
        self, buffer: Buffer, robot: Robot, children: Collection[str]
    ) -> DescribedFrames:
        known = {*children, *buffer.frames()}
        prefix = prefix_of(robot, known)
        wanted = missing_motion(robot, children, prefix)
        joints = self.joint_states if wanted else RecordedJoints()
        for text, count in joints.ignored.items():
            self._oddities[text] += count
        return add_described(buffer, robot, joints, children, prefix)

    # The recorded robot

    @cached_property
    def robot(self) -> Robot | None:
        """Robot of the given description, else of the recorded description, else None.

        Mistakes in a recorded description are added to `oddities`.

        Raises:
            UnexpandedXacro: If the recorded description has elements of xacro.
        """
        if self._robot is not None:
            return self._robot
        if not any(name.rpartition("/")[2] == DESCRIPTION for name in self.source.names):
            return None
        for topic in description_topics(self.topics):
            try:
                return read_description(self._readable, topic)
            except UnexpandedXacro:
                # Frames would be missing without the description, so this error must be seen.
                raise
            except TftoolError as error:
                first = str(error).strip().partition("\n")[0]
                self._oddities[f"'{topic.name}' cannot be read: {first}"] += 1
        return None

    @cached_property
    def joint_states(self) -> RecordedJoints:
        """Recorded joint states of the robot, as columns."""
        inside = description_topics(self.topics)
        namespace = inside[0].name.rpartition("/")[0] if inside and self._robot is None else ""
        return read_joint_states(self._readable, joint_state_topics(self.topics, namespace))

    @property
    def described(self) -> DescribedFrames | None:
        """Return the frames added from a robot description; None without a description."""
        _ = self.buffer
        return self._described

    @property
    def oddities(self) -> dict[str, int]:
        """Return sentences about transforms that the buffer left out or replaced, with counts."""
        _ = self.buffer
        return dict(self._oddities)

    def headers(self, topic: str) -> Headers:
        """Return stamps, log times and frame names of a topic's messages, as columns.

        Raises:
            InputError: If there is no such topic, or its messages have no header.
        """
        self._topic(topic)
        found = self._readable.headers([topic], self._progress)
        if topic not in found:
            raise InputError(
                f"The messages of '{topic}' do not begin with a header, so they have no stamps: "
                "choose another topic."
            )
        return found[topic]

    def samples(self, frame: str) -> Samples:
        """Return all recorded transforms of one child frame, unchanged.

        Raises:
            InputError: If the frame is not the child of a recorded transform.
        """
        transforms = self.transforms
        edges = [edge for edge in transforms.edges if edge.child == stripped(frame)]
        if not edges:
            raise InputError(f"No transform of '{frame}' was recorded: {self._children()}.")
        authorities = np.array([one.authority for one in transforms.publishers], dtype=object)
        stamps = np.concatenate([edge.stamps for edge in edges])
        order = np.argsort(stamps, kind="stable")
        parents = [np.full(len(edge), edge.parent, dtype=object) for edge in edges]
        senders: Indexes = np.concatenate([transforms.senders_of(edge) for edge in edges])
        return Samples(
            stamps[order],
            np.concatenate(parents)[order],
            np.concatenate([edge.translations for edge in edges])[order],
            np.concatenate([edge.rotations for edge in edges])[order],
            authorities[senders[order]],
            np.concatenate([transforms.log_times_of(edge) for edge in edges])[order],
            np.concatenate([np.full(len(edge), edge.static) for edge in edges])[order],
        )

    def raw_messages(self, topic: str) -> Iterator[RawMessage]:
        """Yield a topic's messages as recorded, one by one.

        Raises:
            InputError: If there is no such topic.
            UsageError: If the recording is closed, even between two messages.
        """
        self._topic(topic)
        return self._while_open(self._readable.messages([topic]))

    def _while_open(self, messages: Iterator[RawMessage]) -> Iterator[RawMessage]:
        self._require_open()
        for message in messages:
            yield message
            self._require_open()

    def messages(self, topic: str) -> Iterator[tuple[Stamp, Any]]:
        """Yield log time and decoded message for each message of a topic.

        Returns:
            For each message the time of reception, nanoseconds, and an object with the fields of
            the recorded definition.

        Raises:
            InputError: If there is no such topic, or its type or encoding is unknown.
            UsageError: If the recording is closed.
        """
        found = self._topic(topic)
        layout = {"cdr": CDR, "ros1": ROS1}.get(found.encoding)
        if layout is None:
            raise InputError(
                f"The messages of '{topic}' have the encoding '{found.encoding}', which tftool "
                "cannot decode: raw_messages() returns their bytes."
            )
        interfaces = Interfaces()
        if found.definition.strip():
            decode = Codec(interfaces.recorded(found.type, found.definition), layout).decode
            return ((raw.log_time, decode(raw.payload)) for raw in self.raw_messages(topic))
        codec = RecordedCodec(interfaces, full_name(found.type), layout)
        return (
            (raw.log_time, completed(codec.decode(raw.payload), codec.kind))
            for raw in self.raw_messages(topic)
        )

    def _topic(self, name: str) -> RecordedTopic:
        for topic in self.topics:
            if topic.name == name:
                return topic
        known = [topic.name for topic in self.topics]
        near = near_names(name, known, 3)
        rest = f" and {len(known) - 8} more" if len(known) > 8 else ""
        there = f"there are {', '.join(sorted(known)[:8])}{rest}." if known else "there are none."
        hint = f"did you mean {' or '.join(near)}?" if near else there
        raise InputError(f"No topic '{name}' was recorded; {hint}")

    def _children(self) -> str:
        children = sorted({edge.child for edge in self.edges})
        shown = ", ".join(children[:8])
        return f"there are {shown}{' …' if len(children) > 8 else ''}" if children else "none is"


def _by_clock(stamps: Stamps) -> list[Stamps]:
    """Split the stamps above 0 into times since 1970 and simulation times; omit empty arrays."""
    if len(stamps) and stamps.min() >= SIMULATED_BELOW:
        return [stamps]
    stamps = stamps[stamps > 0]
    is_sim = stamps < SIMULATED_BELOW
    return [chosen for chosen in (stamps[~is_sim], stamps[is_sim]) if len(chosen)]


def _set_moving(
    buffer: Buffer,
    transforms: Transforms,
    edge: Edge,
    oddities: "Counter[str]",
) -> None:
    authority = transforms.publishers[int(transforms.senders[edge.messages[-1]])].authority
    records, stamps = edge.records, edge.stamps
    # If the first stamp is above 0 and stamps increase, no stamp is 0: skip the search.
    later = len(edge) and stamps[0] > 0
    if later and adopt_records(buffer, edge.parent, edge.child, records, authority, edge.kept):
        return
    if not stamps.all():
        text = f"'{edge.child}' moves, but has stamp 0, which means the latest in tf2: left out"
        oddities[text] += len(edge) - int(np.count_nonzero(stamps))
        records = records[stamps != 0]
    report = buffer.set_records(edge.parent, edge.child, records, authority)
    if report is not None and not report:
        for code, rows in report.reasons.items():
            text = f"{_REFUSED.get(code, code)} ('{edge.child}' in '{edge.parent}')"
            oddities[text] += len(rows)


def _set_static(
    buffer: Buffer, transforms: Transforms, edges: list[Edge], oddities: "Counter[str]"
) -> None:
    """Insert the last static transform of a child; report differing values in `oddities`."""
    edge = max(edges, key=_last)
    authority = transforms.publishers[int(transforms.senders[edge.messages[-1]])].authority
    x, y, z, qx, qy, qz, qw = edge.records[-1].view(np.float64)[1:].tolist()
    pose = Transform((x, y, z), (qx, qy, qz, qw))
    sample = TransformStamped(int(edge.stamps[-1]), edge.parent, edge.child, pose)
    if not buffer.set_transform_static(sample, authority):
        oddities[f"tf2 refuses the static transform of '{edge.child}' in '{edge.parent}'"] += 1
    if sum(map(len, edges)) == 1:
        return
    values = sum(len(np.unique(one.records[:, 1:], axis=0)) for one in edges)
    parents = ", ".join(f"'{one.parent}'" for one in edges if one is not edge and len(one))
    if parents:
        oddities[
            f"'{edge.child}' has a static transform in each of {len(edges)} parents: the last one, "
            f"in '{edge.parent}', is used, not {parents}"
        ] += 1
    elif values > 1:
        text = f"'{edge.child}' has {values} different static values: the last value is used"
        oddities[text] += 1


_REFUSED: Final = {
    "TF_NAN_INPUT": "not a number",
    "TF_DENORMALIZED_QUATERNION": "a zero quaternion",
    "TF_SELF_TRANSFORM": "a frame that is its own parent",
    "TF_NO_CHILD_FRAME_ID": "no child frame",
    "TF_NO_FRAME_ID": "no parent frame",
    "TF_TOO_MANY_FRAMES": "too many frames",
}


def _last(edge: Edge) -> int:
    return int(edge.messages[-1]) if len(edge) else -1


def _silent(level: str, text: str) -> None:
    """Ignore a log line about a rejected sample; `oddities` counts rejected samples."""


def open_recording(
    path: "str | os.PathLike[str]",
    *,
    progress: Progress | None = None,
    robot: Robot | None = None,
    cache: ColumnCache | None = None,
    with_odometry: bool = False,
    tf_topics: str | Sequence[str] = (),
) -> Recording:
    """Open an MCAP file, a rosbag2 recording, a ROS 1 bag, or a folder or glob of such files.

    The content decides the format. Damaged files are read up to the damage, which is listed in
    `Recording.damage`.

    Args:
        path: File, folder or glob.
        progress: Function called with the bytes read and their total while reading.
        robot: Description of the recorded robot, instead of the recorded description; see
            `load_urdf`.
        cache: Cache of the transforms of large recordings; None for no cache.
        with_odometry: Whether Odometry, PoseStamped and PoseWithCovarianceStamped messages are
            used as transforms, for frames without other transforms. The name of a pose's topic
            is the name of its frame.
        tf_topics: Topic of transforms to read, or several topics, such as "/r1/tf", "/r2/tf", each
            with the static topic of its namespace; empty for all. Frame names that several of
            these robots use get the namespace as prefix.

    Raises:
        InputError: If nothing can be read.
        UsageError: If the package for the compression is not installed.
    """
    name = os.fspath(path)
    topics = (tf_topics,) if isinstance(tf_topics, str) else tuple(tf_topics)
    before: list[tuple[int, int]] | None = None
    try:
        found = find(name)
        before = _facts(found)
        # A pose file is not cached, because its columns depend on the options.
        is_kept = cache is not None and found.kind is not Kind.POSES
        kept = KeptColumns(cache, found) if is_kept and cache is not None else None
        source = Recorded(name, open_found(found))
        return Recording(source, progress, robot, kept, with_odometry, topics)
    except OSError as error:
        raise InputError(f"'{name}' cannot be read: {error.strerror or error}") from error
    except (InputError, ValueError, ArithmeticError, LookupError) as error:
        # The file may have changed after its sizes were checked.
        if before is None or before == _facts(found):
            raise
        raise InputError(
            f"'{name}' changed while it was read: try again when the recording is complete."
        ) from error


def _facts(found: Found) -> list[tuple[int, int]]:
    """Return size and modification time of every file of a recording; -1 for a missing file."""
    facts = []
    for path in found.paths:
        for file in sorted(path.iterdir()) if path.is_dir() else [path]:
            try:
                told = file.stat()
            except OSError:
                facts.append((-1, -1))
            else:
                facts.append((told.st_size, told.st_mtime_ns))
    return facts
