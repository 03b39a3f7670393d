"""turtle_teleop_key: arrow keys drive a turtle, eight letters around F turn it."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from tftool.base.errors import TftoolError
from tftool.messages.classes import build
from tftool.messages.turtle_messages import RotateAbsolute, Twist, twist
from tftool.world.node import PATIENCE, Node
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.topics import GoalHandle
from tftool.world.world import World

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
