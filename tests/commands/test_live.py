"""Tests of the tutorial's files in separate processes, on real time, in one session."""

import re
import shutil
import tempfile
import urllib.request
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tests.terminals import Terminal
from tests.world.link.processes import Process, run

LOOKS = 2000
"""Number of answers to read before a test stops waiting and fails."""

TUTORIAL = Path(__file__).parent.parent / "tutorial"


@pytest.fixture(scope="module")
def launched():
    """Start `tftool launch pkg_tf turtle_following.launch.py`, which hosts the session."""
    # The folder is not pytest's, because the path of a unix socket is limited to about 100 letters.
    with (
        pytest.MonkeyPatch.context() as environment,
        tempfile.TemporaryDirectory(prefix="tf") as folder,
    ):
        environment.setenv("TFTOOL_SESSION_DIR", folder)
        environment.delenv("ROS_DISTRO", raising=False)
        environment.delenv("AMENT_PREFIX_PATH", raising=False)
        words = ["launch", "pkg_tf", "turtle_following.launch.py"]
        with Process(*words, cwd=TUTORIAL) as process:
            process.says("[listener]: Successfully spawned turtle2")
            yield process
            status = process.interrupt()
    assert status == 130
    assert "user interrupted with ctrl-c (SIGINT)" in process.text
    assert "Traceback" not in process.text


def told(process, pattern, condition):
    """Wait until the last match of a pattern in a process's output fulfils a condition."""
    seen = 0
    for _ in range(LOOKS):
        seen = process.says(pattern.partition("(")[0], after=seen)
        found = re.search(pattern, process.lines[seen - 1])
        if found and condition(float(found[1])):
            return
    raise AssertionError(f"it never was; it said:\n{process.text}")


@pytest.mark.skipif(shutil.which("tmux") is None, reason="needs tmux, a terminal to press keys in")
def test_turtle2_follows_where_the_keys_drive_turtle1(launched, tmp_path):
    # The distance is measured from the world, where a driven turtle stays. On a busy machine,
    # turtle2 may catch up between two looks.
    far = ["echo", "world", "turtle2", "--distance", "--rate", "5"]
    with (
        Process("echo", "turtle2", "turtle1", "--distance", "--rate", "5") as echo,
        Process(*far) as place,
    ):
        echo.says("Joined the session of 'tftool launch")
        told(echo, r"Distance: ([\d.]+)", lambda distance: distance < 0.5)
        teleop = Terminal(tmp_path, 80, 24, ["-m", "tftool", "teleop"], {})
        try:
            teleop.shows("q quit")
            teleop.press("Up")
            # The learner's own listener follows turtle1 there.
            told(place, r"Distance: ([\d.]+)", lambda distance: distance > 8.5)
            teleop.press("q")
            teleop.shows("ended with 0")
        finally:
            teleop.tmux("kill-server")
        assert echo.interrupt() == 130
        assert place.interrupt() == 130


def test_a_static_frame_from_the_command_line_is_there_for_all(launched):
    words = ["run", "pkg_tf", "static_turtle", "mystaticturtle", "0", "0", "1", "0", "0", "0"]
    with Process(*words, cwd=TUTORIAL) as static:
        static.says("Joined the session of 'tftool launch")
        found = run("echo", "world", "mystaticturtle", "--once")

        assert found.returncode == 0
        assert "- Translation: [0.000, 0.000, 1.000]" in found.stdout
        assert static.interrupt() == 130


@pytest.mark.parametrize("words", [["echo", "turtle2", "turtle1"], ["tree"]])
def test_a_session_has_no_past_to_ask_about(launched, words):
    asked = run(*words, "--at", "5")

    assert asked.returncode == 2
    assert "A session is running, the session of 'tftool launch" in asked.stderr
    assert "scenario ('turtles --at 5') or a recording ('tftool record" in asked.stderr
    assert run(*words, "--at", "5", "--host").returncode == 0


def test_a_launch_file_that_cannot_be_read_leaves_the_session_at_once(launched, tmp_path):
    file = tmp_path / "bad.launch.py"
    file.write_text("from launch import Nope\n")
    done = run("launch", file)

    assert done.returncode == 3
    assert "'Nope' of launch is not supported" in done.stderr


def test_an_action_client_of_another_process_turns_the_turtle(launched):
    done = run("run", "pkg_tf", "rotate", "0.7854", cwd=TUTORIAL)

    assert done.returncode == 0
    assert "[rotate]: Goal accepted" in done.stderr
    assert re.search(r"\[rotate\]: Result: -0\.7\d\d\d after \d+ feedbacks", done.stderr)


def test_the_page_shows_the_learners_frames(launched):
    with Process("view") as view:
        line = view.says(" are at http://127.0.0.1:")
        address = re.search(r"http://\S+", view.lines[line - 1])[0]
        with urllib.request.urlopen(address, timeout=PATIENCE) as page:
            text = page.read().decode()

        assert view.interrupt() == 130
    assert "<title>" in text
