"""Implementation of `tftool export`: write the frames of a source to files of other tools."""

from dataclasses import replace

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, visible
from tftool.base.stamps import LATEST
from tftool.commands.export import ExportOptions
from tftool.commands.shared.connection import WHOLE, Connection, open_from
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.options import refuse
from tftool.commands.shared.pairs import is_chosen, moments_of, pairs_and_place
from tftool.commands.shared.printer import write_json
from tftool.commands.shared.progress_bars import Bar, interruptible
from tftool.frames.export.export import (
    Exported,
    refuse_input,
    write_links,
    write_trajectories,
)
from tftool.frames.export.export_formats import Format, Style, format_of
from tftool.frames.pair_samples import sample
from tftool.recordings.target import refuse_existing


def run(connection: Connection, options: ExportOptions) -> ExitStatus:
    """Run `tftool export`: write trajectories or transforms to a file."""
    style = Style(
        options.precision, options.rpy, options.foxglove, options.with_moving, options.root
    )
    if options.output is None:
        raise UsageError("No file to write is given: add -o FILE.")
    asked, place = pairs_and_place(options.words or [], options.pairs or [])
    form = options.form or format_of(options.output)
    _refuse_misfits(form, asked, options)
    refuse_existing(options.output, force=options.force)
    frames = open_from(connection, place, options.lasting, until=WHOLE)
    refuse_input(frames, options.output)
    bar = Bar(f"Writing {visible(options.output.name)}")
    time = LATEST if options.at is None else options.at.stamp(frames.span[0])
    style = replace(style, time=time)
    try:
        with interruptible():
            if form.is_trajectory:
                moments = moments_of(options, frames)
                name_frames(frames.buffer.frames(), (frame for pair in asked for frame in pair))
                found = [sample(frames.buffer, *pair, moments) for pair in asked]
                done = write_trajectories(
                    found, options.output, form, style, force=options.force, progress=bar
                )
            else:
                done = write_links(
                    frames.buffer, options.output, form, style, force=options.force, progress=bar
                )
    finally:
        bar.stop()
    if options.as_json:
        write_json(_as_object(done))
    else:
        _tell(done)
    return ExitStatus.DONE


def _refuse_misfits(form: Format, pairs: list[tuple[str, str]], options: ExportOptions) -> None:
    """Raise UsageError if an option does not fit the output format."""
    has_root = options.root is not None
    has_at = options.at is not None and not options.with_moving
    refuse(
        (
            form.is_trajectory and not pairs,
            f"{form} contains pairs of frames over time: write tftool export TARGET SOURCE [FROM] "
            "-o FILE.",
        ),
        (
            form.is_trajectory and (has_at or has_root),
            "--at and --root are only allowed for links. For a pair of frames, use --from and "
            "--to.",
        ),
        (
            not form.is_trajectory and pairs,
            f"{form} contains links, not pairs of frames: write tftool export [FROM] -o FILE.",
        ),
        (
            not form.is_trajectory and has_at,
            "--at has no effect on static transforms: leave out --at, or add --with-moving.",
        ),
        (
            is_chosen(options) and not form.is_trajectory,
            f"{form} contains links without times: leave out the options that choose times.",
        ),
    )


def _as_object(exported: Exported) -> dict[str, object]:
    """Return the written files and the number of failed lookups as a mapping, for --json."""
    return {
        "schema": "tftool.export/1",
        "files": [str(path) for path in exported.paths],
        "format": str(exported.format),
        "count": exported.count,
        "pairs": [
            {
                "target": one.target,
                "source": one.source,
                "moments": one.moments,
                "poses": len(one.path) - one.refused,
                "refused": one.refused,
                "reason": one.refusals[0].reason.strip() if one.refusals else None,
            }
            for one in exported.trajectories
        ],
    }


def _tell(exported: Exported) -> None:
    """Report on stderr how many rows were written, and how many were omitted."""
    for one in exported.trajectories:
        if one.refused:
            reason = one.refusals[0].reason.strip()
            notice(
                visible(
                    f"{one.source} in {one.target}: {one.refused} of {len(one.path)} times "
                    f"have no pose and are left out. The first: {reason}"
                )
            )
    what = "pose" if exported.format.is_trajectory else "link"
    if exported.format is Format.mcap:
        what = "transform"
    moments = {one.moments for one in exported.trajectories}
    when = f", {moments.pop()}" if len(moments) == 1 else ""
    names = " and ".join(str(path) for path in exported.paths)
    notice(visible(f"Wrote {count(exported.count, what)} to {names}{when}."))
    if exported.format is Format.kitti:
        notice(
            "KITTI's camera frames have z forward; the poses are written unchanged, in ROS's axes."
        )
