"""What the checks look at: columns and headers on one clock, in laps, as trees.

Nothing here reads a file: `Material` is what a source, a buffer or a session gave.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt

from tftool.errors import DescriptionError, InputError
from tftool.geometry.batch import Floats, angles_between, unit
from tftool.sources.contract import (
    SIMULATED_BELOW,
    Edge,
    Headers,
    Publisher,
    RecordedTopic,
    Source,
    Stamps,
    Transforms,
)
from tftool.sources.described import description_topics, prefix_of, read_description
from tftool.sources.joint_states import joint_state_topics, read_joint_states
from tftool.sources.robot import Robot, load_urdf
from tftool.sources.timeline import through_clock
from tftool.sources.urdf import RobotJoint
from tftool.stamps import CACHE_TIME, NANOSECONDS, Duration, Stamp, seconds

Mask = npt.NDArray[np.bool_]
Places = npt.NDArray[np.intp]
"""Rows of a track, shape (n,)."""

Limits = Mapping[str, float]
"""The thresholds of one check, by name."""

ODOMETRY = "nav_msgs/Odometry"

NEVER = np.iinfo(np.int64).max
"""The arrival of what never arrives."""

LAP = seconds(1)
"""How far a stream's stamps step back where a lap begins, and within which time all do."""

WARM_UP = seconds(1)
"""The start and the end of a recording, which checks of coverage leave out."""

ZERO_QUATERNION = 1e-12
"""A rotation whose squared length is below this has no direction: tf2 drops it."""


