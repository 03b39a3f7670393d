"""Declarations of each middleware: options, contradictions, and names for sentences.

A middleware derives from `Reach` in its folder, as in `zenoh/reach.py`; one line in
`link_options.MIDDLEWARES` adds it. Commands do not name middlewares.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from tftool.world.link.link_options import Options
    from tftool.world.link.seam import Middleware


@dataclass(frozen=True, slots=True)
class LinkOption:
    """One option of the command line.

    Attributes:
        kind: The type of its value: bool, `list[str] | None` or `Path | None`.
        flag: The flag as typed, "--listen".
        text: Help.
        metavar: Name of its value in the help; None for a flag.
    """

    kind: Any
    flag: str
    text: str
    metavar: str | None = None


class Reach:
    """A middleware's reach beyond this machine's own processes.

    Derived as frozen data; made without arguments it opens nothing that was not asked for.
    """

    __slots__ = ()

    OPTIONS: ClassVar[Mapping[str, LinkOption]] = {}
    """Its options by the names of their parameters."""

    FLAGS: ClassVar[tuple[str, ...]] = ()
    """The options that open something, as sentences name them."""

    ALONE: ClassVar[str] = ""
    """Why its options do not go together with another middleware's."""

    is_robots: ClassVar[bool] = False
    """Whether it is among a robot's nodes: there, commands that only look write nothing, and
    static transforms that were lost come again."""

    only_reads: ClassVar[bool] = False
    """Whether nothing can be published by it."""

    SCHEMES: ClassVar[tuple[str, ...]] = ()
    """Beginnings of the addresses of its sessions, in lower case: "ws://"."""

    @classmethod
    def at(cls, address: str) -> "Reach":
        """Return the reach to a session by its address, which begins with one of `SCHEMES`.

        Raises:
            UsageError: If the address is malformed.
        """
        raise NotImplementedError

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> "Reach":
        """Combine the values of its options.

        Raises:
            UsageError: If options contradict each other.
            InputError: If a file is missing, or not of the stated kind.
        """
        raise NotImplementedError

    @property
    def is_asked(self) -> bool:
        """Whether a link is needed: always for a robot, which is in another process."""
        return True

    def awaits_others(self, *, hosts: bool) -> bool:
        """Whether the session is elsewhere, so that hosting a world makes no sense.

        Args:
            hosts: Whether the command hosts turtles where it finds none.
        """
        return not hosts

    @staticmethod
    def has_members(domain: int) -> bool:
        """Whether a local process can be joined, checked without opening a link."""
        return False

    @staticmethod
    def frames_known(domain: int) -> list[str]:
        """Return the frames listed by local processes, sorted, without opening a link."""
        return []

    def place(self, domain: int) -> str:
        """Describe where the others are; "" for this machine."""
        raise NotImplementedError

    def join(self, options: "Options") -> "Middleware":
        """Join a session; the middleware's library is imported here.

        Raises:
            LinkError: If there is no way in.
        """
        raise NotImplementedError
