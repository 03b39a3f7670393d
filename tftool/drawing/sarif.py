"""The doctor's findings in SARIF 2.1.0, the format in which code hosts import check results."""

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

from tftool.base.plain_text import visible
from tftool.doctor.check import Check
from tftool.doctor.findings import Finding
from tftool.doctor.judge import CHECKS, Diagnosis
from tftool.drawing.finding_view import explained

SCHEMA: Final = "https://json.schemastore.org/sarif-2.1.0.json"


def as_sarif(rows: "Sequence[tuple[str, Diagnosis | str]]") -> str:
    """Return the reports of several sources as one SARIF document.

    Findings that another finding explains are omitted, as in every report. An unreadable source
    becomes a notification of the run, and marks the run as unsuccessful.

    Args:
        rows: Each source with its diagnosis, or the reason why it could not be read.
    """
    results: list[dict[str, Any]] = []
    unreadable: list[dict[str, Any]] = []
    for name, found in rows:
        if isinstance(found, str):
            told = {"level": "error", "message": {"text": found}, "locations": [_location(name)]}
            unreadable.append(told)
            continue
        results += [_result(name, one) for one in found.findings if one.because_of is None]
    for one in results:
        one["ruleIndex"] = list(CHECKS).index(one["ruleId"])
    driver = {
        "name": "tftool doctor",
        # The version is read from the installed package, because importing it is not allowed here.
        "version": sys.modules["tftool"].__version__,
        "rules": [_rule(check) for check in CHECKS.values()],
    }
    invocation = {
        "executionSuccessful": not unreadable,
        "toolExecutionNotifications": unreadable,
    }
    run = {"tool": {"driver": driver}, "invocations": [invocation], "results": results}
    document = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    return json.dumps(document, indent=2, allow_nan=False, default=str) + "\n"


def _rule(check: Check) -> dict[str, Any]:
    rule: dict[str, Any] = {
        "id": check.id,
        "shortDescription": {"text": check.summary},
        "help": {"text": explained(check)},
        "defaultConfiguration": {"level": check.severity.value},
        "properties": {"tags": [check.area.value]},
    }
    if check.links:
        rule["helpUri"] = check.links[0]
    return rule


def _result(source: str, finding: Finding) -> dict[str, Any]:
    # The severities have the names that SARIF gives to its levels.
    return {
        "ruleId": finding.id,
        "level": finding.severity.value,
        "message": {"text": _message(finding)},
        "locations": [_location(source, finding)],
        "partialFingerprints": {"tftoolDoctor/v1": finding.fingerprint},
        # Findings that the report given by --baseline contains as well.
        "suppressions": [{"kind": "external", "status": "accepted"}] if finding.known else [],
        "properties": {
            "confidence": finding.confidence.value,
            "publishers": list(finding.publishers),
            "since": finding.since,
            "until": finding.until,
        },
    }


def _message(finding: Finding) -> str:
    lines = [finding.message, *finding.evidence, f"so: {finding.consequence}"]
    lines += [f"fix: {fix.line}" for fix in finding.fixes]
    return "\n".join(visible(line) for line in lines)


def _location(source: str, finding: Finding | None = None) -> dict[str, Any]:
    """Return a SARIF location: the start of the file, and a finding's frames, edges and topics."""
    path = Path(source)
    if "://" in source:
        address = quote(source, safe=":/?#[]@!$&'()*+,;=%", errors="surrogateescape")
    else:
        address = (
            path.as_uri()
            if path.is_absolute()
            else quote(path.as_posix(), errors="surrogateescape")
        )
    # Code hosts show a result at a line. A recording has no lines, so use the first line.
    place = {"artifactLocation": {"uri": address}, "region": {"startLine": 1}}
    location: dict[str, Any] = {"physicalLocation": place}
    if finding is not None:
        named = [("edge", f"{parent} -> {child}") for parent, child in finding.edges]
        named += [("frame", frame) for frame in finding.frames]
        named += [("topic", topic) for topic in finding.topics]
        location["logicalLocations"] = [
            {"kind": kind, "fullyQualifiedName": name} for kind, name in named
        ]
    return location
