"""Tests of recordings that are still written, were never closed, or are malicious."""

import os
import pickle
import shutil
import sqlite3
import struct
import tempfile
import tracemalloc

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

import zstandard
from mcap.writer import CompressionType, Writer

from tests.recordings.writers import TF, content, payload, write_mcap
from tests.recordings.writers import write_rosbag1 as write_bag
from tftool import InputError, UsageError, open_recording
from tftool.app.main import main
from tftool.recordings import container
from tftool.recordings import container_reader as reading
from tftool.recordings import message_cutter as cutting
from tftool.recordings.mcap import read as mcap_read

SENT = content(40)


def database(path, sent):
    """Write a database as rosbag2's recorder does, in the mode with a log in a second file."""
    base = sqlite3.connect(path)
    base.execute("pragma journal_mode=wal")
    base.execute(
        "create table topics(id integer primary key, name text not null, type text not null, "
        "serialization_format text not null, offered_qos_profiles text not null)"
    )
    base.execute(
        "create table messages(id integer primary key, topic_id integer not null, "
        "timestamp integer not null, data blob not null)"
    )
    base.execute("insert into topics values (1, '/tf', ?, 'cdr', '')", (TF,))
    base.commit()
    for one in sent:
        if one.transforms and one.topic == "/tf":
            row = (one.log_time, payload(one))
            base.execute("insert into messages(topic_id, timestamp, data) values (1, ?, ?)", row)
    base.commit()
    return base


def test_a_write_ahead_log_is_read_and_no_file_is_changed(tmp_path):
    base = database(tmp_path / "live.db3", SENT)
    # The state that a killed recorder leaves
    place = tmp_path / "killed"
    place.mkdir()
    for name in ("live.db3", "live.db3-wal"):
        shutil.copyfile(tmp_path / name, place / name)
    base.close()
    before = {one.name: one.read_bytes() for one in place.iterdir()}
    assert len(before["live.db3-wal"]) > 0

    with open_recording(place / "live.db3") as recording:
        count = len(recording.transforms)
        damage = recording.damage

    assert count == sum(len(one.transforms) for one in SENT if one.topic == "/tf")
    assert any("write-ahead log is read too" in text for text in damage)
    assert {one.name: one.read_bytes() for one in place.iterdir()} == before


@pytest.mark.parametrize("write", [write_mcap, write_bag], ids=["mcap", "rosbag1"])
def test_a_file_that_grows_while_it_is_read_is_read_as_it_was(tmp_path, write):
    path = write(tmp_path / "run", SENT)
    whole = len(open_and_read(path))
    grown = []

    def grow(done, total):
        with path.open("ab") as file:
            file.write(os.urandom(5000))
        grown.append(total)

    with open_recording(path, progress=grow) as recording:
        assert len(recording.transforms) == whole
    assert grown
    assert max(grown) < path.stat().st_size


def open_and_read(path):
    with open_recording(path) as recording:
        return recording.transforms


@pytest.mark.parametrize("write", [write_mcap, write_bag], ids=["mcap", "rosbag1"])
def test_a_file_that_is_shortened_while_it_is_read_is_told(tmp_path, write):
    path = write(tmp_path / "run", SENT)

    with open_recording(path) as recording:
        with path.open("r+b") as file:
            file.truncate(2000)
        found = recording.transforms

        assert recording.damage
        assert len(found) < len(open_and_read(write(tmp_path / "other", SENT)))


def test_more_topics_than_are_taken_are_left_out_and_it_ends(tmp_path):
    path = tmp_path / "run.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("ros2")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        for number in range(65_000):
            writer.register_channel(f"/topic_{number}", "cdr", schema)
        writer.finish()

    with open_recording(path) as recording:
        assert len(recording.topics) == 65_000
        assert recording.edges == ()


def plain_mcap(path, sent, **options):
    return write_mcap(path, sent, compression=CompressionType.NONE, **options)


