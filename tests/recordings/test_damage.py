"""Tests that any damage of a file leads to a result or a sentence, and to nothing else."""

import bz2
import errno
import random
import struct
import sys
import tracemalloc
from pathlib import Path

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

import lz4.frame
import zstandard

from tests.recordings.writers import (
    CONTAINERS,
    content,
    write_mcap,
    write_rosbag1,
    write_rosbag2,
    write_split,
)
from tftool import InputError, Recording, UsageError, open_recording
from tftool.recordings import decompression as compressed
from tftool.recordings.decompression import compressor
from tftool.recordings.edit.changes import Edits
from tftool.recordings.edit.rewrite import edit
from tftool.recordings.mcap import format as mcap_records
from tftool.recordings.mcap.read import Mcap
from tftool.recordings.rosbag1 import format as rosbag1_records

SENT = content()
SINGLE = [name for name in CONTAINERS if "split" not in name]


def file_of(path):
    """Return the only file with messages."""
    if path.is_file():
        return path
    return next(one for one in path.iterdir() if one.name != "metadata.yaml")


def asked(path):
    """Read a recording completely; return its number of transforms, or None if it is refused."""
    try:
        with open_recording(path) as recording:
            assert recording.buffer.frames() is not None
            assert recording.topics is not None
            recording.source.headers()
            recording.source.clock()
            for _ in recording.source.messages([topic.name for topic in recording.topics]):
                pass
            return len(recording.transforms)
    except InputError:
        return None


@pytest.mark.parametrize("name", SINGLE)
def test_a_cut_file_gives_what_stands_before_the_cut_or_is_refused(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    file = file_of(path)
    raw = file.read_bytes()
    whole = asked(path)
    draw = random.Random(name)

    for _ in range(20):
        file.write_bytes(raw[: draw.randrange(len(raw))])

        found = asked(path)

        assert found is None or found <= whole


@pytest.mark.parametrize("name", SINGLE)
def test_a_file_with_flipped_bits_is_answered_or_refused(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    file = file_of(path)
    raw = file.read_bytes()
    draw = random.Random(name)

    for flips in [1] * 10 + [10] * 5 + [1000] * 5:
        changed = bytearray(raw)
        for _ in range(flips):
            changed[draw.randrange(len(raw))] ^= 1 << draw.randrange(8)
        file.write_bytes(changed)

        found = asked(path)

        assert found is None or found >= 0


@pytest.mark.parametrize("share", [0.4, 0.7, 0.99])
@pytest.mark.parametrize(
    "write",
    [lambda p: write_mcap(p / "a.mcap", SENT), lambda p: write_rosbag1(p / "a.bag", SENT)],
)
def test_samples_read_from_a_cut_file_are_the_first_of_the_whole_file(tmp_path, write, share):
    path = write(tmp_path)
    with open_recording(path) as recording:
        whole = {edge.child: edge.records.tolist() for edge in recording.edges}
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])

    with open_recording(path) as recording:
        found = {edge.child: edge.records.tolist() for edge in recording.edges}
        damage = "\n".join(recording.damage)

    assert found
    assert "breaks off at byte" in damage or "was not closed" in damage
    for child, records in found.items():
        assert records == whole[child][: len(records)]


def test_a_bag_that_was_not_closed_is_read_whole(tmp_path):
    path = write_rosbag1(tmp_path / "a.bag", SENT)
    with open_recording(path) as recording:
        count = len(recording.transforms)
    raw = bytearray(path.read_bytes())
    place = raw.index(b"index_pos=") + len(b"index_pos=")
    raw[place : place + 8] = bytes(8)
    path = path.with_suffix(".bag.active")
    path.write_bytes(raw)

    with open_recording(path) as recording:
        assert len(recording.transforms) == count
        assert recording.damage == ("The recording was not closed.",)


