"""The doctor's diagnosis for terminals, --json, Markdown and build servers (JUnit)."""

from collections.abc import Sequence
from re import findall, fullmatch, split, sub
from string import Formatter
from textwrap import TextWrapper
from typing import Any

import numpy as np
from rich import box
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from tftool.base.plain_text import count, visible
from tftool.base.report import Judgement, Report
from tftool.base.stamps import SIMULATED_BELOW, Stamp, as_seconds, seconds
from tftool.doctor.check import Check
from tftool.doctor.findings import Area, Confidence, Finding, Severity
from tftool.doctor.judge import CHECKS, Diagnosis
from tftool.doctor.model import Model, Shift
from tftool.doctor.stamp_stream import WILD, Heard, Stream, Track, rate
from tftool.doctor.wording import MOST_IN_LINE, dated, filled, in_words, several, span
from tftool.drawing import report_view as judgements
from tftool.recordings.contract import percentile

SCHEMA = "tftool.doctor/2"

_CALM = Severity.NOTE
"""Severity of findings that need no action."""

MOST_LINES = 3
"""Lines of evidence shown per finding; a verbose report shows all."""

_STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}


# For people


def render(diagnosis: Diagnosis, *, verbose: bool = False) -> RenderableType:
    """Format the report on one source for a terminal, with findings and counts."""
    parts: list[RenderableType] = [Text(visible(head(diagnosis.model)), "bold")]
    if diagnosis.model.reference:
        parts.append(Text(visible(f"latencies: {diagnosis.model.reference}")))
    folded = _folded(diagnosis)
    for finding in diagnosis.findings:
        if not finding.is_shown and not verbose:
            continue
        parts += [Text(""), *_told(finding, verbose=verbose)]
        if not verbose:
            because = folded.pop(finding.id, [])
            if because:
                parts.append(Text(f"       with it: {', '.join(because)}", "dim"))
    is_clean = not any(finding.is_shown for finding in diagnosis.findings)
    if is_clean:
        parts += [Text(""), _clean(diagnosis), Text("")]
    else:
        parts += [Text(""), Text(visible(areas(diagnosis)))]
    if verbose:
        parts += [
            Text(visible(f"skipped: {one.id}: {one.reason}"), "dim") for one in diagnosis.skipped
        ]
    parts.append(Text(visible(summary(diagnosis)), "bold"))
    return Group(*parts)


def so_far(diagnosis: Diagnosis) -> list[Text]:
    """Return lines for a live view: the findings that no other finding explains, worst first."""
    found = [finding for finding in diagnosis.findings if finding.is_shown]
    return [_first_line(one) for one in sorted(found, key=lambda one: one.severity.rank)]


def _first_line(finding: Finding, *, verbose: bool = False) -> Text:
    line = Text(finding.severity.value, _STYLES[finding.severity])
    line.append(f"  {finding.id}", "bold")
    if finding.confidence is not Confidence.CERTAIN or verbose:
        line.append(f" ({finding.confidence.value})", "dim")
    return line.append(f": {visible(finding.message)}", "default")


def _told(finding: Finding, *, verbose: bool) -> list[RenderableType]:
    line = _first_line(finding, verbose=verbose)
    if finding.known:
        line.append(" (in the baseline)", "dim")
    body = Table.grid(padding=(0, 1), pad_edge=False)
    body.add_column(no_wrap=True)
    body.add_column(overflow="fold")
    evidence = list(finding.evidence)
    hidden = 0 if verbose else max(0, len(evidence) - MOST_LINES)
    lines: list[RenderableType] = [line]
    shown = [visible(text) for text in evidence[: len(evidence) - hidden]]
    if hidden:
        shown.append(f"and {hidden} more (--verbose shows them)")
    lines += [Padding(Text(text), (0, 0, 0, 7)) for text in shown]
    if verbose and len(finding.edges) > MOST_IN_LINE:
        # A line of evidence may be about many edges without naming them.
        edges = ", ".join(f"{child} in {parent}" for parent, child in finding.edges)
        lines.append(Padding(Text(visible(f"transforms: {edges}")), (0, 0, 0, 7)))
    if finding.publishers and verbose:
        lines.append(Padding(Text(visible(_published(finding))), (0, 0, 0, 7)))
    if finding.because_of is not None:
        body.add_row("", Text(f"because of {finding.because_of}"))
    if finding.consequence:
        body.add_row(Text("so:"), Text(visible(finding.consequence)))
    fixes = finding.fixes if verbose else finding.fixes[:2]
    for number, fix in enumerate(fixes):
        body.add_row(Text("" if number else "fix:"), Text(visible(fix.text)))
        if fix.command:
            body.add_row("", Text(visible(fix.command), "bold"))
    lines.append(Padding(body, (0, 0, 0, 7)))
    return lines


