"""Tests of the times at which a pair is looked up, and of refused lookups."""

import math

import numpy as np
import pytest

from tftool import Buffer, LookupException, Transform, TransformStamped, UsageError, seconds
from tftool.frames.pair_samples import Moments, continuous, links_between, sample
from tftool.geometry.conversions import quaternion_from_rpy

SECOND = seconds(1)


def moved(buffer, parent, child, stamps, turn=0.0):
    for stamp in stamps:
        pose = Transform((stamp / SECOND, 0.0, 0.0), quaternion_from_rpy(0.0, 0.0, turn * stamp))
        buffer.set_transform(TransformStamped(stamp, parent, child, pose))


@pytest.fixture
def buffer():
    """Return map -1 Hz- odom -10 Hz- base -static- laser from 1 s to 5 s; odom until 6 s."""
    found = Buffer(seconds(100))
    moved(found, "map", "odom", [n * SECOND for n in range(1, 7)])
    moved(found, "odom", "base", [n * SECOND // 10 for n in range(10, 51)])
    still = TransformStamped(0, "base", "laser", Transform((0.0, 0.0, 1.0)))
    found.set_transform_static(still)
    return found


def test_links_between_two_frames_are_those_of_either_side(buffer):
    buffer.set_transform_static(TransformStamped(0, "odom", "wall", Transform()))

    assert links_between(buffer, "wall", "laser") == ["wall", "laser", "base"]
    assert links_between(buffer, "map", "map") == []


def test_moments_are_the_stamps_of_the_fastest_link(buffer):
    found = sample(buffer, "map", "laser")

    assert found.path.stamps.tolist() == [n * SECOND // 10 for n in range(10, 51)]
    assert found.moments == "at the stamps of 'base'"
    assert found.refused == 0
    assert found.path.translations[7].tolist() == pytest.approx([1.7 + 1.7, 0.0, 1.0])


def test_a_period_begins_at_the_start(buffer):
    asked = Moments(start=2 * SECOND, end=3 * SECOND, period=SECOND // 4)

    found = sample(buffer, "map", "laser", asked)

    assert (found.path.stamps / SECOND).tolist() == [2.0, 2.25, 2.5, 2.75, 3.0]


def test_refused_moments_are_reported_in_runs_with_their_reason(buffer):
    found = sample(buffer, "map", "laser", Moments(period=SECOND // 2))

    # base ends at 5 s, and odom ends at 6 s.
    (run,) = found.refusals
    assert (run.first, run.last, run.count) == (5 * SECOND + SECOND // 2, 6 * SECOND, 2)
    assert "extrapolation into the future" in run.reason
    assert found.refused == 2
    assert np.isnan(found.path.translations[-1]).all()
    assert len(found.answered()) == len(found.path) - 2


def test_given_stamps_are_asked_in_order_and_once(buffer):
    asked = Moments(stamps=np.array([3, 2, 3, 0]) * SECOND, words="at the stamps of '/scan'")

    assert sample(buffer, "map", "odom", asked).path.stamps.tolist() == [2 * SECOND, 3 * SECOND]


def test_two_frames_that_do_not_move_are_asked_once(buffer):
    found = sample(buffer, "base", "laser")

    assert found.path.stamps.tolist() == [SECOND]
    assert found.path.translations.tolist() == [[0.0, 0.0, 1.0]]


def test_an_unknown_frame_is_refused_as_tf2_does(buffer):
    with pytest.raises(LookupException, match="nope"):
        sample(buffer, "map", "nope")


def test_a_span_without_a_moment_is_wrong_usage(buffer):
    with pytest.raises(UsageError, match="contains no time to look up"):
        sample(buffer, "map", "base", Moments(start=50 * SECOND))


def test_more_moments_than_fit_into_memory_are_wrong_usage(buffer):
    with pytest.raises(UsageError, match=r"times, but .* use a lower rate"):
        sample(buffer, "map", "base", Moments(period=10))


def test_quaternions_do_not_jump_to_the_other_sign():
    turns = np.linspace(0.0, 4.0 * math.pi, 50)
    jumping = np.array([quaternion_from_rpy(0.0, 0.0, one) for one in turns])
    jumping *= np.where(np.arange(50) % 3 == 0, -1.0, 1.0)[:, np.newaxis]
    valid = np.arange(50) != 7
    jumping[7] = np.nan

    found = continuous(jumping, valid)[valid]

    assert (np.einsum("ij,ij->i", found[1:], found[:-1]) > 0.9).all()
    assert np.allclose(np.abs(found), np.abs(jumping[valid]))
