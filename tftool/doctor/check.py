"""Declaration of the doctor's checks: id, severity, thresholds, texts and web addresses.

An id never changes its meaning, and is never used again for another check. Texts contain names of
facts, which `wording` replaces by formatted numbers and names.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from tftool.doctor.findings import Area, Fact, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import Heard, Track

Run: TypeAlias = Callable[[Model, Limits], Iterator[Hit]]

REP103 = "https://www.ros.org/reps/rep-0103.html"
REP105 = "https://www.ros.org/reps/rep-0105.html"

NEEDS = {
    "log times": "the times of arrival are not known",
    "recording": "nothing was recorded",
    "headers": "there are no messages with headers",
    "durability": "what publishers offer to late subscribers is not recorded",
    "mounts": "only with --mounts",
    "odometry": "there are no odometry messages",
    "description": "no URDF given",
    "valid description": "the robot description has mistakes",
    "joint states": "there are no joint states",
}
"""Inputs that a check may need in addition to transforms, and the sentence if one is missing."""


@dataclass(frozen=True, slots=True)
class Check:
    """One check with all its texts.

    Attributes:
        id: Name of the check, which never changes.
        area: Subject of the check.
        severity: Severity of the findings, unless a hit has a severity of its own.
        summary: Description of the fault in one line: the docstring of the function.
        run: Function that yields the hits (single observations) of the check.
        rule: Condition for a finding, with the thresholds as {names}.
        headline: Sentence about a finding. `{where}` becomes the names concerned, and
            `{concerned:one|many}` a word that depends on a number or on the length of a list.
        detail: A line of evidence for each hit.
        consequence: What the fault leads to.
        fixes: Remedies, in addition to the remedies of a single hit.
        causes: Causes that people found, the most frequent first.
        links: Discussions of the fault, and standards.
        limits: Thresholds by name; seconds, metres, radians, fractions, counts.
        needs: Keys of `NEEDS` without which the check cannot run.
        why: Reason for the rule and its thresholds; empty if obvious.
        because_of: Checks whose findings may explain a finding of this check, as pairs (common
            subject, ids of the checks separated by blanks). The first pair that fits is used. The
            subject is the thing that both findings must be about: "edge", "child" or "frame";
            "stream" (an edge or a topic); "path" (an edge on the path to the sensor, or the
            topic); "gap" (like "path", but only if all late data is in gaps); "skew" (like "path",
            but only if transforms and messages are on two clocks); "mixed" (like "child", but only
            if data of several publishers is mixed); or "anything" (the findings need not have
            anything in common).
    """

    id: str
    area: Area
    severity: Severity
    summary: str
    run: Run
    rule: str
    headline: str
    detail: str = ""
    consequence: str = ""
    fixes: tuple[Fix, ...] = ()
    causes: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    limits: Mapping[str, float] = field(default_factory=dict)
    needs: tuple[str, ...] = ()
    why: str = ""
    because_of: tuple[tuple[str, str], ...] = ()

    def __call__(self, model: Model, limits: Limits | None = None) -> Iterator[Hit]:
        """Yield the hits of the check; `limits` replaces the check's thresholds."""
        return self.run(model, self.limits if limits is None else limits)


class checks_of:  # noqa: N801 - a decorator
    """Decorator that declares functions as checks of one area.

    Attributes:
        checks: All checks of the area, in the order of definition.
    """

    def __init__(self, area: Area) -> None:
        self._area = area
        self.checks: list[Check] = []

    def __call__(self, id: str, severity: Severity, **texts: Any) -> Callable[[Run], Check]:
        """Return a decorator that turns a function into a `Check`; `texts` are its attributes."""

        def keep(run: Run) -> Check:
            check = Check(id, self._area, severity, _summary(run), run, **texts)
            self.checks.append(check)
            return check

        return keep


def _summary(run: Run) -> str:
    """Return a check's docstring without the full stop and in lower case, for a sentence."""
    text = " ".join((run.__doc__ or "").split()).removesuffix(".")
    # Names such as NaN keep their capitals.
    return text if any(letter.isupper() for letter in text.split()[0][1:]) else _lowered(text)


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]


def hit_of(stream: Track | Heard, facts: Mapping[str, Fact], **given: Any) -> Hit:
    """Return a hit about all samples of one edge, or all messages of one topic.

    Args:
        stream: The edge, or the messages of the topic.
        facts: Facts of the hit; the name of the edge or topic is added.
        **given: Attributes of `Hit`; they replace attributes derived from the stream.
    """
    if isinstance(stream, Track):
        own = {"edges": (stream.edge,), "publishers": stream.nodes}
        facts = {"edge": stream.name, "tf_topic": stream.topics[0], **facts}
    else:
        own = {"topics": (stream.topic,), "frames": (stream.frame,)}
        facts = {"topic": stream.topic, **facts}
    counted = {"since": int(stream.logs[0]), "count": len(stream.stamps)}
    return Hit(facts=facts, **{**own, **counted, **given})


def threads(*threads: str) -> tuple[str, ...]:
    """Return the web addresses of GitHub threads, given as owner/repository#number."""
    pairs = (thread.split("#") for thread in threads)
    return tuple(f"https://github.com/{repository}/issues/{number}" for repository, number in pairs)
