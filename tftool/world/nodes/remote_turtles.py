"""Turtles of a simulator in another process, known from the simulator's topics and services."""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, Final

from tftool.base.color import BACKGROUND, Color
from tftool.base.errors import TftoolError
from tftool.base.stamps import Stamp, seconds
from tftool.messages.classes import INTERFACES
from tftool.messages.turtle_messages import Pose
from tftool.world.endpoints import PUBLISHER
from tftool.world.node import Node
from tftool.world.node_parameters import value_of
from tftool.world.nodes.trail import SERVICE, FarDrawing, Segment, Trail
from tftool.world.nodes.turtle import PEN_COLOR, PEN_WIDTH
from tftool.world.nodes.turtlesim import BACKGROUND_PARAMETERS
from tftool.world.world import World

SILENT: Final = seconds(1)
"""Nanoseconds without a pose after which a turtle or its simulator counts as gone."""

MOST: Final = 50
"""Largest number of turtles to subscribe to: each sends 62 poses a second."""

PERIOD: Final = seconds(0.05)
"""Nanoseconds between two requests for new strokes while a turtle moves."""

RESTING: Final = seconds(0.5)
"""Nanoseconds between two requests for the background, or for strokes while no turtle moves."""

PATIENCE: Final = 2.0
"""Longest wait in seconds for a response of the simulator."""

_POSE: Final = "/pose"


@dataclass(slots=True)
class FarTurtle:
    """State of a turtle of another process, as far as topics show it.

    Attributes:
        name: Name of the turtle.
        pose: Last Pose message.
        heard: Time at which the last Pose message arrived, nanoseconds.
        wall_hits: Always 0: no topic reports hits of the wall.
    """

    name: str
    pose: Any
    heard: Stamp
    wall_hits: int = 0


class FarTurtles(Node):
    """Node that collects the turtles of a simulator in another process, in order to draw them.

    The background is read from the parameters of the node that sends the poses. If that node is
    tftool's simulator, a service returns the strokes of the pens. ROS 2's own turtlesim has no such
    service. The trail then shows the turtles' paths from now on, as if all pens had their initial
    settings.

    Attributes:
        trail: Lines of the pens.
        background: Colour of the field.
        revision: Number that changes with every change of the picture.
    """

    is_shown: ClassVar[bool] = False

    def __init__(self, world: World) -> None:
        """Subscribe to the poses of all present and future turtles, at most fifty."""
        super().__init__(world, "far_turtles")
        self.trail = Trail()
        self.background: Color = BACKGROUND
        self.revision = 0
        self._known: dict[str, FarTurtle] = {}
        self._listened_to: set[str] = set()
        self._drawing = FarDrawing(self.trail)
        # Names of turtles whose strokes the simulator has sent.
        self._told: frozenset[str] = frozenset()
        self._until_end(world.watch(self._look, self.name))
        self._look()

    @property
    def turtles(self) -> Mapping[str, FarTurtle]:
        """All known turtles by name, sorted."""
        since = self.world.clock.now() - SILENT
        there = {name: one for name, one in sorted(self._known.items()) if one.heard >= since}
        return MappingProxyType(there)

    async def run(self) -> None:
        """Request background and strokes regularly; strokes also after the picture changed."""
        asked, drawn = -RESTING, -1
        async for now in self.every(PERIOD, immediately=True):
            simulator = self._simulator()
            is_due = now >= asked + RESTING
            if is_due:
                asked = now
                await self._ask_background(simulator)
            if is_due or self.revision != drawn or not self._drawing.is_whole:
                drawn = self.revision
                await self._ask_strokes(simulator)

    def _simulator(self) -> str:
        """Return the name of the node that publishes the first turtle's pose; "" if unknown."""
        return next(filter(None, map(self._sender, self.turtles)), "")

    def _sender(self, turtle: str) -> str:
        """Return the name of the node that publishes a turtle's pose; "" if unknown."""
        return next((one.node for one in self.world.endpoints.of(turtle + _POSE, PUBLISHER)), "")

    async def _ask_background(self, simulator: str) -> None:
        kind: Any = INTERFACES.find("rcl_interfaces", "srv", "GetParameters")
        request = kind.Request(names=list(BACKGROUND_PARAMETERS))
        told = await self._ask(f"{simulator}/get_parameters", request)
        channels = [] if told is None else [value_of(one) for one in told.values]
        if len(channels) == 3 and all(type(one) is int for one in channels):
            background = Color(*(min(max(one, 0), 255) for one in channels))
            if background != self.background:
                self.background = background
                self.revision += 1

    async def _ask_strokes(self, simulator: str) -> None:
        request = self._drawing.request()
        told = await self._ask(f"{simulator}/{SERVICE}", request)
        if told is None:
            self._told = frozenset()
        else:
            self._told = frozenset(one for one in self.turtles if self._sender(one) == simulator)
            self._drawing.take(told)

    async def _ask(self, service: str, request: Any) -> Any:
        """Return a service's response; None if the service is missing or too slow."""
        if not self.world.has_service(service):
            return None
        try:
            async with asyncio.timeout(PATIENCE):
                return await self.world.call(service, request)
        except (TftoolError, TimeoutError):
            return None

    def _look(self) -> None:
        for name, topic in tuple(self.world.topics().items()):
            if len(self._listened_to) >= MOST:
                return
            if name.endswith(_POSE) and topic.kind is Pose and name not in self._listened_to:
                turtle = name.removesuffix(_POSE)
                # Added first, because subscribing may call this function again.
                self._listened_to.add(name)
                self._until_end(topic.subscribe(self._taker(turtle), self.name))

    def _taker(self, name: str) -> Callable[[Any], None]:
        def take(pose: Any) -> None:
            now = self.world.clock.now()
            turtle = self._known.get(name)
            if turtle is None or turtle.heard < now - SILENT:
                if not self.turtles and not self._told:
                    # For the first strokes, or those of another simulator, the drawing is cleared.
                    self.trail.wipe()
                self._known[name] = FarTurtle(name, pose, now)
                self.revision += 1
                return
            before, turtle.pose, turtle.heard = turtle.pose, pose, now
            if pose != before:
                self.revision += 1
            if (pose.x, pose.y) != (before.x, before.y) and name not in self._told:
                ends = (before.x, before.y, pose.x, pose.y)
                self.trail.draw(Segment(*ends, PEN_COLOR, PEN_WIDTH))

        return take