def head(model: Model) -> str:
    """Return a line about the source: name, duration, and numbers of topics and frames."""
    material = model.evidence
    facts = [material.kind]
    if material.end > material.start and material.timed:
        received = as_seconds(material.end - material.start)
        facts.append(f"{received:.1f} s")
        known = as_seconds(_last_arrival(model) - material.start)
        if received - known > 1.0:
            facts[-1] += f" (its transforms end at {known:.1f} s)"
    if material.topics:
        facts.append(count(len(material.topics), "topic"))
    facts.append(count(len(model.frames), "frame"))
    facts.append(count(len(model.trees), "tree"))
    facts.append(count(len(material.transforms) - sum(model.copies.values()), "transform"))
    return f"{material.name}: {', '.join(facts)}"


def _last_arrival(model: Model) -> Stamp:
    """Return the time when the last moving transform arrived, or the end of the source."""
    transforms = model.evidence.transforms
    arrivals = [transforms.log_times_of(edge) for edge in transforms.edges if not edge.static]
    return max((int(one.max()) for one in arrivals if len(one)), default=model.evidence.end)


def areas(diagnosis: Diagnosis) -> str:
    """Return a line with the areas (groups of checks) that have no finding."""
    model = diagnosis.model
    told = [
        f"{area.value}: {reason}" if reason else f"{area.value} fine{_latencies(model, area)}"
        for area, reason in _fine(diagnosis)
    ]
    # A shown finding about clocks replaces the line of the area, but may not name the shift.
    shown = {one.id for one in diagnosis.findings if one.is_shown and one.area is Area.CLOCKS}
    if shown and model.shift is not None and not shown & {"shifted-clock", "clock-offset"}:
        told.append(f"{Area.CLOCKS.value}: {_shifted(model.shift)}")
    elif shown and (unset := _unset(model)):
        told.append(f"{Area.CLOCKS.value}: {unset}")
    return " · ".join(told)


def _unset(model: Model) -> str:
    """Return a note about a recorder's clock that shows a time before ROS existed, else ""."""
    start = model.evidence.start
    if not (model.evidence.timed and SIMULATED_BELOW <= start < _FIRST_ROS):
        return ""
    return f"recorded at {dated(start)}, before ROS existed: the recorder's clock is wrong"


_FIRST_ROS = seconds(1_193_875_200)
"""Time, nanoseconds, before which ROS did not exist: 1 November 2007."""


def _shifted(shift: Shift) -> str:
    side = "before" if shift.by > 0 else "after"
    return f"most stamps are {span(abs(shift.by))} {side} their arrival"


def _clean(diagnosis: Diagnosis) -> Table:
    """Return a table of the areas (groups of checks) without a finding, with a measurement each."""
    model = diagnosis.model
    evidence = model.evidence
    heard = len({one.topic for one in model.heard if len(one.stamps)})
    facts = {
        Area.PUBLISHERS: _sources(model),
        Area.SHAPE: f"{count(len(model.frames), 'frame')} in {count(len(model.trees), 'tree')}",
        Area.NAMES: f"{count(len(model.frames), 'name')} of frames",
        Area.CLOCKS: _latencies(model, Area.CLOCKS).strip(" ()"),
        Area.COVERAGE: f"{count(heard, 'topic')} with headers"
        if heard
        else "transforms only, as no message has a header",
        Area.VALUES: count(len(evidence.transforms), "transform"),
    }
    table = Table.grid(padding=(0, 2), pad_edge=False)
    table.add_column(no_wrap=True)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for area, reason in _fine(diagnosis):
        tick, style = ("-", "dim") if reason else ("✓", "green")
        fact = reason or facts.get(area, "")
        table.add_row(
            Text(tick, style), Text(area.value, style), Text(visible(fact), "dim" if reason else "")
        )
    return table


def _sources(model: Model) -> str:
    """Return the number of nodes that publish transforms, or of topics if no node name is known."""
    publishers = [one for track in model.tracks for one in track.publishers]
    nodes = {one.node for one in publishers if one.node}
    if nodes:
        return f"{count(len(nodes), 'publisher')} of transforms"
    return f"{count(len({one.topic for one in publishers}), 'topic')} of transforms"


