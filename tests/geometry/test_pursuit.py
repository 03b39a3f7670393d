import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tftool.base.errors import UsageError
from tftool.geometry.motion import AT_REST, Gains, Law, Twist2D, steer

coordinates = st.floats(-20, 20)


@given(coordinates, coordinates)
def test_the_default_law_is_the_tutorials(x, y):
    command, _ = steer(Law(), AT_REST, x, y, 1.0)

    distance = math.sqrt(x * x + y * y)
    if distance >= 1e-9:
        assert command.linear_x == pytest.approx(0.5 * distance)
        assert command.angular_z == pytest.approx(1.0 * math.atan2(y, x))


@given(st.floats(-1e-10, 1e-10), st.floats(-1e-10, 1e-10))
def test_a_goal_at_ones_own_place_asks_for_no_motion_at_all(x, y):
    command, _ = steer(Law(), AT_REST, x, y, 1.0)

    assert command == Twist2D(0.0, 0.0)


def test_within_the_dead_band_the_command_is_to_stop_and_the_past_is_dropped():
    law = Law(Gains(0.5, 0.1), Gains(1.0, 0.1), dead_band=0.5)
    _, memory = steer(law, AT_REST, 2.0, 1.0, 1.0)
    command, memory = steer(law, memory, 0.3, 0.3, 1.0)

    assert command == Twist2D()
    assert memory == AT_REST


def test_the_speed_limit_holds_speed_and_leaves_turning_alone():
    command, _ = steer(Law(speed_limit=1.0), AT_REST, 0.0, 8.0, 1.0)

    assert command == Twist2D(1.0, math.pi / 2)


def test_a_bearing_that_passes_behind_does_not_kick_the_derivative():
    law = Law(bearing=Gains(0.0, kd=1.0))
    _, memory = steer(law, AT_REST, -1.0, 0.01, 1.0)
    command, _ = steer(law, memory, -1.0, -0.01, 1.0)

    assert abs(command.angular_z) < 0.03


@pytest.mark.parametrize(
    "wrong", [{"dead_band": -1.0}, {"dead_band": math.nan}, {"speed_limit": -0.1}]
)
def test_a_law_with_impossible_limits_is_refused(wrong):
    with pytest.raises(UsageError, match="zero"):
        Law(**wrong)
