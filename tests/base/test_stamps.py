import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tftool.base.stamps import as_seconds, display, seconds, time_of_day


@pytest.mark.parametrize(
    ("value", "stamp"),
    [
        (1.0000000012345, 1_000_000_001),
        (-0.5, -500_000_000),
        (1e-40, 0),
        (-1e-40, 0),
        (1e-9, 1),
        (-1e-9, -1),
        (2.5, 2_500_000_000),
    ],
)
def test_seconds_round_half_away_as_tf2_does(value, stamp):
    assert seconds(value) == stamp


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_seconds_that_are_no_number_are_refused(value):
    with pytest.raises(ValueError, match="not a finite number"):
        seconds(value)


def test_an_array_of_seconds_is_refused_with_the_remedy():
    times = np.array([1.0, 2.5])

    with pytest.raises(TypeError, match="one number, not an array") as refusal:
        seconds(times)

    assert "np.rint(times * 1e9).astype(np.int64)" in str(refusal.value)
    with pytest.raises(TypeError, match="not str"):
        seconds("1.0")


@pytest.mark.parametrize(
    ("stamp", "text"),
    [
        (0, "0.000000"),
        (1, "0.000000"),
        (-1, "-0.000000"),
        (1000, "0.000001"),
        (1622031731625364060, "1622031731.625364"),
    ],
)
def test_a_stamp_is_shown_with_six_decimals(stamp, text):
    assert display(stamp) == text


@given(st.integers(0, 2**31 * 10**9))
def test_whole_nanoseconds_survive_seconds_to_a_microsecond(stamp):
    assert abs(seconds(as_seconds(stamp)) - stamp) <= 1000


def test_a_stamp_since_1970_is_a_time_of_day_and_a_simulated_one_is_seconds():
    # 1 January 2024, 13:05:09.25 UTC.
    assert time_of_day(seconds(1_704_114_309.25)) == "13:05:09.250"
    assert time_of_day(seconds(1012.5)) == "1012.500"
