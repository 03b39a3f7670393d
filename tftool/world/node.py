"""A node: one coroutine, `run`, in a world; it waits on the world's clock only."""

import asyncio
import inspect
from collections.abc import AsyncIterator, Callable, Coroutine
from typing import Any, ClassVar, TypeVar

from tftool.base.stamps import Duration, Stamp, as_seconds, seconds, whole
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.world.clock import Clock, Phase
from tftool.world.endpoints import TF, TF_STATIC, USUAL, Quality
from tftool.world.node_parameters import Parameters, Value
from tftool.world.supervisor import Resident
from tftool.world.world import TopicPublisher, TransformMessage, World

T = TypeVar("T")

CATCH_UP = 5
"""How many late ticks of a timer are made up for before it slips."""

PATIENCE = 5.0
"""Seconds that nodes of ours wait for an answer from another process."""

LATE = seconds(1.0)
"""From how far behind a timer on it is said."""


class Node(Resident):
    """Base of nodes: override `run`, and wait with `every` or the clock.

    Attributes:
        world: World.
        name: Its name, in logs and as the authority of its transforms.
        rank: Number among the nodes of the world, in the order of joining.
        phase: Place within an instant.
    """

    phase: ClassVar[Phase] = Phase.CONSUME
    _is_passive: ClassVar[bool] = False

    def __init__(self, world: World, name: str) -> None:
        """Join `world` as `name`.

        Raises:
            TftoolError: If a node of that name is there.
            TypeError: If its class has no coroutine `run`. A plain `Node` needs none: code
                outside publishes and subscribes under its name.
        """
        kind = type(self)
        if kind is not Node and not self._is_passive:
            if kind.run is Node.run:
                raise TypeError(
                    f"{kind.__name__} has no 'async def run(self)', so it would do nothing: "
                    "a node that only listens writes 'pass' in it"
                )
            if not inspect.iscoroutinefunction(kind.run):
                raise TypeError(f"{kind.__name__}.run must be written 'async def run(self)'")
        self.world = world
        self.name = name
        self.rank = 0
        self.parameters = Parameters(name)
        self._stops: list[Callable[[], None]] = []
        self._publishers: dict[str, TopicPublisher[Any]] = {}
        world.add(self)

    @property
    def clock(self) -> Clock:
        """The world's clock."""
        return self.world.clock

    @property
    def buffer(self) -> Buffer:
        """The world's buffer."""
        return self.world.buffer

    async def run(self) -> None:
        """Run the node; it ends when this returns."""

    def start_soon(self, work: Coroutine[Any, Any, T]) -> "asyncio.Task[T | None]":
        """Run something concurrently with `run`, as part of this node.

        It may outlast `run`, and is cancelled when the node leaves or the world ends. Its exception
        is the failure of this node.

        Returns:
            The task; its result is None where the work has failed.

        Raises:
            TftoolError: If the world does not run.
        """
        return self.world.start_soon(self, work)

    async def every(self, period: Duration, *, immediately: bool = False) -> AsyncIterator[Stamp]:
        """Yield the times of a timer, at exact multiples of the period from now on.

        The first tick is one period from now, as for a ROS timer. On the wall clock, a late node
        makes up a few missed ticks, then the schedule shifts; a delay of a second is logged, once.

        Args:
            period: Nanoseconds between two moments.
            immediately: Whether the first moment is now.

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
            # A clock set from outside may have fallen back meanwhile: the grid restarts there.
            due = min(due, self.clock.now())
            missed = (self.clock.now() - due) // period
            if missed > CATCH_UP:
                due += missed * period
                # A short hitch is nothing a person can do anything about.
                if not slipped and missed * period >= LATE:
                    slipped = True
                    self.warn(
                        f"is {as_seconds(missed * period):.1f} s behind its own timer: "
                        "the computer was too busy, or stopped it; the missed calls are skipped"
                    )
            yield due
            due += period

    # Talking

    def publish(self, topic: str, value: Any) -> None:
        """Publish on a topic; a new topic is created with the value's type."""
        publisher = self._publishers.get(topic)
        if publisher is None or publisher.kind is not type(value):
            publisher = self.publisher(topic, type(value))
        publisher.publish(value)

    def publisher(self, topic: str, kind: type[T], quality: Quality = USUAL) -> TopicPublisher[T]:
        """Register as a publisher of a topic until this node ends, before the first message."""
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
        """Call `callback` with every message; if it raises, this node has failed.

        A latched subscription gets what latched publishers sent before, too.
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
        """Accept an action's goals until this node ends; `kind` is as in `serve`."""
        return self._until_end(self.world.serve_action(name, accept, kind, node=self.name))

    async def call(self, service: str, request: Any) -> Any:
        """Call a service and wait for its response; see `World.call`.

        A server of another process has `PATIENCE`.
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
        """Log information."""
        self.world.log.info(self.name, text)

    def warn(self, text: str) -> None:
        """Log a warning."""
        self.world.log.warn(self.name, text)

    def error(self, text: str) -> None:
        """Log an error."""
        self.world.log.error(self.name, text)

    # Settings

    def declare_parameter(self, name: str, default: Value) -> Value:
        """Declare a parameter with its default."""
        return self.parameters.declare(name, default)

    def get_parameter(self, name: str) -> Value:
        """Return a parameter's value."""
        return self.parameters[name]

    def set_parameter(self, name: str, value: Value) -> None:
        """Change a parameter; see `Parameters.set`."""
        self.parameters.set(name, value)

    def close(self) -> None:
        """Close every subscription and service; the supervisor calls it at the end."""
        while self._stops:
            self._stops.pop()()
        self._publishers.clear()

    def _until_end(self, stop: Callable[[], None]) -> Callable[[], None]:
        self._stops.append(stop)
        return stop
