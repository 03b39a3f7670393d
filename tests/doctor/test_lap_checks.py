"""Tests of recordings in which time goes back."""

import pytest

from tests.doctor.judged import found
from tests.doctor.robots import START, Robot, drives
from tftool.base.stamps import seconds


def twice(back: float) -> Robot:
    """Return 20 s of transforms, after which time goes back by `back` seconds, and goes on."""
    made = Robot()
    for at in range(40):
        for parent, child in (("odom", "base_link"), ("base_link", "arm")):
            stamp = made.log(at - back * (at >= 20))
            made.sent(parent, child, float(at), drives(at), stamp=stamp)
    return made


@pytest.mark.parametrize(
    ("back", "told"),
    [
        # Of 20 samples of each edge, the first four are more than 10 s older than the newest.
        (
            15.0,
            "its buffer drops 8 of 80 transforms as older than 10.00 s (TF_OLD_DATA), and mixes",
        ),
        (5.0, "its buffer mixes old poses with newer ones"),
    ],
)
def test_stamps_that_go_back_without_a_clock_are_dropped_or_mixed(back, told):
    finding = found(twice(back), "time-jump-back")
    assert finding.consequence.startswith("without /clock no listener notices")
    assert told in finding.consequence


def test_a_clock_that_goes_back_makes_listeners_clear_their_buffers():
    made = twice(15.0)
    made.clock = [(made.log(at - 15 * (at >= 20)), made.log(at)) for at in range(40)]
    assert "clear their buffers" in found(made, "time-jump-back").consequence
    simulated = twice(15.0)
    for rows in simulated.records.values():
        rows[:] = [(stamp - seconds(START), pose, message) for stamp, pose, message in rows]
    assert "clear their buffers" in found(simulated, "time-jump-back").consequence


def test_the_cut_says_what_the_later_parts_hold():
    made = Robot()
    # The first 5 s are sent again twice, and both times the data goes on.
    for begin, ticks in ((0, 10), (10, 40), (40, 20)):
        for tick in range(ticks):
            at, pose = 0.5 * tick, drives(0.5 * tick)
            for parent, child in (("odom", "base_link"), ("base_link", "arm")):
                made.sent(parent, child, begin + at, pose, stamp=made.log(at))
    (fix,) = found(made, "time-jump-back").fixes
    assert "(the 2 later parts hold 120 of 140 transforms)" in fix.text
