import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.world.nodes.harness import At, new_world, play
from tftool.base.errors import LookupException, UsageError
from tftool.base.stamps import NANOSECONDS, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform, heading
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Kill, Pose
from tftool.world.nodes.broadcasters import (
    Broadcaster,
    DynamicCarrot,
    FixedCarrot,
    StaticBroadcaster,
    carrot_offset,
)
from tftool.world.nodes.turtlesim import Turtlesim


def test_a_turtle_is_broadcast_at_every_tick_with_the_ticks_stamp():
    world = new_world()
    Turtlesim(world)
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    play(world, 1.0)

    info = world.buffer.snapshot(now=world.clock.now()).frame("turtle1")
    assert (info.parent, info.authority, info.samples) == ("world", "broadcaster1", 63)
    assert (info.oldest, info.newest) == (seconds(1000), seconds(1000.992))


def test_only_the_yaw_and_the_place_of_a_pose_are_told():
    world = new_world()
    Broadcaster(world, "broadcaster1", turtle="turtle1", frame_id="field", topic="elsewhere")
    pose = build(Pose, 1.0, 2.0, 3.0, 4.0, 5.0)
    At(world, (0.1, lambda: world.topic("elsewhere", Pose).publish(pose)))
    play(world, 0.2)

    found = world.buffer.lookup_transform("field", "turtle1").transform
    assert found.translation == (1.0, 2.0, 0.0)
    assert heading(found) == pytest.approx(3.0)


def test_a_killed_turtles_frame_just_grows_old():
    world = new_world()
    Turtlesim(world)
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    At(world, (0.5, lambda: world.call("kill", build(Kill.Request, "turtle1"))))
    play(world, 5.0)

    assert world.buffer.lookup_transform("world", "turtle1").stamp == seconds(1000.496)


def test_a_turtle_that_is_not_there_has_no_frame():
    world = new_world()
    Turtlesim(world)
    Broadcaster(world, "broadcaster2", turtle="turtle2")
    play(world, 1.0)

    with pytest.raises(LookupException):
        world.buffer.lookup_transform("world", "turtle2")


def test_a_pose_that_is_no_number_is_refused_and_nothing_held_is_lost():
    world = new_world()
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    poses = world.topic("turtle1/pose", Pose)
    At(
        world,
        (0.1, lambda: poses.publish(build(Pose, 1.0, 2.0, 0.0))),
        (0.2, lambda: poses.publish(build(Pose, math.nan, 2.0, 0.0))),
    )
    play(world, 0.3)

    assert world.buffer.lookup_transform("world", "turtle1").stamp == seconds(1000.1)
    assert [one.level for one in world.log.records] == ["ERROR"]


def test_static_links_are_stamped_at_the_start_and_hold_for_all_time():
    world = new_world()
    link = TransformStamped(0, "world", "shelf", Transform((1.0, 2.0, 3.0)))
    StaticBroadcaster(world, "statics", transforms=[link])
    play(world, 1.0)

    assert world.static_transforms("statics") == (link._replace(stamp=seconds(1000)),)
    later = world.buffer.lookup_transform("world", "shelf", seconds(5000))
    assert later.transform == link.transform


@given(st.integers(1, 2**62), st.floats(0.1, 20))
def test_the_dynamic_carrot_keeps_its_distance_and_comes_round_in_two_seconds(stamp, radius):
    x, y = carrot_offset(stamp, radius)

    assert math.hypot(x, y) == pytest.approx(radius)
    assert carrot_offset(stamp + 2 * NANOSECONDS, radius) == (x, y)
    half = carrot_offset(stamp + NANOSECONDS, radius)
    assert half == pytest.approx((-x, -y), abs=1e-9 * radius)


@pytest.mark.parametrize("carrot", [FixedCarrot, DynamicCarrot])
@pytest.mark.parametrize("period", [0, -1])
def test_a_carrot_with_an_impossible_period_is_refused(carrot, period):
    with pytest.raises(UsageError, match="a period must be longer than 0 s"):
        carrot(new_world(), "carrot", period=period)
