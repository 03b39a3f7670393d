"""Users' programs that run in a scenario, and are judged by the scenario's expectations.

A scenario file never names code to run; only the caller names programs. A program replaces one node
of the scenario, under the name of that node, or runs in addition to the nodes. A launch file
replaces all nodes.
"""

import sys
from collections.abc import Callable, Sequence
from contextlib import nullcontext, redirect_stdout
from dataclasses import dataclass, replace

from tftool.base.errors import InputError, NodeFailed, UsageError
from tftool.base.plain_text import did_you_mean, visible
from tftool.ros import running
from tftool.ros.host.program import Program
from tftool.ros.host.workspace import Workspace
from tftool.ros.launch.arguments import find_launch_file, parse_arguments
from tftool.ros.launch.engine import Launch
from tftool.scenario.play import Play, StandIn, Watch
from tftool.scenario.scenario import Scenario, Verdict
from tftool.world.clock import SimClock, run
from tftool.world.log import LogRecord
from tftool.world.world import World


@dataclass(frozen=True, slots=True)
class Entrant:
    """User's program to run in a scenario.

    Attributes:
        words: Words as after `tftool run`: a file, or a package and its executable; then arguments.
        node: Name of the scenario's node that the program replaces; "" if the program runs in
            addition to the nodes.
    """

    words: tuple[str, ...]
    node: str = ""


@dataclass(frozen=True, slots=True)
class Exercise:
    """Programs and a launch file that a user adds to a scenario.

    Attributes:
        workspace: Workspace in which packages are searched.
        programs: Programs to run.
        launch: Words after `tftool launch`; empty without a launch file.
        tell: Function called with each log message.
    """

    workspace: Workspace
    programs: Sequence[Entrant] = ()
    launch: Sequence[str] = ()
    tell: Callable[[LogRecord], object] = lambda record: None

    def judge(self, scenario: Scenario, *, watch: Watch = nullcontext) -> Verdict:
        """Play a scenario with the programs on simulated time; return the verdict.

        If a program fails, the verdict reports the failure, and the other programs continue.

        Args:
            scenario: Scenario to play.
            watch: Function that returns a context manager for the run, such as a recording.

        Raises:
            UsageError: If a node, package or executable does not exist.
            InputError: If a file cannot be read or is not valid Python.
        """
        failures: list[str] = []
        clock = SimClock()
        self._refuse_unknown(scenario)
        if self.launch:
            scenario = replace(scenario, nodes=())
        stand_ins = {one.node: self._starter(one, failures) for one in self.programs if one.node}
        play = Play(scenario, clock, stand_ins=stand_ins)
        play.world.log.listen(self.tell, "console")
        if self.launch:
            self._start_launch(play.world, failures)
        for one in self.programs:
            if not one.node:
                self._starter(one, failures)(play.world)
        # stdout is for the verdict, not for the output of programs.
        with watch(play.world), redirect_stdout(sys.stderr):
            try:
                run(clock, play.live())
            except NodeFailed as error:
                if isinstance(error.__cause__, UsageError | InputError):
                    # An error about a launch file names its line, so the node's name is left out.
                    play.failure = str(error.__cause__)
        if failures:
            play.failure = "\n".join([*failures, *filter(None, [play.failure])])
        return replace(play.verdict(), warnings=tuple(running.advice(play.world)))

    def _refuse_unknown(self, scenario: Scenario) -> None:
        names = [] if self.launch else [entry.name for entry in scenario.nodes]
        for one in self.programs:
            if one.node and one.node not in names:
                hint = did_you_mean(one.node, names)
                there = ", ".join(names) or "none that can be replaced"
                raise UsageError(
                    f"scenario '{visible(scenario.name)}' has no node "
                    f"'{visible(one.node)}'{hint} (it has {visible(there)})"
                )

    def _starter(self, one: Entrant, failures: list[str]) -> StandIn:
        def ended(program: Program) -> None:
            try:
                status = running.status_of(program)
            except NodeFailed as error:
                failures.append(str(error))
            else:
                if status:
                    failures.append(f"'{program.label}' ended with exit status {status}")

        def start(world: World) -> None:
            target, *rest = one.words
            found = running.find_program(self.workspace, target, rest)
            running.start_program(world, found, on_exit=ended, name=one.node)

        return start

    def _start_launch(self, world: World, failures: list[str]) -> None:
        def say(level: str, who: str, text: str) -> None:
            if level == "ERROR":
                failures.append(f"{who}: {text}")

        path, rest = find_launch_file(self.workspace, self.launch)
        arguments = parse_arguments(rest)
        Launch(world, path, workspace=self.workspace, arguments=arguments, say=say)
