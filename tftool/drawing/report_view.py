"""Reports on checked scenarios (expected and found values), as table, JSON and JUnit XML."""

from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree

from rich import box
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from tftool.base.plain_text import count, visible
from tftool.base.report import Judgement, Report


def render(reports: Sequence[Report]) -> Table:
    """Return a table with a line for each report; the failures of a report follow its line."""
    table = Table.grid(padding=(0, 2), pad_edge=False)
    for _ in range(3):
        table.add_column(overflow="fold")
    for report in reports:
        ok = Text("ok", "green") if report.ok else Text("FAILED", "bold red")
        if report.ok and report.warnings:
            ok.append(f", {count(len(report.warnings), 'warning')}", "yellow")
        table.add_row(Text(visible(report.name), "bold"), ok, Text(_told(report)))
        if report.failure and report.judgements:
            # The failure of the run comes first, because everything below may follow from it.
            table.add_row("", "", Text("\n".join(_lines(report.failure))))
        for number, why in enumerate(report.why):
            table.add_row("", "", Text(f"{'     ' if number else 'why: '}{visible(why)}"))
        for judgement in report.judgements:
            if not judgement.ok:
                where = f"line {judgement.line}: " if judgement.line else ""
                when = "" if judgement.at is None else f" at {judgement.at:g} s"
                found = f"found{when}: {visible(judgement.found).rstrip()}"
                table.add_row("", "", Text(f"{where}{visible(judgement.subject)}"))
                table.add_row("", "", Padding(Text(found), (0, 0, 0, 2)))
    return table


def _told(report: Report) -> str:
    if report.judgements:
        held = sum(judgement.ok for judgement in report.judgements)
        return f"{held} of {count(len(report.judgements), 'expectation')} held"
    if report.failure:
        return _lines(report.failure)[0].rstrip(":")
    return "nothing is expected"


def render_all(reports: Sequence[Report]) -> Table:
    """Return a table of every expectation and its outcome, grouped by report."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("scenario", overflow="fold")
    table.add_column("expected", overflow="fold", ratio=3)
    table.add_column("found", overflow="fold", ratio=2)
    table.add_column("")
    for report in reports:
        name = Text(visible(report.name), "bold")
        if report.failure:
            failure = Text(_lines(report.failure)[0])
            table.add_row(name, "", failure, Text("FAILED", "bold red"))
            name = Text("")
        for judgement in report.judgements:
            ok = Text("ok", "green") if judgement.ok else Text("FAILED", "bold red")
            table.add_row(name, Text(visible(judgement.subject)), Text(_found(judgement)), ok)
            name = Text("")
        for number, why in enumerate(report.why):
            table.add_row(name, "" if number else "why", Text(visible(why)), "")
            name = Text("")
        if not (report.failure or report.judgements):
            table.add_row(name, Text("nothing", "dim"), "", Text("ok", "green"))
        table.add_section()
    return table


def summary(reports: Sequence[Report], noun: str = "scenario") -> str:
    """Summarise the reports in one sentence; `noun` names a report's subject in the singular."""
    bad = [report for report in reports if not report.ok]
    judgements = [judgement for report in reports for judgement in report.judgements]
    held = sum(judgement.ok for judgement in judgements)
    scenarios = count(len(reports), noun)
    whole = f"{held} of {count(len(judgements), 'expectation')} held"
    if not judgements:
        whole = "nothing was judged"
    warnings = sum(len(report.warnings) for report in reports)
    whole += f", {count(warnings, 'warning')}" if warnings else ""
    if bad:
        names = ", ".join(visible(report.name) for report in bad)
        return f"{scenarios}, {len(bad)} failed ({names}): {whole}"
    return f"{scenarios}, none failed: {whole}"


def as_rows(reports: Sequence[Report]) -> list[dict[str, Any]]:
    """Return a mapping for each report, for --json, with unescaped names."""
    return [
        {
            "scenario": report.name,
            "file": report.file,
            "ok": report.ok,
            "lasted": report.lasted,
            "failure": report.failure,
            "warnings": list(report.warnings),
            "why": list(report.why),
            "expectations": [
                {
                    "expectation": judgement.subject,
                    "line": judgement.line,
                    "ok": judgement.ok,
                    "expected": judgement.expected,
                    "found": judgement.found,
                    "at": judgement.at,
                }
                for judgement in report.judgements
            ],
        }
        for report in reports
    ]


def as_junit(
    reports: Sequence[Report], command: str = "tftool check", whole: str = "plays to its end"
) -> str:
    """Return reports as a JUnit XML document; durations are simulated times of the scenarios.

    Args:
        reports: The reports.
        command: Name of the command that made the reports.
        whole: Name of the test case for a report of a scenario without expectations.
    """
    root = ElementTree.Element("testsuites", name=command)
    for report in reports:
        suite = ElementTree.SubElement(
            root, "testsuite", name=visible(report.name), time=f"{report.lasted:.3f}"
        )
        for judgement in report.judgements:
            at = 0.0 if judgement.at is None else judgement.at
            case = _case(suite, report, judgement.subject, at)
            if not judgement.ok:
                message = f"expected {judgement.expected}, found {_found(judgement)}"
                failure = ElementTree.SubElement(case, "failure", message=visible(message))
                failure.text = visible(f"{report.file}:{judgement.line}: {message}")
        if report.failure or not report.judgements:
            case = _case(suite, report, whole, report.lasted)
            if report.failure:
                failure = ElementTree.SubElement(case, "error", message=_lines(report.failure)[0])
                failure.text = "\n".join(_lines(report.failure))
        _total(suite, suite)
    _total(root, root)
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _case(
    suite: ElementTree.Element, report: Report, name: str, seconds: float
) -> ElementTree.Element:
    return ElementTree.SubElement(
        suite,
        "testcase",
        classname=visible(report.name),
        name=visible(name),
        file=visible(report.file),
        time=f"{seconds:.3f}",
    )


def _total(element: ElementTree.Element, within: ElementTree.Element) -> None:
    for key, tag in (("tests", "testcase"), ("failures", "failure"), ("errors", "error")):
        element.set(key, str(len(list(within.iter(tag)))))


def _found(judgement: Judgement) -> str:
    found = visible(judgement.found)
    return found if judgement.at is None else f"{found} at {judgement.at:g} s"


def _lines(text: str) -> list[str]:
    return [visible(line) for line in text.split("\n")]
