"""`tftool monitor`: rate and delay of received transforms."""

from typing import Annotated

import typer

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import OUTPUT, CacheTime, Json, RunFor, option, seconds_option


class MonitorOptions(Command, looks_only=True, recordings=True):
    """Show how often and how late transforms arrive (tf2_monitor).

    Also shows the publishers. Without frames, all links; with two frames, the chain between them
    and the age of its latest transform.

    tftool monitor
    tftool monitor turtle2 turtle1
    tftool monitor robot --for 10 --json
    """

    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[A B] [FROM]",
            help="Two frames, for the chain between them; then whose frames: a scenario (name or "
            "file) or a recording (file, folder, glob); if not said, the session that runs, else "
            "the turtles.",
            show_default=False,
        ),
    ] = None
    run_for: RunFor = None
    every: Annotated[
        Duration | None, seconds_option("Time between two reports: 1 on a terminal, 10 elsewhere.")
    ] = None
    as_tf2: Annotated[
        bool, option("Print tf2_monitor's own numbers, its flaws included.", "--tf2", panel=OUTPUT)
    ] = False
    for_programs: Json = False
    cache_time: CacheTime = None
