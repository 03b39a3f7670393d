"""Conversion between messages in users' programs and values on tftool's topics.

Messages are copied in both directions. turtlesim's messages of a newer release are converted to
the older one, which tftool uses. Topics of tf carry tuples of transforms.
"""

from typing import Any

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import transform
from tftool.messages.classes import INTERFACES, Message, plain_name, recast
from tftool.world.world import TransformMessage

TF_TOPICS = ("tf", "tf_static")


def carried(kind: type[Message], topic: str) -> type[Any]:
    """Return the class of the values on a topic of tftool for a user's message class `kind`."""
    if kind.interface__ == TransformMessage.interface__ and topic in TF_TOPICS:
        return TransformMessage
    plain = plain_name(kind.interface__)
    return kind if plain == kind.interface__ else INTERFACES.message(plain)


def pack(message: Any, kind: type[Any]) -> Any:
    """Copy a user's message to a value of class `kind`, for a topic of tftool."""
    return _pack_transforms(message) if kind is TransformMessage else recast(message, kind)


def unpack(value: Any, kind: type[Message]) -> Any:
    """Convert a value on a topic, service or action of tftool to a new message of class `kind`."""
    if isinstance(value, TransformMessage):
        return unpack_transforms(value)
    return kind() if value is None else recast(value, kind)


def stamp_of(message: Any) -> Stamp:
    """Return a builtin_interfaces Time or Duration message in nanoseconds."""
    return int(message.sec) * NANOSECONDS + int(message.nanosec)


def time_message(stamp: Stamp, kind: str = "Time") -> Any:
    """Return `stamp` nanoseconds as a builtin_interfaces Time or Duration message."""
    seconds, rest = divmod(stamp, NANOSECONDS)
    return INTERFACES.message(f"builtin_interfaces/{kind}")(sec=seconds, nanosec=rest)


def pack_transform(message: Any) -> TransformStamped:
    """Convert a TransformStamped message to tftool's class, without leading slashes in names."""
    moved, turned = message.transform.translation, message.transform.rotation
    return TransformStamped(
        stamp_of(message.header.stamp),
        message.header.frame_id,
        message.child_frame_id,
        # The rotation is not checked here: the buffer refuses a rotation of zeros with tf2's text.
        transform((moved.x, moved.y, moved.z), (turned.x, turned.y, turned.z, turned.w)),
    )


def unpack_transform(sample: TransformStamped) -> Any:
    """Convert tftool's TransformStamped to a geometry_msgs TransformStamped message."""
    message: Any = INTERFACES.message("geometry_msgs/TransformStamped")()
    message.header.stamp = time_message(sample.stamp)
    message.header.frame_id = sample.frame_id
    message.child_frame_id = sample.child_frame_id
    moved, turned = message.transform.translation, message.transform.rotation
    moved.x, moved.y, moved.z = sample.transform.translation
    turned.x, turned.y, turned.z, turned.w = sample.transform.rotation
    return message


def _pack_transforms(message: Any) -> TransformMessage:
    return TransformMessage(tuple(pack_transform(one) for one in message.transforms), "")


def unpack_transforms(value: TransformMessage) -> Any:
    """Convert a value of the topic `tf` to a tf2_msgs TFMessage."""
    kind = INTERFACES.message("tf2_msgs/TFMessage")
    return kind(transforms=[unpack_transform(one) for one in value.transforms])
