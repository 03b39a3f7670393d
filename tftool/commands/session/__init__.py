"""`tftool session`: who takes part, what they publish, how often, and since when."""

from typing import Annotated

import typer

from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, option, seconds_option


class SessionOptions(Command, looks_only=True):
    """Show who shares the session that runs here (ros2 node list, ros2 topic list and hz).

    Every process of tftool with its command and start; every node; every topic with its rate; every
    service. Parameter services of nodes and the services of actions are only counted; --verbose and
    --json list them.

    tftool session
    tftool session --connect tcp/localhost:7447
    tftool session ws://robot:8765
    """

    place: Annotated[
        str | None,
        typer.Argument(
            metavar="[FROM]",
            help="Address of a robot's Foxglove server: ws://robot:8765.",
            show_default=False,
        ),
    ] = None
    listen_for: Annotated[
        Duration,
        seconds_option(
            "How long to listen for rates; 1 if not said.",
            "--for",
            panel=None,
        ),
    ] = seconds(1)
    verbose: Annotated[
        bool, option("List the services of parameters and actions, too.", "--verbose", "-v")
    ] = False
    for_programs: Json = False