def _fine(diagnosis: Diagnosis) -> list[tuple[Area, str]]:
    """Return the areas (groups of checks) without a finding, each with a note, or with "".

    A note says, for example, why the checks of the area were skipped. Without transforms, only
    areas with a note are returned.
    """
    wrong = {finding.area for finding in diagnosis.findings if finding.is_shown}
    noted = {finding.id for finding in diagnosis.findings if finding.because_of is None}
    skipped = {one.id: one.reason for one in diagnosis.skipped}
    told = []
    for area in Area:
        checks = [check for check in CHECKS.values() if check.area is area]
        if area in wrong or not checks:
            continue
        reasons = {skipped[check.id] for check in checks if check.id in skipped}
        if len(reasons) == 1 and all(check.id in skipped for check in checks):
            told.append((area, f"skipped, {reasons.pop()}"))
        elif area is Area.CLOCKS and (shift := diagnosis.model.shift) is not None:
            told.append((area, _shifted(shift)))
        elif area is Area.CLOCKS and (unset := _unset(diagnosis.model)):
            told.append((area, unset))
        elif area is Area.CLOCKS and "future-stamp" in noted:
            told.append((area, _latencies(diagnosis.model, area).strip(" ()")))
        elif area is Area.CLOCKS and (off := _far_off(diagnosis.model)):
            told.append((area, off))
        elif len(diagnosis.model.evidence.transforms):
            told.append((area, ""))
    return told


def _far_off(model: Model) -> str:
    """Return a note about the first stream with a latency that no delay explains, else ""."""
    for name, latency in _medians(model):
        if abs(latency) > WILD:
            side = "before" if latency > 0.0 else "after"
            return f"stamps of {name} are {span(abs(latency))} {side} their arrival"
    return ""


def _medians(model: Model) -> list[tuple[str, float]]:
    """Return the median latency, nanoseconds, of tf and of up to three topics with positions."""
    if not model.evidence.timed:
        return []
    moving = [track.median_latency for track in model.dynamic if not track.is_localisation]
    latencies = [("tf", float(np.median(moving)))] if moving else []
    heard = [one for one in model.heard if one.is_spatial and len(one.stamps)][:3]
    return latencies + [(one.topic, float(one.median_latency)) for one in heard]


def _latencies(model: Model, area: Area) -> str:
    latencies = _medians(model) if area is Area.CLOCKS else []
    parts = (
        f"{name} dated {span(-latency)} ahead" if latency < 0.0 else f"{name} {span(latency)}"
        for name, latency in latencies
    )
    return f" (latency: {', '.join(parts)})" if latencies else ""


def summary(diagnosis: Diagnosis) -> str:
    """Return a line with the number of findings and the command that explains more."""
    told = [one for one in diagnosis.findings if one.is_shown]
    quiet = [f for f in diagnosis.findings if f.because_of is None and not f.is_shown]
    if none := [one for one in quiet if one.id == "no-transforms" and not told]:
        return f"nothing to examine: {none[0].message}"
    if not told:
        skipped = f", {len(diagnosis.skipped)} skipped" if diagnosis.skipped else ""
        why = " (--verbose says why)" if skipped else ""
        notes = f"; {count(len(quiet), 'note')}: --verbose" if quiet else ""
        return f"nothing found; {count(diagnosis.ran, 'check')} ran{skipped}{why}{notes}"
    # The first finding among those with the worst severity.
    worst = min(told, key=lambda one: one.severity.rank)
    notes = f" ({count(len(quiet), 'more note')}: --verbose)" if quiet else ""
    calm = "" if worst.severity is not Severity.NOTE else "If everything works, change nothing. "
    return (
        f"{counted(told)}{notes}. {calm}`tftool doctor --explain {worst.id}` tells more; "
        "`--markdown` prints this for an issue."
    )


def counted(findings: Sequence[Finding]) -> str:
    """Count findings by severity: "1 error, 2 warnings"; "" if there are none."""
    numbers = [(one.value, sum(found.severity is one for found in findings)) for one in Severity]
    return ", ".join(count(number, word) for word, number in numbers if number)


def brief(diagnosis: Diagnosis) -> str:
    """Return a diagnosis in one line, for other commands to print below their output."""
    causes = [finding for finding in diagnosis.findings if finding.because_of is None]
    ids = ", ".join(dict.fromkeys(one.id for one in causes if one.severity is not _CALM))
    if not ids:
        return "Doctor: nothing is wrong."
    return f"Doctor: {counted(causes)} ({ids}). 'tftool doctor' shows the details."


