"""Tests of histories so long that the first lookup moves them into large pages of memory."""

import gc
import sys
import threading
import tracemalloc
import weakref

import numpy as np
import pytest

from tests.twins import REASON, Twins, is_native
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer, lend
from tftool.buffer.history import RECORD, WORDS, History
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

MANY = 70_000
PERIOD = 10**7
NEWEST = MANY * PERIOD


def pose(number):
    return Transform((number * 0.001, number % 7 * 0.1, 0.0), (0.0, 0.0, 0.6, 0.8))


def sample(stamp, number):
    return TransformStamped(stamp, "a", "b", pose(number))


def filled(buffer, count=MANY):
    """Insert a sample for every ten milliseconds, one by one; return the buffer."""
    for number in range(1, count + 1):
        buffer.set_transform(sample(number * PERIOD, number), "me")
    return buffer


@pytest.mark.skipif(not is_native(), reason=REASON)
@pytest.mark.parametrize(
    "stamps",
    [
        pytest.param(range(NEWEST + 1, NEWEST + 20_000, 1), id="behind all others"),
        pytest.param(range(NEWEST - 5, NEWEST - 1005, -7), id="late"),
        pytest.param(range(PERIOD - 1, PERIOD - 1001, -1), id="before all others"),
        pytest.param([NEWEST + 10 * PERIOD, NEWEST, PERIOD, NEWEST + 1], id="here and there"),
        pytest.param([NEWEST + 200 * PERIOD, NEWEST + NEWEST // 2, NEWEST], id="pruning"),
    ],
)
def test_samples_inserted_after_the_first_lookup_are_found(stamps):
    twins = Twins(NEWEST + 100 * PERIOD)
    for buffer in twins.pair:
        filled(buffer)
    moments = np.linspace(PERIOD, NEWEST, 1000).astype(np.int64)
    before = twins.ask("lookup_transforms", "a", "b", moments)

    for number, stamp in enumerate(stamps):
        for buffer in twins.pair:
            buffer.set_transform(sample(stamp, number), "me")

    assert before[0].translations.tolist() == before[1].translations.tolist()
    ours, plain = twins.ask("samples", "b")
    assert ours.stamps.tolist() == plain.stamps.tolist()
    assert ours.poses.tolist() == plain.poses.tolist()
    for moment in (*stamps[::97], 0, NEWEST // 2 + 3, NEWEST + 1):
        ours, plain = twins.ask("lookup_transform", "b", "a", moment)
        assert repr(ours) == repr(plain)


def test_samples_handed_out_earlier_do_not_change_with_later_inserts():
    buffer = filled(Buffer(10**18))
    buffer.lookup_transform("a", "b", NEWEST // 2)
    other = Buffer(10**18)
    assert lend(buffer, "b", other, NEWEST)
    held = buffer.samples("b")
    x = held.poses[:, 0].copy()

    for number in range(1, 500):
        buffer.set_transform(sample(number * PERIOD + 1, -number), "me")

    assert len(buffer.samples("b").stamps) == MANY + 499
    assert len(other.samples("b").stamps) == MANY
    assert np.array_equal(held.poses[:, 0], x)


def test_the_memory_of_a_dropped_buffer_does_not_wait_for_the_collector():
    buffer = filled(Buffer(10**18))
    buffer.lookup_transform("a", "b", NEWEST // 2)
    dropped = weakref.ref(buffer)

    gc.disable()
    try:
        del buffer
        assert dropped() is None
    finally:
        gc.enable()


def test_no_sample_is_lost_where_one_thread_asks_and_another_inserts():
    buffer, links, more = Buffer(10**18), 12, 60
    stamps = np.arange(1, MANY + 1) * PERIOD
    for link in range(links):
        turns = np.tile([0.0, 0.0, 0.0, 1.0], (MANY, 1))
        buffer.set_transforms("a", f"b{link}", stamps, np.zeros((MANY, 3)), turns)
    asking = threading.Event()

    def insert():
        asking.wait()
        for number in range(1, more + 1):
            # Insert behind all samples, and between samples: in the kernel and in plain Python.
            for stamp in (NEWEST + number * PERIOD, number * PERIOD + 1):
                for link in range(links):
                    buffer.set_transform(
                        TransformStamped(stamp, "a", f"b{link}", Transform()), f"{number % 2}"
                    )

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    inserting = threading.Thread(target=insert)
    try:
        inserting.start()
        asking.set()
        for link in range(links):
            buffer.lookup_transform("a", f"b{link}", NEWEST // 2)
        inserting.join()
    finally:
        sys.setswitchinterval(interval)

    for link in range(links):
        found = buffer.samples(f"b{link}").stamps
        assert len(found) == MANY + 2 * more
        assert (np.diff(found) > 0).all()


def test_a_history_that_doubles_is_asked_as_well():
    buffer = filled(Buffer(10**18))
    for count in (MANY, 2 * MANY, 4 * MANY):
        for number in range(len(buffer.samples("b").stamps) + 1, count + 1):
            buffer.set_transform(sample(number * PERIOD, number), "me")
        buffer.set_transform_static(TransformStamped(0, "b", f"c{count}", Transform()))
        found = buffer.lookup_transform("a", f"c{count}", count * PERIOD - PERIOD // 2)
        assert found.transform.translation[0] == pytest.approx((count - 0.5) * 0.001)
    assert buffer.can_transform("a", "b", seconds(1))


@pytest.mark.parametrize("which", range(1, 16))
def test_a_sample_inserted_by_a_collector_callback_while_samples_move_is_kept(which):
    history = History(10**18)
    for number in range(1, 101):
        history.insert(number * PERIOD, 0, pose(number))
    late = [(PERIOD + 1, 0, (*pose(7).translation, *pose(7).rotation))]
    wanted = sorted([*history.items(), *late], reverse=True)
    held, collections = [], 0

    def collected(phase, info):
        nonlocal collections
        # Python stores one slice object for reuse. Each slice must be a new object, for which the
        # collector runs.
        held.extend([slice(None) for _ in range(5)])
        collections += phase == "stop"
        if phase == "stop" and collections == which:
            history.insert(PERIOD + 1, 0, pose(7))

    before = gc.get_threshold()
    gc.callbacks.append(collected)
    try:
        gc.set_threshold(1)
        history.use_large_pages()
        while collections < which:
            gc.collect()
    finally:
        gc.set_threshold(*before)
        gc.callbacks.remove(collected)

    assert history.items() == wanted


def test_a_history_that_was_cleared_is_asked_about_as_a_new_one():
    history = History(10**18)
    for number in range(1, 101):
        history.insert(number * PERIOD, 0, pose(number))
    history.use_large_pages()
    assert history.large_from == 200

    history.clear()

    assert history.large_from == History(10**18).large_from


def borrowed(let_go=None):
    """Return a history whose samples belong to another object, such as large pages or a recording.

    Args:
        let_go: Function called with that object when the history releases the samples.
    """
    records = np.zeros((MANY, WORDS), dtype=np.int64)
    records[:, 0] = np.arange(1, MANY + 1) * PERIOD
    records.view(np.float64)[:, 7] = 1.0
    history = History(10**18)
    history.borrow(records.reshape(-1).data, 0)
    if let_go is not None:
        weakref.finalize(records, let_go, history)
    return history


def most_memory(work):
    """Return the largest number of additional bytes in use while `work` runs."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_to_let_go_of_samples_takes_no_memory_for_them():
    history = borrowed()

    assert most_memory(lambda: history.keep_last(100)) < 0.1 * MANY * RECORD

    assert [len(history), history.oldest_stamp] == [100, (MANY - 99) * PERIOD]


@pytest.mark.parametrize("kept", [2, 100, MANY // 2])
def test_samples_that_are_let_go_of_leave_no_more_room_than_the_others_take(kept):
    history = borrowed()
    history.insert((MANY + 1) * PERIOD, 0, pose(1))

    history.keep_last(kept)

    assert len(history) == kept
    assert len(history.records) <= WORDS * (1.2 * kept + 64)


def test_an_insert_copies_what_is_borrowed_once():
    history = borrowed()

    late = most_memory(lambda: history.insert(PERIOD + 1, 0, pose(1)))

    assert late < 1.5 * MANY * RECORD
    assert len(history) == MANY + 1


@pytest.mark.parametrize("stamp", [PERIOD - 1, PERIOD + 1, NEWEST, NEWEST + 1])
def test_samples_may_move_while_those_that_were_borrowed_are_let_go_of(stamp):
    moved = []

    def move(history):
        moved.append(stamp)
        history.use_large_pages()

    history = borrowed(move)

    history.insert(stamp, 0, pose(1))

    assert moved == [stamp]
    assert [found for found, _, _ in history.items()].count(stamp) == 1 + (stamp == NEWEST)
    assert len(history) == MANY + 1


def test_a_read_while_samples_are_released_finds_those_before_or_after():
    found = []

    def ask(history):
        asking = threading.Thread(target=lambda: found.append(len(history.columns()[0]) // WORDS))
        asking.start()
        # The thread may have to wait for the work in progress here.
        asking.join(0.2)
        waited.append(asking)

    waited = []
    history = borrowed(ask)
    history.keep_last(MANY - 500)

    history.keep_last(100)

    for asking in waited:
        asking.join()
    assert found in ([MANY - 500], [100])
