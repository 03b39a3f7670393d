"""Streams of stamps with arrival times: the samples of an edge, or the headers of a topic."""

import math
import re
from collections.abc import Sequence
from functools import cached_property
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, seconds
from tftool.geometry.rigid_arrays import Floats, angles_between, unit
from tftool.messages import definitions
from tftool.recordings.contract import Edge, Headers, Publisher, Stamps, Transforms, median

Number = TypeVar("Number", bound=np.generic)

Mask = npt.NDArray[np.bool_]

Places = npt.NDArray[np.intp]
"""Indices of rows of a track, shape (n,)."""

Places32 = npt.NDArray[np.int32]
"""Numbers of messages or of senders, shape (n,)."""

NEVER = np.iinfo(np.int64).max
"""Arrival time of a sample that never arrives."""

FAR = 2**61
"""Largest distance of a stamp from 1970, nanoseconds, for which differences fit into 64 bits."""

WILD = seconds(3600)
"""Deviation of a single stamp, nanoseconds, too large for a late message or a slow clock."""

FEW = 0.01
"""Maximum fraction of a stream's stamps that may deviate by more than `WILD`."""

ZERO_QUATERNION = 1e-12
"""Squared length of a rotation below which tf2 drops the sample."""

ROUNDED = 1e-4
"""Difference of coordinates, metres, within which two poses are one."""


class Stream:
    """Stamped items (samples or headers) in the order of their log times.

    Attributes:
        stamps: Stamps of the first lap (before the clock first jumped back), nanoseconds,
            shape (n,).
        logs: Log times of the first lap, nanoseconds, shape (n,).
        lap: Number n of items in the first lap.
        arrivals: Log times on the clock of the stamps, nanoseconds, shape (n,); set by `Model`.
    """

    def __init__(self, stamps: Stamps, logs: Stamps) -> None:
        logs = bounded(logs)
        self.order = np.argsort(logs, kind="stable") if _falls(logs) else None
        self.all_stamps = self.in_order(bounded(stamps))
        self.all_logs = self.in_order(logs)
        self.lap = len(stamps)
        self.arrivals: Stamps = self.all_logs

    def in_order(self, column: npt.NDArray[Number]) -> npt.NDArray[Number]:
        """Return the rows of `column`, one row per item, sorted by log time."""
        return column if self.order is None else column[self.order]

    @property
    def stamps(self) -> Stamps:
        """Stamps of the first lap (before the clock first jumped back), nanoseconds, shape (n,)."""
        return self.all_stamps[: self.lap]

    @property
    def logs(self) -> Stamps:
        """Log times of the first lap (before the clock jumped back), nanoseconds, shape (n,)."""
        return self.all_logs[: self.lap]

    @cached_property
    def latency(self) -> Stamps:
        """Delay from each stamp to the arrival of the item, nanoseconds, shape (n,)."""
        return self.arrivals - self.stamps

    @cached_property
    def median_latency(self) -> int:
        """Median latency, nanoseconds, of stamps other than 0."""
        stamped = self.latency[self.stamps != 0]
        return int(median(stamped)) if len(stamped) else 0

    @cached_property
    def wild(self) -> Mask:
        """Mask of single stamps that differ by more than an hour from their neighbours, shape (n,).

        The mask is all False if more than 1 % of the stamps differ, as with two clocks.
        """
        far = np.zeros(len(self.stamps), dtype=np.bool_)
        if len(far) < 3:
            return far
        steps = self.latency[1:] - self.latency[:-1]
        if steps.max() <= WILD and steps.min() >= -WILD:
            return far
        up, down = steps > WILD, steps < -WILD
        far[1:-1] = (up[:-1] & down[1:]) | (down[:-1] & up[1:])
        # The first and the last stamp have one neighbour only, which must be normal itself.
        # A first stamp in the past is normal for a latched message.
        far[0] = up[0] and not far[1]
        far[-1] = (up[-1] or down[-1]) and not far[-2]
        # Stamps of 0, or on the other clock, are other faults.
        is_sim = self.stamps < SIMULATED_BELOW
        far &= (self.stamps != 0) & (is_sim == (2 * np.count_nonzero(is_sim) > len(is_sim)))
        few = max(1.0, FEW * len(far))
        return far if np.count_nonzero(far) <= few else np.zeros_like(far)

    @cached_property
    def families(self) -> tuple[int, int]:
        """Numbers of stamps on a simulation's clock and on the wall clock, without zero stamps."""
        zero = int(np.count_nonzero(self.stamps == 0))
        wall = int(np.count_nonzero(self.stamps >= SIMULATED_BELOW))
        return len(self.stamps) - wall - zero, wall


