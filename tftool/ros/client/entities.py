"""What a node has: publishers, subscriptions, timers, clients, services, guard conditions.

Each keeps what arrived until an executor takes it. `ready` and `take` run on the
loop's thread; what `take` returns runs on the fiber that spins.
"""

import asyncio
import inspect
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tftool.errors import TftoolError
from tftool.ros import values
from tftool.ros.client.futures import Future
from tftool.ros.client.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tftool.ros.client.time import Duration, Time
from tftool.ros.interfaces.classes import Message, duplicate
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


class Client(Entity):
    """Asks a service."""

    # An answer completes a future and runs nobody's callback by itself, so whoever
    # waits for it inside a callback gets it.
    passes_busy_group = True

    def __init__(self, node: "Node", kind: Any, name: str, full: str, group: Any) -> None:
        super().__init__(node, group)
        self.srv_type = kind
        self.srv_name = name
        self.full = full
        self._answers: deque[tuple[Future, Any, BaseException | None]] = deque()
        self._tasks: set[asyncio.Task[None]] = set()
        self._pending: set[Future] = set()

    @property
    def service_name(self) -> str:
        """The service's full name."""
        return f"/{self.full}"

    def service_is_ready(self) -> bool:
        """Whether somebody serves it."""
        ready = bool(self.node.program.ask(lambda: self.node.world.has_service(self.full)))
        if not ready:
            self.node.program.looked_in_vain()
        return ready

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Block until somebody serves it; whether somebody does."""
        return self.node.wait_until(lambda: self.node.world.has_service(self.full), timeout_sec)

    def call_async(self, request: Any) -> Future:
        """Ask; the answer comes while somebody spins.

        Raises:
            TypeError: If the request is of another type.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(f"Expected {self.srv_type.Request}, got {type(request)}")
        future = Future(executor=self.node.executor)
        copy = duplicate(request)
        self._pending.add(future)

        def send() -> None:
            task = asyncio.get_running_loop().create_task(self._call(copy, future))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

        self.node.program.ask(send)
        return future

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Ask, and block until the answer is there; None if it takes longer than allowed.

        Unlike in ROS 2 this may be called inside a callback.
        """
        future = self.call_async(request)
        self.node.wait_for(future, timeout_sec)
        return future.result()

    def remove_pending_request(self, future: Future) -> None:
        """Wait no longer for an answer."""
        self._pending.discard(future)
        future.cancel()

    async def _call(self, request: Any, future: Future) -> None:
        world = self.node.world
        # As in ROS 2, a request nobody serves yet waits for nobody: it stays unanswered.
        handler = world.services().get(self.full)
        if handler is None:
            return
        served_here = getattr(handler, "serves_ros", False)
        try:
            if served_here:
                answer = await world.call(self.full, request)
            else:
                answer = await world.call(
                    self.full, values.pack_request(self.srv_type, self.full, request)
                )
            self._answers.append((future, values.unpack_response(self.srv_type, answer), None))
        except TftoolError as error:
            self._answers.append((future, None, error))
        self.node.wake()

    def ready(self) -> bool:
        """Whether an answer waits."""
        return bool(self._answers)

    def take(self) -> Work:
        """Complete the future of the oldest answer."""
        future, answer, error = self._answers.popleft()

        def work() -> None:
            self._pending.discard(future)
            if future.cancelled():
                return
            if error is not None:
                future.set_exception(error)
            else:
                future.set_result(answer)

        return work

    def withdraw(self) -> None:
        """Wait for no answer any more."""
        super().withdraw()
        for task in list(self._tasks):
            task.cancel()


class _ServiceHandler:
    """What the world calls for a service that a ROS node serves."""

    serves_ros = True

    def __init__(self, service: "Service") -> None:
        self._service = service

    async def __call__(self, request: Any) -> Any:
        return await self._service.asked(request)


class Service(Entity):
    """Answers a service."""

    def __init__(
        self,
        node: "Node",
        kind: Any,
        name: str,
        full: str,
        callback: Callable[[Any, Any], Any],
        group: Any,
    ) -> None:
        super().__init__(node, group)
        self.srv_type = kind
        self.srv_name = name
        self.full = full
        self.callback = callback
        self._requests: deque[tuple[Any, asyncio.Future[Any], bool]] = deque()
        self._open: set[asyncio.Future[Any]] = set()
        self._stop = node.world.serve(full, _ServiceHandler(self))

    @property
    def service_name(self) -> str:
        """The service's full name."""
        return f"/{self.full}"

    async def asked(self, request: Any) -> Any:
        """Keep a request until an executor takes it; its answer."""
        answer: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        ours = not isinstance(request, Message)
        self._requests.append((values.unpack_request(self.srv_type, request), answer, ours))
        self._open.add(answer)
        self.node.wake()
        try:
            return await answer
        finally:
            self._open.discard(answer)

    def ready(self) -> bool:
        """Whether a request waits."""
        return bool(self._requests)

    def take(self) -> Work:
        """The callback with the oldest request."""
        request, answer, ours = self._requests.popleft()

        def work() -> Any:
            response = self.callback(request, self.srv_type.Response())
            if inspect.iscoroutine(response):
                return self._later(response, answer, ours)
            self._send(response, answer, ours)
            return None

        return work

    async def _later(self, response: Any, answer: "asyncio.Future[Any]", ours: bool) -> None:
        self._send(await response, answer, ours)

    def _send(self, response: Any, answer: "asyncio.Future[Any]", ours: bool) -> None:
        if not isinstance(response, self.srv_type.Response):
            raise TypeError(
                f"the callback of service '{self.srv_name}' must return a "
                f"{self.srv_type.__name__}.Response, not {type(response).__name__}"
            )
        packed = values.pack_response(self.srv_type, response, ours=ours)

        def send() -> None:
            if not answer.done():
                answer.set_result(packed)

        self.node.program.ask(send)

    def withdraw(self) -> None:
        """Serve no more; who still waits is told that no answer will come."""
        super().withdraw()
        self._stop()
        for answer in self._open:
            if not answer.done():
                answer.set_exception(TftoolError(f"the node that served '{self.full}' has left"))


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
