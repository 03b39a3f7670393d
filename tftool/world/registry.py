"""Registry of a world's nodes, and of its services and actions.

Nodes know their world; the world knows them only as residents, so that the two modules do not
depend on each other.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, Generic, TypeVar

from tftool.base.errors import TftoolError

T = TypeVar("T")


class Resident:
    """Something named that runs in a world: a node, or a program with nodes.

    Attributes:
        name: Its name; no two residents of a world share one.
        rank: Its place among them: within a phase the one that joined first goes first.
        is_shown: Whether lists of nodes name it; a program that only carries nodes stays out.
    """

    name: str
    rank: int
    is_shown: ClassVar[bool] = True

    async def run(self) -> None:
        """Run it; it ends when this returns."""

    def close(self) -> None:
        """Close everything it offers; called at its end."""


@dataclass(frozen=True, slots=True)
class Offer(Generic[T]):
    """A service or an action.

    Attributes:
        take: Function that answers requests or takes goals.
        kind: The ROS class of the service or action. None where it is not stated; it stays inside
            the process then, and takes anything.
        node: The node that answers, "" where it is not stated.
        is_remote: Whether another process answers; a server here takes its place.
    """

    take: T
    kind: Any = None
    node: str = ""
    is_remote: bool = False


class NamedOffers(Generic[T]):
    """Services or actions by name, with their servers in order of succession.

    Attributes:
        by_name: Offers by name, read-only.
    """

    def __init__(self, what: str, changed: Callable[[], object]) -> None:
        """Start empty.

        Args:
            what: Their kind: "service", "action".
            changed: Called when an offer is added or removed.
        """
        self._what = what
        self._changed = changed
        self._first: dict[str, Offer[T]] = {}
        self._next: dict[str, list[Offer[T]]] = {}
        self.by_name: Mapping[str, Offer[T]] = MappingProxyType(self._first)

    def add(self, name: str, offer: Offer[T], *, shares: bool) -> Callable[[], None]:
        """Add a server; call the returned function to remove it.

        Args:
            name: Its name.
            offer: The offer.
            shares: Whether another of this process may have that name already.

        Raises:
            TftoolError: If another has, and it may not.
        """
        name = name.removeprefix("/")
        if name in self._first and not self._first[name].is_remote:
            if not shares:
                raise TftoolError(f"{self._what} '{name}' already has a server")
            self._next.setdefault(name, []).append(offer)
        else:
            self._first[name] = offer
            self._changed()

        def stop() -> None:
            later = [one for one in self._next.pop(name, ()) if one is not offer]
            leads = self._first.get(name) is offer
            if leads:
                del self._first[name]
                if later:
                    self._first[name] = later.pop(0)
            if later:
                self._next[name] = later
            if leads:
                self._changed()

        return stop

    def get(self, name: str) -> Offer[T] | None:
        """Return the active server; None if there is none."""
        return self._first.get(name.removeprefix("/"))

    def count(self, name: str) -> int:
        """Return the number of servers."""
        plain = name.removeprefix("/")
        return (plain in self._first) + len(self._next.get(plain, ()))
