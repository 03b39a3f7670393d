"""Tests that the native reader of sqlite pages gives the messages that sqlite gives."""

import random
import sqlite3

import numpy as np
import pytest

from tests.recordings.scanning import REASON, is_native
from tftool import InputError
from tftool.messages.transform_rows import SCAN
from tftool.recordings.rosbag2 import read as sqlite
from tftool.recordings.rosbag2.read import read_pages

needs_scan = pytest.mark.skipif(not is_native(), reason=REASON)
TOPICS = ["/tf", "/image", "/tf_static"]


def database(path, page_size=4096, rows=900, key="id INTEGER PRIMARY KEY"):
    """Write a recording with short and long messages, and ids with gaps."""
    draw = random.Random(page_size)
    base = sqlite3.connect(path)
    base.execute(f"pragma page_size = {page_size}")
    base.execute(
        "create table topics(id integer primary key, name text, type text, "
        "serialization_format text, offered_qos_profiles text)"
    )
    base.execute(
        f"CREATE TABLE messages({key},topic_id INTEGER NOT NULL,"
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL)"
    )
    base.execute("create index timestamp_idx on messages (timestamp asc)")
    for number, name in enumerate(TOPICS, start=1):
        base.execute("insert into topics values(?, ?, 'a/B', 'cdr', '')", (number, name))
    for number in range(rows):
        size = draw.choice((0, 1, 120, 500, 4000, 4057, 4058, 4061, 4062, 20_000))
        moment = draw.choice((0, 1, -5, 200, 70_000, 2**40, 1_750_000_000_123_456_789))
        told = (3 * number + 2, draw.randrange(1, 4), moment, draw.randbytes(size))
        base.execute("insert into messages values(?, ?, ?, ?)", told)
    base.commit()
    base.close()
    return path


def read(path, wanted, scan):
    """Return the messages of some topics as (log time, topic, payload), and the reported damage."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sqlite, "SCAN", scan)
        try:
            container = sqlite.Sqlite(path)
        except InputError:
            return None
        found = [
            (int(batch.log_times[k]), int(batch.senders[k]), batch.payload(k))
            for batch in container.batches(wanted)
            for k in range(len(batch))
        ]
        container.close()
        return found


@needs_scan
@pytest.mark.parametrize("page_size", [512, 1024, 4096, 65536])
def test_gives_the_messages_that_sqlite_gives(tmp_path, page_size):
    path = database(tmp_path / "a.db3", page_size)
    base = sqlite3.connect(path)
    (root,) = base.execute("select rootpage from sqlite_master where name = 'messages'").fetchone()
    rows = base.execute("select timestamp, topic_id - 1, data from messages order by id").fetchall()
    base.close()

    pieces = list(read_pages(path, root, {1: 0, 2: 1, 3: 2}))

    found = [
        (int(batch.log_times[k]), int(batch.senders[k]), batch.payload(k))
        for batch, _ in pieces
        for k in range(len(batch))
    ]
    assert found == rows
    assert pieces[-1][1] == 3 * 899 + 2
    assert read(path, [0, 2], sqlite.SCAN) == [row for row in rows if row[1] != 1]


@needs_scan
def test_gives_the_same_of_damaged_files(tmp_path):
    raw = database(tmp_path / "a.db3", rows=200).read_bytes()
    draw = random.Random(4)
    path = tmp_path / "b.db3"
    for turn in range(60):
        changed = bytearray(raw)
        for _ in range(1 + turn % 4):
            # The beginning of a page contains its structure.
            place = draw.randrange(len(raw) // 4096) * 4096 + draw.randrange(60)
            changed[place] ^= 1 << draw.randrange(8)
        path.write_bytes(changed[: draw.choice((len(raw), draw.randrange(len(raw))))])

        native, plain = read(path, [0, 1, 2], sqlite.SCAN), read(path, [0, 1, 2], None)

        assert (native is None) == (plain is None)
        if plain is not None:
            # If sqlite refuses a file because of a page that is not needed, the native reader may
            # read it.
            assert set(plain) <= set(native)


@needs_scan
def test_leaves_other_tables_and_files_to_sqlite(tmp_path):
    path = database(tmp_path / "a.db3", rows=10)
    (tmp_path / "short.db3").write_bytes(path.read_bytes()[:50])

    assert list(read_pages(path, 0, {1: 0})) == []
    assert list(read_pages(path, 10**6, {1: 0})) == []
    assert list(read_pages(tmp_path / "short.db3", 3, {1: 0})) == []
    assert list(read_pages(tmp_path / "missing.db3", 3, {1: 0})) == []


@needs_scan
@pytest.mark.parametrize("key", ["id INTEGER", "id INTEGER PRIMARY KEY DESC"])
def test_gives_what_sqlite_gives_where_the_id_is_not_the_rows_own_number(tmp_path, key):
    path = database(tmp_path / "a.db3", rows=10, key=key)
    base = sqlite3.connect(path)
    base.execute("update messages set id = null")
    base.commit()
    base.close()

    # Rows are selected by their id, which no row has.
    assert read(path, [0, 1, 2], sqlite.SCAN) == read(path, [0, 1, 2], None) == []


def test_a_schema_with_bytes_that_are_no_text_is_refused(tmp_path):
    path = database(tmp_path / "a.db3", rows=3)
    raw = path.read_bytes()
    place = raw.index(b"name text")
    path.write_bytes(raw[:place] + b"\x86\x86\x86(" + raw[place + 4 :])

    with pytest.raises(InputError, match="cannot be read"):
        sqlite.Sqlite(path)


@needs_scan
def test_refuses_places_and_arrays_that_are_too_short():
    page = bytearray(4096)
    row = bytes([10, 5, 5, 0, 1, 1, 16, 1, 7]) + b"abc"
    page[0], page[4], page[8:10] = 0x0D, 1, (4000).to_bytes(2, "big")
    page[4000 : 4000 + len(row)] = bytes([9]) + row[1:]
    streams = np.array([[1, 6]])

    def found(pages, place, room=1, size=4096, last=4):
        times, starts, lengths = (np.zeros(room, dtype=np.int64) for _ in range(3))
        senders = np.zeros(1, dtype=np.int32)
        places = np.array([place])
        return SCAN.rows(
            pages, places, streams, senders, times, starts, lengths, size, size, last
        ) and (senders[0], times[0], starts[0], lengths[0])

    assert found(page, 0) == (6, 7, 4009, 2)
    assert found(bytes(4096) + page, 4096) == (6, 7, 4096 + 4009, 2)
    assert found(page, 0, last=5) is None
    assert found(page, 0, room=0) is None
    for place in (-1, 1, 4096, 2**62, -(2**63)):
        assert found(page, place) is None
    for size in (0, 8192, 256, -1, 2**62):
        assert found(page, 0, size=size) is None
