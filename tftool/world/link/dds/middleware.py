"""DDS as the middleware of a session, with names and types of ROS 2's Cyclone and Fast DDS."""

import asyncio
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import InputError, LinkError
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES
from tftool.messages.hashes import type_hash
from tftool.world.clock import WallClock
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, TF, TF_STATIC, Quality, conflict
from tftool.world.link.dds import dds_types as names
from tftool.world.link.dds.dds_services import CycloneClient, CycloneServer, ServicePart
from tftool.world.link.dds.dds_types import Raw, Types
from tftool.world.link.dds.discovery import Discovery
from tftool.world.link.dds.participant import (
    LIBRARY_LOG,
    DdsSample,
    Participant,
    TopicReader,
    TopicWriter,
)
from tftool.world.link.dds.reach import DdsReach
from tftool.world.link.dds.settings import network, other_domains, participants_here
from tftool.world.link.graph import GraphEntity, Process, node_name
from tftool.world.link.link_options import Options
from tftool.world.link.seam import (
    Arrived,
    Middleware,
    Watcher,
    WireRequest,
    nothing,
)

ALONE: Final = seconds(2)
"""Nanoseconds to search for other processes if there is no sign of any."""

INTRODUCED: Final = seconds(6)
"""Nanoseconds to wait for processes of this machine whose ports are open."""

SETTLED: Final = 0.3
"""Seconds without a change after which all existing processes count as known."""

_RELIABILITY: Final = 11
"""Number of the policy RELIABILITY in the library."""


