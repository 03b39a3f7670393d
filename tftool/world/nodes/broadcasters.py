"""Nodes that broadcast frames: turtles, static transforms, moving points ("carrots"), noise."""

import math
from collections.abc import Sequence
from random import Random
from typing import Any, ClassVar

from tftool.base.errors import NodeArgumentsError, UsageError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform, transform_from_pose
from tftool.messages.turtle_messages import Pose
from tftool.world.clock import Phase
from tftool.world.node import Node
from tftool.world.world import World

CARROT_PERIOD: Duration = seconds(0.1)
"""Nanoseconds between two broadcasts of a carrot."""


class Broadcaster(Node):
    """Node that broadcasts a turtle's frame for every pose that the turtle publishes.

    A pose has no stamp. The frame's stamp is the time at which the pose was received.
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
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node, also the authority of the frame.
            turtle: Name of the turtle whose pose is broadcast; the child frame has the same name.
            frame_id: Frame in which the pose is given.
            topic: Topic of the poses; by default `<turtle>/pose`.
        """
        super().__init__(world, name)
        self.turtle = turtle
        self.frame_id = frame_id
        self.topic = topic or f"{turtle}/pose"
        self._pose: Any = None
        self._transform = Transform.identity()

    async def run(self) -> None:
        """Subscribe to the turtle's poses, and broadcast a frame for each pose."""
        self.subscribe(self.topic, Pose, self._on_pose)

    def _on_pose(self, pose: Any) -> None:
        # A turtle at rest publishes the same object repeatedly.
        if pose is not self._pose:
            self._pose = pose
            self._transform = transform_from_pose(pose.x, pose.y, pose.theta)
        self.broadcast(
            TransformStamped(self.clock.now(), self.frame_id, self.turtle, self._transform)
        )


class StaticBroadcaster(Node):
    """Node that broadcasts static transforms once."""

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(self, world: World, name: str, *, transforms: Sequence[TransformStamped]) -> None:
        """Add the node to a world; each transform gets the time of its broadcast as stamp."""
        super().__init__(world, name)
        self.transforms = tuple(transforms)

    async def run(self) -> None:
        """Broadcast the static transforms, and end."""
        now = self.clock.now()
        self.broadcast_static(*(one._replace(stamp=now) for one in self.transforms))


class FixedCarrot(Node):
    """Node that broadcasts a frame ("carrot") at a fixed offset from another frame, at 10 Hz."""

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
        """Add the node to a world; `offset` is in metres, in the parent's frame."""
        super().__init__(world, name)
        self.parent, self.child = parent, child
        self.period = require_period(period)
        self._transform = Transform(offset)

    async def run(self) -> None:
        """Broadcast the frame every period until the end of the run."""
        async for now in self.every(self.period):
            self.broadcast(TransformStamped(now, self.parent, self.child, self._transform))


class DynamicCarrot(Node):
    """Node that broadcasts a frame ("carrot") which circles another frame, clockwise, in 2 s."""

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
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            parent: Frame in the middle of the circle.
            child: Frame that is broadcast.
            radius: Radius of the circle in metres.
            whole_seconds: Whether the frame jumps once a second, as in the tutorial's
                Python listing, instead of moving.
            period: Nanoseconds between two broadcasts.
        """
        super().__init__(world, name)
        self.parent, self.child = parent, child
        self.radius, self.whole_seconds = radius, whole_seconds
        self.period = require_period(period)

    async def run(self) -> None:
        """Broadcast the frame every period until the end of the run."""
        async for now in self.every(self.period):
            x, y = carrot_offset(now, self.radius, whole_seconds=self.whole_seconds)
            self.broadcast(TransformStamped(now, self.parent, self.child, Transform((x, y, 0.0))))


def carrot_offset(
    stamp: Stamp, radius: float = 10.0, *, whole_seconds: bool = False
) -> tuple[float, float]:
    """Return (x, y) of the moving carrot in its parent's frame at the time `stamp`, metres."""
    # Reduced in nanoseconds, because a real clock's seconds are too large for an exact sine.
    turn = stamp % (2 * NANOSECONDS)
    if whole_seconds:
        turn -= turn % NANOSECONDS
    angle = turn / NANOSECONDS * math.pi
    return radius * math.sin(angle), radius * math.cos(angle)


