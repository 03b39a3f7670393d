"""Interface between a middleware and a link: a ROS graph, with messages as CDR.

A middleware is a folder beside `zenoh/` with a class derived from `Middleware`, a `Reach` that
declares its options and joins a session, and one line in `link_options.MIDDLEWARES`. The rest of
the link does not depend on it: the bridges (`topic_bridges`, `service_bridges`) pass values, which
are serialised to CDR there. A middleware makes all its callbacks on the event loop.
"""

import asyncio
from collections.abc import Callable, Sequence
from typing import ClassVar, NamedTuple, Protocol

from tftool.base.errors import LinkError, MalformedMessage
from tftool.base.stamps import Stamp
from tftool.world.endpoints import Quality
from tftool.world.link.graph import Graph, GraphEntity, Process


class Arrived(NamedTuple):
    """A received message.

    Attributes:
        payload: CDR.
        sender: Gid of the publisher; b"" if unknown.
    """

    payload: bytes
    sender: bytes


class WirePublisher(Protocol):
    """Publisher of one topic, announced in the graph."""

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a subscription, or be kept for later ones."""

    def put(self, payload: bytes, stamp: Stamp) -> None:
        """Send one message with the time `stamp` on our clock.

        Raises:
            LinkError: If the link is closed.
        """

    def close(self) -> None:
        """Close after sending everything queued."""


class WireRequest(Protocol):
    """A received request that waits for its response."""

    @property
    def payload(self) -> bytes:
        """CDR bytes of the request."""

    def answer(self, payload: bytes, stamp: Stamp) -> None:
        """Send the response, once."""

    def refuse(self, reason: str) -> None:
        """Report that there will be no response, and why."""


class WireClient(Protocol):
    """Client of one service, announced in the graph with its first request."""

    async def ask(self, payload: bytes, stamp: Stamp, timeout: float) -> bytes:
        """Send a request and wait at most `timeout` seconds for the response.

        A wait that is cancelled takes the request back.

        Raises:
            LinkError: If there is no answer, or it is a refusal.
        """

    def close(self) -> None:
        """Close the client."""


class Watcher(Protocol):
    """Callbacks of a middleware to its link."""

    def graph_changed(self, found: GraphEntity | Process | None, there: bool) -> None:
        """Report an added or removed entity; None if only another domain was noticed."""

    def refuse(self, name: str, refusal: MalformedMessage) -> None:
        """Report an invalid message of a topic or service."""

    def say_once(self, what: str, sentence: str) -> None:
        """Log a warning about others, once for each `what`."""


def nothing() -> None:
    """Do nothing, in place of withdrawing an announcement."""


class Middleware:
    """A process's part in a ROS graph. Names have no leading slash.

    `Reach.join` makes it. No other process of this machine can join until `settle` or `close` is
    called. A method that a middleware does not override announces nothing, or refuses to write.

    Attributes:
        graph: Graph of the other processes; filled before the constructor returns.
        session: This process's name in the graph.
        unanswering: Process numbers of this machine's processes that do not answer.
        notices: Notices for the user about joining, as sentences.
        watcher: Receives changes of the graph; None before `start`.
    """

    NO_WRITING: ClassVar[str] = "nothing can be published here"
    """Why a middleware without these methods has no publisher, server or client."""

    def __init__(self, graph: Graph) -> None:
        """Take part in a graph."""
        self.graph = graph
        self.session = graph.own
        self.unanswering: tuple[int, ...] = ()
        self.notices: tuple[str, ...] = ()
        self.watcher: Watcher | None = None

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Call back on `loop` from now on, and report changes of the graph."""
        raise NotImplementedError

    def tell_frames(self, names: Sequence[str]) -> None:
        """List this process's frames where other local commands find them, if there is a place."""

    def settle(self) -> None:
        """Let other local processes join from now on, if joining kept them waiting."""

    def close(self) -> None:
        """Send queued messages, and leave; no callback follows."""
        raise NotImplementedError

    @property
    def lost(self) -> int:
        """Messages dropped because the inbox was full."""
        return 0

    def process(self, process: Process) -> Callable[[], None]:
        """Announce this process until the returned function is called."""
        return nothing

    def node(self, name: str) -> Callable[[], None]:
        """Announce a node until the returned function is called."""
        return nothing

    def publisher(self, node: str, name: str, ros_type: str, quality: Quality) -> WirePublisher:
        """Publish a topic as a node of this process."""
        raise LinkError(self.NO_WRITING)

    def subscription(
        self, node: str, name: str, ros_type: str, quality: Quality
    ) -> Callable[[], None]:
        """Announce a node's subscription until the returned function is called.

        Several subscriptions of a process share the messages of one `listen`.
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
        """Call `on_message` with others' messages until the returned function is called.

        Args:
            name: The topic.
            ros_type: Type; publishers of another one are not heard.
            on_message: Called with every message.
            is_latched: Whether to ask for earlier messages.
        """
        raise NotImplementedError

    def server(
        self, node: str, name: str, ros_type: str, on_request: Callable[[WireRequest], object]
    ) -> Callable[[], None]:
        """Serve a service as a node of this process until the returned function is called."""
        raise LinkError(self.NO_WRITING)

    def client(self, node: str, name: str, ros_type: str) -> WireClient:
        """Call a service as a node of this process."""
        raise LinkError(self.NO_WRITING)

    # For middlewares: reports to the watcher, if there is one yet

    def report(self, found: GraphEntity | Process | None, there: bool) -> None:
        """Report an added or removed entity; None if only another domain was noticed."""
        if self.watcher is not None:
            self.watcher.graph_changed(found, there)

    def refuse(self, name: str, refusal: MalformedMessage) -> None:
        """Report an invalid message of a topic or service."""
        if self.watcher is not None:
            self.watcher.refuse(name, refusal)

    def say_once(self, what: str, sentence: str) -> None:
        """Log a warning about others, once for each `what`."""
        if self.watcher is not None:
            self.watcher.say_once(what, sentence)
