"""Reader of frames from files: recordings, robot descriptions, static transforms."""

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.plain_text import count, visible
from tftool.frames.frames import Frames
from tftool.frames.source_options import DescriptionOptions, RecordingOptions
from tftool.recordings.find import Found, Kind
from tftool.robots.robot_model import Robot, load_urdf

if TYPE_CHECKING:
    from tftool.recordings.contract import Progress


def joints_at_rest(robot: "Robot", given: Collection[str], name: str) -> Iterator[str]:
    """Yield a sentence with the number of movable joints without a given position, if any.

    Args:
        robot: Robot of the joints.
        given: Names of the joints with a given position.
        name: Name of the description for the sentence.
    """
    at_rest = sum(
        joint.moves and joint.name not in given and robot.leader(joint.name, given) not in given
        for joint in robot.joints.values()
    )
    if at_rest:
        joints = count(at_rest, "joint")
        yield f"Default positions are used for {joints}: 'tftool info {visible(name)}' shows them."


def read_frames(
    found: Found,
    robot: DescriptionOptions,
    recording: RecordingOptions,
    progress: "Progress | None",
) -> Frames:
    """Return the frames of a recording, a robot description or a file of static transforms."""
    if found.kind.is_recording:
        # Recordings are read with numpy, which nothing else here needs.
        from tftool.frames.recording_frames import read_recording

        return read_recording(found, robot, recording, progress)
    recording.refuse(f"'{found.name}' is a {found.kind.value}")
    return _read_statics(found, robot) if found.kind is Kind.STATICS else _described(found, robot)


def _described(found: Found, options: DescriptionOptions) -> Frames:
    robot = load_described(found, options)
    buffer = robot.buffer(options.joints)
    notes = (
        *robot.notes,
        *robot.beyond_limits(options.joints),
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
