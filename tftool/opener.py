"""Function `open_frames`, which opens the frames of any source, for Python and the command line.

FROM (the argument `place`) names a scenario, a recording, a robot description, a file of static
transforms, or the address of a robot (`ws://robot:8765`). Without FROM, the running session of this
machine is used. A file is read, a scenario is played on simulated time, and the messages of a
session are received for a few seconds.
"""

import math
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import did_you_mean, visible
from tftool.base.stamps import Duration, seconds
from tftool.frames.frames import Frames
from tftool.frames.source_options import At, DescriptionOptions, RecordingOptions
from tftool.recordings.find import Found, Kind, find, names_a_path
from tftool.recordings.poses.pose_options import (
    ChosenOptions,
    PoseOptions,
    options_of,
    pose_options,
)
from tftool.scenario import builtin
from tftool.world.link.link_options import REACH_OPTIONS, REACHES, reach_at, read_reach

if TYPE_CHECKING:
    from tftool.recordings.contract import Progress
    from tftool.scenario.scenario import Scenario
    from tftool.world.link.session_world import Session
    from tftool.world.world import World

LISTEN_FOR = 5.0
"""Seconds to listen to a session, and to play a scenario, by default."""


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
    tf_topics: str | Sequence[str] = (),
    frames: str | None = None,
    pose_rate: float | None = None,
    pose_format: str | None = None,
    inverted: bool = False,
    axes: str | None = None,
    domain: int | None = None,
    connects: str | Sequence[str] = (),
    session: "Session | None" = None,
    watch: "Callable[[World], object] | None" = None,
    glance: "Callable[[Frames, Duration], object] | None" = None,
    progress: "Progress | None" = None,
    **reach: Any,
) -> Frames:
    """Open the frames of a recording, a description, a scenario or the running session.

        with tftool.open("run.mcap") as frames:
            frames.buffer.lookup_transform("map", "laser", frames.at(12.5))

    Several recordings are merged in order of time. The call also works inside an event loop.

    Args:
        place: Source of the frames: name, path or address; None for the running session.
        listen_for: Seconds to listen to a session.
        until: Last scenario time to play, seconds; infinity for the whole scenario, None for 5 s.
        margin: Further seconds to play after `until`, because transforms arrive after their stamp.
        cache_time: Cache time of a scenario's or session's buffer, nanoseconds; None for no limit.
        joints: Positions of a description's joints, radians or metres.
        arguments: Values of xacro arguments.
        urdf: File with the robot's description, for a recording that contains none.
        with_odometry: Whether odometry and poses in a recording count as transforms.
        no_cache: Whether to read the whole recording, and neither use nor write the column cache.
        tf_topics: Topic or topics whose transforms are read; all if empty. See `open_recording`.
        frames: Names of parent and child in a pose file: "odom:base_link".
        pose_rate: Poses per second, for a pose file without stamps.
        pose_format: Format of a pose file; None to detect the format.
        inverted: Whether to invert each pose of a pose file.
        axes: Axes of the cameras in a pose file: "opencv" or "opengl".
        domain: Number of the session's ROS domain; None for ROS_DOMAIN_ID, or else 0.
        connects: Endpoint or endpoints of sessions on other machines: "tcp/192.168.1.5:7448".
        session: Joined session to listen to; None to join a session.
        watch: Function called with the world of a scenario or session before it runs.
        glance: Function called in another thread, repeatedly while a session is listened to, with
            the frames received so far and the nanoseconds since the start.
        progress: Function called with the number of bytes read and the size of the file in bytes.
        reach: Further options for connecting to a session, named as on the command line.

    Raises:
        InputError: If `place` names no source, or the source cannot be read.
        LinkError: If there is no session to listen to.
        UsageError: If an option does not fit the source, or an optional package is not installed.
        TypeError: If there is no such keyword.
    """
    for name in reach:
        if name not in REACH_OPTIONS:
            near = did_you_mean(name, {*(open_frames.__kwdefaults__ or ()), *REACH_OPTIONS})
            raise TypeError(f"open() got an unexpected keyword argument '{name}'{near}")
    poses = PoseOptions(frames, pose_rate, pose_format, inverted, axes)
    if poses != PoseOptions():
        with pose_options(ChosenOptions(poses)):
            return open_frames(
                place,
                listen_for=listen_for,
                until=until,
                cache_time=cache_time,
                joints=joints,
                arguments=arguments,
                urdf=urdf,
                with_odometry=with_odometry,
                no_cache=no_cache,
                tf_topics=tf_topics,
                progress=progress,
            )
    robot = DescriptionOptions(
        joints or {}, arguments or {}, Path(urdf) if urdf is not None else None
    )
    recording = RecordingOptions(no_cache, with_odometry, _several(tf_topics))
    word = None if place is None else os.fspath(place)
    far = None if word is None else reach_at(word)
    if word is None or far is not None:
        refuse_options_of_files(robot, recording, word)
        from tftool.world.link.session_world import join_to_listen, listened

        given = {**reach, "connect": list(_several(connects))}
        if word is not None:
            refuse_beside_address(word, domain, given)
        session = session or join_to_listen(domain, far or read_reach(given))
        return listened(session, nanoseconds(listen_for), cache_time, watch, glance)
    found = named(word)
    if found.kind is Kind.SCENARIO:
        refuse_options_of_files(robot, recording, found.name)
        from tftool.scenario.play import played

        if until is not None and not isinstance(until, At) and not math.isinf(until):
            until = nanoseconds(until)
        return played(found, until, seconds(margin), cache_time, watch)
    if cache_time is not None:
        raise UsageError(f"'{visible(found.name)}' is read completely: leave out --cache-time.")
    from tftool.frames.frame_files import read_frames

    return read_frames(found, robot, recording, progress)


