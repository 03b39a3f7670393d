"""A PID controller's step, as a function of the controller's state and a measurement."""

import math
from dataclasses import dataclass, replace

from tftool.base.errors import UsageError


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains and limits of a PID controller.

    Attributes:
        kp: Output per unit of error.
        ki: Output per unit of error that lasts for one second.
        kd: Output per unit of growth of the error in one second.
        integral_limit: Bound on the size of the integral term of the output; None for no limit.
        output_limit: Bound on the size of the output; None for no limit. While the output is
            limited, the integral does not grow further in that direction.
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
        """Return the gains with the smaller of two output limits: their own, or `output_limit`."""
        if output_limit is None or (
            self.output_limit is not None and self.output_limit <= output_limit
        ):
            return self
        return replace(self, output_limit=output_limit)


@dataclass(frozen=True, slots=True)
class PidState:
    """State of a PID controller between two steps.

    Attributes:
        integral: Sum of error times time so far.
        measured: The measurement of the last step; None before the first.
    """

    integral: float = 0.0
    measured: float | None = None


FRESH = PidState()
"""State of a controller before its first step."""


def step(
    gains: Gains,
    memory: PidState,
    measured: float,
    interval: float,
    *,
    setpoint: float = 0.0,
    angle: bool = False,
) -> tuple[float, PidState]:
    """Update a controller with one measurement; return its output and new state.

    The derivative term uses the measurement, not the error, so that a jump of the setpoint does not
    affect it. The derivative is 0 at the first step.

    Args:
        gains: Gains and limits of the controller.
        memory: State after the previous step; `FRESH` at first.
        measured: Measured value.
        interval: Seconds since the previous step, above zero.
        setpoint: Wanted value.
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
