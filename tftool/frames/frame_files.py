"""Reader of frames from files: recordings, robot descriptions, static transforms."""

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.plain_text import count, visible
from tftool.frames.frames import Frames
from tftool.frames.source_options import DescriptionOptions, RecordingOptions
from tftool.recordings.cache_heads import default_folder
from tftool.recordings.column_cache import ColumnCache
from tftool.recordings.contract import Progress
from tftool.recordings.find import Found, Kind
from tftool.recordings.recording import open_recording
from tftool.recordings.tf_topics import implying
from tftool.robots.robot_model import Robot, load_urdf

if TYPE_CHECKING:
    from tftool.recordings.description_frames import DescribedFrames
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot


def recording_notes(recording: "Recording") -> list[str]:
    """Return sentences about damage, unusual transforms and added frames of a recording."""
    return [
        *recording.damage,
        *odometry_notes(recording),
        *_described_notes(recording.described),
        *(f"{text} ({times} times)." for text, times in recording.oddities.items()),
    ]


def odometry_notes(recording: "Recording") -> Iterator[str]:
    """Yield sentences about odometry and poses that are used, or could be used, as transforms."""
    for topic in recording.odometry:
        messages = count(topic.count, "message")
        yield f"'{topic.name}' ({topic.type}, {messages}) is taken for transforms."
    if not recording.edges:
        found = [f"'{topic.name}' ({topic.type})" for topic in implying(recording.topics)]
        if found:
            yield (
                "No transform was recorded; --with-odometry uses these messages instead: "
                f"{', '.join(found[:5])}{' …' if len(found) > 5 else ''}."
            )


def _described_notes(described: "DescribedFrames | None") -> Iterator[str]:
    """Yield sentences about frames that were added from a robot description."""
    if described is None:
        return
    added = len(described.still) + len(described.moving)
    if added:
        yield (
            f"{count(added, 'frame')} that tf lacks: from the robot's description, "
            f"{len(described.moving)} of them moved by joint states."
        )
    if described.gaps:
        shown = ", ".join(described.gaps[:5]) + (" …" if len(described.gaps) > 5 else "")
        yield (
            f"{count(len(described.gaps), 'link')} without a frame, as neither tf nor joint states "
            f"have their poses: {shown}."
        )


def beyond_limits(robot: "Robot", given: Mapping[str, float]) -> Iterator[str]:
    """Yield a sentence about positions beyond the limits of their joints, which are used anyway.

    Args:
        robot: Robot of the joints.
        given: Positions by joint; all joints belong to the robot.
    """
    for name, position in given.items():
        joint = robot.joints[name]
        if joint.limits is not None and not joint.limits[0] <= position <= joint.limits[1]:
            lower, upper = joint.limits
            yield (
                f"Joint '{visible(name)}' at {position:.4g} {joint.unit} is beyond its limits, "
                f"{lower:.4g} to {upper:.4g}."
            )


def joints_at_rest(robot: "Robot", given: Collection[str], name: str) -> Iterator[str]:
    """Yield a sentence with the number of movable joints for which no position was given."""
    at_rest = sum(
        joint.moves and joint.name not in given and robot.leader(joint.name, given) not in given
        for joint in robot.joints.values()
    )
    if at_rest:
        word = visible(name)
        yield f"Joints that move are at rest, {at_rest} of them: 'tftool info {word}' says where."


def read_frames(
    found: Found, robot: DescriptionOptions, recording: RecordingOptions, progress: Progress | None
) -> Frames:
    """Return the frames of a recording, a robot description or a file of static transforms."""
    if found.kind.is_recording:
        return _read_recording(found, robot, recording, progress)
    recording.refuse(f"'{found.name}' is a {found.kind.value}")
    return _read_statics(found, robot) if found.kind is Kind.STATICS else _described(found, robot)


def _read_recording(
    found: Found, options: DescriptionOptions, reading: RecordingOptions, progress: Progress | None
) -> Frames:
    robot = _robot_beside(options)
    folder = None if reading.no_cache else default_folder()
    recording = open_recording(
        found.name,
        progress=progress,
        robot=robot,
        cache=None if folder is None else ColumnCache(folder),
        with_odometry=reading.with_odometry,
        tf_topics=reading.tf_topics,
    )
    try:
        _ = recording.transforms
    except BaseException:
        recording.close()
        raise
    notes = () if robot is None else robot.notes
    return Frames("recording", recording.name, recording=recording, found=found, notes=notes)


def _robot_beside(options: DescriptionOptions) -> Robot | None:
    """Return the robot of the description in `--urdf`; None without that option."""
    if options.joints:
        options.refuse("The joints of a recording cannot be set")
    if options.urdf is None and not options.arguments:
        return None
    if options.urdf is None:
        options.refuse("xacro arguments need a robot description: name one with --urdf FILE")

    assert options.urdf is not None
    return load_urdf(options.urdf, options.arguments)


def _described(found: Found, options: DescriptionOptions) -> Frames:
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


def load_described(found: Found, options: DescriptionOptions) -> Robot:
    """Read the robot description that the user named.

    Raises:
        InputError: If the description cannot be read or has mistakes.
        UsageError: If an extra is missing, or options do not fit the description.
    """
    if options.urdf is not None:
        raise UsageError(
            f"--urdf is only allowed for a recording, but '{visible(found.name)}' is a robot "
            "description."
        )
    return load_urdf(found.paths[0], options.arguments)


def _read_statics(found: Found, options: DescriptionOptions) -> Frames:
    from tftool.robots.static_publishers import load_statics

    options.refuse(f"'{visible(found.name)}' is a {found.kind.value}, not a robot description")
    statics = load_statics(found.paths[0], found.name)
    return Frames(
        "file of static transforms",
        found.name,
        buffer=statics.buffer,
        found=found,
        notes=statics.notes,
    )
