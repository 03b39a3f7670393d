"""A session: one world, joined to the other processes that share it.

What nodes here publish goes out, what others publish comes in, and neither goes
round: what came in over the link is never sent out again. The world does not know
the difference; a service of another process is a service of the world.
"""

import asyncio
import contextlib
import os
import re
import threading
from collections.abc import Callable
from typing import Final

from tftool.errors import LinkError
from tftool.link import keys
from tftool.link.actions import ActionClient, ActionServer
from tftool.link.graph import Process, Role, hosts
from tftool.link.keys import Entity
from tftool.link.membership import NAME, Membership, Options, plain
from tftool.link.rendezvous import Rendezvous
from tftool.link.services import ServiceClient, ServiceServer
from tftool.link.topics import StaticBridge, TopicBridge, TransformBridge
from tftool.link.transport import Wire
from tftool.link.types import BY_ROS_TYPE, MESSAGES, SEND_GOAL, service_type
from tftool.runtime.clock import WallClock
from tftool.runtime.world import TransformMessage, World

REACHING: Final = 3.0
"""Seconds to wait for somebody at the other end of `connect`."""

NEARBY: Final = 1.0
"""Seconds to wait for the processes of this machine."""

INTRODUCED: Final = 1.0
"""Seconds to wait for tokens of those who are connected."""

SHOWN: Final = 0.3
"""Seconds to wait for the tokens of all, once those of some are there."""

_STEP = 0.005
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*", re.ASCII)


