"""Messages to draw in addition to frames, from a recording or a session, with limits."""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Final

import numpy as np

from tftool.base.errors import InputError, TftoolError, TransformException
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer
from tftool.messages.classes import INTERFACES
from tftool.recordings.recording import Recording, open_recording
from tftool.screens.browser import displays
from tftool.screens.browser.displays import markers
from tftool.screens.browser.displays.shapes import MOST_POINTS, Arrival, DrawnMessage, Shape
from tftool.screens.browser.packing import PackedBlock
from tftool.screens.browser.protocol import since
from tftool.world.endpoints import PUBLISHER, USUAL, Endpoint, Quality
from tftool.world.world import World

Draw = Callable[[Any, Arrival], DrawnMessage]

DISPLAYS: Final[dict[str, Draw]] = {
    name: one.draw
    for module in iter_modules(displays.__path__, f"{displays.__name__}.")
    for one in [import_module(module.name)]
    for name in getattr(one, "TYPES", ())
}
"""Function that draws each type of message, from the file in `displays/` that names the type."""

ACCUMULATED: Final = frozenset(markers.TYPES)
"""Types whose messages change what earlier ones showed, so that every message must be drawn."""

MOST_TOPICS: Final = 40
"""Largest number of topics that are drawn."""

_MOST_FAULTS: Final = 10

MILLIMETRE: Final = 1e-3
"""Step in metres to which points of clouds are rounded; other positions to a hundredth of it."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits on the messages that are drawn.

    Attributes:
        points: Largest number of points of one message.
        all_points: Largest number of points of all messages of a topic; above this number, only
            every second, third, … message is drawn.
    """

    points: int = MOST_POINTS
    all_points: int = 4_000_000


IN_A_FILE: Final = Limits(20_000, 600_000)
"""Limits for a page that is saved as a file."""


@dataclass(slots=True)
class DrawnTopic:
    """Messages of one topic, as shapes to draw.

    Attributes:
        topic: Name of the topic.
        type: Type of the messages.
        messages: Messages in the order of their stamps.
        count: Number of recorded or received messages.
        faults: Reasons why messages are not drawn, each with the number of messages.
    """

    topic: str
    type: str
    messages: list[DrawnMessage] = field(default_factory=list)
    count: int = 0
    faults: dict[str, int] = field(default_factory=dict)

    def note(self, fault: str) -> None:
        """Count a fault; of many different faults, only the first are stored."""
        if fault in self.faults or len(self.faults) < _MOST_FAULTS:
            self.faults[fault] = self.faults.get(fault, 0) + 1


def recorded_tracks(recording: Recording, limits: Limits) -> list[DrawnTopic]:
    """Return the drawable topics of a recording, with their messages as shapes."""
    found: list[DrawnTopic] = []
    for topic in recording.topics:
        name = topic.type.replace("/msg/", "/").replace("/", "/msg/", 1)
        if name in DISPLAYS and topic.count and len(found) < MOST_TOPICS:
            track = DrawnTopic(topic.name, name, count=topic.count)
            _fill(track, recording, limits)
            found.append(track)
    return found


def tracks_named(name: str, limits: Limits) -> list[DrawnTopic]:
    """Open the recording `name`, and return the drawable topics; callable from any thread."""
    with open_recording(name) as recording:
        return recorded_tracks(recording, limits)


def _fill(track: DrawnTopic, recording: Recording, limits: Limits) -> None:
    draw, every = DISPLAYS[track.type], 0
    last = None
    try:
        for place, (received, message) in enumerate(recording.messages(track.topic)):
            # `every` is computed from the size of the first message.
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
    """Append messages of topics to a block of packed data; return a header for each topic.

    Each shape gets the pose of its frame at its stamp, in the root of the frame's tree.
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
    """Return a copy of a shape with `placement`, the pose of the shape's frame at the stamp.

    A shape that already has a placement is returned unchanged.
    """
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


PATIENCE: Final = 5
"""Rounds for which a message waits until its frame's transform at its stamp is known."""

MOST_BYTES: Final = 6_000_000
"""Bytes of a round after which no further message is added; 200 000 points have 4.8 MB."""

MOST_HELD: Final = 1000
"""Largest number of one topic's messages that wait to be drawn; a further one drops the oldest."""


@dataclass(slots=True)
class _HeardTopic:
    """Topic of a running session that the page draws, with its subscription.

    Attributes:
        drawn: Last message, as shapes for the page.
        quality: Quality of service of the subscription.
        stop: Function that ends the subscription.
        held: Received messages not yet converted to shapes, with their times of arrival. Only the
            last message is stored, except for types such as MarkerArray, whose messages change
            earlier shapes.
        waiting: Last message, until the poses of its shapes are known; otherwise None.
        rounds: Number of calls of `LiveDisplays.round` since `waiting` was set.
        is_news: Whether there is a fault that was not reported to the page yet.
        block: Last packed data sent to pages.
    """

    drawn: DrawnTopic
    quality: Quality
    stop: Callable[[], None]
    held: deque[tuple[Stamp, Any]]
    waiting: DrawnMessage | None = None
    rounds: int = 0
    is_news: bool = False
    block: bytes = b""


