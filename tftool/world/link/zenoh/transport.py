"""zenoh session whose callbacks run in the event loop; the only module that uses zenoh."""

import asyncio
import contextlib
import json
import sys
import threading
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from tftool.base.errors import LinkError
from tftool.messages.layouts import LARGEST
from tftool.world.endpoints import Quality
from tftool.world.link.queues import Inbox, Outbox
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.link.zenoh.rendezvous import PASSWORDS, USER, Rendezvous


class Sample(NamedTuple):
    """Received message: its payload and its attachment, as bytes."""

    payload: bytes
    attachment: bytes


class Query:
    """Received request that waits for its response."""

    __slots__ = ("_query", "attachment", "payload")

    def __init__(self, query: Any, arrived: Sample) -> None:
        self.payload, self.attachment = arrived
        self._query = query

    def answer(self, payload: bytes, attachment: bytes) -> None:
        """Send the response; `answer` must be called only once."""
        # The client may have left.
        with contextlib.suppress(Exception):
            self._query.reply(self._query.key_expr, payload, attachment=attachment)
        self._query.drop()

    def refuse(self, reason: str) -> None:
        """Send the client an error with the reason, instead of a response."""
        with contextlib.suppress(Exception):
            self._query.reply_err(reason.encode())
        self._query.drop()


