"""Typed topics within one process, goals of actions, and servers of services and actions.

Delivery is direct: `publish` calls every subscriber, in order of subscription, and then returns.
"""

import asyncio
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Generic, Literal, TypeVar

from tftool.base.errors import TftoolError
from tftool.buffer.callbacks import Listeners, Report
from tftool.world.endpoints import Endpoint

T = TypeVar("T")

Status = Literal["succeeded", "aborted", "canceled"]


class Topic(Generic[T]):
    """Named stream of values of one type, which stores its last value.

    Attributes:
        name: Name of the topic, without a leading slash.
        kind: Type of the values.
        count: Number of values that were published.
        latest: Value that was published last; None before the first value.
        on_demand: Function called when a subscriber is added or removed; None without a connection.
        sender: Publisher of the value that is being delivered; None if unknown.
        relay: Function that sends values to other processes, called after all subscribers; None
            without a connection.
        far_subscribers: Number of subscribers in other processes.
        is_far: Whether only other processes use the topic.
        is_removed: Whether the world has removed the topic. A newer topic can have the same name.
    """

    __slots__ = (
        "_subscribers",
        "count",
        "far_subscribers",
        "is_far",
        "is_removed",
        "kind",
        "latest",
        "name",
        "on_demand",
        "relay",
        "sender",
    )

    def __init__(self, name: str, kind: type[T], report: Report | None = None) -> None:
        """Create a topic without a value; `report` is called with exceptions of subscribers."""
        self.name = name
        self.kind = kind
        self.latest: T | None = None
        self.count = 0
        self.on_demand: Callable[[], object] | None = None
        self.sender: Endpoint | None = None
        self.relay: Callable[[T], object] | None = None
        self.far_subscribers = 0
        self.is_far = False
        self.is_removed = False
        self._subscribers: Listeners[T] = Listeners(report)

    def publish(self, value: T, sender: Endpoint | None = None) -> None:
        """Store a value, and pass the value to every subscriber.

        Raises:
            TypeError: If `value` is not of the topic's kind.
        """
        if not isinstance(value, self.kind):
            raise TypeError(
                f"topic '{self.name}' has messages of type {self.kind.__name__}, not "
                f"{type(value).__name__}"
            )
        self.latest = value
        self.count += 1
        relay = self.relay
        before, self.sender = self.sender, sender
        try:
            self._subscribers.call(value)
            if relay is not None:
                relay(value)
        finally:
            self.sender = before

    def subscribe(self, callback: Callable[[T], object], owner: str = "") -> Callable[[], None]:
        """Call `callback` with every further value; return a function that ends the calls.

        Exceptions of the callback are reported under the name `owner`, not raised in the publisher.
        """
        withdraw = self._subscribers.add(callback, owner)
        is_there = True
        if self.on_demand is not None:
            self.on_demand()

        def stop() -> None:
            nonlocal is_there
            if is_there:
                is_there = False
                withdraw()
                if self.on_demand is not None:
                    self.on_demand()

        return stop

    @property
    def subscribers(self) -> int:
        """Number of subscribers, including subscribers in other processes."""
        return len(self._subscribers.registered) + self.far_subscribers

    @property
    def near_subscribers(self) -> int:
        """Number of subscribers in this process."""
        return len(self._subscribers)

    def stream(self, depth: int = 100) -> AsyncIterator[T]:
        """Yield each new value; a reader more than `depth` values behind loses the oldest."""
        return streamed(self.subscribe, depth)


async def streamed(
    subscribe: Callable[[Callable[[T], object]], Callable[[], None]], depth: int
) -> AsyncIterator[T]:
    """Yield a subscription's values; a reader more than `depth` values behind loses the oldest."""
    waiting: deque[T] = deque(maxlen=depth)
    arrived = asyncio.Event()

    def keep(value: T) -> None:
        waiting.append(value)
        arrived.set()

    stop = subscribe(keep)
    try:
        while True:
            while waiting:
                yield waiting.popleft()
            arrived.clear()
            await arrived.wait()
    finally:
        stop()


Handler = Callable[[Any], Any | Awaitable[Any]]
"""Function that responds to a service's request, at once or as a coroutine."""


@dataclass(frozen=True, slots=True)
class GoalResult:
    """Result of a goal of an action.

    Attributes:
        status: Final state of the goal: "succeeded", "aborted" or "canceled".
        value: Result message of the action.
    """

    status: Status
    value: Any


