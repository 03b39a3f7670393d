"""`tftool info`: contents of a recording or robot description."""

from typing import Annotated

import typer

from tftool.commands.shared.connection import Connection
from tftool.commands.shared.declaration import declare
from tftool.commands.shared.options import Jobs, Json, Resume, Rows, Scheduler


@declare(recordings=True, descriptions=True, urdf=True)
def info(
    connection: Connection,
    places: Annotated[
        list[str],
        typer.Argument(
            metavar="FROM...",
            help="A recording (file, folder, glob), a robot description, or a launch file or "
            "script of static transforms.",
        ),
    ],
    for_programs: Json = False,
    output: Rows = None,
    processes: Jobs = 1,
    resume: Resume = False,
    scheduler: Scheduler = "",
) -> None:
    """Show what a recording or robot description holds (ros2 bag info).

    Topics with their types, counts and publishers; frames and trees; every edge with its
    rate, who publishes it (by node in ROS 1 bags, by topic else), and its delay: how much
    later than its stamp it was received; damage, oddities, and what the doctor
    finds. On a terminal columns that have no room are left out.
    Of a robot description: joints with limits and mimics, the root, masses where given.
    Of several descriptions and launch files, how many transforms each gives, and every mistake.
    Of several recordings, a line each; with -o, a row each in a file. Where the terminal is
    narrow, columns are left out: 'tftool info run.mcap | cat' has them all.

    tftool info run.mcap
    tftool info robot.urdf
    tftool info 'runs/**/*.mcap' -j 8 -o runs.csv
    """
