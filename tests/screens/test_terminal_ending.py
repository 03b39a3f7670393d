"""Tests of the end of the turtles' screen and its world."""

import asyncio

import pytest

from tests.screens.visiting import visit
from tftool.base.errors import NodeFailed, TftoolError
from tftool.base.stamps import seconds
from tftool.screens.terminal.scene import Scene
from tftool.screens.terminal.turtle_app import TurtleApp
from tftool.world.clock import WallClock, run
from tftool.world.node import Node
from tftool.world.supervisor import live
from tftool.world.world import World


def test_q_ends_it(danced):
    async def steps(app, pilot):
        await pilot.press("q")
        await pilot.pause()

    app = visit(danced, (80, 24), steps)

    assert app.return_code == 0
    assert not app.interrupted


class Waiting(Node):
    """Node that runs for ever."""

    async def run(self):
        await self.clock.sleep(seconds(1e6))


class Failing(Node):
    """Node that fails at once."""

    async def run(self):
        await self.clock.sleep(1)
        raise ValueError("out of paint")


def live_app(kind, **how):
    world = World(WallClock())
    kind(world, "painter")
    return TurtleApp(Scene(world), **how), world


def test_a_node_that_fails_ends_the_screen_and_is_named():
    app, world = live_app(Failing)

    with pytest.raises(NodeFailed, match="node 'painter' failed: ValueError: out of paint"):
        run(world.clock, app.run_with_world(live(world), headless=True))

    assert not app.is_running


def test_a_screen_that_fails_says_so_in_a_sentence(monkeypatch):
    app, world = live_app(Waiting)
    monkeypatch.setattr(app.scene, "moment", lambda *_: 1 / 0)

    with pytest.raises(TftoolError, match="the screen failed: ZeroDivisionError: division by zero"):
        run(world.clock, app.run_with_world(live(world), headless=True))


@pytest.mark.parametrize(("action", "interrupted"), [("leave", False), ("interrupt", True)])
def test_leaving_ends_the_world_too(action, interrupted):
    app, world = live_app(Waiting)
    begun, ended = [], []

    async def life():
        begun.append(True)
        try:
            await live(world)
        finally:
            ended.append(True)

    async def main():
        showing = asyncio.ensure_future(app.run_with_world(life(), headless=True))
        while not begun:
            await world.clock.sleep(seconds(0.01))
        getattr(app, f"action_{action}")()
        await showing

    if interrupted:
        with pytest.raises(KeyboardInterrupt):
            run(world.clock, main())
    else:
        run(world.clock, main())

    assert ended == [True]


def test_a_world_that_ends_ends_the_screen():
    app, world = live_app(Waiting)

    run(
        world.clock,
        app.run_with_world(live(world, until=world.clock.now() + seconds(0.05)), headless=True),
    )

    assert not app.is_running


def test_a_cancelled_screen_ends_both():
    app, world = live_app(Waiting)

    async def main():
        showing = asyncio.ensure_future(app.run_with_world(live(world), headless=True))
        while not app.is_running:
            await world.clock.sleep(seconds(0.01))
        showing.cancel()
        with pytest.raises(asyncio.CancelledError):
            await showing

    run(world.clock, main())

    assert not app.is_running
