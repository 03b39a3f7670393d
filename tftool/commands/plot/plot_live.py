"""A plot of a session, drawn as it goes on."""

from rich.console import Console
from rich.live import Live
from rich.text import Text

from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.plot.plot_style import PlotStyle
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.keypresses import keyboard
from tftool.commands.shared.suspend import left_while_stopped
from tftool.frames.pair_samples import Moments, sample
from tftool.world.clock import Phase
from tftool.world.stopper import leave_screen
from tftool.world.world import World

ON_ITS_WAY = seconds(1)
"""Samples no older than that may still arrive; a live plot ends before them."""


def plot_live(
    connection: Connection,
    pairs: list[tuple[str, str]],
    style: PlotStyle,
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
                text = _newest(world, pairs, style, start, window, console, height)
                live.update(text.append(hint), refresh=True)
                due = max(due + seconds(0.2), world.clock.now())
                await world.clock.sleep_until(due, Phase.WATCH)

    session.run(draw())


def _newest(
    world: World,
    pairs: list[tuple[str, str]],
    style: PlotStyle,
    start: Stamp,
    window: Duration,
    console: Console,
    height: int,
) -> Text:
    """Draw the last `window` of a world that goes on, or say what it waits for."""
    now = world.clock.now()

    def arrived(target: str, source: str) -> Stamp:
        """Up to where there can be a pose: samples on their way are not missing yet."""
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
    return style.text(found, start, console, height=height, span=span)
