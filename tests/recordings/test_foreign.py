"""Tests of transforms in other types than ROS's own lists."""

import io
import json
import struct

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from mcap.writer import Writer

from tests.recordings.writers import ROS2, SECOND, numbers
from tftool import open_recording

STAMP = 1_750_000_000 * SECOND + 5
SEVEN = numbers(4)


def varint(value):
    found = bytearray()
    while value > 0x7F:
        found.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*found, value])


def field(number, payload):
    return varint(number << 3 | 2) + varint(len(payload)) + payload


def doubles(values):
    return b"".join(varint(n << 3 | 1) + struct.pack("<d", v) for n, v in enumerate(values, 1))


def protobuf(seven=SEVEN):
    time = varint(8) + varint(STAMP // SECOND) + varint(16) + varint(STAMP % SECOND)
    parts = field(1, time) + field(2, b"map") + field(3, b"base")
    return parts + field(4, doubles(seven[:3])) + field(5, doubles(seven[3:]))


def in_json():
    return {
        "timestamp": {"sec": STAMP // SECOND, "nsec": STAMP % SECOND},
        "parent_frame_id": "map",
        "child_frame_id": "base",
        "translation": dict(zip("xyz", SEVEN[:3], strict=True)),
        "rotation": dict(zip("xyzw", SEVEN[3:], strict=True)),
    }


def in_ros_json(seconds="sec", rest="nanosec"):
    one = in_json()
    return {
        "header": {
            "stamp": {seconds: STAMP // SECOND, rest: STAMP % SECOND},
            "frame_id": "map",
        },
        "child_frame_id": "base",
        "transform": {"translation": one["translation"], "rotation": one["rotation"]},
    }


def written(path, kind, encoding, payloads, text="", topic="/poses"):
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start()
    schema = writer.register_schema(kind, "ros2msg" if text else encoding, text.encode())
    channel = writer.register_channel(topic, encoding, schema)
    for number, payload in enumerate(payloads):
        writer.add_message(channel, STAMP + number, payload, STAMP)
    writer.finish()
    path.write_bytes(stream.getvalue())
    return path


def only(recording, topics=None):
    (edge,) = recording.source.transforms(topics).edges
    (row,) = zip(edge.stamps, edge.translations, edge.rotations, strict=True)
    return edge.parent, edge.child, int(row[0]), (*row[1].tolist(), *row[2].tolist())


@pytest.mark.parametrize(
    ("kind", "encoding", "payload"),
    [
        ("foxglove.FrameTransform", "protobuf", protobuf()),
        ("foxglove.FrameTransforms", "protobuf", field(1, protobuf())),
        ("foxglove.FrameTransform", "json", json.dumps(in_json()).encode()),
        ("foxglove.FrameTransforms", "json", json.dumps({"transforms": [in_json()]}).encode()),
        ("geometry_msgs/msg/TransformStamped", "json", json.dumps(in_ros_json()).encode()),
        (
            "tf2_msgs/msg/TFMessage",
            "json",
            json.dumps({"transforms": [in_ros_json()]}).encode(),
        ),
        (
            "tf2_msgs/TFMessage",
            "json",
            json.dumps({"transforms": [in_ros_json("secs", "nsecs")]}).encode(),
        ),
    ],
)
def test_foxglove_transforms_are_transforms(tmp_path, kind, encoding, payload):
    with open_recording(written(tmp_path / "a.mcap", kind, encoding, [payload])) as recording:
        assert only(recording) == ("map", "base", STAMP, SEVEN)
        assert recording.topics[0].transforms


def test_numbers_that_are_zero_may_be_left_out(tmp_path):
    payload = field(2, b"map") + field(3, b"base")
    file = written(tmp_path / "a.mcap", "foxglove.FrameTransform", "protobuf", [payload])
    with open_recording(file) as recording:
        assert only(recording) == ("map", "base", 0, (0, 0, 0, 0, 0, 0, 1))


@pytest.mark.parametrize(
    ("encoding", "payload"),
    [
        ("protobuf", protobuf()[:-3]),
        ("protobuf", b"\xff" * 20),
        ("protobuf", b"\x10" + varint(10**15)),
        ("json", b"[]"),
        ("json", b"[" * 100_000),
        ("json", json.dumps(in_json()).encode()[:-9]),
    ],
)
def test_a_broken_one_is_left_out_and_told(tmp_path, encoding, payload):
    whole = protobuf() if encoding == "protobuf" else json.dumps(in_json()).encode()
    file = written(tmp_path / "a.mcap", "foxglove.FrameTransform", encoding, [payload, whole])
    with open_recording(file) as recording:
        assert only(recording) == ("map", "base", STAMP, SEVEN)
        assert "1 message was left out" in recording.transforms.damage[0]


def message(kind):
    types = ROS2.types
    place = types["geometry_msgs/msg/Vector3"](*SEVEN[:3])
    point = types["geometry_msgs/msg/Point"](*SEVEN[:3])
    turn = types["geometry_msgs/msg/Quaternion"](*SEVEN[3:])
    time = types["builtin_interfaces/msg/Time"](STAMP // SECOND, STAMP % SECOND)
    header = types["std_msgs/msg/Header"](time, "map")
    if kind == "geometry_msgs/msg/TransformStamped":
        pose = types["geometry_msgs/msg/Transform"](place, turn)
        return types[kind](header, "base", pose)
    return types[kind](header, types["geometry_msgs/msg/Pose"](point, turn))


@pytest.mark.parametrize(
    ("kind", "topics", "child"),
    [
        ("geometry_msgs/msg/TransformStamped", None, "base"),
        ("geometry_msgs/msg/PoseStamped", ["/poses"], "poses"),
    ],
)
def test_stamped_messages_are_transforms(tmp_path, kind, topics, child):
    payload = bytes(ROS2.serialize_cdr(message(kind), kind))
    text = ROS2.generate_msgdef(kind, ros_version=2)[0]
    with open_recording(written(tmp_path / "a.mcap", kind, "cdr", [payload], text)) as recording:
        assert only(recording, topics) == ("map", child, STAMP, SEVEN)
        assert len(recording.transforms) == (topics is None)


def test_a_type_that_cannot_be_understood_is_left_out(tmp_path):
    kind = "geometry_msgs/msg/TransformStamped"
    file = written(tmp_path / "a.mcap", kind, "cdr", [b"x"], "no_such/Type[ field")
    with open_recording(file) as recording:
        assert len(recording.transforms) == 0
        assert "'/poses' is left out" in recording.damage[0]


@pytest.mark.parametrize(("tf_topics", "parents"), [((), {"map"}), (("/poses",), {"vicon"})])
def test_single_transforms_beside_tf_are_read_only_on_request(tmp_path, tf_topics, parents):
    single, listed = "geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage"
    own = message(single)
    own.header.frame_id = "vicon"
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start()
    for topic, kind, sent in (
        ("/tf", listed, ROS2.types[listed]([message(single)])),
        ("/poses", single, own),
    ):
        text = ROS2.generate_msgdef(kind, ros_version=2)[0]
        schema = writer.register_schema(kind, "ros2msg", text.encode())
        channel = writer.register_channel(topic, "cdr", schema)
        writer.add_message(channel, STAMP, bytes(ROS2.serialize_cdr(sent, kind)), STAMP)
    writer.finish()
    (tmp_path / "a.mcap").write_bytes(stream.getvalue())
    with open_recording(tmp_path / "a.mcap", tf_topics=tf_topics) as recording:
        assert recording.buffer.parents("base") == parents


@pytest.mark.parametrize(
    ("kind", "payload"),
    [
        ("tf2_msgs/msg/TFMessage", {"transforms": [in_ros_json()]}),
        ("foxglove.FrameTransform", in_json()),
    ],
)
@pytest.mark.parametrize("edit", [("--rename", "map=world"), ("--drop", "map:base")])
def test_an_edit_says_which_transforms_it_cannot_change(tftool, tmp_path, kind, payload, edit):
    file = written(tmp_path / "a.mcap", kind, "json", [json.dumps(payload).encode()], topic="/tf")

    done = tftool("edit", file, "-o", tmp_path / "b.mcap", *edit)
    copied = tftool("edit", file, "-o", tmp_path / "c.mcap")

    assert done.status == copied.status == 0
    assert "The transforms on '/tf' are unchanged" in done.err
    assert f"{kind} in json" in done.err
    assert "unchanged" not in copied.err
