"""Our own values as ROS messages and back, and how whatever travels is turned into bytes.

The simulator publishes `Pose2D`; on the wire, and to code written for ROS 2, that is a
turtlesim/msg/Pose. Values have the fields of their messages under the same names, but
for a few that are converted by hand. Anything else that is a message travels as it is.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cache
from typing import Any, Final

from tftool.errors import MalformedMessage
from tftool.interfaces.classes import INTERFACES, Message, as_float32, duplicate
from tftool.messages import (
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
    Twist2D,
)
from tftool.runtime.world import TransformMessage
from tftool.stamps import NANOSECONDS
from tftool.wire.codec import codec

TRANSFORMS: Final = TransformMessage.interface__

VALUES: Final[dict[type[Any], str]] = {
    kind: kind.interface__ for kind in (Pose2D, Color, Twist2D, PointStamped)
}
"""The message type of each of our values that travels on topics."""

SERVICES: Final[dict[type[Any], tuple[str, type[Any] | None]]] = {
    Spawn: ("turtlesim/srv/Spawn", Spawned),
    Kill: ("turtlesim/srv/Kill", None),
    Clear: ("std_srvs/srv/Empty", None),
    Reset: ("std_srvs/srv/Empty", None),
    SetPen: ("turtlesim/srv/SetPen", None),
    TeleportAbsolute: ("turtlesim/srv/TeleportAbsolute", None),
    TeleportRelative: ("turtlesim/srv/TeleportRelative", None),
}
"""The service type of each of our requests, and the answer to it."""

ACTIONS: Final[dict[type[Any], tuple[str, type[Any], type[Any]]]] = {
    RotateAbsolute: ("turtlesim/action/RotateAbsolute", Rotated, Rotating),
}
"""The action type of each of our goals, its result and its feedback."""


@dataclass(frozen=True, slots=True)
class WholeTwist(Twist2D):
    """A Twist that says more than a turtle reads."""

    message: Any = None


# Values and messages


def as_value(message: Any, kind: type[Any]) -> Any:
    """Our value that says the same as a message."""
    by_hand = _BY_HAND.get(kind)
    if by_hand is not None:
        return by_hand[0](message)
    if kind is type(None):
        return None
    return kind(**{field.name: getattr(message, field.name) for field in fields(kind)})


def as_message(value: Any, kind: type[Message]) -> Any:
    """The message of a class that says the same as one of our values; None says nothing."""
    by_hand = _BY_HAND.get(type(value))
    if by_hand is not None:
        return by_hand[1](value)
    message = kind()
    for field in kind.fields__:
        given = getattr(value, field.name, None)
        if given is not None:
            single = field.kind == "float32"
            setattr(message, field.name, as_float32(float(given)) if single else given)
    return message


def _twist_value(message: Any) -> Twist2D:
    linear, angular = message.linear, message.angular
    if linear.z or angular.x or angular.y:
        return WholeTwist(linear.x, angular.z, linear.y, duplicate(message))
    return Twist2D(linear.x, angular.z, linear.y)


def _twist_message(value: Twist2D) -> Any:
    if isinstance(value, WholeTwist):
        return duplicate(value.message)
    message: Any = INTERFACES.message(VALUES[Twist2D])()
    message.linear.x = float(value.linear_x)
    message.linear.y = float(value.linear_y)
    message.angular.z = float(value.angular_z)
    return message


def _point_value(message: Any) -> PointStamped:
    stamp, point = message.header.stamp, message.point
    moment = stamp.sec * NANOSECONDS + stamp.nanosec
    return PointStamped(moment, message.header.frame_id, point.x, point.y, point.z)


def _point_message(value: PointStamped) -> Any:
    message: Any = INTERFACES.message(VALUES[PointStamped])()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(value.stamp, NANOSECONDS)
    message.header.frame_id = value.frame_id
    message.point.x, message.point.y, message.point.z = value.x, value.y, value.z
    return message


_BY_HAND: Final[dict[type[Any], tuple[Callable[[Any], Any], Callable[[Any], Any]]]] = {
    Twist2D: (_twist_value, _twist_message),
    WholeTwist: (_twist_value, _twist_message),
    PointStamped: (_point_value, _point_message),
}


# What travels


@dataclass(frozen=True, slots=True)
class MessageType:
    """How what a topic carries, or a part of a service or an action, travels.

    Attributes:
        message: The message's class.
        value: Our type for it; None where the message itself is what is exchanged.
    """

    message: type[Message]
    value: type[Any] | None = None

    @property
    def ros_type(self) -> str:
        """The message's full name."""
        return self.message.interface__

    def sent(self, value: Any) -> Any:
        """The message of a value of ours, or the message that is given."""
        if isinstance(value, Message):
            return value
        try:
            return as_message(value, self.message)
        except AssertionError as error:
            raise MalformedMessage(self.ros_type, str(error)) from error

    def received(self, message: Any) -> Any:
        """Our value of a message, or the message itself."""
        return message if self.value is None else as_value(message, self.value)

    def encode(self, value: Any) -> bytes:
        """The bytes of a message, or of a value that stands for one.

        Raises:
            MalformedMessage: If it does not fit.
        """
        # A value with the fields of its message is written as if it were one.
        same_fields = value is not None and type(value) not in _BY_HAND
        return codec(self.message).encode(value if same_fields else self.sent(value))

    def decode(self, payload: bytes) -> Any:
        """What some bytes say.

        Raises:
            MalformedMessage: If they are not such a message.
        """
        return self.received(codec(self.message).decode(payload))


