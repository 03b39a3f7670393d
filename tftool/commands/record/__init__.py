"""Command `tftool record`: record a session."""

from pathlib import Path

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    WHEN,
    Force,
    Json,
    RunFor,
    argument,
    flag,
    option,
    seconds_option,
)


class RecordOptions(Command, looks_only=True):
    """Record a session (ros2 bag record).

    Every file begins with all static transforms. Ctrl-C ends the recording. If the recorder is
    killed, the file lacks at most the last second, and 'tftool edit' repairs the file.

    tftool record -o run.mcap
    tftool record -o long --max-duration 600 --all
    tftool record -o before.mcap --ring 30 --on two-parents
    """

    output: Path = option(
        "File to write: a name that ends in .mcap; a name without a suffix becomes a folder.",
        "--output",
        "-o",
        default=...,
        metavar="FILE",
        panel=OUTPUT,
    )
    topics: list[str] | None = argument(
        "Topics to record in addition to /tf and /tf_static.", metavar="[TOPIC]..."
    )
    everything: bool = flag("Record every topic.", "--all")
    place: str | None = option(
        "Host this scenario, and record its topics.", "--in", metavar="SCENARIO"
    )
    run_for: RunFor = None
    ring: Duration | None = seconds_option(
        "Keep only the last SECONDS, in memory, and write them when the recording ends."
    )
    finding: str | None = option(
        "Stop when the doctor has this finding, and write the messages of the last minute, or of "
        "the time of --ring.",
        "--on",
        metavar="FINDING",
        panel=WHEN,
    )
    max_size: str | None = option(
        "Begin a new file when a file reaches this size: 500M, 2G.", metavar="SIZE", panel=OUTPUT
    )
    max_duration: Duration | None = seconds_option("Begin a new file every SECONDS.", panel=OUTPUT)
    force: Force = False
    for_programs: Json = False
