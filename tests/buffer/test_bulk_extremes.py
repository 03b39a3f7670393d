"""Tests of batches with unusual sizes, spacing or infinities, and beside other threads."""

import os
import threading
import tracemalloc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from tests.buffer.test_bulk import assert_same, one_by_one
from tftool.base.stamps import seconds
from tftool.buffer.batch import chain_arithmetic as kernel
from tftool.buffer.batch import lookup
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform


def turning(buffer, stamps, parent="world", child="turtle1"):
    count = len(stamps)
    half = np.linspace(0.0, 3.0, count)
    translations = np.random.default_rng(5).normal(size=(count, 3))
    rotations = np.stack((0.6 * np.sin(half), 0 * half, 0.8 * np.sin(half), np.cos(half)), axis=1)
    assert buffer.set_transforms(parent, child, stamps, translations, rotations)
    return buffer


def assert_agrees(buffer, times):
    rows = one_by_one(
        lambda time: buffer.lookup_transform("world", "turtle1", time), times.tolist()
    )
    assert_same(buffer.lookup_transforms("world", "turtle1", times, missing="nan"), rows)


@pytest.mark.parametrize("in_order", [True, False])
@pytest.mark.parametrize("most", [1 << 16, 10])
def test_histories_shorter_and_longer_than_the_batch_agree(monkeypatch, in_order, most):
    # Above this number of samples, the intervals are computed in blocks.
    monkeypatch.setattr(kernel, "MOST_INTERVALS", most)
    random = np.random.default_rng(6)
    for count, asked in ((2000, 300), (300, 2000), (5, 2000)):
        stamps = np.cumsum(random.integers(1, 1_000_000, count))
        buffer = turning(Buffer(seconds(1000)), stamps)
        times = random.integers(stamps[0], stamps[-1], asked, endpoint=True)
        times[:4] = stamps[[0, 1, -2, -1]]
        assert_agrees(buffer, np.sort(times) if in_order else times)


def test_samples_that_come_in_bursts_agree():
    random = np.random.default_rng(8)
    stamps = np.unique((random.integers(1, 50, 400) * seconds(1)) + random.integers(0, 40, 400))
    buffer = turning(Buffer(seconds(1000)), stamps)

    assert_agrees(buffer, random.integers(stamps[0], stamps[-1], 1000))
    assert_agrees(buffer, random.permutation(stamps))


def test_stamps_a_nanosecond_apart_and_centuries_apart_agree():
    stamps = np.array([1, 2, 3, 2**40, 2**62 - 1, 2**62])
    buffer = turning(Buffer(2**62), stamps)

    assert_agrees(buffer, np.array([1, 2, 3, 4, 2**39, 2**61, 2**62 - 1, 2**62, 2**62 + 1, 2]))


@pytest.mark.parametrize("seconds_of", [(1, 1, 2), (1, 2, 2), (1, 1, 2, 2), (1, 1), (1, 1, 1, 3)])
def test_of_equal_stamps_that_sample_answers_which_answers_a_single_lookup(seconds_of):
    buffer = Buffer()
    for x, second in enumerate(seconds_of):
        pose = Transform((float(x), 0.0, 0.0))
        buffer.set_transform(TransformStamped(seconds(second), "world", "turtle1", pose))

    assert_agrees(buffer, np.array([2, 3, 4, 6, 2, 1]) * 500_000_000)


def test_nought_is_the_latest_even_where_the_data_reaches_back_before_it():
    buffer = turning(Buffer(seconds(1000)), np.array([-1000, -10, 1000]))

    for asked in ([-500, 0, 500], [500, 0, -500], [0], [-500, 500]):
        assert_agrees(buffer, np.array(asked))


def test_a_sample_at_infinity_is_met_but_not_on_the_way():
    buffer = Buffer()
    for second, x in ((1, 0.0), (2, np.inf), (3, 5.0), (4, 6.0)):
        pose = Transform((x, 0.0, 0.0))
        buffer.set_transform(TransformStamped(seconds(second), "world", "turtle1", pose))

    found = buffer.lookup_transforms("world", "turtle1", np.arange(2, 9) * seconds(0.5))

    x = found.translations[:, 0].tolist()
    assert [x[0], x[2], x[4], x[5], x[6]] == [0.0, np.inf, 5.0, 5.5, 6.0]
    assert not np.isfinite([x[1], x[3]]).any()


@pytest.mark.parametrize(
    ("samples", "missing", "threads"),
    [(2000, "raise", 2), (2000, "nan", 6), (70_000, "nan", 2)],
)
def test_more_moments_take_no_more_memory_than_their_answers(samples, missing, threads):
    step = 10_000_000
    buffer = turning(Buffer(seconds(1000)), np.arange(1, samples + 1) * step)
    times = np.random.default_rng(9).integers(step, samples * step, 3_000_000)
    if missing == "nan":
        times[::1000] = (samples + 1) * step
    buffer.lookup_transforms("world", "turtle1", times[1:10])

    tracemalloc.start()
    try:
        found = buffer.lookup_transforms(
            "world", "turtle1", times, missing=missing, threads=threads
        )
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    answers = sum(
        part.nbytes for part in (found.translations, found.rotations, found.stamps, found.valid)
    )
    assert most < answers + 64 * 2**20
    assert np.count_nonzero(~found.valid) == (3000 if missing == "nan" else 0)


