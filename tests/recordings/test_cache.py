"""Tests of columns that are cached for the next lookup in a large recording."""

import json
import os
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.patience import PATIENCE, answered
from tests.recordings.writers import content, write_mcap
from tftool import open_recording
from tftool.recordings import cache_heads as caching
from tftool.recordings.cache_heads import default_folder, frames_kept, key_of
from tftool.recordings.column_cache import ColumnCache
from tftool.recordings.find import find

SENT = content(40)


@pytest.fixture(autouse=True)
def _small_ones_count(monkeypatch):
    monkeypatch.setattr(caching, "WORTHWHILE", 0)


@pytest.fixture
def file(tmp_path):
    return write_mcap(tmp_path / "run.mcap", SENT)


@pytest.fixture
def cache(tmp_path):
    return ColumnCache(tmp_path / "cache")


def transforms_of(file, cache=None):
    """Return the transforms, and whether they were read from the file itself."""
    read = []
    with open_recording(file, cache=cache, progress=lambda *_: read.append(1)) as recording:
        return recording.transforms, bool(read)


def same(one, other):
    assert len(one.edges) == len(other.edges) > 0
    assert one.publishers == other.publishers
    for column in ("log_times", "senders"):
        np.testing.assert_array_equal(getattr(one, column), getattr(other, column))
    for mine, its in zip(one.edges, other.edges, strict=True):
        fields = ("parent", "child", "static", "slashed", "kept")
        assert [getattr(mine, name) for name in fields] == [getattr(its, name) for name in fields]
        np.testing.assert_array_equal(mine.records, its.records)
        np.testing.assert_array_equal(mine.messages, its.messages)


def test_the_second_question_reads_no_message_and_gets_the_same(file, cache):
    first, was_read = transforms_of(file, cache)
    second, is_read = transforms_of(file, cache)

    assert (was_read, is_read) == (True, False)
    same(first, second)


def test_a_file_that_has_changed_is_read_anew(file, cache):
    transforms_of(file, cache)
    write_mcap(file, content(41))

    found, was_read = transforms_of(file, cache)

    assert was_read
    same(found, transforms_of(file)[0])


def test_a_damaged_recording_is_read_anew_and_told_again(file, cache):
    file.write_bytes(file.read_bytes()[:9000])

    for _ in range(2):
        with open_recording(file, cache=cache) as recording:
            assert len(recording.transforms)
            assert recording.damage


@pytest.mark.parametrize("seed", range(40))
def test_garbage_in_the_cache_is_as_if_it_were_not_there(file, cache, seed):
    whole = transforms_of(file, cache)[0]
    (entry,) = cache.folder.iterdir()
    data, draw = bytearray(entry.read_bytes()), random.Random(seed)
    if seed % 4 == 0:
        data = data[: draw.randrange(len(data))]
    elif seed % 4 == 1:
        data = draw.randbytes(draw.randrange(5000))
    else:
        # Columns are padded to multiples of 8 bytes, and the padding is not read.
        data[draw.randrange(2000 if seed % 4 == 2 else 200)] ^= 1 << draw.randrange(8)
    entry.write_bytes(data)

    found, _ = transforms_of(file, cache)

    same(found, whole)


@pytest.mark.parametrize("make", [getattr(os, "mkfifo", os.mkdir), os.mkdir])
def test_a_folder_or_pipe_in_place_of_an_entry_is_passed_over_and_left_alone(file, cache, make):
    entry = cache.folder / f"{key_of(find(str(file)))}.columns"
    cache.folder.mkdir()
    make(entry)
    make(cache.folder / "other.columns")

    assert answered(lambda: frames_kept(find(str(file)))) is None
    found, was_read = answered(lambda: transforms_of(file, cache))

    assert was_read
    same(found, transforms_of(file)[0])
    ColumnCache(cache.folder, most_bytes=30_000).store("0", found)
    assert not (cache.folder / "other.columns").is_file()
    assert (cache.folder / "other.columns").exists()


def test_an_entry_of_another_recording_is_none_of_this(file, cache, tmp_path):
    other = write_mcap(tmp_path / "other.mcap", content(12))
    transforms_of(other, cache)
    (entry,) = cache.folder.iterdir()
    entry.rename(cache.folder / f"{key_of(find(str(file)))}.columns")

    assert transforms_of(file, cache)[1]


def test_the_least_recently_used_entries_are_removed_first(file, tmp_path):
    whole = transforms_of(file)[0]
    size = sum(len(edge) for edge in whole.edges) * 68
    cache = ColumnCache(tmp_path / "cache", most_bytes=3 * size + 20_000)
    for number in range(6):
        assert cache.store(f"{number}", whole)
        cache.load("0")

    kept = {entry.stem for entry in cache.folder.iterdir()}
    assert {"0", "5"} <= kept
    assert len(kept) < 6
    assert sum(entry.stat().st_size for entry in cache.folder.iterdir()) <= 3 * size + 20_000


def test_an_entry_larger_than_the_cache_is_not_kept(file, tmp_path):
    cache = ColumnCache(tmp_path / "cache", most_bytes=1000)

    assert not cache.store("key", transforms_of(file)[0])
    assert not (tmp_path / "cache").exists()


def test_a_cache_that_cannot_be_written_is_no_failure(file, tmp_path):
    (tmp_path / "taken").write_text("a file")

    found, was_read = transforms_of(file, ColumnCache(tmp_path / "taken"))

    assert was_read
    same(found, transforms_of(file)[0])


def test_small_recordings_are_read_as_quickly(file, cache, monkeypatch):
    monkeypatch.setattr(caching, "WORTHWHILE", file.stat().st_size + 1)

    assert transforms_of(file, cache)[1]
    assert transforms_of(file, cache)[1]
    assert not cache.folder.exists()


WRITER = """
import sys
from pathlib import Path
from tftool.recordings import cache_heads as caching
caching.WORTHWHILE = 0
from tftool import open_recording
from tftool.recordings.column_cache import ColumnCache
cache = ColumnCache(Path(sys.argv[2]))
with open_recording(sys.argv[1], cache=cache) as recording:
    whole = recording.transforms
for _ in range(60):
    cache.store("shared", whole)
    found = cache.load("shared")
    assert found is not None
    assert [len(edge) for edge in found.edges] == [len(edge) for edge in whole.edges]
"""


def test_two_processes_share_it(file, cache):
    words = [sys.executable, "-c", WRITER, str(file), str(cache.folder)]
    both = [subprocess.Popen(words, cwd=Path(__file__).parents[2]) for _ in range(2)]

    assert [one.wait(PATIENCE) for one in both] == [0, 0]
    assert not list(cache.folder.glob("*.part"))


def test_the_command_keeps_columns_unless_told_not_to(tmp_path, file, capsys, monkeypatch):
    from tftool.app.main import main

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home"))
    folder = tmp_path / "home" / "tftool"

    def asked(*words):
        assert main(["tree", str(file), "--format", "json", *words]) == 0
        return json.loads(capsys.readouterr().out)

    first = asked("--no-cache")
    assert not folder.exists()
    assert asked() == first
    assert len(list(folder.iterdir())) == 1
    assert asked() == first


def test_the_folder_is_the_users(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert default_folder() == tmp_path / "tftool"
    # A relative path counts as none, as the specification of XDG requires.
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    assert default_folder().is_absolute()
