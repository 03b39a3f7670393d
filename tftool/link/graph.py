"""Who is there: processes, nodes, and what they offer, as their tokens tell."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Final

from tftool.link import keys
from tftool.link.keys import Entity
from tftool.stamps import Stamp

MOST: Final = 20_000
"""Tokens that are kept; what strangers show on top of that is passed over."""

MOST_DOMAINS: Final = 100
"""Other domains that are remembered, to say so once of each."""

_PROCESS = re.compile(
    rf"{re.escape(keys.OURS)}/(?P<domain>\d{{1,9}})/(?P<session>[0-9a-f]{{1,32}})/"
    r"(?P<since>\d{1,19})/(?P<pid>\d{1,9})/(?P<role>host|source|guest)/(?P<command>\w{1,64})",
    re.ASCII,
)


class Role(str, Enum):
    """What a tftool is to the others of its session.

    Attributes:
        HOST: It runs the world that others look at.
        SOURCE: It brings something of its own, a static transform or a user's node.
        GUEST: It only takes part, and waits for somebody who brings something.
    """

    HOST = "host"
    SOURCE = "source"
    GUEST = "guest"


@dataclass(frozen=True, slots=True)
class Process:
    """A tftool in the session, as it presents itself.

    Attributes:
        domain: Number of its ROS domain.
        session: Its zenoh session, in hexadecimal.
        since: When it joined, by its own clock.
        pid: Its process number on its machine.
        role: What it is to the others.
        command: What it was called for: "demo", "echo".
    """

    domain: int
    session: str
    since: Stamp
    pid: int
    role: Role
    command: str

    def token(self) -> str:
        """The key of its token."""
        command = re.sub(r"\W", "_", self.command, flags=re.ASCII)[:64] or "_"
        who = f"{self.session}/{self.since}/{self.pid}/{self.role.value}"
        return f"{keys.OURS}/{self.domain}/{who}/{command}"

    def __str__(self) -> str:
        return f"'tftool {self.command}' (process {self.pid})"


def parse_process(token: str) -> Process | None:
    """What the token of a tftool tells; None for any other."""
    found = _PROCESS.fullmatch(token)
    if found is None:
        return None
    return Process(
        int(found["domain"]),
        found["session"],
        int(found["since"]),
        int(found["pid"]),
        Role(found["role"]),
        found["command"],
    )


class Graph:
    """Everybody else's tokens.

    Attributes:
        own: Our own zenoh session, whose tokens are passed over.
        domain: The domain we are in.
    """

    def __init__(self, own: str, domain: int) -> None:
        self.own = own
        self.domain = domain
        self._entities: dict[str, Entity] = {}
        self._by_name: dict[str, dict[str, Entity]] = {}
        self._processes: dict[str, Process] = {}
        self._foreign: set[int] = set()

    def add(self, token: str) -> Entity | Process | None:
        """Take a token in.

        Returns:
            What is new by it; None when nothing is.
        """
        if token in self._entities or token in self._processes:
            return None
        if len(self._entities) + len(self._processes) >= MOST:
            return None
        found = keys.parse_token(token) or parse_process(token)
        if found is None or found.session == self.own:
            return None
        if found.domain != self.domain:
            if len(self._foreign) < MOST_DOMAINS:
                self._foreign.add(found.domain)
            return None
        if isinstance(found, Entity):
            self._entities[token] = found
            self._by_name.setdefault(found.name, {})[token] = found
        else:
            self._processes[token] = found
        return found

    def remove(self, token: str) -> Entity | Process | None:
        """Let a token go.

        Returns:
            What is gone by it; None when it was not known.
        """
        gone = self._entities.pop(token, None)
        if gone is None:
            return self._processes.pop(token, None)
        namesakes = self._by_name[gone.name]
        del namesakes[token]
        if not namesakes:
            del self._by_name[gone.name]
        return gone

    @property
    def foreign_domains(self) -> frozenset[int]:
        """Other domains that were heard of."""
        return frozenset(self._foreign)

    def processes(self) -> list[Process]:
        """Every tftool, the one that is there longest first."""
        return sorted(self._processes.values(), key=lambda one: (one.since, one.session))

    def process(self, session: str) -> Process | None:
        """The tftool that a zenoh session belongs to."""
        return next((one for one in self._processes.values() if one.session == session), None)

    def entities(self, *kinds: str, name: str | None = None) -> list[Entity]:
        """Everything of some kinds, of one name if one is given."""
        found = self._entities if name is None else self._by_name.get(name, {})
        return [one for one in found.values() if not kinds or one.kind in kinds]

    @property
    def is_empty(self) -> bool:
        """Whether nobody else is there."""
        return not self._entities and not self._processes

    @property
    def sessions(self) -> frozenset[str]:
        """The zenoh sessions that show a token."""
        found = {one.session for one in self._processes.values()}
        return frozenset(found | {one.session for one in self._entities.values()})

    @property
    def has_sources(self) -> bool:
        """Whether somebody is there who brings something; guests alone only wait."""
        guests = set()
        for one in self._processes.values():
            if one.role is not Role.GUEST:
                return True
            guests.add(one.session)
        return any(one.session not in guests for one in self._entities.values())

    def publisher(self, gid: bytes, topic: str) -> Entity | None:
        """Who sent a message: by its gid, else the only one it can be; None if that is unclear."""
        unknown = []
        for one in self.entities(keys.PUBLISHER, name=topic):
            if keys.gid_of(one.token()) == gid:
                return one
            if self.process(one.session) is None:
                unknown.append(one)
        return unknown[0] if len(unknown) == 1 else None


def hosts(processes: Iterable[Process]) -> list[Process]:
    """Those among some processes that run a world."""
    return [one for one in processes if one.role is Role.HOST]
