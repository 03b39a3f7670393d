import json
import os
from pathlib import Path

import pytest

from tests.command_line import Simulated
from tftool.base.errors import InputError, NodeFailed, UsageError
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import HEAD_START, open_empty_session, open_session
from tftool.frames.export.export import export
from tftool.frames.source_options import At
from tftool.geometry.rigid import Transform
from tftool.opener import named, open_frames, scenario_named
from tftool.recordings.find import Kind
from tftool.recordings.recording_writer import write_recording
from tftool.scenario import builtin
from tftool.world.clock import run
from tftool.world.node import Node


class Failing(Node):
    async def run(self):
        await self.clock.sleep(seconds(2))
        raise ValueError("out of order")


class Brief(Node):
    async def run(self):
        await self.clock.sleep(seconds(1))


def test_a_node_that_fails_ends_the_work_with_its_name():
    session = open_empty_session(Connection(), simulated=True)
    Failing(session.world, "failing")

    with pytest.raises(NodeFailed, match="node 'failing' failed: ValueError: out of order"):
        session.run(session.lasting(None))
    assert session.world.clock.elapsed() == seconds(2)


def test_static_follows_the_clock_that_a_playback_publishes(tftool, outside):
    class Playing(Simulated):
        def joined_clock(self):
            raise InputError("the clock of the session is used")

    outside["providers"] = Playing()

    words = ["--frame-id", "a", "--child-frame-id", "b"]
    assert "the clock of the session is used" in tftool("static", *words).err


def test_a_world_whose_nodes_are_done_does_not_end_the_work():
    session = open_empty_session(Connection(), simulated=True)
    Brief(session.world, "brief")

    session.run(session.lasting(seconds(5)))

    assert session.world.clock.elapsed() == seconds(5)


def test_the_world_ends_with_the_work_which_hands_back_its_result():
    session = open_session(Connection(), "turtles", simulated=True)

    async def work():
        await session.world.clock.sleep(seconds(2.5))
        return session.world.buffer.frames()

    assert session.run(work()) == ["turtle1", "world", "turtle2"]
    assert session.world.clock.elapsed() == seconds(2.5)


def test_a_hosted_world_outlives_its_scenario_for_whoever_looks():
    session = open_session(Connection(), "static", simulated=True)

    session.run(session.lasting(session.duration + seconds(100)))

    assert session.world.clock.elapsed() > session.duration


def test_work_begins_after_the_head_start(simulated, capsys):
    session = open_session(simulated)
    began = []

    async def work():
        began.append(session.world.clock.elapsed())

    session.run(work())

    assert began == [HEAD_START]
    assert capsys.readouterr().err == "No session is running here: hosting scenario 'turtles'.\n"


def test_a_source_that_was_named_is_hosted_without_a_word(simulated, capsys):
    assert open_session(simulated, "robot").is_hosted
    assert capsys.readouterr().err == ""


def lived_until(session, lasting):
    async def lived():
        await session.live(session.world.clock.epoch + lasting)

    run(session.world.clock, lived())


def test_a_world_can_be_lived_through_to_a_moment():
    session = open_session(Connection(), "turtles", simulated=True)

    lived_until(session, seconds(1))

    assert session.world.clock.elapsed() == seconds(1)


def test_a_moment_after_the_end_is_refused():
    with pytest.raises(
        UsageError, match="scenario 'turtles' lasts 60 s: the time 61 s is after its end"
    ):
        open_frames("turtles", until=At(seconds(61)))


def test_nodes_can_be_left_out_and_the_memory_set():
    session = open_session(
        Connection(),
        "turtles",
        simulated=True,
        cache_time=seconds(3),
        without=lambda node: node.kind == "follower",
    )

    assert session.world.buffer.cache_time == seconds(3)
    assert "follower" not in {node.name for node in session.world.nodes}


@pytest.mark.parametrize(("by_hand", "moved"), [(False, True), (True, False)])
def test_the_script_drives_unless_somebody_else_does(by_hand, moved):
    session = open_session(Connection(), "turtles", simulated=True, by_hand=by_hand)

    lived_until(session, seconds(30))

    found = session.world.buffer.lookup_transform("world", "turtle1")
    assert (found.transform.translation.x != pytest.approx(5.544445)) is moved


def test_an_unknown_source_is_told():
    with pytest.raises(InputError, match="did you mean 'orbit'"):
        open_session(Connection(), "orbti")


# Kinds of FROM


