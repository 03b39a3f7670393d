"""One topic of a world and the same topic of everybody else, joined."""

from collections.abc import Callable
from typing import Any, Final

from tftool.errors import MalformedMessage
from tftool.frames.sample import TransformStamped
from tftool.link import keys
from tftool.link.cdr import decode_transforms, encode_transforms
from tftool.link.membership import Membership
from tftool.link.transport import Arrived, Outlet
from tftool.link.types import TRANSFORMS, MessageType
from tftool.messages import Color
from tftool.runtime.topics import Topic
from tftool.runtime.world import TransformMessage
from tftool.stamps import as_seconds, seconds

DEPTH: Final = 7
"""turtlesim's depth of its topics."""

TF_DEPTH: Final = 100
"""tf2's depth of /tf."""

YEAR: Final = seconds(365.25 * 24 * 3600)

_NO_SENDER = bytes(16)


class Sender:
    """Who publishes one topic under one name: an outlet, a token, a running number."""

    def __init__(
        self, link: Membership, node: str, name: str, ros_type: str, depth: int, *, latched: bool
    ) -> None:
        entity = link.entity(keys.PUBLISHER, node, name, ros_type, depth=depth, latched=latched)
        self.gid = keys.gid_of(entity.token())
        self._link = link
        self._sequence = 0
        # The latched one of a name keeps its own last message, so each sender has its own.
        self._outlet: Outlet = link.publisher(name, ros_type, latched=latched)
        self._hide = link.show(entity)

    def put(self, payload: bytes) -> None:
        """Send one message."""
        self._sequence += 1
        self._outlet.put(payload, self._link.attachment(self._sequence, self.gid))

    def close(self) -> None:
        """Send no more."""
        self._hide()
        self._outlet.close()


class TopicBridge:
    """A topic whose values are messages of their own: poses, commands, colours."""

    def __init__(self, link: Membership, topic: Topic[Any], kind: MessageType) -> None:
        self._link = link
        self._topic = topic
        self._kind = kind
        self._sender: Sender | None = None
        self._stop_out: Callable[[], None] | None = None
        self._stop_in: Callable[[], None] | None = None
        self._inbound: Any = None
        topic.on_demand = self.refresh
        self.refresh()

    def refresh(self) -> None:
        """Listen where somebody wants to hear: here for others, there for us."""
        # Nobody computes colours while nobody looks, so colours wait to be asked for.
        name = self._topic.name
        out = not self._link.options.read_only and (
            self._topic.kind is not Color
            or bool(self._link.graph.entities(keys.SUBSCRIBER, name=name))
        )
        if out and self._stop_out is None:
            # Set first: subscribing calls this again.
            self._stop_out = _nothing
            self._stop_out = self._topic.subscribe(self._publish)
        elif not out and self._stop_out is not None:
            stop, self._stop_out = self._stop_out, None
            stop()
        listeners = self._topic.subscribers - (self._stop_out is not None)
        if listeners > 0 and self._stop_in is None:
            self._stop_in = self._listen()
        elif listeners <= 0 and self._stop_in is not None:
            stop, self._stop_in = self._stop_in, None
            stop()

    def close(self) -> None:
        """Neither send nor listen any more."""
        self._topic.on_demand = None
        for stop in (self._stop_out, self._stop_in):
            if stop is not None:
                stop()
        if self._sender is not None:
            self._sender.close()

    def _listen(self) -> Callable[[], None]:
        link, name, ros_type = self._link, self._topic.name, self._kind.ros_type
        entity = link.entity(keys.SUBSCRIBER, link.main_node, name, ros_type, depth=DEPTH)
        key = keys.any_hash_key(link.options.domain, name, ros_type)
        # The token goes after: whoever sees it may send at once and is heard.
        stop = link.wire.subscriber(key, self._arrived)
        hide = link.show(entity)

        def both() -> None:
            hide()
            stop()

        return both

    def _publish(self, value: Any) -> None:
        if value is self._inbound:
            return
        if self._sender is None:
            self._sender = Sender(
                self._link,
                self._link.main_node,
                self._topic.name,
                self._kind.ros_type,
                DEPTH,
                latched=False,
            )
        try:
            self._sender.put(self._kind.encode(value))
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)

    def _arrived(self, message: Arrived) -> None:
        try:
            value = self._kind.decode(message.payload)
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)
            return
        self._link.received += 1
        self._inbound = value
        try:
            self._topic.publish(value)
        finally:
            self._inbound = None


