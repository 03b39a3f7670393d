"""Tests that the native scan gives the same columns as numpy, for any messages."""

import itertools
import random
import struct
from array import array

import numpy as np
import pytest

from tests.recordings.scanning import REASON, ROS1_SAMPLE, both, cdr, is_native, ros1, same
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.layouts import CDR, ROS1
from tftool.messages.transform_rows import SCAN, walk
from tftool.messages.transforms import encode_transforms
from tftool.recordings import columns

needs_scan = pytest.mark.skipif(not is_native(), reason=REASON)
LAYOUTS = [(CDR, cdr), (ROS1, ros1)]


@needs_scan
@pytest.mark.parametrize(("layout", "encode"), LAYOUTS)
def test_finds_the_same_in_sound_messages(layout, encode):
    draw = random.Random(5)
    names = ["map", "odom", "base_link", "/map", "", "x" * 300, "größe", "a b"]
    messages = [
        encode([(k * 10**9 + 7, *draw.sample(names, 2)) for _ in range(draw.randrange(6))])
        for k in range(600)
    ]

    plain, native = both(layout, messages)

    same(plain, native)
    assert len(native) > 1000


@needs_scan
@pytest.mark.parametrize(("layout", "encode"), LAYOUTS)
@pytest.mark.parametrize("at_once", [40, 700])
def test_finds_the_same_in_runs_of_messages_with_equal_frames(layout, encode, at_once):
    draw = random.Random(8)
    kinds = [
        [("map", "odom"), ("odom", "base_link")],
        [("map", "odom"), ("odom", "bass_link")],
        [("odom", "base_link"), ("/map", "/odom"), ("a", "b")],
        [("map", "odom"), ("a", "b"), ("map", "odom")],
        [("a", "b"), ("b", "a")],
        [],
    ]
    messages = []
    while len(messages) < 4000:
        kind = draw.choice(kinds)
        for _ in range(draw.choice((1, 2, 3, 32, 33, 34, 100))):
            stamps = [draw.randrange(10**9) for _ in kind]
            message = bytearray(encode([(s, *p) for s, p in zip(stamps, kind, strict=True)]))
            for place in walk(layout, bytes(message)).places:
                message[place.numbers : place.numbers + 56] = draw.randbytes(56)
            messages.append(bytes(message))
        if draw.random() < 0.2:
            messages.append(messages[-1][:-3])

    plain, native = both(layout, messages, at_once)

    same(plain, native)
    assert len(native) > 4000
    assert native.damage
    assert sum(edge.slashed for edge in native.edges) > 100


@needs_scan
@pytest.mark.parametrize(("layout", "encode"), LAYOUTS)
def test_finds_the_same_in_damaged_messages(layout, encode):
    draw = random.Random(6)
    sound = [encode([(1, "world", "turtle1"), (2, "turtle1", "carrot")]) for _ in range(500)]
    messages = []
    for payload in sound:
        raw = bytearray(payload)
        for _ in range(draw.randrange(3)):
            raw[draw.randrange(len(raw))] = draw.choice((0, 1, 3, 127, 255))
        messages.append(bytes(raw[: draw.choice((len(raw), len(raw), draw.randrange(len(raw))))]))

    plain, native = both(layout, messages)

    same(plain, native)
    assert native.damage
    assert len(native) > 100


def big(second, parent, child):
    """Return a message of one transform in big-endian byte order."""
    head = b"\x00\x00\x00\x00" + struct.pack(">IiI", 1, second, 4)
    for name in (parent + b"\x00", child + b"\x00"):
        head += bytes(-len(head) % 4) + struct.pack(">I", len(name)) + name
    return head + bytes((4 - len(head)) % 8) + struct.pack(">7d", *range(7))


@needs_scan
def test_finds_the_same_in_either_byte_order():
    little = cdr([(1, "world", "turtle1")])

    plain, native = both(CDR, [little, big(3, b"world", b"turtle1"), little])

    same(plain, native)
    assert [len(edge) for edge in native.edges] == [3]
    assert native.edges[0].stamps.tolist() == [1, 3 * 10**9 + 4, 1]


