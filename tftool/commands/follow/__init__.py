"""`tftool follow`: a turtle that follows a frame."""

from typing import Annotated

import typer

from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    CacheTime,
    RunFor,
    finite,
    not_negative,
    option,
    positive,
    seconds_option,
)


class FollowOptions(Command):
    """Let FOLLOWER follow LEADER (the tutorial's turtle_following).

    Spawns FOLLOWER. Once a period it looks up the leader in the follower's frame, and drives there.
    The defaults are the tutorial's.

    tftool follow
    tftool follow turtle1 turtle3
    tftool follow turtle1 turtle2 --delay 5        where turtle1 was 5 s ago
    """

    leader: Annotated[str, typer.Argument(metavar="[LEADER]", help="Frame to follow.")] = "turtle1"
    follower: Annotated[
        str, typer.Argument(metavar="[FOLLOWER]", help="Turtle to spawn and to steer.")
    ] = "turtle2"
    place: Annotated[
        str | None,
        typer.Argument(metavar="[FROM]", help="World to host: a scenario's name or file."),
    ] = None
    period: Annotated[
        Duration, seconds_option("Time between two commands; 1 if not said.", panel=None)
    ] = seconds(1)
    delay: Annotated[
        Duration,
        seconds_option(
            "Go where the leader was so long ago: time travel.",
            check=not_negative,
            panel=None,
        ),
    ] = 0
    fixed_frame: Annotated[
        str, option("Frame that stands still over the delay.", metavar="FRAME")
    ] = "world"
    kp_distance: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Speed per metre of distance.")
    ] = 0.5
    ki_distance: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Speed per metre and second.")
    ] = 0.0
    kd_distance: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Speed per metre a second.")
    ] = 0.0
    kp_bearing: Annotated[
        float,
        typer.Option(callback=finite, metavar="GAIN", help="Turn rate per radian of bearing."),
    ] = 1.0
    ki_bearing: Annotated[
        float,
        typer.Option(callback=finite, metavar="GAIN", help="Turn rate per radian and second."),
    ] = 0.0
    kd_bearing: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Turn rate per radian a second.")
    ] = 0.0
    integral_limit: Annotated[
        float | None,
        typer.Option(
            callback=not_negative, metavar="LIMIT", help="Most that an integral adds to a command."
        ),
    ] = None
    dead_band: Annotated[
        float,
        typer.Option(
            metavar="METRES", callback=not_negative, help="Distance that counts as there."
        ),
    ] = 0.0
    max_speed: Annotated[
        float | None,
        typer.Option(
            metavar="M/S", callback=positive, help="Most it drives; no limit if not said."
        ),
    ] = None
    stale_after: Annotated[
        Duration | None,
        seconds_option(
            "Stop when the leader's newest transform is older; never, if not said.", panel=None
        ),
    ] = None
    run_for: RunFor = None
    cache_time: CacheTime = None
