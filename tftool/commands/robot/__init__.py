"""Command `tftool robot`: publish a robot description, and move its joints by keys."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    Ascii,
    Force,
    Light,
    Meshes,
    RunFor,
    argument,
    flag,
    option,
    output_file,
    within,
)


class RobotOptions(Command, descriptions=True):
    """Publish a robot, and move its joints (robot_state_publisher).

    Fixed joints are published on /tf_static, other joints on /tf, the description on
    /robot_description. Arrow keys move a joint between its limits; digits type a position; z, c and
    r move all joints to zero, to the middle, to random positions. The robot is drawn in 3-D beside
    the sliders; Shift+arrows turn the picture. To watch the robot from another terminal, run tftool
    tree or tftool view.

    tftool robot arm.urdf
    tftool robot arm.urdf.xacro size:=large --joint elbow=30deg
    tftool robot arm.urdf --follow --no-screen
    tftool robot arm.urdf --joint elbow=30deg -o arm.svg
    """

    place: str = argument("A robot description: URDF or xacro.", default=..., metavar="FILE")
    link: str | None = option(
        "Link whose pose is shown; if not given, the link farthest from the root.",
        "--link",
        metavar="LINK",
    )
    follow: bool = flag(
        "Move no joint; take the positions from the /joint_states that other nodes publish."
    )
    no_screen: bool = flag("Publish until stopped, without sliders.")
    rate: float = option(
        "Rate at which frames and joint states are published.",
        "--rate",
        "-r",
        default=20.0,
        metavar="HZ",
        callback=within(0.1, 1000),
    )
    frame_prefix: str = option(
        "Prefix of the name of every frame, such as left/.", default="", metavar="PREFIX"
    )
    meshes: Meshes = None
    output: Path | None = output_file(
        "Draw the robot into a file, .svg or .png, and publish nothing."
    )
    force: Force = False
    run_for: RunFor = None
    ascii_only: Ascii = False
    light: Light = False