class GoalHandle:
    """Goal of an action, shared by its client and its server.

    Attributes:
        request: Goal message.
        cancel_requested: Whether the client has requested the cancellation and the server has
            accepted.
        feedback: Last feedback; None before the first feedback.
        on_cancel: Function called when the client requests the cancellation; the server then calls
            `decide_cancel`. None if every cancellation is accepted.
        decided: Future of the server's decision to accept the goal; None if every goal is accepted.
        patience: Seconds to wait until a server in another process accepts the goal or a
            cancellation; None for no limit.
        goal_id: Id of 16 bytes.
        feeds: Functions called with each feedback.
    """

    def __init__(
        self,
        request: Any,
        on_feedback: Callable[[Any], object] | None = None,
        patience: float | None = None,
        goal_id: bytes = bytes(16),
    ) -> None:
        self.request = request
        self.goal_id = goal_id
        self.feeds = [] if on_feedback is None else [on_feedback]
        self.cancel_requested = False
        self.feedback: Any = None
        self.on_cancel: Callable[[], object] | None = None
        self.decided: asyncio.Future[bool] | None = None
        self.patience = patience
        self._cancellation: asyncio.Future[bool] | None = None
        self._result: asyncio.Future[GoalResult] = asyncio.get_running_loop().create_future()

    # The client's side.

    def cancel(self) -> None:
        """Request the server to cancel the goal.

        Nothing is sent if the goal has ended, or if an earlier request was accepted or is not
        decided yet. After a rejection, the request is sent again.
        """
        considered = self._cancellation is not None and not self._cancellation.done()
        if self.done or self.cancel_requested or considered:
            return
        self._cancellation = asyncio.get_running_loop().create_future()
        if self.on_cancel is None:
            self.decide_cancel(True)
        else:
            self.on_cancel()

    async def cancellation(self) -> bool:
        """Wait for the decision on the last cancel request; return True if accepted."""
        return self._cancellation is not None and await asyncio.shield(self._cancellation)

    async def result(self) -> GoalResult:
        """Wait for the end of the goal, and return its result."""
        return await asyncio.shield(self._result)

    @property
    def done(self) -> bool:
        """Whether the goal has ended."""
        return self._result.done()

    @property
    def ended(self) -> GoalResult | None:
        """Result of the goal; None while the goal runs."""
        return self._result.result() if self.done else None

    # The server's side.

    def publish_feedback(self, value: Any) -> None:
        """Send a feedback message to the client."""
        self.feedback = value
        for feed in self.feeds:
            feed(value)

    def decide_cancel(self, accepted: bool) -> None:
        """Accept or reject a request to cancel the goal; only the first decision counts."""
        if self._cancellation is not None and not self._cancellation.done():
            self.cancel_requested = accepted
            self._cancellation.set_result(accepted)

    def finish(self, status: Status, value: Any) -> None:
        """End the goal with a state and a result; only the first call counts."""
        if not self.done:
            self.decide_cancel(status == "canceled")
            self._result.set_result(GoalResult(status, value))


Acceptor = Callable[[Any], None]
"""Function that accepts a goal, and later ends it with `finish`."""


@dataclass(frozen=True, slots=True)
class Offer(Generic[T]):
    """Server of a service or an action.

    Attributes:
        take: Function that responds to requests or accepts goals.
        kind: ROS class of the service or action; None for a server that accepts any request, for
            this process only.
        node: Name of the server's node; "" if not given.
        is_remote: Whether the server is in another process. A server of this process takes
            precedence.
    """

    take: T
    kind: Any = None
    node: str = ""
    is_remote: bool = False


class NamedOffers(Generic[T]):
    """Servers of services or of actions, by name; the first server of a name is active.

    Attributes:
        by_name: Active server of each name, read-only.
    """

    def __init__(self, what: str, changed: Callable[[], object]) -> None:
        """Create an empty store of service servers or of action servers.

        Args:
            what: "service" or "action", the word for error messages.
            changed: Function called when a server is added or removed.
        """
        self._what = what
        self._changed = changed
        self._first: dict[str, Offer[T]] = {}
        self._next: dict[str, list[Offer[T]]] = {}
        self.by_name: Mapping[str, Offer[T]] = MappingProxyType(self._first)

    def add(self, name: str, offer: Offer[T], *, shares: bool) -> Callable[[], None]:
        """Add a server; return a function that removes the server.

        Args:
            name: Name of the service or action.
            offer: The server.
            shares: Whether this process may have several servers of that name.

        Raises:
            TftoolError: If this process has another server of that name and `shares` is false.
        """
        name = name.removeprefix("/")
        if name in self._first and not self._first[name].is_remote:
            if not shares:
                raise TftoolError(
                    f"{self._what} '{name}' already has a server: choose another name"
                )
            self._next.setdefault(name, []).append(offer)
        else:
            self._first[name] = offer
            self._changed()

        def stop() -> None:
            later = [one for one in self._next.pop(name, ()) if one is not offer]
            leads = self._first.get(name) is offer
            if leads:
                del self._first[name]
                if later:
                    self._first[name] = later.pop(0)
            if later:
                self._next[name] = later
            if leads:
                self._changed()

        return stop

    def get(self, name: str) -> Offer[T] | None:
        """Return the active server of a name; None without a server."""
        return self._first.get(name.removeprefix("/"))

    def count(self, name: str) -> int:
        """Return the number of servers of a name."""
        plain = name.removeprefix("/")
        return (plain in self._first) + len(self._next.get(plain, ()))