@dataclass(frozen=True, slots=True, eq=False)
class Material:
    """What is known of the frames: all that a diagnosis may look at.

    Attributes:
        name: What it is called, for people.
        kind: What it is: "MCAP", "scenario".
        transforms: In columns, with log times.
        headers: Of messages, by topic.
        clock: What `/clock` read and when it was received, nanoseconds.
        topics: Every topic.
        publishers: Every stream of messages.
        damage: What could not be read, as sentences.
        start: Log time of the first message.
        end: Log time of the last.
        timed: Whether it has log times; a buffer has none.
        recorded: Whether it was recorded, and may be played.
        joints: Names in all joint states; None where none was recorded.
        robot: The robot's description, given or recorded; None without one that can be read.
        mistakes: What is wrong with the description, as sentences.
        odometry: Odometry messages as transforms; None where there are none.
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


def read(source: Source, transforms: Transforms, urdf: "Described | None" = None) -> Material:
    """Take from an opened source, whose transforms are read, what a diagnosis looks at.

    Args:
        source: The recording.
        transforms: Its transforms.
        urdf: The robot's description; None for the one that was recorded, if any.

    Raises:
        InputError: If the headers cannot be read.
    """
    described = urdf or _recorded_description(source)
    odometry = [topic.name for topic in source.topics if topic.type == ODOMETRY and topic.count]
    joints = None
    if described.robot is not None:
        names = joint_state_topics(source.topics, described.namespace)
        if names:
            states = read_joint_states(source, names).states
            joints = frozenset(name for one in states for name in one.names)
    return Material(
        joints=joints,
        robot=described.robot,
        mistakes=described.mistakes,
        odometry=source.transforms(odometry) if odometry else None,
        name=source.name,
        kind=source.kind,
        transforms=transforms,
        headers=source.headers(),
        clock=source.clock(),
        topics=source.topics,
        publishers=source.publishers,
        damage=tuple(dict.fromkeys((*source.damage, *transforms.damage))),
        start=source.start,
        end=source.end,
    )


@dataclass(frozen=True, slots=True)
class Described:
    """A robot description that was looked for.

    Attributes:
        robot: What it describes; None where there is none that can be read.
        mistakes: What is wrong with it, as sentences.
        namespace: That of its topic, "/arm" for "/arm/robot_description".
    """

    robot: Robot | None = None
    mistakes: tuple[str, ...] = ()
    namespace: str = ""


def described_by(path: str | Path) -> Described:
    """The robot that a URDF or xacro file describes, or what is wrong with it.

    Raises:
        InputError: If the file cannot be read.
        UsageError: If it needs xacro, which is not installed.
    """
    try:
        return Described(load_urdf(path))
    except DescriptionError as error:
        return Described(mistakes=_mistakes(error))


def _recorded_description(source: Source) -> Described:
    for topic in description_topics(source.topics):
        namespace = topic.name.rpartition("/")[0]
        try:
            return Described(read_description(source, topic), namespace=namespace)
        except DescriptionError as error:
            return Described(mistakes=_mistakes(error), namespace=namespace)
        except InputError as error:
            return Described(mistakes=(str(error),), namespace=namespace)
    return Described()


def _mistakes(error: DescriptionError) -> tuple[str, ...]:
    """Each with its line; the lines themselves are left out."""
    return tuple(
        f"{mistake.file}:{mistake.line}:{mistake.column}: {mistake.text}"
        for mistake in error.mistakes[: error.MOST]
    )


@dataclass(frozen=True, slots=True)
class Settings:
    """What the listener that is thought of would do, and other limits than the usual ones.

    Attributes:
        cache_time: How far back its buffer remembers, nanoseconds.
        fixed_frame: Where it wants to place sensors; empty for the usual one.
        limits: Thresholds by check and name, in place of the catalogue's.
        tf_topics: Topics it listens to for transforms; empty for the usual ones.
    """

    cache_time: Duration = CACHE_TIME
    fixed_frame: str = ""
    tf_topics: tuple[str, ...] = ()
    limits: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


class Stream:
    """Stamped things that arrive one after the other, in the order of their log times.

    Attributes:
        stamps: Nanoseconds, shape (n,).
        logs: Log times, shape (n,).
        lap: How many of them belong to the first lap.
        arrivals: Log times on the clock of the stamps; set once the clocks are known.
    """

    def __init__(self, stamps: Stamps, logs: Stamps) -> None:
        logs = bounded(logs)
        self.order = np.argsort(logs, kind="stable") if _falls(logs) else None
        self.all_stamps = self.in_order(bounded(stamps))
        self.all_logs = self.in_order(logs)
        self.lap = len(stamps)
        self.arrivals: Stamps = self.all_logs

    def in_order(self, column: npt.NDArray[np.generic]) -> npt.NDArray:  # type: ignore[type-arg]
        """Rows in the order of log times."""
        return column if self.order is None else column[self.order]

    @property
    def stamps(self) -> Stamps:
        """Nanoseconds, of the first lap."""
        return self.all_stamps[: self.lap]

    @property
    def logs(self) -> Stamps:
        """Log times, of the first lap."""
        return self.all_logs[: self.lap]

    @cached_property
    def latency(self) -> Stamps:
        """How long after its stamp each arrived, nanoseconds."""
        return self.arrivals - self.stamps

    @cached_property
    def median_latency(self) -> int:
        """Nanoseconds; of those whose stamp is not 0."""
        stamped = self.latency[self.stamps != 0]
        return int(np.median(stamped)) if len(stamped) else 0

    @cached_property
    def families(self) -> tuple[int, int]:
        """How many stamps count from a simulation's start, and from 1970; zeros aside."""
        zero = int(np.count_nonzero(self.stamps == 0))
        wall = int(np.count_nonzero(self.stamps >= SIMULATED_BELOW))
        return len(self.stamps) - wall - zero, wall


