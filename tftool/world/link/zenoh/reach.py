"""Options for a zenoh connection, and checks for contradictions between options."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

from tftool.base.errors import InputError, UsageError
from tftool.world.link.reach import LinkOption, Reach

if TYPE_CHECKING:
    from tftool.world.link.link_options import Options
    from tftool.world.link.seam import Middleware

PROTOCOLS: Final = ("tcp", "udp", "tls", "quic", "ws", "unixsock-stream")
"""Protocols with which an endpoint may begin."""

SECURED: Final = ("tls", "quic")
"""Protocols in which both sides show certificates."""

_PATHS: Final = ("unixsock-stream",)  # protocols whose address is a file
_PORT = re.compile(r".+:[0-9]{1,5}", re.ASCII)


@dataclass(frozen=True, slots=True)
class Certificates:
    """Files for mutual TLS: this process's certificate and key, and the trusted authority.

    Attributes:
        certificate: Certificate of this process, PEM.
        key: Private key of this process, PEM.
        authority: Certificate of the authority that signed the other process's certificate, PEM.
    """

    certificate: Path
    key: Path
    authority: Path

    def check(self) -> None:
        """Check the content of each file, because zenoh's own errors do not name the file.

        Raises:
            InputError: If a file is not a certificate or key as expected, or the key belongs to
                another certificate.
        """
        import ssl

        file = self.certificate
        try:
            ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_verify_locations(file)
            file = self.authority
            ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_verify_locations(file)
        except ssl.SSLError as error:
            raise InputError(f"'{file}' contains no certificate in PEM format.") from error
        except OSError as error:
            raise InputError(f"'{file}' cannot be read: {error.strerror}.") from error
        try:
            # With an empty password, or openssl would ask for one in the terminal.
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
            context.load_cert_chain(self.certificate, self.key, password="")
        except ssl.SSLError as error:
            raise InputError(self._unusable(error.reason)) from error
        except OSError as error:
            raise InputError(f"'{self.key}' cannot be read: {error.strerror}.") from error

    def _unusable(self, reason: str | None) -> str:
        if reason == "KEY_VALUES_MISMATCH":
            return f"'{self.key}' is not the key of the certificate '{self.certificate}'."
        if reason:
            told = reason.lower().replace("_", " ")
            return f"'{self.certificate}' cannot be used with '{self.key}': {told}."
        return f"'{self.key}' contains no private key in PEM, or a key with a password."


@dataclass(frozen=True, slots=True)
class ZenohReach(Reach):
    """Networks that a zenoh connection may use; by default only this machine's processes.

    Attributes:
        listen: Endpoints on which other machines may connect, such as "tcp/0.0.0.0:7448".
        connect: Endpoints to connect to, such as "tcp/robot:7447".
        certificates: Files for endpoints that begin with tls/ or quic/.
        config: File with a zenoh configuration (JSON5) that replaces tftool's.
    """

    OPTIONS: ClassVar[Mapping[str, LinkOption]] = {
        "listen": LinkOption(
            list[str] | None,
            "--listen",
            "Accept connections from other machines, at tcp/0.0.0.0:7448 for example. Everyone "
            "who reaches that port can see and drive everything: use tls/ in a shared network.",
            "ENDPOINT",
        ),
        "connect": LinkOption(
            list[str] | None,
            "--connect",
            "Join the session of another machine, or a zenoh router of ROS 2: tcp/localhost:7447.",
            "ENDPOINT",
        ),
        "tls_cert": LinkOption(
            Path | None, "--tls-cert", "Certificate of this machine, for tls/ endpoints.", "FILE"
        ),
        "tls_key": LinkOption(Path | None, "--tls-key", "Private key of --tls-cert.", "FILE"),
        "tls_ca": LinkOption(
            Path | None,
            "--tls-ca",
            "Certificate of the authority that signed the certificate of the other machine.",
            "FILE",
        ),
        "zenoh_config": LinkOption(
            Path | None, "--zenoh-config", "Configuration file of zenoh, used unchanged.", "FILE"
        ),
    }
    FLAGS: ClassVar[tuple[str, ...]] = ("--listen", "--connect", "--zenoh-config")

    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    certificates: Certificates | None = None
    config: Path | None = None

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> "ZenohReach":
        """Create a `ZenohReach` from the given options; see `Reach.read`."""
        listen, connect = tuple(given.get("listen") or ()), tuple(given.get("connect") or ())
        config: Path | None = given.get("zenoh_config")
        if config is not None and (listen or connect):
            raise UsageError(
                "--zenoh-config already sets all endpoints: leave out --listen and --connect, or "
                "--zenoh-config."
            )
        files = [given.get(name) for name in ("tls_cert", "tls_key", "tls_ca")]
        for file in (*files, config):
            if file is not None and not file.is_file():
                raise InputError(f"There is no file '{file}'.")
        certificates = _tls(*files)
        for endpoint in (*listen, *connect):
            _check_endpoint(endpoint, has_files=certificates is not None)
        return cls(listen, connect, certificates, config)

    @property
    def is_asked(self) -> bool:
        """Whether the options require a connection to other processes."""
        return bool(self.listen or self.connect or self.config is not None)

    def awaits_others(self, *, hosts: bool) -> bool:
        """Return whether the session is on another machine, given by `connect`."""
        return bool(self.connect)

    @staticmethod
    def has_members(domain: int) -> bool:
        """Return whether this process could join a local process; see `Reach.has_members`."""
        # Imported here: sockets and hashes take 10 ms, and most commands do not need this.
        from tftool.world.link.zenoh import rendezvous

        return rendezvous.has_members(domain)

    @staticmethod
    def frames_known(domain: int) -> list[str]:
        """Return the names of the frames of this machine's processes; see `Reach.frames_known`."""
        from tftool.world.link.zenoh import rendezvous

        return rendezvous.frames_known(domain)

    def place(self, domain: int) -> str:
        """Return the endpoints to connect to, as text."""
        return ", ".join(self.connect)

    def join(self, options: "Options") -> "Middleware":
        """Join a session over zenoh; see `Reach.join`."""
        from tftool.world.link.zenoh.middleware import ZenohMiddleware

        return ZenohMiddleware(options, self)


