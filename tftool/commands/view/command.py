"""Implementation of `tftool view`: the frames in 3-D, in a browser."""

import asyncio
import html
import shutil
import sys
import webbrowser
from collections.abc import Callable, Coroutine, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import short_size, visible
from tftool.commands.shared.connection import WHOLE, Connection, open_from
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import notice, tell_news
from tftool.commands.shared.on_screen import at_rest, driver_of
from tftool.commands.shared.progress_bars import Bar, interruptible
from tftool.commands.view import ViewOptions
from tftool.frames.frame_files import load_described
from tftool.frames.frames import Frames
from tftool.opener import named
from tftool.recordings.find import Found, Kind
from tftool.recordings.target import refuse_existing, whole_file
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.robot_model import parse_robot
from tftool.screens.browser.drawn_messages import (
    IN_A_FILE,
    LiveDisplays,
    recorded_tracks,
    tracks_named,
)
from tftool.screens.browser.robots import ShownRobot
from tftool.screens.browser.server import PageServer
from tftool.screens.browser.standalone import MOST_BYTES, StandaloneData, standalone_page
from tftool.screens.still_frames import first_look, first_moment
from tftool.world.clock import Phase
from tftool.world.clock import run as run_on
from tftool.world.link.session_world import Session, lasting, live_shared
from tftool.world.link.zenoh.rendezvous import page_secret
from tftool.world.nodes.joints import (
    DESCRIPTION,
    LATCHED,
    JointStatePublisher,
    RobotStatePublisher,
    description_type,
)
from tftool.world.nodes.turtle_drivers import IdleDrawing
from tftool.world.nodes.turtlesim import simulator_of
from tftool.world.world import World

_MOST_TOLD = 5


def _write(connection: Connection, options: ViewOptions, output: Path) -> ExitStatus:
    """Write the page and its data into one file."""
    if output.suffix.lower() not in (".html", ".htm"):
        raise UsageError(f"'{output}' has no known suffix: end it in .html.")
    refuse_existing(output, force=options.force)
    data = _page_data(connection, options)
    if not data.buffer.frames():
        raise InputError(f"{visible(data.name)} has no frames: there is nothing to show.")
    bar = Bar("Packing")
    with interruptible(), whole_file(output, force=options.force) as file:
        try:
            page = standalone_page(data, progress=bar)
        finally:
            bar.stop()
        file.write(page.content)
    if data.robot is not None:
        _tell_missing(data.robot)
    size = len(page.content)
    notice(visible(f"Wrote {output}, {short_size(size)}: it opens in any browser, from disk."))
    if page.is_rounded:
        notice(
            "Lengths in the file are rounded to a micrometre and quaternions to 1e-7: with all "
            f"digits the file would exceed {MOST_BYTES / 1e6:g} MB."
        )
    if size > MOST_BYTES:
        notice("For a smaller file, cut out a part with 'tftool edit --from --to'.")
    if options.open_browser and not webbrowser.open(output.resolve().as_uri()):
        notice("No browser could be started: open the file yourself.")
    return ExitStatus.DONE


def _page_data(connection: Connection, options: ViewOptions) -> StandaloneData:
    """Return all data of a standalone page, from a file or from a session that is listened to."""
    meshes = options.meshes or []
    published: list[ShownRobot] = []
    displays: list[LiveDisplays] = []

    def listen(world: World) -> None:
        _hear_description(world, published.append, meshes)
        displays.append(LiveDisplays(world, IN_A_FILE))

    frames = open_from(connection, options.place, options.run_for, until=WHOLE, watch=listen)
    # Static transforms alone have the span 0, which would mean the latest time.
    start, end = frames.span
    start = max(1, start)
    end = max(start, end)
    robot = _robot_of(connection, frames, meshes) or (published[-1] if published else None)
    begin = first_moment(frames.buffer, start, end)
    if frames.recording is not None:
        tracks = recorded_tracks(frames.recording, IN_A_FILE)
    else:
        tracks = [track for one in displays for track in one.latest(IN_A_FILE.points)]
    return StandaloneData(frames.label, frames.buffer, start, end, begin, robot, tracks=tracks)


