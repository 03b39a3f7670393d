"""Implementation of `tftool robot`: publish a robot description, and move its joints by keys."""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import count, did_you_mean, visible
from tftool.base.stamps import Duration
from tftool.commands.robot import RobotOptions
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_empty_session
from tftool.commands.shared.notices import notice
from tftool.commands.shared.on_screen import screen_lacks, screen_setting
from tftool.drawing.solids import Solids, solids_of
from tftool.drawing.space import SpaceFrame, SpacePicture
from tftool.drawing.space_file import drawn_file
from tftool.drawing.theme import DARK, LIGHT
from tftool.frames.frame_files import load_described
from tftool.geometry.rigid import Transform
from tftool.opener import named
from tftool.recordings.find import Kind
from tftool.recordings.target import whole_file
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.robot_model import Robot
from tftool.screens.terminal.robot_app import RobotApp
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.sliders import Sliders
from tftool.screens.terminal.space_panel import frames_in_space
from tftool.world.clock import run as run_loop
from tftool.world.link.session_world import Session
from tftool.world.nodes.joints import (
    JOINT_STATES,
    JointStatePublisher,
    RobotStatePublisher,
    joint_state_type,
)

IN_A_FILE = 100_000
"""Most triangles of a picture in a file, which has more pixels than a terminal."""

MOST_TOLD = 5
"""Most sentences about missing meshes."""


def _no_link(described: Robot, link: str) -> str:
    hint = did_you_mean(link, described.links)
    return f"robot '{described.name}' has no link '{link}'{hint}"


def _tell(described: Robot, follow: bool, is_given: bool) -> None:
    moving = sum(joint.moves for joint in described.joints.values())
    given = "from --joint" if is_given else "at rest"
    if follow:
        given = "from /joint_states of other nodes"
    sys.stdout.write(
        f"Publishing robot '{visible(described.name)}': {count(len(described.links), 'link')}, "
        f"{count(moving, 'moving joint')}, positions {given}.\n"
    )
    sys.stdout.flush()


def _show(
    session: Session,
    described: Robot,
    mover: JointStatePublisher | None,
    shown: tuple[str | None, str],
    setting: Setting,
    run_for: Duration | None,
    solids: tuple[Solids, Sequence[str]],
) -> None:
    """Show sliders for the joints while the session runs.

    Args:
        session: Session in which the robot is published.
        described: Robot of the description.
        mover: Publisher of the joint positions; None to show the positions of other publishers.
        shown: Link whose pose is shown, or None for the default, and the prefix of frame names.
        setting: Settings of the screen.
        run_for: Nanoseconds to run; None for no end.
        solids: Shapes of the links, and sentences about meshes that could not be read.
    """
    world = session.world
    sliders = Sliders(described, mover, seed=world.clock.now())
    if mover is None:

        def hear(message: Any) -> None:
            sliders.hear(dict(zip(message.name, message.position, strict=False)))

        world.subscribe("sliders", JOINT_STATES, joint_state_type(), hear)
    link, prefix = shown
    app = RobotApp(
        world,
        sliders,
        link=link,
        prefix=prefix,
        setting=setting,
        solids=solids[0],
        missing=solids[1],
    )
    run_loop(world.clock, app.run_with_world(session.along(session.lasting(run_for))))


def _draw(
    described: Robot,
    joints: Mapping[str, float],
    shapes: tuple[Solids, Sequence[str]],
    output: Path,
    *,
    light: bool,
    force: bool,
) -> ExitStatus:
    """Draw the robot at given joint positions, and write the picture to an .svg or .png file."""
    form = output.suffix.lower().removeprefix(".")
    if form not in ("svg", "png"):
        raise UsageError(f"'{output}' has no known suffix: end it in .svg or .png.")
    frames = frames_in_space(described.buffer(joints).snapshot(0), described.root)
    # A robot of one link has no joints, and so no transforms.
    frames = frames or (SpaceFrame(described.root, Transform.identity()),)
    picture = SpacePicture(described.root, frames, shapes[0])
    _tell_missing(shapes[1])
    content = drawn_file(picture, form, LIGHT if light else DARK, title=described.name)
    with whole_file(output, force=force) as file:
        file.write(content)
    notice(visible(f"Drew {count(len(frames), 'link')} to {output}."))
    return ExitStatus.DONE


def _tell_missing(sentences: Sequence[str]) -> None:
    for sentence in sentences[:MOST_TOLD]:
        notice(f"A mesh is not drawn: {visible(sentence)}.")
    if len(sentences) > MOST_TOLD:
        notice(f"... and {len(sentences) - MOST_TOLD} more.")


def run(connection: Connection, options: RobotOptions) -> ExitStatus:
    """Run `tftool robot`: publish, show or draw a robot."""
    connection.refuse_read_only("publish")
    found = named(options.place)
    if found.kind is not Kind.DESCRIPTION:
        raise UsageError(
            f"'{visible(options.place)}' is {found.kind.in_words}: name a robot description."
        )
    if options.follow and connection.robot.joints:
        raise UsageError(
            "--follow takes all joint positions from /joint_states: leave out --joint."
        )
    if options.output is None and not options.no_screen and (lacking := screen_lacks()):
        raise UsageError(f"The sliders need a terminal, and {lacking}: add --no-screen.")
    described = load_described(found, connection.robot)
    if options.link is not None and options.link not in described.links:
        raise UsageError(_no_link(described, options.link))
    described.positions(connection.robot.joints)
    for note in (*described.notes, *described.beyond_limits(connection.robot.joints)):
        notice(visible(note))

    folders = MeshFolders(found.paths[0], options.meshes or [])
    if options.output is not None:
        shapes = solids_of(
            described.links.values(),
            folders,
            most=IN_A_FILE,
            joints=described.joints.values(),
        )
        return _draw(
            described,
            connection.robot.joints,
            shapes,
            options.output,
            light=options.light,
            force=options.force,
        )

    session = open_empty_session(connection)
    world = session.world
    RobotStatePublisher(
        world,
        robot=described,
        frame_prefix=options.frame_prefix,
        publish_frequency=0.0 if not options.follow else options.rate,
    )
    mover = (
        None
        if options.follow
        else JointStatePublisher(
            world, robot=described, positions=connection.robot.joints, rate=options.rate
        )
    )
    if options.no_screen:
        _tell(described, options.follow, bool(connection.robot.joints))
        session.run(session.lasting(options.run_for))
        return ExitStatus.DONE

    setting = screen_setting(options, "tftool robot")
    shapes = solids_of(
        described.links.values(),
        folders,
        options.frame_prefix,
        joints=described.joints.values(),
    )
    _tell_missing(shapes[1])
    _show(
        session,
        described,
        mover,
        (options.link, options.frame_prefix),
        setting,
        options.run_for,
        shapes,
    )
    return ExitStatus.DONE
