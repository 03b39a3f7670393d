import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tftool.base.errors import UsageError
from tftool.geometry.motion import (
    CENTRE,
    FIELD,
    PI,
    ROTATION_TOLERANCE,
    STEP,
    TWO_PI,
    Placement,
    advance,
    clamp,
    float32,
    float32_finite,
    inside,
    published,
    turn_towards,
    wrap,
)

speeds = st.floats(-5, 5)
headings = st.floats(-10, 10)
any_number = st.floats(allow_nan=False, allow_infinity=False)


@given(any_number)
def test_wrapped_angles_lie_between_minus_pi_and_pi(angle):
    assert -PI <= wrap(angle) < PI


@given(st.floats(-1000, 1000))
def test_wrapping_changes_an_angle_by_whole_turns(angle):
    turns = (angle - wrap(angle)) / TWO_PI

    assert turns == pytest.approx(round(turns), abs=1e-9)


@given(speeds, st.floats(-3, 3).filter(lambda turn: abs(turn) > 0.01), st.integers(1, 200))
def test_many_steps_follow_the_closed_form(speed, turn, steps):
    place = Placement(CENTRE, CENTRE, 0.0)
    for _ in range(steps):
        place = advance(place, speed, 0.0, turn)

    chord = speed * STEP * math.sin(steps * turn * STEP / 2) / math.sin(turn * STEP / 2)
    direction = (steps + 1) * turn * STEP / 2
    assert place.x == pytest.approx(CENTRE + chord * math.cos(direction), abs=1e-7)
    assert place.y == pytest.approx(CENTRE + chord * math.sin(direction), abs=1e-7)
    assert math.cos(place.theta - steps * turn * STEP) == pytest.approx(1.0, abs=1e-9)


@given(st.floats(-1, 1), st.floats(-1, 1), headings)
def test_sideways_is_forward_turned_a_quarter_to_the_left(x, y, heading):
    sideways = advance(Placement(x, y, heading), 0.0, 1.0, 0.0)
    quarter = advance(Placement(x, y, heading + math.pi / 2), 1.0, 0.0, 0.0)

    assert sideways[:2] == pytest.approx(quarter[:2], abs=1e-9)


@given(any_number, any_number)
def test_a_clamped_place_is_inside_and_clamping_again_changes_nothing(x, y):
    clamped = clamp(Placement(x, y, 1.0))

    assert inside(clamped)
    assert clamp(clamped) == clamped


def test_the_edge_itself_is_inside():
    assert inside(Placement(0.0, FIELD, 0.0))
    assert not inside(Placement(math.nextafter(FIELD, 20), 0.0, 0.0))
    assert not inside(Placement(0.0, -5e-324, 0.0))


@given(st.floats(-3.1, 3.1), st.floats(-3.1, 3.1))
def test_turning_ends_within_the_tolerance_in_the_number_of_steps_it_takes(start, goal):
    theta, steps = start, 0
    while not (turning := turn_towards(goal, start, theta)).done:
        theta = wrap(theta + turning.speed * STEP)
        steps += 1
        assert steps <= 197

    assert abs(wrap(goal - theta)) < ROTATION_TOLERANCE


def test_a_left_turn_reports_a_negative_delta():
    assert turn_towards(1.0, 0.0, 0.4).delta == pytest.approx(-0.4)


@pytest.mark.parametrize(
    ("value", "rounded"),
    [(0.1, 0.10000000149011612), (0.5, 0.5), (1e39, math.inf), (-1e39, -math.inf)],
)
def test_float32_rounds_to_the_nearest_and_overflows_to_infinity(value, rounded):
    assert float32(value) == rounded


def test_a_published_pose_survives_a_speed_too_large_for_its_message():
    assert published(0.1, 1.0, 2.0, 1e300, 0.5) == (float32(0.1), 1.0, 2.0, math.inf, 0.5)


@pytest.mark.parametrize("value", [math.nan, math.inf, -1e39])
def test_a_request_with_a_number_that_does_not_fit_is_refused_by_name(value):
    with pytest.raises(UsageError, match="x must be a finite number"):
        float32_finite(value, "x")