@pytest.mark.parametrize("write", [plain_mcap, write_bag], ids=["mcap", "rosbag1"])
def test_a_chunk_that_is_too_large_to_hold_is_left_out_and_told(tmp_path, monkeypatch, write):
    path = write(tmp_path / "run", content(600), chunk_size=1 << 30)
    assert path.stat().st_size > 1 << 18
    monkeypatch.setattr(container, "LARGEST", 1 << 18)

    with open_recording(path) as recording:
        found = recording.transforms
        damage = " ".join(recording.damage)

    assert "exceed the limit of one read (262144)" in damage
    assert len(found) == 0


def test_a_message_outside_of_chunks_that_is_too_large_is_left_out_and_told(tmp_path, monkeypatch):
    path = plain_mcap(tmp_path / "run", SENT, use_chunking=False)
    whole = len(open_and_read(path))
    data = path.read_bytes()
    (channel,) = struct.unpack_from("<H", data, data.index(b"\x03\x00\x00\x00/tf\x03") - 4)
    large = struct.pack("<BQHIQQ", 5, 22 + 300_000, channel, 0, 10**18, 10**18)
    large += bytes(300_000)
    # The large record is inserted before the record that ends the data.
    end = data.rindex(struct.pack("<BQ", 0x0F, 4))
    path.write_bytes(data[:end] + large + data[end:])
    monkeypatch.setattr(container, "LARGEST", 1 << 18)

    with open_recording(path) as recording:
        assert len(recording.transforms) == whole
        assert any("exceed the limit of one read (262144)" in one for one in recording.damage)


@pytest.mark.parametrize("write", [plain_mcap, write_bag], ids=["mcap", "rosbag1"])
@pytest.mark.parametrize("is_whole", [True, False])
def test_a_topic_description_above_the_size_limit_is_not_read(
    tmp_path, monkeypatch, write, is_whole
):
    path = write(tmp_path / "run", SENT)
    monkeypatch.setattr(container, "LARGEST_DESCRIPTION", 10)
    if not is_whole:
        path.write_bytes(path.read_bytes()[:-3000])
    try:
        with open_recording(path) as recording:
            assert recording.topics == ()
            told = " ".join(recording.damage)
    except InputError as error:
        told = str(error)

    assert "the limit is 10" in told or "0 messages were read" in told


def first_index(data, code):
    """Return the position of the first record with a code in an MCAP file."""
    place = 8
    while data[place] != code:
        place += 9 + struct.unpack_from("<Q", data, place + 1)[0]
    return place


def changed_mcap(data):
    """Give the first channel in a chunk another number, and damage an index."""
    place = data.index(b"\x0a\x00\x00\x00/tf_static") - 4
    data[place : place + 2] = b"\x63\x00"
    data[first_index(data, 7)] = 0x70


def changed_bag(data):
    """Change a connection's number in a bag in the same way."""
    chunk = data.index(b"op=\x05")
    place = data.index(b"conn=", data.index(b"op=\x07", chunk) - 40) + 5
    data[place] = 99
    data[data.index(b"op=\x04", chunk) + 3] = 0x70


@pytest.mark.parametrize(
    ("write", "change"),
    [(plain_mcap, changed_mcap), (write_bag, changed_bag)],
    ids=["mcap", "rosbag1"],
)
def test_a_damaged_chunk_does_not_change_the_known_topics(tmp_path, write, change):
    path = write(tmp_path / "run", SENT)
    with open_recording(path) as recording:
        before = [topic.name for topic in recording.topics]
    data = bytearray(path.read_bytes())
    change(data)
    path.write_bytes(data)

    with open_recording(path) as recording:
        counts = {topic.name: topic.count for topic in recording.topics}
        assert len(recording.transforms)
        assert recording.damage
        # No other topics are known, and each of these can still be read.
        assert {topic.name: topic.count for topic in recording.topics} == counts
        assert list(counts) == before
        assert sum(1 for _ in recording.source.messages(before))


