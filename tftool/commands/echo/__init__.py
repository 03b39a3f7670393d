"""Command `tftool echo`: one transform, printed repeatedly as tf2_echo does."""

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
    argument,
    decimals,
    finite,
    flag,
    not_negative,
    option,
    seconds_option,
    within,
)


class EchoOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).

    The command waits for the transform, and prints why it waits. Then it prints, once a second:
    translation, quaternion (x y z w), roll pitch yaw in radians and degrees, matrix. A terminal
    shows only the newest transform and its age, with x in red, y in green and z in blue. The
    transforms of a recording are printed over its whole span, or at one moment with --at or --once.

    tftool echo turtle2 turtle1            turtle1 as turtle2 sees it
    tftool echo map laser_link robot --at 12.5
    tftool echo turtle2 turtle1 --offset -5 --fixed-frame world
    """

    target: Target
    source: Source
    place: str | None = argument(
        "Source of the frames: a scenario (name or file), a recording (file, folder, glob) or a "
        "robot description; if not given, the running session, else the scenario turtles. A number "
        "in place of FROM is the rate, like --rate.",
        metavar="[FROM]",
    )
    rate: float | None = option(
        "Lookups per second; 1 if not given.",
        "--rate",
        "-r",
        metavar="HZ",
        panel=WHEN,
        callback=within(0.001, 1000),
    )
    once: bool = flag("Print one transform and stop.", panel=WHEN)
    count: int | None = option("Print N transforms and stop.", min=1, metavar="N", panel=WHEN)
    at: AtOption = None
    stamps_of: StampsOf = None
    offset: Duration | None = seconds_option(
        "Look up the transform at now plus SECONDS; -5 means five seconds ago.", check=finite
    )
    fixed_frame: str | None = option(
        "With --offset: look up SOURCE at that moment and TARGET now, through FRAME. This frame, "
        "such as world, must not move between the two moments.",
        metavar="FRAME",
        panel=WHEN,
    )
    distance: bool = flag(
        "Also print the distance between the two frames, in metres.", panel=OUTPUT
    )
    precision: int = decimals("Number of decimals.", default=3)
    timeout: Duration | None = seconds_option(
        "Stop waiting for the transform after SECONDS (exit status 4).", check=not_negative
    )
    for_programs: Json = False
    cache_time: CacheTime = None
