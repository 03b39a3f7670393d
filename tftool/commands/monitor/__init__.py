"""Command `tftool monitor`: rate and delay of received transforms."""

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    Ascii,
    CacheTime,
    Json,
    Light,
    RunFor,
    argument,
    flag,
    seconds_option,
)


class MonitorOptions(Command, looks_only=True, recordings=True):
    """Show how often and how late transforms arrive (tf2_monitor).

    The report has the rate and the delay of every frame and of every publisher. With two frames A
    and B, it has only the frames between A and B, and the age of the latest transform between them.

    tftool monitor
    tftool monitor turtle2 turtle1
    tftool monitor robot --for 10 --json
    """

    words: list[str] | None = argument(
        "Two frames, for the chain between them; then the source of the frames: a scenario (name "
        "or file) or a recording (file, folder, glob); if not given, the running session, else the "
        "scenario turtles.",
        metavar="[A B] [FROM]",
    )
    run_for: RunFor = None
    every: Duration | None = seconds_option(
        "Time between two reports: 1 on a terminal, 10 elsewhere."
    )
    as_tf2: bool = flag(
        "Print the same numbers as tf2_monitor, including its errors.", "--tf2", panel=OUTPUT
    )
    ascii_only: Ascii = False
    light: Light = False
    for_programs: Json = False
    cache_time: CacheTime = None
