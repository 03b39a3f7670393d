"""Running a scenario: builds its world, runs it on a clock, judges it, or records its frames."""

import math
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias

from tftool.base.errors import NodeFailed
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.frames.frames import Frames
from tftool.frames.moment import At, checked_moment
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
        self._expectations: Expectations | None = None
        if scenario.expect:
            # Most commands expect nothing: they do without the questions.
            from tftool.scenario import expectations

            self._expectations = expectations.Expectations(
                self.world, scenario.expect, scenario.doctor
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
        scenario = parse(scenario.source, scenario.file, arguments)
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


USUAL = seconds(5)
"""How long a scenario is played unless more is asked for."""


def played(
    found: Found,
    until: Duration | float | At | None,
    margin: Duration,
    cache_time: Duration | None,
    watch: Callable[[World], object] | None,
) -> Frames:
    """Play a scenario on simulated time, and return all its transforms.

    Args:
        found: File.
        until: The last moment: a duration, infinity for all of it, or a moment that must lie
            inside; `USUAL` if None.
        margin: Seconds to play on after a moment, for transforms that arrive after their stamp.
        cache_time: Cache time of the buffers, in place of the scenario's own; unlimited if None.
        watch: Called with its world before it lives.

    Raises:
        NodeFailed: If a node raised.
        UsageError: If the moment is outside the span.
    """
    scenario = replace(load(found.paths[0], expects=False), expect=())
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
    # What the listener forgets counts from `end` on.
    memory = None if cache_time is None else cache_time + margin
    with heard_in(play.world, memory) as (buffer, log):
        run_apart(clock, play.live(end + margin))
    return Frames("scenario", scenario.name, buffer=buffer, span=(start, end), log=log, found=found)
