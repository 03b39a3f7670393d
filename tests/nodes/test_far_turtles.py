"""A simulator seen from another process, by its poses alone."""

import pytest

from tftool.messages import Pose2D, Twist2D
from tftool.nodes.far_turtles import MOST, FarTurtles
from tftool.nodes.turtlesim import Turtlesim
from tftool.runtime.clock import SimClock, run
from tftool.runtime.node import Node
from tftool.runtime.supervisor import live
from tftool.runtime.world import World
from tftool.stamps import seconds


class Script(Node):
    """Does what it is told to at its seconds."""

    def __init__(self, world, *steps):
        super().__init__(world, "script")
        self.steps = steps

    async def run(self):
        start = self.clock.now()
        for second, step in self.steps:
            await self.clock.sleep_until(start + seconds(second))
            step()


@pytest.fixture
def world():
    return World(SimClock())


def lived(world, duration):
    run(world.clock, live(world, until=world.clock.now() + seconds(duration)))


def pose(x, y=5.0):
    return Pose2D(x, y, 0.0, 0.0, 0.0)


def test_what_is_drawn_is_what_the_simulator_drew(world):
    simulator, far = Turtlesim(world), FarTurtles(world)
    drive = world.topic("turtle1/cmd_vel", Twist2D)
    Script(world, (1, lambda: drive.publish(Twist2D(2.0, 1.8))))

    lived(world, 3)

    assert list(far.turtles) == ["turtle1"]
    assert far.turtles["turtle1"].pose == simulator.turtles["turtle1"].pose
    assert far.background == simulator.background
    assert len(far.trail.segments) == len(simulator.trail.segments) > 50
    for ours, theirs in zip(far.trail.segments, simulator.trail.segments, strict=True):
        assert ours[:4] == pytest.approx(theirs[:4], abs=1e-6)
        assert ours[4:] == theirs[4:]


def test_the_picture_changes_only_when_a_turtle_moves(world):
    far = FarTurtles(world)
    topic = world.topic("turtle1/pose", Pose2D)

    topic.publish(pose(1.0))
    first = far.revision
    topic.publish(pose(1.0))
    assert far.revision == first
    topic.publish(pose(1.5))
    assert far.revision > first


def test_who_falls_silent_is_gone_and_leaves_no_line_when_it_comes_back_elsewhere(world):
    far = FarTurtles(world)
    one, two = (world.topic(f"turtle{number}/pose", Pose2D) for number in (1, 2))
    there = []
    Script(
        world,
        (0, lambda: one.publish(pose(1.0))),
        (0.5, lambda: two.publish(pose(2.0))),
        (1.2, lambda: there.extend(far.turtles)),
        (1.4, lambda: two.publish(pose(2.0))),
        (2.0, lambda: one.publish(pose(9.0))),
    )

    lived(world, 2.1)

    assert there == ["turtle2"]
    assert list(far.turtles) == ["turtle1", "turtle2"]
    assert len(far.trail.segments) == 0


def test_of_a_crowd_only_the_first_are_listened_to(world):
    far = FarTurtles(world)
    topics = [world.topic(f"turtle{number}/pose", Pose2D) for number in range(MOST + 10)]
    for topic in topics:
        topic.publish(pose(1.0))

    assert len(far.turtles) == MOST
    assert sum(topic.near_subscribers for topic in world.topics().values()) == MOST


def test_another_simulator_begins_on_an_empty_sheet(world):
    far = FarTurtles(world)
    topic = world.topic("turtle1/pose", Pose2D)
    before = []
    Script(
        world,
        (0.0, lambda: topic.publish(pose(1.0))),
        (0.1, lambda: topic.publish(pose(2.0))),
        (4.0, lambda: before.extend(far.trail.segments)),
        (5.0, lambda: topic.publish(pose(5.0))),
        (5.1, lambda: topic.publish(pose(6.0))),
    )

    lived(world, 6)

    # Left as it was until the next one comes.
    assert [(one.x0, one.x1) for one in before] == [(1.0, 2.0)]
    assert [(one.x0, one.x1) for one in far.trail.segments] == [(5.0, 6.0)]
