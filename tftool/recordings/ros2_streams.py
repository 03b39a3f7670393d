"""Channels of ROS 2 message types, as rosbag2 records them."""

from typing import Final

from tftool.recordings.channel import Channel
from tftool.recordings.rosbag2.offered_qos import offers_text
from tftool.recordings.schema_text import known_hash, ros2_definition

TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"


def ros2_channel(topic: str, kind: str, *, static: bool = False) -> Channel:
    """Return the channel of a known type, as ROS 2 records it.

    Args:
        topic: Its name.
        kind: The type: "tf2_msgs/msg/TFMessage".
        static: Whether late subscribers get the last message too.

    Raises:
        InputError: If the type is not known.
    """
    metadata = (
        ("offered_qos_profiles", offers_text(static)),
        ("topic_type_hash", known_hash(kind)),
    )
    return Channel(topic, kind, "cdr", "ros2msg", ros2_definition(kind).encode(), metadata)
