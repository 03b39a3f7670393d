"""zenoh as a link's middleware, with the names, tokens and attachments of `rmw_zenoh`."""

import asyncio
import contextlib
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Final

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import Stamp
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, Quality
from tftool.world.link.graph import CLIENT, NODE, SERVER, GraphEntity, Process, node_name
from tftool.world.link.link_options import Options
from tftool.world.link.seam import Arrived, Middleware, Watcher, WireRequest
from tftool.world.link.zenoh import keys
from tftool.world.link.zenoh.entry import Opening
from tftool.world.link.zenoh.keys import Attachment, Token
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.link.zenoh.transport import KeyPublisher, Query, Sample, Wire

SERVICE: Final = Quality(depth=10)
"""ROS 2's quality of services."""


class ZenohMiddleware:
    """This process in a ROS 2 graph over zenoh; see `seam.Middleware`.

    Attributes:
        graph: Graph of the other processes.
        session: Our zenoh session, in hexadecimal.
        unanswering: Process numbers of this machine's processes that do not answer.
        notices: Empty: notices are given where they arise.
        wire: The zenoh session.
    """

    def __init__(self, options: Options, reach: ZenohReach) -> None:
        """Join the graph; see `seam.Middleware`."""
        self._options = options
        self._opening = Opening(options, reach)
        self.wire: Wire = self._opening.wire
        self.graph = self._opening.graph
        self.session = self.wire.zid
        self.unanswering = self._opening.unanswering
        self.notices: tuple[str, ...] = ()
        self._nodes: dict[str, int] = {}
        self._numbers = 0
        self._watcher: Watcher | None = None
        self._stops: list[Callable[[], None]] = []

    @property
    def lost(self) -> int:
        """Messages dropped because the inbox was full."""
        return self.wire.lost

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Call back on `loop` from now on, and report changes of the graph."""
        self.wire.start(loop)
        self._watcher = watcher
        if watcher is not None:
            # Every domain: a peer that talks in another one is worth a word.
            for pattern in (f"{keys.LIVELINESS}/*/**", f"{keys.OURS}/*/**"):
                self._stops.append(self.wire.watch_tokens(pattern, self._on_token))

    def tell_frames(self, names: Sequence[str]) -> None:
        """List this process's frames where other local commands find them."""
        self._opening.tell_frames(names)

    def settle(self) -> None:
        """Let other local processes join from now on."""
        self._opening.settle()

    def close(self) -> None:
        """Send queued messages, and leave."""
        for stop in self._stops:
            stop()
        self._opening.close()

    # Shown entities

    def process(self, process: Process) -> Callable[[], None]:
        """Announce this process."""
        return self.show(keys.process_key(process))

    def node(self, name: str) -> Callable[[], None]:
        """Announce a node."""
        number = self._nodes[name] = self._number()
        hide = self.show(
            Token(self._options.domain, self.session, number, number, NODE, node_name(name)).key()
        )

        def leave() -> None:
            self._nodes.pop(name, None)
            hide()

        return leave

    def subscription(
        self, node: str, name: str, ros_type: str, quality: Quality
    ) -> Callable[[], None]:
        """Announce that a node subscribes to a topic."""
        return self.show(self._token(SUBSCRIPTION, node, name, ros_type, quality))

    # Topics

    def publisher(self, node: str, name: str, ros_type: str, quality: Quality) -> "ZenohPublisher":
        """Publish a topic as a node of this process."""
        token = self._token(PUBLISHER, node, name, ros_type, quality)
        # A latched one keeps its own last messages, so each has an outlet of its own.
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
        """Call `on_message` with other processes' messages."""

        def arrived(sample: Sample) -> None:
            try:
                beside = sample.attachment and keys.parse_attachment(sample.attachment)
            except MalformedMessage as refusal:
                self._refuse(name, refusal)
            else:
                on_message(Arrived(sample.payload, beside.gid if beside else b""))

        key = keys.any_hash_key(self._options.domain, name, ros_type)
        return self.wire.subscriber(key, arrived, is_latched=is_latched)

    # Services

    def server(
        self, node: str, name: str, ros_type: str, on_request: Callable[[WireRequest], object]
    ) -> Callable[[], None]:
        """Serve a service as a node of this process."""

        def asked(query: Query) -> None:
            try:
                beside = keys.parse_attachment(query.attachment)
            except MalformedMessage as refusal:
                self._refuse(name, refusal)
                query.refuse(str(refusal))
            else:
                on_request(ZenohRequest(query, beside))

        stop = self.wire.server(keys.any_hash_key(self._options.domain, name, ros_type), asked)
        # Shown last: what sees it may ask at once and is answered.
        hide = self.show(self._token(SERVER, node, name, ros_type, SERVICE))

        def leave() -> None:
            hide()
            stop()

        return leave

    def client(self, node: str, name: str, ros_type: str) -> "ZenohClient":
        """Call a service as a node of this process."""
        return ZenohClient(self, name, ros_type, self._token(CLIENT, node, name, ros_type, SERVICE))

    def key_of_service(self, name: str, ros_type: str) -> str:
        """Return the key for requests: with the server's own hash if it is announced."""
        servers = self.graph.entities(SERVER, name=name)
        known = next((one.type_hash for one in servers if one.ros_type == ros_type), "")
        return keys.data_key(self._options.domain, name, ros_type, known)

    # Helpers

    def _token(self, kind: str, node: str, name: str, ros_type: str, quality: Quality) -> str:
        """Return the key of a new token."""
        return Token(
            self._options.domain,
            self.session,
            self._nodes.get(node, 0),
            self._number(),
            kind,
            node_name(node),
            name,
            ros_type,
            quality=keys.quality(quality),
        ).key()

    def _number(self) -> int:
        self._numbers += 1
        return self._numbers

    def show(self, key: str) -> Callable[[], None]:
        """Announce a token until the returned function is called; observers announce none."""
        return _nothing if self._options.read_only else self.wire.token(key)

    def _on_token(self, change: tuple[str, bool]) -> None:
        key, there = change
        if there:
            found = keys.parse_token(key)
            new = None if found is None else self.graph.add(key, found)
            self._report(new, there)
        else:
            gone = self.graph.remove(key)
            if gone is not None:
                self._report(gone, there)

    def _report(self, found: GraphEntity | Process | None, there: bool) -> None:
        if self._watcher is not None:
            self._watcher.graph_changed(found, there)

    def _refuse(self, name: str, refusal: MalformedMessage) -> None:
        if self._watcher is not None:
            self._watcher.refuse(name, refusal)