class DdsMiddleware(Middleware):
    """This process in a ROS 2 graph over DDS; its session name is the GUID of its participant.

    `unanswering` is always empty, because DDS does not distinguish a stopped process from a missing
    process. `tell_frames` does nothing: shell completion of frame names works with zenoh only.
    """

    def __init__(self, options: Options, reach: DdsReach) -> None:
        """Join the graph; see `seam.Middleware`."""
        self._options = options
        self._network = network(reach.places)
        name = f"tftool {options.command} ({os.getpid()})"
        self._participant = Participant(options.domain, self._network, name, names.ENCLAVE.encode())
        try:
            self._discovery = Discovery(self._participant, options.domain)
            super().__init__(self._discovery.graph)
            self.notices = self._network.notices
            self._types = Types(INTERFACES)
            self._services = ServicePart(self._participant, self._types, self.graph, self.sender)
            self._clients: dict[tuple[str, str], CycloneClient] = {}
            self._readers: dict[tuple[str, str], list[_Listening]] = {}
            self._claims: list[_Claim] = []
            self._look_around()
        except BaseException:
            self._participant.close()
            raise

    def _look_around(self) -> None:
        """Wait until all existing participants are known."""
        discovery, clock = self._discovery, WallClock()
        begin = clock.now()
        # Processes are counted by their ports, and our own participant has ports, too.
        ours = 1
        news = True
        while True:
            discovery.look()
            # Lists of nodes arrive through the inbox, and no event loop runs yet.
            self._participant.inbox.call_now()
            waited = clock.now() - begin
            there = participants_here(self._options.domain) - ours
            known = discovery.participants
            if waited > INTRODUCED:
                break
            is_known = known and known >= there and not news
            # A process without endpoints never shows any, so the wait for it is limited.
            if is_known and (discovery.is_complete or waited > ALONE):
                return
            # On the loopback, no other machine can respond later.
            alone = 0 if self._network.is_loopback and there == 0 else ALONE
            if not known and there <= 0 and waited > alone:
                break
            news = discovery.wait(SETTLED)
        if known < there:
            some = f"{there - known} of {there} programs that listen"
            self.notices += (
                f"{some} in DDS domain {self._options.domain} of this machine did not answer on "
                f"{self._network}: they may use another interface (--dds-on).",
            )
        elif not known:
            others = other_domains(self._options.domain)
            elsewhere = f"; programs of this machine use {_listed(others)}" if others else ""
            way = (
                "for a robot on another machine, add --dds-on INTERFACE"
                if self._network.is_loopback
                else "check that this is the right interface"
            )
            self.notices += (
                f"No other DDS program answers in domain {self._options.domain} on "
                f"{self._network}{elsewhere}: {way}; for another domain, add --domain N.",
            )

    @property
    def lost(self) -> int:
        """Number of messages dropped because the inbox was full or the messages were too large."""
        return self._participant.inbox.lost + self._participant.oversized

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Call callbacks in the event loop `loop`, and report changes of the graph to `watcher`."""
        self.watcher = watcher
        # After the watcher is set, because queued calls are reported to it.
        self._participant.inbox.start(loop)
        self._discovery.start(self._changed)
        if watcher is not None:
            if not self._network.config:
                # The library's thread calls this, so the text goes through the inbox like messages.
                inbox = self._participant.inbox
                stop = LIBRARY_LOG.listen(lambda sentence: inbox.put(self._complain, sentence))
                self._participant.at_close(stop)
            there: list[GraphEntity | Process] = [*self.graph.processes(), *self.graph.entities()]
            for one in there:
                self._changed(one, True)

    def _complain(self, sentence: str) -> None:
        self.say_once(sentence, sentence)

    def close(self) -> None:
        """Send queued messages, and leave the graph."""
        # Before the participant, with which the library deletes the readers.
        for listening in [one for several in self._readers.values() for one in several]:
            listening.close()
        self._readers.clear()
        self._participant.close()

    # Announcements of this process

    def process(self, process: Process) -> Callable[[], None]:
        """Announce this process; see `seam.Middleware.process`."""
        self._participant.tell(names.process_data(process))
        return nothing

    def node(self, name: str) -> Callable[[], None]:
        """Announce a node; see `seam.Middleware.node`."""
        if self._options.read_only:
            return nothing
        return self._discovery.show_node(node_name(name))

    def subscription(
        self, node: str, name: str, ros_type: str, quality: Quality
    ) -> Callable[[], None]:
        """Announce that a node subscribes to a topic; list the topic's reader under this node."""
        claim = _Claim(node_name(node), name, ros_type, quality)
        self._claims.append(claim)
        for one in self._readers.get((name, ros_type), ()):
            self._assign(one)

        def hide() -> None:
            self._claims.remove(claim)
            for one in self._readers.get((name, ros_type), ()):
                self._assign(one)

        return hide

    def _assign(self, listening: "_Listening") -> None:
        """Announce a topic's reader under the first node that subscribes to the topic."""
        listening.hide()
        # ROS 2 lists a reader under one node: the first one that names it.
        listening.hide = nothing
        if self._options.read_only or listening.reader is None:
            return
        for claim in self._claims:
            if (claim.name, claim.ros_type) == (listening.name, listening.ros_type):
                gid = listening.reader.gid
                listening.hide = self._discovery.show_endpoint(claim.node, SUBSCRIPTION, gid)
                return

    # Topics

    def publisher(self, node: str, name: str, ros_type: str, quality: Quality) -> TopicWriter:
        """Create a publisher of a topic for a node of this process."""
        kind = self._kind(ros_type)
        if self._options.read_only:
            raise LinkError(f"'{name}' cannot be published: this process joined with --read-only")
        # ROS 2 compares the hash in the writer's user data, and warns if it differs.
        beside = f"typehash={type_hash(INTERFACES, ros_type)};".encode()
        writer = self._participant.writer(names.TOPIC + name, kind, quality, beside)
        writer.hide = self._discovery.show_endpoint(node_name(node), PUBLISHER, writer.gid)
        return writer

    def listen(
        self,
        name: str,
        ros_type: str,
        on_message: Callable[[Arrived], object],
        *,
        is_latched: bool = False,
    ) -> Callable[[], None]:
        """Call `on_message` with other processes' messages on a topic; see `Middleware.listen`."""
        listening = _Listening(self, name, ros_type, on_message, is_latched=is_latched)
        try:
            listening.open(is_reliable=self._asks_reliable(name, ros_type))
        except (LinkError, InputError) as error:
            self.say_once(f"type {ros_type}", f"'{name}' cannot be read over DDS: {error}.")
            return nothing
        # There may be several readers, because each latched subscription has its own.
        several = self._readers.setdefault((name, ros_type), [])
        several.append(listening)
        self._assign(listening)

        def stop() -> None:
            if listening in several:
                several.remove(listening)
            listening.close()

        return stop

    def _asks_reliable(self, name: str, ros_type: str) -> bool:
        """Return whether to request reliability: for tf, or if all writers offer reliability."""
        if name in ("tf", "tf_static"):
            return True
        # A reader that requests more than a writer offers receives nothing from it.
        offered = self.graph.entities(PUBLISHER, name=name)
        return all(one.quality.is_reliable for one in offered if one.ros_type == ros_type)

    def open_reader(
        self,
        listening: "_Listening",
        on_sample: Callable[[DdsSample], object],
        *,
        is_reliable: bool,
    ) -> TopicReader:
        """Create a reader of a subscribed topic."""
        quality = Quality(is_reliable=is_reliable, is_latched=listening.is_latched)
        return self._participant.reader(
            names.TOPIC + listening.name,
            self._kind(listening.ros_type),
            quality,
            on_sample,
            listening.refused,
        )

    def sender(self, sample: DdsSample) -> bytes:
        """Return the GUID of the writer that sent a message."""
        return self._discovery.gid(sample.writer)

    def _kind(self, ros_type: str) -> type[Raw]:
        return self._types.raw(ros_type)

    # Services

    def server(
        self, node: str, name: str, ros_type: str, on_request: Callable[[WireRequest], object]
    ) -> Callable[[], None]:
        """Serve a service as a node of this process; return a function that stops the server."""

        def stranger(vendor: str) -> None:
            self.say_once(
                f"asked {vendor}",
                f"A node over {vendor} asks for the service '{name}': {vendor} numbers "
                "requests in a field that DDS's library for Python cannot read, so the node "
                "gets no answer.",
            )

        try:
            server = CycloneServer(self._services, name, ros_type, on_request, stranger)
        except (LinkError, InputError) as error:
            self.say_once(f"type {ros_type}", f"'{name}' cannot be served over DDS: {error}.")
            return nothing
        # A service has a reader of requests and a writer of replies, both of its node.
        reads, writes = server.gids
        hide = [
            self._discovery.show_endpoint(node_name(node), SUBSCRIPTION, reads),
            self._discovery.show_endpoint(node_name(node), PUBLISHER, writes),
        ]

        def leave() -> None:
            for one in hide:
                one()
            server.close()

        return leave

    def client(self, node: str, name: str, ros_type: str) -> CycloneClient:
        """Return the client of a service for all nodes of this process."""
        key = name, ros_type
        if key not in self._clients:
            self._clients[key] = CycloneClient(self._services, *key)
        return self._clients[key]

    def announce_client(self, node: str, name: str, ros_type: str) -> Callable[[], None]:
        """Announce a node's client; return a function that ends the announcement."""
        client = self.client(node, name, ros_type)
        try:
            reads, writes = client.announce()
        except (LinkError, InputError) as error:
            self.say_once(f"type {ros_type}", f"'{name}' cannot be called over DDS: {error}.")
            return nothing
        hide = [
            self._discovery.show_endpoint(node_name(node), SUBSCRIPTION, reads),
            self._discovery.show_endpoint(node_name(node), PUBLISHER, writes),
        ]

        def leave() -> None:
            for one in (*hide, client.withdraw):
                one()

        return leave

    # Announcements of other processes

    def _changed(self, found: GraphEntity | Process | None, is_added: bool) -> None:
        self.report(found, is_added)
        if is_added and found is not None:
            self._compare(found)
        elif isinstance(found, GraphEntity):
            self._tell_departure(found)

    def _tell_departure(self, gone: GraphEntity) -> None:
        """Log that a publisher of transforms has left."""
        if gone.kind != PUBLISHER or gone.name != "tf":
            return
        # The publisher may only have been renamed, when its node became known.
        if all(one.gid != gone.gid for one in self.graph.entities(PUBLISHER, name="tf")):
            self.say_once(
                f"left {gone.gid.hex()}",
                f"'{gone.node}' no longer publishes /tf: the node has left, or its process sent no "
                "sign of life for ten seconds, its lease. Its last transforms stay.",
            )

    def _compare(self, found: GraphEntity | Process) -> None:
        """Log a warning if this process cannot receive a new publisher's messages."""
        if not isinstance(found, GraphEntity) or found.kind != PUBLISHER:
            return
        # tf2's listeners request a fixed quality; other readers lower theirs.
        asked = {"tf": TF, "tf_static": TF_STATIC}.get(found.name)
        policy = "" if asked is None else conflict(found.quality, asked)
        if policy:
            offers = "best effort" if policy == "RELIABILITY" else "volatile"
            wants = "reliable" if policy == "RELIABILITY" else "transient local"
            self.say_once(
                f"quality {found.name} {found.node}",
                f"'{found.node}' publishes /{found.name} as {offers}, but tf2 asks for {wants}: "
                f"neither tf2's listeners nor this process receive these messages ({policy}). "
                f"Let '{found.node}' offer {wants}.",
            )
        if not found.type_hash or not INTERFACES.has(found.ros_type):
            return
        if found.type_hash != type_hash(INTERFACES, found.ros_type):
            self.say_once(
                f"hash {found.name} {found.ros_type}",
                f"'{found.node}' publishes '{found.name}' with another definition of "
                f"{found.ros_type} than tftool: messages that differ are not read. Run tftool in "
                "a workspace with that definition, or update the publisher or tftool.",
            )


