"""Implementation of `tftool edit`: change the frames of recordings; repair, join and cut them."""

import itertools
import math
import re
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import as_seconds
from tftool.buffer.forest import stripped
from tftool.buffer.sample import TransformStamped
from tftool.commands.edit import EditOptions
from tftool.commands.shared.notices import notice
from tftool.commands.shared.options import refuse
from tftool.commands.shared.printer import write_json
from tftool.commands.shared.progress_bars import Bar, interruptible
from tftool.frames.source_options import At
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform
from tftool.messages.transform_rows import LONGEST_NAME
from tftool.recordings.edit.changes import Edits, LinkName, fits
from tftool.recordings.edit.rewrite import EditReport
from tftool.recordings.edit.rewrite import edit as rewrite
from tftool.recordings.find import Kind, find
from tftool.recordings.recording import open_recording
from tftool.robots.robot_model import load_urdf

_PLURAL = re.compile(r"^((?:other )?(?:message|stamp|static|transform))s\b(?! that are)")
"""Plural of the noun that a line of the report begins with, if the line has no other plural."""


def _tell(report: EditReport, output: Path, *, dry_run: bool, for_programs: bool) -> None:
    if for_programs:
        document = {
            "output": str(output),
            "files": report.files,
            "written": not dry_run,
            "messages": report.messages,
            "changes": dict(report.counts),
            "notes": report.notes,
        }
        write_json(document)
        return
    for note in report.notes:
        notice(visible(note))
    done = "would be written" if dry_run else "written, read again and found equal"
    many = f" ({len(report.files)} files)" if len(report.files) > 1 else ""
    written = f"messages {done}: {visible(str(output))}{many}"
    for what, count in (*report.counts.items(), (written, report.messages)):
        if count == 1:
            what = _PLURAL.sub(r"\1", what)
        sys.stdout.write(f"{count:>9,} {what}\n")


def _moments(
    names: list[str], start: At | None, end: At | None, *, by_record_time: bool
) -> tuple[int | None, int | None]:
    """Return the values of --from and --to as stamps; None for an option that was not given."""
    if start is None and end is None:
        if by_record_time:
            raise UsageError(
                "--record-time is only allowed with --from or --to: add --from or --to."
            )
        return None, None
    epoch = last = 0
    if any(one is not None and not one.is_stamp for one in (start, end)):
        spans = []
        for name in names:
            with open_recording(name) as recording:
                source = recording.source
                first = source.start if by_record_time else recording.start or 0
                # Messages of other topics may be later than the last transform.
                spans.append((first, max(recording.end or 0, first + source.end - source.start)))
        epoch = min((first for first, _ in spans if first), default=0)
        last = max(over for _, over in spans)
    low = start.stamp(epoch) if start is not None else None
    high = end.stamp(epoch) if end is not None else None
    meant = "" if start is None or start.stamp(epoch) <= last else start.meant(epoch, last)
    if meant:
        lasts = as_seconds(last - epoch)
        raise UsageError(
            f"The recording lasts {lasts:g} s: --from {start} is after its end.{meant}"
        )
    if low is not None and high is not None and high < low:
        raise UsageError("--to is before --from: exchange the two times.")
    return low, high


def _link(option: str, text: str) -> LinkName:
    parent, colon, child = text.partition(":")
    if not colon or not parent or not child:
        raise UsageError(f"{option} takes PARENT:CHILD, such as base_link:laser, not '{text}'.")
    return stripped(parent), stripped(child)


def _renamed(text: str) -> tuple[str, str]:
    old, equals, new = text.partition("=")
    if not equals or not old or not new:
        raise UsageError(f"--rename takes OLD=NEW, such as laser=lidar, not '{text}'.")
    return stripped(old), _frame("--rename", new)


def _prefix(text: str) -> str:
    name = _frame("--prefix", text)
    if name[-1].isalnum():
        # ROS 1's tf_prefix inserted a slash here, ROS 2's frame_prefix inserts none.
        raise UsageError(
            f"--prefix {text} would rename base_link to {name}base_link: end the prefix in a "
            f"slash, --prefix {name}/"
        )
    return name


def _frame(option: str, text: str) -> str:
    """Check a frame name or prefix, and return the name without a leading slash."""
    name = stripped(text)
    if not name.strip():
        raise UsageError(f"{option}: '{text}' has an empty frame name: write the name of a frame.")
    if name != name.strip() or not name.isprintable() or len(name.encode()) > LONGEST_NAME:
        raise UsageError(f"{option}: '{text}' is not a valid name of a frame.")
    if name.startswith("/") or "//" in name:
        raise UsageError(
            f"{option}: '{text}' has an empty part between two slashes: remove one slash."
        )
    return name


def _pose(text: str) -> "tuple[LinkName, tuple[float, ...]]":
    name, _, listed = text.partition("=")
    link = _link("--set", name)
    numbers = []
    for word in listed.split(","):
        plain = word.strip().removesuffix("deg")
        try:
            value = float(plain)
        except ValueError:
            raise UsageError(f"--set {name}: '{word.strip()}' is not a number.") from None
        if not math.isfinite(value):
            raise UsageError(f"--set {name}: '{word.strip()}' is not a finite number.")
        numbers.append(math.radians(value) if plain != word.strip() else value)
    if len(numbers) == 6:
        return link, (*numbers[:3], *quaternion_from_rpy(*numbers[3:]))
    if len(numbers) != 7:
        raise UsageError(
            f"--set {name} takes 6 numbers (x, y, z, roll, pitch, yaw) or 7 (x, y, z, then "
            f"the quaternion x, y, z, w), not {len(numbers)}."
        )
    length = math.sqrt(sum(value * value for value in numbers[3:]))
    if abs(length - 1.0) > 1e-3:
        raise UsageError(f"--set {name}: the quaternion's length is {length:g}, not 1.")
    return link, (*numbers[:3], *(value / length for value in numbers[3:]))