class Track(Stream):
    """All transforms of one edge, in order of arrival.

    Attributes:
        parent: Parent frame of the edge, without a leading slash.
        child: Child frame of the edge.
        static: Whether the samples came on a static topic.
        slashed: Number of samples whose names had a leading slash.
    """

    def __init__(self, edge: Edge, transforms: Transforms) -> None:
        super().__init__(edge.stamps, transforms.log_times_of(edge))
        self.parent = edge.parent
        self.child = edge.child
        self.static = edge.static
        self.slashed = edge.slashed
        self._edge = edge
        self._transforms = transforms

    def stored_as(self, *, static: bool) -> "Track":
        """Return the track as static or as moving: the kind as which a listener stores it."""
        if static is self.static:
            return self
        stored = Track(self._edge, self._transforms)
        stored.static, stored.lap, stored.arrivals = static, self.lap, self.arrivals
        return stored

    @property
    def edge(self) -> tuple[str, str]:
        """Names of the parent and the child frame."""
        return self.parent, self.child

    @property
    def name(self) -> str:
        """Name of the edge for messages: "child in parent"."""
        return f"{self.child} in {self.parent}"

    @cached_property
    def records(self) -> Stamps:
        """Stamp and bits of the pose (7 doubles) of each sample of all laps, shape (m, 8)."""
        return self.in_order(self._edge.records)

    @cached_property
    def translations(self) -> Floats:
        """Translations of the samples, metres, shape (n, 3)."""
        return self.in_order(self._edge.translations)[: self.lap]

    @cached_property
    def rotations(self) -> Floats:
        """Rotations of the samples as recorded, quaternions x y z w, shape (n, 4)."""
        return self.in_order(self._edge.rotations)[: self.lap]

    @cached_property
    def senders(self) -> npt.NDArray[np.int32]:
        """Index of each sample's publisher in the list of all publishers, shape (n,)."""
        senders: npt.NDArray[np.int32] = self.in_order(self._transforms.senders_of(self._edge))
        return senders[: self.lap]

    @cached_property
    def messages(self) -> Places32:
        """Index of each sample's message in the recording, shape (n,)."""
        return self.in_order(self._edge.messages)[: self.lap]

    @cached_property
    def publishers(self) -> list[Publisher]:
        """Publishers of the edge; the node name of a publisher may be unknown."""
        senders = self.senders
        if len(senders) and senders.min() == senders.max():
            return [self._transforms.publishers[senders[0]]]
        return [self._transforms.publishers[number] for number in np.unique(senders).tolist()]

    @cached_property
    def nodes(self) -> tuple[str, ...]:
        """Known names of the nodes that publish the edge."""
        return tuple(sorted({one.node for one in self.publishers if one.node}))

    @cached_property
    def topics(self) -> tuple[str, ...]:
        """Names of the topics that contain transforms of the edge."""
        return tuple(sorted({one.topic for one in self.publishers}))

    @cached_property
    def is_orderly(self) -> bool:
        """Whether the reader found all samples usable and sorted by stamp."""
        return (
            self.order is None
            and self._edge.kept == len(self._edge) > 0
            and (self.static or self._edge.stamps[0] > 0)
            and bool(self._edge.stamps[-1] <= FAR)
        )

    @cached_property
    def finite(self) -> Mask:
        """Mask of the samples without NaN and infinity, shape (n,)."""
        if self.is_orderly:
            return np.ones(self.lap, dtype=np.bool_)
        finite = np.isfinite(self.translations).all(axis=1)
        mask: Mask = np.asarray(finite & np.isfinite(self.rotations).all(axis=1))
        return mask

    @cached_property
    def squares(self) -> Floats:
        """Squared lengths of the quaternions in `rotations`, shape (n,)."""
        rotations = self.rotations
        with np.errstate(all="ignore"):
            squares: Floats = np.einsum("ij,ij->i", rotations, rotations)
        return squares

    @cached_property
    def usable(self) -> Mask:
        """Mask of the samples that tf2 would store, shape (n,).

        tf2 stores samples with finite numbers and a nonzero quaternion. A sample on a moving topic
        also needs a nonzero stamp.
        """
        if self.is_orderly:
            return self.finite
        mask: Mask = self.finite & (self.squares > ZERO_QUATERNION)
        return mask if self.static else mask & (self.stamps != 0)

    @cached_property
    def by_stamp(self) -> npt.NDArray[np.intp]:
        """Indices of the k usable samples, sorted by stamp and then by arrival, shape (k,)."""
        if self.is_orderly:
            return np.arange(self.lap)
        places = np.flatnonzero(self.usable)
        stamps = self.stamps[places]
        return places[np.argsort(stamps, kind="stable")] if _falls(stamps) else places

    @property
    def last(self) -> int:
        """Index of the usable sample with the newest stamp; of a static edge, the last to arrive.

        Raises:
            IndexError: If no sample is usable.
        """
        return int(np.flatnonzero(self.usable)[-1] if self.static else self.by_stamp[-1])

    @cached_property
    def sorted_stamps(self) -> Stamps:
        """Stamps of the k usable samples, ascending, nanoseconds, shape (k,)."""
        stamps: Stamps = self.stamps if self.is_orderly else self.stamps[self.by_stamp]
        return stamps

    @cached_property
    def steps(self) -> Stamps:
        """Positive differences between consecutive sorted stamps, nanoseconds."""
        steps = self.sorted_stamps[1:] - self.sorted_stamps[:-1]
        positive: Stamps = steps[steps > 0]
        return positive

    @cached_property
    def period(self) -> int:
        """Period of the edge, the median of `steps`, nanoseconds; 0 without steps."""
        return int(median(self.steps)) if len(self.steps) else 0

    @cached_property
    def first_arrivals(self) -> Stamps:
        """For each of `sorted_stamps`, the first arrival of a sample that is at least as new.

        The times are on the clock of the stamps, nanoseconds, shape (k,).
        """
        arrivals = self.arrivals[self.by_stamp]
        earliest: Stamps = np.minimum.accumulate(arrivals[::-1])[::-1]
        return earliest

    def served_from(self, stamps: Stamps) -> Stamps:
        """Return the time from which lookups at each stamp can succeed on this edge.

        Args:
            stamps: Times of the lookups, nanoseconds, shape (m,).

        Returns:
            Times of arrival, nanoseconds, shape (m,); NEVER for a lookup that always fails.
        """
        if self.static:
            return np.full(len(stamps), np.iinfo(np.int64).min)
        places = np.searchsorted(self.sorted_stamps, stamps, side="left")
        padded = np.append(self.first_arrivals, NEVER)
        served: Stamps = padded[places]
        return served

    def apart(self, some: Places, others: Places) -> Floats:
        """Return the distance between paired samples, metres, shape (m,).

        Args:
            some: Indices of the first samples, shape (m,).
            others: Indices of the second samples, shape (m,).
        """
        away = self.translations[some] - self.translations[others]
        apart: Floats = np.sqrt(np.einsum("ij,ij->i", away, away))
        return apart

    @cached_property
    def strides(self) -> Floats:
        """Distance from each sample in `by_stamp` to the next, metres, shape (k - 1,)."""
        return self.apart(self.by_stamp[1:], self.by_stamp[:-1])

    def turned(self, some: Places, others: Places) -> Floats:
        """Return the angle between paired samples, radians, shape (m,); arguments as in `apart`."""
        return angles_between(unit(self.rotations[some]), unit(self.rotations[others]))

    def has_turns(self, some: Places, others: Places, radians: float) -> bool:
        """Whether any angle of `turned(some, others)` exceeds `radians`; faster than `turned`."""
        dots = np.einsum("ij,ij->i", self.rotations[some], self.rotations[others])
        lengths = np.sqrt(self.squares[some] * self.squares[others])
        return bool((np.abs(dots) < math.cos(radians / 2.0) * lengths).any())

    @cached_property
    def is_localisation(self) -> bool:
        """Whether a localiser publishes the edge, judged by the frame names of REP-105.

        Such an edge is the pose of odom or map in map, earth or world. Some localisers publish the
        inverse, the pose of map in odom.
        """
        parent, child = last_part(self.parent), last_part(self.child)
        if parent.startswith("odom"):
            return child.startswith("map")
        return parent in ("map", "earth", "world") and child.startswith(("odom", "map"))

    @property
    def is_odometry(self) -> bool:
        """Whether the edge is a robot's odometry or localisation, judged by the frame names."""
        return self.is_localisation or last_part(self.parent).startswith("odom")

    @cached_property
    def moves(self) -> bool:
        """Whether the edge's samples have different poses."""
        usable = np.flatnonzero(self.usable)
        if len(usable) < 2:
            return False
        first = usable[0]
        # Most moving edges move soon, so compare the first samples first.
        if len(usable) > 4096 and self._differs(usable[:2048], first):
            return True
        return self._differs(usable, first)

    def _differs(self, usable: Places, first: int) -> bool:
        apart = np.abs(self.translations[usable] - self.translations[first]).max()
        turned = np.abs(self.rotations[usable] - self.rotations[first]).max()
        return bool(apart > 1e-6 or turned > 1e-6)


