"""Tests of growing recordings: initial static transforms, rings, kills and full disks."""

import os

import pytest

pytest.importorskip("mcap", reason="reads what is written")

from mcap.reader import SeekingReader
from mcap.stream_reader import StreamReader

from tests.full_disk import full_disk
from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transforms import encode_transforms
from tftool.recordings.message_conversion import TRANSFORMS, ros2_channel
from tftool.recordings.recording import open_recording
from tftool.recordings.rolling_writer import RecordLimits, RollingRecording

START = seconds(1_750_000_000)
TF = ros2_channel("/tf", TRANSFORMS)
STATIC = ros2_channel("/tf_static", TRANSFORMS, static=True)


def sample(stamp, parent, child, x=0.0):
    return TransformStamped(stamp, parent, child, Transform((x, 0.0, 0.0)))


def take(rolling, channel, now, *samples):
    rolling.take(channel, now, encode_transforms(samples), len(samples))


def drive(rolling, ticks, period=seconds(0.1)):
    """Record two static frames at the beginning, one of them again later, and a moving frame."""
    take(rolling, STATIC, START, sample(0, "base", "laser", 1.0), sample(0, "base", "imu", 2.0))
    for tick in range(ticks):
        now = START + tick * period
        if tick == ticks // 2:
            take(rolling, STATIC, now, sample(0, "base", "laser", 3.0))
        take(rolling, TF, now, sample(now, "odom", "base", float(tick)))
        rolling.tick(now)


def statics(path):
    with open_recording(path) as recording:
        return {
            edge.child: edge.translations[0, 0].item() for edge in recording.edges if edge.static
        }


def moving(path):
    with open_recording(path) as recording:
        return [
            x
            for edge in recording.edges
            if edge.child == "base"
            for x in edge.translations[:, 0].tolist()
        ]


def strictly_read(path):
    with path.open("rb") as file:
        list(StreamReader(file, validate_crcs=True).records)
    with path.open("rb") as file:
        return sum(1 for _ in SeekingReader(file, validate_crcs=True).iter_messages())


def test_a_file_has_its_name_only_when_it_is_closed(tmp_path):
    rolling = RollingRecording(tmp_path / "a.mcap")
    drive(rolling, 50)
    before = os.listdir(tmp_path)

    rolling.close()

    assert before == ["a.mcap.active"]
    assert os.listdir(tmp_path) == ["a.mcap"]
    assert strictly_read(tmp_path / "a.mcap") == 52
    assert moving(tmp_path / "a.mcap") == list(range(50))
    assert (rolling.messages, rolling.transforms) == (52, 53)


@pytest.mark.parametrize(
    "limits", [RecordLimits(duration=seconds(2)), RecordLimits(size=2000)], ids=["time", "size"]
)
def test_every_file_of_a_split_recording_begins_with_the_latest_statics(tmp_path, limits):
    rolling = RollingRecording(tmp_path / "run", limits, compression="none")
    drive(rolling, 100)
    rolling.close()

    files = rolling.files
    assert len(files) > 3
    assert [name for name in os.listdir(tmp_path / "run") if "active" in name] == []
    for name in files:
        path = tmp_path / "run" / name
        strictly_read(path)
        found = statics(path)
        assert set(found) == {"laser", "imu"}
        with open_recording(path) as recording:
            first = next(recording.raw_messages("/tf_static")).log_time
            assert first == recording.source.start
    assert statics(tmp_path / "run" / files[-1]) == {"laser": 3.0, "imu": 2.0}
    assert moving(tmp_path / "run") == list(range(100))
    with open_recording(tmp_path / "run") as recording:
        assert recording.damage == ()


def test_rosbags_reads_the_folder(tmp_path):
    reader = pytest.importorskip("rosbags.highlevel", reason="reads what is written")
    rolling = RollingRecording(tmp_path / "run", RecordLimits(duration=seconds(2)))
    drive(rolling, 60)
    rolling.close()

    with reader.AnyReader([tmp_path / "run"]) as opened:
        stamps = [stamp for connection, stamp, _ in opened.messages() if connection.topic == "/tf"]

    assert stamps == [START + tick * seconds(0.1) for tick in range(60)]


