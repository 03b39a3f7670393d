"""Findings of a diagnosis, as immutable values."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

from tftool.base.stamps import Stamp

Edge: TypeAlias = tuple[str, str]
"""Names of parent and child."""

Fact: TypeAlias = object
"""A number, a text, or a list of either; stamps and durations are whole nanoseconds."""


STOPPED_PERIODS = 10
"""Number of a transform's periods without a sample after which it may have stopped."""

STOPPED_AFTER = 1.0
"""Seconds without a sample after which a transform may have stopped; both limits must be passed."""

STALE_AFTER = 0.5
"""Delay from stamp to arrival, seconds, from which a transform arrives late."""


class Severity(Enum):
    """Severity of a finding; the worst severity is the first member."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"

    @property
    def rank(self) -> int:
        """Return the number of worse severities: 0 for the worst severity."""
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
    """One remedy for a finding.

    Attributes:
        text: The remedy as a sentence.
        command: Shell command of the remedy; empty for a remedy without a command.
    """

    text: str
    command: str = ""

    @property
    def line(self) -> str:
        """The remedy with its command, in one line."""
        return f"{self.text.removesuffix(':')}: {self.command}" if self.command else self.text


@dataclass(frozen=True, slots=True)
class Finding:
    """One fault of the frames, found by a check. All names are spelled as in the recording.

    Attributes:
        id: Id of the check; `tftool doctor --explain ID` describes it.
        severity: Error, warning or note.
        area: Subject of the check.
        message: The fault, in one line.
        confidence: Certain, likely or possible.
        edges: Parent and child of each transform concerned.
        frames: Names of the frames concerned.
        topics: Names of the topics concerned.
        publishers: Names of the nodes concerned, if known.
        since: Log time (in a buffer, stamp) of the first evidence; None if the fault has no time.
        until: Log time (in a buffer, stamp) of the last evidence; None if the fault has no time.
        count: Number of occurrences.
        facts: Values used in the texts, by name; stamps and durations in whole nanoseconds.
        evidence: Observations, one line each.
        consequence: Effect of the fault, such as a failing lookup.
        fixes: Remedies, the most likely first.
        because_of: Id of the finding that causes this finding; None if there is none.
        known: Whether the baseline report already contains this finding.
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
    def is_shown(self) -> bool:
        """Whether a report without --verbose shows the finding: all severities except notes."""
        return self.because_of is None and self.severity is not Severity.NOTE

    @property
    def fingerprint(self) -> str:
        """Return a key of the check's id and the names concerned.

        A baseline report recognises known findings by this key, which contains no numbers.
        """
        return fingerprint(self.id, self.frames, self.edges, self.topics)

    def __repr__(self) -> str:
        # Short, because the facts may be those of a hundred edges.
        return f"<Finding: {self.severity.value} {self.id}, {self.message!r}>"


def fingerprint(
    check: str, frames: Iterable[str], edges: Iterable[Iterable[str]], topics: Iterable[str]
) -> str:
    """Return a hash of a check's id and names, which identifies a finding across recordings."""
    named = [check, sorted(frames), sorted(list(edge) for edge in edges), sorted(topics)]
    return hashlib.sha256(json.dumps(named).encode()).hexdigest()[:16]


@dataclass(frozen=True, slots=True)
class Skipped:
    """A check that could not run.

    Attributes:
        id: Id of the check.
        reason: Reason why the check could not run.
    """

    id: str
    reason: str


@dataclass(frozen=True, slots=True)
class Hit:
    """One observation of a check; `judge` turns similar hits into one finding with texts.

    The attributes mean the same as in `Finding`. `facts` also fills the placeholders in the texts
    of the check.
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
    alone: bool = False
    """Whether the hit becomes a separate finding, even if there are similar hits."""
    group: str = ""
    """Key of the similar hits with which the hit is merged: those with the same key."""
