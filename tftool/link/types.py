"""Our values as ROS messages and back: one entry for every type a link carries."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from tftool.errors import MalformedMessage
from tftool.link.cdr import Layout
from tftool.messages import (
    Clear,
    Color,
    Kill,
    Pose2D,
    Reset,
    SetPen,
    Spawn,
    Spawned,
    TeleportAbsolute,
    TeleportRelative,
    Twist2D,
)

TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"


@dataclass(frozen=True, slots=True)
class MessageType:
    """How one of our values travels.

    Attributes:
        ros_type: The type's ROS name.
        layout: Its bytes.
        pack: Our value to the layout's fields.
        unpack: The layout's fields to our value.
    """

    ros_type: str
    layout: Layout
    pack: Callable[[Any], tuple[Any, ...]]
    unpack: Callable[..., Any]

    def encode(self, value: Any) -> bytes:
        """The bytes of `value`.

        Raises:
            MalformedMessage: If it does not fit.
        """
        return self.layout.encode(self.pack(value))

    def decode(self, payload: bytes) -> Any:
        """The value of some bytes.

        Raises:
            MalformedMessage: If they are not one.
        """
        return self.unpack(*self.layout.decode(payload))


@dataclass(frozen=True, slots=True)
class ServiceType:
    """A service: what is asked and what is answered."""

    ros_type: str
    request: MessageType
    response: MessageType


def _twist(value: Twist2D) -> tuple[float, ...]:
    return value.linear_x, value.linear_y, 0.0, 0.0, 0.0, value.angular_z


MESSAGES: Final = {
    Pose2D: MessageType(
        "turtlesim/msg/Pose",
        Layout("turtlesim/msg/Pose", "fffff"),
        lambda pose: (pose.x, pose.y, pose.theta, pose.linear_velocity, pose.angular_velocity),
        Pose2D,
    ),
    Color: MessageType(
        "turtlesim/msg/Color",
        Layout("turtlesim/msg/Color", "BBB"),
        lambda color: (color.r, color.g, color.b),
        Color,
    ),
    Twist2D: MessageType(
        "geometry_msgs/msg/Twist",
        Layout("geometry_msgs/msg/Twist", "dddddd"),
        _twist,
        lambda x, y, _z, _roll, _pitch, yaw: Twist2D(x, yaw, y),
    ),
}
"""Types of topics, by the type of our value."""

BY_ROS_TYPE: Final = {kind.ros_type: (value, kind) for value, kind in MESSAGES.items()}


def _service(
    ros_type: str, request: type, fields: str, names: str, answer: type | None = None
) -> ServiceType:
    asked = names.split()
    return ServiceType(
        ros_type,
        MessageType(
            ros_type,
            Layout(f"{ros_type}_Request", fields),
            lambda value: tuple(getattr(value, name) for name in asked),
            request,
        ),
        MessageType(
            ros_type,
            Layout(f"{ros_type}_Response", "s" if answer else ""),
            (lambda value: (value.name,)) if answer else (lambda value: ()),
            answer or (lambda: None),
        ),
    )


SERVICES: Final = {
    "spawn": _service("turtlesim/srv/Spawn", Spawn, "fffs", "x y theta name", Spawned),
    "kill": _service("turtlesim/srv/Kill", Kill, "s", "name"),
    "clear": _service("std_srvs/srv/Empty", Clear, "", ""),
    "reset": _service("std_srvs/srv/Empty", Reset, "", ""),
    "teleport_absolute": _service(
        "turtlesim/srv/TeleportAbsolute", TeleportAbsolute, "fff", "x y theta"
    ),
    "teleport_relative": _service(
        "turtlesim/srv/TeleportRelative", TeleportRelative, "ff", "linear angular"
    ),
    "set_pen": _service("turtlesim/srv/SetPen", SetPen, "BBBBB", "r g b width off"),
}
"""Types of services, by the last part of their name."""


def service_type(name: str) -> ServiceType | None:
    """The type of a service, known by the last part of its name; None for a strange one."""
    return SERVICES.get(name.rpartition("/")[2])


# The rotate action: three services and two topics.

ROTATE: Final = "turtlesim/action/RotateAbsolute"
SEND_GOAL: Final = f"{ROTATE}_SendGoal"
GET_RESULT: Final = f"{ROTATE}_GetResult"
FEEDBACK: Final = f"{ROTATE}_FeedbackMessage"
CANCEL_GOAL: Final = "action_msgs/srv/CancelGoal"
STATUS: Final = "action_msgs/msg/GoalStatusArray"

SEND_GOAL_REQUEST: Final = Layout(f"{SEND_GOAL}_Request", "uf")
SEND_GOAL_RESPONSE: Final = Layout(f"{SEND_GOAL}_Response", "?iI")
GET_RESULT_REQUEST: Final = Layout(f"{GET_RESULT}_Request", "u")
GET_RESULT_RESPONSE: Final = Layout(f"{GET_RESULT}_Response", "bf")
FEEDBACK_MESSAGE: Final = Layout(FEEDBACK, "uf")
CANCEL_REQUEST: Final = Layout(f"{CANCEL_GOAL}_Request", "uiI")
CANCEL_RESPONSE: Final = Layout(f"{CANCEL_GOAL}_Response", "b[uiI]")
STATUS_MESSAGE: Final = Layout(STATUS, "[uiIb]")

ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = 1, 2, 3, 4, 5, 6
STATUS_NUMBERS: Final = {"succeeded": SUCCEEDED, "canceled": CANCELED, "aborted": ABORTED}
STATUS_NAMES: Final = {number: name for name, number in STATUS_NUMBERS.items()}


# Parameters: what a turtlesim is asked for its background.

PARAMETER_FIELDS: Final = "B?qds[B][?][q][d][s]"
GET_PARAMETERS_REQUEST: Final = Layout("rcl_interfaces/srv/GetParameters_Request", "[s]")
GET_PARAMETERS_RESPONSE: Final = Layout(
    "rcl_interfaces/srv/GetParameters_Response", f"[{PARAMETER_FIELDS}]"
)
SET_PARAMETERS_REQUEST: Final = Layout(
    "rcl_interfaces/srv/SetParameters_Request", f"[s{PARAMETER_FIELDS}]"
)
SET_PARAMETERS_RESPONSE: Final = Layout("rcl_interfaces/srv/SetParameters_Response", "[?s]")

_NOTHING = (0, False, 0, 0.0, "", (), (), (), (), ())
_PLACES = {bool: (1, 1), int: (2, 2), float: (3, 3), str: (4, 4)}


def parameter_fields(value: bool | int | float | str | None) -> tuple[Any, ...]:
    """A setting as the fields of rcl_interfaces/ParameterValue; None is "not set"."""
    if value is None:
        return _NOTHING
    kind, place = _PLACES[type(value)]
    fields = list(_NOTHING)
    fields[0], fields[place] = kind, value
    return tuple(fields)


def parameter_value(fields: tuple[Any, ...]) -> bool | int | float | str:
    """The setting that the fields of rcl_interfaces/ParameterValue tell.

    Raises:
        MalformedMessage: If it is a list or nothing: no setting of ours is one.
    """
    for kind, place in _PLACES.values():
        if fields[0] == kind:
            value: bool | int | float | str = fields[place]
            return value
    raise MalformedMessage(
        "rcl_interfaces/msg/ParameterValue",
        f"type {fields[0]} is none of bool, integer, double and string",
    )