class Heard(Stream):
    """Headers of the messages of one topic in one frame.

    Attributes:
        topic: Name of the topic.
        type: Type of the messages.
        frame: Frame name in the headers, with the leading slash if it has one.
    """

    def __init__(self, headers: Headers, number: int) -> None:
        mask = headers.frames == number
        whole = bool(mask.all())
        stamps = headers.stamps if whole else headers.stamps[mask]
        logs = headers.log_times if whole else headers.log_times[mask]
        super().__init__(stamps, logs)
        self.topic = headers.topic
        self.type = headers.type
        self.frame = headers.names[number]

    @property
    def name(self) -> str:
        """Name of the stream in sentences: the name of the topic."""
        return self.topic

    @property
    def is_spatial(self) -> bool:
        """Whether the topic's messages contain positions."""
        return is_spatial(self.type)

    @property
    def has_own_type(self) -> bool:
        """Whether the type is from a package that tftool does not know, such as a robot's own."""
        return self.type.partition("/")[0] not in definitions.table()


def bounded(stamps: Stamps) -> Stamps:
    """Clip stamps so that their differences fit into 64 bits; valid ROS stamps do not change."""
    if len(stamps) and (stamps.max() > FAR or stamps.min() < -FAR):
        return np.clip(stamps, -FAR, FAR)
    return stamps


