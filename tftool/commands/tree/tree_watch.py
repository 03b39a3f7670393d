"""Live tree of frames on the terminal, for `tftool tree --watch`."""

from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import is_news
from tftool.commands.shared.on_screen import screen_lacks, screen_setting
from tftool.commands.tree import TreeOptions
from tftool.commands.tree.command import fitting
from tftool.doctor.frame_marks import marks
from tftool.drawing.solids import Solids
from tftool.screens.terminal.scene import take_solids
from tftool.screens.terminal.tree_app import TreeWatch
from tftool.world.clock import Phase, pace_of, run
from tftool.world.link.session_world import Session
from tftool.world.log import LogRecord
from tftool.world.stopper import leave_screen
from tftool.world.world import World


def watch_with_keys(session: Session, options: TreeOptions) -> None:
    """Show the tree on a full screen until q is pressed or the duration is over."""
    world = session.world
    setting = screen_setting(options, "tftool tree")
    statics = _static_edges(world)
    app = TreeWatch(world, lambda snapshot: marks(world.buffer, snapshot, statics), setting)

    def tell(record: LogRecord) -> None:
        if is_news(record):
            app.tell(record.text)

    def take(solids: Solids) -> None:
        app.solids = solids

    take_solids(world, "tree", take, app.tell)
    world.log.listen(tell, "screen")
    run(world.clock, app.run_with_world(session.along(session.lasting(options.run_for))))


def show_changes(connection: Connection, options: TreeOptions) -> None:
    """Show a live tree: on a full screen with keys if possible, else redrawn in place."""
    console = Console()
    if not console.is_terminal:
        raise UsageError("--watch needs a terminal: leave --watch out to print the tree once.")
    session = open_session(connection, options.place, cache_time=options.cache_time)
    if screen_lacks():
        session.run(_redrawn(session.world, options, console))
    else:
        watch_with_keys(session, options)


def _static_edges(world: World) -> set[tuple[str, str]]:
    """Return parent and child of each static transform; the set grows while the world runs."""
    found = {(one.frame_id, one.child_frame_id) for one in world.static_transforms()}
    world.tf_static.subscribe(
        lambda message: found.update(
            (one.frame_id, one.child_frame_id) for one in message.transforms
        )
    )
    return found


async def _redrawn(world: World, options: TreeOptions, console: Console) -> None:
    """Redraw the tree periodically in the event loop.

    rich's own drawing thread is not used: it could draw while the tree is being changed.
    """
    # Text on stderr is not visible on this screen, so warnings are shown below the tree.
    news = Text(style="yellow")

    def tell(record: LogRecord) -> None:
        if is_news(record):
            news.plain = f"\n{visible(record.text)}"

    world.log.listen(tell, "console")
    world.clock.when_killed.add(leave_screen, "screen")
    statics = _static_edges(world)
    with Live(console=console, auto_refresh=False, screen=True) as live:
        pace = pace_of(world.clock)
        due = pace.now()
        end = None if options.run_for is None else due + options.run_for
        pace.limit(end)
        while end is None or due <= end:
            snapshot = world.buffer.snapshot(world.clock.now())
            found = marks(world.buffer, snapshot, statics)
            picture = fitting(snapshot, None, found, console, options)
            live.update(Group(*picture, news), refresh=True)
            due = max(due + seconds(0.5), pace.now())
            await pace.sleep_until(due, Phase.WATCH)
