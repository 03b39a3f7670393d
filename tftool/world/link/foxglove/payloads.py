"""Types and payloads of a server's channels in ROS 2's form: CDR, ROS 1, foxglove's own."""

import re
from collections.abc import Callable
from typing import Final, NamedTuple

from tftool.base.errors import InputError, MalformedMessage
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.codec import Codec
from tftool.messages.schema import full_name
from tftool.messages.transforms import encode_transforms
from tftool.recordings.channel import Channel
from tftool.recordings.foreign_transforms import Decoder, decoder_of, is_foreign
from tftool.recordings.message_conversion import as_ros2
from tftool.recordings.schema_text import same_layout, short
from tftool.world.link.foxglove.protocol import FoxgloveChannel

TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"

LARGEST_FOREIGN: Final = 2 * 1024 * 1024
"""Bytes of the largest message of foxglove's own: every second byte may become a transform."""

_PARTS: Final = re.compile(r"^MSG: *(\S+)", re.MULTILINE)
_ROS1_TRANSFORMS: Final = "tf/msg/tfMessage"


class RosTopic(NamedTuple):
    """A channel as a ROS 2 topic.

    Attributes:
        name: The topic without a leading slash.
        type: Type, "sensor_msgs/msg/LaserScan"; the server's name if ROS has none.
    """

    name: str
    type: str


def ros_topic(channel: FoxgloveChannel) -> RosTopic:
    """Return the topic and type for a channel.

    Foxglove reads its own transforms from any topic, so each such channel is a publisher of `tf`,
    or of `tf_static` if its name ends so.
    """
    name = channel.topic.strip("/")
    if _is_foreign(channel):
        is_static = name.rpartition("/")[2] == "tf_static"
        return RosTopic("tf_static" if is_static else "tf", TRANSFORMS)
    if channel.encoding not in ("cdr", "ros1"):
        return RosTopic(name, channel.type)
    try:
        full = full_name(channel.type)
    except InputError:
        return RosTopic(name, channel.type)
    return RosTopic(name, TRANSFORMS if full == _ROS1_TRANSFORMS else full)


def _is_foreign(channel: FoxgloveChannel) -> bool:
    return channel.encoding in ("protobuf", "json") and is_foreign(channel.type, channel.encoding)


def define(channel: FoxgloveChannel) -> bool:
    """Register a channel's type by its definition, if unknown; return whether it was.

    A definition that changes types we know is not taken over.

    Raises:
        InputError: If the definition is wrong.
    """
    full = ros_topic(channel).type
    if channel.encoding != "cdr" or channel.schema_encoding != "ros2msg" or not channel.definition:
        return False
    if INTERFACES.has(full):
        return False
    # Structures that were read before can no longer be defined otherwise.
    for name in _PARTS.findall(channel.definition):
        if INTERFACES.has(full_name(name)):
            INTERFACES.structure(full_name(name))
    return INTERFACES.define(full, channel.definition)


def conversion(channel: FoxgloveChannel) -> Callable[[bytes], bytes]:
    """Return the conversion of a channel's payloads to CDR, by known definitions.

    Raises:
        InputError: If there is none, as a part of a sentence.
        MalformedMessage: If the type cannot be read.
    """
    if _is_foreign(channel):
        decode = decoder_of(channel.type, channel.encoding, "", channel.topic)
        assert decode is not None
        return _foreign(decode)
    if channel.encoding not in ("cdr", "ros1"):
        raise InputError(f"its messages are written as '{channel.encoding}'")
    theirs = _definitions(channel)
    if channel.encoding == "cdr":
        full = ros_topic(channel).type
        if theirs is not None and not same_layout(full, INTERFACES, theirs):
            raise InputError(f"the server has another definition of {short(full)} than tftool")
        return bytes
    definition = channel.definition.encode("utf-8", "backslashreplace")
    stream = Channel(channel.topic, channel.type, "ros1", "ros1msg", definition)
    return as_ros2(stream).payload


def _definitions(channel: FoxgloveChannel) -> Interfaces | None:
    """Return the server's definitions of a channel's type; None if it gives none.

    Raises:
        InputError: If definitions are wrong, contain themselves or have too many fields.
    """
    if channel.schema_encoding not in ("ros1msg", "ros2msg") or not channel.definition.strip():
        return None
    theirs = Interfaces()
    full = full_name(channel.type)
    theirs.define(full, channel.definition)
    # A codec counts fields first: to compare layouts would take for ever with a hostile one.
    Codec(theirs.message(full))
    return theirs


def _foreign(decode: Decoder) -> Callable[[bytes], bytes]:
    def converted(payload: bytes) -> bytes:
        if len(payload) > LARGEST_FOREIGN:
            raise MalformedMessage(
                "foxglove.FrameTransforms",
                f"{len(payload)} bytes are more than we read ({LARGEST_FOREIGN})",
            )
        return encode_transforms(
            [
                TransformStamped(
                    one.stamp,
                    one.parent,
                    one.child,
                    Transform(Vector3(*one.numbers[:3]), Quaternion(*one.numbers[3:])),
                )
                for one in decode(payload)
            ]
        )

    return converted
