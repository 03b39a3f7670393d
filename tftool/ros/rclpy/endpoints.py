"""rclpy's description of one end of a topic."""

from dataclasses import dataclass
from enum import IntEnum

from tftool.ros.rclpy.qos import QoSProfile, profile_from
from tftool.runtime.endpoints import PUBLISHER, Endpoint


class TopicEndpointTypeEnum(IntEnum):
    """Which end of a topic."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


@dataclass(frozen=True, slots=True)
class TopicEndpointInfo:
    """Who publishes or subscribes a topic, and how."""

    node_name: str
    node_namespace: str
    topic_type: str
    endpoint_type: TopicEndpointTypeEnum
    qos_profile: QoSProfile


def endpoint_info(end: Endpoint) -> TopicEndpointInfo:
    """The description of a publisher or a subscription."""
    namespace, _, name = end.node.rpartition("/")
    publishes = end.role == PUBLISHER
    return TopicEndpointInfo(
        name,
        f"/{namespace}",
        end.interface,
        TopicEndpointTypeEnum.PUBLISHER if publishes else TopicEndpointTypeEnum.SUBSCRIPTION,
        profile_from(end.quality),
    )