class KeyPublisher:
    """Publisher of one zenoh key."""

    def __init__(self, publisher: Any, outbox: Outbox, *, keeps: bool) -> None:
        self._publisher = publisher
        self._outbox = outbox
        self._keeps = keeps

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a subscriber, or be stored for late subscribers."""
        return self._keeps or bool(self._publisher.matching_status.matching)

    def put(self, payload: bytes, attachment: bytes) -> None:
        """Queue one message for sending.

        Raises:
            LinkError: If the session is closed.
        """
        send = partial(self._publisher.put, payload, attachment=attachment)
        self._outbox.put(send, len(payload))

    def close(self) -> None:
        """Close the publisher when everything queued is sent."""
        with contextlib.suppress(LinkError):
            self._outbox.put(self._publisher.undeclare)


class Wire:
    """Open zenoh session.

    Attributes:
        zid: Id of the session, in hexadecimal.
        oversized: Number of received messages that were dropped because of the size limit.
    """

    def __init__(self, reach: ZenohReach, rendezvous: Rendezvous | None) -> None:
        """Open the session; callbacks are queued until `start`.

        Args:
            reach: Networks to use beyond this machine.
            rendezvous: Folder of the sockets of this machine's processes; None to connect to none.

        Raises:
            LinkError: If zenoh is missing, or an endpoint cannot be used.
        """
        self._zenoh = import_zenoh()
        self._session = open_zenoh(self._zenoh, reach, rendezvous)
        self.zid = str(self._session.zid())
        self.oversized = 0
        self._inbox = Inbox()
        self._outbox = Outbox()

    @property
    def lost(self) -> int:
        """Number of messages dropped because the inbox was full."""
        return self._inbox.lost

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Call the callbacks in the event loop `loop` from now on."""
        self._inbox.start(loop)

    def close(self) -> None:
        """Send queued messages, and close the session; no callback follows."""
        self._inbox.close()
        self._outbox.close()
        with contextlib.suppress(Exception):
            self._session.close()

    @property
    def neighbours(self) -> frozenset[str]:
        """Ids of the directly connected sessions."""
        info = self._session.info
        return frozenset(str(zid) for zid in [*info.peers_zid(), *info.routers_zid()])

    @property
    def reached(self) -> frozenset[str]:
        """Remote endpoints of this session's connections."""
        return frozenset(str(link.dst) for link in self._session.info.links())

    # Messages

    def publisher(self, key: str, quality: Quality) -> KeyPublisher:
        """Declare a publisher of a zenoh key.

        Args:
            key: The key, without wildcards.
            quality: Reliability, and number of messages stored for late subscribers.
        """
        congestion, reliability = self._zenoh.CongestionControl, self._zenoh.Reliability
        reliable = quality.is_reliable
        options = {
            "congestion_control": congestion.BLOCK if reliable else congestion.DROP,
            "reliability": reliability.RELIABLE if reliable else reliability.BEST_EFFORT,
            # Send at once: by default, zenoh waits up to a millisecond to batch messages.
            "express": True,
            "allowed_destination": self._zenoh.Locality.REMOTE,
        }
        if not quality.is_latched:
            publisher = self._session.declare_publisher(key, **options)
            return KeyPublisher(publisher, self._outbox, keeps=False)
        kept = sys.maxsize if quality.keeps_all else max(1, quality.depth)
        publisher = self._zenoh.ext.declare_advanced_publisher(
            self._session,
            key,
            cache=self._zenoh.ext.CacheConfig(max_samples=kept),
            publisher_detection=True,
            **options,
        )
        return KeyPublisher(publisher, self._outbox, keeps=True)

    def subscriber(
        self, key: str, on_message: Callable[[Sample], object], *, is_latched: bool = False
    ) -> Callable[[], None]:
        """Call `on_message` with every message of a key; return a function that ends the calls.

        Args:
            key: The key, which may have wildcards.
            on_message: Function called in the event loop.
            is_latched: Whether to request messages that were sent before this call.
        """

        def arrived(sample: Any) -> None:
            self._take(sample, on_message)

        handler = self._handler(arrived)
        remote = self._zenoh.Locality.REMOTE
        if not is_latched:
            subscriber = self._session.declare_subscriber(key, handler, allowed_origin=remote)
        else:
            subscriber = self._zenoh.ext.declare_advanced_subscriber(
                self._session,
                key,
                handler,
                allowed_origin=remote,
                history=self._zenoh.ext.HistoryConfig(detect_late_publishers=True),
            )
        return _undeclare(subscriber)

    def _take(self, sample: Any, on_message: Callable[[Sample], object]) -> None:
        """Check a message's size, and queue the message for the event loop; runs in a thread."""
        if sample.kind != self._zenoh.SampleKind.PUT:
            return
        size = len(sample.payload)
        attachment = sample.attachment
        if size > LARGEST or (attachment is not None and len(attachment) > 4096):
            self.oversized += 1
            return
        arrived = Sample(
            sample.payload.to_bytes(),
            b"" if attachment is None else attachment.to_bytes(),
        )
        self._inbox.put(on_message, arrived, size)

    # Questions

    def server(self, key: str, on_query: Callable[[Query], object]) -> Callable[[], None]:
        """Call `on_query` with every request of a key; return a function that ends the calls."""

        def asked(query: Any) -> None:
            payload, attachment = query.payload, query.attachment
            size = 0 if payload is None else len(payload)
            if size > LARGEST or (attachment is not None and len(attachment) > 4096):
                self.oversized += 1
                query.drop()
                return
            arrived = Sample(
                b"" if payload is None else payload.to_bytes(),
                b"" if attachment is None else attachment.to_bytes(),
            )
            self._inbox.put(on_query, Query(query, arrived), size)

        return _undeclare(self._session.declare_queryable(key, self._handler(asked), complete=True))

    async def ask(self, key: str, payload: bytes, attachment: bytes, *, timeout: float) -> bytes:
        """Send a request, and wait for the response.

        Args:
            key: Key of the service.
            payload: Request in CDR.
            attachment: Attachment to send with the request.
            timeout: Longest wait in seconds.

        Raises:
            LinkError: If no server responds, or a server sends an error.
        """
        answer: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        silent = f"no server answered within {timeout:g} s, or all have left"

        def settle(outcome: bytes | str) -> None:
            if answer.done():
                return
            if isinstance(outcome, bytes):
                answer.set_result(outcome)
            else:
                answer.set_exception(LinkError(outcome))

        def replied(reply: Any) -> None:
            if reply.ok is not None and len(reply.ok.payload) <= LARGEST:
                found = reply.ok.payload.to_bytes()
                # Dropped if the inbox is full: then the client gets an error after all replies.
                self._inbox.put(settle, found, len(found))
            elif reply.err is not None:
                reason = reply.err.payload.to_bytes()[:500].decode(errors="replace")
                # This is zenoh's text for a timeout.
                silence = reason == "Timeout"
                self._inbox.put(settle, silent if silence else f"it was refused: {reason}")

        def over() -> None:
            self._inbox.put(settle, silent)

        zenoh = self._zenoh
        query = zenoh.CancellationToken()
        self._session.get(
            key,
            zenoh.handlers.Callback(replied, over, indirect=False),
            payload=payload,
            attachment=attachment,
            target=zenoh.QueryTarget.ALL_COMPLETE,
            consolidation=zenoh.ConsolidationMode.NONE,
            timeout=timeout,
            cancellation_token=query,
        )
        try:
            return await answer
        except asyncio.CancelledError:
            # Otherwise the request stays open for its whole time, up to an hour. Not in the loop:
            # cancelling waits for a reply that is being processed.
            with contextlib.suppress(LinkError):
                self._outbox.put(query.cancel)
            raise

    # Tokens

    def token(self, key: str) -> Callable[[], None]:
        """Announce a token until the returned function is called or this process ends."""
        return _undeclare(self._session.liveliness().declare_token(key))

    def tokens(self, key: str, timeout: float = 1.0) -> list[str]:
        """Return the existing tokens that match a key, from all connected sessions."""
        found: list[str] = []
        over = threading.Event()

        def replied(reply: Any) -> None:
            if reply.ok is not None:
                found.append(str(reply.ok.key_expr))

        # Not zenoh's own queue, which holds 256 replies: known tokens are added to it before
        # any reply can be taken.
        handler = self._zenoh.handlers.Callback(replied, over.set, indirect=False)
        self._session.liveliness().get(key, handler, timeout=timeout)
        over.wait(2 * timeout)
        return found

    def watch_tokens(
        self, key: str, on_token: Callable[[tuple[str, bool]], object]
    ) -> Callable[[], None]:
        """Call `on_token` with (token, True if added, False if removed); return a stop function."""

        def changed(sample: Any) -> None:
            there = sample.kind == self._zenoh.SampleKind.PUT
            self._inbox.put(on_token, (str(sample.key_expr), there))

        return _undeclare(
            self._session.liveliness().declare_subscriber(key, self._handler(changed), history=True)
        )

    # Helpers

    def _handler(self, callback: Callable[[Any], None]) -> Any:
        return self._zenoh.handlers.Callback(callback, indirect=False)


