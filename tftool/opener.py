"""The one door to frames: FROM becomes `Frames`, for Python and for the command line alike.

FROM is a word that names a scenario, a recording, a robot description, a file of static
transforms, or nothing: the session that runs on this machine. A file is read; a scenario is
played on simulated time; a session is listened to.
"""

import asyncio
import math
import os
from collections.abc import Callable, Coroutine, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from tftool.base.errors import InputError, LinkError, UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, seconds
from tftool.frames.frames import Frames
from tftool.frames.moment import At, checked_moment
from tftool.frames.source_options import RecordingOptions, RobotOptions
from tftool.recordings.find import Found, Kind, find, names_a_path
from tftool.scenario import builtin
from tftool.world.link.link_options import read_reach
from tftool.world.link.reach import Reach

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer
    from tftool.frames.transform_log import TransformLog
    from tftool.recordings.contract import Progress
    from tftool.robots.robot_model import Robot
    from tftool.scenario.scenario import Scenario
    from tftool.world.clock import Clock
    from tftool.world.link.session_world import Session
    from tftool.world.world import TransformMessage, World

T = TypeVar("T")

LISTEN_FOR = 5.0
"""Seconds a session is listened to, and a scenario played, unless more is asked for."""

NOTHING_RUNS = "No session is running here: start one with 'tftool demo'."


def open_frames(
    place: "str | os.PathLike[str] | None" = None,
    *,
    listen_for: float = LISTEN_FOR,
    until: float | At | None = None,
    margin: float = 1.0,
    cache_time: Duration | None = None,
    joints: Mapping[str, float] | None = None,
    arguments: Mapping[str, str] | None = None,
    urdf: "str | os.PathLike[str] | None" = None,
    with_odometry: bool = False,
    no_cache: bool = False,
    domain: int | None = None,
    session: "Session | None" = None,
    watch: "Callable[[World], object] | None" = None,
    progress: "Progress | None" = None,
    **reach: Any,
) -> Frames:
    """Open the frames of a recording, a description, a scenario or the running session.

        with tftool.open("run.mcap") as frames:
            frames.buffer.lookup_transform("map", "laser", frames.at(12.5))

    Several recordings are joined in the order of time. It works inside a running event loop.

    Args:
        place: What has the frames; None for the session that runs.
        listen_for: How long to listen to a session, seconds.
        until: Up to which second to play a scenario; 5 s if None, all of it if infinite.
        margin: How long to play on behind it, seconds, for what arrives after its stamp.
        cache_time: How far back the buffer of a scenario or session remembers; all if None.
        joints: Positions of a description's joints, radians or metres.
        arguments: Values of xacro arguments.
        urdf: The description of the robot in a recording that has none inside.
        with_odometry: Whether odometry and poses of a recording count as transforms.
        no_cache: Whether to read a recording anew, and keep no columns for the next time.
        domain: Number of the session's ROS domain; ROS_DOMAIN_ID, else 0, if None.
        session: A session that was joined already, to listen to.
        watch: Called with the world of a scenario or session before it lives.
        progress: Called with how many bytes of how many are read.
        reach: How to reach a session beyond this machine, by the names of the command line's
            options: `connect=["tcp/192.168.1.5:7448"]`, for example.

    Raises:
        InputError: If `place` names nothing, or it cannot be read.
        LinkError: If there is no session to listen to.
        UsageError: If an option does not fit what is opened, or an extra is not installed.
    """
    robot = RobotOptions(joints or {}, arguments or {}, Path(urdf) if urdf else None)
    recording = RecordingOptions(no_cache, with_odometry)
    if place is None:
        refuse_options_of_files(robot, recording, None)
        session = session or _joined(domain, read_reach(reach))
        return _listened(session, _nanoseconds(listen_for), cache_time, watch)
    found = named(os.fspath(place))
    if found.kind is Kind.SCENARIO:
        refuse_options_of_files(robot, recording, found.name)
        return _played(found, until, seconds(margin), cache_time, watch)
    refuse_to_forget(found, cache_time)
    return _read(found, robot, recording, progress)


# Which kind of source a word names


def named(word: str) -> Found:
    """Return what a word names.

    A built-in scenario's name wins; `./turtles` and `turtles.yaml` are paths.

    Raises:
        InputError: If it names nothing, or nothing we read.
    """
    if builtin.is_like_a_name(word):
        path = builtin.path_of(word)
        if path is not None:
            return Found(word, Kind.SCENARIO, (path,))
        if not names_a_path(word):
            raise InputError(builtin.unknown(word))
    return find(word)


