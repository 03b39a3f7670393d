"""Tests that each row of a batch lookup is equal to a single lookup."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.buffer.test_buffer_laws import FRAMES, names, worlds
from tests.buffer.test_buffer_laws import build as build_forest
from tests.strategies import transforms, vectors
from tftool.base.errors import (
    ConnectivityException,
    ForwardExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from tftool.base.stamps import seconds
from tftool.buffer.batch import chain_arithmetic as kernel
from tftool.buffer.batch import lookup
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry import quaternions
from tftool.geometry.rigid import Quaternion, Transform

times_lists = st.lists(st.integers(0, 22), max_size=12)

# Any frame may be a parent, so that loops occur too.
tangled = st.lists(
    st.builds(
        lambda stamp, pair, pose, static: (
            TransformStamped(stamp, FRAMES[pair[0]], FRAMES[pair[1]], pose),
            static,
        ),
        st.integers(0, 20),
        st.tuples(st.integers(0, 3), st.integers(0, 3)).filter(lambda pair: pair[0] != pair[1]),
        transforms,
        st.sampled_from([False, False, False, True]),
    ),
    min_size=1,
    max_size=30,
)


# Numbers go up to 100 and chains up to three edges, so intermediate differences may be this large.
SIZE = 300.0


def or_refusal(ask, *question):
    try:
        return ask(*question)
    except TransformException as refused:
        return refused


def one_by_one(ask, times):
    return [or_refusal(ask, time) for time in times]


def assert_same(found, rows):
    """Assert that each row of a batch has the result or the error of the single lookup."""
    assert len(found) == len(rows)
    assert found.valid.tolist() == [not isinstance(row, Exception) for row in rows]
    for row, wanted in enumerate(rows):
        if isinstance(wanted, Exception):
            assert np.isnan(found.translations[row]).all()
            assert np.isnan(found.rotations[row]).all()
            continue
        assert int(found.stamps[row]) == wanted.stamp
        np.testing.assert_allclose(
            found.translations[row], wanted.transform.translation, rtol=0, atol=1e-12 * SIZE
        )
        x, y, z, w = wanted.transform.rotation
        same = np.array([x, y, z, w])
        if not on_an_edge_of_signs(wanted.transform.rotation):
            np.testing.assert_allclose(found.rotations[row], same, rtol=0, atol=1e-12)
        else:
            np.testing.assert_allclose(np.abs(found.rotations[row] @ same), 1.0, atol=1e-12)


def on_an_edge_of_signs(rotation):
    """Return whether only the last bit decides which of a quaternion's two signs is returned."""
    x, y, z, w = rotation
    first, second = sorted((abs(x), abs(y), abs(z)))[:0:-1]
    return abs(w * w - 0.25) < 1e-9 or (w * w < 0.2501 and first - second < 1e-9)


def hold_against_single(buffer, target, source, times):
    rows = one_by_one(lambda time: buffer.lookup_transform(target, source, time), times)
    refused = next((row for row in rows if isinstance(row, Exception)), None)
    if refused is not None and not times:
        return
    found = or_refusal(
        lambda: buffer.lookup_transforms(target, source, times, missing="nan"),
    )
    if isinstance(found, LookupException):
        # An unknown name is refused, whatever `missing` allows.
        assert [str(row) for row in rows] == [str(found)] * len(rows)
        return
    assert_same(found, rows)
    if refused is None:
        assert_same(buffer.lookup_transforms(target, source, times), rows)
        return
    with pytest.raises(type(refused)) as told:
        buffer.lookup_transforms(target, source, times)
    assert str(told.value) == str(refused)


@given(worlds, names, names, times_lists)
def test_each_row_is_the_single_lookup(world, target, source, times):
    hold_against_single(build_forest(world), target, source, times)


@given(tangled, names, names, times_lists)
def test_it_is_so_where_chains_run_in_loops_too(world, target, source, times):
    hold_against_single(build_forest(world), target, source, times)


@given(tangled, names, names, names, times_lists, st.integers(0, 22))
def test_each_row_of_time_travel_is_the_single_one(world, target, source, fixed, times, now):
    buffer = build_forest(world)
    rows = one_by_one(
        lambda time: buffer.lookup_transform_full(target, now, source, time, fixed), times
    )
    refused = next((row for row in rows if isinstance(row, Exception)), None)

    found = or_refusal(
        lambda: buffer.lookup_transforms_full(target, now, source, times, fixed, missing="nan")
    )
    if isinstance(found, LookupException):
        assert [str(row) for row in rows] == [str(found)] * len(rows)
        return
    assert_same(found, rows)
    if refused is not None:
        with pytest.raises(type(refused)) as told:
            buffer.lookup_transforms_full(target, now, source, times, fixed)
        assert str(told.value) == str(refused)


