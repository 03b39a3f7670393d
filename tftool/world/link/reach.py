"""Base of a middleware's declaration: its options, their contradictions, text for messages.

A middleware derives a class from `Reach` in its folder, as in `zenoh/reach.py`; one line in
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
    """Option of the command line for a middleware.

    Attributes:
        kind: Type of the value: bool, `list[str] | None` or `Path | None`.
        flag: The flag as typed, such as "--listen".
        text: Help text.
        metavar: Name of the value in the help; None for a flag without a value.
    """

    kind: Any
    flag: str
    text: str
    metavar: str | None = None


class Reach:
    """Networks and processes that a middleware may use, beyond this machine's own processes.

    Subclasses are frozen dataclasses. Without arguments, an object opens nothing to the outside.
    """

    __slots__ = ()

    OPTIONS: ClassVar[Mapping[str, LinkOption]] = {}
    """Options of the middleware, by the names of their parameters."""

    FLAGS: ClassVar[tuple[str, ...]] = ()
    """Options that open a connection to the outside, as sentences name them."""

    ALONE: ClassVar[str] = ""
    """Sentence on why its options cannot be combined with another middleware's."""

    is_robots: ClassVar[bool] = False
    """Whether the other processes are a robot's nodes: there, commands that only read send nothing,
    and wait longer for static transforms."""

    only_reads: ClassVar[bool] = False
    """Whether the middleware can only read, not publish."""

    SCHEMES: ClassVar[tuple[str, ...]] = ()
    """Beginnings of the addresses of its sessions, in lower case: "ws://"."""

    @classmethod
    def at(cls, address: str) -> "Reach":
        """Return the reach of the session at an address; None for a word that is no address.

        Raises:
            UsageError: If the word begins like an address, but is malformed.
        """
        raise NotImplementedError

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> "Reach":
        """Return the reach that the middleware's options describe.

        Raises:
            UsageError: If options contradict each other.
            InputError: If a file that an option names is missing, or of the wrong kind.
        """
        raise NotImplementedError

    @property
    def is_asked(self) -> bool:
        """Whether the options require a connection to other processes."""
        return True

    def awaits_others(self, *, hosts: bool) -> bool:
        """Return whether the session is always in another process, so this process never hosts it.

        Args:
            hosts: Whether the command runs a world itself if no other process runs one.
        """
        return not hosts

    @staticmethod
    def has_members(domain: int) -> bool:
        """Return whether there is a local process to join; the check connects to none."""
        return False

    @staticmethod
    def frames_known(domain: int) -> list[str]:
        """Return the names of the frames that this machine's processes have, without connecting."""
        return []

    def place(self, domain: int) -> str:
        """Describe where the other processes are; "" for this machine."""
        raise NotImplementedError

    def join(self, options: "Options") -> "Middleware":
        """Join a session; the middleware's library is imported here.

        Raises:
            LinkError: If the session cannot be joined.
        """
        raise NotImplementedError
