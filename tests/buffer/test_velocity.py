import math

import pytest

from tftool.base.errors import ForwardExtrapolationException, LookupException
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform, transform_from_pose


@pytest.fixture
def circling():
    """Return a buffer with a body on a circle of radius 2, 2π seconds per turn, and a turned eye.

    The eye is turned by a quarter to the left.
    """
    buffer = Buffer(seconds(100))
    for tick in range(101):
        angle = 0.05 * tick
        pose = transform_from_pose(
            2.0 * math.cos(angle), 2.0 * math.sin(angle), angle + math.pi / 2
        )
        stamp = seconds(1000 + 0.05 * tick)
        buffer.set_transform(TransformStamped(stamp, "world", "body", pose), "test")
    eye = transform_from_pose(5.0, 1.0, math.pi / 2)
    buffer.set_transform_static(TransformStamped(0, "world", "eye", eye), "test")
    return buffer


def test_a_twist_is_tangential_and_turns_with_the_circle(circling):
    found = circling.lookup_twist("body", "world", seconds(1002), seconds(0.1))

    assert found.linear == pytest.approx((-2 * math.sin(2), 2 * math.cos(2), 0), abs=2e-3)
    assert found.angular == pytest.approx((0, 0, 1), abs=1e-9)
    assert (found.stamp, found.frame, found.body) == (seconds(1002), "world", "body")


def test_a_twist_is_given_in_the_frame_it_is_seen_from(circling):
    found = circling.lookup_twist("body", "eye", seconds(1002), seconds(0.1))

    # Since the eye is turned by a quarter to the left, motion along y is along x for the eye.
    assert found.linear == pytest.approx((2 * math.cos(2), 2 * math.sin(2), 0), abs=2e-3)


def test_the_latest_twist_is_over_the_last_interval(circling):
    found = circling.lookup_twist("body", "world", 0, seconds(0.1))

    assert found.stamp == seconds(1004.95)
    assert found.angular.z == pytest.approx(1.0)


def test_a_static_frame_has_a_twist_of_zero(circling):
    found = circling.lookup_twist("eye", "world", seconds(1002), seconds(1))

    assert found.linear == (0, 0, 0)
    assert found.angular == (0, 0, 0)


def test_no_interval_is_no_velocity(circling):
    assert math.isnan(circling.lookup_velocity("body", "world", seconds(1002), 0).linear.x)


def test_refusals_are_the_lookups(circling):
    with pytest.raises(LookupException):
        circling.lookup_velocity("ghost", "world", seconds(1002), seconds(1))
    with pytest.raises(ForwardExtrapolationException):
        circling.lookup_velocity("body", "world", seconds(2000), seconds(1))


def test_a_still_body_has_a_velocity_of_zero_by_tf2s_formula_too():
    buffer = Buffer()
    for at in (1, 2):
        buffer.set_transform(TransformStamped(seconds(at), "a", "b", Transform((1, 1, 1))), "t")

    found = buffer.lookup_velocity("b", "a", seconds(1.5), seconds(0.5))

    assert found.linear == (0, 0, 0)
    assert found.angular == (0, 0, 0)


@pytest.mark.parametrize("interval", [0, -1])
def test_a_twist_over_no_interval_is_refused(circling, interval):
    with pytest.raises(ValueError, match=f"a positive interval, not {interval} ns"):
        circling.lookup_twist("body", "world", seconds(1002), interval)


@pytest.mark.parametrize("wrong", [0.1, math.nan])
def test_a_velocity_wants_whole_nanoseconds(circling, wrong):
    for ask in (circling.lookup_twist, circling.lookup_velocity):
        for time, interval in ((wrong, seconds(1)), (seconds(1002), wrong)):
            with pytest.raises(TypeError, match="whole nanoseconds"):
                ask("body", "world", time, interval)
