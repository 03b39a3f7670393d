"""Base class of nodes: a node is one coroutine, `run`, that waits on its world's clock."""

import asyncio
import inspect
from collections.abc import AsyncIterator, Callable, Coroutine
from functools import cached_property
from typing import Any, ClassVar, TypeVar

from tftool.base.stamps import Duration, Stamp, as_seconds, seconds, whole
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.world.clock import Clock, FollowedClock, Phase
from tftool.world.endpoints import TF, TF_STATIC, USUAL, Quality
from tftool.world.node_parameters import Parameters, Value
from tftool.world.supervisor import Resident
from tftool.world.world import TopicPublisher, TransformMessage, World

T = TypeVar("T")

CATCH_UP = 5
"""Number of missed times that a timer catches up on before its schedule shifts."""

PATIENCE = 5.0
"""Seconds that a node waits for a response from another process."""

LATE = seconds(1.0)
"""Delay of a timer, in nanoseconds, from which a warning is logged."""


class Node(Resident):
    """Base of nodes: override `run`, and wait with `every` or the clock.

    Attributes:
        world: World that the node belongs to.
        name: Name in logs, also the authority of the node's transforms.
        rank: Number of the node in the order of joining the world.
        clock: Clock that the node waits on: the world's clock, unless another one is set.
        phase: Phase in which the clock wakes the node, if several nodes are due at the same time.
    """

    phase: ClassVar[Phase] = Phase.CONSUME

    def __init__(self, world: World, name: str) -> None:
        """Add the node to a world under a name.

        Raises:
            TftoolError: If the world has a node of that name already.
            TypeError: If the class has no coroutine `run`. An object of `Node` itself needs no
                `run`, because other code can publish and subscribe under the node's name.
        """
        kind = type(self)
        if kind is not Node:
            if kind.run is Node.run:
                raise TypeError(
                    f"{kind.__name__} has no 'async def run(self)', so it would do nothing: write "
                    "one; 'pass' is enough for a node that only listens"
                )
            if not inspect.iscoroutinefunction(kind.run):
                raise TypeError(f"{kind.__name__}.run must be written 'async def run(self)'")
        self.world = world
        self.name = name
        self.rank = 0
        self.clock: Clock = world.clock
        self._stops: list[Callable[[], None]] = []
        self._publishers: dict[str, TopicPublisher[Any]] = {}
        world.add(self)

    @cached_property
    def parameters(self) -> Parameters:
        """Parameters of the node."""
        return Parameters(self.name)

    @property
    def buffer(self) -> Buffer:
        """Transform buffer of the node's world."""
        return self.world.buffer

    async def run(self) -> None:
        """Do the node's work; the node ends when this coroutine returns."""

    def start_soon(self, work: Coroutine[Any, Any, T]) -> "asyncio.Task[T | None]":
        """Run a coroutine concurrently with `run`, as part of this node.

        The coroutine can outlast `run`, and is cancelled when the node is removed or the world
        ends. An exception of the coroutine makes this node fail.

        Returns:
            The task; its result is None if the coroutine failed.

        Raises:
            TftoolError: If the world is not running.
        """
        return self.world.start_soon(self, work)

    async def every(self, period: Duration, *, immediately: bool = False) -> AsyncIterator[Stamp]:
        """Yield the times of a timer, at exact multiples of the period from now on.

        The first time is one period from now, as for a ROS timer. If a node is a few periods late,
        the missed times follow without a wait. If a node is later, the missed times are skipped.
        The first skip of a second or more is logged.

        Args:
            period: Nanoseconds between two times.
            immediately: Whether the first time is now.

        Raises:
            TypeError: If the period is not a whole number.
            ValueError: If the period is not positive.
        """
        period = whole(period)
        if period <= 0:
            raise ValueError(f"a timer's period must be positive, not {period} ns")
        due = self.clock.now() if immediately else self.clock.now() + period
        slipped = False
        while True:
            await self.clock.sleep_until(due, self.phase, self.rank)
            # A clock set from outside may have fallen back: the schedule restarts at its time.
            due = min(due, self.clock.now())
            missed = (self.clock.now() - due) // period
            if missed > CATCH_UP:
                due += missed * period
                # A short delay is not reported, because the user cannot avoid it. A clock that
                # another process sets may jump.
                is_told = isinstance(self.clock, FollowedClock) and self.clock.is_told
                if not (slipped or is_told) and missed * period >= LATE:
                    slipped = True
                    self.warn(
                        f"is {as_seconds(missed * period):.1f} s behind its own timer, because "
                        "the computer was too busy or suspended the process: the missed calls "
                        "are skipped"
                    )
            yield due
            due += period

    # Talking

    def publish(self, topic: str, value: Any) -> None:
        """Publish a value on a topic; a missing topic is created with the value's type."""
        publisher = self._publishers.get(topic)
        if publisher is None or publisher.kind is not type(value):
            publisher = self.publisher(topic, type(value))
        publisher.publish(value)

    def publisher(self, topic: str, kind: type[T], quality: Quality = USUAL) -> TopicPublisher[T]:
        """Register this node as a publisher of a topic, until the node ends."""
        publisher = self.world.publisher(self.name, topic, kind, quality)
        self._publishers[topic] = publisher
        self._until_end(publisher.close)
        return publisher

    def subscribe(
        self,
        topic: str,
        kind: type[T],
        callback: Callable[[T], object],
        quality: Quality = USUAL,
    ) -> Callable[[], None]:
        """Call `callback` with each message of a topic; return a function that ends the calls.

        A latched subscription gets earlier messages too. If `callback` raises, this node fails.
        """
        return self._until_end(self.world.subscribe(self.name, topic, kind, callback, quality))

    def serve(
        self, name: str, handler: Callable[[Any], Any], kind: Any = None, *, shares: bool = False
    ) -> Callable[[], None]:
        """Serve a service until this node ends; the arguments are those of `World.serve`."""
        return self._until_end(self.world.serve(name, handler, kind, node=self.name, shares=shares))

    def serve_action(
        self, name: str, accept: Callable[[Any], None], kind: Any = None
    ) -> Callable[[], None]:
        """Accept an action's goals until this node ends; for `kind`, see `World.serve`."""
        return self._until_end(self.world.serve_action(name, accept, kind, node=self.name))

    async def call(self, service: str, request: Any) -> Any:
        """Call a service and wait for its response; see `World.call`.

        The wait for a server of another process is limited to `PATIENCE` seconds.
        """
        return await self.world.call(service, request, patience=PATIENCE)

    def broadcast(self, *transforms: TransformStamped) -> bool:
        """Broadcast transforms in this node's name; return whether all were accepted."""
        if "tf" not in self._publishers:
            self.publisher("tf", TransformMessage, TF)
        return self.world.broadcast(transforms, self.name)

    def broadcast_static(self, *transforms: TransformStamped) -> bool:
        """Broadcast static transforms in this node's name; return whether all were accepted."""
        if "tf_static" not in self._publishers:
            self.publisher("tf_static", TransformMessage, TF_STATIC)
        return self.world.broadcast(transforms, self.name, static=True)

    def info(self, text: str) -> None:
        """Log a message of this node with level INFO."""
        self.world.log.info(self.name, text)

    def warn(self, text: str) -> None:
        """Log a message of this node with level WARN."""
        self.world.log.warn(self.name, text)

    def error(self, text: str) -> None:
        """Log a message of this node with level ERROR."""
        self.world.log.error(self.name, text)

    # Settings

    def declare_parameter(self, name: str, default: Value) -> Value:
        """Declare a parameter; return `default`, or the value if declared before."""
        return self.parameters.declare(name, default)

    def get_parameter(self, name: str) -> Value:
        """Return a parameter's value."""
        return self.parameters[name]

    def set_parameter(self, name: str, value: Value) -> None:
        """Change a declared parameter; see `Parameters.set`."""
        self.parameters.set(name, value)

    def close(self) -> None:
        """Close the node's subscriptions, publishers and services; called when the node ends."""
        while self._stops:
            self._stops.pop()()
        self._publishers.clear()

    def _until_end(self, stop: Callable[[], None]) -> Callable[[], None]:
        self._stops.append(stop)
        return stop
