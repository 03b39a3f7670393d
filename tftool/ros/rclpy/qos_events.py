"""Events of rclpy.event_handler, which tell a publisher about subscriptions and vice versa.

The events are: matching endpoints appear or disappear ("matched"), the quality of service of
another endpoint is incompatible ("incompatible_qos"), no message was sent in time ("deadline"), and
a publisher seems to have stopped ("liveliness"). ROS 2's other events do not occur in tftool,
because no message is lost and a topic has only one type.
"""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple

from tftool.ros.rclpy.entities import WorkQueue
from tftool.ros.rclpy.node_state import NodeState
from tftool.ros.rclpy.qos import QoSPolicyKind
from tftool.world.clock import Phase
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, Endpoint, conflict


class UnsupportedEventTypeError(Exception):
    """Error of rclpy for a type of event that a middleware does not support."""


class QoSPublisherEventType(IntEnum):
    """Types of events of a publisher, with ROS 2's numbers."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(IntEnum):
    """Types of events of a subscription, with ROS 2's numbers."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class QoSCountInfo(NamedTuple):
    """Number of times that an event has occurred, and the change since the last report."""

    total_count: int = 0
    total_count_change: int = 0


class QoSLivelinessChangedInfo(NamedTuple):
    """Numbers of publishers that are alive and not alive, and the changes since the last report."""

    alive_count: int = 0
    not_alive_count: int = 0
    alive_count_change: int = 0
    not_alive_count_change: int = 0


class QoSIncompatibleInfo(NamedTuple):
    """Number of incompatible endpoints, change since the last report, and last violated policy."""

    total_count: int = 0
    total_count_change: int = 0
    last_policy_kind: QoSPolicyKind = QoSPolicyKind.INVALID


class QoSMatchedInfo(NamedTuple):
    """Numbers of endpoints matched so far and now, and the changes since the last report."""

    total_count: int = 0
    total_count_change: int = 0
    current_count: int = 0
    current_count_change: int = 0


Told = Callable[[Any], object] | None


@dataclass(kw_only=True)
class PublisherEventCallbacks:
    """Callbacks for the events of a publisher; None to ignore an event."""

    incompatible_qos: Told = None
    liveliness: Told = None
    deadline: Told = None
    incompatible_type: Told = None
    matched: Told = None
    use_default_callbacks: bool = True


@dataclass(kw_only=True)
class SubscriptionEventCallbacks(PublisherEventCallbacks):
    """Callbacks for the events of a subscription; None to ignore an event."""

    message_lost: Told = None


class Silence:
    """Timer that calls a function when nothing has been recorded for longer than a limit."""

    def __init__(
        self, state: NodeState, limit: int | None, on_silence: Callable[[], object]
    ) -> None:
        """Create the timer; the first call of `end` starts it.

        `limit` is the longest allowed time between two calls of `end`, in nanoseconds, None for no
        limit. `on_silence` is called in the event loop's thread when the limit has passed.
        """
        self._node_state = state
        self._limit = limit
        self._on_silence = on_silence
        self._last = 0
        self._timer: asyncio.Future[None] | None = None

    def end(self) -> None:
        """Record a message or another sign of a living publisher; restart the time limit."""
        self._last = self._node_state.world.clock.now()
        if self._timer is None and self._limit is not None:
            self._wait(self._limit)

    def stop(self) -> None:
        """Stop the timer for good."""
        if self._timer is not None:
            self._timer.cancel()

    def _wait(self, limit: int) -> None:
        # There may be thousands of signs of life, so the timer is not restarted at each of them.
        # The time of the last sign is checked when the timer ends.
        clock = self._node_state.program.clock
        self._timer = clock.timer(self._last + limit, Phase.WATCH)
        self._timer.add_done_callback(lambda timer: self._look(timer, limit))

    def _look(self, timer: "asyncio.Future[None]", limit: int) -> None:
        if timer.cancelled():
            return
        self._timer = None
        if self._node_state.world.clock.now() < self._last + limit:
            self._wait(limit)
        else:
            self._on_silence()


class EndpointWatch(WorkQueue):
    """Work queue that calls the user's callbacks for events of one publisher or subscription."""

    def __init__(self, state: NodeState, group: Any, endpoint: Endpoint, callbacks: Any) -> None:
        """Watch a publisher or subscription for events; call this in the event loop's thread."""
        super().__init__(state, group)
        self._endpoint = endpoint
        self._callbacks = callbacks
        self._matched = QoSMatchedInfo()
        self._unfit = QoSIncompatibleInfo()
        self._missed = QoSCountInfo()
        self._lost = QoSCountInfo()
        self._lives = QoSLivelinessChangedInfo()
        self._seen: list[Endpoint] = []
        timing = endpoint.quality.timing
        limit = None if timing is None or callbacks.deadline is None else timing.deadline
        self._deadline = Silence(state, limit, self._miss)
        self._stop = state.world.watch(self._look, state.authority)
        self._look()

    def _look(self) -> None:
        own = self._endpoint
        publishes = own.role == PUBLISHER
        others = [
            one
            for one in self.node_state.world.endpoints.of(
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

        if not publishes:
            self._look_who_lives([one for one in others if not policy(one)])
        fitting = sum(not policy(one) for one in new)
        leaving = sum(not policy(one) for one in gone)
        if fitting or leaving:
            before = self._matched
            self._matched = QoSMatchedInfo(
                before.total_count + fitting,
                fitting,
                before.current_count + fitting - leaving,
                fitting - leaving,
            )
            self._tell(self._callbacks.matched, self._matched)
        unfit = [policy(one) for one in new if policy(one)]
        if unfit:
            total = self._unfit.total_count + len(unfit)
            kind = QoSPolicyKind[unfit[-1]]
            self._unfit = QoSIncompatibleInfo(total, len(unfit), kind)
            self._tell(self._callbacks.incompatible_qos, self._unfit)

    def _look_who_lives(self, publishers: list[Endpoint]) -> None:
        alive = sum(map(self.node_state.world.endpoints.is_alive, publishers))
        dead, before = len(publishers) - alive, self._lives
        changes = (alive - before.alive_count, dead - before.not_alive_count)
        if any(changes):
            self._lives = QoSLivelinessChangedInfo(alive, dead, *changes)
            self._tell(self._callbacks.liveliness, self._lives)

    def message_passed(self) -> None:
        """Record that a message was sent or received, and restart the deadline."""
        self._deadline.end()

    def _miss(self) -> None:
        self._missed = QoSCountInfo(self._missed.total_count + 1, 1)
        self._tell(self._callbacks.deadline, self._missed)
        self._deadline.end()

    def lease_expired(self) -> None:
        """Report that the watched publisher gave no sign of life for longer than its lease."""
        self._lost = QoSCountInfo(self._lost.total_count + 1, 1)
        self._tell(self._callbacks.liveliness, self._lost)

    def _tell(self, callback: Told, info: Any) -> None:
        if callback is not None:
            self.put(lambda: callback(info))

    def withdraw(self) -> None:
        """Stop reporting events of the publisher or subscription."""
        self._stop()
        self._deadline.stop()
