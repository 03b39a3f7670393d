"""Tests that the doctor finds all faults of the corpus, and nothing else."""

import pytest

from tests.doctor.corpus import CASES, HEALTHY, made_by
from tftool.doctor.findings import Severity


@pytest.mark.parametrize("salt", [1, 2])
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_faults_are_reported_with_their_names_and_without_other_warnings(case, salt):
    findings = [one for one in made_by(case, salt).judged().findings if one.because_of is None]
    ids = {one.id for one in findings}
    assert set(case.expect) <= ids
    loud = {one.id for one in findings if one.severity is not Severity.NOTE}
    assert loud <= {*case.expect, *case.allow}
    evidence = {
        word
        for one in findings
        if one.id in case.expect
        for word in (
            *one.frames, *one.topics, *one.publishers, *(name for e in one.edges for name in e)
        )
    }  # fmt: skip
    assert set(case.where) <= evidence


@pytest.mark.parametrize("case", HEALTHY, ids=lambda case: case.name)
def test_a_healthy_recording_has_at_most_a_note_that_is_true(case):
    ids = {one.id for one in made_by(case, 3).judged().findings}
    assert ids <= {
        # Each robot has one tree, and one message of static transforms.
        "two prefixed robots": {"split-tree"},
        "torn file": {"truncated-recording"},
        "picked-up box": {"parent-switch", "edge-stopped"},
        "numbered and mirrored names": {"latched-overwrite"},
        "statics repeated": {"latched-overwrite"},
    }.get(case.name, set())
