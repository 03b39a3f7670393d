"""Conversions between transforms and x, y, heading."""

import math

from tftool.geometry import rigid
from tftool.geometry.rigid import Transform


def transform_from_pose(x: float, y: float, heading: float) -> Transform:
    """Return the transform of a pose in the plane, turned by `heading` radians about z."""
    half = 0.5 * heading
    return rigid.transform((float(x), float(y), 0.0), (0.0, 0.0, math.sin(half), math.cos(half)))


def heading(transform: Transform) -> float:
    """Return the yaw of a transform, radians from −π to π.

    The yaw belongs to roll, pitch, yaw. For a pose in the plane, it is the direction of the x axis.
    """
    x, y, z, w = transform.rotation
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


def bearing(transform: Transform) -> float:
    """Return the direction of the child frame's origin, radians in the plane; 0 at zero
    distance.
    """
    return math.atan2(transform.translation.y, transform.translation.x)


def distance(transform: Transform) -> float:
    """Return the distance of the child frame's origin in the plane, metres."""
    return math.hypot(transform.translation.x, transform.translation.y)


def wrap(angle: float) -> float:
    """Wrap an angle to [−π, π)."""
    # A step of 2π leaves rounding; the two bounds are met exactly when they are given.
    if -math.pi <= angle < math.pi:
        return angle
    return (angle + math.pi) % math.tau - math.pi
