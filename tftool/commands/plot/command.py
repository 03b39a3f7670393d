"""Implementation of `tftool plot`: transforms over time, from a file or live from a session."""

import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, visible
from tftool.base.stamps import Stamp
from tftool.commands.plot import PlotOptions
from tftool.commands.shared.connection import WHOLE, Connection, open_from
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.options import refuse
from tftool.commands.shared.pairs import is_chosen, moments_of, pairs_and_place
from tftool.commands.shared.printer import write_json
from tftool.commands.shared.progress_bars import interruptible
from tftool.drawing import figure
from tftool.drawing import line_plot as view
from tftool.frames.pair_samples import Trajectory, sample
from tftool.frames.pair_series import PlotCurve, chosen, panels, shades
from tftool.recordings.target import refuse_existing, whole_file


def drawn(
    options: PlotOptions,
    trajectories: list[Trajectory],
    start: Stamp,
    console: Console,
    *,
    margin: int = 0,
    height: int | None = None,
    span: tuple[float, float] | None = None,
    hidden: frozenset[int] | None = None,
) -> Text:
    """Draw transforms over time as text for a console.

    Args:
        options: Options of the command.
        trajectories: Transforms over time.
        start: Time that is 0 on the axis.
        console: Console to print on; without a terminal, the plot is 80 columns wide.
        margin: Number of columns that the plot leaves free.
        height: Number of lines; None for a suitable number.
        span: Seconds since `start` that the axis covers; None for all data.
        hidden: Numbers of the curves that the user has hidden; None if no keys are read.
    """
    width = (console.width if console.is_terminal else 80) - margin
    ascii_only = options.ascii_only or console.options.ascii_only
    has_colors = console.color_system is not None and not console.no_color
    look = view.PlotLook(
        width,
        height,
        ascii_only,
        options.light,
        numbered=hidden is not None,
        hidden=hidden or frozenset(),
        marked=ascii_only or (console.is_terminal and not has_colors),
    )
    if options.from_above:
        return view.from_above(trajectories, look)
    return view.over_time(trajectories, start, _quantities(options), look, span=span)


def _quantities(options: PlotOptions) -> Sequence[str]:
    """Return the quantities listed in --only.

    Raises:
        UsageError: If a word of --only names no quantity.
    """
    return chosen([one for text in options.only or () for one in text.split(",") if one.strip()])


def run(connection: Connection, options: PlotOptions) -> ExitStatus:
    """Run `tftool plot`: draw, print or write the plot."""
    asked, place = pairs_and_place(options.words or [], options.pairs or [])
    if not asked:
        raise UsageError("Nothing to plot is given: write tftool plot TARGET SOURCE [FROM].")
    _quantities(options)
    is_live = (
        options.output is None and place is None and sys.stdout.isatty() and not options.as_json
    )
    refuse(
        (
            options.from_above and options.only,
            "--xy draws a path, but --only chooses curves over time: leave one out.",
        ),
        (
            options.output is None and (options.dark or options.force),
            "--dark and --force are only allowed with -o FILE: add -o FILE.",
        ),
        (
            options.as_json and options.output is not None,
            "--json prints values, but -o draws a picture: leave one out.",
        ),
        (
            options.as_json and options.from_above,
            "--json prints values over time, but --xy draws a path: leave one out.",
        ),
        (
            options.window is not None and not is_live,
            "--window is only allowed for a live plot on a terminal: leave out --window, or use "
            "--from and --to.",
        ),
        (
            is_live and (is_chosen(options) or options.first or options.last),
            "A live plot shows the time of --window up to now: leave out the other options of "
            "time, or name a FROM.",
        ),
    )
    if is_live:
        from tftool.commands.plot.plot_live import plot_live

        plot_live(connection, options, asked)
        return ExitStatus.DONE
    if options.output is not None:
        _refuse_output(options.output, force=options.force)
    frames = open_from(connection, place, options.lasting, until=WHOLE)
    moments = moments_of(options, frames)
    name_frames(frames.buffer.frames(), (frame for pair in asked for frame in pair))
    found = [sample(frames.buffer, *pair, moments) for pair in asked]
    start = frames.start or min(int(one.path.stamps[0]) for one in found)
    if options.output is not None:
        _write(options, options.output, found, start)
    elif options.as_json:
        write_json(_as_object(found, start, _quantities(options)), indent=None)
    else:
        _print(options, found, start)
    return ExitStatus.DONE


def _curve(curve: PlotCurve, pair: Trajectory) -> dict[str, object]:
    known = curve.values[np.isfinite(curve.values)]
    return {
        "label": curve.label,
        "target": pair.target,
        "source": pair.source,
        "least": float(known.min()) if len(known) else None,
        "greatest": float(known.max()) if len(known) else None,
        "last": float(known[-1]) if len(known) else None,
        "times_s": curve.times.tolist(),
        "values": [one if math.isfinite(one) else None for one in curve.values.tolist()],
    }


def _as_object(
    trajectories: list[Trajectory], start: Stamp, quantities: Sequence[str]
) -> dict[str, object]:
    """Return the curves as a mapping, for --json, with null where a curve is interrupted."""
    return {
        "schema": "tftool.plot/1",
        "start_ns": start,
        "panels": [
            {
                "title": panel.title,
                "unit": panel.unit,
                "curves": [_curve(one, trajectories[one.place]) for one in panel.curves],
            }
            for panel in panels(trajectories, start, quantities)
        ],
        "refused": [
            {"first_s": one.first, "last_s": one.last, "reason": one.reason.strip()}
            for one in shades(trajectories, start)
        ],
    }


def _form(output: Path) -> str:
    return output.suffix.lower().removeprefix(".")


def _refuse_output(output: Path, *, force: bool) -> None:
    if _form(output) not in figure.FORMATS:
        raise UsageError(f"'{output}' has no known suffix: end it in .svg, .pdf or .png.")
    refuse_existing(output, force=force)


def _write(options: PlotOptions, output: Path, found: list[Trajectory], start: Stamp) -> None:
    with interruptible(), whole_file(output, force=options.force) as file:
        figure.write(
            found,
            file,
            _form(output),
            start=start,
            quantities=_quantities(options),
            xy=options.from_above,
            dark=options.dark,
        )
    moments = count(sum(len(one.path) for one in found), "moment")
    notice(visible(f"Drew {moments} to {output}."))


def _print(options: PlotOptions, found: list[Trajectory], start: Stamp) -> None:
    console = Console()
    # The last line is left for the prompt.
    height = console.height - 1 if console.is_terminal else None
    text = drawn(options, found, start, console, height=height)
    if not console.is_terminal:
        sys.stdout.write(text.plain)
        return
    with console.capture() as captured:
        console.print(text, end="")
    sys.stdout.write(captured.get())
