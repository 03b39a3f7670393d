"""Stamps and arrivals of one stream: a link's samples, or a topic's headers."""

import math
import re
from collections.abc import Sequence
from functools import cached_property
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, seconds
from tftool.geometry.rigid_arrays import Floats, angles_between, unit
from tftool.recordings.contract import Edge, Headers, Publisher, Stamps, Transforms, median

Number = TypeVar("Number", bound=np.generic)

Mask = npt.NDArray[np.bool_]

Places = npt.NDArray[np.intp]
"""Rows of a track, shape (n,)."""

Places32 = npt.NDArray[np.int32]
"""Numbers of messages or of senders, shape (n,)."""

NEVER = np.iinfo(np.int64).max
"""Arrival of a sample that never arrives."""

FAR = 2**61
"""Nanoseconds from 1970 beyond which no moment is looked for."""

WILD = seconds(3600)
"""How far from where it belongs a single stamp is no late message and no slow clock."""

FEW = 0.01
"""What share of the stamps may be such."""

ZERO_QUATERNION = 1e-12
"""A rotation whose squared length is below this has no direction: tf2 drops it."""


class Stream:
    """Stamped items in order of their log times.

    Attributes:
        stamps: Nanoseconds, shape (n,).
        logs: Log times, shape (n,).
        lap: Number of items in the first lap.
        arrivals: Log times on the clock of the stamps; set once the clocks are known.
    """

    def __init__(self, stamps: Stamps, logs: Stamps) -> None:
        logs = bounded(logs)
        self.order = np.argsort(logs, kind="stable") if _falls(logs) else None
        self.all_stamps = self.in_order(bounded(stamps))
        self.all_logs = self.in_order(logs)
        self.lap = len(stamps)
        self.arrivals: Stamps = self.all_logs

    def in_order(self, column: npt.NDArray[Number]) -> npt.NDArray[Number]:
        """Return the rows in order of log times."""
        return column if self.order is None else column[self.order]

    @property
    def stamps(self) -> Stamps:
        """Stamps of the first lap, nanoseconds."""
        return self.all_stamps[: self.lap]

    @property
    def logs(self) -> Stamps:
        """Log times of the first lap, nanoseconds."""
        return self.all_logs[: self.lap]

    @cached_property
    def latency(self) -> Stamps:
        """Return the delay from each stamp to its arrival, nanoseconds."""
        return self.arrivals - self.stamps

    @cached_property
    def median_latency(self) -> int:
        """Median latency, nanoseconds, of stamps other than 0."""
        stamped = self.latency[self.stamps != 0]
        return int(median(stamped)) if len(stamped) else 0

    @cached_property
    def wild(self) -> Mask:
        """Return a mask of stamps far from the arrivals around them, shape (n,).

        None does if they are many: alternating clocks are not accident.
        """
        far = np.zeros(len(self.stamps), dtype=np.bool_)
        if len(far) < 3:
            return far
        steps = self.latency[1:] - self.latency[:-1]
        if steps.max() <= WILD and steps.min() >= -WILD:
            return far
        up, down = steps > WILD, steps < -WILD
        far[1:-1] = (up[:-1] & down[1:]) | (down[:-1] & up[1:])
        # At the ends there is one neighbour alone, which has to be at home itself.
        # A first message that was latched is old by intention.
        far[0] = up[0] and not far[1]
        far[-1] = (up[-1] or down[-1]) and not far[-2]
        # Where the stamp is none, or of the other clock, that is another fault.
        is_sim = self.stamps < SIMULATED_BELOW
        far &= (self.stamps != 0) & (is_sim == (2 * np.count_nonzero(is_sim) > len(is_sim)))
        few = max(1.0, FEW * len(far))
        return far if np.count_nonzero(far) <= few else np.zeros_like(far)

    @cached_property
    def families(self) -> tuple[int, int]:
        """Count the stamps on a simulation's clock and on the calendar clock, without zeros."""
        zero = int(np.count_nonzero(self.stamps == 0))
        wall = int(np.count_nonzero(self.stamps >= SIMULATED_BELOW))
        return len(self.stamps) - wall - zero, wall


