"""Turtles of a simulator in another process, as far as their poses tell."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from tftool.interfaces.values import message_class
from tftool.messages import Color, Pose2D
from tftool.nodes.trail import Segment, Trail
from tftool.nodes.turtle import PEN_COLOR, PEN_WIDTH
from tftool.nodes.turtlesim import BACKGROUND
from tftool.runtime.world import World
from tftool.stamps import Stamp, seconds

SILENT: Final = seconds(1)
"""A turtle that sends no pose for so long is gone, or its simulator is."""

MOST: Final = 50
"""So many turtles are listened to: each sends 62 poses a second."""

_POSE: Final = "/pose"


@dataclass(slots=True)
class FarTurtle:
    """What is known of a turtle elsewhere.

    Attributes:
        name: Its name.
        pose: The pose it sent last.
        heard: When that came.
        wall_hits: How often it met the wall, which no topic tells.
    """

    name: str
    pose: Pose2D
    heard: Stamp
    wall_hits: int = 0


class FarTurtles:
    """A simulator as it is seen from another process: drawn as the simulator is.

    Topics tell no pen and no background: those that turtlesim begins with are taken. The
    trail is what was drawn since the first look.

    Attributes:
        trail: What the pens drew since.
        background: The field's colour.
        revision: A number that changes whenever a turtle moves.
    """

    def __init__(self, world: World) -> None:
        """Look at the turtles that are there or come, the first fifty of them."""
        self.trail = Trail()
        self.background: Color = BACKGROUND
        self.revision = 0
        self._world = world
        self._known: dict[str, FarTurtle] = {}
        self._stops: dict[str, Callable[[], None]] = {}
        world.watch(self._look, "far turtles")
        self._look()

    @property
    def turtles(self) -> Mapping[str, FarTurtle]:
        """Every turtle that is heard of by its name, in the order of the names."""
        since = self._world.clock.now() - SILENT
        there = {name: one for name, one in sorted(self._known.items()) if one.heard >= since}
        return MappingProxyType(there)

    def _look(self) -> None:
        pose = message_class(Pose2D)
        for name, topic in tuple(self._world.topics().items()):
            if len(self._stops) >= MOST:
                return
            if name.endswith(_POSE) and topic.kind is pose and name not in self._stops:
                turtle = name.removesuffix(_POSE)
                # Noted first: to subscribe may call this again.
                self._stops[name] = lambda: None
                poses = self._world.value_topic(topic, Pose2D)
                self._stops[name] = poses.subscribe(self._taker(turtle), "far turtles")

    def _taker(self, name: str) -> Callable[[Pose2D], None]:
        def take(pose: Pose2D) -> None:
            now = self._world.clock.now()
            turtle = self._known.get(name)
            if turtle is None or turtle.heard < now - SILENT:
                if not self.turtles:
                    # The first, or the first of another simulator, on an empty sheet.
                    self.trail.wipe()
                self._known[name] = FarTurtle(name, pose, now)
                self.revision += 1
                return
            before, turtle.pose, turtle.heard = turtle.pose, pose, now
            if pose != before:
                self.revision += 1
            if (pose.x, pose.y) != (before.x, before.y):
                ends = (before.x, before.y, pose.x, pose.y)
                self.trail.draw(Segment(*ends, PEN_COLOR, PEN_WIDTH))

        return take
