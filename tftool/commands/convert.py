"""Command `tftool convert`: one rotation, or pose, in every notation."""

import sys

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.notices import notice
from tftool.commands.shared.options import OUTPUT, Json, argument, flag, option
from tftool.commands.shared.printer import write_json
from tftool.drawing import notation_view as view
from tftool.geometry.notation.notations import NAMED_FORMS
from tftool.geometry.notation.rotations import LONGEST, read


class ConvertOptions(
    Command,
    shares=False,
    # -1 is a number here, and pasted options of static_transform_publisher are allowed.
    settings={"ignore_unknown_options": True},
):
    """Write one rotation, or pose, in every notation.

    The input is a quaternion, roll pitch yaw, Euler angles in any order, axis and angle, a rotation
    vector or a matrix. ROS's YAML, a matrix of numpy, tf2_echo's block, a URDF origin or a line of
    static_transform_publisher can be pasted. Four bare numbers need --as xyzw or --as wxyz.

    tftool convert --as xyzw 0 0 0.7 0.7
    tftool convert rpy 0 0 90 --degrees --then 'rpy 0 pi/2 0' --into xyzw
    tftool convert '<origin xyz="1 0 0" rpy="0 0 1.57"/>' --inverse
    ros2 run tf2_ros tf2_echo map odom | head -6 | tftool convert
    """

    words: list[str] | None = argument(
        "Numbers, or pasted text. With -, or without words, stdin is read.", metavar="[ROTATION]..."
    )
    form: str | None = option(
        f"Meaning of numbers without names: {', '.join(NAMED_FORMS)}, or an order of axes: s "
        "(fixed) or r (rotating) and three axes, as in sxyz or rzyx.",
        "--as",
        metavar="FORM",
    )
    degrees: bool = flag("Angles are in degrees, in the input and in the output of --into.")
    then: list[str] | None = option(
        "Append another pose: the result is the pose of the last child in the first parent. "
        "Repeat the option for more poses.",
        metavar="ROTATION",
    )
    inverse: bool = flag("Invert the result: print the pose of the parent in the child.")
    target: str | None = option(
        "Print only this form, in full precision: a form of --as, matrix4, urdf or static.",
        "--into",
        metavar="FORM",
        panel=OUTPUT,
    )
    all_orders: bool = flag("Also print all 24 orders of Euler angles.", "--all", panel=OUTPUT)
    for_programs: Json = False


def _text(words: list[str] | None) -> str:
    """Return the text to convert: from the command line, else from stdin."""
    if words and words != ["-"]:
        return " ".join(words)
    if not words and sys.stdin.isatty():
        raise UsageError(
            "No rotation is given: write or pipe in a rotation, as in "
            "'tftool convert --as xyzw 0 0 0.7 0.7'."
        )

    return sys.stdin.read(LONGEST + 1)


def run(options: ConvertOptions) -> ExitStatus:
    """Run `tftool convert`: print a rotation or pose in every notation."""
    if options.target is not None and options.target not in view.TARGETS:
        known = ", ".join((*NAMED_FORMS, *view.POSE_FORMS))
        raise UsageError(
            f"--into {visible(options.target)} is not a notation: choose one of {known}, or an "
            "order of axes such as sxyz."
        )
    if options.target is not None and (options.for_programs or options.all_orders):
        raise UsageError("--into prints only one form: leave out --json and --all.")
    first = read(_text(options.words), options.form, degrees=options.degrees)
    read_all = [
        first,
        *(read(text, options.form, degrees=options.degrees) for text in options.then or ()),
    ]
    pose = first.transform
    for one in read_all[1:]:
        pose = pose @ one.transform
    if options.inverse:
        pose = pose.inverse()
    for one in read_all:
        for note in one.notes:
            notice(visible(note))
    if options.for_programs:
        content = {"read_as": [one.form for one in read_all], **view.as_object(pose)}
        write_json(content)
    elif options.target is not None:
        sys.stdout.write(view.alone(pose, options.target, degrees=options.degrees) + "\n")
    else:
        notice(f"Read as {', then '.join(one.form for one in read_all)}.")
        if view.at_a_pole(pose):
            notice(
                "Pitch is ±90°, or almost: roll and yaw turn about the same axis there, so that "
                "only their sum or difference is determined."
            )
        sys.stdout.write(
            view.lines(
                pose,
                with_translation=any(one.has_translation for one in read_all),
                all_orders=options.all_orders,
            )
        )
    return ExitStatus.DONE
