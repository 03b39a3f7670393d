"""What a node has: publishers, subscriptions, timers, guard conditions.

Each keeps what arrived until an executor takes it. `ready` and `take` run on the
loop's thread; what `take` returns runs on the fiber that spins.
"""

import inspect
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tftool.interfaces.classes import Message
from tftool.ros import values
from tftool.ros.client.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tftool.ros.client.time import Duration, Time
from tftool.runtime.world import TransformMessage

if TYPE_CHECKING:
    from tftool.ros.client.node import Node

Work = Callable[[], Any]
"""What is left to do on the fiber once an entity was taken from; may return a coroutine."""


class Entity:
    """Something of a node that can become ready."""

    passes_busy_group = False

    def __init__(self, node: "Node", group: Any) -> None:
        self.node = node
        self.callback_group = group
        self._withdrawn = False

    def ready(self) -> bool:
        """Whether there is something to take."""
        return False

    def take(self) -> Work:
        """What to do next."""
        raise NotImplementedError

    def withdraw(self) -> None:
        """Stop listening (on the loop's thread)."""
        self._withdrawn = True

    def destroy(self) -> None:
        """Stop listening, and leave the node."""
        self.node.forget(self)


class Publisher(Entity):
    """Sends messages on a topic."""

    def __init__(
        self, node: "Node", kind: type[Message], topic: str, full: str, profile: QoSProfile
    ) -> None:
        super().__init__(node, None)
        self.msg_type = kind
        self.qos_profile = profile
        self.topic = topic
        self.full = full
        self._converter = values.converter(kind, full)
        self._topic = node.world.topic(full, self._converter.kind)
        self._latched: deque[Any] | None = None
        if profile.durability is DurabilityPolicy.TRANSIENT_LOCAL and full not in values.TF_TOPICS:
            self._latched = deque(maxlen=profile.depth or None)
            node.graph.latched.setdefault(full, []).append(self._latched)
        node.graph.publishers.setdefault(full, []).append(self)

    @property
    def topic_name(self) -> str:
        """The topic's full name."""
        return f"/{self.full}"

    def publish(self, msg: Any) -> None:
        """Send a message.

        Raises:
            TypeError: If it is of another type.
        """
        if not isinstance(msg, self.msg_type):
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        node = self.node
        value = self._converter.pack(msg)
        if self.full in values.TF_TOPICS and isinstance(value, TransformMessage):
            static = self.full == "tf_static"
            node.program.ask(
                lambda: node.world.broadcast(value.transforms, node.authority, static=static)
            )
            return
        node.program.ask(lambda: self._send(value))

    def _send(self, value: Any) -> None:
        if self._latched is not None:
            self._latched.append(value)
        self._topic.publish(value)

    def get_subscription_count(self) -> int:
        """How many listen."""
        return int(self.node.program.ask(lambda: self._topic.subscribers))

    def assert_liveliness(self) -> None:
        """Nothing to do."""

    def withdraw(self) -> None:
        """Leave the graph; latched messages go along."""
        super().withdraw()
        graph = self.node.graph
        if self in graph.publishers.get(self.full, []):
            graph.publishers[self.full].remove(self)
        if self._latched is not None:
            graph.latched[self.full] = [
                one for one in graph.latched[self.full] if one is not self._latched
            ]


class Subscription(Entity):
    """Receives a topic's messages."""

    def __init__(
        self,
        node: "Node",
        kind: type[Message],
        topic: str,
        full: str,
        callback: Callable[[Any], Any],
        profile: QoSProfile,
        group: Any,
    ) -> None:
        super().__init__(node, group)
        self.msg_type = kind
        self.callback: Callable[..., Any] = callback
        self.qos_profile = profile
        self.topic = topic
        self.full = full
        self._converter = values.converter(kind, full)
        keeps_all = profile.history is HistoryPolicy.KEEP_ALL
        self._queue: deque[Any] = deque(maxlen=None if keeps_all else max(1, profile.depth))
        self._takes_info = _takes_two(callback)
        self._stop = node.world.topic(full, self._converter.kind).subscribe(self._arrived)
        node.graph.subscriptions.setdefault(full, []).append(self)
        if profile.durability is DurabilityPolicy.TRANSIENT_LOCAL:
            for value in node.late(full):
                self._arrived(value)

    @property
    def topic_name(self) -> str:
        """The topic's full name."""
        return f"/{self.full}"

    def _arrived(self, value: Any) -> None:
        self._queue.append((self.node.clock_now(), value))
        self.node.wake()

    def ready(self) -> bool:
        """Whether a message waits."""
        return bool(self._queue)

    def take(self) -> Work:
        """The callback with the oldest waiting message."""
        stamp, value = self._queue.popleft()

        def work() -> Any:
            message = self._converter.unpack(value)
            if self._takes_info:
                return self.callback(
                    message, {"source_timestamp": stamp, "received_timestamp": stamp}
                )
            return self.callback(message)

        return work

    def withdraw(self) -> None:
        """Stop listening."""
        super().withdraw()
        self._stop()
        self._queue.clear()
        if self in self.node.graph.subscriptions.get(self.full, []):
            self.node.graph.subscriptions[self.full].remove(self)


