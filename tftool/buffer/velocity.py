"""Velocity of one frame relative to another: tf2's formula, and the plain twist."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tftool.base.stamps import Duration, Stamp, as_seconds, seconds, whole
from tftool.geometry import conversions, quaternions
from tftool.geometry.quaternions import Triple
from tftool.geometry.rigid import Transform, Vector3

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer


@dataclass(frozen=True, slots=True)
class Velocity:
    """Linear and angular velocity of one frame relative to another.

    Attributes:
        stamp: Middle of the averaging interval, nanoseconds.
        frame: The frame in which both vectors are expressed.
        body: The frame that moves.
        linear: Metres per second.
        angular: Radians per second.
    """

    stamp: Stamp
    frame: str
    body: str
    linear: Vector3
    angular: Vector3


def full(
    buffer: "Buffer",
    tracking: str,
    observation: str,
    reference: str,
    point: Triple,
    point_frame: str,
    time: Stamp,
    interval: Duration,
) -> Velocity:
    """Return the velocity that tf2's `lookup_velocity_full` computes, with its known errors.

    The result is a spatial twist if the reference does not rotate relative to the tracked frame.
    Otherwise tf2 applies the wrong rotation to the vectors, and moves the reference point with an
    element-wise product instead of a cross product. `twist` has neither error.

    Raises:
        TransformException: If one of the lookups fails.
        TypeError: If the time or the interval is not a whole number.
    """
    # As in tf2, times are converted to float seconds, which rounds them.
    at, over = as_seconds(whole(time)), as_seconds(whole(interval))
    end = min(at + over * 0.5, as_seconds(buffer.newest_common(observation, tracking)))
    start = max(0.00001 + over, end) - over
    duration = end - start
    first = buffer.lookup_transform(observation, tracking, seconds(start)).transform
    last = buffer.lookup_transform(observation, tracking, seconds(end)).transform
    v, w = _difference(first, last, duration)

    reference_from_body = buffer.lookup_transform(reference, tracking, time).transform
    origin = reference_from_body.translation
    w = reference_from_body.rotate(w)
    v = reference_from_body.rotate(v) + origin.cross(w)
    place = buffer.lookup_transform(reference, point_frame, time).transform.apply(point)
    shift = place - origin
    v += Vector3(w.x * shift.x, w.y * shift.y, w.z * shift.z)
    return Velocity(seconds(start + over * 0.5), reference, tracking, v, w)


def twist(
    buffer: "Buffer", tracking: str, observation: str, time: Stamp, interval: Duration
) -> Velocity:
    """Return the linear velocity of `tracking`'s origin and its angular velocity, in `observation`.

    The result is the mean over `interval` around `time`, or over the part of the interval for which
    the buffer has data.

    Raises:
        TransformException: If a lookup at an end of the interval fails.
        TypeError: If the time or the interval is not a whole number.
        ValueError: If the interval is not positive.
    """
    time, interval = whole(time), whole(interval)
    if interval <= 0:
        raise ValueError(f"a velocity needs a positive interval, not {interval} ns")
    newest = buffer.newest_common(observation, tracking)
    middle = time or newest
    end = min(middle + interval // 2, newest) if newest else middle + interval // 2
    start = max(1, end - interval)
    first = buffer.lookup_transform(observation, tracking, start).transform
    last = buffer.lookup_transform(observation, tracking, end).transform
    v, w = _difference(first, last, as_seconds(end - start))
    return Velocity((start + end) // 2, observation, tracking, v, w)


def _difference(first: Transform, last: Transform, duration: float) -> tuple[Vector3, Vector3]:
    """Return the mean linear and angular velocity between two poses of a frame."""
    if duration == 0.0:
        unknown = Vector3(math.nan, math.nan, math.nan)
        return unknown, unknown
    turn = quaternions.multiply(quaternions.conjugate(first.rotation), last.rotation)
    axis, angle = conversions.axis_angle_from_quaternion(turn)
    return (
        (last.translation - first.translation) / duration,
        first.rotate(axis) * (angle / duration),
    )
