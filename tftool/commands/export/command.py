"""`tftool export`: frames to the files of other tools."""

from pathlib import Path

from tftool.base.counts import count
from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import LATEST, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.interrupts import interruptible
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.pairs import moments_of, pairs_and_place, refuse_several_choices
from tftool.commands.shared.recorded import Bar
from tftool.commands.shared.stored import span, stored_frames
from tftool.frames.export.export import (
    Exported,
    Style,
    refuse_input,
    write_links,
    write_trajectories,
)
from tftool.frames.export.export_formats import Format, format_of
from tftool.frames.moment import At
from tftool.frames.pair_samples import sample
from tftool.recordings.target import refuse_existing


def _refuse_misfits(
    form: Format,
    pairs: list[tuple[str, str]],
    at: bool,
    root: str | None,
    *moments: object,
) -> None:
    """Refuse options that contradict what is written.

    Raises:
        UsageError: If one does.
    """
    if form.is_trajectory:
        if not pairs:
            raise UsageError(
                f"{form} holds pairs of frames over time: tftool export TARGET SOURCE [FROM]."
            )
        if at or root is not None:
            raise UsageError("--at and --root go with links; a span has --from and --to.")
    elif pairs:
        raise UsageError(f"{form} holds links, and no pair: tftool export [FROM] -o FILE.")
    elif at:
        raise UsageError("What holds at all times has no moment: --at goes with --with-moving.")
    refuse_several_choices(*moments)
    if any(one is not None for one in moments) and not form.is_trajectory:
        raise UsageError(f"{form} holds links, which are written once: leave out the moments.")


def _tell(done: Exported) -> None:
    """Say on stderr what was written, and what was left out."""
    for one in done.trajectories:
        if one.refused:
            reason = one.refusals[0].reason.strip()
            notice(
                visible(
                    f"{one.source} in {one.target}: {one.refused} of {len(one.path)} moments "
                    f"have no pose and are left out. The first: {reason}"
                )
            )
    what = "pose" if done.format.is_trajectory else "link"
    if done.format is Format.mcap:
        what = "transform"
    moments = {one.moments for one in done.trajectories}
    when = f", {moments.pop()}" if len(moments) == 1 else ""
    names = " and ".join(str(path) for path in done.paths)
    notice(visible(f"Wrote {count(done.count, what)} to {names}{when}."))
    if done.format is Format.kitti:
        notice("KITTI's own frames look along z: these are written as they are.")


def run(
    connection: Connection,
    words: list[str] | None,
    output: Path | None,
    form: Format | None,
    pairs: list[str] | None,
    first: At | None,
    last: At | None,
    every: int | None,
    rate: float | None,
    stamps_of: str | None,
    at: At | None,
    lasting: int | None,
    rpy: bool,
    precision: int,
    root: str | None,
    with_moving: bool,
    foxglove: bool,
    force: bool,
) -> ExitStatus:
    """Run `tftool export`; the parameters are its options."""
    if output is None:
        raise UsageError("Say where to write it: -o FILE.")
    asked, place = pairs_and_place(words or [], pairs or [])
    chosen = form or format_of(output)
    _refuse_misfits(chosen, asked, at is not None and not with_moving, root, stamps_of, every, rate)
    refuse_existing(output, force=force)
    listen = seconds(10) if chosen.is_trajectory or chosen is Format.mcap else seconds(2)
    stored = stored_frames(connection, place, lasting, listen=listen)
    refuse_input(stored, output)
    bar = Bar(f"Writing {visible(output.name)}")
    time = LATEST if at is None else at.stamp(stored.start)
    style = Style(precision, rpy, foxglove, with_moving, root, time)
    try:
        with interruptible():
            if chosen.is_trajectory:
                moments = moments_of(stored, span(stored, first, last), every, rate, stamps_of)
                name_frames(stored.buffer.frames(), (frame for pair in asked for frame in pair))
                found = [sample(stored.buffer, *pair, moments) for pair in asked]
                done = write_trajectories(found, output, chosen, style, force=force, progress=bar)
            else:
                done = write_links(stored.buffer, output, chosen, style, force=force, progress=bar)
    finally:
        bar.stop()
    _tell(done)
    return ExitStatus.DONE
