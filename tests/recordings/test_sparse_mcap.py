"""Tests of reading few messages of an MCAP file: one by one, from many chunks at once."""

import struct

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings import writers
from tests.recordings.scanning import cdr
from tftool import open_recording
from tftool.recordings.mcap.read import Mcap

CHUNKS = 60
IMAGE = bytes(range(256)) * 400
SECOND = 10**9


@pytest.fixture
def path(tmp_path):
    """Write a file with two transforms per chunk, beside an image of 100 KB."""
    path = tmp_path / "big.mcap"
    with path.open("wb") as stream:
        writer = writers.McapWriter(stream, 100_000, writers.CompressionType.NONE)
        writer.start("ros2")
        text = writers.ROS2.generate_msgdef(writers.TF, ros_version=2)[0]
        schema = writer.register_schema(writers.TF, "ros2msg", text.encode())
        channel = writer.register_channel("/tf", "cdr", schema)
        pictures = writer.register_channel("/image", "raw", 0)
        for number in range(CHUNKS):
            for moment in (2 * number + 1, 2 * number + 2):
                payload = cdr([(moment * SECOND, "world", "turtle1")])
                writer.add_message(channel, moment * SECOND, payload, moment * SECOND)
            writer.add_message(pictures, moment * SECOND, IMAGE, moment * SECOND)
        writer.finish()
    return path


def stamps(path):
    with open_recording(path) as recording:
        (edge,) = recording.edges
        return (edge.stamps // SECOND).tolist(), recording.damage


def indexes(raw):
    """Return the positions of the message indexes of the channel with transforms."""
    head = b"\x07" + struct.pack("<QH", 6 + 2 * 16, 1)
    places, place = [], raw.find(head)
    while place >= 0:
        places.append(place)
        place = raw.find(head, place + 1)
    return places


def test_reads_little_and_keeps_the_order(path):
    container = Mcap(path)

    batches = list(container.batches([0, 1], head=200))

    container.close()
    assert stamps(path) == (list(range(1, 2 * CHUNKS + 1)), ())
    assert container.read < 0.1 * path.stat().st_size
    times = np.concatenate([one.log_times for one in batches]) // SECOND
    assert times.tolist() == sorted([*range(1, 2 * CHUNKS + 1), *range(2, 2 * CHUNKS + 1, 2)])


@pytest.mark.parametrize("number", [0, 30, CHUNKS - 1])
def test_a_chunk_whose_index_lies_is_walked_in_its_place(path, number):
    raw = bytearray(path.read_bytes())
    places = indexes(raw)
    assert len(places) == CHUNKS
    # The index of the chunk's second message points three bytes behind its beginning.
    raw[places[number] + 15 + 24] += 3
    path.write_bytes(raw)

    found, damage = stamps(path)

    assert found == list(range(1, 2 * CHUNKS + 1))
    assert any("points at something other" in one for one in damage)


def test_large_messages_are_not_gathered_without_bound(path):
    container = Mcap(path)

    batches = list(container.batches([1]))

    container.close()
    assert sum(map(len, batches)) == CHUNKS
    assert {one.payload(len(one) - 1) for one in batches} == {IMAGE}
    assert max(len(one.buffer) for one in batches) <= (4 << 20) + len(IMAGE) + 100
