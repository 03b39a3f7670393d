"""Tests of the progress display while a recording is read, and of its end."""

import io
import re
import shutil
import subprocess
import sys

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.patience import PATIENCE
from tests.recordings.writers import content, write_mcap
from tests.terminals import ROOT, Terminal
from tftool.opener import open_frames, scenario_named
from tftool.scenario.play import build
from tftool.world.clock import WallClock
from tftool.world.link.session_world import Session

CONTROLS = re.compile(r"\x1b\[[\d;?]*[A-Za-z]")

SLOW = """
import sys
from tftool.app import main as app
from tftool.recordings.mcap.read import Mcap

FILE, TIMES = sys.argv[1:]


def batches(self, wanted, progress=None, head=None):
    times = iter(int, 1) if TIMES == "for_ever" else range(int(TIMES))
    for _ in times:
        if progress is not None:
            progress(25_000_000, 100_000_000)
    return iter(())

Mcap.batches = batches
sys.argv = ["tftool", "tree", FILE]
sys.exit(app.main())
"""


@pytest.fixture
def file(tmp_path):
    return write_mcap(tmp_path / "run.mcap", content(20))


@pytest.mark.skipif(shutil.which("tmux") is None, reason="tmux is not installed")
def test_reading_that_takes_long_shows_a_bar_and_ends_at_ctrl_c(tmp_path, file):
    words = ("-c", SLOW, str(file), "for_ever")
    terminal = Terminal(tmp_path, 120, 10, words, {"TERM": "xterm-256color"})
    try:
        shown = terminal.until(lambda screen: "Reading" in screen and "MB" in screen, "a bar")
        assert "25.0/100.0 MB" in shown
        terminal.press("C-c")
        screen = terminal.ended(130)
        assert "Reading" not in screen
        assert "Traceback" not in screen
    finally:
        terminal.tmux("kill-server")


def test_the_bar_begins_with_how_far_reading_is(monkeypatch):
    from tftool.commands.shared.progress_bars import Bar

    class Screen(io.StringIO):
        def isatty(self):
            return True

    screen = Screen()
    monkeypatch.setattr("sys.stderr", screen)
    monkeypatch.setattr("tftool.commands.shared.progress_bars.PATIENCE", 0)
    bar = Bar("Reading run.mcap")
    while not screen.getvalue():
        bar(25_000_000, 100_000_000)
    bar.stop()

    shown = re.findall(r"[\d.]+/[\d.]+ MB", screen.getvalue())
    assert set(shown) == {"25.0/100.0 MB"}


def test_a_session_is_listened_to_with_a_bar_above_what_shows_so_far(monkeypatch):
    from rich.text import Text

    from tftool.commands.shared.progress_bars import ListeningBar

    class Screen(io.StringIO):
        def isatty(self):
            return True

    screen = Screen()
    monkeypatch.setattr("sys.stderr", screen)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("LINES", "6")
    play = build(scenario_named("two_trees"), WallClock())
    session = Session(play.world, True, "test", play.live)
    seen = []

    def look(frames):
        seen.append([(edge.parent, edge.child) for edge in frames.log.transforms().edges])
        return [Text(f"warning  number {number}: " + "long " * 30) for number in range(9)]

    with ListeningBar(0.6, look) as bar:
        frames = open_frames(session=session, listen_for=0.6, glance=bar)

    shown = CONTROLS.sub("", screen.getvalue())
    assert "of 0.6 s" in shown
    assert ("world", "turtle1") in seen[-1]
    assert len(frames.log) >= len(seen[-1])
    # A line that is too long is cut, and lines that would scroll are counted.
    assert "number 1: long" in shown
    assert "number 2" not in shown
    assert "… and 7 more" in shown
    # At the end, nothing of the display remains.
    assert screen.getvalue().endswith("\x1b[1A\x1b[2K")


def test_without_a_terminal_there_is_no_bar(file):
    words = [sys.executable, "-c", SLOW, str(file), "5"]
    done = subprocess.run(
        words, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE, check=False
    )

    assert done.returncode == 0
    assert "Reading" not in done.stderr


def test_a_file_that_is_gone_while_it_is_read_is_a_sentence(tftool, file, monkeypatch):
    from tftool.recordings.mcap.read import Mcap

    def shortened(self, wanted, progress=None, head=None):
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(Mcap, "batches", shortened)
    result = tftool("tree", file)

    assert result.status == 3
    assert "Input/output error" in result.err


@pytest.mark.parametrize(
    "words",
    [
        ["tree"],
        ["echo", "map", "laser"],
        ["explain", "map", "laser"],
        ["info"],
        ["info", "-o", "rows.jsonl"],
        ["doctor"],
        ["doctor", "run.mcap"],
        ["doctor", "--steps"],
        ["doctor", "-o", "rows.jsonl"],
        ["diff", "run.mcap"],
        ["calibrate"],
        ["export", "-o", "out.mcap"],
        ["edit", "-o", "out.mcap"],
        ["edit", "run.mcap", "-o", "out.mcap", "--statics-from"],
    ],
)
def test_an_empty_name_is_neither_the_session_nor_the_current_folder(
    tftool, simulated, file, monkeypatch, words
):
    monkeypatch.chdir(file.parent)

    result = tftool(*words, "")

    assert result.status == 3, (result.out, result.err)
    assert not (file.parent / "out.mcap").exists()


@pytest.mark.parametrize(
    "words",
    [
        ["tree"],
        ["explain", "world", "body"],
        ["edit", "-o", "out.mcap"],
        ["calibrate", "other.tum"],
        ["calibrate", "--time-only", "other.tum"],
    ],
)
def test_rows_of_a_pose_file_that_are_not_used_as_they_are_are_told(
    tftool, tmp_path, monkeypatch, words
):
    monkeypatch.chdir(tmp_path)
    good = "".join(f"{second} {second} 0 0 0 0 0 1\n" for second in range(1, 9))
    (tmp_path / "other.tum").write_text(good)
    odd = "9 nan 0 0 0 0 0 1\n9 0 0 0 0 0 0 0\n8 8 0 0 0 0 0 1\n"
    (tmp_path / "poses.tum").write_text(good + "7 7 0 0 0 0 0 1\n" + odd)

    told = tftool(*words, "poses.tum").err

    assert "Reading 'poses.tum' as tum" in told
    for sentence in (
        "poses.tum: 1 row with NaN left out.",
        "poses.tum: 1 row with a zero quaternion left out.",
        "poses.tum: 1 row out of order, sorted.",
        "poses.tum: 2 rows with the stamp of another row.",
    ):
        assert told.count(sentence) == 1


@pytest.mark.parametrize("words", [["tree"], ["explain", "odom", "laser"], ["calibrate"]])
def test_damage_of_a_recording_is_told(tftool, file, words):
    file.write_bytes(file.read_bytes()[:-100])

    assert "The recording was not closed." in tftool(*words, file).err
