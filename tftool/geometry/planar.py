"""Conversions between transforms and poses in the plane: x, y and heading."""

import math

from tftool.geometry import rigid
from tftool.geometry.rigid import Transform


def transform_from_pose(x: float, y: float, heading: float) -> Transform:
    """Return the transform of a pose in the plane; `heading` is in radians about z."""
    half = 0.5 * heading
    return rigid.transform((float(x), float(y), 0.0), (0.0, 0.0, math.sin(half), math.cos(half)))


def heading(transform: Transform) -> float:
    """Return the yaw of a transform's rotation, radians from −π to π.

    For a pose in the plane, the yaw is the direction of the child's x axis.
    """
    x, y, z, w = transform.rotation
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


def bearing(transform: Transform) -> float:
    """Return the direction to the child frame's origin in the plane, radians; 0 at distance 0."""
    return math.atan2(transform.translation.y, transform.translation.x)


def distance(transform: Transform) -> float:
    """Return the distance to the child frame's origin in the plane, metres."""
    return math.hypot(transform.translation.x, transform.translation.y)


def wrap(angle: float) -> float:
    """Wrap an angle to the range [−π, π)."""
    # Adding 2π would round, so angles within the range are returned unchanged.
    if -math.pi <= angle < math.pi:
        return angle
    return (angle + math.pi) % math.tau - math.pi
