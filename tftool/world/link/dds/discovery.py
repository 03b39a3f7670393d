"""Discovery in DDS, from the built-in topics and the messages in which ROS 2 announces nodes.

DDS knows participants and their endpoints. The node of an endpoint is published on
`ros_discovery_info` by every participant of ROS 2.
"""

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final

from cyclonedds import builtin
from cyclonedds.core import InstanceState

from tftool.base.errors import LinkError, MalformedMessage
from tftool.messages.classes import Interfaces, Message
from tftool.messages.codec import Codec, codec
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Quality
from tftool.world.link.dds import dds_types as names
from tftool.world.link.dds.dds_types import Types
from tftool.world.link.dds.participant import DdsSample, Participant, TopicWriter
from tftool.world.link.graph import NODE, SERVER, Graph, GraphEntity, Process, node_name

INFO: Final = "rmw_dds_common/msg/ParticipantEntitiesInfo"

_DEFINITION: Final = """\
rmw_dds_common/Gid gid
rmw_dds_common/NodeEntitiesInfo[] node_entities_info_seq
================================================================================
MSG: rmw_dds_common/NodeEntitiesInfo
string<=256 node_namespace
string<=256 node_name
rmw_dds_common/Gid[] reader_gid_seq
rmw_dds_common/Gid[] writer_gid_seq
================================================================================
MSG: rmw_dds_common/Gid
uint8[{size}] data
"""

GID_SIZES: Final = (16, 24)
"""Bytes of a GUID in `ros_discovery_info`: since ROS 2 Iron, and before."""

LATEST_OF_ALL: Final = Quality(depth=1, is_latched=True)
"""Quality of service of `ros_discovery_info`."""

MOST: Final = 20_000
"""Largest number of endpoints that are stored."""

_KINDS: Final = {
    (names.TOPIC, PUBLISHER): PUBLISHER,
    (names.TOPIC, SUBSCRIPTION): SUBSCRIPTION,
    # A service has two topics; the reader of requests is the server, the writer a client.
    (names.REQUEST, SUBSCRIPTION): SERVER,
    (names.REQUEST, PUBLISHER): CLIENT,
}


@dataclass(frozen=True, slots=True)
class _Found:
    """Endpoint of another process that a built-in topic has announced."""

    handle: int
    participant: bytes
    entity: GraphEntity


class Information:
    """Format of the messages on `ros_discovery_info`, which list the endpoints of each node."""

    def __init__(self, size: int) -> None:
        self.size = size
        self._interfaces = Interfaces()
        self.kind: type[Message] = self._interfaces.recorded(INFO, _DEFINITION.format(size=size))
        self._interfaces.define(INFO, _DEFINITION.format(size=size))
        self._codec: Codec = codec(self.kind)

    def raw(self) -> type[Any]:
        """Return the class with which the library sends and receives messages of this format."""
        return Types(self._interfaces).raw(INFO)

    def encode(self, participant: bytes, nodes: dict[str, tuple[set[bytes], set[bytes]]]) -> bytes:
        """Return the message that announces a participant's nodes.

        Args:
            participant: GUID of the participant.
            nodes: For each node of the participant, the GUIDs of its readers, and of its writers.
        """
        said: Any = self.kind()
        said.gid = self._gid(participant)
        said.node_entities_info_seq = [
            self._node(name, *gids) for name, gids in sorted(nodes.items())
        ]
        return self._codec.encode(said)

    def decode(self, payload: bytes) -> tuple[bytes, dict[bytes, str], list[str]]:
        """Read a message that announces a participant's nodes.

        Returns:
            GUID of the participant; name of the node of each endpoint, by the endpoint's GUID;
            names of all nodes.

        Raises:
            MalformedMessage: If the bytes have another format.
        """
        said: Any = self._codec.decode(payload)
        nodes, found = [], {}
        for one in said.node_entities_info_seq:
            name = node_name(f"{one.node_namespace}/{one.node_name}")
            nodes.append(name)
            for gid in (*one.reader_gid_seq, *one.writer_gid_seq):
                found[bytes(gid.data)[:16]] = name
        return bytes(said.gid.data)[:16], found, nodes

    def _gid(self, guid: bytes) -> Any:
        return self._interfaces.message("rmw_dds_common/msg/Gid")(
            data=list(guid.ljust(self.size, b"\0"))
        )

    def _node(self, name: str, readers: set[bytes], writers: set[bytes]) -> Any:
        space, _, own = name.rpartition("/")
        return self._interfaces.message("rmw_dds_common/msg/NodeEntitiesInfo")(
            node_namespace=f"/{space}",
            node_name=own,
            reader_gid_seq=[self._gid(gid) for gid in sorted(readers)],
            writer_gid_seq=[self._gid(gid) for gid in sorted(writers)],
        )


