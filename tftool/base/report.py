"""Results of a scenario, comparison or check: single judgements, and a report with all of them."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Judgement:
    """Statement about the frames of a run, with the result of its test.

    Attributes:
        subject: The statement, for example "by 20 s: distance from a to b below 0.5 m".
        ok: Whether the statement is true.
        expected: Description of a passing value, for example "below 0.5 m".
        found: The value found.
        at: Time of the test in seconds from the start; None if the run ended before that time.
        line: Line of the file that contains the statement; 0 without a file.
    """

    subject: str
    ok: bool
    expected: str = ""
    found: str = ""
    at: float | None = None
    line: int = 0


@dataclass(frozen=True, slots=True)
class Report:
    """Result of one run of a scenario, with all judgements.

    Attributes:
        name: Name of the scenario.
        file: Name of the scenario's file, as the user gave it.
        judgements: The judgements, in the order of the file.
        lasted: Duration of the run in seconds, on the clock of the run.
        failure: Reason why the run ended early; "" for a complete run.
        warnings: Warnings about the scenario, as sentences.
        why: Findings of the doctor about a failed run, as sentences, with the cause of the other
            findings first.
    """

    name: str
    file: str
    judgements: tuple[Judgement, ...]
    lasted: float = 0.0
    failure: str = ""
    warnings: tuple[str, ...] = ()
    why: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether the run ended normally and every judgement passed."""
        return not self.failure and all(judgement.ok for judgement in self.judgements)
