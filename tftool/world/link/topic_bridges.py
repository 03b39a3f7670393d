"""Bridges of a world's topics to other processes; tf and /clock have bridges of their own."""

from collections.abc import Callable
from typing import Any, Final

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds, seconds
from tftool.buffer.callbacks import FELL_BACK, Watch, must_clear
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import INTERFACES
from tftool.messages.codec import codec
from tftool.messages.transforms import decode_columns, decode_transforms, encode_transforms
from tftool.world.clock import FollowedClock
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, TF, TF_STATIC, USUAL, Endpoint
from tftool.world.link.graph import Graph
from tftool.world.link.link_context import NAME, LinkContext
from tftool.world.link.seam import Arrived, WirePublisher
from tftool.world.log import Repeats
from tftool.world.topics import Topic
from tftool.world.world import TransformMessage, World


class TopicBridge:
    """Bridge of an ordinary topic between the world and other processes.

    Nodes that declare their publishers and subscriptions, with their quality of service, are
    announced one by one. All other nodes are announced together, under the name of the world's
    first node. One receiver passes new messages to all subscriptions. Earlier messages are
    requested separately for each latched subscription.
    """

    def __init__(self, link: LinkContext, topic: Topic[Any]) -> None:
        """Create the bridge of a topic whose values are ROS messages.

        Raises:
            MalformedMessage: If the encoding of these messages depends on the ROS 2 release.
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
        """Update the announced publishers; subscribe if a node of the world subscribes."""
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
                    # Messages stored before the session was joined are also for late subscribers.
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
        """Stop sending and receiving the topic."""
        self._topic.on_demand = self._topic.relay = None
        self._topic.far_subscribers = 0
        for stop in (self._stop_in, *self._subscriptions.values()):
            if stop is not None:
                stop()
        for sender in self._senders.values():
            sender.close()

    # Incoming messages

    def _subscribe(self, declared: Endpoint | None) -> Callable[[], None]:
        """Announce a subscription of a node, or of the main node if `declared` is None.

        A latched subscription also requests earlier messages. Return a function that ends the
        subscription.
        """
        link, name, ros_type = self._link, self._topic.name, self._type
        node = link.main_node if declared is None else declared.node
        quality = USUAL if declared is None else declared.quality
        deliver = None if declared is None else declared.deliver
        if deliver is None:
            return link.middleware.subscription(node, name, ros_type, quality)
        hand_over = deliver

        def arrived(message: Arrived) -> None:
            read = self._read(message)
            if read is not None:
                hand_over(*read)

        # Shown last, because others may send as soon as they see the subscription.
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
        """Decode a message and find its sender; return None if the message is malformed."""
        try:
            value = self._codec.decode(message.payload)
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)
            return None
        self._link.received += 1
        return value, self._link.endpoint(message.sender, self._topic.name, self._type)

    # Outgoing messages

    def _send(self, value: Any) -> None:
        if value is self._inbound:
            return
        stated = self._topic.sender
        sender = self._senders.get(stated)
        if sender is None:
            sender = self._senders[stated] = self._sender(stated)
        # Encoded only if a subscriber or a cache needs the message.
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


LARGE: Final = 256 * 1024
"""Smallest size in bytes of a message whose transforms may be inserted as arrays."""

LONG: Final = 64
"""Smallest average number of samples per edge at which inserting arrays is faster."""

TRANSFORMS: Final = TransformMessage.interface__

YEAR: Final = seconds(365.25 * 24 * 3600)

AHEAD: Final = seconds(2)
"""Nanoseconds ahead of our clock from which a stamp shows that two clocks disagree."""


class TransformBridge:
    """Bridge of `tf`: transforms of many nodes, each with its own publisher."""

    quality = TF

    def __init__(self, link: LinkContext, topic: Topic[TransformMessage]) -> None:
        self._link = link
        self._topic = topic
        self._senders: dict[str, WirePublisher] = {}
        self._nodes: set[str] = set()
        self._inbound: TransformMessage | None = None
        topic.relay = self._publish
        self._stops = [
            link.middleware.listen(
                topic.name, TRANSFORMS, self._arrived, is_latched=self.quality.is_latched
            ),
            link.middleware.subscription(link.main_node, topic.name, TRANSFORMS, self.quality),
        ]
        self.refresh()

    def refresh(self) -> None:
        """Count the topic's subscribers in other processes; close publishers of departed nodes."""
        others = self._link.graph.entities(SUBSCRIPTION, name=self._topic.name)
        self._topic.far_subscribers = len(others)
        self._dismiss()

    def _dismiss(self) -> None:
        """Close the publishers of nodes that have left the world."""
        for gone in self._nodes - self._node_names():
            self._nodes.remove(gone)
            self._senders.pop(gone).close()

    def _node_names(self) -> set[str]:
        return {node.name for node in self._link.world.nodes}

    def close(self) -> None:
        """Stop sending and receiving transforms."""
        self._topic.relay = None
        self._topic.far_subscribers = 0
        for stop in self._stops:
            stop()
        for sender in self._senders.values():
            sender.close()

    def _publish(self, message: TransformMessage) -> None:
        if message is self._inbound or self._link.options.read_only:
            return
        sender = self._senders.get(message.authority)
        if sender is None:
            sender = self._senders[message.authority] = self._link.middleware.publisher(
                message.authority, self._topic.name, TRANSFORMS, self.quality
            )
            if message.authority in self._node_names():
                self._nodes.add(message.authority)
        if not sender.is_wanted:
            return
        try:
            sender.put(encode_transforms(message.transforms), self._link.now())
        except MalformedMessage as refusal:
            self._link.refuse(self._topic.name, refusal)

    def _arrived(self, message: Arrived) -> None:
        link = self._link
        authority = link.authority(message.sender, self._topic.name)
        try:
            if self._takes_paths(message.payload, authority):
                link.received += 1
                return
            transforms = decode_transforms(message.payload)
        except MalformedMessage as refusal:
            link.refuse(self._topic.name, refusal)
            return
        link.received += 1
        accepted = self._store(transforms, authority)
        if accepted:
            self._inbound = TransformMessage(accepted, authority)
            try:
                self._topic.publish(self._inbound)
            finally:
                self._inbound = None

    def _takes_paths(self, payload: bytes, authority: str) -> bool:
        """Insert a large message's transforms as one array per child; return False if not inserted.

        Raises:
            MalformedMessage: If the bytes are not transforms.
        """
        # A subscriber of the topic gets every transform as an object, so arrays save nothing.
        listened_to = self._topic.near_subscribers > 0
        if self.quality.is_latched or len(payload) < LARGE or listened_to:
            return False
        columns = decode_columns(payload)
        paths: dict[tuple[str, str], list[int]] = {}
        for row, link in enumerate(zip(columns.parents, columns.children, strict=True)):
            paths.setdefault(link, []).append(row)
        moves = len({child for _, child in paths}) < len(paths)
        if moves or len(columns) < LONG * len(paths):
            return False
        self._compare_clocks(int(columns.stamps[0]), authority)
        for (parent, child), rows in paths.items():
            self._link.world.buffer.set_transforms(
                parent,
                child,
                columns.stamps[rows],
                columns.translations[rows],
                columns.rotations[rows],
                authority,
            )
        self._link.world.memory.note(len(columns))
        return True

    def _store(
        self, transforms: tuple[TransformStamped, ...], authority: str
    ) -> tuple[TransformStamped, ...]:
        if transforms:
            self._compare_clocks(transforms[0].stamp, authority)
        store = self._link.world.buffer.set_transform
        self._link.world.memory.note(len(transforms))
        return tuple(one for one in transforms if store(one, authority))

    def _compare_clocks(self, stamp: Stamp, authority: str) -> None:
        clock, graph = self._link.world.clock, self._link.graph
        is_told = isinstance(clock, FollowedClock) and clock.is_told
        if is_clock_shown(graph) and not is_told:
            return  # the first time from /clock will arrive soon, or only nodes follow /clock
        ahead = stamp - clock.now()
        if -YEAR < ahead < AHEAD:
            return
        if is_told and abs(ahead) < YEAR:
            return  # a playback in a loop, where nodes still send stamps of the last round
        if 0 < ahead < YEAR:
            self._link.say_once(
                "clock ahead",
                f"'{authority}' stamps its transforms {as_seconds(ahead):.1f} s after this "
                "machine's clock: this clock is slow, or the other clock is fast (demo --rate). "
                "Ages, and lookups at recent times, are wrong by the same amount.",
            )
            return
        self._link.say_once(
            f"clock {authority}",
            f"'{authority}' stamps its transforms {as_seconds(abs(ahead)) / as_seconds(YEAR):.1f} "
            f"years {'after' if ahead > 0 else 'before'} this machine's clock: ages and waits "
            "are useless until both clocks agree (or one clock is simulated).",
        )