def scenario_named(word: str, arguments: Mapping[str, str] | None = None) -> "Scenario":
    """Read the scenario that a word names.

    Args:
        word: A built-in scenario's name, or a file.
        arguments: Values for arguments it declares.

    Raises:
        InputError: If there is none, or it cannot be read.
        UsageError: If the word names something else, or an argument is not declared.
    """
    from tftool.scenario.load import load

    found = named(word)
    if found.kind is not Kind.SCENARIO:
        raise UsageError(f"'{visible(word)}' is {kind_in_words(found)}: a scenario is needed here.")
    return load(found.paths[0], arguments or {})


def kind_in_words(found: Found) -> str:
    """Return what FROM names, with its article."""
    if found.kind is Kind.SEVERAL:
        return "several recordings"
    article = "an" if found.kind is Kind.MCAP else "a"
    return f"{article} {found.kind.value}" + (" recording" if found.kind.is_recording else "")


def refuse_options_of_files(
    robot: RobotOptions, recording: RecordingOptions, word: str | None
) -> None:
    """Refuse the options of recordings and descriptions, where FROM is neither.

    Raises:
        UsageError: If one was given.
    """
    what = "The session that runs" if word is None else f"'{visible(word)}'"
    robot.refuse(f"{what} is no robot description and no recording")
    recording.refuse(f"{what} is no recording")


def refuse_to_forget(found: Found, cache_time: Duration | None) -> None:
    """Refuse --cache-time where FROM is all there, and lookups reach back to its beginning.

    Raises:
        UsageError: If it was given.
    """
    if cache_time is not None:
        raise UsageError(
            f"All of '{visible(found.name)}' is known, to its beginning: leave out --cache-time."
        )


# Files


def _read(
    found: Found, robot: RobotOptions, recording: RecordingOptions, progress: "Progress | None"
) -> Frames:
    """Read a recording, a robot description or a file of static transforms."""
    if found.kind.is_recording:
        return _read_recording(found, robot, recording, progress)
    recording.refuse(f"'{found.name}' is a {found.kind.value}")
    return _read_statics(found, robot) if found.kind is Kind.STATICS else _described(found, robot)


def _read_recording(
    found: Found, options: RobotOptions, reading: RecordingOptions, progress: "Progress | None"
) -> Frames:
    from tftool.recordings.cache_heads import default_folder
    from tftool.recordings.column_cache import ColumnCache
    from tftool.recordings.recording import open_recording

    robot = _robot_beside(options)
    folder = None if reading.no_cache else default_folder()
    recording = open_recording(
        found.name,
        progress=progress,
        robot=robot,
        cache=None if folder is None else ColumnCache(folder),
        with_odometry=reading.with_odometry,
    )
    try:
        _ = recording.transforms
    except BaseException:
        recording.close()
        raise
    notes = () if robot is None else robot.notes
    return Frames("recording", recording.name, recording=recording, found=found, notes=notes)


def _robot_beside(options: RobotOptions) -> "Robot | None":
    """Read the description that goes with a recording."""
    if options.joints:
        options.refuse("In a recording joints are where they were")
    if options.urdf is None and not options.arguments:
        return None
    if options.urdf is None:
        options.refuse("Only a description takes arguments: give it with --urdf FILE")
    from tftool.robots.robot_model import load_urdf

    assert options.urdf is not None
    return load_urdf(options.urdf, options.arguments)


def _described(found: Found, options: RobotOptions) -> Frames:
    from tftool.frames.notes import beyond_limits, joints_at_rest

    robot = load_described(found, options)
    buffer = robot.buffer(options.joints)
    notes = (
        *robot.notes,
        *beyond_limits(robot, options.joints),
        *joints_at_rest(robot, options.joints, found.name),
    )
    return Frames(
        "robot description", found.name, buffer=buffer, robot=robot, found=found, notes=notes
    )


def load_described(found: Found, options: RobotOptions) -> "Robot":
    """Read the description that FROM names.

    Raises:
        InputError: If it cannot be read or has mistakes.
        UsageError: If it needs an extra that is not installed, or options do not fit it.
    """
    from tftool.robots.robot_model import load_urdf

    if options.urdf is not None:
        raise UsageError(
            f"--urdf goes with a recording, and '{visible(found.name)}' is a robot description."
        )
    return load_urdf(found.paths[0], options.arguments)


def _read_statics(found: Found, options: RobotOptions) -> Frames:
    from tftool.robots.static_publishers import load_statics

    options.refuse(f"'{visible(found.name)}' is a {found.kind.value}, and no robot")
    statics = load_statics(found.paths[0], found.name)
    return Frames(
        "file of static transforms",
        found.name,
        buffer=statics.buffer,
        found=found,
        notes=statics.notes,
    )


