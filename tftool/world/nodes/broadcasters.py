"""Nodes that say where frames are: turtles, static links, carrots."""

import math
from collections.abc import Sequence
from typing import Any, ClassVar

from tftool.base.errors import UsageError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.planar import transform_from_pose
from tftool.geometry.rigid import Transform
from tftool.messages.turtle_messages import Pose
from tftool.world.clock import Phase
from tftool.world.node import Node
from tftool.world.world import World

CARROT_PERIOD: Duration = seconds(0.1)
"""How often the carrots are broadcast."""


class Broadcaster(Node):
    """Tell the buffer where a turtle is, at every pose it publishes.

    The pose carries no stamp; it gets the moment of its reception, which is the
    moment of the tick.
    """

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str,
        *,
        turtle: str = "turtle",
        frame_id: str = "world",
        topic: str | None = None,
    ) -> None:
        """Join the world.

        Args:
            world: Where to live.
            name: The node's name, shown as the authority of the frame.
            turtle: Whose pose to broadcast; the child frame's name too.
            frame_id: The frame the pose is given in.
            topic: Where the poses come from, `<turtle>/pose` unless said otherwise.
        """
        super().__init__(world, name)
        self.turtle = turtle
        self.frame_id = frame_id
        self.topic = topic or f"{turtle}/pose"
        self._pose: Any = None
        self._transform = Transform.identity()

    async def run(self) -> None:
        """Listen from now on."""
        self.subscribe(self.topic, Pose, self._on_pose)

    def _on_pose(self, pose: Any) -> None:
        # A turtle at rest publishes the very same value again and again.
        if pose is not self._pose:
            self._pose = pose
            self._transform = transform_from_pose(pose.x, pose.y, pose.theta)
        self.broadcast(
            TransformStamped(self.clock.now(), self.frame_id, self.turtle, self._transform)
        )


class StaticBroadcaster(Node):
    """Tell the buffer, once, of links that hold for all time."""

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(self, world: World, name: str, *, transforms: Sequence[TransformStamped]) -> None:
        """Join the world with links whose stamps will be set to the moment of the start."""
        super().__init__(world, name)
        self.transforms = tuple(transforms)

    async def run(self) -> None:
        """Broadcast, and be done."""
        now = self.clock.now()
        self.broadcast_static(*(one._replace(stamp=now) for one in self.transforms))


class FixedCarrot(Node):
    """Hang a carrot at a fixed offset from a frame, broadcast at 10 Hz like one that moves."""

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str,
        *,
        parent: str = "turtle1",
        child: str = "carrot1",
        offset: tuple[float, float, float] = (0.0, 2.0, 0.0),
        period: Duration = CARROT_PERIOD,
    ) -> None:
        """Join the world; `offset` is in metres, in the parent's frame."""
        super().__init__(world, name)
        self.parent, self.child = parent, child
        self.period = require_period(period)
        self._transform = Transform(offset)

    async def run(self) -> None:
        """Broadcast until the end."""
        async for now in self.every(self.period):
            self.broadcast(TransformStamped(now, self.parent, self.child, self._transform))


class DynamicCarrot(Node):
    """Hang a carrot on a circle around a frame: clockwise, once round in two seconds."""

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str,
        *,
        parent: str = "turtle1",
        child: str = "carrot1",
        radius: float = 10.0,
        whole_seconds: bool = False,
        period: Duration = CARROT_PERIOD,
    ) -> None:
        """Join the world.

        Args:
            world: Where to live.
            name: The node's name.
            parent: The frame in the middle of the circle.
            child: The carrot's frame.
            radius: In metres.
            whole_seconds: Whether the carrot jumps once a second, as in the tutorial's
                Python listing, instead of moving.
            period: Nanoseconds between two broadcasts.
        """
        super().__init__(world, name)
        self.parent, self.child = parent, child
        self.radius, self.whole_seconds = radius, whole_seconds
        self.period = require_period(period)

    async def run(self) -> None:
        """Broadcast until the end."""
        async for now in self.every(self.period):
            x, y = carrot_offset(now, self.radius, whole_seconds=self.whole_seconds)
            self.broadcast(TransformStamped(now, self.parent, self.child, Transform((x, y, 0.0))))


def carrot_offset(
    stamp: Stamp, radius: float = 10.0, *, whole_seconds: bool = False
) -> tuple[float, float]:
    """Where the dynamic carrot is at a moment: x and y in its parent's frame, in metres."""
    # Reduced as whole numbers: the seconds of a real clock are too large for an exact sine.
    turn = stamp % (2 * NANOSECONDS)
    if whole_seconds:
        turn -= turn % NANOSECONDS
    angle = turn / NANOSECONDS * math.pi
    return radius * math.sin(angle), radius * math.cos(angle)


def require_period(period: Duration) -> Duration:
    """Give the period back, or refuse it.

    Raises:
        UsageError: If it is not positive.
    """
    if period <= 0:
        raise UsageError(f"a period must be longer than 0 s, not {period / NANOSECONDS:g} s")
    return period