class StaticBridge(TransformBridge):
    """Bridge of `tf_static`: a late subscriber gets all static transforms of every process."""

    quality = TF_STATIC

    def _dismiss(self) -> None:
        """Do nothing: late subscribers also get static transforms of nodes that have left."""

    def _arrived(self, message: Arrived) -> None:
        super()._arrived(message)
        self._link.heard_statics.add(message.sender)

    def _store(
        self, transforms: tuple[TransformStamped, ...], authority: str
    ) -> tuple[TransformStamped, ...]:
        return self._link.world.receive_static(transforms, authority)


CLOCK_TOPIC: Final = "clock"
CLOCK_TYPE: Final = "rosgraph_msgs/msg/Clock"


def is_clock_shown(graph: Graph) -> bool:
    """Return whether another process publishes `/clock`."""
    return any(one.ros_type == CLOCK_TYPE for one in graph.entities(PUBLISHER, name=CLOCK_TOPIC))


class ClockFollower:
    """Subscriber that sets a world's clock from `/clock` of another process.

    If the time on `/clock` falls back, the transforms in the world's buffer are removed, even if
    the world has a clock of its own: the buffer would reject the transforms that follow.
    """

    def __init__(self, world: World) -> None:
        """Follow `/clock` as soon as another process publishes this topic.

        Args:
            world: World whose connection receives `/clock`. If the world's clock is a
                `FollowedClock`, the messages set the clock.
        """
        self._world = world
        self._clock = world.clock if isinstance(world.clock, FollowedClock) else None
        self._watch = Watch(world.buffer.clear)
        self._stop_listening: Callable[[], None] | None = None
        self._falls = Repeats()
        self._is_looking = False
        self._stops = [world.watch(self._look, NAME)]
        if self._clock is not None:
            self._stops.append(self._clock.fell_back.add(self._fell_back, NAME))
        self._look()

    def close(self) -> None:
        """Stop following `/clock`."""
        for stop in self._stops:
            stop()
        if self._stop_listening is not None:
            self._stop_listening()

    def _look(self) -> None:
        # Subscribing changes the world, which calls this function again.
        if self._is_looking:
            return
        self._is_looking = True
        try:
            publishers = self._world.endpoints.of(CLOCK_TOPIC, PUBLISHER)
            is_published = any(one.is_remote and one.interface == CLOCK_TYPE for one in publishers)
            if is_published and self._stop_listening is None:
                kind = INTERFACES.message(CLOCK_TYPE)
                topic = self._world.topic(CLOCK_TOPIC, kind)
                self._stop_listening = topic.subscribe(self._take, NAME)
            elif not is_published and self._stop_listening is not None:
                self._stop_listening()
                self._stop_listening = None
                if self._clock is not None:
                    self._clock.run_on()
        finally:
            self._is_looking = False

    def _take(self, message: Any) -> None:
        moment = message.clock.sec * NANOSECONDS + message.clock.nanosec
        if self._clock is not None:
            self._clock.tell(moment)
        else:
            self._watch.read(moment)

    def _fell_back(self, by: Duration) -> None:
        if must_clear(-by):
            # The time of a recording played in a loop falls back in each round.
            if text := self._falls.said("", FELL_BACK):
                self._world.log.warn(NAME, text)
            self._world.buffer.clear()
