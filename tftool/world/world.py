"""World of nodes: one clock, one transform buffer, topics, services, actions, a log."""

import asyncio
import inspect
import itertools
import secrets
from collections import deque
from collections.abc import Callable, Coroutine, Iterable, Mapping
from types import MappingProxyType
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

from tftool.base.errors import LinkError, NodeFailed, TftoolError
from tftool.base.stamps import CACHE_TIME, Duration, Stamp, whole
from tftool.buffer.buffer import Buffer
from tftool.buffer.callbacks import Listeners, listener_text
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import interface_name, is_part
from tftool.world import transform_wait as waiting
from tftool.world.clock import Clock, SimClock, run
from tftool.world.endpoints import (
    PUBLISHER,
    SUBSCRIPTION,
    USUAL,
    Endpoint,
    Endpoints,
    Quality,
    Role,
)
from tftool.world.log import Log, Repeats
from tftool.world.memory_limit import MemoryBound, allowed
from tftool.world.supervisor import Resident, Supervisor, live
from tftool.world.topics import Acceptor, GoalHandle, Handler, NamedOffers, Offer, Topic

T = TypeVar("T")


class _Transforms(NamedTuple):
    transforms: tuple[TransformStamped, ...]
    authority: str


class TransformMessage(_Transforms):
    """Value of the topics `tf` and `tf_static`: transforms, and the name of their sender."""

    __slots__ = ()

    interface__: ClassVar[str] = "tf2_msgs/msg/TFMessage"


class TopicPublisher(Generic[T]):
    """Publisher of one node on one topic.

    Attributes:
        name: Name of the topic, without a leading slash.
        kind: Type of the values.
    """

    __slots__ = ("_endpoint", "_topic", "_withdraw", "_world", "kind", "name")

    def __init__(
        self, world: "World", node: str, name: str, kind: type[T], quality: Quality
    ) -> None:
        self.name = name.removeprefix("/")
        self.kind = kind
        self._world = world
        # Topics of transforms store their messages separately.
        latched = quality.is_latched and kind is not TransformMessage
        self._endpoint, self._withdraw = world.enter(
            PUBLISHER, node, self.name, kind, quality, keeps=latched
        )
        self._topic: Topic[T] | None = None

    def publish(self, value: T) -> None:
        """Publish a value. If the topic has been removed, create the topic again."""
        topic = self._topic
        if topic is None or topic.is_removed:
            topic = self._topic = self._world.topic(self.name, self.kind)
        endpoint = self._endpoint
        if endpoint is not None and endpoint.kept is not None:
            endpoint.kept.append(value)
        topic.publish(value, endpoint)

    @property
    def subscribers(self) -> int:
        """Number of subscribers of the topic, including subscribers in other processes."""
        topic = self._topic
        if topic is None or topic.is_removed:
            topic = self._topic = self._world.topic(self.name, self.kind)
        return topic.subscribers

    def close(self) -> None:
        """Close the publisher, so that the node is no longer listed as a publisher of the topic."""
        self._withdraw()