def test_a_chunk_that_rosbag_had_open_is_read_to_the_end_of_the_file(tmp_path):
    path = write_rosbag1(tmp_path / "a.bag", SENT)
    raw = bytearray(path.read_bytes())
    place = raw.index(b"index_pos=") + len(b"index_pos=")
    raw[place : place + 8] = bytes(8)
    start = raw.index(b"op=\x05") - 8
    data = start + 8 + struct.unpack_from("<I", raw, start)[0]
    raw = raw[: data + struct.unpack_from("<I", raw, data - 4)[0]]
    path.write_bytes(raw)
    with open_recording(path) as recording:
        whole = len(recording.transforms)
    # rosbag writes a chunk's two sizes, and the following indexes, when it closes the chunk.
    size = raw.index(b"size=", start) + len(b"size=")
    raw[size : size + 4] = raw[data - 4 : data] = bytes(4)
    path.write_bytes(raw)

    with open_recording(path) as recording:
        assert len(recording.transforms) == whole > 0
        assert recording.damage == ("The recording was not closed.",)


@pytest.fixture
def locked(monkeypatch):
    """Return a set; files whose names are in the set cannot be opened, even by root."""
    names, opens = set(), Path.open

    def refusing(path, *words, **more):
        if path.name in names:
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return opens(path, *words, **more)

    monkeypatch.setattr(Path, "open", refusing)
    return names


@pytest.mark.parametrize("word", ["", "/*.mcap"])
def test_a_file_that_may_not_be_read_is_left_out_of_many(tmp_path, locked, word):
    folder = tmp_path / "runs"
    folder.mkdir()
    middle = len(SENT) // 2
    for name, sent in (("a", SENT[:middle]), ("b", SENT[middle:]), ("locked", SENT)):
        write_mcap(folder / f"{name}.mcap", sent)
    locked.add("locked.mcap")

    with open_recording(f"{folder}{word}") as recording:
        count = len(recording.transforms)
        assert recording.damage == (
            f"locked.mcap is left out: '{folder / 'locked.mcap'}' cannot be read: permission "
            "denied.",
        )
    report = edit([f"{folder}{word}"], tmp_path / "out.mcap", Edits())
    assert count > 100
    assert report.messages == len(SENT)
    assert "locked.mcap is left out" in report.notes[0]

    locked |= {"a.mcap", "b.mcap"}
    with pytest.raises(InputError, match=r"a\.mcap' cannot be read: permission denied\.$"):
        open_recording(f"{folder}{word}")


def test_a_part_that_may_not_be_read_or_is_none_is_left_out_of_a_split_recording(tmp_path, locked):
    path = write_split(tmp_path / "run", SENT, 4)
    locked.add("run_1.mcap")
    (path / "run_2.mcap").write_bytes(b"")

    with open_recording(path) as recording:
        assert len(recording.transforms) > 50
        damage = recording.damage
    assert damage[0].startswith("run_1.mcap is left out: ")
    assert damage[0].endswith("cannot be read: permission denied.")
    assert damage[1].startswith("run_2.mcap is left out: ")
    assert damage[1].endswith("is an empty file (0 bytes): nothing was recorded.")
    assert len(damage) == 2
    (path / "metadata.yaml").unlink()
    with open_recording(path) as recording:
        assert any("permission denied" in text for text in recording.damage)


def test_too_many_open_files_are_no_damage_of_one(tmp_path, monkeypatch):
    path = write_split(tmp_path / "run", SENT, 3)

    def none_left(*_, **options):
        raise OSError(errno.EMFILE, "Too many open files")

    monkeypatch.setattr(Mcap, "__init__", none_left)

    with pytest.raises(InputError, match="Too many open files"):
        open_recording(path)


def test_a_summary_with_a_wrong_crc_is_not_believed(tmp_path):
    path = write_mcap(tmp_path / "run.mcap", SENT)
    data = bytearray(path.read_bytes())
    (begin,) = struct.unpack_from("<Q", data, len(data) - 28)
    place = data.index(b"tf2_msgs", begin)
    data[place : place + 8] = b"std_msgs"
    path.write_bytes(data)

    with open_recording(path) as recording:
        assert {one.type for one in recording.topics if one.name == "/tf"} == {"tf2_msgs/TFMessage"}
        assert recording.damage == ("The summary cannot be read (the CRC is wrong).",)
    edit([path], tmp_path / "out.mcap", Edits())
    with open_recording(tmp_path / "out.mcap") as recording:
        assert {one.type for one in recording.topics if one.name == "/tf"} == {"tf2_msgs/TFMessage"}


