"""Drawable messages of a recording, topic by topic and within limits."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError, TransformException
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer
from tftool.recordings.recording import Recording, open_recording
from tftool.screens.browser import displays
from tftool.screens.browser.displays import markers
from tftool.screens.browser.displays.shapes import MOST_POINTS, Arrival, DrawnMessage, Shape
from tftool.screens.browser.packing import PackedBlock
from tftool.screens.browser.protocol import since

Draw = Callable[[Any, Arrival], DrawnMessage]

DISPLAYS: Final[dict[str, Draw]] = {
    name: one.draw
    for module in iter_modules(displays.__path__, f"{displays.__name__}.")
    for one in [import_module(module.name)]
    for name in getattr(one, "TYPES", ())
}
"""By the type of a message: how it is drawn, by the file in `displays/` that names the type."""

ACCUMULATED: Final = frozenset(markers.TYPES)
"""Types whose messages change what the ones before them showed: every message is drawn."""

MOST_TOPICS: Final = 40
"""Topics that are drawn."""

_MOST_FAULTS: Final = 10

MILLIMETRE: Final = 1e-3
"""To what the places of clouds are rounded; those of other shapes to a hundredth of it."""


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
        topic: Name.
        type: Type of its messages.
        messages: In the order of their stamps.
        count: Number of were recorded.
        faults: Faults of messages, each with its count.
    """

    topic: str
    type: str
    messages: list[DrawnMessage] = field(default_factory=list)
    count: int = 0
    faults: dict[str, int] = field(default_factory=dict)

    def note(self, fault: str) -> None:
        """Count a fault; of many different ones the first."""
        if fault in self.faults or len(self.faults) < _MOST_FAULTS:
            self.faults[fault] = self.faults.get(fault, 0) + 1


def recorded_tracks(recording: Recording, limits: Limits) -> list[DrawnTopic]:
    """Return a recording's drawable topics."""
    found: list[DrawnTopic] = []
    for topic in recording.topics:
        name = topic.type.replace("/msg/", "/").replace("/", "/msg/", 1)
        if name in DISPLAYS and topic.count and len(found) < MOST_TOPICS:
            track = DrawnTopic(topic.name, name, count=topic.count)
            _fill(track, recording, limits)
            found.append(track)
    return found


def tracks_named(name: str, limits: Limits) -> list[DrawnTopic]:
    """Return a recording's drawable topics in their own opened file; callable from any thread."""
    with open_recording(name) as recording:
        return recorded_tracks(recording, limits)


def _fill(track: DrawnTopic, recording: Recording, limits: Limits) -> None:
    draw, every = DISPLAYS[track.type], 0
    last = None
    try:
        for place, (received, message) in enumerate(recording.messages(track.topic)):
            # The first message says how large they are.
            is_kept = not every or place % every == 0
            if not is_kept and track.type not in ACCUMULATED:
                continue
            try:
                last = draw(message, Arrival(received, limits.points, last))
            except (InputError, ValueError, TypeError) as error:
                track.note(str(error))
                every = every or 1
                continue
            for fault in last.faults:
                track.note(fault)
            every = every or max(1, -(-track.count * max(1, last.count) // limits.all_points))
            if is_kept:
                track.messages.append(last)
    except InputError as error:
        track.note(str(error))
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
            "count": track.count,
            "faults": [f"{text} ({count} messages)" for text, count in track.faults.items()],
            "messages": [_packed(block, one, buffer, epoch) for one in track.messages],
        }
        for track in tracks
    ]


def _packed(block: PackedBlock, one: DrawnMessage, buffer: Buffer, epoch: Stamp) -> dict[str, Any]:
    return {
        "stamp": since(epoch, one.stamp),
        "shapes": [_packed_shape(block, shape, buffer, epoch) for shape in one.shapes],
    }


def _packed_shape(block: PackedBlock, shape: Shape, buffer: Buffer, epoch: Stamp) -> dict[str, Any]:
    step = MILLIMETRE if shape.kind == "points" else MILLIMETRE / 100.0
    places = np.rint(shape.places.astype(np.float64) / step).astype(np.int64)
    root, pose = place(shape, buffer).placement or (None, None)
    packed: dict[str, Any] = {
        "kind": shape.kind,
        "frame": shape.frame,
        "root": root,
        "pose": pose,
        "count": len(places),
        "places": [block.wholes(places[:, axis], step) for axis in range(3)],
    }
    if shape.colors is not None:
        shares = shape.colors.astype(np.int64)
        packed["colors"] = [block.wholes(shares[:, part]) for part in range(4)]
        packed |= {"turn": [*shape.turn], "size": [*shape.size], "text": shape.text}
    if shape.until is not None:
        packed["until"] = since(epoch, shape.until)
    return packed


def place(shape: Shape, buffer: Buffer) -> Shape:
    """Return the shape with the pose of its frame at its stamp, looked up once."""
    if shape.placement is not None:
        return shape
    unknown = replace(shape, placement=(None, None))
    if shape.stamp is None:
        return unknown
    root: str = shape.frame
    try:
        for _ in range(len(buffer.frames())):
            parent = buffer.parent(root, shape.stamp)
            if parent is None:
                break
            root = parent
        pose = buffer.lookup_transform(root, shape.frame, shape.stamp).transform
    except TransformException:
        return unknown
    return replace(shape, placement=(root, [*pose.translation, *pose.rotation]))