JOINT_STATES = "sensor_msgs/JointState"
"""Type of messages from which robot_state_publisher computes transforms."""

BASES = ("base_link", "base_footprint", "base")
"""Usual names of the frame on which a robot's sensors are mounted."""

PLACED = frozenset({"LaserScan", "MultiEchoLaserScan", "PointCloud", "PointCloud2", "Range"})
"""Types of messages that costmaps, maps and localisers have to place."""

NOT_SPATIAL = frozenset(
    {
        JOINT_STATES,
        "sensor_msgs/BatteryState",
        "sensor_msgs/Joy",
        "sensor_msgs/TimeReference",
        "sensor_msgs/Temperature",
        "sensor_msgs/RelativeHumidity",
        "sensor_msgs/FluidPressure",
        "sensor_msgs/Illuminance",
        "geometry_msgs/TwistStamped",
        "geometry_msgs/AccelStamped",
        "geometry_msgs/TransformStamped",
    }
)


_SPATIAL = frozenset(
    {
        "visualization_msgs/Marker",
        "stereo_msgs/DisparityImage",
        "vision_msgs/Detection2DArray",
        "vision_msgs/Detection3DArray",
        "vision_msgs/Detection2D",
        "vision_msgs/Detection3D",
        "apriltag_msgs/AprilTagDetectionArray",
    }
)


