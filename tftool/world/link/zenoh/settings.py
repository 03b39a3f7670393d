"""How a link's options become the configuration of a zenoh session.

zenoh is imported when a link opens and not before: commands that host alone do not
pay for it, and a platform without it can still do everything else.
"""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tftool.base.errors import LinkError
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.link.zenoh.rendezvous import USER

_CONGESTED = 1_000_000  # microseconds a sender waits for a reader that takes nothing
_NEAR_HELLO, _FAR_HELLO = 1000, 5000  # milliseconds for two processes to get to know each other
_SCOUTING_DELAY = 100  # milliseconds `open` waits at most for a peer that does not answer


@dataclass(frozen=True, slots=True)
class Local:
    """Where a process meets the others of its machine.

    Attributes:
        endpoint: Where it listens for them, "" for nowhere.
        others: Where they listen.
        password: What all of them know, "" where none is needed.
        passwords: The file that has it, as zenoh reads it.
    """

    endpoint: str = ""
    others: tuple[str, ...] = ()
    password: str = ""
    passwords: Path = Path()


def import_zenoh() -> Any:
    """The library.

    Raises:
        LinkError: If it is missing.
    """
    try:
        import zenoh
    except ImportError as error:
        raise LinkError(
            "talking to other processes needs 'eclipse-zenoh', which is missing here "
            f"({error}); hosting works without it: --host"
        ) from error
    return zenoh


def open_zenoh(zenoh: Any, reach: ZenohReach, local: Local) -> Any:
    """Open a zenoh session.

    Args:
        zenoh: The library.
        reach: What to open beyond this machine.
        local: Where this machine's processes meet.

    Raises:
        LinkError: If an endpoint or a file cannot be used.
    """
    try:
        if reach.config is not None:
            config = zenoh.Config.from_file(str(reach.config))
            # By default a peer has none, and latched messages are told apart by their time.
            config.insert_json5("timestamping/enabled", "true")
        else:
            config = zenoh.Config()
            for key, value in settings(reach, local).items():
                config.insert_json5(key, json.dumps(value))
        return zenoh.open(config)
    except Exception as error:
        reason = str(error).partition(" at /")[0]
        where = ", ".join([str(reach.config or ""), *reach.listen, *reach.connect]).strip(", ")
        raise LinkError(
            f"the link cannot be opened{f' ({where})' if where else ''}: {reason}"
        ) from error


def settings(reach: ZenohReach, local: Local) -> dict[str, Any]:
    """What we tell zenoh, by its own names; its defaults would listen on every interface."""
    outward = bool(reach.listen or reach.connect)
    found: dict[str, Any] = {
        # A router passes on between this machine's processes, which know each other
        # directly, and the world outside; a peer passes nothing on.
        "mode": "router" if outward else "peer",
        "listen/endpoints": [*([local.endpoint] if local.endpoint else []), *reach.listen],
        "connect/endpoints": [*local.others, *reach.connect],
        "listen/exit_on_failure": True,
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "scouting/multicast/enabled": False,
        # Gossip tells routers who knows whom; the addresses it carries are not to be used.
        "scouting/gossip/enabled": True,
        "scouting/gossip/autoconnect": {"router": [], "peer": [], "client": []},
        "scouting/delay": _SCOUTING_DELAY,
        # Latched messages are told apart by their time.
        "timestamping/enabled": True,
        "transport/shared_memory/enabled": False,
        # A stopped process takes a connection and never speaks: closing would wait for it.
        "transport/unicast/open_timeout": _FAR_HELLO if outward else _NEAR_HELLO,
        "transport/unicast/accept_timeout": _FAR_HELLO if outward else _NEAR_HELLO,
        "transport/link/tx/queue/congestion_control/block/wait_before_close": _CONGESTED,
    }
    if local.password:
        found |= {
            "transport/auth/usrpwd/user": USER,
            "transport/auth/usrpwd/password": local.password,
            "transport/auth/usrpwd/dictionary_file": str(local.passwords),
        }
    if reach.certificates is not None:
        files = reach.certificates
        found |= {
            "transport/link/tls/root_ca_certificate": str(files.authority),
            "transport/link/tls/listen_certificate": str(files.certificate),
            "transport/link/tls/listen_private_key": str(files.key),
            "transport/link/tls/connect_certificate": str(files.certificate),
            "transport/link/tls/connect_private_key": str(files.key),
            "transport/link/tls/enable_mtls": True,
        }
    return found