def _reparented(text: str) -> "tuple[LinkName, str]":
    name, equals, new = text.partition("=")
    link = _link("--reparent", name)
    if not equals or not new:
        raise UsageError(f"--reparent takes PARENT:CHILD=NEW, not '{text}'.")
    return link, stripped(new)


def _repeated(pairs: Sequence[tuple[str, object]]) -> str:
    """Return the first name that has two different values; "" if there is none."""
    counts = Counter(name for name, _ in dict.fromkeys(pairs))
    return next((name for name, count in counts.items() if count > 1), "")


def _overlapping(poses: Sequence[tuple[LinkName, tuple[float, ...]]]) -> tuple[str, ...]:
    """Return the first two patterns that name a common link, but set different poses; or ()."""
    for (first, pose), (second, other) in itertools.combinations(poses, 2):
        is_common = all(
            one == two or "*" in (one, two) for one, two in zip(first, second, strict=True)
        )
        if is_common and pose != other:
            return ":".join(first), ":".join(second)
    return ()


def _statics(name: str) -> "tuple[TransformStamped, ...]":
    """Return the static transforms of a robot description or a recording.

    If a recording has several static transforms of one child frame, only the last is returned.
    """
    found = find(name)
    samples: dict[str, TransformStamped] = {}
    if found.kind is Kind.DESCRIPTION:
        robot = load_urdf(found.paths[0])
        for sample in robot.transforms():
            if robot.joint_above(sample.child_frame_id).type == "fixed":
                samples[sample.child_frame_id] = sample
    else:
        with open_recording(name) as recording:
            edges = [edge for edge in recording.edges if edge.static and len(edge)]
        for edge in sorted(edges, key=lambda one: int(one.messages[-1])):
            x, y, z = edge.translations[-1].tolist()
            qx, qy, qz, qw = edge.rotations[-1].tolist()
            pose = Transform((x, y, z), (qx, qy, qz, qw))
            samples[edge.child] = TransformStamped(
                int(edge.stamps[-1]), edge.parent, edge.child, pose
            )
    if not samples:
        raise UsageError(
            f"'{name}' has no static transforms: choose another file for --statics-from."
        )
    return tuple(samples.values())


def run(options: EditOptions) -> ExitStatus:
    """Run `tftool edit`: write the changed recording."""
    if options.restamp not in (None, "log"):
        raise UsageError(
            f"--restamp takes only 'log', the time of reception, not '{options.restamp}'."
        )
    low, high = _moments(
        options.names, options.start, options.end, by_record_time=options.by_record_time
    )
    drop = tuple(_link("--drop", text) for text in options.drop or ())
    rename = [_renamed(text) for text in options.rename or ()]
    prefixes = [_prefix(text) for text in options.prefix or ()]
    poses = [_pose(text) for text in options.poses or ()]
    reparent = [_reparented(text) for text in options.reparent or ()]
    statics = _statics(options.statics_from) if options.statics_from is not None else ()
    changed = dict.fromkeys(link for link, _ in (*poses, *reparent))
    dropped = [":".join(link) for link in changed if any(fits(link, one) for one in drop)]
    children = {stripped(one.child_frame_id) for one in statics}
    replaced = [":".join(link) for link in changed if link[1] in children]
    repeated = {
        "--rename": _repeated(rename),
        "--prefix": _repeated([("every frame", one) for one in prefixes]),
        "--set": _repeated([(":".join(link), pose) for link, pose in poses]),
        "--reparent": _repeated([(":".join(link), parent) for link, parent in reparent]),
    }
    overlapping = _overlapping(poses)
    refuse(
        *(
            (name, f"{option} is given twice for {name}, with different values: leave one out.")
            for option, name in repeated.items()
        ),
        (
            overlapping,
            f"--set {' and --set '.join(overlapping)} give one link different poses: leave one "
            "out.",
        ),
        (
            dropped,
            f"--drop removes {', '.join(dropped)}, which --set or --reparent changes: leave one "
            "out.",
        ),
        (
            replaced,
            f"--statics-from replaces {', '.join(replaced)}, which --set or --reparent changes: "
            "leave one out.",
        ),
    )
    edits: Edits = Edits(
        drop=drop,
        rename=dict(rename),
        prefix="".join(prefixes[:1]),
        strip_slash=options.strip_slash,
        poses=dict(poses),
        reparent=dict(reparent),
        statics_first=options.statics_first,
        statics_from=statics,
        start=low,
        end=high,
        by_record_time=options.by_record_time,
        shift=options.shift,
        restamp=options.restamp == "log",
        everywhere=options.everywhere,
        split_every=options.split_every,
    )
    if options.everywhere and not (edits.names or edits.stamps):
        raise UsageError(
            "--everywhere is only allowed with --rename, --prefix, --strip-slash or --shift: add "
            "one of these options."
        )
    bar = Bar(f"Editing {visible(options.names[0])}")
    try:
        with interruptible():
            report = rewrite(
                options.names,
                options.output,
                edits,
                force=options.force,
                dry_run=options.dry_run,
                ros2=options.ros2,
                progress=bar,
            )
    finally:
        bar.stop()
    _tell(report, options.output, dry_run=options.dry_run, for_programs=options.for_programs)
    return ExitStatus.DONE