class Discovery:
    """Discovery of a DDS domain: updates the graph, and announces this process's nodes.

    Attributes:
        graph: Graph of the other processes.
        participants: Number of participants.
    """

    def __init__(self, participant: Participant, domain: int) -> None:
        """Start discovery; call `look` later to process the received announcements.

        Args:
            participant: This process's participant.
            domain: Number of the domain.
        """
        self._participant = participant
        self._domain = domain
        self.graph = Graph(participant.gid.hex(), domain)
        self._names: dict[bytes, str] = {}
        self._found: dict[tuple[str, bytes], _Found] = {}
        self._gids: dict[int, bytes] = {}
        self._speaking: set[bytes] = set()
        self._informing: dict[bytes, int] = {}
        self._nodes: dict[bytes, tuple[dict[bytes, str], list[str]]] = {}
        self._shown_nodes: dict[bytes, set[str]] = {}
        self._report: Callable[[GraphEntity | Process | None, bool], None] = _ignore
        self._is_due = threading.Event()
        self._will_look = False
        self._changed = self._is_due.set
        self._information = {size: Information(size) for size in GID_SIZES}
        told = self._tell
        self._participants = participant.builtin(builtin.BuiltinTopicDcpsParticipant, told)
        self._readers = {
            PUBLISHER: participant.builtin(builtin.BuiltinTopicDcpsPublication, told),
            SUBSCRIPTION: participant.builtin(builtin.BuiltinTopicDcpsSubscription, told),
        }
        self._infos = [
            participant.reader(names.DISCOVERY, form.raw(), LATEST_OF_ALL, self._informed_by(form))
            for form in self._information.values()
        ]
        self._own: dict[str, tuple[set[bytes], set[bytes]]] = {}
        self._writer: TopicWriter | None = None
        participant.at_close(self._close)

    def _close(self) -> None:
        self._report = _ignore
        self._participants = None
        self._readers.clear()
        for reader in self._infos:
            reader.close()
        if self._writer is not None:
            self._writer.close()

    def start(self, report: Callable[[GraphEntity | Process | None, bool], None]) -> None:
        """Call `report` from now on for every added or removed node, endpoint or process."""
        self._report = report
        self._changed = self._look_soon
        self._look_soon()

    @property
    def participants(self) -> int:
        """Number of known participants."""
        return len(self._names)

    @property
    def is_complete(self) -> bool:
        """Whether every participant has announced all its endpoints and nodes."""
        has_spoken = self._names.keys() <= self._speaking
        return has_spoken and self._informing.keys() <= self._nodes.keys()

    def wait(self, seconds: float) -> bool:
        """Wait for announcements; return False at the timeout. Call no callback."""
        changed = self._is_due.wait(seconds)
        self._is_due.clear()
        return changed

    def gid(self, writer: int) -> bytes:
        """Return the GUID of a writer, given by its number in the library; b"" if unknown."""
        if writer not in self._gids:
            self.look()
        return self._gids.get(writer, b"")

    # In threads of the library

    def _tell(self) -> None:
        self._changed()

    def _look_soon(self) -> None:
        # One look processes all changes until then.
        # The flag is read and set on different threads; at worst, there is one look too many.
        if not self._will_look:
            self._will_look = True
            self._participant.inbox.put(self._look_now, None)

    def _look_now(self, _: object) -> None:
        self._will_look = False
        self.look()

    # In the event loop

    def look(self) -> None:
        """Process the messages that the built-in topics have received."""
        if self._participants is None:
            return
        # Participants first, because an endpoint needs the process of its participant.
        for one in _all(self._participants):
            self._take_participant(one)
        for role, reader in self._readers.items():
            for one in _all(reader):
                self._take_endpoint(role, one)

    def _take_participant(self, one: Any) -> None:
        key = one.key.bytes
        # The library reports this process as well.
        if key == self._participant.gid:
            return
        if not _is_alive(one):
            self._forget(key)
            return
        policies = {policy.__scope__: policy for policy in one.qos}
        # Policies differ between vendors: a missing one reads as empty.
        self._names[key] = str(getattr(policies.get("EntityName"), "name", ""))
        data = bytes(getattr(policies.get("Userdata"), "data", b""))
        process = names.process_shown(data, self._domain, key.hex())
        if process is not None:
            self._exchange(f"process {key.hex()}", process)

    def _take_endpoint(self, role: str, one: Any) -> None:
        key, owner = (role, one.key.bytes), one.participant_key.bytes
        if not _is_alive(one):
            # A sample about a removed instance contains only the key.
            gone = self._found.pop(key, None)
            self._gids.pop(one.sample_info.instance_handle, None)
            if gone is not None:
                self._exchange(_key(key), None)
            return
        # The bound protects against a peer that announces endpoints without end.
        if owner == self._participant.gid or len(self._found) >= MOST:
            return
        self._speaking.add(owner)
        handle = one.sample_info.instance_handle
        if role == PUBLISHER:
            # Samples name their writer by this handle, not by GUID.
            self._gids[handle] = key[1]
        # A writer of this topic promises nodes: `is_complete` waits for them.
        if one.topic_name == names.DISCOVERY and role == PUBLISHER:
            policies = {policy.__scope__: policy for policy in one.qos}
            data = bytes(getattr(policies.get("Userdata"), "data", b""))
            self._informing[owner] = GID_SIZES[0] if names.hash_shown(data) else 0
            return
        # Topics without a prefix of ROS do not belong to ROS.
        part = names.ros_part(one.topic_name, one.type_name)
        kind = None if part is None else _KINDS.get((part.prefix, role))
        if part is None or kind is None:
            return
        quality, shown_hash = _described(one.qos)
        entity = GraphEntity(
            kind,
            self._domain,
            owner.hex(),
            "",
            part.name,
            part.ros_type,
            quality,
            key[1],
            shown_hash,
        )
        self._found[key] = _Found(handle, owner, entity)
        self._show(key)

    def _show(self, key: tuple[str, bytes]) -> None:
        """Add an endpoint, given by its role and GUID, to the graph below the endpoint's node."""
        found = self._found[key]
        nodes = self._nodes.get(found.participant, ({}, []))[0]
        node = nodes.get(key[1]) or self._node_of(found.participant)
        self._exchange(_key(key), replace(found.entity, node=node))

    def _node_of(self, participant: bytes) -> str:
        """Return a substitute node name for a participant that announces no nodes."""
        # If the process has one node, all endpoints are that node's, even before its list arrives.
        only = self._nodes.get(participant, ({}, []))[1]
        if len(only) == 1:
            return only[0]
        name = self._names.get(participant, "")
        return node_name(name) if name else f"participant_{participant[2:8].hex()}"

    def _forget(self, participant: bytes) -> None:
        self._names.pop(participant, None)
        self._informing.pop(participant, None)
        self._speaking.discard(participant)
        self._nodes.pop(participant, None)
        # Nodes and endpoints are removed before their process.
        for name in self._shown_nodes.pop(participant, set()):
            self._exchange(f"node {participant.hex()} {name}", None)
        for key in [key for key, one in self._found.items() if one.participant == participant]:
            self._gids.pop(self._found.pop(key).handle, None)
            self._exchange(_key(key), None)
        self._exchange(f"process {participant.hex()}", None)

    def _exchange(self, key: str, new: GraphEntity | Process | None) -> None:
        """Replace the graph's entry under a key by `new` (None: no entry); report the change."""
        old = self.graph.get(key)
        if old == new:
            return
        if old is not None:
            self.graph.remove(key)
        # The new entry is reported before the old one is removed, so that there is no gap.
        if new is not None and self.graph.add(key, new) is not None:
            self._report(new, True)
        if old is not None:
            self._report(old, False)

    # Announcements of other processes' nodes

    def _informed_by(self, form: Information) -> Callable[[DdsSample], None]:
        def informed(sample: DdsSample) -> None:
            self._take_information(form, sample)

        return informed

    def _take_information(self, form: Information, sample: DdsSample) -> None:
        try:
            participant, nodes, all_nodes = form.decode(sample.payload)
        except (MalformedMessage, UnicodeError):
            return
        self.look()
        if participant not in self._names:
            return  # the process has left, or it writes about another one
        # A message of one version can be decoded as the other version, and is then empty.
        if self._informing.get(participant) not in (None, 0, form.size):
            return
        # An empty list in the older form may be a misread newer form, so it removes no node.
        if not all_nodes and form.size != GID_SIZES[0] and participant in self._nodes:
            return
        self._nodes[participant] = nodes, all_nodes
        shown, now = self._shown_nodes.setdefault(participant, set()), set(all_nodes)
        for name in shown - now:
            self._exchange(f"node {participant.hex()} {name}", None)
        for name in now - shown:
            entity = GraphEntity(NODE, self._domain, participant.hex(), name)
            self._exchange(f"node {participant.hex()} {name}", entity)
        self._shown_nodes[participant] = now
        # Endpoints that were known before their node are stored again, under the node's name.
        for key in [key for key, one in self._found.items() if one.participant == participant]:
            self._show(key)

    # Announcements of this process

    def show_node(self, name: str) -> Callable[[], None]:
        """Announce a node of this process; return a function that ends the announcement."""
        self._own.setdefault(name, (set(), set()))
        self._say()

        def hide() -> None:
            if self._own.pop(name, None) is not None:
                self._say()

        return hide

    def show_endpoint(self, node: str, role: str, gid: bytes) -> Callable[[], None]:
        """Announce an endpoint of a node of this process; return a function to end this."""
        which = 1 if role == PUBLISHER else 0
        self._own.setdefault(node, (set(), set()))[which].add(gid)
        self._say()

        def hide() -> None:
            if node in self._own:
                self._own[node][which].discard(gid)
                self._say()

        return hide

    def _say(self) -> None:
        if self._participants is None:
            return
        # Created with the first entry: a process that only observes writes nothing.
        if self._writer is None:
            form = self._information[GID_SIZES[0]]
            self._writer = self._participant.writer(names.DISCOVERY, form.raw(), LATEST_OF_ALL, b"")
        said = self._information[GID_SIZES[0]].encode(self._participant.gid, self._own)
        try:
            self._writer.put(said)
        except LinkError:
            return


def _ignore(_: GraphEntity | Process | None, __: bool) -> None:
    """Do nothing, in place of a function that reports changes of the graph."""


def _key(key: tuple[str, bytes]) -> str:
    return f"{key[0]} {key[1].hex()}"


def _all(reader: Any) -> list[Any]:
    """Return all messages that a reader of a built-in topic has received."""
    found: list[Any] = []
    while taken := reader.take(256):
        found += taken
    return found


def _is_alive(one: Any) -> bool:

    return bool(one.sample_info.instance_state == InstanceState.Alive)


def _described(qos: Any) -> tuple[Quality, str]:
    """Return an endpoint's quality of service, and its type hash ("" if not announced)."""
    policies = {policy.__scope__: policy for policy in qos}
    history = policies.get("History")
    quality = Quality(
        depth=max(1, int(getattr(history, "depth", 1))),
        is_reliable=type(policies.get("Reliability")).__name__.endswith("Reliable"),
        is_latched=not type(policies.get("Durability")).__name__.endswith("Volatile"),
        keeps_all="KeepAll" in type(history).__name__,
    )
    data = bytes(getattr(policies.get("Userdata"), "data", b""))
    return quality, names.hash_shown(data)
