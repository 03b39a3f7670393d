"""Frozen values that travel on topics, in services and in actions.

Metres, radians, seconds. `turtlesim`'s own message fields under their own names. What travels on
topics names its ROS type, as the classes of messages do: `interface__`.
"""

from dataclasses import dataclass
from typing import ClassVar, Final

from tftool.base.stamps import Stamp


@dataclass(frozen=True, slots=True)
class Pose2D:
    """Where a turtle is and how fast it moves (turtlesim/Pose; it carries no stamp)."""

    interface__: ClassVar[str] = "turtlesim/msg/Pose"

    x: float
    y: float
    theta: float
    linear_velocity: float = 0.0
    angular_velocity: float = 0.0


@dataclass(frozen=True, slots=True)
class Color:
    """A colour, each channel from 0 to 255."""

    interface__: ClassVar[str] = "turtlesim/msg/Color"

    r: int
    g: int
    b: int


BACKGROUND: Final = Color(69, 86, 255)
"""The field's colour unless parameters say otherwise."""


@dataclass(frozen=True, slots=True)
class KeyPress:
    """One key a person (or a script) pressed: "up", "left", "g", "q" and so on."""

    key: str


@dataclass(frozen=True, slots=True)
class PointStamped:
    """A point seen in a frame at a moment (geometry_msgs/PointStamped)."""

    interface__: ClassVar[str] = "geometry_msgs/msg/PointStamped"

    stamp: Stamp
    frame_id: str
    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True)
class Spawn:
    """Put a turtle into the field; an empty name lets the simulator choose. Answer: `Spawned`."""

    x: float
    y: float
    theta: float = 0.0
    name: str = ""


@dataclass(frozen=True, slots=True)
class Spawned:
    """The name of the new turtle; empty when there is none, because the name was refused."""

    name: str


@dataclass(frozen=True, slots=True)
class Kill:
    """Take a turtle out of the field; its trail stays. Answer: None."""

    name: str


@dataclass(frozen=True, slots=True)
class Clear:
    """Wipe all trails. Answer: None."""


@dataclass(frozen=True, slots=True)
class Reset:
    """Back to the start: one turtle at the centre, no trails. Answer: None."""


@dataclass(frozen=True, slots=True)
class TeleportAbsolute:
    """Put a turtle somewhere else. Answer: None."""

    x: float
    y: float
    theta: float = 0.0


@dataclass(frozen=True, slots=True)
class TeleportRelative:
    """Turn a turtle by `angular`, then put it `linear` metres ahead. Answer: None."""

    linear: float
    angular: float = 0.0


@dataclass(frozen=True, slots=True)
class SetPen:
    """Lift a turtle's pen (`off` other than 0), or put it down with a colour and width in pixels.

    Whole numbers from 0 to 255. Width 0 means one pixel. Answer: None.
    """

    r: int = 0
    g: int = 0
    b: int = 0
    width: int = 0
    off: int = 0


@dataclass(frozen=True, slots=True)
class RotateAbsolute:
    """Goal of the rotate action: the heading to turn to."""

    theta: float


@dataclass(frozen=True, slots=True)
class Rotating:
    """Feedback of the rotate action: the angle still to go."""

    remaining: float


@dataclass(frozen=True, slots=True)
class Rotated:
    """Result of the rotate action: heading at the start minus heading at the end."""

    delta: float
