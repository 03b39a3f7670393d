"""Our bytes against rosbags' codec, and against everything a stranger may send."""

import random
import struct
import tracemalloc

import numpy as np
import pytest

from tests.link import definitions
from tftool.errors import MalformedMessage
from tftool.frames.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.link import cdr, types
from tftool.link.cdr import Layout

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

    assert cdr.encode_transforms(samples) == payload
    assert cdr.decode_transforms(payload) == samples


def test_the_array_path_reads_what_the_scalar_path_reads():
    samples = transforms(random.Random(7), 500)
    payload = cdr.encode_transforms(samples)

    columns = cdr.decode_columns(payload)

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
    columns = cdr.decode_columns(cdr.encode_transforms([]))

    assert len(columns) == 0
    assert columns.translations.shape == (0, 3)


def plain(value):
    """A rosbags message as nested tuples, its parts flattened into it as layouts see them."""
    if hasattr(value, "__dataclass_fields__"):
        names = [name for name in value.__dataclass_fields__ if name.islower() and name[0] != "_"]
        if names == ["uuid"]:
            return (bytes(value.uuid),)
        if names == ["structure_needs_at_least_one_member"]:
            return ()
        return tuple(part for name in names for part in plain(getattr(value, name)))
    if isinstance(value, list | tuple | np.ndarray):
        parts = [plain(one) for one in value]
        return (tuple(part[0] if len(part) == 1 else part for part in parts),)
    return (value.item() if hasattr(value, "item") else value,)


UUID = bytes(range(16))
SAMPLES = [
    (types.MESSAGES[types.Pose2D].layout, (1.5, -2.25, 3.0, 0.0, -1.0)),
    (types.MESSAGES[types.Color].layout, (0, 128, 255)),
    (types.MESSAGES[types.Twist2D].layout, (1.0, 2.0, 3.0, 4.0, 5.0, 1e-300)),
    (types.SERVICES["spawn"].request.layout, (4.0, 2.0, 0.0, "turtle2")),
    (types.SERVICES["spawn"].response.layout, ("turtle2",)),
    (types.SERVICES["kill"].request.layout, ("größe",)),
    (types.SERVICES["kill"].response.layout, ()),
    (types.SERVICES["clear"].request.layout, ()),
    (types.SERVICES["clear"].response.layout, ()),
    (types.SERVICES["set_pen"].request.layout, (1, 2, 3, 4, 0)),
    (types.SERVICES["teleport_absolute"].request.layout, (1.0, 2.0, 0.5)),
    (types.SERVICES["teleport_relative"].request.layout, (1.0, -0.5)),
    (types.SEND_GOAL_REQUEST, (UUID, 1.5)),
    (types.SEND_GOAL_RESPONSE, (True, 1_700_000_000, 999_999_999)),
    (types.GET_RESULT_REQUEST, (UUID,)),
    (types.GET_RESULT_RESPONSE, (4, -1.5)),
    (types.FEEDBACK_MESSAGE, (UUID, 0.25)),
    (types.CANCEL_REQUEST, (UUID, -5, 7)),
    (types.CANCEL_RESPONSE, (0, ((UUID, 1, 2), (UUID, 3, 4)))),
    (types.STATUS_MESSAGE, (((UUID, 1, 2, 4), (UUID, 3, 4, -1)),)),
    (types.GET_PARAMETERS_REQUEST, (("background_r", "x", ""),)),
    (
        types.GET_PARAMETERS_RESPONSE,
        (tuple(types.parameter_fields(one) for one in (69, True, 1.5, "a", None)),),
    ),
    (
        types.SET_PARAMETERS_REQUEST,
        ((("background_r", *types.parameter_fields(255)), ("b", *types.parameter_fields("c"))),),
    ),
    (types.SET_PARAMETERS_RESPONSE, (((True, ""), (False, "no")),)),
]


@pytest.mark.parametrize(("layout", "values"), SAMPLES, ids=lambda part: getattr(part, "kind", ""))
def test_every_type_has_the_bytes_rosbags_reads_and_writes(store, layout, values):
    payload = layout.encode(values)

    message = store.deserialize_cdr(payload, layout.kind)
    assert plain(message) == values
    assert bytes(store.serialize_cdr(message, layout.kind)) == payload
    assert layout.decode(payload) == values


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        (types.Pose2D(1.0, 2.0, 0.5, 1.5, -0.5), types.MESSAGES[types.Pose2D]),
        (types.Color(1, 2, 3), types.MESSAGES[types.Color]),
        (types.Twist2D(linear_x=2.0, angular_z=1.0, linear_y=0.5), types.MESSAGES[types.Twist2D]),
        (types.Spawn(4.0, 2.0, 0.0, "turtle2"), types.SERVICES["spawn"].request),
        (types.Spawned("turtle2"), types.SERVICES["spawn"].response),
        (types.SetPen(255, 0, 0, 5, 1), types.SERVICES["set_pen"].request),
        (types.Clear(), types.SERVICES["clear"].request),
        (None, types.SERVICES["clear"].response),
    ],
)
def test_our_values_come_back_as_they_went(value, kind):
    assert kind.decode(kind.encode(value)) == value


def test_a_service_is_known_by_the_last_part_of_its_name():
    assert types.service_type("turtle1/set_pen") is types.SERVICES["set_pen"]
    assert types.service_type("turtle1/dance") is None


