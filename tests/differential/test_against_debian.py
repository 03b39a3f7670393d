"""Comparison of tftool's buffer with ROS 1's tf2 as compiled by Debian."""

import math

import pytest

from tests.differential import compare
from tests.differential.ours import difference, live
from tests.differential.worlds import world

MISSING = compare.missing()


@pytest.mark.skipif(bool(MISSING), reason=MISSING)
def test_tf2_gives_the_same_answers_and_the_same_refusals():
    found = compare.compare(range(250), 1e-9)

    assert found.disagreements == []
    assert found.worst <= 1e-9
    assert found.questions >= 20_000
    # Every kind of refusal occurred often.
    assert {kind: count >= 100 for kind, count in found.refused.items()} == dict.fromkeys(
        [
            "ConnectivityException",
            "ExtrapolationException",
            "InvalidArgumentException",
            "LookupException",
            "TransformException",
        ],
        True,
    )


def test_the_same_seed_makes_the_same_world_and_the_same_answers():
    assert world(7) == world(7)
    assert world(7) != world(8)
    assert live(world(7)) == live(world(7))


@pytest.mark.parametrize(
    ("theirs", "ours", "apart"),
    [
        (["is", True], ["is", False], math.inf),
        (["is", ["a", "b"]], ["is", ["a", "b"]], 0.0),
        (["is", ["a", "b"]], ["is", ["b", "a"]], math.inf),
        (["refused", "LookupException"], ["refused", "LookupException"], 0.0),
        (["refused", "LookupException"], ["refused", "ConnectivityException"], math.inf),
        (["refused", "LookupException"], ["is", True], math.inf),
        (["is", [5, [0, 0, 0, 0, 0, 0, 1]]], ["is", [6, [0, 0, 0, 0, 0, 0, 1]]], math.inf),
        (["is", [5, [0, 0, 0, 0, 0, 0, 1]]], ["is", [5, [0.5, 0, 0, 0, 0, 0, 1]]], 0.5),
        (["is", [5, [100, 0, 0, 0, 0, 0, 1]]], ["is", [5, [101, 0, 0, 0, 0, 0, 1]]], 0.01),
        (["is", [5, [0, 0, 0, 0, 0, 0, 1]]], ["is", [5, [0, 0, 0, 0, 0, 0, -1]]], 0.0),
        (["is", [5, [0, 0, 0, 0, 0, 0, 1]]], ["is", [5, [0, 0, 0, 0, 0, 1, 0]]], 1.0),
    ],
)
def test_a_difference_is_seen(theirs, ours, apart):
    assert difference(theirs, ours) == pytest.approx(apart)
