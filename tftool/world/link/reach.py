"""Declarations of each middleware: its options, their contradictions, and its words.

A middleware derives from `Reach` in its folder, as `zenoh/reach.py` does; one line in
`link_options.MIDDLEWARES` adds it. Commands know no middleware by its name.
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
        flag: How it is written, "--listen".
        text: Its help.
        metavar: What its value is called; None for a flag.
    """

    kind: Any
    flag: str
    text: str
    metavar: str | None = None


class Reach:
    """Reach of a link of one middleware beyond this machine's own processes.

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

    @classmethod
    def at(cls, word: str) -> "Reach | None":
        """Return the reach to the session that a word is the address of; None if it is none.

        Raises:
            UsageError: If it begins as such an address, and is wrong.
        """
        return None

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> "Reach":
        """Put the values of its options together.

        Raises:
            UsageError: If they contradict each other.
            InputError: If a file is not there, or not what it is given as.
        """
        raise NotImplementedError

    @property
    def is_asked(self) -> bool:
        """Whether something was asked for that only a link can give."""
        raise NotImplementedError

    def awaits_others(self, *, hosts: bool) -> bool:
        """Whether the session is elsewhere, so that a world of one's own has no place in it.

        Args:
            hosts: Whether the command hosts turtles where it finds none.
        """
        raise NotImplementedError

    @staticmethod
    def has_members(domain: int) -> bool:
        """Whether a process of this machine waits to be joined; nothing is opened."""
        return False

    @staticmethod
    def frames_known(domain: int) -> list[str]:
        """Return the frames that this machine's processes list, sorted; nothing is opened."""
        return []

    def place(self, domain: int) -> str:
        """Return where the others are, in words; "" for this machine."""
        raise NotImplementedError

    def join(self, options: "Options") -> "Middleware":
        """Join a session; the middleware's library is imported here and not before.

        Raises:
            LinkError: If there is no way in.
        """
        raise NotImplementedError