@dataclass(frozen=True, slots=True)
class ServiceType:
    """A service: what is asked and what is answered."""

    ros_type: str
    request: MessageType
    response: MessageType


@dataclass(frozen=True, slots=True)
class ActionType:
    """An action: the types of its three services and its feedback, and of what is in them."""

    ros_type: str
    goal: MessageType
    result: MessageType
    feedback: MessageType


@cache
def topic_type(kind: type[Any]) -> MessageType | None:
    """How the values of a topic travel; None for what stays inside the process.

    Raises:
        MalformedMessage: If it is a message whose bytes differ between ROS 2 releases.
    """
    if kind in VALUES:
        return MessageType(INTERFACES.message(VALUES[kind]), kind)
    if not issubclass(kind, Message):
        return None
    codec(kind)
    return MessageType(kind)


def topic_name(kind: type[Any]) -> str:
    """The ROS name of what a topic carries; "" for what is nothing to ROS."""
    return str(getattr(kind, "interface__", ""))


@cache
def service_type(kind: Any) -> ServiceType | None:
    """How a service travels, by the type of our request or by its ROS class; None if not at all."""
    if kind in SERVICES:
        ros_type, answer = SERVICES[kind]
        found = named_service(ros_type)
        return ServiceType(
            ros_type,
            MessageType(found.request.message, kind),
            MessageType(found.response.message, answer or type(None)),
        )
    return named_service(kind.interface__) if hasattr(kind, "Request") else None


@cache
def action_type(kind: Any) -> ActionType | None:
    """How an action travels, by the type of our goal or by its ROS class; None if not at all."""
    if kind in ACTIONS:
        return named_action(ACTIONS[kind][0], kind)
    return named_action(kind.interface__) if hasattr(kind, "Feedback") else None


def named_service(ros_type: str) -> ServiceType:
    """A service by its type's name, with messages for what is asked and answered.

    Raises:
        InputError: If there is none of that name.
    """
    request, response = (
        MessageType(INTERFACES.part(f"{ros_type}_{part}")) for part in ("Request", "Response")
    )
    return ServiceType(ros_type, request, response)


def named_action(ros_type: str, goal: type[Any] | None = None) -> ActionType:
    """An action by its type's name, in messages, or in our values for a goal of ours.

    Raises:
        InputError: If there is none of that name.
    """
    values = (None, None, None) if goal is None else (goal, *ACTIONS[goal][1:])
    parts = (
        MessageType(INTERFACES.part(f"{ros_type}_{part}"), value)
        for part, value in zip(("Goal", "Result", "Feedback"), values, strict=True)
    )
    return ActionType(ros_type, *parts)


def is_same(request: Any, kind: MessageType) -> bool:
    """Whether a request, a message or a value of ours, is of a service's type."""
    known = SERVICES.get(type(request))
    if known is not None:
        return plain_name(f"{known[0]}_Request") == plain_name(kind.ros_type)
    return isinstance(request, Message) and plain_name(request.interface__) == plain_name(
        kind.ros_type
    )


def is_goal_of(request: Any, ros_type: str) -> bool:
    """Whether a goal, a message or a value of ours, is of an action's type."""
    known = ACTIONS.get(type(request))
    if known is not None:
        return plain_name(known[0]) == plain_name(ros_type)
    return isinstance(request, Message) and plain_name(request.interface__) == plain_name(
        f"{ros_type}_Goal"
    )


def answer_to(request: Any, answer: Any) -> Any:
    """The answer, a message, as those expect it who asked with a request of ours."""
    kind = SERVICES[type(request)][1]
    return None if kind is None else as_value(answer, kind)


def plain_name(ros_type: str) -> str:
    """A type's name, the same for turtlesim's types of every release."""
    # Newer ROS 2 releases moved turtlesim's interfaces to a package of their own.
    return ros_type.replace("turtlesim_msgs/", "turtlesim/")
