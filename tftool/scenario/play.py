"""Run of a scenario: the world is created, run on a clock, and judged by the expectations."""

import math
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias

from tftool.base.errors import NodeFailed
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.frames.frames import Frames
from tftool.frames.source_options import At, checked_moment
from tftool.recordings.find import Found
from tftool.scenario.load import NO_ARGUMENTS, load, parse
from tftool.scenario.node_kinds import KINDS
from tftool.scenario.scenario import Scenario, Verdict
from tftool.scenario.script import Drive, Press, Script
from tftool.world.clock import Clock, SimClock, run
from tftool.world.frame_listener import heard_in, run_apart
from tftool.world.supervisor import live
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.scenario.expectations import Expectations


StandIn: TypeAlias = Callable[[World], object]
"""Function that starts, in a world, the replacement of one of a scenario's nodes."""

Watch: TypeAlias = Callable[[World], AbstractContextManager[object]]
"""Function that returns a context manager for a run, such as a recording of its world."""

NO_STAND_INS: Mapping[str, StandIn] = MappingProxyType({})

TELEOP = "teleop"
"""Name of the node that is added if a script presses keys and no node receives them."""


class Play:
    """One run of a scenario: a world with its nodes, its script and its expectations.

    Attributes:
        scenario: Scenario that is played.
        world: World with the scenario's nodes.
        start: Time at which the run began, nanoseconds; the scenario's times count from this time.
        failure: Reason why the run ended early; "" for a complete run.
    """

    def __init__(
        self,
        scenario: Scenario,
        clock: Clock,
        *,
        stand_ins: Mapping[str, StandIn] = NO_STAND_INS,
    ) -> None:
        """Create the world of a run; no node runs before `live`.

        Args:
            scenario: Scenario to play.
            clock: Clock of the world.
            stand_ins: Functions that create a program in place of a node, by the node's name.
        """
        self.scenario = scenario
        self.world = World(clock, cache_time=scenario.cache_time)
        self.world.has_own_time = True
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
        self._expectations: Expectations | None = None
        if scenario.expect:
            # Imported here, because most commands judge no expectations.
            from tftool.scenario import expectations

            self._expectations = expectations.Expectations(
                self.world, scenario.expect, scenario.doctor
            )

    async def live(self, until: Stamp | None = None, *, endless: bool = False) -> None:
        """Run the scenario.

        Args:
            until: Last time, nanoseconds; None for the end of the scenario's duration.
            endless: Whether to continue after the scenario's duration, until the world is stopped.

        Raises:
            NodeFailed: If a node raised an exception.
        """
        self.start = self.world.clock.now()
        end = self.start + self.scenario.duration if until is None else until
        try:
            await live(self.world, until=None if endless else end)
        except NodeFailed as error:
            self.failure = str(error)
            raise

    def verdict(self) -> Verdict:
        """Return the verdict so far; expectations that are not judged yet are "not reached"."""
        steps = () if self._script is None else tuple(self._script.outcomes)
        judged = () if self._expectations is None else self._expectations.judged()
        return Verdict(
            scenario=self.scenario.name,
            file=self.scenario.file,
            outcomes=(*steps, *judged),
            lasted=self.world.clock.now() - self.start,
            failure=self.failure,
        )


def left_to_a_person(scenario: Scenario) -> Scenario:
    """Return a scenario without expectations, and without actions that drive turtles.

    A person drives instead. The script keeps all actions except key presses and `drive`.
    """
    script = tuple(step for step in scenario.script if not isinstance(step.action, Drive | Press))
    return replace(scenario, script=script, expect=())


def build(
    scenario: Scenario,
    clock: Clock,
    arguments: Mapping[str, str] = NO_ARGUMENTS,
) -> Play:
    """Create the run of a scenario, with its world and nodes.

    Args:
        scenario: Scenario to play.
        clock: Clock of the world.
        arguments: Values of arguments that the scenario declares.

    Raises:
        UsageError: If an argument is given that the scenario does not declare.
        ScenarioError: If the scenario cannot be read with the arguments.
    """
    if arguments:
        scenario = parse(scenario.source, scenario.file, arguments)
    return Play(scenario, clock)


def run_scenario(
    scenario: Scenario, arguments: Mapping[str, str] = NO_ARGUMENTS, *, watch: Watch = nullcontext
) -> Verdict:
    """Play a scenario on simulated time to its end; return the verdict on its expectations.

    If a node fails, the run ends, and the verdict reports the failure.

    Args:
        scenario: Scenario to play.
        arguments: Values of arguments that the scenario declares.
        watch: Function that returns a context manager for the run, such as a recording.
    """
    clock = SimClock()
    play = build(scenario, clock, arguments)
    # The verdict reports the failed node.
    with watch(play.world), suppress(NodeFailed):
        run(clock, play.live())
    return play.verdict()


USUAL = seconds(5)
"""Nanoseconds for which a scenario is played by default."""


def played(
    source: Found,
    until: Duration | float | At | None,
    margin: Duration,
    cache_time: Duration | None,
    watch: Callable[[World], object] | None,
) -> Frames:
    """Play a scenario on simulated time, and return all its transforms.

    Args:
        source: File of the scenario.
        until: Last time: a duration in nanoseconds, infinity for the whole scenario, or a time in
            the scenario; None for `USUAL`.
        margin: Nanoseconds to continue after the last time, because transforms can arrive late.
        cache_time: Cache time of the buffers, nanoseconds, in place of the scenario's cache time;
            None for no limit.
        watch: Function called with the world before the run.

    Raises:
        NodeFailed: If a node raised an exception.
        UsageError: If the time `until` is outside the scenario.
    """
    scenario = replace(load(source.paths[0], expects=False), expect=())
    if cache_time is not None:
        scenario = replace(scenario, cache_time=cache_time)
    clock = SimClock()
    start, whole = clock.epoch, scenario.duration
    if until is None:
        end, margin = start + min(USUAL, whole), 0
    elif isinstance(until, At):
        end = checked_moment(until, f"scenario '{visible(scenario.name)}'", start, whole)
    elif math.isinf(until):
        end, margin = start + whole, 0
    else:
        end = start + int(until)
    play = build(scenario, clock)
    if watch is not None:
        watch(play.world)
    # The cache time is counted back from `end`, so the margin is added.
    memory = None if cache_time is None else cache_time + margin
    with heard_in(play.world, memory) as (buffer, log):
        run_apart(clock, play.live(end + margin))
    return Frames(
        "scenario", scenario.name, buffer=buffer, span=(start, end), log=log, found=source
    )
