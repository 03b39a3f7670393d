"""Transforms on chosen topics, for several robots; transforms from odometry and poses.

Robots in namespaces publish the same frame names on separate topics: /r1/tf, /r2/tf.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from tftool.base.errors import InputError
from tftool.base.plain_text import count, near_names
from tftool.recordings.container_reader import Recorded
from tftool.recordings.contract import Edge, Progress, RecordedTopic, Transforms

SHARED_ROOTS: Final = frozenset({"earth", "map", "world"})
"""Fixed frames that REP 105 lets several robots share; odom belongs to one robot."""


@dataclass(frozen=True, slots=True)
class RobotNames:
    """Frame names of several robots, distinguished by namespaces.

    Attributes:
        robots: Namespaces without slashes at the ends; "" for topics without a namespace.
        colliding: Frame names that several robots use for different frames.
    """

    robots: tuple[str, ...]
    colliding: frozenset[str]

    def named(self, topic: str, frame: str) -> str:
        """Return the unique name of a frame, for a frame name in a message on a topic."""
        robot = next((one for one in self.robots if one and topic.startswith(f"/{one}/")), "")
        return f"{robot}/{frame}" if robot and frame in self.colliding else frame

    def __str__(self) -> str:
        """Return a sentence about the frames that got a prefix; "" if no frame got a prefix."""
        if not self.colliding:
            return ""
        some = ", ".join(sorted(self.colliding)[:3]) + (" …" if len(self.colliding) > 3 else "")
        prefixes = ", ".join(f"'{robot}/'" for robot in self.robots if robot)
        frames = count(len(self.colliding), "frame")
        return f"{frames} of several robots ({some}) got the prefix {prefixes}"


def transforms_on(
    source: Recorded, topics: Sequence[str], progress: Progress | None = None
) -> tuple[Transforms, RobotNames]:
    """Read the transforms on some topics, and on the static topics in the same namespaces.

    Topics of one namespace belong to one robot. A frame name that several robots use gets the
    namespace as prefix, except for names of shared root frames (`SHARED_ROOTS`).

    Args:
        source: The recording.
        topics: Names of topics with transforms.
        progress: Function called with the bytes read and their total, from 0 for each robot.

    Returns:
        The transforms, and the changed frame names.

    Raises:
        InputError: If a topic is not in the recording, or has no transforms.
    """
    robots: dict[str, list[str]] = {}
    for name in _with_statics(source, topics):
        robots.setdefault(name.rpartition("/")[0].strip("/"), []).append(name)
    parts = {robot: source.transforms(names, progress) for robot, names in robots.items()}
    names = RobotNames(tuple(parts), _colliding([part.edges for part in parts.values()]))
    edges: list[Edge] = []
    first = 0
    for robot, part in parts.items():
        topic = f"/{robot}/"
        edges += [
            replace(
                edge,
                parent=names.named(topic, edge.parent),
                child=names.named(topic, edge.child),
                messages=(edge.messages + first).astype(np.int32),
            )
            for edge in part.edges
        ]
        first += len(part.log_times)
    whole = Transforms(
        tuple(edges),
        np.concatenate([part.log_times for part in parts.values()]),
        # All parts have the same list of publishers.
        np.concatenate([part.senders for part in parts.values()]),
        next(iter(parts.values())).publishers,
        tuple(dict.fromkeys(text for part in parts.values() for text in part.damage)),
    )
    return whole, names


def _with_statics(source: Recorded, names: Iterable[str]) -> list[str]:
    """Return the given topics, and the static topics in the same namespaces."""
    known = {topic.name for topic in source.topics if topic.transforms}
    found = []
    for name in names:
        if name not in known:
            near = near_names(name, sorted(known)) or sorted(known)[:5]
            hint = f"; there is {', '.join(near)}" if near else ""
            raise InputError(f"'{source.name}' has no transforms on '{name}'{hint}.")
        found += [one for one in (name, f"{name}_static") if one in known]
    return list(dict.fromkeys(found))


def _colliding(robots: Sequence[Sequence[Edge]]) -> frozenset[str]:
    """Return the frame names that several robots use for different frames."""
    used = Counter(
        frame for edges in robots for frame in {one for e in edges for one in (e.parent, e.child)}
    )
    children = {edge.child for edges in robots for edge in edges}
    shared = SHARED_ROOTS - children
    return frozenset(frame for frame, times in used.items() if times > 1 and frame not in shared)


IMPLYING: Final = (
    "nav_msgs/Odometry",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovarianceStamped",
)
"""Types (short form) whose messages contain the pose of one frame in another.

Odometry names both frames. A pose names the parent only; its topic is used as the child's name.
"""


def implying(topics: Iterable[RecordedTopic]) -> tuple[RecordedTopic, ...]:
    """Return the topics with odometry or poses, which can be used as transforms."""
    return tuple(one for one in topics if one.type in IMPLYING and one.encoding in ("cdr", "ros1"))


def superfluous(found: Transforms, topics: Collection[str]) -> "list[npt.NDArray[np.bool_]]":
    """Return a mask of each edge's single transforms (TransformStamped) that tf topics replace.

    A motion capture often sends each pose on /tf and on a topic of its own, which no tf listener
    receives.

    Args:
        found: All transforms of a recording.
        topics: Names of the topics of type TransformStamped.
    """
    is_single = np.array([one.topic in topics for one in found.publishers], dtype=np.bool_)
    masks = [is_single[found.senders_of(edge)] for edge in found.edges]
    sent = {edge.child for edge, mask in zip(found.edges, masks, strict=True) if not mask.all()}
    return [mask & (edge.child in sent) for edge, mask in zip(found.edges, masks, strict=True)]


def without_single(found: Transforms, topics: Collection[str]) -> Transforms:
    """Leave out transforms of topics of type TransformStamped, for frames that tf topics have, too.

    Args:
        found: All transforms of a recording.
        topics: Names of the topics of type TransformStamped.
    """
    if not topics:
        return found
    masks = superfluous(found, topics)
    edges = (
        edge.chosen(~mask) if mask.any() else edge
        for edge, mask in zip(found.edges, masks, strict=True)
    )
    return replace(found, edges=tuple(edge for edge in edges if len(edge)))


def joined(sent: Transforms, implied: Transforms) -> Transforms:
    """Merge transforms from tf topics with transforms from odometry and poses.

    Odometry and poses are used only for frames without transforms on tf topics.

    Args:
        sent: Transforms from tf topics.
        implied: Transforms from odometry and poses in the same recording.
    """
    known: Collection[str] = {edge.child for edge in sent.edges}
    first = len(sent.log_times)
    added = tuple(
        Edge(
            edge.parent,
            edge.child,
            edge.static,
            edge.slashed,
            edge.records,
            (edge.messages + first).astype(np.int32),
        )
        for edge in implied.edges
        if edge.child not in known and edge.child != edge.parent
    )
    return Transforms(
        sent.edges + added,
        np.concatenate([sent.log_times, implied.log_times]),
        np.concatenate([sent.senders, implied.senders]),
        sent.publishers,
        sent.damage + implied.damage,
    )
