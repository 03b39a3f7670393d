"""`tftool tree --watch`: a live tree."""

from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import is_news
from tftool.commands.shared.on_screen import screen_lacks
from tftool.commands.tree.tree_keys import watch_with_keys
from tftool.commands.tree.tree_text import fitting
from tftool.doctor.frame_marks import marks
from tftool.world.clock import Phase, pace_of
from tftool.world.log import LogRecord
from tftool.world.stopper import leave_screen
from tftool.world.world import World


def show_changes(
    connection: Connection,
    place: str | None,
    duration: Duration | None,
    cache_time: Duration | None,
) -> None:
    """Show a live tree: with keys if the terminal has them, else redrawn in place."""
    console = Console()
    if not console.is_terminal:
        raise UsageError("--watch needs a terminal; without it the tree is written once.")
    session = open_session(connection, place, cache_time=cache_time)
    if screen_lacks():
        session.run(_redrawn(session.world, duration, console))
    else:
        watch_with_keys(session, duration)


async def _redrawn(world: World, duration: Duration | None, console: Console) -> None:
    """Draw the tree on the world's own ticks; rich's thread could draw a half-finished change."""
    # On this screen nothing else can be read.
    news = Text(style="yellow")

    def tell(record: LogRecord) -> None:
        if is_news(record):
            news.plain = f"\n{visible(record.text)}"

    world.log.listen(tell, "console")
    world.clock.when_killed.add(leave_screen, "screen")
    with Live(console=console, auto_refresh=False, screen=True) as live:
        pace = pace_of(world.clock)
        due = pace.now()
        end = None if duration is None else due + duration
        pace.limit(end)
        while end is None or due <= end:
            snapshot = world.buffer.snapshot(world.clock.now())
            picture = fitting(snapshot, None, marks(world.buffer, snapshot), console)
            live.update(Group(*picture, news), refresh=True)
            due = max(due + seconds(0.5), pace.now())
            await pace.sleep_until(due, Phase.WATCH)
