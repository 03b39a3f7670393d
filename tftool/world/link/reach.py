"""Base class with which a middleware declares its command-line options and addresses.

A middleware derives a class from `Reach` in its folder, as in `zenoh/reach.py`; one line in
`link_options.MIDDLEWARES` adds the class. Commands do not name middlewares.
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

    Subclasses are frozen dataclasses. An object created without arguments opens no connection to
    other machines.
    """

    __slots__ = ()

    OPTIONS: ClassVar[Mapping[str, LinkOption]] = {}
    """Command-line options of the middleware, by parameter name."""

    FLAGS: ClassVar[tuple[str, ...]] = ()
    """Options that open a connection to other machines, as text for messages."""

    ALONE: ClassVar[str] = ""
    """Sentence about the reason why these options exclude those of another middleware."""

    is_robots: ClassVar[bool] = False
    """Whether the other processes are a robot's nodes. Commands that only read then send nothing,
    and wait longer for static transforms."""

    only_reads: ClassVar[bool] = False
    """Whether the middleware can only read, not publish."""

    SCHEMES: ClassVar[tuple[str, ...]] = ()
    """First characters of the addresses of sessions, in lower case, such as "ws://"."""

    @classmethod
    def at(cls, address: str) -> "Reach":
        """Create the `Reach` of the session at an address.

        Raises:
            UsageError: If the address is malformed.
        """
        raise NotImplementedError

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> "Reach":
        """Create a `Reach` from the given values of the middleware's options.

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
        """Return whether another process always hosts the session, and this process never does.

        Args:
            hosts: Whether the command runs a world itself if no other process runs one.
        """
        return not hosts

    @staticmethod
    def has_members(domain: int) -> bool:
        """Return whether this process could join a local process; do not connect."""
        return False

    @staticmethod
    def frames_known(domain: int) -> list[str]:
        """Return the names of the frames of this machine's processes; do not connect."""
        return []

    def place(self, domain: int) -> str:
        """Return where the other processes are, as text for messages; "" for this machine."""
        raise NotImplementedError

    def join(self, options: "Options") -> "Middleware":
        """Import the middleware's library, and join a session.

        Raises:
            LinkError: If the session cannot be joined.
        """
        raise NotImplementedError
