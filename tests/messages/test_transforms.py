"""Tests of transforms as bytes, against rosbags' codec, and of malformed bytes."""

import random
import struct
import tracemalloc

import numpy as np
import pytest

from tests.messages import definitions
from tests.messages.hostile import mutations
from tftool.base.errors import MalformedMessage
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages import layouts
from tftool.messages.transforms import decode_columns, decode_transforms, encode_transforms

NAMES = ["map", "odom", "base_link", "turtle1", "turtle10", "größe", "", "x" * 300, "a/b c"]


@pytest.fixture(scope="module")
def store():
    return definitions.store()


def transforms(chance, count):
    return tuple(
        TransformStamped(
            chance.randrange(-(2**31), 2**31) * 1_000_000_000 + chance.randrange(1_000_000_000),
            chance.choice(NAMES),
            chance.choice(NAMES),
            Transform(
                [chance.uniform(-1e6, 1e6) for _ in range(3)],
                [chance.uniform(-1, 1) for _ in range(4)],
            ),
        )
        for _ in range(count)
    )


def as_ros(store, samples):
    made = store.types

    def header(sample):
        sec, nanosec = divmod(sample.stamp, 1_000_000_000)
        time = made["builtin_interfaces/msg/Time"](sec, nanosec)
        return made["std_msgs/msg/Header"](time, sample.frame_id)

    return made["tf2_msgs/msg/TFMessage"](
        [
            made["geometry_msgs/msg/TransformStamped"](
                header(sample),
                sample.child_frame_id,
                made["geometry_msgs/msg/Transform"](
                    made["geometry_msgs/msg/Vector3"](*sample.transform.translation),
                    made["geometry_msgs/msg/Quaternion"](*sample.transform.rotation),
                ),
            )
            for sample in samples
        ]
    )


@pytest.mark.parametrize("seed", range(60))
def test_transforms_have_the_bytes_rosbags_writes_and_are_read_back(store, seed):
    chance = random.Random(seed)
    samples = transforms(chance, chance.choice([0, 1, 2, 3, 7, 40]))

    payload = bytes(store.serialize_cdr(as_ros(store, samples), "tf2_msgs/msg/TFMessage"))

    assert encode_transforms(samples) == payload
    assert decode_transforms(payload) == samples


def test_the_array_path_reads_what_the_scalar_path_reads():
    samples = transforms(random.Random(7), 500)
    payload = encode_transforms(samples)

    columns = decode_columns(payload)

    assert len(columns) == 500
    assert columns.stamps.tolist() == [sample.stamp for sample in samples]
    assert list(columns.parents) == [sample.frame_id for sample in samples]
    assert list(columns.children) == [sample.child_frame_id for sample in samples]
    np.testing.assert_array_equal(
        columns.translations, [sample.transform.translation for sample in samples]
    )
    np.testing.assert_array_equal(
        columns.rotations, [sample.transform.rotation for sample in samples]
    )


def test_the_array_path_reads_an_empty_message():
    columns = decode_columns(encode_transforms([]))

    assert len(columns) == 0
    assert columns.translations.shape == (0, 3)


# Refused bytes


ONE = encode_transforms(transforms(random.Random(1), 1))


@pytest.mark.parametrize(
    ("payload", "told"),
    [
        (b"", "0 bytes are too few for a message with a header"),
        (b"\x00\x01\x00\x00", "too short to contain the number of transforms"),
        (b"\x00\x00\x00\x00" + ONE[4:], "only little-endian"),
        (b"\x00\x07\x00\x00" + ONE[4:], "header 0007 is not a header of plain CDR"),
        (ONE[:4] + b"\xff\xff\xff\xff" + ONE[8:], "announces 4294967295 transforms, but has bytes"),
        (ONE[:16] + b"\xff\xff\xff\xff" + ONE[20:], "a string has 4294967295 bytes"),
        (ONE[:-9], "ends within transform 1|has bytes for only 0"),
        (ONE + bytes(8), "8 bytes follow after the message"),
    ],
)
@pytest.mark.parametrize("decode", [decode_transforms, decode_columns])
def test_transforms_that_do_not_fit_are_refused_with_the_reason(decode, payload, told):
    with pytest.raises(MalformedMessage, match=told):
        decode(payload)


def one_named(raw):
    body = struct.pack("<IiII", 1, 0, 0, len(raw)) + raw
    body += bytes(-len(body) % 4) + struct.pack("<I", 2) + b"c\x00"
    return layouts.CDR.header + body + bytes(-len(body) % 8) + bytes(56)


@pytest.mark.parametrize(
    ("raw", "told"),
    [
        (b"abcd", "does not end with a zero byte"),
        (b"\xff\xfe\x00", "not UTF-8"),
        (b"a\x00b\x00", "continues after its zero byte"),
    ],
)
@pytest.mark.parametrize("decode", [decode_transforms, decode_columns])
def test_a_name_that_is_no_text_is_refused(decode, raw, told):
    with pytest.raises(MalformedMessage, match=told):
        decode(one_named(raw))


def test_a_message_larger_than_we_read_is_refused_unread(monkeypatch):
    monkeypatch.setattr(layouts, "LARGEST", 100)

    with pytest.raises(MalformedMessage, match="more than the maximum"):
        decode_transforms(ONE + bytes(100))


def test_a_stamp_beyond_32_bits_of_seconds_is_not_written():
    late = TransformStamped(2**31 * 1_000_000_000, "a", "b", Transform())

    with pytest.raises(MalformedMessage, match="32-bit seconds"):
        encode_transforms([late])


def test_hostile_transforms_are_read_or_refused_and_memory_stays_flat():
    chance = random.Random(2026)
    seeds = [encode_transforms(transforms(chance, count)) for count in (0, 1, 2, 5)]
    cases = [(decode_transforms, seed) for seed in seeds] * 2
    cases += [(decode_columns, seed) for seed in seeds]
    read = refused = 0

    try:
        for number in range(50_000):
            if number == 45_000:
                # Memory is traced only here, because tracing makes everything three times slower.
                tracemalloc.start()
            decode, payload = chance.choice(cases)
            try:
                decode(mutations(chance, payload))
                read += 1
            except MalformedMessage:
                refused += 1
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    assert read + refused == 50_000
    assert refused > 5_000
    assert peak < 2_000_000


def test_strangers_with_ever_new_names_do_not_fill_the_memory_for_names():
    def meet(numbers):
        for number in numbers:
            decode_transforms(one_named(f"frame{number}".encode() + b"\x00"))
            encode_transforms([TransformStamped(0, f"f{number}", "b", Transform())])

    tracemalloc.start()
    try:
        meet(range(20_000))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    # Each stored transform would need more than 200 bytes.
    assert peak < 20_000 * 100
