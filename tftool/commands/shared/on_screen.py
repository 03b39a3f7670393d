"""Full-screen display of a world in the terminal, and a check whether the display is possible."""

import os
import sys
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, Protocol

from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.commands.shared.connection import Connection
from tftool.frames.frames import Frames
from tftool.screens.still_frames import StillFrames
from tftool.world.clock import run
from tftool.world.log import Log
from tftool.world.nodes.turtle_drivers import Teleop

if TYPE_CHECKING:
    from tftool.screens.terminal.scene import Scene
    from tftool.screens.terminal.screen_options import Setting
    from tftool.world.nodes.turtle_drivers import IdleDrawing
    from tftool.world.world import World

SETTLED = seconds(1)
"""Nanoseconds after which a screen knows all turtles."""


def screen_lacks() -> str:
    """Return why a full-screen display is impossible, as part of a sentence; "" if possible."""
    if os.environ.get("TERM") == "dumb":
        return "TERM=dumb has no screen"
    # textual draws on stderr, so stderr must be a terminal, too.
    streams = {"stdin": sys.stdin, "stdout": sys.stdout, "stderr": sys.stderr}
    lacking = [name for name, one in streams.items() if one is None or not one.isatty()]
    return f"{lacking[0]} is not a terminal" if lacking else ""


class ScreenOptions(Protocol):
    """Options of every command that has a screen; `Ascii` and `Light` declare these options."""

    ascii_only: bool
    light: bool


def screen_setting(options: ScreenOptions, title: str, **further: Any) -> "Setting":
    """Return the options of a command's screen, restricted to what the terminal can show.

    Args:
        options: Options of the command.
        title: Title for the top line.
        further: Further attributes of `Setting`.
    """
    from tftool.screens.terminal.screen_options import Setting, setting_from

    wanted = Setting(title=title, ascii_only=options.ascii_only, light=options.light, **further)
    return setting_from(os.environ, sys.stdout.encoding or "ascii", wanted)


def at_rest(connection: Connection, frames: Frames) -> StillFrames:
    """Return a file's frames for a screen, with a clock that always shows the end of the file."""
    start, end = frames.span
    # In an empty recording both are 0, which is not a valid time of a clock.
    clock = connection.providers.still_clock(max(start, 1), max(end, 1))
    return StillFrames(clock, frames.buffer, Log(clock.now))


def driver_of(world: "World", turtle: str) -> "Teleop":
    """Return the node that converts keys to motions of a turtle; create the node if it is missing.

    Raises:
        UsageError: If `turtle` is not a valid name of a turtle.
    """
    for node in world.nodes:
        if isinstance(node, Teleop) and node.turtle == turtle:
            return node
    names = {node.name for node in world.nodes}
    name = "teleop_turtle" if "teleop_turtle" not in names else f"teleop_{turtle}"
    return Teleop(world, name, turtle=turtle)


def run_app(
    scene: "Scene",
    life: Coroutine[Any, Any, None],
    driver: "Teleop | None",
    setting: "Setting",
    idle: "IdleDrawing | None" = None,
) -> str | None:
    """Show a scene on the terminal while its world runs.

    Args:
        scene: Scene to show.
        life: Coroutine that runs the world; cancelled when the user quits.
        driver: Node that receives the keys; None if no turtle can be driven.
        setting: Options of the screen.
        idle: Node that drives a turtle while no key is pressed; None without such a node.

    Returns:
        Name of the scenario that the user chose to show next; None if the user quit.

    Raises:
        NodeFailed: If a node raised an error.
        KeyboardInterrupt: If a signal or Ctrl-C ended the display.
    """
    from tftool.screens.terminal.turtle_app import TurtleApp

    app = TurtleApp(scene, None if driver is None else _press_of(scene, driver), setting, idle)
    run(scene.world.clock, app.run_with_world(life))
    return app.chosen


def _press_of(scene: "Scene", driver: "Teleop") -> Callable[[str], object]:
    """Return a function that passes keys to the driver.

    The function raises UsageError if the driver's turtle does not exist.
    """

    def press(key: str) -> None:
        simulator, turtle = scene.simulator, driver.turtle
        # Turtles of another process are known by their poses, which take a while to arrive.
        settled = scene.world.clock.now() - scene.start >= SETTLED
        if settled and simulator is not None and turtle not in simulator.turtles:
            scene.missed = turtle
            there = ", ".join(simulator.turtles) or "none"
            raise UsageError(f"there is no turtle '{turtle}' here; there are: {there}")
        driver.press(key)

    return press