def is_spatial(kind: str) -> bool:
    """Whether messages of a type contain positions."""
    if kind in NOT_SPATIAL:
        return False
    package, _, name = kind.partition("/")
    return (
        package in ("sensor_msgs", "nav_msgs")
        or (package == "geometry_msgs" and name.endswith("Stamped"))
        or kind in _SPATIAL
    )


def unsorted_share(stamps: Stamps) -> int:
    """Count the stamps that are older than a stamp that arrived earlier.

    Args:
        stamps: Stamps in order of arrival, shape (n,).
    """
    if len(stamps) < 2:
        return 0
    return int(np.count_nonzero(stamps[1:] < np.maximum.accumulate(stamps)[:-1]))


def rate(track: Stream) -> float:
    """Return the rate of a stream, samples per second; 0.0 for a single sample or equal stamps."""
    if len(track.stamps) < 2:
        return 0.0
    span = int(track.stamps.max()) - int(track.stamps.min())
    return (len(track.stamps) - 1) * NANOSECONDS / span if span else 0.0


def overlap(tracks: Sequence[Track]) -> bool:
    """Whether all tracks have data at some common time; static tracks have data at any time."""
    spans = [(int(t.sorted_stamps[0]), int(t.sorted_stamps[-1])) for t in tracks if _lives(t)]
    return not spans or max(low for low, _ in spans) <= min(high for _, high in spans)


def _lives(track: Track) -> bool:
    return not track.static and len(track.sorted_stamps) > 0


def _falls(column: Stamps) -> bool:
    return len(column) > 1 and bool((column[1:] < column[:-1]).any())


_FAMILY = re.compile(
    r"\d+|(?<![a-z])(?:left|right|front|rear|back|upper|lower|top|bottom|fl|fr|rl|rr|[lrxyz])(?![a-z])"
)


def family(name: str) -> str:
    """Replace numbers, and words such as left and front, by "#" in a frame name.

    Frames of one kind, such as the four wheels of a robot, get the same result.
    """
    return _FAMILY.sub("#", name.lower())


def last_part(name: str) -> str:
    """Return the part of a name after the last slash."""
    return name.rsplit("/", 1)[-1]


def are_same(track: Track, some: Places, other: Track, others: Places) -> Mask:
    """Return a mask of the pairs of samples with equal poses, except for signs of x, y and z.

    Args:
        track: First stream of transforms.
        some: Rows in `track`, shape (n,).
        other: Second stream of transforms.
        others: Rows in `other`, shape (n,).
    """
    mine, theirs = np.abs(track.translations[some]), np.abs(other.translations[others])
    apart = np.abs(mine - theirs).max(axis=1)
    dots = np.einsum("ij,ij->i", track.rotations[some], other.rotations[others])
    return np.asarray((apart < ROUNDED) & (np.abs(dots) > 1.0 - 1e-6))
