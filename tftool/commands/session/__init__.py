"""Command `tftool session`: processes, nodes, topics and rates of the running session."""

from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, argument, flag, seconds_option


class SessionOptions(Command, looks_only=True):
    """Show who shares the session that runs here (ros2 node list, ros2 topic list and hz).

    Every process of tftool with its command and start; every node; every topic with its rate; every
    service. Parameter services of nodes and the services of actions are only counted; --verbose and
    --json list them.

    tftool session
    tftool session --connect tcp/localhost:7447
    tftool session ws://robot:8765
    """

    place: str | None = argument(
        "Address of a robot's Foxglove server: ws://robot:8765.", metavar="[FROM]"
    )
    listen_for: Duration = seconds_option(
        "How long to listen for rates; 1 if not given.", "--for", default=seconds(1), panel=None
    )
    verbose: bool = flag(
        "Also list the services that parameters and actions use.", "--verbose", "-v"
    )
    for_programs: Json = False
