import os
import sys

import pytest

from tftool.base.stamps import seconds
from tftool.commands.shared.notices import complain, notice, tell_record, wants_color
from tftool.world.log import LogRecord


def record(level, text="Oh no!"):
    return LogRecord(seconds(1700000000.5) + 7, level, "robot.arm", text)


def test_a_line_is_laid_out_as_ros_2_lays_it_out(capsys):
    tell_record(record("INFO"))
    tell_record(record("FATAL", "two\nlines"), label="arm-3")

    assert capsys.readouterr().err == (
        "[INFO] [1700000000.500000007] [robot.arm]: Oh no!\n"
        "[arm-3] [FATAL] [1700000000.500000007] [robot.arm]: two\nlines\n"
    )


@pytest.mark.parametrize(
    ("level", "shown"),
    [
        ("DEBUG", "\033[32m[DEBUG] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
        ("INFO", "[INFO] [1700000000.500000007] [robot.arm]: ␛[5m\n"),
        ("WARN", "\033[33m[WARN] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
        ("ERROR", "\033[31m[ERROR] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
        ("FATAL", "\033[31m[FATAL] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
    ],
)
def test_levels_have_ros_2s_colors_and_texts_bring_none(capsys, monkeypatch, level, shown):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    tell_record(record(level, "\033[5m"))

    assert capsys.readouterr().err == shown


@pytest.mark.parametrize(
    ("environment", "is_terminal", "wanted"),
    [
        ({}, True, True),
        ({}, False, False),
        ({"NO_COLOR": "1"}, True, False),
        ({"TERM": "dumb"}, True, False),
        ({"RCUTILS_COLORIZED_OUTPUT": "1"}, False, True),
        ({"RCUTILS_COLORIZED_OUTPUT": "0"}, True, False),
    ],
)
def test_colors_are_for_terminals_unless_told_otherwise(environment, is_terminal, wanted):
    assert wants_color(environment, is_terminal=is_terminal) is wanted


def on_terminal(monkeypatch, width, told):
    """Return the lines that a terminal of some width shows for a notice."""
    import pty
    import termios

    reading, writing = pty.openpty()
    termios.tcsetwinsize(writing, (24, width))
    with os.fdopen(writing, "w") as terminal:
        monkeypatch.setattr("sys.stderr", terminal)
        told()
        shown = os.read(reading, 10_000).decode().splitlines()
    os.close(reading)
    return shown


pseudo_terminal = pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")


@pseudo_terminal
def test_on_a_terminal_a_sentence_is_broken_between_its_words(monkeypatch):
    sentence = "No session is running here: hosting scenario 'turtles'."

    shown = on_terminal(monkeypatch, 30, lambda: notice(sentence))

    assert max(map(len, shown)) <= 30
    assert len(shown) == 2
    assert " ".join(shown) == sentence


@pseudo_terminal
def test_excerpts_of_files_are_shown_as_they_are(monkeypatch):
    excerpt = (
        "s.yaml:1:1: 'hello' stands where a mapping is wanted\n"
        "     1 | hello there, and whoever else is there\n"
        "       |        ^^^^^"
    )

    shown = on_terminal(monkeypatch, 30, lambda: complain("tftool", excerpt))

    assert shown == [
        "tftool: s.yaml:1:1: 'hello'",
        "stands where a mapping is",
        "wanted",
        "     1 | hello there, and whoever else is there",
        "       |        ^^^^^",
    ]


@pseudo_terminal
@pytest.mark.parametrize("width", [60, 80])
@pytest.mark.parametrize(
    "words",
    [
        "check missing.yaml",
        "check turtels",
        "record -o run.mcap --max-duration 5",
        "echo A B --at 5",
        "echo turtle1 carrot1 turtles --at 5",
        "echo turtle1 --at 5 --for 3 --json",
        "tree --no-such-option",
        "info noise",
        "doctor missing.mcap noise",
        "run nothing.py",
        "robot missing.urdf",
        "export a b missing.mcap -o x.csv",
    ],
)
def test_error_messages_fit_the_width_of_a_narrow_terminal(monkeypatch, tmp_path, width, words):
    from tftool.app.main import main

    (tmp_path / "noise").write_bytes(bytes(range(256)))
    monkeypatch.chdir(tmp_path)

    shown = on_terminal(monkeypatch, width, lambda: main(words.split()))

    assert shown
    assert max(map(len, shown)) <= width


@pseudo_terminal
def test_a_missing_file_is_said_once_on_a_terminal(monkeypatch, capsys, tmp_path):
    from tftool.app.main import main

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)

    said = on_terminal(monkeypatch, 80, lambda: main(["check", "missing.yaml"]))

    assert said == ["tftool: There is no file or folder 'missing.yaml'."]
    out = capsys.readouterr().out
    assert "missing" in out
    assert "cannot be read" in out
    assert "There is no file" not in out


@pseudo_terminal
def test_lines_of_the_log_are_broken_between_words_and_keep_their_colour(monkeypatch):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    line = record("WARN", "word " * 12)

    shown = on_terminal(monkeypatch, 60, lambda: tell_record(line, label="arm"))

    assert shown[0].startswith("[arm] \033[33m[WARN] ")
    assert shown[-1].endswith("word\033[0m")
    plain = [one.replace("\033[33m", "").replace("\033[0m", "") for one in shown]
    assert max(map(len, plain)) <= 60
    assert " ".join(plain).endswith(" ".join(["word"] * 12))
