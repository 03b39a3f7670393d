"""Between ROS 2's messages and the values our own nodes exchange.

Our simulator publishes `Pose2D`; a node of the tutorial subscribes `turtlesim.msg.Pose`.
A message type we have no value for travels as it is.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from tftool.errors import TftoolError
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import transform
from tftool.interfaces.classes import INTERFACES, Message, duplicate
from tftool.link import types
from tftool.runtime.offers import Offer
from tftool.runtime.world import TransformMessage
from tftool.stamps import NANOSECONDS, Stamp

TF_TOPICS = ("tf", "tf_static")


@dataclass(frozen=True, slots=True)
class Converter:
    """How one message type travels.

    Attributes:
        kind: The type the world's topic carries.
        pack: From a message to that; the message is not kept.
        unpack: From that to a new message.
    """

    kind: type[Any]
    pack: Callable[[Any], Any]
    unpack: Callable[[Any], Any]


def converter(kind: type[Message], topic: str) -> Converter:
    """How messages of a class travel on a topic (full name)."""
    name = types.plain_name(kind.interface__)
    if name == types.TRANSFORMS and topic in TF_TOPICS:
        return Converter(TransformMessage, _pack_transforms, unpack_transforms)
    for value, ros_type in types.VALUES.items():
        if name == ros_type:
            # By way of a copy, whose 32-bit fields are rounded.
            return Converter(
                value,
                partial(_as_value, kind=value),
                partial(types.as_message, kind=kind),
            )
    return Converter(kind, duplicate, duplicate)


def _as_value(message: Any, kind: type[Any]) -> Any:
    return types.as_value(duplicate(message), kind)


def stamp_of(message: Any) -> Stamp:
    """Nanoseconds of a builtin_interfaces Time or Duration."""
    return int(message.sec) * NANOSECONDS + int(message.nanosec)


def time_message(stamp: Stamp, kind: str = "Time") -> Any:
    """A builtin_interfaces Time (or Duration) of so many nanoseconds."""
    seconds, rest = divmod(stamp, NANOSECONDS)
    return INTERFACES.message(f"builtin_interfaces/{kind}")(sec=seconds, nanosec=rest)


def pack_transform(message: Any) -> TransformStamped:
    """Our sample of a geometry_msgs TransformStamped; a leading slash of a name is dropped."""
    moved, turned = message.transform.translation, message.transform.rotation
    return TransformStamped(
        stamp_of(message.header.stamp),
        message.header.frame_id,
        message.child_frame_id,
        # Unchecked: a rotation of all zeros is refused by the buffer, in tf2's words.
        transform((moved.x, moved.y, moved.z), (turned.x, turned.y, turned.z, turned.w)),
    )


def unpack_transform(sample: TransformStamped) -> Any:
    """The geometry_msgs TransformStamped of a sample."""
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
    """The tf2_msgs TFMessage of what travels on `tf`."""
    kind = INTERFACES.message("tf2_msgs/TFMessage")
    return kind(transforms=[unpack_transform(one) for one in value.transforms])


# Services and actions


def pack_request(offer: Offer[Any], request: Any) -> Any:
    """A request or a goal, a message, as the server takes it.

    Raises:
        TftoolError: If it is of another type.
    """
    known = type_of(offer.kind)
    given = request.interface__.rpartition("_")[0]
    if known and types.plain_name(given) != types.plain_name(known):
        raise TftoolError(f"what is asked is of type {known}, the question of type {given}")
    is_ours = offer.kind in types.SERVICES or offer.kind in types.ACTIONS
    return _as_value(request, offer.kind) if is_ours else duplicate(request)


def unpack(value: Any, kind: type[Message]) -> Any:
    """A part of a service or an action as a message of a class; None says nothing."""
    return duplicate(value) if isinstance(value, Message) else types.as_message(value, kind)


def answer(request: Any, response: Any) -> Any:
    """A response, a message, as the client that sent the request expects it."""
    copy = duplicate(response)
    return copy if isinstance(request, Message) else types.answer_to(request, copy)


def type_of(kind: Any) -> str:
    """The ROS type of what answers a service or takes goals; "" where it is not said."""
    if isinstance(kind, str):
        return kind
    if kind in types.SERVICES:
        return types.SERVICES[kind][0]
    if kind in types.ACTIONS:
        return types.ACTIONS[kind][0]
    return str(getattr(kind, "interface__", ""))