def chain(depth, samples=200, *, seed=1, step=10_000_000, turn=0.05):
    """Return a buffer with f0 ← f1 ← … of turning edges, and its first and last stamp."""
    random = np.random.default_rng(seed)
    buffer = Buffer(seconds(1000))
    for link in range(depth):
        axis = random.normal(size=3)
        axis /= np.linalg.norm(axis)
        for k in range(samples):
            half = turn * k / 2 + link
            buffer.set_transform(
                TransformStamped(
                    1_000_000_000 + k * step + link * 1000,
                    f"f{link}",
                    f"f{link + 1}",
                    Transform(random.normal(size=3), (*(axis * np.sin(half)), float(np.cos(half)))),
                )
            )
    return buffer, 1_000_000_000 + depth * 1000, 1_000_000_000 + (samples - 1) * step


@pytest.mark.parametrize("turn", [1e-9, 1e-3, 0.1, 0.6, 1.5, 3.1])
@pytest.mark.parametrize("samples", [2, 200])
def test_turns_of_any_size_between_two_samples_agree(turn, samples):
    buffer, first, last = chain(3, samples, turn=turn)
    times = np.random.default_rng(2).integers(first, last, 500, endpoint=True)

    rows = one_by_one(lambda time: buffer.lookup_transform("f0", "f3", time), times.tolist())

    assert_same(buffer.lookup_transforms("f0", "f3", times), rows)
    assert_same(
        buffer.lookup_transforms("f0", "f3", np.sort(times)).inverse().inverse(),
        sorted(rows, key=lambda row: row.stamp),
    )


@pytest.mark.parametrize("most", [1 << 16, 100])
def test_a_long_batch_is_split_and_comes_out_in_order(monkeypatch, most):
    # For histories longer than this limit, moments are sorted first, one section at a time.
    monkeypatch.setattr(kernel, "MOST_INTERVALS", most)
    monkeypatch.setattr(lookup, "SECTION", 1 << 16)
    buffer, first, last = chain(2, 300)
    times = np.random.default_rng(3).integers(first, last, 200_001)

    found = buffer.lookup_transforms("f2", "f0", times, threads=3)

    again = buffer.lookup_transforms("f2", "f0", times, threads=1)
    assert np.array_equal(found.stamps, times)
    assert np.array_equal(found.translations, again.translations)
    for row in range(0, 200_001, 20_000):
        assert_same(found[row : row + 1], [buffer.lookup_transform("f2", "f0", int(times[row]))])


def test_the_first_refused_row_of_a_long_batch_says_why():
    buffer, first, last = chain(1)
    times = np.full(300_000, first)
    times[150_000], times[250_000] = last + 5, last + 7

    with pytest.raises(ForwardExtrapolationException) as refused:
        buffer.lookup_transforms("f0", "f1", times, threads=2)

    assert refused.value.requested == last + 5


@pytest.fixture
def buffer():
    buffer = Buffer(seconds(100))
    for second in range(1, 11):
        pose = Transform((float(second), 0.0, 0.0))
        buffer.set_transform(TransformStamped(seconds(second), "world", "turtle1", pose))
    return buffer


@pytest.mark.parametrize(
    "times",
    [
        [seconds(2), seconds(3)],
        np.array([seconds(2), seconds(3)], dtype=np.uint64),
        np.array([seconds(2), seconds(3)], dtype=">i8"),
        np.array([seconds(2), seconds(3)], dtype=object),
        np.array([seconds(2), 1, seconds(3), 1])[::2],
    ],
)
def test_whole_numbers_of_any_kind_are_moments(buffer, times):
    found = buffer.lookup_transforms("world", "turtle1", times)

    assert found.translations[:, 0].tolist() == [2.0, 3.0]


def test_moments_of_32_bits_are_taken(buffer):
    found = buffer.lookup_transforms("world", "turtle1", np.array([1_500_000_000], dtype=np.int32))

    assert found.translations[0].tolist() == [1.5, 0.0, 0.0]


