"""Reader of frames from files: recordings, robot descriptions, static transforms."""

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.frames.frames import Frames
from tftool.frames.notes import beyond_limits, joints_at_rest
from tftool.frames.source_options import DescriptionOptions, RecordingOptions
from tftool.recordings.cache_heads import default_folder
from tftool.recordings.column_cache import ColumnCache
from tftool.recordings.contract import Progress
from tftool.recordings.find import Found, Kind
from tftool.recordings.recording import open_recording
from tftool.robots.robot_model import Robot, load_urdf


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
    """Return the robot of the description given for a recording; None without one."""
    if options.joints:
        options.refuse("The joints of a recording cannot be set")
    if options.urdf is None and not options.arguments:
        return None
    if options.urdf is None:
        options.refuse("Only a description takes arguments: give it with --urdf FILE")

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
            f"--urdf is for a recording, but '{visible(found.name)}' is a robot description."
        )
    return load_urdf(found.paths[0], options.arguments)


def _read_statics(found: Found, options: DescriptionOptions) -> Frames:
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
