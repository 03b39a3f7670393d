"""Graph of a session: the other processes, their nodes, topics, services and actions."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

from tftool.base.stamps import Stamp
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Quality

NODE: Final = "node"
SERVER: Final = "server"
KINDS: Final = (NODE, PUBLISHER, SUBSCRIPTION, SERVER, CLIENT)

MOST: Final = 20_000
"""Largest number of entries of the graph; further announcements are ignored."""

MOST_DOMAINS: Final = 100
"""Largest number of other domains that are stored, so that each is reported once."""


@dataclass(frozen=True, slots=True)
class GraphEntity:
    """Node of another process, or a publisher, subscription, server or client of such a node.

    Attributes:
        kind: One of `KINDS`.
        domain: Number of the ROS domain.
        session: Name of the entity's process in the middleware.
        node: Name of the node with its namespace, without a leading slash.
        name: Name of the topic or service without a leading slash; "" for a node.
        ros_type: Type, such as "tf2_msgs/msg/TFMessage"; "" for a node.
        quality: Quality of service; the default for a node.
        gid: Bytes that identify the entity, sent with the messages of a publisher.
        type_hash: Hash of the type; "" if no hash is announced.
    """

    kind: str
    domain: int
    session: str
    node: str
    name: str = ""
    ros_type: str = ""
    quality: Quality = field(default_factory=Quality)
    gid: bytes = b""
    type_hash: str = ""


class Role(StrEnum):
    """Role of a tftool process in its session.

    Attributes:
        HOST: The process runs the world that other processes look at.
        SOURCE: The process adds data of its own: a static transform or a user's node.
        GUEST: The process adds nothing, and waits for a host or a source.
    """

    HOST = "host"
    SOURCE = "source"
    GUEST = "guest"


@dataclass(frozen=True, slots=True)
class Process:
    """Announcement of a tftool process in the session.

    Attributes:
        domain: Number of the process's ROS domain.
        session: Name of the process in the middleware.
        since: Time of joining on the process's clock, nanoseconds.
        pid: Process id on its machine.
        role: Role in the session.
        command: Name of the command, such as "demo" or "echo".
    """

    domain: int
    session: str
    since: Stamp
    pid: int
    role: Role
    command: str

    def __str__(self) -> str:
        return f"'tftool {self.command}' (process {self.pid})"


class Graph:
    """Nodes, publishers, subscriptions, servers and clients of all other processes.

    Attributes:
        own: Session name of this process. The graph leaves out this process's entities.
        domain: Number of this process's domain.
    """

    def __init__(self, own: str, domain: int) -> None:
        self.own = own
        self.domain = domain
        self._entities: dict[str, GraphEntity] = {}
        self._by_name: dict[str, dict[str, GraphEntity]] = {}
        self._processes: dict[str, Process] = {}
        self._foreign: set[int] = set()

    def add(self, key: str, found: GraphEntity | Process) -> GraphEntity | Process | None:
        """Add an entity or process under a key, which `remove` needs.

        Returns:
            The entity or process; None for a known key, another domain or this process, or if the
            graph is full.
        """
        if key in self._entities or key in self._processes or found.session == self.own:
            return None
        if len(self._entities) + len(self._processes) >= MOST:
            return None
        if found.domain != self.domain:
            if len(self._foreign) < MOST_DOMAINS:
                self._foreign.add(found.domain)
            return None
        if isinstance(found, GraphEntity):
            self._entities[key] = found
            self._by_name.setdefault(found.name, {})[key] = found
        else:
            self._processes[key] = found
        return found

    def remove(self, key: str) -> GraphEntity | Process | None:
        """Remove the entity or process of a key.

        Returns:
            The removed entity or process; None if the key is unknown.
        """
        gone = self._entities.pop(key, None)
        if gone is None:
            return self._processes.pop(key, None)
        namesakes = self._by_name[gone.name]
        del namesakes[key]
        if not namesakes:
            del self._by_name[gone.name]
        return gone

    def get(self, key: str) -> GraphEntity | Process | None:
        """Return the entity or process of a key; None for an unknown key."""
        return self._entities.get(key) or self._processes.get(key)

    @property
    def foreign_domains(self) -> frozenset[int]:
        """Numbers of the other domains in which this process has noticed entities."""
        return frozenset(self._foreign)

    def processes(self) -> list[Process]:
        """Return every tftool process, in the order of joining the session."""
        return sorted(self._processes.values(), key=lambda one: (one.since, one.session))

    def process(self, session: str) -> Process | None:
        """Return the tftool process with a session name; None for an unknown name."""
        return next((one for one in self._processes.values() if one.session == session), None)

    def entities(self, *kinds: str, name: str | None = None) -> list[GraphEntity]:
        """Return the entities of the given kinds (default: all) and with the given name, if any."""
        found = self._entities if name is None else self._by_name.get(name, {})
        return [one for one in found.values() if not kinds or one.kind in kinds]

    @property
    def is_empty(self) -> bool:
        """Whether there is no other process."""
        return not self._entities and not self._processes

    @property
    def sessions(self) -> frozenset[str]:
        """Session names of all other processes."""
        found = {one.session for one in self._processes.values()}
        return frozenset(found | {one.session for one in self._entities.values()})

    @property
    def has_sources(self) -> bool:
        """Whether another process provides data; guests only wait for data."""
        guests = set()
        for one in self._processes.values():
            if one.role is not Role.GUEST:
                return True
            guests.add(one.session)
        return any(one.session not in guests for one in self._entities.values())

    def publisher(self, gid: bytes, topic: str) -> GraphEntity | None:
        """Return the publisher of a message from the id that the message contains.

        ROS 2 nodes send other ids than tftool computes from their announcements. So for an unknown
        id, the topic's only publisher that is not a tftool process is returned.

        Args:
            gid: Id in a message.
            topic: Name of the message's topic.

        Returns:
            The publisher; None for an unknown publisher, or several possible publishers.
        """
        unknown = []
        for one in self.entities(PUBLISHER, name=topic):
            if one.gid == gid:
                return one
            if self.process(one.session) is None:
                unknown.append(one)
        return unknown[0] if len(unknown) == 1 else None


def hosts(processes: Iterable[Process]) -> list[Process]:
    """Return the processes that run a world (nodes and frames) which other processes look at."""
    return [one for one in processes if one.role is Role.HOST]


def node_name(name: str) -> str:
    """Return a name as a valid ROS node name: other characters become underscores."""
    name = re.sub(r"[^A-Za-z0-9_/]", "_", name.strip("/"))[:200]
    name = re.sub(r"/+", "/", name)
    return name if name and not name[0].isdigit() else f"_{name}"