def _takes_two(callback: Callable[..., Any]) -> bool:
    try:
        inspect.signature(callback).bind(object())
    except TypeError:
        try:
            inspect.signature(callback).bind(object(), object())
        except TypeError:
            return False
        return True
    except ValueError:
        return False
    return False


class TimerInfo:
    """When a timer was due, and when it was called."""

    def __init__(self, expected: Time, actual: Time) -> None:
        self.expected_call_time = expected
        self.actual_call_time = actual


class Timer(Entity):
    """Calls back on an integer grid; the first time one period after it is made."""

    def __init__(
        self,
        node: "Node",
        callback: Callable[..., Any] | None,
        period_ns: int,
        group: Any,
        autostart: bool = True,
    ) -> None:
        super().__init__(node, group)
        self.callback: Callable[..., Any] | None = callback
        self._period = period_ns
        self._last = node.clock_now()
        self.due = self._last + period_ns
        self._canceled = not autostart
        self._takes_info = callback is not None and not _takes_none(callback)

    @property
    def timer_period_ns(self) -> int:
        """The time between two calls, nanoseconds."""
        return self._period

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        def change() -> None:
            self._period = int(value)

        self.node.program.ask(change)

    @property
    def clock(self) -> Any:
        """The clock it goes by."""
        return self.node.get_clock()

    def ready(self) -> bool:
        """Whether it is due."""
        return not self._canceled and self.due <= self.node.clock_now()

    def is_ready(self) -> bool:
        """Whether it is due."""
        return self.ready()

    def take(self) -> Work:
        """The callback; the next moment is the first of the grid to come."""
        now, due = self.node.clock_now(), self.due
        self._last = now
        self.due += self._period
        if self.due < now:
            missed = -(-(now - self.due) // self._period) if self._period else 0
            self.due = self.due + missed * self._period if self._period else now

        def work() -> Any:
            if self.callback is None:
                return None
            if self._takes_info:
                return self.callback(TimerInfo(Time(nanoseconds=due), Time(nanoseconds=now)))
            return self.callback()

        return work

    def cancel(self) -> None:
        """Call no more, until `reset`."""
        self._canceled = True

    def is_canceled(self) -> bool:
        """Whether it was cancelled."""
        return self._canceled

    def reset(self) -> None:
        """Start again: the next call is one period from now."""

        def restart() -> None:
            self._canceled = False
            self.due = self.node.clock_now() + self._period
            self.node.wake()

        self.node.program.ask(restart)

    def time_since_last_call(self) -> int:
        """Nanoseconds since the last call."""
        return self.node.clock_now() - self._last

    def time_until_next_call(self) -> int | None:
        """Nanoseconds until the next call, None when cancelled."""
        return None if self._canceled else self.due - self.node.clock_now()


def _takes_none(callback: Callable[..., Any]) -> bool:
    try:
        inspect.signature(callback).bind()
    except TypeError:
        return False
    except ValueError:
        return True
    return True


class GuardCondition(Entity):
    """Calls back when triggered."""

    def __init__(self, node: "Node", callback: Callable[[], Any], group: Any) -> None:
        super().__init__(node, group)
        self.callback = callback
        self._triggered = False

    def trigger(self) -> None:
        """Have the callback called soon."""

        def set_off() -> None:
            self._triggered = True
            self.node.wake()

        self.node.program.ask(set_off)

    def ready(self) -> bool:
        """Whether it was triggered."""
        return self._triggered

    def take(self) -> Work:
        """The callback."""
        self._triggered = False
        return self.callback


def period_of(seconds_or_duration: Any) -> int:
    """A timer's period in nanoseconds, from seconds or a Duration."""
    if isinstance(seconds_or_duration, Duration):
        return seconds_or_duration.nanoseconds
    return int(float(seconds_or_duration) * 1_000_000_000)
