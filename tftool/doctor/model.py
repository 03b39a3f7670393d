"""Model of the evidence: streams of stamps on one clock, trees of frames, and jumps of the clock.

The checks read this model. The module `evidence` reads the files.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from tftool.base.common_ancestor import climbed, up_to_join
from tftool.base.stamps import CACHE_TIME, SIMULATED_BELOW, Duration, Stamp, seconds
from tftool.doctor.evidence import (
    Evidence,
    is_player,
    without_copies,
    without_doubtful_names,
)
from tftool.doctor.stamp_stream import (
    BASES,
    JOINT_STATES,
    WILD,
    Heard,
    Mask,
    Stream,
    Track,
    last_part,
)
from tftool.doctor.wording import is_ros1, ros_words
from tftool.recordings.contract import Stamps
from tftool.recordings.description_frames import prefix_of
from tftool.recordings.timeline import through_clock
from tftool.robots.description import RobotJoint

Limits = Mapping[str, float]
"""Thresholds of one check, by name."""


_DRIFT = seconds(0.5)
"""Delay of a simulation without `/clock` from which its rate is estimated."""

LAP = seconds(1)
"""Minimum backward step of stamps at a new lap (a restart); all streams step within this time."""

WARM_UP = seconds(1)
"""Time at the start and the end of a recording that checks of coverage ignore."""


@dataclass(frozen=True, slots=True)
class Settings:
    """Settings of the assumed listener, and changed thresholds.

    Attributes:
        cache_time: Cache time of the listener's buffer, nanoseconds.
        fixed_frame: Target frame for sensor data; empty for the usual frame, such as odom.
        limits: Thresholds that replace the defaults, by id of the check and name of the threshold.
        tf_topics: Topics of transforms to which the listener subscribes; empty for the usual
            topics.
    """

    cache_time: Duration = CACHE_TIME
    fixed_frame: str = ""
    tf_topics: tuple[str, ...] = ()
    limits: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


_ONE_CLOCK = seconds(0.05)
"""Maximum difference between two delays of one clock, nanoseconds."""

_FIXED = 3
"""Number of constant transforms of robot_state_publisher from which fixed joints are among them."""

_AHEAD = seconds(0.1)
"""Maximum time by which a static_transform_publisher of ROS 1 dates ahead: its usual period."""

_LAST_WORD = re.compile(r"\d+$|(?<![^_.-])[^_.-]+$")
"""Part of a frame name that differs between objects of one kind, such as marker_7 or face_kwxyz."""

_A_FEW = 3
"""Minimum number of objects of one kind that show a detector."""

SHIFT = seconds(2)
"""Minimum constant difference between stamps and reception that counts as a shift of the clock."""

_LEAST_SHARED = seconds(0.5)
"""Minimum shift of the clock, nanoseconds, if all streams are late by nearly the same time."""

_SHARED = seconds(0.2)
"""Maximum difference between delays of streams, and within a stream, that agree."""


@dataclass(frozen=True, slots=True)
class Shift:
    """Constant difference between the clock of the stamps and the clock of the recorder.

    Attributes:
        by: Time from stamp to reception of most messages, nanoseconds; negative if the stamps are
            later than reception.
        spread: Median variation of this time in a stream, nanoseconds: from its 10 % to its 90 %
            quantile, or only to its median if `has_bursts`.
        has_bursts: Whether many messages waited for more than a second.
        streams: Number of streams (edges and topics) with this shift.
        of: Number of all compared streams.
    """

    by: Duration
    spread: Duration
    has_bursts: bool
    streams: int
    of: int


@dataclass(frozen=True, slots=True)
class Lap:
    """Backward jump of the clock, as when a bag is played in a loop.

    Attributes:
        log: Log time of the jump.
        before: The newest stamp before the jump.
        after: The oldest stamp after the jump.
        streams: Number of streams (edges and topics) that jumped.
    """

    log: Stamp
    before: Stamp
    after: Stamp
    streams: int


@dataclass(frozen=True, slots=True)
class Tree:
    """Tree of frames, each connected to its newest parent.

    Attributes:
        root: The frame without a parent; in a loop, one of the frames of the loop.
        frames: All frames, including the root.
        is_circle: Whether the tree has a loop of frames instead of a frame without a parent.
    """

    root: str
    frames: frozenset[str]
    is_circle: bool = False


class Model:
    """Model of the evidence: values derived from the evidence that several checks need.

    Attributes:
        evidence: The evidence.
        settings: Settings of the listener.
        tracks: Samples of each edge, without the edges in `nameless`.
        copies: Number of transforms left out of `tracks`, by topic, because a listener of /tf does
            not need them; see `without_copies`.
        nameless: Edges that no listener can use, because a frame name is empty or both names are
            equal.
        heard: Headers of messages, one stream for each topic and frame.
        laps: Backward jumps of the clock. The other attributes only contain data before the first
            jump.
        reference: Sentence about the clock used for latencies; empty for the recorder's clock.
        was_played: Whether a node with the name of `rosbag play` or `ros2 bag play` published some
            data. Only transforms beside those of other nodes keep its name.
        shift: Constant by which most stamps differ from the times of reception; None if there is
            no such constant.
    """

    def __init__(self, evidence: Evidence, settings: Settings | None = None) -> None:
        self.was_played = any(is_player(one.node) for one in evidence.publishers)
        evidence = replace(
            evidence,
            transforms=without_doubtful_names(evidence.transforms),
            publishers=tuple(
                replace(one, node="") if is_player(one.node) else one for one in evidence.publishers
            ),
        )
        self.evidence = evidence
        self.settings = settings or Settings()
        edges, self.copies = without_copies(evidence)
        tracks = [Track(edge, evidence.transforms) for edge in edges]
        self.nameless = tuple(track for track in tracks if _is_nameless(track))
        self.tracks = tuple(track for track in tracks if not _is_nameless(track))
        self.heard = tuple(
            Heard(headers, number)
            for headers in evidence.headers.values()
            for number in range(len(headers.names))
        )
        self.laps: tuple[Lap, ...] = ()
        self.reference = ""
        self.shift: Shift | None = None
        if evidence.timed:
            self._find_laps()
        self._put_on_one_clock()
        # Streams that begin only after the first lap are left out.
        self.tracks = tuple(track for track in self.tracks if len(track.stamps))
        self.nameless = tuple(track for track in self.nameless if len(track.stamps))
        self.heard = tuple(heard for heard in self.heard if len(heard.stamps))

    @cached_property
    def dynamic(self) -> tuple[Track, ...]:
        """Edges whose transforms came on a topic for moving transforms, such as /tf."""
        return tuple(track for track in self.tracks if not track.static)

    @cached_property
    def statics(self) -> tuple[Track, ...]:
        """Edges whose transforms came on a topic for static transforms, such as /tf_static."""
        return tuple(track for track in self.tracks if track.static)

    @cached_property
    def unshifted(self) -> tuple[Track, ...]:
        """Moving edges without the shift that most other streams have; empty if `shift` is None."""
        if self.shift is None:
            return ()
        by = self.shift.by
        return tuple(
            track
            for track in self.dynamic
            if len(track.stamps) > 2 and 4 * abs(track.median_latency + by) < abs(by)
        )

    @cached_property
    def has_named_publishers(self) -> bool:
        """Whether two or more nodes with known names publish transforms."""
        return len({one.node for one in self.evidence.transforms.publishers if one.node}) > 1

    @cached_property
    def has_lists(self) -> bool:
        """Whether some transforms are not single (TransformStamped), so listeners receive them."""
        kinds = {topic.name: last_part(topic.type) for topic in self.evidence.topics}
        topics = {topic for track in self.tracks for topic in track.topics}
        return any(kinds.get(topic) != "TransformStamped" for topic in topics)

    @cached_property
    def words(self) -> Mapping[str, str]:
        """Mapping from placeholders to commands and settings of the recording's ROS version."""
        return ros_words(self.evidence)

    @cached_property
    def lacks_statics(self) -> bool:
        """Whether the data has no static transforms.

        Constant transforms on /tf, as in early ROS 1, count as static ones.
        """
        if self.statics or not self.tracks:
            return False
        if any(topic.static for topic in self.evidence.topics):
            return True
        return self.is_parted or all(
            track.moves or len(track.by_stamp) < 2 or track.is_odometry for track in self.dynamic
        )

    @cached_property
    def is_parted(self) -> bool:
        """Whether one robot_state_publisher sends frames of several trees, without any statics.

        A robot description is one tree, so the fixed joints between these trees are missing. The
        result is False if the fixed joints are on /tf, as in early ROS 1: half a second ahead, or
        several that never change.
        """
        roots: dict[str, set[str]] = defaultdict(set)
        constant: Counter[str] = Counter()
        for track in () if self.statics else self.dynamic:
            if track.median_latency > -_AHEAD:
                constant.update(track.nodes if not track.moves else ())
                for node in track.nodes:
                    roots[node].add(self.tree_of[track.child].root)
        return any(
            "state_publisher" in node and len(roots[node]) > 1 and constant[node] < _FIXED
            for node in roots
        )

    @cached_property
    def empty_messages(self) -> Mask:
        """Mask of the messages of transforms that contain no transform, shape (m,)."""
        transforms = self.evidence.transforms
        empty = np.ones(len(transforms.log_times), dtype=np.bool_)
        for edge in transforms.edges:
            empty[edge.messages] = False
        return empty

    @cached_property
    def joint_topics(self) -> tuple[str, ...]:
        """Topics of joint states that have messages."""
        headers = self.evidence.headers.items()
        return tuple(topic for topic, h in headers if h.type == JOINT_STATES and len(h))

    @cached_property
    def lacks_state_publisher(self) -> bool:
        """Whether joint states arrived, but all transforms come from odometry or localisers.

        Without a description, joint states on a topic with another name than joint_states may be
        the wheels that a driver measures.
        """
        is_usual = any(last_part(topic) == "joint_states" for topic in self.joint_topics)
        is_usual |= bool(self.joint_topics) and self.evidence.robot is not None
        return is_usual and all(track.is_odometry for track in self.tracks)

    @cached_property
    def start(self) -> Stamp:
        """Log time at which the examined data begins, nanoseconds."""
        return max(self.evidence.start, -(2**61))

    @cached_property
    def epoch(self) -> Stamp:
        """First stamp of all moving edges, nanoseconds; without such edges, the first log time."""
        firsts = [int(t.sorted_stamps[0]) for t in self.dynamic if len(t.sorted_stamps)]
        return min(firsts, default=self.start)

    @cached_property
    def end(self) -> Stamp:
        """Log time at which the examined data ends, nanoseconds: at the first jump back, if any."""
        return self.laps[0].log if self.laps else min(self.evidence.end, 2**61)

    @cached_property
    def edges_above(self) -> dict[str, list[Track]]:
        """Mapping from each child's name to the edges that end at it, in the order of `tracks`."""
        edges: dict[str, list[Track]] = {}
        for track in self.tracks:
            edges.setdefault(track.child, []).append(track)
        return edges

    def first_of(self, child: str) -> Track:
        """Return the edge to a child that arrived first.

        tf2 of ROS 1 keeps the kind of this edge, static or moving, for ever.
        """
        return min(self.edges_above[child], key=lambda track: int(track.logs[0]))

    @cached_property
    def parents(self) -> dict[str, Track]:
        """Mapping from each child's name to the edge from the child's newest parent."""
        latest: dict[str, tuple[int, Track]] = {}
        for track in self.tracks:
            if not len(track.stamps):
                continue
            last = int((track.logs if self.evidence.timed else track.stamps)[-1])
            held = latest.get(track.child)
            if held is None or last >= held[0]:
                latest[track.child] = (last, track)
        return {child: track for child, (_, track) in latest.items()}

    @cached_property
    def frames(self) -> frozenset[str]:
        """Names of all parent and child frames in transforms."""
        return frozenset(name for track in self.tracks for name in track.edge)

    @cached_property
    def prefix(self) -> str:
        """Prefix that frame names have before the link names of the description; usually empty."""
        robot = self.evidence.robot
        if robot is None:
            return ""
        return prefix_of(robot, self.frames)

    @cached_property
    def joint_above(self) -> Mapping[str, RobotJoint]:
        """Mapping from each link's frame to the joint above the link; empty without a robot."""
        robot = self.evidence.robot
        joints = () if robot is None else robot.joints.values()
        return {self.prefix + joint.child: joint for joint in joints}

    @cached_property
    def described(self) -> frozenset[str]:
        """Names of the frames of all links in the description; empty without a description."""
        robot = self.evidence.robot
        return frozenset(() if robot is None else (self.prefix + link for link in robot.links))

    @cached_property
    def trees(self) -> tuple[Tree, ...]:
        """Trees that the frames form with their newest parents, the largest tree first."""
        root_of: dict[str, tuple[str, bool]] = {}
        for frame in sorted(self.frames):
            walked: dict[str, None] = {}
            here, circle = frame, False
            while here not in root_of:
                if here in walked:
                    way = list(walked)
                    here, circle = min(way[way.index(here) :]), True
                    break
                walked[here] = None
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
        """Mapping from each frame's name to the tree of the frame."""
        return {frame: tree for tree in self.trees for frame in tree.frames}

    def above(self, frame: str) -> list[Track]:
        """Return the edges from a frame up to its root, lowest first."""
        return climbed(frame, self.parents.get)

    def path(self, frame: str, other: str) -> list[Track] | None:
        """Return the edges on the path from `frame` to `other`; None if there is no path."""
        if frame not in self.frames or other not in self.frames:
            return None
        legs = up_to_join(frame, other, self.above)
        return None if legs is None else legs[0] + legs[1]

    def rests(self, frame: str) -> bool:
        """Whether all edges between a frame and the fixed frame are static."""
        path = self.path(frame, self.fixed_frame)
        return path is not None and all(track.static for track in path)

    def below(self, frame: str) -> frozenset[str]:
        """Return a frame and all its descendants in the tree of the newest parents."""
        found: set[str] = set()
        waiting = [frame]
        while waiting:
            one = waiting.pop()
            if one not in found:
                found.add(one)
                waiting += self._children.get(one, ())
        return frozenset(found)

    def is_minor(self, track: Track) -> bool:
        """Whether an edge is a minor part of a robot, such as a wheel, without sensor data."""
        below = self.below(track.child)
        is_robot = any(last_part(frame) in BASES for frame in self.tree_of[track.child].frames)
        if not is_robot or len(below) > 2 or last_part(track.child).startswith(("odom", "map")):
            return False
        if any(last_part(frame) in BASES for frame in below):
            return False
        return not self.has_sensor(track.child)

    def has_sensor(self, frame: str) -> bool:
        """Whether sensor messages with a position are in a frame or below it."""
        below = self.below(frame)
        return any(
            h.is_spatial and h.type.startswith("sensor_msgs/") and h.frame.lstrip("/") in below
            for h in self.heard
        )

    @cached_property
    def _children(self) -> dict[str, list[str]]:
        children: dict[str, list[str]] = {}
        for child, track in self.parents.items():
            children.setdefault(track.parent, []).append(child)
        return children

    @cached_property
    def passing(self) -> frozenset[str]:
        """Frames of objects that come and go, as a detector sends them, and the frames below.

        Such objects are three or more of one publisher and one parent, with one name except for a
        number or the last word. Most of them last less than half of the time from the first to the
        last of them.
        """
        kinds: dict[tuple[object, ...], list[Track]] = defaultdict(list)
        for track in self.dynamic:
            if kind := _LAST_WORD.sub("", last_part(track.child)):
                kinds[(track.parent, track.nodes, track.topics, kind)].append(track)
        found: set[str] = set()
        for (_, nodes, *_), tracks in kinds.items():
            lasts = np.array([(track.logs[0], track.logs[-1]) for track in tracks])
            half = (lasts[:, 1].max() - lasts[:, 0].min()) // 2
            if len(tracks) >= _A_FEW and np.mean(lasts[:, 1] - lasts[:, 0] < half) > 0.5:
                below = frozenset[str]().union(*(self.below(track.child) for track in tracks))
                found |= {child for child in below if self.parents[child].nodes == nodes}
        return frozenset(found)

    @cached_property
    def sensor_frame(self) -> str:
        """Target frame for sensor data: `settings.fixed_frame`, else odom, map, world or a root.

        The first of these frames that exists is used.
        """
        return self._fixed("odom", "map", "world")

    @cached_property
    def fixed_frame(self) -> str:
        """Fixed frame: `settings.fixed_frame`, else the first of map, odom, world and a root."""
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
        """Log times between which coverage is checked: the data without `WARM_UP` at each end."""
        return self.start + WARM_UP, self.end - WARM_UP

    def log_of(self, stamp: Stamp) -> Stamp:
        """Convert a time on the clock of the stamps to log time, nanoseconds."""
        read, received = self.evidence.clock
        if stamp >= SIMULATED_BELOW or self.evidence.end < SIMULATED_BELOW:
            return stamp if self.shift is None else stamp + self.shift.by
        if len(read):
            return int(through_clock(np.array([stamp]), received, read)[0])
        read, received = self._clock
        return int(through_clock(np.array([stamp]), received, read)[0])

    def _streams(self) -> list[Stream]:
        """Return the topics and moving edges with several stamps, which show backward jumps."""
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
        """Convert the arrival times of all streams to the clock of the stamps."""
        streams: list[Stream] = [*self.tracks, *self.nameless, *self.heard]
        simulated = [one for one in streams if one.families[0]]
        read, received = self.evidence.clock
        for stream in streams:
            stream.arrivals = stream.logs
        if self.evidence.timed:
            self._find_shift(streams)
        if not simulated or self.evidence.end < SIMULATED_BELOW:
            return  # log times are on the clock of the stamps already
        if not len(read):
            read, received = self._clock
            self.reference = (
                "stamps count from 0 and there is no /clock: the latency of the fastest stream "
                "is taken as 0, and only differences between latencies are right"
            )
        for stream in streams:
            logs = stream.logs
            if not stream.families[0]:
                continue
            on_clock = through_clock(logs, read, received)
            is_sim = stream.stamps < SIMULATED_BELOW
            stream.arrivals = np.where(is_sim, on_clock, stream.arrivals)

    def _find_shift(self, streams: list[Stream]) -> None:
        """Set `shift` to the constant delay of most streams, and subtract it from the arrivals."""
        late, spreads, moving, kept = [], [], [], []
        for stream in streams:
            is_moving = False
            if isinstance(stream, Track):
                if stream.static:
                    continue
                is_moving = stream.moves and not stream.is_localisation
            elif isinstance(stream, Heard) and not stream.is_spatial:
                continue
            if len(stream.stamps) < 3 or sum(stream.families) != stream.families[1]:
                continue
            if not stream.families[1]:
                continue
            delays = (stream.logs - stream.stamps)[stream.stamps != 0]
            low, middle, high = np.percentile(delays, (10, 50, 90), method="nearest").tolist()
            late.append(int(middle))
            kept.append(stream)
            spreads.append((int(high) - int(low), int(middle) - int(low)))
            if is_moving:
                moving.append(int(middle))
        by = sorted(late)[len(late) // 2] if late else 0
        # A single stream may be late by seconds for its own reasons, but not by hours.
        is_shared = len(late) > 2 and max(late) - min(late) < _SHARED
        if abs(by) <= (SHIFT if len(late) > 1 else WILD) and not (is_shared and by > _LEAST_SHARED):
            return
        # Compared with days, seconds are network delay; the smallest delay shows the clock.
        near = max(LAP, abs(by) // 10_000)
        alike = [spread for one, spread in zip(late, spreads, strict=True) if abs(one - by) < near]
        # Bursts delay stamps, but do not set those of all streams after reception.
        is_ahead = by < 0 and len(alike) == len(late) > 2
        spread, half = (sorted(ones)[len(alike) // 2] for ones in zip(*alike, strict=True))
        has_bursts = is_ahead and spread > LAP
        spread = half if has_bursts else spread
        if 2 * len(alike) <= len(late) or spread > (LAP if abs(by) > SHIFT else _SHARED):
            return
        prompt = [s for one, s in zip(late, kept, strict=True) if abs(one) < LAP]
        kinds = {type(s) for s in prompt if not (isinstance(s, Track) and s.is_localisation)}
        if len(kinds) > 1:
            return  # a part of the robots, with transforms and messages, is on the recorder's clock
        at_once = [s for one, s in zip(late, kept, strict=True) if abs(one - by) < _ONE_CLOCK]
        if all(_copies(at_once[0], other) for other in at_once[1:]):
            # A late stream and its copies do not show the clock, so use the freshest stream.
            by = min(one for one in late if abs(one - by) < near)
        by = min([one for one in moving if LAP <= by - one < near], default=by)
        others = [
            one
            for one, stream in zip(late, kept, strict=True)
            if abs(one - by) < _AHEAD and not (isinstance(stream, Track) and not stream.moves)
        ]
        if is_ros1(self.evidence) and others:
            # ROS 1 dates constants ahead: they tell the clock only if nothing else does.
            by = max(by, min(others))
        self.shift = Shift(by, spread, has_bursts, len(alike), len(late))
        for stream in streams:
            is_wall = stream.stamps >= SIMULATED_BELOW
            stream.arrivals = np.where(is_wall, stream.logs - by, stream.logs)

    @cached_property
    def _clock(self) -> tuple[Stamps, Stamps]:
        """Estimate a simulation's clock from the stamps of all streams, without `/clock`.

        Return times of the clock and the corresponding log times, nanoseconds, shape (n,) each.
        """
        kept: list[tuple[Stamps, Stamps]] = []
        offset, steady = 0, True
        streams = [
            one for one in self._streams() if not (isinstance(one, Track) and one.is_localisation)
        ]
        # ROS 1 stamps constant transforms ahead, so use them only without other streams.
        moving = [one for one in streams if not isinstance(one, Track) or one.moves]
        for stream in moving or streams:
            mask = (stream.stamps < SIMULATED_BELOW) & (stream.stamps != 0)
            if not mask.any():
                continue
            stamps, logs = stream.stamps[mask], stream.logs[mask]
            delays = logs - stamps
            least = int(np.median(delays))
            if not kept or least < offset:
                offset = least
                early, late = np.median(delays[: len(delays) // 2 + 1]), np.median(delays[-9:])
                steady = abs(late - early) < _DRIFT
            near = abs(delays - least) < WILD
            kept.append((stamps[near], logs[near]))
        if steady or not any(len(stamps) for stamps, _ in kept):
            return np.array([0], np.int64), np.array([offset], np.int64)
        # The rates of the clocks differ. The simulated time is at least the newest stamp.
        stamps, logs = (np.concatenate(columns) for columns in zip(*kept, strict=True))
        order = np.argsort(logs, kind="stable")
        return np.maximum.accumulate(stamps[order]), logs[order]


def _copies(one: Stream, other: Stream) -> bool:
    """Whether most stamps of two streams are equal, as if a node computed one from the other."""
    shares = (np.isin(one.stamps, other.stamps), np.isin(other.stamps, one.stamps))
    return all(float(share.mean()) > 0.5 for share in shares)


def _is_nameless(track: Track) -> bool:
    return not track.parent or not track.child or track.parent == track.child


def _steps_back(stamps: Stamps) -> list[int]:
    """Return the index of each stamp that is older than the previous stamp by more than `LAP`.

    A step between a simulation's clock and the wall clock does not count.
    """
    stamped = np.flatnonzero(stamps != 0)
    kept = stamps[stamped]
    back = np.flatnonzero(
        (kept[1:] < kept[:-1] - LAP)
        & ((kept[1:] < SIMULATED_BELOW) == (kept[:-1] < SIMULATED_BELOW))
    )
    # Limited, because a stream that jumps back and forth all the time shows no laps.
    return [int(stamped[place + 1]) for place in back[:1000]]