@needs_scan
def test_finds_the_same_among_more_pairs_than_there_are_layouts_for():
    messages = [cdr([(k, f"frame_{k % 97:03}", f"frame_{k % 89:03}")]) for k in range(9000)]

    plain, native = both(CDR, messages)

    same(plain, native)
    assert len(native.edges) == 97 * 89


@needs_scan
@pytest.mark.parametrize("at_once", [64, 300])
def test_keeps_the_same_edges_where_there_are_more_than_are_kept(monkeypatch, at_once):
    monkeypatch.setattr(columns, "MOST_EDGES", 40)
    draw = random.Random(8)
    messages = []
    for number in range(900):
        # Names have many lengths, some messages are in big-endian order, and some have more rows
        # than reserved.
        names = [("a" * draw.randrange(1, 9), f"{draw.randrange(3 + number // 9)}") for _ in "ab"]
        sent = [(number, *pair) for pair in names[: draw.randrange(3)]]
        if number % 50 == 7:
            sent += [(number, "many", f"{number} {k}") for k in range(4)]
        messages.append(
            big(number, b"big", b"%d" % (number % 30)) if number % 11 == 3 else cdr(sent)
        )

    plain, native = both(CDR, messages, at_once)

    same(plain, native)
    first = {}
    for payload in messages:
        for place in walk(CDR, payload).places:
            first.setdefault((place.parent, place.child))
    assert {(edge.parent, edge.child) for edge in native.edges} == set(list(first)[:40])
    assert any("more than 40 pairs" in text for text in native.damage)


def alike(count):
    """Return names with the same hash in the scan's table, found by inverting the hash function."""
    factor, words = 0x9E3779B97F4A7C15, 2**64
    back = pow(factor, -1, words)

    def name(number):
        # Both halves are equal, so that their difference, which the hash uses, is zero.
        mixed = (number << 32 | number) * back % words
        word = mixed ^ mixed >> 29 ^ mixed >> 58
        return (word * back % words ^ 8).to_bytes(8, "little")

    texts = (made.decode() for made in map(name, itertools.count(1)) if made.isascii())
    return list(itertools.islice(texts, count))


@needs_scan
def test_finds_the_same_among_names_that_were_made_to_look_alike():
    names = alike(400)
    messages = [ros1([(stamp, name, "c")]) for stamp in (1, 2) for name in names]

    same(*both(ROS1, messages))


def take(pairs, payload, ask, *, start=0, length=None, is_cdr=False):
    """Scan one message, whose number is 7."""
    buffer = np.frombuffer(payload, dtype=np.uint8)
    places = np.array([start]), np.array([len(payload) if length is None else length])
    return pairs.take(buffer, *places, np.array([7], dtype=np.int32), is_cdr, ask)


def room(rows):
    """Return columns for a number of transforms, and the state of an edge without samples."""
    state = array("q", (0, -1, 1, 0, 0, 0))
    return np.zeros((rows, 8), dtype=np.int64), np.zeros(rows, dtype=np.int32), state


@needs_scan
def test_refuses_places_outside_of_the_buffer():
    payload = bytes(100)

    for start, length in ((-1, 4), (0, 101), (101, 0), (90, 11), (2**62, 2**62), (0, -1)):
        with pytest.raises(ValueError, match="beyond"):
            take(SCAN.Pairs(), payload, None, start=start, length=length)
    no_numbers = np.zeros(0, dtype=np.int32)
    with pytest.raises(ValueError, match="beyond"):
        SCAN.Pairs().take(payload, np.array([0]), np.array([4]), no_numbers, True, None)


