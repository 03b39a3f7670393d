"""Network settings of DDS: ROS 2's environment variables and options, as Cyclone's configuration.

This module sends nothing. By default all messages stay on the loopback of this machine; the
library's own defaults would send to the whole network at once.
"""

import ipaddress
import os
import socket
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Final
from xml.sax.saxutils import quoteattr

from tftool.base.errors import LinkError

LOOPBACK: Final = "127.0.0.1"

MOST_PARTICIPANTS: Final = 120
"""Largest number of participants of one machine in a domain."""

_LARGE_PACKETS: Final = "<MaxMessageSize>65000B</MaxMessageSize><FragmentSize>62000B</FragmentSize>"
"""Setting for large packets on the loopback: one such packet replaces forty Ethernet packets."""

_RANGES: Final = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")


@dataclass(frozen=True, slots=True)
class Network:
    """Network in which a participant searches for other participants.

    Attributes:
        interfaces: Names or addresses of the network interfaces to use; empty to use the interfaces
            on the routes to the peers.
        peers: Addresses to connect to.
        config: Cyclone's configuration set by the user, which replaces tftool's; "" if not set.
        notices: Sentences for the user, such as a warning about an environment variable.
    """

    interfaces: tuple[str, ...] = ()
    peers: tuple[str, ...] = ()
    config: str = ""
    notices: tuple[str, ...] = ()

    def __str__(self) -> str:
        if self.config:
            return "the network of CYCLONEDDS_URI"
        return ", ".join([*self.interfaces, *self.peers]) or f"{LOOPBACK}, this machine only"

    @property
    def is_loopback(self) -> bool:
        """Whether nothing is sent beyond this machine."""
        return not (self.interfaces or self.peers or self.config)

    def xml(self) -> str:
        """Return the settings as Cyclone's configuration in XML."""
        if self.config:
            return self.config
        used = self.interfaces or (
            (LOOPBACK,) if self.is_loopback else _local_addresses(self.peers)
        )
        # On named interfaces, multicast finds processes as in ROS 2; named peers are contacted.
        multicast = "spdp" if self.interfaces else "false"
        peers = self.peers or ((LOOPBACK,) if self.is_loopback else ())
        # Processes of this machine are found even without multicast.
        peers = (*peers, *(one for one in _own(used) if one not in peers))
        return (
            '<CycloneDDS><Domain Id="any"><General><Interfaces>'
            + "".join(_interface(one) for one in used)
            + f"</Interfaces><AllowMulticast>{multicast}</AllowMulticast>"
            f"<DontRoute>{'true' if self.is_loopback else 'false'}</DontRoute>"
            f"{_LARGE_PACKETS if self.is_loopback else ''}</General>"
            "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
            f"<MaxAutoParticipantIndex>{MOST_PARTICIPANTS}</MaxAutoParticipantIndex><Peers>"
            + "".join(f"<Peer address={quoteattr(one)}/>" for one in peers)
            + "</Peers></Discovery>"
            # Errors are read from `LIBRARY_LOG`; tracing would write far more.
            "<Tracing><Verbosity>none</Verbosity></Tracing></Domain></CycloneDDS>"
        )


def network(places: Iterable[str], environment: Mapping[str, str] | None = None) -> Network:
    """Return the network in which to search for other participants.

    Args:
        places: Interfaces, and addresses or names of machines, from the option --dds-on.
        environment: Environment variables; None for those of this process.

    Raises:
        LinkError: If a place is neither an interface nor a machine, or an environment variable
            forbids the discovery.
    """
    variables = os.environ if environment is None else environment
    interfaces: list[str] = []
    peers: list[str] = []
    for place in places:
        # An address of this machine selects an interface, an address of another one is a peer.
        (interfaces if _is_own(place) else peers).append(_checked(place))
    confined = _confined(variables)
    static = tuple(one.strip() for one in variables.get("ROS_STATIC_PEERS", "").split(";"))
    static = tuple(one for one in static if one)
    # This applies without --dds-on, and unless a variable limits ROS 2 to this machine.
    config = variables.get("CYCLONEDDS_URI", "").strip()
    outward = [one for one in (*interfaces, *peers) if not _is_loopback(one)]
    if confined and outward:
        raise LinkError(
            f"{confined} restricts ROS 2 to this machine, which --dds-on {outward[0]} contradicts: "
            "unset the variable, or leave out --dds-on"
        )
    if config and not places and not confined:
        told = "CYCLONEDDS_URI is set: DDS uses the network of that configuration, not "
        return Network(config=config, notices=(f"{told}the loopback only.",))
    told = ""
    # ROS_STATIC_PEERS alone does not open the network: only --dds-on does.
    if interfaces or peers:
        peers += [_checked(one) for one in static if one not in peers and not confined]
    elif any(not _is_loopback(one) for one in static):
        told = (
            f"ROS_STATIC_PEERS names {', '.join(static)}, but --dds alone uses only the loopback: "
            f"--dds-on {static[0]} connects to it."
        )
    if all(_is_loopback(one) for one in (*interfaces, *peers)):
        return Network(notices=(told,) if told else ())
    return Network(tuple(interfaces), tuple(peers), notices=(told,) if told else ())


