"""Tests of every tf2 vector, each with the module for its kind."""

import copy
from collections import Counter

import pytest

from tests.tf2 import buffer_kind, cache_kind, datum_kinds, number_kinds, program_kinds, time_kinds
from tests.tf2.loader import CASES, FORMAT, Unknown, load

RUNNERS = {
    "buffer": buffer_kind.run,
    "cache": cache_kind.run,
    "math": number_kinds.run_math,
    "time": number_kinds.run_time,
    "do_transform": datum_kinds.run,
    "time_jump": time_kinds.run_time_jump,
    "async": time_kinds.run_async,
    "static_publisher_args": program_kinds.run_static_publisher_args,
    "echo_format": program_kinds.run_echo_format,
    "monitor_format": program_kinds.run_monitor_format,
    "view_frames_dot": program_kinds.run_view_frames_dot,
    "static_broadcaster": program_kinds.run_static_broadcaster,
}
"""Function that runs the cases of each kind."""

NOT_YET_COVERED: dict[str, str] = {}
"""Reason for each kind that no function runs; this must stay empty."""

KNOWN = {
    *("id", "group", "kind", "from", "note", "note_versions", "ros1", "ros1_differs_at_steps"),
    *("quirk", "cache_ns", "static", "transform", "steps", "eval_time", "interpolation_space"),
    # tftool returns the exact sign everywhere.
    "quat_sign_exact_from",
}
"""Allowed keys of a case."""


@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_tf2_answers_so(case):
    assert set(case) <= KNOWN
    RUNNERS[case["kind"]](case)


def test_no_kind_is_left_out_in_silence():
    kinds = Counter(case["kind"] for case in CASES)

    assert set(kinds) == set(RUNNERS) | set(NOT_YET_COVERED)
    assert not NOT_YET_COVERED
    assert sum(kinds.values()) == 171


@pytest.mark.parametrize("kind", RUNNERS)
def test_an_operation_or_a_field_that_no_runner_knows_is_an_error(kind):
    case = copy.deepcopy(next(case for case in CASES if case["kind"] == kind))
    case["steps"] = [{**case["steps"][0], "surprise": 1}]
    with pytest.raises(Unknown, match="surprise"):
        RUNNERS[kind](case)

    case["steps"] = [{"op": "levitate"}]
    with pytest.raises(Unknown, match="levitate"):
        RUNNERS[kind](case)


def test_vectors_of_another_format_are_refused():
    with pytest.raises(ValueError, match="not known"):
        load(f"format: {FORMAT}0")
