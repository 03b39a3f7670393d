"""Tests of edits: requested changes are made, everything else stays equal byte for byte."""

import random
import shutil
import struct
import subprocess

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from mcap.reader import SeekingReader
from mcap.writer import CompressionType
from rosbags.rosbag1 import Writer

from tests.patience import PATIENCE
from tests.recordings.edit.outcomes import NEW_POSE, SENT, START, edges, messages, strictly_read
from tests.recordings.writers import (
    CONTAINERS,
    SECOND,
    Sent,
    numbers,
    write_mcap,
    write_rosbag1,
)
from tftool.base.errors import UsageError
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.recordings import chunked, container
from tftool.recordings.channel import Channel
from tftool.recordings.edit.changes import Edits
from tftool.recordings.edit.rewrite import edit
from tftool.recordings.mcap.write import McapWriter
from tftool.recordings.recording import open_recording


@pytest.mark.parametrize("name", CONTAINERS)
def test_without_changes_every_container_comes_out_as_it_went_in(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    before = {file: file.read_bytes() for file in tmp_path.rglob("*") if file.is_file()}
    out = tmp_path / f"out{path.suffix}"

    report = edit([str(path)], out, Edits())

    assert messages(out) == messages(path)
    assert edges(out) == edges(path)
    assert report.messages == len(SENT)
    assert report.notes == []
    assert strictly_read(out) in (None, len(SENT))
    assert {file: file.read_bytes() for file in before} == before
    if path.is_dir():
        kinds = [sorted(one.suffix for one in folder.iterdir()) for folder in (path, out)]
        assert kinds[0] == kinds[1]


@pytest.mark.parametrize("name", CONTAINERS)
def test_setting_a_link_changes_that_link_and_not_one_other_message(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    out = tmp_path / f"out{path.suffix}"

    edit([str(path)], out, Edits(poses={("base_link", "laser"): NEW_POSE}))

    before, after = edges(path), edges(out)
    assert after.pop(("base_link", "laser")) == [(0, *NEW_POSE)]
    del before["base_link", "laser"]
    assert after == before
    old, new = messages(path), messages(out)
    assert len(new.pop("/tf_static")) == len(old.pop("/tf_static"))
    assert new == old
    assert strictly_read(out) in (None, len(SENT))


def test_a_chain_of_containers_gives_back_what_went_in(tmp_path):
    first = CONTAINERS["db3"](tmp_path, SENT)
    one, two, three = tmp_path / "b.mcap", tmp_path / "c.db3", tmp_path / "d"

    edit([str(first)], one, Edits())
    edit([str(one)], two, Edits())
    edit([str(two)], three, Edits())

    assert messages(first) == messages(one) == messages(two) == messages(three)
    assert strictly_read(one) is None
    assert strictly_read(three) == len(SENT)


@pytest.mark.parametrize("suffix", ["", ".db3"])
def test_ros_1_becomes_ros_2_and_back_with_the_same_transforms(tmp_path, suffix):
    bag = write_rosbag1(tmp_path / "a.bag", SENT)
    out, back = tmp_path / f"b{suffix}", tmp_path / "c.bag"

    edit([str(bag)], out, Edits())
    edit([str(out)], back, Edits())

    assert edges(out) == edges(back) == edges(bag)
    with open_recording(out) as recording:
        types = {topic.type for topic in recording.topics}
        assert {topic.encoding for topic in recording.topics} == {"cdr"}
        scans = [message.ranges.tolist()[:2] for _, message in recording.messages("/scan")]
    assert types == {"tf2_msgs/TFMessage", "sensor_msgs/LaserScan", "rosgraph_msgs/Clock"}
    assert scans == [[1.0, 1.0]] * sum(one.scan is not None for one in SENT)
    assert strictly_read(back) == len(SENT)


def test_ros_1s_own_rosbag_reads_every_bag_we_write(tmp_path):
    python = "/usr/bin/python3"
    found = shutil.which(python) and subprocess.run(
        [python, "-c", "import rosbag"], capture_output=True, check=False
    )
    if not found or found.returncode:
        pytest.skip("Debian's python3-rosbag is not installed")
    db3 = CONTAINERS["db3"](tmp_path, SENT)
    edit([str(db3)], tmp_path / "none.bag", Edits())
    for method in ("bz2", "lz4"):
        (tmp_path / method).mkdir()
        bag = CONTAINERS[f"ros 1 {method}"](tmp_path / method, SENT)
        edit([str(bag)], tmp_path / f"{method}.bag", Edits(rename={"odom": "odometry"}))
    program = """
import rosbag, sys
for path in sys.argv[1:]:
    bag = rosbag.Bag(path)
    told = {name: one.message_count for name, one in bag.get_type_and_topic_info().topics.items()}
    names = {t.header.frame_id for _, m, _ in bag.read_messages(["/tf"]) for t in m.transforms}
    count = sum(1 for _ in bag.read_messages())
    print(bag.get_compression_info().compression, told["/tf"], count, *sorted(names))
"""
    paths = [str(tmp_path / f"{name}.bag") for name in ("none", "bz2", "lz4")]
    done = subprocess.run(
        [python, "-c", program, *paths], capture_output=True, text=True, timeout=PATIENCE
    )

    moving = sum(one.topic == "/tf" for one in SENT)
    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        f"none {moving} {len(SENT)} base_link map odom",
        f"bz2 {moving} {len(SENT)} base_link map odometry",
        f"lz4 {moving} {len(SENT)} base_link map odometry",
    ]


# Requested changes


def test_links_are_dropped_renamed_prefixed_and_shifted(tmp_path, mcap):
    out = tmp_path / "b.mcap"

    edit(
        [str(mcap)],
        out,
        Edits(drop=(("*", "arm"),), rename={"odom": "odometry"}, prefix="r1/", shift=SECOND // 2),
    )

    before, after = edges(mcap), edges(out)
    assert set(after) == {
        ("r1/odometry", "r1/base_link"),
        ("r1/map", "r1/odometry"),
        ("r1/base_link", "r1/laser"),
        ("r1/base_link", "r1/camera"),
    }
    assert after["r1/odometry", "r1/base_link"] == [
        (stamp + SECOND // 2, *rest) for stamp, *rest in before["odom", "base_link"]
    ]
    assert after["r1/base_link", "r1/laser"] == before["base_link", "laser"]


def test_names_change_in_other_messages_only_when_asked(tmp_path, mcap):
    one, two = tmp_path / "b.mcap", tmp_path / "c.mcap"

    said = edit([str(mcap)], one, Edits(rename={"laser": "a_much_longer_lidar_name"}))
    edit([str(mcap)], two, Edits(rename={"laser": "a_much_longer_lidar_name"}, everywhere=True))

    scans = sum(sent.scan is not None for sent in SENT)
    assert [note for note in said.notes if f"{scans} messages on '/scan'" in note]
    with open_recording(one) as recording:
        assert set(recording.headers("/scan").frame_ids) == {"laser"}
    with open_recording(two) as recording, open_recording(mcap) as original:
        assert set(recording.headers("/scan").frame_ids) == {"a_much_longer_lidar_name"}
        new = [message.ranges for _, message in recording.messages("/scan")]
        old = [message.ranges for _, message in original.messages("/scan")]
    assert new == old


def test_leading_slashes_are_written_away(tmp_path):
    slashed = [
        Sent(
            one.log_time,
            one.topic,
            tuple((t, f"/{p}", f"/{c}", s) for t, p, c, s in one.transforms),
        )
        for one in SENT
        if one.transforms
    ]
    path, out = write_mcap(tmp_path / "a.mcap", slashed), tmp_path / "b.mcap"

    edit([str(path)], out, Edits(strip_slash=True))

    assert edges(out) == edges(path)
    with open_recording(path) as before, open_recording(out) as after:
        assert all(edge.slashed for edge in before.edges)
        assert not any(edge.slashed for edge in after.edges)


def test_a_child_with_a_new_parent_stays_where_it_is(tmp_path, mcap):
    out = tmp_path / "b.mcap"

    edit(
        [str(mcap)],
        out,
        Edits(reparent={("base_link", "camera"): "laser", ("base_link", "arm"): "odom"}),
    )

    with open_recording(mcap) as before, open_recording(out) as after:
        assert {(e.parent, e.child) for e in after.edges if e.child in ("camera", "arm")} == {
            ("laser", "camera"),
            ("odom", "arm"),
        }
        arm = next(edge for edge in after.edges if edge.child == "arm")
        for stamp in arm.stamps.tolist():
            for child in ("camera", "arm"):
                one, two = (
                    of.buffer.lookup_transform("base_link", child, stamp).transform
                    for of in (before, after)
                )
                assert np.allclose(one.translation, two.translation, atol=1e-12)
    with pytest.raises(UsageError, match="moves relative to"):
        edit(
            [str(mcap)],
            tmp_path / "c.mcap",
            Edits(reparent={("base_link", "laser"): "map"}),
        )
    with pytest.raises(UsageError, match="cannot become the parent of"):
        edit(
            [str(mcap)],
            tmp_path / "c.mcap",
            Edits(reparent={("odom", "base_link"): "laser"}),
        )


def test_stamps_become_the_times_of_reception(tmp_path, mcap):
    out = tmp_path / "b.mcap"

    edit([str(mcap)], out, Edits(restamp=True))

    with open_recording(out) as recording:
        for edge in recording.edges:
            if not edge.static:
                assert edge.stamps.tolist() == recording.transforms.log_times_of(edge).tolist()


@pytest.mark.parametrize("name", ["mcap zstd", "db3", "ros 1 lz4"])
def test_a_cut_keeps_its_ends_answerable_and_all_statics(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    out = tmp_path / f"out{path.suffix}"
    low, high = START + SECOND // 2, START + SECOND

    edit([str(path)], out, Edits(start=low, end=high))

    with open_recording(path) as before, open_recording(out) as after:
        for stamp in (low, (low + high) // 2, high):
            for pair in (("map", "laser"), ("odom", "arm")):
                one, two = (of.buffer.lookup_transform(*pair, stamp) for of in (before, after))
                assert one == two
        assert after.source.end - after.source.start < SECOND
        kept = after.headers("/scan").stamps
        all_scans = before.headers("/scan").stamps
    assert kept.tolist() == all_scans[(all_scans >= low) & (all_scans <= high)].tolist()
    assert strictly_read(out) is None or out.exists()


def test_a_cut_by_the_times_of_reception_copies_chunks(tmp_path, mcap):
    out = tmp_path / "b.mcap"
    low, high = START + SECOND // 2, START + SECOND

    report = edit([str(mcap)], out, Edits(start=low, end=high, by_record_time=True))

    assert report.copied > 1
    times = [log_time for log_time, _ in messages(out)["/scan"]]
    assert times == [t for t, _ in messages(mcap)["/scan"] if low <= t <= high]


def test_statics_come_first_the_latest_of_each_from_its_own_publisher(tmp_path):
    mount, other = numbers(1), numbers(2)
    sent = [
        Sent(START, "/tf", ((START, "odom", "base", numbers(3)),)),
        Sent(START + 10, "/tf_static", ((5, "base", "laser", mount),), node="/one"),
        Sent(START + 20, "/tf_static", ((6, "base", "camera", mount),), node="/two"),
        Sent(START + 30, "/tf_static", ((7, "base", "camera", other),), node="/two"),
    ]
    path, out = write_rosbag1(tmp_path / "a.bag", sent), tmp_path / "b.bag"

    edit([str(path)], out, Edits(statics_first=True))

    with open_recording(out) as recording:
        raw = list(recording.raw_messages("/tf_static"))
        assert [one.log_time - START for one in raw] == [0, 0, 10, 20, 30]
        assert [one.sender.node for one in raw[:2]] == ["/one", "/two"]
        assert {one.sender.durability for one in raw} == {"transient_local"}
    assert edges(out)["base", "camera"][0] == (7, *other)
    assert edges(out)["base", "laser"][0] == (5, *mount)


def test_lost_statics_come_back_from_another_recording(tmp_path, mcap):
    without = write_mcap(tmp_path / "b.mcap", [one for one in SENT if "static" not in one.topic])
    out = tmp_path / "c.mcap"
    new = TransformStamped(0, "base_link", "laser", Transform(NEW_POSE[:3], NEW_POSE[3:]))

    edit([str(without)], out, Edits(statics_from=(new,)))
    edit([str(mcap)], tmp_path / "d.mcap", Edits(statics_from=(new,)))

    assert edges(out) == {**edges(without), ("base_link", "laser"): [(0, *NEW_POSE)]}
    assert edges(tmp_path / "d.mcap")["base_link", "laser"] == [(0, *NEW_POSE)]
    assert (
        edges(tmp_path / "d.mcap")["base_link", "camera"][0]
        == edges(mcap)["base_link", "camera"][0]
    )
    with open_recording(out) as recording:
        assert [one.durability for one in recording.publishers if "static" in one.topic] == [
            "transient_local"
        ]


@pytest.mark.parametrize("name", ["mcap zstd", "db3", "ros 1 none"])
def test_recordings_that_follow_each_other_are_joined(tmp_path, name):
    half = len(SENT) // 2
    parts = []
    for number, some in enumerate((SENT[:half], SENT[half:])):
        (tmp_path / f"in{number}").mkdir()
        parts.append(CONTAINERS[name](tmp_path / f"in{number}", some))
    whole = CONTAINERS[name](tmp_path, SENT)
    out = tmp_path / f"out{whole.suffix}"

    edit([str(part) for part in parts], out, Edits())

    assert messages(out) == messages(whole)
    assert strictly_read(out) in (None, len(SENT))


def test_split_files_each_begin_with_all_statics(tmp_path, mcap):
    out = tmp_path / "parts"

    report = edit([str(mcap)], out, Edits(split_every=SECOND // 2))

    assert report.files == ["parts_0.mcap", "parts_1.mcap", "parts_2.mcap"]
    before, after = messages(mcap), messages(out)
    assert after["/tf"] == before["/tf"]
    assert after["/scan"] == before["/scan"]
    for file in report.files:
        with open_recording(out / file) as recording:
            assert {edge.child for edge in recording.edges if edge.static} == {"laser", "camera"}
            assert recording.source.end - recording.source.start < SECOND // 2
            first = next(recording.raw_messages("/tf_static")).log_time
            assert first == recording.source.start
    assert strictly_read(out) == sum(map(len, after.values()))


def test_times_sequences_attachments_and_metadata_are_kept(tmp_path):
    from mcap.writer import Writer

    path, out = tmp_path / "a.mcap", tmp_path / "b.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=200)
        writer.start(profile="mine", library="theirs")
        schema = writer.register_schema("Kind", "jsonschema", b"{}")
        channels = [writer.register_channel("/a", "json", schema, {"k": "v"}) for _ in range(2)]
        for number in range(20):
            writer.add_message(channels[number % 2], 100 + number, b"{}", 50 + number, 7 * number)
        writer.add_attachment(1, 2, "notes", "text/plain", b"words")
        writer.add_metadata("about", {"robot": "r2"})
        writer.finish()

    edit([str(path)], out, Edits())

    def told(file):
        with file.open("rb") as stream:
            reader = SeekingReader(stream, validate_crcs=True)
            return (
                [
                    (m.channel_id, m.log_time, m.publish_time, m.sequence, m.data)
                    for _, _, m in reader.iter_messages(log_time_order=False)
                ],
                [(one.name, one.data, one.log_time) for one in reader.iter_attachments()],
                [(one.name, one.metadata) for one in reader.iter_metadata()],
                reader.get_summary().channels,
                reader.get_summary().schemas,
                reader.get_header().profile,
            )

    assert told(out) == told(path)


def with_attachments(path, *attached):
    from mcap.writer import Writer

    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("Kind", "jsonschema", b"{}")
        writer.add_message(writer.register_channel("/a", "json", schema), 1, b"{}", 1)
        for number, data in enumerate(attached):
            writer.add_attachment(number, 7, f"file {number}", "text/plain", data)
        writer.finish()
    return path


def attachments_of(path):
    with path.open("rb") as stream:
        reader = SeekingReader(stream, validate_crcs=True)
        return [(one.name, one.data, one.create_time) for one in reader.iter_attachments()]


def test_an_attachment_larger_than_what_is_read_at_once_is_kept(tmp_path, monkeypatch):
    data = random.Random(5).randbytes(1_300_000)
    path = with_attachments(tmp_path / "a.mcap", data, b"", b"small")
    monkeypatch.setattr(container, "LARGEST", 100_000)

    edit([str(path)], tmp_path / "b.mcap", Edits())

    told = attachments_of(tmp_path / "b.mcap")
    assert told == [("file 0", data, 0), ("file 1", b"", 1), ("file 2", b"small", 2)]


def test_a_damaged_attachment_is_left_out_and_told(tmp_path):
    path = with_attachments(tmp_path / "a.mcap", b"first words", b"second words")
    path.write_bytes(path.read_bytes().replace(b"first words", b"worst words"))

    done = edit([str(path)], tmp_path / "b.mcap", Edits())

    assert any("CRC of the attachment" in one for one in done.notes)
    assert [name for name, _, _ in attachments_of(tmp_path / "b.mcap")] == ["file 1"]


# Damage


@pytest.mark.parametrize("name", ["mcap none", "mcap lz4", "mcap zstd", "ros 1 none", "ros 1 bz2"])
@pytest.mark.parametrize("share", [0.3, 0.77, 0.99])
def test_a_recording_that_was_cut_off_becomes_a_whole_one(tmp_path, name, share):
    path = CONTAINERS[name](tmp_path, SENT)
    whole = messages(path)
    data = path.read_bytes()
    path.write_bytes(data[: int(len(data) * share)])
    out = tmp_path / f"out{path.suffix}"

    report = edit([str(path)], out, Edits())

    assert any("breaks off" in note or "not closed" in note for note in report.notes)
    found = messages(out)
    assert sum(map(len, found.values())) == report.messages > 0
    for topic, some in found.items():
        assert some == whole[topic][: len(some)]
    strictly_read(out)


def test_a_broken_chunk_costs_only_what_lies_behind_the_break_in_it(tmp_path):
    path, out = tmp_path / "a.mcap", tmp_path / "b.mcap"
    write_mcap(path, SENT, compression=CompressionType.NONE)
    before = messages(path)
    with path.open("rb") as stream:
        chunk = SeekingReader(stream).get_summary().chunk_indexes[3]
    data = bytearray(path.read_bytes())
    payload = next(raw for _, raw in before["/tf"] if raw in data[chunk.chunk_start_offset :])
    broken = data.index(payload, chunk.chunk_start_offset) - 31
    # With this length, the record extends beyond the end of the chunk.
    data[broken + 1 : broken + 9] = b"\xff\xff\xff\x00\x00\x00\x00\x00"
    path.write_bytes(data)

    report = edit([str(path)], out, Edits())

    assert all(f"chunk at byte {chunk.chunk_start_offset}" in note for note in report.notes)
    assert report.notes
    after = messages(out)
    assert len(SENT) - 20 < sum(map(len, after.values())) < len(SENT)
    assert all(set(some) <= set(before[topic]) for topic, some in after.items())
    strictly_read(out)


@pytest.mark.parametrize("suffix", [".bag", ".mcap"])
def test_a_chunk_that_announces_too_much_is_unpacked_once(tmp_path, monkeypatch, suffix):
    path, out, unpacked = tmp_path / f"run{suffix}", tmp_path / f"out{suffix}", []
    if suffix == ".bag":
        write_rosbag1(path, SENT, Writer.CompressionFormat.LZ4)
        place = path.read_bytes().index(b"size=", 4100) + 5
    else:
        write_mcap(path, SENT, compression=CompressionType.LZ4)
        # Two stamps precede the name in the chunk's record.
        place = path.read_bytes().index(b"\x03\x00\x00\x00lz4") - 12
    raw = bytearray(path.read_bytes())
    raw[place : place + 4] = (0xF0000000).to_bytes(4, "little")
    path.write_bytes(raw)
    unpack = chunked.unpack_beginning

    def counted(method, packed, size):
        unpacked.append(size)
        return unpack(method, packed, size)

    monkeypatch.setattr(chunked, "unpack_beginning", counted)

    report = edit([str(path)], out, Edits())

    assert unpacked == [0xF0000000]
    assert "cannot expand to 4026531840 as stated" in " ".join(report.notes)
    assert report.messages == len(SENT)


@pytest.mark.parametrize("is_chunked", [True, False])
def test_a_message_of_a_channel_that_nothing_describes_is_left_out(tmp_path, is_chunked):
    path, out = tmp_path / "a.mcap", tmp_path / "b.mcap"
    write_mcap(path, SENT, use_chunking=is_chunked, compression=CompressionType.NONE)
    before = messages(path)
    data = bytearray(path.read_bytes())
    place = data.index(before["/tf"][3][1])
    data[place - 22 : place - 20] = b"\xff\xff"
    # Without the summary, every message is read.
    path.write_bytes(data[:-37])

    report = edit([str(path)], out, Edits())

    assert any("their topic is unknown" in note for note in report.notes)
    before["/tf"].pop(3)
    assert messages(out) == before


def test_messages_of_a_channel_whose_schema_is_nowhere_are_kept(tmp_path):
    path, out = tmp_path / "a.mcap", tmp_path / "b.mcap"
    write_mcap(path, SENT, use_chunking=False)
    before = messages(path)
    data = bytearray(path.read_bytes())
    place = data.index(struct.pack("<I", 3) + b"/tf" + struct.pack("<I", 3) + b"cdr")
    data[place - 2 : place] = b"\xff\xff"
    path.write_bytes(data[:-37])

    edit([str(path)], out, Edits())

    assert messages(out) == before


def change_headers(path, code, change):
    """Change the headers of a bag's records of one kind; the sizes of the headers must stay."""
    data, place = bytearray(path.read_bytes()), 13
    while place < len(data):
        (head,) = struct.unpack_from("<I", data, place)
        (size,) = struct.unpack_from("<I", data, place + 4 + head)
        header = bytes(data[place + 4 : place + 4 + head])
        if b"op=" + bytes([code]) in header:
            data[place + 4 : place + 4 + head] = change(header)
        place += 8 + head + size
    path.write_bytes(data)


@pytest.mark.parametrize("code", [4, 7])
def test_a_bag_with_a_record_that_names_no_connection_is_edited(tmp_path, code):
    path, out = tmp_path / "a.bag", tmp_path / "b.bag"
    write_rosbag1(path, SENT)
    before = messages(path)
    change_headers(path, code, lambda header: header.replace(b"conn=", b"conm="))

    edit([str(path)], out, Edits())

    assert messages(out) == before


def test_copied_and_written_indexes_of_a_bag_have_their_fields_in_one_order(tmp_path):
    def as_in_roscpp(header):
        fields, place = [], 0
        while place < len(header):
            (length,) = struct.unpack_from("<I", header, place)
            fields.append(header[place : place + 4 + length])
            place += 4 + length
        return b"".join(sorted(fields, key=lambda field: field[4:]))

    path, out = tmp_path / "a.bag", tmp_path / "b.bag"
    write_rosbag1(path, SENT)
    change_headers(path, 4, as_in_roscpp)

    report = edit([str(path)], out, Edits(start=START + SECOND // 2, by_record_time=True))

    # rosbags learns the order from the first index, and expects it in all others.
    assert report.copied > 1
    assert strictly_read(out) == sum(len(found) for found in messages(out).values())


def test_a_message_may_say_that_it_was_sent_at_any_time(tmp_path):
    path, out = tmp_path / "a.mcap", tmp_path / "b.mcap"
    write_mcap(path, SENT, compression=CompressionType.NONE)
    before = messages(path)
    data = bytearray(path.read_bytes())
    place = data.index(before["/tf"][3][1])
    data[place - 8 : place] = b"\xff" * 8
    path.write_bytes(data[:-37])

    edit([str(path)], out, Edits())

    assert messages(out) == before
    with out.open("rb") as stream:
        sent = {message.publish_time for _, _, message in SeekingReader(stream).iter_messages()}
    assert 2**64 - 1 in sent


def test_a_schema_that_is_defined_twice_is_the_same_one_after_an_edit(tmp_path):
    # A channel uses the last definition before it; later definitions are ignored.
    path = tmp_path / "twice.mcap"
    path.write_bytes(
        b"".join(
            [
                b"\x89MCAP0\r\n",
                record(1, text("ros2") + text("")),
                schema(1, "std_msgs/msg/String"),
                schema(1, "tf2_msgs/msg/TFMessage"),
                record(4, struct.pack("<HH", 1, 1) + text("/tf") + text("cdr") + bytes(4)),
                schema(1, "std_msgs/msg/Bool"),
                record(5, struct.pack("<HIQQ", 1, 0, SECOND, SECOND) + b"\0\1\0\0" + bytes(4)),
                record(15, bytes(4)),
                record(2, bytes(20)),
                b"\x89MCAP0\r\n",
            ]
        )
    )
    edit([path], tmp_path / "edited.mcap", Edits())

    kinds = []
    for file in (path, tmp_path / "edited.mcap"):
        with open_recording(file) as recording:
            kinds.append([topic.type for topic in recording.topics])
    assert kinds == [["tf2_msgs/TFMessage"]] * 2


def record(code, body):
    return bytes([code]) + struct.pack("<Q", len(body)) + body


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def schema(number, name):
    return record(3, struct.pack("<H", number) + text(name) + text("ros2msg") + bytes(4))


def humble_range(path, ranges):
    """Write an MCAP file without definitions, as recorders of Humble's sqlite files do."""
    writer = McapWriter(path)
    number = writer.channel(Channel("/sonar", "sensor_msgs/msg/Range", "cdr", "ros2msg", b""))
    for stamp, metres in enumerate(ranges, start=1):
        head = struct.pack("<iII6s", stamp, 0, 6, b"sonar\0")
        # One byte directly follows the name; numbers of four bytes are aligned.
        payload = b"\0\1\0\0" + head + struct.pack("<Bx4f", 0, 0.5, 0.1, 4.0, metres)
        writer.write(number, stamp * 10**9, payload)
    writer.finish()
    return path


def test_a_message_of_an_earlier_distribution_is_read_by_the_layout_that_fits(tmp_path):
    path = humble_range(tmp_path / "a.mcap", [1.5, 2.5])

    with open_recording(path) as recording:
        found = [message for _, message in recording.messages("/sonar")]
    assert [(one.header.frame_id, one.range, one.variance) for one in found] == [
        ("sonar", 1.5, 0.0),
        ("sonar", 2.5, 0.0),
    ]

    report = edit([str(path)], tmp_path / "b.bag", Edits())
    assert (report.messages, report.notes) == (2, [])
    with open_recording(tmp_path / "b.bag") as recording:
        assert [message.range for _, message in recording.messages("/sonar")] == [1.5, 2.5]


def test_messages_that_no_layout_fits_are_left_out_of_a_conversion_and_named(tmp_path):
    path = tmp_path / "a.mcap"
    writer = McapWriter(path)
    for topic, payload in (("/good", b"\0\1\0\0\7"), ("/odd", b"\0\1\0\0" + bytes(9))):
        channel = Channel(topic, "std_msgs/msg/UInt8", "cdr", "ros2msg", b"")
        writer.write(writer.channel(channel), 10**9, payload)
    writer.finish()

    report = edit([str(path)], tmp_path / "b.bag", Edits())

    assert report.messages == 1
    assert [note.split(":")[0] for note in report.notes] == [
        "'/odd' is left out where a message cannot be read"
    ]


def test_a_bag_keeps_its_encoding_in_an_mcap_file_unless_it_is_asked_for_ros_2(tmp_path):
    bag = write_rosbag1(tmp_path / "a.bag", SENT)

    kept = edit([str(bag)], tmp_path / "kept.mcap", Edits())
    made = edit([str(bag)], tmp_path / "made.mcap", Edits(), ros2=True)
    again = edit([str(tmp_path / "kept.mcap")], tmp_path / "again.mcap", Edits(), ros2=True)

    assert ["--ros2 converts" in " ".join(one.notes) for one in (kept, made, again)] == [
        True,
        False,
        False,
    ]
    for name, encoding in (("kept", "ros1"), ("made", "cdr"), ("again", "cdr")):
        with open_recording(tmp_path / f"{name}.mcap") as recording:
            assert {topic.encoding for topic in recording.topics} == {encoding}
        assert edges(tmp_path / f"{name}.mcap") == edges(bag)
    with pytest.raises(UsageError, match=r"messages to ROS 2: write 'b\.mcap'"):
        edit([str(bag)], tmp_path / "b.bag", Edits(), ros2=True)
