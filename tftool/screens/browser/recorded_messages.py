"""Drawable messages of a recording, topic by topic and within limits."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError, TransformException
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer
from tftool.recordings.recording import Recording, open_recording
from tftool.screens.browser.displays import cloud, path, point, scan
from tftool.screens.browser.displays.shapes import MOST_POINTS, DrawnMessage
from tftool.screens.browser.packing import PackedBlock
from tftool.screens.browser.protocol import since

Draw = Callable[[Any, int], DrawnMessage]

DISPLAYS: Final[dict[str, tuple[str, Draw]]] = {
    one.TYPE: (one.KIND, one.draw) for one in (point, path, cloud, scan)
}
"""By the type of a message: what kind of shape it becomes, and how."""

MOST_TOPICS: Final = 40
"""Topics that are drawn."""

MILLIMETRE: Final = 1e-3
"""To what the places of points are rounded."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of what is drawn.

    Attributes:
        points: Points of one message.
        all_points: Points of all messages of a topic together; of more messages, every second
            one, or every third.
    """

    points: int = MOST_POINTS
    all_points: int = 4_000_000


IN_A_FILE: Final = Limits(20_000, 600_000)
"""Limits of a page that is sent around."""


@dataclass(slots=True)
class DrawnTopic:
    """Messages of one topic.

    Attributes:
        topic: Its name.
        type: Type of its messages.
        kind: Shape of the drawing: "ball", "line" or "points".
        messages: In the order of their stamps.
        count: How many were recorded.
        faults: Faults of messages, each with its count.
    """

    topic: str
    type: str
    kind: str
    messages: list[DrawnMessage] = field(default_factory=list)
    count: int = 0
    faults: dict[str, int] = field(default_factory=dict)


def recorded_tracks(recording: Recording, limits: Limits) -> list[DrawnTopic]:
    """Return a recording's drawable topics."""
    found: list[DrawnTopic] = []
    for topic in recording.topics:
        name = topic.type.replace("/msg/", "/").replace("/", "/msg/", 1)
        if name in DISPLAYS and topic.count and len(found) < MOST_TOPICS:
            kind, draw = DISPLAYS[name]
            track = DrawnTopic(topic.name, name, kind, count=topic.count)
            _fill(track, recording, draw, limits)
            found.append(track)
    return found


def tracks_named(name: str, limits: Limits) -> list[DrawnTopic]:
    """Return a recording's drawable topics in their own opened file; callable from any thread."""
    with open_recording(name) as recording:
        return recorded_tracks(recording, limits)


def _fill(track: DrawnTopic, recording: Recording, draw: Draw, limits: Limits) -> None:
    every = 0
    try:
        for place, (_, message) in enumerate(recording.messages(track.topic)):
            # The first message says how large they are.
            if every and place % every:
                continue
            try:
                one = draw(message, limits.points)
            except (InputError, ValueError, TypeError) as error:
                track.faults[str(error)] = track.faults.get(str(error), 0) + 1
                every = every or 1
                continue
            every = every or max(1, -(-track.count * max(1, len(one.places)) // limits.all_points))
            track.messages.append(one)
    except InputError as error:
        track.faults[str(error)] = track.faults.get(str(error), 0) + 1
    track.messages.sort(key=lambda one: one.stamp)


def pack_tracks(
    block: PackedBlock, tracks: Sequence[DrawnTopic], buffer: Buffer, epoch: Stamp
) -> list[dict[str, Any]]:
    """Pack topics into a block; return their header.

    Each message has the pose of its frame at its own stamp, in the root of its tree.
    """
    return [
        {
            "topic": track.topic,
            "type": track.type,
            "kind": track.kind,
            "count": track.count,
            "faults": [f"{text} ({count} messages)" for text, count in track.faults.items()],
            "messages": [_packed(block, one, buffer, epoch) for one in track.messages],
        }
        for track in tracks
    ]


def _packed(block: PackedBlock, one: DrawnMessage, buffer: Buffer, epoch: Stamp) -> dict[str, Any]:
    wholes = np.rint(one.places.astype(np.float64) / MILLIMETRE).astype(np.int64)
    root, pose = _placed(one, buffer)
    return {
        "stamp": since(epoch, one.stamp),
        "frame": one.frame,
        "root": root,
        "pose": pose,
        "count": len(wholes),
        "places": [block.wholes(wholes[:, axis], MILLIMETRE) for axis in range(3)],
    }


def _placed(one: DrawnMessage, buffer: Buffer) -> tuple[str | None, list[float] | None]:
    """Return the root above a message's frame at its stamp, and the frame's pose in it."""
    root: str = one.frame
    try:
        for _ in range(len(buffer.frames())):
            parent = buffer.parent(root, one.stamp)
            if parent is None:
                break
            root = parent
        pose = buffer.lookup_transform(root, one.frame, one.stamp).transform
    except TransformException:
        return None, None
    return root, [*pose.translation, *pose.rotation]