def _robot_of(connection: Connection, frames: Frames, meshes: Sequence[Path]) -> ShownRobot | None:
    """Return the robot of a description or a recording, with meshes; None without a robot."""
    robot = frames.robot
    if robot is None:
        return None
    described, rest = connection.robot.urdf, None
    if frames.kind == "robot description" and frames.found is not None:
        described = frames.found.paths[0]
        rest = robot.positions(connection.robot.joints)
    return ShownRobot(robot, MeshFolders(described, meshes), rest=rest)


def _published(
    connection: Connection, description: Found, meshes: Sequence[Path]
) -> "tuple[Session, ShownRobot]":
    """Publish a robot in a new session.

    Returns:
        The session, and the robot for the page, with sliders that move the joints.
    """
    connection.refuse_to_share(description.name)
    robot = load_described(description, connection.robot)
    joints = connection.robot.joints
    robot.positions(joints)
    for note in (*robot.notes, *robot.beyond_limits(joints)):
        notice(visible(note))
    world = World(connection.providers.wall_clock())
    RobotStatePublisher(world, robot=robot, publish_frequency=0.0)
    mover = JointStatePublisher(world, robot=robot, positions=joints, rate=30.0)
    name = f"robot description '{visible(description.name)}'"
    session = Session(world, True, name, partial(live_shared, world, None, "host"), tell=tell_news)
    return session, ShownRobot(robot, MeshFolders(description.paths[0], meshes), mover)


def _let_drive(session: Session, page: PageServer) -> None:
    """Let the arrow keys on the page drive turtle1 of a hosted session.

    Until a key is pressed, the turtle drives by itself.
    """
    if not session.is_hosted or simulator_of(session.world) is None:
        return
    link = session.link
    page.take_keys(driver_of(session.world, "turtle1").press)
    IdleDrawing(session.world, is_alone=lambda: link is None or not link.graph.processes())


def _listen(session: Session, page: PageServer, meshes: Sequence[Path]) -> None:
    """Show the robot on the page whenever a robot description is published in the session."""

    def show(shown: ShownRobot) -> None:
        page.show_robot(shown)
        _tell_missing(shown)

    _hear_description(session.world, show, meshes)


def _hear_description(
    world: World, show: Callable[[ShownRobot], object], meshes: Sequence[Path]
) -> None:
    """Call `show` with the robot of each robot description that is published in the world."""

    def described(message: Any) -> None:
        try:
            robot = parse_robot(message.data)
        except InputError as error:
            notice(f"The description on /{DESCRIPTION} is not shown: {visible(str(error))}")
            return
        show(ShownRobot(robot, MeshFolders(given=meshes)))

    world.subscribe("view", DESCRIPTION, description_type(), described, LATCHED)


def _tell_missing(shown: ShownRobot) -> None:
    missing = shown.missing
    for sentence in missing[:_MOST_TOLD]:
        notice(f"A box is drawn in place of a mesh: {visible(sentence)}.")
    if len(missing) > _MOST_TOLD:
        notice(f"... and for {len(missing) - _MOST_TOLD} more.")


async def _show(
    page: PageServer,
    name: str,
    waiting: Coroutine[Any, Any, None],
    open_browser: bool,
) -> None:
    """Serve the page until the coroutine `waiting` ends, or a signal ends the command.

    Args:
        page: Server of the page.
        name: Name of the source that the page shows.
        waiting: Coroutine that ends at the end of the requested duration.
        open_browser: Whether to open the page in a browser.
    """
    async with page:
        if page.asked_port not in (0, page.port):
            notice(f"Port {page.asked_port} is not free: port {page.port} is used.")
        url = page.url
        said = f"The frames of {name} are at"
        # An address that is wrapped at the terminal's edge cannot be clicked.
        is_long = len(f"{said} {url}") > shutil.get_terminal_size().columns
        between = "\n" if is_long and sys.stdout.isatty() else " "
        sys.stdout.write(f"{said}{between}{url}\n")
        sys.stdout.flush()
        with _redirect_to(url) as redirect:
            if open_browser and not await _opened(redirect):
                notice("No browser could be started: open that address yourself.")
            await _until_one_ends(page.run(), waiting)


