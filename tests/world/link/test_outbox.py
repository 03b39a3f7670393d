"""Tests of outgoing messages: they wait for no receiver, and stay in order."""

import threading

import pytest

from tests.patience import PATIENCE
from tftool.base.errors import LinkError
from tftool.world.link import queues
from tftool.world.link.queues import Outbox
from tftool.world.link.zenoh.transport import KeyPublisher


@pytest.fixture
def out():
    made = Outbox()
    yield made
    made.close()


class Stuck:
    """Send function that blocks until its release, like one whose receiver reads nothing."""

    def __init__(self):
        self.begun, self.let_go = threading.Event(), threading.Event()

    def __call__(self):
        self.begun.set()
        self.let_go.wait(PATIENCE)


def test_everything_is_sent_in_its_order_before_the_end(out):
    sent = []
    for number in range(1000):
        out.put(lambda number=number: sent.append(number))
    out.close()

    assert sent == list(range(1000))


def test_while_a_reader_takes_nothing_the_loop_goes_on_and_nothing_is_lost(out):
    stuck, sent = Stuck(), []
    out.put(stuck)
    assert stuck.begun.wait(PATIENCE)
    for number in range(1000):
        out.put(lambda number=number: sent.append(number))
    # The outbox accepted all messages while the sender was blocked.
    assert sent == []
    stuck.let_go.set()
    out.close()

    assert sent == list(range(1000))


def test_a_message_goes_out_by_a_reader_that_takes_nothing_without_waiting_for_it(out):
    class Publisher:
        def __init__(self):
            self.stuck, self.calls = Stuck(), []

        def put(self, payload, *, attachment):
            self.stuck()
            self.calls.append((payload, attachment))

        def undeclare(self):
            self.calls.append("undeclared")

    publisher = Publisher()
    outlet = KeyPublisher(publisher, out, keeps=False)
    outlet.put(b"one", b"1")
    outlet.put(b"two", b"2")
    outlet.close()
    assert publisher.stuck.begun.wait(PATIENCE)
    assert publisher.calls == []
    publisher.stuck.let_go.set()
    out.close()

    assert publisher.calls == [(b"one", b"1"), (b"two", b"2"), "undeclared"]


@pytest.mark.parametrize(
    ("bound", "most", "size"), [("MOST_UNSENT", 50, 0), ("MOST_UNSENT_BYTES", 50_000, 1000)]
)
def test_there_is_an_end_to_what_waits(out, monkeypatch, bound, most, size):
    monkeypatch.setattr(queues, bound, most)
    stuck, sent = Stuck(), []
    out.put(stuck)
    assert stuck.begun.wait(PATIENCE)
    ahead = threading.Event()

    def publish():
        for number in range(60):
            if number == 45:
                ahead.set()
            out.put(lambda number=number: sent.append(number), size)

    publishing = threading.Thread(target=publish)
    publishing.start()
    assert ahead.wait(PATIENCE)
    publishing.join(0.05)
    assert publishing.is_alive()
    stuck.let_go.set()
    publishing.join(PATIENCE)
    out.close()

    assert sent == list(range(60))


def test_a_sender_that_never_returns_holds_up_the_loop_once_and_not_for_ever(out, monkeypatch):
    monkeypatch.setattr(queues, "MOST_UNSENT", 50)
    monkeypatch.setattr(queues, "LONGEST_WAIT", 0.02)
    stuck, sent = Stuck(), []
    out.put(stuck)
    assert stuck.begun.wait(PATIENCE)
    for number in range(1000):
        out.put(lambda number=number: sent.append(number))
    assert out.dropped > 900
    stuck.let_go.set()
    out.close()

    assert sent == list(range(1000 - out.dropped))


def test_the_bytes_of_a_message_count_until_it_is_sent(out, monkeypatch):
    monkeypatch.setattr(queues, "MOST_UNSENT_BYTES", 100)
    stuck = Stuck()

    class Publisher:
        def put(self, payload, *, attachment):
            stuck()

    outlet = KeyPublisher(Publisher(), out, keeps=False)
    publishing = threading.Thread(target=outlet.put, args=(bytes(101), b""))
    publishing.start()
    assert stuck.begun.wait(PATIENCE)
    publishing.join(0.05)
    assert publishing.is_alive()
    stuck.let_go.set()
    publishing.join(PATIENCE)

    assert not publishing.is_alive()


def test_a_send_that_raises_does_not_stop_the_next_send(out):
    def gone():
        raise OSError("gone")

    sent = []
    out.put(gone)
    out.put(lambda: sent.append(1))
    out.close()

    assert sent == [1]


def test_after_the_end_nothing_is_sent(out):
    out.close()

    with pytest.raises(LinkError, match="connection to the session is closed"):
        out.put(lambda: None)