def test_a_built_in_name_wins_and_a_path_is_itself(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("turtles", "own", "a.yaml"):
        (tmp_path / name).write_text("duration: 1 s\n")

    assert named("turtles").paths == (builtin.path_of("turtles"),)
    assert [str(named(word).paths[0]) for word in ("./turtles", "own", "a.yaml")] == [
        "turtles",
        "own",
        "a.yaml",
    ]
    assert {named(word).kind for word in ("turtles", "own")} == {Kind.SCENARIO}


@pytest.mark.parametrize(
    ("word", "told"),
    [
        ("turtels", "no scenario is named 'turtels'; did you mean 'turtles'? The path"),
        ("nothing_like_it", "no scenario is named 'nothing_like_it'; there are calibrate, "),
        (".", "No recording"),
        ("gone.yaml", "There is no file or folder 'gone.yaml'."),
        ("\x1b[31m", "no scenario is named '␛[31m'; there are"),
        ("a\0b", "no scenario is named 'a␀b'; there are"),
        ("x" * 5000, "no scenario is named 'xxx"),
    ],
)
def test_a_word_that_means_nothing_is_told_what_there_is(word, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    with pytest.raises(InputError) as refused:
        named(word)

    assert str(refused.value).startswith(told)
    assert len(str(refused.value)) < 300


# Recordings as FROM


@pytest.fixture
def recording(outside, tmp_path):
    """Write a recording of frame `a` in `world`: 0.1 m per sample at 10 Hz, from 50 s to 60 s."""
    outside["providers"] = Simulated()
    buffer = Buffer(seconds(100))
    for step in range(101):
        pose = Transform((step * 0.1, 0.0, 0.0))
        stamp = seconds(50) + step * seconds(0.1)
        buffer.set_transform(TransformStamped(stamp, "world", "a", pose), "robot")
    fixed = TransformStamped(0, "a", "laser", Transform((0.0, 0.0, 1.0)))
    buffer.set_transform_static(fixed, "description")
    # The content decides the kind of the file, not its suffix.
    export(buffer, path=tmp_path / "run.mcap")
    return str((tmp_path / "run.mcap").rename(tmp_path / "run.yaml"))


@pytest.mark.parametrize(
    ("at", "x"), [("2.5", "2.500"), ("+9.95", "9.950"), ("1970-01-01T00:00:51.25Z", "1.250")]
)
def test_a_moment_of_a_recording_counts_from_its_start_or_is_a_stamp(tftool, recording, at, x):
    result = tftool("echo", "world", "a", recording, "--at", at)

    assert result.status == 0
    assert f"- Translation: [{x}, 0.000, 0.000]\n" in result.out


def test_without_a_moment_a_recording_is_asked_at_its_end_once(tftool, recording):
    result = tftool("echo", "world", "a", recording, "--once")

    assert result.status == 0
    assert result.out.count("At time 60.0\n- Translation: [10.000, 0.000, 0.000]\n") == 1


def test_the_past_of_a_recording_is_told_from_its_end(tftool, recording):
    result = tftool("echo", "world", "a", recording, "--offset", "-4", "--json")

    assert json.loads(result.out)["stamp_ns"] == seconds(56)


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["--at", "11"], 2, "lasts 10 s: the time 11 s is after its end."),
        (["--at", "1970-01-01T00:00:49Z"], 2, "begins at 50: the time 49 is before this start."),
        (["--at", "1e9"], 2, "ends at 60: the time 1000000000 is after this end."),
        (["--join"], 2, "which cannot be joined"),
        (["--read-only"], 2, "which other processes cannot share"),
    ],
)
def test_a_recording_refuses_times_outside_it_and_sharing(tftool, recording, words, status, told):
    result = tftool("echo", "world", "a", recording, *words)

    assert result.status == status
    assert told in result.err


def test_a_frame_that_a_recording_has_not_is_refused_at_once(tftool, recording):
    result = tftool("echo", "world", "b", recording, "--once")

    assert result.status == 4
    assert "Existing frames so far: a, world, laser" in result.err


def test_the_tree_of_a_recording_is_that_of_the_moment(tftool, recording):
    early = json.loads(tftool("tree", recording, "--at", "1", "--format", "json").out)
    late = json.loads(tftool("tree", recording, "--format", "json").out)

    assert early != late
    assert "/tf_static" in str(early)


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="shows no open files")
def test_a_recording_is_closed_after_success_and_after_failure(tftool, recording):
    tftool("tree", recording)
    tftool("echo", "world", "a", recording, "--at", "99")

    opened = [os.path.realpath(entry) for entry in Path("/proc/self/fd").iterdir()]
    assert os.path.realpath(recording) not in opened


def test_the_tree_of_a_recording_has_the_poses_at_the_requested_time(tftool, recording):
    told = json.loads(tftool("tree", recording, "--at", "2", "--json").out)

    (frame,) = [one for one in told["frames"] if one["frame"] == "a"]
    assert told["recorded_at_ns"] == seconds(52)
    assert frame["root_from_frame"]["translation"] == pytest.approx([2.0, 0.0, 0.0])
    assert "laser" in {one["frame"] for one in told["frames"]}


@pytest.mark.parametrize("words", [["follow", "a", "b", "{}"], ["tree", "--watch", "{}"]])
def test_no_messages_arrive_from_a_recording(tftool, recording, words, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")

    result = tftool(*(word.format(recording) for word in words))

    assert result.status == 2
    assert f"which sends no messages: 'tftool tree {recording}' shows its frames." in result.err


def test_no_messages_arrive_from_a_file_of_statics(tftool, tmp_path):
    file = tmp_path / "statics.sh"
    file.write_text("ros2 run tf2_ros static_transform_publisher 0 0 1 0 0 0 base laser\n")

    result = tftool("monitor", file)

    assert result.status == 2
    assert f"which sends no messages: 'tftool tree {file}' shows its frames." in result.err


@pytest.mark.parametrize("command", ["check"])
def test_a_recording_is_no_scenario(tftool, recording, command):
    result = tftool(command, recording)

    assert result.status == 2
    assert result.err == f"tftool: '{recording}' is an MCAP recording: name a scenario instead.\n"


def test_a_scenario_is_played_up_to_the_moment():
    frames = open_frames("turtles", until=At(seconds(4)), margin=0.0)

    assert frames.end == frames.at(4)
    assert frames.buffer.can_transform("turtle2", "turtle1", frames.end)
    assert not frames.buffer.can_transform("turtle2", "turtle1", frames.at(4.1))


def test_a_scenario_is_read_with_its_arguments():
    assert scenario_named("turtles", {"source_frame": "x"}).arguments["source_frame"] == "x"


def test_a_recording_in_which_nothing_was_recorded_has_no_frames(tftool, tmp_path):
    with write_recording(tmp_path / "empty.mcap"):
        pass

    assert "No tf data received" in tftool("tree", tmp_path / "empty.mcap").out
    assert tftool("echo", "a", "b", tmp_path / "empty.mcap").status == 4
