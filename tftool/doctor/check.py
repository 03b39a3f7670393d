"""A check of the doctor: id, severity, thresholds, texts and links, declared with its function.

An id never changes its meaning, and a retired one is never reused. Texts are filled with a
finding's facts; `wording` defines the format of numbers.
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
    "log times": "a buffer keeps no log times",
    "recording": "nothing was recorded",
    "headers": "there are no messages with headers",
    "durability": "what publishers offer to late subscribers is not recorded",
    "mounts": "only with --mounts",
    "odometry": "there are no odometry messages",
    "description": "no URDF given",
    "valid description": "the robot description has mistakes",
    "joint states": "there are no joint states",
}
"""Inputs a check may need beside transforms, and the sentence where one is missing."""


@dataclass(frozen=True, slots=True)
class Check:
    """One check with all its texts.

    Attributes:
        id: Name of the check, which never changes.
        area: Subject.
        severity: Severity of its findings; a hit may state another.
        summary: The fault in general, in one line: the docstring of its function.
        run: Function.
        rule: Condition for a finding, with the thresholds as {names}.
        headline: The fault with a finding's facts; `{where}` names all of them,
            `{concerned:one|many}` chooses a word by their number, as for any number or list.
        detail: A line of evidence for each hit.
        consequence: Consequence.
        fixes: Remedies besides those of the hit itself.
        causes: Causes that people found, the most frequent first.
        links: Threads about it, and standards.
        limits: Thresholds by name; seconds, metres, radians, shares, counts.
        needs: Keys of `NEEDS` without which it cannot run.
        why: Why the rule and its thresholds are as they are; empty where that is plain.
        because_of: Findings that explain this one: what both must share, and the ids of the
            causes. "edge", "child", "frame": at least one; "stream": an edge or a topic;
            "path": an edge of the way to the sensor, or the topic; "gap": likewise, where all
            that is late falls into gaps; "anything": nothing.
            The first that fits counts.
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
        """Run the check, with its own thresholds unless others are given."""
        return self.run(model, self.limits if limits is None else limits)


class checks_of:  # noqa: N801 - a decorator
    """Make a decorator that declares functions as checks, and keeps those of one area in order.

    Attributes:
        checks: All of them, as they are defined.
    """

    def __init__(self, area: Area) -> None:
        self._area = area
        self.checks: list[Check] = []

    def __call__(self, id: str, severity: Severity, **texts: Any) -> Callable[[Run], Check]:
        """Declare a function as a check; `texts` are the other attributes of `Check`."""

        def keep(run: Run) -> Check:
            check = Check(id, self._area, severity, _summary(run), run, **texts)
            self.checks.append(check)
            return check

        return keep


def _summary(run: Run) -> str:
    """Return a check's docstring as part of a sentence."""
    text = " ".join((run.__doc__ or "").split()).removesuffix(".")
    # A name keeps its capitals: NaN.
    return text if any(letter.isupper() for letter in text.split()[0][1:]) else _lowered(text)


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]


def hit_of(stream: Track | Heard, facts: Mapping[str, Fact], **given: Any) -> Hit:
    """Return a hit about one edge or topic, from its first item on.

    Args:
        stream: What it is about.
        facts: Facts; the name of the edge or topic is added.
        **given: Other attributes of `Hit`, in place of those that the stream gives.
    """
    if isinstance(stream, Track):
        own = {"edges": (stream.edge,), "publishers": stream.nodes}
        facts = {"edge": stream.name, **facts}
    else:
        own = {"topics": (stream.topic,), "frames": (stream.frame,)}
        facts = {"topic": stream.topic, **facts}
    counted = {"since": int(stream.logs[0]), "count": len(stream.stamps)}
    return Hit(facts=facts, **{**own, **counted, **given})


def threads(*threads: str) -> tuple[str, ...]:
    """Return the addresses of threads written as owner/repository#number."""
    pairs = (thread.split("#") for thread in threads)
    return tuple(f"https://github.com/{repository}/issues/{number}" for repository, number in pairs)
