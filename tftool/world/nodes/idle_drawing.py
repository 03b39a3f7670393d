"""A turtle that draws by itself while nothing else drives it."""

import math
from collections.abc import Callable
from typing import Any, Final

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.geometry.motion.unicycle import FIELD
from tftool.messages.turtle_messages import Pose, Twist, twist
from tftool.world.node import Node
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.world import World

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
    """Has a turtle draw a rose of four petals, again and again, while it is left alone.

    It begins when no command came for `PATIENCE`, and ends with the next command that is
    not its own, with `touch`, and while `is_alone` says that others are there.

    Attributes:
        is_drawing: Whether it does now.
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
        """Join the world.

        Args:
            world: Where to live.
            name: The node's name.
            turtle: Which turtle draws.
            patience: How long it must have been left alone, nanoseconds.
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
        """Stop because a person or a process is there, and restart the wait."""
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
        # In one process what is published is heard before this returns.
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
        """Steer to a point of the rose that stays a little ahead."""
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
