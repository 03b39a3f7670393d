"""One turtle of the simulator: its state, and its update."""

import math
import re
from collections.abc import Callable
from typing import Any

from tftool.base.color import Color
from tftool.base.errors import UsageError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.geometry.motion.twist import Twist2D
from tftool.geometry.motion.unicycle import (
    COMMAND_TIMEOUT,
    FIELD,
    Placement,
    advance,
    clamp,
    float32,
    inside,
    published,
    turn_towards,
)
from tftool.messages.classes import build
from tftool.messages.turtle_messages import RotateAbsolute, pose
from tftool.world.log import Level
from tftool.world.nodes.trail import Segment
from tftool.world.topics import GoalHandle, Status

PEN_COLOR = Color(179, 184, 255)
PEN_WIDTH = 3

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

Say = Callable[[Level, str], object]
"""Takes a line for the log."""


def require_turtle_name(name: str) -> str:
    """Return the name, or refuse it: it becomes part of topic names and a frame.

    Raises:
        UsageError: If it is not a letter or '_' followed by letters, digits and '_'.
    """
    if _NAME.fullmatch(name) is None:
        raise UsageError(
            f"'{shown(name)}' cannot be a turtle's name: "
            "use letters, digits and '_', and no digit in front"
        )
    return name


def shown(name: str) -> str:
    """Return another process's name shortened and with control characters escaped."""
    return repr(name if len(name) <= 60 else name[:59] + "…")[1:-1]


class Turtle:
    """A turtle's state; only the simulator changes it, everybody may read it.

    Attributes:
        name: Its name, which is its frame's name too.
        pose: The Pose message published last, rounded to 32-bit floats.
        place: Its exact pose.
        forward: Speed along its heading in m/s; negative when reversing.
        sideways: Speed to its left in m/s.
        turn: Turn rate in rad/s.
        pen_on: Whether it draws.
        color: Colour of its pen.
        width: Width of its pen in pixels.
        wall_hits: In how many updates it met the wall.
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

    # What the simulator hands on, at the start of a tick

    def command(self, twist: Twist2D, holonomic: bool, now: Stamp, say: Say) -> None:
        """Set the velocity command, replacing all of the previous one.

        One exception: a simulator that is not holonomic, like turtlesim, keeps the previous
        sideways speed until the timeout or the rotate action clears it.
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
        """Queue a teleport for the next update, after earlier ones."""
        self._settled = False
        self._teleports.append(where)

    def set_pen(self, color: Color, width: int, off: bool) -> None:
        """Lift the pen, or lower it with other settings; width 0 means one pixel."""
        self.pen_on = not off
        if not off:
            self.color, self.width = color, max(width, 1)

    def rotate(self, goal: GoalHandle, theta: float, say: Say) -> None:
        """Accept a goal of the rotate action, a heading; an active one is aborted."""
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
        """End the current action, because the turtle is removed."""
        if self._goal is not None:
            self._end_goal("aborted")

    # One update

    def update(self, now: Stamp, say: Say, draw: Callable[[Segment], object]) -> Segment | None:
        """Teleport, turn, move and stop at the wall; `pose` is the result.

        Args:
            now: The moment of the tick.
            say: Takes log lines.
            draw: Takes the strokes of teleports.

        Returns:
            The stroke of the motion, to be drawn after the colour sensor looked; None
            where nothing is drawn.
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
        # At rest, every further update would change nothing, until something comes in.
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
        # Pushing meets the wall 62 times a second: said at first, then once a second.
        if not self._wall_met or now - self._wall_told >= NANOSECONDS:
            self._wall_told = now
            # turtlesim counts y downward here.
            say(
                "WARN",
                f"Oh no! I hit the wall! (Clamping from [x={place.x:f}, y={FIELD - place.y:f}])",
            )
        self._wall_met = True

    def _stroke(self, start: Placement, end: Placement) -> Segment:
        return Segment(start.x, start.y, end.x, end.y, self.color, self.width)

    def _pose(self) -> Any:
        state = (*self.place, self.forward, self.sideways, self.turn)
        # A turtle at rest publishes the very same value again.
        if state != self._shown_state:
            self._shown_state = state
            speed = math.hypot(self.forward, self.sideways)
            return pose(*published(*self.place, speed, self.turn))
        return self.pose