# Worlds


def _played(
    found: Found,
    until: float | At | None,
    margin: Duration,
    cache_time: Duration | None,
    watch: "Callable[[World], object] | None",
) -> Frames:
    """Play a scenario on simulated time."""
    from tftool.scenario.load import load
    from tftool.scenario.play import build
    from tftool.world.clock import SimClock

    scenario = replace(load(found.paths[0], {}), expect=())
    if cache_time is not None:
        scenario = replace(scenario, cache_time=cache_time)
    clock = SimClock()
    start, whole = clock.epoch, scenario.duration
    if until is None:
        end, margin = start + min(seconds(LISTEN_FOR), whole), 0
    elif isinstance(until, At):
        end = checked_moment(until, f"scenario '{visible(scenario.name)}'", start, whole)
    elif math.isinf(until):
        end, margin = start + whole, 0
    else:
        end = start + _nanoseconds(until)
    play = build(scenario, clock)
    if watch is not None:
        watch(play.world)
    # What the listener forgets counts from `end` on.
    memory = None if cache_time is None else cache_time + margin
    with _heard(play.world, memory) as (buffer, log):
        _run(clock, play.live(end + margin))
    return Frames("scenario", scenario.name, buffer=buffer, span=(start, end), log=log, found=found)


def _joined(domain: int | None, reach: Reach) -> "Session":
    """Join the session that runs, to listen only.

    Raises:
        LinkError: If none runs.
    """
    from tftool.world.clock import FollowedClock
    from tftool.world.link.link_options import Options, domain_here
    from tftool.world.link.session import Link
    from tftool.world.link.session_world import joined_session
    from tftool.world.link.zenoh.rendezvous import has_members

    domain = domain_here() if domain is None else domain
    reaches_out = reach.awaits_others(hosts=False)
    if not reaches_out and not has_members(domain):
        raise LinkError(NOTHING_RUNS)
    link = Link(Options("open", domain, reach, read_only=True))
    if not reaches_out and not link.graph.has_sources:
        link.close()
        raise LinkError(NOTHING_RUNS)
    return joined_session(link, FollowedClock(), reach.place(domain))


def _listened(
    session: "Session",
    lasting: Duration,
    cache_time: Duration | None,
    watch: "Callable[[World], object] | None",
) -> Frames:
    """Listen to a session that was joined."""
    from tftool.world.link.session_world import twins

    world = session.world
    if watch is not None:
        watch(world)
    start = world.clock.epoch if session.is_hosted else world.clock.now()
    with _heard(world, cache_time) as (buffer, log):
        _run(world.clock, session.along(session.listened(lasting)))
    span = start, world.clock.now()
    notes = tuple(twins(world))
    return Frames("session", session.name, buffer=buffer, span=span, log=log, notes=notes)


@contextmanager
def _heard(world: "World", cache_time: Duration | None) -> "Iterator[tuple[Buffer, TransformLog]]":
    """Keep every transform of a world in a buffer of its own, and in the order of arrival."""
    from tftool.buffer.buffer import NO_LIMIT, Buffer
    from tftool.frames.transform_log import TransformLog

    buffer = Buffer(cache_time or NO_LIMIT, max_frames=world.buffer.max_frames)
    log = TransformLog()

    def hear(message: "TransformMessage", *, is_static: bool) -> None:
        log.hear(world.clock.now(), message.transforms, message.authority, is_static=is_static)
        set_transform = buffer.set_transform_static if is_static else buffer.set_transform
        for one in message.transforms:
            set_transform(one, message.authority)

    stops = [
        world.tf.subscribe(lambda message: hear(message, is_static=False)),
        world.tf_static.subscribe(lambda message: hear(message, is_static=True)),
    ]
    try:
        yield buffer, log
    finally:
        for stop in stops:
            stop()


def _run(clock: "Clock", work: Coroutine[Any, Any, T]) -> T:
    """Run work on a world's clock; on a thread of its own where a loop runs here already."""
    from tftool.world.clock import run

    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return run(clock, work)
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(1, "tftool.open") as pool:
        return pool.submit(run, clock, work).result()


def _nanoseconds(time: float) -> Duration:
    """Return seconds in nanoseconds; what `seconds` made already stays as it is."""
    if not time > 0:
        raise UsageError(f"{time} s is no time to listen or to play: give more than 0.")
    # Nobody listens for eleven days.
    return int(time) if isinstance(time, int) and time >= 1_000_000 else seconds(time)
