"""What a recording, and a robot's description beside it, gives a diagnosis to look at."""

from dataclasses import dataclass
from pathlib import Path

from tftool.base.errors import DescriptionError, InputError
from tftool.doctor.evidence import Material
from tftool.recordings.contract import Source, Transforms
from tftool.recordings.description_frames import description_topics, read_description
from tftool.recordings.joint_state_reader import joint_state_topics, read_joint_states
from tftool.robots.robot_model import Robot, load_urdf

ODOMETRY = "nav_msgs/Odometry"


def read(source: Source, transforms: Transforms, urdf: "Described | None" = None) -> Material:
    """Take from an opened source, whose transforms are read, what a diagnosis looks at.

    Args:
        source: The recording.
        transforms: Its transforms.
        urdf: The robot's description; None for the one that was recorded, if any.

    Raises:
        InputError: If the headers cannot be read.
    """
    described = urdf or _recorded_description(source)
    odometry = [topic.name for topic in source.topics if topic.type == ODOMETRY and topic.count]
    joints = None
    if described.robot is not None:
        names = joint_state_topics(source.topics, described.namespace)
        if names:
            states = read_joint_states(source, names).states
            joints = frozenset(name for one in states for name in one.names)
    return Material(
        joints=joints,
        robot=described.robot,
        mistakes=described.mistakes,
        odometry=source.transforms(odometry) if odometry else None,
        name=source.name,
        kind=source.kind,
        transforms=transforms,
        headers=source.headers(),
        clock=source.clock(),
        topics=source.topics,
        publishers=source.publishers,
        damage=tuple(dict.fromkeys((*source.damage, *transforms.damage))),
        start=source.start,
        end=source.end,
    )


@dataclass(frozen=True, slots=True)
class Described:
    """A robot description that was looked for.

    Attributes:
        robot: What it describes; None where there is none that can be read.
        mistakes: What is wrong with it, as sentences.
        namespace: That of its topic, "/arm" for "/arm/robot_description".
    """

    robot: Robot | None = None
    mistakes: tuple[str, ...] = ()
    namespace: str = ""


def described_by(path: str | Path) -> Described:
    """The robot that a URDF or xacro file describes, or what is wrong with it.

    Raises:
        InputError: If the file cannot be read.
        UsageError: If it needs xacro, which is not installed.
    """
    try:
        return Described(load_urdf(path))
    except DescriptionError as error:
        return Described(mistakes=_mistakes(error))


def _recorded_description(source: Source) -> Described:
    for topic in description_topics(source.topics):
        namespace = topic.name.rpartition("/")[0]
        try:
            return Described(read_description(source, topic), namespace=namespace)
        except DescriptionError as error:
            return Described(mistakes=_mistakes(error), namespace=namespace)
        except InputError as error:
            return Described(mistakes=(str(error),), namespace=namespace)
    return Described()


def _mistakes(error: DescriptionError) -> tuple[str, ...]:
    """Each with its line; the lines themselves are left out."""
    return tuple(
        f"{mistake.file}:{mistake.line}:{mistake.column}: {mistake.text}"
        for mistake in error.mistakes[: error.MOST]
    )
