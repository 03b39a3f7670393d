"""What tests of nodes need again and again: a world lived through, with hands in it."""

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
    """Live through `until` seconds from the clock's epoch."""
    run(world.clock, live(world, until=world.clock.epoch + seconds(until)))
    return world


class At(Node):
    """Do things at given seconds from the epoch; what they return is awaited where it can be."""

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
    """The same, before anything else happens in that instant; join first."""

    phase: ClassVar[Phase] = Phase.SIMULATE


class After(At):
    """The same, after everything else happened in that instant."""

    phase: ClassVar[Phase] = Phase.WATCH


def log_texts(world: World, node: str | None = None) -> list[str]:
    return [one.text for one in world.log.records if node in (None, one.node)]
