"""`tftool echo`: one transform, printed repeatedly as tf2_echo does."""

from typing import Annotated

import typer

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    WHEN,
    AtOption,
    CacheTime,
    Json,
    Source,
    StampsOf,
    Target,
    decimals,
    finite,
    not_negative,
    option,
    seconds_option,
    within,
)


class EchoOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).

    Waits for the transform and prints the reason of the wait. Then, once a second: translation,
    quaternion (x y z w), roll pitch yaw in radians and degrees, matrix; a terminal shows only the
    newest, with x red, y green and z blue, and with its age. A recording is printed over its whole
    span, or at one moment with --at or --once.

    tftool echo turtle2 turtle1            turtle1 as turtle2 sees it
    tftool echo map laser_link robot --at 12.5
    tftool echo turtle2 turtle1 --offset -5 --fixed-frame world
    """

    target: Target
    source: Source
    place: Annotated[
        str | None,
        typer.Argument(
            metavar="[FROM]",
            help="Whose frames: a scenario (name or file), a recording (file, folder, glob) or a "
            "robot description; if not said, the session that runs, else the turtles. A number "
            "is a rate.",
            show_default=False,
        ),
    ] = None
    rate: Annotated[
        float | None,
        typer.Option(
            "--rate",
            "-r",
            metavar="HZ",
            rich_help_panel=WHEN,
            callback=within(0.001, 1000),
            help="How often; once a second if not said.",
        ),
    ] = None
    once: Annotated[bool, option("Print one transform and stop.", "--once", panel=WHEN)] = False
    count: Annotated[
        int | None,
        typer.Option(
            min=1, metavar="N", rich_help_panel=WHEN, help="Print so many transforms and stop."
        ),
    ] = None
    at: AtOption = None
    stamps_of: StampsOf = None
    offset: Annotated[
        Duration | None,
        seconds_option("Ask about a moment so far from now; -5 is five seconds ago.", check=finite),
    ] = None
    fixed_frame: Annotated[
        str | None,
        option(
            "With --offset: take only SOURCE from that moment and TARGET from now, "
            "by way of this frame, which stands still.",
            metavar="FRAME",
            panel=WHEN,
        ),
    ] = None
    distance: Annotated[
        bool, option("Add how far apart the two frames are, in metres.", "--distance", panel=OUTPUT)
    ] = False
    precision: Annotated[int, decimals("Decimals.")] = 3
    timeout: Annotated[
        Duration | None,
        seconds_option("Give up waiting after so long (exit status 4).", check=not_negative),
    ] = None
    for_programs: Json = False
    cache_time: CacheTime = None
