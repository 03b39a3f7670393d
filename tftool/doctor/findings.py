"""Findings of a diagnosis as immutable values, for people and programs."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

from tftool.base.stamps import Stamp

Edge: TypeAlias = tuple[str, str]
"""A parent and its child."""

Fact: TypeAlias = object
"""A number, a text, or a list of them; stamps and durations in whole nanoseconds."""


STOPPED_PERIODS = 10
"""After so many of its periods without a sample a transform has stopped."""

STOPPED_AFTER = 1.0
"""After so many seconds, too; both have to have passed."""

STALE_AFTER = 0.5
"""Seconds from which on a transform arrives long after its stamp."""


class Severity(Enum):
    """Severity of a finding, worst first."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"

    @property
    def rank(self) -> int:
        """Return 0 for the worst severity, more for lesser ones."""
        return list(Severity).index(self)


class Confidence(Enum):
    """Confidence of a finding: certain, likely, or possible."""

    CERTAIN = "certain"
    LIKELY = "likely"
    POSSIBLE = "possible"


class Area(Enum):
    """Subject of a check, in the order of the report."""

    PUBLISHERS = "publishers"
    SHAPE = "shape"
    NAMES = "names"
    CLOCKS = "clocks"
    COVERAGE = "coverage"
    VALUES = "values"
    DESCRIPTION = "robot description"


@dataclass(frozen=True, slots=True)
class Fix:
    """One remedy of a finding.

    Attributes:
        text: A sentence.
        command: The line to type; empty where there is none.
    """

    text: str
    command: str = ""


@dataclass(frozen=True, slots=True)
class Finding:
    """One fault of the frames. Names in it are exactly as recorded.

    Attributes:
        id: Id of its check; `tftool doctor --explain ID` describes it.
        severity: Error, warning or note.
        area: Subject of the check.
        message: The fault, in one line.
        confidence: Certain, likely or possible.
        edges: Parent and child of each transform concerned.
        frames: Frames concerned.
        topics: Topics concerned.
        publishers: Nodes concerned, where they are known.
        since: Log time of the first evidence, else its stamp; None where it is not a moment.
        until: The same of the last.
        count: Number of occurrences.
        facts: Numbers behind the finding; stamps and durations in whole nanoseconds.
        evidence: Observations, a line each.
        consequence: Consequence.
        fixes: Remedies, the likeliest first.
        because_of: The id of the finding that explains this one; None where none does.
        known: Whether a report that was given as the baseline has it already.
    """

    id: str
    severity: Severity
    area: Area
    message: str
    confidence: Confidence = Confidence.CERTAIN
    edges: tuple[Edge, ...] = ()
    frames: tuple[str, ...] = ()
    topics: tuple[str, ...] = ()
    publishers: tuple[str, ...] = ()
    since: Stamp | None = None
    until: Stamp | None = None
    count: int = 1
    facts: Mapping[str, Fact] = field(default_factory=dict, hash=False)
    evidence: tuple[str, ...] = ()
    consequence: str = ""
    fixes: tuple[Fix, ...] = ()
    because_of: str | None = None
    known: bool = False

    @property
    def fingerprint(self) -> str:
        """Return the identity of a finding in all recordings: check and names, no numbers."""
        return fingerprint(self.id, self.frames, self.edges, self.topics)

    def __repr__(self) -> str:
        # Its facts may be those of a hundred edges.
        return f"<Finding: {self.severity.value} {self.id}, {self.message!r}>"


def fingerprint(
    check: str, frames: Iterable[str], edges: Iterable[Iterable[str]], topics: Iterable[str]
) -> str:
    """Return the key shared by findings of one check about the same names."""
    named = [check, sorted(frames), sorted(list(edge) for edge in edges), sorted(topics)]
    return hashlib.sha256(json.dumps(named).encode()).hexdigest()[:16]


@dataclass(frozen=True, slots=True)
class Skipped:
    """A check that could not run.

    Attributes:
        id: Id of the check.
        reason: Why.
    """

    id: str
    reason: str


@dataclass(frozen=True, slots=True)
class Hit:
    """One observation of a check; `judge` merges similar ones and adds the texts.

    Attributes are those of `Finding`. `facts` also fill the texts of the catalogue.
    """

    edges: tuple[Edge, ...] = ()
    frames: tuple[str, ...] = ()
    topics: tuple[str, ...] = ()
    publishers: tuple[str, ...] = ()
    since: Stamp | None = None
    until: Stamp | None = None
    count: int = 1
    facts: Mapping[str, Fact] = field(default_factory=dict, hash=False)
    severity: Severity | None = None
    confidence: Confidence = Confidence.CERTAIN
    fixes: tuple[Fix, ...] = ()
    alone: bool | str = False
    """Whether it makes a finding of its own, however many alike there are; or a word that it shares
    with those it makes one with. Of these, the fact `named` is the name in the headline."""
