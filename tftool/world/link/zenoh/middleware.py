"""zenoh as the middleware of a session, with names, tokens and attachments of `rmw_zenoh`."""

import asyncio
import contextlib
import threading
from collections.abc import Callable, Sequence
from typing import Final

from tftool.base.errors import LinkError, MalformedMessage
from tftool.base.stamps import Stamp, seconds
from tftool.world.clock import WallClock
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Quality
from tftool.world.link.graph import (
    NODE,
    SERVER,
    Graph,
    GraphEntity,
    Process,
    node_name,
)
from tftool.world.link.link_options import Options
from tftool.world.link.seam import Arrived, Middleware, Watcher, WireRequest, nothing
from tftool.world.link.zenoh import keys, rendezvous
from tftool.world.link.zenoh.keys import Attachment
from tftool.world.link.zenoh.reach import SECURED, ZenohReach, protocol_of
from tftool.world.link.zenoh.rendezvous import Rendezvous
from tftool.world.link.zenoh.transport import KeyPublisher, Query, Sample, Wire

SERVICE: Final = Quality(depth=10)
"""Quality of service that ROS 2 uses for services."""

REACHING: Final = 5.0
"""Longest wait in seconds for a process at the address in `connect`."""

NEARBY: Final = 1.0
"""Longest wait in seconds for processes of this machine that are stopped."""

BUSY: Final = 10.0
"""Longest wait in seconds for processes of this machine that run, which may be slow."""

INTRODUCED: Final = 1.0
"""Longest wait in seconds for the first tokens of connected processes."""

ANSWERED: Final = 5.0
"""Longest wait in seconds for each process's list of tokens; most take milliseconds."""

SHOWN: Final = 0.3
"""Longest wait in seconds for the tokens of all processes, once some have arrived."""

_STEP = 0.005


