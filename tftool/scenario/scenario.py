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
        kind: Its kind, a key of `kinds.KINDS`.
        name: Its name: given, or its kind, numbered if there are several.
        parameters: All parameters of its kind.
    """

    kind: str
    name: str
    parameters: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Step:
    """One action, `at` nanoseconds after the start.

    Attributes:
        at: When.
        action: Action of the step.
        line: Its line in the file.
        name: Its name there: "spawn".
        fails: Whether it is to be refused.
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
        first: The first moment it is looked at.
        last: The last one.
        every: How far apart the moments between are.
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
        when: When it is judged.
        question: The question.
        check: Check of the answer, from `checks`.
        line: Its line in the file.
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
        name: Its name: that of the file without the suffix.
        file: Its file, as it was given.
        about: Its contents.
        arguments: Arguments that can be set from outside, with their values.
        duration: How long it lasts on simulated time, in nanoseconds.
        cache_time: How far back its buffer remembers, in nanoseconds.
        nodes: Its nodes, in order.
        script: Its steps.
        expect: Its expectations.
        doctor: Checks that the doctor leaves out, in expectations and in `tftool doctor`.
        source: The text it was read from, so that it can be read with other arguments.
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
        line: Its line in the scenario's file.
        when: When it was to hold: "by 20 s".
        expected: Description of a right answer: "below 0.5 m".
        found: Sentence about the error.
        at: When that was found, nanoseconds since the start; None if its time never came.
        ok: Whether it holds.
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
        """Whether its time was reached."""
        return self.at is not None

    def judgement(self) -> Judgement:
        """Convert it for tables and test reports."""
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
        scenario: Its name.
        file: Its file.
        outcomes: One for each step that failed or was to, in the order of time; then one for
            each expectation, in the order of the file.
        lasted: How long the run was, nanoseconds on its clock.
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
        """Convert it for tables and test reports."""
        judgements = tuple(outcome.judgement() for outcome in self.outcomes)
        lasted = as_seconds(self.lasted)
        return Report(self.scenario, self.file, judgements, lasted, self.failure, self.warnings)