def test_a_read_only_array_of_times_is_accepted(buffer):
    times = np.array([seconds(2), seconds(3)])
    times.flags.writeable = False

    assert buffer.lookup_transforms("world", "turtle1", times).valid.all()


@pytest.mark.parametrize(
    ("times", "kind", "told"),
    [
        ([1.5, 2.5], TypeError, r"np.rint\(times \* 1e9\).astype\(np.int64\)"),
        ([True], TypeError, "not bool"),
        (["now"], TypeError, "whole nanoseconds"),
        (np.array(["2026-01-01"], dtype="M8[s]"), TypeError, r"datetime64\[ns\]"),
        (np.array([1.5], dtype=object), TypeError, r"seconds\(2.5\)"),
        (3, ValueError, r"have the shape \(n,\), not \(\): write a single time as a list, \[3\]"),
        ([[1, 2]], ValueError, r"have the shape \(n,\), not \(1, 2\)"),
        (np.array([2**63], dtype=np.uint64), ValueError, "does not fit 64 bits"),
        (np.array([-(2**70)], dtype=object), ValueError, "does not fit 64 bits"),
    ],
)
def test_invalid_times_are_refused_with_the_remedy(buffer, times, kind, told):
    with pytest.raises(kind, match=told):
        buffer.lookup_transforms("world", "turtle1", times)


def test_no_moments_give_no_rows(buffer):
    found = buffer.lookup_transforms("world", "turtle1", [])

    assert found.translations.shape == (0, 3)
    assert found.rotations.shape == (0, 4)


@pytest.mark.parametrize(
    ("target", "kind"), [("nobody", LookupException), ("/world", InvalidArgumentException)]
)
def test_a_wrong_name_raises_even_where_missing_data_does_not(buffer, target, kind):
    with pytest.raises(kind, match=target):
        buffer.lookup_transforms(target, "turtle1", [seconds(2)], missing="nan")


def test_frames_of_two_trees_are_refused_or_nan(buffer):
    buffer.set_transform_static(TransformStamped(0, "map", "odom", Transform()))

    with pytest.raises(ConnectivityException):
        buffer.lookup_transforms("map", "turtle1", [seconds(2)])
    assert not buffer.lookup_transforms(
        "map", "turtle1", [0, seconds(2)], missing="nan"
    ).valid.any()


@pytest.mark.parametrize(
    ("options", "told"),
    [({"missing": "none"}, "'raise' or 'nan'"), ({"threads": 0}, "must be 1 or more")],
)
def test_an_option_out_of_range_is_refused(buffer, options, told):
    with pytest.raises(ValueError, match=told):
        buffer.lookup_transforms("world", "turtle1", [], **options)
    if "missing" in options:
        with pytest.raises(ValueError, match=told):
            buffer.lookup_transforms_full("world", [], "turtle1", [], "world", **options)


def test_time_travel_takes_one_moment_for_all(buffer):
    times = [seconds(2), seconds(3)]

    theirs = buffer.lookup_transforms_full("turtle1", seconds(5), "turtle1", times, "world")
    ours = buffer.lookup_transforms_full("turtle1", times, "turtle1", seconds(5), "world")

    assert theirs.translations[:, 0].tolist() == [-3.0, -2.0]
    assert ours.translations[:, 0].tolist() == [3.0, 2.0]
    assert ours.stamps.tolist() == times


def test_time_travel_with_unequal_numbers_of_moments_is_refused(buffer):
    with pytest.raises(ValueError, match="2 target_times, but 3 source_times"):
        buffer.lookup_transforms_full("world", [1, 2], "turtle1", [1, 2, 3], "world")


def test_a_name_in_time_travel_is_checked_first(buffer):
    with pytest.raises(LookupException, match="fixed_frame"):
        buffer.lookup_transforms_full("world", [], "turtle1", [], "nobody")


@given(vectors, transforms)
def test_points_move_as_by_each_transform(point, pose):
    buffer = Buffer()
    buffer.set_transform(TransformStamped(5, "a", "b", pose))
    found = buffer.lookup_transforms("a", "b", [5, 0])

    moved = found.apply(point)

    wanted = buffer.lookup_transform("a", "b").transform.apply(point)
    np.testing.assert_allclose(moved, [wanted, wanted], rtol=0, atol=1e-12 * SIZE)
    assert quaternions.angle_between(found[0].transform.rotation, Quaternion(*pose.rotation)) < 1e-7
