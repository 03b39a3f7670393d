"""Node of the turtle tutorial that steers a turtle towards a frame by transform lookups."""

from typing import Any

from tftool.base.errors import TftoolError, TransformException, UsageError
from tftool.base.stamps import LATEST, Duration, Stamp, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry import motion
from tftool.geometry.motion import Gains
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Spawn, Twist, twist
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import require_period
from tftool.world.nodes.turtle import require_turtle_name
from tftool.world.world import World

TUTORIAL_SPAWN = (4.0, 2.0, 0.0)
"""x, y and heading at which the tutorial's follower starts."""


class Follower(Node):
    """Node that spawns a turtle and steers the turtle towards a frame by transform lookups.

    With `delay`, the turtle drives to an earlier position of the leader. The lookup then takes the
    turtle's frame now and the leader's frame at the earlier time, connected through `fixed_frame`.
    """

    def __init__(
        self,
        world: World,
        name: str,
        *,
        leader: str = "turtle1",
        follower: str = "turtle2",
        period: Duration = seconds(1),
        delay: Duration = 0,
        fixed_frame: str | None = "world",
        distance_gains: Gains = motion.TUTORIAL_DISTANCE,
        bearing_gains: Gains = motion.TUTORIAL_BEARING,
        dead_band: float = 0.0,
        speed_limit: float | None = None,
        stale_after: Duration | None = None,
        spawn: tuple[float, float, float] | None = TUTORIAL_SPAWN,
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            leader: Frame to follow.
            follower: Name of the turtle to steer; the turtle's frame has the same name.
            period: Nanoseconds between two commands.
            delay: Age of the leader's pose to follow, nanoseconds.
            fixed_frame: Frame that does not move during the delay; the lookup connects both times
                through this frame. If None, both frames are looked up at the earlier time, so the
                turtle steers by its earlier pose.
            distance_gains: Gains from a distance in metres to a speed in m/s.
            bearing_gains: Gains from an angle in radians to a turn rate in rad/s.
            dead_band: Distance in metres at which the leader counts as reached.
            speed_limit: Largest speed in m/s; None for no limit.
            stale_after: Age of the newest transform in nanoseconds at which the turtle stops; if
                None, the turtle follows old transforms, like tf2's tutorial.
            spawn: x, y and heading at which to spawn the follower; None if the turtle exists
                already.

        Raises:
            UsageError: If a name, a time or a gain is invalid.
        """
        require_turtle_name(follower)
        if leader == follower:
            raise UsageError(f"'{follower}' cannot follow itself: name another leader")
        if delay < 0:
            raise UsageError(f"a delay must be 0 s or more, not {as_seconds(delay):g} s")
        if stale_after is not None and stale_after <= 0:
            raise UsageError(
                f"a limit for stale data must be longer than 0 s, not {as_seconds(stale_after):g} s"
            )
        self.period = require_period(period)
        self.law = motion.Law(distance_gains, bearing_gains, dead_band, speed_limit)
        super().__init__(world, name)
        self.leader, self.follower = leader, follower
        self.delay, self.fixed_frame = delay, fixed_frame
        self.stale_after = stale_after
        self._spawning = None if spawn is None else Spawning(self, *spawn, follower)
        self._memory = motion.AT_REST
        self._stale = False

    async def run(self) -> None:
        """Send the turtle a command every period until the end of the run."""
        self.publisher(f"{self.follower}/cmd_vel", Twist)
        async for now in self.every(self.period):
            if self._spawning is None or self._spawning.step():
                self._follow(now)

    def _follow(self, now: Stamp) -> None:
        try:
            self_from_leader = self._look(now)
        except TransformException as refusal:
            self._memory = motion.AT_REST
            self.info(f"Could not transform {self.follower} to {self.leader}: {refusal}")
            return
        if self._too_old(self_from_leader.stamp, now):
            return
        goal = self_from_leader.transform.translation
        command, self._memory = motion.steer(
            self.law, self._memory, goal.x, goal.y, as_seconds(self.period)
        )
        self.publish(f"{self.follower}/cmd_vel", twist(command.linear_x, command.angular_z))

    def _look(self, now: Stamp) -> TransformStamped:
        if self.delay == 0:
            return self.buffer.lookup_transform(self.follower, self.leader, LATEST)
        then = now - self.delay
        if self.fixed_frame is None:
            return self.buffer.lookup_transform(self.follower, self.leader, then)
        return self.buffer.lookup_transform_full(
            self.follower, LATEST, self.leader, then, self.fixed_frame
        )

    def _too_old(self, stamp: Stamp, now: Stamp) -> bool:
        """Return whether the newest transform is too old to follow; log a change of this result.

        With a delay, the result is False: a lookup at a given time fails if data is missing. Static
        transforms, with stamp 0, are never too old.
        """
        if self.stale_after is None or self.delay != 0 or stamp == LATEST:
            return False
        age = now - stamp
        stale = age > self.stale_after
        if stale and not self._stale:
            self._memory = motion.AT_REST
            self.warn(
                f"The newest transform of {self.leader} in {self.follower} is "
                f"{as_seconds(age):.3f} s old, the limit is {as_seconds(self.stale_after):g} s: "
                "stopping until there is a newer transform"
            )
            self.publish(f"{self.follower}/cmd_vel", twist())
        elif self._stale and not stale:
            self.info(f"There are new transforms of {self.leader}: following again")
        self._stale = stale
        return stale


class Spawning:
    """State machine that spawns a turtle as in the tutorial; a node's timer calls `step`.

    The first step sends the request, a later step reads the response, and the next step returns
    True. With a period of one second, `step` returns True after three seconds at the earliest.
    """

    def __init__(self, node: Node, x: float, y: float, theta: float, name: str) -> None:
        self._node = node
        self._request = build(Spawn.Request, x, y, theta, name)
        self._is_asked = False
        self._answer: Any | TftoolError | None = None
        self._confirmed = False

    def step(self) -> bool:
        """Do the next step of the spawning; return True if the turtle existed before this step."""
        if self._confirmed:
            return True
        if not self._is_asked:
            if self._node.world.has_service("spawn"):
                self._is_asked = True
                self._node.start_soon(self._ask())
            else:
                self._node.info("Service is not ready")
        elif self._answer is None:
            self._node.info("Spawn is not finished")
        else:
            self._take(self._answer)
        return False

    async def _ask(self) -> None:
        try:
            self._answer = await self._node.call("spawn", self._request)
        except TftoolError as refusal:
            self._answer = refusal

    def _take(self, answer: Any | TftoolError) -> None:
        if isinstance(answer, TftoolError):
            self._node.warn(f"Could not spawn '{self._request.name}', asking again: {answer}")
            self._is_asked, self._answer = False, None
            return
        # Any response counts, as in the tutorial: an empty name means that a turtle of
        # that name exists already, which is used.
        if answer.name:
            self._node.info(f"Successfully spawned {answer.name}")
        else:
            self._node.warn(f"{self._request.name} exists already, and is used")
        self._confirmed = True
