"""`/clock` of another process: while it is published, a world that has joined reads it as now."""

from collections.abc import Callable
from typing import Any, Final

from tftool.base.stamps import NANOSECONDS, Duration
from tftool.buffer.clock_jumps import FELL_BACK, must_clear
from tftool.messages.classes import INTERFACES
from tftool.world.clock import FollowedClock
from tftool.world.endpoints import PUBLISHER
from tftool.world.link.graph import Graph
from tftool.world.link.link_context import NAME
from tftool.world.world import World

CLOCK_TOPIC: Final = "clock"
CLOCK_TYPE: Final = "rosgraph_msgs/msg/Clock"


def is_clock_shown(graph: Graph) -> bool:
    """Whether another process publishes `/clock`."""
    return any(one.ros_type == CLOCK_TYPE for one in graph.entities(PUBLISHER, name=CLOCK_TOPIC))


class ClockFollower:
    """Sets a world's clock by what others publish on `/clock`, for as long as one does."""

    def __init__(self, world: World, clock: FollowedClock) -> None:
        """Begin to follow, as soon as there is something to follow.

        Args:
            world: Whose topics tell.
            clock: Its clock.
        """
        self._world = world
        self._clock = clock
        self._stop_listening: Callable[[], None] | None = None
        self._is_looking = False
        self._stops = [
            clock.fell_back.add(self._fell_back, NAME),
            world.watch(self._look, NAME),
        ]
        self._look()

    def close(self) -> None:
        """Follow no more."""
        for stop in self._stops:
            stop()
        if self._stop_listening is not None:
            self._stop_listening()

    def _look(self) -> None:
        # To subscribe changes the world, which is told here in turn.
        if self._is_looking:
            return
        self._is_looking = True
        try:
            publishers = self._world.endpoints.of(CLOCK_TOPIC, PUBLISHER)
            is_published = any(one.is_remote and one.interface == CLOCK_TYPE for one in publishers)
            if is_published and self._stop_listening is None:
                kind = INTERFACES.message(CLOCK_TYPE)
                topic = self._world.topic(CLOCK_TOPIC, kind)
                self._stop_listening = topic.subscribe(self._take, NAME)
            elif not is_published and self._stop_listening is not None:
                self._stop_listening()
                self._stop_listening = None
                self._clock.run_on()
        finally:
            self._is_looking = False

    def _take(self, message: Any) -> None:
        time = message.clock
        self._clock.tell(time.sec * NANOSECONDS + time.nanosec)

    def _fell_back(self, by: Duration) -> None:
        if must_clear(-by):
            self._world.log.warn(NAME, FELL_BACK)
            self._world.buffer.clear()
