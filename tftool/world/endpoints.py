"""Publishers and subscriptions of topics with their quality of service.

Publishers and subscriptions of all nodes, also those of other processes, are entered here. Topics
inside one process, such as pressed keys, have no ROS type and are not entered.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal

from tftool.base.stamps import Duration

Role = Literal["publisher", "subscription"]

PUBLISHER: Final = "publisher"
SUBSCRIPTION: Final = "subscription"


@dataclass(frozen=True, slots=True)
class Timing:
    """Deadline and liveliness of a topic's publishers, offered or requested.

    Attributes:
        deadline: At most so long between two messages, nanoseconds; None for any time.
        lease: After how long without a sign of life a publisher counts as dead; None for never.
        is_manual: Whether a message, or asserting it, is a sign of life, and not just to be there.
        lifespan: Age at which a message expires, as shown to programs; None for never.
    """

    deadline: Duration | None = None
    lease: Duration | None = None
    is_manual: bool = False
    lifespan: Duration | None = None


@dataclass(frozen=True, slots=True)
class Quality:
    """Quality of service of a publisher or a subscription.

    Attributes:
        depth: Number of messages wait, or are kept for late subscribers.
        is_reliable: Whether none may be lost on the way.
        is_latched: Whether late subscribers get earlier messages (transient local).
        keeps_all: Whether nothing that waits is dropped, whatever the depth.
        timing: Rate of the messages; None if unknown.
    """

    depth: int = 10
    is_reliable: bool = True
    is_latched: bool = False
    keeps_all: bool = False
    timing: Timing | None = None


USUAL: Final = Quality(depth=7)
"""What turtlesim offers, and nodes that ask for nothing else."""

TF: Final = Quality(depth=100)
"""tf2's quality of /tf."""

TF_STATIC: Final = Quality(depth=1, is_latched=True)
"""tf2's quality of /tf_static."""


def conflict(offered: Quality, requested: Quality) -> str:
    """Return the policy in which a publisher offers less than is requested; "" if none."""
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
    """One publisher or subscription.

    Attributes:
        role: Publisher or subscription.
        node: Node of the endpoint.
        topic: The topic's name, without a leading slash.
        interface: The exchanged type, "std_msgs/msg/String".
        quality: Offered or requested quality of service.
        is_remote: Whether the endpoint is another process's.
        deliver: Receives, for a latched subscription here, earlier messages and their senders.
        kept: Messages that late subscribers of a latched publisher here get.
    """

    role: Role
    node: str
    topic: str
    interface: str
    quality: Quality
    is_remote: bool = False
    deliver: "Callable[[Any, Endpoint | None], object] | None" = None
    kept: "deque[Any] | None" = None


class Endpoints:
    """All endpoints of a world and of the worlds linked to it."""

    def __init__(self, changed: Callable[[], object], warn: Callable[[str, str], object]) -> None:
        """Start empty.

        Args:
            changed: Called when an offer is added or removed.
            warn: Called with a node and a sentence it should log.
        """
        self._changed = changed
        self._warn = warn
        self._by_topic: dict[str, list[Endpoint]] = {}
        self._silent: set[Endpoint] = set()

    def add(self, endpoint: Endpoint) -> Callable[[], None]:
        """Add an endpoint; call the returned function to remove it."""
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
        """Record whether a publisher keeps its liveliness."""
        if alive is (endpoint in self._silent):
            (self._silent.discard if alive else self._silent.add)(endpoint)
            self._changed()

    def is_alive(self, endpoint: Endpoint) -> bool:
        """Whether a publisher keeps its liveliness, as far as known."""
        return endpoint not in self._silent

    def of(self, topic: str, role: Role) -> list[Endpoint]:
        """Return a topic's publishers or subscriptions."""
        return [one for one in self._by_topic.get(topic, ()) if one.role == role]

    def topics(self) -> list[str]:
        """Return the names of all topics with an endpoint."""
        return list(self._by_topic)

    def _compare(self, publisher: Endpoint, subscription: Endpoint) -> None:
        """Report on both sides that two endpoints are incompatible, and why."""
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