async def _until_one_ends(*work: Coroutine[Any, Any, None]) -> None:
    """Run coroutines concurrently until the first ends, then cancel the other coroutines."""
    tasks = [asyncio.ensure_future(one) for one in work]
    try:
        ended, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        for task in ended:
            task.result()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


@contextmanager
def _redirect_to(url: str) -> Iterator[str]:
    """Create a file that redirects to the page while this block runs, and return the file's URL.

    Every user of the machine can read a browser's command line, and the page's address contains a
    secret. So the browser is started with the name of a file that only this user can read.
    """
    with TemporaryDirectory(prefix="tftool-") as folder:
        file = Path(folder, "view.html")
        target = html.escape(url, quote=True)
        file.write_text(
            '<!doctype html><meta charset="utf-8"><meta name="referrer" content="no-referrer">'
            f'<meta http-equiv="refresh" content="0; url={target}"><title>tftool view</title>'
            f'<a href="{target}">tftool view</a>\n',
            encoding="utf-8",
        )
        yield file.as_uri()


async def _opened(url: str) -> bool:
    # Opening some browsers takes long, so it is done outside the event loop.
    return await asyncio.get_running_loop().run_in_executor(None, webbrowser.open, url)


def run(connection: Connection, options: ViewOptions) -> ExitStatus:
    """Run `tftool view`: serve the page, or write it to a file."""
    if options.output is not None:
        if options.cache_time is not None:
            raise UsageError("With -o, the file contains all transforms: leave out --cache-time.")
        return _write(connection, options, options.output)
    if options.force:
        raise UsageError("--force is only allowed with -o FILE: add -o FILE.")
    found = None if options.place is None else named(options.place)
    serve = partial(
        PageServer, port=options.port, rate=options.rate, tell=notice, secret=page_secret()
    )
    if found is not None and (found.kind.is_recording or found.kind is Kind.STATICS):
        _show_frames(connection, options, serve)
        return ExitStatus.DONE
    shown = None
    if found is not None and found.kind is Kind.DESCRIPTION:
        session, shown = _published(connection, found, options.meshes or [])
    else:
        session = open_session(connection, options.place, cache_time=options.cache_time)
    page = serve(session.world, name=session.name)
    page.show_live(LiveDisplays(session.world))
    if shown is not None:
        page.show_robot(shown)
        _tell_missing(shown)
    else:
        _listen(session, page, options.meshes or [])
        _let_drive(session, page)
    session.run(_show(page, session.name, session.lasting(options.run_for), options.open_browser))
    return ExitStatus.DONE


def _show_frames(
    connection: Connection, options: ViewOptions, serve: Callable[..., PageServer]
) -> None:
    """Serve a page with the frames of a file; playback is paused at the beginning."""
    frames = open_from(connection, options.place, cache_time=options.cache_time)
    shown_frames = at_rest(connection, frames)
    clock, start = shown_frames.clock, max(frames.span[0], 1)
    page = serve(shown_frames, name=frames.title, begin=first_look(frames) or start)
    if frames.recording is not None:
        page.show_tracks(partial(tracks_named, frames.recording.name))
    if (shown := _robot_of(connection, frames, options.meshes or [])) is not None:
        page.show_robot(shown)
        _tell_missing(shown)

    async def show() -> None:
        await clock.sleep_until(max(frames.span[1], 1), Phase.WATCH)
        waiting = lasting(clock, options.run_for)
        await _show(page, frames.title, waiting, options.open_browser)

    run_on(clock, show())
