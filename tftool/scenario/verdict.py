"""What held and what did not."""

from dataclasses import dataclass

from tftool.base.report import Judgement, Report
from tftool.base.stamps import Duration, as_seconds


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of one expectation.

    Attributes:
        expectation: What was asked, in words: "distance from turtle2 to turtle1".
        line: Its line in the scenario's file.
        when: When it was to hold: "by 20 s".
        expected: What the answer had to be: "below 0.5 m".
        found: What it was.
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
        """Whether its time came."""
        return self.at is not None

    def judgement(self) -> Judgement:
        """The same, fit for tables and test reports."""
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
    """What came of one run of a scenario.

    Attributes:
        scenario: Its name.
        file: Where it came from.
        outcomes: One for each step that failed or was to, in the order of time; then one for
            each expectation, in the order of the file.
        lasted: How long the run was, nanoseconds on its clock.
        failure: Why the run ended early; empty when it did not.
    """

    scenario: str
    file: str
    outcomes: tuple[Outcome, ...]
    lasted: Duration
    failure: str = ""

    @property
    def ok(self) -> bool:
        """Whether nothing failed, and everything whose time came holds."""
        return not self.failure and all(one.ok for one in self.outcomes if one.reached)

    def report(self) -> Report:
        """The same, fit for tables and test reports."""
        judgements = tuple(outcome.judgement() for outcome in self.outcomes)
        return Report(self.scenario, self.file, judgements, as_seconds(self.lasted), self.failure)
