import math

import pytest

from tftool.base.stamps import seconds
from tftool.messages.turtle_messages import Twist, twist
from tftool.world.clock import SimClock, run
from tftool.world.node import Node
from tftool.world.nodes.turtle_drivers import IdleDrawing
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World


class At(Node):
    """Node that calls functions at given seconds."""

    def __init__(self, world, deeds):
        super().__init__(world, "at")
        self.deeds = deeds

    async def run(self):
        start = self.clock.now()
        for second, deed in self.deeds:
            await self.clock.sleep_until(start + seconds(second))
            deed(self.world)


def lived(lasting, *deeds, **how):
    world = World(SimClock())
    simulator = Turtlesim(world)
    idle = IdleDrawing(world, **how)
    At(world, deeds)
    run(world.clock, live(world, until=world.clock.now() + seconds(lasting)))
    return simulator, idle


def places(simulator):
    return [(x, y) for _, _, x, y, _, _ in simulator.trail.segments]


def test_a_turtle_left_alone_draws_after_five_seconds_and_not_before():
    assert places(lived(4.9)[0]) == []

    simulator, idle = lived(10.0)

    assert idle.is_drawing
    assert len(places(simulator)) > 200


def test_the_idle_drawing_stays_off_the_walls_and_retraces_its_early_lines():
    simulator, _ = lived(200.0)

    drawn = places(simulator)
    assert simulator.turtles["turtle1"].wall_hits == 0
    assert all(0.5 < x < 10.6 and 0.5 < y < 10.6 for x, y in drawn)
    # The drawing has four petals, so the turtle comes near all four corners.
    for corner in ((2.6, 2.6), (8.5, 2.6), (2.6, 8.5), (8.5, 8.5)):
        assert min(math.dist(corner, one) for one in drawn) < 0.6
    # Late lines cover early lines, so the field does not fill up.
    early, late = drawn[1000:6000], drawn[-500::25]
    assert max(min(math.dist(one, other) for other in early) for one in late) < 0.15


def test_a_command_of_another_stops_it_for_five_seconds():
    def drive(world):
        world.topic("turtle1/cmd_vel", Twist).publish(twist(0.0, 1.0))

    assert not lived(11.9, (7.0, drive))[1].is_drawing
    assert lived(12.5, (7.0, drive))[1].is_drawing


def test_a_touch_stops_it_at_once():
    world_idle = []

    def touch(world):
        world_idle.append(world)
        world.node("idle_drawing").touch()

    simulator, idle = lived(9.0, (8.0, touch))

    assert not idle.is_drawing
    assert simulator.turtles["turtle1"].pose.linear_velocity == 0.0


def test_where_others_are_it_does_not_draw():
    simulator, idle = lived(20.0, is_alone=lambda: False)

    assert places(simulator) == []
    assert not idle.is_drawing


@pytest.mark.parametrize("turtle", ["turtle2", "nobody"])
def test_of_a_turtle_that_is_not_there_it_draws_nothing(turtle):
    simulator, _ = lived(10.0, turtle=turtle)

    assert places(simulator) == []
