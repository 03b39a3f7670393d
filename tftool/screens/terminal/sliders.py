"""Sliders for a robot's joints: positions, the chosen joint, and changes by keys."""

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from tftool.base.errors import UsageError
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot

STEPS = 50
"""Number of steps from one limit of a joint to the other."""

FINE = 10
"""Number of fine steps in one step."""


class Positions(Protocol):
    """Protocol of a node that stores joint positions, such as `JointStatePublisher`."""

    @property
    def positions(self) -> Mapping[str, float]:
        """Position of each joint by name, including mimic joints."""

    def move(self, joint: str, position: float) -> None:
        """Set the position of a joint."""


@dataclass(frozen=True, slots=True)
class Slider:
    """Slider of one joint as the screen shows it.

    Attributes:
        joint: The joint.
        position: Position in radians or metres; None if unknown.
        range: Smallest and largest position of the slider.
        is_chosen: Whether keys move the slider.
        follows: Whether the joint mimics another joint.
    """

    joint: RobotJoint
    position: float | None
    range: tuple[float, float]
    is_chosen: bool
    follows: bool

    @property
    def share(self) -> float | None:
        """Position as a fraction of the slider's range, from 0 to 1; None if unknown."""
        lower, upper = self.range
        if self.position is None or upper <= lower:
            return None
        return min(1.0, max(0.0, (self.position - lower) / (upper - lower)))


class Sliders:
    """Sliders of a robot's movable joints, with one chosen joint.

    Attributes:
        robot: The robot.
        entry: Text of a position typed so far; "" if nothing was typed.
        refusal: Reason why the last key had no effect, for the user; "" if there is no reason.
    """

    def __init__(self, robot: Robot, mover: Positions | None, *, seed: int = 0) -> None:
        """Create the sliders; the first joint is chosen.

        Args:
            robot: The robot.
            mover: Node that moves the joints; None if other programs move the joints.
            seed: Seed of random positions.
        """
        self.robot = robot
        self.entry = ""
        self.refusal = ""
        self._mover = mover
        self._heard: dict[str, float] = {}
        self._joints = [joint for joint in robot.joints.values() if joint.moves]
        self._chosen = next((n for n, one in enumerate(self._joints) if not self._follows(one)), 0)
        self._random = random.Random(seed)

    @property
    def can_move(self) -> bool:
        """Whether keys can move the joints."""
        return self._mover is not None

    @property
    def chosen(self) -> RobotJoint | None:
        """Joint that the keys move; None for a robot without joints."""
        return self._joints[self._chosen] if self._joints else None

    @property
    def sliders(self) -> Sequence[Slider]:
        """All sliders, in the order of the description."""
        known = self._heard if self._mover is None else self._mover.positions
        return [
            Slider(
                joint,
                known.get(joint.name),
                slide_range(joint),
                number == self._chosen,
                self._follows(joint),
            )
            for number, joint in enumerate(self._joints)
        ]

    def hear(self, positions: Mapping[str, float]) -> None:
        """Store joint positions that another program has published."""
        for name, position in positions.items():
            if self.robot.takes(name) and math.isfinite(position):
                self._heard[name] = position

    # What keys do

    def choose(self, step: int) -> None:
        """Choose the next or previous joint that is not a mimic joint."""
        self.entry = self.refusal = ""
        count = len(self._joints)
        place = self._chosen
        for _ in range(count):
            place = (place + step) % count
            if not self._follows(self._joints[place]):
                self._chosen = place
                return

    def step(self, direction: int, *, fine: bool = False) -> None:
        """Move the chosen joint by a step (small if `fine`): up if `direction` is 1, down if -1."""
        joint = self.chosen
        if joint is None or self._mover is None:
            return
        lower, upper = slide_range(joint)
        size = (upper - lower) / STEPS / (FINE if fine else 1)
        position = self._mover.positions[joint.name] + direction * size
        self._move(joint, min(upper, max(lower, position)))

    def type(self, sign: str) -> None:
        """Add a typed digit, "." or "-" to `entry`; a backspace removes the last character."""
        self.refusal = ""
        if sign == "\b":
            self.entry = self.entry[:-1]
        elif self._mover is not None and len(self.entry) < 20:
            self.entry += sign

    def enter(self) -> None:
        """Move the chosen joint to the typed position."""
        text, self.entry = self.entry, ""
        joint = self.chosen
        if not text or joint is None or self._mover is None:
            return
        try:
            position = float(text)
        except ValueError:
            self.refusal = f"'{text}' is not a number"
            return
        limits = joint.limits
        if limits is not None and not limits[0] <= position <= limits[1]:
            self.refusal = f"{position:g} is beyond the limits, {limits[0]:g} to {limits[1]:g}"
            return
        self._move(joint, position)

    def zero(self, *, all_joints: bool = True) -> None:
        """Set all joints, or the chosen joint, to zero or to the limit nearest to zero."""
        for joint in self._meant(all_joints):
            lower, upper = joint.limits or (0.0, 0.0)
            self._move(joint, min(upper, max(lower, 0.0)))

    def centre(self, *, all_joints: bool = True) -> None:
        """Set all joints, or the chosen joint, to the middle of their limits."""
        for joint in self._meant(all_joints):
            lower, upper = slide_range(joint)
            self._move(joint, (lower + upper) / 2.0)

    def scatter(self, *, all_joints: bool = True) -> None:
        """Set all joints, or the chosen joint, to random positions within their limits."""
        for joint in self._meant(all_joints):
            lower, upper = slide_range(joint)
            self._move(joint, self._random.uniform(lower, max(lower, upper)))

    def _meant(self, all_joints: bool) -> list[RobotJoint]:
        self.entry = self.refusal = ""
        if all_joints:
            return [joint for joint in self._joints if not self._follows(joint)]
        return [] if self.chosen is None else [self.chosen]

    def _move(self, joint: RobotJoint, position: float) -> None:
        if self._mover is None:
            self.refusal = "other nodes move the joints: leave out --follow to use the keys"
            return
        try:
            self._mover.move(joint.name, position)
        except UsageError as error:
            self.refusal = str(error)

    def _follows(self, joint: RobotJoint) -> bool:
        return self.robot.leader(joint.name) != joint.name


def slide_range(joint: RobotJoint) -> tuple[float, float]:
    """Return the smallest and largest position of a slider: the joint's limits, else -π and π."""
    return joint.limits or (-math.pi, math.pi)


def tip_of(robot: Robot) -> str:
    """Return the link farthest from the root by number of joints, usually a hand.

    If several links are equally far, return the first. Links below a floating joint are ignored,
    because their frames are not published.
    """
    depth = {robot.root: 0}
    waiting = [robot.root]
    children: dict[str, list[str]] = {}
    for joint in robot.joints.values():
        if joint.type != "floating":
            children.setdefault(joint.parent, []).append(joint.child)
    for link in waiting:
        for child in children.get(link, ()):
            depth[child] = depth[link] + 1
            waiting.append(child)
    return max(depth, key=lambda link: depth[link])
