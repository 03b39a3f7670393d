import pytest

from tftool.base.stamps import seconds
from tftool.buffer.buffer import NEVER, Buffer
from tftool.buffer.callbacks import AVAILABLE, NOW, PENDING, Requests
from tftool.buffer.sample import TransformStamped
from tftool.buffer.solver import Solver
from tftool.geometry.rigid import Transform


def put(buffer, parent, child, at, static=False):
    sample = TransformStamped(seconds(at), parent, child, Transform())
    return (buffer.set_transform_static if static else buffer.set_transform)(sample, "test")


@pytest.fixture
def buffer():
    return Buffer()


@pytest.fixture
def told():
    return []


def asker(buffer, told):
    def ask(target, source, at=0):
        return buffer.request(
            lambda handle, available: told.append((handle, available)), target, source, seconds(at)
        )

    return ask


def test_requests_fire_in_the_order_they_were_made(buffer, told):
    ask = asker(buffer, told)
    handles = [ask("a", "b", 1) for _ in range(4)]

    put(buffer, "a", "b", 1)

    assert told == [(handle, True) for handle in handles]


def test_a_new_child_wakes_nobody_who_waits_for_its_sisters(told, monkeypatch):
    examine = Solver.examine
    asked = []

    def counted(solver, lookup, first):
        asked.append(lookup)
        return examine(solver, lookup, first)

    monkeypatch.setattr(Solver, "examine", counted)
    buffer = Buffer()
    put(buffer, "world", "sister", 1)
    asker(buffer, told)("world", "sister", 2)
    asked.clear()

    put(buffer, "world", "new", 1)
    put(buffer, "world", "fixed", 1, static=True)
    put(buffer, "new", "newer", 1)

    assert asked == []


def test_a_name_that_comes_up_in_a_refused_sample_is_news_to_who_waits_for_it(buffer, told):
    ask = asker(buffer, told)
    put(buffer, "world", "child", 100)
    put(buffer, "world", "child", 101)
    handle = ask("late_parent", "child", 0)
    assert not put(buffer, "late_parent", "child", 1)

    assert put(buffer, "late_parent", "child", 102)

    assert told == [(handle, True)]


def test_waits_on_other_frames_are_not_asked_again():
    asked = []

    def examine(lookup, first):
        asked.append(lookup)
        return PENDING, (lookup[1],)

    requests = Requests(examine)
    for number in range(10_000):
        requests.add(lambda handle, available: None, ("world", f"ghost{number}", 0))
    asked.clear()

    requests.changed("turtle1", "world")
    assert asked == []
    requests.changed("ghost77")
    assert asked == [("world", "ghost77", 0)]


def test_an_unknown_frame_is_waited_for_by_its_name(buffer, told):
    handle = asker(buffer, told)("world", "turtle1")
    put(buffer, "world", "turtle2", 1)
    put(buffer, "elsewhere", "turtle3", 1)
    assert told == []

    put(buffer, "world", "turtle1", 1)
    assert told == [(handle, True)]


def test_a_frame_that_comes_up_as_a_parent_wakes_those_who_wait_for_it(buffer, told):
    put(buffer, "base", "arm", 1)
    handle = asker(buffer, told)("map", "arm")

    put(buffer, "map", "base", 1)

    assert told == [(handle, True)]


def test_a_link_far_up_the_chain_wakes_those_below(buffer, told):
    put(buffer, "base", "arm", 1)
    put(buffer, "arm", "hand", 1)
    handle = asker(buffer, told)("map", "hand", 1)

    put(buffer, "odom", "base", 1)
    assert told == []
    put(buffer, "map", "odom", 1, static=True)

    assert told == [(handle, True)]


def test_the_chain_may_be_rebuilt_while_somebody_waits(buffer, told):
    put(buffer, "a", "b", 1)
    put(buffer, "b", "c", 1)
    handle = asker(buffer, told)("a", "c", 2)

    put(buffer, "x", "c", 3)
    put(buffer, "a", "x", 1)
    # c is a child of b until 3 s, so at 2 s the frame b is missing.
    assert told == []
    put(buffer, "a", "b", 3)

    assert told == [(handle, True)]


def test_a_wait_survives_a_clear(buffer, told):
    put(buffer, "a", "b", 1)
    put(buffer, "b", "c", 1)
    handle = asker(buffer, told)("a", "c", 2)
    buffer.clear()

    put(buffer, "a", "b", 2)
    assert told == []
    put(buffer, "b", "c", 2)

    assert told == [(handle, True)]


def test_a_callback_may_cancel_those_after_it(buffer, told):
    handles = []

    def first(handle, available):
        told.append(handle)
        buffer.cancel(handles[1])

    handles.append(buffer.request(first, "a", "b"))
    handles.append(buffer.request(lambda handle, available: told.append(handle), "a", "b"))
    handles.append(buffer.request(lambda handle, available: told.append(handle), "a", "b"))

    put(buffer, "a", "b", 1)

    assert told == [handles[0], handles[2]]


def test_a_callback_may_set_and_ask_anew(buffer, told):
    def first(handle, available):
        told.append("first")
        buffer.request(lambda handle, available: told.append("second"), "a", "c")
        put(buffer, "b", "c", 1)

    buffer.request(first, "a", "b")
    put(buffer, "a", "b", 1)

    assert told == ["first", "second"]


def test_a_rejected_sample_wakes_nobody(buffer, told):
    asker(buffer, told)("a", "a2")
    quiet = Buffer(log=lambda level, text: None)
    asker(quiet, told)("a", "b")
    bad = TransformStamped(1, "a", "b", Transform((float("nan"), 0, 0)))

    assert not quiet.set_transform(bad, "test")
    assert told == []


def test_names_that_can_never_be_asked_for_wait_for_ever(buffer, told):
    ask = asker(buffer, told)
    assert ask("/a", "b") not in (NOW, NEVER)
    assert ask("", "b") not in (NOW, NEVER)

    put(buffer, "a", "b", 1)

    assert told == []


def test_cancelling_what_is_not_pending_does_nothing(buffer, told):
    buffer.cancel(77)
    handle = asker(buffer, told)("a", "b")
    buffer.cancel(handle)
    buffer.cancel(handle)
    put(buffer, "a", "b", 1)

    assert told == []


def test_a_request_that_can_be_answered_at_once_is_not_kept():
    requests = Requests(lambda question, first: (AVAILABLE, ()))

    assert requests.add(lambda handle, available: None, ("a", "b", 0)) == NOW
    assert requests.pending == {}
