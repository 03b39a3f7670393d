"""One turtle of the simulator: its state and update, its topics, services and action."""

import asyncio
import math
import re
from collections import deque
from collections.abc import Awaitable, Callable
from typing import Any, TypeVar

from tftool.base.color import Color
from tftool.base.errors import TftoolError, UsageError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.geometry.motion import (
    COMMAND_TIMEOUT,
    FIELD,
    Placement,
    Twist2D,
    advance,
    clamp,
    float32,
    float32_finite,
    inside,
    published,
    turn_towards,
)
from tftool.messages.classes import build
from tftool.messages.turtle_messages import (
    ColorMessage,
    Pose,
    RotateAbsolute,
    SetPen,
    TeleportAbsolute,
    TeleportRelative,
    Twist,
    planar_velocity,
    pose,
)
from tftool.world.clock import Clock
from tftool.world.log import Level
from tftool.world.nodes.trail import Segment
from tftool.world.topics import GoalHandle, Status
from tftool.world.world import World

T = TypeVar("T")

PEN_COLOR = Color(179, 184, 255)
PEN_WIDTH = 3

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

Say = Callable[[Level, str], object]
"""Function called with a log message's level and text."""


def require_turtle_name(name: str) -> str:
    """Return a turtle's name if valid in the names of topics and frames; else raise an error.

    Raises:
        UsageError: If the name is not a letter or '_' followed by letters, digits and '_'.
    """
    if _NAME.fullmatch(name) is None:
        raise UsageError(
            f"'{shown(name)}' cannot be a turtle's name: "
            "use letters, digits and '_', and no digit in front"
        )
    return name


def shown(name: str) -> str:
    """Return a received name for a log message, shortened, with control characters escaped."""
    return repr(name if len(name) <= 60 else name[:59] + "…")[1:-1]


class Turtle:
    """State of a turtle, which the simulator updates at every tick.

    Attributes:
        name: Name of the turtle and of its frame.
        pose: Pose message published last, rounded to 32-bit floats.
        place: Exact pose.
        forward: Speed along the heading in m/s; negative when reversing.
        sideways: Speed to the left in m/s.
        turn: Turn rate in rad/s.
        pen_on: Whether the turtle draws.
        color: Colour of the pen.
        width: Width of the pen in pixels.
        wall_hits: Number of updates in which the turtle hit the wall.
    """

    __slots__ = (
        "_commanded",
        "_goal",
        "_goal_delta",
        "_goal_start",
        "_goal_theta",
        "_settled",
        "_shown_state",
        "_teleports",
        "_wall_met",
        "_wall_told",
        "color",
        "forward",
        "name",
        "pen_on",
        "place",
        "pose",
        "sideways",
        "turn",
        "wall_hits",
        "width",
    )

    def __init__(self, name: str, start: Placement, now: Stamp) -> None:
        self.name = name
        self.place = start
        self.forward = self.sideways = self.turn = 0.0
        self.pen_on = True
        self.color = PEN_COLOR
        self.width = PEN_WIDTH
        self.wall_hits = 0
        self._commanded = now
        self._teleports: list[Callable[[Placement], Placement]] = []
        self._goal: GoalHandle | None = None
        self._goal_theta = self._goal_start = self._goal_delta = 0.0
        self._wall_met = False
        self._wall_told = now
        self._settled = False
        self._shown_state: tuple[float, ...] = ()
        self.pose = self._pose()

    # Commands and requests from the simulator, at the start of a tick

    def command(self, twist: Twist2D, holonomic: bool, now: Stamp, say: Say) -> None:
        """Set the velocities of a command in place of the previous velocities.

        Unless `holonomic`, the previous sideways speed stays, as in turtlesim, until the timeout or
        the rotate action clears it.
        """
        self._settled = False
        self._commanded = now
        self.forward, self.turn = twist.linear_x, twist.angular_z
        if holonomic:
            self.sideways = twist.linear_y
        if self._goal is not None:
            say("WARN", "Velocity command received during rotation goal. Aborting goal")
            self._end_goal("aborted")

    def teleport(self, where: Callable[[Placement], Placement]) -> None:
        """Queue a teleport, a function that returns the new pose, for the next update."""
        self._settled = False
        self._teleports.append(where)

    def set_pen(self, color: Color, width: int, off: bool) -> None:
        """Lift the pen if `off`; else lower the pen, with a colour and a width (0 as 1 pixel)."""
        self.pen_on = not off
        if not off:
            self.color, self.width = color, max(width, 1)

    def rotate(self, goal: GoalHandle, theta: float, say: Say) -> None:
        """Accept a heading as the goal of the rotate action, and abort an earlier goal."""
        if self._goal is not None:
            say(
                "WARN",
                "Rotation goal received before a previous goal finished. Aborting previous goal",
            )
            self._end_goal("aborted")
        self._settled = False
        self._goal, self._goal_theta = goal, theta
        self._goal_start, self._goal_delta = self.place.theta, 0.0

    def leave(self) -> None:
        """Abort the goal that is active when the turtle is removed."""
        if self._goal is not None:
            self._end_goal("aborted")

    # One update

    def update(self, now: Stamp, say: Say, draw: Callable[[Segment], object]) -> Segment | None:
        """Teleport and move the turtle at one tick, but not out of the field; store the pose.

        Args:
            now: Time of the tick, nanoseconds.
            say: Function called with log messages.
            draw: Function called with the strokes of teleports.

        Returns:
            Stroke of the motion, to draw after the colour sensor was read; None without a stroke.
        """
        if self._settled:
            return None
        for where in self._teleports:
            before, self.place = self.place, where(self.place)
            if self.pen_on and before[:2] != self.place[:2]:
                draw(self._stroke(before, self.place))
        self._teleports.clear()

        if self._goal is not None:
            self._pursue_goal(self._goal, now, say)
        if now - self._commanded > COMMAND_TIMEOUT:
            self.forward = self.sideways = self.turn = 0.0

        before = self.place
        place = advance(before, self.forward, self.sideways, self.turn)
        if inside(place):
            self._wall_met = False
        else:
            self._meet_wall(place, now, say)
            place = clamp(place)
        stroke = None
        if place != before:
            self.place = place
            if self.pen_on and (place.x != before.x or place.y != before.y):
                stroke = self._stroke(before, place)
        self.pose = self._pose()
        # At rest, updates change nothing until the next command or request.
        self._settled = not (
            self.forward or self.sideways or self.turn or self._goal or self._wall_met
        )
        return stroke

    def _pursue_goal(self, goal: GoalHandle, now: Stamp, say: Say) -> None:
        self.forward = self.sideways = self.turn = 0.0
        if goal.cancel_requested:
            say("INFO", "Rotation goal canceled")
            self._end_goal("canceled")
            return
        turning = turn_towards(self._goal_theta, self._goal_start, self.place.theta)
        self._goal_delta = turning.delta
        goal.publish_feedback(build(RotateAbsolute.Feedback, float32(turning.remaining)))
        if turning.done:
            say("INFO", "Rotation goal completed successfully")
            self._end_goal("succeeded")
        else:
            self.turn = turning.speed
            self._commanded = now

    def _end_goal(self, status: Status) -> None:
        goal, self._goal = self._goal, None
        assert goal is not None
        goal.finish(status, build(RotateAbsolute.Result, float32(self._goal_delta)))

    def _meet_wall(self, place: Placement, now: Stamp, say: Say) -> None:
        self.wall_hits += 1
        # A turtle may hit the wall 62 times a second: log the first hit, then one per second.
        if not self._wall_met or now - self._wall_told >= NANOSECONDS:
            self._wall_told = now
            # In this text, turtlesim's y axis points down.
            say(
                "WARN",
                f"Oh no! I hit the wall! (Clamping from [x={place.x:f}, y={FIELD - place.y:f}])",
            )
        self._wall_met = True

    def _stroke(self, start: Placement, end: Placement) -> Segment:
        return Segment(start.x, start.y, end.x, end.y, self.color, self.width)

    def _pose(self) -> Any:
        state = (*self.place, self.forward, self.sideways, self.turn)
        # A turtle at rest publishes the same object repeatedly.
        if state != self._shown_state:
            self._shown_state = state
            speed = math.hypot(self.forward, self.sideways)
            return pose(*published(*self.place, speed, self.turn))
        return self.pose


