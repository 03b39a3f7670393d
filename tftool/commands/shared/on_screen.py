"""Worlds and frames on a full-screen terminal: whether one is available, and the app."""

import os
import sys
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import seconds
from tftool.commands.shared.connection import Connection
from tftool.frames.frames import Frames
from tftool.screens.still_frames import StillFrames
from tftool.world.clock import run
from tftool.world.log import Log
from tftool.world.nodes.remote_turtles import FarTurtles
from tftool.world.nodes.turtle_drivers import Teleop
from tftool.world.nodes.turtlesim import Turtlesim

if TYPE_CHECKING:
    from tftool.drawing.solids import Solids
    from tftool.screens.terminal.scene import Scene
    from tftool.screens.terminal.screen_options import Setting
    from tftool.world.nodes.turtle_drivers import IdleDrawing
    from tftool.world.world import World

SETTLED = seconds(1)
"""When a screen knows which turtles there are."""


def screen_lacks() -> str:
    """Return half a sentence on why no full-screen app is possible; empty if it is."""
    if os.environ.get("TERM") == "dumb":
        return "TERM=dumb is one without a screen"
    # textual draws on stderr, so that one counts too.
    streams = {"stdin": sys.stdin, "stdout": sys.stdout, "stderr": sys.stderr}
    lacking = [name for name, one in streams.items() if one is None or not one.isatty()]
    return f"{lacking[0]} is none" if lacking else ""


def at_rest(connection: Connection, frames: Frames) -> StillFrames:
    """Return frames of a file in the form that screens show, with a clock at their end."""
    start, end = frames.span
    # Where nothing was recorded both are 0, at which no clock can begin.
    clock = connection.providers.still_clock(max(start, 1), max(end, 1))
    return StillFrames(clock, frames.buffer, Log(clock.now))


def simulator_of(world: "World") -> "Turtlesim | None":
    """Return a world's turtle simulator, if it has one."""
    return next((node for node in world.nodes if isinstance(node, Turtlesim)), None)


def driver_of(world: "World", turtle: str) -> "Teleop":
    """Return the node that takes keys for `turtle`, added if there is none.

    Raises:
        UsageError: If that cannot be a turtle's name.
    """
    for node in world.nodes:
        if isinstance(node, Teleop) and node.turtle == turtle:
            return node
    names = {node.name for node in world.nodes}
    name = "teleop_turtle" if "teleop_turtle" not in names else f"teleop_{turtle}"
    return Teleop(world, name, turtle=turtle)


def scene_of(world: "World") -> "Scene":
    """Return the scene of a world, with the turtles of its simulator or of another process."""
    from tftool.screens.terminal.scene import Scene

    scene = Scene(world, simulator_of(world) or FarTurtles(world))

    def take(solids: "Solids") -> None:
        scene.solids = solids

    take_solids(world, "screen", take, lambda told: world.log.warn("screen", told))
    return scene


def take_solids(
    world: "World",
    owner: str,
    take: "Callable[[Solids], object]",
    tell: Callable[[str], object],
) -> None:
    """Call `take` with the shapes of the robot that /robot_description describes, when it comes.

    Args:
        world: World in which the description is published.
        owner: Name of the subscriber.
        take: Takes the shapes.
        tell: Takes sentences about what is not drawn.
    """
    from tftool.drawing.solids import solids_of
    from tftool.robots.mesh_folders import MeshFolders
    from tftool.robots.urdf import parse_description
    from tftool.world.nodes.joints import DESCRIPTION, LATCHED, description_type

    def described(message: Any) -> None:
        try:
            robot = parse_description(message.data)
        except InputError as error:
            tell(f"the description on /{DESCRIPTION} is not drawn: {error}")
            return
        solids, missing = solids_of(robot.links.values(), MeshFolders())
        take(solids)
        if missing:
            tell(f"{len(missing)} shapes are not drawn: {missing[0]}")

    world.subscribe(owner, DESCRIPTION, description_type(), described, LATCHED)


def run_app(
    scene: "Scene",
    life: Coroutine[Any, Any, None],
    driver: "Teleop | None",
    setting: "Setting",
    idle: "IdleDrawing | None" = None,
) -> str | None:
    """Show a scene on the terminal while its world lives.

    Args:
        scene: The scene to show.
        life: Lives the world through; it is cancelled when the user quits.
        driver: The node that receives keys.
        setting: Options of the screen.
        idle: Draws while no key is pressed, where something does.

    Returns:
        The scenario to show instead, where the user chose one.

    Raises:
        NodeFailed: If a node raised.
        KeyboardInterrupt: If a signal or Ctrl-C ended it.
    """
    from tftool.screens.terminal.screen_options import setting_from
    from tftool.screens.terminal.turtle_app import TurtleApp
    from tftool.screens.terminal.world_app import show

    setting = setting_from(os.environ, sys.stdout.encoding or "ascii", setting)
    app = TurtleApp(scene, None if driver is None else _press_of(scene, driver), setting, idle)
    run(scene.world.clock, show(app, life))
    return app.chosen


def _press_of(scene: "Scene", driver: "Teleop") -> Callable[[str], object]:
    """Return the receiver of keys: the driver, or a note if its turtle is missing."""

    def press(key: str) -> None:
        simulator, turtle = scene.simulator, driver.turtle
        # One of another process is known by its poses: they need a moment to come.
        settled = scene.world.clock.now() - scene.start >= SETTLED
        if settled and simulator is not None and turtle not in simulator.turtles:
            scene.missed = turtle
            there = ", ".join(simulator.turtles) or "none"
            raise UsageError(f"there is no turtle '{turtle}' here; there are: {there}")
        driver.press(key)

    return press
