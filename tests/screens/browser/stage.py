"""A world and its page in a separate thread, beside the thread that drives a browser."""

import asyncio
import threading

from tests.patience import PATIENCE
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.geometry.rigid import Transform
from tftool.screens.browser.drawn_messages import LiveDisplays
from tftool.screens.browser.server import PageServer
from tftool.world.clock import WallClock, run
from tftool.world.link.zenoh.rendezvous import page_secret
from tftool.world.world import World


class Stage:
    def __init__(self, *, port=0, scenario=None, lived=0.0):
        self._port = port
        self._scenario = scenario
        self._lived = seconds(lived)
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()
        assert self._ready.wait(PATIENCE)
        return self

    def __exit__(self, *error):
        self.end()

    @property
    def url(self):
        return self._page.url

    def address(self, path):
        """Return the address of a path of the page's server, with its secret."""
        return self._page.address(path)

    @property
    def port(self):
        return self._page.port

    def do(self, action):
        """Call `action(world)` in the world's thread and return its result."""

        async def call():
            return action(self._world)

        return asyncio.run_coroutine_threadsafe(call(), self._loop).result(PATIENCE)

    def put(self, x, y=0.0, *, at=1.0, parent="world", child="turtle", rotation=(0, 0, 0, 1)):
        """Broadcast one transform, with a stamp in seconds after the clock's epoch."""

        def broadcast(world):
            stamp = world.clock.epoch + seconds(at)
            pose = Transform((x, y, 0.0), rotation)
            world.broadcast([TransformStamped(stamp, parent, child, pose)], "test")

        self.do(broadcast)

    def mount(self, *links, x=0.0):
        """Broadcast static transforms, given as (parent, child)."""
        pose = Transform((x, 0.0, 0.0))
        transforms = [TransformStamped(0, parent, child, pose) for parent, child in links]
        self.do(lambda world: world.broadcast(transforms, "mount", static=True))

    def show(self, robot):
        """Show a robot on the page."""
        self.do(lambda world: self._page.show_robot(robot))

    def pictures(self):
        """Return how many pictures the open pages got; each comes after the last was drawn."""
        return self.do(lambda world: sum(client.sent for client in self._page.clients))

    def end(self):
        """End the session, and notify its page."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._over.set)
            self._thread.join(PATIENCE)

    def _run(self):
        if self._scenario is not None:
            session = open_session(Connection(), self._scenario, head_start=self._lived)
            session.run(self._serve(session.world))
            return
        clock = WallClock()
        run(clock, self._serve(World(clock)))

    async def _serve(self, world):
        self._world = world
        self._loop = asyncio.get_running_loop()
        self._over = asyncio.Event()
        async with PageServer(world, port=self._port, secret=page_secret()) as self._page:
            self._page.show_live(LiveDisplays(world))
            running = asyncio.ensure_future(self._page.run())
            self._ready.set()
            await self._over.wait()
            running.cancel()
