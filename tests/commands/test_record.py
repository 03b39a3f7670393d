"""Tests of `tftool record`, `demo --record` and `check --record` as a user types them."""

import json
import os

import pytest

from tftool.recordings.recording import open_recording


@pytest.fixture
def here(tmp_path, monkeypatch, simulated):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_scenario_is_recorded_with_who_sends_what(here, tftool):
    done = tftool("record", "-o", "run.mcap", "--in", "robot", "--for", "5")

    assert done.status == 0
    assert done.out.startswith("run.mcap: ")
    assert os.listdir() == ["run.mcap"]
    with open_recording("run.mcap") as recording:
        edges = {edge.child: edge for edge in recording.edges}
        nodes = {(one.topic, one.node) for one in recording.publishers}
        assert recording.damage == ()
        assert len(edges["base_link"]) == pytest.approx(250, abs=2)
        assert edges["laser_link"].static
        assert recording.buffer.can_transform("map", "laser_link", recording.end)
    assert {("/tf", "/odometry"), ("/tf", "/localization"), ("/tf_static", "/static")} <= nodes


def test_other_topics_are_recorded_by_name_or_all(here, tftool):
    named = tftool("record", "-o", "a.mcap", "--in", "turtles", "--for", "3", "turtle1/pose", "odd")
    everything = tftool(
        "record", "-o", "b.mcap", "--in", "turtles", "--for", "3", "--all", "--json"
    )

    with open_recording("a.mcap") as recording:
        assert {topic.name for topic in recording.topics} == {"/tf", "/turtle1/pose"}
        poses = [message for _, message in recording.messages("/turtle1/pose")]
    assert len(poses) > 100
    assert "'odd' was never published" in named.err
    told = json.loads(everything.out)
    assert {"tf", "tf_static", "turtle1/pose", "turtle2/pose", "turtle2/cmd_vel"} <= set(
        told["topics"]
    )
    with open_recording("b.mcap") as recording:
        assert sum(topic.count for topic in recording.topics) == told["messages"]


def test_a_long_recording_is_split_into_a_folder(here, tftool):
    done = tftool(
        "record", "-o", "run", "--in", "robot", "--for", "5", "--max-duration", "2", "--json"
    )

    assert done.status == 0
    assert json.loads(done.out)["files"] == ["run_0.mcap", "run_1.mcap", "run_2.mcap"]
    for name in ("run_0.mcap", "run_1.mcap", "run_2.mcap"):
        with open_recording(f"run/{name}") as recording:
            assert [edge.child for edge in recording.edges if edge.static] == ["laser_link"]


def test_the_last_of_it_is_kept_in_a_ring(here, tftool):
    tftool("record", "-o", "run.mcap", "--in", "robot", "--for", "8", "--ring", "2")

    with open_recording("run.mcap") as recording:
        assert recording.source.end - recording.source.start <= 2.1e9
        assert [edge.child for edge in recording.edges if edge.static] == ["laser_link"]
        assert len(next(edge for edge in recording.edges if edge.child == "base_link")) > 90


def test_a_finding_of_the_doctors_ends_it_and_is_said(here, tftool):
    scenario = here / "both.yaml"
    scenario.write_text(
        "about: A frame that is static and moves.\nduration: 30 s\nnodes:\n"
        "  - turtlesim: {}\n"
        "  - broadcaster: {name: one, turtle: turtle1}\n"
        "  - static: {name: two, parent: world, child: turtle1}\n"
    )

    done = tftool(
        "record", "-o", "run.mcap", "--in", scenario, "--for", "25", "--on", "static-and-dynamic"
    )

    assert (done.status, os.path.exists("run.mcap")) == (1, True), done
    with open_recording("run.mcap") as recording:
        assert recording.source.end - recording.source.start < 10e9


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["-o", "run.bag"], "use '.mcap'"),
        (
            ["-o", "run.mcap", "--max-duration", "2"],
            "into a folder: name a folder, without '.mcap' (-o run)",
        ),
        (["-o", "run", "--max-size", "lots"], "--max-size must be a number"),
        (["-o", "run", "--max-size", "5k"], "is too small"),
        (["-o", "run", "--ring", "5", "--max-size", "5M"], "--ring writes one file"),
        (["-o", "run.mcap", "--on", "split-tre"], "did you mean split-tree"),
        (["-o", "there.mcap"], "exists: add --force"),
        (
            ["-o", "run.mcap", "orbit"],
            "write --in orbit to record a scenario, or /orbit for a topic",
        ),
        (
            ["-o", "run.mcap", "there.mcap"],
            "'there.mcap' is a scenario or a file, but only topics are expected here",
        ),
    ],
)
def test_record_refuses_invalid_arguments_and_keeps_existing_files(here, tftool, words, told):
    (here / "there.mcap").write_bytes(b"precious")

    done = tftool("record", "--in", "robot", "--for", "1", *words)

    assert done.status == 2
    assert told in done.err
    assert os.listdir() == ["there.mcap"]
    assert (here / "there.mcap").read_bytes() == b"precious"


def test_a_scenario_that_is_not_there_leaves_no_file(here, tftool):
    assert tftool("record", "-o", "run.mcap", "--in", "nowhere").status != 0

    assert os.listdir() == []


def test_the_demo_is_recorded_as_it_is_played(here, tftool):
    assert tftool("demo", "--for", "5", "--record", "run.mcap").status == 0

    with open_recording("run.mcap") as recording:
        assert {edge.child for edge in recording.edges} == {"turtle1", "turtle2"}
        assert recording.end - recording.start == pytest.approx(5e9, abs=0.1e9)
    assert tftool("demo", "--for", "5", "--record", "run.mcap").status == 2


def test_check_keeps_recordings_of_scenarios_of_one_name_apart(here, tftool):
    for folder, turtle in (("left", "turtle1"), ("right", "turtle9")):
        (here / folder).mkdir()
        (here / folder / "fails.yaml").write_text(
            "duration: 2 s\nnodes:\n  - turtlesim: {}\n"
            "  - broadcaster: {turtle: turtle1}\n"
            f"  - static: {{parent: map, child: {turtle}_sees}}\n"
            "expect:\n  - {at: 1 s, trees: 9}\n"
        )

    done = tftool("check", "left/fails.yaml", "right", "--record", "kept")

    assert done.status == 1
    assert sorted(os.listdir("kept")) == ["fails.mcap", "fails_2.mcap"]
    for name, child in (("fails", "turtle1_sees"), ("fails_2", "turtle9_sees")):
        with open_recording(f"kept/{name}.mcap") as recording:
            assert child in {edge.child for edge in recording.edges}


def test_check_keeps_the_recording_of_a_scenario_that_fails_and_no_other(here, tftool):
    (here / "fails.yaml").write_text(
        "about: It fails.\nduration: 2 s\nnodes:\n  - turtlesim: {}\n"
        "  - broadcaster: {turtle: turtle1}\n"
        "expect:\n"
        "  - {at: 1 s, lookup: {target: world, source: turtle1}, raises: LookupException}\n"
    )

    done = tftool("check", "fails.yaml", "square", "--record", "kept")

    assert done.status == 1
    assert os.listdir("kept") == ["fails.mcap"]
    assert "Recorded: kept/fails.mcap" in done.err
    with open_recording("kept/fails.mcap") as recording:
        assert [edge.child for edge in recording.edges] == ["turtle1"]
