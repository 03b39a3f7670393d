"""`tftool record`: a session as a recording."""

from pathlib import Path
from typing import Annotated

import typer

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import OUTPUT, WHEN, Force, Json, RunFor, option, seconds_option


class RecordOptions(Command, looks_only=True):
    """Record a session (ros2 bag record).

    Every file begins with all statics. Ctrl-C ends recording. The file of a killed recorder lacks
    at most the last second; 'tftool edit' repairs it.

    tftool record -o run.mcap
    tftool record -o long --max-duration 600 --all
    tftool record -o before.mcap --ring 30 --on two-parents
    """

    output: Annotated[
        Path,
        option(
            "What to write: a name ending in .mcap, or without a suffix a folder.",
            "--output",
            "-o",
            metavar="FILE",
            panel=OUTPUT,
        ),
    ]
    topics: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[TOPIC]...", help="Topics beside /tf and /tf_static.", show_default=False
        ),
    ] = None
    everything: Annotated[bool, option("Record every topic.", "--all")] = False
    place: Annotated[
        str | None,
        option("Host this scenario, and record what it does.", "--in", metavar="SCENARIO"),
    ] = None
    run_for: RunFor = None
    ring: Annotated[
        Duration | None,
        seconds_option("Keep only so much of the past, in memory, and write it in the end."),
    ] = None
    finding: Annotated[
        str | None,
        option(
            "Write the last minute (--ring) when the doctor finds this, and stop.",
            "--on",
            metavar="FINDING",
            panel=WHEN,
        ),
    ] = None
    max_size: Annotated[
        str | None,
        option("Begin a new file from a size on: 500M, 2G.", metavar="SIZE", panel=OUTPUT),
    ] = None
    max_duration: Annotated[
        Duration | None, seconds_option("Begin a new file after so long.", panel=OUTPUT)
    ] = None
    force: Force = False
    for_programs: Json = False
