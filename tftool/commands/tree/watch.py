"""`tftool tree --watch`: the tree as it changes, with keys on a terminal and as text elsewhere."""

import os
import sys
from collections.abc import Callable

from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.notices import is_news
from tftool.commands.shared.on_screen import screen_lacks
from tftool.commands.tree.command import fitting
from tftool.doctor.frame_marks import marks
from tftool.screens.terminal.run_screen import show
from tftool.screens.terminal.screen_options import Setting, setting_from
from tftool.screens.terminal.tree_app import TreeWatch
from tftool.world.clock import Phase, pace_of
from tftool.world.clock import run as run_loop
from tftool.world.link.session_world import Session
from tftool.world.log import LogRecord
from tftool.world.stopping import leave_screen
from tftool.world.world import World


def watch_tree(open_session: Callable[[], Session], duration: Duration | None) -> None:
    """Show the tree as it changes: with keys where there are some, else redrawn in place."""
    console = Console()
    if not console.is_terminal:
        raise UsageError("--watch needs a terminal; without it the tree is written once.")
    session = open_session()
    if screen_lacks():
        session.run(_redrawn(session.world, duration, console))
    else:
        _watch_with_keys(session, duration)


def _watch_with_keys(session: Session, duration: Duration | None) -> None:

    world = session.world
    setting = setting_from(os.environ, sys.stdout.encoding or "ascii", Setting())
    app = TreeWatch(world, lambda snapshot: marks(world.buffer, snapshot), setting)

    def tell(record: LogRecord) -> None:
        if is_news(record):
            app.tell(record.text)

    world.log.listen(tell, "screen")
    run_loop(world.clock, show(app, session.along(session.lasting(duration))))


async def _redrawn(world: World, duration: Duration | None, console: Console) -> None:
    """Draw the tree on the world's own ticks; rich's thread would draw half a change."""
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
            live.update(Group(picture, news), refresh=True)
            due = max(due + seconds(0.5), pace.now())
            await pace.sleep_until(due, Phase.WATCH)
