"""State that the topics, services and actions of a session connection share.

The connection (`session.Link`) creates bridges for topics, services and actions. The bridges import
this module, not the connection, so that imports go in one direction.
"""

from typing import Final, cast

from tftool.base.errors import LinkError, MalformedMessage
from tftool.base.stamps import Stamp
from tftool.world.endpoints import PUBLISHER, Endpoint, Quality, Role
from tftool.world.link.graph import Graph, GraphEntity
from tftool.world.link.link_options import Options
from tftool.world.link.seam import Middleware
from tftool.world.world import World

NAME: Final = "link"
"""Name of the session connection in its log messages."""

UNKNOWN: Final = Quality(is_latched=True)
"""Quality of service of a publisher not in the graph: the highest, which any subscription fits."""


class LinkContext:
    """State that all bridges of a session connection share: middleware, world, counts of messages.

    Attributes:
        options: Options of this process in the session.
        middleware: Middleware that sends and receives messages.
        graph: Graph of the other processes.
        endpoints: Endpoints of other processes, as stored in the world.
        refused: Number of received messages that were malformed.
        received: Number of received messages that were valid.
        heard_statics: Gids of publishers that have sent static transforms.
    """

    def __init__(self, options: Options, middleware: Middleware) -> None:
        self.options = options
        self.middleware = middleware
        self.graph: Graph = middleware.graph
        self.endpoints: dict[GraphEntity, Endpoint] = {}
        self.refused = 0
        self.received = 0
        self.heard_statics: set[bytes] = set()
        self._world: World | None = None
        self._said: set[str] = set()
        self._senders: dict[tuple[bytes, str], GraphEntity | None] = {}

    @property
    def world(self) -> World:
        """World that is attached to the session connection."""
        if self._world is None:
            raise LinkError("no world is attached to this connection: call 'attach' first")
        return self._world

    def now(self) -> Stamp:
        """Return the time of the world's clock in nanoseconds."""
        return self.world.clock.now()

    @property
    def unanswering(self) -> str:
        """Sentence about local processes that do not respond, with advice; "" if all respond."""
        found = [str(pid) for pid in self.middleware.unanswering]
        if not found:
            return ""
        which = "process" if len(found) == 1 else "processes"
        does, it = ("does", "it") if len(found) == 1 else ("do", "them")
        return (
            f"{which.capitalize()} {', '.join(found)} of this machine {does} not answer (stopped "
            f"with Ctrl-Z?): resume {it} (fg, or kill -CONT {' '.join(found)}), or end {it} "
            f"(kill -9 {' '.join(found)})."
        )

    @property
    def main_node(self) -> str:
        """Name of the world's first node, under which entities without a node are announced."""
        shown = (node.name for node in self.world.nodes if node.is_shown)
        return next(shown, f"tftool_{self.options.command}")

    @property
    def awaits_statics(self) -> bool:
        """Whether a publisher of static transforms has been announced, but has sent nothing yet."""
        if b"" in self.heard_statics:
            return False  # a sender that does not identify itself
        publishers = self.graph.entities(PUBLISHER, name="tf_static")
        return any(
            one.gid not in self.heard_statics and one.quality.is_latched for one in publishers
        )

    def authority(self, gid: bytes, topic: str) -> str:
        """Return the name of the node that sent a message; `publisher_GID` for an unknown node."""
        entity = self._sender(gid, topic)
        return _unnamed(gid) if entity is None else entity.node

    def endpoint(self, gid: bytes, topic: str, ros_type: str) -> Endpoint:
        """Return the publisher of a message as an endpoint of the world.

        A message can arrive before the announcement of its publisher. Until then, the publisher is
        named by its gid, and matches any subscription.
        """
        entity = self._sender(gid, topic)
        if entity is None:
            return Endpoint(PUBLISHER, _unnamed(gid), topic, ros_type, UNKNOWN, is_remote=True)
        return self.far_endpoint(entity)

    def far_endpoint(self, entity: GraphEntity) -> Endpoint:
        """Return the `Endpoint` of another process's publisher, subscription or client."""
        if entity not in self.endpoints:
            self.endpoints[entity] = Endpoint(
                cast("Role", entity.kind),
                entity.node,
                entity.name,
                entity.ros_type,
                entity.quality,
                is_remote=True,
                gid=entity.gid,
            )
        return self.endpoints[entity]

    def _sender(self, gid: bytes, topic: str) -> GraphEntity | None:
        # By topic, too: a message without a gid is assigned to the topic's only publisher.
        key = gid, topic
        if key not in self._senders:
            if len(self._senders) > 1000:
                self._senders.clear()
            self._senders[key] = self.graph.publisher(gid, topic)
        return self._senders[key]

    def refuse(self, name: str, refusal: MalformedMessage) -> None:
        """Count a malformed message; log the first malformed message of each topic."""
        self.refused += 1
        self.say_once(
            f"refused {name}", f"On '{name}': {refusal}. Further such messages are only counted."
        )

    def say_once(self, what: str, sentence: str) -> None:
        """Log a warning, once for each value of `what`."""
        if what not in self._said and len(self._said) < 1000:
            self._said.add(what)
            self.world.log.warn(NAME, sentence)


def _unnamed(gid: bytes) -> str:
    """Return a name for a publisher whose node is unknown, from its gid."""
    return f"publisher_{gid[:4].hex() or 'unknown'}"
