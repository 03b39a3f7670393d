"""`tftool teleop`: arrow keys drive a turtle."""

import sys
from typing import Annotated

import typer

from tftool.cli.app import ExitStatus
from tftool.cli.connection import Connection
from tftool.cli.options import Ascii, Light
from tftool.errors import UsageError


def teleop(
    connection: Connection,
    turtle: Annotated[str, typer.Argument(metavar="[TURTLE]", help="Whom to drive.")] = "turtle1",
    keys: Annotated[
        str | None,
        typer.Option(
            "--keys",
            metavar="KEYS",
            help='Press these instead of reading any, one after the other: "up up left g".',
        ),
    ] = None,
    ascii_only: Ascii = False,
    light: Light = False,
) -> ExitStatus:
    """Drive a turtle with the arrow keys (ros2 run turtlesim turtle_teleop_key).

    One press moves the turtle for a second. The eight letters round f turn it to
    the heading at which they lie: t is north-east. f gives a turn up, q quits.

    tftool teleop
    tftool teleop turtle2
    tftool teleop --keys "up up left up"
    """
    from tftool.cli.hosting import open_session
    from tftool.cli.onscreen import driver_of, has_terminal, run_app
    from tftool.nodes.teleop import BANNER

    connection.refuse_read_only("drive")
    if keys is not None:
        from tftool.cli.scripted_keys import press_all

        typer.echo(press_all(connection, turtle, keys))
        return ExitStatus.DONE
    if not has_terminal():
        raise UsageError(
            "teleop reads keys from a terminal, and there is none here. "
            'Give the keys on the command line instead: --keys "up up left".'
        )

    from tftool.screens.setting import Setting

    session = open_session(connection, needs_turtles=True, by_hand=True)
    driver = driver_of(session.world, turtle)
    # Said before the screen is taken, so that it can be read after it is given back too.
    sys.stdout.write("\n".join(BANNER) + "\n")
    sys.stdout.flush()

    async def live() -> None:
        await session.live(None)

    run_app(
        session.world,
        live(),
        driver,
        Setting(
            title=f"tftool teleop {turtle}",
            drive_only=True,
            banner=BANNER,
            ascii_only=ascii_only,
            light=light,
        ),
    )
    return ExitStatus.DONE
