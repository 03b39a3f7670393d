"""Channels of ROS 2 types, and conversion of messages between the encodings of ROS 1 and ROS 2."""

import re
from collections.abc import Callable
from typing import Final, NamedTuple

from tftool.base.errors import InputError
from tftool.messages.classes import INTERFACES, Interfaces, completed
from tftool.messages.codec import Codec, RecordedCodec
from tftool.messages.layouts import CDR, ROS1
from tftool.messages.schema import full_name
from tftool.recordings.channel import TRANSIENT_LOCAL, Channel, offers_of, offers_text
from tftool.recordings.schema_text import (
    known_hash,
    ros1_definition,
    ros1_md5,
    ros2_definition,
    same_layout,
    short,
)

_SEQUENCE: Final = re.compile(
    r"^(MSG: (?:std_msgs|roslib)/Header[ \t]*\n(?:(?!MSG: ).*\n)*?)uint32 seq[ \t]*(?:#.*)?\n",
    re.MULTILINE,
)
_TO_ROS2: Final = {"tf/msg/tfMessage": "tf2_msgs/msg/TFMessage"}


class Conversion(NamedTuple):
    """Conversion of a channel between ROS 1 and ROS 2.

    Attributes:
        channel: The channel after the conversion.
        payload: Function that converts the bytes of a message.
    """

    channel: Channel
    payload: Callable[[bytes], bytes]


def as_ros2(channel: Channel) -> Conversion:
    """Return the conversion of a ROS 1 channel to ROS 2.

    Raises:
        InputError: If the type is unknown, or the messages have another encoding.
    """
    if channel.encoding == "cdr":
        return Conversion(channel, bytes)
    full, interfaces = _known(channel, "ros1")
    kind = interfaces.message(full)
    target = _TO_ROS2.get(full, full)
    own = INTERFACES
    if target == full and not (INTERFACES.has(full) and same_layout(full, INTERFACES, interfaces)):
        own = interfaces
    metadata = {
        "offered_qos_profiles": offers_text(channel.extra("latching") == "1"),
        "topic_type_hash": known_hash(target) if own is INTERFACES else "",
    }
    if channel.extra("callerid"):
        metadata["callerid"] = channel.extra("callerid")
    written = Channel(
        channel.topic,
        target,
        "cdr",
        "ros2msg",
        ros2_definition(target, own).encode(),
        tuple(metadata.items()),
    )
    read, write = Codec(kind, ROS1), Codec(kind, CDR)
    return Conversion(written, lambda payload: write.encode(read.decode(payload)))


def as_ros1(channel: Channel) -> Conversion:
    """Return the conversion of a ROS 2 channel to ROS 1.

    Raises:
        InputError: If the type is unknown or has no equivalent in ROS 1, or the messages have
            another encoding.
    """
    if channel.encoding == "ros1":
        return Conversion(channel, bytes)
    full, interfaces = _known(channel, "cdr")
    kind = interfaces.message(full)
    write = Codec(kind, ROS1)
    metadata = {"md5sum": ros1_md5(full, interfaces)}
    if channel.extra("callerid"):
        metadata["callerid"] = channel.extra("callerid")
    if offers_of(channel.extra("offered_qos_profiles")).durability == TRANSIENT_LOCAL:
        metadata["latching"] = "1"
    written = Channel(
        channel.topic,
        short(full),
        "ros1",
        "ros1msg",
        ros1_definition(full, interfaces).encode(),
        tuple(metadata.items()),
    )
    if interfaces is INTERFACES:
        any_release = RecordedCodec(interfaces, full, CDR)
        return Conversion(
            written, lambda payload: write.encode(completed(any_release.decode(payload), kind))
        )
    read = Codec(kind, CDR)
    return Conversion(written, lambda payload: write.encode(read.decode(payload)))


def _known(channel: Channel, encoding: str) -> tuple[str, Interfaces]:
    """Return a channel's type, and the definitions needed to read its messages."""
    if channel.encoding != encoding:
        raise InputError(
            f"its messages are written as '{channel.encoding}', which is not converted here"
        )
    text = ""
    if channel.schema_encoding in ("ros1msg", "ros2msg"):
        text = channel.definition.decode("utf-8", "backslashreplace")
    full = full_name(channel.type)
    if not text.strip():
        INTERFACES.message(full)
        return full, INTERFACES
    if encoding == "ros1":
        # ROS 2's header has no sequence number, and the reader omits ROS 1's.
        text = _SEQUENCE.sub(r"\1", text)
    interfaces = Interfaces()
    interfaces.define(full, text)
    interfaces.message(full)
    return full, interfaces


TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"


def ros2_channel(topic: str, kind: str, *, static: bool = False) -> Channel:
    """Return a channel with a known type, as ROS 2 records it.

    Args:
        topic: Name of the topic.
        kind: Type of the messages: "tf2_msgs/msg/TFMessage".
        static: Whether late subscribers also get the last message.

    Raises:
        InputError: If the type is not known.
    """
    metadata = (
        ("offered_qos_profiles", offers_text(static)),
        ("topic_type_hash", known_hash(kind)),
    )
    return Channel(topic, kind, "cdr", "ros2msg", ros2_definition(kind).encode(), metadata)
