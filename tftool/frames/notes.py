"""Sentences about frames that were read: damage, gaps, joints without a position."""

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

from tftool.base.escaping import visible
from tftool.base.short_numbers import count
from tftool.recordings.tf_topics import implying

if TYPE_CHECKING:
    from tftool.recordings.description_frames import DescribedFrames
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot


def recording_notes(recording: "Recording") -> list[str]:
    """Return sentences about a recording's damage, unusual facts, and added links."""
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
                "No transform was recorded; --with-odometry takes these messages for some: "
                f"{', '.join(found[:5])}{' …' if len(found) > 5 else ''}."
            )


def _described_notes(described: "DescribedFrames | None") -> Iterator[str]:
    """Yield sentences about links added from a robot's description."""
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
            f"say where: {shown}."
        )


def beyond_limits(robot: "Robot", given: Mapping[str, float]) -> Iterator[str]:
    """Yield a sentence about given joint positions beyond their limits, which are used anyway.

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
    """Yield a sentence about the number of movable joints without a position."""
    at_rest = sum(
        joint.moves and joint.name not in given and robot.leader(joint.name, given) not in given
        for joint in robot.joints.values()
    )
    if at_rest:
        word = visible(name)
        yield f"Joints that move are at rest, {at_rest} of them: 'tftool info {word}' says where."
