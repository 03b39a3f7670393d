"""Judgements and their report, shared by scenarios, comparisons and checks."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Judgement:
    """One judged thing and the outcome.

    Attributes:
        subject: The subject, a sentence: "by 20 s: distance from a to b below 0.5 m".
        ok: Whether it is as it should be.
        expected: Description of a right answer: "below 0.5 m".
        found: The result.
        at: Time of the check in seconds from the start; None if it was not reached.
        line: Line of the file that asked for it; 0 when there is none.
    """

    subject: str
    ok: bool
    expected: str = ""
    found: str = ""
    at: float | None = None
    line: int = 0


@dataclass(frozen=True, slots=True)
class Report:
    """Outcome of all judgements of one run.

    Attributes:
        name: Name of the scenario.
        file: Name of its file, as it was given.
        judgements: One for each thing, in order.
        lasted: Seconds it took, on its own clock.
        failure: Why it could not be looked at to the end; empty when it could.
        warnings: Warnings about a scenario that plays: sentences.
        why: Findings of the doctor if it failed: sentences, the cause first.
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
        """Whether every judgement passed."""
        return not self.failure and all(judgement.ok for judgement in self.judgements)
