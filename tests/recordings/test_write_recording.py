"""Tests that files of `tftool.write_recording` can be read by other readers and by tftool."""

import os

import pytest

pytest.importorskip("rosbags", reason="reads what is written")

from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

import tftool
from tests.recordings.writers import numbers
from tftool.base.errors import InputError, UsageError

START = 1_750_000_000 * 10**9
NAMES = [
    ("a.mcap", {}),
    ("a.db3", {}),
    ("a.bag", {}),
    ("b.bag", {"compression": "bz2"}),
    ("folder", {}),
    ("other", {"storage": "sqlite3"}),
]


def sample(stamp, parent, child, seed):
    seven = numbers(seed)
    return tftool.TransformStamped(stamp, parent, child, tftool.Transform(seven[:3], seven[3:]))


@pytest.mark.parametrize(("name", "options"), NAMES)
def test_a_written_recording_is_read_back(tmp_path, name, options):
    path = tmp_path / name
    mount = sample(0, "base", "laser", 1)
    drive = [sample(START + tick * 1000, "odom", "base", tick + 2) for tick in range(50)]

    with tftool.write_recording(path, **options) as recording:
        recording.static_transforms([mount], log_time=START)
        for one in drive:
            recording.transforms([one])
        text = recording.new_message("std_msgs/String")
        text.data = "words"
        recording.message("/notes", text, START + 70_000)

    assert os.listdir(tmp_path) == [name]
    with tftool.open_recording(path) as recording:
        edges = {edge.child: edge for edge in recording.edges}
        assert recording.damage == ()
        assert edges["laser"].static
        assert edges["base"].stamps.tolist() == [one.stamp for one in drive]
        assert edges["base"].rotations.tolist() == [list(one.transform.rotation) for one in drive]
        assert [message.data for _, message in recording.messages("/notes")] == ["words"]
        assert recording.source.end == START + 70_000


@pytest.mark.parametrize(
    ("name", "options"), [one for one in NAMES if "." not in one[0] or "bag" in one[0]]
)
def test_rosbags_reads_it(tmp_path, name, options):
    path = tmp_path / name
    with tftool.write_recording(path, **options) as recording:
        recording.static_transforms([sample(0, "base", "laser", 1)], log_time=START)
        for tick in range(20):
            recording.transforms([sample(START + tick, "odom", "base", tick)])

    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        found = [
            one.child_frame_id
            for connection, _, raw in reader.messages()
            for one in reader.deserialize(raw, connection.msgtype).transforms
        ]
        latched = {
            connection.topic: connection.ext.offered_qos_profiles[0].durability.name
            for connection in reader.connections
            if hasattr(connection.ext, "offered_qos_profiles")
        }

    assert found == ["laser", *["base"] * 20]
    assert latched in ({}, {"/tf": "VOLATILE", "/tf_static": "TRANSIENT_LOCAL"})


def test_a_recording_that_cannot_be_written_leaves_no_files(tmp_path):
    with pytest.raises(UsageError, match="does not end in the suffix of a recording"):
        tftool.write_recording(tmp_path / "a.txt")
    with pytest.raises(UsageError, match="not a compression of ROS 1 bags"):
        tftool.write_recording(tmp_path / "a.bag", compression="zstd")
    with pytest.raises(UsageError, match="not compressed"):
        tftool.write_recording(tmp_path / "a.db3", compression="zstd")
    with pytest.raises(UsageError, match="not a storage"):
        tftool.write_recording(tmp_path / "a", storage="papyrus")
    with pytest.raises(InputError, match="no folder"):
        tftool.write_recording(tmp_path / "nowhere" / "a")

    assert os.listdir(tmp_path) == []
