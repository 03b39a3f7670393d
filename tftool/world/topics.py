"""Typed topics within one process, goals of actions, and servers by name.

Delivery is a direct call: `publish` calls every subscriber, in the order of subscription, before it
returns.
"""

import asyncio
import itertools
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Generic, Literal, TypeVar

from tftool.base.errors import TftoolError
from tftool.base.listeners import Listeners, Report
from tftool.world.endpoints import Endpoint

T = TypeVar("T")

Status = Literal["succeeded", "aborted", "canceled"]


class Topic(Generic[T]):
    """A named stream of values of one type that keeps its last value.

    Attributes:
        name: The topic's name, without a leading slash.
        kind: The type every value has.
        count: Number of values were published.
        latest: The value published last, None before the first.
        on_demand: Called when a subscriber is added or removed; None without a link.
        sender: The publisher of the value that is being delivered; None when not known.
        relay: Function that sends values to other processes, called last; None without a link.
        far_subscribers: Number of listen in other processes.
        is_far: Whether it is here only to be listed: other processes have it, and it was not
            asked for by its name here.
        is_removed: Whether the world has removed the topic: another one may have its name by now.
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
        """Start without a value; `report` receives subscribers' exceptions, see `Listeners`."""
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
        """Store `value` and pass it to every subscriber at once, with its sender if known.

        Raises:
            TypeError: If `value` is not of the topic's kind.
        """
        if not isinstance(value, self.kind):
            raise TypeError(
                f"topic '{self.name}' carries {self.kind.__name__}, not {type(value).__name__}"
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
        """Call `callback` with every further value until the returned function is called.

        Its exceptions are reported under the name of its `owner`, and do not reach the publisher.
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
        """Return the present number of subscribers, including other processes'."""
        return len(self._subscribers.registered) + self.far_subscribers

    @property
    def near_subscribers(self) -> int:
        """Return the number of subscribers in this process."""
        return len(self._subscribers)

    def stream(self, depth: int = 100) -> AsyncIterator[T]:
        """Yield each new value. A reader more than `depth` values behind loses the oldest."""
        return streamed(self.subscribe, depth)


async def streamed(
    subscribe: Callable[[Callable[[T], object]], Callable[[], None]], depth: int
) -> AsyncIterator[T]:
    """Yield a subscription's messages; a reader slower than `depth` loses the oldest."""
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
"""Answers a service's request, now or when awaited."""


@dataclass(frozen=True, slots=True)
class GoalResult:
    """Result of an action.

    Attributes:
        status: "succeeded", "aborted" or "canceled".
        value: The action's result.
    """

    status: Status
    value: Any


_NUMBERS = itertools.count(1)


def new_goal_id() -> bytes:
    """Return sixteen bytes for a goal, counted so that equal runs give equal ids."""
    return next(_NUMBERS).to_bytes(16, "big")


class GoalHandle:
    """One goal of an action, shared by its client and its server.

    Attributes:
        request: The request.
        cancel_requested: Whether the client wants it stopped, and the server agreed.
        feedback: The last feedback, None before the first.
        on_cancel: Called when the client wants it stopped, for a server that decides about that
            by `decide_cancel`; None for one that always agrees.
        decided: Whether the server takes the goal, once it has decided; None for one that
            takes every goal.
        patience: Seconds to wait for the server of another process to take the goal or a
            cancellation; None for as long as it takes.
        goal_id: Sixteen bytes.
        feeds: Functions called with each feedback.
    """

    def __init__(
        self,
        request: Any,
        on_feedback: Callable[[Any], object] | None = None,
        patience: float | None = None,
        goal_id: bytes | None = None,
    ) -> None:
        self.request = request
        self.goal_id = goal_id or new_goal_id()
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
        """Ask the server to stop.

        Does nothing once the goal has ended, or while a cancellation is considered or accepted;
        a server that refused is asked again.
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
        """Wait for the server's answer to the last cancellation; return whether it agrees."""
        return self._cancellation is not None and await asyncio.shield(self._cancellation)

    async def result(self) -> GoalResult:
        """Wait for the result."""
        return await asyncio.shield(self._result)

    @property
    def done(self) -> bool:
        """Whether the goal has ended."""
        return self._result.done()

    @property
    def ended(self) -> GoalResult | None:
        """Return the goal's result; None while it runs."""
        return self._result.result() if self.done else None

    # The server's side.

    def publish_feedback(self, value: Any) -> None:
        """Send progress to the client."""
        self.feedback = value
        for feed in self.feeds:
            feed(value)

    def decide_cancel(self, accepted: bool) -> None:
        """Decide whether the goal will be stopped; the first answer to a cancellation counts."""
        if self._cancellation is not None and not self._cancellation.done():
            self.cancel_requested = accepted
            self._cancellation.set_result(accepted)

    def finish(self, status: Status, value: Any) -> None:
        """End the goal; the first end counts."""
        if not self.done:
            self.decide_cancel(status == "canceled")
            self._result.set_result(GoalResult(status, value))


Acceptor = Callable[[Any], None]
"""Takes a goal over; it ends it with `finish`."""


@dataclass(frozen=True, slots=True)
class Offer(Generic[T]):
    """A service or an action.

    Attributes:
        take: Function that answers requests or takes goals.
        kind: The ROS class of the service or action. None where it is not stated; it stays inside
            the process then, and takes anything.
        node: The node that answers, "" where it is not stated.
        is_remote: Whether another process answers; a server here takes its place.
    """

    take: T
    kind: Any = None
    node: str = ""
    is_remote: bool = False


class NamedOffers(Generic[T]):
    """Services or actions by name, with their servers in order of succession.

    Attributes:
        by_name: Offers by name, read-only.
    """

    def __init__(self, what: str, changed: Callable[[], object]) -> None:
        """Start empty.

        Args:
            what: Kind: "service", "action".
            changed: Called when an offer is added or removed.
        """
        self._what = what
        self._changed = changed
        self._first: dict[str, Offer[T]] = {}
        self._next: dict[str, list[Offer[T]]] = {}
        self.by_name: Mapping[str, Offer[T]] = MappingProxyType(self._first)

    def add(self, name: str, offer: Offer[T], *, shares: bool) -> Callable[[], None]:
        """Add a server; call the returned function to remove it.

        Args:
            name: Name.
            offer: The offer.
            shares: Whether another of this process may have that name already.

        Raises:
            TftoolError: If another has, and it may not.
        """
        name = name.removeprefix("/")
        if name in self._first and not self._first[name].is_remote:
            if not shares:
                raise TftoolError(f"{self._what} '{name}' already has a server")
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
        """Return the active server; None if there is none."""
        return self._first.get(name.removeprefix("/"))

    def count(self, name: str) -> int:
        """Return the number of servers."""
        plain = name.removeprefix("/")
        return (plain in self._first) + len(self._next.get(plain, ()))
