import math

import pytest

from tests.nodes.harness import After, At, log_texts, new_world, play
from tftool.errors import BackwardExtrapolationException
from tftool.messages import Twist2D
from tftool.nodes.broadcasters import Broadcaster
from tftool.nodes.sighting import Sighting
from tftool.nodes.turtlesim import Turtlesim
from tftool.stamps import seconds


def test_what_was_stored_in_the_fixed_frame_outlives_the_cache_and_the_rest_does_not():
    world = new_world()
    sim = Turtlesim(world)
    Broadcaster(world, "broadcaster1", turtle="turtle1")
    Sighting(world)
    drive = world.topic("turtle1/cmd_vel", Twist2D)
    At(world, *((second, lambda: drive.publish(Twist2D(1.0, 0.5))) for second in range(20)))
    found = {}

    def look(when):
        buffer = world.buffer
        for frame in ("thing_as_seen", "thing_in_world"):
            found[when, frame] = (
                buffer.lookup_transform("world", frame).transform
                if buffer.can_transform("world", frame)
                else None
            )

    After(world, (5.0, lambda: look(5)), (20.0, lambda: look(20)), name="watcher")
    play(world, 20.0)

    assert found[5, "thing_as_seen"].translation == pytest.approx(
        found[5, "thing_in_world"].translation
    )
    assert found[20, "thing_in_world"] == found[5, "thing_in_world"]
    assert found[20, "thing_as_seen"] is None
    with pytest.raises(BackwardExtrapolationException):
        world.buffer.lookup_transform("world", "thing_as_seen")
    place = sim.turtles["turtle1"].place
    assert math.dist(found[20, "thing_in_world"].translation[:2], place[:2]) > 0.1


def test_an_observer_nobody_knows_sees_nothing_and_it_is_told():
    world = new_world()
    Sighting(world, after=seconds(1))
    play(world, 2.0)

    assert log_texts(world) == [
        'Nothing was seen from turtle1: "world" passed to lookupTransform argument '
        "target_frame does not exist. "
    ]
