"""Address of a Foxglove WebSocket server, as given in FROM."""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from tftool.base.errors import UsageError
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from tftool.world.link.link_options import Options
    from tftool.world.link.seam import Middleware

_ADDRESS: Final = re.compile(
    r"wss?://(?:[^\s/?#@]*@)?(?:\[[0-9a-f:.%]+\]|[^\s/?#@:\[\]]+)(?::([0-9]{1,5}))?(?:[/?][^\s#]*)?",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class FoxgloveReach(Reach):
    """Address of the one Foxglove server that a process reads.

    Attributes:
        address: Address of the server, such as "ws://robot:8765".
    """

    SCHEMES = ("ws://", "wss://")
    is_robots = True
    only_reads = True

    address: str = ""

    @classmethod
    def at(cls, address: str) -> "FoxgloveReach":
        """Create the `FoxgloveReach` of a server's address.

        Raises:
            UsageError: If the address is malformed.
        """
        found = _ADDRESS.fullmatch(address)
        if found is None or not 0 < int(found[1] or 1) < 65536:
            raise UsageError(f"'{address}' is not a server address: write ws://HOST:8765.")
        return cls(address)

    def awaits_others(self, *, hosts: bool) -> bool:
        """Return True: the session is always in another process."""
        return True

    def place(self, domain: int) -> str:
        """Return the address without any password or token."""
        scheme, _, rest = self.address.partition("://")
        host = re.split(r"[?]", rest, maxsplit=1)[0]
        authority, slash, path = host.partition("/")
        return f"{scheme.lower()}://{authority.rpartition('@')[2]}{slash}{path}"

    def join(self, options: "Options") -> "Middleware":
        """Connect to the server; see `Reach.join`."""
        # Imported here: asyncio's client takes 60 ms, and is only needed for this.
        from tftool.world.link.foxglove.middleware import FoxgloveMiddleware

        return FoxgloveMiddleware(options, self)
