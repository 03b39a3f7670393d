"""Diagnosis: run all checks on the evidence, and group consequences below their causes."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from tftool.base.errors import UsageError
from tftool.base.plain_text import near_names
from tftool.base.stamps import CACHE_TIME, Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.doctor import clock_checks as clocks
from tftool.doctor import coverage_checks as coverage
from tftool.doctor import delay_checks as delays
from tftool.doctor import description_checks as description
from tftool.doctor import gap_checks as gaps
from tftool.doctor import heard_names
from tftool.doctor import jump_checks as jumps
from tftool.doctor import lap_checks as laps
from tftool.doctor import mount_checks as mounts
from tftool.doctor import name_checks as names
from tftool.doctor import odometry_checks as odometry
from tftool.doctor import outage_checks as outages
from tftool.doctor import pose_checks as poses
from tftool.doctor import publisher_checks as publishers
from tftool.doctor import recording_checks as recordings
from tftool.doctor import shape_checks as shape
from tftool.doctor import stamp_checks as stamps
from tftool.doctor import static_checks as statics
from tftool.doctor import stop_checks as stops
from tftool.doctor import value_checks as values
from tftool.doctor.check import NEEDS, Check
from tftool.doctor.evidence import Evidence, described_by, evidence_of, evidence_of_log
from tftool.doctor.findings import Area, Confidence, Finding, Fix, Hit, Severity, Skipped
from tftool.doctor.model import Limits, Model, Settings
from tftool.doctor.wording import evidence_lines, filled, in_words, several
from tftool.frames.transform_log import TransformLog

if TYPE_CHECKING:
    from tftool.frames.frames import Frames
    from tftool.recordings.recording import Recording

CHECKS: Mapping[str, Check] = {
    check.id: check
    for room in (
        *(publishers, statics, shape, heard_names, names, clocks, laps, stamps, delays),
        *(stops, gaps, recordings, outages, coverage, values, jumps, poses, odometry, mounts),
        description,
    )
    for check in room.check.checks
}
"""All checks by id, in the order of the report: by area, then by definition."""

AREAS = {area.value.replace(" ", "-"): area for area in Area}
"""All areas of checks, by the word that selects their checks."""


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """Result of all checks on some evidence.

    Attributes:
        findings: Findings by area, errors first; each consequence directly after its cause.
        skipped: Checks that could not run, with the reasons.
        ran: Number of checks that ran.
        model: Model of the evidence that was checked.
    """

    findings: tuple[Finding, ...]
    skipped: tuple[Skipped, ...]
    ran: int
    model: Model

    def count(self, severity: Severity) -> int:
        """Return the number of findings of a severity, without consequences of other findings."""
        return sum(f.severity is severity and f.because_of is None for f in self.findings)

    @property
    def worst(self) -> Severity | None:
        """Return the worst severity of the new findings; None without new findings.

        Findings of the baseline report and consequences of other findings do not count.
        """
        found = [f.severity for f in self.findings if f.because_of is None and not f.known]
        return min(found, key=lambda severity: severity.rank, default=None)


def judge(
    evidence: Evidence,
    settings: Settings | None = None,
    *,
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
) -> Diagnosis:
    """Run the checks on the evidence; return all findings.

    Args:
        evidence: Evidence about the frames.
        settings: Settings of the assumed listener, and thresholds.
        select: Ids or areas of the checks to run; empty for all.
        ignore: Ids or areas of the checks to leave out.

    Raises:
        UsageError: If a check, an area or a threshold is unknown.
    """
    settings = settings or Settings()
    refuse_unknown(settings, select, ignore)
    if evidence.is_generated:
        evidence = replace(evidence, timed=False)
    limits = {name: _limits(check, settings) for name, check in CHECKS.items()}
    chosen = checks_named(select) if select else list(CHECKS)
    left_out = set(checks_named(ignore))
    model = Model(evidence, settings)
    hits: list[tuple[Check, Hit]] = []
    skipped = []
    ran = 0
    for name in CHECKS:
        if name not in chosen or name in left_out:
            asked = "left out, as was asked" if name in left_out else "not selected"
            skipped.append(Skipped(name, asked))
            continue
        check = CHECKS[name]
        missing = [need for need in check.needs if not _has(evidence, need)]
        if missing:
            skipped.append(Skipped(name, NEEDS[missing[0]]))
            continue
        ran += 1
        # Recorded numbers may have any size: an overflow becomes NaN or infinity without a warning.
        with np.errstate(all="ignore"):
            hits += [(check, hit) for hit in check(model, limits[name])]
    return Diagnosis(_findings(hits, limits, model.words), tuple(skipped), ran, model)


def faults_in_log(
    log: TransformLog,
    name: str,
    span: tuple[Stamp, Stamp],
    cache_time: Duration,
    *,
    limits: Mapping[str, Mapping[str, float]],
    ignore: Sequence[str],
) -> list[Finding]:
    """Return the errors and warnings about a scenario's transforms, without consequences.

    Args:
        log: Transforms that were received.
        name: Name of the scenario.
        span: Begin and end of the time in which transforms were logged, nanoseconds.
        cache_time: Cache time of the assumed listener, nanoseconds.
        limits: Changed thresholds; see `Settings`.
        ignore: Ids or areas of the checks to leave out.
    """
    settings = Settings(cache_time, limits=limits)
    evidence = evidence_of_log(log, name, "scenario", *span)
    return [
        finding
        for finding in judge(evidence, settings, ignore=ignore).findings
        if finding.because_of is None and finding.severity is not Severity.NOTE
    ]


def _has(evidence: Evidence, need: str) -> bool:
    if need == "log times":
        return evidence.timed
    if need == "recording":
        return evidence.recorded
    if need == "headers":
        return any(len(headers) for headers in evidence.headers.values())
    if need == "mounts":
        return evidence.mounts is not None
    if need == "odometry":
        return evidence.odometry is not None
    if need == "description":
        return evidence.robot is not None or bool(evidence.mistakes)
    if need == "valid description":
        return evidence.robot is not None
    if need == "joint states":
        return evidence.joints is not None
    return any(publisher.durability for publisher in evidence.publishers)


def checks_named(words: Sequence[str]) -> list[str]:
    """Return the ids of the selected checks; each word is a check's id or an area.

    Raises:
        UsageError: If a word is neither an id nor an area.
    """
    found: list[str] = []
    for word in words:
        if word in CHECKS:
            found.append(word)
        elif word.replace(" ", "-") in AREAS:
            area = AREAS[word.replace(" ", "-")]
            found += [name for name, check in CHECKS.items() if check.area is area]
        else:
            raise UsageError(unknown(word, [*CHECKS, *AREAS], "check or area"))
    return found


def unknown(word: str, known: Sequence[str], what: str) -> str:
    """Return the error text for an unknown word, such as a mistyped id of a check.

    Args:
        word: The unknown word.
        known: Words to suggest; the text suggests the most similar word, if any.
        what: Kind of word, such as "check".
    """
    near = near_names(word, known)
    hint = f"did you mean {near[0]}?" if near else "'tftool doctor --list' shows all."
    return f"There is no {what} '{word}': {hint}"


def _limits(check: Check, settings: Settings) -> Limits:
    return {**check.limits, **settings.limits.get(check.id, {})}


def refuse_unknown(settings: Settings, select: Sequence[str], ignore: Sequence[str]) -> None:
    """Validate the names of checks, areas and thresholds.

    Raises:
        UsageError: If a check, an area or a threshold is unknown.
    """
    checks_named(select)
    checks_named(ignore)
    for name, given in settings.limits.items():
        if name not in CHECKS:
            raise UsageError(unknown(name, list(CHECKS), "check"))
        for limit in given:
            known = sorted(CHECKS[name].limits)
            if limit not in known:
                has = f"it has {', '.join(known)}." if known else "it has none."
                raise UsageError(f"{name} has no threshold '{limit}': {has}")


def _findings(
    hits: list[tuple[Check, Hit]], limits: Mapping[str, Limits], words: Mapping[str, str]
) -> tuple[Finding, ...]:
    of_check: dict[str, list[int]] = defaultdict(list)
    for number, (check, _) in enumerate(hits):
        of_check[check.id].append(number)
    causes = [_cause_of(number, hits, of_check) for number in range(len(hits))]
    severities = [_severity(check, hit) for check, hit in hits]
    for number, cause in enumerate(causes):
        if cause is None or severities[cause] is not Severity.NOTE:
            continue
        if set(hits[cause][1].edges) & set(hits[number][1].edges):
            severities[cause] = severities[number]  # a note would hide what it explains
    grouped: dict[tuple[str, Severity, str | None, int | None, str], list[Hit]] = {}
    for number, ((check, hit), cause) in enumerate(zip(hits, causes, strict=True)):
        because_of = None if cause is None else hits[cause][0].id
        key = (check.id, severities[number], because_of, number if hit.alone else None, hit.group)
        grouped.setdefault(key, []).append(hit)
    findings = [
        replace(
            _joined(CHECKS[key[0]], group, limits[key[0]], words),
            because_of=key[2],
            severity=key[1],
        )
        for key, group in grouped.items()
    ]
    order = list(CHECKS)
    areas = list(Area)

    def rank(finding: Finding) -> tuple[int, int, int]:
        return areas.index(finding.area), finding.severity.rank, order.index(finding.id)

    roots = sorted((f for f in findings if f.because_of is None), key=rank)
    rest = sorted((f for f in findings if f.because_of is not None), key=rank)
    told: list[Finding] = []
    placed: set[str] = set()
    for place, finding in enumerate(roots):
        told.append(finding)
        if all(finding.id != later.id for later in roots[place + 1 :]):
            told += [other for other in rest if other.because_of == finding.id]
            placed.add(finding.id)
    return (*told, *(other for other in rest if other.because_of not in placed))


def _severity(check: Check, hit: Hit) -> Severity:
    severity = hit.severity or check.severity
    if severity is Severity.ERROR and hit.confidence is Confidence.POSSIBLE:
        return Severity.WARNING  # only evidence in the data is an error
    return severity


def _cause_of(
    number: int, hits: list[tuple[Check, Hit]], of_check: Mapping[str, Sequence[int]]
) -> int | None:
    """Return the index of the hit that explains a hit; None if no hit explains it.

    If several hits could explain the hit, the first one without a cause of its own is used.

    Args:
        number: Index of the hit.
        hits: All hits, with their checks.
        of_check: Indices of the hits of each check.
    """
    check, hit = hits[number]
    for common, causes in check.because_of:
        for other_number in sorted(n for name in causes.split() for n in of_check.get(name, ())):
            other, cause = hits[other_number]
            if not _share(hit, cause, common):
                continue
            if common not in ("edge", "frame") and _is_calm(other, cause) > _is_calm(check, hit):
                # A note explains an error or a warning only if both are about the same names.
                continue
            if _cause_of(other_number, hits, of_check) is None:
                return other_number
    return None


def _is_calm(check: Check, hit: Hit) -> bool:
    return (hit.severity or check.severity) is Severity.NOTE


def _share(hit: Hit, cause: Hit, common: str) -> bool:
    match common:
        case "gap" | "mixed" | "skew" if not hit.facts.get(common):
            return False
        case "anything":
            return True
        case "edge":
            return bool(set(hit.edges) & set(cause.edges))
        case "child" | "mixed":
            children = {child for _, child in cause.edges}
            mine = {child for _, child in hit.edges} | set(hit.frames)
            # Two alternating parents also cause the tree below the unused parent.
            parents = {parent for parent, _ in cause.edges}
            return bool(children & mine) or bool(parents & set(hit.frames))
        case "frame":
            return bool(set(hit.frames) & set(cause.frames))
        case "path" | "gap" | "skew":
            path = hit.facts.get("path")
            edges = {(str(a), str(b)) for a, b in path} if isinstance(path, list) else set()
            return bool((edges | set(hit.edges)) & set(cause.edges)) or bool(
                set(hit.topics) & set(cause.topics)
            )
    return bool(set(hit.edges) & set(cause.edges)) or bool(set(hit.topics) & set(cause.topics))


def _joined(check: Check, hits: list[Hit], limits: Limits, words: Mapping[str, str]) -> Finding:
    """Merge similar hits (single observations) of one check into one finding."""
    first = hits[0]
    concerned = _concerned(hits)
    named = list(dict.fromkeys(str(hit.facts["named"]) for hit in hits if "named" in hit.facts))
    facts = {
        "frames": several(first.frames),
        **first.facts,
        "where": several(concerned, 3),
        "concerned": len(concerned),
        "named": several(named),
        "many": len(named),
    }
    words = {**words, "named": several(named)}
    evidence = evidence_lines(check.detail, hits)
    changed = {name: value for name, value in limits.items() if value != check.limits[name]}
    if changed:
        told = ", ".join(f"{name} = {value:g}" for name, value in changed.items())
        evidence.append(f"with {told}")

    def worded(text: str) -> str:
        return filled(in_words(text, words), facts)

    own = [Fix(in_words(fix.text, words), fix.command) for fix in first.fixes]
    usual = [Fix(worded(fix.text), worded(fix.command)) for fix in check.fixes]
    since = [hit.since for hit in hits if hit.since is not None]
    until = [hit.until for hit in hits if hit.until is not None]
    return Finding(
        id=check.id,
        severity=first.severity or check.severity,
        area=check.area,
        message=worded(check.headline),
        confidence=max((hit.confidence for hit in hits), key=list(Confidence).index),
        edges=tuple(dict.fromkeys(edge for hit in hits for edge in hit.edges)),
        frames=tuple(dict.fromkeys(frame for hit in hits for frame in hit.frames)),
        topics=tuple(dict.fromkeys(topic for hit in hits for topic in hit.topics)),
        publishers=tuple(dict.fromkeys(node for hit in hits for node in hit.publishers)),
        since=min(since, default=None),
        until=max(until, default=None),
        count=sum(hit.count for hit in hits),
        facts=MappingProxyType(dict(first.facts)),
        evidence=tuple(line for line in evidence if line),
        consequence=worded(check.consequence),
        fixes=(*own, *usual),
    )


def _concerned(hits: list[Hit]) -> list[str]:
    """Return names for a headline: of the hits' edges, else of the topics, else of the frames."""
    edges = dict.fromkeys(f"{child} in {parent}" for hit in hits for parent, child in hit.edges)
    topics = dict.fromkeys(topic for hit in hits for topic in hit.topics)
    frames = dict.fromkeys(frame for hit in hits for frame in hit.frames)
    return list(edges or topics or frames)


def diagnose(
    recording: "Recording | Buffer | Frames",
    *,
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
    cache_time: Duration = CACHE_TIME,
    urdf: str | Path | None = None,
) -> list[Finding]:
    """Return the doctor's findings about a recording, a buffer or opened frames.

    A buffer contains no log times and no messages, so checks of these are skipped.

    Args:
        recording: A recording, a buffer, or opened frames.
        select: Ids or areas of the checks to run; empty for all.
        ignore: Ids or areas of the checks to leave out.
        cache_time: Cache time of the assumed listener, nanoseconds.
        urdf: File with the robot's description; None for the recorded description, if any.

    Returns:
        The findings, by area, errors first. A finding whose `because_of` is not None is the
        consequence of another finding.

    Raises:
        InputError: If nothing of the recording can be read.
        TypeError: If the source has no frames.
        UsageError: If a check or an area is unknown, or if the description needs xacro and xacro
            is not installed.
    """
    settings = Settings(cache_time=cache_time)
    described = None if urdf is None else described_by(urdf)
    evidence = evidence_of(recording, described)
    return list(judge(evidence, settings, select=select, ignore=ignore).findings)
