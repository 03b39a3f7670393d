"""Declaration of the doctor's checks: id, severity, thresholds, texts and web addresses.

The id of a removed check is never given to another check. The texts contain placeholders, which the
module `wording` replaces by formatted numbers and names.
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
"""Inputs that a check may need in addition to transforms, and the reason to skip the check."""


@dataclass(frozen=True, slots=True)
class Check:
    """One check with all its texts.

    Attributes:
        id: Name of the check, which never changes.
        area: Subject of the check.
        severity: Severity of the findings; a hit can override this severity.
        summary: Description of the fault in one line, from the docstring of `run`.
        run: Function that yields the hits (single observations) of the check.
        rule: Condition for a finding, with the thresholds as {names}.
        headline: Sentence about a finding. `{where}` becomes the names concerned, and
            `{concerned:is|are}` becomes the singular or the plural word.
        detail: Template for the line of evidence of each hit.
        consequence: Effect of the fault, such as a failing lookup.
        fixes: Remedies, in addition to the remedies in a hit.
        causes: Causes known from reports of users, the most frequent first.
        links: Discussions of the fault, and standards.
        limits: Thresholds by name: seconds, metres, radians, fractions or counts.
        needs: Keys of `NEEDS`: data without which the check cannot run.
        why: Reason for the rule and its thresholds; empty if obvious.
        because_of: Checks whose findings may explain a finding of this check, as pairs (common
            subject, ids of the checks separated by blanks). The first pair that fits is used. Both
            findings must be about the common subject. "edge", "child" and "frame" mean what they
            say. "stream" is an edge or a topic. "path" is an edge on the path to the sensor, or the
            topic. "gap" is "path", if all late data is in gaps. "skew" is "path", if transforms and
            messages are on two clocks. "mixed" is "child", if data of several publishers is mixed.
            "anything" fits any two findings.
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
    """Return the docstring of a check's function in lower case and without the full stop."""
    text = " ".join((run.__doc__ or "").split()).removesuffix(".")
    # Names such as NaN keep their capitals.
    return text if any(letter.isupper() for letter in text.split()[0][1:]) else _lowered(text)


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]


def hit_of(stream: Track | Heard, facts: Mapping[str, Fact], **given: Any) -> Hit:
    """Return a hit about all samples of one edge, or all messages of one topic.

    Args:
        stream: The edge, or the messages of the topic.
        facts: Facts of the hit; this function adds the name of the edge or topic.
        **given: Attributes of `Hit`, which replace the attributes derived from the stream.
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
    """Return the web addresses of GitHub issues, each given as owner/repository#number."""
    pairs = (thread.split("#") for thread in threads)
    return tuple(f"https://github.com/{repository}/issues/{number}" for repository, number in pairs)
