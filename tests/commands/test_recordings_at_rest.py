"""Tests of views of a recording: the recording does not play, and the timeline shows all of it."""

import json
import re
import shutil

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import SECOND, content, write_mcap, write_rosbag1
from tests.terminals import Terminal
from tests.world.link.processes import Process
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.on_screen import at_rest
from tftool.opener import open_frames
from tftool.screens.still_frames import first_look
from tftool.world.clock import pace_of, run


@pytest.fixture
def file(tmp_path):
    return write_mcap(tmp_path / "run.mcap", content(500))


def test_the_clock_of_a_recording_stands_still_at_its_end(file):
    with open_frames(file) as frames:
        clock = at_rest(Connection(), frames).clock
        start, end = frames.start, frames.end

    async def work():
        before = clock.now()
        await pace_of(clock).sleep(SECOND // 100)
        return clock.now() - before

    assert run(clock, work()) == 0
    assert end - start == pytest.approx(499 * SECOND / 50, abs=1000)
    assert (clock.epoch, clock.now()) == (start, end)


def test_the_first_look_is_at_a_moment_when_all_frames_are_there(file):
    with open_frames(file) as frames:
        first = first_look(frames)

    assert 0 < first - frames.start < SECOND
    assert frames.buffer.can_transform("map", "arm", first)


def test_the_page_begins_there(file):
    with Process("view", file, "--port", "0", "--host") as view:
        view.says("The frames of recording")
        (line,) = [line for line in view.lines if "The frames of" in line]
        # The page itself opens at the beginning, because its address contains no moment.
        assert re.search(r"http://127\.0\.0\.1:\d+/\?token=[\w-]+$", line)
        assert view.interrupt() == 130


@pytest.mark.skipif(shutil.which("tmux") is None, reason="tmux is not installed")
def test_the_demo_shows_a_recording_at_rest_and_goes_through_it(tmp_path, file):
    terminal = Terminal(tmp_path, 100, 24, ("-m", "tftool", "demo", str(file)), {})
    try:
        screen = terminal.shows("◀◀ ")
        assert "0.0 s" in screen
        assert "base_link" in screen
        terminal.press("}", "}", "}")
        terminal.shows(" 3.0 s ")
        terminal.press("q")
        terminal.ended(0)
    finally:
        terminal.tmux("kill-server")


def test_without_a_terminal_the_demo_names_what_shows_it(tftool, file):
    result = tftool("demo", file)

    assert result.status == 2
    assert "'tftool view " in result.err


@pytest.mark.parametrize("word", ["--json", "--rate=2", "--for=3", "--source-frame=a"])
def test_the_demo_of_a_recording_refuses_options_that_run_a_scenario(tftool, file, word):
    result = tftool("demo", file, word)

    assert result.status == 2
    assert "The demo only displays a recording" in result.err


def test_monitor_reports_a_whole_recording_at_once(tftool, file):
    result = tftool("monitor", file, "--tf2")

    assert result.status == 0
    # tf2 counts the messages of a sender: odom is in 9 of 10 messages at 50 Hz.
    assert result.out.count("RESULTS: for all Frames") == 1
    assert re.search(r"Frame: odom, published by /tf, Average Delay: 0\.002", result.out)


def test_monitor_names_who_sent_a_recordings_transforms_as_info_does(tftool, file, tmp_path):
    bag = write_rosbag1(tmp_path / "run.bag", content(50))

    for recording in (file, bag):
        report = json.loads(tftool("monitor", recording, "--json").out)
        told = {one["frame"]: one["broadcaster"] for one in report["frames"]}
        edges = json.loads(tftool("info", recording, "--json").out)["edges"]
        assert told == {one["child"]: one["publishers"][0] for one in edges}


def test_monitor_follows_a_chain_of_a_recording(tftool, file):
    result = tftool("monitor", "odom", "base_link", file, "--tf2")

    assert result.status == 0
    assert "RESULTS: for base_link in odom" in result.out


def test_monitor_waits_in_silence_for_a_link_that_is_recorded_later(tftool, tmp_path):
    """Check that `monitor` prints no remedy for an edge that is recorded later.

    A recording has all of its data at once, so the remedy would be wrong.
    """
    sent = content(500)
    late = [one for one in sent if one.log_time > sent[0].log_time + 3 * SECOND]
    early = [one for one in sent if one not in late and one.topic == "/tf_static"]
    assert early
    assert late

    result = tftool(
        "monitor", "odom", "base_link", write_mcap(tmp_path / "late.mcap", early + late)
    )

    assert result.status == 0
    assert re.fullmatch(r"Gathering data on base_link in odom for [\d.]+ s \.\.\.\n", result.err)
