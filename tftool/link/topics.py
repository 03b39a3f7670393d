"""One topic of a world and the same topic of everybody else, joined."""

from collections.abc import Callable
from typing import Any, Final

from tftool.errors import MalformedMessage
from tftool.link import keys
from tftool.link.membership import Membership
from tftool.link.transport import Arrived
from tftool.link.types import MessageType
from tftool.runtime.endpoints import PUBLISHER, SUBSCRIPTION, Endpoint, Quality
from tftool.runtime.topics import Topic

USUAL: Final = Quality(depth=7)
"""What turtlesim offers; ours for whoever states nothing."""


class Sender:
    """Who publishes one topic under one name: an outlet, a token, a running number."""

    def __init__(
        self, link: Membership, node: str, name: str, ros_type: str, quality: Quality
    ) -> None:
        entity = link.entity(keys.PUBLISHER, node, name, ros_type, quality)
        self.gid = keys.gid_of(entity.token())
        self._link = link
        self._sequence = 0
        # The latched one of a name keeps its own last messages, so each sender has its own.
        self._outlet = link.publisher(name, ros_type, quality)
        self._hide = link.show(entity)

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach anybody, now or later."""
        return self._outlet.is_wanted

    def put(self, payload: bytes) -> None:
        """Send one message."""
        self._sequence += 1
        self._outlet.put(payload, self._link.attachment(self._sequence, self.gid))

    def close(self) -> None:
        """Send no more."""
        self._hide()
        self._outlet.close()


class TopicBridge:
    """A topic whose values are messages of their own.

    Nodes that state what they publish and subscribe, and with what quality, are shown one
    by one; all others together as the first node of the world. What comes in is taken once
    for all, except by latched subscriptions: each is sent what was there before it.
    """

    def __init__(self, link: Membership, topic: Topic[Any], kind: MessageType) -> None:
        self._link = link
        self._topic = topic
        self._kind = kind
        self._senders: dict[Endpoint | None, Sender] = {}
        self._subscriptions: dict[Endpoint | None, Callable[[], None]] = {}
        self._stop_in: Callable[[], None] | None = None
        self._inbound: Any = None
        topic.on_demand = self.refresh
        if not link.options.read_only:
            topic.relay = self._send
        self.refresh()

    def refresh(self) -> None:
        """Show what there is, and listen where somebody here wants to hear."""
        topic, endpoints = self._topic, self._link.world.endpoints
        # Nobody computes colours while nobody looks: whoever does is counted.
        topic.far_subscribers = sum(
            one.ros_type == self._kind.ros_type
            for one in self._link.graph.entities(keys.SUBSCRIBER, name=topic.name)
        )
        publishers = _here(endpoints.of(topic.name, PUBLISHER))
        for gone in self._senders.keys() - {None, *publishers}:
            self._senders.pop(gone).close()
        if not self._link.options.read_only:
            for one in publishers:
                if one not in self._senders:
                    self._senders[one] = self._sender(one)
                    # What it kept before there was a link is for those who come late, too.
                    for value in one.kept or ():
                        self._put(self._senders[one], value)

        subscriptions = _here(endpoints.of(topic.name, SUBSCRIPTION))
        latched = sum(one.deliver is not None for one in subscriptions)
        if topic.near_subscribers > latched:
            self._stop_in = self._stop_in or self._listen(self._arrived)
        elif self._stop_in is not None:
            self._stop_in()
            self._stop_in = None
        shown: set[Endpoint | None] = set(subscriptions)
        if topic.near_subscribers > len(subscriptions):
            shown.add(None)
        for gone in self._subscriptions.keys() - shown:
            self._subscriptions.pop(gone)()
        for new in shown - self._subscriptions.keys():
            self._subscriptions[new] = self._subscribe(new)

    def close(self) -> None:
        """Neither send nor listen any more."""
        self._topic.on_demand = self._topic.relay = None
        self._topic.far_subscribers = 0
        for stop in (self._stop_in, *self._subscriptions.values()):
            if stop is not None:
                stop()
        for sender in self._senders.values():
            sender.close()

    # In

    def _subscribe(self, stated: Endpoint | None) -> Callable[[], None]:
        """Show a subscription, and ask for what was sent before if it is latched."""
        link, name, ros_type = self._link, self._topic.name, self._kind.ros_type
        node = link.main_node if stated is None else stated.node
        quality = USUAL if stated is None else stated.quality
        entity = link.entity(keys.SUBSCRIBER, node, name, ros_type, quality)
        deliver = None if stated is None else stated.deliver
        if deliver is None:
            return link.show(entity)
        hand_over = deliver

        def arrived(message: Arrived) -> None:
            read = self._read(message)
            if read is not None:
                hand_over(*read)

        # The token goes after: whoever sees it may send at once and is heard.
        stop = self._listen(arrived, latched=True)
        hide = link.show(entity)

        def both() -> None:
            hide()
            stop()

        return both

    def _listen(
        self, arrived: Callable[[Arrived], object], *, latched: bool = False
    ) -> Callable[[], None]:
        key = keys.any_hash_key(self._link.options.domain, self._topic.name, self._kind.ros_type)
        return self._link.wire.subscriber(key, arrived, latched=latched)

    def _arrived(self, message: Arrived) -> None:
        read = self._read(message)
        if read is None:
            return
        self._inbound, sender = read
        try:
            self._topic.publish(self._inbound, sender)
        finally:
            self._inbound = None

    def _read(self, message: Arrived) -> tuple[Any, Endpoint | None] | None:
        """What a message says and who sent it; None for one that is refused."""
        try:
            value = self._kind.decode(message.payload)
            beside = keys.parse_attachment(message.attachment) if message.attachment else None
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)
            return None
        self._link.received += 1
        name = self._topic.name
        return value, None if beside is None else self._link.endpoint(beside.gid, name)

    # Out

    def _send(self, value: Any) -> None:
        if value is self._inbound:
            return
        stated = self._topic.sender
        sender = self._senders.get(stated)
        if sender is None:
            sender = self._senders[stated] = self._sender(stated)
        # Nothing is turned into bytes for nobody.
        if sender.is_wanted:
            self._put(sender, value)

    def _put(self, sender: Sender, value: Any) -> None:
        try:
            sender.put(self._kind.encode(value))
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)

    def _sender(self, stated: Endpoint | None) -> Sender:
        node = self._link.main_node if stated is None else stated.node
        quality = USUAL if stated is None else stated.quality
        return Sender(self._link, node, self._topic.name, self._kind.ros_type, quality)


def _here(endpoints: list[Endpoint]) -> list[Endpoint]:
    return [one for one in endpoints if not one.is_remote]
