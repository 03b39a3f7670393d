"""Nodes that drive a turtle: along squares, like another turtle, along a rose curve."""

import asyncio
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType
from typing import Any, Final, Literal

from tftool.base.errors import TftoolError
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.geometry.motion import FIELD, TICK, Placement, float32
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Empty, Pose, RotateAbsolute, Twist, twist
from tftool.world.node import PATIENCE, Node
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.topics import GoalHandle
from tftool.world.world import World

_PI = 3.141592
"""π as written in ROS's draw_square, whose turns are slightly less than a right angle."""

_SIDE = 2.0


class State(Enum):
    """State of `DrawSquare`, the node that drives along squares."""

    FORWARD = "forward"
    STOP_FORWARD = "stop forward"
    TURN = "turn"
    STOP_TURN = "stop turn"


class DrawSquare(Node):
    """Node that drives a turtle along squares: forward, stop, turn, stop, and so on.

    Attributes:
        state: Present part of the motion, such as `State.TURN`.
        goal: Pose to reach next; None before the turtle's first pose.
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
        """Drive the turtle along squares until the end of the run."""
        self.publisher(f"{self.turtle}/cmd_vel", Twist)
        self.subscribe(f"{self.turtle}/pose", Pose, self._on_pose)
        async for _ in self.every(TICK, immediately=True):
            # Wait until the reset was requested, but not for its response.
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
        # Goals are rounded to 32-bit floats, like the poses that they are compared with.
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
    """Node that makes one turtle copy the motion of another turtle.

    The speed in a pose has no sign: if the leader reverses, the copy drives forward.
    """

    def __init__(
        self,
        world: World,
        name: str = "turtle_mimic",
        *,
        leader: str = "turtle1",
        copy: str = "turtle2",
    ) -> None:
        """Add the node to a world; both turtles' names may begin with a simulator's namespace."""
        super().__init__(world, name)
        self.leader, self.copy = leader, copy

    async def run(self) -> None:
        """Subscribe to the leader's poses, and send the copy a command for each pose."""
        self.publisher(f"{self.copy}/cmd_vel", Twist)
        self.subscribe(f"{self.leader}/pose", Pose, self._on_pose)

    def _on_pose(self, pose: Any) -> None:
        self.publish(f"{self.copy}/cmd_vel", twist(pose.linear_velocity, pose.angular_velocity))


IDLE_BEFORE: Final = seconds(5)
"""Nanoseconds without a command after which a turtle counts as idle."""

_PERIOD: Final = seconds(0.1)
_RADIUS: Final = 4.1
"""Radius of the rose in metres, small enough to stay away from the walls."""

_AHEAD: Final = 0.6
"""Distance in metres along the rose to the point that the turtle steers to."""

_SPEED: Final = 1.3
_STEPS: Final = 360


class IdleDrawing(Node):
    """Node that makes an idle turtle draw a rose curve of four petals repeatedly.

    Drawing begins after the time `patience` without a command, and ends with another node's next
    command or with `touch`. While `is_alone` returns False, nothing is drawn.

    Attributes:
        is_drawing: Whether the turtle is drawing now.
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
            name: Name of the node.
            turtle: Name of the turtle that draws.
            patience: Nanoseconds without commands after which the turtle draws.
            is_alone: Function that returns whether no other process has joined.
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
        """Draw whenever the turtle had no command for `patience`, until the end of the run."""
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
        """Stop drawing because somebody else drives the turtle, and wait for `patience` again."""
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
        # In one process, subscribers receive a message before `publish` returns.
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
        """Return the command that steers to a point of the rose curve a little ahead of `pose`."""
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
"""Lines that turtle_teleop_key prints at its start."""

SCALE_LINEAR = 2.0
"""Speed of the arrow keys in m/s, unless a parameter says otherwise."""

SCALE_ANGULAR = 2.0
"""Turn rate of the arrow keys in rad/s, unless a parameter says otherwise."""

MOST_SENDING = 100
"""Largest number of goals without a decision of the simulator; further keys are then ignored."""

Action = Literal["cmd_vel", "rotate", "cancel", "quit"]


@dataclass(frozen=True, slots=True)
class KeyPress:
    """Key pressed by a person or script: "up", "left", "g", "q" and so on."""

    key: str


@dataclass(frozen=True, slots=True)
class KeyMeaning:
    """Effect of a key of the teleop node.

    Attributes:
        action: Kind of action: drive, turn to a heading, cancel the turn, or quit.
        linear: For `cmd_vel`: fraction of scale_linear, from -1 to 1.
        angular: For `cmd_vel`: fraction of scale_angular, from -1 to 1.
        theta: For `rotate`: heading in radians.
        meaning: Short description for a help line.
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
"""Meaning of each key. The letters form a ring around F on a keyboard."""


class Teleop(Node):
    """Node that converts pressed keys to commands for a turtle, one message per press.

    Keys come from `press` and from the topic `keys`. The turtle stops when the simulator receives
    no command for a while. The parameters scale_linear and scale_angular are read at every press.
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
            name: Name of the node.
            turtle: Name of the turtle to drive, which may begin with a simulator's namespace.
            scale_linear: Speed of the arrow keys in m/s.
            scale_angular: Turn rate of the arrow keys in rad/s.

        Raises:
            UsageError: If `turtle` is not a valid name.
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
        """Handle keys from the topic `keys` until the quit key is pressed."""
        self.publisher(f"{self.turtle}/cmd_vel", Twist)
        stop = self.subscribe("keys", KeyPress, lambda pressed: self.press(pressed.key))
        try:
            await self._quit.wait()
        finally:
            stop()

    def press(self, key: str) -> Action | None:
        """Handle a pressed key.

        Args:
            key: "up", "down", "left", "right" or a letter of either case.

        Returns:
            Kind of action of the key; None for a key without a meaning.
        """
        meaning = KEYS.get(key.lower())
        if meaning is None:
            return None
        if meaning.action == "cmd_vel":
            linear = meaning.linear * float(self.get_parameter("scale_linear"))
            angular = meaning.angular * float(self.get_parameter("scale_angular"))
            # Adding 0.0 converts -0.0 to 0.0.
            self.publish(f"{self.turtle}/cmd_vel", twist(linear + 0.0, angular + 0.0))
        elif meaning.action == "rotate":
            # Keys also arrive on a topic, whose publisher may never pause.
            if self._sending < MOST_SENDING:
                self._sending += 1
                self.start_soon(self._rotate(meaning.theta))
        elif meaning.action == "cancel":
            # Without a running goal, there is nothing to cancel.
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