def test_metadata_of_more_than_16_mb_is_not_read(tmp_path):
    path = write_rosbag2(tmp_path / "a", SENT)
    text = (path / "metadata.yaml").read_text().replace("storage_identifier: ", "custom: ours #")
    (path / "metadata.yaml").write_text(text + "# x" * (1 << 23))

    with open_recording(path) as recording:
        assert "metadata.yaml cannot be read (it is too large)" in recording.damage[0]
    edit([path], tmp_path / "out", Edits())
    assert "custom: ours" not in (tmp_path / "out" / "metadata.yaml").read_text()


def test_metadata_that_lies_is_told_and_not_believed(tmp_path):
    path = write_rosbag2(tmp_path / "a", SENT)
    (path / "a.db3").rename(path / "renamed.db3")
    with open_recording(path) as recording:
        assert len(recording.transforms) > 100
        assert "names 'a.db3', which is missing" in recording.damage[0]
        assert "Read instead: 'renamed.db3'" in recording.damage[1]
        count = sum(topic.count for topic in recording.topics)
        assert f"all {count} messages that the metadata counts" in recording.damage[1]
    metadata = (path / "metadata.yaml").read_text()
    more = metadata.replace(f"message_count: {count}\n", f"message_count: {count + 1}\n")
    (path / "metadata.yaml").write_text(more)
    with open_recording(path) as recording:
        assert recording.damage[1] == "Read instead: 'renamed.db3'."
    (path / "metadata.yaml").write_text("}{")
    with open_recording(path) as recording:
        assert len(recording.transforms) > 100
        assert "cannot be read" in recording.damage[0]
    (path / "metadata.yaml").unlink()
    with open_recording(path) as recording:
        assert len(recording.transforms) > 100


@pytest.mark.parametrize("name", ["ros 1 lz4", "ros 1 bz2", "mcap zstd", "mcap lz4"])
def test_a_chunk_that_cannot_be_unpacked_is_told_once(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)
    raw = bytearray(path.read_bytes())
    magic = {"bz2": b"BZh", "lz4": b"\x04\x22\x4d\x18", "zstd": b"\x28\xb5\x2f\xfd"}
    place = raw.index(magic[name.split()[-1]])
    raw[place : place + 40] = bytes(40)
    path.write_bytes(raw)

    with open_recording(path) as recording:
        assert len(recording.transforms) > 100
        (damage,) = recording.damage

    assert damage.startswith("A chunk at byte ")


