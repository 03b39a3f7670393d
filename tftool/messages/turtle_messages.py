"""The small frozen values of our nodes as ROS messages, and back.

Topics, services and actions carry messages of their ROS type. Nodes of ours say `Pose2D` and
`Spawn` instead; the doors of `world/doors.py` convert by what stands here, and nothing else
does. Values have the fields of their messages under the same names, but for two that are
converted by hand. Numbers pass as they are: fields of 32 bits round on the wire.
"""

from collections.abc import Callable
from dataclasses import fields
from typing import Any, Final

from tftool.base.stamps import NANOSECONDS
from tftool.geometry.motion.twist import Twist2D
from tftool.messages.classes import INTERFACES, Message, duplicate
from tftool.messages.turtle_values import (
    Clear,
    Color,
    Kill,
    PointStamped,
    Pose2D,
    Reset,
    RotateAbsolute,
    Rotated,
    Rotating,
    SetPen,
    Spawn,
    Spawned,
    TeleportAbsolute,
    TeleportRelative,
)

TOPICS: Final[tuple[type[Any], ...]] = (Pose2D, Color, Twist2D, PointStamped)
"""Values that travel on topics; each names its message by `interface__`."""

SERVICES: Final[dict[type[Any], tuple[str, type[Any] | None]]] = {
    Spawn: ("turtlesim/srv/Spawn", Spawned),
    Kill: ("turtlesim/srv/Kill", None),
    Clear: ("std_srvs/srv/Empty", None),
    Reset: ("std_srvs/srv/Empty", None),
    SetPen: ("turtlesim/srv/SetPen", None),
    TeleportAbsolute: ("turtlesim/srv/TeleportAbsolute", None),
    TeleportRelative: ("turtlesim/srv/TeleportRelative", None),
}
"""The service of each request, and what its answer is; None for one that says nothing."""

ACTIONS: Final[dict[type[Any], tuple[str, type[Any], type[Any]]]] = {
    RotateAbsolute: ("turtlesim/action/RotateAbsolute", Rotated, Rotating),
}
"""The action of each goal, its result and its feedback."""


def message_class(kind: type[Any]) -> type[Any]:
    """What a topic carries for those who name a type: a value's message, else the type itself."""
    return INTERFACES.message(kind.interface__) if kind in TOPICS else kind


def interface_class(kind: Any) -> Any:
    """The ROS class of a service or an action, for the value that is asked; else `kind` itself."""
    known = SERVICES.get(kind) or ACTIONS.get(kind)
    return kind if known is None else INTERFACES.find(*known[0].split("/"))


def interface_name(kind: Any) -> str:
    """The ROS name of what a topic carries, or of what answers; "" for what is nothing to ROS."""
    return str(getattr(kind, "interface__", ""))


def as_value(message: Any, kind: type[Any] | None) -> Any:
    """The value of a type that says the same as a message; None for None."""
    if kind is None:
        return None
    by_hand = _BY_HAND.get(kind)
    if by_hand is not None:
        return by_hand[0](message)
    return kind(*[getattr(message, field.name) for field in fields(kind)])


def as_message(value: Any, kind: type[Message]) -> Any:
    """The message of a class that says the same as a value; None says nothing."""
    if isinstance(value, Message):
        return value
    return kind() if value is None else packer(type(value), kind)(value)


def packer(value_kind: type[Any], kind: type[Message]) -> Callable[[Any], Any]:
    """What makes messages of a class out of values of a type."""
    by_hand = _BY_HAND.get(value_kind)
    if by_hand is not None:
        return by_hand[1]
    new = object.__new__
    names = [(field.name, f"_{field.name}") for field in kind.fields__]

    # Unchecked, as the values are: what reads or encodes a message judges it.
    def pack(value: Any) -> Any:
        message = new(kind)
        for name, slot in names:
            setattr(message, slot, getattr(value, name))
        return message

    return pack


def recast(message: Any, kind: type[Message]) -> Any:
    """A copy of a message, as one of a class of the same fields: another release's, say."""
    copy = duplicate(message)
    if type(copy) is kind:
        return copy
    same = object.__new__(kind)
    for field in kind.fields__:
        setattr(same, f"_{field.name}", getattr(copy, f"_{field.name}"))
    return same


def is_part(asked: Any, part: str, kind: Any) -> bool:
    """Whether a message or a value is the request, or the goal, of a service's or action's class.

    Args:
        asked: The message or value.
        part: "Request" or "Goal".
        kind: The class.
    """
    known = SERVICES.get(type(asked)) or ACTIONS.get(type(asked))
    if known is not None:
        return plain_name(known[0]) == plain_name(kind.interface__)
    return isinstance(asked, Message) and plain_name(asked.interface__) == plain_name(
        f"{kind.interface__}_{part}"
    )


def plain_name(ros_type: str) -> str:
    """A type's name, the same for turtlesim's types of every release."""
    # Newer ROS 2 releases moved turtlesim's interfaces to a package of their own.
    return ros_type.replace("turtlesim_msgs/", "turtlesim/")


def _twist_value(message: Any) -> Twist2D:
    linear, angular = message.linear, message.angular
    return Twist2D(linear.x, angular.z, linear.y)


def _twist_message(value: Twist2D) -> Any:
    message: Any = INTERFACES.message(Twist2D.interface__)()
    message.linear.x = float(value.linear_x)
    message.linear.y = float(value.linear_y)
    message.angular.z = float(value.angular_z)
    return message


def _point_value(message: Any) -> PointStamped:
    stamp, point = message.header.stamp, message.point
    moment = stamp.sec * NANOSECONDS + stamp.nanosec
    return PointStamped(moment, message.header.frame_id, point.x, point.y, point.z)


def _point_message(value: PointStamped) -> Any:
    message: Any = INTERFACES.message(PointStamped.interface__)()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(value.stamp, NANOSECONDS)
    message.header.frame_id = value.frame_id
    message.point.x, message.point.y, message.point.z = value.x, value.y, value.z
    return message


_BY_HAND: Final[dict[type[Any], tuple[Callable[[Any], Any], Callable[[Any], Any]]]] = {
    Twist2D: (_twist_value, _twist_message),
    PointStamped: (_point_value, _point_message),
}
