"""Synthetic frames and messages as columns: a robot with a laser, and possible faults."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from tftool.base.errors import DescriptionError
from tftool.base.stamps import seconds
from tftool.doctor.evidence import Evidence
from tftool.doctor.judge import Diagnosis, judge
from tftool.doctor.model import Settings
from tftool.recordings.contract import Edge, Headers, Publisher, RecordedTopic, Transforms
from tftool.robots.robot_model import Robot as DescribedRobot
from tftool.robots.urdf import parse_description

START = 1_750_000_000.0
"""Time at which each recording begins, seconds."""

LASTS = 8.0
NO_TURN = (0.0, 0.0, 0.0, 1.0)

Pose = tuple[float, ...]
MOUNT: Pose = (0.1, 0.0, 0.2, *NO_TURN)


def drives(t: float) -> Pose:
    """Return the pose of a robot that drives half a metre per second along x."""
    return (0.5 * t, 0.0, 0.0, *NO_TURN)


def stands(_t: float) -> Pose:
    return MOUNT


@dataclass
class Robot:
    """Recorded data; times are seconds from the start, latencies are seconds."""

    start: float = START
    records: dict[tuple[str, str, bool], list[tuple[int, Pose, int]]] = field(default_factory=dict)
    messages: list[tuple[int, int]] = field(default_factory=list)
    publishers: list[Publisher] = field(default_factory=list)
    heard: dict[str, tuple[str, list[tuple[int, int, str]]]] = field(default_factory=dict)
    slashed: dict[tuple[str, str, bool], int] = field(default_factory=dict)
    clock: list[tuple[int, int]] = field(default_factory=list)
    damage: tuple[str, ...] = ()
    commands: dict[str, list[int]] = field(default_factory=dict)
    """Log times of the commands to move on each topic."""
    kind: str = "columns"
    urdf: str = ""
    joints: frozenset[str] | None = None
    odometry: "Robot | None" = None
    """Robot whose transforms are the poses in the odometry messages."""
    log_from: float | None = None
    """Log time of the start, seconds; None for the stamps' own start."""
    noise: np.random.Generator | None = None
    """Random generator for jitter of latencies and periods; None for no jitter."""

    def unsteady(self, value: float, share: float) -> float:
        """Return a value with random jitter of at most the given share."""
        if self.noise is None:
            return value
        return value + abs(value) * float(self.noise.uniform(-share, share))

    def log(self, at: float) -> int:
        """Return the log time of data that arrives `at` seconds after the start."""
        return seconds(self.start if self.log_from is None else self.log_from) + seconds(at)

    def sent(
        self,
        parent: str,
        child: str,
        at: float,
        pose: Pose = MOUNT,
        *,
        latency: float = 0.005,
        topic: str = "/tf",
        node: str = "",
        stamp: int | None = None,
    ) -> None:
        """Add one transform; `stamp`, in nanoseconds, replaces the stamp that `at` gives."""
        publisher = Publisher(topic, node)
        if publisher not in self.publishers:
            self.publishers.append(publisher)
        log = self.log(at + self.unsteady(latency, 0.3 if abs(latency) < 0.1 else 0.01))
        self.messages.append((log, self.publishers.index(publisher)))
        key = (parent, child, topic.endswith("tf_static"))
        made = seconds(self.start) + seconds(at) if stamp is None else stamp
        self.records.setdefault(key, []).append((made, pose, len(self.messages) - 1))

    def moving(
        self,
        parent: str,
        child: str,
        hz: float = 50.0,
        pose: Callable[[float], Pose] = drives,
        *,
        begin: float = 0.0,
        end: float = LASTS,
        without: tuple[float, float] = (0.0, 0.0),
        latency: float = 0.005,
        offset: float = 0.0,
        node: str = "",
        topic: str = "/tf",
    ) -> None:
        """Add a periodic transform; `offset` shifts its stamps to the future."""
        for tick in range(round((end - begin) * hz)):
            at = begin + tick / hz
            if self.noise is not None:
                at += float(self.noise.uniform(0.0, 0.1)) / hz
            if not without[0] <= at < without[1]:
                self.sent(
                    parent,
                    child,
                    at + offset,
                    pose(at),
                    latency=latency - offset,
                    node=node,
                    topic=topic,
                )

    def static(self, parent: str, child: str, pose: Pose = MOUNT, at: float = 0.0) -> None:
        self.sent(parent, child, at, pose, topic="/tf_static")

    def hears(
        self,
        topic: str,
        frame: str,
        hz: float = 10.0,
        kind: str = "sensor_msgs/LaserScan",
        *,
        begin: float = 0.0,
        end: float = LASTS,
        latency: float = 0.015,
    ) -> None:
        """Add messages with a header."""
        _, messages = self.heard.setdefault(topic, (kind, []))
        for tick in range(round((end - begin) * hz)):
            at = begin + tick / hz
            log = self.log(at + self.unsteady(latency, 0.3 if abs(latency) < 0.1 else 0.01))
            messages.append((seconds(self.start) + seconds(at), log, frame))

    def evidence(self) -> Evidence:
        edges = tuple(
            Edge(*key, self.slashed.get(key, 0), _records(rows), _places(row[2] for row in rows))
            for key, rows in self.records.items()
        )
        logs = np.array([log for log, _ in self.messages], dtype=np.int64)
        transforms = Transforms(
            edges, logs, _places(sender for _, sender in self.messages), tuple(self.publishers)
        )
        headers = {}
        for topic, (kind, rows) in self.heard.items():
            names = tuple(dict.fromkeys(frame for _, _, frame in rows))
            headers[topic] = Headers(
                topic,
                kind,
                np.array([stamp for stamp, _, _ in rows], dtype=np.int64),
                np.array([log for _, log, _ in rows], dtype=np.int64),
                names,
                _places(names.index(frame) for _, _, frame in rows),
            )
        every = [*logs.tolist(), *(int(h.log_times.max()) for h in headers.values() if len(h))]
        every += [log for times in self.commands.values() for log in times]
        topics = tuple(
            RecordedTopic(
                name, "tf2_msgs/TFMessage", transforms=True, static=name.endswith("tf_static")
            )
            for name in sorted({publisher.topic for publisher in self.publishers})
        )
        topics += tuple(
            RecordedTopic(name, kind, count=len(rows)) for name, (kind, rows) in self.heard.items()
        )
        clock = np.array(self.clock, dtype=np.int64).reshape(-1, 2)
        described, mistakes = self._description()
        return Evidence(
            joints=self.joints,
            robot=described,
            mistakes=mistakes,
            odometry=None if self.odometry is None else self.odometry.evidence().transforms,
            name="made up",
            kind=self.kind,
            transforms=transforms,
            headers=headers,
            clock=(clock[:, 0].copy(), clock[:, 1].copy()),
            topics=topics,
            publishers=tuple(self.publishers),
            damage=self.damage,
            commands={topic: np.array(times, np.int64) for topic, times in self.commands.items()},
            start=min(every, default=0),
            end=max(every, default=0),
        )

    def _description(self) -> tuple[DescribedRobot | None, tuple[str, ...]]:
        try:
            return (DescribedRobot(parse_description(self.urdf)) if self.urdf else None), ()
        except DescriptionError as error:
            return None, tuple(mistake.text for mistake in error.mistakes)

    def judged(self, settings: Settings | None = None) -> Diagnosis:
        return judge(self.evidence(), settings)


def _records(rows: list[tuple[int, Pose, int]]) -> np.ndarray:
    records = np.zeros((len(rows), 8))
    records[:, 1:] = [pose for _, pose, _ in rows]
    whole = records.view(np.int64)
    whole[:, 0] = [stamp for stamp, _, _ in rows]
    return whole


def _places(numbers: Iterable[int]) -> np.ndarray:
    return np.array(list(numbers), dtype=np.int32)


def robot(
    *,
    odometry: bool = True,
    laser: bool = True,
    scans: bool = True,
    start: float = START,
    log_from: float | None = None,
) -> Robot:
    """Return a healthy robot with odom, base_link, laser and its scans, or with some of them."""
    made = Robot(start=start, log_from=log_from)
    if odometry:
        made.moving("odom", "base_link")
    if laser:
        made.static("base_link", "laser")
    if scans:
        made.hears("/scan", "laser")
    return made
