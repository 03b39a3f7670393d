"""What topics, services and actions on their way out and in need of the link they belong to.

The link makes them and they ask it; this narrow part between the two leaves one direction.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

from tftool.errors import LinkError, MalformedMessage
from tftool.link import keys
from tftool.link.graph import Graph
from tftool.link.keys import Attachment, Entity
from tftool.link.reach import Reach
from tftool.link.transport import Outlet, Wire
from tftool.runtime.endpoints import Endpoint, Quality
from tftool.runtime.world import World

NAME: Final = "link"
"""Who speaks in a world's log when the link has something to say."""


@dataclass(frozen=True, slots=True)
class Options:
    """How a process takes part.

    Attributes:
        command: What it is called for: "demo", "echo".
        domain: Number of the ROS domain.
        reach: What to open beyond this machine's own processes.
        read_only: Only look: declare no publisher, no service and no token.
    """

    command: str = "tftool"
    domain: int = 0
    reach: Reach = field(default_factory=Reach)
    read_only: bool = False


class Membership:
    """A process's voice in a session: its wire, its world, and its names for what it offers.

    Attributes:
        options: How the process takes part.
        wire: What carries it all.
        graph: Who else is there.
        refused: Messages that came in and were not what they should be.
        received: Messages that were taken in.
    """

    def __init__(self, options: Options, wire: Wire, graph: Graph) -> None:
        self.options = options
        self.wire = wire
        self.graph = graph
        self.refused = 0
        self.received = 0
        self._world: World | None = None
        self._nodes: dict[str, tuple[int, Callable[[], None]]] = {}
        self._entity_ids = 0
        self._said: set[str] = set()
        self._senders: dict[tuple[bytes, str], Entity | None] = {}
        self._endpoints: dict[Entity, tuple[Endpoint, Callable[[], None]]] = {}

    @property
    def world(self) -> World:
        """The world that is attached."""
        if self._world is None:
            raise LinkError("no world is attached to this link yet")
        return self._world

    @property
    def main_node(self) -> str:
        """The node that what cannot be told apart is said to be of: the first of the world."""
        shown = (node.name for node in self.world.nodes if node.is_shown)
        return next(shown, f"tftool_{self.options.command}")

    def entity(self, kind: str, node: str, name: str, ros_type: str, quality: Quality) -> Entity:
        """Describe something new of ours."""
        self._entity_ids += 1
        return Entity(
            self.options.domain,
            self.wire.zid,
            self._node_id(node),
            self._entity_ids,
            kind,  # type: ignore[arg-type]
            plain(node),
            name,
            ros_type,
            quality=keys.quality(quality),
        )

    def show(self, entity: Entity) -> Callable[[], None]:
        """Show a token of ours until told to stop."""
        if self.options.read_only:
            return _nothing
        return self.wire.token(entity.token())

    def publisher(self, name: str, ros_type: str, quality: Quality) -> Outlet:
        """Declare that messages of a topic go out."""
        return self.wire.publisher(keys.data_key(self.options.domain, name, ros_type), quality)

    def attachment(self, sequence: int, gid: bytes) -> bytes:
        """What travels beside a message of ours."""
        return Attachment(sequence, self.world.clock.now(), gid).encode()

    def authority(self, gid: bytes, topic: str) -> str:
        """The node that sent a message, by what stood beside it."""
        entity = self._sender(gid, topic)
        return f"publisher_{gid[:4].hex()}" if entity is None else entity.node

    def endpoint(self, gid: bytes, topic: str) -> Endpoint | None:
        """The publisher that sent a message; None when it cannot be told."""
        entity = self._sender(gid, topic)
        return None if entity is None else self._endpoints.get(entity, (None,))[0]

    def _sender(self, gid: bytes, topic: str) -> Entity | None:
        # By topic, too: whoever says nothing of itself is guessed from who publishes there.
        key = gid, topic
        if key not in self._senders:
            if len(self._senders) > 1000:
                self._senders.clear()
            self._senders[key] = self.graph.publisher(gid, topic)
        return self._senders[key]

    def refuse(self, topic: str, refusal: MalformedMessage) -> None:
        """Count a message that is not what it should be, and say the first of each topic."""
        self.refused += 1
        self.say_once(f"refused {topic}", f"On '{topic}': {refusal}. Others like it are counted.")

    def say_once(self, what: str, sentence: str) -> None:
        """Warn in the world's log, unless this was said before."""
        if what not in self._said and len(self._said) < 1000:
            self._said.add(what)
            self.world.log.warn(NAME, sentence)

    def _node_id(self, node: str) -> int:
        found = self._nodes.get(node)
        return 0 if found is None else found[0]


def plain(name: str) -> str:
    """A node's name as ROS would have it: letters, digits and underscores."""
    name = re.sub(r"[^A-Za-z0-9_/]", "_", name.strip("/"))[:200]
    name = re.sub(r"/+", "/", name)
    return name if name and not name[0].isdigit() else f"_{name}"


def _nothing() -> None:
    """Stop nothing."""
