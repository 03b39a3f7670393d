"""One turtle's topics, services and action, and the queue for the next tick."""

import asyncio
import math
from collections import deque
from collections.abc import Awaitable, Callable
from typing import Any, TypeVar

from tftool.base.color import Color
from tftool.base.errors import TftoolError, UsageError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.geometry.motion.unicycle import FIELD, Placement, float32_finite
from tftool.messages.turtle_messages import (
    ColorMessage,
    Pose,
    RotateAbsolute,
    SetPen,
    TeleportAbsolute,
    TeleportRelative,
    Twist,
    planar_velocity,
)
from tftool.world.clock import Clock
from tftool.world.nodes.turtle import Say, Turtle
from tftool.world.topics import GoalHandle
from tftool.world.world import World

T = TypeVar("T")

Work = Callable[[Stamp], T]
"""Something to do at a tick, given the tick's stamp."""


MOST_WAITING = 10_000
"""How much work may wait for a tick; a publisher that never pauses lets none come."""


class TickQueue:
    """Queue of work between two ticks, run in order at the next one.

    Arrivals in the instant of a tick wait for the next one, so that the order within an instant
    does not matter.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._waiting: deque[tuple[Stamp, Work[object]]] = deque()
        self._unanswered: set[asyncio.Future[Any]] = set()

    def put(self, work: Work[object]) -> bool:
        """Queue work for the next tick; return False if the queue is full."""
        if len(self._waiting) >= MOST_WAITING:
            return False
        self._waiting.append((self._clock.now(), work))
        return True

    def ask(self, work: Work[T]) -> "asyncio.Future[T]":
        """Queue work for the next tick, and wait for its result.

        The future's exception is a TftoolError if too many requests wait already.
        """
        answer: asyncio.Future[T] = asyncio.get_running_loop().create_future()

        def carry_out(tick: Stamp) -> None:
            outcome = work(tick)
            if not answer.done():
                answer.set_result(outcome)

        if not self.put(carry_out):
            answer.set_exception(TftoolError(f"{MOST_WAITING} requests wait for the next tick"))
            return answer
        self._unanswered.add(answer)
        answer.add_done_callback(self._unanswered.discard)
        return answer

    def deliver(self, tick: Stamp) -> None:
        """Run the work queued before this tick."""
        # Asked of the clock: on the wall clock a late tick takes all that came meanwhile.
        moment = self._clock.now()
        while self._waiting and self._waiting[0][0] < moment:
            self._waiting.popleft()[1](tick)

    def close(self, reason: str) -> None:
        """Drop the queued work; whoever waits for a result is refused with `reason`."""
        self._waiting.clear()
        for answer in list(self._unanswered):
            if not answer.done():
                answer.set_exception(TftoolError(reason))


class TurtlePorts:
    """A turtle's topics, services and action; requests wait for the next tick.

    Attributes:
        pose: Publisher of its poses.
        color: Publisher of its colour sensor.
    """

    def __init__(
        self,
        world: World,
        node: str,
        prefix: str,
        turtle: Turtle,
        queue: TickQueue,
        say: Say,
        is_holonomic: Callable[[], bool],
    ) -> None:
        """Open all of them.

        Args:
            world: The world.
            node: The simulator's name.
            prefix: Put before the turtle's name; empty, or ends with a slash.
            turtle: The node.
            queue: Queue of work for the next tick.
            say: Takes log lines.
            is_holonomic: Tells whether linear.y of a command counts now.
        """
        self._world, self._prefix, self._turtle = world, f"{prefix}{turtle.name}/", turtle
        self._queue, self._say, self._is_holonomic = queue, say, is_holonomic
        self._gone = False
        self._told: Stamp | None = None
        self.pose = world.publisher(node, f"{self._prefix}pose", Pose)
        self.color = world.publisher(node, f"{self._prefix}color_sensor", ColorMessage)
        for publisher in (self.pose, self.color):
            world.topic(publisher.name, publisher.kind)
        self._stops = [
            self.pose.close,
            self.color.close,
            world.subscribe(node, f"{self._prefix}cmd_vel", Twist, self._on_command),
            *(
                world.serve(self._prefix + name, handler, kind, node=node, shares=True)
                for name, handler, kind in (
                    ("teleport_absolute", self._on_teleport_absolute, TeleportAbsolute),
                    ("teleport_relative", self._on_teleport_relative, TeleportRelative),
                    ("set_pen", self._on_set_pen, SetPen),
                )
            ),
            world.serve_action(
                f"{self._prefix}rotate_absolute",
                self._on_rotate,
                RotateAbsolute,
                node=node,
                shares=True,
            ),
        ]

    def close(self) -> None:
        """Close all of them, and abort an active goal."""
        for stop in self._stops:
            stop()
        self._stops.clear()
        self._gone = True
        self._turtle.leave()

    def remove_topics(self) -> None:
        """Remove the topics without a subscriber; the next turtle of that name reuses others."""
        for what in ("pose", "color_sensor", "cmd_vel"):
            topic = self._world.topics().get(self._prefix + what)
            if topic is not None and not topic.subscribers:
                self._world.remove_topic(topic.name)

    def _on_command(self, message: Any) -> None:
        twist = planar_velocity(message)
        if all(map(math.isfinite, (twist.linear_x, twist.linear_y, twist.angular_z))):
            if not self._queue.put(
                lambda tick: self._turtle.command(twist, self._is_holonomic(), tick, self._say)
            ):
                self._ignore(f": {MOST_WAITING} wait for the next tick already")
        else:
            self._ignore(f" that is not finite: {twist}")

    def _ignore(self, why: str) -> None:
        now = self._world.clock.now()
        # A broken sender sends many: logged once a second.
        if self._told is None or now - self._told >= NANOSECONDS:
            self._told = now
            self._say("WARN", f"Ignoring a velocity command for [{self._turtle.name}]{why}")

    def _on_teleport_absolute(self, request: Any) -> Awaitable[None]:
        x, y, theta = requested_placement(request)
        # Above the field means the top edge, without a word; the other sides meet the wall.
        there = Placement(x, min(y, FIELD), theta)
        return self._queue.ask(lambda _: self._turtle.teleport(lambda _: there))

    def _on_teleport_relative(self, request: Any) -> Awaitable[None]:
        linear = float32_finite(request.linear, "linear")
        angular = float32_finite(request.angular, "angular")

        def there(place: Placement) -> Placement:
            theta = place.theta + angular
            return Placement(
                place.x + math.cos(theta) * linear, place.y + math.sin(theta) * linear, theta
            )

        return self._queue.ask(lambda _: self._turtle.teleport(there))

    def _on_set_pen(self, request: Any) -> Awaitable[None]:
        color = Color(
            require_byte(request.r, "r"), require_byte(request.g, "g"), require_byte(request.b, "b")
        )
        width, off = require_byte(request.width, "width"), bool(require_byte(request.off, "off"))
        return self._queue.ask(lambda _: self._turtle.set_pen(color, width, off))

    def _on_rotate(self, goal: GoalHandle) -> None:
        theta = float32_finite(goal.request.theta, "theta")

        def rotate(_: Stamp) -> None:
            if self._gone:
                goal.finish("aborted", RotateAbsolute.Result())
            else:
                self._turtle.rotate(goal, theta, self._say)

        if not self._queue.put(rotate):
            goal.finish("aborted", RotateAbsolute.Result())


def requested_placement(request: Any) -> Placement:
    """Round x, y and theta of a request for Spawn or TeleportAbsolute to 32 bits.

    Raises:
        UsageError: If one of them is NaN, infinite or too large for that.
    """
    return Placement(
        float32_finite(request.x, "x"),
        float32_finite(request.y, "y"),
        float32_finite(request.theta, "theta"),
    )


def require_byte(value: int, what: str) -> int:
    """Return a colour channel's value, or refuse it by name.

    Raises:
        UsageError: If it is not a whole number from 0 to 255.
    """
    if not (isinstance(value, int) and 0 <= value <= 255):
        raise UsageError(f"{what} must be a whole number from 0 to 255, not {value!r}")
    return int(value)
