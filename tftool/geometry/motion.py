"""Bodies in motion: turtlesim's turtle, a PID controller, and pursuit of a goal.

The constants of the turtle are exactly turtlesim's: π has eight digits, and the field's edge is a
32-bit float. With more precise constants, the poses would differ from turtlesim's.
"""

import math
from array import array
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

from tftool.base.errors import UsageError
from tftool.base.stamps import Duration


@dataclass(frozen=True, slots=True)
class Twist2D:
    """Velocity of a body in the plane: forward and leftward speed in m/s, turn rate in rad/s."""

    linear_x: float = 0.0
    angular_z: float = 0.0
    linear_y: float = 0.0


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
    """Result of one tick of turtlesim's rotate action.

    Attributes:
        remaining: Signed angle from the present heading to the goal, from -π to π, in rad.
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
        forward: Speed in the direction of the new heading, in m/s.
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
    """Round a number to the nearest 32-bit float, as a float32 field of a message does.

    Numbers above the largest 32-bit float become infinite.
    """
    # An array converts like C, to infinity; `struct` raises an error if the number overflows.
    return array("f", (value,))[0]


def float32_finite(value: float, what: str) -> float:
    """Round a number to a 32-bit float; raise an error if the result is not finite.

    Args:
        value: The number, for example a field of a service request.
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
    """Round the five numbers of a turtlesim Pose message to 32-bit floats, in the same order."""
    x, y, theta, speed, turn = array("f", (x, y, theta, speed, turn))
    return x, y, theta, speed, turn


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains and limits of a PID controller.

    Attributes:
        kp: Output per unit of error.
        ki: Output per unit of error that lasts for one second.
        kd: Output per unit of growth of the error in one second.
        integral_limit: Bound on the size of the integral term of the output; None for no limit.
        output_limit: Bound on the size of the output; None for no limit. While the output is at
            this bound, the integral does not grow further in that direction.
    """

    kp: float
    ki: float = 0.0
    kd: float = 0.0
    integral_limit: float | None = None
    output_limit: float | None = None

    def __post_init__(self) -> None:
        for name in ("kp", "ki", "kd"):
            if not math.isfinite(getattr(self, name)):
                raise UsageError(f"gain {name} must be a finite number, not {getattr(self, name)}")
        for name in ("integral_limit", "output_limit"):
            limit = getattr(self, name)
            # Written with `not`, so that NaN is refused too.
            if limit is not None and not limit >= 0.0:
                raise UsageError(f"{name} must be zero or more, not {limit}")

    def limited(self, output_limit: float | None) -> "Gains":
        """Return these gains with an output limit of at most `output_limit`."""
        if output_limit is None or (
            self.output_limit is not None and self.output_limit <= output_limit
        ):
            return self
        return replace(self, output_limit=output_limit)


@dataclass(frozen=True, slots=True)
class PidState:
    """State of a PID controller between two updates.

    Attributes:
        integral: Integral of the error over the time so far, in seconds times the error's unit.
        measured: The measurement of the last update; None before the first update.
    """

    integral: float = 0.0
    measured: float | None = None


FRESH = PidState()
"""State of a controller before its first update."""


def step(
    gains: Gains,
    memory: PidState,
    measured: float,
    interval: float,
    *,
    setpoint: float = 0.0,
    angle: bool = False,
) -> tuple[float, PidState]:
    """Update a PID controller with one measurement; return the output and the new state.

    The derivative term uses the measurement, not the error, so that a jump of the setpoint does not
    affect the derivative. The derivative is 0 at the first update.

    Args:
        gains: Gains and limits of the controller.
        memory: State after the previous update; `FRESH` for the first update.
        measured: Measured value.
        interval: Seconds since the previous update, above zero.
        setpoint: Value that the controller shall reach.
        angle: Whether the quantity is an angle in radians, so that differences are at most π.

    Returns:
        The output, and the new state.
    """
    error = setpoint - measured
    moved = 0.0 if memory.measured is None else measured - memory.measured
    if angle:
        error, moved = _short_way(error), _short_way(moved)
    integral = _bounded_integral(gains, memory.integral + error * interval)
    output = gains.kp * error + gains.ki * integral - gains.kd * moved / interval

    limit = gains.output_limit
    if limit is not None and abs(output) > limit:
        held = math.copysign(limit, output)
        # At the output limit the integral must not grow further: it would have to shrink later.
        if gains.ki * error * held > 0.0:
            integral = memory.integral
        output = held
    return output, PidState(integral, measured)


def _bounded_integral(gains: Gains, integral: float) -> float:
    if gains.integral_limit is None or gains.ki == 0.0:
        return integral
    most = gains.integral_limit / abs(gains.ki)
    return min(max(integral, -most), most)


def _short_way(angle: float) -> float:
    # ±π, the bearing of a goal straight behind, stays unchanged.
    return angle if -math.pi <= angle <= math.pi else math.remainder(angle, math.tau)


COINCIDENT = 1e-9
"""Distance, metres, below which a goal has no bearing because only rounding is left."""

TUTORIAL_DISTANCE = Gains(0.5)
"""Gain from distance to forward speed in ROS's tutorial: m/s per metre."""

