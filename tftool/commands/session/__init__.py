"""Command `tftool session`: processes, nodes, topics and rates of the running session."""

from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, argument, flag, seconds_option


class SessionOptions(Command, looks_only=True):
    """Show the running session's processes, nodes and topics (ros2 node list, topic list, hz).

    The output lists every tftool process with its command and start time, every node, every topic
    with its rate, and every service. Parameter services of nodes and the services of actions are
    only counted; --verbose and --json list these services too.

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
