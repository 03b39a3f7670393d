"""Tests that a recording answers like a buffer, over its whole length."""

import math
import struct

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import CONTAINERS, SECOND, Sent, content, numbers, write_mcap
from tftool import (
    Buffer,
    InputError,
    Recording,
    Transform,
    TransformStamped,
    UsageError,
    open_recording,
    seconds,
)
from tftool.recordings.channel import Channel
from tftool.recordings.mcap.write import McapWriter

SENT = content(200)


def opened(tmp_path, sent):
    return open_recording(str(write_mcap(tmp_path / "run.mcap", sent)))


def told(sent):
    """Return a buffer into which the same transforms were inserted one by one."""
    buffer = Buffer(seconds(10_000))
    for one in sent:
        for stamp, parent, child, seven in one.transforms:
            sample = TransformStamped(stamp, parent, child, Transform(seven[:3], seven[3:]))
            if "static" in one.topic:
                assert buffer.set_transform_static(sample, one.topic)
            else:
                assert buffer.set_transform(sample, one.topic)
    return buffer


def test_lookups_are_those_of_a_buffer_that_was_told_one_by_one(tmp_path):
    expected = told(SENT)
    with opened(tmp_path, SENT) as recording:
        times = np.linspace(recording.start + SECOND, recording.end - SECOND, 500)
        times = times.astype(np.int64)

        found = recording.buffer.lookup_transforms("map", "laser", times)

    one_by_one = expected.lookup_transforms("map", "laser", times)
    assert found.valid.all()
    assert np.array_equal(found.translations, one_by_one.translations)
    assert np.array_equal(found.rotations, one_by_one.rotations)
    assert sorted(recording.buffer.frames()) == sorted(expected.frames())
    assert recording.buffer.lookup_transform("odom", "laser", int(times[7])).transform == (
        expected.lookup_transform("odom", "laser", int(times[7])).transform
    )


def test_a_sample_may_be_set_behind_those_of_the_recording(tmp_path):
    with opened(tmp_path, SENT) as recording:
        before = {edge.child: edge.records.copy() for edge in recording.edges}
        late = recording.end + SECOND
        pose = Transform((1.0, 2.0, 3.0))

        assert recording.buffer.set_transform(TransformStamped(late, "map", "odom", pose), "me")
        early = TransformStamped(recording.start - SECOND, "odom", "base_link", pose)
        assert recording.buffer.set_transform(early, "me")

        assert recording.buffer.lookup_transform("map", "odom", late).transform == pose
        assert recording.buffer.lookup_transform("odom", "base_link", early.stamp).transform == pose
        for edge in recording.edges:
            assert np.array_equal(edge.records, before[edge.child])


def test_start_and_end_are_those_of_what_moves(tmp_path):
    stamps = [t[0] for one in SENT if one.topic == "/tf" for t in one.transforms]
    with opened(tmp_path, SENT) as recording:
        assert (recording.start, recording.end) == (min(stamps), max(stamps))


def test_samples_are_what_was_recorded(tmp_path):
    with opened(tmp_path, SENT) as recording:
        samples = recording.samples("arm")

    sent = [(*t, one) for one in SENT for t in one.transforms if t[2] == "arm"]
    sent.sort(key=lambda row: row[0])
    assert samples.stamps.tolist() == [row[0] for row in sent]
    assert samples.translations.tolist() == [list(row[3][:3]) for row in sent]
    assert samples.rotations.tolist() == [list(row[3][3:]) for row in sent]
    assert samples.log_times.tolist() == [row[4].log_time for row in sent]
    assert set(samples.parents) == {"base_link"}
    assert set(samples.authorities) == {"/tf"}
    assert not samples.static.any()


def test_samples_that_tf2_refuses_are_left_out_and_counted(tmp_path):
    start = 100 * SECOND
    sound = numbers(3)
    nan = (math.nan, *sound[1:])
    zero = (*sound[:3], 0.0, 0.0, 0.0, 0.0)
    sent = [
        Sent(start + k, "/tf", ((stamp, "map", "odom", seven),))
        for k, (stamp, seven) in enumerate(
            [(start, sound), (start + 5, nan), (start + 6, zero), (0, sound), (start + 9, sound)]
        )
    ]
    with opened(tmp_path, sent) as recording:
        assert recording.buffer.samples("odom").stamps.tolist() == [start, start + 9]
        assert recording.oddities == {
            "'odom' moves, but has stamp 0, which means the latest in tf2: left out": 1,
            "not a number ('odom' in 'map')": 2,
            "a zero quaternion ('odom' in 'map')": 1,
        }


def test_of_contradicting_statics_the_last_counts(tmp_path):
    sent = [
        Sent(k * SECOND, "/tf_static", ((0, "base", "lidar", numbers(k)),)) for k in (1, 2, 3, 3)
    ]
    with opened(tmp_path, sent) as recording:
        found = recording.buffer.lookup_transform("base", "lidar").transform

        assert found.translation == numbers(3)[:3]
        assert recording.oddities == {
            "'lidar' has 3 different static values: the last value is used": 1
        }