TUTORIAL_BEARING = Gains(1.0)
"""Gain from bearing to turn rate in ROS's tutorial: rad/s per radian."""

_STOP = Twist2D()


@dataclass(frozen=True, slots=True)
class Law:
    """Control law that computes speeds from the distance and bearing of a goal.

    Attributes:
        distance: Gains from distance in metres to speed in m/s; by default those of the ROS
            tutorial.
        bearing: Gains from bearing in radians to turn rate in rad/s; by default those of the ROS
            tutorial.
        dead_band: Distance in metres within which the goal counts as reached.
        speed_limit: Largest speed in m/s; None for no limit.
    """

    distance: Gains = TUTORIAL_DISTANCE
    bearing: Gains = TUTORIAL_BEARING
    dead_band: float = 0.0
    speed_limit: float | None = None

    def __post_init__(self) -> None:
        # Written with `not`, so that NaN is refused too.
        if not self.dead_band >= 0.0:
            raise UsageError(f"the dead band must be zero metres or more, not {self.dead_band}")
        if self.speed_limit is not None and not self.speed_limit >= 0.0:
            raise UsageError(f"the speed limit must be zero m/s or more, not {self.speed_limit}")


@dataclass(frozen=True, slots=True)
class PursuitState:
    """State of the distance controller and the bearing controller between two updates."""

    distance: PidState = FRESH
    bearing: PidState = FRESH


AT_REST = PursuitState()
"""State of the controllers before the first update."""


def steer(
    law: Law, memory: PursuitState, x: float, y: float, interval: float
) -> tuple[Twist2D, PursuitState]:
    """Return the velocity command that steers a body towards a goal.

    Args:
        law: The control law.
        memory: State after the previous update; `AT_REST` for the first update.
        x: Distance of the goal ahead, in metres.
        y: Distance of the goal to the left, in metres.
        interval: Seconds since the previous update.

    Returns:
        The command, and the new state. Within the dead band the command is zero, and the state is
        reset.
    """
    distance = math.hypot(x, y)
    if distance < law.dead_band:
        return _STOP, AT_REST
    # For two frames at one place only rounding is left, from which atan2 would compute
    # a full turn rate.
    bearing = math.atan2(y, x) if distance >= COINCIDENT else 0.0
    distance = distance if distance >= COINCIDENT else 0.0

    # The controller's measurement is the position relative to the goal: -distance.
    speed, of_distance = step(
        law.distance.limited(law.speed_limit), memory.distance, -distance, interval
    )
    turn, of_bearing = step(law.bearing, memory.bearing, -bearing, interval, angle=True)
    return Twist2D(speed, turn), PursuitState(of_distance, of_bearing)
