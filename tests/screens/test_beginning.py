"""Tests that a screen first shows static frames at a moment at which they have arrived."""

import pytest

from tftool import Buffer, Transform, TransformStamped, seconds
from tftool.opener import scenario_named
from tftool.scenario.play import build
from tftool.screens.still_frames import first_moment
from tftool.world.clock import SimClock, run

BEGIN, END = seconds(100), seconds(160)


def coming_at(*moments):
    """Return a buffer whose frames arrive at these seconds after the beginning."""
    buffer = Buffer(cache_time=seconds(1000))
    for number, moment in enumerate(moments):
        for stamp in (BEGIN + seconds(moment), END):
            pose = Transform((stamp / seconds(1), 0.0, 0.0))
            buffer.set_transform(TransformStamped(stamp, "map", f"frame{number}", pose), "me")
    return buffer


def test_a_frame_that_comes_soon_is_there_at_the_first_moment():
    assert first_moment(coming_at(0.0, 2.5), BEGIN, END) == BEGIN + seconds(2.5)


def test_a_frame_that_comes_late_is_not_waited_for():
    assert first_moment(coming_at(0.0, 30.0), BEGIN, END) == BEGIN


def test_a_world_of_static_frames_has_no_first_moment():
    buffer = Buffer()
    buffer.set_transform_static(TransformStamped(BEGIN, "map", "mast", Transform()), "me")

    assert first_moment(buffer, BEGIN, END) is None


@pytest.mark.parametrize(("name", "source"), [("turtles", "turtle1"), ("carrot", "carrot1")])
def test_a_built_in_scenario_is_first_shown_with_both_its_turtles(name, source):
    play = build(scenario_named(name), SimClock())
    clock, begin = play.world.clock, play.world.clock.now()
    run(clock, play.live(begin + seconds(9)))

    first = first_moment(play.world.buffer, begin, clock.now())
    assert play.world.buffer.can_transform("turtle2", source, first)
