"""Functions and nodes for tests of nodes in a world on simulated time."""

from collections.abc import Callable
from typing import Any, ClassVar

from tftool.base.stamps import seconds
from tftool.world.clock import Phase, SimClock, run
from tftool.world.node import Node
from tftool.world.supervisor import live
from tftool.world.world import World


def new_world() -> World:
    return World(SimClock())


def play(world: World, until: float) -> World:
    """Run a world until `until` seconds after the clock's epoch."""
    run(world.clock, live(world, until=world.clock.epoch + seconds(until)))
    return world


class At(Node):
    """Node that calls functions at given seconds after the epoch, and awaits awaitable results."""

    def __init__(
        self, world: World, *steps: tuple[float, Callable[[], Any]], name: str = "hands"
    ) -> None:
        super().__init__(world, name)
        self.steps = steps
        self.answers: list[Any] = []

    async def run(self) -> None:
        for second, action in self.steps:
            await self.clock.sleep_until(self.clock.epoch + seconds(second), self.phase, self.rank)
            answer = action()
            if hasattr(answer, "__await__"):
                answer = await answer
            self.answers.append(answer)


class Before(At):
    """Node like `At` that runs before all other nodes in each instant; create it first."""

    phase: ClassVar[Phase] = Phase.SIMULATE


class After(At):
    """Node like `At` that runs after all other nodes in each instant."""

    phase: ClassVar[Phase] = Phase.WATCH


def log_texts(world: World, node: str | None = None) -> list[str]:
    return [one.text for one in world.log.records if node in (None, one.node)]
