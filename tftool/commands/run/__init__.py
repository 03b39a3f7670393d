"""Command `tftool run`: run a user's node without ROS."""

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    RosFree,
    RunFor,
    Simulated,
    SkippedFolders,
    argument,
    option,
)


class RunOptions(
    Command,
    # Options after FILE are for the node.
    settings={"allow_interspersed_args": False},
):
    """Run a node written for ROS 2, unmodified, without ROS (ros2 run).

    The file's imports of rclpy, tf2_ros, geometry_msgs and so on are provided by tftool. A package
    is searched below this folder, or in the src folder that contains this folder; nothing is built.
    Options of 'tftool run' itself go before FILE. To test a node with a scenario, run tftool check
    SCENARIO --run FILE.

    tftool run turtle_tf_broadcaster.py --ros-args -p turtlename:=turtle1
    tftool run pkg_tf turtle_following --ros-args -p source_frame:=carrot1
    tftool run --in robot --simulated --for 20 my_listener.py
    """

    target: str = argument("A node's file, or a package.", default=..., metavar="FILE|PACKAGE")
    rest: list[str] | None = argument(
        "Executable of a package, then arguments of the node, then --ros-args and arguments of ROS "
        "2.",
        metavar="[EXECUTABLE] [ARGUMENTS] [--ros-args …]",
    )
    place: str | None = option(
        "Scenario to host for the node: its name or file.", "--in", metavar="SCENARIO"
    )
    force: RosFree = False
    run_for: RunFor = None
    simulated: Simulated = False
    verbose: SkippedFolders = False