def _undeclare(declared: Any) -> Callable[[], None]:
    def stop() -> None:
        with contextlib.suppress(Exception):
            declared.undeclare()

    return stop


_CONGESTED = 1_000_000  # microseconds that a sender waits for a reader that receives nothing
_NEAR_HELLO, _FAR_HELLO = 1000, 5000  # milliseconds for the first messages of a connection
_SCOUTING_DELAY = 100  # longest wait in milliseconds of `open` for a peer that does not respond


def import_zenoh() -> Any:
    """Import the library `zenoh`.

    Raises:
        LinkError: If zenoh is missing.
    """
    try:
        import zenoh.ext
    except ImportError as error:
        raise LinkError(
            "connections to other processes need the package 'eclipse-zenoh', which cannot be "
            "imported "
            f"({error}): install the package, or host a session of this process alone with --host"
        ) from error
    return zenoh


def open_zenoh(zenoh: Any, reach: ZenohReach, rendezvous: Rendezvous | None) -> Any:
    """Open a zenoh session.

    Args:
        zenoh: The imported library.
        reach: Networks to use beyond this machine.
        rendezvous: Folder of the sockets of this machine's processes; None to connect to none.

    Raises:
        LinkError: If an endpoint or a file cannot be used.
    """
    try:
        if reach.config is not None:
            config = zenoh.Config.from_file(str(reach.config))
            # By default a peer adds no timestamps, by which latched messages are distinguished.
            config.insert_json5("timestamping/enabled", "true")
        else:
            config = zenoh.Config()
            for key, value in settings(reach, rendezvous).items():
                config.insert_json5(key, json.dumps(value))
        return zenoh.open(config)
    except Exception as error:
        reason = str(error).partition(" at /")[0]
        where = ", ".join([str(reach.config or ""), *reach.listen, *reach.connect]).strip(", ")
        raise LinkError(
            f"the connection to the session cannot be opened{f' ({where})' if where else ''}: "
            f"{reason}"
        ) from error


def settings(reach: ZenohReach, rendezvous: Rendezvous | None) -> dict[str, Any]:
    """Return the settings for zenoh, whose defaults would listen on every interface."""
    outward = bool(reach.listen or reach.connect)
    found: dict[str, Any] = {
        # A router forwards between this machine's processes, which are connected
        # directly, and other machines; a peer forwards nothing.
        "mode": "router" if outward else "peer",
        "listen/endpoints": [*([] if rendezvous is None else [rendezvous.endpoint]), *reach.listen],
        "connect/endpoints": [*([] if rendezvous is None else rendezvous.others), *reach.connect],
        "listen/exit_on_failure": True,
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "scouting/multicast/enabled": False,
        # Gossip tells routers which processes are connected; its addresses are not used.
        "scouting/gossip/enabled": True,
        "scouting/gossip/autoconnect": {"router": [], "peer": [], "client": []},
        "scouting/delay": _SCOUTING_DELAY,
        # Latched messages are distinguished by their timestamps.
        "timestamping/enabled": True,
        "transport/shared_memory/enabled": False,
        # A stopped process accepts connections but never responds: closing would wait for it.
        "transport/unicast/open_timeout": _FAR_HELLO if outward else _NEAR_HELLO,
        "transport/unicast/accept_timeout": _FAR_HELLO if outward else _NEAR_HELLO,
        "transport/link/tx/queue/congestion_control/block/wait_before_close": _CONGESTED,
    }
    if rendezvous is not None and rendezvous.password:
        found |= {
            "transport/auth/usrpwd/user": USER,
            "transport/auth/usrpwd/password": rendezvous.password,
            "transport/auth/usrpwd/dictionary_file": str(rendezvous.folder / PASSWORDS),
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