class Track(Stream):
    """Every transform of one edge, in the order of their arrival.

    Attributes:
        parent: Name without its one leading slash.
        child: Likewise.
        static: Whether it came on a static topic.
        slashed: How many had a leading slash.
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
        """For people."""
        return f"{self.child} in {self.parent}"

    @cached_property
    def translations(self) -> Floats:
        """Metres, shape (n, 3), of the first lap."""
        return self.in_order(self._edge.translations)[: self.lap]

    @cached_property
    def rotations(self) -> Floats:
        """As recorded, shape (n, 4), of the first lap."""
        return self.in_order(self._edge.rotations)[: self.lap]

    @cached_property
    def senders(self) -> npt.NDArray[np.int32]:
        """Places in the publishers, shape (n,), of the first lap."""
        senders: npt.NDArray[np.int32] = self.in_order(self._transforms.senders_of(self._edge))
        return senders[: self.lap]

    @cached_property
    def nodes(self) -> tuple[str, ...]:
        """Who publishes it, where that is known."""
        numbers = np.unique(self.senders)
        names = (self._transforms.publishers[number].node for number in numbers.tolist())
        return tuple(sorted({name for name in names if name}))

    @cached_property
    def topics(self) -> tuple[str, ...]:
        """Where it came from."""
        numbers = np.unique(self.senders)
        return tuple(sorted({self._transforms.publishers[n].topic for n in numbers.tolist()}))

    @cached_property
    def finite(self) -> Mask:
        """Which have nothing but finite numbers, shape (n,)."""
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
        """Which tf2 would keep: finite, with a rotation, and a stamp unless static."""
        mask: Mask = self.finite & (self.squares > ZERO_QUATERNION)
        return mask if self.static else mask & (self.stamps != 0)

    @cached_property
    def by_stamp(self) -> npt.NDArray[np.intp]:
        """Places of the usable ones in the order of their stamps; of equal ones, as they came."""
        places = np.flatnonzero(self.usable)
        stamps = self.stamps[places]
        return places[np.argsort(stamps, kind="stable")] if _falls(stamps) else places

    @cached_property
    def sorted_stamps(self) -> Stamps:
        """Of the usable ones, ascending."""
        stamps: Stamps = self.stamps[self.by_stamp]
        return stamps

    @cached_property
    def steps(self) -> Stamps:
        """Differences of neighbouring sorted stamps, those of equal ones left out."""
        steps = np.diff(self.sorted_stamps)
        positive: Stamps = steps[steps > 0]
        return positive

    @cached_property
    def period(self) -> int:
        """Median step, nanoseconds; 0 where there is none."""
        return int(np.median(self.steps)) if len(self.steps) else 0

    @cached_property
    def first_arrivals(self) -> Stamps:
        """When the first sample with this sorted stamp or a later one had arrived, shape (k,)."""
        arrivals = self.arrivals[self.by_stamp]
        earliest: Stamps = np.minimum.accumulate(arrivals[::-1])[::-1]
        return earliest

    def served_from(self, stamps: Stamps) -> Stamps:
        """When the first sample of each stamp or later arrives; NEVER where none does."""
        if self.static:
            return np.full(len(stamps), np.iinfo(np.int64).min)
        places = np.searchsorted(self.sorted_stamps, stamps, side="left")
        padded = np.append(self.first_arrivals, NEVER)
        served: Stamps = padded[places]
        return served

    def apart(self, some: Places, others: Places) -> Floats:
        """Metres between poses, row by row."""
        away = self.translations[some] - self.translations[others]
        apart: Floats = np.sqrt(np.einsum("ij,ij->i", away, away))
        return apart

    def turned(self, some: Places, others: Places) -> Floats:
        """Radians between poses, row by row."""
        return angles_between(unit(self.rotations[some]), unit(self.rotations[others]))

    def has_turns(self, some: Places, others: Places, radians: float) -> bool:
        """Whether any two poses are further turned than so much; quicker than to say how much."""
        dots = np.einsum("ij,ij->i", self.rotations[some], self.rotations[others])
        lengths = np.sqrt(self.squares[some] * self.squares[others])
        return bool((np.abs(dots) < math.cos(radians / 2.0) * lengths).any())

    @cached_property
    def is_localisation(self) -> bool:
        """Whether REP-105 lets it jump: it places odometry or a map in something larger."""
        parent, child = last_part(self.parent), last_part(self.child)
        return parent in ("map", "earth", "world") and child.startswith(("odom", "map"))

    @cached_property
    def moves(self) -> bool:
        """Whether its poses differ."""
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
    """Messages of one topic that are in one frame.

    Attributes:
        topic: Name of the topic.
        type: Its type.
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
        """Whether what it carries has a place."""
        return is_spatial(self.type)


@dataclass(frozen=True, slots=True)
class Lap:
    """A moment at which time went back.

    Attributes:
        log: When, as log time.
        before: The last stamp before.
        after: The first stamp after.
        streams: How many streams did.
    """

    log: Stamp
    before: Stamp
    after: Stamp
    streams: int


@dataclass(frozen=True, slots=True)
class Tree:
    """Frames that hang together.

    Attributes:
        root: The frame without a parent; some frame of the circle where there is none.
        frames: All of them, the root included.
        is_circle: Whether it has no root.
    """

    root: str
    frames: frozenset[str]
    is_circle: bool = False