def _folded(diagnosis: Diagnosis) -> dict[str, list[str]]:
    """Return the consequences of each cause, by the id of the causing check.

    A consequence is the id of a check, with the number of findings if there are several.
    """
    counts: dict[str, dict[str, int]] = {}
    for finding in diagnosis.findings:
        if finding.because_of is not None:
            of = counts.setdefault(finding.because_of, {})
            of[finding.id] = of.get(finding.id, 0) + 1
    return {
        cause: [name if number == 1 else f"{name} ({number})" for name, number in of.items()]
        for cause, of in counts.items()
    }


def compared(rows: Sequence[tuple[str, Diagnosis | str]]) -> Table:
    """Return a table with a row per source: the findings, or the reason why nothing was read."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("source", overflow="fold")
    for severity in Severity:
        table.add_column(f"{severity.value}s", justify="right")
    table.add_column("what", overflow="fold")
    for name, found in rows:
        shown = Text(visible(name))
        if isinstance(found, str):
            table.add_row(shown, "", "", "", Text(f"unreadable: {visible(found)}", "red"))
            continue
        numbers = [
            Text(str(count) if count else "", _STYLES[severity])
            for severity, count in ((s, found.count(s)) for s in Severity)
        ]
        ids = dict.fromkeys(
            one.id
            for one in found.findings
            if one.because_of is None and one.severity is not Severity.NOTE
        )
        table.add_row(shown, *numbers, Text(", ".join(ids) or "fine"))
    return table


def statistics(model: Model) -> Table:
    """Return a table of rate, latency and largest gap of every frame and topic."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("transform or topic", overflow="fold")
    for column in ("kind", "count", "rate", "latency p50", "p95", "worst gap"):
        table.add_column(column, justify="right")
    streams: list[Track | Heard] = [*model.tracks, *model.heard]
    for stream in streams:
        is_track = isinstance(stream, Track)
        name = stream.name if isinstance(stream, Track) else f"{stream.topic} in {stream.frame}"
        kind = ("static" if stream.static else "moving") if isinstance(stream, Track) else "topic"
        numbers = _numbers(stream, timed=model.evidence.timed)
        if is_track and kind == "static":
            numbers = ("", "", "", "")
        table.add_row(Text(visible(name)), kind, f"{len(stream.stamps):,}", *numbers)
    return table


def _numbers(stream: Stream, *, timed: bool) -> tuple[str, str, str, str]:
    if not len(stream.stamps):
        return "", "", "", ""
    steps = np.diff(np.sort(stream.stamps))
    often = rate(stream)
    return (
        f"{often:.4g} Hz" if often else "",
        span(percentile(stream.latency, 50)) if timed else "",
        span(percentile(stream.latency, 95)) if timed else "",
        span(int(steps.max())) if len(steps) else "",
    )


# About the checks


def listing() -> Table:
    """Return a table of all checks: id, area, severity and summary."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for column in ("id", "area", "severity"):
        table.add_column(column, no_wrap=True)
    table.add_column("what it finds", overflow="fold")
    for check in CHECKS.values():
        table.add_row(
            check.id,
            check.area.value,
            Text(check.severity.value, _STYLES[check.severity]),
            check.summary,
        )
    return table


def explained(check: Check, width: int | None = None) -> str:
    """Return the full description of one check as text.

    Args:
        check: The check.
        width: Maximum length of a line in cells, None for no limit; lines are wrapped at spaces.
    """
    lines = [
        f"{check.id}: {check.summary}",
        "",
        f"  {check.severity.value}, about {check.area.value}",
        "",
    ]
    for number, sentence in enumerate(_rule(check)):
        lines.append(f"{'rule   ' if not number else '       '}  {sentence}")
    if check.why:
        lines.append(f"why      {check.why}.")
    if check.limits:
        names = ", ".join(f"{name} = {value:g}" for name, value in check.limits.items())
        lines.append(f"limits   {names}  (--limit {check.id}.{next(iter(check.limits))}=VALUE)")
    if check.needs:
        lines.append(f"needs    {', '.join(check.needs)}")
    # A headline of one placeholder, such as {named}, says nothing without a finding.
    if not fullmatch(r"\{\w+\}", check.headline):
        lines.append(f"says     {_general(check.headline)}")
    lines.append(f"so       {_general(check.consequence)}.")
    for number, cause in enumerate(check.causes):
        lines.append(f"{'causes ' if not number else '       '}  {cause}")
    for number, fix in enumerate(check.fixes):
        command = f": {fix.command}" if fix.command else ""
        lines.append(f"{'fix    ' if not number else '       '}  {_general(fix.text + command)}")
    for number, link in enumerate(check.links):
        lines.append(f"{'see    ' if not number else '       '}  {link}")
    if width is not None:
        # A command or an address is never wrapped, so that it can be copied.
        how = TextWrapper(
            width, subsequent_indent=" " * 9, break_long_words=False, break_on_hyphens=False
        )
        lines = [one for line in lines for one in how.wrap(line) or [""]]
    return "\n".join(lines) + "\n"


def _rule(check: Check) -> list[str]:
    """Return the sentences of a check's rule; each sentence is one condition."""
    return split(r"(?<=\.) (?=[A-Z0-9])", f"{filled(check.rule, check.limits)}.")