class World:
    """Shared state of the nodes of one process: clock, transform buffer, topics, services, log.

    Attributes:
        clock: Clock of the world.
        buffer: Transform buffer of the world.
        memory: Limit on the memory that the buffer's samples use.
        log: Log of the nodes.
        nodes: Nodes, in the order of joining.
        endpoints: Publishers and subscriptions of the nodes of all processes.
        clients: Clients of services, of the nodes of all processes.
        far_nodes: Names of the nodes of other processes, in alphabetical order.
        failure: Error that names the node whose exception ended the run; None if no node failed.
        has_own_time: Whether users' nodes ignore `use_sim_time` and `/clock`, because the time of
            this world is the time of a simulation: on simulated time, and in a scenario.
    """

    def __init__(
        self,
        clock: Clock,
        buffer: Buffer | None = None,
        *,
        cache_time: Duration = CACHE_TIME,
        max_bytes: int | None = None,
    ) -> None:
        """Create a world without nodes.

        Args:
            clock: Clock of the world.
            buffer: Transform buffer to use; None for a new buffer.
            cache_time: Cache time of a new buffer, nanoseconds.
            max_bytes: Largest number of bytes for the buffer's samples; None for the limit of
                `memory_limit.allowed`.
        """
        self.clock = clock
        self.has_own_time = isinstance(clock, SimClock)
        self.log = Log(clock.now, report=self.report)
        self._is_reporting = False
        self.buffer = buffer or Buffer(cache_time, log=self._log_buffer, report=self.report)
        self.memory = MemoryBound(
            self.buffer, lambda text: self.log.warn("buffer", text), max_bytes or allowed()
        )
        self._watchers: Listeners[()] = Listeners(self.report)
        self._changed = self._watchers.call
        self.nodes: list[Resident] = []
        self._joined = 0
        self._topics: dict[str, Topic[Any]] = {}
        self._services: NamedOffers[Handler] = NamedOffers("service", self._changed)
        self._deferred: list[tuple[Resident, Callable[[], object]]] = []
        self._actions: NamedOffers[Acceptor] = NamedOffers("action", self._changed)
        self._goal_numbers = itertools.count(1)
        self._goal_watchers: dict[str, Listeners[GoalHandle]] = {}
        # Errors of the buffer that repeat, by the code at the beginning of the text.
        self._refused: dict[str, Repeats] = {}
        self._failed_listeners = Repeats()
        self._statics: dict[str, dict[str, TransformStamped]] = {}
        self._far_statics: dict[str, TransformStamped] = {}
        self.far_nodes: tuple[str, ...] = ()
        self.failure: NodeFailed | None = None
        self._supervisor: Supervisor | None = None
        self.endpoints = Endpoints(self._changed, self.log.warn)
        self.clients = Endpoints(self._changed, self.log.warn)
        self.tf: Topic[TransformMessage] = self._topic("tf", TransformMessage)
        self.tf_static: Topic[TransformMessage] = self._topic("tf_static", TransformMessage)

    # Topics

    def topic(self, name: str, kind: type[T]) -> Topic[T]:
        """Return the topic with a name; create the topic at the first use.

        Args:
            name: Name of the topic, with or without a leading slash.
            kind: Type of the values.

        Raises:
            TftoolError: If the topic exists with another type.
        """
        topic = self._topic(name.removeprefix("/"), kind)
        topic.is_far = False
        return topic

    def name_topic(self, name: str, kind: type[Any]) -> None:
        """Add a topic that only other processes use, so that lists of topics show it."""
        self._topic(name, kind).is_far = True

    def _topic(self, name: str, kind: type[Any]) -> Topic[Any]:
        topic = self._topics.get(name)
        if topic is None:
            topic = self._topics[name] = Topic(name, kind, self.report)
            self._changed()
        elif topic.kind is not kind:
            carried, named = (interface_name(one) or one.__name__ for one in (topic.kind, kind))
            raise TftoolError(f"topic '{name}' has the type {carried}, not {named}")
        return topic

    def publisher(
        self, node: str, name: str, kind: type[T], quality: Quality = USUAL
    ) -> TopicPublisher[T]:
        """Register a node as a publisher of a topic.

        Args:
            node: Name of the node.
            name: Name of the topic.
            kind: Type of the values.
            quality: Offered quality of service.
        """
        return TopicPublisher(self, node, name, kind, quality)

    def subscribe(
        self,
        node: str,
        name: str,
        kind: type[T],
        callback: Callable[[T], object],
        quality: Quality = USUAL,
    ) -> Callable[[], None]:
        """Register a node as a subscriber of a topic; return a function that ends the subscription.

        Args:
            node: Name of the node, under which an exception of the callback is reported.
            name: Name of the topic.
            kind: Type of the values.
            callback: Function called with every further value.
            quality: Requested quality of service. A latched subscription gets earlier messages of
                latched publishers: at once from this process, later from other processes.
        """
        topic = self.topic(name, kind)
        taken: Callable[[Any], object] = callback
        deliver: Callable[[Any, Endpoint | None], object] | None = None
        if quality.is_latched and kind is not TransformMessage:

            def deliver(value: Any, _sender: Endpoint | None) -> object:
                return callback(value)

            def taken(value: Any) -> object:
                # Messages of other processes are passed to `deliver`.
                sender = topic.sender
                if sender is not None and sender.is_remote:
                    return None
                return callback(value)

        # Before the subscription: otherwise other processes see a subscriber without a name.
        _, withdraw = self.enter(SUBSCRIPTION, node, topic.name, kind, quality, deliver=deliver)
        stop = topic.subscribe(taken, node)
        if deliver is not None:
            for publisher in self.endpoints.of(topic.name, PUBLISHER):
                for value in publisher.kept or ():
                    deliver(value, publisher)

        def both() -> None:
            stop()
            withdraw()

        return both

    def enter(
        self,
        role: Role,
        node: str,
        name: str,
        kind: type[Any],
        quality: Quality,
        *,
        keeps: bool = False,
        deliver: Callable[[Any, Endpoint | None], object] | None = None,
    ) -> tuple[Endpoint | None, Callable[[], None]]:
        """Register a publisher or subscription in the graph, if the topic has a ROS type.

        Args:
            role: Whether to register a publisher or a subscription.
            node: Name of the node.
            name: Name of the topic.
            kind: Type of the values.
            quality: Offered or requested quality of service.
            keeps: Whether a publisher stores its messages for late subscribers.
            deliver: Function that passes an earlier message and its publisher to a latched
                subscription.

        Returns:
            The endpoint (None for a topic without a ROS type), and a function that removes the
            endpoint.
        """
        interface = str(getattr(kind, "interface__", ""))
        if not interface:
            return None, _nothing
        kept: deque[Any] | None = deque(maxlen=max(1, quality.depth)) if keeps else None
        endpoint = Endpoint(role, node, name, interface, quality, deliver=deliver, kept=kept)
        return endpoint, self.endpoints.add(endpoint)

    def topics(self) -> Mapping[str, Topic[Any]]:
        """Return every topic by name, read-only."""
        return MappingProxyType(self._topics)

    def remove_topic(self, name: str) -> None:
        """Remove a topic; new subscribers get no values that are published on the old `Topic`."""
        name = name.removeprefix("/")
        topic = self._topics.pop(name, None)
        if topic is not None:
            topic.is_removed = True
            self._changed()

    # Services and actions

    def serve(
        self,
        name: str,
        handler: Handler,
        kind: Any = None,
        *,
        node: str = "",
        is_remote: bool = False,
        shares: bool = False,
    ) -> Callable[[], None]:
        """Serve a service with `handler`; return a function that stops the server.

        Args:
            name: Name of the service.
            handler: Function that responds to a request, at once or as a coroutine. If the
                function returns None, the response has default values.
            kind: ROS class of the service; None if only this process may call it.
            node: Name of the server's node.
            is_remote: Whether the server is in another process.
            shares: Whether this process may have several servers of that name, as in ROS. The first
                server responds; after this server has left, the second responds.

        Raises:
            TftoolError: If a node of this process serves that name already and `shares` is false.
        """
        return self._services.add(name, Offer(handler, kind, node, is_remote), shares=shares)

    def serve_later(self, node: Resident, serve: Callable[[], object]) -> None:
        """Call `serve`, which adds services, before any service is next looked up or called.

        Every ROS 2 node has services for its parameters, but few programs use them. If `node` is
        removed before, `serve` is not called.
        """
        self._deferred.append((node, serve))
        self._changed()

    @property
    def _served(self) -> NamedOffers[Handler]:
        # `serve` may look services up. The list is therefore emptied first: otherwise each node
        # would serve from within the one before it, and many nodes exceed the limit of recursion.
        deferred, self._deferred = self._deferred, []
        for _, serve in deferred:
            serve()
        return self._services

    def has_service(self, name: str) -> bool:
        """Return whether any node serves a service."""
        return self._served.get(name) is not None

    def count_services(self, name: str) -> int:
        """Return the number of servers of a service; all servers in other processes count as 1."""
        return self._served.count(name)

    def services(self) -> Mapping[str, Offer[Handler]]:
        """Return every service by name, read-only."""
        return self._served.by_name

    async def call(self, name: str, request: Any, *, patience: float | None = None) -> Any:
        """Call a service and wait for its response.

        Args:
            name: Name of the service.
            request: Request message.
            patience: Seconds to wait for a server in another process; None for no limit.

        Raises:
            TftoolError: If no node serves that name, or the request is of another type.
            LinkError: If another process does not respond in time.
        """
        offer = self._served.get(name)
        if offer is None:
            raise TftoolError(f"no node serves '{name}'")
        kind = offer.kind
        if kind is not None:
            _require(request, "Request", kind, f"service '{name}'")
        try:
            async with asyncio.timeout(patience if offer.is_remote else None) as limit:
                answer = offer.take(request)
                if inspect.isawaitable(answer):
                    answer = await answer
        except TimeoutError:
            if not limit.expired():
                raise
            raise LinkError(
                f"service '{name}': no server answered within {patience:g} s, or all have left"
            ) from None
        return kind.Response() if answer is None and kind is not None else answer

    def serve_action(
        self,
        name: str,
        accept: Acceptor,
        kind: Any = None,
        *,
        node: str = "",
        is_remote: bool = False,
        shares: bool = False,
    ) -> Callable[[], None]:
        """Accept goals of an action with `accept`; return a function that stops the server.

        For the arguments, see `serve`.

        Raises:
            TftoolError: If a node of this process serves that action already and `shares` is false.
        """
        return self._actions.add(name, Offer(accept, kind, node, is_remote), shares=shares)

    def actions(self) -> Mapping[str, Offer[Acceptor]]:
        """Return every action by name, read-only."""
        return self._actions.by_name

    def watch_goals(
        self, name: str, callback: Callable[[GoalHandle], object], owner: str = ""
    ) -> Callable[[], None]:
        """Call `callback` with each goal of an action, before the server receives the goal.

        Return a function that ends the calls. Exceptions of the callback are reported under the
        name `owner`.
        """
        return self._goal_watchers.setdefault(name, Listeners(self.report)).add(callback, owner)

    def new_goal_id(self) -> bytes:
        """Return a goal id of 16 bytes: random, as the goals of all processes need different ids.

        On simulated time, which no other process shares, equal runs use equal ids.
        """
        if isinstance(self.clock, SimClock):
            return next(self._goal_numbers).to_bytes(16, "big")
        return secrets.token_bytes(16)

    def send_goal(
        self,
        name: str,
        goal: Any,
        on_feedback: Callable[[Any], object] | None = None,
        *,
        patience: float | None = None,
        goal_id: bytes | None = None,
    ) -> GoalHandle:
        """Send a goal to an action's server; return a handle for the goal.

        Args:
            name: Name of the action.
            goal: Goal message.
            on_feedback: Function called with each feedback.
            patience: Seconds to wait until another process accepts the goal; None for no limit.
            goal_id: Id of 16 bytes for the goal; None for a new id.

        Raises:
            TftoolError: If no node serves that action, or the goal is of another type.
        """
        offer = self._actions.get(name)
        if offer is None:
            raise TftoolError(f"no node serves the action '{name}'")
        if offer.kind is not None:
            _require(goal, "Goal", offer.kind, f"action '{name}'")
        handle = GoalHandle(goal, on_feedback, patience, goal_id or self.new_goal_id())
        if name in self._goal_watchers:
            self._goal_watchers[name].call(handle)
        offer.take(handle)
        return handle

    def watch(self, callback: Callable[[], object], owner: str = "") -> Callable[[], None]:
        """Call `callback` when a topic, service, action or node is added or removed.

        For a new topic, the call comes before the first value. Return a function that ends the
        calls. Exceptions of the callback are reported under the name `owner`.
        """
        return self._watchers.add(callback, owner)

    # Transforms

    def broadcast(
        self, transforms: Iterable[TransformStamped], authority: str, *, static: bool = False
    ) -> bool:
        """Insert transforms into the buffer, and publish the transforms on `tf` or `tf_static`.

        Transforms that the buffer rejects (with a log message) are not published. A message on
        `tf_static` contains all static transforms of the sender, the newest of each child frame,
        because a late subscriber gets only the sender's last message.

        Returns:
            Whether the buffer accepted all transforms.
        """
        sent = tuple(transforms)
        if static:
            held = self._statics.setdefault(authority, {})
            accepted = self._store_static(sent, authority, held)
            if accepted:
                self.tf_static.publish(TransformMessage(tuple(held.values()), authority))
        else:
            put = self.buffer.set_transform
            accepted = tuple([one for one in sent if put(one, authority)])
            self.memory.note(len(accepted))
            if accepted:
                self.tf.publish(TransformMessage(accepted, authority))
        return len(accepted) == len(sent)

    def receive_static(
        self, transforms: Iterable[TransformStamped], authority: str
    ) -> tuple[TransformStamped, ...]:
        """Store static transforms from another process, also for late subscribers in this process.

        Returns:
            The transforms that the buffer accepted.
        """
        return self._store_static(transforms, authority, self._far_statics)

    def _store_static(
        self,
        transforms: Iterable[TransformStamped],
        authority: str,
        held: dict[str, TransformStamped],
    ) -> tuple[TransformStamped, ...]:
        accepted = tuple(
            one for one in transforms if self.buffer.set_transform_static(one, authority)
        )
        held.update((one.child_frame_id, one) for one in accepted)
        return accepted

    def static_transforms(self, authority: str | None = None) -> tuple[TransformStamped, ...]:
        """Return the static transforms of one sender in this process.

        If `authority` is None, return the static transforms of all senders in all processes.
        """
        if authority is not None:
            return tuple(self._statics.get(authority, {}).values())
        held = [self._far_statics, *self._statics.values()]
        return tuple(transform for one in held for transform in one.values())

    async def wait_for_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Stamp = 0,
        timeout: Duration | None = None,
    ) -> TransformStamped:
        """Return a transform as soon as the buffer has the transform; see `transform_wait`."""
        return await waiting.wait_for_transform(
            self.buffer, self.clock, target_frame, source_frame, time, timeout
        )

    async def wait_for_transform_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
        timeout: Duration | None = None,
    ) -> TransformStamped:
        """Return a transform between frames at two times once available; see `transform_wait`."""
        return await waiting.wait_for_transform_full(
            self.buffer,
            self.clock,
            target_frame,
            target_time,
            source_frame,
            source_time,
            fixed_frame,
            timeout,
        )

    # Nodes

    def add(self, node: Resident) -> None:
        """Add a node; in a running world, the node starts at once.

        Raises:
            TftoolError: If the world has a node of that name.
        """
        if self.free_name(node.name) != node.name:
            raise TftoolError(f"a node named '{node.name}' exists already: choose another name")
        node.rank = self._joined
        self._joined += 1
        self.nodes.append(node)
        self._changed()
        if self._supervisor is not None:
            self._supervisor.start(node)

    def start_soon(self, node: Resident, work: Coroutine[Any, Any, T]) -> "asyncio.Task[T | None]":
        """Run a coroutine as part of a node; see `Node.start_soon`.

        Raises:
            TftoolError: If the world is not running.
        """
        if self._supervisor is None:
            work.close()
            raise TftoolError(
                f"node '{node.name}' cannot start work, because its world does not run: start the "
                "world first"
            )
        return self._supervisor.start_soon(node, work)

    def free_name(self, wanted: str) -> str:
        """Return the name `wanted`, with a number appended if a node already has this name."""
        taken = {node.name for node in self.nodes}
        name, number = wanted, 1
        while name in taken:
            number += 1
            name = f"{wanted}_{number}"
        return name

    def remove(self, node: Resident) -> None:
        """Remove a node; in a running world, the node is stopped."""
        self._deferred = [one for one in self._deferred if one[0] is not node]
        if node in self.nodes:
            self.nodes.remove(node)
            self._changed()
        if self._supervisor is not None:
            self._supervisor.end(node)

    def know_far_nodes(self, names: Iterable[str]) -> None:
        """Store the names of the nodes that run in other processes."""
        found = tuple(sorted(set(names)))
        if found != self.far_nodes:
            self.far_nodes = found
            self._changed()

    def node(self, name: str) -> Resident:
        """Return the node with a name.

        Raises:
            TftoolError: If no node has that name.
        """
        for node in self.nodes:
            if node.name == name:
                return node
        raise TftoolError(f"no node is named '{name}'")

    def run(self, duration: Duration | None = None) -> None:
        """Run the nodes for a duration from now on; call this outside any event loop.

        `world.run(seconds(10))` is `run(clock, live(world, until=clock.now() + seconds(10)))`.

        Args:
            duration: Nanoseconds of the world's clock; None to run until `stop` or the end of the
                last node.

        Raises:
            NodeFailed: If a node raised an exception; see `live`.
            TypeError: If the duration is not a whole number.
            ValueError: If the duration is negative.
        """
        until = None
        if duration is not None:
            if whole(duration) < 0:
                raise ValueError(f"a world cannot run for a negative duration: {duration} ns")
            until = self.clock.now() + whole(duration)
        run(self.clock, live(self, until=until))

    def stop(self) -> None:
        """End the run: `live` cancels the nodes that still run, and returns."""
        if self._supervisor is not None:
            self._supervisor.stop()

    def fail(self, node: Resident, error: BaseException) -> None:
        """Report that a node raised an exception outside its `run`, for example in a callback.

        Raises:
            BaseException: `error` itself, if the world is not running.
        """
        if self._supervisor is None:
            raise error
        self._supervisor.fail(node, error)

    def report(self, owner: str, failure: Exception) -> None:
        """Handle a listener's exception: end the run if a node owns the listener, else log a text.

        Args:
            owner: Name of the listener's owner.
            failure: The exception.

        Raises:
            Exception: `failure` itself, if the owner is a node and the world is not running.
        """
        for node in self.nodes:
            if node.name == owner:
                self.fail(node, failure)
                return
        if isinstance(failure, BrokenPipeError) and self._supervisor is not None:
            # The reader of a listener's output has ended, so the run is ended.
            self._supervisor.end_by(failure)
        elif not self._is_reporting:
            # A listener of the log that fails at every message would fail at this one, too.
            self._is_reporting = True
            try:
                text = listener_text("", failure)
                # A listener may fail at every message, so its error is not always logged.
                if text := self._failed_listeners.said(f"{owner}: {text}", text):
                    self.log.error(owner or "world", text)
            finally:
                self._is_reporting = False

    def _log_buffer(self, level: str, text: str) -> None:
        # A node whose transforms are rejected usually sends them at a high rate, and one with
        # corrupt data sends a new frame name each time.
        code = text.partition(" ")[0]
        kind = text.partition(" because ")[0].partition(" at time ")[0]
        kinds = self._refused.setdefault(code, Repeats())
        text = kinds.said(kind, text)
        if not text:
            return
        if level == "ERROR":
            self.log.error("buffer", text)
        else:
            self.log.warn("buffer", text)


def _nothing() -> None:
    """Do nothing, in place of a function that removes an endpoint."""


def _require(message: Any, part: str, kind: Any, what: str) -> None:
    """Check that a service's request or an action's goal is of the right type.

    Raises:
        TftoolError: If the request or goal is of another type.
    """
    if not is_part(message, part, kind):
        given = getattr(message, "interface__", "") or type(message).__name__
        raise TftoolError(f"{what} is of type {kind.interface__}, which takes no {given}")
