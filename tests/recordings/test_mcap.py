"""Tests of MCAP files, read by the format's own package with every CRC checked."""

import os

import pytest

pytest.importorskip("mcap", reason="reads what is written")

from mcap.data_stream import RecordBuilder
from mcap.reader import NonSeekingReader, SeekingReader
from mcap.records import Attachment, DataEnd, Footer, Metadata
from mcap.stream_reader import StreamReader

import tftool
from tests.full_disk import full_disk
from tests.recordings.writers import numbers
from tftool.base.errors import InputError, UsageError
from tftool.recordings.channel import Channel
from tftool.recordings.container import CopiedAttachment, Piece
from tftool.recordings.mcap.format import RECORD
from tftool.recordings.mcap.write import McapWriter

START = 1_750_000_000 * 10**9
PAIRS = [("odom", "base_link"), ("base_link", "arm"), ("map", "odom")]


def sample(stamp, parent, child, seed):
    seven = numbers(seed)
    return tftool.TransformStamped(stamp, parent, child, tftool.Transform(seven[:3], seven[3:]))


def write(path, messages=40, **options):
    """Write a drive with a given number of messages; return the samples by edge."""
    sent = {}
    with tftool.write_recording(path, **options) as recording:
        mount = sample(0, "base_link", "laser", 7)
        recording.static_transforms([mount], log_time=START)
        for tick in range(messages):
            stamp = START + tick * 10_000_000
            for number, (parent, child) in enumerate(PAIRS):
                one = sample(stamp, parent, child, 10 * tick + number)
                sent.setdefault((parent, child), []).append(one)
                recording.transforms([one], log_time=stamp + 5)
    return sent


@pytest.mark.parametrize("compression", ["none", "lz4", "zstd"])
def test_written_transforms_are_read_back_bit_by_bit(tmp_path, compression):
    path = tmp_path / "a.mcap"
    sent = write(path, compression=compression)

    with tftool.open_recording(path) as recording:
        found = {(edge.parent, edge.child): edge for edge in recording.edges}
        static = {edge.child for edge in recording.edges if edge.static}
        damage = recording.damage

    assert static == {"laser"}
    assert damage == ()
    for pair, samples in sent.items():
        edge = found[pair]
        assert edge.stamps.tolist() == [one.stamp for one in samples]
        assert edge.translations.tolist() == [list(one.transform.translation) for one in samples]
        assert edge.rotations.tolist() == [list(one.transform.rotation) for one in samples]


@pytest.mark.parametrize("compression", ["none", "lz4", "zstd"])
def test_the_strict_reader_finds_every_crc_right_and_the_same_by_index_as_by_scan(
    tmp_path, compression
):
    path = tmp_path / "a.mcap"
    write(path, compression=compression)

    with path.open("rb") as file:
        records = list(StreamReader(file, validate_crcs=True).records)
    with path.open("rb") as file:
        reader = SeekingReader(file, validate_crcs=True)
        summary = reader.get_summary()
        by_index = [message.data for _, _, message in reader.iter_messages(log_time_order=False)]
    with path.open("rb") as file:
        scanned = NonSeekingReader(file, validate_crcs=True)
        by_scan = [message.data for _, _, message in scanned.iter_messages(log_time_order=False)]

    assert len(by_index) == 121
    assert by_index == by_scan
    assert summary.statistics.message_count == 121
    assert summary.statistics.message_start_time == START
    assert {
        one.topic: one.metadata["topic_type_hash"][:6] for one in summary.channels.values()
    } == {
        "/tf": "RIHS01",
        "/tf_static": "RIHS01",
    }
    assert [one.data_section_crc != 0 for one in records if isinstance(one, DataEnd)] == [True]
    assert [one.summary_crc != 0 for one in records if isinstance(one, Footer)] == [True]


