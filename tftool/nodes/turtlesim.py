"""turtlesim: the field, its turtles, and every service, topic and action they have."""

import asyncio
import math
from collections import deque
from collections.abc import Awaitable, Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple, TypeVar

from tftool.errors import TftoolError, UsageError
from tftool.messages import (
    Clear,
    Color,
    Kill,
    Pose2D,
    Reset,
    RotateAbsolute,
    Rotated,
    SetPen,
    Spawn,
    Spawned,
    TeleportAbsolute,
    TeleportRelative,
    Twist2D,
)
from tftool.motion.unicycle import CENTRE, FIELD, TICK, Placement, float32_finite
from tftool.nodes.trail import Segment, Trail
from tftool.nodes.turtle import Turtle, require_turtle_name, shown
from tftool.runtime.clock import Phase
from tftool.runtime.log import Level
from tftool.runtime.node import Node
from tftool.runtime.parameters import Value
from tftool.runtime.topics import GoalHandle, Topic
from tftool.runtime.world import World
from tftool.stamps import NANOSECONDS, Stamp

T = TypeVar("T")

BACKGROUND = Color(69, 86, 255)
"""The field's colour unless parameters say otherwise."""

_BACKGROUND_PARAMETERS = ("background_r", "background_g", "background_b")


class Turtlesim(Node):
    """The turtle simulator, on a grid of 16 ms.

    Whatever arrives (commands, services, goals) waits for the next tick; then every
    turtle is updated once, in the order of the names. Topics of a turtle: `pose` out
    at every tick, `cmd_vel` in, `color_sensor` out at every tick while somebody
    subscribes to it. Services: spawn, kill, clear, reset, and of each turtle
    teleport_absolute, teleport_relative, set_pen. Action of each turtle: rotate_absolute.

    Parameters: background_r, background_g, background_b (0 to 255), holonomic.

    Attributes:
        trail: What the pens drew.
        revision: A number that changes whenever the picture does.
    """

    phase: ClassVar[Phase] = Phase.SIMULATE

    def __init__(
        self,
        world: World,
        name: str = "turtlesim",
        *,
        holonomic: bool = False,
        background: Color = BACKGROUND,
        turtles: Sequence[Spawn] = (),
        namespace: str = "",
    ) -> None:
        """Join the world.

        Args:
            world: Where to live.
            name: The node's name.
            holonomic: Whether linear.y of a command counts.
            background: Colour of the field.
            turtles: Further turtles to start with; turtle1 is always there.
            namespace: Put before the name of every topic, service and action.

        Raises:
            UsageError: If a channel of `background` is not from 0 to 255.
        """
        super().__init__(world, name)
        self.trail = Trail()
        self.revision = 0
        for parameter, value in zip(
            _BACKGROUND_PARAMETERS, (background.r, background.g, background.b), strict=True
        ):
            self.declare_parameter(parameter, _byte(value, parameter))
        self.declare_parameter("holonomic", holonomic)
        self.parameters.on_change(self._repaint)
        self._prefix = f"{namespace.strip('/')}/" if namespace.strip("/") else ""
        self._initial = tuple(turtles)
        self._turtles: dict[str, Turtle] = {}
        self._outlets: dict[str, _Outlet] = {}
        self._counter = 0
        self._tick: Stamp = 0
        self._waiting: deque[tuple[Stamp, Callable[[], object]]] = deque()
        self._unanswered: set[asyncio.Future[Any]] = set()
        self._told: dict[str, Stamp] = {}

    # What others may see

    @property
    def turtles(self) -> Mapping[str, Turtle]:
        """Every turtle by its name, in the order of the names; to be read only."""
        return MappingProxyType(self._turtles)

    @property
    def background(self) -> Color:
        """The field's colour as the parameters say now, held within 0 to 255."""
        r, g, b = (
            min(max(int(self.get_parameter(name)), 0), 255) for name in _BACKGROUND_PARAMETERS
        )
        return Color(r, g, b)

    def color_under(self, name: str) -> Color:
        """What the colour sensor of a turtle reads at this moment.

        Raises:
            KeyError: If there is no such turtle.
        """
        place = self._turtles[name].place
        return self.trail.color_at(place.x, place.y)

    def set_parameter(self, name: str, value: Value) -> None:
        """Change a parameter.

        Raises:
            UsageError: If there is no such parameter, or it takes other values.
        """
        if name in _BACKGROUND_PARAMETERS and type(value) is int:
            _byte(value, name)
        super().set_parameter(name, value)

    # Living

    async def run(self) -> None:
        """Simulate until the end."""
        self.info(f"Starting turtlesim with node name /{self._prefix}{self.name}")
        for service, handler in (
            ("spawn", self._on_spawn),
            ("kill", self._on_kill),
            ("clear", self._on_clear),
            ("reset", self._on_reset),
        ):
            self.serve(self._prefix + service, handler)
        start = self.clock.now()
        self._turtles, self._counter = {}, 0
        self._spawn(Placement(CENTRE, CENTRE, 0.0), "", start)
        for one in self._initial:
            self._spawn(_placement(one), one.name, start)

        first = True
        async for now in self.every(TICK, immediately=True):
            self._deliver(now)
            if first:
                # turtlesim's first tick moves nobody; the start is published all the same.
                first = False
                for name, turtle in self._turtles.items():
                    self._outlets[name].pose.publish(turtle.pose)
            else:
                self._update(now)

    def close(self) -> None:
        """Withdraw everything; who still waits for an answer is told that none will come.

        The turtles stay where they are, for whoever looks at the end.
        """
        for name, outlet in self._outlets.items():
            for stop in outlet.withdraw:
                stop()
            self._turtles[name].leave()
        self._outlets.clear()
        self._waiting.clear()
        for answer in self._unanswered:
            if not answer.done():
                answer.set_exception(TftoolError(f"simulator '{self.name}' has left"))
        super().close()

    def _deliver(self, now: Stamp) -> None:
        """Carry out what arrived before this tick, in the order it came."""
        self._tick = now
        # Asked of the clock: on the wall clock a late tick takes all that came meanwhile.
        moment = self.clock.now()
        while self._waiting and self._waiting[0][0] < moment:
            self._waiting.popleft()[1]()

    def _update(self, now: Stamp) -> None:
        for name, turtle in tuple(self._turtles.items()):
            outlet = self._outlets.get(name)
            if outlet is None:  # somebody who heard of a pose sent the simulator away
                return
            before = turtle.pose
            stroke = turtle.update(now, self._say, self._draw)
            outlet.pose.publish(turtle.pose)
            if outlet.color.subscribers:
                outlet.color.publish(self.color_under(name))
            if stroke is not None:
                self.trail.draw(stroke)
            if turtle.pose is not before:
                self.revision += 1

    # Turtles come and go

    def _spawn(self, place: Placement, name: str, now: Stamp) -> str:
        """Make a turtle; the empty string says that the name was refused."""
        if not name:
            name = self._next_name()
        elif name in self._turtles:
            self.error(f"A turtle named [{name}] already exists")
            return ""
        else:
            try:
                require_turtle_name(name)
            except UsageError as refusal:
                self.error(f"No turtle was spawned: {refusal}")
                return ""
        turtle = Turtle(name, place, now)
        # Kept in the order of the names: that is the order of updates and of drawing.
        self._turtles = dict(sorted({**self._turtles, name: turtle}.items()))
        self._outlets[name] = self._offer(turtle)
        self.revision += 1
        self.info(
            f"Spawning turtle [{name}] at x=[{place.x:f}], y=[{place.y:f}], theta=[{place.theta:f}]"
        )
        return name

    def _next_name(self) -> str:
        while True:
            self._counter += 1
            name = f"turtle{self._counter}"
            if name not in self._turtles:
                return name

    def _offer(self, turtle: Turtle) -> "_Outlet":
        """Open a turtle's topics, services and action."""
        world = self.world

        def on_command(twist: Twist2D) -> None:
            if not all(map(math.isfinite, (twist.linear_x, twist.linear_y, twist.angular_z))):
                self._seldom(
                    turtle.name,
                    f"Ignoring a velocity command for [{turtle.name}] that is not finite: {twist}",
                )
                return
            self._later(lambda: self._command(turtle, twist))

        withdraw = (
            world.topic(self._topic(turtle, "cmd_vel"), Twist2D).subscribe(on_command),
            world.serve(
                self._topic(turtle, "teleport_absolute"),
                lambda request: self._on_teleport_absolute(turtle, request),
            ),
            world.serve(
                self._topic(turtle, "teleport_relative"),
                lambda request: self._on_teleport_relative(turtle, request),
            ),
            world.serve(
                self._topic(turtle, "set_pen"), lambda request: self._on_set_pen(turtle, request)
            ),
            world.serve_action(
                self._topic(turtle, "rotate_absolute"),
                lambda goal: self._on_rotate(turtle, goal),
            ),
        )
        return _Outlet(
            world.topic(self._topic(turtle, "pose"), Pose2D),
            world.topic(self._topic(turtle, "color_sensor"), Color),
            withdraw,
        )

    def _remove(self, name: str) -> None:
        turtle = self._turtles.pop(name)
        for stop in self._outlets.pop(name).withdraw:
            stop()
        turtle.leave()
        for what in ("pose", "color_sensor", "cmd_vel"):
            topic = self._topic(turtle, what)
            # Whoever listens stays, and will hear the next turtle of this name.
            if not self.world.topics()[topic].subscribers:
                self.world.remove_topic(topic)
        self.revision += 1

    def _topic(self, turtle: Turtle, what: str) -> str:
        return f"{self._prefix}{turtle.name}/{what}"

    # What is asked of the simulator

    async def _on_spawn(self, request: Spawn) -> Spawned:
        place = _placement(request)
        return await self._at_next_tick(
            lambda: Spawned(self._spawn(place, request.name, self._tick))
        )

    async def _on_kill(self, request: Kill) -> None:
        def kill() -> None:
            if request.name in self._turtles:
                self._remove(request.name)
            else:
                self.error(f"Tried to kill turtle [{shown(request.name)}], which does not exist")

        await self._at_next_tick(kill)

    async def _on_clear(self, _: Clear) -> None:
        def clear() -> None:
            self.info("Clearing turtlesim.")
            self._wipe()

        await self._at_next_tick(clear)

    async def _on_reset(self, _: Reset) -> None:
        def reset() -> None:
            self.info("Resetting turtlesim.")
            for name in list(self._turtles):
                self._remove(name)
            self._counter = 0
            self._spawn(Placement(CENTRE, CENTRE, 0.0), "", self._tick)
            self._wipe()

        await self._at_next_tick(reset)

    # What is asked of one turtle

    def _command(self, turtle: Turtle, twist: Twist2D) -> None:
        holonomic = bool(self.get_parameter("holonomic"))
        turtle.command(twist, holonomic, self._tick, self._say)

    def _on_teleport_absolute(self, turtle: Turtle, request: TeleportAbsolute) -> Awaitable[None]:
        x, y, theta = _placement(request)
        # Above the field means the top edge, without a word; the other sides meet the wall.
        there = Placement(x, min(y, FIELD), theta)
        return self._at_next_tick(lambda: turtle.teleport(lambda _: there))

    def _on_teleport_relative(self, turtle: Turtle, request: TeleportRelative) -> Awaitable[None]:
        linear = float32_finite(request.linear, "linear")
        angular = float32_finite(request.angular, "angular")

        def there(place: Placement) -> Placement:
            theta = place.theta + angular
            return Placement(
                place.x + math.cos(theta) * linear, place.y + math.sin(theta) * linear, theta
            )

        return self._at_next_tick(lambda: turtle.teleport(there))

    def _on_set_pen(self, turtle: Turtle, request: SetPen) -> Awaitable[None]:
        color = Color(_byte(request.r, "r"), _byte(request.g, "g"), _byte(request.b, "b"))
        width, off = _byte(request.width, "width"), bool(_byte(request.off, "off"))
        return self._at_next_tick(lambda: turtle.set_pen(color, width, off))

    def _on_rotate(self, turtle: Turtle, goal: GoalHandle) -> None:
        goal.request = RotateAbsolute(float32_finite(goal.request.theta, "theta"))

        def rotate() -> None:
            if self._turtles.get(turtle.name) is turtle:
                turtle.rotate(goal, self._say)
            else:
                goal.finish("aborted", Rotated(0.0))

        self._later(rotate)

    # Little things

    def _later(self, work: Callable[[], object]) -> None:
        self._waiting.append((self.clock.now(), work))

    def _at_next_tick(self, work: Callable[[], T]) -> "asyncio.Future[T]":
        answer: asyncio.Future[T] = asyncio.get_running_loop().create_future()

        def carry_out() -> None:
            outcome = work()
            if not answer.done():
                answer.set_result(outcome)

        self._unanswered.add(answer)
        answer.add_done_callback(self._unanswered.discard)
        self._later(carry_out)
        return answer

    def _wipe(self) -> None:
        self.trail.wipe()
        self.revision += 1

    def _repaint(self, name: str, value: Value) -> None:
        self.revision += 1

    def _draw(self, segment: Segment) -> None:
        self.trail.draw(segment)
        self.revision += 1

    def _say(self, level: Level, text: str) -> None:
        self.world.log.add(level, self.name, text)

    def _seldom(self, about: str, text: str) -> None:
        """Warn, but about one thing once a second at most."""
        now = self.clock.now()
        told = self._told.get(about)
        if told is None or now - told >= NANOSECONDS:
            self._told[about] = now
            self.warn(text)


class _Outlet(NamedTuple):
    """What one turtle has towards others."""

    pose: Topic[Pose2D]
    color: Topic[Color]
    withdraw: tuple[Callable[[], None], ...]


def _placement(request: Spawn | TeleportAbsolute) -> Placement:
    return Placement(
        float32_finite(request.x, "x"),
        float32_finite(request.y, "y"),
        float32_finite(request.theta, "theta"),
    )


def _byte(value: int, what: str) -> int:
    if not (isinstance(value, int) and 0 <= value <= 255):
        raise UsageError(f"{what} must be a whole number from 0 to 255, not {value!r}")
    return int(value)
