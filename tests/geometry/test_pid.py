import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tftool.base.errors import UsageError
from tftool.geometry.motion import FRESH, Gains, step

errors = st.lists(st.floats(-10, 10), min_size=1, max_size=30)


def outputs(gains, measurements, interval=0.1, **rest):
    memory, found = FRESH, []
    for measured in measurements:
        output, memory = step(gains, memory, measured, interval, **rest)
        found.append(output)
    return found


@given(errors, st.floats(-5, 5))
def test_without_integral_and_derivative_the_output_is_proportional(measurements, kp):
    assert outputs(Gains(kp), measurements) == [kp * -measured for measured in measurements]


@given(errors)
def test_no_output_exceeds_its_limit(measurements):
    gains = Gains(2.0, 1.0, 0.5, output_limit=1.5)

    assert all(abs(output) <= 1.5 for output in outputs(gains, measurements))


@given(errors)
def test_the_integral_share_never_exceeds_its_limit(measurements):
    gains = Gains(0.0, 3.0, integral_limit=0.25)

    assert all(abs(output) <= 0.25 + 1e-12 for output in outputs(gains, measurements))


def test_an_output_at_its_limit_does_not_wind_the_integral_up():
    gains = Gains(1.0, 1.0, output_limit=1.0)
    held = outputs(gains, [-10.0] * 100 + [0.0])

    assert held[:100] == [1.0] * 100
    assert held[100] == 0.0


def test_an_integral_may_shrink_while_the_output_is_at_its_limit():
    # 20 steps of error 0.4 give an integral of 0.8; then the error changes its sign.
    gains = Gains(0.0, 1.0, output_limit=0.5)
    *_, last = outputs(gains, [-0.4] * 12 + [4.0])

    assert last == pytest.approx(0.48 - 0.4)


def test_a_setpoint_that_jumps_does_not_kick_the_derivative():
    gains = Gains(0.0, kd=1.0)
    _, memory = step(gains, FRESH, 2.0, 0.1, setpoint=0.0)
    output, _ = step(gains, memory, 2.0, 0.1, setpoint=100.0)

    assert output == 0.0


def test_an_angle_that_passes_pi_moves_the_short_way():
    gains = Gains(0.0, kd=1.0)
    _, second = outputs(gains, [3.1, -3.1], interval=1.0, angle=True)

    assert second == pytest.approx(-(2 * math.pi - 6.2))


def test_the_tighter_of_two_output_limits_counts():
    assert Gains(1.0).limited(2.0).output_limit == 2.0
    assert Gains(1.0, output_limit=1.0).limited(2.0).output_limit == 1.0
    assert Gains(1.0, output_limit=3.0).limited(2.0).output_limit == 2.0
    assert Gains(1.0, output_limit=3.0).limited(None).output_limit == 3.0


@pytest.mark.parametrize(
    "wrong",
    [
        {"kp": math.nan},
        {"kp": 1.0, "ki": math.inf},
        {"kp": 1.0, "output_limit": -1.0},
        {"kp": 1.0, "integral_limit": math.nan},
    ],
)
def test_gains_that_are_no_numbers_are_refused(wrong):
    with pytest.raises(UsageError, match="must be"):
        Gains(**wrong)
