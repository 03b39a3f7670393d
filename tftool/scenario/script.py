"""The script of a scenario: each action, done when its time comes."""

import asyncio
from collections.abc import Sequence
from typing import Any

from tftool.base.errors import TftoolError
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.scenario.scenario import Step
from tftool.scenario.verdict import Outcome
from tftool.world.node import Node
from tftool.world.world import World

PATIENCE: Duration = seconds(1)
"""How long before the end a service must have been asked for its silence to count."""


class StepFailed(TftoolError):
    """A step was refused, and why."""


class Script(Node):
    """Does every step at its time; steps of one instant in the order of the file.

    A step that fails is told and noted; the others are done all the same.

    Attributes:
        start: The moment the script began.
        outcomes: What came of the steps that were to fail, and of those that failed.
    """

    def __init__(self, world: World, steps: Sequence[Step]) -> None:
        """Act in `world`."""
        super().__init__(world, "script")
        self.steps = tuple(steps)
        self.start = world.clock.now()
        self.outcomes: list[Outcome] = []

    async def run(self) -> None:
        """Do all steps; one that waits for an answer holds up no other."""
        self.start = self.clock.now()
        await asyncio.gather(*(self._do(step) for step in self.steps))

    async def _do(self, step: Step) -> None:
        await self.wait_until(self.start + step.at)
        refusal = ""
        try:
            await step.action.do(self)
        except TftoolError as error:
            refusal = f"{error}"
        if not (refusal or step.fails):
            return
        if refusal and not step.fails:
            self.error(f"Step '{step.name}' in line {step.line} failed: {refusal}")
        self.outcomes.append(
            Outcome(
                expectation=f"step '{step.name}'",
                line=step.line,
                when=f"at {as_seconds(step.at):g} s",
                expected="fails" if step.fails else "is done",
                found=f"refused: {refusal}" if refusal else "done",
                at=self.clock.now() - self.start,
                ok=step.fails == bool(refusal),
            )
        )

    async def call(self, service: str, request: Any) -> Any:
        """Ask a service and wait for its answer.

        Raises:
            StepFailed: If the run ends and there is none.
        """
        asked = self.clock.now()
        try:
            return await super().call(service, request)
        except asyncio.CancelledError:
            silent = self.clock.now() - asked
            if silent < PATIENCE:
                raise
            raise StepFailed(
                f"'{service}' has not answered for {as_seconds(silent):g} s, up to the end"
            ) from None

    async def wait_until(self, stamp: Stamp) -> None:
        """Wait for a moment, in this node's place within it."""
        await self.clock.sleep_until(stamp, self.phase, self.rank)
