"""Node that judges a scenario's expectations while the scenario is played."""

import asyncio
from collections.abc import Sequence
from typing import ClassVar

from tftool.base.errors import TransformException
from tftool.scenario.answer_checks import Judged
from tftool.scenario.doctor_expectations import NO_RULES, DoctorRules
from tftool.scenario.questions import Diagnosed, Logged, ScenarioWorld
from tftool.scenario.scenario import Expectation, Outcome
from tftool.world.clock import Phase
from tftool.world.frame_listener import logged_in
from tftool.world.node import Node
from tftool.world.world import World


def judge(expectation: Expectation, scene: ScenarioWorld) -> Judged:
    """Judge one expectation at the current time."""
    try:
        answer = expectation.question.answer(scene)
    except TransformException as error:
        return expectation.check.judge_error(error)
    return expectation.check.judge(answer)


class Expectations(Node):
    """Node that judges every expectation at its time, after all other nodes of that instant.

    Attributes:
        outcomes: Outcome of each expectation; None for an expectation not judged yet.
    """

    phase: ClassVar[Phase] = Phase.WATCH

    def __init__(
        self, world: World, expected: Sequence[Expectation], rules: DoctorRules = NO_RULES
    ) -> None:
        """Add the node to a world; log messages and transforms before this call are ignored."""
        super().__init__(world, "expectations")
        self.expected = tuple(expected)
        self.outcomes: list[Outcome | None] = [None] * len(self.expected)
        self._scene = ScenarioWorld(world, world.clock.now(), rules)
        for expectation in self.expected:
            if isinstance(expectation.question, Logged):
                self._scene.lines[expectation.question] = 0
        if any(isinstance(expectation.question, Diagnosed) for expectation in self.expected):
            self._scene.hearing, stop = logged_in(world)
            self._stops.append(stop)
        self._stops.append(world.log.listen(self._scene.count, self.name))

    def judged(self) -> tuple[Outcome, ...]:
        """Return the outcome of each expectation; expectations not yet judged are "not reached"."""
        pairs = zip(self.expected, self.outcomes, strict=True)
        return tuple(
            outcome or expected.outcome("not reached", None, False) for expected, outcome in pairs
        )

    async def run(self) -> None:
        """Judge all expectations, each at its time."""
        self._scene.start = self.clock.now()
        await asyncio.gather(*(self._judge(index) for index in range(len(self.expected))))

    async def _judge(self, index: int) -> None:
        expectation = self.expected[index]
        when = expectation.when
        at = when.first
        while True:
            await self.clock.sleep_until(self._scene.start + at, self.phase, self.rank)
            judged = judge(expectation, self._scene)
            # "by" is decided once it holds, "during" once it does not, else both at the end.
            settled = {"at": True, "by": judged.ok, "during": not judged.ok}[when.kind]
            if settled or at >= when.last:
                break
            at = min(at + when.every, when.last)
        self.outcomes[index] = expectation.outcome(judged.found, at, judged.ok)
