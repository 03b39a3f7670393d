"""Live tree on a screen with keys."""

import os
import sys
from typing import Any

from tftool.base.errors import InputError
from tftool.base.stamps import Duration
from tftool.commands.shared.notices import is_news
from tftool.doctor.frame_marks import marks
from tftool.drawing.solids import solids_of
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.urdf import parse_description
from tftool.screens.terminal.screen_options import Setting, setting_from
from tftool.screens.terminal.tree_app import TreeWatch
from tftool.screens.terminal.world_app import show
from tftool.world.clock import run
from tftool.world.link.session_world import Session
from tftool.world.log import LogRecord
from tftool.world.nodes.joints import DESCRIPTION, LATCHED, description_type


def watch_with_keys(session: Session, duration: Duration | None) -> None:
    """Show the tree until q is pressed or the time is up."""
    world = session.world
    setting = setting_from(os.environ, sys.stdout.encoding or "ascii", Setting(title="tftool tree"))
    app = TreeWatch(world, lambda snapshot: marks(world.buffer, snapshot), setting)

    def tell(record: LogRecord) -> None:
        if is_news(record):
            app.tell(record.text)

    def described(message: Any) -> None:
        try:
            robot = parse_description(message.data)
        except InputError as error:
            app.tell(f"the description on /{DESCRIPTION} is not drawn: {error}")
            return
        app.solids, missing = solids_of(robot.links.values(), MeshFolders())
        if missing:
            app.tell(f"{len(missing)} shapes are not drawn: {missing[0]}")

    world.subscribe("tree", DESCRIPTION, description_type(), described, LATCHED)
    world.log.listen(tell, "screen")
    run(world.clock, show(app, session.along(session.lasting(duration))))