@needs_scan
def test_asks_where_the_transforms_of_a_pair_go_and_for_room():
    payload = [(5, "a", "b"), (6, "a", "c"), (7, "a", "b"), (7, "a", "b")]
    payload = ros1([*payload, (8, "/a", "b"), (9, "x", "y")])
    pairs = SCAN.Pairs()
    columns, other, asked = room(2), room(1), []

    def ask(pair, message, rank):
        asked.append((pair, message, rank))
        parent, child = pairs.names(pair)
        if parent == b"x":
            pairs.lead(pair, -1, False)
        elif child == b"c":
            pairs.aim(1, *other)
            pairs.lead(pair, 1, False)
        else:
            if rank:
                columns[:2] = [np.concatenate([one, one]) for one in columns[:2]]
            pairs.aim(0, *columns)
            pairs.lead(pair, 0, parent == b"/a")

    columns = list(columns)
    left_out, odd = take(pairs, payload, ask)

    assert (left_out, odd) == (1, b"")
    # There is no room for the third sample of an edge.
    assert asked == [(0, 7, 0), (1, 7, 1), (0, 7, 3), (2, 7, 4), (3, 7, 5)]
    assert columns[0][:4, 0].tolist() == [5, 7, 7, 8]
    assert columns[1][:4].tolist() == [7] * 4
    assert list(columns[2]) == [4, 7, 1, 2, 1, 0]
    assert other[0][0, 0] == 6


@needs_scan
def test_refuses_pairs_of_the_other_layout_whose_bytes_lie_otherwise():
    pairs = SCAN.Pairs()
    columns = room(4)

    def ask(pair, *_):
        pairs.aim(0, *columns)
        pairs.lead(pair, 0, False)

    take(pairs, ros1([(5, "a", "b")]), ask)
    with pytest.raises(ValueError, match="another layout"):
        take(pairs, cdr([(5, "a", "b")]), ask, is_cdr=True)
    assert columns[2][0] == 1


@needs_scan
def test_refuses_columns_without_room_or_of_another_kind():
    payload = ros1(ROS1_SAMPLE)
    pairs = SCAN.Pairs()
    moved = room(1)

    def put_elsewhere(pair, *_):
        pairs.aim(0, *moved)
        pairs.lead(pair, 0, False)
        moved[2][5] += 1

    for nobody in (
        lambda *_: None,
        lambda pair, *_: (pairs.aim(0, *room(0)), pairs.lead(pair, 0, False)),
        put_elsewhere,
    ):
        with pytest.raises(ValueError, match="are full"):
            take(pairs, payload, nobody)
    with pytest.raises(ZeroDivisionError):
        take(pairs, payload, lambda *_: 1 // 0)
    with pytest.raises(RuntimeError, match="another thread"):
        take(pairs, payload, lambda *_: take(pairs, payload, None))
    for number, state in ((2, room(1)[2]), (-1, room(1)[2]), (0, array("q", (0,) * 5))):
        with pytest.raises(ValueError, match="no such edge"):
            pairs.aim(number, *room(1)[:2], state)
    for pair, edge in ((1, 0), (0, 1), (0, -2), (-1, 0)):
        with pytest.raises(IndexError):
            pairs.lead(pair, edge, False)
    with pytest.raises(IndexError):
        pairs.names(1)


POSES = {
    "sound": ((1.0, 2.0, 3.0), (0.0, 0.0, 0.6, 0.8)),
    "infinite": ((1.0, float("inf"), 3.0), (0.0, 0.0, 0.6, 0.8)),
    "no number": ((1.0, 2.0, 3.0), (0.0, 0.0, float("nan"), 0.8)),
    "long": ((1.0, 2.0, 3.0), (0.0, 0.0, 0.6, 0.9)),
    "other sign": ((1.0, 2.0, 3.0), (0.0, 0.0, -0.6, -0.8)),
}


@needs_scan
@pytest.mark.parametrize("odd", POSES)
@pytest.mark.parametrize("later", [True, False])
def test_counts_how_many_a_buffer_keeps_as_they_are(odd, later):
    sent = [(k, *POSES["sound"]) for k in range(1, 100)]
    sent += [(100 if later else 99, *POSES[odd]), (101, *POSES["sound"])]
    messages = [
        encode_transforms([TransformStamped(stamp, "map", "odom", Transform(*pose))])
        for stamp, *pose in sent
    ]

    _, native = both(CDR, messages)

    assert native.edges[0].kept == (101 if later and odd == "sound" else 99)


@needs_scan
def test_refuses_an_index_that_points_at_no_message():
    body = b"\x05" + struct.pack("<QHIQQ", 22 + 3, 7, 0, 11, 12) + b"abc"
    chunk = np.frombuffer(b"\x00" * 5 + body, dtype=np.uint8)
    arrays = [np.zeros(1, dtype=np.int64) for _ in range(3)]

    assert SCAN.indexed(chunk, struct.pack("<QQ", 11, 5), *arrays, 7)
    assert [one.tolist() for one in arrays] == [[5 + 31], [3], [11]]
    for place, channel in ((5, 8), (4, 7), (6, 7), (2**63, 7), (2**64 - 1, 7)):
        assert not SCAN.indexed(chunk, struct.pack("<QQ", 11, place), *arrays, channel)
    assert not SCAN.indexed(chunk[:-1], struct.pack("<QQ", 11, 5), *arrays, 7)


def ros1_message(connection, payload, code=b"\x02"):
    """Return a message's record in a ROS 1 chunk; the connection is at byte 17 of its header."""
    fields = [b"op=" + code, b"conn=" + struct.pack("<I", connection), b"time=" + bytes(8)]
    header = b"".join(struct.pack("<I", len(one)) + one for one in fields)
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(payload)) + payload


