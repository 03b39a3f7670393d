"""Live plot of a session on the terminal."""

from rich import box
from rich.console import Console, Group
from rich.live import Live
from rich.panel import Panel
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
"""Nanoseconds by which samples may be late; a live plot ends at the newest sample if younger."""

FARTHEST_BACK = 4
"""Number of visible time spans that are stored for going back."""

NEAREST = seconds(0.2)
"""Smallest visible time span, nanoseconds."""

KEYS = (
    Hint("+ -", "zoom"),
    Hint("left right", "time"),
    Hint("1-9", "hide a curve"),
    Hint("i", "only one curve"),
    Hint("0", "all"),
    Hint("q", "quit"),
)
"""Keys of a live plot with their meanings."""

_CURVES = frozenset(range(1, 10))
"""Numbers of curves that keys can hide."""

_STEP = 1.5
"""Magnification of one step of the zoom."""


class PlotSight:
    """Visible time span and hidden curves of a live plot, which the user changes with keys.

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
        """Handle a key: zoom, move in time, hide curves, show one curve only, or reset the view.

        The key "i" shows only the first curve, then only the second, and so on.
        """
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
            self._span, self._back, self.hidden = self._window, 0, frozenset()
        elif key in "123456789":
            self.hidden ^= {int(key)}
        elif key == "i":
            alone = _CURVES - self.hidden
            first = min(alone) % len(_CURVES) + 1 if len(alone) == 1 else 1
            self.hidden = _CURVES - {first}
        self._back = max(0, self._back)

    def span(self, now: Stamp) -> tuple[Stamp, Stamp]:
        """Return the first and the last time to draw."""
        return now - self._back - self._span, now - self._back

    @property
    def back(self) -> Duration:
        """Nanoseconds from the last shown time to the present; 0 in the live view."""
        return self._back


def plot_live(connection: Connection, options: PlotOptions, pairs: list[tuple[str, str]]) -> None:
    """Draw a session's plot until q is pressed or the command is stopped."""
    console = Console()
    window = options.window or seconds(20)
    session = open_session(connection, None, cache_time=FARTHEST_BACK * window + seconds(1))
    world = session.world
    world.clock.when_killed.add(leave_screen, "screen")
    start = min(world.clock.now(), world.clock.epoch) or world.clock.now()

    sight = PlotSight(window)
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
                # Title bar and border take three lines.
                height = console.height - 2 - takes_keys
                text = _newest(world, options, pairs, start, sight, console, height)
                text.rstrip()
                elapsed, back = as_seconds(due - start), as_seconds(sight.back)
                head = title_bar(title, elapsed, console.width, look, behind=back)
                framed = Panel(
                    text,
                    title="Curves",
                    title_align="left",
                    box=box.ASCII if ascii_only else box.ROUNDED,
                    border_style=look.ink(look.palette.dim),
                    padding=0,
                    height=console.height - 1 - takes_keys,
                )
                keys = [footer(KEYS, console.width, look)] if takes_keys else []
                live.update(Group(head, framed, *keys), refresh=True)
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
    """Return the plot of the visible time span, or a text that says which data is missing."""
    first, now = sight.span(world.clock.now())

    def arrived(target: str, source: str) -> Stamp:
        """Return the last time to draw: the newest common stamp if recent, else the present."""
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
    return drawn(
        options, found, start, console, margin=2, height=height, span=span, hidden=sight.hidden
    )
