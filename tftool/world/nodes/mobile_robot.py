"""Nodes that simulate a mobile robot's usual frames: map, odom, base_link, laser_link.

Only these nodes know the robot's true pose. Odometry adds up small errors and drifts. Localisation
corrects the drift every few seconds, so that odom jumps in the map. A laser sees one point of a
wall. This point is fixed in the map and therefore moves in odom.
"""

import math
import random
from typing import Any, ClassVar

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.motion import Placement, Twist2D
from tftool.geometry.rigid import Transform, transform_from_pose
from tftool.messages.turtle_messages import Pose, Twist, planar_velocity, pose
from tftool.world.clock import Phase
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import require_period
from tftool.world.world import World

TRUTH = "ground_truth"
"""Topic of a robot's true pose in the map, below the name of the robot's base frame."""


class RobotOdometry(Node):
    """Node that drives a robot, and broadcasts its wheel odometry: odom to base_link.

    The node publishes the true pose on `<base>/ground_truth`, and subscribes to `<base>/cmd_vel`.
    """

    phase: ClassVar[Phase] = Phase.SIMULATE

    def __init__(
        self,
        world: World,
        name: str = "odometry",
        *,
        odom: str = "odom",
        base: str = "base_link",
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        speed: float = 0.5,
        turn_rate: float = 0.25,
        scale_error: float = 0.02,
        turn_error: float = 0.01,
        period: Duration = seconds(0.02),
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            odom: Frame of odometry, which coincides with the map at the start.
            base: Frame of the robot.
            start: x, y and heading in the map at the start.
            speed: Speed in m/s until the first command.
            turn_rate: Turn rate in rad/s until the first command.
            scale_error: Fraction by which the wheels overestimate a distance.
            turn_error: Error in rad/s that the wheels add to the true turn rate while the robot
                moves.
            period: Nanoseconds between two broadcasts.
        """
        super().__init__(world, name)
        self.odom, self.base = odom, base
        self.period = require_period(period)
        self.scale_error, self.turn_error = scale_error, turn_error
        self.truth = Placement(*start)
        self.believed = Placement(*start)
        self._twist = Twist2D(speed, turn_rate)

    async def run(self) -> None:
        """Move the robot and broadcast its odometry every period until the end of the run."""
        self.subscribe(f"{self.base}/cmd_vel", Twist, self._on_command)
        step = as_seconds(self.period)
        first = True
        async for now in self.every(self.period, immediately=True):
            if not first:
                self._drive(step)
            first = False
            x, y, theta = self.truth
            speed, turn = self._twist.linear_x, self._twist.angular_z
            self.publish(f"{self.base}/{TRUTH}", pose(x, y, theta, speed, turn))
            self.broadcast(
                TransformStamped(now, self.odom, self.base, transform_from_pose(*self.believed))
            )

    def _on_command(self, message: Any) -> None:
        twist = planar_velocity(message)
        if math.isfinite(twist.linear_x) and math.isfinite(twist.angular_z):
            self._twist = twist
        else:
            self.warn(f"Ignoring a velocity command that is not finite: {twist}")

    def _drive(self, step: float) -> None:
        speed, turn = self._twist.linear_x, self._twist.angular_z
        error = self.turn_error if speed or turn else 0.0
        self.truth = _moved(self.truth, speed * step, turn * step)
        self.believed = _moved(
            self.believed, speed * (1.0 + self.scale_error) * step, (turn + error) * step
        )


class _Observer(Node):
    """Base of nodes that broadcast frames computed from the robot's true pose."""

    phase: ClassVar[Phase] = Phase.BROADCAST
    _truth: Any = None

    def _follow_truth(self, base: str) -> None:
        """Subscribe to the true pose of the robot whose base frame is `base`.

        If the world has only one robot, subscribe to that robot's pose for any `base`, because a
        laser may be mounted on another frame of the robot.
        """

        def take(truth: Any) -> None:
            self._truth = truth

        robots = [one.base for one in self.world.nodes if isinstance(one, RobotOdometry)]
        followed = robots[0] if len(robots) == 1 else base
        self.subscribe(f"{followed}/{TRUTH}", Pose, take)


class MapCorrection(_Observer):
    """Node that broadcasts map to odom; regular corrections of the drift make odom jump."""

    def __init__(
        self,
        world: World,
        name: str = "localization",
        *,
        map_frame: str = "map",
        odom: str = "odom",
        base: str = "base_link",
        correct_every: Duration = seconds(2),
        period: Duration = seconds(0.1),
    ) -> None:
        """Add the node to a world; `correct_every` and `period` are in nanoseconds."""
        super().__init__(world, name)
        self.map_frame, self.odom, self.base = map_frame, odom, base
        self.correct_every = require_period(correct_every)
        self.period = require_period(period)

    async def run(self) -> None:
        """Broadcast map to odom every `period`, and correct the drift every `correct_every`."""
        self._follow_truth(self.base)
        map_from_odom = Transform.identity()
        due = self.clock.now() + self.correct_every
        async for now in self.every(self.period, immediately=True):
            if now >= due:
                map_from_odom = self._corrected() or map_from_odom
                due += self.correct_every
            self.broadcast(TransformStamped(now, self.map_frame, self.odom, map_from_odom))

    def _corrected(self) -> Transform | None:
        if self._truth is None:
            return None
        try:
            odom_from_base = self.buffer.lookup_transform(self.odom, self.base).transform
        except TransformException as refusal:
            self.warn(f"Cannot correct the map: {refusal}")
            return None
        return _pose_of(self._truth) @ odom_from_base.inverse()


class LaserPoint(_Observer):
    """Node that broadcasts one point of a wall as the laser sees it: laser_link to laser_point.

    The broadcasts begin when the transform from robot to laser has been received.
    """

    def __init__(
        self,
        world: World,
        name: str = "laser",
        *,
        landmark: tuple[float, float, float] = (3.0, 1.0, 0.2),
        base: str = "base_link",
        laser: str = "laser_link",
        child: str = "laser_point",
        period: Duration = seconds(0.1),
    ) -> None:
        """Add the node to a world; `landmark` is the point in the map, in metres."""
        super().__init__(world, name)
        self.landmark = landmark
        self.base, self.laser, self.child = base, laser, child
        self.period = require_period(period)

    async def run(self) -> None:
        """Broadcast the point every period until the end of the run."""
        self._follow_truth(self.base)
        async for now in self.every(self.period, immediately=True):
            if self._truth is None or not self.buffer.can_transform(self.base, self.laser):
                continue
            base_from_laser = self.buffer.lookup_transform(self.base, self.laser).transform
            map_from_laser = _pose_of(self._truth) @ base_from_laser
            seen = map_from_laser.inverse().apply(self.landmark)
            self.broadcast(TransformStamped(now, self.laser, self.child, Transform(seen)))


class ScanMatcher(_Observer):
    """Node that broadcasts an estimate of the laser's motion from scans, in a separate tree.

    The node ignores the published transform from the robot to the laser, and uses the true pose of
    the laser on the robot.
    """

    def __init__(
        self,
        world: World,
        name: str = "scan_matcher",
        *,
        origin: str = "scan_start",
        child: str = "scan_laser",
        base: str = "base_link",
        mount: tuple[float, float, float] = (0.0, 0.0, 0.0),
        position: float = 0.002,
        angle: float = 0.002,
        seed: int = 0,
        period: Duration = seconds(0.04),
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            origin: Frame of the first scan.
            child: Frame of the laser as estimated from the scans.
            base: Frame of the robot with the laser.
            mount: True x, y and heading of the laser on the robot.
            position: Standard deviation of x and of y, metres.
            angle: Standard deviation of the heading, radians.
            seed: Seed of the noise.
            period: Nanoseconds between two broadcasts.
        """
        super().__init__(world, name)
        self.origin, self.child, self.base = origin, child, base
        self.mount = transform_from_pose(*mount)
        self.position, self.angle = position, angle
        self.period = require_period(period)
        self._dice = random.Random(seed)

    async def run(self) -> None:
        """Broadcast the laser's estimated pose every period until the end of the run."""
        self._follow_truth(self.base)
        start_from_map: Transform | None = None
        async for now in self.every(self.period, immediately=True):
            if self._truth is None:
                continue
            map_from_laser = _pose_of(self._truth) @ self.mount
            start_from_map = start_from_map or map_from_laser.inverse()
            x, y = (self._dice.gauss(0.0, self.position) for _ in range(2))
            wrong = transform_from_pose(x, y, self._dice.gauss(0.0, self.angle))
            seen = start_from_map @ map_from_laser @ wrong
            self.broadcast(TransformStamped(now, self.origin, self.child, seen))


def _pose_of(truth: Any) -> Transform:
    return transform_from_pose(truth.x, truth.y, truth.theta)


def _moved(start: Placement, distance: float, turned: float) -> Placement:
    """Return a pose moved along an exact arc, so that odometry errors come only from the wheels."""
    middle = start.theta + turned / 2
    chord = distance * (math.sin(turned / 2) / (turned / 2) if turned else 1.0)
    return Placement(
        start.x + chord * math.cos(middle),
        start.y + chord * math.sin(middle),
        start.theta + turned,
    )