class ZenohMiddleware(Middleware):
    """This process in a ROS 2 graph over zenoh; its session name is the zenoh session's id.

    Attributes:
        wire: The zenoh session.
    """

    def __init__(self, options: Options, reach: ZenohReach) -> None:
        """Join the graph; the constructor returns at once if no other process exists.

        No other process of this machine can join until `settle` or `close` is called, so that no
        two processes decide at the same time whether to host.

        Raises:
            LinkError: If the session's folder cannot be used, zenoh is missing or raises an error,
                or no process responds at the address in `connect`.
        """
        self._options = options
        self._reach = reach
        self._place: Rendezvous | None = None
        self._nodes: dict[str, int] = {}
        self._numbers = 0
        self._stops: list[Callable[[], None]] = []
        # Without sockets a password protects this machine's processes; zenoh requires it of all
        # connections, also from other machines, which cannot know it.
        outward = bool(reach.listen or reach.connect)
        if reach.config is None and (rendezvous.HAS_UNIX_SOCKETS or not outward):
            self._place = Rendezvous(options.domain)
            self._place.enter()
        others = {} if self._place is None else self._place.others
        try:
            self.wire = Wire(reach, self._place)
        except BaseException:
            self._leave()
            raise
        super().__init__(Graph(self.wire.zid, options.domain))
        try:
            self._reach_out(others)
            self._take_in_tokens(is_expected=bool(others or reach.connect or reach.config))
        except BaseException:
            # On any error, release the lock, which other processes need to join.
            self.close()
            raise

    def _reach_out(self, others: dict[str, int]) -> None:
        """Wait for connections to `others` (local processes) and to the endpoints in `connect`."""

        # zenoh's own wait is short, and processes of a busy machine respond slowly: if they were
        # ignored, a second world would be hosted. A stopped process never responds.
        def silent() -> list[int]:
            reached = self.wire.reached
            return [pid for at, pid in others.items() if at not in reached]

        if not _await(lambda: not silent(), NEARBY):
            _await(lambda: all(rendezvous.is_stopped(pid) for pid in silent()), BUSY - NEARBY)
            self.unanswering = tuple(silent())
        reach = self._reach
        if reach.config is not None:
            _await(lambda: bool(self.wire.neighbours), NEARBY)
        elif reach.connect and not _await(
            lambda: bool(self.wire.reached - others.keys()), REACHING
        ):
            raise LinkError(_no_answer_at(reach))

    def _take_in_tokens(self, *, is_expected: bool) -> None:
        """Add other processes' entities to the graph; if `is_expected`, wait for the first."""

        def all_are_known() -> bool:
            for prefix in (keys.LIVELINESS, keys.OURS):
                for token in self.wire.tokens(f"{prefix}/{self._options.domain}/**", ANSWERED):
                    found = keys.parse_token(token)
                    if found is not None:
                        self.graph.add(token, found)
            return self.wire.neighbours <= self.graph.sessions

        def some_are_known() -> bool:
            return all_are_known() or not self.graph.is_empty

        # After the connection, routers take a while to pass tokens on.
        if _await(some_are_known, INTRODUCED if is_expected else 0.0):
            # Processes that only observe never show a token, so the wait is short.
            _await(all_are_known, SHOWN if is_expected else 0.0)

    @property
    def lost(self) -> int:
        """Number of messages dropped because the inbox was full."""
        return self.wire.lost

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Call callbacks in the event loop `loop`, and report changes of the graph to `watcher`."""
        self.wire.start(loop)
        self.watcher = watcher
        if watcher is not None:
            # All domains, because the user is told about processes in other domains.
            for pattern in (f"{keys.LIVELINESS}/*/**", f"{keys.OURS}/*/**"):
                self._stops.append(self.wire.watch_tokens(pattern, self._on_token))

    def tell_frames(self, names: Sequence[str]) -> None:
        """Write the names of this process's frames to a file that other local commands read."""
        if self._place is not None:
            self._place.tell_frames(names)

    def settle(self) -> None:
        """Allow other local processes to join from now on."""
        if self._place is not None:
            self._place.settle()

    def close(self) -> None:
        """Send queued messages, leave the graph, and remove this process's files."""
        for stop in self._stops:
            stop()
        with contextlib.suppress(Exception):
            self.wire.close()
        self._leave()

    def _leave(self) -> None:
        if self._place is not None:
            self._place.leave()

    # Shown entities

    def process(self, process: Process) -> Callable[[], None]:
        """Announce this process; see `seam.Middleware.process`."""
        return self.show(keys.process_key(process))

    def node(self, name: str) -> Callable[[], None]:
        """Announce a node; see `seam.Middleware.node`."""
        number = self._nodes[name] = self._number()
        entity = GraphEntity(NODE, self._options.domain, self.session, node_name(name))
        hide = self.show(keys.token_key(entity, number, number))

        def leave() -> None:
            self._nodes.pop(name, None)
            hide()

        return leave

    def subscription(
        self, node: str, name: str, ros_type: str, quality: Quality
    ) -> Callable[[], None]:
        """Announce that a node subscribes to a topic; see `seam.Middleware.subscription`."""
        return self.show(self._token(SUBSCRIPTION, node, name, ros_type, quality))

    # Topics

    def publisher(self, node: str, name: str, ros_type: str, quality: Quality) -> "ZenohPublisher":
        """Create a publisher of a topic for a node of this process."""
        token = self._token(PUBLISHER, node, name, ros_type, quality)
        # A latched publisher stores its own last messages, so each one has its own outlet.
        outlet = self.wire.publisher(keys.data_key(self._options.domain, name, ros_type), quality)
        return ZenohPublisher(outlet, keys.gid_of(token), self.show(token))

    def listen(
        self,
        name: str,
        ros_type: str,
        on_message: Callable[[Arrived], object],
        *,
        is_latched: bool = False,
    ) -> Callable[[], None]:
        """Call `on_message` with other processes' messages on a topic; see `Middleware.listen`."""

        def arrived(sample: Sample) -> None:
            try:
                beside = sample.attachment and keys.parse_attachment(sample.attachment)
            except MalformedMessage as refusal:
                self.refuse(name, refusal)
            else:
                on_message(Arrived(sample.payload, beside.gid if beside else b""))

        key = keys.any_hash_key(self._options.domain, name, ros_type)
        return self.wire.subscriber(key, arrived, is_latched=is_latched)

    # Services

    def server(
        self, node: str, name: str, ros_type: str, on_request: Callable[[WireRequest], object]
    ) -> Callable[[], None]:
        """Serve a service as a node of this process; return a function that stops the server."""

        def asked(query: Query) -> None:
            try:
                beside = keys.parse_attachment(query.attachment)
            except MalformedMessage as refusal:
                self.refuse(name, refusal)
                query.refuse(str(refusal))
            else:
                on_request(ZenohRequest(query, beside))

        stop = self.wire.server(keys.any_hash_key(self._options.domain, name, ros_type), asked)
        # Shown last, because others may send requests as soon as they see the server.
        hide = self.show(self._token(SERVER, node, name, ros_type, SERVICE))

        def leave() -> None:
            hide()
            stop()

        return leave

    def client(self, node: str, name: str, ros_type: str) -> "ZenohClient":
        """Create a client of a service for a node of this process."""
        gid = keys.gid_of(self._token(CLIENT, node, name, ros_type, SERVICE))
        return ZenohClient(self, name, ros_type, gid)

    def announce_client(self, node: str, name: str, ros_type: str) -> Callable[[], None]:
        """Announce a node's client; return a function that ends the announcement."""
        return self.show(self._token(CLIENT, node, name, ros_type, SERVICE))

    def key_of_service(self, name: str, ros_type: str) -> str:
        """Return the zenoh key of a service's requests, with the server's type hash if known."""
        # A server of another ROS release has another type hash, and thus another key.
        servers = self.graph.entities(SERVER, name=name)
        known = next((one.type_hash for one in servers if one.ros_type == ros_type), "")
        return keys.data_key(self._options.domain, name, ros_type, known)

    # Helpers

    def _token(self, kind: str, node: str, name: str, ros_type: str, quality: Quality) -> str:
        """Return the key of a new token for an entity of this process."""
        domain, session = self._options.domain, self.session
        entity = GraphEntity(kind, domain, session, node_name(node), name, ros_type, quality)
        return keys.token_key(entity, self._nodes.get(node, 0), self._number())

    def _number(self) -> int:
        self._numbers += 1
        return self._numbers

    def show(self, key: str) -> Callable[[], None]:
        """Announce a token (not if read-only); return a function that withdraws the token."""
        return nothing if self._options.read_only else self.wire.token(key)

    def _on_token(self, change: tuple[str, bool]) -> None:
        key, there = change
        if there:
            found = keys.parse_token(key)
            # Tokens of other domains are reported as None, so that the watcher can count them.
            new = None if found is None else self.graph.add(key, found)
            self.report(new, there)
        else:
            gone = self.graph.remove(key)
            if gone is not None:
                self.report(gone, there)


