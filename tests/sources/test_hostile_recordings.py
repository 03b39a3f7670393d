"""Recordings that are still written, were never closed, or are made to do harm."""

import os
import shutil
import sqlite3

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")
pytest.importorskip("zstandard", reason="the extra 'recordings' is not installed")

from mcap.writer import Writer

from tests.sources.writers import TF, content, payload, write_mcap
from tests.sources.writers import write_rosbag1 as write_bag
from tftool import open_recording

SENT = content(40)


def database(path, sent):
    """A database as rosbag2's recorder writes it, in the mode that keeps a log beside it."""
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


def test_what_stands_in_a_write_ahead_log_is_read_and_nothing_is_written(tmp_path):
    base = database(tmp_path / "live.db3", SENT)
    # As a recorder that was killed leaves them.
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
