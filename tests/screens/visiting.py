"""The turtles' screen in a test, with some size and keys."""

import asyncio

from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.turtle_app import TurtleApp


def screen(app):
    """Return the lines on the screen."""
    return [strip.text for strip in app.screen._compositor.render_strips(app.size)]


def visit(scene, size, steps, press=None, **setting):
    """Show a scene on a screen of some size; `steps` presses keys on it."""
    app = TurtleApp(scene, press, Setting(title="tftool demo turtles", **setting))

    async def main():
        async with app.run_test(size=size) as pilot:
            await settled(pilot)
            await steps(app, pilot)

    asyncio.run(main())
    if app.failure is not None:
        raise app.failure
    return app


async def settled(pilot):
    await pilot.pause()
    pilot.app.redraw()
    await pilot.pause()


def shown(scene, size=(100, 30), keys=(), press=None, **setting):
    """Return the screen after some keys."""
    lines = []

    async def steps(app, pilot):
        await pilot.press(*keys)
        await settled(pilot)
        lines.extend(screen(app))

    visit(scene, size, steps, press, **setting)
    return lines


def told(lines):
    """Return the top line, and the panels beside the picture."""
    return [lines[0], *(line.rpartition("││")[2] for line in lines[1:-2])]
