"""Node turtlesim: the field and its turtles with all their services, topics and actions."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar

from tftool.base.color import BACKGROUND, Color
from tftool.base.errors import UsageError
from tftool.base.stamps import Stamp
from tftool.geometry.motion import CENTRE, TICK, Placement
from tftool.messages.classes import build
from tftool.messages.turtle_messages import ColorMessage, Empty, Kill, Spawn
from tftool.world.clock import Phase
from tftool.world.log import Level
from tftool.world.node import Node
from tftool.world.node_parameters import Value, serve_parameters
from tftool.world.nodes.trail import DrawingService, Trail
from tftool.world.nodes.turtle import (
    TickQueue,
    Turtle,
    TurtlePorts,
    requested_placement,
    require_byte,
    require_turtle_name,
    shown,
)
from tftool.world.world import World

MOST_TURTLES = 1000
"""Largest number of turtles at once, because each is updated at every tick."""

BACKGROUND_PARAMETERS = ("background_r", "background_g", "background_b")


class Turtlesim(Node):
    """Turtle simulator with a tick every 16 ms.

    Commands, requests and goals wait for the next tick. At a tick, every turtle is updated once, in
    the order of the names. A turtle publishes `pose` at every tick, publishes `color_sensor` while
    this topic has subscribers, and subscribes to `cmd_vel`. Services: spawn, kill, clear, reset,
    and for each turtle teleport_absolute, teleport_relative, set_pen. Action of each turtle:
    rotate_absolute.

    Parameters: background_r, background_g, background_b (0 to 255), holonomic.

    Attributes:
        trail: Lines of the pens.
    """

    phase: ClassVar[Phase] = Phase.SIMULATE

    def __init__(
        self,
        world: World,
        name: str = "turtlesim",
        *,
        holonomic: bool = False,
        background: Color = BACKGROUND,
        turtles: Sequence[Any] = (),
        namespace: str = "",
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            holonomic: Whether the linear.y of a command is used.
            background: Colour of the field.
            turtles: Spawn requests for further turtles; turtle1 always exists.
            namespace: Text before the name of every topic, service and action.

        Raises:
            UsageError: If a channel of `background` is not from 0 to 255.
        """
        super().__init__(world, name)
        self.trail = Trail()
        for parameter, value in zip(
            BACKGROUND_PARAMETERS, (background.r, background.g, background.b), strict=True
        ):
            self.declare_parameter(parameter, require_byte(value, parameter))
        self.declare_parameter("holonomic", holonomic)
        self._prefix = f"{namespace.strip('/')}/" if namespace.strip("/") else ""
        self._initial = tuple(turtles)
        self._turtles: dict[str, Turtle] = {}
        self._ports: dict[str, TurtlePorts] = {}
        self._counter = 0
        self._queue = TickQueue(world.clock)

    # Public state

    @property
    def turtles(self) -> Mapping[str, Turtle]:
        """All turtles by name, sorted; read-only."""
        return MappingProxyType(self._turtles)

    @property
    def background(self) -> Color:
        """Colour of the field from the parameters, limited to 0 to 255."""
        r, g, b = (
            min(max(int(self.get_parameter(name)), 0), 255) for name in BACKGROUND_PARAMETERS
        )
        return Color(r, g, b)

    def color_under(self, name: str) -> Color:
        """Return the colour that a turtle's sensor reads now.

        Raises:
            KeyError: If there is no such turtle.
        """
        place = self._turtles[name].place
        return self.trail.color_at(place.x, place.y)

    def set_parameter(self, name: str, value: Value) -> None:
        """Change a declared parameter.

        Raises:
            UsageError: If there is no such parameter, or the value is invalid.
        """
        if name in BACKGROUND_PARAMETERS and type(value) is int:
            require_byte(value, name)
        super().set_parameter(name, value)

    # Running

    async def run(self) -> None:
        """Simulate the turtles until the end of the run."""
        # If a world has two simulators, their names contain their namespaces.
        name = self.name.removeprefix(self._prefix)
        self.info(f"Starting turtlesim with node name /{self._prefix}{name}")
        there = self.world.services().get(f"{self._prefix}spawn")
        if there is not None and not there.is_remote:
            # As in ROS 2, both turtles follow the same cmd_vel, and one of them has the services.
            self.warn(
                f"'{there.node}' already provides the services of turtlesim here: give this "
                "simulator a namespace of its own (-r __ns:=/sim2), otherwise both simulators "
                "share every topic"
            )
        for service, handler, kind in (
            ("spawn", self._on_spawn, Spawn),
            ("kill", self._on_kill, Kill),
            ("clear", self._on_clear, Empty),
            ("reset", self._on_reset, Empty),
        ):
            self.serve(self._prefix + service, handler, kind, shares=True)
        serve_parameters(self)
        DrawingService(self, self.trail)
        start = self.clock.now()
        self._turtles, self._counter = {}, 0
        self._spawn(Placement(CENTRE, CENTRE, 0.0), "", start)
        for one in self._initial:
            self._spawn(requested_placement(one), one.name, start)

        first = True
        async for now in self.every(TICK, immediately=True):
            self._queue.deliver(now)
            if first:
                # turtlesim's first tick moves no turtle, but publishes the poses.
                first = False
                for name, turtle in self._turtles.items():
                    self._ports[name].pose.publish(turtle.pose)
            else:
                self._update(now)

    def close(self) -> None:
        """Close the simulator's topics and services, and refuse unprocessed requests.

        The turtles stay where they are, so that a screen can show the end of the run.
        """
        for ports in self._ports.values():
            ports.close()
        self._ports.clear()
        self._queue.close(f"simulator '{self.name}' has left")
        super().close()

    def _update(self, now: Stamp) -> None:
        for name, turtle in tuple(self._turtles.items()):
            ports = self._ports.get(name)
            if ports is None:  # a subscriber of a pose has removed the simulator
                return
            stroke = turtle.update(now, self._say, self.trail.draw)
            ports.pose.publish(turtle.pose)
            if ports.color.subscribers:
                ports.color.publish(build(ColorMessage, *self.color_under(name)))
            if stroke is not None:
                self.trail.draw(stroke)

    # Adding and removing turtles

    def _spawn(self, place: Placement, name: str, now: Stamp) -> str:
        """Create a turtle; return its name, or "" if the name cannot be used."""
        if not name:
            name = self._next_name()
        elif name in self._turtles:
            self.error(f"A turtle named [{name}] already exists")
            return ""
        refusal = self._refusal(name)
        if refusal:
            self.error(f"No turtle was spawned: {refusal}")
            return ""
        turtle = Turtle(name, place, now)
        # In the order of the names, in which turtles are updated and drawn.
        self._turtles = dict(sorted({**self._turtles, name: turtle}.items()))
        self._ports[name] = TurtlePorts(
            self.world, self.name, self._prefix, turtle, self._queue, self._say, self._is_holonomic
        )
        self.info(
            f"Spawning turtle [{name}] at x=[{place.x:f}], y=[{place.y:f}], theta=[{place.theta:f}]"
        )
        return name

    def _refusal(self, name: str) -> str:
        """Return the reason why no turtle can have this name; "" if the name is free and valid."""
        if len(self._turtles) >= MOST_TURTLES:
            return f"there are {MOST_TURTLES} already, kill one first"
        try:
            require_turtle_name(name)
        except UsageError as refusal:
            return str(refusal)
        return ""

    def _next_name(self) -> str:
        while True:
            self._counter += 1
            name = f"turtle{self._counter}"
            if name not in self._turtles:
                return name

    def _remove(self, name: str) -> None:
        del self._turtles[name]
        ports = self._ports.pop(name)
        ports.close()
        ports.remove_topics()

    # Requests to the simulator

    async def _on_spawn(self, request: Any) -> Any:
        place = requested_placement(request)
        return await self._queue.ask(
            lambda tick: build(Spawn.Response, self._spawn(place, request.name, tick))
        )

    async def _on_kill(self, request: Any) -> None:
        def kill(_: Stamp) -> None:
            if request.name in self._turtles:
                self._remove(request.name)
            else:
                self.error(f"Tried to kill turtle [{shown(request.name)}], which does not exist")

        await self._queue.ask(kill)

    async def _on_clear(self, _: Any) -> None:
        def clear(_: Stamp) -> None:
            self.info("Clearing turtlesim.")
            self.trail.wipe()

        await self._queue.ask(clear)

    async def _on_reset(self, _: Any) -> None:
        def reset(tick: Stamp) -> None:
            self.info("Resetting turtlesim.")
            for name in list(self._turtles):
                self._remove(name)
            self._counter = 0
            self._spawn(Placement(CENTRE, CENTRE, 0.0), "", tick)
            self.trail.wipe()

        await self._queue.ask(reset)

    # Helper functions

    def _is_holonomic(self) -> bool:
        return bool(self.get_parameter("holonomic"))

    def _say(self, level: Level, text: str) -> None:
        self.world.log.add(level, self.name, text)


def simulator_of(world: World) -> Turtlesim | None:
    """Return the turtle simulator among a world's nodes; None if no node is a simulator."""
    return next((node for node in world.nodes if isinstance(node, Turtlesim)), None)