def as_page() -> str:
    """Return a Markdown page that describes every check, by area."""
    lines = [
        "# What the doctor looks for",
        "",
        "`tftool doctor --list --markdown` writes this page. The rule of a check states when the",
        "check reports a finding, and when a finding is only a warning or a note. *Says* and *so*",
        "are the texts of the finding; names in CAPITALS stand for its facts. *Fix* is the remedy.",
        "",
        "A *static* is a static transform, as on /tf\\_static. A *mount* is the fixed pose of a "
        "part",
        "on a robot. A *range* is a message of the type `sensor_msgs/Range`. A *share* is a "
        "fraction",
        "from 0 to 1. `--limit ID.NAME=VALUE` sets the threshold NAME of the check ID.",
    ]
    for area in Area:
        lines += ["", f"## {area.value[0].upper()}{area.value[1:]}"]
        for check in CHECKS.values():
            if check.area is area:
                lines += ["", *_paragraphs(check)]
    return "\n".join(lines) + "\n"


def _paragraphs(check: Check) -> list[str]:
    """Return the lines of a Markdown page that describe one check."""
    lines = [f"### {check.id}", "", f"*{check.severity.value}*: {_marked(check.summary)}.", ""]
    first, *others = _rule(check)
    lines.append(f"- **rule**: {_marked(first)}")
    lines += [f"  - {_marked(sentence)}" for sentence in others]
    if check.why:
        lines.append(f"- **why**: {_marked(check.why)}.")
    if check.limits:
        given = (f"`{name}` = {value:g}" for name, value in check.limits.items())
        lines.append(f"- **thresholds**: {', '.join(given)}")
    if check.needs:
        lines.append(f"- **needs**: {', '.join(check.needs)}")
    if not fullmatch(r"\{\w+\}", check.headline):
        lines.append(f"- **says**: {_marked(_general(check.headline))}")
    lines.append(f"- **so**: {_marked(_general(check.consequence))}.")
    if check.causes:
        lines.append(f"- **causes**: {_marked('; '.join(check.causes))}")
    for fix in check.fixes:
        command = f" `{_general(fix.command)}`" if fix.command else ""
        lines.append(f"- **fix**: {_marked(_general(fix.text))}{command}")
    if check.links:
        lines.append(f"- **see**: {', '.join(f'<{link}>' for link in check.links)}")
    return lines


def _marked(text: str) -> str:
    """Escape the characters of a text that have a meaning in Markdown."""
    return sub(r"([\\`*_<>\[\]|])", r"\\\1", text)


def _general(text: str) -> str:
    """Replace each placeholder of a message template by its name in capitals."""
    shown, follows = "", False
    fields = list(Formatter().parse(in_words(text)))
    nexts = [literal for literal, *_ in fields[1:]]
    for (literal, name, spec, _), after in zip(fields, [*nexts, ""], strict=True):
        shown += literal
        # A field that touches a word or a field is a prefix or an ending, and may be empty.
        is_part = shown[-1:].isalpha() or (follows and not literal) or after[:1].isalpha()
        follows = "|" not in (spec or "")
        if spec and not follows:
            shown += spec.partition("|")[0]
        elif name is not None and not is_part:
            shown += name.split("[")[0].upper()
    return shown


# For programs


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """Return a diagnosis as a mapping, for --json; times in nanoseconds, unescaped names."""
    material = diagnosis.model.evidence
    return {
        "schema": SCHEMA,
        "source": material.name,
        "read": {
            "kind": material.kind,
            "from": material.start,
            "to": material.end,
            "transforms": len(material.transforms),
            "frames": len(diagnosis.model.frames),
            "trees": len(diagnosis.model.trees),
            "truncated": bool(material.damage),
        },
        "findings": [as_row(finding) for finding in diagnosis.findings],
        "skipped": [{"id": one.id, "reason": one.reason} for one in diagnosis.skipped],
        "summary": {severity.value: diagnosis.count(severity) for severity in Severity},
    }


