"""The world nodes live in: one clock, one buffer, topics, services, actions, a log."""

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeVar, cast

from tftool.errors import NodeFailed, TftoolError
from tftool.frames.buffer import Buffer
from tftool.frames.sample import TransformStamped
from tftool.runtime import waiting
from tftool.runtime.clock import Clock
from tftool.runtime.endpoints import Endpoints
from tftool.runtime.log import Log
from tftool.runtime.offers import Offer
from tftool.runtime.resident import Resident, Supervision
from tftool.runtime.topics import Acceptor, GoalHandle, Handler, Topic
from tftool.stamps import Duration, Stamp, seconds

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class TransformMessage:
    """What travels on topics `tf` and `tf_static`: transforms and who sent them."""

    transforms: tuple[TransformStamped, ...]
    authority: str


class World:
    """Everything the nodes of one process share.

    Attributes:
        clock: Whose time everything here means.
        buffer: What is known of frames.
        log: What the nodes said.
        nodes: Those who joined, in order.
        endpoints: Who publishes and subscribes what, of those who say.
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
        self.log = Log(clock.now)
        self.buffer = buffer or Buffer(cache_time, log=self._log_buffer)
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
        self._watchers: tuple[Callable[[], object], ...] = ()
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
            topic = self._topics[name] = Topic(name, kind)
            self._changed()
        elif topic.kind is not kind:
            raise TftoolError(f"topic '{name}' carries {topic.kind.__name__}, not {kind.__name__}")
        topic.is_far = False
        return cast("Topic[T]", topic)

    def topics(self) -> Mapping[str, Topic[Any]]:
        """Every topic by its name, read-only."""
        return MappingProxyType(self._topics)

    def remove_topic(self, name: str) -> None:
        """Forget a topic; who still holds it talks to nobody."""
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
            TftoolError: If somebody here serves that name already.
        """
        offer = Offer(handler, kind, node, is_remote)
        return self._offer(self._services, name, offer, "service")

    def has_service(self, name: str) -> bool:
        """Whether somebody answers that service."""
        return name.removeprefix("/") in self._services

    def services(self) -> Mapping[str, Offer[Handler]]:
        """Every service by its name, read-only."""
        return MappingProxyType(self._services)

    async def call(self, name: str, request: Any) -> Any:
        """Ask a service and wait for its answer.

        Raises:
            TftoolError: If nobody serves that name.
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
            TftoolError: If somebody here serves that action already.
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
            TftoolError: If nobody serves that action.
        """
        offer = self._actions.get(name.removeprefix("/"))
        if offer is None:
            raise TftoolError(f"no node serves the action '{name}'")
        handle = GoalHandle(goal, on_feedback)
        offer.take(handle)
        return handle

    def watch(self, callback: Callable[[], object]) -> Callable[[], None]:
        """Have `callback` called when a topic, service, action or node comes or goes.

        It is called before the first value on a new topic. Call what is returned to stop.
        """
        self._watchers = (*self._watchers, callback)

        def stop() -> None:
            self._watchers = tuple(one for one in self._watchers if one is not callback)

        return stop

    def _changed(self) -> None:
        for watcher in self._watchers:
            watcher()

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
        """Put transforms into the buffer and tell whoever listens to `tf` or `tf_static`.

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
            self.tf_static.publish(TransformMessage(tuple(held.values()), authority))
        else:
            accepted = tuple(one for one in sent if self.buffer.set_transform(one, authority))
            if accepted:
                self.tf.publish(TransformMessage(accepted, authority))
        return len(accepted) == len(sent)

    def receive_static(
        self, transforms: Iterable[TransformStamped], authority: str
    ) -> tuple[TransformStamped, ...]:
        """Take in what another process's node holds for all time, for those who come late too.

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
            BaseException: `error` itself, while nobody lives this world.
        """
        if self._supervisor is None:
            raise error
        self._supervisor.fail(node, error)

    def supervise(self, supervision: Supervision | None) -> None:
        """Name who starts and stops nodes from now on (the supervisor's own call)."""
        self._supervisor = supervision

    def _log_buffer(self, level: str, text: str) -> None:
        if level == "ERROR":
            self.log.error("buffer", text)
        else:
            self.log.warn("buffer", text)
