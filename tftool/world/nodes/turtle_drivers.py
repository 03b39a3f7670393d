"""Nodes that drive a turtle: along squares, like another turtle, along a rose, by arrow keys."""

import asyncio
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType
from typing import Any, Final, Literal

from tftool.base.errors import TftoolError
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.geometry.motion.unicycle import FIELD, TICK, Placement, float32
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Empty, Pose, RotateAbsolute, Twist, twist
from tftool.world.node import PATIENCE, Node
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.topics import GoalHandle
from tftool.world.world import World

_PI = 3.141592
"""The program's own π: its goals are a hair short of a right angle."""

_SIDE = 2.0


class State(Enum):
    """State of the square's driver."""

    FORWARD = "forward"
    STOP_FORWARD = "stop forward"
    TURN = "turn"
    STOP_TURN = "stop turn"


class DrawSquare(Node):
    """Drives a turtle along squares: forward, stop, turn, stop, one check per tick.

    Attributes:
        state: Present phase.
        goal: Goal; None before the first pose.
    """

    def __init__(
        self,
        world: World,
        name: str = "draw_square",
        *,
        turtle: str = "turtle1",
        reset: bool = True,
    ) -> None:
        """Add the node to a world; with `reset`, the simulator is reset first."""
        super().__init__(world, name)
        self.turtle = require_turtle_name(turtle)
        self.state = State.FORWARD
        self.goal: Placement | None = None
        self._pose: Any = None
        self._wants_reset = reset

    async def run(self) -> None:
        """Drive until the end."""
        self.publisher(f"{self.turtle}/cmd_vel", Twist)
        self.subscribe(f"{self.turtle}/pose", Pose, self._on_pose)
        async for _ in self.every(TICK, immediately=True):
            # The answer to the reset is not waited for, only that it was asked.
            if self._asked_for_reset() and self._pose is not None:
                self._look(self._pose)

    def _on_pose(self, pose: Any) -> None:
        self._pose = pose

    def _asked_for_reset(self) -> bool:
        if self._wants_reset and self.world.has_service("reset"):
            self._wants_reset = False
            self.start_soon(self._reset())
        return not self._wants_reset

    async def _reset(self) -> None:
        try:
            await self.call("reset", Empty.Request())
        except TftoolError as refusal:
            self.warn(f"The simulator was not reset: {refusal}")

    def _look(self, pose: Any) -> None:
        if self.goal is None:
            self._set_goal(self._ahead(pose))
        if self.state is State.FORWARD:
            self._drive_or_stop(pose, twist(1.0, 0.0), State.STOP_FORWARD)
        elif self.state is State.STOP_FORWARD:
            self._go_on_or_stop(pose, self._to_the_left(pose), State.TURN)
        elif self.state is State.TURN:
            self._drive_or_stop(pose, twist(0.0, 0.4), State.STOP_TURN)
        else:
            self._go_on_or_stop(pose, self._ahead(pose), State.FORWARD)

    def _drive_or_stop(self, pose: Any, drive: Any, then: State) -> None:
        if self._reached(pose):
            self.state = then
            self._send(twist())
        else:
            self._send(drive)

    def _go_on_or_stop(self, pose: Any, goal: Placement, then: State) -> None:
        if pose.angular_velocity < 0.0001 and pose.linear_velocity < 0.0001:
            self.info("Reached goal")
            self.state = then
            self._set_goal(goal)
        else:
            self._send(twist())

    def _reached(self, pose: Any) -> bool:
        assert self.goal is not None
        return (
            abs(float32(pose.x - self.goal.x)) < 0.1
            and abs(float32(pose.y - self.goal.y)) < 0.1
            and abs(float32(pose.theta - self.goal.theta)) < 0.01
        )

    def _set_goal(self, goal: Placement) -> None:
        # Goals are kept as 32-bit floats, like the poses they are compared with.
        self.goal = Placement(*map(float32, goal))
        self.info(f"New goal [{self.goal.x:f} {self.goal.y:f}, {self.goal.theta:f}]")

    def _send(self, command: Any) -> None:
        self.publish(f"{self.turtle}/cmd_vel", command)

    @staticmethod
    def _ahead(pose: Any) -> Placement:
        return Placement(
            pose.x + math.cos(pose.theta) * _SIDE,
            pose.y + math.sin(pose.theta) * _SIDE,
            pose.theta,
        )

    @staticmethod
    def _to_the_left(pose: Any) -> Placement:
        theta = math.fmod(pose.theta + _PI / 2, 2 * _PI)
        return Placement(pose.x, pose.y, theta - 2 * _PI if theta >= _PI else theta)


