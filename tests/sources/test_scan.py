"""The native scan against its twin in numpy: the same columns, whatever the messages are."""

import random
import struct

import numpy as np
import pytest

from tests.sources.scanning import REASON, ROS1_SAMPLE, both, cdr, is_native, ros1, same
from tftool.wire.layouts import CDR, ROS1
from tftool.wire.native import SCAN

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


@needs_scan
def test_finds_the_same_in_either_byte_order():
    little = cdr([(1, "world", "turtle1")])
    big = b"\x00\x00\x00\x00" + struct.pack(
        ">IiII6sxxI8sxxxx7d", 1, 3, 4, 6, b"world\x00", 8, b"turtle1", *range(7)
    )

    plain, native = both(CDR, [little, big, little])

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
def test_refuses_places_outside_of_the_buffer():
    buffer = np.zeros(100, dtype=np.uint8)

    for start, length in ((-1, 4), (0, 101), (101, 0), (90, 11), (2**62, 2**62), (0, -1)):
        with pytest.raises(ValueError, match="outside"):
            SCAN.Pairs().scan(buffer, np.array([start]), np.array([length]), True)


@needs_scan
def test_refuses_targets_that_are_too_short():
    payload = np.frombuffer(ros1(ROS1_SAMPLE), dtype=np.uint8)
    pairs = SCAN.Pairs()
    found, _, _ = pairs.scan(payload, np.array([0]), np.array([len(payload)]), False)
    numbers = np.zeros(1, dtype=np.int32)
    target = np.zeros((0, 8), dtype=np.int64), np.zeros(0, dtype=np.int32)

    with pytest.raises(ValueError, match="too short"):
        SCAN.fill(payload, found, numbers, [target])
    with pytest.raises(ValueError, match="another buffer"):
        SCAN.fill(payload[:20], found, numbers, [target])
    for number in (0, 1, -1, 2**70):
        with pytest.raises((ValueError, OverflowError)):
            SCAN.fill(payload, found, numbers, [number])
    with pytest.raises(IndexError):
        pairs.names(1)


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
    """A message's record in a ROS 1 chunk: its code is at byte 7 of its header, its owner at 17."""
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
