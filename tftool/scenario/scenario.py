"""Values: a checked scenario, and the verdict on one run of it."""

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
    """A node to start.

    Attributes:
        kind: Kind, a key of `kinds.KINDS`.
        name: Given name, or the kind, numbered if there are several.
        parameters: All parameters of its kind.
    """

    kind: str
    name: str
    parameters: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Step:
    """One action, `at` nanoseconds after the start.

    Attributes:
        at: Time of the step.
        action: Action of the step.
        line: Line in the file.
        name: Name there: "spawn".
        fails: Whether the step must be refused.
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
        kind: "at" a moment, "by" a moment at the latest, or "during" a while.
        first: First time of judging.
        last: The last one.
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
    """A condition that must hold, and its times.

    Attributes:
        when: Times at which the expectation is judged.
        question: The question.
        check: Check of the answer, from `checks`.
        line: Line in the file.
    """

    when: When
    question: "Subject"
    check: "AnswerCheck"
    line: int

    def __str__(self) -> str:
        return f"{self.when}: {self.question} {self.check}"

    def outcome(self, found: str, at: Duration | None, ok: bool) -> "Outcome":
        """Return its outcome in words."""
        return Outcome(
            str(self.question), self.line, str(self.when), str(self.check), found, at, ok
        )


@dataclass(frozen=True, slots=True)
class Scenario:
    """A world, the actions in it, and its expectations.

    Attributes:
        name: Name: that of the file without the suffix.
        file: Its file, as it was given.
        about: Contents.
        arguments: Arguments that can be set from outside, with their values.
        duration: Duration on simulated time, nanoseconds.
        cache_time: Cache time of the buffer, nanoseconds.
        nodes: Nodes, in order.
        script: Steps.
        expect: Expectations.
        doctor: Checks that the doctor leaves out, in expectations and in `tftool doctor`.
        source: Text of the scenario, to be read again with other arguments.
        not_a_tree: Places where its nodes publish two parents of a frame, a loop, or a self-link.
            Not refused: the doctor may be asked about such a scenario.
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
    not_a_tree: tuple[Mistake, ...] = ()


def _clock(duration: Duration) -> str:
    return f"{as_seconds(duration):g} s"


@dataclass(frozen=True, slots=True)
class Outcome:
    """Outcome of one expectation.

    Attributes:
        expectation: The question in words: "distance from turtle2 to turtle1".
        line: Line in the scenario's file.
        when: Time condition of the expectation: "by 20 s".
        expected: Description of a right answer: "below 0.5 m".
        found: Sentence about the error.
        at: Time of the verdict, nanoseconds since the start; None if its time never came.
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
        """Whether the expectation's time was reached."""
        return self.at is not None

    def judgement(self) -> Judgement:
        """Convert the outcome for tables and test reports."""
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
        scenario: Name.
        file: File.
        outcomes: One for each step that failed or was to, in the order of time; then one for
            each expectation, in the order of the file.
        lasted: Duration of the run, nanoseconds on its clock.
        failure: Why the run ended early; empty when it did not.
        warnings: Slips of programs that show outside simulated time alone: sentences.
    """

    scenario: str
    file: str
    outcomes: tuple[Outcome, ...]
    lasted: Duration
    failure: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether nothing failed, and every expectation that was due holds."""
        return not self.failure and all(one.ok for one in self.outcomes if one.reached)

    def report(self) -> Report:
        """Convert the verdict for tables and test reports."""
        judgements = tuple(outcome.judgement() for outcome in self.outcomes)
        lasted = as_seconds(self.lasted)
        return Report(self.scenario, self.file, judgements, lasted, self.failure, self.warnings)