@dataclass(frozen=True, slots=True, eq=False)
class _Claim:
    """Subscription that a node has declared; two equal declarations count as two subscriptions."""

    node: str
    name: str
    ros_type: str
    quality: Quality


class _Listening:
    """Reader of a topic, replaced by a best-effort reader if a publisher is best effort."""

    def __init__(
        self,
        middleware: DdsMiddleware,
        name: str,
        ros_type: str,
        on_message: Callable[[Arrived], object],
        *,
        is_latched: bool,
    ) -> None:
        self._middleware = middleware
        self._on_message = on_message
        self.name = name
        self.ros_type = ros_type
        self.is_latched = is_latched
        self.reader: TopicReader | None = None
        self.hide: Callable[[], None] = nothing
        self._is_closed = False

    def open(self, *, is_reliable: bool) -> None:
        """Create the reader of the topic."""
        self.reader = self._middleware.open_reader(self, self._arrived, is_reliable=is_reliable)

    def close(self) -> None:
        """Close the reader of the topic."""
        self._is_closed = True
        self.hide()
        if self.reader is not None:
            self.reader.close()

    def refused(self, policy: int) -> None:
        """Replace the reader by a best-effort reader if the refused policy is reliability."""
        # Less durability would silently lose earlier messages, and tf2's topics keep their
        # quality.
        if self._is_closed or self.name in ("tf", "tf_static") or policy != _RELIABILITY:
            return
        if self.reader is not None:
            self.reader.close()
        self.open(is_reliable=False)

    def _arrived(self, sample: DdsSample) -> None:
        if not self._is_closed:
            # The reader may have been closed while the message was in the inbox.
            self._on_message(Arrived(sample.payload, self._middleware.sender(sample)))


def _listed(domains: list[int]) -> str:
    numbers = ", ".join(str(one) for one in domains[:5])
    return f"domain {numbers}" if len(domains) == 1 else f"domains {numbers}"
