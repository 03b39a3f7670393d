"""`tftool convert`: one rotation, or pose, in every notation."""

import json
import sys
from typing import Annotated

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.options import OUTPUT, Json, option


def convert(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[ROTATION]...",
            help="Numbers or pasted text; - or nothing reads stdin.",
            show_default=False,
        ),
    ] = None,
    form: Annotated[
        str | None,
        option(
            "What bare numbers are: xyzw, wxyz, rpy, ypr, axis-angle, rotvec, matrix, or an "
            "order of axes: s (fixed) or r (rotating) and three axes, as in sxyz or rzyx.",
            "--as",
            metavar="FORM",
        ),
    ] = None,
    degrees: Annotated[
        bool, option("Angles are degrees: what is read, and what --into prints.", "--degrees")
    ] = False,
    then: Annotated[
        list[str] | None,
        option(
            "Chain another one behind it: the pose of its child in the first one's parent. "
            "Again for more.",
            metavar="ROTATION",
        ),
    ] = None,
    inverse: Annotated[
        bool, option("Turn the result round: the parent in the child.", "--inverse")
    ] = False,
    target: Annotated[
        str | None,
        option(
            "Print this form alone, in full precision: one of --as, matrix4, urdf or static.",
            "--into",
            metavar="FORM",
            panel=OUTPUT,
        ),
    ] = None,
    all_orders: Annotated[
        bool, option("Add all 24 orders of Euler angles.", "--all", panel=OUTPUT)
    ] = False,
    for_programs: Json = False,
) -> ExitStatus:
    """Write one rotation, or pose, in every notation.

    Quaternions, roll pitch yaw, Euler angles in any order, axis and angle, rotation vector,
    matrix; pasted as ROS's YAML, a matrix of numpy, tf2_echo's block, a URDF origin or a line
    of static_transform_publisher. Four bare numbers need --as xyzw or --as wxyz.

    tftool convert --as xyzw 0 0 0.7 0.7
    tftool convert rpy 0 0 90 --degrees --then 'rpy 0 pi/2 0' --into xyzw
    tftool convert '<origin xyz="1 0 0" rpy="0 0 1.57"/>' --inverse
    ros2 run tf2_ros tf2_echo map odom | head -6 | tftool convert
    """
    from tftool.base.escaping import visible
    from tftool.commands.shared.notices import notice
    from tftool.drawing import notation_view as view
    from tftool.geometry.notation.rotations import read

    if target is not None and target not in view.TARGETS:
        raise UsageError(
            f"--into {visible(target)}: there is {', '.join(view.TARGETS[:10])}, and orders "
            "of axes such as sxyz."
        )
    if target is not None and (for_programs or all_orders):
        raise UsageError("--into prints one form alone: leave out --json and --all.")
    first = read(_text(words), form, degrees=degrees)
    read_all = [first, *(read(text, form, degrees=degrees) for text in then or ())]
    pose = first.transform
    for one in read_all[1:]:
        pose = pose @ one.transform
    if inverse:
        pose = pose.inverse()
    for one in read_all:
        for note in one.notes:
            notice(visible(note))
    if for_programs:
        content = {"read_as": [one.form for one in read_all], **view.as_object(pose)}
        sys.stdout.write(json.dumps(content, indent=2, allow_nan=False) + "\n")
    elif target is not None:
        sys.stdout.write(view.alone(pose, target, degrees=degrees) + "\n")
    else:
        notice(f"Read as {', then '.join(one.form for one in read_all)}.")
        if view.at_a_pole(pose):
            notice(
                "Pitch is a quarter turn, or almost: roll and yaw turn about one axis there, and "
                "only both together say how far."
            )
        sys.stdout.write(
            view.lines(
                pose,
                with_translation=any(one.has_translation for one in read_all),
                all_orders=all_orders,
            )
        )
    return ExitStatus.DONE


def _text(words: list[str] | None) -> str:
    """What is on the command line, else on stdin."""
    if words and words != ["-"]:
        return " ".join(words)
    if not words and sys.stdin.isatty():
        raise UsageError(
            "Paste a rotation behind 'tftool convert', or pipe it in: "
            "tftool convert --as xyzw 0 0 0.7 0.7"
        )
    from tftool.geometry.notation.rotations import LONGEST

    return sys.stdin.read(LONGEST + 1)