@needs_scan
def test_refuses_a_ros_1_index_that_points_at_no_message():
    first, second = ros1_message(7, b"abc"), ros1_message(7, b"defgh")
    chunk = np.frombuffer(b"\x00" * 5 + first + second, dtype=np.uint8)
    place, head = 5 + len(first), 4 + 8 + 13 + 17
    arrays = [np.zeros(2, dtype=np.int64) for _ in range(3)]
    index = struct.pack("<6I", 1, 2, 5, 3, 4, place)

    assert SCAN.pointed(chunk, index, *arrays, 7, 7, 17)
    assert [one.tolist() for one in arrays] == [
        [5 + head + 4, place + head + 4],
        [3, 5],
        [10**9 + 2, 3 * 10**9 + 4],
    ]
    for wrong in (0, 4, 6, place + 1, len(chunk) - 8, len(chunk), 2**32 - 1):
        index = struct.pack("<6I", 1, 2, 5, 3, 4, wrong)
        assert not SCAN.pointed(chunk, index, *arrays, 7, 7, 17)
    index = struct.pack("<6I", 1, 2, 5, 3, 4, place)
    assert not SCAN.pointed(chunk[:-1], index, *arrays, 7, 7, 17)
    assert not SCAN.pointed(chunk, index, *arrays, 8, 7, 17)
    for code, owner in ((6, 17), (7, 16), (2**31, 17), (7, 2**31), (7, head - 4 - 3)):
        assert not SCAN.pointed(chunk, index, *arrays, 7, code, owner)
    assert not SCAN.pointed(chunk, index, *(one[:1] for one in arrays), 7, 7, 17)


@needs_scan
@pytest.mark.parametrize("size", [0, 1, 3, 4, 7, 8, 9, 15, 16, 17, 40])
def test_tells_names_apart_by_each_of_their_bytes(size):
    names = {"x" * size} | {"x" * k + "y" + "x" * (size - k - 1) for k in range(size)}
    messages = [cdr([(1, "map", name), (2, name, "map")]) for name in sorted(names)] * 3

    plain, native = both(CDR, messages)

    same(plain, native)
    assert sorted(edge.child for edge in native.edges if edge.parent == "map") == sorted(names)


@needs_scan
def test_threads_that_scan_for_themselves_do_not_disturb_each_other():
    from concurrent.futures import ThreadPoolExecutor

    messages = [cdr([(k, f"frame_{k % 97:03}", "map")]) for k in range(3000)]

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: both(CDR, messages, at_once=1000), range(8)))

    for plain, native in found:
        same(plain, native)
