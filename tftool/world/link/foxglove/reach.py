"""Address of a Foxglove WebSocket server, as given in FROM."""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from tftool.base.errors import UsageError
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from tftool.world.link.link_options import Options
    from tftool.world.link.seam import Middleware

_SCHEME: Final = re.compile(r"wss?://", re.IGNORECASE)
_ADDRESS: Final = re.compile(
    r"wss?://(?:[^\s/?#@]*@)?(?:\[[0-9a-f:.%]+\]|[^\s/?#@:\[\]]+)(?::([0-9]{1,5}))?(?:[/?][^\s#]*)?",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class FoxgloveReach(Reach):
    """Reach of a client that reads one server.

    Attributes:
        address: Address of the server, "ws://robot:8765".
    """

    is_robots = True
    only_reads = True

    address: str = ""

    @classmethod
    def at(cls, word: str) -> "FoxgloveReach | None":
        """Return the reach to the server whose address a word is; see `Reach.at`."""
        if _SCHEME.match(word) is None:
            return None
        found = _ADDRESS.fullmatch(word)
        if found is None or not 0 < int(found[1] or 1) < 65536:
            raise UsageError(f"'{word}' is not a server address: write ws://HOST:8765.")
        return cls(word)

    def awaits_others(self, *, hosts: bool) -> bool:
        """Whether the session is elsewhere: always."""
        return True

    def place(self, domain: int) -> str:
        """Return the address without any password or token."""
        scheme, _, rest = self.address.partition("://")
        host = re.split(r"[?]", rest, maxsplit=1)[0]
        authority, slash, path = host.partition("/")
        return f"{scheme.lower()}://{authority.rpartition('@')[2]}{slash}{path}"

    def join(self, options: "Options") -> "Middleware":
        """Connect to the server; see `Reach.join`."""
        # asyncio's client takes 60 ms to import, and no other command needs it.
        from tftool.world.link.foxglove.middleware import FoxgloveMiddleware

        return FoxgloveMiddleware(options, self)
