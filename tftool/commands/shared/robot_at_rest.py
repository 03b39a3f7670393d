"""A robot description as FROM: every link where it is while the joints rest, or as told."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from tftool.base.escaping import visible
from tftool.base.stamps import Stamp
from tftool.commands.shared.notices import notice

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer
    from tftool.frames.source_options import RobotOptions
    from tftool.recordings.find import Found
    from tftool.robots.robot_model import Robot
    from tftool.robots.static_publishers import StaticFrames


class StoredFrames(Protocol):
    """Frames that are all there: those of a recording, or of a robot description."""

    @property
    def name(self) -> str:
        """What it is called: "run.mcap"."""

    @property
    def start(self) -> "Stamp":
        """The moment from which `--at` counts."""

    @property
    def end(self) -> "Stamp":
        """The last moment there is data of."""

    @property
    def buffer(self) -> "Buffer":
        """All of it."""

    def close(self) -> None:
        """Close its files."""


@dataclass(frozen=True, slots=True)
class RobotAtRest:
    """The frames of a description, which hold at all times; see `files.StoredFrames`."""

    name: str
    robot: "Robot"
    buffer: "Buffer"
    start: Stamp = 0
    end: Stamp = 0

    @property
    def moving(self) -> frozenset[str]:
        """The links whose joint moves."""
        return frozenset(one.child for one in self.robot.joints.values() if one.moves)

    def close(self) -> None:
        """Nothing is left open."""


def load_described(found: "Found", options: "RobotOptions") -> "Robot":
    """Read the description that FROM names; what is odd about it goes to stderr.

    Raises:
        InputError: If it cannot be read or has mistakes.
        UsageError: If it needs an extra that is not installed, or options do not fit it.
    """
    from tftool.base.errors import UsageError
    from tftool.robots.robot_model import load_urdf

    if options.urdf is not None:
        raise UsageError(
            f"--urdf goes with a recording, and '{visible(found.name)}' is a robot description."
        )
    robot = load_urdf(found.paths[0], options.arguments)
    for note in robot.notes:
        notice(visible(note))
    return robot


def read_at_rest(found: "Found", options: "RobotOptions") -> RobotAtRest:
    """Read a robot description; say on stderr where its moving joints are, and what is odd.

    Raises:
        InputError: If it cannot be read or has mistakes.
        UsageError: If it needs an extra that is not installed, or options do not fit it.
    """
    robot = load_described(found, options)
    buffer = robot.buffer(options.joints)
    tell_beyond(robot, options.joints)
    _tell_rest(robot, options.joints, found.name)
    return RobotAtRest(found.name, robot, buffer)


def read_statics(found: "Found", options: "RobotOptions") -> "StaticFrames":
    """Read a file that publishes static transforms; what was passed over goes to stderr.

    Raises:
        InputError: If it cannot be read, or publishes none.
        UsageError: If there are options for a robot.
    """
    from tftool.robots.static_publishers import load_statics

    options.refuse(f"'{visible(found.name)}' is a {found.kind.value}, and no robot")
    statics = load_statics(found.paths[0], found.name)
    for note in statics.notes:
        notice(visible(note))
    return statics


def tell_beyond(robot: "Robot", given: Mapping[str, float]) -> None:
    """Say on stderr which positions lie beyond their joints' limits; they are taken all the same.

    Args:
        robot: Whose joints they are.
        given: Positions by joint, of joints it has.
    """
    for name, position in given.items():
        joint = robot.joints[name]
        if joint.limits is not None and not joint.limits[0] <= position <= joint.limits[1]:
            lower, upper = joint.limits
            notice(
                f"Joint '{visible(name)}' at {position:.4g} {joint.unit} is beyond its limits, "
                f"{lower:.4g} to {upper:.4g}."
            )


def _tell_rest(robot: "Robot", given: Collection[str], name: str) -> None:
    """Say on stderr how many joints were given no position."""
    at_rest = sum(
        joint.moves and joint.name not in given and robot.leader(joint.name, given) not in given
        for joint in robot.joints.values()
    )
    if at_rest:
        word = visible(name)
        notice(f"Joints that move are at rest, {at_rest} of them: 'tftool info {word}' says where.")
