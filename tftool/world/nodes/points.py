"""Nodes of tf2's message filter tutorial, in which points wait for their transforms."""

import asyncio
from typing import Any

from tftool.base.errors import TransformException
from tftool.base.stamps import NANOSECONDS, Duration, seconds
from tftool.messages.turtle_messages import PointStamped, Pose, point_stamped, twist
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import require_period
from tftool.world.nodes.follower import Spawning
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.world import World

POINT_TOPIC = "turtle_point_stamped"

QUEUE_LENGTH = 100
"""Largest number of points that wait for their transform; a further one drops the oldest."""


class MessageBroadcaster(Node):
    """Node that spawns a turtle, drives it in a circle, and publishes its position as points."""

    def __init__(
        self,
        world: World,
        name: str = "turtle_tf2_message_broadcaster",
        *,
        turtle: str = "turtle3",
        frame_id: str = "world",
        spawn: tuple[float, float, float] = (4.0, 2.0, 0.0),
        period: Duration = seconds(1),
    ) -> None:
        """Add the node to a world; `period` is the time between two steps of the spawning."""
        require_turtle_name(turtle)
        super().__init__(world, name)
        self.turtle, self.frame_id = turtle, frame_id
        self.period = require_period(period)
        self._spawning = Spawning(self, *spawn, turtle)

    async def run(self) -> None:
        """Spawn the turtle, then publish a point for each of its poses."""
        async for _ in self.every(self.period):
            if self._spawning.step():
                break
        self.subscribe(f"{self.turtle}/pose", Pose, self._on_pose)

    def _on_pose(self, pose: Any) -> None:
        self.publish(f"{self.turtle}/cmd_vel", twist(1.0, 1.0))
        self.publish(
            f"{self.turtle}/{POINT_TOPIC}",
            point_stamped(self.clock.now(), self.frame_id, pose.x, pose.y, 0.0),
        )


class PointDrawer(Node):
    """Node that logs each point's position in a frame as soon as the needed transform arrives."""

    def __init__(
        self,
        world: World,
        name: str = "turtle_tf2_pose_drawer",
        *,
        target_frame: str = "turtle1",
        turtle: str = "turtle3",
        patience: Duration = seconds(1),
    ) -> None:
        """Add the node to a world; `patience` is the longest wait for a point's transform."""
        super().__init__(world, name)
        self.target_frame, self.turtle = target_frame, turtle
        self.patience = require_period(patience)
        # A dict, because it keeps the order of arrival.
        self._waiting: dict[asyncio.Task[Any], None] = {}

    async def run(self) -> None:
        """Subscribe to the points, and log their positions until the end of the run."""
        self.subscribe(f"{self.turtle}/{POINT_TOPIC}", PointStamped, self._on_point)
        await asyncio.Event().wait()

    def _on_point(self, point: Any) -> None:
        if not point.header.frame_id:
            return
        if len(self._waiting) >= QUEUE_LENGTH:
            oldest = next(iter(self._waiting))
            del self._waiting[oldest]
            oldest.cancel()
        task = self.start_soon(self._place(point))
        self._waiting[task] = None
        task.add_done_callback(lambda done: self._waiting.pop(done, None))

    async def _place(self, point: Any) -> None:
        header = point.header
        stamp = header.stamp.sec * NANOSECONDS + header.stamp.nanosec
        try:
            found = await self.world.wait_for_transform(
                self.target_frame, header.frame_id, stamp, timeout=self.patience
            )
        except TransformException as refusal:
            self.warn(f"Failure {refusal}")
        else:
            x, y, z = found.transform.apply((point.point.x, point.point.y, point.point.z))
            self.info(
                f"Point of {self.turtle} in frame of {self.target_frame}: x:{x:f} y:{y:f} z:{z:f}"
            )
