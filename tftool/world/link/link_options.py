"""How a process takes part in a session, whatever carries it."""

import os
from dataclasses import dataclass, field
from pathlib import Path

from tftool.base.errors import InputError, UsageError

LARGEST_DOMAIN = 232
"""ROS 2's own limit."""


@dataclass(frozen=True, slots=True)
class Certificates:
    """Files for mutual TLS: who we are, and whom we believe.

    Attributes:
        certificate: Our certificate, PEM.
        key: Its private key, PEM.
        authority: The certificate that signed the other side's, PEM.
    """

    certificate: Path
    key: Path
    authority: Path

    def check(self) -> None:
        """See that the files are what they are given as; zenoh says of none which is not.

        Raises:
            InputError: If one is no such PEM file, or the key is another certificate's.
        """
        import ssl

        file = self.certificate
        try:
            ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_verify_locations(file)
            file = self.authority
            ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_verify_locations(file)
        except ssl.SSLError as error:
            raise InputError(f"'{file}' holds no certificate in PEM.") from error
        except OSError as error:
            raise InputError(f"'{file}' cannot be read: {error.strerror}.") from error
        try:
            # A password to go with it, or openssl would ask for one in the terminal.
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
        return f"'{self.key}' holds no private key in PEM, or one with a password."


@dataclass(frozen=True, slots=True)
class Reach:
    """What a link opens beyond this machine's own processes; nothing unless asked.

    Attributes:
        listen: Endpoints where other machines may come in, "tcp/0.0.0.0:7448".
        connect: Endpoints to go to, "tcp/robot:7447".
        certificates: For endpoints that begin with tls/ or quic/.
        config: A zenoh configuration, JSON5, taken in place of ours.
        interfaces: Over DDS: interfaces to use and addresses to go to beyond the loopback.
    """

    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    certificates: Certificates | None = None
    config: Path | None = None
    interfaces: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Options:
    """How a process takes part.

    Attributes:
        command: What it is called for: "demo", "echo".
        domain: Number of the ROS domain.
        reach: What to open beyond this machine's own processes.
        read_only: Only look: declare no publisher, no service and no token.
        middleware: What carries it, one of `seam.MIDDLEWARES`.
    """

    command: str = "tftool"
    domain: int = 0
    reach: Reach = field(default_factory=Reach)
    read_only: bool = False
    middleware: str = "zenoh"


def domain_here() -> int:
    """Return the domain that ROS_DOMAIN_ID names, else 0.

    Raises:
        UsageError: If it is no domain.
    """
    text = os.environ.get("ROS_DOMAIN_ID", "")
    if not text:
        return 0
    if not (text.isascii() and text.isdigit() and int(text[:9]) <= LARGEST_DOMAIN):
        raise UsageError(f"ROS_DOMAIN_ID is '{text}', not a number from 0 to {LARGEST_DOMAIN}.")
    return int(text)
