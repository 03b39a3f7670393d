"""Connection between a world and the other processes of its session: topics and services.

Messages of this process's nodes are sent, messages of other processes are received, and a received
message is never sent again. Nodes of the world use another process's topics and services like the
world's own.
"""

import asyncio
import os
import re
from collections.abc import Callable
from typing import Any, Final

from tftool.base.errors import MalformedMessage
from tftool.messages.classes import INTERFACES, Message
from tftool.world.clock import WallClock
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Endpoint
from tftool.world.link.graph import NODE, SERVER, GraphEntity, Process, Role, hosts
from tftool.world.link.link_context import NAME, LinkContext
from tftool.world.link.link_options import Options
from tftool.world.link.service_bridges import (
    ActionClient,
    ActionServer,
    Answering,
    ServiceClient,
    serve_service,
)
from tftool.world.link.topic_bridges import StaticBridge, TopicBridge, TransformBridge
from tftool.world.topics import Offer
from tftool.world.world import TransformMessage, World

_NAMED: Final = (
    "turtlesim/msg/Pose",
    "turtlesim/msg/Color",
    "geometry_msgs/msg/Twist",
    "geometry_msgs/msg/PointStamped",
)
"""Types of other processes' topics that are listed even if no node here uses the topic."""

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*", re.ASCII)