COLUMNS = "id, name, type, serialization_format, offered_qos_profiles"
TOPICS = f"create table topics({COLUMNS})"
MESSAGES = "create table messages(id, topic_id, timestamp, data)"
COUNTING = "with recursive c(x) as (select 1 union all select x + 1 from c)"


def odd_database(path, statements, rows=(), topics=((1, "/tf", TF, "cdr", ""),)):
    base = sqlite3.connect(path)
    for one in statements:
        base.execute(one)
    if TOPICS in statements:
        base.executemany("insert into topics values (?, ?, ?, ?, ?)", topics)
    if rows:
        base.executemany("insert into messages values (?, ?, ?, ?)", rows)
    base.commit()
    base.close()
    return path


@pytest.mark.parametrize(
    "statements",
    [
        [f"create view topics as {COUNTING} select x as id, 'a' as name, 'b' as type from c"],
        [
            TOPICS,
            f"create view messages as {COUNTING} select x as id, 1 as topic_id, x as timestamp, "
            "x'00' as data from c",
        ],
        [
            TOPICS,
            "create table messages(id, topic_id, timestamp, "
            "data generated always as (zeroblob(900000000)) virtual)",
        ],
    ],
    ids=["topics", "messages", "generated"],
)
def test_a_database_whose_rows_are_made_up_is_no_recording(tmp_path, statements):
    path = odd_database(tmp_path / "run.db3", statements)

    with pytest.raises(InputError, match="not a recording of rosbag2"):
        open_recording(path)


def test_of_a_database_that_is_no_recording_nothing_is_left_open(tmp_path, monkeypatch):
    # The file and its log are copied, because some data is only in the log.
    copies = tmp_path / "copies"
    copies.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(copies))
    base = database(tmp_path / "run.db3", SENT)
    base.execute("alter table messages rename to other")
    base.commit()

    with pytest.raises(InputError, match="not a recording of rosbag2"):
        open_recording(tmp_path / "run.db3")

    assert list(copies.iterdir()) == []
    base.close()


def test_definitions_that_are_made_up_are_not_read(tmp_path, capsys):
    endless = f"create view message_definitions as {COUNTING} select 'a' as topic_type, x as "
    views = [TOPICS, MESSAGES, f"{endless} encoded_message_definition, 'b' as encoding from c"]
    path = odd_database(tmp_path / "run.db3", views, [(1, 1, 5, b"")])

    with open_recording(path) as recording:
        assert recording.topics[0].definition == ""
    assert main(["edit", str(path), "-o", str(tmp_path / "out.mcap")]) == 0
    assert "1 message written" in capsys.readouterr().out


@pytest.mark.parametrize("number", [None, "abc", b"\x00", float("inf"), 1.5])
def test_a_topic_whose_number_is_none_is_left_out_and_told(tmp_path, number):
    topics = [(number, "/odd", TF, "cdr", ""), (2, "/tf", TF, "cdr", "")]
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], topics=topics)

    with open_recording(path) as recording:
        assert [topic.name for topic in recording.topics] == ["/tf"]
        assert recording.damage == ("Topic '/odd' is left out: its id is not a whole number.",)


@pytest.mark.parametrize("odd", [None, "abc", b"\x00", 1e300])
@pytest.mark.parametrize("is_first", [True, False])
def test_a_row_without_a_moment_is_left_out_and_told(tmp_path, odd, is_first):
    sent = [one for one in SENT if one.topic == "/tf"]
    rows = [(n, 1, one.log_time, payload(one)) for n, one in enumerate(sent, start=1)]
    rows.insert(0 if is_first else 9, (100 if is_first else 200, 1, odd, rows[0][3]))
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], rows)

    with open_recording(path) as recording:
        assert len(recording.transforms) == sum(len(one.transforms) for one in sent)
        assert recording.source.start == sent[0].log_time
        assert recording.source.end == sent[-1].log_time
        (damage,) = recording.damage
        assert "not a whole number" in damage


