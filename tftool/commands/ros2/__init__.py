"""Command `tftool ros2`: commands of ROS 2's command line, for tftool's sessions."""

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, RunFor, argument, option


class Ros2Options(
    Command,
    # Options after COMMAND are ROS 2's.
    settings={"allow_interspersed_args": False},
):
    """Run commands of ROS 2's command line on a session, without ROS.

    topic list, echo, find, hz, bw, delay, info, type, pub; service list, type, info, find, call;
    param list, get, set, delete, dump, load, describe; node list, info; action list, type, info,
    send_goal; interface show, list, package, packages, proto; pkg list, executables, prefix, xml;
    test FILE runs a file of launch tests, in real time. Each command has the options that it has in
    ROS 2. Options of 'tftool ros2' itself go before COMMAND.

    tftool ros2 topic list
    tftool ros2 service call /spawn turtlesim/srv/Spawn "{x: 2, y: 2}"
    tftool ros2 topic pub turtle1/cmd_vel geometry_msgs/msg/Twist "linear: {x: 2}"
    """

    words: list[str] = argument(
        "The words that you would write after ros2.", default=..., metavar="COMMAND VERB …"
    )
    place: str | None = option("Scenario to host: its name or file.", "--in", metavar="SCENARIO")
    run_for: RunFor = None
    as_json: Json = False