class TransformBridge:
    """`tf`: transforms of many nodes, each of them a publisher of its own."""

    latched = False
    depth = TF_DEPTH

    def __init__(self, link: Membership, topic: Topic[TransformMessage]) -> None:
        self._link = link
        self._topic = topic
        self._senders: dict[str, Sender] = {}
        self._inbound: TransformMessage | None = None
        self._stops = [topic.subscribe(self._publish)]
        key = keys.any_hash_key(link.options.domain, topic.name, TRANSFORMS)
        self._stops.append(link.wire.subscriber(key, self._arrived, latched=self.latched))
        entity = link.entity(
            keys.SUBSCRIBER, link.main_node, topic.name, TRANSFORMS, depth=TF_DEPTH
        )
        self._stops.append(link.show(entity))

    def refresh(self) -> None:
        """The buffer always listens."""

    def close(self) -> None:
        """Neither send nor listen any more."""
        for stop in self._stops:
            stop()
        for sender in self._senders.values():
            sender.close()

    def _publish(self, message: TransformMessage) -> None:
        if message is self._inbound or self._link.options.read_only:
            return
        sender = self._senders.get(message.authority)
        if sender is None:
            sender = self._senders[message.authority] = Sender(
                self._link,
                message.authority,
                self._topic.name,
                TRANSFORMS,
                self.depth,
                latched=self.latched,
            )
        try:
            sender.put(encode_transforms(message.transforms))
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)

    def _arrived(self, message: Arrived) -> None:
        link = self._link
        try:
            transforms = decode_transforms(message.payload)
            gid = keys.parse_attachment(message.attachment).gid if message.attachment else None
        except MalformedMessage as refusal:
            link.refuse(self._topic.name, refusal)
            return
        link.received += 1
        authority = link.authority(gid or _NO_SENDER, self._topic.name)
        accepted = self._store(transforms, authority)
        if accepted:
            self._inbound = TransformMessage(accepted, authority)
            try:
                self._topic.publish(self._inbound)
            finally:
                self._inbound = None

    def _store(
        self, transforms: tuple[TransformStamped, ...], authority: str
    ) -> tuple[TransformStamped, ...]:
        if transforms:
            self._compare_clocks(transforms[0], authority)
        store = self._link.world.buffer.set_transform
        return tuple(one for one in transforms if store(one, authority))

    def _compare_clocks(self, sample: TransformStamped, authority: str) -> None:
        ahead = sample.stamp - self._link.world.clock.now()
        if -YEAR < ahead < YEAR:
            return
        self._link.say_once(
            f"clock {authority}",
            f"'{authority}' stamps its transforms {as_seconds(abs(ahead)) / as_seconds(YEAR):.1f} "
            f"years {'after' if ahead > 0 else 'before'} this machine's clock: ages and waits "
            "mean little until both clocks agree (or one of them is simulated).",
        )


class StaticBridge(TransformBridge):
    """`tf_static`: who comes later gets all statics of everybody who is there."""

    latched = True
    depth = 1

    def _store(
        self, transforms: tuple[TransformStamped, ...], authority: str
    ) -> tuple[TransformStamped, ...]:
        store = self._link.world.buffer.set_transform_static
        return tuple(one for one in transforms if store(one, authority))


def _nothing() -> None:
    """Stop nothing."""
