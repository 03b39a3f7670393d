"""A host and a guest, each with a zenoh session, in one event loop."""

import asyncio

from tests.patience import PATIENCE
from tests.world.link.conftest import new_world, until
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.world.clock import WallClock, run
from tftool.world.link.graph import Role
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link


def sample(stamp, child="turtle1", x=1.0):
    return TransformStamped(stamp, "world", child, Transform((x, 2.0, 0.0)))


class Two:
    """A host and a guest in one loop, each with a world and a zenoh session of its own."""

    def __init__(self, guest=None, host=None):
        self.host = Link(host or Options("demo"))
        self.here = new_world()
        self.host.attach(self.here, role=Role.HOST)
        self.guest = Link(guest or Options("echo"))
        self.there = new_world()
        self.guest.attach(self.there, role=Role.GUEST)

    async def __aenter__(self):
        await until(lambda: self.guest.graph.processes() or self.guest.options.domain)
        return self

    async def __aexit__(self, *error):
        self.guest.close()
        self.host.close()


def play(coroutine):
    return run(WallClock(), asyncio.wait_for(coroutine, PATIENCE))


def texts(world):
    return [record.text for record in world.log.records if record.node == "link"]