class Track(Stream):
    """All transforms of one edge in order of arrival.

    Attributes:
        parent: Name without its one leading slash.
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

    @property
    def edge(self) -> tuple[str, str]:
        """Parent and child."""
        return self.parent, self.child

    @property
    def name(self) -> str:
        """Name for messages."""
        return f"{self.child} in {self.parent}"

    @cached_property
    def translations(self) -> Floats:
        """Translations in metres, shape (n, 3), of the first lap."""
        return self.in_order(self._edge.translations)[: self.lap]

    @cached_property
    def rotations(self) -> Floats:
        """Rotations as recorded, shape (n, 4), of the first lap."""
        return self.in_order(self._edge.rotations)[: self.lap]

    @cached_property
    def senders(self) -> npt.NDArray[np.int32]:
        """Indices into the publishers, shape (n,), of the first lap."""
        senders: npt.NDArray[np.int32] = self.in_order(self._transforms.senders_of(self._edge))
        return senders[: self.lap]

    @cached_property
    def messages(self) -> Places32:
        """Numbers of the messages that contained the samples, shape (n,), of the first lap."""
        return self.in_order(self._edge.messages)[: self.lap]

    @cached_property
    def publishers(self) -> list[Publisher]:
        """Return the publishers, with or without known names."""
        senders = self.senders
        if len(senders) and senders.min() == senders.max():
            return [self._transforms.publishers[senders[0]]]
        return [self._transforms.publishers[number] for number in np.unique(senders).tolist()]

    @cached_property
    def nodes(self) -> tuple[str, ...]:
        """Return the publishing nodes, as far as known."""
        return tuple(sorted({one.node for one in self.publishers if one.node}))

    @cached_property
    def topics(self) -> tuple[str, ...]:
        """Return the topics."""
        return tuple(sorted({one.topic for one in self.publishers}))

    @cached_property
    def is_orderly(self) -> bool:
        """Whether all samples are known to be usable and sorted by stamp."""
        return (
            self.order is None
            and self._edge.kept == len(self._edge) > 0
            and (self.static or self._edge.stamps[0] > 0)
            and bool(self._edge.stamps[-1] <= FAR)
        )

    @cached_property
    def finite(self) -> Mask:
        """Return a mask of the samples with finite numbers only, shape (n,)."""
        if self.is_orderly:
            return np.ones(self.lap, dtype=np.bool_)
        finite = np.isfinite(self.translations).all(axis=1)
        mask: Mask = np.asarray(finite & np.isfinite(self.rotations).all(axis=1))
        return mask

    @cached_property
    def squares(self) -> Floats:
        """Squared lengths of the rotations, shape (n,)."""
        rotations = self.rotations
        with np.errstate(all="ignore"):
            squares: Floats = np.einsum("ij,ij->i", rotations, rotations)
        return squares

    @cached_property
    def usable(self) -> Mask:
        """Return a mask of the samples tf2 would store: finite, with a rotation, a stamp unless
        static.
        """
        if self.is_orderly:
            return self.finite
        mask: Mask = self.finite & (self.squares > ZERO_QUATERNION)
        return mask if self.static else mask & (self.stamps != 0)

    @cached_property
    def by_stamp(self) -> npt.NDArray[np.intp]:
        """Indices of usable samples in order of stamps; equal ones in order of arrival."""
        if self.is_orderly:
            return np.arange(self.lap)
        places = np.flatnonzero(self.usable)
        stamps = self.stamps[places]
        return places[np.argsort(stamps, kind="stable")] if _falls(stamps) else places

    @property
    def last(self) -> int:
        """Return the index of the last valid sample; for statics the last to arrive, as in tf2.

        Raises:
            IndexError: If none is usable.
        """
        return int(np.flatnonzero(self.usable)[-1] if self.static else self.by_stamp[-1])

    @cached_property
    def sorted_stamps(self) -> Stamps:
        """Stamps of usable samples, ascending."""
        stamps: Stamps = self.stamps if self.is_orderly else self.stamps[self.by_stamp]
        return stamps

    @cached_property
    def steps(self) -> Stamps:
        """Differences between neighbouring sorted stamps, without zeros."""
        steps = self.sorted_stamps[1:] - self.sorted_stamps[:-1]
        positive: Stamps = steps[steps > 0]
        return positive

    @cached_property
    def period(self) -> int:
        """Median step, nanoseconds; 0 if there is none."""
        return int(median(self.steps)) if len(self.steps) else 0

    @cached_property
    def first_arrivals(self) -> Stamps:
        """Return when the first sample with each sorted stamp or a later one arrived, (k,)."""
        arrivals = self.arrivals[self.by_stamp]
        earliest: Stamps = np.minimum.accumulate(arrivals[::-1])[::-1]
        return earliest

    def served_from(self, stamps: Stamps) -> Stamps:
        """Return for each stamp when data up to it is available; NEVER if it is not."""
        if self.static:
            return np.full(len(stamps), np.iinfo(np.int64).min)
        places = np.searchsorted(self.sorted_stamps, stamps, side="left")
        padded = np.append(self.first_arrivals, NEVER)
        served: Stamps = padded[places]
        return served

    def apart(self, some: Places, others: Places) -> Floats:
        """Return the distance between poses in metres, row by row."""
        away = self.translations[some] - self.translations[others]
        apart: Floats = np.sqrt(np.einsum("ij,ij->i", away, away))
        return apart

    @cached_property
    def strides(self) -> Floats:
        """Distances in metres between neighbours by stamp, shape (k - 1,)."""
        return self.apart(self.by_stamp[1:], self.by_stamp[:-1])

    def turned(self, some: Places, others: Places) -> Floats:
        """Return the angle between poses in radians, row by row."""
        return angles_between(unit(self.rotations[some]), unit(self.rotations[others]))

    def has_turns(self, some: Places, others: Places, radians: float) -> bool:
        """Whether two poses of a row differ by more than `radians`; faster than `turned`."""
        dots = np.einsum("ij,ij->i", self.rotations[some], self.rotations[others])
        lengths = np.sqrt(self.squares[some] * self.squares[others])
        return bool((np.abs(dots) < math.cos(radians / 2.0) * lengths).any())

    @cached_property
    def is_localisation(self) -> bool:
        """Whether REP-105 lets the edge jump: it places odometry or a map in a larger frame.

        Some localisers publish the inverse, the map in odometry.
        """
        parent, child = last_part(self.parent), last_part(self.child)
        if parent.startswith("odom"):
            return child.startswith("map")
        return parent in ("map", "earth", "world") and child.startswith(("odom", "map"))

    @cached_property
    def moves(self) -> bool:
        """Whether the poses of the track differ."""
        usable = np.flatnonzero(self.usable)
        if len(usable) < 2:
            return False
        first = usable[0]
        # Most that move do so soon.
        if len(usable) > 4096 and self._differs(usable[:2048], first):
            return True
        return self._differs(usable, first)

    def _differs(self, usable: Places, first: int) -> bool:
        apart = np.abs(self.translations[usable] - self.translations[first]).max()
        turned = np.abs(self.rotations[usable] - self.rotations[first]).max()
        return bool(apart > 1e-6 or turned > 1e-6)


class Heard(Stream):
    """Messages of one topic in one frame.

    Attributes:
        topic: Name of the topic.
        type: Type of the messages.
        frame: The name in the headers, slash included.
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
    def is_spatial(self) -> bool:
        """Whether the topic's data has a position."""
        return is_spatial(self.type)


