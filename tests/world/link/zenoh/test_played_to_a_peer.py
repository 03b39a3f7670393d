"""Tests of `tftool play` with an independent implementation of ROS 2 over zenoh as listener."""

import socket

import pytest

pytest.importorskip("zenoh_ros2_sdk", reason="zenoh-ros2-sdk, of the extra 'test', is missing")
pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import content, write_mcap
from tests.world.link.processes import Process
from tests.world.link.zenoh.test_foreign_peer import Foreign


def test_a_foreign_ros_2_peer_hears_a_recording(tmp_path):
    sent = content(100)
    run = write_mcap(tmp_path / "run.mcap", sent)
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]

    with Process("play", run, "--loop", "--all", "--listen", f"tcp/127.0.0.1:{port}") as play:
        foreign = Foreign(port, tmp_path, "sdk_listener.py")
        try:

            def has(key, **fields):
                found = foreign.until(lambda: foreign.with_key(key, **fields))
                assert found, f"{key} never came; the player said: {play.text}"
                return found

            statics = {child: seven for _, _, child, seven in sent[0].transforms}
            (laser, *_) = has("topic", topic="tf_static", child="laser")
            assert laser["at"] == list(statics["laser"][:3])
            moved = {
                (child, stamp): list(seven[:3])
                for one in sent[1:]
                for stamp, _, child, seven in one.transforms
            }
            (arm, *_) = has("topic", topic="tf", child="arm")
            assert arm["at"] == moved["arm", arm["stamp"]]
            (told, *_) = has("clock")
            assert sent[0].log_time <= told["clock"] <= sent[-1].log_time
            (scan, *_) = has("scan")
            assert (scan["scan"], scan["count"]) == ("laser", 500)
        finally:
            foreign.close()
        assert play.interrupt() == 130
