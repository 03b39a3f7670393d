import pytest

from tftool.base.stamps import seconds
from tftool.geometry.rigid import Transform
from tftool.screens.terminal.scene import Scene
from tftool.world.clock import Phase, SimClock, run
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import Broadcaster
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.turtle_drivers import Teleop
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live
from tftool.world.world import World


class Looker(Node):
    """Node that updates a scene as often as a screen does, on simulated time."""

    phase = Phase.WATCH

    def __init__(self, world, scene):
        super().__init__(world, "looker")
        self.scene = scene

    async def run(self):
        self.scene.look()
        async for _ in self.every(seconds(0.05)):
            self.scene.look()


class Driver(Node):
    """Node that presses teleop's keys at given seconds."""

    def __init__(self, world, teleop, presses):
        super().__init__(world, "driver")
        self.teleop, self.presses = teleop, presses

    async def run(self):
        start = self.clock.now()
        for second, key in self.presses:
            await self.clock.sleep_until(start + seconds(second))
            self.teleop.press(key)


DANCE = tuple((4.0 + 0.5 * n, "left" if n % 3 == 2 else "up") for n in range(20))


@pytest.fixture(scope="session")
def turtles():
    """Return a function that returns the turtles' scene after a time, updated throughout."""

    def make(lasting=14.0, presses=DANCE, *, followed=True, extra=lambda world: None):
        world = World(SimClock())
        simulator = Turtlesim(world)
        Broadcaster(world, "broadcaster1", turtle="turtle1")
        if followed:
            Broadcaster(world, "broadcaster2", turtle="turtle2")
            Follower(world, "follower")
        teleop = Teleop(world)
        Driver(world, teleop, presses)
        scene = Scene(world, simulator)
        Looker(world, scene)
        extra(world)
        run(world.clock, live(world, until=world.clock.now() + seconds(lasting)))
        return scene

    return make


@pytest.fixture(scope="session")
def danced(turtles):
    """Return the turtles' scene after 14 s; tests only read it."""
    return turtles()


@pytest.fixture
def frames():
    """Return a function that creates a world of static frames: name -> (parent, x, y)."""

    def make(links):
        from tftool.buffer.sample import TransformStamped

        world = World(SimClock())
        for name, (parent, x, y) in links.items():
            pose = Transform((x, y, 0.0))
            world.broadcast(
                [TransformStamped(seconds(1000), parent, name, pose)], "me", static=True
            )
        return Scene(world)

    return make