def require_period(period: Duration) -> Duration:
    """Return `period` if positive; else raise an error.

    Raises:
        UsageError: If the period is not positive.
    """
    if period <= 0:
        raise UsageError(f"a period must be longer than 0 s, not {period / NANOSECONDS:g} s")
    return period


USAGE = "static_turtle_tf2_broadcaster child_frame_name x y z roll pitch yaw"


def static_turtle(arguments: Sequence[str]) -> TransformStamped:
    """Parse the seven arguments of the tutorial's static broadcaster.

    The angles are in the order roll, pitch, yaw; static_transform_publisher has yaw, pitch, roll.

    Args:
        arguments: child_frame_name x y z roll pitch yaw.

    Returns:
        Transform from `world`, with stamp 0; the broadcaster sets the stamp.

    Raises:
        NodeArgumentsError: If there are not seven arguments (status 1), the child is `world`, or an
            argument is not a number (status 2).
    """
    if len(arguments) != 7:
        raise NodeArgumentsError(f"Invalid number of parameters. Usage: \n$ {USAGE}", status=1)
    child, *texts = arguments
    if child == "world":
        raise NodeArgumentsError('Your static turtle name cannot be "world"', status=2)
    x, y, z, roll, pitch, yaw = (_number(text) for text in texts)
    return TransformStamped(
        0, "world", child, Transform((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
    )


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise NodeArgumentsError(f"{text!r} is not a finite number. Usage: {USAGE}", status=2)
    return number


class Noise(Node):
    """Node that broadcasts a frame near another frame, with noise and accumulating drift.

    Each broadcast has a new error, normally distributed in each coordinate and about each axis. The
    drift is a random walk in the plane: its standard deviation grows with the square root of time.
    Equal seeds give equal errors on every machine.
    """

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str = "noise",
        *,
        parent: str,
        child: str,
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
        position: float = 0.01,
        angle: float = 0.01,
        drift: float = 0.0,
        turn_drift: float = 0.0,
        seed: int = 0,
        period: Duration = seconds(0.1),
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            parent: Parent frame.
            child: Frame that is broadcast.
            offset: True position in the parent, in metres.
            position: Standard deviation of each coordinate, in metres.
            angle: Standard deviation about each axis, in radians.
            drift: Standard deviation of x and y after one second of drift, in metres.
            turn_drift: Standard deviation of the angle about z after one second of drift, in
                radians.
            seed: Seed of the errors.
            period: Nanoseconds between two broadcasts.

        Raises:
            UsageError: If a deviation is negative.
        """
        super().__init__(world, name)
        if min(position, angle, drift, turn_drift) < 0:
            raise UsageError(
                "a standard deviation must be zero or more, not "
                f"{min(position, angle, drift, turn_drift):g}"
            )
        self.parent, self.child = parent, child
        self.period = require_period(period)
        self._true = Transform(offset)
        self._position, self._angle = position, angle
        step = math.sqrt(as_seconds(self.period))
        self._drift, self._turn_drift = drift * step, turn_drift * step
        self._random = Random(seed)

    async def run(self) -> None:
        """Broadcast the frame with new errors every period until the end of the run."""
        off = self._random.gauss
        walked = (0.0, 0.0, 0.0)
        async for now in self.every(self.period, immediately=True):
            x, y, yaw = walked
            error = Transform(
                (
                    x + off(0.0, self._position),
                    y + off(0.0, self._position),
                    off(0.0, self._position),
                ),
                quaternion_from_rpy(
                    off(0.0, self._angle), off(0.0, self._angle), yaw + off(0.0, self._angle)
                ),
            )
            self.broadcast(TransformStamped(now, self.parent, self.child, self._true @ error))
            walked = (
                x + off(0.0, self._drift),
                y + off(0.0, self._drift),
                yaw + off(0.0, self._turn_drift),
            )
