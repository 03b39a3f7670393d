"""How one frame moves, seen from another: tf2's formula, and the plain twist beside it."""

import math
from dataclasses import dataclass
from typing import Protocol

from tftool.frames.sample import TransformStamped
from tftool.geometry import quaternions
from tftool.geometry.quaternions import Triple
from tftool.geometry.rigid import Transform, Vector3
from tftool.stamps import Duration, Stamp, as_seconds, seconds, whole


@dataclass(frozen=True, slots=True)
class Velocity:
    """A linear and an angular velocity.

    Attributes:
        stamp: The middle of the time it was taken over.
        frame: The frame the two vectors are given in.
        body: The frame that moves.
        linear: Metres per second.
        angular: Radians per second.
    """

    stamp: Stamp
    frame: str
    body: str
    linear: Vector3
    angular: Vector3


class Lookups(Protocol):
    """The two questions a velocity is worked out from."""

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Stamp = 0
    ) -> TransformStamped:
        """The pose of source in target."""

    def newest_common(self, target_frame: str, source_frame: str) -> Stamp:
        """The latest common time, 0 if there is none."""


def full(
    buffer: Lookups,
    tracking: str,
    observation: str,
    reference: str,
    point: Triple,
    point_frame: str,
    time: Stamp,
    interval: Duration,
) -> Velocity:
    """tf2's `lookup_velocity_full`, its formula to the letter, faults included.

    What it gives is a spatial twist where the reference does not turn against the tracked
    frame; where it does, tf2 turns the vectors by the wrong rotation, and it shifts to
    another point element by element instead of by a cross product. `twist` is right.

    Raises:
        TransformException: What the lookups it is worked out from are refused with.
        TypeError: If a moment or the interval is not a whole number.
    """
    # Times run through float seconds as they do in tf2, which rounds them the same way.
    at, over = as_seconds(whole(time)), as_seconds(whole(interval))
    end = min(at + over * 0.5, as_seconds(buffer.newest_common(observation, tracking)))
    start = max(0.00001 + over, end) - over
    duration = end - start
    first = buffer.lookup_transform(observation, tracking, seconds(start)).transform
    last = buffer.lookup_transform(observation, tracking, seconds(end)).transform
    v, w = _difference(first, last, duration)

    reference_from_body = buffer.lookup_transform(reference, tracking, time).transform
    origin = reference_from_body.translation
    w = quaternions.rotate(reference_from_body.rotation, w)
    v = _sum(quaternions.rotate(reference_from_body.rotation, v), _cross(origin, w))
    place = buffer.lookup_transform(reference, point_frame, time).transform.apply(point)
    shift = (place.x - origin.x, place.y - origin.y, place.z - origin.z)
    v = (v[0] + w[0] * shift[0], v[1] + w[1] * shift[1], v[2] + w[2] * shift[2])
    return Velocity(seconds(start + over * 0.5), reference, tracking, Vector3(*v), Vector3(*w))


def twist(
    buffer: Lookups, tracking: str, observation: str, time: Stamp, interval: Duration
) -> Velocity:
    """How the origin of `tracking` moves and how it turns, given in `observation`.

    The mean over `interval` around `time`, or over what part of it the buffer holds.

    Raises:
        TransformException: As the lookups of its two ends.
        TypeError: If a moment or the interval is not a whole number.
        ValueError: If the interval is not positive.
    """
    time, interval = whole(time), whole(interval)
    if interval <= 0:
        raise ValueError(f"a velocity wants a positive interval, not {interval} ns")
    newest = buffer.newest_common(observation, tracking)
    middle = time or newest
    end = min(middle + interval // 2, newest) if newest else middle + interval // 2
    start = max(1, end - interval)
    first = buffer.lookup_transform(observation, tracking, start).transform
    last = buffer.lookup_transform(observation, tracking, end).transform
    v, w = _difference(first, last, as_seconds(end - start))
    return Velocity((start + end) // 2, observation, tracking, Vector3(*v), Vector3(*w))


def _difference(first: Transform, last: Transform, duration: float) -> tuple[Triple, Triple]:
    """The mean velocities between two poses, in the frame they are given in."""
    if duration == 0.0:
        return (math.nan, math.nan, math.nan), (math.nan, math.nan, math.nan)
    a, b = first.translation, last.translation
    turn = quaternions.canonical(
        quaternions.multiply(quaternions.conjugate(first.rotation), last.rotation)
    )
    x, y, z, w = turn
    sine = math.sqrt(x * x + y * y + z * z)
    # Twice the arc cosine of w would lose half the digits of a small turn.
    rate = 2.0 * math.atan2(sine, w) / duration
    axis = (x / sine, y / sine, z / sine) if sine > 1e-150 else (1.0, 0.0, 0.0)
    wx, wy, wz = quaternions.rotate(first.rotation, axis)
    return (
        ((b.x - a.x) / duration, (b.y - a.y) / duration, (b.z - a.z) / duration),
        (wx * rate, wy * rate, wz * rate),
    )


def _cross(a: Triple, b: Triple) -> Triple:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _sum(a: Triple, b: Triple) -> Triple:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])