def _confined(variables: Mapping[str, str]) -> str:
    """Return the name of the variable that limits ROS 2 to this machine; "" if none does.

    Raises:
        LinkError: If a variable forbids discovery altogether, or has a value unknown to ROS 2.
    """
    reach = variables.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").strip().upper()
    if reach and reach not in _RANGES:
        raise LinkError(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is '{reach[:60]}': set it to one of "
            f"{', '.join(_RANGES)}"
        )
    if reach == "OFF":
        raise LinkError(
            "ROS_AUTOMATIC_DISCOVERY_RANGE=OFF turns discovery off, so no process can be found: "
            "unset the variable, or set it to LOCALHOST"
        )
    # If both are set, ROS 2 uses the older one.
    if variables.get("ROS_LOCALHOST_ONLY", "").strip() == "1":
        return "ROS_LOCALHOST_ONLY=1"
    return "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST" if reach == "LOCALHOST" else ""


def _checked(place: str) -> str:
    """Return an interface's name or an IP address unchanged, and a machine's name as its address.

    Raises:
        LinkError: If `place` is neither an interface nor a machine whose address is found.
    """
    if place in _interfaces():
        return place
    try:
        return str(ipaddress.ip_address(place))
    except ValueError:
        pass
    try:
        found = socket.getaddrinfo(place, None, socket.AF_INET, socket.SOCK_DGRAM)
    except (OSError, UnicodeError) as error:
        raise LinkError(
            f"'{place[:80]}' is neither an interface of this machine ({', '.join(_interfaces())}) "
            "nor the address of another machine"
        ) from error
    return str(found[0][4][0])


def _interfaces() -> list[str]:
    try:
        return [name for _, name in socket.if_nameindex()]
    except (AttributeError, OSError):
        return []


def _is_own(place: str) -> bool:
    """Return whether `place` is the name or address of an interface of this machine."""
    if place in _interfaces():
        return True
    try:
        address = ipaddress.ip_address(place)
    except ValueError:
        return False
    family = socket.AF_INET if address.version == 4 else socket.AF_INET6
    # Only this machine's own addresses can be bound.
    with socket.socket(family, socket.SOCK_DGRAM) as trial:
        try:
            trial.bind((place, 0))
        except OSError:
            return False
    return True


def _is_loopback(place: str) -> bool:
    if place in ("lo", "lo0"):
        return True
    try:
        return ipaddress.ip_address(place).is_loopback
    except ValueError:
        return False


def _own(interfaces: Iterable[str]) -> list[str]:
    """Return the items of `interfaces` that are addresses, not names of interfaces."""
    return [one for one in interfaces if one not in _interfaces()]


def _local_addresses(peers: Iterable[str]) -> tuple[str, ...]:
    """Return the addresses of this machine that packets to `peers` would have as sender.

    No packet is sent.

    Raises:
        LinkError: If no route leads to a peer.
    """
    found = []
    for peer in peers:
        family = socket.AF_INET6 if ":" in peer else socket.AF_INET
        with socket.socket(family, socket.SOCK_DGRAM) as trial:
            try:
                trial.connect((peer, 7400))
            except OSError as error:
                raise LinkError(f"{peer} cannot be reached: {error.strerror}") from error
            address = str(trial.getsockname()[0])
        # One participant cannot use both loopback and other addresses.
        if address not in found and not _is_loopback(address):
            found.append(address)
    return tuple(found) or (LOOPBACK,)


def _interface(place: str) -> str:
    kind = "name" if place in _interfaces() else "address"
    return f"<NetworkInterface {kind}={quoteattr(place)}/>"


def other_domains(domain: int) -> list[int]:
    """Return the other domains in use on this machine, found by open ports (Linux only)."""
    return sorted(set(_listening()) - {domain})


def participants_here(domain: int) -> int:
    """Count this machine's participants in a domain, including this process (Linux only)."""
    return _listening().get(domain, 0)


def _listening() -> dict[int, int]:
    """Return the number of this machine's participants by domain; empty if unknown."""
    ports: set[int] = set()
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        try:
            with open(table, encoding="ascii") as file:
                lines = file.read().splitlines()[1:]
        except OSError:
            continue
        # The second column is the local address, both of its parts in hexadecimal.
        ports |= {int(line.split()[1].rpartition(":")[2], 16) for line in lines}
    found: dict[int, int] = {}
    for port in ports:
        # RTPS: each domain has 250 ports from 7400 on, each participant two of them from 10 on.
        number, rest = divmod(port - 7400, 250)
        # A participant has two successive ports. Ports of higher domains may be any program's.
        if number in range(101) and rest >= 10 and rest % 2 == 0 and port + 1 in ports:
            found[number] = found.get(number, 0) + 1
    return found
