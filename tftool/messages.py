"""Frozen values that travel on topics, in services and in actions.

Metres, radians, seconds. `turtlesim`'s own message fields under their own names.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Pose2D:
    """Where a turtle is and how fast it moves (turtlesim/Pose; it carries no stamp)."""

    x: float
    y: float
    theta: float
    linear_velocity: float = 0.0
    angular_velocity: float = 0.0


@dataclass(frozen=True, slots=True)
class Twist2D:
    """A velocity command in the plane (the three fields of Twist that turtlesim reads)."""

    linear_x: float = 0.0
    angular_z: float = 0.0
    linear_y: float = 0.0


@dataclass(frozen=True, slots=True)
class Color:
    """A colour, each channel from 0 to 255."""

    r: int
    g: int
    b: int


@dataclass(frozen=True, slots=True)
class KeyPress:
    """One key a person (or a script) pressed: "up", "left", "g", "q" and so on."""

    key: str
