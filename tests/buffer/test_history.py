"""Comparison of an edge's history with a naive model of tf2's rules: a list, newest first."""

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import rotations
from tftool.buffer.history import (
    BACKWARD,
    FORWARD,
    KNOWN,
    MOST_ALIKE,
    NEEDS_CHECK,
    NO_DATA,
    PARENT_CHANGED,
    STORED,
    TOO_OLD,
    History,
    StaticLink,
)
from tftool.geometry import quaternions
from tftool.geometry.rigid import Vector3

NO_TURN = (0.0, 0.0, 0.0, 1.0)


class Model:
    """Model with tf2's rules, written without regard to speed."""

    def __init__(self, limit):
        self.limit = limit
        self.items = []

    def insert(self, stamp, parent, pose):
        items = self.items
        while items and items[-1][0] + self.limit < items[0][0]:
            items.pop()
        if items and stamp < items[0][0] - self.limit:
            return False
        place = next((i for i, one in enumerate(items) if one[0] <= stamp), len(items))
        equal = [one for one in items[place:] if one[0] == stamp]
        if (stamp, parent, pose) not in equal:
            items.insert(place, (stamp, parent, pose))
        return True

    def find(self, time):
        items = self.items
        if not items:
            return NO_DATA, 0
        if time == 0:
            return items[0]
        if len(items) == 1:
            return items[0] if items[0][0] == time else (NO_DATA, items[0][0])
        if time == items[0][0]:
            return items[0]
        if time == items[-1][0]:
            return items[-1]
        if time > items[0][0]:
            return FORWARD, items[0][0]
        if time < items[-1][0]:
            return BACKWARD, items[-1][0]
        place = next(i for i, one in enumerate(items) if one[0] <= time)
        one, two = items[place], items[place - 1]
        if one[1] != two[1]:
            return one
        ratio = (time - one[0]) / (two[0] - one[0])
        place = [a + ratio * (b - a) for a, b in zip(one[2][:3], two[2][:3], strict=True)]
        return one[0], one[1], (*place, *on_the_way(one[2][3:], two[2][3:], ratio))


def on_the_way(start, end, share):
    """Interpolate between two rotations by the axis and angle of the turn from one to the other."""
    x, y, z, w = quaternions.multiply(quaternions.conjugate(start), end)
    sine, sign = math.hypot(x, y, z), math.copysign(1.0, w)
    if sine == 0.0:
        return start
    half = math.atan2(sine, abs(w)) * share
    part = sign * math.sin(half) / sine
    return quaternions.multiply(start, (x * part, y * part, z * part, math.cos(half)))


def put(link, stamp, origin, sample, *validated):
    """Insert a sample of seven numbers."""
    return link.insert(stamp, origin, (sample[:3], sample[3:]), *validated)


def poses(x, turn=NO_TURN):
    return (float(x), 0.0, 0.0, *turn)


inserts = st.lists(
    st.tuples(
        st.integers(0, 60),
        st.sampled_from([0, 0, 0, 1, 2]),
        st.integers(0, 2),
        rotations,
    ),
    max_size=40,
)


@given(inserts, st.integers(0, 30), st.lists(st.integers(-2, 62), max_size=20))
def test_a_naive_model_agrees(steps, limit, questions):
    history, model = History(limit), Model(limit)
    for stamp, parent, x, turn in steps:
        pose = poses(x, turn)
        accepted = put(history, stamp, parent, pose, True) != TOO_OLD
        assert accepted is model.insert(stamp, parent, pose)
        assert history.items() == model.items
    assert len(history) == len(model.items)
    if model.items:
        assert (history.newest_stamp, history.oldest_stamp) == (
            model.items[0][0],
            model.items[-1][0],
        )
        assert history.mixed is (len({one[1] for one in model.items}) > 1)
    for time in [*questions, *(one[0] for one in model.items)]:
        found = model.find(time)
        if len(found) == 2:
            assert all(math.isnan(number) for number in history.at(time))
            assert history.parent_at(time) == -1
            assert history.refusal(time) == found
        else:
            stamp, parent, pose = found
            assert history.parent_at(time) == parent
            assert history.stamp_at(time) == stamp
            answer = history.at(time)
            assert answer[:3] == pytest.approx(pose[:3], abs=1e-9)
            assert quaternions.angle_between(answer[3:], pose[3:]) < 1e-7


@given(st.permutations(range(12)))
def test_distinct_stamps_may_arrive_in_any_order(order):
    in_order, shuffled = History(100), History(100)
    for stamp in range(12):
        put(in_order, stamp * 7, 0, poses(stamp))
    for stamp in order:
        put(shuffled, stamp * 7, 0, poses(stamp))

    assert shuffled.items() == in_order.items()
    assert [shuffled.at(time) for time in range(78)] == [in_order.at(time) for time in range(78)]


@pytest.mark.parametrize("jitter", [0, 1, 400])
def test_every_sample_of_a_long_history_is_found(jitter):
    history = History(10**12)
    stamps = [1 + 1000 * n + (n * 7919) % (jitter + 1) for n in range(5000)]
    for n, stamp in enumerate(stamps):
        put(history, stamp, 0, poses(n))

    for n, stamp in enumerate(stamps[:-1]):
        assert history.at(stamp) == poses(n)
        middle = (stamp + stamps[n + 1]) // 2
        share = (middle - stamp) / (stamps[n + 1] - stamp)
        assert history.at(middle)[0] == pytest.approx(n + share)


def test_a_rate_that_falls_misleads_no_search():
    history = History(10**9)
    for stamp in range(1, 101):
        put(history, stamp, 0, poses(stamp))
    assert history.at(50) == poses(50)
    for stamp in range(1000, 11_000, 1000):
        put(history, stamp, 0, poses(stamp))

    assert history.at(5500)[0] == pytest.approx(5500.0)
    assert history.at(60) == poses(60)


