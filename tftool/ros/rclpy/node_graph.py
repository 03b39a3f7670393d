"""Methods of a node that list nodes, topics, services and actions, and describe endpoints."""

from collections.abc import Callable, Iterable, Iterator
from copy import copy
from dataclasses import dataclass, field
from enum import IntEnum
from itertools import chain
from typing import Any, TypeVar

from tftool.messages.classes import interface_name
from tftool.ros.host.names import join
from tftool.ros.rclpy.node_state import NodeState, state_of
from tftool.ros.rclpy.qos import HistoryPolicy, QoSProfile, profile_from, qos_profile_unknown
from tftool.ros.rclpy.time import Duration, Infinite
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Endpoint, Endpoints, Role


class TopicEndpointTypeEnum(IntEnum):
    """Type of an endpoint of a topic: publisher or subscription."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


@dataclass(frozen=True, slots=True)
class TypeHash:
    """Hash of the definition of a message type.

    Attributes:
        version: Version of the hash algorithm, 1; -1 without a hash.
        value: The 32 bytes of the hash.
    """

    version: int = -1
    value: bytes = bytes(32)

    def __str__(self) -> str:
        if self.version <= 0 or len(self.value) != 32:
            return "INVALID"
        return f"RIHS{self.version:02}_{self.value.hex()}"


@dataclass(slots=True)
class TopicEndpointInfo:
    """Description of a publisher or subscription: its node, topic type and quality of service."""

    node_name: str = ""
    node_namespace: str = ""
    topic_type: str = ""
    endpoint_type: TopicEndpointTypeEnum = TopicEndpointTypeEnum.INVALID
    qos_profile: QoSProfile = field(default_factory=lambda: copy(qos_profile_unknown))
    topic_type_hash: TypeHash = field(default_factory=TypeHash)
    endpoint_gid: list[int] = field(default_factory=list)

    def __str__(self) -> str:
        qos = self.qos_profile
        depth = f" ({qos.depth})" if qos.history == HistoryPolicy.KEEP_LAST else ""
        return (
            f"Node name: {self.node_name}\n"
            f"Node namespace: {self.node_namespace}\n"
            f"Topic type: {self.topic_type}\n"
            f"Topic type hash: {self.topic_type_hash}\n"
            f"Endpoint type: {self.endpoint_type.name}\n"
            f"GID: {'.'.join(format(byte, '02x') for byte in self.endpoint_gid)}\n"
            "QoS profile:\n"
            f"  Reliability: {qos.reliability.name}\n"
            f"  History (Depth): {qos.history.name}{depth}\n"
            f"  Durability: {qos.durability.name}\n"
            f"  Lifespan: {_time(qos.lifespan)}\n"
            f"  Deadline: {_time(qos.deadline)}\n"
            f"  Liveliness: {qos.liveliness.name}\n"
            f"  Liveliness lease duration: {_time(qos.liveliness_lease_duration)}"
        )


def _time(length: Duration) -> str:
    return "Infinite" if length == Infinite else f"{length.nanoseconds} nanoseconds"


def endpoint_info(end: Endpoint) -> TopicEndpointInfo:
    """Return the `TopicEndpointInfo` of a publisher or subscription."""
    namespace, _, name = end.node.rpartition("/")
    publishes = end.role == PUBLISHER
    return TopicEndpointInfo(
        name,
        f"/{namespace}",
        end.interface,
        TopicEndpointTypeEnum.PUBLISHER if publishes else TopicEndpointTypeEnum.SUBSCRIPTION,
        profile_from(end.quality),
        endpoint_gid=list(end.gid),
    )


T = TypeVar("T")

NamesAndTypes = list[tuple[str, list[str]]]
"""Full names with a leading slash, each with its types."""


class NodeNameNonExistentError(Exception):
    """Error for a query about a node that does not exist."""


class NodeGraph:
    """Methods of a node that list all nodes, topics, services and actions."""

    _tftool: NodeState

    def __look(self, question: Callable[[], T]) -> T:
        found: T = self._tftool.program.ask(question)
        return found

    # Nodes

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Block until a node exists; return False after `timeout` seconds."""
        wanted = fully_qualified_node_name.strip("/")
        return self._tftool.wait_until(lambda: wanted in self.__nodes(), timeout)

    def get_node_names(self) -> list[str]:
        """Return the names, without namespaces, of all nodes."""
        return [name for name, _ in self.get_node_names_and_namespaces()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the full names, such as "/robot/camera", of all nodes."""
        return [f"/{full}" for full in self.__look(self.__nodes)]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return (name, namespace) of all nodes."""
        parted = (full.rpartition("/") for full in self.__look(self.__nodes))
        return [(name, f"/{namespace}") for namespace, _, name in parted]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return (name, namespace, enclave) of all nodes; the enclave is always "/"."""
        return [(*one, "/") for one in self.get_node_names_and_namespaces()]

    def __nodes(self) -> list[str]:
        return _node_names(self._tftool)

    # Topics

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """Return (name, types) of every topic."""
        return self.__look(self.__topics)

    def __topics(self) -> NamesAndTypes:
        world = self._tftool.world
        found = {
            name: {kind}
            for name, topic in world.topics().items()
            # Topics without a ROS type, such as pressed keys, are known only to tftool's own nodes.
            if (kind := interface_name(topic.kind))
        }
        for name in world.endpoints.topics():
            ends = (world.endpoints.of(name, role) for role in (PUBLISHER, SUBSCRIPTION))
            found[name] = {end.interface for end in chain(*ends)}
        return _listed((name, kind) for name, kinds in found.items() for kind in kinds)

    def count_publishers(self, topic_name: str) -> int:
        """Count the publishers of a topic."""
        return self.__count(topic_name, PUBLISHER)

    def count_subscribers(self, topic_name: str) -> int:
        """Count the subscriptions to a topic."""
        return self.__count(topic_name, SUBSCRIPTION)

    def __count(self, topic_name: str, role: Role) -> int:
        count = len(self.__ends(topic_name, role))
        if not count:
            self._tftool.program.count_failed_query(must_keep_pace=False)
        return count

    def get_publishers_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return a description of each publisher that ROS nodes have on a topic."""
        return [endpoint_info(end) for end in self.__ends(topic_name, PUBLISHER)]

    def get_subscriptions_info_by_topic(
        self, topic_name: str, no_mangle: bool = False
    ) -> list[TopicEndpointInfo]:
        """Return a description of each subscription that ROS nodes have to a topic."""
        return [endpoint_info(end) for end in self.__ends(topic_name, SUBSCRIPTION)]

    def __ends(self, topic_name: str, role: Role) -> list[Endpoint]:
        full = self._tftool.full(topic_name)
        return self.__look(lambda: list(self._tftool.world.endpoints.of(full, role)))

    # Services

    def get_service_names_and_types(self) -> NamesAndTypes:
        """Return (name, known types) of every service that has a server or a client."""
        clients = self._tftool.world.clients
        return self.__look(
            lambda: _listed(
                chain(self.__offered_services(), _endpoint_names(None, clients, CLIENT))
            )
        )

    def __offered_services(self, node: str | None = None) -> Iterator[tuple[str, str]]:
        """Yield (name, type) of each service that `node` offers; None for all nodes."""
        for name, offer in self._tftool.world.services().items():
            if node in (None, offer.node):
                yield name, interface_name(offer.kind)

    def count_services(self, service_name: str) -> int:
        """Count the servers of a service; all servers in other processes together count as one."""
        full = self._tftool.full(service_name, is_service=True)
        return self.__look(lambda: self._tftool.world.count_services(full))

    def count_clients(self, service_name: str) -> int:
        """Count the clients of a service in the ROS nodes of all processes."""
        full = self._tftool.full(service_name, is_service=True)
        return self.__look(lambda: len(self._tftool.world.clients.of(full, CLIENT)))

    # Entities of one node

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return (name, types) of each topic that a ROS node publishes."""
        endpoints = self._tftool.world.endpoints
        return _of_node(
            self._tftool, node_name, node_namespace, _endpoint_names, endpoints, PUBLISHER
        )

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return (name, types) of each topic to which a ROS node subscribes."""
        endpoints = self._tftool.world.endpoints
        return _of_node(
            self._tftool, node_name, node_namespace, _endpoint_names, endpoints, SUBSCRIPTION
        )

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return (name, types) of each service that a node offers."""
        return _of_node(self._tftool, node_name, node_namespace, self.__offered_services)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return (name, types) of each service for which a ROS node has a client."""
        clients = self._tftool.world.clients
        return _of_node(self._tftool, node_name, node_namespace, _endpoint_names, clients, CLIENT)


def get_action_names_and_types(node: Any) -> NamesAndTypes:
    """Return (name, types) of every action that has a server or a client."""
    state = state_of(node)
    found: NamesAndTypes = state.program.ask(
        lambda: _listed(chain(_served_actions(None, state), _sought_actions(None, state)))
    )
    return found


def get_action_server_names_and_types_by_node(
    node: Any, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return (name, types) of each action for which a node has a server.

    Raises:
        NodeNameNonExistentError: If there is no such node.
    """
    state = state_of(node)
    return _of_node(state, remote_node_name, remote_node_namespace, _served_actions, state)


def get_action_client_names_and_types_by_node(
    node: Any, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return (name, types) of each action for which a ROS node has a client.

    Raises:
        NodeNameNonExistentError: If there is no such node.
    """
    state = state_of(node)
    return _of_node(state, remote_node_name, remote_node_namespace, _sought_actions, state)


def _node_names(state: NodeState) -> list[str]:
    return [
        *(one.name for one in state.world.nodes if one.is_shown),
        *state.world.far_nodes,
    ]


def _endpoint_names(
    node: str | None, endpoints: Endpoints, role: Role
) -> Iterator[tuple[str, str]]:
    """Yield (topic or service, type) for each publisher, subscription or client of a node.

    If `node` is None, yield the pairs of all nodes.
    """
    for name in endpoints.topics():
        for end in endpoints.of(name, role):
            if node in (None, end.node):
                yield name, end.interface


def _served_actions(by: str | None, state: NodeState) -> Iterator[tuple[str, str]]:
    for name, offer in state.world.actions().items():
        if by in (None, offer.node):
            yield name, interface_name(offer.kind)


def _sought_actions(by: str | None, state: NodeState) -> Iterator[tuple[str, str]]:
    for name, kind in _endpoint_names(by, state.world.clients, CLIENT):
        if name.endswith("/_action/send_goal"):
            yield name.removesuffix("/_action/send_goal"), kind.removesuffix("_SendGoal")


def _of_node(
    state: NodeState,
    name: str,
    namespace: str,
    find: Callable[..., Iterable[tuple[str, str]]],
    *args: Any,
) -> NamesAndTypes:
    """Return (name, types) of the topics, services or actions of one node.

    `find` yields (name, type) for a node's full name and the arguments `args`.

    Raises:
        NodeNameNonExistentError: If there is no such node.
    """
    full = join(namespace, name)

    def found() -> NamesAndTypes:
        if full not in _node_names(state):
            raise NodeNameNonExistentError(f"there is no node '/{full}'")
        return _listed(find(full, *args))

    return state.program.ask(found)  # type: ignore[no-any-return]


def _listed(pairs: Iterable[tuple[str, str]]) -> NamesAndTypes:
    """Group pairs (name, type) to (name, types), sorted by name; leave out unknown types, ""."""
    found: dict[str, set[str]] = {}
    for name, kind in pairs:
        found.setdefault(f"/{name}", set()).update([kind] if kind else [])
    return [(name, sorted(found[name])) for name in sorted(found)]
