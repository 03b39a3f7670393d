"""Between ROS 2's messages and the values our own nodes exchange.

Our simulator publishes `Pose2D`; a node of the tutorial subscribes `turtlesim.msg.Pose`.
A message type we have no value for travels as it is.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

from tftool import messages
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.interfaces.classes import INTERFACES, Message, as_float32, duplicate
from tftool.runtime.world import TransformMessage
from tftool.stamps import NANOSECONDS, Stamp

TF_TOPICS = ("tf", "tf_static")


@dataclass(frozen=True, slots=True)
class WholeTwist(messages.Twist2D):
    """A Twist that says more than a turtle reads."""

    message: Any = None


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
    name = kind.interface__.replace("turtlesim_msgs/", "turtlesim/")
    if name == "geometry_msgs/msg/Twist":
        return Converter(messages.Twist2D, _pack_twist, _unpack_twist)
    if name == "turtlesim/msg/Pose":
        return _by_fields(kind, messages.Pose2D)
    if name == "turtlesim/msg/Color":
        return _by_fields(kind, messages.Color)
    if name == "geometry_msgs/msg/PointStamped":
        return Converter(messages.PointStamped, _pack_point, _unpack_point)
    if name == "tf2_msgs/msg/TFMessage" and topic in TF_TOPICS:
        return Converter(TransformMessage, _pack_transforms, unpack_transforms)
    return Converter(kind, duplicate, duplicate)


def _by_fields(kind: type[Message], value_kind: type[Any]) -> Converter:
    names = [field.name for field in fields(value_kind)]
    single = {field.name for field in kind.fields__ if field.kind == "float32"}

    def pack(message: Any) -> Any:
        return value_kind(
            *(
                as_float32(getattr(message, name)) if name in single else getattr(message, name)
                for name in names
            )
        )

    def unpack(value: Any) -> Any:
        message = kind()
        for name in names:
            given = getattr(value, name)
            setattr(message, name, as_float32(float(given)) if name in single else given)
        return message

    return Converter(value_kind, pack, unpack)


def _pack_twist(message: Any) -> messages.Twist2D:
    linear, angular = message.linear, message.angular
    if linear.z or angular.x or angular.y:
        return WholeTwist(linear.x, angular.z, linear.y, duplicate(message))
    return messages.Twist2D(linear.x, angular.z, linear.y)


def _unpack_twist(value: messages.Twist2D) -> Any:
    if isinstance(value, WholeTwist):
        return duplicate(value.message)
    message: Any = INTERFACES.message("geometry_msgs/Twist")()
    message.linear.x = float(value.linear_x)
    message.linear.y = float(value.linear_y)
    message.angular.z = float(value.angular_z)
    return message


def stamp_of(message: Any) -> Stamp:
    """Nanoseconds of a builtin_interfaces Time or Duration."""
    return int(message.sec) * NANOSECONDS + int(message.nanosec)


def time_message(stamp: Stamp, kind: str = "Time") -> Any:
    """A builtin_interfaces Time (or Duration) of so many nanoseconds."""
    seconds, rest = divmod(stamp, NANOSECONDS)
    return INTERFACES.message(f"builtin_interfaces/{kind}")(sec=seconds, nanosec=rest)


def _pack_point(message: Any) -> messages.PointStamped:
    header, point = message.header, message.point
    return messages.PointStamped(stamp_of(header.stamp), header.frame_id, point.x, point.y, point.z)


def _unpack_point(value: messages.PointStamped) -> Any:
    message: Any = INTERFACES.message("geometry_msgs/PointStamped")()
    message.header.stamp = time_message(value.stamp)
    message.header.frame_id = value.frame_id
    message.point.x, message.point.y, message.point.z = value.x, value.y, value.z
    return message


def pack_transform(message: Any) -> TransformStamped:
    """Our sample of a geometry_msgs TransformStamped; a leading slash of a name is dropped."""
    moved, turned = message.transform.translation, message.transform.rotation
    return TransformStamped(
        stamp_of(message.header.stamp),
        message.header.frame_id,
        message.child_frame_id,
        Transform((moved.x, moved.y, moved.z), (turned.x, turned.y, turned.z, turned.w)),
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

_SERVICES: dict[str, tuple[type[Any], type[Any] | None]] = {
    "turtlesim/srv/Spawn": (messages.Spawn, messages.Spawned),
    "turtlesim/srv/Kill": (messages.Kill, None),
    "turtlesim/srv/SetPen": (messages.SetPen, None),
    "turtlesim/srv/TeleportAbsolute": (messages.TeleportAbsolute, None),
    "turtlesim/srv/TeleportRelative": (messages.TeleportRelative, None),
}
_EMPTY = {"clear": messages.Clear, "reset": messages.Reset}
_ACTIONS: dict[str, dict[str, type[Any]]] = {
    "turtlesim/action/RotateAbsolute": {
        "Goal": messages.RotateAbsolute,
        "Feedback": messages.Rotating,
        "Result": messages.Rotated,
    }
}


def _known(kind: Any) -> str:
    return str(kind.interface__).replace("turtlesim_msgs/", "turtlesim/")


def pack_request(kind: type[Any], service: str, request: Any) -> Any:
    """A service's request as our own servers take it; others get a copy."""
    known = _SERVICES.get(_known(kind))
    if known is not None:
        return _packed(request, known[0])
    if _known(kind) == "std_srvs/srv/Empty" and service.rpartition("/")[2] in _EMPTY:
        return _EMPTY[service.rpartition("/")[2]]()
    return duplicate(request)


def unpack_request(kind: Any, request: Any) -> Any:
    """The ROS 2 request of a service's class that one of our own nodes sent."""
    return _unpacked(request, kind.Request)


def pack_response(kind: type[Any], response: Any, *, ours: bool) -> Any:
    """A response as the asking side takes it."""
    known = _SERVICES.get(_known(kind))
    if not ours or known is None:
        return duplicate(response)
    return None if known[1] is None else _packed(response, known[1])


def unpack_response(kind: Any, response: Any) -> Any:
    """The ROS 2 response of a service's class."""
    return _unpacked(response, kind.Response)


def pack_part(kind: type[Any], part: str, message: Any) -> Any:
    """A part ("Goal", "Feedback", "Result") of an action as our own nodes take it."""
    known = _ACTIONS.get(_known(kind))
    return duplicate(message) if known is None else _packed(message, known[part])


def unpack_part(kind: Any, part: str, value: Any) -> Any:
    """The ROS 2 message of a part of an action."""
    return _unpacked(value, getattr(kind, part))


def _packed(message: Any, value_kind: type[Any]) -> Any:
    copy = duplicate(message)
    return value_kind(**{field.name: getattr(copy, field.name) for field in fields(value_kind)})


def _unpacked(value: Any, kind: Any) -> Any:
    if isinstance(value, Message):
        return duplicate(value)
    message = kind()
    for field in kind.fields__:
        if value is not None and hasattr(value, field.name):
            given = getattr(value, field.name)
            setattr(message, field.name, float(given) if field.kind == "float32" else given)
    return message
