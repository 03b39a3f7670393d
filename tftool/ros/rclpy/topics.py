"""Publishers and subscriptions of rclpy, and conversion between messages and bytes."""

from collections import deque
from collections.abc import Callable
from typing import Any, TypedDict

from tftool.messages.classes import Message
from tftool.messages.codec import codec
from tftool.ros.host import values
from tftool.ros.rclpy.entities import NodeEntity, Work, accepts
from tftool.ros.rclpy.exceptions import InvalidHandle
from tftool.ros.rclpy.node_state import NodeState
from tftool.ros.rclpy.qos import HistoryPolicy, QoSProfile, quality_of
from tftool.ros.rclpy.qos_events import EndpointWatch, Silence
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, Endpoint, Role, conflict
from tftool.world.world import TransformMessage


def serialize_message(message: Any) -> bytes:
    """Return a message as bytes in ROS 2's serialised form (CDR).

    Raises:
        TypeError: If the object is not a message.
    """
    if not isinstance(message, Message):
        raise TypeError(f"expected a message, got {type(message).__name__}")
    return codec(type(message)).encode(message)


def deserialize_message(serialized_message: bytes, message_type: Any) -> Any:
    """Convert bytes in ROS 2's serialised form (CDR) to a message of the class `message_type`.

    Raises:
        MalformedMessage: If the bytes are not a message of this class.
    """
    return codec(message_type).decode(bytes(serialized_message))


class TopicEnd(NodeEntity):
    """Base class of publishers and subscriptions.

    The attribute `endpoint` is the publisher's or subscription's entry in the graph.
    """

    event_watch: EndpointWatch | None = None
    _leave: Callable[[], None]

    def __init__(
        self,
        state: NodeState,
        group: Any,
        role: Role,
        kind: type[Message],
        topic: str,
        full: str,
        profile: QoSProfile,
        deliver: Callable[[Any, Endpoint | None], object] | None = None,
    ) -> None:
        super().__init__(state, group)
        self.msg_type = kind
        self.qos_profile = profile
        self.topic = topic
        self.full = full
        self._carried = values.topic_class(kind, full)
        self._topic: Any = state.world.topic(full, self._carried)
        self._quality = quality_of(profile, offered=role == PUBLISHER)
        self._is_latched = self._quality.is_latched and full not in values.TF_TOPICS
        keeps = self._is_latched and role == PUBLISHER
        keeps_all = profile.history is HistoryPolicy.KEEP_ALL
        self._queue_limit = None if keeps_all else max(1, profile.depth)
        self.endpoint = Endpoint(
            role,
            state.authority,
            full,
            kind.interface__,
            self._quality,
            # A latched subscription gets other processes' messages, including earlier messages,
            # from the connection itself.
            deliver=deliver if self._is_latched else None,
            kept=deque(maxlen=self._queue_limit) if keeps else None,
        )

    @property
    def topic_name(self) -> str:
        """Full name of the topic."""
        return f"/{self.full}"

    def withdraw(self) -> None:
        """Remove the publisher or subscription from the graph."""
        self._leave()
        if self.event_watch is not None:
            self.event_watch.withdraw()


class Publisher(TopicEnd):
    """Publisher of messages on a topic."""

    def __init__(
        self, state: NodeState, kind: type[Message], topic: str, full: str, profile: QoSProfile
    ) -> None:
        super().__init__(state, None, PUBLISHER, kind, topic, full, profile)
        self._withdrawn = False
        self._lease: Silence | None = None
        timing = self._quality.timing
        if timing is not None and timing.is_manual:
            state.world.endpoints.set_alive(self.endpoint, False)
            self._lease = Silence(state, timing.lease, self._expired)
        self._leave = state.world.endpoints.add(self.endpoint)

    def publish(self, msg: Any) -> None:
        """Send a message, given as an object or as bytes in serialised form.

        Raises:
            TypeError: If the message is not of the publisher's type.
            InvalidHandle: If this publisher is destroyed.
        """
        if self._withdrawn:
            raise InvalidHandle(
                f"the publisher of '{self.topic_name}' is destroyed, so it cannot publish"
            )
        if isinstance(msg, bytes):
            msg = deserialize_message(msg, self.msg_type)
        if not isinstance(msg, self.msg_type):
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        state = self.node_state
        value = values.pack(msg, self._carried)
        if self.full in values.TF_TOPICS and isinstance(value, TransformMessage):
            static = self.full == "tf_static"
            state.program.ask(
                lambda: state.world.broadcast(value.transforms, state.authority, static=static)
            )
            return
        state.program.ask(lambda: self._send(value))

    def _send(self, value: Any) -> None:
        self._be_alive()
        if self.event_watch is not None:
            self.event_watch.message_passed()
        if self.endpoint.kept is not None:
            self.endpoint.kept.append(value)
        self._topic.publish(value, self.endpoint)

    @property
    def is_heard(self) -> bool:
        """Whether the topic has a subscription.

        Unlike `get_subscription_count`, this property is not counted as polling by the program.
        """
        return bool(self._topic.subscribers)

    def get_subscription_count(self) -> int:
        """Return the number of subscriptions to the topic."""
        count = int(self.node_state.program.ask(lambda: self._topic.subscribers))
        if not count:
            self.node_state.program.count_failed_query(must_keep_pace=False)
        return count

    def assert_liveliness(self) -> None:
        """Report that this publisher is alive, for liveliness MANUAL_BY_TOPIC."""
        self.node_state.program.ask(self._be_alive)

    def _be_alive(self) -> None:
        if self._lease is not None:
            self._lease.end()
            self.node_state.world.endpoints.set_alive(self.endpoint, True)

    def _expired(self) -> None:
        self.node_state.world.endpoints.set_alive(self.endpoint, False)
        if self.event_watch is not None:
            self.event_watch.lease_expired()

    def wait_for_all_acked(self, timeout: Any = None) -> bool:
        """Return True at once, because `publish` returns only after delivery in this process."""
        return True

    def withdraw(self) -> None:
        """Remove the publisher from the graph; drop messages stored for late subscribers."""
        self._withdrawn = True
        if self._lease is not None:
            self._lease.stop()
        super().withdraw()


