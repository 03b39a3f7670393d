"""`tftool launch`: launch files without ROS."""

from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import RosFree, RunFor, Simulated, SkippedFolders, option


class LaunchOptions(Command):
    """Launch what a ROS 2 launch file says, without ROS (ros2 launch).

    The file may be Python, XML or YAML. Packages are searched below this folder, or in the src that
    contains it; nothing is built. turtlesim and turtle_tf2_py are built in.

    tftool launch pkg_tf turtle_following.launch.py source_frame:=carrot1
    tftool launch turtle_tf2_py turtle_tf2_demo.launch.py --for 10
    tftool launch launch/turtle_following.launch.xml --show-args
    """

    words: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE|PACKAGE [FILE] [NAME:=VALUE]…",
            help="A launch file, or a package and its launch file; then arguments.",
        ),
    ]
    show_args: Annotated[
        bool, option("Show what the file takes.", "-s", "--show-args", "--show-arguments")
    ] = False
    force: RosFree = False
    run_for: RunFor = None
    simulated: Simulated = False
    verbose: SkippedFolders = False
