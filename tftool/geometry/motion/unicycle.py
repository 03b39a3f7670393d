"""Motion of one simulated turtle in each update: turn, move, stop at the wall.

The constants are exactly turtlesim's: with Python's π, or with a field edge in double precision,
the simulator would print other poses.
"""

import math
from array import array
from typing import Final, NamedTuple

from tftool.base.errors import UsageError
from tftool.base.stamps import Duration

PIXELS_PER_METRE: Final = 45
"""Pixels in one of turtlesim's metres: the height of the first turtle picture."""

WINDOW: Final = 500
"""Width and height of the drawing in pixels."""

FIELD: Final = 11.088889122009277
"""Edge of the field in metres: (500 - 1) / 45 as a 32-bit float."""

CENTRE: Final = FIELD / 2
"""Both start coordinates of the first turtle, metres."""

TICK: Final[Duration] = 16_000_000
"""Time between two updates, in nanoseconds."""

STEP: Final = 0.016
"""Time that each update simulates, seconds; the same even if the update runs late."""

COMMAND_TIMEOUT: Final[Duration] = 1_000_000_000
"""Age of a velocity command, nanoseconds, after which the turtle stops."""

PI: Final = 3.14159265
TWO_PI: Final = 6.2831853

ROTATION_SPEED: Final = 1.0
"""Turn rate of the rotate action, in rad/s."""

ROTATION_TOLERANCE: Final = 0.02
"""Remaining angle, rad, below which the rotate action is done."""

# For larger angles, rounding leaves no useful fraction in the quotient of `wrap`.
_FAR = 1e9
_LARGEST = 3.4028234663852886e38


class Placement(NamedTuple):
    """Pose of a turtle in the plane: x, y in metres, theta in radians counter-clockwise from +x."""

    x: float
    y: float
    theta: float


class Turning(NamedTuple):
    """Result of one update of the rotate action.

    Attributes:
        remaining: Remaining angle to the goal, the short way, in rad.
        delta: Start heading minus present heading, in rad: negative after a left turn, as in
            turtlesim.
        speed: Turn rate to use, in rad/s; 0 when done.
        done: True when less than the tolerance remains.
    """

    remaining: float
    delta: float
    speed: float
    done: bool


def wrap(angle: float) -> float:
    """Wrap an angle to [-π, π) with turtlesim's eight-digit π; +π becomes -π."""
    if not -_FAR < angle < _FAR:
        angle = math.fmod(angle, TWO_PI)
    wrapped = angle - TWO_PI * math.floor((angle + PI) / TWO_PI)
    # Rounding may give π, which is outside the range.
    return wrapped - TWO_PI if wrapped >= PI else wrapped


def advance(start: Placement, forward: float, sideways: float, turn: float) -> Placement:
    """Compute a turtle's pose after one update: turn first, then move along the new heading.

    Args:
        start: Pose before the update.
        forward: Speed along the heading, in m/s.
        sideways: Speed to the left of the heading, in m/s.
        turn: Turn rate in rad/s.

    Returns:
        The pose one update later, without regard to walls.
    """
    x, y, theta = start
    theta = wrap(theta + turn * STEP)
    cosine, sine = math.cos(theta), math.sin(theta)
    return Placement(
        x + (cosine * forward - sine * sideways) * STEP,
        y + (sine * forward + cosine * sideways) * STEP,
        theta,
    )


def inside(place: Placement) -> bool:
    """Whether a turtle's position is in the field, edges included."""
    return 0.0 <= place.x <= FIELD and 0.0 <= place.y <= FIELD


def clamp(place: Placement) -> Placement:
    """Clamp a turtle's position to the field, each coordinate separately."""
    return Placement(min(max(place.x, 0.0), FIELD), min(max(place.y, 0.0), FIELD), place.theta)


def turn_towards(goal: float, start: float, theta: float) -> Turning:
    """Compute one update of turtlesim's rotate action.

    Args:
        goal: Heading to reach, radians of any size.
        start: Heading at which the action began.
        theta: Heading now.
    """
    remaining = wrap(wrap(goal) - theta)
    delta = wrap(start - theta)
    if abs(remaining) < ROTATION_TOLERANCE:
        return Turning(remaining, delta, 0.0, True)
    speed = -ROTATION_SPEED if remaining < 0.0 else ROTATION_SPEED
    return Turning(remaining, delta, speed, False)


def float32(value: float) -> float:
    """Round a number to the nearest 32-bit float, as a message field does.

    Numbers above the largest such float become infinite.
    """
    # An array converts like C, to infinity; `struct` raises an error if the number overflows.
    return array("f", (value,))[0]


def float32_finite(value: float, what: str) -> float:
    """Round a number of a request to a 32-bit float; raise an error if it is not finite.

    Args:
        value: The number of the request.
        what: Name of the number in the error message.

    Raises:
        UsageError: If the number is NaN, infinite or larger than a 32-bit float can be.
    """
    rounded = float32(value)
    if not math.isfinite(rounded):
        raise UsageError(f"{what} must be a finite number up to {_LARGEST:.2g}, not {value!r}")
    return rounded


def published(
    x: float, y: float, theta: float, speed: float, turn: float
) -> tuple[float, float, float, float, float]:
    """Round the five numbers of a pose message to 32-bit floats."""
    x, y, theta, speed, turn = array("f", (x, y, theta, speed, turn))
    return x, y, theta, speed, turn
