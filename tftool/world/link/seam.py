"""Interface of a middleware to a link: a ROS graph, and messages and questions as CDR.

A middleware is a folder beside `zenoh/` with a class that has the methods of `Middleware`, a
`Reach` that declares its options and joins a session, and one line in
`link_options.MIDDLEWARES`. Nothing else of the link knows which one carries it: values
go in at the bridges (`topics`, `tf`, `services`, `actions`), CDR comes out here. Whatever a
middleware calls back, it calls on the event loop.
"""

import asyncio
from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import Stamp
from tftool.world.endpoints import Quality
from tftool.world.link.graph import Graph, GraphEntity, Process


class Arrived(NamedTuple):
    """A message that came in.

    Attributes:
        payload: Its CDR.
        sender: The gid of its publisher; b"" where it does not say.
    """

    payload: bytes
    sender: bytes


class WirePublisher(Protocol):
    """Publisher of one topic on the wire, shown in the graph."""

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a subscription, or be kept for later ones."""

    def put(self, payload: bytes, stamp: Stamp) -> None:
        """Send one message, sent at `stamp` by our clock.

        Raises:
            LinkError: If the link is closed.
        """

    def close(self) -> None:
        """Send no more, once everything before is sent."""


class WireRequest(Protocol):
    """A request that came in and waits for its answer."""

    @property
    def payload(self) -> bytes:
        """Its CDR."""

    def answer(self, payload: bytes, stamp: Stamp) -> None:
        """Reply, once."""

    def refuse(self, reason: str) -> None:
        """Say that there will be no answer, and why."""


class WireClient(Protocol):
    """The asking end of one service, shown in the graph from its first request on."""

    async def ask(self, payload: bytes, stamp: Stamp, timeout: float) -> bytes:
        """Send a request and wait for the answer, `timeout` seconds at most.

        A wait that is cancelled takes the request back.

        Raises:
            LinkError: If there is no answer, or it is a refusal.
        """

    def close(self) -> None:
        """Ask no more."""


class Watcher(Protocol):
    """Receiver of a middleware's reports to its link."""

    def graph_changed(self, found: GraphEntity | Process | None, there: bool) -> None:
        """Something came or went; None where only another domain was heard of."""

    def refuse(self, name: str, refusal: MalformedMessage) -> None:
        """A message of a topic or service came in and is not what it should be."""

    def say_once(self, what: str, sentence: str) -> None:
        """Warn of something about the others; `what` it is, so that it is said once."""


class Middleware(Protocol):
    """A process's part in a ROS graph. Names have no leading slash.

    `Reach.join` makes it. No other process of this machine can join until `settle` or `close`
    is called.

    Attributes:
        graph: Who else is there; filled before the constructor returns with those who were.
        session: This process's name in the graph.
        unanswering: Process numbers of this machine's processes that do not answer.
        notices: What the user should know of the way in, as sentences.
    """

    graph: Graph
    session: str
    unanswering: tuple[int, ...]
    notices: tuple[str, ...]

    def start(self, loop: asyncio.AbstractEventLoop, watcher: Watcher | None = None) -> None:
        """Call back on `loop` from now on, and report changes of the graph."""

    def tell_frames(self, names: Sequence[str]) -> None:
        """List the frames this process knows where other commands of this machine find them."""

    def settle(self) -> None:
        """Let other processes of this machine join from now on."""

    def close(self) -> None:
        """Send what still waits, and leave; nothing is called back any more."""

    @property
    def lost(self) -> int:
        """Messages that were dropped because too many waited to be taken in."""

    def process(self, process: Process) -> Callable[[], None]:
        """Show this process to the others, until the returned function is called."""

    def node(self, name: str) -> Callable[[], None]:
        """Show a node, until the returned function is called."""

    def publisher(self, node: str, name: str, ros_type: str, quality: Quality) -> WirePublisher:
        """Publish a topic, as a node of this process."""

    def subscription(
        self, node: str, name: str, ros_type: str, quality: Quality
    ) -> Callable[[], None]:
        """Show that a node subscribes a topic, until the returned function is called.

        Several subscriptions of a process share what one `listen` brings in.
        """

    def listen(
        self,
        name: str,
        ros_type: str,
        on_message: Callable[[Arrived], object],
        *,
        is_latched: bool = False,
    ) -> Callable[[], None]:
        """Have `on_message` called with what others publish, until the returned function is called.

        Args:
            name: The topic.
            ros_type: Its type; publishers of another one are not heard.
            on_message: Called with every message.
            is_latched: Whether to ask for earlier messages.
        """

    def server(
        self, node: str, name: str, ros_type: str, on_request: Callable[[WireRequest], object]
    ) -> Callable[[], None]:
        """Serve a service as a node of this process, until the returned function is called."""

    def client(self, node: str, name: str, ros_type: str) -> WireClient:
        """Ask a service as a node of this process."""
