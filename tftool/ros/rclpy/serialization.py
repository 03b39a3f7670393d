"""rclpy.serialization: messages as ROS 2's bytes."""

from typing import Any

from tftool.messages.classes import Message
from tftool.messages.codec import codec


def serialize_message(message: Any) -> bytes:
    """Return the bytes of a message.

    Raises:
        TypeError: If it is no message.
    """
    if not isinstance(message, Message):
        raise TypeError(f"expected a message, got {type(message).__name__}")
    return codec(type(message)).encode(message)


def deserialize_message(serialized_message: bytes, message_type: Any) -> Any:
    """Return the message of some bytes.

    Raises:
        MalformedMessage: If they are not one of that type.
    """
    return codec(message_type).decode(bytes(serialized_message))
