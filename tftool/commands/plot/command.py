"""`tftool plot`: a pair of frames over time, in the terminal or as a picture."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.live import Live
from rich.text import Text

from tftool.base.counts import count
from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.interrupts import interruptible
from tftool.commands.shared.keypresses import keyboard
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.pairs import moments_of, pairs_and_place
from tftool.commands.shared.stored import span, stored_frames
from tftool.commands.shared.suspend import left_while_stopped
from tftool.drawing import line_plot as view
from tftool.drawing.figure import FORMATS, write
from tftool.frames.export.trajectory_files import whole_file
from tftool.frames.moment import At
from tftool.frames.pair_samples import Moments, Trajectory, sample
from tftool.frames.pair_series import chosen
from tftool.recordings.target import refuse_existing
from tftool.world.clock import Phase
from tftool.world.stopping import leave_screen
from tftool.world.world import World

ON_ITS_WAY = seconds(1)
"""What is no older than that may still arrive; a live plot ends where it has not."""


def _form_of(output: Path, force: bool) -> str:

    form = output.suffix.lower().removeprefix(".")
    if form not in FORMATS:
        raise UsageError(f"'{output}' does not say what to draw: end it in .svg, .pdf or .png.")
    refuse_existing(output, force=force)
    return form


@dataclass(frozen=True, slots=True)
class _Plotted:
    """What is plotted, and how it is painted in the terminal."""

    quantities: Sequence[str]
    from_above: bool
    ascii_only: bool
    light: bool

    def text(
        self,
        found: "list[Trajectory]",
        start: Stamp,
        console: Console,
        *,
        height: int | None = None,
        span: tuple[float, float] | None = None,
    ) -> Text:
        """Draw pairs in the width of a console.

        Args:
            found: The pairs.
            start: The moment that is 0 on the axis.
            console: Where it goes; 80 wide unless it is a terminal.
            height: Lines there are; as many as are good if None.
            span: Seconds since `start` that the axis covers; from data to data if None.
        """
        width = console.width if console.is_terminal else 80
        ascii_only = self.ascii_only or console.options.ascii_only
        look = view.PlotLook(width, height, ascii_only, self.light)
        if self.from_above:
            return view.from_above(found, look)
        return view.over_time(found, start, self.quantities, look, span=span)


def _write(
    found: "list[Trajectory]",
    output: Path,
    form: str,
    start: Stamp,
    plotted: _Plotted,
    *,
    dark: bool,
    force: bool,
) -> None:

    quantities, xy = plotted.quantities, plotted.from_above
    with interruptible(), whole_file(output, force=force) as file:
        write(found, file, form, start=start, quantities=quantities, xy=xy, dark=dark)
    moments = count(sum(len(one.path) for one in found), "moment")
    notice(visible(f"Drew {moments} to {output}."))


def _print(found: "list[Trajectory]", start: Stamp, plotted: _Plotted) -> None:

    console = Console()
    text = plotted.text(found, start, console)
    if not console.is_terminal:
        sys.stdout.write(text.plain)
        return
    with console.capture() as captured:
        console.print(text, end="")
    sys.stdout.write(captured.get())


def _live(
    connection: Connection,
    pairs: list[tuple[str, str]],
    plotted: _Plotted,
    window: Duration,
    lasting: Duration | None,
) -> None:
    """Draw a session as it goes on, until q is pressed or it is stopped."""
    console = Console()
    session = open_session(connection, None, cache_time=window + seconds(1))
    world = session.world
    world.clock.when_killed.add(leave_screen, "screen")
    start = min(world.clock.now(), world.clock.epoch) or world.clock.now()

    typed: set[str] = set()

    async def draw() -> None:
        with (
            keyboard(typed.add) as takes_keys,
            Live(console=console, auto_refresh=False, screen=True) as live,
            left_while_stopped(live.stop, live.start),
        ):
            hint = "q quits" if takes_keys else ""
            due = world.clock.now()
            end = None if lasting is None else due + lasting
            world.clock.limit(end)
            while not typed & {"q", "Q"} and (end is None or due <= end):
                height = console.height - bool(hint)
                text = _newest(world, pairs, plotted, start, window, console, height)
                live.update(text.append(hint), refresh=True)
                due = max(due + seconds(0.2), world.clock.now())
                await world.clock.sleep_until(due, Phase.WATCH)

    session.run(draw())


def _newest(
    world: World,
    pairs: list[tuple[str, str]],
    plotted: _Plotted,
    start: Stamp,
    window: Duration,
    console: Console,
    height: int,
) -> Text:
    """Draw the last `window` of a world that goes on, or say what it waits for."""
    now = world.clock.now()

    def arrived(target: str, source: str) -> Stamp:
        """Up to where there can be a pose: what is on its way is not missing yet."""
        newest = world.buffer.newest_common(target, source)
        return newest if now - ON_ITS_WAY < newest < now else now

    # Two moments for each column of dots.
    period = max(seconds(0.001), window // max(20, 2 * console.width))
    begin = -(-max(start, now - window) // period) * period
    try:
        found = [
            sample(world.buffer, *pair, Moments(begin, arrived(*pair), period)) for pair in pairs
        ]
    except (TransformException, UsageError, InputError) as refusal:
        return Text(f"Waiting: {refusal}\n", style="yellow", overflow="fold")
    span = as_seconds(begin - start), as_seconds(now - start)
    return plotted.text(found, start, console, height=height, span=span)


def run(
    connection: Connection,
    words: list[str] | None,
    pairs: list[str] | None,
    output: Path | None,
    only: list[str] | None,
    from_above: bool,
    first: At | None,
    last: At | None,
    every: int | None,
    rate: float | None,
    stamps_of: str | None,
    window: int,
    lasting: int | None,
    ascii_only: bool,
    light: bool,
    dark: bool,
    force: bool,
) -> ExitStatus:
    """Run `tftool plot`; the parameters are its options."""
    asked, place = pairs_and_place(words or [], pairs or [])
    if not asked:
        raise UsageError("Name what to plot: tftool plot TARGET SOURCE [FROM].")
    quantities = chosen([one for text in only or () for one in text.split(",") if one.strip()])
    if from_above and only:
        raise UsageError("--xy draws the path, and --only what goes over time: leave one out.")
    plotted = _Plotted(quantities, from_above, ascii_only, light)
    if output is None:
        if dark or force:
            raise UsageError("--dark and --force go with -o FILE.")
        if place is None and sys.stdout.isatty():
            if any(one is not None for one in (first, last, every, rate, stamps_of)):
                raise UsageError(
                    "A live plot shows the last --window of time: leave out the other moments, or "
                    "name a FROM."
                )
            _live(connection, asked, plotted, window, lasting)
            return ExitStatus.DONE
    form = None if output is None else _form_of(output, force)

    stored = stored_frames(connection, place, lasting)
    moments = moments_of(stored, span(stored, first, last), every, rate, stamps_of)
    name_frames(stored.buffer.frames(), (frame for pair in asked for frame in pair))
    found = [sample(stored.buffer, *pair, moments) for pair in asked]
    start = stored.start or min(int(one.path.stamps[0]) for one in found)
    if output is not None and form is not None:
        _write(found, output, form, start, plotted, dark=dark, force=force)
    else:
        _print(found, start, plotted)
    return ExitStatus.DONE