def test_so_it_is_with_time_travel():
    buffer = turning(Buffer(seconds(1000)), np.arange(1, 2001) * 10_000_000)
    times = np.random.default_rng(9).integers(seconds(1), seconds(15), 1_000_000)
    thens = times[::-1].copy()
    question = ("turtle1", times, "turtle1", thens, "world")

    tracemalloc.start()
    try:
        found = buffer.lookup_transforms_full(*question, threads=2)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    answers = sum(
        part.nbytes for part in (found.translations, found.rotations, found.stamps, found.valid)
    )
    assert most < answers + 64 * 2**20
    for row in (0, 65_535, 65_536, 999_999):
        now, then = int(times[row]), int(thens[row])
        single = buffer.lookup_transform_full("turtle1", now, "turtle1", then, "world")
        assert_same(found[row : row + 1], [single])


def test_links_that_turn_little_and_much_and_not_at_all_are_chained_together():
    # The batch is larger than one block, with constant poses at the ends of the block.
    buffer = Buffer(seconds(1000))
    turns = (0.0, 1e-12, 1e-3, 0.4, 3.0, 1.2, None, None, 0.3, 2.9, 0.0, None, 0.02, 0.7)
    for number, turn in enumerate(turns):
        link = f"f{number}", f"f{number + 1}"
        places = np.random.default_rng(number).normal(size=(20, 3))
        half = np.arange(20) * (turn or 0.0) / 2 + number
        rotations = np.stack((0 * half, 0.6 * np.sin(half), 0.8 * np.sin(half), np.cos(half)), 1)
        if turn is None:
            pose = Transform(places[0], rotations[0])
            buffer.set_transform_static(TransformStamped(0, *link, pose))
        else:
            assert buffer.set_transforms(*link, np.arange(1, 21) * 1000, places, rotations)
    times = np.random.default_rng(3).integers(1000, 20_000, 300, endpoint=True)

    for target, source in (("f0", "f14"), ("f14", "f0"), ("f6", "f12"), ("f3", "f1")):
        for asked in (times, np.sort(times)):
            rows = one_by_one(
                lambda time, pair=(target, source): buffer.lookup_transform(*pair, time),
                asked.tolist(),
            )
            assert_same(buffer.lookup_transforms(target, source, asked), rows)


@pytest.mark.parametrize(("allowed", "threads"), [({3}, []), ({0, 1, 5}, [3])])
def test_as_many_threads_run_as_there_are_cores_we_may_use(monkeypatch, allowed, threads):
    buffer = turning(Buffer(seconds(1000)), np.array([1, 1000]))
    pools = []

    class Pool(ThreadPoolExecutor):
        def __init__(self, workers):
            pools.append(workers)
            super().__init__(workers)

    monkeypatch.setattr(os, "sched_getaffinity", lambda _: allowed, raising=False)
    monkeypatch.setattr(lookup, "ThreadPoolExecutor", Pool)
    found = buffer.lookup_transforms("world", "turtle1", np.arange(200_000) % 1000 + 1)

    assert found.valid.all()
    assert pools == threads


def test_a_history_may_grow_and_forget_while_a_batch_runs():
    step = 1_000_000
    count = 20_000
    buffer = turning(Buffer(count * step), np.arange(1, count + 1) * step)
    stop, troubles, checked = threading.Event(), [], 0

    def publish():
        stamp = (count + 1) * step
        try:
            while not stop.is_set():
                pose = Transform((float(stamp), 0.0, 0.0))
                buffer.set_transform(TransformStamped(stamp, "world", "turtle1", pose))
                stamp += step
        except Exception as trouble:
            troubles.append(trouble)

    publisher = threading.Thread(target=publish)
    publisher.start()
    try:
        for _ in range(8):
            newest = buffer.get_latest_common_time("world", "turtle1")
            times = np.linspace(newest - count * step, newest, 50_000).astype(np.int64)
            found = buffer.lookup_transforms("world", "turtle1", times, missing="nan", threads=2)
            moved = found[found.valid & (found.stamps > (count + 1) * step)]
            checked += len(moved)
            np.testing.assert_allclose(moved.translations[:, 0], moved.stamps, rtol=1e-12)
    finally:
        stop.set()
        publisher.join()
    assert troubles == []
    assert checked > 0


def test_a_question_may_wait_for_statics_alone():
    buffer = Buffer()
    for parent, child in (("a", "b"), ("b", "c"), ("a", "d")):
        pose = Transform((1.0, 2.0, 3.0), (0.6, 0.0, 0.0, 0.8))
        buffer.set_transform_static(TransformStamped(0, parent, child, pose))

    for target, source in (("a", "c"), ("c", "a"), ("d", "c"), ("c", "d")):
        found = buffer.lookup_transforms(target, source, [0, 7, -7])
        wanted = buffer.lookup_transform(target, source)
        assert found.stamps.tolist() == [0, 7, -7]
        np.testing.assert_allclose(
            found.translations, [wanted.transform.translation] * 3, atol=1e-12
        )
        np.testing.assert_allclose(found.rotations, [wanted.transform.rotation] * 3, atol=1e-12)
