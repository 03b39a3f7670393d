"""Velocity of a body in the plane."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Twist2D:
    """Velocity of a body in the plane: forward and leftward speed in m/s, turn rate in rad/s."""

    linear_x: float = 0.0
    angular_z: float = 0.0
    linear_y: float = 0.0