class Model:
    """The material, read once for all checks.

    Attributes:
        material: What it was made of.
        settings: What the listener is like.
        tracks: One for each edge, without what no listener can use (see `nameless`).
        nameless: Edges with an empty name, or whose ends are the same frame.
        heard: One for each topic and frame of its messages.
        laps: Where time went back; all else is about what came before the first.
        reference: How latencies are reckoned, a sentence; empty where that is plain.
    """

    def __init__(self, material: Material, settings: Settings | None = None) -> None:
        self.material = material
        self.settings = settings or Settings()
        tracks = [Track(edge, material.transforms) for edge in material.transforms.edges]
        self.nameless = tuple(t for t in tracks if not t.parent or not t.child or _is_own(t))
        self.tracks = tuple(t for t in tracks if t not in self.nameless)
        self.heard = tuple(
            Heard(headers, number)
            for headers in material.headers.values()
            for number in range(len(headers.names))
        )
        self.laps: tuple[Lap, ...] = ()
        self.reference = ""
        if material.timed:
            self._find_laps()
        self._put_on_one_clock()
        # What only came after the first lap is not looked at.
        self.tracks = tuple(track for track in self.tracks if len(track.stamps))
        self.nameless = tuple(track for track in self.nameless if len(track.stamps))
        self.heard = tuple(heard for heard in self.heard if len(heard.stamps))

    @cached_property
    def dynamic(self) -> tuple[Track, ...]:
        """Edges that came on a topic that is not static."""
        return tuple(track for track in self.tracks if not track.static)

    @cached_property
    def statics(self) -> tuple[Track, ...]:
        """Edges that came on a static topic."""
        return tuple(track for track in self.tracks if track.static)

    @cached_property
    def start(self) -> Stamp:
        """Log time at which the first lap begins."""
        return max(self.material.start, -(2**61))

    @cached_property
    def epoch(self) -> Stamp:
        """The first stamp of what moves; log time where nothing does."""
        firsts = [int(t.sorted_stamps[0]) for t in self.dynamic if len(t.sorted_stamps)]
        return min(firsts, default=self.start)

    @cached_property
    def end(self) -> Stamp:
        """Log time at which the first lap ends."""
        return self.laps[0].log if self.laps else min(self.material.end, 2**61)

    @cached_property
    def parents(self) -> dict[str, Track]:
        """The latest edge above each child."""
        latest: dict[str, tuple[int, Track]] = {}
        for track in self.tracks:
            if not len(track.stamps):
                continue
            last = int((track.logs if self.material.timed else track.stamps)[-1])
            held = latest.get(track.child)
            if held is None or last >= held[0]:
                latest[track.child] = (last, track)
        return {child: track for child, (_, track) in latest.items()}

    @cached_property
    def frames(self) -> frozenset[str]:
        """Every frame that a transform names."""
        return frozenset(name for track in self.tracks for name in track.edge)

    @cached_property
    def prefix(self) -> str:
        """What stands before a described link's name in that of its frame; usually nothing."""
        robot = self.material.robot
        return "" if robot is None else prefix_of(robot, self.frames)

    @cached_property
    def joint_above(self) -> Mapping[str, RobotJoint]:
        """The description's joint above each frame; none without a description."""
        robot = self.material.robot
        joints = () if robot is None else robot.joints.values()
        return {self.prefix + joint.child: joint for joint in joints}

    @cached_property
    def described(self) -> frozenset[str]:
        """The frames that the description promises; none without one."""
        robot = self.material.robot
        return frozenset(() if robot is None else (self.prefix + link for link in robot.links))

    @cached_property
    def trees(self) -> tuple[Tree, ...]:
        """By the latest parents, the largest first."""
        root_of: dict[str, tuple[str, bool]] = {}
        for frame in sorted(self.frames):
            walked: list[str] = []
            here, circle = frame, False
            while here not in root_of:
                if here in walked:
                    here, circle = min(walked[walked.index(here) :]), True
                    break
                walked.append(here)
                above = self.parents.get(here)
                if above is None:
                    break
                here = above.parent
            root = root_of.get(here, (here, circle))
            root_of.update(dict.fromkeys(walked, root))
        members: dict[tuple[str, bool], set[str]] = {}
        for frame, key in root_of.items():
            members.setdefault(key, set()).add(frame)
        trees = [Tree(root, frozenset(of), circle) for (root, circle), of in members.items()]
        usual = {"map": 0, "odom": 1, "world": 2}
        return tuple(
            sorted(trees, key=lambda t: (-len(t.frames), usual.get(last_part(t.root), 3), t.root))
        )

    @cached_property
    def tree_of(self) -> dict[str, Tree]:
        """The tree of each frame."""
        return {frame: tree for tree in self.trees for frame in tree.frames}

    def above(self, frame: str) -> list[Track]:
        """The edges from a frame up to its root, lowest first."""
        edges: list[Track] = []
        seen = {frame}
        while (track := self.parents.get(frame)) is not None:
            edges.append(track)
            frame = track.parent
            if frame in seen:
                break
            seen.add(frame)
        return edges

    def path(self, frame: str, other: str) -> list[Track] | None:
        """The edges between two frames; None where they are not joined."""
        if frame not in self.frames or other not in self.frames:
            return None
        up, down = self.above(frame), self.above(other)
        ups = [frame, *(track.parent for track in up)]
        downs = [other, *(track.parent for track in down)]
        for place, name in enumerate(ups):
            if name in downs:
                return up[:place] + down[: downs.index(name)]
        return None

    def below(self, frame: str) -> frozenset[str]:
        """A frame and everything that hangs below it by the latest parents."""
        children: dict[str, list[str]] = {}
        for child, track in self.parents.items():
            children.setdefault(track.parent, []).append(child)
        found: set[str] = set()
        waiting = [frame]
        while waiting:
            one = waiting.pop()
            if one not in found:
                found.add(one)
                waiting += children.get(one, ())
        return frozenset(found)

    @cached_property
    def sensor_frame(self) -> str:
        """Where sensors are to be placed: what was asked for, else odom, else the usual root."""
        return self._fixed("odom", "map", "world")

    @cached_property
    def fixed_frame(self) -> str:
        """Where everything is to be placed: what was asked for, else map, odom, world, a root."""
        return self._fixed("map", "odom", "world")

    def _fixed(self, *usual: str) -> str:
        if self.settings.fixed_frame:
            return self.settings.fixed_frame
        if not self.trees:
            return ""
        main = self.trees[0]
        for name in usual:
            if name in main.frames:
                return name
        for name in usual:
            parts = sorted(frame for frame in main.frames if last_part(frame) == name)
            if parts:
                return parts[0]
        return main.root

    @cached_property
    def warm(self) -> tuple[Stamp, Stamp]:
        """Log times between which coverage is judged."""
        return self.start + WARM_UP, self.end - WARM_UP

    def log_of(self, stamp: Stamp) -> Stamp:
        """The log time of a moment on the clock of the stamps."""
        read, received = self.material.clock
        if stamp >= SIMULATED_BELOW or self.material.end < SIMULATED_BELOW:
            return stamp
        if len(read):
            return int(through_clock(np.array([stamp]), received, read)[0])
        return stamp + self._offset

    def _streams(self) -> list[Stream]:
        """What may step back: neither statics nor what came once."""
        streams: list[Stream] = [
            track for track in self.tracks if not track.static and len(track.stamps) > 1
        ]
        streams += [heard for heard in self.heard if len(heard.stamps) > 1]
        return streams

    def _find_laps(self) -> None:
        streams = self._streams()
        backs: list[tuple[int, int, int, int, int]] = []
        for number, stream in enumerate(streams):
            for place in _steps_back(stream.stamps):
                at = int(stream.logs[place])
                before, after = int(stream.stamps[place - 1]), int(stream.stamps[place])
                backs.append((at, number, place, before, after))
        backs.sort()
        needed = max(2, (len(streams) + 1) // 2)
        laps: list[Lap] = []
        first: list[tuple[int, int, int, int, int]] = []
        place = 0
        while place < len(backs):
            group = [one for one in backs[place:] if one[0] <= backs[place][0] + LAP]
            if len({one[1] for one in group}) < needed:
                place += 1
                continue
            first = first or group
            befores = max(one[3] for one in group)
            afters = min(one[4] for one in group)
            laps.append(Lap(group[0][0], befores, afters, len({one[1] for one in group})))
            place += len(group)
        self.laps = tuple(laps)
        if not laps:
            return
        own = {number: place for _, number, place, _, _ in reversed(first)}
        numbers = {id(stream): number for number, stream in enumerate(streams)}
        for every in (*self.tracks, *self.nameless, *self.heard):
            number = numbers.get(id(every), -1)
            if number in own:
                every.lap = own[number]
            elif not (isinstance(every, Track) and every.static):
                every.lap = int(np.searchsorted(every.all_logs, laps[0].log, side="left"))

    def _put_on_one_clock(self) -> None:
        """Reckon arrivals on the clock of the stamps: 2.1 of the specification's latency."""
        streams: list[Stream] = [*self.tracks, *self.nameless, *self.heard]
        simulated = [one for one in streams if one.families[0]]
        read, received = self.material.clock
        self._offset = 0
        for stream in streams:
            stream.arrivals = stream.logs
        if not simulated or self.material.end < SIMULATED_BELOW:
            return  # log times are on the clock of the stamps already
        if not len(read):
            self._offset = self._freshest()
            self.reference = (
                "stamps are a simulation's and there is no /clock: the freshest stream counts "
                "as not late at all, and only differences are true"
            )
        for stream in streams:
            logs = stream.logs
            if not stream.families[0]:
                continue
            on_clock = through_clock(logs, read, received) if len(read) else logs - self._offset
            is_sim = stream.stamps < SIMULATED_BELOW
            stream.arrivals = on_clock if is_sim.all() else np.where(is_sim, on_clock, logs)

    def _freshest(self) -> int:
        offsets = []
        for stream in self._streams():
            if isinstance(stream, Track) and stream.is_localisation:
                continue
            mask = (stream.stamps < SIMULATED_BELOW) & (stream.stamps != 0)
            if mask.any():
                offsets.append(int(np.median(stream.logs[mask] - stream.stamps[mask])))
        return min(offsets, default=0)


def bounded(stamps: Stamps) -> Stamps:
    """Moments near enough that their differences fit 64 bits; those of ROS all are."""
    far = 2**61
    if len(stamps) and (int(stamps.max()) > far or int(stamps.min()) < -far):
        return np.clip(stamps, -far, far)
    return stamps


def last_part(name: str) -> str:
    """What a name ends in, behind namespaces."""
    return name.rsplit("/", 1)[-1]


NOT_SPATIAL = frozenset(
    {
        "sensor_msgs/JointState",
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
    """Whether messages of a type carry something that has a place."""
    if kind in NOT_SPATIAL:
        return False
    package, _, name = kind.partition("/")
    return (
        package in ("sensor_msgs", "nav_msgs")
        or (package == "geometry_msgs" and name.endswith("Stamped"))
        or kind in _SPATIAL
    )


def unsorted_share(stamps: Stamps) -> int:
    """How many stamps are older than one that came before."""
    if len(stamps) < 2:
        return 0
    return int(np.count_nonzero(stamps[1:] < np.maximum.accumulate(stamps)[:-1]))


def rate(track: Stream) -> float:
    """Samples a second of stamps; 0.0 where there is no telling."""
    if len(track.stamps) < 2:
        return 0.0
    span = int(track.stamps.max()) - int(track.stamps.min())
    return (len(track.stamps) - 1) * NANOSECONDS / span if span else 0.0


def overlap(tracks: Sequence[Track]) -> bool:
    """Whether there is a moment at which all of them exist; statics always do."""
    spans = [(int(t.sorted_stamps[0]), int(t.sorted_stamps[-1])) for t in tracks if _lives(t)]
    return not spans or max(low for low, _ in spans) <= min(high for _, high in spans)


def _lives(track: Track) -> bool:
    return not track.static and len(track.sorted_stamps) > 0


def _is_own(track: Track) -> bool:
    return track.parent == track.child


def _falls(column: Stamps) -> bool:
    return len(column) > 1 and bool((column[1:] < column[:-1]).any())


def _steps_back(stamps: Stamps) -> list[int]:
    """Places at which stamps of one clock step back by more than a lap's least."""
    stamped = np.flatnonzero(stamps != 0)
    kept = stamps[stamped]
    back = np.flatnonzero(
        (kept[1:] < kept[:-1] - LAP)
        & ((kept[1:] < SIMULATED_BELOW) == (kept[:-1] < SIMULATED_BELOW))
    )
    # A stream that goes to and fro all the time tells of no lap.
    return [int(stamped[place + 1]) for place in back[:1000]]