def test_the_strict_reader_reads_small_chunks_none_and_attachments(
    tmp_path,
):
    for name, size in (("small", 200), ("loose", 0)):
        path = tmp_path / f"{name}.mcap"
        writer = McapWriter(path, profile="", compression="lz4", chunk_size=size)
        notes = RecordBuilder()
        Attachment(5, 6, "notes.txt", "text/plain", b"words").write(notes)
        about = RecordBuilder()
        Metadata("about", {"robot": "r2"}).write(about)
        one = writer.channel(Channel("/a", "", "json", metadata=(("key", "value"),)))
        two = writer.channel(Channel("/b", "Kind", "json", "jsonschema", b"{}"))
        for number in range(20):
            writer.write((one, two)[number % 2], 100 + number, b"%d" % number, 90, number)
        # A record in another file has two times, two names with their lengths, and the content.
        other = tmp_path / "other"
        other.write_bytes(notes.end())
        body = other.read_bytes()[RECORD.size :]
        names = body[16 : body.index(b"text/plain") + len("text/plain")]
        with other.open("rb") as file:
            piece = Piece(file.fileno(), 0, RECORD.size + len(body))
            writer.copy_attachment(CopiedAttachment(piece, body[:16], names, len("words")))
        writer.copy_metadata(about.end()[RECORD.size :])
        writer.finish()

        with path.open("rb") as file:
            reader = SeekingReader(file, validate_crcs=True)
            summary = reader.get_summary()
            attachments = [(one.name, one.data) for one in reader.iter_attachments()]
            metadata = [(one.name, one.metadata) for one in reader.iter_metadata()]
        with path.open("rb") as file:
            scanned = NonSeekingReader(file, validate_crcs=True)
            found = [
                (channel.topic, one.log_time, one.publish_time, one.sequence, one.data)
                for _, channel, one in scanned.iter_messages(log_time_order=False)
            ]

        assert (len(summary.chunk_indexes) > 3) == (size > 0)
        assert found == [
            ("/ab"[0] + "ab"[number % 2], 100 + number, 90, number, b"%d" % number)
            for number in range(20)
        ]
        assert summary.statistics.channel_message_counts == {one: 10, two: 10}
        assert attachments == [("notes.txt", b"words")]
        assert metadata == [("about", {"robot": "r2"})]


def test_an_exception_leaves_nothing_behind(tmp_path):
    path = tmp_path / "a.mcap"

    def broken():
        with tftool.write_recording(path) as recording:
            recording.transforms([sample(START, "a", "b", 1)])
            raise KeyError("broken")

    with pytest.raises(KeyError):
        broken()

    assert os.listdir(tmp_path) == []


def test_an_existing_recording_is_replaced_only_when_asked_to(tmp_path):
    path = tmp_path / "a.mcap"
    write(path, 2)
    before = path.read_bytes()

    with pytest.raises(UsageError, match="exists: add --force to replace it"):
        tftool.write_recording(path)
    assert path.read_bytes() == before

    write(path, 3, force=True)
    assert path.read_bytes() != before
    assert os.listdir(tmp_path) == ["a.mcap"]


def test_a_place_that_cannot_be_written_is_refused_with_a_sentence(tmp_path):
    with pytest.raises(InputError, match="there is no folder"):
        tftool.write_recording(tmp_path / "missing" / "a.mcap")
    with pytest.raises(UsageError, match="not a compression of MCAP"):
        tftool.write_recording(tmp_path / "a.mcap", compression="rar")
    with pytest.raises(UsageError, match="does not end in the suffix of a recording"):
        tftool.write_recording(tmp_path / "a.txt")

    assert os.listdir(tmp_path) == []


def test_a_file_of_a_killed_writer_is_read_up_to_its_last_chunk(tmp_path):
    path = tmp_path / "a.mcap"
    writer = McapWriter(path)
    channel = writer.channel(Channel("/a", "Kind", "json", "jsonschema", b"{}"))
    for number in range(30):
        writer.write(channel, 100 + number, b"{}")
        if number % 10 == 9:
            writer.flush()
    writer.write(channel, 500, b"{}")
    writer.abandon()

    with tftool.open_recording(path) as recording:
        raw = list(recording.raw_messages("/a"))

    assert [one.log_time for one in raw] == list(range(100, 130))


def test_a_full_disk_leaves_the_whole_chunks_readable(tmp_path):
    path = tmp_path / "a.mcap"
    writer = McapWriter(path, compression="none", chunk_size=3000)
    channel = writer.channel(Channel("/a", "Kind", "json", "jsonschema", b"{}"))

    def fill():
        for number in range(100):
            writer.write(channel, 100 + number, bytes(970))

    with full_disk(20_000):
        with pytest.raises(OSError, match="too large"):
            fill()
        writer.rescue()

    with tftool.open_recording(path) as recording:
        found = [one.log_time for one in recording.raw_messages("/a")]
    assert 10 < len(found) < 20
    assert found == list(range(100, 100 + len(found)))
