"""rclpy.event_handler: being told of the other ends of a topic.

Told are those that come and go ("matched"), and those whose quality does not fit
("incompatible_qos"). Here no message is lost or late on its way, and no publisher is found
dead, so of the other events there are none.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple

from tftool.ros.rclpy.entities import WorkQueue
from tftool.ros.rclpy.qos import QoSPolicyKind
from tftool.ros.rclpy.seat import NodeSeat
from tftool.runtime.endpoints import PUBLISHER, SUBSCRIPTION, Endpoint, conflict


class UnsupportedEventTypeError(Exception):
    """A kind of event that is not known."""


class QoSPublisherEventType(IntEnum):
    """What a publisher can be told of."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(IntEnum):
    """What a subscription can be told of."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class QoSCountInfo(NamedTuple):
    """How often something has happened, and how often since it was last told."""

    total_count: int = 0
    total_count_change: int = 0


class QoSLivelinessChangedInfo(NamedTuple):
    """How many publishers are alive, and are not."""

    alive_count: int = 0
    not_alive_count: int = 0
    alive_count_change: int = 0
    not_alive_count_change: int = 0


class QoSIncompatibleInfo(NamedTuple):
    """How many other ends do not fit, and by which policy the last one does not."""

    total_count: int = 0
    total_count_change: int = 0
    last_policy_kind: QoSPolicyKind = QoSPolicyKind.INVALID


class QoSMatchedInfo(NamedTuple):
    """How many other ends there have been, and are now."""

    total_count: int = 0
    total_count_change: int = 0
    current_count: int = 0
    current_count_change: int = 0


Told = Callable[[Any], object] | None


@dataclass(slots=True)
class PublisherEventCallbacks:
    """What a publisher's node wants to be told of."""

    incompatible_qos: Told = None
    liveliness: Told = None
    deadline: Told = None
    incompatible_type: Told = None
    matched: Told = None
    use_default_callbacks: bool = True


@dataclass(slots=True)
class SubscriptionEventCallbacks:
    """What a subscription's node wants to be told of."""

    incompatible_qos: Told = None
    liveliness: Told = None
    deadline: Told = None
    message_lost: Told = None
    incompatible_type: Told = None
    matched: Told = None
    use_default_callbacks: bool = True


class EndpointWatch(WorkQueue):
    """Calls a node's callbacks when other ends of a topic come and go."""

    def __init__(self, seat: NodeSeat, group: Any, own: Endpoint, wanted: Any) -> None:
        """Watch for an end of a topic (on the loop's thread)."""
        super().__init__(seat, group)
        self._own = own
        self._wanted = wanted
        self._matched = QoSMatchedInfo()
        self._unfit = QoSIncompatibleInfo()
        self._seen: list[Endpoint] = []
        self._stop = seat.world.watch(self._look, seat.authority)
        self._look()

    def _look(self) -> None:
        own = self._own
        publishes = own.role == PUBLISHER
        others = [
            one
            for one in self.seat.world.endpoints.of(
                own.topic, SUBSCRIPTION if publishes else PUBLISHER
            )
            if one.interface == own.interface
        ]
        new = [one for one in others if all(one is not seen for seen in self._seen)]
        gone = [one for one in self._seen if all(one is not now for now in others)]
        self._seen = others

        def policy(one: Endpoint) -> str:
            pair = (own.quality, one.quality) if publishes else (one.quality, own.quality)
            return conflict(*pair)

        fitting = sum(not policy(one) for one in new)
        leaving = sum(not policy(one) for one in gone)
        if (fitting or leaving) and self._wanted.matched is not None:
            before = self._matched
            self._matched = QoSMatchedInfo(
                before.total_count + fitting,
                fitting,
                before.current_count + fitting - leaving,
                fitting - leaving,
            )
            self._tell(self._wanted.matched, self._matched)
        unfit = [policy(one) for one in new if policy(one)]
        if unfit and self._wanted.incompatible_qos is not None:
            total = self._unfit.total_count + len(unfit)
            kind = QoSPolicyKind[unfit[-1]]
            self._unfit = QoSIncompatibleInfo(total, len(unfit), kind)
            self._tell(self._wanted.incompatible_qos, self._unfit)

    def _tell(self, callback: Callable[[Any], object], info: Any) -> None:
        self.put(lambda: callback(info))

    def withdraw(self) -> None:
        """Watch no more."""
        super().withdraw()
        self._stop()
