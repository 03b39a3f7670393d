"""Tests of commands that read a robot by its address, and of commands that refuse to."""

import json
import re
import time

import pytest

import tftool as api
from tests.world.link.foxglove.conftest import foxglove
from tftool.messages.classes import INTERFACES, build
from tftool.messages.codec import codec


def test_tree_and_echo_of_a_running_server(moving, tftool):
    tree = tftool("tree", moving.address)
    assert tree.status == 0
    assert re.search(r"odom\n└── base +dynamic +bridge +\d", tree.out)
    assert re.search(r"└── laser +static +bridge ", tree.out)
    assert f"Joined {moving.address}." in tree.err

    echo = tftool("echo", "base", "laser", moving.address, "--once")
    assert echo.status == 0
    assert "Translation: [0.500, 2.000, 3.000]" in echo.out


def test_a_session_lists_topics_with_rates_and_types(moving, tftool):
    found = json.loads(tftool("session", moving.address, "--json", "--for", "0.5").out)
    assert found["topics"]["tf"]["type"] == "tf2_msgs/msg/TFMessage"
    assert found["topics"]["tf"]["publishers"] == ["bridge"]
    assert found["topics"]["tf"]["rate"] > 0


def test_doctor_explain_and_monitor_judge_what_arrives(moving, tftool):
    judged = json.loads(tftool("doctor", moving.address, "--for", "1", "--json").out)
    assert judged["findings"] == []
    explained = tftool("explain", "odom", "laser", moving.address, "--for", "0.5")
    assert explained.status == 0
    assert "laser in base  static" in explained.out
    watched = tftool("monitor", "odom", "laser", moving.address, "--for", "0.5")
    assert "Chain is: laser -> base -> odom" in watched.out


def test_doctor_and_explain_read_headers_of_other_topics(moving, tftool):
    kind = INTERFACES.message("sensor_msgs/LaserScan")
    scans = moving.topic("/scan", "sensor_msgs/msg/LaserScan")
    for frame in ("laser", "lidar"):
        scan = build(kind)
        scan.header.frame_id = frame
        scan.header.stamp.sec = int(time.time())  # noqa: TID251
        moving.keep(scans, codec(kind).encode(scan))

    judged = json.loads(tftool("doctor", moving.address, "--for", "1", "--json").out)
    (found,) = (one for one in judged["findings"] if one["id"] == "unknown-frame")
    assert "lidar" in json.dumps(found)
    words = ("odom", "laser", moving.address, "--message", "/scan", "--for", "1", "--json")
    asked = int(json.loads(tftool("explain", *words).out)["stamp"])
    assert asked == scan.header.stamp.sec * 10**9


def test_a_recording_of_a_robot_holds_its_topics_and_types(moving, tftool, tmp_path):
    moving.topic("/cell", "cell_pkg/msg/Cell", definition="float32 volts\n")
    output = tmp_path / "run.mcap"
    done = tftool("record", "-o", output, "--all", moving.address, "--for", "0.5")
    assert done.status == 0, done.err
    with api.open_recording(output) as recording:
        assert set(recording.buffer.frames()) == {"odom", "base", "laser"}
        assert {one.name for one in recording.topics} >= {"/tf", "/tf_static"}
    exported = tftool(
        "export", "odom", "base", moving.address, "--for", "0.5", "-o", tmp_path / "p.csv"
    )
    assert exported.status == 0, exported.err


def test_python_opens_an_address(moving):
    with api.open(moving.address, listen_for=0.3) as frames:
        found = frames.buffer.lookup_transform("base", "laser")
    assert found.transform.translation == (0.5, 2.0, 3.0)
    with pytest.raises(api.UsageError, match="already names the robot"):
        api.open(moving.address, domain=3)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["tree", "ws://r:1", "--dds"], "already names the robot: leave out --domain"),
        (["tree", "ws://r:1", "--connect", "tcp/r:1"], "already names the robot"),
        (["tree", "ws://r:1", "--domain", "0"], "already names the robot"),
        (["tree", "ws://r:1", "--host"], "already names the robot"),
        (["play", "ws://r:1"], "'tftool play' cannot use it"),
        (["static", "0", "0", "0", "0", "0", "0", "a", "b", "ws://r:1"], "is read-only"),
        (["demo", "ws://r:1"], "is read-only"),
        (["robot", "wss://r:1"], "is read-only"),
        (["echo", "map", "ws://r:1"], "is the address of a session"),
        (["echo", "a", "b", "ws://r:1", "--at", "3"], "which does not store the past"),
        (["doctor", "scenarios/turtles.yaml", "ws://r:1"], "two sources: leave one out"),
        (["record", "-o", "x.mcap", "--in", "turtles", "ws://r:1"], "two sources"),
        (["tree", "ws://:1"], "is not a server address: write ws://HOST:8765"),
        (["tree", "ws://robot:0"], "is not a server address"),
        (["tree", "ws://ro bot"], "is not a server address"),
        (["session", "run.mcap"], "'run.mcap' is not the address of a session"),
    ],
)
def test_contradictions_and_publishing_are_refused(tftool, words, sentence):
    refused = tftool(*words)
    assert refused.status == 2
    assert sentence in " ".join(refused.err.split())
    assert not refused.out


def test_a_file_is_not_an_address(tftool):
    refused = tftool("edit", "ws://robot:8765", "-o", "x.mcap")
    assert refused.status == 3
    assert "'tftool record -o run.mcap ws://robot:8765' records a file" in refused.err


def test_passwords_and_tokens_of_an_address_are_not_shown(tftool):
    refused = tftool("tree", "ws://me:secret@127.0.0.1:1/robot?token=hidden")
    assert refused.status == 3
    assert "at ws://127.0.0.1:1/robot: Connection refused." in refused.err
    assert "secret" not in refused.err
    assert "hidden" not in refused.err


def test_names_of_a_robot_cannot_steer_the_terminal(robots, tftool):
    graph = foxglove.websocket.ConnectionGraph()
    graph.set_published_topic("/tf", ["/\x1b[31mred"])
    robot = robots(capabilities=[foxglove.websocket.Capability.ConnectionGraph])
    robot.topic("/tf")
    robot.topic("/\x1b]0;title\x07", "a/b/\x1b[2J")
    robot.server.publish_connection_graph(graph)
    robot.server.publish_status("\x1b[5mblink", foxglove.websocket.StatusLevel.Warning)
    for words in (
        ["session", "--for", "0.3"],
        ["doctor", "--for", "0.3"],
        ["monitor", "--for", "0.3"],
    ):
        found = tftool(words[0], robot.address, *words[1:])
        assert "\x1b" not in found.out + found.err
        assert "\x07" not in found.out + found.err
