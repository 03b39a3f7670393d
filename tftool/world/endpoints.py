"""Publishers and subscriptions of topics, with their quality of service, and clients of services.

The store has the publishers, subscriptions and clients of all nodes, also of other processes.
Topics inside one process, such as pressed keys, have no ROS type and no entry.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal

from tftool.base.stamps import Duration

Role = Literal["publisher", "subscription", "client"]

PUBLISHER: Final = "publisher"
SUBSCRIPTION: Final = "subscription"
CLIENT: Final = "client"


@dataclass(frozen=True, slots=True)
class Timing:
    """Deadline, liveliness and lifespan of a topic's publishers, offered or requested.

    Attributes:
        deadline: Longest time between two messages, nanoseconds; None for no limit.
        lease: Time without a sign of life after which a publisher counts as dead, nanoseconds; None
            for never.
        is_manual: Whether each publisher must assert its liveliness itself; else its process does
            so for all publishers.
        lifespan: Age at which a message expires, nanoseconds; None for never. Programs can read
            this age, but tftool drops no expired message.
    """

    deadline: Duration | None = None
    lease: Duration | None = None
    is_manual: bool = False
    lifespan: Duration | None = None


@dataclass(frozen=True, slots=True)
class Quality:
    """Quality of service of a publisher or a subscription.

    Attributes:
        depth: Size of the queue in messages; also the number of messages stored for late
            subscribers.
        is_reliable: Whether every message must be delivered.
        is_latched: Whether late subscribers get earlier messages (transient local).
        keeps_all: Whether the queue is unlimited, so that `depth` has no effect.
        timing: Deadline, liveliness and lifespan; None if unknown.
    """

    depth: int = 10
    is_reliable: bool = True
    is_latched: bool = False
    keeps_all: bool = False
    timing: Timing | None = None


USUAL: Final = Quality(depth=7)
"""Quality of service of turtlesim, and default for all nodes."""

TF: Final = Quality(depth=100)
"""Quality of service of /tf in tf2."""

TF_STATIC: Final = Quality(depth=1, is_latched=True)
"""Quality of service of /tf_static in tf2."""


def conflict(offered: Quality, requested: Quality) -> str:
    """Return the QoS policy in which a publisher offers less than requested; "" if none."""
    if requested.is_reliable and not offered.is_reliable:
        return "RELIABILITY"
    if requested.is_latched and not offered.is_latched:
        return "DURABILITY"
    if offered.timing is None or requested.timing is None:
        return ""
    if _is_longer(offered.timing.deadline, requested.timing.deadline):
        return "DEADLINE"
    is_less = requested.timing.is_manual and not offered.timing.is_manual
    if is_less or _is_longer(offered.timing.lease, requested.timing.lease):
        return "LIVELINESS"
    return ""


def _is_longer(offered: Duration | None, requested: Duration | None) -> bool:
    return requested is not None and (offered is None or offered > requested)


@dataclass(frozen=True, slots=True, eq=False)
class Endpoint:
    """Publisher of a topic, subscription to a topic, or client of a service.

    Attributes:
        role: Whether this is a publisher, a subscription or a client.
        node: Name of the node.
        topic: Name of the topic or service, without a leading slash.
        interface: Type of the messages or the service, such as "std_msgs/msg/String".
        quality: Offered or requested quality of service.
        is_remote: Whether the endpoint belongs to another process.
        gid: Id of another process's endpoint; empty for an endpoint of this process.
        deliver: Function that passes an earlier message and its publisher to a latched
            subscription.
        kept: Messages that a latched publisher stores for late subscribers.
    """

    role: Role
    node: str
    topic: str
    interface: str
    quality: Quality = USUAL
    is_remote: bool = False
    gid: bytes = b""
    deliver: "Callable[[Any, Endpoint | None], object] | None" = None
    kept: "deque[Any] | None" = None


class Endpoints:
    """Store of the endpoints of a world, and of the other processes in the session."""

    def __init__(self, changed: Callable[[], object], warn: Callable[[str, str], object]) -> None:
        """Create an empty store.

        Args:
            changed: Function called when an endpoint is added, removed, or changes its liveliness.
            warn: Function called with a node's name and a sentence for its log.
        """
        self._changed = changed
        self._warn = warn
        self._by_topic: dict[str, list[Endpoint]] = {}
        self._silent: set[Endpoint] = set()

    def add(self, endpoint: Endpoint) -> Callable[[], None]:
        """Add an endpoint; return a function that removes the endpoint."""
        others = self._by_topic.setdefault(endpoint.topic, [])
        others.append(endpoint)
        for other in others:
            if other.role == PUBLISHER and endpoint.role == SUBSCRIPTION:
                self._compare(other, endpoint)
            elif other.role == SUBSCRIPTION and endpoint.role == PUBLISHER:
                self._compare(endpoint, other)
        self._changed()

        def remove() -> None:
            self._silent.discard(endpoint)
            held = self._by_topic.get(endpoint.topic, [])
            if endpoint in held:
                held.remove(endpoint)
                if not held:
                    del self._by_topic[endpoint.topic]
                self._changed()

        return remove

    def set_alive(self, endpoint: Endpoint, alive: bool) -> None:
        """Record whether a publisher still meets its liveliness policy."""
        if alive is (endpoint in self._silent):
            (self._silent.discard if alive else self._silent.add)(endpoint)
            self._changed()

    def is_alive(self, endpoint: Endpoint) -> bool:
        """Return whether a publisher meets its liveliness policy, as last reported."""
        return endpoint not in self._silent

    def of(self, topic: str, role: Role) -> list[Endpoint]:
        """Return the publishers or subscriptions of a topic, or the clients of a service."""
        return [one for one in self._by_topic.get(topic, ()) if one.role == role]

    def topics(self) -> list[str]:
        """Return the names of all topics or services that have an endpoint."""
        return list(self._by_topic)

    def _compare(self, publisher: Endpoint, subscription: Endpoint) -> None:
        """Log a warning for both nodes if their endpoints have incompatible quality of service."""
        policy = conflict(publisher.quality, subscription.quality)
        if not policy or publisher.interface != subscription.interface:
            return
        for told, other, what, gives in (
            (publisher, subscription, "requesting", "sent to it"),
            (subscription, publisher, "offering", "received from it"),
        ):
            if not told.is_remote:
                self._warn(
                    told.node,
                    f"New {other.role} discovered on topic '/{told.topic}' (node "
                    f"'{other.node}'), {what} incompatible QoS. No messages will be {gives}. "
                    f"Last incompatible policy: {policy}",
                )
