"""Tests of edited sqlite files, in which only the changed rows are written."""

import sqlite3
from contextlib import closing

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from mcap.reader import SeekingReader

from tests.recordings.edit.outcomes import NEW_POSE, SENT, START, edges
from tests.recordings.writers import CONTAINERS
from tftool.recordings.edit.changes import Edits
from tftool.recordings.edit.rewrite import edit


def rows(path):
    """Return number, topic and bytes of every row of a database."""
    with closing(sqlite3.connect(path)) as base:
        asked = (
            "select messages.id, name, timestamp, data from messages "
            "join topics on topics.id = topic_id order by messages.id"
        )
        return base.execute(asked).fetchall()


@pytest.fixture
def database(tmp_path):
    """Write a sqlite file whose row numbers begin late and have gaps, with a foreign table."""
    path = next(CONTAINERS["db3"](tmp_path, SENT).glob("*.db3"))
    with closing(sqlite3.connect(path)) as base:
        base.execute("pragma journal_mode = wal")
        base.execute("update messages set id = -(3 * id + 1000)")
        base.execute("update messages set id = -id")
        base.execute("create table notes(text)")
        base.execute("insert into notes values ('wheels changed')")
        base.commit()
    return path


def test_a_database_is_copied_and_only_rows_that_change_are_written(database, tmp_path):
    out = tmp_path / "out.db3"

    edit([str(database)], out, Edits(poses={("base_link", "laser"): NEW_POSE}))

    before, after = rows(database), rows(out)
    assert [one[:3] for one in after] == [one[:3] for one in before]
    differ = {one[1] for one, other in zip(before, after, strict=True) if one != other}
    assert differ == {"/tf_static"}
    assert edges(out)["base_link", "laser"] == [(0, *NEW_POSE)]
    with closing(sqlite3.connect(out)) as base:
        assert base.execute("select text from notes").fetchall() == [("wheels changed",)]
        assert base.execute("pragma integrity_check").fetchone() == ("ok",)
    assert sorted(one.name for one in tmp_path.iterdir() if "out" in one.name) == ["out.db3"]


def test_a_database_with_other_files_beside_it_is_copied_as_well(database, tmp_path):
    folder, out = tmp_path / "folder", tmp_path / "out.db3"
    folder.mkdir()
    database.rename(folder / "run.db3")
    (folder / "notes.txt").write_text("wheels changed", "utf-8")

    report = edit([str(folder)], out, Edits(poses={("base_link", "laser"): NEW_POSE}))

    assert report.notes == ["Ignored, because these are not recordings: 'notes.txt'."]
    with closing(sqlite3.connect(out)) as base:
        assert base.execute("select text from notes").fetchall() == [("wheels changed",)]


def test_dropped_messages_are_not_in_the_rows_or_bytes_of_the_new_database(database, tmp_path):
    out = tmp_path / "out.db3"

    report = edit([str(database)], out, Edits(drop=(("*", "*"),)))

    kept = [one for one in rows(database) if not one[1].startswith("/tf")]
    assert rows(out) == kept
    assert 0 < report.messages == len(kept) < len(SENT)
    gone = [one[3] for one in rows(database) if one[1].startswith("/tf")]
    assert all(payload in database.read_bytes() for payload in gone)
    assert not any(payload in out.read_bytes() for payload in gone)


def damage(path):
    """Overwrite the page in the middle of a database with zeros."""
    raw = bytearray(path.read_bytes())
    size = int.from_bytes(raw[16:18], "big")
    number = len(raw) // size // 2
    raw[number * size : (number + 1) * size] = bytes(size)
    path.write_bytes(raw)


def test_a_damaged_database_is_read_row_by_row_and_comes_out_whole(tmp_path):
    path = next(CONTAINERS["db3"](tmp_path, SENT).glob("*.db3"))
    damage(path)
    out = tmp_path / "out.db3"

    report = edit([str(path)], out, Edits(prefix="r1/"))

    assert any("cannot be read" in note for note in report.notes)
    assert 0 < report.messages < len(SENT)
    with closing(sqlite3.connect(out)) as base:
        assert base.execute("pragma integrity_check").fetchone() == ("ok",)
    assert len(rows(out)) == report.messages


def test_texts_of_a_damaged_database_may_be_any_bytes(tmp_path):
    path = next(CONTAINERS["db3"](tmp_path, SENT).glob("*.db3"))
    with closing(sqlite3.connect(path)) as base:
        base.execute("update topics set offered_qos_profiles = cast(x'616263d264' as text)")
        base.commit()
    damage(path)
    out = tmp_path / "out.db3"

    edit([str(path)], out, Edits())

    with closing(sqlite3.connect(out)) as base:
        asked = "select distinct cast(offered_qos_profiles as blob) from topics"
        assert b"abc\xd2d" in {one for (one,) in base.execute(asked)}


def test_a_database_of_many_pages_becomes_another_container_message_by_message(tmp_path):
    """Check a database with more pages than are read at once; several parts are in memory."""
    path = next(CONTAINERS["db3"](tmp_path, SENT).glob("*.db3"))
    rows_of_a_page = [
        (number, bytes([0, 1, 0, 0]) + number.to_bytes(3000)) for number in range(1600)
    ]
    with closing(sqlite3.connect(path)) as base:
        topic = base.execute("select id from topics where name = '/imu'").fetchone()
        topic = topic or base.execute("select id from topics where name not like '/tf%'").fetchone()
        base.execute("delete from messages")
        base.executemany(
            "insert into messages (topic_id, timestamp, data) values (?, ?, ?)",
            [(topic[0], START + number, data) for number, data in rows_of_a_page],
        )
        base.commit()
        assert base.execute("pragma page_count").fetchone()[0] > 4 * 256
    out = tmp_path / "out.mcap"

    edit([str(path)], out, Edits())

    with out.open("rb") as file:
        read = [
            (log, one.data)
            for *_, one in SeekingReader(file).iter_messages()
            for log in [one.log_time]
        ]
    assert read == [(START + number, data) for number, data in rows_of_a_page]
