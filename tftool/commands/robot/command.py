"""`tftool robot`: a robot description alive, its joints moved by keys."""

import os
import sys
from typing import Any

from tftool.base.counts import count
from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.near_names import did_you_mean
from tftool.base.stamps import Duration
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_empty_session
from tftool.commands.shared.notices import notice
from tftool.commands.shared.on_screen import screen_lacks
from tftool.frames.frame_files import load_described
from tftool.frames.notes import beyond_limits
from tftool.opener import kind_in_words, named
from tftool.recordings.find import Kind
from tftool.robots.robot_model import Robot
from tftool.screens.terminal.robot_app import RobotApp
from tftool.screens.terminal.screen_options import Setting, setting_from
from tftool.screens.terminal.sliders import Sliders
from tftool.screens.terminal.world_app import show
from tftool.world.clock import run as run_loop
from tftool.world.link.session_world import Session
from tftool.world.nodes.joints import (
    JOINT_STATES,
    JointStatePublisher,
    RobotStatePublisher,
    joint_state_type,
)


def _no_link(described: Robot, link: str) -> str:
    hint = did_you_mean(link, described.links)
    return f"robot '{described.name}' has no link '{link}'{hint}"


def _tell(described: Robot, follow: bool) -> None:

    moving = sum(joint.moves for joint in described.joints.values())
    whose = "the /joint_states of others say" if follow else "--joint says"
    sys.stdout.write(
        f"Publishing robot '{visible(described.name)}': {count(len(described.links), 'link')}, "
        f"{count(moving, 'moving joint')}; {whose} where.\n"
    )
    sys.stdout.flush()


def _show(
    session: Session,
    described: Robot,
    mover: JointStatePublisher | None,
    shown: tuple[str | None, str],
    setting: Setting,
    run_for: Duration | None,
) -> None:
    """Show the sliders while the session lives."""
    world = session.world
    sliders = Sliders(described, mover, seed=world.clock.now())
    if mover is None:

        def hear(message: Any) -> None:
            sliders.hear(dict(zip(message.name, message.position, strict=False)))

        world.subscribe("sliders", JOINT_STATES, joint_state_type(), hear)
    setting = setting_from(os.environ, sys.stdout.encoding or "ascii", setting)
    link, prefix = shown
    app = RobotApp(world, sliders, link=link, prefix=prefix, setting=setting)
    run_loop(world.clock, show(app, session.along(session.lasting(run_for))))


def run(
    connection: Connection,
    place: str,
    link: str | None,
    follow: bool,
    no_screen: bool,
    rate: float,
    frame_prefix: str,
    run_for: int | None,
    ascii_only: bool,
    light: bool,
) -> ExitStatus:
    """Run `tftool robot`; the parameters are its options."""
    connection.refuse_read_only("publish")
    found = named(place)
    if found.kind is not Kind.DESCRIPTION:
        raise UsageError(
            f"'{visible(place)}' is {kind_in_words(found)}: a robot description is needed here."
        )
    if follow and connection.robot.joints:
        raise UsageError("--follow leaves the joints to others: leave out --joint.")
    if not no_screen and (lacking := screen_lacks()):
        raise UsageError(f"The sliders need a terminal, and {lacking}: add --no-screen.")
    described = load_described(found, connection.robot)
    if link is not None and link not in described.links:
        raise UsageError(_no_link(described, link))
    described.positions(connection.robot.joints)
    for note in (*described.notes, *beyond_limits(described, connection.robot.joints)):
        notice(visible(note))

    session = open_empty_session(connection)
    world = session.world
    RobotStatePublisher(
        world,
        robot=described,
        frame_prefix=frame_prefix,
        publish_frequency=0.0 if not follow else rate,
    )
    mover = (
        None
        if follow
        else JointStatePublisher(
            world, robot=described, positions=connection.robot.joints, rate=rate
        )
    )
    if no_screen:
        _tell(described, follow)
        session.run(session.lasting(run_for))
        return ExitStatus.DONE

    setting = Setting(title="tftool robot", ascii_only=ascii_only, light=light)
    _show(session, described, mover, (link, frame_prefix), setting, run_for)
    return ExitStatus.DONE