class ZenohPublisher:
    """Publisher of a topic over zenoh, with its token and sequence number."""

    def __init__(self, outlet: KeyPublisher, gid: bytes, hide: Callable[[], None]) -> None:
        self._outlet = outlet
        self._gid = gid
        self._hide = hide
        self._sequence = 0

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a subscription, or be stored for late subscribers."""
        return self._outlet.is_wanted

    def put(self, payload: bytes, stamp: Stamp) -> None:
        """Send one message with the next sequence number."""
        self._sequence += 1
        self._outlet.put(payload, Attachment(self._sequence, stamp, self._gid).encode())

    def close(self) -> None:
        """Withdraw the announcement, and close the publisher."""
        self._hide()
        self._outlet.close()


class ZenohRequest:
    """Received request over zenoh, with its number and client id, which the response repeats."""

    def __init__(self, query: Query, beside: Attachment) -> None:
        self._query = query
        self._beside = beside

    @property
    def payload(self) -> bytes:
        """Request in CDR (ROS 2's serialised form)."""
        return self._query.payload

    def answer(self, payload: bytes, stamp: Stamp) -> None:
        """Send the response; `answer` must be called only once."""
        # The reply repeats the request's number and client, so that the client can assign it.
        beside = Attachment(self._beside.sequence, stamp, self._beside.gid)
        self._query.answer(payload, beside.encode())

    def refuse(self, reason: str) -> None:
        """Send the client an error with the reason, instead of a response."""
        self._query.refuse(reason)


class ZenohClient:
    """Client of a service over zenoh."""

    def __init__(self, middleware: ZenohMiddleware, name: str, ros_type: str, gid: bytes) -> None:
        self._middleware = middleware
        self._name = name
        self._ros_type = ros_type
        self._gid = gid
        self._sequence = 0

    async def ask(self, payload: bytes, stamp: Stamp, timeout: float) -> bytes:
        """Send a request, and wait at most `timeout` seconds for the response."""
        self._sequence += 1
        beside = Attachment(self._sequence, stamp, self._gid).encode()
        key = self._middleware.key_of_service(self._name, self._ros_type)
        return await self._middleware.wire.ask(key, payload, beside, timeout=timeout)

    def close(self) -> None:
        """Do nothing, because a client has no resources to release."""


def _no_answer_at(reach: ZenohReach) -> str:
    """Return the error text, with advice, if no process responds at the address in `connect`."""
    protocols = {protocol_of(endpoint) for endpoint in reach.connect}
    text = (
        f"no process answers at {', '.join(reach.connect)} within {REACHING:g} s; "
        "is the other side running, and reachable from here?"
    )
    if reach.certificates is not None and protocols & set(SECURED):
        text += (
            " Check the certificates: the other side must trust the authority that signed this "
            "side's certificate. The other side's certificate must be signed by "
            f"{reach.certificates.authority}, and must name the host."
        )
    if "tcp" in protocols:
        text += " A port that listens with tls/ does not answer tcp/."
    return text


def _await(condition: Callable[[], bool], patience: float) -> bool:
    """Poll until `condition` is true, at most `patience` seconds; return the last result."""
    clock, pause = WallClock(), threading.Event()
    # The time is measured, because a check of the condition may take long.
    while not (held := condition()) and clock.elapsed() < seconds(patience):
        pause.wait(_STEP)
    return held
