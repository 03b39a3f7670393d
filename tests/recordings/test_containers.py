"""Tests that the same content in every container gives the same columns."""

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import CONTAINERS, content, write_mcap, write_rosbag1, write_rosbag2
from tftool.recordings.recording import open_recording

SENT = content()


def rows(sent):
    """Return all sent transforms: (parent, child, static) to (stamp, seven numbers, log time)."""
    found = {}
    for one in sent:
        for stamp, parent, child, seven in one.transforms:
            key = parent, child, "static" in one.topic
            found.setdefault(key, []).append((stamp, *seven, one.log_time))
    return found


@pytest.mark.parametrize("name", CONTAINERS)
def test_every_container_gives_what_was_sent(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)

    with open_recording(path) as recording:
        transforms = recording.transforms
        found = {
            (edge.parent, edge.child, edge.static): [
                (stamp, *place, *turn, log_time)
                for stamp, place, turn, log_time in zip(
                    edge.stamps.tolist(),
                    edge.translations.tolist(),
                    edge.rotations.tolist(),
                    transforms.log_times_of(edge).tolist(),
                    strict=True,
                )
            ]
            for edge in recording.edges
        }

    assert found == rows(SENT)
    assert recording.damage == ()


@pytest.mark.parametrize("name", CONTAINERS)
def test_every_container_tells_its_topics_headers_and_clock(tmp_path, name):
    path = CONTAINERS[name](tmp_path, SENT)

    with open_recording(path) as recording:
        topics = {topic.name: topic for topic in recording.topics}
        headers = recording.headers("/scan")
        read, received = recording.source.clock()
        raw = list(recording.raw_messages("/scan"))

    counts = {name: sum(one.topic == name for one in SENT) for name in topics}
    assert {name: topic.count for name, topic in topics.items()} == counts
    assert set(topics) == {one.topic for one in SENT}
    assert topics["/tf_static"].static
    assert not topics["/tf"].static
    assert topics["/scan"].type == "sensor_msgs/LaserScan"
    assert "float32 angle_min" in topics["/scan"].definition
    scans = [one for one in SENT if one.scan]
    assert headers.stamps.tolist() == [one.scan[0] for one in scans]
    assert headers.log_times.tolist() == [one.log_time for one in scans]
    assert headers.frame_ids.tolist() == [one.scan[1] for one in scans]
    assert [one.log_time for one in raw] == [one.log_time for one in scans]
    assert {len(one.payload) for one in raw} <= {len(raw[0].payload)}
    clocks = [one for one in SENT if one.clock is not None]
    assert read.tolist() == [one.clock for one in clocks]
    assert received.tolist() == [one.log_time for one in clocks]
    assert (recording.source.start, recording.source.end) == (
        min(one.log_time for one in SENT),
        max(one.log_time for one in SENT),
    )


def test_nodes_stand_in_ros_1_bags_and_offers_in_all(tmp_path):
    bag = write_rosbag1(tmp_path / "a.bag", SENT)
    base = write_rosbag2(tmp_path / "b", SENT)
    mcap = write_mcap(tmp_path / "c.mcap", SENT)

    with open_recording(bag) as recording:
        assert {(one.topic, one.node, one.durability) for one in recording.publishers} == {
            ("/tf_static", "/state_publisher", "transient_local"),
            ("/tf", "/robot", ""),
            ("/scan", "/lidar", ""),
            ("/clock", "/robot", ""),
        }
        assert set(recording.samples("laser").authorities) == {"/state_publisher"}
    for path in (base, mcap):
        with open_recording(path) as recording:
            offered = {one.topic: (one.durability, one.offers) for one in recording.publishers}
            assert offered["/tf_static"] == ("transient_local", 1)
            assert offered["/tf"] == ("volatile", 1)
            assert set(recording.samples("laser").authorities) == {"/tf_static"}


def test_messages_of_one_edge_are_told_apart(tmp_path):
    with open_recording(write_mcap(tmp_path / "a.mcap", SENT)) as recording:
        transforms = recording.transforms
        messages = [one for one in SENT if one.transforms]

    edges = {edge.child: edge for edge in transforms.edges}
    for edge in edges.values():
        told = [any(t[2] == edge.child for t in one.transforms) for one in messages]
        assert edge.messages.tolist() == np.flatnonzero(told).tolist()
    assert transforms.log_times.tolist() == [one.log_time for one in messages]
    senders = [transforms.publishers[number].topic for number in transforms.senders.tolist()]
    assert senders == [one.topic for one in messages]
