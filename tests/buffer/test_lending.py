"""Tests that changes of one buffer are invisible in another buffer that shares the samples."""

import numpy as np
import pytest

from tftool.base.errors import TransformException
from tftool.base.stamps import seconds
from tftool.buffer.buffer import NO_LIMIT, Buffer, lend
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

COUNT = 50


def sample(stamp, x):
    return TransformStamped(seconds(stamp), "a", "b", Transform((float(x), 0.0, 0.0)))


@pytest.fixture
def whole():
    buffer = Buffer(NO_LIMIT)
    stamps = np.arange(1, COUNT + 1) * seconds(1)
    places = np.stack([np.arange(1.0, COUNT + 1), *np.zeros((2, COUNT))], axis=1)
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (COUNT, 1))
    assert buffer.set_transforms("a", "b", stamps, places, turns, "node") is not None
    return buffer


def x_at(buffer, stamp):
    return buffer.lookup_transform("a", "b", seconds(stamp)).transform.translation.x


def lent(whole, until):
    other = Buffer(NO_LIMIT)
    assert lend(whole, "b", other, seconds(until))
    return other


def test_the_other_knows_what_came_up_to_the_moment_and_no_more(whole):
    other = lent(whole, 20.5)

    assert [x_at(other, stamp) for stamp in (1, 7.25, 20)] == [1.0, 7.25, 20.0]
    assert other.lookup_transform("a", "b", 0).stamp == seconds(20)
    with pytest.raises(TransformException):
        x_at(other, 20.5)
    assert other.snapshot(seconds(50)).frame("b").authority == "node"


@pytest.mark.parametrize("late", [20.5, 60])
def test_a_sample_inserted_into_one_buffer_is_not_in_the_other(whole, late):
    other = lent(whole, 20)

    other.set_transform(sample(late, -3), "else")
    assert x_at(other, late) == -3.0
    assert x_at(whole, 20.5) == 20.5
    assert whole.lookup_transform("a", "b", 0).stamp == seconds(COUNT)

    whole.set_transform(sample(10.5, -7), "node")
    assert x_at(whole, 10.5) == -7.0
    assert x_at(other, 10.5) == 10.5


def test_before_its_first_sample_a_frame_is_not_known(whole):
    assert lent(whole, 0.5).frames() == []


def test_a_frame_with_two_senders_is_not_lent(whole):
    whole.set_transform(sample(90, 1), "another")

    other = Buffer(NO_LIMIT)
    assert not lend(whole, "b", other, seconds(20))
    assert other.frames() == []


def test_roots_and_statics_are_not_lent(whole):
    whole.set_transform_static(TransformStamped(0, "b", "c", Transform()), "node")

    other = Buffer(NO_LIMIT)
    assert not lend(whole, "a", other, seconds(20))
    assert not lend(whole, "c", other, seconds(20))
