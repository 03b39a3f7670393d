"""Compare two sets of frames, and print what differs."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

from tftool.base.errors import LinkError, UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration
from tftool.commands.diff import DiffOptions
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.notices import notice
from tftool.commands.shared.open_from import WHOLE, listen_from, open_from
from tftool.commands.shared.options import refuse
from tftool.commands.shared.pairs import pairs_and_place
from tftool.commands.shared.printer import line_width
from tftool.drawing import difference_view as view
from tftool.drawing import figure
from tftool.drawing import trajectory_error_view as error_view
from tftool.drawing.calibration_view import clock_object
from tftool.frames.calibration.clock_offset import clock_offset
from tftool.frames.calibration.motion import CalibrationRefused
from tftool.frames.diff import side_of
from tftool.frames.differences import Allowance, Side, compare
from tftool.frames.export.trajectory_files import whole_file
from tftool.frames.pair_samples import only_chain, sample
from tftool.frames.trajectory_errors import Fit, Match, Pair, PieceLength, trajectory_errors
from tftool.recordings.target import refuse_existing
from tftool.world.link.heard_frames import NOTHING_RUNS

SESSION = "session"
"""The word that names the session that runs."""


def run(connection: Connection, options: DiffOptions) -> ExitStatus:
    """Run `tftool diff`."""
    refuse(
        (
            options.for_programs and options.markdown,
            "--json and --markdown are two ways to print it: leave one out.",
        ),
        (
            options.first == options.second == SESSION,
            "The session that runs is one: name what it is compared with.",
        ),
    )
    if options.clock_offset:
        refuse(
            (options.ape or options.rpe, "--clock-offset goes without --ape and --rpe."),
            (
                options.markdown or options.output is not None,
                "--clock-offset goes without --markdown and -o.",
            ),
        )
        sides = (
            _side(connection, options.first, options.lasting),
            _side(connection, options.second, options.lasting),
        )
        return _measure_clocks(*sides, options.pairs or [], for_programs=options.for_programs)
    errors = ErrorOptions.of(
        options.ape,
        options.rpe,
        options.pairs,
        options.fit,
        options.match,
        options.per,
        options.output,
        options.force,
    )
    if errors is not None:
        refuse(
            (options.markdown, "--markdown does not go with --ape and --rpe: --json does."),
            (options.align is not None, "--align does not go with --ape and --rpe."),
        )
        sides = (
            _side(connection, options.first, options.lasting),
            _side(connection, options.second, options.lasting),
        )
        errors.measure(*sides, for_programs=options.for_programs)
        return ExitStatus.DONE
    found = compare(
        _side(connection, options.first, options.lasting),
        _side(connection, options.second, options.lasting),
        Allowance(options.millimetres, options.degrees, options.rate_percent),
        align_starts=options.align == "start",
    )
    for note in found.notes:
        notice(visible(note))
    if options.for_programs:
        sys.stdout.write(json.dumps(view.as_object(found), indent=2, allow_nan=False) + "\n")
    elif options.markdown:
        sys.stdout.write(view.as_markdown(found))
    else:
        sys.stdout.write(view.lines(found, line_width(), everything=options.everything))
    return ExitStatus.FAILED if found else ExitStatus.DONE


def _measure_clocks(
    first: Side, second: Side, words: list[str], *, for_programs: bool
) -> ExitStatus:
    pairs = pairs_of_sides(words)
    paths = [
        sample(side.buffer, *(only_chain(side.buffer) if pair is None else pair)).answered()
        for side, pair in zip((first, second), pairs, strict=True)
    ]
    try:
        found = clock_offset(*paths)
    except CalibrationRefused as refusal:
        if for_programs:
            sys.stdout.write(json.dumps({"clock_offset": None, "why": str(refusal)}) + "\n")
        notice(visible(f"{refusal} To record next: {refusal.next_motion}."))
        return ExitStatus.FAILED
    if for_programs:
        sys.stdout.write(json.dumps({"clock_offset": clock_object(found)}) + "\n")
    else:
        sys.stdout.write(
            f"t_A = t_B {found.seconds:+.6f} s ± {found.interval95 * 1e3:.1f} ms "
            f"(correlation {found.correlation:.3f}, next peak {found.second:.3f})\n"
        )
    return ExitStatus.DONE


def _side(connection: Connection, word: str, lasting: Duration | None) -> Side:
    """Open one side's FROM.

    Raises:
        InputError: If it names nothing, or cannot be read.
        LinkError: If it is the session, and none runs.
    """
    if word != SESSION:
        return side_of(open_from(connection, word, lasting, until=WHOLE, shares=True), word)
    frames = listen_from(connection, lasting)
    if frames is None:
        raise LinkError(NOTHING_RUNS)
    return side_of(frames, word)


def pairs_of_sides(words: list[str]) -> tuple[Pair | None, Pair | None]:
    """Return the pairs of A and of B named by --pair; without it, the only chain of each.

    Raises:
        UsageError: If there are more than two, or a word is not a pair.
    """
    pairs, _ = pairs_and_place([], words)
    if len(pairs) > 2:
        raise UsageError("--pair is given once for both files, or twice: for A, then for B.")
    return (pairs[0], pairs[-1]) if pairs else (None, None)


@dataclass(frozen=True, slots=True)
class ErrorOptions:
    """Options of --ape and --rpe.

    Attributes:
        kinds: "ape", "rpe", or both.
        pairs: Target and source in A, and in B; None for the only chain.
        fit: Alignment of B with A.
        match: Rule by which poses are matched.
        step: Length of the pieces of the relative error.
        output: Picture to write; None for none.
        force: Whether it may replace a file.
    """

    kinds: tuple[str, ...]
    pairs: tuple[Pair | None, Pair | None]
    fit: Fit
    match: Match
    step: PieceLength
    output: Path | None
    force: bool

    @classmethod
    def of(
        cls,
        ape: bool,
        rpe: bool,
        words: list[str] | None,
        fit: Fit,
        match: Match,
        per: str,
        output: Path | None,
        force: bool,
    ) -> "ErrorOptions | None":
        """Check the options; return None if neither --ape nor --rpe is given.

        Raises:
            UsageError: If one is given that they do not use, or is no such value.
        """
        if not ape and not rpe:
            used = words or output or force or (fit, match, per) != ("none", "nearest", "1")
            if used:
                raise UsageError(
                    "--pair, --fit, --match, --per, -o and --force go with --ape or --rpe: add one."
                )
            return None
        if output is not None:
            if output.suffix.lower().removeprefix(".") not in figure.FORMATS:
                raise UsageError(f"cannot draw to '{output}': end it in .svg, .pdf or .png.")
            refuse_existing(output, force=force)
        kinds = tuple(name for name, wanted in (("ape", ape), ("rpe", rpe)) if wanted)
        return cls(
            kinds, pairs_of_sides(words or []), fit, match, PieceLength.read(per), output, force
        )

    def measure(self, first: Side, second: Side, *, for_programs: bool) -> None:
        """Measure the errors, print them, and draw them on request."""
        found = trajectory_errors(
            first.buffer,
            second.buffer,
            self.pairs,
            kinds=self.kinds,
            fit=self.fit,
            match=self.match,
            step=self.step,
        )
        names = first.name, second.name
        if self.output is not None:
            form = self.output.suffix.lower().removeprefix(".")
            title = f"errors of {second.name} against {first.name}"
            with whole_file(self.output, force=self.force) as file:
                figure.write_panels(error_view.panels(found), title, file, form)
            notice(visible(f"Drew {found.matched} matched poses to {self.output}."))
        if for_programs:
            written = json.dumps(error_view.as_object(found, names), indent=2, allow_nan=False)
            sys.stdout.write(written + "\n")
        else:
            sys.stdout.write(error_view.lines(found, names, line_width()))
