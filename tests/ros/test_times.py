"""Tests of times, durations and clocks."""

import pytest


def test_times_and_durations_calculate_and_compare(ros_runtime):
    from rclpy.clock import Clock, ClockType
    from rclpy.duration import Duration
    from rclpy.time import Time

    time = Time(seconds=2, nanoseconds=5)

    assert time.nanoseconds == 2_000_000_005
    assert time.seconds_nanoseconds() == (2, 5)
    assert (time + Duration(seconds=1.5)).nanoseconds == 3_500_000_005
    assert time - Duration(nanoseconds=5) == Time(seconds=2)
    assert (time - Time(seconds=1)).nanoseconds == 1_000_000_005
    assert Time(seconds=1) < time <= time
    assert time > Time(seconds=1)
    assert time >= time
    assert Time.from_msg(time.to_msg(), clock_type=ClockType.SYSTEM_TIME) == time
    assert repr(Time()) == "Time(nanoseconds=0, clock_type=SYSTEM_TIME)"
    assert Duration(seconds=1) < Duration(seconds=2) <= Duration(seconds=2)
    assert Duration(seconds=3) > Duration(seconds=2) >= Duration(seconds=2)
    assert Duration(seconds=1) + Duration(seconds=2) == Duration(seconds=3)
    assert Duration(seconds=3) - Duration(seconds=2) == Duration(seconds=1)
    assert (Duration(seconds=1) * 2).nanoseconds == 2_000_000_000
    assert str(Duration(seconds=1) * float("inf")) == "Infinite"
    assert Duration.from_msg(Duration(seconds=-1.5).to_msg()) == Duration(seconds=-1.5)
    assert str(Duration(nanoseconds=3)) == "3 nanoseconds"
    assert repr(Duration(nanoseconds=3)) == "Duration(nanoseconds=3)"
    assert len({time, Time(seconds=2, nanoseconds=5)}) == 1
    clock = Clock(clock_type=ClockType.ROS_TIME)
    assert clock.now().clock_type is ClockType.ROS_TIME
    assert clock.sleep_until(clock.now() + Duration(seconds=2))
    assert ros_runtime.elapsed() == 2.0


@pytest.mark.parametrize(
    ("make", "error", "told"),
    [
        (lambda t, d, c: t.Time(seconds=-1), ValueError, "negative"),
        (lambda t, d, c: t.Time(nanoseconds=-1), ValueError, "negative"),
        (lambda t, d, c: t.Time(clock_type=1), TypeError, "ClockType"),
        (lambda t, d, c: t.Time(seconds=1e12), OverflowError, "too large"),
        (lambda t, d, c: d.Duration(seconds=1e12), OverflowError, "too large"),
        (
            lambda t, d, c: t.Time() < t.Time(clock_type=c.ClockType.ROS_TIME),
            TypeError,
            "different clock types",
        ),
        (lambda t, d, c: t.Time() < 3, TypeError, "Can't compare"),
        (lambda t, d, c: d.Duration() < 3, TypeError, "Can't compare"),
        (lambda t, d, c: d.Duration() * float("nan"), ValueError, "Can't multiply"),
        (lambda t, d, c: d.Duration() * float("-inf"), ValueError, "Can't multiply"),
        (lambda t, d, c: t.Time() + t.Time(), TypeError, "unsupported operand"),
        (lambda t, d, c: c.Clock(clock_type=1), TypeError, "ClockType"),
    ],
)
def test_wrong_times_are_refused(ros_runtime, make, error, told):
    import rclpy.clock
    import rclpy.duration
    import rclpy.time

    with pytest.raises(error, match=told):
        make(rclpy.time, rclpy.duration, rclpy.clock)


def test_a_jump_callback_needs_a_function_and_a_valid_threshold(node):
    from rclpy.clock import ClockChange, JumpThreshold, TimeJump
    from rclpy.duration import Duration

    second = Duration(seconds=1)
    threshold = JumpThreshold(min_forward=second, min_backward=None)
    with node.get_clock().create_jump_callback(threshold, post_callback=print) as handle:
        handle.unregister()
    jump = TimeJump(ClockChange.ROS_TIME_ACTIVATED, second)

    assert jump.delta == second
    with pytest.raises(ValueError, match="must be callable"):
        node.get_clock().create_jump_callback(threshold)
    for wrong in (
        {"min_forward": Duration(), "min_backward": None},
        {"min_forward": None, "min_backward": second},
        {"min_forward": None, "min_backward": None, "on_clock_change": False},
    ):
        with pytest.raises(ValueError, match="must be"):
            JumpThreshold(**wrong)
