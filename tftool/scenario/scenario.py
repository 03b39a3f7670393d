"""Data of a scenario that was read, and of the verdict on one run of a scenario."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from tftool.base.errors import Mistake
from tftool.base.report import Judgement, Report
from tftool.base.stamps import Duration, as_seconds
from tftool.scenario.doctor_expectations import NO_RULES, DoctorRules

if TYPE_CHECKING:
    from tftool.scenario.answer_checks import AnswerCheck
    from tftool.scenario.questions import Subject
    from tftool.scenario.script import Action


@dataclass(frozen=True, slots=True)
class NodeEntry:
    """Node that a scenario starts.

    Attributes:
        kind: Kind, a key of `node_kinds.KINDS`.
        name: Name of the node: as in the file, else the kind, with a number if several nodes have
            that kind.
        parameters: Values of all parameters of the node's kind.
    """

    kind: str
    name: str
    parameters: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Step:
    """One action of a scenario's script.

    Attributes:
        at: Time of the step, nanoseconds after the start.
        action: Action of the step.
        line: Line in the file.
        name: Name of the action in the file, such as "spawn".
        fails: Whether the action is expected to fail.
    """

    at: Duration
    action: "Action"
    line: int
    name: str
    fails: bool = False


@dataclass(frozen=True, slots=True)
class When:
    """Times at which an expectation is judged, in nanoseconds since the start.

    Attributes:
        kind: "at": the expectation must hold at one time; "by": at some time until `last`;
            "during": at all times from `first` to `last`.
        first: First time of judging.
        last: Last time of judging.
        every: Interval between the times of judging.
    """

    kind: str
    first: Duration
    last: Duration
    every: Duration

    def __str__(self) -> str:
        if self.kind == "during":
            return f"from {_clock(self.first)} to {_clock(self.last)}"
        return f"{self.kind} {_clock(self.last)}"


@dataclass(frozen=True, slots=True)
class Expectation:
    """Expected answer to a question at one or several times.

    Attributes:
        when: Times at which the expectation is judged.
        question: Question whose answer is checked.
        check: Check of the answer.
        line: Line in the file.
    """

    when: When
    question: "Subject"
    check: "AnswerCheck"
    line: int

    def __str__(self) -> str:
        return f"{self.when}: {self.question} {self.check}"

    def outcome(self, found: str, at: Duration | None, ok: bool) -> "Outcome":
        """Create this expectation's `Outcome` from the answer as text, the time, and the result."""
        return Outcome(
            str(self.question), self.line, str(self.when), str(self.check), found, at, ok
        )


@dataclass(frozen=True, slots=True)
class Scenario:
    """Scenario file as data: nodes of a world, actions of a script, and expectations.

    Attributes:
        name: Name of the file, without its suffix.
        file: Path of the file, as given.
        about: Description in words.
        arguments: Arguments that the caller can set, with their values.
        duration: Duration on simulated time, nanoseconds.
        cache_time: Cache time of the buffer, nanoseconds.
        nodes: Nodes to start, in order.
        script: Steps of the script.
        expect: Expectations.
        doctor: Rules for the doctor, in expectations and in `tftool doctor`.
        source: Text of the scenario, to be read again with other arguments.
        warnings: Mistakes of nodes that give a frame two parents, close a loop, make a frame its
            own parent, or set a joint beyond its limits; a scenario for the doctor may contain them
            on purpose.
    """

    name: str
    file: str
    about: str
    arguments: Mapping[str, str]
    duration: Duration
    cache_time: Duration
    nodes: tuple[NodeEntry, ...]
    script: tuple[Step, ...]
    expect: tuple[Expectation, ...]
    source: str = field(repr=False)
    doctor: DoctorRules = NO_RULES
    warnings: tuple[Mistake, ...] = ()


def _clock(duration: Duration) -> str:
    return f"{as_seconds(duration):g} s"


@dataclass(frozen=True, slots=True)
class Outcome:
    """Outcome of one expectation.

    Attributes:
        expectation: The question in words, such as "distance from turtle2 to turtle1".
        line: Line in the scenario's file.
        when: Time condition of the expectation, such as "by 20 s".
        expected: Description of a right answer, such as "below 0.5 m".
        found: The answer, or the error, in words.
        at: Time of the judgement, nanoseconds since the start; None if the run ended before.
        ok: Whether the expectation is met.
    """

    expectation: str
    line: int
    when: str
    expected: str
    found: str
    at: Duration | None
    ok: bool

    @property
    def reached(self) -> bool:
        """Whether the expectation was judged."""
        return self.at is not None

    def judgement(self) -> Judgement:
        """Return the outcome as a judgement for tables and test reports."""
        return Judgement(
            subject=f"{self.when}: {self.expectation} {self.expected}",
            ok=self.ok,
            expected=self.expected,
            found=self.found,
            at=None if self.at is None else as_seconds(self.at),
            line=self.line,
        )


@dataclass(frozen=True, slots=True)
class Verdict:
    """Verdict on one run of a scenario.

    Attributes:
        scenario: Name of the scenario.
        file: Path of the scenario's file, as given.
        outcomes: One outcome for each step that failed or was expected to fail, in order of time;
            then one for each expectation, in the order of the file.
        lasted: Duration of the run on the run's clock, nanoseconds.
        failure: Reason why the run ended early; "" for a complete run.
        warnings: Hints about transform lookups in users' programs, as sentences.
    """

    scenario: str
    file: str
    outcomes: tuple[Outcome, ...]
    lasted: Duration
    failure: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether nothing failed, and every expectation that was judged holds."""
        return not self.failure and all(one.ok for one in self.outcomes if one.reached)

    def report(self) -> Report:
        """Return the verdict as a report for tables and test reports."""
        judgements = tuple(outcome.judgement() for outcome in self.outcomes)
        lasted = as_seconds(self.lasted)
        return Report(self.scenario, self.file, judgements, lasted, self.failure, self.warnings)
