"""Interface of a middleware: a ROS graph, and messages in CDR.

A middleware is a folder beside `zenoh/` with a class derived from `Middleware`, a `Reach` that
declares its options and joins a session, and one line in `link_options.MIDDLEWARES`. No other
module depends on the choice of the middleware: the bridges (`topic_bridges`, `service_bridges`)
convert values to CDR and back. A middleware makes all its callbacks in the event loop.
"""

import asyncio
from collections.abc import Callable, Sequence
from typing import ClassVar, NamedTuple, Protocol

from tftool.base.errors import LinkError, MalformedMessage
from tftool.base.stamps import Stamp
from tftool.world.endpoints import Quality
from tftool.world.link.graph import Graph, GraphEntity, Process


class Arrived(NamedTuple):
    """Received message.

    Attributes:
        payload: Message in CDR (ROS 2's serialised form).
        sender: Gid of the publisher; b"" if unknown.
    """

    payload: bytes
    sender: bytes


class WirePublisher(Protocol):
    """Publisher of one topic, announced in the graph."""

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a subscription, or be stored for late subscribers."""

    def put(self, payload: bytes, stamp: Stamp) -> None:
        """Send one message; `stamp` is the time of sending on this process's clock.

        Raises:
            LinkError: If the connection is closed.
        """

    def close(self) -> None:
        """Close the publisher after all queued messages are sent."""


class WireRequest(Protocol):
    """Received request that waits for its response."""

    @property
    def payload(self) -> bytes:
        """Request in CDR (ROS 2's serialised form)."""

    def answer(self, payload: bytes, stamp: Stamp) -> None:
        """Send the response; `answer` must be called only once."""

    def refuse(self, reason: str) -> None:
        """Send the client an error with the reason, instead of a response."""


class WireClient(Protocol):
    """Client of one service."""

    async def ask(self, payload: bytes, stamp: Stamp, timeout: float) -> bytes:
        """Send a request, and wait at most `timeout` seconds for the response.

        Cancelling the wait withdraws the request.

        Raises:
            LinkError: If no response arrives, or the server sends an error.
        """

    def close(self) -> None:
        """Close the client."""


class Watcher(Protocol):
    """Callbacks from a middleware to the session connection."""

    def graph_changed(self, found: GraphEntity | Process | None, is_added: bool) -> None:
        """Handle an entity that was added (if `is_added`) or removed.

        `found` is None if the change is only that another ROS domain was noticed.
        """

    def refuse(self, name: str, refusal: MalformedMessage) -> None:
        """Handle a malformed message of a topic or service."""

    def say_once(self, what: str, sentence: str) -> None:
        """Log a warning about other processes, once for each value of `what`."""


def nothing() -> None:
    """Do nothing, in place of a function that ends an announcement."""


class Middleware:
    """Participation of this process in a ROS graph. Names have no leading slash.

    `Reach.join` creates an instance. No other process of this machine can join until `settle` or
    `close` is called. By default, methods that announce an entity do nothing, and methods that
    create a publisher, server or client raise an error.

    Attributes:
        graph: Graph of the other processes; filled before the constructor returns.
        session: Name of this process in the graph.
        unanswering: Process ids of this machine's processes that do not respond.
        notices: Notices for the user about joining, as sentences.
        watcher: Receiver of changes of the graph; None before `start`.
    """

    NO_WRITING: ClassVar[str] = "nothing can be published here"
    """Error text of a middleware without publishers, servers or clients."""

    def __init__(self, graph: Graph) -> None:
        """Store the graph of the other processes."""
        self.graph = graph
        self.session = graph.own
        self.unanswering: tuple[int, ...] = ()
        self.notices: tuple[str, ...] = ()
        self.watcher: Watcher | None = None

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Start to call callbacks in `loop`, and to report changes of the graph to `watcher`."""
        raise NotImplementedError

    def tell_frames(self, names: Sequence[str]) -> None:
        """Make the names of this process's frames known to other local commands, if possible."""

    def settle(self) -> None:
        """Allow other local processes to join from now on."""

    def close(self) -> None:
        """Send queued messages, and leave the graph; no callback follows."""
        raise NotImplementedError

    @property
    def lost(self) -> int:
        """Number of messages dropped because the inbox was full."""
        return 0

    def process(self, process: Process) -> Callable[[], None]:
        """Announce this process; return a function that ends the announcement."""
        return nothing

    def node(self, name: str) -> Callable[[], None]:
        """Announce a node; return a function that ends the announcement."""
        return nothing

    def publisher(self, node: str, name: str, ros_type: str, quality: Quality) -> WirePublisher:
        """Create a publisher of a topic for a node of this process."""
        raise LinkError(self.NO_WRITING)

    def subscription(
        self, node: str, name: str, ros_type: str, quality: Quality
    ) -> Callable[[], None]:
        """Announce a node's subscription; return a function that ends the announcement.

        Several subscriptions of a process share the messages of one call of `listen`.
        """
        return nothing

    def listen(
        self,
        name: str,
        ros_type: str,
        on_message: Callable[[Arrived], object],
        *,
        is_latched: bool = False,
    ) -> Callable[[], None]:
        """Call `on_message` with other processes' messages; return a function that ends the calls.

        Args:
            name: Name of the topic.
            ros_type: Type; messages of other types are not received.
            on_message: Function called with every message.
            is_latched: Whether to request messages that were sent before this call.
        """
        raise NotImplementedError

    def server(
        self, node: str, name: str, ros_type: str, on_request: Callable[[WireRequest], object]
    ) -> Callable[[], None]:
        """Serve a service as a node of this process; return a function that stops the server."""
        raise LinkError(self.NO_WRITING)

    def client(self, node: str, name: str, ros_type: str) -> WireClient:
        """Create a client of a service for a node of this process."""
        raise LinkError(self.NO_WRITING)

    def announce_client(self, node: str, name: str, ros_type: str) -> Callable[[], None]:
        """Announce a node's client; return a function that ends the announcement.

        Several clients of a process send their requests through one `client`.
        """
        return nothing

    # For middlewares: reports to the watcher, if there is one yet

    def report(self, found: GraphEntity | Process | None, is_added: bool) -> None:
        """Report to the watcher that an entity was added (if `is_added`) or removed.

        `found` is None if the change is only that another ROS domain was noticed.
        """
        if self.watcher is not None:
            self.watcher.graph_changed(found, is_added)

    def refuse(self, name: str, refusal: MalformedMessage) -> None:
        """Report a malformed message of a topic or service to the watcher."""
        if self.watcher is not None:
            self.watcher.refuse(name, refusal)

    def say_once(self, what: str, sentence: str) -> None:
        """Let the watcher log a warning about other processes, once for each value of `what`."""
        if self.watcher is not None:
            self.watcher.say_once(what, sentence)