class Link(LinkContext):
    """Connection of a process to a session, through which the process shares its world.

    Attributes:
        departures: Number of processes that published transforms and have left the session.
    """

    def __init__(self, options: Options) -> None:
        """Join the processes of this machine, and processes on the networks that `options` names.

        The constructor returns at once if no other process exists. No other process of this machine
        can join until `attach`, `settle` or `close` is called, so that no two processes decide at
        the same time whether to host.

        Raises:
            LinkError: If the session's folder is unusable, or the middleware is missing or raises
                an error.
        """
        super().__init__(options, options.reach.join(options))
        self._nodes: dict[str, Callable[[], None]] = {}
        self._removals: dict[GraphEntity, Callable[[], None]] = {}
        self._stops: list[Callable[[], None]] = []
        self._bridges: dict[str, TopicBridge | TransformBridge] = {}
        self._servers: dict[str, tuple[Offer[Any], Answering | ActionServer]] = {}
        self._clients: dict[str, ServiceClient | ActionClient] = {}
        self._announced: dict[Endpoint, Callable[[], None]] = {}
        self._closed = False
        self._settling = False
        self._reconciling = False
        self._loop: asyncio.AbstractEventLoop | None = None
        self._since = 0
        self.departures = 0
        self._forgotten = 0
        self._told = 0

    def settle(self) -> None:
        """Allow other local processes to join from now on."""
        self.middleware.settle()

    # Joining and leaving

    def attach(self, world: World, *, role: Role) -> None:
        """Share a world's topics, services and actions; call this inside the world's event loop.

        Args:
            world: The world.
            role: Role of this process in the session.
        """
        self._world = world
        self._since = WallClock().epoch
        self._loop = asyncio.get_running_loop()
        if not self.options.read_only:
            self._stops.append(self.middleware.process(self._process(role)))
        self.middleware.start(self._loop, self)
        self._stops.append(world.watch(self._world_changed, NAME))
        self._reconcile()
        self.settle()
        self._tell_frames()

    def _tell_frames(self) -> None:
        """Write the frame names for shell completion, with a delay of up to a second."""
        if self._closed or self._loop is None:
            return
        frames = self.world.buffer.frames()
        if len(frames) != self._told:
            self._told = len(frames)
            self.middleware.tell_frames(frames)
        self._loop.call_later(1.0, self._tell_frames)

    def _process(self, role: Role) -> Process:
        """Return the facts with which this process announces itself to other processes."""
        domain, session = self.options.domain, self.middleware.session
        return Process(domain, session, self._since, os.getpid(), role, self.options.command)

    def close(self) -> None:
        """Leave the session; the world itself does not change."""
        if self._closed:
            return
        self._closed = True
        for bridge in self._bridges.values():
            bridge.close()
        for _, server in self._servers.values():
            server.close()
        for client in self._clients.values():
            client.close()
        for stop in (*self._announced.values(), *self._nodes.values(), *self._stops):
            stop()
        self.middleware.close()

    def __enter__(self) -> "Link":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    # Changes of the world

    def _world_changed(self) -> None:
        """Share new topics at once, before their first message; share other changes a little later.

        A crowd of turtles changes the world thousands of times. One delayed update then serves many
        changes.
        """
        if self._closed:
            return
        # During a matching this has no effect; the matching that is requested below finds what
        # the running one has missed.
        self._match(self._match_nodes, self._carry_topics)
        self._reconcile_soon()

    def _reconcile(self) -> None:
        """Update announcements and bridges after changes of the world or of other processes."""
        self._reconciling = False
        self._match(
            self._match_nodes,
            self._match_endpoints,
            self._name_topics,
            self._carry_topics,
            self._refresh_topics,
            self._match_servers,
            self._match_clients,
            self._announce_clients,
        )

    def _match(self, *steps: Callable[[], None]) -> None:
        # Serving another process's service changes the world, which calls this function again.
        if self._closed or self._settling:
            return
        self._settling = True
        try:
            for step in steps:
                step()
        finally:
            self._settling = False

    def _match_nodes(self) -> None:
        if self.options.read_only:
            return
        shown = {node.name for node in self.world.nodes if node.is_shown}
        wanted = shown or {f"tftool_{self.options.command}"}
        for name in set(self._nodes) - wanted:
            self._nodes.pop(name)()
        for name in wanted - set(self._nodes):
            self._nodes[name] = self.middleware.node(name)

    def _match_endpoints(self) -> None:
        """Add nodes, publishers, subscriptions, clients of other processes to the world's lists."""
        self.world.know_far_nodes(one.node for one in self.graph.entities(NODE))
        there = set(self.graph.entities(PUBLISHER, SUBSCRIPTION, CLIENT))
        for entity in self.endpoints.keys() - there:
            del self.endpoints[entity]
        for entity in self._removals.keys() - there:
            self._removals.pop(entity)()
        for entity in there - self._removals.keys():
            ends = self.world.clients if entity.kind == CLIENT else self.world.endpoints
            self._removals[entity] = ends.add(self.far_endpoint(entity))

    def _name_topics(self) -> None:
        """Add other processes' topics to the topics of the world.

        Topics that no process uses any more are removed.
        """
        for entity in self.graph.entities(PUBLISHER):
            known = entity.ros_type not in _NAMED or entity.name in self.world.topics()
            if not known and is_plain(entity.name):
                self.world.name_topic(entity.name, INTERFACES.message(entity.ros_type))
        for topic in tuple(self.world.topics().values()):
            others = self.graph.entities(PUBLISHER, SUBSCRIPTION, name=topic.name)
            if topic.is_far and not topic.near_subscribers and not others:
                self.world.remove_topic(topic.name)

    def _refresh_topics(self) -> None:
        for bridge in self._bridges.values():
            bridge.refresh()

    def _carry_topics(self) -> None:
        topics = self.world.topics()
        for name in self._bridges.keys() - topics.keys():
            self._bridges.pop(name).close()
        for name in topics.keys() - self._bridges.keys():
            topic = topics[name]
            if not is_plain(name) or self._is_part_of_our_action(name):
                continue
            if topic.kind is TransformMessage:
                made = StaticBridge if name == "tf_static" else TransformBridge
                self._bridges[name] = made(self, topic)
            elif issubclass(topic.kind, Message):
                try:
                    self._bridges[name] = TopicBridge(self, topic)
                except MalformedMessage as error:
                    self.say_once(
                        f"type {name}", f"'{name}' is not shared with other processes: {error}."
                    )

    def _match_servers(self) -> None:
        if self.options.read_only:
            return
        offers: dict[str, Offer[Any]] = {**self.world.services(), **self.world.actions()}
        own = {
            name: offer
            for name, offer in offers.items()
            if not offer.is_remote and is_plain(name) and not self._is_part_of_our_action(name)
        }
        for name, (offer, server) in list(self._servers.items()):
            if own.get(name) is not offer:
                del self._servers[name]
                server.close()
        for name in sorted(own.keys() - self._servers.keys()):
            offer = own[name]
            if hasattr(offer.kind, "Goal"):
                self._servers[name] = offer, ActionServer(self, offer.node, name, offer.kind)
                self._warn_of_rival(name, f"{name}/_action/send_goal")
            elif hasattr(offer.kind, "Request"):
                self._servers[name] = offer, serve_service(self, offer.node, name, offer.kind)
                self._warn_of_rival(name, name)

    def _is_part_of_our_action(self, name: str) -> bool:
        """Return whether a name belongs to an action of this world, such as "x/_action/status"."""
        action, found, _ = name.partition("/_action/")
        offer = self.world.actions().get(action) if found else None
        return offer is not None and not offer.is_remote

    def _match_clients(self) -> None:
        if self.options.read_only:
            return
        wanted: dict[str, GraphEntity] = {}
        for entity in self.graph.entities(SERVER):
            action, found, part = entity.name.partition("/_action/")
            if not found and INTERFACES.has(entity.ros_type):
                wanted[entity.name] = entity
            elif part == "send_goal" and INTERFACES.has(entity.ros_type.removesuffix("_SendGoal")):
                wanted[action] = entity
        for name, client in list(self._clients.items()):
            if name not in wanted or not self._is_offered(name, remote=True):
                del self._clients[name]
                client.close()
        for name, entity in wanted.items():
            taken = name in self._clients or self._is_offered(name, remote=False)
            if taken or not is_plain(name):
                continue
            made = ServiceClient if name == entity.name else ActionClient
            self._clients[name] = made(self, name, entity)

    def _announce_clients(self) -> None:
        """Announce the service clients of this world's nodes, even of services without a server."""
        clients = self.world.clients
        own = {
            end
            for name in clients.topics()
            for end in clients.of(name, CLIENT)
            if not end.is_remote and is_plain(name)
        }
        for end in self._announced.keys() - own:
            self._announced.pop(end)()
        for end in own - self._announced.keys():
            self._announced[end] = self.middleware.announce_client(
                end.node, end.topic, end.interface
            )

    def _is_offered(self, name: str, *, remote: bool) -> bool:
        """Return whether this process (if `remote`, another process) serves a service or action."""
        offers = (self.world.services().get(name), self.world.actions().get(name))
        return any(offer is not None and offer.is_remote is remote for offer in offers)

    def _warn_of_rival(self, name: str, served: str) -> None:
        for rival in self.graph.entities(SERVER, name=served):
            process = self.graph.process(rival.session)
            # The process that started later reports the conflict.
            if process is None or process.since < self._since:
                self.say_once(
                    "rival",
                    f"{process or f'node {rival.node!r}'} serves '{name}' too: two hosts of "
                    "the same turtles mix their transforms. Stop one of them, or give this "
                    "process a --domain of its own.",
                )

    # Changes of other processes

    def graph_changed(self, found: GraphEntity | Process | None, is_added: bool) -> None:
        """Handle an entity that was added (if `is_added`) or removed.

        `found` is None if the change is only that another ROS domain was noticed.
        """
        if found is None:
            self._mention_foreign_domains()
        elif isinstance(found, Process):
            (self._came if is_added else self._left)(found)
        else:
            if not is_added and found.kind == PUBLISHER and found.name == "tf":
                self._count_departure(found.session)
            self._match_soon()

    def _match_soon(self) -> None:
        """Schedule one update of publishers and subscriptions for several changes."""
        self._senders.clear()
        self._reconcile_soon()

    def _reconcile_soon(self) -> None:
        if not self._reconciling and self._loop is not None:
            self._reconciling = True
            self._loop.call_soon(self._reconcile)

    def _came(self, process: Process) -> None:
        is_only_host = process.role is Role.HOST and len(hosts(self.graph.processes())) == 1
        if is_only_host and self.departures > self._forgotten:
            # Another world with the same names, perhaps with another clock: transforms of the
            # previous world would be mixed with its own.
            self._forgotten = self.departures
            self.world.buffer.clear()
            self.world.log.warn(NAME, f"{process} hosts now.")
        elif process.since >= self._since:
            self.world.log.info(NAME, f"{process} has joined.")

    def _left(self, process: Process) -> None:
        if process.role is Role.GUEST:
            self.world.log.info(NAME, f"{process} has left.")
            return
        self._count_departure(process.session)
        hosted = ", which hosted," if process.role is Role.HOST else ""
        self.world.log.warn(NAME, f"{process}{hosted} has left; its last transforms stay.")

    def _count_departure(self, session: str) -> None:
        """Count a process as departed when its announcement and its publishers of tf are gone.

        Both conditions are needed: a node can leave a process that stays, and programs other than
        tftool announce no process.
        """
        senders = self.graph.entities(PUBLISHER, name="tf")
        stays = self.graph.process(session) or any(one.session == session for one in senders)
        self.departures += not stays

    def _mention_foreign_domains(self) -> None:
        for domain in self.graph.foreign_domains:
            self.say_once(
                f"domain {domain}",
                f"Another process runs in domain {domain}; this process runs in domain "
                f"{self.options.domain}. Neither process receives messages of the other. "
                f"To join: --domain {domain}.",
            )


def is_plain(name: str) -> bool:
    """Return whether a name is a valid ROS topic; topics with other names are not shared."""
    return len(name) < 250 and _PLAIN.fullmatch(name) is not None
