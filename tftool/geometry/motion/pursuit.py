"""Control of a body that pursues a goal given relative to the body."""

import math
from dataclasses import dataclass

from tftool.base.errors import UsageError
from tftool.geometry.motion import pid
from tftool.geometry.motion.twist import Twist2D

COINCIDENT = 1e-9
"""Distance, metres, below which a goal has no bearing because only rounding is left."""

TUTORIAL_DISTANCE = pid.Gains(0.5)
"""Gain from distance to forward speed in ROS's tutorial: m/s per metre."""

TUTORIAL_BEARING = pid.Gains(1.0)
"""Gain from bearing to turn rate in ROS's tutorial: rad/s per radian."""

_STOP = Twist2D()


@dataclass(frozen=True, slots=True)
class Law:
    """Control law from distance and bearing to speed and turn rate; ROS's tutorial's by default.

    Attributes:
        distance: Gains from distance in metres to speed in m/s.
        bearing: Gains from bearing in radians to turn rate in rad/s.
        dead_band: Distance in metres within which the goal counts as reached.
        speed_limit: Largest speed in m/s; None for no limit.
    """

    distance: pid.Gains = TUTORIAL_DISTANCE
    bearing: pid.Gains = TUTORIAL_BEARING
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
    """State of the distance and the bearing controller between two steps."""

    distance: pid.PidState = pid.FRESH
    bearing: pid.PidState = pid.FRESH


FRESH = PursuitState()
"""State of the controllers before the first step."""


def steer(
    law: Law, memory: PursuitState, x: float, y: float, interval: float
) -> tuple[Twist2D, PursuitState]:
    """Return the velocity command that steers a body towards a goal.

    Args:
        law: The control law.
        memory: State after the previous step; `FRESH` at first.
        x: Distance of the goal ahead, in metres.
        y: Distance of the goal to the left, in metres.
        interval: Seconds since the previous step.

    Returns:
        The command, and the new state. Within the dead band the command is zero, and the state is
        reset.
    """
    distance = math.hypot(x, y)
    if distance < law.dead_band:
        return _STOP, FRESH
    # For two frames at one place only rounding is left, from which atan2 would compute
    # a full turn rate.
    bearing = math.atan2(y, x) if distance >= COINCIDENT else 0.0
    distance = distance if distance >= COINCIDENT else 0.0

    # The controller's measurement is the position relative to the goal: -distance.
    speed, of_distance = pid.step(
        law.distance.limited(law.speed_limit), memory.distance, -distance, interval
    )
    turn, of_bearing = pid.step(law.bearing, memory.bearing, -bearing, interval, angle=True)
    return Twist2D(speed, turn), PursuitState(of_distance, of_bearing)
