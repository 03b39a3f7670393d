"""What a source, a buffer or a session gave: all that a diagnosis may look at."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from tftool.base.stamps import Stamp
from tftool.recordings.contract import (
    Headers,
    Publisher,
    RecordedTopic,
    Stamps,
    Transforms,
)

if TYPE_CHECKING:
    from tftool.robots.robot_model import Robot


@dataclass(frozen=True, slots=True, eq=False)
class Material:
    """What is known of the frames: all that a diagnosis may look at.

    Attributes:
        name: What it is called, for people.
        kind: What it is: "MCAP", "scenario".
        transforms: In columns, with log times.
        headers: Of messages, by topic.
        clock: What `/clock` read and when it was received, nanoseconds.
        topics: Every topic.
        publishers: Every stream of messages.
        damage: What could not be read, as sentences.
        start: Log time of the first message.
        end: Log time of the last.
        timed: Whether it has log times; a buffer has none.
        recorded: Whether it was recorded, and may be played.
        joints: Names in all joint states; None where none was recorded.
        robot: The robot's description, given or recorded; None without one that can be read.
        mistakes: What is wrong with the description, as sentences.
        odometry: Odometry messages as transforms; None where there are none.
    """

    name: str
    kind: str
    transforms: Transforms
    headers: Mapping[str, Headers] = field(default_factory=dict)
    clock: tuple[Stamps, Stamps] = field(
        default_factory=lambda: (np.zeros(0, np.int64), np.zeros(0, np.int64))
    )
    topics: tuple[RecordedTopic, ...] = ()
    publishers: tuple[Publisher, ...] = ()
    damage: tuple[str, ...] = ()
    start: Stamp = 0
    end: Stamp = 0
    timed: bool = True
    recorded: bool = True
    joints: frozenset[str] | None = None
    robot: "Robot | None" = None
    mistakes: tuple[str, ...] = ()
    odometry: Transforms | None = None
