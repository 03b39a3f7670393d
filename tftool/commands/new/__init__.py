"""`tftool new`: a new workspace package, or a new scenario."""

from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, option

EXAMPLES = {
    "static": ("static_frame",),
    "broadcaster": ("turtle_broadcaster",),
    "follower": ("turtle_broadcaster", "turtle_follower"),
    "carrot": ("turtle_broadcaster", "turtle_follower", "fixed_carrot"),
    "orbit": ("turtle_broadcaster", "turtle_follower", "moving_carrot"),
    "time_travel": ("turtle_broadcaster", "time_traveller"),
}
"""The steps of the tutorial: the nodes that each has when it is finished."""


class NewOptions(Command, shares=False):
    """Make a package of nodes to begin with (ros2 pkg create).

    It contains a finished step of the tutorial: ROS 2 nodes, a launch file, a test and a scenario
    that tests them. The same files run here and under ROS 2; without it, 'pytest --ros-free' runs
    the test.

    tftool new my_frames
    tftool new my_frames --example carrot --exercise
    tftool new pkg_tf --node-name turtle_tf_broadcaster
    tftool new my_world.yaml --scenario
    """

    name: Annotated[
        str,
        typer.Argument(
            metavar="PACKAGE", help="What to make: a package's name, or a path that ends in it."
        ),
    ]
    example: Annotated[
        str,
        option(f"Which step of the tutorial: {', '.join(EXAMPLES)}.", "--example", metavar="STEP"),
    ] = "follower"
    exercise: Annotated[
        bool, option("Leave the key lines of the step's nodes to you: TODO.", "--exercise")
    ] = False
    node_name: Annotated[
        str, option("Make a package with this empty node instead.", metavar="NAME")
    ] = ""
    scenario: Annotated[
        bool, option("Make a scenario of that name, and nothing else.", "--scenario")
    ] = False
    as_json: Json = False
