"""Implementation of `tftool teleop`: drive a turtle with arrow keys."""

import math
import sys
from collections.abc import Callable
from typing import Any

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import join_session, open_session
from tftool.commands.shared.on_screen import (
    driver_of,
    run_app,
    screen_lacks,
    screen_setting,
)
from tftool.commands.teleop import TeleopOptions
from tftool.messages.turtle_messages import Pose
from tftool.world.nodes.turtle_drivers import BANNER, KEYS
from tftool.world.nodes.turtlesim import simulator_of
from tftool.world.world import World

START = seconds(5)
"""Nanoseconds before the first key of --keys, after which every turtle of the world exists."""


LOOK = seconds(0.1)


PATIENCE = seconds(10)
"""Longest wait in nanoseconds for a key's effect to end; every effect is shorter."""


def press_all(connection: Connection, turtle: str, keys: str) -> str:
    """Press keys one by one; before each key, wait until the motion of the previous key ends.

    Args:
        connection: Connection of the command.
        turtle: Name of the turtle that the keys drive.
        keys: Names of keys, separated by spaces: "up up left g".

    Returns:
        A sentence with the turtle's new position.

    Raises:
        UsageError: If a key or the turtle does not exist.
    """
    words = keys.replace(",", " ").split()
    for word in words:
        if word.lower() not in KEYS:
            raise UsageError(f"{word!r} is not a key of teleop; the keys are {', '.join(KEYS)}.")
    if not words:
        raise UsageError('--keys needs at least one key, such as --keys "up up left".')
    joined = join_session(connection, needs_turtles=True)
    if joined is not None:
        return joined.run(press_there(joined.world, turtle, words))
    session = open_session(connection, simulated=True, by_hand=True)
    world = session.world
    driver, simulator = driver_of(world, turtle), simulator_of(world)

    async def press() -> str:
        await world.clock.sleep(START)
        if simulator is None or turtle not in simulator.turtles:
            there = ", ".join(simulator.turtles) if simulator is not None else "none"
            raise UsageError(f"There is no turtle {turtle!r} here; there are {there}.")
        for word in words:
            if driver.press(word) == "quit":
                break
            end = world.clock.now() + PATIENCE
            await world.clock.sleep(LOOK)
            while world.clock.now() < end:
                pose = simulator.turtles[turtle].pose
                if pose.linear_velocity == 0.0 and pose.angular_velocity == 0.0:
                    break
                await world.clock.sleep(LOOK)
        pose = simulator.turtles[turtle].pose
        return (
            f"{turtle} is at x {pose.x:.3f}, y {pose.y:.3f}, "
            f"heading {math.degrees(pose.theta):.1f}°."
        )

    return session.run(press())


async def press_there(world: World, turtle: str, words: list[str]) -> str:
    """Press keys in a joined session; after each key, wait until the turtle no longer moves.

    Args:
        world: World of the joined session.
        turtle: Name of the turtle.
        words: Names of the keys.

    Returns:
        A sentence with the turtle's new position.

    Raises:
        UsageError: If the turtle does not exist.
    """
    poses = world.topic(f"{turtle}/pose", Pose)
    # Poses are only received while there is a subscription.
    stop = poses.subscribe(lambda pose: None)
    clock = world.clock

    async def seen(past: int, condition: Callable[[Any], bool]) -> None:
        end = clock.now() + PATIENCE
        while clock.now() < end:
            if poses.count > past and poses.latest is not None and condition(poses.latest):
                return
            await clock.sleep(LOOK)

    try:
        await seen(0, lambda pose: True)
        if poses.latest is None:
            # Our own subscription has created the topic that no turtle publishes.
            names = sorted(set(world.topics()) - {poses.name})
            there = ", ".join(name.removesuffix("/pose") for name in names if "/pose" in name)
            raise UsageError(f"There is no turtle {turtle!r} here; there are {there or 'none'}.")
        driver = driver_of(world, turtle)
        for word in words:
            past = poses.count
            if driver.press(word) == "quit":
                break
            await clock.sleep(LOOK)
            # The command takes effect after a few poses.
            await seen(past + 10, _is_at_rest)
        pose = poses.latest
    finally:
        stop()
    return (
        f"{turtle} is at x {pose.x:.3f}, y {pose.y:.3f}, heading {math.degrees(pose.theta):.1f}°."
    )


def _is_at_rest(pose: Any) -> bool:
    return bool(pose.linear_velocity == 0.0 and pose.angular_velocity == 0.0)


def run(connection: Connection, options: TeleopOptions) -> ExitStatus:
    """Run `tftool teleop`: read keys from the terminal, or press the keys of --keys."""
    connection.refuse_read_only("drive")
    if options.keys is not None:
        typer.echo(press_all(connection, options.turtle, options.keys))
        return ExitStatus.DONE
    if lacking := screen_lacks():
        raise UsageError(
            f"teleop reads keys from a terminal, and {lacking}. "
            'Give the keys on the command line instead: --keys "up up left".'
        )

    # Imported here, because --keys needs no screen.
    from tftool.screens.terminal.scene import scene_of

    session = open_session(connection, needs_turtles=True, by_hand=True)
    driver = driver_of(session.world, options.turtle)
    # Printed before the screen opens, so that it is visible again after the screen closes.
    sys.stdout.write("\n".join(BANNER) + "\n")
    sys.stdout.flush()

    async def live() -> None:
        await session.live(None)

    run_app(
        scene_of(session.world),
        live(),
        driver,
        screen_setting(
            options,
            f"tftool teleop {options.turtle}",
            drive_only=True,
            pair=("turtle1" if options.turtle == "turtle2" else "turtle2", options.turtle),
        ),
    )
    return ExitStatus.DONE
