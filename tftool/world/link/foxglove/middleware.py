"""Foxglove WebSocket server as the middleware of a session, for reading only."""

import asyncio
from collections.abc import Callable
from typing import ClassVar, Final

from tftool.base.errors import InputError, MalformedMessage
from tftool.base.stamps import Stamp
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION
from tftool.world.link.foxglove.client import ClientReceiver, FoxgloveClient, FoxgloveData
from tftool.world.link.foxglove.protocol import (
    FoxgloveChannel,
    ServerState,
    clock_message,
    conversion,
    define,
    ros_topic,
)
from tftool.world.link.foxglove.reach import FoxgloveReach
from tftool.world.link.graph import NODE, SERVER, Graph, GraphEntity
from tftool.world.link.link_context import UNKNOWN
from tftool.world.link.link_options import Options
from tftool.world.link.queues import Inbox
from tftool.world.link.seam import Arrived, Middleware, Watcher

CLOCK: Final = ("clock", "rosgraph_msgs/msg/Clock")

MOST_LEARNT: Final = 1_000_000
"""Characters of definitions that are registered; to read as many takes a second."""

_TIME_GID: Final = b"time"


class FoxgloveMiddleware(Middleware):
    """This process as a client of a Foxglove server; the server does not list its clients."""

    NO_WRITING: ClassVar[str] = "a Foxglove server is only read here: nothing is published to it"

    def __init__(self, options: Options, reach: FoxgloveReach) -> None:
        """Connect to the server; see `seam.Middleware`."""
        super().__init__(Graph("tftool", options.domain))
        self._domain = options.domain
        self._place = reach.place(options.domain)
        self._ears: dict[tuple[str, str], list[Callable[[Arrived], object]]] = {}
        self._conversions: dict[FoxgloveChannel, Callable[[bytes], bytes] | None] = {}
        self._gids: dict[FoxgloveChannel, bytes] = {}
        self._learnt: set[str] = set()
        self._learnt_size = 0
        self._entities: dict[str, GraphEntity] = {}
        self._inbox = Inbox()
        receiver = ClientReceiver(self._changed, self._arrived, self._time, self._warn)
        self._client = FoxgloveClient(reach.address, self._inbox, receiver, place=self._place)
        try:
            self._client.wait()
            self._inbox.call_now()
        except BaseException:
            self._client.close()
            raise

    @property
    def lost(self) -> int:
        """Number of messages dropped because the inbox was full."""
        return self._inbox.lost

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Call callbacks in the event loop `loop`, and report changes of the graph to `watcher`."""
        self.watcher = watcher
        self._inbox.start(loop)
        for one in self.graph.entities():
            self.report(one, True)

    def close(self) -> None:
        """Disconnect from the server."""
        self._inbox.close()
        self._client.close()

    # Topics

    def listen(
        self,
        name: str,
        ros_type: str,
        on_message: Callable[[Arrived], object],
        *,
        is_latched: bool = False,
    ) -> Callable[[], None]:
        """Call `on_message` with the server's messages on a topic; see `Middleware.listen`."""
        topic = name, ros_type
        ears = self._ears.setdefault(topic, [])
        ears.append(on_message)
        self._client.want(name, ros_type, again=is_latched)

        def stop() -> None:
            if on_message in ears:
                ears.remove(on_message)
            if not ears and self._ears.get(topic) is ears:
                del self._ears[topic]
                self._client.forget(name, ros_type)

        return stop

    def _arrived(self, data: FoxgloveData) -> None:
        channel = data.channel
        name, ros_type = ros_topic(channel)
        convert = self._conversion(channel)
        if convert is None:
            return
        try:
            arrived = Arrived(convert(data.payload), self._gids.get(channel, b""))
        except MalformedMessage as refusal:
            self.refuse(name, refusal)
            return
        self._deliver((name, ros_type), arrived)

    def _time(self, stamp: Stamp) -> None:
        # If /clock is a channel, the server's own time would repeat it.
        if _TIME_GID.hex() in self._entities:
            self._deliver(CLOCK, Arrived(clock_message(stamp), _TIME_GID))

    def _deliver(self, topic: tuple[str, str], arrived: Arrived) -> None:
        for on_message in tuple(self._ears.get(topic, ())):
            on_message(arrived)

    def _conversion(self, channel: FoxgloveChannel) -> Callable[[bytes], bytes] | None:
        """Return the function that converts a channel's messages to CDR; None if none exists."""
        if channel not in self._conversions:
            self._conversions[channel] = None
            try:
                self._conversions[channel] = conversion(channel)
            except InputError as error:
                self._warn(f"'{channel.topic}' cannot be read: {error}.".replace("..", "."))
        return self._conversions[channel]

    def _warn(self, sentence: str) -> None:
        self.say_once(sentence, sentence)

    # Announcements of the server

    def _changed(self, _: None) -> None:
        """Update the graph from the server's announcements."""
        with self._client.state() as state:
            self._learn_types(state)
            found = self._shown(state)
            there = set(state.channels.values())
            ignored = state.ignored
        self._conversions = {one: to for one, to in self._conversions.items() if one in there}
        if ignored:
            self._warn(
                f"{self._place} offers more than {len(state.channels)} channels: further "
                "channels are ignored."
            )
        for key in [key for key, one in self._entities.items() if found.get(key) != one]:
            self._entities.pop(key)
            if (gone := self.graph.remove(key)) is not None:
                self.report(gone, False)
        for key in found.keys() - self._entities.keys():
            self._entities[key] = found[key]
            if (new := self.graph.add(key, found[key])) is not None:
                self.report(new, True)

    def _learn_types(self, state: ServerState) -> None:
        """Register message types that are defined only by the server, for recording and listing."""
        for channel in state.channels.values():
            size = len(channel.definition) + len(channel.type)
            if channel.type in self._learnt or self._learnt_size + size > MOST_LEARNT:
                continue
            self._learnt.add(channel.type)
            self._learnt_size += size
            try:
                define(channel)
            except InputError as error:
                self._warn(f"The definition of '{channel.type}' cannot be used: {error}.")

    def _shown(self, state: ServerState) -> dict[str, GraphEntity]:
        """Return the nodes and endpoints that the server has announced, by unique keys."""
        found: dict[str, GraphEntity] = {}
        types: dict[str, str] = {}
        nodes: set[str] = set()
        self._gids = {}
        topics = {number: ros_topic(one) for number, one in state.channels.items()}
        for number, channel in state.channels.items():
            name, ros_type = topics[number]
            types.setdefault(channel.topic, ros_type)
            publishers = state.publishers.get(channel.topic) or (state.name,)
            for place, node in enumerate(publishers):
                gid = number.to_bytes(4) + place.to_bytes(4)
                found[gid.hex()] = self._entity(PUBLISHER, node, name, ros_type, gid)
            # With several publishers, a message does not say who sent it.
            if len(publishers) == 1:
                self._gids[channel] = gid
        if "time" in state.capabilities and CLOCK not in topics.values():
            entity = self._entity(PUBLISHER, state.name, *CLOCK, _TIME_GID)
            found[_TIME_GID.hex()] = entity
        for topic, subscribers in state.subscribers.items():
            for node in subscribers if topic in types else ():
                entity = self._entity(SUBSCRIPTION, node, topic.strip("/"), types[topic])
                found[f"s {topic} {node}"] = entity
        for name, ros_type in state.services.values():
            for node in state.providers.get(name) or (state.name,):
                entity = self._entity(SERVER, node, name.strip("/"), ros_type)
                found[f"q {name} {node}"] = entity
        for table in (state.publishers, state.subscribers, state.providers):
            nodes.update(node for several in table.values() for node in several)
        for node in nodes:
            found[f"n {node}"] = self._entity(NODE, node)
        return found

    def _entity(
        self, kind: str, node: str, name: str = "", ros_type: str = "", gid: bytes = b""
    ) -> GraphEntity:
        return GraphEntity(kind, self._domain, self._place, node, name, ros_type, UNKNOWN, gid)