def test_a_list_is_no_setting_of_ours():
    fields = (6, False, 0, 0.0, "", (1, 2), (), (), (), ())

    with pytest.raises(MalformedMessage, match="type 6 is none of"):
        types.parameter_value(fields)
    assert types.parameter_value(types.parameter_fields("blue")) == "blue"


# What is refused, and why


ONE = cdr.encode_transforms(transforms(random.Random(1), 1))


@pytest.mark.parametrize(
    ("payload", "told"),
    [
        (b"", "0 bytes are too few for a header"),
        (b"\x00\x01\x00\x00", "ends before its number of transforms"),
        (b"\x00\x00\x00\x00" + ONE[4:], "header 0000 is not that of little-endian CDR"),
        (ONE[:4] + b"\xff\xff\xff\xff" + ONE[8:], "announces 4294967295 transforms and has room"),
        (ONE[:16] + b"\xff\xff\xff\xff" + ONE[20:], "a text announces 4294967295 bytes"),
        (ONE[:-9], "ends within transform 1 of 1|has room for 0"),
        (ONE + bytes(8), "8 bytes are left over"),
    ],
)
@pytest.mark.parametrize("decode", [cdr.decode_transforms, cdr.decode_columns])
def test_transforms_that_do_not_fit_are_refused_with_the_reason(decode, payload, told):
    with pytest.raises(MalformedMessage, match=told):
        decode(payload)


def one_named(raw):
    body = struct.pack("<IiII", 1, 0, 0, len(raw)) + raw
    body += bytes(-len(body) % 4) + struct.pack("<I", 2) + b"c\x00"
    return cdr.HEADER + body + bytes(-len(body) % 8) + bytes(56)


@pytest.mark.parametrize(
    ("raw", "told"),
    [
        (b"abcd", "does not end with its zero byte"),
        (b"\xff\xfe\x00", "not UTF-8"),
        (b"a\x00b\x00", "goes on behind its zero byte"),
    ],
)
@pytest.mark.parametrize("decode", [cdr.decode_transforms, cdr.decode_columns])
def test_a_name_that_is_no_text_is_refused(decode, raw, told):
    with pytest.raises(MalformedMessage, match=told):
        decode(one_named(raw))


def test_a_message_larger_than_we_read_is_refused_unread(monkeypatch):
    monkeypatch.setattr(cdr, "LARGEST", 100)

    with pytest.raises(MalformedMessage, match="more than we read"):
        cdr.decode_transforms(ONE + bytes(100))


def test_a_list_cannot_announce_more_items_than_bytes():
    layout = Layout("test/List", "[u]")

    with pytest.raises(MalformedMessage, match="announces 1000000 items and 0 bytes"):
        layout.decode(cdr.HEADER + struct.pack("<I", 1_000_000))


@pytest.mark.parametrize(
    ("layout", "values", "told"),
    [
        (Layout("test/Byte", "B"), (256,), "does not fit"),
        (Layout("test/Two", "BB"), (1,), "1 values for 2 fields"),
        (Layout("test/Id", "u"), (b"short",), "5 bytes are not 16"),
        (Layout("test/Text", "s"), ("a\x00b",), "zero character"),
        (Layout("test/Text", "s"), (5,), "does not fit"),
    ],
)
def test_a_value_that_does_not_fit_its_field_is_not_written(layout, values, told):
    with pytest.raises(MalformedMessage, match=told):
        layout.encode(values)


def test_a_stamp_beyond_32_bits_of_seconds_is_not_written():
    late = TransformStamped(2**31 * 1_000_000_000, "a", "b", Transform())

    with pytest.raises(MalformedMessage, match="32-bit seconds"):
        cdr.encode_transforms([late])


def test_an_empty_struct_may_come_without_its_byte():
    assert types.SERVICES["clear"].request.layout.decode(cdr.HEADER) == ()


def mutations(chance, payload):
    raw = bytearray(payload)
    for _ in range(chance.randrange(1, 4)):
        what = chance.randrange(4)
        place = chance.randrange(len(raw)) if raw else 0
        if what == 0 and raw:
            raw[place] = chance.randrange(256)
        elif what == 1:
            del raw[place:]
        elif what == 2:
            raw[place:place] = chance.randbytes(chance.randrange(1, 12))
        elif len(raw) >= 4:
            place &= ~3
            raw[place : place + 4] = chance.choice(
                [b"\xff\xff\xff\xff", b"\x00\x00\x00\x80", b"\xff\xff\xff\x7f", b"\x00\x00\x00\x00"]
            )
    return bytes(raw)


def test_a_hundred_thousand_hostile_payloads_are_read_or_refused_and_memory_stays_flat():
    chance = random.Random(2026)
    seeds = [cdr.encode_transforms(transforms(chance, count)) for count in (0, 1, 2, 5)]
    layouts = [(layout.decode, layout.encode(values)) for layout, values in SAMPLES]
    cases = [(cdr.decode_transforms, seed) for seed in seeds] * 4
    cases += [(cdr.decode_columns, seed) for seed in seeds] + layouts
    read = refused = 0

    try:
        for number in range(100_000):
            if number == 90_000:
                # Watched at the end alone: watching makes everything three times slower.
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


def test_strangers_with_ever_new_names_do_not_fill_the_memory_for_names():
    for number in range(10_000):
        cdr.decode_transforms(one_named(f"frame{number}".encode() + b"\x00"))
        cdr.encode_transforms([TransformStamped(0, f"f{number}", "b", Transform())])

    assert len(cdr._names) <= 4096
    assert len(cdr._heads) <= 4096