def test_a_ring_keeps_the_last_of_it_and_all_statics(tmp_path):
    rolling = RollingRecording(tmp_path / "a.mcap", RecordLimits(ring=seconds(3)))
    drive(rolling, 200)
    before = os.listdir(tmp_path)
    rolling.close()

    assert before == []
    assert moving(tmp_path / "a.mcap") == list(range(169, 200))
    assert statics(tmp_path / "a.mcap") == {"laser": 3.0, "imu": 2.0}
    strictly_read(tmp_path / "a.mcap")


def test_a_ring_says_in_the_end_what_it_wrote(tmp_path):
    rolling = RollingRecording(tmp_path / "a.mcap", RecordLimits(ring=seconds(3)))
    drive(rolling, 200)
    rolling.close()

    with open_recording(tmp_path / "a.mcap") as recording:
        assert rolling.messages == sum(topic.count for topic in recording.topics)
        assert rolling.transforms == sum(len(edge.stamps) for edge in recording.edges)
    assert rolling.transforms < 60


def test_of_a_recorder_that_was_killed_a_second_is_missing_at_most(tmp_path):
    rolling = RollingRecording(tmp_path / "a.mcap")
    drive(rolling, 57)

    # The recorder does not close the file, so this is the file that a kill would leave.
    left = tmp_path / "a.mcap.active"
    found = moving(left)

    assert found == list(range(len(found)))
    assert len(found) >= 57 - 11
    with pytest.raises(UsageError, match="'tftool edit"):
        RollingRecording(tmp_path / "a.mcap")
    rolling.discard()


def test_a_quiet_session_is_written_after_a_second_too(tmp_path):
    rolling = RollingRecording(tmp_path / "a.mcap")
    take(rolling, STATIC, START, sample(0, "base", "laser"))

    rolling.tick(START + seconds(1.5))

    assert statics(tmp_path / "a.mcap.active") == {"laser": 0.0}
    rolling.discard()
    assert os.listdir(tmp_path) == []


def test_a_full_disk_is_said_and_what_was_written_can_be_read(tmp_path):
    rolling = RollingRecording(tmp_path / "a.mcap", compression="none")
    with (
        full_disk(12_000),
        pytest.raises(InputError, match="earlier messages can be read in") as refused,
    ):
        drive(rolling, 400)
    rolling.close()

    (name,) = os.listdir(tmp_path)
    assert f"{name}'." in str(refused.value)
    found = moving(tmp_path / name)
    assert len(found) > 20
    assert found == list(range(len(found)))


def test_an_existing_file_is_replaced_only_with_force_and_when_closed(tmp_path):
    path = tmp_path / "a.mcap"
    path.write_bytes(b"precious")

    with pytest.raises(UsageError, match="exists"):
        RollingRecording(path)
    assert path.read_bytes() == b"precious"

    replacing = RollingRecording(path, force=True)
    drive(replacing, 5)
    assert path.read_bytes() == b"precious"
    replacing.close()
    assert moving(path) == list(range(5))


def test_names_that_cannot_hold_it_are_refused(tmp_path):
    with pytest.raises(UsageError, match=r"use '\.mcap'"):
        RollingRecording(tmp_path / "a.bag")
    with pytest.raises(
        UsageError, match=r"several files into a folder: name a folder, without '.mcap'"
    ):
        RollingRecording(tmp_path / "a.mcap", RecordLimits(duration=1))
    with pytest.raises(InputError, match="there is no folder"):
        RollingRecording(tmp_path / "nowhere" / "a.mcap")

    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("precious")
    with pytest.raises(UsageError, match="does not replace folders"):
        RollingRecording(tmp_path / "mine", force=True)
    assert (tmp_path / "mine" / "notes.txt").read_text() == "precious"