def test_of_moving_and_static_what_came_last_counts(tmp_path):
    static = Sent(2 * SECOND, "/tf_static", ((0, "base", "arm", numbers(1)),))
    moving = Sent(3 * SECOND, "/tf", ((3 * SECOND, "base", "arm", numbers(2)),))
    with opened(tmp_path, [static, moving]) as recording:
        buffer = recording.buffer
        assert buffer.lookup_transform("base", "arm").transform.translation == numbers(2)[:3]
        assert not buffer.can_transform("base", "arm", 2 * SECOND)
    with opened(tmp_path, [moving, static]) as recording:
        assert recording.buffer.can_transform("base", "arm", 2 * SECOND)


def packed_header(number):
    sec, part = divmod(number, 10)
    return struct.pack("<4siII7s", b"\0\1\0\0", 100 + sec, part * 10**8, 7, b"camera\0") + b"data"


def packed_label(number):
    # A class, a count and a label have the layout of a header, but do not run like a clock.
    return struct.pack("<4siII7s", b"\0\1\0\0", 2, number % 3, 7, b"orange\0")


@pytest.mark.parametrize(
    ("kind", "packed", "is_header"),
    [
        ("lane_msgs/msg/Lane", packed_header, True),
        ("lane_msgs/msg/Label", packed_label, False),
        ("lane_msgs/msg/Number", lambda number: struct.pack("<4sd", b"\0\1\0\0", number), False),
        # tftool knows this type, which has a stamp and the name of a node, but no header.
        ("rcl_interfaces/msg/ParameterEvent", packed_header, False),
    ],
)
def test_a_header_of_an_unknown_type_without_a_definition_is_read(
    tmp_path, kind, packed, is_header
):
    writer = McapWriter(tmp_path / "run.mcap")
    channel = writer.channel(Channel("/lane", kind, "cdr", "ros2msg", b""))
    for number in range(40):
        writer.write(channel, 500 * SECOND + number * SECOND // 10, packed(number))
    writer.finish()
    with open_recording(tmp_path / "run.mcap") as recording:
        headers = recording.source.headers()
    assert list(headers) == ["/lane"] * is_header
    if is_header:
        assert set(headers["/lane"].frame_ids) == {"camera"}
        expected = [100 * SECOND + number * SECOND // 10 for number in range(40)]
        assert headers["/lane"].stamps.tolist() == expected


def test_missing_topics_headers_frames_and_files_are_refused(tmp_path):
    with opened(tmp_path, SENT) as recording:
        with pytest.raises(InputError, match="No topic '/scam' was recorded; did you mean /scan"):
            recording.headers("/scam")
        with pytest.raises(InputError, match="do not begin with a header"):
            recording.headers("/tf")
        with pytest.raises(InputError, match="No transform of 'arms' was recorded: there are arm"):
            recording.samples("arms")
    with pytest.raises(InputError, match="There is no file"):
        open_recording(tmp_path / "gone.mcap")


def test_a_recording_without_transforms_is_a_recording(tmp_path):
    sent = [one for one in SENT if one.scan]
    with opened(tmp_path, sent) as recording:
        assert recording.edges == ()
        assert recording.buffer.frames() == []
        assert (recording.start, recording.end) == (sent[0].log_time, sent[-1].log_time)


@pytest.mark.parametrize("name", ["mcap zstd", "db3", "ros 1 lz4"])
def test_messages_are_decoded_by_the_recorded_definition(tmp_path, name):
    with open_recording(CONTAINERS[name](tmp_path, SENT)) as recording:
        scans = list(recording.messages("/scan"))
        transforms = list(recording.messages("/tf_static"))

        sent = [one for one in SENT if one.scan]
        assert [log_time for log_time, _ in scans] == [one.log_time for one in sent]
        stamp = scans[3][1].header.stamp
        assert stamp.sec * SECOND + stamp.nanosec == sent[3].scan[0]
        assert scans[3][1].header.frame_id == "laser"
        assert list(scans[3][1].ranges) == [1.0] * 500
        assert [one.child_frame_id for one in transforms[0][1].transforms] == ["laser", "camera"]
        with pytest.raises(InputError, match="No topic '/scam'"):
            recording.messages("/scam")


@pytest.mark.parametrize("name", CONTAINERS)
def test_a_closed_recording_says_so_and_keeps_what_was_read(tmp_path, name):
    path = str(CONTAINERS[name](tmp_path, SENT))
    with open_recording(path) as unread, open_recording(path) as read:
        edges = read.edges
    for ask in (lambda: unread.buffer, lambda: unread.headers("/scan"), lambda: unread.edges):
        with pytest.raises(UsageError, match="is closed: read the recording inside"):
            ask()

    assert read.edges == edges
    assert read.buffer.frame_exists("map")


@pytest.mark.parametrize("name", CONTAINERS)
def test_messages_that_are_asked_for_once_it_is_closed_are_refused(tmp_path, name):
    path = str(CONTAINERS[name](tmp_path, SENT))
    for ask in (Recording.messages, Recording.raw_messages):
        with open_recording(path) as recording:
            begun, untouched = ask(recording, "/tf"), ask(recording, "/tf")
            next(begun)
        for messages in (begun, untouched):
            with pytest.raises(UsageError, match="is closed: read the recording inside"):
                next(messages)