Work = Callable[[Stamp], T]
"""Function to call at a tick, with the tick's stamp."""


MOST_WAITING = 10_000
"""Largest number of requests that wait for a tick; a tick is late if a publisher never pauses."""


class TickQueue:
    """Queue of work between two ticks of the simulator, run in order at the next tick.

    Work that arrives at the exact time of a tick waits for the next tick, so that the order within
    one instant has no effect.
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
        """Queue work for the next tick; return a future of its result.

        The future's exception is a TftoolError if the queue is full.
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
        """Call the functions that were queued before now, each with the tick's time."""
        # The clock's time, not the tick's: a late tick processes all commands until now.
        moment = self._clock.now()
        while self._waiting and self._waiting[0][0] < moment:
            self._waiting.popleft()[1](tick)

    def close(self, reason: str) -> None:
        """Drop the queued work; the futures get an error with `reason`."""
        self._waiting.clear()
        for answer in list(self._unanswered):
            if not answer.done():
                answer.set_exception(TftoolError(reason))


class TurtlePorts:
    """Topics, services and action of a turtle; requests wait for the next tick.

    Attributes:
        pose: Publisher of the turtle's poses.
        color: Publisher of the turtle's colour sensor.
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
        """Open the turtle's topics, services and action.

        Args:
            world: World of the simulator.
            node: Name of the simulator's node.
            prefix: Text before the turtle's name in names of topics; empty, or ends with a slash.
            turtle: The turtle.
            queue: Queue of work for the next tick.
            say: Function called with log messages.
            is_holonomic: Function that returns whether commands may move the turtle sideways.
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
        """Close the topics, services and action, and abort an active goal."""
        for stop in self._stops:
            stop()
        self._stops.clear()
        self._gone = True
        self._turtle.leave()

    def remove_topics(self) -> None:
        """Remove topics without a subscriber; other topics stay for a later turtle of this name."""
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
        # Logged once a second, because a broken sender may send many.
        if self._told is None or now - self._told >= NANOSECONDS:
            self._told = now
            self._say("WARN", f"Ignoring a velocity command for [{self._turtle.name}]{why}")

    def _on_teleport_absolute(self, request: Any) -> Awaitable[None]:
        x, y, theta = requested_placement(request)
        # Above the field means the top edge, without a log message; the other sides hit the wall.
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
    """Return x, y and theta of a Spawn or TeleportAbsolute request, rounded to 32 bits.

    Raises:
        UsageError: If a number is NaN, infinite or too large for a 32-bit float.
    """
    return Placement(
        float32_finite(request.x, "x"),
        float32_finite(request.y, "y"),
        float32_finite(request.theta, "theta"),
    )


def require_byte(value: int, what: str) -> int:
    """Return the value of a colour channel if valid; else raise an error that names `what`.

    Raises:
        UsageError: If the value is not a whole number from 0 to 255.
    """
    if not (isinstance(value, int) and 0 <= value <= 255):
        raise UsageError(f"{what} must be a whole number from 0 to 255, not {value!r}")
    return int(value)