class Link(Membership):
    """A process's place in a session: it joins, and carries its world's traffic.

    Attributes:
        departures: How many of those have left that transforms came from.
    """

    def __init__(self, options: Options) -> None:
        """Join the others of this machine, and those `options` reach out to.

        Returns at once when it stands alone. No other process of this machine can join
        in between until `attach`, `settle` or `close` is called: whoever opens decides
        what to be while nobody else does.

        Raises:
            LinkError: If there is no place to meet, or zenoh is missing or refuses.
        """
        self._place: Rendezvous | None = None
        endpoint = ""
        others: tuple[str, ...] = ()
        if options.reach.config is None:
            self._place = Rendezvous(options.domain)
            self._place.enter()
            endpoint, others = self._place.endpoint, self._place.others
        try:
            wire = Wire(options.reach, endpoint, others)
        except LinkError:
            if self._place is not None:
                self._place.leave()
            raise
        super().__init__(options, wire)
        self._reach_out(len(others))
        self._take_in_tokens(len(others))
        self._stops: list[Callable[[], None]] = []
        self._bridges: dict[str, TopicBridge | TransformBridge] = {}
        self._servers: dict[str, ServiceServer | ActionServer] = {}
        self._clients: dict[str, ServiceClient | ActionClient] = {}
        self._closed = False
        self._settling = False
        self._reconciling = False
        self._since = 0
        self.departures = 0
        self._forgotten = 0

    def settle(self) -> None:
        """Let other processes of this machine join from now on."""
        if self._place is not None:
            self._place.settle()

    # Taking part

    def attach(self, world: World, *, role: Role) -> None:
        """Carry a world's topics, services and actions from now on; call inside its loop.

        Args:
            world: Whose.
            role: What this process is to the others.
        """
        self._world = world
        self._since = WallClock().epoch
        self.wire.start(asyncio.get_running_loop())
        domain = self.options.domain
        if not self.options.read_only:
            process = Process(
                domain, self.wire.zid, self._since, os.getpid(), role, self.options.command
            )
            self._stops.append(self.wire.token(process.token()))
        # Every domain: a peer that talks in another one is worth a word.
        for pattern in (f"{keys.LIVELINESS}/*/**", f"{keys.OURS}/*/**"):
            self._stops.append(self.wire.watch_tokens(pattern, self._on_token))
        self._stops.append(world.watch(self._reconcile))
        self._reconcile()
        self.settle()

    def close(self) -> None:
        """Leave the session; nothing of the world is touched."""
        if self._closed:
            return
        self._closed = True
        for bridge in self._bridges.values():
            bridge.close()
        for server in self._servers.values():
            server.close()
        for client in self._clients.values():
            client.close()
        for _, stop in self._nodes.values():
            stop()
        for stop in self._stops:
            stop()
        self.wire.close()
        if self._place is not None:
            self._place.leave()

    def __enter__(self) -> "Link":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    # Keeping up with the world

    def _reconcile(self) -> None:
        """Bring what is declared in line with what the world and the others have."""
        # Serving another's service changes the world, which calls this again.
        self._reconciling = False
        if self._closed or self._settling:
            return
        self._settling = True
        try:
            self._match_nodes()
            self._match_topics()
            self._match_servers()
            self._match_clients()
        finally:
            self._settling = False

    def _match_nodes(self) -> None:
        if self.options.read_only:
            return
        shown = {node.name for node in self.world.nodes if node.is_shown}
        wanted = shown or {f"tftool_{self.options.command}"}
        for name in set(self._nodes) - wanted:
            self._nodes.pop(name)[1]()
        for name in wanted - set(self._nodes):
            self._entity_ids += 1
            number = self._entity_ids
            entity = Entity(self.options.domain, self.wire.zid, number, number, "NN", plain(name))
            self._nodes[name] = number, self.wire.token(entity.token())

    def _match_topics(self) -> None:
        for entity in self.graph.entities(keys.PUBLISHER):
            known = BY_ROS_TYPE.get(entity.ros_type)
            # Named here, so that whoever looks through the world's topics sees it.
            if known and entity.name not in self.world.topics() and is_plain(entity.name):
                self.world.topic(entity.name, known[0])
        topics = self.world.topics()
        for name in [name for name in self._bridges if name not in topics]:
            self._bridges.pop(name).close()
        for bridge in self._bridges.values():
            bridge.refresh()
        for name, topic in topics.items():
            if name in self._bridges or not is_plain(name):
                continue
            if topic.kind is TransformMessage:
                made = StaticBridge if name == "tf_static" else TransformBridge
                self._bridges[name] = made(self, topic)
            elif topic.kind in MESSAGES:
                self._bridges[name] = TopicBridge(self, topic, MESSAGES[topic.kind])

    def _match_servers(self) -> None:
        if self.options.read_only:
            return
        own = {
            name
            for name in [*self.world.services(), *self.world.actions()]
            if name not in self._clients and is_plain(name)
        }
        for name in set(self._servers) - own:
            self._servers.pop(name).close()
        for name in sorted(own - set(self._servers)):
            kind = service_type(name)
            if name in self.world.actions():
                if name.rpartition("/")[2] == "rotate_absolute":
                    self._servers[name] = ActionServer(self, name)
                    self._warn_of_rival(name, f"{name}/_action/send_goal")
            elif kind is not None:
                self._servers[name] = ServiceServer(self, name, kind)
                self._warn_of_rival(name, name)

    def _match_clients(self) -> None:
        if self.options.read_only:
            return
        wanted: dict[str, Entity] = {}
        for entity in self.graph.entities(keys.SERVER):
            action = entity.name.removesuffix("/_action/send_goal")
            if entity.ros_type == SEND_GOAL or entity.ros_type.endswith("/RotateAbsolute_SendGoal"):
                wanted[action] = entity
            elif service_type(entity.name) is not None:
                wanted[entity.name] = entity
        for name in [name for name in self._clients if name not in wanted]:
            self._clients.pop(name).close()
        for name, entity in wanted.items():
            taken = name in self.world.services() or name in self.world.actions()
            if name in self._clients or taken or not is_plain(name):
                continue
            kind = service_type(name)
            if kind is None:
                self._clients[name] = ActionClient(self, name, entity)
            else:
                self._clients[name] = ServiceClient(self, name, kind, entity)

    def _warn_of_rival(self, name: str, served: str) -> None:
        for rival in self.graph.entities(keys.SERVER, name=served):
            process = self.graph.process(rival.session)
            # Of two the second is told.
            if process is None or process.since < self._since:
                self.say_once(
                    "rival",
                    f"{process or f'node {rival.node!r}'} serves '{name}' too: two hosts of the "
                    "same turtles mix their transforms. Leave one of them, or give this one "
                    "a --domain of its own.",
                )

    # Keeping up with the others

    def _on_token(self, change: tuple[str, bool]) -> None:
        token, there = change
        if not there:
            gone = self.graph.remove(token)
            if isinstance(gone, Process):
                self._left(gone)
            elif gone is not None:
                self.departures += gone.kind == keys.PUBLISHER and gone.name == "tf"
                self._graph_changed()
            return
        new = self.graph.add(token)
        if new is None:
            self._mention_foreign_domains()
            return
        if isinstance(new, Entity):
            self._graph_changed()
        else:
            self._came(new)

    def _graph_changed(self) -> None:
        """Reconcile soon: tokens come in crowds, and one look serves them all."""
        self._authorities.clear()
        if not self._reconciling:
            self._reconciling = True
            asyncio.get_running_loop().call_soon(self._reconcile)

    def _came(self, process: Process) -> None:
        alone = process.role is Role.HOST and len(hosts(self.graph.processes())) == 1
        if alone and self.departures > self._forgotten:
            # Another world under the same names, perhaps by another clock: what is known of
            # the way things moved in the one before would only be in its way.
            self._forgotten = self.departures
            self.world.buffer.clear()
            self.world.log.warn(NAME, f"{process} hosts now.")
        elif process.since >= self._since:
            self.world.log.info(NAME, f"{process} has joined.")

    def _left(self, process: Process) -> None:
        if process.role is Role.GUEST:
            self.world.log.info(NAME, f"{process} has left.")
            return
        self.departures += 1
        hosted = ", which hosted," if process.role is Role.HOST else ""
        self.world.log.warn(NAME, f"{process}{hosted} has left; what it sent stays as it was.")

    def _mention_foreign_domains(self) -> None:
        for domain in self.graph.foreign_domains:
            self.say_once(
                f"domain {domain}",
                f"Somebody talks in domain {domain}; this is domain {self.options.domain} and "
                f"hears nothing of it. To join: --domain {domain}.",
            )

    # Opening

    def _reach_out(self, others: int) -> None:
        """Wait until somebody is there, where somebody should be."""
        # zenoh itself gives up waiting early, and a busy machine is slow to say hello: who
        # took that for nobody would host a second world. A stopped process never says it.
        self._await_neighbours(others, NEARBY)
        reach = self.options.reach
        if reach.config is not None:
            self._await_neighbours(1, NEARBY)
        elif reach.connect and not self._await_neighbours(others + 1, REACHING):
            self.close_quietly()
            raise LinkError(
                f"nobody answers at {', '.join(reach.connect)} within {REACHING:g} s; "
                "is the other side running, and reachable from here?"
            )

    def _await_neighbours(self, count: int, patience: float) -> bool:
        pause = threading.Event()
        for _ in range(round(patience / _STEP)):
            if len(self.wire.neighbours) >= count:
                return True
            pause.wait(_STEP)
        return len(self.wire.neighbours) >= count

    def close_quietly(self) -> None:
        """Give up while opening."""
        with contextlib.suppress(Exception):
            self.wire.close()
        if self._place is not None:
            self._place.leave()

    def _take_in_tokens(self, others: int) -> None:
        """Fill the graph with who is there now, where somebody should be."""
        expected = others or self.options.reach.connect or self.options.reach.config
        pause = threading.Event()
        patience = round(INTRODUCED / _STEP) if expected else 1
        # Connected is not yet introduced: routers take a moment to pass tokens on.
        while patience > 0:
            for prefix in (keys.LIVELINESS, keys.OURS):
                for token in self.wire.tokens(f"{prefix}/{self.options.domain}/**"):
                    self.graph.add(token)
            if not expected or self.wire.neighbours <= self.graph.sessions:
                return
            if not self.graph.is_empty:
                # Those who only look never show a token: no reason to wait for long.
                patience = min(patience, round(SHOWN / _STEP))
            patience -= 1
            pause.wait(_STEP)


def is_plain(name: str) -> bool:
    """Whether a name can be a ROS topic's; others do not travel."""
    return len(name) < 250 and _PLAIN.fullmatch(name) is not None