# Which kind of source a word names


def _several(given: "str | Sequence[str]") -> tuple[str, ...]:
    # A text is a sequence of its letters, so one name in place of a list needs a case of its own.
    return (given,) if isinstance(given, str) else tuple(given)


def named(word: str) -> Found:
    """Return the files or the scenario that a word names, with the kind of source.

    The name of a built-in scenario takes precedence over a file of the same name. `./turtles` and
    `turtles.yaml` are always paths.

    Raises:
        InputError: If the word names no source, or a file that cannot be read.
    """
    path = Path(word)
    if path.name == word and not path.suffix:
        scenario = builtin.path_of(word)
        if scenario is not None:
            return Found(word, Kind.SCENARIO, (scenario,))
        if not names_a_path(word):
            raise InputError(builtin.unknown(word))
    return find(word)


def scenario_named(
    word: str, arguments: Mapping[str, str] | None = None, *, expects: bool = True
) -> "Scenario":
    """Read the scenario that a word names.

    Args:
        word: Name of a built-in scenario, or path of a file.
        arguments: Values for arguments that the scenario declares.
        expects: Whether the expectations of the scenario are needed.

    Raises:
        InputError: If there is no such scenario, or the scenario cannot be read.
        UsageError: If the word names another kind of source, or an argument is not declared.
    """
    from tftool.scenario.load import load

    found = named(word)
    if found.kind is not Kind.SCENARIO:
        raise UsageError(f"'{visible(word)}' is {found.kind.in_words}: name a scenario instead.")
    return load(found.paths[0], arguments or {}, expects=expects)


def refuse_options_of_files(
    robot: DescriptionOptions, recording: RecordingOptions, word: str | None
) -> None:
    """Raise UsageError for options of recordings or descriptions if FROM is of another kind."""
    what = "The running session" if word is None else f"'{visible(word)}'"
    robot.refuse(f"{what} is neither a robot description nor a recording")
    recording.refuse(f"{what} is not a recording")
    options_of(word or "").refuse(f"{what} is not a pose file")


def refuse_beside_address(address: str, domain: int | None, given: Mapping[str, Any]) -> None:
    """Raise UsageError for options that select a session if FROM is the address of a session."""
    if domain is not None or any(given.values()):
        raise UsageError(
            f"'{visible(address)}' already names the robot: leave out --domain, "
            f"{', '.join(flag for one in REACHES for flag in one.FLAGS)} and --tls-*."
        )


def nanoseconds(time: float) -> Duration:
    """Convert a number of seconds to nanoseconds.

    An `int` of 10⁶ or more is returned unchanged, because such a number is in nanoseconds already.

    Raises:
        UsageError: If the time is not above zero.
    """
    if not time > 0:
        raise UsageError(f"{time} s is too short to listen or to play: give more than 0.")
    # Nobody listens for eleven days.
    return int(time) if isinstance(time, int) and time >= 1_000_000 else seconds(time)
