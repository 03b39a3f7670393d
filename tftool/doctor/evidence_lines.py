"""Lines of evidence of a finding, in which one line tells what many frames have in common."""

import string
from collections.abc import Sequence

from tftool.base.stamps import NANOSECONDS
from tftool.doctor.findings import Fact, Hit
from tftool.doctor.wording import NearNumbers, filled, several

ALIKE = 0.1
"""Share by which numbers may differ that are told in one line."""

MOST_NAMED = 3
"""Frames or topics of one line that are named; of more, the publisher is."""

_SUBJECTS = ("edge", "what", "frame", "topic", "child")
_MOMENTS = ("moment", "dated")


def evidence_lines(detail: str, hits: Sequence[Hit]) -> list[str]:
    """Return a check's line for each hit, and one line for hits that say the same of many frames.

    Args:
        detail: The check's line, with the names of facts.
        hits: Hits of one finding.
    """
    subject, colon, rest = detail.partition(": ")
    name = subject.strip("{}")
    if not colon or subject != f"{{{name}}}" or name not in _SUBJECTS:
        return [filled(detail, _facts(hit)) for hit in hits]
    told = [(key, spec or "") for _, key, spec, _ in string.Formatter().parse(rest) if key]
    groups: list[list[Hit]] = []
    for hit in hits:
        for group in groups:
            if _is_alike(group[0], hit, told):
                group.append(hit)
                break
        else:
            groups.append([hit])
    return [_line(name, rest, group, told) for group in groups]


def _facts(hit: Hit) -> dict[str, Fact]:
    return {"frames": several(hit.frames), **hit.facts}


def _is_alike(first: Hit, other: Hit, told: Sequence[tuple[str, str]]) -> bool:
    """Whether two hits of the same publishers and kind say the same, but for small differences."""
    kinds = [(bool(one.edges), bool(one.topics), one.publishers) for one in (first, other)]
    if kinds[0] != kinds[1]:
        return False
    for key, spec in told:
        mine, theirs = _facts(first).get(key), _facts(other).get(key)
        if mine == theirs:
            continue
        if not isinstance(mine, int | float) or not isinstance(theirs, int | float):
            return False
        near = NANOSECONDS if spec in _MOMENTS else ALIKE * max(abs(mine), abs(theirs))
        if abs(mine - theirs) > near:
            return False
    return True


def _line(name: str, rest: str, hits: Sequence[Hit], told: Sequence[tuple[str, str]]) -> str:
    """Return the line of hits that say the same."""
    facts = _facts(hits[0])
    for key, _ in told:
        values = [_facts(hit).get(key) for hit in hits]
        numbers = [value for value in values if isinstance(value, int | float)]
        if numbers and min(numbers) != max(numbers):
            facts[key] = NearNumbers(min(numbers), max(numbers))
    return f"{_subject(name, hits)}: {filled(rest, facts)}"


def _subject(name: str, hits: Sequence[Hit]) -> str:
    names = list(dict.fromkeys(str(_facts(hit)[name]) for hit in hits))
    if len(names) <= MOST_NAMED:
        return ", ".join(names)
    what = "frames" if hits[0].edges or hits[0].frames else "topics"
    if hits[0].publishers:
        return f"{len(names)} {what} of {several(hits[0].publishers)}"
    return f"{len(names)} {what} ({several(names, MOST_NAMED)})"
