"""A zenoh session whose callbacks arrive on our event loop: the one file that knows zenoh.

zenoh is imported when a link opens and not before: commands that host alone do not
pay for it, and a platform without it can still do everything else.
"""

import asyncio
import contextlib
import json
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

from tftool.errors import LinkError
from tftool.link.cdr import LARGEST

MOST_WAITING = 50_000
"""Messages that may wait for the event loop; what comes on top is lost, and counted."""

MOST_BYTES = 256 * 1024 * 1024
"""Bytes of payload that may wait."""

_SLICE = 200
_CONGESTED = 1_000_000  # microseconds a sender waits for a reader that takes nothing
_NEAR_HELLO, _FAR_HELLO = 1000, 5000  # milliseconds for two processes to get to know each other
_SCOUTING_DELAY = 100  # milliseconds `open` waits at most for a peer that does not answer


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


@dataclass(frozen=True, slots=True)
class Reach:
    """What a link opens beyond this machine's own processes; nothing unless asked.

    Attributes:
        listen: Endpoints where other machines may come in, "tcp/0.0.0.0:7448".
        connect: Endpoints to go to, "tcp/robot:7447".
        certificates: For endpoints that begin with tls/ or quic/.
        config: A zenoh configuration, JSON5, taken as it is in place of ours.
    """

    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    certificates: Certificates | None = None
    config: Path | None = None


class Arrived(NamedTuple):
    """A message that came in."""

    key: str
    payload: bytes
    attachment: bytes


class Question:
    """A request that came in and waits for its answer."""

    __slots__ = ("_query", "attachment", "key", "payload")

    def __init__(self, query: Any, arrived: Arrived) -> None:
        self.key, self.payload, self.attachment = arrived
        self._query = query

    def answer(self, payload: bytes, attachment: bytes) -> None:
        """Reply, once."""
        # Who asked may be gone by now.
        with contextlib.suppress(Exception):
            self._query.reply(self._query.key_expr, payload, attachment=attachment)
        self._query.drop()

    def refuse(self, reason: str) -> None:
        """Say that there will be no answer."""
        with contextlib.suppress(Exception):
            self._query.reply_err(reason.encode())
        self._query.drop()


class Outlet:
    """Where messages of one key go out."""

    def __init__(self, publisher: Any) -> None:
        self._publisher = publisher

    def put(self, payload: bytes, attachment: bytes) -> None:
        """Send one message.

        Raises:
            LinkError: If the session is closed.
        """
        try:
            self._publisher.put(payload, attachment=attachment)
        except Exception as error:
            raise LinkError(f"a message could not be sent: {error}") from error

    def close(self) -> None:
        """Send no more."""
        with contextlib.suppress(Exception):
            self._publisher.undeclare()


