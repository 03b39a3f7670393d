"""turtlesim's two small drivers: one draws squares, one copies another turtle."""

import math
from enum import Enum
from typing import Any

from tftool.base.errors import TftoolError
from tftool.geometry.motion.unicycle import TICK, Placement, float32
from tftool.messages.turtle_messages import Empty, Pose, Twist, twist
from tftool.world.node import Node
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.world import World

_PI = 3.141592
"""The program's own π: its goals are a hair short of a right angle."""

_SIDE = 2.0


class State(Enum):
    """What the square's driver is at."""

    FORWARD = "forward"
    STOP_FORWARD = "stop forward"
    TURN = "turn"
    STOP_TURN = "stop turn"


class DrawSquare(Node):
    """Drive a turtle along squares: forward, stop, turn, stop, at every tick one look.

    Attributes:
        state: What it is at.
        goal: Where it wants to be; None before the first pose.
    """

    def __init__(
        self,
        world: World,
        name: str = "draw_square",
        *,
        turtle: str = "turtle1",
        reset: bool = True,
    ) -> None:
        """Join the world; with `reset`, the simulator is reset first."""
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
    """Have one turtle do what another does.

    A pose's speed is a magnitude: where the leader reverses, the copy drives forward.
    """

    def __init__(
        self,
        world: World,
        name: str = "turtle_mimic",
        *,
        leader: str = "turtle1",
        copy: str = "turtle2",
    ) -> None:
        """Join the world; both names may carry a simulator's namespace in front."""
        super().__init__(world, name)
        self.leader, self.copy = leader, copy

    async def run(self) -> None:
        """Copy from now on."""
        self.publisher(f"{self.copy}/cmd_vel", Twist)
        self.subscribe(f"{self.leader}/pose", Pose, self._on_pose)

    def _on_pose(self, pose: Any) -> None:
        self.publish(f"{self.copy}/cmd_vel", twist(pose.linear_velocity, pose.angular_velocity))
