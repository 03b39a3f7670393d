"""Nodes that drive a turtle: along squares, like another turtle, along a rose."""

import math
from collections.abc import Callable
from enum import Enum
from typing import Any, Final

from tftool.base.errors import TftoolError
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.geometry.motion.unicycle import FIELD, TICK, Placement, float32
from tftool.messages.turtle_messages import Empty, Pose, Twist, twist
from tftool.world.node import Node
from tftool.world.nodes.turtle import require_turtle_name
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


PATIENCE: Final = seconds(5)
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

    It begins after `PATIENCE` without a command, and ends with the next foreign command, with
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
        patience: Duration = PATIENCE,
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