class Wire:
    """An open zenoh session.

    Attributes:
        zid: Its name, in hexadecimal.
        lost: Messages that were dropped because too many waited.
        oversized: Messages that were larger than what we read.
    """

    def __init__(self, reach: Reach, endpoint: str, others: tuple[str, ...]) -> None:
        """Open the session; other threads' callbacks wait until `start`.

        Args:
            reach: What to open beyond this machine.
            endpoint: Where to listen for this machine's processes, "" for nowhere.
            others: Where the others of this machine listen.

        Raises:
            LinkError: If zenoh is missing, or an endpoint cannot be used.
        """
        self._zenoh = _import_zenoh()
        self._session = _open(self._zenoh, reach, endpoint, others)
        self.zid = str(self._session.zid())
        self.lost = 0
        self.oversized = 0
        self._loop: asyncio.AbstractEventLoop | None = None
        self._lock = threading.Lock()
        self._waiting: deque[tuple[Callable[..., object], Any, int]] = deque()
        self._bytes = 0
        self._scheduled = False
        self._closed = False

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Let callbacks run on `loop` from now on."""
        with self._lock:
            self._loop = loop
            self._scheduled = bool(self._waiting)
        if self._scheduled:
            loop.call_soon(self._drain)

    def close(self) -> None:
        """Close the session; nothing is called any more."""
        with self._lock:
            self._closed = True
            self._waiting.clear()
        with contextlib.suppress(Exception):
            self._session.close()

    @property
    def neighbours(self) -> frozenset[str]:
        """The sessions this one is directly connected to."""
        info = self._session.info
        return frozenset(str(zid) for zid in [*info.peers_zid(), *info.routers_zid()])

    # Messages

    def publisher(self, key: str, *, latched: bool = False) -> Outlet:
        """Declare that messages of `key` go out.

        Args:
            key: The key, without wildcards.
            latched: Whether who comes later gets the last message too.
        """
        options = {
            "congestion_control": self._zenoh.CongestionControl.BLOCK,
            "reliability": self._zenoh.Reliability.RELIABLE,
            # At once: by default zenoh waits up to a millisecond for company.
            "express": True,
            "allowed_destination": self._zenoh.Locality.REMOTE,
        }
        if not latched:
            return Outlet(self._session.declare_publisher(key, **options))
        import zenoh.ext as advanced

        return Outlet(
            advanced.declare_advanced_publisher(
                self._session,
                key,
                cache=advanced.CacheConfig(max_samples=1),
                publisher_detection=True,
                **options,
            )
        )

    def subscriber(
        self, key: str, on_message: Callable[[Arrived], object], *, latched: bool = False
    ) -> Callable[[], None]:
        """Have `on_message` called with what comes in; call what is returned to stop.

        Args:
            key: The key, wildcards allowed.
            on_message: Called on the loop.
            latched: Whether to ask for what was sent before.
        """

        def arrived(sample: Any) -> None:
            self._take(sample, on_message)

        handler = self._handler(arrived)
        remote = self._zenoh.Locality.REMOTE
        if not latched:
            subscriber = self._session.declare_subscriber(key, handler, allowed_origin=remote)
        else:
            import zenoh.ext as advanced

            subscriber = advanced.declare_advanced_subscriber(
                self._session,
                key,
                handler,
                allowed_origin=remote,
                history=advanced.HistoryConfig(detect_late_publishers=True),
            )
        return _undeclare(subscriber)

    def _take(self, sample: Any, on_message: Callable[[Arrived], object]) -> None:
        """Hand a sample over, its size checked first (on a thread of zenoh's)."""
        if sample.kind != self._zenoh.SampleKind.PUT:
            return
        size = len(sample.payload)
        attachment = sample.attachment
        if size > LARGEST or (attachment is not None and len(attachment) > 4096):
            self.oversized += 1
            return
        arrived = Arrived(
            str(sample.key_expr),
            sample.payload.to_bytes(),
            b"" if attachment is None else attachment.to_bytes(),
        )
        self._hand_over(on_message, arrived, size)

    # Questions

    def server(self, key: str, on_question: Callable[[Question], object]) -> Callable[[], None]:
        """Have `on_question` called with every request; call what is returned to stop."""

        def asked(query: Any) -> None:
            payload, attachment = query.payload, query.attachment
            size = 0 if payload is None else len(payload)
            if size > LARGEST or (attachment is not None and len(attachment) > 4096):
                self.oversized += 1
                query.drop()
                return
            arrived = Arrived(
                str(query.key_expr),
                b"" if payload is None else payload.to_bytes(),
                b"" if attachment is None else attachment.to_bytes(),
            )
            self._hand_over(on_question, Question(query, arrived), size)

        return _undeclare(self._session.declare_queryable(key, self._handler(asked), complete=True))

    async def ask(self, key: str, payload: bytes, attachment: bytes, *, timeout: float) -> bytes:
        """Send a request and wait for the answer.

        Args:
            key: The service's key.
            payload: The request.
            attachment: What travels beside it.
            timeout: Seconds to wait.

        Raises:
            LinkError: If nobody answers, or the answer is a refusal.
        """
        answer: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()

        def settle(outcome: bytes | str) -> None:
            if answer.done():
                return
            if isinstance(outcome, bytes):
                answer.set_result(outcome)
            else:
                answer.set_exception(LinkError(outcome))

        def replied(reply: Any) -> None:
            if reply.ok is not None and len(reply.ok.payload) <= LARGEST:
                self._hand_over(settle, reply.ok.payload.to_bytes(), 0)
            elif reply.err is not None:
                reason = reply.err.payload.to_bytes()[:500].decode(errors="replace")
                self._hand_over(settle, f"it was refused: {reason}", 0)

        def over() -> None:
            self._hand_over(settle, f"nobody answered within {timeout:g} s, or who did has left", 0)

        zenoh = self._zenoh
        self._session.get(
            key,
            zenoh.handlers.Callback(replied, over, indirect=False),
            payload=payload,
            attachment=attachment,
            target=zenoh.QueryTarget.ALL_COMPLETE,
            consolidation=zenoh.ConsolidationMode.NONE,
            timeout=timeout,
        )
        return await answer

    # Tokens

    def token(self, key: str) -> Callable[[], None]:
        """Show `key` to everybody for as long as this process lives, or until told to stop."""
        return _undeclare(self._session.liveliness().declare_token(key))

    def tokens(self, key: str, timeout: float = 1.0) -> list[str]:
        """The tokens that are there now; waits for the answer of everybody connected."""
        replies = self._session.liveliness().get(key, timeout=timeout)
        return [str(reply.ok.key_expr) for reply in replies if reply.ok is not None]

    def watch_tokens(
        self, key: str, on_token: Callable[[tuple[str, bool]], object]
    ) -> Callable[[], None]:
        """Have `on_token` called with (token, whether it is there now) at every change."""

        def changed(sample: Any) -> None:
            there = sample.kind == self._zenoh.SampleKind.PUT
            self._hand_over(on_token, (str(sample.key_expr), there), 0)

        return _undeclare(
            self._session.liveliness().declare_subscriber(key, self._handler(changed), history=True)
        )

    # From zenoh's threads to ours

    def _handler(self, callback: Callable[[Any], None]) -> Any:
        return self._zenoh.handlers.Callback(callback, indirect=False)

    def _hand_over(self, callback: Callable[..., object], argument: Any, size: int) -> None:
        """Have something called on the loop (called on any thread)."""
        with self._lock:
            if self._closed:
                return
            if size and (len(self._waiting) >= MOST_WAITING or self._bytes + size > MOST_BYTES):
                self.lost += 1
                return
            self._waiting.append((callback, argument, size))
            self._bytes += size
            if self._scheduled or self._loop is None:
                return
            self._scheduled = True
            loop = self._loop
        # A loop that has just been closed wants to hear no more.
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(self._drain)

    def _drain(self) -> None:
        """Call what waits, a slice at a time, so that a flood does not starve the world."""
        for _ in range(_SLICE):
            with self._lock:
                if not self._waiting:
                    self._scheduled = False
                    return
                callback, argument, size = self._waiting.popleft()
                self._bytes -= size
            callback(argument)
        if self._loop is not None:
            self._loop.call_soon(self._drain)


def _undeclare(declared: Any) -> Callable[[], None]:
    def stop() -> None:
        with contextlib.suppress(Exception):
            declared.undeclare()

    return stop


def _import_zenoh() -> Any:
    try:
        import zenoh
    except ImportError as error:
        raise LinkError(
            "talking to other processes needs 'eclipse-zenoh', which is missing here "
            f"({error}); hosting works without it: --host"
        ) from error
    return zenoh


def _open(zenoh: Any, reach: Reach, endpoint: str, others: tuple[str, ...]) -> Any:
    try:
        if reach.config is not None:
            config = zenoh.Config.from_file(str(reach.config))
        else:
            config = zenoh.Config()
            for key, value in settings(reach, endpoint, others).items():
                config.insert_json5(key, json.dumps(value))
        return zenoh.open(config)
    except Exception as error:
        reason = str(error).partition(" at /")[0]
        where = ", ".join([str(reach.config or ""), *reach.listen, *reach.connect]).strip(", ")
        raise LinkError(
            f"the link cannot be opened{f' ({where})' if where else ''}: {reason}"
        ) from error


def settings(reach: Reach, endpoint: str, others: tuple[str, ...]) -> dict[str, Any]:
    """What we tell zenoh, by its own names; its defaults would listen on every interface."""
    outward = bool(reach.listen or reach.connect)
    found: dict[str, Any] = {
        # A router passes on between this machine's processes, which know each other
        # directly, and the world outside; a peer passes nothing on.
        "mode": "router" if outward else "peer",
        "listen/endpoints": [*([endpoint] if endpoint else []), *reach.listen],
        "connect/endpoints": [*others, *reach.connect],
        "listen/exit_on_failure": True,
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "scouting/multicast/enabled": False,
        # Gossip tells routers who knows whom; nobody is to act on addresses it carries.
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


PROTOCOLS: Final = ("tcp", "udp", "tls", "quic", "ws", "unixsock-stream")
"""How an endpoint may begin."""
