"""Graph of a session: processes, nodes, and their topics and services."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

from tftool.base.stamps import Stamp
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, Quality

NODE: Final = "node"
SERVER: Final = "server"
CLIENT: Final = "client"
KINDS: Final = (NODE, PUBLISHER, SUBSCRIPTION, SERVER, CLIENT)

MOST: Final = 20_000
"""How many entries are kept; what other processes announce beyond that is ignored."""

MOST_DOMAINS: Final = 100
"""Other domains that are remembered, to say so once of each."""


@dataclass(frozen=True, slots=True)
class GraphEntity:
    """Another process's node, or an entity of one.

    Attributes:
        kind: One of `KINDS`.
        domain: Number of the ROS domain.
        session: Process of the entity, by the middleware's name.
        node: The node's name, with its namespace, without the leading slash.
        name: The topic's or service's name without the leading slash; of a node, "".
        ros_type: Type, "tf2_msgs/msg/TFMessage"; of a node, "".
        quality: Quality of service; of a node, the default one.
        gid: Bytes that identify it; they stand beside the messages of a publisher.
        type_hash: The hash of the type, where it is shown; else "".
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
    """A tftool's role for the others in its session.

    Attributes:
        HOST: The process runs the world that others look at.
        SOURCE: The process adds something of its own, a static transform or a user's node.
        GUEST: The process only takes part, and waits for one that adds something.
    """

    HOST = "host"
    SOURCE = "source"
    GUEST = "guest"


@dataclass(frozen=True, slots=True)
class Process:
    """A tftool in the session, as it announces itself.

    Attributes:
        domain: Number of its ROS domain.
        session: The middleware's name of the process.
        since: Time of joining, by the process's clock.
        pid: Its process number on its machine.
        role: Role for the others.
        command: Command: "demo", "echo".
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
    """Entities of all other processes.

    Attributes:
        own: This process's session, whose entities are not entered.
        domain: The domain we are in.
    """

    def __init__(self, own: str, domain: int) -> None:
        self.own = own
        self.domain = domain
        self._entities: dict[str, GraphEntity] = {}
        self._by_name: dict[str, dict[str, GraphEntity]] = {}
        self._processes: dict[str, Process] = {}
        self._foreign: set[int] = set()

    def add(self, key: str, found: GraphEntity | Process) -> GraphEntity | Process | None:
        """Add an entity under a key for its removal.

        Returns:
            The new entity; None when nothing is new.
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
        """Remove an entity.

        Returns:
            The entity that is gone; None when it was not known.
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
        """Return the entity of a key; None if there is none."""
        return self._entities.get(key) or self._processes.get(key)

    @property
    def foreign_domains(self) -> frozenset[int]:
        """Return other domains that were noticed."""
        return frozenset(self._foreign)

    def processes(self) -> list[Process]:
        """Return every tftool, the oldest in the session first."""
        return sorted(self._processes.values(), key=lambda one: (one.since, one.session))

    def process(self, session: str) -> Process | None:
        """Return the tftool of a session."""
        return next((one for one in self._processes.values() if one.session == session), None)

    def entities(self, *kinds: str, name: str | None = None) -> list[GraphEntity]:
        """Return all entities of some kinds, or those of one name."""
        found = self._entities if name is None else self._by_name.get(name, {})
        return [one for one in found.values() if not kinds or one.kind in kinds]

    @property
    def is_empty(self) -> bool:
        """Whether there is no other process."""
        return not self._entities and not self._processes

    @property
    def sessions(self) -> frozenset[str]:
        """Return the sessions with entities."""
        found = {one.session for one in self._processes.values()}
        return frozenset(found | {one.session for one in self._entities.values()})

    @property
    def has_sources(self) -> bool:
        """Whether a process provides data; guests only wait for it."""
        guests = set()
        for one in self._processes.values():
            if one.role is not Role.GUEST:
                return True
            guests.add(one.session)
        return any(one.session not in guests for one in self._entities.values())

    def publisher(self, gid: bytes, topic: str) -> GraphEntity | None:
        """Return a message's publisher: by gid, else the only candidate; None if ambiguous."""
        unknown = []
        for one in self.entities(PUBLISHER, name=topic):
            if one.gid == gid:
                return one
            if self.process(one.session) is None:
                unknown.append(one)
        return unknown[0] if len(unknown) == 1 else None


def hosts(processes: Iterable[Process]) -> list[Process]:
    """Return the processes that run a world."""
    return [one for one in processes if one.role is Role.HOST]


def node_name(name: str) -> str:
    """Return a valid ROS node name: letters, digits and underscores."""
    name = re.sub(r"[^A-Za-z0-9_/]", "_", name.strip("/"))[:200]
    name = re.sub(r"/+", "/", name)
    return name if name and not name[0].isdigit() else f"_{name}"
