"""Transforms implied by odometry and poses, on request."""

from collections.abc import Collection, Iterable
from typing import Final

import numpy as np

from tftool.recordings.contract import Edge, RecordedTopic, Transforms

IMPLYING: Final = (
    "nav_msgs/Odometry",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovarianceStamped",
)
"""Types whose messages say where one frame is in another, short.

Odometry names both; a pose names what it is in, and its topic is taken for the frame's name.
"""


def implying(topics: Iterable[RecordedTopic]) -> tuple[RecordedTopic, ...]:
    """Return the topics whose messages imply transforms."""
    return tuple(one for one in topics if one.type in IMPLYING and one.encoding in ("cdr", "ros1"))


def joined(said: Transforms, implied: Transforms) -> Transforms:
    """Merge published transforms with implied ones of frames that tf lacks.

    Args:
        said: Transforms of the topics that carry them.
        implied: Transforms implied by other topics of the same recording.
    """
    known: Collection[str] = {edge.child for edge in said.edges}
    first = len(said.log_times)
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
        said.edges + added,
        np.concatenate([said.log_times, implied.log_times]),
        np.concatenate([said.senders, implied.senders]),
        said.publishers,
        said.damage + implied.damage,
    )
