"""Live plot of a session on the terminal."""

from rich.console import Console
from rich.live import Live
from rich.text import Text

from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.commands.plot import PlotOptions
from tftool.commands.plot.command import drawn
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.terminal import keyboard, left_while_stopped
from tftool.drawing import theme
from tftool.frames.pair_samples import Moments, sample
from tftool.screens.terminal.panel_text import Hint, footer, title_bar
from tftool.screens.terminal.text_style import Look
from tftool.world.clock import Phase
from tftool.world.stopper import leave_screen
from tftool.world.world import World

ON_ITS_WAY = seconds(1)
"""Nanoseconds within which samples may still arrive; a live plot ends before that."""

FARTHEST_BACK = 4
"""Number of visible time spans that are stored for going back."""

NEAREST = seconds(0.2)
"""Smallest visible time span, nanoseconds."""

KEYS = (
    Hint("+ -", "zoom"),
    Hint("left right", "time"),
    Hint("0", "all"),
    Hint("1-9", "hide a curve"),
    Hint("q", "quit"),
)
"""Keys of a live plot with their meanings."""

_STEP = 1.5
"""Magnification of one step of the zoom."""


class PlotSight:
    """Visible time span and hidden curves of a live plot; keys change both.

    Attributes:
        hidden: Numbers of the curves that are not drawn.
        ended: Whether the key that ends the plot was pressed.
    """

    def __init__(self, window: Duration) -> None:
        self.hidden: frozenset[int] = frozenset()
        self.ended = False
        self._window = self._span = window
        self._back: Duration = 0

    def press(self, key: str) -> None:
        """Handle a key: + and - zoom, arrows move in time, 0 shows all, digits hide curves."""
        quarter = self._span // 4
        if key in ("q", "Q"):
            self.ended = True
        elif key in ("+", "="):
            self._span = max(NEAREST, int(self._span / _STEP))
        elif key in ("-", "_"):
            self._span = min(FARTHEST_BACK * self._window, int(self._span * _STEP))
        elif key == "left":
            self._back = min(FARTHEST_BACK * self._window - self._span, self._back + quarter)
        elif key == "right":
            self._back = self._back - quarter
        elif key == "0":
            self._span, self._back = self._window, 0
        elif key in "123456789":
            self.hidden ^= {int(key)}
        self._back = max(0, self._back)

    def span(self, now: Stamp) -> tuple[Stamp, Stamp]:
        """Return the first and the last time to draw."""
        return now - self._back - self._span, now - self._back

    @property
    def back(self) -> Duration:
        """Nanoseconds between the newest and the shown time."""
        return self._back


def plot_live(connection: Connection, options: PlotOptions, pairs: list[tuple[str, str]]) -> None:
    """Draw a session's plot until q is pressed or the command is stopped."""
    console = Console()
    session = open_session(connection, None, cache_time=FARTHEST_BACK * options.window + seconds(1))
    world = session.world
    world.clock.when_killed.add(leave_screen, "screen")
    start = min(world.clock.now(), world.clock.epoch) or world.clock.now()

    sight = PlotSight(options.window)
    ascii_only = options.ascii_only or console.options.ascii_only
    look = Look(theme.LIGHT if options.light else theme.DARK, ascii_only)
    title = "tftool plot: " + ", ".join(visible(f"{of} in {to}") for to, of in pairs)

    async def draw() -> None:
        with (
            keyboard(sight.press) as takes_keys,
            Live(console=console, auto_refresh=False, screen=True) as live,
            left_while_stopped(live.stop, live.start),
        ):
            due = world.clock.now()
            end = None if options.lasting is None else due + options.lasting
            world.clock.limit(end)
            while not sight.ended and (end is None or due <= end):
                height = console.height - 1 - takes_keys
                text = _newest(world, options, pairs, start, sight, console, height)
                elapsed, back = as_seconds(due - start), as_seconds(sight.back)
                head = title_bar(title, elapsed, console.width, look, behind=back)
                text = head.append("\n").append_text(text)
                if takes_keys:
                    text.append_text(footer(KEYS, console.width, look))
                live.update(text, refresh=True)
                due = max(due + seconds(0.2), world.clock.now())
                await world.clock.sleep_until(due, Phase.WATCH)

    session.run(draw())


def _newest(
    world: World,
    options: PlotOptions,
    pairs: list[tuple[str, str]],
    start: Stamp,
    sight: PlotSight,
    console: Console,
    height: int,
) -> Text:
    """Draw the visible time span, or report which data is still missing."""
    first, now = sight.span(world.clock.now())

    def arrived(target: str, source: str) -> Stamp:
        """Return the last time with known poses; later samples may not have arrived yet."""
        newest = world.buffer.newest_common(target, source)
        return newest if now - ON_ITS_WAY < newest < now else now

    # Two times for each column of cells, which has two columns of dots.
    period = max(seconds(0.001), (now - first) // max(20, 2 * console.width))
    begin = -(-max(start, first) // period) * period
    try:
        found = [
            sample(world.buffer, *pair, Moments(begin, arrived(*pair), period)) for pair in pairs
        ]
    except (TransformException, UsageError, InputError) as refusal:
        return Text(f"Waiting: {refusal}\n", style="yellow", overflow="fold")
    span = as_seconds(begin - start), as_seconds(now - start)
    return drawn(options, found, start, console, height=height, span=span, hidden=sight.hidden)
