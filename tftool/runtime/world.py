"""The world nodes live in: one clock, one buffer, topics, services, actions, a log."""

import asyncio
import inspect
from collections import deque
from collections.abc import Callable, Coroutine, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, Generic, TypeVar, cast

from tftool.errors import NodeFailed, TftoolError
from tftool.frames.buffer import Buffer
from tftool.frames.sample import TransformStamped
from tftool.listeners import Listeners, listener_text
from tftool.runtime import waiting
from tftool.runtime.clock import Clock
from tftool.runtime.endpoints import (
    PUBLISHER,
    SUBSCRIPTION,
    USUAL,
    Endpoint,
    Endpoints,
    Quality,
    Role,
)
from tftool.runtime.log import Log
from tftool.runtime.offers import Offer
from tftool.runtime.resident import Resident, Supervision
from tftool.runtime.topics import Acceptor, GoalHandle, Handler, Topic
from tftool.stamps import Duration, Stamp, seconds

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class TransformMessage:
    """What travels on topics `tf` and `tf_static`: transforms and who sent them."""

    interface__: ClassVar[str] = "tf2_msgs/msg/TFMessage"

    transforms: tuple[TransformStamped, ...]
    authority: str


class TopicPublisher(Generic[T]):
    """What one node publishes on one topic.

    Attributes:
        name: The topic's name, without a leading slash.
        kind: The type of every value.
    """

    __slots__ = ("_endpoint", "_withdraw", "_world", "kind", "name")

    def __init__(
        self, world: "World", node: str, name: str, kind: type[T], quality: Quality
    ) -> None:
        self.name = name.removeprefix("/")
        self.kind = kind
        self._world = world
        # Those of tf have a memory of their own.
        latched = quality.is_latched and kind is not TransformMessage
        self._endpoint, self._withdraw = world.enter(
            PUBLISHER, node, self.name, kind, quality, keeps=latched
        )

    def publish(self, value: T) -> None:
        """Publish a value, on a topic that is made anew where it was removed meanwhile."""
        if self._endpoint is not None and self._endpoint.kept is not None:
            self._endpoint.kept.append(value)
        self._world.topic(self.name, self.kind).publish(value, self._endpoint)

    @property
    def subscribers(self) -> int:
        """How many subscribe to the topic, those in other processes included."""
        return self._world.topic(self.name, self.kind).subscribers

    def close(self) -> None:
        """Publish no more: the node is no publisher of that topic any longer."""
        self._withdraw()


