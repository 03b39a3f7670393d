"""Tests of chunks that are unpacked ahead: the result equals that of unpacking on demand."""

import bz2
import subprocess
import sys
import threading
from functools import partial

import lz4.frame
import pytest
import zstandard

from tftool import InputError
from tftool.recordings.decompression import Ahead, unpack

TEXTS = [bytes([number]) * 1000 * (number + 1) + b"end" for number in range(8)]
PACK = {
    "zstd": zstandard.ZstdCompressor(write_checksum=True).compress,
    "lz4": partial(lz4.frame.compress, content_checksum=True),
    "bz2": bz2.compress,
}


def outcome(give):
    """Return the result of a call: its bytes, or the text of its error."""
    try:
        return bytes(give())
    except InputError as error:
        return str(error)


def taken(pieces):
    """Return the result for each chunk, unpacked ahead if this machine does so."""
    found = []

    def packed(number):
        method, data, size = pieces[number]
        return method, lambda: data, size

    with Ahead(range(len(pieces)), packed) as ahead:
        for number, piece in enumerate(pieces):
            coming = ahead.take(number)
            found.append(outcome(partial(unpack, *piece) if coming is None else coming.result))
    return found


@pytest.mark.parametrize("method", PACK)
def test_pieces_come_in_order_and_whole(method):
    pieces = [(method, PACK[method](text), len(text)) for text in TEXTS[::-1] + TEXTS]

    assert taken(pieces) == TEXTS[::-1] + TEXTS


@pytest.mark.parametrize("method", PACK)
def test_damaged_pieces_give_the_same_outcome_as_without_threads(method):
    sound = PACK[method](TEXTS[5])
    size = len(TEXTS[5])
    pieces = [
        (method, sound, size),
        (method, sound, size - 1),
        (method, sound, size + 1),
        (method, sound[:-9], size),
        (method, sound, 1 << 40),
        (method, b"", size),
        (method, b"nothing of that kind", size),
        (method, sound[:12] + b"\xff\x00\xff" + sound[15:], size),
        (method, sound[:-1] + bytes([sound[-1] ^ 1]), size),
        (method, sound + b"more", size),
        (method, sound + sound, size),
        (method, PACK[method](b""), 0),
        (method, sound, size),
    ]

    found = taken(pieces)

    assert found == [outcome(partial(unpack, *piece)) for piece in pieces]
    assert found[0] == found[-1] == TEXTS[5]
    assert sum(isinstance(one, str) for one in found) >= 6


def test_lz4_is_unpacked_where_the_package_hides_its_library():
    program = (
        "import sys, types, lz4.frame\n"
        "sys.modules['lz4.frame._frame'] = types.ModuleType('hidden')\n"
        "from tests.recordings.test_ahead import PACK, TEXTS, taken\n"
        "pieces = [('lz4', PACK['lz4'](text), len(text)) for text in TEXTS]\n"
        "print(taken(pieces) == TEXTS)\n"
    )

    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)

    assert (done.stdout, done.stderr) == ("True\n", "")


def test_reading_that_ends_early_ends_its_threads():
    before = threading.active_count()

    with Ahead(range(20), lambda _: ("bz2", lambda: bz2.compress(b"text"), 4)) as ahead:
        ahead.take(0)

    assert threading.active_count() == before


def test_a_read_error_is_raised_when_the_piece_is_asked_for():
    def nothing():
        raise InputError("the file was shortened")

    with Ahead(range(2), lambda _: ("bz2", nothing, 5)) as ahead:
        coming = [one for one in map(ahead.take, range(2)) if one is not None]
        assert [outcome(one.result) for one in coming] == ["the file was shortened"] * len(coming)


def test_a_caller_that_would_have_to_wait_unpacks_a_later_piece_itself():
    asking, helped = threading.current_thread(), threading.Event()

    def read():
        if threading.current_thread() is asking:
            helped.set()
        # Without the calling thread's help, the other threads block here.
        assert helped.wait(20)
        return bz2.compress(b"text")

    with Ahead(range(20), lambda _: ("bz2", read, 4)) as ahead:
        first = ahead.take(0)
        if first is None:
            pytest.skip("one processor: nothing is unpacked ahead")
        found = [outcome(first.result)]
        found += [outcome(ahead.take(number).result) for number in range(1, 20)]

    assert found == [b"text"] * 20


def test_pieces_that_are_passed_over_make_room_for_those_behind():
    pieces = [("bz2", bz2.compress(text), len(text)) for text in TEXTS * 10]

    with Ahead(
        range(len(pieces)), lambda n: (pieces[n][0], lambda: pieces[n][1], pieces[n][2])
    ) as it:
        if it.take(0) is None:
            pytest.skip("one processor: nothing is unpacked ahead")
        numbers = range(40, len(pieces), 7)
        coming = [it.take(number).result() for number in numbers]

    assert coming == [TEXTS[number % len(TEXTS)] for number in numbers]


def test_of_pieces_that_are_not_to_be_unpacked_no_more_are_looked_at_than_of_others():
    told = []

    def packed(number):
        told.append(number)

    with Ahead(range(1000), packed) as ahead:
        assert [ahead.take(number) for number in range(10)] == [None] * 10

    assert len(told) < 100
