"""Tests of every message's bytes against rosbags' codec, and of malformed bytes."""

import array
import random
import struct
import tracemalloc

import numpy as np
import pytest

from tests.messages import definitions
from tests.messages.hostile import mutations
from tftool.base.errors import MalformedMessage
from tftool.messages import layouts
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.codec import Codec, codec
from tftool.messages.layouts import CDR, ROS1

PARTS = {"srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}
DERIVED = ("SendGoal_Request", "SendGoal_Response", "GetResult_Request", "GetResult_Response",
           "FeedbackMessage")  # fmt: skip


def every_type():
    for package in INTERFACES.packages():
        for name in INTERFACES.names(package, "msg"):
            yield f"{package}/msg/{name}"
        for kind, parts in PARTS.items():
            for name in INTERFACES.names(package, kind):
                for part in [*parts, *(DERIVED if kind == "action" else ())]:
                    yield f"{package}/{kind}/{name}_{part}"


TYPES = sorted(every_type())


def text_of(full):
    """Return a definition as in a .msg file, with full names of types."""
    lines = []
    for field in INTERFACES.structure(full).fields:
        brackets = ""
        if field.size is not None:
            bound = "" if field.bound is None else f"<={field.bound}"
            brackets = f"[{field.size}]" if field.size >= 0 else f"[{bound}]"
        bound = "" if field.text_bound is None else f"<={field.text_bound}"
        lines.append(f"{field.type}{bound}{brackets} {field.name}")
    return "\n".join(lines)


@pytest.fixture(scope="module")
def store():
    made = definitions.empty_store()
    for full in TYPES:
        definitions.register(made, full, text_of(full))
    return made


INTEGERS = {"int8": 8, "int16": 16, "int32": 32, "int64": 64}
TEXTS = ["", "a", "odom", "größe", "x" * 300, "日本"]


def chosen(chance, kind):
    """Return a random value of a primitive type."""
    if kind in ("float32", "float64"):
        value = chance.choice([0.0, -0.0, 1.5, -2.25, chance.uniform(-1e6, 1e6), float("inf")])
        return struct.unpack("f", struct.pack("f", value))[0] if kind == "float32" else value
    if kind == "string":
        return chance.choice(TEXTS)
    if kind == "bool":
        return chance.random() < 0.5
    if kind == "byte":
        return chance.randbytes(1)
    if kind in INTEGERS:
        return chance.randrange(-(1 << INTEGERS[kind] - 1), 1 << INTEGERS[kind] - 1)
    bits = 8 if kind == "char" else int(kind.removeprefix("uint"))
    return chance.randrange(1 << bits)


def filled(chance, kind):
    """Return a random message of a class, with times that ROS 1 has too."""
    message = kind()
    if kind.interface__ in ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"):
        message.sec, message.nanosec = chance.randrange(1 << 31), chance.randrange(1 << 31)
        return message
    for field in kind.fields__:

        def one(field=field):
            return (
                chosen(chance, field.kind)
                if isinstance(field.kind, str)
                else filled(chance, field.kind)
            )

        if field.size is None:
            setattr(message, field.name, one())
        else:
            most = 5 if field.bound is None else min(5, field.bound)
            count = field.size if field.size >= 0 else chance.randrange(most + 1)
            setattr(message, field.name, [one() for _ in range(count)])
    return message


def as_rosbags(store, message):
    """Return the same message as an object of rosbags."""
    values = []
    for field in message.fields__:
        value = getattr(message, field.name)
        if field.size is None:
            values.append(single(store, field, value))
        elif isinstance(field.kind, str) and field.kind not in ("string",):
            kind = {"byte": "uint8", "char": "uint8"}.get(field.kind, field.kind)
            items = [one[0] for one in value] if field.kind == "byte" else list(value)
            values.append(np.array(items, dtype=kind))
        else:
            values.append([single(store, field, one) for one in value])
    return store.types[message.interface__](*values)


def single(store, field, value):
    if not isinstance(field.kind, str):
        return as_rosbags(store, value)
    # rosbags treats a single byte as signed.
    return int.from_bytes(value, "little", signed=True) if field.kind == "byte" else value


@pytest.mark.parametrize("full", TYPES)
def test_every_type_has_the_bytes_rosbags_writes_and_is_read_back(store, full):
    chance = random.Random(full)
    kind = INTERFACES.part(full)
    for _ in range(8):
        message = filled(chance, kind)

        payload = bytes(store.serialize_cdr(as_rosbags(store, message), full))

        assert codec(kind).encode(message) == payload
        assert codec(kind).decode(payload) == message


@pytest.mark.parametrize("full", TYPES)
def test_every_type_has_the_bytes_rosbags_writes_for_ros_1_and_is_read_back(store, full):
    chance = random.Random(full)
    ros1 = Codec(INTERFACES.part(full), ROS1)
    for _ in range(4):
        message = filled(chance, ros1.kind)

        # rosbags adds ROS 1's header number when it converts, not when it writes.
        cdr = store.serialize_cdr(as_rosbags(store, message), full)
        payload = bytes(store.cdr_to_ros1(cdr, full))

        assert ros1.encode(message) == payload
        assert ros1.decode(memoryview(payload)) == message


@pytest.mark.parametrize("full", TYPES)
def test_every_type_is_read_in_big_endian_too(store, full):
    message = filled(random.Random(full), INTERFACES.part(full))
    payload = bytes(store.serialize_cdr(as_rosbags(store, message), full, little_endian=False))

    assert payload[:2] == b"\x00\x00"
    assert codec(type(message)).decode(payload) == message


def test_decoded_sequences_have_the_container_types_of_ros_2():
    scan = INTERFACES.message("sensor_msgs/LaserScan")
    pose = INTERFACES.message("geometry_msgs/PoseWithCovariance")

    read = codec(scan).decode(codec(scan).encode(scan(ranges=[1.0, 2.5])))
    assert read.ranges == array.array("f", [1.0, 2.5])
    read = codec(pose).decode(codec(pose).encode(pose()))
    assert read.covariance.dtype == np.float64
    read.covariance[0] = 5.0
    assert codec(pose).decode(codec(pose).encode(read)).covariance[0] == 5.0


def test_anything_with_the_fields_of_a_message_can_be_written():
    class Named:
        data = "hello"

    string = INTERFACES.message("std_msgs/String")
    assert codec(string).encode(Named()) == codec(string).encode(string(data="hello"))


# Refused bytes


def made(text):
    own = Interfaces()
    own.add("pkg", {("msg", "Made"): text})
    return own.message("pkg/Made")


@pytest.mark.parametrize(
    ("text", "body", "told"),
    [
        ("string data", b"", "the next value needs 4 bytes, but only 0 are left"),
        ("string data", struct.pack("<I", 5), "the next value needs 5 bytes, but only 0 are left"),
        ("string data", struct.pack("<I", 2) + b"ab", "does not end with a zero byte"),
        ("string data", struct.pack("<I", 2) + b"\xff\x00", "not UTF-8"),
        ("string data", struct.pack("<I", 4) + b"a\x00b\x00", "continues after its zero byte"),
        ("string<=2 data", struct.pack("<I", 4) + b"abc\x00", "longer than 2 characters"),
        ("float64 data", bytes(7), "the next value needs 8 bytes, but only 7 are left"),
        (
            "float64[] data",
            struct.pack("<I", 1 << 31),
            "announces 2147483648 items, but only 0 bytes",
        ),
        ("uint8[<=2] data", struct.pack("<I", 3) + b"abc", "3 items, but at most 2 are allowed"),
        (
            "string[] data",
            struct.pack("<I", 100) + bytes(99),
            "announces 100 items, but only 99 bytes",
        ),
        ("std_msgs/Header[] d", struct.pack("<I", 9) + bytes(99), "announces 9 items, but only 99"),
        ("uint8 data", b"\x01" + bytes(8), "8 bytes follow after the message"),
        ("uint8[36] data", bytes(35), "the next value needs 36 bytes, but only 35 are left"),
    ],
)
def test_bytes_that_are_no_such_message_are_refused_with_the_reason(text, body, told):
    with pytest.raises(MalformedMessage, match=told):
        Codec(made(text)).decode(CDR.header + body)


@pytest.mark.parametrize(
    ("payload", "told"),
    [
        (b"", "0 bytes are too few for a message with a header"),
        (b"\x00\x07\x00\x00" + bytes(8), "header 0007 is not a header of plain CDR"),
    ],
)
def test_a_header_of_another_encoding_is_refused(payload, told):
    with pytest.raises(MalformedMessage, match=told):
        codec(INTERFACES.message("std_msgs/String")).decode(payload)


def test_a_message_larger_than_we_read_is_refused_unread(monkeypatch):
    monkeypatch.setattr(layouts, "LARGEST", 100)

    with pytest.raises(MalformedMessage, match="more than the maximum"):
        codec(INTERFACES.message("std_msgs/String")).decode(CDR.header + bytes(100))


@pytest.mark.parametrize(
    ("text", "item", "most"),
    [
        ("string[] data", b"\x01\0\0\0\0\0\0\0", 5),
        ("std_msgs/String[] data", b"\x01\0\0\0\0\0\0\0", 5),
        # Each item of the outer list contains one item of the inner list.
        ("std_msgs/MultiArrayLayout[] data", struct.pack("<IIIIII", 1, 1, 0, 2, 3, 4), 2),
    ],
)
def test_more_texts_and_messages_than_we_make_are_refused(monkeypatch, text, item, most):
    monkeypatch.setattr(layouts, "MOST_ITEMS", 5)

    def body(count):
        return CDR.header + struct.pack("<I", count) + item * count

    assert len(Codec(made(text)).decode(body(most)).data) == most
    with pytest.raises(MalformedMessage, match="contain more than 5 strings and messages"):
        Codec(made(text)).decode(body(most + 1))


def test_an_empty_message_may_come_without_its_byte():
    empty = INTERFACES.find("std_srvs", "srv", "Empty").Request

    assert codec(empty).encode(empty()) == CDR.header + b"\x00"
    assert codec(empty).decode(CDR.header + b"\x00") == empty()
    assert codec(empty).decode(CDR.header) == empty()


@pytest.mark.parametrize(
    ("text", "name", "value", "told"),
    [
        ("string data", "data", "a\0b", "zero character"),
        ("string[] data", "data", [5], "does not fit"),
        ("std_msgs/Header[] data", "data", [5], "does not fit"),
        ("float64[] data", "data", array.array("d", [1.0]), ""),
        ("uint8[<=2] data", "data", array.array("B", [1, 2, 3]), "at most 2 values, not 3"),
        ("float64[3] data", "data", np.zeros(2), "needs 3 values, not 2"),
    ],
)
def test_a_value_that_was_changed_in_place_and_does_not_fit_is_not_written(text, name, value, told):
    kind = made(text)
    message = kind()
    # This assignment is not checked, like an append to a list.
    setattr(message, f"_{name}", value)

    if not told:
        assert list(Codec(kind).decode(Codec(kind).encode(message)).data) == list(value)
        return
    with pytest.raises(MalformedMessage, match=told):
        Codec(kind).encode(message)


def test_a_wstring_is_not_carried_as_its_bytes_differ_between_releases():
    with pytest.raises(MalformedMessage, match="field 'data' is a wstring"):
        Codec(made("wstring data"))


def test_a_type_that_unfolds_to_ever_more_fields_is_refused_and_not_planned():
    doubling = {("msg", f"D{level}"): f"D{level + 1} a\nD{level + 1} b" for level in range(30)}
    own = Interfaces()
    own.add("pkg", {**doubling, ("msg", "D30"): "int8 x"})

    with pytest.raises(MalformedMessage, match="expands to more than 50000 fields"):
        Codec(own.message("pkg/D0"))


@pytest.mark.parametrize("layout", [CDR, ROS1])
@pytest.mark.parametrize("count", [0, 1, 5, 1500, 300_000])
def test_arrays_of_any_size_and_kind_are_written_as_they_lie_in_memory(store, layout, count):
    kind = made("string head\nuint8[] bytes\nuint16[] words\nfloat64[] numbers\nint8 end")
    numbers = [float(one) for one in range(count)]
    words = [one % 60_000 for one in range(count)]
    message = kind(head="x", bytes=[one % 256 for one in words], words=words, end=7)
    message.numbers = numbers
    expected = Codec(kind, layout).encode(message)

    class Held:
        head, end = "x", 7
        bytes = (np.arange(count) % 60_000 % 256).astype(np.uint8)
        words = (np.arange(count) % 60_000).astype(np.uint16)
        numbers = np.arange(count, dtype=np.float64)

    assert Codec(kind, layout).encode(Held) == expected
    assert Codec(kind, layout).decode(expected) == message
    offset = len(layout.header)
    assert expected[offset : offset + 4] == struct.pack("<I", 1 + (layout is CDR))
    assert expected[-1] == 7


def test_a_decoded_message_does_not_change_with_the_bytes_it_was_decoded_from():
    kind = made("uint8[] data\nfloat64[3] fixed\nstring name")
    raw = bytearray(Codec(kind).encode(kind(data=[1, 2], fixed=[1.0, 2.0, 3.0], name="a")))

    read = Codec(kind).decode(memoryview(raw))
    raw[:] = bytes(len(raw))

    assert read == kind(data=[1, 2], fixed=[1.0, 2.0, 3.0], name="a")


def test_an_image_is_copied_once_on_its_way_out_and_once_on_its_way_in():
    kind = INTERFACES.message("sensor_msgs/Image")
    image = kind(data=bytes(900_000))
    payload = codec(kind).encode(image)

    def memory_of(way, argument):
        tracemalloc.start()
        try:
            made = way(argument)
            return tracemalloc.get_traced_memory()[1] / len(payload), made
        finally:
            tracemalloc.stop()

    written, again = memory_of(codec(kind).encode, image)
    read, message = memory_of(codec(kind).decode, payload)

    assert again == payload
    assert message == image
    assert written < 1.2
    # A growing array reserves memory in advance.
    assert read < 1.3


def test_a_hundred_thousand_hostile_payloads_leave_memory_flat():
    chance = random.Random(2026)
    cases = []
    for full in TYPES:
        kind = INTERFACES.part(full)
        for layout in (CDR, ROS1):
            own = Codec(kind, layout)
            cases.append((own.decode, own.encode(filled(chance, kind))))
    read = refused = 0

    try:
        for number in range(100_000):
            if number == 90_000:
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

    assert read + refused == 100_000
    assert refused > 10_000
    assert peak < 2_000_000