class Mimic(Node):
    """Makes one turtle copy another's motion.

    A pose's speed is a magnitude: if the leader reverses, the copy drives forward.
    """

    def __init__(
        self,
        world: World,
        name: str = "turtle_mimic",
        *,
        leader: str = "turtle1",
        copy: str = "turtle2",
    ) -> None:
        """Add the node to a world; both names may have a simulator's namespace in front."""
        super().__init__(world, name)
        self.leader, self.copy = leader, copy

    async def run(self) -> None:
        """Copy until the end."""
        self.publisher(f"{self.copy}/cmd_vel", Twist)
        self.subscribe(f"{self.leader}/pose", Pose, self._on_pose)

    def _on_pose(self, pose: Any) -> None:
        self.publish(f"{self.copy}/cmd_vel", twist(pose.linear_velocity, pose.angular_velocity))


IDLE_BEFORE: Final = seconds(5)
"""How long nothing must have driven the turtle."""

_PERIOD: Final = seconds(0.1)
_RADIUS: Final = 4.1
"""Of the rose that is drawn, metres: no wall is met."""

_AHEAD: Final = 0.6
"""How far ahead on the rose the turtle looks, metres."""

_SPEED: Final = 1.3
_STEPS: Final = 360


class IdleDrawing(Node):
    """Makes an idle turtle draw a rose of four petals repeatedly.

    It begins after `IDLE_BEFORE` without a command, and ends with the next foreign command, with
    `touch`, and while `is_alone` reports that others are there.

    Attributes:
        is_drawing: Whether it is drawing now.
    """

    def __init__(
        self,
        world: World,
        name: str = "idle_drawing",
        *,
        turtle: str = "turtle1",
        patience: Duration = IDLE_BEFORE,
        is_alone: Callable[[], bool] = lambda: True,
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: The node's name.
            turtle: Turtle that draws.
            patience: Time without commands before it draws, nanoseconds.
            is_alone: Whether no other process could drive it, or looks on.
        """
        super().__init__(world, name)
        self.turtle = require_turtle_name(turtle)
        self.is_drawing = False
        self._patience = patience
        self._is_alone = is_alone
        self._since: Stamp = 0
        self._pose: Any = None
        self._is_sending = False
        self._phase = 0
        self._told = False

    async def run(self) -> None:
        """Wait, draw, and wait again."""
        self._since = self.clock.now()
        self.publisher(f"{self.turtle}/cmd_vel", Twist)
        self.subscribe(f"{self.turtle}/cmd_vel", Twist, self._on_command)
        self.subscribe(f"{self.turtle}/pose", Pose, self._on_pose)
        async for now in self.every(_PERIOD):
            if not self._is_alone():
                self.touch()
            pose = self._pose
            if pose is None or now - self._since < self._patience:
                continue
            if not self.is_drawing:
                self._begin(pose)
            self._send(self._steer(pose))

    def touch(self) -> None:
        """Stop because a person or process drives, and restart the wait."""
        self._since = self.clock.now()
        if self.is_drawing:
            self.is_drawing = False
            self._send(twist())

    def _on_pose(self, pose: Any) -> None:
        self._pose = pose

    def _on_command(self, command: Any) -> None:
        if not self._is_sending:
            self._since = self.clock.now()
            self.is_drawing = False

    def _send(self, command: Any) -> None:
        # In one process subscribers get a message before this returns.
        self._is_sending = True
        try:
            self.publish(f"{self.turtle}/cmd_vel", command)
        finally:
            self._is_sending = False

    def _begin(self, pose: Any) -> None:
        self.is_drawing = True
        self._phase = min(range(_STEPS), key=lambda step: _away(pose, step))
        if not self._told:
            self._told = True
            self.info(f"{self.turtle} draws by itself until a key is pressed.")

    def _steer(self, pose: Any) -> Any:
        """Steer to a point of the rose slightly ahead."""
        for _ in range(_STEPS):
            if _away(pose, self._phase) >= _AHEAD:
                break
            self._phase = (self._phase + 1) % _STEPS
        x, y = _rose(self._phase)
        bearing = math.remainder(math.atan2(y - pose.y, x - pose.x) - pose.theta, math.tau)
        speed = _SPEED * max(0.15, math.cos(bearing)) if abs(bearing) < 1.4 else 0.1
        return twist(speed, max(-3.0, min(3.0, 3.0 * bearing)))


def _rose(step: int) -> tuple[float, float]:
    angle = math.tau * step / _STEPS
    away = _RADIUS * math.sin(2.0 * angle)
    return 0.5 * FIELD + away * math.cos(angle), 0.5 * FIELD + away * math.sin(angle)


def _away(pose: Any, step: int) -> float:
    x, y = _rose(step)
    return math.hypot(x - pose.x, y - pose.y)


BANNER = (
    "Reading from keyboard",
    "---------------------------",
    "Use arrow keys to move the turtle.",
    "Use g|b|v|c|d|e|r|t keys to rotate to absolute orientations. 'f' to cancel a rotation.",
    "'q' to quit.",
)
"""What teleop prints at its start, line by line."""

SCALE_LINEAR = 2.0
"""Speed of the arrow keys in m/s, unless a parameter says otherwise."""

SCALE_ANGULAR = 2.0
"""Turn rate of the arrow keys in rad/s, unless a parameter says otherwise."""

MOST_SENDING = 100
"""How many goals may be on their way to the simulator; further keys are ignored meanwhile."""

Action = Literal["cmd_vel", "rotate", "cancel", "quit"]


@dataclass(frozen=True, slots=True)
class KeyPress:
    """A key pressed by a person or script: "up", "left", "g", "q" and so on."""

    key: str


@dataclass(frozen=True, slots=True)
class KeyMeaning:
    """Meaning of a key.

    Attributes:
        action: Drive, turn to a heading, give the turning up, or quit.
        linear: For `cmd_vel`: the share of scale_linear, from -1 to 1.
        angular: For `cmd_vel`: the share of scale_angular, from -1 to 1.
        theta: For `rotate`: the heading in radians.
        meaning: A word or two for a help line.
    """

    action: Action
    meaning: str
    linear: float = 0.0
    angular: float = 0.0
    theta: float = 0.0


KEYS: Mapping[str, KeyMeaning] = MappingProxyType(
    {
        "up": KeyMeaning("cmd_vel", "forward", linear=1.0),
        "down": KeyMeaning("cmd_vel", "back", linear=-1.0),
        "left": KeyMeaning("cmd_vel", "turn left", angular=1.0),
        "right": KeyMeaning("cmd_vel", "turn right", angular=-1.0),
        "g": KeyMeaning("rotate", "east", theta=0.0),
        "t": KeyMeaning("rotate", "north-east", theta=0.7854),
        "r": KeyMeaning("rotate", "north", theta=1.5708),
        "e": KeyMeaning("rotate", "north-west", theta=2.3562),
        "d": KeyMeaning("rotate", "west", theta=3.1416),
        "c": KeyMeaning("rotate", "south-west", theta=-2.3562),
        "v": KeyMeaning("rotate", "south", theta=-1.5708),
        "b": KeyMeaning("rotate", "south-east", theta=-0.7854),
        "f": KeyMeaning("cancel", "cancel a rotation"),
        "q": KeyMeaning("quit", "quit"),
    }
)
"""Every key that does something. The letters form a ring round F on a keyboard."""


class Teleop(Node):
    """Converts keys to commands for a turtle; one press is one message.

    Keys come from `press` and from the topic `keys`. Stopping is the simulator's
    timeout. Parameters, read at every press: scale_linear, scale_angular.
    """

    def __init__(
        self,
        world: World,
        name: str = "teleop_turtle",
        *,
        turtle: str = "turtle1",
        scale_linear: float = SCALE_LINEAR,
        scale_angular: float = SCALE_ANGULAR,
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: The node's name.
            turtle: The turtle to drive; a simulator's namespace may stand in front.
            scale_linear: Speed of the arrow keys in m/s.
            scale_angular: Turn rate of the arrow keys in rad/s.

        Raises:
            UsageError: If `turtle` cannot be a turtle's name.
        """
        for part in turtle.split("/"):
            require_turtle_name(part)
        super().__init__(world, name)
        self.turtle = turtle
        self.declare_parameter("scale_linear", float(scale_linear))
        self.declare_parameter("scale_angular", float(scale_angular))
        self._goal: GoalHandle | None = None
        self._sending = 0
        self._quit = asyncio.Event()

    async def run(self) -> None:
        """Handle keys from the topic `keys` until the quit key."""
        self.publisher(f"{self.turtle}/cmd_vel", Twist)
        stop = self.subscribe("keys", KeyPress, lambda pressed: self.press(pressed.key))
        try:
            await self._quit.wait()
        finally:
            stop()

    def press(self, key: str) -> Action | None:
        """Handle a key.

        Args:
            key: "up", "down", "left", "right" or a letter of either case.

        Returns:
            The kind of action; None for a key that does nothing.
        """
        meaning = KEYS.get(key.lower())
        if meaning is None:
            return None
        if meaning.action == "cmd_vel":
            linear = meaning.linear * float(self.get_parameter("scale_linear"))
            angular = meaning.angular * float(self.get_parameter("scale_angular"))
            # Nothing plus nothing: a key that does not turn must not send minus zero.
            self.publish(f"{self.turtle}/cmd_vel", twist(linear + 0.0, angular + 0.0))
        elif meaning.action == "rotate":
            # Keys come from a topic as well, and its publisher may never pause.
            if self._sending < MOST_SENDING:
                self._sending += 1
                self.start_soon(self._rotate(meaning.theta))
        elif meaning.action == "cancel":
            # Without a goal, or when it has ended by now, there is nothing to cancel.
            if self._goal is not None:
                self._goal.cancel()
        else:
            self._quit.set()
        return meaning.action

    async def _rotate(self, theta: float) -> None:
        try:
            goal = build(RotateAbsolute.Goal, theta)
            self._goal = self.world.send_goal(
                f"{self.turtle}/rotate_absolute", goal, patience=PATIENCE
            )
        except TftoolError as refusal:
            self.warn(f"{self.turtle} cannot be turned: {refusal}")
        finally:
            self._sending -= 1