class LiveDisplays:
    """Subscriptions to all drawable topics of a world, including topics that appear later."""

    def __init__(self, world: World, limits: Limits = Limits()) -> None:
        """Subscribe to the drawable topics of `world`."""
        self._world = world
        self._limits = limits
        self._heard: dict[str, _HeardTopic] = {}
        self._refused: set[str] = set()
        self._stop_watching = world.watch(self._look, "view")
        self._look()

    def close(self) -> None:
        """End all subscriptions."""
        self._stop_watching()
        for one in self._heard.values():
            one.stop()
        self._heard.clear()

    @property
    def blocks(self) -> dict[str, bytes]:
        """Packed last message of every topic, for a newly opened page."""
        return {topic: one.block for topic, one in self._heard.items() if one.block}

    def latest(self, most: int) -> list[DrawnTopic]:
        """Return the last message of every topic, thinned to at most `most` points."""
        found: list[DrawnTopic] = []
        for one in self._heard.values():
            self._draw(one)
            last = [one.waiting] if one.waiting is not None else one.drawn.messages
            kept = [each.thinned(most) for each in last]
            found.append(replace(one.drawn, messages=kept, faults=dict(one.drawn.faults)))
        return found

    def round(self) -> dict[str, bytes]:
        """Return the packed data of topics with new messages, by topic.

        The packed data is limited to `MOST_BYTES`. The next call begins with the topics beyond
        the limit.
        """
        told: dict[str, bytes] = {}
        room = MOST_BYTES
        for topic in tuple(self._heard):
            if room <= 0:
                break
            one = self._heard[topic]
            if self._is_due(one):
                told[topic] = one.block = self._packed(one)
                room -= len(one.block)
                # Topics without room in this round are first in the next one.
                self._heard[topic] = self._heard.pop(topic)
        return told

    def _look(self) -> None:
        endpoints = self._world.endpoints
        for topic in endpoints.topics():
            offers = [one for one in endpoints.of(topic, PUBLISHER) if one.interface in DISPLAYS]
            if offers and topic not in self._refused:
                self._listen(topic, offers)

    def _listen(self, topic: str, offers: list[Endpoint]) -> None:
        type_name = offers[0].interface
        # A quality that every publisher offers, so that all of them are received.
        quality = Quality(
            USUAL.depth,
            is_reliable=all(one.quality.is_reliable for one in offers),
            is_latched=all(one.quality.is_latched for one in offers),
        )
        known = self._heard.get(topic)
        if known is None:
            if len(self._heard) >= MOST_TOPICS:
                return
            track = DrawnTopic(f"/{topic}", type_name)
            held: deque[tuple[Stamp, Any]] = deque(
                maxlen=MOST_HELD if type_name in ACCUMULATED else 1
            )
            known = self._heard[topic] = _HeardTopic(track, quality, _nothing, held)
        elif known.quality == quality or known.drawn.type != type_name:
            return
        heard = known
        # Set first, because subscribing calls this function again.
        heard.quality = quality
        heard.stop()

        def take(message: Any) -> None:
            heard.held.append((self._world.clock.now(), message))
            heard.drawn.count += 1

        try:
            heard.stop = self._world.subscribe(
                "view", topic, INTERFACES.message(type_name), take, quality
            )
        except TftoolError:
            # In this world, the topic has messages of another type.
            self._refused.add(topic)
            del self._heard[topic]

    def _is_due(self, topic: _HeardTopic) -> bool:
        """Process a topic's new messages; return whether the page must get new shapes or faults."""
        self._draw(topic)
        if topic.waiting is not None:
            topic.rounds += 1
            buffer = self._world.buffer
            shapes = topic.waiting.shapes
            # The buffer may have pruned the transforms of shapes that were placed before.
            new = [shape for shape in shapes if shape.placement is None]
            if topic.rounds > PATIENCE or all(_is_known(shape, buffer) for shape in new):
                placed = tuple(place(shape, buffer) for shape in shapes)
                topic.drawn.messages = [replace(topic.waiting, shapes=placed)]
                topic.waiting = None
                return True
        return topic.is_news

    def _draw(self, topic: _HeardTopic) -> None:
        """Convert a topic's new messages to shapes, unless earlier shapes still wait for poses."""
        if topic.waiting is not None or not topic.held:
            return
        topic.rounds = 0
        last = topic.drawn.messages[-1] if topic.drawn.messages else None
        while topic.held:
            stamp, message = topic.held.popleft()
            try:
                arrival = Arrival(stamp, self._limits.points, last)
                last = topic.waiting = DISPLAYS[topic.drawn.type](message, arrival)
                faults = last.faults
            except (InputError, ValueError, TypeError) as error:
                faults = (str(error),)
            for fault in faults:
                topic.drawn.note(fault)
                topic.is_news = True

    def _packed(self, topic: _HeardTopic) -> bytes:
        topic.is_news = False
        # A block for each topic, because the page discards them separately.
        block = PackedBlock()
        tracks = pack_tracks(block, [topic.drawn], self._world.buffer, self._world.clock.epoch)
        return block.plain({"tracks": tracks})


def _is_known(shape: Shape, buffer: Buffer) -> bool:
    """Return whether the buffer has the pose of a shape's frame at the shape's stamp."""
    root, frames = shape.frame, buffer.frames()
    if root not in frames or shape.stamp is None:
        return root in frames
    try:
        for _ in range(len(frames)):
            parent = buffer.parent(root)
            if parent is None:
                break
            root = parent
        buffer.lookup_transform(root, shape.frame, shape.stamp)
    except TransformException:
        return False
    return True


def _nothing() -> None:
    """Do nothing; used before there is a subscription to end."""
