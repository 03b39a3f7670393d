"""Conversion between the messages of users' programs and the values on tftool's topics.

Messages are copied in both directions. Messages of turtlesim from a newer ROS release are
converted to tftool's older version. The topics `tf` and `tf_static` carry tuples of transforms.
"""

from typing import Any

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import transform
from tftool.messages.classes import INTERFACES, Message, plain_name, recast
from tftool.world.world import TransformMessage

TF_TOPICS = ("tf", "tf_static")


def topic_class(message_class: type[Message], topic: str) -> type[Any]:
    """Return tftool's class for the values on a topic whose messages have the given class."""
    if message_class.interface__ == TransformMessage.interface__ and topic in TF_TOPICS:
        return TransformMessage
    plain = plain_name(message_class.interface__)
    return message_class if plain == message_class.interface__ else INTERFACES.message(plain)


def pack(message: Any, value_class: type[Any]) -> Any:
    """Copy a user's message to a new value of the class `value_class`, for a topic of tftool."""
    if value_class is TransformMessage:
        return TransformMessage(tuple(map(pack_transform, message.transforms)), "")
    return recast(message, value_class)


def unpack(value: Any, message_class: type[Message]) -> Any:
    """Convert a value of tftool to a new message of the class `message_class`.

    The value comes from a topic, a service or an action. None gives a message with default values.
    """
    if isinstance(value, TransformMessage):
        return unpack_transforms(value)
    return message_class() if value is None else recast(value, message_class)


def stamp_of(message: Any) -> Stamp:
    """Return the nanoseconds in a builtin_interfaces Time or Duration message."""
    return int(message.sec) * NANOSECONDS + int(message.nanosec)


def time_message(stamp: Stamp, kind: str = "Time") -> Any:
    """Return a builtin_interfaces message with `stamp` nanoseconds.

    The message is a Duration if `kind` is "Duration".
    """
    seconds, rest = divmod(stamp, NANOSECONDS)
    return INTERFACES.message(f"builtin_interfaces/{kind}")(sec=seconds, nanosec=rest)


def pack_transform(message: Any) -> TransformStamped:
    """Convert a geometry_msgs TransformStamped message to tftool's TransformStamped."""
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


def unpack_transforms(value: TransformMessage) -> Any:
    """Convert a value of the topic `tf` or `tf_static` to a tf2_msgs TFMessage."""
    kind = INTERFACES.message("tf2_msgs/TFMessage")
    return kind(transforms=[unpack_transform(one) for one in value.transforms])
