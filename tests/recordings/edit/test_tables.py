"""Tests that messages changed in bulk equal messages changed one by one, byte for byte."""

import random
from pathlib import Path

import pytest

pytest.importorskip("rosbags", reason="another implementation")

from tftool import open_recording
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms
from tftool.recordings import chunked
from tftool.recordings.channel import Channel
from tftool.recordings.edit import tables
from tftool.recordings.edit.changes import Edits
from tftool.recordings.edit.rewrite import edit
from tftool.recordings.mcap.write import McapWriter
from tftool.recordings.message_conversion import TRANSFORMS, ros2_channel, ros2_definition
from tftool.recordings.rosbag1.write import Rosbag1Writer

SECOND = 10**9
START = 1_750_000_000 * SECOND
COUNT = 400
POSE = (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0)
EDITS = {
    "nothing": Edits(),
    "rename": Edits(rename={"odom": "wheel_odometry"}),
    "strip and prefix": Edits(prefix="r1/", strip_slash=True),
    "drop": Edits(drop=(("odom", "base_link"),)),
    "drop all": Edits(drop=(("*", "*"),)),
    "set": Edits(poses={("base_link", "arm"): POSE}),
    "set and rename": Edits(poses={("odom", "base_link"): POSE}, rename={"arm": "boom"}),
    "shift": Edits(shift=SECOND),
    "cut": Edits(start=START + SECOND, end=START + 3 * SECOND),
    "cut by log": Edits(start=START + SECOND, end=START + 3 * SECOND, by_record_time=True),
    "cut and rename": Edits(start=START + SECOND, rename={"arm": "boom"}),
}


def payload(number: int, draw: random.Random) -> bytes:
    """Return a message of one of several kinds; some are unusual."""
    now = START + number * SECOND // 100
    pose = Transform((number / 7.0, draw.random(), 0.0))
    rows = [TransformStamped(now, "odom", "base_link", pose)]
    if number % 3:
        rows.append(TransformStamped(now - SECOND // 50, "base_link", "arm", pose))
    if number % 50 == 7:
        rows.append(TransformStamped(now, "/base_link", f"seen_{number}", pose))
    if number % 97 == 5:
        rows = []
    found = bytearray(encode_transforms(rows))
    if rows and number % 2:
        # Padding between a name and the numbers, which some writers do not set to zero
        place = found.index(b"base_link\x00") + len(b"base_link\x00")
        if not any(found[place : place + 2]) and (place - 4) % 8:
            found[place] = draw.randrange(256)
    return bytes(found[: len(found) - 9] if number % 113 == 9 else found)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory) -> Path:
    """Record transforms, static ones, and messages of other lengths and types between them."""
    path = tmp_path_factory.mktemp("tables") / "run.mcap"
    draw = random.Random(4)
    writer = McapWriter(path, compression="lz4", chunk_size=8000)
    tf = writer.channel(ros2_channel("/tf", TRANSFORMS))
    other = writer.channel(ros2_channel("/robot/tf", TRANSFORMS))
    static = writer.channel(ros2_channel("/tf_static", TRANSFORMS, static=True))
    text = ros2_definition("std_msgs/msg/String").encode()
    words = writer.channel(Channel("/words", "std_msgs/msg/String", "cdr", "ros2msg", text))
    mount = TransformStamped(START, "base_link", "laser", Transform((0.2, 0.0, 0.0)))
    for number in range(COUNT):
        now = START + number * SECOND // 100
        if number % 20 == 3:
            word = b"x" * draw.randrange(1, 40) + b"\x00"
            writer.write(words, now, b"\0\1\0\0" + len(word).to_bytes(4, "little") + word, now, 9)
        if number % 100 == 1:
            writer.write(static, now, encode_transforms([mount]))
        topic = other if number % 5 == 4 else tf
        writer.write(topic, now + draw.randrange(-9, 9), payload(number, draw), now - 3, number)
    writer.finish()
    return path


@pytest.fixture(scope="module")
def bag(tmp_path_factory) -> Path:
    """Write the same messages, without the damaged ones, to a ROS 1 bag."""
    path = tmp_path_factory.mktemp("tables") / "run.bag"
    whole = path.with_suffix(".mcap")
    writer = McapWriter(whole, compression="none", chunk_size=8000)
    tf = writer.channel(ros2_channel("/tf", TRANSFORMS))
    draw = random.Random(5)
    for number in range(COUNT):
        if number % 113 != 9:
            now = START + number * SECOND // 100
            writer.write(tf, now, payload(number, draw))
    writer.finish()
    edit([str(whole)], path, Edits())
    return path


@pytest.mark.parametrize("name", EDITS)
@pytest.mark.parametrize(
    ("source", "suffix"),
    [("recorded", ".mcap"), ("recorded", ".db3"), ("bag", ".bag"), ("bag", ".mcap")],
)
def test_at_once_and_one_by_one_are_the_same(source, suffix, name, request, tmp_path, monkeypatch):
    path = request.getfixturevalue(source)
    fast, slow = tmp_path / f"fast{suffix}", tmp_path / f"slow{suffix}"
    reports = [edit([str(path)], fast, EDITS[name])]
    # Without indexes, kinds and bulk writing, every message is processed like an unusual one.
    monkeypatch.setattr(chunked.ChunkedReader, "indexed_table", lambda self, chunk: None)
    monkeypatch.setattr(tables.Kinds, "groups", lambda self, table, which: ([], which))
    for writer in (McapWriter, Rosbag1Writer):
        monkeypatch.setattr(writer, "write_table", lambda self, table: False)
    reports.append(edit([str(path)], slow, EDITS[name]))

    assert reports[0].counts == reports[1].counts
    assert reports[0].messages == reports[1].messages
    if suffix == ".db3":
        assert rows(fast) == rows(slow)
    else:
        assert fast.read_bytes() == slow.read_bytes()


def test_names_change_and_stamps_and_numbers_stay(recorded, tmp_path):
    out = tmp_path / "out.mcap"
    edit([str(recorded)], out, Edits(rename={"odom": "wheel_odometry"}))

    with open_recording(recorded) as before, open_recording(out) as after:
        names = {(edge.parent, edge.child) for edge in before.edges}
        assert {(edge.parent, edge.child) for edge in after.edges} == {
            (parent.replace("odom", "wheel_odometry"), child) for parent, child in names
        }
        pairs = zip(before.edges, after.edges, strict=True)
        assert all((old.records == new.records).all() for old, new in pairs)


def rows(path):
    """Return the messages of a database."""
    with open_recording(path) as recording:
        return [
            (one.log_time, one.sender.topic, one.payload)
            for topic in recording.topics
            for one in recording.raw_messages(topic.name)
        ]
