"""`tftool convert`: one rotation, or pose, in every notation."""

import json
import sys

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.notices import notice
from tftool.drawing import notation_view as view
from tftool.geometry.notation.notations import NAMED_FORMS
from tftool.geometry.notation.rotations import LONGEST, read


def _text(words: list[str] | None) -> str:
    """Return the text from the command line, else from stdin."""
    if words and words != ["-"]:
        return " ".join(words)
    if not words and sys.stdin.isatty():
        raise UsageError(
            "Paste a rotation behind 'tftool convert', or pipe it in: "
            "tftool convert --as xyzw 0 0 0.7 0.7"
        )

    return sys.stdin.read(LONGEST + 1)


def run(
    words: list[str] | None,
    form: str | None,
    degrees: bool,
    then: list[str] | None,
    inverse: bool,
    target: str | None,
    all_orders: bool,
    for_programs: bool,
) -> ExitStatus:
    """Run `tftool convert`; the parameters are its options."""
    if target is not None and target not in view.TARGETS:
        known = ", ".join((*NAMED_FORMS, *view.POSE_FORMS))
        raise UsageError(
            f"--into {visible(target)}: there is {known}, and orders of axes such as sxyz."
        )
    if target is not None and (for_programs or all_orders):
        raise UsageError("--into prints only one form: leave out --json and --all.")
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
                "Pitch is ±90°, or almost: roll and yaw turn about the same axis there, so that "
                "only their sum or difference is determined."
            )
        sys.stdout.write(
            view.lines(
                pose,
                with_translation=any(one.has_translation for one in read_all),
                all_orders=all_orders,
            )
        )
    return ExitStatus.DONE