def test_rows_whose_numbers_are_texts_are_left_out_and_told(tmp_path):
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], [("a", 1, 5, b"")])

    with open_recording(path, progress=lambda done, total: None) as recording:
        assert len(recording.transforms) == 0
        assert any("not a whole number" in one for one in recording.damage)


def test_moments_before_1970_are_written_as_their_beginning(tmp_path, capsys):
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], [(1, 1, -(2**63), b"1234")])
    target = tmp_path / "out.mcap"

    assert main(["edit", str(path), "-o", str(target)]) == 0

    with open_recording(target) as recording:
        assert [one.log_time for one in recording.raw_messages("/tf")] == [0]


def test_large_messages_of_a_database_are_not_held_all_at_once(tmp_path):
    rows = [(number, 1, number, bytes(4 << 20)) for number in range(1, 61)]
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], rows)

    assert largest_held(path) < 300e6


def largest_held(path):
    """Return the most bytes that Python allocates while every message of /tf is read."""
    with open_recording(path) as recording:
        tracemalloc.start()
        assert sum(1 for _ in recording.raw_messages("/tf")) == 60
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    return most


def test_messages_that_become_large_are_not_held_all_at_once(tmp_path, monkeypatch):
    monkeypatch.setattr(reading, "MOST_UNPACKED", 4 << 20)
    monkeypatch.setattr(cutting, "MOST_WAITING", 4 << 20)
    packed = zstandard.ZstdCompressor().compress(bytes(1 << 20))
    rows = [(number, 1, number, packed) for number in range(1, 61)]
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], rows)

    assert largest_held(path) < 30e6
    with open_recording(path) as recording:
        tracemalloc.start()
        assert len(recording.transforms) == 0
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    assert most < 30e6


def test_a_compressed_file_that_becomes_far_too_large_is_refused_early(tmp_path):
    path = tmp_path / "run.mcap.zstd"
    path.write_bytes(zstandard.ZstdCompressor().compress(b"\x89MCAP0\r\n" + bytes(100_000_000)))
    assert path.stat().st_size < 20_000

    with pytest.raises(InputError, match=r"unpacks to more than .* implausible"):
        open_recording(path)


def test_messages_outside_of_chunks_are_not_held_all_at_once(tmp_path, monkeypatch):
    path = plain_mcap(tmp_path / "run", SENT, use_chunking=False)
    monkeypatch.setattr(mcap_read, "MOST_BYTES_HELD", 1000)
    tape = mcap_read.Mcap(path, by_index=False)
    try:
        sizes = [int(block.table().lengths.sum()) for block in tape.blocks()]
    finally:
        tape.close()

    assert sum(sizes) == sum(len(payload(one)) for one in SENT)
    assert max(sizes) < 5000


def test_memory_that_does_not_suffice_is_told_in_a_sentence(tmp_path, monkeypatch, capsys):
    path = write_mcap(tmp_path / "run.mcap", SENT)

    def at(*_):
        raise MemoryError

    monkeypatch.setattr(container.File, "at", at)

    assert main(["info", str(path)]) == 3
    assert "not enough memory left" in capsys.readouterr().err


def test_topics_of_a_closed_database_are_refused_and_not_counted_as_empty(tmp_path):
    path = odd_database(tmp_path / "run.db3", [TOPICS, MESSAGES], [(1, 1, 5, b"")])
    with open_recording(path) as recording:
        pass

    with pytest.raises(UsageError, match="is closed: read the recording inside"):
        _ = recording.topics
    assert recording.damage == ()


def test_a_recording_cannot_be_sent_to_another_process_and_says_what_to_do(tmp_path):
    with (
        open_recording(write_mcap(tmp_path / "run.mcap", SENT)) as recording,
        pytest.raises(UsageError, match="call open_recording in that process"),
    ):
        pickle.dumps(recording)
