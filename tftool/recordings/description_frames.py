"""Frames of a recorded robot description, added where the recorded transforms lack them."""

import re
from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from itertools import islice
from typing import Final

from tftool.base.errors import DescriptionError, InputError
from tftool.buffer.buffer import Buffer
from tftool.messages.classes import INTERFACES
from tftool.messages.codec import Codec
from tftool.messages.layouts import CDR, ROS1
from tftool.recordings.container_reader import Recorded, short_type
from tftool.recordings.contract import RecordedTopic
from tftool.recordings.joint_state_reader import RecordedJoints
from tftool.robots.robot_model import Robot, set_still
from tftool.robots.urdf import LARGEST, parse_description

STRING: Final = "std_msgs/String"
DESCRIPTION: Final = "robot_description"
_PLACEHOLDER: Final = re.compile(r'<robot name=""><link name=""\s*/></robot>')
_MOST_DESCRIPTIONS: Final = 8


@dataclass(frozen=True, slots=True)
class DescribedFrames:
    """Names of the frames that were added from a robot description.

    Attributes:
        still: Frames with static links.
        moving: Frames that joint states move.
        gaps: Frames whose pose neither tf nor joint states contain.
        prefix: Prefix of a link's name in the name of its frame.
    """

    still: tuple[str, ...] = ()
    moving: tuple[str, ...] = ()
    gaps: tuple[str, ...] = ()
    prefix: str = ""


def description_topics(topics: Iterable[RecordedTopic]) -> list[RecordedTopic]:
    """Return the topics that contain a robot description."""
    return [
        topic
        for topic in topics
        if short_type(topic.type) == STRING
        and topic.name.rpartition("/")[2] == DESCRIPTION
        and topic.encoding in ("cdr", "ros1")
        and topic.count
    ]


def read_description(source: Recorded, topic: RecordedTopic) -> Robot | None:
    """Return the first valid description on a topic.

    Returns:
        The robot; None if there are only placeholders, as some simulators send.

    Raises:
        InputError: If the message is not a string.
        DescriptionError: If all descriptions have mistakes; it has the mistakes of the first.
    """
    kind = INTERFACES.message("std_msgs/msg/String")
    codec = Codec(kind, ROS1 if topic.encoding == "ros1" else CDR)
    first: DescriptionError | None = None
    # A description is latched, and so among the first messages: do not read the whole recording.
    for message in islice(source.messages([topic.name]), _MOST_DESCRIPTIONS):
        if len(message.payload) > LARGEST:
            raise InputError(f"'{topic.name}' has no description that can be read")
        text = codec.decode(message.payload).data
        if _PLACEHOLDER.fullmatch(text.strip()):
            continue
        try:
            return Robot(parse_description(text, f"{source.name}:{topic.name}"))
        except DescriptionError as error:
            first = first or error
    if first is not None:
        raise first
    return None


def prefix_of(robot: Robot, frames: Collection[str]) -> str:
    """Return the prefix that robot_state_publisher was set to put before the names of links."""
    known = frozenset(frames)
    if not known or any(link in known for link in robot.links):
        return ""
    counted: Counter[str] = Counter()
    links = frozenset(robot.links)
    for frame in known:
        match = re.fullmatch(r"(.*/)([^/]+)", frame)
        if match and match[2] in links:
            counted[match[1]] += 1
    return counted.most_common(1)[0][0] if counted else ""


def missing_motion(robot: Robot, frames: Collection[str], prefix: str) -> list[str]:
    """Return the names of the movable joints whose frames tf lacks."""
    return [
        joint.name
        for joint in robot.joints.values()
        if joint.moves and prefix + joint.child not in frames
    ]


def add_described(
    buffer: Buffer,
    robot: Robot,
    joints: RecordedJoints,
    frames: Collection[str],
    prefix: str = "",
) -> DescribedFrames:
    """Insert the frames of a description that a buffer lacks.

    Args:
        buffer: Buffer with the recorded transforms.
        robot: The description.
        joints: The joint states of the same recording.
        frames: Child frames in the recorded transforms, which are not changed.
        prefix: Prefix before a link's name in the name of its frame.

    Returns:
        The added frames, and the missing ones.
    """
    still = []
    lacking = {joint.child for joint in robot.joints.values() if prefix + joint.child not in frames}
    for joint in robot.joints.values():
        if joint.child in lacking and not joint.moves and joint.type != "floating":
            set_still(buffer, joint, prefix=prefix)
            still.append(prefix + joint.child)
    moved = set()
    for states in joints.states:
        for joint, records in robot.motion(states, lambda joint: joint.child in lacking):
            records = records[records[:, 0] != 0]
            if len(records):
                parent, child = prefix + joint.parent, prefix + joint.child
                buffer.set_records(parent, child, records, f"joint {joint.name}")
                moved.add(child)
    moving = [
        prefix + joint.child for joint in robot.joints.values() if prefix + joint.child in moved
    ]
    there = {*still, *moving}
    gaps = [
        prefix + joint.child
        for joint in robot.joints.values()
        if joint.child in lacking and prefix + joint.child not in there
    ]
    return DescribedFrames(tuple(still), tuple(moving), tuple(gaps), prefix)
