"""Command `tftool launch`: run launch files without ROS."""

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    RosFree,
    RunFor,
    Simulated,
    SkippedFolders,
    argument,
    flag,
)


class LaunchOptions(Command):
    """Run a ROS 2 launch file without ROS (ros2 launch).

    The file may be Python, XML or YAML. Packages are searched below this folder, or in the src
    folder that contains this folder; nothing is built. turtlesim and turtle_tf2_py are built in.

    tftool launch pkg_tf turtle_following.launch.py source_frame:=carrot1
    tftool launch turtle_tf2_py turtle_tf2_demo.launch.py --for 10
    tftool launch launch/turtle_following.launch.xml --show-args
    """

    words: list[str] = argument(
        "A launch file, or a package and its launch file; then launch arguments.",
        default=...,
        metavar="FILE|PACKAGE [FILE] [NAME:=VALUE]…",
    )
    show_args: bool = flag(
        "Print the arguments of the launch file, and stop.", "-s", "--show-args", "--show-arguments"
    )
    force: RosFree = False
    run_for: RunFor = None
    simulated: Simulated = False
    verbose: SkippedFolders = False
