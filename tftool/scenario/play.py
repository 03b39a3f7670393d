"""Running a scenario: builds its world, runs it on simulated or real time, judges it."""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import replace
from types import MappingProxyType
from typing import ClassVar, TypeAlias

from tftool.base.errors import NodeFailed, TransformException
from tftool.base.stamps import Stamp
from tftool.scenario import load
from tftool.scenario.answer_checks import Judged
from tftool.scenario.doctor_expectations import NO_RULES, DoctorRules
from tftool.scenario.load import NO_ARGUMENTS
from tftool.scenario.node_kinds import KINDS
from tftool.scenario.questions import Diagnosed, Logged, ScenarioWorld
from tftool.scenario.scenario import Expectation, Outcome, Scenario, Verdict
from tftool.scenario.script import Drive, Press, Script
from tftool.world.clock import Clock, Phase, SimClock, run
from tftool.world.frame_listener import logged_in
from tftool.world.node import Node
from tftool.world.supervisor import live
from tftool.world.world import World


def judge(expectation: Expectation, scene: ScenarioWorld) -> Judged:
    """Judge one expectation now."""
    try:
        answer = expectation.question.answer(scene)
    except TransformException as error:
        return expectation.check.refused(error)
    return expectation.check.judge(answer)


class Expectations(Node):
    """Judge of every expectation at its time, after everything else of that instant.

    Attributes:
        outcomes: Outcome of each, None for those still to come.
    """

    phase: ClassVar[Phase] = Phase.WATCH

    def __init__(
        self, world: World, expected: Sequence[Expectation], rules: DoctorRules = NO_RULES
    ) -> None:
        """Watch `world`; log lines and transforms count from now on."""
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
            # "by" is over when it holds, "during" when it does not, both at the last moment.
            settled = {"at": True, "by": judged.ok, "during": not judged.ok}[when.kind]
            if settled or at >= when.last:
                break
            at = min(at + when.every, when.last)
        self.outcomes[index] = Outcome(
            expectation=f"{expectation.question}",
            line=expectation.line,
            when=f"{when}",
            expected=f"{expectation.check}",
            found=judged.found,
            at=at,
            ok=judged.ok,
        )


StandIn: TypeAlias = Callable[[World], object]
"""Starts in a world what takes the place of one of a scenario's nodes."""

Watch: TypeAlias = Callable[[World], AbstractContextManager[object]]
"""Something around a play, such as a recording of its world."""

NO_STAND_INS: Mapping[str, StandIn] = MappingProxyType({})

TELEOP = "teleop"
"""Name of the node that is added when a script presses keys and nothing takes them."""


class Play:
    """One run of a scenario: a world with its nodes, its script and its expectations.

    Attributes:
        scenario: The scenario that is played.
        world: The world.
        start: The moment the play began; times in the scenario count from it.
        failure: Why it ended early, in words; empty as long as it did not.
    """

    def __init__(
        self,
        scenario: Scenario,
        clock: Clock,
        *,
        stand_ins: Mapping[str, StandIn] = NO_STAND_INS,
    ) -> None:
        """Build the world; nothing moves before `live`.

        Args:
            scenario: Scenario or timeline to play.
            clock: On whose time.
            stand_ins: Nodes started in place of some of its own, by their names.
        """
        self.scenario = scenario
        self.world = World(clock, cache_time=scenario.cache_time)
        self.start: Stamp = clock.now()
        self.failure = ""
        for entry in scenario.nodes:
            stand_in = stand_ins.get(entry.name)
            if stand_in is None:
                KINDS[entry.kind].build(self.world, entry.name, entry.parameters)
            else:
                stand_in(self.world)
        steps = scenario.script
        presses = any(isinstance(step.action, Press) for step in steps)
        if presses and not any(entry.kind == "teleop" for entry in scenario.nodes):
            KINDS["teleop"].build(self.world, TELEOP, KINDS["teleop"].defaults())
        self._script = Script(self.world, steps) if steps else None
        self._expectations = (
            Expectations(self.world, scenario.expect, scenario.doctor) if scenario.expect else None
        )

    async def live(self, until: Stamp | None = None, *, endless: bool = False) -> None:
        """Run the scenario.

        Args:
            until: The last moment; that of the scenario's duration when None.
            endless: Go on until the world is stopped, whatever the duration.

        Raises:
            NodeFailed: If a node raised.
        """
        self.start = self.world.clock.now()
        end = self.start + self.scenario.duration if until is None else until
        try:
            await live(self.world, until=None if endless else end)
        except NodeFailed as error:
            self.failure = str(error)
            raise

    def verdict(self) -> Verdict:
        """Return the current verdict; expectations not yet due are marked."""
        judge = self._expectations
        steps = () if self._script is None else tuple(self._script.outcomes)
        pairs = [] if judge is None else zip(judge.expected, judge.outcomes, strict=True)
        return Verdict(
            scenario=self.scenario.name,
            file=self.scenario.file,
            outcomes=(
                *steps,
                *(outcome or _not_reached(expected) for expected, outcome in pairs),
            ),
            lasted=self.world.clock.now() - self.start,
            failure=self.failure,
        )


def _not_reached(expected: Expectation) -> Outcome:
    return Outcome(
        expectation=str(expected.question),
        line=expected.line,
        when=str(expected.when),
        expected=str(expected.check),
        found="not reached",
        at=None,
        ok=False,
    )


def left_to_a_person(scenario: Scenario) -> Scenario:
    """Return the scenario without keys and drives, which a person at the keyboard replaces.

    Events of the world still happen. With a person in it, nothing is expected.
    """
    script = tuple(step for step in scenario.script if not isinstance(step.action, Drive | Press))
    return replace(scenario, script=script, expect=())


def build(
    scenario: Scenario,
    clock: Clock,
    arguments: Mapping[str, str] = NO_ARGUMENTS,
) -> Play:
    """Build a play.

    Args:
        scenario: Scenario or timeline to play.
        clock: On whose time.
        arguments: Values for arguments the scenario declares.

    Raises:
        UsageError: If an argument is given that the scenario does not declare.
        ScenarioError: If the scenario cannot be read with them.
    """
    if arguments:
        scenario = load.parse(scenario.source, scenario.file, arguments)
    return Play(scenario, clock)


def run_scenario(
    scenario: Scenario, arguments: Mapping[str, str] = NO_ARGUMENTS, *, watch: Watch = nullcontext
) -> Verdict:
    """Play a scenario on simulated time to its end, and judge it.

    A node that fails ends the play; that is part of the verdict.

    Args:
        scenario: Scenario or timeline to play.
        arguments: Values for arguments it declares.
        watch: Context managers around the play, such as a recording.
    """
    clock = SimClock()
    play = build(scenario, clock, arguments)
    # The verdict says so.
    with watch(play.world), suppress(NodeFailed):
        run(clock, play.live())
    return play.verdict()
