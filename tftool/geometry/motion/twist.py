"""A velocity in the plane."""

from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True, slots=True)
class Twist2D:
    """A velocity command in the plane (the three fields of Twist that turtlesim reads)."""

    interface__: ClassVar[str] = "geometry_msgs/msg/Twist"

    linear_x: float = 0.0
    angular_z: float = 0.0
    linear_y: float = 0.0
