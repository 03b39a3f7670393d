"""A robot description as FROM: every link where it is while the joints rest."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tftool.cli.notices import notice
from tftool.stamps import Stamp
from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.frames.buffer import Buffer
    from tftool.sources.find import Found


@dataclass(frozen=True, slots=True)
class RobotAtRest:
    """The frames of a description, which hold at all times; see `hosting.StoredFrames`."""

    name: str
    buffer: "Buffer"
    start: Stamp = 0
    end: Stamp = 0

    def close(self) -> None:
        """Nothing is left open."""


def read_at_rest(found: "Found") -> RobotAtRest:
    """Read a robot description; say on stderr where its moving joints are, and what is odd.

    Raises:
        InputError: If it cannot be read or has mistakes.
        UsageError: If it needs an extra that is not installed.
    """
    from tftool.sources.robot import load_urdf

    robot = load_urdf(found.paths[0])
    for note in robot.notes:
        notice(visible(note))
    moving = sum(joint.moves for joint in robot.joints.values())
    if moving:
        word = visible(found.name)
        notice(f"Joints that move are at rest, {moving} of them: 'tftool info {word}' says where.")
    return RobotAtRest(found.name, robot.buffer())
