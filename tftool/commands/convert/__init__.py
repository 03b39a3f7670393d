"""`tftool convert`: one rotation, or pose, in every notation."""

from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import OUTPUT, Json, option
from tftool.geometry.notation.notations import NAMED_FORMS


class ConvertOptions(
    Command,
    shares=False,
    # -1 is a number there, not an option; static_transform_publisher's own may be pasted, too.
    settings={"ignore_unknown_options": True},
):
    """Write one rotation, or pose, in every notation.

    Quaternions, roll pitch yaw, Euler angles in any order, axis and angle, rotation vector,
    matrix; pasted as ROS's YAML, a matrix of numpy, tf2_echo's block, a URDF origin or a line
    of static_transform_publisher. Four bare numbers need --as xyzw or --as wxyz.

    tftool convert --as xyzw 0 0 0.7 0.7
    tftool convert rpy 0 0 90 --degrees --then 'rpy 0 pi/2 0' --into xyzw
    tftool convert '<origin xyz="1 0 0" rpy="0 0 1.57"/>' --inverse
    ros2 run tf2_ros tf2_echo map odom | head -6 | tftool convert
    """

    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[ROTATION]...",
            help="Numbers or pasted text; - or nothing reads stdin.",
            show_default=False,
        ),
    ] = None
    form: Annotated[
        str | None,
        option(
            f"What bare numbers are: {', '.join(NAMED_FORMS)}, or an "
            "order of axes: s (fixed) or r (rotating) and three axes, as in sxyz or rzyx.",
            "--as",
            metavar="FORM",
        ),
    ] = None
    degrees: Annotated[
        bool, option("Angles are in degrees, in the input and in what --into prints.", "--degrees")
    ] = False
    then: Annotated[
        list[str] | None,
        option(
            "Chain another one behind it: the pose of its child in the first one's parent. "
            "Again for more.",
            metavar="ROTATION",
        ),
    ] = None
    inverse: Annotated[
        bool, option("Turn the result round: the parent in the child.", "--inverse")
    ] = False
    target: Annotated[
        str | None,
        option(
            "Print this form alone, in full precision: one of --as, matrix4, urdf or static.",
            "--into",
            metavar="FORM",
            panel=OUTPUT,
        ),
    ] = None
    all_orders: Annotated[
        bool, option("Add all 24 orders of Euler angles.", "--all", panel=OUTPUT)
    ] = False
    for_programs: Json = False
