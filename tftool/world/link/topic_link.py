"""One topic of a world, joined with the same topic of the other processes."""

from collections.abc import Callable
from typing import Any

from tftool.base.errors import MalformedMessage
from tftool.messages.codec import codec
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, USUAL, Endpoint
from tftool.world.link.link_context import LinkContext
from tftool.world.link.seam import Arrived, WirePublisher
from tftool.world.topics import Topic


class TopicBridge:
    """A topic of messages.

    Nodes that state what they publish and subscribe, and with what quality, are shown one
    by one; all others together as the first node of the world. What comes in is taken once
    for all, except by latched subscriptions: each is sent what was there before it.
    """

    def __init__(self, link: LinkContext, topic: Topic[Any]) -> None:
        """Carry a topic of messages.

        Raises:
            MalformedMessage: If the bytes of such messages differ between ROS 2 releases.
        """
        self._link = link
        self._topic = topic
        self._type = topic.kind.interface__
        self._codec = codec(topic.kind)
        self._senders: dict[Endpoint | None, WirePublisher] = {}
        self._subscriptions: dict[Endpoint | None, Callable[[], None]] = {}
        self._stop_in: Callable[[], None] | None = None
        self._inbound: Any = None
        topic.on_demand = self.refresh
        if not link.options.read_only:
            topic.relay = self._send
        self.refresh()

    def refresh(self) -> None:
        """Show what there is, and listen where a subscriber here needs it."""
        topic, endpoints = self._topic, self._link.world.endpoints
        # The simulator computes colours only while a subscriber is counted.
        topic.far_subscribers = sum(
            one.ros_type == self._type
            for one in self._link.graph.entities(SUBSCRIPTION, name=topic.name)
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
        link, name, ros_type = self._link, self._topic.name, self._type
        node = link.main_node if stated is None else stated.node
        quality = USUAL if stated is None else stated.quality
        deliver = None if stated is None else stated.deliver
        if deliver is None:
            return link.middleware.subscription(node, name, ros_type, quality)
        hand_over = deliver

        def arrived(message: Arrived) -> None:
            read = self._read(message)
            if read is not None:
                hand_over(*read)

        # Shown last: what sees it may send at once and is heard.
        stop = self._listen(arrived, is_latched=True)
        hide = link.middleware.subscription(node, name, ros_type, quality)

        def both() -> None:
            hide()
            stop()

        return both

    def _listen(
        self, arrived: Callable[[Arrived], object], *, is_latched: bool = False
    ) -> Callable[[], None]:
        return self._link.middleware.listen(
            self._topic.name, self._type, arrived, is_latched=is_latched
        )

    def _arrived(self, message: Arrived) -> None:
        read = self._read(message)
        if read is None:
            return
        self._inbound, sender = read
        try:
            self._topic.publish(self._inbound, sender)
        finally:
            self._inbound = None

    def _read(self, message: Arrived) -> tuple[Any, Endpoint] | None:
        """What a message says and who sent it; None for one that is refused."""
        try:
            value = self._codec.decode(message.payload)
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)
            return None
        self._link.received += 1
        return value, self._link.endpoint(message.sender, self._topic.name, self._type)

    # Out

    def _send(self, value: Any) -> None:
        if value is self._inbound:
            return
        stated = self._topic.sender
        sender = self._senders.get(stated)
        if sender is None:
            sender = self._senders[stated] = self._sender(stated)
        # Encoded only if a subscriber or a cache takes it.
        if sender.is_wanted:
            self._put(sender, value)

    def _put(self, sender: WirePublisher, value: Any) -> None:
        try:
            sender.put(self._codec.encode(value), self._link.now())
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)

    def _sender(self, stated: Endpoint | None) -> WirePublisher:
        node = self._link.main_node if stated is None else stated.node
        quality = USUAL if stated is None else stated.quality
        return self._link.middleware.publisher(node, self._topic.name, self._type, quality)


def _here(endpoints: list[Endpoint]) -> list[Endpoint]:
    return [one for one in endpoints if not one.is_remote]
