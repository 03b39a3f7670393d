"""Live tree on a screen with keys."""

import os
import sys

from tftool.base.stamps import Duration
from tftool.commands.shared.notices import is_news
from tftool.commands.shared.on_screen import take_solids
from tftool.doctor.frame_marks import marks
from tftool.drawing.solids import Solids
from tftool.screens.terminal.screen_options import Setting, setting_from
from tftool.screens.terminal.tree_app import TreeWatch
from tftool.screens.terminal.world_app import show
from tftool.world.clock import run
from tftool.world.link.session_world import Session
from tftool.world.log import LogRecord


def watch_with_keys(session: Session, duration: Duration | None) -> None:
    """Show the tree until q is pressed or the time is up."""
    world = session.world
    setting = setting_from(os.environ, sys.stdout.encoding or "ascii", Setting(title="tftool tree"))
    app = TreeWatch(world, lambda snapshot: marks(world.buffer, snapshot), setting)

    def tell(record: LogRecord) -> None:
        if is_news(record):
            app.tell(record.text)

    def take(solids: Solids) -> None:
        app.solids = solids

    take_solids(world, "tree", take, app.tell)
    world.log.listen(tell, "screen")
    run(world.clock, show(app, session.along(session.lasting(duration))))