class MessageInfo(TypedDict):
    """Times in nanoseconds and sequence numbers of a received message.

    If a subscription's callback has two arguments, the second argument is a MessageInfo.
    """

    source_timestamp: int
    received_timestamp: int
    publication_sequence_number: int | None
    reception_sequence_number: int | None


class Subscription(TopicEnd):
    """Subscription to the messages on a topic."""

    is_a_callback = True

    def __init__(
        self,
        state: NodeState,
        kind: type[Message],
        topic: str,
        full: str,
        callback: Callable[[Any], Any],
        profile: QoSProfile,
        group: Any,
        raw: bool = False,
    ) -> None:
        super().__init__(state, group, SUBSCRIPTION, kind, topic, full, profile, self._accept)
        self.raw = raw
        self.callback: Callable[..., Any] = callback
        self._queue: deque[Any] = deque(maxlen=self._queue_limit)
        self._takes_info = not accepts(callback, None) and accepts(callback, None, None)
        self._leave = state.world.endpoints.add(self.endpoint)
        self._stop = self._topic.subscribe(self._arrived, state.authority)
        if self._quality.is_latched:
            for value, sender in state.stored_messages(full):
                self._accept(value, sender)

    def get_publisher_count(self) -> int:
        """Return the number of publishers of the topic."""
        ends = self.node_state.world.endpoints
        return int(self.node_state.program.ask(lambda: len(ends.of(self.full, PUBLISHER))))

    def _arrived(self, value: Any) -> None:
        sender = self._topic.sender
        if not (self._is_latched and sender is not None and sender.is_remote):
            self._accept(value, sender)

    def _accept(self, value: Any, sender: Endpoint | None) -> None:
        # Messages of a publisher with an incompatible quality of service are ignored.
        if sender is None or not conflict(sender.quality, self._quality):
            self._queue.append((self.node_state.world.clock.now(), value))
            self.node_state.wake()
            if self.event_watch is not None:
                self.event_watch.message_passed()

    def ready(self) -> bool:
        """Return whether the queue contains a received message."""
        return bool(self._queue)

    def take(self) -> Work:
        """Remove the oldest message from the queue; return a function that calls the callback."""
        stamp, value = self._queue.popleft()

        def work() -> Any:
            message = values.unpack(value, self.msg_type)
            if self.raw:
                message = serialize_message(message)
            if self._takes_info:
                return self.callback(
                    message,
                    MessageInfo(
                        source_timestamp=stamp,
                        received_timestamp=stamp,
                        publication_sequence_number=None,
                        reception_sequence_number=None,
                    ),
                )
            return self.callback(message)

        return work

    def withdraw(self) -> None:
        """Unsubscribe from the topic, and drop the queued messages."""
        super().withdraw()
        self._stop()
        self._queue.clear()


class RosoutPublisher(Publisher):
    """Publisher of a node's log messages on /rosout; `logger` is the name of the node's logger."""

    logger: str

    def speaks_for(self, logger: str) -> bool:
        """Return whether a logger is the node's logger or a child of the node's logger."""
        return logger == self.logger or logger.startswith(f"{self.logger}.")

    def publish_record(
        self, level: int, logger: str, text: str, source_line: tuple[str, str, int]
    ) -> None:
        """Publish a log message; call this in the event loop's thread.

        `source_line` is the file, function and line number of the code that logs.
        """
        file, function, line = source_line
        message = self.msg_type(
            stamp=values.time_message(self.node_state.world.clock.now()),
            level=level,
            name=logger,
            msg=text,
            file=file,
            function=function,
            line=line,
        )
        self._send(message)
