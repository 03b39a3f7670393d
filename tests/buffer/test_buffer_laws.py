"""Laws that hold in every world; hypothesis builds the worlds."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import transforms
from tftool.base.errors import TransformException
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry import quaternions
from tftool.geometry.rigid import IDENTITY

FRAMES = [f"f{n}" for n in range(6)]

samples = st.builds(
    lambda stamp, parent, up, pose, static: (
        TransformStamped(stamp, FRAMES[parent], FRAMES[parent + up], pose),
        static,
    ),
    st.integers(1, 20),
    st.integers(0, 3),
    st.integers(1, 2),
    transforms,
    st.sampled_from([False, False, False, True]),
)
"""Random transforms; a child's number is above its parent's, so that frames form no loop."""

worlds = st.lists(samples, min_size=1, max_size=40)
moments = st.integers(0, 21)
names = st.sampled_from(FRAMES)


def build(world):
    buffer = Buffer(15, log=lambda level, text: None)
    for sample, static in world:
        (buffer.set_transform_static if static else buffer.set_transform)(sample, "law")
    return buffer


def same(found, wanted):
    scale = 1.0 + max(abs(number) for number in wanted.translation)
    return found.translation == pytest.approx(wanted.translation, abs=1e-9 * scale) and (
        quaternions.angle_between(found.rotation, wanted.rotation) < 1e-7
    )


def answer(buffer, target, source, time):
    try:
        return buffer.lookup_transform(target, source, time)
    except TransformException:
        return None


def chain_to_root(snapshot, name):
    """Return the edges from a frame up to its root, by their newest samples."""
    links = []
    while (info := snapshot.frame(name)).parent is not None:
        links.append(info)
        name = info.parent
    return links


@given(worlds, names, names, moments)
def test_a_lookup_and_its_opposite_undo_each_other(world, a, b, time):
    buffer = build(world)
    a_from_b, b_from_a = answer(buffer, a, b, time), answer(buffer, b, a, time)

    assert (a_from_b is None) is (b_from_a is None)
    if a_from_b is not None:
        assert a_from_b.stamp == b_from_a.stamp
        assert same(a_from_b.transform @ b_from_a.transform, IDENTITY)


@given(worlds, names, names, names, moments)
def test_lookups_chain(world, a, b, c, time):
    buffer = build(world)
    # A fixed time is needed, because "latest" is a different time for each pair.
    a_from_b, b_from_c, a_from_c = (
        answer(buffer, *pair, time + 1) for pair in ((a, b), (b, c), (a, c))
    )

    if a_from_b is not None and b_from_c is not None and a_from_c is not None:
        assert same(a_from_b.transform @ b_from_c.transform, a_from_c.transform)


@given(worlds, names, names, moments)
def test_can_transform_says_what_lookup_does(world, a, b, time):
    buffer = build(world)

    told = buffer.why_not(a, b, time)

    assert buffer.can_transform(a, b, time) is (told == "")
    found = answer(buffer, a, b, time)
    assert (found is not None) is (told == "")
    # The second call may use the plan that the first lookup stored.
    assert buffer.can_transform(a, b, time) is (told == "")
    assert answer(buffer, a, b, time) == found


@given(worlds, names, names)
def test_the_latest_common_time_can_be_answered_unless_a_link_is_younger(world, a, b):
    buffer = build(world)
    try:
        latest = buffer.get_latest_common_time(a, b)
    except TransformException:
        assert a == b or not buffer.can_transform(a, b)
        return

    found = answer(buffer, a, b, latest)
    if found is None:
        # An edge may begin after another one ended, or may have had another parent at that time.
        snapshot = buffer.snapshot(0)
        assert any(
            not info.is_static
            and (info.oldest > latest or buffer.parent(info.frame, latest) != info.parent)
            for end in (a, b)
            for info in chain_to_root(snapshot, end)
        )
    else:
        assert answer(buffer, a, b, 0) == found


@given(worlds, st.integers(0, 21))
def test_a_snapshot_shows_what_lookups_give(world, at):
    buffer = build(world)

    snapshot = buffer.snapshot(now=100, at=at)

    assert [info.frame for info in snapshot.frames] == buffer.frames()
    for info in snapshot.frames:
        assert info.root is not None
        if info.root_from_frame is None:
            assert not buffer.can_transform(info.root, info.frame, at)
        else:
            found = buffer.lookup_transform(info.root, info.frame, at)
            assert same(info.root_from_frame, found.transform)
        if info.parent is not None and info.transform is not None:
            found = buffer.lookup_transform(info.parent, info.frame, at)
            assert same(info.transform, found.transform)


@given(worlds, names, names, moments)
def test_a_plan_answers_as_the_walk_does(world, a, b, time):
    buffer, fresh = build(world), build(world)
    for moment in range(22):
        answer(buffer, a, b, moment)

    assert answer(buffer, a, b, time) == answer(fresh, a, b, time)


@given(worlds, worlds, names, names, moments)
def test_nothing_asked_before_changes_what_is_answered_after(first, second, a, b, time):
    asked, silent = build(first), build(first)
    for one in FRAMES:
        for other in FRAMES:
            answer(asked, one, other, 0)
            answer(asked, one, other, time)
    for buffer in (asked, silent):
        for sample, static in second:
            (buffer.set_transform_static if static else buffer.set_transform)(sample, "law")

    assert answer(asked, a, b, time) == answer(silent, a, b, time)
    assert asked.all_frames_as_yaml() == silent.all_frames_as_yaml()


@given(
    st.lists(st.tuples(st.integers(1, 9), transforms), min_size=2, unique_by=lambda one: one[0]),
    st.randoms(),
    moments,
)
def test_distinct_stamps_may_arrive_in_any_order(samples, random, time):
    in_order, shuffled = Buffer(), Buffer()
    for buffer, order in (
        (in_order, sorted(samples, key=lambda one: one[0])),
        (shuffled, random.sample(samples, len(samples))),
    ):
        for stamp, pose in order:
            assert buffer.set_transform(TransformStamped(stamp, "a", "b", pose), "law")

    assert answer(in_order, "a", "b", time) == answer(shuffled, "a", "b", time)


@given(transforms, transforms)
def test_equal_places_are_apart_by_exactly_nothing(one, other):
    buffer = Buffer()
    other = other._replace(translation=one.translation)
    buffer.set_transform(TransformStamped(seconds(1), "world", "turtle1", one), "law")
    buffer.set_transform(TransformStamped(seconds(1), "world", "turtle2", other), "law")

    assert buffer.lookup_transform("turtle2", "turtle1").transform.translation == (0.0, 0.0, 0.0)


@given(transforms)
def test_a_stored_transform_comes_back_up_to_the_sign_of_its_quaternion(pose):
    buffer = Buffer()
    buffer.set_transform(TransformStamped(5, "a", "b", pose), "law")

    found = buffer.lookup_transform("a", "b").transform

    assert found.translation == pose.translation
    assert found.rotation in (pose.rotation, tuple(-part for part in pose.rotation))