def as_row(finding: Finding) -> dict[str, Any]:
    """Return one finding as a mapping, for --json."""
    links = CHECKS[finding.id].links
    return {
        "id": finding.id,
        "severity": finding.severity.value,
        "area": finding.area.value,
        "message": finding.message,
        "confidence": finding.confidence.value,
        "fingerprint": finding.fingerprint,
        "known": finding.known,
        "edges": [list(edge) for edge in finding.edges],
        "frames": list(finding.frames),
        "topics": list(finding.topics),
        "publishers": list(finding.publishers),
        "since": finding.since,
        "until": finding.until,
        "count": finding.count,
        "facts": dict(finding.facts),
        "evidence": list(finding.evidence),
        "consequence": finding.consequence,
        "fixes": [{"text": fix.text, "command": fix.command} for fix in finding.fixes],
        "because_of": finding.because_of,
        "url": links[0] if links else None,
    }


# For issues and build servers


def as_markdown(diagnosis: Diagnosis) -> str:
    """Return a diagnosis as Markdown, a table and then details, with escaped names."""
    told = [finding for finding in diagnosis.findings if finding.is_shown]
    lines = [f"**tftool doctor** {_code(head(diagnosis.model))}", ""]
    if told:
        lines += ["| | id | what |", "| --- | --- | --- |"]
        lines += [
            f"| {one.severity.value} | {one.id} | {_code(one.message, in_table=True)} |"
            for one in told
        ]
        lines += ["", "<details><summary>evidence, consequences, fixes</summary>", ""]
        for one in told:
            lines += [f"**{one.id}**", "", *_fenced(_plain(one)), ""]
        lines += ["</details>", ""]
    lines.append(f"{counted(told)}." if told else summary(diagnosis))
    return "\n".join(lines) + "\n"


def _published(finding: Finding) -> str:
    """Return the publishers of a finding's frames or topics, as the end of a sentence."""
    by = f"published by {', '.join(finding.publishers)}"
    if not finding.topics or not finding.edges:
        return by
    links = several([f"{child} in {parent}" for parent, child in finding.edges], MOST_IN_LINE)
    return f"{links} {'is' if len(finding.edges) == 1 else 'are'} {by}"


def _plain(finding: Finding) -> list[str]:
    lines = [*finding.evidence]
    if finding.publishers:
        lines.append(_published(finding))
    lines.append(f"so:  {finding.consequence}")
    for fix in finding.fixes:
        lines.append(f"fix: {fix.text}")
        if fix.command:
            lines.append(f"     {fix.command}")
    return [visible(line) for line in lines]


def _fenced(lines: list[str]) -> list[str]:
    """Return lines as a Markdown code block, with a fence longer than any in the lines."""
    fence = "`" * max(3, _longest_ticks("\n".join(lines)) + 1)
    return [f"{fence}text", *lines, fence]


def _code(text: str, *, in_table: bool = False) -> str:
    """Format a text as Markdown code in which no character has a special meaning."""
    text = visible(text)
    if in_table:
        # "|" would end the table's cell, even inside code.
        text = text.replace("|", "¦")
    ticks = "`" * (_longest_ticks(text) + 1)
    pad = " " if text.startswith("`") or text.endswith("`") else ""
    return f"{ticks}{pad}{text}{pad}{ticks}"


def _longest_ticks(text: str) -> int:
    return max(map(len, findall("`*", text)))


def as_junit(rows: Sequence[tuple[str, Diagnosis | str]], fails: Severity | None) -> str:
    """Return the reports of several sources as a JUnit document.

    Args:
        rows: Each source with its diagnosis, or the reason why it could not be read.
        fails: Lowest severity at which a finding is a failure; None for no failures.
    """
    reports = []
    for name, found in rows:
        if isinstance(found, str):
            reports.append(Report(name, name, (), failure=found))
            continue
        looked = tuple(
            Judgement(
                f"{one.id}: {one.message}",
                fails is None or one.known or one.severity.rank > fails.rank,
                expected="nothing found",
                found="; ".join((*one.evidence, *(fix.line for fix in one.fixes))),
            )
            for one in found.findings
            if one.because_of is None
        )
        reports.append(Report(name, name, looked))
    return judgements.as_junit(reports, command="tftool doctor", whole="is read to its end")
