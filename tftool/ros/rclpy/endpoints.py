"""rclpy's description of a topic's publisher or subscription."""

from dataclasses import dataclass, field
from enum import IntEnum

from tftool.ros.rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
    profile_from,
)
from tftool.ros.rclpy.time import Duration, Infinite
from tftool.world.endpoints import PUBLISHER, Endpoint


class TopicEndpointTypeEnum(IntEnum):
    """Kind of a topic's endpoint."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


@dataclass(frozen=True, slots=True)
class TypeHash:
    """Hash of an interface: a version of the algorithm, and 32 bytes.

    Attributes:
        version: 1; -1 where there is no hash.
        value: The bytes.
    """

    version: int = -1
    value: bytes = bytes(32)

    def __str__(self) -> str:
        if self.version <= 0 or len(self.value) != 32:
            return "INVALID"
        return f"RIHS{self.version:02}_{self.value.hex()}"


def _unknown() -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy.UNKNOWN,
        depth=0,
        reliability=ReliabilityPolicy.UNKNOWN,
        durability=DurabilityPolicy.UNKNOWN,
        liveliness=LivelinessPolicy.UNKNOWN,
        lifespan=Duration(),
        deadline=Duration(),
        liveliness_lease_duration=Duration(),
    )


@dataclass(slots=True)
class TopicEndpointInfo:
    """Publisher or subscription of a topic, with its quality of service."""

    node_name: str = ""
    node_namespace: str = ""
    topic_type: str = ""
    endpoint_type: TopicEndpointTypeEnum = TopicEndpointTypeEnum.INVALID
    qos_profile: QoSProfile = field(default_factory=_unknown)
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
    """Return the description of a publisher or a subscription."""
    namespace, _, name = end.node.rpartition("/")
    publishes = end.role == PUBLISHER
    return TopicEndpointInfo(
        name,
        f"/{namespace}",
        end.interface,
        TopicEndpointTypeEnum.PUBLISHER if publishes else TopicEndpointTypeEnum.SUBSCRIPTION,
        profile_from(end.quality),
    )