def protocol_of(endpoint: str) -> str:
    """Return the protocol of an endpoint, such as "tcp"."""
    return endpoint.partition("/")[0]


def has_port(endpoint: str) -> bool:
    """Return whether an endpoint has the port that zenoh needs; paths need no port."""
    protocol, _, rest = endpoint.partition("/")
    # After a question mark or a hash are zenoh's settings of the endpoint.
    address = re.split(r"[?#]", rest, maxsplit=1)[0]
    return protocol in _PATHS or _PORT.fullmatch(address) is not None


def _tls(cert: Path | None, key: Path | None, ca: Path | None) -> Certificates | None:
    """Return the files for mutual TLS; None if none of the three files is given."""
    if cert is None or key is None or ca is None:
        if cert or key or ca:
            raise UsageError(
                "TLS needs certificates of both sides: give --tls-cert, --tls-key and --tls-ca "
                "together."
            )
        return None
    files = Certificates(cert, key, ca)
    files.check()
    return files


def _check_endpoint(endpoint: str, *, has_files: bool) -> None:
    protocol, slash, address = endpoint.partition("/")
    if not slash or not address or protocol not in PROTOCOLS:
        raise UsageError(
            f"'{endpoint}' is not an endpoint: write PROTOCOL/ADDRESS, such as "
            f"tcp/192.168.1.5:7448, with one of {', '.join(PROTOCOLS)}."
        )
    if not has_port(endpoint):
        raise UsageError(
            f"'{endpoint}' has no port: write {protocol}/HOST:PORT, such as "
            f"{protocol}/192.168.1.5:7448."
        )
    if protocol in SECURED and not has_files:
        raise UsageError(f"'{endpoint}' needs --tls-cert, --tls-key and --tls-ca.")