@pytest.mark.parametrize("is_chunked", [True, False])
def test_a_message_that_is_shorter_than_its_head_is_told(tmp_path, is_chunked):
    path = CONTAINERS["mcap none" if is_chunked else "mcap unchunked"](tmp_path, SENT)
    raw = path.read_bytes()
    # The position is the header of a message in the middle of the file, found by its channel and
    # sequence number.
    place = raw.index(b"\x00\x01\x00\x00", len(raw) // 3) - 31
    assert raw[place] == 0x05
    changed = bytearray(raw)
    changed[place + 1 : place + 9] = (7).to_bytes(8, "little")
    # Without the summary, the whole file is read.
    path.write_bytes(changed[:-37])

    with open_recording(path) as recording:
        assert len(recording.transforms) > 30
        # In a chunk, the wrong index is found first.
        told = "message index points" if is_chunked else "message record has only 7 bytes"
        assert any(told in one for one in recording.damage)


@pytest.mark.parametrize("size", [2**62, 2**30 + 1, 10**8])
def test_a_chunk_that_announces_too_much_is_not_unpacked(tmp_path, size):
    path = write_mcap(tmp_path / "a.mcap", SENT, use_statistics=False)
    raw = bytearray(path.read_bytes())
    place = 8
    while raw[place] != 0x06:
        place += 9 + int.from_bytes(raw[place + 1 : place + 9], "little")
    raw[place + 25 : place + 33] = size.to_bytes(8, "little")
    # Without the summary, the chunk's own header is used.
    path.write_bytes(raw[:-37])

    with open_recording(path) as recording:
        recording.buffer.frames()

        assert any("bytes instead of" in one or "cannot expand" in one for one in recording.damage)


def test_a_damaged_piece_names_the_missing_package_that_unpacks_it(monkeypatch):
    packed = zstandard.ZstdCompressor().compress(b"text" * 100)
    monkeypatch.setitem(sys.modules, "zstandard", None)

    with pytest.raises(UsageError, match="pip install zstandard"):
        compressed.unpack_beginning("zstd", packed[:-5], 400)


def test_of_a_damaged_piece_that_unpacks_to_much_only_a_part_is_held(monkeypatch):
    monkeypatch.setattr(compressed, "LARGEST_DAMAGED", 10_000)
    packed = zstandard.ZstdCompressor().compress(random.Random(1).randbytes(500) * 100)

    found = compressed.unpack_beginning("zstd", packed, 60_000)

    assert found == (random.Random(1).randbytes(500) * 100)[:10_000]


def test_of_a_piece_with_a_wrong_checksum_all_is_read():
    text = random.Random(2).randbytes(300) * 200
    packed = lz4.frame.compress(
        text, block_size=lz4.frame.BLOCKSIZE_MAX4MB, content_checksum=True, store_size=False
    )

    found = compressed.unpack_beginning("lz4", packed[:-1] + bytes([packed[-1] ^ 1]), len(text))

    assert found == text


@pytest.mark.parametrize("method", ["lz4", "zstd"])
def test_of_a_damaged_piece_what_stands_before_the_damage_is_read(method):
    text = random.Random(3).randbytes(90_000)
    packed = bytearray(compressor(method)(text))
    packed[len(packed) // 2] ^= 0xFF

    found = compressed.unpack_beginning(method, bytes(packed), len(text))

    assert found[:20_000] == text[:20_000]
    assert compressed.unpack_beginning(method, b"nothing of the kind", 100) == b""


@pytest.mark.parametrize(
    "pack", [bz2.compress, lz4.frame.compress, zstandard.ZstdCompressor().compress]
)
def test_of_a_piece_that_becomes_much_more_than_it_says_no_more_is_made(pack):
    method = {bz2.compress: "bz2", lz4.frame.compress: "lz4"}.get(pack, "zstd")
    packed = pack(bytes(100_000_000))
    tracemalloc.start()

    found = compressed.unpack_beginning(method, packed, 10_000)

    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found == bytes(10_000)
    assert most < 2_000_000


@pytest.mark.parametrize(
    ("records_in", "told"),
    [
        (mcap_records.records_in, "code 0"),
        (rosbag1_records.records_in, "header would have 0 bytes"),
    ],
)
def test_zero_bytes_in_a_chunk_are_refused_as_no_record(records_in, told):
    with pytest.raises(InputError, match=told):
        list(records_in(bytes(100)))


def test_a_compressed_file_of_four_bytes_breaks_off_and_is_not_called_empty(tmp_path):
    cut = tmp_path / "run.mcap.zst"
    cut.write_bytes(b"\x28\xb5\x2f\xfd")

    with pytest.raises(InputError, match=r"run\.mcap\.zst' ends after 4 bytes") as refused:
        open_recording(cut)
    assert str(tmp_path) in str(refused.value)
    assert "empty" not in str(refused.value)


@pytest.mark.parametrize("write", [write_mcap, write_rosbag1])
def test_a_file_that_is_written_over_while_it_is_read_is_said_to_have_changed(
    tmp_path, monkeypatch, write
):
    path = write(tmp_path / "run", content(200))
    read = Recording.__init__

    def overwritten(self, *words, **named):
        path.write_bytes(path.read_bytes()[:-100] + bytes(7))
        read(self, *words, **named)
        self.close()
        # Errors of numpy and struct for numbers out of range
        raise OverflowError("int too large to convert")

    monkeypatch.setattr(Recording, "__init__", overwritten)
    with pytest.raises(
        InputError, match="changed while it was read: try again when the recording is complete"
    ):
        open_recording(path)


def test_a_recording_that_a_killed_recorder_left_is_named_with_its_repair(tmp_path):
    path = write_mcap(tmp_path / "run.mcap", content(20))
    path.rename(tmp_path / "run.mcap.active")

    with pytest.raises(InputError, match=r"'tftool edit \S+run\.mcap\.active -o \S+run\.mcap'"):
        open_recording(path)