def test_stamps_with_gaps_of_every_size_are_found():
    history = History(10**18)
    stamps = [2**n for n in range(58)]
    for n, stamp in enumerate(stamps):
        put(history, stamp, 0, poses(n))

    assert [history.at(stamp)[0] for stamp in stamps] == list(range(58))
    assert history.at(2**40 + 1)[0] == pytest.approx(40.0)
    assert history.at(2**57 - 1)[0] == pytest.approx(57.0)


def test_the_window_slides_and_holds_no_more_than_it_must():
    history = History(100)
    for stamp in range(100_000):
        put(history, stamp, stamp % 1000 // 999, poses(stamp))

    assert len(history) == 102
    assert history.oldest_stamp == 100_000 - 102
    assert history.at(99_950) == poses(99_950)


def test_a_mix_of_parents_ends_when_the_old_one_is_forgotten():
    history = History(10)
    put(history, 1, 0, poses(1))
    assert put(history, 2, 1, poses(2)) == PARENT_CHANGED
    assert history.mixed
    assert put(history, 11, 1, poses(11)) == STORED
    assert history.mixed
    put(history, 12, 1, poses(12))
    put(history, 13, 1, poses(13))

    assert not history.mixed
    assert history.parent == 1
    assert history.parent_at(12) == 1


def test_a_late_sample_of_another_parent_makes_a_mix():
    history = History(100)
    for stamp in (10, 20, 30):
        put(history, stamp, 0, poses(stamp))

    assert put(history, 25, 1, poses(25)) == PARENT_CHANGED
    assert [history.parent_at(time) for time in (20, 25, 29, 30, 0)] == [0, 1, 1, 0, 0]


def test_samples_that_arrive_backwards_are_all_kept():
    history = History(10**6)
    for stamp in range(1000, 0, -1):
        put(history, stamp, stamp // 500, poses(stamp))

    assert [one[0] for one in history.items()] == list(range(1000, 0, -1))
    assert [one[1] for one in history.items()] == [stamp // 500 for stamp in range(1000, 0, -1)]
    assert history.at(333) == poses(333)


def test_the_same_sample_twice_is_one():
    history = History(100)
    assert put(history, 5, 0, poses(1)) == PARENT_CHANGED
    assert put(history, 5, 0, poses(1)) == KNOWN
    assert put(history, 5, 0, poses(2)) == STORED
    assert len(history) == 2


def test_a_stamp_beyond_64_bits_changes_nothing():
    history = History(100)
    put(history, 5, 0, poses(1))
    with pytest.raises(struct.error):
        put(history, 2**63, 0, poses(2))

    assert history.items() == [(5, 0, poses(1))]
    assert history.at(0) == poses(1)


@given(rotations, st.sampled_from([1.0, -1.0, 1.0 + 1e-9, 0.5, 3e200, 2e-100]))
def test_a_sample_just_as_it_came_is_kept_scaled_and_with_tf2s_sign(turn, scale):
    history = History(100)
    came = tuple(scale * number for number in turn)

    assert put(history, 1, 0, (1.0, 2.0, 3.0, *came)) == PARENT_CHANGED

    assert history.at(1)[:3] == (1.0, 2.0, 3.0)
    assert history.at(1)[3:] == quaternions.canonical(quaternions.unit(came))


@pytest.mark.parametrize(
    "sample",
    [
        (math.nan, 0.0, 0.0, *NO_TURN),
        (0.0, -math.inf, math.inf, 0.0, 0.0, 0.0, 0.0),
        poses(1, (0.0, 0.0, 0.0, 0.0)),
        poses(1, (0.0, math.nan, 0.0, 1.0)),
        poses(1, (0.0, math.inf, 0.0, 1.0)),
    ],
)
def test_a_sample_with_a_number_that_is_none_needs_a_check(sample):
    history = History(100)

    assert put(history, 1, 0, sample) == NEEDS_CHECK
    assert history.items() == []


def test_a_static_link_answers_at_all_times():
    link = StaticLink()
    assert link.items() == []
    assert put(link, 7, 3, poses(1)) == PARENT_CHANGED
    assert put(link, 9, 3, poses(1)) == KNOWN

    assert link.at(10**18) == poses(1)
    assert link.parent_at(-5) == 3
    assert link.items() == [(0, 3, poses(1))]
    assert len(link) == 1
    assert link.is_static


def test_infinite_places_are_remembered_as_they_are():
    history = History(100)
    put(history, 1, 0, (math.inf, 0.0, 0.0, *NO_TURN))

    assert history.at(1)[0] == math.inf
    assert Vector3(*history.at(0)[:3]).x == math.inf


def test_samples_decades_apart_are_interpolated_at_the_first_question():
    history = History(2**63 - 1)
    for stamp, x in ((1, 0.0), (10**18, 1.0), (3 * 10**18, 5.0)):
        put(history, stamp, 1, (x, 0.0, 0.0, *NO_TURN))

    assert history.at(2 * 10**18)[0] == 3.0
    assert history.at(5 * 10**17)[0] == pytest.approx(0.5)


def test_a_sample_is_looked_for_among_the_last_of_its_stamp_alone():
    poses = [(float(x), 0.0, 0.0, *NO_TURN) for x in range(MOST_ALIKE + 1)]
    history = History(10)
    for pose in poses:
        put(history, 5, 0, pose, True)

    assert put(history, 5, 0, poses[1], True) == KNOWN
    assert put(history, 5, 0, poses[0], True) == STORED
    assert put(history, 5, 0, poses[0], True) == KNOWN
    assert len(history) == MOST_ALIKE + 2
