"""Tests of messages that other threads receive and the event loop processes, up to a limit."""

import asyncio
import threading

from tests.world.link.conftest import until
from tftool.world.clock import WallClock, run
from tftool.world.link import queues
from tftool.world.link.queues import Inbox


def taken_in(fill, expected):
    """Put messages into an inbox before and while it is read; return the results."""
    box, taken = Inbox(), []

    async def take():
        fill(box, taken.append)
        box.start(asyncio.get_running_loop())
        await until(lambda: len(taken) >= expected)
        box.close()

    run(WallClock(), take())
    return box, taken


def test_messages_before_the_start_come_in_order_and_those_of_threads_come_too():
    def fill(box, take):
        for number in range(500):
            box.put(take, number, 1)
        threading.Thread(target=lambda: box.put(take, 500, 1)).start()

    _, taken = taken_in(fill, 501)

    assert sorted(taken) == list(range(501))
    assert [one for one in taken if one < 500] == list(range(500))


def test_messages_beyond_the_most_are_lost_and_counted_and_news_of_others_never(monkeypatch):
    monkeypatch.setattr(queues, "MOST_WAITING", 3)

    def fill(box, take):
        for number in range(5):
            box.put(take, number, 10)
        box.put(take, "somebody has left")

    box, taken = taken_in(fill, 4)

    assert taken == [0, 1, 2, "somebody has left"]
    assert box.lost == 2


def test_bytes_that_wait_are_bounded_too(monkeypatch):
    monkeypatch.setattr(queues, "MOST_BYTES", 100)

    def fill(box, take):
        for size in (60, 60, 40):
            box.put(take, size, size)

    box, taken = taken_in(fill, 2)

    assert taken == [60, 40]
    assert box.lost == 1


def test_messages_without_a_payload_are_bounded_like_all_others(monkeypatch):
    monkeypatch.setattr(queues, "MOST_WAITING", 2)

    def fill(box, take):
        for number in range(5):
            box.put(take, number, 0)

    box, taken = taken_in(fill, 2)

    assert taken == [0, 1]
    assert box.lost == 3


def test_a_callback_that_raises_is_told_of_and_keeps_nobody_else_from_being_called():
    told = []

    def fill(box, take):
        loop = asyncio.get_running_loop()
        loop.set_exception_handler(lambda _, context: told.append(str(context["exception"])))
        box.put(take, 1, 1)
        box.put(lambda _: 1 / 0, "anything", 1)
        box.put(take, 2, 1)
        loop.call_later(0.05, box.put, take, 3, 1)

    _, taken = taken_in(fill, 3)

    assert taken == [1, 2, 3]
    assert told == ["division by zero"]


def test_nothing_is_called_after_the_end():
    box, called = Inbox(), []

    async def end():
        box.start(asyncio.get_running_loop())
        box.put(called.append, 1, 1)
        box.close()
        box.put(called.append, 2, 1)
        await WallClock().sleep(1)

    run(WallClock(), end())

    assert called == []
