"""Implementation of `tftool diff`: compare two sets of frames, and print the differences."""

import sys
from pathlib import Path

from tftool.base.errors import LinkError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration
from tftool.commands.diff import DiffOptions
from tftool.commands.shared.connection import WHOLE, Connection, listen_from, open_from
from tftool.commands.shared.notices import notice
from tftool.commands.shared.options import refuse
from tftool.commands.shared.pairs import pairs_and_place
from tftool.commands.shared.printer import line_width, write_json
from tftool.drawing import difference_view as view
from tftool.drawing import figure
from tftool.drawing.calibration_view import clock_object
from tftool.frames.calibration.body_motion import CalibrationRefused
from tftool.frames.calibration.clock_offset import clock_offset
from tftool.frames.differences import Allowance, Side, compare, side_of
from tftool.frames.pair_samples import only_chain, sample
from tftool.frames.trajectory_errors import Pair, PieceLength, trajectory_errors
from tftool.recordings.target import refuse_existing, whole_file
from tftool.world.link.session_world import NOTHING_RUNS

SESSION = "session"
"""Word on the command line for the running session."""


def run(connection: Connection, options: DiffOptions) -> ExitStatus:
    """Run `tftool diff`: compare frames, trajectories or clocks of two sources."""
    _refuse_contradictions(options)
    pairs, step = _pairs(options.pairs or []), PieceLength.read(options.per)
    words = options.first, options.second
    first, second = (_side(connection, word, options.lasting) for word in words)
    if options.clock_offset:
        return _measure_clocks(options, (first, second), pairs)
    if options.ape or options.rpe:
        _measure_errors(options, (first, second), pairs, step)
        return ExitStatus.DONE
    allowed = Allowance(options.millimetres, options.degrees, options.rate_percent)
    found = compare(first, second, allowed, align_starts=options.align == "start")
    for note in found.notes:
        notice(visible(note))
    if options.for_programs:
        write_json(view.as_object(found))
    elif options.markdown:
        sys.stdout.write(view.as_markdown(found))
    else:
        sys.stdout.write(view.lines(found, line_width(), everything=options.everything))
    return ExitStatus.FAILED if found else ExitStatus.DONE


def _refuse_contradictions(options: DiffOptions) -> None:
    """Raise UsageError if options contradict each other, or the output cannot be written."""
    output, measures = options.output, options.ape or options.rpe
    is_chosen = (options.fit, options.match, options.per) != ("none", "nearest", "1")
    refuse(
        (
            options.for_programs and options.markdown,
            "--json and --markdown are two output formats: leave one out.",
        ),
        (
            options.first == options.second == SESSION,
            "A and B are both the running session: replace one by a recording, a scenario or a "
            "description.",
        ),
        (
            options.clock_offset and measures,
            "--clock-offset cannot be combined with --ape and --rpe: leave one out.",
        ),
        (
            options.clock_offset and (options.markdown or output is not None),
            "--clock-offset cannot be combined with --markdown and -o: leave one out.",
        ),
        (
            not (options.clock_offset or measures)
            and (options.pairs or output or options.force or is_chosen),
            "--pair, --fit, --match, --per, -o and --force need --ape or --rpe: add one of the "
            "two.",
        ),
        (
            measures and options.markdown,
            "--markdown cannot be combined with --ape and --rpe: use --json.",
        ),
        (
            measures and options.align is not None,
            "--align cannot be combined with --ape and --rpe: leave one out.",
        ),
        (
            output is not None and _form(output) not in figure.FORMATS,
            f"cannot draw to '{output}': end it in .svg, .pdf or .png.",
        ),
    )
    if output is not None:
        refuse_existing(output, force=options.force)


def _form(output: Path) -> str:
    return output.suffix.lower().removeprefix(".")


def _measure_clocks(
    options: DiffOptions, sides: tuple[Side, Side], pairs: tuple[Pair | None, Pair | None]
) -> ExitStatus:
    paths = [
        sample(side.buffer, *(only_chain(side.buffer) if pair is None else pair)).answered()
        for side, pair in zip(sides, pairs, strict=True)
    ]
    try:
        found = clock_offset(*paths)
    except CalibrationRefused as refusal:
        if options.for_programs:
            write_json({"clock_offset": None, "why": str(refusal)}, indent=None)
        notice(visible(f"{refusal} To record next: {refusal.next_motion}."))
        return ExitStatus.FAILED
    if options.for_programs:
        write_json({"clock_offset": clock_object(found)}, indent=None)
    else:
        sys.stdout.write(
            f"t_A = t_B {found.seconds:+.6f} s ± {found.interval95 * 1e3:.1f} ms "
            f"(correlation {found.correlation:.3f}, next peak {found.second:.3f})\n"
        )
    return ExitStatus.DONE


def _measure_errors(
    options: DiffOptions,
    sides: tuple[Side, Side],
    pairs: tuple[Pair | None, Pair | None],
    step: PieceLength,
) -> None:
    """Compute the errors of --ape and --rpe; print the errors and, if requested, draw plots."""
    first, second = sides
    found = trajectory_errors(
        first.buffer,
        second.buffer,
        pairs,
        kinds=tuple(name for name in ("ape", "rpe") if getattr(options, name)),
        fit=options.fit,
        match=options.match,
        step=step,
    )
    names = first.name, second.name
    if options.output is not None:
        title = f"errors of {second.name} against {first.name}"
        with whole_file(options.output, force=options.force) as file:
            figure.write_panels(view.panels(found), title, file, _form(options.output))
        notice(visible(f"Drew {found.matched} matched poses to {options.output}."))
    if options.for_programs:
        write_json(view.errors_as_object(found, names))
    else:
        sys.stdout.write(view.error_lines(found, names, line_width()))


def _side(connection: Connection, source: str, duration: Duration | None) -> Side:
    """Open the frames of one source, A or B; listen to a session for `duration`.

    Raises:
        InputError: If `source` names no source of frames, or the file cannot be read.
        LinkError: If `source` is "session", and no session runs.
    """
    if source != SESSION:
        return side_of(open_from(connection, source, duration, until=WHOLE, shares=True), source)
    frames = listen_from(connection, duration)
    if frames is None:
        raise LinkError(NOTHING_RUNS)
    return side_of(frames, source)


def _pairs(values: list[str]) -> tuple[Pair | None, Pair | None]:
    """Parse the values of --pair; return the pair of frames for A and the pair of frames for B.

    A single value is for both. Without --pair, both are None: A and B must have one chain each.

    Raises:
        UsageError: If --pair is given more than twice, or a value is not TARGET:SOURCE.
    """
    pairs, _ = pairs_and_place([], values)
    if len(pairs) > 2:
        raise UsageError(
            "--pair is given more than twice: give one pair for both sources, or one for A and one "
            "for B."
        )
    return (pairs[0], pairs[-1]) if pairs else (None, None)
