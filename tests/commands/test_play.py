"""Tests of `tftool play` as a user types it."""

import re
import shutil

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import content, write_mcap
from tests.terminals import Terminal
from tftool.commands.shared.terminal import keys_in


@pytest.fixture
def run(tmp_path):
    return write_mcap(tmp_path / "run.mcap", content(20))


def test_it_plays_to_the_end_without_a_word(tftool, simulated, run):
    result = tftool("play", run)

    assert (result.status, result.out, result.err) == (0, "", "")


def test_over_and_over_it_tells_of_every_jump_back(tftool, simulated, run):
    # The recording lasts 0.4 s: a backward jump matters only from the third round on.
    result = tftool("play", run, "--loop", "--for", "1", "--rate", "0.1")
    assert (result.status, result.err) == (0, "")

    long = write_mcap(run.with_name("long.mcap"), content(90))
    told = tftool("play", long, "--loop", "--for", "5", "--rate", "1").err.splitlines()
    assert len(told) == 2
    assert all(
        line.endswith("[player]: Detected jump back in time. Clearing tf buffer.") for line in told
    )


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--from", "99"], "outside of the recording, which lasts 0."),
        (["--to", "99"], "The time 99 s is outside of the recording"),
        (["--from", "0.3", "--to", "0.1"], "--from 0.3 s is after --to 0.1 s"),
        (["--rate", "0"], "is not between 0.01 and 100"),
        (["--restamp", "yesterday"], "yesterday"),
        (["--read-only"], "--read-only publishes nothing"),
        (["--join"], "which cannot be joined"),
        (["--from", "soon"], "'soon' is not a time"),
    ],
)
def test_play_refuses_invalid_options_without_a_traceback(tftool, simulated, run, words, sentence):
    result = tftool("play", run, *words)

    assert result.status == 2
    assert sentence in result.err
    assert "Traceback" not in result.err


def test_a_scenario_is_no_recording(tftool, simulated):
    result = tftool("play", "turtles")

    assert result.status == 2
    assert "'turtles' is a scenario: name a recording instead" in result.err


def test_a_recording_without_a_message_is_over_at_once(tftool, simulated, tmp_path):
    assert tftool("play", write_mcap(tmp_path / "empty.mcap", [])).status == 0


def test_where_no_one_can_join_the_other_topics_go_nowhere(tftool, simulated, run):
    result = tftool("play", run, "--all")

    assert result.status == 0
    assert "--all has no effect here" in result.err


@pytest.mark.parametrize(
    ("typed", "keys"),
    [
        (b" ", ["space"]),
        (b"\x1b[C\x1b[C", ["right", "right"]),
        (b"\x1bOA\x1b[B[", ["up", "down", "["]),
        (b"q", ["q"]),
        (b"\x1b[1~0", ["home", "0"]),
        (b"\x1b[17~", []),
        (b"\xc3\xa4\x00\x07", []),
    ],
)
def test_keys_are_known_by_their_bytes(typed, keys):
    assert keys_in(typed) == keys


@pytest.mark.skipif(shutil.which("tmux") is None, reason="tmux is not installed")
def test_on_a_terminal_keys_steer_it(tmp_path):
    file = write_mcap(tmp_path / "long.mcap", content(1000))
    words = ("-m", "tftool", "play", str(file), "--host", "--paused", "--loop")
    terminal = Terminal(tmp_path, 80, 14, words, {})
    try:
        terminal.shows("‖  0.00 / ")
        terminal.press("]", "]", "]")
        terminal.shows("‖  3.00 / ")
        terminal.press("{")
        terminal.shows("‖  0.00 / ")
        terminal.shows("space play")
        terminal.press("Up")
        terminal.shows("×1.1")
        terminal.press("Space")
        terminal.shows("space pause")
        terminal.press("q")
        terminal.ended(0)
    finally:
        terminal.tmux("kill-server")


def test_on_a_terminal_findings_are_marked_and_told(tmp_path, tftool, simulated):
    file = tmp_path / "lost.mcap"
    assert tftool("export", "lost_leader", "-o", file).status == 0
    words = ("-m", "tftool", "play", str(file), "--host", "--paused")
    terminal = Terminal(tmp_path, 100, 20, words, {})
    try:
        terminal.shows("Findings of the doctor")
        terminal.shows("not yet: turtle1 +2")
        terminal.shows("1 note  paused")
        terminal.press("}")
        # Turtle2 publishes 62.5 times per second, also after ten seconds were skipped.
        terminal.until(lambda screen: re.search(r"turtle2 .* 6[23]\.\d Hz", screen), "the rate")
        terminal.press("0", "n")
        terminal.until(lambda screen: "│▸1/" in screen, "the finding")
        terminal.press("q")
        terminal.ended(0)
    finally:
        terminal.tmux("kill-server")


@pytest.mark.skipif(shutil.which("tmux") is None, reason="tmux is not installed")
def test_at_the_end_the_screen_waits_and_r_replays(tmp_path):
    file = write_mcap(tmp_path / "long.mcap", content(90))
    terminal = Terminal(tmp_path, 80, 24, ("-m", "tftool", "play", str(file), "--host"), {})
    try:
        terminal.shows("end: r replays, q quits")
        terminal.shows("/tf")
        terminal.press("r")
        terminal.until(lambda screen: "▶ " in screen and "end" not in screen, "the replay")
        terminal.press("q")
        terminal.ended(0)
    finally:
        terminal.tmux("kill-server")