class World:
    """Everything the nodes of one process share.

    Attributes:
        clock: Whose time everything here means.
        buffer: What is known of frames.
        log: What the nodes said.
        nodes: The nodes, in the order in which they joined.
        endpoints: Which node publishes and subscribes what, of all processes.
        far_nodes: Names of the nodes of other processes, in alphabetical order.
        failure: The node that ended it by what it raised, as soon as that is known.
    """

    def __init__(
        self,
        clock: Clock,
        buffer: Buffer | None = None,
        *,
        cache_time: Duration = seconds(10),
    ) -> None:
        self.clock = clock
        self.log = Log(clock.now, report=self.report)
        self._is_reporting = False
        self.buffer = buffer or Buffer(cache_time, log=self._log_buffer, report=self.report)
        self.nodes: list[Resident] = []
        self._joined = 0
        self._topics: dict[str, Topic[Any]] = {}
        self._services: dict[str, Offer[Handler]] = {}
        self._actions: dict[str, Offer[Acceptor]] = {}
        self._statics: dict[str, dict[str, TransformStamped]] = {}
        self._far_statics: dict[str, TransformStamped] = {}
        self.far_nodes: tuple[str, ...] = ()
        self.failure: NodeFailed | None = None
        self._supervisor: Supervision | None = None
        self._watchers: Listeners[()] = Listeners(self.report)
        self.endpoints = Endpoints(self._changed, self.log.warn)
        self.tf = self.topic("tf", TransformMessage)
        self.tf_static = self.topic("tf_static", TransformMessage)

    # Topics

    def topic(self, name: str, kind: type[T]) -> Topic[T]:
        """The topic of that name, made when it is first named.

        Raises:
            TftoolError: If it is there already and carries something else.
        """
        name = name.removeprefix("/")
        topic = self._topics.get(name)
        if topic is None:
            topic = self._topics[name] = Topic(name, kind, self.report)
            self._changed()
        elif topic.kind is not kind:
            raise TftoolError(f"topic '{name}' carries {topic.kind.__name__}, not {kind.__name__}")
        topic.is_far = False
        return cast("Topic[T]", topic)

    def publisher(
        self, node: str, name: str, kind: type[T], quality: Quality = USUAL
    ) -> TopicPublisher[T]:
        """Enter a node as a publisher of a topic.

        Args:
            node: Its name.
            name: The topic's name.
            kind: The type of what it publishes.
            quality: What it offers.
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
        """Enter a node as a subscriber of a topic; call what is returned to stop.

        Args:
            node: Its name, under which a failure of the callback is reported.
            name: The topic's name.
            kind: The type of what is published there.
            callback: Called with every value to come.
            quality: What it asks for. A latched one gets at once what latched publishers of
                this process sent before, and what those of others did as soon as it comes.
        """
        topic = self.topic(name, kind)
        taken: Callable[[T], object] = callback
        deliver: Callable[[Any, Endpoint | None], object] | None = None
        if quality.is_latched and kind is not TransformMessage:

            def deliver(value: Any, _sender: Endpoint | None) -> object:
                return callback(value)

            def taken(value: T) -> object:
                # What other processes send comes by `deliver`.
                sender = topic.sender
                if sender is not None and sender.is_remote:
                    return None
                return callback(value)

        # Entered first: the link shows a subscriber without a name for what is not.
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
        """Enter an end of a topic among the endpoints; what stays in the process has none.

        Args:
            role: Which end.
            node: Whose.
            name: The topic's name.
            kind: The type of its values.
            quality: What it offers, or asks for.
            keeps: Whether a publisher keeps what it sent for late subscribers.
            deliver: Takes what others sent a latched subscription before.

        Returns:
            The endpoint, and what takes it out again.
        """
        interface = str(getattr(kind, "interface__", ""))
        if not interface:
            return None, _nothing
        kept: deque[Any] | None = deque(maxlen=max(1, quality.depth)) if keeps else None
        endpoint = Endpoint(role, node, name, interface, quality, deliver=deliver, kept=kept)
        return endpoint, self.endpoints.add(endpoint)

    def topics(self) -> Mapping[str, Topic[Any]]:
        """Every topic by its name, read-only."""
        return MappingProxyType(self._topics)

    def remove_topic(self, name: str) -> None:
        """Forget a topic; what is published on a `Topic` still held reaches no new subscriber."""
        if self._topics.pop(name.removeprefix("/"), None) is not None:
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
    ) -> Callable[[], None]:
        """Answer a service by `handler`; call what is returned to stop.

        Args:
            name: The service's name.
            handler: Answers a request, now or when awaited.
            kind: What is asked, for those in other processes; see `Offer`.
            node: The node that answers.
            is_remote: Whether it answers from another process.

        Raises:
            TftoolError: If a node here serves that name already.
        """
        offer = Offer(handler, kind, node, is_remote)
        return self._offer(self._services, name, offer, "service")

    def has_service(self, name: str) -> bool:
        """Whether any node answers that service."""
        return name.removeprefix("/") in self._services

    def services(self) -> Mapping[str, Offer[Handler]]:
        """Every service by its name, read-only."""
        return MappingProxyType(self._services)

    async def call(self, name: str, request: Any) -> Any:
        """Ask a service and wait for its answer.

        Raises:
            TftoolError: If no node serves that name.
        """
        offer = self._services.get(name.removeprefix("/"))
        if offer is None:
            raise TftoolError(f"no node serves '{name}'")
        response = offer.take(request)
        return await response if inspect.isawaitable(response) else response

    def serve_action(
        self,
        name: str,
        accept: Acceptor,
        kind: Any = None,
        *,
        node: str = "",
        is_remote: bool = False,
    ) -> Callable[[], None]:
        """Take goals of an action by `accept`; call what is returned to stop.

        The arguments are those of `serve`.

        Raises:
            TftoolError: If a node here serves that action already.
        """
        offer = Offer(accept, kind, node, is_remote)
        return self._offer(self._actions, name, offer, "action")

    def actions(self) -> Mapping[str, Offer[Acceptor]]:
        """Every action by its name, read-only."""
        return MappingProxyType(self._actions)

    async def send_goal(
        self, name: str, goal: Any, on_feedback: Callable[[Any], object] | None = None
    ) -> GoalHandle:
        """Hand a goal to an action's server.

        Raises:
            TftoolError: If no node serves that action.
        """
        offer = self._actions.get(name.removeprefix("/"))
        if offer is None:
            raise TftoolError(f"no node serves the action '{name}'")
        handle = GoalHandle(goal, on_feedback)
        offer.take(handle)
        return handle

    def watch(self, callback: Callable[[], object], owner: str = "") -> Callable[[], None]:
        """Have `callback` called when a topic, service, action or node comes or goes.

        It is called before the first value on a new topic. Call what is returned to stop.
        What it raises is reported under the name of its `owner`.
        """
        return self._watchers.add(callback, owner)

    def _changed(self) -> None:
        self._watchers.call()

    def _offer(
        self, offers: dict[str, Offer[T]], name: str, offer: Offer[T], what: str
    ) -> Callable[[], None]:
        name = name.removeprefix("/")
        if name in offers and not offers[name].is_remote:
            raise TftoolError(f"{what} '{name}' is served already")
        offers[name] = offer
        self._changed()

        def stop() -> None:
            if offers.get(name) is offer:
                del offers[name]
                self._changed()

        return stop

    # Transforms

    def broadcast(
        self, transforms: Iterable[TransformStamped], authority: str, *, static: bool = False
    ) -> bool:
        """Put transforms into the buffer and publish them on `tf` or `tf_static`.

        What the buffer refuses (and says why) goes no further. A static message always
        holds all statics of its sender, the newest of each child, as a late listener
        sees nothing but a sender's last message.

        Returns:
            Whether the buffer took them all.
        """
        sent = tuple(transforms)
        if static:
            held = self._statics.setdefault(authority, {})
            accepted = self._store_static(sent, authority, held)
            if accepted:
                self.tf_static.publish(TransformMessage(tuple(held.values()), authority))
        else:
            accepted = tuple(one for one in sent if self.buffer.set_transform(one, authority))
            if accepted:
                self.tf.publish(TransformMessage(accepted, authority))
        return len(accepted) == len(sent)

    def receive_static(
        self, transforms: Iterable[TransformStamped], authority: str
    ) -> tuple[TransformStamped, ...]:
        """Store the statics of another process's node, for late subscribers here as well.

        Returns:
            What the buffer took.
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
        """The static transforms of one sender here, or of all, in the order they became known."""
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
        """The transform as soon as it can be given; see `waiting.wait_for_transform`."""
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
        """The transform between two moments; see `waiting.wait_for_transform_full`."""
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
        """Let a node join; in a world that lives already it starts at once.

        Raises:
            TftoolError: If a node of that name is here.
        """
        if any(other.name == node.name for other in self.nodes):
            raise TftoolError(f"a node named '{node.name}' is here already")
        node.rank = self._joined
        self._joined += 1
        self.nodes.append(node)
        self._changed()
        if self._supervisor is not None:
            self._supervisor.start(node)

    def start_soon(self, node: Resident, work: Coroutine[Any, Any, T]) -> "asyncio.Task[T | None]":
        """Run something as a part of a node; see `Node.start_soon`.

        Raises:
            TftoolError: If the world does not run.
        """
        if self._supervisor is None:
            work.close()
            raise TftoolError(f"node '{node.name}' can start no work: its world does not run")
        return self._supervisor.start_soon(node, work)

    def free_name(self, wanted: str) -> str:
        """A name no node has: the wanted one, or that with a number behind it."""
        taken = {node.name for node in self.nodes}
        name, number = wanted, 1
        while name in taken:
            number += 1
            name = f"{wanted}_{number}"
        return name

    def remove(self, node: Resident) -> None:
        """Stop a node and let it leave."""
        if node in self.nodes:
            self.nodes.remove(node)
            self._changed()
        if self._supervisor is not None:
            self._supervisor.end(node)

    def know_far_nodes(self, names: Iterable[str]) -> None:
        """Note which nodes live in other processes."""
        found = tuple(sorted(set(names)))
        if found != self.far_nodes:
            self.far_nodes = found
            self._changed()

    def node(self, name: str) -> Resident:
        """The node of that name.

        Raises:
            TftoolError: If there is none.
        """
        for node in self.nodes:
            if node.name == name:
                return node
        raise TftoolError(f"no node is named '{name}'")

    def stop(self) -> None:
        """End the run: `live` returns as soon as the current step is over."""
        if self._supervisor is not None:
            self._supervisor.stop()

    def fail(self, node: Resident, error: BaseException) -> None:
        """Report that a node raised outside its `run`, in a callback for example.

        Raises:
            BaseException: `error` itself, while the world does not run.
        """
        if self._supervisor is None:
            raise error
        self._supervisor.fail(node, error)

    def report(self, owner: str, failure: Exception) -> None:
        """Take what a listener raised: its owner has failed if it is a node, else the log tells.

        Args:
            owner: The name of the listener's owner.
            failure: What it raised.

        Raises:
            Exception: `failure` itself, if the owner is a node and the world does not run.
        """
        for node in self.nodes:
            if node.name == owner:
                self.fail(node, failure)
                return
        if isinstance(failure, BrokenPipeError) and self._supervisor is not None:
            # The reader of what a listener prints has gone: the run has no purpose any more.
            self._supervisor.end_by(failure)
        elif not self._is_reporting:
            # A listener of the log that fails at every line fails at this one, too.
            self._is_reporting = True
            try:
                self.log.error(owner or "world", listener_text("", failure))
            finally:
                self._is_reporting = False

    def supervise(self, supervision: Supervision | None) -> None:
        """Name who starts and stops nodes from now on (the supervisor's own call)."""
        self._supervisor = supervision

    def _log_buffer(self, level: str, text: str) -> None:
        if level == "ERROR":
            self.log.error("buffer", text)
        else:
            self.log.warn("buffer", text)


def _nothing() -> None:
    """Take nothing out."""