class ZenohPublisher:
    """Publisher with its token and sequence number."""

    def __init__(self, outlet: KeyPublisher, gid: bytes, hide: Callable[[], None]) -> None:
        self._outlet = outlet
        self._gid = gid
        self._hide = hide
        self._sequence = 0

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a subscription, or be kept for later ones."""
        return self._outlet.is_wanted

    def put(self, payload: bytes, stamp: Stamp) -> None:
        """Send one message."""
        self._sequence += 1
        self._outlet.put(payload, Attachment(self._sequence, stamp, self._gid).encode())

    def close(self) -> None:
        """Close the publisher."""
        self._hide()
        self._outlet.close()


class ZenohRequest:
    """A request, with the number and client for its response."""

    def __init__(self, query: Query, beside: Attachment) -> None:
        self._query = query
        self._beside = beside

    @property
    def payload(self) -> bytes:
        """Its CDR."""
        return self._query.payload

    def answer(self, payload: bytes, stamp: Stamp) -> None:
        """Send the response, once."""
        # The number and the client come back, so that the client knows which answer it is.
        beside = Attachment(self._beside.sequence, stamp, self._beside.gid)
        self._query.answer(payload, beside.encode())

    def refuse(self, reason: str) -> None:
        """Report that there will be no response."""
        self._query.refuse(reason)


class ZenohClient:
    """Client with a token, announced with its first request, and a sequence number."""

    def __init__(self, middleware: ZenohMiddleware, name: str, ros_type: str, token: str) -> None:
        self._middleware = middleware
        self._name = name
        self._ros_type = ros_type
        self._token = token
        self._gid = keys.gid_of(token)
        self._sequence = 0
        self._stack = contextlib.ExitStack()

    async def ask(self, payload: bytes, stamp: Stamp, timeout: float) -> bytes:
        """Send a request and wait for the response."""
        if not self._sequence:
            self._stack.callback(self._middleware.show(self._token))
        self._sequence += 1
        beside = Attachment(self._sequence, stamp, self._gid).encode()
        key = self._middleware.key_of_service(self._name, self._ros_type)
        return await self._middleware.wire.ask(key, payload, beside, timeout=timeout)

    def close(self) -> None:
        """Close the client."""
        self._stack.close()


def _nothing() -> None:
    """Do nothing, in place of withdrawing an announcement."""


if TYPE_CHECKING:
    _AS_SEAM: type[Middleware] = ZenohMiddleware
