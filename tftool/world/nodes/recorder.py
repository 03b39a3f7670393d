"""Recorder of the messages on a world's topics."""

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol

from tftool.base.errors import InputError, MalformedMessage
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import Message
from tftool.messages.codec import Codec, codec
from tftool.messages.transforms import encode_transforms
from tftool.recordings.channel import Channel
from tftool.recordings.decompression import best_compression
from tftool.recordings.message_conversion import TRANSFORMS, ros2_channel
from tftool.world.clock import Clock, pace_of
from tftool.world.endpoints import PUBLISHER
from tftool.world.link.seam import Arrived
from tftool.world.link.session import Link
from tftool.world.topics import Topic
from tftool.world.world import TransformMessage, World

if TYPE_CHECKING:
    from tftool.recordings.rolling_writer import RollingRecording

FRAMES: Final = ("tf", "tf_static")
"""Names of the topics that are always recorded."""


class Taker(Protocol):
    """Protocol of an object that receives every recorded message, such as a file writer."""

    def take(self, channel: Channel, log_time: int, payload: bytes, transforms: int = 0) -> None:
        """Store one received message, which contains `transforms` transforms."""


class Recorder:
    """Recorder of a world's topics; received messages of other processes are stored unchanged.

    Attributes:
        topics: Names of the topics that the recorder has subscribed to so far.
        left_out: Reason for each topic that cannot be recorded, by name.
    """

    def __init__(
        self,
        world: World,
        taker: Taker,
        *,
        link: Link | None = None,
        names: Collection[str] = (),
        everything: bool = False,
        clock: Clock | None = None,
    ) -> None:
        """Subscribe to the transforms; `refresh` subscribes to the other topics.

        Args:
            world: World whose topics are recorded.
            taker: Receiver of every message.
            link: Connection to the session that the world has joined; None for a world without
                other processes.
            names: Further topics to record, without a leading slash.
            everything: Whether to record all topics.
            clock: Clock that gives the log time of a message; None for `pace_of(world.clock)`.
        """
        self._world = world
        self._taker = taker
        self._link = link
        self._names = frozenset(name.strip("/") for name in names)
        self._everything = everything
        self._clock = clock or pace_of(world.clock)
        self._stops: list[Callable[[], object]] = []
        self._channels: dict[tuple[str, str, str], Channel] = {}
        self._failure: Exception | None = None
        self._inner: set[str] = set()  # topics that only this process has
        self.topics: set[str] = set()
        self.left_out: dict[str, str] = {}
        if link is None:
            self._begin_here()
            self._stops.append(world.watch(self._find_topics, "recorder"))
        else:
            for name in FRAMES:
                self._listen(link, name, TRANSFORMS, is_latched=name == "tf_static")
        self.refresh()

    def refresh(self) -> None:
        """Subscribe to topics that are new; call this regularly.

        Raises:
            InputError: If an earlier message could not be written.
        """
        if self._failure is not None:
            raise self._failure
        self._find_topics()

    def _find_topics(self) -> None:
        if self._link is not None:
            for entity in self._link.graph.entities(PUBLISHER):
                if self._is_wanted(entity.name):
                    latched = entity.quality.is_latched
                    self._listen(self._link, entity.name, entity.ros_type, is_latched=latched)
            return
        for name, topic in tuple(self._world.topics().items()):
            if self._is_wanted(name):
                self._subscribe(name, topic)

    @property
    def missing(self) -> list[str]:
        """Names of the requested topics that do not exist yet."""
        return sorted(self._names - self.topics - set(self.left_out))

    def close(self) -> None:
        """End all subscriptions."""
        for stop in self._stops:
            stop()
        self._stops.clear()

    def _is_wanted(self, name: str) -> bool:
        if name in self.topics or name in self.left_out or name in self._inner:
            return False
        return self._everything or name in self._names

    # Topics of this process's world

    def _begin_here(self) -> None:
        world = self._world
        by_node: dict[str, list[TransformStamped]] = {}
        authorities = {
            one.frame: one.authority or ""
            for one in world.buffer.snapshot(world.clock.now()).frames
        }
        for sample in world.static_transforms():
            by_node.setdefault(authorities.get(sample.child_frame_id, ""), []).append(sample)
        for node, samples in by_node.items():
            self._put_transforms("tf_static", TransformMessage(tuple(samples), node))
        for name, topic in zip(FRAMES, (world.tf, world.tf_static), strict=True):
            self.topics.add(name)
            self._stops.append(topic.subscribe(partial(self._transforms, name), "recorder"))

    def _transforms(self, name: str, message: TransformMessage) -> None:
        self._guarded(lambda: self._put_transforms(name, message))

    def _put_transforms(self, name: str, message: TransformMessage) -> None:
        channel = self._channel(name, TRANSFORMS, message.authority)
        payload = encode_transforms(message.transforms)
        self._taker.take(channel, self._clock.now(), payload, len(message.transforms))

    def _subscribe(self, name: str, topic: Topic[Any]) -> None:
        try:
            if not issubclass(topic.kind, Message):
                if name not in self._names:
                    self._inner.add(name)
                    return
                raise InputError(
                    "its values are no ROS messages, so other processes cannot receive them"
                )
            channel = self._channel(name, topic.kind.interface__, "")
            writer = codec(topic.kind)
        except InputError as error:
            self.left_out[name] = str(error).rstrip(".")
            return
        self.topics.add(name)
        self._stops.append(topic.subscribe(partial(self._value, channel, writer), "recorder"))

    def _value(self, channel: Channel, kind: Codec, value: Any) -> None:
        def put() -> None:
            try:
                payload = kind.encode(value)
            except MalformedMessage as error:
                self.left_out.setdefault(channel.topic.strip("/"), str(error))
                return
            self._taker.take(channel, self._clock.now(), payload)

        self._guarded(put)

    # Topics of a joined session

    def _listen(self, link: Link, name: str, ros_type: str, *, is_latched: bool) -> None:
        try:
            self._channel(name, ros_type, "")
            stop = link.middleware.listen(
                name, ros_type, partial(self._arrived, link, name, ros_type), is_latched=is_latched
            )
        except InputError as error:
            self.left_out[name] = str(error).rstrip(".")
            return
        self.topics.add(name)
        self._stops.append(stop)

    def _arrived(self, link: Link, name: str, ros_type: str, message: Arrived) -> None:
        def put() -> None:
            node = link.authority(message.sender, name)
            channel = self._channel(name, ros_type, node)
            payload = message.payload
            count = 0
            if ros_type == TRANSFORMS and len(payload) >= 8:
                count = int.from_bytes(payload[4:8], "little")
            self._taker.take(channel, self._clock.now(), payload, count)

        self._guarded(put)

    def _guarded(self, put: Callable[[], None]) -> None:
        """Call `put`; store its InputError, if any, until the next `refresh` raises the error."""
        if self._failure is not None:
            return
        try:
            put()
        except InputError as error:
            self._failure = error

    def _channel(self, name: str, ros_type: str, node: str) -> Channel:
        """Return the channel of a topic and a publishing node; each pair has one channel."""
        key = name, ros_type, node
        found = self._channels.get(key)
        if found is None:
            plain = ros2_channel(f"/{name}", ros_type, static=name == "tf_static")
            metadata = plain.metadata
            if node:
                metadata += (("callerid", f"/{node.strip('/')}"),)
            found = self._channels[key] = Channel(
                plain.topic,
                plain.type,
                plain.encoding,
                plain.schema_encoding,
                plain.definition,
                metadata,
            )
        return found


@contextmanager
def recorded(world: World, path: Path, *, force: bool = False) -> "Iterator[RollingRecording]":
    """Record all topics of this process's world into a file while the block runs.

    Raises:
        UsageError: If the file exists and `force` is false.
        InputError: If the file cannot be written.
    """
    # Imported here, because writers import numpy, which a demo without recording avoids.
    from tftool.recordings.rolling_writer import RollingRecording

    rolling = RollingRecording(path, compression=best_compression(), force=force)
    recorder = Recorder(world, rolling, everything=True)
    try:
        yield rolling
        recorder.refresh()
    finally:
        recorder.close()
        rolling.close()