def bounded(stamps: Stamps) -> Stamps:
    """Return stamps limited so that differences fit into 64 bits; ROS's own always do."""
    if len(stamps) and (stamps.max() > FAR or stamps.min() < -FAR):
        return np.clip(stamps, -FAR, FAR)
    return stamps


JOINT_STATES = "sensor_msgs/JointState"
"""Messages that robot_state_publisher makes transforms of."""

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
    """Whether messages of a type contain data with a position."""
    if kind in NOT_SPATIAL:
        return False
    package, _, name = kind.partition("/")
    return (
        package in ("sensor_msgs", "nav_msgs")
        or (package == "geometry_msgs" and name.endswith("Stamped"))
        or kind in _SPATIAL
    )


def unsorted_share(stamps: Stamps) -> int:
    """Return the number of stamps older than one received before."""
    if len(stamps) < 2:
        return 0
    return int(np.count_nonzero(stamps[1:] < np.maximum.accumulate(stamps)[:-1]))


def rate(track: Stream) -> float:
    """Return samples per second; 0.0 if unknown."""
    if len(track.stamps) < 2:
        return 0.0
    span = int(track.stamps.max()) - int(track.stamps.min())
    return (len(track.stamps) - 1) * NANOSECONDS / span if span else 0.0


def overlap(tracks: Sequence[Track]) -> bool:
    """Whether all of them exist at one common time; statics always do."""
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
    """Return a name without its number, left or right, front or back."""
    return _FAMILY.sub("#", name.lower())


def last_part(name: str) -> str:
    """Return the last part of a name, after any namespace."""
    return name.rsplit("/", 1)[-1]
